"""Cylinders and circuits as files: there and back with the same pressures; what is wrong is said; without the plug-in too."""

import numpy as np
import pytest

from hydraulics import (
    Accumulator,
    AccumulatorBlock,
    Cylinder,
    FloatCircuit,
    LiftCircuit,
    OilLine,
    Pump,
    Relief,
    Tank,
    adiabatic,
    isothermal,
    polytropic,
    real_nitrogen,
)
from hydraulics.gas import Gas
from linkage import (
    RIGHT,
    DefinitionError,
    Dimension,
    Dyad,
    FileError,
    Force,
    Ground,
    Guide,
    Mechanism,
    OnGuide,
    OnLink,
    Stroke,
    deg,
    driving_force,
    plugins,
    ref,
)
from linkage.files import from_dict, load, registry, to_dict, to_json, to_toml
from linkage.loads import LoadCase, Weight
from linkage.units import bar, litre, minute, mm
from tests.for_all import first_daily, for_all

BLOCK = AccumulatorBlock([Accumulator(4 * litre, 50 * bar), Accumulator(4 * litre, 25 * bar)])


class Carried(Mechanism):
    """An arm carried by a cylinder on accumulators, with a pump beside."""

    S = Stroke(0.00, 0.25)
    S0 = Dimension(0.10)
    V = Dimension(2 * litre, unit="l")
    p = Dimension(25 * bar, unit="bar")
    n = Dimension(1.2)
    A = Ground(0.20, 0.55)
    O = Ground(0.30, 1.15)
    B = Dyad(A, O, AB=0.50 + S, OB=0.30, side=RIGHT)
    G = OnLink(O, B, OG=0.9)
    load = Weight(G, mass=600)
    ram = Cylinder(A, B, bore=63 * mm, rod=ref("thick"), count=2, stroke=0.25, closed=S0 + 0.4, mounting="fixed-pin", safety=4)
    thick = Dimension(40 * mm, unit="mm")
    pulling = Cylinder("A", "B", bore=0.08, rod=0.05, works="rod")
    pump = LiftCircuit(ram, pressure=180 * bar, flow=60 * litre / minute, mechanical_efficiency=ref("k"), back_pressure=2 * bar)
    k = Dimension(0.9)
    fixed = FloatCircuit(ram, BLOCK, charge_pressure=60 * bar, at=S0, seal_friction=3 * bar)
    line = FloatCircuit(
        "pulling", AccumulatorBlock([Accumulator(V / 2, p), Accumulator("V", charge=30 * bar)], atmosphere=0),
        charge_pressure=2 * p, at=0.1, exponent=n,
    )  # fmt: skip
    calm = LoadCase(scale={"line": 0.5}, only=["load", "line", "fixed"])


def numbers(machine, case=None):
    """Return the forces and the pressures of a machine in one array."""
    motion = machine.sweep(9)
    force = driving_force(motion, case=case)
    lines = [machine.plan.members[name].pressure(motion) for name in ("fixed", "line")]
    pump = machine.plan.members["pump"]
    return np.stack([force, *lines, pump.pressure_for(motion, case=case), pump.reserve(motion, case=case), np.full(9, pump.time(motion))])


@first_daily(1, "case", ["calm", None])
@pytest.mark.parametrize("write", [to_toml, to_json])
def test_circuits_come_back_with_their_pressures(write, case):
    back = load(write(Carried))
    assert str(back.plan) == str(Carried.plan)
    assert write(back) == write(Carried)
    assert np.array_equal(numbers(back(), case), numbers(Carried(), case), equal_nan=True)
    assert back().ram.checks(back().sweep(5)) == Carried().ram.checks(Carried().sweep(5))


def test_a_block_with_an_absent_vessel_and_a_unit_comes_back():
    block = AccumulatorBlock([Accumulator(0.0, 50 * bar), Accumulator(4 * litre, 25 * bar)], unit="MPa")
    spoken = type("Spoken", (Carried,), {"fixed": FloatCircuit("ram", block, charge_pressure=20 * bar)})
    back = load(to_toml(spoken))
    assert str(back.plan.members["fixed"]) == str(spoken.plan.members["fixed"])
    with pytest.raises(DefinitionError, match=r"charged to 2 MPa gauge it holds no fluid, .* being 2\.5 MPa gauge"):
        back.fixed.pressure(back().sweep(3))


