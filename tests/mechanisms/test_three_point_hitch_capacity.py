"""What the hitch lifts, its zones, upper link, mast and tractor: against hand equilibrium, differences and random samples."""

import re
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from linkage import AssemblyError, DefinitionError, Force, Ground, LinkMass, Spring, Weight, deg, driving_force, kN, mm, pin_forces
from linkage.cli import main
from linkage.units import g0
from mechanisms.three_point_hitch import (
    CATEGORIES,
    HitchCategory1,
    HitchCategory2,
    ThreePointHitch,
    at_hitch_points,
    behind,
    capacity,
    capacity_columns,
    capacity_zone,
    figure,
    front_axle,
    largest_mass,
    tilt_zone,
    tipping_mass,
    tipping_slope,
    upper_link_force,
    vertical_mast,
    weakest,
)
from mechanisms.three_point_hitch.capacity import stages
from tests.for_all import first_daily, for_all
from tests.mechanisms.hitch_reference import REFERENCE
from tests.members import told_by

ALL = first_daily(1, "machine", [ThreePointHitch, HitchCategory2, HitchCategory1])
FORCE = 2 * np.pi / 4 * 0.110**2 * 18e6
ETA = 0.85


@cache
def verdicts(machine, *dimensions):
    """Return what a hitch with some dimensions, pairs of name and value, says by rules of its own."""
    hitch = machine(**dict(dimensions))
    return hitch.rules(hitch.sweep(21))


def verdict(machine, rule, **dimensions):
    """Return the one sentence on a rule."""
    (found,) = [text for text in verdicts(machine, *dimensions.items()) if text[5:].startswith(f"{rule}:")]
    return found


# -- capacity ------------------------------------------------------------------------------------------------


def test_capacity_has_the_digits_of_the_reference():
    motion = ThreePointHitch().at(S=REFERENCE["S"])
    assert [float(f"{value:.8g}") for value in capacity(motion) / kN] == list(REFERENCE["capacity"])


@ALL
def test_capacity_is_28_and_29(machine):
    hitch = machine()
    motion = hitch.sweep(11)
    force = 2 * np.pi / 4 * hitch["lift.bore"] ** 2 * hitch["circuit.pressure"]
    assert_allclose(capacity(motion), force * 0.85 / motion.ratio("G", method="central")[1], rtol=1e-8)


def test_a_load_of_the_capacity_takes_the_whole_pressure():
    hitch = ThreePointHitch()
    for S in (0.0, 0.13, 0.25):
        mass = float(capacity(hitch.at(S=S))) / g0
        loaded = hitch.replaced(**{"load.mass": mass}).at(S=S)
        assert float(driving_force(loaded)) == pytest.approx(FORCE * ETA, rel=1e-12)


def test_capacity_at_the_hitch_points_and_behind_them():
    motion, h = ThreePointHitch().sweep(11), 1e-6
    ahead, back = (ThreePointHitch().at(S=motion.strokes["S"] + step) for step in (h, -h))

    def rise(pose, distance):
        return pose.y("F") + distance * np.sin(pose["tilt"])

    for found, distance in ((at_hitch_points(motion), 0.0), (behind(motion), 0.610), (behind(motion, 1.2), 1.2)):
        ratio = (rise(ahead, distance) - rise(back, distance)) / (2 * h)
        assert_allclose(found, 0.9 * FORCE * ETA / ratio, rtol=1e-8)


def test_masses_of_the_links_take_their_share():
    class Heavy(ThreePointHitch):
        """With lower links that weigh something."""

        lower = LinkMass("E D F", mass=120)

    motion, bare = Heavy().sweep(5), ThreePointHitch().sweep(5)
    own = driving_force(motion, ["lower"])
    assert (own > 0.0).all()
    assert_allclose(capacity(motion), capacity(bare) * (1.0 - own / (FORCE * ETA)), rtol=1e-12)
    assert_allclose(behind(motion), behind(bare) * (1.0 - own / (0.9 * FORCE * ETA)), rtol=1e-12)


