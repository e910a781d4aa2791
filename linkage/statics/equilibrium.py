"""The equations of equilibrium: A u + B q + l = 0, with the joint forces u and the friction q, at every pose at once.

Each body has three rows (forces along x and y, moment about its first point over a length), a lone pin two.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ..program import FloatArray
from .acting import Acting
from .bodies import FRAME, Strut
from .holding import Line
from .joints import Contact, Structure, Wrench, wrenches
from .poses import Poses, cross


@dataclass(frozen=True)
class Column:
    """A unit wrench that acts on one body from another."""

    contact: Contact
    wrench: Wrench


@dataclass(frozen=True)
class Form:
    """A linear form of the unknowns, shapes (n, columns), (n, frictions), (n,): row u + rub q + rest."""

    row: FloatArray
    rub: FloatArray
    rest: FloatArray

    def __add__(self, other: Form) -> Form:
        return Form(self.row + other.row, self.rub + other.rub, self.rest + other.rest)

    def times(self, factor: FloatArray) -> Form:
        """Return the form times a number at every pose, shape (n,)."""
        return Form(self.row * factor[:, None], self.rub * factor[:, None], self.rest * factor)

    def at(self, u: FloatArray, q: FloatArray) -> FloatArray:
        """Return its value for unknowns (n, columns) and frictions (n, frictions), shape (n,)."""
        return np.asarray((self.row * u).sum(axis=1) + (self.rub * q).sum(axis=1) + self.rest)


@dataclass(frozen=True)
class System:
    """The equations of one structure at its poses. `rubs` are the unit wrenches of the friction; `length` a scale [m], if given."""

    structure: Structure
    poses: Poses
    acting: tuple[Acting, ...]
    rubs: Sequence[Column] = field(default=())
    length: float = 0.0

    @cached_property
    def scale(self) -> float:
        """A length of the mechanism [m], which makes moments comparable with forces: as given, or half its extent."""
        if self.length:
            return self.length
        if not self.poses.count:
            return 1.0
        places = np.concatenate([self.poses.at(point) for point in self.poses.plan.points], axis=1)
        return float(np.max(np.ptp(places, axis=1))) / 2.0 or 1.0

    @cached_property
    def columns(self) -> tuple[Column, ...]:
        """The unknowns, contact by contact."""
        return tuple(Column(each, wrench) for each in self.structure.contacts for wrench in wrenches(each, self.poses, self.scale))

    @cached_property
    def first(self) -> dict[Contact, int]:
        """The first unknown of each contact."""
        starts = np.cumsum([0, *(each.columns for each in self.structure.contacts)])
        return dict(zip(self.structure.contacts, starts.tolist(), strict=False))

    @cached_property
    def starts(self) -> list[int]:
        """The first row of each body and lone pin, and the count of rows."""
        sizes = [3] * len(self.structure.parts) + [2] * len(self.structure.lone)
        return [0, *np.cumsum(sizes).tolist()]

    @property
    def width(self) -> int:
        """How many unknowns there are."""
        return len(self.columns)

    @property
    def height(self) -> int:
        """How many equations there are."""
        return int(self.starts[-1])

    def put(self, rows: FloatArray, body: int, wrench: Wrench, sign: float = 1.0) -> None:
        """Add a wrench on a body to its rows, shape (n, rows)."""
        if body == FRAME:
            return
        start = self.starts[body]
        rows[:, start] += sign * wrench.force[0]
        rows[:, start + 1] += sign * wrench.force[1]
        if body < len(self.structure.parts):
            arm = wrench.at - self.poses.at(self.structure.parts[body].points[0])
            rows[:, start + 2] += sign * (cross(arm, wrench.force) + wrench.couple) / self.scale

    def table(self, columns: Sequence[Column]) -> FloatArray:
        """Return the rows of some unit wrenches, shape (n, rows, columns)."""
        found = self.poses.zeros(self.height, len(columns))
        for index, column in enumerate(columns):
            self.put(found[:, :, index], column.contact.on, column.wrench)
            self.put(found[:, :, index], column.contact.by, column.wrench, -1.0)
        return found

    @cached_property
    def A(self) -> FloatArray:
        """The rows of the joint forces, shape (n, rows, columns)."""
        return self.table(self.columns)

    @cached_property
    def B(self) -> FloatArray:
        """The rows of the friction, shape (n, rows, frictions)."""
        return self.table(self.rubs)

    @cached_property
    def loads(self) -> tuple[tuple[int, Acting, Wrench], ...]:
        """The loads as wrenches, with the body each acts on."""
        poses, none = self.poses, np.zeros(self.poses.count)
        return tuple(
            (self.structure.bearer(each.load), each, Wrench(poses.at(each.load.point), poses.flat(each.force), none))
            for each in self.acting
        )

    @cached_property
    def load_rows(self) -> FloatArray:
        """The rows of the loads, shape (n, rows)."""
        rows = self.poses.zeros(self.height)
        for body, _, wrench in self.loads:
            self.put(rows, body, wrench)
        return rows

    # -- what is read off ----------------------------------------------------------------------------------

    def unknown(self, contact: Contact, letter: str, sign: float) -> Form:
        """Return an unknown of a contact, signed; a couple in Nm."""
        factor = sign * (self.scale if letter == "c" else 1.0)
        row = self.poses.zeros(self.width)
        row[:, self.first[contact] + contact.holds.index(letter)] = self.poses.motion._array(factor)
        return Form(row, self.poses.zeros(len(self.rubs)), self.poses.zeros())

    def thrust(self, strut: Strut) -> Form:
        """Return a two-point member's thrust [N]: what pushes its far end against all that acts there."""
        body = self.structure.body_of(strut)
        points = self.structure.parts[body].points

        def far(contact: Contact) -> bool:
            at = contact.point if contact.point in points else next(iter(contact.track), "")
            return at in strut.far

        return self.sum_along(body, far, strut.far.__contains__, self.poses.along(strut.P, strut.Q))

    def known(self, way: int = 1) -> list[tuple[Form, FloatArray]]:
        """Return what the thrusts of members are bound to: those of a law to its value, those of one line to each other's areas.

        `way` is 1 where the first cylinder of a line pushes, -1 where it pulls: it tells which side's area a cylinder works with.
        """
        found = [(self.thrust(each), self.poses.flat(each.pushing.thrust)) for each in self.structure.struts if each.pushing is not None]
        for line in self.structure.holding.lines:
            struts = [each for each in self.structure.struts if each.line is line]
            (first, *others) = [(self.thrust(each), area) for each, area in zip(struts, areas(line, self.poses, way), strict=True)]
            none = self.poses.zeros()
            found += [(form.times(first[1]) + first[0].times(-1.0 * area), none) for form, area in others]
        return found

    def sum_along(self, body: int, far: Callable[[Contact], bool], near: Callable[[str], bool], u: FloatArray) -> Form:
        """Return minus the forces on one side of a body along a direction u, shape (2, n): what a cut there transmits."""
        row, rub = (self.poses.zeros(len(columns)) for columns in (self.columns, self.rubs))
        for values, columns in ((row, self.columns), (rub, self.rubs)):
            for index, column in enumerate(columns):
                sign = float(column.contact.on == body) - float(column.contact.by == body)
                if sign and far(column.contact):
                    values[:, index] = -sign * (column.wrench.force * u).sum(axis=0)
        pushes = [wrench.force for bearer, each, wrench in self.loads if bearer == body and near(each.load.point)]
        rest = sum(((force * u).sum(axis=0) for force in pushes), self.poses.zeros())
        return Form(row, rub, -rest)


def areas(line: Line, poses: Poses, way: int) -> list[FloatArray]:
    """Return the thrust of each cylinder of a line at one unit of the line's pressure [m2], shape (n,).

    Along the stroke that the line holds, some cylinders grow with the first and some against it: where the first one pushes
    (`way` 1), the others drive the stroke the same way.
    """
    if len(line.cylinders) == 1:
        return [np.ones(poses.count)]
    if not any(each.works_both for each in line.cylinders):
        return [poses.flat(each.area_in(poses.motion, np.ones(()))) for each in line.cylinders]
    growth = [poses.growth(*each.ends, line.stroke) for each in line.cylinders]
    senses = [poses.full(np.sign(rate * growth[0]) * way) for rate in growth]
    return [poses.flat(each.area_in(poses.motion, sense)) for each, sense in zip(line.cylinders, senses, strict=True)]
