"""Requests: quantities that a user asks of a mechanism, and their form bound to a plan.

A position, an output, a ratio, a force, a condition is one request: nodes of the program, the members it is built from, what is said
where it has no value, and the error that rounding leaves of it. Kernels, functions, texts and gradients know nothing else.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, field
from enum import Flag, auto
from functools import reduce
from itertools import product
from operator import or_
from types import MappingProxyType
from typing import Any, TypeAlias, TypeVar, cast
from weakref import ref

import numpy as np

from ..errors import DefinitionError, UntracedError, cited, require
from ..frozen import immutable, record
from ..loads import AS_IT_RUNS, DIRECTIONS, Acting
from ..pickling import object_of, picklable
from ..plan import NEAR, REGULAR, ArrayReading, Mask, Plan
from ..program import FloatArray, Kernel, Node, Notes, ancestors, gradient
from ..quantities import TAKEN, Arithmetic, Member, Number, PoseCondition, Quantity, Reference, label, name_of, needs, quantity, source_text
from ..steps import Arrow, Point
from .dead_points import LEAST, PLACES, PrecisionLeft
from .grid import MotionLike
from .limits import no_joint
from .strokes import checked_name, order_of


class Trait(Flag):
    """Properties of a request beside its values."""

    OF_STROKES = auto()
    """The directions of motion it is judged in are those of a stroke, which has to be named; else its own, as a cylinder's."""
    OF_FORCES = auto()
    """It hangs on a situation: what acts, in which load case, which way, and over a path in time how fast."""
    OF_LAWS = auto()
    """It is made of laws over a motion, which take long to trace: their looks share one program."""
    MAY_BE_UNLIMITED = auto()
    """Its law may have no bound at some poses, as `unlimited` then tells."""
    MAY_FAIL = auto()
    """It may have no value where all points it is built from have a place."""
    FOLLOWS_ANGLES = auto()
    """It follows angles, which are continued along the stroke."""
    STANDS_FOR_OTHERS = auto()
    """Results that are not nodes go through it, so that what its loops lose counts even where it happens to be exact itself."""


NO_TRAIT = Trait(0)