def test_not_limited_where_the_load_does_not_resist():
    """With G on the tractor's side the implement turns so that G sinks while F rises: no capacity, and no infinity."""
    hitch = ThreePointHitch(KFG=-100 * deg, FG=3.0, MK=0.80)
    motion = hitch.sweep(41)
    ratio = motion.ratio("G")[1]
    assert (ratio < 0.0).any()
    assert_array_equal(np.isnan(capacity(motion)), ratio <= 0.0)
    assert (capacity(motion)[ratio > 0.0] > 0.0).all()


def test_batch_of_designs():
    bores = np.array([90, 100, 110]) * mm
    hitch = ThreePointHitch(**{"lift.bore": bores})
    found = capacity(hitch.sweep(7))
    assert found.shape == (3, 7)
    for row, bore in zip(found, bores, strict=True):
        assert_allclose(row, capacity(ThreePointHitch(**{"lift.bore": bore}).sweep(7)), rtol=1e-12)
    assert all(np.broadcast_shapes(column.values.shape, (3, 7)) == (3, 7) for column in capacity_columns(hitch.sweep(7)))
    *_, text = hitch.rules(hitch.sweep(7))
    none = "0 of 3 designs are too weak for their implement, 0 leave too little on the front axle, 0 do not reach"
    assert text and text.sentence.startswith(none)


@pytest.mark.slow
def test_verdict_of_a_batch_counts_what_fails():
    hitch = ThreePointHitch(**{"load.mass": [2000, 3000, 9000]})
    *general, text = hitch.verdicts(hitch.sweep(7))
    assert [each.rule for each in general] == ["assembly", "length", "standard size", "buckling", "lifting", "oil", "holding", "lowering"]
    assert text.sentence.startswith("1 of 3 designs are too weak for their implement, 2 leave too little")


# -- the weakest point -----------------------------------------------------------------------------------------


@ALL
def test_weakest_point_is_the_least_capacity(machine):
    motion = machine().sweep(5)
    found = weakest(motion)
    fine = capacity(machine().sweep(20_001))
    assert found.capacity == pytest.approx(fine.min(), rel=1e-9)
    assert found.capacity <= fine.min() * (1 + 1e-14)


def test_weakest_point_inside_the_stroke():
    hitch = ThreePointHitch(MK=1.28, KFG=85 * deg, OB=0.28, CD=0.50, OC=0.35)
    fine = capacity(hitch.sweep(20_001))
    place = int(fine.argmin())
    assert 0 < place < 20_000
    found = weakest(hitch.sweep(5))
    assert found.stroke == pytest.approx(0.25 * place / 20_000, abs=2e-5)
    assert found.capacity == pytest.approx(fine.min(), rel=1e-9)


def test_stages_make_up_the_ratio():
    motion = ThreePointHitch().at(S=[0.1])
    assert np.prod([factor for factor, *_ in stages(motion).values()]) == pytest.approx(float(motion.ratio("G")[1, 0]), rel=1e-13)


def test_weakest_point_in_words():
    text = verdict(ThreePointHitch, "capacity")
    assert "least at S = 250.0 mm, F 868 mm high: 80.23 kN (8181 kg). There the pressure limits it: G rises 3.625 mm for 1 mm" in text
    assert "mostly by the cylinder's lever: its lever about O 234 mm, at the best point, S = 0.0 mm, 298 mm" in text


def test_remedy_does_what_it_says():
    gain = float(re.findall(r"OB 10 mm longer helps most: \+([0-9.]+) %", weakest(ThreePointHitch().sweep(5)).remedy)[0])
    changed = weakest(ThreePointHitch(OB=0.31).sweep(5)).capacity / weakest(ThreePointHitch().sweep(5)).capacity
    assert 100 * (changed - 1) == pytest.approx(gain, abs=0.06)
    for name in ("OB", "OC", "ED", "CD", "EF", "MK"):
        for step in (10 * mm, -10 * mm):
            hitch = ThreePointHitch(**{name: ThreePointHitch()[name] + step})
            assert capacity(hitch.sweep(201)).min() <= capacity(ThreePointHitch(OB=0.31).sweep(201)).min()


@pytest.mark.slow
def test_too_heavy_an_implement_fails():
    assert verdict(ThreePointHitch, "capacity", **{"load.mass": 8100.0}).startswith("ok")
    assert verdict(ThreePointHitch, "capacity", **{"load.mass": 8300.0}).startswith("FAIL")
    assert told_by(ThreePointHitch(**{"load.mass": 8300.0}), "circuit")[0].startswith("FAIL lifting")


