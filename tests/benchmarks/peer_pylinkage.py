"""pylinkage's compiled path on the same poses, run in an environment of its own: one JSON line in, one out.

Its solver knows no cylinder between two moving pins; the hitch is driven by the arm's angle instead, which is less work.
"""

import json
import math
import sys
import time
from types import SimpleNamespace

import numpy as np


def pylinkage():
    """Return the names this needs; imported here, so that this file can be looked at without them."""
    from pylinkage.actuators import Crank
    from pylinkage.components import Ground
    from pylinkage.dyads import FixedDyad, RRRDyad
    from pylinkage.population import Ensemble
    from pylinkage.simulation import Linkage

    return SimpleNamespace(Crank=Crank, Ground=Ground, FixedDyad=FixedDyad, RRRDyad=RRRDyad, Ensemble=Ensemble, Linkage=Linkage)


def hitch(of, d, start, rate):
    """Return the hitch with its arm OB as a crank, the points B, C, D, F, K, G last."""
    A, O, E, M = (of.Ground(d[f"{name}.x"], d[f"{name}.y"], name=name) for name in "AOEM")
    B = of.Crank(O, radius=d["OB"], angular_velocity=rate, initial_angle=start, name="B")
    C = of.FixedDyad(O, B.output, d["OC"], math.acos((d["OB"] ** 2 + d["OC"] ** 2 - d["BC"] ** 2) / (2 * d["OB"] * d["OC"])), name="C")
    D = of.RRRDyad(E, C, d["ED"], d["CD"], x=d["at"]["D"][0], y=d["at"]["D"][1], name="D")
    F = of.FixedDyad(E, D, d["EF"], 0.0, name="F")
    K = of.RRRDyad(M, F, d["MK"], d["FK"], x=d["at"]["K"][0], y=d["at"]["K"][1], name="K")
    G = of.FixedDyad(F, K, d["FG"], -d["KFG"], name="G")
    return of.Linkage([A, O, E, M, B, C, D, F, K, G])


def four_bar(of, d, start, rate):
    """Return the four-bar with a point on its coupler, the points A, B, P last."""
    O, C = of.Ground(d["O.x"], d["O.y"], name="O"), of.Ground(d["C.x"], d["C.y"], name="C")
    A = of.Crank(O, radius=d["OA"], angular_velocity=rate, initial_angle=start, name="A")
    B = of.RRRDyad(A.output, C, d["AB"], d["CB"], x=d["at"]["B"][0], y=d["at"]["B"][1], name="B")
    P = of.FixedDyad(A.output, B, d["AP"], d["BAP"], name="P")
    return of.Linkage([O, C, A, B, P])


def case(of, asked):
    """Return a call and the points of interest, as asked for."""
    linkage = {"hitch": hitch, "four_bar": four_bar}[asked["machine"]](of, asked["design"], asked["start"] - asked["rate"], asked["rate"])
    linkage.compile()
    poses, count = asked["poses"], asked["count"]
    start = [component.position for component in linkage.components]
    if "designs" not in asked:

        def run():
            linkage.set_coords(start)
            return linkage.step_fast(poses)

        return run, count
    vectors = np.tile(np.array(linkage.get_constraints(), float), (asked["designs"], 1))
    places = np.tile(np.array(start, float), (asked["designs"], 1, 1))
    return (lambda: of.Ensemble(linkage, vectors, places).simulate(poses)), count


def main():
    cases, of = {}, pylinkage()
    for line in sys.stdin:
        asked = json.loads(line)
        if asked["do"] == "make":
            cases[asked["name"]] = case(of, asked)
            answer = {}
        else:
            run, count = cases[asked["name"]]
            start = time.process_time_ns()
            for _ in range(asked["repeat"]):
                found = run()
            spent = (time.process_time_ns() - start) / asked["repeat"]
            last = found if found.ndim == 3 else found[0]
            answer = {"ns": spent, "first": last[0, -count:].tolist(), "last": last[-1, -count:].tolist()}
        print(json.dumps(answer), flush=True)


if __name__ == "__main__":
    main()
