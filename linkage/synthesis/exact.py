"""Machines that exact methods give: four-bars and slider-cranks from the places of their pins, judged for circuit, branch and order.

The machines are the shipped ones that are registered as `four_bar` and `slider_crank`, in variants of their own sides and strokes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from functools import cached_property
from math import acos, pi
from typing import Any, TypeAlias, final

import numpy as np
import numpy.typing as npt

from .. import plugins
from ..errors import StudyError, ensure
from ..frozen import read_only
from ..language import said, said_of
from ..mechanism import Mechanism
from ..mobility import grashof
from ..motion import Featured
from ..plugins import Plugins
from ..program import FloatArray
from ..quantities import Dimension, Member, Stroke, angle, ref
from ..shown import Shown
from ..steps import Guide
from ..study.sides import class_on_sides
from ..units import show
from ..vectors import LEFT, RIGHT, Side
from .defects import TOLD, point_ranges, points_on_circuits
from .fit import TURN, goes_one_way, one_way_round, within_turn

ComplexArray: TypeAlias = npt.NDArray[np.complex128]

NARROW = 1e-9
"""A stroke that is narrower [rad] is none."""
CHANGE_POINT = 1e-9
"""A cosine that is as near to one [1]: the links come into one line there."""
LEAST_LINK = 1e-9
"""Of a task's size: a link that is shorter is none."""


# -- how a pin that is driven comes round -----------------------------------------------------------------------


@final
@dataclass(frozen=True)
class DrivenPiece:
    """The angles of a driven link at which the rest can be assembled: from `start` to `end` [rad]; all of them where it turns `fully`."""

    start: float
    end: float
    fully: bool = False

    def lifted(self, angles: FloatArray) -> FloatArray:
        """Return angles [rad], each by whole turns, as near to the middle of the piece as they come."""
        middle = 0.5 * (self.start + self.end)
        return np.asarray(angles - TURN * np.round((angles - middle) / TURN))

    def holds(self, lifted: FloatArray) -> npt.NDArray[np.bool_]:
        """Return which of the lifted angles lie in the piece, its ends among them."""
        return np.asarray((lifted >= self.start - 1e-7) & (lifted <= self.end + 1e-7))


def angles_of_reach(low: float, high: float, reference: float) -> list[DrivenPiece]:
    """Return where low <= cos(angle - reference) <= high, none where nothing is; a change point ends a piece."""
    if low > 1.0 or high < -1.0 or low > high:
        return []
    below, above = low < -1.0 - CHANGE_POINT, high > 1.0 + CHANGE_POINT
    if below and above:
        return [DrivenPiece(0.0, TURN, True)]
    inner, outer = acos(max(min(high, 1.0), -1.0)), acos(max(min(low, 1.0), -1.0))
    if above:
        return [DrivenPiece(reference - outer, reference + outer)]
    if below:
        return [DrivenPiece(reference + inner, reference + TURN - inner)]
    return [DrivenPiece(reference + inner, reference + outer), DrivenPiece(reference - outer, reference - inner)]


# -- machines -------------------------------------------------------------------------------------------------


def shipped(name: str) -> type[Mechanism]:
    """Return the class that is registered as a machine of a name."""
    ensure(name in REGISTERED, f"The machine {name} is not registered; install the package mechanisms, which ships it.")
    return REGISTERED[name]


def as_machine(found: object) -> type[Mechanism] | None:
    """Return a class of mechanism; None for anything else."""
    return found if isinstance(found, type) and issubclass(found, Mechanism) else None


REGISTERED: Plugins[type[Mechanism]] = Plugins(plugins.MACHINES, "The machine", as_machine, "no class of mechanism", {})


@final
@dataclass(frozen=True, eq=False)
class ExactMachine(Shown):
    """A four-bar or slider-crank by exact algebra, judged: driven from the first to the last point, does it stay on one branch?

    `strokes` (n,) [rad] are those at which it comes to the points, NaN on another branch. `error` is what its links are off in length at
    the points, at the most [m], `transmission` the least transmission angle over the stroke [rad]. `kind` is its Grashof class. `why`
    says in words why it is no answer, "" for one that runs. `machine` runs in any case: over the points of the branch with most of them.
    """

    name: str
    strokes: FloatArray
    error: float
    transmission: float
    kind: str
    why: str
    is_ordered: bool
    turns_fully: bool
    side: Side
    members: Mapping[str, Member]
    dimensions: Mapping[str, Any]

    @cached_property
    def machine(self) -> Mechanism:
        """The machine, of a variant of the shipped class of its name."""
        return exact_variant(self.name, int(self.side), self.members, self.dimensions)

    @property
    def runs(self) -> bool:
        """Whether it is an answer."""
        return not self.why

    @property
    def sentence(self) -> str:
        """What it is in words: its kind, order, circuit and branch, its least transmission angle."""
        count = len(self.strokes)
        if self.why:
            where = self.why
        elif self.is_ordered:
            where = said("all {count} points in order, on one circuit and one branch", count=count)
        else:
            where = said("all {count} points on one circuit and one branch, in an order of their own", count=count)
        least = said("least transmission angle {angle}, of {joint}", angle=show(self.transmission, "deg", 3), joint="B")
        return f"{self.kind}; {where}; {least}."

    def __str__(self) -> str:
        return self.sentence

    __repr__ = __str__


