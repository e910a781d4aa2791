"""A system solved, and what is read off it: joint forces, what acts on each body, the residual."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Protocol

import numpy as np

from ..errors import DefinitionError, SingularError
from ..motion.limits import Mask, where_words
from ..program import FloatArray
from ..quantities import Distance, Quantity, name_of
from .acting import Loaded
from .equilibrium import Form, System
from .friction import Pressed, Rows, Rub, rubs, settled
from .joints import Contact, JointForce, Structure, follows_points
from .poses import Poses

# The solution of the equations of equilibrium, all poses in one call; and the words where there is none.

SPLITS = ("refuse", "least squares")
RANK = 1e-9  # singular values below this part of the largest count as zero


@dataclass(frozen=True)
class Balance:
    """The joint forces u = start + spread q, shapes (n, columns) and (n, columns, frictions)."""

    start: FloatArray
    spread: FloatArray


@dataclass(frozen=True)
class Equations:
    """A system, with a known drive force for each support that takes its place as an unknown."""

    system: System
    rubbing: list[Rub] = field(default_factory=list)
    split: str = "refuse"
    bound: tuple[tuple[Form, FloatArray], ...] = ()
    supports: FloatArray | None = None

    @property
    def free(self) -> int:
        """How many unknowns are not joint forces: the supports."""
        return 0 if self.supports is None else int(self.supports.shape[2])

    @cached_property
    def A(self) -> FloatArray:
        """All rows of the unknowns, shape (n, rows, columns)."""
        upper = self.system.A
        if self.supports is not None:
            upper = np.concatenate([upper, self.supports], axis=2)
        rows = [np.concatenate([form.row, self.system.poses.zeros(self.free)], axis=1)[:, None] for form, _ in self.bound]
        return np.concatenate([upper, *rows], axis=1)

    @cached_property
    def right(self) -> FloatArray:
        """The right sides: of the loads, and of each friction, shape (n, rows, 1 + frictions)."""
        loads = np.concatenate([-self.system.load_rows, *((value - form.rest)[:, None] for form, value in self.bound)], axis=1)
        rubs = np.concatenate([-self.system.B, *(-form.rub[:, None] for form, _ in self.bound)], axis=1)
        return np.concatenate([loads[:, :, None], rubs], axis=2)

    def solve(self) -> Balance:
        """Return the balance. Raises DefinitionError where bodies hang loose or links are redundant, SingularError at some poses."""
        n, rows, columns = self.A.shape
        if n == 0:
            return Balance(np.zeros((0, columns)), np.zeros((0, columns, len(self.system.rubs))))
        self.check(rows, columns)
        found = self.square() if rows == columns else np.linalg.pinv(self.A, rcond=RANK) @ self.right
        self.check_held(found)
        return Balance(found[:, :, 0], found[:, :, 1:])

    def square(self) -> FloatArray:
        """Return the solution of as many equations as unknowns; NaN where one pose has none."""
        try:
            return np.asarray(np.linalg.solve(self.A, self.right))
        except np.linalg.LinAlgError:
            sound = np.linalg.matrix_rank(self.A) == self.A.shape[1]
            found = np.full(self.right.shape, np.nan)
            found[sound] = np.linalg.solve(self.A[sound], self.right[sound])
            return found

    def check(self, rows: int, columns: int) -> None:
        """Raise DefinitionError for a mechanism with loose bodies, or with redundant links unless a split is asked for."""
        if self.split not in SPLITS:
            raise DefinitionError(f'split={self.split!r}: say "refuse" or "least squares".')
        rank = self.rank
        if rank < rows:
            raise DefinitionError(self.loose_words(rows - rank))
        if rank < columns and self.split == "refuse":
            raise DefinitionError(self.redundant_words(columns - rank))

    @cached_property
    def sample(self) -> FloatArray:
        """The equations at three poses, by which their rank is told."""
        n = len(self.A)
        return self.A[sorted({0, n // 3, (2 * n) // 3, n - 1})]

    @cached_property
    def rank(self) -> int:
        """How many of the equations are independent, at the best of some poses."""
        return rank_of(self.sample)

    def check_held(self, found: FloatArray) -> None:
        """Raise SingularError where the forces are not finite or do not balance the loads."""
        with np.errstate(invalid="ignore", over="ignore"):
            miss = np.abs(self.A @ found - self.right).max(axis=(1, 2))
            size = np.abs(self.A).max(axis=(1, 2)) * np.abs(found).max(axis=(1, 2)) + np.abs(self.right).max(axis=(1, 2))
            bad = ~(miss <= 1e-6 * size)
        bad &= size > 0.0
        if not bad.any():
            return
        poses, plan = self.system.poses, self.system.structure.plan
        mask = poses.full(bad.astype(float)) == 1.0
        where = where_words(plan, mask, poses.motion.strokes)
        text = f"{plan.title}: the joints cannot hold the loads {where}: the pose is singular. Leave it out."
        raise SingularError(text, mask=mask, motion=poses.motion)

    # -- words ---------------------------------------------------------------------------------------------

    def redundant_words(self, count: int) -> str:
        """Return which links hold twice what is held already."""
        structure = self.system.structure
        names = [structure.name(body) for body in range(len(structure.parts)) if self.rank_without(body)]
        guides = [contact for contact in structure.contacts if contact.kind == "guide" and self.rank_without_contact(contact)]
        spare = [*(f"link {name}" for name in names), *(f"the guide of {contact.point}" for contact in guides)]
        many = "1 joint force too many" if count == 1 else f"{count} joint forces too many"
        return (
            f"{structure.plan.title} is overconstrained, {many}. Redundant is one of these, without which it is still held: "
            f'{", ".join(spare) or "none alone"}. Take one out, or ask for split="least squares".'
        )

    def rank_without(self, body: int) -> bool:
        """Return whether the rest is still held when a body is taken out with its joints."""
        system = self.system
        gone = [index for index, column in enumerate(system.columns) if body in (column.contact.on, column.contact.by)]
        rows = list(range(system.starts[body], system.starts[body + 1]))
        left = np.delete(np.delete(self.sample, gone, axis=2), rows, axis=1)
        return bool(left.size > 0 and rank_of(left) == left.shape[1])

    def rank_without_contact(self, contact: Contact) -> bool:
        """Return whether the rest is still held without one guide."""
        left: FloatArray = np.delete(self.sample, self.system.first[contact], axis=2)
        return bool(rank_of(left) == left.shape[1])

    def loose_words(self, count: int) -> str:
        """Return which bodies nothing holds."""
        names = ", ".join(self.loose())
        return (
            f"{self.system.structure.plan.title}: with its drives locked it can still move in {count} way{'s' if count > 1 else ''}: "
            f"{names} not held. Declare what holds: Link(...) for bodies placed by Offset, a cylinder by Dyad(..., AB=...)."
        )

    def loose(self) -> Iterator[str]:
        """Yield the bodies that move when all joints hold."""
        u, s, _ = np.linalg.svd(self.sample[0])
        free = u[:, int((s > RANK * s[0]).sum()) :]
        for body in range(len(self.system.starts) - 1):
            if np.abs(free[self.system.starts[body] : self.system.starts[body + 1]]).max() > 1e-6:
                yield self.system.structure.name(body)


def rank_of(matrices: FloatArray) -> int:
    """Return the largest rank among some matrices, shape (k, rows, columns)."""
    if 0 in matrices.shape[1:]:
        return 0
    values = np.linalg.svd(matrices, compute_uv=False)
    return int((values > RANK * values[:, :1]).sum(axis=1).max())


# What the drives do: thrusts and torques, read off the joint forces where each drive is cut.

def cut(system: System, drive: str) -> Form:
    """Return the generalised force of a stroke [N or Nm]: each drive's force times how it follows the stroke."""
    found = [(quantity, force) for quantity, force in driven(system) if follows(system.structure, quantity, drive)]
    if not found:
        raise DefinitionError(
            f"{system.structure.plan.title}: the joints know no drive of {drive}; "
            f"declare it by Dyad(..., AB=... + {drive}), Crank, OnGuide or OnLink."
        )
    forms = [force.times(ratio_of(system.poses, quantity, drive)) for quantity, force in found]
    return sum(forms[1:], forms[0])


