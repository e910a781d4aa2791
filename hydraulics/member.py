"""A cylinder between two points of a mechanism: declared like them, checked against its stroke. Pressures are gauge [Pa].

>>> from linkage.units import bar, kN, mm
>>> lift = Cylinder("A", "B", bore=110 * mm, rod=60 * mm, count=2)
>>> print(f"{lift.size.thrust(160 * bar) / kN:.1f} kN; {lift.size.pressure_for(200 * kN) / bar:.1f} bar")
304.1 kN; 105.2 bar
>>> print(lift.standard())
FAIL standard size: bore 110 mm and rod 60 mm; the rod is not of ISO 3320, next to it are 56 and 63 mm.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial, reduce
from types import MappingProxyType
from typing import Any, ClassVar, Literal, TypeAlias, TypeVar, Unpack, cast, final

import numpy as np
from numpy.typing import ArrayLike

from linkage.errors import DefinitionError, cited, unknown, unwarned
from linkage.frozen import refuses_changes
from linkage.language import noted, said, said_of, with_and
from linkage.loads import (
    AT_REST,
    DIRECTIONS,
    FRICTIONLESS,
    Acting,
    ActingKeywords,
    Case,
    Declared,
    DrawnAs,
    ForceElement,
    Loads,
    Parameter,
    Poses,
    Push,
    Rates,
    TwoPoint,
    require_poses,
    situation_of,
    takes_situation,
)
from linkage.loads.element import UNBOUNDED, Formulas
from linkage.motion import (
    Column,
    Condition,
    Constraint,
    HasVerdicts,
    Judge,
    Motion,
    Question,
    Request,
    SmoothPiece,
    Tabled,
    at,
    greatest,
    least,
    lowest,
    most,
    require_motion,
)
from linkage.plan import Plan
from linkage.quantities import Member, Reference, body_name, distance, label, name_of
from linkage.statics import AnyMotion, LawRequest, case_words, elements_of, member_thrust, same
from linkage.units import mm, show, shown_number, unit_sign
from linkage.verdict import Verdict

from .buckling import Buckling, never_pushed
from .cylinder import BORES_MM, RODS_MM, CylinderSize, standard_rods
from .inputs import Array, follows, number_set, one_number, positive, stroke_in_metres

LENGTHS: Mapping[str, str] = MappingProxyType({"stroke": "Stroke of the cylinder", "closed": "Closed length of the cylinder"})
"""What its lengths are called in words."""
PISTON, ROD = "piston", "rod"
SIDES = (PISTON, ROD)
"""The sides of a cylinder."""


@final
@refuses_changes
@dataclass(frozen=True, eq=False)
class Cylinder(TwoPoint, Tabled, HasVerdicts):
    """`count` equal cylinders side by side between A and B: `lift = Cylinder(A, B, bore=110 * mm, rod=60 * mm, count=2)`.

    In a class bore and rod [m] are the design variables `lift.bore` and `lift.rod`. `works` is the side the pressure acts
    on: "piston" pushes, "rod" pulls, "both" does what the load asks for. `closed` is the distance of its pins drawn in, `stroke` how
    far it comes out [m], design variables as well where they are given; `mounting` and `safety` are for buckling. It holds what the
    mechanism needs, in the place of the drive of one stroke; one that a FloatCircuit feeds has the gas's force instead.
    """

    A: Reference
    B: Reference
    bore: Parameter
    rod: Parameter
    count: int = 1
    works: Literal["piston", "rod", "both"] = "piston"
    stroke: Parameter | None = None
    closed: Parameter | None = None
    mounting: str = "pin-pin"
    safety: float = 3.5
    drawn_as: ClassVar[DrawnAs] = "cylinder"
    file_section: ClassVar[str] = "hydraulics"
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"bore": "mm", "rod": "mm", "stroke": "mm", "closed": "mm"})
    not_negative: ClassVar[frozenset[str]] = frozenset({"bore", "rod", "stroke", "closed"})
    optional: ClassVar[frozenset[str]] = frozenset({"stroke", "closed"})

    def __post_init__(self) -> None:
        super().__post_init__()
        size = CylinderSize(2.0, 1.0, self.count, self.works) if self._follows else self.size
        Buckling(1.0, self.mounting, self.safety)
        for name, what in LENGTHS.items():
            value = getattr(self, name)
            if value is not None and not follows(value):
                positive(stroke_in_metres(one_number(value, what), what, None if self._follows else size.bore), what)

    def _check_number(self, name: str) -> None:
        if name not in LENGTHS:  # those are looked at beside the bore, in words of their own
            super()._check_number(name)

    def push(self, motion: Poses, length: Array, rate: Array) -> Array:
        """Return nothing: it has no law of its own."""
        return np.zeros(())

    def pushes(self, motion: Poses, rates: Rates = AT_REST) -> list[Push]:
        return []

    @property
    def holds(self) -> bool:
        return True

    @property
    def works_both(self) -> bool:
        return self.works == "both"

    def area_in(self, motion: Poses, sense: Array) -> Array:
        size = self.sized(motion)
        if self.works == "both":
            return np.asarray(np.where(sense[()] < 0.0, -size.pull_area, size.push_area))
        return np.asarray(size.sense * size.area + 0.0 * sense)

    # -- its size ------------------------------------------------------------------------------------------

    @property
    def size(self) -> CylinderSize:
        """The size as it is written here; DefinitionError where a bore or rod follows something else."""
        if self._follows:
            raise DefinitionError(f"{self}: its size follows the design; ask for sized(motion).")
        return CylinderSize(cast("float | Array", self.bore), cast("float | Array", self.rod), self.count, self.works)

    @property
    def _follows(self) -> bool:
        """Whether bore or rod follow a quantity of the class."""
        return follows(self.bore, self.rod)

    def sized(self, motion: Poses) -> CylinderSize:
        """Return the size that a motion's designs have; bore and rod [m] broadcast against the motion."""
        bore, rod = number_set(self, motion, "bore"), number_set(self, motion, "rod")
        return CylinderSize(bore[()], rod[()], self.count, self.works)

    def closed_and_stroke(self, motion: Poses) -> tuple[Array | None, Array | None]:
        """Return its closed length and its stroke as a motion's designs have them [m], to broadcast against it; None where not given.

        DefinitionError for one that is not above zero, that is given in millimetres, or that follows a stroke of the machine.
        """
        bore = self.sized(motion).bore
        closed, stroke = (self._length(motion, name, bore) for name in ("closed", "stroke"))
        return closed, stroke

    def _length(self, motion: Poses, name: str, bore: ArrayLike) -> Array | None:
        if getattr(self, name) is None:
            return None
        what = LENGTHS[name]
        return positive(stroke_in_metres(number_set(self, motion, name), what, bore), what)

    def offers(self, thrust: float, pressure: float, length: float | None = None) -> list[CylinderSize]:
        """Return the standard sizes (ISO 3320) that give a thrust [N] at a pressure: the smallest bore, each rod that suits.

        With a `length` between the pins [m] only rods that do not buckle under a positive thrust. DefinitionError where no bore is enough.
        """
        if length is not None:
            one_number(length, "Length between the ends")
        thin = CylinderSize(self.size.bore, min(self.size.rod, RODS_MM[0] * mm), self.count, self.works)
        bore = float(thin.sized_for(thrust, pressure).bore)
        sizes = [CylinderSize(bore, rod, self.count, self.works) for rod in standard_rods(bore)]
        enough = [size for size in sizes if one_area(size, thrust) * pressure >= abs(thrust)]
        push = max(thrust, 0.0) / self.count
        return [size for size in enough if length is None or Buckling(float(size.rod), self.mounting, self.safety).allowed(length) >= push]

    def extent(self, motion: Motion) -> tuple[Array, Array]:
        """Return its least and its greatest length over all that a motion covers [m], one value a design; NaN where no pose is reached."""
        low, high = (np.asarray(found(motion, lambda each: each.distance(self.A, self.B)).value) for found in (lowest, greatest))
        return low, high

    def travel(self, motion: Motion) -> Array:
        """Return greatest less least length over all that a motion covers [m], one value a design; DefinitionError for no pose reached."""
        low, high = self.extent(motion)
        if not np.all(np.isfinite(high - low)):
            raise DefinitionError(f"{self}: no pose of this motion can be assembled.")
        return np.asarray(high - low)

    # -- what it carries -----------------------------------------------------------------------------------

    @takes_situation
    def thrust(self, motion: AnyMotion, loads: Loads = None, **situation: Unpack[ActingKeywords]) -> Array:
        """Return what this cylinder carries, whatever drives the machine, shape (...) [N], positive where it pushes its ends apart.

        `loads` are the machine's own unless others are given. It is frictionless unless a `direction` is named: "extending" while this
        cylinder grows; along a path of several strokes the senses of friction are those of the path. No efficiency is in it. Of one
        that a FloatCircuit feeds it is the gas's force. DefinitionError where it holds nothing here; SingularError where its length
        stands still against its drive, and where friction locks the mechanism.
        """
        return member_thrust(motion, self, situation_of("thrust", loads=loads, **situation))

    @takes_situation
    def pressure(self, motion: AnyMotion, loads: Loads = None, **situation: Unpack[ActingKeywords]) -> Array:
        """Return the pressure on the side that works, shape (...) [Pa gauge]; 0 where the other side holds.

        While it moves in its working direction, or the one named, with what its one LiftCircuit says: efficiencies and back pressure.
        Of a cylinder that a FloatCircuit feeds it is the line's pressure. DefinitionError where several circuits have it: name one,
        `circuit.pressure_for(motion)`.
        """
        return pressure_of(self, motion, situation_of("pressure", loads=loads, **situation))

    def bounds(self, motion: Poses, lifting: bool, *, share: float = 1.0) -> tuple[Array, Array]:
        """Return between which two thrusts [N] its circuit lets it stand, where it lifts or where it holds; unbounded without a circuit.

        A LiftCircuit gives what its pump lifts with the sides that work, at a `share` of its pressure, or what its relief valve holds with
        both: the piston up to the highest, the annulus down to the lowest. A FloatCircuit gives the gas's force and no other.
        DefinitionError where it is on several circuits: ask one, `circuit.bounds_of(lift, motion, lifting)`.
        """
        require_poses(motion)
        circuit = circuit_having(self, motion.plan)
        return UNBOUNDED if circuit is None else circuit.bounds_of(self, motion, lifting, share=share)

    @property
    def driven(self) -> tuple[str, ...]:
        """The directions in which the side that works drives it."""
        return {"piston": ("extending",), "rod": ("retracting",)}.get(self.works, ("extending", "retracting"))

    def way_back(self, motion: AnyMotion, acting: Acting) -> str:
        """Return the direction in which it goes back: against its working one; of both the way the load drives it at most of the poses."""
        if self.works != "both":
            return "retracting" if self.works == "piston" else "extending"
        with unwarned():
            drives = np.sign(member_thrust(motion, self, Acting(acting.loads, acting.case)))
        return "retracting" if float(np.nan_to_num(drives).sum()) >= 0.0 else "extending"

    def pressure_on(
        self, side: str, motion: AnyMotion, acting: Acting, circuit: Circuit | None = None, *, below: bool = False
    ) -> Array:
        """Return the pressure on one of its sides, shape (...) [Pa gauge]; 0 where the other side holds, or `below` what would balance.

        At rest without friction and efficiencies; while it moves, on a side that works, as its circuit has it.
        """
        thrust = member_thrust(motion, self, acting)
        along, size = thrust if side == PISTON else -thrust, self.sized(motion)
        balance = along / (size.push_area if side == PISTON else size.pull_area)
        least = balance if below else 0.0
        if acting.movement == FRICTIONLESS or self.works not in (side, "both"):
            return np.asarray(np.maximum(balance, least))[()]
        found = pressure_of(self, motion, acting) if circuit is None else circuit.pressure_in(self, motion, acting)
        return np.where(along > 0.0, found, least) + 0.0 * thrust

    def columns(self, motion: Motion) -> list[Column]:
        """Return its thrust without friction and, unless several circuits have it, its pressure and its reserve, for the table."""
        return self.columns_in(motion)

    def columns_in(self, motion: Motion, case: Case = None, direction: str | None = None) -> list[Column]:
        require_poses(motion)
        acting = Acting(case=case, direction=direction)
        found = [Column(noted("thrust"), member_thrust(motion, self, acting), "kN")]
        if len(circuits_of(self, motion.plan)) > 1:
            return found
        found.append(Column(noted("pressure"), pressure_of(self, motion, acting), "bar", 2))
        circuit = circuit_having(self, motion.plan)
        reserve = None if circuit is None else circuit.reserve_of(self, motion, acting)
        return found if reserve is None else [*found, Column(noted("reserve"), reserve, "", 3)]

    def questions(self, judge: Judge) -> list[Question]:
        """Return its least and greatest length, and the utilisation of its rod."""
        ends = distance(self.A, self.B)
        return [least(ends), most(ends), *([most(buckling_request(self, Acting())) <= 1.0] if carries_loads(judge) else [])]

    def conditions(self, judge: Judge) -> Mapping[str, Condition]:
        """Return that it fits, where its stroke is declared, and that its rod does not buckle."""
        found: dict[str, Condition] = {}
        ends = distance(self.A, self.B)
        given = {name: LawRequest(text=f"{self.name} {name}", formula=partial(self._length_given, name)) for name in LENGTHS}
        closed, stroke = at(given["closed"]), at(given["stroke"])
        if self.stroke is not None and self.closed is None:
            found["length"] = most(ends) - least(ends) <= stroke
        elif self.closed is not None:
            found["length"] = AllOf((least(ends) >= closed, *((most(ends) <= closed + stroke,) if self.stroke is not None else ())))
        return found | ({"buckling": most(buckling_request(self.name, Acting())) <= 1.0} if carries_loads(judge) else {})

    def verdicts(self, judge: Judge) -> list[Verdict]:
        """Return whether it fits wherever the machine runs, is of a standard size, and whether a rod that carries something buckles."""
        try:
            if not self.is_placed(judge):
                return [Verdict("length", False, self.unplaced), self.standard(judge.motion)]
            rod = self.buckling_verdicts(judge) if carries_loads(judge) else []
            return [*self.length_verdicts(judge), self.standard(judge.motion), *rod]
        except DefinitionError as error:
            return [Verdict("cylinder", False, " ".join(str(error).split()))]

    def gauges(self, plan: Plan) -> dict[str, Request]:
        circuits = circuits_of(self, plan)
        found: dict[str, Reading] = {"thrust": self.thrust}
        if len(circuits) <= 1:
            found["pressure"] = self.pressure
        if len(circuits) == 1:
            found |= circuits[0].gauges_of(self)
        found |= {name: partial(self._length_given, name) for name in LENGTHS if getattr(self, name) is not None}
        return {name: LawRequest(text=f"{self.name} {name}", formula=read) for name, read in found.items()}

    def _length_given(self, name: str, motion: AnyMotion) -> Array:
        """Return its closed length or its stroke as it is given [m]."""
        return positive(stroke_in_metres(number_set(self, motion, name), LENGTHS[name]), LENGTHS[name])

    def formulas(self, written: Formulas) -> None:
        """Write its area, and its pressure where no circuit says it."""
        thrust, members = written.thrust(self), written.plan.members
        on_circuit = (one for each in written.plan.of_kind(Circuit).values() for one in each.members(members))
        if thrust is None or any(same(self, one) for one in on_circuit):
            return
        area, _ = self.sides_written(written, thrust)
        written.line(f"p_{self.name}", thrust_along(self, thrust) / area, "bar")

    def area_written(self, written: Formulas) -> Array:
        area, _ = self.sides_written(written, np.ones(()))
        return -area if self.works == "rod" else area

    def sides_written(self, written: Formulas, thrust: Array) -> tuple[Array, Array]:
        """Write the area of the side that works, and return its symbol with the area of the other side [m2]."""
        bore, rod = self.number(written, "bore"), self.number(written, "rod")
        piston, annulus = (self.count * written.pi / 4.0 * each for each in (bore**2, bore**2 - rod**2))
        if self.works == "both":
            pulls = thrust < 0.0
            working, other = np.where(pulls, annulus, piston), np.where(pulls, piston, annulus)
        else:
            working, other = (annulus, piston) if self.works == "rod" else (piston, annulus)
        return written.line(f"A_{self.name}", working, "m2"), other

    # -- checks --------------------------------------------------------------------------------------------

    def checks(self, motion: Motion, loads: Loads = None, *, case: Case = None, acting: Acting | None = None) -> list[Verdict]:
        """Return what can be said of it over a motion of one design: length, standard size, and buckling where it carries something."""
        one_design(motion, str(self))
        judge = judge_of(motion, situation_of("checks", acting, loads=loads, case=case))
        return [*self.length_verdicts(judge), self.standard(motion), *self.buckling_verdicts(judge)]

    def fits(self, motion: Motion) -> list[Verdict]:
        """Return whether its closed and its open length serve the motion, between its poses too; nothing where neither is given.

        With the stroke alone it is compared with the travel: largest less least distance of its pins.
        """
        one_design(motion, str(self))
        if not motion.reached.any():
            raise DefinitionError(f"{self}: no pose of this motion can be assembled, so that there is no length to check.")
        return self.length_verdicts(judge_of(motion))

    def length_verdicts(self, judge: Judge) -> list[Verdict]:
        """Return the same over all that a judge looks at."""
        closed, stroke = (None if each is None else one_number(np.squeeze(each), "Length") for each in self.closed_and_stroke(judge.motion))
        if closed is None and stroke is None:
            return []
        ends = judge.answers([least(distance(self.A, self.B)), most(distance(self.A, self.B))])
        low, high = (float(each.value) for each in ends)
        if np.isnan(low):
            return [Verdict("length", None, said("nothing is left to judge: every place is unlimited, left out or lost"), answer=ends[0])]
        if closed is not None:
            opened = closed + stroke if stroke is not None else np.inf
            return [self._reaches(low, high, closed, opened).answered(ends[0] if low - closed < opened - high else ends[1])]
        return [] if stroke is None else [self._travels(high - low, stroke).answered(ends[1])]

    def is_placed(self, judge: Judge) -> bool:
        """Return whether its pins have a place anywhere that a judge looks at: a fixed one may have none in a design."""
        return bool(np.isfinite(judge.answer(least(distance(self.A, self.B))).value))

    @property
    def unplaced(self) -> str:
        """That its pins have no place, in words."""
        return said("{pins} has no length at any pose that is looked at: one of its pins has no place there.", pins=self._pins)

    def travelled(self, judge: Judge) -> float:
        """Return greatest less least length over all that a judge looks at [m], of one design."""
        low, high = judge.answers([least(distance(self.A, self.B)), most(distance(self.A, self.B))])
        return float(high.value - low.value)

    def _reaches(self, low: float, high: float, closed: float, opened: float) -> Verdict:
        faults = []
        if closed > low + TOLERANCE:
            much = show(closed - low, "mm", ".1f")
            faults.append(said("it is {much} too long closed: take one with a shorter closed length", much=much))
        if opened < high - TOLERANCE:
            missing = show(high - opened, "mm", ".1f")
            if high - closed <= closed:
                faults.append(said("{missing} are missing open: take a longer stroke", missing=missing))
            else:
                faults.append(
                    said("{missing} are missing open: no cylinder comes out by more than it is long closed: move its pins", missing=missing)
                )
        elif np.isfinite(opened) and opened - closed > closed:
            stroke = show(opened - closed, "mm", ".1f")
            faults.append(said("it cannot come out by {stroke}, more than it is long closed: move its pins", stroke=stroke))
        says = said(
            "{pins} goes from {low} to {high}, the cylinder is {closed} long closed",
            pins=self._pins, low=shown_number(low, "mm", ".1f"), high=show(high, "mm", ".1f"), closed=show(closed, "mm", ".1f"),
        )  # fmt: skip
        out = said(" and {opened} open", opened=show(opened, "mm", ".1f")) if np.isfinite(opened) else ""
        return Verdict("length", not faults, f"{'; '.join([f'{says}{out}', *faults])}.")

    def _travels(self, travel: float, stroke: float) -> Verdict:
        way, given = show(travel, "mm", ".1f"), show(stroke, "mm", ".1f")
        says = said("{pins} changes by {travel}, the stroke is {stroke}", pins=self._pins, travel=way, stroke=given)
        if travel <= stroke + TOLERANCE:
            return Verdict("length", True, f"{says}.")
        short = said("; {missing} are missing: take a longer stroke", missing=show(travel - stroke, "mm", ".1f"))
        return Verdict("length", False, f"{says}{short}.")

    def standard(self, motion: Poses | None = None) -> Verdict:
        """Return whether bore and rod are of ISO 3320; where not, what is next to them."""
        size = one_size(self.size if motion is None else self.sized(motion))
        faults = []
        if beside := _near(size.bore, BORES_MM):
            text = said_of(
                len(beside), "the bore is not of ISO 3320, next to it is {near}", "the bore is not of ISO 3320, next to it are {near}",
                near=_listed(beside),
            )  # fmt: skip
            faults.append(text)
        if beside := _near(size.rod, RODS_MM):
            text = said_of(
                len(beside), "the rod is not of ISO 3320, next to it is {near}", "the rod is not of ISO 3320, next to it are {near}",
                near=_listed(beside),
            )  # fmt: skip
            faults.append(text)
        suits = any(abs(rod - size.rod) < 1e-9 for rod in standard_rods(size.bore))
        if not faults and not suits:
            faults = [said("this rod does not suit this bore; it may have {rods}", rods=_listed(standard_rods(size.bore)))]
        says = said("bore {bore} and rod {rod}", bore=show(size.bore, "mm", 4), rod=show(size.rod, "mm", 4))
        if not faults:
            return Verdict("standard size", True, said("{says} are a pair of ISO 3320.", says=says))
        return Verdict("standard size", False, f"{'; '.join([says, *faults])}.")

    def buckling(self, motion: Motion, loads: Loads = None, *, case: Case = None, acting: Acting | None = None) -> list[Verdict]:
        """Return whether a rod buckles at its largest utilisation: over every pose, load case and direction, one design.

        `case` names one load case; without it all that the machine declares are looked at, besides the plain one. Nothing where it
        carries nothing among these loads.
        """
        one_design(motion, str(self))
        return self.buckling_verdicts(judge_of(motion, situation_of("buckling", acting, loads=loads, case=case)))

    def buckling_verdicts(self, judge: Judge) -> list[Verdict]:
        """Return the same over all that a judge looks at."""
        size = one_size(self.sized(judge.motion))
        rod = Buckling(size.rod, self.mounting, self.safety)
        worst = judge.answer(most(buckling_request(self, Acting())) <= 1.0)
        if np.isnan(worst.value) or not worst.value > 0.0:
            return [never_pushed()]
        with unwarned():  # the verdict itself says what comes of it
            place, acting = judge.there(worst), judge.situation(worst)
            push = float(member_thrust(place, self, acting)) / self.count
            length = float(place.distance(self.A, self.B))
        return [rod.judged(length, push, worst.place, bool(worst.unbounded), size.bore).answered(worst)]

    @takes_situation
    def buckling_use(self, motion: AnyMotion, loads: Loads = None, **situation: Unpack[ActingKeywords]) -> Array:
        """Return the utilisation of a rod, shape (...): a cylinder's push times the safety over the force at which it buckles; 0 in a pull.

        Without a direction it is the greatest of all in which something acts otherwise, as friction does; see `buckling` for the verdict.
        """
        acting = situation_of("buckling_use", loads=loads, **situation)
        if acting.direction is not None:
            return self._use(motion, acting)
        ways = DIRECTIONS if changes_in_motion(motion, acting.loads) else DIRECTIONS[:1]
        return reduce(np.maximum, [self._use(motion, replace(acting, direction=way)) for way in ways])

    def _use(self, motion: AnyMotion, acting: Acting, *, below: bool = False) -> Array:
        """Return the utilisation in one direction, in a pull 0 or `below`."""
        push = member_thrust(motion, self, acting) / self.count
        bar = Buckling(1.0, self.mounting, self.safety)
        allowed = bar.critical_of(self.sized(motion).rod, motion.distance(self.A, self.B)) / self.safety
        return push / allowed if below else np.where(push > 0.0, push / allowed, 0.0) + 0.0 * push

    @property
    def _pins(self) -> str:
        return body_name(label(end) for end in (self.A, self.B))


