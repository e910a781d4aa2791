"""Studies as a file: a survey over a box, a zone, tolerances, the tornado of tolerances, and settings that meet targets.

machine = "three_point_hitch"

[survey]
count = 2048
vary = { OB = "270 to 330 mm", CD = "550 to 700 mm" }
measure = { travel = "at(G_y, S=250 mm) - at(G_y, S=0)", upright = "most(abs(tilt)) <= 18 deg" }

[tolerance]
of = ["tilt"]
tolerances = { OB = "0.1 mm", CD = "0.1 mm" }
subject_to = ["most(tilt) <= 17 deg"]
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import field
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import numpy as np

from ..errors import DefinitionError, LinkageError, cited, ensure, known_name, require, require_type, unknown
from ..frozen import immutable, record
from ..loads import Acting
from ..mechanism import Mechanism
from ..motion import Column, stroke_display_unit, stroke_measure
from ..motion.measures import At, Condition, Constraint, FixedNumber, Integral, Measure, in_case, measure_of
from ..motion.requests import situated
from ..plan import Plan
from ..program import FloatArray
from ..quantities import is_number
from ..study import Box, Target, monte_carlo, settings_for, survey, tornado, zone
from ..study.measured import measured_title
from ..study.monte_carlo import limits_listed
from ..study.optimum import unit_of_measure
from ..study.problem import NOWHERE, Problem, missed
from ..study.space import METHODS as SAMPLE_METHODS
from ..study.space import Around, coordinates, unit_of
from ..study.survey import Progress
from ..units import display_unit, parse_span, show
from . import study_file
from .expression import condition_said, criterion_of, measure_or_constant, measure_said, quantity_said
from .source import FileTable, Keywords, by_whole_names, each_of
from .study_file import FindMachine, Settings, StudyHead, amount_said

# -- what a survey measures: measures and conditions as text, of many designs at once -----------------------------

MET_TO_ROUNDING = 1e-12


@record
class TextMeasures:
    """The function that a survey measures with: measures and conditions by name, as text, at so many poses of a stroke.

    Extremes are those of the poses; of several strokes `poses` is for all of them together. A design that cannot be assembled over the
    whole stroke has no value, and keeps no condition.
    """

    texts: Mapping[str, str]
    poses: int
    over: FileTable = field(default_factory=dict)

    def __call__(self, machine: Mechanism) -> Keywords:
        """Return a number or a truth value for each design of a machine, shape (m,), by name."""
        measures, conditions, problem = self.problem(machine)
        drawn = {name: entry.default for name, entry in machine.plan.table.entries.items()}
        for leaf in problem.leaves:  # panels are those of the machine as its class has it, whatever the batch
            if isinstance(leaf, Integral):
                with suppress(LinkageError):
                    problem.refined_panels(leaf, drawn)
        look = problem.evaluated(machine.dimensions)
        found: Keywords = {name: look.values_of(each) for name, each in measures.items()}
        for name, constraints in conditions.items():
            found[name] = np.array(look.is_assembled)
            for one in constraints:
                with np.errstate(all="ignore"):
                    size = np.maximum(*(np.abs(side.from_leaves(look.numbers.__getitem__)) for side in (one.left, one.right)))
                    found[name] &= ~look.lost_of(one.margin) & (missed(one, look.numbers, 1.0) <= MET_TO_ROUNDING * size)
        return {name: found[name] for name in self.texts}

    def problem(self, machine: Mechanism) -> tuple[dict[str, Measure], dict[str, Sequence[Constraint]], Problem]:
        """Return the measures, and the constraints of the conditions, by name, and the problem that evaluates them.

        DefinitionError for a text that says none, and for measures that a machine does not have.
        """
        measures, conditions = dict[str, Measure](), dict[str, Sequence[Constraint]]()
        for name, text in self.texts.items():
            found = criterion_of(text, machine)
            if isinstance(found, Condition):
                conditions[name] = found.constraints(machine)
            else:
                measures[name] = measure_or_constant(found, machine)
        constraints = [one for each in conditions.values() for one in each]
        counts = {0: 1} | {each: max(3, round(self.poses ** (1.0 / each))) for each in range(1, 6)}
        return measures, conditions, Problem(machine, [*measures.values()], constraints, NOWHERE, over=dict(self.over), counts=counts)

    def units(self, machine: Mechanism) -> dict[str, str]:
        """Return the units that they are shown in, by name; raises as `problem` does."""
        measures, conditions, _ = self.problem(machine)
        return dict.fromkeys(conditions, "") | {name: unit_of_measure(machine.plan, each) for name, each in measures.items()}


def named_measures(given: Any) -> dict[str, str]:
    """Return the texts of a table of measures by name; those of a list by themselves."""
    if isinstance(given, list):
        return {str(text): text for text in given}
    return {cited(str(name), quote=False): text for name, text in given.items()}


# -- the studies ---------------------------------------------------------------------------------------------


@immutable
class TaskResult:
    """The result of a study file: sentences, a table, the study's own result, and whether there is a solution."""

    text: str
    columns: tuple[Column, ...]
    found: Any
    labels: tuple[str, ...] = ()
    """The first field of each row, where the rows have names."""
    solved: bool = True
    unit: str = ""
    """The unit that a zone's quantity is shown in."""


