"""A working cycle of one pump: flow, pressure and power over time, litres, and where the energy goes. SI, gauge pressures in Pa.

A cycle is made of stretches between borders: kinks of the courses, events, a need that passes zero, another load that is the heaviest. Each
has values at Chebyshev's places, so that all in it is a polynomial to rounding, with its integrals and its highest places.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.polynomial import chebyshev

from linkage import DefinitionError, Verdict
from linkage.disk import replacing_text
from linkage.frozen import FrozenDict, immutable, read_only, record
from linkage.language import said
from linkage.loads import PLAIN_CASE, Acting, ForceElement, case_titles
from linkage.motion import Instants, Judge, Motion, from_above
from linkage.motion.grid import recalled
from linkage.numeric import last_holding
from linkage.plan import Plan
from linkage.quantities import name_of
from linkage.statics import has_masses
from linkage.units import show

from .consumers import AT_BORDER, Consumers, Consumption, lines_on, refuse_unpushed
from .inputs import Array, number_set, one_design, positive
from .sharing import LEAST_PRESSURE, PumpLimits

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DEGREE = 12
"""Of the polynomials over a stretch."""
PLACES = -np.cos(np.pi * np.arange(DEGREE + 1) / DEGREE)
"""Chebyshev's places, -1 to 1, ends included."""
TO_COEFFICIENTS = np.linalg.inv(chebyshev.chebvander(PLACES, DEGREE))
TO_INTEGRALS = (
    np.stack([chebyshev.chebval(PLACES, chebyshev.chebint(row, lbnd=-1.0)) for row in np.eye(DEGREE + 1)], axis=1) @ TO_COEFFICIENTS
)
"""What makes integrals from the first place on of values at the places."""
SMOOTH = 1e-11
"""Of the largest value: the last coefficients of what is a polynomial to rounding."""
PLATEAU = 1e-10
"""Of the highest value: what is no lower is as high, and the first such instant is told."""
SLOW = "acting= has inertia=True, but a pump's demands leave inertia out; leave it out, pressure(cylinder) of a motion in time counts it."
"""Why a pump's demands are not worked out where inertia is insisted on."""
SHORTEST = 1e-9
"""s; no stretch is divided any finer."""


def is_smooth(rows: Sequence[Array], size: float) -> bool:
    """Return whether values at the places are polynomials, to rounding of their `size`."""
    return not len(rows) or bool(np.all(np.abs(np.array(rows) @ TO_COEFFICIENTS.T[:, -2:]) <= SMOOTH * size))


@immutable
class PumpEvent:
    """An event of a cycle: its `time` [s], its `kind`, its `cylinder` or line, and a sentence."""

    time: float
    kind: str
    of: str
    sentence: str

    def __str__(self) -> str:
        return said("at {time}: {sentence}", time=show(self.time, "s", 7), sentence=self.sentence)


@record
class PumpEnergy:
    """The energy of a cycle [J]: pump = useful + throttled + margin; `braked` is the loads' energy that is throttled away."""

    pump: float
    useful: float
    throttled: float
    margin: float
    braked: float


@immutable
class Stretch:
    """A stretch between two borders: instants (m,), the pump's pressure there, and each consumer's share and branches.

    A consumer that is `blocked` takes the pump's pressure and no oil.
    """

    time: Array
    pressure: Array
    shares: Sequence[Array | float]
    consumption: Consumption
    blocked: tuple[int, ...] = ()


