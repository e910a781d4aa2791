"""A cylinder between two points of a mechanism: declared like them, checked against its stroke. Pressures are gauge [Pa].

>>> from linkage.units import bar, kN, mm
>>> lift = Cylinder("A", "B", bore=110 * mm, rod=60 * mm, count=2)
>>> print(f"{lift.size.thrust(160 * bar) / kN:.1f} kN; {lift.size.pressure_for(200 * kN) / bar:.1f} bar")
304.1 kN; 105.2 bar
>>> print(lift.standard())
cylinder: bore 110 mm and rod 60 mm; the rod is not of ISO 3320, next to it: 56 and 63 mm.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import replace
from functools import partial, reduce
from operator import add
from types import MappingProxyType
from typing import Any, ClassVar, Literal, Self, TypeAlias, TypeVar, Unpack, cast

import numpy as np
from numpy.typing import ArrayLike

from linkage.errors import DefinitionError, cited, ensure, is_listed, known_name, require, unknown, unwarned
from linkage.frozen import immutable, record
from linkage.language import noted, said, translated
from linkage.loads import AS_IT_RUNS, AT_REST, FRICTIONLESS, SENSES, DrawnAs, ForceElement, LawElement, Push, Rates, TwoPoint
from linkage.loads.acting import Acting, ActingKeywords, Case, Loads, situation_of, takes_situation
from linkage.loads.element import DIRECTIONS, UNBOUNDED, Declared, Formulas, Parameter, Poses, Share, Tie, by_speeds, require_poses
from linkage.motion import Answer, Column, Judge, Motion, Question, Request, SmoothPiece, Tabled, greatest, lowest, require_motion
from linkage.motion.measures import Condition, Constraint, MeasuredQuantity, at, least, most
from linkage.motion.motion_verdicts import HasVerdicts, PageWords, over_time
from linkage.plan import Mask, Plan
from linkage.program import is_traced
from linkage.quantities import InnerQuantity, Quantity, distance, label, quantity
from linkage.quantities.member import Member, NamedMembers, Reference, body_name, in_class, is_member_or_name, name_of, of_kind
from linkage.statics import LawRequest, applied_elements, elements_of, held_in_case, is_among, member_thrust, own_rates, request_text, same
from linkage.statics.poses import AnyMotion, motion_of_whole
from linkage.units import show, shown_number
from linkage.verdict import Remark, Verdict

from .barrel import HELD, MASSES, BarrelAndRod
from .buckling import Buckling, never_pushed
from .inputs import LONGEST, Array, follows, in_metres, names_behind, number_set, one_design, one_number, only_where, stroke_in_metres
from .remedy import Sizes, can_be_set, show_enough, smallest
from .standard_sizes import CylinderSize, RamSize, Works, chosen_series, standard_rods, standard_verdict

LENGTHS: Mapping[str, str] = MappingProxyType({"stroke": "Stroke of the cylinder", "closed": "Closed length of the cylinder"})
"""What its lengths are called in words."""
Side: TypeAlias = Literal["piston", "rod"]
PISTON: Side = "piston"
ROD: Side = "rod"
SIDES: tuple[Side, ...] = (PISTON, ROD)
"""The sides of a cylinder."""
SIDE_WORDS: Mapping[str, str] = MappingProxyType({
    "piston": "the piston side", "rod": "the rod side", "both": "both sides", "regenerative": "both sides on one line",
})  # fmt: skip


@record
class Chamber:
    """One side of a cylinder, which an OilLine fills: `lift.piston_side`, or by its name, "lift.rod_side".

    Parameters
    ----------
    cylinder : Cylinder or str
        The cylinder.
    side : {"piston", "rod"}
        The side of its piston.
    """

    cylinder: Reference
    side: Side

    def __str__(self) -> str:
        return f"{label(self.cylinder)}.{self.side}_side"


class Ram(TwoPoint, Tabled, HasVerdicts):
    """The base of rams, pushed by oil between A and B: `count` equal ones side by side, that hold the mechanism.

    A subclass is a frozen dataclass with A, B, `count`, and `mounting` and `safety` for buckling. It says its areas, its lengths, the oil
    that it takes, and what buckles. `piston_side` is its chamber, `length` the distance of its pins.
    """

    A: Reference
    B: Reference
    count: int
    mounting: str
    safety: float
    own_sides: ClassVar[tuple[Side, ...]] = SIDES
    """Its chambers."""
    drawn_as: ClassVar[DrawnAs] = "cylinder"
    file_section: ClassVar[str] = "hydraulics"
    headed: ClassVar[str] = noted("Cylinder {name}")
    named_in_all: ClassVar[bool] = True

    # -- what a subclass says ------------------------------------------------------------------------------

    @property
    @abstractmethod
    def side(self) -> Works:
        """The sides it works with."""

    def on_side(self, side: Side) -> Ram:
        """Return it as it works with one of its sides, for the line that this has: itself where it has no other."""
        return self

    @abstractmethod
    def sized(self, motion: Poses, direction: str | None = None) -> RamSize:
        """Return its areas as a motion's designs have them, to broadcast against it; at a border of stages those of a direction."""

    @abstractmethod
    def filled(self, side: Side, motion: Poses, start: Array, end: Array) -> Array:
        """Return how much larger a chamber is at one length than at another [m3], both [m] as arrays that broadcast against the motion.

        Parameters
        ----------
        side : Side
            The side of the piston.
        motion : Motion
            The poses.
        start, end : array
            The two lengths [m].

        Returns
        -------
        array
            The volume [m3].
        """

    @abstractmethod
    def filled_written(self, side: Side, start: Quantity, end: Quantity) -> Quantity:
        """Return the same as a quantity of its class, over the area of a circle of diameter 1 [m].

        Parameters
        ----------
        side : Side
            The side of the piston.
        start, end : Quantity
            The two lengths [m].

        Returns
        -------
        Quantity
            The volume over that area [m].
        """

    @abstractmethod
    def length_written(self, sides: Sequence[Side], start: Quantity, oil: Quantity) -> Quantity:
        """Return its length, as a quantity [m], where some chambers hold more oil than at a length: so much, over the same area.

        Parameters
        ----------
        sides : sequence of Side
            The chambers.
        start : Quantity
            The length at which they are filled [m].
        oil : Quantity
            What they hold more, over that area [m].

        Returns
        -------
        Quantity
            The length [m].
        """

    @abstractmethod
    def thickness(self, motion: Poses, direction: str | None = None) -> float | Array:
        """Return the diameter of its buckling part [m], to broadcast against the motion.

        Parameters
        ----------
        motion : Motion
            The poses.
        direction : str, optional
            The direction of motion; where it matters, as at a border of stages.

        Returns
        -------
        float or array
            The diameter [m].
        """

    @abstractmethod
    def length_set(self, name: str, motion: Poses, *, beside_bore: bool = False) -> Array:
        """Return its closed length or its whole stroke as a motion's designs have it.

        Parameters
        ----------
        name : {"closed", "stroke"}
            Which length.
        motion : Motion
            The poses.
        beside_bore : bool, optional
            Whether the bore stands beside it, so that one in millimetres is recognised.

        Returns
        -------
        array
            The length [m], to broadcast against the motion.

        Raises
        ------
        DefinitionError
            It is not above zero, is given in millimetres, or follows a stroke of the machine.
        """

    @abstractmethod
    def sides_written(self, written: Formulas, thrust: Array) -> tuple[Array, Array]:
        """Write the area of the side that works, and return its symbol with the area of the other side [m2].

        Parameters
        ----------
        written : Formulas
            What takes the lines.
        thrust : array
            The symbol of the thrust [N].

        Returns
        -------
        tuple of array
            The symbols of both areas [m2].
        """

    @abstractmethod
    def size_verdicts(self, judge: Judge) -> list[Verdict]:
        """Return the verdicts on its size over all that a judge looks at.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        list of Verdict
            The verdicts.
        """

    @abstractmethod
    def slender_part(self, motion: Poses, direction: str | None = None) -> tuple[str, int, Sequence[float]]:
        """Return the size that buckles at a pose by its name, the number of its stage, 0 for a rod, and its possible values [m].

        Parameters
        ----------
        motion : Motion
            The poses.
        direction : str, optional
            The direction of motion; where it matters, as at a border of stages.

        Returns
        -------
        tuple of str, int and sequence of float
            The name, the number and the values [m].
        """

    # -- what it is ----------------------------------------------------------------------------------------

    def push(self, motion: Poses, length: Array, rate: Array) -> Array:
        """Return nothing: it has no law of its own."""
        return np.zeros(())

    @by_speeds
    def pushes(self, motion: Poses, rates: Rates = AT_REST) -> list[Push]:
        return []

    @property
    def holds(self) -> bool:
        return True

    @property
    def piston_side(self) -> Chamber:
        """The chamber behind its piston, for an OilLine."""
        return Chamber(self, "piston")

    @property
    def length(self) -> Quantity:
        """The distance of its pins [m]: as a closed line gives it where it is asked for by a step that they follow, else as they are."""
        return InnerQuantity(self, "length")

    def inner(self, name: str, members: NamedMembers) -> Member | None:
        return length_in(self, members) if name == "length" else None

    @property
    def works_both(self) -> bool:
        return self.side == "both"

    def turns(self, members: NamedMembers) -> bool:
        held = [line for line in circuits_among(members) if line.kind_in(members) == "held"]
        on = [(line.name, each.side) for line in held for ram, each in line.filling(members) if same(ram, self)]
        return self.works_both or len({name for name, _ in on}) == len({side for _, side in on}) == 2

    def area_in(self, motion: Poses, sense: Array) -> Array:
        size = self.sized(motion)
        if size.works == "both":
            return np.asarray(np.where(sense[()] < 0.0, -size.pull_area, size.push_area))
        return np.asarray(size.sense * size.area + 0.0 * sense)

    def area_beside(self, motion: Poses, sense: Array, first: Self, way: int) -> Array:
        members, size = motion.plan.members, self.sized(motion)
        side = PISTON if way > 0 else ROD
        lines = [line for line, each in lines_of(first, members, "held") if each.side == side]
        if lines:  # what is joined to that side of it has the pressure, and nothing else has
            own = (each for line in lines for each in line.chambers_of(self, members))
            return reduce(np.add, (chamber_area(each, self, motion) for each in own), 0.0 * sense)
        area = self.area_in(motion, sense)
        return area if size.works == "both" or not first.works_both else np.where(size.sense * sense < 0.0, 0.0, area)

    def closed_thrust(self, motion: AnyMotion, acting: Acting) -> Array | None:
        closed = lines_of(self, motion.plan.members, "closed")
        parts = [line.line_pressure(motion, acting) * chamber_area(chamber, self, motion) for line, chamber in closed]
        return reduce(np.add, parts) if parts else None

    @property
    def stages(self) -> int:
        """How many stages move: with one its areas are the same at all its lengths."""
        return 1

    def larger(self, motion: Poses) -> list[Sizes]:
        """Return the standard sizes that give more force, ascending, as a remedy takes them; none where it has no series.

        Parameters
        ----------
        motion : Motion
            The poses.

        Returns
        -------
        list of Sizes
            The sizes.
        """
        return []

    def lengths_named(self, name: str) -> tuple[Quantity | str, ...]:
        """Return the closed length, or the stroke of each of its stages, as conditions name them; empty where it says none."""
        given = {each: self.given(each) for each in self.numbers if each.partition("_")[0] == name}
        return tuple(quantity(value) if follows(value) else f"{self.name}.{each}" for each, value in given.items())

    @property
    def lengths_given(self) -> tuple[str, ...]:
        """Which of LENGTHS it says."""
        return tuple(name for name in LENGTHS if self.lengths_named(name))

    def closed_and_stroke(self, motion: Poses) -> tuple[Array | None, Array | None]:
        """Return its closed length and its whole stroke as a motion's designs have them [m], to broadcast against it; None for none.

        DefinitionError for one that cannot be, and for sizes that cannot be.
        """
        self.sized(motion)
        given = self.lengths_given
        closed, stroke = (self.length_set(name, motion, beside_bore=True) if name in given else None for name in ("closed", "stroke"))
        return closed, stroke

    def taken(self, motion: Poses, low: Array, high: Array) -> Array:
        """Return the oil [m3] that its working sides take from one length to a greater one [m]."""
        works = self.sized(motion).works
        sides = SIDES if works == "regenerative" else (ROD if works == "rod" else PISTON,)
        return np.asarray(np.abs(reduce(np.add, [self.filled(side, motion, low, high) for side in sides])))[()]

    def is_in_stage(self, motion: Poses, stage: int, direction: str | None = None) -> Any:
        """Return where a stage moves, by its number from 1, to broadcast against a motion; at a border as in a direction.

        Parameters
        ----------
        motion : Motion
            The poses.
        stage : int
            The number of the stage.
        direction : str, optional
            The direction of motion; where it matters, as at a border of stages.

        Returns
        -------
        array of bool
            Where it moves.
        """
        return motion.distance(self.A, self.B) >= 0.0

    def pulled(self, judge: Judge) -> Verdict | None:
        """Return the verdict on a load that pulls at it where no oil holds it; None where there is no such load.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        Verdict, optional
            The verdict.
        """
        if not self.only_pushes or (found := self.pressed_wrongly(judge)) is None:
            return None
        by = {"force": force_words(found), "where": found.place}
        if self.is_single_acting:
            text = said(
                "the load pulls at it with {force}, {where}: it is single acting and no oil holds it; "
                "let the load press on it there, or take a cylinder.",
                **by,
            )
        else:
            text = said(
                "the load pulls at it with {force}, {where}: both of its sides are on one line and no oil holds it. "
                "Let the load press on it there, or give its rod side a line of its own.",
                **by,
            )
        return Verdict("holding", False, text, answer=found)

    def pressed(self, which: Ram | str, judge: Judge) -> Condition:
        """Return the condition that the load is on the side that works everywhere, with the drive at rest; of the class's, or of itself."""
        thrust = thrust_request(which, at_rest(judge))
        return most(thrust) <= 0.0 if self.side == "rod" else least(thrust) >= 0.0

    def pressed_wrongly(self, judge: Judge, pressed: Condition | None = None) -> Answer | None:
        """Return the answer on a load against the side that works, or on another condition; None where there is none, to rounding."""
        found = judge.answer(self.pressed(self, judge) if pressed is None else pressed)
        if found.ok or np.isnan(found.value):
            return None
        ends = judge.answers(least_and_most(thrust_request(self, at_rest(judge))))
        size = max((abs(each.value) for each in ends if np.isfinite(each.value)), default=0.0)
        return None if abs(found.value) <= TO_ROUNDING * size and not found.unbounded else found

    def _is_alone(self, judge: Judge) -> bool:
        """Return whether it carries loads on no line that has a verdict on holding."""
        return carries_loads(judge) and not circuits_of(self, judge.plan)

    @property
    def is_single_acting(self) -> bool:
        """Whether it has a piston side alone."""
        return len(self.own_sides) == 1

    @property
    def only_pushes(self) -> bool:
        """Whether oil pushes it apart alone and nothing holds it against a pull: it is single acting, or one line has both its sides."""
        return self.is_single_acting or self.side == "regenerative"

    def extent(self, motion: Motion) -> tuple[Array, Array]:
        """Return its least and its greatest length over all that a motion covers [m], one value a design; NaN where no pose is reached."""
        low, high = (np.asarray(found(motion, lambda each: each.distance(self.A, self.B)).value) for found in (lowest, greatest))
        return low, high

    def travel(self, motion: Motion) -> Array:
        """Return greatest less least length over all that a motion covers [m], one value a design; DefinitionError if none is reached."""
        low, high = self.extent(motion)
        ensure(np.all(np.isfinite(high - low)), f"{self}: no pose of this motion can be assembled.")
        return np.asarray(high - low)

    # -- what it carries -----------------------------------------------------------------------------------

    @takes_situation
    def thrust(self, motion: AnyMotion, loads: Loads = None, **situation: Unpack[ActingKeywords]) -> Array:
        """Return the thrust of this cylinder, whatever drives the machine, shape (...) [N], positive where it pushes its ends apart.

        `loads` are the machine's own unless others are given. It is frictionless unless a `direction` is named: "extending" while this
        cylinder grows. Along a path of several strokes the senses of friction are those of the path. No efficiency is in it. Of one
        that a FloatCircuit feeds it is the gas's force. DefinitionError where it holds nothing here; SingularError where its length
        stands still against its drive, and where friction locks the mechanism.
        """
        return member_thrust(motion, self, situation_of("thrust", loads=loads, **situation))

    @takes_situation
    def pressure(self, motion: AnyMotion, loads: Loads = None, **situation: Unpack[ActingKeywords]) -> Array:
        """Return the pressure on the side that works, shape (...) [Pa gauge]; 0 where the other side holds.

        While it moves in its working direction, or the one named, with what its one LiftCircuit says: efficiencies and back pressure.
        Of a cylinder that a FloatCircuit feeds it is the line's pressure, of one with a pump's line for each side that of the side that
        holds. DefinitionError where several circuits have it otherwise: name one, `circuit.pressure_for(motion)`.
        """
        return pressure_of(self, motion, situation_of("pressure", loads=loads, **situation))

    def bounds(self, motion: Poses, lifting: bool, *, share: float = 1.0) -> tuple[Array, Array]:
        """Return between which two thrusts [N] its circuit lets it stand, where it lifts or where it holds; unbounded without a circuit.

        A LiftCircuit gives what its pump lifts with the sides that work, at a `share` of its pressure, or what its relief valve holds with
        both: the piston up to the highest, the annulus down to the lowest. A FloatCircuit gives the gas's force and no other. Where pumps'
        lines have a side each, each gives its end. DefinitionError where several circuits have it otherwise: ask one,
        `circuit.bounds_of(lift, motion, lifting)`.
        """
        require_poses(motion)
        own, members = as_in(motion.plan, self), motion.plan.members
        sides = {line.as_worked(own, members).side: line for line in lines_by_side(own, motion.plan)}
        if sides:
            low, high = (sides[side].bounds_of(self, motion, lifting, share=share)[end] for end, side in enumerate((ROD, PISTON)))
            return low, high
        circuit = circuit_having(self, motion.plan)
        return UNBOUNDED if circuit is None else circuit.bounds_of(self, motion, lifting, share=share)

    def goes(self, motion: AnyMotion, acting: Acting) -> Array | None:
        """Return 1 where it extends over a path in time, -1 where it retracts, 0 where it stands; None where a direction says that."""
        is_said = acting.direction not in (None, AS_IT_RUNS) or isinstance(acting.rates, Mapping)
        is_timed = motion.time is not None if isinstance(motion, Motion) else acting.direction == AS_IT_RUNS
        if is_said or not is_timed:
            return None
        growth, speeds = self.growth(motion, motion.rates), [np.hypot(*motion.velocity(end, motion.rates)) for end in self.ends]
        return np.where(np.abs(growth) > TO_ROUNDING * np.maximum(*speeds), np.sign(growth), 0.0)

    @property
    def driven(self) -> tuple[str, ...]:
        """The directions in which the side that works drives it."""
        return {"rod": ("retracting",), "both": ("extending", "retracting")}.get(self.side, ("extending",))

    def ways_back(self, low: ArrayLike, high: ArrayLike) -> tuple[str, ...]:
        """Return the directions in which it goes back: against its working one; of both sides those in which the load drives it.

        `low` and `high` are the ends of its thrust, or of pressures that have its sign: where they have both signs it goes both ways.
        """
        if self.side != "both":
            return ("extending",) if self.side == "rod" else ("retracting",)
        pulls, pushes = (max(float(np.max(np.nan_to_num(each))), 0.0) for each in (np.negative(low), high))
        ways = ("retracting",) if pushes > TO_ROUNDING * pulls or not pulls else ()
        return (*ways, "extending") if pulls > TO_ROUNDING * pushes else ways

    def pressure_on(self, side: str, motion: AnyMotion, acting: Acting, circuit: Circuit | None = None, *, below: bool = False) -> Array:
        """Return the pressure on one of its sides, shape (...) [Pa gauge]; 0 where the other side holds, or with `below` negative values.

        At rest, also where it stands in a motion in time, without friction and efficiencies; while it moves, on a side that works, as its
        circuit has it. A side on another line that keeps its own pressure has that; both sides on one line have one. A side on no line is
        shut behind its pump's valve, and without pressure beside a closed line.
        """
        if side not in self.own_sides:
            raise DefinitionError(f"{self.name or self}: it has no {side} side, whose pressure could be asked for; it is single acting.")
        motion, side = held_in_case(motion, acting), PISTON if self.side == "regenerative" else side
        line, members = circuit or circuit_having(self, motion.plan, False), motion.plan.members
        beside = line_beside(self, side, line, members)
        if beside is not None:
            return beside.pressure_in(self, motion, acting) + np.zeros(motion.shape)
        own = next((one for one, chamber in lines_of(self, members) if chamber.side == side), None)
        if own is None and line is not None and line.kind_open(members) != "held":
            return np.zeros(motion.shape)
        thrust = line_thrust(self, line, motion, acting)
        along, size = thrust if side == PISTON else -thrust, self.sized(motion, acting.direction)
        balance = along / (size.outward_area if side == PISTON else size.pull_area)
        if line is not None and side == other_side(self) and line.kind_in(members) == "held":
            balance = line.pressure_behind(self, motion, acting)
        least = balance if below else 0.0
        goes, at_rest = self.goes(motion, acting), np.asarray(np.maximum(balance, least))[()]
        if (acting.movement == FRICTIONLESS and goes is None) or (self.side not in (side, "both") and self.side != "regenerative"):
            return at_rest
        found = pressure_of(self, motion, acting) if circuit is None else circuit.pressure_in(self, motion, acting)
        found = np.where(along > 0.0, found, least if goes is None else at_rest) + 0.0 * thrust
        return found if own is None else over_valves(own, self, motion, acting, found)

    def columns(self, motion: Motion) -> list[Column]:
        """Return its thrust without friction and, unless circuits differ in them, its pressure and its reserve, for the table."""
        return self.columns_in(motion)

    def columns_in(self, motion: Motion, case: Case = None, direction: str | None = None) -> list[Column]:
        require_poses(motion)
        acting = Acting(case=case, direction=direction)
        found = [Column(noted("thrust"), member_thrust(motion, self, acting), "kN")]
        lines = circuits_of(self, motion.plan)
        if len(lines) > 1 and not (lines := lines_by_side(self, motion.plan)):
            return found
        found.append(Column(noted("pressure"), pressure_of(self, motion, acting), "bar", 2))
        used = [use for each in lines if (use := each.use_of(self, motion, acting)) is not None]
        if not used:
            return found
        use = reduce(np.maximum, used)
        return [*found, Column(noted("reserve"), np.asarray(1.0 / only_where(use > 0.0, use))[()], "", 3)]

    def questions(self, judge: Judge) -> list[Question]:
        """Return its least and greatest length, and the utilisation of its rod."""
        use = [most(buckling_request(self, Acting())) <= 1.0] if carries_loads(judge) else []
        return [*least_and_most(distance(self.A, self.B)), *use]

    def conditions(self, judge: Judge) -> Mapping[str, Condition]:
        """Return that it fits, where its stroke is declared, and that its rod does not buckle."""
        found: dict[str, Condition] = {}
        ends = distance(self.A, self.B)
        given = {name: number_request(self, f" {name}", partial(self.length_set, name)) for name in LENGTHS}
        closed, stroke = at(given["closed"]), at(given["stroke"])
        if self.lengths_given == ("stroke",):
            found["length"] = most(ends) - least(ends) <= stroke
        elif "closed" in self.lengths_given:
            found["length"] = AllOf((least(ends) >= closed, *((most(ends) <= closed + stroke,) if "stroke" in self.lengths_given else ())))
        return found | ({"buckling": most(buckling_request(self.name, Acting())) <= 1.0} if carries_loads(judge) else {})

    def page_words(self, judge: Judge) -> Mapping[str, PageWords]:
        text = noted("its rod is safe against buckling by {value}, {place}")
        safe = self.safety / most(buckling_request(self.name, Acting()))
        weak = noted("its rod is safe against buckling by {value} only, {place}: take a thicker rod, or shorten the cylinder")
        lacks = {">=": noted("it is {much} too long closed: take one with a shorter closed length"), "<=": MISSING}
        return {"buckling": PageWords(text, safe, fails={"<=": weak}), "length": PageWords("", fails=lacks)}

    def load_limits(self, judge: Judge) -> Mapping[str, Condition]:
        return {rule: each for rule, each in self.conditions(judge).items() if rule not in ("length", "buckling")}

    def load_remarks(self, judge: Judge) -> Mapping[str, Condition]:
        return {rule: each for rule, each in self.conditions(judge).items() if rule in ("length", "buckling")}

    def verdicts(self, judge: Judge) -> list[Verdict]:
        """Return whether it fits wherever the machine runs, is of a standard size, and whether a rod that carries something buckles."""
        try:
            if not self.is_placed(judge):
                return [Verdict("length", False, self.unplaced), *self.size_verdicts(judge)]
            rod = self.buckling_verdicts(judge) if carries_loads(judge) else []
            return [*self.length_verdicts(judge), *self.size_verdicts(judge), *rod]
        except DefinitionError as error:
            return [Verdict.refused("cylinder", error)]

    def gauges(self, plan: Plan) -> dict[str, Request]:
        circuits, by_side = circuits_of(self, plan), lines_by_side(self, plan)
        read: dict[str, Reading] = {name: partial(self.length_set, name) for name in self.lengths_given}
        read |= circuits[0].gauges_of(self, plan) if len(circuits) == 1 else {}
        found: dict[str, Request] = {name: number_request(self, f" {name}", each) for name, each in read.items()}
        if by_side:
            found["most"] = number_request(self, " most", partial(most_of_side, self), acting=Acting(), mover=self.name)
        if len(circuits) <= 1 or by_side:
            found["pressure"] = number_request(self, " pressure", partial(pressure_of, self), acting=Acting(), mover=self.name)
        return found

    def formulas(self, written: Formulas) -> None:
        """Write its area, and its pressure where no circuit says it."""
        thrust, members = written.thrust(self), written.plan.members
        on_circuit = (one for each in written.plan.of_kind(Circuit).values() for one in each.members(members))
        if thrust is None or is_among(self, on_circuit):
            return
        area, _ = self.sides_written(written, thrust)
        written.line(f"p_{self.name}", thrust_along(self, thrust) / area, "bar")

    def area_written(self, written: Formulas) -> Array:
        area, _ = self.sides_written(written, np.ones(()))
        return -area if self.side == "rod" else area

    # -- checks --------------------------------------------------------------------------------------------

    def checks(self, motion: Motion, loads: Loads = None, *, case: Case = None, acting: Acting | None = None) -> list[Verdict]:
        """Return the verdicts over a motion of one design: length, standard size, and buckling where it carries a load."""
        judge = judge_of(motion, str(self), situation_of("checks", acting, loads=loads, case=case))
        return [*self.length_verdicts(judge), *self.size_verdicts(judge), *self.buckling_verdicts(judge)]

    def fits(self, motion: Motion) -> list[Verdict]:
        """Return whether its closed and its open length serve the motion, between its poses too; nothing where neither is given.

        With the stroke alone it is compared with the travel: largest less least distance of its pins.
        """
        unreached = f"{self}: no pose of this motion can be assembled, so that there is no length to check."
        return self.length_verdicts(judge_of(motion, str(self), unreached=unreached))

    def length_verdicts(self, judge: Judge) -> list[Verdict]:
        """Return the same over all that a judge looks at, and that no pins come together."""
        closed, stroke = (None if each is None else one_number(np.squeeze(each), "Length") for each in self.closed_and_stroke(judge.motion))
        ends = judge.answers(least_and_most(distance(self.A, self.B)))
        low, high = (float(each.value) for each in ends)
        if low < NO_LENGTH * high:
            text = said(
                "{pins} shrinks to nothing, {place}: its pins come together there, and no cylinder is so short; move them.",
                pins=self._pins, place=ends[0].place,
            )  # fmt: skip
            return [Verdict("length", False, text, answer=ends[0])]
        if closed is None and stroke is None:
            return []
        if np.isnan(low):
            return [Verdict("length", None, said("nothing is left to judge: every place is unlimited, left out or lost"), answer=ends[0])]
        if closed is not None:
            opened = closed + stroke if stroke is not None else np.inf
            asked, end = (least(distance(self.A, self.B)) >= closed, ends[0])
            if opened - high < low - closed:
                asked, end = most(distance(self.A, self.B)) <= opened, ends[1]
            reaches = self._reaches(judge, low, high, closed, opened)
            return [reaches.answered(replace(end, question=asked, ok=reaches.ok))]
        assert stroke is not None
        missing, way, given = high - low - stroke - TOLERANCE, show(high - low, "mm", ".1f"), show(stroke, "mm", ".1f")
        text = said("{pins} changes by {travel}, the stroke is {stroke}", pins=self._pins, travel=way, stroke=given)
        if missing > 0.0:
            text += translated(MISSING).format(missing=show_enough(missing, "mm", ".1f"))
        return [Verdict("length", missing <= 0.0, f"{text}.", answer=ends[1])]

    def is_placed(self, judge: Judge) -> bool:
        """Return whether its pins have a place anywhere that a judge looks at: a fixed one may have none in a design."""
        return bool(np.isfinite(judge.answer(least(distance(self.A, self.B))).value))

    @property
    def unplaced(self) -> str:
        """That its pins have no place, in words."""
        return said("{pins} has no length at any pose that is looked at: one of its pins has no place there.", pins=self._pins)

    def _reaches(self, judge: Judge, low: float, high: float, closed: float, opened: float) -> Verdict:
        faults, fitting = self._too_long(low, closed)
        missing = high - (fitting + opened - closed)
        if missing > TOLERANCE:
            shown = show_enough(missing - TOLERANCE, "mm", ".1f")
            open_too = said("{missing} are missing open", missing=shown)
            if faults:  # one that is shorter closed is shorter open, too
                own = show_enough(max(high - opened, 0.0), "mm", ".1f")
                open_too = said("{own} are missing open, {missing} with a shorter closed length", own=own, missing=shown)
            remedy = said("take a longer stroke")
            if high - fitting > fitting:
                remedy = said("no cylinder comes out by more than it is long closed: move its pins")
            faults.append(f"{open_too}: {remedy}")
        elif np.isfinite(opened) and opened - closed > fitting:
            stroke = show(opened - closed, "mm", ".1f")
            faults.append(said("it cannot come out by {stroke}, more than it is long closed: move its pins", stroke=stroke))
        says = said(
            "{pins} goes from {low} to {high}, the cylinder is {closed} long closed",
            pins=self._pins, low=shown_number(low, "mm", ".1f"), high=show(high, "mm", ".1f"), closed=show(closed, "mm", ".1f"),
        )  # fmt: skip
        out = said(" and {opened} open", opened=show(opened, "mm", ".1f")) if np.isfinite(opened) else ""
        return Verdict("length", not faults, f"{'; '.join([f'{says}{out}', *faults])}.")

    def _too_long(self, low: float, closed: float) -> tuple[list[str], float]:
        """Return whether it is too long closed, in words, and the closed length that its least length leaves it [m]."""
        if closed <= low + TOLERANCE:
            return [], closed
        much = show_enough(closed - low - TOLERANCE, "mm", ".1f")
        return [said("it is {much} too long closed: take one with a shorter closed length", much=much)], low

    def buckling(self, motion: Motion, loads: Loads = None, *, case: Case = None, acting: Acting | None = None) -> list[Verdict]:
        """Return whether a rod buckles at its largest utilisation: over every pose, load case and direction, one design.

        `case` names one load case; without it all that the machine declares are looked at, besides the plain one. Nothing where it
        carries nothing among these loads.
        """
        return self.buckling_verdicts(judge_of(motion, str(self), situation_of("buckling", acting, loads=loads, case=case)))

    def buckling_verdicts(self, judge: Judge) -> list[Verdict]:
        """Return whether it buckles over all that a judge looks at, and against a stop."""
        worst = judge.answer(most(buckling_request(self, Acting())) <= 1.0)
        if np.isnan(worst.value) or not worst.value > TO_ROUNDING:
            return [never_pushed().answered(worst) if worst.lost else never_pushed(), *self.stopped(judge)]
        with unwarned():  # the verdict itself says what comes of it
            place, acting = judge.there(worst), judge.situation(worst)
            forces = self.rod_push(place, acting), member_thrust(place, self, acting)
            push, total, length = map(float, (*forces, place.distance(self.A, self.B)))
            name, stage, sizes = self.slender_part(place, acting.direction)
            bar = Buckling(float(self.thickness(place, acting.direction)), self.mounting, self.safety)
        remedy, thicker = "", [{name: size} for size in sizes if size > bar.rod * (1.0 + 1e-9)]
        if not (worst.ok or worst.unbounded) and thicker and not can_be_set(judge, self, thicker[0]):
            remedy = said("; take a thicker one")
        elif not (worst.ok or worst.unbounded):  # the one of some sizes that holds wherever it runs; here a bar tells where to begin
            enough = bar.thicker(length, push)
            start = next((place for place, size in enumerate(thicker) if size[name] in enough), len(thicker))
            found = smallest(judge, self, thicker, start, lambda ram: [most(buckling_request(ram, Acting())) <= 1.0], worst)
            holds = None if found is None else found[0][name]
            remedy = bar.remedy_words(holds, is_bore_small=bool(enough), is_stage=name != "rod")
        given, where = {"thrust": show(total, "kN", 4), "n": self.count, "share": total / self.count / push}, worst.place
        if not worst.unbounded and push != total:
            where = said("{place} (thrust {thrust}, rods: {n}, efficiency {share:.3g})", place=where, **given)
        return [bar.judged(length, push, where, bool(worst.unbounded), stage=stage, remedy=remedy).answered(worst), *self.stopped(judge)]

    def stopped(self, judge: Judge) -> list[Verdict]:
        """Return the force with which a pump pushes it against a stop where it is longest, and how far that is from buckling."""
        longest = judge.answer(most(distance(self.A, self.B)))
        if np.isnan(longest.value):
            return []
        place = judge.there(longest)
        pushing = [(push, each.unit_in(judge)) for each in circuits_among(judge.plan.members) if (push := each.push_out(self, place))]
        if not pushing:
            return []
        ((pressure, whole), unit), times = max(pushing, key=lambda each: each[0]), f"{self.count} × " if self.count > 1 else ""
        bar = Buckling(float(self.thickness(place, "extending")), self.mounting, self.safety)
        force, limit = whole / self.count, float(bar.critical(longest.value))
        text = said(
            "Against a stop, which this rule leaves out, {ram} pushes with {force} at {pressure}, whatever its load. "
            "At its longest, {length}, it buckles at {limit}: safety {safety}.",
            ram=self.name or self, force=f"{times}{show(force, 'kN', 4)}", pressure=show(pressure, unit, 4),
            length=show(longest.value, "mm", 4), limit=f"{times}{show(limit, 'kN', 4)}", safety=shown_number(limit / force, "", 3),
        )  # fmt: skip
        if limit < force:
            text = f"{text} {said('Below 1 it buckles before the pump pushes so hard: keep it off that stop, or take a thicker rod.')}"
        return [Remark(text)]

    @takes_situation
    def buckling_use(self, motion: AnyMotion, loads: Loads = None, **situation: Unpack[ActingKeywords]) -> Array:
        """Return the utilisation of a rod, shape (...): a cylinder's push times the safety over the force at which it buckles; 0 in a pull.

        Without a direction it is the greatest of all in which something acts otherwise, as friction does; see `buckling` for the verdict.
        """
        acting = situation_of("buckling_use", loads=loads, **situation)
        if acting.direction is not None:
            return self._use(motion, acting)
        ways = DIRECTIONS if changes_in_motion(motion, acting.loads) and self.goes(motion, acting) is None else (None,)
        return reduce(np.maximum, [self._use(motion, replace(acting, direction=way)) for way in ways])

    def rod_push(self, motion: AnyMotion, acting: Acting) -> Array:
        """Return the push on one of its rods [N]: T / k_m while a pump pushes it out, which is assumed without a direction."""
        push = member_thrust(motion, self, acting) / self.count
        if acting.direction not in (None, AS_IT_RUNS, "extending"):
            return push
        motion = held_in_case(motion, acting)
        share: Array | float = 1.0
        for each in circuits_among(motion.plan.members):
            share = np.minimum(share, each.efficiency_out(self, motion))
        return np.asarray(push / share)[()]

    def _use(self, motion: AnyMotion, acting: Acting, *, below: bool = False) -> Array:
        """Return the utilisation in one direction, in a pull 0 or `below`."""
        push = self.rod_push(motion, acting)
        bar = Buckling(1.0, self.mounting, self.safety)
        length = motion.distance(self.A, self.B)
        if not is_traced(length):
            in_metres(np.nan_to_num(length), f"{self.name or self}: length between the ends", 2.0 * LONGEST)
        allowed = bar.critical_of(self.thickness(motion, acting.direction), length) / self.safety
        return push / allowed if below else np.where(push > 0.0, push / allowed, 0.0) + 0.0 * push

    @property
    def _pins(self) -> str:
        return body_name(label(end) for end in (self.A, self.B))


