"""Programs in other languages: a C function over the poses of one design, compact JavaScript, and further ones from packages."""

from __future__ import annotations

import math
import re
from abc import ABC, abstractmethod
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from itertools import product
from string import ascii_lowercase, ascii_uppercase
from types import MappingProxyType
from typing import NamedTuple

from .. import plugins
from ..errors import instance_of
from ..frozen import record
from ..plugins import Plugins
from .elimination import expanded
from .node import Level, Node
from .schedule import Schedule, ancestors, lowered, schedule
from .text import TEMPLATES, Dialect, NodeNames, lettered, loop_text

NOTHING: Mapping[str, float] = MappingProxyType({})


def number_text(value: float, infinite: str, nothing: str) -> str:
    """Return a number as a language writes it."""
    if math.isnan(value):
        return nothing
    return repr(value) if math.isfinite(value) else infinite if value > 0.0 else f"-{infinite}"


class ProgramText(NamedTuple):
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
    """Return the order of the inputs, and the values of those of a design."""
    names = plan.input_names[0]
    given = ", ".join(f"{name} = {design[name]!r}" if name in design else name for name in names)
    moved = ", ".join(plan.input_names[1])
    return f"d: {given or 'none'}; p: {moved or 'none'}; {len(plan.outputs)} outputs"


# JavaScript, for pages that carry it in one file, and for pages of one's own. An operation that is read once stands where it is read; every
# other has a name of a letter or two. Nothing is worked out in another order or another way, so that the numbers are those of the program.
# In a page systems of equations are solved and angles are continued where it runs: `MATHS` and `PARTS` say by which functions; a text that
# stands alone brings its own.

MATHS: Mapping[str, str] = MappingProxyType(
    {"sqrt": "Q", "sin": "S", "cos": "C", "tan": "T", "exp": "E", "log": "L", "power": "P", "absolute": "A", "arctan2": "X"}
)
"""What Math's functions are called."""
PARTS: Mapping[str, str] = MappingProxyType({"minimum": "I", "maximum": "M", "sign": "G", "solve": "J", "turns": "U"})
"""What the functions are called that JavaScript has not: least, greatest and sign with NaN passed on, a system, a continued angle."""
ALONE: Mapping[str, str] = MappingProxyType(
    {name: f"Math.{name}" for name in MATHS} | {"power": "Math.pow", "absolute": "Math.abs", "arctan2": "Math.atan2"}
)
"""What Math's functions are called in a text that stands alone."""
OWN: Mapping[str, str] = MappingProxyType(
    {
        PARTS["minimum"]: "(a, b) => a <= b || a !== a ? a : b",
        PARTS["maximum"]: "(a, b) => a >= b || a !== a ? a : b",
        PARTS["sign"]: "a => a > 0 ? 1 : a < 0 ? -1 : a",
    }
)
"""The functions that such a text brings along where it needs them."""
KEPT = frozenset({*MATHS.values(), *PARTS.values(), "V", "do", "if", "in", "of", "as", "is", "for", "let", "new", "try", "var"})
DEEP = 40
"""An operation nested so deep has a name."""
SUM, PRODUCT, UNARY, ATOM, CHOICE = 1, 2, 3, 4, 0
SIGNS: Mapping[str, tuple[str, int]] = MappingProxyType(
    {"add": ("+", SUM), "subtract": ("-", SUM), "multiply": ("*", PRODUCT), "divide": ("/", PRODUCT)}
)


def number(value: float) -> str:
    """Return a number in few letters: `.5`, `2`, `1e-9`."""
    text = number_text(value, "Infinity", "NaN")
    if "e" in text:
        digits, _, power = text.partition("e")
        return f"{digits.removesuffix('.0')}e{int(power)}"
    text = text.removesuffix(".0")
    return text.replace("0.", ".", 1) if text.lstrip("-").startswith("0.") else text


