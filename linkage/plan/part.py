"""A mechanism as a part of another one: a class that is bound once, then renamed, its members under dotted names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import fields, is_dataclass
from types import MappingProxyType
from typing import Any

import numpy as np

from ..errors import DefinitionError, about, cited, ensure, is_listed, is_yes, two_of, unknown
from ..frozen import FrozenDict
from ..quantities import FRAME_AXES, Axes, Coordinate, Dimension, Operand, Quantity, Ref, Stroke, Variable, is_number, label, quantity
from ..quantities import source_text as written
from ..quantities.axes import is_nothing
from ..quantities.member import Member, Reference, is_member_or_name, keywords, name_of, needs, of_kind, word_arguments
from ..steps import Arrow, Drawn, Group, Link, Point, Step
from ..steps.labels import Spoken
from ..units import require_measure
from .members import aliases_among
from .plan import Plan

DEEPEST = 8
"""Parts in parts, so deep."""
MOST_MEMBERS = 4000
LEFT_BEHIND = ("over", "load case", "planes")
"""What speaks of a whole machine and stays with the class that says it."""


class PartNameError(DefinitionError, AttributeError):
    """A name that a part has not."""


class Part(Member):
    """A mechanism in a mechanism: `lower = Part(Arm, S=s1, OB=0.45)`; its members are `lower.B`, `"lower.B"`.

    Loads, cylinders, circuits and outlines come along; load cases and `Over`s do not.

    Parameters
    ----------
    machine : type of Mechanism or Mechanism
        A class or a design.
    on : Point, Link, str or sequence of them, optional
        What carries the part's axes: two points of a body, a link, nothing for the frame.
    at : pair of float or quantity, optional
        The place (x, y) of the part's origin in those axes [m].
    angle : float or quantity, optional
        The angle by which it is turned [rad].
    mirrored : bool, optional
        Whether it is mirrored at its own y axis first.
    **given : object
        The part's own names. A fixed point becomes a point of the whole, or lies at (x, y). A dimension takes a number or follows a
        quantity. A stroke follows a quantity; where nothing is said it is one of the whole, `lower.S`. Any other member goes by None.

    Raises
    ------
    DefinitionError
        A name is not one of the part's, or a value does not fit it.
    """

    kind = "part"

    def __init__(
        self, machine: object, *, on: Reference | Sequence[Reference] | None = None, at: Sequence[Operand] | None = None,
        angle: Operand = 0.0, mirrored: bool = False, **given: object,
    ) -> None:  # fmt: skip
        plan = getattr(machine, "plan", None)
        if not isinstance(plan, Plan):
            raise DefinitionError(f"Part({cited(machine)}): a class of mechanisms is expected, or a design of one, such as Part(FourBar).")
        self.machine: Any = machine if isinstance(machine, type) else type(machine)
        self.plan = plan
        values = {} if isinstance(machine, type) else getattr(machine, "dimensions", {})
        set_in = {name: value for name, value in values.items() if np.ndim(value) or value != plan.defaults[name]}
        ensure(not any(map(np.ndim, set_in.values())), f"Part({plan.title}(...)): this is a batch of designs; a part is one of them.")
        self.given: dict[str, Any] = {**set_in, **given}
        carriers: object = () if on is None else on.split() if isinstance(on, str) else [on] if isinstance(on, Member) else on
        self.on: tuple[Reference, ...] = tuple(carriers) if is_listed(carriers) else ()
        if on is not None and (not 0 < len(self.on) < 3 or not all(is_member_or_name(each) for each in self.on)):
            raise DefinitionError(f"Part(on={cited(on)}): name two points of the body that carries it, a link, or nothing for the frame.")
        x, y = (0.0, 0.0) if at is None else pair_of(at, "Part(at=...)", "write (x, y) in m, or fuse its fixed points with others by name")
        require_measure(angle, "angle", "Part: angle")
        self.at, self.angle = (quantity(x), quantity(y)), quantity(angle)
        self.mirrored = is_yes("Part: mirrored", mirrored)
        said = {"on": on is not None, "at": at is not None, "angle": not is_nothing(self.angle), "mirrored": self.mirrored}
        for word in said:
            if said[word] and word in self.plan.members:
                kind = self.plan.members[word].kind
                what = f"Part({self.plan.title}, {word}=...): {word} places a part, and is a {kind} of {self.plan.title}"
                reached = f'lower["{word}"], and given as Whole(**{{"lower.{word}": ...}})'
                raise DefinitionError(f"{what}, too; rename that in a subclass to place the part. The member is reached by {reached}.")
        self._check_given()

    # -- names ----------------------------------------------------------------------------------------------

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or "plan" not in vars(self):
            raise AttributeError(name)
        return self[name]

    def __getitem__(self, name: str) -> Any:
        """Return the reference to a member of the part, `lower["name"]`."""
        ensure(self.name, f"Part({self.plan.title}) has no name yet; bind it in the class first, lower = Part(...), then lower.B.")
        called, member = f"{self.name}.{name}", self.plan.members.get(name)
        if member is None and name not in self.plan.table.spellings:
            known = sorted({each.partition(".")[0] for each in self.plan.members} | set(self.plan.aliases))
            raise PartNameError(str(unknown("Name", name, known, where=f"{self.name} = Part({self.plan.title})")))
        if isinstance(member, Part):
            return Inner(member, called)
        if member is not None and member.inside:
            return HeldName(called, member)
        return Ref(called) if member is None or isinstance(member, Quantity) else called

    # -- what it was given ----------------------------------------------------------------------------------

    def _check_given(self) -> None:
        plan, title = self.plan, f"Part({self.plan.title})"
        for name, value in self.given.items():
            member, fault = plan.members.get(name), ""
            if name in plan.strokes and value is None:
                fault = f"the stroke {name} cannot be left out; give it a quantity, {name}=S"
            elif isinstance(member, Point) and not member.is_fixed:
                remedy = f"give its fixed points, {', '.join(self.plan.ground)}, or carry the part by on="
                fault = f"{name} moves in the part and takes no place; {remedy}"
            elif isinstance(member, Point) and value is None:
                fault = f"the fixed point {name} cannot be left out; fuse it with a point or give (x, y)"
            elif isinstance(member, Point) and not is_member_or_name(value):
                pair_of(value, f"{title}: {name}=", "write (x, y) in m, or name a point of the machine")
            elif isinstance(member, Point) or (value is None and member is not None):
                continue
            elif name in plan.strokes or ((name in plan.table.spellings or isinstance(member, Dimension)) and not np.ndim(value)):
                quantity(value)
            elif name in plan.table.spellings or isinstance(member, Dimension):
                fault = f"{name} is a batch of {np.size(value)} values; a part is one design"
            elif name in plan.table.following:
                fault = f"{name} follows {plan.table.following[name]}; set what it follows"
            elif member is None:
                raise unknown("Name", name, [*plan.members, *plan.table.names()], where=title)
            else:
                remedy = f"leave it out by {name}=None, or exchange it in a subclass of {plan.title}"
                fault = f"{name} is a {member.kind} and takes no value; {remedy}"
            ensure(not fault, f"{title}: {fault}.")

    def parts(self) -> tuple[Reference, ...]:
        found: list[Reference] = [self.angle, *self.at]
        for name, value in self.given.items():
            if isinstance(self.plan.members.get(name), Point):
                found += [value] if is_member_or_name(value) else map(quantity, value)
            elif value is not None:
                found.append(quantity(value))
        return (*self.on, *(each for each in found if not (isinstance(each, Quantity) and each.is_constant)))

    # -- what it brings -------------------------------------------------------------------------------------

    @property
    def aliases(self) -> dict[str, str]:
        """The names of the part that are other names of members of the whole: fused points, strokes and dimensions that follow by name."""
        found: dict[str, str] = {}
        for name, value in self.given.items():
            member = self.plan.members.get(name)
            if isinstance(member, Point) and is_member_or_name(value):
                found[f"{self.name}.{name}"] = name_of(value)
            elif isinstance(member, (Stroke, Dimension)) and not is_number(value):
                target = quantity(value).known_as
                if target:
                    found[f"{self.name}.{name}"] = target
        inner = {f"{self.name}.{name}": f"{self.name}.{target}" for name, target in self.plan.aliases.items()}
        return found | {name: found.get(target, target) for name, target in inner.items()}

    def axes(self, members: Mapping[str, Member]) -> Axes | None:
        """Return the axes of the part in the whole; None where they are the frame's.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        Axes or None
            The axes.
        """
        names = tuple(map(name_of, self.on))
        if len(names) == 1 and isinstance(members.get(names[0]), Link):
            names = members[names[0]].point_names[:2]  # type: ignore[attr-defined]
        if len(names) == 1:
            what = f"{self.name} = {self}: {names[0]} is one point, and gives a part no directions"
            raise DefinitionError(f"{what}; name two points of the body that carries it, on=({names[0]}, ...), or a link.")
        P, Q = names[:2] if names else (None, None)
        found = Axes(P, Q, self.at, self.angle, self.mirrored)
        return None if found.is_frame else found

    def brought(self, members: Mapping[str, Member]) -> dict[str, Member]:
        """Return the members of the part as they stand among those of the whole, by their dotted names.

        Parameters
        ----------
        members : mapping of str to Member
            The members of the class by name.

        Returns
        -------
        dict of str to Member
            The members.
        """
        return Renamed(self, self.axes(members)).renamed_members()

    def having(self, values: Mapping[str, float]) -> Part:
        own = {name.removeprefix(f"{self.name}."): value for name, value in values.items() if name.startswith(f"{self.name}.")}
        once = {name: value for name, value in own.items() if name in self.plan.table.entries or name in self.given}
        return self.renewed(given={**self.given, **once}) if once else self

    @property
    def stands_as_alone(self) -> bool:
        """Whether all its points stand where they stand in the machine alone."""
        is_moved = bool(self.on) or self.mirrored or not all(map(is_nothing, (*self.at, self.angle)))
        return not is_moved and not any(self.given[name] is not None and name not in self.plan.strokes for name in self.given)

    @property
    def nesting(self) -> int:
        """How deep parts stand in it, itself included."""
        return 1 + max((each.nesting for each in self.plan.of_kind(Part).values()), default=0)

    def __str__(self) -> str:
        words = [self.plan.title, *(f"{name}={given_text(value)}" for name, value in self.given.items() if name.isidentifier())]
        if self.on:
            words.append(f"on={label(self.on[0])}" if len(self.on) == 1 else f"on=({', '.join(map(label, self.on))})")
        dotted = keywords({name: given_text(value) for name, value in self.given.items() if not name.isidentifier()})
        words += filter(None, [str(Axes(at=self.at, angle=self.angle, mirrored=self.mirrored)), dotted])
        return f"Part({', '.join(words)})"


class HeldName(str):
    """The name of a member of a part, and the prefix of its inner names: `lower.ram.length`, `lower.ram.rod_side`."""

    def __new__(cls, called: str, member: Member) -> HeldName:
        found = super().__new__(cls, called)
        found.member = member
        return found

    member: Member

    def __getattr__(self, name: str) -> Any:
        member = vars(self).get("member")
        if member is None or name.startswith("_") or name not in member.inside:
            raise AttributeError(f"{self!s} holds no {name}.")
        return Ref(f"{self}.{name}") if member.inside[name] == "quantity" else f"{self}.{name}"


class Inner:
    """A part of a part, by which its members are named: `lower.tool.T`."""

    def __init__(self, part: Part, called: str) -> None:
        self._part, self._is_called = part, called

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return self._part.renewed(_name=self._is_called)[name]

    __getitem__ = __getattr__


def given_text(value: object) -> str:
    """Return the value of a keyword as it is written in source."""
    match value:
        case Quantity():
            return value.name or written(value)
        case str() | Member():
            return label(value)
        case list() | tuple() | np.ndarray():
            return f"({', '.join(written(quantity(each)) for each in value)})"
    return repr(value.item() if isinstance(value, np.generic) else value)


def pair_of(given: object, what: str, remedy: str) -> tuple[Operand, Operand]:
    """Return two coordinates; DefinitionError with the remedy for anything else."""
    pair = two_of(given)
    if not pair:
        raise DefinitionError(f"{what}: {cited(given)} is no place; {remedy}.")
    for each in pair:
        quantity(each)
    require_measure(pair, "length", what)
    x, y = pair
    return x, y


class Renaming:
    """A renaming of members: new names for some of their references."""

    def __init__(self, names: Mapping[str, str]) -> None:
        self.names = names

    def member(self, given: Member) -> Member:
        """Return a member with its references renamed; the member itself, where it uses none of the names."""
        try:
            if not any(each in self.names for each in needs(given)):
                return given
        except DefinitionError:  # its names are not all known yet: those behind the first are not asked for
            return given
        held = {name: value for name, value in vars(given).items() if name not in ("_name", "_class", "spoken", "plan", "machine")}
        return given.renewed(**{name: self.attribute(given, name, value) for name, value in held.items()})

    def named_member(self, given: Member) -> object:
        """Return the member that replaces an argument, or the one that it holds."""
        return given if given.name and not isinstance(given, Group) else self.member(given)

    def attribute(self, given: Member, name: str, value: Any) -> Any:
        """Return an attribute under the other names; the keys of labels, and of a part's keywords, are names of their own."""
        if name == "labels" or (isinstance(given, Part) and name == "given"):
            return {key: self.value(each, is_word=False) for key, each in value.items()}
        return self.value(value, name in word_arguments(type(given)))

    def value(self, given: Any, is_word: bool) -> Any:
        """Return an argument under the other names; a word is kept."""
        if isinstance(given, Member):
            return self.named_member(given)
        if isinstance(given, str):
            return given if is_word else " ".join(self.names.get(word, word) for word in given.split(" "))
        if type(given) in (tuple, list):
            return type(given)(self.value(each, is_word) for each in given)
        if type(given) in (dict, FrozenDict, MappingProxyType):
            return {self.value(key, is_word): self.value(each, is_word) for key, each in given.items()}
        if is_dataclass(given) and not isinstance(given, type):
            words = word_arguments(type(given))
            changed = {each.name: self.value(getattr(given, each.name), each.name in words) for each in fields(given)}
            if all(changed[name] is getattr(given, name) for name in changed):
                return given
            found = copy(given)
            for name, value in changed.items():
                object.__setattr__(found, name, value)
            return found
        return given


