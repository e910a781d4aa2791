"""Which loads act: the machine's own or given ones, as a load case has them, in a direction of motion."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any, Protocol, TypeAlias

import numpy as np

from ..errors import DefinitionError, SingularError, cited, known_name, told, unknown
from ..loads import Damper, ForceElement, Friction, Load, LoadCase, Rates, TwoPoint
from ..loads import Poses as Moved
from ..motion import Motion, rates_of, require_motion
from ..motion.requests import stroke_of
from ..plan import Plan
from ..program import FloatArray
from ..quantities import name_of

# How strokes move at the poses: which way friction acts, and at what rates dampers work.

SENSES: Mapping[str, int] = MappingProxyType({"frictionless": 0, "extending": 1, "retracting": -1})
"""Where it goes: the stroke grows, or the path is followed forwards; the other way."""


@dataclass(frozen=True)
class Movement:
    """How fast strokes move [1/s], each a number or an array that fits the poses; empty at rest.

    `rubs`: whether friction acts, against these rates. `is_timed`: whether they are speeds that were given; else only their sense
    counts. `direction` is the word for it.
    """

    direction: str = "frictionless"
    rates: Mapping[str, Any] = field(default_factory=dict)
    rubs: bool = False
    is_timed: bool = False

    @property
    def sense(self) -> int:
        """1 or -1 for a direction of motion, 0 where none is named."""
        return SENSES[self.direction]

    @property
    def known(self) -> Rates:
        """The rates as force elements ask for them."""
        return Rates(self.rates, self.is_timed, self.rubs)


AT_REST = Movement()


def sense_of(direction: str) -> int:
    """Return 1, -1 or 0 for a direction of motion."""
    return SENSES[known_name("Direction", direction, SENSES)]


def movement_of(motion: Motion, direction: str, rates: Mapping[str, Any] | None, drive: str | None) -> Movement:
    """Return how the strokes move in a direction or at given rates; `drive` names the one that moves where several could.

    Along a path of several strokes they move as the path's tangent goes. DefinitionError where nobody says which one moves, and for
    rates that go against the direction.
    """
    require_motion(motion)
    sense = sense_of(direction)
    if rates is not None:
        given = rates_of("rates", rates, motion.strokes, motion.shape, motion.plan.title)
        if sense and drive is not None and np.any(sense * np.asarray(given.get(drive, 0.0)) < 0.0):
            raise DefinitionError(f"{motion.plan.title}: direction={direction!r} and the rate of {drive} contradict each other; drop one.")
        return Movement(direction, given, bool(sense), True)
    if not sense:
        return AT_REST
    tangent = path_tangent(motion)
    if tangent:
        return Movement(direction, {name: sense * rate for name, rate in tangent.items()}, True)
    return Movement(direction, {stroke_of(motion.plan, drive, "drive"): float(sense)}, True)


def path_tangent(motion: Motion) -> dict[str, FloatArray]:
    """Return how strokes change along a path on which several of them move, shaped as the poses; empty where it is none."""
    moving = {name: rate for name, rate in (motion.tangent or {}).items() if np.any(rate != 0.0)}
    return moving if len(moving) > 1 else {}


class Loading(Protocol):
    """Anything with loads: what a force element is at the least."""

    def loads(self, motion: Any) -> list[Load]:
        """Return the forces over the motion's poses [N]."""


Loads: TypeAlias = Sequence[ForceElement | Loading | str] | ForceElement | Loading | str | None
Case: TypeAlias = LoadCase | str | None


@dataclass(frozen=True)
class Chosen:
    """A force element that counts: as it is, in the gravity of a load case, and what its loads are multiplied by."""

    name: str
    element: ForceElement
    in_case: ForceElement
    factor: float


@dataclass(frozen=True)
class Acting:
    """A load at the poses, as it acts: point, force (2, ...) [N] in the motion's shape, the body it is on, its element."""

    load: Load
    force: FloatArray
    element: str


@dataclass(frozen=True)
class Pushing:
    """What a two-point member carries by a law: its name, its ends, its thrust at the poses [N] in the motion's shape."""

    name: str
    member: TwoPoint
    thrust: FloatArray

    @property
    def ends(self) -> tuple[str, str]:
        """The points at its ends."""
        return self.member.ends


