"""Data of a live page: its script's requests to the program, and a mechanism as plain data [SI]."""

from __future__ import annotations

import re
import sys
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from functools import cached_property, partial
from itertools import groupby, islice, permutations
from pathlib import Path
from typing import Any, cast

import numpy as np

from ..errors import LinkageError, cited, ensure, is_listed, known_name, require, require_type, unknown, unwarned
from ..language import heading_of, language, translated
from ..loads import PLAIN_CASE, Case, ForceElement, case_titles
from ..mechanism import Mechanism, verdicts_of
from ..motion import Answer, Column, HasVerdicts, Judge, LiveText, Motion, Tabled, case_named, speakers, stroke_display_unit
from ..motion.requests import NodeRequest, RequestLike, transmission
from ..plan import Plan, name_or_pins, opening, plan_measure, require_kind
from ..plan.members import FRAME
from ..plugins import MACHINES, entry_points
from ..program import FloatArray, Node
from ..quantities import is_number, joined_names, name_of, needs
from ..reports import LiveColumn, column_requests, friction_of_columns, is_changing, request_in_case, results
from ..reports.runs import NOTHING, At, motion_over, reached_motion, run_along, run_of
from ..statics import held_fault
from ..units import SYSTEMS, UNITS, deg, display_unit, factor, shown_in, unit_system, units_shown
from ..verdict import Verdict
from .layout import label_free, offsets, props
from .page_file import EVENTS, MACHINE, START, PageData, page_part, page_text, tight
from .page_forces import force_arrows, geared_remark, page_situations, situated_requests, situated_rows
from .page_judge import LiveQuestions, course_data, rule_key, share_used, unit_data
from .scene import DrawnMark, Plate, Scene, SlideTrack
from .shown_values import WHOLE, Limit, as_curve, check_poses, limit_of, named_points, typeset, unit_typeset
from .strokes import ends_where_begun, is_turn

FONT = 14.0
ACROSS = 720.0
"""The size of the letters and the width of the sheet for which names are placed [px]."""
SHOWN = 6
"""How many dimensions a page shows at first."""
OF_BROKEN = 2
"""How many of these move most what one rule asks that is not kept."""
STEPS = ("length", "angle")
Limits = dict[str, Limit]
ALONG = "along the path"
"""What the place on a path is called among the strokes; no stroke can be called so."""
SYSTEM_NAMES = {"si": "SI", "bar-mm": "bar, mm", "kgf": "kgf", "us": "US"}
"""What the systems of units are called on a page."""
ROUND = 1e-9
"""A path whose strokes end so near to where they began, of what they pass, goes round."""


def track_number(track: SlideTrack, part: str, axis: str) -> NodeRequest:
    """Return the request for a number of a track's line: the x or y of its origin [m] or of its direction."""

    def nodes(plan: Plan) -> tuple[Node, ...]:
        reading = plan.trace.view()
        return (reading.graph.node(getattr(getattr(track.line(reading), part), axis)),)

    def names(plan: Plan) -> set[str]:
        return set[str]().union(*map(plan.reaches, track.riders))

    return NodeRequest(text=f"the {part} of {track.name}", key=("track", track.name, part, axis), nodes_of=nodes, names_of=names)


