"""Machines that exact methods give: four-bars and slider-cranks from the places of their pins, judged for circuit, branch and order.

The machines are the shipped ones that are registered as `four_bar` and `slider_crank`, in variants of their own sides and strokes.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass
from functools import cached_property
from math import acos, pi
from typing import TYPE_CHECKING, Any, Generic, Protocol, TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt

from .. import plugins
from ..errors import DefinitionError, StudyError, ensure, is_class_of, require, require_whole
from ..frozen import read_only, record
from ..language import said, said_of
from ..mechanism import Mechanism, require_mechanism
from ..mobility import FourBar, grashof
from ..motion import Featured, Motion
from ..numeric.descent import refined
from ..plugins import Plugins
from ..quantities import Dimension, Member, Stroke, angle, ref
from ..shown import HasSentence, Shown, ShownList
from ..steps import Guide
from ..study.space import check_one_design
from ..study.variants import class_like, variant
from ..units import require_number, show
from ..vectors import LEFT, RIGHT, FloatArray, Side
from .defects import TOLD, point_ranges, points_on_circuits
from .fit import TURN, goes_one_way, one_way_round, within_turn
from .tasks import check_point, check_radians, table_of

ComplexArray: TypeAlias = npt.NDArray[np.complex128]

NARROW = 1e-9
"""A stroke that is narrower [rad] is none."""
CHANGE_POINT = 1e-9
"""A cosine that is as near to one [1]: the links come into one line there."""
LEAST_LINK = 1e-9
"""Of a task's size: a link that is shorter is none."""


# -- how a pin that is driven comes round -----------------------------------------------------------------------


@record
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


REGISTERED = Plugins[type[Mechanism]](
    plugins.MACHINES, "The machine", lambda found: found if is_class_of(found, Mechanism) else None, "no class of mechanism", {}
)


@dataclass(frozen=True, eq=False, repr=False)
class ExactMachine(HasSentence, Shown):
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
        """The answer in words: its kind, order, circuit and branch, its least transmission angle."""
        count = len(self.strokes)
        if self.why:
            where = self.why
        elif self.is_ordered:
            where = said("all {count} points in order, on one circuit and one branch", count=count)
        else:
            where = said("all {count} points on one circuit and one branch, in an order of their own", count=count)
        least = said("least transmission angle {angle}, of {joint}", angle=show(self.transmission, "deg", 3), joint="B")
        return f"{self.kind}; {where}; {least}."


def exact_variant(name: str, side: int, members: Mapping[str, Member], dimensions: Mapping[str, Any]) -> Mechanism:
    """Return a design of the shipped class of a name, its dyad on a side, with some members of its own; one that goes through pickle."""
    base = variant(shipped(name), {"B": Side(side)})

    def reduce(machine: Mechanism) -> tuple[Any, ...]:
        return exact_variant, (name, side, dict(members), machine.dimensions)

    def featured(machine: Mechanism) -> Featured:
        return Featured("P_y", ["P"])

    text = {"__doc__": "Found by exact algebra for a few points.", "featured": featured}
    return class_like(base, {**text, **members}, reduce)(**dimensions)


class HasMachine(Protocol):
    """What holds a machine."""

    @property
    def machine(self) -> Mechanism:
        """The machine."""


Found = TypeVar("Found", bound=HasMachine, covariant=True)


class FoundMachines(HasSentence, Shown, ABC, Generic[Found]):
    """The base of what a synthesis finds: its `solutions` run, the best first."""

    if TYPE_CHECKING:

        @property
        def solutions(self) -> tuple[Found, ...]:
            """The machines that run, the best first."""

    @property
    @abstractmethod
    def sentence(self) -> str:
        """What was found, in words; those of the StudyError where no machine runs."""

    @property
    def machines(self) -> tuple[Mechanism, ...]:
        """The machines that run, the best first."""
        return tuple(each.machine for each in self.solutions)

    @property
    def best(self) -> Found:
        """The first solution; StudyError where there is none, in the words of what was found."""
        if not self.solutions:
            raise StudyError(str(self))
        return self.solutions[0]

    @property
    def machine(self) -> Mechanism:
        """The machine of the first solution; StudyError where there is none."""
        return self.best.machine


@dataclass(frozen=True, eq=False, repr=False)
class ExactSynthesis(FoundMachines[ExactMachine]):
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


