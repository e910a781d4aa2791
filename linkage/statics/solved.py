"""A system solved, and what is read off it: joint forces, what acts on each body, the residual."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from ..motion.reach import Mask
from ..program import FloatArray
from .balance import Balance, Equations
from .contacts import Contact
from .drives import cut
from .joint_force import JointForce
from .loaded import Loaded
from .poses import Poses
from .rub import Rub, rubs
from .rubbing import Pressed, Rows, settled
from .structure import Structure
from .system import Form, System


class Rubbed(Protocol):
    """Forces with friction: where they are, what rubs, and where that leaves no bounded ones (n,)."""

    @property
    def poses(self) -> Poses: ...

    @property
    def rubbing(self) -> list[Rub]: ...

    @property
    def locked(self) -> Mask: ...


@dataclass(frozen=True)
class Solved:
    """Joint forces u (n, columns) and frictions q (n, frictions) [N]; `locked` where friction leaves no bounded ones (n,)."""

    system: System
    u: FloatArray
    q: FloatArray
    locked: Mask
    rubbing: list[Rub]

    @property
    def poses(self) -> Poses:
        """The poses they are at."""
        return self.system.poses

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
        if line.changes_shares:
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
    system, balance, rubbing = equations.system, equations.solve(), equations.rubbing
    if not rubbing:
        return Solved(system, balance.start, np.zeros((system.poses.count, 0)), np.zeros(system.poses.count, bool), [])
    found, locked = settled(pressing(system, balance, rubbing), np.stack([rub.coefficient for rub in rubbing]))
    q = found.T
    return Solved(system, balance.start + (balance.spread * q[:, None]).sum(axis=2), q, locked, rubbing)


def pressing(system: System, balance: Balance, rubbing: list[Rub]) -> Pressed:
    """Return the forces that make the frictions, by the solution of the equations."""
    parts = tuple(rub.column.contact.presses for rub in rubbing)
    starts = [system.first[rub.column.contact] for rub in rubbing]
    rows = [start + k for start, many in zip(starts, parts, strict=True) for k in range(many)]
    by_unit = np.moveaxis(balance.spread[:, rows], 0, -1)
    return Pressed(Rows(parts), balance.start[:, rows].T, by_unit, np.ones((len(rubbing), system.poses.count)))


@dataclass(frozen=True)
class Equilibrium:
    """All forces of a motion: each contact's force (2, ...) and couple (...), the drives' and the members' thrusts (...).

    `q` are the frictions (frictions, n) [N] of the rubbing joints, `locked` where friction leaves no bounded ones (n,).
    """

    structure: Structure
    poses: Poses
    loaded: Loaded
    rubbing: list[Rub]
    q: FloatArray
    locked: Mask
    forces: list[tuple[FloatArray, FloatArray]]
    drives: Mapping[str, FloatArray]
    thrusts: Mapping[str, FloatArray]

    @property
    def joints(self) -> tuple[JointForce, ...]:
        """Every joint's force in the motion's shape."""
        structure, found = self.structure, []
        for contact, (force, couple) in zip(structure.contacts, self.forces, strict=True):
            axis = structure.parts[contact.on].axis if 0 <= contact.on < len(structure.parts) else None
            on, by = structure.name(contact.on), structure.name(contact.by)
            found.append(JointForce(contact.point, on, by, contact.kind, force, couple, axis))
        return tuple(found)


def by_equations(poses: Poses, loaded: Loaded, split: str) -> Equilibrium:
    """Return the forces by the equations solved on arrays."""
    solved = solve(poses, loaded, split)
    structure, full = solved.system.structure, poses.full
    forces = [tuple(map(full, solved.transmitted(contact))) for contact in structure.contacts]
    drives = {name: full(solved.value(cut(solved.system, name))) for name in poses.motion.strokes}
    thrusts = {each.name: full(solved.value(solved.system.thrust(each))) for each in structure.struts}
    return Equilibrium(structure, poses, loaded, solved.rubbing, solved.q.T, solved.locked, forces, drives, thrusts)  # type: ignore[arg-type]
