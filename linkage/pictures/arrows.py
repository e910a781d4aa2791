"""Vectors as arrows to one scale, moments as curved arrows, their values where there is room, and the bar that says the scale."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from itertools import product

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Polygon
from matplotlib.text import Annotation, Text
from matplotlib.transforms import Bbox

from ..frozen import immutable
from ..language import translated
from ..program import FloatArray
from ..units import current_system, factor, shown_in
from ..vectors import Mask
from . import style
from .layout import distance_to_box
from .scene import Bounds
from .shapes import left_of, lines_cross, polar, segment
from .sheet import Keywords, figure_of, haloed, points_a_metre, renderer_of

SHARE = 0.17
"""The largest arrow's length over the longer side of what is drawn."""
TINY = 0.012
"""An arrow shorter than this part of the largest is a dot."""
NOTHING_THERE = 1e-9
"""What is smaller than this part of the largest is rounding, and is zero."""

SHAFT, BARB, HEAD = 0.16, 0.62, 1.7
"""Half a shaft's width, half a head's width, and a head's length, in sizes."""
LEVEL = 16.0
"""Where arrows lie over all that is drawn of a mechanism."""
TURN_ANGLES = np.radians(np.linspace(-150.0, 70.0, 49))
"""The angles that a curved arrow goes through."""


@immutable
class VectorArrow:
    """A vector at a point [m], shape (2,) each, in SI, with its colour; `text` stands after its value, `name` finds it in the figure."""

    name: str
    at: FloatArray
    vector: FloatArray
    colour: str
    text: str = ""

    @property
    def length(self) -> float:
        """The vector's length [SI]."""
        return float(np.hypot(*self.vector))


@immutable
class TurningArrow:
    """A moment [Nm] at a point [m], positive counter-clockwise."""

    name: str
    at: FloatArray
    moment: float
    colour: str
    text: str = ""
    radius: float = 2.6
    """The curve's radius in sizes: another one where several stand about one point."""


@immutable
class ArrowLayer:
    """Arrows to one scale, in a unit; `keys` are the meanings of the colours, `sense` the positive direction."""

    arrows: tuple[VectorArrow, ...]
    unit: str
    keys: tuple[tuple[str, str], ...]
    turning: tuple[TurningArrow, ...] = ()
    notes: tuple[str, ...] = ()
    sense: str = ""

    @property
    def factor(self) -> float:
        """How much of SI the unit is."""
        return factor(self.unit)

    @property
    def sign(self) -> str:
        """How the unit is written in the language that is spoken."""
        return translated(self.unit)

    @property
    def largest(self) -> float:
        """The longest vector [SI]."""
        return max((each.length for each in self.arrows), default=0.0)

    def scale(self, box: Bounds, share: float = SHARE) -> float:
        """Return how long a unit of SI is on a sheet that shows a box [m/SI], the largest vector a share of it; 0 where there is none."""
        left, right, bottom, top = box
        return share * max(right - left, top - bottom) / self.largest if self.largest > 0.0 else 0.0

    def value(self, size: float) -> str:
        """Return the size of a vector in words, without its unit: three digits, and 0 for rounding."""
        return significant(size / self.factor) if size > NOTHING_THERE * self.largest else "0"

    def words(self, arrow: VectorArrow) -> str:
        """Return the text at an arrow."""
        return f"{self.value(arrow.length)} {self.sign} {arrow.text}".rstrip()

    def tips(self, scale: float) -> FloatArray:
        """Return the tips of the arrows, shape (n, 2) [m]."""
        return np.array([each.at + scale * each.vector for each in self.arrows]).reshape(-1, 2)


def significant(value: float, digits: int = 3) -> str:
    """Return a number with so many digits, without an exponent from a thousandth to a hundred thousand."""
    if value == 0.0 or not 1e-3 <= abs(value) < 1e5:
        return f"{value:.{digits}g}"
    rounded = float(f"{value:.{digits}g}")
    places = max(0, digits - 1 - int(np.floor(np.log10(abs(rounded)))))
    return f"{rounded:.{places}f}"


