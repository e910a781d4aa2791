"""Force elements: each knows its law, the motion knows the places of its points, both meet in `loads(motion)`."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import MISSING, Field, fields, is_dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, Literal, Protocol, Self, TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt

from ..errors import DefinitionError, cited, did_you_mean, ensure, require
from ..frozen import immutable, keep_own, record
from ..quantities import Jointed, Member, Number, Quantity, Reference, Variable, label, name_of, quantity, real, source_text
from ..quantities.quantity import plain
from ..steps import Bar, Point
from ..units import require_measure

Array: TypeAlias = npt.NDArray[np.float64]
Parameter: TypeAlias = "float | Array | Quantity | str"
"""A number of an element [SI], an array that broadcasts against the motion, or a quantity that it follows, by its name too."""
Rate: TypeAlias = "float | Array"
"""A number or an array over the poses [1/s]."""
Kind = TypeVar("Kind", bound=Member)


@immutable
class Load:
    """A force that acts at a point, as a force element gives it to statics.

    Parameters
    ----------
    point : str
        The name of the point.
    force : array (2, ...)
        The force [N]; the rest of its shape broadcasts against the motion's.
    on : tuple of str, optional
        The body that it acts on, by two of its points, or a two-point element by its name. By default that which carries the pin: the
        frame, else the body that is declared first.
    element : str, optional
        The name of the element that it comes from.
    """

    point: str
    force: Array
    on: tuple[str, ...] = ()
    element: str = ""
    """The element that puts it there, where it acts."""


@record
class Glyph:
    """The sign of an element in pictures: a word for the form, the points it hangs on, their number, a direction [rad].

    Between two points: `strut`, `spring`, `damper`, `cylinder`, `accumulator` (`count` of them, on the cylinder there). At one point:
    `weight`, `force`, `support`. On a body of some points: `mass`, `moment`; `away` is where from the first point, in the body's axes
    [m], without it in the middle of the points. `stages` of a cylinder that is drawn in stages gives, of a motion, its closed length and
    the lengths at which its stages are out [m], one after another. A `rope` runs over its points, a `pulley` turns about one: of what
    signed `radii` at some poses [m], above zero where the rope turns left.
    """

    drawn_as: str
    points: tuple[str, ...]
    count: int = 1
    way: float = 0.0
    away: tuple[float, float] | None = None
    stages: Callable[[Any], Sequence[Any]] | None = None
    radii: Callable[[Any], Sequence[Array]] = lambda motion: ()


class TwoPinned(Protocol):
    """A straight member between two pins."""

    @property
    def name(self) -> str:
        """Its name in the class; empty for one that is not of it."""

    @property
    def ends(self) -> tuple[str, str]:
        """The names of its two points."""


@immutable
class Push:
    """The thrust [N] of a straight two-point member, positive where it pushes its ends apart; it broadcasts against the motion.

    `name` is that of the member as a body, where it acts.
    """

    member: TwoPinned
    thrust: Array
    name: str = ""


@immutable
class Share:
    """The share of a tie's force in a straight member: its thrust at a force of 1, positive where it pushes; broadcasts over the poses."""

    member: Any
    of: Callable[[Poses], Array]


@immutable
class Reeving:
    """A member of a tie that bends, as a rope over pulleys: the forces on its points at a thrust of one newton.

    Its length may follow strokes, which then wind it up, each by the `rate` at which it does. Where it would have to push, another one
    that draws back pulls instead, `back` by its name: `back_loads` are what one newton of that thrust then puts on points, `back_share`
    the pull of the other one.
    """

    loads: Callable[[Poses], list[Load]]
    strokes: tuple[str, ...] = ()
    rate: Callable[[Poses, str], Array] = lambda motion, stroke: np.ones(())
    back: str = ""
    back_loads: Callable[[Poses], list[Load]] = lambda motion: []
    back_share: Callable[[Poses], Array] = lambda motion: np.zeros(())


