"""The vector method's spelling, without links, is the same machine as the composite one: bodies, joints, forces, drawing, files."""

from itertools import combinations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder
from linkage import (
    RIGHT,
    AssemblyError,
    CosineAngle,
    Crank,
    Curve,
    DefinitionError,
    Dimension,
    Dyad,
    Force,
    Ground,
    Guide,
    Link,
    LinkageError,
    Mechanism,
    Offset,
    OnLink,
    Slide,
    Stroke,
    Turn,
    Vector,
    Weight,
    deg,
    distance,
    driving_force,
    equations,
    pin_forces,
)
from linkage.files import load, to_json, to_toml
from linkage.pictures.scene import Scene
from linkage.quantities import Member
from tests.for_all import for_all
from tests.machines.random_vectors import machines
from tests.machines.vector_pairs import PAIRS, PAPERS

ALL = PAPERS | PAIRS
FEW = (
    *PAPERS,
    "a crank as long as the vector that is turned",
    "a Watt six-bar: a second dyad on the coupled rocker",
    "a boom and an arm, each on its cylinder",
    "a boom on a cylinder with a telescope in it",
    "a crosshead that a stroke pushes along a line of the frame, and a rocker on it",
    "a plate whose points are turned from turned vectors, and from the far end back",
    "a lever with a spring on it",
    "a cylinder that shortens as its stroke grows, over a bell crank",
)
"""The papers' machines, and pairs with every kind of member that any of them has."""
both = for_all("which", FEW, slow=[which for which in ALL if which not in FEW])


def test_every_kind_of_member_is_looked_at_daily():
    assert kinds_of(FEW) == kinds_of(ALL)


def kinds_of(names):
    """Return the kinds of members in some machines of both spellings."""
    return {type(member) for which in names for machine in ALL[which] for member in machine.plan.members.values()}


def motion(cls, count=5):
    """Return a motion inside the strokes, along all of them together."""
    return cls().at(**{name: np.linspace(0.1, 0.9, count) * (s.end - s.start) + s.start for name, s in cls.plan.strokes.items()})


def bodies(cls):
    return {frozenset(body.points) for body in cls().links}


def joints(found):
    """Return every joint of pin forces by where and between what it is, with its force."""
    points = {body.name: frozenset(body.points) for body in found._structure.bodies}
    sides = [(each, *side) for each in found.joints for side in ((each.on, each.by, each.force), (each.by, each.on, -each.force))]
    return {(each.kind, each.point, points.get(on, on), points.get(by, by)): force for each, on, by, force in sides}


def same_forces(one, other):
    mine, theirs = joints(one), joints(other)
    largest = max(np.abs(force).max() for force in theirs.values())
    assert set(mine) == set(theirs)
    for each, force in theirs.items():
        assert_allclose(mine[each], force, rtol=0, atol=1e-9 * largest)
    for name, drive in other.drives.items():
        assert_allclose(one.drives[name], drive, rtol=1e-9, atol=1e-9 * largest)
    assert set(one.thrusts) == set(other.thrusts)
    for name, thrust in other.thrusts.items():
        assert_allclose(one.thrusts[name], thrust, rtol=0, atol=1e-9 * largest)


def test_there_are_twenty_beside_the_papers():
    assert len(PAIRS) >= 20 and not any(cls.plan.of_kind(Link) for cls, _ in ALL.values())


@both
def test_mobility_and_bodies(which):
    vectors, steps = (cls() for cls in ALL[which])
    assert vectors.mobility == steps.mobility == len(steps.plan.strokes)
    assert vectors.gruebler == steps.gruebler
    assert bodies(type(vectors)) == bodies(type(steps))
    assert {(bar.P, bar.Q) for bar in vectors.plan.cylinders} == {(bar.P, bar.Q) for bar in steps.plan.cylinders}
    angles, others = ({name for name in each.plan.strokes if name in each.plan.turning} for each in (vectors, steps))
    assert angles == others


