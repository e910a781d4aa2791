"""The working field: the load at every place that a point reaches, and its limit there.

A place is reached on one branch of the strokes or on several, with strokes to spare on infinitely many: the one counts on which most is
carried. The load at a pose is the largest that leaves every bounded element within its bounds (`statics/carried.py`); factors of a rule
come on top. Nothing here knows which kinds of elements limit a load.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import cached_property, partial
from itertools import combinations, product
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ..errors import DefinitionError, cited, ensure, is_listed, known_name, require, require_type, unwarned
from ..frozen import FrozenDict, frozen, immutable, read_only
from ..language import heading_of, noted, said
from ..loads import Case, ForceElement, Weight
from ..mechanism import Mechanism
from ..motion import Column, Motion, Over, Target
from ..motion.judge import Domain
from ..motion.many_places import EDGE, ManyPlaces, PlacePoses
from ..motion.measures import words_of
from ..motion.places import DECLARED, StrokeRanges
from ..motion.planes import Planes, clearance, pairs_of
from ..numeric.descent import descended
from ..numeric.linear import solved_systems
from ..plan import Plan
from ..quantities import PoseCondition, Quantity, Reference, is_number, name_of, quantity, real
from ..quantities import x as x_of
from ..quantities import y as y_of
from ..statics.applied import case_of
from ..statics.carried import PROBE, SLIPPING, TIPPING, Direction, LoadAt, direction_words, greatest_load, pull_direction
from ..units import show
from ..vectors import FloatArray, Index, Mask
from .load_rule import LoadRule, rule_of
from .reach import Reach
from .space import check_one_design

OUT_OF_REACH = noted("out of reach")
NOT_LIMITED = noted("not limited")
CLEARANCE = noted("clearance")
MOST_CELLS = 40_000
STARTS, NEXT = {1: 2, 2: 8}, {1: 1.5, 2: 0.9}
"""By how many strokes are spare, from how many poses of each place it is climbed, and how many steps of the first look they stand apart."""
LOOKS = {1: ((2, 1.0), (12, 0.4)), 2: ((6, 1.0), (24, 0.6), (24, 0.2))}
"""How often it is looked around, and with how much room at first, in steps of the first look: all poses, then the best of each place."""
USUAL = {1: 0.05, 2: 0.7}
"""By how many are spare: those are the usual ones where the slopes of the others are regular to this share of what others' would be."""
FEW, BEYOND = 6, 0.25
"""Steps of Newton from a pose near by, and how far past their ends strokes are followed there, in shares of their ranges."""


@immutable
class WorkingField:
    """The loads at a point over a grid of places; arrays have the shape (heights, radii).

    Attributes
    ----------
    machine : Mechanism
        The machine.
    point : str
        Where the load acts.
    along : tuple of float
        The direction of the load.
    x, y : array
        The places [m].
    load : array
        The greatest load [N]: NaN out of reach, infinite where nothing limits it.
    limiter : array of str
        What limits it: an element, a limit by its name, "tipping", "out of reach".
    strokes : mapping of str to array
        Those of the pose [m or rad].
    of : mapping of str to array
        The load that each limiter leaves [N], factors of the rule included.
    rule : LoadRule
        The factors of the load by its limit.
    case : str
        The load case.
    remarks : tuple of str
        What was left out, in sentences.
    failing : mapping of str to int
        In how many cells conditions fail that limit nothing, such as a rod that buckles.
    search : FieldSearch
        The search that found the poses.
    """

    machine: Mechanism
    point: str
    along: Direction
    x: FloatArray
    y: FloatArray
    load: FloatArray
    limiter: NDArray[np.str_]
    strokes: Mapping[str, FloatArray]
    of: Mapping[str, FloatArray]
    rule: LoadRule
    case: str
    remarks: tuple[str, ...]
    failing: Mapping[str, int]
    search: FieldSearch

    @property
    def reached(self) -> Mask:
        """The cells that some pose reaches."""
        return ~np.isnan(self.load)

    @property
    def limiters(self) -> tuple[str, ...]:
        """The limits of the load, in order, as far as they apply somewhere."""
        found = set(self.limiter.ravel().tolist())
        return tuple(each for each in (*self.of, NOT_LIMITED, OUT_OF_REACH) if each in found)

    @cached_property
    def why(self) -> NDArray[np.object_]:
        """Why a cell is out of reach: which stroke would be past which end, by how much, or how far off the nearest pose is; else ""."""
        return self.search.reasons(self.reached)

    @cached_property
    def border(self) -> FloatArray:
        """The border of all that the point reaches, in straight pieces, shape (n, 2, 2) [m]: pieces, their two ends, x and y."""
        return self.search.reach.border

    @cached_property
    def area(self) -> float:
        """The area of all that the point reaches [m2], whatever cells were asked for."""
        return self.search.area()

    def pressures(self) -> list[str]:
        """Return the pressures that it holds for, in words: of each element that has one, with its relief valve's.

        Returns
        -------
        list of str
            One sentence an element.
        """
        one = self.search.loads.motion_over({name: np.array([value]) for name, value in self.machine.plan.sketch_strokes.items()})
        words = []
        for name, element in self.machine.plan.of_kind(ForceElement).items():
            if element.parameters.get("pressure") == "bar":
                given = {each: float(np.squeeze(element.number(one, each))) for each in ("pressure", "relief") if each in element.numbers}
                shown = {each: show(value, "bar", 4) for each, value in given.items()}
                relief = said(" (relief {relief})", relief=shown["relief"]) if "relief" in shown else ""
                words.append(f"{name} {shown['pressure']}{relief}")
        return words

    def columns(self) -> list[Column]:
        """Return the chart as a table, a row each radius: the load [kN] at each height.

        Returns
        -------
        list of Column
            The columns.
        """
        loads = [Column(f"{self.point}_y {height:.4g}", self.load[k], "kN", 2) for k, height in enumerate(self.y)]
        return [Column(f"{self.point}_x", self.x, "m", 3), *loads]

    def cells(self) -> list[dict[str, Any]]:
        """Return each cell as a row: x, y [m], load [N], limiter, strokes [SI], why; heights from above, radii ascending.

        Returns
        -------
        list of dict
            The rows.
        """
        rows: list[dict[str, Any]] = []
        for k, n in product(np.argsort(-self.y, kind="stable"), np.argsort(self.x, kind="stable")):
            place = {"x": float(self.x[n]), "y": float(self.y[k]), "load": float(self.load[k, n]), "limiter": str(self.limiter[k, n])}
            strokes = {name: float(values[k, n]) for name, values in self.strokes.items()}
            rows.append({**place, **strokes, "why": str(self.why[k, n])})
        return rows

    def motion(self) -> Motion:
        """Return the motion of the cells that are reached, in the order of `load[field.reached]`.

        Returns
        -------
        Motion
            The motion.
        """
        return self.search.loads.motion_over({name: each[self.reached] for name, each in self.strokes.items()})

    def __str__(self) -> str:
        known = self.load[np.isfinite(self.load)]
        what = said(
            "{title}: what is lifted at {point}, {count} of {all} cells reached", title=self.machine.plan.heading, point=self.point,
            count=int(self.reached.sum()), all=self.load.size,
        )  # fmt: skip
        if known.size:
            what += said(", {low} to {high}", low=show(float(known.min()), "kN", 4), high=show(float(known.max()), "kN", 4))
        return f"{what}."


