"""The parts of every study file: the machine and its settings, ranges and values with units, and the outputs.

    machine = "three_point_hitch"               # of `hydrolinkage list`, a machine's file, or package.module:Class of a trusted package
    set = { OB = "310 mm", M = ["220 mm", "950 mm"] }

A range is `"270 mm to 330 mm"`, `"270 to 330 mm in steps of 5 mm"`, `"within 60 mm"` of the present value; a list is the choices.

A table holds the keywords of one function. What reads a key stands at the keyword, `over: Annotated[Keywords | None, over_said] = None`, or
in a mapping by names beside the function. It takes the head of the file and what stands under the key.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import field, replace
from inspect import Parameter, signature
from pathlib import Path
from typing import Any, TypeAlias, get_type_hints

from ..disk import check_place
from ..errors import DefinitionError, FileError, cited, ensure, is_listed, known_name, one_word, require, require_type, unknown
from ..frozen import immutable
from ..mechanism import Mechanism
from ..motion import Over, case_named, stroke_measure
from ..plan import Plan, plan_measure
from ..quantities import is_number, is_whole
from ..study.problem import ranges_of
from ..study.space import Space, around, known_dimension
from ..study.tolerances import Tolerance, tolerances_of
from ..study.variants import is_side
from ..units import parse, parse_span
from .expression import criterion_of
from .source import TEXT, FileTable, Keywords, Mistakes, Source, by_whole_names, each_of, listed, source

FindMachine: TypeAlias = Callable[[str, Path], type[Mechanism]]
"""What returns the class of a machine by its text and the folder of the file that names it."""
Settings: TypeAlias = Callable[[type[Mechanism]], Keywords]
"""What returns dimensions [SI] of a machine's class that stand above those of the file."""

PICTURE_SUFFIXES = (".png", ".svg", ".pdf")
RANGE_WORDS = 'a range such as "270 to 330 mm", "270 to 330 mm in steps of 5 mm" or "within 60 mm", or a list of choices'

_AROUND = re.compile(r"\s*(?:within|around|\+-|\+/-|±)\s*(?P<by>.+?)(?:\s+(?:in steps of|by)\s+(?P<step>.+?))?\s*\Z")


@immutable
class StudyHead:
    """A study file as it is read: its tables, the mistakes found so far, the machine, and the folder that its paths start from."""

    data: FileTable
    faults: Source
    machine: Mechanism
    base: Path
    machines: Mapping[str, Mechanism] = field(default_factory=dict)
    """All machines by the file's texts, where it names a list of them."""
    found: Keywords = field(default_factory=dict)
    """The keywords that are read already, by name, those of the table around among them, and the defaults of the others."""
    section: str = ""
    """The section that is read, "" of what stands above all sections."""

    @classmethod
    def of(
        cls, path: str | os.PathLike[str], keys: Sequence[str], find: FindMachine, settings: Settings, *, several: bool = False
    ) -> StudyHead:
        """Return the head of a file that may have some keys beside `machine`, `set` and `doc`; FileError where there is no machine.

        With `several` the machine may be a list of them.
        """
        faults = source(path)
        base = Path() if faults.name == TEXT else Path(path).parent
        known = ("machine", "set", "doc", *keys)
        data = faults.data if isinstance(faults.data, Mapping) else {}
        if "strokes" in data.keys() - {"machine", *known}:
            told = f'name it in another file, machine = "{faults.name}", and what is asked of it'
            raise FileError(f"{faults.name} is a machine itself; {told}.")
        for key in data:
            if key not in known:
                faults.add((str(key),), str(unknown("Key", key, known)))
        given = data.get("machine")
        texts: list[Any] = given if several and isinstance(given, list) and given else [given]
        machines: list[Mechanism] = []
        for text in texts:
            kind = None
            with faults.at_key("machine"):
                if not isinstance(text, str) or not text:
                    what = "the machine is missing" if text is None else f"{cited(text)} is no name in quotes"
                    raise DefinitionError(f'{what}; begin with machine = "three_point_hitch", a name of `hydrolinkage list` or a file.')
                kind = find(text, base)
            if kind is not None:
                with faults.at_key("set"):
                    machines.append(kind(**settings_said(kind.plan, data.get("set", {}), faults)).replaced(**settings(kind)))
        faults.check()
        return cls(data, faults, machines[0], base, dict(zip(texts, machines, strict=True)) if isinstance(given, list) else {})

    @property
    def plan(self) -> Plan:
        """The machine's plan."""
        return self.machine.plan