@final
@dataclass(frozen=True, eq=False)
class AllOf(Condition):
    """Several conditions as one: the worst counts."""

    each: tuple[Condition, ...]

    def constraints(self, machine: Any) -> tuple[Constraint, ...]:
        return tuple(one for condition in self.each for one in condition.constraints(machine))

    def __str__(self) -> str:
        return " and ".join(map(str, self.each))


# What is asked of one cylinder.


Values = TypeVar("Values")


def cylinder_request(
    word: str,
    cylinder: str | Cylinder,
    acting: Acting,
    formula: Callable[[AnyMotion, Cylinder, Acting], Array],
    before: tuple[Hashable, ...] = (),
    after: tuple[Hashable, ...] = (),
    *,
    measures: str = "",
) -> LawRequest:
    """Return the request for what a formula gives of one cylinder of a class, in a situation; its directions are the cylinder's own.

    It is written as a function, `word`, of the cylinder, of what stands `before` and `after` the direction, and of the load case.
    """
    named = cylinder if isinstance(cylinder, str) else cylinder.name or cylinder
    return LawRequest(
        formula=partial(formula_of_cylinder, formula, named), text=partial(cylinder_text, word, (named, *before), after),
        known=(word, named, before, after), acting=acting, measures=measures, mover=named, examine=partial(cylinder_in, named),
    )  # fmt: skip


