"""Force elements: what they put on a mechanism, what they refuse, and how they are set."""

from dataclasses import dataclass
from functools import partial
from math import cos, hypot, pi, sin
from typing import ClassVar

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    RIGHT,
    Between,
    DefinitionError,
    Dimension,
    Dyad,
    Force,
    ForceElement,
    Ground,
    GuideFriction,
    Link,
    LinkMass,
    Load,
    LoadCase,
    Mechanism,
    Moment,
    OnLink,
    PinFriction,
    SingularError,
    Spring,
    Stroke,
    Support,
    Weight,
    angle,
    deg,
    drive_force,
    driving_force,
    pin_force,
    pin_forces,
    reaction,
    ref,
)
from linkage.loads import couple
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all

G0 = 9.80665


class Lift(Mechanism):
    """A lever OB with a load at G, lifted by the cylinder AB."""

    S = Stroke(0.55, 0.80)
    m1 = Dimension(120.0)
    A, O = Ground(0.0, 0.242), Ground(0.652, 0.330)
    B = Dyad(A, O, AB=S, OB=0.175, side=RIGHT)
    G = OnLink(O, B, OG=1.1, BOG=100 * deg)
    arm = Link(O, B, G)
    load = Weight(G, mass=900)


def variant(**members):
    """Return a machine with more members."""
    return type("Variant", (Lift,), members)


def at(machine, S=0.6, **dimensions):
    """Return the machine at one stroke."""
    return machine(**dimensions).at(S=S)


def loads_of(element, motion=None):
    """Return an element's loads over one pose, by point."""
    return {load.point: np.asarray(load.force) for load in element.loads(motion or at(Lift))}


def test_a_weight_is_mass_times_gravity_downwards():
    assert_allclose(loads_of(Weight("G", mass=900))["G"], [0.0, -900 * G0], rtol=1e-15)


def test_a_mass_is_a_design_variable_by_its_members_name():
    lighter = Lift(**{"load.mass": 450})
    assert lighter["load.mass"] == 450
    assert_allclose(driving_force(lighter.at(S=0.6)), driving_force(Lift().at(S=0.6)) / 2, rtol=1e-14)


def test_masses_may_be_a_batch_of_designs():
    motion = Lift(**{"load.mass": [100.0, 200.0, 400.0]}).sweep(5)
    force = driving_force(motion)
    assert force.shape == (3, 5)
    assert_allclose(force[2], 4 * force[0], rtol=1e-14)


def test_a_mass_may_follow_a_dimension():
    machine = variant(load=Weight("G", mass=2.0 * Lift.m1))
    named = variant(load=Weight("G", mass=ref("m1")))
    assert "load.mass" not in machine.plan.table.entries
    assert_allclose(driving_force(at(machine, m1=50.0)), driving_force(at(named, m1=100.0)), rtol=1e-14)


def test_a_subclass_replaces_a_load_by_name():
    assert_allclose(driving_force(at(variant(load=Weight("G", mass=90)))), driving_force(at(Lift)) / 10, rtol=1e-14)


def test_loads_may_be_given_by_name_and_by_hand():
    motion = at(variant(more=Weight("B", mass=20)))
    assert_allclose(driving_force(motion), driving_force(motion, ["load"]) + driving_force(motion, [Weight("B", mass=20)]), rtol=1e-13)
    assert driving_force(motion, []) == 0.0


def test_another_machines_load_keeps_its_own_mass():
    other = variant(load=Weight("G", mass=10))
    assert_allclose(driving_force(at(other), [Lift.load]), driving_force(at(Lift)), rtol=1e-14)


def test_anything_with_loads_is_a_force_element():
    class Pull:
        def loads(self, motion):
            return [Load("G", np.array([0.0, -900 * G0]))]

    assert_allclose(driving_force(at(Lift), [Pull()]), driving_force(at(Lift)), rtol=1e-15)


