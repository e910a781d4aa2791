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


def solve(poses: Poses, loaded: Loaded, moved: str, split: str = "refuse") -> Solved:
    """Return the joint forces of a loaded motion while one stroke moves."""
    return consistent(Equations(*prepared(poses, loaded, moved), split))


def prepared(poses: Poses, loaded: Loaded, moved: str) -> tuple[System, list[Rub]]:
    """Return the equations' system and its rubbing joints."""
    structure = Structure(poses.plan, loaded.elements)
    rubbing = rubs(structure, poses, loaded.frictions, moved, loaded.sense) if loaded.frictions else []
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


def on_bodies(solved: Solved) -> dict[str, dict[str, FloatArray]]:
    """Return all forces on each body by the point they act at, joints and loads, in the motion's shape."""
    structure, full = solved.system.structure, solved.system.poses.full
    found: dict[str, dict[str, FloatArray]] = {structure.name(body): {} for body in range(-1, len(structure.parts))}

    def add(body: int, point: str, force: FloatArray) -> None:
        there = found.setdefault(structure.name(body), {})
        there[point] = there.get(point, np.zeros_like(force)) + force

    for contact in structure.contacts:
        force, _ = solved.transmitted(contact)
        add(contact.on, contact.point, full(force))
        add(contact.by, contact.point, -full(force))
    for body, each, wrench in solved.system.loads:
        add(body, each.load.point, full(wrench.force))
    return found


def residual(solved: Solved) -> float:
    """Return the largest imbalance of any body over the largest force, at the worst pose."""
    system = solved.system
    u = solved.u[:, : system.width]
    rows = (system.A @ u[:, :, None])[:, :, 0] + (system.B @ solved.q[:, :, None])[:, :, 0] + system.load_rows
    size = np.maximum(np.abs(u).max(axis=1, initial=0.0), np.abs(system.load_rows).max(axis=1, initial=0.0))
    worst = np.abs(rows).max(axis=1, initial=0.0) / np.where(size > 0.0, size, 1.0)
    return float(np.nanmax(worst, initial=0.0))