# What reads a key of a section.


def box_said(head: StudyHead, given: object) -> Keywords:
    """Return the ranges and choices of `vary`, as a box takes them; SeveralError with all mistakes, each under its name."""
    machine, table = head.machine, head.plan.table

    def ranges(name: str, value: object) -> Keywords:
        if name not in table.spellings and f"{name}.x" not in table.spellings:
            raise unknown("Dimension", name, table.names(), where=head.plan.title)
        said = study_file.range_said(value, head.plan, name)
        if isinstance(said, tuple) and len(said) == 3:
            raise DefinitionError("a study looks between the steps of a range too; leave the step out, or write a list of choices.")
        found = {} if isinstance(said, Around) else {name: said}
        for each in coordinates(head.plan, [name]) if isinstance(said, Around) else ():
            owner, sign = table.spellings[each]
            now = float(sign * machine.dimensions[owner])
            found[each] = (now - said.by, now + said.by)
        Box.of(machine, found)
        return found

    parts = study_file.by_dimensions(given, "vary", ranges, study_file.RANGE_KEYS).values()
    return {name: value for part in parts for name, value in part.items()}


MOST_STEPS = 1e6
"""Steps of a stroke."""


def swept_strokes(head: StudyHead, given: object) -> Keywords:
    """Return the strokes that are looked at [SI], arrays or single values; SeveralError with all mistakes, each under its stroke."""
    given = require_type("", given, Mapping, 'a table of strokes is expected, such as strokes = { S = "100 mm" }')

    def values(name: str, value: object) -> tuple[str, object]:
        known_name("Stroke", name, head.plan.strokes, where=head.plan.title)
        measures = stroke_measure(head.plan, name)
        if isinstance(value, list):
            return name, np.array([amount_said(each, measures) for each in value])
        span = parse_span(value, measures) if isinstance(value, str) else None
        if span is None:
            return name, amount_said(value, measures)
        low, high, *step = span
        if not step:
            return name, np.linspace(low, high, head.found.get("poses", 1))
        ensure(step[0] > 0.0 and abs(high - low) <= MOST_STEPS * step[0], f"{cited(value)}: give a longer step.")
        by = np.copysign(step[0], high - low)
        return name, np.arange(low, high + 0.5 * by, by)

    return dict(each_of(by_whole_names(given), values))


def pose_said(head: StudyHead, given: object) -> Keywords:
    """Return the value of every stroke at a pose [SI]."""
    found = swept_strokes(head, given)
    for name in head.plan.strokes:
        ensure(name in found, f"say the pose, strokes = {{ {name} = ... }}.")
    return found


def measures_said(head: StudyHead, given: object) -> dict[str, tuple[str, str]]:
    """Return the texts of measures and conditions by name, each with its unit; SeveralError with all mistakes, each under its name."""
    sound = isinstance(given, (Mapping, list)) and given
    require(sound, "", given, "a table of measures by names of your own is expected, or a list of them")

    def measured(name: str, text: object) -> tuple[str, tuple[str, str]]:
        text = require_type("", text, str, 'is no text in quotes, such as "least(tilt)"')
        return name, (text, TextMeasures({name: text}, 3, head.found["over"] or {}).units(head.machine)[name])

    return dict(each_of(named_measures(given).items(), measured))


def pose_quantity(head: StudyHead, given: object) -> Any:
    """Return the quantity over poses that a text says."""
    return quantity_said(given, head.machine)


