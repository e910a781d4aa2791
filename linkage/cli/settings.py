"""The meaning of commands' options: settings and strokes as text, load cases, columns by their names, exit codes."""

from __future__ import annotations

import re
from argparse import Namespace
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from inspect import signature
from typing import Any

import numpy as np

from ..errors import AssemblyError, DefinitionError, SingularError, ensure, known_name, unknown
from ..language import said, said_of
from ..loads import DIRECTIONS, OWN_LOADS, PLAIN, PLAIN_CASE, Acting, Case, LoadCase
from ..mechanism import Mechanism
from ..motion import Column, Motion, Over, Request, case_named, columns_of, out_of_reach, stroke_measure, stroke_unit
from ..plan import Plan, plan_measure
from ..program import FloatArray
from ..quantities import Dimension, Quantity, Stroke
from ..reports import NOTHING, At, Run, case_along, force_columns, motion_over, reached_motion, results, run_of, runs_of, stroke_middles
from ..reports.runs import stroke_grid
from ..steps import Point
from ..units import UNITS, display_unit, parse, parse_span, show
from ..verdict import Verdict
from .command import MOST, option, repeatable, say_remark
from .machines import Kind, design_of_file, find

FAILED = 1
"""The exit code of `--check` where a verdict fails."""


FORCES = (
    option("--case", metavar="CASE", help=f"the load case of this name; {PLAIN_CASE}: the loads as they are declared"),
    option("--direction", choices=DIRECTIONS, help="with the declared friction of this direction: of the stroke, or of each cylinder"),
    option("--drive", metavar="S", help="the stroke that moves, for friction where there are several"),
)
"""The options that choose the loads."""
CHECK = option("--check", action="store_true", help="leave with exit code 1 where a verdict fails")
OVER = repeatable(
    "--over",
    '"phi=15deg:80deg,t=0"',
    "where verdicts and largest values are looked for: a declared Over by its name, or strokes, two ends or one value of each; "
    "others run; repeatable (default: all declared ones, else the box of all strokes)",
)
ALONG = option("--over", metavar="NAME", help="along this Over that the machine declares, a path in time by its seconds")
LIMIT = repeatable(
    "--limit",
    '"pressure<=180bar"',
    "draw this limit of a column, COLUMN<=VALUE or COLUMN>=VALUE with its unit, the side that fails shaded; repeatable",
    "limits",
)


def machine_of(options: Namespace) -> Mechanism:
    """Return the machine that a command is on, with its settings; DefinitionError as `find` raises it."""
    own = getattr(options, "own", None)
    held = design_of_file(options.machine, own)
    if held is None:
        ensure(not own, f"--machine {own}: {options.machine} is no file of a design, with `machine` and `[set]`.")
        return design_from(find(options.machine), options.settings)
    changed = held.replaced(**parsed_settings(held, options.settings))
    return design_with(type(held), changed.dimensions) if options.settings else held  # made anew, as a class may have checks of its own


def overs_of(machine: Mechanism, texts: Sequence[str]) -> list[Over] | None:
    """Return where `--over` says that is looked, None where it is not given; DefinitionError for anything but an Over of the machine."""
    return [parsed_over(machine, text) for text in texts] or None


def parsed_over(machine: Mechanism, text: str) -> Over:
    """Return the `Over` of a text: a declared one by its name, or strokes such as `phi=15deg:80deg,t=0`."""
    declared, title = machine.plan.of_kind(Over), machine.plan.title
    if "=" not in text:
        if text.strip() in declared:
            return declared[text.strip()]
        example = f"{next(iter(machine.strokes), 'S')}=...:..."
        raise DefinitionError(f"--over {text}: {unknown('Over', text.strip(), declared, where=title)} Or name strokes, --over {example}.")
    strokes: dict[str, float | tuple[float, float]] = {}
    for part in text.split(","):
        name, given = pair(part, "--over", "phi=15deg:80deg,t=0")
        known_name("Stroke", name, machine.strokes, where=f"--over {text}")
        ensure(name not in strokes, f"--over {text}: {name} stands twice; give it two ends, {name}=LOW:HIGH.")
        low, *high = span_said(given, stroke_measure(machine.plan, name), f"--over {name}")
        strokes[name] = (low, high[0]) if high else low
    return Over(**strokes)  # type: ignore[arg-type]


