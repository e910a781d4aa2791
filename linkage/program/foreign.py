"""A program in another language, line by line: a C function over the poses of one design, and what packages add."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import final

from .elimination import expanded
from .node import Node
from .schedule import Schedule, schedule
from .text import TEMPLATES, Dialect, NodeNames, lettered, loop_text

NOTHING: Mapping[str, float] = MappingProxyType({})


def number_text(value: float, infinite: str, nothing: str) -> str:
    """Return a number as a language writes it."""
    if math.isnan(value):
        return nothing
    return repr(value) if math.isfinite(value) else infinite if value > 0.0 else f"-{infinite}"


@final
@dataclass(frozen=True)
class ProgramText:
    """A program as lines of one language, for a function to be put around them.

    `comment` says what the inputs are: dimensions `d`, strokes `p`, each in the order of its elements. `design` are the lines of what
    depends on the dimensions alone, `lines` those of a pose, which read the strokes as `i0`, `i1`, ... up to `strokes` of them;
    `outputs` are what the results are called in the end.
    """

    name: str
    comment: str
    design: tuple[str, ...]
    strokes: int
    lines: tuple[str, ...]
    outputs: tuple[str, ...]


class Language(ABC):
    """A language that values and ratios are written in. A package adds its own by an entry point of `hydrolinkage.languages`.

    `dialect` says how operations, numbers and assignments are written (each operation of `TEMPLATES` has one, and NaN is passed on);
    `words` are the names that no function may have. `function` puts the function around the lines.
    """

    dialect: Dialect
    words: str = ""

    @abstractmethod
    def function(self, program: ProgramText) -> list[str]:
        """Return the lines of the whole text: a function of dimensions and strokes that gives the outputs."""

    def element(self, array: str, place: int) -> str:
        """Return how an element of an array is written, counted from 0: `d[2]`."""
        return f"{array}[{place}]"

    def text(self, outputs: Sequence[Node], name: str = "poses", design: Mapping[str, float] = NOTHING) -> str:
        """Return the text of a function of some nodes; a comment in it names the inputs, with the values of a design."""
        plan = schedule(expanded(outputs))
        lines, results, _ = loop_text(plan, self.dialect)
        names = NodeNames(self.dialect, {node: self.element("d", place) for place, node in enumerate(plan.design_inputs)})
        before = names.assign(plan.design, "w")
        before += [self.dialect.assignment.format(each, names.read(node)) for node, each in lettered("c", plan.passed).items()]
        program = ProgramText(name, inputs_text(plan, design), tuple(before), len(plan.pose_inputs), tuple(lines), tuple(results))
        return "\n".join(self.function(program)) + "\n"


@final
class C(Language):
    """C99: `void poses(long n, const double *d, const double *const *p, double *const *o)`.

    `d` holds the dimensions, `p` the strokes and solved coordinates, each n long, `o` the outputs, each n long. For its full speed compile
    it with `-O3 -march=native -fno-math-errno -fno-trapping-math`.
    """

    dialect = Dialect(
        {
            **TEMPLATES,
            "sign": "({0} > 0.0 ? 1.0 : {0} < 0.0 ? -1.0 : {0})",
            "minimum": "({0} <= {1} || {0} != {0} ? {0} : {1})",
            "maximum": "({0} >= {1} || {0} != {0} ? {0} : {1})",
            "pick": "({0} <= {1} ? {2} : {3})",
            "arctan2": "atan2({}, {})",
            "absolute": "fabs({})",
            "power": "pow({}, {})",
        },
        lambda value: number_text(value, "INFINITY", "NAN"),
        "const double {} = {};",
    )
    words = (
        "auto break case char const continue default do double else enum extern float for goto if inline int long register restrict return"
        " short signed sizeof static struct switch typedef union unsigned void volatile while main NAN INFINITY"
        " acos asin atan atan2 ceil cos cosh exp exp2 expm1 fabs floor fma fmax fmin fmod frexp hypot isfinite isinf isnan ldexp log log10"
        " log1p log2 modf pow remainder rint round signbit sin sinh sqrt tan tanh trunc"
    )

    def function(self, program: ProgramText) -> list[str]:
        return [
            "#include <math.h>",
            f"/* {program.comment} */",
            f"void {program.name}(long n, const double *d, const double *const *p, double *const *o) {{",
            *(f"    {line}" for line in program.design),
            *(f"    const double *restrict x{k} = p[{k}];" for k in range(program.strokes)),
            *(f"    double *restrict o{k} = o[{k}];" for k in range(len(program.outputs))),
            "    for (long b = 0; b < n; b++) {",
            *(f"        const double i{k} = x{k}[b];" for k in range(program.strokes)),
            *(f"        {line}" for line in program.lines),
            *(f"        o{k}[b] = {result};" for k, result in enumerate(program.outputs)),
            "    }",
            "}",
        ]


def inputs_text(plan: Schedule, design: Mapping[str, float]) -> str:
    """Return which inputs are which, and what those of a design are."""
    names = [node.value for node in plan.design_inputs]
    given = ", ".join(f"{name} = {design[name]!r}" if name in design else name for name in names)
    moved = ", ".join(node.value for node in plan.pose_inputs)
    return f"d: {given or 'none'}; p: {moved or 'none'}; {len(plan.outputs)} outputs"
