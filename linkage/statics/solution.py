"""The equations of equilibrium solved on arrays, all poses in one call; and the words where there is no solution."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from functools import cached_property, partial
from itertools import combinations

import numpy as np

from ..errors import DefinitionError, SingularError, one_word, unwarned
from ..frozen import record
from ..language import ENGLISH, current_language, language, said, translated
from ..loads import PLAIN_CASE, Acting, ForceElement, Load, Push, Rates, TwoPoint
from ..motion import Motion, require_motion
from ..motion.evaluation import examined
from ..motion.grid import recalled
from ..motion.limits import where_said, where_words
from ..motion.requests import point_ratios
from ..plan import NEAR, Mask, Plan
from ..program import FloatArray, elementwise
from .applied import Anywhere, AppliedLoads, member_title, motion_in_case
from .equilibrium import LinearForm, System
from .friction import JointFriction, PressingForces, Speeds, consistent_frictions, joint_frictions
from .holding import check_kept, closed_ties, holders_of, sampled
from .joints import Contact, NotHeldError, Structure, acting_place, force_direction
from .poses import FlatPoses, quarter_turned

SPLITS = ("refuse", "least squares")
RANK = 1e-9  # singular values below this part of the largest count as zero
LEAST = 1e-200
"""N or Nm: less than this is no force; numbers next to the smallest there are have few digits."""


@record
class PoseForces:
    """All forces of a motion: each contact's force (2, ...) and couple (...), the drives' and the members' thrusts (...).

    `q` are the frictions (frictions, n) [N] of the joints with friction, `locked` where friction leaves no bounded ones (n,).
    """

    structure: Structure
    poses: FlatPoses
    applied: AppliedLoads
    frictions: Sequence[JointFriction]
    q: FloatArray
    locked: Mask
    contacts: list[tuple[FloatArray, FloatArray]]
    drives: Mapping[str, FloatArray]
    thrusts: Mapping[str, FloatArray]
    runs: Mapping[str, FloatArray] = field(default_factory=dict)
    """The forces of ropes by their names."""

    @property
    def tensions(self) -> Mapping[str, FloatArray]:
        """The tensions of ropes by their names, shape (...) [N]."""
        found: dict[str, FloatArray] = {}
        for name, run in self.structure.holders.reeved.items():
            force = self.runs[name]
            found[name] = np.maximum(-1.0 * force, 0.0) if run.back else -1.0 * force
            if run.back:
                found[run.back] = np.maximum(force, 0.0) * run.back_share(self.poses.motion)
        return found

    def run_loads(self) -> Iterator[Load]:
        """Yield the forces of ropes on the points that they run over."""
        motion = self.poses.motion
        for name, run in self.structure.holders.reeved.items():
            force = self.runs[name]
            own = np.minimum(force, 0.0) if run.back else force
            yield from (replace(load, force=np.asarray(load.force * own), element=name) for load in run.loads(motion))
            if run.back:
                back = np.maximum(force, 0.0)
                backs = run.back_loads(motion)
                yield from (replace(load, force=np.asarray(load.force * back), element=run.back) for load in backs)


def by_equations(poses: FlatPoses, applied: AppliedLoads, split: str) -> PoseForces:
    """Return the forces by the equations solved on arrays."""
    system = system_with_friction(poses, applied)
    structure, full = system.structure, poses.full
    found = solved(system, split, (1,) * len(structure.holders.lines))
    ropes = structure.holders.reeved
    pushed = {name: found.value(system.run(k)) > 0.0 for k, (name, run) in enumerate(ropes.items()) if run.back}
    if any(each.any() for each in pushed.values()):
        system = replace(system, pushed=pushed)
        found = Equilibrium(system, split).solution()
    result = PoseForces(
        structure, poses, applied, system.frictions, found.q.T, found.locked,
        [(full(force), full(couple)) for force, couple in map(found.transmitted, structure.contacts)],
        {name: full(found.value(system.drive(name))) for name in poses.motion.strokes},
        {each.name: full(found.value(system.thrust(each))) for each in structure.struts},
        {name: full(found.value(system.run(k))) for k, name in enumerate(ropes)},
    )  # fmt: skip
    check_joints(structure, poses)
    return result


def solved(system: System, split: str, senses: tuple[int, ...], start: int = 0) -> Solution:
    """Return the solution in some senses of lines; of those from `start` that change shares again where their first cylinders pull."""
    lines = system.structure.holders.lines
    place = next((k for k in range(start, len(lines)) if lines[k].changes_shares), None)
    if place is None:
        return Equilibrium(system, split, senses).solution()
    found = solved(system, split, senses, place + 1)
    pulls = system.push(lines[place], found.u, found.q) < 0.0
    if not pulls.any():
        return found
    other = solved(system, split, (*senses[:place], -1, *senses[place + 1 :]), place + 1)
    u, q = (np.where(pulls[:, None], a, b) for a, b in ((other.u, found.u), (other.q, found.q)))
    return Solution(system, u, q, np.where(pulls, other.locked, found.locked))


def system_with_friction(poses: FlatPoses, applied: AppliedLoads) -> System:
    """Return the equations' system with its joints with friction."""
    structure = structure_of(poses.plan, applied.elements, applied.thrusts)
    frictions = joint_frictions(structure, poses, applied.frictions, applied.rates) if applied.frictions else []
    return System(structure, poses, applied.loads, frictions)