def test_instance_saves_what_its_hydraulics_are_set_to():
    design = Carried(
        **{
            "ram.bore": 0.07,
            "ram.stroke": 0.26,
            "S0": 0.09,
            "thick": 0.041,
            "fixed.charge_pressure": 55 * bar,
            "V": 3 * litre,
            "n": 1.4,
            "pump.flow": 0.002,
        }
    )
    back = load(to_toml(design))()
    assert back.dimensions == design.dimensions
    assert np.array_equal(numbers(back), numbers(design), equal_nan=True)
    assert not np.array_equal(numbers(back), numbers(Carried()), equal_nan=True)


def test_what_stands_on_a_line_without_a_name_comes_back_and_a_pump_by_its_name():
    class Fitted(Mechanism):
        S = Stroke(0.0, 0.5)
        O = Ground(0.0, 0.0)
        rail = Guide(O, angle=90 * deg)
        P = OnGuide(rail, at=1.0 + S)
        push = Force(P, (0.0, -40e3))
        ram = Cylinder(O, P, bore=120 * mm, rod=85 * mm)
        line = OilLine("ram.piston_side", Pump(200 * bar), Relief(220 * bar))
        back = OilLine("ram.rod_side", Tank(5 * bar))
        T = Stroke(0.0, 0.5)
        Q = OnGuide(rail, at=2.0 + T)
        aid = Cylinder(P, Q, bore=40 * mm, rod=25 * mm)
        supply = Pump(160 * bar)
        other = LiftCircuit("aid", "supply")

    class Unnamed(Fitted):
        other = LiftCircuit("aid", Pump(160 * bar, flow=5e-4))

    alone = to_dict(Unnamed)["hydraulics"]["other"]
    assert alone == {"LiftCircuit": "aid", "pressure": {"pressure": "160 bar", "flow": "30 l/min"}}
    assert to_dict(from_dict(to_dict(Unnamed)))["hydraulics"]["other"] == alone
    written = to_dict(Fitted)
    assert written["hydraulics"]["other"] == {"LiftCircuit": "aid", "pressure": "supply"}
    assert written["hydraulics"]["line"] == {
        "OilLine": ["ram.piston_side", {"Pump": [], "pressure": "200 bar"}, {"Relief": [], "pressure": "220 bar"}]
    }
    back = from_dict(written)
    assert to_dict(back) == written
    assert np.array_equal(*(each.line.pressure(each().sweep(S=3, T=0.1)) for each in (back, Fitted)))
    written["hydraulics"]["back"]["OilLine"][1] = {"Tank": [], "presure": "5 bar"}
    with pytest.raises(FileError, match=r"hydraulics\.back\.OilLine\.presure: is not a key"):
        from_dict(written)


def test_hydraulics_are_written_as_they_are_said():
    assert to_dict(Carried)["hydraulics"] == {
        "ram": {"Cylinder": ["A", "B"], "bore": "63 mm", "rod": "thick", "count": 2, "stroke": "250 mm", "closed": "S0 + 0.4",
                "mounting": "fixed-pin", "safety": 4},
        "pulling": {"Cylinder": ["A", "B"], "bore": "80 mm", "rod": "50 mm", "works": "rod"},
        "pump": {"LiftCircuit": "ram", "pressure": "180 bar", "flow": "60 l/min", "mechanical_efficiency": "k", "back_pressure": "2 bar"},
        "fixed": {"FloatCircuit": "ram", "charge_pressure": "60 bar", "at": "S0", "seal_friction": "3 bar",
                  "accumulators": [{"volume": "4 l", "charge": "50 bar"}, {"volume": "4 l", "charge": "25 bar"}]},
        "line": {"FloatCircuit": "pulling", "charge_pressure": "2.0 * p", "at": 0.1, "exponent": "n", "atmosphere": 0,
                 "accumulators": [{"volume": "V / 2.0", "charge": "p"}, {"volume": "V", "charge": "30 bar"}]},
    }  # fmt: skip


