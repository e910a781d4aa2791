"""The equations of equilibrium: A u + B q + l = 0, with the joint forces u and the friction q, at every pose at once.

Each body has three rows (forces along x and y, moment about its first point over a length), a lone pin two. Friction in joints: which way
it acts, and its size, found together with the joint forces that it comes from.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import field
from functools import cached_property, reduce

import numpy as np

from ..errors import DefinitionError, ensure
from ..frozen import record
from ..loads import Friction, Load, Rates, TwoPoint
from ..plan import Mask
from ..program import FloatArray
from ..quantities import Distance, Quantity, name_of
from .applied import member_title
from .holding import PressureLine, areas, is_among, same, share_of, solution_of_few, tie_pivots
from .joints import FRAME, Contact, Structure, Strut, UnitWrench, Wrench, follows_points, force_direction, wrenches
from .poses import FlatPoses, cross, over_zero, quarter_turned

# Friction solved to consistency: the joint forces make it, and it makes the joint forces.
#
# Every joint with friction has a friction q = coefficient * |F|, with F = F0 + G q the force it comes from. Where the coefficients times
# the sizes of G add up to less than 1 in every row, that is a contraction: it has one solution, and plain iteration comes to it. Elsewhere
# the coefficients grow from zero to their value, and Newton's method follows the solution. Where the Jacobian's determinant comes to
# zero on the way the forces grow beyond all bounds: the mechanism jams, or locks itself.


STEPS = 16
ROUNDS = 40
CONTRACTS = 0.7
"""The row sum up to which plain iteration is quick: some 80 rounds to the last digit at the most, mostly 10."""
UNCHANGED = 4e-15
"""A friction that changes by less than this part of the largest stays."""
BLOCK = 1024
SLOWEST = 1e-10
"""Turning slower than this part of the fastest in the mechanism is none."""


def pressing_rows(parts: Sequence[int]) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return the first and the last row of the forces that press each joint with friction: a pin has two `parts`, a guide one.

    The third is what the hypotenuse of both rows counts (frictions, 1): of a single row, counted twice, the half of its square.
    """
    first, counts = np.cumsum([0, *parts[:-1]]), np.asarray(parts)
    return first, first + counts - 1, np.where(counts == 2, 1.0, np.sqrt(0.5))[:, None]


@record
class PressingForces:
    """The forces that make the frictions: without any (rows, n), and by each friction of one unit (rows, frictions, n).

    `parts` are the rows of each friction, one or two; `lever` (frictions, n) says how many units a friction of 1 N is, signed.
    """

    parts: tuple[int, ...]
    free: FloatArray
    by_unit: FloatArray
    lever: FloatArray

    def at(self, places: Mask | slice) -> PressingForces:
        """Return the same at some poses."""
        return PressingForces(self.parts, self.free[:, places], self.by_unit[:, :, places], self.lever[:, places])

    def forces(self, q: FloatArray) -> FloatArray:
        """Return the pressing forces (rows, n) at some frictions (frictions, n) [N]."""
        return np.asarray(np.einsum("rjn,jn->rn", self.by_unit, q * self.lever) + self.free)


def consistent_frictions(pressing: PressingForces, coefficient: FloatArray) -> tuple[FloatArray, Mask]:
    """Return the frictions (frictions, n) [N] for coefficients (frictions, n), and where they have no bounded solution (n,)."""
    q, locked = np.zeros(coefficient.shape), np.zeros(coefficient.shape[1], bool)
    first, last, share = pressing_rows(pressing.parts)
    for start in range(0, coefficient.shape[1], BLOCK):
        block = slice(start, start + BLOCK)
        here, mu = pressing.at(block), coefficient[:, block]
        size = np.hypot(here.by_unit[first], here.by_unit[last]) * share[:, :, None]
        hard = ~(np.max(mu * np.einsum("rjn,jn->rn", size, np.abs(here.lever)), axis=0, initial=0.0) < CONTRACTS)
        if not hard.all():
            with np.errstate(over="ignore", invalid="ignore"):  # of poses that do not contract
                q[:, block] = by_iteration(pressing.parts, mu, here.forces)
        if hard.any():
            q[:, block][:, hard], locked[block][hard] = continued(here.at(hard), mu[:, hard])
    return q, locked


def by_iteration(parts: Sequence[int], coefficient: FloatArray, forces: Callable[[FloatArray], FloatArray]) -> FloatArray:
    """Return the frictions (frictions, n) to which plain iteration comes, where it contracts, with the pressing forces at frictions."""
    first, last, share = pressing_rows(parts)
    q, factor = np.zeros(coefficient.shape), share * coefficient
    for _ in range(100):
        force = forces(q)
        x, y = force[first], force[last]
        new = np.sqrt(x * x + y * y) * factor  # np.hypot costs five times as much
        change, largest = np.abs(new - q), np.max(new, axis=0, initial=0.0)
        q = new
        if not np.any(change > UNCHANGED * largest):
            break
    return q