def test_what_limits_first():
    text = verdict(ThreePointHitch, "largest implement")
    assert "the front axle's least load comes first; over this motion: the pressure 8181 kg" in text
    assert "the pressure comes first" in verdict(ThreePointHitch, "largest implement", vehicle_mass=80e3)


@pytest.mark.slow
def test_unreached_poses_are_told():
    hitch = ThreePointHitch()
    text = hitch.verdicts(hitch.at(S=[0.0, 0.1, 0.45], unreachable="nan"))
    assert "least at S = 408.3 mm" in "\n".join(text)  # up to the dead point, though no pose was asked for there
    (share,) = re.findall("FAIL assembly: over S = 0 to 450 mm ([0-9.]+) % cannot be assembled", text[0])
    assert float(share) == pytest.approx(100 * (0.45 - 0.4083) / 0.45, abs=0.05)
    assert "B = Dyad(A, O)" in text[0] and "what follows holds for the rest" in text[0]


def test_poses_of_which_none_is_reached_are_told():
    hitch = ThreePointHitch()
    nowhere = hitch.at(S=[0.5, 0.6], unreachable="nan")
    (said,) = hitch.verdicts(nowhere)
    assert said.startswith("FAIL assembly: B = Dyad(A, O) cannot be assembled at 2 of 2 strokes")


# -- the upper link ----------------------------------------------------------------------------------------------


def by_hand(motion):
    """Return the tension in the upper link: moments of weight and link about F balance on the implement."""
    F, K, M, G = (motion[name] for name in "FKMG")
    u = (M - K) / np.hypot(*(M - K))
    arm = (K - F)[0] * u[1] - (K - F)[1] * u[0]
    return motion.inputs["load.mass"] * g0 * (G - F)[0] / arm


@ALL
def test_upper_link_is_hand_equilibrium(machine):
    motion = machine().sweep(21)
    assert_allclose(upper_link_force(motion), by_hand(motion), rtol=1e-10)
    assert (upper_link_force(motion) > 0.0).all()
    assert "in tension over this motion" in verdict(machine, "upper link")


@pytest.mark.slow
def test_upper_link_is_pressed_by_a_load_on_the_tractors_side():
    hitch = ThreePointHitch(KFG=-40 * deg)
    motion = hitch.sweep(21)
    assert_allclose(upper_link_force(motion), by_hand(motion), rtol=1e-10)
    assert (upper_link_force(motion) < 0.0).all()
    assert "in compression over this motion" in verdict(ThreePointHitch, "upper link", KFG=-40 * deg)


def test_upper_link_that_changes_its_sense_is_told():
    text = verdict(ThreePointHitch, "upper link", KFG=10 * deg)
    start, end = (float(each) * mm for each in re.findall(r"from S = ([0-9.]+) to ([0-9.]+) mm", text)[0])
    force = upper_link_force(ThreePointHitch(KFG=10 * deg).sweep(2001))
    S = np.linspace(0.0, 0.25, 2001)
    pressed, pulled = (start + 2e-4 < S) & (end - 2e-4 > S), (start - 2e-4 > S) | (end + 2e-4 < S)
    assert pressed.any() and (force[pressed] < 0.0).all()
    assert pulled.any() and (force[pulled] > 0.0).all()


def test_forces_of_the_machine_agree_in_both_methods():
    forces = pin_forces(ThreePointHitch().sweep(21))
    assert forces.gap < 1e-10 and forces.residual < 1e-10


# -- the mast ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("S", [0.0, 0.1, 0.25])
def test_vertical_mast(S):
    hitch = ThreePointHitch()
    (MK,) = vertical_mast(hitch, S).values
    assert pytest.approx(float(np.hypot(*(hitch.at(S=S)["F"] + [0.0, 0.685] - [0.22, 1.05]))), abs=1e-13) == MK
    assert float(hitch.replaced(MK=MK).at(S=S)["tilt"]) == pytest.approx(0.0, abs=1e-13)


def test_no_vertical_mast_is_said():
    found = vertical_mast(ThreePointHitch(), 0.1, between=(0.8, 0.9))
    assert found.values == ()
    assert found.sentence.startswith("No MK between 800 mm and 900 mm gives tilt = 0 deg: it can be assembled from 800 mm to 900 mm")


