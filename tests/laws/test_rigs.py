"""Random rigs of one to three cylinders on a line: pressures, reserves, oil and work by volumes, virtual work and the balance of power."""

import math
from random import Random

import numpy as np
from numpy.testing import assert_allclose

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, LiftCircuit, OilLine, Pump, Tank, pressure, reserve
from linkage import Crank, Force, Ground, Mechanism, OnLink, Over, PinFriction, Stroke, ramp
from linkage.units import bar, deg, kN, litre, minute, mm
from tests.for_all import for_all

KINDS = ("tank", "bare", "number", "gas", "pumps")
OTHER, SIGN = {"piston": "rod", "rod": "piston"}, {"piston": 1.0, "rod": -1.0}


def rig(seed):
    """Return an arm on cylinders of one line, the sides that this fills, the losses, and the pressure of what comes back."""
    draw, kind = Random(seed), KINDS[seed % len(KINDS)]
    losses = {f"{name}_efficiency": draw.choice((1.0, draw.uniform(0.8, 0.95))) for name in ("mechanical", "hydraulic")}
    back, supply = draw.uniform(2, 15) * bar, dict(pressure=350 * bar, flow=200 * litre / minute)
    members = dict(phi=Stroke(-20 * deg, 70 * deg), O=Ground(0.0, 0.0), T=Crank("O", OT=2.0, angle="phi"))
    sides = dict[str, str]()
    for number in range(draw.choice((1, 2, 2, 3))):
        is_below = number == 0 or draw.random() < 0.7
        turned, bore = draw.uniform(-25, 25) if number == 0 else draw.uniform(-20, 60), draw.uniform(50, 80) + 40 * (number == 0)
        foot = (draw.uniform(0.5, 0.9), -draw.uniform(0.4, 0.7)) if is_below else (draw.uniform(-0.6, -0.2), draw.uniform(0.5, 0.8))
        members[f"A{number}"] = Ground(*foot)
        members[f"P{number}"] = OnLink("O", "T", **{f"OP{number}": draw.uniform(0.35, 0.6), f"TOP{number}": turned * deg})
        works = dict(works="piston") if kind == "number" else {}
        ram = Cylinder(f"A{number}", f"P{number}", bore=bore * mm, rod=draw.uniform(0.4, 0.65) * bore * mm, **works)
        members[f"ram{number}"], sides[f"ram{number}"] = ram, "piston" if is_below or works else "rod"
    members |= dict(load=Force("T", (draw.uniform(-2, 2) * kN, -draw.uniform(5, 12) * kN)))
    members |= dict(rub=PinFriction("O", radius=40 * mm, coefficient=0.15)) if draw.random() < 0.3 else {}
    others = [f"{ram}.{OTHER[side]}_side" for ram, side in sides.items()]
    block = AccumulatorBlock([Accumulator(volume=20 * litre, charge=4 * bar)])
    behind = dict(tank=lambda: OilLine(*others, Tank(back)), pumps=lambda: OilLine(*others, "supply"))
    behind["gas"] = lambda: OilLine(others[-1], block, charge_pressure=8 * bar, at=0.3)
    if kind == "number":
        members["line"] = LiftCircuit([*sides], back_pressure=back, **supply, **losses)
    else:
        members |= dict(supply=Pump(**supply, **losses), line=OilLine(*(f"{ram}.{side}_side" for ram, side in sides.items()), "supply"))
    members |= dict(back=behind[kind]()) if kind in behind else {}
    return type("Rig", (Mechanism,), members)(), sides, (*losses.values(),), back if kind in ("tank", "number") else 0.0


def areas_of(ram):
    return {"piston": math.pi / 4 * ram.bore**2, "rod": math.pi / 4 * (ram.bore**2 - ram.rod**2)}


def volume(machine, sides, phi):
    """Return the oil in the chambers of a line, but for a constant [m3]."""
    rams, motion = machine.plan.members, machine.at(phi=phi)
    return sum(SIGN[side] * areas_of(rams[ram])[side] * motion.distance(*rams[ram].ends) for ram, side in sides.items())


@for_all("seed", range(2), slow=range(2, 20))
def test_pressures_and_reserves_of_random_rigs_by_virtual_work_at_every_door(seed):
    machine, sides, (k_m, k_h), back = rig(seed)
    members, phi, step = machine.plan.members, np.array([-0.25, 0.1, 0.5, 1.0]), 1e-5
    motion, line, others = machine.at(phi=phi), members["line"], {ram: OTHER[side] for ram, side in sides.items()}
    filled, emptied = ((volume(machine, each, phi + step) - volume(machine, each, phi - step)) / (2 * step) for each in (sides, others))
    lifted = (machine.at(phi=phi + step)["T"] - machine.at(phi=phi - step)["T"]) / (2 * step)
    needed = -np.einsum("i,i...->...", members["load"].vector, lifted) * np.sign(filled)
    if KINDS[seed % len(KINDS)] == "gas":
        last = {ram: others[ram] for ram in [*sides][-1:]}
        gas = (volume(machine, last, phi + step) - volume(machine, last, phi - step)) / (2 * step)
        needed -= members["back"].pressure(motion) * gas * np.sign(filled)
    force = np.where(needed > 0.0, needed / k_m, needed * k_m) - back * emptied * np.sign(filled)
    pressed = np.maximum(force / np.abs(filled) / k_h, 0.0)
    returned = back * emptied * np.sign(filled)
    used = (350 * bar * k_h * np.abs(filled) + returned) / np.where(needed > 0.0, force + returned, np.nan)
    asked = [pressure(ram, circuit="line") for ram in sides] + ([pressure("line")] if isinstance(line, OilLine) else [])
    first = motion[asked[0]] if "rub" in members else pressed
    for found in (*(motion[each] for each in asked), *machine.evaluate(asked, phi=phi)):
        assert_allclose(found, first, rtol=1e-6, atol=5.0)
    reserves = [motion[reserve(ram, circuit="line")] for ram in sides]
    for found in reserves:
        assert_allclose(found, reserves[0] if "rub" in members else used, rtol=1e-6)


@for_all("seed", range(2), slow=range(2, 20))
def test_oil_and_work_of_a_pump_are_those_of_its_line_over_a_path_in_time(seed):
    machine, sides, _, _ = rig(seed)
    for ends in ((-0.2, 0.6), (0.6, -0.2)):
        motion = machine.sweep(9, over=Over.path(phi=ramp(*ends, speed=0.2, acceleration=0.5)))
        timed = [motion[pressure(ram, circuit="line")] for ram in sides]
        assert_allclose([each[1:-1] for each in timed], [timed[0][1:-1]] * len(timed), rtol=1e-7, atol=5.0)
        if "supply" not in machine.plan.members:
            continue
        fine, first, ram = np.linspace(*ends, 401), next(iter(sides)), machine.plan.members[next(iter(sides))]
        places, taken = machine.at(phi=fine), np.diff(volume(machine, sides, fine))
        cycle = machine.plan.members["supply"].check(motion)
        assert_allclose(cycle.litres["line"], 1e3 * taken[taken > 0.0].sum(), rtol=1e-3, atol=1e-6)
        ways = [places[pressure(first, circuit="line", direction=way)] for way in ("extending", "retracting")]
        pressed = np.where(np.gradient(places.distance(*ram.ends)) > 0.0, *ways)
        work = (0.5 * (pressed[1:] + pressed[:-1]) * np.maximum(taken, 0.0)).sum()
        if KINDS[seed % len(KINDS)] != "pumps":  # there the pump fills the other line as well
            assert_allclose(cycle.energy.pump, work, rtol=2e-3, atol=1.0)
