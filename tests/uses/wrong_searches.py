"""A seeded generator of wrong uses of searches and studies: an ask that works, with one or two of its parts exchanged for others.

What comes back is a result or a deliberate error, whatever was exchanged; nothing raw, and no warning of NumPy or SciPy.
"""

from types import FunctionType

import numpy as np

from hydraulics import buckling, capacity, fits, pressure, reserve, thrust
from linkage import (
    LoadCase,
    Mechanism,
    around,
    at,
    deg,
    drive_force,
    gap,
    integral,
    kN,
    least,
    mm,
    most,
    optimise,
    pin_force,
    ratio,
    reachable,
    ref,
    transmission,
    worst,
    x,
    y,
)
from linkage.motion import Request
from linkage.motion.measures import Condition, Measure
from linkage.quantities import Quantity
from linkage.study import Target, Tolerance, monte_carlo, settings_for, sobol, survey, tornado, zone
from tests.uses.machines import batch, lifting, two

nan, inf = float("nan"), float("inf")


def raising(motion):
    """Return nothing: it raises."""
    raise KeyError("G")


def named(motion):
    """Return text for every pose."""
    return np.full(motion.shape, "a")


def shapeless(motion):
    """Return too many numbers."""
    return np.zeros(7)


def endless(motion):
    """Return infinity."""
    return np.full(motion.shape, inf)


def empty(motion):
    """Return no number."""
    return np.full(motion.shape, nan)


def complex_height(motion):
    """Return complex numbers."""
    return motion.y("G") + 0j


JUNK = [
    None, True, 0, -1, 3, 1.5, nan, inf, -inf, 10**400, 1e300, 1e-300, 1j, "", "a", "OB", "tilt", "S", b"a", [], [1], ["a"], (), (0.1,),
    (0.3, 0.2), (0.2, 0.3), (nan, 0.3), (-1.0, 1.0), {}, {"OB": 3}, {"OB": (0.28, 0.32)}, {"S": (0.0, 0.1)}, {"S": 0.1}, {"Q": 1}, {3: 4},
    {"OB": None}, {"OB": (0.28, 0.32, 0.01)}, {"OB": [0.28, nan]}, {"B": around(10 * mm)}, {"tilt": (0.0, 1.0)}, {"OB": around(0.3)},
    {"lift.bore": (0.0, 0.1)}, {"A.x": (-0.5, 0.5)}, {("OB", "OG"): [(0.3, 0.5)]}, {"load.mass": (-10.0, 10.0)}, np.array([0.1, 0.2]),
    np.array([]), np.float64(0.3), object(), int, Mechanism, lambda: 3, lambda motion: motion.y("G"), raising, named, shapeless, endless,
    empty, complex_height, lifting, batch, two, ref("tilt"), ref("nothing"), y("G"), x("Q"), np.sqrt(ref("tilt") - 10 * deg),
    1 / ref("tilt"), np.log(ref("tilt")), drive_force(), drive_force("T"), pin_force("O"), pin_force("Q"), ratio("G"),
    ratio(y("G"), order=2), transmission("B"), gap("AB", "OBG"), gap("G", "O"), pressure("lift"), reserve("lift"), capacity("lift", "G"),
    capacity("lift", "O"), thrust("lift"), buckling("lift"), reserve("nothing"), least("tilt"), most(y("G")), least(y("Q")),
    integral("tilt"), integral("tilt", by="T"), at("tilt"), at("tilt", S=0.1), at("tilt", S=9.0), at("tilt", S=1e200), at("OB"),
    worst("tilt", over="S"), least("tilt") ** 0.5, least("tilt") / least(y("G")), 1 / at(y("A"), S=0.1), most("tilt") ** most(y("G")),
    least("tilt") * 1e300, least(endless), most(empty), least(raising), most(named), least(shapeless), least("tilt") >= 1.0,
    least("tilt") >= 1e300, least("tilt") <= most(y("G")), most(pressure("lift")) <= 0.0, most(y("G")) == 0.3,
    least(np.sqrt(ref("tilt") - 10 * deg)) >= 5.0, reachable, fits("lift"), fits("nothing"), [least("tilt") >= 10.0], [3], LoadCase("a"),
    LoadCase("b", scale={"load": 0.0}), "transport", ["transport", None], Tolerance(0.1), Tolerance((0.0, 0.0)), {"OB": Tolerance(0.01)},
    {"OB": 0.1 * mm}, {"OB": 1.0}, {"OB": -1.0}, {"load.mass": 5.0}, {"circuit.pressure": 1e5}, Target("tilt", 2.0, S=0.1),
    [Target("tilt", 2.0, S=0.1)], [Target(y("G"), 3 * kN, S=0.1)], [Target("nothing", 1.0, S=0.1)], [Target("tilt", 1.0)],
]  # fmt: skip
"""What a part is exchanged for: of all kinds, many of them right elsewhere."""

