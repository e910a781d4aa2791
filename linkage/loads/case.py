"""Load cases: which loads count, how much, and where down is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import pi
from types import MappingProxyType
from typing import ClassVar, final

from ..checks import require_number, require_type
from ..errors import DefinitionError, cited, known_name, unknown
from ..frozen import keep_own, refuses_changes
from ..quantities import Member, Reference, in_degrees, is_number, name_of
from ..quantities.quantity import plain
from ..units import deg, require_measure
from .element import ForceElement
from .point import gravity_vector

PLAIN_CASE = "plain"
"""The name of the machine's own loads, without a load case."""
STEEPEST = 0.5 * pi * (1.0 + 1e-9)


@final
@refuses_changes
@dataclass(frozen=True, eq=False)
class LoadCase(Member):
    """A named choice of loads: `transport = LoadCase("transport", scale={"load": 2.0}, slope=10 * deg)`.

    `scale` multiplies loads by name, 0 leaves one out; `only` keeps those named and leaves out all others. `gravity` (x, y)
    [m/s2] replaces every element's own; without it each keeps its own. `slope` [rad] turns the gravity that applies: positive where the
    ground rises towards +x, so that weights also pull towards -x. `shut` names lines of oil or gas whose valves are shut: at each pose
    such a line keeps what it has there, holds, and its pressure is what the loads make of it.
    """

    kind: ClassVar[str] = "load case"
    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType(
        {"scale": "load factors", "only": "load list", "slope": "angle", "gravity": "gravity", "shut": "load list"}
    )
    title: str = ""
    scale: Mapping[str, float] = field(default_factory=dict)
    only: Sequence[Reference] | None = None
    slope: float = 0.0
    gravity: tuple[float, float] | None = None
    shut: Sequence[Reference] = ()

    def __post_init__(self) -> None:
        check_words(self.title, self.scale, self.only, self.shut)
        keep_own(self)
        for name, value in {**self.scale, "slope": self.slope}.items():
            require_number(f"LoadCase({self.title!r}): {name}", value, "is not a finite number")
            require_measure(value, "deg" if name == "slope" else "", f"LoadCase({self.title!r}): {name}")
        if abs(self.slope) > STEEPEST:
            said = f"slope={plain(self.slope)!r} rad is {self.slope / deg:.4g} deg, steeper than a wall"
            raise DefinitionError(f"{self.label}: {said}; write slope={plain(self.slope)!r} * deg if these are degrees.")
        if self.gravity is not None:
            object.__setattr__(self, "gravity", gravity_vector(self.gravity, self.label))

    @property
    def label(self) -> str:
        """What the case is called: its title, else its name in the class."""
        return self.title or self.name or "load case"

    @property
    def mentioned(self) -> tuple[str, ...]:
        """The names of the loads that it speaks of."""
        return (*self.scale, *(name_of(each) for each in self.only or ()))

    @property
    def shut_names(self) -> tuple[str, ...]:
        """The names of the lines that it shuts."""
        return tuple(name_of(each) for each in self.shut)

    def parts(self) -> tuple[Reference, ...]:
        return (*self.mentioned, *self.shut_names)

    def examine(self, members: Mapping[str, Member], title: str) -> None:
        """Raise DefinitionError for a name that is no load of the class."""
        loads = [name for name, member in members.items() if isinstance(member, ForceElement)]
        where = f"{title}.{self.name}"
        for name in self.mentioned:
            known_name("Load", name, loads, where=where)
        for name in self.scale:
            check_factor(self, name, members[name], where)
        shut_members(self, members, where)
        for name, other in members.items():
            if isinstance(other, LoadCase) and other is not self and self.label in (other.label, name):
                what = f"{self.name} and {name} are both called {self.label!r}, so that it does not tell which one is meant"
                raise DefinitionError(f"{title}: {what}; give one another title.")

    def factor(self, load: str) -> float:
        """Return what a load is multiplied by; 0 where it does not count."""
        kept = self.only is None or load in [name_of(each) for each in self.only]
        return float(self.scale.get(load, 1.0)) if kept else 0.0

    def on(self, element: ForceElement) -> ForceElement:
        """Return an element in the gravity of this case."""
        return element if self.gravity is None and not self.slope else element.in_gravity(self.gravity, self.slope)

    def __str__(self) -> str:
        scale = {name: plain(value) for name, value in self.scale.items()}
        words = [repr(self.title)] if self.title else []
        words += [f"scale={scale!r}"] if scale else []
        words += [f"only={[name_of(each) for each in self.only]!r}"] if self.only is not None and not isinstance(self.only, str) else []
        words += [f"slope={in_degrees(float(self.slope))}"] if is_number(self.slope) and self.slope else []
        words += [f"gravity={self.gravity!r}"] if self.gravity is not None else []
        words += [f"shut={[*self.shut_names]!r}"] if self.shut and not isinstance(self.shut, str) else []
        return f"LoadCase({', '.join(words)})"


def check_factor(case: LoadCase, name: str, element: object, where: str) -> None:
    """Raise DefinitionError for a factor of what carries the same whatever its factor is."""
    if isinstance(element, ForceElement) and not element.scales and case.scale.get(name, 1.0) != 1.0:
        what = f"scale={{{name!r}: {plain(case.scale[name])!r}}}: {name} is a {type(element).__name__}"
        says = "and holds or feeds whatever the loads need, so that a factor changes nothing"
        remedy = f"scale the loads instead, or write a variant without it, class Other(...): {name} = None"
        raise DefinitionError(f"{where}: {what} {says}; {remedy}.")


def shut_members(case: LoadCase, members: Mapping[str, Member], where: str) -> dict[str, Member]:
    """Return what a case shuts, as it is then, by name; DefinitionError for what cannot be shut, with what can."""
    elements = {name: each for name, each in members.items() if isinstance(each, ForceElement)} if case.shut else {}
    shut = {name: each.when_shut() for name, each in elements.items()}
    able = {name: each for name, each in shut.items() if each is not None}
    for name in case.shut_names:
        if name not in elements:
            raise unknown("Line", name, able, where=f"{where}, shut")
        if name not in able:
            can = f"what can be shut is {', '.join(able)}" if able else "no line is declared, such as line = OilLine(lift.rod_side, Tank())"
            raise DefinitionError(f"{where}: shut=[{name!r}]: {name} is a {type(elements[name]).__name__} and cannot be shut; {can}.")
    return {name: able[name] for name in case.shut_names}


def check_words(title: object, scale: object, only: object, shut: object) -> None:
    """Raise DefinitionError for a title that is no text, and for anything but a choice of loads."""
    if not isinstance(title, str):
        raise DefinitionError(f'LoadCase({cited(title)}): its title is expected first, LoadCase("transport", scale={{"load": 2.0}}).')
    opening, remedy = f"LoadCase({title!r})", f"[{only!r}]" if isinstance(only, str) else 'their names, only=["load"]'
    if not isinstance(scale, Mapping):
        said = f"scale={cited(scale)} does not say what is scaled"
        raise DefinitionError(f'{opening}: {said}; write a factor for each load by name, scale={{"load": 2.0}}.')
    loads = require_type(f"{opening}: only", () if only is None else only, (list, tuple), f"is not a list of loads; write {remedy}")
    lines = require_type(f"{opening}: shut", shut, (list, tuple), 'is not a list of lines; write their names, shut=["line"]')
    for each in (*scale, *loads, *lines):
        if not isinstance(each, (str, Member)):
            raise DefinitionError(f"{opening}: {cited(each)} is neither a load nor the name of one.")
