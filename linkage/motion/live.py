"""A machine as JavaScript for a live page: positions, outputs and forces over strokes, of any design, with places out of reach.

The text is one program: what is asked for, what tells that a member cannot be placed, and how near every loop is to a dead point, from
shared subexpressions, as `compact` writes them. Pins that are found by iteration and angles that are followed come by the rules that are
used here on arrays.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping, Sequence
from functools import reduce
from importlib.resources import files

import numpy as np

from ..assembly import angles_text, constants_text, groups_text, json_of
from ..errors import DefinitionError, LawError, UntracedError
from ..frozen import FrozenDict, record
from ..plan import ArrayReading, Loop, Plan, rate_name
from ..program import Inputs, Level, Node, ancestors, arrow_function, replaced
from ..steps import Point
from .dead_points import REFUSE
from .evaluation import of_all
from .requests import Request, RequestLike, bound

REGULAR = (1.0 + math.sqrt(1.0 - 0.3**2)) / 0.3
"""The condition up to which a loop does not count where several near dead points lose digits together."""


@record
class LiveText:
    """JavaScript of a machine, and the names of its parts.

    `rows` says where each thing asked for stands among the values, (first row, how many), what is equal in one place; `left_out` why
    others do not; `dimensions` and `strokes` name the arguments in their order.
    """

    text: str
    rows: Mapping[str, tuple[int, int]]
    left_out: Mapping[str, str]
    dimensions: tuple[str, ...]
    strokes: tuple[str, ...]


def live_text(plan: Plan, requests: Mapping[str, RequestLike], name: str = "engine") -> LiveText:
    """Return JavaScript `const engine=...;` that sweeps a machine in a page; requests without a program are left out, with the reason.

    `engine.sweep(d, strokes, rates)` takes a design and an array for each stroke; with requests at rates also for the rate of each stroke,
    and behind these for its acceleration, without them it stands still. It gives `values`, an array for each row. `reason` is 0 where a
    pose is reached, else the number from 1 on of the member in `engine.steps` that cannot be placed; `missing` tells by how much [m]. NaN
    stands where there is no value, and for ratios and forces where a dead point is so near that Python refuses them. `engine.linear(list)`
    gives the unknowns of linear equations, by n * n factors and n right sides.
    """
    found: dict[str, Request] = {}
    left_out: dict[str, str] = {}
    for each, request in requests.items():
        try:
            found[each] = bound(plan, request)
        except (LawError, UntracedError) as error:
            left_out[each] = str(error)
    program, declared, dimensions, places = live_program(plan, tuple(found.values()))
    rows = {each: (first, what.rows) for first, (each, what) in zip(places, found.items(), strict=True)}
    text = f"const {name}=(()=>{{{program}return {{{declared},sweep,linear:J}}}})();"
    return LiveText(text, FrozenDict(rows), FrozenDict(left_out), dimensions, tuple(plan.strokes))


def live_source(plan: Plan, requests: Sequence[Request], name: str, design: Mapping[str, float]) -> str:
    """Return JavaScript that declares `poses(d, p)`, requests at one pose, found along the way from the sketch."""
    program, _, dimensions, places = live_program(plan, tuple(requests))
    stated = ", ".join(f"{each} = {design[each]!r}" for each in dimensions)
    rows = [first + k for first, each in zip(places, requests, strict=True) for k in range(each.rows)]
    head = f"/* d: {stated or 'none'}; p: {', '.join(plan.strokes)}; {len(rows)} outputs */"
    outputs = f"const v=sweep(d,p.map(s=>[s])).values;return {json_of(rows)}.map(k=>v[k][0])"
    return f"{head}\nconst {name}=(()=>{{{program}return (d,p)=>{{{outputs}}}}})();\n"


def live_program(plan: Plan, requests: tuple[Request, ...]) -> tuple[str, str, tuple[str, ...], list[int]]:
    """Return the text that declares `sweep`, further declarations, the dimensions in order, and the requests' first rows, made once."""
    return of_all("live", plan, requests, live_program_on)


