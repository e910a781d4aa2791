"""The equations of forces say what the engine says: loads, driving forces, thrusts, pressures, reserves; the papers' own among them."""

import numpy as np
import pytest
import sympy
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, thrust
from linkage import (
    LEFT,
    RIGHT,
    Actuator,
    Between,
    Crank,
    Damper,
    DefinitionError,
    Dimension,
    Dyad,
    Force,
    Ground,
    Link,
    LinkMass,
    LoadCase,
    Mechanism,
    Moment,
    OnLink,
    Pin,
    PinFriction,
    Spring,
    Stroke,
    Support,
    Weight,
    driving_force,
)
from linkage.formulas import equations
from linkage.units import bar, deg, kgf, kgf_cm2, kN, mm
from mechanisms.at_work.excavator import DiggingExcavator
from mechanisms.at_work.forwarder import Forwarder
from mechanisms.at_work.one_pump import PumpedExcavator
from mechanisms.at_work.tail_lift import TailLift
from mechanisms.at_work.telehandler import Telehandler
from mechanisms.at_work.tipper import Tipper
from mechanisms.at_work.tractor import PloughTractor, SpreaderTractor
from mechanisms.at_work.wheel_loader import WheelLoader
from mechanisms.header_balancer import HeaderBalancer, ImprovedBalancer
from mechanisms.header_balancer.following import HeaderState
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch
from mechanisms.three_point_hitch.capacity import capacity
from tests.for_all import first_daily, for_all


def along(design, count=7):
    """Return the same design's motion and the strokes [SI], equally spaced, the first stroke running and the others in step with it."""
    places = (np.arange(count) + 0.3) / count
    strokes = {name: each.start + places * (each.end - each.start) for name, each in design.plan.strokes.items()}
    return design.at(**strokes), strokes


def check_forces(design, *, rtol=1e-9):
    """Compare driving forces and all thrusts with the engine; return the values by name."""
    motion, strokes = along(design)
    values = equations(design, forces=True).values(at=strokes)
    scale = max((float(np.max(np.abs(driving_force(motion, drive=name)))) for name in strokes), default=1.0)
    for name in strokes:
        assert_allclose(values[f"Q_{name}"] * np.ones(7), driving_force(motion, drive=name), rtol=rtol, atol=1e-12 * scale, err_msg=name)
    for name, each in design.plan.of_kind(Cylinder).items():
        assert_allclose(values[f"T_{name}"] * np.ones(7), each.thrust(motion), rtol=rtol, atol=1e-12 * scale, err_msg=name)
    return motion, values


# -- the papers' machines ----------------------------------------------------------------------------------

PRINTED = {  # the worksheet's results: S, F [kgf], pd [kgf/cm2], kz
    0.55: (8094, 161.017, 0.963), 0.60: (7359, 146.397, 1.059), 0.65: (6890, 137.081, 1.131),
    0.70: (6348, 126.282, 1.227), 0.75: (5405, 107.534, 1.441), 0.80: (2801, 55.727, 2.781),
}  # fmt: skip


def test_mower_lift_has_the_worksheets_forces():
    values = equations(MowerLift, forces=True).values(at={"S": np.array(list(PRINTED))})
    F, pd, kz = np.array(list(PRINTED.values())).T
    assert_allclose(values["F"] / kgf, F, atol=0.51)
    assert_allclose(values["pd"] / kgf_cm2, pd, atol=5.1e-4)
    assert_allclose(values["kz"], kz, atol=5.1e-4)
    assert_allclose(values["SS"], 50.265e-4, atol=5e-8)
    assert_allclose(values["F_max"] / kgf, 7402, atol=0.5)


def test_mower_lift_is_the_engine():
    design = MowerLift(k_m=0.8, weight=1000 * kgf, bore=0.09)
    motion, values = check_forces(design)
    assert_allclose(values["pd"], design.circuit.pressure_for(motion), rtol=1e-9)
    assert_allclose(values["kz"], design.circuit.reserve(motion), rtol=1e-9)
    assert_allclose(values["I_G"], motion.ratio("G")[1], rtol=1e-9)


