"""The doors draw, plot, animate, page, equations: functions of `linkage` whatever was imported before or after; what they load."""

import inspect
import subprocess
import sys
from ast import literal_eval
from importlib import import_module
from pathlib import Path

import pytest

import linkage
from tests.for_all import for_all
from tests.test_house import HEAVY, OPTIONAL

ROOT = Path(__file__).parents[2]
LATE = {
    "animate": "pictures.film", "draw": "pictures.by_kind", "drawing_board": "board.page", "equations": "formulas.numbered",
    "export": "exports.export", "page": "pictures.browser", "plot": "pictures.by_kind", "report": "documents.reporting",
}  # fmt: skip
DOORS = ("animate", "draw", "equations", "page", "plot")
SAY = f"print([type(getattr(linkage, name)).__name__ for name in {DOORS}], [type(name).__name__ for name in ({', '.join(DOORS)})])"
STAR, PICTURES, FORMULAS = "from linkage import *", "import linkage.pictures", "import linkage.formulas"


def printed(*lines):
    return subprocess.run([sys.executable, "-c", "\n".join(lines)], cwd=ROOT, check=True, capture_output=True, text=True).stdout.strip()


@for_all(
    "lines",
    [("import linkage, linkage.reports, linkage.study", STAR)],
    slow=[
        ("import linkage, linkage.pictures.film, linkage.formulas.numbered", STAR),
        (FORMULAS, STAR, PICTURES), (STAR, PICTURES, FORMULAS), (PICTURES, FORMULAS, STAR), (PICTURES, STAR, FORMULAS, STAR),
        ("from linkage.pictures import *", "from linkage.formulas import *", STAR),
    ],
)  # fmt: skip
def test_doors_are_functions_whatever_is_imported(lines):
    assert printed("import linkage", *lines, SAY) == f"{['function'] * 5} {['function'] * 5}"


def test_no_library_is_loaded_before_it_is_asked_for():
    """None behind the doors by a star, no graphs by the mobility, pydantic by no room, and nothing that draws by a live page.

    A crane brings its own files alone.
    """
    told, four_bar = "print(*sys.modules)", "from mechanisms.classics.four_bar import FourBar"
    rooms, live = "import linkage.cli, linkage.files, hydraulics", "len(linkage.pictures.page_html(FourBar()))"
    crane = "from mechanisms.crane import Crane"
    asked = four_bar, "FourBar().mobility", told, "FourBar().graph", told, rooms, told, crane, told, PICTURES, live, told
    text = printed(STAR, "import sys", told, *asked)
    star, moved, drawn, last, craned, paged = (each.split() for each in text.splitlines())
    assert "linkage.mechanism" in star
    behind = *HEAVY, *OPTIONAL, "linkage.pictures", "linkage.formulas", "linkage.notebook"
    assert not [name for name in star if name.startswith(behind)]
    assert not {"mechanisms.crane.drives", "mechanisms.crane.chain_crane"} & {*craned}
    assert "networkx" not in moved and "networkx" in drawn and "pydantic" not in last
    assert "linkage.pictures.page_data" in paged and not [name for name in paged if name.startswith(("matplotlib", "sympy"))]


def test_what_is_loaded_late_says_what_it_takes():
    text = printed(
        STAR, "import inspect, pydoc, pickle, sys, linkage",
        f"late = [getattr(linkage, name) for name in {LATE}]",
        "print([(each.__name__, str(inspect.signature(each)), each.__doc__, pickle.loads(pickle.dumps(each)) is each) for each in late])",
        "print(pydoc.plain(pydoc.render_doc(linkage.page)).splitlines()[2][:24])",
        "print([name for name in sys.modules if name.startswith(('matplotlib', 'sympy', 'linkage.pictures', 'linkage.exports'))])",
    )  # fmt: skip
    first, page, loaded = text.splitlines()
    assert page == "page(machine: 'Mechanism" and loaded == "[]"
    for name, signature, doc, is_same in literal_eval(first):
        there = getattr(import_module(f"linkage.{LATE[name]}"), name)
        assert (signature, doc, is_same) == (str(inspect.signature(there)), there.__doc__, True), name
        assert inspect.getsource(getattr(linkage, name)).splitlines()[0] in inspect.getsource(there)


def test_every_name_of_the_door_is_there():
    assert len(linkage.__all__) == len(set(linkage.__all__)) > 60
    assert all(getattr(linkage, name) is not None for name in linkage.__all__)
    assert set(linkage.__all__) <= set(dir(linkage))
    with pytest.raises(AttributeError, match="module 'linkage' has no attribute 'Dyed'"):
        linkage.Dyed  # noqa: B018 - the name itself is what is tried
    with pytest.raises(ImportError, match="cannot import name 'Dyed'"):
        exec("from linkage import Dyed")


def doors():
    """Yield the name of every package, and of the module of units, which is imported by a star as well."""
    for root in ("linkage", "hydraulics", "mechanisms"):
        for path in (ROOT / root).rglob("__init__.py"):
            yield ".".join(path.parent.relative_to(ROOT).parts)
    yield "linkage.units"


def test_a_star_behind_the_front_door_hides_none_of_its_names():
    """Whatever is loaded: of a door that is loaded late its own function may stand in its place, but never a module."""
    for name in sorted(doors()):
        space = {}
        exec("from linkage import *", space)
        known = {each: space[each] for each in linkage.__all__}
        module = import_module(name)
        exec(f"from {name} import *", space)
        assert set(module.__all__) <= space.keys(), name
        assert not [each for each, value in space.items() if inspect.ismodule(value)], name
        for each, value in known.items():
            assert space[each] is value or (each in LATE and inspect.isfunction(space[each])), f"{name} hides {each}"
        assert not {"Path", "annotations", "declare_public", "TYPE_CHECKING", "Sequence"} & set(module.__all__), name
    for each in ("standing", "optimise"):
        assert inspect.isfunction(getattr(linkage, each))