def with_overs(machine: Mechanism, overs: Sequence[Over] | None) -> Mechanism:
    """Return the same design of a machine that runs only over the given places; itself without any."""
    if overs is None:
        return machine
    cls, own = type(machine), machine.plan.of_kind(Over)
    members: dict[str, Any] = {name: None for name, over in own.items() if over not in overs}
    fresh = [over for over in overs if not over.name]
    members |= {f"over_{number}": over for number, over in enumerate(fresh, 1)}
    variant: type[Mechanism] = type(cls.__name__, (cls,), {"__doc__": cls.__doc__, "__module__": cls.__module__, **members})
    return variant(**machine.dimensions)


def judged_over(machine: Mechanism, options: Namespace) -> list[Over | Motion] | None:
    """Return the places of a judgement: those of `--over`, else those that `--at` leaves open, else None, all that the machine runs."""
    chosen = overs_of(machine, options.over)
    if chosen or not options.strokes:
        return [*chosen] if chosen else None
    return [machine.at(unreachable="nan", **poses_at(machine, options, getattr(options, "count", None)))]


POSES = 21
"""Poses over a stroke of which a command does not say how many; of more than three strokes a grid has POSES**3 at most."""


def judged_code(verdicts: Sequence[Verdict], options: Namespace) -> int:
    """Return the exit code of a judgement: with `--check` 1 where a verdict fails.

    Rules that say nothing do not fail; they are named, with the reason.
    """
    if not options.check:
        return 0
    silent = [f"{each.heading}: {each.sentence}" for each in verdicts if each.is_rule and each.ok is None]
    if silent:
        say_remark(said_of(len(silent), "{n} rule says nothing. {rules}", "{n} rules say nothing. {rules}", rules=" ".join(silent)))
    return FAILED if any(each.ok is False for each in verdicts) else 0


def print_verdicts(verdicts: Sequence[Verdict], options: Namespace) -> int:
    """Print verdicts below a command's output, but not into CSV, and return the exit code."""
    if getattr(options, "csv", None) != "-":
        print("", *verdicts, sep="\n")
    return judged_code(verdicts, options)


def design_from(machine: type[Kind], texts: Sequence[str]) -> Kind:
    """Return a design of a machine under settings such as `OB=180mm`; DefinitionError for unknown or unfit ones."""
    return design_with(machine, parsed_settings(machine, texts))


def design_with(machine: type[Kind], given: Mapping[str, Any]) -> Kind:
    """Return a design of a machine with these dimensions; DefinitionError for unknown or unfit ones."""
    try:
        signature(machine.__init__).bind(None, **given)
    except TypeError as error:
        remedy = "a command gives only what --set says; write def __init__(self, **dimensions), or give its arguments defaults"
        raise DefinitionError(f"{machine.plan.title}.__init__: {error}; {remedy}.") from None
    return machine(**given)


def parsed_settings(machine: Mechanism | type[Mechanism], texts: Sequence[str]) -> dict[str, Any]:
    """Return the dimensions of a machine that settings such as `OB=180mm` say."""
    return dict(parsed_setting(machine.plan, text) for text in texts)


ODD = 50.0
"""A number without a unit that is so many times its default, or so small a part of it, but not in the unit that is shown, lacks that."""


