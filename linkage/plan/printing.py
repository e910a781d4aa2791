"""A plan as text: lines that can be pasted into a class."""

from __future__ import annotations

from collections.abc import Mapping
from functools import singledispatch
from types import MappingProxyType
from typing import TYPE_CHECKING

from ..quantities import Member, Quantity, in_degrees
from ..steps import Drawn
from ..units import deg

if TYPE_CHECKING:
    from .members import Members


def printed(plan: Members, values: Mapping[str, float] = MappingProxyType({})) -> dict[str, str]:
    """Return every member as it would be written, by name; the design variables among `values` [SI] have those."""
    spelled = {each: sign * values[owner] for each, (owner, sign) in plan.table.spellings.items() if owner in values}
    return {name: text(member.having(spelled), plan.turning) for name, member in plan.members.items()}


def strokes_text(plan: Members, values: Mapping[str, float]) -> str:
    """Return stroke values [SI] as they are read: `S = 0.1 m, phi = 60 deg`."""
    words = {name: f"{value / deg:.4g} deg" if name in plan.turning else f"{value:.4g} m" for name, value in values.items()}
    return ", ".join(f"{name} = {text}" for name, text in words.items()) or "no stroke"


@singledispatch
def text(member: Member, turning: frozenset[str]) -> str:
    """Return a member as it would be written; `turning` names the quantities that are angles, whose numbers are in degrees."""
    return str(member)


@text.register
def _(member: Quantity, turning: frozenset[str]) -> str:
    return member.text("angle" if member.name in turning else "")


@text.register
def _(member: Drawn, turning: frozenset[str]) -> str:
    words = (f"{name}={in_degrees(value) if name in turning else repr(value)}" for name, value in member.strokes.items())
    return f"drawn({', '.join(words)})"
