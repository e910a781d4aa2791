"""A motion along a declared path keeps its `Over`: poses at equal shares of the way, the sense of friction, verdicts, readers."""

import numpy as np
import pytest

from linkage import (
    RIGHT,
    Crank,
    DefinitionError,
    Dyad,
    Force,
    Ground,
    Guide,
    GuideFriction,
    Mechanism,
    OnGuide,
    OnLink,
    Over,
    Stroke,
    Weight,
    animate,
    drive_force,
    export,
    least,
    most,
    page,
    pin_forces,
    report,
    y,
)


class Blocks(Mechanism):
    """Two blocks on guides, each pulled back by 1000 N and pressed down by 5000 N: friction of 500 N either way."""

    a, b = Stroke(0.0, 1.0), Stroke(0.0, 1.0)
    low, high = Guide((0, 0), angle=0.0), Guide((0, 1), angle=0.0)
    A, B = OnGuide(low, at=a), OnGuide(high, at=b)
    pull_a, pull_b = Force(A, (-1000.0, -5000.0)), Force(B, (-1000.0, -5000.0))
    rub_a, rub_b = GuideFriction(A, 0.1), GuideFriction(B, 0.1)
    go = Over.path(a=[0.0, 0.5, 0.5, 0.5, 0.2], b=[0.1, 0.1, 0.1, 0.3, 0.3])  # with a hold
    back = Over.path(a=[0.6, 0.1], b=0.2)
    corner = Over(a=(0.0, 0.4), b=(0.0, 0.3))
    band = Over(a=(0.1, 0.4), b=0.3)
    two = Over.poses(a=[0.1, 0.9], b=[0.2, 0.7])


class Lever(Mechanism):
    S = Stroke(0.0, 0.2)
    O, A = Ground(0, 0), Ground(0.5, -0.5)
    B = Dyad(A, O, AB=0.6 + S, OB=0.6, side=RIGHT)
    G = OnLink(O, B, OG=1.2)
    load = Weight(G, mass=100)
    cycle = Over.path(S=[0.0, 0.2, 0.2, 0.05, 0.0])


def test_a_stroke_that_rounding_alone_moves_is_told_as_held():
    noise = 1e-13 * np.array([0.0, 1.0, -1.0, 2.0, 1.0])
    for a, told in ((np.linspace(0.1, 0.5, 5), "100 to 500 mm"), (np.array([0.0, 0.3, 0.5, 0.5, 0.2]) + noise, "0, 500 to 200 mm")):
        motion = Blocks().at(a=a, b=0.3 + noise)
        assert motion.over.words(motion) == f"the path a = {told}, b = 300 mm"


def walked(ways, count):
    """Return strokes at equal shares of a way of legs, each as long as its longest move in parts of its stroke's range: leg by leg."""
    names = list(ways)
    ranges = {name: np.ptp(ways[name]) or 1.0 for name in names}
    lengths = [max(abs(ways[n][k + 1] - ways[n][k]) / ranges[n] for n in names) for k in range(len(ways[names[0]]) - 1)]
    rows = []
    for share in np.linspace(0.0, 1.0, count):
        left = share * sum(lengths)
        for k, length in enumerate(lengths):
            if left <= length + 1e-12 or k == len(lengths) - 1:
                t = min(left / length, 1.0) if length else 0.0
                rows.append([ways[n][k] + t * (ways[n][k + 1] - ways[n][k]) for n in names])
                break
            left -= length
    return np.array(rows).T


@pytest.mark.parametrize("count", [2, 3, 8, 41])
def test_a_sweep_along_a_path_stands_at_equal_shares_of_the_way(count):
    machine = Blocks()
    motion = machine.sweep(count, over="go")
    want = walked({"a": [0.0, 0.5, 0.5, 0.5, 0.2], "b": [0.1, 0.1, 0.1, 0.3, 0.3]}, count)
    np.testing.assert_allclose([motion.strokes["a"], motion.strokes["b"]], want, atol=1e-12)
    assert motion.over is machine.overs[0] and motion.shape == (count,)
    same = machine.at(**motion.strokes)
    np.testing.assert_array_equal(motion["A"], same["A"])


