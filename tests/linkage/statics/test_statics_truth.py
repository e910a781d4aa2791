"""Forces against figures worked out by hand: textbook mechanisms whose answer is a line of trigonometry."""

from math import atan2, cos, hypot, pi, radians, sin, sqrt, tan

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    RIGHT,
    Crank,
    Dyad,
    Force,
    Ground,
    Guide,
    GuideFriction,
    Mechanism,
    Moment,
    OnGuide,
    OnLink,
    PinFriction,
    PinSlotDyad,
    SingularError,
    SliderDyad,
    Spring,
    Stroke,
    Support,
    Weight,
    deg,
    driving_force,
    kgf,
    kN,
    pin_forces,
    reaction,
)
from mechanisms.classics.four_bar import FourBar, Parallelogram
from mechanisms.classics.scissor_lift import ScissorLift
from mechanisms.classics.slider_crank import SliderCrank
from mechanisms.classics.toggle_press import TogglePress
from mechanisms.mower_lift import MowerLift

G0 = 9.80665


def complex_of(motion, point):
    """Return a point as complex numbers [m]."""
    return motion.x(point) + 1j * motion.y(point)


def test_four_bar_with_a_torque_on_the_rocker():
    """The coupler is a two-force member: its force is the torque over its lever arm about C, and turns the crank on its arm about O."""
    motion = FourBar().sweep(37)
    O, A, B, C = (complex_of(motion, point) for point in "OABC")
    along = (B - A) / np.abs(B - A)
    arm_B, arm_A = ((B - C).conj() * along).imag, ((A - O).conj() * along).imag
    coupler = -80.0 / arm_B                                  # along A -> B on the rocker, N
    found = pin_forces(motion, [Moment("C B", M=80.0)])
    assert_allclose(found.drives["phi"], coupler * arm_A, rtol=1e-11, atol=1e-11)
    assert_allclose(found.at("A")[0].size, np.abs(coupler), rtol=1e-11)
    assert_allclose(found.force("C", on="CB"), -np.stack([(coupler * along).real, (coupler * along).imag]), rtol=1e-11, atol=1e-9)


@pytest.mark.parametrize("place", [0.0, 0.05, 0.17])
def test_a_weight_on_a_parallelograms_coupler_weighs_the_same_everywhere(place):
    machine = type("Loaded", (Parallelogram,), {"W": OnLink("A", "B", AW=place or 1e-3)})
    motion = machine().sweep(9)
    torque = driving_force(motion, [Weight("W", mass=10.0)])
    assert_allclose(torque, 10.0 * G0 * 0.060 * np.cos(motion.strokes["phi"]), rtol=1e-12, atol=1e-13)


def test_slider_crank_torque_and_side_thrust():
    """With the rod under beta to the rail a piston force P presses P tan(beta) on the guide (Norton, chapter 11)."""
    motion = SliderCrank().sweep(25)
    A, B = motion["A"], motion["B"]
    beta = np.arctan2(A[1] - B[1], B[0] - A[0])              # rod below the horizontal, towards B
    found = pin_forces(motion, [Force("B", (-1000.0, 0.0))])
    guide = next(each for each in found.at("B") if each.kind == "guide")
    assert_allclose(guide.force[1], 1000.0 * np.tan(beta), atol=1e-10)
    assert_allclose(found.at("A")[0].size, 1000.0 / np.cos(beta), rtol=1e-12)
    phi = motion.strokes["phi"]
    assert_allclose(found.drives["phi"], -1000.0 * 0.040 * np.sin(phi + beta) / np.cos(beta), atol=1e-10)


@pytest.mark.parametrize(("direction", "sense"), [("extending", 1), ("retracting", -1)])
def test_slider_crank_with_friction_on_its_guide(direction, sense):
    """Rod force F: along the rail F cos(beta) = P + mu |F sin(beta)| s, with s the slider's sense against the load."""
    mu, P = 0.2, 1000.0
    motion = SliderCrank().at(phi=np.linspace(20, 340, 9) * deg)
    A, B = motion["A"], motion["B"]
    beta = np.arctan2(A[1] - B[1], B[0] - A[0])
    s = np.sign(motion.ratio("B")[0]) * sense                # + where the slider goes along x, against the load
    rod = P / (np.cos(beta) - mu * np.abs(np.sin(beta)) * s)
    found = pin_forces(motion, [Force("B", (-P, 0.0)), GuideFriction("B", mu)], direction=direction)
    assert_allclose(found.at("A")[0].size, rod, rtol=1e-12)
    assert_allclose(found.drives["phi"], -rod * 0.040 * np.sin(motion.strokes["phi"] + beta), rtol=1e-11)


