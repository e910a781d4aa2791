"""Studies: the search for better dimensions, extremes over a box of settings, wanted values, and surveys of millions of designs."""

from .box import Box
from .infeasible import InfeasibleError
from .measures import at, integral, least, most, reachable, worst
from .optimum import Optimum
from .settings import Settings, settings_for
from .space import around
from .survey import Survey, survey
from .zone import Zone, zone