def test_a_spring_pulls_its_ends_together_in_proportion():
    motion = at(Lift)
    spring = Spring("A", "G", stiffness=2000.0, free_length=0.5)
    AG = motion["G"] - motion["A"]
    force = loads_of(spring, motion)
    assert_allclose(force["A"], 2000.0 * (hypot(*AG) - 0.5) * AG / hypot(*AG), rtol=1e-14)
    assert_allclose(force["G"], -force["A"], rtol=1e-15)


def test_a_spring_of_no_free_length_needs_no_direction():
    assert_allclose(loads_of(Spring("A", "A", 1e3, 0.0))["A"], 0.0, atol=0)
    with pytest.raises(DefinitionError, match="coincide"):
        loads_of(Spring("A", "A", 1e3, 0.1))


def test_a_moment_is_a_pure_couple():
    motion = at(Lift)
    loads = Moment("O B", M=250.0).loads(motion)
    assert_allclose(sum(load.force for load in loads), [0.0, 0.0], atol=1e-12)
    turning = sum(motion[load.point][0] * load.force[1] - motion[load.point][1] * load.force[0] for load in loads)
    assert_allclose(turning, 250.0, rtol=1e-13)


@for_all("link", [Lift.arm, "arm", "O B", ("O", "B"), (Lift.O, "B", "G")])
def test_a_moment_takes_a_link_its_name_or_points(link):
    motion = at(Lift)
    assert_allclose(driving_force(motion, [Moment(link, M=100.0)]), -100.0 * motion.ratio(angle("O", "B")), rtol=1e-12)


def test_a_body_weighs_at_its_centre():
    motion = at(Lift)
    middle = LinkMass("O G", mass=30.0)
    along = LinkMass("O G", mass=30.0, at=(0.55, 0.0))
    there = variant(M=OnLink("O", "B", OM=0.55, BOM=100 * deg))
    expected = driving_force(at(there), [Weight("M", mass=30.0)])
    assert_allclose([driving_force(motion, [middle]), driving_force(motion, [along])], expected, rtol=1e-13)


def test_a_bodys_centre_may_lie_beside_its_axis():
    off = variant(M=OnLink("O", "B", OM=hypot(0.1, 0.07), BOM=np.arctan2(0.07, 0.1)))
    expected = driving_force(at(off), [Weight("M", mass=30.0)])
    assert_allclose(driving_force(at(off), [LinkMass("O B", mass=30.0, at=(0.1, 0.07))]), expected, rtol=1e-12)


def test_a_bodys_mass_is_a_design_variable_too():
    machine = variant(load=LinkMass("arm", mass=30))
    assert_allclose(driving_force(at(machine, **{"load.mass": 60})), 2 * driving_force(at(machine)), rtol=1e-14)


def test_a_support_has_the_force_it_is_given():
    assert_allclose(loads_of(Support("G", (3.0, 4.0), force=50.0))["G"], [30.0, 40.0], rtol=1e-15)
    assert_allclose(loads_of(Support("G", (0, 1)))["G"], 0.0, atol=0)


def test_a_force_is_set_as_a_pair():
    machine = variant(pull=Force("G", (100.0, -50.0)))
    assert_allclose(machine(pull=(7.0, 8.0))["pull"], [7.0, 8.0])
    assert_allclose(loads_of(machine.pull, at(machine, **{"pull.x": 7.0}))["G"], [7.0, -50.0])


# -- load cases --------------------------------------------------------------------------------------------


class Cases(Lift):
    """A lift with named load cases."""

    own = LinkMass("O B", mass=25)
    empty = LoadCase("empty", scale={"load": 0.0})
    bare = LoadCase(only=["own"])
    transport = LoadCase("transport with shock", scale={"load": 2.0})
    slope = LoadCase(slope=10 * deg)


