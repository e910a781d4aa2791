"""The mobility of a mechanism: the true one, from the rank of its constraints, and the Gruebler count beside it."""

from __future__ import annotations

from cmath import exp, phase
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from ..assembly import places_at, places_drawn
from ..errors import AssemblyError, DefinitionError, SingularError, ensure
from ..frozen import record
from ..plan import Part, Plan, Reading, Trace, carrying_pairs, member_sides, merged, strokes_text
from ..program import FloatArray, Level, Node, Tangent, ancestors, interpret
from ..quantities import joined_names, quantity, source_text
from ..shown import Shown
from ..steps import Link, match
from ..units import mm, show
from ..vectors import Numbers, Scalar, Vec

if TYPE_CHECKING:
    import networkx as nx


# The constraints of a mechanism with all its points free: their Jacobian at a pose, from the rules of the steps.

Places = Mapping[str, tuple[float, float]]


def step_rows(plan: Plan, places: Places, inputs: Mapping[str, Numbers]) -> tuple[FloatArray, list[str], tuple[str, ...]]:
    """Return the rows of the steps' own constraints at a pose, each of length one, the members that they come from, and their unknowns.

    These are the coordinates of the points, without those that no body holds, and the strokes.
    """
    levels = dict.fromkeys((*plan.strokes, *plan.solved), Level.POSE) | dict.fromkeys(plan.table.entries, Level.DESIGN)
    trace = Trace(plan.members, plan.table.lengths, levels)
    for name in plan.points:  # which are inputs: `@B.x`, `@B.y`
        trace.positions[name] = Vec(trace.graph.input(f"@{name}.x", Level.POSE), trace.graph.input(f"@{name}.y", Level.POSE))
    residuals: dict[str, tuple[Scalar, ...]] = {}
    found_with = {pin for group in plan.groups.values() for pin in group.pins[1:]}
    for name, member in plan.holding.items():
        if name not in found_with:
            trace.placing.append(name)
            residuals[name] = member.constraints(trace)
            trace.placing.pop()
    nodes = [(owner, trace.graph.node(each)) for owner, found in residuals.items() for each in found]
    held = {owner for owner, _ in nodes if owner in plan.points} | {point for body in plan.links for point in body.points}
    held |= {pin for group in plan.groups.values() for pin in group.pins}  # others are free constructions
    seeds: dict[str, Node] = {
        f"{name}.{axis}": getattr(trace.positions[name], axis) for name in plan.moving if name in held for axis in "xy"
    }
    seeds |= {name: trace.inputs[name] for name in plan.strokes}
    columns = {seed: column for column, seed in enumerate(seeds.values())}
    tangents = [Tangent(trace.graph, {seed: 1.0}) for seed in columns]
    behind = [(row, columns[each], node) for row, (_, node) in enumerate(nodes) for each in ancestors([node]) if each in columns]
    at = dict(inputs) | {f"@{name}.{axis}": places[name][k] for name in plan.points for k, axis in enumerate("xy")}
    matrix = np.zeros((len(nodes), len(seeds)))
    slopes = interpret([tangents[column].derivative(node) for _, column, node in behind], at)
    for (row, column, _), value in zip(behind, slopes, strict=True):
        matrix[row, column] = float(value)
    return unit_rows(matrix), [owner for owner, _ in nodes], tuple(seeds)


def rigid_rows(points: tuple[str, ...], places: Places, unknowns: tuple[str, ...]) -> list[FloatArray]:
    """Return the first-order conditions that some points move as one body."""
    complex_at = {point: complex(*places[point]) for point in points}
    P = points[0]
    Q = max(points[1:], key=lambda point: abs(complex_at[point] - complex_at[P]))
    base = complex_at[Q] - complex_at[P]
    direction = base / abs(base)
    rows = [coordinate_row({Q: direction, P: -direction}, unknowns)]
    for X in points[1:]:
        if X != Q:
            turn = ((complex_at[X] - complex_at[P]) / base).conjugate()
            # dX - dP - turn (dQ - dP) = 0, its real and its imaginary part
            rows += [coordinate_row({X: unit, P: unit * (turn - 1), Q: -unit * turn}, unknowns) for unit in (1, 1j)]
    return rows