class Arch(Mechanism):
    """A three-hinged arch of span 20 m and rise 5 m; its right half is a strut of adjustable length."""

    S = Stroke(11.0, 11.5)
    A, B = Ground(0.0, 0.0), Ground(20.0, 0.0)
    C = Dyad(A, B, AC=sqrt(125.0), BC=S, side=LEFT)
    D = OnLink(A, C, AD=hypot(5.0, 3.75), CAD=atan2(3.75, 5.0) - atan2(5.0, 10.0))


def test_three_hinged_arch():
    """100 kN at a quarter of the span: V = 75 and 25 kN, H = 25 * 10 / 5 = 50 kN (any text on structures)."""
    found = pin_forces(Arch().at(S=sqrt(125.0)), [Force("D", (0.0, -100 * kN))])
    assert_allclose(found.force("A", on="ACD"), [50 * kN, 75 * kN], rtol=1e-12)
    assert_allclose(found.force("B", on="BC"), [-50 * kN, 25 * kN], rtol=1e-12)
    assert_allclose(found.force("C", on="ACD"), [-50 * kN, 25 * kN], rtol=1e-12)
    assert_allclose(found.drives["S"], hypot(50, 25) * kN, rtol=1e-12)


def test_toggle_press():
    """The ram's force F on arms under alpha: sideways 2 F tan(alpha), less what the cylinder's own slope adds to one arm."""
    motion = TogglePress().sweep(15)
    A, C, F = motion["A"], motion["C"], 50 * kN
    tangent = np.abs(A[0]) / (0.800 - A[1])                  # of alpha, both arms
    c, s = (A - C) / np.hypot(*(A - C))                      # the cylinder's direction
    expected = 2 * F * tangent / (c - s * tangent)
    assert_allclose(driving_force(motion, [Support("B", (0, 1), force=F)]), expected, rtol=1e-11)
    assert_allclose(reaction(motion, [], support=Support("B", (0, 1)), drive_force=expected), F, rtol=1e-11)


class Table(Mechanism):
    """A scissor table of one stage: roller A is pushed along the floor, the platform CX rests on C and the roller B."""

    S = Stroke(0.5, 1.5)
    O = Ground(0.0, 0.0)
    floor = Guide(O, angle=0.0)
    A = OnGuide(floor, at=S)
    M = Dyad(O, A, OM=0.8, AM=0.8, side=LEFT)
    B = OnLink(O, M, OB=1.6)
    C = OnLink(A, M, AC=1.6)
    X = PinSlotDyad(C, B, CX=0.3)


@pytest.mark.parametrize("place", [0.2, 0.9])
def test_scissor_table_needs_w_over_tan(place):
    """P = W / tan(alpha) wherever the load stands on the platform (Spackman, NOSC TR 1285)."""
    motion = Table(CX=place).sweep(11)
    alpha = np.arccos(motion.strokes["S"] / 1.6)
    assert_allclose(-driving_force(motion, [Weight("X", mass=300.0)]), 300.0 * G0 / np.tan(alpha), rtol=1e-11)
    found = pin_forces(motion, [Weight("X", mass=300.0)])
    share = place / motion.strokes["S"]                      # the roller's share of the load, by its lever about C
    roller = next(each for each in found.at("B") if each.kind == "guide")
    assert_allclose(np.abs(roller.force[1]), 300.0 * G0 * share, rtol=1e-11)


def test_scissor_lift_against_spackman():
    """Two stages with arms L under alpha: dh / dalpha = 4 half cos(alpha) per stage pair, and the cylinder's by its triangle."""
    motion, half = ScissorLift().sweep(13), 0.800
    J, K = motion["J"], motion["K"]
    alpha = np.arctan2(J[1], J[0])
    rise = 2 * 2 * half * np.cos(alpha)                      # dh / dalpha of two stages
    turn = (J[0] * (J - K)[1] - J[1] * (J - K)[0]) / np.hypot(*(J - K))     # dS / dalpha: the cylinder's lever arm about O
    assert_allclose(driving_force(motion, [Weight("D", mass=1000.0)]), 1000.0 * G0 * rise / turn, rtol=1e-10)


def test_mower_lift_of_the_worksheet():
    """The rod carries P I = 6536 kgf at S = 0.55 m, and 7689 kgf with the mechanism's losses."""
    motion = MowerLift().at(S=0.55)
    load = [Weight("G", mass=900.0)]
    assert abs(driving_force(motion, load) / kgf - 6536.0) < 0.5
    assert abs(driving_force(motion, load, direction="extending", efficiency=0.85) / kgf - 7689.0) < 0.5
    assert_allclose(driving_force(motion, load, direction="retracting", efficiency=0.85), 0.85 * driving_force(motion, load), rtol=1e-14)


