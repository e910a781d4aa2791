"""What a remedy promises is what the judge gives for the machine that has it, over random machines; buckling against Euler by hand."""

import math
import re
from functools import cache
from random import Random

import numpy as np
import pytest

from hydraulics import (
    Accumulator,
    AccumulatorBlock,
    Cylinder,
    FloatCircuit,
    HoldingValve,
    LiftCircuit,
    OilLine,
    Pump,
    Relief,
    Tank,
    Telescope,
    buckling,
    load_pressure,
    pressure,
    reserve,
    standard_rods,
)  # fmt: skip
from hydraulics.standard_sizes import chosen_series
from linkage import LEFT, Dimension, Dyad, Force, Ground, Guide, LoadCase, Mechanism, OnGuide, OnLink, PinFriction, Stroke, report
from linkage.motion import judge, least, most
from linkage.motion.search import extremum_reached
from linkage.units import bar, deg, inch, kN, litre, mm, psi, unit_system
from tests.for_all import for_all
from tests.members import told_by

SEEDS = (0, 3)
MANY = (1, 2, *range(4, 40))


@cache
def push_of_a_newton():
    """Return the largest thrust of the lever's cylinder for one newton downwards at its end."""
    return float(Bare.ram.thrust(Bare().sweep(41)).min()), float(Bare.ram.thrust(Bare().sweep(41)).max())


class Base(Mechanism):
    """A lever on a cylinder of 620 mm that comes out by 200 mm."""

    S = Stroke(0.0, 0.2)
    O, A = Ground(0.0, 0.0), Ground(0.45, -0.55)
    B = Dyad(A, O, AB=0.62 + S, OB=0.75, side=LEFT)
    G = OnLink(O, B, OG=1.3)


class Bare(Base):
    load = Force("G", (0.0, -1.0))
    ram = Cylinder("A", "B", bore=80 * mm, rod=45 * mm)


def random_lever(seed):
    """Return a lever that is too weak, with what sets its pump and its relief valve; every option of a pump's line is drawn."""
    draw = Random(seed)
    works = ("piston", "rod", "both", "regenerative")[seed % 4]
    size = draw.choice(((50, 32), (63, 36), (80, 45), (90, 56)))
    bore, rod = size[0] * mm, size[1] * mm
    count, back, k_m, k_h = draw.choice((1, 2)), draw.choice((0.0, 6 * bar)), draw.choice((1.0, 0.85)), draw.choice((1.0, 0.95))
    given, relief = draw.uniform(120, 200) * bar, draw.choice((None, draw.uniform(1.0, 1.15)))
    areas = {"piston": bore**2, "rod": bore**2 - rod**2, "both": bore**2, "regenerative": rod**2}
    sign = -1.0 if works == "rod" else 1.0
    asked = given * math.pi / 4 * areas[works] * count / draw.uniform(0.35, 0.9)
    low, high = push_of_a_newton()
    force = sign * asked / (high if abs(high) >= abs(low) else low)
    losses = dict(mechanical_efficiency=k_m, hydraulic_efficiency=k_h)
    members = dict(load=Force("G", (0.0, -force)), heavy=LoadCase("heavy", scale={"load": draw.uniform(1.0, 1.2)}))
    if draw.random() < 0.5:
        members["rub"] = PinFriction("O", radius=30 * mm, coefficient=0.15)
    sizes = dict(bore=bore, rod=rod)
    if draw.random() < 0.3:
        sizes, members = dict(bore="wide", rod=rod), members | dict(wide=Dimension(bore))
    closed = draw.choice((None, 0.62, 0.63))
    lengths = {} if closed is None else dict(closed=closed, stroke=0.18)
    ram = Cylinder("A", "B", **sizes, count=count, **lengths, **({} if works == "regenerative" else dict(works=works)))
    if works == "regenerative" or (works != "both" and draw.random() < 0.5):
        sides = {"piston": ("ram.piston_side",), "rod": ("ram.rod_side",), "regenerative": ("ram.piston_side", "ram.rod_side")}[works]
        members |= dict(supply=Pump(given, **losses), valve=Relief((relief or 2.0) * given))
        members["line"] = OilLine(*sides, "supply", "valve")
        if works != "regenerative":
            members["other"] = OilLine("ram.rod_side" if works == "piston" else "ram.piston_side", Tank(back))
        names = {"pressure": "supply.pressure", "relief": "valve.pressure"}
    else:
        valve = {} if relief is None else dict(relief=relief * given)
        members["line"] = LiftCircuit("ram", pressure=given, back_pressure=back, **losses, **valve)
        names = {"pressure": "line.pressure", "relief": "line.relief"}
    names |= {"bore": "wide" if "wide" in members else "ram.bore", "rod": "ram.rod"}
    return type(f"Lever{seed}", (Base,), dict(ram=ram, **members)), names