def exact_synthesis(title: str, found: Sequence[ExactMachine], complex_count: int) -> ExactSynthesis:
    """Return machines as a result, the greatest least transmission angle first."""
    order = sorted(found, key=lambda each: -each.transmission)
    running, others = (tuple(each for each in order if each.runs is wanted) for wanted in (True, False))
    return ExactSynthesis(title, running, others, complex_count)


# -- judged ---------------------------------------------------------------------------------------------------


@record
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


@record
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
    frame = follower.centre - crank.centre
    reference = follower.direction + 0.5 * pi if follower.slides else float(np.angle(frame))
    if piece.fully and ends[1] - ends[0] >= TURN:
        turned = np.array([reference, reference + pi])
    else:  # the ends, and the places between at which a cosine about the reference is greatest or least
        low, high = ends
        tops = reference + pi * np.arange(np.ceil((low - reference) / pi), np.floor((high - reference) / pi) + 1)
        turned = np.array([*ends, *tops])
    if follower.slides:
        away = ((crank.centre - follower.places[0]) * np.exp(-1j * reference)).real + crank.length * np.cos(turned - reference)
        return float(np.arccos(np.clip(abs(away) / coupler, 0.0, 1.0)).min())
    far = abs(frame - crank.length * np.exp(1j * turned))
    cosine = (coupler**2 + follower.length**2 - far**2) / (2.0 * coupler * follower.length)
    return float(np.arccos(np.clip(abs(cosine), 0.0, 1.0)).min())


def variant_of(
    crank: Pivoted, follower: Pivoted, coupler: float, ends: tuple[float, float], asked: CouplerTask
) -> tuple[dict[str, Member], dict[str, object]]:
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


# -- Freudenstein's equation: four-bars for pairs of angles, by algebra --------------------------------------------


FREE = ("crank", "follower")
REAL = 1e-6
RANK = 1e-13
"""Of the largest singular value of the equations: where the least is less, they are not independent."""
LARGEST = 1e6
"""Links that are so many times longer than the frame are none."""


def freudenstein(pairs: object, *, free: str = "follower", ground: float = 1.0) -> ExactSynthesis:
    """Return all four-bars that turn angles of the crank into angles of the follower: `freudenstein([(0.5, 0.9), (0.9, 1.2), (1.3, 1.6)])`.

    `pairs` (n, 2) are (phi, psi) [rad], three to five of them. Of three, both are measured from the frame O -> C. Of four, the zero of
    one is an unknown too, that of the `free` one, "crank" or "follower"; of five those of both. Stroke phi and output psi of a machine are
    as in the pairs: the frame OC is turned so that phi is the direction of OA, and `psi0` [rad] is where CB stands at psi = 0. `ground`
    is the length of the frame [m].

    At most one machine of three pairs, two of four, three of five. DefinitionError for pairs that cannot be asked, StudyError for those
    of every parallelogram. Source: Freudenstein: Approximate synthesis of four-bar linkages, Trans. ASME 77 (1955) 853-861.

    Parameters
    ----------
    pairs : array_like
        The angles (phi, psi) [rad], shape (n, 2).
    free : str
        "crank" or "follower".
    ground : float
        The length of the frame [m].

    Returns
    -------
    ExactSynthesis
        The machines.

    Raises
    ------
    DefinitionError
        Wrong pairs.
    StudyError
        Pairs of every parallelogram.
    """
    rows = table_of("freudenstein", "pairs", pairs, 2, "pairs (phi, psi)")
    ensure(3 <= len(rows) <= 5, f"freudenstein: {len(rows)} pairs; three to five of them decide a four-bar, more go with synthesise(...).")
    require(free in FREE, "freudenstein(free", free, '"crank" or "follower" is expected')
    require_number("freudenstein(ground", ground, "a length above zero is expected, in m", above=0.0, kind="length")
    for name, column in zip(("phi", "psi"), rows.T, strict=True):
        check_radians("freudenstein", name, column)
        turned = np.exp(1j * column)
        apart = abs(turned[:, None] - turned[None])[np.triu_indices(len(column), 1)]
        if (apart.min() if name == "phi" else apart.max()) < 1e-9:  # two are one, modulo a turn; of the follower all of them
            raise DefinitionError(f"freudenstein: two values of {name} are the same; give angles that differ.")
    freed = FREE if len(rows) == 5 else (free,) if len(rows) == 4 else ()
    p, s = np.exp(1j * rows.T)
    solved = [(u, v) for u, v in links(p, s, freed) if max(abs(u), abs(v)) < LARGEST]
    found: list[ExactMachine] = []
    for u, v in solved:
        frame = ground * np.exp(-1j * np.angle(u))  # turned so that the crank's angle is phi
        crank, follower = Pivoted(ground * abs(u) * p, 0.0), Pivoted(frame * (1.0 + v * s), complex(frame))
        if not is_without_links(crank, follower, ground):
            first = int(np.argmin(rows[:, 0]))  # where a sweep begins, so that psi has no turn too many
            zero = float(np.angle(follower.places[first] - follower.centre) - rows[first, 1])
            asked = CouplerTask(0.5 * (crank.places + follower.places), given=rows[:, 0], follower_zero=zero)
            found.append(judged_machine(crank, follower, asked, both_drives=False))
    title = said("Four-bars for {count} pairs of angles", count=len(rows))
    return exact_synthesis(title, found, max(len(rows) - 2, len(found)))