def parsed_setting(plan: Plan, text: str) -> tuple[str, Any]:
    """Return a setting as a name and its SI value; a point's value is a pair."""
    name, value = pair(text, "--set", "OB=180mm")
    if name in plan.table.spellings:
        own = plan.table.spellings[name][0]
        kind, usual = plan_measure(plan, own), abs(plan.defaults.get(own, 0.0))
        found, unit = si_value(value, kind, f"--set {name}"), display_unit(kind, "mm" if kind == "length" else "")
        if unit and usual and not has_unit(value):
            is_odd, is_odd_so = (not 1.0 / ODD < abs(each) / usual < ODD for each in (found, parse(value + unit)))
            meant = f"{show(abs(found), unit)} in SI, where {plan.title} has {show(usual, unit)}"
            ensure(is_odd_so or not is_odd, f"--set {text}: without a unit this is {meant}; write the unit, such as --set {text}{unit}.")
        return name, found
    if f"{name}.x" in plan.table.spellings or f"{name}.y" in plan.table.spellings:
        parts = value.split(",")
        example = f"{name}=0.22,950mm; decimals are written with a point"
        ensure(len(parts) == 2, f"--set {name}={value}: a point takes two coordinates, such as {example}.")
        return name, tuple(si_value(part, "length", f"--set {name}") for part in parts)
    ensure(name not in plan.strokes, f"--set {text}: {name} is a stroke of {plan.title}, not a dimension; `table` takes --at {text}.")
    plan.table.settings({name: 0.0})
    raise unknown("Dimension", name, plan.table.names(), where=plan.title)


def pair(text: str, option: str, example: str) -> tuple[str, str]:
    """Return both sides of `name=value`."""
    name, equals, value = (part.strip() for part in text.partition("="))
    ensure(equals and name and value, f"{option} {text}: write a name and a value, such as {option} {example}.")
    return name, value


def si_value(text: str, kind: str, what: str, units: str = "") -> float:
    """Return the SI value of a text that measures `kind`; `units` are examples of those without which a number alone is refused."""
    try:
        value = parse(text, kind)
    except DefinitionError as error:
        raise DefinitionError(f"{what}: {error}") from None
    ensure(not units or has_unit(text), f"{what} {text}: say the unit too, such as {units}.")
    return value


def has_unit(text: str) -> bool:
    """Return whether a number or several in a text have a unit, which may end in a figure: `200 kgf/cm2`."""
    return any(map(str.isalpha, re.sub("[eE]", "", text)))


def span_said(text: str, kind: str, what: str) -> tuple[float, ...]:
    """Return the SI value of a text, or both ends of one such as `15:80deg`, whose unit holds for the first end too."""
    ends = [end.strip() for end in text.split(":")]
    if len(ends) == 1:
        return (si_value(text, kind, what),)
    span = parse_span(" to ".join(ends), kind) if len(ends) == 2 and all(ends) else None
    if span is None or len(span) != 2:
        example = f"{what.split()[-1]}={'0:300mm' if kind == 'length' else '15deg:80deg'}"
        raise DefinitionError(f"{what}={text}: one value or two ends are expected, such as {example}.")
    return span


def slow_overs(machine: Mechanism, options: Namespace) -> list[str]:
    """Return the `Over`s that are not in time, where a direction is asked for, others are, and nothing says where; a remark names those."""
    is_directed = Acting(direction=getattr(options, "direction", None)).is_moving and not (options.over or options.strokes)
    places = machine.judge().places if is_directed else ()
    timed, slow = ([each.over.name for each in places if (each.instants is not None) is way] for way in (True, False))
    if timed and slow:
        say_remark(f"--direction {options.direction}: {', '.join(timed)} is left out, as it runs in time, one way.")
    return slow if timed else []


