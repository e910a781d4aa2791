"""The table of a motion's results: strokes, moving points, named outputs."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import field
from importlib import import_module
from typing import Any, ClassVar, TypeVar

import numpy as np

from ..errors import DefinitionError, cited, is_listed, require_type
from ..frozen import FrozenDict, immutable, record
from ..language import heading_of, noted
from ..loads import ForceElement, LoadCase
from ..plan import Plan
from ..program import FloatArray, claim, is_traced
from ..quantities import Coordinate, Dimension, Member, Quantity, Stroke, is_number
from ..units import decimals, display_unit, factor, shown_in, unit_or_none, unit_sign
from .limits import stroke_display_unit
from .motion import Motion, require_motion
from .requests import Request, RequestLike, measured_in

# A column of results: a name, values over the poses, and the unit to show them in.

NOISE = 1e-12
LEAST = 1e-9
"""A value that is smaller, compared with the greatest of its column or in the column's unit, is rounding noise."""


@immutable
class Column:
    """A column of results: values in SI and the unit that they are read in.

    Parameters
    ----------
    name : str
        The heading.
    values : array
        The values [SI].
    unit : str, optional
        The unit in which they are shown, "" for a plain number. In a chosen system, `linkage.units.unit_system`, that of the system.
    digits : int, optional
        The significant digits, 4 by default.
    request : request, optional
        What a machine is asked for to have them, where that is known: a page in a browser works them out again by it.
    """

    name: str
    values: FloatArray
    unit: str = ""
    digits: int = 4
    request: RequestLike | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.name, str) or not self.name:
            raise DefinitionError(f'Column({cited(self.name)}): its name is expected first, Column("pressure", values, "bar").')
        is_known = False
        with suppress(ValueError):  # real numbers or truth values, or one that is traced
            array = np.asarray(self.values)
            one = array.flat[0] if array.dtype.kind == "O" and array.size == 1 else None
            is_known = is_traced(one) or (array.dtype.kind in "fiub" and not np.ma.is_masked(self.values))
        if not is_known:
            what = f"Column {self.name}: {cited(self.values)} holds no numbers"
            raise DefinitionError(f"{what}; give one for each pose, NaN where it has none.")
        unit_or_none(self.unit, where=f"the column {self.name}")
        claim(self.values, self.name)

    @classmethod
    def of(cls, motion: Motion, request: RequestLike, unit: str | None = None, name: str = "", digits: int = 4) -> Column:
        """Return a request over a motion as a column, one number a pose: `Column.of(motion, pressure("lift"), "bar")`.

        Without a unit it is in the one that its kind is shown in, deg, m, kN or bar, without a name under what was asked.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        request : str, Quantity or Request
            The value asked for.
        unit : str, optional
            The unit it is shown in.
        name : str
            The heading; by default the request's words.
        digits : int
            The decimals shown.

        Returns
        -------
        Column
            The column.
        """
        values = motion[request]
        if values.shape != motion.shape:
            what = f"{motion.plan.title}: {request} has two parts at every pose"
            raise DefinitionError(f'{what}, and a column one number; ask for y("G"), ratio(x("G")), or np.hypot of the two.')
        kind = motion.plan.members.get(request) if isinstance(request, str) else request
        title = name or (kind.name if isinstance(kind, Member) else "") or str(request)
        return cls(title, values, display_unit(measured_in(motion.plan, kind)) if unit is None else unit, digits, request)

    @property
    def shown_unit(self) -> str:
        """The unit that its values are shown in: the column's own, or that of the chosen system for the same measure."""
        return shown_in(self.unit)

    @property
    def shown_digits(self) -> int:
        """The decimals that its values are shown with, in that unit."""
        return decimals(self.digits, self.unit)

    @property
    def shown(self) -> FloatArray:
        """The values in the unit that they are shown in."""
        return np.asarray(self.values) / factor(self.shown_unit)

    @property
    def drawn(self) -> FloatArray:
        """The values in the unit that they are shown in, rounding noise as zero: for pictures."""
        size = float(np.nanmax(np.abs(self.shown), initial=0.0))
        return np.where(np.abs(self.shown) < max(NOISE * size, LEAST if self.unit else 0.0), 0.0, self.shown)

    @property
    def heading(self) -> str:
        """The name with its unit, in the language that is spoken: `pd, kgf/cm2`."""
        name = heading_of(self.name)
        return f"{name}, {unit_sign(self.unit)}" if self.unit else name