def exact_variant(name: str, side: int, members: Mapping[str, Member], dimensions: Mapping[str, Any]) -> Mechanism:
    """Return a design of the shipped class of a name, its dyad on a side, with some members of its own; one that goes through pickle."""
    base = class_on_sides(shipped(name), {"B": Side(side)})

    def reduce(machine: Mechanism) -> tuple[Any, ...]:
        return exact_variant, (name, side, dict(members), machine.dimensions)

    text = {"__doc__": "Found by exact algebra for a few points.", "__module__": base.__module__, "__qualname__": base.__qualname__}
    make: Any = type(base)
    made: type[Mechanism] = make(base.__name__, (base,), {**text, "featured": featured_path, "__reduce__": reduce, **members})
    return made(**dimensions)


def featured_path(machine: Mechanism) -> Featured:
    """Return the path of P."""
    return Featured("P_y", ["P"])


@final
@dataclass(frozen=True, eq=False)
class ExactSynthesis(Shown):
    """All real machines of a task that exact algebra gives, those that run first by their least transmission angle.

    `solutions` run through all points on one branch; `misses` are the others, each with `why`. `complex_count` is how many solutions the
    equations have in all, complex ones among them.
    """

    title: str
    solutions: tuple[ExactMachine, ...]
    misses: tuple[ExactMachine, ...]
    complex_count: int

    @property
    def all(self) -> tuple[ExactMachine, ...]:
        """All real solutions, those that run first."""
        return (*self.solutions, *self.misses)

    @property
    def machines(self) -> tuple[Mechanism, ...]:
        """The machines that run, the best first."""
        return tuple(each.machine for each in self.solutions)

    @property
    def best(self) -> ExactMachine:
        """The machine with the greatest least transmission angle of those that run; StudyError where none does."""
        if not self.solutions:
            raise StudyError(str(self))
        return self.solutions[0]

    @property
    def machine(self) -> Mechanism:
        """The best machine; StudyError where none runs."""
        return self.best.machine

    @property
    def sentence(self) -> str:
        """How many there are in words, and the first of them."""
        lines = [
            said_of(
                len(self.all),
                "{title}: {n} real solution of {complex} in all, {running} of them run.",
                "{title}: {n} real solutions of {complex} in all, {running} of them run.",
                title=self.title, complex=self.complex_count, running=len(self.solutions),
            )
        ]  # fmt: skip
        return "\n".join([*lines, *(f"  {place}. {each}" for place, each in enumerate(self.all[:TOLD], 1))])

    def __str__(self) -> str:
        return self.sentence

    __repr__ = __str__


def exact_synthesis(title: str, found: Sequence[ExactMachine], complex_count: int) -> ExactSynthesis:
    """Return machines as a result, the greatest least transmission angle first."""
    order = sorted(found, key=lambda each: -each.transmission)
    running, others = (tuple(each for each in order if each.runs is wanted) for wanted in (True, False))
    return ExactSynthesis(title, running, others, complex_count)


# -- judged ---------------------------------------------------------------------------------------------------


@final
@dataclass(frozen=True)
class Pivoted:
    """A pin that turns about a fixed one, or runs on a straight line: its places (n,), the `centre`, or NaN and a `direction` [rad]."""

    places: ComplexArray
    centre: complex
    direction: float = float("nan")

    @property
    def slides(self) -> bool:
        """Whether it runs on a line."""
        return not np.isnan(self.direction)

    @property
    def length(self) -> float:
        """The mean distance from the centre [m]; infinite of one that slides."""
        return float("inf") if self.slides else float(np.mean(abs(self.places - self.centre)))

    @property
    def error(self) -> float:
        """How far the places are off the circle or the line, at the most [m]."""
        if self.slides:
            across = (self.places * np.exp(-1j * self.direction)).imag
            return float(np.ptp(across))
        return float(np.ptp(abs(self.places - self.centre)))


@final
@dataclass(frozen=True)
class CouplerTask:
    """The task of a machine beside its pins. It has the coupler point's places (n,), and the directions of its body, the driven angles and
    the follower's zero angle [rad], or None for each of these. It also says whether the points are to be passed in order.
    """

    points: ComplexArray
    body: FloatArray | None = None
    given: FloatArray | None = None
    follower_zero: float | None = None
    in_order: bool = True


