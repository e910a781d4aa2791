"""What a machine is about: the curve, the paths and the limits that its pictures show where nothing else is asked for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, final

from ..checks import require_type
from ..errors import DefinitionError, cited
from ..quantities import is_number


@final
@dataclass(frozen=True)
class Featured:
    """The column of results that a machine is about, the points whose paths are drawn, and limits of columns by their names.

    A limit is `(value [SI], text)` or `(value, text, "below")`: the side that fails, above unless said. Its text stands on that side and
    says what fails there, or what the line is. `coupler` is the point of a
    coupler, which a synthesis brings along a path where no other one is said. What is left out is chosen from the results: the last column
    that changes, no path, no limit.
    """

    column: str = ""
    path: Sequence[str] = ()
    limits: Mapping[str, Sequence[Any]] = field(default_factory=dict)
    coupler: str = ""

    def __post_init__(self) -> None:
        require_type("Featured(column", self.column, str, 'the name of a column of results is expected, "tilt"')
        require_type("Featured(coupler", self.coupler, str, 'the name of a point is expected, "P"')
        require_type("Featured(path", self.path, (list, tuple), 'a list of points is expected, path=["G"]', of=str)
        require_type("Featured(limits", self.limits, Mapping, 'limits by column are expected, dict(tilt=(0.1, "most"))')
        for name, limit in self.limits.items():
            value, *words = limit if isinstance(limit, (list, tuple)) and limit else (None,)
            if not is_number(value) or len(words) > 2 or not all(isinstance(each, str) for each in words):
                said = f"Featured(limits={{{cited(name)}: {cited(limit)}}})"
                raise DefinitionError(f'{said}: write (value [SI], text) or (value, text, "below").')
