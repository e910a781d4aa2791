"""Sizes as remedies: each is put to the judge, for the machine that has it, without a second calculation."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TypeAlias, TypeVar

from linkage.errors import LinkageError, ensure, unwarned
from linkage.language import said
from linkage.loads import ForceElement
from linkage.motion import Answer, Judge, Question
from linkage.motion.answer import OF_VALUE
from linkage.units import decimals, factor, show, shown_in

Sizes: TypeAlias = Mapping[str, float]
"""Sizes of a cylinder by their names [m], such as its bore."""
Element = TypeVar("Element", bound=ForceElement)


def resized(judge: Judge, element: Element, sizes: Sizes) -> tuple[Judge, Element]:
    """Return the judge of the same machine with other sizes of one of its elements, and that element.

    DefinitionError for a size that an expression gives, which is no design variable.
    """
    plan = judge.plan
    if not element.name:
        return judge, element.having({f".{name}": value for name, value in sizes.items()})
    designs = dict(judge.designs)
    for name, value in sizes.items():
        called = element.variable(name)
        ensure(called in plan.table.spellings, f"{plan.title}: {element.name}.{name} follows an expression and cannot be set alone.")
        owner, sign = plan.table.spellings[called]
        designs[owner] = sign * value
    return judge._once(("resized", element.name, *sizes.items()), lambda: judge.of(designs)), element


def can_be_set(judge: Judge, element: ForceElement, sizes: Sizes) -> bool:
    """Return whether sizes of an element are design variables, or follow one each."""
    return not element.name or all(element.variable(name) in judge.plan.table.spellings for name in sizes)


def smallest(
    judge: Judge, element: Element, each: Sequence[Sizes], guess: int, questions: Callable[[Element], Sequence[Question]], worst: Answer
) -> tuple[Sizes, list[Answer]] | None:
    """Return the first of some ascending sizes with which all conditions are kept, with their answers; None where none does.

    It is looked for from the place `guess` of them, upwards or downwards. Another one is first tried where the present size is `worst`:
    what fails there is looked at nowhere else.
    """
    fails, holds, found, start = -1, len(each), None, guess
    while holds - fails > 1:
        start = min(max(start, fails + 1), holds - 1)
        try:
            with unwarned():
                other, changed = resized(judge, element, each[start])
                asked = questions(changed)
                answers = other.alone_at(worst).answers(asked) if start != guess else []
                if not any(answer.ok is False and answer.status == OF_VALUE for answer in answers):
                    answers = other.answers(asked)
        except LinkageError:
            answers = []
        if answers and all(answer.ok for answer in answers):
            holds, found, start = start, (each[start], answers), start - 1
        else:
            fails, start = start, start + 1
    return found


def size_words(sizes: Sizes) -> str:
    """Return sizes in words: a bore, a rod, or a cylinder of both."""
    shown = {name: show(value, "mm", 4) for name, value in sizes.items()}
    if len(shown) > 1:
        return said("a cylinder of bore {bore} and rod {rod}", **shown)
    return said("a rod of {rod}", **shown) if "rod" in shown else said("a bore of {bore}", **shown)


EXACT = 1e-7
"""Of the last digit that is shown: what is above it by less is that to rounding."""


def show_enough(value: float, unit: str, digits: int | str = 4) -> str:
    """Return a need that a remedy tells as text, rounded up, so that the number read is enough; `digits` as in `show`."""
    if 0.0 < value < math.inf:
        own = factor(shown_in(unit))
        last = -decimals(int(digits[1:-1]), unit) if isinstance(digits, str) else math.floor(math.log10(value / own)) + 1 - digits
        value = math.ceil(value / (own * 10.0**last) - EXACT) * 10.0**last * own
    return show(value, unit, digits)