class PageRequests:
    """The contents of a machine's page, and its requests to the program, by names of its own."""

    def __init__(
        self,
        machine: Mechanism,
        count: int,
        *,
        vary: Any = None,
        columns: Sequence[Column | RequestLike] | None = None,
        column: str | None = None,
        trace: Sequence[str] | None = None,
        limit: Any = None,
        at: At = NOTHING,
        along: Motion | None = None,
        over: Mapping[str, Any] | None = None,
    ) -> None:
        self.machine, self.plan, self.along, self.over = machine, machine.plan, along, over
        self.run, self.first = (run_of(machine, at), 0) if along is None else run_along(along)
        run = self.run
        self.ends = run.ways[run.stroke]
        evenly = {**self.run.held, self.run.stroke: np.linspace(self.ends[0], self.ends[-1], count)}
        timed = None if run.instants is None else motion_over(machine, run, np.linspace(0.0, 1.0, count))
        self.motion = reached_motion(machine, timed or (run.divided(count) if run.is_path else evenly))
        self.count = self.motion.shape[0]
        self.scene = Scene(self.motion)
        self.judge = machine.judge(along if over is None else over)
        self.situations, self.situation_of = page_situations(machine, self.judge, self.run)
        self.arrows = force_arrows(machine, self.motion, self.situations)
        with language("en"):  # what is said otherwise in Russian is asked for apart
            self.featured = machine.featured()
        self.trace = named_points(machine, list(self.featured.path) if trace is None else trace, "trace")
        self.vary = ranges_given(machine, vary)
        with unwarned():
            self.results = chosen_columns(machine, self.motion, columns, self.run.case)
        if self.motion.time is not None:  # the instants are what all is over
            self.results.pop("time", None)
        self.curves = {name: as_curve(each) for name, (each, _, _) in self.results.items()}
        self.columns = {}
        for name, (result, request, why) in self.results.items():
            curve: Column = self.curves[name][0]
            is_same, asked = curve is result, cast(Any, request)
            self.columns[name if is_same else curve.name] = curve, request if is_same or why else WHOLE / asked, why
        self.column = self._column(column)
        self.judged, self.limits = self._limits(limit)
        self.questions = LiveQuestions(machine, self.judge, self.judged, self.columns)
        self.by_name: dict[str, RequestLike] = {}
        self._ask()

    @cached_property
    def english_verdicts(self) -> tuple[list[tuple[int, str, str]], list[Verdict] | None, set[str]]:
        """The verdicts in English, as `verdicts_told` has them, and the units that their sentences show."""
        with units_shown() as shown_units:
            rows, verdicts = verdicts_told("en", self.machine, self.judge, self.along)
        return rows, verdicts, shown_units

    def _column(self, name: str | None) -> str:
        """Return the column shown first: the one named, the one the machine is about, the last of the cylinder whose verdict is worst."""
        if name is None and self.featured.column in self.columns:
            return self.featured.column
        if name is not None:
            known_name("Column", name, [*self.results, *self.columns], where=self.plan.title)
            return name if name in self.columns else self.curves[name][0].name
        strokes = self.machine.strokes
        moving = [each for each, (column, _, why) in self.columns.items() if each not in strokes and is_changing(column.drawn)]
        alive = [each for each in moving if not self.columns[each][2]]
        shown = alive or moving or list(self.columns)
        _, told, _ = self.english_verdicts
        facts = [(each.ok is False, fact_data(self, each)) for each in told or () if each.member]
        ranked = sorted(facts, key=lambda fact: (fact[0], *fact[1][3:]), reverse=True)  # as the list on the page has them
        members = ({member, *needs(self.plan.members[member])} for _, (member, *_) in ranked)
        own = ([each for each in shown if among & {*re.findall(r"[\w.]+", each)}] for among in members)
        return next(filter(None, own), shown)[-1]

    def _limits(self, limit: Any) -> tuple[Limits, Limits]:
        """Return the limits by column: those that are judged, and all that are drawn."""
        given = dict(limit) if isinstance(limit, Mapping) else {} if limit is None else {self.column: limit}
        for name in given:
            known_name("Column", name, [*self.results, *self.columns], where=f"{self.plan.title}: limit")
        known = {name: each for name, each in self.featured.limits.items() if name in self.results}
        judged, drawn = Limits(), {curve.name: limit_of(bound) for curve, bound in self.curves.values() if bound is not None}
        for name, each in (known | given).items():
            column, bound = as_curve(self.results[name][0], each) if name in self.results else (self.columns[name][0], each)
            judged[column.name if name not in self.columns else name] = limit_of(bound or each, column.unit)
        return judged, drawn | judged

    @cached_property
    def columns_delivered(self) -> dict[int, dict[str, Column]]:
        """The columns by name, by the numbers of situations beside that of the run: of paths in time at even instants."""
        found = dict[int, dict[str, Column]]()
        for number, each in enumerate(self.situations):
            motion, instants = self.motion, each.motion._instants if each.motion is not None else None
            if each.motion is not None and instants is not None:
                shown = instants.shares(np.linspace(0.0, 1.0, self.count))
                motion = Motion(self.plan, self.machine.dimensions, shown.strokes, "nan", over=each.motion.over, instants=shown)
            if number and (instants is not None or self.motion.time is None):
                with unwarned():
                    columns = [as_curve(one)[0] for one in results(self.machine, motion, each.case or PLAIN_CASE)]
                found[number] = {column.name: column for column in columns}
        return found

    def _ask(self) -> None:
        """Note all that is asked of the program."""
        self.by_name |= self.questions.by_name
        for name in self.plan.points:
            self.by_name[f"point {name}"] = name
        for name, (_, request, why) in self.columns.items():
            if not why:
                self.by_name |= situated_requests(f"column {name}", request, self.situations)
        for track in self.scene.tracks:
            for k, (part, axis) in enumerate((part, axis) for part in ("origin", "direction") for axis in "xy"):
                self.by_name[f"track {track.name} {k}"] = track_number(track, part, axis)
        for name in self.motion._joints:
            self.by_name[f"joint {name}"] = transmission(name)
        is_loose = any(held_fault(self.motion, name_of(each.case or PLAIN_CASE)) for each in self.situations)  # then nothing has a pressure
        for name, member in {}.items() if is_loose else speakers(self.plan, Tabled).items():
            for what, request in member.gauges(self.plan).items():
                self.by_name |= situated_requests(f"gauge {name} {what}", request, self.situations) if what in GAUGES else {}
        for k, arrow in enumerate(self.arrows):
            for axis, asked in arrow.parts.items():
                self.by_name |= situated_requests(f"arrow {k} {axis}", asked, self.situations)