@immutable
class Cylinder(BarrelAndRod, Ram):
    """Equal cylinders side by side between A and B: `lift = Cylinder(A, B, bore=110 * mm, rod=60 * mm, count=2)`.

    It holds what the mechanism needs, as the drive of one stroke. One whose line gives its pressure has that force instead. Its chambers
    are `lift.piston_side` and `lift.rod_side`, the distance of its pins is `lift.length`. With masses or points on it, it is two bodies
    that slide in each other, `lift.barrel` on A and `lift.piston_rod` on B. Both are as long as it is closed, with the mass in the middle.

    Parameters
    ----------
    A, B : Point or str
        The pins of the barrel and of the rod.
    bore, rod : float or quantity
        The diameters [m], in a class the design variables `lift.bore` and `lift.rod`.
    count : int, optional
        How many cylinders there are, 1 by default.
    works : {"piston", "rod", "both"}, optional
        The side that the pressure acts on: "piston" pushes, "rod" pulls, "both" does what the load asks for. By default the side that an
        OilLine names, else the piston.
    stroke, closed : float or quantity, optional
        How far it comes out, and the distance of its pins drawn in [m]; design variables too where they are given.
    mounting : str, optional
        How its ends are held against buckling, "pin-pin" by default.
    safety : float, optional
        The factor asked for against buckling, 3.5 by default.
    barrel_mass, rod_mass : float or quantity, optional
        The masses of one cylinder [kg].
    max_speed : float or quantity, optional
        What its seals allow, for paths in time [m/s].

    Raises
    ------
    DefinitionError
        A size is not above zero, the rod is not thinner than the bore, or a word is not known.
    """

    A: Reference
    B: Reference
    bore: Parameter
    rod: Parameter
    count: int = 1
    works: Literal["piston", "rod", "both"] | None = None
    stroke: Parameter | None = None
    closed: Parameter | None = None
    mounting: str = "pin-pin"
    safety: float = 3.5
    barrel_mass: Parameter | None = None
    rod_mass: Parameter | None = None
    max_speed: Parameter | None = None
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({
        "bore": "mm", "rod": "mm", "stroke": "mm", "closed": "mm", **MASSES, "max_speed": "mm/s",
    })  # fmt: skip
    not_negative: ClassVar[frozenset[str]] = frozenset(parameters)
    optional: ClassVar[frozenset[str]] = frozenset(parameters) - {"bore", "rod"}
    inside: ClassVar[Mapping[str, str]] = MappingProxyType({
        "length": "quantity", "piston_side": "chamber", "rod_side": "chamber", **HELD,
    })  # fmt: skip
    _on_lines: ClassVar[Works | None] = None
    """What lines say that it works with, where they do; told by the class that it is in."""

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.works is not None:
            known_name("Side", self.works, (*SIDES, "both"), where="works")
        size = CylinderSize(2.0, 1.0, self.count, self.side) if follows(self.bore, self.rod) else self.size
        Buckling(1.0, self.mounting, self.safety)
        for name, what in LENGTHS.items():
            value = getattr(self, name)
            if value is not None and not follows(value):
                stroke_in_metres(one_number(value, what), what, None if follows(self.bore, self.rod) else size.bore)

    def _check_number(self, name: str) -> None:
        if name not in LENGTHS:  # those are looked at beside the bore, in words of their own
            super()._check_number(name)

    # -- its sides -----------------------------------------------------------------------------------------

    @property
    def side(self) -> Works:
        """The sides it works with: as its lines tell, else as declared, else the piston."""
        return self._on_lines or self.works or "piston"

    @property
    def rod_side(self) -> Chamber:
        """The chamber around its rod, for an OilLine."""
        return Chamber(self, "rod")

    def among(self, members: NamedMembers) -> Cylinder:
        """Return it with the sides that the lines of its class give; DefinitionError where it declares another side itself.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        Cylinder
            The cylinder.

        Raises
        ------
        DefinitionError
            It declares another side than its lines.
        """
        found, others = works_by_lines(self, members), lines_of(self, members)
        both = (each for each in circuits_among(members) if each.has_both_sides(members))
        if not others and self.works is None and any(self.name in map(label, each.references) for each in both):
            found = "both"
        beside = self.works in SIDES and all(line.kind_in(members) == "given" and each.side != self.works for line, each in others)
        if found is None or beside:  # a tank or gas on its other side leaves the side that it says to a pump
            return self
        if self.works is not None and self.works != found:
            what = f"{self.name} says works={self.works!r}, and its lines say that it works with {SIDE_WORDS[found]}"
            raise DefinitionError(f"{what}; leave works= out.", member=self.name)
        return self.renewed(_on_lines=found)

    # -- its size ------------------------------------------------------------------------------------------

    @property
    def size(self) -> CylinderSize:
        """The size as it is written here; DefinitionError where a bore or rod follows something else."""
        if follows(self.bore, self.rod):
            raise DefinitionError(f"{self}: its size follows the design; ask for sized(motion).")
        return CylinderSize(cast("float | Array", self.bore), cast("float | Array", self.rod), self.count, self.side)

    def sized(self, motion: Poses, direction: str | None = None) -> CylinderSize:
        """Return the size that a motion's designs have; bore and rod [m] broadcast against the motion.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        direction : str, optional
            "extending" while the stroke grows, "retracting", or "frictionless".

        Returns
        -------
        CylinderSize
            The size.
        """
        bore, rod = number_set(self, motion, "bore"), number_set(self, motion, "rod")
        return CylinderSize(bore[()], rod[()], self.count, self.side if self._on_lines else as_in(motion.plan, self).side)

    def on_side(self, side: Side) -> Cylinder:
        """Return it as it works with one of its sides, for the line that this has.

        Parameters
        ----------
        side : str
            "piston" or "rod".

        Returns
        -------
        Cylinder
            The cylinder.
        """
        return self.renewed(_on_lines=side)

    def filled(self, side: Side, motion: Poses, start: Array, end: Array) -> Array:
        return np.asarray((end - start) * chamber_area(Chamber(self, side), self, motion))[()]

    def filled_written(self, side: Side, start: Quantity, end: Quantity) -> Quantity:
        return self._square_written(side) * (end - start)

    def length_written(self, sides: Sequence[Side], start: Quantity, oil: Quantity) -> Quantity:
        return start + oil / reduce(add, map(self._square_written, sides))

    def _square_written(self, side: Side) -> Quantity:
        """Return the signed area of a chamber over that of a circle of diameter 1, as a quantity of its class."""
        square = self.written("bore") ** 2
        square = square if side == PISTON else self.written("rod") ** 2 - square
        return square if self.count == 1 else square * float(self.count)

    def thickness(self, motion: Poses, direction: str | None = None) -> float | Array:
        return self.sized(motion).rod

    def length_set(self, name: str, motion: Poses, *, beside_bore: bool = False) -> Array:
        bore, what = self.sized(motion).bore if beside_bore else None, LENGTHS[name]
        return stroke_in_metres(number_set(self, motion, name), what, bore)

    def offers(self, thrust: float, pressure: float, length: float | None = None) -> list[CylinderSize]:
        """Return the standard sizes that give a thrust [N] at a pressure: the smallest bore, each rod that suits.

        With a `length` between the pins [m] only rods that do not buckle under a positive thrust. DefinitionError where no bore is enough.

        Parameters
        ----------
        thrust : float
            The thrust [N].
        pressure : float
            The pressure [Pa].
        length : float, optional
            The length between the pins [m].

        Returns
        -------
        list of CylinderSize
            The sizes.

        Raises
        ------
        DefinitionError
            No bore is enough.
        """
        if length is not None:
            one_number(length, "Length between the ends", "length")
        thin = CylinderSize(self.size.bore, min(float(self.size.rod), chosen_series().rods[0]), self.count, self.side)
        bore = float(thin.sized_for(thrust, pressure).bore)
        sizes = [CylinderSize(bore, rod, self.count, self.side) for rod in standard_rods(bore)]
        pulls = self.side == "both" and thrust < 0.0
        enough = [size for size in sizes if float(size.pull_area if pulls else size.area) * pressure >= abs(thrust)]
        push = max(thrust, 0.0) / self.count
        return [size for size in enough if length is None or Buckling(float(size.rod), self.mounting, self.safety).allowed(length) >= push]

    def sizes_made(self, name: str) -> Sequence[float]:
        series = chosen_series()
        return series.bores if name == "bore" else series.rods if name == "rod" else ()

    def larger(self, motion: Poses) -> list[Sizes]:
        (own, thick), series = self.sized(motion).single, chosen_series()
        bores = [bore for bore in series.bores if bore > own * (1.0 + 1e-9)]
        if self.side != "regenerative":
            return [{"bore": bore} for bore in bores]
        found: list[Sizes] = []
        for rod in (each for each in series.rods if each > thick * (1.0 + 1e-9)):
            wide = next((bore for bore in (own, *bores) if series.is_pair(bore, rod)), 0.0)
            found += [{"rod": rod} if wide == own else {"bore": wide, "rod": rod}] if wide else []
        return found

    # -- what it says --------------------------------------------------------------------------------------

    def sides_written(self, written: Formulas, thrust: Array) -> tuple[Array, Array]:
        bore, rod = self.number(written, "bore"), self.number(written, "rod")
        piston, annulus = (self.count * written.pi / 4.0 * each for each in (bore**2, bore**2 - rod**2))
        if self.side == "regenerative":
            working, other = self.count * written.pi / 4.0 * rod**2, np.zeros(())
        elif self.side == "both":
            pulls = thrust < 0.0
            working, other = np.where(pulls, annulus, piston), np.where(pulls, piston, annulus)
        else:
            working, other = (annulus, piston) if self.side == "rod" else (piston, annulus)
        return written.line(f"A_{self.name}", working, "m2"), other

    def standard(self, motion: Poses | None = None) -> Verdict:
        """Return whether bore and rod are a pair of ISO 3320 or NFPA T3.6.7; if not, the sizes next to them.

        Parameters
        ----------
        motion : Motion, optional
            The motion whose designs are checked.

        Returns
        -------
        Verdict
            The verdict.
        """
        bore, rod = (self.size if motion is None else self.sized(motion)).single
        return standard_verdict(self.name or said("cylinder"), bore, rod)

    def _stage_remarks(self, judge: Judge) -> list[Remark]:
        """Return a remark where no cylinder of one stage is as short and as long as its pins ask, if its closed length is not given.

        Source: geometry. Closed, the barrel holds the stroke, the piston and the gland; these two together are at least a bore long.
        """
        low, high = (float(each.value) for each in judge.answers(least_and_most(distance(self.A, self.B))))
        most_open = 2.0 * low - float(np.min(self.sized(judge.motion).bore))
        if self.closed is not None or low < NO_LENGTH * high or not high > most_open + TOLERANCE:
            return []
        text = said(
            "{pins} goes from {low} to {high}: a cylinder of one stage that is so short closed opens to less than {most}; move its pins, "
            "or take a Telescope.",
            pins=self._pins, low=shown_number(low, "mm", ".1f"), high=show(high, "mm", ".1f"), most=show(max(most_open, low), "mm", ".1f"),
        )  # fmt: skip
        return [Remark(text)]

    def size_verdicts(self, judge: Judge) -> list[Verdict]:
        """Return whether it is of a standard size, and a note where the load is against the side that works, which no line says.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        list of Verdict
            The verdicts.
        """
        own = [self.standard(judge.motion), *self.speed_verdicts(judge), *self._stage_remarks(judge)]
        found = self.pressed_wrongly(judge) if self._is_bare(judge) else None
        if found is None:
            return own
        given = {"name": self.name, "force": force_words(found), "where": found.place}
        text = said('the load pushes {name} with {force}, {where}: its rod side holds no push; say works="both" or "piston".', **given)
        if self.side == PISTON:
            text = said('the load pulls {name} with {force}, {where}: its piston side holds no pull; say works="both" or "rod".', **given)
        return [*own, Verdict("side", None, text, answer=found)]

    def speed_verdicts(self, judge: Judge) -> list[Verdict]:
        """Return whether it is nowhere faster than its seals allow, over the paths in time that a judge looks at.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        list of Verdict
            The verdicts.
        """
        limit = np.inf if self.max_speed is None else one_design(number_set(self, judge.motion, "max_speed"))
        answer = over_time(judge, most(abs(rate_request(self.name))) <= limit) if limit < np.inf else None
        if answer is None:
            return []
        speed = show(answer.value, "mm/s", 4, None if answer.ok else limit)
        shown = {"name": self.name, "limit": show(limit, "mm/s", 4), "speed": speed, "where": answer.place}
        if answer.ok is False:
            text = said("{name} moves with {speed}, {where}; its seals allow {limit}. Run slower there, or take other seals.", **shown)
        elif answer.value <= TO_ROUNDING * limit:
            text = said("{name} stands still over the paths in time.", name=self.name)
        else:
            text = said("{name} moves with up to {speed}, {where}; its seals allow {limit}.", **shown)
        return [Verdict("speed", answer.ok, text, answer=answer)]

    def questions(self, judge: Judge) -> list[Question]:
        """Return the questions of any ram, and whether the load is on the working side where no line tells it.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        list
            The questions.
        """
        return [*super().questions(judge), *([self.pressed(self, judge)] if self._is_bare(judge) else [])]

    def _is_bare(self, judge: Judge) -> bool:
        """Return whether it works with one side, carries loads, and no line or circuit has it."""
        return self.side in SIDES and not lines_of(self, judge.plan.members) and self._is_alone(judge)

    def slender_part(self, motion: Poses, direction: str | None = None) -> tuple[str, int, Sequence[float]]:
        bore, _ = self.sized(motion).single
        return "rod", 0, standard_rods(bore)


