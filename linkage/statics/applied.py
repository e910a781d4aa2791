"""The loads on a motion in a situation: the machine's own or given ones, in a load case, at the rates of a movement."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from copy import copy
from dataclasses import replace
from functools import partial
from typing import TypeAlias, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from ..errors import DefinitionError, cited, ensure, errors_of, is_listed, known_name, require, require_type, unknown
from ..frozen import record
from ..loads import AS_IT_RUNS, FRICTIONLESS, OWN_LOADS, PLAIN_CASE, Acting, Case, Damper, HasLoads, LoadCase, Loads
from ..loads.acting import check_factor, shut_members
from ..loads.element import AT_REST, SENSES, ForceElement, Friction, Load, Poses, Push, Rate, Rates, TwoPinned, check_together
from ..motion import Motion, rates_of, require_motion
from ..motion.limits import refuse_at
from ..motion.requests import stroke_of
from ..plan import Plan
from ..program import FloatArray
from ..quantities import joined_names, name_of
from .poses import AnyMotion

Anywhere = TypeVar("Anywhere", bound=AnyMotion)


@record
class AppliedLoads:
    """All that acts on a motion in a situation: loads, members with a thrust of their own, friction; forces in the motion's shape.

    `rates` are those at which strokes move, `elements` those that act, `case` what the load case is called, `at_rest` the names of the
    dampers that give nothing because no speed is known.
    """

    acting: Acting
    rates: Rates
    case: str
    elements: tuple[ForceElement, ...]
    loads: tuple[Load, ...]
    thrusts: tuple[Push, ...]
    frictions: tuple[Friction, ...]
    at_rest: tuple[str, ...] = ()

    @property
    def points(self) -> set[str]:
        """The points that carry loads."""
        return {each.point for each in self.loads} | {end for each in self.thrusts for end in each.member.ends}


@record
class AppliedElement:
    """A force element that counts: in the gravity of a load case, with the factor of its loads."""

    name: str
    element: ForceElement
    in_case: ForceElement
    factor: float


Parts: TypeAlias = tuple[list[Load], list[Push]]


def applied_loads(motion: AnyMotion, acting: Acting, rates: Rates, without: str = "") -> AppliedLoads:
    """Return the loads on a motion in a situation; DefinitionError for anything but a force element, and for a wrong force.

    `rates` are those of the situation at the motion's poses. An element named `without` is left out. Of a traced motion the forces are
    nodes; LawError, with the element's name, for a law that cannot be traced.
    """
    motion = motion_in_case(motion, acting)
    plan, elements = motion.plan, applied_elements(motion.plan, acting, without)
    over_arrays = partial(element_parts, motion, partial(over_poses, motion))
    parts_of = over_arrays if isinstance(motion, Motion) else getattr(motion, "parts_of", over_arrays)
    each_of = [parts_of(each, rates) for each in elements]
    loads = tuple(load for found, _ in each_of for load in found)
    for each in loads:
        where = f"{plan.title}: {each.element}"
        require(is_listed(each.on), f"{where}: on", each.on, 'names of points or of an element are expected, on=("O", "B")')
        for point in (each.point, *(each.on if len(each.on) > 1 else ())):
            if name_of(point) not in plan.points:
                raise unknown("Point", point, plan.points, where=where)
    frictions = [(each.factor, friction) for each in elements if rates.has_friction for friction in each.element.frictions(motion)]
    return AppliedLoads(
        acting, rates, "given loads" if acting.case is None and acting.loads is not None else case_of(plan, acting.case).label,
        tuple(each.element for each in elements), loads, tuple(thrust for _, found in each_of for thrust in found),
        tuple(replace(each, coefficient=each.coefficient * factor) for factor, each in frictions),
        tuple(each.name for each in elements if isinstance(each.element, Damper) and not rates.is_timed),
    )  # fmt: skip


def element_parts(motion: Poses, fit: Callable[[ArrayLike, int, str, str], FloatArray], each: AppliedElement, rates: Rates) -> Parts:
    """Return the loads and the thrusts of one element as they act; `fit` brings forces into the motion's shape."""
    element, name, thrusts = each.in_case, each.name, []
    for push in element.pushes(motion, rates):  # one without a name goes by that of the element which gives its thrust
        title = member_title(push.member) if push.member.name or not name.isidentifier() else name
        thrusts.append(Push(push.member, fit(push.thrust, 0, name, "thrust") * each.factor, title))
    if thrusts:
        return [], thrusts
    with errors_of(f"{motion.plan.title}: loads(motion) of {name}"):
        found = element.moving(motion, rates) if rates else element.loads(motion)
    require_type(f"{motion.plan.title}: {name}: loads(motion)", found, (list, tuple), "a list of Load(point, force) is expected", Load)
    forces = [fit(load.force, 1, name, f"force at {load.point}") * each.factor for load in found]
    return [replace(load, force=force, element=name) for load, force in zip(found, forces, strict=True)], []


