"""Studies as a file: a survey over a box, a zone, tolerances, what matters most, and settings that give wanted values.

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
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, final

import numpy as np

from ..errors import DefinitionError, one_word, unknown
from ..loads import Acting
from ..mechanism import Mechanism
from ..motion import Column, Request, stroke_display_unit, stroke_measure
from ..motion.kinds import measure_of
from ..motion.measures import At, Constraint, Given, Measure, in_case
from ..program import FloatArray
from ..quantities import is_number
from ..study import Target, monte_carlo, settings_for, survey, tornado, zone
from ..study.box import METHODS as SAMPLE_METHODS
from ..study.box import Box
from ..study.checks import unit_of
from ..study.measured import measured_title
from ..study.monte_carlo import limits_listed
from ..study.optimise import constraint_in_case
from ..study.space import Around, coordinates
from ..study.survey import Progress
from ..units import display_unit, parse_span, show
from .criterion import CriterionParser, checked_text, condition_said, measure_said, quantity_said
from .names import by_whole_names, shortened
from .study_file import (
    PICTURE_SUFFIXES,
    RANGE_KEYS,
    FindMachine,
    StudyHead,
    amount_said,
    case_said,
    count_said,
    flattened,
    outputs_said,
    over_said,
    range_said,
    tolerances_said,
)
from .survey_measures import TextMeasures, named_measures


@final
@dataclass(frozen=True, eq=False)
class TaskResult:
    """What a study came to: sentences, a table, the study's own result, and whether there is a solution."""

    text: str
    columns: tuple[Column, ...]
    found: Any
    labels: tuple[str, ...] = ()
    """The first field of each row, where the rows have names."""
    solved: bool = True


class StudyTask(ABC):
    """A study of a file: a subclass reads its own section, and runs it."""

    section: str
    keys: tuple[str, ...]

    def __init__(self, head: StudyHead, given: Mapping[str, object]) -> None:
        self.head, self.given, self.machine, self.plan = head, given, head.machine, head.machine.plan

    @abstractmethod
    def read(self) -> None:
        """Read the section, its mistakes noted."""

    @abstractmethod
    def run(self, folder: Path | None, progress: bool | Progress) -> TaskResult:
        """Return what the study comes to."""

    # -- what sections have in common ------------------------------------------------------------------

    def at(self, *key: str) -> Any:
        """Return the context in which mistakes are noted under a key of the section."""
        return self.head.faults.at(self.section, *key)

    def needed(self, key: str, example: str) -> Any:
        """Return what stands under a key; DefinitionError where nothing does."""
        if key not in self.given:
            raise DefinitionError(f"{key} is missing; write {example}.")
        return self.given[key]

    def whole_number(self, key: str, default: int, least: int = 1) -> int:
        """Return a whole number of the section."""
        found = default
        with self.at(key):
            found = count_said(self.given.get(key, default), least)
        return found

    def box(self) -> dict[str, Any]:
        """Return the ranges and choices of `vary`, as a box takes them; mistakes are noted."""
        found: dict[str, Any] = {}
        with self.at("vary"):
            for name, value in flattened(self.needed("vary", 'vary = { OB = "270 to 330 mm" }'), self.plan, "vary", RANGE_KEYS):
                with self.at("vary", name):
                    if name not in self.plan.table.spellings and f"{name}.x" not in self.plan.table.spellings:
                        raise unknown("Dimension", name, self.plan.table.names(), where=self.plan.title)
                    ranges = box_range(self.machine, name, range_said(value, self.plan, name))
                    Box.of(self.machine, ranges)
                    found |= ranges
        return found

    def strokes(self, poses: int | None = None) -> dict[str, Any]:
        """Return the strokes that are looked at [SI], arrays or single values; all of a single one where the section says none."""
        found: dict[str, Any] = {}
        given = self.given.get("strokes", {})
        with self.at("strokes"):
            if not isinstance(given, Mapping):
                raise DefinitionError(f'{shortened(given)}: a table of strokes is expected, such as strokes = {{ S = "100 mm" }}.')
            for name, value in by_whole_names(given):
                with self.at("strokes", name):
                    if name not in self.plan.strokes:
                        raise unknown("Stroke", name, self.plan.strokes, where=self.plan.title)
                    found[name] = stroke_values_said(value, stroke_measure(self.plan, name), poses or 1)
            if not given and poses and len(self.plan.strokes) == 1:
                [(name, stroke)] = self.plan.strokes.items()
                found[name] = np.linspace(stroke.start, stroke.end, poses)
        return found

    def stroke_column(self, strokes: Mapping[str, FloatArray]) -> list[Column]:
        """Return the strokes as columns."""
        return [Column(name, np.ravel(value), stroke_display_unit(self.plan, name, "mm"), 4) for name, value in strokes.items()]

    def unit_of_quantity(self, quantity: object) -> str:
        """Return the unit that a quantity is shown in."""
        return display_unit(measure_of(self.plan, quantity), "mm")