@immutable
class Tie:
    """Straight members whose thrusts follow one force, each with its share: the sum of their lengths, by these shares, is its way.

    One that is `held` takes over a stroke. A closed one keeps its sum, which changes with the input `cut` alone, and gives the quantity
    `gives`; without that it adds nothing to what others keep already, and its sum changes as `added` does. One that has a `run` has no
    straight members.
    """

    name: str
    shares: tuple[Share, ...]
    held: bool
    cut: str = ""
    gives: str = ""
    run: Reeving | None = None
    added: Quantity | None = None


@immutable
class Friction:
    """Dry friction in a pin of a radius [m], or on the guides a point runs on (radius None; one guide where it is named)."""

    point: str
    coefficient: Array
    radius: Array | None = None
    guide: str = ""


class PointGroup(Protocol):
    """A rigid body: its points."""

    @property
    def points(self) -> tuple[str, ...]: ...


class DeclaredLengths(Protocol):
    """The table of a machine's dimensions, as far as its lengths go."""

    @property
    def lengths(self) -> Mapping[frozenset[str], Quantity]:
        """The declared lengths by the two points they are between."""


class Declared(Protocol):
    """The machine as a force element may read it: its members and tables; a plan implements it."""

    @property
    def title(self) -> str:
        """The name of its class."""

    @property
    def members(self) -> Mapping[str, Member]:
        """All members of the class by name."""

    @property
    def table(self) -> DeclaredLengths:
        """The dimensions."""

    @property
    def links(self) -> Sequence[PointGroup]:
        """The rigid bodies, the frame first."""

    @property
    def cylinders(self) -> Sequence[Bar]:
        """The driven lengths."""

    @property
    def telescopes(self) -> Sequence[str]:
        """The points that a stroke moves along their body."""

    def of_kind(self, kind: type[Kind]) -> Mapping[str, Kind]:
        """Return the members of a kind by name."""

    def reaches(self, start: Member | str) -> set[str]:
        """Return the names of all members that something is built from, itself included."""

    def moves(self, quantity: Member) -> bool:
        """Return whether a quantity follows a stroke."""

    def untracked(self, quantity: Quantity) -> tuple[str, ...]:
        """Return the angles whose whole turns a quantity depends on."""


class Poses(Protocol):
    """A motion as a law of force may read it; numbers are arrays over the poses, or traced numbers."""

    @property
    def shape(self) -> tuple[int, ...]:
        """Designs first, strokes last."""

    @property
    def inputs(self) -> Mapping[str, Array]:
        """Design variables and strokes by name [SI], shaped to broadcast against results."""

    @property
    def plan(self) -> Declared:
        """The machine, with its members by name."""

    def __getitem__(self, name: str) -> Array:
        """Return a point's position, shape (2, ...) [m]."""

    def value(self, quantity: Quantity) -> Array:
        """Return a quantity [SI]."""

    def angle(self, P: Reference, Q: Reference) -> Array:
        """Return the direction of P -> Q [rad]."""

    def distance(self, P: Reference, Q: Reference) -> Array:
        """Return the distance of two points [m]."""

    def sketched(self, quantity: Quantity) -> Array:
        """Return the value of a quantity at the sketch pose of each design [SI]; broadcasts against results."""

    def ratio(self, target: Reference, *, wrt: str | None = None, order: int = 1) -> Array:
        """Return the derivative of a point or a quantity by a stroke, of `order` 1 or 2."""

    def velocity(self, target: Reference, rates: Mapping[str, Rate]) -> Array:
        """Return the velocity of a point, shape (2, ...) [m/s], or the rate of a quantity, at rates of strokes [1/s]."""

    def acceleration(self, target: Reference, rates: Mapping[str, Rate], accelerations: Mapping[str, Rate]) -> Array:
        """Return the acceleration of a point, shape (2, ...) [m/s2], from rates [1/s] and accelerations [1/s2] of strokes."""