# -- friction ----------------------------------------------------------------------------------------------


class Ladder(Mechanism):
    """A ladder AB whose foot A is drawn along the floor and whose head B slides on the wall."""

    S = Stroke(0.10, 0.28)
    floor, wall = Guide((0.0, 0.0), angle=0.0), Guide((0.0, 0.0), angle=90 * deg)
    A = OnGuide(floor, at=S)
    B = SliderDyad(A, wall, AB=0.3, side=RIGHT)
    load = Weight(B, mass=100.0)
    head = GuideFriction(B, 0.3)
    foot = GuideFriction(A, 0.2)


@pytest.mark.parametrize(("direction", "up"), [("extending", -1), ("retracting", 1)])
def test_ladder_with_friction(direction, up):
    """Under alpha to the floor the ladder's force is W / (sin alpha -/+ mu cos alpha), up / down the wall."""
    motion = Ladder().sweep(7)
    alpha = np.arccos(motion.strokes["S"] / 0.3)
    ladder = 100.0 * G0 / (np.sin(alpha) - up * 0.3 * np.cos(alpha))
    expected = -ladder * (np.cos(alpha) + up * 0.2 * np.sin(alpha))
    assert_allclose(pin_forces(motion, direction=direction).drives["S"], expected, rtol=1e-12)
    assert_allclose(driving_force(motion, direction=direction), expected, rtol=1e-12)


def test_a_ladder_locks_where_its_slope_is_below_the_friction():
    """Pushed up the wall it jams where tan(alpha) <= mu; it is said in words, and where."""
    machine = Ladder(**{"head.coefficient": 0.5})
    with pytest.raises(SingularError, match="locks itself while retracting") as caught:
        pin_forces(machine.sweep(19), direction="retracting")
    alpha = np.arccos(machine.sweep(19).strokes["S"] / 0.3)
    assert np.array_equal(caught.value.mask, np.tan(alpha) <= 0.5)
    with pytest.raises(SingularError, match="locks itself"):
        driving_force(machine.sweep(19), direction="retracting")
    found = pin_forces(machine.sweep(19, unreachable="nan"), direction="retracting")
    assert np.array_equal(np.isnan(found.drives["S"]), np.tan(alpha) <= 0.5)
    assert np.array_equal(found.locked, np.tan(alpha) <= 0.5)
    assert any("locks itself" in each for each in found.remarks)


class Screw(Mechanism):
    """A slider pushed up a wall by a nearly level link: friction alone holds it."""

    S = Stroke(0.20, 0.28)
    floor, wall = Guide((0.0, 0.0), angle=0.0), Guide((0.0, 0.0), angle=90 * deg)
    A = OnGuide(floor, at=S)
    B = SliderDyad(A, wall, AB=0.3, side=RIGHT)
    load = Weight(B, mass=100.0)
    rub = GuideFriction(A, 0.9)


def test_a_load_that_friction_holds_is_said_in_words():
    """Sinking, the load drives A outwards; where mu tan(alpha) > 1 the floor holds it and the drive must pull."""
    motion = Screw().sweep(15)
    steep = 0.9 * np.tan(np.arccos(motion.strokes["S"] / 0.3)) > 1.0
    found = pin_forces(motion, direction="extending")
    assert np.array_equal(found.drives["S"] > 0.0, steep)
    assert 0 < steep.sum() < 15
    assert [each for each in found.remarks if "Self-locking while extending" in each and f"at {steep.sum()} of 15" in each]
    assert not pin_forces(motion, direction="retracting").remarks


class Header(Mechanism):
    """A header on its drum axis O, carried by the cylinder AB, its shoe R on the ground."""

    S = Stroke(0.62, 0.75)
    A, O = Ground(0.15, -0.55), Ground(0.0, 0.0)
    B = Dyad(A, O, AB=S, OB=0.9, side=RIGHT)
    R = OnLink(O, B, OR=2.2, BOR=-20 * deg)
    G1 = OnLink(O, B, OG1=0.9, BOG1=-5 * deg)
    feeder = Weight(G1, mass=1500)
    shoe = Support(R, (0, 1))
    pin = PinFriction(O, radius=0.07, coefficient=0.15)