@record
class Solution:
    """Joint forces u (n, columns) and frictions q (n, frictions) [N]; `locked` where friction leaves no bounded ones (n,)."""

    system: System
    u: FloatArray
    q: FloatArray
    locked: Mask

    @property
    def poses(self) -> FlatPoses:
        """The poses they are at."""
        return self.system.poses

    @property
    def frictions(self) -> Sequence[JointFriction]:
        """The joints with friction."""
        return self.system.frictions

    def value(self, form: LinearForm) -> FloatArray:
        """Return a linear form of the forces, shape (n,)."""
        return form.at(self.u[:, : self.system.width], self.q)

    def transmitted(self, contact: Contact) -> tuple[FloatArray, FloatArray]:
        """Return the force (2, n) [N] and the couple (n,) [Nm] of a joint on its body, friction included."""
        force, couple = np.zeros((2, self.system.poses.count)), np.zeros(self.system.poses.count)
        first = self.system.first[contact]
        pairs = [(column, self.u[:, first + k]) for k, column in enumerate(self.system.unknowns[first : first + len(contact.holds)])]
        pairs += [(each.unit, self.q[:, k]) for k, each in enumerate(self.frictions) if each.contact == contact]
        for column, size in pairs:
            force, couple = force + column.wrench.force * size, couple + column.wrench.couple * size
        return force, couple


def locked_words(found: PoseForces | Solution, direction: str) -> list[str]:
    """Return the words for poses that friction locks; raise them where NaN was not asked for."""
    if not found.locked.any():
        return []
    motion, mask = found.poses.motion, found.poses.mask(found.locked)
    points = ", ".join(dict.fromkeys(each.contact.point for each in found.frictions))
    with language(ENGLISH if motion.unreachable == "raise" else current_language()):
        text = said(
            "{title} locks itself while {direction} {where}: with the friction at {points} no bounded drive force moves it. Lower the "
            "friction, or make the transmission angles larger.",
            title=motion.plan.title, direction=translated(direction.removeprefix("as ")),
            where=where_said(motion.plan, mask, motion.strokes), points=points,
        )  # fmt: skip
    if motion.unreachable == "raise":
        raise SingularError(text, mask=mask, motion=motion)
    return [text]


