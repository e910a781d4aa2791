"""Whether a machine is held: with its drives locked and its cylinders holding no body can move, and its closed lines let it move at all.

The rank of the equilibrium of bodies at some poses tells the first, once a class and state of its lines. The numbers of the designs tell
the second. Where it is not held every force is refused in these words, whatever method works it out; places are not.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import final

import numpy as np

from ..errors import DefinitionError, unwarned
from ..loads import PLAIN_CASE, Acting, ForceElement, Push, TwoPoint
from ..motion import Motion
from ..plan import Plan
from ..program import FloatArray
from .applied import Anywhere, member_title, motion_in_case
from .equilibrium import System
from .holding import check_kept, closed_ties, holders_of, sampled
from .joints import NotHeldError, Structure
from .poses import FlatPoses, quarter_turned
from .solution import Equilibrium


@final
@dataclass(frozen=True)
class Looseness:
    """What can still move while the drives are locked: the names of the bodies, and the sentence that says so; empty where it is held."""

    bodies: tuple[str, ...] = ()
    sentence: str = ""


def looseness(plan: Plan) -> Looseness:
    """Return what is loose in a machine, worked out once a class and state of its lines; nothing where joint forces are not provided."""

    def made(_: Plan) -> Looseness:
        with unwarned():
            try:
                equations = locked_equations(sampled(plan))
            except DefinitionError as error:  # no cylinder where none is wanted, or points that keep no place
                return Looseness(sentence=str(error))
            return Looseness() if equations is None or not equations.lacks else Looseness(tuple(equations.loose()), equations.loose_words())

    return plan.made(("looseness",), made)


def locked_equations(motion: Motion) -> Equilibrium | None:
    """Return the equilibrium of bodies whose drives are locked; None where no pose is reached, or joint forces are not provided."""
    poses, elements = FlatPoses(motion, "The joint forces"), tuple(motion.plan.of_kind(ForceElement).values())
    if not poses.count or not motion.plan.moving:
        return None
    holders_of(motion.plan)
    fed = [ram for each in elements for ram in each.feeds(motion.plan.members) if isinstance(ram, TwoPoint)]
    fed += [each for each in elements if isinstance(each, TwoPoint) and not each.holds]
    laws = [Push(each, np.zeros(motion.shape), member_title(each)) for each in fed]
    try:
        return Equilibrium(System(Structure(motion.plan, elements, laws), poses, ()))
    except NotHeldError:
        raise
    except DefinitionError:
        return None


def loose_movements(motion: Motion) -> list[dict[str, FloatArray]]:
    """Return how the points of a machine can move at one pose while its drives are locked: for each way directions (2,) by point."""
    with unwarned():
        equations = locked_equations(motion) if looseness(motion.plan).bodies else None
    return [] if equations is None or not equations.lacks else [movement(equations, way) for way in equations.ways.T]


def movement(equations: Equilibrium, way: FloatArray) -> dict[str, FloatArray]:
    """Return how points move in one way, (2,) each, the fastest by 1; those that stay are left out.

    Links come before cylinders among the bodies: the length of one that shares its pressure may change.
    """
    system, found = equations.system, dict[str, FloatArray]()
    for index, body in enumerate(system.structure.bodies):
        x, y, turn = way[system.starts[index] : system.starts[index] + 3]
        for point in body.points:
            arm = (system.poses.at(point) - system.poses.at(body.points[0]))[:, 0]
            found.setdefault(point, np.array([x, y]) + turn / system.unit_length * quarter_turned(arm))
    size = max((float(np.hypot(*each)) for each in found.values()), default=0.0)
    return {point: each / size for point, each in found.items() if np.hypot(*each) > 1e-6 * size}


def held_fault(motion: Motion, case: str = PLAIN_CASE) -> str:
    """Return why there are no forces in a load case, in words; "" where the machine is held."""
    try:
        held_in_case(motion, Acting(case=case))
    except DefinitionError as error:
        return " ".join(str(error).split()).removeprefix(f"{motion.plan.title}: ")
    return ""


def held_in_case(motion: Anywhere, acting: Acting | None) -> Anywhere:
    """Return a motion as it is in a load case, for forces; DefinitionError where bodies are loose there or closed lines lock it."""
    found = motion_in_case(motion, acting)
    refuse_loose(found.plan)
    if any(not tie.gives for tie in closed_ties(found.plan)):
        found._once(("kept",), lambda: check_kept(sampled(found.plan, found.designs) if isinstance(found, Motion) else found))
    return found


def refuse_loose(plan: Plan) -> None:
    """Raise DefinitionError where bodies of a class are loose while its drives are locked."""
    sentence = looseness(plan).sentence
    if sentence:
        raise NotHeldError(sentence)
