"""The situations in which a live page shows forces, one for each `Over` that differs, and the arrows that it draws of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from functools import partial
from typing import Any, NamedTuple, TypeAlias, TypeVar, cast

import numpy as np

from ..errors import LinkageError, UntracedError, unwarned
from ..frozen import record
from ..language import language
from ..loads import PLAIN, PLAIN_CASE, Acting, Case, ForceElement, Load
from ..mechanism import Mechanism
from ..motion import Judge, LiveText, Motion, Request
from ..motion.requests import bound
from ..plan import Plan
from ..program import FloatArray
from ..reports import Run, at_its_rates, case_shown, request_in_case
from ..statics import (
    AnyMotion,
    JointForce,
    LawRequest,
    PinForces,
    TracedMotion,
    applied_loads,
    ground_loads,
    pin_force,
    pin_forces,
    rates_in,
)
from ..statics.applied import case_of
from ..statics.joint_forces import geared_words
from ..statics.solution import structure_of
from .shown_values import bodies_shown, centre_beside, centre_of_mass, drawn_together, on_its_line, resultant, short_name, typeset

AnyRequest = TypeVar("AnyRequest")
LoadKey: TypeAlias = tuple[str, str, tuple[str, ...]]


class PageArrow(NamedTuple):
    """A force that a page can draw: its point, its parts [N], whether it is a load.

    The parts of its place [m] are among them where that is beside the point; of a couple its size [N m] is. `on` is the body on which it
    acts and `by` the one that it comes from; of a load and of the ground's push `on` is the name, `by` "".
    """

    point: str
    parts: dict[str, Request]
    is_load: bool
    on: str
    by: str


@record
class PageSituation:
    """How a page shows forces over an `Over`: in a load case; over a path in time, the motion, at its rates."""

    case: Case
    motion: Motion | None = None


def page_situations(machine: Mechanism, judge: Judge, run: Run) -> tuple[list[PageSituation], list[int]]:
    """Return the situations of a page, that of its first run first, then all load cases judged, and which of them each `Over` has."""
    of_places = [PageSituation(case_shown(machine, each), each.motion if each.instants is not None else None) for each in judge.places]
    own = [each for each, place in zip(of_places, judge.places, strict=True) if place.over.name == run.title and each.motion is not None]
    first = own[0] if run.instants is not None and own else PageSituation(run.case)
    named = [(name, case_of(machine.plan, name)) for name in judge.cases]
    alike = [name for name, case in named if not case.shut and case.only is None]  # of the same bodies
    others = (
        PageSituation(None if name == PLAIN_CASE else name, each.motion)
        for each, place in zip(of_places, judge.places, strict=True)
        for name in alike
        if each.motion is None or name in place.cases(judge.acting)
    )
    found = list(dict.fromkeys((first, *of_places, *others)))
    return found, [found.index(each) for each in of_places]


def situated_requests(name: str, request: AnyRequest, situations: Sequence[PageSituation]) -> dict[str, AnyRequest]:
    """Return a request in each situation, by its name and number; once where it is the same as in the first.

    Over a path in time its program takes rates and accelerations.
    """
    asked = []
    for each in situations:
        own = request_in_case(request, each.case)
        asked.append(own if each.motion is None else cast(AnyRequest, at_its_rates(each.motion, cast(Any, own))))
    return {f"{name} {k}": each for k, each in enumerate(asked) if not k or each is not asked[0]}


def situated_rows(name: str, live: LiveText, count: int) -> int | list[int] | None:
    """Return the row of a request in situations, one for all or one for each, -1 where its program does not give it; None without one."""
    keys = [f"{name} {k}" for k in range(count)]
    keys = [key if key in live.rows or key in live.left_out else keys[0] for key in keys]
    found = [live.rows[key][0] if key in live.rows else -1 for key in keys]
    return (found[0] if found[0] >= 0 else None) if len(set(found)) == 1 else found


def load_part(kind: str, name: Any, part: str, motion: AnyMotion, acting: Acting) -> FloatArray:
    """Return a part of the ground's force, by its place, or of an element's loads on a body, over a motion: x, y [N], couple [N m].

    `atX` and `atY` are where the loads are drawn [m].
    """
    if kind == "ground":
        return cast(FloatArray, ground_loads(motion, acting)[name].force["xy".index(part)])
    element, among, is_couple = name
    loads = [each for each in applied_loads(motion, acting, rates_in(motion, acting)).loads if load_key(each) in among]
    if not loads:
        return np.zeros(motion.shape)
    force, moment, place = resultant([(motion[each.point], each.force) for each in loads])
    if part in PLACE and not is_couple:
        place = on_its_line(force, moment, place, centre_of_mass(motion.__getitem__, motion.plan, element))
    return place[PLACE.index(part)] if part in PLACE else moment if is_couple else force["xy".index(part)]


PLACE = ("atX", "atY")


def load_key(load: Load) -> LoadKey:
    """Return a key by which a load is known, in any situation."""
    return load.element, load.point, load.on


def geared_remark(plan: Plan) -> list[str]:
    """Return that forces between teeth are left out, in English and Russian; nothing for a machine without gears."""
    found = list[str]()
    for each in ("en", "ru"):
        with suppress(LinkageError), language(each):
            found += map(typeset, geared_words(structure_of(plan)))
    return found


def force_arrows(machine: Mechanism, motion: Motion, situations: Sequence[PageSituation]) -> list[PageArrow]:
    """Return the forces that can be drawn, those at pins and supports first.

    A mass acts at a centre of its own beside its point. A load that acts in one of the situations alone, as the couple of what is
    accelerated, is among them.
    """
    plan, poses = machine.plan, motion.moved({name: value[motion.reached][:1] for name, value in motion.strokes.items()})
    try:
        with unwarned():
            solved = pin_forces(poses)
        traced = TracedMotion(plan.beside, plan.beside.trace)
        here: list[AnyMotion] = [traced, *(each.motion for each in situations if each.motion is not None)]
        every = {load_key(each): each for one in here for each in applied_loads(one, PLAIN, rates_in(one, PLAIN)).loads}
        loads = drawn_together(solved, every.values())
    except LinkageError:  # no forces, or loads that have no program
        return []
    joints = solved.joints if loads else ()
    at_points = [each for each in joints if each.place is None or np.allclose(each.place, poses[each.point])]  # where an arrow begins
    told: list[tuple[JointForce, Sequence[str]]] = [(each, "xy") for each in at_points if each.has_force]
    told += [(each, ["couple"]) for each in at_points if np.any(each.couple)]
    found = list[PageArrow]()
    try:
        for joint, parts in told:
            on, by = bodies_shown(solved, joint)
            of_joint: dict[str, Request] = {part: pin_force(joint.point, on, part, by=by) for part in parts}
            found.append(PageArrow(joint.point, of_joint, False, short_name(solved, on), short_name(solved, by)))
            for each in of_joint.values() if len(found) == 1 else ():
                bound(plan, each).nodes(plan.beside)
    except UntracedError:  # which parts pull is found pose by pose: the loads alone are drawn
        found.clear()
    return [*found, *(load_arrows(solved, poses, loads) if loads else ())]


def load_arrows(solved: PinForces, poses: Motion, loads: Mapping[tuple[str, str, str], Sequence[Load]]) -> Iterator[PageArrow]:
    """Yield what the ground puts on a vehicle, then an element's loads on each body as one force or couple."""
    asked: dict[tuple[str, Any], tuple[str, str, tuple[str, ...]]] = {}
    for k, ground in enumerate(ground_loads(poses, PLAIN)):
        asked["ground", k] = ground.element, ground.point, ("x", "y")
    for (element, _, _), each_of in loads.items():
        among, is_alone = frozenset(map(load_key, each_of)), len({each.point for each in each_of}) == 1
        is_couple = not is_alone and turns_only(poses, element, among)
        place = () if is_alone and centre_beside(poses.plan, element) is None else PLACE
        asked["load", (element, among, is_couple)] = element, each_of[0].point, (*(["couple"] if is_couple else "xy"), *place)
    for (kind, name), (element, point, parts) in asked.items():
        of_load: dict[str, Request] = {}
        for part in parts:
            formula, text = partial(load_part, kind, name, part), f"{kind} {element} {part}"
            of_load[part] = LawRequest(formula=formula, text=text, known=(kind, name, part), acting=PLAIN)
        yield PageArrow(point, of_load, kind == "load", element.partition("(")[0], "")


def turns_only(poses: Motion, element: str, among: frozenset[LoadKey]) -> bool:
    """Return whether an element's loads on a body are a couple, whatever its size."""
    given = poses.plan.of_kind(ForceElement).get(element)
    if given is not None and any(glyph.drawn_as == "moment" for glyph in given.glyphs(poses.plan.members)):
        return True
    forces = [each.force for each in applied_loads(poses, PLAIN, rates_in(poses, PLAIN)).loads if load_key(each) in among]
    most = sum((np.abs(each) for each in forces), np.zeros(1))
    return bool(np.any(most > 0.0) and np.all(np.abs(sum(forces)) <= 1e-9 * most))
