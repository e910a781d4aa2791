"""The pages: what they link is there, and what is drawn for them is what they show. Their examples run as doctests."""

import re
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

ROOT = Path(__file__).parents[1]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")


def script(name):
    """Return a script that draws pictures of the pages."""
    spec = spec_from_file_location(f"{name}_pictures", ROOT / "docs" / "pictures" / f"{name}.py")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


CONVENTIONS, OTHERS = script("conventions"), [script(name) for name in ("way", "search", "redesigns")]
DRAWN = {f"conventions_{name}": draw for name, draw in CONVENTIONS.PICTURES.items()} | {
    name: draw for each in OTHERS for name, draw in each.PICTURES.items()
}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_what_a_page_links_is_there(page):
    links = [link for link in LINK.findall(page.read_text(encoding="utf-8")) if "://" not in link]
    assert [link for link in links if not (page.parent / link).exists()] == []


def test_every_page_is_in_the_contents():
    listed = (ROOT / "docs" / "index.md").read_text(encoding="utf-8")
    assert [page.stem for page in PAGES[1:] if page.stem != "index" and f"{page.stem}*" not in listed] == []


def test_every_drawn_picture_is_shown():
    text = (ROOT / "docs" / "conventions.md").read_text(encoding="utf-8")
    assert set(re.findall(r"images/conventions_(\w+)\.png", text)) == set(CONVENTIONS.PICTURES)


@pytest.mark.parametrize("name", DRAWN)
def test_the_picture_shown_is_the_one_drawn(name, tmp_path):
    DRAWN[name]().savefig(tmp_path / "drawn.png")
    drawn, shown = imread(tmp_path / "drawn.png"), imread(ROOT / "docs" / "images" / f"{name}.png")
    assert drawn.shape == shown.shape
    assert np.mean(np.abs(drawn - shown).max(axis=2) > 0.5) < 2e-3  # other versions of the library set letters a little differently
