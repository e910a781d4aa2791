"""Overlays on a mechanism at one pose: its forces, the velocities of its points, the poles of its bodies."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..errors import SingularError, unwarned
from ..frozen import immutable
from ..language import said, said_of, translated
from ..motion import Motion, pose_sentence, rates_of, whole_body
from ..motion.motion_verdicts import all_kept_here
from ..program import FloatArray
from ..statics import loose_movements
from ..steps import Link
from ..units import factor, mm, show, shown_in
from . import arrows, style
from .arrows import ArrowLayer, VectorArrow, Wording
from .force_arrows import ForceQuestion, LeverArm, Rates, force_layer, forces_at_pose, lever_arms, one_pose, why_no_forces
from .gap_marks import GapMark, Pairs, asked_pair, assumed_pairs, body_pair, draw_gap, gap_mark, own_bodies, worst_pose
from .layout import grown
from .scene import Bounds, Scene
from .shapes import segment
from .sheet import Keywords, figure_of
from .strokes import pose_words

VELOCITY, POLE = "#9a3a86", "#8a5a00"
"""The colours of velocities and of poles."""

NOTE_WIDTH, NOTE_LINE = 130, 0.02
"""About how many letters of a note stand in a line, and a line's height over the sheet's width."""

SAME_POLE = 1e-6
"""Poles that are nearer to each other than this part of the machine's size are one."""
POLE_WIDTH = 44
"""The letters of a pole's name that stand in a line."""

BEYOND = 0.6
"""A pole further outside what is drawn than this part of it is told in words."""


