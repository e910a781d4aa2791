"""Joint forces: which bodies and joints are found, the results' shapes, tables, refusals, and what the words say."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    RIGHT,
    CosineAngle,
    Crank,
    DefinitionError,
    Dimension,
    Dyad,
    Force,
    Ground,
    Guide,
    Link,
    LinkMass,
    LoadCase,
    Mechanism,
    Moment,
    Offset,
    OnGuide,
    OnLink,
    SingularError,
    SingularWarning,
    SliderDyad,
    Stroke,
    Support,
    Turn,
    Vector,
    Weight,
    angle,
    deg,
    driving_force,
    max_table,
    pin_forces,
    reaction,
)
from linkage.loads import TwoPoint
from linkage.statics import table_text
from mechanisms.classics.four_bar import FourBar, Parallelogram
from mechanisms.classics.front_loader import FrontLoader
from mechanisms.classics.pantograph import Pantograph
from mechanisms.classics.roberts_cognates import RobertsCognates
from mechanisms.classics.scotch_yoke import ScotchYoke
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all

G0 = 9.80665


class Hitch(ThreePointHitch):
    """The hitch with an implement and its lower link's own mass."""

    load = Weight("G", mass=1200)
    own = LinkMass("E D F", mass=30)
    transport = LoadCase("transport", scale={"load": 2.0})


class Crane(Mechanism):
    """A boom lifted by AB, with a telescope T that carries its head H."""

    S1, S2 = Stroke(0.0, 0.4), Stroke(0.0, 0.5)
    L = Dimension(0.9)
    O, A = Ground(0.0, 0.0), Ground(0.3, -0.6)
    B = Dyad(A, O, AB=L + S1, OB=0.7, side=RIGHT)
    C = OnLink(O, B, OC=2.0)
    T = OnLink(O, B, OT=2.0 + S2)
    H = OnLink(T, O, TH=0.3, OTH=150 * deg)
    load = Weight(H, mass=500)
    boom = LinkMass("O B C", mass=100)


def test_the_hitchs_joints():
    found = pin_forces(Hitch().sweep(5))
    assert {(each.point, each.on, each.by) for each in found.joints} == {
        ("A", "lift", "frame"), ("O", "OBC", "frame"), ("E", "EDF", "frame"), ("M", "MK", "frame"), ("B", "lift", "OBC"),
        ("C", "OBC", "CD"), ("D", "EDF", "CD"), ("F", "FKG", "EDF"), ("K", "FKG", "MK"),
    }  # fmt: skip
    assert found.residual < 1e-14
    assert found.gap < 1e-13


def test_two_force_members_are_loaded_along_their_axis():
    motion = Hitch().sweep(7)
    found = pin_forces(motion)
    for P, Q, on in (("M", "K", "MK"), ("C", "D", "CD"), ("A", "B", "AB")):
        force, axis = found.force(Q, on=on), motion[Q] - motion[P]
        assert_allclose(force[0] * axis[1] - force[1] * axis[0], 0.0, atol=1e-8)
        assert_allclose(found.force(P, on=on), -force, rtol=1e-9)


def test_the_thrust_is_what_the_cylinders_pins_carry():
    found = pin_forces(Hitch().sweep(7))
    assert_allclose(found.at("B")[0].size, found.drives["S"], rtol=1e-12)
    assert (found.drives["S"] > 0).all()


def test_shapes_are_designs_then_strokes():
    found = pin_forces(Hitch(OB=np.linspace(0.28, 0.34, 4)).sweep(6))
    assert found.drives["S"].shape == (4, 6)
    assert found.force("C", on="CD").shape == (2, 4, 6)
    one = pin_forces(Hitch(OB=0.28).sweep(6))
    assert_allclose(found.force("C", on="CD")[:, 0], one.force("C", on="CD"), rtol=1e-12)
    assert pin_forces(Hitch().at(S=0.1)).force("K").shape == (2,)
    assert pin_forces(Crane().sweep(S1=3, S2=2)).drives["S2"].shape == (3, 2)


def test_action_is_reaction():
    found = pin_forces(Hitch().sweep(3))
    assert_allclose(found.force("C", on="CD"), -found.force("C", on="OBC"), rtol=0)


