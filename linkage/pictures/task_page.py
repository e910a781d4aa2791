"""The live page of a synthesis: its machine, the task on the sheet and on the curve, and the answers to choose from."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..errors import StudyError, ensure
from ..motion import live_text
from ..motion.measures import measure_of, words_of
from ..quantities import Quantity
from ..reports import At, results
from ..synthesis import FunctionTask, PathTask, PoseTask, Synthesis
from ..synthesis.synthesis import miss_unit
from .layout import grown
from .page_data import PageRequests, machine_text, page_data, unit_data
from .page_file import PageData
from .strokes import frame_count


def task_page(found: Synthesis, *, count: int, language: str, at: At, **given: Any) -> str:
    """Return the HTML of the page of a synthesis: the best machine, with the others of its class to choose; `given` as `page` takes it.

    Without `vary` the sliders are those dimensions that were searched, over their ranges. Raises StudyError where nothing was found.
    """
    if not found.solutions:
        raise StudyError(str(found))
    ensure(not at, f"{found.start.plan.title}: the page of a synthesis runs over the stroke of its task; leave out at=.")
    found = found.own(found.best)
    best, task = found.best, found.task
    fit = found.fit_of(best)
    run = {**fit.held, fit.timing.stroke: (fit.timing.start, fit.timing.start + fit.timing.span)}
    given = {name: value for name, value in given.items() if value is not None}
    space, owners = found.problem.space, best.machine.plan.table.spellings
    named: dict[str, tuple[float, float] | None] = {each.name: (each.low, each.high) for each in space.variables if each.span > 0.0}
    searched = named | {name: None for names in space.names for name in names if name in owners}  # those of rows without a range
    given = {"vary": searched} | given
    if isinstance(task, FunctionTask):  # the columns on which its quantity stands, that one shown first
        motion = found.machine.at(unreachable="nan", **{name: np.array(ends) for name, ends in run.items()})
        names = [column.name for column in results(found.machine, motion)]
        of = str(task.of.name) if isinstance(task.of, Quantity) and task.of.name else task.of
        given = ({"column": of} if of in names else {"columns": [of, *names], "column": words_of(of)}) | given
    else:
        given = {"trace": [task.of.split()[0]]} | given
    requests = PageRequests(best.machine, frame_count(count), at=run, over=found.problem.over, **given)
    live = live_text(best.machine.plan, requests.by_name, name="engine")
    data = page_data(requests, live)
    data["task"] = task_data(found, data)
    data["strokes"][data["task"]["stroke"]]["at"] = float(best.strokes[0])
    if "points" in data["task"]:
        data["scene"]["box"] = [*grown(data["scene"]["box"], np.array(data["task"]["points"]), 0.0)]
    return machine_text(requests, live, data, ("task.js",), language)


def task_data(found: Synthesis, data: PageData) -> PageData:
    """Return the task and the answers as the page's script reads them [SI]: of each design the values of the page's dimensions.

    The task is its wanted values: a point's places, angles with the length that weighs them, or a column's values.
    """
    task, best = found.task, found.best
    fit, plan = found.fit_of(best), best.machine.plan
    names, strokes = [each[0] for each in data["dims"]], [each["name"] for each in data["strokes"]]
    timed = fit.timing.width < fit.rows.count
    shown = [each for each in found.solutions if each.machine.plan is plan]
    designs = [[float(each.machine.dimensions[name]) for name in names] for each in shown]
    answers = [{"design": own, "at": each.strokes.tolist(), "rms": each.rms} for own, each in zip(designs, shown, strict=True)]
    kept = {"stroke": strokes.index(fit.timing.stroke), "timed": timed, "unit": unit_data(miss_unit(fit)), "answers": answers}
    points = list(plan.points)
    match task:
        case PathTask():
            return kept | {"points": task.points.tolist(), "point": points.index(task.of)}
        case PoseTask():
            first, second = (points.index(name) for name in task.of.split())
            places, long = np.stack([task.x, task.y], axis=1).tolist(), float(fit.rows.weights[-1])
            return kept | {"points": places, "angles": task.angle.tolist(), "point": first, "second": second, "long": long}
        case FunctionTask():
            return kept | {"values": task.values.tolist(), "column": data["column"], "turns": measure_of(plan, task.of) == "angle"}
