"""Labels: one name for a link, its dimension and the design variable."""

import pytest
from numpy.testing import assert_allclose

from linkage import LEFT, DefinitionError, Dimension, Dyad, Ground, Link, Mechanism, OnLink, Stroke, deg
from linkage.steps import Slot, match
from tests.for_all import for_all


def test_spellings_of_a_length_and_of_an_angle():
    assert Slot("PX", ("A", "B")).spellings == {"AB": 1, "BA": 1}
    assert Slot("QPX", ("K", "F", "G")).spellings == {"KFG": 1, "GFK": -1}


def test_label_is_matched_against_the_points_and_never_cut_into_letters():
    slots = (Slot("PX", ("A1", "B")), Slot("QX", ("A", "1B")))
    with pytest.raises(DefinitionError, match="two ways"):
        match({"A1B": 1.0}, slots, "B")
    assert match({"BA1": 1.0}, slots, "B")["PX"][2] == 1


@for_all("label", ["AC", "ab", "ABO", "A B", "BB", ""])
def test_label_that_fits_no_point_lists_those_that_do(label):
    with pytest.raises(DefinitionError, match="AB/BA, OB/BO"):

        class Wrong(Mechanism):
            """A label from nowhere."""

            S, A, O = Stroke(0.3, 0.4), Ground(0, 0), Ground(0.5, 0)
            B = Dyad(A, O, side=LEFT, **{"OB": 0.3, label: S})


def test_dimension_given_twice_in_one_step():
    with pytest.raises(DefinitionError, match="same dimension"):

        class Twice(Mechanism):
            """AB and BA."""

            S, A, O = Stroke(0.3, 0.4), Ground(0, 0), Ground(0.5, 0)
            B = Dyad(A, O, AB=S, BA=S, OB=0.3, side=LEFT)


class Plate(Mechanism):
    """A four-bar's coupler that carries points; BC is said twice."""

    S, A, O = Stroke(0.2, 0.4), Ground(0, 0), Ground(1.0, 0)
    B = Dyad(A, O, AB=S + 0.3, OB=0.7, side=LEFT)
    C = OnLink(O, B, OC=0.5, BOC=30 * deg)
    D = OnLink(O, B, OD=0.6, DOB=30 * deg)
    E = OnLink(B, O, BE=0.2, EBO=-20 * deg)


@pytest.mark.parametrize(
    ("set_as", "value", "read_as", "wanted"),
    [("BO", 0.71, "OB", 0.71), ("COB", -0.4, "BOC", 0.4), ("BOD", -0.4, "DOB", 0.4), ("OBE", 0.3, "EBO", -0.3)],
)
def test_every_spelling_sets_the_one_dimension(set_as, value, read_as, wanted):
    design = Plate(**{set_as: value})
    assert design[read_as] == pytest.approx(wanted)
    assert design[set_as] == pytest.approx(value)


def test_angles_turn_as_their_label_says():
    motion = Plate().at(S=0.3)
    BO = motion.angle("O", "B")
    assert_allclose(motion.angle("O", "C") - BO, 30 * deg)
    assert_allclose(motion.angle("O", "D") - BO, -30 * deg)


@pytest.mark.parametrize(
    ("first", "second", "agree"), [(0.3, 0.3, True), (0.3, 0.3 * (1 + 1e-10), True), (0.3, 0.3 * (1 + 1e-8), False), (0.3, 0.31, False)]
)
def test_repeated_label_must_agree(first, second, agree):
    def declare():
        class Twice(Mechanism):
            """The rod OB is written in a step and in a link."""

            S, A, O = Stroke(0.4, 0.5), Ground(0, 0), Ground(0.5, 0)
            B = Dyad(A, O, AB=S, OB=first, side=LEFT)
            C = OnLink(O, B, OC=0.2, BC=0.25, side=LEFT)
            arm = Link("O B C", OB=second)

        return Twice

    if agree:
        assert declare()().dimensions["OB"] == first
    else:
        with pytest.raises(DefinitionError, match="contradicts"):
            declare()


@pytest.mark.parametrize("clash", ["BA", "AB"])
def test_name_that_already_stands_for_a_label_is_refused(clash):
    with pytest.raises(DefinitionError, match=clash):
        type(
            "Clash",
            (Mechanism,),
            {
                "S": Stroke(0.4, 0.5),
                "A": Ground(0, 0),
                "O": Ground(0.5, 0),
                "B": Dyad("A", "O", AB=0.4, OB="S", side=LEFT),
                clash: Dimension(3.0),
            },
        )


def test_label_may_follow_a_dimension_of_its_own_name():
    class Own(Mechanism):
        """AB is a Dimension and a label."""

        S, A, O, AB = Stroke(0.3, 0.4), Ground(0, 0), Ground(0.5, 0), Dimension(0.4)
        B = Dyad(A, O, AB=AB, OB=S, side=LEFT)

    assert_allclose(Own(AB=0.35).sweep(5).distance("A", "B"), 0.35, rtol=1e-12)
