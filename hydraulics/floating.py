"""A closed line of cylinders and accumulators: its pressure over the stroke, with the seals' friction. Gauge pressures [Pa].

As the cylinder works outwards its fluid comes from the block and the pressure falls; pushed back, it grows. Seals act
against the motion: the pressure that acts is lower by their friction in the working direction, higher in the other.
Source: Rekhlitski, Chuprynin (2013), (36), (37), (39).
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import replace
from functools import partial, reduce
from math import nan
from types import MappingProxyType
from typing import Any, ClassVar, Self, TypeAlias, Unpack, cast

import numpy as np
from numpy.typing import ArrayLike

from linkage.errors import DefinitionError, can_be_called, cited, ensure, require, require_type
from linkage.frozen import immutable
from linkage.language import said
from linkage.loads import AT_REST, ForceElement, Glyph, Parameter, Poses, Push, Rate, Rates, require_poses
from linkage.loads.acting import Acting, ActingKeywords, Loads, situation_of, takes_situation
from linkage.loads.element import Formulas
from linkage.motion import Answer, Judge, Motion, MotionFunction
from linkage.plan import require_kinds
from linkage.program import is_traced
from linkage.quantities import NamedMembers, Reference, label, name_of, quantity
from linkage.statics import AnyMotion, held_in_case, plan_of, same, stroke_followed
from linkage.verdict import Verdict

from .accumulator import AccumulatorBlock, keeps_rule
from .cylinders import Circuit, Feeds, Ram, as_in, chamber_area, least_and_most
from .gas import Polytropic
from .inputs import Array, all_finite, follows, in_pascals, number_set, one_design
from .lifting_line import pressure_range
from .shut import shut_verdicts
from .standing import standing_pressure

Block: TypeAlias = "AccumulatorBlock | Callable[[Poses], AccumulatorBlock]"


class GasLine(Circuit):
    """The base of lines whose pressure is that of gas, by the volume drawn from it: shared by `FloatCircuit` and `OilLine`."""

    charge_pressure: Parameter | None
    not_negative: ClassVar[frozenset[str]] = frozenset({"seal_friction"})
    limited: ClassVar[Mapping[str, str]] = MappingProxyType({"exponent": "ratio"})

    @abstractmethod
    def gas_block(self) -> Block | None:
        """Return the accumulators on it; None for none.

        Returns
        -------
        AccumulatorBlock or callable, optional
            The accumulators.
        """

    def parts(self) -> tuple[Reference, ...]:
        return (*super().parts(), *getattr(self.gas_block(), "following", ()))

    def glyphs(self, members: NamedMembers) -> tuple[Glyph, ...]:
        block = self.gas_block()
        if block is None:
            return ()
        count = len(getattr(block, "accumulators", (block,)))
        return tuple(Glyph("accumulator", cylinder.ends, count) for cylinder in self.members(members))

    @abstractmethod
    def charged_at(self, motion: Poses, ram: Ram) -> Mapping[str, Array]:
        """Return the strokes [SI] at which the block has its charge pressure, for one of its cylinders.

        Parameters
        ----------
        motion : Motion
            The poses.
        ram : Ram
            The cylinder.

        Returns
        -------
        mapping of str to array
            The strokes by name.
        """

    def length_charged(self, motion: Poses, ram: Ram) -> Array:
        """Return the length of one of its cylinders where it was charged [m].

        Parameters
        ----------
        motion : Motion
            The poses.
        ram : Ram
            The cylinder.

        Returns
        -------
        array
            The length [m].
        """
        return length_at(motion, ram, self.charged_at(motion, ram))

    def withdrawn(self, motion: Poses) -> Array:
        """Return the fluid [m3] that has left the block since it was charged, shape (...); negative: pushed in. (36)

        By so much its chambers are larger than where it was charged.

        Parameters
        ----------
        motion : Motion
            The poses.

        Returns
        -------
        array
            The volume [m3].
        """
        require_poses(motion)
        return self.volume(motion, partial(self.length_charged, motion))

    def pressure_in(self, cylinder: Ram, motion: AnyMotion, acting: Acting) -> Array:
        return self.line_pressure(motion, acting)

    def bounds_of(self, cylinder: Reference, motion: Poses, lifting: bool, *, share: float = 1.0) -> tuple[Array, Array]:
        """Return the gas's force twice: its cylinder has no other [N]."""
        thrust = self.thrust(motion, cylinder=cylinder)
        return thrust, thrust

    def verdicts(self, judge: Judge) -> list[Verdict]:
        """Return the verdicts on the gas's pressure range, on the fluid left everywhere, and on its accumulators' limits.

        After that stands the verdict on the line where a load case shuts it.
        """
        shut = shut_verdicts(self, judge)

        try:
            low, high = judge.answers(least_and_most(MotionFunction(self.line_pressure, "pressure")))
            block = self.accumulators(judge.motion)
        except DefinitionError as error:
            return [Verdict.refused("line", error), *shut]
        unit = block.unit or "bar"
        says = pressure_range(low, high, unit)
        if not low.value > 0.0:
            text = says + said(": the line is empty there. Charge it higher, or take larger accumulators.")
            return [Verdict("line", False, text, answer=low), *shut]
        charges = partial(self.recharged, judge, block, {"charge": low, "compression": high})
        faults = [each for each in block.checks(low.value, high.value, high.value, recharged=charges) if not each.ok]
        if not faults:
            return [Verdict("line", True, f"{says}.", answer=low), *shut]
        found = "; ".join(f"{each.heading}: {each.sentence.rstrip('.')}" for each in faults)
        return [Verdict("line", False, f"{says}; {found}.", answer=high), *shut]

    def recharged(self, judge: Judge, block: AccumulatorBlock, worst: Mapping[str, Answer], number: int, rule: str) -> float:
        """Return the charge of an accumulator next to its own, with which it keeps all rules on the line [Pa gauge]; NaN for none.

        Whatever the charges, the `worst` pressure for a rule stands where most, or least, oil is drawn.
        """
        places, own = {each: judge.there(answer) for each, answer in worst.items()}, one_design(block.accumulators[number - 1].charge)
        limit = one_design(self.number(judge.motion, "charge_pressure")) if rule == "compression" else 0.05 * own

        def keeps(charge: float) -> bool:
            vessels = [each.recharged(charge) if k == number else each for k, each in enumerate(block.accumulators, 1)]
            pressures = {each: self.on_block(replace(block, accumulators=vessels)).gas_pressure(place) for each, place in places.items()}
            kept = [np.all(keeps_rule(each, charge + block.atmosphere, p + block.atmosphere)) for each, p in pressures.items()]
            return all(map(bool, kept))

        try:
            tried = np.geomspace(own, limit, 25)
            first = next((k for k, charge in enumerate(tried) if keeps(charge)), 0)
            fails, holds = (tried[first - 1], tried[first]) if first else (nan, nan)
            for _ in range(40 if first else 0):
                middle = 0.5 * (fails + holds)
                fails, holds = (fails, middle) if keeps(middle) else (middle, holds)
        except DefinitionError:
            return nan
        return float(holds * (1.0 - ROUNDED if rule == "charge" else 1.0 + ROUNDED))

    @abstractmethod
    def on_block(self, block: AccumulatorBlock) -> Self:
        """Return the same line on other accumulators.

        Parameters
        ----------
        block : AccumulatorBlock
            The accumulators.

        Returns
        -------
        GasLine
            The line.
        """

    def accumulators(self, motion: Poses) -> AccumulatorBlock:
        """Return its block as the motion's designs have it, before a movement: settled at the charge pressure, by its own gas law."""
        require_poses(motion)
        block = self.gas_block()
        assert block is not None
        return block(motion) if callable(block) else block.sized(motion)

    # -- over the stroke -----------------------------------------------------------------------------------

    @takes_situation
    def pressure(self, motion: AnyMotion, loads: Loads = None, **situation: Unpack[ActingKeywords]) -> Array:
        """Return the pressure of the line, shape (...) [Pa gauge]: of a held one the greatest that one of its cylinders asks for.

        Of gas it follows the fluid drawn from it, and is 0 where the line is empty. Of a closed line it is what keeps its oil where it
        is; where other lines leave it open, the least that balances, not below `make_up`. Below that it runs empty.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        loads : sequence of ForceElement or str, optional
            The loads; by default the machine's own.
        case, direction, rates, accelerations, inertia, acting : optional
            The situation, as in `Acting`; `acting` gives all in one.

        Returns
        -------
        ndarray
            The pressure [Pa gauge], shape (...).
        """
        return self.line_pressure(motion, situation_of("pressure", loads=loads, **situation))

    def oil(self, motion: Motion) -> Array:
        """Return the oil that has come in since it was filled, per pose, shape (...) [m3]; accumulators beside a pump hold theirs, too.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.

        Returns
        -------
        ndarray
            The volume [m3], shape (...).
        """
        return np.asarray(GasLine.withdrawn(self, motion))

    def gas_pressure(self, motion: Any) -> Array:
        """Return the block's pressure [Pa gauge], shape (...); 0 where the line is empty."""
        charge = in_pascals(self.number(motion, "charge_pressure"), "Charge pressure")
        left = self.withdrawn(motion)
        block, exponent = self.accumulators(motion), number_set(self, motion, "exponent")
        if not is_traced(exponent) and np.all(exponent == 1.0):
            return block.pressure(charge, left)
        fast = block.settled(number_set(self, motion, "charge_pressure"), exponent).pressure(charge, left)
        return np.where(exponent == 1.0, block.pressure(charge, left), fast) if is_traced(exponent) or np.any(exponent == 1.0) else fast

    def thrust(self, motion: Poses, rates: Mapping[str, Rate] = AT_REST, *, cylinder: Reference | None = None) -> Array:
        """Return the thrust of a cylinder [N], shape (...), its only one unless one is named.

        Frictionless at rest, or while strokes move at rates, with the seals' friction. (37), (39)
        """
        require_type("FloatCircuit: rates", rates, Mapping, "a speed for each stroke is expected, such as dict(S=0.05)")
        return self.thrust_of(self.one(motion, cylinder), motion, rates)

    def thrust_of(self, ram: Ram, motion: Poses, rates: Mapping[str, Rate]) -> Array:
        """Return the line's thrust on a cylinder [N], at rest or while strokes move at rates."""
        areas = [chamber_area(chamber, ram, motion) for each, chamber in self.filling(motion.plan.members) if same(each, ram)]
        area = reduce(np.add, areas)
        free = self.line_pressure(motion) * area
        if not rates or self.is_drained:
            return np.asarray(free)
        friction = all_finite(self.number(motion, "seal_friction"), "Seal friction") * np.abs(area)  # of the seals, against the movement
        return np.asarray(free - np.sign(ram.growth(motion, rates)) * friction)

    def formulas(self, written: Formulas) -> None:
        """Write the line's pressure, and the cylinder's thrust of it. (17)-(33), (36), (37)

        It is a formula for an ideal gas that moves slowly, where a label gives the cylinder's length; else a given number.
        """
        rams = self.members(written.plan.members)
        if len(rams) > 1:
            pressure = written.given(f"p_{self.name}", self.line_pressure, "bar")
            for ram in rams:
                area, _ = ram.sides_written(written, np.ones(()))
                written.carry(ram, -pressure * area if ram.side == "rod" else pressure * area)
            return
        (ram,) = rams
        area, _ = ram.sides_written(written, np.ones(()))
        block, sense = self.gas_block(), -1.0 if ram.side == "rod" else 1.0
        is_ideal = isinstance(block, AccumulatorBlock) and isinstance(block.gas, Polytropic) and not np.any(block.gas.n != 1.0)
        length = written.plan.table.lengths.get(frozenset((name_of(ram.A), name_of(ram.B))))
        if is_ideal and ram.stages == 1 and length is not None and written.equals(self.number(written, "exponent"), 1.0):
            charged = length_at(written, ram, self.charged_at(written, ram))
            left = written.line(f"dV_{ram.name}", (written.distance(ram.A, ram.B) - charged) * area * sense, "l")
            pressure = self._pressure_written(written, ram, cast(AccumulatorBlock, block), left)
        else:
            pressure = written.given(f"p_{ram.name}", self.line_pressure, "bar")
        written.carry(ram, -pressure * area if ram.side == "rod" else pressure * area)

    def _pressure_written(self, written: Formulas, ram: Ram, block: AccumulatorBlock, left: Array) -> Array:
        """Write p (V - V_idle) = sum of V_i C_i over the gases that work; one works up to the volume at which its charge C_i is left."""
        atmosphere = number_written(written, block.atmosphere)
        charges = [
            written.line(f"C_{ram.name}_{number}", number_written(written, each.charge) + atmosphere, "bar")
            for number, each in enumerate(block.accumulators, 1)
        ]
        vessels = [number_written(written, each.volume) for each in block.accumulators]
        settled = self.number(written, "charge_pressure") + atmosphere
        gas = written.line(f"V_{ram.name}", gas_written(charges, vessels, settled) + left, "l")
        works = [gas <= gas_written(charges, vessels, charge) for charge in charges]
        parts = list(zip(works, charges, vessels, strict=True))
        amount = written.line(f"pV_{ram.name}", reduce(np.add, (np.where(at_work, V * C, 0.0) for at_work, C, V in parts)), "Nm")
        idle = written.line(f"Vi_{ram.name}", reduce(np.add, (np.where(at_work, 0.0, V) for at_work, _, V in parts)), "l")
        pressure = np.where(gas <= reduce(np.add, vessels), amount / (gas - idle) - atmosphere, 0.0)
        return written.line(f"p_{ram.name}", pressure, "bar")

    def heeds_direction(self, motion: Poses) -> bool:
        return self.kind_in(motion.plan.members) == "given"

    def pushes(self, motion: Poses, rates: Rates = AT_REST) -> list[Push]:
        if self.kind_in(motion.plan.members) != "given":
            return []
        given = rates if rates.has_friction else AT_REST
        return [Push(ram, self.thrust_of(ram, motion, given)) for ram in self.rams(motion)]