def draw_arrows(ax: Axes, layer: ArrowLayer, scale: float, size: float) -> FloatArray:
    """Draw the arrows of a layer and return points that cover them, shape (n, 2) [m]; `size` is that of the mechanism's pins [m]."""
    for each in layer.arrows:
        if each.length > TINY * layer.largest:
            draw_arrow(ax, each, each.at, each.at + scale * each.vector, size, LEVEL, each.name)
        else:
            x, y, edge = *each.at, style.mixed(each.colour, style.INK, 0.35)
            ax.add_patch(Circle((x, y), 0.3 * size, facecolor=each.colour, edgecolor=edge, zorder=LEVEL, gid=each.name))
    for turn in layer.turning:  # a moment is a curved arrow about its point
        curve = turning_line(turn, size)
        ax.add_line(Line2D(*curve.T, color=turn.colour, linewidth=2.2, solid_capstyle="butt", zorder=LEVEL, gid=turn.name))
        end, out = curve[-1], (curve[-1] - turn.at) / (turn.radius * size)
        along = left_of(out) * np.sign(turn.moment)
        corners = np.array([end + HEAD * size * along, end + BARB * size * out, end - BARB * size * out])
        ax.add_patch(Polygon(corners, facecolor=turn.colour, edgecolor=turn.colour, joinstyle="round", zorder=LEVEL))
    return arrow_points(layer, scale, size)


def draw_arrow(ax: Axes, arrow: VectorArrow, tail: FloatArray, tip: FloatArray, size: float, level: float, name: str) -> None:
    """Draw a vector as an arrow from its tail to its tip [m]."""
    outline, edge = arrow_outline(tail, tip, size), style.mixed(arrow.colour, style.INK, 0.35)
    ax.add_patch(Polygon(outline, facecolor=arrow.colour, edgecolor=edge, linewidth=0.6, joinstyle="round", zorder=level, gid=name))


def arrow_points(layer: ArrowLayer, scale: float, size: float) -> FloatArray:
    """Return points along the arrows of a layer, shape (n, 2) [m], so near to each other that no text stands between them."""
    lines = [np.empty((0, 2)), *(turning_line(turn, size) for turn in layer.turning)]
    for each in layer.arrows:
        count = int(np.clip(3.0 * scale * each.length / size, 1, 240))
        lines.append(each.at + np.linspace(0.0, 1.0, count)[:, None] * scale * each.vector)
        if each.length > TINY * layer.largest:
            lines.append(arrow_outline(each.at, each.at + scale * each.vector, size))
    return np.concatenate(lines)


def arrow_outline(tail: FloatArray, tip: FloatArray, size: float) -> FloatArray:
    """Return the outline of an arrow, shape (7, 2) [m]: it begins at the tip and is symmetric about the way from its tail."""
    length = float(np.hypot(*(tip - tail)))
    along = (tip - tail) / length
    across = left_of(along)
    head = min(HEAD * size, 0.6 * length)
    wide, thin = BARB * size * head / (HEAD * size), SHAFT * size
    neck = tip - head * along
    sides = [tip, neck + wide * across, neck + thin * across, tail + thin * across]
    return np.array([*sides, tail - thin * across, neck - thin * across, neck - wide * across])


def turning_line(turn: TurningArrow, size: float) -> FloatArray:
    """Return the line of a curved arrow from its tail to its head, shape (n, 2) [m]."""
    angles = TURN_ANGLES if turn.moment > 0.0 else np.pi - TURN_ANGLES
    return np.asarray(turn.at + turn.radius * size * polar(angles))


# Values at the arrows, where they cover nothing.

FAR_OUT = (1.0, 1.8, 3.0, 4.5, 7.0, 10.0, 14.0, 19.0, 25.0, 33.0)
LED = 4
"""The place in FAR_OUT from which a thin line leads to what a value stands for."""
LEADING = 10.0
"""What such a line costs, in covered points."""
CROSSED_TEXT, CROSSED_LEADER, COVERED_TEXT, OFF_SHEET = 40.0, 250.0, 400.0, 900.0
"""What it costs to cross another text or another such line, to cover a text, and to hang over the sheet's edge, in covered points."""
STRAY, LED_STRAY, LED_BESIDE = 300.0, 6.0, 60.0
"""What it costs to stand nearer to what another text stands for than to the own, without and with such a line, in covered points; and
with one right beside it."""
ARROW = 8
"""What a point along an arrow costs, in covered points."""
ALONG_LEADER = np.linspace(0.0, 1.0, 24)[:, None]
"""The shares of a leading line at which it is looked at."""
AGAIN = 4
"""How often values that cover others choose again."""
CROWDED = 40.0
"""What a spot costs from which a value stands badly."""
AROUND = np.radians(np.arange(0.0, 360.0, 22.5))
FIRST_LED = LED * len(AROUND)
"""The first of the spots of a text that such a line leads to."""
CLEAR = 1.5  # pixels kept free around a value
NEARER = 1.0  # pixels by which a text has to be nearer to count as that
BESIDE = 20.0  # pixels within which a text is taken for that of an arrow
SHORT = 2.0  # pixels by which a leading line ends before its place, so that those of one place do not meet
EDGE = 3.0  # pixels kept free along the sheet's edges


