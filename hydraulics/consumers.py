"""Consumers of a pump while a machine moves: flows [m3/s] and needed gauge pressures [Pa], cylinder by cylinder.

A line takes oil where one of its chambers grows; of a LiftCircuit that has both sides the one that grows. Its need is
(F + p a) / (A k): F is the force in the sense of the movement, p the back pressure, a the area that empties, A the one that fills, and k
the hydraulic efficiency. The mechanical efficiency stands in F. Of joined cylinders F, a and A are sums over all, each by how it moves with
the first: one past its dead point gives oil back. Where a need is below zero the load drives, and is braked. A holding valve is opened by
its pilot, whose pressure the pump has to give then.
Nothing of it follows the inertia: sharing is quasi-static. Friction and dampers go by the rates.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any

import numpy as np

from linkage.errors import DefinitionError, ensure, unknown
from linkage.frozen import immutable
from linkage.loads import AS_IT_RUNS, Acting, ForceElement
from linkage.motion import Motion, PoseFunction, Request, ratio
from linkage.motion.requests import as_they_run
from linkage.plan import Plan, rate_name
from linkage.quantities import NamedMembers, distance, of_kind
from linkage.quantities.member import in_class
from linkage.statics import AnyMotion, LawRequest, each_once, same, stroke_followed
from linkage.units import show

from .cylinders import PISTON, ROD, OnLines, Ram, by_other_lines, cylinder_request, line_thrust, lines_of, refuse_gas
from .inputs import Array, one_design
from .lifting_line import LiftLine
from .valve import HoldingValve

AT_BORDER = 1e-9
"""Of its size: what is on the other side of a border by no more is on it."""
STANDS = 1e-10
"""Of the rates of the strokes: a length that changes by less stands, to rounding."""


@immutable
class Inlet:
    """How a cylinder takes oil from a line while it extends or retracts (`sense` 1 or -1).

    `sides` say with which parts the areas of its sides count, pistons first; below zero it gives oil back to the others of its line.
    `back` is the pressure of what it puts out [Pa], the efficiencies are the pump's.
    """

    line: LiftLine
    ram: Ram
    sense: float
    sides: tuple[float, float]
    back: float
    mechanical: float
    hydraulic: float
    valve: OnLines | None

    @property
    def direction(self) -> str:
        """The direction in which the cylinder moves."""
        return "extending" if self.sense > 0.0 else "retracting"


@immutable
class Branch:
    """The flow of joined cylinders from one line over some instants: `flow` (m,), the `need` (m,), `force` and `speed` of the first.

    `signed` is what the need would be if a load could drive the pump. `fills` is the area that fills as the first moves [m2]: where it is
    below zero they empty the line, and need nothing of it. `speeds` are those of all.
    """

    inlets: tuple[Inlet, ...]
    flow: Array
    need: Array
    signed: Array
    force: Array
    fills: Array
    speeds: Array

    @property
    def inlet(self) -> Inlet:
        """That of the first cylinder."""
        return self.inlets[0]

    @property
    def is_fed(self) -> bool:
        """Whether they take oil, in the middle of the instants."""
        return bool(self.fills[len(self.fills) // 2] > 0.0)

    @property
    def useful(self) -> Array:
        """The power from the oil to the machine (m,) [W], its efficiencies included."""
        return np.maximum(self.need, 0.0) * self.flow

    @property
    def braked(self) -> Array:
        """The load's power that is throttled away (m,) [W]."""
        return self.useful - (self.signed * self.flow if self.is_fed else self.force * self.speeds[0])