@immutable
class AllOf(Condition):
    """Several conditions as one: the worst counts."""

    each: tuple[Condition, ...]

    def constraints(self, machine: Any) -> tuple[Constraint, ...]:
        return tuple(one for condition in self.each for one in condition.constraints(machine))

    def __str__(self) -> str:
        return " and ".join(map(str, self.each))


# What is asked of one cylinder.


Values = TypeVar("Values")
Own = TypeVar("Own", bound=ForceElement)


def rate_request(cylinder: str) -> LawRequest:
    """Return the request for how fast a cylinder extends while a machine runs [m/s]."""

    def over(motion: AnyMotion) -> Array:
        return cylinder_in(cylinder, motion.plan).growth(motion, own_rates(motion, f"rate({cylinder})"))

    examine = partial(cylinder_in, cylinder)
    return LawRequest(formula=over, text=f"rate({cylinder})", known=("rate", cylinder), measures="speed", examine=examine)


def number_request(element: ForceElement, word: str, formula: Callable[..., Array], **more: Any) -> LawRequest:
    """Return the request for a number of a cylinder or a line, traced once in its class."""
    text = f"{element.name}{word}"
    return LawRequest(text=text, formula=formula, known=("number", text) if element.name else None, **more)


CylinderLaw: TypeAlias = Callable[[AnyMotion, Ram, Acting], Array]
"""A formula of one cylinder over the poses of a motion, in a situation [SI]."""
Options: TypeAlias = tuple[Hashable, ...]
"""What stands in a request's text and tells it from others."""


