"""Forces: the drive's by virtual work, the joints' by equilibrium of every body, supports, friction. N and Nm."""

from .driving import driving_force as driving_force
from .forces import pin_forces as pin_forces
from .holding import stroke_followed as stroke_followed
from .joint_force import JointForce as JointForce
from .loaded import Case as Case
from .loaded import Loads as Loads
from .loaded import elements_of as elements_of
from .requests import drive_force as drive_force
from .requests import pin_force as pin_force
from .result import PinForces as PinForces
from .supports import reaction as reaction
from .table import PinLoad as PinLoad
from .table import max_table as max_table
from .table import table_text as table_text
from .thrusts import member_thrust as member_thrust
