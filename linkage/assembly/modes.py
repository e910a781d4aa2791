"""All assembly modes of a mechanism at a pose: every choice of sides, and of a group's pins, that can be assembled, with its code."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from copy import copy
from dataclasses import field
from itertools import permutations

import numpy as np

from ..errors import AssemblyError, ensure
from ..frozen import record
from ..plan import ArrayReading, Plan, as_written
from ..program import FloatArray
from ..quantities import Member, joined_names, name_of, of_kind
from ..shown import Shown
from ..steps import Link, Pin, Step
from ..vectors import Numbers, Side
from .groups import solve_groups
from .newton import Newton, at_sketch
from .sketch import Place, places_at

MOST = 16
STARTS, ROUNDS = 500, 5
"""From how many places at random the pins of a group are looked for, the same ones each time, and how often Newton's method goes on."""
SAME = 1e-6
"""Solutions nearer to each other than this part of the mechanism's size are one."""


@record
class Assembly(Shown):
    """One way to put a mechanism together: the side of each dyad, and where the points are then [m].

    `lines` are the lines of the class that are different for it, by member; none for the mode that is declared. `pins` are the rough
    places of the pins of groups that choose it [m].
    """

    sides: Mapping[str, Side]
    places: Mapping[str, tuple[float, float]]
    lines: Mapping[str, str] = field(default_factory=dict)
    pins: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    plan: Plan | None = field(default=None, repr=False, compare=False)
    inputs: Mapping[str, Numbers] = field(default_factory=dict, repr=False, compare=False)

    @property
    def is_declared(self) -> bool:
        """Whether it is the mode that the class declares."""
        return not self.lines

    @property
    def code(self) -> str:
        """The lines that choose it, in place of those of the class; empty for the mode that is declared."""
        return "\n".join(f"{name} = {text}" for name, text in self.lines.items())

    def __str__(self) -> str:
        said = [f"{name} {side}" for name, side in self.sides.items()]
        return ", ".join([*said, *(f"{name} near ({x:.4g}, {y:.4g})" for name, (x, y) in self.pins.items())])


def assemblies(plan: Plan, inputs: Mapping[str, Numbers], declared: Mapping[str, Member]) -> list[Assembly]:
    """Return the assembly modes that exist for given inputs [SI], the declared one first where it exists.

    `declared` are the members as the class writes them. Where there are groups, the pins of these are found from places at random, and
    the dyads that they stand on keep their sides. Raises DefinitionError beyond 16 dyads, which have more than 65,536 modes.
    """
    before = plan.reaches(*(pin for group in plan.groups.values() for pin in group.pins)) if plan.groups else frozenset()
    dyads = {name: step for name, step in plan.of_kind(Step).items() if step.closes and step.modes() and name not in before}
    ensure(len(dyads) <= MOST, f"{plan.title} has {len(dyads)} dyads: assembly modes are listed for up to {MOST}.")
    found = []
    for pins, members, solved in group_modes(plan, inputs):
        for sides, places in _modes(plan, {**inputs, **solved}, dict(members), list(dyads)):
            changed = {name for name in dyads if sides[name] is not dyads[name].side} | set(pins)
            chosen = members | {name: sided_as(dyads[name], sides[name]) for name in dyads}
            lines = written_lines(plan, declared, chosen, changed, pins)
            found.append(Assembly(sides, places, lines, pins, Plan(chosen, plan.title) if changed else plan, inputs))
    return sorted(found, key=lambda each: bool(each.lines))


def _modes(
    plan: Plan, inputs: Mapping[str, Numbers], members: dict[str, Member], left: list[str]
) -> Iterator[tuple[dict[str, Side], dict[str, tuple[float, float]]]]:
    """Yield sides and places with the sides of the remaining dyads chosen, the declared side first; a mode out of reach is cut off."""
    reading = ArrayReading(members, plan.table.lengths, inputs)
    done = [name for name in plan.points if not plan.reaches(name) & set(left)]
    with np.errstate(all="ignore"):
        places = {name: (float(reading.at(name).x), float(reading.at(name).y)) for name in done}
    if not np.isfinite(list(places.values())).all():
        return
    if not left:
        steps = {name: step for name, step in of_kind(members, Step).items() if step.closes and step.modes()}
        yield {name: steps[name].settled_side for name in plan.points if name in steps}, places
        return
    declared = of_kind(members, Step)[left[0]]
    for side in sorted(declared.modes(), key=lambda each: each is not declared.side):
        yield from _modes(plan, inputs, {**members, left[0]: sided_as(declared, side)}, left[1:])