def cylinder_request(
    word: str, cylinder: str | Ram, acting: Acting, formula: CylinderLaw, before: Options = (), after: Options = (), *, measures: str = ""
) -> LawRequest:
    """Return the request for a formula of one cylinder of a class, in a situation; its directions are the cylinder's own.

    It is written as a function, `word`, of the cylinder, of what stands `before` and `after` the direction, and of the load case. It is
    in no load case that leaves out the lines of the cylinder, so that this may carry nothing.
    """
    named = name_of(cylinder, is_needed=False) or cylinder

    def text(acting: Acting) -> str:
        return request_text(word, [str(each) for each in (named, *before, acting.direction, *after) if each is not None], acting)

    def cases_in(plan: Plan, case: str) -> bool:
        ram = cylinder_in(named, plan)
        feeding = {name for name, each in elements_of(plan, None) if is_among(ram, each.feeds(plan.members))}
        return not feeding or not feeding.isdisjoint(each.name for each in applied_elements(plan, Acting(case=case)))

    return LawRequest(
        formula=partial(formula_of_cylinder, formula, named), text=text, known=(word, named, before, after), acting=acting,
        measures=measures, mover=named, examine=partial(cylinder_in, named), cases_in=cases_in,
    )  # fmt: skip


def formula_of_cylinder(formula: Callable[[AnyMotion, Ram, Acting], Values], named: str | Ram, motion: AnyMotion, acting: Acting) -> Values:
    """Return a formula's value of the named cylinder, as the motion's class has it."""
    return formula(motion, cylinder_in(named, motion.plan), acting)