@immutable
class Consumption:
    """The flows of all consumers over some instants, each with its branches, and the lengths of the cylinders (rams, m) [m]."""

    branches: Sequence[Sequence[Branch]]
    lengths: Array
    slopes: Array

    @cached_property
    def flows(self) -> list[Array]:
        """The flow of each consumer (m,)."""
        zero = 0.0 * self.lengths[0]
        return [sum((each.flow for each in own), zero) for own in self.branches]

    @cached_property
    def needs(self) -> list[Array]:
        """The highest of the needs of each consumer (m,), below zero where the load drives."""
        low = np.full(self.lengths.shape[1], -np.inf)
        return [np.max([low, *(each.need for each in own if each.inlet.sides is not None)], axis=0) for own in self.branches]

    def borders(self, like: Consumption, at: int | None = None) -> Array:
        """Return values above zero while all is as in the middle of a stretch, or `at` one of its places, (rows, m).

        Beyond it loads act the other way. Rows are over the sizes that they have in that stretch. What is zero at the place, to rounding,
        counts as at the next one.
        """
        rows, place = [], like.lengths.shape[1] // 2 if at is None else at
        for own, others in zip(self.branches, like.branches, strict=True):
            lead = max(range(len(own)), key=lambda k: others[k].need[place if at is None else place + 1], default=0)
            for each, other in zip(own, others, strict=True):
                size = max(float(np.abs(other.signed).max()), 1.0)
                known = other.signed[place]
                known = other.signed[place + 1] if at is not None and abs(known) <= AT_BORDER * size else known
                rows.append(each.signed * np.sign(known) / size)
                rows += [speed / max(float(np.abs(its).max()), 1e-300) for speed, its in zip(each.speeds, other.speeds, strict=True)]
                rows.append(each.fills * np.sign(other.fills[place]) / max(float(np.abs(other.fills).max()), 1e-300))
                rows.append((own[lead].need - each.need) / size)
        return np.array(rows).reshape(-1, self.lengths.shape[1])