def test_mower_lifts_reserve_in_closed_form():
    """kz = k_m k_g p_max area / (P I), with I = dG_y/dS = DFI3 OG cos(FI3 + BOG)."""
    listed = equations(MowerLift, forces=True)
    found, given = listed.closed("kz"), listed.symbols
    names = {"S", "weight", "p_max", "bore", "k_m", "k_g", "L_OB", "L_OG", "BOG", "A.x", "A.y", "O.x", "O.y"}
    assert {symbol.name for symbol in found.free_symbols} <= names
    assert sympy.simplify(found.diff(given["p_max"]) * given["p_max"] / found) == 1
    assert sympy.simplify(found.diff(given["bore"]) * given["bore"] / found) == 2


class Laden(ThreePointHitch):
    """A hitch with a mass of its own in the lower link."""

    own = LinkMass("E F", mass=120)


@first_daily(2, "hitch", [ThreePointHitch(), ThreePointHitch(OB=0.32, **{"load.mass": 900.0}), Laden()], ids=repr)
def test_hitch_has_capacity_pressure_and_reserve(hitch):
    motion, values = check_forces(hitch)
    assert_allclose(values["G_g"], capacity(motion), rtol=1e-9)
    assert_allclose(values["F_cyl"], 2 * np.pi / 4 * hitch["lift.bore"] ** 2 * hitch["circuit.pressure"], rtol=1e-12)
    assert_allclose(values["p_lift"], hitch.circuit.pressure_for(motion), rtol=1e-9)
    assert_allclose(values["kz_lift"], hitch.circuit.reserve(motion), rtol=1e-9)
    assert_allclose(values["F_lift"], hitch.circuit.rod_force(motion), rtol=1e-9)


@first_daily(1, "header", [HeaderBalancer(), HeaderBalancer(m2=2000.0, charge=94 * kgf_cm2), ImprovedBalancer()], ids=repr)
def test_header_has_its_arm_and_reactions(header):
    motion, strokes = along(header)
    values, state = equations(header, forces=True).values(at=strokes), HeaderState(motion)
    assert_allclose(values["H"], state.arm, rtol=1e-9)
    assert_allclose(values["T_lift"] / values["A_lift"], state.pressure, rtol=1e-12)
    assert_allclose(values["T_lift"], header.lift.thrust(motion), rtol=1e-12)
    assert_allclose(values["dV"], state.circuit.withdrawn(motion), rtol=1e-9, atol=1e-15)
    for name, found in {"F_R": state.free, "F_R_up": state.up, "F_R_down": state.down}.items():
        assert_allclose(values[name], found, rtol=1e-9, atol=1e-6, err_msg=name)
    assert_allclose(values["P_req"], state.required, rtol=1e-9)
    assert_allclose(values["Q_h"], driving_force(motion), rtol=1e-9, atol=1e-6)


# -- every kind of load ------------------------------------------------------------------------------------


def stop(length, rate):
    """Return the thrust of a bump stop [N]: it pushes below 0.8 m."""
    return np.where(length < 0.8, 4e4 * (0.8 - length), 0.0)


def stepped(length, rate):
    """Return a thrust that needs its number [N]."""
    return 500.0 * np.ceil(np.asarray(length, float) * 10.0)


class Everything(Mechanism):
    """An arm with loads of all kinds, on a cylinder beside a crank."""

    phi = Stroke(0.1, 0.9)
    A, O, W = Ground(0.9, 0.1), Ground(0.0, 0.0), Ground(0.1, 1.4)
    B = Crank(O, OB=0.8, angle=phi)
    G = OnLink(O, B, OG=1.2, BOG=10 * deg)
    k = Dimension(900.0)
    load = Weight(G, mass=200)
    side = Weight(B, mass=50, gravity=(3.0, -9.0))
    pull = Force(G, (-500.0, 300.0))
    up = Force(B, (0.0, 250.0))
    own = LinkMass("O B", mass=30)
    off = LinkMass("O B", mass=12, at=(0.3, 0.05))
    turn = Moment("O B", M=-90)
    spring = Spring(B, W, stiffness="k", free_length=0.5)
    taut = Spring(G, W, stiffness=700.0, preload=50.0)
    push = Actuator(A, G, force=1 * kN)
    still = Damper(A, B, coefficient=800.0)
    bump = Between(G, W, stop)
    ratchet = Between(B, W, stepped)
    rest = Support(G, (0, 1))


