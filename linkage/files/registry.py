"""Which kinds of member a file may hold. A package adds its own by entry points of the group `hydrolinkage.files`."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from importlib.metadata import entry_points
from typing import Any

from ..errors import DefinitionError, unknown
from ..quantities import Member
from .entry import Entry
from .loads import (
    ActuatorEntry,
    CaseEntry,
    DamperEntry,
    ForceEntry,
    GuideFrictionEntry,
    LinkMassEntry,
    MomentEntry,
    PinFrictionEntry,
    SpringEntry,
    SupportEntry,
    WeightEntry,
)
from .names import shortened
from .parts import GroupEntry, GuideEntry, LinkEntry, SlideEntry
from .points import (
    CrankEntry,
    DyadEntry,
    GroundEntry,
    GuideCrossEntry,
    OffsetEntry,
    OnGuideEntry,
    OnLinkEntry,
    PinEntry,
    PinSlotDyadEntry,
    SliderDyadEntry,
    YokeDyadEntry,
)
from .scalars import DimensionEntry, DrawnEntry, OutputEntry, StrokeEntry, VectorEntry

GROUP = "hydrolinkage.files"
SHIPPED = {"hydraulics": "hydrolinkage"}
"""Sections that packages beside this one bring, each with what to install for it."""

OWN: tuple[type[Entry], ...] = (
    StrokeEntry, DimensionEntry, DrawnEntry, GroundEntry, GuideEntry,
    DyadEntry, OnLinkEntry, CrankEntry, OffsetEntry, SliderDyadEntry, PinSlotDyadEntry, GuideCrossEntry, YokeDyadEntry, OnGuideEntry,
    VectorEntry, LinkEntry, PinEntry, SlideEntry, GroupEntry, OutputEntry,
    WeightEntry, ForceEntry, MomentEntry, LinkMassEntry, SpringEntry, DamperEntry, ActuatorEntry, SupportEntry,
    PinFrictionEntry, GuideFrictionEntry, CaseEntry,
)  # fmt: skip


@dataclass(frozen=True)
class Registry:
    """The kinds of entry, by section and word for reading, by class for writing."""

    entries: tuple[type[Entry], ...]

    @cached_property
    def sections(self) -> Mapping[str, Mapping[str, type[Entry]]]:
        """The sections in their usual order, each with its entries by word."""
        found: dict[str, dict[str, type[Entry]]] = {}
        for entry in self.entries:
            words = found.setdefault(entry.section, {})
            if entry.word in words or (words and "" in {entry.word, *words}):
                raise DefinitionError(f"[{entry.section}] {entry.word}: {entry.__name__} takes a word that is taken.")
            words[entry.word] = entry
        return found

    def kind(self, section: str) -> str:
        """Return what the members of a section are: `point`, `quantity`, ..."""
        return next(iter(self.sections[section].values())).describes.kind

    def reading(self, section: str, given: Any) -> type[Entry]:
        """Return the kind of an entry of a section; DefinitionError where its word is missing, unknown or not the only one."""
        words = self.sections[section]
        if "" in words:
            return words[""]
        found = [word for word in words if isinstance(given, Mapping) and word in given]
        if len(found) == 1:
            return words[found[0]]
        if len(found) > 1:
            raise DefinitionError(f"it is {' and '.join(found)} at once; say one of them.")
        example = next(iter(words.values())).__doc__
        key = next((key for key in given if isinstance(key, str)), "") if isinstance(given, Mapping) else ""
        what = unknown("Kind", shortened(key, quote=False), words) if key else f"{shortened(given)} is no entry of [{section}]."
        raise DefinitionError(f"{what} Write it like {example}.{self.elsewhere(given)}{self.absent()}")

    def elsewhere(self, given: Any) -> str:
        """Return in which section an entry would be known, in words; "" where in none."""
        keys = set(given) if isinstance(given, Mapping) else set()
        found = [(word, section) for section, words in self.sections.items() for word in words if word and word in keys]
        return "".join(f" {word} stands in [{section}]." for word, section in found[:1])

    def absent(self) -> str:
        """Return which packages of this distribution are not registered, in words; "" where all are."""
        return "".join(
            f" The kinds of [{section}] are not registered here: install {package}, which brings them (pip install {package})."
            for section, package in SHIPPED.items()
            if section not in self.sections
        )

    def writing(self, member: Member) -> type[Entry]:
        """Return the kind of entry that a member is written as; DefinitionError where a file cannot hold it."""
        by_class = {entry.describes: entry for entry in self.entries}
        found = next((by_class[base] for base in type(member).__mro__ if base in by_class), None)
        if found is None or not (found.family or found.describes is type(member)):
            raise DefinitionError(f"{member.name} = {member}: a file cannot hold a {type(member).__name__}.{self.absent()}")
        return found


@lru_cache(maxsize=1)
def registry() -> Registry:
    """Return the kinds of this package and of those that are installed beside it."""
    return Registry((*OWN, *extensions()))


def extensions() -> Iterable[type[Entry]]:
    """Yield the entries that other packages bring; DefinitionError, with its name, for one that cannot be loaded."""
    for point in sorted(entry_points(group=GROUP), key=lambda point: point.name):
        try:
            yield point.load()
        except (ImportError, AttributeError) as error:
            raise DefinitionError(f"the entry {point.name} ({point.value}) of a file cannot be loaded: {error}.") from error