def by_rule(machine, *names):
    return {each.rule: each for each in told_by(machine, *names)}


def number(pattern, text, unit=1.0):
    """Return a number that a sentence names [SI]; None where it does not."""
    found = re.search(pattern, " ".join(text.split()))
    return None if found is None else float(found[1]) * unit


def sizes_in(text):
    """Return the sizes that a sentence names as a remedy, by what they are [m]."""
    both = re.search(r"a cylinder of bore (\d+(?:\.\d+)?) mm and rod (\d+(?:\.\d+)?) mm", text)
    if both:
        return {"bore": float(both[1]) * mm, "rod": float(both[2]) * mm}
    found = {kind: number(rf"a {kind} of (\d+(?:\.\d+)?) mm", text, mm) for kind in ("bore", "rod")}
    return {kind: value for kind, value in found.items() if value is not None}


def next_smaller(sizes):
    """Return the same sizes with the decisive one a step smaller in the series."""
    kind = "rod" if "rod" in sizes else "bore"
    series = getattr(chosen_series(), f"{kind}s")
    return sizes | {kind: max(each for each in series if each < sizes[kind] * (1 - 1e-9))}


def broken_promises(seed):
    """Yield what a random lever's verdicts promise and do not keep, and of which rules a promise was looked at."""
    made, names = random_lever(seed)
    machine = made()
    rules = by_rule(machine)
    looked, broken = set(), []

    def having(**values):
        return machine.replaced(**{names[kind]: value for kind, value in values.items()})

    lifting = rules["lifting"]
    if lifting.ok is False:
        needed = number(r"It needs (\d+(?:\.\d+)?) bar", lifting.sentence, bar)
        both = {"pressure": needed} | ({"relief": needed} if "relief valve as well" in lifting.sentence else {})
        stronger = having(**both)
        (gained,) = stronger.answers([least(reserve("ram")) >= 1.0])
        if not (gained.ok and gained.value < 1.002):
            broken.append(f"{seed}: {needed / bar:.6g} bar give a reserve of {gained.value:.6f}")
        sizes, promised = sizes_in(lifting.sentence), number(r"with a reserve of (\d+(?:\.\d+)?)", lifting.sentence)
        if promised is not None:
            larger = having(**sizes)
            (gained,) = larger.answers([least(reserve("ram"))])
            if by_rule(larger, "line")["lifting"].ok is not True or abs(float(gained.value) - promised) > 0.00501:
                broken.append(f"{seed}: {sizes} promise {promised}, and give {gained.value:.5f}")
            if len(sizes) == 1:
                (short,) = having(**next_smaller(sizes)).answers([least(reserve("ram"))])
                if short.value >= 1.0:
                    broken.append(f"{seed}: one smaller than {sizes} would do")
        looked.add("lifting")
    holding = rules["holding"]
    promised = number(r"it is up to (\d+(?:\.\d+)?) bar", holding.sentence, bar)
    if holding.ok is False and promised is not None:
        held = by_rule(having(**sizes_in(holding.sentence)), "line")["holding"]
        found = max(float(each) for each in re.findall(r"holds up to (\d+(?:\.\d+)?) bar", held.sentence)) * bar
        if not (held.ok and abs(found - promised) <= 1e-3 * promised):
            broken.append(f"{seed}: holding promises {promised / bar} bar and gives {held}")
        looked.add("holding")
    rod = number(r"a rod of (\d+(?:\.\d+)?) mm holds", rules["buckling"].sentence, mm)
    if rod is not None:
        if not by_rule(having(rod=rod), "ram")["buckling"].ok:
            broken.append(f"{seed}: a rod of {rod} m buckles")
        looked.add("buckling")
    push = number(r"must push with up to (\d+(?:\.\d+)?) bar", rules["lowering"].sentence, bar) if "lowering" in rules else None
    if push is not None and "other.pressure" not in made.plan.table.spellings and "other" in made.plan.members:
        looked.add("lowering")
    length = rules.get("length")
    if length is not None and length.ok is False and "move its pins" not in length.sentence:
        much = number(r"(\d+(?:\.\d+)?) mm too long", length.sentence, mm) or 0.0
        missing = number(r"(\d+(?:\.\d+)?) mm with a shorter", length.sentence, mm)
        missing = missing or number(r"(\d+(?:\.\d+)?) mm are missing", length.sentence, mm) or 0.0
        fitting = machine.replaced(**{"ram.closed": machine["ram.closed"] - much, "ram.stroke": machine["ram.stroke"] + missing})
        if not by_rule(fitting, "ram")["length"].ok:
            broken.append(f"{seed}: {length} and then {by_rule(fitting)['length']}")
        looked.add("length")
    return broken, looked


