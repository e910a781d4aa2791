"""A telescope: stages that slide out of one another, pushed out by oil alone. Every pressure in this file is gauge [Pa].

    length - closed         the stage that moves         pressure
    0 to s_1                1, the largest area          T / A_1
    s_1 to s_1 + s_2        2                            T / A_2
    ...

The largest area comes out first and goes in last. The oil is the integral of the area over the length. At a border of two stages the
next one moves while it extends, the one before while it retracts. At rest the smaller area counts, which asks for the higher pressure.

    >>> from linkage.units import kN, bar, mm
    >>> hoist = Telescope("A", "B", bores=[145 * mm, 125 * mm], strokes=[1.0, 0.9], closed=1.3)
    >>> print(f"{[float(f'{40 * kN / each.push_area / bar:.2f}') for each in hoist.sizes]} bar at 40 kN")
    [24.22, 32.59] bar at 40 kN
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce
from itertools import accumulate, pairwise
from operator import add
from types import MappingProxyType
from typing import Any, ClassVar, cast

import numpy as np

from linkage.errors import DefinitionError, cited, ensure
from linkage.frozen import immutable, keep_own
from linkage.language import noted, said
from linkage.loads import Case, Glyph, Parameter, Poses
from linkage.loads.element import Formulas, value_text
from linkage.motion import Column, Condition, Judge, Motion
from linkage.quantities import NamedMembers, Quantity, Reference, quantity
from linkage.statics import is_among
from linkage.units import mm, require_measure, show, shown_number
from linkage.verdict import Verdict

from .buckling import Buckling
from .cylinders import LENGTHS, PISTON, TOLERANCE, Ram, Side, circuits_among
from .inputs import Array, follows, in_metres, number_set, one_design, one_number, positive, stroke_in_metres
from .remedy import show_enough
from .standard_sizes import MOST, RamSize, Works, chosen_series

STAGES = 12
"""More moving stages than any telescope has."""


@immutable
class StageSize(RamSize):
    """The bore of the stage that moves [m], one number or an array over the poses; `count` telescopes side by side."""

    bore: float | Array
    count: int = 1
    works: Works = "piston"

    @property
    def push_area(self) -> float | Array:
        return self.count * (np.pi / 4.0 * self.bore**2)

    @property
    def pull_area(self) -> float | Array:
        return 0.0 * self.push_area


@immutable
class Telescope(Ram):
    """Equal telescopes side by side: `hoist = Telescope(A, B, bores=[145 * mm, 125 * mm], strokes=[1.0, 0.9], closed=1.3)`.

    It is single acting: it pushes, and where the load pulls at it no oil holds it. What buckles is the thinnest stage that is out. In a
    class its numbers are the design variables `hoist.bore_1`, `hoist.stroke_1`, ..., `hoist.closed`.

    Parameters
    ----------
    A, B : Point or str
        The pins of the barrel and of the last stage.
    bores : sequence of float or quantity
        The diameters [m] on which the oil pushes the moving stages, the outermost first, and fall.
    strokes : sequence of float or quantity
        How far each stage comes out of the one before [m].
    closed : float or quantity
        The distance of the pins drawn in [m].
    count : int, optional
        How many telescopes there are, 1 by default.
    mounting : str, optional
        How its ends are held against buckling, "pin-pin" by default.
    safety : float, optional
        The factor asked for against buckling, 3.5 by default.

    Raises
    ------
    DefinitionError
        Bores do not fall, there are not as many strokes as bores, or a size is not above zero.
    """

    A: Reference
    B: Reference
    bores: Sequence[Parameter]
    strokes: Sequence[Parameter]
    closed: Parameter
    count: int = 1
    mounting: str = "pin-pin"
    safety: float = 3.5
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType(
        {f"{what}_{stage}": "mm" for what in ("bore", "stroke") for stage in range(1, STAGES + 1)} | {"closed": "mm"}
    )
    not_negative: ClassVar[frozenset[str]] = frozenset(parameters)
    optional: ClassVar[frozenset[str]] = frozenset(parameters) - {"closed"}
    argument_kinds: ClassVar[Mapping[str, Any]] = MappingProxyType({"bores": "lengths", "strokes": "lengths"})
    inside: ClassVar[Mapping[str, str]] = MappingProxyType({"length": "quantity", "piston_side": "chamber"})
    own_sides: ClassVar[tuple[Side, ...]] = (PISTON,)

    def __post_init__(self) -> None:
        keep_own(self)
        for name in ("bores", "strokes"):
            given = getattr(self, name)
            if not isinstance(given, tuple) or not given:
                raise DefinitionError(f"Telescope: {name}={cited(given)}: a list is expected, one a stage, {name}=[0.145, 0.125].")
            for each in given:
                require_measure(each, "mm", f"Telescope: {name}")
            ensure(len(given) <= STAGES, f"Telescope: {len(given)} {name}: at most {STAGES} stages are known; give one a moving stage.")
        what = f"Telescope: {len(self.bores)} bores and {len(self.strokes)} strokes"
        ensure(len(self.bores) == len(self.strokes), f"{what}; give each moving stage one of both, the outermost first.")
        super().__post_init__()
        many = one_number(self.count, "Count of telescopes", "number")
        ensure(1.0 <= many <= MOST and many == int(many), f"Count of telescopes = {cited(self.count)}; give a whole number from 1 on.")
        Buckling(1.0, self.mounting, self.safety)
        for number, bore in enumerate(self.bores, 1):
            if not follows(bore):
                positive(in_metres(cast(Array, bore), f"Bore of stage {number}"), f"Bore of stage {number}")
        if not follows(*self.bores):
            check_falling(cast("Sequence[Array]", self.bores), "Telescope")
        for name in ("closed", *(f"stroke_{number}" for number in range(1, self.stages + 1))):
            if not follows(self.given(name)):
                stroke_in_metres(self.given(name), self._called(name))

    def given(self, name: str) -> Any:
        what, _, number = name.partition("_")
        if not number:
            return getattr(self, name)
        each = self.bores if what == "bore" else self.strokes
        return each[int(number) - 1] if int(number) <= len(each) else None

    def having(self, values: Mapping[str, float]) -> Telescope:
        found = {name: values.get(f"{self.name}.{name}", self.given(name)) for name in self.numbers}
        stages = range(1, self.stages + 1)
        bores, strokes = (tuple(found[f"{what}_{stage}"] for stage in stages) for what in ("bore", "stroke"))
        return self.renewed(bores=bores, strokes=strokes, closed=found["closed"])

    def words(self) -> list[str]:
        lists = {name: f"[{', '.join(value_text(each) for each in getattr(self, name))}]" for name in ("bores", "strokes")}
        more = {name: repr(value) for name, value in self.options().items()}
        return [f"{name}={text}" for name, text in (lists | {"closed": value_text(self.closed)} | more).items()]

    def glyphs(self, members: NamedMembers) -> tuple[Glyph, ...]:
        return (Glyph(self.drawn_as, self.ends, stages=self.ends_of_stages),)

    def _called(self, name: str) -> str:
        return LENGTHS["closed"].replace("cylinder", "telescope") if name == "closed" else f"Stroke of stage {name.partition('_')[2]}"

    # -- its stages ----------------------------------------------------------------------------------------

    @property
    def stages(self) -> int:
        return len(self.bores)

    @property
    def side(self) -> Works:
        return PISTON

    @property
    def sizes(self) -> tuple[StageSize, ...]:
        """The sizes of its stages as they are written here; DefinitionError where a bore follows something else."""
        if follows(*self.bores):
            raise DefinitionError(f"{self}: its bores follow the design; ask for sizes_in(motion).")
        return tuple(StageSize(cast("float | Array", each), self.count) for each in self.bores)

    def sizes_in(self, motion: Poses) -> tuple[StageSize, ...]:
        """Return the sizes of its stages as a motion's designs have them; DefinitionError for bores that do not fall.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.

        Returns
        -------
        tuple of StageSize
            The sizes.

        Raises
        ------
        DefinitionError
            Bores that do not fall.
        """
        bores = [number_set(self, motion, f"bore_{stage}") for stage in range(1, self.stages + 1)]
        for stage, bore in enumerate(bores, 1):
            positive(in_metres(bore, f"Bore of stage {stage}"), f"Bore of stage {stage}")
        check_falling(bores, self.name or "Telescope")
        return tuple(StageSize(bore[()], self.count) for bore in bores)

    def ends_of_stages(self, motion: Poses) -> list[Array]:
        """Return its closed length and the lengths at which its stages are out [m], one after another; they broadcast.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.

        Returns
        -------
        list of ndarray
            The lengths [m].
        """
        names = ("closed", *(f"stroke_{stage}" for stage in range(1, self.stages + 1)))
        return list(accumulate(stroke_in_metres(number_set(self, motion, name), self._called(name)) for name in names))

    def stage(self, motion: Poses, direction: str | None = None) -> Array:
        """Return the number of the stage that moves at each pose, 1 for the outermost, shape (...).

        At a border it is the next one while it is "extending" and at rest, the one before while it is "retracting".

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        direction : str, optional
            "extending" while the stroke grows, "retracting", or "frictionless".

        Returns
        -------
        ndarray
            The numbers.
        """
        return self.of_stage(motion, [np.asarray(float(number)) for number in range(1, self.stages + 1)], direction)

    def of_stage(self, motion: Poses, each: Sequence[Any], direction: str | None = None) -> Array:
        """Return which of some values, one a stage, is that of the stage that moves at each pose.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        each : sequence
            One value a stage.
        direction : str, optional
            "extending" while the stroke grows, "retracting", or "frictionless".

        Returns
        -------
        ndarray
            The values, shape (...).
        """
        if self.stages == 1:
            return cast(Array, each[0])
        found = each[0]
        for border, value in zip(self.ends_of_stages(motion)[1:-1], each[1:], strict=True):
            found = np.where(self.is_past(motion, border, direction), value, found)
        return cast(Array, found)

    def is_in_stage(self, motion: Poses, stage: int, direction: str | None = None) -> Any:
        length, ends = motion.distance(self.A, self.B), self.ends_of_stages(motion)
        within = length >= 0.0
        within = within if stage == 1 else within & self.is_past(motion, ends[stage - 1], direction)
        return within if stage == self.stages else within & ~self.is_past(motion, ends[stage], direction)

    def is_past(self, motion: Poses, border: Array, direction: str | None) -> Any:
        """Return where it moves with the stage beyond a border: at the border itself unless it is retracting.

        Beside other cylinders on its line it is at the border as at rest: the shares of one pressure know no direction.

        Parameters
        ----------
        motion : Motion
            The poses.
        border : array
            The length at which the stage ends [m].
        direction : str, optional
            The direction of motion.

        Returns
        -------
        array of bool
            Where it is past the border.
        """
        length, members = motion.distance(self.A, self.B), motion.plan.members
        lines = (line.members(members) for line in circuits_among(members))
        if direction == "retracting" and not any(len(line) > 1 and is_among(self, line) for line in lines):
            return length > border + TOLERANCE
        return length >= border - TOLERANCE

    def sized(self, motion: Poses, direction: str | None = None) -> StageSize:
        """Return the size of the stage that moves, to broadcast against a motion.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        direction : str, optional
            "extending" while the stroke grows, "retracting", or "frictionless".

        Returns
        -------
        StageSize
            The size.
        """
        return StageSize(self.of_stage(motion, [each.bore for each in self.sizes_in(motion)], direction), self.count)

    def thickness(self, motion: Poses, direction: str | None = None) -> float | Array:
        return self.sized(motion, direction).bore

    def filled(self, side: Side, motion: Poses, start: Array, end: Array) -> Array:
        ends = self.ends_of_stages(motion)
        parts = [size.push_area * (in_part(end, ends, k) - in_part(start, ends, k)) for k, size in enumerate(self.sizes_in(motion))]
        return np.asarray(reduce(np.add, parts))[()]

    def _written(self) -> tuple[list[Quantity], list[Quantity]]:
        """Return the squares of its bores, times the count, and the lengths at which its stages end, as quantities of its class."""
        stages = range(1, self.stages + 1)
        squares = [self.written(f"bore_{stage}") ** 2 for stage in stages]
        ends = accumulate(self.written(name) for name in ("closed", *(f"stroke_{stage}" for stage in stages)))
        return [each if self.count == 1 else each * float(self.count) for each in squares], list(ends)

    def filled_written(self, side: Side, start: Quantity, end: Quantity) -> Quantity:
        squares, ends = self._written()
        parts: list[Quantity] = [square * (in_part(end, ends, k) - in_part(start, ends, k)) for k, square in enumerate(squares)]
        return reduce(add, parts)

    def length_written(self, sides: Sequence[Side], start: Quantity, oil: Quantity) -> Quantity:
        squares, ends = self._written()
        held = oil + self.filled_written(PISTON, ends[0], start)
        rooms = [square * (high - low) for square, (low, high) in zip(squares, pairwise(ends), strict=True)]
        full = list(accumulate([quantity(0.0), *rooms]))
        out: list[Quantity] = [(in_part(held, full, k) - full[k]) / square for k, square in enumerate(squares)]
        return reduce(add, out, ends[0])

    # -- its lengths -----------------------------------------------------------------------------------------

    def length_set(self, name: str, motion: Poses, *, beside_bore: bool = False) -> Array:
        ends = self.ends_of_stages(motion)
        return ends[0] if name == "closed" else ends[-1] - ends[0]

    # -- what it says ------------------------------------------------------------------------------------------

    def columns_in(self, motion: Motion, case: Case = None, direction: str | None = None) -> list[Column]:
        stage = np.where(motion.reached, self.stage(motion, direction), np.nan)
        return [*super().columns_in(motion, case, direction), Column(noted("stage"), stage, "", 0)]

    def conditions(self, judge: Judge) -> Mapping[str, Condition]:
        """Return that it fits, that its thinnest stage does not buckle, and that nothing pulls at it where no pump line says so.

        Parameters
        ----------
        judge : Judge
            The judge of the machine over its domains.

        Returns
        -------
        mapping of str to Condition
            The conditions by their rules.
        """
        found = dict(super().conditions(judge))
        return found | ({"holding": self.pressed(self.name, judge)} if self._is_alone(judge) else {})

    def size_verdicts(self, judge: Judge) -> list[Verdict]:
        if not self._is_alone(judge):
            return []
        found = judge.answer(self.pressed(self, judge))
        if np.isnan(found.value):
            return []
        pulled = self.pulled(judge)
        text = said("the load presses on it everywhere, the least {where}.", where=found.place)
        return [Verdict("holding", True, text, answer=found) if pulled is None else pulled]

    def slender_part(self, motion: Poses, direction: str | None = None) -> tuple[str, int, Sequence[float]]:
        stage = int(self.stage(motion, direction))
        return f"bore_{stage}", stage, chosen_series().rods

    def _reaches(self, judge: Judge, low: float, high: float, closed: float, opened: float) -> Verdict:
        ends = [one_number(np.squeeze(each), "Length") for each in self.ends_of_stages(judge.motion)]
        says = said(
            "{pins} goes from {low} to {high}, the telescope is {closed} long closed and {opened} open, in stages of {strokes}",
            pins=self._pins, low=shown_number(low, "mm", ".1f"), high=show(high, "mm", ".1f"), closed=shown_number(closed, "mm", ".1f"),
            opened=show(opened, "mm", ".1f"), strokes=" + ".join(shown_number(b - a, "mm", ".0f") for a, b in pairwise(ends)),
        )  # fmt: skip
        faults, fitting = self._too_long(low, closed)
        if high - (fitting + opened - closed) > TOLERANCE:
            missing = show_enough(high - (fitting + opened - closed) - TOLERANCE, "mm", ".1f")
            faults.append(said("{missing} are missing open: take longer strokes or one more stage", missing=missing))
        for stage, (start, end) in enumerate(pairwise(ends), 1):
            if end - start > closed:
                stroke = show(end - start, "mm", ".1f")
                faults.append(said("stage {stage} cannot come out by {stroke}, more than it is long closed", stage=stage, stroke=stroke))
        return Verdict("length", not faults, f"{'; '.join([says, *faults])}.")

    def sides_written(self, written: Formulas, thrust: Array) -> tuple[Array, Array]:
        """Write the areas of its stages, and return the symbol of that which moves with no area on another side [m2].

        Parameters
        ----------
        written : Formulas
            The sheet of equations.
        thrust : symbol
            The thrust [N].

        Returns
        -------
        tuple of symbol
            The areas [m2].
        """
        areas = [self.count * written.pi / 4.0 * self.number(written, f"bore_{stage}") ** 2 for stage in range(1, self.stages + 1)]
        if self.stages == 1:
            return written.line(f"A_{self.name}", areas[0], "m2"), np.zeros(())
        named = [written.line(f"A_{self.name}_{stage}", area, "m2") for stage, area in enumerate(areas, 1)]
        steps = [self.number(written, name) for name in ("closed", *(f"stroke_{stage}" for stage in range(1, self.stages)))]
        length, found = written.distance(self.A, self.B), named[0]
        for border, area in zip(list(accumulate(steps))[1:], named[1:], strict=True):
            found = np.where(length >= border, area, found)
        return written.line(f"A_{self.name}", found, "m2"), np.zeros(())


def in_part(whole: Any, ends: Sequence[Any], stage: int) -> Any:
    """Return a length, or an amount of oil, as far as it lies in a stage, by its number from 0. The outer stages have no outer ends."""
    above = whole if stage == 0 else np.maximum(whole, ends[stage])
    return above if stage == len(ends) - 2 else np.minimum(above, ends[stage + 1])


def check_falling(bores: Sequence[Any], what: str) -> None:
    """Raise DefinitionError for bores of stages [m] that do not fall from the outermost one."""
    for stage, (wide, thin) in enumerate(pairwise(bores), 2):
        if np.any(np.greater_equal(thin, wide)):
            inner, outer = (one_design(each) / mm for each in (thin, wide))
            says = f"{what}: the bore of stage {stage}, {inner:.6g} mm, is not smaller than that of stage {stage - 1}, {outer:.6g} mm"
            raise DefinitionError(f"{says}, in which it slides; let bores= fall from the outermost stage.")
