"""Zones over boxes of settings and settings by roots, against known functions, dense samples and the eager motion."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose, assert_array_equal

from linkage import LEFT, Crank, DefinitionError, Dyad, Ground, Link, Mechanism, Pin, Stroke, angle, deg, ref, x
from linkage.motion import each_at_its_stroke
from linkage.study import Box, settings_for, zone
from linkage.study.settings import SettingsBox, extremes
from mechanisms.classics.four_bar import FourBar
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all

BOX = {"MK": (0.80, 0.96), "CD": (0.56, 0.68), "FK": (0.61, 0.685), "M": [(0.22, 1.05), (0.22, 0.95)]}


def ratio(motion):
    return motion.ratio("G")[1]


def sampled(over, count, seed):
    """Return a batch of random settings of a box."""
    random = np.random.default_rng(seed)
    found = {name: random.uniform(*pair, count) for name, pair in over.items() if isinstance(pair, tuple)}
    for name, choices in over.items():
        if isinstance(choices, list):
            found[name] = tuple(np.array(choices)[random.integers(0, len(choices), count)].T)
    return found


# -- one pose for each design ------------------------------------------------------------------------------


@pytest.mark.slow
def test_paired_is_the_motion_of_each_design():
    over = sampled({**BOX, "MK": (0.5, 0.96)}, 60, 1)
    S = np.random.default_rng(2).uniform(0.0, 0.25, 60)
    hitch = ThreePointHitch(**over)
    together = each_at_its_stroke(hitch.plan, hitch.dimensions, {"S": S})
    assert 0 < together.reached.sum() < 60
    for place in range(60):
        one = {name: tuple(part[place] for part in value) if isinstance(value, tuple) else value[place] for name, value in over.items()}
        alone = ThreePointHitch(**one).at(S=S[place], unreachable="nan")
        assert bool(alone.reached) == bool(together.reached[place])
        assert_allclose(together["G"][:, place], alone["G"], rtol=1e-13)
        assert_allclose(together["tilt"][place], alone["tilt"], rtol=1e-13, atol=1e-13)
        assert_allclose(together.ratio("G")[:, place], alone.ratio("G"), rtol=1e-11)


class Triad(Mechanism):
    """A coupler BFG on a crank, a rocker and a second crank: its pins are found together by Newton."""

    phi = Stroke(0.0, 40 * deg)
    O, E = Ground(0.0, 0.0), Ground(0.2, 0.0)
    A = Crank(O, OA=0.05, angle=60 * deg + phi)
    D = Crank(O, OD=0.04, angle=130 * deg + phi)
    near_rod, far_rod = Link("A B", AB=0.10), Link("D F", DF=0.12)
    floating, rocker = Link("B F G", BF=0.06, BG=0.10, FG=0.13), Link("E G", EG=0.11)
    B, F, G = Pin(near=(0.124, 0.053)), Pin(near=(0.078, 0.091)), Pin(near=(0.207, 0.110))


def test_paired_finds_the_pins_of_groups():
    assert Triad.plan.groups
    lengths, phi = np.array([0.100, 0.101, 0.102]), np.array([0.0, 0.2, 0.5])
    together = each_at_its_stroke(Triad.plan, Triad(AB=lengths).dimensions, {"phi": phi})
    for place, (length, stroke) in enumerate(zip(lengths, phi, strict=True)):
        alone = Triad(AB=length).at(phi=stroke)
        assert_allclose(together["G"][:, place], alone["G"], rtol=1e-10)
        assert_allclose(together.ratio("G")[:, place], alone.ratio("G"), rtol=1e-8)


@pytest.mark.slow
def test_zone_of_a_machine_with_a_group():
    found = zone(Triad(), lambda motion: motion.y("G"), {"AB": (0.098, 0.102)}, phi=[0.0, 0.3])
    direct = Triad(AB=np.linspace(0.098, 0.102, 41)).at(phi=[0.0, 0.3]).y("G")
    assert_allclose(found.low, direct.min(axis=0), rtol=1e-10)
    assert_allclose(found.high, direct.max(axis=0), rtol=1e-10)


# -- the search, on functions whose extremes are known -----------------------------------------------------


def test_extremes_inside_on_edges_and_in_corners():
    centre = np.array([[0.3, 0.7], [0.3, 1.4], [-1.0, 2.0]])
    (least, _), unit, *_ = extremes(lambda task, unit, choice: ((unit - centre[task]) ** 2).sum(axis=1), 3, 2, 1)
    assert_allclose(unit[0], [[0.3, 0.7], [0.3, 1.0], [0.0, 1.0]], rtol=0, atol=1e-7)
    assert_allclose(least, [0.0, 0.16, 2.0], rtol=0, atol=1e-13)
    assert_array_equal(unit[1], [[1.0, 0.0], [1.0, 0.0], [1.0, 0.0]])


def test_extreme_in_a_curved_valley():
    """Rosenbrock's banana, its bottom at (0.6, 0.36)."""
    found = extremes(lambda task, unit, choice: (0.6 - unit[:, 0]) ** 2 + 100 * (unit[:, 1] - unit[:, 0] ** 2) ** 2, 1, 2, 1)
    (least, _), unit, *_ = found
    assert_allclose(unit[0, 0], [0.6, 0.36], rtol=0, atol=1e-5)
    assert least[0] < 1e-10


