"""Extremes between the poses: their value, their place and their bounds, from however few poses and however narrow."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from linkage import LEFT, RIGHT, Crank, DefinitionError, Dyad, Ground, Link, Mechanism, Pin, Stroke, angle
from linkage.motion import below_zero, evaluate_grid, greatest, lowest, ratio, reached_spans
from linkage.program import QUICKEST
from tests.for_all import first_daily, for_all

WIDTH = 1.0 / 2000.0


class Lift(Mechanism):
    """One cylinder, one lever. It reaches from AB = 0.4 to 0.8 m, where A, O and B are in line."""

    S = Stroke(0.50, 0.75)
    A, O = Ground(0.0, 0.0), Ground(0.60, 0.0)
    B = Dyad(A, O, AB=S, OB=0.20, side=RIGHT)
    psi = angle(O, B)


class Crane(Mechanism):
    """Two cranks, one on the other."""

    u, v = Stroke(0.0, 1.0), Stroke(0.0, 1.0)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=2.0, angle=u)
    B = Crank(A, AB=1.0, angle=u + v)


class Arm(Mechanism):
    """A crank."""

    phi = Stroke(0.0, 2 * np.pi)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=0.1, angle=phi)
    turn = angle(O, A)


def of_stroke(f, name="S"):
    """Return a function of a motion that looks at the share of its declared stroke only."""

    def at(motion):
        stroke = motion.plan.strokes[name]
        return np.broadcast_to(f((motion.strokes[name] - stroke.start) / (stroke.end - stroke.start)), motion.shape)

    return at


def share(found, machine=Lift, name="S"):
    """Return the place of an extreme as a share of the declared stroke."""
    stroke = machine.plan.strokes[name]
    return (found.strokes[name] - stroke.start) / (stroke.end - stroke.start)


# -- along one stroke ----------------------------------------------------------------------------------------

SHAPES = {
    "smooth": lambda u, p: -((u - p) ** 2),
    "kink": lambda u, p: -np.abs(u - p),
    "cusp": lambda u, p: -np.sqrt(np.abs(u - p)),
    "jump": lambda u, p: np.where(u < p, u - p, -1.0 - u),
    "triangle": lambda u, p: np.maximum(0.0, 1.0 - np.abs(u - p) / (0.5 * WIDTH)) - 1.0,
    "parabola": lambda u, p: np.maximum(0.0, 1.0 - ((u - p) / (0.5 * WIDTH)) ** 2) - 1.0,
    "triangle on waves": lambda u, p: (
        np.maximum(0.0, 1.0 - np.abs(u - p) / (0.5 * WIDTH)) - 1.0 + 0.4 * (np.sin(40.0 * u + 100.0 * p) - np.sin(140.0 * p))
    ),
}


@first_daily(3, "shape", sorted(SHAPES, key=("kink", "jump", "triangle on waves", *SHAPES).index))
@settings(deadline=None, max_examples=10)
@given(place=st.floats(0.0, 1.0, exclude_min=True))
def test_a_top_anywhere(shape, place):
    found = greatest(Lift().sweep(2), of_stroke(lambda u: SHAPES[shape](u, place)))
    assert found.value == pytest.approx(0.0, abs=1e-6)
    assert share(found) == pytest.approx(place, abs=1e-4)
    assert not found.unbounded
    assert lowest(Lift().sweep(2), of_stroke(lambda u: -SHAPES[shape](u, place))).value == -found.value


def pieces(rng, least, most):
    """Return the corners of a broken line over 0 ... 1, no two nearer than `least`, up to `most`."""
    count = int(rng.integers(2, most))
    gaps = rng.exponential(size=count)
    x = np.concatenate([[0.0], np.cumsum(least + gaps / gaps.sum() * (1.0 - count * least))])
    return x / x[-1], rng.uniform(-1.0, 1.0, count + 1)


@for_all("seed", range(2), slow=range(2, 40))
def test_broken_lines_with_gaps(seed):
    """The highest corner, or the highest edge of a gap, of lines of up to 1500 pieces."""
    rng = np.random.default_rng(seed)
    x, y = pieces(rng, 1.0 / 3500.0, 1500)
    edges = np.sort(rng.uniform(0.0, 1.0, 2 * int(rng.integers(0, 5)))).reshape(-1, 2)
    kept, last = [], 0.0
    for low, high in edges:
        if low - last > 0.01 and high < 0.99:
            kept, last = [*kept, (low, high)], high

    def f(u):
        inside = np.any([np.zeros(np.shape(u), bool), *((low < u) & (u < high) for low, high in kept)], axis=0)
        return np.where(inside, np.nan, np.interp(u, x, y))

    places = np.concatenate([x, np.ravel(kept)])
    for look, best in ((greatest, np.nanmax), (lowest, np.nanmin)):
        found = look(Lift().sweep(3), of_stroke(f))
        assert found.value == pytest.approx(best(f(places)), abs=1e-6)
        assert not found.unbounded


@for_all("seed", range(2), slow=range(2, 20))
def test_jumps_count_on_their_larger_side(seed):
    rng = np.random.default_rng(seed)
    x = np.sort(rng.uniform(0.0, 1.0, int(rng.integers(1, 60))))
    x = x[np.diff(x, prepend=-1.0) > 1.0 / 1000.0]
    a, b = rng.normal(size=(2, len(x) + 1))

    def f(u):
        piece = np.searchsorted(x, u)
        return a[piece] + b[piece] * u

    ends = np.concatenate([[0.0], x, [1.0]])
    found = greatest(Lift().sweep(2), of_stroke(f))
    assert found.value == pytest.approx(max(np.max(a + b * ends[:-1]), np.max(a + b * ends[1:])), abs=1e-9)


def test_of_a_level_stretch_the_first_place_is_told():
    rng = np.random.default_rng(3)
    for low, high in ((0.0, 1.0), (0.31, 0.77), (0.5, 0.502)):

        def f(u, low=low, high=high):
            return 1.0 - np.maximum(low - u, 0.0) - np.maximum(u - high, 0.0) + 1e-13 * rng.normal(size=np.shape(u))

        found, (share,) = greatest(Lift().sweep(2), of_stroke(f)), Lift().strokes.values()
        place = (found.strokes["S"] - share.start) / (share.end - share.start)
        assert low <= place <= low + 1.0 / 4096.0 and found.value == pytest.approx(1.0, abs=1e-12)


@for_all("count", [3, 5, 50, 500, 4097, 6000])
def test_however_many_poses_say_the_same(count):
    first, other = (greatest(Lift().sweep(each), lambda motion: motion.ratio("psi")) for each in (2, count))
    assert (first.value, first.strokes) == (other.value, other.strokes)


def test_a_lever_is_longest_at_right_angles():
    found = lowest(Lift().sweep(2), lambda motion: np.abs(motion.ratio("psi")))  # 1 / lever, and the lever about O is OB at most
    assert found.value == pytest.approx(1.0 / 0.20, rel=1e-12)
    assert found.strokes["S"] == pytest.approx(np.sqrt(0.60**2 - 0.20**2), abs=1e-4 * 0.25)


def test_an_angle_past_half_a_turn_is_continued_between_the_poses_too():
    for name, sense in (("turn", 1.0), ("turn", -1.0)):
        found = greatest(Arm().sweep(5), lambda motion, name=name, sense=sense: -np.abs(motion[name] - (1.0 + 0.3 * sense) * np.pi))
        assert found.value == pytest.approx(0.0, abs=1e-9)
        assert found.strokes["phi"] == pytest.approx((1.0 + 0.3 * sense) * np.pi, abs=1e-9)
    found = greatest(Arm().sweep(5), lambda motion: motion.angle("O", "A") * (4.0 - motion.angle("O", "A")))
    assert found.strokes["phi"] == pytest.approx(2.0, abs=1e-6)
    squared = angle("O", "A") * angle("O", "A") * (9.0 - angle("O", "A"))
    found = greatest(Arm().sweep(5), lambda motion: motion.ratio(squared, wrt="phi"))  # 18 x - 3 x2
    assert (found.value, found.strokes["phi"]) == pytest.approx((27.0, 3.0), abs=1e-6)


def test_numerical_differences_may_be_asked_of_the_poses_between():
    exact, central = (
        greatest(Lift(OB=[0.20, 0.21]).sweep(2), lambda motion, method=method: -motion.ratio("psi", method=method))
        for method in ("exact", "central")
    )
    assert_allclose(central.value, exact.value, rtol=1e-8)


def test_a_single_pose_is_its_own_extreme():
    for motion in (Lift().at(S=0.6), Lift().at(S=[0.6]), Lift().sweep(1)):
        found = greatest(motion, lambda each: each.strokes["S"])
        assert found.value == found.strokes["S"] == float(np.ravel(motion.strokes["S"])[0])


def test_what_has_no_value_and_what_is_no_number():
    found = greatest(Lift().sweep(3), lambda motion: np.full(motion.shape, np.nan))
    assert np.isnan(found.value) and not found.unbounded and str(found) == "no value at any pose"
    assert np.isnan(greatest(Lift().at(S=[0.1, 0.2], unreachable="nan"), lambda motion: motion.strokes["S"]).value)
    assert lowest(Lift().sweep(3), of_stroke(lambda u: np.where(u > 0.5, np.inf, u))).value == 0.0
    assert lowest(Lift().sweep(3), lambda motion: np.full(motion.shape, np.inf)).value == np.inf
    with pytest.raises(DefinitionError, match=r"gives the shape \(3, 7\) where \(4097,\)"):
        greatest(Lift().sweep(3), lambda motion: np.zeros((3, 7)))


def test_a_function_is_shown_only_where_it_is_refused():
    class Silent:
        def __call__(self, motion):
            return motion["psi"]

        def __repr__(self):
            raise RuntimeError("not asked for")

    motion = Lift().at(S=np.linspace(0.5, 0.7, 11))
    assert greatest(motion, Silent()).value == greatest(motion, lambda each: each["psi"]).value


def test_in_words():
    assert str(greatest(Lift().sweep(2), lambda motion: motion.strokes["S"])) == "0.75 at S = 750.0 mm"
    assert str(greatest(Arm().sweep(2), lambda motion: motion.x("A") - motion.y("A"))) == "0.141421 at phi = 315.00 deg"
    assert greatest(Crane().at(u=[0.0, 1.0], v=[0.0, 0.25]), lambda motion: motion.strokes["u"]).where == "at u = 57.30 deg, v = 14.32 deg"
    pole = greatest(Lift().at(S=[0.6, 0.9], unreachable="nan"), lambda motion: np.abs(motion.ratio("psi")))
    assert str(pole) == "without bounds at S = 800.0 mm"
    both = greatest(Lift(OB=[0.20, 0.21]).sweep(2), lambda motion: motion.strokes["S"] * motion.inputs["OB"])
    assert str(both) == "0.15 to 0.1575 at S = 750.0 mm"


# -- ends and bounds -----------------------------------------------------------------------------------------


def test_an_extreme_at_the_edge_of_the_reach():
    motion = Lift().at(S=[0.3, 0.9], unreachable="nan")
    found = greatest(motion, lambda each: each.strokes["S"])
    assert found.value == pytest.approx(0.8, abs=1e-12) and not found.unbounded
    found = lowest(motion, lambda each: each.strokes["S"])
    assert found.value == pytest.approx(0.4, abs=1e-12)
    for look, S in ((greatest, 0.4), (lowest, 0.8)):  # the angle has an infinite slope there and is finite
        found = look(motion, lambda each: np.abs(each["psi"]))
        assert found.value == pytest.approx(np.pi if look is greatest else 0.0, abs=1e-5)
        assert found.strokes["S"] == pytest.approx(S, abs=1e-6) and not found.unbounded


@for_all("seed", range(2), slow=range(2, 20))
def test_a_narrow_top_cut_off_by_an_edge(seed):
    """Next to the edge of what has a value, on ground that falls towards it, higher than the ground by a fifth."""
    rng = np.random.default_rng(seed)
    place = (rng.integers(500, 3500) + rng.choice([0.99, rng.uniform()])) / 4096.0  # 0.99: nearly a step from the last sample
    rest = rng.uniform(0.0, 0.01) / 4096.0

    def f(u):
        ground = np.where(u > place - 0.004, 200.0 * (place - u), 0.0)
        return np.where(u > place + rest, np.nan, ground + np.maximum(0.0, 1.0 - np.abs(u - place) / (0.5 * WIDTH)))

    found = greatest(Lift().sweep(2), of_stroke(f))
    assert found.value == pytest.approx(1.0, abs=1e-6) and share(found) == pytest.approx(place, abs=1e-9)


def test_a_ratio_grows_beyond_bounds_up_to_a_dead_point():
    for S, sense in (([0.3, 0.6], -1.0), ([0.6, 0.9], 1.0)):
        found = greatest(Lift().at(S=S, unreachable="nan"), lambda each: np.abs(each.ratio("psi")))
        assert found.unbounded and found.value == np.inf
        assert found.strokes["S"] == pytest.approx(0.6 + 0.2 * sense, abs=1e-9)
        assert not lowest(Lift().at(S=S, unreachable="nan"), lambda each: np.abs(each.ratio("psi"))).unbounded
    found = greatest(Lift().at(S=[0.4, 0.8]), lambda each: np.abs(each.ratio("psi")))  # both ends to rounding, and no farther
    assert found.unbounded


def test_a_quotient_is_without_bounds_where_its_divisor_vanishes():
    def per_rise(motion):
        rise = motion.ratio("A")[1]
        return np.where(np.abs(rise) < 1e-6 * 0.1, np.nan, 1.0 / rise)

    for look, value in ((greatest, np.inf), (lowest, -np.inf)):
        found = look(Arm().at(phi=[0.1, 3.0]), per_rise)
        assert found.unbounded and found.value == value
        assert found.strokes["phi"] == pytest.approx(np.pi / 2, abs=1e-5)
    found = greatest(Arm().at(phi=[0.1, 1.5]), per_rise)
    assert found.value == pytest.approx(10.0 / np.cos(1.5), rel=1e-12) and not found.unbounded


@for_all("seed", range(2), slow=range(2, 60))
def test_poles_and_what_is_none(seed):
    """Poles of several orders on a moving ground, refused about them or at the end of the reach, against values that stay finite."""
    rng = np.random.default_rng(seed)
    place, order, size = rng.uniform(0.05, 0.95), rng.choice([0.5, 1.0, 1.5, 2.0]), 10.0 ** rng.uniform(-2, 2)
    near = 10.0 ** (rng.uniform(-12, -10) if order == 0.5 else rng.uniform(-7, -5.3))
    tilt, wave, soft = rng.normal(), rng.uniform(1.0, 20.0), 10.0 ** rng.uniform(-4, -1)

    def of(f, missing):
        def values(u):
            away = np.abs(u - place)
            with np.errstate(divide="ignore"):
                return np.where(missing(u, away), np.nan, f(away) + tilt * np.sin(wave * u))

        return greatest(Lift().sweep(2), of_stroke(values))

    about, behind = (lambda u, away: away < near), (lambda u, away: (away < near) | (u > place))
    for missing in (about, behind) if order > 0.5 else (behind,):
        found = of(lambda away: size * away**-order, missing)
        assert found.unbounded and found.value == np.inf and share(found) == pytest.approx(place, abs=1e-4)
        assert not of(lambda away: -size * away**-order, missing).unbounded
        assert not of(lambda away: size * away**order, missing).unbounded
        assert not of(lambda away: -size * away**order, missing).unbounded
        found = of(lambda away: size * (away + soft) ** -order, missing)
        assert not found.unbounded and found.value >= 0.99 * size * (soft + near) ** -order - abs(tilt)


# -- designs and quantities ----------------------------------------------------------------------------------


def test_every_design_has_its_own():
    OB = np.array([0.18, 0.22])
    functions = (
        lambda motion: motion.ratio("psi"),
        lambda motion: np.abs(motion["psi"] - 2.0),
        lambda motion: motion.transmission_angle("B"),
    )
    for f in functions:
        for look in (greatest, lowest):
            batch = look(Lift(OB=OB).at(S=[0.3, 0.9], unreachable="nan"), f)
            each = [look(Lift(OB=value).at(S=[0.3, 0.9], unreachable="nan"), f) for value in OB]
            assert_allclose(batch.value, [one.value for one in each], rtol=1e-13, atol=1e-13)
            assert_allclose(batch.strokes["S"], [one.strokes["S"] for one in each], atol=1e-7)
            assert batch.unbounded.tolist() == [one.unbounded for one in each]


def test_designs_in_two_axes_and_numbers_of_each_beside_them():
    OB, x = np.array([[0.18], [0.20]]), np.array([0.58, 0.60, 0.62])
    share_of_each = np.array([[0.1, 0.2, 0.3], [0.4, 0.5, 0.6]])[..., None]
    found = greatest(Lift(OB=OB, O=(x, 0.0)).sweep(3), lambda motion: -np.abs(motion.strokes["S"] - 0.5 - 0.25 * share_of_each))
    assert found.value.shape == (2, 3) and found.unbounded.shape == (2, 3)
    assert_allclose(found.strokes["S"], 0.5 + 0.25 * share_of_each[..., 0], atol=1e-9)


def test_several_quantities_at_once():
    def all_three(motion):
        return np.array([motion.ratio("psi"), motion["psi"] * motion.strokes["S"], motion.y("B")])

    batch = Lift(OB=[0.19, 0.20, 0.21]).sweep(2)
    together = greatest(batch, all_three)
    assert together.value.shape == together.strokes["S"].shape == (3, 3)
    for row in range(3):
        alone = greatest(batch, lambda motion, row=row: all_three(motion)[row])
        assert_allclose(together.value[row], alone.value, rtol=1e-13)
        assert_allclose(together.strokes["S"][row], alone.strokes["S"], atol=1e-7)


def test_requests_are_asked_in_bulk():
    def in_bulk(motion):
        return evaluate_grid(motion._grid, [ratio("psi")], None, QUICKEST, "nan")[0]

    for S in ([0.5, 0.75], [0.3, 0.9]):
        batch = Lift(OB=[0.19, 0.20, 0.21]).at(S=S, unreachable="nan")
        found, other = (lowest(batch, f) for f in (in_bulk, lambda motion: motion.ratio("psi")))
        assert_allclose(found.value, other.value, rtol=1e-13)
        assert_allclose(found.strokes["S"], other.strokes["S"], atol=1e-7)


class Triad(Mechanism):
    """A platform on three rods, one of them on a crank: a class III group."""

    phi = Stroke(0.0, 0.6)
    O, P, Q = Ground(0, 0), Ground(3, 0), Ground(1.5, 3)
    A = Crank(O, OA=0.5, angle=phi)
    body = Link("D E F", DE=1, DF=0.9, EF=0.8)
    r1, r2, r3 = Link("A D", AD=0.8), Link("P E", PE=1.0), Link("Q F", QF=1.9)
    D, E, F = Pin(near=(1.2, 0.5)), Pin(near=(2.2, 0.5)), Pin(near=(1.6, 1.3))


def test_designs_of_a_group():
    OA = np.array([0.45, 0.50, 0.55])
    f = lambda motion: -((motion.y("E") - motion.y("F") + 0.62) ** 2)  # noqa: E731
    batch = greatest(Triad(OA=OA).sweep(3), f)
    for row, value in enumerate(OA):
        alone = greatest(Triad(OA=value).sweep(3), f)
        assert batch.value[row] == pytest.approx(alone.value, abs=1e-12)
        assert_allclose(f(Triad(OA=value).at(phi=batch.strokes["phi"][row])), batch.value[row], atol=1e-12)


# -- along paths ---------------------------------------------------------------------------------------------


def height(motion):
    """Return the height of B, 2 sin u + sin(u + v)."""
    return motion.y("B")


@pytest.mark.parametrize("count", [3, 50, 500])
def test_a_straight_path_from_however_many_poses(count):
    ends = {"u": (0.9, 0.1), "v": (0.1, 0.9)}
    first, other = (greatest(Crane().at(**{name: np.linspace(*each, n) for name, each in ends.items()}), height) for n in (2, count))
    assert (first.value, first.strokes) == (other.value, other.strokes)
    unevenly = {name: low + (high - low) * np.array([0.0, 0.1, 0.1, 0.7, 1.0]) for name, (low, high) in ends.items()}
    found = greatest(Crane().at(**unevenly), height)
    assert (found.value, found.strokes["u"]) == pytest.approx((first.value, first.strokes["u"]), abs=1e-9)


def test_a_path_is_followed_leg_by_leg():
    u, v = np.array([0.0, 0.8, 0.8, 0.2]), np.array([0.0, 0.2, 1.0, 0.6])
    found = greatest(Crane().at(u=u, v=v), height)
    t = np.linspace(0.0, 1.0, 200_001)
    dense = [2.0 * np.sin(a) + np.sin(a + b)
             for a, b in (((u[k] + (u[k + 1] - u[k]) * t), (v[k] + (v[k + 1] - v[k]) * t)) for k in range(3))]  # fmt: skip
    assert found.value == pytest.approx(np.max(dense), abs=1e-9)
    held = greatest(Crane().sweep(u=0.3, v=5), height)
    assert held.value == pytest.approx(2.0 * np.sin(0.3) + np.sin(1.3)) and held.strokes["u"] == 0.3


@for_all("seed", range(2), slow=range(2, 30))
def test_a_narrow_top_anywhere_on_a_path(seed):
    """The path turns, stands, and goes back on itself; the top is 1/2000 of the way's range wide."""
    rng = np.random.default_rng(seed)
    corners = rng.uniform(0.0, 1.0, (2, int(rng.integers(2, 6))))
    corners[:, 0], corners[:, 1] = 0.0, 1.0  # over the whole of both
    motion = Crane().at(u=np.repeat(corners[0], 2), v=np.repeat(corners[1], 2))
    leg, t = int(rng.integers(0, corners.shape[1] - 1)), rng.uniform()
    u, v = corners[:, leg] + (corners[:, leg + 1] - corners[:, leg]) * t

    def f(each):
        away = np.maximum(np.abs(each.strokes["u"] - u), np.abs(each.strokes["v"] - v))
        return np.maximum(0.0, 1.0 - away / (0.5 * WIDTH))

    found = greatest(motion, f)
    assert found.value == pytest.approx(1.0, abs=1e-6)
    assert (found.strokes["u"], found.strokes["v"]) == pytest.approx((u, v), abs=1e-4)


