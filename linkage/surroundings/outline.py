"""Outlines of surroundings: drawn with the mechanism, fixed to the frame or carried by a body, and never computed with.

An outline's coordinates are those of what carries it. On two points, `on=("B", "C")`, the first is the origin and x goes to the
second; on one point, `on="T"`, the axes keep the frame's directions; on nothing they are the frame's own.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice
from pathlib import Path
from types import MappingProxyType
from typing import Any, ClassVar, Self, TypeAlias

import numpy as np
import numpy.typing as npt

from ..errors import DefinitionError, FileError, cited, ensure, is_listed, is_yes, require, require_type, two_of
from ..quantities import Axes, Member, Operand, Reference, Stroke, is_number, label, name_of, needed_behind, needs, of_kind, source_text
from ..quantities.axes import NOTHING, is_nothing, plus
from ..quantities.member import is_member_or_name
from ..quantities.quantity import Quantity, plain, quantity
from ..steps import Link
from ..units import require_measure, require_number

Array: TypeAlias = npt.NDArray[np.float64]
Value: TypeAlias = Callable[[Quantity], float]
"""What gives a quantity's number [SI] for the design that is drawn."""
Corner: TypeAlias = "Sequence[Operand]"
"""Two coordinates [m]: numbers, dimensions, expressions of them."""
Carrier: TypeAlias = "Reference | Sequence[Reference] | None"
"""What carries an outline: two points of a body, one point, a link; None for the frame."""
Moved: TypeAlias = Callable[[Quantity, Quantity], tuple[Quantity, Quantity]]
"""What gives a place as a part's axes have it."""

ROUND = 72  # the corners of a circle