def kept(seeds, wanted):
    found = [broken_promises(seed) for seed in seeds]
    assert [each for broken, _ in found for each in broken] == []
    assert set().union(*(looked for _, looked in found)) >= wanted


@pytest.mark.slow
def test_remedies_of_random_levers_keep_their_promise():
    kept(SEEDS, {"lifting", "holding"})


@pytest.mark.slow
def test_remedies_of_many_random_levers_keep_their_promise():
    kept(MANY, {"lifting", "holding", "length"})


class Post(Mechanism):
    """A load straight above a cylinder that pushes it up, so that all is known by hand."""

    S = Stroke(0.0, 1.2)
    O = Ground(0.0, 0.0)
    rail = Guide(O, angle=math.pi / 2)
    P = OnGuide(rail, at=1.6 + S)
    load = Force(P, (0.0, -14.5 * kN))
    ram = Cylinder(O, P, bore=100 * mm, rod=45 * mm, closed=1.6, stroke=1.2)
    pump = LiftCircuit(ram, pressure=180 * bar, mechanical_efficiency=0.6)


def euler(rod, length):
    return math.pi**2 * 210e9 * math.pi * rod**4 / 64 / length**2


def posts():
    """Yield posts, with the push on a rod, its diameter and its length where it buckles first, and the force against a stop, by hand."""
    load, area = 14.5 * kN, math.pi / 4 * 0.1**2
    yield Post, load / 0.6, 0.045, 2.8, 180 * bar * area
    relieved = LiftCircuit("ram", pressure=180 * bar, relief=210 * bar, mechanical_efficiency=0.8)
    yield type("Relieved", (Post,), {"pump": relieved}), load / 0.8, 0.045, 2.8, 210 * bar * area
    pair = Cylinder("O", "P", bore=100 * mm, rod=45 * mm, count=2, works="both")
    yield type("Pair", (Post,), {"ram": pair}), load / 0.6 / 2, 0.045, 2.8, 180 * bar * area
    lines = {"pump": None, "supply": Pump(150 * bar, mechanical_efficiency=0.7), "valve": Relief(160 * bar)}
    lifting = {"ram": Cylinder("O", "P", bore=100 * mm, rod=45 * mm), "back": OilLine("ram.rod_side", Tank(4 * bar))}
    lined = type("Lined", (Post,), lines | lifting | {"line": OilLine("ram.piston_side", "supply", "valve")})
    yield lined, load / 0.7, 0.045, 2.8, 160 * bar * area - 4 * bar * (area - math.pi / 4 * 0.045**2)
    joined = {"ram": Cylinder("O", "P", bore=100 * mm, rod=45 * mm), "line": OilLine("ram.piston_side", "ram.rod_side", "supply", "valve")}
    yield type("Joined", (Post,), lines | joined), load / 0.7, 0.045, 2.8, 160 * bar * math.pi / 4 * 0.045**2
    stages = Telescope("O", "P", bores=[100 * mm, 60 * mm], strokes=[0.7, 0.6], closed=1.55)
    yield type("Staged", (Post,), {"ram": stages}), load / 0.6, 0.06, 2.8, 180 * bar * math.pi / 4 * 0.06**2


