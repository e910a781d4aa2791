"""Studies: extremes over a box of settings, and the setting that gives a wanted value."""

from .box import Box as Box
from .settings import Settings as Settings
from .settings import settings_for as settings_for
from .zone import Zone as Zone
from .zone import zone as zone
