"""Steps and force elements of one's own as files: there and back without a registration, by the import path of their class."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np
import pytest

from linkage import LEFT, Crank, DefinitionError, Dimension, Dyad, FileError, Ground, Guide, Mechanism, Stroke, deg, driving_force, mm, ref
from linkage.files import from_dict, load, to_dict, to_json, to_toml
from linkage.loads import ForceElement, Load, TwoPoint, Weight
from linkage.quantities import Driven, Joint, JointSide, quantity
from linkage.steps import UNBOUND, Slot, Step
from tests.for_all import for_all


class CamFollower(Step):
    """A point X on a guide, lifted by a cam from the distance PX on: PX + rise (1 - cos(angle)) / 2 from the guide's origin P."""

    P: str
    guide: str
    PX: Any = UNBOUND
    parent_letters = ("P", "guide")
    expects = (("P", "point"), ("guide", "guide"))

    def __init__(
        self, P: Any, guide: Any, *, angle: Any, rise: Any = 0.0, table: Sequence[float] = (), profile: str = "cosine", **lengths: Any
    ) -> None:
        super().__init__(P, guide, labels=lengths)
        self.angle, self.rise, self.table, self.profile = quantity(angle), quantity(rise), tuple(table), profile
        if profile not in ("cosine", "table"):
            raise ValueError(f"{profile} is no profile")

    def parts(self):
        return *super().parts(), self.angle, self.rise

    def slots(self):
        return (Slot("PX", (self.P, self.X)),)

    def check(self):
        if self.PX is UNBOUND:
            raise self.missing(self.slots()[0])

    def lift(self, where):
        cos, _ = where.turn(self.angle)
        by_table = sum(each * cos**power for power, each in enumerate(self.table))
        return by_table + where.value(self.rise) * (1.0 - cos) * 0.5

    def place(self, where):
        return where.line(self.guide).at(where.value(self.PX) + self.lift(where))

    def constraints(self, where):
        miss = where.at(self.X) - self.place(where)
        return miss.x, miss.y

    def joints(self):
        on, by = JointSide((self.X,), "runner"), JointSide((self.guide,), "guide")
        guide = self.guide
        return (Joint("driven", self.X, on, by, "nt", lambda where: where.line(guide), (guide,), (Driven(self.angle, "t"),)),)

    def arguments(self):
        return [*super().arguments(), f"angle={self.angle}", f"rise={self.rise}", f"table={self.table}", f"profile={self.profile!r}"]


@dataclass(frozen=True, eq=False)
class GasStrut(TwoPoint):
    """A strut of one's own law: it pushes with `force` [N], more by `progress` [N/m] the shorter it is than `free` [m]."""

    A: Any
    B: Any
    force: Any
    free: Any = 0.3
    progress: Any = 0.0
    parameters: ClassVar = MappingProxyType({"force": "N", "free": "mm", "progress": ""})

    def push(self, motion, length, rate):
        return self.number(motion, "force") + self.number(motion, "progress") * (self.number(motion, "free") - length)


@dataclass(frozen=True, eq=False)
class Wind(ForceElement):
    """The wind on an area [m2] at a point, from a direction given by two numbers."""

    point: Any
    area: Any
    pressure: Any = 500.0
    direction: tuple[float, float] = (1.0, 0.0)
    gusty: bool = False
    terrain: str = "open"
    parameters: ClassVar = MappingProxyType({"area": "", "pressure": "Pa"})

    def loads(self, motion):
        size = self.number(motion, "area") * self.number(motion, "pressure") * (2.0 if self.gusty else 1.0)
        return [Load(self.point if isinstance(self.point, str) else self.point.name, np.stack([size * each for each in self.direction]))]


class Valve(Mechanism):
    """A cam lifts a follower, a rod hangs from it."""

    phi = Stroke(10 * deg, 100 * deg)
    h = Dimension(20 * mm, unit="mm")
    O = Ground(0.0, 0.0)
    E = Ground(0.3, 0.1)
    rail = Guide(O, angle=90 * deg)
    A = Crank(O, OA=0.05, angle=phi)
    X = CamFollower(O, rail, OX=0.1, angle=ref("phi") * 2, rise=h / 2, table=(0.001, 0.002), profile="table")
    Y = CamFollower("O", "rail", OY=0.2, angle=phi)
    C = Dyad(E, X, EC=0.25, XC=0.2, side=LEFT)
    load = Weight(C, mass=2)
    strut = GasStrut(A, E, force=ref("h") * 1000, progress=50)
    second = GasStrut("C", "E", force=120.5, free=310 * mm)
    wind = Wind(C, area=0.5, direction=(0.0, 2.0), gusty=True, terrain="town")
    breeze = Wind("X", area=ref("h"))


