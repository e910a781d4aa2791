"""The situations in which a live page shows forces, one for each `Over` that differs, and the arrows that it draws of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple, TypeAlias, TypeVar, cast

import numpy as np

from ..errors import LinkageError, UntracedError, unwarned
from ..loads import PLAIN, PLAIN_CASE, Acting, Case
from ..mechanism import Mechanism
from ..motion import Judge, LiveText, Motion, Request
from ..motion.requests import bound
from ..program import FloatArray
from ..reports import Run, at_its_rates, case_shown, request_in_case
from ..statics import AnyMotion, JointForce, LawRequest, TracedMotion, applied_loads, ground_loads, pin_force, pin_forces, rates_in
from ..statics.applied import case_of
from .scene import centre_beside
from .shown_values import bodies_shown, short_name

AnyRequest = TypeVar("AnyRequest")
Centre: TypeAlias = tuple[str, str, tuple[float, float]] | None


class PageArrow(NamedTuple):
    """A force that a page can draw: its point, its parts [N], whether it is a load, its centre where it acts beside its point.

    The couple of a joint [N m] is its one part. `on` is the body on which it acts and `by` the one that it comes from; of a load and of
    the ground's push `on` is the name, `by` "".
    """

    point: str
    parts: dict[str, Request]
    is_load: bool
    centre: Centre
    on: str
    by: str


@dataclass(frozen=True)
class PageSituation:
    """How a page shows forces over an `Over`: in a load case; over a path in time, the motion, at its rates."""

    case: Case
    motion: Motion | None = None


def page_situations(machine: Mechanism, judge: Judge, run: Run) -> tuple[list[PageSituation], list[int]]:
    """Return the situations of a page, that of its first run first, then all load cases judged, and which of them each `Over` has."""
    of_places = [PageSituation(case_shown(machine, each), each.motion if each.instants is not None else None) for each in judge.places]
    own = [each for each, place in zip(of_places, judge.places, strict=True) if place.over.name == run.title and each.motion is not None]
    first = own[0] if run.instants is not None and own else PageSituation(run.case)
    named = [(name, case_of(machine.plan, name)) for name in judge.cases if any(each.instants is None for each in judge.places)]
    others = [None if name == PLAIN_CASE else name for name, case in named if not case.shut and case.only is None]  # of the same bodies
    found = list(dict.fromkeys((first, *of_places, *map(PageSituation, others))))
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


def load_part(kind: str, name: Any, axis: int, motion: AnyMotion, acting: Acting) -> FloatArray:
    """Return a part of the ground's force, by its place, or of an element's loads at a point, over a motion [N].

    At the point "" it is all of the element's loads.
    """
    if kind == "ground":
        return cast(FloatArray, ground_loads(motion, acting)[name[0]].force[axis])
    element, point = name
    applied = applied_loads(motion, acting, rates_in(motion, acting)).loads
    loads = [each for each in applied if each.element == element and point in ("", each.point)]
    return cast(FloatArray, sum((each.force[axis] for each in loads), np.zeros(motion.shape)))


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
        loads = dict.fromkeys((each.element, each.point) for one in here for each in applied_loads(one, PLAIN, rates_in(one, PLAIN)).loads)
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
            found.append(PageArrow(joint.point, of_joint, False, None, short_name(solved, on), short_name(solved, by)))
            for each in of_joint.values() if len(found) == 1 else ():
                bound(plan, each).nodes(plan.beside)
    except UntracedError:  # which parts pull is found pose by pose: the loads alone are drawn
        found.clear()
    asked: dict[tuple[str, Any], tuple[str, Centre]] = {}
    if loads:
        asked = {("ground", (k, each.element)): (each.point, None) for k, each in enumerate(ground_loads(poses, PLAIN))}
    for element, point in loads:
        centre = centre_beside(plan, element)
        asked["load", (element, "" if centre else point)] = (centre[0] if centre else point, centre)
    for (kind, name), (point, centre) in asked.items():
        keys = ((kind, name, axis) for axis in (0, 1))
        x, y = (LawRequest(formula=partial(load_part, *key), text=f"{kind} {name}", known=key, acting=PLAIN) for key in keys)
        called = name[kind == "ground"].partition("(")[0]
        found.append(PageArrow(point, {"x": x, "y": y}, kind == "load", centre, called, ""))
    return found
