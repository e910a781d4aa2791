"""A live page: a mechanism that moves and changes in a browser, in one file without network access; a load chart; a synthesis's answers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..disk import check_place, replacing_text
from ..errors import DefinitionError, StudyError, ensure
from ..language import heading_of, language
from ..mechanism import Mechanism, played_along, require_mechanism
from ..motion import Column, Motion, RequestLike, live_text, stroke_display_unit
from ..motion.measures import measure_of, words_of
from ..quantities import Quantity
from ..reports import NOTHING, At, results
from ..study import WorkingField
from ..synthesis import FunctionTask, PathTask, PoseTask, Synthesis
from ..synthesis.synthesis import miss_unit
from ..units import factor, shown_in, unit_sign
from .chart_text import ChartText
from .layout import grown
from .page_data import PageRequests, cylinder_data, machine_text, page_data, scene_data, signs, unit_data
from .page_file import LANGUAGES, PageData, page_place, page_text
from .scene import Scene
from .shown_values import unit_typeset
from .strokes import frame_count

COUNT = 101
"""Poses of the curve."""


def page(
    machine: Mechanism | Motion | WorkingField | Synthesis,
    path: str | Path,
    *,
    vary: Sequence[str] | Mapping[str, Sequence[float] | None] | None = None,
    columns: Sequence[Column | RequestLike] | None = None,
    column: str | None = None,
    trace: Sequence[str] | None = None,
    limit: Sequence[object] | Mapping[str, Sequence[object]] | None = None,
    at: Mapping[str, object] = NOTHING,
    count: int = 101,
    language: str = "en",
) -> Path:
    """Return the path of the live page it wrote, .html: one file without network access, in which the mechanism moves and changes.

    Every stroke has a slider, and so have the dimensions of `vary`: `["OB", "CD"]`, or with their ranges [SI], `{"OB": (0.28, 0.34)}`. Of a
    point "M" both coordinates have one. Without `vary` these are the sizes that move the first curve most. All others can be added,
    and pins can be dragged. Everything is worked out anew in the browser by the machine's own program. A value goes only as far as
    the mechanism can be assembled, and the page says which step is how much short.

    `columns` are what its chooser offers, names of columns or requests such as `capacity("lift", "G")`, by default the table of
    results; `column` is shown first, else what the machine is about. A column that no program gives is shown for the delivered design
    alone, with the reason. `limit` is the limit of that column, `(value [SI], text, "above" or "below")`, or limits by column. `trace`
    names points whose paths are drawn, `at=dict(tilt=0.1)` holds another stroke, `at=dict(S=(0.1, 0.2))` says where one runs [m or rad],
    `count` is the number of poses of the curve. The page speaks English and Russian, `language` is the one it begins with.

    Several strokes that run together, `at=dict(lift=[...], dump=[...])`, are a path with places from 1 on, straight in the strokes between
    two of them. It has a slider, and the curve is drawn over it. A stroke that is moved by its own slider leaves it. Of a motion along one
    path, `machine.follow(...)`, that is its page: the curves and the verdicts are along it. Of one that is not reached everywhere they are
    along the longest part that is.

    Of a working field it is the load chart as it is printed. The machine stands beside it in the pose of the cell that is pointed at, by
    the mouse, a finger or the arrow keys. All that the cell says stands there too: the load, what limits it, what each limiter leaves, the
    strokes, or why it is out of reach. Only `language` goes with it.

    Of what a synthesis found it is the page of the best machine, with the task on the sheet or on the curve and what is missed of it,
    worked out anew as dimensions change. The other answers of its class can be chosen, and the sliders are what was searched.

    Raises DefinitionError for a batch of designs, an unknown name, or a file that does not end in .html, FileError for a path that cannot
    be written.

    Parameters
    ----------
    machine : Mechanism, Motion, WorkingField or Synthesis
        The object to show.
    path : str or Path
        The file, .html.
    vary : sequence or mapping, optional
        The dimensions with a slider, or their ranges [SI].
    columns : sequence, optional
        The columns shown; by default the table of results.
    column : str, optional
        The column shown first.
    trace : sequence of str, optional
        The points whose paths are drawn.
    limit : sequence or mapping, optional
        Its limit, `(value [SI], text, "above" or "below")`, or limits by column.
    at : mapping
        Strokes to hold, or to run between values, by name [m or rad].
    count : int
        The number of poses.
    language : str
        "en" or "ru", with which it begins.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    DefinitionError
        A batch of designs, an unknown name, another ending.
    FileError
        The path cannot be written.
    """
    if not isinstance(machine, (Motion, WorkingField, Synthesis)):
        require_mechanism(machine)
    target = page_place(path)
    given: dict[str, Any] = {"vary": vary, "columns": columns, "column": column, "trace": trace, "limit": limit}
    if isinstance(machine, WorkingField):
        if any(each is not None for each in given.values()) or at or count != COUNT:
            raise DefinitionError(f"{machine.machine.plan.title}: the page of a working field has its cells; only language= goes with it.")
        check_place(target)
        text = chart_page(machine, language)
    else:
        check_place(target)
        text = page_html(machine, count=count, language=language, at=at, **given)
    with replacing_text(target) as stream:
        stream.write(text)
    return target


def page_html(machine: Mechanism | Motion | Synthesis, *, count: int = COUNT, language: str = "en", at: At = NOTHING, **given: Any) -> str:
    """Return the HTML of a live page; `given` are the other arguments of `page`."""
    if isinstance(machine, Synthesis):
        return task_page(machine, count=count, language=language, at=at, **given)
    if isinstance(machine, Motion):
        machine, given["along"] = played_along(machine, at)
    require_mechanism(machine)
    requests = PageRequests(machine, frame_count(count), at=at, **given)
    live = live_text(machine.plan, requests.by_name, name="engine")
    return machine_text(requests, live, page_data(requests, live), (), language)


Kind = TypeVar("Kind", bound=np.generic)
PARTS = ("chart.html", "page.css", "chart.css", "mechanism.js", "labels.js", "chart.js")
DIGITS = 10
"""The decimals of the places of points [m], and of the directions of tracks."""
NO_LIMIT = "\N{INFINITY}"
"""What stands for a load that nothing limits."""


def chart_page(field: WorkingField, begins: str) -> str:
    """Return the HTML of a working field's page, in the language that it begins with."""
    reached, pose_of = as_printed(field, field.reached), field.search.loads.motion_over
    strokes = {name: as_printed(field, values)[reached] for name, values in field.strokes.items()}
    if not reached.any():  # the pose of the sketch
        strokes = {name: np.array([value]) for name, value in field.machine.plan.sketch_strokes.items()}
    scene = Scene(pose_of(strokes))
    with language(begins):
        title = ChartText(field).title
    return page_text(title, chart_data(field, scene), PARTS, language=begins, most=max(scene.colours, default=0))


