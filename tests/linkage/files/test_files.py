"""Mechanisms as files: every kind of member there and back, exact to the last bit; mistakes with key and line."""

from importlib.metadata import EntryPoint
from math import pi
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import LEFT, Crank, DefinitionError, Dyad, FileError, Ground, Link, Mechanism, Pin, Stroke, deg, mm, plugins, ref
from linkage.cli import main
from linkage.files import from_dict, load, registry, save, to_dict, to_json, to_toml
from linkage.quantities import Member, name_of, quantity
from tests import shipped
from tests.for_all import for_all
from tests.linkage.files.file_machines import Drawn, EveryStep, Hitch, Loaded, Parts

DATA = Path(__file__).parents[1] / "data"


SHIPPED = shipped.MACHINES
OWN = {each.__name__: each for each in (Hitch, EveryStep, Parts, Drawn, Loaded)}
MACHINES = {**SHIPPED, **OWN}
ALL = for_all("name", [*shipped.DAILY, *OWN], slow=shipped.OTHERS)


def same_motion(first, second):
    """Assert that two designs move alike to the last bit."""
    strokes = {name: np.linspace(stroke.start, stroke.end, 5) for name, stroke in first.strokes.items()}
    one, two = (each.at(unreachable="nan", **strokes) for each in (first, second))
    for name in first.plan.valued_members:
        assert np.array_equal(one[name], two[name], equal_nan=True), name


# -- there and back ----------------------------------------------------------------------------------------


@ALL
def test_machine_comes_back_as_it_was(name):
    machine = MACHINES[name]
    text = to_toml(machine)
    back = load(text)
    assert str(back.plan) == str(machine.plan)
    assert back.plan.defaults == machine.plan.defaults
    assert list(back.plan.strokes) == list(machine.plan.strokes)
    assert to_toml(back) == text
    same_motion(machine(), back())


@pytest.mark.slow
@ALL
def test_json_says_the_same(name):
    machine = MACHINES[name]
    back = load(to_json(machine))
    assert str(back.plan) == str(machine.plan)
    assert to_json(back) == to_json(machine)
    assert to_toml(back) == to_toml(machine) == to_toml(from_dict(to_dict(machine)))


def test_docstring_and_name_are_kept():
    back = load(to_toml(EveryStep))
    assert back.__name__ == "EveryStep"
    assert back.__doc__ == 'Every step once.\n\nIts docstring has "quotes", a \\ and a triple """ as well.'
    assert isinstance(back(OB=0.31).sweep(S=2, phi=2)["G"], np.ndarray)


def test_units_are_kept_where_they_are_exact():
    tables = to_dict(EveryStep)
    assert tables["dimensions"] == {"L0": 0.5, "whole": 2, "mass": "900 kgf", "odd": f"{1 / 3!r} kgf"}
    assert tables["points"]["D"]["BOD"] == "33 deg"
    assert tables["strokes"] == {"phi": [0.2, "40 deg"], "S": [0, 0.2]}
    assert load(to_toml(EveryStep)).plan.table.entries["mass"].unit == "kgf"


def test_order_is_said_where_the_sections_do_not_keep_it():
    class Mixed(Mechanism):
        A = Ground(0.0, 0.0)
        S = Stroke(0.4, 0.5)
        O = Ground(0.6, 0.0)
        B = Dyad(A, O, AB=S, OB=0.3, side=LEFT)

    tables = to_dict(Mixed)
    assert tables["order"] == ["A", "S", "O", "B"]
    assert "order" not in to_dict(Hitch)
    assert str(load(to_toml(Mixed)).plan) == str(Mixed.plan)
    del tables["order"][1]
    assert list(from_dict(tables).plan.strokes) == ["S"]  # what it does not mention stands behind


def test_names_of_any_alphabet():
    φ, Ж = Stroke(0.0, 1.0), Ground(0.0, 0.0)
    machine = type("Wheel", (Mechanism,), {"φ": φ, "Ж": Ж, "Q": Crank(Ж, ЖQ=0.1, angle=φ), "Ж_1": Crank("Ж", ЖЖ_1=0.2, angle=φ)})
    text = to_toml(machine)
    assert '"Ж" = [0.0, 0.0]' in text
    assert str(load(text).plan) == str(machine.plan)