def test_every_kind_of_load_is_in_the_driving_force():
    _, values = check_forces(Everything())
    assert "P_load" in values and "P_side" not in values  # that one does not point straight down
    assert values["F_side"][1] == pytest.approx(-450.0) and values["F_up"] == 250.0
    assert_allclose(values["T_push"], 1 * kN)
    assert not {"T_still", "P_rest", "F_rest"} & set(values)


def test_laws_are_written_out_and_what_has_no_formula_is_given():
    text = str(equations(Everything, forces=True))
    assert "T_spring = k*(0.5 - |BW|)" in text.replace("spring_free_length", "0.5")
    assert "Piecewise(" in text
    assert text.partition("Given:")[2].partition("\n\n")[0].replace("\n", " ").rstrip(".").endswith("T_ratchet")
    filled = equations(Everything, forces=True, at={"phi": 0.5}).text()
    assert "T_ratchet = " in filled


def with_members(**members):
    """Return a lifting arm with further members."""
    S = Stroke(0.00, 0.25)
    body = {
        "S": S, "A": Ground(0.20, 0.55), "O": Ground(0.30, 1.15), "C": Ground(0.1, 0.2),
        "B": Dyad("A", "O", AB=0.50 + S, OB=0.30, side=RIGHT), "G": OnLink("O", "B", OG=0.9, BOG=-40 * deg), "load": Weight("G", mass=2400),
    }  # fmt: skip
    return type("Lifted", (Mechanism,), body | members)


RAM = dict(bore=80 * mm, rod=45 * mm)


@for_all(
    "members",
    [
        dict(ram=Cylinder("A", "B", **RAM)),
        dict(ram=Cylinder("A", "B", count=2, **RAM), pump=LiftCircuit("ram", pressure=180 * bar, relief=170 * bar)),
        dict(
            ram=Cylinder("A", "B", **RAM),
            pump=LiftCircuit("ram", pressure=180 * bar, mechanical_efficiency=0.9, hydraulic_efficiency="k_h", back_pressure=6 * bar),
            k_h=Dimension(0.93),
        ),
        dict(ram=Cylinder("C", "G", **RAM), pump=LiftCircuit("ram", pressure=250 * bar, back_pressure=2 * bar)),
        dict(ram=Cylinder("A", "B", works="both", **RAM), pump=LiftCircuit("ram", pressure=180 * bar)),
        dict(ram=Cylinder("A", "B", works="both", **RAM), load=Force("G", (0, 9e3)), pump=LiftCircuit("ram", pressure=180 * bar)),
        dict(ram=Cylinder("A", "B", works="rod", **RAM), load=Force("G", (0, 9e3)), pump=LiftCircuit("ram", pressure=180 * bar)),
        dict(
            ram=Cylinder("A", "B", **RAM), other=Cylinder("C", "G", bore=50 * mm, rod=28 * mm),
            pump=LiftCircuit(["ram", "other"], pressure=300 * bar),
        ),
        dict(
            ram=Cylinder("A", "B", **RAM), twin=Cylinder("A", "B", bore=50 * mm, rod=28 * mm),
            pump=LiftCircuit(["ram", "twin"], pressure=300 * bar),
        ),
    ],
    ids=["alone", "relief", "losses", "elsewhere", "both pushes", "both pulls", "rod", "one line", "side by side"],
)  # fmt: skip
def test_circuits_are_the_engine(members):
    design = with_members(**members)()
    motion, values = check_forces(design)
    for name, ram in design.plan.of_kind(Cylinder).items():
        assert_allclose(values[f"p_{name}"], ram.pressure(motion), rtol=1e-9, err_msg=name)
        if "pump" in members:
            pump = design.plan.members["pump"]
            assert_allclose(values[f"kz_{name}"], pump.reserve(motion, cylinder=name), rtol=1e-9)
            assert_allclose(values[f"Fmax_{name}"], pump.largest(motion, cylinder=name), rtol=1e-9)


