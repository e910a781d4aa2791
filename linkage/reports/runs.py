"""Runs of a machine, the same for every reader: along its declared `Over`s, else along one stroke."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from types import MappingProxyType
from typing import Any, TypeAlias

import numpy as np

from .. import motion as between
from ..errors import DefinitionError, ensure, known_name, require_type
from ..language import said
from ..loads import PLAIN, Acting, Case, LoadCase, case_in_words, case_titles
from ..mechanism import Mechanism
from ..motion import Judge, Motion, Run, case_named, out_of_reach, require_motion
from ..motion.judge import Domain
from ..numeric.line import stretches
from ..plan import Plan, require_kind
from ..program import FloatArray
from ..quantities import as_mapping, numbers_in
from .results import case_along, case_shown, worst_answer

At: TypeAlias = Mapping[str, Any]
NOTHING: At = MappingProxyType({})


def runs_of(machine: Mechanism, at: At | Motion = NOTHING, over: object = None, acting: Acting | None = None) -> tuple[Run, ...]:
    """Return the runs of a machine, which its pictures, tables, pages and reports follow.

    Parameters
    ----------
    machine : Mechanism
        The design.
    at : mapping or Motion, optional
        Values of strokes [m or rad]: one value holds a stroke, several are its run. Of a motion it is its own way.
    over : Over, str or sequence, optional
        Where it is judged instead of at the `Over`s that the machine declares.
    acting : Acting, optional
        The load case that is asked for.

    Returns
    -------
    tuple of Run
        One for each `Over`, in the machine's own loads where these occur there, else in the load case in which what the machine is about
        is worst. Its path, its poses, the stroke that runs in its box. Of a box in which several run it is the first of them, the others
        at the worst place of what the machine is about. Where nothing is declared, or `at` says more, one run of the strokes that `at`
        gives two values or more, else of the first that it does not hold, the others in their middle.

    Raises
    ------
    DefinitionError
        Nothing is left to move, strokes that run together do not pass as many values each, an unknown stroke, `Over` or load case.
    """
    one, title = first_stroke(machine), machine.plan.title
    if isinstance(at, Motion):
        return (run_along(at)[0],)
    require_type(f"{title}: at", at, Mapping, f"values of strokes by name are expected, such as at={as_mapping({one: 0.1})}")
    judge = None if at else machine.judge(over, acting)
    declared = [place for place in judge.places if place.over.name or over is not None] if judge else []
    asked = PLAIN if judge is None or judge.acting.case is None else judge.acting
    name = "" if asked is PLAIN else case_named(machine.plan, asked.case) if not isinstance(asked.case, LoadCase) else asked.case.name
    shown = [place for place in declared if not name or name in place.cases(PLAIN)] or declared
    return tuple(run_over(machine, place, asked) for place in shown) or (one_run(machine, at),)


def run_of(machine: Mechanism, at: At | Motion = NOTHING) -> Run:
    """Return the first run of `runs_of` along which something moves, which one picture shows; of declared poses alone one stroke's."""
    return next((run for run in runs_of(machine, at) if run.is_curve), None) or one_run(machine, NOTHING)


def run_over(machine: Mechanism, place: Domain, acting: Acting) -> Run:
    """Return the run over an `Over` of one design."""
    plan, case = machine.plan, case_shown(machine, place, acting)
    strokes: dict[str, Sequence[float]] = {name: np.ravel(value).tolist() for name, value in place.motion.strokes.items()}
    running, worst = place.running, ""
    if place.over.shape == "box" and running:
        first, *others = running
        ends = min(strokes[first]), max(strokes[first])
        strokes[first] = ends if plan.strokes[first].start <= plan.strokes[first].end else ends[::-1]
        running = (first,)
        if others:
            held = {name: 0.5 * (min(strokes[name]) + max(strokes[name])) for name in others}
            middle = Run({first: ends}, {name: each[0] for name, each in strokes.items()} | held)
            worst, answer = worst_answer(machine, machine.at(unreachable="nan", **middle.divided(3)), place, acting)
            found = answer.strokes if answer is not None and np.all(np.isfinite([*answer.strokes.values()])) else {}
            worst, strokes = worst if found else "", strokes | {name: [found.get(name, held[name])] for name in others}
    ways = {name: tuple(strokes[name]) for name in running}
    still = {name: values[0] for name, values in strokes.items() if name not in running}
    declared = place.over if place.instants is not None else None
    return Run(ways, still, place.over.name, case, place.over.shape == "poses", worst, declared, place.instants)


def run_words(machine: Mechanism, run: Run) -> str:
    """Return which run it is and in which load case, in words: `over reaching, in the case far`; "" where there is nothing to say."""
    parts = [said("over {over}", over=run.title) if run.title else "", in_case_words(machine.plan, run.case)]
    return ", ".join(filter(None, parts))


def in_case_words(plan: Plan, case: Case) -> str:
    """Return which load case it is in words, by its title; "" for a machine that has none but its own loads."""
    cases = plan.of_kind(LoadCase)
    known = cases.get(case, case) if isinstance(case, str) else case
    if known is None and not cases:
        return ""
    return case_in_words((known.name or known.label) if isinstance(known, LoadCase) else known or "", case_titles(plan))