def working_field(
    machine: Mechanism,
    point: Reference,
    x: object,
    y: object,
    *,
    along: tuple[object, object] = (0.0, 1.0),
    hold: Mapping[str, float] | None = None,
    over: Over | Mapping[str, object] | None = None,
    keep: Sequence[Target] = (),
    lifts: Sequence[Reference] | None = None,
    rule: LoadRule | str | None = None,
    case: Case = None,
    without: Sequence[Reference] = (),
    limits: Mapping[str, object] | None = None,
) -> WorkingField:
    """Return a machine's loads at a point over places x by y [m]: `working_field(digger, "L", x=np.linspace(1, 6, 14), y=[0, 1, 2])`.

    The load pulls against the direction `along`, beside the machine's own loads of a `case`; `without` names loads that are left out.
    Strokes on `hold` stand still. The others run as far as they are declared, or as `over` says, Over(S=(0.0, 0.2)) or a dictionary
    short for it. Up to two may be spare, and stand where most is carried. `keep` are `Target`s that hold at every place, such as the
    angle of a fork. `lifts` are the cylinders at pump pressure (all unless said), the others hold at their relief
    valves.
    `rule` is a LoadRule, its title too: ISO_10567, ISO_14397_1, OECD_2. `limits` are further ones by name: a number or a quantity that the
    load may not exceed, {"rated load": 20 * kN}, or a comparison of a request, {"stability": drive_force("phi") >= -120 * kN}.

    Parameters
    ----------
    machine : Mechanism
        The design.
    point : str or Point
        The point, or its name.
    x : array_like
        The radii [m].
    y : array_like
        The heights [m].
    along : tuple
        The direction against which the load pulls, two numbers or quantities.
    hold : mapping, optional
        Strokes held at a value by name [m or rad].
    over : Over, str or mapping, optional
        The domain, or the name of a declared one; by default all that the machine runs.
    keep : sequence of Target
        Targets that hold at every place.
    lifts : sequence, optional
        The cylinders at pump pressure.
    rule : LoadRule or str, optional
        The factors of the load.
    case : LoadCase or str, optional
        A load case, or its name.
    without : sequence
        Declared loads that are left out.
    limits : mapping, optional
        Further limits by name.

    Returns
    -------
    WorkingField
        The loads and their limits.
    """
    check_one_design(machine)
    search = FieldSearch(machine, point, x, y, along, hold, over, keep, lifts, rule_of(rule), case, without, limits)
    with unwarned(), np.errstate(all="ignore"):
        return search.field()


LEAST = 1e-6
"""Room, in shares of the spare strokes' ranges, below which nothing is looked for."""
CLOSE, SAME = 0.0005, 1e-11
"""With less room than this nothing more is looked for where no more than so much of a load is promised."""
LESS, LITTLE, MORE, ROOM = 0.1, 0.25, 2.0, 0.125
"""What is left of the room where a promise inside it is kept, where one is not, and where it is kept at its border; the most room."""
KEPT = 0.1
"""The share of what is promised that has to come true."""
COST = 100.0
"""What a stroke costs that is a whole range past its end, in loads."""
GRID, ZOOMS, CLOSER = np.linspace(-1.0, 1.0, 9), 5, 0.3
"""Where the parabolas are looked at, in shares of the room, how often, and how much closer each time."""


MovedPoses: TypeAlias = Callable[[PlacePoses, Index, FloatArray], tuple[FloatArray, FloatArray]]
"""What gives poses with their spare strokes at some values, and the load of each limiter there."""


