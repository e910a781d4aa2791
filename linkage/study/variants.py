"""The same machine as a class of its own: some of its steps on the other side, or cylinders by rows of a catalogue."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

from ..assembly import members_on_sides
from ..errors import DefinitionError, ensure, is_listed, require
from ..frozen import FrozenDict
from ..loads import TwoPoint
from ..mechanism import Mechanism, declared
from ..plan import Part, Plan, Reading
from ..quantities import Dimension, Member, Stroke, Variable, is_member_or_name, is_number, name_of, quantity, signed_terms
from ..steps import Drawn, Point, Step
from ..vectors import Numbers, Side

ENDING = ".side"


def is_side(name: str) -> bool:
    """Return whether a name is that of a step's side."""
    return name.endswith(ENDING)


def sided_step(machine: Mechanism, name: object) -> str:
    """Return the step whose side a name such as `B.side` stands for; "" for other names, DefinitionError for a step without a side."""
    plan = machine.plan
    if not isinstance(name, str) or not is_side(name):
        return ""
    step = name.removesuffix(ENDING)
    having = [each for each, member in plan.members.items() if isinstance(member, Step) and member.modes()]
    member = plan.members.get(step)
    behind = [group.pins for group in plan.groups.values() if step in having and step in plan.reaches(*group.pins)]
    if isinstance(member, Point) and member.companions:
        text = f"{step} is found together with {' '.join(member.companions)}, whose mode is that of their places in the sketch"
        wrong = f"{text}, near=(x, y); write a class for each mode"
    elif step not in having:
        wrong = f"{step} has no side to choose; its sides are {', '.join(f'{each}{ENDING}' for each in having) or 'none'}"
    elif behind:
        wrong = f"the pins {' '.join(behind[0])} stand on {step} and are followed from the sketch; write a class for each side"
    else:
        return step
    raise DefinitionError(f"{plan.title}: vary={{{name!r}: ...}}: {wrong}.")


def on_sides(machine: Mechanism, sides: Mapping[str, Side]) -> Mechanism:
    """Return a design with some steps on these sides; itself where they are."""
    found = variant(type(machine), sides)
    return machine if found is type(machine) else found(**machine.dimensions)


def sided_now(member: Member) -> Side | None:
    """Return the side of a step; None without one."""
    return member.side if isinstance(member, Step) else None


def class_like(kind: type[Mechanism], own: Mapping[str, object], sent: Callable[[Mechanism], tuple[object, ...]]) -> type[Mechanism]:
    """Return a subclass of the same name with members of its own; `sent` returns the pickled state of its designs."""
    text = {"__module__": kind.__module__, "__qualname__": kind.__qualname__, "__doc__": kind.__doc__}
    maker: Any = type(kind)
    made: type[Mechanism] = maker(kind.__name__, (kind,), {**text, **own, "__reduce__": sent})
    return made


# Rows of a catalogue for a cylinder by its name: they set its sizes, the linkage's closed length, and the range of its stroke.
#
#     vary={"lift": catalogue(dead=0.2)}        AB = L0 + S:   L0 = the row's closed length, S from 0 to the row's stroke
#                                               AB = 1.79 + S: S from closed - 1.79 to closed + stroke - 1.79
#
# A machine of a row is of a subclass whose stroke has that range, so that whatever is asked of it holds over the cylinder's whole way.

LENGTHS = ("closed", "stroke")
Pairs: TypeAlias = Mapping[str, tuple[float, float]]


class Range(NamedTuple):
    """The part of a stroke that is looked at, from low to high: numbers [SI], or quantities that follow the design."""

    low: Any
    high: Any

    @property
    def is_travel(self) -> bool:
        """Whether it is the whole way of a cylinder that is chosen by its row of a catalogue, and so the stroke of the machine."""
        return isinstance(self, Travel)

    @property
    def follows(self) -> tuple[object, ...]:
        """The ends that follow the design."""
        return tuple(end for end in (self.low, self.high) if not is_number(end))


class Travel(Range):
    """The range of a stroke over which a cylinder goes its whole way: two ends, as any range."""


