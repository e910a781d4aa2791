"""Public names: a design and a motion show what the page of reference explains, and docstrings list what signatures have."""

import ast
import inspect
import re
from pathlib import Path

import pytest

import hydraulics
import linkage
import mechanisms
from linkage import Mechanism
from mechanisms.classics.four_bar import FourBar
from tests.tools.sources import nodes, sources

PAGE = Path(__file__).parents[2] / "docs" / "reference.md"


def explained(heading):
    """Return the names in the first column of the table under a heading of the page."""
    (part,) = (each for each in PAGE.read_text(encoding="utf-8").split("\n## ") if each.startswith(heading))
    rows = [line.split("|")[1] for line in part.splitlines() if line.startswith("| `")]
    return sorted(name for row in rows for name in re.findall(r"`(\w+)`", row))


def shown(thing):
    """Return the public names of an object."""
    return sorted(name for name in dir(thing) if not name.startswith("_"))


@pytest.mark.parametrize("motion", [FourBar().sweep(5), FourBar(OA=[0.03, 0.04]).at(phi=0.2)])
def test_a_motion_shows_what_is_explained(motion):
    assert shown(motion) == explained("A motion")


def test_a_design_shows_what_is_explained():
    assert shown(Mechanism) == explained("A design")
    assert set(shown(FourBar())) - FourBar.plan.members.keys() == set(explained("A design"))


SECTION = re.compile(r"^(Parameters|Returns|Raises|Yields|Notes|Examples)\n-+\n", re.MULTILINE)


def functions():
    """Yield the public functions of the three packages and the public methods of their classes, each with its name."""
    for package in (linkage, hydraulics, mechanisms):
        for name in package.__all__:
            thing = getattr(package, name)
            members = vars(thing).items() if inspect.isclass(thing) else [("", thing)]
            for part, member in members:
                function = getattr(member, "__func__", member)
                if inspect.isfunction(function) and not part.startswith("_") and function.__doc__:
                    yield f"{package.__name__}.{name}.{part}".rstrip("."), function


def fault_of(function):
    """Return how the arguments and the result in a docstring differ from the signature; "" where they agree."""
    signature = inspect.signature(function)
    _, *parts = SECTION.split(inspect.cleandoc(function.__doc__))
    sections = dict(zip(parts[::2], parts[1::2], strict=True))
    heads = re.findall(r"^([*\w, ]+?)(?: :.*)?$", sections.get("Parameters", ""), re.MULTILINE)
    listed = [each.strip(" *") for head in heads if not head.startswith(" ") for each in head.split(",")]
    taken = [name for name in signature.parameters if name not in ("self", "cls")]
    if listed != taken:
        return f"lists {listed}, takes {taken}"
    gives = signature.return_annotation not in ("None", None, inspect.Signature.empty)
    return "says nothing of its result" if gives and sections.keys().isdisjoint(("Returns", "Yields")) else ""


def test_docstrings_list_what_signatures_have():
    found = {name: fault for name, function in functions() if (fault := fault_of(function))}
    assert not found, "\n".join(f"{name} {fault}" for name, fault in found.items())


def test_a_docstring_that_lists_something_else_is_found():
    def half(number: float) -> float:
        """Halve a number."""
        return number / 2.0

    assert fault_of(half) == "lists [], takes ['number']"
    half.__doc__ += "\n\nParameters\n----------\nnumber : float\n    The number.\n"
    assert fault_of(half) == "says nothing of its result"
    half.__doc__ += "\nReturns\n-------\nfloat\n    The half.\n"
    assert fault_of(half) == ""


def test_no_docstring_begins_with_return_what():
    functions = [(path, each) for path, text in sources().items() for each in nodes(text)[ast.FunctionDef]]
    begun = [(path, each.name) for path, each in functions if (ast.get_docstring(each) or "").lower().startswith("return what")]
    assert begun == []