class Renamed(Renaming):
    """The members of a part under their names in the whole."""

    def __init__(self, part: Part, axes: Axes | None) -> None:
        self.part, self.axes, self.plan = part, axes, part.plan
        self.memo: dict[int, Member] = {}
        self.aliases = part.aliases
        self.foreign = set(self.aliases.values())
        """The names of the whole that the part's names stand for."""
        self.names = {name: f"{part.name}.{name}" for name in self.plan.members}
        self.names |= {name: self.aliases[dotted] for name, dotted in self.names.items() if dotted in self.aliases}
        self.names |= {name.partition(f"{part.name}.")[2]: target for name, target in self.aliases.items()}

    def renamed_members(self) -> dict[str, Member]:
        """Return all members that the part brings."""
        part, source = self.part, self.plan.unbound
        left_out = {name for name, value in part.given.items() if value is None}
        found: dict[str, Member] = {}
        for name, member in source.items():
            dotted = f"{part.name}.{name}"
            if name in left_out or member.kind in LEFT_BEHIND or dotted in self.aliases:
                continue
            if isinstance(member, Drawn):
                kept = [each for each in member.strokes if each not in part.given or f"{part.name}.{each}" in self.aliases]
                strokes = {self.names[each]: member.strokes[each] for each in kept}
                if strokes:
                    found[dotted] = Drawn(strokes).renewed(_name=dotted)
                continue
            with about(dotted):
                found[dotted] = self._member_in_part(name, dotted, member)
        for name, each in ((name, each) for name, member in found.items() for each in needs(member)) if left_out else ():
            lost, own = each.removeprefix(f"{part.name}."), name.removeprefix(f"{part.name}.")
            if lost in left_out and each not in found:
                said = f"{part.name} = {part}: {lost}=None, but {own} = {source[own]} needs it"
                raise DefinitionError(f"{said}; leave that out, too, {own}=None.", member=part.name)
        return found

    def _member_in_part(self, name: str, dotted: str, member: Member) -> Member:
        """Return a member with its name in the whole, where the part stands, with the dimensions that are given."""
        given = self.part.given
        if name in given and (isinstance(member, Stroke) or (isinstance(member, Dimension) and not is_number(given[name]))):
            return quantity(given[name]).renewed(_name=dotted)
        found = self.member(member)
        values: dict[str, Any] = {}
        if name in given and isinstance(member, Point):
            values = {f"{dotted}.{axis}": quantity(value) for axis, value in zip("xy", given[name], strict=True)}
        for each, value in given.items():
            owner, sign = self.plan.table.spellings.get(each, ("", 1))
            if owner and value is not None:
                for spelling, (other, own) in self.plan.table.spellings.items():
                    if other == owner:
                        signed = value if is_number(value) else quantity(value)
                        values[f"{self.part.name}.{spelling}"] = signed if sign * own > 0 else -signed
        if not values:
            return found
        before = {each for each, *_ in found.variables()}
        changed = found.having(values)
        follows = {each for each in before if each in values and not quantity(values[each]).is_constant}
        stays = follows & {each for each, *_ in changed.variables()}
        if stays:
            what = f"{self.part.name} = {self.part}: {sorted(stays)[0]} is a number of {name} = {member} and can follow nothing"
            raise DefinitionError(f"{what}; give it a number.", member=self.part.name)
        return changed

    # -- one member ------------------------------------------------------------------------------------------

    def member(self, given: Member) -> Member:
        """Return a member of the part, named or not, as it is in the whole."""
        known = self.memo.get(id(given))
        if known is not None:
            return known
        found = object.__new__(type(given))
        self.memo[id(given)] = found
        for attribute, value in vars(given).items():
            if attribute in ("_class", "spoken"):
                continue
            if attribute == "_name":
                value = self.names.get(value, value) if value else value
            elif attribute == "labels" and isinstance(given, (Step, Link)):
                value = {f"{self.part.name}.{spelling}": each for spelling, each in self.attribute(given, attribute, value).items()}
            elif attribute == "variable" and isinstance(given, Variable):  # a coordinate of a part's own fixed point
                value = f"{self.part.name}.{value}"
            elif not (isinstance(given, Part) and attribute in ("plan", "machine")):
                value = self.attribute(given, attribute, value)
            object.__setattr__(found, attribute, value)
        if isinstance(found, Step):  # what its sketch chose and measured is settled
            vars(found).update(near=None, drawn_at=None)
        if isinstance(found, (Step, Link, Group)):
            before: Spoken | None = getattr(given, "spoken", None)
            owner = self.part.name if before is None else f"{self.part.name}.{before.owner}"
            letters = {name: name for name in self.plan.members} if before is None else before.letters
            object.__setattr__(found, "spoken", Spoken(owner, {self.names.get(name, name): letter for name, letter in letters.items()}))
        placed = None if self.axes is None else self._own_coordinate(given)
        if placed is None and self.axes is not None:
            has_sides = isinstance(given, Arrow) or (isinstance(given, Quantity) and not given.parts())
            if self.axes.mirrored and has_no_axes(given) and has_sides:
                what = f"{self.part.name} = {self.part}: {given.name} = {given} cannot be mirrored"
                remedy = f"{type(given).__name__} does not say how; give that class in_axes(axes)."
                raise DefinitionError(f"{what}: {remedy}", member=self.part.name)
            found = found.in_axes(self.axes)
        self.memo[id(given)] = found if placed is None else placed
        return self.memo[id(given)]

    def _own_coordinate(self, given: Member) -> Quantity | None:
        """Return the coordinate of a fixed point of the part, for x(O) of it follows nothing that carries the part; None for all else."""
        if not isinstance(given, Coordinate) or given.name or not given.axes.is_frame:
            return None
        own = name_of(given.P)
        point = self.plan.unbound.get(own)
        if not isinstance(point, Point) or not getattr(point, "axes", FRAME_AXES).is_frame or f"{self.part.name}.{own}" in self.aliases:
            return None
        place = self.part.given.get(own) or [each for _, each in point.coordinates()]
        if not point.is_fixed or len(place) != 2:
            return None
        each = quantity(place["xy".index(given.axis)])
        if each.is_constant:
            return Variable(f"{self.part.name}.{own}.{given.axis}")
        return each if own in self.part.given else self.member(each)  # type: ignore[return-value]

    def named_member(self, given: Member) -> object:
        if given.name and self.names.get(given.name, given.name) in self.foreign:
            target = self.names[given.name]
            return Ref(target) if isinstance(given, Quantity) else target
        return self.member(given)


