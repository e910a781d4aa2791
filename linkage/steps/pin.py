"""Pins of a parts list: points whose place the framework works out from the links they join."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ..errors import DefinitionError, ensure, require
from ..quantities import Member, Quantity, Reference, Stroke, Where, joined_names, name_of, of_kind, quantity
from ..units import require_number
from ..vectors import Scalar, Vec
from .guide import Guide, Slide
from .labels import DimensionTable, Slot, Spoken
from .onlink import OnLink
from .step import Bar, Point, Position, position


class Pin(Point):
    """A point that links meet in: `B = Pin(near=(0.3, 0.2))`.

    A pin that no dyad places belongs to a group, whose pins are found together.

    Parameters
    ----------
    *place : object
        None: a place needs its keyword, and this is what the error says.
    near : tuple of float, optional
        Its place (x, y) in a sketch [m], which chooses the assembly mode.
    at : tuple of float, optional
        Its place (x, y) in a drawing [m]: lengths and angles that are not given are measured from it.

    Raises
    ------
    DefinitionError
        There is no place, or there are two.
    """

    closes = True
    argument_kinds = MappingProxyType({"near": "place", "at": "place"})

    def __init__(self, *place: object, near: Position | None = None, at: Position | None = None) -> None:
        self.near, self.drawn_at = position(near, "Pin(near=...)"), position(at, "Pin(at=...)")
        ensure(not place, f"Pin({', '.join(map(repr, place))}): say near=(x, y) for a place in a sketch or at=(x, y) in a drawing.")
        ensure((near is None) != (at is None), "Pin: give its place, near=(x, y) in a sketch or at=(x, y) in a drawing.")
        self.group: Group | None = None

    @property
    def sketched(self) -> tuple[float, float]:
        """Its place in the sketch or the drawing [m]."""
        place = self.near or self.drawn_at
        assert place is not None
        return place

    def parts(self) -> tuple[Reference, ...]:
        return () if self.group is None else (self.group,)

    def place(self, where: Where) -> Vec:
        if self.group is None:
            raise DefinitionError(f"{self.name} = {self}: no link and no guide holds this pin; say Link(...) or Slide(...) with it.")
        where.margin(where.input(f"{self.group.name}.sine"))
        return Vec(where.input(f"{self.name}.x"), where.input(f"{self.name}.y"))

    def constraints(self, where: Where) -> tuple[Scalar, ...]:
        return () if self.group is None else self.group.constraints(where)

    def shortage(self, where: Where) -> tuple[str, Scalar]:
        pins = " ".join(self.companions)
        return f"the pins {pins} are found together and come to a dead point on the way from the sketch", float("nan")

    @property
    def companions(self) -> tuple[str, ...]:
        return () if self.group is None else self.group.pins

    def __str__(self) -> str:
        word, (x, y) = ("near" if self.near else "at"), self.sketched
        return f"Pin({word}=({x!r}, {y!r}))"


class Group(Member):
    """Pins that no construction places one by one: an Assur group of class III or higher, solved by Newton's method.

    The framework finds the groups of a parts list itself. Their equations are the lengths of rods, the shapes of rigid links, and slides.

    Parameters
    ----------
    pins : str
        The names of its pins, `Group("D E F")`.

    Notes
    -----
    Source: Artobolevsky, groups of class III and IV.
    """

    argument_kinds = MappingProxyType({"pins": "points"})
    spoken: Spoken | None = None
    """How its labels are spoken, where it is of a part."""

    def __init__(self, pins: str) -> None:
        expected = 'the names of its pins are expected in one text, Group("D E F")'
        require(isinstance(pins, str) and pins.split(), "Group(pins", pins, expected)
        self.pins = tuple(pins.split())
        self.given: tuple[tuple[str, str, Quantity], ...] = ()
        self.attached: tuple[tuple[str, OnLink], ...] = ()
        self.slides: tuple[Slide, ...] = ()
        self.rods: tuple[Bar, ...] = ()
        self.rigid: tuple[OnLink, ...] = ()

    def enter(self, table: DimensionTable) -> None:
        """Enter the group's dimensions: its rods' lengths and its links' shapes.

        Parameters
        ----------
        table : Table
            The table of dimensions.
        """
        spoken = joined_names if self.spoken is None else self.spoken.word
        self.rods = tuple(
            Bar(P, Q, table.dimension(Slot("", (P, Q), self.spoken), spoken(P, Q), length, str(self))) for P, Q, length in self.given
        )
        self.rigid = tuple(step.bind(X, table) for X, step in self.attached)

    @property
    def inputs(self) -> tuple[str, ...]:
        """The names of its solution's inputs: coordinates [m], and the sine that tells how near it is to a singular pose."""
        return (*(f"{pin}.{axis}" for pin in self.pins for axis in "xy"), f"{self.name}.sine")

    def in_radians(self) -> tuple[Quantity, ...]:
        return tuple(angle for step in self.rigid for angle in step.in_radians())

    def parts(self) -> tuple[Reference, ...]:
        points = [point for P, Q, _ in self.given for point in (P, Q)]
        points += [name_of(parent) for _, step in self.attached for parent in step.parents]
        points += [name_of(slide.point) for slide in self.slides]
        values = [length for _, _, length in self.given] + [quantity(value) for _, step in self.attached for value in step.labels.values()]
        outside: list[Reference] = [point for point in dict.fromkeys(points) if point not in self.pins]
        guides = [slide.guide for slide in self.slides]
        outside += [value for value in values if not value.is_constant]
        return (*outside, *(each for each in guides if not (isinstance(each, Guide) and set(each.points) & set(self.pins))))

    def constraints(self, where: Where) -> tuple[Scalar, ...]:
        """Return the residuals that vanish: one a rod, two a rigidly attached point, one a slide.

        Parameters
        ----------
        where : Where
            The reading: places of points and values of quantities.

        Returns
        -------
        tuple of scalar
            The residuals [m].
        """
        found: list[Scalar] = []
        for rod in self.rods:
            length = where.value(rod.length)
            found.append(((where.at(rod.Q) - where.at(rod.P)).square() - length * length) * 0.5)
        for step in self.rigid:
            found.extend(step.constraints(where))
        return (*found, *(miss for slide in self.slides for miss in slide.constraints(where)))

    def __str__(self) -> str:
        return f'Group("{" ".join(self.pins)}")'


class Drawn(Member):
    """The strokes at which all sketch positions of a class hold: `sketch = drawn(S=0.0)`."""

    def __init__(self, strokes: dict[str, float]) -> None:
        self.strokes = strokes

    def __str__(self) -> str:
        return f"drawn({', '.join(f'{name}={value!r}' for name, value in self.strokes.items())})"


def drawn(**strokes: float) -> Drawn:
    """Return the statement at which strokes [SI] the positions `near` and `at` hold; default: the start of each.

    Parameters
    ----------
    **strokes : float
        Values of the strokes by name [m or rad].

    Returns
    -------
    Drawn
        The statement.
    """
    for name, value in strokes.items():
        require_number(f"drawn({name}", value, "a finite number is expected, in m or rad", kind=None)
    return Drawn(strokes)


def strokes_drawn(members: Mapping[str, Member]) -> dict[str, float]:
    """Return the strokes [SI] at which sketch positions hold: the start of each, unless the class or one of its parts says `drawn`."""
    drawings = of_kind(members, Drawn)
    found = {name: float(stroke.start) for name, stroke in of_kind(members, Stroke).items()}
    for name in sorted(drawings, key=lambda each: -each.count(".")):  # the whole has the last word
        found |= {each: float(value) for each, value in drawings[name].strokes.items() if each in found}
    return found
