"""Forces at a point: weights, given forces, supports."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from math import cos, sin
from types import MappingProxyType
from typing import ClassVar, Self, TypeAlias

import numpy as np

from ..errors import DefinitionError, cited, require, require_type, two_of, unknown
from ..frozen import immutable, unmasked
from ..quantities import Axes, Member, Reference, is_number, label, name_of, real
from ..quantities.quantity import plain
from ..steps import Link, Point
from ..units import Amount, g0, require_measure
from .element import Array, ForceElement, Friction, Glyph, LawElement, Load, Parameter, Poses, Rates, by_speeds, couple, value_text

DOWN = (0.0, -g0)  # gravity, m/s2


@immutable
class Weight(LawElement):
    """The weight of a mass at a point: `load = Weight(G, mass=1200)`. Where it is accelerated, its inertia acts too.

    Parameters
    ----------
    point : Point or str
        The point.
    mass : float or quantity
        The mass [kg], a design variable.
    gravity : tuple of float, optional
        The gravity (x, y) [m/s2], 9.80665 downwards by default; a load case may replace or turn it.
    """

    point: Reference
    mass: Parameter
    gravity: tuple[float, float] = DOWN
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"mass": "kg"})
    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType({"gravity": "gravity"})
    not_negative: ClassVar[frozenset[str]] = frozenset({"mass"})

    def __post_init__(self) -> None:
        super().__post_init__()
        object.__setattr__(self, "gravity", gravity_vector(self.gravity, "Weight"))

    @by_speeds
    def moving(self, motion: Poses, rates: Rates) -> list[Load]:
        point, mass = name_of(self.point), self.number(motion, "mass")
        return shared_mass(motion, (point,), mass, self.gravity, rates)

    def glyphs(self, members: Mapping[str, Member]) -> tuple[Glyph, ...]:
        return (Glyph("weight", (name_of(self.point),)),)

    def in_gravity(self, gravity: tuple[float, float] | None, slope: float) -> Weight:
        return self.renewed(gravity=on_slope(self.gravity if gravity is None else gravity, slope))


def gravity_vector(given: object, what: str) -> tuple[float, float]:
    """Return gravity as a vector [m/s2]; DefinitionError for anything but two finite numbers."""
    if is_number(given):
        raise DefinitionError(f"{what}: gravity={given!r} has no direction; write the vector gravity=(0, {-abs(plain(given))!r}).")
    x, y = (plain(part) for part in two_parts(given, f"{what}(gravity=...)"))
    require_measure(given, "m/s2", f"{what}: gravity")
    require(is_number(x) and is_number(y), f"{what}: gravity", given, "is not two finite numbers; write (x, y) in m/s2, such as (0, -9.81)")
    return x, y


def on_slope(gravity: tuple[float, float], slope: float) -> tuple[float, float]:
    """Return gravity on ground that rises towards +x by a slope [rad], in axes that lie along the ground [m/s2]."""
    x, y = gravity
    return x * cos(slope) + y * sin(slope), y * cos(slope) - x * sin(slope)


class Directed(ForceElement):
    """The base of loads along a direction that is given in the frame's axes, or in those of a part."""

    axes: ClassVar[Axes | None] = None

    def in_axes(self, axes: Axes) -> Self:
        return self if axes.are_upright else self.renewed(axes=axes.composed(self.axes))

    def parts(self) -> tuple[Reference, ...]:
        return super().parts() if self.axes is None else (*super().parts(), *self.axes.parts())

    def in_the_whole(self, motion: Poses, x: Array | float, y: Array | float) -> Array:
        """Return a vector that is given in the axes of a part in those of the frame, shape (2, ...)."""
        axes = self.axes
        if axes is None:
            return vector(1.0, (x, y))
        x = -np.asarray(x) if axes.mirrored else x
        if not axes.is_level:
            way = motion.value(axes.angle)
            cos, sin = np.cos(way), np.sin(way)
            x, y = x * cos - y * sin, x * sin + y * cos
        if axes.carrier:
            P, Q = axes.carrier
            along = (motion[Q] - motion[P]) / motion.distance(P, Q)
            x, y = x * along[0] - y * along[1], x * along[1] + y * along[0]
        return vector(1.0, (x, y))


