"""Positions, outputs, ratios, velocities: shapes, broadcasting and truths that do not depend on this code."""

import warnings
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from linkage import (
    LEFT,
    RIGHT,
    AssemblyError,
    Crank,
    DefinitionError,
    Dyad,
    Ground,
    Guide,
    LinkageError,
    Mechanism,
    OnGuide,
    OnLink,
    Stroke,
    angle,
    deg,
    distance,
    ratio,
    x,
    y,
)
from linkage.motion.grid import unwrapped
from linkage.program.kernel import PlainFloats
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all


class Crane(Mechanism):
    """Boom cylinder and arm cylinder: two strokes."""

    S, T = Stroke(0.0, 0.4), Stroke(0.0, 0.3)
    O, P = Ground(0.0, 1.0), Ground(0.3, 0.2)
    B = Dyad(P, O, PB=0.8 + S, OB=0.7, side=RIGHT)
    C = OnLink(O, B, OC=2.0)
    Q = OnLink(O, B, OQ=1.2, BOQ=0.2)
    D = Dyad(Q, C, QD=0.75 + T, CD=0.4, side=LEFT)
    G = OnLink(C, D, CG=1.5, DCG=2.6)
    slope = angle(C, G)
    product = distance(O, G) * x(G) - y(C) ** 2


class Crown(Mechanism):
    """A crank that turns three times, and a link pinned to it."""

    phi = Stroke(0.0, 6 * np.pi)
    O, Q = Ground(0.0, 0.0), Ground(1.0, 0.0)
    A = Crank(O, OA=0.3, angle=phi)
    B = Dyad(A, Q, AB=0.9, QB=0.7, side=LEFT)
    turning, rocking = angle(O, A), angle(Q, B)
    both = angle(O, A) - 2 * angle(Q, B)


# -- shapes ------------------------------------------------------------------------------------------------


@for_all(
    ("strokes", "shape"),
    [
        (dict(S=0.1, T=0.1), ()),
        (dict(S=[0.1, 0.2], T=0.1), (2,)),
        (dict(S=np.full((2, 3), 0.1), T=[0.1, 0.2, 0.3]), (2, 3)),
        (dict(S=np.full((2, 1, 3), 0.1), T=np.full((4, 1), 0.1)), (2, 4, 3)),
        (dict(S=[], T=0.1), (0,)),
        (dict(S=np.empty((3, 0)), T=0.1), (3, 0)),
    ],
)
@for_all(
    ("design", "front"),
    [
        ({}, ()),
        (dict(OB=[0.7, 0.71]), (2,)),
        (dict(OB=np.full((2, 1), 0.7), CD=np.full(3, 0.4)), (2, 3)),
        (dict(OB=[]), (0,)),
        (dict(P=([0.3], 0.2)), (1,)),
    ],
)
def test_designs_come_first_and_strokes_last(strokes, shape, design, front):
    motion = Crane(**design).at(**strokes)
    assert motion.shape == front + shape
    assert motion["G"].shape == motion["O"].shape == motion.ratio("G", wrt="T").shape == (2, *front, *shape)
    assert motion["slope"].shape == motion.reached.shape == motion.distance("C", "D").shape == (*front, *shape)
    assert motion.velocity("G", dict(S=0.1)).shape == motion.acceleration("G", dict(S=0.1, T=0.2)).shape == (2, *front, *shape)
    assert motion.ratio("G", wrt="S", method="central").shape == (2, *front, *shape)


def test_a_batch_is_its_designs_one_by_one():
    OB, S = np.linspace(0.28, 0.32, 5), np.linspace(0.0, 0.25, 30)
    together = ThreePointHitch(OB=OB).at(S=S)
    for index, each in enumerate(OB):
        alone = ThreePointHitch(OB=each).at(S=S)
        assert_allclose(together["G"][:, index], alone["G"], rtol=1e-13)
        assert_allclose(together.ratio("G")[:, index], alone.ratio("G"), rtol=1e-12)
        assert_allclose(together["tilt"][index], alone["tilt"], rtol=1e-12)


