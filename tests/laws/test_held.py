"""What is held: every shipped machine is; one that is loosened says so first, and every door of forces is closed by the same sentence."""

import warnings
from contextlib import suppress
from functools import partial
from math import pi

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, OilLine, Tank, capacity, pressure, reserve, thrust
from linkage import (
    LEFT,
    RIGHT,
    AssemblyError,
    CosineAngle,
    Crank,
    DefinitionError,
    Dimension,
    Dyad,
    Force,
    Ground,
    Guide,
    Link,
    LoadCase,
    Mechanism,
    Offset,
    OnGuide,
    OnLink,
    Over,
    Part,
    Rope,
    SingularError,
    SingularWarning,
    Stroke,
    Support,
    Turn,
    Vector,
    Weight,
    angle,
    around,
    distance,
    draw,
    drive_force,
    driving_force,
    least,
    max_table,
    most,
    optimise,
    page,
    pin_force,
    pin_forces,
    reaction,
    ref,
    report,
    working_field,
)
from linkage.pictures.page_data import PageRequests
from linkage.pictures.page_forces import geared_remark
from linkage.reports import results
from linkage.statics import drive_remarks, held_verdict, looseness
from linkage.study import zone
from linkage.units import bar, deg, litre, mm
from linkage.verdict import Remark
from tests.for_all import first_daily, for_all
from tests.laws.test_oil_twins import Double
from tests.laws.test_statics_laws import daily, shipped
from tests.linkage.random_mechanisms import random_mechanism
from tests.shipped import AT_WORK


@pytest.fixture(autouse=True)
def _near_dead_points():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SingularWarning)
        yield


@for_all("machine", daily, slow=lambda: [*shipped(), *AT_WORK.values()])
def test_shipped_machines_are_held(machine):
    assert not looseness(machine.plan).sentence


def refusals(machine, point, ram=""):
    """Return what every door of forces says, by its name: the words of its refusal, "" where it answers."""
    drive, motion = next(iter(machine.strokes)), machine.at(**{name: 0.5 * (s.start + s.end) for name, s in machine.strokes.items()})
    fixed = next(iter(machine.plan.ground))
    asked = [drive_force(drive), pin_force(point), *([thrust(ram), pressure(ram), reserve(ram), capacity(ram, point)] if ram else [])]
    doors = {
        "driving_force": lambda: driving_force(motion, drive=drive),
        "of given loads": lambda: driving_force(motion, [Force(point, (0.0, 1.0))], drive=drive),
        "pin_forces": lambda: pin_forces(motion),
        "least squares": lambda: pin_forces(motion, split="least squares"),
        "reaction": lambda: reaction(motion, support=Support(point, (0.0, 1.0)), drive=drive),
        "max_table": lambda: max_table(machine),
        "source": lambda: machine.source([drive_force(drive)]),
        "zone": lambda: zone(machine, drive_force(drive), {f"{fixed}.x": (0.0, 0.1)}, **motion.strokes),
        "optimise": lambda: optimise(machine, minimise=most(abs(drive_force(drive))), vary={fixed: around(1 * mm)}, starts=1),
    }
    for each in asked:
        doors |= {
            f"evaluate {each}": lambda each=each: machine.evaluate([each], unreachable="nan", **motion.strokes),
            f"function {each}": lambda each=each: machine.function([each]),
            f"motion {each}": lambda each=each: motion[each],
            f"gradient {each}": lambda each=each: motion.gradient(each, [f"{fixed}.x"]),
            f"answers {each}": lambda each=each: machine.answers([most(each), least(each)]),
        }
    if ram:
        member = machine.plan.members[ram]
        doors |= {"thrust": lambda: member.thrust(motion), "pressure": lambda: member.pressure(motion)}
    found = {}
    for name, door in doors.items():
        try:
            door()
            found[name] = ""
        except DefinitionError as error:
            found[name] = str(error)
    return found


def check_not_held(machine, point, ram=""):
    """Assert that the first verdict fails, every force is refused by the same sentence, and places stay."""
    first, *others = machine.verdicts()
    assert (first.rule, first.ok) == ("held", False), first
    assert not [each for each in others if first.sentence in str(each)]
    said = refusals(machine, point, ram)
    assert {name: words for name, words in said.items() if words != f"{type(machine).__name__}: {first.sentence}"} == {}
    motion = machine.sweep(**dict.fromkeys(machine.strokes, 3))
    assert np.isfinite(motion[point]).all()
    assert {column.name for column in results(machine, motion)} >= {f"{point}_x", f"{point}_y"}
    return first.sentence