class Formulas(Poses, Protocol):
    """The sheet on which the equations of forces are written: poses whose numbers are symbols, and the lines written so far."""

    @property
    def pi(self) -> Array:
        """The circle's number, as a symbol."""

    def between(self, P: Reference, Q: Reference) -> Array:
        """Return both parts of the vector from one point to another [m], shape (2,)."""

    def line(self, name: str, value: Array, unit: str = "") -> Array:
        """Write the equation `name = value` and return its symbol, for use in later lines; `unit` is shown."""

    def given(self, name: str, value: Callable[[Poses], Array], unit: str = "") -> Array:
        """Return the symbol of a number that no formula gives, such as one found by iteration; `value(motion)` tells it [SI]."""

    def equals(self, value: Array, number: float) -> bool:
        """Return whether a value is a number in this design, whatever the pose, so that it need not be written."""

    def weight(self, name: str) -> Array:
        """Return the symbol of the force that an element puts on a point downwards [N]."""

    def thrust(self, member: Reference) -> Array | None:
        """Return the symbol of the thrust of a two-point member [N], positive where it pushes; None where it carries nothing."""

    def carry(self, member: TwoPinned, thrust: Array) -> None:
        """Write the thrust of a two-point member by the law of an element [N]."""


ROUGHEST = 5.0
"""More than any coefficient of friction; a larger one was given in percent."""
NEGATIVE = "is negative; give zero or more"
TOO_ROUGH = "is more than any friction; write 0.15 for 15 %"
"""What is wrong with a number that may not be below zero, and with a coefficient above ROUGHEST."""
FRICTIONLESS = "frictionless"
DIRECTIONS = (FRICTIONLESS, "extending", "retracting")
"""At rest, or without friction; while the stroke, or the cylinder that is asked for, grows; while it shrinks. Of a path: on, back."""
AS_IT_RUNS: Literal["as it runs"] = "as it runs"
"""The rates and accelerations of the motion, which are inputs in a program; and the one movement of a path in time, in which friction
and dampers take the sense and the size of its rates."""
SENSES: Mapping[str, int] = MappingProxyType(dict(zip((*DIRECTIONS, AS_IT_RUNS), (0, 1, -1, 1), strict=True)))


class Rates(dict[str, Rate]):
    """How strokes move, by name [1/s], a number or an array over the poses each; empty at rest.

    `is_timed`: whether these are speeds that were given; where only a direction is known, their senses alone mean something.
    `direction`: one of DIRECTIONS or AS_IT_RUNS, the word for it; in any but the first friction acts, against the senses of the rates.
    `accelerations` are how the rates change [1/s2], by stroke; None where inertia is left out.
    """

    def __init__(
        self, rates: Mapping[str, Rate] = MappingProxyType({}), is_timed: bool = False, direction: str = FRICTIONLESS,
        accelerations: Mapping[str, Rate] | None = None,
    ) -> None:  # fmt: skip
        super().__init__(rates)
        self.is_timed, self.direction, self.accelerations = is_timed, direction, accelerations

    @property
    def sense(self) -> int:
        """1 or -1 for a direction of motion, 0 where none is named."""
        return SENSES[self.direction]

    @property
    def has_friction(self) -> bool:
        """Whether friction acts."""
        return self.sense != 0


AT_REST = Rates()
Law = TypeVar("Law", bound=Callable[..., object])


def by_speeds(law: Law) -> Law:
    """Mark a law of motion that asks for speeds that are given: where only a direction is known, it is as at rest."""
    vars(law)["by_speeds"] = True
    return law


UNBOUNDED: tuple[Array, Array] = np.asarray(-np.inf), np.asarray(np.inf)
"""The bounds of what carries whatever the others need [N]."""


