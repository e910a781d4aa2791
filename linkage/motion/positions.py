"""What `strokes_for` returns: the strokes of all poses that give some targets, or of the nearest one, and a sentence."""

from __future__ import annotations

from collections.abc import ItemsView, Iterable, Mapping, ValuesView
from dataclasses import dataclass
from typing import Any, final

import numpy as np

from ..errors import DefinitionError, SingularWarning, cited, warn
from ..frozen import refuses_changes
from ..language import said
from ..plan import Plan
from ..program import FloatArray
from .conditions import WARN
from .places import BranchSearch, Found, Places, check_independent, unmet_words

TOLD = 4
"""Branches that are told in a sentence."""


@final
class StrokeRows(np.ndarray[Any, np.dtype[np.float64]]):
    """Strokes [m or rad], one row a branch, one column a stroke: `rows[0]`, `rows["boom"]`, `rows[0]["boom"]`, `machine.at(**rows[0])`.

    The columns stand in the order of the machine's strokes; `keys()` are their names.
    """

    names: tuple[str, ...]

    def __new__(cls, rows: object, names: Iterable[str]) -> StrokeRows:
        found = np.array(rows, float).view(cls)
        found.names = tuple(names)
        found.flags.writeable = False
        return found

    def __array_finalize__(self, other: object) -> None:
        self.names = getattr(other, "names", ())

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, str):
            if key not in self.names:
                raise DefinitionError(f"The stroke {cited(key)} is unknown. Known: {', '.join(self.names)}.")
            place = self.names.index(key)
            return np.asarray(self)[:, place] if self.ndim > 1 else np.asarray(self)[place]
        found = np.asarray(self)[key]
        if self.ndim < 2 or not isinstance(key, (int, np.integer, slice)):
            return found
        rows = found.view(type(self))
        rows.names = self.names
        return rows

    def keys(self) -> tuple[str, ...]:
        """Return the names of the strokes."""
        return self.names

    def items(self) -> ItemsView[str, FloatArray]:
        """Return the strokes by name, arrays (branches,), of one row numbers."""
        return {name: self[name] for name in self.names}.items()

    def values(self) -> ValuesView[FloatArray]:
        """Return the same without the names."""
        return dict(self.items()).values()

    def __contains__(self, value: object) -> bool:
        return value in self.names if isinstance(value, str) else value in np.asarray(self)

    def __reduce__(self) -> tuple[Any, ...]:
        return StrokeRows, (np.array(self), self.names)


@final
@refuses_changes
@dataclass(frozen=True, eq=False)
class Positions:
    """The strokes that give some targets: all branches within the ends of the strokes, ascending by the first stroke.

    `strokes` [m or rad] has one row for each branch, with the strokes that are held. `condition` is the condition number of the targets by
    the strokes in their natural sizes, infinite at a dead point. `misses` is by how much each target is exceeded [SI]. `met` is whether
    there is a branch. Without one, `nearest` is the row of the pose within the ends at which least is missing, None if nothing can be
    assembled. `misses` then has its one row, and `sentence` says which stroke would be past which end, by how much.
    """

    strokes: StrokeRows
    condition: FloatArray
    met: bool
    misses: FloatArray
    nearest: StrokeRows | None
    sentence: str

    def __len__(self) -> int:
        return len(self.strokes)

    def __str__(self) -> str:
        return self.sentence


def positions_for(plan: Plan, designs: Mapping[str, object], targets: object, hold: object) -> Positions:
    """Return the strokes that give some targets; see `strokes_for`."""
    places = Places.of(plan, designs, targets, hold, where="strokes_for")
    for each in places.targets:
        if each.is_path:
            raise DefinitionError(f"{plan.title}: strokes_for: {each!r}: one number is expected; a path is followed, machine.follow(...).")
    wanted = np.array([float(each.value) for each in places.targets])
    search = BranchSearch(places, wanted)
    found = search.branches()
    condition, rows = places.condition(found.unit), rows_of_branches(places, found)
    if len(found.unit):
        check_independent(places, condition)
        return Positions(rows, condition, True, found.off, None, met_words(places, found, condition, wanted))
    near = search.nearest()
    words = unmet_words(places, wanted, near)
    nearest_row = rows_of_branches(places, near)[0] if len(near.unit) else None
    return Positions(rows, condition, False, near.off, nearest_row, words[0].upper() + words[1:])


def rows_of_branches(places: Places, found: Found) -> StrokeRows:
    """Return all strokes of some branches, those that are held included."""
    return StrokeRows(np.stack([*places.rows(found.unit).values()], axis=1), places.plan.strokes)


def met_words(places: Places, found: Found, condition: FloatArray, wanted: FloatArray) -> str:
    """Return the strokes that give what is wanted, in words; warn of those next to a dead point."""
    strokes = [places.stroke_words(each) for each in places.low + found.unit * places.span]
    parts = {"wanted": places.shown(wanted), "strokes": said(" or with ").join(strokes[:TOLD])}
    text = said("{wanted}: with {strokes}.", **parts)
    if len(strokes) > TOLD:
        text = said("{wanted}: on {count} branches, with {strokes} and so on.", count=len(strokes), **parts)
    worst = int(np.argmax(condition))
    if condition[worst] > WARN:
        size = "" if np.isfinite(condition[worst]) else said("infinite")
        near = said(
            "At {strokes} it is at the border of what the strokes reach, next to a dead point of the drive (condition {condition}): "
            "the strokes are known only roughly there.",
            strokes=strokes[worst], condition=size or f"{condition[worst]:.1e}",
        )  # fmt: skip
        text += f" {near}"
        warn(SingularWarning(f"{places.plan.title}: strokes_for: {near}", estimate=float(np.finfo(float).eps * condition[worst])))
    return text