def test_mast_verdict_tells_the_admissible_range():
    assert "At S = 0.0 mm tilt = 0 deg with MK = 917.637 mm." in verdict(ThreePointHitch, "mast")
    assert "That is outside the admissible 800 to 960 mm." in verdict(ThreePointHitch, "mast", M=(0.05, 1.05))


# -- the tractor -----------------------------------------------------------------------------------------------------


def test_front_axle_by_hand():
    """Lowered, G is 1.984 m behind the wheels: (8000 kg x 1.1 m - 2000 kg x 1.984 m) / 2.75 m on the front axle."""
    found = front_axle(ThreePointHitch().at(S=0.0))
    assert float(found) == pytest.approx(9.80665 * (8000 * 1.1 - 2000 * 1.98405779) / 2.75, rel=1e-8)
    assert float(tipping_mass(ThreePointHitch().at(S=0.0))) == pytest.approx(8000 * 1.1 / 1.98405779, rel=1e-8)


@pytest.mark.parametrize("slope", [-8 * deg, 0.0, 12 * deg])
def test_limits_of_the_mass_are_met(slope):
    for S in (0.0, 0.25):
        motion = ThreePointHitch(slope=slope).at(S=S)
        tips, least = float(tipping_mass(motion)), float(largest_mass(motion))
        loaded = ThreePointHitch(slope=slope, **{"load.mass": tips}).at(S=S)
        assert float(front_axle(loaded)) == pytest.approx(0.0, abs=1e-6)
        loaded = ThreePointHitch(slope=slope, **{"load.mass": least}).at(S=S)
        assert float(front_axle(loaded)) == pytest.approx(0.2 * 8000 * g0, rel=1e-12)


def test_tipping_slope_is_where_the_front_axle_lifts():
    motion = ThreePointHitch().at(S=[0.0, 0.25])
    for place, S in enumerate([0.0, 0.25]):
        steep = float(tipping_slope(motion)[place])
        assert float(front_axle(ThreePointHitch(slope=-steep).at(S=S))) == pytest.approx(0.0, abs=1e-6)
        assert float(front_axle(ThreePointHitch(slope=steep).at(S=S))) > 0.0
    assert float(tipping_slope(ThreePointHitch(**{"load.mass": 5000}).at(S=0.0))) == 0.0


def test_no_mass_tips_a_tractor_whose_implement_stands_over_the_wheels():
    motion = ThreePointHitch(KFG=-90 * deg, FG=2.0).at(S=0.0)
    assert float(motion.x("G")) < 0.0
    assert np.isnan(tipping_mass(motion))


def test_front_axle_verdicts():
    kept = verdict(ThreePointHitch, "front axle")
    assert kept.startswith("ok") and kept.answer.used == pytest.approx(0.2 * 8000 * g0 / kept.answer.value)
    light = verdict(ThreePointHitch, "front axle", **{"load.mass": 3000})
    assert light.startswith("FAIL") and "At most 2179 kg, or 602 kg of ballast over the front axle." in light
    assert "the tractor tips over backwards" in verdict(ThreePointHitch, "front axle", **{"load.mass": 5000})


def test_ballast_of_the_verdict_does():
    """602 kg over the front axle: the tractor heavier by that, its centre of mass moved accordingly."""
    mass = 8000 + 602
    hitch = ThreePointHitch(vehicle_mass=mass, vehicle_x=-(8000 * 1.1 + 602 * 2.75) / mass, **{"load.mass": 3000})
    assert float(front_axle(hitch.sweep(2001)).min()) == pytest.approx(0.2 * 8000 * g0, rel=1e-3)


@for_all(
    ("dimensions", "words"),
    [
        ({"vehicle_mass": 0.0}, "vehicle_mass = 0 is not above zero"),
        ({"wheelbase": -1.0}, "wheelbase = -1 is not above zero"),
        ({"slope": 2.0}, "no tractor stands on 60 deg"),
        ({"least_front": 1.0}, "a share of the tractor's weight"),
        ({"load.mass": -5.0}, "load.mass=-5 is negative"),
    ],
)
def test_a_tractor_that_cannot_be_is_refused(dimensions, words):
    with pytest.raises(DefinitionError, match=re.escape(words)):
        ThreePointHitch(**dimensions)