def ranges_given(machine: Mechanism, vary: Any) -> dict[str, tuple[float, float] | None] | None:
    """Return the dimensions chosen with their ranges [SI] where they are given; None where nothing is chosen."""
    if vary is None:
        return None
    expected = 'dimensions are expected, vary=["OB"] or vary=dict(OB=(0.28, 0.34))'
    require_type(f"{machine.plan.title}: vary", vary, (list, tuple, Mapping), expected)
    given = dict(vary) if isinstance(vary, Mapping) else dict.fromkeys(vary)
    found: dict[str, tuple[float, float] | None] = {}
    for name, ends in given.items():
        pair = [f"{name}.{axis}" for axis in "xy"]
        names = pair if isinstance(name, str) and set(pair) & set(machine.dimensions) else [name]
        for each in names:
            owner, sign = machine.plan.table.spellings.get(each, (None, 1)) if isinstance(each, str) else (None, 1)
            if owner is None:
                raise unknown("Dimension", str(each), machine.plan.table.names(), where=f"{machine.plan.title}: vary")
            found[owner] = None if ends is None else slider_ends(machine, owner, ends, sign)
    return found


def slider_ends(machine: Mechanism, name: str, ends: Any, sign: int) -> tuple[float, float]:
    """Return a range that has the design's own value in it; DefinitionError for anything else."""
    what = f"{machine.plan.title}: vary: {name}"
    is_range = is_listed(ends) and len(ends) == 2 and all(map(is_number, ends)) and ends[0] < ends[1]
    require(is_range, what, ends, "the least and the greatest value are expected, (0.28, 0.34)")
    require_kind(machine.plan, name, ends, what)
    is_length = machine.plan.table.entries[name].kind == "length"
    require(not is_length or ends[0] > 0.0, what, ends, "a length is above zero; give a least value that is")
    low, high = sorted(sign * float(end) for end in ends)
    value = float(machine.dimensions[name])
    said = f"{what}={cited(ends)} leaves out the design's own value, {sign * value:.6g}"
    ensure(low <= value <= high, f"{said}; give a range around it in SI, or set the dimension first.")
    return low, high


def chosen_columns(machine: Mechanism, motion: Motion, given: Any, case: Case) -> dict[str, LiveColumn]:
    """Return the columns of a page in a load case, by name. An empty reason says that its program follows it."""
    if given is None:
        return column_requests(machine, motion, case=case)
    is_list, expected = is_listed(given) and given, 'a list of columns is expected, such as ["tilt"]'
    require(is_list, f"{machine.plan.title}: columns", given, expected)
    own = column_requests(machine, motion, case=case) if any(isinstance(each, (str, Column)) for each in given) else {}
    found: dict[str, LiveColumn] = {}
    for each in given:
        match each:
            case str():
                found[each] = own[known_name("Column", each, own, where=machine.plan.title)]
            case Column():
                check_poses(each, motion)
                found[each.name] = own.get(each.name, (each, each.name, "its values were given, and not what asks for them"))
            case _:
                column = Column.of(motion, request_in_case(each, case))
                found[column.name] = column, each, ""
    return found


# -- the data ------------------------------------------------------------------------------------------------


def page_data(requests: PageRequests, live: LiveText) -> PageData:
    """Return all that the page's script reads, as plain data: lengths in m, angles in rad, forces in N."""
    machine, plan = requests.machine, requests.plan
    dims = dimension_data(requests, live)
    names = [each[0] for each in dims]
    columns = [column_data(name, column, live, requests) for name, (column, _, _) in requests.columns.items()]
    rows, index = {name: each[0] for name, each in live.rows.items()}, {name: place for place, name in enumerate(plan.points)}
    lines = {track.name: [rows[f"track {track.name} {k}"] for k in range(4)] for track in requests.scene.tracks}
    run, strokes, judge = requests.run, stroke_data(requests), requests.questions.data(live)
    motions = [each.motion for each in requests.situations]  # situations of one path in time, or at rest, have the first of them
    asked = [each[key]["unit"] for each in judge["questions"] for key in ("unit", "saysUnit") if key in each]
    depth = {index[name]: name.count(".") for name in plan.moving if name in index}
    with language("ru"):
        russian_title, titles = plan.heading, case_titles(plan)
        russian_cases = {title: translated(title) for title in titles.values()}
    cases = [case_named(plan, each.case) if each.case is not None else "" for each in requests.situations]
    return {
        "count": requests.count,
        "dims": dims,
        "shown": [names.index(name) for name in shown_first(requests, dims)],
        "strokes": strokes,
        "run": len(machine.strokes) if run.is_path else list(machine.strokes).index(run.stroke),
        "columns": columns,
        "column": list(requests.columns).index(requests.column),
        "cases": [titles.get(name, name) for name in cases],
        "casesRu": russian_cases,
        "situationOf": requests.situation_of,
        "timeOf": [motions.index(each) for each in motions],
        "limits": {typeset(name): limit_data(requests, name) for name in requests.limits},
        "rows": {"points": [[rows[f"point {name}"] + axis for axis in (0, 1)] for name in plan.points]},
        "scene": scene_data(requests.scene, lines),
        "cylinders": cylinder_data(requests.scene, live, len(requests.situations)),
        **unit_tables({*(each[3] for each in dims), *(str(each[1]) for each in columns), *asked, *(each["unit"] for each in strokes)}),
        "joints": [{"point": name, "row": rows[key]} for name in requests.motion._joints if (key := f"joint {name}") in rows],
        "arrows": [
            {"point": index[arrow.point], **parts, "on": arrow.on}
            | ({"by": "" if arrow.by == FRAME else arrow.by} if arrow.by else {"load": 1} if arrow.is_load else {})
            for k, arrow in enumerate(requests.arrows)
            for parts in [{axis: situated_rows(f"arrow {k} {axis}", live, len(requests.situations)) for axis in arrow.parts}]
            if None not in parts.values()
        ],
        "paths": [index[name] for name in requests.trace],
        "grips": grip_data(requests, names, index),
        # a joint of a part lies over what it carries
        "moving": sorted(depth, key=lambda place: (-depth[place], place)),
        "meets": meeting_data(plan, names, index),
        **named_in_code(type(machine)),
        "title": plan.heading,
        "titleRu": russian_title,
        "defaults": {name: plan.defaults[name] for name, value, *_ in dims if value != plan.defaults[name]},
        "beside": {name: value for name, value in machine.dimensions.items() if name not in names and value != plan.defaults[name]},
        "steps": {name: name_or_pins(plan, name) if each.companions else opening(plan, name) for name, each in plan.points.items()},
        "friction": bool(friction_of_columns(requests.motion, [column for column, _, _ in requests.columns.values()])),
        "geared": geared_remark(plan),
        **verdicts_shown(requests),
        "judge": judge,
    }


