"""A free body: one body of a mechanism alone with all forces on it, and these head to tail, where they close."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..language import said
from ..motion import Motion
from ..plan.members import FRAME
from . import arrows, style
from .arrows import ArrowLayer, Wording
from .drawing import LabelPart, MarkPart, MovingPart, body_part, pin, polygon
from .force_arrows import ForceQuestion, drawn_body, force_layer, forces_at_pose
from .layout import grown, offsets
from .overlays import sheet_note
from .scene import Places, Plate, Scene
from .shapes import hull, segment
from .sheet import BOTTOM, LEFT, RIGHT, TOP, empty_figure, fitted_to, footnote, legend_row, points_a_metre, sheet, write_title
from .shown_values import short_name
from .style import STRONG

FREE_WIDTH, FREE_HEIGHT = 11.0, 6.0
"""The figure's size [inch]."""
POLYGON = 3.4
"""The width of the force polygon's panel [inch]."""
FREE_SHARE = 0.3
"""The largest force's arrow over the body."""


def draw_free_body(motion: Motion, pose: int, question: ForceQuestion) -> Figure:
    """Return a figure of one body alone at a pose, a flat index, with all forces on it, and beside it their polygon."""
    scene = Scene(motion)
    forces = forces_at_pose(motion, pose, question)
    body = drawn_body(forces.found, question.body)
    layer = force_layer(forces, body) if not forces.refusal else ArrowLayer((), "kN", ())
    at = scene.at(pose)
    points = next((each.points for each in forces.found._structure.bodies if each.name == body), None)
    if points is None:  # the frame: all at which something acts
        points = tuple(point for point in forces.found.on_bodies[body] if point in motion.plan.points)
    free = FreeBodyPicture(body, points, scene, at, layer)
    figure = empty_figure(FREE_WIDTH, FREE_HEIGHT)
    low, high, wide = BOTTOM / FREE_HEIGHT, (FREE_HEIGHT - BOTTOM - TOP) / FREE_HEIGHT, FREE_WIDTH - POLYGON - LEFT - 2.0 * RIGHT
    ax = figure.add_axes((LEFT / FREE_WIDTH, low, wide / FREE_WIDTH, high))
    sheet(ax, free.box)
    beside = figure.add_axes((1.0 - (POLYGON + RIGHT) / FREE_WIDTH, low, POLYGON / FREE_WIDTH, high))
    beside.set_axis_off()
    free.draw(ax)
    draw_polygon(beside, layer)
    sheet_note(ax, [said("No forces here: {why}", why=forces.refusal)] if forces.refusal else forces.found.remarks)
    heading = motion.plan.heading
    on_body = said("{machine}: forces on {body}", machine=heading, body=short_name(forces.found, body))
    on_body = said("{machine}: forces on the frame", machine=heading) if body == FRAME else on_body
    write_title(figure, on_body, question.pose_heading(motion, pose))
    legend_row(ax, *ax.get_legend_handles_labels())
    footnote(figure, closing_words(layer, "" if forces.found.axle_loads else body))
    return figure


def closing_words(layer: ArrowLayer, body: str) -> str:
    """Return how well the forces on a body balance, in words; of a frame without supports the ground's force."""
    if not layer.largest > 0.0:
        return ""
    total = sum((each.vector for each in layer.arrows), np.zeros(2))
    arms = [each.at - layer.arrows[0].at for each in layer.arrows]
    moments = [float(a[0] * each.vector[1] - a[1] * each.vector[0]) for a, each in zip(arms, layer.arrows, strict=True)]
    moment = sum(moments) + sum(each.moment for each in layer.turning)
    force, arm = float(np.hypot(*total)), max(float(np.hypot(*each)) for each in arms)
    if body == FRAME:
        value = arrows.significant(force / layer.factor)
        return said("The ground holds the frame: what is left over, {force}, is the sum of all loads.", force=f"{value} {layer.sign}")
    parts = force / layer.largest, abs(moment) / (layer.largest * (arm or 1.0))
    return said("Forces and moments balance to {share} of the largest.", share=f"{max(*parts, 1e-17):.0e}")


