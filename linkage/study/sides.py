"""The same machine on another branch: some of its steps on the other side, as a class of its own."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from ..assembly import members_on_sides
from ..errors import DefinitionError
from ..mechanism import Mechanism, declared
from ..plan import Part
from ..quantities import Member
from ..steps import Point, Step
from ..vectors import Side

ENDING = ".side"
BASE = "_class_before_sides"


def is_side(name: str) -> bool:
    """Return whether a name is that of a step's side."""
    return name.endswith(ENDING)


def sided_step(machine: Mechanism, name: object) -> str:
    """Return the step whose side a name such as `B.side` stands for; "" for other names, DefinitionError for what has no side."""
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
    found = class_on_sides(type(machine), sides)
    return machine if found is type(machine) else found(**machine.dimensions)


def sided_now(member: Member) -> Side | None:
    """Return the side of a step; None for what has none."""
    return member.side if isinstance(member, Step) else None


def class_on_sides(kind: type[Mechanism], sides: Mapping[str, Side]) -> type[Mechanism]:
    """Return a class like another one but for the sides of some steps, each kind once."""
    base, before = vars(kind).get(BASE, (kind, {}))
    wanted = {name: side for name, side in {**before, **sides}.items() if sided_now(base.plan.members[name]) is not side}
    if not wanted:
        return base  # type: ignore[no-any-return]
    found: type[Mechanism] = base.plan.made(("sides", *sorted(wanted.items())), lambda _: made_on_sides(base, wanted))
    return found


def made_on_sides(kind: type[Mechanism], sides: Mapping[str, Side]) -> type[Mechanism]:
    """Return a subclass with some steps on these sides, of its parts too."""
    plan, written = kind.plan, declared(kind)
    own = members_on_sides(plan, written, sides)
    parts: dict[str, dict[str, Side]] = {}
    for name, side in sides.items():
        if name not in written:
            part = next(each for each in written if name.startswith(f"{each}.") and isinstance(written[each], Part))
            parts.setdefault(part, {})[name.removeprefix(f"{part}.")] = side
    for name, inner in parts.items():  # these sides are those in the whole: of a mirrored part each is the other one in itself
        inside: Any = written[name]
        seen = {each: sided_now(inside.plan.members[each]) is sided_now(plan.members[f"{name}.{each}"]) for each in inner}
        other = class_on_sides(inside.machine, {each: side if seen[each] else Side(-side) for each, side in inner.items()})
        own[name] = inside.renewed(machine=other, plan=other.plan)
    made = class_like(kind, {**own, BASE: (kind, dict(sides))}, sent_on_sides)
    lost = [name for name, side in sides.items() if sided_now(made.plan.members[name]) is not side]
    if lost:
        raise DefinitionError(f"{plan.title}: {lost[0]} cannot be put on the side {sides[lost[0]]} from here; write a class for it.")
    return made


def class_like(kind: type[Mechanism], own: Mapping[str, object], sent: Callable[[Mechanism], tuple[object, ...]]) -> type[Mechanism]:
    """Return a subclass of the same name with members of its own; `sent` says what pickle is to make its designs of."""
    text = {"__module__": kind.__module__, "__qualname__": kind.__qualname__, "__doc__": kind.__doc__}
    maker: Any = type(kind)
    made: type[Mechanism] = maker(kind.__name__, (kind,), {**text, **own, "__reduce__": sent})
    return made


def sent_on_sides(machine: Mechanism) -> tuple[object, ...]:
    """Return what pickle is to make a design of such a class of: that of the class as it is written, on these sides."""
    kind, sides = vars(type(machine))[BASE]
    return on_sides, (kind(**machine.dimensions), sides)