class Request(Arithmetic):
    """Something to ask of a mechanism at its poses that is no member of it: a ratio, a thrust, a pin force; sums and products of such.

    One that has a program says `nodes` and `names`, and `key` where it is not told by itself; one that has none says `of`. What a user
    writes holds names; `bound` looks them up in a plan, and what it returns, of the same class, is asked for nodes, rows and key.
    What needs no class of its own is a function that returns a `NodeRequest`.
    """

    # -- as it is written --------------------------------------------------------------------------------

    def __reduce__(self) -> tuple[Any, ...]:
        """Return the state for pickle, nested functions too."""
        return object_of, (type(self), {name: picklable(value) for name, value in vars(self).items()})

    def identity(self, plan: Plan) -> Hashable:
        """Return a key among the requests of one plan, valid as long as its values live; None where they may change."""
        return None

    def bound(self, plan: Plan) -> Request:
        """Return the request with its names looked up in a plan; DefinitionError where there is no such thing there.

        UntracedError where no program gives it.
        """
        return self

    @property
    def measures(self) -> str:
        """The kind of its value where that is plain: `angle`, `length`, `force`, `pressure`, or "" for a plain number."""
        return ""

    def measured(self, plan: Plan) -> str:
        """Return the kind of its value in a plan: of a drive `force` or `moment`."""
        return self.measures

    def of(self, motion: MotionLike) -> FloatArray:
        """Return its values over a motion's poses [SI], shape (...), of a point's (2, ...); by the program unless a subclass says."""
        return motion._requested(self)

    def applied(self, function: str, *operands: object) -> Any:
        """Apply NumPy's function of that name to requests, quantities and numbers; a point's two parts are taken one by one."""
        if any(isinstance(each, Arithmetic) and not isinstance(each, Request) for each in operands):
            return NotImplemented
        return Combined(function, tuple(map(operand, operands)))

    def __ge__(self, other: object) -> PoseCondition:
        return PoseCondition(self, ">=", other)

    def __le__(self, other: object) -> PoseCondition:
        return PoseCondition(self, "<=", other)

    __gt__, __lt__ = __ge__, __le__

    def under(self, acting: Acting, *, keep: bool = False) -> Request:
        """Return the request in a situation, where it is of forces.

        Where it names another one itself that is kept, or, unless `keep`, refused with a DefinitionError.
        """
        return self

    def occurs_in(self, plan: Plan, case: str) -> bool:
        """Return whether it is judged in a load case, by its name: in all unless it says so."""
        return True

    def movements(self, plan: Plan, rubs: bool) -> tuple[str, ...]:
        """Return the directions of motion in which it is judged, of DIRECTIONS; none where it is of no force.

        `rubs`: whether there is friction, or what acts otherwise while it moves.
        """
        return ()

    @property
    def traits(self) -> Trait:
        """Its properties beside its values."""
        return NO_TRAIT

    @property
    def mover(self) -> Hashable:
        """The drive of its directions: a cylinder's name; None for a stroke or a path."""
        return None

    def pieces(self, plan: Plan) -> tuple[SmoothPiece, ...]:
        """Return the smooth pieces that it is judged by in one situation, such as the two sides of a cylinder."""
        return (SmoothPiece(self),)

    def unlimited(self, motion: MotionLike) -> Mask | None:
        """Return the mask of poses at which its law has no bound, such as where the load drives; None where it always has one."""
        return None

    # -- bound to a plan ---------------------------------------------------------------------------------

    @property
    def key(self) -> Hashable:
        """A hashable key among the requests of one plan."""
        return self

    @property
    def sentence(self) -> str:
        """Its name in a sentence: `the ratio of G by S`; its string is the code that one writes, `ratio(G)`."""
        return str(self)

    @property
    def traced_with(self) -> Hashable:
        """A key of the requests that are traced in one program with this one: where one of them can be, all can.

        None for one that was traced when it was bound.
        """
        return self.key

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        """Return its nodes in a plan's program, one a component; UntracedError where it has values alone."""
        raise UntracedError(f"{plan.title}: {self}: it has values, and no program that gives derivatives.")

    def names(self, plan: Plan) -> set[str]:
        """Return the members that it is built from; UntracedError where it has values alone."""
        raise UntracedError(f"{plan.title}: {self}: it has values, and no program that gives derivatives.")

    def refuse(self, motion: MotionLike) -> None:
        """Raise the error of a motion's poses where it has no value; nothing where it has one at all of them, or another refuses it."""

    def notes(self, plan: Plan) -> Notes:
        """Return the conditions under which its nodes are true."""
        return Notes()

    @property
    def rows(self) -> int:
        """The number of its components: 2 for a point."""
        return 1

    @property
    def order(self) -> int:
        """How often it is differentiated."""
        return 0

    def differentiated(self, plan: Plan) -> set[str]:
        """Return the members at whose singular poses it is refused: those it is differentiated through."""
        return self.names(plan) if self.order else set()

    def gaps(self, plan: Plan) -> tuple[Node, ...]:
        """Return the nodes that are above zero where it has a value: elsewhere it is NaN, which is no error, as a load that is no limit."""
        return ()

    def read_own(self, reading: ArrayReading) -> None:
        """Evaluate its own quantities in an eager reading, so that their directions are noted; most requests have none."""

    @property
    def regular(self) -> float:
        """The product of squared parts (Trace.least_nearness) above which rounding leaves at least eight digits of it.

        A first derivative loses eps over the product, a second one eps over its power of 3 / 2.
        """
        return PLACES if not self.order else NEAR**3 if self.order == 1 else NEAR**2

    def rounding_nodes(self, plan: Plan) -> tuple[Node, ...]:
        """Return the nodes whose rounding tells its error: its own, and those they are compared with."""
        return self.nodes(plan)

    def scale(self, plan: Plan, left: PrecisionLeft) -> FloatArray:
        """Return the size that a component's error is compared with where the component is smaller [SI], from its nodes' precision.

        Shape (n,), or (rows, n) where each component has its own.
        """
        small = SMALL_PRESSURE if self.measured(plan) == "pressure" else SMALL_FORCE
        return np.full(left.size.shape, small if Trait.OF_FORCES in self.traits else SMALL)

    def error(self, plan: Plan, left: PrecisionLeft) -> FloatArray:
        """Return the relative error to expect, shape (n,), from the precision of those nodes."""
        return left.relative(self.scale(plan, left))


RequestLike: TypeAlias = str | Member | Request
AnyRequest = TypeVar("AnyRequest")


@immutable
class SmoothPiece:
    """A smooth piece of a question: a value per pose, and the side of the cylinder that it belongs to, "" for none.

    `reciprocal` is one over it, where that goes on smoothly through zero where the request has no bound: then its greatest value is looked
    for in the place of the request's least. `below` is the same as the request above zero, and goes on smoothly below zero, where the
    request stays at zero: it is looked for in the place of the request's greatest value. `bound` is 1.0 where the request is the greatest
    of its pieces at every pose, -1.0 where it is the least, 0.0 where one of them has its value and the others none.
    """

    request: Any
    side: str = ""
    reciprocal: Any = None
    below: Any = None
    bound: float = 0.0


def bound(plan: Plan, request: RequestLike) -> Request:
    """Return a request bound to a plan; DefinitionError where there is nothing of that name, or no saying by which stroke."""
    return (request if isinstance(request, Request) else Value(request)).bound(plan)


def all_bound(plan: Plan, requests: Sequence[RequestLike]) -> tuple[Request, ...]:
    """Return a list of requests bound to a plan; DefinitionError for a lone one, whose letters would be taken for names."""
    if isinstance(requests, (str, Member, Request)):
        raise DefinitionError(f"{plan.title}: {requests!r}: a list of what is asked for is expected, [{requests!r}].")
    is_list = isinstance(requests, Iterable) and not isinstance(requests, (Mapping, Set, np.ndarray))
    require(is_list, f"{plan.title}: requests", requests, 'a list of what is asked for is expected, such as ["G"]')
    return tuple(bound(plan, request) for request in requests)