def loosened(seed):
    """Return a random machine with something that nothing holds, the point of a weight on it, and a cylinder there, if there is one."""
    base = random_mechanism(seed, strokes=1 + seed % 2, joints=3)
    rng, way, last = np.random.default_rng(seed), seed % 5, base.plan.moving[-1]
    members, ram, S = {}, "", 1.0 * ref("S")  # an angle in some, on a radius of 1 m
    span = float(np.hypot(*np.subtract(base()["A"], base()["O"])).item())
    if way == 0:  # a turned vector whose length is kept, about another point
        members["Z9"] = Offset("P", Turn(Vector("A", last), rng.uniform(-1.0, 1.0), length=0.4))
    elif way == 1:  # a body that would move without turning
        members["Z9"] = Offset(last, Vector("A", "O"))
    elif way == 2:  # the sides of a corner exchanged
        sides = 0.8 * span, 0.6 * span + S
        members["V9"] = Vector("A", "O")
        members["Z9"] = Offset("A", Turn("V9", -CosineAngle(distance("A", "O"), *sides), length=sides[1]))
        ram = "ram"
        members[ram] = Cylinder("A", "Z9", bore=63 * mm, rod=36 * mm)
        members["pump"] = LiftCircuit(ram, pressure=200 * bar)
    elif way == 3:  # one pressure for two levers that nothing couples
        for k, side in enumerate((LEFT, RIGHT)):
            members |= {f"G{k}": Ground(5.0 + 3 * k, 0.0), f"H{k}": Ground(5.5 + 3 * k, -0.5)}
            members[f"K{k}"] = Dyad(f"H{k}", f"G{k}", **{f"H{k}K{k}": 0.6 + S, f"G{k}K{k}": 0.6}, side=RIGHT)
            members[f"Z{9 - k}"] = OnLink(f"G{k}", f"K{k}", **{f"G{k}Z{9 - k}": 1.2}, **{f"K{k}G{k}Z{9 - k}": 0.1}, side=side)
            members[f"ram{k}"] = Cylinder(f"H{k}", f"K{k}", bore=60 * mm, rod=35 * mm)
        members["other"] = Weight("Z8", mass=300.0)
        members["pump"], ram = LiftCircuit(["ram0", "ram1"], pressure=200 * bar), "ram1"
    else:  # a point pushed along a body by a stroke that a cylinder elsewhere takes over
        members |= {"G0": Ground(5.0, 0.0), "H0": Ground(5.5, -0.5)}
        members["K0"] = Dyad("H0", "G0", H0K0=0.6 + S, G0K0=0.6, side=RIGHT)
        members["Z9"] = OnLink("G0", "H0", G0Z9=0.3 + S)
        members["ram"], ram = Cylinder("H0", "K0", bore=60 * mm, rod=35 * mm), "ram"
        members["pump"] = LiftCircuit(ram, pressure=200 * bar)
    members["load"] = Weight("Z9", mass=float(rng.uniform(50.0, 500.0)))
    return type(f"Loose{seed}", (base,), members), "Z9", ram


@for_all("seed", range(2), slow=range(2, 60))
def test_loosened_machines_have_no_forces_at_any_door(seed):
    machine, point, ram = loosened(seed)
    assert not looseness(machine.__base__.plan).sentence, "the generator's own machine is held"
    words = check_not_held(machine(), point, ram)
    assert "with its drives locked it can still move in" in words and "held by nothing" in words
    assert machine().freedom.loose and f"{', '.join(machine().freedom.loose)}" in str(machine().freedom)


class Exchanged(Mechanism):
    """A lever on a cylinder in vectors; the corner's last two sides are exchanged, so that the rod grows."""

    S = Stroke(0.0, 0.25)
    A, O = Ground(0.2, 0.55), Ground(0.3, 1.15)
    AO = Vector(A, O)
    OAB = CosineAngle(abs(AO), 0.30, 0.5 + S)
    B = Offset(A, Turn(AO, -OAB, length=0.5 + S))
    C = Offset(O, Turn(Vector(O, B), 25 * deg, length=0.36))
    w = Weight(C, mass=500.0)
    ram = Cylinder(A, B, bore=63 * mm, rod=36 * mm)
    line = LiftCircuit(ram, pressure=160 * bar)


class AsMeant(Exchanged):
    OAB = CosineAngle(abs(Exchanged.AO), 0.5 + Exchanged.S, 0.30)


def test_sides_of_a_corner_exchanged_are_told_with_the_lines_to_look_at(tmp_path):
    words = check_not_held(Exchanged(), "C", "ram")
    assert words.startswith("with its drives locked it can still move in 2 ways: OC and ram are held by nothing. Look at C = Offset(O,")
    assert Exchanged().freedom.loose == ("OC", "ram")
    assert held_verdict(AsMeant().judge()) is None and AsMeant().freedom.loose == ()
    assert "can still move in 2 ways" in report(Exchanged(), tmp_path / "report.md").read_text()
    shown = PageRequests(Exchanged(), 5)  # a page shows it without its forces
    assert {"point B", "column OAB 0"} <= shown.by_name.keys() and page(Exchanged(), tmp_path / "page.html").exists()


