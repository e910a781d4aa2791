"""What can be said of a lift over its motion, in sentences: along one stroke, the others held, or along a path of several.

Pressures are gauge; one design at a time. Extremes and ranges are looked for between the poses, whatever their number. Each
cylinder is judged with all drives locked, by its own thrust; friction takes its senses from the movement.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from linkage.errors import DefinitionError, known_name, unknown
from linkage.motion import Motion, Span, below_zero, greatest, lowest, reached, require_motion
from linkage.statics import Case, Loads, elements_of, same
from linkage.units import UNITS, litre, mm, show
from linkage.verdict import Verdict

from .cylinder import CylinderSize, standard_bores
from .inputs import Array, not_negative, one_number
from .lift import Choice, Holding, LiftCircuit, Lowering, Work
from .member import Cylinder, one_design, one_size


def lift_verdicts(
    circuit: LiftCircuit | str, motion: Motion, loads: Loads = None, *, case: Case = None, resistance: float = 0.0, unit: str = "bar"
) -> list[Verdict]:
    """Return the verdicts on lifting (with the remedy), oil and time, holding, and lowering against a `resistance` [Pa].

    `loads` are the machine's own unless others are given; `unit` is that of the pressures in the sentences. Along a path of
    several strokes, `at(S1=..., S2=...)` with arrays of one axis, it is judged along the path. Of a line of several cylinders each is.
    """
    circuit = the_circuit(circuit, motion)
    not_negative(one_number(resistance, "Return resistance"), "Return resistance")
    known_name("Unit", unit, UNITS, where="lift_verdicts(unit=...)")
    one_design(motion, "A lift")
    if len(motion._stroke_shape) > 1:
        raise DefinitionError("A lift is judged along one stroke or one path; this motion is a grid of several strokes. Give at() arrays.")
    if not motion.reached.any():
        raise DefinitionError(f"{motion.plan.title}: no pose of this motion can be assembled, so that there is nothing to judge.")
    cylinders = [LiftingCylinder(circuit, ram, motion, loads, case, unit) for ram in circuit.rams(motion)]
    nothing = idle(cylinders)
    if nothing is not None:
        return [nothing, oil_verdict(circuit, motion)]
    several = len(cylinders) > 1
    return [
        *(with_name(each.lifting(), each.ram, several) for each in cylinders),
        oil_verdict(circuit, motion),
        *(with_name(each.holding(), each.ram, several) for each in cylinders),
        *(with_name(each.lowering(resistance), each.ram, several) for each in cylinders),
    ]


def the_circuit(circuit: LiftCircuit | str, motion: Motion) -> LiftCircuit:
    """Return the circuit that is meant, by its name in the class too; DefinitionError for what is none."""
    require_motion(motion)
    circuits = motion.plan.of_kind(LiftCircuit)
    found = circuits.get(circuit) if isinstance(circuit, str) else circuit
    if not isinstance(found, LiftCircuit):
        raise unknown("LiftCircuit", str(circuit), circuits, where=motion.plan.title)
    return found


def with_name(verdict: Verdict, ram: Cylinder, several: bool) -> Verdict:
    """Return a verdict that names its cylinder, where there are several."""
    return Verdict(f"{verdict.rule} {ram.name or ram}", verdict.ok, verdict.sentence) if several else verdict


def idle(cylinders: Sequence[LiftingCylinder]) -> Verdict | None:
    """Return the verdict on a lift that has nothing to carry; None where it has."""
    first = cylinders[0]
    elements = elements_of(first.motion.plan, first.loads)
    members = first.motion.plan.members
    feeding = [(name, one.feeds(members)) for name, one in elements]
    fed = [(name, each.ram) for each in cylinders for name, rams in feeding if any(same(each.ram, ram) for ram in rams)]
    if fed:
        (line, ram), *_ = fed
        says = f"{ram.name or ram} is fed by {line} and carries the gas's force, whatever the load: there is nothing that the pump lifts"
        return Verdict("lifting", False, f"{says}. Judge what the drive must do, driving_force(motion), or leave {line} out of the loads.")
    if any(each.carries for each in cylinders):
        return None
    acting = [name for name, each in elements if not each.holds and not each.joined(first.motion.plan.members)]
    why = "no load is declared, such as Weight(G, mass=...)."
    if acting:
        many = f"the loads {', '.join(acting)} ask" if len(acting) > 1 else f"{acting[0]} asks"
        why = f"{many} nothing of it; is a mass zero?"
    return Verdict("lifting", False, f"there is nothing to lift: {why}")


@final
@dataclass(frozen=True, eq=False)
class Lifting:
    """How one cylinder lifts over a motion: its `least` reserve and where, the parts on which it is too weak, or the load drives.

    Infinite where the load drives all the way, 0 where the force needed grows without bounds. Where it is too weak, `needed` is the
    pump's pressure that lifts [Pa gauge], `bore` the smallest standard one that does [m] with the least reserve `gained`, NaN for none.
    """

    least: float
    where: str
    short: tuple[Span, ...]
    driven: tuple[Span, ...]
    needed: float = np.nan
    bore: float = np.nan
    gained: float = np.nan

    @property
    def is_free(self) -> bool:
        """Whether the load drives all the way."""
        return self.least == np.inf


@final
class LiftingCylinder:
    """One cylinder of a circuit over a motion."""

    def __init__(
        self, circuit: LiftCircuit, ram: Cylinder, motion: Motion, loads: Loads = None, case: Case = None, unit: str = "bar"
    ) -> None:
        self.circuit, self.ram, self.motion, self.loads, self.case, self.unit = circuit, ram, motion, loads, case, unit

    @property
    def choice(self) -> Choice:
        """Which cylinder and load case is meant."""
        return {"cylinder": self.ram, "case": self.case}

    @property
    def carries(self) -> bool:
        """Whether the cylinder carries anything anywhere."""
        thrust = greatest(self.motion, lambda at: np.abs(self.ram.thrust(at, self.loads, case=self.case)))
        return bool(thrust.value > 0.0)

    def force(self, motion: Motion) -> Array:
        """Return the rod force while it lifts [N]."""
        return self.circuit.rod_force(motion, self.loads, **self.choice)

    def spare(self, motion: Motion) -> Array:
        """Return the greatest rod force less the needed one [N]."""
        work = self.circuit.work(motion, self.loads, **self.choice)
        return self.circuit.most(motion, work) - work.force

    def show(self, pressure: Array | float) -> str:
        """Return a pressure in the unit of the sentences."""
        return show(float(pressure), self.unit, 4)

    # -- lifting -------------------------------------------------------------------------------------------

    def lifting(self) -> Verdict:
        """Return whether the pump lifts over the whole motion; where not, the pressure needed and the standard bore that would do."""
        found, pump = self.lifted(), self.show(self.circuit.supply(self.motion))
        if found.is_free:
            return Verdict("lifting", True, f"the load drives all the way: it is not limited by this cylinder{self.other_side()}.")
        if found.least == 0.0:
            text = f"at {pump} the force needed grows without bounds {found.where}: no cylinder lifts there; keep away from that pose."
            return Verdict("lifting", False, text)
        aside = f"there it is not limited by this cylinder{self.other_side()}"
        free = f"; the load drives {spans(found.driven)}, {aside}" if found.driven else ""
        says = f"at {pump} the least reserve is {found.least:.3f}, {found.where}"
        if found.least >= 1.0:
            return Verdict("lifting", True, f"{says}{free}.")
        return Verdict("lifting", False, f"{says}; too weak {spans(found.short)}{free}. {self.remedy(found)}")

    def lifted(self) -> Lifting:
        """Return how the cylinder lifts, in numbers."""
        motion, worst = self.motion, greatest(self.motion, self.use)
        driven = below_zero(motion, self.force)
        if np.isnan(worst.value) or worst.value <= 0.0:
            return Lifting(np.inf, "", (), driven)
        least = 0.0 if worst.unbounded else 1.0 / float(worst.value)
        if least >= 1.0:
            return Lifting(least, worst.where, (), driven)
        short = below_zero(motion, self.spare)
        if worst.unbounded:
            return Lifting(least, worst.where, short, driven)
        needed = greatest(motion, lambda at: self.circuit.pressure_for(at, self.loads, **self.choice)).value
        return Lifting(least, worst.where, short, driven, float(needed), *self.larger())

    def use(self, motion: Motion) -> Array:
        """Return the needed rod force over the greatest one, 0 where the load drives."""
        return self.use_of(motion, self.circuit.work(motion, self.loads, **self.choice))

    def use_of(self, motion: Motion, work: Work) -> Array:
        """Return the needed rod force over the greatest one of some work, 0 where the load drives."""
        return np.where(work.force > 0.0, work.force / self.circuit.most(motion, work), 0.0) + 0.0 * work.force

    def larger(self) -> tuple[float, float]:
        """Return the smallest standard bore (ISO 3320) that lifts [m], with its least reserve; NaN where none does, or on a shared line."""
        size = one_size(self.ram.sized(self.motion))
        bores = np.array([bore for bore in standard_bores() if bore > max(size.bore, size.rod) * (1.0 + 1e-9)])
        if not bores.size or len(self.circuit.rams(self.motion)) > 1:
            return np.nan, np.nan

        def uses(motion: Motion) -> Array:
            """Return it for every bore at once: what the rod carries is the same."""
            each = CylinderSize(bores.reshape(-1, *(1,) * len(motion.shape)), size.rod, self.ram.count, self.ram.works)
            return self.use_of(motion, replace(self.circuit.work(motion, self.loads, **self.choice), size=each))

        gained = 1.0 / greatest(self.motion, uses).value
        enough = gained >= 1.0
        first = int(np.argmax(enough))
        return (float(bores[first]), float(gained[first])) if enough.any() else (np.nan, np.nan)

    def other_side(self) -> str:
        """Return the remedy where the thrust changes its sign and one side alone is declared."""
        return '; works="both" judges the other side as well' if self.ram.works != "both" else ""

    def remedy(self, found: Lifting) -> str:
        """Return what makes up for a reserve below 1: a pressure, or a standard bore with its reserve."""
        needed = self.show(found.needed)
        if len(self.circuit.rams(self.motion)) > 1:
            return f"It needs {needed}, or larger bores on this line."
        if np.isnan(found.bore):
            return f"It needs {needed}; no standard bore is large enough."
        return f"It needs {needed}, or a bore of {found.bore / mm:.0f} mm, with a reserve of {found.gained:.2f}."

    # -- holding and lowering ------------------------------------------------------------------------------

    def holding(self) -> Verdict:
        """Return the pressures that the load makes with the pump off, and whether they stay below the relief valve's."""
        circuit, motion, limit = self.circuit, self.motion, float(self.circuit.held(self.motion))

        def holds(at: Motion) -> Holding:
            return circuit.holding(at, self.loads, cylinder=self.ram, case=self.case)

        working, other = greatest(motion, lambda at: holds(at).working), greatest(motion, lambda at: holds(at).other)
        endless = next((each for each in (working, other) if each.unbounded), None)
        if endless is not None:
            text = f"the pressure grows without bounds {endless.where}: nothing holds there; keep away from that pose."
            return Verdict("holding", False, text)
        ok = bool(working.value <= limit and other.value <= limit)
        sides = "piston" if self.ram.works != "rod" else "rod", "rod" if self.ram.works != "rod" else "piston"
        drives = "" if self.ram.works == "both" else " where the load drives"
        found = [(working, f"{sides[0]} side"), (other, f"{sides[1]} side{drives}")]
        parts = [f"up to {self.show(most.value)} stand in the {side}, {most.where}" for most, side in found if most.value > 0.0]
        valve = "the relief valve" if circuit.relief is not None else "the pump, for no relief= is given"
        says = f"with the pump off {', '.join(parts) or 'no pressure stands on either side'}"
        rest = f", held against {valve}, {self.show(limit)}" if ok else f"; that is above {valve}, {self.show(limit)}: take a larger bore"
        return Verdict("holding", ok, f"{says}{rest}.")

    def lowering(self, resistance: float = 0.0) -> Verdict:
        """Return whether it sinks by itself against the resistance of the returning oil; where not, what the other side must give."""
        circuit, motion, against = self.circuit, self.motion, f"against {self.show(resistance)} in the return line"

        def sinks(at: Motion) -> Lowering:
            return circuit.lowering(at, self.loads, resistance=resistance, cylinder=self.ram, case=self.case)

        def margin(at: Motion) -> Array:
            found = sinks(at)
            return np.asarray(np.where(found.by_itself, 1.0, -1.0) + 0.0 * found.working)

        stuck = below_zero(motion, margin)
        if not stuck:
            least = lowest(motion, lambda at: sinks(at).working)
            if least.value <= 1e-9 * float(circuit.supply(motion)):
                text = f"it goes back by itself {against}; {least.where} the load presses on neither side and nothing drives it."
                return Verdict("lowering", True, text)
            text = f"it sinks by itself {against}: the load makes at least {self.show(least.value)} in the working side, {least.where}."
            return Verdict("lowering", True, text)
        whole = reached(motion)
        everywhere = len(stuck) == len(whole) and all(str(a) == str(b) for a, b in zip(stuck, whole, strict=True))
        where = "anywhere" if everywhere else spans(stuck)
        most = greatest(motion, lambda at: sinks(at).push)
        if most.unbounded:
            text = f"it does not sink by itself {where} {against}, and no push moves it {most.where}: keep away from that pose."
            return Verdict("lowering", False, text)
        push = self.show(most.value)
        return Verdict("lowering", False, f"it does not sink by itself {where} {against}: the other side must push with up to {push}.")


def oil_verdict(circuit: LiftCircuit, motion: Motion) -> Verdict:
    """Return how much oil the motion takes, and how long the pump's flow needs for it."""
    oil, back = float(circuit.oil(motion)), oil_back(circuit, motion)
    says = f"{oil / litre:.2f} l from end to end{f' outwards, {back / litre:.2f} l inwards' if back else ''}"
    if not np.any(circuit.number(motion, "flow") > 0.0):
        return Verdict("oil", True, f"{says}; time follows from the pump's flow, which is not given.")
    flow = float(circuit.number(motion, "flow")) * 60.0 / litre
    return Verdict("oil", True, f"{says}, {float(circuit.time(motion)):.1f} s at {flow:.4g} l/min.")


def oil_back(circuit: LiftCircuit, motion: Motion) -> float:
    """Return the oil [m3] that the rod sides take over the same way, of cylinders that work with both; 0 where none does."""
    both = [ram for ram in circuit.rams(motion) if ram.works == "both"]
    return sum(float(ram.travel(motion) * ram.sized(motion).pull_area) for ram in both)


def spans(found: Sequence[Span]) -> str:
    """Return parts of a motion in words."""
    return " and ".join(map(str, found))
