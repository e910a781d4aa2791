"""A program as C: one function over poses of one design, for other programs and as a measure of speed."""

from __future__ import annotations

import math
from collections.abc import Sequence

from .expand import expanded
from .loop import loop, numbered
from .node import Node
from .schedule import Schedule, schedule
from .text import TEMPLATES, Dialect, Names


def number(value: float) -> str:
    """Return a number as C writes it."""
    return {math.inf: "INFINITY", -math.inf: "-INFINITY"}.get(value, "NAN" if math.isnan(value) else repr(value))


C = Dialect(
    {
        **TEMPLATES,
        "arctan2": "atan2({}, {})",
        "absolute": "fabs({})",
        "power": "pow({}, {})",
        "sign": "({0} > 0.0 ? 1.0 : {0} < 0.0 ? -1.0 : {0})",
        "minimum": "({0} <= {1} || {0} != {0} ? {0} : {1})",
        "maximum": "({0} >= {1} || {0} != {0} ? {0} : {1})",
        "pick": "({0} <= {1} ? {2} : {3})",
    },
    number,
    "const double {} = {};",
)


def c_text(outputs: Sequence[Node], name: str = "poses") -> str:
    """Return C99 text of `void poses(long n, const double *d, const double *const *p, double *const *o)`.

    `d` holds the dimensions, `p` the strokes and solved coordinates, each n long, `o` the outputs, each n long; a comment
    names them. For its full speed compile it with `-O3 -march=native -fno-math-errno -fno-trapping-math`.
    """
    plan = schedule(expanded(outputs))
    inside = loop(plan, C)
    lines = [
        "#include <math.h>",
        f"/* d: {listed(plan.design_inputs)}; p: {listed(plan.pose_inputs)}; {len(plan.outputs)} outputs */",
        f"void {name}(long n, const double *d, const double *const *p, double *const *o) {{",
        *(f"    {line}" for line in design_lines(plan)),
        *(f"    const double *restrict x{k} = p[{k}];" for k in range(len(plan.pose_inputs))),
        *(f"    double *restrict o{k} = o[{k}];" for k in range(len(plan.outputs))),
        "    for (long b = 0; b < n; b++) {",
        *(f"        const double i{k} = x{k}[b];" for k in range(len(plan.pose_inputs))),
        *(f"        {line}" for line in inside.lines),
        *(f"        o{k}[b] = {result};" for k, result in enumerate(inside.outputs)),
        "    }",
        "}",
    ]
    return "\n".join(lines) + "\n"


def design_lines(plan: Schedule) -> list[str]:
    """Return the design part, its results called as the loop calls them."""
    names = Names(C, {node: f"d[{k}]" for k, node in enumerate(plan.design_inputs)})
    lines = names.assign(plan.design, "w")
    return lines + [f"const double {name} = {names.read(node)};" for node, name in numbered("c", plan.passed).items()]


def listed(nodes: Sequence[Node]) -> str:
    """Return the names of inputs."""
    return " ".join(str(node.value) for node in nodes) or "none"
