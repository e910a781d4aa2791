"""Lifting by cylinders of one line: their names, their work, the pump's pressure. Every pressure in this file is gauge [Pa].

What a cylinder carries is its own `thrust(motion)`, with the declared friction of the direction it moves in. An efficiency stands for
what is not declared: the rod carries T / k_m where the load resists and T k_m where it drives, k_m the mechanical efficiency. The
hydraulic efficiency k_h enters only the supply pressure: p = rod force / (area k_h). Holding takes no efficiency. Where nothing resists
a capacity or a reserve is "not limited by this cylinder": NaN in an array, words in a verdict. Forces count in the working direction:
the side that `works` pushes (or, rod side, pulls) with positive force. Of "both" it is the side that the load asks for.
Source: worksheet of the mower lift; Dyuzhev, Kotov, Chuprynin (2008), (28), (29).
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial, reduce
from operator import add
from typing import Any, Unpack, cast

import numpy as np
from numpy.typing import ArrayLike

from linkage.errors import DefinitionError, FormerName, UnfitError, UntracedError, ensure, fits_shape, one_word
from linkage.frozen import immutable
from linkage.language import said, with_and
from linkage.loads import AS_IT_RUNS, SENSES, Acting, ActingKeywords, Case, Loads, situation_of
from linkage.loads.element import Declared, ForceElement, Formulas, Parameter, Poses, Share, Tie, require_poses
from linkage.motion import Answer, Judge, Motion, greatest, lowest
from linkage.plan import Mask, Plan
from linkage.program import is_traced
from linkage.quantities import NamedMembers, Reference
from linkage.statics import (
    PROBE,
    AnyMotion,
    each_once,
    elements_of,
    greatest_kept,
    held_in_case,
    holders_of,
    is_among,
    member_limits,
    member_thrust,
    plan_of,
    pump_thrust,
    same,
    stroke_followed,
)
from linkage.statics.carried import IDLE, direction_at, is_steady, pull_direction, pulling
from linkage.units import require_measure, show

from .cylinders import (
    PISTON,
    ROD,
    Chamber,
    Circuit,
    Ram,
    Reading,
    Side,
    by_other_lines,
    changes_in_motion,
    line_beside,
    line_thrust,
    lines_of,
    other_side,
    over_valves,
    thrust_along,
)
from .inputs import Array, efficient, follows, in_cubic_metres, in_pascals, not_negative, number_set, only_where, positive, proper_share
from .standard_sizes import RamSize
from .standing import common_area, common_sum, growths, is_blocked, moving_with, standing_pressure


class Choice(ActingKeywords, total=False):
    """Which cylinder of a line is meant, in which situation; its direction is the cylinder's own."""

    cylinder: Reference | None


@immutable
class Work:
    """A cylinder's thrust [N] while it grows (`sense` 1) or shrinks (-1), its size, and the mechanical efficiency.

    `drained` is the thrust of tanks on its other side [N], which the pump works against as well. `others` on the same line move with it,
    each with how far it goes its working way while this one goes its own: then forces and areas are those of all.
    """

    thrust: Array
    sense: Array
    size: RamSize
    k_m: Array
    drained: Array | float = 0.0
    others: tuple[tuple[Work, Array], ...] = ()

    @property
    def pulls(self) -> Mask:
        """Where the rod side works: of both sides where the thrust pulls."""
        if self.size.works == "both":
            return np.asarray(self.thrust < 0.0)[()]
        return np.full(np.shape(self.thrust), self.size.works == "rod")

    @property
    def turn(self) -> Array:
        """The sense of its length in which the working side drives: 1, or -1 where that pulls."""
        return np.where(self.pulls, -1.0, 1.0)

    @property
    def area(self) -> Array:
        """The area of the side that works [m2]."""
        return self._of_all("area", np.where(self.pulls, self.size.pull_area, self.size.outward_area))

    @property
    def other_area(self) -> Array:
        """The area of the other side [m2]."""
        return self._of_all("other_area", np.where(self.pulls, self.size.push_area, self.size.inward_area))

    @property
    def along(self) -> Array:
        """The thrust in the direction in which the working side pushes or pulls [N]."""
        return self._of_all("along", np.where(self.pulls, -self.thrust, self.thrust))

    @property
    def against(self) -> Array:
        """The back thrust of tanks on the other side [N]."""
        return self._of_all("against", np.where(self.pulls, 1.0, -1.0) * self.drained)

    def _of_all(self, name: str, own: Array) -> Array:
        return np.asarray(self.leads * reduce(add, (weight * getattr(each, name) for each, weight in self.others), own))[()]

    @property
    def leads(self) -> Array | float:
        """1 where the line fills as it goes its working way; -1 past its dead point, where the others fill more than it empties."""
        own = np.where(self.pulls, self.size.pull_area, self.size.outward_area)
        return np.where(reduce(add, (weight * each.area for each, weight in self.others), own) < 0.0, -1.0, 1.0) if self.others else 1.0

    @property
    def supplied(self) -> Mask:
        """Where the pump fills the working sides: they move the way they push or pull, with those that fill most."""
        return np.asarray(self.sense * self.turn * self.leads >= 0.0)[()]

    def turned(self, other: Work) -> Work:
        """Return the same with the thrusts of another direction where its line empties."""
        back = self.leads < 0.0
        others = tuple(
            (replace(one, thrust=np.where(back, each.thrust, one.thrust)), weight)
            for (one, weight), (each, _) in zip(self.others, other.others, strict=True)
        )
        return replace(self, thrust=np.where(back, other.thrust, self.thrust), others=others)

    @property
    def force(self) -> Array:
        """The rod force in the working direction [N]: over k_m where the load resists the motion, times k_m where it drives."""
        along = self.along
        return np.where(along * np.where(self.supplied, 1.0, -1.0) > 0.0, along / self.k_m, along * self.k_m)


