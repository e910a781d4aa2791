"""The pages: what they link is there, and what is drawn for them is what they show. Their examples run as doctests."""

import doctest
import json
import re
import shlex
import subprocess
import sys
import threading
import tomllib
from functools import cache, partial
from html.parser import HTMLParser
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from runpy import run_path
from urllib.parse import quote, unquote, urldefrag

import numpy as np
import pytest
from matplotlib.image import imread

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
sys.path.insert(0, str(DOCS))
from made import examples, gallery, searches, written_pages  # noqa: E402

from linkage.cli.entry import BUILT_IN, main  # noqa: E402
from linkage.plugins import COMMANDS, entry_points  # noqa: E402
from tests.for_all import for_all  # noqa: E402
from tests.tools.catalogues import messages  # noqa: E402
from tests.tools.prose import LONGEST_MEAN, docstrings, mean_length, riddles, sentences  # noqa: E402
from tests.tools.sources import sources  # noqa: E402

PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted(DOCS.glob("*.md")), *sorted(DOCS.glob("howto/*.md"))]
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
SCRIPTS = {path.stem: run_path(str(path)) for path in sorted((DOCS / "pictures").glob("*.py"))}
QUICK = ("conventions", "way")
DRAWN = {
    picture: pytest.param(make, id=picture, marks=() if name in QUICK else pytest.mark.slow)
    for name, script in SCRIPTS.items()
    for picture, make in script["PICTURES"].items()
}
LONGEST_MESSAGE = 32
"""The words that one sentence of a message may have: more than that nobody reads beside a machine."""
LONGEST_SENTENCE, LONGEST_IN_SOURCE = 36, 40
"""The words that one sentence of a page, and of a docstring, may have: one with more has to be read twice."""
WIDE = 100
"""The characters of code that the column has room for."""


@for_all("page", PAGES, ids=lambda page: page.stem)
def test_what_a_page_links_is_there(page):
    links = [link for link in LINK.findall(page.read_text(encoding="utf-8")) if "://" not in link]
    assert [link for link in links if not (page.parent / link).exists()] == []


@for_all("page", PAGES, ids=lambda page: page.stem)
def test_sentences_are_short(page):
    text = page.read_text(encoding="utf-8")
    assert mean_length(text) <= LONGEST_MEAN, [sentence for count, sentence in sentences(text) if count > 2 * LONGEST_MEAN]
    assert [sentence for count, sentence in sentences(text) if count > LONGEST_SENTENCE] == []


def test_docstrings_and_what_is_said_are_short_too():
    written = [each for source in sources().values() for each in docstrings(source)]
    assert mean_length(*written) <= LONGEST_MEAN
    assert [sentence for each in written for count, sentence in sentences(each) if count > LONGEST_IN_SOURCE] == []
    said = [each.text for path, source in sources().items() for each in messages(path, source)]
    assert mean_length(*said) <= LONGEST_MEAN
    assert [each for each in said for count, _ in sentences(each) if count > LONGEST_MESSAGE] == []


def test_what_holds_and_what_changed_is_read_in_one_sitting():
    design, changes = ((ROOT / name).read_text(encoding="utf-8") for name in ("docs/design.md", "CHANGELOG.md"))
    assert design.count("\n") <= 400 and len(design.encode()) <= 45_000
    assert len(changes.encode()) <= 10_000


def test_the_citation_has_the_version_of_the_package():
    version = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
    assert f"\nversion: {version}\n" in (ROOT / "CITATION.cff").read_text(encoding="utf-8")


@for_all("page", PAGES, ids=lambda page: page.stem)
def test_a_page_has_no_riddles(page):
    assert list(riddles(page.read_text(encoding="utf-8"))) == []


def test_docstrings_and_what_is_said_have_no_riddles():
    found = {path: [*docstrings(source), *(each.text for each in messages(path, source))] for path, source in sources().items()}
    assert [(path, riddle) for path, texts in found.items() for text in texts for riddle in riddles(text)] == []


