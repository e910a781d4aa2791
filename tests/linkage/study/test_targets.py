"""Several settings for several targets: against machines whose setting is known, closed solutions, and SciPy's least squares."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import least_squares

from linkage import Crank, DefinitionError, Dimension, Ground, Mechanism, Stroke, deg, drive_force, mm, x, y
from linkage.quantities import ref
from linkage.study import Target, settings_for
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import first_daily, for_all
from tests.linkage.random_mechanisms import random_mechanism
from tests.linkage.synthesis.synthesis_tasks import Bar

HITCH = {"MK": (0.5, 1.3), "CD": (0.4, 0.8), "M": [(0.22, 1.05), (0.22, 0.95)]}


def work_and_transport(hitch, work=0.05, transport=0.2):
    """Return targets that a hitch meets: the height of F and the tilt in work and in transport."""
    motion = hitch.at(S=[work, transport])
    return [
        Target(quantity, float(value), S=S)
        for quantity, values in ((y("F"), motion.y("F")), ("tilt", motion["tilt"]))
        for S, value in zip((work, transport), values, strict=True)
    ]


@first_daily(1, "hole", [(0.22, 1.05), (0.22, 0.95)])
def test_the_hitch_is_set_for_work_and_transport(hole):
    """The paper's own task: MK, CD and the mounting hole from a height of F and a tilt in two positions."""
    hitch = ThreePointHitch(MK=0.83, CD=0.60, M=hole)
    found = settings_for(ThreePointHitch(), HITCH, work_and_transport(hitch))
    assert found.met and len(found.settings) == 1 and not found.is_family
    assert_allclose([found.settings[0]["MK"], found.settings[0]["CD"], *found.settings[0]["M"]], [0.83, 0.60, *hole], rtol=0, atol=1e-9)
    assert f"with MK = 830 mm, CD = 600 mm, M = (220, {1e3 * hole[1]:.0f}) mm." in found.sentence
    assert "tilt" in str(found) and "at S = 200 mm" in str(found)


def test_two_targets_leave_a_setting_for_each_hole():
    targets = work_and_transport(ThreePointHitch(MK=0.83, CD=0.60))[::2]
    found = settings_for(ThreePointHitch(), HITCH, targets)
    assert found.met and [each["M"] for each in found.settings] == [(0.22, 1.05), (0.22, 0.95)]
    for machine, each in zip(found.machines, found.settings, strict=True):
        motion = machine.at(S=0.05)
        assert_allclose([motion.y("F"), motion["tilt"]], [target.value for target in targets], rtol=0, atol=1e-12)
        assert machine["MK"] == each["MK"]


def test_the_nearest_setting_says_what_is_missing():
    targets = [
        Target(y("F"), 0.45, S=0.05),
        Target("tilt", 0.0, S=0.05, unit="deg"),
        Target(y("F"), 0.9, S=0.2),
        Target("tilt", 5 * deg, S=0.2),
    ]
    found = settings_for(ThreePointHitch(), HITCH, targets)
    assert not found.met and len(found.settings) == 1
    motion = found.machines[0].at(S=[0.05, 0.2])
    reached = [motion.y("F")[0], motion["tilt"][0], motion.y("F")[1], motion["tilt"][1]]
    assert_allclose(found.misses[0], np.array(reached) - [0.45, 0.0, 0.9, 5 * deg], rtol=0, atol=1e-12)
    assert "y(F) = 488.303 mm at S = 50 mm, 38.3 mm more than wanted" in found.sentence
    assert "tilt = -1.39182 deg at S = 50 mm, 1.392 deg less than wanted" in found.sentence

    def off(setting, hole):
        motion = ThreePointHitch(MK=setting[0], CD=setting[1], M=hole).at(S=[0.05, 0.2], unreachable="nan")
        height, tilt = (motion.y("F") - [0.45, 0.9]) / mm, (motion["tilt"] - [0.0, 5 * deg]) / (0.1 * deg)
        return np.nan_to_num(np.concatenate([height, tilt]), nan=1e4)

    free = [
        least_squares(off, start, args=(hole,), bounds=([0.5, 0.4], [1.3, 0.8])).cost
        for hole in HITCH["M"] for start in ((0.85, 0.62), (1.0, 0.55), (0.7, 0.5), (0.95, 0.7))
    ]  # fmt: skip
    scale = np.array([mm, 0.1 * deg, mm, 0.1 * deg])
    assert_allclose(0.5 * np.sum((np.array(found.misses[0]) / scale) ** 2), min(free), rtol=1e-6)


