"""The equilibrium as a program: all joint forces of many poses from one kernel, friction included.

The equations of equilibrium are written on the nodes of a program and eliminated once, as for a single pin force. Friction enters as
one input a rubbing joint: its couple or its force along the guide. The joint forces are linear in these, so that a first kernel gives
the forces that press the rubbing joints, with their derivatives by the frictions; the frictions settle on arrays; a second kernel
gives everything. What the program cannot say (a law that asks for a number, arrays over the poses) is None: the equations are then
solved on arrays.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import DefinitionError
from ..motion import Motion
from ..motion.bulk import cut as cut_out
from ..motion.bulk import pieces
from ..motion.reach import Mask
from ..plan import Plan
from ..program import FloatArray, Kernel, Level, Node, Tangent
from .contacts import Contact
from .drives import cut
from .elimination import eliminated_system, held
from .law import Law
from .loaded import Case, Loaded, Loads
from .movement import Movement
from .poses import Poses
from .rub import Rub, rubs, unit_friction
from .rubbing import Pressed, settled
from .solved import Equilibrium, Solved
from .structure import Structure
from .system import System

PIECE = 1 << 13
"""Poses whose frictions are settled at a time."""
FEW = 200
"""Poses up to which solving the equations on arrays is quicker than finding the kernel."""


@dataclass(frozen=True)
class Row:
    """Where a contact's force and couple stand among a kernel's outputs; -1 for none."""

    force: int
    couple: int


@dataclass(frozen=True)
class ForceProgram:
    """The kernels of all joint forces: of what presses the rubbing joints, and of everything."""

    rubbed: tuple[int, ...]
    pressing: Kernel | None
    whole: Kernel
    rows: tuple[Row, ...]
    drives: tuple[str, ...]
    struts: tuple[str, ...]


def by_program(poses: Poses, loaded: Loaded, loads: Loads, case: Case) -> Equilibrium | None:
    """Return the forces of a motion's poses by the program; None where it cannot say them, or is not worth its making."""
    motion = poses.motion
    if not isinstance(motion, Motion) or motion.reached.size <= FEW:
        return None
    steady = steady_rates(loaded.movement)
    if steady is None:
        return None
    structure = Structure(poses.plan, loaded.elements, loaded.pushing)
    lines = structure.holding.lines
    if any(len(line.cylinders) > 1 and any(each.works_both for each in line.cylinders) for line in lines):
        return None
    rubbing = rubs(structure, poses, loaded.frictions, loaded.movement) if loaded.frictions else []
    found = program_of(poses.plan, structure, loads, case, steady, [structure.contacts.index(rub.column.contact) for rub in rubbing])
    return None if found is None else run(found, structure, poses, loaded, rubbing)


def steady_rates(movement: Movement) -> Movement | None:
    """Return a movement whose rates are the same at all poses, as numbers; None where they are not."""
    rates = {name: np.unique(np.asarray(rate, float)) for name, rate in movement.rates.items()}
    if any(len(each) != 1 for each in rates.values()):
        return None
    return Movement(movement.direction, {name: float(each[0]) for name, each in rates.items()}, movement.rubs, movement.is_timed)


def program_of(
    plan: Plan, structure: Structure, loads: Loads, case: Case, movement: Movement, rubbed: Sequence[int]
) -> ForceProgram | None:
    """Return the program of a plan's joint forces under some loads, made once; None where it cannot be traced or eliminated."""
    spans = tuple((strut.name, strut.P, strut.Q) for strut in structure.struts)
    blocks = tuple(part.name for part in structure.blocks)
    try:
        key = ("joint forces", Law.of(plan, loads, case, movement).key, spans, blocks, tuple(rubbed))
        return plan.made(key, lambda twin: made(twin, loads, case, movement, tuple(rubbed)))
    except DefinitionError:
        return None


def made(plan: Plan, loads: Loads, case: Case, movement: Movement, rubbed: tuple[int, ...]) -> ForceProgram:
    """Return the program traced on a plan of its own."""
    law = Law.on(plan, loads, case, movement)
    structure, motion = Structure(plan, law.loaded.elements, law.loaded.pushing), law.motion
    friction = [motion.reading.graph.input(friction_name(place), Level.POSE) for place in range(len(rubbed))]
    length = held(plan, law.loaded)
    contacts = [structure.contacts[index] for index in rubbed]
    columns = tuple(unit_friction(contact, law.poses) for contact in contacts)
    system = System(structure, law.poses, law.loaded.acting, columns, length)
    q = motion.array([friction])
    u = eliminated_system(system, motion, friction)
    rubbing = [Rub(column, np.zeros(1), np.zeros(1), np.zeros(1)) for column in columns]
    solved = Solved(system, u, q, np.zeros(1, bool), rubbing)
    nodes: list[Node] = []
    rows = [add(nodes, solved, contact, law) for contact in structure.contacts]
    nodes += [motion.node(solved.value(cut(system, name))[0]) for name in plan.strokes]
    nodes += [motion.node(solved.value(system.thrust(strut))[0]) for strut in structure.struts]
    guards = list(motion.notes.assumed)
    pressing = Kernel(pressing_nodes(system, u, contacts, friction, law), guards) if rubbed else None
    names = tuple(strut.name for strut in structure.struts)
    return ForceProgram(rubbed, pressing, Kernel(nodes, guards), tuple(rows), tuple(plan.strokes), names)


