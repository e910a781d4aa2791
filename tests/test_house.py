"""The house keeps its floors: an import points down or sideways, never up or in a circle, and nothing heavy is loaded at the door."""

import ast
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

import networkx as nx
import pytest

from linkage import steps
from tests.for_all import for_all
from tests.tools.sources import nodes, parsed, sources

ROOT = Path(__file__).parents[1]

FLOORS = (
    ("errors", "units", "vectors", "disk", "frozen", "pickling", "language", "plugins", "shown", "star", "verdict"),
    ("quantities", "numeric"),
    ("steps", "loads", "surroundings"),
    ("program",),
    ("plan",),
    ("assembly", "mobility"),
    ("motion",),
    ("mechanism",),
    ("statics",),
    ("formulas", "study", "synthesis", "files", "sketch"),
    ("pictures", "reports"),
    ("documents", "exports", "notebook", "board"),
    ("cli",),
)
FLOOR = {room: number for number, rooms in enumerate(FLOORS) for room in rooms}
BLOCKS = ("body", "handlers", "orelse", "finalbody", "cases")
"""Where a statement has statements: an import is one, so expressions are not gone through."""
FRONT_DOOR = {"__init__", "__main__", "doors"}
MAY_IMPORT = {  # of the project's own three
    "linkage": {"linkage"},
    "hydraulics": {"linkage", "hydraulics"},
    "mechanisms": {"linkage", "hydraulics", "mechanisms"},
}
MAY_PRINT = {"cli", "demo"}

HEAVY = {"PIL", "imageio_ffmpeg", "matplotlib", "networkx", "numba", "pydantic", "rich", "scipy", "sympy"}
OPTIONAL = {"dask", "distributed", "ezdxf", "pymoo", "typst", "xlsxwriter"}  # extras: there may be nothing to import
HEAVY_ROOMS = {
    f"linkage.{room}"
    for room in ("formulas", "study", "synthesis", "pictures", "reports", "files", "sketch", "exports", "documents", "board")
}


def room(module: str) -> str:
    """Return the second name of a dotted module: `steps` of `linkage.steps.dyad`."""
    return module.split(".")[1] if "." in module else "__init__"


def origin(path: PurePosixPath, node: ast.ImportFrom) -> str:
    """Return the absolute module that a `from ... import` of the file `path` names."""
    base = path.parts[: -node.level] if node.level else ()
    return ".".join([*base, node.module] if node.module else base)


def imports(path: PurePosixPath, tree: ast.AST, lazy: bool = False) -> Iterator[tuple[ast.stmt, str, bool]]:
    """Yield the statement, the absolute module and whether a function holds it, for each import below `tree`.

    `from linkage import x` is the module `linkage.x` when `x` is a room, else the front door, `linkage`.
    """
    for node in (each for part in BLOCKS for each in getattr(tree, part, ())):
        if isinstance(node, ast.Import):
            yield from ((node, alias.name, lazy) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            module = origin(path, node)
            names = (f"{module}.{alias.name}" for alias in node.names)
            yield from ((node, name if module == "linkage" and room(name) in FLOOR else module, lazy) for name in names)
        else:
            yield from imports(path, node, lazy or isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef))


def climbing(here: str, module: str) -> str | None:
    """Return what is wrong with `module` in the room `here` of linkage, if anything is."""
    there = room(module)
    if there == here:
        return None
    if there in FRONT_DOOR:
        return f"floor {FLOOR[here]} ({here}) imports the front door: import from the room that holds the name"
    if there not in FLOOR:
        return f"imports linkage.{there}, which is no room of the table: add it to FLOORS in {Path(__file__).name}"
    if FLOOR[there] > FLOOR[here]:
        return f"floor {FLOOR[here]} ({here}) imports upwards, floor {FLOOR[there]} ({there})"
    return None


