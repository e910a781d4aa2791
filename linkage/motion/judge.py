"""The judge: questions about a machine, asked over all that it runs, in every load case and movement that occurs, on both sides.

A question is split into smooth pieces: a quantity in one load case, in one movement, on one side of a cylinder. Each piece is looked for by
itself over every `Over`; the worst one is the answer and is named. A missing value has one of three meanings. It is lost where the machine
cannot be assembled or a law gives no number, unlimited where a law has no bound, outside where a condition leaves it out.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from contextlib import suppress
from copy import copy
from dataclasses import dataclass, field, replace
from functools import cached_property, partial, reduce
from itertools import product
from typing import Any, TypeAlias, TypeVar, cast

import numpy as np

from ..errors import DefinitionError, cited, ensure, errors_of, heard, is_listed, known_name, require_type, unwarned, warn
from ..frozen import immutable, record
from ..language import current_language, said
from ..loads import AS_IT_RUNS, FRICTIONLESS, PLAIN, PLAIN_CASE, Acting, ForceElement, LoadCase, case_titles
from ..numeric.box import values_a_stroke
from ..numeric.line import SAMPLES, highest
from ..numeric.quadrature import quadrature
from ..plan import Mask, Plan, rate_name
from ..program import FloatArray, Kernel
from ..quantities import PoseCondition, Quantity, is_whole, keywords
from ..quantities.quantity import stands_for
from ..units import current_system
from ..vectors import Numbers
from .answer import LOST, LOST_SHARE, NONE_LOST, NOTHING_LEFT, OF_VALUE, PER_DESIGN, UNBOUNDED, Answer, LostPlaces, PerDesign
from .evaluation import Evaluation
from .functions import evaluate_bound
from .grid import Grid, JoinedTo, recalled
from .instants import Instants
from .limits import LoopMargin, stroke_measure, stroke_unit
from .measures import (
    At,
    CombinedMeasure,
    Condition,
    Constraint,
    Integral,
    Leaf,
    Least,
    Measure,
    Most,
    Reachable,
    Worst,
    check_condition,
    check_kinds,
    conditions_of,
    in_situation,
    is_quantity,
    kind_of_quantity,
    reachable,
    strokes_behind,
    traced,
    words_of,
)
from .motion import Motion
from .over import ALLOWED, Over, Run, with_strokes
from .requests import Request, SmoothPiece, Trait, identity_of, is_of_force, measured_in, situated, stroke_of
from .search import Span, assembly_error_at, below_zero, extremum_reached, least_margins, legs_of, strokes_moved
from .strokes import at_values, strokes_over_axes

Question: TypeAlias = "Measure | Condition"
Made = TypeVar("Made")

INNER = 129
"""Values of the stroke over which `worst` is taken, between which it is looked for."""
COARSE = 5
"""Values of each stroke of a coarse grid."""
MET = 1e-9
"""Of the size of its two sides: a condition that is missed by no more is kept, to rounding."""
TIE = 1e-9
"""Of their size: situations that are as bad to this share are a tie."""


# Situations: which load cases and movements occur.


@record
class Situation:
    """A load case and a movement that occur: the case's name, the direction, and the stroke that moves; "" for none."""

    case: str = ""
    direction: str = ""
    drive: str = ""

    @cached_property
    def acting(self) -> Acting:
        """It as requests take it."""
        case = None if self.case in ("", PLAIN_CASE) else self.case
        return Acting(case=case, direction=self.direction or None, drive=self.drive or None)


@immutable
class SearchRow:
    """A piece of a leaf in a situation, as something to look for: `sense` is 1.0 where its greatest value is the worst."""

    leaf: Leaf
    piece: SmoothPiece
    situation: Situation
    sense: float

    @classmethod
    def alone(cls, leaf: Leaf) -> SearchRow:
        """Return the row of a leaf as it stands, whole and in no situation but its own."""
        return cls(leaf, SmoothPiece(leaf.sought), Situation(), leaf.sense)

    @property
    def is_reciprocal(self) -> bool:
        """Whether one over it is looked for."""
        return self.piece.reciprocal is not None and self.leaf.sense < 0.0

    @property
    def request(self) -> Any:
        """The request to search."""
        return self.piece.reciprocal if self.is_reciprocal else self.piece.below if self.stays_at_zero else self.piece.request

    @property
    def stays_at_zero(self) -> bool:
        """Whether the searched request continues below zero, where the request itself does not."""
        return self.piece.below is not None and self.leaf.sense > 0.0

    @property
    def search_sign(self) -> float:
        """1.0 where the greatest value of the searched request is the worst, else -1.0."""
        return 1.0 if self.is_reciprocal else self.sense


@immutable
class Candidate:
    """The worst of rows that occur at once over one `Over`: a value and where, arrays over the designs; shares of the places asked for.

    A row by itself has no margin. A question has one, below zero where it is not kept.
    """

    rows: tuple[SearchRow, ...]
    value: FloatArray
    strokes: Mapping[str, FloatArray]
    unbounded: Mask
    lawless: PerDesign = 0.0
    unlimited: PerDesign = 0.0
    time: PerDesign = np.nan
    leg: PerDesign = -1
    margin: PerDesign = np.nan
    limit: PerDesign = np.nan
    undefined: PerDesign = False
    """Whether its measures have values and what is calculated from these has none, such as 0 / 0 or the root of what is negative."""
    seen: Coverage | None = None
    """What was seen over its `Over`; None where it is only about poses that the question itself says."""
    design: tuple[int, ...] = ()
    constraint: object = None
    """The constraint, or the bare measure, that it answers; None of a row by itself."""

    @cached_property
    def situation(self) -> Situation:
        """The situation in which its rows occur."""
        return situation_found(self.rows)

    @property
    def side(self) -> str:
        """The side of the cylinder that it belongs to, "" for none."""
        return next((each.piece.side for each in self.rows if each.piece.side), "")

    @property
    def used(self) -> float:
        """How far its limit is used, 1.0 where it is met exactly; of a limit 0 zero where it is kept, else infinite, as without a bound."""
        value, limit, symbol = float(self.value), float(self.limit), getattr(self.constraint, "symbol", "")
        if limit == 0.0 or symbol not in ("<=", ">="):
            return np.inf if self.margin < 0.0 else 0.0
        if (symbol == "<=") == (limit > 0.0):
            return max(value / limit, 0.0)
        return limit / value if value * limit > 0.0 else np.inf

    def is_worse(self, other: Candidate, are_alike: bool) -> bool:
        """Return whether it counts before another one: by its margin where both are of one kind, else by how far its own limit is used."""
        if are_alike or self.constraint is other.constraint:
            return bool(self.margin < other.margin)
        return self.used > other.used * (1.0 + TIE)

    def of_design(self, place: tuple[int, ...], shape: tuple[int, ...]) -> Candidate:
        """Return that of one design of a batch of some shape, by its place in it."""
        if not shape:  # it is the only one
            return self
        own = {
            name: np.broadcast_to(getattr(self, name), shape)[place]
            for name in ("value", "margin", "limit", "unbounded", "lawless", "unlimited", "time", "leg", "undefined")
        }
        strokes = {name: np.broadcast_to(value, shape)[place] for name, value in self.strokes.items()}
        return replace(self, strokes=strokes, design=place, **own)