OPTIONS = {
    "optimise": (
        "minimise", "maximise", "vary", "subject_to", "case", "over", "robust", "sigmas", "method", "starts", "seed", "limit",
        "progress",
    ),
    "pareto": ("minimise", "vary", "subject_to", "over", "limit", "seed"),
    "settings": ("name", "quantity", "target", "between", "unit", "S", "points"),
    "targets": ("name", "quantity", "points"),
    "zone": ("quantity", "over", "S"),
    "survey": ("over", "measure", "backend", "piece", "version"),
    "monte_carlo": ("of", "tolerances", "subject_to", "count", "percentiles", "method", "seed", "backend", "threads", "S"),
    "tornado": ("quantity", "tolerances", "unit", "S"),
    "sobol": ("quantity", "tolerances", "count", "seed", "S"),
}  # fmt: skip
RIGHT = {
    "optimise": lambda: dict(minimise=most(pressure("lift")), vary={"OB": (0.28, 0.32)}, starts=1, limit=40),
    "pareto": lambda: dict(minimise=[most(pressure("lift")), most(y("G"))], vary={"OB": (0.28, 0.32)}, limit=200),
    "settings": lambda: dict(name="OB", quantity="tilt", target=2.0, between=(0.25, 0.35), S=0.1),
    "targets": lambda: dict(name={"OB": (0.28, 0.32)}, quantity=[Target("tilt", 2.0, S=0.1)], points=16),
    "zone": lambda: dict(quantity="tilt", over={"OB": (0.28, 0.32)}, S=[0.0, 0.1]),
    "survey": lambda: dict(over={"OB": np.array([0.29, 0.3])}, measure=lambda machine: {"t": machine.at(S=0.1)["tilt"]}),
    "monte_carlo": lambda: dict(of=["tilt"], tolerances={"OB": 1 * mm}, count=64, S=[0.0, 0.1]),
    "tornado": lambda: dict(quantity="tilt", tolerances={"OB": 1 * mm}, S=0.1),
    "sobol": lambda: dict(quantity="tilt", tolerances={"OB": 1 * mm}, count=16, S=0.1),
}
"""An ask of each kind that works."""


FITTING = {
    **dict.fromkeys(("minimise", "maximise"), Measure), **dict.fromkeys(("subject_to",), Condition),
    **dict.fromkeys(("vary", "over", "robust", "tolerances"), dict),
    **dict.fromkeys(("of", "quantity", "measure"), (Request, Quantity, FunctionType, Measure)),
}  # fmt: skip
"""What stands in the place of a part at least: what is exchanged for it is of that kind more often than not."""


def wrong_use(seed):
    """Return a kind of ask, and its parts with one or two exchanged."""
    rng = np.random.default_rng([20, seed])
    kind = [*RIGHT][int(rng.integers(len(RIGHT) + 8)) % len(RIGHT)] if rng.random() < 0.6 else "optimise"
    parts = RIGHT[kind]()
    for name in rng.permutation(OPTIONS[kind])[: int(rng.integers(1, 3))]:
        fitting = [each for each in JUNK if isinstance(each, FITTING.get(str(name), object))] if rng.random() < 0.7 else JUNK
        parts[str(name)] = fitting[int(rng.integers(len(fitting)))]
    return kind, parts


def asked(kind, parts, machine=lifting):
    """Return what an ask gives."""
    parts = dict(parts)
    if kind in ("optimise", "pareto"):
        return str(optimise(machine, **parts))
    if kind == "settings":
        return str(settings_for(machine, parts.pop("name"), parts.pop("quantity"), **parts))
    if kind == "targets":
        return str(settings_for(machine, parts["name"], parts["quantity"], points=parts["points"]))
    return {"zone": zone, "survey": survey, "monte_carlo": monte_carlo, "tornado": tornado, "sobol": sobol}[kind](machine, **parts)