Read: TypeAlias = Callable[[StudyHead, Any], Any]
"""What reads what stands under a key; DefinitionError for what it cannot be, SeveralError for several mistakes under keys of its own."""


def keywords_read(
    head: StudyHead, function: Callable[..., object], given: FileTable, readers: Mapping[str, Read] | None = None
) -> Keywords:
    """Return the keywords of a function that a table gives, each read as `readers` say, else as its annotation does.

    They are read in their order: `head.found` has those above. For what must be given and is not, the message has the annotation's example;
    without one it is read as an empty table. SeveralError with all mistakes, each under its key.
    """
    mistakes, parameters = Mistakes(), signature(function).parameters
    hints = {} if readers is not None else get_type_hints(function, include_extras=True)
    known = {name: hint.__metadata__ for name, hint in hints.items() if hasattr(hint, "__metadata__")}
    known |= {name: (read,) for name, read in (readers or {}).items()}
    for key in given:
        if key not in known:
            mistakes.add((str(key),), str(unknown("Key", key, known)))
    defaults = {name: each.default for name, each in parameters.items() if each.default is not Parameter.empty}
    head = replace(head, found=head.found | defaults)
    for name, (read, *example) in known.items():
        if name in given or (name in parameters and name not in defaults):
            with mistakes.at_key(name):
                if name not in given and example:
                    raise DefinitionError(f"{name} is missing; write {example[0]}.")
                head.found[name] = read(head, given.get(name, {}))
    mistakes.check()
    return {name: head.found[name] for name in known if name in given}


def file_path(head: StudyHead, given: object) -> Path:
    """Return a path as it is meant: relative to the file's own folder. DefinitionError for anything else."""
    text = require_type("", given, str, "is no path in quotes")
    require(text.strip(), "", given, "is no path in quotes")
    return head.base / text


# Values: numbers in SI, or texts with a unit that measures what it should.


def by_dimensions(given: object, what: str, read: Callable[[str, Any], Any], words: Sequence[str] = ()) -> dict[Any, Any]:
    """Return the results of reading a table's entries, by the whole names of dimensions; SeveralError, each mistake under its name."""
    given = require_type(what, given, Mapping, f"a table by the names of dimensions is expected, such as [{what}] OB = ..")
    return dict(each_of(by_whole_names(given, words), lambda name, value: (name, read(name, value))))


def settings_said(plan: Plan, given: object, faults: Source) -> Keywords:
    """Return dimensions [SI] by name; each mistake is noted, and the other names are read."""
    found: Keywords = {}

    def read(name: str, value: object) -> None:
        with faults.at_key("set", name):
            found[name] = value_said(plan, name, value)

    by_dimensions(given, "set", read)
    return found


def measure_of_name(plan: Plan, name: str) -> str:
    """Return the kind of a dimension, "length" for a point; "" where nothing tells it."""
    known = name in plan.table.spellings
    return plan_measure(plan, plan.table.spellings[name][0]) if known else "length" if f"{name}.x" in plan.table.spellings else ""


def amount_said(given: Any, measures: str) -> float:
    """Return a number [SI], or that of a text with a unit of the right kind; DefinitionError for anything else."""
    if isinstance(given, str):
        return parse(given, measures)
    ensure(is_number(given), f'{cited(given)} is no number and no text with a unit, such as "60 mm".')
    return float(given)


def value_said(plan: Plan, name: str, given: object) -> Any:
    """Return the value of a dimension [SI], of a point a pair."""
    measures, spellings = measure_of_name(plan, name), plan.table.spellings
    if is_listed(given):
        expected = "one value expected" if name in spellings else "two coordinates expected"
        require(name not in spellings and len(given) == 2, "", given, expected)
        return tuple(amount_said(each, measures) for each in given)
    require(f"{name}.x" not in spellings, "", given, f'{name} is a point; write its two coordinates, ["220 mm", "950 mm"]')
    return amount_said(given, measures)


