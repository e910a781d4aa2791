"""What holds of one pump whatever stands on it: it is shared whole, in no order of declaration, and its energy is accounted for."""

from itertools import permutations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import LiftCircuit, Pump
from hydraulics.sharing import Choices, FlowDemands, PumpLimits, flow_shares
from linkage import Course, Mechanism, Over, Part, Stroke
from linkage.units import bar, litre, minute
from mechanisms.at_work.one_pump import PumpedExcavator
from tests.for_all import for_all
from tests.hydraulics.test_pump import Block, Lift, pump_of


def random_wanted(rng):
    """Return consumers with ties, loads that drive, ends and tiers, and a pump."""
    count = int(rng.integers(1, 6))
    needs = rng.choice([-4e6, 0.0, 3e6, 3e6, 8e6, 21e6, rng.uniform(1e5, 3e7)], count)
    flows = rng.uniform(0.1, 1.0, count) * 1e-3
    power = np.inf if rng.random() < 0.3 else 10 ** rng.uniform(2.5, 4.5)
    limits = PumpLimits(10 ** rng.uniform(-4, -2.5), power, rng.choice([0.0, 1.5e6]), 2.2e7, bool(rng.random() < 0.5))
    return FlowDemands([*flows], [*needs], [*(rng.random(count) < 0.15)], [*rng.integers(0, 2, count)]), limits


@for_all("seed", range(40), slow=range(40, 200))
def test_what_one_pump_gives_is_shared_whole_and_in_no_order(seed):
    wanted, limits = random_wanted(np.random.default_rng(seed))
    choose = Choices()
    fed = flow_shares(wanted, limits, choose)
    shares, flows, needs = np.array(fed.shares), np.array(wanted.flows), np.maximum(wanted.needs, 0.0)
    given = float(shares @ flows)
    assert np.all((shares >= 0.0) & (shares <= 1.0 + 1e-12)) and not any(shares[i] for i in fed.blocked)
    assert given <= limits.flow * (1 + 1e-12) and given * fed.pressure <= limits.power * (1 + 1e-12)
    assert np.all(fed.pressure >= needs[shares > 0.0] + limits.margin - 1e-6) and fed.pressure <= limits.cut_off * (1 + 1e-9)
    short = [i for i in range(len(flows)) if shares[i] < 1.0 - 1e-9 and i not in fed.blocked]
    if short and fed.group:  # then one of its limits is reached
        assert_allclose(max(given / limits.flow, given * fed.pressure / limits.power), 1.0, rtol=1e-9)
    for i in range(len(flows)):  # who is served before another one gets a greater part
        for j in set(range(len(flows))) - set(fed.blocked) - {i}:
            before = wanted.tiers[i] < wanted.tiers[j] or (
                wanted.tiers[i] == wanted.tiers[j] and limits.least_first and needs[i] < needs[j]
            )
            same = wanted.tiers[i] == wanted.tiers[j] and (not limits.least_first or needs[i] == needs[j])
            if i not in fed.blocked:
                assert not before or shares[i] >= shares[j] - 1e-12
                assert not same or abs(shares[i] - shares[j]) <= 1e-12
    again = flow_shares(wanted, limits, Choices(choose.made))
    assert_allclose(again.shares, fed.shares, rtol=0)
    for order in [*permutations(range(len(flows)))][:: max(1, len(flows))][:8]:
        turned = FlowDemands(*([each[i] for i in order] for each in (wanted.flows, wanted.needs, wanted.stopped, wanted.tiers)))
        found = flow_shares(turned, limits, Choices())
        assert_allclose(found.shares, shares[[*order]], rtol=1e-12, atol=1e-15)
        assert_allclose(found.pressure, fed.pressure, rtol=1e-12)