def test_a_riddle_is_found_and_code_is_none():
    assert len(list(riddles("DefinitionError for what is no\n pin; None of a\npin. The oil that stands there."))) == 3
    assert list(riddles("`what is no` pin\n\n```python\nwhat is no pin\n```\n")) == []


def test_sentences_are_counted_without_code_and_formulas():
    prose = "# Title.\n\nOne `a.b. C` two $x. Y$ three. Four [five six](seven.md).\n\n* Seven, eight.\n* nine\n\n"
    text = prose + "```\nno code. Here\n```\n\n| a. B. |"
    assert [count for count, _ in sentences(text)] == [5, 3, 2]


FOUND = 3
"""Among so many pages it is."""
SKIPPED = {"a", "be", "of"}
"""Words that the built search leaves out."""
STRANGERS = {
    "bulk": ["numpy array", "broadcasting", "numba", "javascript", "gradient"],
    "coming_from": ["pylinkage", "linkage2", "pmks share address", "mathcad", "sam"],
    "conventions": ["sign convention"],
    "drawing": ["import", "coordinates", "dxf import", "dxf layers", "csv points", "round lengths"],
    "equations": ["sympy", "latex"],
    "excavator": ["excavator", "backhoe", "bucket"],
    "extending": ["plugin", "cam follower"],
    "files": ["file", "toml"],
    "forces": ["pin forces", "center of gravity", "bearing load"],
    "header_balancer": ["header"],
    "hydraulics": ["accumulator", "pressure", "relief valve", "nitrogen", "pump power", "flow rate", "pump", "buckling"],
    "index": ["install"],
    "machines_at_work": ["wheel loader"],
    "not_here": [
        "gear", "gearbox", "cam", "belt", "stress", "strength", "fem", "steering", "motor", "dynamic simulation", "vibration",
        "pmks", "geogebra", "3d", "electric actuator", "rack", "backlash",
    ],
    "one_pump": ["one pump"],
    "parts": ["mobility", "degrees of freedom", "assur group"],
    "performance": ["speed"],
    "cycle": ["working cycle"],
    "quasi_static": ["quasi-static", "frequency", "compressibility of oil", "sag"],
    "redesign": ["redesign", "catalogue", "cylinder size"],
    "quickstart": ["quick start"],
    "reference": ["exception", "api"],
    "reliability": ["singular", "accuracy", "error"],
    "sketch": ["sketch", "dxf", "autocad"],
    "studies": ["tolerance", "optimise", "six-bar", "multiprocessing", "monte carlo", "sensitivity", "pareto", "genetic algorithm"],
    "theory": ["transfer ratio", "virtual work", "dynamics", "kinematics", "moment of inertia"],
    "three_point_hitch": ["three-point hitch"],
    "units_and_languages": ["translation"],
    "howto/axle_loads": ["axle load", "tipping", "stability", "wheel load", "crane outrigger"],
    "howto/barrel_and_rod": ["barrel", "weight of cylinder"],
    "howto/chart": ["load chart", "payload"],
    "howto/closed_curve": ["coupler curve", "four-bar"],
    "howto/columns": ["own columns", "dataframe"],
    "howto/cylinders": ["two cylinders"],
    "howto/duty": ["duty", "fatigue"],
    "howto/element": ["force element"],
    "howto/exact_synthesis": ["synthesis"],
    "howto/export": ["report", "drawing", "matplotlib", "csv", "excel", "pdf", "save picture"],
    "howto/forces": ["instant centre", "velocity", "free body", "free body diagram"],
    "howto/friction": ["friction", "hysteresis"],
    "howto/gas_spring": ["gas spring", "damper", "spring"],
    "howto/holding_valve": ["holding valve", "check valve", "counterbalance valve", "leak", "drift", "lock valve", "shut lines"],
    "howto/load_case": ["load case", "slope"],
    "howto/machine_of_parts": ["quick coupler", "mirror"],
    "howto/notebook": ["notebook", "jupyter"],
    "howto/page": ["undo", "live page", "gif", "animation", "zoom", "copy design"],
    "howto/places": ["level lift", "grading path"],
    "howto/planes": ["collision", "interference", "clearance"],
    "howto/programme": ["time", "speed over time", "ramp", "programme"],
    "howto/pump": ["load sensing", "flow sharing", "share a pump"],
    "howto/pump_cycle": ["working cycle pump"],
    "howto/reach": ["cannot be reached", "missing millimetres", "dead point", "dead center"],
    "howto/regenerative": ["regenerative"],
    "howto/rope": ["rope", "pulley", "winch"],
    "howto/side": ["side of a dyad", "wrong side"],
    "howto/telescope": ["telescope", "dump trailer"],
    "howto/two_struts": ["struts"],
    "howto/units": ["units", "inches", "change language"],
    "howto/vectors": ["vector"],
}  # fmt: skip
"""By page what designers of machines, students and programmers type who do not know its words: nothing is put into a page for them."""