@pytest.mark.slow
@settings(deadline=None, max_examples=15)
@given(st.integers(1, 4), st.integers(0, 2**32 - 1))
def test_no_sample_beats_the_extremes_of_a_smooth_function(k, seed):
    random = np.random.default_rng(seed)
    A, b, c = random.normal(size=(k, k)), random.normal(size=k), random.uniform(0.5, 1.5, k)

    def f(task, unit, choice):
        return np.einsum("mi,ij,mj->m", unit, A, unit) + unit @ b + np.sin(2.0 * unit @ c)

    (least, most), *_ = extremes(f, 1, k, 1)
    samples = f(0, random.uniform(size=(4000, k)), 0)
    assert least[0] <= samples.min() + 1e-12
    assert most[0] >= samples.max() - 1e-12


def test_gaps_of_a_function_are_passed_over():
    (least, _), *_, seen = extremes(lambda task, unit, choice: np.where(unit[:, 0] < 0.35, np.nan, unit[:, 0]), 1, 2, 1)
    assert least[0] == pytest.approx(0.35, abs=1e-7)
    assert 0.0 < np.isnan(seen).mean() < 0.5
    nothing, *_ = extremes(lambda task, unit, choice: np.full(len(unit), np.nan), 2, 2, 1)
    assert np.isnan(nothing).all()


def test_a_search_counts_the_settings_that_it_looks_at():
    """By their number it ends where a function is too rough."""
    seen = []
    box = SettingsBox(lambda task, unit, choice: seen.append(len(unit)) or unit[:, 0], 2, 2, 3)
    box.values(np.array([0, 5]), np.full((2, 7, 2), 0.5))
    assert box.count == sum(seen) > 14


# -- zones ---------------------------------------------------------------------------------------------------


def test_least_tilt_is_inside_the_box_and_not_at_a_corner():
    """At S = 0.125 m: 0.232 deg inside, 0.263 deg at the corners (the paper's figure 2 on the illustrative set)."""
    found = zone(ThreePointHitch(), "tilt", BOX, S=[0.125])
    corners = [
        float(np.degrees(ThreePointHitch(MK=MK, CD=CD, FK=FK, M=M).at(S=0.125)["tilt"]))
        for MK in BOX["MK"] for CD in BOX["CD"] for FK in BOX["FK"] for M in BOX["M"]
    ]  # fmt: skip
    assert f"{np.degrees(found.low[0]):.3f} {min(corners):.3f}" == "0.232 0.263"
    assert 0.61 < found.low_at["FK"][0] < 0.685
    assert found.high[0] >= np.radians(max(corners)) - 1e-12


@pytest.mark.parametrize("quantity", ["tilt", ratio])
def test_no_random_sample_beats_the_zone(quantity):
    S = np.linspace(0.0, 0.25, 11)
    found = zone(ThreePointHitch(), quantity, BOX, S=S)
    motion = ThreePointHitch(**sampled(BOX, 20_000, 3)).at(S=S)
    samples = motion[quantity] if isinstance(quantity, str) else quantity(motion)
    assert (found.low <= samples.min(axis=0)).all() and (samples.max(axis=0) <= found.high).all()
    assert (samples.min(axis=0) - found.low < 0.03 * (found.high - found.low)).all()


def test_zone_over_five_ranges():
    over = {"MK": (0.84, 0.92), "CD": (0.60, 0.66), "FK": (0.65, 0.70), "OB": (0.29, 0.31), "M.y": (1.0, 1.05)}
    found = zone(ThreePointHitch(), ratio, over, S=[0.0, 0.2])
    samples = ratio(ThreePointHitch(**sampled(over, 30_000, 4)).at(S=[0.0, 0.2]))
    assert (found.low <= samples.min(axis=0)).all() and (samples.max(axis=0) <= found.high).all()


