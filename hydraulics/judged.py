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
from linkage.language import said, said_of, with_and
from linkage.motion import Motion, Span, below_zero, greatest, lowest, reached, require_motion
from linkage.statics import Case, Loads, elements_of, same
from linkage.units import UNITS, show
from linkage.verdict import Verdict

from .cylinder import CylinderSize, standard_bores
from .inputs import Array, not_negative, one_number
from .line import Choice, Holding, LiftLine, Lowering, Work
from .member import Cylinder, one_design, one_size


def lift_verdicts(
    circuit: LiftLine | str, motion: Motion, loads: Loads = None, *, case: Case = None, resistance: float = 0.0, unit: str = "bar"
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


def line_verdicts(circuit: LiftLine, motion: Motion, case: Case = None) -> list[Verdict]:
    """Return `lift_verdicts` of a circuit under the machine's own loads; over a grid of strokes its least reserve, and the holding."""
    try:
        if len(motion._stroke_shape) <= 1:
            return lift_verdicts(circuit, motion, case=case)
        cylinders = [LiftingCylinder(circuit, ram, motion, case=case) for ram in circuit.rams(motion)]
        nothing = idle(cylinders)
        if nothing is not None:
            return [nothing]
        several = len(cylinders) > 1
        return [with_name(verdict, each.ram, several) for each in cylinders for verdict in (each.lifting(), each.holding())]
    except DefinitionError as error:
        return [Verdict("lifting", False, " ".join(str(error).split()))]


def the_circuit(circuit: LiftLine | str, motion: Motion) -> LiftLine:
    """Return the circuit that is meant, by its name in the class too; DefinitionError for what is none."""
    require_motion(motion)
    circuits = motion.plan.of_kind(LiftLine)
    found = circuits.get(circuit) if isinstance(circuit, str) else circuit
    if not isinstance(found, LiftLine):
        raise unknown("LiftCircuit", str(circuit), circuits, where=motion.plan.title)
    return found


def with_name(verdict: Verdict, ram: Cylinder, several: bool) -> Verdict:
    """Return a verdict that names its cylinder, where there are several."""
    if not several:
        return verdict
    name = ram.name or str(ram)
    return Verdict(f"{verdict.rule} {name}", verdict.ok, verdict.sentence, f"{verdict.heading} {name}")


def idle(cylinders: Sequence[LiftingCylinder]) -> Verdict | None:
    """Return the verdict on a lift that has nothing to carry; None where it has."""
    first = cylinders[0]
    elements = elements_of(first.motion.plan, first.loads)
    members = first.motion.plan.members
    feeding = [(name, one.feeds(members)) for name, one in elements]
    fed = [(name, each.ram) for each in cylinders for name, rams in feeding if any(same(each.ram, ram) for ram in rams)]
    if fed:
        (line, ram), *_ = fed
        text = said(
            "{ram} is fed by {line} and carries the gas's force, whatever the load: there is nothing that the pump lifts. "
            "Judge what the drive must do, driving_force(motion), or leave {line} out of the loads.",
            ram=ram.name or ram, line=line,
        )  # fmt: skip
        return Verdict("lifting", False, text)
    if any(each.carries for each in cylinders):
        return None
    acting = [name for name, each in elements if not each.holds and not each.joined(first.motion.plan.members)]
    if not acting:
        return Verdict("lifting", False, said("there is nothing to lift: no load is declared, such as Weight(G, mass=...)."))
    text = said_of(
        len(acting),
        "there is nothing to lift: {loads} asks nothing of it; is a mass zero?",
        "there is nothing to lift: the loads {loads} ask nothing of it; is a mass zero?",
        loads=", ".join(acting),
    )
    return Verdict("lifting", False, text)


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

    def __init__(self, circuit: LiftLine, ram: Cylinder, motion: Motion, loads: Loads = None, case: Case = None, unit: str = "bar") -> None:
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
            text = said("the load drives all the way: it is not limited by this cylinder{remedy}.", remedy=self.other_side())
            return Verdict("lifting", True, text)
        if found.least == 0.0:
            text = said(
                "at {pump} the force needed grows without bounds {where}: no cylinder lifts there; keep away from that pose.",
                pump=pump, where=found.where,
            )  # fmt: skip
            return Verdict("lifting", False, text)
        free = said(
            "; the load drives {where}, there it is not limited by this cylinder{remedy}",
            where=with_and(found.driven), remedy=self.other_side(),
        ) if found.driven else ""  # fmt: skip
        says = said("at {pump} the least reserve is {least:.3f}, {where}", pump=pump, least=found.least, where=found.where)
        if found.least >= 1.0:
            return Verdict("lifting", True, f"{says}{free}.")
        weak = said("; too weak {where}", where=with_and(found.short)) if found.short else ""
        return Verdict("lifting", False, f"{says}{weak}{free}. {self.remedy(found)}")

    def lifted(self) -> Lifting:
        """Return how the cylinder lifts, in numbers."""
        motion, worst = self.motion, greatest(self.motion, self.use)
        along = len(motion._stroke_shape) <= 1  # parts of a way are told, not of a grid
        driven = below_zero(motion, self.force) if along else ()
        if np.isnan(worst.value) or worst.value <= 0.0:
            return Lifting(np.inf, "", (), driven)
        least = 0.0 if worst.unbounded else 1.0 / float(worst.value)
        if least >= 1.0:
            return Lifting(least, worst.where, (), driven)
        short = below_zero(motion, self.spare) if along else ()
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
        return said('; works="both" judges the other side as well') if self.ram.works != "both" else ""

    def remedy(self, found: Lifting) -> str:
        """Return what makes up for a reserve below 1: a pressure, or a standard bore with its reserve."""
        needed = self.show(found.needed)
        if len(self.circuit.rams(self.motion)) > 1:
            return said("It needs {needed}, or larger bores on this line.", needed=needed)
        if np.isnan(found.bore):
            return said("It needs {needed}; no standard bore is large enough.", needed=needed)
        bore = show(found.bore, "mm", ".0f")
        return said(
            "It needs {needed}, or a bore of {bore}, with a reserve of {gained:.2f}.", needed=needed, bore=bore, gained=found.gained
        )

    # -- holding and lowering ------------------------------------------------------------------------------

    def holding(self) -> Verdict:
        """Return the pressures that the load makes with the pump off, and whether they stay below the relief valve's."""
        circuit, motion, limit = self.circuit, self.motion, float(self.circuit.held(self.motion))

        def holds(at: Motion) -> Holding:
            return circuit.holding(at, self.loads, cylinder=self.ram, case=self.case)

        working, other = greatest(motion, lambda at: holds(at).working), greatest(motion, lambda at: holds(at).other)
        endless = next((each for each in (working, other) if each.unbounded), None)
        if endless is not None:
            text = said("the pressure grows without bounds {where}: nothing holds there; keep away from that pose.", where=endless.where)
            return Verdict("holding", False, text)
        ok = bool(working.value <= limit and other.value <= limit)
        pistons, rods = said("piston side"), said("rod side")
        sides = (rods, pistons) if self.ram.works == "rod" else (pistons, rods)
        drives = "" if self.ram.works == "both" else said(" where the load drives")
        parts = [
            said("up to {pressure} stand in the {side}, {where}", pressure=self.show(most.value), side=side, where=most.where)
            for most, side in ((working, sides[0]), (other, f"{sides[1]}{drives}"))
            if most.value > 0.0
        ]
        stands = ", ".join(parts) or said("no pressure stands on either side")
        given, pump = self.show(limit), circuit.relief is None
        valve = said("the pump, for no relief= is given, {limit}", limit=given) if pump else said("the relief valve, {limit}", limit=given)
        if ok:
            return Verdict("holding", True, said("with the pump off {stands}, held against {valve}.", stands=stands, valve=valve))
        return Verdict(
            "holding", False, said("with the pump off {stands}; that is above {valve}: take a larger bore.", stands=stands, valve=valve)
        )

    def lowering(self, resistance: float = 0.0) -> Verdict:
        """Return whether it sinks by itself against the resistance of the returning oil; where not, what the other side must give."""
        circuit, motion, against = self.circuit, self.motion, said("against {pressure} in the return line", pressure=self.show(resistance))

        def sinks(at: Motion) -> Lowering:
            return circuit.lowering(at, self.loads, resistance=resistance, cylinder=self.ram, case=self.case)

        def margin(at: Motion) -> Array:
            found = sinks(at)
            return np.asarray(np.where(found.by_itself, 1.0, -1.0) + 0.0 * found.working)

        stuck = below_zero(motion, margin)
        if not stuck:
            least = lowest(motion, lambda at: sinks(at).working)
            if least.value <= 1e-9 * float(circuit.supply(motion)):
                text = said(
                    "it goes back by itself {against}; {where} the load presses on neither side and nothing drives it.",
                    against=against, where=least.where,
                )  # fmt: skip
                return Verdict("lowering", True, text)
            text = said(
                "it sinks by itself {against}: the load makes at least {pressure} in the working side, {where}.",
                against=against, pressure=self.show(least.value), where=least.where,
            )  # fmt: skip
            return Verdict("lowering", True, text)
        whole = reached(motion)
        everywhere = len(stuck) == len(whole) and all(str(a) == str(b) for a, b in zip(stuck, whole, strict=True))
        where = said("anywhere") if everywhere else with_and(stuck)
        most = greatest(motion, lambda at: sinks(at).push)
        if most.unbounded:
            text = said(
                "it does not sink by itself {where} {against}, and no push moves it {pose}: keep away from that pose.",
                where=where, against=against, pose=most.where,
            )  # fmt: skip
            return Verdict("lowering", False, text)
        text = said(
            "it does not sink by itself {where} {against}: the other side must push with up to {push}.",
            where=where, against=against, push=self.show(most.value),
        )  # fmt: skip
        return Verdict("lowering", False, text)


def oil_verdict(circuit: LiftLine, motion: Motion) -> Verdict:
    """Return how much oil the motion takes, and how long the pump's flow needs for it."""
    oil, back = float(circuit.oil(motion)), oil_back(circuit, motion)
    says = said("{oil} from end to end", oil=show(oil, "l", ".2f"))
    if back:
        says = said("{oil} from end to end outwards, {back} inwards", oil=show(oil, "l", ".2f"), back=show(back, "l", ".2f"))
    if not np.any(circuit.number(motion, "flow") > 0.0):
        return Verdict("oil", True, said("{says}; time follows from the pump's flow, which is not given.", says=says))
    time, flow = show(float(circuit.time(motion)), "s", ".1f"), show(float(circuit.number(motion, "flow")), "l/min", 4)
    return Verdict("oil", True, said("{says}, {time} at {flow}.", says=says, time=time, flow=flow))


def oil_back(circuit: LiftLine, motion: Motion) -> float:
    """Return the oil [m3] that the rod sides take over the same way, of cylinders that work with both; 0 where none does."""
    both = [ram for ram in circuit.rams(motion) if ram.works == "both"]
    return sum(float(ram.travel(motion) * ram.sized(motion).pull_area) for ram in both)