@immutable
class Force(Directed):
    """A force at a point, its direction fixed to the frame: `pull = Force(F, (-5 * kN, 0))`.

    Parameters
    ----------
    point : Point or str
        The point.
    vector : tuple of float or quantity
        The parts (x, y) [N], design variables: `pull.x`, `pull.y`, or `pull=(x, y)` at once.
    """

    point: Reference
    vector: tuple[Parameter, Parameter]
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"x": "N", "y": "N"})
    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType({"vector": "force vector"})

    def __post_init__(self) -> None:
        object.__setattr__(self, "vector", two_parts(unmasked(self.vector), "Force"))  # parts of its own: one of them may be set
        super().__post_init__()

    @property
    def x(self) -> Parameter:
        """The force's part to the right [N]."""
        return self.vector[0]

    @property
    def y(self) -> Parameter:
        """The force's part upwards [N]."""
        return self.vector[1]

    def having(self, values: Mapping[str, float]) -> Force:
        return self.renewed(vector=(values.get(f"{self.name}.x", self.x), values.get(f"{self.name}.y", self.y)))

    def glyphs(self, members: Mapping[str, Member]) -> tuple[Glyph, ...]:
        return (Glyph("force", (name_of(self.point),)),)

    def loads(self, motion: Poses) -> list[Load]:
        return [Load(name_of(self.point), self.in_the_whole(motion, self.number(motion, "x"), self.number(motion, "y")))]

    def __str__(self) -> str:
        return f"Force({label(self.point)}, ({value_text(self.x)}, {value_text(self.y)}))"


@immutable
class Support(Directed):
    """A support that pushes a point along a direction, such as the ground under a shoe: `shoe = Support(R, (0, 1))`.

    Its reaction is what `reaction(motion, loads, support)` finds. Under a fixed point it bears the frame, a vehicle with a Weight at fixed
    points, and its reaction is an axle load.

    Parameters
    ----------
    point : Point or str
        The point.
    direction : tuple of float
        The direction (x, y), of which only the sense counts.
    force : float or quantity, optional
        The force [N] that it is taken to have where its reaction is not looked for, 0 by default.
    stiffness : float or quantity, optional
        The stiffness [N/m], which three or more supports of a frame need.
    friction : float or quantity, optional
        The coefficient of friction by which the ground holds along itself.
    """

    point: Reference
    direction: tuple[float, float]
    force: Parameter = 0.0
    stiffness: Parameter | None = None
    friction: Parameter | None = None
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"force": "N", "stiffness": "N/m", "friction": ""})
    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType({"direction": "pair"})
    not_negative: ClassVar[frozenset[str]] = frozenset({"stiffness", "friction"})
    limited: ClassVar[Mapping[str, str]] = MappingProxyType({"friction": "friction"})
    optional: ClassVar[frozenset[str]] = frozenset({"stiffness", "friction"})
    shown_by: ClassVar[str] = "linkage.statics.vehicle:AxleLoad"

    def __post_init__(self) -> None:
        super().__post_init__()
        x, y = two_parts(self.direction, "Support")
        try:
            size = np.hypot(real(x), real(y))
        except ValueError:
            size = np.zeros(())
        if not (np.all(np.isfinite(size)) and np.all(size > 0.0)):
            said = f"the direction {cited(self.direction)} has no finite length above zero"
            raise DefinitionError(f"Support: {said}; write one such as (0, 1).")
        if is_number(self.stiffness) and not plain(self.stiffness) > 0.0:
            raise DefinitionError("Support: stiffness=0 carries nothing; give one above zero in N/m, or leave it out.")

    def glyphs(self, members: Mapping[str, Member]) -> tuple[Glyph, ...]:
        return (Glyph("support", (name_of(self.point),), way=float(np.arctan2(self.unit[1], self.unit[0]))),)

    @property
    def unit(self) -> Array:
        """The direction, of length one, shape (2,)."""
        direction = np.asarray(self.direction, float)
        return np.asarray(direction / np.hypot(*direction))

    def pushes_along(self, motion: Poses) -> Array:
        """Return the direction in the axes of the frame, of length one, shape (2, ...) to broadcast against the motion.

        Parameters
        ----------
        motion : Motion
            The poses; designs first, strokes last.

        Returns
        -------
        ndarray
            The unit vector, shape (2, ...).
        """
        return self.in_the_whole(motion, self.unit[0], self.unit[1])

    def bounds(self, motion: Poses, lifting: bool, *, share: float = 1.0) -> tuple[Array, Array]:
        """Return the bounds of its reaction [N]: it pushes, and never pulls.

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
            The lowest and the highest reaction [N].
        """
        return np.zeros(()), np.asarray(np.inf)

    def loads(self, motion: Poses) -> list[Load]:
        way = self.pushes_along(motion)
        return [Load(name_of(self.point), vector(self.number(motion, "force"), (way[0], way[1])))]

    def __str__(self) -> str:
        x, y = two_parts(self.direction, "Support")
        return f"Support({label(self.point)}, ({value_text(x)}, {value_text(y)}), {', '.join(self.words())})"