@pytest.mark.parametrize("machine", [Hitch, Crane, FrontLoader])
def test_all_that_acts_on_a_body_balances(machine):
    """What is handed to FEM: forces at points sum to nothing, and so do their moments where no couple acts."""
    motion = machine().sweep(**dict.fromkeys(machine.plan.strokes, 3))
    found = pin_forces(motion, None if machine is not FrontLoader else [Weight("N", mass=800)])
    turned = {each.on for each in found.joints if each.kind == "telescope"} | {each.by for each in found.joints if each.kind == "telescope"}
    for body in set(found.on_bodies) - {"frame"}:
        forces = found.on_body(body)
        size = max(np.abs(force).max() for force in forces.values())
        assert_allclose(sum(forces.values()) / max(size, 1.0), 0.0, atol=1e-12)
        if body not in turned:
            moment = sum(motion[point][0] * force[1] - motion[point][1] * force[0] for point, force in forces.items())
            assert_allclose(moment / max(size, 1.0), 0.0, atol=1e-12)


def test_the_frame_carries_the_weights():
    found = pin_forces(Hitch().sweep(3))
    assert_allclose(sum(found.on_body("frame").values()), np.array([[0.0] * 3, [-1230 * G0] * 3]), atol=1e-8)


# -- the largest forces ------------------------------------------------------------------------------------


def test_the_table_holds_the_largest_force_its_place_case_and_direction():
    motion = Hitch().sweep(11)
    results = [pin_forces(motion), pin_forces(motion, case="transport")]
    rows = {row.point: row for row in max_table(results)}
    assert_allclose(rows["K"].force, results[1].at("K")[0].size.max(), rtol=1e-15)
    assert rows["K"].case == "transport"
    assert rows["K"].strokes["S"] == motion.strokes["S"][results[1].at("K")[0].size.argmax()]
    assert rows["B"].angle == pytest.approx(np.pi, abs=1e-9)       # the arm pushes B back along B -> A
    assert (rows["B"].axis, rows["B"].on) == ("AB", "lift")
    text = table_text(max_table(results))
    assert "transport" in text and len(text.splitlines()) == 1 + len(results[0].joints)


def test_the_tables_direction_turns_with_the_body():
    """A weight hung on a crank pulls at -phi - 90 deg in the crank's own axes."""

    class Hung(Mechanism):
        phi = Stroke(30 * deg, 60 * deg)
        O = Ground(0.0, 0.0)
        A = Crank(O, OA=0.4, angle=phi)
        load = Weight(A, mass=10.0)

    row = max_table(pin_forces(Hung().at(phi=40 * deg)))[0]
    assert row.angle == pytest.approx(50 * deg, abs=1e-12)          # the frame's pin pushes up
    assert row.force == pytest.approx(10 * G0, rel=1e-14)


def test_the_table_names_the_design():
    row = max_table(pin_forces(Hitch(**{"load.mass": [500.0, 1500.0, 900.0]}).sweep(4)))[0]
    assert row.design == (1,)


# -- kinds of drives and joints ----------------------------------------------------------------------------


def test_a_telescopes_thrust_is_the_weight_along_it():
    motion = Crane().sweep(S1=4, S2=3)
    u = (motion["T"] - motion["O"]) / motion.distance("O", "T")
    found = pin_forces(motion)
    assert_allclose(found.drives["S2"], 500 * G0 * u[1], rtol=1e-12)
    assert_allclose(found.drives["S1"], driving_force(motion, drive="S1"), rtol=1e-12)
    joint = next(each for each in found.at("O") if each.kind == "telescope")
    assert_allclose(joint.couple, 500 * G0 * (motion["H"] - motion["O"])[0], rtol=1e-12)


def test_a_joint_on_an_arm():
    """A forearm turned against its upper arm: each drive holds what hangs beyond it."""

    class Arm(Mechanism):
        phi, psi = Stroke(-1.0, 1.0), Stroke(0.2, 1.0)
        O = Ground(0.0, 0.0)
        A = Crank(O, OA=1.0, angle=phi)
        B = OnLink(A, O, AB=0.8, OAB=psi)
        C = OnLink(A, B, AC=0.4)
        hand, wrist = Weight(B, 10.0), Weight(C, 3.0)

    motion = Arm().sweep(phi=4, psi=3)
    found = pin_forces(motion)
    beyond = G0 * (10.0 * (motion["B"] - motion["A"])[0] + 3.0 * (motion["C"] - motion["A"])[0])
    assert_allclose(found.drives["psi"], beyond, rtol=1e-12)
    assert_allclose(found.drives["phi"], beyond + 13.0 * G0 * motion["A"][0], rtol=1e-11)


def test_a_crank_may_count_its_angle_from_a_body():
    found = pin_forces(RobertsCognates().sweep(7), [Weight("Q", mass=10.0)])
    assert found.gap < 1e-12
    assert next(each for each in found.joints if each.kind == "crank" and each.point == "U" and "C" in each.on).by == "ABP"