def has_no_axes(member: Member) -> bool:
    """Return whether a member is of another package's class, which does not say how it stands in axes."""
    return type(member).__module__.split(".")[0] not in ("linkage", "hydraulics", "mechanisms") and type(member).in_axes is Member.in_axes


# -- the members of a whole ---------------------------------------------------------------------------------------


def with_parts(members: Mapping[str, Member], title: str) -> dict[str, Member]:
    """Return the members of a class with those of its parts behind each part, and every name as the whole says it."""
    parts = of_kind(members, Part)
    if not parts:
        return dict(members)
    brought: dict[str, dict[str, Member]] = {}
    for name in carriers_first(parts):
        part = parts[name] if parts[name].name == name else parts[name].renewed(_name=name)
        if part.nesting > DEEPEST:
            what = f"{title}: {name} = {part} holds parts {part.nesting} deep"
            raise DefinitionError(f"{what}; up to {DEEPEST} are taken.", member=name)
        with about(name):
            known = {**members, **{each: member for own in brought.values() for each, member in own.items()}}
            brought[name] = {name: part, **part.brought(known)}
    found: dict[str, Member] = {}
    for name, member in members.items():
        found |= brought.get(name, {name: member})
    ensure(len(found) <= MOST_MEMBERS, f"{title} has {len(found)} members with those of its parts; up to {MOST_MEMBERS} are taken.")
    aliases = aliases_among(found)
    if not aliases:
        return dict(found)
    renaming = Renaming(aliases)
    return {name: renaming.member(member) for name, member in found.items()}


def carriers_first(parts: Mapping[str, Part]) -> list[str]:
    """Return the names of parts, each behind those that carry it, in the order written where that is free."""
    owners = {name: {name_of(each, is_needed=False).partition(".")[0] for each in part.on} & parts.keys() for name, part in parts.items()}
    found: list[str] = []
    while left := [name for name in parts if name not in found]:  # those that carry each other are refused later, as a cycle
        found.append(next((name for name in left if owners[name] <= {name, *found}), left[0]))
    return found


def check_circuits(members: Mapping[str, Member], title: str) -> None:
    """Raise DefinitionError where something of the whole feeds a cylinder that its part feeds itself."""
    owners: dict[str, str] = {}
    for name, member in members.items():
        element: Any = member
        if member.kind != "load":
            continue
        for fed in (*element.joined(members), *element.feeds(members)):
            first = owners.setdefault(fed.name, name)
            inner = [each for each in (first, name) if "." in each]
            if first != name and inner and first.rpartition(".")[0] != name.rpartition(".")[0]:
                part, _, own = inner[0].rpartition(".")
                remedy = f"leave the part's own out, {part} = Part(..., {own}=None)"
                raise DefinitionError(f"{title}: {first} and {name} both feed {fed.name}; {remedy}.", member=part)
