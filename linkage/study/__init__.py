"""Studies: the search for better dimensions, extremes over a box, wanted values, tolerances, and surveys of millions of designs."""

from ..motion import Target
from ..star import declare_public
from .infeasible import InfeasibleError
from .load_rule import ISO_10567, ISO_14397_1, OECD_2, LoadRule
from .monte_carlo import Band, MonteCarlo, monte_carlo
from .optimum import Optimum
from .pareto import Front
from .settings import Settings, Solutions, Zone, settings_for, zone
from .space import Box, around
from .survey import Survey, survey
from .tolerances import Effect, SobolIndices, Tolerance, Tornado, sigma, sobol, tornado
from .working_field import WorkingField, working_field

declare_public(globals())