def short_names(taken: Collection[str]) -> Iterator[str]:
    """Yield names of one letter, then of two, that are not taken."""
    letters = ascii_lowercase + ascii_uppercase
    for size in (1, 2, 3):
        for each in map("".join, product(letters, repeat=size)):
            if each not in KEPT and each not in taken:
                yield each


@dataclass
class Expressions:
    """Nodes as JavaScript: nodes with a name are in `named`, others are written where they are read, once; `turning` are angles."""

    named: dict[Node, str]
    taken: set[str]
    turning: Mapping[Node, int] = field(default_factory=dict)
    uses: Counter[Node] = field(default_factory=Counter)
    maths: Mapping[str, str] = field(default_factory=lambda: MATHS)
    depth: dict[Node, int] = field(default_factory=dict)
    """How deep the text of a node is nested."""

    def statements(self, nodes: Sequence[Node]) -> str:
        """Return the text that names those of some nodes, in order of dependence, which are read more than once; "" for none."""
        names, found = short_names(self.taken), []
        for node in nodes:
            self.depth[node] = 1 + max([0 if arg.origin in self.named else self.depth.get(arg.origin, 0) for arg in node.args])
            if self.uses[node] > 1 or node.op == "solve" or node in self.turning or self.depth[node] > DEEP:
                text = self.operation(node)[0]
                self.named[node] = name = next(names)
                self.taken.add(name)
                found.append(f"{name}={text}")
        return f"const {','.join(found)};" if found else ""

    def read(self, node: Node, least: int = CHOICE) -> str:
        """Return a node as an operand that binds at least so strongly."""
        node = node.origin
        if node.op == "constant":
            text = number(node.value)
            return f"({text})" if text.startswith("-") and least > SUM else text
        if node in self.named:
            return self.named[node]
        text, binds = self.operation(node)
        return f"({text})" if binds < least else text

    def operation(self, node: Node) -> tuple[str, int]:
        """Return a node's operation, and how strongly it binds."""
        args = node.args
        if node.op in SIGNS:
            sign, binds = SIGNS[node.op]
            return f"{self.read(args[0], binds)}{sign}{self.read(args[1], binds + 1)}", binds
        if node.op == "negative":
            return f"-{self.read(args[0], ATOM)}", SUM
        if node.op == "reciprocal":
            return f"1/{self.read(args[0], UNARY)}", PRODUCT
        if node.op == "square":
            return f"{self.read(args[0])}*{self.read(args[0])}", PRODUCT
        if node.op == "pick":
            a, b = (self.read(arg, SUM) for arg in args[:2])
            x, y = map(self.read, args[2:])
            return f"{a}<={b}?{x}:{y}", CHOICE
        if node.op == "component":
            return f"{self.read(args[0])}[{int(args[1].value)}]", ATOM
        given = ",".join(map(self.read, args))
        if node.op == "solve":
            return f"{PARTS['solve']}([{given}])", ATOM
        text = f"{self.maths[node.op] if node.op in self.maths else PARTS[node.op]}({given})"
        return (f"{PARTS['turns']}({self.turning[node]},{text})" if node in self.turning else text), ATOM


def counted(results: Sequence[Node], nodes: Sequence[Node]) -> Counter[Node]:
    """Return how often each node is read by others and by the results; the argument of a square counts twice."""
    uses = Counter(each.origin for each in results)
    for node in nodes:
        uses.update(arg.origin for arg in node.args)
        if node.op == "square":
            uses[node.args[0].origin] += 1
    return uses


CONTINUED = f"const u=[],{PARTS['turns']}=(k,a)=>{{a-=V*Math.round((a-(u[k]??a))/V);if(a===a)u[k]=a;return a}};"
"""Angles continued from pose to pose, NaN passed over; V is a turn."""


@record
class Inputs:
    """How inputs are read: the dimensions `d[k]`, all else that is given `p[k]`, by their places there."""

    design: Mapping[str, int]
    pose: Mapping[str, int]

    def __contains__(self, name: object) -> bool:
        return name in self.design or name in self.pose

    def read(self, node: Node) -> str:
        """Return an input's text."""
        name = str(node.value)
        return f"d[{self.design[name]}]" if name in self.design else f"p[{self.pose[name]}]"