def cylinder_text(word: str, before: Sequence[Hashable], after: Sequence[Hashable], acting: Acting) -> str:
    """Return how what is asked of a cylinder in a situation is written."""
    given = [str(each) for each in (*before, acting.direction, *after) if each is not None]
    return f"{word}({', '.join([*given, *case_words(acting.case)])})"


def formula_of_cylinder(
    formula: Callable[[AnyMotion, Cylinder, Acting], Values], named: str | Cylinder, motion: AnyMotion, acting: Acting
) -> Values:
    """Return what a formula gives of the cylinder that is meant, as the motion's class has it."""
    return formula(motion, cylinder_in(named, motion.plan), acting)


def cylinder_in(named: str | Cylinder, plan: Plan) -> Cylinder:
    """Return the cylinder that is meant, as a plan has it; DefinitionError where there is none of that name."""
    return found_in(plan.members, named, plan.title) if isinstance(named, str) else named


def thrust_request(cylinder: str | Cylinder, acting: Acting) -> LawRequest:
    """Return the request for what a cylinder carries [N]."""
    found = cylinder_request("thrust", cylinder, acting, member_thrust, measures="force")
    return replace(found, text=partial(thrust_text, found.mover))


def thrust_text(named: Hashable, acting: Acting) -> str:
    """Return how the thrust of a cylinder is written: that there is no friction goes without saying."""
    return cylinder_text("thrust", (named,), (), replace(acting, direction=None if acting.direction == FRICTIONLESS else acting.direction))


