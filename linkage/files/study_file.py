"""What every study file has: the machine and its settings, ranges and values in an engineer's words, and where results go.

    machine = "three_point_hitch"               # of `hydrolinkage list`, a machine's file, or package.module:Class of a trusted package
    set = { OB = "310 mm", M = ["220 mm", "950 mm"] }

A range is `"270 mm to 330 mm"`, `"270 to 330 mm in steps of 5 mm"`, `"within 60 mm"` of the present value; a list is the choices.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias, final

from ..disk import check_place
from ..errors import DefinitionError, FileError, known_name, one_word, unknown
from ..loads import PLAIN_CASE, LoadCase
from ..mechanism import Mechanism
from ..motion import Over, stroke_measure
from ..plan import Plan, plan_measure
from ..quantities import is_number, is_whole
from ..study.problem import ranges_of
from ..study.sides import is_side
from ..study.space import Space, around, known_dimension
from ..study.tolerances import Tolerance, tolerances_of
from ..units import parse, parse_span
from .criterion import CriterionParser
from .names import by_whole_names, shortened
from .source import TEXT, Faults, source

FindMachine: TypeAlias = Callable[[str, Path], type[Mechanism]]
"""What returns the class of a machine by its text and the folder of the file that names it."""

PICTURE_SUFFIXES = (".png", ".svg", ".pdf")
RANGE_WORDS = 'a range such as "270 to 330 mm", "270 to 330 mm in steps of 5 mm" or "within 60 mm", or a list of choices'

_AROUND = re.compile(r"\s*(?:within|around|\+-|\+/-|±)\s*(?P<by>.+?)(?:\s+(?:in steps of|by)\s+(?P<step>.+?))?\s*\Z")


@final
@dataclass(frozen=True, eq=False)
class StudyHead:
    """A study file as it is read: its tables, the mistakes found so far, the machine, and the folder that its paths start from."""

    data: Mapping[str, Any]
    faults: Faults
    machine: Mechanism
    base: Path
    machines: Mapping[str, Mechanism] = field(default_factory=dict)
    """All machines by the file's texts, where it names a list of them."""

    @classmethod
    def of(
        cls,
        path: str | os.PathLike[str],
        keys: Sequence[str],
        find: FindMachine,
        settings: Callable[[type[Mechanism]], Mapping[str, Any]],
        *,
        several: bool = False,
    ) -> StudyHead:
        """Return the head of a file that may have some keys beside `machine`, `set` and `doc`; FileError where there is no machine.

        `settings` are dimensions [SI] that stand above those of the file. With `several` the machine may be a list of them.
        """
        found = source(path)
        faults, base = Faults(source=found.name, line_of=found.line_of), Path() if found.name == TEXT else Path(path).parent
        known = ("machine", "set", "doc", *keys)
        data = found.data if isinstance(found.data, Mapping) else {}
        for key in data:
            if key not in known:
                faults.add((str(key),), str(unknown("Key", shortened(key, quote=False), known)))
        given = data.get("machine")
        listed: list[Any] = given if several and isinstance(given, list) and given else [given]
        machines: list[Mechanism] = []
        for text in listed:
            kind = machine_said(text, faults, find, base)
            if kind is not None:
                with faults.at("set"):
                    made = kind(**settings_said(kind.plan, data.get("set", {}), faults))
                    machines.append(made.replaced(**settings(kind)))
        faults.check()
        return cls(data, faults, machines[0], base, dict(zip(listed, machines, strict=True)) if isinstance(given, list) else {})

    @property
    def plan(self) -> Plan:
        """The machine's plan."""
        return self.machine.plan

    def path_of(self, given: object) -> Path:
        """Return a path as it is meant: relative to the file's own folder. DefinitionError for anything else."""
        if not isinstance(given, str) or not given.strip():
            raise DefinitionError(f"{shortened(given)} is no path in quotes.")
        return self.base / given


def machine_said(given: object, faults: Faults, find: FindMachine, base: Path) -> type[Mechanism] | None:
    """Return the class of the machine that a file names; None, noted, where there is none."""
    found = None
    with faults.at("machine"):
        if not isinstance(given, str) or not given:
            what = "the machine is missing" if given is None else f"{shortened(given)} is no name in quotes"
            raise DefinitionError(f'{what}; begin with machine = "three_point_hitch", a name of `hydrolinkage list` or a file.')
        found = find(given, base)
    return found