@both
def test_places_and_ratios(which):
    mine, theirs = (motion(cls) for cls in ALL[which])
    for name in theirs.plan.points:
        assert_allclose(mine[name], theirs[name], rtol=0, atol=1e-12)
        for stroke in theirs.plan.strokes:
            assert_allclose(mine.ratio(name, wrt=stroke), theirs.ratio(name, wrt=stroke), rtol=0, atol=1e-9)


@both
def test_joints_and_their_forces(which):
    one, other = (pin_forces(motion(cls)) for cls in ALL[which])
    same_forces(one, other)
    assert one.residual < 1e-9 and one.gap < 1e-9


@both
def test_the_drawing_has_the_same_rods_and_pins(which):
    one, other = (Scene(motion(cls)) for cls in ALL[which])
    assert set(map(frozenset, one.bodies)) == set(map(frozenset, other.bodies))
    assert {(each.P, each.Q) for each in one.two_force} == {(each.P, each.Q) for each in other.two_force}
    assert (set(one.pins), set(one.dots), set(one.grounds)) == (set(other.pins), set(other.dots), set(other.grounds))
    assert [each.on for each in one.sections] == [each.on for each in other.sections]
    assert one.stays == other.stays == ()


@pytest.mark.slow
@for_all("write", [to_toml], slow=[to_json])
@both
def test_a_file_goes_there_and_back(which, write):
    vectors, _ = ALL[which]
    text = write(vectors)
    back = load(text)
    assert write(back) == text
    assert back().mobility == vectors().mobility and bodies(back) == bodies(vectors)
    if which not in PAPERS:
        same_forces(pin_forces(motion(back)), pin_forces(motion(vectors)))


@both
def test_a_written_link_agrees(which):
    """Every body declared once more, as its points: nothing is redundant, nothing changes."""
    vectors, _ = ALL[which]
    own = {name: member.renewed() for name, member in vars(vectors).items() if isinstance(member, Member)}
    plain = [body for body in vectors.plan.links[1:] if not set(body.points) & set(vectors.plan.telescopes)]
    links = {f"body{k}": Link(*body.points) for k, body in enumerate(plain)}
    declared = type(vectors.__name__, (Mechanism,), own | links)
    assert str(declared.plan) != str(vectors.plan)
    found = declared().mobility
    assert found == vectors().mobility
    assert bodies(declared) == bodies(vectors)
    same_forces(pin_forces(motion(declared)), pin_forces(motion(vectors)))


@both
def test_driving_forces(which):
    one, other = (motion(cls) for cls in ALL[which])
    for stroke in other.plan.strokes:
        found = driving_force(other, drive=stroke)
        assert_allclose(driving_force(one, drive=stroke), found, rtol=1e-9, atol=1e-9 * np.abs(found).max())


# -- by other means: distances that are measured, and machines that are drawn by a seed ------------------------


def keeps_its_distances(cls, sweep):
    """Assert that the distances within every body are constant over a motion, some between points that move."""
    moving = 0
    for body in cls.plan.links:
        rigid = [name for name in body.points if name not in cls.plan.telescopes]
        root = [joint.point for _, joint in cls.plan.joints if joint.arm] if len(rigid) < len(body.points) else []
        for P, Q in combinations([name for name in rigid if name not in root], 2):
            lengths = np.hypot(*(sweep[P] - sweep[Q])) if np.ndim(sweep[P]) > 1 or np.ndim(sweep[Q]) > 1 else np.zeros(1)
            assert np.ptp(lengths) <= 1e-12, (body, P, Q)
            moving += lengths.size > 1
    assert moving


@both
def test_bodies_keep_their_distances(which):
    vectors, _ = ALL[which]
    keeps_its_distances(vectors, motion(vectors, 9))


OUT_OF_REACH = (4, 8, 11, 26, 28, 29, 38)
"""Seeds whose machines, in steps as well, cannot be assembled all over their strokes or pass a singular pose."""


DAILY = range(6)
"""Beyond them is one seed, 20, whose machine takes as long as all others together."""
DRAWN = [pytest.param(seed, marks=() if seed in DAILY else pytest.mark.slow) for seed in range(47) if seed not in OUT_OF_REACH]