def buckling_request(cylinder: str | Cylinder, acting: Acting, *, below: bool = False) -> LawRequest:
    """Return the request for how far a cylinder's rod is used against buckling; `below` zero it goes on in a pull."""
    found = cylinder_request("buckling", cylinder, acting, partial(rod_use, below=below), after=("below zero" if below else None,))
    return replace(found, pieces_in=partial(buckling_pieces, cylinder))


def buckling_pieces(cylinder: str | Cylinder, request: LawRequest, plan: Plan) -> tuple[SmoothPiece, ...]:
    """Return the one smooth piece of a rod's use: it goes on below zero in a pull."""
    return (SmoothPiece(request, below=buckling_request(cylinder, request.situation, below=True)),)


def rod_use(motion: AnyMotion, cylinder: Cylinder, acting: Acting, *, below: bool) -> Array:
    """Return how far a cylinder's rod is used over a motion's poses, in a pull 0 or `below`."""
    return cylinder._use(motion, acting, below=True) if below else cylinder.buckling_use(motion, acting=acting)


Reading: TypeAlias = Callable[[AnyMotion], Array]
"""A number of a cylinder over the poses of a motion [SI]."""


def thrust_along(cylinder: Cylinder, thrust: Array) -> Array:
    """Return a thrust in the direction in which the working side pushes or pulls [N]."""
    return np.abs(thrust) if cylinder.works == "both" else -thrust if cylinder.works == "rod" else thrust