def live_program_on(plan: Plan, requests: Sequence[Request]) -> tuple[str, str, tuple[str, ...], list[int]]:
    """Return the same on a plan, which traces them."""
    nodes = [tuple(true_nodes(plan, each)) for each in requests]
    checks = list(checks_of(plan))
    loops = loops_of(plan)
    steep = [each.differentiated(plan) for each in requests]  # near dead points of which loops it is refused, by their places
    keys = [(own, tuple(k for k, loop in enumerate(loops) if loop.step in each)) for own, each in zip(nodes, steep, strict=True)]
    rows, first, refused = list[Node](), dict[object, int](), dict[tuple[int, ...], list[int]]()
    for own, behind in keys:
        if first.setdefault((own, behind), len(rows)) == len(rows):
            refused.setdefault(behind, []).extend(range(len(rows), len(rows) + len(own)))
            rows += own
    ends = [*rows, *(node for _, node in checks), *(node for loop in loops.values() for node in loop)]
    used = set(ancestors(ends))
    angles = [each for each in dict.fromkeys(plan.trace.angles) if each in used and each.level is Level.POSE]
    ends, angles = (found := clipped(plan, [*ends, *angles]))[: len(ends)], found[len(ends) :]
    missing = gaps_of(plan, [name for name, _ in checks])
    dimensions = tuple(plan.table.entries)
    rates = [rate_name(name, order) for order in (1, 2) for name in plan.strokes]
    rates = rates if any(node.op == "input" and node.value in rates for node in used) else []
    inputs = Inputs(
        {each: place for place, each in enumerate(dimensions)},
        {each: place for place, each in enumerate((*plan.strokes, *plan.solved, *rates))},
    )
    constants = {
        "ROWS": json_of(len(rows)),
        "CHECKS": json_of(len(checks)),
        "RATES": json_of([len(plan.strokes) + len(plan.solved) + place for place in range(len(rates))]),
        "REGULAR": json_of(REGULAR),
        "REFUSE": json_of(REFUSE),
        "fixed": f"new Set({json_of([k for k, node in enumerate(rows) if node.level is not Level.POSE])})",
        "refused": json_of([[numbers, list(behind)] for behind, numbers in refused.items() if behind]),
        "sketch": json_of([plan.sketch_strokes[each] for each in plan.strokes]),
        "places": arrow_function(ends, inputs, angles),
        "gaps": arrow_function(missing, inputs),
    }
    text = [part_text("live.js"), constants_text(constants)]
    if plan.solved:
        name, stroke = next(iter(plan.strokes.items()))
        begin, low, high = plan.sketch_strokes[name], min(stroke.start, stroke.end), max(stroke.start, stroke.end)
        text.append(constants_text({"reach": json_of([high - begin, begin - low])}))
    solve = []
    if plan.groups:
        text += [groups_text(plan, inputs, dimensions), part_text("live_groups.js")]
        solve.append("groupsOf(d)")
    if plan.followed:
        text += [angles_text(plan, clipped, inputs), part_text("live_angles.js")]
        solve.append(f"anglesOf(d,{'groupsOf(d)' if plan.groups else '()=>{}'})")
    text.append(f"const solved=d=>{{const f=[{','.join(solve)}];return p=>f.forEach(g=>g(p))}};" + part_text("live_sweep.js"))
    names = {"d": list(dimensions), "p": list(plan.strokes), "steps": [name for name, _ in checks]}
    words = {key: json.dumps(value, ensure_ascii=True, separators=(",", ":")) for key, value in names.items()}
    said = [f"{key}:{value}".replace("<", "\\u003c") for key, value in words.items()]
    said += [f"d0:{json_of([plan.defaults[each] for each in dimensions])}", "sketch", "rows:ROWS"]
    return "".join(text), ",".join(said), dimensions, [first[key] for key in keys]


def part_text(name: str) -> str:
    """Return a file of this room without its comments and the blanks at the ends of lines."""
    lines = (line.strip() for line in files(__package__).joinpath(name).read_text(encoding="utf-8").splitlines())
    return "".join(line for line in lines if not line.startswith("//"))