def judged_machine(one: Pivoted, other: Pivoted, asked: CouplerTask, *, both_drives: bool = True) -> ExactMachine:
    """Return the machine of two guided pins of a coupler, driven by the pin that takes it through all points, else by the first.

    Of two drives that do, one that turns fully goes first.
    """
    ways = [(one, other), (other, one)] if both_drives else [(one, other)]
    found = [driven(crank, follower, asked) for crank, follower in ways if not crank.slides]
    return min(found, key=lambda each: (not each.runs, not each.turns_fully))


def driven(crank: Pivoted, follower: Pivoted, asked: CouplerTask) -> ExactMachine:
    """Return the machine of a crank and a follower, judged."""
    coupler = float(np.mean(abs(follower.places - crank.places)))
    driven_angles = np.angle(crank.places - crank.centre)
    ways = crank_pieces(crank, follower, coupler)
    lifted = np.array([each.lifted(driven_angles) for each in ways]).reshape(len(ways), -1)
    inside = np.array([each.holds(row) for each, row in zip(ways, lifted, strict=True)]).reshape(len(ways), -1)
    number = np.where(inside.any(axis=0), inside.argmax(axis=0), 0)
    rod = follower.places - crank.places
    if follower.slides:
        left = (rod * np.exp(-1j * follower.direction)).real <= 0.0
    else:
        left = (np.conj(follower.centre - crank.places) * rod).imag > 0.0
    fully = bool(ways) and ways[0].fully
    circuit = left.astype(int) if fully else number
    strokes, turn = strokes_at_points(ways, number, driven_angles, asked)
    parts = [*zip(number.tolist(), left.tolist(), turn.tolist(), strict=True)]
    most = max(dict.fromkeys(parts), key=parts.count)
    here = np.array([each == most for each in parts])
    piece = ways[most[0]] if ways else DrivenPiece(-pi, pi)
    ordered = asked.given is not None or goes_one_way(one_way_round(strokes) if fully else strokes, TURN)
    why = why_not(parts, circuit, asked, ordered=ordered)
    strokes = np.where(here, strokes, np.nan)
    low, high = stroke_ends(piece, strokes, asked)
    share = (asked.points - crank.places) / rod  # of one place of the coupler it is the same at all points
    off = float(abs(share - share[0]).max() * abs(rod[0]))
    error = max(crank.error, follower.error, float(np.ptp([*abs(rod), coupler])), off)
    side = LEFT if most[1] else RIGHT
    members, dimensions = variant_of(crank, follower, coupler, (low, high), asked)
    name = "slider_crank" if follower.slides else "four_bar"
    if follower.slides:
        kind = said("slider-crank, its crank turns fully") if fully else said("slider-crank, its crank rocks")
    else:
        kind = grashof(abs(follower.centre - crank.centre), crank.length, coupler, follower.length)
    least = least_angle_at_follower(crank, follower, coupler, np.array([low, high]), piece)
    return ExactMachine(name, read_only(strokes), error, least, kind, why, ordered, fully, side, members, dimensions)


def crank_pieces(crank: Pivoted, follower: Pivoted, coupler: float) -> list[DrivenPiece]:
    """Return the angles of the crank at which coupler and follower meet."""
    a = crank.length
    if follower.slides:
        normal = follower.direction + 0.5 * pi
        away = float(((crank.centre - follower.places[0]) * np.exp(-1j * normal)).real)
        return angles_of_reach((-coupler - away) / a, (coupler - away) / a, normal)
    frame, c = follower.centre - crank.centre, follower.length
    d = abs(frame)
    low, high = ((a * a + d * d - each * each) / (2.0 * a * d) for each in (coupler + c, coupler - c))
    return angles_of_reach(low, high, float(np.angle(frame)))


def strokes_at_points(
    ways: Sequence[DrivenPiece], number: npt.NDArray[np.int_], driven_angles: FloatArray, asked: CouplerTask
) -> tuple[FloatArray, npt.NDArray[np.int_]]:
    """Return the strokes at the points (n,) [rad], each within its way, and by how many turns those that are given are off (n,)."""
    fully = bool(ways) and ways[0].fully
    if asked.given is None and fully:
        return within_turn(one_way_round(driven_angles), 0.0), np.zeros(len(number), int)
    turned = driven_angles if asked.given is None else asked.given
    lifted = np.array([each.lifted(turned) for each in ways])[number, np.arange(len(number))] if ways else turned
    if asked.given is None:
        return lifted, np.zeros(len(number), int)
    off = np.round((turned - lifted) / TURN).astype(int)
    return asked.given, np.zeros_like(off) if fully else off