class PumpCycle:
    """A working cycle of one pump, as `Pump.check` and `Pump.run` give it.

    Parameters
    ----------
    pump : str
        The name of the pump.
    lines, cylinders : sequence of str
        The names of its lines, and of the cylinders that they move.
    stretches : sequence of Stretch
        The stretches of time between two borders.
    limits : PumpLimits
        The pump's pressure, flow and power.
    case : str, optional
        The load case.
    events : sequence of PumpEvent, optional
        What happened in a run.
    is_slow : bool, optional
        Whether there are masses, whose inertia is left out; the verdict says so.

    Attributes
    ----------
    time : array (n,)
        The instants [s]; both sides of a border have one each.
    flow, pressure, power : mapping of str to array (n,)
        Of the pump and of each line [m3/s, Pa gauge, W]: what a line takes, what it needs, and the product of both.
    share : mapping of str to array (n,)
        By cylinder, which part of what it asks for it gets: below 1 it waits.
    parts : mapping of str to array (n,)
        The powers [W] by which the energy goes: "pump", "useful", "throttled", "margin", "braked".
    litres : mapping of str to float
        The oil [l], by the same names.
    energy : PumpEnergy
        The energies [J], with the same parts as attributes.
    verdict : Verdict
        Whether the pump gives what is asked for.
    stretch : float
        How many times longer it takes the pump.
    """

    def __init__(
        self, pump: str, lines: Sequence[str], cylinders: Sequence[str], stretches: Sequence[Stretch], limits: PumpLimits, case: str = "",
        events: Sequence[PumpEvent] = (), *, is_slow: bool = False,
    ) -> None:  # fmt: skip
        self.pump, self.case, self.limits, self.events, self.is_slow = pump, case, limits, tuple(events), is_slow
        self.time = read_only(np.concatenate([each.time for each in stretches]))
        self._lengths = np.array([each.time[-1] - each.time[0] for each in stretches])
        flow: dict[str, Array] = {name: np.zeros(len(self.time)) for name in (pump, *lines)}
        need, share = {name: np.zeros(len(self.time)) for name in lines}, {name: np.ones(len(self.time)) for name in cylinders}
        parts = {name: np.zeros(len(self.time)) for name in ("useful", "braked")}
        for number, each in enumerate(stretches):
            own = slice(number * (DEGREE + 1), (number + 1) * (DEGREE + 1))
            for place, (part, branches) in enumerate(zip(each.shares, each.consumption.branches, strict=True)):
                for branch in branches:  # its flow, times its consumer's share
                    name = branch.inlet.line.name
                    flow[name][own] += part * branch.flow
                    if branch.is_fed:
                        needed = each.pressure if place in each.blocked else np.maximum(branch.need, 0.0)
                        need[name][own] = np.maximum(need[name][own], needed)
                    parts["useful"][own] += part * branch.useful
                    parts["braked"][own] += part * branch.braked
                if place < len(cylinders):
                    share[cylinders[place]][own] = part
        flow[pump] = sum((flow[name] for name in lines), flow[pump])
        pressure = np.concatenate([each.pressure for each in stretches])
        parts |= {"pump": pressure * flow[pump], "margin": limits.margin * flow[pump]}
        parts["throttled"] = parts["pump"] - parts["useful"] - parts["margin"]
        self.flow, self.share = unchanged(flow), unchanged(share)
        self.pressure = unchanged({pump: pressure, **need})
        self.parts = unchanged(parts)
        self.power = unchanged({name: flow[name] * need.get(name, pressure) for name in flow})

    def integral(self, values: Array) -> float:
        """Return the integral of values over time, shape (n,).

        Parameters
        ----------
        values : ndarray
            Values at the instants, shape (n,).

        Returns
        -------
        float
            The integral.
        """
        return float(np.sum(values.reshape(-1, DEGREE + 1) @ TO_INTEGRALS[-1] * self._lengths) / 2.0)

    @cached_property
    def litres(self) -> Mapping[str, float]:
        """The oil that the pump gives and each line takes [l]."""
        return FrozenDict({name: 1e3 * self.integral(values) for name, values in self.flow.items()})

    @cached_property
    def energy(self) -> PumpEnergy:
        """Where the energy goes [J]."""
        return PumpEnergy(**{name: self.integral(values) for name, values in self.parts.items()})

    @property
    def duration(self) -> float:
        """How long it takes [s]."""
        return float(self.time[-1] - self.time[0])

    def peak(self, values: Array) -> tuple[float, float]:
        """Return the highest of some values over time, shape (n,), and its instant [s], between the instants too.

        Parameters
        ----------
        values : ndarray
            Values at the instants, shape (n,).

        Returns
        -------
        tuple of float
            The highest value and its instant [s].
        """
        rows, times = values.reshape(-1, DEGREE + 1), self.time.reshape(-1, DEGREE + 1)
        highest = rows.max(axis=1)
        number = int(np.argmax(highest >= highest.max() - PLATEAU * abs(highest.max())))
        own = TO_COEFFICIENTS @ rows[number]
        own[np.abs(own) <= SMOOTH * np.abs(own).max()] = 0.0
        flat = chebyshev.chebroots(chebyshev.chebder(chebyshev.chebtrim(own))) if np.any(own[1:]) else np.zeros(0)
        tried = np.concatenate([PLACES, flat[np.abs(flat.imag) < 1e-9].real])
        tried = tried[np.abs(tried) <= 1.0]
        found = chebyshev.chebval(tried, own)
        best = int(np.argmax(found >= found.max() - PLATEAU * abs(found.max())))
        begin, end = times[number, [0, -1]]
        return float(found[best]), float(begin + 0.5 * (end - begin) * (tried[best] + 1.0))

    @cached_property
    def stretch(self) -> float:
        """How many times longer than this the pump takes for the same, 1 at the least; infinite where its pressure is not enough."""
        flow, power = (self.peak(each[self.pump])[0] for each in (self.flow, self.power))
        long = max(1.0, flow / self.limits.flow, power / self.limits.power)
        return np.inf if self.peak(self.pressure[self.pump])[0] > self.limits.cut_off * (1.0 + AT_BORDER) else long

    @property
    def verdict(self) -> Verdict:
        """Whether the pump meets all demands; if not, the shortage, and the time in which it can be done."""
        limits, texts = self.limits, list[str]()
        asked = [(self.flow, limits.flow, "l/min"), (self.power, limits.power, "kW"), (self.pressure, limits.cut_off, "bar")]
        for values, most, unit in asked:
            value, time = self.peak(values[self.pump])
            if np.isfinite(most) and (unit != "bar" or value > most * (1.0 + AT_BORDER)):
                given = {"value": show(value, unit, 4), "time": show(time, "s", 4), "most": show(most, unit, 4)}
                texts.append(said("{value} at {time} of {most}", **given))
        what = "; ".join(texts)
        text = said("gives {what}", what=what) if self.share else said("needs {what}", what=what)
        if self.stretch > 1.0 + AT_BORDER:
            long, short = show(self.stretch * self.duration, "s", 4), show(self.duration, "s", 4)
            how = said("it can be done in {long} instead of {short}", long=long, short=short)
            text = f"{text}; {how if np.isfinite(self.stretch) else said('no longer time makes up for the pressure: take larger bores')}"
        text = said("{text}, in the case {case}", text=text, case=self.case) if self.case else text
        text = said("{text}; inertia is left out", text=text) if self.is_slow else text
        return Verdict("pump", self.stretch <= 1.0 + AT_BORDER, f"{text}.")

    def plot(self) -> Figure:
        """Return a figure of flow, pressure and power over time, with the pump's limits, who waits, and the events in numbers.

        Returns
        -------
        matplotlib.figure.Figure
            Save it by `figure.savefig("cycle.png")`.
        """
        figure: Figure = from_above("hydraulics.cycle_chart:plot_cycle")(self)
        return figure

    def to_csv(self, path: str | Path) -> Path:
        """Write the instants with flow, pressure and power of the pump and of each line, units in the headings.

        Parameters
        ----------
        path : str or Path
            An existing file is replaced whole.

        Returns
        -------
        Path
            The path of the file.

        Raises
        ------
        FileError
            It cannot be written.
        """
        with replacing_text(path) as stream:
            from_above("linkage.reports:write_csv")(from_above("hydraulics.cycle_chart:cycle_columns")(self), stream)
        return Path(path)

    def __repr__(self) -> str:
        return f"<PumpCycle of {self.pump}: {self.duration:.4g} s, {self.litres[self.pump]:.4g} l, {self.energy.pump / 1e3:.4g} kJ>"