@record
class Equilibrium:
    """A system with the equations of its thrusts, and a column for each support that replaces a known drive force.

    `senses` are 1 where the first cylinders of lines push, -1 where they pull; `given` are forms whose values are known besides.
    """

    system: System
    split: str = "refuse"
    senses: tuple[int, ...] = ()
    given: tuple[tuple[LinearForm, FloatArray], ...] = ()
    supports: FloatArray | None = None

    @cached_property
    def bound(self) -> list[tuple[LinearForm, FloatArray]]:
        """The forms whose values are known."""
        return [*self.system.known(self.senses), *self.given]

    @cached_property
    def A(self) -> FloatArray:
        """All rows of the unknowns, shape (n, rows, columns)."""
        upper, free = self.system.A, 0
        if self.supports is not None:
            upper, free = np.concatenate([upper, self.supports], axis=2), int(self.supports.shape[2])
        rows = [np.concatenate([form.row, self.system.poses.zeros(free)], axis=1)[:, None] for form, _ in self.bound]
        return np.concatenate([upper, *rows], axis=1)

    @cached_property
    def right(self) -> FloatArray:
        """The right sides: of the loads, and of each friction, shape (n, rows, 1 + frictions)."""
        loads = np.concatenate([-self.system.load_rows, *((value - form.rest)[:, None] for form, value in self.bound)], axis=1)
        frictions = np.concatenate([-self.system.B, *(-form.friction[:, None] for form, _ in self.bound)], axis=1)
        return np.concatenate([loads[:, :, None], frictions], axis=2)

    def solution(self) -> Solution:
        """Return the forces at which friction and joint forces agree; errors as `solve`."""
        system, frictions, poses = self.system, self.system.frictions, self.system.poses
        found = self.solve()
        start, spread = found[:, :, 0], found[:, :, 1:]  # u = start + spread q
        if not frictions:
            return Solution(system, start, np.zeros((poses.count, 0)), np.zeros(poses.count, bool))
        parts = tuple(each.contact.presses for each in frictions)
        rows = [system.first[each.contact] + k for each, count in zip(frictions, parts, strict=True) for k in range(count)]
        by_unit, lever = np.moveaxis(spread[:, rows], 0, -1), np.ones((len(frictions), poses.count))
        pressing = PressingForces(parts, start[:, rows].T, by_unit, lever)
        forces, locked = consistent_frictions(pressing, np.stack([each.coefficient for each in frictions]))
        return Solution(system, start + (spread * forces.T[:, None]).sum(axis=2), forces.T, locked)

    def solve(self) -> FloatArray:
        """Return the joint forces without friction and by each friction of 1 N, shape (n, columns, 1 + frictions).

        Raises DefinitionError where bodies hang loose or links are redundant, SingularError at some poses.
        """
        n, rows, columns = self.A.shape
        if n == 0:
            return np.zeros((0, columns, 1 + len(self.system.frictions)))
        self.check()
        found = self.square() if rows == columns else np.linalg.pinv(self.A, rcond=RANK) @ self.right
        with np.errstate(invalid="ignore", over="ignore"):
            miss = np.abs(self.A @ found - self.right).max(axis=(1, 2))
            size = np.abs(self.A).max(axis=(1, 2)) * np.abs(found).max(axis=(1, 2)) + np.abs(self.right).max(axis=(1, 2))
            bad = ~(miss <= 1e-6 * size + LEAST)
        bad &= size > 0.0
        if bad.any():
            poses, plan = self.system.poses, self.system.structure.plan
            mask = poses.mask(bad)
            where = where_words(plan, mask, poses.motion.strokes)
            text = f"{plan.title}: the joints cannot hold the loads {where}: the pose is singular. Leave it out."
            raise SingularError(text, mask=mask, motion=poses.motion)
        return found

    def square(self) -> FloatArray:
        """Return the solution of as many equations as unknowns; NaN where one pose has none."""
        try:
            return np.asarray(np.linalg.solve(self.A, self.right))
        except np.linalg.LinAlgError:
            sound = np.linalg.matrix_rank(self.A) == self.A.shape[1]
            found = np.full(self.right.shape, np.nan)
            found[sound] = np.linalg.solve(self.A[sound], self.right[sound])
            return found

    # -- why there is none ---------------------------------------------------------------------------------

    def check(self) -> None:
        """Raise DefinitionError for a mechanism with loose bodies, or with redundant links unless a split is asked for."""
        one_word("split", self.split, SPLITS)
        if self.lacks:
            raise NotHeldError(self.loose_words())
        columns = self.A.shape[2]
        if self.split == "refuse" and self.rank < columns:
            raise DefinitionError(self.redundant_words(columns - self.rank))

    @cached_property
    def rank(self) -> int:
        """The rank of the equations."""
        return rank_of(self.sample)

    @property
    def lacks(self) -> int:
        """In how many ways bodies can still move."""
        return int(self.A.shape[1]) - self.rank

    @cached_property
    def sample(self) -> FloatArray:
        """The equations at three poses, which give their rank."""
        n = len(self.A)
        return self.A[sorted({0, n // 3, (2 * n) // 3, n - 1})]

    def redundant_words(self, count: int) -> str:
        """Return the redundant links: those without which the others still hold everything."""
        system, structure, spare = self.system, self.system.structure, []
        for body, part in enumerate(structure.bodies):
            gone = [index for index, column in enumerate(system.unknowns) if body in (column.contact.on, column.contact.by)]
            rows = list(range(system.starts[body], system.starts[body + 1]))
            left = np.delete(np.delete(self.sample, gone, axis=2), rows, axis=1)
            if left.size > 0 and rank_of(left) == left.shape[1]:
                spare.append(f"link {part.name}")
        for contact in structure.contacts:
            if contact.kind == "guide":
                left = np.delete(self.sample, system.first[contact], axis=2)
                spare += [f"the guide of {contact.point}"] if rank_of(left) == left.shape[1] else []
        what = f"{structure.plan.title} is overconstrained, {count} joint force{'s' * (count > 1)} too many"
        motion = sampled(structure.plan)
        for P, Q in (pair for body in structure.bodies if len(body.points) > 2 for pair in combinations(body.points, 2)):
            first, *others = motion.distance(P, Q).ravel()
            if any(abs(each - first) > 1e-6 * first for each in others):
                return f"{what}. {P}{Q} changes, so that an OnLink({P}, {Q}, ...) is on no body; name two points of one."
        found = f"Redundant is one of these, without which it is still held: {', '.join(spare) or 'none alone'}"
        return f'{what}. {found}. Take one out, or ask for split="least squares".'

    def loose_words(self) -> str:
        """Return the bodies that nothing holds, the lines of the class that place them, and the remedy."""
        loose, structure = list(self.loose()), self.system.structure
        plan, shared = structure.plan, [[each.name for each in line.cylinders] for line in structure.holders.lines]
        names = f"{', '.join(loose[:-1])} and {loose[-1]} are" if len(loose) > 1 else f"{''.join(loose)} is"
        ways = f"with its drives locked it can still move in {self.lacks} way{'s' if self.lacks > 1 else ''}"
        line = next((each for each in shared if len({*each} & {*loose}) > 1), None)
        if line is not None:
            what = f"{' and '.join(line)} share one pressure, which holds the sum of what they move and not each"
            remedy = f"{what}: couple what they move by a link, or give each a stroke and a pump of its own."
        else:
            points = dict.fromkeys(point for body in structure.bodies if body.name in loose for point in body.points)
            lines = "; ".join(f"{point} = {plan.points[point]}" for point in points if point in plan.moving)
            remedy = (
                f"{f'Look at {lines}. ' if lines else ''}A triangle in which another side changes than is meant, a Turn(...) without its "
                "length=, or an OnLink on a distance that changes holds nothing. Declare what holds: Link(...) for bodies placed by "
                "Offset, a cylinder by Dyad(..., AB=...), joints() of a step of one's own."
            )
        return f"{plan.title}: {ways}: {names} held by nothing. {remedy}"

    def loose(self) -> Iterator[str]:
        """Yield the bodies that move when all joints hold."""
        for body in range(len(self.system.starts) - 1):
            if np.abs(self.ways[self.system.starts[body] : self.system.starts[body + 1]]).max(initial=0.0) > 1e-6:
                yield self.system.structure.name(body)

    @cached_property
    def ways(self) -> FloatArray:
        """The motions that all joints allow at the first pose, shape (rows, ways): they do no work against any joint force."""
        rows = self.system.starts[-1]
        u, s, _ = np.linalg.svd(self.sample[0])
        return np.asarray(u[:rows, int((s > RANK * s.max(initial=0.0)).sum()) :])


def rank_of(matrices: FloatArray) -> int:
    """Return the largest rank among some matrices, shape (k, rows, columns)."""
    if 0 in matrices.shape[1:]:
        return 0
    values = np.linalg.svd(matrices, compute_uv=False)
    return int((values > RANK * values[:, :1]).sum(axis=1).max())


# Whether forces agree with the motion: joints must not do work where they hold, and the drives' forces must be those by virtual work.
#
# The joints of a step of one's own are as good as what its `joints()` says. Where two bodies move against each other in a direction that
# a joint holds, its force would do work, and the equilibrium would be that of another machine. That is looked at wherever joint forces
# are: on arrays here, in a program as one more assumption.


AGREES = 1e-6
"""A disagreement below this part counts for none."""
MARGIN = 10.0
"""Nor does one of less than so many times the relative error that a pose has by itself."""
ROUGHLY = 1e-4
"""The part in a program next to a singular pose, whose error it does not know: up to the poses that are refused it is below."""
STILL = 1e-9
"""m or rad a unit of a stroke: slower than this nothing moves."""


@record
class Slip:
    """The slip of two bodies in a direction that their joint holds, beyond its drives, on a unit of a stroke.

    `way` and `driven` (n,) in m, of a couple in rad; `size` is how fast both bodies move there (n,).
    """

    contact: Contact
    letter: str
    stroke: str
    way: FloatArray
    driven: FloatArray
    size: FloatArray

    @property
    def miss(self) -> FloatArray:
        """The slip that the drives do not explain (n,)."""
        return np.asarray(np.abs(self.way - self.driven))


def slips(structure: Structure, poses: FlatPoses) -> Iterator[Slip]:
    """Yield the slips in joints of steps from other packages, by each stroke and in each direction that they hold."""
    members = structure.plan.members
    own = [each for each in structure.contacts if each.owner and type(members[each.owner]).__module__.split(".")[0] != "linkage"]
    system = System(structure, poses, (), length=1.0)
    for stroke in structure.plan.strokes if own else ():
        speeds = Speeds(structure, poses, Rates({stroke: 1.0}))
        for contact in own:
            yield from slips_in(contact, system, speeds, stroke)


def slips_in(contact: Contact, system: System, speeds: Speeds, stroke: str) -> Iterator[Slip]:
    """Yield the slips of one joint by a stroke; none where a drive along a curve of the frame follows its point."""
    poses, drives = system.poses, list(system.structure.drives(contact))
    place = acting_place(contact, poses)
    on, by = (speeds.material(body, place, contact) for body in (contact.on, contact.by))
    spins = speeds.spin(contact.on), speeds.spin(contact.by)
    for letter in contact.holds:
        own = [(quantity, sign) for quantity, along, sign in drives if along == letter]
        follows = contact.is_curve and letter != "c"  # a drive along a curve of the frame follows its point
        ratios = [system.ratio(each, stroke) * sign for each, sign in own if not follows and system.follows(each, stroke)]
        driven = sum(ratios, poses.zeros())
        if letter == "c":
            yield Slip(contact, letter, stroke, spins[0] - spins[1], driven, np.abs(spins[0]) + np.abs(spins[1]))
        elif not (follows and own):
            way = ((on - by) * force_direction(contact, letter, poses)).sum(axis=0)
            yield Slip(contact, letter, stroke, way, driven, np.hypot(on[0], on[1]) + np.hypot(by[0], by[1]))


def assumed_joints(structure: Structure, poses: FlatPoses) -> list[FloatArray]:
    """Return numbers of a program, each shape (1,), above zero where joints hold their directions, exactly or roughly and near."""
    found, plan = list(slips(structure, poses)), structure.plan
    if not found:
        return []
    near = NEAR - poses.flattened(poses.motion._array(np.asarray(plan.trace.nearness(plan.members), object)))
    exactly, roughly = ([part * (slip.size + STILL) - slip.miss for slip in found] for part in (AGREES, ROUGHLY))
    return [elementwise(np.maximum, (a, elementwise(np.minimum, (b, near)))) for a, b in zip(exactly, roughly, strict=True)]


def check_joints(structure: Structure, poses: FlatPoses) -> None:
    """Raise DefinitionError, by name, for a joint of a step of one's own in which forces would do work at some poses."""
    for slip in slips(structure, poses):
        rates = [np.hypot(*poses.rate(name, slip.stroke)) for name in structure.plan.moving]
        size = slip.size + 1e-3 * np.max(rates, axis=0, initial=STILL)
        bad = disagreeing(poses, slip.miss, AGREES * size, size)
        if not bad.any():
            continue
        contact, plan, worst = slip.contact, structure.plan, int(np.argmax(np.where(bad, slip.miss, -1.0)))
        unit = "rad" if slip.letter == "c" else "m"
        drives = f" where its drives say {slip.driven[worst]:.4g} {unit}" if slip.driven.any() else ""
        where = where_words(plan, poses.mask(bad), poses.motion.strokes)
        joint = f"{contact.owner}.joints(): the joint {contact.kind!r} at {contact.point}"
        raise DefinitionError(
            f"{plan.title}: {joint} holds {slip.letter!r} between {structure.name(contact.on)} and {structure.name(contact.by)}, but there "
            f"they move against each other by {slip.way[worst]:.4g} {unit} a unit of {slip.stroke}{drives}, {where}: its force would do "
            "work, and pin forces would not agree with virtual work. A force acts at the origin of line=: let that be where the bodies "
            "touch, let holds= be a direction in which they do not move against each other, and name in drives= what a stroke moves."
        )


def disagreeing(poses: FlatPoses, miss: FloatArray, limit: FloatArray | float, size: FloatArray | float) -> Mask:
    """Return where a miss (n,) is above its limit, and above the rounding of the poses in a result of some size."""
    bad = np.asarray(~(miss <= limit))
    if bad.any():
        motion, mask = require_motion(poses.motion), poses.mask(bad)
        what = point_ratios(set(poses.plan.members))
        (found,) = examined(poses.plan, (what,), motion._grid.inputs_at(mask), motion._grid.read_at(mask), [0])
        bad[bad] = ~(miss[bad] <= MARGIN * np.nan_to_num(found.error, nan=0.0) * np.broadcast_to(size, bad.shape)[bad])
    return bad


# Whether a machine is held: with its drives locked and its cylinders holding no body can move, and its closed lines let it move at all.
#
# The rank of the equilibrium of bodies at some poses tells the first, once a class and state of its lines. The numbers of the designs tell
# the second. Where it is not held every force is refused in these words, whatever method works it out; places are not.


@record
class Looseness:
    """The loose bodies while the drives are locked: their names and a sentence; empty where all are held.

    `is_geared`: whether they are held since cranks that follow one stroke, which a cylinder takes over, are geared to each other.
    """

    bodies: tuple[str, ...] = ()
    sentence: str = ""
    is_geared: bool = False


def looseness(plan: Plan) -> Looseness:
    """Return the loose bodies of a machine, cached by class and state of its lines; none where joint forces are not provided."""

    def made(_: Plan) -> Looseness:
        with unwarned():
            try:
                equations = locked_equations(sampled(plan))
                geared = locked_equations(sampled(plan), is_geared=True) if equations is not None and equations.lacks else None
            except DefinitionError as error:  # no cylinder where none is wanted, or points that keep no place
                return Looseness(sentence=str(error))
            if equations is None or not equations.lacks or (geared is not None and not geared.lacks):
                return Looseness(is_geared=equations is not None and equations.lacks > 0)
            return Looseness(tuple(equations.loose()), equations.loose_words())

    return plan.made(("looseness",), made)


def structure_of(plan: Plan, elements: Iterable[ForceElement] = (), thrusts: Sequence[Push] = ()) -> Structure:
    """Return the bodies and joints of a plan; cranks on a stroke that a cylinder takes over are geared where nothing else holds them."""
    return Structure(plan, elements, thrusts, looseness(plan).is_geared)


def locked_equations(motion: Motion, is_geared: bool = False) -> Equilibrium | None:
    """Return the equilibrium of bodies whose drives are locked; None where no pose is reached, or joint forces are not provided."""
    poses, elements = FlatPoses(motion, "The joint forces"), tuple(motion.plan.of_kind(ForceElement).values())
    if not poses.count or not motion.plan.moving:
        return None
    holders_of(motion.plan)
    fed = [ram for each in elements for ram in each.feeds(motion.plan.members) if isinstance(ram, TwoPoint)]
    fed += [each for each in elements if isinstance(each, TwoPoint) and not each.holds]
    laws = [Push(each, np.zeros(motion.shape), member_title(each)) for each in fed]
    try:
        return Equilibrium(System(Structure(motion.plan, elements, laws, is_geared), poses, ()))
    except NotHeldError:
        raise
    except DefinitionError:
        return None


def loose_movements(motion: Motion) -> list[dict[str, FloatArray]]:
    """Return how the points of a machine can move at one pose while its drives are locked: for each way directions (2,) by point."""
    with unwarned():
        equations = locked_equations(motion) if looseness(motion.plan).bodies else None
    return [] if equations is None or not equations.lacks else [movement(equations, way) for way in equations.ways.T]


def movement(equations: Equilibrium, way: FloatArray) -> dict[str, FloatArray]:
    """Return how points move in one way, (2,) each, the fastest by 1; those that stay are left out.

    Links come before cylinders among the bodies: the length of one that shares its pressure may change.
    """
    system, found = equations.system, dict[str, FloatArray]()
    for index, body in enumerate(system.structure.bodies):
        x, y, turn = way[system.starts[index] : system.starts[index] + 3]
        for point in body.points:
            arm = (system.poses.at(point) - system.poses.at(body.points[0]))[:, 0]
            found.setdefault(point, np.array([x, y]) + turn / system.unit_length * quarter_turned(arm))
    size = max((float(np.hypot(*each)) for each in found.values()), default=0.0)
    return {point: each / size for point, each in found.items() if np.hypot(*each) > 1e-6 * size}


def held_fault(motion: Motion, case: str = PLAIN_CASE) -> str:
    """Return why there are no forces in a load case, in words; "" where the machine is held."""
    try:
        held_in_case(motion, Acting(case=case))
    except DefinitionError as error:
        return " ".join(str(error).split()).removeprefix(f"{motion.plan.title}: ")
    return ""


def held_in_case(motion: Anywhere, acting: Acting | None) -> Anywhere:
    """Return a motion as it is in a load case, for forces; DefinitionError where bodies are loose there or closed lines lock it."""
    found = motion_in_case(motion, acting)
    refuse_loose(found.plan)
    if any(not tie.gives for tie in closed_ties(found.plan)):
        found._once(("kept",), partial(lines_kept, found))
    return found


def lines_kept(motion: Anywhere) -> bool:
    """Return True where closed lines do not lock a machine, looked at once a design; DefinitionError where they do."""
    if not isinstance(motion, Motion):
        return check_kept(motion)
    poses = sampled(motion.plan, motion.designs)
    return recalled(poses, "kept", partial(check_kept, poses))


def refuse_loose(plan: Plan) -> None:
    """Raise DefinitionError where bodies of a class are loose while its drives are locked."""
    sentence = looseness(plan).sentence
    if sentence:
        raise NotHeldError(sentence)
