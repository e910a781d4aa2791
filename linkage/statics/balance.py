"""The solution of the equations of equilibrium, all poses in one call; and the words where there is none."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ..errors import DefinitionError, SingularError
from ..motion.reach import where_words
from ..program import FloatArray
from .contacts import Contact
from .rub import Rub
from .system import Form, System

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
