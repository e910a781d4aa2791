"""Straight elements between two points: springs, dampers, actuators, any law of length and rate; a cylinder is one as well.

Each is a two-force member: its end forces act through its two pins, on the bodies that are there. One sign for all of them:
thrust [N] is positive where it pushes the ends apart.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, ClassVar, Literal, Self, TypeAlias, cast, get_args

import numpy as np

from ..errors import DefinitionError, can_be_called, cited, ensure, errors_of
from ..frozen import immutable, record
from ..quantities import Distance, Joint, Member, Reference, name_of, pinned
from .element import AT_REST, Array, Formulas, Glyph, LawElement, Parameter, Poses, Push, Rate, Rates, by_speeds, refuse_coincidence

DrawnAs: TypeAlias = Literal["strut", "spring", "damper", "cylinder"]


@record
class Halves:
    """The two bodies of a straight member, of which the second slides in the first: that on A, then that on B.

    Their names, their links' names; the points at which the one guides the other, against moving across and turning, and at which
    the member's thrust acts between them; what these two joints are called.
    """

    names: tuple[str, str]
    labels: tuple[str, str]
    points: tuple[str, str]
    kinds: tuple[str, str]


class TwoPoint(LawElement):
    """The base of straight elements from A to B. A subclass is a frozen dataclass with A and B, and says `push`.

    `drawn_as` is what pictures show: a plain thin strut unless it says otherwise.
    """

    A: Reference
    B: Reference
    places: ClassVar[tuple[str, ...]] = ("A", "B")
    drawn_as: ClassVar[DrawnAs] = "strut"

    def __init_subclass__(cls, **options: object) -> None:
        super().__init_subclass__(**options)
        ensure(cls.drawn_as in get_args(DrawnAs), f"{cls.__name__}: drawn_as={cls.drawn_as!r} is none of {', '.join(get_args(DrawnAs))}.")

    @abstractmethod
    def push(self, motion: Poses, length: Array, rate: Array) -> Array:
        """Return the thrust [N] at a length [m] that grows at a rate [m/s], 0 at rest; positive where it pushes the ends apart.

        Parameters
        ----------
        motion : Motion
            The poses.
        length : array
            The length [m].
        rate : array
            How fast it grows [m/s], 0 at rest.

        Returns
        -------
        array
            The thrust [N].
        """

    def joints(self) -> tuple[Joint, ...]:
        return tuple(pinned(point) for point in self.ends)

    def glyphs(self, members: Mapping[str, Member]) -> tuple[Glyph, ...]:
        return (Glyph(self.drawn_as, self.ends),)

    @property
    def ends(self) -> tuple[str, str]:
        """The names of its two points."""
        return name_of(self.A), name_of(self.B)

    def halves(self, members: Mapping[str, Member]) -> Halves | None:
        """Return the two bodies that it is, which slide in each other; None where it is one. The class's members by name."""
        return None

    def growth(self, motion: Poses, rates: Mapping[str, Rate]) -> Array:
        """Return how fast its length grows [m/s] while strokes move at rates [1/s]; of no rates 0."""
        if not rates:
            return np.zeros(())
        A, B = self.ends
        arm, moved = motion[B] - motion[A], motion.velocity(B, rates) - motion.velocity(A, rates)
        return np.asarray((arm[0] * moved[0] + arm[1] * moved[1]) / motion.distance(A, B))[()]

    def closed_thrust(self, motion: Any, acting: Any) -> Array | None:
        """Return, of a holding member, its thrust from closed lines in a situation [N]; None where there are none."""
        return None

    def area_in(self, motion: Poses, sense: Array) -> Array:
        """Return, of a holding member, its thrust at one unit of pressure [m2]; `sense` is 1 while it pushes and -1 while it pulls."""
        return sense

    def area_beside(self, motion: Poses, sense: Array, first: Self, way: int) -> Array:
        """Return the same where another member of its line pushes (`way` 1) or pulls (-1); `sense` drives the stroke as that does."""
        return self.area_in(motion, sense)

    def area_written(self, written: Formulas) -> Array:
        """Return, of a holding member, its thrust at one unit of pressure [m2] as the equations of forces write it."""
        return self.area_in(written, np.ones(()))

    def turns(self, members: Mapping[str, Member]) -> bool:
        """Return whether a holding member works with another area while it pulls than while it pushes; the class's members by name."""
        return False

    @by_speeds
    def pushes(self, motion: Poses, rates: Rates = AT_REST) -> list[Push]:
        length = motion.distance(self.A, self.B)
        rate = self.growth(motion, rates if rates.is_timed else AT_REST)
        opening = self.name or type(self).__name__
        with errors_of(f"{opening}: its law of length and rate"):
            thrust: object = self.push(motion, length, rate)
        if isinstance(thrust, (np.ndarray, float, int)):
            axes = zip(np.shape(thrust)[::-1], motion.shape[::-1], strict=False)
            fits = np.ndim(thrust) <= len(motion.shape) and all(own in (1, poses) for own, poses in axes)
        else:  # a number of the program, while the law is traced
            fits = hasattr(thrust, "__array_ufunc__")
        if not fits:
            what = f"its law gives {cited(thrust)}; a thrust [N] for each pose is expected, of the shape {motion.shape}"
            raise DefinitionError(f"{opening}: {what}.")
        found = Push(self, cast(Array, thrust))
        refuse_coincidence(found, length)
        return [found]


