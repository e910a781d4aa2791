"""Declaring and setting mechanisms: variants, dimensions, and what is refused in words."""

import warnings

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from linkage import LEFT, RIGHT, DefinitionError, Dimension, Dyad, Ground, LinkageError, Mechanism, OnLink, Stroke, angle, deg, ref
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all


class Arm(Mechanism):
    """A cylinder on a lever that carries G."""

    S, L0 = Stroke(0.0, 0.2), Dimension(0.5)
    A, O = Ground(0.2, 0.5), Ground(0.3, 1.1)
    B = Dyad(A, O, AB=L0 + S, OB=0.3, side=RIGHT)
    G = OnLink(O, B, OG=0.9, BOG=20 * deg)
    lean = angle(O, G) - 90 * deg


# -- variants ----------------------------------------------------------------------------------------------


def test_replaced_fixed_point_is_replaced_for_everybody():
    class Moved(Arm):
        """The same arm on another hinge."""

        O = Ground(0.32, 1.05)

    assert_allclose(Moved().sweep(5)["G"], Arm(O=(0.32, 1.05)).sweep(5)["G"], rtol=1e-14)


def test_replaced_dimension_and_stroke():
    class Longer(Arm):
        """A longer cylinder."""

        L0, S = Dimension(0.55), Stroke(0.0, 0.1)

    assert_allclose(Longer().sweep(5).distance("A", "B"), np.linspace(0.55, 0.65, 5), rtol=1e-13)


def test_replaced_side_mirrors_the_lever():
    class Other(Arm):
        """The other assembly mode."""

        B = Dyad("A", "O", AB=Arm.L0 + Arm.S, OB=0.3, side=LEFT)

    motion, other = Arm().sweep(5), Other().sweep(5)
    AO = motion["O"] - motion["A"]
    for each, sign in ((motion, -1), (other, 1)):
        AB = each["B"] - each["A"]
        assert (np.sign(AO[0] * AB[1] - AO[1] * AB[0]) == sign).all()


def test_variant_adds_members_and_leaves_its_base_alone():
    class Tool(Arm):
        """A tool at the end."""

        T = OnLink("O", "G", OT=1.2)
        lean = angle("O", "T")

    assert "T" in Tool.plan.points
    assert "T" not in Arm.plan.points
    assert_allclose(Tool().sweep(3)["lean"] - 90 * deg, Arm().sweep(3)["lean"], rtol=1e-12)


def test_member_taken_out_of_a_variant():
    class Bare(Arm):
        """No output."""

        lean = None

    assert "lean" not in Bare.plan.members
    with pytest.raises(DefinitionError, match=r"'B' is unknown in Hollow.G"):

        class Hollow(Arm):
            """No lever."""

            B = None


def test_variants_of_variants():
    class First(Arm):
        """One change."""

        O = Ground(0.31, 1.1)

    class Second(First):
        """Another."""

        A = Ground(0.21, 0.5)

    assert_allclose(Second().sweep(3)["G"], Arm(A=(0.21, 0.5), O=(0.31, 1.1)).sweep(3)["G"], rtol=1e-14)


# -- settings ----------------------------------------------------------------------------------------------


def test_settings_are_kept_and_read_by_any_spelling():
    design = Arm(BO=0.31, O=(0.3, 1.12), GOB=-0.4)
    assert (design["OB"], design["O"].tolist(), design["BOG"], design["O.y"]) == (0.31, [0.3, 1.12], 0.4, 1.12)
    assert repr(design) == "Arm(OB=0.31, BOG=0.4, **{'O.y': 1.12})"
    assert eval(repr(design), {"Arm": Arm}).dimensions == design.dimensions


def test_replaced_keeps_what_was_set():
    assert Arm(OB=0.31).replaced(OG=0.8).dimensions == Arm(OB=0.31, OG=0.8).dimensions
    assert Arm(OB=0.31).replaced(OB=0.3).dimensions == Arm().dimensions


def test_an_array_that_changes_afterwards_does_not_matter():
    OB = np.array([0.29, 0.30])
    design = Arm(OB=OB)
    OB[:] = 0.1
    assert design["OB"].tolist() == [0.29, 0.30]


