"""Where a machine is looked at, as a file says it: `[over.loading]` with strokes, `path`, `poses`, `only`, `cases`, `lost`."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from ..errors import DefinitionError, unknown
from ..motion import OPTIONS, Over, stroke_unit
from ..quantities import Number, PoseCondition, Quantity, is_number, quantity
from .design import Design, degrees_text
from .expression import expression
from .names import Names, by_whole_names, entry_as, shortened
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
    if len(chosen) > 1:
        raise DefinitionError("it is a path and poses at once; a path goes on between its places, poses have nothing between them.")
    make = {"path": Over.path, "poses": Over.poses}.get(chosen[0] if chosen else "", Over)
    options: dict[str, Any] = {key: given[key] for key in ("cases", "lost") if key in given}
    if "only" in given:
        texts = given["only"] if isinstance(given["only"], list) else [given["only"]]
        options["only"] = [condition_of(text, names) for text in texts]
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


def over_written(member: Over, design: Design) -> dict[str, Any]:
    """Return where is looked as a table; DefinitionError for a condition that a file cannot hold."""
    found: dict[str, Any] = {} if member.shape == "box" else {member.shape: True}
    for name, value in member.strokes.items():
        turns = stroke_unit(design.plan, name) == "rad"
        parts = [end_written(each, turns, design) for each in (value if isinstance(value, tuple) else (value,))]
        found[name] = parts if isinstance(value, tuple) else parts[0]
    only = [condition_written(each, design) for each in member.only]
    options = {"only": only, "cases": list(member.cases or ()), "lost": member.lost}
    return found | {key: value for key, value in options.items() if value}


def end_written(given: Any, turns: bool, design: Design) -> float | str:
    """Return a value of a stroke: a number, of an angle in degrees, or the quantity that it follows."""
    if is_number(given):
        return degrees_text(float(given)) if turns else float(given)
    return design.scalar(quantity(given))


def condition_written(given: PoseCondition, design: Design) -> str:
    """Return a condition on poses as text; DefinitionError for one of forces or pressures, which has no word in a file."""
    sides = []
    for each in (given.left, given.right):
        if not is_number(each) and not isinstance(each, (str, Quantity)):
            what = f"only=[{given}]: a file holds conditions of quantities such as x(T) or a named output, and {each} is a request"
            raise DefinitionError(f"{what}; take the condition out, or keep the class in Python.")
        sides.append(design.scalar(quantity(each)))
    return f"{sides[0]} {given.symbol} {sides[1]}"
