"""What a quantity or a vector says, apart from how it is written: for the question whether a text reads back as the same."""

from __future__ import annotations

from typing import Any

from ..quantities import Member, Ref


def own_form(member: Any) -> Any:
    """Return what a member says, as nested tuples that compare; its own name does not count."""
    if isinstance(member, Ref):
        return member.target
    if not isinstance(member, Member):
        return member
    return type(member), *(form(value) for name, value in vars(member).items() if name not in ("_name", "_class"))


def form(part: Any) -> Any:
    """Return what a part of a member says: its name where it has one."""
    if isinstance(part, tuple):
        return tuple(map(form, part))
    return part.name if isinstance(part, Member) and part.name else own_form(part)