@for_all(
    "kind", [int, np.float64, np.float32, np.int64, lambda each: np.array(each), lambda each: np.array(each, np.float32)]
)
def test_numbers_of_all_kinds(kind):
    assert Arm(A=(kind(0), kind(1)), O=(kind(0), kind(2)), OB=kind(1), L0=kind(1)).at(S=kind(0))["B"].shape == (2,)


BAD = [
    "",
    "0.3",
    "x",
    "300mm",
    None,
    True,
    np.nan,
    np.inf,
    -np.inf,
    1j,
    10**400,
    {},
    {1: 2},
    object(),
    b"1",
    lambda: 1,
    [0.3, np.nan],
    [[0.3], [0.3, 0.31]],
    np.array(["a"]),
    np.array([1j]),
    [None],
]


@for_all("bad", [*BAD, -1.0, 0.0, -0.0, [0.3, 0.0]], ids=lambda bad: repr(bad)[:20])
def test_bad_length(bad):
    with pytest.raises(DefinitionError, match="OB"):
        Arm(OB=bad)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"OB": 0.3, "BO": 0.31}, "OB and BO both set OB"),
        ({"BOG": 0.1, "GOB": -0.1}, "BOG and GOB both set BOG"),
        ({"A.x": 0.1, "A": (0.2, 0.3)}, r"A\.x and A both set A\.x"),
    ],
)
def test_a_dimension_is_set_once(settings, words):
    with pytest.raises(DefinitionError, match=f"Arm: {words}; leave one of them out"):
        Arm(**settings)


@for_all("bad", BAD, ids=lambda bad: repr(bad)[:20])
def test_bad_angle_dimension_coordinate_or_stroke(bad):
    for setting in ({"BOG": bad}, {"L0": bad}, {"A.x": bad}, {"A": (bad, 0.0)}):
        with pytest.raises(DefinitionError):
            Arm(**setting)
    with pytest.raises(DefinitionError):
        Arm().at(S=bad)


@for_all(
    "bad", [*BAD[:-4], 0.3, (0.1,), (0.1, 0.2, 0.3), [], np.array(0.3), np.zeros((3, 2)), {0.1, 0.2}], ids=lambda bad: repr(bad)[:20]
)
def test_bad_position(bad):
    with pytest.raises(DefinitionError):
        Arm(A=bad)


@for_all(
    "bad", [*[each for each in BAD if each is not None], 0, -3, [5], (5,), np.array(5.5), np.array([0.1])], ids=lambda bad: repr(bad)[:20]
)
def test_bad_count(bad):
    for ask in (lambda: Arm().sweep(bad), lambda: Arm().sweep(S=bad)):
        with pytest.raises(DefinitionError):
            ask()


@for_all(
    "ask",
    [
        lambda: Arm().sweep(),
        lambda: Arm().sweep(5, S=5),
        lambda: Arm().sweep(T=5),
        lambda: Arm().at(),
        lambda: Arm().at(T=0.1),
        lambda: Arm().at(S=0.1, T=0.1),
        lambda: Arm().sweep(5, unreachable="maybe"),
        lambda: Arm().at(S=0.0, unreachable=None),
        lambda: Arm().sweep(10**30),
    ],
)
def test_bad_stroke(ask):
    with pytest.raises(DefinitionError):
        ask()


def test_what_follows_others_cannot_be_set():
    with pytest.raises(DefinitionError, match=r"AB follows L0 \+ S"):
        Arm(AB=0.5)
    with pytest.raises(DefinitionError, match="follows"):
        Arm()["BA"]


@for_all("name", ["OBB", "S", "G", "lean", "AO", "x", "A.z", ".x", ""])
def test_unknown_setting_lists_the_known(name):
    for ask in (lambda: Arm(**{name: 0.3}), lambda: Arm().replaced(**{name: 0.3}), lambda: Arm()[name]):
        with pytest.raises(DefinitionError, match="Known: L0, A, O, OB, OG, BOG"):
            ask()


@for_all("name", [3, None, ["OB"], ("OB",), {}, 0.5])
def test_a_name_is_a_word(name):
    with pytest.raises(DefinitionError):
        Arm()[name]