class Climb:
    """Poses (n) whose spare strokes go to where most is carried; the first `solved` strokes of each are solved for.

    `moved` gives poses (m, n, k) with the spare strokes at some values (m, n, s), and the load of each limiter there (limiters, m, n), NaN
    without one. `order` (n, k) is the order of the strokes of each. `unit` (n, k) are the best poses found, in this order, and `load`
    theirs [N]. `centre` (n, k) is where each is now, maybe a little past an end, and `worth` what that counts. `room` (n,) is how far
    around it the search looks, in shares of the spare strokes' ranges.
    """

    def __init__(self, moved: MovedPoses, solved: int, start: PlacePoses, order: Index, load: FloatArray, room: float) -> None:
        self.moved, self.solved, self.place, self.order = moved, solved, start.place, order
        self.unit, self.centre, self.load, self.worth = start.unit.copy(), start.unit.copy(), load.copy(), load.copy()
        self.room = np.full(len(load), room)

    def step(self, rows: Index) -> None:
        """Look around some of them once."""
        place, order = self.place[rows], self.order[rows]
        now, before, own = self.centre[rows], self.worth[rows], self.room[rows]
        k, s = self.solved, self.centre.shape[1] - self.solved
        around = np.array([*product((-1.0, 0.0, 1.0), repeat=s)])
        room = own[:, None]
        middle = np.clip(now[:, k:], np.minimum(room, 0.5), np.maximum(1.0 - room, 0.5))
        unit, of = self.moved(PlacePoses(place, now), order, middle[None] + around[:, None] * room)
        load = self.bettered(rows, unit, of)
        with np.errstate(invalid="ignore"):  # as shares, 0 for none and 1 without end, a half of the best: smooth everywhere
            shares = np.where(np.isinf(of), 1.0, of / (of + load))
        with_ends = np.concatenate([shares, 0.25 * COST * ends_of(unit[:, :, :k]).transpose(2, 0, 1)])
        at, share = best_of_parabolas(with_ends.transpose(0, 2, 1), len(of), s)
        each = parabolas(at)
        bases = each[:, 0]  # the weights of the values at -1, 0 and 1 of each spare stroke (n, 3**s)
        for other in each.swapaxes(0, 1)[1:]:
            bases = (bases[:, :, None] * other[:, None, :]).reshape(len(at), -1)
        guess = np.einsum("na,ank->nk", bases, unit)
        promised = np.where(share < 1.0, share / (1.0 - np.minimum(share, 0.999)), np.inf) * load
        begin = PlacePoses(place, np.where(np.isfinite(guess), guess, now))
        unit, of = self.moved(begin, order, (middle + at * room)[None])
        load = self.bettered(rows, unit, of)
        past = np.minimum(ends_of(unit[:, :, :k]).min(axis=2), 0.0)  # what a pose counts: the least load, less what that costs
        worth = np.nan_to_num((np.min(of, axis=0) + COST * load * past)[0], nan=-np.inf)
        kept = np.isfinite(share) & (worth - before >= KEPT * np.maximum(promised - before, 0.0))
        gone = np.abs(unit[0, :, k:] - now[:, k:]).max(axis=1) / own
        left = np.where(kept, np.clip(2.0 * gone, LESS, MORE), LITTLE)
        centre, worth = np.where(kept[:, None], unit[0], now), np.where(kept, worth, before)
        there = load > worth
        self.centre[rows], self.worth[rows] = np.where(there[:, None], self.unit[rows], centre), np.where(there, load, worth)
        done = np.isfinite(share) & (own < CLOSE) & (promised - load <= SAME * load)
        self.room[rows] = np.where(done, 0.0, np.minimum(own * left, ROOM))

    def bettered(self, rows: Index, unit: FloatArray, of: FloatArray) -> FloatArray:
        """Take those of some poses (m, n, k) that carry more inside all ends; return what is carried then (n,) [N]."""
        inside = ends_of(unit).min(axis=2) >= -EDGE
        load = np.where(inside, np.nan_to_num(np.min(of, axis=0), nan=-1.0, posinf=np.inf), -1.0)
        top, each = np.argmax(load, axis=0), np.arange(load.shape[1])
        more = load[top, each] > self.load[rows]
        self.unit[rows[more]], self.load[rows[more]] = np.clip(unit[top, each], 0.0, 1.0)[more], load[top, each][more]
        return self.load[rows]


def parabolas(x: FloatArray) -> FloatArray:
    """Return the parabolas that are 1 at -1, 0 or 1 and 0 at the others, at places (n, s), shape (n, s, 3)."""
    return np.stack([0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)], axis=2)


def ends_of(unit: FloatArray) -> FloatArray:
    """Return how far strokes (..., k) are inside the end that is nearer, in shares of their ranges."""
    return np.minimum(unit, 1.0 - unit)


def best_of_parabolas(values: FloatArray, loads: int, spare: int) -> tuple[FloatArray, FloatArray]:
    """Return where the least of the first `loads` parabolas is greatest, (n, s) from -1 to 1, and its value there (n,).

    `values` (r, n, 3**s) are theirs at -1, 0 and 1 of each spare stroke. The others count where they are below zero. -inf where some
    value is missing. Of two strokes the best of the second is looked for at each value of the first, as limits meet at a slant.
    """
    known: Mask = np.asarray(np.isfinite(values).all(axis=(0, 2)))
    values = np.where(known[:, None], values, 0.0).reshape(len(values), values.shape[1], *[3] * spare)
    at, worth = peak_of(values, loads)
    return at, np.where(known, worth, -np.inf)