def unchanged(arrays: Mapping[str, Array]) -> Mapping[str, Array]:
    """Return arrays by name that do not change."""
    return FrozenDict({name: read_only(each) for name, each in arrays.items()})


@immutable
class PumpRun:
    """A pump's run: its cycle, with its machine, its design and its situation. It stands with the path that the run made."""

    cycle: PumpCycle
    plan: Plan
    designs: Mapping[str, Any]
    acting: Acting

    @staticmethod
    def known(pump: ForceElement, place: Any, case: str) -> PumpCycle | None:
        """Return the cycle of the run that made a path, of the same machine and design in the same load case; None where there is none."""
        run = place.over.found_in_run.get(pump.name)
        if run is None or run.plan is not place.plan:
            return None
        if any(not np.array_equal(run.designs[name], value) for name, value in place.designs.items()):
            return None
        own = PLAIN_CASE if run.acting.case is None else name_of(run.acting.case)
        return run.cycle if run.acting.loads is None and own == case else None


def limits_of(pump: ForceElement, consumers: Consumers, there: Motion) -> PumpLimits:
    """Return a pump's limits: its own numbers, and the lowest of its pressure and the relief valves on its lines."""
    title = pump.name or "supply"
    flow = one_design(number_set(pump, there, "flow"))
    positive(flow, f"Flow of {title}", "give it in m3/s, such as flow=60 * litre / minute")
    power = np.inf if pump.given("power") is None else one_design(number_set(pump, there, "power"))
    if np.isfinite(power):
        positive(power, f"Power of {title}", "give watts, such as power=5.75 * kW, or leave it out")
    cut_off = min(one_design(line.supply(there)) for line in consumers.pumped.values())
    return PumpLimits(flow, power, one_design(number_set(pump, there, "margin")), cut_off, pump.given("sharing") == LEAST_PRESSURE)