def cylinder_sides(plan: Plan, link: Link) -> tuple[tuple[str, ...], ...]:
    """Return the points of a link that is a driven length with points along it, by sides, each with its end first; empty for any other."""
    carrying = carrying_pairs(plan) if len(link.point_names) > 2 else frozenset()
    for bar in plan.cylinders:
        if frozenset((bar.P, bar.Q)) in carrying and {bar.P, bar.Q} <= set(link.point_names):
            _, far = member_sides(plan, (bar.P, bar.Q), link.point_names)
            others = [point for point in link.point_names if point not in (bar.P, bar.Q)]
            return (bar.P, *(each for each in others if each not in far)), (bar.Q, *(each for each in others if each in far))
    return ()


def sided_rows(sides: tuple[tuple[str, ...], ...], places: Places, unknowns: tuple[str, ...]) -> list[FloatArray]:
    """Return the first-order conditions that points keep their places on the two sides of a driven length."""
    rows = []
    for (P, *others), (Q, *_) in (sides, sides[::-1]):
        base = complex(*places[Q]) - complex(*places[P])
        turn = 1j * base / abs(base) ** 2
        for X in others:
            across = 1j * (complex(*places[X]) - complex(*places[P]))
            # dX - dP - across (turn . (dQ - dP)) = 0, its real and its imaginary part
            parts = (across.real * turn, 1), (across.imag * turn, 1j)
            rows += [coordinate_row({X: unit, P: part - unit, Q: -part}, unknowns) for part, unit in parts]
    return rows


def coordinate_row(terms: Mapping[str, complex], unknowns: tuple[str, ...]) -> FloatArray:
    """Return a row from its part for each point: the scalar product with (x, y) written as a complex number."""
    found = np.zeros(len(unknowns))
    for point, part in terms.items():
        if f"{point}.x" in unknowns:
            found[unknowns.index(f"{point}.x")] += complex(part).real
            found[unknowns.index(f"{point}.y")] += complex(part).imag
    return found


def unit_rows(matrix: FloatArray) -> FloatArray:
    """Return the rows scaled to length one; rows of zeros stay."""
    size = np.linalg.norm(matrix, axis=1, keepdims=True)
    return np.asarray(matrix / np.where(size > 0.0, size, 1.0))


RANK = 1e-8
ROUNDING = 1e-14
"""What the last digits make of a distance of nothing, over the largest coordinate of a machine."""
ASIDE = (0.5, 0.37, 0.61)
"""Shares of the strokes at which mobility is looked at again: of whole turns, the middle may be in line, or at rest, as well."""


@record
class Mobility:
    """The number of independent motions, by rank and by count, the redundant links, and the loose bodies.

    `loose` are the bodies that can move while the drives are locked.
    """

    rank: int
    gruebler: int
    strokes: int
    redundant: tuple[str, ...]
    locking: tuple[str, ...]
    loose: tuple[str, ...] = ()
    dead: str = ""
    """Why it is that of a dead point alone, in words; "" where it is not."""

    def __str__(self) -> str:
        words = [f"mobility {self.rank} (strokes {self.strokes}, Gruebler count {self.gruebler})"]
        words += [f"the link {name} is redundant: the linkage is overconstrained, it moves the same without it" for name in self.redundant]
        words += [f"the link {name} locks the linkage" for name in self.locking]
        words += [f"loose, so that it can still move while the drives are locked: {', '.join(self.loose)}"] if self.loose else []
        words += [f"so it is where it is drawn. {self.dead}"] if self.dead else []
        return "; ".join(words)