@immutable
class Wording:
    """A text that is to stand near a place [m]: preferably on along a way, shape (2,).

    `mark` are points along the outline of the arrow that it is of, shape (n, 2) [m], its tip the last.
    """

    text: str
    at: FloatArray
    way: FloatArray
    colour: str
    name: str = ""
    mark: FloatArray | None = None


def wordings(layer: ArrowLayer, scale: float, size: float) -> list[Wording]:
    """Return the texts at the arrows of a layer: at their tips, those of moments beside their curves."""
    found = []
    for each in layer.arrows:
        tip, colour = each.at + scale * each.vector, style.mixed(each.colour, style.INK, 0.4)
        if each.length > TINY * layer.largest:
            corners = arrow_outline(each.at, tip, size)
            mark = np.concatenate([segment(P, Q, 0.15 * size) for P, Q in zip(corners, [*corners[1:], tip], strict=True)])
            found.append(Wording(layer.words(each), tip, each.vector / each.length, colour, each.name, mark))
        else:
            found.append(Wording(layer.words(each), tip, np.array([0.0, 1.0]), colour, each.name))
    for turn in layer.turning:  # in the unit of the forces times m, in a chosen system in its own
        unit = shown_in("kNm") if current_system() else {"N": "Nm", "kN": "kNm"}[layer.unit]
        text = f"{significant(abs(turn.moment) / factor(unit))} {translated(unit)} {turn.text}".strip()
        at = turn.at + np.array([0.0, turn.radius * size])
        colour, curve = style.mixed(turn.colour, style.INK, 0.4), turning_line(turn, size)
        found.append(Wording(text, at, np.array([0.0, 1.0]), colour, turn.name, curve))
    return found


class PlacedWording:
    """A text that is written, the spots it may stand at, shape (n, 2) [pixels], and which of them it has chosen."""

    def __init__(self, text: Text, mark: FloatArray, size: FloatArray, way: FloatArray) -> None:
        """Take the text, points along its object, shape (m, 2), the last one its tip, its size [pixels], and the preferred direction."""
        self.text, self.mark, self.half, self.place = text, mark, 0.5 * size + CLEAR, -1
        self.anchor = mark[-1]
        start = float(np.arctan2(way[1], way[0]))
        turned = sorted(AROUND, key=lambda angle: abs(np.angle(np.exp(1j * (angle - start)))))
        ways = polar(np.array(turned))
        aside = self.half * np.clip(np.sqrt(2.0) * ways, -1.0, 1.0)
        self.spots = self.anchor + np.concatenate([far * 0.5 * size[1] * ways + aside for far in FAR_OUT])
        self.away = self.distances(mark)

    def distances(self, points: FloatArray) -> FloatArray:
        """Return how far the text would be from the nearest of some points [pixels] at each of its spots, shape (n,)."""
        return np.asarray(distance_to_box(points - self.spots[:, None], self.half - CLEAR).min(axis=1))

    def inside(self, points: FloatArray) -> Mask:
        """Return which of some points the text would cover [pixels] at each of its spots, shape (n, k)."""
        low, high, (x, y) = self.spots - self.half, self.spots + self.half, points.T
        return np.asarray((x > low[:, :1]) & (x < high[:, :1]) & (y > low[:, 1:]) & (y < high[:, 1:]))

    def keep_from(self, others: Sequence[PlacedWording], points: FloatArray) -> None:
        """Note the spots at which it would be nearer to other texts' objects than to its own, and how many points each would cover."""
        self.covered = np.asarray(np.count_nonzero(self.inside(points), axis=1), float)
        same = [len(each.mark) == len(self.mark) and np.allclose(each.mark, self.mark, atol=NEARER) for each in others]
        marks = [each.mark for each, is_same in zip(others, same, strict=True) if not is_same]
        near = self.distances(np.concatenate(marks)) if marks else np.full(len(self.spots), np.inf)
        led = LED_STRAY + LED_BESIDE * (near < BESIDE)
        self.strays = np.where(np.arange(len(self.spots)) < FIRST_LED, STRAY, led) * (near < self.away - NEARER)

    @property
    def box(self) -> FloatArray:
        """The area it covers [pixels]: left, bottom, right, top."""
        spot = self.spots[self.place]
        return np.concatenate([spot - self.half, spot + self.half])

    @property
    def leader(self) -> FloatArray:
        """Points along the line that leads to its object, shape (n, 2) [pixels]: none where it is near."""
        return self.leaders[self.place - FIRST_LED] if self.place >= FIRST_LED else np.empty((0, 2))

    @cached_property
    def leaders(self) -> FloatArray:
        """Points along the leading lines of its far spots, shape (k, n, 2) [pixels]."""
        far = self.spots[FIRST_LED:]
        nearest = np.clip(self.anchor, far - self.half, far + self.half)
        ways = self.anchor - nearest
        return np.asarray(nearest[:, None] + ALONG_LEADER * (ways * (1.0 - SHORT / np.hypot(*ways.T))[:, None])[:, None])

    def costs(self, boxes: Sequence[FloatArray], leaders: FloatArray, lines: FloatArray, inside: Bbox) -> FloatArray:
        """Return the cost of each spot, shape (n,).

        `leaders` are points along other texts' leading lines, shape (m, 2), `lines` the ends of all, shape (k, 2, 2) [pixels].
        """
        texts = np.array(boxes).reshape(-1, 4)
        low, high = (self.spots - self.half)[:, None], (self.spots + self.half)[:, None]
        over = ((low < texts[:, 2:]) & (texts[:, :2] < high)).all(axis=2).sum(axis=1)
        by_line = len(self.spots), len(leaders) // len(ALONG_LEADER), len(ALONG_LEADER)
        covered = self.covered + CROSSED_TEXT * self.inside(leaders).reshape(by_line).any(axis=2).sum(axis=1)
        outside = ((low < inside.min) | (high > inside.max)).any(axis=(1, 2))
        costs = COVERED_TEXT * over + covered + OFF_SHEET * outside + self.strays + 0.04 * np.arange(len(self.spots))
        x, y = self.leaders[..., :1], self.leaders[..., 1:]
        inner = (x > texts[:, 0]) & (x < texts[:, 2]) & (y > texts[:, 1]) & (y < texts[:, 3])
        costs[FIRST_LED:] += LEADING + CROSSED_TEXT * inner.any(axis=1).sum(axis=1)
        costs[FIRST_LED:] += CROSSED_LEADER * lines_cross(self.leaders[:, [0, -1]][:, None], lines).sum(axis=1)
        return np.asarray(costs)

    def write(self, ax: Axes) -> None:
        """Put the text at its chosen place, with a line that leads to its object where that is far."""
        back = ax.transData.inverted()
        x, y = back.transform(self.spots[self.place]).tolist()
        self.text.set_position((x, y))
        if self.place >= FIRST_LED:
            ends = back.transform(self.leader[[0, -1]])
            name = f"leader of {self.text.get_gid()}"
            ax.add_line(Line2D(*ends.T, color=self.text.get_color(), linewidth=0.6, zorder=19.5, gid=name))