@dataclass(frozen=True)
class Loaded:
    """All that acts on a motion in one load case and one movement: loads, members with a thrust of their own, friction."""

    acting: tuple[Acting, ...]
    pushing: tuple[Pushing, ...]
    frictions: tuple[Friction, ...]
    elements: tuple[ForceElement, ...]
    case: str
    movement: Movement
    at_rest: tuple[str, ...] = ()

    @property
    def points(self) -> set[str]:
        """The points that carry loads."""
        return {each.load.point for each in self.acting} | {end for each in self.pushing for end in each.ends}


class Plain(ForceElement):
    """A force element made of anything that has loads."""

    places = ()

    def __init__(self, element: Loading) -> None:
        self.element = element

    def loads(self, motion: Moved) -> list[Load]:
        return self.element.loads(motion)

    def moving(self, motion: Moved, rates: Rates) -> list[Load]:
        moving: Callable[[Moved, Rates], list[Load]] | None = getattr(self.element, "moving", None)
        return self.loads(motion) if moving is None else moving(motion, rates)

    def __str__(self) -> str:
        return str(self.element)


def gathered(motion: Motion, loads: Loads, case: Case, movement: Movement, without: str = "") -> Loaded:
    """Return the loads that act; DefinitionError for what is no force element or gives no proper force."""
    label = "given loads" if case is None and loads is not None else case_of(motion.plan, case).label
    kept = chosen(motion.plan, loads, case, without)
    acting: list[Acting] = []
    pushing: list[Pushing] = []
    for each in kept:
        pushes = each.in_case.pushes(motion, movement.known)
        pushing += [
            Pushing(member_name(push.member, each.name), push.member, over_poses(push.thrust, motion, each.name, "thrust") * each.factor)
            for push in pushes
        ]
        found = [] if pushes else called(each.in_case, motion, movement.known, each.name)
        acting += [Acting(load, fitted(load, motion, each.name) * each.factor, each.name) for load in found]
    rubbing = [(each.factor, friction) for each in kept if movement.rubs for friction in each.element.frictions(motion)]
    frictions = tuple(replace(friction, coefficient=friction.coefficient * factor) for factor, friction in rubbing)
    still = tuple(each.name for each in kept if isinstance(each.element, Damper) and not movement.is_timed)
    return Loaded(tuple(acting), tuple(pushing), frictions, tuple(each.element for each in kept), label, movement, still)


def member_name(member: TwoPoint, owner: str) -> str:
    """Return the name under which a two-point member is a body: its own, or that of the element which gives its thrust."""
    return member_title(member) if member.name or not owner.isidentifier() else owner


def member_title(member: TwoPoint) -> str:
    """Return the name of a two-point member as a body: its own, or its kind with its points."""
    return member.name or f"{type(member).__name__} {''.join(member.ends)}"


def over_poses(values: Any, motion: Motion, name: str, what: str) -> FloatArray:
    """Return numbers over the poses in the motion's shape; DefinitionError where they do not fit or are none."""
    title = motion.plan.title
    array = np.asarray(values)
    if array.dtype.kind not in "fiu":
        raise DefinitionError(f"{title}: {name}: its {what} holds {array.dtype.name}, no real numbers.")
    try:
        full = np.broadcast_to(array, motion.shape)
    except ValueError:
        raise DefinitionError(f"{title}: {name}: its {what}, shape {array.shape}, does not fit the poses {motion.shape}.") from None
    missing = ~np.isfinite(full) & motion.reached
    if missing.any() and motion.unreachable == "raise":
        text = f"{title}: {name} gives no finite {what} at {int(missing.sum())} of {missing.size} poses."
        raise SingularError(text, mask=missing, motion=motion)
    return np.asarray(full, float)


def chosen(plan: Plan, loads: Loads, case: Case, without: str = "") -> list[Chosen]:
    """Return the force elements that count in a load case; DefinitionError for what is none, and for names that no load has."""
    chosen, present = case_of(plan, case), elements_of(plan, loads)
    known = dict.fromkeys(name for name, _ in [*present, *elements_of(plan, None)])
    for name in chosen.mentioned:
        if name not in known:
            raise unknown("Load", name, known, where=f"{plan.title}, {chosen.label}")
    factors = [(name, element, factor_of(chosen, name, element)) for name, element in present if name != without]
    return [Chosen(name, element, chosen.on(element), factor) for name, element, factor in factors if factor != 0.0]


