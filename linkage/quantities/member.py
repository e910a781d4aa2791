"""Members: everything that a mechanism's class may bind to a name, and how members refer to each other by that name."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from functools import lru_cache
from inspect import Parameter, Signature, signature
from keyword import iskeyword
from math import inf
from operator import attrgetter
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, Protocol, Self, TypeAlias, TypeGuard, TypeVar
from unicodedata import normalize
from weakref import WeakKeyDictionary

import numpy as np

from ..errors import DefinitionError, article, cited, ensure, unknown
from ..frozen import FrozenDict
from ..vectors import Line, Scalar, Vec


class Member:
    """Anything that a mechanism's class declares.

    Its name is the first one it is bound to. Members refer to each other by name, so that a subclass which replaces a member replaces it
    for everybody.

    Parameters
    ----------
    *given, **options
        The arguments of its own kind.
    """

    kind: ClassVar[str] = "member"
    """What it is where a reference asks for it: `point`, `vector`, `quantity`, `guide`, ..."""

    expects: ClassVar[tuple[tuple[str, str], ...]] = ()
    """Its attributes that refer to others, with the kind each must be."""

    argument_kinds: ClassVar[Mapping[str, object]] = MappingProxyType({})
    """What its arguments are where `expects` and annotations do not tell, for files. What a class says adds to what its bases say.

    A word, such as `body`, `place`, `length` (see `linkage.files.entry`); a class, whose own arguments stand among those of the
    member; such a class in a tuple, for a list of values; an object with `read(given, number)` and `write(value)`, or with `kind()`.
    """

    file_section: ClassVar[str] = ""
    """The section of a file that it stands in, where its class is not known to `linkage.files`."""

    inside: ClassVar[Mapping[str, str]] = MappingProxyType({})
    """What it holds by names of its own, `lift.length`, each with its kind: what `inner` returns, and what others may name."""

    needs_name: ClassVar[bool] = False
    """Whether its value goes by its name, so that it cannot stand in an expression without one."""

    _name: str = ""
    _class: str = ""
    """The class that it was declared in, once that is complete: from then on it does not change."""

    def __setattr__(self, name: str, value: object) -> None:
        self._check_free(name)
        object.__setattr__(self, name, value)

    def __delattr__(self, name: str) -> None:
        self._check_free(name)
        object.__delattr__(self, name)

    def _check_free(self, name: str) -> None:
        """Raise DefinitionError for a change of a member whose class is made already."""
        if self._class:
            what = f"{self._class}.{self.name}.{name} = ..."
            remedy = f"write a subclass, class Other({self._class}): {self.name} = ..."
            raise DefinitionError(f"{what}: {self._class} is worked out already and would not follow; {remedy}, or set a dimension.")

    def settle(self, title: str) -> None:
        """Let nothing of this member change any more: the class `title` is made of it."""
        for name, value in vars(self).items():
            if type(value) is dict:
                object.__setattr__(self, name, FrozenDict(value))
        if not self._class:
            object.__setattr__(self, "_class", title)

    def __copy__(self) -> Self:
        return self.renewed()

    def __new__(cls, *given: object, **options: object) -> Self:
        if given or options:  # without any it may come from pickle
            check_arguments(cls, given, options)
        return super().__new__(cls)

    def __set_name__(self, owner: type, name: str) -> None:
        if not self._name:
            object.__setattr__(self, "_name", name)

    if TYPE_CHECKING:

        @property
        def name(self) -> str: ...

    else:  # it is read so often that it costs no call of a function
        name = property(attrgetter("_name"), doc="The name in the class; empty for a part of an expression.")

    def parts(self) -> tuple[Reference, ...]:
        """Return the references this member is built from, names or members: those in `expects`, unless a subclass says otherwise.

        Returns
        -------
        tuple of Member or str
            The references.
        """
        return tuple(getattr(self, attribute) for attribute, _ in self.expects)

    def variables(self) -> tuple[tuple[str, float, str, str], ...]:
        """Return the design variables this member brings: name, default [SI], kind of measure, display unit or "".

        Returns
        -------
        tuple of tuple
            One for each design variable.
        """
        return ()

    def having(self, values: Mapping[str, float]) -> Self:
        """Return this member with the design variables among its numbers at other values [SI], by their name or label.

        Parameters
        ----------
        values : mapping of str to float
            Values of design variables [SI], by their name or label.

        Returns
        -------
        Member
            The changed member.
        """
        return self

    def renewed(self, **changes: object) -> Self:
        """Return this member with attributes changed, under its own name."""
        changed = object.__new__(type(self))
        for name, value in {**vars(self), **changes}.items():
            if name != "_class":  # it is free to change until a class is made of it
                object.__setattr__(changed, name, value)
        return changed

    is_fixed: bool = False
    """Whether it is a point of the frame."""

    def bind(self, name: str, table: Any) -> Self:
        """Return this member with its name, the names of its references and its dimensions settled."""
        return self

    def coordinates(self) -> tuple[tuple[str, Any], ...]:
        """Return the names and values of both coordinates, where it is a point that is given by them.

        Returns
        -------
        tuple of tuple
            The name and the value [m] of each.
        """
        return ()

    def enter(self, table: Any) -> None:
        """Enter the labels of this member in the mechanism's table of dimensions."""

    def lengths(self) -> tuple[Member, ...]:
        """Return the quantities that stand for lengths in this member, beside its labels: none may be negative.

        Returns
        -------
        tuple of Quantity
            The lengths [m].
        """
        return ()

    @property
    def companions(self) -> tuple[str, ...]:
        """The points that are found together with this one; empty where it is placed alone."""
        return ()

    radians: ClassVar[tuple[str, ...]] = ()
    """Its attributes that hold the quantities of `in_radians`."""
    metres: ClassVar[tuple[str, ...]] = ()
    """Its attributes that hold places along a line [m], of any sign."""

    def in_radians(self) -> tuple[Any, ...]:
        """Return the quantities that stand for angles in this member: strokes and dimensions that they are sums of are in rad.

        Returns
        -------
        tuple of Quantity
            The angles [rad].
        """
        return tuple(angle for angle in (getattr(self, attribute) for attribute in self.radians) if angle is not None)

    def examine(self, members: Mapping[str, Member], title: str) -> None:
        """Raise DefinitionError for faults that show only in the whole class: its members by name, its title."""
        for fault in self.faults(members):
            raise DefinitionError(f"{title}: {self.name} = {self}: {fault}.")

    def faults(self, members: Mapping[str, Member]) -> Iterator[str]:
        """Yield the faults of this member among the members of its class, by name, each with the remedy.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Yields
        ------
        str
            A fault, with its remedy.
        """
        yield from ()

    def among(self, members: Mapping[str, Member]) -> Self:
        """Return this member as it is among those of its class; itself, where none of them says something of it.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        Member
            The member.
        """
        return self

    def inner(self, name: str, members: Mapping[str, Member]) -> Member | None:
        """Return a quantity or point that this member holds by a name of its own, as in `lift.length`; None where there is none.

        Parameters
        ----------
        name : str
            The name behind the dot.
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        Member, optional
            The quantity or point.
        """
        return None

    def cuts(self, members: Mapping[str, Member]) -> tuple[str, ...]:
        """Return the inputs beside the strokes by which it moves the machine, as the oil of a closed line does.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        tuple of str
            The names of the inputs.
        """
        return ()

    def driven_cuts(self, members: Mapping[str, Member]) -> tuple[str, ...]:
        """Return those of its cuts that strokes change as well, as the oil that a stroke puts in.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        tuple of str
            The names of the inputs.
        """
        return ()

    handed: ClassVar[tuple[str, ...]] = ()
    """Its attributes that hold quantities whose sign changes in a part that is mirrored."""

    is_directed: ClassVar[bool] = False
    """Whether its directions are counted in `axes` of its own, and nothing else is."""

    def in_axes(self, axes: Any) -> Self:
        """Return this member of a part as the machine that has the part sees it; itself, where it has neither axes nor a side.

        By itself it changes the signs of what is `handed`, and turns `axes` that its directions are counted in.

        Parameters
        ----------
        axes : Axes
            The part's axes.

        Returns
        -------
        Member
            The member in the whole.
        """
        changes = {attribute: getattr(self, attribute).opposite() for attribute in self.handed if axes.mirrored}
        if self.is_directed and not axes.are_upright:
            changes["axes"] = axes.composed(getattr(self, "axes", None))
        return self.renewed(**changes) if changes else self

    def sides(self, where: Where) -> tuple[tuple[str, Scalar], ...]:
        """Return the triangle this member closes, as labelled lengths [m]; empty where it closes none.

        Parameters
        ----------
        where : Where
            The reading: places of points and values of quantities.

        Returns
        -------
        tuple of tuple
            The label and the length [m] of each side.
        """
        return ()


    def _no_arithmetic(self, *others: object) -> NoReturn:
        says = f"{type(self).__name__}: {article(self.kind)} {self.kind} does not add or multiply"
        raise DefinitionError(f"{says}; take distance(P, Q), angle(P, Q), x(P), y(P), or Vector(P, Q) of points.")

    if not TYPE_CHECKING:  # a checker of types is to complain of it by itself; quantities have operators of their own
        __add__ = __radd__ = __sub__ = __rsub__ = __mul__ = __rmul__ = __truediv__ = __rtruediv__ = __neg__ = _no_arithmetic


