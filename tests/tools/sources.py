"""The sources of the three packages, read and parsed once for all that looks through them."""

import ast
import gc
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGES = ("linkage", "hydraulics", "mechanisms")


@cache
def sources() -> dict[str, str]:
    """Return the text of every file of the three packages by its path, counted from the checkout."""
    paths = sorted(path for package in PACKAGES for path in (ROOT / package).rglob("*.py"))
    return {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8") for path in paths}


@cache
def parsed(source: str) -> ast.Module:
    """Return the tree of a source. It is kept, so it is no garbage: a collector that went through all trees would take longest."""
    gc.disable()
    try:
        return ast.parse(source)
    finally:
        gc.freeze()
        gc.enable()


@cache
def nodes(source: str) -> tuple[ast.AST, ...]:
    """Return all nodes of a source."""
    return tuple(ast.walk(parsed(source)))
