"""Studies: extremes over a box of settings, the setting that gives a wanted value, and surveys of millions of designs."""

from .box import Box as Box
from .settings import Settings as Settings
from .settings import settings_for as settings_for
from .survey import Survey as Survey
from .survey import survey as survey
from .zone import Zone as Zone
from .zone import zone as zone