@for_all(
    ("gas", "said"),
    [
        (adiabatic, "adiabatic"), (polytropic(1.0, 300), {"law": "polytropic", "n": 1.0, "temperature": 300}),
        (real_nitrogen(310.5), {"law": "real_nitrogen", "temperature": 310.5}), (isothermal, None),
    ],
    slow=[
        (polytropic(1.4), "adiabatic"), (polytropic(1.2), {"law": "polytropic", "n": 1.2}), (real_nitrogen(), "real_nitrogen"),
        (polytropic(1), None),
    ],
)  # fmt: skip
def test_gas_laws(gas, said):
    line = FloatCircuit("ram", AccumulatorBlock(BLOCK.accumulators, gas), charge_pressure=60 * bar, at=0.1)
    machine = type("Gassed", (Carried,), {"fixed": line})
    assert to_dict(machine)["hydraulics"]["fixed"].get("gas") == said
    back = load(to_toml(machine))
    assert str(back.plan) == str(machine.plan)
    assert np.array_equal(numbers(back()), numbers(machine()), equal_nan=True)


class Steady(Gas):
    """A gas law of a user."""

    def specific(self, pressure):
        return pressure

    pressure_of = slope = charge_at = at = fast_exponent = specific


def function_block(motion):
    return BLOCK


@pytest.mark.parametrize(
    ("block", "words"),
    [
        (function_block, r"floating cannot be written .*block is a Python function, which a file cannot hold; write AccumulatorBlock"),
        (AccumulatorBlock(BLOCK.accumulators, polytropic(np.array([1.0, 1.2]))), "has several values"),
        (AccumulatorBlock([Accumulator(np.array([1.0, 2.0]) * litre, bar)]), "floating cannot be written into a file"),
        (AccumulatorBlock(BLOCK.accumulators, Steady()), "a file cannot hold the gas law"),
    ],
)
def test_what_a_file_cannot_hold_is_refused(block, words):
    others = dict(fixed=None, calm=None)
    machine = type("Own", (Carried,), {**others, "floating": FloatCircuit("ram", block, charge_pressure=60 * bar)})
    with pytest.raises(DefinitionError, match=words):
        to_toml(machine)


def changed(name, **keys):
    """Return the tables with keys of a member of [hydraulics] changed, or taken out where they are None."""
    tables = to_dict(Carried)
    tables["hydraulics"][name] = {key: each for key, each in (tables["hydraulics"][name] | keys).items() if each is not None}
    return tables


VESSEL = {"volume": "4 l", "charge": "50 bar"}


