"""The sources of the three packages, read and parsed once for all that looks through them."""

import ast
import gc
from collections import defaultdict
from functools import cache
from pathlib import Path
from typing import Any

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
def nodes(source: str) -> dict[type, list[Any]]:
    """Return all nodes of a source by their kinds, those of one kind in the order of `ast.walk`: each look needs few kinds."""
    found: dict[type, list[Any]] = defaultdict(list)
    walked: list[ast.AST] = [parsed(source)]
    for node in walked:
        found[type(node)].append(node)
        for value in vars(node).values():
            if isinstance(value, ast.AST):
                walked.append(value)
            elif isinstance(value, list):
                walked += [each for each in value if isinstance(each, ast.AST)]
    return found