def cylinder_in(named: str | Ram, plan: Plan) -> Ram:
    """Return the cylinder that is meant, as a plan has it; DefinitionError where there is none of that name."""
    return found_in(plan.members, named, plan.title) if isinstance(named, str) else named


def thrust_request(cylinder: str | Ram, acting: Acting) -> LawRequest:
    """Return the request for a cylinder's thrust [N]; its text leaves out that there is no friction."""
    found = cylinder_request("thrust", cylinder, acting, member_thrust, measures="force")

    def text(acting: Acting) -> str:
        return str(replace(found, acting=replace(acting, direction=None) if acting.direction == FRICTIONLESS else acting))

    return replace(found, text=text)


def buckling_request(cylinder: str | Ram, acting: Acting, *, below: bool = False) -> LawRequest:
    """Return the request for how far a cylinder's rod is used against buckling; `below` zero it goes on in a pull.

    It is judged in the direction in which the rod is pushed hardest where that is known: while a pump pushes it out with losses.
    """

    def use(motion: AnyMotion, ram: Ram, acting: Acting) -> Array:
        return ram._use(motion, acting, below=True) if below else ram.buckling_use(motion, acting=acting)

    def directions(plan: Plan) -> tuple[str, ...] | None:
        ram = cylinder_in(cylinder, plan)
        return ("extending",) if any(each.loses_out(ram, plan) for each in circuits_among(plan.members)) else None

    def pieces(request: LawRequest, plan: Plan) -> tuple[SmoothPiece, ...]:
        return in_stages(cylinder, plan, SmoothPiece(request, below=buckling_request(cylinder, request.situation, below=True)))

    found = cylinder_request("buckling", cylinder, acting, use, after=("below zero" if below else None,), measures="number")
    return replace(found, pieces_in=pieces, directions=directions)