def test_a_picture_shows_the_loose_movement():
    """By hand: C turns about O and B about A, each alone; of a machine that is held the picture says so."""
    motion = Exchanged().at(S=0.1)
    figure = draw(motion, freedom=True)
    shown = {str(each.get_gid()) for each in figure.findobj()}
    assert [any(f"loose {way} {point}" in gid for gid in shown for way in (1, 2)) for point in "BCOA"] == [True, True, False, False]
    held = draw(AsMeant().at(S=0.1), freedom=True)
    assert any("Nothing is loose" in each.get_text() for each in held.findobj(lambda each: hasattr(each, "get_text")))


def geared(u):
    """A rocker geared to two arms and a rack by random numbers, and a third arm to the crank, all moved by one cylinder."""

    class Geared(Mechanism):
        """Arms on gears."""

        phi, gear = Stroke(20 * deg, 60 * deg), Dimension(u(0.4, 2.0) * np.sign(u(-1, 1)))
        O, M, G, N, R = Ground(0, 0), Ground(0.5, u(-0.1, 0.1)), Ground(-0.3, -0.3), Ground(u(0, 1), u(0.5, 1)), Ground(-0.5, 0.6)
        A = Crank(O, OA=0.2, angle=phi)
        B = Dyad(A, M, AB=0.4, MB=0.3, side=LEFT)
        C = Crank(N, NC=u(0.2, 0.5), angle=u(-3, 3) + gear * angle(M, B))
        D = Crank(C, CD=u(0.2, 0.5), angle=u(0.4, 2) * angle(N, C) - u(-1, 1) * (u(0, 1) - angle(A, B)))
        E = Crank(R, RE=u(0.2, 0.5), angle=u(-3, 3) - phi / 2)
        Q = OnLink(N, C, NQ=u(0.3, 0.6), CNQ=u(0.2, 2))
        rail = Guide(Q, C) if u(-1, 1) > 0.0 else Guide((u(-1, 1), u(-1, 1)), angle=u(-3, 3))
        P = OnGuide(rail, at=u(0.3, 0.6) * (u(1, 2) - angle(M, B)) + 0.5)
        ram = Cylinder(G, A, bore=63 * mm, rod=36 * mm)
        on_B, on_C, on_D, on_E, on_P = (Weight(each, mass=u(5, 50)) for each in (B, C, D, E, P))

    return Geared


def racked(u):
    """A lever on a driven length, whose rack and a second length follow that and its angle by random numbers; one cylinder moves all."""

    class Racked(Mechanism):
        """A lever and a rack."""

        S, O, K, J = Stroke(0.0, 0.35), Ground(0, 1), Ground(0.6, 0.3), Ground(u(-0.3, 0.0), u(-0.2, 0.2))
        A = Dyad(K, O, KA=0.7 + u(0.5, 1.1) * S, OA=0.8, side=RIGHT)
        T, rail = OnLink(O, A, OT=u(0.3, 0.6)), Guide((u(1, 2), u(-1, 2)), angle=u(0.3, 2.8))
        P = OnGuide(rail, at=u(0.3, 2) * S - u(-0.5, 0.5) * (angle(O, A) - u(0, 1) * S) + u(0, 1) * distance(A, K))
        M = Ground(2, u(0.8, 1.2))
        B = Dyad(K, M, KB=0.3 + u(0.7, 0.9) * distance(K, A), MB=u(1.2, 1.3), side=LEFT) if u(-1, 1) > 0.0 else Ground(1, 0)
        ram = Cylinder(K, A, bore=63 * mm, rod=36 * mm) if u(-1, 1) > 0.0 else Cylinder(J, T, bore=63 * mm, rod=36 * mm)
        on_A, on_P, on_B = (Weight(each, mass=u(5, 50)) for each in (A, P, B))

    return Racked