def test_a_round_path_keeps_its_poses():
    turn = np.linspace(0.0, 2.0 * np.pi, 401)
    motion = Crane().at(u=0.5 + 0.5 * np.cos(turn), v=0.5 + 0.5 * np.sin(turn))
    found = greatest(motion, height)
    dense = np.linspace(0.0, 2.0 * np.pi, 1_000_001)
    u, v = 0.5 + 0.5 * np.cos(dense), 0.5 + 0.5 * np.sin(dense)
    assert found.value == pytest.approx(np.max(2.0 * np.sin(u) + np.sin(u + v)), abs=1e-4)  # chords lie inside the circle
    assert found.value >= np.max(height(motion))


def test_the_way_of_a_path_is_known_at_every_pose():
    """What follows from the direction of travel jumps where a path turns; the larger side counts."""
    motion = Crane().at(u=[0.0, 1.0, 0.4], v=[0.5, 0.2, 0.2])

    def against(each):
        return np.sign(each.tangent["u"]) * each.strokes["u"]

    assert greatest(motion, against).value == 1.0
    found = lowest(motion, against)
    assert (found.value, found.strokes) == (-1.0, {"u": 1.0, "v": 0.2})
    np.testing.assert_array_equal(np.sign(motion.tangent["u"]), [1.0, -1.0, -1.0])
    assert Lift().sweep(3).tangent is None and Crane().sweep(u=3, v=4).tangent is None


