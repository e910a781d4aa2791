"""Checks of a study's machine, and of its dimensions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..errors import AssemblyError, cited, ensure, is_whole, require_one_design, unfit
from ..mechanism import Mechanism, require_mechanism
from ..plan import Plan
from .variants import is_side


def unit_of(plan: Plan, name: str) -> str:
    """Return the unit a dimension is shown in: its own, mm for lengths, deg for angles, "" where nothing says, as of a side."""
    if is_side(name):
        return ""
    found = plan.table.entries[plan.table.spellings[name][0]]
    return found.unit or {"length": "mm", "coordinate": "mm", "angle": "deg"}.get(found.kind, "")


def check_one_design(machine: Mechanism) -> None:
    """Raise DefinitionError for a batch of designs, and for anything but a mechanism."""
    require_one_design(require_mechanism(machine).dimensions, f"{type(machine).__name__}: a study starts from one design")


def check_in_count(title: str, what: str, number: object, count: int) -> None:
    """Raise DefinitionError for anything but the number of one of some designs or curves, from 0 on."""
    fits = is_whole(number) and 0 <= number < count
    ensure(fits, f"{title}: there is no {what} {cited(number)}; numbers go from 0 to {count - 1}.")


def check_vary(machine: Mechanism, what: str, over: object) -> None:
    """Raise DefinitionError where the designs of a study, or strokes, are given as `over`."""
    if over is None:
        return
    remedy = "name its strokes, such as S=[0.0, 0.1]" if what == "zone" else "let measure(machine) say at which strokes it looks"
    expected = f"a {what} varies designs, vary=, and has no over=; {remedy}"
    if isinstance(over, Mapping) and any(name in machine for name in over):
        expected = "dimensions are varied by vary=, strokes run by over=; write vary="
    raise unfit(f"{machine.plan.title}: {what}(over", over, expected)


WHOLE_POSES = {1: 101, 2: 25, 3: 13, 4: 8, 5: 6, 6: 5}
"""Poses of each stroke at which a machine is looked at that is to be assembled over all of them."""


def why_not_assembled(machine: Mechanism) -> str:
    """Return why a machine cannot be assembled over the box of its whole strokes, in one line; "" for one that can."""
    count = WHOLE_POSES.get(len(machine.strokes), 3)
    axes = [np.linspace(each.start, each.end, count) for each in machine.strokes.values()]
    try:
        at: dict[str, Any] = dict(zip(machine.strokes, np.meshgrid(*axes, indexing="ij"), strict=True))
        machine.at(**at)
    except AssemblyError as error:
        return " ".join(str(error).split())
    return ""
