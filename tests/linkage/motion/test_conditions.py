"""A pose's condition comes from what is asked, whatever it is asked by; what lies between two poses is told."""

import ctypes
import math
import re
import shutil
import subprocess
import warnings

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    AssemblyError,
    Crank,
    Dyad,
    Ground,
    Guide,
    Link,
    Mechanism,
    OnGuide,
    OnLink,
    Pin,
    SingularError,
    SingularWarning,
    Stroke,
    angle,
    condition,
    distance,
    drive_force,
    driving_force,
    pin_force,
    pin_forces,
    ratio,
    ref,
)
from linkage.loads import Weight
from linkage.motion import evaluation, motion, requests
from linkage.motion.evaluation import examined, keeps_digits
from linkage.motion.grid import Grid
from linkage.motion.requests import bound
from tests.for_all import for_all
from tests.laws.near_singular import pose

STEPS = 10.0 ** -np.arange(1.0, 16.0)


class Lever(Mechanism):
    """A cylinder AB on a lever OB with a weight; dead points at S = 0.7 and 1.3."""

    S, A, O = Stroke(0.1, 3.0), Ground(0, 0), Ground(1.0, 0)
    B = Dyad(A, O, AB=S, OB=0.3, side=LEFT)
    load = Weight(B, mass=100.0)


class Platform(Mechanism):
    """A plate on three rods, one of them on a crank."""

    phi = Stroke(0.0, 0.6)
    O, P, Q = Ground(0, 0), Ground(3, 0), Ground(1.5, 3)
    A = Crank(O, OA=0.5, angle=phi)
    plate = Link("D E F", DE=1, DF=0.9, EF=0.8)
    r1, r2, r3 = Link("A D", AD=0.8), Link("P E", PE=1.0), Link("Q F", QF=1.9)
    D, E, F = Pin(near=(1.2, 0.5)), Pin(near=(2.2, 0.5)), Pin(near=(1.6, 1.3))


def test_the_condition_is_that_of_two_rows_that_meet():
    (found,) = Lever().evaluate([condition("B")], S=0.7 + STEPS[4:12])
    cosine = ((0.7 + STEPS[4:12]) ** 2 + 0.09 - 1.0) / (2 * 0.3 * (0.7 + STEPS[4:12]))
    sine = np.sqrt((1 - cosine) * (1 + cosine))
    assert np.all(found > 2.0 / sine * 0.99)
    assert np.all(found < 2.0 / sine * 8.0)  # the base is three times as long as the lever
    assert np.all(np.diff(found) > 0.0)


def test_the_condition_is_the_same_in_every_way():
    S = 0.7 + STEPS[:10]
    (by_blocks,) = Lever().evaluate([condition("B")], S=S, backend="numpy")
    (by_floats,) = Lever().evaluate([condition("B")], S=S, backend="floats")
    function = Lever().function([condition("B")])
    assert_allclose(by_floats, by_blocks, rtol=1e-12)
    assert_allclose([function(s)[0] for s in S], by_blocks, rtol=1e-12)
    assert Lever().function([condition()])(0.7)[0] > 1e15


@pytest.mark.skipif(shutil.which("gcc") is None, reason="no C compiler")
def test_the_condition_goes_into_the_text(tmp_path):
    text, S = Lever().source(["B", condition("B")]), 0.7 + STEPS[:10]
    (tmp_path / "k.c").write_text(text, encoding="utf-8")
    subprocess.run(["gcc", "-O2", "-shared", "-fPIC", "-o", tmp_path / "k.so", tmp_path / "k.c", "-lm"], check=True)
    design = np.array([float(value) for value in re.findall(r"= ([-0-9.e]+)", text.split("*/")[0])])
    pointer, out = ctypes.POINTER(ctypes.c_double), np.empty((3, S.size))
    arguments = [(pointer * len(rows))(*(row.ctypes.data_as(pointer) for row in rows)) for rows in (S[None], out)]
    ctypes.CDLL(str(tmp_path / "k.so")).poses(ctypes.c_long(S.size), design.ctypes.data_as(pointer), *arguments)
    assert_allclose(out[2], Lever().evaluate([condition("B")], S=S)[0], rtol=1e-9)


@pytest.mark.parametrize("pin", "DEF")
def test_every_pin_of_a_group_is_guarded(pin):
    with pytest.raises(AssemblyError, match='Group\\("D E F"\\)'):
        Platform().evaluate([pin], phi=1.1)
    with pytest.raises(AssemblyError, match='Group\\("D E F"\\)'):
        Platform().function([pin])(1.1)
    end = Platform().at(phi=0.3).limits()["phi"].intervals[-1].high
    for away in (1e-4, 1e-6, 1e-8, 2e-9):
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            Platform().evaluate([ratio(pin)], phi=end - away)
            Platform().at(phi=end - away).ratio(pin)
        assert len(told) in (0, 2)  # both ways say the same
    with pytest.warns(SingularWarning, match="the group D E F"):
        Platform().evaluate([ratio(pin)], phi=end - 2e-9)


