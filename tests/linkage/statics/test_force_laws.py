"""Laws of one's own, traced: thrusts and pin forces of any plain arithmetic, and refusals by name of what is none."""

from dataclasses import dataclass

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from linkage import (
    DefinitionError,
    Force,
    ForceElement,
    LinkMass,
    Load,
    SingularError,
    Spring,
    Weight,
    deg,
    drive_force,
    driving_force,
    pin_force,
)
from linkage.loads import couple
from linkage.motion import each_at_its_stroke
from mechanisms.classics.four_bar import DragLink
from mechanisms.three_point_hitch import ThreePointHitch

STROKE = np.linspace(0.0, 0.25, 41)


class Hitch(ThreePointHitch):
    """The hitch with loads of its own."""

    load = Weight("G", mass=1200.0)
    lower = LinkMass("E D F", mass=30.0)


@dataclass(frozen=True, eq=False)
class TorsionSpring(ForceElement):
    """Turns the body of P and Q back to an angle [rad] with a stiffness [Nm/rad]."""

    P: str
    Q: str
    stiffness: float
    free: float = 0.0
    places = ("P", "Q")
    parameters = {"stiffness": "", "free": "deg"}  # noqa: RUF012

    def loads(self, motion):
        turned = motion.angle(self.P, self.Q) - self.number(motion, "free")
        arm = self.position(motion, "Q") - self.position(motion, "P")
        return couple(self.P, self.Q, arm, -self.number(motion, "stiffness") * turned)


class Wound(DragLink):
    """A crank on a torsion spring that is wound up over several turns."""

    spring = TorsionSpring("O", "A", stiffness=100.0, free=20 * deg)
    load = Weight("B", mass=10.0)


def test_angles_go_on_past_half_a_turn():
    phi = np.linspace(0.0, 12.0, 60)
    motion, wrt = Wound().at(phi=phi), ["spring.stiffness", "spring.free", "OA"]
    force = driving_force(motion)
    assert np.ptp(force) > 1000.0
    assert_allclose(Wound().evaluate([drive_force()], phi=phi)[0], force, rtol=1e-12)
    by_stiffness, by_free, by_crank = motion.gradient(drive_force(), wrt)
    assert_allclose(by_stiffness, phi - 20 * deg, rtol=1e-12)
    assert_allclose(by_free, np.full(60, -100.0), rtol=1e-12)
    step = 1e-6
    wide = [driving_force(Wound(OA=Wound()["OA"] + k * step).at(phi=phi)) for k in (1, -1)]
    assert_allclose(by_crank, (wide[0] - wide[1]) / (2 * step), atol=1e-5)


def test_angles_of_paired_poses_are_near_those_of_the_other_motion():
    base = Wound().at(phi=np.linspace(0.0, 12.0, 60))
    near = each_at_its_stroke(Wound.plan, Wound().dimensions, {"phi": base.strokes["phi"][[5, 40, 59]]}, base, np.array([5, 40, 59]))
    (found,), (wanted,) = (motion.gradient(drive_force(), ["spring.stiffness"]) for motion in (near, base))
    assert_allclose(found, wanted[[5, 40, 59]], rtol=1e-12)


class Law:
    """Any law at G, not a member of anything."""

    def __init__(self, law):
        self.law = law

    def loads(self, motion):
        return [Load("G", self.law(motion))]

    def __str__(self):
        return "buffer"


GOOD = {
    "buffer": lambda motion: np.stack([0.0 * motion.y("G"), np.where(motion.y("G") < 0.8, 4e4 * (0.8 - motion.y("G")), 0.0)]),
    "drag": lambda motion: -30.0 * motion.ratio("G", wrt="S") * motion.distance("A", "B"),
    "input": lambda motion: motion["G"] * motion.inputs["S"] * motion.inputs["OB"],
    "checked": lambda motion: checked(motion, 0.1),
}


def checked(motion, least):
    """Return a pull from A to G, refused where they are nearer than so much."""
    pull = motion["A"] - motion["G"]
    if np.any(np.hypot(*pull) < least):
        raise DefinitionError("A and G come too near.")
    return 100.0 * pull


@pytest.mark.parametrize("law", GOOD.values(), ids=GOOD)
def test_laws_of_ones_own(law):
    motion, loads = Hitch().at(S=STROKE), [Law(law)]
    assert_allclose(Hitch().evaluate([drive_force(loads=loads)], S=STROKE)[0], driving_force(motion, loads), rtol=1e-12, atol=1e-9)
    slope, step = motion.gradient(drive_force(loads=loads), ["CD"])[0], 1e-6
    wide = [driving_force(Hitch(CD=0.62 + k * step).at(S=STROKE), loads) for k in (1, -1)]
    assert_allclose(slope, (wide[0] - wide[1]) / (2 * step), rtol=1e-6, atol=1e-6 * np.abs(slope).max())


def test_a_law_that_changes_is_asked_again():
    law = Law(lambda motion: motion["G"])
    first = Hitch().evaluate([drive_force(loads=[law])], S=STROKE)[0]
    law.law = lambda motion: 2.0 * motion["G"]
    assert_allclose(Hitch().evaluate([drive_force(loads=[law])], S=STROKE)[0], 2.0 * first, rtol=1e-14)