def test_cases_choose_and_scale():
    motion = at(Cases)
    load, own = driving_force(motion, ["load"]), driving_force(motion, ["own"])
    shock = 2 * load + own
    for case, expected in [("empty", own), ("bare", own), ("transport", shock), ("transport with shock", shock), (None, load + own)]:
        assert_allclose(driving_force(motion, case=case), expected, rtol=1e-13)


def test_a_slope_turns_gravity():
    motion, weight = at(Cases), 900 * G0
    expected = driving_force(motion, [Force("G", (-weight * sin(10 * deg), -weight * cos(10 * deg)))])
    assert_allclose(driving_force(motion, ["load"], case="slope"), expected, rtol=1e-13)


def test_gravity_of_another_place():
    moon = LoadCase("moon", gravity=(0, -1.62))
    assert_allclose(driving_force(at(Cases), case=moon), driving_force(at(Cases)) * 1.62 / G0, rtol=1e-13)


def test_each_end_of_a_bar_that_stretches_bears_its_half():
    class Telescope(Lift):
        """A boom whose tip goes out."""

        t = Stroke(0.0, 1.0)
        T = OnLink("O", "B", OT=1.8 + ref("t"), BOT=100 * deg)
        tube = LinkMass("O T", mass=90)

    machine = Telescope()
    found, halves = (machine.at(S=0.6, t=0.4)[pin_force("B", "AB")], [Weight("G", mass=900), Weight("T", mass=45), Weight("O", mass=45)])
    assert_allclose(found, machine.at(S=0.6, t=0.4)[pin_force("B", "AB", loads=halves)], rtol=1e-12)
    assert pin_forces(machine.at(S=0.6, t=0.4)).gap < 1e-12


class Centrifuge(Lift):
    """Every mass has a gravity of its own."""

    load = Weight("G", mass=900, gravity=(3.0, -2.0))
    own = LinkMass("O B", mass=25, at=(0.2, 0.03), gravity=(0.0, 5.0))
    plain = LinkMass("O B", mass=40)
    hill = LoadCase(slope=10 * deg)
    there = LoadCase(gravity=(1.0, -4.0))
    both = LoadCase(gravity=(1.0, -4.0), slope=-20 * deg, scale={"own": 2.0})


STROKES = np.array([0.56, 0.65, 0.79])
GRAVITIES = {
    # case: gravity of load, own and plain [m/s2], worked out by hand: a slope turns clockwise
    None: [(3.0, -2.0), (0.0, 5.0), (0.0, -G0)],
    "hill": [(3 * cos(10 * deg) - 2 * sin(10 * deg), -2 * cos(10 * deg) - 3 * sin(10 * deg)),
             (5 * sin(10 * deg), 5 * cos(10 * deg)), (-G0 * sin(10 * deg), -G0 * cos(10 * deg))],
    "there": [(1.0, -4.0)] * 3,
    "both": [(cos(20 * deg) + 4 * sin(20 * deg), -4 * cos(20 * deg) + sin(20 * deg))] * 3,
}  # fmt: skip


@dataclass
class ByHand:
    """The weights of Centrifuge as plain forces: at G, at own's centre, and half of plain at O and B."""

    case: str | None

    def loads(self, motion):
        return weights_by_hand(motion, self.case)


def weights_by_hand(motion, case):
    """Return the weights of Centrifuge as forces."""
    g = [np.array(each) for each in GRAVITIES[case]]
    B, O = motion["B"], motion["O"]
    along = (B - O) / np.hypot(*(B - O))
    arm = 0.2 * along + 0.03 * np.array([-along[1], along[0]])
    mass = 50 if case == "both" else 25
    moment = mass * (arm[0] * g[1][1] - arm[1] * g[1][0])
    weights = [Load("G", 900 * g[0]), Load("O", mass * g[1], ("O", "B")), *(Load(end, 20 * g[2], ("O", "B")) for end in "OB")]
    return [*weights, *couple("O", "B", B - O, moment)]