class Outline(Member):
    """A line through corners: `bucket = Outline([(0, 0), (0.9, 0), (0.5, 0.6)], on="B N")`.

    It is drawn and holds nothing: mobility, plan, forces and kernels do not know it. `Outline.circle`, `.line`, `.dxf` and `.image` make
    the others.

    Parameters
    ----------
    points : sequence of corners
        The corners (x, y) [m]. They may follow dimensions, but no stroke: what moves is carried.
    on : Point, Link or str, optional
        What carries it: two points of a body, one point, a link, or nothing for the frame.
    closed, filled : bool, optional
        Whether it is closed and filled, as it is by default.
    hatched : bool, optional
        Whether the right side of its direction is hatched, as the ground below a line from left to right.
    """

    kind = "outline"
    file_section = "surroundings"
    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType(
        {"points": "corners", "at": "corner", "on": "carrier", "angle": "direction"}
    )
    circle: ClassVar[type[CircleOutline]]
    dxf: ClassVar[type[DxfOutline]]
    image: ClassVar[type[ImageOutline]]
    form: ClassVar[str] = "Outline"
    closed, filled, hatched = True, False, False

    def __init__(
        self, points: Sequence[Corner], *, on: Carrier = None, closed: bool = True, filled: bool = True, hatched: bool = False
    ) -> None:
        self.points, self.on = outline_corners(points, self.form), carrying_points(on, self.form)
        self.closed = is_yes("Outline: closed", closed)
        self.filled, self.hatched = is_yes("Outline: filled", filled) and self.closed, is_yes(f"{self.form}: hatched", hatched)

    @staticmethod
    def line(*points: Corner, on: Carrier = None, hatched: bool = True) -> LineOutline:
        """Return an open line, hatched on the right of its way: `ground = Outline.line((-1, 0), (3, 0))`.

        Parameters
        ----------
        *points : tuple of float
            The corners [m].
        on : str or sequence, optional
            The body that carries it; by default the frame.
        hatched : bool
            Whether its right side is hatched.

        Returns
        -------
        LineOutline
            The line.
        """
        return LineOutline(points, on=on, hatched=hatched)

    @property
    def _on(self) -> tuple[Reference, ...]:
        return self.on

    @property
    def carriers(self) -> tuple[str, ...]:
        """The names of the points that carry it: two, one, or none for the frame."""
        return tuple(map(name_of, self._on))

    def numbers(self) -> tuple[Quantity, ...]:
        """Return all quantities that it is drawn by.

        Returns
        -------
        tuple of Quantity
            The quantities.
        """
        return tuple(each for corner in self.points for each in corner)

    def parts(self) -> tuple[Reference, ...]:
        return (*self._on, *(each for each in self.numbers() if not each.is_constant))

    def faults(self, members: Mapping[str, Member]) -> Iterator[str]:
        """Yield that something else than points carries it, or that its form follows a stroke.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        iterator of str
            The faults in words.
        """
        if len(set(self.carriers)) < len(self.carriers):
            yield f"{self.carriers[0]} carries it twice; name two points of the body"
        for name in self.carriers:
            if members[name].kind != "point":
                yield f"{name} is not a point; name two points of the body that carries it"
        for each in self.numbers():
            behind = needed_behind([each.name] if each.name else needs(each), members)
            if strokes := sorted(behind & of_kind(members, Stroke).keys()):
                yield f"{source_text(each)} follows the stroke {strokes[0]}; give a fixed size, and carry it with on="

    def in_axes(self, axes: Axes) -> Self:
        if len(self.carriers) == 2:  # the axes of a body go with its points, which are mirrored
            return self.moved(lambda x, y: (x, y.opposite()), axes) if axes.mirrored else self
        if self.carriers and axes.carrier:
            what, own = f"{self.name} = {self} keeps directions of a part that is carried", self.name.rpartition(".")[2]
            remedy = f"let two points of a body carry it, on=({label(self._on[0])}, ...), or leave it out, Part(..., {own}=None)"
            raise DefinitionError(f"{what}; {remedy}.")
        if self.carriers:
            return self if axes.are_upright else self.moved(replace(axes, at=(NOTHING, NOTHING)).corner, axes)
        return self.moved(axes.corner, axes).renewed(on=axes.carrier)

    def moved(self, corner: Moved, axes: Axes) -> Self:
        """Return the outline with its places where a part's axes take them.

        Parameters
        ----------
        corner : callable
            Moves a corner.
        axes : Axes
            The part's axes.

        Returns
        -------
        Outline
            The moved outline.
        """
        points = tuple(corner(x, y) for x, y in self.points)
        return self.renewed(points=points[::-1] if axes.mirrored and self.hatched else points)

    def lines(self, value: Value) -> tuple[Array, ...]:
        """Return its lines in the axes of its carrier, shape (n, 2) each [m]; a closed one does not repeat its first corner.

        Parameters
        ----------
        value : callable
            Returns the value of a quantity.

        Returns
        -------
        tuple of ndarray
            The lines [m].
        """
        return (numbers_at(self.points, value),)

    def under(self, value: Value) -> tuple[str, Array, float] | None:
        """Return a picture's path, its corners from the lower left one, counter-clockwise [m], and how opaque it is; None for lines.

        Parameters
        ----------
        value : callable
            Returns the value of a quantity.

        Returns
        -------
        tuple or None
            The path, the corners (4, 2) [m], the opacity.
        """
        return None

    def options(self) -> dict[str, str]:
        """Return the keywords written behind its corners, without the defaults.

        Returns
        -------
        dict of str to str
            The keywords.
        """
        words = {"closed": "False"} if not self.closed else {} if self.filled else {"filled": "False"}
        return words | ({"hatched": "True"} if self.hatched else {})

    def __str__(self) -> str:
        return outline_text("Outline", [f"[{', '.join(map(corner_text, self.points))}]"], self.on, self.options())