def named_in_code(kind: type[Mechanism]) -> PageData:
    """Return the name of a class in Python, "" for the module of one that no module has, and in commands."""
    module, name = kind.__module__, kind.__name__
    file = str(getattr(sys.modules.get(module), "__file__", None) or "")
    if getattr(sys.modules.get(module), name, None) is not kind:
        return {"class": name, "module": "", "machine": f"{name}.toml"}
    for key, entry in entry_points(MACHINES).items():
        if entry.attr == name and getattr(sys.modules.get(entry.module), name, None) is kind:
            return {"class": name, "module": entry.module, "machine": key}
    stem = Path(file).stem  # a module that was loaded from a file, or was started, has a name that cannot be imported
    short = stem if file and stem not in ("__init__", module.rpartition(".")[2]) else module
    return {"class": name, "module": short, "machine": f"{Path(file).name}:{name}" if file else f"{module}:{name}"}


def machine_text(requests: PageRequests, live: LiveText, data: PageData, parts: Sequence[str], language: str) -> str:
    """Return the HTML of a page of a machine, with the program that works it out and the parts that a kind of page adds."""
    most, text = max(requests.scene.colours, default=0), f"{live.text}\n{tight(page_part('judge.js'))}"
    if any(place.instants is not None for place in requests.questions.judge.places):
        text += tight(page_part("judge_time.js"))
    later = EVENTS if any("events" in each for each in data["strokes"]) else ()
    return page_text(requests.plan.heading, data, (*MACHINE, *parts, START, *later), language=language, most=most, text=text)


def unit_tables(used: set[str]) -> PageData:
    """Return the units of the page's script: the factors of all that measure what the used ones do, and their signs."""
    known = {*used, "bar", "mm", "kN", "kNm"}
    kinds = {measure for unit, (_, measure) in UNITS.items() if unit_typeset(unit) in known}
    return {
        "pressureUnit": unit_data("bar"),
        "length": unit_data("mm"),
        "force": unit_data("kN"),
        "moment": unit_data("kNm"),
        "signs": signs({*used, *map(shown_in, ("bar", "mm", "kN", "kNm"))}),
        "measures": {unit_typeset(unit): [factor(unit), measure] for unit, (_, measure) in UNITS.items() if measure in kinds},
        "systems": {name: {kind: unit_typeset(unit) for kind, unit in units.items() if kind in kinds} for name, units in SYSTEMS.items()},
        "systemNames": SYSTEM_NAMES,
    }


def signs(units: set[str]) -> dict[str, str]:
    """Return how units are written in Russian, those that are written otherwise."""
    plain = {unit_typeset(unit): unit for unit in UNITS}
    with language("ru"):
        found = {unit: unit_typeset(translated(plain.get(unit, unit))) for unit in sorted(units)}
    return {unit: sign for unit, sign in found.items() if sign != unit}