def test_long_members_get_tables_of_their_own():
    links = {f"point_of_a_long_name_{k}": Pin(at=(0.1 * k, 0.01 * k * k)) for k in range(2, 7)}
    labels = {f"Opoint_of_a_long_name_{k}": 0.1 * k for k in range(2, 5)}
    base = {"S": Stroke(0.0, 1.0), "O": Ground(0.0, 0.0), "A": Crank("O", OA=0.1, angle="S")}
    machine = type("Long", (Mechanism,), {**base, "body": Link("O", "A", *links, **labels), **links})
    text = to_toml(machine)
    assert "[links.body]" in text
    assert max(map(len, text.splitlines())) <= 150
    assert to_toml(load(text)) == text


# -- an instance -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("Hitch", {"OB": 0.32, "M": (0.21, 0.96), "L0": 0.51, "KFG": 1.25}),
        ("EveryStep", {"OB": 0.29, "L0": 0.52, "EO": 0.3, "FA": 0.5, "DOB": -0.6, "rail.y": -0.31, "post.angle": 1.7, "mass": 1.0}),
        ("toggle_press", {"OA": 0.31, "axis.x": 0.001}),
    ],
)
def test_instance_saves_its_dimensions(name, changes):
    design = MACHINES[name](**changes)
    back = load(to_toml(design))
    assert back().dimensions == pytest.approx(design.dimensions, rel=0, abs=0)
    assert list(back().dimensions) == list(design.dimensions)
    same_motion(design, back())


def test_unchanged_instance_is_its_class():
    assert to_toml(MACHINES["klann"]()) == to_toml(MACHINES["klann"])


@pytest.mark.parametrize(("name", "changes"), [("Parts", {"BG": 0.102, "AB": 0.101}), ("Drawn", {"EG": 0.112, "OA": 0.051})])
def test_instance_with_a_group_keeps_its_branch(name, changes):
    design = MACHINES[name](**changes)
    back = load(to_toml(design))
    assert {key: back.plan.defaults[key] for key in changes} == changes
    for point in design.plan.moving:
        assert_allclose(back().sweep(9)[point], design.sweep(9)[point], rtol=0, atol=1e-12)


def test_instance_far_from_its_sketch_keeps_its_side():
    class Far(Mechanism):
        S = Stroke(0.0, 0.1)
        A = Ground(0.0, 0.0)
        O = Ground(1.0, 0.0)
        B = Dyad(A, O, AB=0.6 + S, OB=0.6, near=(0.5, 0.3))

    design = Far(A=(0.9, 1.0), O=(0.2, 0.3))
    assert_allclose(load(to_toml(design))().sweep(3)["B"], design.sweep(3)["B"], rtol=0, atol=0)


def test_file_holds_one_design():
    with pytest.raises(DefinitionError, match="a file holds one design, this is a batch, OB has"):
        to_toml(Hitch(OB=np.array([0.30, 0.31])))


def test_member_that_no_file_holds_is_named():
    class Own(Dyad):
        """A step of a user."""

    class User(Mechanism):
        S = Stroke(0.4, 0.5)
        A = Ground(0.0, 0.0)
        O = Ground(0.6, 0.0)
        B = Own(A, O, AB=S, OB=0.3, side=LEFT)

    with pytest.raises(DefinitionError, match=r"B = Own\(.*a file cannot hold a Own"):
        to_toml(User)


# -- files -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("ending", ["toml", "json"])
def test_saved_and_loaded(tmp_path, ending):
    for path in (tmp_path / f"hitch.{ending}", str(tmp_path / f"again.{ending}")):
        save(Hitch(OB=0.31), path)
        assert load(path)()["OB"] == 0.31
        assert Path(path).read_bytes().count(b"\r") == 0


def test_hand_written_toml():
    boom = load(DATA / "loader_boom.toml")
    assert boom.plan.defaults["L0"] == 950 * mm
    assert boom.plan.defaults["A.y"] == 900 * mm
    assert boom.plan.defaults["BOT"] == 8 * deg
    assert boom.plan.defaults["BOH"] == pi / 6
    assert boom.plan.table.entries["load"].unit == "kgf"
    assert "OH" not in boom.plan.defaults
    motion = boom().at(S=0.3, tilt=0.1)
    assert_allclose(motion["above"], motion.angle("O", "T") - 10 * deg, rtol=1e-15)
    assert_allclose(motion["reach"], motion.x("T") / mm, rtol=1e-15)
    assert to_toml(load(to_toml(boom))) == to_toml(boom)