def run_along(motion: Motion) -> tuple[Run, int]:
    """Return the run along a motion of one axis, through all its places, and the number from 0 of the first of them.

    Of a sweep along an `Over.path` these are the places of the path, in a load case that occurs there. Of one that is not reached
    everywhere it is the longest part that is.
    DefinitionError for a grid, a batch, fewer than two places.
    """
    title, shape, place, case = require_motion(motion).plan.title, motion.shape, None, case_along(motion)
    if motion.is_swept and motion.over.shape == "path":
        place = Judge(motion.plan, motion.designs, [motion]).places[0]
        motion = place.motion  # the places that its `Over` names
    said = f"one design along one path is expected, and this motion is of shape {shape}"
    ensure(len(shape) == 1 and not motion._design_shape, f"{title}: {said}; choose one path of it.")
    first, last = max(stretches(motion.reached), key=lambda part: part[1] - part[0], default=(0, -1))
    ways = {name: tuple(values[first : last + 1].tolist()) for name, values in motion.strokes.items()}
    moving = {name: way for name, way in ways.items() if len(set(way)) > 1}
    ensure(moving, f"{title}: nothing moves along this motion; it has {last - first + 1} places in reach.")
    run = Run(moving, {name: way[0] for name, way in ways.items() if name not in moving}, case=case)
    if place is not None and place.instants is not None:
        run = replace(run, declared=place.over, instants=place.instants)
    return run, first


def one_run(machine: Mechanism, at: At) -> Run:
    """Return the run of the strokes that `at` gives two values or more, else of the first that it does not hold, over its range.

    Several run together, in straight lines from value to value. Strokes that are not given are at mid-stroke.
    """
    one, title = first_stroke(machine), machine.plan.title
    given: dict[str, tuple[float, ...]] = {}
    for name, value in at.items():
        known_name("Stroke", name, machine.strokes, where=title)
        require_kind(machine.plan, name, value, f"{title}: at: {name}")
        given[name] = values = tuple(np.ravel(numbers_in(value)).tolist())
        if not values or (len(values) > 1 and len(set(values)) == 1) or not np.all(np.isfinite(values)):
            said = "one number holds a stroke, two different ones are the ends of its run, more are passed one after the other"
            raise DefinitionError(f"{title}: {name}={value!r}: {said}.")
    ways = {name: given[name] for name in machine.strokes if len(given.get(name, ())) > 1}
    free = [name for name in machine.strokes if name not in given]
    if len({len(way) for way in ways.values()}) > 1:
        said = " and ".join(f"{name} passes {len(way)} values" for name, way in ways.items())
        raise DefinitionError(f"{title}: {said}; strokes that run together pass as many values each.")
    ensure(ways or free, f"{title}: every stroke is held, so that nothing moves; give {one} two values, its run.")
    moving = ways or {free[0]: (machine.strokes[free[0]].start, machine.strokes[free[0]].end)}
    held = stroke_middles(machine) | {name: values[0] for name, values in given.items()}
    case = case_along(machine.at(unreachable="nan", **held))
    return Run(moving, {name: value for name, value in held.items() if name not in moving}, case=case)


def motion_over(machine: Mechanism, run: Run, shares: FloatArray) -> Motion:
    """Return the poses of a run at shares of its way (n,), 0 to 1, in time at these instants; NaN out of reach."""
    if run.instants is None:
        return machine.at(unreachable="nan", **run.over(shares))
    instants = run.instants.shares(shares)
    return Motion(machine.plan, machine.dimensions, instants.strokes, "nan", over=run.declared, instants=instants)


def reached_motion(machine: Mechanism, strokes: At | Motion) -> Motion:
    """Return a machine at strokes [m or rad], NaN where it cannot be assembled; AssemblyError where it cannot anywhere."""
    motion = strokes if isinstance(strokes, Motion) else machine.at(unreachable="nan", **strokes)
    if not motion.reached.any():
        raise out_of_reach(motion)
    return motion


def first_stroke(machine: Mechanism) -> str:
    """Return the first stroke; DefinitionError for a structure without one, and for anything but a mechanism."""
    require_type("", machine, Mechanism, "is no mechanism; give a design such as Boom(), and its strokes by at=")
    ensure(machine.strokes, f"{machine.plan.title} has no stroke, so there is nothing to move; declare one, S = Stroke(0, 0.25).")
    return next(iter(machine.strokes))


def stroke_grid(machine: Mechanism, axes: Mapping[str, FloatArray], crossed: Collection[str] = ()) -> dict[str, FloatArray]:
    """Return the strokes of a grid, arrays of one shape: an axis for each one with more than one value, and for those `crossed`."""
    many = [name for name in machine.strokes if len(axes[name]) > 1 or name in crossed]
    grids = dict(zip(many, np.meshgrid(*(axes[name] for name in many), indexing="ij"), strict=True)) if many else {}
    return {name: grids.get(name, axes[name][0]) for name in machine.strokes}


def stroke_middles(machine: Mechanism) -> dict[str, float]:
    """Return the middle of every stroke [m or rad]."""
    return {name: 0.5 * (stroke.start + stroke.end) for name, stroke in machine.strokes.items()}


Range: TypeAlias = tuple[float, float]


def one_stroke(motion: Motion) -> str:
    """Return the only stroke of a motion; DefinitionError for anything but a motion, and where there are several."""
    require_motion(motion)
    ensure(len(motion.strokes) == 1, f"{motion.plan.title}: ranges are told along one stroke, here are {len(motion.strokes)}.")
    return next(iter(motion.strokes))


def reached_span(motion: Motion) -> Range:
    """Return the least and the largest stroke reached [SI] over the range of a motion, whatever its number of poses.

    Raises AssemblyError where none is.
    """
    name = one_stroke(motion)
    found = [(each.start[name], each.end[name]) for each in between.reached_spans(motion)]
    if not found:
        raise out_of_reach(motion)
    return found[0][0], found[-1][1]


def closely(motion: Motion, values: FloatArray | None = None) -> Motion:
    """Return the same design at chosen strokes [SI], else at 513 poses over the reached range; NaN where out of reach."""
    name = one_stroke(motion)
    return motion.moved({name: np.linspace(*reached_span(motion), 513) if values is None else values})