@for_all("seed", DRAWN)
def test_machines_drawn_by_a_seed(seed):
    """Random cranks, corners and offsets, in random spellings: the same machine as in steps; equilibrium agrees with virtual work."""
    vectors, steps = machines(seed)
    other = pin_forces(motion(steps))
    assert vectors().mobility == steps().mobility == len(steps.plan.strokes)
    assert vectors().gruebler == steps().gruebler
    assert bodies(vectors) == bodies(steps)
    mine = motion(vectors)
    keeps_its_distances(vectors, mine)
    one = pin_forces(mine)
    same_forces(one, other)
    assert one.gap < 1e-8


# -- what is no body -----------------------------------------------------------------------------------------


class SideRod(Mechanism):
    """B runs parallel to A: by accident of the place of C, A and B keep their distance."""

    phi = Stroke(0.2, 1.2)
    O, C = Ground(0.0, 0.0), Ground(1.0, 0.0)
    A = Offset(O, Turn(Vector(O, C), phi, length=0.3))
    OA = Vector(O, A)
    B = Offset(C, OA)
    load = Weight(B, mass=10.0)


def test_points_that_keep_their_distance_by_accident_are_no_link():
    assert bodies(SideRod) == {frozenset("OC"), frozenset("OA"), frozenset("CB")}
    assert (SideRod().mobility, SideRod().gruebler) == (2, 2)
    with pytest.raises(LinkageError, match="CB is held by nothing"):
        pin_forces(SideRod().sweep(3))


def test_the_written_link_makes_it_one():
    class Coupled(SideRod):
        rod = Link("A", "B")

    found = Coupled().at(phi=[0.3, 0.6, 1.0])
    assert (Coupled().mobility, Coupled().gruebler) == (1, 1)
    assert_allclose(pin_forces(found).drives["phi"], 10 * 9.80665 * 0.3 * np.cos(found.strokes["phi"]), rtol=1e-12)


def test_one_vector_turns_one_body():
    """The same driven vector at another point runs parallel; a second vector of its own is a second drive."""

    class Parallel(Mechanism):
        phi = Stroke(0.2, 1.2)
        O, C = Ground(0.0, 0.0), Ground(1.0, 0.0)
        arm = Turn(Vector(O, C), phi, length=0.3)
        A, B = Offset(O, arm), Offset(C, arm)
        load = Weight(B, mass=10.0)

    class Geared(Parallel):
        B = Offset("C", Turn(Vector("O", "C"), "phi", length=0.3))

    assert (Parallel().mobility, Geared().mobility) == (2, 1)
    motion = Geared().at(phi=[0.3, 0.6, 1.0])
    assert_allclose(pin_forces(motion).drives["phi"], 10 * 9.80665 * 0.3 * np.cos(motion.strokes["phi"]), rtol=1e-12)


class Other(Mechanism):
    """The corner of the sides 0.5 + S and 0.4, on a vector of 0.6: the cylinder is nowhere."""

    S = Stroke(0.0, 0.1)
    O, A = Ground(0.0, 0.0), Ground(0.7, 0.0)
    OA = Vector(O, A)
    B = Offset(O, Turn(OA, CosineAngle(abs(OA), 0.4, 0.5 + S), length=0.6))
    load = Weight(B, mass=10.0)


def test_a_corner_of_other_lengths_closes_no_triangle():
    assert bodies(Other) == {frozenset("OA"), frozenset("OB")} and not Other.plan.cylinders
    assert not Other.plan.joints
    with pytest.raises(DefinitionError, match="OB is held by nothing"):
        pin_forces(Other().sweep(5))


def test_a_corner_at_another_point_closes_no_triangle():
    class Elsewhere(Mechanism):
        S = Stroke(0.0, 0.1)
        O, A, C = Ground(0.0, 0.0), Ground(0.7, 0.0), Ground(0.2, 0.5)
        OA = Vector(O, A)
        B = Offset(C, Turn(OA, CosineAngle(abs(OA), 0.4, 0.5 + S), length=0.4))
        load = Weight(B, mass=10.0)

    assert bodies(Elsewhere) == {frozenset("OAC"), frozenset("CB")} and not Elsewhere.plan.cylinders