class Domain:
    """One `Over` of some designs: the motion that covers it, and its lost places."""

    def __init__(self, plan: Plan, designs: Mapping[str, Numbers], over: Over | Motion) -> None:
        given = over if isinstance(over, Motion) else None
        self.over = (over if isinstance(over, Over) else over.over).among(plan.members)
        self.plan, self.designs = plan, designs
        self.program: tuple[Request, ...] = ()
        """What the largest search asked in one program, by which others ask some of it."""
        for condition in self.over.only:
            check_condition(plan, condition)
        with unwarned():
            own = given is not None and given._grid.per_design
            poses = None if given is None or given.is_swept else given.strokes
            self.instants = self.over.instants(plan, self.number) if poses is None else None
            strokes = self.over.places(plan, self.number) if poses is None else with_strokes(poses)
            self.motion = Motion(plan, designs, strokes, "nan", per_design=own, over=self.over, instants=self.instants)

    def number(self, quantity: str | Quantity) -> float:
        """Return the value of a design variable by its name, or of a quantity of the design [SI]; DefinitionError where designs differ."""
        if isinstance(quantity, str):
            owner, sign = self.plan.table.spellings[quantity]
            found = sign * np.asarray(self.designs[owner], float)
        else:
            start = {name: np.asarray(value, float) for name, value in self.plan.sketch_strokes.items()}
            found = Motion(self.plan, self.designs, start, "nan").value(quantity)
        if np.unique(found).size != 1 or not np.all(np.isfinite(found)):
            what = f"{self.plan.title}: {self.over}: {words_of(quantity)} = {cited(found)}"
            raise DefinitionError(f"{what}; one finite number is expected, the same for all designs: take one design, or give over=.")
        return float(np.ravel(found)[0])

    @cached_property
    def running(self) -> tuple[str, ...]:
        """The strokes that run."""
        return strokes_moved(self.motion if self.instants is None else self.sampled)

    @cached_property
    def sampled(self) -> Motion:
        """Some poses over it, NaN out of reach: 101 along one stroke or a path, a grid of 21 or 7 values a stroke of several."""
        if self.instants is not None:
            return self.timed(self.instants.shares(np.linspace(0.0, 1.0, 101)), "nan")
        if self.over.shape == "poses" or not self.running:
            return self.motion
        ends = {name: np.ravel(value) for name, value in self.motion.strokes.items()}
        with unwarned():
            if self.moves_along:
                marks = np.linspace(0.0, 1.0, len(next(iter(ends.values()))))
                along = np.linspace(0.0, 1.0, 101)
                return self.motion.moved({name: np.interp(along, marks, value) for name, value in ends.items()})
            count = {1: 101, 2: 21}.get(len(self.running), 7)
            values = strokes_over_axes({name: np.linspace(ends[name].min(), ends[name].max(), count) for name in self.running})
            return self.motion.moved({name: values.get(name, value[0]) for name, value in ends.items()})

    def swept(self, count: int | None, unreachable: str) -> Motion:
        """Return the motion over it, which keeps the `Over`: at so many equal shares of the way (101), or at its poses alone.

        Over a path in time the instants are equally far apart.

        DefinitionError where it is a box in which several strokes run: that is no one way.
        """
        title, shape = f"{self.plan.title}: sweep(over={self.over.name or self.over})", self.over.shape
        strokes, tangent = {name: np.ravel(value) for name, value in self.motion.strokes.items()}, None
        what = f"{title}: it has {self.motion.reached.size} poses and nothing between them; leave out the count."
        ensure(shape != "poses" or count is None, what)
        number = 101 if count is None else count
        is_count = shape == "poses" or (is_whole(number) and number >= 2)
        ensure(is_count, f"{title}: {cited(count)}: a whole number of poses is expected, 2 at least.")
        if self.instants is not None:
            return self.timed(self.instants.shares(np.linspace(0.0, 1.0, number)), unreachable)
        if shape != "poses":
            if len(self.running) != 1 and not self.moves_along:
                ways = keywords(dict.fromkeys(self.running or self.plan.strokes, 11))
                what = f"{title}: {len(self.running)} strokes run in this box"
                raise DefinitionError(f"{what}; write sweep({ways}), or sweep over an Over.path.")
            held = {name: float(value[0]) for name, value in strokes.items()}
            run = Run({name: tuple(strokes[name].tolist()) for name in self.running}, held)
            moved, going = run.strokes_and_slopes(np.linspace(0.0, 1.0, number))
            strokes = {name: np.broadcast_to(moved[name], (number,)) for name in strokes}
            tangent = None if shape == "box" else {name: going.get(name, np.zeros(number)) for name in strokes}
        return Motion(self.plan, self.designs, strokes, unreachable, tangent=tangent, over=self.over)

    def timed(self, instants: Instants, unreachable: str) -> Motion:
        """Return the motion over a path in time at some instants, which it keeps."""
        return Motion(self.plan, self.designs, instants.strokes, unreachable, over=self.over, instants=instants)

    def as_it_runs(self, quantity: Any) -> Any:
        """Return a quantity as a program takes it: over a path in time, forces at rates and accelerations that are inputs.

        None where it says itself how it moves, so that it has no program there.
        """
        if self.instants is None or not is_of_force(quantity):
            return quantity
        is_smooth = self.instants.rate_jump is None
        accelerations, inertia = (AS_IT_RUNS, None) if is_smooth else (None, False)
        for direction in (AS_IT_RUNS, FRICTIONLESS):
            with suppress(DefinitionError):
                return quantity.under(Acting(None, None, direction, AS_IT_RUNS, None, accelerations, inertia))
        return None

    @property
    def moves_along(self) -> bool:
        """Whether it is a path, along which several strokes go on together; one that stays where it is moves nothing."""
        if self.instants is not None:
            return True
        return self.over.shape == "path" and len(self.motion.strokes) > 1 and bool(self.running)

    @property
    def width(self) -> dict[str, float]:
        """How broad a place is at the least that is surely found, of each stroke that runs; none where only poses are looked at."""
        if self.over.shape == "poses":
            return {}
        count = 1 if self.moves_along else len(self.running)
        steps = SAMPLES if count < 2 else values_a_stroke(count, self.motion._grid.size[0]) - 1
        return dict.fromkeys(self.running, 1.0 / steps)

    def situations(self, request: object, acting: Acting) -> list[Situation]:
        """Return the load cases and movements in which a request is judged here; one empty situation unless it is of force."""
        if not isinstance(request, Request):
            return [Situation()]
        movements = request.movements(self.plan, rubs(self.plan, self.motion, acting))
        if not movements and not is_of_force(request):
            return [Situation()]
        directions = [acting.direction] if acting.direction is not None else [*movements] or [""]
        if self.instants is not None and acting.direction is None:  # as it runs
            directions = [""]
        drives: list[str] = [""]
        if Trait.OF_STROKES in request.traits and not self.moves_along:
            drives = [acting.drive] if acting.drive else [*(self.running or self.plan.strokes)]
        cases = self.cases(acting)
        return [
            Situation(case, direction, drive)
            for case in [each for each in cases if request.occurs_in(self.plan, each)] or cases for direction in directions
            for drive in (drives if Acting(direction=direction or None).is_moving else [""])
        ]  # fmt: skip

    def cases(self, acting: Acting) -> list[str]:
        """Return the load cases that are looked at, by name: the one asked for, else those that occur here."""
        declared = self.plan.of_kind(LoadCase)
        occurring = self.over.cases if self.over.cases is not None else (PLAIN_CASE, *declared)
        if acting.case is None:
            return [*occurring]
        if isinstance(acting.case, LoadCase) and not any(each is acting.case for each in declared.values()):
            return [PLAIN_CASE]  # one that is not of the class acts by itself
        name = case_named(self.plan, acting.case)
        what = f"{self.plan.title}: the load case {name} does not occur over {self.over.name or cited(self.over)}"
        ensure(name in occurring, f"{what}, where there are {', '.join(occurring)}.")
        return [name]

    def extremes(self, rows: Sequence[SearchRow]) -> tuple[list[Candidate], Coverage]:
        """Return the worst of every row, and the coverage of the search; equal designs are searched once."""
        searched = ["nothing" if row.request is zeros_over else identity_of(self.plan, row.request) for row in rows]
        if self.over.only or None in searched:  # as of a function, which may change
            return self.searched(rows)
        looked_for = [(each, row.sense, row.is_reciprocal, row.stays_at_zero) for each, row in zip(searched, rows, strict=True)]
        found, seen = recalled(self.motion, ("extremes", self.over.shape, *looked_for), lambda: self.searched(rows))
        return [replace(each, rows=(row,)) for each, row in zip(found, rows, strict=True)], replace(seen)

    def searched(self, rows: Sequence[SearchRow]) -> tuple[list[Candidate], Coverage]:
        """Return the same, looked for."""
        asked, shape = RowFunction(self, rows), (len(rows), *self.motion._design_shape)
        self.program = max(self.program, asked.program, key=len)
        time, leg = np.full(shape, np.nan), np.full(shape, -1)
        if self.over.shape == "poses" or not self.motion.strokes:  # nothing between the poses
            with np.errstate(all="ignore"):
                flat = asked(self.motion).reshape(*shape, -1)
            place = np.argmax(np.where(np.isnan(flat), -np.inf, flat), axis=-1)[..., None]
            value = np.take_along_axis(flat, place, axis=-1)[..., 0]
            unbounded = np.isposinf(value)
            every = {name: np.broadcast_to(np.ravel(each), flat.shape) for name, each in self.motion.strokes.items()}
            strokes = {name: np.take_along_axis(each, place, axis=-1)[..., 0] for name, each in every.items()}
        else:
            found, near = heard(lambda: extremum_reached(self.motion, asked, 1.0))
            if near:  # only that with the largest expected error, NaN last
                warn(max(near, key=lambda each: (each.estimate == each.estimate, each.estimate)))
            value, unbounded = (np.broadcast_to(np.asarray(each), shape) for each in (found.value, found.unbounded))
            strokes = {name: np.broadcast_to(np.asarray(each), shape) for name, each in found.strokes.items()}
            time, leg = (np.broadcast_to(np.asarray(each), shape) for each in (found.time, found.leg))
        lawless, unlimited = (np.broadcast_to(each, shape) for each in (asked.seen.lawless, asked.seen.unlimited))
        pieces = list[Candidate]()
        for k, row in enumerate(rows):
            where, worst = {name: each[k] for name, each in strokes.items()}, row.sense * value[k]
            if row.is_reciprocal:  # NaN where it has no bound anywhere
                with np.errstate(all="ignore"):
                    worst = np.where(value[k] > 0.0, 1.0 / value[k], np.nan)
            elif row.stays_at_zero:
                worst = np.maximum(value[k], 0.0)
            if isinstance(row.request, Worst):
                found_there = {name: np.asarray(value) for name, value in where.items()}
                there = Motion(self.plan, self.motion.designs, found_there, "nan", per_design=True)
                where[row.request.over] = self.nested(there, row.request)[1]
            pieces.append(Candidate((row,), np.asarray(worst), where, unbounded[k], lawless[k], unlimited[k], time[k], leg[k]))
        return pieces, asked.seen

    def nested(self, motion: Motion, worst: Worst) -> tuple[FloatArray, FloatArray]:
        """Return the worst of a quantity over a further stroke at every pose, and where that stroke then stands [SI], shape (...).

        It is looked for over what the stroke runs here, as far as that is asked for: between its values too, about the highest tops. Where
        the stroke runs along with others, a pose has no worst if the machine is lost on the way.
        """
        name, ran, ways = worst.over, (self.motion if self.instants is None else self.sampled).strokes, motion._tangent or {}
        own, known, lead = np.unique(ran[name]), list[Motion](), motion._design_shape if motion._grid.per_design else ()
        given = motion.strokes | {rate_name(each): value for each, value in ways.items()}
        flat = {each: np.reshape(value, (*lead, -1)) for each, value in given.items()}
        back = np.arange(flat[name].shape[-1])
        if not lead:  # poses that differ in this stroke alone are one
            others = [value for each, value in flat.items() if each != name]
            _, first, back = np.unique(others or np.zeros((1, back.size)), axis=1, return_index=True, return_inverse=True)
            flat = {each: value[first] for each, value in flat.items()}
        shape = (*motion._design_shape, flat[name].shape[-1])

        def seen(along: FloatArray, joining: JoinedTo | None = None) -> FloatArray:
            spread = {each: np.broadcast_to(value[..., None], along.shape) for each, value in flat.items()} | {name: along}
            strokes, tangent = {each: spread[each] for each in motion.strokes}, {each: spread[rate_name(each)] for each in ways} or None
            inner = Motion(self.plan, motion.designs, strokes, "nan", per_design=True, joining=joining, tangent=tangent)
            known[:] = known or [inner]
            lost = ~known[0].reached & self.over.condition_mask(known[0]) & (self.over.shape != "box")
            asked = inner.reached & self.over.condition_mask(inner) & ~lost.any(axis=-1, keepdims=True)
            return np.where(asked, worst.sense * values_over(inner, worst.quantity), np.nan)

        def look(_: Any, t: FloatArray) -> tuple[FloatArray, Mask]:
            t = np.broadcast_to(t, (int(np.prod(shape)), t.shape[-1])).reshape(*shape, -1)
            near = np.arange(shape[-1])[:, None] * INNER + np.rint(t * (INNER - 1)).astype(int)
            found = seen(own[0] * (1.0 - t) + own[-1] * t, JoinedTo(known[0]._grid, near) if known else None).reshape(1, -1, t.shape[-1])
            return found, ~np.isnan(found[0])

        if self.over.shape == "poses" or own.size == 1:
            values = np.where(np.isnan(found := seen(np.broadcast_to(own, (*shape, own.size)))), -np.inf, found)
            value, place = values.max(axis=-1), own[np.argmax(values, axis=-1)]
        else:
            best = highest(look, (INNER - 1,))
            value, place = (each.reshape(shape) for each in (best.value, own[0] + np.ptp(own) * best.t))
        value = np.where(np.isneginf(value), np.nan, worst.sense * value)
        return value[..., np.ravel(back)].reshape(motion.shape), place[..., np.ravel(back)].reshape(motion.shape)

    # -- what is lost ------------------------------------------------------------------------------------

    @cached_property
    def margins(self) -> list[LoopMargin]:
        """How clear each loop stays of its dead point wherever it is looked at; nothing where that is at poses only."""
        if self.over.shape == "poses" or not self.motion.strokes:
            return []
        with unwarned():
            return least_margins(self.motion, self.over.condition_mask if self.over.only else None)

    def lost_places(self, seen: Coverage) -> LostPlaces:
        """Return the lost places of one design: those on the grid, and holes between its places."""

        def of_design(value: PerDesign) -> float:
            return float(np.asarray(value)[seen.design])

        holes = [
            ({name: of_design(value) for name, value in each.strokes.items()}, of_design(each.time))
            for each in self.margins if np.asarray(each.is_hole)[seen.design]
        ]  # fmt: skip
        if not (seen.lost_share or holes):
            return NONE_LOST
        deepest, time = (seen.deepest, seen.time) if seen.deepest or not holes else holes[0]
        if self.motion._design_shape:
            refused = "" if seen.lost_share else said("some poses are refused")
            return LostPlaces(seen.lost_share, deepest, refused, not self.plan.groups, time)
        with unwarned():
            places = holes + ([(dict(seen.deepest), float(seen.time))] if seen.deepest and seen.lost_share else [])
            errors = [(assembly_error_at(self.motion, *place), *place) for place in places]
        known = [(error, place, time) for error, place, time in errors if error is not None]
        if not known:
            return LostPlaces(seen.lost_share, deepest, said("some poses are refused"), not self.plan.groups, time)
        error, place, time = max(known, key=lambda each: each[0].shortfall or 0.0)
        strokes = {name: float(value) for name, value in place.items()}
        return LostPlaces(seen.lost_share, strokes, " ".join(str(error).split()), not self.plan.groups, time)