def test_zone_is_that_of_a_dense_line():
    found = zone(ThreePointHitch(), "tilt", {"FK": (0.5, 0.9)}, S=[0.0, 0.1, 0.25])
    line = ThreePointHitch(FK=np.linspace(0.5, 0.9, 20_001)).at(S=[0.0, 0.1, 0.25])["tilt"]
    assert_allclose(found.low, line.min(axis=0), rtol=0, atol=1e-9)
    assert_allclose(found.high, line.max(axis=0), rtol=0, atol=1e-9)


def test_settings_of_a_zone_give_its_values():
    S = np.array([0.0, 0.125, 0.25])
    found = zone(ThreePointHitch(), "tilt", BOX, S=S)
    for at, values in ((found.low_at, found.low), (found.high_at, found.high)):
        for place, stroke in enumerate(S):
            one = {name: tuple(part[place] for part in value) if isinstance(value, tuple) else value[place] for name, value in at.items()}
            assert ThreePointHitch(**one).at(S=stroke)["tilt"] == pytest.approx(values[place], abs=1e-13)


def test_zone_is_the_union_of_its_choices():
    S = np.linspace(0.0, 0.25, 6)
    whole = zone(ThreePointHitch(), "tilt", BOX, S=S)
    parts = [zone(ThreePointHitch(), "tilt", {**BOX, "M": [hole]}, S=S) for hole in BOX["M"]]
    assert_array_equal(whole.low, np.minimum(parts[0].low, parts[1].low))
    assert_array_equal(whole.high, np.maximum(parts[0].high, parts[1].high))


def test_zone_is_deterministic():
    one, two = (zone(ThreePointHitch(), ratio, BOX, S=[0.0, 0.1]) for _ in range(2))
    assert_array_equal([one.low, one.high], [two.low, two.high])


def test_choices_alone_and_no_setting_at_all():
    motions = [ThreePointHitch(M=hole).sweep(3)["tilt"] for hole in BOX["M"]]
    found = zone(ThreePointHitch(), "tilt", {"M": BOX["M"]}, S=[0.0, 0.125, 0.25])
    assert_allclose([found.low, found.high], [np.minimum(*motions), np.maximum(*motions)], rtol=1e-14)
    alone = zone(ThreePointHitch(), "tilt", {}, S=0.1)
    assert alone.low.shape == () and alone.low == alone.high == pytest.approx(float(ThreePointHitch().at(S=0.1)["tilt"]))


def test_default_strokes_are_the_whole_stroke():
    found = zone(ThreePointHitch(), "tilt", {"MK": (0.85, 0.9)})
    assert (len(found.low), found.strokes["S"][0], found.strokes["S"][-1]) == (51, 0.0, 0.25)


WIDE = {"MK": (0.3, 0.96), "CD": (0.3, 0.68)}


@cache
def wide_zone():
    return zone(ThreePointHitch(), "tilt", WIDE, S=[0.0, 0.1, 0.2])


def test_what_cannot_be_assembled_is_masked_and_told():
    found = wide_zone()
    direct = ThreePointHitch(**sampled(WIDE, 4_000, 5)).at(S=[0.0, 0.1, 0.2], unreachable="nan")
    assert not found.complete.any() and (found.reached > 0.5).all()
    assert (found.low <= np.nanmin(direct["tilt"], axis=0)).all() and (np.nanmax(direct["tilt"], axis=0) <= found.high).all()
    (text,) = found.remarks
    assert "of 169 settings looked at (S = 0.0 to 200.0 mm), such as MK = 300 mm, CD = 300 mm, cannot be assembled" in text
    assert "mm short of" in text


def test_angles_do_not_jump_inside_a_zone():
    """The mast may turn past 90 deg of tilt, where its direction passes 180 deg: the zone goes on."""
    assert wide_zone().high[-1] > np.pi / 2


def test_nothing_reachable_gives_no_zone_but_a_sentence():
    found = zone(ThreePointHitch(), "tilt", {"MK": (0.1, 0.2)}, S=[0.0, 0.1])
    assert np.isnan(found.low).all() and np.isnan(found.high).all() and not found.reached.any()
    assert "33 of 33 settings looked at" in found.remarks[0]