# -- over boxes ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("counts", [(2, 2), (5, 7)])
def test_over_a_box(counts):
    motion = Crane().sweep(u=counts[0], v=counts[1])
    found = greatest(motion, height)  # 2 sin u + sin(u + v): u = 1, and u + v = pi / 2
    assert found.value == pytest.approx(2.0 * np.sin(1.0) + 1.0, rel=1e-12)
    assert (found.strokes["u"], found.strokes["v"]) == pytest.approx((1.0, np.pi / 2 - 1.0), abs=1e-5)
    assert not found.unbounded and found.where == "at u = 57.30 deg, v = 32.70 deg"
    found = lowest(motion, lambda each: np.abs(each.strokes["u"] - 0.3) + np.maximum(0.0, each.strokes["v"] - 0.2))
    assert found.value == pytest.approx(0.0, abs=1e-9)


def test_a_box_of_several_designs():
    AB = np.array([0.8, 1.0, 1.2])
    f = lambda each: each.y("B") + 0.3 * each.x("B") * each.strokes["v"]  # noqa: E731
    batch = greatest(Crane(AB=AB).sweep(u=3, v=3), f)
    for row, value in enumerate(AB):
        alone = greatest(Crane(AB=value).sweep(u=3, v=3), f)
        assert batch.value[row] == pytest.approx(alone.value, rel=1e-12)
        assert batch.strokes["v"][row] == pytest.approx(alone.strokes["v"], abs=1e-5)