@immutable
class Overlays:
    """The overlays to draw: forces, velocities at stroke rates, poles of bodies, the nearest bodies, bodies loose while locked."""

    forces: ForceQuestion | None = None
    rates: Rates = None
    pole: object = None
    clearance: object = None
    freedom: bool = False

    def __bool__(self) -> bool:
        shown = any(each not in (None, False) for each in (self.pole, self.clearance, self.freedom))
        return self.forces is not None or self.rates is not None or shown

    def is_free_body(self, scene: Scene) -> bool:
        """Return whether one body alone is asked for; with the name of a pin it is the loads about that."""
        return self.forces is not None and bool(self.forces.body) and self.forces.body not in scene.pins

    @property
    def has_gap(self) -> bool:
        """Whether the nearest bodies are asked for."""
        return self.clearance not in (None, False)

    def pairs(self, motion: Motion) -> tuple[Pairs, str]:
        """Return the pairs of bodies that are compared where nothing says which, else None, and a note on them."""
        return assumed_pairs(motion) if self.has_gap and asked_pair(self.clearance, motion.plan) is None else (None, "")

    def laid_over(self, motion: Motion, pose: int, box: Bounds) -> Overlay:
        """Return the overlay of a motion's pose, a flat index, on a sheet that shows a box [m]."""
        layers, notes, arms = list[ArrowLayer](), list[str](), list[LeverArm]()
        if self.rates is not None:
            rates_of("velocities", self.rates, motion)
        pairs, note = self.pairs(motion)
        nearest = worst_pose(motion, self.clearance, pairs, pose) if self.has_gap and motion.reached.size > 1 else pose
        worst = None if nearest == pose else nearest
        if not motion.reached.ravel()[pose]:
            return Overlay((), (), (why_no_forces(motion, pose, ForceQuestion()),), box, worst=worst)
        if self.forces is not None:
            forces = forces_at_pose(motion, pose, self.forces)
            if forces.refusal:
                notes.append(said("No forces here: {why}", why=forces.refusal))
            else:
                if self.forces.body:
                    layers, arms = lever_arms(forces, one_pose(motion, pose), self.forces.body, box, Scene(motion).size)
                else:
                    layers.append(force_layer(forces))
                notes += [remark.replace("rates=dict(", "velocities=dict(") for remark in forces.found.remarks]
            if self.forces == ForceQuestion():  # all forces, of the machine's own loads
                notes += filter(None, [pose_sentence(one_pose(motion, pose))])
        if self.rates is not None:
            layers.append(velocity_layer(motion, pose, self.rates))
            notes += layers[-1].notes
        if self.freedom:
            layers += loose_layers(one_pose(motion, pose))
            notes += [] if layers else [said("Nothing is loose: with the drives locked no body can move.")]
        marks = []
        if self.pole not in (None, False):
            rates, words = pole_rates(motion, pose, self.rates)
            marks, notes = pole_marks(motion, pose, self.pole, rates), [*notes, *words]
        notes += filter(None, [note])
        gaps = [gap_mark(one_pose(motion, pose), self.clearance, pairs)] if self.has_gap else []
        moving = [name for name, values in motion.strokes.items() if np.ptp(values) > 0.0]
        gaps += [] if worst is None else [gap_mark(one_pose(motion, worst), self.clearance, pairs, pose_words(motion, worst, moving))]
        return Overlay(tuple(layers), tuple(marks), tuple(notes), box, tuple(gaps), tuple(arms), worst)

    def centrodes(self, ax: Axes, swept: Motion) -> None:
        """Draw the paths of the poles that are asked for over a motion."""
        if self.pole not in (None, False) and swept.reached.size > 2 and not any(map(np.ndim, (self.rates or {}).values())):
            rates, _ = pole_rates(swept, swept.reached.size // 2, self.rates)
            for body, other in asked_poles(swept, self.pole):  # a thin line, where the sheet shows it
                with unwarned():
                    path = swept.pole(body, other, rates=rates).reshape(2, -1)
                path = np.where(np.isfinite(path), path, np.nan)
                jumps = np.hypot(*np.diff(path)) > 3.0 * np.hypot(np.ptp(ax.get_xlim()), np.ptp(ax.get_ylim()))
                path[:, 1:][:, jumps] = np.nan
                ax.plot(*path, color=POLE, linewidth=1.1, linestyle=(0, (1.0, 1.6)), zorder=14.0, gid=f"centrode of {body}")


@immutable
class PoleMark:
    """A pole: its name, its place (2,) [m], the points that thin lines go to; or, where there is none, the words why."""

    name: str
    at: FloatArray
    ends: tuple[FloatArray, ...] = ()
    words: str = ""

    def is_near(self, box: Bounds) -> bool:
        """Return whether a sheet can be made large enough for it."""
        left, right, bottom, top = box
        room = BEYOND * max(right - left, top - bottom)
        x, y = self.at
        return bool(np.isfinite(self.at).all() and left - room < x < right + room and bottom - room < y < top + room)


@immutable
class Overlay:
    """The overlay of one pose on a sheet: arrows to their scales, poles, notes, gaps, lever arms.

    `worst` is another pose of the motion, a flat index, that is drawn behind it.
    """

    layers: tuple[ArrowLayer, ...]
    marks: tuple[PoleMark, ...]
    notes: tuple[str, ...]
    sheet: Bounds
    gaps: tuple[GapMark, ...] = ()
    arms: tuple[LeverArm, ...] = ()
    worst: int | None = None

    def box(self, size: float) -> Bounds:
        """Return the sheet made larger, so that all arrows and near poles are on it; `size` is that of a pin [m]."""
        box = self.sheet
        for layer in self.layers:
            box = grown(box, layer.tips(layer.scale(self.sheet)), 3.0 * size)
        near = [mark.at for mark in self.marks if mark.is_near(self.sheet)]
        near += [end for arm in self.arms for end in arm.line.ends]
        left, right, bottom, top = grown(box, np.array(near).reshape(-1, 2), 3.0 * size)
        return left, right, bottom, top + self.note_share * (right - left)

    @property
    def note_share(self) -> float:
        """The height of its remarks at the top of the sheet, as a share of the sheet's width."""
        lines = sum(len(textwrap.wrap(sentence, NOTE_WIDTH)) for sentence in self.sentences)
        return NOTE_LINE * (lines + 1) if lines else 0.0

    @property
    def sentences(self) -> list[str]:
        """The picture's remarks in words: unknown values, and the places of poles outside the sheet."""
        found, unit, minus = [*self.notes], shown_in("m"), "\N{MINUS SIGN}"
        left, right, bottom, top = self.sheet
        for mark in self.marks:
            if mark.words:
                found.append(mark.words)
            elif not mark.is_near(self.sheet):
                away = mark.at - np.array([0.5 * (left + right), 0.5 * (bottom + top)])
                lengths = (arrows.significant(part / factor(unit), 4) for part in (float(np.hypot(*away)), *mark.at.tolist()))
                far, x, y = (f"{length} {translated(unit)}".replace("-", minus) for length in lengths)
                degrees = f"{float(np.degrees(np.arctan2(away[1], away[0]))):.0f}".replace("-", minus)
                place = {"far": far, "degrees": degrees, "x": x, "y": y}
                found.append(said("{name}: off the sheet, {far} away towards {degrees}°, at x = {x}, y = {y}.", name=mark.name, **place))
        return found

    @property
    def sense(self) -> str:
        """How to read its arrows, in words."""
        return " ".join(layer.sense for layer in self.layers if layer.sense)

    def points_covered(self, size: float) -> FloatArray:
        """Return points along the arrows, where no name should stand, shape (n, 2) [m]; `size` is that of a pin [m]."""
        lines = [np.empty((0, 2)), *(arrows.arrow_points(layer, layer.scale(self.sheet), size) for layer in self.layers)]
        lines += [gap.outer(0.0) for gap in self.gaps] + [arm.line.covered for arm in self.arms]
        if self.note_share:  # the remarks
            left, right, _, top = self.box(size)
            lines.append(np.array([*product(np.arange(left, right, size), np.arange(top, top - self.note_share * (right - left), -size))]))
        return np.concatenate([*lines, *(mark.at[None] for mark in self.marks if mark.is_near(self.sheet))])

    def draw(self, ax: Axes, size: float, keep_clear: FloatArray) -> None:
        """Draw it on a sheet; `keep_clear` are the points of the mechanism that no value should cover [m]."""
        covered, texts = [keep_clear], []
        for layer in self.layers:
            scale = layer.scale(self.sheet)
            covered.append(np.repeat(arrows.draw_arrows(ax, layer, scale, size), arrows.ARROW, axis=0))
            texts += arrows.wordings(layer, scale, size)
        for number, mark in enumerate(self.marks):
            ray: Keywords = {"color": POLE, "linewidth": style.THIN, "dashes": (7, 3, 1.5, 3), "zorder": 15.0, "gid": f"{mark.name} ray"}
            for end in mark.ends:
                ax.plot(*np.array([mark.at, end]).T, **ray)
            if mark.is_near(self.sheet):
                key = None if number else said("pole, about which a body turns here")
                ring: Keywords = {"marker": "o", "markersize": 8.5, "markerfacecolor": style.PAPER, "markeredgewidth": 1.6, "label": key}
                ax.plot(*mark.at[:, None], color=POLE, linestyle="none", markeredgecolor=POLE, zorder=17.0, gid=mark.name, **ring)
                ax.plot(*mark.at[:, None], marker="+", markersize=12.0, markeredgecolor=POLE, markeredgewidth=1.2, zorder=17.1)
                texts.append(Wording(textwrap.fill(mark.name, POLE_WIDTH), mark.at, np.array([0.7, 0.7]), POLE, mark.name))
            covered.append(np.repeat(mark.at[None], 12 * mark.is_near(self.sheet), axis=0))
            covered += [segment(mark.at, end, size) for end in mark.ends]
        for gap in self.gaps:
            texts += draw_gap(ax, gap, size)
            covered.append(np.repeat(gap.outer(size), 6, axis=0))
        for arm in self.arms:
            texts += arm.draw(ax)
            covered.append(np.repeat(arm.line.covered, arrows.ARROW, axis=0))
        is_kept = len(self.sentences) == 1 and self.sentences[0].startswith(all_kept_here()[:-1])
        sheet_note(ax, self.sentences, style.INK if is_kept else style.ACCENT)
        for layer in self.layers:
            covered.append(np.repeat(arrows.scale_bar(ax, layer, layer.scale(self.sheet), np.concatenate(covered)), arrows.ARROW, axis=0))
        everything = np.concatenate(covered)
        arrows.place_wordings(ax, texts, everything)
        for layer in self.layers:
            arrows.add_keys(ax, layer)


def sheet_note(ax: Axes, sentences: Sequence[str], colour: str = style.ACCENT) -> None:
    """Write sentences, in a warning colour if nothing else is said, into the sheet's upper left corner."""
    if sentences:
        across = int(ax.get_position(original=True).width * figure_of(ax).get_figwidth() * 72.0 / (0.5 * style.SMALL))
        lines = [line for sentence in sentences for line in textwrap.wrap(sentence, across)]
        look: Keywords = {"fontsize": style.SMALL, "color": colour, "ha": "left", "va": "top", "zorder": 21.0, "gid": "note"}
        box = {"facecolor": style.PAPER, "edgecolor": "none", "alpha": 0.85, "pad": 0.0}
        ax.text(0.012, 0.985, "\n".join(lines), transform=ax.transAxes, bbox=box, **look)


# What can still move while the drives are locked.


def loose_layers(motion: Motion) -> list[ArrowLayer]:
    """Return each movement that nothing holds at one pose as arrows, in mm, of which the fastest point goes ten."""
    found = []
    for number, way in enumerate(loose_movements(motion)):
        colour = (VELOCITY, POLE)[number % 2]
        moves = tuple(VectorArrow(f"loose {number + 1} {name}", motion[name], 10.0 * mm * each, colour) for name, each in way.items())
        found.append(ArrowLayer(moves, shown_in("mm"), ((colour, said("loose movement {number}", number=number + 1)),)))
    return found


# Velocities of the points, from rates of the strokes.


def velocity_layer(motion: Motion, pose: int, rates: Mapping[str, Any]) -> ArrowLayer:
    """Return the velocities of the moving points at a pose as arrows, in m/s; in mm/s where all are slower than 0.1 m/s."""
    moving = []
    at, varied = one_pose(motion, pose), any(np.ndim(rate) for rate in rates.values())  # rates may be arrays over the poses
    notes: tuple[str, ...] = ()
    for name in motion.plan.moving:
        if name not in motion.plan.points:
            continue
        try:
            v = motion.velocity(name, rates).reshape(2, -1)[:, pose] if varied else at.velocity(name, rates)
        except SingularError as error:
            if motion.unreachable != "nan":
                raise
            notes = (said("No velocities here: {why}", why=error),)
            continue
        if np.isfinite(v).all():
            moving.append(VectorArrow(f"velocity {name}", at[name], v, VELOCITY))
    most = max((each.length for each in moving), default=0.0)
    shown = tuple(each for each in moving if each.length > 1e-9 * most)
    unit = shown_in("m/s" if most >= 0.1 else "mm/s")
    words = []
    for name, rate in rates.items():
        if np.ndim(rate):
            words.append(f"{name} {said('as given')}")
        elif name in motion.plan.turning:
            words.append(f"{name} {float(rate):.3g} {translated('rad')}/{translated('s')}")
        else:
            words.append(f"{name} {show(float(rate), 'm/s', 3)}")
    return ArrowLayer(shown, unit, ((VELOCITY, said("velocity at {rates}", rates=", ".join(words))),), notes=notes)


# Poles of bodies.


def pole_marks(motion: Motion, pose: int, asked: object, rates: Rates) -> list[PoleMark]:
    """Return the poles that `draw(pole=...)` asks for at a pose."""
    at = one_pose(motion, pose)
    if rates is not None and any(np.ndim(rate) for rate in rates.values()):
        rates = {name: float(np.broadcast_to(rate, motion.shape).ravel()[pose]) for name, rate in rates.items()}
    pairs = list(asked_poles(motion, asked))
    places = np.array([at[name] for name in at.plan.points])
    near = SAME_POLE * float(np.max(np.ptp(places, axis=0)))
    against_frame = list[tuple[list[str], FloatArray]]()  # all bodies that turn about one place, and it
    for body, other in pairs:
        if other == "frame":
            place = at.pole(body, rates=rates)
            shared = [names for names, each in against_frame if np.allclose(each, place, rtol=0.0, atol=near, equal_nan=True)]
            if shared:
                shared[0].append(body)
            else:
                against_frame.append(([body], place))
    found = []
    for bodies, place in against_frame:
        points = dict.fromkeys(name for body in bodies for name in whole_body(at.plan, body))
        found.append(mark_of(bodies, "frame", place, tuple(at[name] for name in points)))
    for body, other in pairs:
        if other != "frame":  # the pole of two bodies and each one's own stand in one line
            own = [mark_of([each], "frame", at.pole(each, rates=rates)) for each in (body, other) if each != "frame"]
            ends = tuple(mark.at for mark in own if np.isfinite(mark.at).all())
            found += [mark_of([body], other, at.pole(body, other, rates=rates), ends), *own]
    return found


def pole_rates(motion: Motion, pose: int, rates: Rates) -> tuple[Rates, list[str]]:
    """Return the stroke rates for poles, and words for them where they are not given.

    Of several strokes it is the one that runs along the motion, else the first; of several that run together their way at the pose.
    """
    if rates is not None or len(motion.strokes) < 2:
        return rates, []
    values = {name: np.broadcast_to(each, motion._stroke_shape).ravel() for name, each in motion.strokes.items()}
    moving = [name for name, each in values.items() if np.ptp(each) > 0.0] or [next(iter(values))]
    found = dict.fromkeys(values, 0.0)
    for name in moving:
        near = values[name][max(pose - 1, 0) : pose + 2]
        found[name] = float(near[-1] - near[0]) if len(moving) > 1 else 1.0
    if not any(found.values()):
        found[moving[0]] = 1.0
    return found, [said("Poles while {strokes} runs and the other strokes are held.", strokes=", ".join(moving))]


def asked_poles(motion: Motion, asked: object) -> Iterator[tuple[str, str]]:
    """Yield the pairs of bodies whose poles are asked for: True means every body that no fixed pin holds, by its link's name if any."""
    if asked is True:
        fixed, *moving = motion.plan.bodies
        named = {frozenset(link.point_names): name for name, link in motion.plan.of_kind(Link).items()}
        free = [body for body in moving if not set(body.points) & set(fixed.points)] or moving
        yield from ((named.get(frozenset(body.points), body.name), "frame") for body in free)
    elif isinstance(asked, str):
        yield asked, "frame"
    else:
        one, other = own_bodies(motion.plan)
        expected = f'a body, pole="{one}", two of them, pole=("{one}", "{other}"), or True is expected'
        yield body_pair(f"{motion.plan.title}: pole", asked, expected)


def mark_of(bodies: Sequence[str], other: str, place: FloatArray, ends: tuple[FloatArray, ...] = ()) -> PoleMark:
    """Return the mark of one pole, (2,) [m], by the names of its bodies; where it is at infinity or everywhere, the words for that."""
    names, count = ", ".join(bodies), len(bodies)
    name = said("pole of {body}", body=names) if other == "frame" else said("pole of {body} against {other}", body=names, other=other)
    words = ""
    if np.isinf(place).any():
        words = said_of(
            count,
            "{name}: at infinity, square to the velocity, since the body only translates here.",
            "{name}: at infinity, square to the velocity, since these bodies only translate here.",
            name=name,
        )
    elif np.isnan(place).any():
        words = said_of(
            count,
            "{name}: every point, since the body stands still here.",
            "{name}: every point, since these bodies stand still here.",
            name=name,
        )
    return PoleMark(name, place, () if words else ends, words)