@pytest.mark.parametrize("away", [1e-13, 1e-15, 0.0])
def test_forces_are_refused_where_ratios_are(away):
    S = 0.7 + away
    asks = (
        lambda: driving_force(Lever().at(S=S)),
        lambda: pin_forces(Lever().at(S=S)),
        lambda: Lever().evaluate([drive_force()], S=S),
        lambda: Lever().evaluate([pin_force("O")], S=S),
        lambda: Lever().function([drive_force()])(S),
        lambda: Lever().at(S=S).gradient(drive_force(), ["OB"]),
    )
    for ask in asks:
        with pytest.raises(SingularError):
            ask()


def test_the_same_pose_is_judged_alike_in_a_crowd():
    S = 0.7 + STEPS
    alone = []
    for s in S:
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", SingularWarning)
                alone.append(float(Lever().evaluate([ratio("B")], S=s)[0][1]))
        except SingularError:
            alone.append(math.nan)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SingularWarning)
        (crowd,) = Lever().evaluate([ratio("B"), "B"], S=S, unreachable="nan")[:1]
    assert_allclose(crowd[1], alone, rtol=1e-12)


class Through(Mechanism):
    """P runs on a rail through the fixed point A."""

    S, A = Stroke(-0.1, 0.1), Ground(0.0, 0.0)
    rail = Guide((0.0, 0.0), angle=0.3)
    P = OnGuide(rail, at=S)


@for_all(
    "members",
    [
        {"X": OnLink("A", "P", AX=0.3)},
        {"bar": Guide("A", "P"), "X": OnGuide("bar", at=0.3)},
        {"X": Crank("A", AX=0.3, angle=angle("A", "P"))},
    ],
    ids=["on a link", "on a guide", "along a direction"],
)
@for_all("S", [[-0.1, 0.1], [-0.1, -0.03, 0.07], [-1e-4, 0.09]], ids=str)
def test_a_direction_that_is_lost_between_two_poses_is_told(members, S):
    machine = type("Over", (Through,), members)
    with pytest.raises(SingularError, match="without a direction at S"):
        machine().at(S=S)
    motion = machine().at(S=S, unreachable="nan")
    assert len(motion.interruptions) == 1
    assert abs(motion.interruptions[0].deepest) < 1e-9
    assert machine().at(S=np.abs(S)).interruptions == ()


@for_all("asked", ["v", angle("A", "P")], ids=str)
@for_all("away", [1e-3, 1e-6, 1e-9])
def test_a_direction_that_only_a_request_takes_is_judged_alike_in_every_way(asked, away):
    class Near(Mechanism):
        """P runs on a rail 1 nm below the fixed point A."""

        S, A = Stroke(0.1, 0.5), Ground(0.3 * np.cos(0.3), 0.3 * np.sin(0.3) + 1e-9)
        rail = Guide((0.0, 0.0), angle=0.3)
        P = OnGuide(rail, at=S)
        v = angle(A, P)

    S = 0.3 + away
    asks = [lambda: Near().evaluate([ratio(asked)], S=S)[0], lambda: Near().function([ratio(asked)])(S)[0]]
    asks.append(lambda: Near().at(S=S).ratio(asked))
    told = []
    for ask in asks:
        with warnings.catch_warnings(record=True) as warned:
            warnings.simplefilter("always")
            ask()
        told.append([each.message.estimate for each in warned])
    assert len(told[0]) == (away < 1e-8)
    assert told == [told[0]] * 3


def test_a_length_that_touches_zero_interrupts_nothing():
    machine = type("Measured", (Through,), {"u": distance("A", "P")})
    assert machine().sweep(4).interruptions == ()


def test_an_angle_that_is_followed_and_a_loop_behind_it_are_looked_at_together():
    class Drag(Mechanism):
        """A drag link whose follower turns another crank by a fraction of its angle, which carries a dyad."""

        phi = Stroke(0.0, 6.0)
        O, Q, T = Ground(0.0, 0.0), Ground(0.1, 0.0), Ground(3.0, 0.0)
        A = Crank(O, OA=1.0, angle=phi)
        B = Dyad(A, Q, AB=1.1, QB=1.0, side=LEFT)
        C = Crank(T, TC=0.3, angle=-0.7 * angle(Q, B))
        D = Dyad(C, Q, CD=1.9, QD=1.6, side=LEFT)

    motion = Drag().sweep(61)
    assert np.isfinite(motion["D"]).all()
    assert motion.interruptions == ()
    assert np.abs(np.diff(motion["C"])).max() < 0.1


@for_all(
    "ask",
    [
        lambda lever, near: near.ratio("B"),
        lambda lever, near: near.gradient("B", wrt=["OB"]),
        lambda lever, near: near.gradient(ratio("B"), wrt=["OB"]),
        lambda lever, near: near.velocity("B", rates=dict(S=1.0)),
        lambda lever, near: near.acceleration("B", rates=dict(S=1.0)),
        lambda lever, near: near.ratio(angle("O", "B")),
        lambda lever, near: lever.evaluate([ratio("B")], S=0.7 + 1e-9),
        lambda lever, near: lever.function([ratio("B")])(0.7 + 1e-9),
        lambda lever, near: driving_force(near),
        lambda lever, near: pin_forces(near),
    ],
)
def test_a_warning_points_to_the_line_that_asked(ask):
    lever = Lever()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SingularWarning)
        near = lever.at(S=0.7 + 1e-9)
    with pytest.warns(SingularWarning) as found:
        ask(lever, near)
    assert {each.filename for each in found} == {__file__}