def random_bench(seed, reverse=False):
    """Return blocks on springs and lifts on one pump, with demands, where they begin, and what is stored at strokes [J]."""
    rng = np.random.default_rng(seed)
    kinds = [Block if rng.random() < 0.5 else Lift for _ in range(3)]
    limits = {"flow": rng.uniform(10, 40) * litre / minute, "power": rng.uniform(1e3, 6e3), "margin": rng.choice([0.0, 10 * bar])}
    sharing = rng.choice(["by demand", "least pressure first"])
    sizes = [rng.uniform(0.5, 2.0) for _ in kinds]
    members = {f"S{k}": Stroke(0.0, 0.4) for k in range(3)} | {"supply": Pump(250 * bar, sharing=str(sharing), **limits)}
    for k in (2, 1, 0) if reverse else (0, 1, 2):
        own = {"load.mass": 3000.0 * sizes[k]} if kinds[k] is Lift else {"spring.stiffness": 400e3 * sizes[k]}
        members[f"p{k}"] = Part(kinds[k], S=members[f"S{k}"], at=(0.0, 3.0 * k) if kinds[k] is Block else (3.0 * k, 0.0), **own)
        members[f"line{k}"] = LiftCircuit(f"p{k}.ram", "supply", relief=200 * bar)
    demands = {f"p{k}.ram": Course([0.0, 1.2, 2.5, 4.0], [*rng.uniform(-0.2, 0.25, 4)], "straight") for k in range(3)}
    start = {f"S{k}": rng.uniform(0.1, 0.3) for k in range(3)}

    def stored(strokes):
        each = [
            3000.0 * sizes[k] * 9.80665 * strokes[f"S{k}"] if kinds[k] is Lift else 200e3 * sizes[k] * strokes[f"S{k}"] ** 2
            for k in range(3)
        ]
        return sum(each)

    return type("Bench", (Mechanism,), members)(), demands, start, stored


@for_all("seed", range(1), slow=range(1, 40))
def test_energy_litres_and_halves_of_random_runs(seed):
    machine, demands, start, stored = random_bench(seed)
    supply = pump_of(machine)
    run = supply.run(machine, demands=demands, start=start, until=4.0)
    cycle, energy = run.cycle, run.cycle.energy
    flow, power = cycle.flow["supply"], cycle.power["supply"]
    assert flow.max() <= cycle.limits.flow * (1 + 1e-9) and power.max() <= cycle.limits.power * (1 + 1e-9)
    parts = cycle.parts
    assert np.abs(parts["pump"] - parts["useful"] - parts["throttled"] - parts["margin"]).max() <= 1e-12 * power.max()
    assert min(parts[name].min() for name in ("useful", "throttled", "margin", "braked")) >= -1e-7 * power.max()
    first, last = ({name: each[k] for name, each in run.strokes.items()} for k in (0, -1))
    assert_allclose(energy.useful - energy.braked, stored(last) - stored(first), rtol=0, atol=1e-9 * (energy.useful + energy.braked))
    piston, annulus = np.pi / 4 * 0.08**2, np.pi / 4 * (0.08**2 - 0.045**2)
    for k in range(3):  # litres are areas times ways, there and back
        legs = [each for each in zip(cycle.time[:-1], cycle.time[1:], strict=True) if each[1] > each[0]]
        course = run.over.strokes[f"S{k}"]
        ways = np.array([course(end) - course(begin) for begin, end in legs])
        litres = 1e3 * (piston * ways[ways > 0].sum() - annulus * ways[ways < 0].sum())
        assert_allclose(cycle.litres[f"line{k}"], litres, rtol=0, atol=1e-11 * sum(cycle.litres.values()) + 1e-13)
    half = supply.run(machine, demands=demands, start=start, until=1.9)
    rest = supply.run(machine, demands=demands, start=half, until=4.0)
    for name in machine.strokes:
        assert_allclose(rest.strokes[name][-1], last[name], atol=1e-11)
    turned, _, _, _ = random_bench(seed, reverse=True)
    other = pump_of(turned).run(turned, demands=dict(reversed(demands.items())), start=start, until=4.0)
    for name in machine.strokes:
        assert_allclose(other.strokes[name], run.strokes[name], atol=1e-11)
    assert_allclose([event.time for event in other.events], [event.time for event in run.events], atol=1e-9)


class Closed(PumpedExcavator):
    cycle = Over.path(
        lift=Course([0, 1, 2.5, 4], [0.1, 0.2, 0.15, 0.1]), swing=Course([0, 1.5, 4], [0.4, 0.2, 0.4]),
        curl=Course([0, 2, 4], [0.15, 0.35, 0.15], "monotone"), cases=["carrying"],
    )  # fmt: skip


@pytest.mark.slow
def test_a_closed_cycle_closes_and_a_second_pump_changes_nothing():
    machine = Closed()
    motion = machine.sweep(11, over="cycle")
    cycle = pump_of(machine).check(motion)
    assert abs(cycle.energy.useful - cycle.energy.braked) <= 1e-9 * cycle.energy.useful
    more = type("More", (Closed,), {"second": Pump(100 * bar)})()
    assert_allclose(pump_of(more).check(more.sweep(11, over="cycle")).energy.pump, cycle.energy.pump, rtol=1e-14)