def factor_of(case: LoadCase, name: str, element: ForceElement) -> float:
    """Return what a load is multiplied by in a case; one without a name, which is given to count, is not left out by `only`."""
    return case.factor(name) if element.name else float(case.scale.get(name, 1.0))


def called(element: ForceElement, motion: Moved, rates: Rates, name: str) -> list[Load]:
    """Return an element's loads; DefinitionError where they are no list of loads."""
    with told(f"{motion.plan.title}: loads(motion) of {name}"):
        found = element.moving(motion, rates) if rates else element.loads(motion)
    if not isinstance(found, (list, tuple)) or not all(isinstance(each, Load) for each in found):
        raise DefinitionError(f"{motion.plan.title}: {name}: loads(motion) gives {found!r}; a list of Load(point, force) is expected.")
    return list(found)


def case_of(plan: Plan, case: Case) -> LoadCase:
    """Return the load case that is meant; the plain one for None."""
    if case is None:
        return LoadCase("own loads")
    if isinstance(case, LoadCase):
        return case
    cases = plan.of_kind(LoadCase)
    titled = {each.label: each for each in cases.values()}
    return (titled | cases)[known_name("Load case", case, dict(cases) | titled, where=plan.title)]


def elements_of(plan: Plan, loads: Loads) -> list[tuple[str, ForceElement]]:
    """Return the force elements that are meant, by name: the machine's own for None."""
    own = plan.of_kind(ForceElement)
    if loads is None:
        return list(own.items())
    each_of = [loads] if isinstance(loads, (str, ForceElement)) or not isinstance(loads, Sequence) else loads
    return [named(each, own, plan.title) for each in each_of]


def named(element: Any, own: Mapping[str, ForceElement], title: str) -> tuple[str, ForceElement]:
    """Return a force element with its name, or with its own words where it has none."""
    if isinstance(element, str):
        if element not in own:
            raise unknown("Load", element, own, where=title)
        return element, own[element]
    if isinstance(element, ForceElement):
        return element.name or str(element), element
    if isinstance(element, type) or not callable(getattr(element, "loads", None)):
        raise DefinitionError(f"{title}: {element!r} is not a force element; give a Weight, a Force, ... or anything with loads(motion).")
    return str(element), Plain(element)


def fitted(load: Load, motion: Motion, name: str) -> FloatArray:
    """Return a load's force in the motion's shape (2, ...); DefinitionError where it does not fit or is no number."""
    title = motion.plan.title
    known_points(load, motion.plan, name)
    try:
        force = np.asarray(load.force)
    except ValueError:
        raise DefinitionError(f"{title}: {name}: its force at {load.point} is {cited(load.force)}; (2, ...) in N is expected.") from None
    if force.dtype.kind not in "fiu" or force.shape[:1] != (2,):
        what = f"has the shape {force.shape}" if force.dtype.kind in "fiu" else f"holds {force.dtype.name}, no real numbers"
        raise DefinitionError(f"{title}: {name}: its force at {load.point} {what}; (2, ...) in N is expected.")
    try:
        full = np.broadcast_to(force.reshape(2, *(1,) * (len(motion.shape) + 1 - force.ndim), *force.shape[1:]), (2, *motion.shape))
    except ValueError:
        what = f"its force at {load.point}, shape {force.shape}, does not fit the poses {(2, *motion.shape)}"
        raise DefinitionError(f"{title}: {name}: {what}.") from None
    missing = ~np.isfinite(full).all(axis=0) & motion.reached
    if missing.any() and motion.unreachable == "raise":
        what = f"{name} gives no finite force at {load.point} at {int(missing.sum())} of {missing.size} poses"
        raise SingularError(f"{title}: {what}.", mask=missing, motion=motion)
    return np.asarray(full, float)


def known_points(load: Load, plan: Plan, name: str) -> None:
    """Raise DefinitionError for a load at a point that there is not."""
    on: Any = load.on
    if not isinstance(on, (tuple, list)):
        what = f"on={cited(load.on)} is expected as names of points or of an element"
        raise DefinitionError(f'{plan.title}: {name}: {what}, on=("O", "B").')
    for point in (load.point, *(load.on if len(load.on) > 1 else ())):
        if name_of(point) not in plan.points:
            raise unknown("Point", point, plan.points, where=f"{plan.title}: {name}")