def mobility(plan: Plan) -> Mobility:
    """Return the mobility at the sketch; where it is not the number of strokes there, in the middle of these or aside of it.

    Where branches cross the rank is too small, and where a stroke starts at rest its own part of it is missing. Where a group is drawn in
    a dead point it is that of the drawing. AssemblyError where the mechanism cannot be assembled at the sketch, nor there.
    """
    found: list[Mobility] = []
    lost: list[AssemblyError] = []
    for strokes in (plan.sketch_strokes, *(strokes_at(plan, share) for share in ASIDE)):
        try:
            found.append(mobility_at(plan, *places_at(plan, strokes)))
        except SingularError as error:
            return replace(mobility_at(plan, *places_drawn(plan)), dead=str(error))
        except AssemblyError as error:
            lost.append(error)
        if found and found[-1].rank == found[-1].strokes:
            break
    if not found:
        raise lost[0]
    return min(found, key=lambda each: abs(each.rank - each.strokes))


def mobility_at(plan: Plan, places: Places, inputs: Mapping[str, Numbers]) -> Mobility:
    """Return the mobility at a pose."""
    rows, owners, unknowns = step_rows(plan, places, inputs)
    # A link of more points whose length between two of them is driven is a cylinder with points on it: each goes with its own side.
    found: list[FloatArray] = []
    for name, link in plan.of_kind(Link).items():
        if len(link.point_names) == 2 and plan.is_cylinder(link):
            continue
        sides = cylinder_sides(plan, link)
        own = sided_rows(sides, places, unknowns) if sides else rigid_rows(link.point_names, places, unknowns)
        found += own
        owners += [name] * len(own)
    matrix = np.vstack([rows, unit_rows(np.array(found).reshape(len(found), len(unknowns)))])
    active = np.abs(matrix).sum(axis=0) > 0.0
    free = int((active | np.array([name not in plan.strokes for name in unknowns], bool)).sum())
    full, needed = rank(matrix), len(unknowns) - len(plan.strokes)
    extra = [name for name in dict.fromkeys((*owners[len(rows) :], *plan.sliding)) if name not in implied(plan)]
    without = {name: rank(matrix[[owner != name for owner in owners]]) for name in extra}
    locking = tuple(name for name in extra if without[name] < full and full > needed)
    redundant = tuple(name for name in extra if name not in locking and without[name] == full)
    return Mobility(free - full, plan.gruebler, len(plan.strokes), redundant, locking)


def implied(plan: Plan) -> set[str]:
    """Return the links whose points are one body by the steps alone, or that a group's equations hold."""
    groups: list[tuple[str, ...]] = [(bar.P, bar.Q) for bar in plan.rods]
    groups += [body for point in plan.points.values() for body in point.bodies()]
    groups += [(*map(str, step.parents), step.X) for group in plan.groups.values() for step in group.rigid]
    bodies = merged(groups, plan.ground)
    links = {name for name, link in plan.of_kind(Link).items() if any(set(link.point_names) <= set(body.points) for body in bodies)}
    grouped = {slide.name for group in plan.groups.values() for slide in group.slides}
    held = [joint for point in plan.points.values() for joint in point.joints() if joint.track]
    tracks, slots = {(joint.point, plan.track(joint)) for joint in held}, {joint.point for joint in held if joint.kind == "slot"}
    slides = {name: joint for name, slide in plan.sliding.items() for joint in slide.joints()}
    used = {name for name, joint in slides.items() if (joint.point, plan.track(joint)) in tracks or joint.point in slots}
    return links | used | grouped


def rank(matrix: FloatArray) -> int:
    """Return the numerical rank of unit rows; DefinitionError where they have no value."""
    ensure(np.isfinite(matrix).all(), "The sketch holds directions without a value; look for extreme numbers and points that coincide.")
    return int(np.linalg.matrix_rank(matrix, tol=RANK * max(matrix.shape))) if matrix.size else 0