# With the frame as 1, crank u p and follower v s, p = exp(i phi), s = exp(i psi), the coupler keeps its length where
#     |1 + v s - u p|^2 = const, so that 2 Re[v (s - s0) - u (p - p0) - w (p s* - p0 s0*)] = 0 with w = u v*,
# linear in the real parts of u, v and w. What is left free is a plane of solutions, or a line; w = u v* picks those in it.


def links(p: ComplexArray, s: ComplexArray, freed: Sequence[str]) -> list[tuple[complex, complex]]:
    """Return crank and follower, in parts of the frame, as complex numbers: real where their zero angle is not free."""
    by = [-(p - p[0]), s - s[0], -(p * s.conj() - p[0] * s[0].conj())]
    rows = np.stack([column for each in by for column in (each[1:].real, -each[1:].imag)], axis=1)  # of the parts of u, v, w
    u, v = "crank" in freed, "follower" in freed
    kept = [0, *([1] if u else []), 2, *([3] if v else []), 4, *([5] if u or v else [])]
    left = len(kept) - len(rows)
    _, sizes, every = np.linalg.svd(rows[:, kept])
    if sizes[-1] < RANK * sizes[0]:
        raise StudyError("freudenstein: phi and psi turn alike, as in every parallelogram; let one of the pairs differ from that.")
    basis = np.zeros((6, left))
    basis[kept] = every[-left:].T
    shares, found = [np.ones(1)], []
    if left > 1:  # the lines of the plane in which w / (u v*) is real
        U, V, wanted = (basis[k] + 1j * basis[k + 1] for k in (0, 2, 4))
        for each in (*([U.conj()] if u else []), *([V] if v else [])):
            wanted = np.polynomial.polynomial.polymul(wanted, each)
        shares = [np.array([1.0, t]) for t in real_roots(wanted.imag)]
    for share in shares:
        U, V, W = (complex(*(basis[k : k + 2] @ share)) for k in (0, 2, 4))
        with np.errstate(all="ignore"):
            size = float(np.real(W / (U * np.conj(V)))) if U and V else 0.0
        exact = exact_links(size * U, size * V, p, s, u, v) if size and np.isfinite(size) else None
        if exact is not None:
            found.append(exact)
    return found


def real_roots(coefficients: FloatArray) -> list[float]:
    """Return the real roots of a polynomial, its lowest coefficient first."""
    size = abs(coefficients).max()
    roots = np.polynomial.polynomial.polyroots(np.trim_zeros(np.where(abs(coefficients) > 1e-14 * size, coefficients, 0.0), "b"))
    return [float(root.real) for root in roots if abs(root.imag) < REAL * max(abs(root), 1.0)]


