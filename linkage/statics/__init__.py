"""Forces: the drive's by virtual work, the joints' by equilibrium of every body, supports, friction. N and Nm."""

from .asked import thrust as thrust
from .asked_pin import pin_force as pin_force
from .driving import driving_force as driving_force
from .forces import pin_forces as pin_forces
from .result import JointForce as JointForce
from .result import PinForces as PinForces
from .supports import reaction as reaction
from .table import PinLoad as PinLoad
from .table import max_table as max_table
from .table import table_text as table_text
