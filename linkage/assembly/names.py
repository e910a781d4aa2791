"""What a parts list refers to, looked at before its pins are placed: names, kinds, labels."""

from __future__ import annotations

from collections.abc import Mapping

from ..errors import DefinitionError, unknown
from ..quantities import Member, Reference, name_of, needs
from ..steps import Link, Slide


def check_names(members: Mapping[str, Member], title: str) -> None:
    """Raise DefinitionError for a name that nobody declares, one of another kind, and a label that does not fit its link's points."""
    for name, member in members.items():
        for each in needed(name, member, title):
            if each not in members:
                raise unknown("Name", each, members, where=f"{title}.{name}")
    for name, member in members.items():
        for reference, kind in parts_of(member):
            if members[name_of(reference)].kind != kind:
                raise DefinitionError(f"{title}: {name} = {member}: {name_of(reference)} is not a {kind}.")
        if isinstance(member, Link):
            member.fitted()


def needed(name: str, member: Member, title: str) -> tuple[str, ...]:
    """Return the names that a member needs; DefinitionError, with the place, where a part of it cannot be one."""
    try:
        return tuple(needs(member))
    except DefinitionError as error:
        raise DefinitionError(f"{title}.{name}: {error}") from None


def parts_of(member: Member) -> list[tuple[Reference, str]]:
    """Return what a link or a slide joins, each with the kind that it must be."""
    if isinstance(member, Link):
        return [(point, "point") for point in member.points]
    return [(member.point, "point"), (member.guide, "guide")] if isinstance(member, Slide) else []