def pressure_of(cylinder: Cylinder, motion: AnyMotion, acting: Acting) -> Array:
    """Return a cylinder's pressure by the circuit that has it; without one, of a pump without losses."""
    require_poses(motion)
    held = motion._of_the_whole(cylinder) if isinstance(motion, Motion) else None
    if held is not None:
        return pressure_of(held[1], held[0], acting)
    circuit = circuit_having(cylinder, motion.plan)
    if circuit is not None:
        return circuit.pressure_in(cylinder, motion, acting)
    return np.maximum(cylinder.sized(motion).pressure_for(member_thrust(motion, cylinder, acting)), 0.0)


def circuit_having(cylinder: Cylinder, plan: Declared) -> Circuit | None:
    """Return the circuit that gives a cylinder its pressure, the one that feeds it first; DefinitionError where several have it."""
    members, mine = plan.members, circuits_of(cylinder, plan)
    feeding = [each for each in mine if any(same(cylinder, one) for one in each.feeds(members))]
    if len(mine) > 1 and not feeding:
        names = ", ".join(each.name for each in mine)
        remedy = f"name one: {mine[0].name}.pressure_for(motion)"
        raise DefinitionError(f"{plan.title}: {cylinder.name} is on {len(mine)} circuits, {names}; {remedy}.")
    return next(iter((*feeding, *mine)), None)