def sided_as(step: Step, side: Side) -> Step:
    """Return a step on a side, without a sketch position."""
    return step if step.side is side else step.renewed(side=side, near=None)


# The lines of code that choose a mode.


def written_lines(
    plan: Plan, declared: Mapping[str, Member], chosen: Mapping[str, Member], changed: set[str], pins: Mapping[str, tuple[float, float]]
) -> dict[str, str]:
    """Return the lines that are different where some members are: their own, and those of sketch positions that go with them.

    A pin of a parts list has a new rough place. If it is drawn, so that lengths are measured from it, its step is written instead. A pin of
    a group has no step: the links with these lengths are written.
    """
    if not changed:
        return {}
    try:
        sketch: Mapping[str, tuple[float, float]] = places_at(Plan(chosen, plan.title), plan.sketch_strokes)[0]
    except AssemblyError:
        sketch = {}
    lines = {}
    is_drawn = any(isinstance(raw := declared.get(name), Pin) and raw.drawn_at is not None for name in pins)
    for name in plan.points:
        raw, follows = declared.get(name), bool(plan.reaches(name) & changed)
        if name not in changed and not (follows and is_sketched(raw)):
            continue
        place = pins.get(name, sketch.get(name))
        if isinstance(raw, Pin) and (raw.near is not None or is_drawn) and place is not None:
            lines[name] = as_written(Pin(near=rounded_to(place, 4)), plan.turning)
        elif isinstance(step := chosen[name], Step):
            lines[name] = as_written(sided_as(step, step.settled_side) if step.modes() else step, plan.turning).partition(", near=")[0]
            lines[name] += ")" * (lines[name].count("(") - lines[name].count(")"))
    for name, link in declared.items() if is_drawn else ():  # links of the pins, with what was measured from the drawing
        if isinstance(link, Link) and not pins.keys().isdisjoint(points := [name_of(point) for point in link.points]):
            spelled = {joined_names(*several) for count in (2, 3) for several in permutations(points, count)}
            given = {plan.table.spellings[label][0] for label in link.labels if label in plan.table.spellings}
            measured = {label: plan.defaults[label] for label in plan.table.entries if label in spelled - given}
            if measured:
                lines[name] = as_written(Link(" ".join(points), **{**link.labels, **measured}), plan.turning)
    return lines


def is_sketched(member: Member | None) -> bool:
    """Return whether a sketch position says on which side a member is."""
    return isinstance(member, (Step, Pin)) and getattr(member, "side", None) is None and (member.near or member.drawn_at) is not None


def rounded_to(place: Place, digits: int) -> Place:
    """Return a place by so many digits."""
    x, y = (float(f"{value:.{digits}g}") for value in place)
    return x, y


# Members as they are written on other sides.


def members_on_sides(plan: Plan, declared: Mapping[str, Member], sides: Mapping[str, Side]) -> dict[str, Member]:
    """Return the members that a subclass declares anew to have some steps on other sides; steps of parts are for the parts to say.

    Beside these steps they are the points whose side a place in the sketch says, and that move in it with them.
    """
    chosen = with_own_groups(plan, {})
    chosen |= {name: sided_as(plan.of_kind(Step)[name], side) for name, side in sides.items()}
    own = {name: written_as(declared[name], chosen[name], None) for name in sides if name in declared}
    moved = [name for name in plan.points if is_sketched(declared.get(name)) and plan.reaches(name) & set(sides)]
    try:
        places: Mapping[str, Place] = places_at(Plan(chosen, plan.title), plan.sketch_strokes)[0] if moved else {}
    except AssemblyError:
        places = {}
    return own | {name: written_as(declared[name], chosen[name], places.get(name)) for name in moved}