def fitted_rows(machine: Mechanism, vary: Any) -> tuple[Mechanism, Any, dict[str, Range]]:
    """Return a machine whose cylinders a search can set by rows, its variables then, and the ranges of the strokes that drive these.

    Rows of the cylinders that `vary` names become rows of their dimensions; DefinitionError for anything else.
    """
    elements = machine.plan.of_kind(TwoPoint)
    named = {name: rows for name, rows in vary.items() if name in elements} if isinstance(vary, Mapping) else {}
    if not named:
        return machine, vary, {}
    lengths = {}
    for name, rows in named.items():
        fields = fields_of(machine.plan, name, rows)
        given = [elements[name].given(field) for field in LENGTHS]
        if set(LENGTHS) <= set(fields) and None in given:
            lengths[name] = (float(rows[0].closed), float(rows[0].stroke))
    if lengths:
        machine = variant(type(machine), lengths=lengths)(**machine.dimensions)
    found: dict[Any, Any] = {name: each for name, each in vary.items() if name not in named}
    travels: dict[str, Range] = {}
    for name, rows in named.items():
        names, table, travel = rows_fitted(machine, name, rows)
        found[names] = table
        travels |= travel
    return machine, found, travels


def fields_of(plan: Plan, name: str, rows: object) -> tuple[str, ...]:
    """Return the fields that the rows for an element set; DefinitionError for rows without any, or unknown fields."""
    listed = list(rows) if is_listed(rows) else []
    fields = {getattr(type(row), "_fields", ()) for row in listed}
    known = plan.of_kind(TwoPoint)[name].parameters
    (own,) = fields if len(fields) == 1 else ((),)
    example = f'vary={{"{name}": hydraulics.catalogue(dead=120 * mm)}}, or a tuple of its dimensions, ("{name}.bore", ...)'
    require(own and set(own) <= set(known), f"{plan.title}: {name}", rows, f"rows of a catalogue are expected, {example}")
    return tuple(own)


def rows_fitted(machine: Mechanism, cylinder: str, rows: Sequence[Any]) -> tuple[tuple[str, ...], list[Sequence[float]], dict[str, Range]]:
    """Return the names of the dimensions that a cylinder's rows set, the rows as numbers [SI], and the range of the stroke that drives it.

    DefinitionError where one of them follows an expression.
    """
    plan = machine.plan
    element, fields = plan.of_kind(TwoPoint)[cylinder], fields_of(plan, cylinder, rows)
    names = []
    for field in fields:
        given, own = element.given(field), f"{element.name}.{field}"
        name = own if own in plan.table.spellings else name_of(given) if is_member_or_name(given) else ""
        ensure(name in plan.table.spellings, f"{plan.title}: {own} follows {given}; a row of a catalogue sets a number or a dimension.")
        names.append(name)
    table: list[Sequence[float]] = [tuple(float(value) for value in row) for row in rows]
    if not set(LENGTHS) <= set(fields):
        return tuple(names), table, {}
    stroke, others = length_of(machine, cylinder)
    closed, reach = (names[fields.index(field)] for field in LENGTHS)
    start = float(plan.strokes[stroke].start)
    rest = sum(value for _, value in others)
    dimension = next((each for each, _ in others if each), "")
    along = Variable(plan.table.spellings[reach][0])
    if not dimension:
        begin = Variable(plan.table.spellings[closed][0]) - rest
        return tuple(names), table, {stroke: Travel(begin, begin + along)}
    if dimension != closed:
        now = dict(others)[dimension]
        table = [(*row, row[fields.index("closed")] - (rest - now) - start) for row in table]
        return (*names, dimension), table, {stroke: Travel(start, along + start)}
    low = dict(others)[dimension] - rest  # the cylinder's closed length is the dimension itself
    return tuple(names), table, {stroke: Travel(low, along + low)}