def circuits_of(cylinder: Cylinder, plan: Declared) -> list[Circuit]:
    """Return the circuits of a class that have a cylinder."""
    return [each for each in plan.of_kind(Circuit).values() if any(same(cylinder, one) for one in each.members(plan.members))]


class Circuit(ForceElement, HasVerdicts):
    """The base of circuits: what feeds cylinders."""

    places: ClassVar[tuple[str, ...]] = ()
    file_section: ClassVar[str] = "hydraulics"
    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType({"cylinder": "load"})

    def __post_init__(self) -> None:
        super().__post_init__()
        for each in self.references:
            if not is_named(each) and not isinstance(each, Cylinder):
                raise DefinitionError(f"{type(self).__name__}: {cited(each)} is no Cylinder; name one.")

    @property
    @abstractmethod
    def references(self) -> tuple[Reference, ...]:
        """Its cylinders, as they were given."""

    def parts(self) -> tuple[Reference, ...]:
        return (*(each for each in self.references if is_named(each)), *super().parts())

    def examine(self, members: Mapping[str, Member], title: str) -> None:
        for each in self.references:
            if is_named(each):
                found_in(members, each, f"{title}.{self.name}")

    def members(self, members: Mapping[str, Member]) -> tuple[Cylinder, ...]:
        """Return its cylinders, as a class has them."""
        title = self.name or type(self).__name__
        found = (found_in(members, each, title) if is_named(each) else each for each in self.references)
        return tuple(each for each in found if isinstance(each, Cylinder))

    def gauges_of(self, cylinder: Cylinder) -> dict[str, Reading]:
        """Return what it tells of one of its cylinders on a live page: the `most` pressure it may have [Pa], its `reserve`."""
        return {}

    @abstractmethod
    def pressure_in(self, cylinder: Cylinder, motion: AnyMotion, acting: Acting) -> Array:
        """Return the pressure on the working side of one of its cylinders, shape (...) [Pa gauge]."""

    def bounds_of(self, cylinder: Reference, motion: Poses, lifting: bool, *, share: float = 1.0) -> tuple[Array, Array]:
        """Return between which two thrusts [N] it lets one of its cylinders stand; unbounded unless it says so."""
        return UNBOUNDED

    def reserve_of(self, cylinder: Cylinder, motion: AnyMotion, acting: Acting) -> Array | None:
        """Return the greatest rod force of one of its cylinders over the needed one, shape (...); None where no pump feeds it."""
        return None