def test_a_rod_carries_its_load_over_the_efficiency_and_a_stop_is_told():
    for made, push, rod, length, stop in posts():
        machine = made()
        (found,) = machine.answers([most(buckling("ram"))])
        assert np.isclose(found.value, 3.5 * push / euler(rod, length), rtol=1e-6), made
        verdicts = told_by(machine, "ram")
        (verdict,) = (each for each in verdicts if each.rule == "buckling")
        assert f"safety {euler(rod, length) / push:.3g}," in verdict.sentence and verdict.ok == (euler(rod, length) >= 3.5 * push), made
        (remark,) = (each for each in verdicts if each.startswith("Against a stop"))
        assert remark and remark.ok is None
        count, all_of = made.ram.count, {1: "", 2: "2 × "}[made.ram.count]
        assert f"(thrust 14.5 kN, rods: {count}, efficiency {14.5 * kN / count / push:.3g})" in verdict.sentence, (made, verdict)
        assert f"pushes with {all_of}{stop / kN:.4g} kN" in remark and f"safety {euler(rod, length) / stop:.3g}" in remark, (made, remark)


def test_a_rod_at_rest_or_going_back_carries_its_load_alone():
    motion, alone = Post().at(S=1.2), 3.5 * 14.5 * kN / euler(0.045, 2.8)
    for direction, share in (("frictionless", 1.0), ("retracting", 1.0), ("extending", 0.6), (None, 0.6)):
        assert np.isclose(Post.ram.buckling_use(motion, direction=direction), alone / share, rtol=1e-9)
    fed = type("Unfed", (Post,), {"pump": None})
    assert np.isclose(fed.ram.buckling_use(fed().at(S=1.2)), alone, rtol=1e-9)
    assert not [each for each in told_by(fed(), "ram") if each.startswith("Against a stop")]


def test_a_rod_that_is_named_holds_and_a_thinner_one_does_not(monkeypatch):
    """The thinner one is looked at where the present one is worst, and nowhere else."""
    searched = []
    monkeypatch.setattr(judge, "extremum_reached", lambda motion, *given: searched.append(motion) or extremum_reached(motion, *given))
    for made, *_ in posts():
        made = type("Heavy", (made,), {"load": Force("P", (0.0, -25 * kN))})
        machine = made()
        searched.clear()
        words = next(each.sentence for each in told_by(machine, "ram") if each.rule == "buckling")
        size = number(r"a (?:rod|stage) of (\d+(?:\.\d+)?) mm holds", words, mm)
        if size is None:
            continue
        name = "ram.bore_2" if "ram.bore_2" in made.plan.table.spellings else "ram.rod"
        (holds,) = machine.replaced(**{name: size}).answers([most(buckling("ram")) <= 1.0])
        thinner = max(each for each in chosen_series().rods if each < size * (1 - 1e-9))
        assert thinner not in {motion.designs[name] for motion in searched if motion.reached.size > 1} - {machine[name]}
        (fails,) = machine.replaced(**{name: thinner}).answers([most(buckling("ram")) <= 1.0])
        assert holds.ok and not fails.ok, words


class Hung(Base):
    """A load that pulls, held by the piston side of a cylinder whose rod side is on a tank: it does not go back by itself."""

    load = Force("G", (0.0, -1.0 * kN))
    ram = Cylinder("A", "B", bore=80 * mm, rod=45 * mm)
    supply = Pump(160 * bar, mechanical_efficiency=0.8)
    line, back = OilLine("ram.piston_side", "supply"), OilLine("ram.rod_side", Tank(5 * bar))


