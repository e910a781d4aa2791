"""The planes that bodies lie in, side by side across the machine, and the clearances within one plane.

|  boom  |        a body of one plane never touches one of another; in one plane bodies are to stay apart,
|  | rod |        and a pin that joins bodies of two planes passes through those between them
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np

from ..errors import DefinitionError, cited, ensure, unwarned
from ..language import said
from ..loads import TwoPoint
from ..plan import Plan
from ..program import FloatArray, Node
from ..quantities import Operand, Quantity, Reference, Variable, joined_names, quantity, source_text
from ..surroundings import Outline
from ..units import require_measure, show
from ..vectors import pick
from ..verdict import Verdict
from .gaps import body_points_of, check_forms, corner_pieces, follows_dimensions, gap_in, least_number, shape_named
from .judge import Judge, Question
from .measures import Condition, least
from .motion import Motion
from .motion_verdicts import HasVerdicts
from .requests import NodeRequest, Trait

Pair = tuple[str, str]


class Planes(HasVerdicts):
    """Which bodies lie in one plane, plane by plane across the machine: `planes = Planes("OBC AB", "CD EDF", width=60 * mm)`.

    Its verdict is the `clearance`, the least gap over all that the machine runs. It counts bodies in a common plane that share no pin, the
    outlines of two that share one, and pins that pass through a plane.

    Parameters
    ----------
    *planes : str
        The bodies of each plane: a body by its points, its Link, its cylinder or spring, an outline by its name. One may be in several
        planes, and what is not named lies in all. Plates count as the convex hull of their points, a body with closed outlines as these.
    width : float or quantity, optional
        The sum of the half widths of two bars [m], 0 by default; a design variable, `planes.width`.
    """

    kind = "planes"
    file_section = "planes"
    argument_kinds: ClassVar[Mapping[str, Any]] = MappingProxyType({"planes": "words"})

    def __init__(self, *planes: str, width: Operand = 0.0) -> None:
        if not planes or not all(isinstance(each, str) and each.split() for each in planes):
            what = f"Planes({', '.join(map(cited, planes))})"
            raise DefinitionError(f'{what}: the names of the bodies of each plane are expected in one text, Planes("OBC AB", "CD EDF").')
        require_measure(width, "mm", "Planes: width")
        self.planes, self.width = planes, quantity(width)
        if self.width.constant is not None and not 0.0 <= self.width.constant < np.inf:
            raise DefinitionError(f"Planes(width={self.width}): the sum of two half widths is expected [m], zero or more.")

    def parts(self) -> tuple[Reference, ...]:
        return () if self.width.is_constant else (self.width,)

    def variables(self) -> tuple[tuple[str, float, str, str], ...]:
        return ((f"{self.name}.width", self.width.constant, "not negative", "mm"),) if self.width.constant is not None else ()

    def having(self, values: Mapping[str, float]) -> Planes:
        return self.renewed(width=quantity(values.get(f"{self.name}.width", self.width)))

    def questions(self, judge: Judge) -> list[Question]:
        """Return the least clearance.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        list
            The questions.
        """
        return [least(clearance())] if pairs_of(judge.plan) else []

    def conditions(self, judge: Judge) -> Mapping[str, Condition]:
        """Return that nothing touches.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        mapping of str to Condition
            The condition by its rule.
        """
        return {"clearance": least(clearance()) >= 0.0} if pairs_of(judge.plan) else {}

    def load_limits(self, judge: Judge) -> Mapping[str, Condition]:
        return {}

    def verdicts(self, judge: Judge) -> list[Verdict]:
        """Return whether everything in one plane stays apart wherever the machine runs, with the nearest pair and its place.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        list of Verdict
            The verdict.
        """
        if not pairs_of(judge.plan):
            return [Verdict("clearance", True, said("no two bodies lie in one plane that share no pin."))]
        answer = judge.answer(least(clearance()))
        if not np.isfinite(answer.value):
            try:
                check_forms(judge.motion, {name for pair in pairs_of(judge.plan) for name in pair})
            except DefinitionError as error:
                return [Verdict.refused("clearance", error)]
            return []
        strokes = {name: np.asarray(float(value)) for name, value in answer.strokes.items()}
        (one, other), _ = pair_at(Motion(judge.plan, judge.designs, strokes, "nan"))
        size = show(abs(float(answer.value)), "mm", 3)
        if answer.value >= 0.0:
            text = said("{one} and {other} come within {gap} of each other, {where}.", one=one, other=other, gap=size, where=answer.where)
            return [Verdict("clearance", True, text, answer=answer)]
        remedy = said("Change a dimension, or put them in different planes.")
        depth = depth_words(judge.plan, one, other, size)
        text = said("{one} and {other} cross by {gap}, deepest {where}.", one=one, other=other, gap=depth, where=answer.where)
        return [Verdict("clearance", False, f"{text} {remedy}", answer=answer)]

    def __str__(self) -> str:
        width = [] if self.width.constant == 0.0 else [f"width={source_text(self.width)}"]
        return f"Planes({', '.join([*map(repr, self.planes), *width])})"


def clearance() -> NodeRequest:
    """Return the request for the least gap of all that lies in one plane [m], as the machine's `Planes` say: `least(clearance()) >= 0.02`.

    Below zero where two bodies cross, by the least way that parts them; of concave outlines, and bodies of several, of the two pieces that
    cross deepest, so that the whole crosses by at least that. DefinitionError for a machine that declares no planes.

    Returns
    -------
    Request
        The gap [m].

    Raises
    ------
    DefinitionError
        The machine declares no planes.
    """

    def nodes(plan: Plan) -> tuple[Node, ...]:
        found = pairs_of(plan)
        ensure(found, f"{plan.title}: clearance(): no two bodies lie in one plane that share no pin; ask gap(a, b) of two.")
        width, choose = plan.trace.value(width_of(plan)), plan.trace.graph.pick
        gaps = [gap_in(plan, plan.trace, choose, a, b) - (width if thick else 0.0) for (a, b), thick in found.items()]
        return (plan.trace.graph.node(least_number(gaps)),)

    def behind(plan: Plan) -> set[str]:
        shapes = [shape_named(plan, name) for pair in pairs_of(plan) for name in pair]
        return plan.reaches(*(name for shape in shapes for name in shape.parts_behind), width_of(plan))

    return NodeRequest(
        text="clearance()", sentence="the least gap of what lies in one plane", key=("clearance",), measures="length",
        traits=Trait.MAY_FAIL, nodes_of=nodes, names_of=behind,
        refused_by=lambda motion: check_forms(motion, {name for pair in pairs_of(motion.plan) for name in pair}),
    )  # fmt: skip


def planes_of(plan: Plan) -> Planes:
    """Return the planes that a class declares; DefinitionError for none and for several."""
    found = list(plan.of_kind(Planes).values())
    own = [*(body.name.replace(" ", "") for body in plan.bodies[1:]), "AB", "CD"]
    what = f"it declares {len(found)}" if found else "it does not say which bodies lie in one plane"
    ensure(len(found) == 1, f'{plan.title}: clearance(): {what}; declare one, planes = Planes("{own[0]}", "{own[1]}", width=60 * mm).')
    return found[0]


def width_of(plan: Plan) -> Quantity:
    """Return the sum of the half widths of two bars [m]."""
    given = planes_of(plan)
    return Variable(f"{given.name}.width") if given.width.is_constant else given.width


def bodies_of(plan: Plan) -> list[str]:
    """Return the names of all that can lie in a plane: the moving bodies, the cylinders, and the elements between two points."""
    bars = {joined_names(bar.P, bar.Q): frozenset((bar.P, bar.Q)) for bar in plan.cylinders}
    elements = {name: frozenset(element.ends) for name, element in plan.of_kind(TwoPoint).items()}
    return [*(body.name for body in plan.bodies[1:]), *(name for name, ends in bars.items() if ends not in elements.values()), *elements]


def pairs_of(plan: Plan) -> dict[Pair, bool]:
    """Return the pairs that must stay apart, with whether the width of bars counts: bodies of a common plane, and pins that pass it."""
    listed, bodies = planes_of(plan).planes, bodies_of(plan)
    known = {id_of(plan, name): name for name in bodies}
    planes: dict[str, set[int]] = {name: set() for name in bodies}
    for number, names in enumerate(listed):
        for name in names.split():
            shape_named(plan, name)  # DefinitionError for an unknown body
            planes.setdefault(known.get(id_of(plan, name), name), set()).add(number)
    everywhere = set(range(len(listed)))
    lie = {name: numbers or everywhere for name, numbers in planes.items()}
    found: dict[Pair, bool] = {}
    for a, b in combinations(lie, 2):
        if lie[a] & lie[b]:
            found |= dict(pairs_of_bodies(plan, a, b))
    points = {name: shape_named(plan, name).points for name in lie}
    for point in plan.points:  # a pin that joins bodies of different planes passes through those between them
        joined = [numbers for name, numbers in lie.items() if point in points[name]]
        taken = set().union(*joined)
        between = set(range(min(taken), max(taken))) - taken if len(joined) > 1 and taken else set[int]()
        found |= {(point, name): True for name in lie if lie[name] & between and point not in points[name]}
    return found


def id_of(plan: Plan, name: str) -> frozenset[str] | str:
    """Return a key of a body, whatever its name: its points; of an outline its name."""
    shape = shape_named(plan, name)
    return name if shape.outline is not None else frozenset(shape.points)


def pairs_of_bodies(plan: Plan, a: str, b: str) -> Iterator[tuple[Pair, bool]]:
    """Yield the pairs that stand for two bodies: themselves where they share no pin, else and with them their outlines."""
    shapes = {name: shape_named(plan, name) for name in (a, b)}
    drawn = {name: [name] if shapes[name].outline is not None else outlines_on(plan, shapes[name].points) for name in (a, b)}
    share = bool(set(shapes[a].points) & set(shapes[b].points))
    if drawn[a] and drawn[b]:
        yield from (((one, other), False) for one in drawn[a] for other in drawn[b] if one != other)
    elif not share:
        yield from (((one, other), True) for one in drawn[a] or [a] for other in drawn[b] or [b])


def depth_words(plan: Plan, one: str, other: str, size: str) -> str:
    """Return how deep two bodies cross, in words: where one of them is in pieces, at least so much."""
    return said("at least {size}", size=size) if in_pieces(plan, one) or in_pieces(plan, other) else size


def in_pieces(plan: Plan, name: str) -> bool:
    """Return whether a body is no single convex piece, so that two of them may cross deeper than any two of their pieces.

    It is a concave outline, one whose form follows dimensions, or one of several outlines of a body.
    """
    shape = shape_named(plan, name)
    if shape.outline is None:
        return shape.each_alone
    if follows_dimensions(shape.outline):
        return True
    on_body = outlines_on(plan, tuple(body_points_of(plan, shape))) if len(shape.points) == 2 else [name]
    return len(on_body) > 1 or (hasattr(shape.outline, "points") and len(corner_pieces(plan, shape.outline)) > 1)


def outlines_on(plan: Plan, points: tuple[str, ...]) -> list[str]:
    """Return the closed outlines that a body carries, by name."""
    home = set(points)
    carried = [name for name, each in plan.of_kind(Outline).items() if each.filled and len(each.carriers) == 2]
    return [name for name in carried if body_points_of(plan, shape_named(plan, name)) <= home]


def pair_at(motion: Motion, chosen: tuple[Pair, ...] | None = None) -> tuple[Pair, float]:
    """Return the pair that comes nearest at a motion's first pose, and the bars' width in their gap [m]."""
    widths = dict.fromkeys(chosen or (), 0.0)
    if chosen is None:
        width = float(np.ravel(motion.value(width_of(motion.plan)))[0])
        widths = {pair: width if thick else 0.0 for pair, thick in pairs_of(motion.plan).items()}
    gaps = {pair: float(gaps_at(motion, pair)[0]) - taken for pair, taken in widths.items()}
    nearest = min(gaps, key=lambda pair: gaps[pair])
    return nearest, widths[nearest]


def pairs_without_planes(motion: Motion) -> tuple[tuple[Pair, ...], tuple[Pair, ...]]:
    """Return the pairs of bodies that stay apart at some pose of a motion, all taken in one plane, and those that cross at each.

    Bodies that share a pin are in neither: they overlap about it.
    """
    plan, apart, crossing = motion.plan, list[Pair](), list[Pair]()
    for a, b in combinations(bodies_of(plan), 2):
        if not set(shape_named(plan, a).points) & set(shape_named(plan, b).points):
            for pair, _ in pairs_of_bodies(plan, a, b):
                (apart if np.any(gaps_at(motion, pair) >= 0.0) else crossing).append(pair)
    return tuple(apart), tuple(crossing)


def nearest_gap(motion: Motion, pairs: Sequence[Pair]) -> FloatArray:
    """Return the least gap of chosen pairs of bodies at each pose of a motion [m], NaN out of reach; bars have no width.

    A pair is looked at where the widths of its bodies say that it may be the nearest at some pose.
    """
    ends = dict[str, tuple[FloatArray, FloatArray]]()
    for name in dict.fromkeys(name for pair in pairs for name in pair):  # where each begins and ends along some directions, (8, n) each
        with unwarned():
            pieces = shape_named(motion.plan, name).pieces(motion.plan, motion._placed, pick)
        places = [(P, np.max(np.asarray(piece.radius))) for piece in pieces for P in piece.places]
        flat = [(np.array([np.broadcast_to(part, motion.shape).ravel() for part in (P.x, P.y)]), radius) for P, radius in places]
        along = [(ACROSS @ each, radius) for each, radius in flat]
        ends[name] = np.min([each - radius for each, radius in along], axis=0), np.max([each + radius for each, radius in along], axis=0)
    apart = {(a, b): np.maximum(ends[b][0] - ends[a][1], ends[a][0] - ends[b][1]).max(axis=0) for a, b in pairs}
    found = np.full(motion.shape, np.inf).ravel()
    for pair in sorted(pairs, key=lambda pair: float(np.fmin.reduce(apart[pair]))):
        if np.any(apart[pair] < found):
            found = np.fmin(found, gaps_at(motion, pair))
    return np.where(motion.reached, found.reshape(motion.shape), np.nan)


ACROSS = np.array([(np.cos(angle), np.sin(angle)) for angle in np.linspace(0.0, np.pi, 8, endpoint=False)])
"""The directions along which the widths of bodies are compared, shape (8, 2)."""


def gaps_at(motion: Motion, pair: Pair) -> FloatArray:
    """Return the gap of two bodies at all poses of a motion in a row [m], NaN out of reach; for many pairs, each asked for once."""
    check_forms(motion, pair)
    with unwarned():
        found = gap_in(motion.plan, motion._placed, pick, *pair)
    return np.where(motion.reached, found, np.nan).ravel()
