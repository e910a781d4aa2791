"""What a study file may ask for: the requests and conditions of this package, and those that others bring.

A package adds its own by entry points of the group `hydrolinkage.requests`, each a function that returns a request or a condition:
`thrust = "hydraulics:thrust"` is `thrust(lift)` in a file.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .. import plugins
from ..errors import unknown
from ..motion import condition, gap, ratio, transmission
from ..plugins import Plugins
from ..statics import acceleration, axle_load, drive_force, pin_force, slipping, speed

REQUESTS = Plugins[Callable[..., Any]](
    plugins.REQUESTS,
    "the request",
    lambda found: found if callable(found) else None,
    "no function",
    {
        "ratio": ratio, "drive_force": drive_force, "pin_force": pin_force, "axle_load": axle_load, "slipping": slipping,
        "transmission": transmission, "gap": gap, "condition": condition, "speed": speed, "acceleration": acceleration,
    },
)  # fmt: skip
"""The requests there are, by name."""


def request_function(name: str, beside: tuple[str, ...] = ()) -> Callable[..., Any]:
    """Return the function of a request by name; DefinitionError for one that is unknown, or that cannot be loaded.

    `beside` are the names of functions that are known in its place too.
    """
    if name not in REQUESTS:
        raise unknown("Function", name, [*beside, *REQUESTS])
    return REQUESTS[name]