def same(first, second):
    """Assert that two machines move alike and bear the same forces, to the last bit."""
    one, two = first.sweep(5), second.sweep(5)
    for name in "AXYC":
        assert np.array_equal(one[name], two[name])
    assert np.array_equal(driving_force(one), driving_force(two))


@pytest.mark.parametrize("write", [to_toml, to_json])
def test_own_classes_come_back(write):
    back = load(write(Valve))
    assert type(back.plan.members["X"]) is CamFollower and type(back.plan.members["strut"]) is GasStrut
    assert str(back.plan) == str(Valve.plan)
    assert back.plan.defaults == Valve.plan.defaults
    assert write(back) == write(Valve)
    same(Valve(), back())


def test_own_classes_are_written_by_their_arguments():
    tables, path = to_dict(Valve), f"{__name__}:"
    assert tables["points"]["X"] == {
        "kind": f"{path}CamFollower", "P": "O", "guide": "rail", "OX": 0.1, "angle": "phi * 2.0", "rise": "h / 2.0",
        "table": [0.001, 0.002], "profile": "table",
    }  # fmt: skip
    assert tables["points"]["Y"] == {
        "kind": f"{path}CamFollower", "P": "O", "guide": "rail", "OY": 0.2, "angle": "phi", "profile": "cosine"
    }  # fmt: skip
    assert tables["loads"] == {
        "load": {"Weight": "C", "mass": 2},
        "strut": {"kind": f"{path}GasStrut", "A": "A", "B": "E", "force": "h * 1000.0", "progress": 50},
        "second": {"kind": f"{path}GasStrut", "A": "C", "B": "E", "force": 120.5, "free": "310 mm"},
        "wind": {"kind": f"{path}Wind", "point": "C", "area": 0.5, "direction": [0.0, 2.0], "gusty": True, "terrain": "town"},
        "breeze": {"kind": f"{path}Wind", "point": "X", "area": "h"},
    }  # fmt: skip


def test_instance_saves_what_its_own_classes_are_set_to():
    design = Valve(**{"OX": 0.11, "second.force": 90.0, "wind.area": 0.25, "h": 0.03})
    back = load(to_toml(design))
    assert back().dimensions == design.dimensions
    same(design, back())


def changed(section, name, **keys):
    """Return the tables with keys of a member changed, or taken out where they are None."""
    tables = to_dict(Valve)
    tables[section][name] = {key: each for key, each in (tables[section][name] | keys).items() if each is not None}
    return tables


@for_all(
    ("tables", "words"),
    [
        (changed("points", "X", OX=None), r"points\.X: X = CamFollower\(O, rail\): the length OX/XO is missing"),
        (changed("points", "X", angle=None), r"points\.X\.angle: is missing"),
        (changed("points", "X", guide="O"), r"points\.X\.guide: O of \[ground\] is not a guide"),
        (changed("points", "X", P="Q"), r"points\.X\.P: Point 'Q' is unknown"),
        (changed("points", "X", rise="phi + Z"), r"points\.X\.rise: 'phi \+ Z': Quantity 'Z' is unknown"),
        (changed("points", "X", AX=0.3), r"points\.X: .*the label 'AX' does not fit"),
        (changed("points", "X", table=[[[[1]]]]), r"points\.X\.table: .*more than 3 deep"),
        (changed("points", "X", profile=3), r"points\.X\.profile: 3 stands where a word in quotes"),
        (changed("points", "X", profile="odd"), r"points\.X: CamFollower\(\.\.\.\) raises ValueError: odd is no profile"),
        (changed("loads", "strut", free="3 bar"), r"loads\.strut\.free: '3 bar' is a pressure where a value of kind length"),
        (changed("loads", "strut", B="A"), r"loads\.strut: .*begins and ends at A"),
        (changed("loads", "wind", gusty=1), r"loads\.wind\.gusty: 1 is neither true nor false"),
        (changed("loads", "wind", speed=1), r"loads\.wind\.speed: is not a key of it"),
        (changed("points", "X", Dyad=["O", "E"]), r"points\.X: it is Dyad and kind at once"),
        (changed("points", "X", kind=3), r'points\.X: 3 is no import path of a class; write "package\.module:Class"'),
        (changed("points", "X", kind="os.system"), r"points\.X: 'os\.system' is no import path of a class"),
        (changed("points", "X", kind="os:system"), r"points\.X: os:system is no class of members that stand in \[points\]"),
        (changed("points", "X", kind="os:path.sep.join"), r"points\.X: os:path\.sep\.join is no class of members"),
        (changed("points", "X", kind="builtins:eval"), r"points\.X: builtins:eval is no class of members"),
        (changed("points", "X", kind=f"{__name__}:Wind"), r"points\.X: .*:Wind is no class of members that stand in \[points\]"),
        (changed("points", "X", kind=f"{__name__}:Gone"), r"points\.X: .*:Gone is no class of members"),
        (changed("points", "X", kind="linkage.steps:Step"), r"points\.X: linkage\.steps:Step is abstract"),
        (changed("points", "X", kind="mycams.flat:Cam"), r'points\.X: mycams\.flat:Cam is not imported.*trust=\["mycams"\]'),
        (changed("points", "X", kind="..os:path"), r"points\.X: '\.\.os:path' is no import path"),
    ],
)  # fmt: skip
def test_mistake_is_said_in_words(tables, words):
    with pytest.raises(FileError, match=words):
        from_dict(tables)