def box_range(machine: Mechanism, name: str, said: object) -> dict[str, Any]:
    """Return a range as a box takes it; DefinitionError for one in steps."""
    plan = machine.plan
    if isinstance(said, Around):
        found = {}
        for each in coordinates(plan, [name]):
            owner, sign = plan.table.spellings[each]
            now = float(sign * machine.dimensions[owner])
            found[each] = (now - said.by, now + said.by)
        return found
    if isinstance(said, tuple) and len(said) == 3:
        raise DefinitionError("a study looks between the steps of a range too; leave the step out, or write a list of choices.")
    return {name: said}


def stroke_values_said(given: object, measures: str, poses: int) -> Any:
    """Return values of a stroke [SI]: one, those of a list, or so many over a range."""
    if isinstance(given, list):
        return np.array([amount_said(each, measures) for each in given])
    span = parse_span(given, measures) if isinstance(given, str) else None
    if span is None:
        return amount_said(given, measures)
    if len(span) == 3:
        return np.arange(span[0], span[1] + 0.5 * span[2], span[2])
    return np.linspace(span[0], span[1], poses)


# The studies.


@final
class SurveyTask(StudyTask):
    """Measures of many designs spread over a box."""

    section = "survey"
    keys = ("vary", "measure", "count", "method", "seed", "poses", "over", "piece")

    def read(self) -> None:
        self.vary = self.box()
        self.count = self.whole_number("count", 1024)
        self.seed = self.whole_number("seed", 0, 0)
        self.poses = self.whole_number("poses", 101, 2)
        self.piece = self.whole_number("piece", 0, 0) or None
        self.method = "sobol"
        with self.at("method"):
            self.method = one_word("it", self.given.get("method", "sobol"), SAMPLE_METHODS)
        over = over_said(self.head, self.given["over"], self.section) if "over" in self.given else {}
        self.texts: dict[str, str] = {}
        self.units: dict[str, str] = {}
        with self.at("measure"):
            given = self.needed("measure", 'measure = { travel = "most(G_y) - least(G_y)" }')
            if not isinstance(given, (Mapping, list)) or not given:
                raise DefinitionError(f"{shortened(given)}: a table of measures by names of your own is expected, or a list of them.")
            for name, text in named_measures(given).items():
                with self.at("measure", name):
                    if not isinstance(text, str):
                        raise DefinitionError(f'{shortened(text)} is no text in quotes, such as "least(tilt)".')
                    self.units |= TextMeasures({name: text}, 3, over).units(self.machine)
                    self.texts[name] = text
        self.over = over

    def run(self, folder: Path | None, progress: bool | Progress) -> TaskResult:
        over = Box.of(self.machine, self.vary).sample(self.count, method=self.method, seed=self.seed)
        found = survey(
            self.machine, over, TextMeasures(self.texts, self.poses, self.over), folder=folder, progress=progress, piece=self.piece
        )
        columns = [column for name, value in over.items() for column in self.dimension_columns(name, value)]
        columns += [Column(name, np.asarray(found[name], float), unit) for name, unit in self.units.items()]
        lines = [f"{self.plan.title}: {self.count} designs."]
        lines += [f"  {summary_of(name, found[name], unit)}" for name, unit in self.units.items()]
        return TaskResult("\n".join(lines), tuple(columns), found)

    def dimension_columns(self, name: str, value: Any) -> list[Column]:
        """Return a dimension as a column, a point as two."""
        parts = dict(zip((f"{name}.x", f"{name}.y"), value, strict=True)) if isinstance(value, tuple) else {name: value}
        return [Column(each, part, unit_of(self.plan, each)) for each, part in parts.items()]