def ratio_of(poses: Poses, quantity: Quantity, drive: str) -> FloatArray:
    """Return how a driven quantity follows a stroke, shape (n,); of a distance it is told by its points."""
    if isinstance(quantity, Distance):
        return poses.growth(name_of(quantity.P), name_of(quantity.Q), drive)
    return poses.ratio(quantity, drive)


def follows(structure: Structure, quantity: Quantity, drive: str) -> bool:
    """Return whether a driven quantity follows a stroke; DefinitionError where it follows moving points as well."""
    if isinstance(quantity, Distance):
        return True
    if follows_points(structure.plan, quantity):
        what = f"a drive follows {quantity.name or quantity}, which depends on moving points"
        raise DefinitionError(f"{structure.plan.title}: {what}; its force is not provided.")
    return drive == quantity.name or drive in structure.plan.reaches(quantity)


def driven(system: System) -> Iterator[tuple[Quantity, Form]]:
    """Yield every driven quantity with the force that drives it."""
    structure = system.structure
    for strut in structure.struts:
        if strut.drives:
            yield Distance(strut.P, strut.Q) if strut.quantity is None else strut.quantity, system.thrust(strut)
    for contact in structure.contacts:
        for quantity, letter, sign in structure.driven(contact):
            yield quantity, system.unknown(contact, letter, sign)


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
