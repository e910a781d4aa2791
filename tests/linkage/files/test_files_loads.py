"""Loads and load cases as files: every kind there and back, with the same forces; mistakes in words."""

from functools import cache
from importlib.metadata import EntryPoint
from typing import ClassVar

import numpy as np
import pytest

from linkage import DefinitionError, FileError, Mechanism, Pulley, Rope, bar, driving_force, pin_forces, plugins, ref
from linkage.files import from_dict, left_out, load, registry, to_dict, to_json, to_toml
from linkage.loads import ForceElement, Load, LoadCase, Support, Weight
from linkage.units import N, kgf, kN
from tests.for_all import for_all
from tests.linkage.files.file_machines import Hitch, Loaded, changed

DIRECTIONS = ("frictionless", "extending", "retracting")
CASES = (None, "transport", "bare")


def forces(machine, case, direction):
    """Return all joint forces, couples and drives of a machine in one array."""
    found = pin_forces(machine.sweep(7), case=case, direction=direction)
    parts = [each.force for each in found.joints] + [each.couple[None] for each in found.joints] + [found.drives["S"][None]]
    return np.concatenate(parts)


@cache
def returned(write):
    """Return the class that a file gives of the loaded hitch."""
    return load(write(Loaded))


@pytest.mark.slow
@for_all("direction", DIRECTIONS)
@for_all("case", CASES)
@for_all("write", [to_toml, to_json])
def test_loads_come_back_with_their_forces(write, case, direction):
    back = returned(write)()
    assert np.array_equal(forces(back, case, direction), forces(Loaded(), case, direction))
    one, two = (driving_force(each.sweep(7), case=case, direction=direction) for each in (back, Loaded()))
    assert np.array_equal(one, two)


def test_every_load_is_written_as_it_is_said():
    tables = to_dict(Loaded)
    assert set(type(member) for member in vars(Loaded).values() if isinstance(member, ForceElement)) == {
        entry.describes for entry in registry.OWN if entry.section == "loads" and entry.describes not in (Rope, Pulley)
    }
    assert tables["loads"] == {
        "load": {"Weight": "G", "mass": 2000},
        "half": {"Weight": "F", "mass": "m1 / 2.0"},
        "moon": {"Weight": "K", "mass": "m1", "gravity": [0.0, -1.62]},
        "pull": {"Force": "F", "vector": [-5000.0, 0]},
        "push": {"Force": "P", "vector": ["m1 * 2.0", 1.25]},
        "drag": {"Moment": "O B", "M": -250},
        "turn": {"Moment": "arm", "M": 0.5},
        "own": {"LinkMass": "E D F", "mass": 30, "at": [0.45, 0]},
        "bar": {"LinkMass": "arm", "mass": 12.5},
        "relief": {"Spring": ["A", "C"], "stiffness": 20000.0, "free_length": "400 mm"},
        "taut": {"Spring": ["A", "B"], "stiffness": 5000.0, "preload": 800},
        "strut": {"Damper": ["E", "C"], "coefficient": 2000},
        "ram": {"Actuator": ["E", "D"], "force": -1500},
        "shoe": {"Support": "F", "direction": [0, 2], "force": -100.0},
        "pin_E": {"PinFriction": "E", "radius": "20 mm", "coefficient": 0.15},
        "slide": {"GuideFriction": "P", "coefficient": 0.1, "guide": "rail"},
    }
    assert tables["cases"] == {
        "transport": {"title": "on the road", "scale": {"load": 2.0, "pull": 0}, "slope": "10 deg"},
        "bare": {"only": ["load", "own", "pin_E"], "gravity": [0, -1.62]},
        "as_declared": {},
    }


def test_instance_saves_what_its_loads_are_set_to():
    design = Loaded(**{"load.mass": 900.0, "pull.x": -1.0, "pin_E.radius": 0.0301, "relief.free_length": 0.41, "m1": 250.0})
    back = load(to_toml(design))
    assert back().dimensions == design.dimensions
    assert np.array_equal(forces(back(), None, "extending"), forces(design, None, "extending"))
    assert not np.array_equal(forces(back(), None, "extending"), forces(Loaded(), None, "extending"))