@for_all("seed", range(3), slow=range(3, 100))
def test_gears_carry_what_turns_with_a_cylinder_and_do_no_work(seed):
    machine, rack = geared(np.random.default_rng(seed).uniform), racked(np.random.default_rng(seed).uniform)

    class Carried(Mechanism):
        """It on a body that turns, seen from behind."""

        psi, Z = Stroke(0.0, 30 * deg), Ground(1.0, 1.0)
        Y = Crank(Z, ZY=1.0, angle=psi)
        part = Part(machine, on=(Z, Y), mirrored=True)

    phi, psi, S = np.array([0.4, 0.6, 0.9]), np.array([0.0, 0.3, 0.5]), np.array([0.05, 0.15, 0.3])
    carried = Carried(), {"psi": psi, "part.phi": phi}, "part.ram"
    for whole, strokes, ram in ((machine(), {"phi": phi}, "ram"), carried, (rack(), {"S": S}, "ram")):
        found = pin_forces(whole.at(**strokes))
        assert found.residual < 1e-12 and found.gap < 1e-12
        last, moved, energy = [*strokes][-1], 1e-5, []
        for step in (-moved, moved):
            motion, ends = whole.at(**{**strokes, last: strokes[last] + step}), whole.plan.of_kind(Cylinder)[ram].ends
            heights = ((each.mass, motion[each.point][1]) for each in whole.plan.of_kind(Weight).values())
            energy.append((9.80665 * sum(mass * y for mass, y in heights), np.hypot(*(motion[ends[1]] - motion[ends[0]]))))
        by_hand = (energy[1][0] - energy[0][0]) / (energy[1][1] - energy[0][1])
        assert_allclose(whole.evaluate([thrust(ram)], **strokes)[0], by_hand, rtol=1e-6)


def test_two_claws_on_gears_close_by_one_cylinder_between_them(tmp_path):
    class Claws(Mechanism):
        """Two claws."""

        phi = Stroke(20 * deg, 60 * deg)
        O, M = Ground(-0.2, 0.0), Ground(0.2, 0.0)
        A, B = Crank(O, OA=0.5, angle=270 * deg - phi), Crank(M, MB=0.5, angle=270 * deg + phi)
        K, L = OnLink(O, A, OK=0.25, AOK=60 * deg), OnLink(M, B, ML=0.25, BML=-60 * deg)
        ram = Cylinder(K, L, bore=63 * mm, rod=36 * mm)
        left = Weight(A, mass=100)

    found = pin_forces(Claws().at(phi=40 * deg))
    couples = [float(each.couple) for each in found.joints if each.kind == "crank"]
    assert found.remarks == ("O, M: moved by gears, the forces between whose teeth are left out of the pin forces.",)
    assert geared_remark(Claws.plan)[0] == found.remarks[0]  # a page says so, too
    assert_allclose(couples, [-0.5 * 0.5 * np.sin(40 * deg) * 100 * 9.80665] * 2, rtol=1e-12)  # half goes to the other claw
    for rows in (max_table(Claws()), max_table(pin_forces(Claws().sweep(5)))):  # the largest couple of each stands in the table
        assert_allclose([row.force for row in rows if not row.has_force], [0.25 * np.sin(60 * deg) * 100 * 9.80665] * 2, rtol=1e-9)
    assert "| 0.21232 kNm |" in report(Claws(), tmp_path / "claws.md").read_text()
    parallel = type("Parallel", (Mechanism,), {
        "phi": Stroke(20 * deg, 60 * deg), "O": Ground(0, 0), "M": Ground(0.4, 0), "G": Ground(0.1, -0.3),
        "A": Crank("O", OA=0.3, angle="phi"), "B": Crank("M", MB=0.3, angle="phi"), "rod": Link("A B"),
        "ram": Cylinder("G", "A", bore=50 * mm, rod=25 * mm), "load": Weight("B", mass=20),
    })  # fmt: skip
    assert not any(each.kind in ("crank", "gear") for each in pin_forces(parallel().sweep(3)).joints)  # its rod carries


def test_parts_that_are_loose_are_named_with_their_part():
    whole = type("Whole", (Mechanism,), {"left": Part(AsMeant), "right": Part(Exchanged, at=(3.0, 0.0), mirrored=True)})
    words = check_not_held(whole(), "right.C", "right.ram")
    assert "right.OC and right.ram are held by nothing" in words


def test_a_point_on_a_side_that_changes_is_not_held():
    class Triangle(Exchanged):
        OAB, B = None, Dyad("A", "O", AB=0.5 + Exchanged.S, OB=0.30, side=RIGHT)
        X = OnLink("A", "B", AX=0.4, BX=0.5, side=LEFT)
        tip = Weight("X", mass=100.0)

    words = check_not_held(Triangle(), "X", "ram")
    assert "measured along ram, whose length AB changes" in words


def test_without_cylinders_the_drives_hold():
    class Bare(Mechanism):
        S = Stroke(0.0, 0.25)
        A, O = Ground(0.2, 0.55), Ground(0.3, 1.15)
        B = Dyad(A, O, AB=0.5 + S, OB=0.30, side=RIGHT)
        w = Weight(B, mass=100.0)

    assert Bare().freedom.loose == () and not [each for each in Bare().verdicts() if each.rule in ("held", "remark")]