# -- what a user adds ----------------------------------------------------------------------------------------


class Laden(ThreePointHitch):
    """Front ballast on the tractor, a toolbox at the hitch points, a stay that pulls, a spring between two points of the machine."""

    P = Ground(-3.2, 0.8)
    ballast = Weight(P, mass=400)
    toolbox = Weight(ThreePointHitch.F, mass=150)
    pull = Force(ThreePointHitch.K, (1.5 * kN, -2.0 * kN))
    helper = Spring(ThreePointHitch.M, ThreePointHitch.D, stiffness=4e3, free_length=0.3)


@pytest.mark.parametrize("slope", [0.0, 12 * deg, -8 * deg])
def test_every_added_load_counts_at_the_front_axle(slope):
    hitch, bare = Laden(slope=slope), ThreePointHitch(slope=slope)
    motion, plain = hitch.sweep(7), bare.sweep(7)
    down = np.array([-np.sin(slope), -np.cos(slope)]) * g0
    lifted = 0.0
    for point, force in (("P", 400 * down), ("F", 150 * down), ("K", (1500.0, -2000.0))):
        lifted = lifted - (motion.x(point) * force[1] - motion.y(point) * force[0])
    assert_allclose(front_axle(motion), front_axle(plain) - lifted / 2.75, rtol=1e-12)
    least = largest_mass(motion)
    heavy = [Laden(**{"load.mass": float(mass), "slope": slope}).at(S=S) for mass, S in zip(least, motion.strokes["S"], strict=True)]
    assert_allclose([float(front_axle(each)) for each in heavy], 0.20 * 8000 * g0, rtol=1e-12)


def test_tipping_slope_with_added_loads_is_where_the_front_axle_lifts():
    S = 0.25
    for mass in (2000.0, 3500.0):
        steep = float(tipping_slope(Laden(**{"load.mass": mass}).at(S=S)))
        assert steep > 0.0
        assert abs(float(front_axle(Laden(**{"load.mass": mass}, slope=-steep).at(S=S)))) < 1e-6


def test_every_added_load_counts_in_the_capacity():
    hitch = Laden()
    motion = hitch.sweep(5)
    lifted = capacity(motion)
    assert np.all(lifted < capacity(ThreePointHitch().sweep(5)))
    others = [name for name in ("ballast", "toolbox", "pull", "helper")]
    for place, force in enumerate(lifted):
        at = hitch.at(S=motion.strokes["S"][place])
        assert_allclose(driving_force(at, [*others, Force("G", (0.0, -float(force)))]), FORCE * ETA, rtol=1e-9)
    assert "FAIL capacity" in " ".join(Laden(**{"toolbox.mass": 10e3}).rules(hitch.replaced(**{"toolbox.mass": 10e3}).sweep(5)))


@pytest.mark.slow
def test_upper_link_beside_an_added_spring_at_its_pin():
    class Sprung(ThreePointHitch):
        helper = Spring(ThreePointHitch.M, ThreePointHitch.D, stiffness=4e3, free_length=0.3)

    assert_allclose(upper_link_force(Sprung().sweep(5)), upper_link_force(ThreePointHitch().sweep(5)), rtol=1e-9)
    assert any("upper link" in text for text in Sprung().rules(Sprung().sweep(5)))


# -- zones ---------------------------------------------------------------------------------------------------------


def test_zones_of_figure_2():
    S = np.linspace(0.0, 0.25, 6)
    lifted, tilted = capacity_zone(ThreePointHitch(), S=S), tilt_zone(ThreePointHitch(), S=S)
    random = np.random.default_rng(7)
    box = ThreePointHitch.admissible
    M = np.array(box["M"])[random.integers(0, 2, 30_000)]
    motion = ThreePointHitch(**{name: random.uniform(*box[name], 30_000) for name in ("MK", "CD", "FK")}, M=tuple(M.T)).at(S=S)
    for found, samples in ((lifted, capacity(motion)), (tilted, motion["tilt"])):
        assert (found.low <= samples.min(axis=0)).all() and (samples.max(axis=0) <= found.high).all()
        assert found.complete.all() and found.remarks == ()
    at = {name: value[2] if name != "M" else (value[0][2], value[1][2]) for name, value in lifted.low_at.items()}
    assert float(capacity(ThreePointHitch(**at).at(S=S[2]))) == pytest.approx(lifted.low[2], rel=1e-12)