def settings_said(plan: Plan, given: object, faults: Faults) -> dict[str, Any]:
    """Return dimensions [SI] by name; mistakes are noted."""
    found: dict[str, Any] = {}
    for name, value in flattened(given, plan, "set"):
        with faults.at("set", name):
            found[name] = value_said(value, plan, name)
    return found


# Values: numbers in SI, or texts with a unit that measures what it should.


def flattened(given: object, plan: Plan, what: str, words: Sequence[str] = ()) -> Iterator[tuple[str, Any]]:
    """Yield the entries of a table of dimensions by their whole names."""
    if not isinstance(given, Mapping):
        raise DefinitionError(f"{what} = {shortened(given)}: a table by the names of dimensions is expected, such as [{what}] OB = ...")
    yield from by_whole_names(given, words)


def measure_of_name(plan: Plan, name: str) -> str:
    """Return what a dimension measures, "length" for a point; "" where nothing says so."""
    known = name in plan.table.spellings
    return plan_measure(plan, plan.table.spellings[name][0]) if known else "length" if f"{name}.x" in plan.table.spellings else ""


def amount_said(given: object, measures: str) -> float:
    """Return a number as it is [SI], or that of a text whose unit measures what it should; DefinitionError for anything else."""
    if isinstance(given, str):
        return parse(given, measures)
    if not is_number(given):
        raise DefinitionError(f'{shortened(given)} is no number and no text with a unit, such as "60 mm".')
    return float(given)


def value_said(given: object, plan: Plan, name: str) -> Any:
    """Return the value of a dimension [SI], of a point a pair."""
    measures = measure_of_name(plan, name)
    if isinstance(given, (list, tuple)):
        if name in plan.table.spellings or len(given) != 2:
            raise DefinitionError(f"{shortened(given)}: {'one value' if name in plan.table.spellings else 'two coordinates'} expected.")
        return tuple(amount_said(each, measures) for each in given)
    if f"{name}.x" in plan.table.spellings:
        raise DefinitionError(f'{shortened(given)}: {name} is a point; write its two coordinates, ["220 mm", "950 mm"].')
    return amount_said(given, measures)


# Ranges and choices.

RANGE_KEYS = ("from", "to", "step", "around", "choices")


def vary_said(head: StudyHead, given: object, *key: str) -> dict[Any, Any]:
    """Return what varies as `optimise` takes it; mistakes are noted, each under its name behind a key."""
    found: dict[Any, Any] = {}
    with head.faults.at(*key, "vary"):
        entries = list(flattened(given, head.plan, "vary", RANGE_KEYS))
        if not entries:
            raise DefinitionError(f'nothing varies; write [{".".join((*key, "vary"))}] OB = "270 to 330 mm": {RANGE_WORDS}.')
        for name, value in entries:
            with head.faults.at(*key, "vary", name):
                names = tuple(part.strip() for part in name.split(","))
                for part in names:
                    known_dimension(head.machine, part) if part not in head.plan.points and not is_side(part) else None
                varied = names if len(names) > 1 else names[0]
                said = rows_said(value, head.plan, names) if len(names) > 1 else range_said(value, head.plan, names[0])
                Space.of(head.machine, {varied: said})
                found[varied] = said
    return found


def range_said(given: object, plan: Plan, name: str) -> Any:
    """Return what a dimension ranges over as `optimise` takes it: a tuple, `around(...)`, or a list of choices."""
    measures = measure_of_name(plan, name)
    if isinstance(given, (list, tuple)):
        return [each if is_side(name) else value_said(each, plan, name) for each in given]
    if isinstance(given, Mapping):
        return range_of_table(given, plan, name, measures)
    text = given if isinstance(given, str) else ""
    near = _AROUND.match(text)
    if near is not None:
        step = near.group("step")
        return around(parse(near.group("by"), measures), None if step is None else parse(step, measures))
    ends = parse_span(text, measures)
    if ends is None:
        raise DefinitionError(f"{shortened(given)} is no range; write {RANGE_WORDS}.")
    return ends


