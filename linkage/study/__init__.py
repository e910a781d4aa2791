"""Studies: extremes over a box of settings, settings that give wanted values, tolerances, and surveys of millions of designs."""

from .box import Box
from .monte_carlo import Band, MonteCarlo, Within, monte_carlo
from .sensitivity import Bar, SobolIndices, Tornado, sobol, tornado
from .settings import Settings, settings_for
from .spread import sigma, spread
from .survey import Survey, survey
from .targets import Solutions, Target
from .tolerances import Tolerance
from .zone import Zone, zone
