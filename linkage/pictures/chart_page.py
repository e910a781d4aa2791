"""A load chart as a page: beside it the machine stands in the pose of the cell that is pointed at."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..language import heading_of, language
from ..motion import stroke_display_unit
from ..study import WorkingField
from ..units import factor, shown_in, unit_sign
from .chart_text import ChartText
from .page_data import cylinder_data, scene_data, signs
from .page_file import LANGUAGES, PageData, page_text
from .page_judge import unit_data
from .scene import Scene
from .shown_values import unit_typeset

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