def stroke_ends(piece: DrivenPiece, strokes: FloatArray, asked: CouplerTask) -> tuple[float, float]:
    """Return the ends of the machine's stroke [rad]: a whole turn, or from the least to the greatest of the points.

    Where there is one point alone, half-way to the ends of its piece.
    """
    if piece.fully and asked.given is None:
        return 0.0, TURN
    low, high = float(np.nanmin(strokes)), float(np.nanmax(strokes))
    if high - low > NARROW:
        return low, high
    here = float(piece.lifted(np.array(low)))
    return low + 0.5 * (piece.start - here), low + 0.5 * (piece.end - here)


def why_not(parts: Sequence[tuple[int, bool, int]], circuit: npt.NDArray[np.int_], asked: CouplerTask, *, ordered: bool) -> str:
    """Return why a machine is no answer, in words; "" for one that is. `parts` are the ways, sides and turns of the points."""
    circuits = [*dict.fromkeys(circuit.tolist())]
    if len(circuits) > 1:
        return points_on_circuits([(np.flatnonzero(circuit == each) + 1).tolist() for each in circuits])
    branches = [*dict.fromkeys(parts)]
    if len(branches) > 1:
        some, others = (point_ranges([k for k, each in enumerate(parts, 1) if each == branch]) for branch in branches[:2])
        return said("a dead point stands between points {some} and {others}", some=some, others=others)
    return said("it comes to the points in another order") if asked.in_order and not ordered else ""


def least_angle_at_follower(crank: Pivoted, follower: Pivoted, coupler: float, ends: FloatArray, piece: DrivenPiece) -> float:
    """Return the least transmission angle at the follower's pin over a stroke [rad], exactly."""
    if follower.slides:
        normal = follower.direction + 0.5 * pi
        turned = angles_between(ends, normal, piece)
        away = ((crank.centre - follower.places[0]) * np.exp(-1j * normal)).real + crank.length * np.cos(turned - normal)
        return float(np.arccos(np.clip(abs(away) / coupler, 0.0, 1.0)).min())
    frame = follower.centre - crank.centre
    turned = angles_between(ends, float(np.angle(frame)), piece)
    far = abs(frame - crank.length * np.exp(1j * turned))
    cosine = (coupler**2 + follower.length**2 - far**2) / (2.0 * coupler * follower.length)
    return float(np.arccos(np.clip(abs(cosine), 0.0, 1.0)).min())


def angles_between(ends: FloatArray, reference: float, piece: DrivenPiece) -> FloatArray:
    """Return the ends of a stroke and the places between at which a cosine about a reference is greatest or least [rad]."""
    if piece.fully and ends[1] - ends[0] >= TURN:
        return np.array([reference, reference + pi])
    low, high = ends
    tops = reference + pi * np.arange(np.ceil((low - reference) / pi), np.floor((high - reference) / pi) + 1)
    return np.array([*ends, *tops])


def variant_of(
    crank: Pivoted, follower: Pivoted, coupler: float, ends: tuple[float, float], asked: CouplerTask
) -> tuple[dict[str, Member], dict[str, Any]]:
    """Return the members by which a variant of the shipped class differs from it, and the dimensions of the design."""
    rod = follower.places[0] - crank.places[0]
    share = (asked.points[0] - crank.places[0]) / rod
    lengths = {"OA": crank.length, "AB": coupler, "AP": abs(share) * coupler, "BAP": float(np.angle(share))}
    members: dict[str, Member] = {"phi": Stroke(*ends)}
    if asked.body is not None:
        theta0 = float(np.angle(rod * np.exp(-1j * asked.body[0])))
        members |= {"theta0": Dimension(theta0, "deg"), "theta": angle("A", "B") - ref("theta0")}
    if asked.follower_zero is not None:
        members |= {"psi0": Dimension(asked.follower_zero, "deg"), "psi": angle("C", "B") - ref("psi0")}
    if follower.slides:
        rail = follower.places[0]
        members["rail"] = Guide((rail.real, rail.imag), angle=follower.direction)
        members["P"] = copy(shipped("four_bar").plan.points["P"])
    fixed = {"O": crank.centre} if follower.slides else {"O": crank.centre, "C": follower.centre}
    places = {name: (place.real, place.imag) for name, place in fixed.items()}
    return members, lengths | places | ({} if follower.slides else {"CB": follower.length})


def is_without_links(one: Pivoted, other: Pivoted, size: float) -> bool:
    """Return whether a link has no length, of a task of some size [m]."""
    lengths = [each.length for each in (one, other)]
    lengths.append(float(abs(one.places[0] - other.places[0])))
    if not (one.slides or other.slides):
        lengths.append(abs(one.centre - other.centre))
    return min(lengths) < LEAST_LINK * size
