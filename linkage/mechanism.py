"""A mechanism: its class is the structure, an instance its dimensions."""

from __future__ import annotations

from abc import ABCMeta
from collections.abc import Mapping, Sequence
from copy import copy
from typing import Any, ClassVar, Self

import numpy as np

from .assembly import Assembly, assembled, assemblies
from .errors import DefinitionError, unknown
from .graph import Body
from .mobility import FourBar, Mobility, check, four_bars, mobility
from .motion import (
    Column,
    Grid,
    Motion,
    PoseFunction,
    Request,
    as_given,
    at_values,
    columns_of,
    evaluate,
    function_of,
    source_of,
    sweep_values,
)
from .plan import Plan
from .program import FloatArray, Way
from .quantities import Member, Stroke
from .steps import Drawn


class Structure(ABCMeta):
    """The class of the classes of mechanism: what a class is made of does not change once it is made."""

    plan: Plan

    def __setattr__(cls, name: str, value: Any) -> None:
        if isinstance(value, Member) or cls._is_made_of(name):
            raise cls._unchanging(name, "= ...")
        super().__setattr__(name, value)

    def __delattr__(cls, name: str) -> None:
        if cls._is_made_of(name):
            raise cls._unchanging(name, "is deleted")
        super().__delattr__(name)

    def _is_made_of(cls, name: str) -> bool:
        return name == "plan" or isinstance(getattr(cls, name, None), Member) or name in cls.plan.members

    def _unchanging(cls, name: str, what: str) -> DefinitionError:
        remedy = f"write a subclass, class Other({cls.__name__}): {name} = ..."
        return DefinitionError(f"{cls.__name__}.{name} {what}: {cls.__name__} is worked out already and would not follow; {remedy}.")