def check(plan: Plan) -> None:
    """Raise DefinitionError where the mobility is not the number of strokes, or a link would have to stretch.

    Steps determine their points by construction; it is links, pins and slides that can hold too little or too much.
    """
    if not any((plan.of_kind(Link), plan.sliding)) or not plan.moving:
        return
    settled = implied(plan) if plan.of_kind(Part) else set[str]()  # what parts have is checked with their own classes
    if {*plan.of_kind(Link), *plan.sliding} <= settled:  # steps hold all links together
        stated = {name: link for name, link in plan.of_kind(Link).items() if link.labels}
        drawn = sample(plan, 0.0) if stated else None
        for name, link in stated.items() if drawn is not None else ():
            check_labels(plan, name, link, *drawn)  # type: ignore[misc]
        return
    try:
        found = mobility(plan)
    except AssemblyError:
        return
    if found.dead:
        return
    by_hand = any(point.hangs_from for point in plan.points.values())
    if found.rank < found.strokes or (found.rank > found.strokes and not by_hand):
        bodies = ", ".join(body.name for body in plan.bodies)
        remedy = "A link, a slide or a stroke is missing: declare all links that hold the points."
        if found.rank < found.strokes:
            remedy = "A link or a slide is too much: take it out."
        if found.locking:
            remedy = f"The link {found.locking[0]} locks the linkage: take it out, or give it the length it needs all over the stroke."
        raise DefinitionError(
            f"{plan.title}: the mobility is {found.rank}, the strokes are {found.strokes} ({', '.join(plan.strokes) or 'none'}). "
            f"Gruebler count {found.gruebler} of the bodies {bodies}. {remedy}",
            member=next(iter(plan.strokes), ""),
        )
    check_lengths(plan)
    check_slides(plan)


def check_lengths(plan: Plan) -> None:
    """Raise DefinitionError where a declared link changes its length over the strokes, or is not as long as it is said to be."""
    samples = [sample(plan, share) for share in (0.0, 0.13, 0.37, 0.61, 0.88, 1.0)]
    known = [found for found in samples if found is not None]
    size = max((abs(each) for places, _ in known for place in places.values() for each in place), default=0.0)
    for name, link in plan.of_kind(Link).items():
        rigid = () if plan.is_cylinder(link) else cylinder_sides(plan, link) or (link.point_names,)
        for P, Q in (pair for points in rigid for pair in combinations(points, 2)):
            lengths = [float(np.hypot(*np.subtract(places[P], places[Q]))) for places, _ in known]
            change = max(lengths, default=0.0) - min(lengths, default=0.0)
            if change > max(1e-9 * max(lengths, default=1.0), ROUNDING * size):
                raise DefinitionError(
                    f"{plan.title}: {name} = {link}: the distance {P}{Q} changes by {change / mm:.3g} mm over the stroke, "
                    "but a link is rigid. Take it out, or correct a length.",
                    member=name,
                )
        if known and link.labels:
            check_labels(plan, name, link, *known[0])


def check_labels(plan: Plan, name: str, link: Link, places: Mapping[str, tuple[float, float]], inputs: Mapping[str, Numbers]) -> None:
    """Raise DefinitionError where a link's labels contradict the places that other labels give."""
    reading = Reading(plan.members, plan.table.lengths, inputs)
    for label, value in link.labels.items():
        ((slot, _, sign, given),) = match({label: value}, link.slots(), f"{name} = {link}").values()
        stated = sign * float(reading.value(quantity(given)))
        sense = -sign if link.is_mirrored and len(slot.points) > 2 else sign
        P, Q, *rest = (complex(*places[point]) for point in slot.points)
        if rest:
            stated = -stated if link.is_mirrored else stated
            found = stated + phase((rest[0] - Q) / (P - Q) * exp(-1j * stated)) if P != Q != rest[0] else stated
            differs, unit = abs(found - stated) > 1e-6, "deg"
        else:
            found, unit = abs(P - Q), "m"
            differs = abs(found - abs(stated)) > max(1e-9 * max(found, abs(stated)), ROUNDING * max(map(abs, (P, Q))))
        if differs:
            raise DefinitionError(
                f"{plan.title}: {name} = {link}: {label} is given as {show(sense * stated, unit)}, but its points are placed by other "
                f"labels, which make it {show(sense * found, unit)}. Take it out, or correct a length or an angle.",
                member=name,
            )


