"""Synthesis over several classes: each is searched, one after the other, and their answers are ranked together."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ..errors import DefinitionError, cited
from ..language import said_of
from ..mechanism import Mechanism
from ..program import FloatArray
from ..study.checks import check_one_design
from ..study.optimise import check_counts
from ..study.space import size_of_machine
from ..study.survey import check_progress, progress_told
from .exact import REGISTERED
from .synthesis import MISSES, Synthesis, SynthesisedMachine, links_of, told_error
from .tasks import PathTask, PoseTask, Task, of_class, task_named_in, task_of

SHORTEST, LONGEST, ASIDE = 0.05, 5.0, 5.0
"""Of a task's size: between which lengths vary where nothing is said, and how far fixed points from its middle."""
POSES = 97
CHANGE = 1e-3
"""Of a dimension: a change that shows whether a task depends on it."""


def synthesised_classes(
    one: Callable[..., Synthesis],
    machines: Any,
    asked: Sequence[tuple[str, Any, type]],
    by_class: Mapping[str, Any],
    starts: Any,
    seed: int,
    limit: int | None,
    progress: Any,
    options: Mapping[str, Any],
) -> Synthesis:
    """Return what several classes can, each searched by `one`, the synthesis of one machine, one after the other; see `synthesise`.

    `by_class` are what may be said class by class; `options` go to each search as they are.
    """
    designs = designs_of_classes(machines)
    check_counts("synthesise", 1 if starts == "catalogue" else starts, seed, limit)
    check_progress(progress)
    searches = [search_of_class(each, asked, by_class) for each in designs]
    found: list[Synthesis] = []
    with progress_told(progress, said_of(len(searches), "{n} class", "{n} classes")) as tell:
        for number, (machine, own) in enumerate(searches):
            tell(number, len(searches))
            left = None if limit is None else max((limit - sum(each.evaluations for each in found)) // (len(searches) - number), 1)
            kept = dict(options)
            if kept.get("folder") is not None:
                kept["folder"] = os.path.join(kept["folder"], f"{machine.plan.title}-{number + 1}")
            found.append(one(machine, starts=starts, seed=seed, limit=left, **own, **kept))
        tell(len(searches), len(searches))
    return compared(found, limit)


def search_of_class(
    machine: Mechanism, asked: Sequence[tuple[str, Any, type]], by_class: Mapping[str, Any]
) -> tuple[Mechanism, dict[str, Any]]:
    """Return a machine, and what its search is given: the task in its own names, and what is said of its class alone or of all."""
    task = task_named_in(machine, task_of(machine.plan.title, asked))
    task.rows(machine)  # refuses what is no point of it
    options = {name: of_class(value, type(machine)) for name, value in by_class.items()}
    if options["vary"] is None:
        machine = laid_machine(machine, task)
        options["vary"] = default_box(machine, task)
    if options["subject_to"] is None:
        options["subject_to"] = ()
    keyword = next(name for name, value, _ in asked if value is not None)
    return machine, {**options, keyword: task}


def designs_of_classes(given: object) -> list[Mechanism]:
    """Return the designs of classes, of those that are installed where none are given; DefinitionError for anything else."""
    if given is None:
        return shipped_machines()
    if not isinstance(given, (list, tuple)) or not given:
        raise DefinitionError(f"synthesise({cited(given)}): a design or a list of classes is expected, such as [FourBar, SliderCrank].")
    found: list[Mechanism] = []
    for each in given:
        made = each() if isinstance(each, type) and issubclass(each, Mechanism) else each
        check_one_design(made)
        found.append(made)
    return found


def shipped_machines() -> list[Mechanism]:
    """Return the designs of the installed machines that name a point of a coupler and need no iteration, those of few links first."""
    found: dict[type[Mechanism], Mechanism] = {}
    for kind in REGISTERED.loaded()[0].values():  # one that cannot be loaded hides no other
        if "featured" in vars(kind):
            machine = kind()
            if machine.featured().coupler and not machine.plan.groups:
                found[kind] = machine
    if not found:
        raise DefinitionError("synthesise: no machine with a point of a coupler is installed; give a list, synthesise([FourBar, ...]).")
    return sorted(found.values(), key=lambda each: (links_of(each), each.plan.title))


def ranking(each: SynthesisedMachine, exact: float) -> tuple[float, float]:
    """Return by what answers are ranked: the error to three digits, then what is asked."""
    return told_error(each.error, exact), 0.0 if np.isnan(each.ranked) else each.ranked


def compared(found: list[Synthesis], limit: int | None) -> Synthesis:
    """Return what was found of all classes, ranked over all; of answers of the same error the one of fewer links first."""
    every = [(own, answer) for own in found for answer in own.solutions]
    every.sort(key=lambda one: (*ranking(one[1], one[0].exact), links_of(one[1].machine), one[1].error))
    order = {id(own): place for place, (own, _) in reversed([*enumerate(every)])}
    found.sort(key=lambda own: (order.get(id(own), len(every)), min([miss.error for miss in own.misses], default=np.inf)))
    misses = sorted((miss for own in found for miss in own.misses), key=lambda miss: miss.error)
    sums = {name: sum(getattr(own, name) for own in found) for name in ("population", "running", "starts", "evaluations")}
    spent = limit if limit is not None and sums["evaluations"] >= limit else None
    return replace(
        found[0], solutions=tuple(answer for _, answer in every), misses=tuple(misses[:MISSES]), limit=spent, classes=tuple(found), **sums
    )


# What varies where nothing is said.


def laid_machine(machine: Mechanism, task: Task) -> Mechanism:
    """Return a machine as large as the task, and where it is: lengths and fixed points scaled and shifted; as it is for a function."""
    where = places_wanted(task)
    if where is None:
        return machine
    own = run_of_task(machine, task)[:2]
    own = own[:, np.isfinite(own).all(axis=0)]
    large = float(np.ptp(own, axis=1).max()) if own.size else 0.0
    if not large:
        return machine
    by, middle, aim = size_of_places(where) / large, own.mean(axis=1), where.mean(axis=1)
    values: dict[str, Any] = {}
    for name, entry in machine.plan.table.entries.items():
        now = float(machine.dimensions[name])
        if entry.kind == "length":
            values[name] = by * now
        elif entry.kind == "coordinate":
            axis = "xy".index(name[-1])
            values[name] = float(aim[axis] + by * (now - middle[axis]))
    return machine.replaced(**values)


def run_of_task(machine: Mechanism, task: Task) -> FloatArray:
    """Return what a task wants of a machine over its first stroke, shape (r, poses), NaN out of reach."""
    (name, stroke), *others = machine.strokes.items()
    held = {other: each.start for other, each in others}
    strokes: dict[str, Any] = {**held, name: np.linspace(stroke.start, stroke.end, POSES)}
    return np.array(machine.evaluate(task.rows(machine).quantities, unreachable="nan", **strokes))


def places_wanted(task: Task) -> FloatArray | None:
    """Return the places of a task, shape (2, n) [m]; None for a function, which has none."""
    if isinstance(task, PathTask):
        return np.asarray(task.points.T)
    return np.array([task.x, task.y]) if isinstance(task, PoseTask) else None


def size_of_places(where: FloatArray) -> float:
    """Return the longer side of the rectangle about some places [m]; how far they lie from the origin where they are one."""
    return float(np.ptp(where, axis=1).max()) or float(np.abs(where).max()) or 1.0


def default_box(machine: Mechanism, task: Task) -> dict[str, tuple[float, float]]:
    """Return the ranges of all dimensions that a task depends on, by its size; see `synthesise`."""
    where, entries = places_wanted(task), machine.plan.table.entries
    if where is None:
        lengths = [float(machine.dimensions[name]) for name, entry in entries.items() if entry.kind == "length"]
        large, middle = max(lengths, default=1.0), np.zeros(2)
    else:
        large, middle = size_of_places(where), where.mean(axis=1)
    found: dict[str, tuple[float, float]] = {}
    for name, entry in entries.items():
        if entry.kind not in ("length", "coordinate", "angle") or not depends_on(machine, task, name):
            continue
        if entry.kind == "length":
            found[name] = (SHORTEST * large, LONGEST * large)
        elif entry.kind == "angle":
            found[name] = (-np.pi, np.pi)
        else:
            aim = float(middle["xy".index(name[-1])])
            found[name] = (aim - ASIDE * large, aim + ASIDE * large)
    if not found:
        raise DefinitionError(f"{machine.plan.title}: no length, angle or fixed point of it moves what the task is of; say vary={{...}}.")
    return found


def depends_on(machine: Mechanism, task: Task, name: str) -> bool:
    """Return whether what a task is of changes with a dimension."""
    now = float(machine.dimensions[name])
    step = CHANGE * (abs(now) or size_of_machine(machine))
    before, after = run_of_task(machine, task), run_of_task(machine.replaced(**{name: now + step}), task)
    with np.errstate(all="ignore"):
        change = np.abs(after - before)
    return bool(np.nanmax(change, initial=0.0) > 1e-9 * step)