def import_faults(path: PurePosixPath, tree: ast.AST) -> Iterator[str]:
    """Yield a sentence for each import that `path` should not have."""
    package, here = path.parts[0], room(".".join(path.with_suffix("").parts))
    door = package == "linkage" and here in FRONT_DOOR
    if package == "linkage" and not door and here not in FLOOR:
        yield f"{path}: {here} is no room of the table: add it to FLOORS in {Path(__file__).name}, on its floor"
        return
    for node, module, lazy in imports(path, tree):
        where, owner = f"{path}:{node.lineno}", module.split(".")[0]
        if isinstance(node, ast.ImportFrom) and node.names[0].name == "*":
            yield f"{where}: star import of {module}"
        if owner in {*MAY_IMPORT, "tests"} - MAY_IMPORT[package]:
            yield f"{where}: {package} imports {owner}"
        elif package == owner == "linkage" and not door and (fault := climbing(here, module)):
            yield f"{where}: {fault}"
        is_heavy = owner in HEAVY | OPTIONAL | {"numpy"} or ".".join(module.split(".")[:2]) in HEAVY_ROOMS or module.endswith(".figures")
        if lazy and not door and not is_heavy:
            yield f"{where}: {module} is imported inside a function, which is for heavy libraries only: import it at the top"


def print_faults(path: PurePosixPath, source: str) -> Iterator[str]:
    """Yield a sentence for each `print(` outside the command and the demo."""
    if MAY_PRINT.isdisjoint(path.with_suffix("").parts):
        for node in nodes(source)[ast.Call]:
            if isinstance(node.func, ast.Name) and node.func.id == "print":
                yield f"{path}:{node.lineno}: print( in library code: return the text"


def circles(sources: dict[str, str]) -> list[list[str]]:
    """Return the files of each circle of imports among the files `sources`, path to text, imports for types and in functions included.

    `from .room import x` leads to the module `room.x` if there is one, else to `room`, that is to its `__init__` if it is a folder.
    """
    modules = {path.removesuffix(".py").removesuffix("/__init__").replace("/", "."): path for path in sources}
    graph = nx.DiGraph()
    for path, text in sources.items():
        names = [alias.name for node in nodes(text)[ast.Import] for alias in node.names]
        for node in nodes(text)[ast.ImportFrom]:
            base = origin(PurePosixPath(path), node)
            names += [name if (name := f"{base}.{alias.name}") in modules else base for alias in node.names]
        graph.add_edges_from((path, modules[name]) for name in names if name in modules)
    return sorted(sorted(circle) for circle in nx.strongly_connected_components(graph) if len(circle) > 1)


def faults(path: str, source: str) -> list[str]:
    """Return every breach of the house's rules in the text of one file, its path counted from the checkout."""
    place = PurePosixPath(path)
    return list(dict.fromkeys([*import_faults(place, parsed(source)), *print_faults(place, source)]))


def test_files_keep_the_floors():
    found = [fault for path, text in sources().items() for fault in faults(path, text)]
    assert not found, "\n".join(found)


def step_kinds() -> set[str]:
    """Return the names of the shipped steps, each a class that places a point or lets one slide."""
    shipped = [each for each in vars(steps).values() if isinstance(each, type)]
    return {each.__name__ for each in shipped if issubclass(each, (steps.Point, steps.Slide))} - {"Point", "Step"}


def named_steps(path: str, source: str) -> list[str]:
    """Return the kinds of steps that a file names: `steps` knows them, `assembly` makes dyads, `files` and `sketch` list what they hold.

    In equations Offset is one of the words that all steps are written in, no kind among others.
    """
    kinds = step_kinds() - ({"Offset"} if path.startswith("linkage/formulas/") else set())
    names = [node.id for node in nodes(source)[ast.Name]]
    names += [node.attr for node in nodes(source)[ast.Attribute]]
    names += [alias.name for node in nodes(source)[ast.ImportFrom] for alias in node.names]
    return sorted(kinds.intersection(names))


def test_no_room_names_kinds_of_steps():
    free = ("linkage/steps/", "linkage/assembly/", "linkage/files/", "linkage/sketch/", "linkage/__init__.py", "mechanisms/")
    found = {path: named_steps(path, text) for path, text in sources().items() if not path.startswith(free)}
    assert {path: names for path, names in found.items() if names} == {}