def as_they_run(requests: Sequence[RequestLike], accelerated: bool, timed: bool = False) -> Sequence[RequestLike]:
    """Return requests at rates that are inputs, and at accelerations where they are `accelerated`. Names stay as they are.

    Of a motion in time (`timed`) friction acts too, and what a request says itself stays.
    """
    direction = AS_IT_RUNS if timed else None
    acting = Acting(direction=direction, rates=AS_IT_RUNS, accelerations=AS_IT_RUNS if accelerated else None)
    return requests if type(requests) not in (list, tuple) else [situated(each, acting, keep=timed) for each in requests]


def situated(quantity: AnyRequest, acting: Acting, *, keep: bool = True) -> AnyRequest:
    """Return a request in a situation, as its `under` does; anything else as it is."""
    return cast(AnyRequest, quantity.under(acting, keep=keep)) if isinstance(quantity, Request) else quantity


def is_of_force(quantity: object) -> bool:
    """Return whether something asked for follows the loads, so that it differs from load case to load case."""
    return isinstance(quantity, Request) and Trait.OF_FORCES in quantity.traits


def may_be_unlimited(quantity: object) -> bool:
    """Return whether something asked for may have no bound at some poses, where it has no value then."""
    return isinstance(quantity, Request) and Trait.MAY_BE_UNLIMITED in quantity.traits


def identity_of(plan: Plan, request: object) -> Hashable:
    """Return a key of a request; None for a quantity without one, for one that may change, and for a function of a motion."""
    if type(request) is str:
        return request
    if isinstance(request, Request):
        identity = request.identity(plan)
        try:
            hash(identity)
        except TypeError:  # what was given is anything as yet, and refused where it is bound
            return None
        return identity
    identity = request.identity if isinstance(request, Quantity) else request.name if isinstance(request, Member) else None
    return None if identity is request else identity or None


def identities_of(plan: Plan, requests: Sequence[RequestLike]) -> Hashable:
    """Return a key of a list of requests, as long as loads live that it holds; None where one has none, or it is no list."""
    if type(requests) not in (list, tuple):
        return None
    if {*map(type, requests)} == {str}:
        return tuple(requests)
    found = tuple([identity_of(plan, each) for each in requests])
    return None if None in found else found


def holds_given(identity: Hashable) -> bool:
    """Return whether a key holds a user's loads; bound requests hold them, and must not keep them alive."""
    return isinstance(identity, ref) or (type(identity) is tuple and any(type(each) is not str and holds_given(each) for each in identity))


def stroke_of(plan: Plan, name: str | None, keyword: str = "wrt") -> str:
    """Return the stroke that is meant; DefinitionError where there are several and none is named by the keyword."""
    if name is None and len(plan.strokes) == 1:
        return next(iter(plan.strokes))
    if name is None:
        raise DefinitionError(f"{plan.title} has {len(plan.strokes)} strokes: say {keyword}= one of {', '.join(plan.strokes)}.")
    return name if name in plan.cuts else checked_name("Stroke", name, plan.strokes, plan.title)


def dimensions_of(plan: Plan, names: object) -> list[tuple[str, int]]:
    """Return design variables by any of their spellings, with signs; DefinitionError for anything but one of them."""
    if isinstance(names, str):
        raise DefinitionError(f'{plan.title}: wrt="{names}": a list of dimensions is expected, wrt=["{names}"].')
    if not isinstance(names, Iterable) or isinstance(names, np.ndarray) or not (names := list(names)):
        raise DefinitionError(f"{plan.title}: wrt={cited(names)}: a list of dimensions is expected.")
    names = [checked_name("Dimension", name, (*plan.table.spellings, *plan.table.following, *plan.points), plan.title) for name in names]
    for name in names:
        if f"{name}.x" in plan.table.spellings or f"{name}.y" in plan.table.spellings:
            raise DefinitionError(f'{plan.title}: wrt="{name}": a point has two coordinates; say "{name}.x" or "{name}.y".')
        if name in plan.table.following and name not in plan.table.spellings:
            raise DefinitionError(f"{plan.title}: {name} follows {plan.table.following[name]}; take the gradient by what it follows.")
    return [plan.table.spellings[checked_name("Dimension", name, plan.table.spellings, plan.title)] for name in names]


# Values, and ratios of any order.