def test_a_redundant_link_does_not_refuse_a_thrust_that_is_determined():
    class Doubled(Mechanism):
        phi = Stroke(0.2, 1.2)
        O, C, E = Ground(0.0, 0.0), Ground(1.0, 0.0), Ground(0.5, 0.0)
        A = Offset(O, Turn(Vector(O, C), phi, length=0.3))
        B = Dyad(A, C, AB=1.0, CB=0.3, side=LEFT)
        M = OnLink(A, B, AM=0.5)
        third = Link("E", "M")
        load = Weight(B, mass=10.0)

    assert held_verdict(Doubled().judge()) is None
    assert np.allclose(driving_force(Doubled().at(phi=0.5)), 10 * 9.80665 * 0.3 * np.cos(0.5))


@pytest.mark.slow
def test_a_double_line_that_locks_by_the_numbers_of_a_design_is_told():
    """The class has one ratio; a bore of a hair more has another. Of a batch one design is enough."""
    assert held_verdict(Double().judge()) is None
    design = Double(**{"slave.bore": 1.002 * Double()["slave.bore"]})
    motion = design.at(S=1.5)
    first = design.verdicts()[0]
    assert (first.rule, first.ok) == ("held", False) and "other locks the machine" in first and "master to slave is" in first
    assert np.isfinite(motion["W"]).all()
    doors = [partial(door, motion) for door in (driving_force, pin_forces, Double.lift.thrust, Double.level.pressure)]
    for each in (drive_force(), thrust("lift"), pin_force("B", "lift")):
        doors += [lambda each=each: design.evaluate([each], S=1.5), lambda each=each: design.function([each])(1.5)]
        doors += [lambda each=each: motion[each], lambda each=each: design.answers([most(each)])]
    for door in doors:
        with pytest.raises(DefinitionError) as told:
            door()
        assert str(told.value) == f"Double: {first.sentence}"
    batch = Double(**{"slave.bore": Double()["slave.bore"] * np.array([1.0, 1.01])})
    assert (batch.verdicts()[0].rule, batch.verdicts()[0].ok) == ("held", False)
    with pytest.raises(DefinitionError, match="other locks the machine"):
        driving_force(batch.at(S=1.5))


def test_strokes_that_no_cylinder_holds_are_named_with_the_force_of_their_drive():
    class Crane(Mechanism):
        S, phi = Stroke(0.0, 0.25), Stroke(0.0, 0.5 * pi)
        A, O = Ground(0.2, 0.55), Ground(0.3, 1.15)
        B = Dyad(A, O, AB=0.5 + S, OB=0.30, side=RIGHT)
        T = OnLink(O, B, OT=1.0, BOT=phi)
        w = Weight(T, mass=100.0)
        ram = Cylinder(A, B, bore=63 * mm, rod=36 * mm)
        line = LiftCircuit(ram, pressure=200 * bar)

    (remark,) = [each for each in Crane().verdicts() if isinstance(each, Remark) and "no cylinder" in each]
    assert remark.startswith("phi is held by no cylinder: its drive gives up to 980.7 Nm, at")
    assert bool(remark) and remark.ok is None


@first_daily(2, "seed", range(8))
def test_the_drive_of_a_stroke_carries_the_cylinder_that_pushes_on_it(seed):
    """A ram from the frame to the tip of an arm that a drive stretches: by hand the drive gives Q_t - T dl/dt."""
    foot = np.random.default_rng(seed).uniform([0.2, -1.2], [0.5, -0.8])

    class Arm(Mechanism):
        phi, t = Stroke(-0.7, 1.2), Stroke(0.0, 1.0)
        O, K = Ground(0.0, 0.0), Ground(*foot)
        P = Crank(O, OP=0.5, angle=phi)
        T = OnLink(O, P, OT=1.0 + t)
        load = Weight(T, mass=50.0)
        ram = Cylinder(K, T, bore=63 * mm, rod=36 * mm, works="both")
        pump = LiftCircuit(ram, pressure=250 * bar)

    phi, t = np.meshgrid(np.linspace(-0.7, 1.2, 401), np.linspace(0.0, 1.0, 101))
    x, y = (1.0 + t) * np.cos(phi), (1.0 + t) * np.sin(phi)
    length, g = np.hypot(x - foot[0], y - foot[1]), 50.0 * 9.80665
    push = g * x * length / ((y - foot[1]) * x - (x - foot[0]) * y)
    needed = g * np.sin(phi) - push * ((x - foot[0]) * np.cos(phi) + (y - foot[1]) * np.sin(phi)) / length
    (remark,) = unheld(Arm)
    found = float(remark.partition("up to ")[2].partition(" kN")[0])
    assert found == pytest.approx(np.abs(needed).max() / 1e3, rel=2e-3)