def test_the_push_that_lowers_is_what_the_other_side_has_to_have(tmp_path):
    low, high = push_of_a_newton()
    pulls = 8 * kN if abs(high) > abs(low) else -8 * kN
    for tank in (0.0, 5 * bar):
        other = {"drain": Tank(tank), "back": OilLine("ram.rod_side", "drain"), "load": Force("G", (0.0, pulls))}
        made = type("Pulled", (Hung,), other)
        found = by_rule(made(), "line")["lowering"]
        push = number(r"must push with up to (\d+(?:\.\d+)?) bar", found.sentence, bar)
        assert found.ok is False and push > tank
        assert by_rule(made(**{"drain.pressure": push}), "line")["lowering"].ok
        assert not by_rule(made(**{"drain.pressure": 0.995 * push}), "line")["lowering"].ok
    for pump in (160 * bar, 0.5 * push):  # a circuit that works both ways may push, which the rule on lifting judges then
        given = {"load": Force("G", (0.0, pulls)), "line": LiftCircuit("ram", pump), "back": None, "supply": None, "drain": None}
        one_sided = by_rule(type("OneSided", (Hung,), given)(), "line")["lowering"]
        ram = Cylinder("A", "B", bore=80 * mm, rod=45 * mm, works="both")
        both, enough = by_rule(type("BothSides", (Hung,), given | {"ram": ram})(), "line"), pump > push
        assert one_sided.ok is False and ('works="both" lets it push' in one_sided) is enough and both["lowering"].ok
        assert both["lifting"].ok is enough and f"The pump gives {pump / bar:.4g} bar" in one_sided
    told = f"| lowering line | **not kept** | {found.answer.value / bar:.4g} bar |"  # what is measured, to the nearest
    assert told in report(made(), tmp_path / "pulled.md").read_text()


class Chained(Mechanism):
    """Two platforms that are pulled up; the oil of the first one's rod side moves the second."""

    S = Stroke(0.0, 0.40)
    O, Q = Ground(0.0, 0.0), Ground(1.0, 0.0)
    left, right = Guide(O, angle=90 * deg), Guide(Q, angle=90 * deg)
    P = OnGuide(left, at=0.60 + S)
    first, second = Cylinder(O, P, bore=100 * mm, rod=60 * mm), Cylinder(Q, "R", bore=80 * mm, rod=40 * mm)
    R = OnGuide(right, at=second.length)
    line, between = OilLine(first.piston_side, Pump(180 * bar)), OilLine(first.rod_side, second.piston_side, filled=dict(second=0.60))
    here, there = Force(P, (0.0, 10 * kN)), Force(R, (0.0, 6 * kN))


def test_what_lacks_where_no_pump_is_on_the_other_side_is_told_of_the_side_that_works():
    gas = AccumulatorBlock([Accumulator(volume=4 * litre, charge=10 * bar)])
    rod, second = math.pi / 4 * (0.1**2 - 0.06**2), math.pi / 4 * 0.08**2
    pulled = {"load": Force("G", (0.0, 40 * kN))}
    floating = type("Floating", (Hung,), pulled | dict(back=OilLine("ram.rod_side", gas, charge_pressure=20 * bar, at=0.0)))
    for made, lacks in ((Chained, (10 * kN + 6 * kN * rod / second) / (math.pi / 4 * 0.1**2)), (floating, None)):
        told = by_rule(made(), "line")
        assert told["lowering"].ok is False and "no pump is on its other side" in told["lowering"].sentence
        assert lacks is None or number(r"lacks up to (\S+) bar", told["lowering"].sentence, bar) == pytest.approx(lacks, rel=1e-3)
        assert ("shut" in told["holding"].sentence) == (made is floating)  # a closed line is shut already


def test_the_other_side_is_judged_as_the_words_on_a_load_that_drives_say():
    load = {"load": Force("G", (0.0, 8 * kN))}
    for line in (LiftCircuit("ram", pressure=180 * bar), OilLine("ram.piston_side", Pump(180 * bar))):
        driven = type("Driven", (Bare,), load | dict(line=line))
        remedy = by_rule(driven(), "line")["lifting"].sentence.split("cylinder; ")[1]
        both = dict(ram=Cylinder("A", "B", bore=80 * mm, rod=45 * mm, works="both"))
        judged = both if 'works="both"' in remedy else dict(other=OilLine(remedy.split("pump on ")[1].split()[0], Pump(180 * bar)))
        told = told_by(type("Judged", (driven,), judged)(), *judged, "line")
        assert any(each.ok for each in told if each.rule.startswith("lifting"))


def test_a_pressure_that_no_standard_size_holds_is_told_so():
    close = type("Close", (Bare,), dict(line=LiftCircuit("ram", pressure=20 * bar, relief=20 * bar), load=Force("G", (0.0, -2e3 * kN))))
    assert "no standard size is large enough" in by_rule(close(), "line")["holding"].sentence


