"""A system solved, and what is read off it: joint forces, what acts on each body, the residual."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..motion.reach import Mask
from ..program import FloatArray
from .balance import Equations
from .contacts import Contact
from .loaded import Loaded
from .poses import Poses
from .result import JointForce
from .rub import Rub, rubs
from .rubbing import settled
from .structure import Structure
from .system import Form, System


@dataclass(frozen=True)
class Solved:
    """Joint forces u (n, columns) and frictions q (n, frictions) [N]; `locked` where friction leaves no bounded ones (n,)."""

    system: System
    u: FloatArray
    q: FloatArray
    locked: Mask
    rubbing: list[Rub]

    def value(self, form: Form) -> FloatArray:
        """Return a linear form of the forces, shape (n,)."""
        return form.at(self.u[:, : self.system.width], self.q)

    def transmitted(self, contact: Contact) -> tuple[FloatArray, FloatArray]:
        """Return the force (2, n) [N] and the couple (n,) [Nm] of a joint on its body, friction included."""
        force, couple = np.zeros((2, self.system.poses.count)), np.zeros(self.system.poses.count)
        first = self.system.first[contact]
        pairs = [(column, self.u[:, first + k]) for k, column in enumerate(self.system.columns[first : first + contact.columns])]
        pairs += [(rub.column, self.q[:, k]) for k, rub in enumerate(self.rubbing) if rub.column.contact == contact]
        for column, size in pairs:
            force, couple = force + column.wrench.force * size, couple + column.wrench.couple * size
        return force, couple


def solve(poses: Poses, loaded: Loaded, split: str = "refuse") -> Solved:
    """Return the joint forces of a loaded motion."""
    system, rubbing = prepared(poses, loaded)
    found = consistent(Equations(system, rubbing, split, tuple(system.known())))
    pulled = pulling(found)
    if not pulled.any():
        return found
    other = consistent(Equations(system, rubbing, split, tuple(system.known(-1))))
    return chosen(pulled, other, found)


def pulling(solved: Solved) -> Mask:
    """Return the poses where a line of several cylinders, one of which works with both sides, pulls with its first (n,)."""
    system = solved.system
    mask = np.zeros(system.poses.count, bool)
    for line in system.structure.holding.lines:
        if len(line.cylinders) > 1 and any(each.works_both for each in line.cylinders):
            first = next(each for each in system.structure.struts if each.line is line)
            mask |= solved.value(system.thrust(first)) < 0.0
    return mask


def chosen(mask: Mask, there: Solved, else_: Solved) -> Solved:
    """Return one solution where a mask (n,) holds, the other one elsewhere."""
    u, q = (np.where(mask[:, None], a, b) for a, b in ((there.u, else_.u), (there.q, else_.q)))
    return Solved(else_.system, u, q, np.where(mask, there.locked, else_.locked), else_.rubbing)


def prepared(poses: Poses, loaded: Loaded) -> tuple[System, list[Rub]]:
    """Return the equations' system and its rubbing joints."""
    structure = Structure(poses.plan, loaded.elements, loaded.pushing)
    rubbing = rubs(structure, poses, loaded.frictions, loaded.movement) if loaded.frictions else []
    return System(structure, poses, loaded.acting, tuple(rub.column for rub in rubbing)), rubbing


def consistent(equations: Equations) -> Solved:
    """Return the forces at which friction and joint forces agree."""
    system, balance = equations.system, equations.solve()
    q, locked = settled(system, balance, equations.rubbing)
    return Solved(system, balance.start + (balance.spread * q[:, None]).sum(axis=2), q, locked, equations.rubbing)


def joint_forces(solved: Solved) -> tuple[JointForce, ...]:
    """Return every joint's force in the motion's shape."""
    structure, full = solved.system.structure, solved.system.poses.full
    found = []
    for contact in structure.contacts:
        force, couple = solved.transmitted(contact)
        axis = structure.parts[contact.on].axis if 0 <= contact.on < len(structure.parts) else None
        on, by = structure.name(contact.on), structure.name(contact.by)
        found.append(JointForce(contact.point, on, by, contact.kind, full(force), full(couple), axis))
    return tuple(found)
