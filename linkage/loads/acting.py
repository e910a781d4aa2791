"""Acting: loads, load case, direction of motion and rates in one value, wherever forces are computed."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import field, fields, replace
from inspect import Parameter, signature
from math import pi
from types import MappingProxyType
from typing import ClassVar, Literal, Protocol, Self, TypeAlias, TypedDict, TypeVar

from numpy.typing import ArrayLike

from ..errors import DefinitionError, cited, ensure, known_name, require, require_type, unknown
from ..frozen import immutable, keep_own, record
from ..language import said, translated
from ..quantities import Member, Reference, in_degrees, is_member_or_name, name_of
from ..quantities.quantity import plain
from ..units import deg, require_number
from .element import AS_IT_RUNS, DIRECTIONS, FRICTIONLESS, Declared, ForceElement, Load, Poses
from .point import gravity_vector

PLAIN_CASE = "plain"
"""The name of the machine's own loads, without a load case."""
OWN_LOADS = "own loads"
"""What the plain case is called in tables of forces; it is taken as its name."""


def case_titles(plan: Declared) -> dict[str, str]:
    """Return the titles of a class's load cases by their names, of those that have one beside the name."""
    cases = plan.of_kind(LoadCase).items()
    return {name: each.title for name, each in cases if each.title not in ("", name)}


def case_title(name: str, titles: Mapping[str, str]) -> str:
    """Return how a load case is called: its title in the language that is spoken, else its name."""
    return said("own loads") if name in ("", PLAIN_CASE) else translated(titles[name]) if name in titles else name


def case_in_words(name: str, titles: Mapping[str, str]) -> str:
    """Return a load case in words, within a sentence: `in the case full`, `under its own loads` of the plain one."""
    return said("under its own loads") if name in ("", PLAIN_CASE) else said("in the case {case}", case=case_title(name, titles))


STEEPEST = 0.5 * pi * (1.0 + 1e-9)


