"""Sweeps of machines in JavaScript, many in one process of node, and how far they lie from those in Python."""

import json
import shutil
import subprocess
from dataclasses import dataclass
from importlib import import_module

import numpy as np
import pytest

from linkage import DefinitionError, Dimension, Mechanism, Stroke, drive_force, ratio
from linkage.errors import unwarned
from linkage.loads import ForceElement
from linkage.motion import LiveText, Request, Value, dead_points, live_text
from linkage.motion.live import REGULAR
from linkage.quantities import Quantity
from linkage.statics.holding import closed_ties
from tests import shipped

NEEDED = pytest.mark.skipif(shutil.which("node") is None, reason="node, which runs the JavaScript, is not installed")
SHIPPED = {**shipped.MACHINES, **shipped.AT_WORK}
ELSEWHERE = {
    "axle": "Axle", "baler": "Baler", "double_wishbone": "Wishbone", "excavator": "Excavator", "forestry_crane": "Crane",
    "gear_shift": "GearShift", "lifting_arm": "Pulled", "log_splitter": "Splitter", "mast_tilt": "Mast", "needle_bar": "SewingMachine",
    "parallelogram_mower": "Mower", "plough": "Plough", "scissor_table": "Table", "sprayer_fold": "Boom", "tail_lift": "TailLift",
    "tipper": "Tipper", "wheel_loader": "WheelLoader", "papers_in_primitives": "PrintedBalancer",
}  # fmt: skip
RUNNER = """
const fs=require('fs'),finite=x=>Number.isFinite(x)?x:null,found=[];
for(const job of JSON.parse(fs.readFileSync(0,'utf8'))){
  const engine=new Function(job.text+';return engine')();
  found.push(job.designs.map(d=>{
    const m=engine.sweep(d,job.strokes);
    const values=m.values.map(a=>Array.from(a,finite)),missing=Array.from(m.missing,finite);
    return {values,reason:Array.from(m.reason),missing,steps:engine.steps};
  }));
}
process.stdout.write(JSON.stringify(found));
"""


def elsewhere():
    """Yield machines of the tests, which are not shipped, with their names."""
    for module, name in ELSEWHERE.items():
        yield module, getattr(import_module(f"tests.machines.test_{module}"), name)


@dataclass
class Swept:
    """What JavaScript says of some designs: values (designs, rows, poses), reasons and what is missing [m] (designs, poses)."""

    values: np.ndarray
    reason: np.ndarray
    missing: np.ndarray
    steps: list[str]

    @property
    def reached(self):
        return self.reason == 0


@dataclass
class Job:
    """Designs of a machine, dimension by dimension (m,), at strokes (n,), and what is asked of them."""

    machine: type[Mechanism]
    asked: dict[str, object]
    designs: dict[str, np.ndarray]
    strokes: dict[str, np.ndarray]
    live: LiveText = None

    def __post_init__(self):
        self.live = live_text(self.machine.plan, self.asked)

    @property
    def count(self):
        return max((np.size(each) for each in self.designs.values()), default=1)

    def made(self, nudge=0.0):
        return self.machine(**{name: value * (1.0 + nudge) for name, value in self.designs.items()})

    def as_json(self):
        dimensions = self.made().dimensions
        columns = [np.broadcast_to(dimensions[name], self.count).tolist() for name in self.live.dimensions]
        designs = [list(each) for each in zip(*columns, strict=True)] or [[]] * self.count
        return {"text": self.live.text, "designs": designs, "strokes": [self.strokes[name].tolist() for name in self.live.strokes]}


def swept(jobs):
    """Return what JavaScript says of each job, all in one process."""
    given = json.dumps([job.as_json() for job in jobs])
    run = subprocess.run(["node", "-e", RUNNER], input=given, capture_output=True, text=True)
    assert not run.returncode, run.stderr[-2000:]
    return [
        Swept(*(np.array([each[name] for each in found], float) for name in ("values", "reason", "missing")), found[0]["steps"])
        for found in json.loads(run.stdout)
    ]


def asked_of(machine, forces=True):
    """Return what can be asked of a machine: points, outputs, their ratios by each stroke, the drives' forces."""
    plan = machine.plan
    outputs = [name for name, each in plan.of_kind(Quantity).items() if not isinstance(each, (Stroke, Dimension))]
    found = {name: name for name in (*plan.points, *outputs)}
    for stroke in plan.strokes:
        found |= {f"d{name}/d{stroke}": ratio(name, stroke) for name in (*plan.moving, *outputs)}
        if forces and plan.of_kind(ForceElement):
            found[f"force of {stroke}"] = drive_force(stroke)
    return found


def designs_near(machine, seed, count, spread=0.1):
    """Return random designs of a machine, each dimension within a part of its own; the first is the class's.

    Shares and exponents of 1, which may not lie on either side of it, are held, and bores and rods where closed lines need equal areas.
    """
    random, held = np.random.default_rng(seed), (".bore", ".rod") if closed_ties(machine.plan) else ()
    found = {}
    for name, each in machine.plan.table.entries.items():
        value = each.default
        if value and not name.endswith(held) and (value != 1.0 or each.unit or each.kind in ("length", "coordinate", "angle")):
            found[name] = value * (1.0 + spread * random.uniform(-1.0, 1.0, count))
            found[name][0] = value
    return found