def vector(size: Array | float, direction: tuple[Array | float, Array | float]) -> Array:
    """Return a size times a direction, shape (2, ...)."""
    return np.stack(np.broadcast_arrays(*(size * part for part in direction)))


def shared_mass(
    motion: Poses, points: tuple[str, ...], mass: Array | float, gravity: tuple[float, float], rates: Rates, on: tuple[str, ...] = ()
) -> list[Load]:
    """Return the loads of a mass shared by some points: its weight, and its inertia where accelerations are known.

    Two points are the ends of a uniform bar, which may stretch. Others are points with equal masses.
    """
    felt = [gravity for _ in points]
    if rates.accelerations is not None:
        each = [motion.acceleration(point, rates, rates.accelerations) for point in points]
        if len(points) == 2:
            each = [(2.0 * each[0] + each[1]) / 3.0, (each[0] + 2.0 * each[1]) / 3.0]
        felt = [(gravity[0] - own[0], gravity[1] - own[1]) for own in each]
    return [Load(point, vector(mass, own) / len(points), on) for point, own in zip(points, felt, strict=True)]


SIZE_ALONE = " A size alone has no direction: downwards it is (0, -8 * kN)."


def two_parts(given: object, what: str) -> tuple[Parameter, Parameter]:
    """Return a vector's parts; DefinitionError unless there are two."""
    parts = two_of(given)
    if not parts or np.ma.is_masked(given):
        raise DefinitionError(f"{what}: {cited(given)} is not a vector; write (x, y).{SIZE_ALONE if isinstance(given, Amount) else ''}")
    x, y = parts
    return x, y


# What acts on a body as a whole: a moment, its own mass.

Body: TypeAlias = "Reference | tuple[Reference, ...]"
"""A link, its name, or points of the body: `arm`, `"arm"`, `"O B"`, `(O, B)`."""


class OnBody(ForceElement):
    """An element on a body that is named by a link or by its points."""

    places: ClassVar[tuple[str, ...]] = ()
    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType({"link": "body"})
    link: Body

    def body_references(self) -> tuple[Reference, ...]:
        """Return the names of the body: a link, or two or more points."""
        given = tuple(self.link.split()) if isinstance(self.link, str) else self.link
        return given if isinstance(given, tuple) else (given,)

    def parts(self) -> tuple[Reference, ...]:
        return (*self.body_references(), *super().parts())

    def examine(self, members: Mapping[str, Member], title: str) -> None:
        self.points(members, title)

    def points(self, members: Mapping[str, Member], title: str) -> tuple[str, ...]:
        """Return the body's points; DefinitionError for names of no body."""
        names = tuple(name_of(each) for each in self.body_references())
        for name in names:
            if name not in members:
                known = [each for each, member in members.items() if isinstance(member, (Link, Point))]
                raise unknown("Link or point", name, known, where=title)
        found = tuple(members[name] for name in names)
        if len(found) == 1 and isinstance(found[0], Link):
            return found[0].point_names
        if len(set(names)) < 2 or not all(isinstance(each, Point) for each in found):
            raise DefinitionError(f"{title}: {self}: {' '.join(names)} is not a body; name a link, or two of its points such as 'O B'.")
        return names

    def axis(self, motion: Poses) -> tuple[str, str, Array]:
        """Return two points P and Q of the body and Q - P, shape (2, ...) [m]: the body's own x axis.

        DefinitionError for points of different bodies; those of no declared body, and of what follows a stroke, may stand.
        """
        plan = motion.plan
        points = self.points(plan.members, plan.title)
        bodies = [set(body.points) for body in plan.links]
        rams = [{bar.P, bar.Q} for bar in plan.cylinders]
        rams += [{joint.point for joint in element.joints()} for element in plan.of_kind(ForceElement).values()]
        free = set(plan.telescopes) | (set(points) - set().union(*bodies))
        if not free and not any(set(points) <= body for body in (*bodies, *rams)):
            what = f"{self.name} = {self}" if self.name else str(self)
            raise DefinitionError(f"{plan.title}: {what}: {', '.join(points)} are not points of one body; name those of one.")
        P, Q, *_ = points
        arm = motion[Q] - motion[P]
        if np.any((arm[0] == 0.0) & (arm[1] == 0.0)):
            raise DefinitionError(f"{self.name} = {self}: {P} and {Q} coincide and give no direction; name two other points of the body.")
        return P, Q, arm

    def __str__(self) -> str:
        return f"{type(self).__name__}({', '.join([repr(' '.join(map(label, self.body_references()))), *self.words()])})"


