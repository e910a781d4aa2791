"""Machines by name: shipped or of another package (entry points), of a module, of a Python file, or of TOML or JSON."""

from __future__ import annotations

import re
import sys
from collections.abc import Mapping
from importlib import import_module
from importlib.util import module_from_spec, spec_from_file_location
from inspect import getblock
from pathlib import Path
from traceback import extract_tb
from types import ModuleType
from typing import Any, TypeVar

from ..disk import OF_FILE, read
from ..errors import DefinitionError, LinkageError, ensure, is_class_of, unknown
from ..mechanism import Mechanism
from ..plugins import guarded
from .listing import OWN, registered

Kind = TypeVar("Kind", bound=Mechanism)


def find(text: str) -> type[Mechanism]:
    """Return the machine that a text names; DefinitionError, with the nearest name, where there is none."""
    entries = registered()
    if text in entries:
        return machine(guarded(entries[text].load, f"The machine {text} ({entries[text].value})"), text)
    place, name = split(text)
    if not (name or place.endswith((".py", ".toml"))):
        from ..sketch import is_foreign, read_sketch

        if is_foreign(text):
            return read_sketch(text).to_class()
    if place.endswith((".toml", ".json")):
        from ..files import load

        ensure(not name, f"{text}: a file of TOML or JSON holds one machine, and no class is named in it; say {place}.")
        return load(text)
    if place.endswith(".py"):
        read(place, most=0)  # a file that is not there is named in words
        return of_module(guarded(lambda: module_of_file(place), place), name, place)
    if name:
        if "" not in sys.path and str(Path.cwd()) not in sys.path:
            sys.path.insert(0, str(Path.cwd()))
        return of_module(guarded(lambda: import_module(place), f"The module {place}"), name, place)
    raise DefinitionError(f"{unknown('Machine', text, entries)} {OWN}")


def design_of_file(file: str, own: str | None) -> Mechanism | None:
    """Return the design that a file holds, by `machine` and `[set]`; None for any other text, and for a file that holds a machine itself.

    `own` is a class that stands for the one the file names; what is code is run only where it is said so.
    """
    if not file.endswith((".toml", ".json")):
        return None
    from ..files.source import source
    from ..files.study_file import StudyHead

    data = source(file).data
    if not isinstance(data, Mapping) or not isinstance(data.get("machine"), str) or data.keys() - {"machine", "set", "doc"}:
        return None

    def kind(text: str, base: Path) -> type[Mechanism]:
        place, name = split(text)
        if text in registered() or own:
            return find(own or text)
        ensure(not (place.endswith(".py") or name), f"{file}: {text} is code, and a file runs none unasked; say --machine {text}.")
        return find(str(base / text))

    return StudyHead.of(file, (), kind, lambda _: {}).machine


def split(text: str) -> tuple[str, str]:
    """Return the place and the class of `place:Class`; the class is "" where none is named."""
    place, colon, name = text.rpartition(":")
    return (place, name) if colon and name.isidentifier() else (text, "")


def module_of_file(place: str) -> ModuleType:
    """Return a file as a module; it may import its neighbours, as a script may."""
    path = Path(place).resolve()
    spec = spec_from_file_location(f"{OF_FILE}{path.stem}", path)
    assert spec is not None and spec.loader is not None  # the name ends in .py
    module = module_from_spec(spec)
    sys.modules[spec.name] = module
    if str(path.parent) not in sys.path:
        sys.path.insert(0, str(path.parent))
    try:
        spec.loader.exec_module(module)
    except LinkageError as error:
        lines = [each.lineno for each in extract_tb(error.__traceback__) if each.filename == str(path)]
        line = line_of(error.member, path.read_text("utf-8").split("\n"), lines[-1] or 0) if lines else 0
        error.args = (f"{error} ({place}, line {line})",) if line else error.args
        raise
    return module


def line_of(member: str, text: list[str], line: int) -> int:
    """Return the line of a member of a class that begins at a line, 0 where it has none there; the line itself of any other fault."""
    if not member or not text[line - 1].lstrip().startswith("class "):
        return line
    own = re.compile(rf"\s+{re.escape(member.partition('.')[0])}\s*[:=]")
    return next((line + at for at, each in enumerate(getblock([f"{each}\n" for each in text[line - 1 :]])) if own.match(each)), 0)


def of_module(module: ModuleType, name: str, place: str) -> type[Mechanism]:
    """Return a module's machine of that name, or its only one."""
    own = {key: each for key, each in vars(module).items() if is_machine(each) and each.__module__ == module.__name__}
    if name:
        if name not in vars(module):
            raise unknown("Machine", name, own, where=place)
        return machine(vars(module)[name], f"{place}:{name}")
    choice = f"say {place}:Class, one of {', '.join(own)}" if own else "declare a class of Mechanism in it"
    ensure(len(own) == 1, f"{place} holds {len(own) or 'no'} machine{'s' if len(own) > 1 else ''}; {choice}.")
    return machine(next(iter(own.values())), place)


def is_machine(found: object) -> bool:
    """Return whether something is a class of mechanism."""
    return is_class_of(found, Mechanism) and found is not Mechanism


def machine(found: Any, what: str) -> type[Mechanism]:
    """Return it as a class of mechanism; DefinitionError where it is none."""
    ensure(is_machine(found), f"{what} is not a class of Mechanism. {OWN}")
    ensure(found.plan.points, f"{what}: {found.__name__} declares no points; begin with A = Ground(0, 0) and a step such as Crank or Dyad.")
    return found  # type: ignore[no-any-return]