@pytest.mark.parametrize("case", GRAVITIES)
def test_an_elements_own_gravity_acts_and_a_case_replaces_or_turns_it(case):
    motion = at(Centrifuge, STROKES)
    expected = driving_force(motion, [ByHand(case)])
    assert_allclose(driving_force(motion, case=case), expected, rtol=1e-13)
    assert_allclose(Centrifuge().evaluate([drive_force(case=case)], S=STROKES)[0], expected, rtol=1e-12)
    by_hand = pin_forces(motion, [ByHand(case)]).force("O", on="frame")
    assert_allclose(pin_forces(motion, case=case).force("O", on="frame"), by_hand, rtol=1e-11)
    along_x = Centrifuge().evaluate([pin_force("O", on="frame", component="x", case=case)], S=STROKES)[0]
    assert_allclose(along_x, by_hand[0], rtol=1e-10)


def test_an_own_gravity_keeps_batches_and_gradients():
    masses = np.array([100.0, 900.0])
    batch = Centrifuge(**{"load.mass": masses}).sweep(5)
    for row, mass in enumerate(masses):
        alone = driving_force(Centrifuge(**{"load.mass": mass}).sweep(5), case="both")
        assert_allclose(driving_force(batch, case="both")[row], alone, rtol=1e-13)
    slope = at(Centrifuge).gradient(drive_force(case="both"), wrt=["load.mass"])[0]
    less, more = (driving_force(at(Centrifuge, **{"load.mass": mass}), case="both") for mass in (899.0, 901.0))
    assert_allclose(slope, (more - less) / 2.0, rtol=1e-9)


def test_gravity_prints_as_it_is_written():
    load, case = Centrifuge.plan.members["load"], Centrifuge.plan.members["both"]
    assert str(load) == "Weight(G, mass=900, gravity=(3.0, -2.0))"
    assert str(case) == f"LoadCase(scale={{'own': 2.0}}, slope={'-20 * deg'}, gravity=(1.0, -4.0))"
    assert str(Weight("G", mass=1, gravity=np.array([0.0, -1.62]))) == "Weight(G, mass=1, gravity=(0.0, -1.62))"


@for_all("make", [
    partial(Weight, "G", mass=1), partial(LinkMass, "O B", mass=1), partial(LoadCase, "case"),
])  # fmt: skip
@for_all(("gravity", "words"), [
    (1.62, r"gravity=1\.62 has no direction; write the vector gravity=\(0, -1\.62\)"),
    (-9.81, r"write the vector gravity=\(0, -9\.81\)"),
    ((0.0, np.nan), r"is not two finite numbers; write \(x, y\) in m/s2, such as \(0, -9\.81\)"),
    (("0", -1), "is not two finite numbers"),
    ((0, 0, -9.81), "is not a vector"),
    ("down", "is not a vector|is not two"),
])  # fmt: skip
def test_gravity_that_is_no_vector(make, gravity, words):
    with pytest.raises(DefinitionError, match=words):
        make(gravity=gravity)


def test_a_slope_in_degrees_is_asked_about():
    with pytest.raises(DefinitionError, match=r"slope=8 rad is 458\.4 deg, steeper than a wall; write slope=8 \* deg"):
        LoadCase(slope=8)


def test_given_elements_can_be_scaled_by_their_own_words():
    pull = Weight("G", mass=5)
    assert_allclose(driving_force(at(Lift), [pull], case=LoadCase(scale={str(pull): 3.0})), 3 * driving_force(at(Lift), [pull]), rtol=1e-14)


# -- a user's own element ----------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Rubbing(ForceElement):
    """A cylinder seal: a force along A -> B against the motion."""

    A: str
    B: str
    seal: float
    places = ("A", "B")
    parameters: ClassVar = {"seal": "N"}

    def loads(self, motion):
        return []

    def moving(self, motion, rates):
        along = self.position(motion, "B") - self.position(motion, "A")
        push = -np.sign(rates["S"]) * self.number(motion, "seal") * along / np.hypot(*along)
        return [Load(self.B, push), Load(self.A, -push)]


