"""Finished batches in a folder: each a file that is whole or not there, beside a note of which study they belong to."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from functools import partial, singledispatchmethod
from hashlib import blake2b
from io import BytesIO
from pathlib import Path
from types import CodeType, FunctionType, MethodType
from typing import Any

import numpy as np

from ..disk import check_name, in_words, read, replacing
from ..errors import DefinitionError, FileError, cited
from ..mechanism import Mechanism
from .designs import Batch, Designs, Task

# What a function does, as text: its code, that of its module which it calls, and the values that they read from outside.
#
# It tells a changed `measure` from the one that a folder was begun with. Lines, comments and other modules do not enter.

def word(text: str | bytes) -> str:
    """Return a word of 32 characters for a text."""
    return blake2b(text.encode() if isinstance(text, str) else text, digest_size=16).hexdigest()


def fingerprint(function: Any) -> str:
    """Return a word for what a function does."""
    return word(Reader(function).text(function))


def plan_text(machine: Mechanism) -> str:
    """Return the members of a machine as text."""
    return re.sub(r" at 0x[0-9a-f]+", "", f"{type(machine).__qualname__}\n{machine.plan}")


class Reader:
    """Reads values as text. Of what is neither plain data nor a function of the first one's module only the name is read."""

    def __init__(self, first: Any) -> None:
        self.home = getattr(getattr(first, "func", first), "__module__", None)  # of a partial that of its function
        self.seen: set[int] = set()

    @singledispatchmethod
    def text(self, value: Any) -> str:
        """Return a value as text."""
        kind = type(value)
        called = getattr(kind, "__call__", None)  # noqa: B004 - the code of an object that is called like a function
        if isinstance(called, FunctionType) and kind.__module__ == self.home and id(value) not in self.seen:
            self.seen.add(id(value))
            return f"{kind.__qualname__} {self.text(called)} {self.text(vars(value))}"
        return str(getattr(value, "__qualname__", getattr(value, "__name__", kind.__qualname__)))

    @text.register(type(None))
    @text.register(int)
    @text.register(float)
    @text.register(complex)
    @text.register(str)
    @text.register(bytes)
    @text.register(np.generic)
    def _(self, value: Any) -> str:
        return repr(value)

    @text.register(list)
    @text.register(tuple)
    def _(self, value: Collection[Any]) -> str:
        return f"[{', '.join(map(self.text, value))}]"

    @text.register(set)
    @text.register(frozenset)
    def _(self, value: Collection[Any]) -> str:
        return f"{{{', '.join(sorted(map(self.text, value)))}}}"

    @text.register(dict)
    def _(self, value: dict[Any, Any]) -> str:
        return f"{{{', '.join(f'{self.text(key)}: {self.text(each)}' for key, each in value.items())}}}"

    @text.register(np.ndarray)
    def _(self, value: np.ndarray) -> str:
        return f"{value.dtype} {value.shape} {word(value.tobytes()) if value.dtype.kind != 'O' else ''}"

    @text.register(Mechanism)
    def _(self, value: Mechanism) -> str:
        return f"{plan_text(value)} {self.text(dict(value.dimensions))}"

    @text.register(partial)
    def _(self, value: partial[Any]) -> str:
        return self.text([value.func, value.args, value.keywords])

    @text.register(MethodType)
    def _(self, value: MethodType) -> str:
        return self.text([value.__func__, value.__self__])

    @text.register(FunctionType)
    def _(self, value: FunctionType) -> str:
        name = f"{value.__module__}.{value.__qualname__}"
        if value.__module__ != self.home or id(value) in self.seen:
            return name
        self.seen.add(id(value))
        outside = {each: value.__globals__[each] for each in sorted(names_in(value.__code__)) if each in value.__globals__}
        return self.text([name, *code_in(value.__code__), value.__defaults__, value.__kwdefaults__, *cells_of(value), outside])


def names_in(code: CodeType) -> set[str]:
    """Return the names that a code reads, the functions inside it included."""
    return {*code.co_names}.union(*(names_in(each) for each in code.co_consts if isinstance(each, CodeType)))


def code_in(code: CodeType) -> Iterator[Any]:
    """Yield the operations of a code, its names and its constants, of the functions inside it too."""
    yield from (code.co_code, code.co_names, code.co_varnames)
    for each in code.co_consts:
        yield from code_in(each) if isinstance(each, CodeType) else (each,)


