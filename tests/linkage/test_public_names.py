"""Public names: a design and a motion show what the page of reference explains, and docstrings list what signatures have."""

import ast
import inspect
import re
import sys
from importlib import import_module
from pathlib import Path

import pytest

import hydraulics
import linkage
import mechanisms
from hydraulics import LiftCircuit, isothermal
from linkage import Mechanism, equations, most
from mechanisms.classics.four_bar import FourBar
from mechanisms.mower_lift import MowerLift
from tests.tools.sources import nodes, sources

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "reference.md"
sys.path.insert(0, str(DOCS))
from made import api  # noqa: E402


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


SECTION = re.compile(r"^(Parameters|Returns|Raises|Yields|Notes|Examples|Attributes)\n-+\n", re.MULTILINE)


def public():
    """Yield the classes and functions of the reference, and the public methods of its classes: name, thing, docstrings from base on."""
    doors = {each.__name__: each.__all__ for each in (linkage, hydraulics, mechanisms)}
    doors |= {door: api.door_names(door) for door in api.OTHERS if door not in doors}
    for door, name in ((door, name) for door, names in doors.items() for name in names):
        thing = getattr(import_module(door), name)
        if inspect.isclass(thing):
            yield f"{door}.{name}", thing, [vars(base).get("__doc__") for base in thing.__mro__]
            for part, member in vars(thing).items():
                method = getattr(member, "__func__", member)
                if inspect.isfunction(method) and not part.startswith("_"):
                    yield f"{door}.{name}.{part}", method, [getattr(base, part, None).__doc__ for base in thing.__mro__]
        elif inspect.isfunction(thing):
            yield f"{door}.{name}", thing, [thing.__doc__]


def sections_of(docstring):
    """Return the sections of a docstring by their headings."""
    _, *parts = SECTION.split(inspect.cleandoc(docstring or ""))
    return dict(zip(parts[::2], parts[1::2], strict=True))


def listed(section):
    """Return the names that a section lists."""
    heads = re.findall(r"^([*\w, ]+?)(?: :.*)?$", section, re.MULTILINE)
    return [each.strip(" *") for head in heads if not head.startswith(" ") for each in head.split(",")]


def fault_of(thing, docstrings):
    """Return how the arguments and the result in docstrings, own and bases', differ from the signature; "" if one agrees."""
    signature = inspect.signature(thing)
    taken = [name for name in signature.parameters if name not in ("self", "cls")]
    gives = not inspect.isclass(thing) and signature.return_annotation not in ("None", None, inspect.Signature.empty)
    faults = [fault_in(sections_of(each), taken, gives, inspect.isclass(thing)) for each in docstrings if each]
    return "" if "" in faults else faults[0] if faults else "has no docstring"


def fault_in(sections, taken, gives, is_class):
    """Return the same of one docstring. A class that only the framework makes lists attributes instead, and may list more."""
    shown_ones = [name for name in taken if not name.startswith("_")]
    found = listed(sections.get("Parameters", ""))
    if is_class and not found and shown_ones and listed(sections.get("Attributes", ""))[: len(shown_ones)] == shown_ones:
        return ""
    if found != taken:
        return f"lists {found}, takes {taken}"
    return "says nothing of its result" if gives and sections.keys().isdisjoint(("Returns", "Yields")) else ""


def test_docstrings_list_what_signatures_have():
    found = {name: fault for name, thing, docstrings in public() if (fault := fault_of(thing, docstrings))}
    assert not found, "\n".join(f"{name} {fault}" for name, fault in found.items())


def test_a_docstring_that_lists_something_else_is_found():
    def half(number: float) -> float:
        """Halve a number."""
        return number / 2.0

    parameters, result = "\n\nParameters\n----------\nnumber : float\n    The number.\n", "\nReturns\n-------\nfloat\n    The half.\n"
    assert fault_of(half, [half.__doc__]) == "lists [], takes ['number']"
    assert fault_of(half, [half.__doc__ + parameters]) == "says nothing of its result"
    assert fault_of(half, ["Halve.", half.__doc__ + parameters + result]) == ""


@pytest.mark.parametrize("heading", ["Parameters", "Attributes"])
def test_a_class_that_does_not_list_its_arguments_is_found(heading):
    class Pair:
        def __init__(self, a: float, b: float) -> None:
            self.a, self.b = a, b

    text = f"Two numbers.\n\n{heading}\n{'-' * len(heading)}\nb, a : float\n    The numbers.\n"
    assert "takes ['a', 'b']" in fault_of(Pair, [text])
    assert fault_of(Pair, [text.replace("b, a", "a, b")]) == ""


def test_no_docstring_begins_with_return_what():
    functions = [(path, each) for path, text in sources().items() for each in nodes(text)[ast.FunctionDef]]
    begun = [(path, each.name) for path, each in functions if (ast.get_docstring(each) or "").lower().startswith("return what")]
    assert begun == []


def test_former_names_give_the_new_ones_with_a_warning():
    lift = MowerLift()
    motion, line = lift.sweep(3), next(iter(lift.plan.of_kind(LiftCircuit).values()))
    pairs = [
        (line, "held", "relief_pressure"), (motion.over, "kept", "condition_mask"), (isothermal, "spelled", "source_text"),
        (equations(lift), "together", "iterated_pins"), (most("G_y"), "of", "from_leaves"),
    ]  # fmt: skip
    for holder, former, new in pairs:
        with pytest.warns(FutureWarning, match=rf"\.{former} is {new} now"):
            assert getattr(holder, former) == getattr(holder, new), former