@immutable
class LoadCase(Member):
    """A named choice of loads: `transport = LoadCase("transport", scale={"load": 2.0}, slope=10 * deg)`.

    Parameters
    ----------
    title : str, optional
        How it is called in texts.
    scale : mapping of str to float, optional
        Factors of loads by name; 0 leaves one out.
    only : sequence of Member or str, optional
        The loads that are kept; all others are left out.
    slope : float, optional
        The ground's slope [rad], 0 by default. It turns gravity: positive where the ground rises towards +x, so that weights also pull
        towards -x.
    gravity : tuple of float, optional
        The gravity (x, y) [m/s2] of every element; without it each keeps its own.
    shut : sequence of Member or str, optional
        Lines of oil or gas whose valves are shut. At each pose such a line keeps what it has there and holds; its pressure is what the
        loads make of it.
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
            kind = "angle" if name == "slope" else "number"
            require_number(f"LoadCase({self.title!r}): {name}", value, "is not a finite number", kind=kind)
        said = f"slope={plain(self.slope)!r} rad is {self.slope / deg:.4g} deg, steeper than a wall"
        ensure(abs(self.slope) <= STEEPEST, f"{self.label}: {said}; write slope={plain(self.slope)!r} * deg if these are degrees.")
        if self.gravity is not None:
            object.__setattr__(self, "gravity", gravity_vector(self.gravity, self.label))

    @property
    def label(self) -> str:
        """The name of the case for a reader: its title, else its name in the class."""
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
        """Raise DefinitionError for a name that is no load of the class.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.
        title : str
            The name of the class, for messages.

        Raises
        ------
        DefinitionError
            A name is no load of the class.
        """
        loads = {name: member for name, member in members.items() if isinstance(member, ForceElement)}
        where = f"{title}.{self.name}"
        keys: list[object] = [*self.scale]
        for key in keys:
            if isinstance(key, Member):
                what = f"{where}: scale={{{key.name}: ...}} names the load itself"
                raise DefinitionError(f'{what}; write its name in quotes, scale={{"{key.name}": 2.0}}.')
        for name in self.mentioned:
            if name not in loads:
                raise unknown("Load", name, [each for each, load in loads.items() if load.scales], where)
        for name in self.scale:
            check_factor(self, name, members[name], where)
        shut_members(self, members, where)
        for name, other in members.items():
            if isinstance(other, LoadCase) and other is not self and self.label in (other.label, name):
                what = f"{self.name} and {name} are both called {self.label!r}, so that it does not tell which one is meant"
                raise DefinitionError(f"{title}: {what}; give one another title.")

    def factor(self, load: str) -> float:
        """Return the factor of a load in this case; 0 where it does not count.

        Parameters
        ----------
        load : str
            The name of a load.

        Returns
        -------
        float
            The factor.
        """
        kept = self.only is None or load in [name_of(each) for each in self.only]
        return float(self.scale.get(load, 1.0)) if kept else 0.0

    def on(self, element: ForceElement) -> ForceElement:
        """Return an element in the gravity of this case.

        Parameters
        ----------
        element : ForceElement
            A load.

        Returns
        -------
        ForceElement
            The load in the case's gravity.
        """
        return element if self.gravity is None and not self.slope else element.in_gravity(self.gravity, self.slope)

    def __str__(self) -> str:
        scale = {name: plain(value) for name, value in self.scale.items()}
        words = [repr(self.title)] if self.title else []
        words += [f"scale={scale!r}"] if scale else []
        words += [f"only={[name_of(each) for each in self.only]!r}"] if self.only is not None else []
        words += [f"slope={in_degrees(float(self.slope))}"] if self.slope else []
        words += [f"gravity={self.gravity!r}"] if self.gravity is not None else []
        words += [f"shut={[*self.shut_names]!r}"] if self.shut else []
        return f"LoadCase({', '.join(words)})"


def check_factor(case: LoadCase, name: str, element: object, where: str) -> None:
    """Raise DefinitionError for a factor of an element whose force does not scale with it."""
    if isinstance(element, ForceElement) and not element.scales and case.scale.get(name, 1.0) != 1.0:
        what = f"scale={{{name!r}: {plain(case.scale[name])!r}}}: {name} is a {type(element).__name__}"
        says = "and holds or feeds whatever the loads need, so that a factor changes nothing"
        remedy = f"scale the loads instead, or write a variant without it, class Other(...): {name} = None"
        raise DefinitionError(f"{where}: {what} {says}; {remedy}.")


def shut_members(case: LoadCase, members: Mapping[str, Member], where: str) -> dict[str, Member]:
    """Return the members that a case shuts, as they are then, by name; DefinitionError for one that cannot be shut."""
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
    require(isinstance(title, str), "LoadCase(title", title, 'its title is expected first, LoadCase("transport", scale={"load": 2.0})')
    opening, remedy = f"LoadCase({title!r})", f"[{only!r}]" if isinstance(only, str) else 'their names, only=["load"]'
    expected = 'does not say what is scaled; write a factor for each load by name, scale={"load": 2.0}'
    factors = require_type(f"{opening}: scale", scale, Mapping, expected)
    loads = require_type(f"{opening}: only", () if only is None else only, (list, tuple), f"is not a list of loads; write {remedy}")
    lines = require_type(f"{opening}: shut", shut, (list, tuple), 'is not a list of lines; write their names, shut=["line"]')
    for each in (*factors, *loads, *lines):
        if not is_member_or_name(each):
            raise DefinitionError(f"{opening}: {cited(each)} is neither a load nor the name of one.")


# What acts, in which case, which way, at which rates.


class HasLoads(Protocol):
    """Anything with loads: the least that a force element is."""

    def loads(self, motion: Poses) -> list[Load]:
        """Return the forces over the motion's poses [N]."""


Loads: TypeAlias = Sequence[ForceElement | HasLoads | str] | ForceElement | HasLoads | str | None
"""Elements, their names, or what has loads; None for the machine's own."""
Case: TypeAlias = LoadCase | str | None
"""A load case, or its name; None for none."""


StrokeRates: TypeAlias = Mapping[str, ArrayLike] | Literal["as it runs"] | None
"""How fast strokes move, or how their rates change, by name."""