class CircleOutline(Outline):
    """A circle [m] about a place, or about a point by its name: `wheel = Outline.circle(at=(0, 0.8), radius=R)`."""

    argument_kinds = MappingProxyType({"at": "centre", "radius": "quantity"})

    def __init__(self, at: Corner | Reference, radius: Operand, *, on: Carrier = None, filled: bool = True) -> None:
        centre = at if is_member_or_name(at) else None
        if centre is not None and on is not None:
            raise DefinitionError(f"Outline.circle: it stands about {label(centre)} and on={cited(on)} as well; leave on= out.")
        self.at: tuple[Quantity, ...] | Reference = centre if centre is not None else corner_of(at, "Outline.circle(at=...)")
        self.radius = length_above_zero(radius, "Outline.circle(radius=...)")
        self.on = carrying_points(on, "Outline.circle")
        self.filled = is_yes("Outline.circle: filled", filled)

    @property
    def _on(self) -> tuple[Reference, ...]:
        return self.on if isinstance(self.at, tuple) else (self.at,)

    def in_axes(self, axes: Axes) -> Self:
        return super().in_axes(axes) if self.centre else self

    def moved(self, corner: Moved, axes: Axes) -> Self:
        x, y = self.centre
        return self.renewed(at=corner(x, y))

    @property
    def centre(self) -> tuple[Quantity, ...]:
        """The centre's coordinates; none where it is a point."""
        return self.at if isinstance(self.at, tuple) else ()

    def numbers(self) -> tuple[Quantity, ...]:
        return (*self.centre, self.radius)

    def lines(self, value: Value) -> tuple[Array, ...]:
        ways = np.linspace(0.0, 2.0 * np.pi, ROUND, endpoint=False)
        centre = np.array([value(each) for each in self.centre] or [0.0, 0.0])
        return (centre + value(self.radius) * np.column_stack([np.cos(ways), np.sin(ways)]),)

    def __str__(self) -> str:
        place = corner_text(self.centre) if self.centre else repr(*self.carriers)
        options = {} if self.filled else {"filled": "False"}
        return outline_text("Outline.circle", [f"at={place}", f"radius={source_text(self.radius)}"], self.on, options)


class LineOutline(Outline):
    """An open line; `Outline.line` makes it."""

    form = "Outline.line"

    def __init__(self, points: Sequence[Corner], *, on: Carrier = None, hatched: bool = True) -> None:
        super().__init__(points, on=on, closed=False, hatched=hatched)

    def __str__(self) -> str:
        return outline_text("Outline.line", list(map(corner_text, self.points)), self.on, {} if self.hatched else {"hatched": "False"})


class PlacedFile(Outline):
    """The base of outlines from a file: their origin's place and their angle."""

    def __init__(self, path: str | Path, on: Carrier, at: Corner, angle: Operand) -> None:
        ensure(str(path).strip(), f"{self.form}: the path of the file is missing.")
        self.path, self.on = str(path), carrying_points(on, self.form)
        self.at, self.angle = corner_of(at, f"{self.form}(at=...)"), quantity(angle)

    def moved(self, corner: Moved, axes: Axes) -> Self:
        if axes.mirrored:
            what = f"{self.name} = {self}: what a file holds is not mirrored"
            raise DefinitionError(f"{what}; give a drawing of the other hand, or leave it out.")
        x, y = self.at
        return self.renewed(at=corner(x, y), angle=plus(self.angle, axes.angle))

    def examine(self, members: Mapping[str, Member], title: str) -> None:
        """Raise FileError where the file is not there, too."""
        super().examine(members, title)
        if not Path(self.path).is_file():
            where = "give the path from where the program runs, or a whole one"
            raise FileError(f"{title}: {self.name} = {self}: there is no such file as {self.path}; {where}.")

    def numbers(self) -> tuple[Quantity, ...]:
        return (*self.at, self.angle)

    def in_radians(self) -> tuple[Quantity, ...]:
        return (self.angle,)

    def _on_its_points(self, points: Array, value: Value) -> Array:
        """Return points of the file [m] where they are drawn."""
        cos, sin = np.cos(value(self.angle)), np.sin(value(self.angle))
        return np.asarray(points @ np.array([[cos, sin], [-sin, cos]]) + [value(each) for each in self.at])

    def _placing(self) -> list[str]:
        """Return how it is placed, in so far as it is not the usual."""
        at = [] if all(map(is_nothing, self.at)) else [f"at={corner_text(self.at)}"]
        return at + ([] if is_nothing(self.angle) else [f"angle={source_text(self.angle, measures='angle')}"])


