"""Forces: the drive's by virtual work, the joints' by equilibrium of every body, supports, friction. N and Nm."""

from .acting import Case, Loads, elements_of
from .driving import driving_force, reaction
from .forces import pin_forces
from .holding import stroke_followed
from .joints import JointForce
from .requests import drive_force, pin_force
from .result import PinForces
from .table import PinLoad, max_table, table_text
from .thrusts import member_thrust
