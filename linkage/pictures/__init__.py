"""Pictures: a mechanism at a pose, at its end positions, in motion, and curves of results over the stroke.

What draws and the live page are loaded when they are first asked for: one brings Matplotlib, the other studies and syntheses.
"""

from importlib import import_module
from typing import TYPE_CHECKING

from .shown_values import Limit

if TYPE_CHECKING:
    from .browser import page, page_html
    from .by_kind import draw, plot
    from .drawing import Drawing, mechanism
    from .film import animate
    from .tolerances import plot_bands, plot_tornado, plot_zone

_ROOMS = {"draw": "by_kind", "plot": "by_kind", "Drawing": "drawing", "mechanism": "drawing", "animate": "film"}
_ROOMS |= dict.fromkeys(("page", "page_html"), "browser") | dict.fromkeys(("plot_bands", "plot_tornado", "plot_zone"), "tolerances")
__all__ = ["Limit", *_ROOMS]


def __getattr__(name: str) -> object:
    """Return a name of what draws, from then on there; AttributeError for any other."""
    if name not in _ROOMS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = found = getattr(import_module(f".{_ROOMS[name]}", __name__), name)
    return found


def __dir__() -> list[str]:
    """Return the names of the room, those not loaded yet included."""
    return sorted({*globals(), *_ROOMS})