class Legs(Mechanism):
    """A frame on two legs that share one closed line: it keeps its height in the middle and rolls freely."""

    S = Stroke(0.5, 0.7)
    L, R = Ground(-1.0, 0.0), Ground(1.0, 0.0)
    on_left, on_right = Guide(L, angle=90 * deg), Guide(R, angle=90 * deg)
    left, right = Cylinder(L, "A", bore=80 * mm, rod=56 * mm), Cylinder(R, "B", bore=80 * mm, rod=56 * mm)
    A, B = OnGuide(on_left, at=S), OnGuide(on_right, at=right.length)
    line = OilLine(left, right, filled=dict(left=0.6, right=0.6))
    on_the_left, on_the_right = Force(A, (0.0, -1000.0)), Force(B, (0.0, -4000.0))


class Apart(Legs):
    """Each leg on a line of its own: the left one is fed by a tank, which a valve can shut."""

    lift, drain, pump = Stroke(0.5, 0.7), Tank(5 * bar), LiftCircuit(Legs.right, pressure=200 * bar)
    B, line = OnGuide(Legs.on_right, at=lift), OilLine(Legs.left, "drain")


def unheld(machine):
    return [str(each) for each in drive_remarks(machine().judge())]


def test_a_frame_whose_legs_share_a_closed_line_rolls_freely():
    """By hand: one pressure pushes both legs alike, so that the drive of S carries the difference of the loads, 3 kN."""
    lift = Stroke(0.0, 0.4 * litre)
    for oil in (None, "lift", lift, 2.0 * lift):
        line = OilLine(Legs.left, Legs.right, filled=dict(left=0.6, right=0.6), oil=0.0 if oil is None else oil)
        machine = type("Fed", (Legs,), {"line": line} if oil is None else {"lift": lift, "line": line})
        (remark,) = unheld(machine)
        assert remark.startswith("S is held by no cylinder: its drive gives up to 3 kN, at S = 5"), oil
        poses = machine().at(S=[0.55, 0.62], **({} if oil is None else {"lift": 1e-4}))
        assert_allclose(driving_force(poses, drive="S"), -3000.0, rtol=1e-12)
        assert_allclose(machine.line.pressure(poses), 4000.0 / (pi / 4.0 * 0.08**2), rtol=1e-12)


def test_a_valve_that_is_shut_holds_a_leg_that_a_tank_feeds():
    """By hand: the tank pushes with 5 bar on 80 mm, 2.513 kN, against 1 kN."""
    given = "S is held by no cylinder: its drive gives up to 1.513 kN"
    assert unheld(Apart) == [f"{given}, at rest, at S = 500.0 mm, lift = 500.0 mm."]
    parked = LoadCase("parked", scale={"on_the_left": 9.0}, shut=["line"])
    shut = type("Apart", (Apart,), {"parked": parked})
    assert unheld(shut) == [f"{given}, under its own loads, at rest, at S = 500.0 mm, lift = 500.0 mm."]
    assert unheld(type("Apart", (shut,), {"always": Over(cases=["parked"])})) == []
    assert unheld(type("Apart", (Apart,), {"heavy": LoadCase("heavy", scale={"on_the_left": 9.0})}))[0].startswith(
        "S is held by no cylinder: its drive gives up to 6.487 kN, at rest, in the case heavy, at S"
    )


def test_a_field_of_a_loose_machine_is_refused():
    class Reaching(Exchanged):
        T = OnLink("O", "C", OT=0.8 + ref("t"))
        t = Stroke(0.0, 0.3)

    with pytest.raises(DefinitionError, match="with its drives locked it can still move"):
        working_field(Reaching(), "T", x=(0.0, 1.5), y=(0.0, 1.5))


def test_machines_without_a_stroke_have_forces_or_say_why():
    class Truss(Mechanism):
        A, B = Ground(0.0, 0.0), Ground(1.0, 0.0)
        C = Dyad(A, B, AC=0.8, BC=0.7, side=LEFT)
        w = Weight(C, mass=100.0)

    class Stand(Mechanism):
        A, B = Ground(0.0, 0.0), Ground(1.0, 0.0)
        w = Weight(A, mass=100.0)
        front, rear = Support(A, (0.0, 1.0)), Support(B, (0.0, 1.0))

    for machine in (Truss(), Truss(**{"w.mass": np.array([100.0, 200.0])}), Stand()):
        for unreachable in ("raise", "nan"):
            motion = machine.at(unreachable=unreachable)
            assert pin_forces(motion).residual < 1e-12
        assert machine.verdicts() is not None and machine.freedom.loose == ()
    forces = pin_forces(Truss().at(unreachable="nan"))
    assert np.allclose(sum(forces.on_body("frame").values()), [0.0, -100 * 9.80665])


