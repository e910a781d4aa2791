"""Values and ratios as the text of a function in C or JavaScript: for a controller, or a page of one's own."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from ..errors import DefinitionError, one_word
from ..plan import Plan
from ..program import Kernel, Node, c_text, javascript_text
from .requests import BoundRequest, RequestLike, all_bound

WRITERS: Mapping[str, Callable[[Sequence[Node], str, Mapping[str, float]], str]] = {"c": c_text, "javascript": javascript_text}

TAKEN: Mapping[str, str] = {
    "c": (
        "auto break case char const continue default do double else enum extern float for goto if inline int long register restrict return"
        " short signed sizeof static struct switch typedef union unsigned void volatile while main NAN INFINITY"
        " acos asin atan atan2 ceil cos cosh exp exp2 expm1 fabs floor fma fmax fmin fmod frexp hypot isfinite isinf isnan ldexp log log10"
        " log1p log2 modf pow remainder rint round signbit sin sinh sqrt tan tanh trunc"
    ),
    "javascript": (
        "arguments await break case catch class const continue debugger default delete do else enum eval export extends false finally for"
        " function if implements import in instanceof interface let new null package private protected public return static super switch"
        " this throw true try typeof var void while with yield Math NaN Infinity undefined"
    ),
}
"""The words of each language, and the names of what the text uses: a function called so would not compile, or would hide them."""


def source_of(plan: Plan, designs: Mapping[str, Any], requests: Sequence[RequestLike], language: str, name: str) -> str:
    """Return requests as text in a language; see Mechanism.source."""
    one_word("language", language, tuple(WRITERS))
    if not (isinstance(name, str) and name.isascii() and name.isidentifier()):
        raise DefinitionError(f"name={name!r}: a function's name is expected, such as poses.")
    if name in TAKEN[language].split():
        raise DefinitionError(f"name={name!r} has a meaning in {language} already; give the function another name, such as poses.")
    if any(np.ndim(value) for value in designs.values()):
        raise DefinitionError(f"{plan.title}: source() states one design; its dimensions are arguments of the text, which serves all.")
    asked = all_bound(plan, requests)
    key = ("source", tuple(each.key for each in asked))
    nodes = plan.made(key, lambda twin: [node for each in asked for node in held(twin, each)])
    closed_form(plan, nodes)
    return WRITERS[language](nodes, name, {name: float(value) for name, value in designs.items()})


def held(plan: Plan, what: BoundRequest) -> list[Node]:
    """Return a request's nodes, NaN where what they are true under does not hold: the text can look nothing up."""
    nodes = list(what.nodes(plan))
    for truth in what.notes(plan).assumed:
        nodes = [node.graph.pick(0.0, truth, node, math.nan) for node in nodes]
    return nodes


def closed_form(plan: Plan, nodes: Sequence[Node]) -> None:
    """Raise DefinitionError where nodes hang on pins that are found by iteration, or on an angle that is followed."""
    read = {node.value for node in Kernel(nodes).plan.pose_inputs}
    for group in plan.groups.values():
        if not read.isdisjoint(group.inputs):
            what = f"{plan.title}: {group} is solved by iteration and has no closed form to write down"
            raise DefinitionError(f"{what}; ask for what does not hang on {', '.join(group.pins)}, or use function().")
    for angle in plan.followed:
        if angle in read:
            what = f"{plan.title}: {angle} is followed from the sketch, as its whole turns tell poses apart, and has no closed form"
            raise DefinitionError(f"{what} to write down; use a whole multiple of it, drive the angle by a Stroke, or use function().")
