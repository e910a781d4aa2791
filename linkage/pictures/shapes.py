"""Forms of bodies, the line around their points at a distance, and the lines of springs, dampers, telescopes and symbols."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from types import MappingProxyType

import numpy as np
import numpy.typing as npt

from ..frozen import immutable
from ..program import FloatArray

ARC = np.radians(11.3)  # no part of a right angle, so that rounding does not change how many steps a corner takes


def polar(angle: FloatArray | float) -> FloatArray:
    """Return the unit vectors of angles [rad], shape (..., 2)."""
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def left_of(vector: FloatArray) -> FloatArray:
    """Return a vector (2,) turned to its left by a right angle."""
    return np.array([-vector[1], vector[0]])


def hull(points: FloatArray) -> list[int]:
    """Return the indices of the convex hull, counter-clockwise; two where all points lie on a line.

    `points` has the shape (n, 2). Source: A. M. Andrew, monotone chain, 1979.
    """
    order = sorted(range(len(points)), key=lambda index: (points[index][0], points[index][1]))
    slack = 1e-9 * float(np.ptp(points, axis=0).max()) ** 2
    lower, upper = _chain(points, order, slack), _chain(points, order[::-1], slack)
    return lower[:-1] + upper[:-1] or order[:1]


def _chain(points: FloatArray, order: list[int], slack: float) -> list[int]:
    """Return one side of the hull."""
    chain: list[int] = []
    for index in order:
        while len(chain) > 1:
            a, b, c = (points[each] for each in (*chain[-2:], index))
            if (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > slack:
                break
            chain.pop()
        chain.append(index)
    return chain


def rounded_outline(corners: FloatArray, radius: float) -> FloatArray:
    """Return the line around a polygon at a distance, shape (m, 2).

    `corners` has the shape (k, 2), counter-clockwise: one gives a circle, two a bar with round ends. Where the polygon turns inwards
    the line keeps a corner.
    """
    if len(corners) == 1:
        around = np.linspace(0.0, 2 * np.pi, 33)
        return np.asarray(corners[0] + radius * polar(around))
    along = np.roll(corners, -1, axis=0) - corners
    normals = np.arctan2(-along[:, 0], along[:, 1])
    pieces = []
    for corner, start, end in zip(corners, np.roll(normals, 1), normals, strict=True):
        swing = (end - start) % (2 * np.pi)
        if swing < 1.05 * np.pi:
            angles, reach = start + np.linspace(0.0, swing, 2 + int(swing / ARC)), 1.0
        else:  # inwards, where both sides meet
            angles = np.array([start + 0.5 * (swing - 2 * np.pi)])
            reach = 1.0 / max(float(np.cos(0.5 * (2 * np.pi - swing))), 0.2)
        pieces.append(corner + radius * reach * polar(angles))
    return np.concatenate([*pieces, pieces[0][:1]])


OBTUSE = np.radians(100.0)
WEB = 0.5


def plate_form(points: FloatArray, size: float, joints: Sequence[bool]) -> FloatArray:
    """Return a body's form as shares of its points in each corner, shape (k, n), counter-clockwise; it is drawn `size` [m] around these.

    That is the convex hull of the points, shape (n, 2) [m]. Where that is a triangle with a wide angle at a joint it is two arms with a
    web between them: a bell crank does not reach to the chord. `joints` tells which points are pins.
    """
    found = hull(points)
    shares = np.eye(len(points))[found]
    if len(found) != 3:
        return shares
    for place in range(3):
        a, vertex, b = (found[(place + step) % 3] for step in (-1, 0, 1))
        one, two = points[a] - points[vertex], points[b] - points[vertex]
        lengths = float(np.hypot(*one)), float(np.hypot(*two))
        turn = float(np.arccos(np.clip(one @ two / (lengths[0] * lengths[1]), -1.0, 1.0)))
        if joints[vertex] and turn > OBTUSE and np.sin(turn) * min(lengths) > 0.8 * size:
            eye, web = np.eye(len(points)), WEB * min(lengths)  # there along the outside, back along the web's hollow
            start = eye[vertex] + web / lengths[1] * (eye[b] - eye[vertex])
            end = eye[vertex] + web / lengths[0] * (eye[a] - eye[vertex])
            hollow = [(1 - t) ** 2 * start + 2 * t * (1 - t) * eye[vertex] + t**2 * end for t in np.linspace(0.0, 1.0, 6)]
            arms = np.array([eye[a], eye[vertex], eye[b], *hollow])
            corners = arms @ points  # all points have to lie near its line
            ends = np.roll(corners, -1, axis=0) - corners
            share = np.einsum("pkc,kc->pk", points[:, None] - corners, ends) / np.maximum(np.einsum("kc,kc->k", ends, ends), 1e-300)
            nearest = corners + np.clip(share, 0.0, 1.0)[..., None] * ends
            return arms if (np.linalg.norm(points[:, None] - nearest, axis=-1).min(axis=1) < 0.6 * size).all() else shares
    return shares


def hatches(line: FloatArray, size: float) -> FloatArray:
    """Return the hatches on the right of a line, shape (n, 2) [m], as pairs of ends, shape (m, 2, 2): short ones of the size [m]."""
    found = []
    for start, end in pairwise(line):
        long = float(np.hypot(*(end - start)))
        along = (end - start) / (long or 1.0)
        right = np.array([along[1], -along[0]])
        found += [(start + (s + size) * along, start + s * along + size * right) for s in np.arange(0.0, long - size, 1.6 * size)]
    return np.array(found).reshape(-1, 2, 2)


def segment(start: FloatArray, end: FloatArray, step: float) -> FloatArray:
    """Return points along a straight line, no further apart than a step, shape (m, 2)."""
    count = 2 + int(np.hypot(*(end - start)) / step)
    return np.asarray(start + np.linspace(0.0, 1.0, count)[:, None] * (end - start))


def lines_cross(one: FloatArray, other: FloatArray) -> npt.NDArray[np.bool_]:
    """Return which lines cross, each from an end to another, shape (..., 2, 2), broadcast against each other."""

    def side(line: FloatArray, place: FloatArray) -> FloatArray:
        along, arm = line[..., 1, :] - line[..., 0, :], place - line[..., 0, :]
        return np.asarray(along[..., 0] * arm[..., 1] - along[..., 1] * arm[..., 0])

    apart = [side(a, b[..., 0, :]) * side(a, b[..., 1, :]) < 0.0 for a, b in ((one, other), (other, one))]
    return np.asarray(apart[0] & apart[1])


# How straight two-point elements look: springs, dampers and plain struts as lines that stretch with their length.

#: half the width of each kind, in sizes
HALF = {"cylinder": 1.5, "spring": 1.15, "damper": 1.15, "strut": 0.4}
APART = 3.6
"""How far apart two elements on the same points stand, in sizes."""
YOKE = 0.38
"""Half the thickness of the piece that holds an element beside its pin, in sizes."""


@immutable
class DrawnLine:
    """One line of a mark: rows of a share of its length, a way along it [m], one across, to the left [m], and 1 where a piston moves it.

    `fill` is a colour of the style by its name, or none.
    A place stands share * length + way from the first point, so that it moves as the element grows.
    """

    rows: FloatArray
    fill: str = ""
    closed: bool = False
    bold: bool = False

    def at(self, length: float, piston: float = 0.0) -> FloatArray:
        """Return the line at a length and a place of the piston [m], along and across, shape (n, 2) [m]."""
        share, along, across, *slides = self.rows.T
        return np.column_stack([share * length + along + sum(slide * piston for slide in slides), across])

    def moved(self, aside: float) -> DrawnLine:
        """Return it moved to the left [m]."""
        rows = self.rows.copy()
        rows[:, 2] += aside
        return replace(self, rows=rows)


def outline(*rows: tuple[float, ...], fill: str = "", closed: bool = False, bold: bool = False) -> DrawnLine:
    """Return a line through some rows."""
    return DrawnLine(np.array(rows), fill, closed, bold)


def keeping(points: FloatArray, *, fill: str = "", closed: bool = False, bold: bool = False) -> DrawnLine:
    """Return a line that keeps its form, through points along and across, shape (n, 2) [m]."""
    return DrawnLine(np.column_stack([np.zeros(len(points)), points]), fill, closed, bold)


def circle(radius: float, fill: str = "") -> DrawnLine:
    """Return a circle of a radius [m]."""
    return keeping(rounded_outline(np.zeros((1, 2)), radius), fill=fill, closed=True)


def spring(short: float, long: float, size: float) -> tuple[DrawnLine, ...]:
    """Return a zigzag with straight ends."""
    end, half = min(1.8 * size, 0.15 * short), HALF["spring"] * size
    turns = int(np.clip(short / (2.2 * size), 4, 9))
    share = (np.arange(2 * turns) + 0.5) / (2 * turns)
    sides = np.where(np.arange(2 * turns) % 2, -half, half)
    coils = np.column_stack([share, end * (1.0 - 2.0 * share), sides])
    ends = [[[0.0, 0.0, 0.0], [0.0, end, 0.0]], [[1.0, -end, 0.0], [1.0, 0.0, 0.0]]]
    return (DrawnLine(np.concatenate([ends[0], coils, ends[1]]), bold=True),)


def damper(short: float, long: float, size: float) -> tuple[DrawnLine, ...]:
    """Return a pot that is open towards the second point, and the plate in it; its travel is drawn shorter where the pot is."""
    half, bottom, mouth = HALF["damper"] * size, min(2.2 * size, 0.2 * short), 0.66 * short
    pad = min(0.9 * size, 0.15 * (mouth - bottom))
    share = min(1.0, (mouth - bottom - 2.0 * pad) / (long - short)) if long > short else 0.0
    plate = bottom + pad - share * short
    pot = outline((0.0, mouth, half), (0.0, bottom, half), (0.0, bottom, -half), (0.0, mouth, -half), fill="BARREL")
    disc = outline((share, plate, 0.82 * half), (share, plate, -0.82 * half), bold=True)
    rods = outline((0.0, 0.0, 0.0), (0.0, bottom, 0.0)), outline((share, plate, 0.0), (1.0, 0.0, 0.0), bold=True)
    return (pot, *rods, disc)


def strut(short: float, long: float, size: float) -> tuple[DrawnLine, ...]:
    """Return a thin bar."""
    half = HALF["strut"] * size
    return (outline((0.0, 0.0, half), (1.0, 0.0, half), (1.0, 0.0, -half), (0.0, 0.0, -half), fill="ROD", closed=True),)


def tangent_line(start: float, end: float, length: float) -> DrawnLine:
    """Return the common tangent of circles of signed radii [m], above zero to the left of it, whose centres are about a length apart [m].

    Where it touches follows the length to the first order.
    """
    step = float(np.clip((end - start) / length, -1.0, 1.0))
    across, along = np.sqrt(1.0 - step * step), step
    ends = [(share, -2.0 * radius * along, -radius * across) for share, radius in ((0.0, start), (1.0, end))]
    return outline(*((share + radius * along / length, way, side) for (share, way, side), radius in zip(ends, (start, end), strict=True)))


# Cylinders, telescopes, and the accumulators of a gas-fed line; the blocks that slide on tracks.

LONG, BLOCK, SLOT = 2.1, 1.25, 0.7
"""Half a block's length and width, and half a slot's width, in sizes."""


def cylinder(bottom: float, mouth: float, size: float) -> tuple[DrawnLine, ...]:
    """Return the eye, the barrel cut open from its bottom to its mouth [m], the rod, the piston, and the cap at the mouth."""
    half, ends = 1.12 * size, 0.42 * size
    return (
        tube(0.0, 0.0, 0.0, bottom, 0.62 * size, "PISTON"),
        tube(0.0, bottom, 0.0, mouth, 1.3 * size, "BARREL"),
        tube(0.0, 0.0, 1.0, 0.0, ends, "ROD", (1.0, 0.0)),
        tube(0.0, -0.45 * size, 0.0, 0.45 * size, half, "PISTON", (1.0, 1.0)),
        tube(0.0, mouth - 0.35 * size, 0.0, mouth + 0.35 * size, 1.5 * size, "PISTON"),
    )


SINGLE, FREE = 0.95, 0.8
"""The share of its closed length that a rod alone comes out at most, and that each stage of a telescope does."""
MOST_STAGES = 8
"""No telescope is drawn with more: where its pins come together their number would grow without end."""


def stages(short: float, long: float, fixed: float | None = None) -> int:
    """Return how many stages slide in each other so that a length grows from short to long [m]; `fixed` is how long the first stands."""
    room, way = short if fixed is None else min(fixed, short), long - short
    return 1 if way <= SINGLE * room or not room > 0.0 else int(np.clip(np.ceil(way / (FREE * room) - 1e-9), 2, MOST_STAGES))


def nested_stages(short: float, count: int, size: float) -> Iterator[tuple[int, float, float, float, float]]:
    """Yield the stages of nested tubes, the thinnest first: number, half its width, begin and end as it stands drawn in, half its ring."""
    step, widest = min(size, (1.0 - FREE) * 0.6 * short / (count + 3.0)), 1.5 * size  # so that each stage still stands in the one before
    for stage in range(count, -1, -1):
        tip = short - (count - stage) * step - 1.6 * step * (stage < count)
        yield stage, widest - stage * (widest - 0.45 * size) / count, 1.4 * step, tip, 0.4 * step


def nested_tubes(short: float, long: float, size: float) -> tuple[DrawnLine, ...]:
    """Return a cylinder of several stages as nested tubes, the barrel and the widest ones over the thinner."""
    count, lines = stages(short, long), list[DrawnLine]()
    for stage, half, bottom, tip, ring in nested_stages(short, count, size):
        share, out = stage / count, -(stage / count) * short
        if stage == count:
            lines.append(tube(0.0, 0.0, 0.0, bottom, 0.62 * size, "PISTON"))
        lines.append(tube(share, bottom + out, share, tip + out, half, "ROD" if stage == count else "BARREL"))
        if stage < count:
            lines.append(tube(share, tip + out - ring, share, tip + out + ring, half + 0.2 * size, "PISTON"))
    return tuple(lines)


def staged_tubes(closed: float, count: int, size: float) -> list[tuple[DrawnLine, ...]]:
    """Return the lines of a telescope of some moving stages, as they stand in it drawn in, the thinnest first and the barrel last.

    Those of a stage move with what it is out, the tip of the thinnest to the end of the length.
    """
    found = list[tuple[DrawnLine, ...]]()
    for stage, half, bottom, tip, ring in nested_stages(closed, count, size):
        if stage == count:
            found.append((tube(0.0, bottom, 1.0, 0.0, half, "ROD", (1.0, 0.0)),))
            continue
        moves = (float(stage > 0),) * 2
        box = tube(0.0, bottom, 0.0, tip, half, "BARREL", moves), tube(0.0, tip - ring, 0.0, tip + ring, half + 0.2 * size, "PISTON", moves)
        found.append(box if stage else (tube(0.0, 0.0, 0.0, bottom, 0.62 * size, "PISTON"), *box))
    return found


def tube(share: float, start: float, other: float, end: float, half: float, fill: str, slides: Sequence[float] = ()) -> DrawnLine:
    """Return a box from a place along the element to another, half its width to either side [m]; `slides` of both with the piston."""
    rows = [(share, start, half, *slides[:1]), (other, end, half, *slides[1:])]
    rows += [(place, along, -across, *moves) for place, along, across, *moves in rows[::-1]]
    return outline(*rows, fill=fill, closed=True)


def telescope_sections(short: float, long: float, reach: float, size: float) -> tuple[DrawnLine, ...]:
    """Return the sections that come out of a body of a reach [m], for a point at a distance from short to long [m] from its first point."""
    count = stages(short, max(long, short), reach)
    long_way = (long - short) / count
    each = min(0.97 * min(short, reach), long_way + 0.15 * min(short, reach))
    found = []
    for stage in range(count, 0, -1):
        share, half = stage / count, (0.86 - 0.16 * stage) * size if count < 4 else (0.8 - 0.5 * stage / count) * size
        tip = short * (1.0 - share) - (count - stage) * size
        found.append(tube(share, tip - each, share, tip, half, "ROD"))
    return tuple(found)


def accumulators(count: int, start: float, across: float, size: float) -> tuple[DrawnLine, ...]:
    """Return so many accumulators beside an element with their line to its port, which is at a place along it and across [m]."""
    side = float(np.sign(across)) or 1.0
    run = across + side * 1.8 * size
    half, tall, pitch = 1.25 * size, 4.2 * size, 3.3 * size
    places = [start + index * pitch for index in range(count)]
    found = [outline((0.0, start, across), (0.0, start, run)), outline((0.0, places[0], run), (0.0, places[-1], run))]
    port = [(0.0, start + way * 0.3 * size, across + side * up * size) for way, up in ((-1, -0.15), (1, -0.15), (1, 0.35), (-1, 0.35))]
    found.insert(0, outline(*port, fill="PISTON", closed=True))
    for place in places:
        foot, top = run + side * 0.7 * size, run + side * (0.7 * size + tall)
        found.append(outline((0.0, place, run), (0.0, place, foot)))
        shell = rounded_outline(np.array([[place, foot + side * half], [place, top - side * half]]), half)
        found.append(keeping(shell, fill="ROD", closed=True))
        middle = 0.5 * (foot + top)
        found.append(outline((0.0, place - half, middle), (0.0, place + half, middle)))
        tip = middle + side * 0.55 * half  # the gas's triangle points at the membrane's fluid, hollow
        gas = ((0.0, place - 0.4 * half, tip + side * 0.7 * half), (0.0, place + 0.4 * half, tip + side * 0.7 * half), (0.0, place, tip))
        found.append(outline(*gas, fill="PAPER", closed=True))
    return tuple(found)


# Marks at a point, which keep their direction: rows of a share of nothing, and x and y.


def weight_mark(size: float, way: float) -> tuple[DrawnLine, ...]:
    """Return the sign of a centre of gravity: a circle of four quarters, two of them dark."""
    quarters = []
    for start, fill in ((0.0, "INK"), (0.5 * np.pi, "PAPER"), (np.pi, "INK"), (1.5 * np.pi, "PAPER")):
        ways = start + np.linspace(0.0, 0.5 * np.pi, 9)
        arc = 0.95 * size * polar(ways)
        quarters.append(keeping(np.concatenate([[[0.0, 0.0]], arc]), fill=fill, closed=True))
    return tuple(quarters)


def support_mark(size: float, way: float) -> tuple[DrawnLine, ...]:
    """Return a foot under a point that pushes it in a direction [rad]."""
    axes = np.array([polar(way), left_of(polar(way))])
    foot, base = (np.array(rows) @ axes * size for rows in ([(0.0, 0.0), (-2.2, 1.3), (-2.2, -1.3)], [(-2.7, 1.7), (-2.7, -1.7)]))
    return keeping(foot, fill="ROD", closed=True), keeping(base, bold=True)


def force_mark(size: float, way: float) -> tuple[DrawnLine, ...]:
    """Return a ring where a force acts."""
    return (circle(0.68 * size, "ACCENT"),)


def moment_mark(size: float, way: float) -> tuple[DrawnLine, ...]:
    """Return a curved arrow with two heads about the place where a moment is written: it says no sense."""
    ways = np.radians(np.linspace(-130.0, 90.0, 25))
    arc = 1.5 * size * polar(ways)
    found = [keeping(arc, bold=True)]
    for end, side in ((0, -0.9), (-1, 0.9)):
        axes = np.array([polar(ways[end]), left_of(polar(ways[end]))])
        head = arc[end] + size * np.array([[0.0, side], [0.5, 0.0], [-0.5, 0.0]]) @ axes
        found.append(keeping(head, fill="INK", closed=True))
    return tuple(found)


ON_BODIES: Mapping[str, Callable[[float, float], tuple[DrawnLine, ...]]] = MappingProxyType({"mass": weight_mark, "moment": moment_mark})
"""What is drawn on a body of some points -> its lines about its place."""

MARKS: Mapping[str, Callable[[float, float], tuple[DrawnLine, ...]]] = MappingProxyType(
    {"weight": weight_mark, "support": support_mark, "force": force_mark}
)
"""What is drawn at a point -> its lines, from the drawing's size [m] and a direction [rad]."""


def yokes(aside: float, size: float) -> tuple[DrawnLine, ...]:
    """Return the pieces by which an element that stands aside [m] of its points hangs on their pins."""
    half, out = YOKE * size, aside + np.sign(aside) * YOKE * size
    corners = ((-half, 0.0), (half, 0.0), (half, out), (-half, out))
    return tuple(outline(*((end, along, across) for along, across in corners), fill="PISTON", closed=True) for end in (0.0, 1.0))


OUTLINES: Mapping[str, Callable[[float, float, float], tuple[DrawnLine, ...]]] = MappingProxyType(
    {"spring": spring, "damper": damper, "strut": strut}
)
"""What an element is drawn as -> its lines, from its least and greatest length [m] and the drawing's size [m]."""