def summary_of(name: str, values: Any, unit: str) -> str:
    """Return what a survey found of a measure, in words."""
    if np.asarray(values).dtype.kind == "b":
        return f"{name}: {100.0 * float(np.mean(values)):.1f} % keep it"
    known = np.asarray(values)[np.isfinite(values)]
    if not known.size:
        return f"{name}: none has a value"
    said = f"{name}: {show(float(known.min()), unit)} to {show(float(known.max()), unit)}, half below {show(float(np.median(known)), unit)}"
    lost = np.size(values) - known.size
    return said + (f"; {lost} have none" if lost else "")


@final
class ZoneTask(StudyTask):
    """The extremes of a quantity at every stroke over a box."""

    section = "zone"
    keys = ("quantity", "vary", "strokes", "poses")

    def read(self) -> None:
        self.vary = self.box()
        self.looked_at = self.strokes(self.whole_number("poses", 51, 2))
        with self.at("quantity"):
            self.quantity = quantity_said(self.needed("quantity", 'quantity = "tilt"'), self.machine)

    @property
    def unit(self) -> str:
        """The unit that the quantity is shown in."""
        return self.unit_of_quantity(self.quantity)

    def run(self, folder: Path | None, progress: bool | Progress) -> TaskResult:
        found = zone(self.machine, self.quantity, self.vary, **self.looked_at)
        unit, title = self.unit, measured_title(self.plan, self.quantity)
        ends = [Column(f"{title} {word}", value.ravel(), unit) for word, value in (("least", found.low), ("greatest", found.high))]
        strokes = self.stroke_column(found.strokes)
        settings = [
            Column(f"{part} at {word}", np.ravel(value), unit_of(self.plan, part))
            for word, at in (("least", found.low_at), ("greatest", found.high_at))
            for name, each in at.items()
            for part, value in (zip((f"{name}.x", f"{name}.y"), each, strict=True) if isinstance(each, tuple) else ((name, each),))
        ]
        least, most = float(np.nanmin(found.low, initial=np.inf)), float(np.nanmax(found.high, initial=-np.inf))
        lines = [f"{self.plan.title}: {title} from {show(least, unit)} to {show(most, unit)} over the box."]
        reached = Column("reached", found.reached.ravel())
        return TaskResult("\n  ".join([*lines, *found.remarks]), (*strokes, *ends, reached, *settings), found)