def test_a_quantity_without_a_value_is_told():
    def positive_tilt(motion):
        return np.where(motion["tilt"] > 0.0, motion["tilt"], np.nan)

    found = zone(ThreePointHitch(), positive_tilt, {"MK": (0.8, 1.0)}, S=[0.0])
    assert found.low[0] == pytest.approx(0.0, abs=1e-8)
    assert "have no value of positive tilt and are left out of the zone" in found.remarks[0]


@for_all(
    ("over", "words"),
    [
        ({"ZZ": (0.1, 0.2)}, "'ZZ' is unknown"),
        ({"MK": (0.96, 0.80)}, "is no range"),
        ({"MK": (0.8, 0.9, 1.0)}, "is no range"),
        ({"MK": (-0.1, 0.9)}, "is negative"),
        ({"MK": (0.8, float("nan"))}, "is no range"),
        ({"M": []}, "write a range"),
        ({"M": "up"}, "write a range"),
        ({"M": [(0.2,)]}, "two coordinates"),
        ({"AB": (0.5, 0.6)}, "AB follows"),
        ({"MK": (0.8, 0.9), "KM": (0.8, 0.9)}, "MK and KM both set MK"),
        ({"M.x": (0.2, 0.3), "M": [(0.22, 1.05), (0.22, 0.95)]}, "M.x and M both set M.x"),
        (None, "a dictionary of ranges and choices"),
        ({name: (0.3, 0.31) for name in ("L0", "OB", "OC", "BC", "ED", "CD", "EF", "MK", "FK")}, "9 ranges are too many"),
    ],
)
def test_a_box_that_cannot_be_is_refused(over, words):
    with pytest.raises(DefinitionError, match=words):
        zone(ThreePointHitch(), "tilt", over)


def test_studies_refuse_batches_and_vectors():
    with pytest.raises(DefinitionError, match="starts from one design"):
        zone(ThreePointHitch(OB=[0.29, 0.30]), "tilt", {"MK": (0.8, 0.9)})
    with pytest.raises(DefinitionError, match="has the shape"):
        zone(ThreePointHitch(), "G", {"MK": (0.8, 0.9)})
    with pytest.raises(DefinitionError, match="ThreePointHitch is a class"):
        zone(ThreePointHitch, "tilt", {"MK": (0.8, 0.9)})
    with pytest.raises(DefinitionError, match="ThreePointHitch is a class"):
        Box.of(ThreePointHitch, {"MK": (0.8, 0.9)})
    with pytest.raises(DefinitionError, match="no strokes to look at; give at least one value of S"):
        zone(ThreePointHitch(), "tilt", {"MK": (0.8, 0.9)}, S=[])


# -- settings --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("S", [0.0, 0.1, 0.25])
def test_setting_is_the_closed_form(S):
    """The mast FK stands upright with MK = |F + (0, FK) - M|."""
    hitch = ThreePointHitch()
    found = settings_for(hitch, "MK", "tilt", 0.0, between=(0.4, 2.0), unit="deg", S=S)
    expected = np.hypot(*(hitch.at(S=S)["F"] + [0.0, hitch["FK"]] - hitch["M"]))
    assert found.values == pytest.approx([expected], abs=1e-13)
    assert found.sentence == f"tilt = 0 deg with MK = {expected * 1e3:.6g} mm."


def test_all_settings_are_found():
    """A parabola and a cubic of the setting, through an output: two roots, three, one that only touches."""
    hitch = ThreePointHitch()

    def of(polynomial):
        return lambda motion: polynomial(motion.inputs["MK"]) + 0.0 * motion.y("F")

    def roots(polynomial, target=0.0):
        return settings_for(hitch, "MK", of(polynomial), target, between=(0.7, 1.1), S=0.1).values

    assert roots(lambda m: (m - 0.8) * (m - 1.0)) == pytest.approx([0.8, 1.0], abs=1e-13)
    assert roots(lambda m: (m - 0.8) * (m - 0.85) * (m - 1.0)) == pytest.approx([0.8, 0.85, 1.0], abs=1e-13)
    assert roots(lambda m: 1.0 + (m - 0.9123) ** 2, target=1.0) == pytest.approx([0.9123], abs=1e-7)
    assert roots(lambda m: (m - 0.7) * (m - 1.1)) == pytest.approx([0.7, 1.1], abs=1e-13)
    assert roots(lambda m: 1.0 / (m - 0.9)) == ()