@record
class Acting:
    """The situation in which forces are asked for: `Acting(case="full", direction="extending", drive="S")`.

    Parameters
    ----------
    loads : sequence of ForceElement or str, optional
        The loads; by default the machine's own.
    case : LoadCase or str, optional
        The load case. In a plain value None is no case; where something is judged, all that occur.
    direction : {"extending", "retracting", "frictionless"}, optional
        The direction of motion. In a plain value None is without friction; where something is judged, all that occur.
    rates : mapping of str to float, optional
        The speeds of strokes [1/s]; by default those of a motion in time. `AS_IT_RUNS` says this too, and makes them inputs of a program.
    drive : str, optional
        The stroke that moves, where several could.
    accelerations : mapping of str to float, optional
        How the rates change [1/s2]; by default those of a motion in time.
    inertia : bool, optional
        Whether the inertia of masses counts: by default where accelerations are known. True insists on it, False leaves it out.
    """

    loads: Loads = None
    case: Case = None
    direction: str | None = None
    rates: StrokeRates = None
    drive: str | None = None
    accelerations: StrokeRates = None
    inertia: bool | None = None

    def __post_init__(self) -> None:
        if self.direction is not None and self.direction != AS_IT_RUNS:
            known_name("Direction", self.direction, DIRECTIONS)
        if self.drive is not None:
            object.__setattr__(self, "drive", name_of(self.drive))
        if isinstance(self.case, str) and self.case == OWN_LOADS:
            object.__setattr__(self, "case", PLAIN_CASE)
        for name, given in (("rates", self.rates), ("accelerations", self.accelerations)):
            if given is not None and not (isinstance(given, str) and given == AS_IT_RUNS):
                require_type(f"Acting({name}", given, Mapping, f"a value for each stroke is expected, such as {name}=dict(S=0.05)")
        if self.inertia is not None and not isinstance(self.inertia, bool):
            raise DefinitionError(f"Acting(inertia={cited(self.inertia)}): True or False is expected, or nothing.")
        if self.accelerations is not None and self.rates is None:
            what = "accelerations say how rates change, and no rates are given"
            raise DefinitionError(f"Acting: {what}; give both, Acting(rates=dict(S=0.0), accelerations=dict(S=0.5)).")
        keep_own(self)

    @property
    def movement(self) -> str:
        """The direction as a plain value takes it."""
        return self.direction or FRICTIONLESS

    @property
    def is_moving(self) -> bool:
        """Whether its direction is one of motion, extending or retracting: neither at rest nor as it runs."""
        return self.direction in DIRECTIONS and self.direction != FRICTIONLESS

    def towards(self, direction: str | None) -> Self:
        """Return it in a direction, without rates that are given: these say another one.

        Parameters
        ----------
        direction : str or None
            "extending", "retracting" or "frictionless"; or None.

        Returns
        -------
        Acting
            The same situation in that direction, without given rates.
        """
        given = isinstance(self.rates, Mapping)
        return replace(self, direction=direction, **dict.fromkeys(("rates", "accelerations") if given else ()))

    def within(self, outer: Acting, what: str = "") -> Self:
        """Return this with its gaps filled from `outer`; with `what` (the asking function), DefinitionError where both differ.

        Parameters
        ----------
        outer : Acting
            The situation that fills the gaps.
        what : str
            The function that asks; with it, values that differ are refused.

        Returns
        -------
        Acting
            The completed situation.

        Raises
        ------
        DefinitionError
            Both give different values, with `what`.
        """
        said = {each.name: getattr(self, each.name) for each in fields(self)}
        for name, value in said.items():
            other = getattr(outer, name)
            if value is None:
                said[name] = None if name == "accelerations" and self.rates is not None else other
            elif what and other is not None and other is not value and other != value:
                inside, outside = (f"{name}={getattr(each, 'name', '') or cited(each)}" for each in (value, other))
                raise DefinitionError(f"{what}: {inside} stands in it, and acting= says {outside}; drop one of them.")
        if self.drive is None and said["direction"] == FRICTIONLESS:
            said["drive"] = None  # where there is no friction it is the same whichever stroke moves
        return type(self)(**said)


PLAIN = Acting()
"""The machine's own loads, at rest."""


# The public functions of forces take it whole, or its parts as keywords.


class ActingKeywords(TypedDict, total=False):
    """The keywords of a public function for the situation: those of `Acting`, or an `Acting` in their place."""

    case: Case
    direction: str | None
    rates: StrokeRates
    accelerations: StrokeRates
    inertia: bool | None
    acting: Acting | None


Function = TypeVar("Function", bound=Callable[..., object])


def takes_situation(function: Function) -> Function:
    """Return a function that takes the keywords of `ActingKeywords`, so that `help` names each of them."""
    given = signature(function)
    plain = [each for each in given.parameters.values() if each.kind is not Parameter.VAR_KEYWORD]
    kinds = ActingKeywords.__annotations__
    known = [Parameter(name, Parameter.KEYWORD_ONLY, default=None, annotation=kind) for name, kind in kinds.items()]
    function.__dict__["__signature__"] = given.replace(parameters=[*plain, *known])
    return function


def situation_of(what: str, acting: Acting | None = None, **keywords: object) -> Acting:
    """Return the situation that a public function is given, whole or by its keywords; DefinitionError for both.

    `what` is the function's name, `keywords` are those of `Acting` as they were given, None for none.
    """
    given = {name: value for name, value in keywords.items() if value is not None}
    unknown = next((name for name in keywords if name not in Acting.__dataclass_fields__), None)
    if unknown is not None:
        raise TypeError(f"{what}() got an unexpected keyword argument {unknown!r}")
    if acting is None:
        return Acting(**given)  # type: ignore[arg-type]
    require_type(f"{what}(acting", acting, Acting, 'a situation is expected, such as acting=Acting(case="full")')
    if given:
        raise DefinitionError(f"{what}: {next(iter(given))}= and acting= both say it; give acting= alone, Acting({next(iter(given))}=...).")
    return acting