def columns_of(motion: Motion) -> list[Column]:
    """Return the strokes, the coordinates of the points that move, and the named outputs of a motion, a column each.

    The first column of a motion in time is its instants.
    """
    require_motion(motion)
    plan = motion.plan
    table = [] if motion.time is None else [Column(noted("time"), np.broadcast_to(motion.time, motion.shape), "s")]
    table += [Column(name, value, stroke_display_unit(plan, name), request=name) for name, value in motion.strokes.items()]
    for point in plan.moving:
        for axis, values in zip("xy", motion[point], strict=True):
            table.append(Column(f"{point}_{axis}", values, "m", request=Coordinate(point, axis)))
    outputs = {name: member for name, member in plan.of_kind(Quantity).items() if not isinstance(member, (Stroke, Dimension))}
    motion._work_out(outputs)
    return table + [Column(name, motion[name], display_unit(member.measures), request=name) for name, member in outputs.items()]


# Members that have columns of their own in a machine's table of results.

Kind = TypeVar("Kind", bound=Member)


def from_above(place: str) -> Any:
    """Return an object of a room above, "module:name"; the room is loaded when it is first asked."""
    module, name = place.split(":")
    return getattr(import_module(module), name)


def speakers(plan: Plan, kind: type[Kind]) -> dict[str, Kind]:
    """Return the members of a plan that show or judge themselves, `Tabled` or `HasVerdicts`, or the objects in their place, by name."""

    def make(_: Plan) -> FrozenDict[str, Kind]:
        found: dict[str, Kind] = {}
        for name, member in plan.members.items():
            speaker: object = member
            if isinstance(member, ForceElement) and member.shown_by and not isinstance(member, kind):  # by a class above its own room
                speaker = from_above(member.shown_by).of(member, plan)
            if isinstance(speaker, kind):
                found[name] = speaker
        return FrozenDict(found)

    return plan.made(("speakers", kind), make)


class Tabled(Member):
    """A member that the table of results shows, such as a cylinder: its base beside that of its kind.

    `section` and `caption` head its values in a report, together with those of other members that have the same.
    """

    section: ClassVar[str] = noted("Hydraulics")
    caption: ClassVar[str] = noted("Cylinders, over all that the machine runs")

    @abstractmethod
    def columns(self, motion: Motion) -> list[Column]:
        """Return its columns under the machine's own loads; the table adds its name to theirs where several members have them.

        The motion was asked for with `unreachable="nan"`: values are NaN where there is none.

        Parameters
        ----------
        motion : Motion
            The poses.

        Returns
        -------
        list of Column
            The columns.
        """

    def columns_in(self, motion: Motion, case: LoadCase | str | None = None, direction: str | None = None) -> list[Column]:
        """Return its columns in a load case, while it moves in a direction; by default none but the plain ones of `columns`.

        Parameters
        ----------
        motion : Motion
            The poses.
        case : LoadCase or str, optional
            The load case.
        direction : str, optional
            The direction of motion; where it matters, as at a border of stages.

        Returns
        -------
        list of Column
            The columns.
        """
        return self.columns(motion) if case is None and direction is None else []

    def gauges(self, plan: Plan) -> Mapping[str, Request]:
        """Return its further values for a live page beside its columns, by their names.

        Its `pressure` [Pa] and the greatest that it may have, `most`; its `closed` length and its `stroke` [m].
        """
        return {}


# What a machine is about: the curve, the paths and the limits that its pictures show where nothing else is asked for.


@record
class Featured:
    """What a machine's pictures show where nothing else is asked: a column, paths and limits.

    Parameters
    ----------
    column : str, optional
        The name of the column of results that it is about; by default the last one that changes.
    path : sequence of str, optional
        The points whose paths are drawn.
    limits : mapping of str to sequence, optional
        Limits of columns by their names, each `(value [SI], text)` or `(value, text, "below")`: the side that fails, above unless said. Its
        text is on that side and says what fails there, or what the line is.
    coupler : str, optional
        The point of a coupler, which a synthesis brings along a path where no other one is said.
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
            value, *words = limit if is_listed(limit) and limit else (None,)
            if not is_number(value) or len(words) > 2 or not all(isinstance(each, str) for each in words):
                said = f"Featured(limits={{{cited(name)}: {cited(limit)}}})"
                raise DefinitionError(f'{said}: write (value [SI], text) or (value, text, "below").')
