"""The machine with a header at its published setting, and the table of settings for all headers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any

import numpy as np

from linkage import Column, DefinitionError
from linkage.errors import cited
from linkage.language import noted
from linkage.quantities import is_whole, real

from .criteria import HEADERS, SLOW, Way, charge_for, largest_charge
from .following import HeaderState, over_following
from .machine import HeaderBalancer


def with_header(number: int, **changes: Any) -> HeaderBalancer:
    """Return the machine with header 1, 2 or 3 at its published setting, other design variables [SI] changed as said."""
    if not is_whole(number) or number not in HEADERS:
        raise DefinitionError(f"Header {cited(number)} is unknown; the paper has {', '.join(map(str, HEADERS))}.")
    return HeaderBalancer(**{**HEADERS[number], **changes})


def setting_table(wanted: Sequence[float], changes: Mapping[str, Any] | None = None) -> list[Column]:
    """Return the charge pressure at the horizon for each header and each wanted reaction of all shoes [N]. (35)

    Beside it stands the reaction that is left, at the least, moving down over the following range. Another column says
    whether the setting keeps the largest charge without hang-up (1 yes, 0 no): slow, or fast where `changes` say n=1.4.
    NaN where the weights do not give so much reaction, or the line would be charged below every gas charge and be rigid.
    `changes` are design variables [SI] of all headers.
    """
    try:
        forces, changed = np.atleast_1d(real(wanted)), dict(changes or {})
    except ValueError:
        raise DefinitionError(f"wanted={cited(wanted)}: a list of reactions [N] is expected, such as [0.0, 100 * kgf].") from None
    if not forces.size or forces.ndim > 1 or not np.isfinite(forces).all():
        raise DefinitionError(f"wanted={cited(wanted)}: a list of finite reactions [N] is expected, such as [0.0, 100 * kgf].")
    design = HeaderBalancer(**changed)
    shoes, way = float(design["shoes"]), SLOW if design["n"] == 1.0 else Way(f"n = {design['n']:g}", exponent=float(design["n"]))
    columns = [Column("F_R", forces, "kgf", 0), Column(noted("per shoe"), forces / shoes, "kgf", 0)]
    for number in HEADERS:
        machine = with_header(number, **changed)
        motion = machine.at(h=0.0)
        limit = largest_charge(motion, way)
        charges, least = np.full(forces.shape, np.nan), np.full(forces.shape, np.nan)
        for place, force in enumerate(forces):
            with suppress(DefinitionError):  # not so much reaction; then, a rigid block or too weak a pump
                charges[place] = charge_for(motion, force)
                down = HeaderState(over_following(machine.replaced(charge=charges[place]).at(h=0.0))).down
                least[place] = float(np.min(down))
        columns += [
            Column(f"{noted('charge')} {number}", charges, "kgf/cm2", 2),
            Column(f"{noted('least')} {number}", least, "kgf", 0),
            Column(f"{noted('safe')} {number}", np.where(np.isnan(least), np.nan, charges <= limit), "", 0),
        ]
    return columns