def range_of_table(given: Mapping[str, object], plan: Plan, name: str, measures: str) -> Any:
    """Return a range of a table: { from, to, step }, { around, step } or { choices }."""
    for key in given:
        known_name("Key", key, RANGE_KEYS)
    kinds = [keys for keys in (("from", "to"), ("around",), ("choices",)) if any(key in given for key in keys)]
    if len(kinds) != 1 or not set(kinds[0]) <= set(given) or ("step" in given and kinds[0] == ("choices",)):
        raise DefinitionError(f"{shortened(dict(given))}: write {{ from, to, step }}, {{ around, step }} or {{ choices = [...] }}.")
    if kinds[0] == ("choices",):
        return range_said(list(given["choices"]) if isinstance(given["choices"], list) else given["choices"], plan, name)
    step = [amount_said(given["step"], measures)] if "step" in given else []
    if kinds[0] == ("around",):
        return around(amount_said(given["around"], measures), *step)
    return (*(amount_said(given[key], measures) for key in ("from", "to")), *step)


def rows_said(given: object, plan: Plan, names: Sequence[str]) -> list[Any]:
    """Return the rows of a catalogue, each with a value for each of some names."""
    if not isinstance(given, list):
        raise DefinitionError(f"{shortened(given)}: rows are expected, a list [...] with {len(names)} values each.")
    rows = []
    for row in given:
        if not isinstance(row, list) or len(row) != len(names):
            raise DefinitionError(f"{shortened(row)} is no row of {', '.join(names)}; it has a value for each of them.")
        pairs = zip(names, row, strict=True)
        rows.append([value if is_side(name) else amount_said(value, measure_of_name(plan, name)) for name, value in pairs])
    return rows


# Tolerances.

TOLERANCE_KEYS = ("limits", "law")


def tolerances_said(head: StudyHead, given: object, *key: str) -> dict[str, Any]:
    """Return tolerances by the names of dimensions; mistakes are noted, each under its name behind a key."""
    found: dict[str, Any] = {}
    with head.faults.at(*key):
        entries = [*flattened(given, head.plan, key[-1], TOLERANCE_KEYS)]
        if not entries:
            raise DefinitionError(f'no tolerance is given; write {key[-1]} = {{ OB = "0.1 mm", CD = ["-0.1 mm", "0.2 mm"] }}.')
        for name, value in entries:
            with head.faults.at(*key, name):
                tolerances_of(head.plan, {name: 0.0})
                found[name] = tolerance_said(value, measure_of_name(head.plan, name))
    return found


def tolerance_said(given: object, measures: str) -> Tolerance:
    """Return a tolerance: how far to either side, the two limits, or { limits, law }."""
    if isinstance(given, Mapping):
        for each in given:
            known_name("Key", each, TOLERANCE_KEYS)
        if "limits" not in given:
            raise DefinitionError(f'{shortened(dict(given))}: write {{ limits = "0.1 mm", law = "uniform" }}.')
        return Tolerance(limits_said(given["limits"], measures), given.get("law", "normal"))
    return Tolerance(limits_said(given, measures))


def limits_said(given: object, measures: str) -> float | tuple[float, float]:
    """Return how far a dimension may lie from its value [SI]: to either side, or its two limits."""
    if isinstance(given, list):
        if len(given) != 2:
            raise DefinitionError(f'{shortened(given)}: two limits are expected, such as ["-0.1 mm", "0.2 mm"].')
        return amount_said(given[0], measures), amount_said(given[1], measures)
    return amount_said(given.strip().removeprefix("+-").removeprefix("±") if isinstance(given, str) else given, measures)


# Strokes, load cases, words and numbers.


def over_said(head: StudyHead, given: object, *key: str) -> dict[str, Any]:
    """Return the parts of the strokes that are looked at, as `optimise` takes them; mistakes are noted behind a key.

    A text is the name of an `Over` that the machine declares.
    """
    found: dict[str, Any] = {}
    if isinstance(given, str):
        with head.faults.at(*key, "over"):
            found = strokes_declared(head, given)
        return found
    if not isinstance(given, Mapping):
        what = 'a table of strokes is expected, such as over = { S = "0 to 200 mm" }, or the name of an Over that the machine declares.'
        head.faults.add((*key, "over"), f"{shortened(given)}: {what}")
        return found
    for name, value in by_whole_names(given):
        with head.faults.at(*key, "over", name):
            said = part_said(head, known_name("Stroke", name, head.plan.strokes, where=head.plan.title), value)
            ranges_of(head.machine, {name: said})
            found[name] = said
    return found


