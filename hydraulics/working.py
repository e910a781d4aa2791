"""Motions of a machine under demands on one pump: from event to event, each stretch a polynomial.

The strokes are the state. What each cylinder gets follows the pose, by the needs of all; between two events that is smooth, and the strokes
over a stretch follow by integrating their rates, again and again until they stay (Picard). Where another decision is due the stretch ends,
to the last digits. Behind it a look ahead by a small step tells how it goes on. Where two decisions each lead to the other, the needs stay
level: two cylinders go on at one pressure, or one creeps at the cut-off, with the shares by which their needs change alike (Filippov).
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Any, TypeAlias, cast

import numpy as np
from numpy.polynomial import chebyshev

from linkage import Acting, ForceElement, Mechanism
from linkage.errors import AssemblyError, DefinitionError, ensure, known_name, require, require_type, unwarned
from linkage.frozen import FrozenDict, immutable, record
from linkage.language import said, with_and
from linkage.motion import Instants, Motion, Over
from linkage.numeric import last_holding
from linkage.plan import Mask, Plan, require_kinds
from linkage.quantities import Course, Reference, as_mapping, is_number, name_of
from linkage.statics import has_masses
from linkage.units import require_measure, require_number, show

from .consumers import AT_BORDER, Consumers, Consumption, cylinder_named, in_plan, refuse_unpushed
from .cycle import (
    DEGREE,
    SHORTEST,
    SLOW,
    TO_COEFFICIENTS,
    TO_INTEGRALS,
    PumpCycle,
    PumpEvent,
    PumpRun,
    Stretch,
    is_smooth,
    limits_of,
    stretch_times,
)
from .cylinders import LENGTHS, Ram
from .inputs import Array, one_design
from .sharing import BY_DEMAND, SAME_NEED, Choices, FlowDemands, FlowSupply, flow_shares, level_shares

Demand: TypeAlias = "float | Course"
"""How fast a cylinder shall move [m/s], or a course of that over time."""
AHEAD = 1e-7
"""s; so far it is looked ahead behind an event, to see how it goes on."""
CLOSE = 1e-11
"""s; so near an event is found."""
AT_END = 1e-12
"""m or rad; a stroke or a length that is no farther from its end is at it."""
ROUNDS = 40
"""How often rates are integrated at the most until the strokes stay."""
IDLING = 1e-6
"""Of what it is asked for: a cylinder that waits is taken to move so much, so that friction knows which way."""
DIFFERENCES = ((-3, -1 / 60), (-2, 3 / 20), (-1, -3 / 4), (1, 3 / 4), (2, -3 / 20), (3, 1 / 60))
"""Places and factors of a first derivative, of the sixth order."""
MOST = 20000
"""Stretches of a run."""
INSTANTS = 401
"""Of a run that are looked at, equally far apart."""


class PumpMotion(Motion):
    """A motion in time that one pump made: its `events` in their order, and its `cycle`."""

    events: tuple[PumpEvent, ...]
    cycle: PumpCycle


@record
class Mode:
    """The decisions of a stretch: the choices in sharing, cylinders at an end, and those that go on level or creep at the cut-off."""

    choices: tuple[Hashable, ...]
    stopped: tuple[bool, ...]
    level: frozenset[int] = frozenset()
    creep: frozenset[int] = frozenset()


@immutable
class FlowState:
    """The state over some instants: flows, each consumer's supply, and the rates of the strokes (n, m)."""

    consumption: Consumption
    supply: FlowSupply
    shares: Array
    rates: Array
    ways: Sequence[Array]
    flow_demands: FlowDemands

    @property
    def pump_pressure(self) -> Array:
        """The pressure of the pump (m,)."""
        return np.broadcast_to(np.asarray(self.supply.pressure, float), self.shares.shape[1:])