def test_one_pose_is_one_of_many_and_costs_two_calls_of_floats(monkeypatch):
    design = ThreePointHitch(OB=0.31)
    design.at(S=0.1).ratio("G")
    many, runs = design.at(S=[0.05, 0.1, 0.15]), []
    found = many["G"], many.ratio("G"), many.value("tilt")
    run = PlainFloats.pose_values
    monkeypatch.setattr(PlainFloats, "pose_values", lambda *given: runs.append(given) or run(*given))
    monkeypatch.setattr(PlainFloats, "run", lambda *given: pytest.fail("one pose goes through arrays"))
    one = design.at(S=0.1)
    one.ratio("G")
    assert len(runs) == 2  # where it is, and the ratios of all points
    one.ratio("E"), one["F"]
    assert len(runs) == 2
    for part, all_of_it in zip((one["G"], one.ratio("G")), found, strict=False):
        assert_array_equal(part, all_of_it[..., 1])
    monkeypatch.undo()
    assert_array_equal(one.value("tilt"), found[2][1])
    assert design.at(S=[[0.1]])["G"].shape == (2, 1, 1)


def test_two_counts_give_a_grid():
    motion = Crane().sweep(S=4, T=3)
    assert motion.strokes["S"][:, 0].tolist() == pytest.approx([0.0, 0.4 / 3, 0.8 / 3, 0.4])
    assert motion.strokes["T"][0].tolist() == pytest.approx([0.0, 0.15, 0.3])
    assert_allclose(Crane().sweep(S=4, T=0.15)["G"], motion["G"][:, :, 1], rtol=1e-13)


def test_what_is_done_to_the_strokes_afterwards_does_not_matter():
    S = np.linspace(0.0, 0.25, 30)
    motion = ThreePointHitch().at(S=S)
    before = motion.ratio("F").copy()
    S[:] = 0.0
    assert_array_equal(motion.strokes["S"], np.linspace(0.0, 0.25, 30))
    assert_allclose(motion.ratio("F", method="central"), before, rtol=1e-8)


# -- outputs -----------------------------------------------------------------------------------------------


def test_arithmetic_of_outputs_is_arithmetic_of_results():
    motion = Crane().sweep(S=5, T=4)
    assert_allclose(motion["product"], motion.distance("O", "G") * motion.x("G") - motion.y("C") ** 2, rtol=1e-13)


@pytest.mark.parametrize("name", ["slope", "product"])
def test_chain_rule_of_outputs(name):
    motion = Crane().sweep(S=5, T=4)
    for stroke in "ST":
        assert_allclose(motion.ratio(name, wrt=stroke, method="central"), motion.ratio(name, wrt=stroke), rtol=1e-8, atol=1e-9)


def test_an_expression_that_has_no_name():
    motion = Crane().sweep(S=5, T=4)
    assert_allclose(motion.ratio(x("G") * 2, wrt="S"), 2 * motion.ratio("G", wrt="S")[0], rtol=1e-13)


def test_members_stand_for_their_names():
    motion = Crane().sweep(S=5, T=4)
    assert_array_equal(motion[Crane.G], motion["G"])
    assert_array_equal(motion.angle(Crane.C, Crane.G), motion.angle("C", "G"))
    assert_array_equal(motion.x(Crane.G), motion["G"][0])


def test_a_stroke_moves_by_itself_and_a_dimension_does_not():
    motion = Crane().sweep(S=5, T=4)
    assert_array_equal(motion.ratio("S", wrt="S"), np.ones((5, 4)))
    assert_array_equal(motion.ratio("S", wrt="T"), np.zeros((5, 4)))
    assert_array_equal(motion.ratio("O", wrt="T"), np.zeros((2, 5, 4)))


def test_transmission_angle_is_the_angle_between_the_links():
    motion = Crown().sweep(40)
    cosine = (0.9**2 + 0.7**2 - motion.distance("A", "Q") ** 2) / (2 * 0.9 * 0.7)
    assert_allclose(np.cos(motion.transmission_angle("B")), cosine, atol=1e-13)


def test_a_motion_says_what_it_is():
    words = "S = 0 to 400 mm, T = 100 mm; shape (5,), all reached, not looked at between the poses"
    assert repr(Crane().sweep(S=5, T=0.1)) == f"<Motion of Crane: {words}>"


# -- angles without jumps ------------------------------------------------------------------------------------


@pytest.mark.parametrize("order", ["up", "down", "shuffled"])
def test_angle_of_a_crank_that_turns_three_times(order):
    phi = np.linspace(0.0, 6 * np.pi, 200)
    phi = {"up": phi, "down": phi[::-1], "shuffled": np.random.default_rng(0).permutation(phi)}[order]
    turning = Crown().at(phi=phi)["turning"]
    assert_allclose(turning - turning[phi.argmin()], phi - phi.min(), atol=1e-12)