def continued(pressing: PressingForces, coefficient: FloatArray) -> tuple[FloatArray, Mask]:
    """Return the frictions (frictions, n) that grow from none with the coefficients, NaN where they jam on the way, and where (n,)."""
    free, by_unit = pressing.free.T, np.moveaxis(pressing.by_unit * pressing.lever, -1, 0)
    first, last, _ = pressing_rows(pressing.parts)
    forces = [(free[:, a : b + 1], by_unit[:, a : b + 1]) for a, b in zip(first, last, strict=True)]
    q, alive = np.zeros(coefficient.T.shape), np.ones(coefficient.shape[1], bool)
    for share in np.linspace(0.0, 1.0, STEPS + 1)[1:]:
        q[alive], good = newton(q[alive], share * coefficient.T[alive], [(F[alive], G[alive]) for F, G in forces])
        alive[alive] = good
    return np.where(alive[:, None], q, np.nan).T, ~alive


def newton(q: FloatArray, coefficient: FloatArray, pressing: list[tuple[FloatArray, FloatArray]]) -> tuple[FloatArray, Mask]:
    """Return the frictions for some coefficients, and where Newton's method came to them on the same side of jamming."""
    unit = np.eye(q.shape[1])

    def at(q: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the sizes of the pressing forces (n, frictions), the residuals, and the Jacobian (n, frictions, frictions)."""
        forces = [F + (G * q[:, None]).sum(axis=2) for F, G in pressing]
        size = np.stack([np.sqrt((F * F).sum(axis=1)) for F in forces], axis=1)
        slopes = [(F[:, :, None] * G).sum(axis=1) for F, (_, G) in zip(forces, pressing, strict=True)]
        slope = np.stack(slopes, axis=1) / np.where(size > 0.0, size, 1.0)[:, :, None]
        return size, q - coefficient * size, unit - coefficient[:, :, None] * slope

    good: Mask = np.ones(len(q), bool)
    for _ in range(ROUNDS):
        _, miss, J = at(q)
        good = np.linalg.det(J) > 0.0
        step = np.linalg.solve(np.where(good[:, None, None], J, unit), -miss[:, :, None])[:, :, 0]
        q = q + np.where(good[:, None], step, 0.0)
        if np.all(np.abs(step[good]) <= 1e-13 * (1.0 + np.abs(q[good]).max(axis=1, keepdims=True))):
            break
    size, miss, J = at(q)
    close = np.abs(miss).max(axis=1) <= 1e-10 * (size.max(axis=1) + np.finfo(float).tiny)
    return q, good & close & (np.linalg.det(J) > 0.0)


# The joints with friction: which way, at what rate, and the unit wrench of their friction.


@record
class JointFriction:
    """A joint with friction: the wrench of a friction of 1 N, its coefficient (n,), its rate by the stroke (n,), >= 0.

    `lever` is the couple [m] on a pin's body, or the force along the guide [1], of that friction, signed (n,).
    """

    unit: UnitWrench
    coefficient: FloatArray
    rate: FloatArray
    lever: FloatArray

    @property
    def contact(self) -> Contact:
        """The joint."""
        return self.unit.contact

    @classmethod
    def of_unit(cls, contact: Contact, poses: FlatPoses) -> JointFriction:
        """Return that of a joint whose size and sense come later. It is a couple of 1 Nm at a pin, a force of 1 N along a guide."""
        none, turns = np.zeros((2, poses.count)), contact.kind == "pin"
        force = none if turns else force_direction(contact, "t", poses)
        return cls(UnitWrench(contact, Wrench(poses.at(contact.point), force, none[0] + float(turns))), none[0], none[0], none[0])


def joint_frictions(structure: Structure, poses: FlatPoses, frictions: tuple[Friction, ...], rates: Rates) -> list[JointFriction]:
    """Return the joints with friction while strokes move; DefinitionError for friction where nothing turns or slides."""
    speeds = Speeds(structure, poses, rates)
    found: list[JointFriction] = []
    for friction in frictions:
        at_point = [each for each in structure.contacts if each.point == friction.point]
        joints = [each for each in at_point if (each.track if friction.radius is None else each.kind == "pin")]
        names = {each: (each.owner, *each.track, *each.joint.track) for each in joints}  # what its line goes by
        joints = [each for each in joints if not friction.guide or friction.guide in names[each]]
        if not joints:
            what = "no pin joint" if friction.radius is not None else f"nothing that slides on {friction.guide or 'a guide'}"
            remedy = "name another point"
            if friction.radius is not None and friction.point in {point for point, _ in structure.running}:
                remedy = f"declare the block that slides there as a body, Link of {friction.point} and a second point on the guide"
            text = f"{structure.plan.title}: there is {what} at {friction.point}: no friction arises; {remedy}."
            raise DefinitionError(text)
        found += [friction_in(contact, friction, speeds) for contact in joints]
    return found


def friction_in(contact: Contact, friction: Friction, speeds: Speeds) -> JointFriction:
    """Return the friction of a joint: of a pin a couple against the turning of its bodies, of a guide a force against the sliding."""
    poses = speeds.poses
    place, none = poses.at(contact.point), np.zeros((2, poses.count))
    coefficient = poses.flattened(friction.coefficient)
    if friction.radius is not None:
        rate = speeds.spin(contact.on) - speeds.spin(contact.by)
        sign = np.where(np.abs(rate) > SLOWEST * speeds.fastest, np.sign(rate), 0.0)
        radius = poses.flattened(friction.radius)
        wrench = Wrench(place, none, -sign * radius)
        return JointFriction(UnitWrench(contact, wrench), coefficient, radius * np.abs(rate), wrench.couple)
    t = force_direction(contact, "t", poses)
    has_slot = contact.joint.on.role == "slider" and contact.point not in contact.joint.on.points  # of the body `on`, as a cross slot
    point, by = speeds.point(contact.point), speeds.material(contact.on if has_slot else contact.by, place, contact)
    if has_slot:
        point, by = by, point
    rate = ((point - by) * t).sum(axis=0)
    sign = np.where(np.abs(rate) > SLOWEST * (np.abs(point).max(axis=0) + np.abs(by).max(axis=0)), np.sign(rate), 0.0)
    return JointFriction(UnitWrench(contact, Wrench(place, -t * sign, none[0])), coefficient, np.abs(rate), -sign)


class Speeds:
    """How bodies turn and points slide while strokes move."""

    def __init__(self, structure: Structure, poses: FlatPoses, rates: Rates) -> None:
        self.structure, self.poses = structure, poses
        self.rates = {name: poses.flattened(rate) for name, rate in rates.items()}
        self._points: dict[str, FloatArray] = {}
        self._spins: dict[int, FloatArray] = {}

    def point(self, name: str) -> FloatArray:
        """Return a point's velocity, shape (2, n) [m/s, or per unit of the drive]."""
        if name not in self._points:
            parts = [self.poses.rate(name, stroke) * rate for stroke, rate in self.rates.items()]
            self._points[name] = sum(parts, np.zeros((2, self.poses.count)))
        return self._points[name]

    def material(self, body: int, place: FloatArray, contact: Contact) -> FloatArray:
        """Return the velocity of a body's material at a place, shape (2, n): of a cylinder on the side that a contact goes with."""
        if body == FRAME:
            return np.zeros((2, self.poses.count))
        bodies = len(self.structure.bodies)
        start = self.structure.bodies[body].points[0] if body < bodies else self.structure.lone[body - bodies]
        if any(each.host and self.structure.body_of(each) == body for each in self.structure.struts):
            start = self.structure.seat(contact, body)
        return self.point(start) + quarter_turned(place - self.poses.at(start)) * self.spin(body)

    def spin(self, body: int) -> FloatArray:
        """Return a body's angular velocity, shape (n,) [rad/s, or per unit of the drive]."""
        if body not in self._spins:
            axis, self._spins[body] = self.axis(body), np.zeros(self.poses.count)
            if axis is not None:
                arm, rate = (at(axis[1]) - at(axis[0]) for at in (self.poses.at, self.point))
                self._spins[body] = np.asarray(cross(arm, rate) / (arm[0] ** 2 + arm[1] ** 2))
        return self._spins[body]

    @cached_property
    def fastest(self) -> float:
        """The largest turning of any body at any pose."""
        return max(float(np.max(np.abs(self.spin(body)), initial=0.0)) for body in range(FRAME, len(self.structure.bodies)))

    def axis(self, body: int) -> tuple[str, str] | None:
        """Return two points that turn with a body, or with its track where it slides without turning; None if neither turns."""
        if body == FRAME or body >= len(self.structure.bodies):
            return None
        if self.structure.bodies[body].slides:
            return next((self.axis(each.by) for each in self.structure.contacts if "c" in each.holds and each.on == body), None)
        return self.structure.bodies[body].axis


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
        structure, poses = self.structure, self.poses
        for strut in structure.struts:
            if strut.known is None and strut.quantity is None:
                yield poses.growth(strut.P, strut.Q, stroke), self.thrust(strut)
            elif strut.known is None and strut.quantity is not None and self.follows(strut.quantity, stroke):
                yield self.ratio(strut.quantity, stroke), self.thrust(strut)
        for contact in structure.contacts:
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
        for stroke in sorted(set[str]().union(*self.structure.geared)):
            forms = [force.multiplied(ratio) for each in self.structure.contacts for ratio, force in self.driven(each, stroke)]
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