@immutable
class Holding:
    """Gauge pressures that hold a load.

    Attributes
    ----------
    working, other : array
        The pressures [Pa] of the working side, and of the other one where the load drives on.
    """

    working: Array
    other: Array


@immutable
class Lowering:
    """Gauge pressures while a machine goes back against a load.

    Attributes
    ----------
    working : array
        What the load alone makes in the working side [Pa].
    push : array
        What the other side must give where that does not do [Pa].
    by_itself : array of bool
        Whether it sinks without a push.
    """

    working: Array
    push: Array
    by_itself: Array


def way_back(
    ram: Ram, line: Circuit, motion: AnyMotion, acting: Acting, way: str, against: Array | float, k_m: Array
) -> tuple[Array, Array, Array]:
    """Return three pressures of a cylinder on its way back against a resistance of the returning oil [Pa].

    `way` is "extending" or "retracting", its own direction. Over a path in time nothing is asked of it where it goes another way.
    Friction acts against it: the load brings T k_m where it drives and takes T / k_m where it resists. The first pressure is what the
    load alone makes in the side that empties, the second what the other side must give beyond the third one, that of its tank. It is
    below zero where the load does it by itself. Cylinders of one line go back together, at one pressure on each side.
    """
    running = replace(acting, direction=AS_IT_RUNS if acting.rates == AS_IT_RUNS else None)  # whatever it is looked at for
    goes, sense = ram.goes(motion, running), -1.0 if way == "retracting" else 1.0
    acting = acting.towards(way) if goes is None else running
    asks, drained, out, into = sums_back(ram, line, motion, acting, way)
    is_turned = out * sense > 0.0  # what empties is greater while it grows: past its dead point the others take it along
    if goes is None and len(line.rams(motion)) > 1 and changes_in_motion(motion, acting.loads):
        (other,) = {"extending", "retracting"} - {way}
        asks = np.where(is_turned, sums_back(ram, line, motion, acting.towards(other), other)[0], asks)
    back = np.where(is_turned, -sense, sense)
    asks = np.where(back * asks > 0.0, asks / k_m, asks * k_m)
    beside = line_beside(ram, other_side(ram), line, held_in_case(motion, acting).plan.members)
    tank = beside.line_pressure(motion) if beside is not None and beside.is_drained else np.zeros(())
    found = np.maximum((asks - drained) / out, 0.0), (asks - against * out - drained) / into, tank
    pressures = [np.asarray(each)[()] for each in found]
    working, push, tank = pressures if goes is None else [only_where(goes * back > 0.0, each) for each in pressures]
    return working, push, tank


def sums_back(ram: Ram, line: Circuit, motion: AnyMotion, acting: Acting, way: str) -> tuple[Array, Array, Array, Array]:
    """Return the thrusts of a line's cylinders and of their tanks while one goes back [N], and what empties and is pushed [m2].

    Signs are those of its length, and of several each counts as its length goes along. Where nothing pushes, what empties is pushed back.
    """
    own, members = [ram if same(each, ram) else each for each in line.rams(motion)], held_in_case(motion, acting).plan.members
    pushing, is_spool = pushed_back(ram, line, members), any(each.side == "both" for each in own)
    rams = each_once((ram, *own, *(each for each, _ in pushing)))
    sense, total = -1.0 if way == "retracting" else 1.0, partial(common_sum, motion, rams)
    laws = (partial(line_thrust, each, line, motion, with_tanks=False) for each in rams)
    asks = total([(each, moving_with(ram, each, motion, acting, law)) for each, law in zip(rams, laws, strict=True)])
    drained = total([(each, by_other_lines(each, line, held_in_case(motion, acting), None, True)) for each in rams])
    sizes = [(each, each.sized(motion, way)) for each in rams]
    if is_spool:  # it fills of each cylinder the side that goes along, where that works
        shrinks = [sense * rate < 0.0 for rate in growths(motion, rams)]
        ends = [(size.push_area * (each.side != ROD), -1.0 * size.pull_area * (each.side != PISTON)) for each, size in sizes]
        empties, fills = ([np.where(there, *areas[::step]) for there, areas in zip(shrinks, ends, strict=True)] for step in (1, -1))
        return asks, drained, total([*zip(rams, empties, strict=True)]), total([*zip(rams, fills, strict=True)])
    out = total([(each, size.sense * size.area) for each, size in sizes if is_among(each, own)])
    return asks, drained, out, common_area(motion, rams, pushing) if pushing else -out


def pushed_back(ram: Ram, line: Circuit, members: NamedMembers) -> list[tuple[Ram, Chamber]]:
    """Return the chambers whose common pressure pushes a cylinder back: the other sides of its line's cylinders.

    They are those on the line of another pump, else those on its own tank's line, or on no line as its own. A telescope has none, and gas
    and closed lines no pump.
    """
    rams = line.members(members)
    pumped = next((other for each in rams for other, _ in lines_of(each, members, "held") if not same(other, line)), None)
    if pumped is not None:
        return pumped.filling(members)
    beside = line_beside(ram, behind(ram), line, members)
    if beside is not None:
        return [(each, own) for each, own in beside.filling(members) if beside.is_drained and is_among(each, rams)]
    free = (each for each in rams if not (each.only_pushes or line_beside(each, behind(each), line, members)))
    return [(each, Chamber(each, behind(each))) for each in free]