def test_the_rocker_comes_back_after_every_turn():
    motion = Crown().sweep(601)
    rocking, both = motion["rocking"], motion["both"]
    assert_allclose(rocking[200:], rocking[:-200], atol=1e-12)
    assert_allclose(both[200:] - both[:-200], 2 * np.pi, atol=1e-12)


def test_angle_is_continued_over_a_gap():
    class Gap(Mechanism):
        """A long crank whose dyad cannot be closed on a part of each turn."""

        phi = Stroke(0.0, 6 * np.pi)
        O, Q = Ground(0.0, 0.0), Ground(1.0, 0.0)
        A = Crank(O, OA=0.8, angle=phi)
        B = Dyad(A, Q, AB=0.9, QB=0.7, side=LEFT)
        turning = angle(O, A)

    motion = Gap().sweep(400, unreachable="nan")
    phi, turning = motion.strokes["phi"], motion["turning"]
    assert 0.1 < motion.reached.mean() < 0.9
    assert_array_equal(np.isnan(turning), ~motion.reached)
    assert_allclose(turning[motion.reached], phi[motion.reached] - (phi - turning)[motion.reached][0], atol=1e-11)


@given(st.lists(st.floats(-3.0, 3.0), min_size=2, max_size=40), st.integers(-5, 5), st.sets(st.integers(0, 39), max_size=10))
def test_unwrapping_undoes_wrapping_over_gaps(steps, turns, gaps):
    true = 0.3 + 2 * np.pi * turns + np.cumsum(np.array(steps) / 12)
    shown = np.angle(np.exp(1j * true))
    shown[[each for each in gaps if each < len(steps)]] = np.nan
    found = unwrapped(shown, [np.arange(float(len(steps)))], 1)
    kept = np.isfinite(shown)
    assert_array_equal(np.isfinite(found), kept)
    if kept.any():
        shift = (found - true)[kept]
        assert_allclose(shift, shift[0], atol=1e-9)
        assert_allclose(shift[0] / (2 * np.pi), round(shift[0] / (2 * np.pi)), atol=1e-9)


def test_unwrapping_a_grid_of_designs_and_two_strokes():
    i, j = np.meshgrid(np.linspace(0, 9, 60), np.linspace(0, 7, 50), indexing="ij")
    true = np.stack([i + j, i - 2 * j])
    found = unwrapped(np.angle(np.exp(1j * true)), [i, j], 2)
    assert_allclose(found, true, atol=1e-9)


# -- velocity and acceleration ---------------------------------------------------------------------------------


def path(t):
    """Return the strokes of a smooth drive at a time [s]."""
    return dict(S=0.2 + 0.1 * np.sin(2 * t), T=0.1 + 0.08 * t - 0.05 * t**2)


def test_velocity_and_acceleration_are_those_along_the_path():
    t, h = np.linspace(0.1, 0.9, 25), 1e-4
    rates = dict(S=0.2 * np.cos(2 * t), T=0.08 - 0.1 * t)
    accelerations = dict(S=-0.4 * np.sin(2 * t), T=-0.1)
    before, now, after = (Crane().at(**path(each)) for each in (t - h, t, t + h))
    for name in ("G", "slope"):
        assert_allclose(now.velocity(name, rates), (after[name] - before[name]) / (2 * h), rtol=1e-6, atol=1e-8)
        assert_allclose(
            now.acceleration(name, rates, accelerations), (after[name] - 2 * now[name] + before[name]) / h**2, rtol=1e-5, atol=1e-6
        )


def test_mixed_second_derivative_counts_twice():
    motion = Crane().sweep(S=5, T=4)
    both, first, second = (motion.acceleration("G", rates) for rates in (dict(S=1.0, T=1.0), dict(S=1.0), dict(T=1.0)))
    h = 1e-5
    up, down = (Crane().at(S=motion.strokes["S"], T=motion.strokes["T"] + sign * h) for sign in (1, -1))
    mixed = (up.ratio("G", wrt="S") - down.ratio("G", wrt="S")) / (2 * h)
    assert np.abs(mixed).max() > 0.1
    assert_allclose(both - first - second, 2 * mixed, rtol=1e-6, atol=1e-7)


def test_a_crank_at_constant_speed_is_drawn_to_its_centre():
    motion = Crown().sweep(50)
    assert_allclose(motion.acceleration("A", dict(phi=3.0)), -9.0 * motion["A"], atol=1e-13)
    assert_allclose(motion.velocity("A", dict(phi=3.0)), 3.0 * np.array([-motion.y("A"), motion.x("A")]), atol=1e-13)
    assert_array_equal(motion.velocity("A", {}), np.zeros((2, 50)))