class Forgetful(Wind):
    """A load that does not keep what it is given."""

    def __init__(self, point, area, height=0.0):
        super().__init__(point, area * 2.0)


def test_what_a_member_does_not_keep_is_refused():
    with pytest.raises(DefinitionError, match=r"wind cannot be written into a file: it has no attribute height; let its class keep"):
        to_toml(type("Other", (Valve,), {"wind": Forgetful("C", 1.0)}))


def test_a_label_may_be_the_word_kind():
    points = {"ki": Ground(0.0, 0.0), "nd": Dyad("ki", "E", kind=0.2, End=0.25, side=LEFT)}
    back = load(to_toml(type("Named", (Valve,), points)))
    assert back.plan.defaults["kind"] == 0.2


def test_class_inside_a_function_is_refused():
    class Own(GasStrut):
        """A class that no import path leads to."""

    with pytest.raises(DefinitionError, match=r"a file cannot hold a Own\. .*define it in a module, outside functions"):
        to_toml(type("Other", (Valve,), {"second": Own("C", "E", force=1.0)}))


# -- whose code is run -------------------------------------------------------------------------------------


@pytest.fixture
def package(tmp_path, monkeypatch):
    """Install a package of a user beside the process; it leaves a mark where it is run."""
    (tmp_path / "own_struts").mkdir()
    (tmp_path / "own_struts" / "__init__.py").write_text("")
    (tmp_path / "own_struts" / "plain.py").write_text(
        f"from pathlib import Path\nfrom {__name__} import GasStrut\nPath({str(tmp_path / 'mark')!r}).touch()\n"
        "class Strut(GasStrut):\n    '''A strut of a package.'''\n"
    )
    (tmp_path / "own_struts" / "broken.py").write_text("1 / 0\n")
    monkeypatch.syspath_prepend(tmp_path)
    yield tmp_path / "mark"
    for name in [each for each in sys.modules if each.partition(".")[0] == "own_struts"]:
        del sys.modules[name]


PATH = "own_struts.plain:Strut"


def test_a_file_runs_no_code_that_is_not_trusted(package):
    tables = changed("loads", "strut", kind=PATH)
    for trust in ((), ["own"], ["own_struts.pla"], ["own_struts.plain.more"], ["plain"]):
        with pytest.raises(FileError, match=r'loads\.strut: own_struts\.plain:Strut is not imported.*, trust=\["own_struts"\]\)'):
            from_dict(tables, trust=trust)
    assert not package.exists()


@pytest.mark.parametrize("trust", [["own_struts"], ("own_struts.plain",), {"json", "own_struts"}])
def test_a_trusted_package_is_imported(package, trust):
    machine = from_dict(changed("loads", "strut", kind=PATH), trust=trust)
    assert package.exists()
    assert type(machine.plan.members["strut"]).__name__ == "Strut"
    assert to_toml(load(to_toml(machine))) == to_toml(machine)  # once it is imported it need not be trusted again


def test_what_cannot_be_imported_is_said(package):
    with pytest.raises(FileError, match=r"loads\.strut: own_struts\.broken cannot be imported: ZeroDivisionError: division by zero"):
        from_dict(changed("loads", "strut", kind="own_struts.broken:Strut"), trust=["own_struts"])
    with pytest.raises(FileError, match=r"loads\.strut: own_struts\.none cannot be imported: ModuleNotFoundError"):
        from_dict(changed("loads", "strut", kind="own_struts.none:Strut"), trust=["own_struts"])
    for trust in ("own_struts", None, [3], [""]):
        with pytest.raises(DefinitionError, match=r"is no list of packages; write trust="):
            load(to_toml(Valve), trust=trust)
