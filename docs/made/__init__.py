"""What the pages show is made here before they are read: live pages, machines' pages, the command's and the reference's.

All of it goes into docs/_generated, which is not kept; `made` is also the Sphinx extension that has it made and sets formulas.
"""

from __future__ import annotations

import gc
import json
import os
import shutil
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from docutils import nodes
from sphinx.addnodes import toctree

from . import api, commands, examples, formulas, gallery, machines, notebook, searches

HERE = Path(__file__).parents[1]
GENERATED = HERE / "_generated"


def setup(app: Any) -> dict[str, bool]:
    """Have everything made before the sources are read, show what their examples draw, and set formulas as MathML."""
    app.add_config_value("keep_generated", False, "", [bool, str])
    app.connect("builder-inited", make_unless_kept)
    app.connect("source-read", show_examples)
    app.connect("html-page-context", put_paths)
    app.connect("html-page-context", list_titles, priority=400)  # before the theme asks for the list
    app.connect("autodoc-process-docstring", api.as_restructured)
    app.add_html_math_renderer("mathml", (formulas.inline, None), (formulas.block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def make_unless_kept(app: Any) -> None:
    """Make all that is generated; with `./run docs -D keep_generated=1` only where nothing is there, for one who writes texts."""
    if app.config.keep_generated in (False, "0", "") or not (GENERATED / "examples.json").exists():
        make_all(GENERATED)


def make_all(folder: Path) -> None:
    """Make all that is generated into a folder, anew, on as many processes as there are processors."""
    shutil.rmtree(folder, ignore_errors=True)
    for name in ("machines", "figures", "api", "extra/live", "extra/thumbs"):
        (folder / name).mkdir(parents=True)
    commands.make(folder / "commands.md")
    api.make(folder / "api")
    pages = written_pages()
    searches.make(pages, folder)
    seldom = {"initializer": gc.set_threshold, "initargs": (100_000,)}  # the many objects of traced programs are looked through in vain
    with ProcessPoolExecutor(os.cpu_count(), mp_context=get_context("spawn"), **seldom) as pool:
        run = pool.submit(notebook.make, HERE / "notebook.ipynb", folder / "notebook.md")
        tiles = {name: pool.submit(machines.make, name, folder) for name in machines.registered()}
        shown = {page: pool.submit(examples.make, page, HERE, folder) for page, text in pages.items() if examples.shows(text)}
        run.result()
        gallery.make({name: each.result() for name, each in tiles.items()}, folder)
        found = {page: each.result() for page, each in shown.items()}
    (folder / "examples.json").write_text(json.dumps(found, indent=1), encoding="utf-8")


def written_pages() -> dict[str, str]:
    """Return the texts of the pages that are written by hand, by their names without .md."""
    paths = sorted([*HERE.glob("*.md"), *HERE.glob("howto/*.md")])
    return {path.relative_to(HERE).with_suffix("").as_posix(): path.read_text(encoding="utf-8") for path in paths}


def show_examples(app: Any, page: str, source: list[str]) -> None:
    """Put behind each block of examples what it drew."""
    found = json.loads((GENERATED / "examples.json").read_text(encoding="utf-8"))
    source[0] = examples.with_results(source[0], found.get(page, {}))


def put_paths(app: Any, page: str, template: str, context: dict[str, Any], doctree: Any) -> None:
    """Put the way from a page to live pages, thumbnails and machines in the place of its short form, `@live/`."""
    if "body" in context:
        up = "../" * page.count("/")
        for short, place in (("@live/", "live/"), ("@thumbs/", "thumbs/"), ("@machines/", "_generated/machines/")):
            context["body"] = context["body"].replace(f'"{short}', f'"{up}{place}')


def list_titles(app: Any, page: str, template: str, context: dict[str, Any], doctree: Any) -> None:
    """Let the list of all pages be made of their titles alone: the headings below them would be copied for each page, to be left out."""
    whole, listed = app.env.tocs, context["toctree"]

    def toctree_of_titles(**options: Any) -> str:
        app.env.tocs = titles_of(app.env)
        try:
            return str(listed(**options))
        finally:
            app.env.tocs = whole

    context["toctree"] = toctree_of_titles


@cache
def titles_of(env: Any) -> dict[str, nodes.Element]:
    """Return the contents of each page without its headings: its title, and the pages that it lists."""
    found = {page: contents.deepcopy() for page, contents in env.tocs.items()}
    for entry in (entry for contents in found.values() for entry in contents.children if len(entry.children) > 1):
        entry[1][:] = list(entry[1].findall(toctree))
    return found