class TwoStrokes(Mechanism):
    """A boom and an arm, turned by angles, each with a cylinder; that of the arm follows both."""

    p, q = Stroke(0.3, 0.8), Stroke(-1.2, -0.6)
    O, C, E = Ground(0.0, 0.0), Ground(0.3, -0.3), Ground(-0.2, 0.9)
    B = Crank(O, OB=2.0, angle=p)
    D = OnLink(O, B, OD=1.0, BOD=12 * deg)
    G = Crank(B, BG=1.6, angle=q)
    H = OnLink(B, G, BH=0.5, GBH=30 * deg)
    load = Weight(G, mass=300)
    wind = Force(H, (200.0, 0.0))
    boom = Cylinder(C, D, bore=90 * mm, rod=50 * mm)


class Crossed(TwoStrokes):
    """The second cylinder stands on the ground: both follow both strokes where the first one is on the arm too."""

    boom = Cylinder("C", "H", bore=90 * mm, rod=50 * mm)
    arm = Cylinder("E", "G", bore=70 * mm, rod=40 * mm, works="both")


class Stacked(TwoStrokes):
    """The second cylinder stands on the boom."""

    arm = Cylinder("D", "H", bore=70 * mm, rod=40 * mm, works="both")


@pytest.mark.parametrize("machine", [TwoStrokes, Stacked, Crossed])
def test_several_strokes(machine):
    _, values = check_forces(machine())
    assert "I_G" not in values and {"Q_p", "Q_q"} <= set(values)


def thrusts_in_case(machine, case):
    """Yield the thrust of each cylinder by the equations of a load case, and by the engine, at one pose."""
    design = machine()
    strokes = {name: 0.4 * each.start + 0.6 * each.end for name, each in design.plan.strokes.items()}
    motion, found = design.at(**strokes), equations(design, forces=True, case=case)
    values = {name.partition("T_")[2]: value for name, value in found.values(strokes).items() if name.startswith("T_")}
    for name in design.plan.of_kind(Cylinder):
        if name in values:
            yield values[name], motion[thrust(name, case=case)]


@for_all(
    "machine", [SpreaderTractor], slow=[Telehandler, PloughTractor, DiggingExcavator, PumpedExcavator, Forwarder, WheelLoader, Tipper],
)  # fmt: skip
def test_loads_are_those_of_the_load_case(machine):
    for case in machine.plan.of_kind(LoadCase):
        pairs = [*thrusts_in_case(machine, case)]
        assert pairs
        for written, told in pairs:
            assert_allclose(written, told, rtol=1e-10, err_msg=case)
        assert f"load case {machine.plan.members[case].label}" in str(equations(machine, forces=True, case=case))


def test_a_load_case_is_of_forces_and_shuts_nothing():
    with pytest.raises(DefinitionError, match="give forces=True too"):
        equations(Telehandler, case="far")
    with pytest.raises(DefinitionError, match="shuts tilting"):
        equations(TailLift, forces=True, case="full")


def test_pins_found_together_have_given_ratios():
    class Group(Mechanism):
        phi = Stroke(0.1, 0.3)
        O, P, Q = Ground(0, 0), Ground(1.0, 0.0), Ground(0.5, 1.2)
        A = Crank(O, OA=0.1, angle=phi)
        plate = Link("D E F", DE=0.3)
        r1, r2, r3 = Link("A D", AD=0.43), Link("P E"), Link("Q F")
        D, E, F = Pin(at=(0.5, 0.2)), Pin(at=(0.8, 0.3)), Pin(at=(0.6, 0.5))
        load = Weight(F, mass=80)
        pull = Spring(D, Q, stiffness=2e3, free_length=0.4)

    check_forces(Group())
    assert "dF/dphi" in str(equations(Group, forces=True)).partition("\n\n")[0]


def test_a_law_with_an_if_is_a_given_number():
    def if_long(length, rate):
        return 300.0 if length > 1.0 else 200.0 * length

    class Odd(Everything):
        ratchet = Between("B", "W", if_long)

    assert "T_ratchet" not in [each.name for each in equations(Odd, forces=True)]
    values = equations(Odd, forces=True).values(at={"phi": 0.3})
    assert values["Q_phi"] == pytest.approx(float(driving_force(Odd().at(phi=0.3))), rel=1e-9)


def test_friction_is_left_out_and_named():
    class Rubbing(MowerLift):
        pin = PinFriction("O", radius=0.03, coefficient=0.2)

    assert "Left out: the friction of pin." in str(equations(Rubbing, forces=True))
    assert "Left out" not in str(equations(MowerLift, forces=True))
    assert_allclose(equations(Rubbing, forces=True).values()["T_lift"], equations(MowerLift, forces=True).values()["T_lift"])


