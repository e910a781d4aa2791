"""Studies: extremes over a box of settings, the setting that gives a wanted value, and surveys of millions of designs."""

from .box import Box
from .settings import Settings, settings_for
from .survey import Survey, survey
from .zone import Zone, zone