@immutable
class FloatCircuit(GasLine):
    """A cylinder on a closed accumulator block: `FloatCircuit(lift, block, charge_pressure=94 * kgf_cm2, at=h_horizon)`.

    The cylinder works with one side and has no other force than the gas's; what its stroke still needs is the drive's.

    Parameters
    ----------
    cylinder : Cylinder, str or sequence of them
        The cylinders on the block; several have one pressure.
    block : AccumulatorBlock or callable
        The accumulators, whose charges and volumes may follow dimensions, or a function of the motion that returns a block.
    charge_pressure : float or quantity
        The line's pressure [Pa gauge] where it is charged.
    at : float or quantity, optional
        The stroke that a cylinder follows where the line is charged [m], 0 by default; other strokes at the sketch.
    seal_friction : float or quantity, optional
        What the seals take off that pressure [Pa], 0 by default.
    exponent : float or quantity, optional
        1, the default, is a slow movement by the block's own gas law. Above 1 the block has settled at the charge pressure and moves fast,
        by p V^exponent.
    """

    cylinder: Feeds
    block: Block
    charge_pressure: Parameter
    at: Parameter = 0.0
    seal_friction: Parameter = 0.0
    exponent: Parameter = 1.0
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType(
        {"charge_pressure": "bar", "at": "", "seal_friction": "bar", "exponent": ""}
    )
    stroke_values: ClassVar[frozenset[str]] = frozenset({"at"})
    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType({"cylinder": "loads", "block": AccumulatorBlock})

    def __post_init__(self) -> None:
        super().__post_init__()
        ensure(self.references, "FloatCircuit: [] stands where a cylinder or its name is expected.")
        for name in ("charge_pressure", "seal_friction"):
            if not follows(getattr(self, name)):
                in_pascals(getattr(self, name), name.replace("_", " ").capitalize())
        if not follows(self.exponent) and np.any(all_finite(cast(ArrayLike, self.exponent), "Exponent", "number") < 1.0):
            raise DefinitionError(f"FloatCircuit: exponent={cited(self.exponent)} is below 1; 1 is a slow movement, 1.4 a fast one.")
        expected = "is no AccumulatorBlock; write AccumulatorBlock([Accumulator(...)])"
        require(isinstance(self.block, AccumulatorBlock) or can_be_called(self.block), "FloatCircuit: block", self.block, expected)

    @property
    def scales(self) -> bool:
        return True

    def kind_open(self, members: NamedMembers) -> str:
        return "given"

    def gas_block(self) -> Block:
        return self.block

    def on_block(self, block: AccumulatorBlock) -> FloatCircuit:
        return self.renewed(block=block)

    def line_pressure(self, motion: AnyMotion, acting: Acting | None = None) -> Array:
        """Return the pressure of the gas [Pa gauge]; where a load case shuts the line, the pressure under the loads.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        acting : Acting, optional
            Loads, load case, direction and rates in one.

        Returns
        -------
        ndarray
            The pressure [Pa gauge], shape (...).
        """
        require_poses(motion)
        motion = held_in_case(motion, acting)
        is_shut = acting is not None and as_in(motion.plan, self)._is_shut
        return standing_pressure(self, motion, cast(Acting, acting)) if is_shut else self.gas_pressure(motion)

    def examine(self, members: NamedMembers, title: str) -> None:
        super().examine(members, title)
        if any(found.side == "both" for found in self.members(members)):
            names = ", ".join(map(label, self.references))
            what = f"{title}.{self.name}: {names} works with both sides, but a charged line fills one"
            raise DefinitionError(f'{what}; say works="piston" or works="rod".')

    def __str__(self) -> str:
        block = str(self.block) if isinstance(self.block, AccumulatorBlock) else getattr(self.block, "__name__", "block")
        return f"FloatCircuit({', '.join([self.cylinder_names, block, *self.words()])})"

    def feeds(self, members: NamedMembers) -> tuple[ForceElement, ...]:
        return () if self._is_shut else self.members(members)

    def claims(self, members: NamedMembers) -> Mapping[Hashable, str]:
        filled = "are given the same block, which would be filled twice: gas stands in one line"
        found: dict[Hashable, str] = {
            ("block", id(self.block)): f"{filled}. Give each circuit a block of its own, AccumulatorBlock([Accumulator(...)])."
        }
        for ram in self.members(members):
            doubled = f"feed {ram.name or ram}, whose thrust would count double: one chamber has one line"
            found["gas line", ram.name or id(ram)] = f"{doubled}. Take one out, or put the vessels of both into one AccumulatorBlock."
        return found

    def charged_at(self, motion: Poses, ram: Ram) -> Mapping[str, Array]:
        stroke = stroke_followed(plan_of(motion), ram)
        require_kinds(plan_of(motion), {stroke: self.given("at")})
        return {stroke: self.number(motion, "at")}


