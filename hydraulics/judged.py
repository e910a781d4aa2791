"""What can be said of a lift over its stroke, in sentences. Pressures are gauge; one design, one stroke at a time.

`thrust` is a function of a motion that returns the frictionless thrust [N], such as
`lambda motion: driving_force(motion, loads)`: it is asked again, closely, so that ranges end where they truly do.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from linkage.errors import DefinitionError
from linkage.motion import Motion
from linkage.report import below_zero, closely, reached_span, spans_in_words
from linkage.units import litre, mm, show

from .cylinder import CylinderSize
from .inputs import Array
from .lift import LiftCircuit
from .sizes import standard_bores
from .verdict import Verdict

Thrust: TypeAlias = Callable[[Motion], Array]


def lift_verdicts(circuit: LiftCircuit, motion: Motion, thrust: Thrust, *, resistance: float = 0.0, unit: str = "bar") -> list[Verdict]:
    """Return the verdicts on lifting (with the remedy), oil and time, holding, and lowering against a `resistance` [Pa].

    `unit` is that of the pressures in the sentences.
    """
    if motion.design_shape or len(motion.strokes) != 1:
        raise DefinitionError("A lift is judged for one design and one stroke at a time; take one, at() or sweep() again.")
    return [
        lifting(circuit, motion, thrust, unit),
        filling(circuit, motion),
        holding(circuit, motion, thrust, unit),
        lowering(circuit, motion, thrust, resistance, unit),
    ]


def lifting(circuit: LiftCircuit, motion: Motion, thrust: Thrust, unit: str) -> Verdict:
    """Return whether the pump lifts over the whole motion; where not, the pressure needed and the standard bore that would do."""
    fine, (stroke,) = closely(motion), motion.strokes
    reserve, pump = circuit.reserve(fine, thrust(fine)), show(float(circuit.supply(motion)), unit, 4)
    if np.isnan(reserve).all():
        return Verdict("lifting", True, "the load drives all the way: it is not limited by this cylinder.")
    worst = int(np.nanargmin(reserve))
    least, where = float(reserve[worst]), f"{stroke} = {fine.strokes[stroke][worst]:.4f} m"
    driven = below_zero(motion, lambda each: np.asarray(circuit.rod_force(each, thrust(each))))
    free = f"; the load drives {spans_in_words(driven, stroke)}, there it is not limited by this cylinder" if driven else ""
    says = f"at {pump} the least reserve is {least:.3f}, at {where}"
    if least >= 1.0:
        return Verdict("lifting", True, f"{says}{free}.")
    short = below_zero(motion, lambda each: np.asarray(circuit.largest(each) - circuit.rod_force(each, thrust(each))))
    return Verdict("lifting", False, f"{says}; too weak {spans_in_words(short, stroke)}{free}. {remedy(circuit, fine, thrust(fine), unit)}")


def remedy(circuit: LiftCircuit, motion: Motion, thrust: Array, unit: str) -> str:
    """Return what makes up for a reserve below 1: a pressure, or the next standard bore (ISO 3320) that does, with its reserve."""
    size, needed = circuit.size(motion), show(float(np.nanmax(circuit.pressure_for(motion, thrust))), unit, 4)
    force = circuit.rod_force(motion, thrust)
    for bore in standard_bores():
        if bore > max(float(size.bore), float(size.rod)) * (1.0 + 1e-9):
            larger = CylinderSize(bore, float(size.rod), size.count, size.works)
            most = circuit.efficiency(motion, "hydraulic") * circuit.supply(motion) * larger.area - circuit.back(motion) * larger.back_area
            gained = float(np.nanmin(most / np.where(force > 0.0, force, np.nan)))
            if gained >= 1.0:
                return f"It needs {needed}, or a bore of {bore / mm:.0f} mm, with a reserve of {gained:.2f}."
    return f"It needs {needed}; no standard bore is large enough."


def filling(circuit: LiftCircuit, motion: Motion) -> Verdict:
    """Return how much oil the motion takes, and how long the pump's flow needs for it."""
    says = f"{float(circuit.oil(motion)) / litre:.2f} l from end to end"
    if not np.any(circuit.number(motion, "flow") > 0.0):
        return Verdict("oil", True, f"{says}; time follows from the pump's flow, which is not given.")
    flow = float(circuit.number(motion, "flow")) * 60.0 / litre
    return Verdict("oil", True, f"{says}, {float(circuit.time(motion)):.1f} s at {flow:.4g} l/min.")


def holding(circuit: LiftCircuit, motion: Motion, thrust: Thrust, unit: str) -> Verdict:
    """Return the pressures that the load makes with the pump off, and whether they stay below the pump's."""
    fine = closely(motion)
    held, pump = circuit.holding(fine, thrust(fine)), float(circuit.supply(motion))
    working, other = float(np.nanmax(held.working)), float(np.nanmax(held.other))
    ok = working <= pump and other <= pump
    more = f", up to {show(other, unit, 4)} in the other side where the load drives" if other > 0.0 else ""
    says = f"with the pump off up to {show(working, unit, 4)} stand in the working side{more}"
    return Verdict("holding", ok, f"{says}{'' if ok else f'; that is above the pump, {show(pump, unit, 4)}: take a larger bore'}.")


def lowering(circuit: LiftCircuit, motion: Motion, thrust: Thrust, resistance: float, unit: str) -> Verdict:
    """Return whether it sinks by itself against the resistance of the returning oil; where not, what the other side must give."""
    (stroke,), fine = motion.strokes, closely(motion)
    sinks = circuit.lowering(fine, thrust(fine), resistance)
    against = f"against {show(resistance, unit, 4)} in the return line"
    low, high = reached_span(motion)
    if np.all(sinks.by_itself[fine.reached]):
        least = show(float(np.nanmin(sinks.working)), unit, 4)
        return Verdict("lowering", True, f"it sinks by itself {against}: the load makes at least {least} in the working side.")
    stuck = below_zero(motion, lambda each: np.asarray(np.where(circuit.lowering(each, thrust(each), resistance).by_itself, 1.0, -1.0)))
    where = "anywhere" if stuck == [(low, high)] else spans_in_words(stuck, stroke)
    push = show(float(np.nanmax(sinks.push)), unit, 4)
    return Verdict("lowering", False, f"it does not sink by itself {where} {against}: the other side must push with up to {push}.")