@immutable
class Moment(OnBody):
    """A moment on a body: `drag = Moment(arm, M=-250)` or `Moment("O B", M=-250)`.

    Parameters
    ----------
    link : Link or str
        The body, or the names of two of its points.
    M : float or quantity
        The moment [N m], counter-clockwise, a design variable.
    """

    link: Body
    M: Parameter
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"M": "Nm"})

    sense: ClassVar[float] = 1.0
    """Whether it is counted counter-clockwise, 1, or in a part that is mirrored clockwise, -1."""

    def in_axes(self, axes: Axes) -> Moment:
        return self.renewed(sense=-self.sense) if axes.mirrored else self

    def glyphs(self, members: Mapping[str, Member]) -> tuple[Glyph, ...]:
        return (Glyph("moment", self.points(members, "")),)

    def loads(self, motion: Poses) -> list[Load]:
        return couple(*self.axis(motion), self.sense * self.number(motion, "M"))


@immutable
class LinkMass(OnBody, LawElement):
    """A body's own mass at its centre of gravity: `own = LinkMass("E D F", mass=30)`.

    Parameters
    ----------
    link : Link or str
        The body, or the names of its points.
    mass : float or quantity
        The mass [kg], a design variable.
    at : tuple of float, optional
        The centre (along, across) [m] in the body's axes: from the first point that is named here towards the second, and to the left of
        that; of `"O B T"` from O towards B. By default it lies in the middle of the points named. Each then bears an equal share, so
        that the mass of a cylinder or a telescope goes out with its ends.
    gravity : tuple of float, optional
        The gravity (x, y) [m/s2], as for a Weight.
    inertia : float or quantity, optional
        The body's own moment of inertia about that centre [kg m2]. Without it the mass is a point where `at` is given, two points are a
        uniform bar, also one that stretches, and three and more have equal masses.
    """

    link: Body
    mass: Parameter
    at: tuple[float, float] | None = None
    gravity: tuple[float, float] = DOWN
    inertia: Parameter | None = None
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"mass": "kg", "inertia": "kg m2"})
    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType({"at": "pair", "gravity": "gravity"})
    not_negative: ClassVar[frozenset[str]] = frozenset({"mass", "inertia"})
    optional: ClassVar[frozenset[str]] = frozenset({"inertia"})

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.at is not None and not all(map(is_number, two_parts(self.at, "LinkMass(at=...)"))):
            raise DefinitionError(f"LinkMass: at={cited(self.at)} is not a place; write (along, across) in m.")
        require_measure(self.at, "length", "LinkMass: at")
        if self.inertia is not None and self.at is None:
            what = "LinkMass: inertia= is about the centre of gravity, and at= does not say where that is"
            raise DefinitionError(f"{what}; write at=(along, across) in m, or leave inertia= out for a uniform bar.")
        object.__setattr__(self, "gravity", gravity_vector(self.gravity, "LinkMass"))

    def glyphs(self, members: Mapping[str, Member]) -> tuple[Glyph, ...]:
        return (Glyph("mass", self.points(members, ""), away=self.at),)

    @by_speeds
    def moving(self, motion: Poses, rates: Rates) -> list[Load]:
        P, Q, arm = self.axis(motion)
        mass = self.number(motion, "mass")
        if self.at is None:
            return shared_mass(motion, self.points(motion.plan.members, motion.plan.title), mass, self.gravity, rates, (P, Q))
        along, (x, y) = arm / np.hypot(arm[0], arm[1]), self.gravity
        r = along * float(self.at[0]) + np.stack([-along[1], along[0]]) * float(self.at[1])
        turning: Array | None = None
        if rates.accelerations is not None:
            start = motion.acceleration(P, rates, rates.accelerations)
            moved = motion.velocity(Q, rates) - motion.velocity(P, rates)
            change = motion.acceleration(Q, rates, rates.accelerations) - start
            square, stretching = arm[0] ** 2 + arm[1] ** 2, arm[0] * moved[0] + arm[1] * moved[1]
            spin = (arm[0] * moved[1] - arm[1] * moved[0]) / square
            angular = (arm[0] * change[1] - arm[1] * change[0] - 2.0 * stretching * spin) / square  # of a line that may stretch
            centre = start + np.stack([-r[1], r[0]]) * angular - r * spin**2
            x, y = x - centre[0], y - centre[1]
            turning = None if self.inertia is None else self.number(motion, "inertia") * angular
        force = vector(mass, (x, y))
        moment = r[0] * force[1] - r[1] * force[0]
        return [Load(P, force, (P, Q)), *couple(P, Q, arm, moment if turning is None else moment - turning)]

    def in_axes(self, axes: Axes) -> LinkMass:
        return self.renewed(at=(self.at[0], -self.at[1])) if axes.mirrored and self.at is not None else self

    def in_gravity(self, gravity: tuple[float, float] | None, slope: float) -> LinkMass:
        return self.renewed(gravity=on_slope(self.gravity if gravity is None else gravity, slope))