def check_slides(plan: Plan) -> None:
    """Raise DefinitionError where a point does not lie on the guide it is said to slide on."""
    for share in (0.0, 0.37, 0.88) if plan.sliding else ():
        found = sample(plan, share)
        if found is None:
            continue
        reading = Reading(plan.members, plan.table.lengths, found[1])
        for name, slide in plan.sliding.items():
            (point, *_), off = (joint.point for joint in slide.joints()), max(abs(float(each)) for each in slide.constraints(reading))
            if off > 1e-9 * max(1.0, abs(float(reading.at(point).x)), abs(float(reading.at(point).y))):
                where = strokes_text(plan, strokes_at(plan, share))
                raise DefinitionError(
                    f"{plan.title}: {name} = {slide}: {point} is {off / mm:.3g} mm off the guide at {where}. "
                    "Take the slide out, or let it place the point: declare the point as a Pin.",
                    member=name,
                )


def sample(plan: Plan, share: float) -> tuple[dict[str, tuple[float, float]], dict[str, Numbers]] | None:
    """Return the places of all points at a share of every stroke, and the inputs there; None where it cannot be assembled."""
    with suppress(AssemblyError):
        return places_at(plan, strokes_at(plan, share))
    return None


def strokes_at(plan: Plan, share: float) -> dict[str, float]:
    """Return a share of every stroke [m or rad]."""
    return {name: stroke.start + share * (stroke.end - stroke.start) for name, stroke in plan.strokes.items()}


@record
class ChainTables(Shown):
    """A chain as a notebook shows it.

    Bodies have name, kind and points. Joints have name, kind, two bodies and strokes.
    """

    title: str
    bodies: tuple[tuple[str, ...], ...]
    joints: tuple[tuple[str, ...], ...]


def chain_graph(plan: Plan, inputs: Mapping[str, Numbers]) -> nx.MultiGraph:
    """Return the graph of a machine's chain at some inputs: design variables and strokes [SI].

    Of a node, `kind` is "frame", "body", "barrel", "rod", "arm", "carriage" or "block", `points` are its points, `link` is the `Link` that
    declares it, "" for none, and `dimensions` are the distances of its points [m], by their names joined. Of an edge, whose key is its
    name, `kind` is "pin" or "slide", `strokes` are those that drive it, and `dimensions` are the driven lengths as they are written.
    """
    import networkx as nx

    with np.errstate(all="ignore"):  # out of reach, its distances are NaN but those that are given
        reading, chain = plan.read(inputs), plan.chain
    links = {name: set(link.point_names) for name, link in plan.of_kind(Link).items()}
    graph = nx.MultiGraph(name=plan.title)
    for body in chain.bodies:
        link = next((name for name, points in links.items() if body.kind in ("body", "arm") and points <= set(body.points)), "")
        with np.errstate(all="ignore"):
            far = {joined_names(P, Q): np.asarray(reading.link_length(P, Q), float) for P, Q in combinations(body.points, 2)}
        dimensions = {name: length if length.ndim else float(length) for name, length in far.items()}  # an array of a batch of designs
        graph.add_node(body.name, kind=body.kind, points=body.points, link=link, dimensions=dimensions)
    for pair in chain.pairs:
        driven = {} if pair.length is None else {pair.name: source_text(pair.length)}
        graph.add_edge(pair.a, pair.b, key=pair.name, kind=pair.kind, strokes=pair.strokes, dimensions=driven)
    nodes = graph.nodes(data=True)
    bodies = tuple((f"{name} ({data['link']})" if data["link"] else name, data["kind"], " ".join(data["points"])) for name, data in nodes)
    joints = tuple((pair.name, pair.kind, pair.a, pair.b, ", ".join(pair.strokes)) for pair in chain.pairs)
    graph.__dict__["_repr_html_"] = ChainTables(plan.heading, bodies, joints)._repr_html_
    return graph