# -- out of reach ----------------------------------------------------------------------------------------------


def test_out_of_reach_says_which_triangle_where_and_how_far():
    with pytest.raises(AssemblyError) as caught:
        ThreePointHitch().at(S=[0.1, 0.42, 0.45])
    error = caught.value
    AO = np.hypot(0.1, 0.6)
    assert error.point == "B"
    assert error.mask.tolist() == [False, True, True]
    assert error.shortfall == pytest.approx(0.95 - AO - 0.3, rel=1e-9)
    for words in ("B = Dyad(A, O)", "2 of 3 strokes", "420.0 to 450.0 mm", "AO + OB", "lengthen OB"):
        assert words in str(error)


def test_out_of_reach_in_a_batch_counts_the_designs():
    with pytest.raises(AssemblyError, match="in 1 of 3 designs"):
        ThreePointHitch(CD=[0.62, 0.61, 0.2]).sweep(11)


@pytest.mark.slow
def test_nan_where_asked_and_the_rest_as_ever():
    S = np.array([0.1, 0.45, 0.2])
    motion, good = ThreePointHitch().at(S=S, unreachable="nan"), ThreePointHitch().at(S=S[[0, 2]])
    assert motion.reached.tolist() == [True, False, True]
    for found in (
        motion["G"],
        motion.ratio("G"),
        motion.ratio("G", order=2),
        motion["tilt"],
        motion.ratio("tilt"),
        motion.velocity("G", dict(S=1.0)),
    ):
        assert_array_equal(np.isnan(found), np.broadcast_to([False, True, False], found.shape))
    assert_allclose(motion["G"][:, [0, 2]], good["G"], rtol=1e-13)
    assert_allclose(motion.ratio("tilt")[[0, 2]], good.ratio("tilt"), rtol=1e-13)


@pytest.mark.parametrize("count", [1, 5, 50, 20000])
def test_a_length_that_gets_negative_is_out_of_reach(count):
    S = np.full(count, 0.1)
    S[-1] = -1.2  # AB = -0.7 m: as a square it would close the triangle
    with pytest.raises(AssemblyError, match="negative") as caught:
        ThreePointHitch().at(S=S)
    assert caught.value.mask.sum() == 1
    assert caught.value.shortfall == pytest.approx(0.7)
    assert ThreePointHitch().at(S=S, unreachable="nan").reached.sum() == count - 1


@cache
def coinciding(kind=None):
    """Return a machine whose point P runs through the fixed point A at S = 0, some with a point X behind it."""
    members = {
        "S": Stroke(-0.1, 0.1),
        "A": Ground(0.0, 0.0),
        "O": Ground(0.0, 0.5),
        "rail": Guide((0.0, 0.0), angle=0.3),
        "P": OnGuide("rail", at="S"),
        "u": distance("A", "P"),
    }
    return type("Through", (Mechanism,), members | ({"X": BEHIND_A[kind]()} if kind else {}))


BEHIND_A = {
    "OnLink": lambda: OnLink("A", "P", AX=0.3),
    "Dyad": lambda: Dyad("A", "P", AX=0.3, PX=0.3, side=LEFT),
    "Crank along a direction": lambda: Crank("A", AX=0.3, angle=angle("A", "P")),
    "Crank over a pole": lambda: Crank("A", AX=0.3, angle=1 / distance("A", "P")),
}


@for_all("count", [1, 101], slow=[5, 20001])
@for_all("kind", BEHIND_A)
def test_a_direction_that_is_lost_is_never_a_silent_nan(kind, count):
    S = np.linspace(-0.1, 0.1, count) if count > 1 else np.zeros(1)  # holds 0
    with pytest.raises(AssemblyError) as caught:
        coinciding(kind)().at(S=S)
    assert caught.value.point == "X"
    motion = coinciding(kind)().at(S=S, unreachable="nan")
    assert_array_equal(motion.reached, S != 0.0)


@for_all("kind", ["Dyad", "Crank over a pole"])
def test_points_that_rounding_alone_keeps_apart_are_lost_and_others_are_not(kind):
    motion = coinciding(kind)().at(S=[-0.1, 1e-17, 0.1], unreachable="nan")
    assert_array_equal(motion.reached, [True, False, True])
    assert_array_equal(np.isnan(motion["X"]).any(axis=0), ~motion.reached)