def over_poses(motion: AnyMotion, values: ArrayLike, vector: int, name: str, what: str) -> FloatArray:
    """Return forces over the poses in the motion's shape, of a `vector` (2, ...); DefinitionError where they do not fit or are none."""
    opening, lead = f"{motion.plan.title}: {name}: its {what}", (2,) * vector
    expected, shape = "; (2, ...) in N is expected" if vector else "", (*lead, *motion.shape)
    try:
        array = np.asarray(values)
    except ValueError:
        raise DefinitionError(f"{opening} is {cited(values)}{expected}.") from None
    ensure(array.dtype.kind in "fiu", f"{opening} holds {array.dtype.name}, no real numbers{expected}.")
    ensure(array.shape[:vector] == lead, f"{opening} has the shape {array.shape}{expected}.")
    try:
        full = np.broadcast_to(array.reshape((*lead, *(1,) * (len(shape) - array.ndim), *array.shape[vector:])), shape)
    except ValueError:
        raise DefinitionError(f"{opening}, shape {array.shape}, does not fit the poses {shape}.") from None
    missing = ~np.isfinite(full).all(axis=tuple(range(vector))) & motion.reached
    before = f"{motion.plan.title}: {name} gives no finite {what}"
    refuse_at(motion, missing, before, ": mend its law, or keep away from there.")
    return np.asarray(full, float)


def member_title(member: TwoPinned) -> str:
    """Return the name of a two-point member as a body: its own, or its kind with its points."""
    return member.name or f"{type(member).__name__} {joined_names(*member.ends)}"


# Which elements are meant, by name, case and kind.


def applied_elements(plan: Plan, acting: Acting, without: str = "") -> list[AppliedElement]:
    """Return the force elements that count in a load case; DefinitionError for anything else, and for names that no load has."""
    load_case, present = case_of(plan, acting.case), elements_of(plan, acting.loads)
    known = dict.fromkeys(name for name, _ in [*present, *elements_of(plan, None)])
    for name in load_case.mentioned:
        known_name("Load", name, known, where=f"{plan.title}, {load_case.label}")
    found = []
    for name, element in present:
        check_factor(load_case, name, element, f"{plan.title}, {load_case.label}")
    for name, each in present:  # one without a name, which is given to count, is not left out by `only`
        element = (each.when_shut() if each.name in load_case.shut_names else None) or each
        factor = load_case.factor(name) if element.name else float(load_case.scale.get(name, 1.0))
        if name != without and factor != 0.0:
            found.append(AppliedElement(name, element, load_case.on(element), factor))
    return found


PLAIN_LOADS = LoadCase(OWN_LOADS)
"""The case of the machine's own loads as they are declared."""


def case_of(plan: Plan, case: Case) -> LoadCase:
    """Return the load case that is meant; the plain one for None and "plain"."""
    if case is None or (isinstance(case, str) and case == PLAIN_CASE):
        return PLAIN_LOADS
    if isinstance(case, LoadCase):
        return case
    cases = plan.of_kind(LoadCase)
    titled = {each.label: each for each in cases.values()}
    return (titled | cases)[known_name("Load case", case, [*dict.fromkeys((PLAIN_CASE, *cases, *titled))], where=plan.title)]


def plan_in_case(plan: Plan, acting: Acting | None) -> Plan:
    """Return a plan as it is in a load case that shuts lines: the same places, of a machine whose lines are shut; else itself."""
    case = case_of(plan, acting.case) if acting is not None and acting.case is not None else None
    shut = {} if case is None or not case.shut else shut_members(case, plan.members, f"{plan.title}, {case.label}")
    if all(plan.members[name] is each for name, each in shut.items()):
        return plan
    return plan.made(("shut", *sorted(shut)), lambda fork: fork.exchanged(shut))


def motion_in_case(motion: Anywhere, acting: Acting | None) -> Anywhere:
    """Return a motion as it is in a load case that shuts lines: the same poses of that plan; else itself."""
    plan = plan_in_case(motion.plan, acting)
    if plan is motion.plan:
        return motion

    def shut() -> Anywhere:
        found = copy(motion)
        vars(found).update(plan=plan)
        return found

    return motion._once(("in case", plan), shut) if isinstance(motion, Motion) else shut()


def elements_of(plan: Plan, loads: Loads) -> list[tuple[str, ForceElement]]:
    """Return the force elements that are meant, by name: the machine's own for None; DefinitionError for some that cannot act together."""
    own = plan.of_kind(ForceElement)
    if loads is None:
        return list(own.items())
    listed = [loads] if isinstance(loads, (str, ForceElement)) or not isinstance(loads, Sequence) else loads
    given = [own[known_name("Load", each, own, where=plan.title)] if isinstance(each, str) else each for each in listed]
    names = [each if isinstance(each, str) else str((isinstance(each, ForceElement) and each.name) or each) for each in listed]
    for each in given:
        if isinstance(each, type) or not callable(getattr(each, "loads", None)):
            what = f"{each!r} is not a force element; give a Weight, a Force, ... or anything with loads(motion)"
            raise DefinitionError(f"{plan.title}: {what}.")
    check_together(list(zip(names, given, strict=True)), plan.members, plan.title)
    return [(name, each if isinstance(each, ForceElement) else LoadsAlone(each)) for name, each in zip(names, given, strict=True)]