def test_a_valve_set_as_advised_is_as_usual():
    members = {"load": Force("G", (0.0, (-1.0 if push_of_a_newton()[1] > 1.0 else 1.0) * 60 * kN)), "supply": Pump(250 * bar)}
    made = type("Valved", (Hung,), members | {"valve": HoldingValve("line", pilot="back", setting=130 * bar, ratio=4)})
    (loaded,) = made().answers([most(load_pressure("valve"))])
    words = by_rule(made(), "valve")["setting"].sentence
    advised = number(r"(\d+(?:\.\d+)?) bar(?:, 1.3 times that|\.$)", words, bar)
    assert np.isclose(advised, 1.3 * loaded.value, rtol=5e-4)
    assert "where 1.3 times is usual" not in by_rule(made(**{"valve.setting": advised}), "valve")["setting"].sentence


def inch_post(bore, rod):
    return type("InchPost", (Post,), {"ram": Cylinder("O", "P", bore=bore, rod=rod), "pump": LiftCircuit("ram", pressure=2000 * psi)})


def test_sizes_of_either_standard_are_standard_under_any_units():
    for system in (None, "us", "si", "bar-mm", "kgf"):
        with unit_system(system):
            for bore, rod, series in ((2.5 * inch, inch, "NFPA"), (3.25 * inch, 1.375 * inch, "NFPA"), (8 * inch, 1.375 * inch, "NFPA"),
                                      (80 * mm, 45 * mm, "ISO"), (63 * mm, 36 * mm, "ISO")):
                found = Cylinder("A", "B", bore=bore, rod=rod).standard()
                assert found.ok is True and series in found, (system, found)
            for bore, rod in ((61 * mm, 36 * mm), (2.5 * inch, 36 * mm), (63 * mm, inch), (80 * mm, 8 * mm), (8 * inch, 0.625 * inch)):
                found = Cylinder("A", "B", bore=bore, rod=rod).standard()
                assert found.ok is None and found, (system, found)


def test_remedies_and_offers_are_of_the_units_that_are_chosen():
    inches = {each * 0.0254 for each in (1.5, 2, 2.5, 3.25, 4, 5, 6, 7, 8)}
    for made in (inch_post(2.5 * inch, 1.375 * inch), inch_post(50 * mm, 28 * mm)):
        heavy = type("Heavy", (made,), {"load": Force("P", (0.0, -60 * kN))})
        with unit_system("us"):
            words = by_rule(heavy(), "pump")["lifting"].sentence
            bore = number(r"a bore of (\d+(?:\.\d+)?) in,", words, inch)
            assert min(abs(bore - each) for each in inches) < 1e-6 and "psi" in words, words
            assert heavy(**{"ram.bore": bore}).answers([least(reserve("ram")) >= 1.0])[0].ok
            assert heavy.ram.offers(60 * kN, 2000 * psi)[0].bore in {3.25 * inch, 4 * inch, 5 * inch}
            assert all(each in chosen_series().rods for each in standard_rods(bore))
        bore = number(r"a bore of (\d+(?:\.\d+)?) mm,", by_rule(heavy(), "pump")["lifting"].sentence, mm)
        assert round(bore / mm) in (80, 90, 100)
        assert heavy().answers([most(pressure("ram"))])[0].value > 2000 * psi


def on_gas(spelling, charges, exponent=1.0, size=10.0, at=0.0):
    """Return the verdict on a lever's line of gas, by either spelling, with the charges and the size of each accumulator [l]."""
    block = AccumulatorBlock([Accumulator(volume=size * litre, charge=charge) for charge in charges])
    given = dict(charge_pressure=60 * bar, at=at, exponent=exponent)
    line = FloatCircuit("ram", block, **given) if spelling == "float" else OilLine("ram.piston_side", block, **given)
    (verdict,) = (each.sentence for each in told_by(type("OnGas", (Bare,), {"line": line})(), "line") if each.rule == "line")
    return verdict