class DxfOutline(PlacedFile):
    """The lines of a DXF drawing (extra `cad`), as `Outline.dxf` makes it: its origin stands `at` [m], turned by `angle` [rad].

    `scale` is metres per unit of the drawing, 1e-3 for millimetres; `layers` names those that are taken, none for all.
    """

    form = "Outline.dxf"
    argument_kinds = MappingProxyType({"path": "path", "layers": "words"})
    closed = False

    def __init__(
        self, path: str | Path, *, on: Carrier = None, at: Corner = (0.0, 0.0), angle: Operand = 0.0, scale: float = 1e-3,
        layers: Sequence[str] = (), filled: bool = False,
    ) -> None:  # fmt: skip
        super().__init__(path, on, at, angle)
        require_number("Outline.dxf: scale", scale, "is no size; give metres per unit of the drawing, 1e-3 for mm", above=0.0, kind=None)
        require_type("Outline.dxf: layers", layers, (list, tuple), 'is no list of layers; write layers=["0"]', of=str)
        self.scale, self.layers, self.filled = float(scale), tuple(layers), is_yes("Outline.dxf: filled", filled)

    def lines(self, value: Value) -> tuple[Array, ...]:
        """Return its lines; FileError where the file cannot be read, DefinitionError where there are no lines in it."""
        return tuple(self._on_its_points(self.scale * each, value) for each in dxf_lines(self.path, self.layers))

    def __str__(self) -> str:
        options = {"filled": "True"} if self.filled else {}
        scale = [] if self.scale == 1e-3 else [f"scale={self.scale!r}"]
        layers = [f"layers={list(self.layers)!r}"] if self.layers else []
        return outline_text("Outline.dxf", [repr(self.path), *self._placing(), *scale, *layers], self.on, options)


class ImageOutline(PlacedFile):
    """A picture to lie under the mechanism, as `Outline.image` makes it: its lower left corner stands `at` [m].

    It is as wide as `width` [m], and turned by `angle` [rad].
    """

    form = "Outline.image"
    argument_kinds = MappingProxyType({"path": "path", "width": "quantity"})

    def __init__(
        self, path: str | Path, *, width: Operand, on: Carrier = None, at: Corner = (0.0, 0.0), angle: Operand = 0.0, opacity: float = 0.5
    ) -> None:
        super().__init__(path, on, at, angle)
        self.width = length_above_zero(width, "Outline.image(width=...)")
        self.opacity = float(require_number("Outline.image: opacity", opacity, "is not above 0 and at most 1", above=0.0, most=1.0))

    def numbers(self) -> tuple[Quantity, ...]:
        return (*super().numbers(), self.width)

    def lines(self, value: Value) -> tuple[Array, ...]:
        return ()

    def under(self, value: Value) -> tuple[str, Array, float] | None:
        """Return the same with corners of a square; the picture's height is its own."""
        unit = value(self.width) * np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
        return self.path, self._on_its_points(unit, value), self.opacity

    def __str__(self) -> str:
        opacity = {} if self.opacity == 0.5 else {"opacity": repr(self.opacity)}
        return outline_text("Outline.image", [repr(self.path), f"width={source_text(self.width)}", *self._placing()], self.on, opacity)


Outline.circle, Outline.dxf, Outline.image = CircleOutline, DxfOutline, ImageOutline


# What it is given, and how that is written.


def outline_corners(given: object, what: str) -> tuple[tuple[Quantity, ...], ...]:
    """Return corners as pairs of quantities; DefinitionError for anything else, or for less than two."""
    if isinstance(given, (str, Mapping, Member)) or not isinstance(given, (Sequence, np.ndarray)):
        raise DefinitionError(f"{what}: {cited(given)} is no list of corners; write [(0, 0), (0.4, 0), (0.4, 0.3)] in m.")
    found = tuple(corner_of(each, what) for each in given)
    ensure(len(found) >= 2, f"{what}: a line has 2 corners at least, here are {len(found)}.")
    return found


