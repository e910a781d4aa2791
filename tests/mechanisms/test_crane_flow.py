"""From a duty to a crane: searches, stages handed on, reach, load cases for strength, figures and the command."""

import re
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import reserve
from linkage import DefinitionError, driving_force, least, max_table, pin_forces
from linkage.cli import main
from linkage.units import deg, kN
from mechanisms.crane import (
    DRIVE_FIGURES,
    FIGURES,
    ArmDrive,
    BellCrankArmDrive,
    BellCrankCrane,
    BoomDrive,
    ChainCrane,
    Crane,
    CraneSkeleton,
    DirectCrane,
    DirectCraneAbove,
    Duty,
    arm_drive_of,
    arm_moment,
    boom_drive_of,
    crane_figure,
    design_crane,
    design_skeleton,
    duty_of,
    envelope,
    load_map,
    strength,
    with_drives,
)
from mechanisms.crane.drive_report import MOVEMENTS
from mechanisms.crane.lifted_map import dragging
from tests.for_all import first_daily

FOUND = {  # example 1 of the source, both readings of (2.13): W_m and the variables
    ">=": (3.755721473767066, (4.542413835813202, 3.116420231283486, 2.493136185026789, 1.85, 20.526019274994923 * deg)),
    "<=": (3.694124881450423, (4.454601406907623, 3.165204914008807, 2.532163931207046, 1.85, 15 * deg)),
}
NAMES = ("l_c", "l_p", "l_t", "h_0", "phi_0")


@pytest.mark.parametrize("reading", [">=", pytest.param("<=", marks=pytest.mark.slow)])
def test_skeleton_is_found_by_search(reading):
    W_m, variables = FOUND[reading]
    found = design_skeleton(reading=reading, starts=2)
    assert found.value == pytest.approx(W_m, rel=1e-6)
    assert_allclose([found.machine[name] for name in NAMES], variables, rtol=1e-4)


@pytest.mark.slow
def test_back_broken_skeleton_is_found_by_search():
    """W_m of brute force and SLSQP, which agree."""
    assert design_skeleton(cab=6.9, starts=4).value == pytest.approx(3.8268985114240253, rel=1e-6)


@pytest.mark.slow
def test_whole_flow_gives_the_examples():
    """Example 1 in the reading that examples 2 and 3 take, then their best drives."""
    found = design_crane(reading="<=")
    assert found.skeleton.value == pytest.approx(FOUND["<="][0], rel=1e-6)
    assert found.boom.best.value == pytest.approx(23429.523301843783, rel=1e-5)
    assert found.arm.best.value * 1e9 == pytest.approx(10823153.847283429, rel=1e-5)
    heights, radii = [1.0, 4.0], [3.0, 6.0, 9.0]
    assert_allclose(load_map(found.crane, heights, radii).load, load_map(Crane(), heights, radii).load, rtol=1e-3)


def test_stages_take_what_the_user_gives():
    crane = Crane()
    found = design_crane(skeleton=crane, boom=BoomDrive(), arm=ArmDrive())
    assert found.skeleton is found.boom is found.arm is None
    for name, value in crane.dimensions.items():
        tolerance = 1e-3 if name.startswith("extend.") else 1e-6
        assert float(found.crane[name]) == pytest.approx(float(value), rel=tolerance, abs=1e-9)


@first_daily(2, "machine", [Crane, BellCrankCrane, DirectCrane, DirectCraneAbove])
def test_drives_on_their_own_are_those_of_the_crane(machine):
    crane = bell_crank() if machine is BellCrankCrane else machine()
    boom, arm = boom_drive_of(crane), arm_drive_of(crane)
    again = with_drives(crane, boom, arm)
    assert type(again) is machine
    for name, value in crane.dimensions.items():
        if not name.startswith("extend."):
            assert float(again[name]) == pytest.approx(float(value), rel=1e-12)
    phi, psi = np.linspace(0.4, 1.6, 5), np.linspace(float(crane["psi_0"]) + 0.1, 2.8, 5)
    assert_allclose(boom.at(phi=phi)["length"], crane.at(phi=phi, psi=1.0, t=0.0).distance("A", "B"), rtol=1e-12)
    ends = machine.fold.ends
    assert_allclose(arm.at(psi=psi)["length"], crane.at(phi=1.0, psi=psi, t=0.0).distance(*ends), rtol=1e-12)
    given = {each.name: arm.at(psi=psi)[each.given] for each in MOVEMENTS["psi"]}
    assert_allclose(arm_moment(crane, psi), (-given["folding"], given["opening"]), rtol=1e-9)


