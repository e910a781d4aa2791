"""Cylinders and circuits in mechanism files: section [hydraulics], found by the entry points of the group `hydrolinkage.files`."""

from __future__ import annotations

from typing import Any, ClassVar

from pydantic import BaseModel, ConfigDict, Field

from linkage.errors import DefinitionError
from linkage.files import ElementEntry
from linkage.files.amounts import Amount, FixedMetres, FixedNumber, LoadName, LoadNames, Metres, Pressure, Volume, Word
from linkage.files.design import Design
from linkage.files.fields import TwoPoints
from linkage.quantities import Member, name_of

from .accumulator import AccumulatorBlock
from .floating import FloatCircuit
from .gas_file import GasLaw, written_gas
from .lift import LiftCircuit
from .member import Cylinder
from .vessel import Accumulator

VESSELS = 100


class CylinderEntry(ElementEntry):
    """`lift = { Cylinder = ["A", "B"], bore = "110 mm", rod = "63 mm", count = 2, closed = 0.5, stroke = 0.25 }`"""

    section: ClassVar[str] = "hydraulics"
    describes: ClassVar[type[Member]] = Cylinder
    parents: TwoPoints = Field(alias="Cylinder")
    bore: Metres
    rod: Metres
    count: FixedNumber = None
    works: Word = ""
    stroke: FixedMetres = None
    closed: FixedMetres = None
    mounting: Word = ""
    safety: FixedNumber = None


class CircuitEntry(ElementEntry):
    """The base of entries of circuits, which stand on a cylinder."""

    section: ClassVar[str] = "hydraulics"

    @classmethod
    def written_parents(cls, member: Any) -> Any:
        return name_of(member.cylinder)


class LiftCircuitEntry(CircuitEntry):
    """`circuit = { LiftCircuit = "lift", pressure = "180 bar", flow = "60 l / min" }`; of several cylinders `["lift", "aux"]`"""

    describes: ClassVar[type[Member]] = LiftCircuit
    parents: LoadNames = Field(alias="LiftCircuit")
    pressure: Pressure
    flow: Amount = None
    mechanical_efficiency: Amount = None
    hydraulic_efficiency: Amount = None
    back_pressure: Pressure = None
    relief: Pressure = None

    @classmethod
    def written_parents(cls, member: Any) -> Any:
        names = [name_of(each) for each in member.references]
        return names[0] if len(names) == 1 else names


class Vessel(BaseModel):
    """`{ volume = "4 l", charge = "25 bar" }`"""

    model_config = ConfigDict(extra="forbid", frozen=True)
    volume: Volume
    charge: Pressure


class FloatCircuitEntry(CircuitEntry):
    """`line = { FloatCircuit = "lift", charge_pressure = "40 bar", accumulators = [{ volume = "4 l", charge = "25 bar" }] }`"""

    describes: ClassVar[type[Member]] = FloatCircuit
    parents: LoadName = Field(alias="FloatCircuit")
    charge_pressure: Pressure
    at: Amount = None
    seal_friction: Pressure = None
    exponent: Amount = None
    accumulators: tuple[Vessel, ...] = Field(max_length=VESSELS)
    gas: GasLaw = None
    atmosphere: Pressure = None
    unit: Word = ""

    def given(self) -> dict[str, Any]:
        given = super().given()
        vessels = [Accumulator(each.volume, each.charge) for each in given.pop("accumulators")]
        block = AccumulatorBlock(vessels, **{name: given.pop(name) for name in ("gas", "atmosphere", "unit") if name in given})
        return given | {"block": block}

    @classmethod
    def written_numbers(cls, member: Any, design: Design) -> dict[str, Any]:
        if not isinstance(member.block, AccumulatorBlock):
            words = "its block is a Python function, which a file cannot hold; write AccumulatorBlock([Accumulator(volume=V, charge=P)])"
            raise DefinitionError(f"{words}, whose numbers may follow dimensions.")
        return super().written_numbers(member, design) | written_block(member.block, design)


def written_block(block: AccumulatorBlock, design: Design) -> dict[str, Any]:
    """Return what a file says of a block; its gas and the atmosphere only where they are not the usual ones."""
    usual = AccumulatorBlock(block.accumulators)
    pairs = [(design.amount(each.volume, "l"), design.amount(each.charge, "bar")) for each in block.accumulators]
    found: dict[str, Any] = {"accumulators": [{"volume": volume, "charge": charge} for volume, charge in pairs]}
    if block.gas.spelled != usual.gas.spelled:
        found["gas"] = written_gas(block.gas)
    if block.unit:
        found["unit"] = block.unit
    atmosphere = design.amount(block.atmosphere)
    return found if repr(atmosphere) == repr(usual.atmosphere) else found | {"atmosphere": atmosphere}