def place_wordings(ax: Axes, texts: Sequence[Wording], covered: FloatArray) -> None:
    """Write texts near their places so that they cover neither each other, nor written texts, nor `covered` points [m]."""
    renderer = renderer_of(figure_of(ax))
    ax.apply_aspect()
    inside = ax.get_window_extent(renderer).padded(-EDGE)
    boxes = [np.array(each.extents) for each in text_boxes(ax)]
    # The lines that lead from names to their points [pixels], where `text_boxes` has brought them.
    named = [each for each in ax.texts if isinstance(each, Annotation) and each.get_visible() and each.get_text()]
    led = [np.asarray(each.arrow_patch.get_path().vertices, float)[[0, -1]] for each in named if each.arrow_patch]
    points = ax.transData.transform(covered) if covered.size else np.empty((0, 2))
    points = np.concatenate([points, *(start + ALONG_LEADER * (end - start) for start, end in led)])
    chosen: list[PlacedWording] = []
    near = [np.count_nonzero(np.hypot(*(points - ax.transData.transform(each.at)).T) < 40.0) for each in texts]
    for each in (texts[place] for place in np.argsort(-np.array(near, int), kind="stable")):  # the most crowded places first
        look: Keywords = {"ha": "center", "va": "center", "zorder": 20.0, "clip_on": False, "gid": f"{each.name} value"}
        text = haloed(ax, each.text, np.zeros(2), style.SMALL, each.colour, **look)
        size = np.asarray(text.get_window_extent(renderer).size)
        mark = each.at[None] if each.mark is None else each.mark
        chosen.append(PlacedWording(text, np.asarray(ax.transData.transform(mark)), size, each.way))
    for one in chosen:
        one.keep_from(chosen, points)

    def costs(one: PlacedWording, *without: PlacedWording) -> FloatArray:
        others = [other for other in chosen if other not in (one, *without) and other.place >= 0]
        leaders = [other.leader for other in others if len(other.leader)]
        lines = np.array([*led, *(each[[0, -1]] for each in leaders)]).reshape(-1, 2, 2)
        return one.costs([*boxes, *(other.box for other in others)], np.concatenate([points[:0], *leaders]), lines, inside)

    for one in chosen * AGAIN:
        one.place = int(np.argmin(costs(one)))
    for one in chosen:  # one that stands badly chooses before another one does
        for other in chosen if costs(one)[one.place] > CROWDED else ():
            alone, places = costs(one, other), (one.place, other.place)
            if other is not one and alone.min() < alone[one.place]:
                before = alone[one.place] + costs(other)[other.place]
                one.place = int(np.argmin(alone))
                after = costs(other)
                other.place = int(np.argmin(after))
                if alone[one.place] + after[other.place] >= before:
                    one.place, other.place = places
    for one in chosen:
        one.write(ax)


