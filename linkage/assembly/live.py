"""How groups are solved and angles followed, as JavaScript: the rules traced, the loops around them from files beside this one."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from ..errors import is_listed
from ..plan import Plan
from ..program import Graph, Inputs, Level, Node, arrow_function, function_body, number, short_names
from . import angle_continuation
from .angle_continuation import followed_nodes, piece_length
from .groups import LINE, largest_step
from .newton import ITERATIONS, Programs, at_sketch
from .rules import FIRST, TOUCH, goes_on, interpolated, newton_ended, predicted, step_judged

Rule = Callable[..., Any]


def traced_rule(count: int, rule: Rule) -> str:
    """Return a rule of so many numbers as a JavaScript function that gives an array."""
    graph, names = Graph(), short_names(())
    given = {graph.input(f"{place}", Level.POSE): next(names) for place in range(count)}
    found = rule(*given, choose=graph.pick)
    results = found if isinstance(found, tuple) else (found,)
    return f"({','.join(given.values())})=>{function_body(given, [graph.node(each) for each in results])}"


def place_ahead(*given: Any, choose: Any) -> tuple[object, ...]:
    """Return the next place, and one coordinate predicted there: step, limit, three places and the coordinate's three values."""
    place, (line,), (start,) = predicted(given[0], given[1], given[2:5], [[each] for each in given[5:]], choose)
    return place, line, start


def place_between(*given: Any, choose: Any) -> tuple[object, ...]:
    """Return one coordinate predicted at a place, and its bound: three places, its values, clearances and sizes."""
    (found,), bound = interpolated(given[0], given[1:4], [[each] for each in given[4:7]], given[7:9], given[9:], choose)
    return found, bound


def groups_text(plan: Plan, inputs: Inputs, dimensions: Sequence[str]) -> str:
    """Return JavaScript that solves the groups of a plan; dimensions by their names in the order of a design."""
    seeds, graph, groups, start = at_sketch(plan), plan.trace.graph, list[str](), len(plan.strokes)
    for group in plan.groups.values():  # functions of its pins: a step, the clearance, and the equations with their slopes
        programs, count = Programs.for_group(plan, group), len(group.inputs) - 1
        given = {node: inputs.read(node) for node in graph.nodes if node.op == "input" and node.value in inputs}
        known = {graph.input(f"@k{place}", Level.POSE): f"k[{place}]" for place in range(len(programs.known))}
        pins = {graph.input(name, Level.POSE): f"u[{place}]" for place, name in enumerate(group.inputs[:-1])}
        steps, clear = programs.nodes[: count + 2], [*programs.nodes[count + 2 :], programs.nodes[count + 1]]
        functions = (f"u=>{function_body(known | pins, each, 'ku')}" for each in (steps, clear, programs.raw.plan.outputs))
        body = f"const k=(()=>{function_body(given, programs.known, 'dp')})();return[{','.join(functions)}]"
        groups.append(f"[{start},(d,p)=>{{{body}}}]")
        start += count + 1
    numbers = {
        "seeds": [seeds[name][:, 0].tolist() for name in plan.groups],
        "d0": [plan.defaults[name] for name in dimensions],
        "LARGEST": largest_step(plan, next(iter(plan.strokes))),
        **{"ITERATIONS": ITERATIONS, "FIRST": FIRST, "TOUCH": TOUCH, "LINE": LINE},
    }
    constants = {"groups": f"[{','.join(groups)}]", **{name: json_of(value) for name, value in numbers.items()}}
    rules: dict[str, tuple[int, Rule]] = {"ended": (3, newton_ended), "predicted": (8, place_ahead), "judged": (7, step_judged)}
    rules |= {"goes": (4, goes_on), "between": (11, place_between)}
    return "".join(f"const {name}={traced_rule(count, rule)};" for name, (count, rule) in rules.items()) + constants_text(constants)


def angles_text(plan: Plan, clipped: Callable[[Plan, Sequence[Node]], Sequence[Node]], inputs: Inputs) -> str:
    """Return JavaScript that follows the angles of a plan; `clipped` clips nodes at a dead point to rounding."""
    vectors = [arrow_function(clipped(plan, followed_nodes(plan, name)), inputs) for name in plan.followed]
    numbers = {
        "FOLLOWED": len(plan.strokes) + len(plan.grouped),
        "units": [piece_length(plan, name) for name in plan.strokes],
        **{name: getattr(angle_continuation, name) for name in ("SHORT", "LEAST", "STRAIGHT")},
    }
    return constants_text({"followed": f"[{','.join(vectors)}]", **{name: json_of(value) for name, value in numbers.items()}})


def constants_text(constants: Mapping[str, str]) -> str:
    """Return the text that declares some constants."""
    return f"const {','.join(f'{name}={text}' for name, text in constants.items())};"


def json_of(value: Any) -> str:
    """Return numbers, also in lists, as JavaScript."""
    return f"[{','.join(map(json_of, value))}]" if is_listed(value) else number(float(value))