@first_daily(0, "machine", [DirectCrane, DirectCraneAbove])
def test_a_direct_drive_carries_the_crane_by_virtual_work(machine):
    """The cylinder's thrust is the arm's moment over the lever (2.30); the pin E carries that thrust; the reserve is 1."""
    crane, side = machine(), 1.0 if machine is DirectCrane else -1.0
    psi = np.linspace(60, 180, 7) * deg
    motion = crane.at(phi=1.2, psi=psi, t=1.0)
    r = [float(crane[f"arm_r{k}"]) for k in range(1, 5)]
    X, Y = r[2] * np.sin(psi) - side * r[3] * np.cos(psi), -r[2] * np.cos(psi) - side * r[3] * np.sin(psi)
    lever = (side * r[0] * Y + r[1] * X) / np.hypot(X - side * r[0], Y + r[1])
    moment = driving_force(motion, drive="psi", case="lifting")
    thrust = crane.fold.thrust(motion, case="lifting")
    assert_allclose(thrust * lever, moment, rtol=1e-9)
    forces = pin_forces(motion, case="lifting")
    assert {row.point: row.force for row in max_table(forces)}["E"] == pytest.approx(float(np.abs(thrust).max()), rel=1e-9)
    assert crane.answers([least(reserve("fold"))])[0].value == pytest.approx(1.0, abs=1e-6)


def bell_crank():
    arm = BellCrankArmDrive()
    bars = {f"arm_r{k}": float(arm[f"r_{k}"]) for k in range(1, 9)}
    return BellCrankCrane(**bars, bend=float(arm["delta"]), lug=np.pi + float(arm["alpha_20"]), psi_k=float(arm["psi_k"]))


def test_duty_of_a_crane_is_that_of_the_examples():
    duty = duty_of(Crane())
    assert_allclose((duty.K_B, duty.K_A, duty.K_A1), (85260.01232735414, 71905.17119002105, 39947.317327789475), rtol=1e-12)


# The reach.


class FreeCrane(Crane):
    """Boom and arm turn fully and no cylinder's length counts."""

    lift = type(Crane.lift)("A", "B", bore=0.125, rod=0.07, works="both")
    fold = type(Crane.fold)("C", "N", bore=0.14, rod=0.08, works="both")
    extend = type(Crane.extend)("R", "T", bore=0.063, rod=0.04, works="both")

    def limits_of(self):
        return {"phi": (-np.pi, np.pi), "psi": (0.0, np.pi), "t": (0.0, float(self["l_t"]))}


@pytest.mark.slow
def test_area_of_a_crane_that_turns_fully_is_a_ring():
    crane = FreeCrane()
    l_c, l_p, l_t = (float(crane[name]) for name in ("l_c", "l_p", "l_t"))
    inner = max(l_c - l_p - l_t, 0.0, l_p - l_c)
    assert envelope(crane).area == pytest.approx(np.pi * ((l_c + l_p + l_t) ** 2 - inner**2), rel=1e-5)


@cache
def border_of_the_crane():
    return envelope(Crane())


@pytest.mark.slow
def test_reach_is_what_poses_cover():
    """The area is that of the cells of a grid in which random poses have their tips."""
    crane, rng = Crane(), np.random.default_rng(6)
    spans = crane.limits_of()
    phi, psi, t = (rng.uniform(*spans[name], 200_000) for name in ("phi", "psi", "t"))
    x, y = crane.at(phi=phi, psi=psi, t=t)["T"]
    cell = 0.1
    covered = len(np.unique(np.floor(np.column_stack([x, y]) / cell), axis=0)) * cell**2
    assert border_of_the_crane().area == pytest.approx(covered, rel=0.04)


def test_what_a_pose_has_is_reached_and_what_none_has_is_not():
    crane, rng = Crane(), np.random.default_rng(6)
    x, y = crane.at(**{name: rng.uniform(*span, 4) for name, span in crane.limits_of().items()})["T"]
    assert np.isnan(load_map(crane, [2.95, 7.0, 12.0], [0.0, 10.2]).load[[0, 1, 2], [1, 0, 0]]).all()
    tips = load_map(crane, np.sort(y), np.sort(x))
    assert all(tips.reached[k, n] for k, n in zip(np.argsort(np.argsort(y)), np.argsort(np.argsort(x)), strict=True))


@pytest.mark.slow
def test_border_is_closed():
    """Every end of a piece is the end of another one."""
    border = border_of_the_crane().border.reshape(-1, 2)
    gaps = np.hypot(*(border[:, None] - border[None]).transpose(2, 0, 1)) + 1e9 * np.eye(len(border))
    assert np.quantile(gaps.min(axis=1), 0.99) < 1e-9


# The load cases for strength.


