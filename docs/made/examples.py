"""What the examples of a page draw or write, shown behind their block; of the others those alone are run that a picture needs."""

from __future__ import annotations

import ast
import contextlib
import doctest
import io
import os
import re
import shutil
import sys
import tempfile
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

PICTURE = re.compile(r"^<Picture\b.*>\n", re.MULTILINE)
WRITTEN = re.compile(r"^'[\w.-]+\.(?:html|gif|svg|xlsx|dxf|pdf)'$", re.MULTILINE)
FENCE = "```"


def shows(text: str) -> bool:
    """Return whether an example of a page gives a picture, or the name of a file it wrote."""
    return bool(PICTURE.search(text) or WRITTEN.search(text))


def make(page: str, root: Path, folder: Path) -> dict[str, list[str]]:
    """Return the Markdown that shows what each block of a page's examples gave, by the line of its closing fence; files into a folder."""
    text = (root / f"{page}.md").read_text(encoding="utf-8")
    found: dict[str, list[str]] = {}
    for line, result in results(text):
        place = f"{page.replace('/', '_')}_{sum(map(len, found.values())) + 1}"
        found.setdefault(str(closing_fence(text, line)), []).append(shown(result, place, folder))
    return found


def results(text: str) -> Iterator[tuple[int, Any]]:
    """Yield the line and the result of each example that gives a figure, or the path of a file that it wrote."""
    names: dict[str, Any] = {"__name__": "__main__"}
    home, hook = Path.cwd(), sys.displayhook
    given: list[Any] = []
    with tempfile.TemporaryDirectory() as scratch, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            os.chdir(scratch)
            sys.displayhook = given.append
            for example in needed(doctest.DocTestParser().get_examples(text)):
                given.clear()
                with contextlib.redirect_stdout(io.StringIO()):
                    exec(compile(example.source, "<page>", "single"), names)
                for each in given:
                    if isinstance(each, Figure):
                        yield example.lineno, each
                    elif isinstance(each, str) and WRITTEN.match(repr(each)) and Path(each).exists():
                        yield example.lineno, Path(each).resolve()
        finally:
            sys.displayhook = hook
            os.chdir(home)


def needed(examples: list[doctest.Example]) -> list[doctest.Example]:
    """Return the examples that show something or act, and those that set what these use; what only prints is left to the tests."""
    found: list[doctest.Example] = []
    used: set[str] = set()
    for example in reversed([each for each in examples if not each.options.get(doctest.SKIP)]):
        body = ast.parse(example.source).body
        nodes = [node for statement in body for node in ast.walk(statement)]
        names = [node for node in nodes if isinstance(node, ast.Name)]
        loaded = {node.id for node in names if isinstance(node.ctx, ast.Load)}
        sets = {node.id for node in names if not isinstance(node.ctx, ast.Load)} - {"_"}  # what is put there is done for its effect
        sets |= {node.name for node in nodes if isinstance(node, ast.ClassDef | ast.FunctionDef)}
        changed = {node.value.id for node in nodes if isinstance(node, ast.Subscript | ast.Attribute) and changes(node)}
        acts = any(isinstance(node, ast.Import | ast.ImportFrom) for node in nodes) or not (example.want or sets)
        if acts or shows(example.want) or used & (sets | changed):
            found.append(example)
            used |= loaded
    return found[::-1]


def changes(node: ast.Subscript | ast.Attribute) -> bool:
    """Return whether a row or an attribute of a name is set there."""
    return isinstance(node.ctx, ast.Store) and isinstance(node.value, ast.Name)


def closing_fence(text: str, line: int) -> int:
    """Return the line that closes the block in which a line stands, both counted from 0."""
    lines = text.splitlines()
    return next(number for number in range(line, len(lines)) if lines[number].startswith(FENCE))


def shown(result: Figure | Path, name: str, folder: Path) -> str:
    """Return the Markdown that shows a picture or a file, which is put into a folder under a name."""
    if isinstance(result, Figure):
        result.savefig(folder / "figures" / f"{name}.png")
        return f"![what the line above draws](/_generated/figures/{name}.png)"
    if result.suffix in (".gif", ".svg"):
        shutil.copy(result, folder / "figures" / f"{name}{result.suffix}")
        return f"![what the line above draws](/_generated/figures/{name}{result.suffix})"
    if result.suffix == ".html":
        there = folder / "extra" / "live" / f"{name}.html"
        shutil.copy(result, there)
        return f'<iframe class="live" loading="lazy" title="{result.name}" src="@live/{name}.html"></iframe>'
    there = folder / "figures" / f"{name}{result.suffix}"
    shutil.copy(result, there)
    return f"{{download}}`{result.name} </_generated/figures/{there.name}>`"


def with_results(text: str, found: dict[str, list[str]]) -> str:
    """Return a page with what its blocks gave behind them; of pictures the line that stands for one is left out."""
    if not found:
        return text
    lines = text.splitlines()
    for number, markdown in sorted(((int(line), each) for line, each in found.items()), reverse=True):
        lines[number + 1 : number + 1] = ["", *(piece for each in markdown for piece in (each, ""))]
    return PICTURE.sub("", "\n".join(lines) + "\n").replace("\n\n```\n", "\n```\n")
