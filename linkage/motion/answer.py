"""Answers of the judge: a value and its place, the load case and movement, whether a condition is kept, and places without a value."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field, replace
from math import nan
from typing import Any, Self, TypeAlias

import numpy as np

from ..frozen import immutable
from ..language import said, translated
from ..loads import FRICTIONLESS, case_in_words
from ..units import display_unit, show
from .limits import places_text, timed_texts

OF_VALUE, LOST, UNBOUNDED, NOTHING_LEFT = "value", "lost", "unbounded", "nothing left"
"""What an answer rests on: a value; places that are lost; a value that grows without bounds; nothing, as no place is asked or limited."""


LOST_SHARE = "lost share"
"""What the value of an answer about reach is: a part of the places looked at."""


@immutable
class LostPlaces:
    """Places without a value: their share, the deepest of them [m or rad], and the missing length there.

    `time` is the instant of the deepest [s] over a path in time, else NaN.

    The places stand evenly: in a box along each stroke, along a path on each leg. There a leg weighs by the most that one stroke moves on
    it, as a part of that stroke's range over the path. `surely` is False where places may be lost between those that were
    looked at: those of groups, and of laws that have no value.
    """

    share: float = 0.0
    strokes: Mapping[str, float] = field(default_factory=dict)
    sentence: str = ""
    surely: bool = True
    time: float = nan

    def __bool__(self) -> bool:
        return self.share > 0.0 or bool(self.sentence)


NONE_LOST = LostPlaces()


PerDesign: TypeAlias = Any
"""What one design has, of a batch an array over its designs."""
PER_DESIGN = ("value", "ok", "status", "case", "direction", "drive", "side", "over", "time", "leg", "limit", "used")
"""What each design of a batch has an answer of its own."""


@immutable
class Answer:
    """The judge's answer to one question: the worst over all places that were looked at. For a batch, arrays over its designs.

    Attributes
    ----------
    question : object
        What was asked.
    value : float or array
        The worst value [SI]: infinite where it is unbounded, NaN where there is none.
    ok : bool or array, optional
        Whether the condition is met. It is None where only a measure was asked for, and where nothing is left to judge.
    status : str or array
        "value", "lost" where the machine cannot be assembled, "unbounded", or "nothing left" to judge.
    strokes : mapping of str to float or array
        Where the worst is [m or rad].
    case, direction, drive, side, over : str or array
        In which situation it is; "" where there is one only.
    lost : LostPlaces
        Where the machine cannot be assembled.
    unlimited, outside : float
        The shares of the places looked at without a limit, and outside of the conditions on poses.
    width : mapping of str to float
        How broad the worst place has to be at the least to be found, in parts of each stroke.
    count : int
        The number of poses looked at.
    units : mapping of str to str
        The units in which strokes are shown.
    measures : str
        What is measured, which says in which unit the value is shown.
    time : float or array
        The instant [s] over a path in time, else NaN.
    named : frozenset of str
        What sentences have to name, since there are several: "case", "direction", "drive", "side", "over".
    leg : int or array
        Which leg of a path it is on, from 0; -1 of a box and of poses.
    turned : str
        Of an integral over an angle what stands behind its unit: "rad", or "rad2" of an angle's; "" of a moment's, which is a work.
    limit : float or array
        The limit of the condition that counts [SI], NaN where there is none.
    used : float or array
        How far the limit of a condition is used: 1.0 where it is met exactly, infinite where nothing bounds it, 0.0 where there is none.
    titles : mapping of str to str
        How load cases are called in sentences, of those that have a title beside their name.
    """

    question: object
    value: PerDesign
    ok: PerDesign
    status: PerDesign
    strokes: Mapping[str, PerDesign]
    case: PerDesign = ""
    direction: PerDesign = ""
    drive: PerDesign = ""
    side: PerDesign = ""
    over: PerDesign = ""
    lost: LostPlaces = NONE_LOST
    unlimited: float = 0.0
    outside: float = 0.0
    width: Mapping[str, float] = field(default_factory=dict)
    count: int = 0
    units: Mapping[str, str] = field(default_factory=dict)
    measures: str = ""
    time: PerDesign = nan
    """When it is [s], of a path in time; NaN of any other. Of two phases that meet there it is in the one that it lies in."""
    named: frozenset[str] = frozenset()
    """What has to be named, as there are several: "case", "direction", "drive", "side", "over"."""
    leg: PerDesign = -1
    turned: str = ""
    limit: PerDesign = nan
    used: PerDesign = 0.0
    titles: Mapping[str, str] = field(default_factory=dict)

    def __repr__(self) -> str:
        kept = "" if np.ndim(self.value) or self.ok is None else ": kept" if self.ok else ": not kept"
        return f"<Answer to {self.question}{kept}; {self}>"

    def _to(self, question: object) -> Self:
        """Return it as the answer to a question that is the same in other words."""
        found = object.__new__(type(self))
        vars(found).update(vars(self), question=question)
        return found

    @property
    def unbounded(self) -> PerDesign:
        """Whether it grows without bounds."""
        return np.asarray(self.status == UNBOUNDED)[()] if np.ndim(self.value) else self.status == UNBOUNDED

    @property
    def where(self) -> str:
        """Where it stands, in words: `at S = 123.4 mm`, `at S1 = 100.0 mm, phi = 25.00 deg`; of several, the ranges.

        Of a path in time `at 0.1875 s (lift = 114.1 mm)`.
        """
        if self.strokes and not np.ndim(self.time) and not np.isnan(self.time):
            time, place = timed_texts(self.strokes, self.units, float(self.time))
            return said("at {time} ({place})", time=time, place=place)
        return said("at {place}", place=places_text(self.strokes, self.units)) if self.strokes else ""

    @property
    def situation(self) -> str:
        """In which situation it stands, in words: `extending, in the case full, over loading`; "" where there is one only."""
        if np.ndim(self.value):
            return ""
        words = []
        if "direction" in self.named and self.direction:
            text = said("at rest") if self.direction == FRICTIONLESS else translated(self.direction)
            words.append(said("{direction} {drive}", direction=text, drive=self.drive) if "drive" in self.named and self.drive else text)
        if "side" in self.named and self.side:
            words.append(said("on the piston side") if self.side == "piston" else said("on the rod side"))
        if "case" in self.named and self.case:
            words.append(case_in_words(self.case, self.titles))
        if "over" in self.named and self.over:
            words.append(said("over {over}", over=self.over))
        return ", ".join(words)

    def of_design(self, number: int) -> Self:
        """Return the answer of one design of a batch, by its number among them.

        Parameters
        ----------
        number : int
            The design's number in the batch, from 0.

        Returns
        -------
        Answer
            Its answer.
        """

        def own(values: PerDesign) -> PerDesign:
            return np.ravel(values).tolist()[number] if np.ndim(values) else values

        strokes = {name: own(value) for name, value in self.strokes.items()}
        return replace(self, strokes=strokes, **{name: own(getattr(self, name)) for name in PER_DESIGN})

    @property
    def place(self) -> str:
        """Situation and place in words: `extending, in the case full, at phi = 90.00 deg, psi = 0.00 deg`."""
        return ", ".join(each for each in (self.situation, self.where) if each)

    @property
    def amount(self) -> str:
        """The value in words, with its unit where that is known."""
        if self.status == UNBOUNDED:
            return said("without bounds")
        return self._shown(float(self.value))

    def _shown(self, value: float) -> str:
        """Return a value with its unit, in words."""
        return f"{show(value, display_unit(self.measures, 'mm'), 6)} {self.turned}".strip()

    def __str__(self) -> str:
        if np.ndim(self.value):
            return self.batch_words
        if self.status == NOTHING_LEFT:
            return said("nothing is left to judge: every place is unlimited, left out or lost")
        if self.measures == LOST_SHARE:  # every place, or how much of them is lost, and where and why
            if not self.lost:
                return said("every place is assembled")
            share, _, why = self.lost_words.partition(": ")
            return ": ".join(each for each in (f"{share} {self.place}".strip(), why) if each)
        if np.isnan(self.value):
            return f"{said('no value at any pose')}{f'; {self.lost.sentence}' if self.lost.sentence else ''}"
        found = f"{self.amount} {self.place}".strip()
        return f"{found}; {self.lost_words}" if self.lost else found

    @property
    def batch_words(self) -> str:
        """The answer for several designs, in words: the least and the greatest value, or how many are not assembled."""
        values = np.asarray(self.value, float)
        if self.measures == LOST_SHARE:
            lost = int((values > 0.0).sum())
            if not lost:
                return said("every place is assembled")
            return said("{n} of {total} designs cannot be assembled over the whole motion", n=lost, total=values.size)
        known = values[~np.isnan(values)]
        if not known.size:
            return said("no value at any pose")
        low, high = (self._shown(float(each)) if np.isfinite(each) else said("without bounds") for each in (known.min(), known.max()))
        if low == high:
            return f"{low} {self.where}".strip()
        return f"{said('{low} to {high}', low=low, high=high)} {self.where}".strip()

    @property
    def lost_words(self) -> str:
        """The lost places, in words."""
        share = said("{share} of the places is lost", share=share_text(self.lost.share))
        return f"{share}: {self.lost.sentence}" if self.lost.sentence else share


def share_text(share: float) -> str:
    """Return a share of the places as a percentage."""
    return f"{100.0 * share:.3g} %" if share > 0.0 else said("a narrow part")