def motions_at(machine: Mechanism, options: Namespace) -> list[tuple[Run | None, Motion]]:
    """Return the motions that a table shows, each with its run. At strokes such as `--at S=0.6,650mm` there is none.

    The runs are those of `--over`, of the machine's own `Over`s or of its first stroke (`runs_of`), at `--count` poses, or at steps of
    `--every`. At strokes the first that is not given goes from its start to its end, the others are at mid-stroke; several that are given
    more than one value make a grid. Places that cannot be assembled are gaps, and one remark says so.
    """
    given, every = strokes_given(machine, options), getattr(options, "every", None)
    options.over = slow_overs(machine, options) or options.over
    if machine.strokes and not given:
        overs = overs_of(machine, getattr(options, "over", ()))
        runs = runs_of(machine, over=overs, acting=acting_of(machine, options) if hasattr(options, "drive") else None)
        single = all(len(run.ways) == 1 and run.is_curve and not run.is_path for run in runs)
        if single:
            steps = [{run.stroke: stroke_steps(machine, run, options.count, every)} for run in runs]
            motions = [with_gaps(machine, {**run.held, **values}) for run, values in zip(runs, steps, strict=True)]
        else:
            name, stroke = next(iter(machine.strokes.items()))
            remedy = f"give --count, or run one stroke, such as --over {name}={stroke.start:.4g}:{stroke.end:.4g}"
            ensure(every is None, f"--every {every}: steps are of one stroke, and the rows run along a path; {remedy}.")
            motions = [run_with_gaps(machine, run, options.count) for run in runs]
        if len(runs) > 1:
            runs = tuple(replace(run, title=run.title or each.over.words(each)) for run, each in zip(runs, motions, strict=True))
        return [*zip(runs, motions, strict=True)]
    free = next((name for name in machine.strokes if name not in given), None)
    if free is None or any(len(values) > 1 for values in given.values()):
        ensure(every is None, f"--every {every}: no stroke runs from end to end here; leave it out, or hold the others, --at S=0.6.")
    else:
        ends = machine.strokes[free].start, machine.strokes[free].end
        given[free] = stroke_steps(machine, Run({free: ends}, {}), options.count, every)
    held = {name: np.array([value]) for name, value in stroke_middles(machine).items() if name not in given}
    return [(None, with_gaps(machine, stroke_grid(machine, given | held)))]


def stroke_steps(machine: Mechanism, run: Run, count: int, every: str | None) -> FloatArray:
    """Return the values of the stroke of a run from end to end [m or rad]: so many, or a step apart, the end among them."""
    name, (start, end) = run.stroke, run.ways[run.stroke]
    if every is None:
        return np.linspace(start, end, count)
    step = si_value(every, stroke_measure(machine.plan, name), "--every")
    if not 0.0 < step < np.inf or abs(end - start) / step > MOST:
        raise DefinitionError(f"--every {every}: a step of {name} is expected, more than nothing, such as --every 25mm.")
    if step > abs(end - start):
        raise DefinitionError(f"--every {every}: this step is longer than the stroke {name}; write its unit, such as --every 25mm or 5deg.")
    values = start + np.copysign(step, end - start) * np.arange(int(abs(end - start) / step + 1e-9) + 1)
    return values if abs(values[-1] - end) < 1e-6 * step else np.append(values, end)


def poses_at(machine: Mechanism, options: Namespace, count: int | None = None) -> dict[str, FloatArray]:
    """Return the strokes of all that `--at` leaves open, arrays of one shape: strokes not given go over their ranges."""
    given = strokes_given(machine, options)
    free = {name: stroke for name, stroke in machine.strokes.items() if name not in given}
    count = count or int(POSES ** (3 / max(3, len(free))))
    return stroke_grid(machine, given | {name: np.linspace(stroke.start, stroke.end, count) for name, stroke in free.items()})


def with_gaps(machine: Mechanism, strokes: At) -> Motion:
    """Return the motion at strokes, NaN where it cannot be assembled; one remark has the place, the missing length and the remedy.

    Raises AssemblyError where nothing can be assembled, SingularError at a change point.
    """
    try:
        return machine.at(**strokes)
    except SingularError:
        raise
    except AssemblyError as error:
        motion = machine.at(unreachable="nan", **strokes)
        if not motion.reached.any():
            raise
        tell_gaps(motion, error)
        return motion


def run_with_gaps(machine: Mechanism, run: Run, count: int) -> Motion:
    """Return the poses of a run, so many or a few more along its way; with gaps, of which one remark tells."""
    if run.instants is None:
        return with_gaps(machine, run.divided(count) if run.is_curve else run.poses)
    motion = reached_motion(machine, motion_over(machine, run, np.linspace(0.0, 1.0, count)))
    tell_gaps(motion)
    return motion