def possible(machine, designs):
    """Return the designs that a machine takes: those whose lengths, efficiencies and masses can be."""
    count = max(map(len, designs.values()), default=0)
    good = []
    for k in range(count):
        try:
            machine(**{name: float(each[k]) for name, each in designs.items()})
            good.append(k)
        except DefinitionError:
            pass
    return {name: each[good] for name, each in designs.items()}


def ways(machine, count):
    """Return strokes from the start of each to its end, ascending."""
    plan = machine.plan
    return {name: np.linspace(*sorted((each.start, each.end)), count) for name, each in plan.strokes.items()}


def size_of(plan, request, extent, own):
    """Return what a value is compared with where it is smaller: a length the machine's, an angle 1 rad, a force 1 N or 1 Nm.

    A ratio is also compared with its `own` quantity's largest value, which may be of large terms that balance.
    """
    name, along = (request.target, plan.strokes[request.along[0]]) if isinstance(request, Value) else (request, None)
    member = plan.members.get(name) if isinstance(name, str) else None
    measures = getattr(member, "measures", "" if member is None else "length")
    size = {"length": extent, "angle": 1.0}.get(measures, 1.0 if isinstance(request, Request) else 1e-9)
    return max(size, own) / (abs(along.end - along.start) or 1.0) if along is not None else size


def compared(job, found, motion):
    """Yield (name, error over the size, mask where both have a value, where Python has one) of each thing asked for, (designs, poses).

    A size is the largest value of a design, or what it is measured by in such a machine. An error is what is left of it above ten times
    what last digits of the strokes and dimensions make, as near the ends of an arc cosine.
    """
    count, n = found.reached.shape
    with unwarned():
        ways = [(last, {name: each * (1.0 - last) for name, each in job.strokes.items()}) for last in (0.0, 2.0**-52, -(2.0**-51))]
        values, *nudged = (job.made(last).evaluate([*job.asked.values()], unreachable="nan", **strokes) for last, strokes in ways)
    by_name = dict(zip(job.asked, values, strict=True))
    extent = max(float(np.nanmax(np.abs(motion[name]), initial=0.0)) for name in motion.plan.points)
    for (name, (first, rows)), each, *near in zip(job.live.rows.items(), values, *nudged, strict=True):
        want = np.broadcast_to(np.reshape(each, (rows, -1, n)), (rows, count, n))
        have = np.moveaxis(found.values[:, first : first + rows], 1, 0)
        both, there = np.isfinite(want) & np.isfinite(have), np.isfinite(want).all(axis=0)
        size = np.where(both, np.abs(want), 0.0).max(axis=(0, 2), keepdims=True)
        asked = job.asked[name]
        own = np.nanmax(np.abs(by_name.get(asked.target, 0.0)), initial=0.0) if isinstance(asked, Value) else 0.0
        size = np.maximum(size, size_of(motion.plan, asked, extent, own))
        last = np.nan_to_num(np.max([np.abs(np.reshape(one, (rows, -1, n)) - want) for one in near], axis=0), posinf=0.0)
        error = np.maximum(np.abs(np.where(both, have - want, 0.0)) - 10.0 * last, 0.0)
        yield name, np.where(both, error / size, 0.0).max(axis=0), both.all(axis=0), there


def steepness(motion):
    """Return how near poses are to dead points: the conditions of their loops multiplied, those of open ones left out; (designs, poses)."""
    found = np.full(motion.shape, REGULAR)
    for each in dead_points.loop_conditions(motion.plan, motion._reading, set(motion.plan.members)).values():
        found = found * np.maximum(1.0, np.nan_to_num(np.broadcast_to(each, motion.shape) / REGULAR, nan=np.inf))
    return found.reshape(-1, motion.shape[-1])


def check(job, found):
    """Assert that JavaScript reaches the same poses, refuses what Python refuses, and says the same to 1e-12.

    Next to dead points, where what is asked for follows last digits, it is to 3e-16 by the square of the condition.
    """
    with unwarned():
        motion = job.made().at(**job.strokes, unreachable="nan")
    reached = np.broadcast_to(motion.reached, (*motion.shape,)).reshape(-1, motion.shape[-1])
    np.testing.assert_array_equal(found.reached, np.broadcast_to(reached, found.reached.shape))
    steep = np.broadcast_to(steepness(motion), found.reached.shape)
    allowed = np.maximum(1e-12, 1e-15 * steep**2)
    for name, error, both, there in compared(job, found, motion):
        where = both & found.reached
        worst = np.where(where, error / allowed, 0.0)
        assert worst.max(initial=0.0) <= 1.0, (name, float(np.where(where, error, 0.0).max()), float(steep.flat[worst.argmax()]))
        apart = (there != both) & found.reached & (steep < 1e5)
        assert not apart.any(), (name, "has a value in Python and none here", int(apart.sum()))
    return int(found.reached.sum())