def test_sliders_that_carry_guides():
    motion = Pantograph().sweep(X=3, Y=3)
    found = pin_forces(motion, [Force("R", (20.0, -5.0))])
    assert found.gap < 1e-12
    assert_allclose(found.drives["X"], -2.5 * 20.0, rtol=1e-11)     # the pen's force enlarged by the scale
    assert_allclose(found.drives["Y"], 2.5 * 5.0, rtol=1e-11)


def test_a_yokes_force_is_the_cranks():
    motion = ScotchYoke().at(phi=[0.3, 1.0, 2.0])
    found = pin_forces(motion, [Force("X", (-100.0, 0.0))])
    slot = next(each for each in found.joints if each.kind == "slot")
    assert_allclose(slot.force, np.array([[100.0] * 3, [0.0] * 3]), atol=1e-12)
    assert_allclose(found.drives["phi"], -100.0 * 0.050 * np.sin(motion.strokes["phi"]), rtol=1e-12)


class Riding(Mechanism):
    """A slider on a guide of a turning body."""

    phi = Stroke(20 * deg, 70 * deg)
    O, C = Ground(0.0, 0.0), Ground(0.5, 0.0)
    A = Crank(O, OA=0.3, angle=phi)
    D = OnLink(O, A, OD=0.9)
    rail = Guide(O, D)
    B = SliderDyad(C, rail, CB=0.49, side=RIGHT)
    load = Weight(B, mass=20.0)


def test_a_guide_on_a_moving_body():
    motion = Riding().sweep(7)
    found = pin_forces(motion)
    assert found.gap < 1e-12
    normal = next(each for each in found.at("B") if each.kind == "guide")
    assert (normal.on, normal.by) == ("CB", "OAD")
    along = motion["D"] - motion["O"]
    assert_allclose((normal.force * along).sum(axis=0), 0.0, atol=1e-10)


class Doubled(Mechanism):
    """One stroke drives a length by the double: the drive's force is twice the thrust."""

    S = Stroke(0.30, 0.40)
    A, O = Ground(0.0, 0.242), Ground(0.652, 0.330)
    B = Dyad(A, O, AB=2.0 * S, OB=0.175, side=RIGHT)
    load = Weight(B, mass=100.0)


def test_a_drive_that_moves_its_length_by_the_double():
    found = pin_forces(Doubled().sweep(5))
    assert_allclose(found.drives["S"], 2.0 * found.at("B")[0].size * np.sign(found.drives["S"]), rtol=1e-12)
    assert found.gap < 1e-12


def test_primitives_hold_their_load_and_take_a_cylinder_from_a_force_element():
    class Ram(TwoPoint):
        A, B, holds = "A", "B", True

        def push(self, motion, length, rate):
            return np.zeros(())

        def pushes(self, motion, rates=None):
            return []

    class Primitive(Mechanism):
        S = Stroke(0.55, 0.80)
        A, O, r = Ground(0.0, 0.242), Ground(0.652, 0.330), Dimension(0.175)
        AO = Vector(A, O)
        OAB = CosineAngle(abs(AO), S, r)
        B = Offset(A, Turn(AO, -OAB, length=S))
        load = Weight(B, mass=100.0)

    motion = Primitive().sweep(5)
    own, found = pin_forces(motion), pin_forces(motion, [Primitive.load, Ram()])
    assert_allclose(own.drives["S"], driving_force(motion), rtol=1e-11)
    assert_allclose(found.drives["S"], driving_force(motion), rtol=1e-11)
    assert list(own.thrusts) == ["AB"] and "AB" not in found.thrusts


# -- refusals ----------------------------------------------------------------------------------------------


class Third(Parallelogram):
    """A parallelogram with a third rocker."""

    E = Ground(0.05, 0.0)
    M = OnLink("A", "B", AM=0.05)
    third = Link(E, M)
    load = Weight(M, mass=10.0)


def test_a_redundant_link_is_named():
    with pytest.raises(DefinitionError, match=r"overconstrained.*link CB, link EM"):
        pin_forces(Third().sweep(5))


def test_redundant_links_share_when_asked():
    motion = Third().sweep(5)
    found = pin_forces(motion, split="least squares")
    assert found.gap < 1e-12 and found.residual < 1e-12
    assert_allclose(found.drives["phi"], driving_force(motion), rtol=1e-12, atol=1e-13)
    shares = {name: each.force for name in "ABM" for each in found.at(name)}
    assert all(np.abs(share).max() > 1.0 for share in shares.values())


def test_a_split_that_is_not_needed_changes_nothing():
    motion = FourBar().sweep(5)
    loads = [Weight("P", mass=3.0)]
    assert_allclose(pin_forces(motion, loads, split="least squares").force("A"), pin_forces(motion, loads).force("A"), rtol=1e-9)