Reference: TypeAlias = str | Member
NamedMembers: TypeAlias = Mapping[str, Member]
"""The members of a class by their names."""


@lru_cache(maxsize=256)
def signature_of(kind: Hashable) -> tuple[Signature, int, float]:
    """Return the signature of a kind of member, and the least and the largest number of positional arguments that suffice."""
    taken = signature(kind.__init__)  # type: ignore[misc]
    _, *parameters = taken.parameters.values()
    needed = [each for each in parameters if each.default is Parameter.empty and each.kind is not Parameter.VAR_KEYWORD]
    ordered = [each for each in parameters if each.kind is Parameter.POSITIONAL_OR_KEYWORD]
    least = sum(each.kind is Parameter.POSITIONAL_OR_KEYWORD for each in needed)
    most = inf if any(each.kind is Parameter.VAR_POSITIONAL for each in parameters) else len(ordered)
    return taken, least, -1 if any(each.kind is Parameter.KEYWORD_ONLY for each in needed) else most


def check_arguments(kind: type[Member], given: tuple[object, ...], options: Mapping[str, object]) -> None:
    """Raise DefinitionError for arguments that a kind of member does not take, or that are missing."""
    ensure(kind.__init__ is not object.__init__, f"{kind.__name__} takes no arguments; give it an __init__, or make it a frozen dataclass.")
    taken, least, most = signature_of(kind)  # type: ignore[arg-type]  # a class with a class for its type
    if not options and least <= len(given) <= most:
        return
    try:
        taken.bind(None, *given, **options)
    except TypeError as error:
        _, *parameters = taken.parameters.values()
        words = [f"{each.name} such as AB=0.3" if each.kind is Parameter.VAR_KEYWORD else each.name for each in parameters]
        takes_any = any(each.kind is Parameter.VAR_KEYWORD for each in parameters)
        for each in () if takes_any else [name for name in options if name not in words]:
            raise unknown(f"{kind.__name__}(...): argument", each, words) from None
        raise DefinitionError(f"{kind.__name__}(...): {error}; it takes {', '.join(words) or 'nothing'}.") from None