@for_all(
    ("tables", "words"),
    [
        (changed("ram", bore="5 bar"), r"hydraulics\.ram\.bore: '5 bar' is a pressure where a value of kind length is wanted"),
        (changed("ram", bore=None), r"hydraulics\.ram\.bore: is missing"),
        (changed("ram", bor=1), r"hydraulics\.ram\.bor: is not a key of it"),
        (changed("pulling", rod=0.09), r"hydraulics\.pulling: Rod 90 mm is not smaller than bore 80 mm"),
        (changed("ram", works="all"), r"hydraulics\.ram: Side 'all' is unknown in works\. Known: piston, rod, both"),
        (changed("ram", works=["rod"]), r"hydraulics\.ram\.works: \['rod'\] stands where a word in quotes"),
        (changed("ram", mounting="pin"), r"hydraulics\.ram: Mounting 'pin' is unknown"),
        (changed("ram", count=1.5), r"hydraulics\.ram: Count of cylinders = 1\.5; give a whole number"),
        (changed("ram", stroke="5 bar"), r"hydraulics\.ram\.stroke: '5 bar' is a pressure where a value of kind length is wanted"),
        (changed("ram", Cylinder=["A", "X"]), r"hydraulics\.ram\.Cylinder: Point 'X' is unknown"),
        (changed("pump", LiftCircuit="rum"), r"hydraulics\.pump\.LiftCircuit: Load 'rum' is unknown.* Did you mean ram"),
        (changed("pump", LiftCircuit="load"), r"hydraulics\.pump: Carried\.pump: Weight\(G, mass=600\) is no Cylinder"),
        (changed("pump", pump="supply"), r"hydraulics\.pump\.pump: is not a key of it\. Did you mean pressure\?"),
        (
            to_dict(Carried) | {"hydraulics": {"supply": {"Pump": "ram", "pressure": "200 bar"}}},
            r"hydraulics\.supply\.Pump: 'ram' is not \[\]; it is built from no other member",
        ),
        (changed("pump", flow=-1), r"hydraulics\.pump: .*flow=-1 is negative"),
        (changed("fixed", accumulators=[]), r"hydraulics\.fixed: The accumulator block is empty"),
        (changed("fixed", accumulators=3), r"hydraulics\.fixed\.accumulators: 3 is not a list"),
        (changed("fixed", accumulators=[3]), r"hydraulics\.fixed\.accumulators\.0: is not a table"),
        (changed("fixed", accumulators=[VESSEL] * 101), r"hydraulics\.fixed\.accumulators: .*at most 100 items"),
        (changed("fixed", accumulators=[VESSEL, VESSEL | {"volume": "4 bar"}]), r"accumulators\.1\.volume: '4 bar' is a pressure"),
        (changed("fixed", accumulators=[VESSEL | {"charge": "-2 bar"}]), r"hydraulics\.fixed: Accumulator charge = -200000 Pa gauge"),
        (changed("fixed", accumulators=[{"volume": "W", "charge": 1}]), r"accumulators\.0\.volume: 'W': Quantity 'W' is unknown"),
        (changed("fixed", gas="helium"), r"hydraulics\.fixed\.gas: Gas law 'helium' is unknown\. Known: isothermal, adiabatic, polytropic"),
        (changed("fixed", gas=3), r'hydraulics\.fixed\.gas: 3 is no gas law; write "isothermal" or \{ law = '),
        (changed("fixed", gas={"law": "polytropic"}), r"hydraulics\.fixed\.gas: the exponent n of polytropic is missing"),
        (changed("fixed", gas={"law": "adiabatic", "n": 2}), r"hydraulics\.fixed\.gas: Key of adiabatic 'n' is unknown"),
        (changed("fixed", gas={"law": "real_nitrogen", "temperature": 20}), r"hydraulics\.fixed\.gas: .*give kelvin"),
    ],
)  # fmt: skip
def test_mistake_is_said_in_words(tables, words):
    with pytest.raises(FileError, match=words):
        from_dict(tables)


def test_volume_that_follows_a_stroke_is_refused_where_it_is_used():
    machine = from_dict(changed("fixed", accumulators=[{"volume": "V + S", "charge": "20 bar"}]))
    with pytest.raises(DefinitionError, match=r"Accumulator volume = V \+ S follows a stroke, but is set before it moves"):
        driving_force(machine().sweep(3))


TEXT = to_toml(Carried)


@pytest.fixture
def without_plug_ins(monkeypatch):
    """Let no other package bring kinds."""
    monkeypatch.setattr(plugins, "entry_points", lambda group: {})
    registry.registry.cache_clear()
    yield
    registry.registry.cache_clear()


def test_without_the_plug_in_it_is_said_what_to_install(without_plug_ins):
    with pytest.raises(FileError, match=r"hydraulics: is not a section; .*\[hydraulics\] are not registered here: install hydrolinkage"):
        load(TEXT)
    with pytest.raises(FileError, match=r"loads\.ram: Kind 'Cylinder' is unknown\. Known: Weight, .*install hydrolinkage"):
        load(TEXT.replace("[hydraulics.", "[loads.").replace("[loads]\nload =", "[loads.load]\nlode ="))
    with pytest.raises(DefinitionError, match=r"a file cannot hold a Cylinder\. .*install hydrolinkage"):
        to_toml(Carried)


def test_cylinder_in_the_wrong_section_is_sent_to_its_own():
    tables = to_dict(Carried)
    tables["loads"] |= tables.pop("hydraulics")
    with pytest.raises(FileError, match=r"loads\.ram: Kind 'Cylinder' is unknown\..* Cylinder stands in \[hydraulics\]\."):
        from_dict(tables)