def as_printed(field: WorkingField, values: NDArray[Kind]) -> NDArray[Kind]:
    """Return the cells' values as the chart is printed, from above and ascending, shape (cells,)."""
    return values[np.ix_(np.argsort(-field.y, kind="stable"), np.argsort(field.x, kind="stable"))].ravel()


def chart_data(field: WorkingField, scene: Scene) -> PageData:
    """Return all that the page's script reads: cells as they are printed, lengths in m, angles in rad, loads in N."""
    text, plan, names = ChartText(field), field.machine.plan, list(dict.fromkeys((*field.of, *field.limiters)))
    units = {name: shown_in(stroke_display_unit(plan, name, "mm")) for name in field.strokes}
    known = as_printed(field, field.reached)
    # rows over all poses: x and y of each point [m], then each track's origin [m] and direction
    values = [scene.places[name] for name in plan.points]
    lines = {track.name: [2 * len(values) + 4 * k + row for row in range(4)] for k, track in enumerate(scene.tracks)}
    values += [each for track in scene.tracks for each in (track.origin, track.along)]
    drawn = scene_data(scene, lines)
    left, right, bottom, top = drawn["box"]
    drawn["box"] = [min(left, field.x.min()), max(right, field.x.max()), min(bottom, field.y.min()), max(top, field.y.max())]
    return {
        "x": np.sort(field.x).tolist(),
        "y": np.sort(field.y)[::-1].tolist(),
        "load": [number_or_none(each) for each in as_printed(field, field.load).tolist()],
        "limiter": [names.index(each) for each in as_printed(field, field.limiter).tolist()],
        "of": {names.index(name): [number_or_none(each) for each in as_printed(field, of).tolist()] for name, of in field.of.items()},
        "letters": [text.letters.get(name, "") for name in names],
        "counts": [text.counts.get(name, 0) for name in names],
        "strokes": [
            {"name": name, "start": stroke.start, "end": stroke.end, "unit": unit_typeset(units[name]), "factor": factor(units[name])}
            | {"values": as_printed(field, field.strokes[name])[known].tolist()}
            for name, stroke in plan.strokes.items()
        ],
        "loads": {"factor": text.load_size, "digits": text.load_digits},
        "lengths": unit_data("m") | {"digits": text.length_digits},
        "said": {name: words_of_chart(field, names, name) for name in LANGUAGES},
        "signs": signs({*units.values(), shown_in("m")}),
        "rows": {"points": [[2 * k, 2 * k + 1] for k in range(len(plan.points))]},
        "values": np.round(np.concatenate(values), DIGITS).tolist(),
        "scene": drawn,
        "cylinders": cylinder_data(scene),
        "border": np.round(field.border.reshape(-1, 4), 4).tolist(),
    }


def number_or_none(load: float) -> float | str | None:
    """Return a load [N] as it goes into data: None where there is none."""
    return None if np.isnan(load) else NO_LIMIT if np.isinf(load) else load


def words_of_chart(field: WorkingField, names: list[str], name: str) -> PageData:
    """Return a chart's words in a language: of the chart, of its limiters, of each cell that is out of reach."""
    with language(name):
        spoken = replace(field, remarks=field.search.remarks(field.failing))
        text = ChartText(spoken)
        return {
            "title": text.title,
            "unit": unit_typeset(unit_sign(text.unit)),
            "across": text.axes[0],
            "down": text.axes[1],
            "limiters": [heading_of(each) for each in names],
            "terms": text.terms(),
            "why": as_printed(spoken, spoken.why).tolist(),
        }


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