@final
class ToleranceTask(StudyTask):
    """Monte Carlo of tolerances: bands, the worst case, and the share of good machines."""

    section = "tolerance"
    keys = ("of", "tolerances", "subject_to", "count", "seed", "method", "percentiles", "strokes", "poses", "case")

    def read(self) -> None:
        self.tolerances = tolerances_said(self.head, self.given.get("tolerances", {}), self.section, "tolerances")
        self.count, self.seed = self.whole_number("count", 1 << 14), self.whole_number("seed", 0, 0)
        self.looked_at = self.strokes(self.whole_number("poses", 21, 2)) or {}
        self.method = "sobol"
        self.percentiles: tuple[float, ...] = (5.0, 50.0, 95.0)
        self.of: dict[str, Any] = {}
        self.conditions: list[Constraint] = []
        with self.at("method"):
            self.method = one_word("it", self.given.get("method", "sobol"), SAMPLE_METHODS)
        with self.at("percentiles"):
            given = self.given.get("percentiles", [5, 50, 95])
            if not isinstance(given, list) or not all(is_number(each) and 0.0 <= each <= 100.0 for each in given):
                raise DefinitionError(f"{shortened(given)}: percentages from 0 to 100 are expected, such as [5, 50, 95].")
            self.percentiles = tuple(map(float, given))
        case = None
        with self.at("case"):
            case = case_said(self.head, self.given["case"]) if "case" in self.given else None
            if isinstance(case, (list, dict)):
                raise DefinitionError("a study of tolerances is of one load case.")
        self.read_quantities(case)

    def read_quantities(self, case: Any) -> None:
        """Read what is looked at, and the limits."""
        with self.at("of"):
            given = self.needed("of", 'of = ["tilt"]')
            for name, text in named_measures(given if isinstance(given, (list, Mapping)) else [given]).items():
                with self.at("of", name):
                    self.of[name] = with_case(quantity_or_measure(text, self.machine), case)
        with self.at("subject_to"):
            given = self.given.get("subject_to", [])
            for number, text in enumerate(given if isinstance(given, list) else [given], 1):
                with self.at("subject_to", str(number)):
                    held = condition_said(text, self.machine).constraints(self.machine)
                    self.conditions += limits_listed(self.machine, [constraint_in_case(one, case) for one in held])

    def run(self, folder: Path | None, progress: bool | Progress) -> TaskResult:
        found = monte_carlo(
            self.machine, self.of, self.tolerances, subject_to=self.conditions, count=self.count, percentiles=self.percentiles,
            method=self.method, seed=self.seed, **self.looked_at,
        )  # fmt: skip
        strokes = self.stroke_column(found.strokes)
        columns, lines = [*strokes], [str(found)]
        for name, band in found.bands.items():
            unit = band.unit
            parts = {"nominal": band.nominal, "mean": band.mean, "sigma": band.sigma, "worst low": band.low, "worst high": band.high}
            parts |= {f"{percentage:g} %": value for percentage, value in band.percentiles.items()}
            shape = strokes[0].values.shape if strokes else (1,)
            columns += [Column(f"{name} {word}", np.broadcast_to(np.ravel(value), shape), unit) for word, value in parts.items()]
            place = int(np.nanargmax(np.nan_to_num(band.sigma)))
            lines.append(f"{name}: sigma up to {show(float(np.ravel(band.sigma)[place]), unit, 3)}.")
        return TaskResult("\n  ".join(lines), tuple(columns), found)


def with_case(quantity: Any, case: Any) -> Any:
    """Return a quantity or a measure with the forces of a load case, where it is of forces."""
    if isinstance(quantity, Measure):
        return in_case(quantity, case)
    return quantity.under(Acting(case=case), keep=True) if case is not None and isinstance(quantity, Request) else quantity


def quantity_or_measure(text: object, machine: Mechanism) -> Any:
    """Return the quantity over poses that a text says, or a measure; DefinitionError for what is neither."""
    found = CriterionParser(checked_text(text), machine).whole()
    return measure_said(text, machine) if isinstance(found, Measure) else quantity_said(text, machine)


@final
class TornadoTask(StudyTask):
    """Which tolerance matters most for a quantity at one pose."""

    section = "tornado"
    keys = ("quantity", "tolerances", "strokes")

    def read(self) -> None:
        self.tolerances = tolerances_said(self.head, self.given.get("tolerances", {}), self.section, "tolerances")
        self.looked_at = self.strokes()
        with self.at("quantity"):
            self.quantity = quantity_said(self.needed("quantity", 'quantity = "tilt"'), self.machine)
        with self.at("strokes"):
            missing = [name for name in self.plan.strokes if name not in self.looked_at]
            if missing and "strokes" not in self.head.faults.text():
                raise DefinitionError(f"say the pose, strokes = {{ {missing[0]} = ... }}.")

    def run(self, folder: Path | None, progress: bool | Progress) -> TaskResult:
        unit = self.unit_of_quantity(self.quantity)
        found = tornado(self.machine, self.quantity, self.tolerances, unit=unit, **self.looked_at)
        rows = [(bar.low, bar.high, bar.share) for bar in found]
        names = ("at its lower limit", "at its upper limit", "share of the variance")
        parts = zip(names, zip(*rows, strict=True), (unit, unit, ""), strict=True)
        columns = [Column(name, np.array(part), each) for name, part, each in parts]
        return TaskResult(str(found), tuple(columns), found, labels=tuple(bar.name for bar in found))


