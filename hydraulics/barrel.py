"""The two bodies of a cylinder, its barrel and its rod, and the points on them that others may hang on.

The barrel goes with A, the rod with B. Each has axes of its own: along its axis, from its own pin into the cylinder, and across to the
left of that way. Both are taken as long as the cylinder is closed: the barrel ends at the gland, the rod at its piston.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Any, ClassVar, Self

from linkage.errors import DefinitionError, unknown
from linkage.frozen import immutable
from linkage.language import noted
from linkage.loads import Glyph, Halves, Load, Parameter, Poses, Rates, TwoPoint
from linkage.loads.element import by_speeds
from linkage.loads.point import DOWN, on_slope, shared_mass
from linkage.quantities import Axes, Member, NamedMembers, Operand, Quantity, Reference, Where, label, name_of, quantity, source_text
from linkage.steps import Link, Point
from linkage.units import mm
from linkage.vectors import Vec

GLAND, PISTON = "gland", "piston"
"""The points at which a barrel and a rod end in the cylinder, as `lift.gland`."""
BARREL, ROD = "barrel", "piston_rod"
"""The bodies of a cylinder, as `lift.barrel`."""
HELD: Mapping[str, str] = MappingProxyType({BARREL: "link", ROD: "link", GLAND: "point", PISTON: "point"})
"""What a cylinder of two bodies holds by names of its own, each with its kind."""
MASSES: Mapping[str, str] = MappingProxyType({"barrel_mass": "kg", "rod_mass": "kg"})
"""The masses of both bodies with their unit."""


class BarrelAndRod(TwoPoint):
    """The side of a cylinder that is two bodies, where it has masses, points on them, or masses of their own are declared for them."""

    count: int
    closed: Parameter | None
    _gravity: ClassVar[tuple[float, float]] = DOWN
    """What its own masses weigh by [m/s2]."""

    @property
    def barrel(self) -> BodyOf:
        """The body on A, for a LinkMass or a Moment: its axes begin in A and go to B."""
        return BodyOf(self, BARREL)

    @property
    def piston_rod(self) -> BodyOf:
        """The body on B, for a LinkMass or a Moment: its axes begin in B and go to A."""
        return BodyOf(self, ROD)

    @property
    def _inner_ends(self) -> tuple[str, str]:
        """The points at which both bodies end in the cylinder."""
        return f"{self.name}.{GLAND}", f"{self.name}.{PISTON}"

    @property
    def _masses(self) -> dict[str, tuple[str, str]]:
        """The points that share each of its masses, by the name of the mass."""
        bodies = zip(MASSES, self.ends, self._inner_ends, strict=True)
        return {name: (pin, end) for name, pin, end in bodies if self.given(name) is not None}

    def parts(self) -> tuple[Reference, ...]:
        has_masses = any(self.given(name) is not None for name in MASSES)
        return (*super().parts(), *(self._inner_ends if self.name and has_masses else ()))

    def inner(self, name: str, members: NamedMembers) -> Member | None:
        A, B = self.ends
        gland, piston = self._inner_ends
        if name in (BARREL, ROD):
            return Link(A, gland) if name == BARREL else Link(B, piston)
        if name == GLAND:
            return OnBarrel(self.name, self._closed_written()).renewed(ends=(A, B))
        if name == PISTON:
            return OnRod(self.name, self._closed_written()).renewed(ends=(B, A))
        return super().inner(name, members)

    def _closed_written(self) -> Quantity:
        """Return its closed length as a quantity of its class; DefinitionError where it has none."""
        if self.closed is None:
            what = f"{self.name} is a barrel and a rod here, which are as long as it is closed, and its closed length is not given"
            raise DefinitionError(f"{what}; add closed=... in m.", member=self.name)
        return self.written("closed")

    @property
    def scales(self) -> bool:
        return any(self.given(name) is not None for name in MASSES) or super().scales

    def halves(self, members: NamedMembers) -> Halves | None:
        if not self.name or self._inner_ends[0] not in members:
            return None
        names, labels = (f"{self.name} barrel", f"{self.name} rod"), (f"{self.name}.{BARREL}", f"{self.name}.{ROD}")
        return Halves(names, labels, self._inner_ends, (noted("gland"), noted("oil")))

    @by_speeds
    def moving(self, motion: Poses, rates: Rates) -> list[Load]:
        """Return the weights of its barrel and its rod, each half at its own pin, half at its other end; and their inertia."""
        found = []
        for name, points in self._masses.items():
            if points[1] not in motion.plan.members:
                what = f"{self}: a mass of a barrel or a rod is on a body of the class"
                raise DefinitionError(f"{what}; declare this cylinder in {motion.plan.title}.")
            found += shared_mass(motion, points, self.count * self.number(motion, name), self._gravity, rates, points)
        return found

    def in_gravity(self, gravity: tuple[float, float] | None, slope: float) -> Self:
        return self.renewed(_gravity=on_slope(self._gravity if gravity is None else gravity, slope)) if self._masses else self

    def glyphs(self, members: NamedMembers) -> tuple[Glyph, ...]:
        return (*super().glyphs(members), *(Glyph("mass", points) for points in self._masses.values() if points[1] in members))


@immutable
class BodyOf(Member):
    """A body of a cylinder, for a LinkMass or a Moment: `lift.barrel`, `lift.piston_rod`, by their names too, "lift.barrel"."""

    owner: Reference
    own: str
    kind: ClassVar[str] = "link"

    @property
    def name(self) -> str:
        owner = name_of(self.owner, is_needed=False)
        return f"{owner}.{self.own}" if owner else ""

    def parts(self) -> tuple[Reference, ...]:
        return (self.owner,)

    def __str__(self) -> str:
        return f"{label(self.owner)}.{self.own}"


class OnCylinder(Point):
    """A point on a body of a cylinder, the base of OnBarrel and OnRod.

    Parameters
    ----------
    cylinder : Cylinder or str
        The cylinder.
    along : float or quantity
        The distance along its axis [m] from the body's own pin.
    across : float or quantity, optional
        The distance from the axis [m], to the left of that direction; 0 by default.

    Raises
    ------
    DefinitionError
        `along` or `across` is not finite, or what is named has no barrel and no rod.
    """

    expects = (("cylinder", "load"),)
    what: ClassVar[str] = "the barrel"
    """The body, in words."""
    is_on_A: ClassVar[bool] = True
    """Whether the body's own pin is A: a barrel, which goes on behind that pin where it is on trunnions."""
    ends: tuple[str, ...] = ()
    """The body's own pin and that of the other one, as the class has them."""
    is_mirrored: bool = False
    """Whether it stands in a part that is mirrored, so that it lies on the other side."""

    def __init__(self, cylinder: Reference, along: Operand, across: Operand | None = None) -> None:
        self.cylinder, self.along = cylinder, quantity(along)
        self.across = None if across is None else quantity(across)
        for value in (self.along, self.across):
            if value is not None and value.constant is not None and not abs(value.constant) < float("inf"):
                raise DefinitionError(f"{self}: along and across are finite numbers [m].")

    def among(self, members: NamedMembers) -> Self:
        called = name_of(self.cylinder)
        if called not in members:
            having = (name for name, each in members.items() if GLAND in each.inside)
            raise unknown("Cylinder", called, having, where=self.name)
        found = members[called]
        if not isinstance(found, TwoPoint) or GLAND not in found.inside:
            raise DefinitionError(f"{self.name} = {self}: {called} has no barrel and no rod; name a Cylinder.", member=self.name)
        return self.renewed(ends=found.ends if self.is_on_A else found.ends[::-1])

    def numbers(self) -> tuple[tuple[str, Quantity], ...]:
        """Return its dimensions with their names: `K.along`, and `K.across` where that is given."""
        given = (("along", self.along), ("across", self.across))
        return tuple((f"{self.name}.{name}", value) for name, value in given if value is not None)

    def parts(self) -> tuple[Reference, ...]:
        gland = f"{name_of(self.cylinder)}.{GLAND}"
        numbers = tuple(value for _, value in self.numbers() if not value.is_constant)
        owner: tuple[Reference, ...] = () if self.name.startswith(f"{name_of(self.cylinder)}.") else (self.cylinder, gland)
        return (*self.ends, *numbers, *owner)

    def variables(self) -> tuple[tuple[str, float, str, str], ...]:
        return tuple((name, value.constant, "coordinate", "") for name, value in self.numbers() if value.constant is not None)

    def having(self, values: Mapping[str, float]) -> Self:
        given = {name.rpartition(".")[2]: quantity(values[name]) for name, _ in self.numbers() if name in values}
        return self.renewed(**given) if given else self

    def faults(self, members: NamedMembers) -> Iterator[str]:
        """Yield that it is beyond the ends of its body."""
        closed: Any = getattr(members[name_of(self.cylinder)], "closed", None)
        if self.along.constant is None or not quantity(closed).is_constant:
            return
        along, long = self.along.constant, float(closed)
        if along > long or along < (-long if self.is_on_A else 0.0):
            beyond = "its pin" if along < 0.0 else f"its end, {long / mm:.6g} mm from there"
            there = f"{along / mm:.6g} mm along {self.what}, counted from {self.ends[0]} towards {self.ends[1]}, is beyond {beyond}"
            yield f"{there}. Take a point on it, or measure it on the body that {self.ends[0]} belongs to"

    def in_axes(self, axes: Axes) -> Self:
        return self.renewed(is_mirrored=not self.is_mirrored) if axes.mirrored else self

    def bodies(self) -> tuple[tuple[str, ...], ...]:
        return ((*self.ends, self.name),)

    def place(self, where: Where) -> Vec:
        P, Q = self.ends
        start = where.at(P)
        way = (where.at(Q) - start) * (1.0 / where.link_length(P, Q))
        along, *across = (where.input(name) if value.is_constant else where.value(value) for name, value in self.numbers())
        found: Vec = start + way * along
        for each in across:
            found = found + way.left() * (-each if self.is_mirrored else each)
        return found

    def __str__(self) -> str:
        across = "" if self.across is None else f", {source_text(self.across)}"
        return f"{type(self).__name__}({label(self.cylinder)}, {source_text(self.along)}{across})"


class OnBarrel(OnCylinder):
    """A point on the barrel of a cylinder: `K = OnBarrel(lift, 0.35, 0.08)`.

    `along` [m] is counted from A towards B, below zero behind A as on trunnions, `across` [m] to the left of A -> B. Both are design
    variables, `K.along` and `K.across`.
    """


class OnRod(OnCylinder):
    """A point on the rod of a cylinder: `K = OnRod(lift, 0.1)`.

    `along` [m] is counted from B towards A, `across` [m] to the left of B -> A. Both are design variables, `K.along` and `K.across`.
    """

    what = "the rod"
    is_on_A = False