def dimension_data(requests: PageRequests, live: LiveText) -> list[list[Any]]:
    """Return the dimensions that anything on the page hangs on."""
    size = float(np.hypot(*np.diff(np.reshape(requests.scene.extent, (2, 2)), axis=1).ravel()))
    found, spellings = [], requests.plan.table.spellings
    sized = ((each.variable(name), each.sizes_made(name)) for each in requests.plan.of_kind(ForceElement).values() for name in each.numbers)
    made = {spellings[name][0]: sizes for name, sizes in sized if sizes and name in spellings}  # such as the bores of a standard
    for name in live.dimensions:
        entry, value = requests.plan.table.entries[name], float(requests.machine.dimensions[name])
        measure = plan_measure(requests.plan, name)
        unit = shown_in(entry.unit or display_unit(measure, "mm"))
        given = (requests.vary or {}).get(name)
        if entry.kind == "coordinate" or (measure == "length" and value == 0.0):  # how far its slider goes to either side [SI]
            reach = 0.15 * size
        elif measure == "angle":
            reach = 20 * deg
        else:
            reach = (0.25 if measure == "length" else 0.5) * abs(value) or factor(unit)
        ends = list(given) if given else [0.5 * value, 1.0] if entry.kind == "efficiency" else four_digits(reach)
        where = entry.where if entry.kind in STEPS else ""
        low, high = ends if isinstance(ends, list) else (value - ends, value + ends)
        sizes = [each for each in made.get(name, ()) if low / 1.3 <= each <= 2.0 * high]  # beyond its slider, too, as a remedy may be
        row = [name, value, ends, unit_typeset(unit), int(entry.kind == "length"), where, sizes]
        found.append(row[: 7 if sizes else 6 if where else 5])
    return found


def four_digits(value: float) -> float:
    """Return a number to four digits."""
    return float(f"{value:.4g}")


def shown_first(requests: PageRequests, dims: Sequence[Sequence[Any]]) -> list[str]:
    """Return the dimensions shown at first, by parts: those chosen, else those that move most what is not kept, and the featured result.

    Where these have no derivatives they are the first lengths and angles of steps.
    """
    names = [each[0] for each in dims]
    if requests.vary is not None:
        return [name for name in requests.vary if name in names]
    _, request, why = requests.columns[requests.column]
    ranges = {name: float(np.ptp(ends)) if isinstance(ends, list) else 2.0 * ends for name, _, ends, *_ in dims}
    judge, entries = requests.questions.judge, requests.plan.table.entries
    broken = (influences([there], asked, ranges) for there, asked in requests.questions.broken)
    found = {} if why else influences([place.sampled for place in judge.places], [request], ranges)

    def ranked(moving: Mapping[str, float]) -> list[str]:  # sizes before efficiencies and other plain numbers
        return sorted(moving, key=lambda name: not plan_measure(requests.plan, name))

    rest = ranked(found) or sorted(names, key=lambda name: entries[name].kind not in STEPS)
    first = islice((name for moving in broken for name in ranked(moving)[:OF_BROKEN]), SHOWN - OF_BROKEN)
    chosen = dict.fromkeys([*first, *rest])
    return sorted([*chosen][:SHOWN], key=lambda name: name.rpartition(".")[0])


MOVES_NOTHING = 1e-9
"""Of the greatest influence: a dimension that has no more moves nothing."""


def influences(motions: Sequence[Motion], requests: Sequence[RequestLike], ranges: Mapping[str, float]) -> dict[str, float]:
    """Return how far each dimension moves results at most over its slider [SI], the greatest first, those that move nothing left out.

    `ranges` is how far each slider goes [SI]. Nothing where a result has no derivatives.
    """
    names, found = list(ranges), np.zeros(len(ranges))
    for motion, request in ((motion, request) for motion in motions for request in requests):
        try:
            with unwarned():
                slopes = motion.gradient(request, names)
        except LinkageError:
            return {}
        found = np.maximum(found, np.abs(np.nan_to_num(slopes, posinf=0.0, neginf=0.0)).reshape(len(names), -1).max(axis=1))
    moved = found * np.array([*ranges.values()])
    order = np.argsort(-moved, kind="stable")
    return {names[k]: float(moved[k]) for k in order if moved[k] > MOVES_NOTHING * moved.max(initial=0.0)}


def stroke_data(requests: PageRequests) -> list[PageData]:
    """Return the strokes: their ranges, where they stand, their units, and whether they go round.

    A path is one more: the numbers of its places, and the values of the strokes that it drives, by their places; of one that the
    machine declares its name, and its place among the `Over`s.
    """
    run, found = requests.run, list[PageData]()
    names = list(requests.machine.strokes)
    for name, stroke in requests.machine.strokes.items():
        unit = shown_in(stroke_display_unit(requests.plan, name, "mm"))
        way = run.ways.get(name, (run.held.get(name, 0.0),))
        runs = name == run.stroke and not run.is_path
        start, end = (way[0], way[-1]) if runs else (stroke.start, stroke.end)
        turn = runs and is_turn(requests.machine, run) and bool(requests.motion.reached.all()) and ends_where_begun(requests.motion)
        data: PageData = {"name": name, "start": start, "end": end, "at": way[0], "unit": unit, "factor": factor(unit), "turn": int(turn)}
        reach = [min(start, end, stroke.start, stroke.end), max(start, end, stroke.start, stroke.end)]
        found.append(data | ({"reach": reach} if runs and not turn and reach != sorted((start, end)) else {}))
    if run.is_path:
        first, last = requests.first + 1, requests.first + len(requests.ends)
        turn = all(abs(way[-1] - way[0]) <= ROUND * np.ptp(way) for way in run.ways.values())
        path: dict[int, list[float]] = {names.index(name): list(way) for name, way in run.ways.items()}
        places = enumerate(requests.questions.judge.places if requests.along is None else ())
        own = [(k, each.over.name) for k, each in places if each.over.name and each.over.shape == "path" and each.over.name == run.title]
        name, over = (own[0][1], {"over": own[0][0]}) if own else (ALONG, {})
        place = {"name": name, "start": first, "end": last, "at": first, "unit": "", "factor": 1.0}
        if run.instants is not None:
            first, last = run.instants.breaks[[0, -1]].tolist()
            place |= {"name": name if own else "time", "start": first, "end": last, "at": first, "unit": "s"}
            events = event_data(getattr(requests.along, "events", ()))  # of a run of one pump
            place |= {"events": events} if events else {}
            over, turn, path = (over or {"over": 0}) | course_data(run.instants), True, {k: [] for k in range(len(names))}
        found.append(place | {"turn": int(turn), "path": path} | over)
    return found