def test_zone_without_an_upper_end_is_told():
    hitch = ThreePointHitch(KFG=-100 * deg, FG=3.0)
    found = capacity_zone(hitch, {"MK": (0.80, 1.00)}, S=[0.1])
    assert np.isnan(found.high).all() and np.isfinite(found.low).all()
    assert "some settings are not limited by this cylinder" in found.remarks[-1]


@pytest.mark.parametrize("machine", [HitchCategory2, HitchCategory1])
def test_every_admissible_setting_of_the_categories_assembles(machine):
    assert tilt_zone(machine(), S=np.linspace(0.0, machine.plan.strokes["S"].end, 5)).complete.all()


# -- categories ------------------------------------------------------------------------------------------------------


def test_categories_have_the_standards_mast():
    assert [(each.number, round(each.mast_height * 1e3)) for each in CATEGORIES.values()] == [(1, 460), (2, 610), (3, 685)]
    assert [round(each.lower_span * 1e3) for each in CATEGORIES.values()] == [683, 825, 965]
    for each in CATEGORIES.values():
        assert each.machine()["FK"] == each.mast_height
        assert "illustrative" in each.machine.__doc__ and "illustrative" in str(each) and "ISO 730" in str(each)


@ALL
def test_verdicts_of_the_categories_are_all_kept(machine):
    hitch = machine()
    sentences = [each for each in hitch.verdicts(hitch.sweep(21)) if each.is_rule]
    assert len(sentences) == 15 and all(text.startswith("ok") for text in sentences), sentences


# -- figures and the command -------------------------------------------------------------------------------------------


def legend(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def test_figures():
    left, right = figure("zones").axes
    assert legend(left) == legend(right) == [
        "hole M1 at (220, 1050) mm", "hole M2 at (220, 950) mm", "set to MK 880, CD 620, FK 685 mm",
    ]  # fmt: skip
    (ax,) = figure("capacity").axes
    assert len(legend(ax)) == 6
    assert any("weakest: 80.2 kN at S = 250 mm" in text.get_text() for text in ax.texts)
    (ax,) = figure("lift").axes
    assert any(text.get_text() == "628 mm" for text in ax.texts)


def test_figures_refuse_what_they_cannot_show():
    with pytest.raises(DefinitionError, match=r"'zone' is unknown\. Did you mean zones"):
        figure("zone")
    with pytest.raises(DefinitionError, match="shows one design"):
        figure("capacity", ThreePointHitch(OB=[0.29, 0.30]))
    with pytest.raises(AssemblyError):
        figure("lift", ThreePointHitch(MK=0.2))


@pytest.mark.slow
def test_capacity_command(capsys):
    assert main(["hitch", "three_point_hitch", "--count", "3", "--vertical", "--pins"]) == 0
    out = capsys.readouterr().out
    for words in ("2 cylinders 110/63 mm", "capacity, kN", "95.69", "80.23", "MK = 917.637 mm", "ok   upper link", "M    pin   MK"):
        assert words in out, words


def test_capacity_command_zones_categories_and_files(capsys, tmp_path):
    table, picture = tmp_path / "zones.csv", tmp_path / "zones.svg"
    arguments = ["hitch", "three_point_hitch", "--category", "1", "--zones", "--count", "3", "--csv", str(table), "-o", str(picture)]
    assert main(arguments) == 0
    assert "mast height 460 mm" in capsys.readouterr().out
    assert table.read_text().splitlines()[0] == '"S, mm","capacity_min, kN","capacity_max, kN","tilt_min, deg","tilt_max, deg",assembled'
    assert picture.stat().st_size > 10_000


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ("mower_lift", "is no three-point hitch"),
        ("three_point_hitch --set bore=3", "'bore' is unknown"),
        ("three_point_hitch -o picture.gif", "which chooses the format"),
        ("three_point_hitch --set MK=100mm", "mm short of"),
    ],
)
def test_capacity_command_says_what_is_wrong(capsys, arguments, words):
    assert main(["hitch", *arguments.split()]) == 2
    err = capsys.readouterr().err
    assert words in err and "Traceback" not in err