# Dry friction of pins and guides: it acts against the motion, in proportion to the force it helps to make.


ONE_COEFFICIENT = "One joint has one coefficient: take one of them out, and scale the other in the load cases where it differs."
THICKEST = 3.0
"""m; the radius of a larger pin was given in millimetres."""


@immutable
class PinFriction(LawElement):
    """Friction in a pin: the moment coefficient * radius * pin force, against the relative turning.

    A pin of more than two bodies sits fast in the first of them (the frame, if it is one): the others turn on it.

    Parameters
    ----------
    point : Point or str
        The pin.
    radius : float or quantity
        The pin's radius [m].
    coefficient : float or quantity
        The coefficient of friction.
    """

    point: Reference
    radius: Parameter
    coefficient: Parameter
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"radius": "mm", "coefficient": ""})
    not_negative: ClassVar[frozenset[str]] = frozenset({"radius", "coefficient"})
    limited: ClassVar[Mapping[str, str]] = MappingProxyType({"coefficient": "friction"})

    def __post_init__(self) -> None:
        super().__post_init__()
        if is_number(self.radius) and self.radius > THICKEST:
            large = f"{self.radius:.6g}"
            raise DefinitionError(f"PinFriction: radius={large} m is more than any pin has; write {large} * mm if these are millimetres.")

    def frictions(self, motion: Poses) -> list[Friction]:
        return [Friction(name_of(self.point), self.number(motion, "coefficient"), self.number(motion, "radius"))]

    def claims(self, members: Mapping[str, Member]) -> Mapping[Hashable, str]:
        return {("pin", name_of(self.point)): f"are the friction of the pin {name_of(self.point)}. {ONE_COEFFICIENT}"}


@immutable
class GuideFriction(LawElement):
    """Friction of a point on the guides and slots it runs on: coefficient * normal force, against the relative sliding.

    Parameters
    ----------
    point : Point or str
        The point that slides.
    coefficient : float or quantity
        The coefficient of friction.
    guide : Guide or str, optional
        One of its guides, where the point runs on several.
    """

    point: Reference
    coefficient: Parameter
    guide: Reference = ""
    parameters: ClassVar[Mapping[str, str]] = MappingProxyType({"coefficient": ""})
    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType({"guide": "guide"})
    not_negative: ClassVar[frozenset[str]] = frozenset({"coefficient"})
    limited: ClassVar[Mapping[str, str]] = MappingProxyType({"coefficient": "friction"})

    def __post_init__(self) -> None:
        super().__post_init__()
        require_type("GuideFriction: guide", self.guide, (str, Member), "is neither a guide nor the name of one")

    def parts(self) -> tuple[Reference, ...]:
        return (*super().parts(), *([self.guide] if self.guide != "" else []))

    def words(self) -> list[str]:
        return [f"guide={label(self.guide)}" if word.startswith("guide=") else word for word in super().words()]

    def frictions(self, motion: Poses) -> list[Friction]:
        return [Friction(name_of(self.point), self.number(motion, "coefficient"), guide=name_of(self.guide))]

    def claims(self, members: Mapping[str, Member]) -> Mapping[Hashable, str]:
        point, guide = name_of(self.point), name_of(self.guide)
        words = f"are the friction of {point} on {guide or 'its guides'}. {ONE_COEFFICIENT}"
        return {("guide", point, each): words for each in ([guide] if guide else ["", *members])}  # without a guide: on all there are