@record
class Value(Request):
    """A point, a vector or a quantity, and the strokes that it is differentiated by, one after the other: a value, or a transfer ratio.

    None stands for the only stroke there is. Bound to a plan `target` is the member itself.
    """

    target: str | Member
    along: tuple[str | None, ...] = ()

    def identity(self, plan: Plan) -> Hashable:
        target = identity_of(plan, self.target)
        return None if target is None else ("value", target, self.along)

    def of(self, motion: MotionLike) -> FloatArray:
        return motion.ratio(self.target, wrt=self.along[0], order=self.order) if self.along else motion[self.target]

    def __str__(self) -> str:
        if not self.along:
            return label(self.target)
        wrt = [f"wrt={self.along[0]}"] if self.along[0] else []
        return f"ratio({', '.join([label(self.target), *wrt, *([f'order={self.order}'] if self.order > 1 else [])])})"

    def bound(self, plan: Plan) -> Value:
        along = tuple(stroke_of(plan, name) for name in self.along)
        if isinstance(self.target, Quantity) and not self.target.name:
            for name in needs(self.target):
                plan.member(name)
            return Value(self.target, along)
        return Value(plan.members[checked_name("Name", self.target, plan.valued_members, plan.title)], along)

    @property
    def member(self) -> Member:
        """The member, of one that is bound."""
        return cast(Member, self.target)

    @property
    def strokes(self) -> tuple[str, ...]:
        """The strokes that it is differentiated by, of one that is bound."""
        return cast(tuple[str, ...], self.along)

    @property
    def name(self) -> str | Quantity:
        """The member by its name, or itself where it has none."""
        member = self.member
        return member.name or member if isinstance(member, Quantity) else member.name

    @property
    def key(self) -> Hashable:
        return self.member.identity if isinstance(self.member, Quantity) else self.name, self.along

    @property
    def rows(self) -> int:
        return 2 if isinstance(self.member, (Point, Arrow)) else 1

    @property
    def order(self) -> int:
        return len(self.along)

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        return plan.derived(plan.nodes(self.name), self.strokes)

    def names(self, plan: Plan) -> set[str]:
        return plan.reaches(self.name)

    def refuse(self, motion: MotionLike) -> None:
        if self.along:
            self.of(motion)
        elif isinstance(self.member, Quantity):
            motion.value(self.member)

    @property
    def traits(self) -> Trait:
        return Trait.FOLLOWS_ANGLES | Trait.MAY_FAIL if isinstance(self.member, Quantity) else NO_TRAIT

    @property
    def regular(self) -> float:
        return NEAR**2 if self.along or isinstance(self.member, Quantity) else PLACES

    def read_own(self, reading: ArrayReading) -> None:
        if isinstance(self.member, Quantity):
            with np.errstate(all="ignore"):
                reading.value(self.member)

    def scale(self, plan: Plan, left: PrecisionLeft) -> FloatArray:
        scale = natural_size(self.member, left.size)
        if scale is None:
            return super().scale(plan, left)
        for name in self.strokes:
            scale = scale / (CUT if name in plan.cuts else abs(plan.strokes[name].end - plan.strokes[name].start) or 1.0)
        return LEAST * scale if self.along else scale

    @property
    def sentence(self) -> str:
        what = self.member.name or str(self.member)
        kind = "ratio" if len(self.along) == 1 else "second derivative"
        return f"the {kind} of {what} by {self.along[0]}" if self.along else what


def ratio(target: str | Member, wrt: str | None = None, order: int = 1) -> Value:
    """Return the request for the derivative of a point or a quantity by a stroke, in `evaluate` and `gradient`.

    `ratio("G")` is dG/dS, `ratio("G", order=2)` d2G/dS2; `wrt="S2"` where there are several strokes.

    Parameters
    ----------
    target : str or Member
        The point or the quantity.
    wrt : str, optional
        The stroke, where there are several.
    order : int
        1 or 2.

    Returns
    -------
    Request
        The derivative; of a point its two parts.
    """
    return Value(target, (wrt,) * order_of(order))


CUT = 1e-3
"""What changes a closed line beside the strokes, as oil [m3], goes about so far."""
SMALL = 1e-9
"""A result of no known size [SI] that is smaller counts as so large where its relative error is told."""
SMALL_FORCE, SMALL_PRESSURE = 0.1, 1e4
"""The same of a force [N] and of a pressure, of it on 10 mm2 [Pa]: what is left of loads that cancel is zero, and no lost value."""


def natural_size(member: Member, size: FloatArray) -> FloatArray | None:
    """Return the size that a position, a length or an angle is compared with: the machine's [m], or 1 rad; None for other quantities."""
    measures = member.measures if isinstance(member, Quantity) else "length"
    return size if measures == "length" else np.ones_like(size) if measures == "angle" else None


# Sums, products and functions of requests.

SIGNS: Mapping[str, tuple[str, int, int, int]] = MappingProxyType(
    {"add": ("+", 1, 1, 1), "subtract": ("-", 1, 1, 2), "multiply": ("*", 2, 2, 3), "divide": ("/", 2, 2, 3), "power": ("**", 3, 4, 4)}
)
"""How a function of two is written: its sign, how strongly it binds, and how strongly its sides must to stand without brackets."""
UNIT_SIZE = frozenset({"sin", "cos", "arctan2"})
"""The functions whose values are compared with 1."""
LIKE_ITS_PARTS = ("add", "subtract", "negative", "absolute", "minimum", "maximum", "hypot")
"""The functions whose values measure what their parts measure."""
GROWTH = MappingProxyType({"add": (1, 1), "subtract": (1, -1), "negative": (-1,), "minimum": (1, 1), "maximum": (1, 1)})
"""For each part 1 where a function of any numbers grows with it, -1 where it falls."""