def quantities_said(head: StudyHead, given: object) -> Keywords:
    """Return quantities and measures by name, in the load case that is looked at; SeveralError with all mistakes, each under its name."""
    case = head.found["case"]

    def one(name: str, text: object) -> tuple[str, object]:
        if isinstance(criterion_of(text, head.machine), Measure):
            return name, in_case(measure_said(text, head.machine), case)
        return name, situated(quantity_said(text, head.machine), Acting(case=case))

    return dict(each_of(named_measures(given if isinstance(given, (list, Mapping)) else [given]).items(), one))


def condition_limits(head: StudyHead, given: object) -> list[Constraint]:
    """Return the limits of conditions, in the load case that is looked at; SeveralError with all mistakes, each under its number."""

    def limits(text: object) -> list[Constraint]:
        kept = condition_said(text, head.machine).constraints(head.machine)
        return [*limits_listed(head.machine, [in_case(one, head.found["case"]) for one in kept])]

    return [one for each in study_file.texts_said(given, limits) for one in each]


def one_case(head: StudyHead, given: object) -> str:
    """Return the name of a load case; DefinitionError for several."""
    ensure(isinstance(study_file.case_said(head, given), str), "a study of tolerances is of one load case.")
    return str(given)


def percentile_list(head: StudyHead, given: Any) -> tuple[float, ...]:
    """Return percentages from 0 to 100."""
    sound = isinstance(given, list) and all(is_number(each) and 0.0 <= each <= 100.0 for each in given)
    require(sound, "", given, "percentages from 0 to 100 are expected, such as [5, 50, 95]")
    return tuple(map(float, given))


def targets_said(head: StudyHead, given: object) -> list[Target]:
    """Return the targets of texts such as `at(tilt, S=100 mm) == 0 deg`; SeveralError with all mistakes, each under its number."""

    def target(text: object) -> Target:
        condition = condition_said(text, head.machine)
        if isinstance(condition, Constraint) and condition.symbol == "==":
            for one, other in ((condition.left, condition.right), (condition.right, condition.left)):
                if isinstance(one, At) and isinstance(other, FixedNumber):
                    quantity: Any = one.quantity
                    return Target(quantity, other.value, unit=display_unit(measure_of(head.plan, quantity), "mm"), **one.strokes)
        raise DefinitionError(f"{condition} is no target; write at(tilt, S=100 mm) == 0 deg.")

    return study_file.texts_said(given, target)


# The studies: what their sections may have, and what comes of them.


def survey_task(
    machine: Mechanism,
    *,
    vary: Annotated[Keywords, box_said, 'vary = { OB = "270 to 330 mm" }'],
    over: Annotated[Keywords | None, study_file.over_said] = None,
    measure: Annotated[dict[str, tuple[str, str]], measures_said, 'measure = { travel = "most(G_y) - least(G_y)" }'],
    count: Annotated[int, partial(study_file.count_at_least, 1)] = 1024,
    method: Annotated[str, partial(study_file.word_said, SAMPLE_METHODS)] = "sobol",
    seed: Annotated[int, partial(study_file.count_at_least, 0)] = 0,
    poses: Annotated[int, partial(study_file.count_at_least, 2)] = 101,
    piece: Annotated[int, partial(study_file.count_at_least, 0)] = 0,
    folder: Path | None = None,
    progress: bool | Progress = False,
) -> TaskResult:
    """Measure many designs spread over a box; with a folder the same survey goes on where another one stopped."""
    designs = Box.of(machine, vary).sample(count, method=method, seed=seed)
    measures = TextMeasures({name: text for name, (text, _) in measure.items()}, poses, over or {})
    found = survey(machine, designs, measures, folder=folder, progress=progress, piece=piece or None)
    parts = [pair for name, value in designs.items() for pair in setting_parts(name, value)]
    columns = [Column(each, part, unit_of(machine.plan, each)) for each, part in parts]
    lines = [f"{machine.plan.title}: {count} designs."]
    for name, (_, unit) in measure.items():
        values = np.asarray(found[name])
        columns.append(Column(name, values.astype(float), unit))
        known = values[np.isfinite(values)]
        if values.dtype.kind == "b":
            words = f"{100.0 * float(np.mean(values)):.1f} % keep it"
        elif known.size:
            least, most, half = (show(float(of(known)), unit) for of in (np.min, np.max, np.median))
            lost = values.size - known.size
            words = f"{least} to {most}, half below {half}" + (f"; {lost} have none" if lost else "")
        else:
            words = "none has a value"
        lines.append(f"  {name}: {words}")
    return TaskResult("\n".join(lines), tuple(columns), found)