def test_amounts_have_units():
    tables = changed("loads", "w", to={"Weight": "G", "mass": "2 t"})
    tables["loads"] |= {
        "f": {"Force": "G", "vector": ["-5 kN", "10 kgf"]}, "turn": {"Moment": "O B", "M": "-(2 kNm)"},
        "p": {"PinFriction": "O", "radius": " 70mm ", "coefficient": 0.1}, "s": {"Support": "F", "direction": [0, 1], "force": "0 N"},
        "c": {"Spring": ["A", "B"], "stiffness": "20 kN / m", "free_length": "2 * 20 cm"},
    }  # fmt: skip
    tables["cases"] = {"hill": {"slope": "-8.5 deg"}}
    machine = from_dict(tables)
    assert machine.plan.defaults["w.mass"] == 2000.0
    assert (machine.plan.defaults["f.x"], machine.plan.defaults["f.y"]) == (-5 * kN, 10 * kgf)
    assert machine.plan.defaults["turn.M"] == -2 * kN
    assert machine.plan.defaults["p.radius"] == 0.07
    assert machine.plan.defaults["c.stiffness"] == 20 * kN
    assert machine.plan.defaults["s.force"] == 0 * N
    assert machine.plan.members["hill"].slope == -8.5 * np.pi / 180


def test_names_are_kept_as_they_refer():
    class Heavier(Loaded):
        m1 = ref("L0") * 4

    assert load(to_toml(Heavier))().at(S=0.1).value(ref("m1")) == 2.0
    assert str(load(to_toml(Heavier)).plan) == str(Heavier.plan)


WEIGHT = {"Weight": "G", "mass": 10}


@for_all(
    ("tables", "words"),
    [
        (changed("loads", "w", to=WEIGHT | {"mass": "5 bar"}), r"loads\.w\.mass: '5 bar' is a pressure where a value of kind mass"),
        (changed("loads", "w", to=WEIGHT | {"mass": -1}), r"loads\.w: Weight\(G, mass=-1\): mass=-1 is negative"),
        (changed("loads", "w", to=WEIGHT | {"mass": "m9"}), r"loads\.w\.mass: 'm9': Quantity 'm9' is unknown"),
        (changed("loads", "w", to=WEIGHT | {"mass": None}), r"loads\.w\.mass: None is not a finite number"),
        (changed("loads", "w", to={"Weight": "G"}), r"loads\.w\.mass: is missing"),
        (changed("loads", "w", to=WEIGHT | {"weight": 3}), r"loads\.w\.weight: is not a key of it"),
        (changed("loads", "w", to={"Weight": "S", "mass": 1}), r"loads\.w\.Weight: S of \[strokes\] is not a point"),
        (changed("loads", "w", to={"Wight": "G"}), r"loads\.w: Kind 'Wight' is unknown\. Did you mean Weight\? Known: Weight, Force"),
        (changed("loads", "w", to=WEIGHT | {"gravity": 9.81}), r"loads\.w\.gravity: 9\.81 is not two numbers"),
        (changed("loads", "f", to={"Force": "G", "vector": 3}), r"loads\.f\.vector: 3 is not a force of two parts in N"),
        (changed("loads", "f", to={"Force": "G", "vector": ["3 mm", 0]}), r"loads\.f\.vector: '3 mm' is a length where a value"),
        (changed("loads", "m", to={"Moment": "O", "M": 3}), r"loads\.m\.Moment: O of \[ground\] is not a link"),
        (changed("loads", "m", to={"Moment": "arm", "M": 3}), r"loads\.m\.Moment: Link 'arm' is unknown"),
        (changed("loads", "m", to={"Moment": "O Q", "M": 3}), r"loads\.m\.Moment: Point 'Q' is unknown"),
        (changed("loads", "m", to={"Moment": 7, "M": 3}), r"loads\.m\.Moment: 7 is not a body; name a link, or two of its points"),
        (changed("loads", "m", to={"Moment": "O O", "M": 3}), r"loads\.m\.Moment: 'O O' is not a body"),
        (changed("loads", "s", to={"Support": "F", "direction": [0, 0]}), r"loads\.s: Support: the direction \(0, 0\) has no finite"),
        (changed("loads", "s", to={"Support": "F", "direction": [0, "L0"]}), r"loads\.s\.direction: 'L0': a number is expected here"),
        (changed("loads", "g", to={"GuideFriction": "F", "coefficient": 0.1, "guide": "A"}), r"loads\.g\.guide: A of .* is not a guide"),
        (changed("cases", "c", to={"scale": {"w": 2}}), r"cases\.c\.scale\.w\S*: Load 'w' is unknown"),
        (changed("cases", "c", to={"scale": [2]}), r"cases\.c\.scale: is not a table"),
        (changed("cases", "c", to={"only": "w"}), r"cases\.c\.only: is not a list"),
        (changed("cases", "c", to={"only": ["G"]}), r"cases\.c\.only\.0: G of \[points\] is not a load"),
        (changed("cases", "c", to={"slope": "10 mm"}), r"cases\.c\.slope: '10 mm' is a length where a value of kind angle"),
        (changed("cases", "c", to={"title": 3}), r"cases\.c\.title: 3 stands where a word in quotes is expected"),
        (changed("loads", "Hitch", to=3), r"loads\.Hitch: 3 is no entry of \[loads\]\. Write it like `load = \{ Weight"),
    ],
)  # fmt: skip
def test_mistake_is_said_in_words(tables, words):
    with pytest.raises(FileError, match=words):
        from_dict(tables)