# -- as it is printed --------------------------------------------------------------------------------------

LAST = """\
(13) P_load = weight
(14) dOAB/dS = (cos(OAB)*|AO| - S)/(S*sin(OAB)*|AO|)
(15) dAB/dS = AB/S - dOAB/dS*TurnV(AB, 90 deg)
(16) dB/dS = dAB/dS
(17) dOB/dS = dB/dS
(18) dOG/dS = cross(OB, dOB/dS)*TurnV(OG, 90 deg)/(|OB|**2)
(19) dG/dS = dOG/dS
(20) I_G = dG_y/dS
(21) Q_S = I_G*P_load
(22) T_lift = Q_S
(23) SS = pi*bore**2/4
(24) F_max = SS*k_g*p_max
(25) F = T_lift/(k_g*k_m)
(26) pd = F/SS
(27) kz = p_max/pd"""


def test_they_follow_the_kinematic_ones():
    listed = equations(MowerLift, forces=True)
    assert str(listed).endswith(LAST)
    assert str(listed).partition("\n\n")[2].startswith(str(equations(MowerLift)).partition("\n\n")[2])
    assert [each.number for each in equations(MowerLift, forces=True, start=4)][-1] == 30
    again = equations(MowerLift, forces=True, ratio="G")
    assert [each.name for each in again].count("I_G") == 1 and {each.name for each in again} == {each.name for each in listed}


def test_they_are_latex():
    text = equations(ThreePointHitch, forces=True).latex(definitions=False)
    assert r"  I_{G} &= \frac{dG_{y}}{dS} \tag{47} \\" in text
    assert r"  Q_{S} &= I_{G} P_{load} \tag{48} \\" in text
    assert r"G_{g} &= \frac{F_{cyl} \mathit{circuit}_{\mathit{mechanical\_efficiency}}}{I_{G}} \tag{56}" in text
    assert r"\vec{F}_{pull} \cdot \frac{d\vec{G}}{d\varphi}" in equations(Everything, forces=True).latex().replace(r"\phi", r"\varphi")


def test_numbers_within_an_equation_are_si_and_the_result_has_its_own_unit():
    text = equations(HeaderBalancer, forces=True, at={"h": 0.1}).text()
    assert "L_AB(h) = L_min + h = 0.7 + 0.1 = 0.8 m = 800 mm" in text
    assert "L_min = 700 mm" in text and "m1 = 1500 kg" in text and "Pa = 35.2134 bar" in text
    assert "T_lift = A_lift*p_lift = 0.00623449*3.52134e+06 = 21953.8 N = 21.9538 kN" in text


LOW = {"P_I": 30 * kgf_cm2, "atmosphere": 0.0, "charge": 60 * kgf_cm2}


@first_daily(2, "changed", [{}, {"charge": 60 * kgf_cm2}, {"charge": 60 * kgf_cm2, "V_II": 0.0}, LOW])
def test_gases_of_a_line_have_a_formula(changed):
    header = HeaderBalancer(**changed)
    motion = header.sweep(41)
    values = equations(header, forces=True).values(at=motion.strokes)
    assert_allclose(values["p_lift"], header.floating.pressure(motion), rtol=1e-12)


def test_a_fast_movement_of_a_line_is_a_given_number():
    assert equations(HeaderBalancer(n=1.4), forces=True).text().count("; p_lift.") == 1


def test_many_digits():
    found = equations(MowerLift, forces=True).values(at={"S": 0.55}, digits=30)
    assert found["kz"] == pytest.approx(0.9626342, abs=1e-6)
    assert abs(found["kz"] * found["pd"] - sympy.Float(repr(155 * kgf_cm2), 30)) < sympy.Float("1e-20", 30)


def test_without_loads_there_is_nothing_but_a_drive():
    class Bare(Mechanism):
        S = Stroke(0.5, 0.6)
        A, O = Ground(0.0, 0.0), Ground(0.4, 0.1)
        B = Dyad(A, O, AB=S, OB=0.3, side=LEFT)

    listed = equations(Bare, forces=True)
    assert [str(each) for each in listed[-1:]] == ["Q_S = 0"]
