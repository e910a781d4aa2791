"""Finished batches in a folder: each a file that is whole or not there, beside a note of which study they belong to."""

from __future__ import annotations

import ast
import json
import os
import re
import sys
from collections.abc import Container, Iterator, Mapping
from functools import partial
from hashlib import blake2b
from inspect import getsource
from io import BytesIO
from pathlib import Path
from textwrap import dedent
from types import CellType, FunctionType, MethodType
from typing import Any, TypeAlias

import numpy as np

from ..disk import check_name, in_words, read, replacing
from ..errors import DefinitionError, FileError, require
from ..frozen import record
from ..mechanism import Mechanism
from .designs import Batch, Designs, Task

NOTE = "study.json"
NAME = re.compile(r"designs-(\d+)-(\d+)-([0-9a-f]{32})\.npy")

Facts: TypeAlias = Mapping[str, object]
"""What makes a study the same, by name, as JSON holds it."""


@record
class Checkpoint:
    """A folder of batches: `designs-START-STOP-CHECK.npy`, an array with a field for each result.

    CHECK follows from the study and from every byte of the file: what is torn, changed or of another study is passed over.
    """

    folder: Path
    key: bytes

    @classmethod
    def of(cls, folder: str | os.PathLike[str], facts: Facts, what: str = "study") -> Checkpoint:
        """Return the checkpoint of a study; DefinitionError where the folder holds another one, with the differences."""
        require(isinstance(folder, (str, os.PathLike)) and folder != "", "folder", folder, "the path of a folder is expected")
        place = Path(folder)
        note = place / NOTE
        known = read_note(note)
        if known is None:
            try:
                with in_words(place):
                    place.mkdir(parents=True, exist_ok=True)
                with replacing(note) as stream:
                    stream.write(json.dumps(facts, indent=2).encode())
            except FileError as error:
                raise FileError(f"{error} Finished batches cannot be kept here; name a folder that can be written.") from error
        there = facts if known is None else known
        differing = [name for name in dict.fromkeys([*facts, *there]) if facts.get(name) != there.get(name)]
        if differing:
            words = []
            for name in differing[:4]:
                pair = [str(each.get(name, "none")) for each in (there, facts)]
                old, new = (each[:8] if re.fullmatch(r"[0-9a-f]{32}", each) else each for each in pair)  # a digest by its first characters
                words.append(f"{name} ({old} there, {new} here)")
            said = ", ".join(words)
            more = f" and {len(differing) - 4} more" if len(differing) > 4 else ""
            raise DefinitionError(f"{place} holds another {what}; it differs in {said}{more}. Take another folder, or delete this one.")
        return cls(place, blake2b(json.dumps(facts, sort_keys=True).encode()).digest())

    def stage(self, name: str, content: bytes) -> Checkpoint:
        """Return the checkpoint of a stage of the study, in a folder of its own; `content` is the stage's initial state."""
        place = self.folder / name
        with in_words(place):
            place.mkdir(exist_ok=True)
        return type(self)(place, blake2b(content, key=self.key).digest())

    def check(self, start: int, stop: int, content: bytes) -> str:
        """Return the word that a file's name carries."""
        return blake2b(b"%d %d " % (start, stop) + content, key=self.key, digest_size=16).hexdigest()

    def keep(self, batch: Batch) -> None:
        """Write a batch; FileError where it cannot be written, as on a full disk."""
        values = batch.values or {}
        table = np.empty(batch.stop - batch.start, [(name, array.dtype, array.shape[1:]) for name, array in values.items()])
        for name, array in values.items():
            table[name] = array
        stream = BytesIO()
        np.save(stream, table, allow_pickle=False)
        content = stream.getvalue()
        name = f"designs-{batch.start:09d}-{batch.stop:09d}-{self.check(batch.start, batch.stop, content)}.npy"
        try:
            with replacing(self.folder / name) as file:
                file.write(content)
        except FileError as error:
            what = f"{error} Designs {batch.start} to {batch.stop - 1} cannot be kept"
            raise FileError(f"{what}; make room or the folder writable, the same call goes on from what is kept.") from error

    def batches(self) -> Iterator[Batch]:
        """Yield the batches that are whole, in order."""
        for path in sorted(self.folder.glob("designs-*.npy")):
            match = NAME.fullmatch(path.name)
            if match is None:
                continue
            start, stop, content = int(match[1]), int(match[2]), read(path)
            if self.check(start, stop, content) == match[3]:
                table = np.load(BytesIO(content), allow_pickle=False)
                yield Batch(start, stop, kept=True, values={name: table[name] for name in table.dtype.names})


def how_far(done: int, total: int, what: str, place: Path | None) -> str:
    """Return how much of some work is done, and where it is kept, if anywhere."""
    if place is None:
        return f"{done} of {total} {what} are done and lost with this call; a folder= would have kept them."
    return f"{done} of {total} {what} are done and kept in {place}; the same call goes on from there."


def read_note(note: Path) -> dict[str, object] | None:
    """Return the note of a study in a folder, None without one; FileError where it cannot be read."""
    check_name(note)
    with in_words(note):
        is_there = note.exists()
    if not is_there:
        return None
    try:
        found, why = json.loads(read(note)), ""
    except (ValueError, RecursionError) as error:
        found, why = None, f" ({error})"
    if not isinstance(found, dict):
        raise FileError(f"{note}: it does not say which study is kept here{why}; take another folder, or delete this one.")
    return found