class Plain(Mechanism):
    """A crank beside outputs that are sums of its dimensions."""

    S = Stroke(0.0, 1.0)
    a, b = Dimension(0.3), Dimension(0.4)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=0.5, angle=S)
    sum = ref("a") + ref("b")
    rest = ref("a") - ref("b")
    square = (ref("a") - 0.5) * (ref("a") - 0.5)


def test_nearest_is_the_weighted_least_squares():
    """a + b = 1, a - b = 0, a = 0.8 with weights: the normal equations."""
    weights = np.array([1 / 0.01, 1 / 0.02, 1 / 0.05])
    targets = [
        Target("sum", 1.0, within=0.01, S=0.0),
        Target("rest", 0.0, within=0.02, S=0.0),
        Target(1.0 * ref("a"), 0.8, within=0.05, S=0.0),
    ]
    found = settings_for(Plain(), {"a": (0.0, 2.0), "b": (0.0, 2.0)}, targets)
    best, *_ = np.linalg.lstsq(weights[:, None] * np.array([[1, 1], [1, -1], [1, 0]]), weights * [1.0, 0.0, 0.8], rcond=None)
    assert not found.met
    assert_allclose([found.settings[0]["a"], found.settings[0]["b"]], best, rtol=1e-10)


def test_the_nearest_setting_may_lie_on_an_edge_of_the_box():
    found = settings_for(Plain(), {"a": (0.0, 0.4), "b": (0.0, 2.0)}, [Target("sum", 1.0, S=0.0), Target("rest", 0.0, S=0.0)])
    assert not found.met and found.settings[0]["a"] == 0.4
    assert_allclose(found.settings[0]["b"], 0.5, rtol=1e-10)  # the mean of 0.6 and 0.4


def test_a_double_solution_is_one():
    found = settings_for(Plain(), {"a": (0.0, 1.2), "b": (0.0, 1.0)}, [Target("square", 0.0, S=0.0), Target("sum", 0.8, S=0.0)])
    assert found.met and not found.is_family and len(found.settings) == 1
    assert_allclose([found.settings[0]["a"], found.settings[0]["b"]], [0.5, 0.3], rtol=0, atol=1e-4)


class Arm(Mechanism):
    """Two links on turning joints: the hand is at a place in two ways."""

    S = Stroke(0.0, 0.1)
    shoulder, elbow = Dimension(0.5), Dimension(0.5)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=0.5, angle=ref("shoulder") + ref("S"))
    H = Crank(A, AH=0.4, angle=ref("shoulder") + ref("elbow"))


def test_both_ways_to_reach_a_place_are_found():
    """Elbow up and down, by the cosine rule."""
    place = np.array([0.3, 0.6])
    reach, base = np.hypot(*place), np.arctan2(place[1], place[0])
    bend = np.arccos((reach**2 - 0.25 - 0.16) / (2 * 0.5 * 0.4))
    inner = np.arctan2(0.4 * np.sin(bend), 0.5 + 0.4 * np.cos(bend))
    known = sorted([(base - inner, bend), (base + inner, -bend)])
    targets = [Target(x("H"), place[0], S=0.0), Target(y("H"), place[1], S=0.0)]
    found = settings_for(Arm(), {"shoulder": (-3.0, 3.0), "elbow": (-3.0, 3.0)}, targets)
    assert found.met
    assert_allclose([(each["shoulder"], each["elbow"]) for each in found.settings], known, rtol=0, atol=1e-9)
    out_of_reach = settings_for(
        Arm(), {"shoulder": (-3.0, 3.0), "elbow": (-3.0, 3.0)}, [Target(x("H"), 0.6, S=0.0), Target(y("H"), 0.8, S=0.0)]
    )
    assert not out_of_reach.met
    assert_allclose(np.hypot(*out_of_reach.misses[0]), 0.1, rtol=1e-6)  # stretched, a tenth short of 1 m