@cache
def weights_of_pages():
    return {page: searches.weights(text) for page, text in written_pages().items()}


def found_by(typed):
    """Return the pages that have all words, by how much they are about them: as the search of the built pages ranks them."""
    words = [word for word in searches.words(typed) if word not in SKIPPED]
    pages = weights_of_pages().items()
    there = {page: sum(weights[word] for word in words) for page, weights in pages if all(weights[word] for word in words)}
    return sorted(there, key=lambda page: (-there[page], page))


SEARCHES = [pytest.param(words, page, id=words) for page, listed in STRANGERS.items() for words in listed]


@for_all(("words", "page"), SEARCHES)
def test_a_page_is_found_by_the_word_its_reader_types(words, page):
    assert page in found_by(words)[:FOUND]


def test_a_page_is_about_its_title_first():
    weights = searches.weights("# Gears\n\n## A gear pair\n\nA gear, and belts.\n\n```python\nbelt\n```\n")
    assert weights["gear"] > weights["pair"] > weights["belt"] == 2 and weights["chain"] == 0


def test_each_how_to_shows_a_picture():
    pages = {page: text for page, text in written_pages().items() if page.startswith("howto/") and page != "howto/index"}
    assert [page for page, text in pages.items() if not examples.shows(text)] == [] and len(pages) > 30