class ForceElement(Jointed):
    """The base of everything that puts forces on a mechanism. A subclass says `loads(motion)`.

    `places` are its attributes that hold points, `parameters` those that hold numbers, with the unit they are shown in.
    In a class a number is a design variable by the name `<member>.<parameter>`, such as `load.mass`; outside it may be an
    array that broadcasts against the motion. A quantity or its name (`mass=ref("m1")`) follows that.
    """

    kind: ClassVar[str] = "load"
    file_section: ClassVar[str] = "loads"
    shown_by: ClassVar[str] = ""
    """The class that shows and judges it, "module:name", where that is in a room above its own; see `linkage.motion.speakers`."""
    places: ClassVar[tuple[str, ...]] = ("point",)
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({})
    not_negative: ClassVar[frozenset[str]] = frozenset()
    limited: ClassVar[Mapping[str, str]] = MappingProxyType({})
    """Parameters that are a coefficient of "friction", zero to ROUGHEST, or an "efficiency", above zero to one."""
    stroke_values: ClassVar[frozenset[str]] = frozenset()
    """Parameters that are a value of a stroke, a length or an angle."""
    optional: ClassVar[frozenset[str]] = frozenset()

    def __post_init__(self) -> None:
        keep_own(self)
        self._check_numbers()

    @property
    def numbers(self) -> Mapping[str, str]:
        """Its parameters that are given, with their units; one that may be left out is None where it is."""
        return {name: unit for name, unit in self.parameters.items() if name not in self.optional or self.given(name) is not None}

    def given(self, name: str) -> Any:
        """Return a parameter as it is written.

        Parameters
        ----------
        name : str
            A parameter's name.

        Returns
        -------
        object
            The parameter as it is written.
        """
        return getattr(self, name)

    def variable(self, name: str) -> str:
        """Return the name of the dimension that gives a parameter: its own, or that it follows; "" where an expression gives it.

        Parameters
        ----------
        name : str
            A parameter's name.

        Returns
        -------
        str
            The dimension's name.
        """
        given = self.given(name)
        return name_of(given, is_needed=False) if isinstance(given, (str, Quantity)) else f"{self.name}.{name}"

    def sizes_made(self, name: str) -> Sequence[float]:
        """Return the sizes that a parameter is made in by a standard, ascending [SI]; none where any is.

        Parameters
        ----------
        name : str
            A parameter's name.

        Returns
        -------
        sequence of float
            The sizes.
        """
        return ()

    def stroke_arguments(self, strokes: Sequence[str]) -> Mapping[str, object]:
        """Return the values of a class's strokes that it is given [SI], by the names of these or of its own parameters.

        Parameters
        ----------
        strokes : sequence of str
            The strokes of the class.

        Returns
        -------
        mapping of str to object
            The values as they are given.
        """
        return {f"{self.name}.{name}": self.given(name) for name in self.stroke_values}

    def written(self, name: str) -> Quantity:
        """Return a parameter as a quantity of its class: a number as the design variable that it is.

        Parameters
        ----------
        name : str
            A parameter's name.

        Returns
        -------
        Quantity
            The parameter; a number is its design variable.
        """
        given = quantity(self.given(name))
        return Variable(f"{self.name}.{name}") if isinstance(given, Number) else given

    if not TYPE_CHECKING:  # a name that is not there shall be found before it runs

        def __getattr__(self, name: str) -> Any:
            """Raise AttributeError with the nearest name."""
            near = "" if name.startswith("_") else did_you_mean(name, [each for each in dir(self) if not each.startswith("_")])
            raise AttributeError(f"{type(self).__name__} has no attribute {name!r}.{near}")

    # -- what a subclass says ------------------------------------------------------------------------------

    @abstractmethod
    def loads(self, motion: Poses) -> list[Load]:
        """Return the forces over the motion's poses [N].

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.

        Returns
        -------
        list of Load
            The forces [N], each with its point.
        """

    def glyphs(self, members: Mapping[str, Member]) -> tuple[Glyph, ...]:
        """Return the signs in pictures of this element, from the members of its class; by default none.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        tuple of Glyph
            The signs.
        """
        return ()

    def heeds_direction(self, motion: Poses) -> bool:
        """Return whether its law may change with the direction of motion, where no speed is known.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.

        Returns
        -------
        bool
            Whether it may: by default where a class says `moving` or `pushes` itself.
        """
        return not all("by_speeds" in vars(law) for law in (type(self).moving, type(self).pushes))

    @by_speeds
    def moving(self, motion: Poses, rates: Rates) -> list[Load]:
        """Return the forces while strokes move at rates [1/s]: dampers and masses ask for them.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        rates : Rates
            The rates of the strokes [1/s].

        Returns
        -------
        list of Load
            The forces [N].
        """
        return self.loads(motion)

    @by_speeds
    def pushes(self, motion: Poses, rates: Rates) -> list[Push]:
        """Return the thrusts in straight two-point members by this element's law; it then acts through their pins without `loads`.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        rates : Rates
            The rates of the strokes [1/s].

        Returns
        -------
        list of Push
            The members, each with its thrust [N], positive where it pushes.
        """
        return []

    def frictions(self, motion: Poses) -> list[Friction]:
        """Return the dry friction this element stands for, whose size follows from the joint forces.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.

        Returns
        -------
        list of Friction
            The frictions.
        """
        return []

    def in_gravity(self, gravity: tuple[float, float] | None, slope: float) -> ForceElement:
        """Return this element under a load case's gravity [m/s2], its own where that is None, turned by a slope [rad].

        Parameters
        ----------
        gravity : tuple of float or None
            The gravity [m/s2] as a vector; None keeps the element's own.
        slope : float
            The slope of the ground [rad].

        Returns
        -------
        ForceElement
            The element in that gravity.
        """
        return self

    def feeds(self, members: Mapping[str, Member]) -> tuple[ForceElement, ...]:
        """Return the holding elements whose thrust this one gives, as a charged line does; the class's members by name.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        tuple of ForceElement
            The holding elements.
        """
        return ()

    def joined(self, members: Mapping[str, Member]) -> tuple[ForceElement, ...]:
        """Return the holding elements that this one puts on one pressure line; the class's members by name.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        tuple of ForceElement
            The holding elements.
        """
        return ()

    def tie(self, members: Mapping[str, Member]) -> Tie | None:
        """Return how one force of this element acts on straight members, where `joined` does not tell; the class's members by name.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        Tie or None
            The members with their shares of the force.
        """
        return None

    def link_written(self, pin: str, members: Mapping[str, Member]) -> str:
        """Return the link by which a pin of a parts list follows a length that this element gives, as it is written; "" for none.

        Parameters
        ----------
        pin : str
            The pin's name.
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        str
            The link as it is written; "" for none.
        """
        return ""

    def when_shut(self) -> ForceElement | None:
        """Return the element as it is while a load case shuts it, `LoadCase(shut=[...])`; None for one that cannot be shut.

        Returns
        -------
        ForceElement or None
            The shut element.
        """
        return None

    def claims(self, members: Mapping[str, Member]) -> Mapping[Hashable, str]:
        """Return its claims that no other element may share, in words with the remedy; `members` are the class's, by name.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        mapping of Hashable to str
            The claims, each with its words.
        """
        return {}

    @property
    def scales(self) -> bool:
        """Whether a load case may multiply it; an element that only holds or feeds follows the others' needs, without a factor."""
        return not self.holds

    @property
    def holds(self) -> bool:
        """Whether it holds the mechanism, as a cylinder does, and takes over the drive of a stroke."""
        return False

    def bounds(self, motion: Poses, lifting: bool, *, share: float = 1.0) -> tuple[Array, Array]:
        """Return between which two forces it stands, lowest and highest [N], to broadcast against it; unbounded unless it says so.

        Of a two-point member it is the thrust, positive where it pushes its ends apart; of a support its reaction. `lifting`: whether it
        moves the load, at a `share` of what it is driven with, or holds it.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        lifting : bool
            Whether it moves the load, or holds it.
        share : float
            The part of the drive's force that counts, 0 to 1.

        Returns
        -------
        tuple of ndarray
            The lowest and the highest force [N].
        """
        return UNBOUNDED

    def formulas(self, written: Formulas) -> None:
        """Write its lines in the equations of forces beyond its loads; by default none.

        An element that feeds others writes first what they carry, `written.carry(...)`; all others come after the driving forces.

        Parameters
        ----------
        written : Formulas
            The sheet of equations.
        """
        return None

    # -- what follows --------------------------------------------------------------------------------------

    def parts(self) -> tuple[Reference, ...]:
        numbers = (quantity(self.given(name)) for name in self.numbers)
        return (*(getattr(self, place) for place in self.places), *(each for each in numbers if not each.is_constant))

    def examine(self, members: Mapping[str, Member], title: str) -> None:
        """Raise DefinitionError where something else is given for a point, or one point is given twice.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.
        title : str
            The name of the class, for messages.

        Raises
        ------
        DefinitionError
            Something else is given for a point, or one point is given twice.
        """
        names = [name_of(getattr(self, place)) for place in self.places]
        for name in names:
            if not isinstance(members[name], Point):
                raise DefinitionError(f"{title}: {self.name} = {self}: {name} is not a point.")
            if names.count(name) > 1:
                raise DefinitionError(f"{title}: {self.name} = {self} begins and ends at {name}; name two different points.")

    def variables(self) -> tuple[tuple[str, float, str, str], ...]:
        """Return the design variables this element brings: name, default, kind and unit.

        Returns
        -------
        tuple
            Name, default [SI], kind and unit of each.
        """
        found = []
        for name in self.numbers:
            value = quantity(self.given(name))
            plain = "stroke" if name in self.stroke_values else "not negative" if name in self.not_negative else "number"
            if isinstance(value, Number):
                number = float(value.number) if plain == "stroke" else value.number
                found.append((f"{self.name}.{name}", number, self.limited.get(name, plain), self.parameters[name]))
        return tuple(found)

    def number(self, motion: Poses, name: str) -> Array:
        """Return a parameter over the motion [SI]: as the machine has it set, or as it is written here.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        name : str
            A parameter's name.

        Returns
        -------
        ndarray or float
            The value [SI], to broadcast against the motion.
        """
        require_poses(motion)
        given, key = self.given(name), f"{self.name}.{name}"
        member = motion.plan.members.get(self.name)
        if key in motion.inputs and type(member) is type(self) and member.given(name) is given:
            return motion.inputs[key]
        if not isinstance(given, (str, Quantity)):
            return np.asarray(given, float)
        follows = quantity(given)
        untracked = motion.plan.untracked(follows)
        if untracked:
            what = f"{self.name or self}: {name} = {value_text(given)} depends on the whole turns of {untracked[0]}, which are followed"
            raise DefinitionError(f"{what} for the loads of a class only; declare it in the class, or use sines and cosines.")
        found = motion.value(follows)
        if name in self.not_negative and np.any(found < 0.0):
            what = f"{self.name or self}: {name} = {value_text(given)} is negative, {np.nanmin(found):.6g}"
            raise DefinitionError(f"{what}; let it follow what stays at or above zero.")
        return found

    def position(self, motion: Poses, place: str) -> Array:
        """Return the position of one of its points, shape (2, ...) [m].

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.
        place : str
            The argument that holds the point.

        Returns
        -------
        ndarray
            The position [m], shape (2, ...).
        """
        return motion[name_of(getattr(self, place))]

    def _check_numbers(self) -> None:
        for name, unit in self.numbers.items():
            if name not in self.stroke_values:
                require_measure(self.given(name), "number" if name in self.limited else unit, f"{type(self).__name__}: {name}")
            self._check_number(name)

    def _check_number(self, name: str) -> None:
        given = self.given(name)
        if isinstance(given, (str, Quantity)):
            quantity(given)
            return
        try:
            value = real(given)
        except ValueError:
            raise DefinitionError(f"{self._opening()}: {name}={cited(given)} is not a number; give it in SI.") from None
        if not value.size or not np.all(np.isfinite(value)):
            raise DefinitionError(f"{self._opening()}: {name}={cited(given)} is not a finite number; give it in SI.")
        if name in self.not_negative and np.any(value < 0.0):
            raise DefinitionError(f"{self._opening()}: {name}={cited(given)} {NEGATIVE}.")
        if self.limited.get(name) == "friction" and np.any(value > ROUGHEST):
            raise DefinitionError(f"{self._opening()}: {name}={cited(given)} {TOO_ROUGH}.")

    def _opening(self) -> str:
        """Return the element as it is written; its kind alone where its points have no names yet, as in a class."""
        places = [getattr(self, place) for place in self.places]
        is_named = all(isinstance(each, str) or (isinstance(each, Member) and each.name) for each in places)
        return str(self) if is_named else type(self).__name__

    def options(self) -> dict[str, object]:
        """Return its arguments beside places and parameters that are not the default, by name.

        Returns
        -------
        dict
            The values by the names of the arguments.
        """
        declared: tuple[Field[object], ...] = fields(self) if is_dataclass(self) else ()
        others = [each for each in declared if each.name not in (*self.places, *self.parameters) and each.default is not MISSING]
        return {each.name: getattr(self, each.name) for each in others if repr(getattr(self, each.name)) != repr(each.default)}

    def words(self) -> list[str]:
        """Return its parameters and options as they are written.

        Returns
        -------
        list of str
            One text each, `mass=100`.
        """
        given = {name: value_text(self.given(name)) for name in self.numbers}
        more = {name: label(value) if isinstance(value, Member) else repr(plain(value)) for name, value in self.options().items()}
        return [f"{name}={text}" for name, text in (given | more).items()]

    def __str__(self) -> str:
        places = (label(getattr(self, place)) for place in self.places)
        return f"{type(self).__name__}({', '.join([*places, *self.words()])})"

    def having(self, values: Mapping[str, float]) -> Self:
        keys = {name: f"{self.name}.{name}" for name in self.numbers}
        return self.renewed(**{name: values[key] for name, key in keys.items() if key in values})