def is_name(name: object) -> bool:
    """Return whether a line of a class could bind a name: letters, digits and _, no word of Python, spelled as Python spells it."""
    return isinstance(name, str) and name.isidentifier() and not iskeyword(name) and normalize("NFKC", name) == name


def is_member_or_name(given: object) -> TypeGuard[Reference]:
    """Return whether a value is a member, or a text that may name one."""
    return isinstance(given, (str, Member))


def is_reference(text: object) -> TypeGuard[str]:
    """Return whether a text may be the name of a member, or of one of a part: `B`, `lower.B`."""
    return isinstance(text, str) and all(map(str.isidentifier, text.split(".")))


def joined_names(*points: str) -> str:
    """Return the names of points as one label: `OB`; `lower.OB` where all are of one part, else with _ for the dots: `lower_TP`."""
    owners = {point.rpartition(".")[0] for point in points}
    if owners == {""}:
        return "".join(points)
    if len(owners) == 1:
        return f"{owners.pop()}.{''.join(point.rpartition('.')[2] for point in points)}"
    return "".join(points).replace(".", "_")


def body_name(points: Iterable[str]) -> str:
    """Return a body's name from its points: `OBC`; `lower.OBC` where all are of one part, else the points with blanks."""
    found = tuple(points)
    mixed = len({point.rpartition(".")[0] for point in found}) > 1
    return " ".join(found) if mixed else joined_names(*found)


def keywords(given: Mapping[str, object]) -> str:
    """Return arguments by name as a call takes them: `S=0.1, t=2`; those of parts, with a dot, in `**{"boom.S": 0.1}`."""
    plain = [f"{name}={value}" for name, value in given.items() if name.isidentifier()]
    dotted = ", ".join(f"'{name}': {value}" for name, value in given.items() if not name.isidentifier())
    return ", ".join([*plain, *([f"**{{{dotted}}}"] if dotted else [])])