def changes_in_motion(motion: AnyMotion, loads: Loads) -> bool:
    """Return whether there is friction among some loads, or an element that acts otherwise while it moves."""
    return any(each.frictions(motion) or each.feeds(motion.plan.members) for _, each in elements_of(motion.plan, loads))


def carries_loads(judge: Judge) -> bool:
    """Return whether anything acts on a machine by itself."""
    motion = judge.motion
    return any(each.loads(motion) or each.pushes(motion, AT_REST) for each in motion.plan.of_kind(ForceElement).values())


def judge_of(motion: Motion, acting: Acting | None = None) -> Judge:
    """Return the judge of one motion, of which what is out of reach is left out."""
    return Judge(motion.plan, motion.designs, [motion], acting).lost_allowed()


def one_design(motion: Motion, what: str) -> None:
    """Raise DefinitionError for a motion of several designs, and for what is no motion."""
    require_motion(motion)
    if motion._design_shape:
        raise DefinitionError(f"{what} is judged for one design at a time; this motion has {motion._design_shape}. Take one.")


def one_area(size: CylinderSize, thrust: float) -> float:
    """Return the area that gives a thrust of this sign [m2]: of both sides the one that does, else the working one."""
    return float(size.pull_area if size.works == "both" and thrust < 0.0 else size.area)