def corner_of(given: object, what: str) -> tuple[Quantity, ...]:
    """Return two coordinates as quantities; DefinitionError for anything else."""
    pair = two_of(given)
    if not pair or not all(isinstance(each, (str, Quantity)) or is_number(each) for each in pair):
        raise DefinitionError(f"{what}: {cited(given)} is not a place; write (x, y) in m, numbers or dimensions.")
    require_measure(pair, "length", what)
    return tuple(quantity(plain(each)) for each in pair)


def length_above_zero(given: object, what: str) -> Quantity:
    """Return a size as a quantity; DefinitionError for one that is not above zero."""
    is_size = isinstance(given, (str, Quantity)) or (is_number(given) and given > 0.0)
    require(is_size, what, given, "is no size; give a length above zero [m], or a dimension")
    require_measure(given, "length", what)
    return quantity(plain(given))


def carrying_points(given: object, what: str) -> tuple[Reference, ...]:
    """Return the points that carry an outline; DefinitionError for more than two, or one of them twice."""
    if given is None:
        return ()
    if isinstance(given, Link):
        given = given.points[:2]
    found = tuple(given.replace(",", " ").split()) if isinstance(given, str) else (given,) if isinstance(given, Member) else given
    if not is_listed(found) or not 1 <= len(found) <= 2 or not all(is_member_or_name(each) for each in found):
        raise DefinitionError(f'{what}: on={cited(given)} is no carrier; name two points of a body, on=("B", "C"), or one point.')
    return tuple(found)


def numbers_at(corners: Sequence[Sequence[Quantity]], value: Value) -> Array:
    """Return corners as numbers, shape (n, 2) [m]."""
    return np.array([[value(each) for each in corner] for corner in corners])


def corner_text(corner: Sequence[Quantity]) -> str:
    """Return a corner as it is written."""
    return f"({', '.join(map(source_text, corner))})"


def outline_text(what: str, words: Sequence[str], on: Sequence[Reference], options: Mapping[str, str]) -> str:
    """Return an outline as it is written."""
    carried = [f"on={' '.join(map(label, on))!r}"] if on else []
    return f"{what}({', '.join([*words, *carried, *(f'{name}={text}' for name, text in options.items())])})"


MOST = 20_000
"""Corners that are drawn of a drawing, and lines that are looked at; more do not fit into a picture."""
LARGEST, SMALLEST = 1e12, 1e-9
"""The largest coordinate of a drawing [its units], and the least size of it beside its largest coordinate, that can be drawn."""
DEEP = 16
"""How deep blocks may stand in blocks."""


def dxf_entities(path: str) -> tuple[Any, list[Any]]:
    """Return a drawing and the entities of its model space, those of inserted blocks among them.

    FileError where the file cannot be read; DefinitionError without ezdxf, and for more entities than a picture shows.
    """
    try:
        from ezdxf import filemanagement, lldxf
    except ImportError:
        raise DefinitionError(f"{path}: drawings are read with ezdxf; install it by pip install hydrolinkage[cad].") from None
    if not Path(path).is_file():
        raise FileError(f"{path}: there is no such file; give the path from where the program runs, or a whole one.")
    try:
        drawing = filemanagement.readfile(path)
    except (OSError, lldxf.const.DXFError) as error:
        raise FileError(f"{path} is no DXF drawing that can be read: {error}") from error
    every = list(islice(unblocked(drawing.modelspace(), path), MOST + 1))
    ensure(len(every) <= MOST, f"{path}: its blocks, inserted, are more than {MOST} lines, which no picture shows; take some of them out.")
    return drawing, [each for each in every if each.dxftype() != "INSERT"]