def facts_of(task: Task, designs: Designs, version: str | int) -> dict[str, object]:
    """Return the facts that identify a study: the machine, its dimensions, the designs, the measures and the method."""
    machine, measure = task.machine, task.measure
    facts = {
        **facts_of_machine(machine, designs.columns),
        "designs": designs.count,
        **{f"array {name}": found for name, found in designs.digests().items()},
        "measure": f"{getattr(measure, '__module__', '')}.{getattr(measure, '__qualname__', type(measure).__qualname__)}",
        "its code": digest(measure_text(measure, has_version=version != "")),
        "version": version,
        "piece": task.piece,
        "backend": task.backend,
    }
    return facts_as_json(facts)


def facts_of_machine(machine: Mechanism, varied: Container[str]) -> dict[str, object]:
    """Return the facts that identify a machine, except the dimensions that are varied."""
    return {
        "machine": f"{type(machine).__module__}.{type(machine).__qualname__}",
        "members": digest(plan_text(machine)),
        **{f"dimension {name}": value for name, value in machine.dimensions.items() if name not in varied},
    }


def facts_as_json(facts: Facts) -> dict[str, object]:
    """Return facts as a file gives them back."""
    found: dict[str, object] = json.loads(json.dumps(facts))
    return found


# What is measured, as text. The source text of a function is the same under every version of Python, its bytecode is not.


def digest(text: str | bytes) -> str:
    """Return 32 characters that stand for a text."""
    return blake2b(text.encode() if isinstance(text, str) else text, digest_size=16).hexdigest()


def plan_text(machine: Mechanism) -> str:
    """Return the members of a machine as text."""
    return re.sub(r" at 0x[0-9a-f]+", "", f"{type(machine).__qualname__}\n{machine.plan}")


def measure_text(measure: object, has_version: bool = False) -> str:
    """Return the source text of a function, of those of its module that it names, and the values that they read from outside.

    Plain data stand as they are, functions and classes of the module by their source; of anything else only the name is read. Raises
    DefinitionError for a lambda, and for a function whose source cannot be found, unless a version is said for it.
    """
    home = getattr(getattr(measure, "func", measure), "__module__", None)  # of a partial that of its function
    seen: set[int] = set()

    def text(value: Any) -> str:
        match value:
            case np.generic():
                return repr(value.item())  # before the plain numbers, of which NumPy's are kinds that print as its version does
            case None | int() | float() | complex() | str() | bytes():
                return repr(value)
            case np.ndarray():
                return f"{value.dtype} {value.shape} {digest(value.tobytes()) if value.dtype.kind != 'O' else ''}"
            case list() | tuple():
                return f"[{', '.join(map(text, value))}]"
            case set() | frozenset():
                return f"{{{', '.join(sorted(map(text, value)))}}}"
            case dict():
                return text([*value.items()])
            case Mechanism():
                return f"{plan_text(value)} {text(dict(value.dimensions))}"
            case partial():
                return text([value.func, value.args, value.keywords])
            case MethodType():
                return text([value.__func__, value.__self__])
        is_named = isinstance(value, (FunctionType, type))
        name = str(getattr(value, "__qualname__", getattr(value, "__name__", type(value).__qualname__)))
        if (value if is_named else type(value)).__module__ != home or id(value) in seen:
            return f"{value.__module__}.{name}" if is_named else name
        seen.add(id(value))
        if not is_named:  # an object of a class of the module
            return f"{text(type(value))} {text(getattr(value, '__dict__', None))}"
        try:
            source = None if value.__name__ == "<lambda>" else dedent(getsource(value)).strip()
        except (OSError, TypeError):
            source = None
        if source is None and isinstance(value, FunctionType) and not has_version:
            lacks = "is a lambda, without source text of its own" if name.endswith("<lambda>") else "has no source text that is found"
            remedy = "define it by `def` in a file, or say version=1 and count it up when you change it"
            raise DefinitionError(f"measure: {home}.{name} {lacks}, so that a folder cannot tell it from another one; {remedy}.")
        return text([f"{home}.{name}", source, outside_values(value, source or "")])

    return text(measure)


def outside_values(value: FunctionType | type, source: str) -> dict[str, object]:
    """Return the values that a function or a class reads from its defaults and from the functions and the module around it, by name."""
    found: dict[str, object] = {}
    around = vars(sys.modules[value.__module__])
    if isinstance(value, FunctionType):
        cells = zip(value.__code__.co_freevars, value.__closure__ or (), strict=True)
        found = {name: cell.cell_contents for name, cell in cells if cell != CellType()}  # one with nothing in it yet equals an empty one
        found |= {"its defaults": [value.__defaults__, value.__kwdefaults__]}
        around = value.__globals__
    try:
        names = [each for each in ast.walk(ast.parse(source)) if isinstance(each, ast.Name)]
    except SyntaxError:  # a part of an expression in brackets
        names = []
    inside = {each.id for each in names if not isinstance(each.ctx, ast.Load)}
    return found | {name: around[name] for name in sorted({each.id for each in names} - inside - found.keys()) if name in around}
