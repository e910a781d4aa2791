"""Rigid bodies and the Gruebler count, of machines whose count is known."""

import numpy as np

from linkage import LEFT, RIGHT, Crank, Dyad, Force, Ground, Link, Mechanism, Offset, OnLink, Stroke, Turn, Vector, Weight, angle
from linkage.cli.report import traced_points
from linkage.plan import KinematicChain, merged
from tests.for_all import for_all


def names(bodies):
    return sorted("".join(sorted(body.points)) for body in bodies)


def test_bodies_that_share_two_points_are_one():
    assert names(merged([("B", "C", "D"), ("C", "D", "E"), ("E", "F")], ("A", "O"))) == ["AO", "BCDE", "EF"]


def test_three_rods_that_make_a_triangle_stay_three():
    assert names(merged([("B", "C"), ("C", "D"), ("B", "D")], ("A",))) == ["A", "BC", "BD", "CD"]


def test_merging_goes_on_until_no_two_bodies_share_two_points():
    groups = [("B", "C"), ("D", "E", "G"), ("E", "F"), ("C", "D", "F"), ("B", "C", "D", "E")]
    assert names(merged(groups, ("A",))) == ["A", "BCDEFG"]


def test_a_body_pinned_twice_to_the_frame_is_the_frame():
    bodies = merged([("A", "O", "B")], ("A", "O"))
    assert [body.points for body in bodies if body.fixed] == [("A", "O", "B")]


@for_all(
    ("groups", "cylinders", "count"),
    [
        ([("A", "B"), ("B", "C"), ("C", "O")], [], 1),  # four-bar
        ([("O", "B")], [("A", "B")], 1),  # lever on a cylinder
        ([("A", "B"), ("B", "O")], [], 0),  # triangle
        ([("A", "B"), ("B", "C"), ("C", "D"), ("D", "O")], [], 2),  # five-bar
        ([("A", "B", "E"), ("B", "C"), ("C", "O", "F"), ("E", "D"), ("D", "F")], [], 1),  # Watt's six-bar
    ],
)
def test_gruebler_count_of_known_chains(groups, cylinders, count):
    chain = KinematicChain(merged(groups, ("A", "O")))
    for P, Q in cylinders:
        chain.add_cylinder(P + Q, P, Q)
    assert chain.gruebler_count == count


class Crane(Mechanism):
    """Boom cylinder and arm cylinder: two strokes."""

    S, T = Stroke(0.0, 0.4), Stroke(0.0, 0.3)
    O, P = Ground(0.0, 1.0), Ground(0.3, 0.2)
    B = Dyad(P, O, PB=0.8 + S, OB=0.7, side=RIGHT)
    C = OnLink(O, B, OC=2.0)
    Q = OnLink(O, B, OQ=1.2, BOQ=0.2)
    D = Dyad(Q, C, QD=0.75 + T, CD=0.4, side=LEFT)
    G = OnLink(C, D, CG=1.5, DCG=2.6)
    direction = angle(C, G)


def test_a_crane_has_two_degrees_of_freedom():
    assert Crane().gruebler == 2
    assert names(Crane().links) == ["BCOQ", "CDG", "OP"]


def test_primitives_are_bodies_and_a_written_link_agrees():
    class Arm(Mechanism):
        """One body, turned by a stroke."""

        phi = Stroke(0.0, 1.0)
        O, A = Ground(0.0, 0.0), Ground(1.0, 0.0)
        B = Offset(O, Turn(Vector(O, A), phi))
        C = Offset(O, Turn(Vector(O, B), 0.3))

    class Linked(Arm):
        """The same with its link."""

        arm = Link("O B C")

    assert names(Arm().links) == names(Linked().links) == ["AO", "BCO"]
    assert str(Arm().mobility) == str(Linked().mobility) == "1"


def test_a_crank_is_a_link_of_its_own():
    class FourBar(Mechanism):
        """The textbook four-bar."""

        phi = Stroke(0.0, 2 * np.pi)
        O, Q = Ground(0.0, 0.0), Ground(1.0, 0.0)
        A = Crank(O, OA=0.3, angle=phi)
        B = Dyad(A, Q, AB=0.9, QB=0.7, side=LEFT)

    assert names(FourBar().links) == ["AB", "AO", "BQ", "OQ"]
    assert FourBar().gruebler == 1


def test_the_tip_of_a_machine_is_no_centre_of_gravity():
    class Boom(Mechanism):
        S = Stroke(0.0, 0.1)
        A, O = Ground(0.0, 0.0), Ground(0.7, 0.0)
        B = Dyad(A, O, AB=0.6 + S, OB=0.3, side=LEFT)
        T = OnLink(O, B, OT=1.2)
        G = OnLink(O, B, OG=0.5)
        load = Weight(G, mass=100)

    loaded = type("Loaded", (Boom,), {"push": Force("T", (0.0, -1000.0))})
    alone = type("Alone", (Boom,), {"load": Weight("T", mass=100), "G": OnLink("O", "T", OG=1.2)})
    assert [each.plan.tip for each in (Boom, loaded, alone)] == [("T",), ("T",), ("G",)]
    assert traced_points(Boom(), None) == ("T",)