def test_a_load_on_a_point_of_no_body_is_refused():
    class Loose(Mechanism):
        S = Stroke(0.0, 0.1)
        O, A = Ground(0.0, 0.0), Ground(1.0, 0.0)
        B = Dyad(O, A, OB=0.6 + S, AB=0.6, side=LEFT)
        P = Offset(O, Turn(Vector(O, B), 0.5))             # as long as the cylinder, and no part of it

    with pytest.raises(DefinitionError, match="P belongs to no body"):
        pin_forces(Loose().sweep(3), [Weight("P", mass=1.0)])
    assert driving_force(Loose().sweep(3), [Weight("P", mass=1.0)]).shape == (3,)


def test_forces_are_refused_at_a_dead_point():
    dead = Parallelogram().at(phi=[0.0, 1.0])
    with pytest.raises(SingularError, match="refused") as caught:
        pin_forces(dead, [Weight("P", 1.0)])
    assert caught.value.mask.tolist() == [True, False]
    with pytest.raises(SingularError, match="refused"):
        driving_force(dead, [Weight("P", 1.0)])


def test_other_poses_are_given_when_asked_for_with_nan():
    motion = Parallelogram().at(phi=[0.0, 1.0], unreachable="nan")
    found = pin_forces(motion, [Weight("P", 1.0)])
    assert np.isnan(found.drives["phi"]).tolist() == [True, False]
    assert np.isnan(found.force("B")[0]).tolist() == [True, False]
    assert found.residual < 1e-13


def test_poses_out_of_reach_are_nan():
    motion = Hitch().at(S=[0.1, 5.0], unreachable="nan")
    assert np.isnan(driving_force(motion)).tolist() == [False, True]
    assert np.isnan(pin_forces(motion).drives["S"]).tolist() == [False, True]
    nowhere = Hitch().at(S=[5.0, 6.0], unreachable="nan")
    assert np.isnan(pin_forces(nowhere).drives["S"]).all()
    with pytest.raises(DefinitionError, match="no pose is reached"):
        max_table(pin_forces(nowhere))


def test_next_to_a_dead_point_it_warns():
    near = Parallelogram().at(phi=5e-5)
    with pytest.warns(SingularWarning):
        pin_forces(near, [Weight("P", 1.0)])
    with pytest.warns(SingularWarning):
        driving_force(near, [Weight("P", 1.0)])


def test_a_support_that_does_not_feel_the_drive_is_refused():
    class Level(Mechanism):
        S = Stroke(0.1, 0.2)
        rail = Guide((0.0, 0.0), angle=0.0)
        A = OnGuide(rail, at=S)
        shoe = Support(A, (0, 1))

    with pytest.raises(SingularError, match="does not move along its direction"):
        reaction(Level().sweep(3))
    assert_allclose(reaction(Level().sweep(3), support=Support("A", (-1, 0)), drive_force=70.0), 70.0, rtol=1e-14)


@for_all(
    ("make", "word"),
    [
        (lambda: pin_forces(Hitch().sweep(3)).force("Z"), "Joint 'Z' is unknown"),
        (lambda: pin_forces(Hitch().sweep(3)).force("B", on="CD"), "Body 'CD' is unknown"),
        (lambda: pin_forces(Hitch().sweep(3)).on_body("XY"), "Body 'XY' is unknown"),
        (lambda: pin_forces(Crane().sweep(S1=2, S2=2)).force("O"), "say on="),
        (lambda: driving_force(Crane().sweep(S1=2, S2=2)), "say drive="),
    ],
)
def test_what_is_not_there_is_named(make, word):
    with pytest.raises(DefinitionError, match=word):
        make()


def test_it_prints_forces_with_units_and_the_residual():
    forces = pin_forces(Hitch().sweep(5))
    text, short = str(forces), repr(forces)
    greatest = max(float(each.size.max()) for each in forces.joints) / 1e3
    assert len(short) < 200 and f"{greatest:.4g} kN" in short and f"{len(forces.joints)} joints at 5 poses" in short
    assert "S: 36098.8 to 43054.8 N" in text
    assert "A (pin) on lift from frame: 36.0988 to 43.0548 kN" in text
    assert "residual of equilibrium" in text and "against virtual work" in text
    assert "Nm" in str(pin_forces(FourBar().sweep(5), [Moment("C B", M=5.0)]))


def test_an_output_may_be_the_angle_of_a_moment():
    motion = FourBar().sweep(9)
    torque = driving_force(motion, [Moment("C B", M=5.0)])
    assert_allclose(torque, -5.0 * motion.ratio(angle("C", "B")), rtol=1e-12)