class PumpedMachine:
    """A machine on one pump with demands on its cylinders, in the modes of their movement."""

    def __init__(
        self, pump: ForceElement, machine: Mechanism, demands: Mapping[str, Demand], start: Mapping[str, float], acting: Acting
    ) -> None:
        plan, designs = machine.plan, dict(machine.judge(acting=acting).designs)
        self.consumers = Consumers(plan, designs, pump, acting, start)
        self._latest = np.zeros(0), np.zeros((len(demands), 0))
        self.plan, self.designs, self.pump, self.demands = plan, designs, pump, demands
        there = Motion(plan, designs, {name: np.asarray(value) for name, value in start.items()}, "nan")
        self.limits = limits_of(pump, self.consumers, there)
        self.has_relief = any(line.relieves(plan) for line in self.consumers.lines)
        self.at_relief = self.has_relief and self.limits.cut_off < one_design(pump.number(there, "pressure"))
        self.ram_places = [cylinder_named(self.consumers, name) for name in demands]
        self.spans = np.array([sorted((plan.strokes[name].start, plan.strokes[name].end)) for name in self.consumers.strokes], float)
        self.own, self.moved = self._independent(np.array([[start[name]] for name in self.consumers.strokes]))
        names = [name_of(each) for each in pump.given("first")]
        served = [
            each.name in names or any(inlet.line.name in names for inlet in self.consumers.inlets if inlet.ram is each)
            for each in self.rams
        ]
        self.tiers = [0 if each else 1 for each in served]
        self.lengths = np.array([length_ends(ram, there) for ram in self.rams])

    @property
    def rams(self) -> list[Ram]:
        """The cylinders that are asked for."""
        return [self.consumers.rams[place] for place in self.ram_places]

    def _independent(self, strokes: Array) -> tuple[list[int], list[int]]:
        """Return the cylinders that say how the strokes move, those asked for first, and the strokes that they move, one each.

        DefinitionError for one that no stroke moves, and for two that are asked to move one.
        """
        with unwarned():
            slopes = self.consumers.consumption(strokes, [], 0.0 * strokes).slopes[:, :, 0]
        slopes = slopes * np.ptp(self.spans, axis=1)
        left, own, moved = slopes.copy(), list[int](), list[int]()
        for place in [*self.ram_places, *(k for k in range(len(left)) if k not in self.ram_places)]:
            row = left[place]
            best = int(np.argmax(np.abs(row)))
            if abs(row[best]) <= 1e-9 * max(float(np.abs(slopes[place]).max()), 1e-9):
                if place in self.ram_places:
                    ram = self.consumers.rams[place].name
                    others = [self.consumers.rams[k].name for k in own]
                    beside = f"it moves with {', '.join(others)}" if np.abs(slopes[place]).max() > 1e-9 else "no stroke moves it here"
                    raise DefinitionError(f"{self.plan.title}: demands: {ram} cannot be moved by itself: {beside}; leave it out.")
                continue
            own.append(place)
            moved.append(best)
            left = left - np.outer(left[:, best] / row[best], row)
            left[:, best] = 0.0
        return own, moved

    # -- what is asked at instants -------------------------------------------------------------------------

    def speeds(self, time: Array) -> Array:
        """Return how fast each cylinder is asked to move (c, m) [m/s]; infinite for as fast as the pump can."""
        if self._latest[0] is not time:
            within = np.full(len(time), 0.5 * (time[0] + time[-1]))  # a demand that jumps where a stretch ends has not yet done so
            each_of = [
                each(time, phase=within) if isinstance(each, Course) else np.full(len(time), float(each)) for each in self.demands.values()
            ]
            self._latest = time, np.array(each_of).reshape(len(self.demands), len(time))
        return self._latest[1]

    def ways(self, slopes: Array, speeds: Array) -> list[Array]:
        """Return the rates of all strokes (n, m) that go with each demand alone, where all other cylinders of the pump stand."""
        inner = slopes[self.own][:, self.moved].transpose(2, 0, 1)
        found = []
        for number in range(len(self.ram_places)):
            alone = np.zeros((inner.shape[0], len(self.own), 1))
            alone[:, number, 0] = speeds[number]
            way = np.zeros((len(self.consumers.strokes), inner.shape[0]))
            way[self.moved] = np.linalg.solve(inner, alone)[:, :, 0].T
            found.append(way)
        return found

    def flow_demands(self, time: Array, strokes: Array, rates: Array, like: Consumption | None = None) -> tuple[Consumption, list[Array]]:
        """Return the demands at instants, and the matching ways of the strokes."""
        rows = self.consumers.rows(strokes, rates)
        slopes = self.consumers.consumption_of(rows, []).slopes
        speeds = self.speeds(time)
        endless = np.isinf(speeds)
        ways = self.ways(slopes, np.where(endless, np.sign(speeds), speeds))
        consumption = self.consumers.consumption_of(rows, ways, like)
        if endless.any():
            for number in np.flatnonzero(endless.any(axis=1)).tolist():
                name, need = self.rams[number].name, consumption.needs[number]
                what = f"{self.plan.title}: demands: {name} is asked to move without a bound"
                remedy = f"give a speed, such as {name}=0.1"
                ensure(
                    not self.limits.least_first, f"{what}, as valves of open centre would let it, and not least pressure first; {remedy}."
                )
                if np.any(need < -SAME_NEED * self.limits.cut_off):
                    at = show(float(time[np.argmin(need)]), "s", 4)
                    raise DefinitionError(f"{what}, and at {at} its load drives it, which nothing would hold; {remedy}.")
                ways[number] = ways[number] * self.limits.flow / consumption.flows[number]
            consumption = self.consumers.consumption_of(rows, ways)
        return consumption, ways

    def stopped(self, consumption: Consumption, ways: Sequence[Array], strokes: Array, at: int) -> tuple[bool, ...]:
        """Return which cylinders stand at an end of their own, or of the stroke that is theirs, and are asked beyond it."""
        found = []
        for number, (place, way) in enumerate(zip(self.ram_places, ways, strict=True)):
            growth = float(consumption.slopes[place, :, at] @ way[:, at])
            low, high = self.lengths[number]
            length = float(consumption.lengths[place, at])
            stroke = self.moved[self.own.index(place)]
            (least, most), value, rate = self.spans[stroke], float(strokes[stroke, at]), float(way[stroke, at])
            beyond = (growth > 0.0 and length >= high - AT_END) or (growth < 0.0 and length <= low + AT_END)
            found.append(bool(beyond or (rate > 0.0 and value >= most - AT_END) or (rate < 0.0 and value <= least + AT_END)))
        return tuple(found)

    def asks(self, consumption: Consumption, mode: Mode, at: int | None = None) -> FlowDemands:
        """Return the demands on the pump at one of the instants, or at all."""
        flows, needs = ([each if at is None else float(each[at]) for each in rows] for rows in (consumption.flows, consumption.needs))
        return FlowDemands(flows, needs, mode.stopped, self.tiers, mode.level, mode.creep)

    # -- in a mode -----------------------------------------------------------------------------------------

    def moment(self, time: Array, strokes: Array, rates: Array, mode: Mode, like: Consumption | None = None) -> FlowState:
        """Return the state at instants in a mode; `rates` are those at which friction and dampers are evaluated."""
        return self.state_of(strokes, mode, *self.flow_demands(time, strokes, rates, like))

    def state_of(self, strokes: Array, mode: Mode, consumption: Consumption, ways: Sequence[Array]) -> FlowState:
        """Return the state in a mode at strokes (n, m), from the demands there."""
        many = strokes.shape[1]
        slopes = self._need_slopes(strokes, consumption, ways) if mode.level or mode.creep else np.zeros(0)
        flow_demands, idle = self.asks(consumption, mode), [not flow[many // 2] > 0.0 for flow in consumption.flows]
        for _ in range(ROUNDS if mode.creep else 1):
            supply = flow_shares(flow_demands, self.limits, Choices(mode.choices))
            shares = np.array([np.broadcast_to(each, many) for each in supply.shares]).reshape(len(ways), many).copy()
            shares[idle] = 1.0  # nothing is asked of the pump: its load moves it, or it stands
            shares[[*mode.stopped]] = 0.0
            self._levelled(slopes, consumption, supply, mode, shares)
            creeping = sum((shares[number] * consumption.flows[number] for number in mode.creep), np.zeros(many))
            if np.allclose(creeping, flow_demands.before, rtol=1e-14, atol=0.0):
                break
            flow_demands = replace(flow_demands, before=creeping)
        moving = sum((share * way for share, way in zip(shares, ways, strict=True)), np.zeros_like(strokes))
        return FlowState(consumption, supply, shares, moving, ways, flow_demands)

    def _need_slopes(self, strokes: Array, consumption: Consumption, ways: Sequence[Array]) -> Array:
        """Return how fast the need of each consumer grows with the share of each (c, c, m) [Pa/s], by differences along its way."""
        whole, found = sum(ways, np.zeros_like(strokes)), []
        step = 3e-3 * np.ptp(self.spans, axis=1).max()
        for way in ways:
            far = step / np.maximum(np.abs(way).max(axis=0), 1e-300)
            around = (self.consumers.consumption(strokes + place * far * way, ways, whole, consumption).needs for place, _ in DIFFERENCES)
            found.append(sum(factor * np.array(each) for (_, factor), each in zip(DIFFERENCES, around, strict=True)) / far)
        return np.stack(found, axis=1)

    @staticmethod
    def _levelled(slopes: Array, consumption: Consumption, supply: FlowSupply, mode: Mode, shares: Array) -> None:
        """Put in the shares of those that go on level, or creep at the cut-off."""
        for own, rest in ((sorted(mode.creep), None), (sorted(mode.level), supply.rest)):
            for at in range(shares.shape[1]) if own else ():
                known = shares[:, at].copy()
                known[own] = 0.0
                flows = np.array([each[at] for each in consumption.flows])
                left = None if rest is None else float(np.broadcast_to(rest, shares.shape[1:])[at])
                found = level_shares(slopes[:, :, at], own, slopes[:, :, at] @ known, flows, left)
                if found is not None:
                    shares[own, at] = found

    def decided(self, time: float, strokes: Array, rates: Array, like: Mode) -> tuple[Mode, FlowState]:
        """Return the mode that is due at an instant, strokes and rates (n, 1), and its state; level or creeping stay as `like`."""
        at, moving, late = np.array([time]), rates, list[Mode]()
        for number in range(ROUNDS):
            consumption, ways = self.flow_demands(at, strokes, moving)
            mode, choose = replace(like, stopped=self.stopped(consumption, ways, strokes, 0)), Choices()
            flow_shares(self.asks(consumption, mode, 0), self.limits, choose)
            mode = replace(mode, choices=choose.made)
            found = self.state_of(strokes, mode, consumption, ways)
            slow = self.pace(found)
            if not self.consumers.follows_rates or np.allclose(slow, moving, rtol=1e-13, atol=1e-15):
                break
            late += [mode] if number >= ROUNDS // 2 else []
            moving = slow if number < 4 else 0.5 * (moving + slow)  # friction knows the sense alone, and is settled at once
        if len({*late}) > 1:
            who = ", ".join(ram.name for ram in self.rams)
            what = f"{self.plan.title}: at {show(time - AHEAD, 's', 7)} dampers or friction decide, by the speeds themselves,"
            raise DefinitionError(f"{what} which of {who} move; ask for less, or give the pump more pressure or sharing={BY_DEMAND!r}.")
        return mode, found

    @staticmethod
    def pace(moment: FlowState) -> Array:
        """Return the rates (n, m) at which friction and dampers are taken: those that wait are just about to move."""
        zero = np.zeros_like(moment.rates)
        return sum((np.maximum(share, IDLING) * way for share, way in zip(moment.shares, moment.ways, strict=True)), zero)

    def holds(self, mode: Mode, moment: FlowState, strokes: Array, at: int) -> bool:
        """Return whether a mode is the one that is due at one of some instants."""
        if self.stopped(moment.consumption, moment.ways, strokes, at) != mode.stopped:
            return False
        own, supply, choose = sorted(mode.level | mode.creep), moment.supply, Choices()
        if np.any((moment.shares[own, at] < 0.0) | (moment.shares[own, at] > 1.0)) or (mode.level and not mode.level <= {*supply.group}):
            return False
        if mode.creep and supply.group and self.limits.least_first:
            return False
        before = np.broadcast_to(moment.flow_demands.before, moment.shares.shape[1:])[at]
        flow_shares(replace(self.asks(moment.consumption, mode, at), before=float(before)), self.limits, choose)
        return choose.made == mode.choices

    def settled(self, time: float, strokes: Array, rates: Array) -> tuple[Mode, FlowState]:
        """Return the mode and state after an instant: the mode that is still due a small step ahead.

        Where two modes each lead to the other those that differ go on level, or creep at the cut-off.
        """
        time += AHEAD  # a demand may change its sense just there
        mode, moment = self.decided(time, strokes, rates, Mode((), ()))
        seen = list[tuple[Mode, FlowState]]()
        for _ in range(ROUNDS):
            ahead, _ = self.decided(time + AHEAD, strokes + AHEAD * moment.rates, self.pace(moment), mode)
            if ahead == mode:
                return mode, moment
            seen.append((mode, moment))
            back = next((place for place, (each, _) in enumerate(seen) if each == ahead), None)
            if back is not None:
                return self._between(time, strokes, seen[back:])
            mode, moment = ahead, self.moment(np.array([time]), strokes, self.pace(moment), ahead)
        return mode, moment

    def _between(self, time: float, strokes: Array, seen: Sequence[tuple[Mode, FlowState]]) -> tuple[Mode, FlowState]:
        """Return the mode between some of which each leads to the next; the first of them where none is settled."""
        blocked: list[set[int]] = [{*each.supply.blocked} for _, each in seen]
        creep = frozenset(set[int]().union(*blocked) - blocked[0].intersection(*blocked))
        shares = np.array([each.shares[:, 0] for _, each in seen])
        level = frozenset() if creep else frozenset(np.flatnonzero(np.ptp(shares, axis=0) > 1e-9).tolist())
        mode, moment = self.decided(time, strokes, self.pace(seen[0][1]), Mode((), (), level, creep))
        return (mode, moment) if self.holds(mode, moment, strokes, 0) else seen[0]

    # -- stretch by stretch --------------------------------------------------------------------------------

    def corners(self, begin: float, end: float) -> list[float]:
        """Return the instants between two at which a demand goes on otherwise, or changes its sense."""
        found = {begin, end}
        for each in (each for each in self.demands.values() if isinstance(each, Course)):
            inner = [begin, *(float(at) for at in each.breaks if begin < at < end), end]
            found.update(inner)
            for low, high in pairwise(inner):
                fine = np.linspace(low, high, 65)
                signs = np.sign(each(fine, phase=np.full(65, 0.5 * (low + high))))
                still = np.flatnonzero((signs[1:-1] == 0.0) & (signs[2:] * signs[:-2] != 0.0)) + 1
                found.update(fine[still].tolist())
                for place in np.flatnonzero(signs[1:] * signs[:-1] < 0.0):
                    ends = last_holding(lambda at, each=each, sign=signs[place]: np.sign(each(at)) == sign, fine[place], fine[place + 1])  # type: ignore[misc]
                    found.add(float(ends[0]))
        return sorted(found)

    def integrated(self, begin: float, end: float, strokes: Array, mode: Mode, moment: FlowState) -> tuple[Array, FlowState] | None:
        """Return the strokes (n, places) over a stretch in one mode, and the state; None where it is too long for one polynomial."""
        time, width = stretch_times(begin, end), end - begin
        passed, pace = strokes + moment.rates * (time - begin), np.repeat(self.pace(moment), DEGREE + 1, axis=1)
        size = np.ptp(self.spans, axis=1)[:, None]
        for number in range(ROUNDS):
            try:
                found = self.moment(time, passed, pace, mode)
            except AssemblyError:
                if width <= 10.0 * SHORTEST:
                    raise
                return None
            following = strokes + 0.5 * width * found.rates @ TO_INTEGRALS.T
            moved, paced = np.max(np.abs(following - passed) / size), self.pace(found)
            steady = not self.consumers.follows_rates or np.allclose(paced, pace, rtol=1e-13, atol=1e-14)
            passed, pace = following, paced if number < 8 else 0.5 * (pace + paced)
            if not np.isfinite(moved) or moved > 1e3:
                return None
            if moved <= 2e-14 and steady:
                needs = [each for each in found.consumption.needs if np.all(np.isfinite(each))]
                smooth = is_smooth([*found.rates / size], 1.0) and is_smooth([*needs, found.pump_pressure], self.limits.cut_off)
                begun = (each.speeds[:, 0] >= -AT_BORDER * np.abs(each.speeds).max() for own in found.consumption.branches for each in own)
                return (passed, found) if width <= 10.0 * SHORTEST or (smooth and all(map(np.all, begun))) else None
        return None

    def broken(self, time: Array, strokes: Array, mode: Mode, moment: FlowState) -> int | None:
        """Return the first place of a stretch at which another mode is due, or a load acts the other way; None where there is none.

        Its end is looked at just before, as a demand may change its sense there.
        """
        bad = np.any(moment.consumption.borders(moment.consumption, 0) < -AT_BORDER, axis=0)
        inner = np.flatnonzero((time > time[0] + 2.0 * AHEAD) & (time < time[-1])).tolist()
        found = next((at for at in inner if bad[at] or not self.holds(mode, moment, strokes, at)), None)
        late = np.array([time[-1] - 2.0 * AHEAD])
        if found is None and late[0] > time[0] + 2.0 * AHEAD and not self.due(late, time, strokes, mode, moment)[0]:
            return len(time) - 1
        return found

    def due(self, at: Array, time: Array, strokes: Array, mode: Mode, moment: FlowState) -> Mask:
        """Return at which instants (k,) of a stretch its mode is due."""
        there, paces = (
            chebyshev.chebval(2.0 * (at - time[0]) / (time[-1] - time[0]) - 1.0, (rows @ TO_COEFFICIENTS.T).T)
            for rows in (strokes, self.pace(moment))
        )
        found = self.moment(at, there, paces, mode, moment.consumption)
        bad = np.any(found.consumption.borders(moment.consumption, 0) < -1e-3 * AT_BORDER, axis=0)
        return np.array([not bad[k] and self.holds(mode, found, there, k) for k in range(len(at))])

    def border(self, time: Array, strokes: Array, mode: Mode, moment: FlowState, place: int) -> float:
        """Return the first instant of a stretch at which its mode is due no longer, before one of its places."""
        low = max(time[place - 1], time[0])
        close = CLOSE * max(1.0, abs(time[0]))
        return float(last_holding(lambda at: self.due(at, time, strokes, mode, moment), low, time[place], close, 8)[1])


def length_ends(ram: Ram, there: Motion) -> tuple[float, float]:
    """Return between which lengths a cylinder moves by its own closed length and stroke [m]; unbounded where it does not say them."""
    given = {name: one_design(ram.length_set(name, there)) for name in LENGTHS if name in ram.lengths_given}
    closed = given.get("closed", -np.inf)
    return closed, closed + given["stroke"] if len(given) > 1 else np.inf


# A whole run.


def worked(
    pump: ForceElement, machine: Mechanism, demands: Mapping[Reference, Demand], until: float, start: Mapping[str, float] | Motion | None,
    acting: Acting | None,
) -> PumpMotion:  # fmt: skip
    """Return how a machine moves while its cylinders are asked to, from event to event."""
    require_type("run: the machine", machine, Mechanism, "a design is expected, such as supply.run(Excavator(), ...)")
    plan = machine.plan
    given = demands_given(demands, plan)
    begin, strokes = run_start(machine, start)
    require_number("run: until", until, f"an instant behind {begin:.6g} s is expected", above=begin, kind="time")
    work = PumpedMachine(in_plan(pump, plan), machine, given, strokes, acting or Acting())
    ensure(acting is None or not acting.inertia, f"{plan.title}: {pump.name or 'a pump'}.run: {SLOW}")
    at_start = np.array([[strokes[name]] for name in work.consumers.strokes])
    stretches, coefficients, events = run_through(work, begin, float(until), at_start)
    times = np.array([*(each.time[0] for each in stretches), stretches[-1].time[-1]])
    phases = np.array(coefficients).transpose(1, 2, 0)
    courses: dict[str, Any] = {name: Course.of_phases(times, rows) for name, rows in zip(work.consumers.strokes, phases, strict=True)}
    case = acting.case if acting is not None else None
    cases = [name_of(case)] if case is not None and name_of(case) in ("plain", *plan.members) else None
    over = Over.path(time=(begin, float(until)), cases=cases, **courses)
    instants = cast(Instants, over.instants(plan, lambda name: float("nan")))
    instants = instants.shares(np.linspace(0.0, 1.0, INSTANTS))
    names, cylinders = [line.name for line in work.consumers.lines], [ram.name for ram in work.rams]
    shown_case = "" if cases is None else cases[0]
    cycle = PumpCycle(pump.name or "supply", names, cylinders, stretches, work.limits, shown_case, events, is_slow=has_masses(plan))
    vars(over)["found_in_run"] = FrozenDict({work.pump.name: PumpRun(cycle, plan, work.designs, acting or Acting())})
    found = PumpMotion(plan, work.designs, instants.strokes, "raise", over=over, instants=instants)
    vars(found).update(events=tuple(events), cycle=cycle)
    return found


def demands_given(demands: Mapping[Reference, Demand], plan: Plan) -> dict[str, Demand]:
    """Return demands by the names of cylinders; DefinitionError for one that is no speed."""
    example = f'demands={{"{next(iter(plan.of_kind(Ram)), "lift")}": 0.1}}'
    require_type(f"{plan.title}: demands", demands, Mapping, f"speeds of cylinders by their names are expected, {example}")
    require(len(demands) > 0, f"{plan.title}: demands", demands, f"nothing is asked for; name a cylinder, {example}")
    found: dict[str, Demand] = {}
    for each, demand in demands.items():
        what = f"{plan.title}: demands: {name_of(each)}"
        if not isinstance(demand, Course):
            require_measure(demand, "speed", what)
            is_speed = is_number(demand) or (isinstance(demand, float) and np.isinf(demand))
            require(is_speed, what, demand, "a speed in m/s is expected, or a Course of speeds over time")
            demand = float(demand)
        ensure(name_of(each) not in found, f"{what} is asked for twice, by its name and as a member; keep one of the two.")
        found[name_of(each)] = demand
    return found


def run_start(machine: Mechanism, start: Mapping[str, float] | Motion | None) -> tuple[float, dict[str, float]]:
    """Return when and at which strokes a run begins; DefinitionError for a stroke that there is not, or beyond its range."""
    plan, begin = machine.plan, 0.0
    found = {name: float(value) for name, value in plan.sketch_strokes.items()}
    if isinstance(start, Motion):
        require(start._instants is not None, f"{plan.title}: start", start, "a motion in time is expected, such as another run, or strokes")
        assert start._instants is not None
        begin, courses = float(start._instants.breaks[-1]), start._instants.courses
        missing = ", ".join(name for name in found if name not in courses)
        require(not missing, f"{plan.title}: start", start, f"a motion of this machine is expected; this one has no stroke {missing}")
        return begin, {name: float(courses[name](begin)) for name in found}
    known = as_mapping(dict.fromkeys(found, "..."))
    require_type(f"{plan.title}: start", start or {}, Mapping, f"strokes by their names are expected, {known}")
    for name, value in (start or {}).items():
        known_name("Stroke", name, found, where=f"{plan.title}: start")
        require_number(f"{plan.title}: start: {name}", value, "one finite number is expected, in SI", kind=plan.known_stroke_kind(name))
        low, high = sorted((float(plan.strokes[name].start), float(plan.strokes[name].end)))
        inside = low - AT_END <= float(value) <= high + AT_END
        require(inside, f"{plan.title}: start: {name}", value, f"a value from {low:.6g} to {high:.6g} is expected, its range")
        found[name] = float(value)
    require_kinds(plan, start or {})
    return begin, found


def run_through(work: PumpedMachine, begin: float, end: float, strokes: Array) -> tuple[list[Stretch], list[Array], list[PumpEvent]]:
    """Return all stretches of a run, the polynomials of the strokes in each, by powers of the time since it begins, and the events."""
    stretches, coefficients, events, tiny = list[Stretch](), list[Array](), Events(work), 0
    corners = work.corners(begin, end)
    for here, corner in pairwise(corners):
        time, width, settled = here, corner - here, None
        while time < corner:
            if settled is None:
                settled = work.settled(time, strokes, np.zeros_like(strokes))
                events.note(time, settled, is_corner=time == here > begin)
            mode, moment = settled
            last = corner if corner - time <= width * (1.0 + 1e-9) + SHORTEST else time + width
            found = work.integrated(time, last, strokes, mode, moment)
            if found is None:
                width = 0.5 * (last - time)
                ensure(width > SHORTEST, f"{work.plan.title}: at {time:.7g} s nothing smooth comes of what the pump is asked for.")
                continue
            instants = stretch_times(time, last)
            place = work.broken(instants, found[0], mode, found[1])
            if place is not None:
                last = work.border(instants, found[0], mode, found[1], place)
                ensure(last > time, f"{work.plan.title}: at {time:.7g} s one event follows the other without end.")
                found = work.integrated(time, last, strokes, mode, moment) or found
            passed, gone = found
            instants = stretch_times(time, last)
            going = (own for own, stands in zip(gone.consumption.branches, mode.stopped, strict=True) if not stands)
            for branch in (each for own in going for each in own):
                refuse_unpushed(branch, instants, work.pump)
            stretches.append(Stretch(instants, gone.pump_pressure, list(gone.shares), gone.consumption, gone.supply.blocked))
            coefficients.append(powers(strokes, gone.rates, last - time))
            width, time, strokes = 2.0 * (last - time) if place is None else max(width, last - time), last, passed[:, -1:]
            settled = None
            if place is None and time < corner:
                settled = mode, work.moment(np.array([time]), strokes, work.pace(gone)[:, -1:], mode)
            tiny = tiny + 1 if stretches[-1].time[-1] - stretches[-1].time[0] < SHORTEST else 0
            endless = tiny > ROUNDS or len(stretches) > MOST
            ensure(not endless, f"{work.plan.title}: up to {time:.7g} s one event follows the other without end.")
    return stretches, coefficients, events.found


def powers(strokes: Array, rates: Array, width: float) -> Array:
    """Return the polynomials (n, powers) of strokes over a stretch, by powers of the time since it begins, of rates at the places."""
    own = rates @ TO_COEFFICIENTS.T
    own[np.abs(own) <= 4e-16 * np.abs(own).max(axis=1, keepdims=True)] = 0.0
    found = np.zeros((len(strokes), DEGREE + 2))
    found[:, 0] = strokes[:, 0]
    shares = own @ TO_POWERS
    found[:, 1:] = shares / np.arange(1, DEGREE + 2) * width ** -np.arange(0.0, DEGREE + 1.0)
    return found


TO_POWERS = np.array([
    np.pad(chebyshev.Chebyshev.basis(k, domain=[0.0, 1.0]).convert(kind=np.polynomial.Polynomial, domain=[-1.0, 1.0]).coef, (0, DEGREE - k))
    for k in range(DEGREE + 1)
])  # fmt: skip
"""Chebyshev's polynomials from 0 to 1, by powers."""


class Events:
    """The events of a run, found by comparing the states before and after each."""

    def __init__(self, work: PumpedMachine) -> None:
        self.work, self.found = work, list[PumpEvent]()
        self._limit, self._waiting, self._creeping = "", frozenset[int](), frozenset[int]()
        self._stopped, self._blocked, self._level = frozenset[int](), frozenset[int](), frozenset[int]()

    def note(self, time: float, settled: tuple[Mode, FlowState], *, is_corner: bool) -> None:
        """Note the changes at an instant; DefinitionError where nothing more can move and no relief valve opens."""
        (mode, moment), work = settled, self.work
        names = [ram.name for ram in work.rams]
        asked = [number for number, way in enumerate(moment.ways) if np.any(way != 0.0)]
        stopped = frozenset(number for number in asked if mode.stopped[number])
        creeping = frozenset(number for number in mode.creep if moment.shares[number, 0] > 1e-9)
        blocked = frozenset(number for number in asked if number in moment.supply.blocked) - stopped - creeping
        starved = frozenset(number for number in asked if moment.shares[number, 0] < 1.0 - 1e-9)
        waiting = (starved | {*moment.supply.group}) - stopped - blocked - creeping
        cut_off = show(work.limits.cut_off, "bar", 4)
        if asked and len(stopped | blocked) == len(asked) and not work.has_relief:
            all_of = ", ".join(names[number] for number in asked)
            what = f"{work.plan.title}: from {show(time, 's', 7)} on all that is asked for is blocked, {all_of}"
            lines = f"and no relief valve is on the lines of {work.pump.name}"
            raise DefinitionError(f"{what}, {lines}; put one there, Relief(200 * bar) or relief=200 * bar, or end the demand.")
        if is_corner:
            self._add(time, "demand", work.pump.name, said("what is asked for changes"))
        for number in sorted(stopped - self._stopped):
            self._add(time, "stop", names[number], said("{cylinder} comes to its end and is blocked", cylinder=names[number]))
        for number in sorted(blocked - self._blocked):
            kind = "relief" if work.at_relief else "blocked"
            text = said("{cylinder} needs more than {pressure} and is blocked", cylinder=names[number], pressure=cut_off)
            if work.at_relief:
                text = said("{cylinder} is blocked, and the relief valve opens at {pressure}", cylinder=names[number], pressure=cut_off)
            self._add(time, kind, names[number], text)
        for number in sorted(creeping - self._creeping):
            self._add(time, "creeps", names[number], said("{cylinder} creeps at {pressure}", cylinder=names[number], pressure=cut_off))
        freed = (self._stopped | self._blocked | self._creeping) - stopped - blocked - creeping
        for number in sorted(freed & {*asked}):
            self._add(time, "freed", names[number], said("{cylinder} is free again", cylinder=names[number]))
        if (moment.supply.limit, waiting) != (self._limit, self._waiting):
            who = with_and(names[number] for number in sorted(waiting))
            most = show(work.limits.flow, "l/min", 4) if moment.supply.limit == "flow" else show(work.limits.power, "kW", 4)
            if not moment.supply.limit:
                text = said("all get what they ask for")
            elif moment.supply.limit == self._limit:
                text = said("{cylinders} waits", cylinders=who) if len(waiting) == 1 else said("{cylinders} wait", cylinders=who)
            elif moment.supply.limit == "flow":
                text = said("the pump gives its whole flow, {most}; {cylinders} must wait", most=most, cylinders=who)
            else:
                text = said("the pump gives its whole power, {most}; {cylinders} must wait", most=most, cylinders=who)
            if (moment.supply.limit and waiting) or (self._limit and blocked | stopped != {*asked}):
                self._add(time, {"": "free", self._limit: "waits"}.get(moment.supply.limit, moment.supply.limit), work.pump.name, text)
        if mode.level - self._level:
            who = with_and(names[number] for number in sorted(mode.level))
            self._add(time, "level", work.pump.name, said("{cylinders} go on at one pressure", cylinders=who))
        self._limit, self._waiting, self._creeping, self._level = moment.supply.limit, waiting, creeping, mode.level
        self._stopped, self._blocked = stopped, blocked

    def _add(self, time: float, kind: str, of: str, sentence: str) -> None:
        self.found.append(PumpEvent(time, kind, of, sentence))
