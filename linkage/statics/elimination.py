"""The equations of equilibrium on the nodes of a program, eliminated symbolically."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..errors import DefinitionError, unwarned
from ..motion import Motion
from ..plan import Plan
from ..program import FloatArray, Node, eliminated
from .balance import Equations
from .loaded import Loaded
from .poses import Poses
from .structure import Structure
from .system import System
from .traced import TracedMotion

SAMPLE = 5
"""Poses over the strokes at which it is tried whether the joints can be solved for."""


def eliminated_system(system: System, motion: TracedMotion, friction: Sequence[Node] = ()) -> FloatArray:
    """Return the joint forces of a traced system under its loads and frictions, eliminated symbolically, shape (1, columns)."""
    equations = Equations(system, bound=tuple(system.known()))
    A, right = equations.A[0], equations.right[0]
    sides = [motion.node(row[0]) for row in right]
    for place, each in enumerate(friction):
        sides = [side + motion.node(row[1 + place]) * each for side, row in zip(sides, right, strict=True)]
    return motion.array([eliminated([[motion.node(each) for each in row] for row in A], sides)])


def held(plan: Plan, loaded: Loaded) -> float:
    """Return a length of the mechanism [m]; DefinitionError where a body hangs loose or a link is redundant."""
    along = np.linspace(0.0, 1.0, SAMPLE)
    ranges = {name: each.start + along * (each.end - each.start) for name, each in plan.strokes.items()}
    strokes = {name: np.append(plan.sketch_strokes[name], values) for name, values in ranges.items()}
    with unwarned():
        poses = Poses(Motion(plan, plan.defaults, strokes, "nan"), "The joint forces")
    still = tuple(replace(each, thrust=np.zeros(poses.motion.shape)) for each in loaded.pushing)
    system = System(Structure(plan, loaded.elements, still), poses, ())
    if not poses.count:
        raise DefinitionError(f"{plan.title}: the declared design cannot be assembled at any of {SAMPLE} poses; declare one that can.")
    equations = Equations(system, bound=tuple(system.known()))
    equations.check(*equations.A.shape[1:])
    return system.scale