def listed(page):
    """Return the entries of a page's contents."""
    blocks = re.findall(r"```\{toctree\}\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
    return [line for block in blocks for line in block.splitlines() if line and not line.startswith(":")]


def test_every_page_is_in_the_contents():
    there = [*listed(DOCS / "index.md"), *(f"howto/{name}" for name in listed(DOCS / "howto" / "index.md")), "index"]
    pages = [page.relative_to(DOCS).with_suffix("").as_posix() for page in PAGES[2:]]
    assert [page for page in pages if page not in there] == []
    assert [name for name in there if not name.startswith("_generated") and name not in pages] == []


def code_lines(text):
    """Yield the lines inside the fences of a page."""
    inside = False
    for line in text.splitlines():
        if line.startswith("```"):
            inside = not inside
        elif inside:
            yield line


@for_all("page", PAGES, ids=lambda page: page.stem)
def test_no_code_is_wider_than_its_column(page):
    assert [line for line in code_lines(page.read_text(encoding="utf-8")) if len(line) > WIDE] == []


def test_every_drawn_picture_is_shown():
    text = "\n".join(page.read_text(encoding="utf-8") for page in PAGES)
    assert set(re.findall(r"images/(\w+)\.png", text)) == set(DRAWN)
    assert set(re.findall(r"images/(\w+\.gif)", text)) == {film for script in SCRIPTS.values() for film in script.get("FILMS", {})}
    kept = {path.name for path in (DOCS / "images").iterdir()}
    assert kept == set(re.findall(r"images/(\w+\.\w+)", text))


@pytest.mark.parametrize(("name", "make"), [pytest.param(name, *each.values, id=each.id, marks=each.marks) for name, each in DRAWN.items()])
def test_the_picture_shown_is_the_one_drawn(name, make, tmp_path):
    make().savefig(tmp_path / "drawn.png")
    drawn_now, shown = imread(tmp_path / "drawn.png"), imread(DOCS / "images" / f"{name}.png")
    assert drawn_now.shape == shown.shape
    far = np.abs(drawn_now - shown).max(axis=2) > 0.5
    assert np.mean(far) < 2e-3  # other versions of the library set letters a little differently


# -- what is made when the pages are built -----------------------------------------------------------------


def test_every_machine_has_its_place_in_the_gallery():
    from made import machines

    names = [name for group in gallery.GROUPS.values() for name in group]
    assert sorted(names) == sorted(machines.registered())
    assert gallery.OTHERS not in gallery.groups(machines.registered())


PAGE = """
```python
>>> from linkage import draw
>>> from mechanisms.classics.four_bar import FourBar
>>> draw(FourBar())
<Picture size ...>
>>> 1 / 0
Traceback (most recent call last):
    ...
ZeroDivisionError: division by zero
>>> draw(FourBar()).savefig("four.svg"); "four.svg"
'four.svg'
```

```text
nothing
```
"""


def test_a_page_shows_what_its_examples_draw(tmp_path):
    (tmp_path / "figures").mkdir()
    (tmp_path / "page.md").write_text(PAGE, encoding="utf-8")
    before = Path.cwd()
    found = examples.make("page", tmp_path, tmp_path)
    assert Path.cwd() == before
    assert {path.name for path in (tmp_path / "figures").iterdir()} == {"page_1.png", "page_2.svg"}
    assert imread(tmp_path / "figures" / "page_1.png").std() > 0.01
    text = examples.with_results(PAGE, found)
    assert "<Picture" not in text and "ZeroDivisionError" in text
    assert text.index("```\n") < text.index("page_1.png") < text.index("page_2.svg") < text.index("```text")


def test_only_what_a_picture_needs_is_run():
    page = """
>>> import numpy as np
>>> class A:
...     x = np.ones(3)
>>> unused = A()
>>> print(unused.x)
[1. 1. 1.]
>>> rows = [1]
>>> rows.append(2)
>>> rows[0] = 3
>>> _ = rows.pop()
>>> draw(A, rows)
<Picture size ...>
>>> print(rows)
[3]
"""
    run = [each.source.split("\n")[0] for each in examples.needed(doctest.DocTestParser().get_examples(page))]
    assert run == ["import numpy as np", "class A:", "rows = [1]", "rows.append(2)", "rows[0] = 3", "_ = rows.pop()", "draw(A, rows)"]


@pytest.mark.parametrize("name", ["slider_crank", pytest.param("three_point_hitch", marks=pytest.mark.slow)])
def test_a_machine_has_a_page(name, tmp_path):
    from made import machines

    for folder in ("machines", "extra/live", "extra/thumbs"):
        (tmp_path / folder).mkdir(parents=True)
    machines.make(name, tmp_path)
    machine = machines.registered()[name].load()()
    text = (tmp_path / "machines" / f"{name}.md").read_text(encoding="utf-8")
    for dimension in machine.dimensions:
        assert f"| {dimension} |" in text
    steps = re.search(r"## Construction.*?```python\n(.*?)```", text, re.DOTALL)[1]
    assert "".join(steps.split()) == "".join(str(machine.plan).split())
    assert all(verdict[:20] in text for verdict in machine.verdicts())
    assert text.count("<math") > 5 and not re.findall(r"<m\w+[^>]*>\\", text)
    assert max(map(len, code_lines(text.partition("## Source")[0]))) <= WIDE
    for picture in (f"machines/{name}.png", f"machines/{name}_curve.png", f"extra/thumbs/{name}.png"):
        assert imread(tmp_path / picture).std() > 0.01
    assert "<script" in (tmp_path / "extra" / "live" / f"{name}.html").read_text(encoding="utf-8")


@pytest.mark.parametrize("words", ["list table new save", pytest.param("", marks=pytest.mark.slow)], ids=["quick", "all"])
def test_the_commands_of_the_first_page_run(tmp_path, monkeypatch, words):
    """All but the one that serves a page, and those of files that a reader has; the files that a command writes are there for the next."""
    monkeypatch.chdir(tmp_path)
    block = (ROOT / "README.md").read_text(encoding="utf-8").partition("## On the command line")[2].split("```")[1]
    lines = [shlex.split(line, comments=True)[1:] for line in block.splitlines() if line.startswith("hydrolinkage")]
    others = {"board", "heights.csv", "search.toml", "bar.toml"}
    asked = [line for line in lines if line[0] in (words.split() or line) and others.isdisjoint(line)]
    assert len(asked) >= 4 and [line for line in asked if main(line) > ("--check" in line)] == []


def test_commands_tell_of_themselves(tmp_path):
    from made import commands

    commands.make(tmp_path / "commands.md")
    text = (tmp_path / "commands.md").read_text(encoding="utf-8")
    assert re.findall(r"^## (\w+)$", text, re.MULTILINE) == [*BUILT_IN, *sorted(entry_points(COMMANDS))]
    assert text.count("usage: hydrolinkage") == text.count("\n## ") + 1
    assert max(map(len, code_lines(text))) <= WIDE


def test_docstrings_stand_for_themselves():
    from made import api

    of_a_property = ["The lengths of all: of links.", "", "More."]
    api.as_restructured(None, "property", "f", None, None, of_a_property)
    assert of_a_property == ["The", "lengths of all: of links.", "", "More."]  # else napoleon takes what stands before a colon for a type
    lines = ["Take *args and `a*b` of | ref_ here.", "", "* a bullet", "  x * y"]
    api.as_restructured(None, "function", "f", None, None, lines)
    several = ["The `Over`s: `on` is there `at=0`."]
    api.as_restructured(None, "function", "f", None, None, several)
    assert several == [r"The `Over`\ s: `on` is there `at=0`."]
    assert lines == [r"Take \*args and `a*b` of \| ref\_ here.", "", "* a bullet", r"  x \* y"]


def test_arguments_that_no_source_has_are_written():
    from made import api

    from linkage import Crank, draw, standing

    situation = "case=None, direction=None, rates=None, accelerations=None, inertia=None, acting=None"
    assert api.written_arguments(standing) == f"(motion, loads=None, *, {situation})"
    assert api.written_arguments(draw) == ""
    assert api.written_arguments(Crank) == "(P, *, angle, at=None, **lengths)"


def test_formulas_of_the_pages_are_set():
    pytest.importorskip("latex2mathml", reason="formulas are set by the extra `docs`")
    from made import formulas

    text = re.sub(r"```.*?```|`[^`\n]*`", "", "\n".join(written_pages().values()), flags=re.DOTALL)
    found = re.findall(r"\$\$\n(.*?)\$\$", text, re.DOTALL) + re.findall(r"(?<!\$)\$([^$\n]+)\$(?!\$)", text)
    assert len(found) > 150
    for each in found:
        written = formulas.mathml(each)
        assert written.startswith("<math") and "\\" not in written, each


@pytest.mark.slow
def test_the_cells_of_the_notebook_run():
    """In this process, where nothing is shown; what a kernel shows is looked at in the slow part."""
    names: dict = {}
    for cell in json.loads((DOCS / "notebook.ipynb").read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            exec("".join(cell["source"]), names)
    assert names["motion"].reached.all() and names["hitch"].verdicts(names["motion"])


@pytest.mark.slow
def test_the_notebook_runs():
    pytest.importorskip("nbclient", reason="notebooks are run by nbclient, of the extra `test`")
    from made import notebook

    cells = [cell for cell in notebook.executed(DOCS / "notebook.ipynb").cells if cell.cell_type == "code"]
    shown = [output.data for cell in cells for output in cell.outputs if "data" in output]
    assert len(shown) == len(cells)
    assert sum("text/html" in data for data in shown) >= 8
    assert sum("image/png" in data for data in shown) == 2
    assert any("<iframe sandbox=" in data.get("text/html", "") for data in shown)


# -- the built pages ---------------------------------------------------------------------------------------


class Links(HTMLParser):
    """The addresses that a page refers to, and the names of its places."""

    def __init__(self, text):
        super().__init__()
        self.addresses, self.names = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.names.update(filter(None, (given.get("id"), given.get("name"))))
        self.addresses += filter(None, (given.get("href"), given.get("src")))


def broken_links(folder):
    """Yield what the pages of a folder refer to inside of it and is not there."""
    pages = {path: Links(path.read_text(encoding="utf-8")) for path in folder.rglob("*.html") if "live" not in path.parts}
    for path, page in pages.items():
        for address in page.addresses:
            place, name = urldefrag(address)
            if re.match(r"[a-z]+:", place):
                continue
            target = (path.parent / unquote(place.partition("?")[0])).resolve() if place else path
            if not target.exists() or (name and target in pages and unquote(name) not in pages[target].names):
                yield path.name, address


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """Return the folder of the pages, built anew without a warning."""
    pytest.importorskip("furo", reason="the pages are built by the extra `docs`")
    folder = tmp_path_factory.mktemp("pages")
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-j", "auto", str(DOCS), str(folder)]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    return folder


@pytest.mark.slow
def test_what_the_built_pages_link_is_there(built):
    assert list(broken_links(built)) == []
    front = Links((built / "index.html").read_text(encoding="utf-8")).addresses
    assert sum(address.startswith("live/") for address in front) == sum(map(len, gallery.GROUPS.values()))


@pytest.mark.slow
def test_the_built_pages_fit_their_screen(built, chromium):
    tab = chromium.new_page(viewport={"width": 1366, "height": 657})
    shown = "[...document.querySelectorAll('pre')].filter(e => e.offsetParent)"
    wide = f"{shown}.filter(e => e.scrollWidth > e.clientWidth + 1).map(e => e.innerText)"
    faults = []
    for path in sorted(built.rglob("*.html")):
        if "live" in path.parts or "_static" in path.parts:
            continue
        tab.set_viewport_size({"width": 1366, "height": 657})
        tab.goto(path.as_uri(), wait_until="domcontentloaded")
        faults += [(path.name, "pre", text[:80]) for text in tab.evaluate(wide)]
        tab.set_viewport_size({"width": 390, "height": 760})
        if tab.evaluate("document.documentElement.scrollWidth") > 390:
            faults.append((path.name, "page", ""))
    tab.close()
    assert faults == []


RESULTS = "[...document.querySelectorAll('#search-results ul.search > li > a')].map(each => each.getAttribute('href'))"


@pytest.mark.slow
def test_the_search_of_the_built_pages_finds_them(built, chromium):
    handler = partial(SimpleHTTPRequestHandler, directory=built)
    wanted = {words: page for page, listed in STRANGERS.items() for words in listed}
    missed, tab = {}, chromium.new_page()
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        for words, page in wanted.items():
            tab.goto(f"http://127.0.0.1:{server.server_port}/search.html?q={quote(words)}")
            tab.wait_for_selector("#search-results p.search-summary:has-text('finished')")
            found = [re.split(r"\.html", each)[0] for each in tab.evaluate(RESULTS)]
            if page not in list(dict.fromkeys(found))[:FOUND]:
                missed[words] = found[:FOUND]
        server.shutdown()
    tab.close()
    assert missed == {}