def test_hand_written_json_is_the_shipped_machine():
    toggle, press = load(DATA / "toggle.json"), MACHINES["toggle_press"]
    assert [str(toggle.plan.members[name]) for name in press.plan.members] == [str(member) for member in press.plan.members.values()]
    same_motion(press(), toggle())


@pytest.mark.parametrize("prefix", [b"\xef\xbb\xbf", b"# a comment\r\n"])
def test_windows_files_are_read(tmp_path, prefix):
    (tmp_path / "a.toml").write_bytes(prefix + to_toml(EveryStep).replace("\n", "\r\n").encode())
    assert to_toml(load(tmp_path / "a.toml")) == to_toml(EveryStep)


def test_command_shows_a_file(capsys, monkeypatch):
    monkeypatch.chdir(DATA)
    assert main(["show", "loader_boom.toml"]) == 0
    out = capsys.readouterr().out
    for words in ("LoaderBoom", "A boom turned by one cylinder", "L0    950 mm", "load  900 kgf", "B = Dyad(A, O, AB=L0 + S, OB=1.1,"):
        assert words in out, out
    assert main(["table", "toggle.json", "--count", "3"]) == 0
    assert "travel" in capsys.readouterr().out


def test_command_says_every_mistake_in_a_line(capsys):
    assert main(["show", str(DATA / "many_mistakes.toml")]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.splitlines()[0] == "hydrolinkage: many_mistakes.toml: 11 mistakes:"
    assert len(err.splitlines()) == 12
    assert main(["show", str(DATA / "nowhere.toml")]) == 2
    assert "nowhere.toml: there is no such file" in capsys.readouterr().err


# -- kinds of other packages -------------------------------------------------------------------------------


class Maker(Member):
    """A kind of member that no package has: who made a part."""

    kind = "maker"
    file_section = "makers"
    expects = (("point", "point"), ("price", "quantity"))

    def __init__(self, point, price):
        self.point, self.price = point, quantity(price)

    def parts(self):
        return self.point, self.price

    def variables(self):
        return ((f"{self.name}.price", self.price.number, "not negative", ""),) if self.price.is_constant else ()

    def __str__(self):
        return f"Maker({name_of(self.point)}, {self.price})"


@pytest.fixture
def makers(monkeypatch):
    """Install a package that brings a kind of member."""
    point = EntryPoint("maker", f"{__name__}:Maker", plugins.MEMBERS)
    monkeypatch.setattr(plugins, "entry_points", lambda group: {"maker": point})
    registry.registry.cache_clear()
    yield
    registry.registry.cache_clear()


def test_package_brings_its_own_kind(makers):
    class Made(Hitch):
        smith = Maker("G", 1200)
        weaver = Maker("G", 100 * ref("L0"))

    text = to_toml(Made(**{"smith.price": 900.0}))
    assert text.endswith('[makers]\nsmith = { point = "G", price = 900.0 }\nweaver = { point = "G", price = "100.0 * L0" }\n')
    assert load(text).plan.defaults["smith.price"] == 900.0
    with pytest.raises(FileError, match=r"makers\.smith: smith = .*negative"):
        load(text.replace("900.0", "-900.0"))


def test_without_that_package_the_kind_is_refused(makers):
    text = to_toml(type("Made", (Hitch,), {"smith": Maker("G", 1200)}))
    registry.registry.cache_clear()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(plugins, "entry_points", lambda group: {})
        with pytest.raises(FileError, match=r"makers: is not a section; there are name, .*\. The kinds of \[hydraulics\] are not"):
            load(text)
        with pytest.raises(DefinitionError, match="a file cannot hold a Maker"):
            to_toml(type("Made", (Hitch,), {"smith": Maker("G", 1200)}))


def test_package_that_cannot_be_loaded_is_named(monkeypatch):
    gone = EntryPoint("gone", "no_such_package:Entry", plugins.MEMBERS)
    monkeypatch.setattr(plugins, "entry_points", lambda group: {"gone": gone})
    registry.registry.cache_clear()
    with pytest.raises(DefinitionError, match=r"the entry gone \(no_such_package:Entry\) of a file cannot be loaded: .*: No module"):
        to_toml(Hitch)
    registry.registry.cache_clear()