@immutable
class Spring(TwoPoint):
    """A straight spring from A to B: `relief = Spring(A, B, stiffness=20e3, free_length=0.4)`.

    Its thrust is -stiffness (AB - free_length) [N].

    Parameters
    ----------
    A, B : Point or str
        Its ends.
    stiffness : float or quantity
        The stiffness [N/m].
    free_length : float or quantity, optional
        The length without a force [m].
    preload : float or quantity, optional
        Instead of the free length, its pull [N] at the sketch pose; a negative one pushes. That pose is where the strokes start unless the
        class says `drawn(...)`.
    """

    A: Reference
    B: Reference
    stiffness: Parameter
    free_length: Parameter | None = None
    preload: Parameter | None = None
    drawn_as: ClassVar[DrawnAs] = "spring"
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"stiffness": "N/m", "free_length": "mm", "preload": "N"})
    not_negative: ClassVar[frozenset[str]] = frozenset({"stiffness", "free_length"})
    optional: ClassVar[frozenset[str]] = frozenset({"free_length", "preload"})

    def __post_init__(self) -> None:
        if (self.free_length is None) == (self.preload is None):
            given = "neither" if self.free_length is None else "both"
            raise DefinitionError(f"{self._opening()}: give its free_length [m] or its preload [N]; {given} is given.")
        super().__post_init__()

    def push(self, motion: Poses, length: Array, rate: Array) -> Array:
        stiffness = self.number(motion, "stiffness")
        if self.preload is None:
            return stiffness * (self.number(motion, "free_length") - length)
        return stiffness * (motion.sketched(Distance(self.A, self.B)) - length) - self.number(motion, "preload")


@immutable
class Damper(TwoPoint):
    """A viscous damper from A to B: its thrust is -coefficient d(AB)/dt [N], nothing at rest.

    Parameters
    ----------
    A, B : Point or str
        Its ends.
    coefficient : float or quantity
        The coefficient [N s/m].
    """

    A: Reference
    B: Reference
    coefficient: Parameter
    drawn_as: ClassVar[DrawnAs] = "damper"
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"coefficient": "N s/m"})
    not_negative: ClassVar[frozenset[str]] = frozenset({"coefficient"})

    def push(self, motion: Poses, length: Array, rate: Array) -> Array:
        return -self.number(motion, "coefficient") * rate


@immutable
class Actuator(TwoPoint):
    """A thrust that is known, from A to B: `push = Actuator(A, B, force=12 * kN)`.

    Parameters
    ----------
    A, B : Point or str
        Its ends.
    force : float or quantity
        The thrust [N], positive where it pushes the ends apart.
    """

    A: Reference
    B: Reference
    force: Parameter
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"force": "N"})

    def push(self, motion: Poses, length: Array, rate: Array) -> Array:
        return self.number(motion, "force")


@immutable
class Between(TwoPoint):
    """A law of one's own from A to B: `strut = Between(A, B, law)`.

    It makes a gas strut, a chain that only pulls, or a bump stop.

    Parameters
    ----------
    A, B : Point or str
        Its ends.
    law : callable
        `law(length, rate)` gives the thrust [N] from m and m/s: plain arithmetic on arrays, with `np.where` and `np.maximum` where it has
        branches.
    """

    A: Reference
    B: Reference
    law: Callable[[Array, Array], Array]

    def __post_init__(self) -> None:
        super().__post_init__()
        if not can_be_called(self.law):
            raise DefinitionError(f"{self._opening()}: law={cited(self.law)} is no function; give one of length [m] and rate [m/s].")

    def push(self, motion: Poses, length: Array, rate: Array) -> Array:
        return self.law(length, rate)

    def words(self) -> list[str]:
        return [f"law={getattr(self.law, '__name__', 'law')}"]