# A given motion.


def cycles_over(pump: ForceElement, place: Any, acting: Acting) -> list[PumpCycle]:
    """Return the demands on a pump over a path in time, in each load case that occurs there; results are cached."""
    cases, found = place.cases(acting), []
    for case in cases:
        situation = acting if acting.case is not None and len(cases) == 1 else replace(acting, case=case)
        label = case_titles(place.plan).get(case, case) if len(cases) > 1 else ""
        make = partial(cycle_over, pump, place, situation, label)
        if acting.loads is None and (acting.case is None or isinstance(acting.case, str)):  # the machine's loads, in a case of its own
            found.append(PumpRun.known(pump, place, case) or recalled(place.motion, ("pump cycle", pump.name, case, label), make))
        else:
            found.append(make())
    return found


def cycle_over(pump: ForceElement, place: Any, situation: Acting, label: str) -> PumpCycle:
    """Return the demands on a pump over a path in time in one load case."""
    instants = place.instants or place.motion._instants
    start = {name: float(course(instants.breaks[0])) for name, course in instants.courses.items()}
    consumers = Consumers(place.plan, place.designs, pump, situation, start)
    there = Motion(place.plan, place.designs, {name: np.asarray(value) for name, value in start.items()}, "nan")
    limits, names = limits_of(pump, consumers, there), [line.name for line in consumers.lines]
    stretches = given_stretches(consumers, instants, limits)
    return PumpCycle(pump.name or "supply", names, (), stretches, limits, label, is_slow=has_masses(place.plan))