def test_a_machine_that_is_assembled_nowhere_says_so_and_not_that_its_cylinder_holds_nothing():
    class Short(Mechanism):
        S = Stroke(0.0, 0.2)
        A, O = Ground(0.0, 0.0), Ground(0.5, 0.0)
        B = Dyad(A, O, AB=1.5 + S, OB=0.3, side=RIGHT)
        load = Weight(B, mass=100)
        ram = Cylinder(A, B, bore=50 * mm, rod=28 * mm)

    short = Short()
    motion = short.sweep(3, unreachable="nan")
    for door in (short.verdicts, lambda: motion[thrust("ram")], lambda: short.answers([most(thrust("ram"))]), lambda: pin_forces(motion)):
        with pytest.raises(AssemblyError, match=r"AB = .* m\. Shorten the stroke or lengthen OB"):
            door()


def test_a_length_that_is_a_stroke_itself_has_its_share_back_as_sums_have():
    class Pair(Mechanism):
        S, T = Stroke(0.7, 0.9), Stroke(0.0, 0.2)
        A, O, C, N = Ground(0.5, -0.5), Ground(0.0, 0.0), Ground(1.6, -0.4), Ground(1.2, 0.2)
        B = Dyad(A, O, AB=S, OB=0.8, side=RIGHT)
        E = Dyad(C, N, CE=S + T - 0.2, NE=0.6, side=RIGHT)
        w, v = Weight(B, mass=50.0), Weight(E, mass=70.0)
        ram = Cylinder(A, B, bore=50 * mm, rod=30 * mm)

    summed = type("Summed", (Pair,), {"S": Stroke(0.0, 0.2), "B": None, "E": None, "w": None, "v": None, "ram": None} | {
        "B": Dyad("A", "O", AB=0.7 + ref("S"), OB=0.8, side=RIGHT), "E": Dyad("C", "N", CE=0.5 + ref("S") + ref("T"), NE=0.6, side=RIGHT),
        "w": Weight("B", mass=50.0), "v": Weight("E", mass=70.0), "ram": Cylinder("A", "B", bore=50 * mm, rod=30 * mm),
    })  # fmt: skip
    for machine, S in ((Pair(), 0.8), (summed(), 0.1)):
        motion = machine.at(S=S, T=0.1)
        forces = pin_forces(motion)
        assert_allclose([motion[thrust("ram")], forces.thrusts["ram"]], 1326.5953, rtol=1e-6)


def arm_of(count, seed):
    """Return an arm of `count` links, each turned against the one before, with a ram from the frame to each."""
    random, members, turned = np.random.default_rng(seed), {"P0": Ground(0.0, 0.0)}, 0.0
    for k in range(1, count + 1):
        members[f"s{k}"] = Stroke(0.0, 0.2)
        turned = turned + ref(f"s{k}")
        length = {f"P{k - 1}P{k}": random.uniform(0.6, 1.2)}
        members[f"P{k}"] = Crank(f"P{k - 1}", angle=turned + random.uniform(-0.4, 0.6), **length)
        members[f"F{k}"] = Ground(*random.uniform(-1.5, 0.0, 2))
        members[f"ram{k}"] = Cylinder(f"F{k}", f"P{k}", bore=80 * mm, rod=50 * mm)
        members[f"w{k}"] = Weight(f"P{k}", mass=random.uniform(50.0, 200.0))
    return type("Arm", (Mechanism,), members)()


@first_daily(2, "count, seed", [(4, 0), (5, 1), (6, 2), (2, 3), (3, 4)])
def test_a_program_has_the_forces_of_any_number_of_cylinders(count, seed):
    machine, random = arm_of(count, seed), np.random.default_rng(seed)
    asked = [pin_force("P0"), pin_force("F1"), *(thrust(f"ram{k}") for k in range(1, count + 1))]
    strokes = {f"s{k}": random.uniform(0.0, 0.2, 5) for k in range(1, count + 1)}
    found, motion = machine.evaluate(asked, **strokes), machine.at(**strokes)
    for each, values in zip(asked, found, strict=True):
        assert_allclose(values, motion[each], rtol=1e-10)
    for k in range(1, count + 1):
        assert_allclose(np.abs(pin_forces(motion).thrusts[f"ram{k}"]), np.abs(motion[thrust(f"ram{k}")]), rtol=1e-10)


def sums_of_strokes(seed):
    """Return cranks and carriages that follow sums of two or three strokes, and rams on some of them."""
    random, strokes = np.random.default_rng(seed), [f"s{k}" for k in range(2 + seed % 2)]
    members, points = {name: Stroke(0.0, 0.3) for name in strokes} | {"O": Ground(0.0, 0.0), "K": Ground(0.3, -0.6)}, []
    for k in range(3):
        signs = random.permutation([1.0, *random.choice([-2.0, -0.5, 0.0, 0.7, 1.0], len(strokes) - 1)])
        follows, point = sum(factor * ref(name) for factor, name in zip(signs, strokes, strict=True) if factor), f"P{k}"
        if random.random() < 0.5:
            base = random.choice(["O", *points])
            members[point] = Crank(base, angle=random.uniform(-1.0, 1.0) + follows, **{base + point: random.uniform(0.5, 1.0)})
        else:
            members[f"g{k}"] = Guide(tuple(random.uniform(-1.0, 1.0, 2)), angle=random.uniform(-3.0, 3.0))
            members[point] = OnGuide(f"g{k}", at=random.uniform(-0.5, 0.5) + follows)
        points.append(point)
        members["w" + point] = Weight(point, mass=random.uniform(10.0, 100.0))
    for k in range(int(random.integers(1, len(strokes) + 1))):
        ends = random.choice(["K", *points], 2, replace=False)
        members[f"ram{k}"] = Cylinder(*ends, bore=60 * mm, rod=30 * mm)
    return type("Sums", (Mechanism,), members)()