def test_points_may_coincide_where_no_direction_is_taken():
    motion = coinciding()().sweep(5)
    assert_allclose(motion["u"], np.abs(motion.strokes["S"]), atol=1e-16)
    with pytest.raises(LinkageError, match=r"u = distance.* takes a direction between points that coincide"):
        motion.ratio("u")
    with pytest.raises(LinkageError, match="A, P"):
        motion.angle("A", "P")


# -- bad questions -----------------------------------------------------------------------------------------------

QUESTIONS = {
    "a point": lambda motion, bad: motion[bad],
    "a quantity": lambda motion, bad: motion.value(bad),
    "a quantity of points": lambda motion, bad: motion.value(2.0 * angle("G", bad if isinstance(bad, str) else "H")),
    "a ratio of points": lambda motion, bad: motion.ratio(distance("G", bad if isinstance(bad, str) else "H"), wrt="S"),
    "x": lambda motion, bad: motion.x(bad),
    "y": lambda motion, bad: motion.y(bad),
    "angle": lambda motion, bad: motion.angle("G", bad),
    "distance": lambda motion, bad: motion.distance(bad, "G"),
    "transmission angle": lambda motion, bad: motion.transmission_angle(bad),
    "ratio": lambda motion, bad: motion.ratio(bad, wrt="S"),
    "central ratio": lambda motion, bad: motion.ratio(bad, wrt="S", method="central"),
    "wrt": lambda motion, bad: motion.ratio("G", wrt=bad),
    "order": lambda motion, bad: motion.ratio("G", wrt="S", order=bad),
    "method": lambda motion, bad: motion.ratio("G", wrt="S", method=bad),
    "step": lambda motion, bad: motion.ratio("G", wrt="S", method="central", step=bad if bad is not None else 0),
    "velocity of": lambda motion, bad: motion.velocity(bad, dict(S=1.0)),
    "rates": lambda motion, bad: motion.velocity("G", bad),
    "a rate": lambda motion, bad: motion.velocity("G", dict(S=bad)),
    "an unknown rate": lambda motion, bad: motion.velocity("G", {bad if isinstance(bad, (str, int)) else "X": 1.0}),
    "acceleration": lambda motion, bad: motion.acceleration("G", dict(S=1.0), dict(T=bad)),
}
BAD = [
    "",
    "H",
    "S2",
    0,
    -1.5,
    2.5j,
    None,
    ["G"],
    ("G", "C"),
    {"G": 1},
    b"G",
    np.nan,
    np.inf,
    np.ones(7),
    np.array(["G"]),
    object(),
    Crane,
    lambda: 0,
]


RATES = ("a rate", "acceleration")  # of which any finite number is one


@for_all(
    ("question", "bad"),
    [
        (question, bad)
        for question in QUESTIONS
        for bad in BAD
        if not (question in RATES and type(bad) in (int, float) and np.isfinite(bad))
    ],
    ids=lambda each: str(each).partition(" at 0x")[0],  # without addresses, which change from process to process
)
def test_a_bad_question_is_answered_in_words(question, bad):
    motion = Crane().sweep(S=5, T=4)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(DefinitionError):
            QUESTIONS[question](motion, bad)


def test_several_strokes_want_to_be_named():
    motion = Crane().sweep(S=3, T=3)
    with pytest.raises(DefinitionError, match="wrt= one of S, T"):
        motion.ratio("G")
    with pytest.raises(DefinitionError, match=r"S=\.\.\., T=\.\.\."):
        Crane().sweep(5)


def test_angle_of_tilt_is_what_the_units_say():
    assert ThreePointHitch().at(S=0.0)["tilt"] / deg == pytest.approx(3.19365591, abs=1e-8)


class Winding(Mechanism):
    """A crank whose torsion spring stores energy with its angle, over several turns."""

    phi = Stroke(0.0, 900 * deg)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=1.0, angle=phi)
    stored = angle(O, A) * angle(O, A)


def test_the_ratio_of_what_follows_an_angle_beyond_half_a_turn():
    motion = Winding().sweep(91)
    phi = motion.strokes["phi"]
    assert_allclose(motion.ratio("stored"), 2.0 * phi, atol=1e-12)
    assert_allclose(motion.ratio("stored", order=2), 2.0, atol=1e-12)
    assert_allclose(motion.ratio("stored", method="central"), 2.0 * phi, atol=1e-6)
    (found,) = Winding().evaluate([ratio("stored")], phi=phi)
    assert_allclose(found, 2.0 * phi, atol=1e-12)