def test_friction_along_a_path_does_not_hang_on_the_number_of_poses():
    """By hand: 1000 N and 500 N against the way, no friction where a block stands. A hold goes on as the next leg does."""
    for count in (5, 9, 33, 200):
        motion = Blocks().sweep(count, over="go")
        a, b = motion.strokes["a"], motion.strokes["b"]
        out = np.where(b < 0.3 - 1e-12, np.where(a < 0.5 - 1e-12, 1.0, 0.0), -1.0)
        up = np.where((a >= 0.5 - 1e-12) & (b < 0.3 - 1e-12), 1.0, 0.0)
        for direction, sense in (("extending", 1.0), ("retracting", -1.0), ("frictionless", 0.0)):
            drives = pin_forces(motion, direction=direction).drives
            np.testing.assert_allclose(drives["a"], 1000.0 + 500.0 * sense * out, rtol=1e-9)
            np.testing.assert_allclose(drives["b"], 1000.0 + 500.0 * sense * up, rtol=1e-9)


def test_friction_from_rest_takes_the_way_that_begins():
    """a = 0.1 + 0.4 t^2 begins at rest: which way it goes is no matter of rounding, whatever the number of poses."""
    for count in (2, 3, 5, 8, 17, 33):
        for sense in (1.0, -1.0):
            t = np.linspace(0.0, 1.0, count)
            motion = Blocks().at(a=0.5 + sense * 0.4 * t * t, b=0.5 - sense * 0.3 * t)
            np.testing.assert_allclose(pin_forces(motion, direction="extending").drives["a"], 1000.0 + sense * 500.0, rtol=1e-9)


def test_one_stroke_up_and_down_is_a_path():
    motion = Lever().sweep(8, over="cycle")
    np.testing.assert_allclose(motion.strokes["S"], walked({"S": [0.0, 0.2, 0.2, 0.05, 0.0]}, 8)[0], atol=1e-12)
    np.testing.assert_array_equal(np.sign(motion.tangent["S"]), [1, 1, 1, 1, -1, -1, -1, -1])
    np.testing.assert_allclose(motion.y("G"), Lever().at(S=motion.strokes["S"]).y("G"))


def test_a_swept_motion_is_judged_where_it_was_declared():
    machine = Blocks()
    for name in ("go", "back", "band", "two"):
        motion = machine.sweep(over=name)
        asked = [most(drive_force("a")), least(drive_force("a")), most(y("B"))]
        declared = machine.answers(asked, over=name)
        assert [str(each) for each in machine.answers(asked, over=motion)] == [str(each) for each in declared]
        assert list(map(str, machine.verdicts(motion))) == list(map(str, machine.verdicts(over=name)))
    few, many = (Lever().answers([most(y("G"))], over=Lever().sweep(count, over="cycle"))[0] for count in (2, 50))
    assert few.value == many.value


def test_what_cannot_be_swept_is_refused_with_the_remedy():
    machine = Blocks()
    cases = {
        "Known: go, back, corner, band, two": lambda: machine.sweep(3, over="gone"),
        "leave out a=1": lambda: machine.sweep(3, over="go", a=1),
        "2 at least": lambda: machine.sweep(1, over="go"),
        "whole number": lambda: machine.sweep(2.5, over="go"),
        "write sweep(a=11, b=11), or sweep over an Over.path": lambda: machine.sweep(5, over="corner"),
        "leave out the count": lambda: machine.sweep(3, over="two"),
        "an Over is expected": lambda: machine.sweep(3, over=3.0),
        "a motion has its own way": lambda: animate(machine.sweep(3, over="go"), "x.gif", at={"a": 0.1}),
    }
    for words, wrong in cases.items():
        with pytest.raises(DefinitionError) as caught:
            wrong()
        assert words in " ".join(str(caught.value).split()), words


@pytest.mark.slow
def test_every_reader_takes_a_swept_motion(tmp_path):
    class Arm(Lever):
        turn = Stroke(0.0, 1.0)
        K = Crank("O", OK=0.2, angle=turn)
        cycle = Over.path(S=[0.0, 0.2, 0.0], turn=[0.0, 0.5, 0.0])

    motion = Arm().sweep(9, over="cycle")
    assert all(animate(motion, tmp_path / name, count=2).exists() for name in ("a.gif", "a.html"))
    assert page(motion, tmp_path / "p.html").exists()
    text = report(motion, tmp_path / "r.md", count=3).read_text(encoding="utf-8")
    assert "| Run | S = 0, 200 to 0 mm, turn = 0, 28.6479 to 0 deg, 3 poses in tables |" in text
    assert "| Judged over | the path S = 0, 200 to 0 mm, turn = 0, 28.6479 to 0 deg |" in text
    assert len(export(motion, tmp_path / "m.csv").read_text(encoding="utf-8").splitlines()) == 10