BAD = {
    "a branch": lambda motion: motion["G"] if np.max(motion.y("G")) > 0.5 else -motion["G"],
    "over poses": lambda motion: np.stack([motion.x("G") - np.min(motion.x("G")), motion.y("G")]),
    "numbers by pose": lambda motion: np.ones((2, 41)),
    "into an array of floats": lambda motion: filled(np.zeros((2, *motion.shape)), motion.y("G")),
}


def filled(force, value):
    """Return a force with its part along y set."""
    force[1] = value
    return force


@pytest.mark.parametrize("law", BAD.values(), ids=BAD)
def test_a_law_that_cannot_be_traced_is_refused_by_name(law):
    motion = Hitch().at(S=STROKE)
    assert np.isfinite(driving_force(motion, [Law(law)])).all()
    for asked in (drive_force(loads=[Law(law)]), pin_force("C", "CD", loads=[Law(law)])):
        with pytest.raises(DefinitionError, match=r"the law of buffer cannot be traced: .* finite differences"):
            motion.gradient(asked, ["OB"])
        with pytest.raises(DefinitionError, match="the law of buffer cannot be traced"):
            Hitch().evaluate([asked], S=STROKE)


@pytest.mark.parametrize("unreachable", ["raise", "nan"])
def test_what_a_law_refuses_is_refused_in_its_words(unreachable):
    near = float(np.hypot(*(Hitch().at(S=STROKE)["A"] - Hitch().at(S=STROKE)["G"])).max())
    loads = [Law(lambda motion: checked(motion, near))]
    for asked in (drive_force(loads=loads), pin_force("C", "CD", loads=loads)):
        with pytest.raises(DefinitionError, match="A and G come too near"):
            Hitch().evaluate([asked], S=STROKE, unreachable=unreachable)
        with pytest.raises(DefinitionError, match="A and G come too near"):
            Hitch().at(S=STROKE, unreachable=unreachable).gradient(asked, ["OB"])
    with pytest.raises(DefinitionError, match="A and G come too near"):
        Hitch().function([drive_force(loads=loads)])(0.1)


def test_a_law_that_takes_another_way_at_some_poses_is_refused_there():
    loads = [Law(lambda motion: motion["G"] * (2.0 if np.any(motion.y("G") > 0.9) else 1.0))]
    low = STROKE[Hitch().at(S=STROKE).y("G") < 0.9]
    assert 0 < low.size < 41
    assert_allclose(Hitch().evaluate([drive_force(loads=loads)], S=low)[0], driving_force(Hitch().at(S=low), loads), rtol=1e-12)
    with pytest.raises(DefinitionError, match="the law of buffer goes another way"):
        Hitch().evaluate([drive_force(loads=loads)], S=STROKE)
    with pytest.raises(DefinitionError, match="the law of buffer goes another way"):
        Hitch().at(S=STROKE).gradient(drive_force(loads=loads), ["OB"])


def test_where_a_law_is_another_at_one_number_there_is_no_slope_by_it():
    class Switched(ThreePointHitch):
        pull = Force("G", (0.0, -500.0))

    loads = [Law(lambda motion: np.stack([0.0, np.where(motion.inputs["pull.x"] == 0.0, 1.0, 2.0)]) * motion.inputs["OB"])]
    with pytest.raises(DefinitionError, match=r"no derivative by pull\.x: the law of buffer"):
        Switched().at(S=STROKE).gradient(drive_force(loads=loads), ["OB", "pull.x"])
    one, two = Switched().at(S=STROKE), Switched(pull=(1.0, -500.0)).at(S=STROKE)
    assert_allclose(2.0 * one.gradient(drive_force(loads=loads), ["OB"]), two.gradient(drive_force(loads=loads), ["OB"]), rtol=1e-12)
    assert_array_equal(two.gradient(drive_force(loads=loads), ["pull.x"]), np.zeros((1, 41)))


def test_a_springs_ends_that_coincide_are_told_as_ever():
    class Closing(ThreePointHitch):
        spring = Spring("E", "O", stiffness=1e3, free_length=0.1)

    shut = Closing(E=(0.30, 1.15), ED=0.25, CD=0.30)
    pose = shut.at(S=0.1)
    for ask in (lambda: driving_force(pose), lambda: shut.evaluate([drive_force()], S=0.1), lambda: pose.gradient(drive_force(), ["OB"])):
        with pytest.raises(DefinitionError, match=r"spring.*ends coincide"):
            ask()


def test_a_law_without_a_finite_value_is_refused_as_ever():
    loads = [Law(lambda motion: motion["G"] * np.sqrt(0.9 - motion.y("G")))]
    with np.errstate(invalid="ignore"):
        for ask in (
            lambda: driving_force(Hitch().at(S=STROKE), loads),
            lambda: Hitch().evaluate([drive_force(loads=loads)], S=STROKE),
            lambda: Hitch().function([drive_force(loads=loads)])(0.25),
        ):
            with pytest.raises(SingularError, match="buffer gives no finite force"):
                ask()
        with pytest.raises(SingularError, match="gradient of the driving force of S has no finite value"):
            Hitch().at(S=STROKE).gradient(drive_force(loads=loads), ["OB"])
        (found,) = Hitch().evaluate([drive_force(loads=loads)], S=STROKE, unreachable="nan")
        assert_array_equal(np.isnan(found), np.isnan(driving_force(Hitch().at(S=STROKE, unreachable="nan"), loads)))
        assert 0 < np.isnan(found).sum() < 41