def peak_of(values: FloatArray, loads: int) -> tuple[FloatArray, FloatArray]:
    """Return the same of values (r, n, 3) or (r, n, 3, 3) that are all known."""
    n, spare = values.shape[1], values.ndim - 2
    at, worth, rest, half, each = np.zeros(n), np.zeros(n), np.zeros((n, 0)), 1.0, np.arange(n)
    for _ in range(ZOOMS):
        x = np.clip(at[:, None] + half * GRID, -1.0, 1.0)
        bases = parabolas(x)
        if spare == 1:
            found = np.einsum("rna,nga->rng", values, bases)
            total = found[:loads].min(axis=0) + np.minimum(found[loads:].min(axis=0), 0.0)
        else:
            left = np.einsum("rnab,nga->rngb", values, bases).reshape(len(values), -1, 3)
            own, total = (part.reshape(n, len(GRID), -1) for part in peak_of(left, loads))
            total = total[:, :, 0]
        top = np.argmax(total, axis=1)
        at, worth, half = x[each, top], total[each, top], CLOSER * half
        rest = own[each, top] if spare == 2 else rest
    return np.concatenate([at[:, None], rest], axis=1), worth


# What is asked for.


def axis_values(given: object, name: str, title: str) -> FloatArray:
    """Return the places along an axis [m]; DefinitionError for anything but a row of numbers."""
    found = np.empty((0, 0))
    with suppress(TypeError, ValueError, OverflowError):
        found = np.atleast_1d(real(given))
    what = "it has no number" if found.ndim == 1 and not found.size else "numbers in a row [m] are expected"
    fits = found.ndim == 1 and found.size and np.isfinite(found).all()
    require(fits, f"{title}: {name}", given, f"{what}, such as {name}=np.linspace(1, 6, 14)")
    require(np.unique(found).size >= found.size, f"{title}: {name}", given, "a place stands in it twice; give each once")
    return frozen(found)


def names_among(given: object, what: str, known: Mapping[str, object], title: str, example: str) -> tuple[str, ...]:
    """Return names; DefinitionError for one that is unknown."""
    listed = require_type(f"{title}: {what}", given, (list, tuple, set, frozenset), f"a list of names is expected, {what}=[{example}]")
    return tuple(known_name("Load", name_of(each), known, where=f"{title}: {what}") for each in listed)


def ranges_over(machine: Mechanism, over: object, title: str) -> StrokeRanges:
    """Return the ends between which strokes run [m or rad]; DefinitionError for anything but a box of strokes."""
    if over is None:
        return DECLARED
    given = Over(**over) if isinstance(over, Mapping) and all(isinstance(name, str) for name in over) else over
    what, expected = f"{title}: over", "ranges of strokes are expected, such as over=Over(S=(0.0, 0.2))"
    found = require_type(what, given, Over, expected)
    require(found.shape == "box", what, found, expected)
    what, remedy = ("only=", 'limits={"front": x("T") <= 4}') if found.only else ("cases=", 'case="full"')
    ensure(not (found.only or found.cases), f"{title}: over={found}: {what} is not looked at here; give {remedy}.")
    found.check(machine.plan.title, machine.plan.strokes, ())
    strokes = Domain(machine.plan, machine.dimensions, found).motion.strokes
    return {name: (float(np.min(strokes[name])), float(np.max(strokes[name]))) for name in found.strokes}


def check_strokes(plan: Plan, hold: object, targets: Sequence[Target], title: str) -> None:
    """Raise DefinitionError where fewer strokes are left than a place and the kept values take."""
    free = [name for name in plan.strokes if not isinstance(hold, Mapping) or name not in hold]
    if len(free) < len(targets):
        kept = f" and {len(targets) - 2} kept value{'s' * (len(targets) > 3)}" if len(targets) > 2 else ""
        what = f"{title}: x, y{kept} take {len(targets)} strokes, and {', '.join(free) or 'none'} may move"
        remedy = "hold less, keep less" if len(free) < len(plan.strokes) or kept else "a field is of machines with two strokes and more"
        raise DefinitionError(f"{what}; {remedy}, or ask for the load along a stroke, circuit.capacity(motion, ...).")


FurtherLimit: TypeAlias = Callable[[Motion, LoadAt], FloatArray]
"""What returns the greatest load that a further limit leaves at the poses of a motion [N], shape (n,)."""


def further_limit(name: str, given: object, title: str) -> FurtherLimit:
    """Return a limit as it was given; DefinitionError for anything else."""
    if isinstance(given, PoseCondition):
        return partial(load_by_margin, given.margin)
    what = f"{title}: limits: {name} = {cited(given)} is below zero"
    ensure(not (is_number(given) and float(given) < 0.0), f"{what}; a load that may not be exceeded is expected [N].")
    if is_number(given) or isinstance(given, (str, Quantity)):
        most = quantity(given)
        return lambda motion, loads: np.broadcast_to(np.asarray(motion.value(most), float), motion.shape)
    example = f'limits={{"{name}": 20 * kN}} or limits={{"{name}": drive_force("phi") >= -120 * kN}}'
    raise DefinitionError(f"{title}: limits: {name} = {cited(given)}: a load or a comparison of a request is expected, {example}.")