def setting_parts(name: str, value: object) -> list[tuple[str, Any]]:
    """Return a dimension and its values by name, a point as its two coordinates."""
    return [*zip((f"{name}.x", f"{name}.y"), value, strict=True)] if isinstance(value, tuple) else [(name, value)]


def zone_task(
    machine: Mechanism,
    *,
    quantity: Annotated[Any, pose_quantity, 'quantity = "tilt"'],
    vary: Annotated[Keywords, box_said, 'vary = { OB = "270 to 330 mm" }'],
    poses: Annotated[int, partial(study_file.count_at_least, 2)] = 51,
    strokes: Annotated[Keywords | None, swept_strokes] = None,
) -> TaskResult:
    """Look for the extremes of a quantity at every stroke over a box."""
    found = zone(machine, quantity, vary, **strokes or whole_stroke(machine, poses))
    plan, title = machine.plan, measured_title(machine.plan, quantity)
    unit = display_unit(measure_of(plan, quantity), "mm")
    ends = [Column(f"{title} {word}", value.ravel(), unit) for word, value in (("least", found.low), ("greatest", found.high))]
    settings = [
        Column(f"{part} at {word}", np.ravel(value), unit_of(plan, part))
        for word, at in (("least", found.low_at), ("greatest", found.high_at))
        for name, each in at.items()
        for part, value in setting_parts(name, each)
    ]
    least, most = float(np.nanmin(found.low, initial=np.inf)), float(np.nanmax(found.high, initial=-np.inf))
    says = f"from {show(least, unit)} to {show(most, unit)}" if least <= most else "has no value"
    lines = [f"{plan.title}: {title} {says} over the box.", *found.remarks]
    columns = (*stroke_columns(plan, found.strokes), *ends, Column("reached", found.reached.ravel()), *settings)
    return TaskResult("\n  ".join(lines), columns, found, unit=unit)


def whole_stroke(machine: Mechanism, poses: int) -> dict[str, FloatArray]:
    """Return so many values of the stroke of a machine that has one [m or rad], nothing where it has more."""
    return {name: np.linspace(each.start, each.end, poses) for name, each in machine.plan.strokes.items() if len(machine.plan.strokes) == 1}


def stroke_columns(plan: Plan, strokes: Mapping[str, FloatArray]) -> list[Column]:
    """Return the strokes as columns."""
    return [Column(name, np.ravel(value), stroke_display_unit(plan, name, "mm"), 4) for name, value in strokes.items()]


def tolerance_task(
    machine: Mechanism,
    *,
    case: Annotated[str | None, one_case] = None,
    of: Annotated[Keywords, quantities_said, 'of = ["tilt"]'],
    tolerances: Annotated[Keywords, partial(study_file.tolerances_said, "tolerances")],
    subject_to: Annotated[Sequence[Constraint], condition_limits] = (),
    count: Annotated[int, partial(study_file.count_at_least, 1)] = 1 << 14,
    seed: Annotated[int, partial(study_file.count_at_least, 0)] = 0,
    method: Annotated[str, partial(study_file.word_said, SAMPLE_METHODS)] = "sobol",
    percentiles: Annotated[tuple[float, ...], percentile_list] = (5.0, 50.0, 95.0),
    poses: Annotated[int, partial(study_file.count_at_least, 2)] = 21,
    strokes: Annotated[Keywords | None, swept_strokes] = None,
) -> TaskResult:
    """Vary dimensions within their tolerances at random: bands, the worst case, and the share of good machines."""
    found = monte_carlo(
        machine, of, tolerances, subject_to=subject_to, count=count, percentiles=percentiles, method=method, seed=seed,
        **strokes or whole_stroke(machine, poses),
    )  # fmt: skip
    along = stroke_columns(machine.plan, found.strokes)
    columns, lines = [*along], [str(found)]
    for name, band in found.bands.items():
        parts = {"nominal": band.nominal, "mean": band.mean, "sigma": band.sigma, "worst low": band.low, "worst high": band.high}
        parts |= {f"{percentage:g} %": value for percentage, value in band.percentiles.items()}
        shape = along[0].values.shape if along else (1,)
        columns += [Column(f"{name} {word}", np.broadcast_to(np.ravel(value), shape), band.unit) for word, value in parts.items()]
        place = int(np.nanargmax(np.nan_to_num(band.sigma)))
        lines.append(f"{name}: sigma up to {show(float(np.ravel(band.sigma)[place]), band.unit, 3)}.")
    return TaskResult("\n  ".join(lines), tuple(columns), found)