def event_data(events: Sequence[Any]) -> list[list[object]]:
    """Return the events at each instant: the instant [s], and their sentences."""
    found = [[*group] for _, group in groupby(events, key=lambda event: event.time)]
    return [[group[0].time, "; ".join([str(group[0]), *(each.sentence for each in group[1:])])] for group in found]


def column_data(name: str, column: Column, live: LiveText, requests: PageRequests) -> list[Any]:
    """Return a column: its name, unit and row, -1 for none, its name in Russian; without a row its values.

    Where it differs between situations it has a row in each. Its values are by the numbers of situations that its program does not follow:
    over the run of the page in each load case, and over paths in time.
    """
    with language("ru"):
        russian = typeset(heading_of(name))
    shown, start = typeset(name), [typeset(name), unit_typeset(shown_in(column.unit))]
    count = len(requests.situations)
    places = situated_rows(f"column {name}", live, count)
    if isinstance(places, int) or (places and -1 not in places):
        return [*start, places, *([russian] if russian != shown else [])]
    lost = [k for k in range(count) if places is None or places[k] < 0]
    values = dict[int, list[float | None]]()
    for k in lost:
        given = requests.columns_delivered.get(k, {}).get(name) if k else column
        whole = [] if given is None else np.broadcast_to(np.asarray(given.values, float), (requests.count,)).tolist()
        values |= {k: [float(f"{value:.6g}") if np.isfinite(value) else None for value in whole]} if whole else {}
    return [*start, -1 if places is None else places, russian, values]


def limit_data(requests: PageRequests, name: str) -> list[Any]:
    """Return a column's limit [SI], its words, the side that fails, its words in Russian, and whether it is only drawn."""
    value, text, fails = requests.limits[name]
    plain = requests.featured.limits.get(name)
    with language("ru"):
        known, russian = requests.machine.featured().limits.get(name), translated(text)
    if plain is not None and known is not None and limit_of(plain).text == text:  # the machine has said it; a limit given says what it says
        russian = limit_of(known).text
    return [value, typeset(text), fails, typeset(russian), int(name not in requests.judged)]  # one that is drawn has a rule of verdicts


def grip_data(requests: PageRequests, names: Sequence[str], index: Mapping[str, int]) -> list[dict[str, int]]:
    """Return the pins on the ground that can be dragged, with their coordinates where these are the frame's.

    A part that is placed otherwise has axes of its own; `meeting_data` has the coordinates of its points.
    """
    found = []
    for name, (x, y) in coordinate_pairs(requests.plan, names).items():
        if name in requests.plan.moving:
            continue
        there = np.reshape(requests.motion[name], (2, -1))[:, requests.motion.reached.ravel()][:, 0]
        own = [requests.machine.dimensions[each] for each in (x, y)]
        places = {"x": names.index(x), "y": names.index(y)} if np.allclose(there, own, rtol=0.0, atol=1e-9) else {}
        found.append({"point": index[name]} | places)
    return found


def coordinate_pairs(plan: Plan, names: Sequence[str]) -> dict[str, tuple[str, str]]:
    """Return the points of which both coordinates are among the dimensions, with the names of these."""
    pairs = {name: (f"{name}.x", f"{name}.y") for name in plan.points}
    return {name: pair for name, pair in pairs.items() if set(pair) <= set(names)}


def meeting_data(plan: Plan, names: Sequence[str], index: Mapping[str, int]) -> dict[int, list[int]]:
    """Return, for every point that moves, which of the dimensions are lengths and angles of it, by their places.

    A point that a part fixes in axes of its own has its two coordinates there.
    """
    entries = plan.table.entries
    own = {name: place for place, name in enumerate(names) if entries[name].kind in STEPS}
    lengths = {joined_names(*pair): pair for pair in permutations(index, 2)}
    found: dict[int, list[int]] = defaultdict(list)
    for name, place in own.items():
        ends: Sequence[str] = lengths.get(name, ())
        if entries[name].kind == "angle":  # of three points, whose names it joins
            begun = [pair for word, pair in lengths.items() if name.startswith(word)]
            triples = ((*pair, last) for pair in begun for last in index if last not in pair)
            ends = next((each for each in triples if joined_names(*each) == name), ())
        for each in ends:
            if each in plan.moving:
                found[index[each]].append(place)
    for name, pair in coordinate_pairs(plan, names).items():
        found[index[name]] += [names.index(each) for each in pair]
    return dict(found)


