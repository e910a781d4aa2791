"""The languages that values and ratios are written in: C, JavaScript, and what packages bring."""

from __future__ import annotations

from .. import plugins
from ..plugins import Plugins
from .foreign import C, Language
from .javascript import JavaScript

LANGUAGES = Plugins[Language | JavaScript](
    plugins.LANGUAGES,
    "The language",
    lambda found: found if isinstance(found, Language) else found() if isinstance(found, type) and issubclass(found, Language) else None,
    "no subclass of linkage.program.Language",
    {"c": C(), "javascript": JavaScript()},
)
"""The languages there are, by name."""