class LawElement(ForceElement):
    """The base of elements whose loads are those of their law at rest: of `moving`, by default the ends of what they push."""

    def loads(self, motion: Poses) -> list[Load]:
        return self.moving(motion, AT_REST)

    @by_speeds
    def moving(self, motion: Poses, rates: Rates) -> list[Load]:
        return [load for push in self.pushes(motion, rates) for load in end_forces(push, motion)]


def end_forces(push: Push, motion: Poses) -> list[Load]:
    """Return the forces of a two-point member on the points at its ends [N]; DefinitionError where they coincide while it pushes."""
    A, B = push.member.ends
    arm, length = motion[B] - motion[A], motion.distance(A, B)
    refuse_coincidence(push, length)
    force = arm / np.where(length == 0.0, 1.0, length) * push.thrust
    return [Load(A, -force), Load(B, force)]


def refuse_coincidence(push: Push, length: Array) -> None:
    """Raise DefinitionError where the ends of a two-point member coincide while it pushes or pulls."""
    if np.any((length == 0.0) & (push.thrust != 0.0)):
        what = f"{push.member.name} = {push.member}" if push.member.name else str(push.member)
        raise DefinitionError(f"{what}: its ends coincide at some poses and give no direction; move one of them.")


def check_together(elements: Mapping[str, object] | Sequence[tuple[str, object]], members: Mapping[str, Member], title: str) -> None:
    """Raise DefinitionError for loads that cannot act together: one that stands twice, two of one name, two that claim one thing.

    `elements` are the loads with their names, `members` those of the class.
    """
    found, owners = list(elements.items() if isinstance(elements, Mapping) else elements), dict[Hashable, str]()
    for place, (name, element) in enumerate(found):
        for other, earlier in found[:place]:
            if element is earlier:
                what = f"{name} stands twice among the loads" if name == other else f"{other} and {name} are one and the same load"
                remedy = f'give it once, and scale it by a load case, LoadCase(scale={{"{other}": 2.0}})'
                raise DefinitionError(f"{title}: {what} and would count double; {remedy}.")
            if name == other and isinstance(element, Member) and element.name:
                raise DefinitionError(f"{title}: two of these loads are called {name}, {earlier} and {element}; give one another name.")
        for key, words in element.claims(members).items() if isinstance(element, ForceElement) else ():
            first = owners.setdefault(key, name)
            ensure(first == name, f"{title}: {first} and {name} both {words}")


def value_text(value: object) -> str:
    """Return a parameter as it is written: a number, an expression, a name."""
    if type(value) is np.ndarray and value.ndim:
        return f"{value.size} values"
    return source_text(quantity(value)) if isinstance(value, (str, Quantity)) else repr(plain(value))


def require_poses(given: object) -> None:
    """Raise DefinitionError for a value without poses: anything but a motion, or the traced motion of a law."""
    has_poses = callable(getattr(given, "ratio", None)) and not isinstance(given, type)
    require(has_poses, "", given, "is no motion; give machine.sweep(...) or machine.at(...)")


def couple(P: str, Q: str, arm: Array, moment: Array) -> list[Load]:
    """Return a moment [Nm], counter-clockwise, on the body of P and Q as a pair of forces; `arm` is Q - P, shape (2, ...) [m]."""
    across = np.stack([-arm[1], arm[0]]) * (moment / (arm[0] ** 2 + arm[1] ** 2))
    return [Load(Q, across, (P, Q)), Load(P, -across, (P, Q))]