def test_a_kind_of_step_is_found():
    assert {"Crank", "Dyad", "Ground", "OnLink", "Pin", "Slide", "YokeDyad"} <= step_kinds()
    assert named_steps("linkage/plan/plan.py", "from ..steps import Dyad, Point\nisinstance(a, steps.Crank)") == ["Crank", "Dyad"]
    assert named_steps("linkage/formulas/listing.py", "from ..steps import Offset, Pin") == ["Pin"]


def test_every_package_is_looked_at():
    assert {path.split("/")[0] for path in sources()} == set(MAY_IMPORT)


def test_imports_go_in_no_circle():
    assert circles(sources()) == []


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("from .base import A", "from .dyad import B"),
        ("from linkage.steps.base import A", "from . import dyad"),
        ("import linkage.steps.base", "from .dyad import B"),
        ("from .base import A", "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from .dyad import B"),
        ("from .base import A", "def f():\n    from .dyad import B"),
        ("from .base import A", "from . import B"),
        ("from .base import A", "from linkage.steps import B"),
    ],
)
def test_circle_is_found(one, other):
    files = {"linkage/steps/dyad.py": one, "linkage/steps/base.py": other, "linkage/steps/__init__.py": "from .dyad import B"}
    (circle,) = circles(files)
    assert {"linkage/steps/dyad.py", "linkage/steps/base.py"} <= set(circle)


def test_what_no_circle_is():
    files = {
        "linkage/steps/__init__.py": "from .dyad import B\nfrom .base import A",
        "linkage/steps/dyad.py": "from .base import A\nfrom linkage.errors import E\nfrom . import base",
        "linkage/steps/base.py": "from ..errors import E\nimport numpy",
        "linkage/errors.py": "",
        "hydraulics/steps.py": "from linkage.steps import B",
    }
    assert circles(files) == []


@for_all(
    ("path", "source", "fault"),
    [
        ("linkage/steps/dyad.py", "from linkage.motion import Motion", "floor 2 (steps) imports upwards, floor 6 (motion)"),
        ("linkage/steps/dyad.py", "from ..motion import Motion", "imports upwards, floor 6"),
        ("linkage/steps/__init__.py", "from ..motion import Motion", "imports upwards, floor 6"),
        ("linkage/errors.py", "from .quantities import Stroke", "imports upwards, floor 1"),
        ("linkage/errors.py", "import numpy, linkage.quantities as q", "imports upwards, floor 1"),
        ("linkage/errors.py", "from . import units, plan", "imports upwards, floor 4 (plan)"),
        ("linkage/errors.py", "def f():\n    from .plan import Plan", "imports upwards, floor 4 (plan)"),
        ("linkage/plan.py", "from linkage import Stroke", "imports the front door"),
        ("linkage/plan.py", "import linkage", "imports the front door"),
        ("linkage/plan.py", "from .cellar import wine", "linkage.cellar, which is no room of the table: add it to FLOORS"),
        ("linkage/cellar.py", "", "cellar is no room of the table: add it to FLOORS"),
        ("linkage/plan.py", "from hydraulics import Cylinder", "linkage imports hydraulics"),
        ("linkage/__init__.py", "import mechanisms.mower_lift", "linkage imports mechanisms"),
        ("linkage/cli.py", "def f():\n    import mechanisms", "linkage imports mechanisms"),
        ("hydraulics/gas.py", "from mechanisms.mower_lift import MowerLift", "hydraulics imports mechanisms"),
        ("mechanisms/crane.py", "from tests.helpers import law", "mechanisms imports tests"),
        ("mechanisms/crane.py", "from linkage import *", "star import of linkage"),
        ("linkage/motion.py", "class A:\n    def f(self):\n        import json", "json is imported inside a function"),
        ("linkage/motion.py", "def f():\n    from .plan import Plan", "linkage.plan is imported inside a function"),
        ("hydraulics/gas.py", "async def f():\n    from .circuit import g", "hydraulics.circuit is imported inside a function"),
        ("linkage/motion.py", "def f():\n    print(1)", "print( in library code"),
        ("linkage/__init__.py", "print(1)", "print( in library code"),
    ],
)
def test_breach_is_found(path, source, fault):
    assert fault in "\n".join(faults(path, source))