def rubs(plan: Plan, motion: Motion, acting: Acting) -> bool:
    """Return whether the loads have friction, or act otherwise in motion than at rest."""
    given = acting.loads if is_listed(acting.loads) else [acting.loads]
    listed = plan.of_kind(ForceElement).values() if acting.loads is None else given
    elements = [plan.members.get(each) if isinstance(each, str) else each for each in listed]
    own = [each for each in elements if isinstance(each, ForceElement)]
    with unwarned():
        return any(each.feeds(plan.members) or each.frictions(motion) for each in own) or acting.rates is not None


def follows_time(plan: Plan, quantity: object) -> bool:
    """Return whether a quantity follows how fast the strokes move over a path in time."""
    bound, rates = traced(plan, quantity), {rate_name(name, order) for name in plan.strokes for order in (1, 2)}
    return is_of_force(quantity) or (bound is not None and not rates.isdisjoint(Kernel([*bound.nodes(plan)]).plan.input_names[1]))


def case_named(plan: Plan, case: object) -> str:
    """Return the name of a load case of the class, by its name, its title or itself; DefinitionError for any other."""
    cases = plan.of_kind(LoadCase)
    for name, each in cases.items():
        if each is case or (isinstance(case, str) and case in (name, each.title)):
            return name
    return known_name("Load case", case, (PLAIN_CASE, *cases), where=plan.title)