def friction_name(place: int) -> str:
    """Return the name of a friction's input; no dimension can be called so."""
    return f"|friction {place}"


def add(nodes: list[Node], solved: Solved, contact: Contact, law: Law) -> Row:
    """Add a contact's force and couple to the outputs, and return where they stand."""
    force, couple = solved.transmitted(contact)
    row = Row(-1, -1)
    if contact.has_force:
        row = Row(len(nodes), -1)
        nodes += [law.motion.node(part) for part in force[:, 0]]
    if "c" in contact.holds or any(rub.column.contact is contact for rub in solved.rubbing):
        row = Row(row.force, len(nodes))
        nodes.append(law.motion.node(couple[0]))
    return row


def pressing_nodes(system: System, u: Any, contacts: Sequence[Contact], friction: Sequence[Node], law: Law) -> list[Node]:
    """Return, for each rubbing joint, the forces that press it and their derivatives by each friction."""
    graph = law.motion.reading.graph
    tangents = [Tangent(graph, {each: 1.0}) for each in friction]
    found: list[Node] = []
    for contact in contacts:
        start = system.first[contact]
        forces = [law.motion.node(u[0, start + k]) for k in range(parts(contact))]
        found += forces
        found += [tangent.of(force) for force in forces for tangent in tangents]
    return found


def parts(contact: Contact) -> int:
    """Return how many components press a rubbing joint: both of a pin, the normal one of a guide."""
    return 2 if contact.kind == "pin" else 1


def run(program: ForceProgram, structure: Structure, poses: Poses, loaded: Loaded, rubbing: Sequence[Rub]) -> Equilibrium | None:
    """Return the forces by the kernels; None where an assumption of a law fails or a pose that should has no value."""
    motion, n = poses.motion, poses.count
    assert isinstance(motion, Motion)
    inputs, size = dict(motion.flat), motion.size
    q, locked = np.zeros((0, n)), np.zeros(n, bool)
    if program.pressing is not None:
        found = frictions(program, structure, poses, rubbing)
        if found is None:
            return None
        q, locked = found
        couples = poses.full(np.where(locked, 0.0, q) * np.stack([rub.lever for rub in rubbing])).reshape(len(rubbing), *size)
        inputs |= {friction_name(place): np.nan_to_num(each) for place, each in enumerate(couples)}
    result = program.whole(inputs, size=size)
    values = result.values.reshape(len(result.values), *motion.shape)
    good = poses.good & (poses.full(locked.astype(float)) != 1.0)
    whole = bool(good.all())
    if not np.all(result.guards > 0.0) or not np.isfinite(values if whole else values[:, good]).all():
        return None
    if not whole:
        values = np.where(good, values, np.nan)
    drives, struts = len(program.drives), len(program.struts)
    return Equilibrium(
        structure, poses, loaded, list(rubbing), q, locked,
        [forces_of(row, values, motion.shape) for row in program.rows],
        dict(zip(program.drives, values[len(values) - drives - struts :], strict=False)),
        dict(zip(program.struts, values[len(values) - struts :], strict=True)),
    )  # fmt: skip


def frictions(program: ForceProgram, structure: Structure, poses: Poses, rubbing: Sequence[Rub]) -> tuple[FloatArray, Mask] | None:
    """Return the frictions (frictions, n) [N] and where they have no bounded solution (n,); None where an assumption fails.

    Some thousand poses are looked at at a time: what presses the joints, with its derivatives, is much for each.
    """
    motion, count = poses.motion, len(rubbing)
    assert program.pressing is not None and isinstance(motion, Motion)
    none = {friction_name(place): 0.0 for place in range(count)}
    many = tuple(parts(structure.contacts[index]) for index in program.rubbed)
    free = [row + k for row, each in zip(np.cumsum([0, *(each * (1 + count) for each in many)]), many, strict=False) for k in range(each)]
    lever, coefficient = (np.stack([getattr(rub, what) for rub in rubbing]) for what in ("lever", "coefficient"))
    q, locked = np.zeros((count, poses.count)), np.zeros(poses.count, bool)
    places = poses.full(np.arange(poses.count, dtype=float)).reshape(motion.size)
    for band, part in pieces(*motion.size, PIECE):
        inputs = {name: cut_out(value, band, part, name in poses.plan.table.entries) for name, value in motion.flat.items()}
        here = places[band, part]
        good = np.isfinite(here)
        result = program.pressing(inputs | none, size=here.shape)
        rows = result.values.reshape(len(result.values), here.size)
        rows = rows if good.all() else rows[:, good.ravel()]
        if not np.all(result.guards > 0.0) or not np.isfinite(rows).all():
            return None
        at = here[good].astype(int)
        by_unit = np.delete(rows, free, axis=0).reshape(sum(many), count, len(at))
        q[:, at], locked[at] = settled(Pressed(many, rows[free], by_unit, lever[:, at]), coefficient[:, at])
    return q, locked


def forces_of(row: Row, values: FloatArray, shape: tuple[int, ...]) -> tuple[FloatArray, FloatArray]:
    """Return a contact's force (2, ...) and couple (...) among a kernel's values."""
    none = np.broadcast_to(np.zeros(()), shape)
    force = np.broadcast_to(np.zeros(()), (2, *shape)) if row.force < 0 else values[row.force : row.force + 2]
    return force, none if row.couple < 0 else values[row.couple]