@pytest.mark.parametrize(("direction", "sense"), [("extending", 1), ("retracting", -1), ("frictionless", 0)])
def test_a_shoes_reaction_with_a_plain_bearing(direction, sense):
    """Moments about O with the couple |F_O| r mu against the motion, iterated to consistency by hand (header paper, (38)-(41))."""
    motion, thrust = Header().sweep(9), 9e3
    B, R, G1 = motion["B"], motion["R"], motion["G1"]
    u = (B - motion["A"]) / np.hypot(*(B - motion["A"]))
    H, weight, couple = B[0] * u[1] - B[1] * u[0], 1500 * G0, 0.0
    turn = np.sign(motion.ratio("R")[1]) * sense
    for _ in range(200):
        shoe = (weight * G1[0] - H * thrust + couple) / R[0]
        F = np.hypot(thrust * u[0], thrust * u[1] - weight + shoe)
        couple = turn * F * 0.07 * 0.15
    assert_allclose(reaction(motion, drive_force=thrust, direction=direction), shoe, rtol=1e-11)


def test_the_thrust_may_stand_as_a_load():
    motion = Header().sweep(5)
    u = (motion["B"] - motion["A"]) / motion.distance("A", "B")

    class Gas:
        def loads(self, motion):
            from linkage import Load

            return [Load("B", 9e3 * u), Load("A", -9e3 * u)]

    own = [Header.feeder, Header.pin]
    for direction in ("frictionless", "extending", "retracting"):
        by_load = reaction(motion, [*own, Gas()], Header.shoe, direction=direction)
        assert_allclose(by_load, reaction(motion, own, Header.shoe, drive_force=9e3, direction=direction), rtol=1e-10)


def test_a_journal_that_turns_in_its_pin():
    """A crank with a radial load W: the torque of its pin's friction is mu r W, whatever the angle (ISO 7902's dry limit)."""

    class Journal(Mechanism):
        phi = Stroke(0.0, 2 * pi)
        O = Ground(0.0, 0.0)
        A = Crank(O, OA=0.5, angle=phi)

    motion = Journal().sweep(9)
    loads = [Force("O", (0.0, -800.0)), Weight("A", mass=0.0), Moment("O A", M=0.0), PinFriction("O", 0.03, 0.1)]
    assert_allclose(driving_force(motion, loads, direction="extending"), 0.0, atol=1e-12)      # the load sits on the frame
    loads[1] = Force("A", (0.0, -800.0))
    torque = driving_force(motion, loads, direction="extending") - driving_force(motion, loads)
    assert_allclose(torque, 0.1 * 0.03 * 800.0, rtol=1e-12)


# -- springs -----------------------------------------------------------------------------------------------


def test_a_spring_of_no_free_length_balances_a_lamp_everywhere():
    """The Anglepoise law (Carwardine, 1932): k a b = W L balances a lever of length L at every angle."""

    class Lamp(Mechanism):
        phi = Stroke(-70 * deg, 80 * deg)
        O, P = Ground(0.0, 0.0), Ground(0.0, 0.2)
        A = Crank(O, OA=0.6, angle=phi)
        Q = OnLink(O, A, OQ=0.15)
        load = Weight(A, mass=1.5)
        spring = Spring(P, Q, stiffness=1.5 * G0 * 0.6 / (0.2 * 0.15), free_length=0.0)

    assert_allclose(driving_force(Lamp().sweep(21)), 0.0, atol=1e-13)
    alone = driving_force(Lamp().sweep(21), ["load"])
    assert_allclose(alone, 1.5 * G0 * 0.6 * np.cos(Lamp().sweep(21).strokes["phi"]), rtol=1e-12)


def test_weights_by_hand_on_a_ladder():
    motion = Ladder().at(S=0.3 * cos(radians(50)))
    assert_allclose(driving_force(motion), -100.0 * G0 / tan(radians(50)), rtol=1e-12)
    assert_allclose(pin_forces(motion).at("B")[0].size, 100.0 * G0 * cos(radians(50)) / sin(radians(50)), rtol=1e-12)


@pytest.mark.parametrize("machine", [Ladder, Screw])
@pytest.mark.parametrize("direction", ["extending", "retracting"])
def test_forces_scale_with_the_loads_and_the_words_stay(machine, direction):
    """Dry friction has no size of its own: a load of a gram gives the same remarks as a tonne, and forces in proportion."""
    found = {mass: pin_forces(machine(**{"load.mass": mass}).sweep(9), direction=direction) for mass in (1e-3, 100.0, 1e6)}
    for mass, each in found.items():
        assert each.remarks == found[100.0].remarks, mass
        assert_allclose(each.drives["S"], found[100.0].drives["S"] * mass / 100.0, rtol=1e-9)