def cylinder_data(scene: Scene, live: LiveText | None = None, count: int = 0) -> list[PageData]:
    """Return the cylinders: their ends, and the rows of a program's values in so many situations."""
    plan = scene.motion.plan
    points = list(plan.points)
    driven = {frozenset((bar.P, bar.Q)) for bar in plan.cylinders}
    members, found = speakers(plan, Tabled), []
    for each in scene.two_force:
        if each.drawn_as != "cylinder":
            continue
        gauges = {what: situated_rows(f"gauge {each.name} {what}", live, count) for what in GAUGES} if live is not None else {}
        gauges = {what: row for what, row in gauges.items() if row is not None}
        data = {"name": each.name, "P": points.index(each.P), "Q": points.index(each.Q), "aside": each.aside}
        data |= {} if scene._is_telescope(each) else {"drawn": 1}
        is_sized = live is not None and each.name in members and bool(SIZES & members[each.name].gauges(plan).keys())
        found.append(data | gauges | ({"sized": 1} if is_sized else {}) | ({} if {each.P, each.Q} in driven else {"beside": 1}))
    return found


GAUGES, SIZES = ("pressure", "most"), {"closed", "stroke"}
"""What is read of a cylinder, and of what it is known whether it is given; see `Tabled.gauges`."""


def scene_data(scene: Scene, lines: Mapping[str, Sequence[int]]) -> PageData:
    """Return the drawing as data, by the points' places in `names`; `lines` are the rows of each track's origin and direction."""
    names = list(scene.motion.plan.points)
    index = {name: place for place, name in enumerate(names)}
    forms = list(zip(scene.plates, scene.bodies, scene.colours, strict=True))
    ends = Counter(name.rpartition(".")[2] for name in scene.places)  # of a part's point its own name, where no other has that
    labels = {name: end for name in scene.places if "." in name and ends[end := name.rpartition(".")[2]] == 1} | scene.letters
    letters = {**labels, **dict.fromkeys(scene.inner, "")}
    poses, (left, right, bottom, top) = scene.some(9), scene.box()
    scale = min(ACROSS / (right - left), 0.7 * ACROSS / (top - bottom))
    spots = offsets(names, poses, label_free(scene, poses), scale, 1.15 * scene.size * scale + 2.0, FONT, letters=labels)
    return {
        "size": scene.size,
        "names": names,
        "box": [four_digits(side) for side in scene.box(0.0)],
        "bodies": [body_data(plate, points, index) | {"colour": colour} for plate, points, colour in forms],
        "tracks": [
            {"riders": [index[name] for name in track.riders], "fixed": track.fixed, "line": [*lines[track.name]]} for track in scene.tracks
        ],
        "contours": [mark_data(each, index) for each in (*scene.contours, *scene.sections)],
        "straights": [mark_data(each, index) for each in scene.straights],
        "around": [mark_data(each, index, 0.05 * scene.size) for each in scene.surroundings],
        "loads": [mark_data(each, index, 0.05 * scene.size) for each in scene.load_marks],
        "stays": [[index[P], index[X]] for P, X in scene.stays],
        "pins": [index[name] for name in scene.pins],
        "dots": [index[name] for name in scene.dots],
        "grounds": [{"point": index[name], "way": round(way, 4)} for name, way in props(scene).items()],
        "labels": [[round(float(spots[name][0]), 1), round(-float(spots[name][1]), 1)] for name in names],  # from their points [px]
    } | ({"letters": [letters.get(name, name) for name in names], "legend": scene.letter_legend} if letters else {})


def body_data(plate: Plate, points: Sequence[str], index: Mapping[str, int]) -> PageData:
    """Return a body: its points, of which it is the hull, or where it has another form its corners' shares of them."""
    if len(plate.shares) <= len(plate.points) and np.all((plate.shares == 0.0) | (plate.shares == 1.0)):
        return {"points": [index[name] for name in points]}
    return {
        "points": [index[name] for name in plate.points],
        "shares": [[four_digits(share) for share in row] for row in plate.shares.tolist()],
    }