def tornado_task(
    machine: Mechanism,
    *,
    quantity: Annotated[Any, pose_quantity, 'quantity = "tilt"'],
    tolerances: Annotated[Keywords, partial(study_file.tolerances_said, "tolerances")],
    strokes: Annotated[Keywords, pose_said],
) -> TaskResult:
    """Look for the tolerance that matters most for a quantity at one pose."""
    unit = display_unit(measure_of(machine.plan, quantity), "mm")
    found = tornado(machine, quantity, tolerances, unit=unit, **strokes)
    rows = [(bar.low, bar.high, bar.share) for bar in found]
    names = ("at its lower limit", "at its upper limit", "share of the variance")
    parts = zip(names, zip(*rows, strict=True), (unit, unit, ""), strict=True)
    columns = [Column(name, np.array(part), each) for name, part, each in parts]
    return TaskResult(str(found), tuple(columns), found, labels=tuple(bar.name for bar in found))


def settings_task(
    machine: Mechanism,
    *,
    vary: Annotated[Keywords, box_said, 'vary = { OB = "270 to 330 mm" }'],
    targets: Annotated[list[Target], targets_said, 'targets = ["at(tilt, S=100 mm) == 0 deg"]'],
) -> TaskResult:
    """Look for the settings of a box that give wanted values."""
    found = settings_for(machine, vary, targets)
    names = coordinates(machine.plan, [*(found.settings[0] if found.settings else vary)])
    rows = [[part for name, value in each.items() for _, part in setting_parts(name, value)] for each in found.settings]
    table = np.array(rows, float).reshape(-1, len(names))
    columns = [Column(name, part, unit_of(machine.plan, name)) for name, part in zip(names, table.T, strict=True)]
    return TaskResult(str(found), tuple(columns), found, solved=found.met)


TASKS: Mapping[str, Callable[..., TaskResult]] = {
    "survey": survey_task, "zone": zone_task, "tolerance": tolerance_task, "tornado": tornado_task, "settings": settings_task,
}  # fmt: skip
"""The studies by the sections that ask for them."""
TABLES = ".csv", ".jsonl"
TASK_OUTPUTS: Mapping[str, Sequence[str]] = {
    name: TABLES if name in ("survey", "settings") else (*TABLES, *study_file.PICTURE_SUFFIXES) for name in TASKS
}


@immutable
class StudyFile:
    """The studies that a file asks for, each with its keywords, the folder that the survey is kept in, and the files of their results."""

    machine: Mechanism
    tasks: Mapping[str, Keywords]
    folder: Path | None
    outputs: Mapping[str, tuple[Path, ...]]

    def run(self, section: str, folder: Path | None = None, progress: bool | Progress = False) -> TaskResult:
        """Return the result of a section's study; `folder` replaces the file's own."""
        kept: Keywords = {"folder": folder or self.folder, "progress": progress} if section == "survey" else {}
        return TASKS[section](self.machine, **self.tasks[section], **kept)


def read_study(path: str | os.PathLike[str], find: FindMachine, settings: Settings) -> StudyFile:
    """Return the studies that a TOML or JSON file asks for; FileError with every mistake, its line and its key; as `read_search`."""
    head = StudyHead.of(path, (*TASKS, "folder", "outputs"), find, settings)
    asked = [section for section in TASKS if head.data.get(section) is not None]
    tasks: dict[str, Keywords] = {}
    for section in asked:
        with head.faults.at_key(section):
            given = require_type("", head.data[section], Mapping, f"a table is expected, [{section}]")
            tasks[section] = study_file.keywords_read(head, TASKS[section], given)
    if not asked:
        head.faults.add((), f"there is no study; begin one with {' or '.join(f'[{each}]' for each in TASKS)}.")
    folder = None
    if "folder" in head.data:
        with head.faults.at_key("folder"):
            folder = study_file.file_path(head, head.data["folder"])
    outputs = study_file.outputs_said(head, TASK_OUTPUTS)
    for name in outputs:
        if name not in head.data:
            head.faults.add(("outputs", name), f"the file has no [{name}], of which this would be the result.")
    head.faults.check()
    return StudyFile(head.machine, tasks, folder, outputs)