def in_stages(cylinder: str | Ram, plan: Plan, *pieces: SmoothPiece) -> tuple[SmoothPiece, ...]:
    """Return smooth pieces as one for each stage of a telescope that one of several strokes moves, with no value in the other stages.

    Along one stroke a jump from stage to stage is looked at from both sides as it is.
    """
    ram = cylinder_in(cylinder, plan)
    if ram.stages == 1 or len(plan.strokes) < 2:
        return pieces

    def staged(request: LawRequest | None, stage: int) -> LawRequest | None:
        return None if request is None else in_stage(request, cylinder, stage)

    return tuple(
        replace(each, request=staged(each.request, stage), reciprocal=staged(each.reciprocal, stage), below=staged(each.below, stage))
        for each in pieces for stage in range(1, ram.stages + 1)
    )  # fmt: skip


def in_stage(request: LawRequest, cylinder: str | Ram, stage: int) -> LawRequest:
    """Return a request of a telescope where one of its stages moves, with no value and no bound elsewhere."""

    def values(motion: AnyMotion, acting: Acting) -> Array:
        there = cylinder_in(cylinder, motion.plan).is_in_stage(motion, stage, acting.direction)
        return only_where(there, request.formula(motion, acting))

    def text(acting: Acting) -> str:
        return f"{replace(request, acting=acting)} in stage {stage}"

    def unlimited(motion: Motion, acting: Acting) -> Mask:
        elsewhere = motion.reached & ~cylinder_in(cylinder, motion.plan).is_in_stage(motion, stage, acting.direction)
        return np.asarray(elsewhere if request.unlimited_in is None else elsewhere | request.unlimited_in(motion, acting))

    known = None if request.known is None else (request.known, "stage", stage)
    return replace(request, formula=values, text=text, known=known, pieces_in=None, unlimited_in=unlimited)


Reading: TypeAlias = Callable[[AnyMotion], Array]
"""A number of a cylinder over the poses of a motion [SI]."""


def force_words(found: Answer) -> str:
    """Return how great the force of an answer is, in words."""
    return said("a force without bounds") if found.unbounded else said("up to {thrust}", thrust=show(abs(found.value), "kN", 4))


def thrust_along(cylinder: Ram, thrust: Array) -> Array:
    """Return a thrust in the direction in which the working side pushes or pulls [N]."""
    return np.abs(thrust) if cylinder.side == "both" else -thrust if cylinder.side == "rod" else thrust


def pressure_of(cylinder: Ram, motion: AnyMotion, acting: Acting) -> Array:
    """Return a cylinder's pressure by the circuit that has it; without one, of a pump without losses."""
    require_poses(motion)
    held = motion_of_whole(motion, cylinder)
    if held is not None:
        return pressure_of(held[1], held[0], acting)
    motion = held_in_case(motion, acting)
    by_side = lines_by_side(cylinder, motion.plan)
    if by_side:
        return reduce(np.maximum, [line.pressure_in(cylinder, motion, acting) for line in by_side])
    circuit = circuit_having(cylinder, motion.plan)
    if circuit is not None:
        return circuit.pressure_in(cylinder, motion, acting)
    return np.maximum(cylinder.sized(motion, acting.direction).pressure_for(line_thrust(cylinder, None, motion, acting)), 0.0)


def most_of_side(cylinder: Ram, motion: AnyMotion, acting: Acting) -> Array:
    """Return the highest pressure [Pa] of the line that holds a cylinder which each side has on a line of its own."""
    first, second = lines_by_side(cylinder, motion.plan)
    limits = [line.gauges_of(cylinder, motion.plan)["most"](motion) for line in (first, second)]
    holds = first.pressure_in(cylinder, motion, acting) >= second.pressure_in(cylinder, motion, acting)
    return np.where(holds, limits[0], limits[1])


def circuit_having(cylinder: Ram, plan: Declared, is_needed: bool = True) -> Circuit | None:
    """Return the circuit that gives a cylinder its pressure, the one that feeds it first; DefinitionError where several have it.

    None where it is not needed and not plain.
    """
    members, mine = plan.members, circuits_of(cylinder, plan)
    feeding = [each for each in mine if is_among(cylinder, each.feeds(members))]
    if len(mine) > 1 and not feeding and not is_needed:
        return None
    if len(mine) > 1 and not feeding:
        names = ", ".join(each.name for each in mine)
        word = "pressure_for" if mine[0].kind_in(plan.members) == "held" else "pressure"
        remedy = f"name one: {mine[0].name}.{word}(motion)"
        raise DefinitionError(f"{plan.title}: {cylinder.name} is on {len(mine)} circuits, {names}; {remedy}.")
    return next(iter((*feeding, *mine)), None)


def circuits_of(cylinder: Ram, plan: Declared) -> list[Circuit]:
    """Return the circuits of a class that have a cylinder's working side, which its lines there may tell."""
    cylinder = as_in(plan, cylinder)
    found = [each for each in plan.of_kind(Circuit).values() if is_among(cylinder, each.members(plan.members))]
    other = [line for line, chamber in lines_of(cylinder, plan.members) if chamber.side != cylinder.side and cylinder.side in SIDES]
    return [each for each in found if not is_among(each, other)] if other else found


def lines_by_side(cylinder: Ram, plan: Declared) -> list[Circuit]:
    """Return the lines of pumps that have one side each of a cylinder that works with both; none where it is fed otherwise."""
    own = circuits_of(cylinder, plan)
    sides = [each.as_worked(as_in(plan, cylinder), plan.members).side for each in own]
    return own if sorted(sides) == sorted(SIDES) else []


Feeds: TypeAlias = "Reference | Sequence[Reference]"
"""The cylinders of a circuit: one, or a list."""


class OnLines(LawElement):
    """The base of oil lines and their parts: they act on cylinders, put no force on points, and no load case multiplies them."""

    places: ClassVar[tuple[str, ...]] = ()
    file_section: ClassVar[str] = "hydraulics"

    @property
    def scales(self) -> bool:
        return False

    def holds_line(self, line: Circuit) -> bool:
        """Return whether it is a valve that holds a line; the load then goes down over it.

        Parameters
        ----------
        line : Circuit
            The line.

        Returns
        -------
        bool
            Whether it does.
        """
        return False

    def pressure_lowering(self, line: Circuit, cylinder: Ram, motion: AnyMotion, acting: Acting) -> Array | None:
        """Return the pressure of a line while a cylinder goes down over it [Pa gauge]; None where it does not go down over it.

        Parameters
        ----------
        line : Circuit
            The line.
        cylinder : Ram
            The cylinder.
        motion : Motion
            The poses.
        acting : Acting
            The situation: loads, load case, direction and rates.

        Returns
        -------
        array, optional
            The pressure.
        """
        return None