def as_mapping(given: Mapping[str, object]) -> str:
    """Return values by name as Python writes them: `dict(S=0.1)`, or `{'boom.S': 0.1}` where a name has a dot."""
    if all(map(str.isidentifier, given)):
        return f"dict({keywords(given)})"
    return f"{{{', '.join(f'{name!r}: {value}' for name, value in given.items())}}}"


def name_of(reference: Reference, *, is_needed: bool = True) -> str:
    """Return the name a reference stands for; for a member without one DefinitionError, or "" where it is not needed."""
    if isinstance(reference, str):
        return reference
    if not is_needed:
        return reference.name
    if not isinstance(reference, Member):
        raise DefinitionError(f"{cited(reference)} stands where a point or its name is expected.")
    if not reference.name:
        said = f"{reference} is used before it has a name, or its name is bound twice"
        raise DefinitionError(f"{said}: bind it to a name of its own in the class, or write the name as a string.")
    return reference.name


def in_class(members: NamedMembers, reference: Reference) -> Member | str:
    """Return the member of a class that a reference names; the reference itself where there is none of that name."""
    return members.get(name_of(reference, is_needed=False), reference)


def needs(member: Member) -> Iterator[str]:
    """Yield the names that a member needs, through its unnamed parts; DefinitionError for a part that has to have a name."""
    if member.needs_name and not member.name:
        raise DefinitionError(f"{member} stands here without a name of its own: bind it in the class, L0 = {member}, and write L0 here.")
    for part in member.parts():
        if isinstance(part, Member) and not part.name:
            yield from needs(part)
        else:
            yield name_of(part)


Kind = TypeVar("Kind", bound=Member)


def of_kind(members: Mapping[str, Member], kind: type[Kind]) -> dict[str, Kind]:
    """Return those of some members that are of a kind, by name, in order; of members that do not change they are looked up once."""
    known: dict[type, dict[str, Kind]] = members.by_kind if isinstance(members, FrozenDict) else {}
    if kind not in known:
        known[kind] = FrozenDict({name: member for name, member in members.items() if isinstance(member, kind)})
    return known[kind]


def needed_behind(
    starts: Iterable[str], members: Mapping[str, Member], known: Iterable[str] = (), barred: type[Member] | tuple[()] = ()
) -> set[str]:
    """Return the names of all that some names are built from, themselves included, as far as they are members.

    What is `known` stands among them, and nothing is looked for behind it, nor behind members of a kind that is `barred`.
    """
    stack, found = list(starts), set(known)
    while stack:
        name = stack.pop()
        if name not in found and name in members:
            found.add(name)
            member = members[name]
            stack += () if isinstance(member, barred) else (*needs(member), *member.companions)
    return found


def unnamed(member: Member) -> Iterator[Member]:
    """Yield the parts of a member that have no name of their own, through all depths."""
    for part in member.parts():
        if isinstance(part, Member) and not part.name:
            yield part
            yield from unnamed(part)


# A reading of a mechanism, as its rules see it: where the points are and what the quantities amount to.

Turning: TypeAlias = tuple[Scalar, Scalar]
"""The cosine and the sine of an angle: how angles are carried between steps."""


Pick: TypeAlias = Callable[[Scalar, Scalar, Scalar, Scalar], Scalar]
"""What returns its third argument where the first is not above the second, else its fourth."""


class Tabulated(Protocol):
    """A tabulated function, such as `linkage.Curve`."""

    @property
    def name(self) -> str:
        """Its name in equations."""

    @property
    def ends(self) -> tuple[float, float] | None:
        """The least and greatest x that it has a value for; None where it goes on for ever."""

    def __hash__(self) -> int: ...

    def value(self, x: Scalar, order: int = 0, pick: Pick = ..., wrap: Callable[[Scalar], Scalar] = ...) -> Scalar:
        """Return its value, or a derivative of that order; NaN outside it.

        It is made of arithmetic, `pick(a, b, x, y)`, which is x where a <= b, else y, and `wrap(angle)`, the angle within half a turn.
        """