def load_by_margin(margin: Any, motion: Motion, loads: LoadAt) -> FloatArray:
    """Return the greatest load with which a margin does not fall below zero at the poses of a motion [N], shape (n,)."""

    def under(acting: object) -> FloatArray:
        found = motion.value(margin) if isinstance(margin, Quantity) else motion[margin.under(acting, keep=True)]
        return np.broadcast_to(np.asarray(found, float), motion.shape)

    own = under(loads.own)
    share = (under(loads.with_load(PROBE, motion)) - own) / PROBE
    return greatest_load(own, share, np.zeros(()), np.asarray(np.inf))


# The search.


@immutable
class LoadsFound:
    """Poses that were found (n), and the load that each limiter leaves there, factors included (limiters, n)."""

    poses: PlacePoses
    loads: FloatArray

    @cached_property
    def load(self) -> FloatArray:
        """The load (n,)."""
        return np.asarray(np.min(self.loads, axis=0, initial=np.inf))

    def select(self, rows: Any) -> LoadsFound:
        """Return some of them."""
        return LoadsFound(self.poses.select(rows), self.loads[:, rows])

    def best(self) -> Index:
        """Return the row of each place at which most is carried, by place ascending; of equal ones that with the least first stroke."""
        order = np.lexsort((-self.poses.unit[:, 0], np.where(np.isnan(self.load), -1.0, self.load), self.poses.place))
        place = self.poses.place[order]
        return order[np.append(place[1:] != place[:-1], True)] if len(order) else order