class Circuit(OnLines, HasVerdicts):
    """The base of circuits, which feed cylinders."""

    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType({"cylinder": "load"})
    headed: ClassVar[str] = noted("Line {name}")
    named_in_all: ClassVar[bool] = True
    _is_shut: ClassVar[bool] = False
    """Whether a load case shuts it; told by the case."""

    def __post_init__(self) -> None:
        super().__post_init__()
        for each in self.references:
            if not is_named(each) and not isinstance(each, Ram):
                raise DefinitionError(f"{type(self).__name__}: {cited(each)} is no Cylinder; name one.")

    cylinder: Feeds

    @property
    def references(self) -> tuple[Reference, ...]:
        """Its cylinders, as they were given."""
        given = self.cylinder
        return tuple(given) if is_listed(given) else (cast(Reference, given),)

    @property
    def cylinder_names(self) -> str:
        """Its cylinders as they are written: a name, or a list of names."""
        names = ", ".join(map(label, self.references))
        return f"[{names}]" if len(self.references) > 1 else names

    def joined(self, members: NamedMembers) -> tuple[ForceElement, ...]:
        return self.members(members) if self.kind_in(members) == "held" and self.tie(members) is None else ()

    def tie(self, members: NamedMembers) -> Tie | None:
        """Return how its pressure acts where it is given by itself, and a load case shuts it: beside a pump's line it joins that."""
        if not self._is_shut or self.kind_open(members) != "given":
            return None
        own = self.members(members)
        beside = (line for line in circuits_among(members) if any(is_among(ram, own) for ram in line.members(members)))
        kinds = {line.kind_open(members) for line in beside if not same(line, self)}
        return None if "held" in kinds and "closed" not in kinds else Tie(self.name, self.pressure_shares(members), held=True)

    def rams(self, motion: Poses) -> tuple[Ram, ...]:
        """Return its cylinders, as the motion's class has them.

        Parameters
        ----------
        motion : Motion
            The poses.

        Returns
        -------
        tuple of Ram
            The cylinders.
        """
        return tuple(the_cylinder(motion, each) for each in self.references)

    def ram(self, motion: Poses) -> Ram:
        """Return its only cylinder; DefinitionError where it has several."""
        return self.one(motion, None)

    def one(self, motion: Poses, cylinder: Reference | None) -> Ram:
        """Return the cylinder that is meant: its only one, or the one named; DefinitionError where that leaves a choice."""
        rams = self.rams(motion)
        if cylinder is None and len(rams) == 1:
            return rams[0]
        names = ", ".join(each.name or str(each) for each in rams)
        named = [each for each in rams if cylinder is not None and (each is cylinder or (each.name and each.name == name_of(cylinder)))]
        ensure(named, f"{self.name or 'The circuit'} has the cylinders {names}; say cylinder= one of them.")
        return named[0]

    def parts(self) -> tuple[Reference, ...]:
        return (*(each for each in self.references if is_named(each)), *super().parts())

    @property
    def chambers(self) -> tuple[Chamber, ...]:
        """The sides of cylinders that it names."""
        return ()

    @property
    def bare(self) -> tuple[Reference, ...]:
        """The cylinders that it names without a side: that which works."""
        return self.references

    def chambers_of(self, cylinder: Ram, members: NamedMembers) -> tuple[Chamber, ...]:
        """Return the chambers of a cylinder that it names, among the members of its class."""
        return tuple(each for each in self.chambers if name_of(each.cylinder) == cylinder.name)

    def kind_in(self, members: NamedMembers) -> str:
        """Return the kind of its line, among the members of its class: one of KINDS. A shut one keeps the oil that it has: it is held."""
        kind = self.kind_open(members)
        return "held" if self._is_shut and kind == "given" else kind

    def kind_open(self, members: NamedMembers) -> str:
        """Return the kind of its line while no load case shuts it.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        str
            The kind.
        """
        return "held"

    def pump(self, members: NamedMembers) -> OnLines | None:
        """Return the pump on it that may be on others, too; None where it has its own numbers or none.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        Pump, optional
            The pump.
        """
        return None

    def has_both_sides(self, members: NamedMembers) -> bool:
        """Return whether it is on both sides of the cylinders that it names, whatever these say.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        bool
            Whether it is.
        """
        return False

    @property
    def is_drained(self) -> bool:
        """Whether a tank gives its pressure."""
        return False

    def has_gas(self, members: NamedMembers) -> bool:
        """Return whether accumulators lie beside its pump, which take oil as its pressure rises.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        bool
            Whether they do.
        """
        return False

    def when_shut(self) -> Self:
        return self if self._is_shut else self.renewed(_is_shut=True)

    def filling(self, members: NamedMembers) -> list[tuple[Ram, Chamber]]:
        """Return the chambers on its line with their cylinders, as the class has them: of each the side that works."""
        sides = [(ram, SIDES if ram.side not in SIDES else (ram.side,)) for ram in self.members(members)]
        return [(ram, Chamber(ram, side)) for ram, own in sides for side in own]

    def volume(self, motion: Poses, start: Callable[[Ram], Array] | None = None) -> Array:
        """Return how much larger its chambers are than at some lengths of its cylinders, accumulators beside a pump included.

        Parameters
        ----------
        motion : Motion
            The poses.
        start : callable, optional
            The length of a cylinder at which it counts from [m]; 0 by default.

        Returns
        -------
        array
            The volume [m3], shape (...).
        """
        chambers = ((ram, each.side, motion.distance(ram.A, ram.B)) for ram, each in self.filling(motion.plan.members))
        lengths = ((ram, side, np.zeros(()) if start is None else start(ram), end) for ram, side, end in chambers)
        return reduce(np.add, [ram.filled(side, motion, begin, end) for ram, side, begin, end in lengths])

    def pressure_shares(self, members: NamedMembers) -> tuple[Share, ...]:
        """Return the share of its line's pressure in each cylinder."""
        return tuple(Share(ram, partial(chamber_area, chamber, ram)) for ram, chamber in self.filling(members))

    def least(self, motion: Poses) -> Array | float:
        """Return the least pressure of its line [Pa]."""
        return 0.0

    def line_pressure(self, motion: Any, acting: Acting | None = None) -> Array:
        """Return the pressure of its line, where that is one for all its cylinders, shape (...) [Pa gauge].

        Parameters
        ----------
        motion : Motion
            The poses.
        acting : Acting, optional
            The situation; by default the machine's own loads without friction.

        Returns
        -------
        array
            The pressure.
        """
        raise DefinitionError(f"{self.name} = {self}: its pressure is asked of a cylinder, {self.name}.pressure_for(motion).")

    def fills(self, name: str) -> bool:
        """Return whether it says how long a cylinder is where it is filled.

        Parameters
        ----------
        name : str
            The name of the cylinder.

        Returns
        -------
        bool
            Whether it does.
        """
        return False

    def length_given(self, chamber: Chamber, members: NamedMembers) -> Quantity:
        """Return the length that a closed line gives one of its cylinders [m]."""
        raise DefinitionError(f"{self.name} = {self} is not closed, and gives no length.")

    def examine(self, members: NamedMembers, title: str) -> None:
        for each in self.references:
            if is_named(each):
                found_in(members, each, f"{title}.{self.name}")

    def members(self, members: NamedMembers) -> tuple[Ram, ...]:
        """Return its cylinders, as a class has them.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        tuple of Ram
            The cylinders.
        """
        title = self.name or type(self).__name__
        found = (found_in(members, each, title) if is_named(each) else each for each in self.references)
        return tuple(each for each in found if isinstance(each, Ram))

    def as_worked(self, cylinder: Ram, members: NamedMembers) -> Ram:
        """Return one of its cylinders as it works by this line: of one that works with both sides, with the side that this one has."""
        return cylinder

    def gauges_of(self, cylinder: Ram, plan: Plan) -> dict[str, Reading]:
        """Return its limits for one of its cylinders on a live page: the `most` pressure it may have [Pa]."""
        return {}

    @abstractmethod
    def pressure_in(self, cylinder: Ram, motion: AnyMotion, acting: Acting) -> Array:
        """Return the pressure on the working side of one of its cylinders, shape (...) [Pa gauge].

        Parameters
        ----------
        cylinder : Ram
            The cylinder.
        motion : Motion
            The poses.
        acting : Acting
            The situation: loads, load case, direction and rates.

        Returns
        -------
        array
            The pressure.
        """

    def pressure_behind(self, cylinder: Ram, motion: AnyMotion, acting: Acting) -> Array:
        """Return the pressure on the other sides of its cylinders that gives all they ask for, shape (...) [Pa gauge].

        Parameters
        ----------
        cylinder : Ram
            One of its cylinders, whose other side has it.
        motion : Motion
            The poses.
        acting : Acting
            The situation: loads, load case, direction and rates.

        Returns
        -------
        array
            The pressure, below zero where its own side holds.
        """
        return line_thrust(cylinder, self, motion, acting) / chamber_area(Chamber(cylinder, other_side(cylinder) or ROD), cylinder, motion)

    def bounds_of(self, cylinder: Reference, motion: Poses, lifting: bool, *, share: float = 1.0) -> tuple[Array, Array]:
        """Return between which two thrusts [N] it lets one of its cylinders stand; unbounded unless it says so."""
        return UNBOUNDED

    def unit_in(self, judge: Judge) -> str:
        """Return the unit in which its pressures are shown."""
        return "bar"

    def loses_out(self, cylinder: Ram, plan: Declared) -> bool:
        """Return whether the mechanical efficiency of its pump counts while that pushes a cylinder out."""
        return False

    def efficiency_out(self, cylinder: Ram, motion: AnyMotion) -> Array | float:
        """Return the mechanical efficiency with which its pump pushes a cylinder out; 1 where none does."""
        return 1.0

    def push_out(self, cylinder: Ram, motion: Motion) -> tuple[float, float] | None:
        """Return the highest pressure [Pa gauge] and thrust [N] with which it pushes a cylinder out at a pose; None where no pump does."""
        return None

    def use_of(self, cylinder: Ram, motion: AnyMotion, acting: Acting) -> Array | None:
        """Return the needed rod force of one of its cylinders over the greatest, shape (...); None where no pump feeds it."""
        return None


