"""The provenance of a document: a hash of its inputs that any process finds again, and the version that calculated it."""

from __future__ import annotations

import hashlib
import inspect
import json
import re
from collections.abc import Mapping
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from ..language import ENGLISH, language
from ..mechanism import Mechanism
from ..plan import written_out

ADDRESS = re.compile(r" at 0x[0-9a-fA-F]+")


def fingerprint(machine: Mechanism, strokes: Mapping[str, Any]) -> str:
    """Return the SHA-256 of a design's inputs in hexadecimal: members, dimensions, loads, load cases, and the strokes looked at.

    It is the same in every process and language; a function among the members counts by its source.
    """
    with language(ENGLISH):
        members = written_out(machine.plan, machine.dimensions)
    functions: dict[str, list[str]] = {}
    for name, member in machine.plan.members.items():
        for _, value in sorted(vars(member).items()):
            if inspect.isfunction(value):
                try:
                    source = inspect.getsource(value)
                except (OSError, TypeError):  # it has none
                    source = value.__qualname__
                functions.setdefault(name, []).append(source)
    inputs = {
        "machine": machine.plan.title,
        "members": {name: ADDRESS.sub("", text) for name, text in members.items()},
        "functions": functions,
        "dimensions": {name: repr(float(value)) for name, value in machine.dimensions.items()},
        "strokes": {name: [repr(float(each)) for each in values] for name, values in strokes.items()},
    }
    return hashlib.sha256(json.dumps(inputs, sort_keys=True, ensure_ascii=True).encode()).hexdigest()


def own_version() -> str:
    """Return the version of this package; "" where it runs from a folder without being installed."""
    try:
        return version("hydrolinkage")
    except PackageNotFoundError:
        return ""
