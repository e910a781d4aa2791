"""Whether forces agree with the motion: joints must not do work where they hold, and the drives' forces must be those by virtual work.

The joints of a step of one's own are as good as what its `joints()` says. Where two bodies move against each other in a direction that
a joint holds, its force would do work, and the equilibrium would be that of another machine. That is looked at wherever joint forces
are: on arrays here, in a program as one more assumption.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import final

import numpy as np

from ..errors import DefinitionError
from ..loads import Rates
from ..motion import require_motion
from ..motion.limits import where_words
from ..motion.requests import examined, point_ratios
from ..plan import NEAR, Mask
from ..program import FloatArray, elementwise
from .equilibrium import System
from .friction import Speeds
from .joints import Contact, Structure, acting_place, force_direction
from .poses import FlatPoses

AGREES = 1e-6
"""A disagreement below this part counts for none."""
MARGIN = 10.0
"""Nor does one of less than so many times the relative error that a pose has by itself."""
ROUGHLY = 1e-4
"""The part in a program next to a singular pose, whose error it does not know: up to the poses that are refused it is below."""
STILL = 1e-9
"""m or rad a unit of a stroke: slower than this nothing moves."""


@final
@dataclass(frozen=True)
class Slip:
    """How two bodies move against each other in a direction that their joint holds, beside what its drives say, on a unit of a stroke.

    `way` and `driven` (n,) in m, of a couple in rad; `size` is how fast both bodies move there (n,).
    """

    contact: Contact
    letter: str
    stroke: str
    way: FloatArray
    driven: FloatArray
    size: FloatArray

    @property
    def miss(self) -> FloatArray:
        """What the drives do not explain (n,)."""
        return np.asarray(np.abs(self.way - self.driven))


def slips(structure: Structure, poses: FlatPoses) -> Iterator[Slip]:
    """Yield what the joints of steps from other packages let slip, by each stroke and in each direction that they hold."""
    members = structure.plan.members
    own = [each for each in structure.contacts if each.owner and type(members[each.owner]).__module__.split(".")[0] != "linkage"]
    system = System(structure, poses, (), length=1.0)
    for stroke in structure.plan.strokes if own else ():
        speeds = Speeds(structure, poses, Rates({stroke: 1.0}))
        for contact in own:
            yield from slips_in(contact, system, speeds, stroke)


def slips_in(contact: Contact, system: System, speeds: Speeds, stroke: str) -> Iterator[Slip]:
    """Yield what one joint lets slip by a stroke; where a drive along a curve of the frame follows its point, nothing."""
    poses, drives = system.poses, list(system.structure.drives(contact))
    place = acting_place(contact, poses)
    on, by = (speeds.material(body, place, contact) for body in (contact.on, contact.by))
    spins = speeds.spin(contact.on), speeds.spin(contact.by)
    for letter in contact.holds:
        ratios = [
            system.ratio(quantity, stroke) * sign
            for quantity, along, sign in drives
            if along == letter and not (contact.is_curve and letter != "c") and system.follows(quantity, stroke)
        ]
        driven = sum(ratios, poses.zeros())
        if letter == "c":
            yield Slip(contact, letter, stroke, spins[0] - spins[1], driven, np.abs(spins[0]) + np.abs(spins[1]))
        elif not (contact.is_curve and any(along == letter for _, along, _ in drives)):
            way = ((on - by) * force_direction(contact, letter, poses)).sum(axis=0)
            yield Slip(contact, letter, stroke, way, driven, np.hypot(on[0], on[1]) + np.hypot(by[0], by[1]))


def assumed_joints(structure: Structure, poses: FlatPoses) -> list[FloatArray]:
    """Return numbers of a program, each shape (1,), above zero where joints hold what they say, exactly or roughly and near."""
    found, plan = list(slips(structure, poses)), structure.plan
    if not found:
        return []
    near = NEAR - poses.flattened(poses.motion._array(np.asarray(plan.trace.nearness(plan.members), object)))
    exactly, roughly = ([part * (slip.size + STILL) - slip.miss for slip in found] for part in (AGREES, ROUGHLY))
    return [elementwise(np.maximum, (a, elementwise(np.minimum, (b, near)))) for a, b in zip(exactly, roughly, strict=True)]


def check_joints(structure: Structure, poses: FlatPoses) -> None:
    """Raise DefinitionError, by name, for a joint of a step of one's own in which forces would do work at some poses."""
    for slip in slips(structure, poses):
        rates = [np.hypot(*poses.rate(name, slip.stroke)) for name in structure.plan.moving]
        size = slip.size + 1e-3 * np.max(rates, axis=0, initial=STILL)
        bad = disagreeing(poses, slip.miss, AGREES * size, size)
        if not bad.any():
            continue
        contact, plan, worst = slip.contact, structure.plan, int(np.argmax(np.where(bad, slip.miss, -1.0)))
        unit = "rad" if slip.letter == "c" else "m"
        drives = f" where its drives say {slip.driven[worst]:.4g} {unit}" if slip.driven.any() else ""
        where = where_words(plan, poses.mask(bad), poses.motion.strokes)
        joint = f"{contact.owner}.joints(): the joint {contact.kind!r} at {contact.point}"
        raise DefinitionError(
            f"{plan.title}: {joint} holds {slip.letter!r} between {structure.name(contact.on)} and {structure.name(contact.by)}, but there "
            f"they move against each other by {slip.way[worst]:.4g} {unit} a unit of {slip.stroke}{drives}, {where}: its force would do "
            "work, and pin forces would not agree with virtual work. A force acts at the origin of line=: let that be where the bodies "
            "touch, let holds= be a direction in which they do not move against each other, and name in drives= what a stroke moves."
        )


def disagreeing(poses: FlatPoses, miss: FloatArray, limit: FloatArray | float, size: FloatArray | float) -> Mask:
    """Return where a miss (n,) is above its limit, and above what the poses themselves lose of a result of some size."""
    bad = np.asarray(~(miss <= limit))
    if bad.any():
        motion, mask = require_motion(poses.motion), poses.mask(bad)
        what = point_ratios(set(poses.plan.members))
        (found,) = examined(poses.plan, (what,), motion._grid.inputs_at(mask), motion._grid.read_at(mask), [0])
        sizes = np.broadcast_to(size, bad.shape)[bad]
        bad[bad] = ~(miss[bad] <= MARGIN * np.nan_to_num(found.error, nan=0.0) * sizes)
    return bad