def tell_gaps(motion: Motion, error: AssemblyError | None = None) -> None:
    """Print in one remark where a motion cannot be assembled, the missing length and the remedy; `error` has the words, if given."""
    if error is not None or not motion.reached.all():
        gaps = "" if motion.reached.all() else said("What cannot be assembled is left empty.")
        say_remark(f"{error or out_of_reach(motion)} {gaps}")


def strokes_or_motion(machine: Mechanism, options: Namespace) -> At | Motion:
    """Return the strokes that `--at` gives, or the motion over the places of `--over`, with gaps."""
    given = strokes_given(machine, options)
    if options.over is None:
        return given
    ensure(not given, f"--over {options.over} says where all strokes are; leave out --at.")
    over = parsed_over(machine, options.over)
    motion = machine.sweep(None if over.shape == "poses" else options.count, over=over, unreachable="nan")
    tell_gaps(motion)
    return motion


def motion_along(machine: Mechanism, count: int, at: At | Motion = NOTHING) -> tuple[Motion, Case]:
    """Return the motion along one stroke or several together, the others held as `at` says, else in their middle, and its load case.

    It has gaps.
    """
    if isinstance(at, Motion):
        return at, case_along(at)
    run = run_of(machine, at)
    if run.instants is not None:
        return run_with_gaps(machine, run, count), run.case
    return with_gaps(machine, run.over(np.linspace(0.0, 1.0, count))), run.case


def strokes_given(machine: Mechanism, options: Namespace) -> dict[str, FloatArray]:
    """Return the strokes that `--at` gives, each an array of values, shape (n,) [m or rad]."""
    found, plan = {}, machine.plan
    for text in (each for given in options.strokes for each in re.split(r",(?=[^,]*=)", given)):  # `S=50mm,W=0` as for `--over`
        name, values = pair(text, "--at", "S=0.6,650mm")
        known_name("Stroke", name, plan.strokes, where=plan.title)
        found[name] = np.array([si_value(value, stroke_measure(plan, name), f"--at {name}") for value in values.split(",")])
    return found


# -- columns -----------------------------------------------------------------------------------------------


def acting_of(machine: Mechanism, options: Namespace) -> Acting:
    """Return the load case and the direction that options mean; DefinitionError for a case or a drive that is not there.

    In a judgement a case or a direction that is not given means all that occur.
    """
    title, cases = machine.plan.title, machine.plan.of_kind(LoadCase)
    case = PLAIN_CASE if options.case == OWN_LOADS else options.case
    if case not in (None, PLAIN_CASE):
        remedy = f" {title} declares none; write {case} = LoadCase({case!r}, scale=...)."
        ensure(cases, f"{unknown('Load case', case, [PLAIN_CASE], where=title)}{remedy}")
        case = case_named(machine.plan, case)
    if options.drive is not None:
        known_name("Stroke", options.drive, machine.strokes, where=title)
    return Acting(case=case, direction=options.direction, drive=options.drive)


def plain_value(acting: Acting) -> Acting:
    """Return the situation of values at poses: where no load case is named, or the plain one, the machine's own loads."""
    return replace(acting, case=None) if acting.case == PLAIN_CASE else acting


def columns_picked(
    machine: Mechanism, motion: Motion, names: Sequence[str], strokes: Sequence[str], acting: Acting = PLAIN, run_case: Case = None
) -> list[Column]:
    """Return the columns of some names, in their order, after the strokes'; all where none is named.

    A name is one of the machine's table, one that every machine with loads has, or a request in text: `pressure(lift)`, `ratio(G.y)`.
    In a load case or a direction that is asked for they are those that every machine has; else, in the case of the run, all.
    """
    plan, is_plain = machine.plan, acting == PLAIN
    acting = replace(acting, case=run_case) if acting.case is None else acting
    if is_plain:
        columns = results(machine, motion, acting.case or PLAIN_CASE)
    else:
        columns = [*columns_of(motion), *force_columns(motion, acting.case, acting.direction)]
    known = {column.name: column for column in columns}
    ensure(known, f"{plan.title} has no results: it declares no stroke, no point that moves and no output.")
    if not names:
        return columns
    if is_plain and not known.keys() >= {*names}:
        every = [*columns_of(motion), *force_columns(motion, acting.case, acting.direction)]
        known = {column.name: column for column in every} | known
    led = [known[name] for name in (*([] if motion.time is None else [said("time")]), *strokes) if name in known]
    found = [column for name in names for column in ([known[name]] if name in known else requested(machine, motion, name, acting, known))]
    return list({column.name: column for column in [*led, *found]}.values())


