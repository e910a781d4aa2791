"""Finished batches in a folder: each a file that is whole or not there, beside a note of which study they belong to."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from hashlib import blake2b
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from ..disk import check_name, in_words, read, replacing
from ..errors import DefinitionError, FileError, cited
from .batch import Batch, Task
from .designs import Designs
from .fingerprint import fingerprint, plan_text, word

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