def test_no_setting_is_said():
    hitch = ThreePointHitch()
    found = settings_for(hitch, "MK", "tilt", 100 * deg, between=(0.4, 2.0), unit="deg", S=0.1)
    assert found.values == ()
    assert found.sentence.startswith("No MK between 400 mm and 2000 mm gives tilt = 100 deg: it can be assembled from 443.")
    nowhere = settings_for(hitch, "MK", "tilt", 0.0, between=(0.1, 0.2), unit="deg", S=0.1)
    assert "No MK between 100 mm and 200 mm can be assembled there" in nowhere.sentence


def test_settings_without_end_are_told_by_their_ends():
    """What does not hang on the setting, or not on a stretch of it, is met all along."""
    there = {"between": (0.8, 1.0), "S": 0.1}
    still = settings_for(ThreePointHitch(), "MK", x("A"), 0.2, **there)
    assert (still.values, still.sentence) == ((0.8, 1.0), "x(A) = 200 mm with MK = 800 mm to 1000 mm.")
    clipped = settings_for(ThreePointHitch(), "MK", np.maximum(ref("tilt"), 0.1), 0.1, **there)
    edge = settings_for(ThreePointHitch(), "MK", "tilt", 0.1, **there).values[0]
    assert clipped.values == (pytest.approx(edge, abs=2e-4), 1.0)


def test_setting_beside_the_end_of_reach():
    """Where the link is just long enough: between the last setting that reaches and its neighbour on the samples."""

    class Held(ThreePointHitch):
        S = Stroke(0.1, 0.1 + 1e-7)  # a setting has to reach over the whole stroke

    hitch = Held()
    end = float(hitch.at(S=0.1).distance("M", "F")) - hitch["FK"]
    wanted = float(hitch.replaced(MK=end + 1e-6).at(S=0.1)["tilt"])
    found = settings_for(hitch, "MK", "tilt", wanted, between=(0.4, 2.0), S=0.1)
    assert found.values == pytest.approx([end + 1e-6], abs=1e-9)
    assert str(found).startswith(f"tilt = {wanted / deg:.6g} deg with MK = ")  # its own unit, where none is said


def test_settings_want_a_pose_and_a_range():
    with pytest.raises(DefinitionError, match=r"say the pose, S=\.\.\."):
        settings_for(ThreePointHitch(), "MK", "tilt", between=(0.4, 2.0))
    with pytest.raises(DefinitionError, match="is no range"):
        settings_for(ThreePointHitch(), "MK", "tilt", between=(2.0, 0.4), S=0.1)
    with pytest.raises(DefinitionError, match=r"between=0\.4 is no range"):
        settings_for(ThreePointHitch(), "MK", "tilt", between=0.4, S=0.1)


@pytest.mark.parametrize(("target", "S"), [("5", 0.1), (float("nan"), 0.1), (None, 0.1), (0.0, [0.1, 0.2])])
def test_settings_are_for_one_value_at_one_pose(target, S):
    with pytest.raises(DefinitionError, match="one number is expected for each"):
        settings_for(ThreePointHitch(), "MK", "tilt", target, between=(0.4, 2.0), S=S)


def test_both_settings_of_a_four_bar_are_found():
    """The rocker's angle as a function of the coupler may come back to a value: every root gives it."""
    machine = FourBar()
    a, b = machine["OA"], machine["AB"]
    found = settings_for(machine, "AB", lambda motion: motion["psi"], 60 * deg, between=(0.2 * b, 3 * b + a), unit="deg", phi=1.0)
    assert found.values
    for value in found.values:
        assert float(machine.replaced(AB=value).at(phi=1.0)["psi"]) == pytest.approx(60 * deg, abs=1e-12)


class Rocker(Mechanism):
    """A four-bar without a name for its angle: studies take quantities too."""

    phi = Stroke(0.5, 1.0)
    O, C = Ground(0.0, 0.0), Ground(0.4, 0.0)
    A = Crank(O, OA=0.1, angle=phi)
    B = Dyad(A, C, AB=0.35, CB=0.2, side=LEFT)


def test_a_quantity_may_be_anonymous():
    found = zone(Rocker(), angle("C", "B"), {"AB": (0.34, 0.36)}, phi=[0.5, 1.0])
    direct = Rocker(AB=np.linspace(0.34, 0.36, 4001)).at(phi=[0.5, 1.0]).angle("C", "B")
    assert_allclose([found.low, found.high], [direct.min(axis=0), direct.max(axis=0)], rtol=1e-9)
