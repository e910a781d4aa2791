"""Laws of the gap of outlines: where the pair stands, how it is turned, mirrored, exchanged and written down changes nothing."""

from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import Crank, Ground, Mechanism, Outline, Part, Planes, Stroke, clearance, gap, mm, ref
from tests.for_all import first_daily

SEEDS = first_daily(1, "seed", [0, 3, 1, 2, *range(4, 30)])
SIZE = 1.5  # m, about how far the outlines reach
STROKES = {"s": np.linspace(0.0, 1.4, 9)}


def star(rng, corners):
    """Return a closed line without crossings, seen whole from its middle, shape (n, 2)."""
    ways = np.linspace(0, 2 * np.pi, corners, endpoint=False) + rng.uniform(0, 0.6 * 2 * np.pi / corners, corners)
    sizes = rng.uniform(0.08, 0.4, corners)
    return np.column_stack([sizes * np.cos(ways), sizes * np.sin(ways)])


def drawn_pair(seed):
    """Return two random closed lines; but for every third seed they are long enough to cross deeply."""
    rng = np.random.default_rng([23, seed])
    one, other = star(rng, int(rng.integers(6, 9))), star(rng, int(rng.integers(5, 8)))
    return (one, other) if seed % 3 == 2 else (1.8 * one, 1.8 * other)


def pair_machine(one, other, *, turn=0.0, shift=(0.0, 0.0), mirrored=False, swapped=False):
    """Return a machine of two levers with an outline on each; the whole mirrored at the y axis, turned about the origin, then shifted."""
    sign = -1.0 if mirrored else 1.0

    def place(x, y):
        x *= sign
        return x * np.cos(turn) - y * np.sin(turn) + shift[0], x * np.sin(turn) + y * np.cos(turn) + shift[1]

    def corners(line):
        return [(float(x), float(sign * y)) for x, y in line]  # of the body's own axes, whose x goes along it

    base = np.pi + turn if mirrored else turn
    members = {
        "s": Stroke(0.0, 1.4),
        "O": Ground(*map(float, place(0.0, 0.0))),
        "C": Ground(*map(float, place(1.1, 0.1))),
        "ahead": base + sign * ref("s"),
        "back": base + sign * (3.3 - 0.7 * ref("s")),
        "A": Crank("O", OA=0.5, angle="ahead"),
        "B": Crank("C", CB=0.5, angle="back"),
        "one": Outline(corners(one), on="A O"),
        "other": Outline(corners(other), on="C B"),
        "planes": Planes("OA CB", width=20 * mm),
    }
    order = ["other", "one"] if swapped else ["one", "other"]
    names = [name for name in members if name not in order]
    return type("Pair", (Mechanism,), {name: members[name] for name in [*names[:-1], *order, names[-1]]})


def gaps(machine, a="one", b="other"):
    """Return the gap of the two outlines over the stroke, and the clearance of the machine."""
    motion = machine().at(**STROKES)
    return motion[gap(a, b)], motion[clearance()]


def same(found, wanted):
    assert_allclose(found, wanted, rtol=0.0, atol=1e-12 * SIZE)


@cache
def alone(seed):
    """Return the outlines that a seed draws, the machine that has them, and its gaps."""
    one, other = drawn_pair(seed)
    machine = pair_machine(one, other)
    return one, other, machine, gaps(machine)


@pytest.mark.slow
@SEEDS
def test_where_the_pair_stands_changes_nothing(seed):
    one, other, _, wanted = alone(seed)
    rng = np.random.default_rng(seed)
    moved = pair_machine(one, other, turn=rng.uniform(-3.0, 3.0), shift=rng.uniform(-2.0, 2.0, 2), mirrored=bool(seed % 2))
    for found, own in zip(gaps(moved), wanted, strict=True):
        same(found, own)


@SEEDS
def test_how_the_pair_is_written_changes_nothing(seed):
    """Exchanged in the request and in the class; the corners counted from another one, and the other way round."""
    one, other, _, wanted = alone(seed)
    again = gaps(pair_machine(one[::-1], np.roll(other, 2, axis=0), swapped=True), "other", "one")
    same(again[0], wanted[0])
    same(again[1], wanted[1])


@SEEDS
def test_the_outlines_of_a_part_keep_their_gap(seed):
    """A part that is placed, turned, mirrored: the gap of its outlines is that of the machine alone, also against the whole's."""
    _, _, machine, (wanted, _) = alone(seed)
    rng = np.random.default_rng(seed)
    s = Stroke(0.0, 1.4)
    at, angle = tuple(map(float, rng.uniform(-2.0, 2.0, 2))), float(rng.uniform(-3.0, 3.0))
    whole = type("Whole", (Mechanism,), {"s": s, "own": Part(machine, s="s", at=at, angle=angle, mirrored=seed % 2 == 0, planes=None)})
    same(whole().at(**STROKES)[gap("own.one", "own.other")], wanted)


def test_two_mirrored_parts_face_each_other():
    """A machine and its mirror image: the gap between an outline and its image is twice the way to the mirror."""
    square = [(0.0, -0.1), (0.5, -0.1), (0.6, 0.0), (0.5, 0.1), (0.0, 0.1)]

    class Lever(Mechanism):
        s = Stroke(0.0, 0.7)
        O = Ground(1.0, 0.0)
        A = Crank(O, OA=0.5, angle=np.pi - ref("s"))
        blade = Outline(square, on="O A")

    class Facing(Mechanism):
        s = Stroke(0.0, 0.7)
        right, left = Part(Lever, s="s"), Part(Lever, s="s", mirrored=True)

    motion = Facing().sweep(s=15)
    s = motion.strokes["s"]
    corners = np.array(square)
    x = 1.0 - corners[:, :1] * np.cos(s) + corners[:, 1:] * np.sin(s)  # the body's y axis lies to the left of O -> A
    assert_allclose(motion[gap("right.blade", "left.blade")], 2.0 * x.min(axis=0), atol=1e-12)