def is_named(reference: Reference) -> bool:
    """Return whether a reference to a cylinder goes by its name in a class; DefinitionError for what is no reference."""
    if not isinstance(reference, (str, Member)):
        raise DefinitionError(f"{cited(reference)} stands where a cylinder or its name is expected.")
    return isinstance(reference, str) or bool(reference.name)


def the_cylinder(motion: Poses, reference: Reference) -> Cylinder:
    """Return the cylinder a reference stands for, as the motion's class has it; DefinitionError where there is none."""
    require_poses(motion)
    if is_named(reference):
        return found_in(motion.plan.members, reference, motion.plan.title)
    return _cylinder(reference, "The circuit")


def found_in(members: Mapping[str, Member], reference: Reference, where: str) -> Cylinder:
    """Return the cylinder a reference stands for in a class; DefinitionError where there is none."""
    name = name_of(reference)
    if name in members:
        return _cylinder(members[name], where)
    if isinstance(reference, str):
        raise unknown("Cylinder", name, (each for each, member in members.items() if isinstance(member, Cylinder)), where=where)
    return _cylinder(reference, where)


def _cylinder(found: object, where: str) -> Cylinder:
    if not isinstance(found, Cylinder):
        raise DefinitionError(f"{where}: {found} is no Cylinder; name one.")
    return found


TOLERANCE = 1e-9  # m: a length that is met to rounding is met


@final
@refuses_changes
@dataclass(frozen=True)
class OneSize:
    """A bore and a rod [m] of one design."""

    bore: float
    rod: float


def one_size(size: CylinderSize) -> OneSize:
    """Return the bore and rod of one design; DefinitionError for a batch."""
    if np.size(size.bore) != 1 or np.size(size.rod) != 1:
        raise DefinitionError("Cylinder sizes are judged for one design at a time; this motion has several.")
    return OneSize(float(np.ravel(size.bore)[0]), float(np.ravel(size.rod)[0]))


def _near(value: float, series: tuple[int, ...]) -> list[float]:
    """Return the sizes [m] beside one that is not of a series [mm]; empty where it is of it."""
    if any(abs(value / mm - each) < 1e-6 for each in series):
        return []
    below, above = [each for each in series if each * mm < value][-1:], [each for each in series if each * mm > value][:1]
    return [each * mm for each in (*below, *above)]


def _listed(values: Iterable[float]) -> str:
    return f"{with_and(shown_number(value, 'mm', '.0f') for value in values)} {unit_sign('mm')}"