def given_stretches(consumers: Consumers, instants: Instants, limits: PumpLimits) -> list[Stretch]:
    """Return the demands along given courses, between all borders."""
    found: list[Stretch] = []
    left = [*zip(instants.breaks[-2::-1].tolist(), instants.breaks[:0:-1].tolist(), strict=True)]
    while left:
        begin, end = left.pop()
        middle = 0.5 * (begin + end)

        def consumption_at(time: Array, like: Consumption | None = None, middle: float = middle) -> Consumption:
            there = instants.at_times(time, np.full(len(time), middle))
            strokes, rates = (np.array([each[name] for name in consumers.strokes]) for each in (there.strokes, there.rates))
            return consumers.consumption(strokes, [rates], rates, like)

        time = stretch_times(begin, end)
        consumption = consumption_at(time)
        border = first_border(time, consumption, lambda at, like=consumption: consumption_at(at, like).borders(like))  # type: ignore[misc]
        need = np.maximum(consumption.needs[0], 0.0)
        smooth = is_smooth(consumption.flows, limits.flow) and is_smooth([need], limits.cut_off) and is_smooth([*consumption.lengths], 1.0)
        if border is None and end - begin > SHORTEST and not smooth:
            border = middle
        if border is not None:
            left += [(border, end), (begin, border)]
            continue
        for branch in consumption.branches[0]:
            refuse_unpushed(branch, time, consumers.pump)
        is_fed = consumption.flows[0][len(time) // 2] > 0.0  # at its ends too: a flow that begins or ends there is fed up to there
        found.append(Stretch(time, need + limits.margin * is_fed, [1.0], consumption))
    return found


def stretch_times(begin: float, end: float) -> Array:
    """Return the places of a stretch [s]."""
    found = begin + 0.5 * (end - begin) * (PLACES + 1.0)
    found[-1] = end
    return found


def first_border(time: Array, consumption: Consumption, borders: Callable[[Array], Array]) -> float | None:
    """Return an instant of a border within a stretch, where a value above zero in its middle is below zero; None without one."""
    rows = consumption.borders(consumption)
    bad = np.any(rows < -AT_BORDER, axis=0)
    if not bad.any():
        return None
    middle = len(time) // 2
    before, behind = np.flatnonzero(bad[:middle]), middle + np.flatnonzero(bad[middle:])
    outside = int(before[-1]) if len(before) else int(behind[0])
    inside = outside + 1 if len(before) else outside - 1

    def holds(at: Array) -> Any:
        return np.all(borders(at.ravel()) >= 0.0, axis=0).reshape(at.shape)

    low, _ = last_holding(holds, time[inside], time[outside], 1e-13 * max(1.0, abs(time[-1])), 2)
    found, width = float(low), time[-1] - time[0]
    return found if min(found - time[0], time[-1] - found) > max(SHORTEST, 1e-12 * width) else None


# What is said of it.


def timed_places(judge: Judge) -> list[Any]:
    """Return the places of a judge over paths in time."""
    return [place for place in judge.places if place.instants is not None and place.motion.reached.all()]


def is_shared(pump: ForceElement, judge: Judge) -> bool:
    """Return whether several lines share a pump."""
    return len(lines_on(pump, judge.plan.members)) > 1


def judged_cycles(pump: ForceElement, judge: Judge) -> list[tuple[Any, PumpCycle]]:
    """Return the cycles of a pump over the paths in time that a judge looks at, with their places; of one without flow none."""
    places = timed_places(judge)
    has_flow = bool(places) and one_design(number_set(pump, judge.motion, "flow")) > 0.0
    return [(place, each) for place in places for each in cycles_over(pump, place, judge.acting)] if has_flow else []


def pump_verdicts(pump: ForceElement, judge: Judge) -> list[Verdict]:
    """Return whether a shared pump meets the demands of a judge's paths in time, for the most demanding one."""
    places = timed_places(judge)
    if not places or not is_shared(pump, judge):
        return []
    try:
        found = judged_cycles(pump, judge)
    except DefinitionError as error:
        return [Verdict.refused("pump", error)]
    if not found:
        return [Verdict("pump", None, said("its flow is not given, so that nothing tells how long it takes."))]
    place, worst = max(found, key=lambda each: each[1].stretch)
    title = f"{place.over.name}: " if len(places) > 1 and place.over.name else ""
    return [Verdict("pump", worst.verdict.ok, title + worst.verdict.sentence)]