def test_all_mistakes_come_at_once():
    text = to_toml(Loaded).replace('"m1 / 2.0"', '"m9 / 2"').replace("30, at", '"30 bar", at').replace("M = -250", "N = -250")
    with pytest.raises(FileError) as caught:
        load(text)
    lines = text.splitlines()
    assert str(caught.value).startswith("the text: 4 mistakes:\n")
    for key in ("half.mass", "own.mass", "drag.M", "drag.N"):
        number = next(number for number, line in enumerate(lines, 1) if line.startswith(f"{key.split('.')[0]} = "))
        assert f"line {number}, loads.{key}: " in str(caught.value)


@pytest.mark.parametrize(
    ("member", "words"),
    [
        (Support("F", [[0, 1], [1, 1]]), r"Hitch_\.extra cannot be written into a file: \(0, 1\) is neither a number nor a word"),
        (LoadCase("\x07"), r"Hitch_\.extra cannot be written into a file: .* stands where a word in quotes is expected"),
    ],
)  # fmt: skip
def test_what_a_file_cannot_hold_is_refused(member, words):
    with pytest.raises(DefinitionError, match=words):
        to_toml(type("Hitch_", (Hitch,), {"extra": member}))


def test_what_is_left_out_is_said():
    class Checked(Hitch):
        limit = 3

        def __init__(self, **dimensions):
            super().__init__(**dimensions)

        def columns(self, motion):
            return []

    assert left_out(Checked) == left_out(Checked()) == ("__init__", "columns", "limit")
    assert left_out(Hitch) == ()
    assert left_out(load(to_toml(Checked))) == ()
    assert type(load(to_toml(Checked))()).columns is Mechanism.columns


# -- a kind of another package -----------------------------------------------------------------------------


class Drag(ForceElement):
    """A user's own load without a dataclass."""

    parameters: ClassVar = {"area": "", "pressure": "bar"}

    def __init__(self, point, area, pressure=2 * bar):
        self.point, self.area, self.pressure = point, area, pressure
        self.__post_init__()

    def loads(self, motion):
        size = self.number(motion, "area") * self.number(motion, "pressure")
        return [Load("G", np.stack(np.broadcast_arrays(size, 0.0 * size)))]


@pytest.fixture
def drags(monkeypatch):
    """Install a package that brings a kind of load."""
    point = EntryPoint("drag", f"{__name__}:Drag", plugins.MEMBERS)
    monkeypatch.setattr(plugins, "entry_points", lambda group: {"drag": point})
    registry.registry.cache_clear()
    yield
    registry.registry.cache_clear()


def test_package_brings_its_own_load(drags):
    machine = type("Windy", (Hitch,), {"load": Weight("G", mass=1200), "wind": Drag("G", area=1.5)})
    text = to_toml(machine(**{"wind.area": 2.0}))
    assert text.endswith('[loads]\nload = { Weight = "G", mass = 1200 }\nwind = { Drag = "G", area = 2.0, pressure = "2 bar" }\n')
    assert load(text).plan.defaults["wind.area"] == 2.0
    assert load(text.replace(', pressure = "2 bar"', "")).plan.defaults["wind.pressure"] == 2 * bar
    assert np.array_equal(driving_force(load(text)().sweep(3)), driving_force(machine(**{"wind.area": 2.0}).sweep(3)))


def test_without_that_package_its_kind_is_named_by_its_import_path():
    machine = type("Windy", (Hitch,), {"wind": Drag("G", area=1.5)})
    assert to_dict(machine)["loads"]["wind"] == {"kind": f"{__name__}:Drag", "point": "G", "area": 1.5, "pressure": "2 bar"}
    assert np.array_equal(driving_force(load(to_toml(machine))().sweep(3)), driving_force(machine().sweep(3)))