@final
class SettingsTask(StudyTask):
    """The settings of a box that give wanted values."""

    section = "settings"
    keys = ("vary", "targets")

    def read(self) -> None:
        self.vary, self.targets = self.box(), []
        with self.at("targets"):
            given = self.needed("targets", 'targets = ["at(tilt, S=100 mm) == 0 deg"]')
            for number, text in enumerate(given if isinstance(given, list) else [given], 1):
                with self.at("targets", str(number)):
                    self.targets.append(self.target(condition_said(text, self.machine)))

    def target(self, condition: object) -> Target:
        """Return the target that a condition says; DefinitionError for any but `at(...) == number`."""
        if isinstance(condition, Constraint) and condition.symbol == "==":
            for one, other in ((condition.left, condition.right), (condition.right, condition.left)):
                if isinstance(one, At) and isinstance(other, Given):
                    quantity: Any = one.quantity
                    return Target(quantity, other.value, unit=self.unit_of_quantity(quantity), **one.strokes)
        raise DefinitionError(f"{condition} is no target; write at(tilt, S=100 mm) == 0 deg.")

    def run(self, folder: Path | None, progress: bool | Progress) -> TaskResult:
        found = settings_for(self.machine, self.vary, self.targets)
        names = [each for name in (found.settings[0] if found.settings else ()) for each in coordinates(self.plan, [name])]
        rows = [[part for value in each.values() for part in (value if isinstance(value, tuple) else (value,))] for each in found.settings]
        parts = zip(names, zip(*rows, strict=True), strict=True)
        columns = [Column(name, np.array(part, float), unit_of(self.plan, name)) for name, part in parts]
        return TaskResult(str(found), tuple(columns), found, solved=found.met)


TASKS: tuple[type[StudyTask], ...] = (SurveyTask, ZoneTask, ToleranceTask, TornadoTask, SettingsTask)
TASK_OUTPUTS: Mapping[str, Sequence[str]] = {
    "survey": (".csv", ".jsonl"),
    "zone": (".csv", ".jsonl", *PICTURE_SUFFIXES),
    "tolerance": (".csv", ".jsonl", *PICTURE_SUFFIXES),
    "tornado": (".csv", ".jsonl", *PICTURE_SUFFIXES),
    "settings": (".csv", ".jsonl"),
}


@final
@dataclass(frozen=True, eq=False)
class StudyFile:
    """The studies that a file asks for, the folder that the survey is kept in, and the files of their results."""

    tasks: tuple[StudyTask, ...]
    folder: Path | None
    outputs: Mapping[str, tuple[Path, ...]]


def read_study(
    path: str | os.PathLike[str], find: FindMachine, settings: Callable[[type[Mechanism]], Mapping[str, Any]] = lambda machine: {}
) -> StudyFile:
    """Return the studies that a TOML or JSON file asks for; FileError with every mistake, its line and its key; as `read_search`."""
    sections = tuple(task.section for task in TASKS)
    head = StudyHead.of(path, (*sections, "folder", "outputs"), find, settings)
    tasks = []
    for kind in TASKS:
        given = head.data.get(kind.section)
        if given is None:
            continue
        if not isinstance(given, Mapping):
            head.faults.add((kind.section,), f"{shortened(given)}: a table is expected, [{kind.section}].")
            continue
        for key in given:
            if key not in kind.keys:
                head.faults.add((kind.section, str(key)), str(unknown("Key", shortened(key, quote=False), kind.keys)))
        tasks.append(kind(head, given))
        tasks[-1].read()
    if not tasks and not head.faults.found:
        head.faults.add((), f"there is no study; begin one with {' or '.join(f'[{each}]' for each in sections)}.")
    folder = None
    with head.faults.at("folder"):
        folder = head.path_of(head.data["folder"]) if "folder" in head.data else None
    outputs = outputs_said(head, TASK_OUTPUTS)
    for name in outputs:
        if name not in head.data:
            head.faults.add(("outputs", name), f"the file has no [{name}], of which this would be the result.")
    head.faults.check()
    return StudyFile(tuple(tasks), folder, outputs)
