"""Planar linkages moved by cylinders, described the way an engineer says them.

The names of this door and the rooms they come from are the lines of `__init__.pyi`; a room is loaded when a name of it is first needed.
"""

import re
from importlib import import_module
from pathlib import Path

from . import shown as _shown

_LINES = Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8")
_ROOMS = {name: room for room, name in re.findall(r"^from ([\w.]+) import (\w+)", _LINES, re.MULTILINE)}
_HEAVY = ("board", "pictures", "formulas", "documents", "exports")
"""Rooms with Matplotlib or SymPy behind them, which are loaded when a function of theirs is first called."""
__all__ = [*_ROOMS]

_shown.load_writer = lambda: import_module(".notebook", __name__).html_of  # type: ignore[no-any-return]


def __getattr__(name: str) -> object:
    """Return a name of the door, from then on there; AttributeError for any other."""
    if name not in _ROOMS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    room = _ROOMS[name]
    late = room.split(".")[1] in _HEAVY
    found = import_module(".doors", __name__).late(room, name) if late else getattr(import_module(room, __name__), name)
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    """Return the names of the door, those not loaded yet included."""
    return sorted({*globals(), *_ROOMS})