@for_all(
    ("charges", "rule", "exponent"),
    [((52 * bar,), "charge", 1.3), ((15 * bar, 30 * bar), "compression", 1.0)],
    slow=[((20 * bar, 56 * bar), "charge", 1.0), ((52 * bar,), "charge", 1.0), ((14 * bar,), "compression", 1.0)],
)
def test_a_charge_that_is_named_keeps_its_rule_on_the_line_that_has_it(charges, rule, exponent):
    promised = 0
    size, at = (10.0, 0.0) if rule == "charge" else (2.0, 0.05)
    told = {spelling: on_gas(spelling, charges, exponent, size, at) for spelling in ("float", "line")}
    assert told["float"] == told["line"]
    for place in range(len(charges)):
        said = re.search(rf"{rule} of accumulator {place + 1}: [^;]*(?:; it is idle[^;]*)?; \w+ the charge to (\S+) bar", told["line"])
        if said is None:
            continue
        promised += 1
        for share, keeps in ((1.0, True), (1.005 if rule == "charge" else 0.995, False)):
            changed = [share * float(said[1]) * bar if k == place else each for k, each in enumerate(charges)]
            now = on_gas("line" if place else "float", changed, exponent, size, at)
            assert (f"{rule} of accumulator {place + 1}:" not in now) == keeps, (share, told["line"], now)
    assert promised


@for_all("seed", [3], slow=range(20))
def test_who_follows_the_words_on_an_accumulator_comes_to_one_that_keeps_all_rules(seed):
    draw = Random(seed)
    size, charge, at = draw.uniform(1.2, 2.0), draw.uniform(5, 15) * bar, draw.uniform(0.0, 0.1)
    told = []
    for _ in range(6):
        told.append(on_gas("line", [charge], size=size, at=at))
        named = number(r"the charge to (\S+) bar", told[-1], bar)
        if "accumulator" not in told[-1]:
            assert len(told) > 1
            return
        size, charge = (1.5 * size, charge) if named is None else (size, named)
    raise AssertionError(told)


def pairs_on_one_line():
    """Yield weak levers on two cylinders of one line, with what sets its pump and its relief valve."""
    low, high = push_of_a_newton()
    force = 260 * bar * math.pi / 4 * (0.05**2 + 0.063**2) / max(abs(low), abs(high)) * (-1.0 if abs(high) >= abs(low) else 1.0)
    rams = dict(ram=Cylinder("A", "B", bore=63 * mm, rod=36 * mm), aux=Cylinder("A", "B", bore=50 * mm, rod=28 * mm))
    members = rams | dict(load=Force("G", (0.0, force)), heavy=LoadCase("heavy", scale={"load": 1.15}))
    losses = dict(mechanical_efficiency=0.9, hydraulic_efficiency=0.95)
    circuit = LiftCircuit(["ram", "aux"], pressure=180 * bar, relief=190 * bar, back_pressure=5 * bar, **losses)
    yield type("Pair", (Base,), members | dict(line=circuit)), ("line.pressure", "line.relief")
    lines = dict(supply=Pump(180 * bar, **losses), valve=Relief(190 * bar), back=OilLine("ram.rod_side", "aux.rod_side", Tank(5 * bar)))
    line = OilLine("ram.piston_side", "aux.piston_side", "supply", "valve")
    yield type("PairOfLines", (Base,), members | lines | dict(line=line)), ("supply.pressure", "valve.pressure")


@for_all(("made", "names"), lambda: [*pairs_on_one_line()][:1], slow=lambda: [*pairs_on_one_line()][1:])
def test_what_two_cylinders_on_one_line_need_is_enough_for_both_and_no_more(made, names):
    lifting = [each for each in told_by(made(), "line") if each.rule.startswith("lifting ")]
    needed = [number(r"It needs (\d+(?:\.\d+)?) bar, at its relief valve as well", each.sentence, bar) for each in lifting]
    assert len(lifting) == 2 and all(each.ok is False and "larger bores on this line" in each.sentence for each in lifting)
    machine = made(**dict.fromkeys(names, max(needed)))
    assert all(each.ok for each in told_by(machine, "line") if each.rule.startswith("lifting "))
    for name in ("ram", "aux"):
        (gained,) = machine.answers([least(reserve(name))])
        assert 1.0 <= gained.value < 1.002, (name, gained)
