"""Force elements: what acts on a mechanism, declared like its points. Forces in N, gravity downwards.

    positive thrust pushes the ends of the driven length apart     A o--->[=====]<---o B   the pins push back
    a weight pulls down, a spring longer than its free length pulls its ends together
    a moment turns its link counter-clockwise; a support pushes its point along its direction
"""

from .body import LinkMass as LinkMass
from .body import Moment as Moment
from .case import LoadCase as LoadCase
from .element import AT_REST as AT_REST
from .element import ForceElement as ForceElement
from .element import Friction as Friction
from .element import Poses as Poses
from .element import Rates as Rates
from .element import require_poses as require_poses
from .friction import GuideFriction as GuideFriction
from .friction import PinFriction as PinFriction
from .load import Load as Load
from .load import Push as Push
from .load import couple as couple
from .point import Force as Force
from .point import Support as Support
from .point import Weight as Weight
from .two_point import Actuator as Actuator
from .two_point import Between as Between
from .two_point import Damper as Damper
from .two_point import DrawnAs as DrawnAs
from .two_point import Spring as Spring
from .two_point import TwoPoint as TwoPoint