def cells_of(function: FunctionType) -> Iterator[Any]:
    """Yield the values that a function closes over."""
    for cell in function.__closure__ or ():
        try:
            yield cell.cell_contents
        except ValueError:  # nothing in it yet
            yield None


NOTE = "study.json"
NAME = re.compile(r"designs-(\d+)-(\d+)-([0-9a-f]{32})\.npy")


@dataclass(frozen=True)
class Shelf:
    """A folder of batches: `designs-START-STOP-CHECK.npy`, an array with a field for each result.

    CHECK follows from the study and from every byte of the file: what is torn, changed or of another study is passed over.
    """

    folder: Path
    key: bytes

    @classmethod
    def of(cls, folder: str | os.PathLike[str], task: Task, designs: Designs) -> Shelf:
        """Return the shelf of a study; DefinitionError where the folder holds another one, with what differs."""
        if not isinstance(folder, (str, os.PathLike)) or folder == "":
            raise DefinitionError(f"folder={cited(folder)}: the path of a folder is expected.")
        place, facts = Path(folder), facts_of(task, designs)
        note = place / NOTE
        there = noted(note)
        if there is None:
            begin(note, facts)
        else:
            check_same(place, there, facts)
        return cls(place, blake2b(json.dumps(facts, sort_keys=True).encode()).digest())

    def check(self, start: int, stop: int, content: bytes) -> str:
        """Return the word that a file's name carries."""
        return blake2b(b"%d %d " % (start, stop) + content, key=self.key, digest_size=16).hexdigest()

    def keep(self, batch: Batch) -> None:
        """Write a batch; FileError where it cannot be written, as on a full disk."""
        values = batch.values or {}
        table = np.empty(batch.stop - batch.start, [(name, array.dtype) for name, array in values.items()])
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


def begin(note: Path, facts: Mapping[str, Any]) -> None:
    """Write which study a folder is of; FileError where it cannot be written."""
    try:
        with in_words(note.parent):
            note.parent.mkdir(parents=True, exist_ok=True)
        with replacing(note) as stream:
            stream.write(json.dumps(facts, indent=2).encode())
    except FileError as error:
        raise FileError(f"{error} Finished batches cannot be kept here; name a folder that can be written.") from error


def noted(note: Path) -> dict[str, Any] | None:
    """Return what a folder says of its study, None where it says nothing; FileError where it cannot be read."""
    check_name(note)
    with in_words(note):
        is_there = note.exists()
    if not is_there:
        return None
    try:
        found = json.loads(read(note))
    except (ValueError, RecursionError) as error:
        raise FileError(f"{note}: it does not say which study is kept here ({error}); take another folder, or delete this one.") from None
    if not isinstance(found, dict):
        raise FileError(f"{note}: it does not say which study is kept here; take another folder, or delete this one.")
    return found


def facts_of(task: Task, designs: Designs) -> dict[str, Any]:
    """Return what makes a study the same: the machine, its dimensions, the designs, what is measured and how."""
    machine, measure = task.machine, task.measure
    facts = {
        "machine": f"{type(machine).__module__}.{type(machine).__qualname__}",
        "members": word(plan_text(machine)),
        **{f"dimension {name}": value for name, value in machine.dimensions.items() if name not in designs.columns},
        "designs": designs.count,
        **{f"array {name}": digest for name, digest in designs.digests().items()},
        "measure": f"{getattr(measure, '__module__', '')}.{getattr(measure, '__qualname__', type(measure).__qualname__)}",
        "its code": fingerprint(measure),
        "piece": task.piece,
        "backend": task.backend,
    }
    found: dict[str, Any] = json.loads(json.dumps(facts))
    return found


def check_same(folder: Path, there: Mapping[str, Any], here: Mapping[str, Any]) -> None:
    """Raise DefinitionError where a folder is of another study, with what differs."""
    differing = [name for name in dict.fromkeys([*here, *there]) if here.get(name) != there.get(name)]
    if differing:
        said = ", ".join(f"{name} ({told(there, name)} there, {told(here, name)} here)" for name in differing[:4])
        more = f" and {len(differing) - 4} more" if len(differing) > 4 else ""
        raise DefinitionError(f"{folder} holds another study; it differs in {said}{more}. Take another folder, or delete this one.")


def told(facts: Mapping[str, Any], name: str) -> str:
    """Return a fact in a sentence; a digest by its first characters."""
    value = facts.get(name, "none")
    return value[:8] if isinstance(value, str) and re.fullmatch(r"[0-9a-f]{32}", value) else str(value)