def dxf_lines(path: str, layers: Sequence[str] = ()) -> list[npt.NDArray[np.float64]]:
    """Return the lines of a drawing's model space, shape (n, 2) each, in the drawing's units, curves by short chords.

    Errors are those of `dxf_entities`; DefinitionError where no line is on the layers named.
    """
    drawing, every = dxf_entities(path)
    from ezdxf import path as curves

    named = [each.lower() for each in layers]
    entities = [each for each in visible(drawing, every, layers) if not layers or each.dxf.layer.lower() in named]
    paths = list(drawable(entities, curves, path))
    distance = 1e-3 * span_of(paths, path)  # no farther from curves; up to one corner more than can be drawn
    corners = ([(each.x, each.y) for each in islice(one.flattening(distance), MOST + 1)] for one in paths)
    found = [np.array(each, float) for each in corners if len(each) > 1]
    if not found:
        on = f" on {', '.join(layers)}; its layers: {', '.join(sorted({each.dxf.layer for each in every}))}" if layers else ""
        raise DefinitionError(f"{path}: there is no line{on}.")
    count = sum(map(len, found))
    ensure(count <= MOST, f"{path}: {count} corners are more than a picture shows, {MOST}; name the layers to take.")
    return found


def visible(drawing: Any, entities: Sequence[Any], named: Sequence[str] = ()) -> Iterator[Any]:
    """Yield those entities of a drawing that it does not hide, by themselves or with their layers; layers that are named show."""
    hidden = {str(each.dxf.name).lower() for each in drawing.layers if each.is_off() or each.is_frozen()} - {each.lower() for each in named}
    yield from (each for each in entities if not each.dxf.invisible and str(each.dxf.layer).lower() not in hidden)


def unblocked(space: Any, path: str, around: tuple[str, ...] = ()) -> Iterator[Any]:
    """Yield the entities of a space and of its inserted blocks; FileError for a block within itself, or nested too deep.

    `around` names the blocks that the space stands in, from the outermost one.
    """
    for each in space:
        yield each
        if each.dxftype() != "INSERT":
            continue
        name = str(each.dxf.name)
        if name in around:
            raise FileError(f"{path}: the block {name} inserts itself ({' > '.join([*around, name])}); mend the drawing.")
        if len(around) == DEEP:
            raise FileError(f"{path}: blocks stand in blocks more than {DEEP} deep, {' > '.join(around[:3])} > ...; explode some of them.")
        yield from each.attribs
        for one in each.multi_insert() if each.mcount > 1 else (each,):
            for entity in unblocked(one.virtual_entities(), path, (*around, name)):
                if entity.dxf.layer == "0":  # in a block that says: on the layer of what inserts it
                    entity.dxf.layer = each.dxf.layer
                yield entity


def drawable(entities: Sequence[Any], curves: Any, path: str) -> Iterator[Any]:
    """Yield the paths of the entities that are lines or curves; DefinitionError for one whose sizes cannot be drawn."""
    for each in entities:
        try:
            with np.errstate(all="ignore"):
                yield curves.make_path(each)
        except TypeError:
            continue
        except (ArithmeticError, ValueError) as error:
            remedy = f"its sizes cannot be drawn, up to {LARGEST:.0e} are; take it out, or draw in a larger unit"
            raise DefinitionError(f"{path}: {each.dxftype()}: {str(error).rstrip('.')}: {remedy}.") from error


def span_of(paths: Sequence[Any], path: str) -> float:
    """Return the larger side of the box around some paths; 1 where there is none. DefinitionError for one that cannot be drawn."""
    places = np.array([(each.x, each.y) for one in paths for each in one.control_vertices()] or [(0.0, 0.0), (1.0, 0.0)])
    largest = float(np.max(np.abs(places)))
    if not largest <= LARGEST:
        size = f"{largest:.3g}" if np.isfinite(largest) else "no finite number"
        what = f"{path}: a coordinate of it is {size}, and up to {LARGEST:.0e} are drawn"
        raise DefinitionError(f"{what}; take that line out, or draw in a larger unit.")
    span = float(np.ptp(places, axis=0).max()) or 1.0
    what = f"{path}: it is {span:.3g} wide and stands {largest:.3g} away from its origin, which leaves no digits"
    ensure(span >= SMALLEST * largest, f"{what}; move the drawing to its origin.")
    return span