def test_bounds_over_a_box():
    def per_rise(motion):
        rise = motion.ratio("B", wrt="v")[1]  # cos(u + v)
        return np.where(np.abs(rise) < 1e-6, np.nan, 1.0 / rise)

    found = greatest(Crane().sweep(u=3, v=3), per_rise)
    assert found.unbounded and found.strokes["u"] + found.strokes["v"] == pytest.approx(np.pi / 2, abs=1e-4)
    found = greatest(Crane().at(u=[[0.0], [0.5]], v=[[0.0, 0.8]]), per_rise)
    assert not found.unbounded and found.value == pytest.approx(1.0 / np.cos(1.3), rel=1e-9)


# -- ranges --------------------------------------------------------------------------------------------------


def ends(spans, name):
    """Return the ends of spans along a stroke."""
    return np.ravel([(each.start[name], each.end[name]) for each in spans])


@settings(deadline=None, max_examples=12)
@given(place=st.floats(0.0, 1.0 - WIDTH), wide=st.floats(1e-9, 0.3))
def test_a_range_below_zero_anywhere(place, wide):
    """Even one that no sample sees, if it belongs to a dip."""
    middle = min(place + 0.5 * wide, 1.0)
    spans = below_zero(Lift().sweep(2), of_stroke(lambda u: np.abs(u - middle) - 0.5 * wide))
    expected = [max(0.0, middle - 0.5 * wide), min(1.0, middle + 0.5 * wide)]
    assert_allclose(ends(spans, "S"), 0.5 + 0.25 * np.array(expected), atol=1e-12)
    above = below_zero(Lift().sweep(50), of_stroke(lambda u: 0.5 * wide - np.abs(u - middle)))
    rest = [each for low, high in ((0.0, expected[0]), (expected[1], 1.0)) if high > low for each in (low, high)]
    assert_allclose(ends(above, "S"), 0.5 + 0.25 * np.array(rest), atol=1e-12)


