"""Work of a synthesis for workers: populations measured and laid onto the task, and local searches, piece by piece."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from contextlib import suppress
from itertools import groupby
from typing import Literal, TypeAlias

import numpy as np

from ..errors import LinkageError
from ..frozen import immutable
from ..numeric.descent import BEGIN
from ..program import FloatArray
from ..study.checkpoint import Checkpoint
from ..study.designs import Array, Designs, DesignValues, StudyWork
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
class FitWork(StudyWork):
    """Work on designs by the fit of their combination, `piece` at a time; the result of each design does not depend on the worker.

    `measure` returns the results of designs of one combination, arrays (m, ...) by name, from the fit and their rows. The `facts` identify
    the work, beside the task and its designs.
    """

    problem: Problem
    rows: TaskRows
    timing: Timing
    known: FloatArray | None
    facts: str

    @property
    def empty(self) -> dict[str, Array]:
        """The empty result."""
        at, base = np.zeros((0, len(self.problem.space.variables) + self.timing.width)), np.zeros((0, self.rows.count))
        return {"at": at, "base": base, "error": np.zeros(0), "ended": np.zeros(0, bool)}

    def done(self, rows: DesignValues, start: int, stop: int) -> list[dict[str, Array]]:
        """Return the results of the designs from start to before stop, of each piece, with how many designs were `looked` at."""
        found = []
        for first in range(0, stop - start, self.piece):
            last, parts = min(first + self.piece, stop - start), []
            for combination, group in groupby(map(tuple, rows["combination"][first:last].astype(int).tolist())):  # those in a row
                begin, first = first, first + len(list(group))
                # a problem of its own: its samples and its count are of nobody else
                problem = self.problem.on_branch(combination).sampled_apart(self.problem.counts, counted=False)
                fit = Fit(problem, self.rows, self.timing, combination, self.known)
                own = {name: column[begin:first] for name, column in rows.items() if name != "combination"}
                looked = np.zeros(first - begin)
                parts.append({**self.measure(fit, own), "looked": looked})
                looked[0] = problem.count.designs
            found.append({name: np.concatenate([part[name] for part in parts]) for name in parts[0]})
        return found


def look_results(fit: Fit, rows: DesignValues, *, timed: object) -> dict[str, Array]:
    """Return which designs are assembled over the whole stroke, and which somewhere."""
    _, reached = fit.swept(rows["unit"], poses_of(fit, timed))
    return {"whole": np.asarray(reached.all(axis=1)), "somewhere": np.asarray(reached.any(axis=1))}


def laying_results(
    fit: Fit, rows: DesignValues, *, timed: object, likeness: Mapping[Combination, Likeness], running: Collection[Combination]
) -> dict[str, Array]:
    """Return designs laid onto the task, by the likeness of their combination; of which combinations all of them run."""
    combination = fit.combination
    at, base = laid_designs(fit, likeness[combination], rows["unit"], timed, runs=combination in running)
    return {"at": at, "base": base, "error": fit.errors(at, base)}


def descent_results(fit: Fit, rows: DesignValues, *, through: Through, most: float) -> dict[str, Array]:
    """Return the ends of local searches, all of a piece together, `through` some designs; each may look at so many at the `most`."""
    at, base = np.array(rows["at"]), rows["base"]
    error, going = fit.errors(at, base), np.arange(len(at))
    mask = {"free": None, "running": fit.assembled, "keeping": fit.keeping}[through]
    for turn in range(TURNS + FARTHER):
        if turn >= TURNS:
            going = going[np.isin(going, np.argsort(error, kind="stable")[:LONGER]) & (error[going] > exact_error(fit.rows))]
        if not len(going) or fit.problem.count.designs >= most * len(at):
            break
        before = error[going]
        left = (most * len(at) - fit.problem.count.designs) / (2.0 * len(going))  # a step looks at one design or two
        steps, begin = STEPS if turn < TURNS else LONG, AGAIN if turn else BEGIN
        at[going], error[going] = fit.descend(at[going], base[going], int(np.clip(left, 1, steps)), through=mask, begin=begin)
        order = np.argsort(error, kind="stable")  # searches that stand where a better one does are led by it
        unit, by_order, led = at[order, : fit.n], error[order], np.zeros(len(at), bool)
        with np.errstate(invalid="ignore"):
            one = is_one_design(unit[:, None], unit, by_order[:, None], by_order, exact_error(fit.rows))
        led[order] = np.tril(one, -1).any(axis=1)
        going = going[(error[going] < (1.0 - 1e-9 if turn < TURNS else WORTH) * before) & ~led[going]]
    return {"at": at}


def race_results(fit: Fit, rows: DesignValues, *, steps: int) -> dict[str, Array]:
    """Return the first steps of local searches, for those that run then; with the `error` where each stands."""
    at, base = rows["at"], rows["base"]
    raced, error = fit.descend(at, base, steps)
    runs = fit.assembled(raced) & np.isfinite(error)
    return {"at": np.where(runs[:, None], raced, at), "error": np.where(runs, error, fit.errors(at, base))}


def polish_results(fit: Fit, rows: DesignValues, *, in_order: bool, most: float) -> dict[str, Array]:
    """Return local searches with all conditions, from where each stands, `at`, or else from `first`; which of them came to an end."""
    ((at, first, base),) = zip(rows["at"], rows["first"], rows["base"], strict=True)
    fit.problem.count.limit = int(min(most, LOOKS))
    for start in (at, first):
        with suppress(LinkageError):
            squares = fit_squares(fit, start, base, in_order=in_order)
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
        rows, found = joined_rows(parts), work.empty

        def tell(done: int, count: int) -> None:
            self.tell(self.before + told * done // count, self.total)

        if rows.count:
            facts, checkpoint = f"{name} {work.facts} {rows.count} {rows.digests()}".encode(), self.checkpoint
            run = SurveyRun(work, rows, self.executor, None if checkpoint is None else checkpoint.stage(name, facts), tell)
            run.go()
            self.before += told
            work.problem.count.designs += int(run.values["looked"].sum())
            found = run.values
        ends = np.cumsum([len(next(iter(columns.values()))) for _, columns in parts])
        return [{key: column[begin:end] for key, column in found.items()} for begin, end in zip([0, *ends], ends, strict=False)]
