"""Oil lines: joined chambers share one pressure and one volume; one is given, the other answers. Every pressure is gauge [Pa].

a chamber has a signed area a = dV/dl: pistons +, annuli -
thrust T = sum of a p over a cylinder's chambers, oil taken V' = a l', so that T l' = sum of p V'

on the line                  given             called
Pump                         V, by the pose    held: it takes over one stroke
nothing                      V = oil           closed: it keeps a sum of lengths, its pressure is what that takes
Tank                         p                 given
AccumulatorBlock             p of the gas      given, as a function of the oil that is drawn
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial, reduce
from math import pi
from operator import add
from types import MappingProxyType
from typing import Any, ClassVar, TypeAlias, TypeVar, Unpack, cast

import numpy as np

from linkage.errors import DefinitionError, cited, ensure, known_name, require_type, unknown
from linkage.frozen import FrozenDict, immutable
from linkage.language import said
from linkage.loads import Acting, ActingKeywords, Declared, ForceElement, Loads, Parameter, Poses, Tie, situation_of, takes_situation
from linkage.loads.element import UNBOUNDED, Formulas
from linkage.motion import Condition, Judge, Motion, PageWords, Question, at, least, most
from linkage.quantities import AtPose, Distance, Number, Quantity, Stroke, Variable, label, quantity
from linkage.quantities.member import Member, NamedMembers, Reference, Where, in_class, is_member_or_name, name_of, of_kind
from linkage.quantities.quantity import plain
from linkage.statics import AnyMotion, LawRequest, each_once, held_in_case, plan_of, same
from linkage.units import require_measure, show
from linkage.vectors import Scalar
from linkage.verdict import Verdict

from .accumulator import AccumulatorBlock
from .cylinders import (
    PISTON,
    ROD,
    SIDES,
    AllOf,
    Chamber,
    Circuit,
    Ram,
    Side,
    as_in,
    by_other_lines,
    chamber_area,
    circuits_among,
    is_named,
    least_and_most,
    lines_giving,
    lines_of,
    number_request,
    over_valves,
    side_left,
    the_cylinder,
)
from .files import filled_kind, on_line_kind
from .floating import Block, GasLine
from .inputs import Array, follows, in_pascals, names_behind, number_set, one_design, one_number
from .lift import PumpLine
from .lifting_line import pressure_range
from .pump import Pump, Relief, Supply, Tank
from .shut import EMPTY, intensified, shut_verdicts
from .standing import standing_pressure


@immutable
class LineLength(Quantity):
    """The length that a closed line gives one of its cylinders [m]."""

    of: Quantity

    @property
    def measures(self) -> str:
        return "length"

    def parts(self) -> tuple[Reference, ...]:
        return (self.of,)

    def rule(self, where: Where) -> Scalar:
        return where.value(self.of)

    def __str__(self) -> str:
        return str(self.of)


Kind = TypeVar("Kind", bound=Supply)
OnLine: TypeAlias = "Chamber | Reference | Block"
"""What may lie on a line: a chamber, a cylinder, a pump, a relief valve, a tank, by their names too, or accumulators."""
NUMBERS: Mapping[str, tuple[str, ...]] = MappingProxyType({
    "held": (), "closed": ("oil", "make_up"), "given": ("oil", "charge_pressure", "seal_friction", "exponent"),
})  # fmt: skip
"""The numbers of a line that count, by its kind."""


class OilLine(PumpLine, GasLine):
    """Oil that joins chambers: `level = OilLine(master.piston_side, slave.piston_side, filled=dict(slave=0.72))`.

    Parameters
    ----------
    *on : Chamber, Cylinder, Pump, Tank, Accumulator, Relief or str
        The chambers, and what says the pressure or the volume. A `Pump` gives the volume, by the pose, so that the line is held. A `Tank`
        or accumulators give the pressure. With nothing the line is closed: it keeps its oil and gives one of its cylinders its length,
        `slave.length`. A bare cylinder stands for the side that it works with. A `Relief` may lie on any line.
    at : float or mapping of str to float, optional
        The strokes [SI] at which the line is filled or charged; the sketch for strokes that are not named.
    filled : str or mapping of str to float, optional
        Instead of `at`, the lengths [m] of some cylinders there, or that all are "open" or "closed".
    oil : float or quantity, optional
        What was put in since [m3]: a number, a dimension or a Stroke; 0 by default.
    make_up : float or quantity, optional
        The pressure below which a closed line runs empty [Pa gauge], 0 by default.
    charge_pressure : float or quantity, optional
        The pressure to which accumulators are charged [Pa gauge].
    seal_friction, exponent : float or quantity, optional
        What the seals take off the gas's pressure [Pa], and the exponent of a fast movement, as of a FloatCircuit.

    Raises
    ------
    DefinitionError
        What is on the line does not go together, or a word or a number is not known.
    """

    parameters: ClassVar[Mapping[str, str]] = MappingProxyType(
        {"oil": "l", "make_up": "bar", "charge_pressure": "bar", "seal_friction": "bar", "exponent": ""}
    )
    optional: ClassVar[frozenset[str]] = frozenset({"charge_pressure"})
    argument_kinds: ClassVar[Mapping[str, Any]] = MappingProxyType(
        {"on": lambda: on_line_kind(AccumulatorBlock, Pump, Relief, Tank), "at": filled_kind, "filled": filled_kind}
    )

    def __init__(
        self, *on: OnLine, at: float | Mapping[str, float] | None = None, filled: str | Mapping[str, object] | None = None,
        oil: Parameter = 0.0, make_up: Parameter = 0.0, charge_pressure: Parameter | None = None, seal_friction: Parameter = 0.0,
        exponent: Parameter = 1.0,
    ) -> None:  # fmt: skip
        found: list[OnLine] = []
        for each in on:
            name, _, side = each.rpartition(".") if isinstance(each, str) else ("", "", "")
            found.append(Chamber(name, CHAMBERS[side]) if name and side in CHAMBERS else each)
        self.on = tuple(found)
        self.at, self.filled = at, FrozenDict(filled) if isinstance(filled, Mapping) else filled
        self.put_in, self.make_up, self.charge_pressure = oil, make_up, charge_pressure
        self.seal_friction, self.exponent, self.kind_of_line = seal_friction, exponent, ""
        for each in self.on:
            is_block = isinstance(each, AccumulatorBlock) or (callable(each) and not isinstance(each, (type, Member)))
            if not is_block and not isinstance(each, (Chamber, str, Ram, Supply)):
                what = f"OilLine({cited(each)}): neither a chamber nor a pump, a relief valve, a tank or accumulators"
                raise DefinitionError(f"{what}; write lift.piston_side, a Pump, a Tank, an AccumulatorBlock.")
        if isinstance(self.filled, str) and self.filled not in ("open", "closed"):
            raise DefinitionError(f'OilLine(filled={self.filled!r}): say "open", "closed", or lengths, filled=dict(slave=0.72).')
        if self.filled is not None:
            require_type("OilLine(filled", self.filled, (str, Mapping), "lengths of cylinders are expected, filled=dict(slave=0.72)")
        for name, length in self.lengths_told.items():
            if not isinstance(length, (str, Quantity)):
                one_number(length, f"OilLine: filled, {name}")
            require_measure(length, "length", f"OilLine: filled, {name}")
        if isinstance(self.filled, str) and self.at is not None:
            raise DefinitionError(f"OilLine(at=..., filled={self.filled!r}): both say where all its cylinders are; leave one out.")
        for name in ("make_up", "charge_pressure", "seal_friction"):
            given = self.given(name)
            if given is not None and not follows(given):
                in_pascals(given, f"OilLine: {name}")
        self._check_numbers()

    @property
    def numbers(self) -> Mapping[str, str]:
        among = () if self.is_drained else NUMBERS.get(self.kind_of_line, tuple(self.parameters))
        return {name: self.parameters[name] for name in among if self.given(name) is not None}

    def given(self, name: str) -> Any:
        return self.put_in if name == "oil" else getattr(self, name)

    def __str__(self) -> str:
        words = []
        for name, value in (("at", self.at), ("filled", self.filled)):
            if isinstance(value, Mapping):
                words.append(f"{name}=dict({', '.join(f'{key}={plain(each)}' for key, each in value.items())})")
            elif value is not None:
                words.append(f"{name}={plain(value)!r}")
        more = [text for name, text in zip(self.numbers, self.words(), strict=True) if not self._is_usual(name)]
        return f"OilLine({', '.join([*map(on_line_text, self.on), *words, *more])})"

    def _is_usual(self, name: str) -> bool:
        given = self.given(name)
        return not isinstance(given, (str, Quantity)) and name in USUAL and bool(np.all(np.asarray(given) == USUAL[name]))

    @property
    def lengths_told(self) -> Mapping[str, Any]:
        """The lengths of cylinders that `filled` tells, by their names [m]."""
        return self.filled if isinstance(self.filled, Mapping) else {}

    # -- what is on it -------------------------------------------------------------------------------------

    @property
    def chambers(self) -> tuple[Chamber, ...]:
        return tuple(each for each in self.on if isinstance(each, Chamber))

    @property
    def bare(self) -> tuple[Reference, ...]:
        return tuple(each for each in self.on if is_member_or_name(each))

    def chambers_of(self, cylinder: Ram, members: NamedMembers) -> tuple[Chamber, ...]:
        """Return the chambers of a cylinder on it; where it names the cylinder alone, the side that no other line names.

        Parameters
        ----------
        cylinder : Ram
            The cylinder.
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        tuple of Chamber
            The chambers.
        """
        named = super().chambers_of(cylinder, members)
        left = side_left(cylinder, members) if cylinder.name and cylinder.name in map(label, self.bare) else None
        return named if left is None else (*named, Chamber(cylinder.name, cast(Side, left)))

    @property
    def references(self) -> tuple[Reference, ...]:
        return (*(each.cylinder for each in self.chambers), *self.bare)

    def parts(self) -> tuple[Reference, ...]:
        return (*super().parts(), *(each for each in map(quantity, self.lengths_told.values()) if not each.is_constant))

    def supplies(self, members: NamedMembers, kind: type[Kind]) -> list[Kind]:
        """Return the pumps, relief valves or tanks on it.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.
        kind : type
            The class of supply.

        Returns
        -------
        list of Supply
            The supplies.
        """
        found = (in_class(members, each) for each in self.bare)
        return [each for each in found if isinstance(each, kind)]

    def pump(self, members: NamedMembers) -> Pump | None:
        return next(iter(self.supplies(members, Pump)), None)

    @property
    def blocks(self) -> list[Block]:
        """All accumulators that are named, of which one may be on it."""
        return [each for each in self.on if not isinstance(each, (Chamber, str, Member))]

    @property
    def block(self) -> Block | None:
        """The accumulators on it; None where there are none."""
        return next(iter(self.blocks), None)

    def gas_block(self) -> Block | None:
        return self.block

    def kind_open(self, members: NamedMembers) -> str:
        if self.supplies(members, Pump):
            return "held"
        return "given" if self.block is not None or self.supplies(members, Tank) else "closed"

    @property
    def is_drained(self) -> bool:
        return self.kind_of_line == "given" and self.block is None

    def filling(self, members: NamedMembers) -> list[tuple[Ram, Chamber]]:
        """Return the chambers on it with their cylinders, as the class has them; of a bare cylinder the side that works.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        list of tuple
            Each cylinder with its chamber.
        """
        found = []
        for each in self.on:
            if isinstance(each, Chamber):
                ram = members[name_of(each.cylinder)] if is_named(each.cylinder) else each.cylinder
                found.append((cast(Ram, ram), each))
            elif is_member_or_name(each):
                ram = in_class(members, each)
                if isinstance(ram, Ram):
                    found.append((ram, Chamber(each, cast(Side, side_left(ram, members)))))
        return found

    def members(self, members: NamedMembers) -> tuple[Ram, ...]:
        return each_once(ram for ram, _ in self.filling(members))

    def rams(self, motion: Poses) -> tuple[Ram, ...]:
        members = motion.plan.members
        return tuple(self.as_worked(ram, members) for ram in self.members(members))

    def as_worked(self, cylinder: Ram, members: NamedMembers) -> Ram:
        """Return a cylinder as this line works it: where it is held by a line on each side, on this line's own side alone.

        Parameters
        ----------
        cylinder : Ram
            One of the line's cylinders.
        members : mapping
            The machine's members by name.

        Returns
        -------
        Ram
            The same cylinder, or one that works on the line's side.
        """
        has_one_side = cylinder.side == "both" and self.kind_in(members) == "held"
        return cylinder.on_side(own_side(self, cylinder, members)) if has_one_side else cylinder

    def among(self, members: NamedMembers) -> OilLine:
        return self.renewed(kind_of_line=self.kind_in(members))

    def cuts(self, members: NamedMembers) -> tuple[str, ...]:
        tie = self.tie(members) if self.kind_of_line == "closed" else None
        return () if tie is None or not tie.gives or isinstance(members.get(tie.cut), Stroke) else (tie.cut,)

    def driven_cuts(self, members: NamedMembers) -> tuple[str, ...]:
        cuts, oil = self.cuts(members), self.oil_given
        return cuts if any(isinstance(members.get(name), Stroke) for name in names_behind([oil], members)) else ()

    def variables(self) -> tuple[tuple[str, float, str, str], ...]:
        """Return its design variables; where its oil follows a dimension or an expression, also the oil added to that, which is 0.

        Returns
        -------
        tuple
            Name, default [SI], kind and unit of each.
        """
        beside = ((self.cut, 0.0, "number", "l"),) if self.kind_of_line == "closed" and self.cut.endswith(".added") else ()
        return (*super().variables(), *beside)

    def examine(self, members: NamedMembers, title: str) -> None:
        for each in self.references:
            name = name_of(each, is_needed=False)
            if name and name not in members:
                known = [each.name for each in members.values() if isinstance(each, (Ram, Supply))]
                raise unknown("Cylinder, pump, valve or tank", name, known, where=f"{title}.{self.name}")
        Member.examine(self, members, title)
        self._examine_others(members, title)
        own = [ram.name for ram, _ in self.filling(members)]
        for name in self.lengths_told:
            known_name("Cylinder", name, own, where=f"{title}.{self.name}, filled")

    def faults(self, members: NamedMembers) -> Iterator[str]:
        filling = self.filling(members)
        for ram, chamber in filling:
            if not isinstance(cast(Member, ram), Ram):
                yield f"{chamber} is no chamber, as {ram} is no Cylinder"
            if chamber.side not in SIDES:
                yield f"{ram.name} works with both sides; say which, {ram.name}.piston_side"
        if not filling:
            yield "no chamber is on it; name one, lift.piston_side"
        pumps, tanks, valves = (self.supplies(members, kind) for kind in (Pump, Tank, Relief))
        if pumps and tanks:
            remedy = f"put the other side on the tank, OilLine(lift.rod_side, {tanks[0].name or 'Tank()'})"
            yield f"a pump and a tank are on one line, whose pressure would be given twice; {remedy}"
        if tanks and self.blocks:
            yield "accumulators and a tank give its pressure both; take one out"
        each_of = (pumps, "pumps"), (tanks, "tanks"), (valves, "relief valves"), (self.blocks, "blocks of accumulators")
        beside = {"pumps": ", with the flow of both, Pump(..., flow=...)"}
        yield from (f"{len(found)} {what} are on one line; leave one{beside.get(what, '')}" for found, what in each_of if len(found) > 1)
        kind = self.kind_in(members)
        counting = () if kind == "given" and self.block is None else NUMBERS[kind]
        says = {"held": "a pump holds its pressure", "closed": "it is closed", "given": "its pressure is given"}[kind]
        for name in self.parameters:
            if name not in counting and self.given(name) is not None and not self._is_usual(name):
                yield f"{name}= counts for nothing there, as {says}; leave it out"
        if kind == "given" and self.block is not None and self.charge_pressure is None:
            yield "its accumulators are charged to no pressure; say charge_pressure=90 * bar"

    def _examine_others(self, members: NamedMembers, title: str) -> None:
        """Raise DefinitionError for chambers on this line and another one, or twice on this."""
        own = [(ram.name, chamber.side) for ram, chamber in self.filling(members)]
        twice = next((each for each in own if own.count(each) > 1), None)
        if twice is not None:
            raise DefinitionError(f"{title}: {self.name} has {twice[0]}.{twice[1]}_side twice; name it once.")
        for other in (each for each in circuits_among(members) if not same(each, self)):
            theirs = [(ram.name, chamber.side) for ram, chamber in other.filling(members)]
            shared = next((each for each in own if each in theirs), None)
            first, second = (each for each in members if each in (self.name, other.name))
            if shared is not None:
                what = f"two pressures in {shared[0]}'s {shared[1]} side: {first} and {second} both have it"
                by_itself = f"{other.name} has the side that {shared[0]} works with; take one of the two out"
                remedy = "join the two, or take it out of one" if isinstance(other, OilLine) else by_itself
                raise DefinitionError(f"{title}: {what}. A chamber has one line; {remedy}.")
            beside = next((name for name, _ in theirs if name in [each for each, _ in own]), None)
            if beside is not None and self.kind_open(members) == "held" and not isinstance(other, OilLine):
                what = f"{first} and {second} both drive {beside}, and {type(other).__name__} knows of no pump on the other side"
                remedy = f"give each side an OilLine, {beside}.piston_side and {beside}.rod_side"
                raise DefinitionError(f"{title}: {what}; {remedy}.")
            mine, its = self.block, getattr(other, "block", None)
            if mine is not None and mine is its:
                remedy = "join the lines, or give each its own, AccumulatorBlock([Accumulator(...)])"
                what = f"{self.name} and {other.name} have the same accumulators, which stand on one line"
                raise DefinitionError(f"{title}: {what}; {remedy}.")

    # -- in statics ----------------------------------------------------------------------------------------

    def feeds(self, members: NamedMembers) -> tuple[ForceElement, ...]:
        """Return its cylinders all of whose lines have a given pressure, one of them on the side that works: their thrust is given.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        tuple of ForceElement
            The cylinders.
        """
        found: list[Ram] = []
        for ram in self.members(members) if self.kind_in(members) == "given" else ():
            on = [(line, each.side) for line in circuits_among(members) for own, each in line.filling(members) if same(ram, own)]
            works = ram.side not in SIDES or ram.side in [side for _, side in on]
            found += [ram] if works and all(line.kind_in(members) == "given" for line, _ in on) else []
        return tuple(found)

    def tie(self, members: NamedMembers) -> Tie | None:
        """Return how its pressure acts on its cylinders, where it is closed, or held beside a closed line.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        Tie or None
            The tie.
        """
        kind = self.kind_open(members)
        if kind != "closed":
            return PumpLine.tie(self, members) if kind == "held" else Circuit.tie(self, members)
        giving = [name for name, line in lines_giving(members).items() if same(line, self)]
        asked = (f"{ram.name}.length" for ram, _ in self.filling(members) if ram.name in giving)
        gives = next((name for name in asked if isinstance(members.get(name), LineLength)), "")
        added = None if self.oil_given.is_constant else self.oil_given
        return Tie(self.name, self.pressure_shares(members), held=False, cut=self.cut if gives else "", gives=gives, added=added)

    @property
    def oil_given(self) -> Quantity:
        """The oil that is put in, as it is given [m3]."""
        return quantity(cast("float | Quantity | str", self.put_in))

    @property
    def cut(self) -> str:
        """The input that changes its oil: a stroke where one gives it, else its own, added to the quantity it follows."""
        oil = self.oil_given
        if isinstance(oil, Number):
            return f"{self.name}.oil"
        return oil.name if isinstance(oil, Stroke) and oil.name else f"{self.name}.added"

    def link_written(self, pin: str, members: NamedMembers) -> str:
        for ram in [members.get(name_of(each)) for each in self.references] if self.kind_open(members) == "closed" else ():
            if isinstance(ram, Ram) and pin in map(name_of, ram.ends):
                A, B = map(name_of, ram.ends)
                return f'Link("{A} {B}", {A}{B}=ref("{ram.name}.length"))'
        return ""

    def fills(self, name: str) -> bool:
        return isinstance(self.filled, str) or name in self.lengths_told

    @property
    def scales(self) -> bool:
        return self.kind_of_line == "given"

    # -- where it is filled, and the length that it gives ------------------------------------------------------

    def stroke_arguments(self, strokes: Sequence[str]) -> Mapping[str, object]:
        return self.at if isinstance(self.at, Mapping) else dict.fromkeys(strokes, self.at)

    def strokes_filled(self, strokes: Sequence[str]) -> dict[str, float]:
        """Return the strokes that it says to be filled at [SI]; DefinitionError for anything but a stroke, and a number for several.

        Parameters
        ----------
        strokes : sequence of str
            The strokes of the class.

        Returns
        -------
        dict of str to float
            The strokes [m or rad].

        Raises
        ------
        DefinitionError
            A name of no stroke, or one number for several strokes.
        """
        if self.at is None:
            return {}
        if isinstance(self.at, Mapping):
            for name in self.at:
                known_name("Stroke", name, strokes, where=f"{self.name}, at")
            return {name: one_number(value, f"{self.name}, at: {name}") for name, value in self.at.items()}
        ensure(len(strokes) == 1, f"{self.name} = {self}: the machine has {len(strokes)} strokes; say at=dict({', '.join(strokes)}=...).")
        return {strokes[0]: one_number(self.at, f"{self.name}, at")}

    def length_filled(self, ram: Ram, members: NamedMembers) -> Quantity:
        """Return the length of a cylinder where the line is filled [m].

        Parameters
        ----------
        ram : Ram
            The cylinder.
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        Quantity
            The length [m].
        """
        if ram.name in self.lengths_told:
            return quantity(self.lengths_told[ram.name])
        if isinstance(self.filled, str):
            wanted = ("closed", "stroke") if self.filled == "open" else ("closed",)
            lost = next((name for name in wanted if name not in ram.lengths_given), None)
            if lost is not None:
                raise DefinitionError(f"{self.name} = {self}: {ram.name} says no {lost}; declare it, or give lengths, filled=dict(...).")
            named = [each for name in wanted for each in ram.lengths_named(name)]
            return reduce(add, (Variable(each) if isinstance(each, str) else each for each in named))
        strokes = self.strokes_filled([*of_kind(members, Stroke)])
        return AtPose(Distance(ram.A, ram.B), FrozenDict(strokes), put_in_later(members))

    def length_given(self, chamber: Chamber, members: NamedMembers) -> Quantity:
        """Return the length of one of its cylinders [m]: that where it was filled, and the change from the others' oil.

        Parameters
        ----------
        chamber : Chamber
            The cylinder's chamber.
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        Quantity
            The length [m].
        """
        filling = self.filling(members)
        own = cast(Ram, members[name_of(chamber.cylinder)])
        what = f"{self.name} = {self}: nothing says how long {own.name} is where the line is filled"
        ensure(self.fills(own.name), f"{what}; add filled=dict({own.name}=...) in m.")
        pins = {*own.ends}  # rams of one stage stand side by side on the same pins
        beside = [] if own.is_single_acting else [ram for ram, _ in filling if {*ram.ends} == pins and not ram.is_single_acting]
        alike = [(ram, each) for ram, each in filling if ram is own or any(ram is one for one in beside)]
        others = [(ram, each) for ram, each in filling if all(ram is not one for one, _ in alike)]
        oil = self.oil_given
        if isinstance(oil, Number):
            oil = Variable(self.cut)
        elif self.cut.endswith(".added"):
            oil = oil + Variable(self.cut)
        taken = oil * (4.0 / pi)
        for ram, each in others:
            taken = taken - ram.filled_written(each.side, self.length_filled(ram, members), Distance(ram.A, ram.B))
        if len({ram.name for ram, _ in alike}) > 1:  # side by side on the same pins they share what comes
            areas = [(ram, ram.filled_written(each.side, Number(0.0), Number(1.0))) for ram, each in alike]
            mine = reduce(add, (area for ram, area in areas if ram is own))
            taken = taken * (mine / reduce(add, (area for _, area in areas)))
        sides = [each.side for ram, each in filling if ram.name == own.name]
        return LineLength(own.length_written(sides, self.length_filled(own, members), taken))

    # -- its pressure and its oil ------------------------------------------------------------------------------

    @takes_situation
    def intensified(self, motion: AnyMotion, loads: Loads = None, **situation: Unpack[ActingKeywords]) -> Array:
        """Return the pressure in it, shape (...) [Pa gauge], in a load case that shuts it, while the pump of the other side gives all.

        The piston pushes with the pump's pressure, and the smaller annulus takes up what the load does not: it may be far above the
        pump's. DefinitionError where no pump is on the other side of one of its cylinders.

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

        Raises
        ------
        DefinitionError
            No pump is on the other side.
        """
        return intensified(self, motion, situation_of("intensified", loads=loads, **situation))

    def line_pressure(self, motion: Any, acting: Acting | None = None) -> Array:
        return self._pressure_with(None, motion, acting)

    def _pressure_with(self, cylinder: Ram | None, motion: Any, acting: Acting | None) -> Array:
        """Return its pressure while one of its cylinders moves as the situation says, by default the first one [Pa gauge]."""
        motion, asked = held_in_case(motion, acting), Acting() if acting is None else acting
        members = motion.plan.members
        kind = self.kind_open(members)
        if kind == "held":
            return self.pressure_for(motion, acting=asked)
        if kind == "closed" or as_in(motion.plan, self)._is_shut:
            return standing_pressure(self, motion, asked)
        tanks = self.supplies(members, Tank)
        found = in_pascals(number_set(tanks[0], motion, "pressure"), "Pressure of the tank") if tanks else self.gas_pressure(motion)
        return found if acting is None else over_valves(self, cylinder or self.rams(motion)[0], motion, acting, found)

    def least(self, motion: Poses) -> Array | float:
        """Return the pressure below which it runs empty [Pa].

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.

        Returns
        -------
        ndarray or float
            The pressure [Pa].
        """
        return number_set(self, motion, "make_up") if self.kind_in(motion.plan.members) == "closed" else 0.0

    def has_gas(self, members: NamedMembers) -> bool:
        return self.block is not None and self.kind_in(members) == "held"

    def volume(self, motion: Poses, start: Callable[[Ram], Array] | None = None) -> Array:
        found = super().volume(motion, start)
        return found + self.accumulators(motion).fluid(self.line_pressure(motion)) if self.has_gas(motion.plan.members) else found

    def oil(self, motion: Motion) -> Array:
        found = super().oil(motion)
        if not self.has_gas(motion.plan.members):
            return found
        at = {**motion.plan.sketch_strokes, **self.strokes_filled(list(motion.plan.strokes))}
        filled = Motion(motion.plan, motion.designs, {name: np.asarray(at[name]) for name in motion.plan.strokes}, "nan")
        then = self.accumulators(filled).fluid(self.line_pressure(filled))
        return found - then.reshape((*motion._design_shape, *(1,) * len(motion._stroke_shape)))

    def length_charged(self, motion: Poses, ram: Ram) -> Array:
        length = self.length_filled(ram, motion.plan.members)
        return super().length_charged(motion, ram) if isinstance(length, AtPose) else motion.value(length)

    def charged_at(self, motion: Poses, ram: Ram) -> Mapping[str, Array]:
        strokes, members = self.strokes_filled(list(plan_of(motion).strokes)), motion.plan.members
        unmoved = put_in_later(members) if self.kind_in(members) == "closed" else ()
        return {name: np.asarray(value) for name, value in {**dict.fromkeys(unmoved, 0.0), **strokes}.items()}

    def withdrawn(self, motion: Poses) -> Array:
        return np.asarray(super().withdrawn(motion) - self.number(motion, "oil"))

    def on_block(self, block: AccumulatorBlock) -> OilLine:
        return self.renewed(on=tuple(block if each is self.block else each for each in self.on))

    # -- the numbers of a pump -------------------------------------------------------------------------------

    def number(self, motion: Poses, name: str) -> Array:
        return ForceElement.number(self, motion, name) if name == "oil" else PumpLine.number(self, motion, name)

    def says(self, name: str, members: NamedMembers) -> tuple[ForceElement, str] | None:
        if name in self.parameters:
            return self, name
        kinds: Mapping[str, type[Supply]] = {"relief": Relief, "back_pressure": Tank}
        kind = kinds.get(name, Pump)
        return next(((each, name if kind is Pump else "pressure") for each in self.supplies(members, kind)), None)

    # -- by its kind -----------------------------------------------------------------------------------------

    def pressure_in(self, cylinder: Ram, motion: AnyMotion, acting: Acting) -> Array:
        if self.kind_open(motion.plan.members) == "held":
            return PumpLine.pressure_in(self, cylinder, motion, acting)
        return self._pressure_with(cylinder, motion, acting) + np.zeros(motion.shape)

    def bounds_of(self, cylinder: Reference, motion: Poses, lifting: bool, *, share: float = 1.0) -> tuple[Array, Array]:
        """Return between which two thrusts it lets one of its cylinders stand [N].

        A held line has what its pump lifts or its valve holds, one with a given pressure that alone. A closed one goes from where it runs
        empty to where its relief valve opens; it is unbounded if it has both sides.

        Parameters
        ----------
        cylinder : str or Ram
            The cylinder, or its name.
        motion : Motion
            The poses; designs first, strokes last.
        lifting : bool
            Whether it moves the load, or holds it.
        share : float
            The part of the drive's force that counts, 0 to 1.

        Returns
        -------
        tuple of ndarray
            The lowest and the highest thrust [N].
        """
        members, ram = motion.plan.members, the_cylinder(motion, cylinder)
        kind = self.kind_open(members)
        if kind == "held":
            return PumpLine.bounds_of(self, cylinder, motion, lifting, share=share)
        more = by_other_lines(ram, self, motion, None)  # type: ignore[arg-type]
        if kind == "given":
            thrust = self.thrust_of(ram, motion, {}) + more
            return thrust, thrust
        own = [chamber_area(chamber, ram, motion) for each, chamber in self.filling(members) if same(each, ram)]
        if len(own) > 1 or len(lines_of(ram, members, "closed")) > 1:
            return UNBOUNDED
        most = self.number(motion, "relief") if self.relieves(motion.plan) else np.asarray(np.inf)
        low, high = self.least(motion) * own[0] + more, most * own[0] + more
        return (low, high) if own_side(self, ram, members) == PISTON else (high, low)

    def questions(self, judge: Judge) -> list[Question]:
        if self.kind_of_line == "held":
            return PumpLine.questions(self, judge)
        if self.kind_of_line != "closed":
            return []
        return least_and_most(self.pressure_request(judge.plan))

    def conditions(self, judge: Judge) -> Mapping[str, Condition]:
        if self.kind_of_line == "held":
            return PumpLine.conditions(self, judge)
        if self.kind_of_line != "closed":
            return {}
        pressure = self.pressure_request(judge.plan)
        keeps = least(pressure) >= at(number_request(self, ".make_up", partial(number_set, self, name="make_up")))
        if not self.relieves(judge.plan):
            return {"line": keeps}
        opens = at(number_request(self, " relief", partial(self.number, name="relief")))
        return {"line": AllOf((keeps, most(pressure) <= opens))}

    def page_words(self, judge: Judge) -> Mapping[str, PageWords]:
        return PumpLine.page_words(self, judge) if self.kind_of_line == "held" else {}

    def load_limits(self, judge: Judge) -> Mapping[str, Condition]:
        return self.conditions(judge) if self.kind_of_line == "closed" else {}

    def verdicts(self, judge: Judge) -> list[Verdict]:
        """Return the verdicts on lifting, oil, holding and lowering of a held line, on the pressure of any other.

        A closed one keeps its oil if it neither runs empty nor opens its relief valve.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        list of Verdict
            The verdicts.
        """
        if self.kind_of_line == "held":
            return PumpLine.verdicts(self, judge)
        if self.block is not None:
            return [*GasLine.verdicts(self, judge), *self._relieved(judge)]
        shut = shut_verdicts(self, judge)
        if self.kind_of_line != "closed":
            return [*self._relieved(judge), *shut]
        try:
            low, high = judge.answers(least_and_most(self.pressure_request(judge.plan)))
        except DefinitionError as error:
            return [Verdict.refused("line", error), *shut]
        says = pressure_range(replace(low, value=0.0) if abs(low.value) < EMPTY * abs(high.value) else low, high, "bar")
        make_up = one_design(self.least(judge.motion))
        if low.value < make_up - EMPTY * max(abs(float(high.value)), 1.0):
            text = said(
                "{says}: below {make_up} it runs empty there, and does not keep the length that it gives.",
                says=says, make_up=show(make_up, "bar", 4),
            )  # fmt: skip
            return [Verdict("line", False, text, answer=low), *shut]
        if low.value == high.value == 0.0:  # nothing presses on it, so there is nothing to say
            return shut
        return [*(self._relieved(judge) or [Verdict("line", True, f"{says}.", answer=low)]), *shut]

    def pressure_request(self, plan: Declared) -> LawRequest:
        """Return the request for its pressure, in all load cases and in the directions of its first cylinder [Pa gauge].

        Parameters
        ----------
        plan : Plan
            The plan of the machine's class.

        Returns
        -------
        Request
            The pressure [Pa gauge].
        """
        return LawRequest(
            formula=self.line_pressure, text=f"{self.name}.pressure", known=("line pressure", self.name), acting=Acting(),
            measures="pressure", mover=self.members(plan.members)[0].name or None,
        )  # fmt: skip

    def _relieved(self, judge: Judge) -> list[Verdict]:
        """Return the verdict that its relief valve opens, where it does."""
        if not self.relieves(judge.plan):
            return []
        if self.is_drained and one_design(self.number(judge.motion, "back_pressure")) <= one_design(self.number(judge.motion, "relief")):
            return []  # what it holds where it is shut is told there
        limit, high = one_design(self.number(judge.motion, "relief")), judge.answer(most(self.pressure_request(judge.plan)))
        if not high.value > limit:
            return []
        text = said(
            "its pressure comes to {high} {where}, and its relief valve opens at {limit}.",
            high=show(high.value, "bar", 4, limit), where=high.where, limit=show(limit, "bar", 4),
        )  # fmt: skip
        return [Verdict("line", False, text, answer=high)]

    def formulas(self, written: Formulas) -> None:
        """Write the pressure of the line and the thrusts of its cylinders, as far as no other lines give them.

        Parameters
        ----------
        written : Formulas
            The sheet of equations.
        """
        kind = self.kind_in(written.plan.members)
        if kind == "held":
            PumpLine.formulas(self, written)
        elif kind == "closed" or self.block is None:
            written.given(f"p_{self.name}", self.line_pressure, "bar")
        else:
            GasLine.formulas(self, written)


USUAL: Mapping[str, float] = MappingProxyType({"oil": 0.0, "make_up": 0.0, "seal_friction": 0.0, "exponent": 1.0})


CHAMBERS: Mapping[str, Side] = MappingProxyType({"piston_side": PISTON, "rod_side": ROD})
"""The sides of a cylinder by the names of their chambers."""


def put_in_later(members: NamedMembers) -> tuple[str, ...]:
    """Return the inputs of the oil of closed lines, which have nothing of it where they are filled."""
    lines = [each for each in of_kind(members, OilLine).values() if each.kind_in(members) == "closed"]
    return tuple(each.cut for each in lines if not isinstance(members.get(each.cut), Stroke))


def on_line_text(each: object) -> str:
    """Return a part of a line as it is written."""
    if isinstance(each, (Chamber, AccumulatorBlock)):
        return str(each)
    return label(each) if is_member_or_name(each) else getattr(each, "__name__", "block")


def own_side(line: OilLine, ram: Ram, members: NamedMembers) -> Side:
    """Return the side of a cylinder that a line has."""
    return next(chamber.side for each, chamber in line.filling(members) if same(each, ram))