@for_all("seed", range(2), slow=range(2, 20))
def test_ranges_of_broken_lines(seed):
    rng = np.random.default_rng(seed)
    x, y = pieces(rng, 1.0 / 1900.0, 600)
    spans = below_zero(Lift().sweep(2), of_stroke(lambda u: np.interp(u, x, y)))
    change = np.flatnonzero(np.sign(y[1:]) != np.sign(y[:-1]))
    roots = x[change] - y[change] * (x[change + 1] - x[change]) / (y[change + 1] - y[change])
    roots = np.concatenate([[0.0] if y[0] < 0.0 else [], roots, [1.0] if y[-1] < 0.0 else []])
    assert_allclose(ends(spans, "S"), 0.5 + 0.25 * roots, atol=1e-12)


def test_ranges_end_at_jumps_and_where_there_is_no_value():
    spans = below_zero(Lift().sweep(2), of_stroke(lambda u: np.where(u < 1.0 / 3.0, -1.0, np.where(u < 0.7, 1.0, np.nan))))
    assert_allclose(ends(spans, "S"), [0.5, 0.5 + 0.25 / 3.0], atol=1e-12)
    spans = below_zero(Lift().at(S=[0.3, 0.9], unreachable="nan"), lambda motion: 0.7 - motion.strokes["S"])
    assert_allclose(ends(spans, "S"), [0.7, 0.8], atol=1e-12)
    assert_allclose(ends(reached_spans(Lift().at(S=[0.9, 0.3], unreachable="nan")), "S"), [0.4, 0.8], atol=1e-12)
    assert reached_spans(Lift().at(S=[0.1, 0.2], unreachable="nan")) == ()
    assert str(below_zero(Lift().sweep(2), lambda motion: motion.strokes["S"] - 0.566)[0]) == "from S = 500.0 to 566.0 mm"