def true_nodes(plan: Plan, what: Request) -> list[Node]:
    """Return a request's nodes, NaN where their assumptions do not hold, since a page has no close look."""
    nodes = what.nodes(plan)
    truths = [*what.notes(plan).assumed, *what.gaps(plan)]
    holds = reduce(lambda a, b: a.graph.apply("minimum", a, b), truths) if truths else None
    return [node if holds is None else node.graph.pick(0.0, holds, node, math.nan) for node in nodes]


# Where a pose is reached, and where a result is refused.


def clipped(plan: Plan, nodes: Sequence[Node]) -> list[Node]:
    """Return nodes like some, with every loop's root zero where its radicand is negative by no more than rounding: at a dead point."""
    graph, roots = plan.trace.graph, dict[Node, Node]()
    for loop in plan.trace.loops:
        root = graph.known("sqrt", loop.terms[:1]) if loop.kind == "links" else None
        if root is not None and root not in roots:
            radicand, size = replaced((loop.terms[0], loop.terms[2]), roots)
            inside = graph.pick(size * -ArrayReading.ROUNDING, radicand, graph.apply("maximum", radicand, 0.0), radicand)
            roots[root] = graph.as_written("sqrt", (inside,))
    return replaced(nodes, roots)


def checks_of(plan: Plan) -> Iterator[tuple[str, Node]]:
    """Yield a node that is finite where a member can be placed, with the member's name, in the order of construction."""
    trace, graph = plan.trace, plan.trace.graph
    for name, member in plan.members.items():
        for owner, length in plan.following:
            if owner == name:
                yield name, graph.apply("sqrt", trace.value(length))
        if isinstance(member, Point):
            place = trace.at(member)
            if name not in plan.ground:
                yield name, graph.node(place.x + place.y)
        elif name in trace.noted:
            yield name, trace.noted[name]


def gaps_of(plan: Plan, names: Sequence[str]) -> list[Node]:
    """Return, for each check, how much is missing where it fails [m]; NaN where no length tells."""
    found, seen = [], set[str]()
    for name in names:
        lengths = [length for owner, length in plan.following if owner == name]
        negative = name not in seen and bool(lengths)
        found.append(-plan.trace.graph.node(plan.trace.value(lengths[0])) if negative else missing_at(plan, name))
        seen.add(name)
    return found


def missing_at(plan: Plan, name: str) -> Node:
    """Return by how much the sides of a member's triangle are too short, or the shortage that it defines [m]."""
    member, trace = plan.members[name], plan.trace.view()
    graph, sides = trace.graph, member.sides(trace)
    if sides:
        values = [graph.node(value) for _, value in sides]
        most = graph.apply("maximum", graph.apply("maximum", values[0], values[1]), values[2])
        return graph.node(2.0 * most - (values[0] + values[1] + values[2]))
    if not isinstance(member, Point):
        return graph.constant(math.nan)
    try:
        return graph.node(member.shortage(trace)[1])
    except DefinitionError:
        return graph.constant(math.nan)


def loops_of(plan: Plan) -> dict[Loop, tuple[Node, Node]]:
    """Return for every loop that moves the sine of its links' angle, and how much larger the numbers are whose difference closes it.

    A direction that is taken between points loses digits as a loop does, by their distance over the machine's size; so does a slot's.
    """
    found: dict[Loop, tuple[Node, Node]] = {}
    graph, extent = plan.trace.graph, plan.trace.graph.node(np.sqrt(plan.trace.extent))
    for loop in dict.fromkeys(plan.trace.loops):
        member = plan.members.get(loop.step)
        if member is None or not plan.moves(member):
            continue
        if loop.kind == "meeting":
            found[loop] = graph.node(loop.terms[0] / extent), graph.one
        elif loop.kind == "length" or (isinstance(member, Point) and not member.closes):
            continue
        elif loop.kind == "guides":
            found[loop] = loop.terms[0], graph.one
        else:
            radicand, scale, size = loop.terms
            is_way = scale.op == "sqrt" and scale.args[0].origin is size  # to the pin of a slot
            span = graph.apply("maximum", scale, extent) if is_way else scale
            found[loop] = graph.node(np.sqrt(radicand) / span), graph.node(size / (scale * scale))
    return found