def test_steps_and_vectors_mix():
    """A point turned on a crank's link is of its body; a link that would stretch is refused as ever."""

    class Mixed(Mechanism):
        phi = Stroke(0.2, 1.2)
        O, C = Ground(0.0, 0.0), Ground(1.0, 0.0)
        A = Crank(O, OA=0.3, angle=phi)
        AC = Vector(A, C)
        B = Offset(A, Turn(AC, CosineAngle(abs(AC), 0.9, 0.7), length=0.9))
        P = Offset(O, Turn(Vector(O, A), 0.5, length=0.2))

    assert bodies(Mixed) == {frozenset("OC"), frozenset("OAP"), frozenset("AB"), frozenset("CB")}
    with pytest.raises(DefinitionError, match="The link rod locks the linkage"):
        type("Stretched", (Mixed,), {"rod": Link("P", "B")})


def test_transmission_and_the_missing_length_are_told_of_a_corner():
    class Short(Mechanism):
        S = Stroke(0.0, 0.6)
        O, A = Ground(0.0, 0.0), Ground(0.7, 0.0)
        OA = Vector(O, A)
        B = Offset(O, Turn(OA, CosineAngle(abs(OA), 0.4, 0.5 + S), length=0.4))

    found = Short().at(S=[0.0, 0.1])
    sides = np.array([0.4, 0.4]), 0.5 + found.strokes["S"]
    angle = np.arccos((sides[0] ** 2 + sides[1] ** 2 - 0.49) / (2 * sides[0] * sides[1]))
    assert_allclose(found.transmission_angle("B"), angle, rtol=1e-12)
    with pytest.raises(AssemblyError, match=r"OA \+ OB = 1.1 m is 10 mm short of AB = 1.11 m"):
        Short().at(S=0.61)


class OnRam(Mechanism):
    """U lies on the cylinder, Q off it; both go with the pin A."""

    S = Stroke(0.0, 0.2)
    A, O = Ground(0.0, 0.242), Ground(0.652, 0.330)
    AO = Vector(A, O)
    OAB = CosineAngle(abs(AO), 0.55 + S, 0.175)
    B = Offset(A, Turn(AO, -OAB, length=0.55 + S))
    U = Offset(A, Turn(AO, -OAB, length=0.3))
    Q = Offset(A, Turn(Vector(A, B), 0.2, length=0.4))


def test_points_on_a_cylinder_are_those_of_the_composite_spelling():
    class Steps(Mechanism):
        S = Stroke(0.0, 0.2)
        A, O = Ground(0.0, 0.242), Ground(0.652, 0.330)
        B = Dyad(A, O, AB=0.55 + S, OB=0.175, side=RIGHT)
        U = OnLink(A, B, AU=0.3)
        Q = OnLink(A, B, AQ=0.4, BAQ=0.2)

    assert bodies(OnRam) == bodies(Steps)
    assert [(bar.P, bar.Q) for bar in OnRam.plan.cylinders] == [("A", "B")]
    assert OnRam().mobility == Steps().mobility == 1


def test_a_length_of_points_that_keep_their_distance_is_a_rod():
    """OC is 0.1 m longer than OB, as OD is than the cylinder: C is of the lever, and D of nothing."""

    class Longer(OnRam):
        OB = Vector("O", "B")
        C = Offset("O", Turn(OB, 0.4, length=abs(OB) + 0.1))
        D = Offset("O", Turn(OB, 0.8, length=abs(Vector("A", "B")) + 0.1))
        E = Offset("O", Turn("AO", 0.2, length=abs(Vector("U", "B"))))

    assert frozenset("OBC") in bodies(Longer)
    assert not any("D" in body.points for body in Longer().links if len(body.points) > 1)
    assert Longer.plan.points["E"].keeps.length is None and Longer().mobility == 1


# -- what is worked out by formulas, and held by links that are written ----------------------------------------