def test_ranges_along_a_path():
    motion = Crane().at(u=[0.0, 1.0, 1.0], v=[0.1, 0.1, 0.5])
    (first, last) = below_zero(motion, lambda each: (each.strokes["u"] - 0.25) * (0.4 - each.strokes["v"]))
    assert first.start == {"u": 0.0, "v": 0.1}
    assert (first.end["u"], first.end["v"]) == pytest.approx((0.25, 0.1), abs=1e-12)
    assert (last.start["u"], last.start["v"], last.end["v"]) == pytest.approx((1.0, 0.4, 0.5), abs=1e-12)
    assert str(first) == "from u = 0.00 to 14.32 deg (v = 5.73 deg)"
    (whole,) = below_zero(motion, lambda each: -np.ones(each.shape))
    assert str(whole) == "from u = 0.00 deg, v = 5.73 deg to u = 57.30 deg, v = 28.65 deg"
    with pytest.raises(DefinitionError, match="one design along one stroke or one path"):
        below_zero(Crane().sweep(u=3, v=3), height)


# -- least transmission angles -------------------------------------------------------------------------------


class FourBar(Mechanism):
    phi = Stroke(0.0, 2 * np.pi)
    O, C = Ground(0, 0), Ground(4, 0)
    A = Crank(O, OA=1, angle=phi)
    B = Dyad(A, C, AB=3, CB=2.5, side=LEFT)


