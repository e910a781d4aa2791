"""Where a machine is looked at, as a file says it: `[over.loading]` with strokes, `path`, `poses`, `only`, `cases`, `lost`."""

from __future__ import annotations

import re
from collections.abc import Mapping

from ..errors import DefinitionError, ensure, unknown
from ..motion import OPTIONS, Over, stroke_unit
from ..quantities import Number, PoseCondition, Quantity, is_number, quantity
from .design import Design, degrees_text
from .expression import expression
from .names import Keywords, Names, by_whole_names, entry_as, listed, shortened
from .validators import amount_of

SHAPES = ("path", "poses")
"""What says that strokes are places in an order, or poses with nothing between, where it is true."""
_COMPARED = re.compile(r"([^<>=!]+)(<=|>=)([^<>=!]+)")


def over_read(given: object, names: Names) -> Over:
    """Return where is looked, as a table says it; DefinitionError, with the key, for what it is not."""
    given = entry_as(given, Mapping, 'is not a table of strokes, such as { phi = ["15 deg", "80 deg"], t = 0.0 }')
    given, known = dict(by_whole_names(given)), names.strokes
    shapes = [word for word in SHAPES if isinstance(given.get(word), bool)]
    for key in given:
        if key not in (*known, *OPTIONS, *shapes):
            what = f"{key} is true or false; leave it out for a box." if key in SHAPES else str(unknown("Stroke", key, known))
            raise DefinitionError(f"{what} Beside strokes there are {', '.join((*SHAPES, *OPTIONS))}.")
    chosen = [word for word in shapes if given[word]]
    ensure(len(chosen) <= 1, "it is a path and poses at once; a path goes on between its places, poses have nothing between them.")
    make = {"path": Over.path, "poses": Over.poses}.get(chosen[0] if chosen else "", Over)
    options: Keywords = {key: given[key] for key in ("cases", "lost") if key in given}
    if "only" in given:
        options["only"] = [condition_of(text, names) for text in listed(given["only"])]
    for key, value in given.items():  # of a stroke one value or several: numbers [SI], texts with a unit, quantities of the design
        if key in known:
            options[key] = tuple(amount_of(each, names, "") for each in value) if isinstance(value, list) else amount_of(value, names, "")
    made: Over = make(**options)
    return made


def condition_of(text: object, names: Names) -> PoseCondition:
    """Return the condition on poses that a text says, `x(T) <= 4`; DefinitionError for any other."""
    found = _COMPARED.fullmatch(text) if isinstance(text, str) else None
    if found is None:
        raise DefinitionError(f'{shortened(text)} is no condition on poses; write a comparison in quotes, "x(T) <= 4", with <= or >=.')
    left, right = (expression(found.group(side).strip(), names) for side in (1, 3))
    if isinstance(left, Number) and isinstance(right, Number):
        raise DefinitionError(f"{shortened(text)} compares two numbers; one side is a quantity such as x(T).")
    if isinstance(left, Number):
        return PoseCondition(right, {"<=": ">=", ">=": "<="}[found.group(2)], left.number)
    return PoseCondition(left, found.group(2), right.number if isinstance(right, Number) else right)


def over_written(member: Over, design: Design) -> Keywords:
    """Return where is looked as a table; DefinitionError for a condition that a file cannot hold."""
    found: Keywords = {} if member.shape == "box" else {member.shape: True}
    for name, value in member.strokes.items():
        parts: list[float | str] = []
        for each in listed(value):
            end = float(each) if is_number(each) else design.scalar(quantity(each))
            parts.append(degrees_text(end) if is_number(each) and stroke_unit(design.plan, name) == "rad" else end)
        found[name] = parts if isinstance(value, tuple) else parts[0]
    only = []
    for condition in member.only:
        for side in (condition.left, condition.right):
            if not is_number(side) and not isinstance(side, (str, Quantity)):
                what = f"only=[{condition}]: a file holds conditions of quantities such as x(T) or a named output, and {side} is a request"
                raise DefinitionError(f"{what}; take the condition out, or keep the class in Python.")
        left, right = (design.scalar(quantity(side)) for side in (condition.left, condition.right))
        only.append(f"{left} {condition.symbol} {right}")
    options = {"only": only, "cases": list(member.cases or ()), "lost": member.lost}
    return found | {key: value for key, value in options.items() if value}
