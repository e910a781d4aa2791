"""What acts: which loads, in which load case, in which direction of motion, at which rates. One value wherever forces are asked for."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from inspect import Parameter, signature
from typing import Protocol, Self, TypeAlias, TypedDict, TypeVar, final

from numpy.typing import ArrayLike

from ..checks import require_type
from ..errors import DefinitionError, cited, known_name
from ..frozen import keep_own, refuses_changes
from ..quantities import name_of
from .case import LoadCase
from .element import DIRECTIONS, FRICTIONLESS, ForceElement, Load, Poses


class HasLoads(Protocol):
    """Anything with loads: what a force element is at the least."""

    def loads(self, motion: Poses) -> list[Load]:
        """Return the forces over the motion's poses [N]."""


Loads: TypeAlias = Sequence[ForceElement | HasLoads | str] | ForceElement | HasLoads | str | None
"""Elements, their names, or what has loads; None for the machine's own."""
Case: TypeAlias = LoadCase | str | None
"""A load case, or its name; None for none."""


@final
@refuses_changes
@dataclass(frozen=True)
class Acting:
    """The situation in which forces are asked for: `Acting(case="full", direction="extending", drive="S")`.

    `loads` are the machine's own where None, `case` a LoadCase or its name, `direction` one of DIRECTIONS, `rates` the speeds of strokes
    [1/s], `drive` the stroke that moves where several could. In a plain value None is no case and no friction; where something is judged,
    None of case or direction means all that occur.
    """

    loads: Loads = None
    case: Case = None
    direction: str | None = None
    rates: Mapping[str, ArrayLike] | None = None
    drive: str | None = None

    def __post_init__(self) -> None:
        if self.direction is not None:
            known_name("Direction", self.direction, DIRECTIONS)
        if self.drive is not None:
            object.__setattr__(self, "drive", name_of(self.drive))
        if self.rates is not None:
            require_type("Acting(rates", self.rates, Mapping, "a value for each stroke is expected, such as rates=dict(S=0.05)")
        keep_own(self)

    @property
    def movement(self) -> str:
        """The direction as a plain value takes it."""
        return self.direction or FRICTIONLESS

    def within(self, outer: Acting, what: str = "") -> Self:
        """Return this with what is not said here taken from `outer`; where `what` is said to be asked, DefinitionError for what differs."""
        said = {each.name: getattr(self, each.name) for each in fields(self)}
        for name, value in said.items():
            other = getattr(outer, name)
            if value is None:
                said[name] = other
            elif what and other is not None and other is not value and other != value:
                inside, outside = f"{name}={named_or_cited(value)}", f"{name}={named_or_cited(other)}"
                raise DefinitionError(f"{what}: {inside} stands in it, and acting= says {outside}; drop one of them.")
        if self.drive is None and said["direction"] == FRICTIONLESS:
            said["drive"] = None  # where there is no friction it is the same whichever stroke moves
        return type(self)(**said)


def named_or_cited(value: object) -> str:
    """Return what was given as text: a member by its name."""
    return str(getattr(value, "name", "") or cited(value))


PLAIN = Acting()
"""The machine's own loads, at rest."""


# The public functions of forces take it whole, or its parts as keywords.


class ActingKeywords(TypedDict, total=False):
    """The keywords of a public function that say what acts, as `Acting` does, or that one in the place of them."""

    case: Case
    direction: str | None
    rates: Mapping[str, ArrayLike] | None
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