@settings(deadline=None, max_examples=12)
@given(short=st.floats(1e-7, 0.4))
def test_the_least_transmission_angle_of_a_four_bar(short):
    """At the crank in line with the frame, by the law of cosines, however near to folding: then it dips sharply."""
    reach = 1.0 + 4.0 + short
    machine = FourBar(AB=0.55 * reach, CB=0.45 * reach)
    (least,) = machine.sweep(3).limits()["phi"].transmission

    def at(AC):
        mu = np.arccos(((0.55 * reach) ** 2 + (0.45 * reach) ** 2 - AC**2) / (2 * 0.55 * 0.45 * reach**2))
        return min(mu, np.pi - mu)

    expected = {np.pi: at(5.0), 0.0: at(3.0)}
    place = min(expected, key=expected.get)
    assert least.angle == pytest.approx(expected[place], abs=1e-6)
    assert np.cos(least.stroke - place) == pytest.approx(1.0, abs=1e-7)


def test_the_least_transmission_angle_at_an_end_of_the_reach():
    (least,) = Lift().sweep(2).limits()["S"].transmission
    mu = lambda S: np.arccos((S**2 + 0.20**2 - 0.60**2) / (2 * S * 0.20))  # noqa: E731
    assert least.angle == pytest.approx(min(mu(0.75), np.pi - mu(0.5)), abs=1e-12)
    assert least.stroke == (0.75 if mu(0.75) < np.pi - mu(0.5) else 0.5)


