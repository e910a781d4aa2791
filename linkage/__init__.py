"""Planar linkages moved by cylinders, described the way an engineer says them.

The names of this door and the rooms they come from are the lines of `__init__.pyi`; a room is loaded when a name of it is first needed.
"""

from importlib import import_module

from . import shown as _shown
from .star import late_names as _late_names

_HEAVY = ("board", "pictures", "formulas", "documents", "exports")
"""Rooms with Matplotlib or SymPy behind them, which are loaded when a function of theirs is first called."""

_shown.load_writer = lambda: import_module(".notebook", __name__).html_of  # type: ignore[no-any-return]


def _loaded(room: str, name: str) -> object:
    """Look a name up in its room; of a heavy room make a function that loads it."""
    if room.split(".")[1] in _HEAVY:
        return import_module(".doors", __name__).late(room, name)
    return getattr(import_module(room, __name__), name)


__getattr__, __dir__ = _late_names(globals(), _loaded)