def test_an_element_may_rub():
    machine = variant(seal=Rubbing("A", "B", seal=500.0))
    motion = machine(**{"seal.seal": 300.0}).sweep(5)
    free = driving_force(motion)
    assert_allclose(driving_force(motion, direction="extending"), free + 300.0, rtol=1e-12)
    assert_allclose(driving_force(motion, direction="retracting"), free - 300.0, rtol=1e-12)
    assert_allclose(pin_forces(motion, direction="extending").drives["S"], free + 300.0, rtol=1e-12)


# -- bad input ---------------------------------------------------------------------------------------------


@for_all(
    ("make", "word"),
    [
        (lambda: Weight("G", mass=-1), "negative"),
        (lambda: Weight("G", mass=float("nan")), "finite"),
        (lambda: Weight("G", mass=None), "not a number"),
        (lambda: Weight("G", mass=True), "not a number"),
        (lambda: Spring("A", "G", -5.0, 0.3), "negative"),
        (lambda: Spring("A", "G", 5.0, float("inf")), "finite"),
        (lambda: Force("G", 5.0), "not a vector"),
        (lambda: Force("G", (1.0, float("nan"))), "finite"),
        (lambda: Support("G", (0.0, 0.0)), "direction"),
        (lambda: Support("G", (float("nan"), 1.0)), "direction"),
        (lambda: LinkMass("O B", 5.0, at=(1.0,)), "not a vector"),
        (lambda: LinkMass("O B", 5.0, at=(1.0, float("nan"))), "not a place"),
        (lambda: PinFriction("O", -0.01, 0.1), "negative"),
        (lambda: GuideFriction("O", -0.1), "negative"),
        (lambda: LoadCase(scale={"load": float("nan")}), "finite"),
        (lambda: LoadCase(slope="steep"), "finite"),
        (lambda: LoadCase(only="load"), "list"),
        (lambda: variant(w=Weight("S", mass=1)), "not a point"),
        (lambda: variant(w=Weight("H", mass=1)), "unknown"),
        (lambda: variant(w=Weight("G", mass=[1.0, 2.0])), "expected"),
        (lambda: variant(w=Moment("G", 5.0)), "not a body"),
        (lambda: variant(w=Moment("nothing", 5.0)), "unknown"),
        (lambda: variant(case=LoadCase(scale={"lod": 2.0})), "load"),
        (lambda: variant(case=LoadCase(scale={"G": 2.0})), "Load 'G' is unknown"),
        (lambda: Lift(**{"load.mass": -3.0}), "negative"),
        (lambda: driving_force(at(variant(load=Weight("G", mass=ref("m1"))), m1=-5.0)), "load: mass = m1 is negative, -5;"),
        (lambda: pin_forces(at(variant(load=Weight("G", mass=ref("m1"))), m1=[5.0, -5.0])), "load: mass = m1 is negative, -5;"),
        (lambda: variant(load=Weight("G", mass=ref("m1")))(m1=-5.0).evaluate([drive_force()], S=0.6), "load: mass = m1 is negative, -5;"),
        (lambda: Lift(**{"load.weight": 3.0}), r"load\.mass"),
        (lambda: driving_force(at(Lift), ["lod"]), "Did you mean load"),
        (lambda: driving_force(at(Lift), case="full"), "Load case"),
        (lambda: driving_force(at(Lift), [5.0]), "not a force element"),
        (lambda: driving_force(at(Lift), [Weight]), "not a force element"),
        (lambda: driving_force(at(Lift), [Weight("Z", 5.0)]), "Z"),
        (lambda: driving_force(at(Lift), [Weight("G", np.ones(7))], "S"), "does not fit"),
        (lambda: driving_force(at(Lift), "load", "T"), "Stroke 'T' is unknown"),
        (lambda: driving_force(at(Lift), direction="up"), "extending"),
        (lambda: driving_force(at(Lift), efficiency=0.85), "direction"),
        (lambda: driving_force(at(Lift), direction="extending", efficiency=1.2), "efficiency"),
        (lambda: pin_forces(at(Lift), split="equal"), "least squares"),
        (lambda: pin_forces(at(Lift), [PinFriction("G", 0.01, 0.1)], direction="extending"), "no pin joint"),
        (lambda: pin_forces(at(Lift), [GuideFriction("B", 0.1)], direction="extending"), "nothing that slides"),
        (lambda: reaction(at(Lift)), "0 supports"),
        (lambda: reaction(at(Lift), support=Support("G", (0, 1)), drive_force=[1.0, 2.0]), "fits the poses"),
        (lambda: reaction(at(Lift), support=Support("G", (0, 1)), drive_force="much"), "fits the poses"),
    ],
)
def test_bad_input_is_refused_in_words(make, word):
    with pytest.raises(DefinitionError, match=word):
        make()


