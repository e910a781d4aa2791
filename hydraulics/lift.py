"""A pump that lifts by cylinders: its numbers, and what is said of it. Every pressure in this file is gauge [Pa]."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import ClassVar, final

from linkage.errors import DefinitionError, ensure
from linkage.frozen import refuses_changes
from linkage.language import with_and
from linkage.loads import ForceElement, Parameter
from linkage.motion import Condition, Judge, Motion, Question
from linkage.quantities import Member
from linkage.statics import same
from linkage.verdict import Verdict

from .inputs import Array, check_pressures
from .judged import line_conditions, line_questions, line_verdicts
from .line import LiftLine
from .member import Feeds, kind_among
from .shut import shut_verdicts


class PumpLine(LiftLine):
    """The base of lines that a pump holds, with what is asked and said of them."""

    def questions(self, judge: Judge) -> list[Question]:
        """Return what is asked of each of its cylinders: whether it carries anything, lifts, holds."""
        return line_questions(self, judge)

    def conditions(self, judge: Judge) -> Mapping[str, Condition]:
        """Return that each of its cylinders lifts, holds and goes back."""
        return line_conditions(self, judge)

    def load_limits(self, judge: Judge) -> Mapping[str, Condition]:
        return {}

    def verdicts(self, judge: Judge) -> list[Verdict]:
        """Return the verdicts on lifting, oil, holding and lowering."""
        try:
            return [*line_verdicts(self, judge, unit=self.unit_in(judge)), *shut_verdicts(self, judge)]
        except DefinitionError as error:
            return [Verdict("lifting", False, " ".join(str(error).split()))]


@final
@refuses_changes
@dataclass(frozen=True, eq=False)
class LiftCircuit(PumpLine):
    """A pump on a cylinder: `circuit = LiftCircuit(lift, pressure=180 * bar, flow=60 * litre / minute, mechanical_efficiency=0.9)`.

    Several cylinders on one line, `LiftCircuit([lift, aux], ...)`, share one pressure and carry thrust by area. `pressure` is the
    pump's highest, gauge [Pa], against which is lifted; `relief` that of the relief valve, against which is held (omitted: the
    pump's); `flow` in m3/s; `back_pressure` that of the returning oil on the other side [Pa gauge]. In a class the numbers are design
    variables such as `circuit.pressure`.
    """

    cylinder: Feeds
    pressure: Parameter
    flow: Parameter = 0.0
    mechanical_efficiency: Parameter = 1.0
    hydraulic_efficiency: Parameter = 1.0
    back_pressure: Parameter = 0.0
    relief: Parameter | None = None
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType(
        {
            "pressure": "bar", "flow": "l/min", "mechanical_efficiency": "", "hydraulic_efficiency": "", "back_pressure": "bar",
            "relief": "bar",
        }
    )
    not_negative: ClassVar[frozenset[str]] = frozenset({"pressure", "flow", "back_pressure", "relief"})
    optional: ClassVar[frozenset[str]] = frozenset({"relief"})
    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType({"cylinder": "loads"})

    def __post_init__(self) -> None:
        super().__post_init__()
        check_pressures(self, "circuit")

    def examine(self, members: Mapping[str, Member], title: str) -> None:
        ensure(self.references, f"{title}.{self.name}: the circuit has no cylinder; name one, LiftCircuit(lift, pressure=...).")
        super().examine(members, title)
        own = self.members(members)
        for place, ram in enumerate(own):
            if any(same(ram, each) for each in own[:place]):
                what = f"{self.name} has {ram.name or ram} twice, so that its oil would count double"
                raise DefinitionError(f"{title}: {what}; name it once, or write count=2 in the Cylinder where there are two.")
        for other in (each for each in kind_among(members, LiftCircuit) if each is not self):
            rams = other.members(members)
            shared = [ram for ram in own if any(same(ram, each) for each in rams)]
            if shared and not len(shared) == len(own) == len(rams):
                both = with_and(ram.name or str(ram) for ram in shared)
                what = f"{self.name} and {other.name} both have {both}, but not the same cylinders"
                says = "what shares a chamber is one line with one pressure"
                raise DefinitionError(f"{title}: {what}; {says}. Name all of them in one LiftCircuit, or none in both.")

    def __str__(self) -> str:
        return f"LiftCircuit({', '.join([self.named, *self.words()])})"

    def says(self, name: str, members: Mapping[str, Member]) -> tuple[ForceElement, str] | None:
        return None if self.given(name) is None else (self, name)

    def oil(self, motion: Motion) -> Array:
        return self.taken(motion)