def strokes_declared(head: StudyHead, name: str) -> dict[str, Any]:
    """Return the strokes of an `Over` that the machine declares; DefinitionError where there is none, or where strokes do not say it."""
    over = head.plan.of_kind(Over)[known_name("Over", name, head.plan.of_kind(Over), where=head.plan.title)]
    if over.shape != "box" or over.only or over.cases is not None or over.lost:
        what = f"{name} = {over} is more than parts of strokes, which is what a search of a file looks at"
        raise DefinitionError(f'{what}; write them here, over = {{ S = "0 to 200 mm" }}.')
    return dict(over.strokes)


def part_said(head: StudyHead, stroke: str, given: object) -> Any:
    """Return a part of a stroke: one value, or two ends, which may be quantities that follow the design."""
    measures = stroke_measure(head.plan, stroke)
    if isinstance(given, Mapping):
        if set(given) != {"from", "to"}:
            raise DefinitionError(f'{shortened(dict(given))}: write {{ from = "0 mm", to = "200 mm" }}.')
        given = [given["from"], given["to"]]
    if isinstance(given, (list, tuple)):
        if len(given) != 2:
            raise DefinitionError(f"{shortened(given)}: two ends are expected.")
        return tuple(end_said(head, each, measures) for each in given)
    span = parse_span(given, measures) if isinstance(given, str) else None
    if span is not None and len(span) == 3:
        raise DefinitionError(f"{shortened(given)}: a search looks at the whole of a stroke, not at steps of it.")
    return amount_said(given, measures) if span is None else span


def end_said(head: StudyHead, given: object, measures: str) -> Any:
    """Return an end of a stroke's part: a number [SI], or a quantity."""
    if isinstance(given, str) and re.match(r"\s*[^\W\d]", given):
        return CriterionParser(given, head.machine).whole()
    return amount_said(given, measures)


def case_said(head: StudyHead, given: object) -> Any:
    """Return the name of a load case, a list of names, or names with their hours; DefinitionError for an unknown one."""
    cases = head.plan.of_kind(LoadCase)
    if isinstance(given, (list, dict)) and given:
        for each in given:
            known_name("Load case", each, (PLAIN_CASE, *cases), where=head.plan.title)
        return given
    return known_name("Load case", given, (PLAIN_CASE, *cases), where=head.plan.title)


def count_said(given: Any, least: int) -> int:
    """Return a whole number of at least so much."""
    if not is_whole(given) or given < least:
        raise DefinitionError(f"{shortened(given)}: a whole number is expected, at least {least}.")
    return int(given)


def word_said(words: Sequence[str]) -> Callable[[Any], str]:
    """Return what reads one of a few words."""
    return lambda given: one_word("it", given, words)


# Where results go.


def outputs_said(head: StudyHead, kinds: Mapping[str, Sequence[str]]) -> dict[str, tuple[Path, ...]]:
    """Return the files of [outputs] by what they hold, each checked to be writable; mistakes are noted.

    `kinds` are the endings that a file's name may have, by what it holds.
    """
    found: dict[str, tuple[Path, ...]] = {}
    given = head.data.get("outputs", {})
    if not isinstance(given, Mapping):
        head.faults.add(("outputs",), f"{shortened(given)}: a table is expected, such as [outputs] {next(iter(kinds))} = ...")
        return found
    for name, value in given.items():
        with head.faults.at("outputs", name):
            suffixes = kinds[known_name("Output", name, kinds)]
            paths = [head.path_of(each) for each in (value if isinstance(value, list) else [value])]
            for path in paths:
                if path.suffix.lower() not in suffixes:
                    raise DefinitionError(f"{path.name}: the file's name ends in one of {', '.join(suffixes)}.")
                check_output(path)
            found[name] = tuple(paths)
    return found


def check_output(path: Path) -> None:
    """Raise DefinitionError where a file cannot be written."""
    try:
        check_place(path)
    except FileError as error:
        raise DefinitionError(str(error)) from None