@for_all(
    ("path", "source"),
    [
        ("linkage/steps/dyad.py", "from ..errors import A\nfrom .base import B\nfrom ..loads import C\nfrom linkage.steps.base import D"),
        ("linkage/steps/__init__.py", "from .dyad import Dyad\nfrom . import base"),
        ("linkage/motion.py", "from . import plan, errors\nfrom linkage import program\nimport numpy as np"),
        ("linkage/plan.py", "def f():\n    import networkx as nx\n    from scipy.sparse import csgraph"),
        ("linkage/cli.py", "def f():\n    from .pictures import show\n    from . import reports\n    print(1)"),
        ("linkage/__init__.py", "from .cli import main\ndef __getattr__(name):\n    from importlib import import_module"),
        ("linkage/__main__.py", "from .cli import main"),
        ("hydraulics/cylinders.py", "from linkage import Stroke\nfrom .gas import isothermal"),
        ("mechanisms/demo.py", "from hydraulics import Cylinder\ndef f():\n    from linkage.pictures import show\n    print(1)"),
    ],
)
def test_honest_file_is_left_alone(path, source):
    assert faults(path, source) == []


def defined(source: str) -> set[str]:
    """Return the public functions and classes at the top of a file."""
    names = {node.name for node in parsed(source).body if isinstance(node, ast.FunctionDef | ast.ClassDef)}
    return {name for name in names if not name.startswith("_")}


def test_a_name_has_one_meaning_in_the_framework():
    owners: dict[str, list[str]] = {}
    for path, source in sources().items():
        for name in defined(source) if path.split("/")[0] in ("linkage", "hydraulics") else ():
            owners.setdefault(name, []).append(path)
    assert {name: paths for name, paths in owners.items() if len(paths) > 1} == {}


def test_no_room_bears_the_name_of_a_public_function():
    import linkage

    rooms = {path.parent.name for path in (ROOT / "linkage").glob("*/__init__.py")}
    assert rooms == set(FLOOR) - {*FLOORS[0], "mechanism", "notebook"}
    assert not rooms & {name for name in linkage.__all__ if callable(getattr(linkage, name))}


BASES = {
    "ActingKeywords", "Amount", "Arithmetic", "AssemblyError", "BarrelAndRod", "DefinitionError", "Directed", "Expression", "FourBar",
    "FrozenDict", "Function", "Ground", "HasSentence", "Jointed", "Kind", "LawElement", "Leaf", "LinkageError", "Mechanism", "Member",
    "Members", "Mistakes", "Motion", "Number", "OnBody", "OnCylinder", "OnLines", "OnePose", "Outline", "PlacedFile", "Poses", "PumpLine",
    "Range", "Reading", "Renaming", "Request", "Shown", "Step", "StudyError", "Supply", "TurnV", "VectorNumber", "Verdict", "Where",
}  # fmt: skip
"""Classes that others are derived from though they have no abstract method; all others are abstract or final."""


def derived_from(texts: dict[str, str]) -> set[str]:
    """Return the classes among some files, path to text, that others are derived from though they have no abstract method."""
    classes = [node for path, text in texts.items() if not path.startswith("mechanisms/") for node in nodes(text)[ast.ClassDef]]
    marks = {c.name: {ast.unparse(mark) for part in c.body for mark in getattr(part, "decorator_list", ())} for c in classes}
    bases = [ast.unparse(base) for text in texts.values() for node in nodes(text)[ast.ClassDef] for base in node.bases]
    named = {base.split("[")[0].split(".")[-1] for base in bases}
    return {name for name in named & marks.keys() if "abstractmethod" not in marks[name]}


def test_classes_are_abstract_or_final():
    packages = tuple(f"{package}/" for package in MAY_IMPORT)
    assert derived_from({path: text for path, text in sources().items() if path.startswith(packages)}) == BASES


def test_a_base_that_is_not_abstract_is_found():
    leaf = "class Dyad(Step):\n    pass\nclass Step:\n    @abstractmethod\n    def place(self): ...\n"
    assert derived_from({"linkage/steps/dyad.py": leaf}) == set()
    assert derived_from({"linkage/steps/dyad.py": leaf, "hydraulics/own.py": "class Own(Dyad):\n    pass\n"}) == {"Dyad"}
