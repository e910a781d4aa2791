"""The equations of equilibrium: A u + B q + l = 0, with the joint forces u and the friction q, at every pose at once.

Each body has three rows (forces along x and y, moment about its first point over a length), a lone pin two.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field
from functools import cached_property, reduce

import numpy as np

from ..errors import DefinitionError, ensure
from ..frozen import record
from ..loads import Load, TwoPoint
from ..plan import Mask
from ..program import FloatArray
from ..quantities import Distance, Quantity, name_of
from .applied import member_title
from .friction import JointFriction
from .holding import PressureLine, areas, is_among, same, share_of, solution_of_few, tie_pivots
from .joints import FRAME, Contact, Structure, Strut, UnitWrench, Wrench, follows_points, force_direction, wrenches
from .poses import FlatPoses, cross, over_zero


@record
class LinearForm:
    """A linear form of the unknowns and the frictions, shapes (n, columns), (n, frictions), (n,): row u + friction q + rest."""

    row: FloatArray
    friction: FloatArray
    rest: FloatArray

    def plus(self, other: LinearForm) -> LinearForm:
        """Return the sum of two forms."""
        return LinearForm(self.row + other.row, self.friction + other.friction, self.rest + other.rest)

    def multiplied(self, factor: FloatArray) -> LinearForm:
        """Return the form times a number at every pose, shape (n,)."""
        return LinearForm(self.row * factor[:, None], self.friction * factor[:, None], self.rest * factor)

    def at(self, u: FloatArray, q: FloatArray) -> FloatArray:
        """Return its value for unknowns (n, columns) and frictions (n, frictions), shape (n,)."""
        return np.asarray((self.row * u).sum(axis=1) + (self.friction * q).sum(axis=1) + self.rest)


@record
class System:
    """The equations of one structure at its poses. `length` is a scale [m], if given.

    `pushed` says where ropes would have to push (n,), so that those which draw back pull, by their names.
    """

    structure: Structure
    poses: FlatPoses
    loads: tuple[Load, ...]
    frictions: Sequence[JointFriction] = ()
    length: float = 0.0
    pushed: Mapping[str, Mask] = field(default_factory=dict)

    @cached_property
    def unit_length(self) -> float:
        """A length of the mechanism [m], which makes moments comparable with forces: as given, or half its extent."""
        if self.length:
            return self.length
        if not self.poses.count:
            return 1.0
        places = np.concatenate([self.poses.at(point) for point in self.poses.plan.points], axis=1)
        return float(np.max(np.ptp(places, axis=1))) / 2.0 or 1.0

    @cached_property
    def unknowns(self) -> tuple[UnitWrench, ...]:
        """The unknowns, contact by contact."""
        poses, length = self.poses, self.unit_length
        return tuple(UnitWrench(each, wrench) for each in self.structure.contacts for wrench in wrenches(each, poses, length))

    @cached_property
    def first(self) -> dict[Contact, int]:
        """The first unknown of each contact."""
        starts = np.cumsum([0, *(len(each.holds) for each in self.structure.contacts)])
        return dict(zip(self.structure.contacts, starts.tolist(), strict=False))

    @cached_property
    def starts(self) -> list[int]:
        """The first row of each body and lone pin, and the count of rows."""
        return [0, *np.cumsum([3] * len(self.structure.bodies) + [2] * len(self.structure.lone)).tolist()]

    @cached_property
    def A(self) -> FloatArray:
        """The rows of the joint forces and of the forces of ropes, shape (n, rows, columns)."""
        found = self.rows_of(self.unknowns, self.width)
        for index, row, value in self.run_entries():
            found[:, row, index] += value
        return found

    @cached_property
    def runs(self) -> tuple[tuple[tuple[int, Load, Wrench], ...], ...]:
        """One unit of each rope's force on bodies: the body, the load, its wrench."""
        poses, none, found = self.poses, np.zeros(self.poses.count), []
        for name, run in self.structure.holders.reeved.items():
            pushed = self.pushed.get(name)
            forces = [(load, poses.flattened(load.force)) for load in run.loads(poses.motion)]
            if pushed is not None:
                forces = [(load, np.where(pushed, 0.0, force)) for load, force in forces]
                forces += [(load, np.where(pushed, poses.flattened(load.force), 0.0)) for load in run.back_loads(poses.motion)]
            bearer = self.structure.bearer
            found.append(tuple((bearer(load), load, Wrench(poses.at(load.point), force, none)) for load, force in forces))
        return tuple(found)

    def run_entries(self) -> Iterator[tuple[int, int, FloatArray]]:
        """Yield the column of each rope, the equation and the entry of a unit of its force there, shape (n,)."""
        for index, run in enumerate(self.runs, len(self.unknowns)):
            for body, _, wrench in run:
                yield from ((index, row, value) for row, value in self.parts(body, wrench))

    @property
    def width(self) -> int:
        """How many unknowns there are: those of the joints, then the forces of ropes."""
        return len(self.unknowns) + len(self.structure.holders.reeved)

    @cached_property
    def B(self) -> FloatArray:
        """The rows of the friction, shape (n, rows, frictions)."""
        return self.rows_of([each.unit for each in self.frictions], len(self.frictions))

    @cached_property
    def load_rows(self) -> FloatArray:
        """The rows of the loads, shape (n, rows)."""
        rows = self.poses.zeros(self.starts[-1])
        for body, _, wrench in self.borne:
            for row, value in self.parts(body, wrench):
                rows[:, row] += value
        return rows

    @cached_property
    def borne(self) -> tuple[tuple[int, Load, Wrench], ...]:
        """The loads as wrenches, with the body each acts on."""
        poses, bearer, none = self.poses, self.structure.bearer, np.zeros(self.poses.count)
        return tuple((bearer(each), each, Wrench(poses.at(each.point), poses.flattened(each.force), none)) for each in self.loads)

    def rows_of(self, columns: Sequence[UnitWrench], width: int) -> FloatArray:
        """Return the rows of some unit wrenches, shape (n, rows, width), the columns first."""
        found = self.poses.zeros(self.starts[-1], width)
        for index, column in enumerate(columns):
            for row, value in self.entries(column):
                found[:, row, index] += value
        return found

    def entries(self, column: UnitWrench) -> Iterator[tuple[int, FloatArray]]:
        """Yield the equations of a unit wrench, with its entries there, shape (n,)."""
        yield from self.parts(column.contact.on, column.wrench)
        yield from self.parts(column.contact.by, column.wrench, -1.0)

    def parts(self, body: int, wrench: Wrench, sign: float = 1.0) -> Iterator[tuple[int, FloatArray]]:
        """Yield the equations of a body with a wrench's entries there, shape (n,): forces along x and y, moment over the scale."""
        if body == FRAME:
            return
        start = self.starts[body]
        yield start, sign * wrench.force[0]
        yield start + 1, sign * wrench.force[1]
        if body < len(self.structure.bodies):
            arm = wrench.at - self.poses.at(self.structure.bodies[body].points[0])
            yield start + 2, sign * (cross(arm, wrench.force) + wrench.couple) / self.unit_length

    # -- what is read off ----------------------------------------------------------------------------------

    def drive(self, stroke: str) -> LinearForm:
        """Return the generalised force of a stroke [N or Nm]: each drive's force times how it follows the stroke."""
        forms = [force.multiplied(ratio) for ratio, force in self.drives(stroke)]
        for place, run in enumerate(self.structure.holders.reeved.values()):
            if stroke in run.strokes:
                forms.append(self.run(place).multiplied(self.poses.flattened(run.rate(self.poses.motion, stroke))))
        remedy = f"declare it by Dyad(..., AB=... + {stroke}), Crank, OnGuide or OnLink, or by the drives in the joints() of a step"
        ensure(forms, f"{self.structure.plan.title}: the joints know no drive of {stroke}; {remedy} of one's own.")
        return reduce(LinearForm.plus, forms)

    def drives(self, stroke: str) -> Iterator[tuple[FloatArray, LinearForm]]:
        """Yield how each driven quantity follows a stroke, shape (n,), with the force that drives it; those that do not are left out."""
        for strut in self.structure.struts:
            if strut.known is None and strut.quantity is None:
                yield self.poses.growth(strut.P, strut.Q, stroke), self.thrust(strut)
        yield from self.step_drives(stroke)

    def step_drives(self, stroke: str) -> Iterator[tuple[FloatArray, LinearForm]]:
        """Yield the same of the lengths and joints that steps drive."""
        for strut in self.structure.struts:
            if strut.known is None and strut.quantity is not None and self.follows(strut.quantity, stroke):
                yield self.ratio(strut.quantity, stroke), self.thrust(strut)
        for contact in self.structure.contacts:
            yield from self.driven(contact, stroke)

    def driven(self, contact: Contact, stroke: str) -> Iterator[tuple[FloatArray, LinearForm]]:
        """Yield how the quantities that a joint drives follow a stroke, with their forces; see `drives`."""
        structure, poses = self.structure, self.poses
        drives, behind = list(structure.drives(contact)), structure.plan.reaches(contact.point)
        for letter in dict.fromkeys(letter for _, letter, _ in drives if contact.is_curve and letter != "c"):
            others = [name for name in structure.plan.moving if name in behind and name != contact.point]
            what = f"{contact.owner} is driven along a line of the frame, but its place depends on {', '.join(others)}, which move"
            remedy = "its force is not provided. Say by= the body that the line belongs to"
            ensure(not others, f"{structure.plan.title}: {what}; {remedy}.")
            if stroke in behind:
                way = (force_direction(contact, letter, poses) * poses.rate(contact.point, stroke)).sum(axis=0)
                yield way, self.unknown(contact, letter, 1.0)
        for quantity, letter, sign in drives:
            if (letter == "c" or not contact.is_curve) and self.follows(quantity, stroke):
                yield self.ratio(quantity, stroke), self.unknown(contact, letter, sign)

    def follows(self, quantity: Quantity, stroke: str) -> bool:
        """Return whether a driven quantity follows a stroke; DefinitionError where it follows moving points as well."""
        plan, is_distance = self.structure.plan, isinstance(quantity, Distance)
        if not is_distance and follows_points(plan, quantity):
            what = f"a drive follows {quantity.name or quantity}, which depends on moving points"
            raise DefinitionError(f"{plan.title}: {what}; its force is not provided.")
        return is_distance or stroke == quantity.name or stroke in plan.reaches(quantity)

    def ratio(self, quantity: Quantity, stroke: str) -> FloatArray:
        """Return how a driven quantity follows a stroke, shape (n,); for a distance it follows from its points."""
        if isinstance(quantity, Distance):
            return self.poses.growth(name_of(quantity.P), name_of(quantity.Q), stroke)
        return self.poses.ratio(quantity, stroke)

    def unknown(self, contact: Contact, letter: str, sign: float) -> LinearForm:
        """Return an unknown of a contact, signed; a couple in Nm."""
        factor = sign * (self.unit_length if letter == "c" else 1.0)
        return self.alone(self.first[contact] + contact.holds.index(letter), factor)

    def run(self, place: int) -> LinearForm:
        """Return the force of a rope, by its place."""
        return self.alone(len(self.unknowns) + place)

    def alone(self, column: int, factor: float = 1.0) -> LinearForm:
        """Return one unknown, times a factor."""
        row = self.poses.zeros(self.width)
        row[:, column] = self.poses.motion._array(factor)
        return LinearForm(row, self.poses.zeros(len(self.frictions)), self.poses.zeros())

    def thrust(self, strut: Strut) -> LinearForm:
        """Return a two-point member's thrust [N]: the push on its far end that balances all forces there."""
        if strut.pair is not None:
            return self.unknown(self.structure.sliding_joint(strut.pair, "t"), "t", 1.0)
        body, arm = self.structure.body_of(strut), self.poses.at(strut.Q) - self.poses.at(strut.P)
        along = np.asarray(arm / over_zero(np.hypot(arm[0], arm[1])))
        row, friction = self.poses.zeros(self.width), self.poses.zeros(len(self.frictions))
        for values, columns in ((row, self.unknowns), (friction, [each.unit for each in self.frictions])):
            for index, column in enumerate(columns):
                sign = float(column.contact.on == body) - float(column.contact.by == body)
                if sign and self.structure.seat(column.contact, body) in strut.far:
                    values[:, index] = -sign * (column.wrench.force * along).sum(axis=0)
        for index, run in enumerate(self.runs, len(self.unknowns)):
            for bearer, load, wrench in run:
                if bearer == body and load.point in strut.far:
                    row[:, index] += -(wrench.force * along).sum(axis=0)
        pushes = [wrench.force for bearer, each, wrench in self.borne if bearer == body and each.point in strut.far]
        return LinearForm(row, friction, -sum(((force * along).sum(axis=0) for force in pushes), self.poses.zeros()))

    def known(self, senses: Sequence[int] = ()) -> list[tuple[LinearForm, FloatArray]]:
        """Return the equations of the members' thrusts: those of a law with its value, those of one line with each other's areas.

        `senses` are 1 where the first cylinder of a line pushes, as by default, -1 where it pulls: it tells which side's area works.
        """
        found = [(self.thrust(each), self.poses.flattened(each.known.thrust)) for each in self.structure.struts if each.known is not None]
        lines = self.structure.holders.lines
        for line, way in zip(lines, senses or (1,) * len(lines), strict=True):
            if line.tie is not None:
                continue
            struts = [each for each in self.structure.struts if each.line is line]
            parts = zip(map(self.thrust, struts), areas(line, self.poses, way), map(self.given_thrust, line.cylinders), strict=True)
            (first, own, given), *others = parts
            for form, area, its in others:  # by their areas, but for what other lines give
                found.append((form.multiplied(own).plus(first.multiplied(-1.0 * area)), its * own - given * area))
        return [*found, *self.geared(), *self.tied()]

    def geared(self) -> Iterator[tuple[LinearForm, FloatArray]]:
        """Yield the equations of gears: what a joint and the bodies it follows, and cranks on one stroke, give does no work."""
        poses = self.poses
        for gear in self.structure.gears:
            factors = [poses.flattened(poses.motion._placed.value(each)) ** power for power, each in gear.factors]
            own = self.unknown(gear.joint, gear.letter, 1.0).multiplied(reduce(np.multiply, factors, poses.zeros() + gear.sign))
            yield self.unknown(gear.contact, "c", 1.0).plus(own), poses.zeros()
        for stroke in sorted(self.structure.holders.strokes_taken.intersection(set[str]().union(*self.structure.geared))):
            forms = [force.multiplied(ratio) for ratio, force in self.step_drives(stroke)]
            yield reduce(LinearForm.plus, forms), poses.zeros()

    def given_thrust(self, member: TwoPoint) -> FloatArray:
        """Return the thrust (n,) that laws give a member, beside that of a line whose pressure answers."""
        laws = [self.poses.flattened(each.thrust) for each in self.structure.thrusts if same(member, each.member)]
        return reduce(np.add, laws, self.poses.zeros())

    def push(self, line: PressureLine, u: FloatArray, q: FloatArray) -> FloatArray:
        """Return the thrust of a line's first cylinder beside what laws give it (n,) [N], of joint forces and frictions."""
        first = next(each for each in self.structure.struts if each.line is line)
        return self.thrust(first).at(u[:, : self.width], q) - self.given_thrust(line.cylinders[0])

    def tied(self) -> Iterator[tuple[LinearForm, FloatArray]]:
        """Yield the equations of members on ties, whose thrusts follow fewer forces."""
        ties = [line for line in self.structure.holders.every_line if line.tie is not None and line.tie.run is None]
        if not ties:
            return
        members = [each for each in self.structure.holders.every_cylinder if any(is_among(each, line.cylinders) for line in ties)]
        forms = [self.thrust(next(strut for strut in self.structure.struts if strut.name == member_title(each))) for each in members]
        given = [*map(self.given_thrust, members)]
        shares = [share_of(each, ties, [areas(line, self.poses, 1) for line in ties]) for each in members]
        none = self.poses.zeros()
        rows = [[none if each is None else each for each in row] for row in shares]
        pivots = tie_pivots(self.structure.plan, [line.tie for line in ties if line.tie is not None], members)
        for place, form in enumerate(forms):
            if place not in [row for row, _ in pivots]:
                own = [rows[place][column] for _, column in pivots]
                factors = solution_of_few([[rows[row][column] for row, _ in pivots] for _, column in pivots], own)
                others = [forms[row].multiplied(-1.0 * factor) for factor, (row, _) in zip(factors, pivots, strict=True)]
                right = reduce(np.subtract, (factor * given[row] for factor, (row, _) in zip(factors, pivots, strict=True)), given[place])
                yield reduce(LinearForm.plus, others, form), right