class Mechanism(metaclass=Structure):
    """The base of every mechanism. A subclass declares points, links and strokes, one line each, in any order.

    An instance is a design: `ThreePointHitch(OB=0.32)`; every keyword is a dimension by its name [SI], a float or
    an array of designs. A subclass of a mechanism is a variant: it replaces members by name and adds others.
    """

    plan: ClassVar[Plan] = Plan({}, "Mechanism")

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        members = declared(cls)
        type.__setattr__(cls, "plan", Plan(assembled(members, cls.__name__), cls.__name__))
        for name in cls.plan.strokes:
            if not any(name in cls.plan.reaches(point) for point in cls.plan.moving) and cls.plan.points:
                raise DefinitionError(f"{cls.__name__}: the stroke {name} moves nothing; use it in a length or an angle, or take it out.")
        for name, sketch in cls.plan.of_kind(Drawn).items():
            try:
                at_values(cls.plan.sketch_strokes, cls.plan)
            except DefinitionError as error:
                raise DefinitionError(f"{cls.__name__}: {name} = {sketch}: {error}") from None
        check(cls.plan)
        for member in (*members.values(), *cls.plan.members.values()):
            member.settle(cls.__name__)

    def __init__(self, **dimensions: Any) -> None:
        for name in dimensions:
            if name in self.plan.strokes:
                error = unknown("Dimension", name, self.plan.table.names(), where=self.plan.title)
                raise DefinitionError(f"{error} {name} is a stroke; give it to sweep({name}=...) or at({name}=...).")
        self._values = self.plan.table.settings(dimensions)

    def __setattr__(self, name: str, value: Any) -> None:
        if not name.startswith("_"):
            new = f"{type(self).__name__}({name}=...)"
            raise DefinitionError(f"{type(self).__name__}.{name} = ...: an instance does not change; make a new one, {new}.")
        super().__setattr__(name, value)

    @property
    def dimensions(self) -> Mapping[str, Any]:
        """Every design variable with its value [SI]."""
        return dict(self._values)

    def __getitem__(self, name: str) -> Any:
        """Return a design variable's value [SI]; a fixed point's position, shape (2, ...)."""
        if not isinstance(name, str):
            raise unknown("Dimension", name, self.plan.table.names(), where=self.plan.title)
        if {f"{name}.x", f"{name}.y"} <= self._values.keys():
            return np.array(np.broadcast_arrays(self._values[f"{name}.x"], self._values[f"{name}.y"]))
        owner, sign = self.plan.table.spellings.get(name, ("", 1))
        if not owner:
            self.plan.table.settings({name: 0.0})
        return sign * self._values[owner]

    def replaced(self, **dimensions: Any) -> Self:
        """Return the same design with some dimensions changed."""
        changed = type(self)(**dimensions)
        touched = {owner for name, value in dimensions.items() for owner in changed._owners(name)}
        changed._values = {name: changed._values[name] if name in touched else value for name, value in self._values.items()}
        return changed

    def _part(self, start: int, stop: int) -> Self:
        """Return the designs from start to before stop of a batch, whose dimensions are floats or arrays (m,)."""
        part = copy(self)
        part._values = {name: value if type(value) is float else value[start:stop] for name, value in self._values.items()}
        return part

    def _owners(self, name: str) -> set[str]:
        spellings = self.plan.table.spellings
        return {spellings[each][0] for each in (name, f"{name}.x", f"{name}.y") if each in spellings}

    def sweep(self, count: int | None = None, /, *, unreachable: str = "raise", **strokes: Any) -> Motion:
        """Return the motion over the whole stroke, at `count` poses.

        With several strokes each is named: `sweep(S1=101, S2=0.15)`, an int is a count, a float a value; two
        counts give a grid. Raises AssemblyError where it cannot be assembled, unless `unreachable="nan"`.
        """
        return Motion(self.plan, self._values, sweep_values(count, strokes, self.plan), unreachable)

    def at(self, *, unreachable: str = "raise", **strokes: Any) -> Motion:
        """Return the motion at chosen strokes [SI]: `at(S=[0.0, 0.1])`. They may lie beyond the declared range."""
        return Motion(self.plan, self._values, at_values(strokes, self.plan), unreachable)

    def evaluate(
        self,
        of: Sequence[Request],
        *,
        out: FloatArray | None = None,
        unreachable: str = "raise",
        backend: str | None = None,
        threads: int = 1,
        **strokes: Any,
    ) -> list[FloatArray]:
        """Return values, ratios and forces of many poses in one pass, nothing else: `G, T = evaluate(["G", thrust()], S=...)`.

        One array a request, shape (2, *designs, *strokes) of a point, (*designs, *strokes) of a quantity. `out`, shape
        (components, *designs, *strokes), takes the results; the arrays returned are its rows. `backend` is "numpy", "numba"
        or "floats"; without it the quickest for the work, on one thread. Poses are taken one by one: unlike `at` it does not look for
        change points between them. Raises AssemblyError out of reach and SingularError for ratios at a dead point, unless
        `unreachable="nan"`.
        """
        grid = Grid(self.plan, self._values, at_values(strokes, self.plan, as_given), unreachable)
        return evaluate(grid, of, out, Way(backend, threads))

    def function(self, of: Sequence[Request]) -> PoseFunction:
        """Return values, ratios and forces of this design as a function of the strokes, in floats: `f = function(["G", ratio("G")])`.

        `f(0.1)` returns all components one after the other, here (G_x, G_y, dG_x, dG_y), in some microseconds: for root
        finders and other loops that take one pose at a time. It raises what `evaluate` raises.
        """
        return function_of(self.plan, self._values, of)

    def source(self, of: Sequence[Request], *, language: str = "c", name: str = "poses") -> str:
        """Return values and ratios as the text of a function in "c" or "javascript", for a controller or a page of one's own.

        Dimensions and strokes are its arguments, in the order that its first comment gives, SI and radians; NaN out of reach. Pins
        that are found by iteration have no closed form and are refused by name.
        """
        return source_of(self.plan, self._values, of, language, name)

    def columns(self, motion: Motion) -> list[Column]:
        """Return the table of results: strokes, moving points, named outputs. A machine replaces it by its own."""
        return columns_of(motion)

    def verdicts(self, motion: Motion) -> list[str]:
        """Return what an engineer should know of this motion, in sentences. A machine replaces it by its own."""
        return []

    @property
    def strokes(self) -> Mapping[str, Stroke]:
        """The strokes by name."""
        return dict(self.plan.strokes)

    def assemblies(self, **strokes: float) -> list[Assembly]:
        """Return all assembly modes of the dyads that exist at a stroke, `assemblies(S=0.1)`; default the start of each.

        One design at a time. Raises DefinitionError for more than 16 dyads.
        """
        pose = self.at(unreachable="nan", **{name: stroke.start for name, stroke in self.strokes.items()} | strokes)
        if pose.shape:
            raise DefinitionError(f"{self.plan.title}: assembly modes are listed for one design at one pose.")
        return assemblies(self.plan, pose.inputs)

    @property
    def four_bars(self) -> list[FourBar]:
        """The four-bars on the frame, each with its Grashof class."""
        return four_bars(self.plan, self.at(unreachable="nan", **self.plan.sketch_strokes).inputs)

    @property
    def links(self) -> tuple[Body, ...]:
        """The rigid bodies, the frame first."""
        return self.plan.links

    @property
    def mobility(self) -> int:
        """The number of independent motions, by the rank of the constraints; it equals the number of strokes."""
        return self.freedom.rank

    @property
    def freedom(self) -> Mobility:
        """The mobility by rank and by count, with the links that are redundant, in words."""
        return mobility(self.plan)

    @property
    def gruebler(self) -> int:
        """The Gruebler count 3 (n - 1) - 2 j."""
        return self.plan.gruebler

    def __repr__(self) -> str:
        changed = {name: value for name, value in self._values.items() if np.ndim(value) or value != self.plan.table.entries[name].default}
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in changed.items())})"


def declared(cls: type) -> dict[str, Member]:
    """Return the members of a class and its bases by name; a subclass replaces by name."""
    members: dict[str, Member] = {}
    for base in reversed(cls.__mro__):
        for name, value in vars(base).items():
            if isinstance(value, Member):
                if name in vars(Mechanism) or name in ("plan",):
                    raise DefinitionError(f"{cls.__name__}: {name} is a word of the framework; give the member another name.")
                members[name] = value
            elif name in members:
                del members[name]
    return members
