"""Work of a synthesis for workers: populations measured and laid onto the task, and local searches, piece by piece."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from contextlib import suppress
from itertools import groupby
from typing import Any, ClassVar, Literal, TypeAlias

import numpy as np

from ..errors import LinkageError
from ..frozen import immutable
from ..mechanism import Mechanism
from ..numeric.descent import BEGIN
from ..plan import Mask
from ..program import FloatArray
from ..study.checkpoint import Checkpoint
from ..study.designs import Array, Designs, DesignValues
from ..study.problem import Problem
from ..study.solver import Local
from ..study.survey import Executor, Progress, SurveyRun
from .fit import Fit, Timing, fit_squares
from .starts import Likeness, laid_designs, poses_of
from .synthesis import exact_error, is_one_design
from .tasks import TaskRows

STEPS, TURNS = 20, 15
"""Steps of a local search between two looks at the limit and at which searches stand where a better one does, and how many times."""
AGAIN = 1e-8
"""The damping with which a search goes on after such a look: about what it came to."""
LOOKS = 3000
"""Designs that a search with conditions looks at, at the most: where it creeps along a wall, what it has by then is taken."""
LONGER, LONG, FARTHER, WORTH = 16, 60, 15, 0.9
"""Of a piece the best ends that go on, so many steps, how many times more, while their error comes down to this part: valleys may be
long."""
RACE = 10
"""Steps of a race, after which the best go on."""
NUMBERS = 1 << 18
"""Slopes that a step of a race works out at a time: the more searches go at once, the less each costs."""

Combination = tuple[int, ...]
Part: TypeAlias = tuple[Combination, Mapping[str, Array]]
"""A combination of choices, and what is to be known of each of some designs of it, arrays (m, ...)."""
Through: TypeAlias = Literal["free", "running", "keeping"]
"""What a local search comes through: any designs, those that run over the whole stroke, or those that keep the conditions, too."""


def joined_rows(parts: Sequence[Part]) -> Designs:
    """Return the designs of several combinations of choices, one after the other, with these; of none at least one is given."""
    many = [len(next(iter(columns.values()))) for _, columns in parts]
    chosen = np.repeat(np.array([combination for combination, _ in parts], int).reshape(len(parts), -1), many, axis=0)
    own = {name: (np.concatenate([columns[name] for _, columns in parts]),) for name in parts[0][1]}
    return Designs({"combination": (chosen,), **own}, len(chosen))


@immutable
class FitWork(ABC):
    """Work on designs by the fit of their combination; the result of each design does not depend on the worker."""

    problem: Problem
    rows: TaskRows
    timing: Timing
    known: FloatArray | None
    backend: ClassVar[str] = "numpy"
    what: ClassVar[str] = "a condition or the mechanism's class"

    @property
    @abstractmethod
    def piece(self) -> int:
        """How many designs are looked at at a time."""

    @abstractmethod
    def results(self, fit: Fit, rows: DesignValues) -> dict[str, Array]:
        """Return the results of designs of one combination, arrays (m, ...)."""

    @property
    def machine(self) -> Mechanism:
        """The machine."""
        return self.problem.machine

    @property
    def facts(self) -> str:
        """The facts that identify the work, beside the task and its designs, as text."""
        return f"{type(self).__name__} {self.piece}"

    @property
    def empty(self) -> dict[str, Array]:
        """The empty result."""
        at, base = np.zeros((0, len(self.problem.space.variables) + self.timing.width)), np.zeros((0, self.rows.count))
        return {"at": at, "base": base, "error": np.zeros(0), "ended": np.zeros(0, bool)}

    def fit(self, combination: Combination) -> Fit:
        """Return a fit with a problem of its own: its samples and its count are of nobody else."""
        own = self.problem.on_branch(combination).sampled_apart(self.problem.counts, counted=False)
        return Fit(own, self.rows, self.timing, combination, self.known)

    def done(self, rows: DesignValues, start: int, stop: int) -> list[dict[str, Array]]:
        """Return the results of the designs from start to before stop, of each piece, with how many designs were `looked` at."""
        found = []
        for first in range(0, stop - start, self.piece):
            last, parts = min(first + self.piece, stop - start), []
            for combination, group in groupby(map(tuple, rows["combination"][first:last].astype(int).tolist())):  # those in a row
                begin, first = first, first + len(list(group))
                fit = self.fit(combination)
                own = {name: column[begin:first] for name, column in rows.items() if name != "combination"}
                looked = np.zeros(first - begin)
                parts.append(self.results(fit, own) | {"looked": looked})
                looked[0] = fit.problem.count.designs
            found.append({name: np.concatenate([part[name] for part in parts]) for name in parts[0]})
        return found


@immutable
class LookWork(FitWork):
    """Which designs are assembled over the whole stroke, and which somewhere."""

    timed: Any
    piece: ClassVar[int] = 1024

    def results(self, fit: Fit, rows: DesignValues) -> dict[str, Array]:
        _, reached = fit.swept(rows["unit"], poses_of(fit, self.timed))
        return {"whole": np.asarray(reached.all(axis=1)), "somewhere": np.asarray(reached.any(axis=1))}


@immutable
class LayWork(FitWork):
    """Designs laid onto the task, by the likeness of their combination; of which combinations all of them run."""

    timed: Any
    likeness: Mapping[Combination, Likeness]
    running: frozenset[Combination]
    piece: ClassVar[int] = 256

    def results(self, fit: Fit, rows: DesignValues) -> dict[str, Array]:
        combination = fit.combination
        at, base = laid_designs(fit, self.likeness[combination], rows["unit"], self.timed, runs=combination in self.running)
        return {"at": at, "base": base, "error": fit.errors(at, base)}


@immutable
class DescentWork(FitWork):
    """Local searches, all of a piece together, `through` some designs. `most`: designs that each may look at, if any."""

    through: Through
    most: float
    piece: ClassVar[int] = 64

    @property
    def facts(self) -> str:
        return f"{super().facts} {self.through} {self.most}"

    def results(self, fit: Fit, rows: DesignValues) -> dict[str, Array]:
        at, base = np.array(rows["at"]), rows["base"]
        error, going = fit.errors(at, base), np.arange(len(at))
        through = {"free": None, "running": fit.assembled, "keeping": fit.keeping}[self.through]
        for turn in range(TURNS + FARTHER):
            if turn >= TURNS:
                going = going[np.isin(going, np.argsort(error, kind="stable")[:LONGER]) & (error[going] > exact_error(self.rows))]
            if not len(going) or fit.problem.count.designs >= self.most * len(at):
                break
            before = error[going]
            left = (self.most * len(at) - fit.problem.count.designs) / (2.0 * len(going))  # a step looks at one design or two
            steps, begin = STEPS if turn < TURNS else LONG, AGAIN if turn else BEGIN
            at[going], error[going] = fit.descend(at[going], base[going], int(np.clip(left, 1, steps)), through=through, begin=begin)
            going = going[(error[going] < (1.0 - 1e-9 if turn < TURNS else WORTH) * before) & ~self.led(fit, at, error)[going]]
        return {"at": at}

    def led(self, fit: Fit, at: FloatArray, error: FloatArray) -> Mask:
        """Return which searches (m,) stand where a better one does."""
        order = np.argsort(error, kind="stable")
        unit, sorted_error = at[order, : fit.n], error[order]
        with np.errstate(invalid="ignore"):
            one = is_one_design(unit[:, None], unit, sorted_error[:, None], sorted_error, exact_error(self.rows))
        found = np.zeros(len(at), bool)
        found[order] = np.tril(one, -1).any(axis=1)
        return found


@immutable
class RaceWork(FitWork):
    """The first steps of local searches, for those that run then; with the `error` where each stands."""

    @property
    def piece(self) -> int:
        numbers = self.rows.wanted.size * (len(self.problem.space.variables) + self.timing.width)
        return int(np.clip(NUMBERS // max(numbers, 1), 64, 256))

    @property
    def facts(self) -> str:
        return f"{super().facts} {RACE}"

    def results(self, fit: Fit, rows: DesignValues) -> dict[str, Array]:
        at, base = rows["at"], rows["base"]
        raced, error = fit.descend(at, base, RACE)
        runs = fit.assembled(raced) & np.isfinite(error)
        return {"at": np.where(runs[:, None], raced, at), "error": np.where(runs, error, fit.errors(at, base))}


@immutable
class PolishWork(FitWork):
    """Local searches with all conditions, from where each stands, `at`, or else from `first`; which of them came to an end."""

    in_order: bool
    most: float
    piece: ClassVar[int] = 1

    @property
    def facts(self) -> str:
        return f"{super().facts} {self.in_order} {self.most}"

    def results(self, fit: Fit, rows: DesignValues) -> dict[str, Array]:
        ((at, first, base),) = zip(rows["at"], rows["first"], rows["base"], strict=True)
        fit.problem.count.limit = int(min(self.most, LOOKS))
        for start in (at, first):
            with suppress(LinkageError):
                squares = fit_squares(fit, start, base, in_order=self.in_order)
                local = Local(fit.problem, fit.combination, start[: fit.n], squares=squares)
                end = local.run()
                return {"at": np.concatenate([end.unit, local.own])[None], "ended": np.ones(1, bool)}
        return {"at": at[None], "ended": np.zeros(1, bool)}


class Stages:
    """The stages of a search: each is given out to an executor, and kept in a folder where there is one."""

    def __init__(self, executor: Executor, checkpoint: Checkpoint | None, tell: Progress, total: int) -> None:
        self.executor, self.checkpoint, self.tell, self.total = executor, checkpoint, tell, total
        self.before = 0
        tell(0, total)

    def carried_out(self, name: str, work: FitWork, parts: Sequence[Part], *, told: int = 0) -> list[dict[str, Array]]:
        """Return the results of the designs of each part, arrays (m, ...) by name; in the progress it counts as so many designs."""
        rows = joined_rows(parts)
        found = self._found(name, work, rows, told) if rows.count else work.empty
        ends = np.cumsum([len(next(iter(columns.values()))) for _, columns in parts])
        return [{key: column[begin:end] for key, column in found.items()} for begin, end in zip([0, *ends], ends, strict=False)]

    def _found(self, name: str, work: FitWork, rows: Designs, told: int) -> dict[str, Array]:
        def tell(done: int, count: int) -> None:
            self.tell(self.before + told * done // count, self.total)

        checkpoint = None
        if self.checkpoint is not None:
            facts = f"{name} {work.facts} {rows.count} {rows.digests()}".encode()
            checkpoint = self.checkpoint.stage(name, facts)
        run = SurveyRun(work, rows, self.executor, checkpoint, tell)
        run.go()
        self.before += told
        work.problem.count.designs += int(run.values["looked"].sum())
        return run.values