def test_designs_whose_shapes_do_not_fit():
    with pytest.raises(DefinitionError, match=r"\(3,\), \(4,\)"):
        Arm(OB=[0.3] * 3, OG=[0.9] * 4).sweep(3)


# -- declarations --------------------------------------------------------------------------------------------

FRAME = {"S": Stroke(0.0, 0.2), "A": Ground(0.2, 0.5), "O": Ground(0.3, 1.1)}


@for_all("word", ["sweep", "at", "plan", "replaced", "links", "dimensions", "__init__", "columns", "mobility", "graph"])
def test_a_member_may_not_take_a_word_of_the_framework(word):
    with pytest.raises(DefinitionError, match=word):
        type("Word", (Mechanism,), {**FRAME, word: Dimension(1.0)})


@for_all("name", ["x", "y", "angle", "mm", "B2", "Ä", "_B", "class_", "lambda_", "OB"])
def test_a_point_may_take_any_other_name(name):
    made = type("Named", (Mechanism,), {**FRAME, name: Dyad("A", "O", side=RIGHT, **{"A" + name: ref("S") + 0.5, "O" + name: 0.3})})
    assert made().sweep(3)[name].shape == (2, 3)


def test_a_point_is_called_by_one_name():
    with pytest.raises(DefinitionError):

        class Alias(Arm):
            """G under a second name."""

            H = Arm.G


def test_an_output_may_have_two_names():
    class Twice(Arm):
        """lean again."""

        slope = Arm.lean

    motion = Twice().sweep(3)
    assert_array_equal(motion["slope"], motion["lean"])


def test_a_stroke_that_moves_nothing():
    with pytest.raises(DefinitionError, match="T moves nothing"):

        class Idle(Arm):
            """A stroke too many."""

            T = Stroke(0.0, 1.0)


def test_a_mechanism_without_strokes_stands():
    class Frame(Mechanism):
        """A triangle."""

        A, O = Ground(0.0, 0.0), Ground(5.0, 0.0)
        B = Dyad(A, O, AB=3.0, OB=4.0, side=LEFT)

    assert_allclose(Frame().at()["B"], [1.8, 2.4])
    assert_allclose(Frame(AB=[3.0, 4.0], OB=[4.0, 3.0]).at()["B"], [[1.8, 3.2], [2.4, 2.4]])


@for_all("size", [1e30, 1.4e154, 1e300, 1e-30, 1e-160, 1e-300])
def test_sizes_that_no_float_can_square(size):
    for setting in (
        {"A.x": size},
        {"OB": size},
        {"L0": size},
        {"A": (size, size), "O": (-size, size)},
        {"OB": size, "L0": size, "A": (0.0, 0.0), "O": (size, 0.0)},
    ):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            try:
                assert np.isfinite(Arm(**setting).at(S=0.0)["G"]).all()
            except LinkageError as error:
                assert "nan" not in str(error)


@given(
    st.dictionaries(
        st.sampled_from([*ThreePointHitch.plan.table.entries, "A", "M", "AB", "S", "zz", "BO", "GFK"]),
        st.one_of(
            st.floats(),
            st.integers(),
            st.text(max_size=4),
            st.none(),
            st.booleans(),
            st.lists(st.floats(allow_nan=True), max_size=3),
            st.tuples(st.floats(), st.floats()),
            st.complex_numbers(),
            st.binary(max_size=3),
            st.sampled_from([np.zeros((2, 0)), np.ones((2, 2, 2)), np.array("a"), np.nan]),
        ),
        max_size=4,
    ),
    st.one_of(st.floats(), st.integers(-5, 50), st.lists(st.floats(-2, 2), max_size=5), st.text(max_size=3), st.none()),
    st.sampled_from(["raise", "nan"]),
)
@settings(max_examples=8, deadline=None)
def test_anything_given_is_either_used_or_refused_in_words(dimensions, strokes, unreachable):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for ask in (
            lambda design: design.at(S=strokes, unreachable=unreachable),
            lambda design: design.sweep(strokes, unreachable=unreachable),
        ):
            try:
                motion = ask(ThreePointHitch(**dimensions))
                found = motion["G"]
            except LinkageError as error:
                assert str(error)
                continue
            assert np.isfinite(found[:, motion.reached]).all()
            assert np.isnan(found[:, ~motion.reached]).all()