class LoadsAlone(ForceElement):
    """A force element made of anything that has loads."""

    places = ()

    def __init__(self, element: HasLoads) -> None:
        self.element = element

    def loads(self, motion: Poses) -> list[Load]:
        return self.element.loads(motion)

    def moving(self, motion: Poses, rates: Rates) -> list[Load]:
        moving: Callable[[Poses, Rates], list[Load]] | None = getattr(self.element, "moving", None)
        return self.loads(motion) if moving is None else moving(motion, rates)

    def __str__(self) -> str:
        return str(self.element)


# How strokes move at the poses: which way friction acts, and at what rates dampers work.


def rates_in(motion: AnyMotion, acting: Acting, drive: str | None = None) -> Rates:
    """Return how the strokes move in a situation; `drive` is the one that moves where several could and the situation names none.

    Along a path they move as the path's tangent goes, over a path in time at its rates. DefinitionError where nobody says which one
    moves, for rates that go against the direction, and for a direction over a path in time.
    """
    motion = require_motion(motion)
    direction, drive, sense = acting.movement, acting.drive if drive is None else drive, SENSES[acting.movement]
    given, accelerations = known_rates(motion, acting), known_accelerations(motion, acting)
    if not given and (acting.inertia or direction == AS_IT_RUNS):
        what = f"inertia={acting.inertia}" if acting.inertia else f"direction={direction!r}"
        remedy = "give rates= and accelerations=, or a motion in time"
        raise DefinitionError(f"{motion.plan.title}: {what}, and nothing says how the strokes move; {remedy}.")
    if isinstance(motion, Motion) and motion.time is not None and not isinstance(acting.rates, Mapping):
        refuse_direction(motion, acting)
        return Rates(given, True, acting.direction or AS_IT_RUNS, accelerations)
    if given:
        sense = 0 if direction == AS_IT_RUNS else sense
        named = [drive] if drive is not None else [*given] if len(given) == 1 else []
        wrong = next((name for name in named if sense and np.any(sense * np.asarray(given.get(name, 0.0)) < 0.0)), None)
        ensure(wrong is None, f"{motion.plan.title}: direction={direction!r} and the rate of {wrong} contradict each other; drop one.")
        return Rates(given, True, direction, accelerations)
    if not sense:
        return AT_REST
    tangent: Mapping[str, Rate] = path_tangent(motion) or {stroke_of(motion.plan, drive, "drive"): 1.0}
    return Rates({name: sense * rate for name, rate in tangent.items()}, direction=direction)


def refuse_direction(motion: AnyMotion, acting: Acting) -> None:
    """Raise DefinitionError for a direction over a path in time."""
    is_timed = isinstance(motion, Motion) and motion.time is not None and not isinstance(acting.rates, Mapping)
    if is_timed and acting.is_moving:
        what = f"{motion.plan.title}: direction={acting.direction!r}: over a path in time the machine moves one way, as it runs"
        raise DefinitionError(f"{what}; leave the direction out, or say direction={FRICTIONLESS!r}.")


def known_rates(motion: AnyMotion, acting: Acting) -> Mapping[str, FloatArray]:
    """Return the rates of strokes that a situation gives, or a motion in time has. Empty where they are not known."""
    if acting.rates is None and not isinstance(motion, Motion):
        return {}
    if acting.rates is not None and not isinstance(acting.rates, str):
        return rates_of("rates", acting.rates, require_motion(motion))
    if acting.rates is not None and not motion.rates:
        what = f"rates={acting.rates!r}: this motion has no rates of its own"
        raise DefinitionError(f"{motion.plan.title}: {what}; give some, rates=dict({next(iter(motion.strokes), 'S')}=0.05).")
    return motion.rates


def known_accelerations(motion: AnyMotion, acting: Acting) -> Mapping[str, FloatArray] | None:
    """Return the accelerations of strokes beside rates that are known. None where inertia is left out.

    Rates that are given alone leave it out, unless it is asked for: then they do not change.
    """
    given, own = acting.accelerations, acting.rates is None or isinstance(acting.rates, str)
    if acting.inertia is False:
        return None
    if given is not None and not isinstance(given, str):
        return rates_of("accelerations", given, require_motion(motion))
    found = motion.accelerations if own and (given is not None or isinstance(motion, Motion)) else {}
    jump = motion._rate_jump if own and isinstance(motion, Motion) else None
    if jump is not None and acting.inertia:
        name, words = jump
        remedy = f"give the ramp of {name} an acceleration, take a smooth course, or leave inertia= out"
        raise DefinitionError(f"{motion.plan.title}: {words}: {remedy}.")
    return None if jump is not None else found if found or acting.inertia else None


def path_tangent(motion: AnyMotion) -> dict[str, FloatArray]:
    """Return how the strokes that move change along a path, shaped as the poses; empty where it is none."""
    return {name: rate for name, rate in (motion.tangent or {}).items() if np.any(rate != 0.0)}
