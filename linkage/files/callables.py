"""What a study file may ask for: the requests and conditions of this package, and those that others bring.

A package adds its own by entry points of the group `hydrolinkage.requests`, each a function that returns a request or a condition:
`thrust = "hydraulics:thrust"` is `thrust(lift)` in a file.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import lru_cache
from importlib.metadata import EntryPoint, entry_points
from types import MappingProxyType
from typing import Any

from ..errors import DefinitionError, unknown
from ..motion import condition, gap, ratio, transmission
from ..statics import drive_force, pin_force

REQUESTS_GROUP = "hydrolinkage.requests"

REQUESTS: Mapping[str, Callable[..., Any]] = MappingProxyType(
    {"ratio": ratio, "drive_force": drive_force, "pin_force": pin_force, "transmission": transmission, "gap": gap, "condition": condition}
)
"""The requests of this package by name."""


@lru_cache(maxsize=1)
def brought() -> Mapping[str, EntryPoint]:
    """Return what other packages bring, by name."""
    return MappingProxyType({point.name: point for point in sorted(entry_points(group=REQUESTS_GROUP), key=lambda point: point.name)})


def request_function(name: str, beside: tuple[str, ...] = ()) -> Callable[..., Any]:
    """Return the function of a request by name; DefinitionError for one that is unknown, or that cannot be loaded.

    `beside` are the names of functions that are known in its place too.
    """
    if name in REQUESTS:
        return REQUESTS[name]
    if name not in brought():
        raise unknown("Function", name, [*beside, *REQUESTS, *brought()])
    point = brought()[name]
    try:
        found = point.load()
    except (ImportError, AttributeError) as error:
        raise DefinitionError(f"the request {name} ({point.value}) cannot be loaded: {error}.") from error
    if not callable(found):
        raise DefinitionError(f"the request {name} ({point.value}) is no function.")
    return found  # type: ignore[no-any-return]