def measured_in(plan: Plan, asked: object) -> str:
    """Return the kind of a quantity's or a request's value in a plan, "" where it is not plain."""
    return asked.measured(plan) if isinstance(asked, Request) else asked.measures if isinstance(asked, Quantity) else ""


@record
class Combined(Request):
    """One of NumPy's functions of requests, quantities and numbers, per pose. Bound, its parts are requests and numbers.

    `text` is what was written, of one that is bound, or that has a name of its own.
    """

    function: str
    parts: tuple[Request | Quantity | float, ...]
    text: str = field(default="", compare=False)

    def identity(self, plan: Plan) -> Hashable:
        found = [each if isinstance(each, float) else identity_of(plan, each) for each in self.parts]
        return None if None in found else ("combined", self.function, *found)

    def measured(self, plan: Plan) -> str:
        known = [measured_in(plan, each) for each in self.parts if not isinstance(each, float)]
        scaled = self.function == "multiply" or (self.function == "divide" and isinstance(self.parts[1], float))
        same = self.function in LIKE_ITS_PARTS or (scaled and len(known) == 1)
        return known[0] if same and len(set(known)) == 1 else ""

    def of(self, motion: MotionLike) -> FloatArray:
        given = [each if isinstance(each, float) else motion[each] for each in self.parts]
        with np.errstate(all="ignore"):
            found = np.asarray(NUMPY[self.function](*given))
        empty = np.zeros(motion.shape, bool)
        for each in map(np.isnan, given):
            empty |= each if each.ndim <= len(motion.shape) else each.any(axis=0)
        return motion._finite(np.where(empty, np.nan, found), empty, str(self))

    @property
    def requests(self) -> list[Request]:
        """The requests among its parts."""
        return [each for each in self.parts if isinstance(each, Request)]

    def under(self, acting: Acting, *, keep: bool = False) -> Combined:
        parts = tuple(situated(each, acting, keep=keep) for each in self.parts)
        return self if all(a is b for a, b in zip(parts, self.parts, strict=True)) else Combined(self.function, parts, self.text)

    def movements(self, plan: Plan, rubs: bool) -> tuple[str, ...]:
        occurring = {each for part in self.requests for each in part.movements(plan, rubs)}
        return tuple(each for each in DIRECTIONS if each in occurring)

    @property
    def traits(self) -> Trait:
        return reduce(or_, (each.traits for each in self.requests), Trait.MAY_FAIL)

    @property
    def mover(self) -> Hashable:
        return None if Trait.OF_STROKES in self.traits else next((each.mover for each in self.requests if each.mover is not None), None)

    def pieces(self, plan: Plan) -> tuple[SmoothPiece, ...]:
        parts = [each.pieces(plan) if isinstance(each, Request) else (SmoothPiece(each),) for each in self.parts]
        chosen = list(product(*parts))
        if len(chosen) == 1 and all(piece.request is part for piece, part in zip(chosen[0], self.parts, strict=True)):
            return (SmoothPiece(self),)
        bounds = {each * piece.bound for pieces, each in zip(parts, self._growth, strict=True) for piece in pieces if piece.bound}
        if len(bounds) > 1 or not all(bounds):  # it is neither the greatest nor the least of what its parts' pieces give
            return (SmoothPiece(self),)
        sides = [next((piece.side for piece in each if piece.side), "") for each in chosen]
        combined = [Combined(self.function, tuple(piece.request for piece in each)) for each in chosen]
        return tuple(SmoothPiece(request, side, bound=sum(bounds)) for request, side in zip(combined, sides, strict=True))

    @property
    def _growth(self) -> Sequence[float]:
        """For each part 1.0 where it grows with it, -1.0 where it falls, 0.0 where that is not known."""
        if self.function in ("multiply", "divide"):
            sign = float(np.sign(next((each for each in reversed(self.parts) if isinstance(each, float)), 0.0)))
            return [sign, sign if self.function == "multiply" else 0.0]
        return GROWTH.get(self.function, (0,) * len(self.parts))

    def unlimited(self, motion: MotionLike) -> Mask | None:
        found = [mask for mask in (each.unlimited(motion) for each in self.requests) if mask is not None]
        return reduce(np.logical_or, found) if found else None

    def bound(self, plan: Plan) -> Combined:
        parts = tuple(each if isinstance(each, float) else bound(plan, each) for each in self.parts)
        return Combined(self.function, parts, str(self))

    @property
    def binds(self) -> int:
        """How strongly its sign binds, to stand without brackets."""
        return SIGNS[self.function][1] if self.function in SIGNS else 1 if self.function == "negative" else 9

    def __str__(self) -> str:
        if self.text:
            return self.text
        if self.function == "negative":
            return f"-{bracketed(self.parts[0], 3)}"
        if self.function not in SIGNS:
            name = "abs" if self.function == "absolute" else self.function
            return f"{name}({', '.join(bracketed(each, 0) for each in self.parts)})"
        (sign, _, left, right), (a, b) = SIGNS[self.function], self.parts
        return f"{bracketed(a, left)} {sign} {bracketed(b, right)}"

    # -- bound to a plan ---------------------------------------------------------------------------------

    @property
    def key(self) -> Hashable:
        return "combined", self.function, *(each.key if isinstance(each, Request) else each for each in self.parts)

    @property
    def rows(self) -> int:
        return max(each.rows for each in self.requests)

    @property
    def order(self) -> int:
        return max(each.order for each in self.requests)

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        given = [each.nodes(plan) if isinstance(each, Request) else (cast(float, each),) for each in self.parts]
        rows = zip(*(each * (self.rows // len(each)) for each in given), strict=True)
        return tuple(plan.trace.graph.node(NUMPY[self.function](*row)) for row in rows)

    def names(self, plan: Plan) -> set[str]:
        return set().union(*(each.names(plan) for each in self.requests))

    def differentiated(self, plan: Plan) -> set[str]:
        return set().union(*(each.differentiated(plan) for each in self.requests))

    def gaps(self, plan: Plan) -> tuple[Node, ...]:
        return tuple(dict.fromkeys(node for each in self.requests for node in each.gaps(plan)))

    def notes(self, plan: Plan) -> Notes:
        found = Notes()
        for each in self.requests:
            notes = each.notes(plan)
            found.assumed.update(notes.assumed)
            found.switches.update(notes.switches)
        return found

    def refuse(self, motion: MotionLike) -> None:
        for each in self.requests:
            each.refuse(motion)
        self.of(motion)

    def read_own(self, reading: ArrayReading) -> None:
        for each in self.requests:
            each.read_own(reading)

    @property
    def regular(self) -> float:
        return max(each.regular for each in self.requests)

    def rounding_nodes(self, plan: Plan) -> tuple[Node, ...]:
        return *self.nodes(plan), *(node for each in self.requests for node in each.rounding_nodes(plan))

    def error(self, plan: Plan, left: PrecisionLeft) -> FloatArray:
        return left.some_rows(slice(0, self.rows)).relative(self.scale(plan, left))

    def scale(self, plan: Plan, left: PrecisionLeft) -> FloatArray:
        values, sizes, first = [], [], self.rows
        for each in self.parts:
            if not isinstance(each, Request):
                values.append(np.full(left.size.shape, abs(cast(float, each))))
                sizes.append(values[-1])
                continue
            count = len(each.rounding_nodes(plan))
            own = left.some_rows(slice(first, first + count))
            values.append(np.abs(own.values[: each.rows]))
            sizes.append(np.maximum(values[-1], each.scale(plan, own)))
            first += count
        with np.errstate(all="ignore"):
            if self.function in ("multiply", "divide"):
                size = sizes[0] * sizes[1] if self.function == "multiply" else sizes[0] / values[1]
            elif self.function in UNIT_SIZE:
                size = np.ones_like(sizes[0])
            else:
                size = reduce(np.maximum, sizes) if self.function in LIKE_ITS_PARTS else np.full(sizes[0].shape, SMALL)
            return np.asarray(np.nan_to_num(np.maximum(size, SMALL), nan=SMALL))


NUMPY: Mapping[str, Callable[..., object]] = MappingProxyType({name: getattr(np, name) for name in TAKEN})


def operand(given: Any) -> Request | Quantity | float:
    """Return an operand of a request: a request, a quantity or its name, or a number."""
    if isinstance(given, Request):
        return given
    found = quantity(given.item() if isinstance(given, np.ndarray) and given.ndim == 0 else given)
    return found.number if type(found) is Number and not found.name else found


def bracketed(part: Request | Quantity | float, binding: int) -> str:
    """Return a part of a sum or a product as text, in brackets where it binds more loosely than its surroundings."""
    if isinstance(part, float):
        text, binds = repr(part), 3 if part < 0.0 else 9
    elif isinstance(part, Quantity):
        return source_text(part, binding)
    else:
        text, binds = str(part), part.binds if isinstance(part, Combined) else 9
    return f"({text})" if binds < binding else text


@record
class MotionFunction(Request):
    """A function of a motion that depends on the motion alone, as a request; its results are cached for a design."""

    function: Callable[[Any], Any]
    measures: str = ""

    def identity(self, plan: Plan) -> Hashable:
        return "function", self.function

    def bound(self, plan: Plan) -> Request:
        raise UntracedError(f"{plan.title}: {self} is a function of a motion: it has values, and no program.")

    def of(self, motion: MotionLike) -> FloatArray:
        return np.asarray(self.function(motion), float)

    def __str__(self) -> str:
        return str(self.function.__name__).replace("_", " ")


# What functions of a plan say.


@dataclass(frozen=True, eq=False, kw_only=True)
class NodeRequest(Request):
    """A request without a class of its own: functions of a plan give its nodes and the members it is built from, or refuse it.

    `text` is what one writes, `sentence` what is said of it where that is something else, and `key` tells it from others. What it is
    built from is `parts`: where one of these has no identity, it has none either. Where all that hangs on the plan, `bound_by` returns
    the request that it is there, and `identity_by` its identity.
    """

    text: str
    rows: int = 1
    nodes_of: Callable[[Plan], tuple[Node, ...]] | None = None
    names_of: Callable[[Plan], set[str]] | None = None
    bound_by: Callable[[Plan], NodeRequest] | None = None
    identity_by: Callable[[Plan], Hashable] | None = None
    key: Hashable = None
    sentence: str = ""
    measures: str = ""
    parts: tuple[RequestLike, ...] = ()
    order: int = 0
    regular_above: float | None = None
    traits: Trait = NO_TRAIT
    notes_of: Callable[[Plan], Notes] | None = None
    gaps_of: Callable[[Plan], tuple[Node, ...]] | None = None
    error_of: Callable[[PrecisionLeft], FloatArray] | None = None
    values_of: Callable[[MotionLike], FloatArray] | None = None
    refused_by: Callable[[MotionLike], None] | None = None

    def identity(self, plan: Plan) -> Hashable:
        if self.identity_by is not None:
            return self.identity_by(plan)
        return None if None in [identity_of(plan, each) for each in self.parts] else self.key

    def bound(self, plan: Plan) -> NodeRequest:
        if self.bound_by is not None:
            return self.bound_by(plan)
        self.names(plan)  # raises for what there is not
        return self

    def of(self, motion: MotionLike) -> FloatArray:
        return super().of(motion) if self.values_of is None else self.values_of(motion)

    def nodes(self, plan: Plan) -> tuple[Node, ...]:
        return super().nodes(plan) if self.nodes_of is None else self.nodes_of(plan)

    def names(self, plan: Plan) -> set[str]:
        return super().names(plan) if self.names_of is None else self.names_of(plan)

    def notes(self, plan: Plan) -> Notes:
        return Notes() if self.notes_of is None else self.notes_of(plan)

    def gaps(self, plan: Plan) -> tuple[Node, ...]:
        return () if self.gaps_of is None else self.gaps_of(plan)

    def refuse(self, motion: MotionLike) -> None:
        if self.refused_by is not None:
            self.refused_by(motion)
        elif self.values_of is not None:
            motion._finite(self.values_of(motion), np.zeros(motion.shape, bool), f"The {self.sentence}")

    @property
    def regular(self) -> float:
        return super().regular if self.regular_above is None else self.regular_above

    def scale(self, plan: Plan, left: PrecisionLeft) -> FloatArray:
        return {"length": left.size, "angle": np.ones_like(left.size)}.get(self.measures, super().scale(plan, left))

    def error(self, plan: Plan, left: PrecisionLeft) -> FloatArray:
        return super().error(plan, left) if self.error_of is None else self.error_of(left)

    def __post_init__(self) -> None:
        object.__setattr__(self, "sentence", self.sentence or self.text)

    def __str__(self) -> str:
        return self.text


MINOR = 1e-3
"""Of the fastest point's ratio: what a slower one's error is compared with where both go into a force."""


def point_ratios(members: Set[str]) -> NodeRequest:
    """Return the ratios of all moving points among some members by all strokes, from which forces are computed."""
    among = frozenset(members)

    def nodes(plan: Plan) -> tuple[Node, ...]:
        places = [node for name in plan.moving if name in among for node in plan.nodes(name)]
        return tuple(node for stroke in plan.strokes for node in plan.derived(places, (stroke,)))

    def error(left: PrecisionLeft) -> FloatArray:
        parts = [left.some_rows(slice(row, row + 2)) for row in range(0, len(left.values), 2)]
        if not parts:
            return np.zeros(left.size.shape)
        with np.errstate(all="ignore"):
            largest = np.max([np.hypot(*part.values) for part in parts], axis=0)
        return np.asarray(np.max([part.norm.relative(MINOR * largest) for part in parts], axis=0))

    return NodeRequest(
        text="the ratios of the points", key=("ratios", among), nodes_of=nodes, names_of=lambda plan: set(among), order=1,
        traits=Trait.STANDS_FOR_OTHERS, error_of=error,
    )  # fmt: skip


def places_of(points: tuple[str, ...]) -> NodeRequest:
    """Return the places of some points together, a motion's first results."""

    def error(left: PrecisionLeft) -> FloatArray:
        with np.errstate(all="ignore"):
            found = left.errors.max(axis=0, initial=0.0) / left.size
        return np.where(np.isnan(found), np.inf, found)

    return NodeRequest(
        text="the places", key=("places", points), nodes_of=lambda plan: tuple(node for name in points for node in plan.nodes(name)),
        names_of=lambda plan: plan.reaches(*points), error_of=error,
    )  # fmt: skip


# Derivatives by dimensions: reverse mode through the program, all dimensions at once.


def slope(what: Request, by: tuple[str, ...]) -> NodeRequest:
    """Return the derivatives of a request that is bound by some dimensions, as a request that is looked at near singular poses."""

    def nodes(plan: Plan) -> tuple[Node, ...]:
        inputs = [plan.trace.inputs[name] for name in by]
        return tuple(share for node in what.nodes(plan) for share in gradient(node, inputs))

    return NodeRequest(
        text=f"the gradient of {what.sentence}", key=("slope", what.key, by), rows=what.rows * len(by), nodes_of=nodes, names_of=what.names,
        order=1 + what.order, notes_of=what.notes, gaps_of=what.gaps, traits=Trait.FOLLOWS_ANGLES | (what.traits & Trait.OF_LAWS),
        error_of=lambda left: left.norm.relative(SMALL),
    )  # fmt: skip


def switches_of(plan: Plan, what: Request, names: Sequence[str]) -> tuple[Kernel, list[str]]:
    """Return the kernel of nodes above zero where laws behind a request change with some dimensions, and words for each."""
    inputs = [plan.trace.inputs[name] for name in names]
    touched = [
        (switch, f"{name}: the law of {owner} compares what follows {name} with a number")
        for switch, owner in what.notes(plan).switches.items()
        for name, each in zip(names, inputs, strict=True)
        if each in ancestors([switch])
    ]
    return Kernel([switch for switch, _ in touched]), [words for _, words in touched]


# What can be asked of a pose itself: how well joints transmit, and how near it is to a singular one.


def transmission(point: Reference) -> NodeRequest:
    """Return the request for a joint's transmission angle [rad], folded to 0 ... pi/2: how far it is from the links in line.

    It is `motion.transmission_angle(point)`, and pi less it where that is above pi/2: `least(transmission("K")) >= 35 * deg`.

    Parameters
    ----------
    point : str or Point
        The point, or its name.

    Returns
    -------
    Request
        The angle [rad], 0 to pi/2.
    """
    name = name_of(point)

    def names(plan: Plan) -> set[str]:
        checked_name("Point", name, plan.points, plan.title)
        joints = plan.made(("joints",), lambda twin: tuple(each for each, step in twin.points.items() if step.meeting(twin.trace)))
        if name not in joints:
            raise no_joint(plan, name, joints)
        return plan.reaches(name)

    def nodes(plan: Plan) -> tuple[Node, ...]:
        u, w = plan.points[name].meeting(plan.trace)
        return (plan.trace.graph.node(np.arctan2(np.abs(u.cross(w)), np.abs(u.dot(w)))),)

    def values(motion: MotionLike) -> FloatArray:
        angle = motion.transmission_angle(name)
        return np.minimum(angle, np.pi - angle)

    return NodeRequest(
        text=f"transmission({name})", sentence=f"transmission angle at {name}", key=("transmission", name), measures="angle",
        nodes_of=nodes, names_of=names, values_of=values, traits=Trait.MAY_FAIL,
    )  # fmt: skip


WORST = 1e16
"""The largest condition over 2 / 0.3 that is told."""


def condition(target: str | Member | None = None) -> NodeRequest:
    """Return the request for the condition of a pose, in `evaluate`, `function` and `source`: a number, 2 / 0.3 at regular poses.

    Next to a singular pose it is 2 over the sine of the loop in line. It is the product of such where several follow one another, or where
    a direction is taken between points that come close. Above 1e4 a ratio is off by some 0.3 eps cond^2, above 1e6 it is refused.
    `condition("G")` is of what G is built from, `condition(angle("A", "P"))` of what the angle is built from and of its own direction,
    `condition()` of all points of the machine. What else is asked beside it makes no difference.

    Parameters
    ----------
    target : str or Member, optional
        The point or the quantity; by default all points.

    Returns
    -------
    Request
        The condition number.
    """

    def value(plan: Plan) -> Value | None:
        return None if target is None else Value(target).bound(plan)

    def names(plan: Plan) -> set[str]:
        of = value(plan)
        return set[str]().union(*map(plan.reaches, plan.points)) if of is None else of.names(plan)

    def nodes(plan: Plan) -> tuple[Node, ...]:
        of = value(plan)
        near = plan.trace.alone(None if of is None else of.member).nearness(names(plan), exact=True)
        return ((2.0 / REGULAR) / np.sqrt(near.graph.apply("maximum", near, WORST**-2)),)

    what = target.identity if isinstance(target, Quantity) else None if target is None else name_of(target)
    return NodeRequest(
        text=f"condition({'' if target is None else label(target)})",
        sentence=f"the condition of {'its points' if target is None else label(target)}", key=("condition", what),
        nodes_of=nodes, names_of=names, parts=() if target is None else (target,), regular_above=-1.0,
    )  # fmt: skip