def mark_data(mark: DrawnMark, index: Mapping[str, int], near: float = 0.0) -> PageData:
    """Return a mark: its points, and its lines as rows of ways along and across [m], and a share of the distance where they stretch.

    Of lines that keep their form points are left out that lie so near to the line of their neighbours [m]; `hatched` on their right.
    `slide` tells what moves in it [m]: the distance from which on it is out, and how far it comes out, least and most.
    """
    lines = []
    for line in mark.lines:
        share, slides = line.rows[:, :1], line.rows[:, 3:]
        keeps = not share.any() and not slides.any()
        rows = sparse(line.rows[:, 1:3], near) if keeps else np.column_stack([line.rows[:, 1:3], share, slides])
        flags = {"fill": line.fill.lower(), "closed": int(line.closed), "bold": int(line.bold)}
        lines.append({"rows": np.round(rows, 4).tolist()} | {name: flag for name, flag in flags.items() if flag})
    slide = {} if mark.cylinder is None else {"slide": [mark.cylinder.rod, mark.cylinder.least, mark.cylinder.most]}
    return {"on": [index[name] for name in mark.on], "lines": lines} | ({"hatched": 1} if len(mark.hatched) else {}) | slide


def sparse(rows: FloatArray, near: float) -> FloatArray:
    """Return a line's points without those that lie so near to the straight line of their neighbours [m] (Douglas and Peucker, 1973)."""
    if len(rows) < 3:
        return rows
    along = rows[-1] - rows[0]
    off = rows[1:-1] - rows[0]
    length = float(np.hypot(*along))
    gaps = np.abs(off[:, 0] * along[1] - off[:, 1] * along[0]) / length if length > near else np.hypot(*off.T)
    farthest = 1 + int(np.argmax(gaps))
    if gaps[farthest - 1] <= near:
        return rows[[0, -1]]
    return np.concatenate([sparse(rows[: farthest + 1], near)[:-1], sparse(rows[farthest:], near)])


MARKS = {True: 1, False: 0, None: 2}
"""How verdicts are told: those that are kept, those that are not, and what is only said."""


def verdicts_told(
    name: str, machine: Mechanism, judge: Judge, along: Motion | None
) -> tuple[list[tuple[int, str, str]], list[Verdict] | None]:
    """Return the machine's verdicts over all that a judge looks at in a language, for the design that is delivered, and themselves.

    Of each there is 1 where it is kept, 0 where it is not, 2 where it is only said, 3 where it says nothing; its heading and its sentence.
    Where verdicts are refused a row has the error's words, and instead of verdicts there is None.
    """
    with language(name), unwarned():
        try:
            found = verdicts_of(machine, judge, along)
        except LinkageError as error:
            return [(MARKS[None], "", str(error))], None
        return [(3 if each.is_rule and each.ok is None else MARKS[each.ok], each.heading, each.sentence) for each in found], found


def verdicts_shown(requests: PageRequests) -> PageData:
    """Return the verdicts of the page, and their words in each system of units, in English and Russian; 0 where they are as delivered.

    Of each verdict there is the member that says it and whether it is of poses, and how members are headed.
    """
    told = partial(verdicts_told, machine=requests.machine, judge=requests.judge, along=requests.along)
    machine, found = requests.machine, dict[str, list[Any]]()
    english, verdicts, shown_units = requests.english_verdicts
    russian, _ = told("ru")
    russian = russian if len(russian) == len(english) else english
    shown_units = shown_units | {"mm", *(stroke_display_unit(machine.plan, name, "mm") for name in machine.strokes)}  # told before
    for name in SYSTEMS:
        found[name] = [0] * len(english)
        with unit_system(name):
            others, _ = (english, None) if all(shown_in(unit) == unit for unit in shown_units) else told("en")
            if len(others) == len(english) and others != english:
                pairs = zip(others, told("ru")[0], english, russian, strict=True)
                sentences = (((other[2], new[2]), (en[2], ru[2])) for other, new, en, ru in pairs)
                found[name] = [0 if told_as == known else [*map(typeset, told_as)] for told_as, known in sentences]
    plain = [[*en[:2], typeset(en[2]), ru[1], typeset(ru[2])] for en, ru in zip(english, russian, strict=True)]
    shown: PageData = {"verdicts": plain, "verdictsIn": found}
    if verdicts is None:
        return shown | {"facts": [["", "", 0]], "groups": {}}
    members, groups = speakers(machine.plan, HasVerdicts), dict[str, list[str]]()
    for name in dict.fromkeys((*(each.member for each in verdicts if each.member), *members)):
        with language("ru"):
            headings = members[name].headed, translated(members[name].headed)
        groups[name] = [typeset(text.format(name=name)) for text in headings]
    return shown | {"facts": [fact_data(requests, each) for each in verdicts], "groups": groups}


def fact_data(requests: PageRequests, verdict: Verdict) -> list[Any]:
    """Return the member that says a verdict, its key, whether it is of poses, and how far its limit is used, where it tells.

    That is 1e6 where nothing bounds it, or where it is on the wrong side of its limit; of a limit of nothing there is no share.
    """
    found: list[Any] = [verdict.member, rule_key(verdict.rule, verdict.member)]
    if not isinstance(verdict.answer, Answer):
        return [*found, 0]
    words, _, share = share_used(requests.judge, verdict, verdict.answer)
    tells = (np.isfinite(share) or (verdict.ok is False and verdict.answer.limit != 0.0)) and (share > 0.0 or words.share is not None)
    return [*found, int(bool(verdict.answer.strokes)), *([min(max(float(f"{share:.7g}"), 0.0), 1e6)] if tells else [])]