def arrow_function(results: Sequence[Node], inputs: Inputs, turning: Sequence[Node] = ()) -> str:
    """Return `d=>{...;return p=>{...;return[...]}}`: the design's part is worked out once, angles are continued from pose to pose."""
    both, count = lowered([*results, *turning]), len(results)
    results, angles = both[:count], both[count:]
    nodes = [node for node in ancestors(results) if node.op != "constant"]
    order = {node: place for place, node in enumerate(angles)}
    writer = Expressions({}, {"d", "p", "u"}, order, uses=counted(results, nodes))
    own = [node for node in nodes if node.level is Level.DESIGN]
    moving = [node for node in nodes if node.level is Level.POSE]
    across = {arg.origin for node in moving for arg in node.args} | {each.origin for each in results}
    writer.uses.update({node: 2 for node in own if node in across and node.op != "input"})  # once a design, not once a pose
    texts = []
    for part in (own, moving):
        names, found = short_names(writer.taken), list[str]()
        for node in (node for node in part if node.op == "input"):  # one that is read once is read in place
            writer.named[node] = text = inputs.read(node)
            if writer.uses[node] > 1:
                writer.named[node] = name = next(names)
                writer.taken.add(name)
                found.append(f"{name}={text}")
        heads = f"const {','.join(found)};" if found else ""
        texts.append(heads + writer.statements([node for node in part if node.op != "input"]))
    ends = ",".join(map(writer.read, results))
    return f"d=>{{{CONTINUED if order else ''}{texts[0]}return p=>{{{texts[1]}return[{ends}]}}}}"


def function_body(given: Mapping[Node, str], results: Sequence[Node], outer: Collection[str] = (), maths: Mapping[str, str] = MATHS) -> str:
    """Return `{...;return[...]}`, a function's inside: results from nodes that are called so; `outer` are names that mean others there."""
    results = lowered(results)
    nodes = [node for node in ancestors(results, given) if node not in given and node.op != "constant"]
    writer = Expressions(dict(given), {*given.values(), *outer}, {}, uses=counted(results, nodes), maths=maths)
    return f"{{{writer.statements(nodes)}return[{','.join(map(writer.read, results))}]}}"


class JavaScript:
    """JavaScript as a language of `source`: `function poses(d, p)`, dimensions and strokes in arrays; the outputs in one."""

    words = (
        "arguments await break case catch class const continue debugger default delete do else enum eval export extends false finally for"
        " function if implements import in instanceof interface let new null package private protected public return static super switch"
        " this throw true try typeof var void while with yield Math NaN Infinity undefined"
    )

    def text(self, outputs: Sequence[Node], name: str = "poses", design: Mapping[str, float] = NOTHING) -> str:
        """Return the text of such a function of some nodes."""
        plan = schedule(expanded(outputs))
        inputs = (("d", plan.design_inputs), ("p", plan.pose_inputs))
        given = {node: f"{letter}[{k}]" for letter, part in inputs for k, node in enumerate(part)}
        text = function_body(given, plan.outputs, ("d", "p"), ALONE)
        own = "".join(f"    const {each} = {rule};\n" for each, rule in OWN.items() if f"{each}(" in text)
        lines = re.sub(r",(?=\w+=[^=])", ",\n        ", text[1:-1]).replace(";return", ";\n    return ")
        return f"/* {inputs_text(plan, design)} */\nfunction {name}(d, p) {{\n{own}    {lines};\n}}\n"


LANGUAGES = Plugins[Language | JavaScript](
    plugins.LANGUAGES,
    "The language",
    partial(instance_of, kind=Language),
    "no subclass of linkage.program.Language",
    {"c": C(), "javascript": JavaScript()},
)
"""The languages there are, by name."""