ROUNDED = 6e-4
"""Of a charge: four digits of it are not further off, so that what is read keeps the rule."""


def number_written(written: Formulas, value: Any) -> Array:
    """Return a number of a block, as it is written in a class or follows a quantity, for the equations [SI]."""
    return written.value(quantity(value)) if follows(value) else np.asarray(value, float)


def gas_written(charges: Sequence[Array], vessels: Sequence[Array], pressure: Array) -> Array:
    """Return the gas volume [m3] of ideal gases at an absolute pressure [Pa]."""
    return reduce(np.add, (V * np.minimum(1.0, C / pressure) for C, V in zip(charges, vessels, strict=True)))


def length_at(motion: Poses, ram: Ram, at: Mapping[str, Array]) -> Array:
    """Return a cylinder's length [m] where the line is charged: with some strokes there, others at the sketch; broadcasts."""
    plan = plan_of(motion)
    reading = plan.reading({**motion.inputs, **plan.sketch_strokes, **at})
    length = plan.table.lengths.get(frozenset((name_of(ram.A), name_of(ram.B))))
    if length is not None:
        return np.asarray(reading.value(length))[()]
    if plan.followed or (plan.reaches(name_of(ram.A)) | plan.reaches(name_of(ram.B))) & set(plan.groups):
        if not isinstance(motion, Motion) or any(np.size(value) != 1 for value in at.values()):
            what = f"{ram}: its length follows from a group of links, which has no closed form"
            raise DefinitionError(f"{what}; give the circuit one charging stroke for all designs, and ask for arrays.")
        values = {name: one_design(value) for name, value in at.items()}
        strokes = {name: np.asarray(place) for name, place in {**motion.plan.sketch_strokes, **values}.items()}
        there = Motion(motion.plan, motion.designs, {name: strokes[name] for name in motion.strokes}, "nan")
        found: Array = there.distance(ram.A, ram.B).reshape((*motion._design_shape, *(1,) * len(motion._stroke_shape)))
    else:
        with np.errstate(all="ignore"):
            found = np.asarray((reading.at(name_of(ram.B)) - reading.at(name_of(ram.A))).length())[()]
    if not np.all(np.isfinite(found)):
        where = " and ".join(f"{name} = {np.ravel(value)[0]:.6g}" for name, value in at.items()) or "of the sketch"
        raise DefinitionError(f"{ram}: the mechanism cannot be assembled at the charging stroke {where}.")
    return found
