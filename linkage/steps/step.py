"""A construction step: it places one point from points and quantities already known."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import replace
from math import pi
from types import MappingProxyType
from typing import ClassVar, NamedTuple, Self, TypeAlias

import numpy as np
import numpy.typing as npt

from ..errors import DefinitionError, cited, did_you_mean, ensure, two_of
from ..frozen import record
from ..quantities import Jointed, Member, Number, Operand, Quantity, Reference, Where, is_number, joined_names, label, name_of, quantity
from ..quantities.quantity import source_text
from ..units import deg, require_measure
from ..vectors import Scalar, Side, Vec
from .labels import DimensionTable, Slot, Spoken, match, relabelled, written_labels


class Unbound(Number):
    """The place of a dimension that a step has not been given. It takes no name from the classes it stands in."""

    def __set_name__(self, owner: type, name: str) -> None:
        """Stay unnamed."""


UNBOUND = Unbound(float("nan"))

Position: TypeAlias = Sequence[float] | npt.NDArray[np.float64]
"""A place in a sketch or a drawing, (x, y) [m]."""

TURN = 2.0 * pi * (1.0 + 1e-9)


@record
class Bar:
    """Two points at a distance: a link, or a cylinder where the length follows a stroke."""

    P: str
    Q: str
    length: Quantity


class Contour(NamedTuple):
    """A closed line that is drawn and moves with the points P and Q: its corners along P -> Q and to its left from P, shape (2, n) [m]."""

    P: str
    Q: str
    corners: npt.NDArray[np.float64]


class Assignment(NamedTuple):
    """A name given to a primitive of the vector method, `OAB = CosineAngle(...)`; to a quantity, it is the label of a length."""

    name: str
    value: Member


class Point(Jointed):
    """A named point of the mechanism.

    A step of one's own says `parts`, `place` and `joints`; all the rest has a default that serves.
    """

    X: str = ""
    """Its name once it is bound, in a class or in a group."""
    drawn_at: tuple[float, float] | None = None
    """Its place in the drawing [m]; None where the drawing does not say."""
    closes: ClassVar[bool] = False
    """Whether placing this point closes a loop, so that it can fail and become singular."""

    kind = "point"
    file_section = "points"

    @abstractmethod
    def place(self, where: Where) -> Vec:
        """Return the position [m]; NaN where it cannot be assembled.

        Parameters
        ----------
        where : Where
            The reading: places of points and values of quantities.

        Returns
        -------
        Vec
            The position [m].
        """
        raise DefinitionError(f"{self.name}: {type(self).__name__} does not say where its point lies; give it place(where).")

    def __str__(self) -> str:
        """Return the line that makes this step; one with arguments that are no parts says it itself."""
        return f"{type(self).__name__}({', '.join(map(label, self.parts()))})"

    def constraints(self, where: Where) -> tuple[Scalar, ...]:
        """Return the residuals that vanish at this point's place, in every reading: place minus rule, unless a step overrides it.

        A point that closes a loop says the equations whose root `place` chooses; a free construction says none.

        Parameters
        ----------
        where : Where
            The reading: places of points and values of quantities.

        Returns
        -------
        tuple of float or array
            The residuals [m].
        """
        if self.is_fixed:
            return ()
        miss = where.at(self.X or self.name) - self.place(where)
        return miss.x, miss.y

    def expansion(self) -> tuple[Assignment, ...]:
        """Return the primitives that this step stands for, in the vector method's order; empty where its own rule is written out.

        Returns
        -------
        tuple of Assignment
            The primitives by their names.
        """
        return ()

    @property
    def hangs_from(self) -> str:
        """The point that a construction alone leads from, drawn as a thin line where no body joins them; empty where others hold it."""
        return ""

    @property
    def sense(self) -> float:
        """The determinant of the constraints' Jacobian over the root or the sine that `place` asks for; 0 where nobody knows."""
        return 0.0

    def bars(self) -> tuple[Bar, ...]:
        """Return the links of two points that this step brings.

        Returns
        -------
        tuple of Bar
            The links.
        """
        return ()

    def bodies(self) -> tuple[tuple[str, ...], ...]:
        """Return the points this step makes rigid with each other.

        Returns
        -------
        tuple of tuple of str
            The names of the points, body by body.
        """
        return ()

    def meeting(self, where: Where) -> tuple[Vec, ...]:
        """Return the two directions whose angle is the transmission angle of this joint; empty where it has none.

        Parameters
        ----------
        where : Where
            The reading: places of points and values of quantities.

        Returns
        -------
        tuple of Vec
            The directions.
        """
        return ()

    def modes(self) -> tuple[Side, ...]:
        """Return the assembly modes a side chooses from; empty where there is only one.

        Returns
        -------
        tuple of Side
            The modes.
        """
        return ()

    def shortage(self, where: Where) -> tuple[str, Scalar]:
        """Return which length is too short to place this point, in words, and by how much [m].

        Parameters
        ----------
        where : Where
            The reading: places of points and values of quantities.

        Returns
        -------
        tuple of str and float or array
            The length in words, and what is missing [m].
        """
        return "its point lies nowhere", float("nan")

    def outline(self, where: Where) -> tuple[Contour, ...]:
        """Return the contours drawn of this step beside bodies, guides and pins."""
        return ()