@pytest.mark.slow
def test_strength_has_the_forces_of_all_pins():
    crane = Crane()
    found = strength(crane)
    assert list(found) == ["lifting at full reach", "dragging by the arm", "on a side slope"]
    for forces in found.values():
        assert {row.point for row in max_table(forces)} >= {"O", "A", "B", "J", "V", "C", "N", "E"}
    top = {row.point: row.force for row in max_table(found["lifting at full reach"])}
    area = np.pi / 4 * 0.125**2 * 22e6 * 0.95
    assert top["A"] == pytest.approx(area, rel=1e-6)  # with Q = M / L the boom's cylinder is at its limit at the whole reach


def test_dragging_keeps_to_the_ground_and_to_the_cylinders():
    crane = Crane()
    path, pull = dragging(crane)
    assert_allclose(path.y("T"), crane["H_w"], atol=1e-6)
    assert np.all(np.diff(path.x("T")) < 0.0)
    assert np.all(pull > 10 * kN)


# Pictures and the command.


@pytest.mark.slow
@first_daily(1, "name", ["moments", *(name for name in FIGURES if name != "moments")])
def test_figures_are_drawn(name, tmp_path):
    crane_figure(name).savefig(tmp_path / f"{name}.png")
    assert (tmp_path / f"{name}.png").stat().st_size > 20_000


def test_figures_refuse_what_they_cannot_show():
    with pytest.raises(DefinitionError, match="unknown"):
        crane_figure("side")
    with pytest.raises(DefinitionError, match="this is a batch"):
        crane_figure("map", Crane(Q=np.array([1.0, 2.0])))


@pytest.fixture
def run(capsys):
    """Return what `hydrolinkage crane ...` prints, and its exit code; the command is there whether the package is installed or not."""
    from argparse import ArgumentParser

    from mechanisms.crane.cli import DesignedCrane

    def call(*words):
        parser = ArgumentParser()
        made = DesignedCrane
        made.add(parser)
        code = made.run(parser.parse_args(words))
        return code, capsys.readouterr().out

    return call


NAMED = "mechanisms.crane:Crane"


@pytest.mark.slow
def test_command_judges_a_crane_that_is_named_and_writes_the_map(run, tmp_path):
    code, text = run(NAMED, "--csv", str(tmp_path / "map.csv"))
    assert code == 0
    heading, *rows = (tmp_path / "map.csv").read_text().splitlines()
    assert heading.replace('"', "").startswith("T_x, m")
    assert len(rows) == 10
    assert "boom         4.455 m long,  382.7 mm high,   682.3 kg" in text
    assert "   99.93    154.81    154.81    180.00       0.00    -106.77      71.91      71.91" in text
    assert "The tip reaches 111.6 m2." in text


@pytest.mark.slow
def test_command_draws_and_lists_pins(run, tmp_path):
    _, text = run(NAMED, "--pins", "--pictures", str(tmp_path))
    assert "Dragging by the arm" in text
    drives = [f"{side}_{name}" for side in ("boom", "arm") for name in DRIVE_FIGURES]
    assert sorted(path.stem for path in tmp_path.iterdir()) == sorted([*FIGURES, *drives])


def test_command_refuses_in_words(run):
    for words, message in (
        (("--set", "M=20kNm"), "lies outside"),
        (("--set", "mass=3kg"), "Number of the duty"),
        (("--set", "L"), "write a name and a value"),
        (("mechanisms.crane:CraneSkeleton",), "is no crane with its cylinders"),
        ((NAMED, "--skeleton"), "has its skeleton already"),
        ((NAMED, "--scheme", "b"), "is of a crane to design"),
    ):
        with pytest.raises(DefinitionError, match=message):
            run(*words)


@pytest.mark.slow
def test_other_cranes_have_maps_too():
    for crane in (ChainCrane(), DirectCraneAbove()):
        assert np.isfinite(load_map(crane, [2.0], [5.0]).load).all()
    assert CraneSkeleton(**Duty(L=9.0).dimensions())["L"] == 9.0


@first_daily(1, "name", ["boom_drive", "arm_drive"])
def test_the_command_shows_a_drive_with_its_figures(tmp_path, capsys, name):
    folder = tmp_path / "new" / name  # is made
    assert main(["crane", name, "--pictures", str(folder)]) == 0
    said = capsys.readouterr().out
    assert sorted(path.stem for path in folder.iterdir()) == sorted(DRIVE_FIGURES)
    assert re.search("^(ok|FAIL) +moment (lifting|opening)", said, re.MULTILINE)
    assert main(["crane", name, "--pins"]) == 2
    (tmp_path / "file").write_text("", encoding="utf-8")
    assert main(["crane", name, "--pictures", str(tmp_path / "file")]) == 2