class Rail(Mechanism):
    """A point P on a rail that passes a fixed point A at S = 0.3."""

    S, A, O = Stroke(0.0, 1.0), Ground(0.3, 0.0), Ground(0.0, 0.0)
    rail = Guide((0.0, 0.0), angle=0.0)
    P = OnGuide(rail, at=S)
    seen = angle(A, P)


@for_all("beside", [[], ["seen"], [ratio("seen")], [ratio(angle("A", "P"))], [angle("A", "P"), distance("A", "P")]])
def test_a_condition_does_not_hang_on_what_is_asked_beside_it(beside):
    """Of all points it is regular, for A is no part of P; a direction between the two has a condition of its own."""
    asked = [condition(), condition("P"), condition("seen"), condition(angle("A", "P"))]
    for order in (1, -1):
        found = Rail().evaluate([*beside, *asked][::order], S=0.3 + 1e-6, unreachable="nan")[::order][len(beside) :]
        assert_allclose(found[:2], 2.0 / 0.3)
        assert_allclose(found[2:], 2.0 * 1.0 / 1e-6, rtol=0.7)
        assert found[2] == pytest.approx(found[3], rel=1e-9)


def leaning(count):
    """Return a class of dyads one on the other, whose legs stand 8 degrees from line."""
    lean = np.radians(8.0)
    members = dict(S=Stroke(0.0, 0.05), O=Ground(0, 0), A0=Crank("O", OA0=0.3, angle=4.0 * ref("S") + 1.2))
    place, share = 0.3 * np.exp(1.2j), 0.55
    for k in range(1, count + 1):
        members[f"G{k}"] = Ground(k + 0.2, 0.0)
        base = k + 0.2 - place
        size = abs(base) / np.sqrt(share**2 + (1.0 - share) ** 2 + 2.0 * share * (1.0 - share) * np.cos(lean))
        near, far = share * size, (1.0 - share) * size
        members[f"A{k}"] = Dyad(f"A{k - 1}", f"G{k}", **{f"A{k - 1}A{k}": float(near), f"G{k}A{k}": float(far)}, side=LEFT)
        turn = np.arccos((abs(base) ** 2 + near**2 - far**2) / (2.0 * abs(base) * near))
        place = place + near * np.exp(1j * turn) * base / abs(base)
    return type(f"Leaning{count}", (Mechanism,), members)


@pytest.mark.slow
def test_what_only_the_product_of_its_parts_suspects_is_looked_at_by_a_compiled_program(monkeypatch):
    """Six dyads of which each is far from its dead point: none of their poses is worked out node by node, and the values are the same."""
    machine, S = leaning(6)(), np.linspace(0.0, 2e-4, 300)
    closely = []
    for module in (evaluation, motion):
        monkeypatch.setattr(module, "examined", lambda *given: closely.append(given) or requests.examined(*given))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        places, ratios = machine.evaluate(["A6", ratio("A6")], S=S)
        assert_allclose(machine.at(S=S).ratio("A6"), ratios, rtol=1e-9)
        f = machine.function(["A6", ratio("A6")])
        for k in (0, 100, 299):
            assert_allclose(f(S[k]), [*places[:, k], *ratios[:, k]], rtol=1e-9)
    step = 1e-6
    central = (machine.evaluate(["A6"], S=S + step)[0] - machine.evaluate(["A6"], S=S - step)[0]) / (2.0 * step)
    assert_allclose(ratios, central, rtol=1e-4)
    assert not closely


@for_all("part", range(1), slow=range(1, 4))
def test_a_coarse_look_passes_nothing_that_loses_digits(part):
    passed = 0
    for seed in range(8 * part, 8 * part + 8):
        drafted = pose(seed)
        if drafted is None:
            continue
        kind, strokes, target, _ = drafted
        random, name = np.random.default_rng(seed), next(iter(strokes))
        shifted = {each: np.full(10, value) for each, value in strokes.items()}
        shifted[name] = strokes[name] * (1.0 + random.normal(size=10) * 10.0 ** random.uniform(-12, -1, 10))
        grid, everywhere = Grid(kind.plan, kind().dimensions, shifted), np.ones(10, bool)
        for asked in (target, ratio(target, wrt=name), ratio(target, wrt=name, order=2)):
            what = bound(kind.plan, asked)
            keeps = keeps_digits(kind.plan, [what], grid.flat, everywhere[None, None])[0, 0]
            (found,) = examined(kind.plan, [what], grid.inputs_at(everywhere), grid.read_at(everywhere), [0])
            error = found.error
            assert not (error[keeps] > 1e-9).any()
            passed += int(keeps.sum())
    assert passed > 10