def test_a_lever_under_an_angle_that_is_worked_out_has_the_written_cylinder():
    """The corner is counted from a direction that only its number tells: lever and cylinder are written."""

    class Worksheet(Mechanism):
        S = Stroke(0.0, 0.2)
        FI0 = Dimension(float(np.arctan2(0.088, 0.652)), unit="deg")
        L0, r = Dimension(0.55), Dimension(0.175)
        A, O, X = Ground(0.0, 0.242), Ground(0.652, 0.330), Ground(1.652, 0.330)
        FIS = CosineAngle(distance(A, O), r, L0 + S)
        B = Offset(O, Turn(Vector(O, X), 180 * deg + FI0 + FIS, length=r))
        lever, ram = Link(O, B), Link("A B", AB=L0 + S)
        load = Weight(B, mass=100.0)

    _, steps = PAIRS["a lever, placed from the cylinder's pin"]
    assert (Worksheet().mobility, Worksheet().gruebler) == (1, 1)
    found, other = pin_forces(motion(Worksheet)), pin_forces(motion(steps))
    assert_allclose(found.thrusts["AB"], other.thrusts["AB"], rtol=1e-9)


def test_a_crosshead_at_a_place_that_is_worked_out_slides_on_its_rail():
    class Crosshead(Mechanism):
        phi = Stroke(0.3, 1.2)
        O, X = Ground(0.0, 0.0), Ground(1.0, 0.0)
        OX = Vector(O, X)
        A = Offset(O, Turn(OX, phi, length=0.1))
        C = Offset(O, Turn(OX, 0, length=0.1 * np.cos(phi) + np.sqrt(0.09 - 0.01 * np.sin(phi) ** 2)))
        rail = Guide(O, X)
        shoe = Slide(C, rail)
        rod = Link(A, C)
        load = Force(C, (-50.0, 0.0))

    found = Crosshead().sweep(7)
    assert Crosshead().mobility == 1 and Crosshead.plan.telescopes == ()
    assert_allclose(pin_forces(found).drives["phi"], driving_force(found), rtol=1e-11)


def test_a_table_drives_as_a_stroke_does():
    class Cam(Mechanism):
        phi = Stroke(0.0, 1.0)
        lift = Curve([0.0, 0.5, 1.0, 1.5], [0.2, 0.4, 0.9, 1.1])
        O, X = Ground(0.0, 0.0), Ground(1.0, 0.0)
        A = Offset(O, Turn(Vector(O, X), lift(phi), length=0.3))
        load = Weight(A, mass=10.0)

    found = Cam().sweep(5)
    assert Cam().mobility == 1
    assert_allclose(pin_forces(found).drives["phi"], driving_force(found), rtol=1e-11)


# -- the equations of vectors that are written where they are used ---------------------------------------------

LONG = ("forestry crane", "boom, arm and bucket, three cylinders, a bell crank")


@pytest.mark.parametrize(
    "which", [pytest.param(name, marks=pytest.mark.slow if place % 6 or name in LONG else ()) for place, name in enumerate(ALL)]
)
def test_equations_of_forces(which):
    """Their values are the engine's; the vectors of a line have no symbols of their own."""
    vectors, _ = ALL[which]
    found = motion(vectors, 3)
    values = equations(vectors, forces=True).values(at=found.strokes)
    for stroke in found.strokes:
        force = driving_force(found, drive=stroke)
        assert_allclose(values[f"Q_{stroke}"] * np.ones(3), force, rtol=1e-9, atol=1e-12 * np.abs(force).max())
    for name, ram in vectors.plan.of_kind(Cylinder).items():
        assert_allclose(values[f"T_{name}"] * np.ones(3), ram.thrust(found), rtol=1e-9)


def test_equations_of_a_cylinder_along_a_vector_without_a_name():
    _, steps = PAIRS["a lever, placed from the cylinder's pin"]
    held = type("Held", (PAIRS["a lever, placed from the cylinder's pin"][0],), {"lift": Cylinder("A", "B", bore=0.06, rod=0.03)})
    found = motion(held, 3)
    values = equations(held, forces=True).values(at=found.strokes)
    assert_allclose(values["T_lift"], pin_forces(motion(steps, 3)).thrusts["AB"], rtol=1e-9)