# Ranges and choices.

RANGE_KEYS = ("from", "to", "step", "around", "choices")


def vary_said(head: StudyHead, given: object) -> dict[Any, Any]:
    """Return `vary` as `optimise` takes it; SeveralError with all mistakes, each under its name."""

    def varied(name: str, value: object) -> dict[Any, Any]:
        names = tuple(part.strip() for part in name.split(","))
        for part in names:
            if part not in head.plan.points and not is_side(part):
                known_dimension(head.machine, part)
        found: dict[Any, Any] = {}
        if len(names) == 1:
            found[names[0]] = range_said(value, head.plan, names[0])
        else:
            found[names] = []
            for row in require_type("", value, list, f"rows are expected, a list [...] with {len(names)} values each"):
                fits = isinstance(row, list) and len(row) == len(names)
                require(fits, "", row, f"is no row of {', '.join(names)}; it has a value for each of them")
                kinds = [measure_of_name(head.plan, each) for each in names]
                values = zip(names, row, kinds, strict=True)
                found[names].append([each if is_side(part) else amount_said(each, kind) for part, each, kind in values])
        Space.of(head.machine, found)
        return found

    found = by_dimensions(given, "vary", varied, RANGE_KEYS)
    where = f"{head.section}.vary" if head.section else "vary"
    ensure(found, f'nothing varies; write [{where}] OB = "270 to 330 mm": {RANGE_WORDS}.')
    return {name: said for part in found.values() for name, said in part.items()}


def range_said(given: object, plan: Plan, name: str) -> Any:
    """Return the range of a dimension as `optimise` takes it: a tuple, `around(...)`, or a list of choices."""
    measures, ends = measure_of_name(plan, name), None
    match given:
        case list() | tuple():
            return [each if is_side(name) else value_said(plan, name, each) for each in given]
        case Mapping():
            for key in given:
                known_name("Key", key, RANGE_KEYS)
            keys = given.keys() - {"step"}
            sound = keys in ({"from", "to"}, {"around"}) or given.keys() == {"choices"}
            require(sound, "", dict(given), "write { from, to, step }, { around, step } or { choices = [...] }")
            if keys == {"choices"}:
                return range_said(given["choices"], plan, name)
            values = [amount_said(given[key], measures) for key in ("around", "from", "to", "step") if key in given]
            return around(*values) if "around" in given else tuple(values)
        case str():
            near = _AROUND.match(given)
            if near is not None:
                return around(*(parse(each, measures) for each in near.group("by", "step") if each is not None))
            ends = parse_span(given, measures)
    require(ends is not None, "", given, f"is no range; write {RANGE_WORDS}")
    return ends


# Tolerances.

TOLERANCE_KEYS = ("limits", "law")


def tolerances_said(key: str, head: StudyHead, given: object) -> Keywords:
    """Return the tolerances under a key by the names of dimensions."""

    def one(name: str, value: object) -> Tolerance:
        tolerances_of(head.plan, {name: 0.0})
        return tolerance_said(value, measure_of_name(head.plan, name))

    found = by_dimensions(given, key, one, TOLERANCE_KEYS)
    ensure(found, f'no tolerance is given; write {key} = {{ OB = "0.1 mm", CD = ["-0.1 mm", "0.2 mm"] }}.')
    return found


def tolerance_said(given: object, measures: str) -> Tolerance:
    """Return a tolerance: how far to either side, the two limits, or { limits, law }."""
    match given:
        case Mapping():
            for each in given:
                known_name("Key", each, TOLERANCE_KEYS)
            sound = "limits" in given and not isinstance(given["limits"], Mapping)
            require(sound, "", dict(given), 'write { limits = "0.1 mm", law = "uniform" }')
            return replace(tolerance_said(given["limits"], measures), law=given.get("law", "normal"))
        case list():
            require(len(given) == 2, "", given, 'two limits are expected, such as ["-0.1 mm", "0.2 mm"]')
            return Tolerance((amount_said(given[0], measures), amount_said(given[1], measures)))
        case str():
            given = given.strip().removeprefix("+-").removeprefix("±")
    return Tolerance(amount_said(given, measures))


# Strokes, load cases, words and numbers.