def written_as(raw: Member, chosen: Member, place: Place | None) -> Member:
    """Return a point as a member to write: a pin of links at its new rough place, where there is one, else its step on its side."""
    if isinstance(raw, Pin) and raw.near is not None and place is not None:
        return Pin(near=rounded_to(place, 6))
    assert isinstance(chosen, Step)
    return chosen.renewed(side=chosen.side, near=None, drawn_at=None)


# Groups: their pins' solutions at the sketch, found from many places.


def group_modes(plan: Plan, inputs: Mapping[str, Numbers]) -> Iterator[tuple[dict[str, Place], dict[str, Member], Mapping[str, Numbers]]]:
    """Yield the modes of a plan's groups, the declared one first: pins' places at the sketch, the members, the pins at the inputs."""
    yield {}, with_own_groups(plan, {}), {}
    if not plan.groups:
        return
    known, designs = at_sketch(plan), {name: inputs[name] for name in plan.defaults}
    strokes = {name: np.atleast_1d(np.asarray(inputs[name], float)) for name in plan.strokes}
    at: dict[str, Numbers] = {**plan.defaults, **plan.sketch_strokes}
    for name, group in plan.groups.items():  # the pins of one group elsewhere, then of the next
        newton = Newton(plan, group)
        for u in other_solutions(newton, at, known[name]):
            pins = {pin: (float(x), float(y)) for pin, x, y in zip(group.pins, u[0::2, 0], u[1::2, 0], strict=True)}
            members = with_own_groups(plan, pins)
            try:
                solved = solve_groups(Plan(members, plan.title), designs, strokes).inputs
            except AssemblyError:  # the way from the sketch does not reach them
                continue
            flat = {pin: float(np.ravel(value)[0]) for pin, value in solved.items()}
            if np.isfinite(list(flat.values())).all():
                yield pins, members, flat
        at |= dict(zip(newton.names, known[name], strict=True))


def with_own_groups(plan: Plan, pins: Mapping[str, tuple[float, float]]) -> dict[str, Member]:
    """Return a plan's members with copies of its groups and their pins, which another plan may settle; some pins at other rough places."""
    members: dict[str, Member] = dict(plan.members)
    for name, group in plan.groups.items():
        own = members[name] = copy(group)
        for pin in group.pins:
            moved = {"near": rounded_to(pins[pin], 6), "drawn_at": None} if pin in pins else {}
            members[pin] = plan.of_kind(Pin)[pin].renewed(group=own, **moved)
    return members


def other_solutions(newton: Newton, inputs: Mapping[str, Numbers], known: FloatArray) -> list[FloatArray]:
    """Return the solutions of a group beside the known one, shape (coordinates, 1) each, from many places."""
    x, y = known[0::2], known[1::2]
    plan = newton.plan
    with np.errstate(all="ignore"):
        reading = plan.read({**inputs, **dict(zip(newton.names, known, strict=True)), newton.group.inputs[-1]: 1.0})
    others = [reading.at(name) for name in plan.points if not plan.reaches(name) & set(newton.group.pins)]
    xs, ys = [*x.ravel(), *(float(np.ravel(each.x)[0]) for each in others)], [*y.ravel(), *(float(np.ravel(each.y)[0]) for each in others)]
    size = max(np.ptp(xs), np.ptp(ys)) or 1.0
    middle = np.tile([0.5 * (min(xs) + max(xs)), 0.5 * (min(ys) + max(ys))], len(known) // 2)[:, None]
    guess = middle + size * np.random.default_rng(0).uniform(-1.0, 1.0, (len(known), STARTS))
    held, found = newton.fixed_inputs(inputs), [known]
    for _ in range(ROUNDS):
        guess, done = newton.correct(held, guess, np.full(guess.shape[1], size))
        for u in guess[:, done].T[:, :, None]:
            if all(np.abs(u - each).max() > SAME * size for each in found):
                residual, rows, _ = newton.system(inputs, u)
                # where the pins could give way the modes meet
                is_held = np.isfinite(rows).all() and np.linalg.svd(rows[:, :, 0], compute_uv=False)[-1] > SAME
                found += [u] if is_held and np.abs(residual).max() <= SAME * size else []
        left = ~done & np.isfinite(guess).all(axis=0)
        if not left.any():
            break
        guess = guess[:, left]
    return found[1:]