def requested(machine: Mechanism, motion: Motion, text: str, acting: Acting, known: Mapping[str, Column]) -> list[Column]:
    """Return the columns of a request in text, two of a point's; DefinitionError for anything else."""
    plan = machine.plan
    if not any(sign in text for sign in "()+-*/"):
        is_point = f" {text} is a point; `draw --path {text}` draws its path." if text in plan.points else ""
        raise DefinitionError(f"{unknown('Column', text, known, where=f'the table of {plan.title}')}{is_point}")
    from ..files.expression import quantity_said

    found = quantity_said(text, machine)
    is_of_forces = isinstance(found, Request) and bool(found.movements(plan, True))
    if isinstance(found, Request):
        found = found.under(acting, keep=True)
    over = motion._with_gaps() if is_of_forces else motion
    if over[found].shape == over.shape:
        return [Column.of(over, found, name=text)]
    return [Column(f"{text}_{axis}", part) for axis, part in zip("xy", over[found], strict=True)]


PER = {("angle", "m"): "rad/m"}
"""The unit of a ratio by what it measures and the unit of its stroke; plain numbers, and m for a turn of 1 rad, have none."""


def ratio_columns(machine: Mechanism, motion: Motion, targets: Sequence[str], wrt: str | None) -> Iterator[Column]:
    """Yield the derivatives of points and outputs by a stroke, by each of them where none is named: `dG_y/dS`."""
    plan = machine.plan
    if wrt is not None:
        known_name("Stroke", wrt, plan.strokes, where=plan.title)
    for target in targets:
        member = plan.members.get(target)
        if not isinstance(member, (Point, Quantity)):
            outputs = [name for name, each in plan.of_kind(Quantity).items() if not isinstance(each, (Stroke, Dimension))]
            raise unknown("Point or output", target, [*plan.moving, *outputs], where=plan.title)
        parts = [f"{target}_x", f"{target}_y"] if isinstance(member, Point) else [target]
        kind = member.measures if isinstance(member, Quantity) else "length"
        for stroke in [wrt] if wrt is not None else plan.strokes:
            values = np.reshape(motion.ratio(target, wrt=stroke), (len(parts), *motion.shape))
            unit = PER.get((kind, stroke_unit(plan, stroke)), "")
            yield from (Column(f"d{name}/d{stroke}", value, unit) for name, value in zip(parts, values, strict=True))


LIMITS = {"<=": ("above", "at most"), ">=": ("below", "at least")}


def parse_limit(text: str, columns: Sequence[Column]) -> tuple[str, tuple[float, str, str]]:
    """Return a column's name and its limit as `plot` takes it: the value [SI], words, and the side that fails."""
    name, sign, value = (part.strip() for part in re.fullmatch(r"(.*?)(<=|>=|$)(.*)", text, re.DOTALL).groups())  # type: ignore[union-attr]
    ensure(name and sign and value, f'--limit {text}: write a column, <= or >=, and a value, such as --limit "pressure<=180bar".')
    units = {column.name: column.unit for column in columns}
    unit = units[known_name("Column", name, units, "--limit")]
    side, words = LIMITS[sign]
    limit = si_value(value, UNITS[unit][1] if unit else "", f"--limit {name}")
    ensure(unit or not has_unit(value), f"--limit {name}: {value!r} has a unit, and the column has none; give a number alone.")
    return name, (limit, f"{words} {value}", side)