def settings_drawn(machine, random, count):
    """Return a box about some lengths of a machine, and a setting in it that can be assembled."""
    names = random.permutation([name for name, each in machine.plan.table.entries.items() if each.kind == "length"])[:count]
    for _ in range(50):
        setting = {str(name): float(machine[name] * (1.0 + random.uniform(-0.06, 0.06))) for name in names}
        if machine.replaced(**setting).at(S=[0.0, machine.strokes["S"].end], unreachable="nan").reached.all():
            return {name: (0.9 * machine[name], 1.1 * machine[name]) for name in setting}, setting
    return {}, {}


@for_all("seed", range(1), slow=range(1, 8))
def test_the_setting_of_a_random_machine_is_found(seed):
    machine, random = random_mechanism(seed)(), np.random.default_rng(seed)
    box, setting = settings_drawn(machine, random, 2 + seed % 2)
    end, last = machine.strokes["S"].end, [*machine.plan.moving][-1]
    true = machine.replaced(**setting).at(S=[0.0, end])
    targets = []
    for place, S in enumerate((0.0, end)):
        targets += [Target(x(last), float(true.x(last)[place]), S=S), Target(y(last), float(true.y(last)[place]), S=S)]
    found = settings_for(machine, box, targets)
    assert found.met
    for each in found.machines:
        motion = each.at(S=[0.0, end])
        assert_allclose(motion[last], true[last], rtol=0, atol=2e-10)
    follows = [name for name in setting if moves(machine, name, last, end)]
    close = [all(abs(each[name] - setting[name]) < 1e-5 for name in follows) for each in found.settings]
    assert any(close) or (found.is_family and len(follows) < len(setting))


def moves(machine, name, last, end):
    """Return whether a point follows a dimension."""
    return np.abs(machine.at(S=[0.0, end]).gradient(last, wrt=[name])).max() > 1e-9


@for_all("seed", range(1), slow=range(1, 3))
def test_nine_ranges_are_found_together(seed):
    """All dimensions and both pivots of a bar, by 18 points that a known one comes to."""
    random = np.random.default_rng(seed)
    pivots = {f"{point}.{axis}": random.uniform(-8 * mm, 8 * mm) for point in "OC" for axis in "xy"}
    known = Bar(**pivots | {"C.x": 0.03, "OA": 0.012, "AB": 0.036, "CB": 0.028, "AP": 0.022, "BAP": 0.5})
    at = np.linspace(0.0, 2 * np.pi, 18, endpoint=False)
    places = known.at(phi=at)["P"]
    targets = [Target(of("P"), places[row, k], phi=at[k]) for row, of in enumerate((x, y)) for k in range(len(at))]
    vary = {"OA": (5 * mm, 20 * mm), "AB": (20 * mm, 60 * mm), "CB": (20 * mm, 60 * mm), "AP": (5 * mm, 40 * mm), "BAP": (0.2, 1.0)}
    vary |= {name: (-20 * mm, 20 * mm) for name in ("O.x", "O.y", "C.y")} | {"C.x": (15 * mm, 45 * mm)}
    found = settings_for(Bar(), vary, targets, points=1024)
    assert found.met and len(found.settings) == 1
    for name, value in found.settings[0].items():
        assert_allclose(value, known[name], rtol=0, atol=1e-9)


def test_a_family_is_told():
    height = float(ThreePointHitch().at(S=0.1).y("F"))
    found = settings_for(
        ThreePointHitch(), {"MK": (0.5, 1.3), "FG": (0.5, 1.3)}, [Target("tilt", 0.0, S=0.1), Target(y("F"), height, S=0.1)]
    )
    assert found.met and found.is_family and len(found.settings) == 1
    assert "one of a family" in found.sentence