class Broken(ForceElement):
    """An element that gives no number."""

    places = ()

    def loads(self, motion):
        return [Load("G", np.full(2, np.nan))]


def test_an_element_without_a_finite_force_is_refused():
    with pytest.raises(SingularError, match="no finite force at G"):
        driving_force(at(Lift), [Broken()])


@pytest.mark.parametrize(
    ("force", "word"), [(np.ones((3, 1)), r"the shape \(3, 1\)"), ((1j, 2.0), "complex128"), (("0", "5"), "no real numbers")]
)
def test_a_force_that_is_none_is_refused_with_what_it_is(force, word):
    class Odd(ForceElement):
        places = ()

        def loads(self, motion):
            return [Load("G", force)]

    with pytest.raises(DefinitionError, match=word):
        driving_force(at(Lift), [Odd()])


def test_what_is_right_is_not_told_in_words():
    """A law, or a load, may be long in words, and a law may have none."""

    class Untold:
        def __call__(self, length, rate):
            return -length

        def __repr__(self):
            pytest.fail("nothing is wrong")

    class Silent(Weight):
        __repr__ = Untold.__repr__

    assert callable(Between("A", "B", Untold()).law)
    assert len(LoadCase(only=[Silent("B", mass=1.0)]).only) == 1


def test_every_load_is_listed_once():
    with pytest.raises(DefinitionError, match=r"Known: load\."):
        driving_force(at(Lift), case=LoadCase(scale={"lod": 2.0}))


def test_members_print_as_they_are_written():
    words = {
        Weight("G", mass=900): "Weight(G, mass=900)",
        Force("G", (1.0, -2.0)): "Force(G, (1.0, -2.0))",
        Spring("A", "G", 2e3, 0.5): "Spring(A, G, stiffness=2000.0, free_length=0.5)",
        Support("G", (0, 1)): "Support(G, (0, 1), force=0.0)",
        Moment("O B", M=5.0): "Moment('O B', M=5.0)",
        LoadCase("t", scale={"load": 2.0}, slope=pi / 18): "LoadCase('t', scale={'load': 2.0}, slope=10 * deg)",
    }
    assert [str(element) for element in words] == list(words.values())


@pytest.mark.parametrize("element", [LinkMass("B D", mass=10), Moment("B D", M=10), LinkMass("O C D", mass=10)])
def test_points_of_different_bodies_are_no_body(element):
    motion = ThreePointHitch().at(S=0.1)
    with pytest.raises(DefinitionError, match="are not points of one body"):
        driving_force(motion, [element])
    with pytest.raises(DefinitionError, match="are not points of one body"):
        motion.gradient(drive_force(loads=[element]), wrt=["OB"])


def test_a_spring_from_a_point_to_itself_is_refused():
    with pytest.raises(DefinitionError, match=r"tie = Spring.* begins and ends at G; name two different points"):

        class Tied(ThreePointHitch):
            tie = Spring("G", "G", stiffness=1e3, free_length=0.1)