def behind(ram: Ram) -> Side:
    """Return the side on which a cylinder is pushed back, of both the rod's."""
    return other_side(ram) or ROD


class LiftLine(Circuit):
    """The base of lines that a pump holds, shared by `LiftCircuit` and `OilLine`. A subclass tells where its numbers come from."""

    @abstractmethod
    def says(self, name: str, members: NamedMembers) -> tuple[ForceElement, str] | None:
        """Return the element with a number of the pump, the relief valve or the tank, and its name there; None without one.

        Parameters
        ----------
        name : str
            The name of the number, such as "pressure".
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        tuple of ForceElement and str, optional
            The element and the name.
        """

    def number(self, motion: Poses, name: str) -> Array:
        """Return a number of the line as a motion's designs have it [SI], the same at all poses: 0 where nothing says it.

        Parameters
        ----------
        motion : Motion
            The poses.
        name : str
            The name of the number, such as "pressure".

        Returns
        -------
        array
            The number.

        Raises
        ------
        DefinitionError
            The number follows a stroke.
        """
        require_poses(motion)
        found = self.says(name, motion.plan.members)
        return np.zeros(()) if found is None else number_set(found[0], motion, found[1])

    def number_written(self, written: Formulas, name: str) -> Array:
        """Return the same for the equations."""
        found = self.says(name, written.plan.members)
        return np.zeros(()) if found is None else ForceElement.number(found[0], written, found[1])

    def pump_given(self, plan: Declared, name: str) -> Parameter:
        """Return a number of the pump, such as its pressure, as it is given; 0 where nothing says it."""
        found = self.says(name, plan.members)
        return 0.0 if found is None else cast(Parameter, found[0].given(found[1]))

    def relieves(self, plan: Declared) -> bool:
        return self.says("relief", plan.members) is not None

    def tie(self, members: NamedMembers) -> Tie | None:
        """Return how its pressure acts on its cylinders, where a closed line has another side of one of them."""
        own = self.members(members)
        if not any(lines_of(ram, members, "closed") for ram in own):
            return None
        return Tie(self.name, tuple(Share(ram, partial(ram.area_in, sense=np.ones(()))) for ram in own), held=True)

    def formulas(self, written: Formulas) -> None:
        """Write of each of its cylinders, while it lifts against the load: rod force, pressure, greatest rod force and reserve.

        Efficiencies of one and a back pressure of none are left out.
        """
        number, members = partial(self.number_written, written), written.plan.members
        for ram in self.members(members):
            thrust = written.thrust(ram)
            if thrust is None:
                continue
            given = [number(f"{kind}_efficiency") for kind in ("mechanical", "hydraulic")]
            k_m, k_h = (1.0 if written.equals(each, 1.0) else each for each in given)
            area, other = ram.sides_written(written, thrust)
            drained = [line for line, _ in lines_of(ram, members, "given") if isinstance(line, LiftLine) and line.is_drained]
            back = drained[0].number_written(written, "back_pressure") if drained else number("back_pressure")
            against: Array | float = 0.0 if written.equals(back, 0.0) else back * other
            supply = np.minimum(number("pressure"), number("relief")) if self.relieves(written.plan) else number("pressure")
            force = written.line(f"F_{ram.name}", thrust_along(ram, thrust) / k_m, "kN")
            if len(self.references) > 1 and not written.equals(back, 0.0):  # the pressure is that of all, which no force of one tells
                written.given(f"p_{ram.name}", partial(self.pressure_in, ram, acting=Acting()), "bar")
                written.given(f"kz_{ram.name}", partial(self.reserve, cylinder=ram), "")
                continue
            written.line(f"p_{ram.name}", (force + against) / (area * k_h), "bar")
            most = written.line(f"Fmax_{ram.name}", supply * area * k_h - against, "kN")
            written.line(f"kz_{ram.name}", most / force)

    # -- what it is made of --------------------------------------------------------------------------------

    def meant(self, motion: Poses, cylinder: Reference | None) -> tuple[Ram, ...]:
        """Return all its cylinders, or the one named."""
        return self.rams(motion) if cylinder is None else (self.one(motion, cylinder),)

    def supply(self, motion: Poses) -> Array:
        """Return the highest pressure that lifts [Pa]: the pump's, as far as the relief valve lets it; DefinitionError for none."""
        require_poses(motion)
        self.check_pump(motion.plan)
        pump = self._pressure_set(motion, "pressure")
        return np.minimum(pump, self._pressure_set(motion, "relief")) if self.relieves(motion.plan) else pump

    held = FormerName("relief_pressure")

    def relief_pressure(self, motion: Poses) -> Array:
        """Return the pressure at which the relief valve opens [Pa], the pump's where none is given."""
        require_poses(motion)
        return self._pressure_set(motion, "relief" if self.relieves(motion.plan) else "pressure")

    def _pressure_set(self, motion: Poses, name: str) -> Array:
        what = f"{self.name or type(self).__name__}.{name}"
        return in_pascals(positive(self.number(motion, name), what), what)

    def check_pump(self, plan: Declared) -> None:
        """Raise DefinitionError unless a pump is on it."""
        if self.says("mechanical_efficiency", plan.members) is None:
            raise DefinitionError(f"{self.name}: no pump is on it, and it lifts nothing; name a line that has one, or put a Pump on it.")

    def efficiency(self, motion: Poses, kind: str) -> Array:
        """Return the "mechanical" or "hydraulic" efficiency; DefinitionError unless it is above 0 and not above 1."""
        one_word("kind", kind, ("mechanical", "hydraulic"))
        require_poses(motion)
        self.check_pump(motion.plan)
        what = f"{self.name or type(self).__name__}.{kind}_efficiency"
        return efficient(self.number(motion, f"{kind}_efficiency"), what)

    def back(self, motion: Poses) -> Array:
        """Return the pressure of the returning oil [Pa]; DefinitionError where it is negative."""
        return not_negative(in_pascals(self.number(motion, "back_pressure"), "Back pressure"), "Back pressure")

    # -- lifting -------------------------------------------------------------------------------------------

    def work(self, motion: AnyMotion, loads: Loads = None, **choice: Unpack[Choice]) -> Work:
        """Return the work of a cylinder while it moves in its working direction, or in the one named."""
        cylinder = choice.pop("cylinder", None)
        return self.work_of(self.one(motion, cylinder), motion, situation_of("work", loads=loads, **choice))

    def work_of(self, cylinder: Ram, motion: AnyMotion, acting: Acting) -> Work:
        size, k_m = cylinder.sized(motion, acting.direction), self.efficiency(motion, "mechanical")
        goes = cylinder.goes(motion, acting)
        if goes is None and size.works == "both" and acting.direction is None:
            ways = [acting.towards(way) for way in ("extending", "retracting")]
            ways = ways if acting.rates is None else [replace(acting, direction=AS_IT_RUNS)] * 2
            out, back = (line_thrust(cylinder, self, motion, way) for way in ways)
            pushes = out + back >= 0.0  # against a pushing load it extends, against a pulling one it retracts
            return Work(np.where(pushes, out, back), np.where(pushes, 1.0, -1.0), size, k_m)
        way = acting.direction or cylinder.driven[0]
        acting = replace(acting, direction=way) if goes is None else acting  # over a path in time as it runs
        thrust = line_thrust(cylinder, self, motion, acting, with_tanks=False)
        goes = np.full(np.shape(thrust), float(SENSES[way])) if goes is None else goes
        sense = np.where(goes == 0.0, np.sign(thrust), goes)
        return Work(thrust, sense, size, k_m, by_other_lines(cylinder, self, held_in_case(motion, acting), None, True))

    def work_of_all(self, cylinder: Ram, motion: AnyMotion, acting: Acting) -> Work:
        """Return the work of a cylinder with the others of its line, which have one pressure with it."""
        work, goes, is_said = self.work_of(cylinder, motion, acting), cylinder.goes(motion, acting), acting.direction is not None
        if work.size.works != "both":
            acting = replace(acting, direction=acting.direction or cylinder.driven[0])

        def moved(each: Ram, _: Array) -> Work:
            def thrust(acting: Acting) -> Array:
                return self.work_of(each, motion, acting).thrust

            return replace(self.work_of(each, motion, acting), thrust=moving_with(cylinder, each, motion, acting, thrust))

        found = self._with_others(cylinder, work, motion, moved)
        if goes is not None and found.others:  # where it stands, all together hold the load
            found = replace(found, sense=np.where(goes == 0.0, found.turn * found.leads * np.sign(found.along), found.sense))
        if is_said or goes is not None or not found.others or work.size.works == "both":
            return found
        found = replace(found, sense=found.turn * found.leads)  # as the line fills, whichever way its own length goes
        if not changes_in_motion(motion, acting.loads):
            return found
        (other,) = {"extending", "retracting"} - {acting.direction}
        return found.turned(self.work_of_all(cylinder, motion, acting.towards(other)))

    def driving(self, cylinder: Ram, motion: AnyMotion, sense: float, direction: str | None = None, *, alone: bool = False) -> Work:
        """Return the work of the sides that drive in a direction, 1 while the cylinder grows, whatever is asked of them."""
        k_m = self.efficiency(motion, "mechanical")

        def driven(each: Ram, rate: Array) -> Work:
            way = np.asarray(sense * np.sign(rate))
            return Work(way, way, each.sized(motion, direction), k_m, by_other_lines(each, self, motion, None, True))

        work = driven(cylinder, np.ones(()))
        return work if alone else self._with_others(cylinder, work, motion, driven)

    def _with_others(self, cylinder: Ram, work: Work, motion: AnyMotion, of: Callable[[Ram, Array], Work]) -> Work:
        """Return a work with those of the others on the line, each of how its length follows."""
        rams, others = self.rams(motion), list[tuple[Work, Array]]()
        is_spool = any(each.side == "both" for each in rams)
        for each in (one for one in rams if not same(one, cylinder)):
            own, rate = growths(motion, (cylinder, each))
            beside = of(each, rate / own)
            weight = work.turn * beside.turn * rate / own
            others.append((beside, np.maximum(weight, 0.0) if is_spool else weight))  # a spool drains what goes against its side
        return replace(work, others=tuple(others))

    def rod_force(self, motion: AnyMotion, loads: Loads = None, **choice: Unpack[Choice]) -> Array:
        """Return the rod force in the working direction [N], shape (...): T / k_m against a load, T k_m under one that drives."""
        return self.work(motion, loads, **choice).force

    def pressure_for(self, motion: AnyMotion, loads: Loads = None, **choice: Unpack[Choice]) -> Array:
        """Return the pressure on the side that works [Pa gauge], shape (...): the pump's while it lifts; 0 where the load drives.

        `choice`: `case=`, `direction=` of the cylinder where it is not its working direction, `cylinder=` of a line of several (else
        the one that needs most).
        """
        rams = self.meant(motion, choice.pop("cylinder", None))
        acting = situation_of("pressure_for", loads=loads, **choice)
        return np.asarray(np.max([self.pressure_in(ram, motion, acting) for ram in rams], axis=0))

    def pressure_in(self, cylinder: Ram, motion: AnyMotion, acting: Acting) -> Array:
        motion, ram = held_in_case(motion, acting), self.one(motion, cylinder)
        members = motion.plan.members
        if is_blocked(ram, members):
            return np.asarray(np.maximum(standing_pressure(self, motion, acting), 0.0))[()]
        work = self.work_of_all(ram, motion, acting)
        found = self.driving_pressure(work, motion)
        goes = ram.goes(motion, acting)
        if goes is not None:  # where it stands no oil flows and nothing rubs
            found = np.where(goes == 0.0, np.maximum(work.along + work.against, 0.0) / work.area, found)
        return over_valves(self, ram, motion, acting, found)

    def driving_pressure(self, work: Work, motion: AnyMotion) -> Array:
        """Return the pressure that does a work, shape (...) [Pa gauge]; where the cylinder stands, that at which it begins to move."""
        back = np.where(work.supplied, self.back(motion) * work.other_area, 0.0)
        share = np.where(work.supplied, self.efficiency(motion, "hydraulic"), 1.0)
        return np.asarray(np.maximum(work.force + back + work.against, 0.0) / (work.area * share))[()]

    def pressure_behind(self, cylinder: Ram, motion: AnyMotion, acting: Acting) -> Array:
        asks, drained, _, into = sums_back(cylinder, self, motion, acting, cylinder.ways_back(0.0, 0.0)[0])
        return (asks - drained) / into

    def _pushes_out(self, cylinder: Ram, members: NamedMembers) -> bool:
        """Return whether its pump pushes a cylinder out: it has the piston side, and no line of the cylinder is shut."""
        has_piston = any(each.side == PISTON and same(ram, cylinder) for ram, each in self.filling(members))
        return has_piston and self.kind_open(members) == "held" and not is_blocked(cylinder, members)

    def loses_out(self, cylinder: Ram, plan: Declared) -> bool:
        given = self.pump_given(plan, "mechanical_efficiency") if self._pushes_out(cylinder, plan.members) else 1.0
        return follows(given) or given != 1.0

    def efficiency_out(self, cylinder: Ram, motion: AnyMotion) -> Array | float:
        return self.efficiency(motion, "mechanical") if self._pushes_out(cylinder, motion.plan.members) else 1.0

    def push_out(self, cylinder: Ram, motion: Motion) -> tuple[float, float] | None:
        if not self._pushes_out(cylinder, motion.plan.members):
            return None
        size, pressure = cylinder.sized(motion, "extending"), self.relief_pressure(motion)
        back = self.back(motion) * size.inward_area - by_other_lines(cylinder, self, motion, None)
        return float(pressure), float(np.squeeze(pressure * size.outward_area - back))

    def use_of(self, cylinder: Ram, motion: AnyMotion, acting: Acting) -> Array | None:
        if self.kind_open(motion.plan.members) != "held":
            return None
        work = self.work_of_all(self.one(motion, cylinder), motion, acting)
        return np.asarray(work.force / self.most(motion, work))[()]

    def unit_in(self, judge: Judge) -> str:
        """Return the unit in which its pressures are shown: that of the dimension which its pump's pressure follows, else bar."""
        pressure = self.pump_given(judge.plan, "pressure")
        given = judge.plan.members.get(pressure) if isinstance(pressure, str) else pressure
        return str(getattr(given, "unit", "")) or "bar"

    def gauges_of(self, cylinder: Ram, plan: Plan) -> dict[str, Reading]:
        return {"most": self.supply} if self.kind_in(plan.members) == "held" else {}

    def largest(self, motion: AnyMotion, loads: Loads = None, *, share: float = 1.0, **choice: Unpack[Choice]) -> Array:
        """Return the greatest rod force in the working direction [N]: k_h p area, less the back pressure's share."""
        proper_share(share)
        return self.most(motion, self.work(motion, loads, **choice), share)

    def most(self, motion: AnyMotion, work: Work, share: float = 1.0) -> Array:
        """Return the greatest rod force [N] with the areas of a work, at a share of the pump's pressure."""
        force, alone = (self._given(motion, each, share) for each in (work, replace(work, others=())))
        if np.any(alone <= 0.0):
            raise UnfitError(f"{self}: the back pressure eats up the pump's; lower it or raise the pressure.")
        return force

    def _given(self, motion: Poses, work: Work, share: float) -> Array:
        """Return the thrust of the pressures on both sides with the areas of a work [N], below zero where the back pressure is stronger."""
        pushes = share * self.efficiency(motion, "hydraulic") * self.supply(motion) * work.area
        return np.asarray(pushes - self.back(motion) * work.other_area - work.against)[()]

    def bounds_of(self, cylinder: Reference, motion: Poses, lifting: bool, *, share: float = 1.0) -> tuple[Array, Array]:
        """Return between which two thrusts one of its cylinders lifts, at a `share` of the pump's pressure, or holds [N].

        Lifting takes both efficiencies and the back pressure off, and the side that does not work gives nothing. Holding takes none of
        them, and both sides hold oil, each up to the relief valve's pressure.
        """
        proper_share(share)
        ram = self.one(motion, cylinder)
        size = ram.sized(motion)
        others = by_other_lines(ram, self, motion, None, None if not lifting else False)  # type: ignore[arg-type]
        nothing = np.zeros(())
        if not lifting:
            held = self.relief_pressure(motion)
            low, high = np.asarray(-held * size.inward_area), np.asarray(held * size.outward_area)
            beside = line_beside(ram, other_side(ram), self, motion.plan.members)
            if beside is not None and beside.kind_in(motion.plan.members) == "given":
                low, high = (low, nothing) if size.works == "rod" else (nothing, high)
        else:
            pull, push = (self._shared(ram, motion, sense, share) for sense in (-1.0, 1.0))  # type: ignore[arg-type]
            low, high = (-pull if size.works in ("rod", "both") else nothing), (nothing if size.works == "rod" else push)
        return low + others, high + others

    def _shared(self, ram: Ram, motion: AnyMotion, sense: float, share: float) -> Array:
        """Return the greatest thrust of one cylinder [N]: of several its part without losses of what all give at one pressure."""
        back, rams, alone = self.back(motion), self.rams(motion), self.driving(ram, motion, sense, alone=True)
        drains = [line for each in rams for line, _ in lines_of(each, motion.plan.members, "given") if line.is_drained]
        if len(rams) == 1 or not (drains or is_traced(back) or np.any(back > 0.0)):
            return self._given(motion, alone, share) * alone.k_m
        every = self.driving(ram, motion, sense)
        pressure = (self._given(motion, every, share) * every.k_m + every.against) / every.area
        return np.asarray(pressure * alone.area - alone.against)[()]

    def reserve(self, motion: AnyMotion, loads: Loads = None, **choice: Unpack[Choice]) -> Array:
        """Return the greatest rod force over the needed one, shape (...); NaN where it is not limited by this cylinder.

        Of a line of several cylinders the least, unless one is named.
        """
        rams = self.meant(motion, choice.pop("cylinder", None))
        acting = situation_of("reserve", loads=loads, **choice)
        with np.errstate(invalid="ignore"):
            works = [self.work_of_all(ram, motion, acting) for ram in rams]
            return least_of([self.most(motion, work) / only_where(work.force > 0.0, work.force) for work in works])

    def capacity(
        self,
        motion: AnyMotion,
        point: str,
        loads: Loads = None,
        *,
        along: tuple[Any, Any] = (0.0, 1.0),
        share: float = 1.0,
        cylinder: Reference | None = None,
        case: Case = None,
        acting: Acting | None = None,
    ) -> Array:
        """Return the largest load at a point that the pump lifts beside the machine's own.

        Parameters
        ----------
        motion : Motion
            Poses; designs first, strokes last.
        point : str
            Where the load pulls.
        loads : list, optional
            The machine's own loads: those declared unless others are given, [] for none.
        along : tuple, optional
            The direction (x, y) against which the load pulls, of any length: two numbers, quantities, or arrays that broadcast against
            the motion. `a = angle(Q, T)` and `along=(-np.sin(a), np.cos(a))` stand square to QT, and turn with it.
        share : float, optional
            Share of the pump's pressure.
        cylinder : str or Cylinder, optional
            One of several cylinders; by default the one that lifts least counts.
        case, acting : optional
            Load case, or what acts in one.

        Returns
        -------
        ndarray
            Loads [N], shape (...). 0 where the machine alone is too heavy, or a member fails without a load, such as a rope that is
            slack. NaN where the load drives or does nothing and no member limits it.

        Raises
        ------
        DefinitionError
            The load drives the cylinders, or does nothing, at all poses: the direction is the wrong way round.

        Notes
        -----
        Members' own conditions limit it, too: a rope that would push, a closed line that runs empty, a holding valve. Declared friction
        counts with the load's own share. Source: Dyuzhev, Kotov, Chuprynin (2008), (28).
        """
        found = self.lifted(motion, point, loads, along=along, share=share, cylinder=cylinder, case=case, acting=acting)
        if isinstance(motion, Motion) and motion.reached.any() and not np.any(motion.reached & ~np.isnan(found)):
            way = pull_direction(along)
            turned = f"write along=({0.0 - way[0]:g}, {0.0 - way[1]:g})" if is_steady(way) else "turn it round"
            names = with_and(ram.name or str(ram) for ram in self.meant(motion, cylinder))
            what = f"{motion.plan.title}: {self.name or 'the circuit'}: a load at {point} along that direction drives {names}"
            raise DefinitionError(f"{what} at every pose, or does not move with it, so that nothing limits it; {turned} for the other way.")
        return found

    def lifted(
        self, motion: AnyMotion, point: str, loads: Loads = None, *, along: tuple[Any, Any] = (0.0, 1.0), share: float = 1.0,
        cylinder: Reference | None = None, case: Case = None, acting: Acting | None = None, limit: int | None = None,
    ) -> Array:  # fmt: skip
        """Return the same, NaN where nothing limits it; by one `limit` alone: the number of a member's condition, else the pump's."""
        require_poses(motion)
        if isinstance(motion, Motion):
            motion._refuse_part(f"the capacity at {point}")
        self.check_pump(motion.plan)
        proper_share(share)
        unit = pull_direction(along)
        unit = direction_at(unit, motion) if isinstance(motion, Motion) and not is_steady(unit) else unit
        given = situation_of("capacity", acting, loads=loads, case=case)
        limits = member_limits(plan_of(motion), given.case)
        chosen = limits if limit is None else limits[limit : limit + 1]
        bends = holders_of(plan_of(motion)).changes_shares
        if (chosen or bends) and not isinstance(motion, Motion):
            raise UntracedError(f"the capacity at {point} is {f'limited by {chosen[0].name}, too' if chosen else 'found pose by pose'}")
        own = [element for _, element in elements_of(motion.plan, given.loads)]

        def beside(load: Array | float) -> Acting:
            """Return the machine's own loads with a load there."""
            return replace(given, loads=[*own, pulling(point, unit, load, motion)])

        rams = self.meant(motion, cylinder) if limit is None or limit >= len(limits) else ()
        most = [self._lifted_by(ram, motion, beside, share, own) for ram in rams]
        for each in chosen:
            load = each.greatest_load(cast(Motion, motion), beside)
            most.append(np.where(np.isfinite(load), load, np.nan))
        return least_of(most)

    def _lifted_by(self, ram: Ram, motion: AnyMotion, beside: Any, share: float, own: Sequence[ForceElement]) -> Array:
        """Return the largest load that one cylinder lifts; `beside(load)` is the situation with that load."""
        size = ram.sized(motion)
        if ram.closed_thrust(motion, beside(0.0)) is None:
            lever = member_thrust(motion, ram, Acting([beside(1.0).loads[-1]]))  # what one newton there asks of it
        else:
            alone, loaded = (pump_thrust(motion, ram, beside(load)) for load in (0.0, PROBE))
            lever = (loaded - alone) / PROBE
        sense = np.sign(lever) if size.works == "both" else np.full(np.shape(lever), float(size.sense))
        lifts, lever = lever * sense > IDLE, lever * sense
        low, high = self.bounds_of(ram, motion, True, share=share)
        most = np.where(sense < 0.0, -low, high)

        goes_both_ways = ram.goes(motion, beside(0.0)) is None  # over a path in time it goes one way at each pose

        def thrusts(load: Array) -> list[Array]:
            """Return the thrusts that the machine and a load there need while it grows and while it shrinks."""
            if not goes_both_ways:
                return [pump_thrust(motion, ram, beside(load))] * 2
            return [pump_thrust(motion, ram, beside(load).towards(way)) for way in ("extending", "retracting")]

        def carried(load: Array) -> Array:
            """Return the thrust in the direction in which it lifts."""
            out, back = thrusts(load)
            return np.where(sense > 0.0, out, -back)

        out, back = thrusts(np.zeros(motion.shape))
        alone, safe = np.where(sense > 0.0, out, -back), np.where(lifts, lever, 1.0)
        if size.works == "both" and goes_both_ways:  # too heavy alone for one side: what relieves it lifts nothing
            most = np.where((out > high) | (back < low), np.minimum(most, alone), most)
        found = (most - alone) / safe
        if holders_of(held_in_case(motion, beside(0.0)).plan).changes_shares:
            return only_where(lifts, greatest_kept(lambda load: most - carried(load), most - alone, found))
        if any(each.frictions(motion) for each in own):
            for _ in range(ROUNDS):  # friction grows with the load: a line through two states, again until it stays
                guess = np.where(lifts & (found > 0.0), found, 1.0)
                slope = (carried(guess) - alone) / guess
                found = (most - alone) / np.where(slope > 0.0, slope, safe)
        return only_where(lifts, np.maximum(found, 0.0))

    # -- oil and time --------------------------------------------------------------------------------------

    def taken(self, motion: Motion) -> Array:
        """Return the oil [m3] that the working sides take over the motion's range of lengths, between its poses too; one a design.

        Of a cylinder that works with both sides it is that outwards; `size.pull_area` over the same way is that inwards. What one of
        several presses out fills the others.
        """
        found, rams = [], self.rams(motion)
        for ram in rams:
            ram.travel(motion)  # refuses a motion without a pose
        if self.fills_others(motion):
            low, high = (np.asarray(each(motion, self.volume).value) for each in (lowest, greatest))
            return np.asarray(high - low)[()]
        for ram in rams:
            low, high = (each.reshape((*each.shape, *(1,) * len(motion._stroke_shape))) for each in ram.extent(motion))
            found.append(for_designs(motion, ram.taken(motion, low, high)))
        return np.asarray(sum(found))[()]

    def fills_others(self, motion: Poses) -> bool:
        """Return whether its oil does not go to one cylinder alone: one may fill another one, or accumulators.

        Parameters
        ----------
        motion : Motion
            The poses.

        Returns
        -------
        bool
            Whether it is on several cylinders that do not work with both sides, or on accumulators beside its pump.
        """
        rams = self.rams(motion)
        return self.has_gas(motion.plan.members) or (len(rams) > 1 and all(ram.side != "both" for ram in rams))

    def time(self, motion: Motion) -> Array:
        """Return the time [s] that the pump's flow takes for it, one value a design; DefinitionError without a flow."""
        flow = positive(self.number(motion, "flow"), "Flow of the pump", "give it in m3/s, such as flow=60 * litre / minute")
        in_cubic_metres(flow, "Flow of the pump")
        return np.asarray(self.taken(motion) / for_designs(motion, flow))[()]

    # -- holding and lowering ------------------------------------------------------------------------------

    def goes_both_ways(self, ram: Ram, plan: Plan) -> bool:
        """Return whether the line drives a cylinder both ways: it works with both sides, or moves with one of the line that does."""
        both = [each for each in self.members(plan.members) if each.side == "both"]
        return any(same(each, ram) or stroke_followed(plan, each) == stroke_followed(plan, ram) for each in both)

    def holding(
        self, motion: Motion, loads: Loads = None, *, cylinder: Reference | None = None, case: Case = None, acting: Acting | None = None
    ) -> Holding:
        """Return the pressures that hold the thrust with the pump off; neither friction, inertia nor an efficiency is counted on.

        A side on another line that keeps its own pressure, a tank's or gas's, has that, and holds nothing more. Of a line of several
        cylinders the greatest, unless one is named.
        """
        given = situation_of("holding", acting, loads=loads, case=case)
        require_poses(motion)
        stands = None if motion.time is None else dict.fromkeys(motion.plan.strokes, 0.0)
        plain, working, other = Acting(given.loads, given.case, rates=stands), [], []
        for ram in self.meant(motion, cylinder):
            size, thrust = ram.sized(motion), line_thrust(ram, self, motion, plain)
            working.append(np.maximum(size.sense * thrust, 0.0) / size.area)
            beside = line_beside(ram, other_side(ram), self, held_in_case(motion, given).plan.members)
            if beside is not None:
                other.append(beside.line_pressure(motion, plain) + 0.0 * thrust)
            elif np.all(size.back_area > 0.0):
                other.append(np.maximum(self.pressure_behind(ram, motion, plain), 0.0))
            else:
                other.append(size.behind(np.maximum(-thrust, 0.0)))
        return Holding(np.max(working, axis=0), np.max(other, axis=0))

    def lowering(
        self, motion: Motion, loads: Loads = None, *, resistance: ArrayLike = 0.0, cylinder: Reference | None = None, case: Case = None,
        acting: Acting | None = None,
    ) -> Lowering:  # fmt: skip
        """Return how it goes back against its working direction, the oil flowing out against a `resistance` [Pa].

        Of a cylinder that works with both sides, or is moved with one, it is at each pose the way that the load drives it. Of a line of
        several cylinders it is the one that goes back hardest, unless one is named.
        """
        given = situation_of("lowering", acting, loads=loads, case=case)
        require_measure(resistance, "bar", "lowering: resistance")
        against, k_m = not_negative(resistance, "Return resistance"), self.efficiency(motion, "mechanical")
        fits = is_traced(against) or np.ndim(against) == 0 or fits_shape(against, motion.shape)
        ensure(fits, f"resistance of the shape {np.shape(against)} does not fit the poses {motion.shape}.")
        found = []
        for ram in self.meant(motion, cylinder):
            if not self.goes_both_ways(ram, motion.plan):
                found.append(way_back(ram, self, motion, given, ram.ways_back(0.0, 0.0)[0], against, k_m))
                continue
            in_, out = (way_back(ram, self, motion, given, way, against, k_m) for way in ("retracting", "extending"))
            presses = sums_back(ram, self, motion, Acting(given.loads, given.case), "retracting")[0] >= 0.0
            alone, push, tank = (np.where(presses, *each) for each in zip(in_, out, strict=True))
            found.append((alone, push, tank))
        working, pushes, tanks = zip(*found, strict=True)
        needed = [np.where(push > 0.0, push + tank, 0.0) for push, tank in zip(pushes, tanks, strict=True)]
        return Lowering(np.min(working, axis=0), np.max(needed, axis=0), np.asarray(np.max(pushes, axis=0) < 0.0))