def test_a_force_is_a_target():
    wanted = float(ThreePointHitch(OB=0.31).evaluate([drive_force()], S=0.1)[0])
    found = settings_for(ThreePointHitch(), {"OB": (0.29, 0.32)}, [Target(drive_force(), wanted, unit="kN", S=0.1)])
    assert found.met and "kN at S = 100 mm: with OB = 310 mm" in found.sentence
    assert_allclose(found.settings[0]["OB"], 0.31, rtol=1e-9)


def test_choices_alone_and_what_cannot_be_assembled():
    hole = settings_for(ThreePointHitch(), {"M": [(0.22, 1.05), (0.22, 0.95)]}, work_and_transport(ThreePointHitch(M=(0.22, 0.95))))
    assert hole.met and hole.settings[0]["M"] == (0.22, 0.95)
    nowhere = settings_for(ThreePointHitch(), {"MK": (0.1, 0.2)}, [Target("tilt", 0.0, S=0.1)])
    assert not nowhere.met and nowhere.settings == () and nowhere.machines == ()
    assert nowhere.sentence == "No setting of MK that was looked at can be assembled at S = 100 mm. Look farther."


TILT = [Target("tilt", 0.0, S=0.1)]


@for_all(
    ("vary", "targets", "words"),
    [
        ({"MK": (0.5, 1.3), "CD": (0.5, 0.6)}, TILT, "1 target leaves 2 ranges a family of settings; hold 1 of MK, CD"),
        ({}, TILT, "nothing may vary"),
        ({"MK": (0.5, 1.3)}, [], "a list of targets is expected"),
        ({"MK": (0.5, 1.3)}, TILT[0], "a list of targets is expected"),
        ({"MK": (0.5, 1.3)}, [Target("tilt", 0.0)], "say the pose, S=..."),
        ({"MK": (0.5, 1.3)}, [Target("F", 0.0, S=0.1)], 'F has two components; say which, x("F") or y("F")'),
        ({"MK": (0.5, 1.3)}, [Target(len, 0.0, S=0.1)], "len is no part of the program"),
        ({"XY": (0.5, 1.3)}, TILT, "Dimension 'XY' is unknown"),
    ],
)
def test_targets_that_cannot_be_are_refused(vary, targets, words):
    with pytest.raises(DefinitionError) as refused:
        settings_for(ThreePointHitch(), vary, targets)
    assert words in str(refused.value)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"value": "x"}, "one number is expected for the value"),
        ({"value": 1.0, "within": 0.0}, "a number above zero"),
        ({"value": 1.0, "unit": "yard"}, "unknown in Target(unit=...)"),
        ({"value": 1.0, "S": [1.0, 2.0]}, "one number is expected for each stroke"),
    ],
)
def test_a_target_that_cannot_be_is_refused(given, words):
    with pytest.raises(DefinitionError) as refused:
        Target("tilt", **given)
    assert words in str(refused.value)


def test_what_belongs_to_one_setting_is_refused_for_several():
    for given, words in (({"S": 0.1}, "S=..."), ({"between": (0.1, 0.2)}, "between=..."), ({"target": 0.1}, "target=0.1")):
        with pytest.raises(DefinitionError, match=words) as refused:
            settings_for(ThreePointHitch(), HITCH, TILT * 2, **given)
        assert "every target says it itself" in str(refused.value)
    with pytest.raises(DefinitionError, match="leave it out"):
        settings_for(ThreePointHitch(), "MK", "tilt", between=(0.5, 1.3), points=3, S=0.1)


def test_points_are_a_whole_number():
    with pytest.raises(DefinitionError, match="whole number of points"):
        settings_for(ThreePointHitch(), HITCH, TILT * 2, points=2.5)
    with pytest.raises(DefinitionError, match="does not change"):
        TILT[0].value = 3.0
    assert repr(TILT[0]) == "Target('tilt', 0.0, S=0.1)"