def over_said(head: StudyHead, given: object) -> Keywords:
    """Return the parts of the strokes that are looked at, as `optimise` takes them; SeveralError with all mistakes, each under its stroke.

    A text is the name of an `Over` that the machine declares.
    """
    plan = head.plan
    if isinstance(given, str):
        over = plan.of_kind(Over)[known_name("Over", given, plan.of_kind(Over), where=plan.title)]
        if over.shape != "box" or over.only or over.cases is not None or over.lost:
            what = f"{given} = {over} is more than parts of strokes, which is what a search of a file looks at"
            raise DefinitionError(f'{what}; write them here, over = {{ S = "0 to 200 mm" }}.')
        return dict(over.strokes)
    what = 'a table of strokes is expected, such as over = { S = "0 to 200 mm" }, or the name of an Over that the machine declares'
    given = require_type("", given, Mapping, what)

    def part(name: str, value: object) -> tuple[str, object]:
        said = part_said(head, known_name("Stroke", name, plan.strokes, where=plan.title), value)
        ranges_of(head.machine, {name: said})
        return name, said

    return dict(each_of(by_whole_names(given), part))


def part_said(head: StudyHead, stroke: str, given: object) -> Any:
    """Return a part of a stroke: one value, or two ends, which may be quantities that follow the design."""
    measures = stroke_measure(head.plan, stroke)
    match given:
        case Mapping():
            require(set(given) == {"from", "to"}, "", dict(given), 'write { from = "0 mm", to = "200 mm" }')
            return part_said(head, stroke, [given["from"], given["to"]])
        case [*ends]:
            require(len(ends) == 2, "", given, "two ends are expected")
            named = [isinstance(each, str) and re.match(r"\s*[^\W\d]", each) is not None for each in ends]
            pairs = zip(ends, named, strict=True)
            return tuple(criterion_of(each, head.machine) if is_named else amount_said(each, measures) for each, is_named in pairs)
        case str():
            span = parse_span(given, measures)
            require(span is None or len(span) != 3, "", given, "a search looks at the whole of a stroke, not at steps of it")
            return amount_said(given, measures) if span is None else span
    return amount_said(given, measures)


def case_said(head: StudyHead, given: object) -> Any:
    """Return the name of a load case, a list of names, or names with their hours; DefinitionError for an unknown one."""
    if isinstance(given, dict) and given:
        return {case_named(head.plan, each): hours for each, hours in given.items()}
    return [case_named(head.plan, each) for each in given] if isinstance(given, list) and given else case_named(head.plan, given)


def count_at_least(least: int, head: StudyHead, given: Any) -> int:
    """Return a whole number of at least so much."""
    require(is_whole(given) and given >= least, "", given, f"a whole number is expected, at least {least}")
    return int(given)


def word_said(words: Sequence[str], head: StudyHead, given: Any) -> str:
    """Return one of a few words."""
    return one_word("it", given, words)


def texts_said(given: object, read: Callable[[object], Any]) -> list[Any]:
    """Return the results of reading each text of a list, or a single one; SeveralError with all mistakes, each under its number."""
    return each_of(enumerate(listed(given), 1), lambda number, text: read(text))


# Where results go.


def outputs_said(head: StudyHead, kinds: Mapping[str, Sequence[str]]) -> dict[str, tuple[Path, ...]]:
    """Return the files of [outputs] by their contents, each checked to be writable; mistakes are noted.

    `kinds` are the endings that a file's name may have, by what it holds.
    """

    def checked(name: str, value: object) -> tuple[str, tuple[Path, ...]]:
        suffixes = kinds[known_name("Output", name, kinds)]
        paths = tuple(file_path(head, each) for each in listed(value))
        for path in paths:
            ensure(path.suffix.lower() in suffixes, f"{path.name}: the file's name ends in one of {', '.join(suffixes)}.")
            try:
                check_place(path)
            except FileError as error:
                raise DefinitionError(str(error)) from None
        return name, paths

    found: dict[str, tuple[Path, ...]] = {}
    with head.faults.at_key("outputs"):
        given = head.data.get("outputs", {})
        given = require_type("", given, Mapping, f"a table is expected, such as [outputs] {next(iter(kinds))} = ..")
        found = dict(each_of(given.items(), checked))
    return found