class Step(Point):
    """A step that hangs a point X from parents by labelled lengths and angles.

    After binding, `X` and the parents are names and every slot holds a quantity.
    """

    parents: tuple[Reference, ...]
    spoken: Spoken | None = None
    """How its labels are spoken, where it is of a part."""
    parent_letters: tuple[str, ...] = ("P", "Q")
    argument_kinds = MappingProxyType({"side": "side", "near": "place", "at": "place"})
    further: ClassVar[tuple[str, ...]] = ()
    """Its attributes beside parents and labels that it is built from."""
    arms: tuple[str, ...] = ()
    """The letters of the parents that X hangs from by a link of its own: for P it has the length PX."""
    from_drawing: str = ""
    """What `at=(x, y)` supplies: the `distances` from both parents, one distance and the `angle`, or one and the `turn` of a drive."""
    orientation: ClassVar[float] = 0.0
    """Its `sense` on the left side, or where it has no side; 0 where nobody knows."""
    chooses: str = ""
    """Why a side must be said, in words; "" where there is one place only."""

    def __init__(
        self, *parents: Reference, labels: Mapping[str, Operand], side: Side | str | None = None,
        near: Position | None = None, at: Position | None = None,
    ) -> None:
        self.parents = parents
        self.labels = dict(labels)
        self.side = None if side is None else Side.parse(side)
        hint = did_you_mean(str(side).upper(), [*Side.__members__]) if self.side is None else ""
        ensure(side is None or self.side is not None, f"{type(self).__name__}: side={cited(side)}; say side=LEFT or side=RIGHT.{hint}")
        self.near = position(near, f"{type(self).__name__}(near=...)")
        self.drawn_at = position(at, f"{type(self).__name__}(at=...)")

    @property
    def sense(self) -> float:
        return self.orientation * (float(self.settled_side) if self.orientation and self.chooses else 1.0)

    def fitting(self) -> tuple[Slot, ...]:
        """Return its slots as their labels are spoken."""
        return tuple(replace(slot, spoken=self.spoken) for slot in self.slots()) if self.spoken else self.slots()

    def word(self, *points: str) -> str:
        """Return the label of points as it is spoken: `upper.AO` in a part, whatever its O is fused with."""
        return joined_names(*points) if self.spoken is None else self.spoken.word(*points)

    def slots(self) -> tuple[Slot, ...]:
        """Return the labels this step takes; the step knows its points' names by now.

        Returns
        -------
        tuple of Slot
            The labels.
        """
        return tuple(Slot(f"{letter}X", (getattr(self, letter), self.X)) for letter in self.arms)

    def bars(self) -> tuple[Bar, ...]:
        return tuple(Bar(getattr(self, letter), self.X, getattr(self, f"{letter}X")) for letter in self.arms)

    def check(self) -> None:
        """Raise DefinitionError where something this step needs is missing or too much."""
        if self.drawn_at is not None:
            return
        for slot in self.slots():
            if getattr(self, slot.attribute) is UNBOUND:
                raise self.missing(slot)
        if self.chooses and self.side is None and self.near is None:
            raise self.needs_side(self.chooses)

    def modes(self) -> tuple[Side, ...]:
        return (Side.LEFT, Side.RIGHT) if self.chooses else ()

    def parts(self) -> tuple[Reference, ...]:
        labels = (part for part in map(quantity, self.labels.values()) if not part.is_constant)
        return (*self.parents, *labels, *(getattr(self, attribute) for attribute in self.further))

    def bind(self, X: str, table: DimensionTable) -> Self:
        bound = copy(self)
        bound.X = X
        for letter, parent in zip(self.parent_letters, self.parents, strict=True):
            setattr(bound, letter, name_of(parent))
        names = [X, *(getattr(bound, letter) for letter in self.parent_letters)]
        if len(set(names)) < len(names):
            raise DefinitionError(f"{bound.sentence()}: the points {', '.join(names)} must be different.")
        for attribute, (slot, spelling, sign, value) in match(self.labels, bound.fitting(), bound.sentence()).items():
            given, forward = quantity(value), next(iter(slot.spellings))
            is_negative = given.constant is not None and given.constant < 0.0
            if slot.kind == "angle" and self.side is not None and (sign < 0 or is_negative):  # the side would turn it once more
                why = f"{spelling} is counted from the other ray, which is -{forward}" if sign < 0 else f"{spelling} is negative"
                remedy = f"write {forward}= with a positive angle, or leave the side out"
                raise DefinitionError(f"{bound.sentence()}: {why}, but side={self.side} gives the sense; {remedy}.")
            found = table.dimension(slot, spelling, value, bound.sentence())
            setattr(bound, attribute, found if sign > 0 else -found)
        bound.check()
        return bound

    def having(self, values: Mapping[str, float]) -> Self:
        return self.renewed(labels=relabelled(self.labels, values))

    def missing(self, slot: Slot) -> DefinitionError:
        """Return the error for a label that must be given."""
        example = next(iter(slot.spellings)) + ("=0.3 (m)" if slot.kind == "length" else "=30 * deg")
        return DefinitionError(f"{self.sentence()}: the {slot.kind} {'/'.join(slot.spellings)} is missing; give {example}.")

    def needs_side(self, why: str) -> DefinitionError:
        """Return the error for a step that can be assembled in two ways and does not say which."""
        return DefinitionError(f"{self.sentence()}: {why}; say side=LEFT, side=RIGHT, or near=(x, y).")

    @property
    def settled_side(self) -> Side:
        """The side; DefinitionError where a sketch position has not been turned into one."""
        if self.side is None:
            raise DefinitionError(f"{self.sentence()}: its side is not settled.")
        return self.side

    def sentence(self) -> str:
        """Return the step's opening words: `B = Dyad(A, O)`."""
        return f"{self.X or self.name or '?'} = {type(self).__name__}({', '.join(map(label, self.parents))})"

    def arguments(self) -> list[str]:
        """Return the arguments as they would be written.

        Returns
        -------
        list of str
            The arguments.
        """
        words = [*map(label, self.parents)]
        words += written_labels(self.labels, self.fitting() if self.X else ())
        if self.side is not None:
            words.append(f"side={self.side}")
        if self.near is not None:
            words.append(f"near=({self.near[0]!r}, {self.near[1]!r})")
        given = ((name, getattr(self, name), "angle" if name in self.radians else "") for name in self.further)
        return words + [f"{name}={source_text(value, 0, kind)}" for name, value, kind in given if kind or value.constant != 0.0]

    def __str__(self) -> str:
        return f"{type(self).__name__}({', '.join(self.arguments())})"

    __repr__ = __str__