# Rows as one function of a motion.


@dataclass(eq=False)
class Coverage:
    """Counts on the first grid: shares of its places that are lost or outside, and of each row without a value, or without a bound.

    Shares are arrays over the designs, of rows (rows, ...).
    """

    lost_share: PerDesign = 0.0
    outside: PerDesign = 0.0
    deepest: Mapping[str, PerDesign] = field(default_factory=dict)
    time: PerDesign = np.nan
    """When the deepest is [s], over a path in time."""
    lawless: PerDesign = 0.0
    unlimited: PerDesign = 0.0
    count: int = 0
    design: tuple[int, ...] = ()

    def of_design(self, design: tuple[int, ...]) -> Coverage:
        """Return the coverage of one design, by its place in a batch."""
        deepest = {name: float(value[design]) for name, value in self.deepest.items()}
        lost, outside = (float(np.asarray(each)[design]) for each in (self.lost_share, self.outside))
        time = float(np.broadcast_to(self.time, np.shape(self.lost_share))[design])
        return replace(self, lost_share=lost, outside=outside, deepest=deepest if lost else {}, time=time, design=design)


class RowFunction:
    """Rows as one function of a motion: each times its sense, shape (rows, ...); NaN where a place is not asked for or has no value."""

    def __init__(self, place: Domain, rows: Sequence[SearchRow]) -> None:
        self.place, self.rows, self.seen = place, rows, Coverage()
        self.plan = place.plan
        self._rows: dict[int, RowFunction] = {}
        bound = {k: traced(self.plan, place.as_it_runs(row.request)) for k, row in enumerate(rows)}
        self._bound = {k: each for k, each in bound.items() if each is not None}
        places = {each.key: number for number, each in enumerate(place.program)}
        is_known = all(each.key in places for each in self._bound.values())
        self.program = place.program if is_known else tuple(self._bound.values())
        self._among = tuple(places[each.key] for each in self._bound.values()) if is_known else None

    def asks_for(self, motion: Motion) -> Mask:
        """Return the mask of poses that are asked for."""
        return self.place.over.condition_mask(motion)

    def row(self, function: int) -> RowFunction:
        """Return one row as a function of its own; its looks are counted with the others."""
        if function not in self._rows:
            self._rows[function] = RowFunction(self.place, [self.rows[function]])
            self._rows[function].seen = self.seen
        return self._rows[function]

    def __call__(self, motion: Motion) -> FloatArray:
        kept = self.asks_for(motion)
        values, unlimited = self.row_values(motion)
        if not self.seen.count:
            self.cover(motion, kept, values, unlimited)
        self.seen.count += motion.reached.size
        for k, row in enumerate(self.rows):
            values[k] *= row.search_sign
        values[:, ~kept] = np.nan
        return values

    def row_values(self, motion: Motion) -> tuple[FloatArray, Mask]:
        """Return the rows' values over a motion, and where they have no bound: one kernel for rows with a program, others alone."""
        values, unlimited = np.full((len(self.rows), *motion.shape), np.nan), np.zeros((len(self.rows), *motion.shape), bool)
        grid, reached = motion._grid, motion.reached
        if self._bound and grid.per_design and not motion._design_shape and reached.any() and not reached.all():
            # one that is reached stands for those out of reach, whose repair costs most and tells nothing; angles are those of known poses
            first = np.unravel_index(int(np.argmax(reached)), motion.shape)
            strokes = {name: np.where(reached, value, value[first]) for name, value in grid.strokes.items()}
            grid = Grid(self.plan, motion.designs, strokes, per_design=True, joining=grid.joining, rate_inputs=grid.rate_inputs)
        with unwarned(), np.errstate(all="ignore"):
            if self._bound:
                found = evaluate_bound(Evaluation(grid, self.program, among=self._among), None, "nan")
                for k, number in zip(self._bound, self._among or range(len(found)), strict=True):
                    values[k] = found[number]
            alone = dict[Hashable, FloatArray]()
            for k, row in enumerate(self.rows):
                if k not in self._bound:
                    key = key_of(self.plan, row.request)
                    if key not in alone:
                        is_nested = isinstance(row.request, Worst)
                        alone[key] = self.place.nested(motion, row.request)[0] if is_nested else values_over(motion, row.request)
                    values[k] = alone[key]
                if row.is_reciprocal:
                    unlimited[k] = values[k] <= 0.0
                if (np.isnan(values[k]) & motion.reached).any():
                    unlimited[k] |= self.without_bound(k, motion) & np.isnan(values[k])
        values[:, ~motion.reached] = np.nan
        return values, unlimited & motion.reached

    def without_bound(self, k: int, motion: Motion) -> Mask:
        """Return where the law of a row has no bound: by its program, else as the request says."""
        request, mask = self.rows[k].request, None
        if k in self._bound:
            kernel = self.plan.made_beside(("gaps", self._bound[k].key), lambda twin: gaps_kernel(twin, self._bound[k]))
            if kernel.plan.outputs:
                mask = (motion._grid.kernel_values(kernel) <= 0.0).any(axis=0)
        elif isinstance(request, Request):
            mask = request.unlimited(motion)
        return np.zeros(motion.shape, bool) if mask is None else np.asarray(np.broadcast_to(mask, motion.shape))

    def cover(self, motion: Motion, kept: Mask, values: FloatArray, unlimited: Mask) -> None:
        """Note the shares of the places that have no value, and one of those that cannot be assembled."""
        asked = kept | ~motion.reached if not self.place.over.only else kept
        lost, good = asked & ~motion.reached, kept & motion.reached
        designs, axes = motion._design_shape, len(motion.shape) - len(motion._design_shape)

        def counted(mask: Mask) -> Any:
            return mask.reshape(*mask.shape[: mask.ndim - axes], -1).sum(axis=-1)

        total, count = max(1, int(np.prod(motion.shape[len(designs) :]))), np.maximum(1, counted(good))
        self.seen.lost_share, self.seen.outside = counted(lost) / total, counted(np.asarray(~asked)) / total
        flat = lost.reshape(*designs, -1)
        middle = np.argmax(np.cumsum(flat, axis=-1) > flat.sum(axis=-1, keepdims=True) // 2, axis=-1)[..., None]

        def in_the_middle(value: FloatArray) -> FloatArray:
            return np.take_along_axis(np.broadcast_to(value, motion.shape).reshape(*designs, -1), middle, axis=-1)[..., 0]

        self.seen.deepest = {name: in_the_middle(value) for name, value in motion.strokes.items()}
        self.seen.time = np.nan if motion.time is None else in_the_middle(motion.time)
        self.seen.lawless = counted(np.isnan(values) & ~unlimited & good) / count
        self.seen.unlimited = counted(unlimited & good) / count


def gaps_kernel(plan: Plan, bound: Request) -> Kernel:
    """Return the kernel of nodes that are below zero where a request has no bound."""
    bound.nodes(plan)  # its gaps are known then
    return Kernel([*bound.gaps(plan)])


def values_over(motion: Motion, quantity: Any) -> FloatArray:
    """Return a quantity over a motion's poses, infinite where a function says so; DefinitionError unless it is one number a pose."""
    plan = motion.plan
    if not is_quantity(quantity):
        with errors_of(f"{plan.title}: {words_of(quantity)}"):
            found = np.asarray(quantity(motion), float)
    else:
        found = np.asarray(motion[quantity], float)
    try:
        return np.broadcast_to(found, motion.shape)
    except ValueError:
        what = f"{words_of(quantity)} has the shape {found.shape} where {motion.shape} is expected"
        raise DefinitionError(f"{plan.title}: {what}; return a number for each pose.") from None


# Questions.


class Judge:
    """Who answers questions about some designs of a machine: over all of its `overs`, in all that acts."""

    def __init__(
        self,
        plan: Plan,
        designs: Mapping[str, Numbers],
        overs: Sequence[Over | Motion],
        acting: Acting | None = None,
        machine: object = None,
    ) -> None:
        if acting is not None:
            require_type(f"{plan.title}: acting", acting, Acting, 'a situation is expected, such as Acting(case="full")')
        self.plan, self.designs, self.acting, self.machine = plan, designs, acting or PLAIN, machine
        cases = [*plan.of_kind(LoadCase)]
        if self.acting.case is not None and not isinstance(self.acting.case, LoadCase):
            case_named(plan, self.acting.case)
        if self.acting.drive is not None:
            known_name("Stroke", self.acting.drive, plan.strokes, where=f"{plan.title}: acting.drive")
        for over in overs:
            if isinstance(over, Over):
                over.among(plan.members).check(plan.title, plan.strokes, cases)
        self.places = tuple(Domain(plan, designs, over) for over in overs)
        self._found: list[dict[Any, tuple[Leaf, list[Candidate]]]] = [{} for _ in self.places]
        self._seen: list[Coverage] = [Coverage() for _ in self.places]
        self._lost: dict[Any, LostPlaces] = {}
        self._made = dict[Hashable, Any]()

    def _once(self, key: Hashable, make: Callable[[], Made]) -> Made:
        """Return something of these designs, made once; apart where lost places are taken as part of the machine."""
        key = *(place.over.lost for place in self.places), key
        if key not in self._made:
            self._made[key] = make()
        return cast("Made", self._made[key])

    def lost_allowed(self) -> Judge:
        """Return this judge with lost places taken as part of the machine; both share all known results."""
        found, found_places = copy(self), tuple(map(copy, self.places))
        for place in found_places:
            place.over = place.over.renewed(lost=ALLOWED)
        found.places, found._lost = found_places, {}
        return found

    def for_design(self, number: int) -> Judge:
        """Return the judge of one design of a batch, by its number among them."""
        shape = self.places[0].motion._design_shape
        return self.of({name: float(np.broadcast_to(value, shape).ravel()[number]) for name, value in self.designs.items()})

    def of(self, designs: Mapping[str, Numbers]) -> Judge:
        """Return the judge of other designs over the same, by the same programs."""
        found = Judge(self.plan, designs, [place.over for place in self.places], self.acting, self.machine)
        for place, own in zip(found.places, self.places, strict=True):
            place.program = own.program
        return found

    @property
    def motion(self) -> Motion:
        """The poses that cover the first of its overs."""
        return self.places[0].motion

    @cached_property
    def anywhere(self) -> Domain:
        """The box of all strokes and all load cases, for questions at poses of their own."""
        return Domain(self.plan, self.designs, Over())

    @property
    def along(self) -> Motion | None:
        """The motion of its one way, a stroke or a path, along which parts can be named; None where there are several, or a box."""
        motion = self.motion
        return motion if len(self.places) == 1 and len(motion._stroke_shape) <= 1 and self.places[0].over.shape != "poses" else None

    def parts_below(self, request: Request) -> tuple[Span, ...]:
        """Return the parts of its one way on which a request is below zero; DefinitionError for a batch of designs."""
        asked = RowFunction(self.places[0], [SearchRow.alone(Least(request))])
        way, key = self.places[0].motion, identity_of(self.plan, request)

        def found() -> tuple[Span, ...]:
            return below_zero(way, lambda each: asked.row_values(each)[0][0])

        return found() if key is None else recalled(way, ("below zero", key), found)

    @property
    def cases(self) -> list[str]:
        """The load cases that are looked at, by name, "plain" the machine's own loads."""
        return [*dict.fromkeys(case for place in self.places for case in place.cases(self.acting))]

    def actings(self, request: Request, over: str = "") -> list[Acting]:
        """Return the situations in which a request is judged. `over` is the title of one `Over`; without it all count."""
        asked, places = request.under(self.acting), [place for place in self.places if place.over.name == over] or self.places
        found = dict.fromkeys(each for place in places for each in place.situations(asked, self.acting))
        return [each.acting.within(self.acting) for each in found]

    @property
    def sample_pose(self) -> Motion | None:
        """A pose that is reached, of those that are looked at; None where none is found on a coarse grid."""
        for place in self.places:
            axes = {name: np.linspace(np.min(value), np.max(value), COARSE) for name, value in place.motion.strokes.items()}
            coarse = place.motion if place.over.shape != "box" else Motion(self.plan, self.designs, strokes_over_axes(axes), "nan")
            for motion in (place.motion, coarse):
                reached = motion.reached.reshape(-1, *motion._stroke_shape).all(axis=0)
                if reached.any():
                    strokes = {name: np.broadcast_to(value, motion._stroke_shape) for name, value in motion.strokes.items()}
                    return motion.moved({name: value[reached][0] for name, value in strokes.items()})
        return None

    def situation(self, answer: Answer) -> Acting:
        """Return the situation of an answer of one design, as requests and forces take it."""
        return Situation(answer.case, answer.direction, answer.drive).acting.within(self.acting)

    def there(self, answer: Answer) -> Motion:
        """Return the pose of an answer of one design, of a path as it goes on there, of one in time at its instant."""
        domain = next((each for each in self.places if each.over.name == answer.over), self.places[0])
        way = self.motion if domain.instants is None else domain.motion
        strokes = {name: np.asarray(value) for name, value in answer.strokes.items()}
        going: Mapping[str, FloatArray] | None = None
        if domain.moves_along and domain.instants is None:
            corners, _ = legs_of(domain.motion.strokes)
            going = {name: at[answer.leg + 1] - at[answer.leg] for name, at in corners.items()}
        key = "there", *strokes, np.array([*strokes.values(), answer.time, *(going or {}).values()], float).tobytes()
        if going is None:
            return way._once(key, lambda: way._there(strokes, answer.time))
        return way._once(key, lambda: Motion(self.plan, self.designs, strokes, "nan", tangent=going))

    def alone_at(self, answer: Answer) -> Judge:
        """Return the judge of the pose and the situation of an answer alone; this one along a path, where forces follow the way."""
        if any(place.over.shape == "path" for place in self.places):
            return self
        found = Judge(self.plan, self.designs, [self.there(answer)], self.situation(answer), self.machine)
        found.places[0].program = max((place.program for place in self.places), key=len)
        return found

    @property
    def is_reached(self) -> bool:
        """Whether any place that it looks at can be assembled."""
        if any((each.motion.reached & each.over.condition_mask(each.motion)).any() for each in self.places):
            return True
        self.answers([reachable])
        return any(bool(np.any(seen.lost_share + seen.outside < 1.0 - 1e-12)) for seen in self._seen)

    @property
    def empty(self) -> list[Domain]:
        """The domains of which no place is left to look at: conditions (`only=`) leave every one out."""
        self.answers([reachable])
        return [place for place, seen in zip(self.places, self._seen, strict=True) if np.all(seen.outside >= 1.0)]

    def answer(self, question: Question) -> Answer:
        """Return the answer to one question."""
        return self.answers([question])[0]

    def answers(self, questions: Sequence[Question]) -> list[Answer]:
        """Return the answers to some questions, the worst over all that the machine runs, in one pass; earlier answers are kept."""
        held, kept = list[tuple[Hashable, Question, Sequence[Measure | Constraint]]](), self._once("answers", dict[Hashable, Answer])
        of_leaf = partial(leaf_key, self.plan)
        for question in questions_of(self.plan, questions):
            measures = [question] if isinstance(question, Measure) else []
            constraints = [] if measures else conditions_of([question], self.machine)
            every: list[Measure | Constraint] = [*measures, *constraints]
            key: Hashable = tuple([each.tree(of_leaf) for each in every]) or (question,)
            if key not in kept:
                check_kinds(self.plan, measures, constraints)
            held.append((key, question, every))
        new = [each for key, _, each in held if key not in kept]
        leaves = tuple(dict.fromkeys(leaf for each in new for one in each for leaf in leaves_of(one)))
        for number in range(len(self.places)) if new else ():
            self.find(number, leaves)
        found, shape = list[Answer](), self.motion._design_shape
        for key, question, each in held:
            if key in kept:
                found.append(kept[key])
            elif isinstance(question, Reachable):
                found.append(of_batch([self.reached_by(design) for design in np.ndindex(shape)], shape))
            else:
                found.append(self.worst(question, each))
        kept.update((key, each) for (key, *_), each in zip(held, found, strict=True) if not each.lost)  # what is lost is told in a language
        pairs = zip(held, found, strict=True)
        return [each if each.question is question else each._to(question) for (_, question, _), each in pairs]

    def find(self, number: int, leaves: Sequence[Leaf]) -> None:
        """Find the worst of some leaves over one `Over`, by its number, in one pass; known results are reused."""
        place, known = self.places[number], self._found[number]
        asked = {key: leaf for leaf in leaves if (key := leaf_key(self.plan, leaf)) not in known}
        rows = {key: self.search_rows(leaf, self.anywhere if isinstance(leaf, At) else place) for key, leaf in asked.items()}
        apart = {At: self.at_pose, Integral: integrated}
        sought = [row for key, each in rows.items() if type(asked[key]) not in apart for row in each]
        if sought or not self._seen[number].count:
            each_of, seen = place.extremes(sought or [SearchRow.alone(Least(zeros_over))])
            known_seen = self._seen[number]
            self._seen[number] = replace(known_seen, count=known_seen.count + seen.count) if known_seen.count else seen
            found = dict(zip(map(id, sought), each_of, strict=False))
        for key, leaf in asked.items():
            one = apart.get(type(leaf))
            known[key] = leaf, [found[id(row)] if one is None else one(row, place) for row in rows[key]]

    def search_rows(self, leaf: Leaf, place: Domain) -> list[SearchRow]:
        """Return the pieces of a leaf over one `Over`, each once."""
        request, worst = situated(leaf.bare_quantity, self.acting, keep=False), leaf.quantity
        if isinstance(worst, Worst):
            known = ", ".join(self.plan.strokes)
            ensure(worst.over in self.plan.strokes, f"{self.plan.title}: {worst}: {worst.over} is no stroke; its strokes are {known}.")
            in_time = place.instants is not None and follows_time(self.plan, request)
            what = f"{self.plan.title}: {leaf}: it follows how fast the strokes move, which is known on the path in time alone"
            ensure(not in_time, f"{what}; take {leaf.word}({words_of(request)}) there, forces in slow motion over=Over().")
        sense = leaf.sense or 1.0
        found: dict[Any, SearchRow] = {}
        for situation in place.situations(request, self.acting):
            own: Any = situated(request, situation.acting)
            if isinstance(worst, Worst) and (leaf.worst_over or place.over.shape != "box"):
                own = replace(worst, quantity=own)
            pieces: Sequence[SmoothPiece] = (SmoothPiece(own),)
            if isinstance(own, Request) and not isinstance(leaf, Integral):  # the worst integral of a piece is not that of the worst
                pieces = own.pieces(self.plan)
                if len(pieces) > 1 and any(piece.bound and piece.bound * leaf.sense <= 0.0 for piece in pieces):
                    pieces = (SmoothPiece(own),)  # the least of what is the greatest of its pieces
            for piece in pieces:
                key = key_of(self.plan, piece.request)
                if key not in found:
                    found[key] = SearchRow(leaf, piece, situation, sense)
                else:  # a piece that is the same in two situations is named by what these have in common
                    one, names = found[key].situation, ("case", "direction", "drive")
                    common = {name: getattr(one, name) for name in names if getattr(one, name) == getattr(situation, name)}
                    found[key] = replace(found[key], situation=Situation(**common))
        return [*found.values()]

    def split(self, constraint: Constraint) -> list[Constraint]:
        """Return a constraint as one of each smooth piece, in each load case and movement that occurs, as searches take it.

        One piece alone stays as it is. A comparison of several measures does, too, and is one more in each movement with friction.
        """
        leaf = constraint.left
        bounds_worst = (leaf.sense, constraint.symbol) in ((-1.0, ">="), (1.0, "<="))
        if not (bounds_worst and isinstance(leaf, Leaf) and isinstance(leaf.sought, Request)) or constraint.right.leaves:
            if not rubs(self.plan, self.motion, self.acting):
                return [constraint]
            each_of = [each.bare_quantity for each in (*leaf.leaves, *constraint.right.leaves)]
            asked = [each for each in each_of if isinstance(each, Request)]
            known = dict.fromkeys(replace(each, case=None) for request in asked for each in self.actings(request))
            return [constraint, *(in_situation(constraint, each) for each in known if each.is_moving)]
        rows = [row for place in self.places for row in self.search_rows(leaf, place)]
        if len(rows) == 1:
            return [constraint]
        return [replace(constraint, left=replace(leaf, quantity=row.piece.request)) for row in rows]

    def at_pose(self, row: SearchRow, place: Domain) -> Candidate:
        """Return the value of a row at the one pose that its leaf says."""
        leaf = row.leaf
        assert isinstance(leaf, At)
        behind = strokes_behind(self.plan, leaf.quantity)
        missing = [name for name in behind if name not in leaf.strokes and name != leaf.worst_over]
        ensure(not missing, f"{self.plan.title}: {leaf}: say the pose, {', '.join(f'{name}=...' for name in missing)}.")
        start = {name: stroke.start for name, stroke in self.plan.strokes.items()}
        strokes = at_values(start | dict(leaf.strokes), self.plan)
        if isinstance(worst := row.request, Worst):  # all that the further stroke runs
            held: dict[str, Any] = {name: float(value) for name, value in strokes.items() if name != worst.over}
            inner = (Most if worst.sense > 0.0 else Least)(worst.quantity)
            (found,), seen = Domain(self.plan, self.designs, Over(**held)).searched([SearchRow.alone(inner)])
            return replace(found, rows=(row,), lawless=np.maximum(found.lawless, seen.lost_share))
        motion = Motion(self.plan, self.designs, strokes, "nan")
        if not behind and not motion.reached.all():  # it is the same wherever the machine stands
            motion = self.sample_pose or motion
        with np.errstate(all="ignore"):
            values, unlimited = RowFunction(place if place.instants is None else self.anywhere, [row]).row_values(motion)
        value = np.asarray(values[0])
        where = {name: np.broadcast_to(np.asarray(each), value.shape) for name, each in strokes.items()} if behind else {}
        return Candidate((row,), value, where, np.isinf(value), 1.0 * (np.isnan(value) & ~unlimited[0]), 1.0 * unlimited[0])

    # -- from leaves to questions ------------------------------------------------------------------------

    def candidates(self, question: object, number: int, design: tuple[int, ...]) -> Iterator[tuple[Domain, Candidate]]:
        """Yield a constraint, or a bare measure, of one design in every situation over one `Over`, by its number, each with its domain."""
        leaves, of_poses, shape = leaves_of(question), is_at_poses(question), self.motion._design_shape
        place, seen = (self.anywhere, None) if of_poses else (self.places[number], self._seen[number])
        known = (self._found[number][leaf_key(self.plan, leaf)][1] for leaf in leaves)
        of_leaves = [[each.of_design(design, shape) for each in pieces] for pieces in known]
        for chosen in combined_pieces(of_leaves if is_worst_bound(question) else [*map(worst_pieces, of_leaves)]):
            with np.errstate(all="ignore"):
                value, margin, limit = valued(question, {leaf: each.value for leaf, each in zip(leaves, chosen, strict=True)})
            where, time, leg = next(((each.strokes, each.time, each.leg) for each in chosen if each.strokes), ({}, np.nan, -1))
            lawless = reduce(np.fmax, (each.lawless for each in chosen), 0.0)
            unlimited = reduce(np.fmax, (each.unlimited for each in chosen), 0.0)
            undefined = np.isnan(margin) and not any(np.isnan(each.value) for each in chosen)
            unbounded = np.asarray(np.any([each.unbounded for each in chosen]))
            rows = tuple(each.rows[0] for each in chosen)
            lacks = lawless, unlimited, time, leg, margin, limit, undefined
            yield place, Candidate(rows, value, where, unbounded, *lacks, seen, design, question)

    def unlimited_cases(self, question: Condition) -> list[str]:
        """Return the load cases in which nothing limits what a condition bounds, of one design, though in others something does."""
        self.answers([question])
        free = dict[str, bool]()
        for number, one in product(range(len(self.places)), conditions_of([question], self.machine)):
            for _, each in self.candidates(one, number, ()):
                is_free = bool(np.isnan(each.value) and each.unlimited > 0.0 and not each.lawless)
                free[each.situation.case] = free.get(each.situation.case, True) and is_free
        return [case for case, is_free in free.items() if case and is_free and not all(free.values())]

    def lost_of(self, place: Domain, candidate: Candidate) -> LostPlaces:
        """Return the lost places of a candidate of one design."""
        seen = candidate.seen
        if seen is not None:
            key = (id(place), candidate.design, current_language(), current_system())  # as it is told there
            if key not in self._lost:
                self._lost[key] = place.lost_places(seen.of_design(candidate.design))
            return self._lost[key]
        if not candidate.lawless or not np.isnan(candidate.value):
            return NONE_LOST
        strokes = {name: float(value) for name, value in candidate.strokes.items()}
        with unwarned():
            error = assembly_error_at(self.motion, strokes) if strokes and not self.motion._design_shape else None
        return LostPlaces(1.0, strokes, " ".join(str(error).split()) if error is not None else "")

    def worst(self, question: object, constraints: Sequence[object]) -> Answer:
        """Return the answer to a question: its worst in every situation over every `Over`, for a batch per design."""
        count, found = len(self.places) if any(not is_at_poses(one) for one in constraints) else 1, list[Answer]()
        for design in np.ndindex(self.motion._design_shape):
            candidates = [each for number in range(count) for one in constraints for each in self.candidates(one, number, design)]
            if not candidates:
                raise DefinitionError(f"{self.plan.title}: {question}: there is nothing to ask it of.")
            found.append(self.answered(question, candidates))
        return of_batch(found, self.motion._design_shape)

    def answered(self, question: object, found: Sequence[tuple[Domain, Candidate]]) -> Answer:
        """Return the answer of one design, with the names of load case, movement and `Over` where there are several."""
        is_bare, candidates, margins = isinstance(question, Measure), [each for _, each in found], [each.margin for _, each in found]
        losses = [self.lost_of(*each) for each in found]
        lost = next(filter(None, losses), NONE_LOST)
        fatal = any(
            each.undefined or ((each.seen is None or place.over.lost != ALLOWED) and (each.lawless or own_lost))
            for (place, each), own_lost in zip(found, losses, strict=True)
        )
        known = [k for k, margin in enumerate(margins) if not np.isnan(margin)]
        constraints = dict.fromkeys(each.constraint for each in candidates)
        are_alike = len(constraints) == 1 or len({measures_of(self.plan, each) for each in constraints}) == 1
        least = reduce(lambda a, b: b if candidates[b].is_worse(candidates[a], are_alike) else a, known or [0])
        worst, value, strokes, kept = candidates[least], np.nan, dict[str, float](), False
        place = found[least][0]
        if known and np.isfinite(margins[least]):  # of a tie the place of the first: `Over`, case, extending before retracting
            near = TIE * (abs(margins[least]) + abs(float(worst.value)))
            same = (k for k in known if are_alike or candidates[k].constraint is worst.constraint)
            first = next(k for k in same if margins[k] <= margins[least] + near)
            place, worst = found[first][0], replace(candidates[first], value=worst.value)
        if known:
            value, strokes = float(worst.value), {name: float(each) for name, each in worst.strokes.items()}
            kept = bool(margins[least] >= 0.0)
            status = UNBOUNDED if worst.unbounded and (is_bare or not kept) else LOST if kept and fatal and not is_bare else OF_VALUE
        else:
            status = LOST if fatal or any(each.lawless for each in candidates) else NOTHING_LEFT
        ok = None if is_bare or status == NOTHING_LEFT else kept and not fatal
        kinds: dict[str, set[Any]] = {
            "case": {each.situation.case for each in candidates}, "direction": {each.situation.direction for each in candidates},
            "drive": {each.situation.drive for each in candidates} - {""}, "over": {each.over for each, _ in found},
            "side": {each.side for each in candidates if each.situation.direction == worst.situation.direction},
        }  # fmt: skip
        named = frozenset(name for name, each in kinds.items() if len(each) > 1)
        if not lost and any(each.undefined for each in candidates):
            lost = LostPlaces(1.0, {}, said("its measures have values, what is calculated from them has none"))
        if not lost and worst.lawless:
            lost = LostPlaces(float(worst.lawless), {}, said("it has no value at places that were looked at"), False)
        units = {name: stroke_unit(self.plan, name) for name in strokes}
        count = sum(each.count for each in {id(one.seen): one.seen for one in candidates}.values() if each is not None)
        outside = float(np.asarray(worst.seen.outside)[worst.design]) if worst.seen is not None else 0.0
        return Answer(
            question, value, ok, status, strokes, worst.situation.case, worst.situation.direction, worst.situation.drive, worst.side,
            place.over.name, lost, float(worst.unlimited), outside, place.width if worst.seen is not None else {}, count, units,
            measures_of(self.plan, worst.constraint), float(worst.time) if known else np.nan, named,
            int(worst.leg) if known else -1, turned_by(place, question), float(worst.limit),
            0.0 if is_bare or not known else worst.used, case_titles(self.plan),
        )  # fmt: skip

    def reached_by(self, design: tuple[int, ...]) -> Answer:
        """Return whether all places can be assembled, of one design by its place in a batch."""
        every = [seen.of_design(design) for seen in self._seen]
        losses = [place.lost_places(seen) for place, seen in zip(self.places, every, strict=True)]
        number = max(range(len(self.places)), key=lambda each: (losses[each].share, bool(losses[each])))
        place, seen, lost = self.places[number], every[number], losses[number]
        fatal = any(each and one.over.lost != ALLOWED for each, one in zip(losses, self.places, strict=True))
        units = {name: stroke_unit(self.plan, name) for name in lost.strokes}
        ok: bool | None = not fatal
        status = LOST if lost else OF_VALUE
        if not lost and all(each.outside >= 1.0 for each in every):
            ok, status = None, NOTHING_LEFT
        return Answer(
            reachable, seen.lost_share, ok, status, lost.strokes, over=place.over.name, lost=lost, time=lost.time,
            outside=seen.outside, width=place.width, count=sum(each.count for each in self._seen), units=units, measures=LOST_SHARE,
            named=frozenset(["over"] if len(self.places) > 1 else []),
        )  # fmt: skip


def judge_along(motion: Motion) -> Judge:
    """Return the judge of the designs of a motion over all that it covers, made once."""
    return motion._once(("judge", motion.plan), lambda: Judge(motion.plan, motion.designs, [motion]))


def of_batch(each_of: Sequence[Answer], shape: tuple[int, ...]) -> Answer:
    """Return the answers of the designs of a batch as one, arrays of their shape; of a single design its own."""
    if not shape:
        return each_of[0]
    own: dict[str, PerDesign] = {name: np.array([getattr(each, name) for each in each_of]).reshape(shape) for name in PER_DESIGN}
    own["value"] = own["value"].astype(float)
    names = dict.fromkeys(name for each in each_of for name in each.strokes)
    strokes = {name: np.array([float(each.strokes.get(name, np.nan)) for each in each_of]).reshape(shape) for name in names}
    units = {name: unit for each in each_of for name, unit in each.units.items()}
    named, lost = frozenset().union(*(each.named for each in each_of)), next((each.lost for each in each_of if each.lost), NONE_LOST)
    return replace(each_of[0], strokes=strokes, units=units, named=named, lost=lost, **own)


def zeros_over(motion: Motion) -> FloatArray:
    """Return zeros, for questions about the places alone."""
    return np.zeros(motion.shape)


def questions_of(plan: Plan, given: object) -> list[Any]:
    """Return questions as a list; DefinitionError for anything else."""
    what, expected = f"{plan.title}: answers(questions", "a list of questions is expected, [most(...) <= 8 * deg]"
    listed = [given] if isinstance(given, (Measure, Condition)) else require_type(what, given, (list, tuple), expected)
    for each in listed:
        if not isinstance(each, (Measure, Condition)):
            at_poses = is_quantity(each) or isinstance(each, Worst)
            said_of = f"{words_of(each)} has a value at every pose" if at_poses else f"{cited(each)} is none"
            if isinstance(each, PoseCondition):
                said_of = f"{each} is kept at some poses and not at others; say which value is meant, or where, Over(only=[...])"
            what = f"{plan.title}: a question is a measure or a condition, and {said_of}"
            raise DefinitionError(f"{what}; write least(...), most(...) >= ....")
    return [*listed]


def leaves_of(question: Any) -> tuple[Leaf, ...]:
    """Return the measures over the strokes in a constraint or a measure."""
    found: tuple[Leaf, ...] = (question.margin if isinstance(question, Constraint) else question).leaves
    return found


def is_at_poses(question: object) -> bool:
    """Return whether a constraint or a measure is only about poses that it says itself, whatever the `Over`."""
    leaves = leaves_of(question)
    return bool(leaves) and all(isinstance(leaf, At) for leaf in leaves)


def leaf_key(plan: Plan, leaf: Leaf) -> Hashable:
    """Return a key of a leaf, valid as long as it lives."""
    strokes = tuple(leaf.strokes.items()) if isinstance(leaf, At) else ()
    return type(leaf).__name__, key_of(plan, leaf.quantity), strokes, leaf.by if isinstance(leaf, Integral) else None


def key_of(plan: Plan, quantity: object) -> Hashable:
    """Return a key of a piece, valid as long as it lives."""
    if isinstance(quantity, Worst):
        return "worst", key_of(plan, quantity.quantity), quantity.over, quantity.sense
    identity = identity_of(plan, quantity)
    return id(quantity) if identity is None else identity


def combined_pieces(of_leaves: Sequence[Sequence[Candidate]]) -> list[tuple[Candidate, ...]]:
    """Return the pieces of several leaves that occur at once, all there are.

    They are in the same load case, where they name one, and either at rest or moving: what is at rest only, as nothing has friction,
    goes with both. What the same stroke, path or cylinder moves goes the same way.
    """
    moves = {id(each): any(one.situation.acting.is_moving for one in pieces) for pieces in of_leaves for each in pieces}

    def at_once(a: Candidate, b: Candidate) -> bool:
        one, other = a.situation, b.situation
        if one.case and other.case and one.case != other.case:
            return False
        if not (one.direction and other.direction):
            return True
        if one.acting.is_moving != other.acting.is_moving:
            return not moves[id(b if one.acting.is_moving else a)]
        movers = (getattr(each.rows[0].leaf.bare_quantity, "mover", None) for each in (a, b))
        return len({*movers}) > 1 or (one.direction, one.drive) == (other.direction, other.drive)

    found: list[tuple[Candidate, ...]] = [()]
    for pieces in of_leaves:
        found = [(*chosen, each) for chosen in found for each in pieces if all(at_once(one, each) for one in chosen)]
    return found


def is_worst_bound(question: object) -> bool:
    """Return whether a question is a measure alone, or bounds the worst of one: then each of its pieces must keep it by itself."""
    if isinstance(question, Leaf):
        return True
    if not isinstance(question, Constraint) or not isinstance(question.left, Leaf):
        return False
    is_known = all(isinstance(leaf, At) for leaf in question.right.leaves)
    return is_known and (question.left.sense, question.symbol) in ((-1.0, ">="), (1.0, "<="))


def worst_pieces(pieces: Sequence[Candidate]) -> list[Candidate]:
    """Return the worst of the pieces of a leaf of one design in each situation, the first of equal ones."""
    found: dict[Situation, Candidate] = {}
    for each in pieces:
        known = found.setdefault(each.situation, each)
        if known is not each:
            (one,), (other,) = known.rows, each.rows
            worst = each if np.isnan(known.value) or other.sense * (each.value - known.value) > 0.0 else known
            row = replace(one, piece=replace(one.piece, side=worst.side))
            lawless, unlimited = max(known.lawless, each.lawless), min(known.unlimited, each.unlimited)
            found[row.situation] = replace(worst, rows=(row,), lawless=lawless, unlimited=unlimited)
    return [*found.values()]


def situation_found(rows: Sequence[SearchRow]) -> Situation:
    """Return the situation of rows that occur at once: their load case, and their movement where one of them moves."""
    every = [each.situation for each in rows]
    ways = [each for each in every if each.acting.is_moving] or [each for each in every if each.direction] or [Situation()]
    return Situation(next((each.case for each in every if each.case), ""), ways[0].direction, ways[0].drive)


def valued(question: Any, values: Mapping[Leaf, FloatArray]) -> tuple[FloatArray, FloatArray, PerDesign]:
    """Return a question's value, its margin, and its limit. The margin is below zero where it is not kept.

    A bare measure has no limit. Its margin is least where its one leaf is worst.
    """
    if isinstance(question, Measure):
        running = {each for each in question.leaves if not isinstance(each, At)}
        value = np.asarray(question.from_leaves(values.__getitem__), float)
        (leaf,) = running if len(running) == 1 else (question,)
        of_leaf = np.where(np.isnan(value), np.nan, values[leaf]) if isinstance(leaf, Leaf) and leaf.sense else value
        return value, of_leaf if leaf.sense < 0.0 else -of_leaf, np.nan
    left, right = (np.asarray(each.from_leaves(values.__getitem__), float) for each in (question.left, question.right))
    size = MET * np.maximum(np.abs(np.where(np.isfinite(left), left, 0.0)), np.abs(np.where(np.isfinite(right), right, 0.0)))
    apart = {">=": left - right, "<=": right - left}.get(question.symbol)
    margin = 1e3 * size - np.abs(left - right) if apart is None else apart
    return left, np.where((margin < 0.0) & (margin >= -size), 0.0, margin), right


def measures_of(plan: Plan, question: object) -> str:
    """Return the kind of a question's value, "" where it is not plain."""
    measure = question.left if isinstance(question, Constraint) else question
    match measure:
        case Integral() | CombinedMeasure():
            kind = kind_of_quantity(plan, measure)
            return kind.name if kind is not None else ""
        case Leaf():
            return measured_in(plan, stands_for(plan.members, measure.bare_quantity))
    return ""


def turned_by(place: Domain, question: object) -> str:
    """Return "rad" for an integral over an angle, behind its unit, "rad2" for that of an angle; "" for a work and all else."""
    asked = question.left if isinstance(question, Constraint) else question
    if not isinstance(asked, Integral) or stroke_measure(place.plan, asked.by or place.running[0]) != "angle":
        return ""
    kind = measured_in(place.plan, stands_for(place.plan.members, asked.bare_quantity))
    return "" if kind in ("", "moment", "number") else "rad2" if kind == "angle" else "rad"


def integrated(row: SearchRow, place: Domain) -> Candidate:
    """Return the integral of a row over the one stroke that runs."""
    plan, leaf = place.plan, row.leaf
    assert isinstance(leaf, Integral)
    if place.instants is not None:
        what = f"{plan.title}: {leaf}: an integral is over one stroke, and {place.over.name or 'this path'} goes in time"
        raise DefinitionError(f"{what}; over time take motion = machine.sweep(1001, over=...), np.trapezoid(motion[...], motion.time).")
    running = [name for name in place.running if name != leaf.worst_over]
    if place.over.shape != "box" or len(running) != 1 or (leaf.by or running[0]) != running[0]:
        by, here = stroke_of(plan, leaf.by or next(iter(plan.strokes))), f"here run {', '.join(running) or 'none'}"
        here = here if place.over.shape == "box" else f"not along {place.over.name or 'a path'}"
        others = ", ".join([f"{by}=(...)", *(f"{each}=0.0" for each in plan.strokes if each != by)])
        raise DefinitionError(f"{plan.title}: {leaf}: an integral is over one stroke that runs, {here}; say over=Over({others}).")
    (name,) = running
    partly = f"{plan.title}: {leaf}: an integral goes over a whole stroke, and only= leaves out a part of it"
    ensure(not place.over.only, f"{partly}; give the ends of that part, over=Over({name}=(...)).")
    held = {each: float(np.min(value)) for each, value in place.motion.strokes.items()}
    low, span = held[name], float(np.ptp(place.motion.strokes[name]))

    def values(parts: FloatArray) -> FloatArray:
        order = np.argsort(parts)
        strokes = {each: np.full(parts.shape, value) for each, value in held.items()} | {name: low + span * parts[order]}
        with np.errstate(all="ignore"):
            found, _ = RowFunction(place, [row]).row_values(Motion(plan, place.designs, strokes, "nan"))
        return np.asarray(found[0][..., np.argsort(order)])

    total = quadrature(values).value * span
    return Candidate((row,), np.asarray(total), {}, np.isinf(total), float(np.isnan(total).any()), 0.0)
