"""A live page: a mechanism that moves and changes in a browser, in one file without network access."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..disk import check_place, replacing_text
from ..errors import DefinitionError
from ..mechanism import Mechanism, played_along, require_mechanism
from ..motion import Column, Motion, RequestLike, live_text
from ..reports import NOTHING, At
from ..study import WorkingField
from ..synthesis import Synthesis
from .chart_page import chart_page
from .page_data import PageRequests, machine_text, page_data
from .page_file import page_place
from .strokes import frame_count
from .task_page import task_page

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