class FromTwo(Step):
    """The base of steps that hang a point from two others, P and Q, by its distances from them."""

    P: str
    Q: str
    PX: Quantity = UNBOUND
    QX: Quantity = UNBOUND

    def __init__(
        self, P: Reference, Q: Reference, *, side: Side | str | None = None,
        near: Position | None = None, at: Position | None = None, **labels: Operand,
    ) -> None:
        super().__init__(P, Q, labels=labels, side=side, near=near, at=at)

    @abstractmethod
    def sides(self, where: Where) -> tuple[tuple[str, Scalar], ...]:
        """Return the sides of its triangle, as labelled lengths [m]; none where it has no third one."""

    def triangle_sides(self, where: Where, base: Scalar) -> tuple[tuple[str, Scalar], ...]:
        """Return the sides of the triangle P Q X, as labelled lengths [m]; `base` is that of P Q."""
        names = self.word(self.P, self.Q), self.word(self.P, self.X), self.word(self.Q, self.X)
        return tuple(zip(names, (base, where.value(self.PX), where.value(self.QX)), strict=True))


def angle_given(given: Operand, what: str) -> Quantity:
    """Return an angle as a quantity; DefinitionError for a number of more than a full turn, which was given in degrees."""
    found = quantity(given)
    if found.constant is not None and abs(found.constant) > TURN:
        said = f"the angle {found.constant:.6g} rad ({found.constant / deg:.6g} deg) is more than a full turn"
        raise DefinitionError(f"{what}: {said}; write {found.constant:.6g} * deg if these are degrees, or take whole turns off.")
    return found


def position(value: Position | None, what: str) -> tuple[float, float] | None:
    """Return a sketch position as two floats; raise DefinitionError unless it is a pair of finite numbers."""
    if value is None:
        return None
    pair = two_of(value)
    if not pair or not all(map(is_number, pair)):
        is_real = [isinstance(part, (int, float, np.integer, np.floating)) and not isinstance(part, bool) for part in pair]
        fault = "is not a finite position" if pair and all(is_real) else "is not a position; write (x, y) in m"
        raise DefinitionError(f"{what}: {cited(value)} {fault}.")
    require_measure(pair, "length", what)
    return float(pair[0]), float(pair[1])