@first_daily(2, "seeds", [range(8 * k, 8 * k + 8) for k in range(12)])
def test_what_follows_several_strokes_has_one_thrust_by_work_and_by_equilibrium(seeds):
    agree = 0
    for machine in map(sums_of_strokes, seeds):
        rams, strokes = [name for name in machine.plan.members if name.startswith("ram")], {name: 0.17 for name in machine.strokes}
        with warnings.catch_warnings(), suppress(SingularError):
            warnings.simplefilter("ignore", SingularWarning)
            motion = machine.at(**strokes)
            try:
                expected = [motion[thrust(name)] for name in rams]
            except DefinitionError:  # a ram between points that no stroke parts
                continue
            forces = pin_forces(motion)
            assert_allclose([forces.thrusts[name] for name in rams], expected, rtol=1e-9)
            assert forces.residual < 1e-10 and forces.gap < 1e-9
            agree += 1
    assert agree >= 3


@first_daily(2, "seed", range(10))
def test_what_puts_oil_in_or_winds_a_rope_as_a_boom_rises_takes_nothing_from_its_cylinder(seed):
    random = np.random.default_rng(seed)
    share, mass, area = random.uniform(-0.2, 0.2), random.uniform(200.0, 900.0), np.pi / 4 * 0.08**2

    class Levelled(Mechanism):
        S, tilt = Stroke(1.04, 1.82), Stroke(-0.05, 0.05)
        A, C, M = Ground(0.0, 1.5), Ground(0.3, 0.5), Ground(0.7, 0.45)
        B = Dyad(C, A, CB=S, AB=1.0, side=RIGHT)
        T, N, U = OnLink(A, B, AT=3.2), OnLink(A, B, AN=0.28), OnLink(A, B, AU=2.45)
        master, slave = Cylinder(M, N, bore=80 * mm, rod=45 * mm), Cylinder(U, "W", bore=80 * mm, rod=45 * mm)
        level = OilLine(master.piston_side, slave.piston_side, filled=dict(slave=0.86), oil=area * (tilt + share * (S - 1.04)))
        W = Dyad(U, T, UW=slave.length, TW=0.28, side=RIGHT)
        F = OnLink(T, W, TF=1.1, WTF=75 * deg)
        lift = Cylinder(C, B, bore=125 * mm, rod=70 * mm)
        load = Weight(F, mass=mass)

    class Hook(Mechanism):
        S, winch = Stroke(0.3, 1.2), Stroke(0.0, 3.0)
        O, K, A = Ground(0.0, 0.0), Ground(0.5, -0.5), Ground(-0.5, 0.3)
        P = Crank(O, OP=1.0, angle=S)
        T = OnLink(O, P, OT=4.0)
        rope = Rope(A, T, "H", length=6.0 + winch + 8.0 * share * S)
        rail = Guide(T, angle=-90 * deg)
        H = OnGuide(rail, at=rope.last)
        load = Weight(H, mass=mass)
        lift = Cylinder(K, P, bore=125 * mm, rod=70 * mm)

    for machine, start, other, pin in ((Levelled(), 1.2, "tilt", "C"), (Hook(), 0.5, "winch", "K")):
        at = {"S": start + random.uniform(0.0, 0.4), other: 0.03}
        motion = machine.at(**at)
        forces = pin_forces(motion)
        assert_allclose(motion[thrust("lift")], forces.thrusts["lift"], rtol=1e-10)
        assert_allclose(machine.evaluate([thrust("lift"), pin_force(pin, "lift")], **at), np.abs(forces.thrusts["lift"]), rtol=1e-10)
        assert forces.gap < 1e-10 and not any(each.rule == "held" for each in machine.verdicts())
        if other == "winch":  # the ram carries rope and hook as if the length of the rope stood still
            still = type("Still", (Hook,), {"rope": Rope("A", "T", "H", length=6.03 + 8.0 * share * at["S"]), "winch": None})()
            assert_allclose(still.at(S=at["S"])[thrust("lift")], motion[thrust("lift")], rtol=1e-10)