def exact_links(u: complex, v: complex, p: ComplexArray, s: ComplexArray, free_u: bool, free_v: bool) -> tuple[complex, complex] | None:
    """Return crank and follower made exact by Newton's method; None where they are no solution."""
    own = [0, *([1] if free_u else []), 2, *([3] if free_v else [])]
    state = np.array([u.real, u.imag if free_u else 0.0, v.real, v.imag if free_v else 0.0])

    def step(state: FloatArray) -> FloatArray:
        rod = 1.0 + complex(*state[2:]) * s - complex(*state[:2]) * p
        turned = complex(*state[2:]) * (s[1:] - s[0]) - complex(*state[:2]) * (p[1:] - p[0])
        over = 0.5 * (turned.conj() * (rod[1:] + rod[0])).real  # how far the halved squares are apart, to the last digits of that
        by = np.stack([-(rod.conj() * p).real, (rod.conj() * p).imag, (rod.conj() * s).real, -(rod.conj() * s).imag], axis=1)
        change = np.zeros(4)
        change[own] = np.linalg.lstsq((by[1:] - by[0])[:, own], -over, rcond=None)[0]
        return change

    found = refined(state, step)
    if found is None:
        return None
    state = found
    far: FloatArray = np.abs(1.0 + complex(*state[2:]) * s - complex(*state[:2]) * p)
    exact = np.ptp(far) < 1e-11 * max(far.max(), abs(state).max())
    return (complex(*state[:2]), complex(*state[2:])) if exact else None


# -- the theorem of Roberts and Chebyshev: the other four-bars of one coupler curve ----------------------------------


RIGID = 1e-9
"""Of a coupler's length: a point that moves by less in its axes is one of it."""


def cognates(machine: Mechanism, of: str = "P", *, count: int = 73) -> ShownList[ExactMachine]:
    """Return the two other four-bars whose coupler point goes along the path of a point: `cognates(FourBar(), of="P")`.

    The machine has one stroke and a four-bar on the frame, of any class, whose coupler carries the point. The path is looked at in `count`
    poses of the stroke. The third four-bar's crank turns with the machine's; the second's coupler does, and it is driven at the pivot
    that takes it farthest. `strokes` (count,) are those at which they stand where the machine does, NaN past a dead point, as `why` says.

    Raises DefinitionError for another structure, and for a pin, whose path is an arc. Sources of the theorem: Roberts: On three-bar motion
    in plane space, Proc. London Math. Soc. 7 (1875) 14-23; Chebyshev 1878.

    Parameters
    ----------
    machine : Mechanism
        The design.
    of : str
        The coupler point.
    count : int
        The number of poses.

    Returns
    -------
    list of ExactMachine
        The two cognates.

    Raises
    ------
    DefinitionError
        Another structure, or a pin.
    """
    require_mechanism(machine)
    check_one_design(machine)
    title = machine.plan.title
    check_point(machine, of)
    require_whole("cognates(count", count, "a whole number of poses is expected, at least 3", least=3)
    ensure(len(machine.strokes) == 1, f"{title}: cognates are those of a machine of one stroke; this one has {len(machine.strokes)}.")
    motion = machine.sweep(count)
    bar, share = carrying(machine, motion, of)
    O, A, B, C = (complex_places(motion, name) for name in bar.pins)
    P, o, c = complex_places(motion, of), complex(O[0]), complex(C[0])
    w = o + share * (c - o)
    second = Pivoted(o + P - A, o), Pivoted(w + share * (B - C), w)
    third = Pivoted(w + (1.0 - share) * (A - O), w), Pivoted(c + P - B, c)
    asked = CouplerTask(P, in_order=False)
    return ShownList([judged_machine(*pins, asked) for pins in (second, third)])


def carrying(machine: Mechanism, motion: Motion, of: str) -> tuple[FourBar, complex]:
    """Return the four-bar whose coupler carries a point, and its place along and across the coupler, of length one."""
    bars = machine.four_bars
    P = complex_places(motion, of)
    for bar in bars:
        A, B = (complex_places(motion, name) for name in bar.pins[1:3])
        share = (P - A) / (B - A)
        if abs(share - share[0]).max() > RIGID * max(abs(share[0]), 1.0):
            continue
        if min(abs(share[0]), abs(share[0] - 1.0)) < RIGID:
            raise DefinitionError(f"{machine.plan.title}: {of} is a pin of the coupler, whose path is an arc; name another point of it.")
        return bar, complex(share.mean())
    found = ", ".join("-".join(bar.pins) for bar in bars) or "none"
    raise DefinitionError(f"{machine.plan.title}: {of} is on no coupler of a four-bar on the frame; its four-bars are: {found}.")


def complex_places(motion: Motion, name: str) -> ComplexArray:
    """Return the places of a point in all poses of a motion (n,), as complex numbers."""
    x, y = np.broadcast_arrays(*motion[name])
    return np.asarray(np.broadcast_to(x + 1j * y, motion.shape))