def text_boxes(ax: Axes) -> list[Bbox]:
    """Return the areas of the texts on a sheet [pixels], without the lines that lead to them."""
    renderer = renderer_of(figure_of(ax))
    written = [text for text in ax.texts if text.get_visible() and text.get_text()]
    for text in written:
        if isinstance(text, Annotation):
            text.update_positions(renderer)
            text.update_bbox_position_size(renderer)  # at which its line begins
    return [Text.get_window_extent(text, renderer) for text in written]


# The bar that says the scale, and what colours mean.


BESIDE_CORNER, AMID = 2.0, 6.0
"""What it costs a bar to stand at the sheet's edge beside its corners, and away from the edge, in covered points."""


def scale_bar(ax: Axes, layer: ArrowLayer, scale: float, covered: FloatArray) -> FloatArray:
    """Draw a bar of a round value where the sheet is empty, in a corner if one is; return points that cover it, shape (n, 2) [m]."""
    if not scale > 0.0:
        return np.empty((0, 2))
    most = 0.8 * layer.largest / layer.factor
    power = float(10.0 ** np.floor(np.log10(most)))
    value = max(each * power for each in (1.0, 2.0, 5.0) if each * power <= most * (1.0 + 1e-12))
    length = value * layer.factor * scale
    (x0, x1), (y0, y1) = ax.get_xlim(), ax.get_ylim()
    pad, high = 0.02 * (x1 - x0), style.SMALL * 1.25 / points_a_metre(ax)
    across = np.linspace(x1 - pad - length, x0 + pad, 7)
    up = np.linspace(y0 + pad, y1 - pad - 1.5 * high, 9)
    shares, back = np.array(list(product(np.linspace(0.0, 1.0, 9), np.linspace(0.0, 1.0, 4)))), ax.transData.inverted()
    taken = np.concatenate([covered, *(back.transform(each.min + shares * each.size) for each in text_boxes(ax))])

    def cost(spot: tuple[int, int]) -> float:
        low = np.array([across[spot[0]] - pad, up[spot[1]] - 0.8 * pad])
        top = low + np.array([length + 2.0 * pad, 1.6 * pad + 1.5 * high])
        crowd = int(np.count_nonzero(((taken > low) & (taken < top)).all(axis=1)))
        edges = (spot[0] in (0, len(across) - 1)) + (spot[1] in (0, len(up) - 1))
        return crowd + (AMID, BESIDE_CORNER, 0.0)[edges] + 0.1 * (spot[0] / len(across) + spot[1] / len(up))

    column, row = min(product(range(len(across)), range(len(up))), key=cost)
    x, y = float(across[column]), float(up[row])
    half, colour = 0.2 * pad, layer.keys[0][0] if len(layer.keys) == 1 else style.INK
    outline = np.array([[x, x, x, x + length, x + length, x + length], [y + half, y - half, y, y, y - half, y + half]])
    name, middle = f"scale {layer.unit}", np.array([x + 0.5 * length, y + 0.25 * pad])
    ax.plot(*outline, color=colour, linewidth=1.6, zorder=19.0, solid_joinstyle="miter", gid=name)
    length_said = f"{value:g} {layer.sign}"
    haloed(ax, length_said, middle, style.SMALL, style.INK, ha="center", va="bottom", zorder=20.0, gid=f"{name} value")
    return np.array(list(product(np.linspace(x - 0.3 * pad, x + length + 0.3 * pad, 20), (y - half, y, y + half))))


def add_keys(ax: Axes, layer: ArrowLayer) -> None:
    """Add a key for each colour of a layer to a legend."""
    for colour, text in layer.keys:
        ax.add_line(Line2D([], [], color=colour, linewidth=2.4, label=text))
