"""The shipped machines on one pump: no verdict fails, files hold them, and they run."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import Course
from linkage.files import load, to_toml
from linkage.loads import Acting
from mechanisms.at_work.one_pump import PumpedExcavator, PumpedForwarder, PumpedTelehandler, RegenerativePress
from tests.for_all import for_all

DEMANDS = {
    PumpedExcavator: {"boom.ram": 0.15, "arm.ram": -0.12, "tool.ram": 0.2},
    PumpedTelehandler: {"ram": 0.06, "push": 0.15, "forks.ram": 0.05},
    PumpedForwarder: {"crane.lift": -0.05, "crane.fold": -0.1, "crane.extend": -0.3},
    RegenerativePress: {"ram": 0.2},
}


@for_all("machine", (), slow=[RegenerativePress, PumpedExcavator, PumpedTelehandler, PumpedForwarder])
def test_no_verdict_fails_and_files_hold_it(machine):
    verdicts = machine().verdicts()
    assert [verdict for verdict in verdicts if verdict.startswith("FAIL")] == []
    assert machine is RegenerativePress or [verdict.rule for verdict in verdicts].count("pump") == 1
    again = load(to_toml(machine()))
    for name, member in machine.plan.members.items():
        if type(member).__name__ in ("Pump", "LiftCircuit", "OilLine", "Relief"):
            assert str(again.plan.members[name]) == str(member)


@for_all("machine", [RegenerativePress, PumpedExcavator], slow=[PumpedTelehandler, PumpedForwarder])
def test_it_runs_on_its_pump(machine):
    design = machine()
    supply = design.plan.members["supply"]
    over = design.overs[0]
    start = {name: course(0.0) if isinstance(course, Course) else course for name, course in over.strokes.items()}
    run = supply.run(design, demands=DEMANDS[machine], start=start, until=2.0)
    cycle = run.cycle
    assert run.events and np.all(np.diff([event.time for event in run.events]) >= 0.0)
    again = supply.check(run)
    useful = cycle.energy.useful + cycle.energy.braked
    assert_allclose([again.energy.useful, again.energy.braked], [cycle.energy.useful, cycle.energy.braked], rtol=0, atol=1e-9 * useful)
    assert cycle.power["supply"].max() <= cycle.limits.power * (1 + 1e-9)
    assert cycle.flow["supply"].max() <= cycle.limits.flow * (1 + 1e-9)


def test_an_excavator_that_wants_more_than_its_pump_gives():
    design = PumpedExcavator()
    supply = design.plan.members["supply"]
    run = supply.run(
        design,
        demands=DEMANDS[PumpedExcavator],
        start={"lift": 0.1, "swing": 0.4, "curl": 0.155},
        until=4.5,
        acting=Acting(case="carrying"),
    )
    asked = np.pi / 4 * (0.08**2 * 0.15 + (0.08**2 - 0.056**2) * 0.12 + 0.063**2 * 0.2)
    share = 45e-3 / 60 / asked
    assert_allclose([run.cycle.share[name][0] for name in DEMANDS[PumpedExcavator]], share, rtol=1e-12)
    stop = next(event for event in run.events if event.kind == "stop")
    assert stop.of == "tool.ram" and stop.time == pytest.approx((0.420 - 0.155) / (0.2 * share), abs=1e-9)
