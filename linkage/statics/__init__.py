"""Forces: the drive's by virtual work, the joints' by equilibrium of every body, supports, friction. N and Nm."""

from ..star import declare_public
from .applied import applied_elements, applied_loads, elements_of, plan_in_case, rates_in
from .carried import PROBE, Direction, direction_at, direction_words, greatest_kept, is_steady, member_limits, pull_direction, pulling
from .force_requests import drive_force, drive_remarks, held_verdict, pin_force, pin_forces_under, thrust_from_forces
from .holding import each_once, holders_of, is_among, same, stroke_followed, tied_forces
from .joint_forces import GlandForce, JointForce, PinForces, pin_forces
from .law_requests import LawRequest, TracedMotion, acceleration, dynamic_factor, has_masses, own_rates, pace_remarks, request_text, speed
from .poses import AnyMotion, motion_of_whole, plan_of
from .rope import Rope, tension
from .solution import held_fault, held_in_case, loose_movements, looseness
from .table import PinLoad, judged_table, max_table, table_text
from .vehicle import Standing, axle_load, ground_loads, reaction, slipping, standing, standing_supports
from .work import driving_force, member_thrust, pump_thrust

declare_public(globals())
