"""How long a page computes in node for 101 poses of every shipped machine, and how long its program is.

`python -m tests.benchmarks.bench_live`. Everything is asked for: points, outputs, their ratios by each stroke, the drives' forces, both
parts of every pin force. The design changes with every frame, so that groups are followed anew from the sketch.
"""

from __future__ import annotations

import json
import subprocess

from linkage import pin_force, pin_forces
from linkage.errors import LinkageError, unwarned
from linkage.loads import ForceElement
from linkage.motion import live_text
from tests.linkage.motion.in_node import SHIPPED, asked_of, ways

RUNNER = """
const found=[];
for(const job of JSON.parse(require('fs').readFileSync(0,'utf8'))){
  const engine=new Function(job.text+';return engine')(),times=[];
  for(let k=0;k<300;k++){
    const d=job.design.map((v,j)=>j==job.varied?v*(1+1e-4*(k%10)):v),start=performance.now();
    engine.sweep(d,job.strokes);
    times.push(performance.now()-start);
  }
  found.push(times.sort((a,b)=>a-b)[times.length>>1]);
}
process.stdout.write(JSON.stringify(found));
"""


def everything(machine):
    """Return what a page may ask of a machine, as far as it has it."""
    asked = asked_of(machine)
    if machine.plan.of_kind(ForceElement):
        with unwarned():
            joints = pin_forces(machine().at(**{name: each.start for name, each in machine.plan.strokes.items()}, unreachable="nan")).joints
        for joint in joints:
            asked |= {f"{joint.point} on {joint.on} {axis}": pin_force(joint.point, joint.on, axis) for axis in "xy" if joint.has_force}
    return {name: each for name, each in asked.items() if is_there(machine, each)}


def is_there(machine, request):
    """Return whether a machine has something: several joints of one body at a point have no force of one name."""
    try:
        return bool(live_text(machine.plan, {"it": request}).rows)
    except LinkageError:
        return False


def main():
    """Print the table."""
    lives = {name: live_text(machine.plan, everything(machine)) for name, machine in SHIPPED.items()}
    jobs = []
    for name, live in lives.items():
        machine = SHIPPED[name]
        design = [machine.plan.defaults[each] for each in live.dimensions]
        strokes = ways(machine, 101)
        varied = next((k for k, value in enumerate(design) if value), 0)
        jobs.append({"text": live.text, "design": design, "varied": varied, "strokes": [strokes[each].tolist() for each in live.strokes]})
    run = subprocess.run(["node", "-e", RUNNER], input=json.dumps(jobs), capture_output=True, text=True, check=True)
    print("| machine | rows | kB | ms |\n|---|---:|---:|---:|")
    for (name, live), frame in zip(lives.items(), json.loads(run.stdout), strict=True):
        rows = sum(count for _, count in live.rows.values())
        print(f"| `{name}` | {rows} | {len(live.text) / 1000:.1f} | {frame:.2f} |")


if __name__ == "__main__":
    main()