# Lines and chambers.


def as_in(plan: Declared, each: Own) -> Own:
    """Return a cylinder or a line as a plan has it, such as shut; itself where it has none of its name."""
    found = plan.members.get(each.name) if each.name else None
    return found if isinstance(found, type(each)) else each


def lines_of(cylinder: Ram, members: NamedMembers, kind: str = "") -> list[tuple[Circuit, Chamber]]:
    """Return the chambers of a cylinder that lines name, each with its line; those of one of the KINDS on request."""
    lines = (line for line in circuits_among(members) if not kind or line.kind_in(members) == kind)
    return [(line, each) for line in lines for each in line.chambers_of(cylinder, members)]


def circuits_among(members: NamedMembers) -> list[Circuit]:
    """Return the circuits and oil lines of a class."""
    return [*of_kind(members, Circuit).values()]


def side_left(cylinder: Ram, members: NamedMembers) -> Works:
    """Return the side of a cylinder that no line names, where another one is named; else the sides it works with."""
    named = [each.side for line in circuits_among(members) for each in Circuit.chambers_of(line, cylinder, members)]
    left = [side for side in SIDES if side not in named]
    return left[0] if named and left else cylinder.side


def works_by_lines(cylinder: Ram, members: NamedMembers) -> Works | None:
    """Return the sides that lines name for a cylinder; None where they name none.

    Sides on held lines come first, then those on closed ones, then those whose pressure is given.
    """
    named = lines_of(cylinder, members)
    if not any(Circuit.chambers_of(line, cylinder, members) for line, _ in named):
        return None
    of_lines = [each for each, _ in named]
    if any(cylinder.name in map(label, each.bare) and each not in of_lines for each in circuits_among(members)):
        return None  # a circuit that names the cylinder alone is on the side that it says to work with
    working = next(filter(None, (lines_of(cylinder, members, kind) for kind in KINDS)))
    if len(working) == 1:
        return working[0][1].side
    return "regenerative" if working[0][0] is working[1][0] else "both"


def by_other_lines(ram: Ram, line: Circuit | None, motion: AnyMotion, acting: Acting | None, tanks: bool | None = None) -> Array | float:
    """Return the thrust of the other lines on a cylinder over a motion's poses [N].

    Without a situation only lines whose pressure is given count. `tanks`: those of tanks alone, or all but those.
    """
    motion = held_in_case(motion, acting)
    members = motion.plan.members
    thrust: Array | float = 0.0
    for other, chamber in lines_of(ram, members):
        kind = other.kind_in(members)
        if tanks is not None and tanks is not (kind == "given" and other.is_drained):
            continue
        if (line is None or not same(other, line)) and (kind == "given" or (kind == "closed" and acting is not None)):
            thrust = thrust + other.line_pressure(motion, None if kind == "given" else acting) * chamber_area(chamber, ram, motion)
    return thrust


def over_valves(line: Circuit, ram: Ram, motion: AnyMotion, acting: Acting, otherwise: Array) -> Array:
    """Return the pressure of a line while a cylinder goes down over a holding valve, over a path in time where it does [Pa gauge]."""
    goes, found = ram.goes(motion, acting), otherwise
    for valve in of_kind(motion.plan.members, OnLines).values():
        for way in (acting.direction,) if goes is None else ("extending", "retracting"):
            lowered = valve.pressure_lowering(line, ram, motion, replace(acting, direction=way))
            if lowered is not None and way is not None:
                found = lowered if goes is None else np.where(goes == SENSES[way], lowered, found)
    return found


def line_beside(ram: Ram, side: str | None, line: Circuit | None, members: NamedMembers) -> Circuit | None:
    """Return the line, other than one, that keeps a side of a cylinder at its own pressure: a tank's, gas's or a closed one's."""
    beside = (other for other, chamber in lines_of(ram, members) if chamber.side == side and other.kind_in(members) != "held")
    return next((other for other in beside if line is None or not same(other, line)), None)


def other_side(ram: Ram) -> Side | None:
    """Return the side of a cylinder that does not work; None where both work."""
    return ROD if ram.side == PISTON else PISTON if ram.side == ROD else None


def line_thrust(ram: Ram, line: Circuit | None, motion: AnyMotion, acting: Acting, *, with_tanks: bool = True) -> Array:
    """Return the thrust left for a line on a cylinder [N]: its thrust less its other lines', tanks included on request."""
    return member_thrust(motion, ram, acting) - by_other_lines(ram, line, motion, acting, None if with_tanks else False)


def refuse_gas(line: Circuit, plan: Declared) -> None:
    """Raise DefinitionError for accumulators beside a pump where the flow of a line is asked for, which leaves theirs out."""
    what = f"{plan.title}: the flow of {line.name} leaves out what the accumulators beside its pump take"
    ensure(not line.has_gas(plan.members), f"{what}; leave them out, or ask for the oil, {line.name}.oil(motion).")


def chamber_area(chamber: Chamber, ram: Ram, motion: Poses) -> Array:
    """Return the signed area of a chamber [m2]: how its volume grows with the length of its cylinder."""
    size = ram.sized(motion)
    return np.asarray(size.push_area if chamber.side == PISTON else -1.0 * size.pull_area)[()]


KINDS = ("held", "closed", "given")
"""The kinds of lines: a stroke holds their pressure, they keep their oil, their pressure is given."""


def length_in(cylinder: Ram, members: NamedMembers) -> Quantity:
    """Return the length of a cylinder in its class: from its closed line where its own pins follow it, else the distance of these."""
    called = f"{cylinder.name}.length"
    if called not in names_behind(cylinder.ends, members):
        return distance(cylinder.A, cylinder.B)
    own = lines_of(cylinder, members, "closed")
    what = f"{called} is asked for by what places its own pins, {cylinder.A} and {cylinder.B}, and no closed line gives it"
    ensure(own, f"{what}; declare one, OilLine({cylinder.name}.piston_side, other.piston_side, filled=dict(...)).")
    giving = lines_giving(members)
    for line, chamber in own:
        if giving.get(cylinder.name) is line:
            return line.length_given(chamber, members)
    line, _ = own[0]
    other = next(name for name, each in giving.items() if each is line)
    what = f"{line.name} = {line}: one closed line gives one length, and {other}.length and {called} are asked"
    raise DefinitionError(f"{what}; declare another line, or find their pins together in a Group.")


def lines_giving(members: NamedMembers) -> dict[str, Circuit]:
    """Return the closed lines that give cylinders their lengths, by the names of these: one each, first one whose `filled` names it.

    A cylinder whose pins follow its own length is given that; it is left out where there are more of them than lines.
    """
    asking = [each for each in of_kind(members, Ram).values() if lines_of(each, members)]
    asking = [each for each in asking if f"{each.name}.length" in names_behind(each.ends, members)]
    closed = {each.name: [line for line, _ in lines_of(each, members, "closed")] for each in asking}
    closed = {name: sorted(lines, key=lambda line: not line.fills(name)) for name, lines in closed.items()}
    found: dict[str, Circuit] = {}

    def give(name: str, tried: set[str]) -> bool:
        for line in (each for each in closed[name] if each.name not in tried):
            tried.add(line.name)
            holder = next((other for other, each in found.items() if each is line), None)
            if holder is None or give(holder, tried):
                found[name] = line
                return True
        return False

    for name in closed:
        give(name, set())
    return found


def changes_in_motion(motion: AnyMotion, loads: Loads) -> bool:
    """Return whether there is friction among some loads, or an element that acts otherwise while it moves."""
    return any(each.frictions(motion) or each.feeds(motion.plan.members) for _, each in elements_of(motion.plan, loads))


def carries_loads(judge: Judge) -> bool:
    """Return whether anything acts on a machine by itself."""
    motion = judge.motion
    return any(each.loads(motion) or each.pushes(motion, AT_REST) for _, each in elements_of(motion.plan, judge.acting.loads))


def least_and_most(what: MeasuredQuantity) -> list[Question]:
    """Return the least and the greatest value of something, as questions."""
    return [least(what), most(what)]


def judge_of(motion: Motion, what: str, acting: Acting | None = None, *, unreached: str = "") -> Judge:
    """Return the judge of a motion of one design, without its poses out of reach.

    DefinitionError for several designs, and where no pose is reached if `unreached` says what is wrong then.
    """
    require_motion(motion)
    ensure(not motion._design_shape, f"{what} is judged for one design at a time; this motion has {motion._design_shape}. Take one.")
    ensure(not unreached or motion.reached.any(), unreached)
    return Judge(motion.plan, motion.designs, [motion], acting).lost_allowed()


def at_rest(judge: Judge) -> Acting:
    """Return how a load acts where everything stands, with the pump off: over a path in time without inertia, and no damper works."""
    is_timed = any(each.instants is not None for each in judge.places)
    return Acting(direction=FRICTIONLESS, rates=dict.fromkeys(judge.plan.strokes, 0.0) if is_timed else None)


def is_named(reference: Reference) -> bool:
    """Return whether a reference to a cylinder goes by its name in a class; DefinitionError for anything but a reference."""
    require(is_member_or_name(reference), "", reference, "stands where a cylinder or its name is expected")
    return isinstance(reference, str) or bool(reference.name)


def the_cylinder(motion: Poses, reference: Reference) -> Ram:
    """Return the cylinder a reference stands for, as the motion's class has it; DefinitionError where there is none."""
    require_poses(motion)
    is_named(reference)
    return found_in(motion.plan.members, reference, motion.plan.title)


def found_in(members: NamedMembers, reference: Reference, where: str) -> Ram:
    """Return the cylinder a reference stands for in a class; DefinitionError where there is none."""
    found = in_class(members, reference)
    if isinstance(found, str):
        raise unknown("Cylinder", found, of_kind(members, Ram), where=where)
    if not isinstance(found, Ram):
        raise DefinitionError(f"{where}: {found} is no Cylinder; name one.")
    return found


NO_LENGTH = 1e-6  # of the greatest length: the pins of a shorter cylinder come together
TOLERANCE = 1e-9  # m: a length that is met to rounding is met
MISSING = noted("; {missing} are missing: take a longer stroke")
TO_ROUNDING = 1e-9
"""Of the greatest thrust, of what buckles a rod, of a pump's pressure: what is no larger is nothing, to rounding."""
