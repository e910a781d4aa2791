"""Designs, and what is measured on them: in a module of their own, where worker processes find them."""

import os
import signal
from pathlib import Path

import numpy as np

from linkage import ratio
from mechanisms.classics.stephenson_three import StephensonThreeFar
from mechanisms.three_point_hitch import ThreePointHitch

S = np.linspace(0.0, 0.25, 21)


def hitch_designs(count, seed=7):
    """Return the hitch and arrays for a survey of it; some designs cannot be assembled."""
    hitch, random = ThreePointHitch(), np.random.default_rng(seed)
    over = {name: hitch[name] * random.uniform(0.97, 1.03, count) for name in ("OB", "CD", "FK")}
    over["MK"] = random.uniform(0.3, 1.0, count)
    over["M"] = (0.22, 1.05 * random.uniform(0.99, 1.01, count))
    return hitch, over


def travel(hitch):
    """Return how far G rises, its greatest ratio, the least tilt, and whether the whole stroke is there."""
    G, I, tilt = hitch.evaluate(["G", ratio("G"), "tilt"], S=S, unreachable="nan")
    return {"travel": np.ptp(G[1], axis=-1), "ratio": I[1].max(axis=-1), "tilt": tilt.min(axis=-1), "whole": np.isfinite(tilt).all(axis=-1)}


def group_designs(count, seed=3):
    """Return a machine whose pins are found together by Newton, and arrays for a survey of it."""
    machine, random = StephensonThreeFar(), np.random.default_rng(seed)
    name = next(name for name, entry in machine.plan.table.entries.items() if entry.kind == "length")
    return machine, {name: machine[name] * random.uniform(0.999, 1.001, count)}


def far_points(machine):
    """Return how far each moving point goes along x."""
    stroke = next(iter(machine.strokes.values()))
    at = np.linspace(stroke.start, stroke.end, 7)
    places = machine.evaluate(list(machine.plan.moving), unreachable="nan", **{next(iter(machine.strokes)): at})
    return {name: np.ptp(place[0], axis=-1) for name, place in zip(machine.plan.moving, places, strict=True)}


def logged(hitch, log):
    """Return `travel`, and write down the first length OB of what was measured."""
    with Path(log).open("a", encoding="ascii") as stream:
        stream.write(f"{float(hitch['OB'][0])!r}\n")
    return travel(hitch)


def deadly(hitch, log, victim):
    """Return `logged`; the first process that comes to the design with this OB is killed."""
    if victim in hitch["OB"]:
        try:
            Path(log).with_suffix(".killed").touch(exist_ok=False)
            os.kill(os.getpid(), signal.SIGKILL)
        except FileExistsError:
            pass
    return logged(hitch, log)


def failing(hitch, victim):
    """Return `travel`; fails at the design with this OB."""
    if victim in hitch["OB"]:
        hitch.at(S=5.0)
    return travel(hitch)