# -- the function itself -------------------------------------------------------------------------------------


@pytest.mark.parametrize("shape", [(3,), (2, 3), (4, 1)])
def test_function_gives_a_number_for_each_pose(shape):
    for ask in (greatest, lowest, below_zero):
        with pytest.raises(DefinitionError, match=r"a function of a motion gives the shape .* return a number for each pose"):
            ask(Lift().sweep(5), lambda motion: np.zeros(shape))


def test_function_may_be_one_number_for_all_poses():
    assert greatest(Lift().sweep(5), lambda motion: 3.0).value == 3.0
    assert lowest(Lift(OB=np.array([0.2, 0.21])).sweep(5), lambda motion: -2.0).value.tolist() == [-2.0, -2.0]


@pytest.mark.parametrize("settings", [{}, {"OB": np.array([0.20, 0.21, 0.22])}], ids=["one", "several"])
def test_function_may_look_at_the_same_poses_again(settings):
    """A motion moved to its own strokes is itself, also where every design is looked at in places of its own."""
    motion = Lift(**settings).sweep(5)
    direct = greatest(motion, lambda each: each.distance("A", "B") - 4.0 * (each["psi"] - 2.5) ** 2)
    again = greatest(motion, lambda each: each.distance("A", "B") - 4.0 * (each.moved(each.strokes)["psi"] - 2.5) ** 2)
    assert_allclose(again.value, direct.value, rtol=1e-12)
    assert_allclose(again.strokes["S"], direct.strokes["S"], rtol=1e-6)


def test_function_may_be_infinite():
    """Infinite everywhere, of either sign, it is so at its greatest and its lowest; where it is finite somewhere that counts."""
    for sign in (1.0, -1.0):
        for ask in (greatest, lowest):
            assert ask(Lift().sweep(5), lambda motion, sign=sign: np.full(motion.shape, sign * np.inf)).value == sign * np.inf
    partly = greatest(Lift().sweep(5), lambda motion: np.where(motion.strokes["S"] > 0.6, -np.inf, motion.strokes["S"]))
    assert partly.value == pytest.approx(0.6, abs=1e-6)


@pytest.mark.parametrize("f", [lambda u: u, lambda u: -u, lambda u: np.sqrt(1.0 - u), lambda u: np.sin(9.0 * u) - 20.0 * u])
def test_a_top_at_an_end_is_found_in_few_looks(f):
    looks = []

    def counted(u):
        looks.append(u.size)
        return f(u)

    found = greatest(Lift().sweep(2), of_stroke(counted))
    assert found.value == max(f(np.array(0.0)), f(np.array(1.0)))
    assert len(looks) <= 4
