"""A drive's moments against the required ones: columns, the worst movements, verdicts.

Source: Syunyov, Seliverstov, Gerasimov, Sokolov, "Lesosechnye mashiny v fokuse bioenergetiki", (2.29), (2.33), (2.34), (2.44), (2.62).
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from linkage import Column, DefinitionError, Featured, Motion, Verdict, least, most, ratio, ref
from linkage.errors import ensure
from linkage.frozen import record
from linkage.language import noted, said, translated
from linkage.motion import Answer, Request
from linkage.quantities import Quantity
from linkage.units import show

from ..paper import answers_over

SHORT = 1e-6
"""Of the greatest moment asked for: what is missing by less is met to rounding."""


@record
class Movement:
    """One movement of a drive: its name, the moment it gives and the one asked of it [N m], neither of them negative.

    What is given is F p n times d(length)/d(angle), by virtual work: the boom's lever h and the arm's h I. (2.29); (2.44), (2.52)
    """

    name: str
    given: Request
    asked: Quantity

    @property
    def surplus(self) -> Request:
        """The moment given less the one asked for [N m]."""
        found: Request = self.given - self.asked
        return found


def angle_of(motion: Motion) -> str:
    """Return the stroke that a drive's joint turns by; DefinitionError where it is driven by its cylinder."""
    for name in ("phi", "psi"):
        if name in motion.strokes and "length" in motion.plan.members:
            return name
    raise DefinitionError(f"{motion.plan.title} is no drive that its angle drives; give a motion of a BoomDrive or an ArmDrive.")


LIFTING = Movement(noted("lifting"), -ref("lifts") * ratio("length", wrt="phi"), ref("M_l"))
FOLDING = Movement(noted("folding"), -ref("folds") * ratio("length", wrt="psi"), -ref("M_l1"))
OPENING = Movement(noted("opening"), ref("opens") * ratio("length", wrt="psi"), ref("M_l2"))


MOVEMENTS: Mapping[str, tuple[Movement, ...]] = MappingProxyType({"phi": (LIFTING,), "psi": (FOLDING, OPENING)})
"""The movements that a drive is for, by the stroke that its joint turns by."""


def drive_columns(motion: Motion) -> list[Column]:
    """Return the angle, the cylinder's length and lever, and for every movement the required and available moments, and the surplus."""
    angle = angle_of(motion)
    found = [Column(angle, motion.strokes[angle], "deg", 2, angle), Column(noted("length"), motion["length"], "mm", 1, "length")]
    found.append(Column(noted("lever"), np.abs(motion.ratio("length")), "mm", 1, np.abs(ratio("length"))))
    for each in MOVEMENTS[angle]:
        moments: dict[str, Quantity | Request] = {noted("asked"): each.asked, noted("given"): each.given, noted("over"): each.surplus}
        found += [Column(f"{each.name}: {what}", np.asarray(motion.value(asked)), "kNm", 2, asked) for what, asked in moments.items()]
    return found


def featured_drive(joint: str) -> Featured:
    """Return a drive's features: its surplus of moment in each movement of a joint, which may not fall below zero."""
    over = [f"{each.name}: over" for each in MOVEMENTS[joint]]
    return Featured(over[0], (), {name: (0.0, said("too weak"), "below") for name in over})


@record
class WorstMovement:
    """The places of a movement's least and greatest surplus of moment [N m], and the greatest required moment."""

    movement: Movement
    least: Answer
    most: Answer
    greatest: float

    @property
    def short(self) -> bool:
        """Whether a moment is missing."""
        return float(self.least.value) < -SHORT * self.greatest

    @property
    def verdict(self) -> Verdict:
        """Return it in words."""
        low, high = float(self.least.value), float(self.most.value)
        asked, where = show(self.greatest, "kNm", ".2f"), self.least.where
        if self.short:
            lacking = show(-low, "kNm", ".2f")
            says = said("the load takes up to {asked}: {missing} are missing {where}", asked=asked, missing=lacking, where=where)
        else:
            spare = show(max(low, 0.0), "kNm", ".2f")
            says = said("the load takes up to {asked}: at least {spare} to spare {where}", asked=asked, spare=spare, where=where)
        beside = said(", at most {most} {where}", most=show(high, "kNm", ".2f"), where=self.most.where) if high > 0.0 else ""
        remedy = said("; take a larger bore or a longer lever") if self.short else ""
        heading = said("moment {movement}", movement=translated(self.movement.name))
        return Verdict(f"moment {self.movement.name}", not self.short, f"{says}{beside}{remedy}.", heading, self.least)


def worst_movements(motion: Motion) -> list[WorstMovement]:
    """Return the worst of every movement over a motion of one design, looked for between its poses too."""
    ensure(not motion._design_shape, f"A drive is judged for one design at a time; this motion has {motion._design_shape}. Take one.")
    found = []
    for each in MOVEMENTS[angle_of(motion)]:
        low, high, asked = answers_over(motion, [least(each.surplus), most(each.surplus), most(each.asked)])
        found.append(WorstMovement(each, low, high, float(asked.value)))
    return found


def drive_verdicts(motion: Motion) -> list[Verdict]:
    """Return whether the drive carries the required moments, and its least lever; its cylinder's length has its own verdict."""
    sense = np.sign(np.ravel(motion.ratio("length"))[0])
    (found,) = answers_over(motion, [least(sense * ratio("length"))])
    beyond = "" if found.value > 0.0 else said("; the cylinder passes its dead point: move its pins")
    text = said("at least {lever}, {where}", lever=show(float(found.value), "mm", ".1f"), where=found.where)
    return [
        *(each.verdict for each in worst_movements(motion)),
        Verdict("lever", bool(found.value > 0.0), f"{text}{beyond}.", answer=found),
    ]