class FieldSearch:
    """A field to look for: the places, the poses, the loads."""

    def __init__(
        self, machine: Mechanism, point: Reference, x_given: object, y_given: object, along: object, hold: object, over: object, keep: Any,
        lifts: Any, rule: LoadRule, case: Case, without: object, limits: Any,
    ) -> None:  # fmt: skip
        self._given = machine, point, x_given, y_given, along, hold, over, keep, lifts, rule, case, without, limits
        self.machine, self.rule, plan, title = machine, rule, machine.plan, f"{machine.plan.title}: working_field"
        name = known_name("Point", name_of(point), plan.points, where=title)
        ensure(name in plan.moving, f"{title}: {name} stands still, so that nothing is lifted there; name a point that moves.")
        self.point, self.x, self.y = name, axis_values(x_given, "x", title), axis_values(y_given, "y", title)
        self.ascending, across, up = (np.sort(self.x), np.sort(self.y)), self.x.size, self.y.size
        if across * up > MOST_CELLS:
            raise DefinitionError(f"{title}: {across} by {up} are {across * up} cells, up to {MOST_CELLS} are looked at; give fewer.")
        fits = is_listed(keep) and all(isinstance(each, Target) and not each.is_path for each in keep)
        require(fits, f"{title}: keep", keep, 'a list of targets is expected, such as keep=[Target("tilt", 0.0)]')
        targets = [Target(x_of(name), float(self.x[0])), Target(y_of(name), float(self.y[0])), *keep]
        ranges = ranges_over(machine, over, title)
        still = {name: low for name, (low, high) in ranges.items() if low == high}
        hold = {**still, **hold} if isinstance(hold, Mapping) else hold or still
        check_strokes(plan, hold, targets, title)
        way = pull_direction(along, f"{title}: ")
        direction_words(way)  # refuses arrays, which are of the poses of a motion
        self.many = many = ManyPlaces.for_targets(plan, machine.dimensions, targets, hold, where="working_field", ranges=ranges)
        elements = plan.of_kind(ForceElement)
        left = names_among(without, "without", elements, title, '"load"')
        lifting = None if lifts is None else frozenset(names_among(lifts, "lifts", elements, title, '"boom"'))
        self.loads = loads = LoadAt(plan, many.places.designs, name, way, case, left, lifting, rule.pressure)
        self.case = case_of(plan, case).label if case is not None else ""
        odd = [name_of(each) for each in lifts or () if name_of(each) not in loads.bounded]
        if odd:
            remedy = f"name cylinders that hold and have a circuit: {', '.join(loads.bounded) or 'there are none'}"
            raise DefinitionError(f"{title}: lifts: {odd[0]} has no pressure to lift with; {remedy}.")
        if limits is not None:
            require_type(f"{title}: limits", limits, Mapping, 'limits by name are expected, limits={"rated load": 20 * kN}')
        self.limits = further = {str(each): further_limit(str(each), value, title) for each, value in (limits or {}).items()}
        for each in further:
            if each in loads.kinds or each in (TIPPING, SLIPPING, CLEARANCE, OUT_OF_REACH, NOT_LIMITED):
                raise DefinitionError(f"{title}: limits: {each} is a limiter already; give this one another name.")
        if plan.of_kind(Planes) and pairs_of(plan):
            further[CLEARANCE] = partial(load_by_margin, clearance())
        if not loads.kinds and not further:
            what = f"{title}: nothing says what the machine carries: no cylinder has a circuit, nothing else has bounds"
            raise DefinitionError(f'{what}; declare one, LiftCircuit(lift, pressure=180 * bar), or give limits={{"rated load": 20 * kN}}.')
        self.rest = np.array([float(each.value) for each in keep])
        self.goals = self.goals_over(*self.ascending)

    def __reduce__(self) -> tuple[object, ...]:
        return FieldSearch, self._given

    # -- the places ----------------------------------------------------------------------------------------

    def goals_over(self, across: FloatArray, up: FloatArray) -> FloatArray:
        """Return the targets' values over places x by y (places, t), x running fastest."""
        rest = np.broadcast_to(self.rest, (across.size * up.size, self.rest.size))
        return np.concatenate([np.tile(across, up.size)[:, None], np.repeat(up, across.size)[:, None], rest], axis=1)

    def ordered(self, values: FloatArray) -> FloatArray:
        """Return values at the places in the order of the axes as they were given, shape (heights, radii)."""
        found = values.reshape(self.y.size, self.x.size)
        return found[np.argsort(np.argsort(self.y))][:, np.argsort(np.argsort(self.x))]

    # -- the poses -----------------------------------------------------------------------------------------

    @cached_property
    def turns(self) -> list[tuple[ManyPlaces, Index, list[FloatArray] | None]]:
        """The searches to make: the spare strokes at values over their ranges, and others at their ends in the place of them.

        Poses on which the strokes to spare run form curves, which end where another stroke does: with these no short one is missed.
        """
        many, count = self.many, len(self.many.places.free)
        found: list[tuple[ManyPlaces, Index, list[FloatArray] | None]] = [(many, np.arange(count), None)]
        for loose in combinations(range(count), many.spare) if many.spare else ():
            if loose != tuple(range(many.solved, count)):
                order = np.array([*(at for at in range(count) if at not in loose), *loose])
                free = tuple(many.places.free[at] for at in order)
                places = many.places.reordered(free)
                found.append((ManyPlaces(places, many.spare), order, [np.array([0.0, 1.0])] * many.spare))
        return found

    def poses(self, across: FloatArray, up: FloatArray, among: Mask | None = None) -> tuple[PlacePoses, Index]:
        """Return the poses that are found for places x by y, ascending, or those `among` them, and which of the `turns` gave each."""
        goals, outs = self.goals_over(across, up), np.zeros(len(self.many.places.free))
        found, solved = [], np.zeros(len(goals), bool)
        for many, order, ends in self.turns:
            start = many.looked_at(0.0, ends).starts(across, up, self.rest)
            start = start if among is None else start.select(among[start.place])
            at, met = many.settled(start, goals, outs, damped=not many.spare)
            solved[at.place[met]] = True
            if many.spare:
                again = ~met & ~solved[at.place]
                if again.any():
                    late, late_met = many.settled(start.select(again), goals, outs, damped="unsettled")
                    at, met = at.concatenated(late), np.concatenate([met, late_met])
                    solved[late.place[late_met]] = True
            unit = np.empty_like(at.unit[met])
            unit[:, order] = at.unit[met]
            found.append(PlacePoses(at.place[met], unit))
        return found[0].concatenated(*found[1:]), np.repeat(np.arange(len(found)), [len(each.place) for each in found])

    # -- the loads -----------------------------------------------------------------------------------------

    @cached_property
    def limiter_names(self) -> tuple[str, ...]:
        """The possible limits of the load: cylinders, "tipping", "slipping", further limits."""
        return (*dict.fromkeys(self.loads.kinds), *self.limits)

    def carried(self, poses: PlacePoses) -> LoadsFound:
        """Return the load that each limiter allows at poses, factors included; NaN where they are not reached."""
        rows = self.many.places.strokes_at(poses.unit)
        count = len(poses.place)
        kinds = self.loads.kinds
        found = self.loads.at(rows) if count else np.empty((len(kinds), 0))
        factors = dict.fromkeys(self.loads.bounded, self.rule.hydraulic) | {TIPPING: self.rule.tipping, SLIPPING: self.rule.slipping}
        parts = []
        for kind in dict.fromkeys(kinds):
            own = found[[place for place, each in enumerate(kinds) if each == kind]]
            parts.append(np.min(own, axis=0)[None] * factors.get(kind, 1.0))
        if self.limits and count:
            motion = self.loads.motion_over(rows)
            parts.append(np.array([each(motion, self.loads) for each in self.limits.values()]))
        return LoadsFound(poses, np.concatenate(parts) if count and parts else np.empty((len(self.limiter_names), 0)))

    def refined(self, found: LoadsFound, inner: int) -> LoadsFound:
        """Return the best pose of each place with its spare strokes moved to where most is carried.

        It begins at the best poses of the first look that stand apart from each other, and at the best of the first `inner` ones, on which
        no stroke stands at an end for the sake of the places.
        """
        own = found.select(slice(inner)).best()
        rows = np.unique(np.concatenate([own, self.apart(found, STARTS[self.many.spare])]))
        base, load = found.poses.select(rows), found.load[rows]
        for looks, room in LOOKS[self.many.spare]:
            base, load = self.climbed(base, load, looks, room * float(self.many.spare_step.max()))
            kept = LoadsFound(base, load[None]).best()
            base, load = base.select(kept), load[kept]
        return self.carried(base)

    def climbed(self, base: PlacePoses, load: FloatArray, looks: int, room: float) -> tuple[PlacePoses, FloatArray]:
        """Return poses whose spare strokes went to where more is carried, and their loads [N]."""
        _, slopes = self.many.seen(base.unit)
        size = np.array([np.abs(np.linalg.det(slopes[:, :, order[: many.solved]])) for many, order, _ in self.turns])
        usual = size[0] > USUAL[self.many.spare] * size.max(axis=0)  # the first turn's, but where its others are near a dead point
        order = np.array([each for _, each, _ in self.turns])[np.where(usual, 0, np.argmax(size, axis=0))]
        start = PlacePoses(base.place, np.take_along_axis(base.unit, order, axis=1))
        climb = Climb(self.moved, self.many.solved, start, order, load, room)
        for _ in range(looks):
            rows = np.flatnonzero((climb.room > LEAST) & (climb.load > 0.0) & np.isfinite(climb.load))
            if rows.size:
                climb.step(rows)
        unit = np.empty_like(base.unit)
        np.put_along_axis(unit, order, climb.unit, axis=1)
        return PlacePoses(base.place, unit), climb.load

    def apart(self, found: LoadsFound, count: int) -> Index:
        """Return up to `count` rows of each place, those at which most is carried, whose spare strokes stand apart from each other's."""
        left, chosen, k, s = np.arange(len(found.poses.place)), [], self.many.solved, self.many.spare
        spare, place, of_place = found.poses.unit[:, k:] / self.many.spare_step, found.poses.place, np.zeros(self.x.size * self.y.size, int)
        for _ in range(count):
            best = left[found.select(left).best()]
            chosen.append(best)
            of_place[place[best]] = best
            left = left[(np.abs(spare[left] - spare[of_place[place[left]]]) > NEXT[s]).any(axis=1)]
        return np.concatenate(chosen)

    def moved(self, base: PlacePoses, order: Index, to: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return poses (m, n, k) with the spare strokes at some values (m, n, s), a little past the others' ends too, and their loads.

        Strokes stand in the `order` of each (n, k). Loads of each limiter (limiters, m, n) [N]; NaN where the place is not met.
        """
        many, k, (n, width) = self.many, self.many.solved, base.unit.shape
        _, slopes = many.seen_in(base.unit, order)
        change = np.einsum("nts,mns->mnt", slopes[:, :, k:], to - base.unit[None, :, k:])
        along = solved_systems(np.tile(slopes[:, :, :k], (len(to), 1, 1)), change.reshape(-1, k))
        guess = np.tile(base.unit, (len(to), 1))
        guess[:, :k] -= np.where(np.isfinite(along), along, 0.0)
        guess[:, k:] = to.reshape(-1, width - k)
        start = PlacePoses(np.tile(base.place, len(to)), guess)
        every = np.tile(order, (len(to), 1))
        found, met = many.settled(start, self.goals, np.full(width, BEYOND), damped=False, iterations=FEW, order=every)
        of, unit = np.full((len(self.limiter_names), len(guess)), np.nan), np.empty_like(guess)
        np.put_along_axis(unit, every, found.unit, axis=1)
        of[:, met] = self.carried(PlacePoses(found.place[met], unit[met])).loads
        return found.unit.reshape(len(to), n, width), of.reshape(-1, len(to), n)

    def field(self) -> WorkingField:
        """Return the field."""
        poses, turn = self.poses(*self.ascending)
        found = self.carried(poses)
        if self.many.spare and len(poses.place):
            found = self.refined(found, int(np.sum(turn == 0)))
        best, whole = found.best(), np.zeros(0, bool)
        while len(best):  # a pose that the loads do not hang on altogether may not be assembled
            whole = self.many.places.is_assembled(found.poses.unit[best]) & ~np.isnan(found.load[best])
            if whole.all() or not len(found.poses.place):
                break
            kept = np.ones(len(found.poses.place), bool)
            kept[best[~whole]] = False
            found = found.select(kept)
            best = found.best()
        return self.gathered(found.select(best))

    def gathered(self, found: LoadsFound) -> WorkingField:
        """Return the field of one pose a place."""
        poses, of, load, count = found.poses, found.loads, found.load, self.x.size * self.y.size

        def full(values: FloatArray) -> FloatArray:
            spread = np.full(count, np.nan)
            spread[poses.place] = values
            return read_only(self.ordered(spread))

        names = np.array([*self.limiter_names, NOT_LIMITED, OUT_OF_REACH])
        which = np.full(count, len(names) - 1)
        which[poses.place] = np.where(np.isfinite(load), np.argmin(of, axis=0) if len(of) else 0, len(names) - 2)
        rows = self.many.places.strokes_at(poses.unit)
        strokes = {name: full(values) for name, values in rows.items()}
        failing = self.loads.failing(self.loads.motion_over(rows), np.where(np.isfinite(load), load, 0.0)) if len(load) else {}
        counts = {name: int(np.sum(each)) for name, each in failing.items() if np.any(each)}
        return WorkingField(
            self.machine, self.point, self.loads.along, self.x, self.y, full(load), names[self.ordered(which)], FrozenDict(strokes),
            FrozenDict({name: full(each) for name, each in zip(self.limiter_names, of, strict=True)}), self.rule, self.case,
            self.remarks(counts), FrozenDict(counts), self,
        )  # fmt: skip

    def remarks(self, failing: Mapping[str, int]) -> tuple[str, ...]:
        """Return the remarks for a reader of the chart: loads beside the load, fixed and spare strokes, failing conditions."""
        plan, left, places = self.machine.plan, self.loads.without, self.many.places
        staying = [each.name for name, each in plan.of_kind(Weight).items() if name not in left and name_of(each.point) == self.point]
        found = [said("{name} hangs at {point} beside the load", name=name, point=self.point) for name in staying]
        if left:
            found.append(said("without {names}", names=", ".join(left)))
        if places.held:
            words = ", ".join(f"{name} = {places.stroke_value(name, value)}" for name, value in places.held.items())
            found.append(said("held: {words}", words=words))
        ends = {name: [places.stroke_value(name, end) for end in places.ranges[name]] for name in places.free if name in places.ranges}
        if ends:
            words = ", ".join(f"{name} = {said('{low} to {high}', low=low, high=high)}" for name, (low, high) in ends.items())
            found.append(said("strokes run: {words}", words=words))
        if places.targets[2:]:
            kept = [f"{words_of(each.quantity)} = {show(float(each.value), each.shown_in(plan))}" for each in places.targets[2:]]
            found.append(said("kept: {words}", words=", ".join(kept)))
        if self.many.spare:
            found.append(said("{names} where most is carried", names=", ".join(places.free[self.many.solved :])))
        if self.rule.tipping < 1.0 and TIPPING not in self.limiter_names:
            found.append(said("tipping is not judged: the machine has no supports"))
        found += [said("{rule} fails in {n} of the cells", rule=heading_of(name), n=count) for name, count in failing.items()]
        return tuple(found)

    # -- what is out of reach ------------------------------------------------------------------------------

    def reasons(self, reached: Mask) -> NDArray[np.object_]:
        """Return why each cell is out of reach, "" for those that are not."""
        words = np.full(reached.size, "", object)
        lost = ~reached[np.argsort(self.y, kind="stable")][:, np.argsort(self.x, kind="stable")].ravel()  # by place ascending
        with unwarned(), np.errstate(all="ignore"):
            for place, text in self._beyond(lost).items():
                words[place] = text
        return read_only(self.ordered(words))

    def _beyond(self, lost: Mask) -> dict[int, str]:
        """Return why places (places,) are out of reach, by their number."""
        places, found = self.many.places, {}
        if not lost.any():
            return {}
        outs = np.where(places.turning, np.maximum(np.pi / places.span - 0.5, 0.0), 1.0)
        start = self.many.looked_at(outs).starts(*self.ascending, self.rest)
        start = start.select(lost[start.place])
        at, met = self.many.settled(start, self.goals, outs, damped=False)
        again = ~met & ~np.isin(at.place, at.place[met])
        if again.any():
            late, late_met = self.many.settled(start.select(again), self.goals, outs)
            at, met = at.concatenated(late), np.concatenate([met, late_met])
        at = at.select(met)
        out = np.maximum(np.maximum(-at.unit, at.unit - 1.0), 0.0)
        whole = places.is_assembled(at.unit) if len(at.place) else np.zeros(0, bool)
        at, out = at.select(whole), out[whole]
        order = np.lexsort((out.max(axis=1), at.place))
        first = order[np.append(True, np.diff(at.place[order]) != 0)] if len(order) else order
        for row in first.tolist():
            strokes = places.low + at.unit[row] * places.span
            beyond = out[row] > EDGE
            if beyond.any():
                found[int(at.place[row])] = places.past_words(strokes, beyond)
        left = [place for place in np.flatnonzero(lost).tolist() if place not in found]
        return found | self._away(left)

    def _away(self, left: Sequence[int]) -> dict[int, str]:
        """Return how far off the nearest pose is of places that no strokes reach."""
        if not left:
            return {}
        places, wanted = self.many.places, self.goals[left]
        look = self.many.looked_at()
        values = look.values.T
        known = np.flatnonzero(np.isfinite(values).all(axis=1))
        if not known.size:
            return {place: said("no pose that was looked at can be assembled") for place in left}
        every = np.tile(values[known], (len(left), 1))
        apart = places.off(every, np.repeat(wanted, known.size, axis=0))
        size = np.sum((apart / places.tolerances) ** 2, axis=1).reshape(len(left), known.size)
        begin = look.unit[known[np.argmin(size, axis=1)]]

        def misses(unit: FloatArray, at: Index) -> FloatArray:
            return places.off(self.many.seen(unit)[0], wanted[at]) / places.tolerances

        def slopes(unit: FloatArray, _: Index) -> FloatArray:
            return self.many.seen(unit)[1] / places.tolerances[:, None]

        _, off = descended(misses, slopes, begin, 40)
        off = off * places.tolerances
        far = np.hypot(off[:, 0], off[:, 1])
        words = [said("the nearest pose is {far} away", far=show(each, "mm", 4)) for each in far.tolist()]
        return dict(zip(left, words, strict=True))

    # -- all that is reached -------------------------------------------------------------------------------

    @cached_property
    def reach(self) -> Reach:
        """All that the point reaches."""
        with unwarned(), np.errstate(all="ignore"):
            return Reach([(many, order) for many, order, _ in self.turns], self.rest, self.poses)

    def area(self) -> float:
        """Return the area of all that is reached [m2]; where each place is reached on one branch exactly, by the slopes."""
        with unwarned(), np.errstate(all="ignore"):
            if not self.many.spare and self.many.solved == 2 and self.reach.is_single:
                nodes, weights = np.polynomial.legendre.leggauss(GAUSS)
                unit = np.stack([each.ravel() for each in np.meshgrid(0.5 + 0.5 * nodes, 0.5 + 0.5 * nodes, indexing="ij")], axis=1)
                _, slopes = self.many.seen(unit)
                size = np.linalg.det(slopes)
                if np.isfinite(size).all() and (np.all(size > 0.0) or np.all(size < 0.0)):
                    return float(np.abs(size @ np.outer(weights, weights).ravel()) * 0.25)
        return self.reach.area


GAUSS = 48
"""Values of each stroke by which an area is integrated."""