class FreeBodyPicture:
    """One body at a pose with the forces on it; `box` is the sheet's, with room for all arrows [m]."""

    def __init__(self, body: str, points: tuple[str, ...], scene: Scene, at: Places, layer: ArrowLayer) -> None:
        self.body, self.points, self.scene, self.at, self.layer = body, points, scene, at, layer
        places = np.array([at[name] for name in points] + [each.at for each in layer.arrows])
        places = places[np.isfinite(places).all(axis=1)].reshape(-1, 2)
        low, high = places.min(axis=0, initial=np.inf), places.max(axis=0, initial=-np.inf)
        long = float(np.max(high - low, initial=0.0)) if places.size else 0.0
        extent = long if long > 0.0 else 20.0 * scene.size
        self.size, self.scale = 0.02 * extent, layer.scale((0.0, extent, 0.0, extent), FREE_SHARE)
        middle = 0.5 * (low + high) if places.size else np.zeros(2)
        half = 0.5 * np.maximum(high - low, 0.45 * extent) if places.size else np.full(2, 0.5 * extent)
        pad = 5.0 * self.size
        (left, bottom), (right, top) = (middle - half - pad).tolist(), (middle + half + pad).tolist()
        self.box = grown((left, right, bottom, top), layer.tips(self.scale), pad)

    def draw(self, ax: Axes) -> None:
        """Draw it."""
        for part in self.parts(ax):
            part.update(self.at)
        places = [self.at[name] for name in self.points]
        lines = [segment(P, Q, 0.8 * self.size) for P, Q in zip(places, [*places[1:], places[0]], strict=True) if not np.array_equal(P, Q)]
        outline = np.concatenate([*lines, np.array(places)])
        covered = arrows.draw_arrows(ax, self.layer, self.scale, self.size)
        scale, own = points_a_metre(ax), {name: self.at[name] for name in self.points}
        gap = 1.15 * self.size * scale + 1.5
        for name, spot in offsets(list(own), [own], [np.concatenate([outline, covered])], scale, gap).items():
            LabelPart(ax, name, spot, gap, STRONG).update(self.at)
        everything = np.concatenate([outline, np.repeat(covered, arrows.ARROW, axis=0)])
        bar = arrows.scale_bar(ax, self.layer, self.scale, everything)
        arrows.place_wordings(ax, arrows.wordings(self.layer, self.scale, self.size), np.concatenate([everything, bar]))
        arrows.add_keys(ax, self.layer)

    def parts(self, ax: Axes) -> list[MovingPart]:
        """Return the body's own parts: a plate or a bar, a cylinder, a spring, a block, and its pins."""
        own, parts = set(self.points), list[MovingPart]()
        marks = [each.mark(self.size) for each in self.scene.cylinders if {each.P, each.Q} == own]
        marks = marks or [each for each in self.scene.straights if set(each.on) == own]
        if marks:
            parts += [MarkPart(ax, each, STRONG) for each in marks]
        elif len(self.points) == 1:
            x, y = self.at[self.points[0]]
            half = 1.6 * self.size
            block = polygon(ax, STRONG.level, facecolor=style.RULE, edgecolor=style.INK, linewidth=style.OUTLINE)
            block.set_xy([(x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)])
        elif self.body != FRAME:
            places = np.array([self.at[name] for name in self.points])
            parts.append(body_part(ax, Plate(self.points, np.eye(len(places))[list(hull(places))]), self.size, style.BODIES[0], STRONG))
        return [*parts, *(pin(ax, name, self.size, STRONG) for name in self.points)]


def draw_polygon(ax: Axes, layer: ArrowLayer) -> None:
    """Draw the forces head to tail, in the order of their directions; they close where the body is in equilibrium."""
    chain = [each for each in layer.arrows if each.length > 1e-9 * layer.largest]
    if not chain:
        return
    chain = [chain[place] for place in np.argsort([np.arctan2(*each.vector[::-1]) for each in chain], kind="stable")]
    ends = np.cumsum([np.zeros(2), *(each.vector / layer.factor for each in chain)], axis=0)
    low, high = ends.min(axis=0), ends.max(axis=0)
    pad = 0.22 * float(np.max(high - low))
    box = fitted_to(ax, (low[0] - pad, high[0] + pad, low[1] - pad, high[1] + pad))
    ax.set(xlim=box[:2], ylim=box[2:])
    ax.set_aspect("equal", adjustable="box")
    size = 0.012 * max(box[1] - box[0], box[3] - box[2])
    texts, covered = [], []
    for each, tail, tip in zip(chain, ends, ends[1:], strict=False):
        edge, name = style.mixed(each.colour, style.INK, 0.35), f"polygon {each.name}"
        arrows.draw_arrow(ax, each, tail, tip, size, 10.0, name)
        covered.append(np.linspace(tail, tip, 24))
        across = np.array([tip[1] - tail[1], tail[0] - tip[0]]) / float(np.hypot(*(tip - tail)))
        texts.append(Wording(layer.words(each), 0.5 * (tail + tip), across, edge, name))
    arrows.place_wordings(ax, texts, np.concatenate(covered))
    ax.text(0.5, 1.0, said("head to tail"), transform=ax.transAxes, fontsize=style.TEXT, color=style.MUTED, ha="center", va="bottom")