def length_of(machine: Mechanism, name: str) -> tuple[str, list[tuple[str, float]]]:
    """Return the stroke that drives a cylinder, and the other terms of its length: dimensions by name, "" of others, with values [m].

    DefinitionError where its length is no stroke and what stands beside it.
    """
    plan = machine.plan
    ends = plan.of_kind(TwoPoint)[name].ends
    length = next((bar.length for bar in plan.cylinders if {bar.P, bar.Q} == set(ends)), None)
    terms = [] if length is None else [*signed_terms(quantity(length), plan.members)]
    strokes = [(sign, each.name) for sign, each in terms if isinstance(each, Stroke)]
    if len(strokes) != 1 or strokes[0][0] != 1.0:
        label = "".join(ends)
        what = f"{plan.title}: the length of {name} is {'driven by no stroke' if length is None else length}"
        raise DefinitionError(f"{what}; rows of a catalogue set one that is a length and a stroke, {label}=L0 + S.")
    reading = Reading(plan.members, plan.table.lengths, {**machine.dimensions, **plan.sketch_strokes})
    others = []
    for sign, each in terms:
        if not isinstance(each, Stroke):
            own = each.name if isinstance(each, Dimension) else each.variable if isinstance(each, Variable) else ""
            value = sign * float(reading.value(each))
            others.append((own if sign == 1.0 and own in plan.table.spellings else "", value))
    return strokes[0][1], others


# Classes of variants.

BEFORE = "_class_before"
NOTHING: Mapping[str, Any] = FrozenDict()


def variant(
    kind: type[Mechanism], sides: Mapping[str, Side] = NOTHING, lengths: Pairs = NOTHING, travels: Pairs = NOTHING
) -> type[Mechanism]:
    """Return a class like another one, each kind once: itself where nothing is different.

    Some steps are on these `sides`, cylinders have these closed lengths and strokes, strokes these ranges.
    """
    base, before = vars(kind).get(BEFORE, (kind, (NOTHING, NOTHING, NOTHING)))
    different = [{**old, **new} for old, new in zip(before, (sides, lengths, travels), strict=True)]
    different[0] = {name: side for name, side in different[0].items() if sided_now(base.plan.members[name]) is not side}
    key = ("variant", *(tuple(sorted(each.items())) for each in different))
    found: type[Mechanism] = base.plan.made(key, lambda _: made_variant(base, *different)) if any(different) else base
    return found


def made_variant(kind: type[Mechanism], sides: Mapping[str, Side], lengths: Pairs, travels: Pairs) -> type[Mechanism]:
    """Return a subclass that is different in this, its steps of parts too."""
    plan, written = kind.plan, declared(kind)
    own: dict[str, Any] = {**members_on_sides(plan, written, sides)} if sides else {}
    parts: dict[str, dict[str, Side]] = {}
    for name, side in sides.items():
        if name not in written:
            part = next(each for each in written if name.startswith(f"{each}.") and isinstance(written[each], Part))
            parts.setdefault(part, {})[name.removeprefix(f"{part}.")] = side
    for name, inner in parts.items():  # these sides are those in the whole: of a mirrored part each is the other one in itself
        inside: Any = written[name]
        seen = {each: sided_now(inside.plan.members[each]) is sided_now(plan.members[f"{name}.{each}"]) for each in inner}
        other = variant(inside.machine, {each: side if seen[each] else Side(-side) for each, side in inner.items()})
        own[name] = inside.renewed(machine=other, plan=other.plan)
    for name in (*lengths, *travels):
        what = f"{plan.title}: {name} is a part's own; rows of a catalogue set what the class itself declares"
        ensure(name in written, f"{what}: vary them in the part, or vary the dimensions by name.")
    own |= {name: written[name].renewed(**dict(zip(LENGTHS, ends, strict=True))) for name, ends in lengths.items()}
    own |= {name: Stroke(*ends) for name, ends in travels.items()}
    if travels and not any(isinstance(each, Drawn) for each in written.values()):
        own["sketch"] = Drawn(plan.sketch_strokes)
    different = dict(sides), dict(lengths), dict(travels)

    def sent(machine: Mechanism) -> tuple[object, ...]:
        return remade, (kind(**{name: machine.dimensions[name] for name in plan.defaults}), different, machine.dimensions)

    made = class_like(kind, {**own, BEFORE: (kind, different)}, sent)
    lost = [name for name, side in sides.items() if sided_now(made.plan.members[name]) is not side]
    if lost:
        raise DefinitionError(f"{plan.title}: {lost[0]} cannot be put on the side {sides[lost[0]]} from here; write a class for it.")
    return made


def remade(base: Mechanism, different: tuple[Mapping[str, Any], ...], dimensions: Mapping[str, Numbers]) -> Mechanism:
    """Return the design of a variant that was sent."""
    return variant(type(base), *different)(**dimensions)