class Consumers:
    """The lines on a pump, with the cylinders on them, of one design in one situation.

    Parameters
    ----------
    plan, designs
        The machine.
    pump : ForceElement
        The pump, as it is in the class.
    acting : Acting
        The situation; inertia is left out.

    Raises
    ------
    DefinitionError
        No line is on the pump; a batch of designs.
    """

    def __init__(self, plan: Plan, designs: Mapping[str, Any], pump: ForceElement, acting: Acting, strokes: Mapping[str, float]) -> None:
        self.plan, self.pump, self.members = plan, pump, plan.members
        self.pumped = {each: each for each in lines_on(pump, plan.members)}
        """The lines that it feeds, each with the one that says its numbers; on a tank the pilot of a holding valve over which it lowers."""
        for line, pilot in [each.lines(plan.members) for each in of_kind(plan.members, HoldingValve).values()]:
            if line in self.pumped and isinstance(pilot, LiftLine) and pilot.pump(plan.members) is None:
                self.pumped[pilot] = self.pumped[line]
        self.lines = [*self.pumped]
        what = f"{plan.title}: no line is on {pump.name or pump}"
        ensure(self.lines, f"{what}; put it on one, OilLine(lift.piston_side, supply) or LiftCircuit(lift, supply).")
        ensure(not any(map(np.ndim, designs.values())), f"{plan.title}: one pump is shared in one design at a time; take one of the batch.")
        for line in self.lines:
            refuse_gas(line, plan)
        self.rams: tuple[Ram, ...] = each_once(ram for line in self.lines for ram in line.members(plan.members))
        self.strokes = tuple(plan.strokes)
        acting = replace(acting, direction=AS_IT_RUNS, inertia=False, rates=None, accelerations=None)
        asked: list[Request | Any] = []
        for ram in self.rams:
            asked.append(cylinder_request("line force", ram.name, acting, force_on_lines, measures="force"))
            asked.append(distance(ram.A, ram.B))
            asked += [ratio(distance(ram.A, ram.B), name) for name in self.strokes]
            asked += [area_request(ram, side) for side in (PISTON, ROD)]
            asked.append(cylinder_request("tank force", ram.name, acting, force_of_tanks, measures="force"))
        there = Motion(plan, designs, {name: np.asarray(strokes[name]) for name in self.strokes}, "nan")
        on = [(line, ram) for line in self.lines for ram in line.members(self.members)]
        self.inlets = [self._inlet(line, ram, sense, there) for line, ram in on for sense in (1.0, -1.0)]
        self.places = {id(ram): place for place, ram in enumerate(self.rams)}
        self.followed = {id(ram): stroke_followed(plan, ram) for line, ram in on if len(line.members(plan.members)) > 1}
        self.valved = [each for each in self.inlets if each.valve is not None]
        asked += [pilot_request(each, acting) for each in self.valved]
        self.designs, self._asked = designs, as_they_run(asked, False)
        self._function = PoseFunction(plan, designs, asked, 1)
        at = np.array([[strokes[name]] for name in self.strokes])
        rates = np.array([[0.05 + 0.01 * number] for number in range(len(self.strokes))])
        rest, *moving = (self.rows(at, way * rates) for way in (0.0, 1.0, -1.0))
        size = np.abs(rest).max(axis=1, initial=1.0, keepdims=True)
        self.follows_rates = any(bool(np.any(np.abs(each - rest) > 1e-9 * size)) for each in moving)
        """Whether friction or dampers act, so that needs follow the rates."""

    def _inlet(self, line: LiftLine, ram: Ram, sense: float, there: Motion) -> Inlet:
        """Return how a cylinder takes oil from a line while it moves in a sense."""
        own = [chamber.side for each, chamber in line.filling(self.members) if same(each, ram)]
        joined = len(own) > 1 and ram.side == "regenerative"
        filled, emptied = (PISTON, ROD) if sense > 0.0 else (ROD, PISTON)
        empties = emptied in own and (joined or filled not in own)
        piston, rod = (float(side == filled and side in own) - float(side == emptied and empties) for side in (PISTON, ROD))
        mechanical, hydraulic = (one_design(self.pumped[line].efficiency(there, kind)) for kind in ("mechanical", "hydraulic"))
        back = 0.0 if joined else one_design(line.back(there))
        acting = Acting(direction="extending" if sense > 0.0 else "retracting")
        valves = of_kind(self.members, OnLines).values() if filled in own else ()
        lowering = (each for each in valves if each.pressure_lowering(line, ram, there, acting) is not None)
        return Inlet(line, ram, sense, (piston, rod), back, mechanical, hydraulic, next(iter(lowering), None))

    # -- over instants -------------------------------------------------------------------------------------

    def rows(self, strokes: Array, rates: Array) -> Array:
        """Return all that is asked of the machine, (rows, m), at strokes (n, m) moving at rates (n, m)."""
        if self._function.is_quick:
            return np.array([self._function(*at, *moving) for at, moving in zip(strokes.T.tolist(), rates.T.tolist(), strict=True)]).T
        moving = {rate_name(name, 1): np.ascontiguousarray(each) for name, each in zip(self.strokes, rates, strict=True)}
        poses = Motion(
            self.plan, self.designs, dict(zip(self.strokes, map(np.ascontiguousarray, strokes), strict=True)), rate_inputs=moving
        )
        return np.array([np.broadcast_to(poses[each], strokes.shape[1:]) for each in self._asked])

    def consumption(self, strokes: Array, ways: Sequence[Array], rates: Array, like: Consumption | None = None) -> Consumption:
        """Return the flows of consumers whose movements are `ways`, rates of the strokes (n, m) each, while all move at `rates`.

        Cylinders move as in the middle of the instants, or as in others that it is `like`.
        """
        return self.consumption_of(self.rows(strokes, rates), ways, like)

    def consumption_of(self, rows: Array, ways: Sequence[Array], like: Consumption | None = None) -> Consumption:
        """Return the same from rows that the machine has given."""
        count, many = len(self.strokes), rows.shape[1]
        each_of = rows[: len(self.rams) * (count + 5)].reshape(len(self.rams), count + 5, many)
        pilots = dict(zip(map(id, self.valved), rows[len(self.rams) * (count + 5) :], strict=True))
        slopes = each_of[:, 2 : count + 2]
        speeds = [(slopes * way).sum(axis=1) for way in ways]
        begun = [(slopes * self._begun(way)).sum(axis=1) for way in ways]
        if like is None:
            areas = each_of[:, -3:-1, many // 2]
            moving = [self._moving(areas, speed[:, many // 2], way) for speed, way in zip(speeds, ways, strict=True)]
        else:
            moving = [[each.inlets for each in own] for own in like.branches]
        each_way = zip(speeds, begun, moving, strict=True)
        found = [[self._branch(each_of, speed, goes, own, pilots) for own in joined] for speed, goes, joined in each_way]
        return Consumption(found, each_of[:, 1], slopes)

    @staticmethod
    def _begun(way: Array) -> Array:
        """Return a way without the instants at which all stands: as at the nearest one at which something moves."""
        moved = np.flatnonzero(way.any(axis=0))
        nearest = np.abs(np.arange(way.shape[1])[:, None] - moved).argmin(axis=1) if len(moved) else 0
        return way[:, moved[nearest]] if len(moved) else way

    def _moving(self, areas: Array, speeds: Array, way: Array) -> list[tuple[Inlet, ...]]:
        """Return the inlets of cylinders that move, joined as one stroke moves them on one line, the one that takes or gives most first.

        `areas` are those of their sides (rams, 2), `speeds` (rams,) those in the middle of the instants. Of those that empty their line
        the ones are left out that another line fills while they move so.
        """
        least = STANDS * np.abs(way[:, way.shape[1] // 2]).sum()
        joined, flows = dict[tuple[LiftLine, str], list[Inlet]](), dict[int, float]()
        for each in self.inlets:
            place = self.places[id(each.ram)]
            if each.sense * speeds[place] > least:
                flows[id(each)] = float(each.sides @ areas[place] * abs(speeds[place]))
                joined.setdefault((each.line, self.followed.get(id(each.ram), "")), []).append(each)
        groups = [sorted(own, key=lambda each: -abs(flows[id(each)])) for own in joined.values()]
        is_fed = [sum(flows[id(each)] for each in own) > 0.0 for own in groups]
        fed = {id(each.ram) for own, takes in zip(groups, is_fed, strict=True) for each in own if takes}
        found = []
        for own, takes in zip(groups, is_fed, strict=True):
            found.append(tuple(each for each in own if takes or not (id(each.ram) in fed or self._is_filled_by_another(each))))
        return [each for each in found if each]

    def _branch(self, each_of: Array, speeds: Array, begun: Array, inlets: tuple[Inlet, ...], pilots: Mapping[int, Array]) -> Branch:
        """Return the flow of joined cylinders; their speeds that have `begun` tell how they go with the first, where all stands, too."""
        first, places = inlets[0], [self.places[id(each.ram)] for each in inlets]
        senses = np.array([each.sense for each in inlets])[:, None]
        moved, goes = senses * speeds[places], senses * begun[places]
        goes = goes / np.where(goes[0] == 0.0, 1.0, goes[0])
        goes[0] = 1.0
        drained = (goes * senses * each_of[places, -1]).sum(axis=0)
        force = (goes * senses * each_of[places, 0]).sum(axis=0) + drained
        force = np.where(force > 0.0, force / first.mechanical, force * first.mechanical) - drained
        sides = np.array([each.sides for each in inlets])
        returns = sides[:, ::-1] * np.array([[each.back] for each in inlets])
        filled, emptied = (goes * np.einsum("rs,rsm->rm", parts, each_of[places, -3:-1]) for parts in (sides, returns))
        fills, nothing = filled.sum(axis=0), np.zeros(speeds.shape[1])
        if not fills[len(fills) // 2] > 0.0:
            return Branch(inlets, nothing, nothing, force, force, fills, moved)
        signed = (force + emptied.sum(axis=0)) / (fills * first.hydraulic)
        need = signed if id(first) not in pilots else np.where(signed < 0.0, pilots[id(first)], signed)
        return Branch(inlets, fills * moved[0], need, signed, force, fills, moved)

    def _is_filled_by_another(self, inlet: Inlet) -> bool:
        """Return whether a line of another pump fills a cylinder while it moves that way."""
        fills = PISTON if inlet.sense > 0.0 else ROD
        return any(each.side == fills and line not in self.lines for line, each in lines_of(inlet.ram, self.members, "held"))


def in_plan(pump: ForceElement, plan: Plan) -> ForceElement:
    """Return a pump as it is in a machine, which has its numbers; the pump itself where the machine has none of that name."""
    found = in_class(plan.members, pump)
    return found if isinstance(found, ForceElement) else pump


def lines_on(pump: ForceElement, members: NamedMembers) -> list[LiftLine]:
    """Return the lines that a pump is on."""
    return [line for line in of_kind(members, LiftLine).values() if (found := line.pump(members)) is not None and same(found, pump)]


def force_on_lines(motion: AnyMotion, ram: Ram, acting: Acting) -> Array:
    """Return the force of a cylinder less the parts of its lines with a given pressure [N]."""
    return line_thrust(ram, None, motion, acting)


def force_of_tanks(motion: AnyMotion, ram: Ram, acting: Acting) -> Array:
    """Return the thrust of tanks on a cylinder [N], on which the pump's mechanical efficiency does not count."""
    return by_other_lines(ram, None, motion, acting, True) + 0.0 * motion.distance(ram.A, ram.B)


def area_request(ram: Ram, side: str) -> LawRequest:
    """Return the request for the area of a side of a cylinder [m2]."""

    def over(motion: AnyMotion) -> Array:
        size = ram.sized(motion)
        return (size.push_area if side == PISTON else size.pull_area) + 0.0 * motion.distance(ram.A, ram.B)

    return LawRequest(formula=over, text=f"{ram.name} {side} area", known=("area", ram.name, side))


def pilot_request(inlet: Inlet, acting: Acting) -> LawRequest:
    """Return the request for the pressure that opens a valve while a cylinder lowers its load over it [Pa]."""

    def over(motion: AnyMotion, ram: Ram, acting: Acting) -> Array:
        assert inlet.valve is not None
        found = inlet.valve.pressure_lowering(inlet.line, ram, motion, Acting(acting.loads, acting.case, inlet.direction))
        return np.asarray(found)[()] + 0.0 * motion.distance(ram.A, ram.B)

    return cylinder_request("pilot", inlet.ram.name, acting, over, (inlet.line.name, inlet.direction), measures="pressure")


def refuse_unpushed(branch: Branch, time: Array, pump: ForceElement) -> None:
    """Raise DefinitionError where a cylinder is to move that neither oil nor its load pushes that way, or that no oil brakes."""
    inlet, pump_name = branch.inlet, pump.name or "supply"
    loose = np.flatnonzero((branch.force < -AT_BORDER * np.abs(branch.force).max()) & (branch.speeds[0] > 0.0))
    if len(loose) and inlet.sense > 0.0 and inlet.ram.only_pushes:
        name, instant = inlet.ram.name, show(float(time[max(loose[0] - 1, 0)]), "s", 4)
        what = f"{name} runs away extending at {instant}: its load pulls at it, and no oil brakes it, since its line only pushes"
        raise DefinitionError(f"{what}; let the load press on it, or take a cylinder whose rod side has a line of its own.")
    at = np.flatnonzero((branch.force > AT_BORDER * np.abs(branch.force).max()) & (branch.speeds[0] > 0.0))
    if len(at) and not branch.is_fed:
        ram, other = inlet.ram.name, "rod" if inlet.sense < 0.0 else "piston"
        instant = show(float(time[max(at[0] - 1, 0)]), "s", 4)
        what = f"{ram} cannot go on {inlet.direction} at {instant}: its load resists, and no pump fills its {other} side"
        raise DefinitionError(f"{what}; put that on the pump, OilLine({ram}.{other}_side, {pump_name}), or demand nothing there.")


def cylinder_named(consumers: Consumers, name: str) -> int:
    """Return the number of a cylinder that is demanded, on the pump's lines; DefinitionError for another name."""
    names = [ram.name for ram in consumers.rams]
    if name not in names:
        known = of_kind(consumers.members, Ram)
        remedy = f"put it on one, LiftCircuit({name}, {consumers.pump.name}), or ask the pump that feeds it"
        ensure(name not in known, f"{consumers.plan.title}: demands: {name} is on no line of {consumers.pump.name}; {remedy}.")
        raise unknown("Cylinder", name, names, where=f"{consumers.plan.title}: demands")
    return names.index(name)