class Where(Protocol):
    """A reading of the mechanism: it knows the places of points and the values of quantities.

    What a reading only notes is here as it is worked out by itself.
    """

    def at(self, point: Reference) -> Vec:
        """Return a point's position [m]."""

    def vector(self, vector: Reference) -> Vec:
        """Return a vector member [m]."""

    def value(self, quantity: Reference) -> Scalar:
        """Return a quantity's value, SI."""

    def turn(self, angle: Reference) -> Turning:
        """Return the cosine and sine of an angle."""

    def input(self, name: str) -> Scalar:
        """Return a stroke, a dimension or a coordinate of a ground point."""

    def root(self, radicand: Scalar, scale: Scalar, size: Scalar, most: Scalar | None = None) -> Scalar:
        """Return the square root that closes a loop: `scale` times the sine of the angle between its links.

        NaN where the radicand is negative by more than rounding, which is measured against `size`; `most` is what that is never above,
        where the links alone say it.
        """
        return np.sqrt(radicand)

    def margin(self, sine: Scalar) -> Scalar:
        """Return the sine of the angle between a loop's two members, noted as its distance from a singular pose."""
        return sine

    def line(self, guide: Reference) -> Line:
        """Return a guide's line."""

    def at_pose(self, quantity: Reference, strokes: Mapping[str, float]) -> Scalar:
        """Return the value of a quantity at one pose of the strokes; strokes that are not named are at the sketch."""

    def angle_of(self, vector: Vec) -> Scalar:
        """Return a vector's direction [rad]."""
        return np.arctan2(vector.y, vector.x)

    def followed(self, angle: str, vector: Vec) -> Scalar | None:
        """Return the direction of a vector [rad] where that angle is followed from the sketch; None where it is not."""

    def apart(self, square: Scalar) -> Scalar:
        """Return the square of a vector whose direction is taken [m2], noted as its distance from a pose where that is lost."""
        return square

    def direction(self, P: str, Q: str) -> Vec:
        """Return the vector from one point to another [m], noted as one whose direction is taken."""

    def curve(self, curve: Tabulated, x: Scalar, order: int = 0) -> Scalar:
        """Return the value of a table at x, or its derivative of that order; NaN outside its range."""
        return curve.value(x, order)

    def link_length(self, P: str, Q: str) -> Scalar:
        """Return the distance of two points [m]; the link's own length where one body holds both."""

    def vector_length(self, vector: Reference) -> Scalar:
        """Return the length of a vector member [m]."""

    def close_angle(self, cos: Scalar, sin: Scalar) -> Turning:
        """Return an angle that closes a loop, as its cosine and sine."""
        return cos, sin


# What the arguments of a class of members are, as the class says it.

ANNOTATED = {
    "str": "word", "Literal": "word", "float": "number", "int": "number", "bool": "switch", "Reference": "member", "Member": "member",
    "Sequence": "numbers", "list": "numbers", "tuple": "numbers",
}  # fmt: skip
"""The kinds of arguments by how their annotation begins, where the class says no other."""
PLAIN = frozenset(
    {"word", "switch", "number", "numbers", "side", "place", "pair", "gravity", "path", "words", "option", "angle"}
)
"""The kinds of arguments whose texts are no names."""
KEPT_AS = {"at": ("drawn_at", "along"), "vector": ("by",), "P": ("fixed_at",), "oil": ("put_in",)}
"""The attributes in which members keep an argument that is not in the one of its name."""


def annotated_kind(annotation: object) -> str | None:
    """Return the kind of an argument by how its annotation begins; None where that says nothing."""
    text = annotation if isinstance(annotation, str) else getattr(annotation, "__name__", str(annotation))
    return ANNOTATED.get(text.replace("[", " ").partition(" ")[0])


def kinds_said(cls: type[object], amount: Callable[[str], object] = lambda unit: "quantity") -> dict[str, object]:
    """Return the kinds of arguments as a class and its bases say them; `amount(unit)` is that of a number with a unit."""
    said: dict[str, Any] = {}
    for base in reversed(cls.__mro__):
        said |= dict(vars(base).get("expects", ())) | dict.fromkeys(vars(base).get("places", ()), "point")
        said |= {name: amount(unit) for name, unit in vars(base).get("parameters", {}).items()} | dict(vars(base).get("argument_kinds", {}))
    return said


def word_arguments(cls: type[object]) -> frozenset[str]:
    """Return the attributes of a class whose texts are words and no names of members: `works="rod"`."""
    if cls not in WORD_ARGUMENTS:
        said = kinds_said(cls)
        found: set[str] = set()
        if cls.__init__ is not object.__init__:
            for each in list(signature(cls.__init__).parameters.values())[1:]:
                kind = said.get(each.name) or annotated_kind(each.annotation)
                if isinstance(kind, str) and kind in PLAIN:
                    found |= {each.name, *KEPT_AS.get(each.name, ())}
        WORD_ARGUMENTS[cls] = frozenset(found)
    return WORD_ARGUMENTS[cls]


WORD_ARGUMENTS: WeakKeyDictionary[type[object], frozenset[str]] = WeakKeyDictionary()
"""What `word_arguments` has found, by class."""
