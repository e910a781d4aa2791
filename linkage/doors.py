"""Functions of the front door whose rooms bring heavy libraries: a room is loaded when its function is first called.

Each is written once, in its room. Until that is loaded, its signature and its docstring are read from the source.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable
from functools import update_wrapper
from importlib import import_module
from pathlib import Path
from typing import Any

from .reports import NOTHING


def late(module: str, name: str) -> Callable[..., Any]:
    """Return a function that loads the one with this name of a module of this package, ".pictures.film", when it is called."""

    def call(*arguments: object, **options: object) -> object:
        return getattr(import_module(module, __package__), name)(*arguments, **options)

    path = Path(__file__).parent.joinpath(*module.split(".")).with_suffix(".py")
    text = path.read_text(encoding="utf-8")
    *_, begun = re.finditer(rf"^def {name}\(", text, re.MULTILINE)  # overloads stand above it
    docstring = re.compile(r'^    """.*?"""$', re.MULTILINE | re.DOTALL).search(text, begun.start())
    assert docstring is not None, f"{path}: {name} says nothing of itself"
    tree = ast.parse(f"from __future__ import annotations\n{text[begun.start() : docstring.end()]}")
    ast.increment_lineno(tree, text.count("\n", 0, begun.start()) - 1)
    space: dict[str, Any] = {"__name__": __package__, "NOTHING": NOTHING}
    exec(compile(tree, str(path), "exec"), space)
    return update_wrapper(call, space[name])