ROUNDS = 12
"""How often a capacity with friction is put right; each makes it better by the share of the friction."""


def least_of(each: Sequence[Array]) -> Array:
    """Return the least of the cylinders' limits; NaN where none limits it."""
    if len(each) == 1:
        return each[0]
    least = np.min(np.where(np.isnan(each), np.inf, each), axis=0)
    return np.where(np.isfinite(least), least, np.nan)


def for_designs(motion: Motion, value: ArrayLike) -> Array:
    """Return a value that broadcasts against the motion and is the same at all poses, as one of each design."""
    array, tail = np.asarray(value), (1,) * len(motion._stroke_shape)
    return np.asarray(array.reshape(array.shape[: array.ndim - len(tail)]) if array.ndim else array)


def pressure_range(low: Answer, high: Answer, unit: str) -> str:
    """Return from where to where a line's pressure goes, in words; a unit of pressure."""
    endless = next((each for each in (low, high) if np.isinf(each.value)), None)
    if endless is not None:
        return said("its pressure grows without bounds {where}", where=endless.where)
    least, most = (show(round(float(each.value), 3) + 0.0, unit, 4) for each in (low, high))  # a thousandth of a pascal is rounding
    by = {"low": least, "low_where": low.where, "high": most, "high_where": high.where}
    return said("its pressure goes from {low} {low_where} to {high} {high_where}", **by)
