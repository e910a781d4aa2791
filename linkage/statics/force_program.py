"""The equilibrium as a program: all joint forces of many poses from one kernel, friction included.

The equations of equilibrium are written on the nodes of a program and eliminated once, as for a single pin force. Friction enters as
one input a rubbing joint: its couple or its force along the guide. The joint forces are linear in these. A kernel of a few outputs adds
up how much the frictions make each other grow: where that is a contraction, a second one, of the forces that press the rubbing joints,
is asked until they stay; elsewhere a third gives their derivatives, and the frictions settle on arrays. A last one gives everything.
What the program cannot say (a law that asks for a number, arrays over the poses) is None: the equations are then
solved on arrays.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..errors import DefinitionError
from ..motion import Motion
from ..motion.evaluation import part_of_input, pieces
from ..motion.limits import Mask
from ..plan import Plan
from ..program import FloatArray, Kernel, Level, Node, Tangent
from .acting import Case, Loaded, Loads, Movement
from .equilibrium import System
from .friction import CONTRACTS, Pressed, Rows, Rub, iterated, rubs, settled, unit_friction
from .joints import Contact, Structure
from .poses import Poses
from .solution import Equilibrium, Solved, cut
from .traced_loads import Law, eliminated_system, held, rate_name

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
class Rubbing:
    """The kernels of the forces that press rubbing joints: `growth` of the sums by all frictions, `forces`, `by_each` friction."""

    growth: Kernel
    forces: Kernel
    by_each: Kernel


@dataclass(frozen=True)
class ForceProgram:
    """The kernels of all joint forces: of how frictions grow, of what presses the rubbing joints, that by each friction; of everything."""

    rubbed: tuple[int, ...]
    rubbing: Rubbing | None
    whole: Kernel
    rows: tuple[Row, ...]
    drives: tuple[str, ...]
    struts: tuple[str, ...]


class AssumptionError(Exception):
    """What the program takes for granted does not hold at some pose: the equations are solved on arrays instead."""


def by_program(poses: Poses, loaded: Loaded, loads: Loads, case: Case) -> Equilibrium | None:
    """Return the forces of a motion's poses by the program; None where it cannot say them, or is not worth its making."""
    motion = poses.motion
    if not isinstance(motion, Motion) or motion.reached.size <= FEW:
        return None
    structure = Structure(poses.plan, loaded.elements, loaded.pushing)
    if any(line.changes_shares for line in structure.holding.lines):
        return None
    rubbing = rubs(structure, poses, loaded.frictions, loaded.movement) if loaded.frictions else []
    rubbed = [structure.contacts.index(rub.column.contact) for rub in rubbing]
    found = program_of(poses.plan, structure, loads, case, loaded.movement, rubbed)
    return None if found is None else run(found, structure, poses, loaded, rubbing)


def rate_inputs(motion: Motion, movement: Movement) -> dict[str, Any]:
    """Return the rates of the strokes as a kernel takes them, of all designs and poses."""
    rates = {name: np.broadcast_to(np.asarray(rate, float), motion.shape) for name, rate in movement.rates.items()}
    return {rate_name(name): rate.reshape(motion._grid.size) for name, rate in rates.items()}


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
    friction = [motion._reading.graph.input(friction_name(place), Level.POSE) for place in range(len(rubbed))]
    length = held(plan, law.loaded)
    contacts = [structure.contacts[index] for index in rubbed]
    columns = tuple(unit_friction(contact, law.poses) for contact in contacts)
    system = System(structure, law.poses, law.loaded.acting, columns, length)
    q = motion._array([friction])
    u = eliminated_system(system, motion, friction)
    rubbing = [Rub(column, np.zeros(1), np.zeros(1), np.zeros(1)) for column in columns]
    solved = Solved(system, u, q, np.zeros(1, bool), rubbing)
    nodes: list[Node] = []
    rows = [add(nodes, solved, contact, law) for contact in structure.contacts]
    nodes += [motion.node(solved.value(cut(system, name))[0]) for name in plan.strokes]
    nodes += [motion.node(solved.value(system.thrust(strut))[0]) for strut in structure.struts]
    guards = list(motion.notes.assumed)
    rubs_by = rubbing_kernels(system, u, contacts, friction, law, guards) if rubbed else None
    names = tuple(strut.name for strut in structure.struts)
    return ForceProgram(rubbed, rubs_by, Kernel(nodes, guards), tuple(rows), tuple(plan.strokes), names)


def friction_name(place: int) -> str:
    """Return the name of a friction's input; no dimension can be called so."""
    return f"|friction {place}"


def lever_name(place: int) -> str:
    """Return the name of the size of a friction's lever as an input."""
    return f"|lever {place}"


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


def rubbing_kernels(
    system: System, u: Any, contacts: Sequence[Contact], friction: Sequence[Node], law: Law, guards: list[Node]
) -> Rubbing:
    """Return the kernels of the forces that press the rubbing joints."""
    graph = law.motion._reading.graph
    tangents = [Tangent(graph, {each: 1.0}) for each in friction]
    levers = [graph.input(lever_name(place), Level.POSE) for place in range(len(friction))]
    forces: list[Node] = []
    by_each: list[Node] = []
    growth: list[Node] = []
    for contact in contacts:
        start = system.first[contact]
        own = [law.motion.node(u[0, start + k]) for k in range(contact.presses)]
        slopes = [[tangent.of(force) for tangent in tangents] for force in own]
        forces += own
        by_each += [each for row in slopes for each in row]
        pairs = list(zip(*slopes, strict=True))
        sizes = [np.abs(each[0]) if len(each) == 1 else np.sqrt(each[0] * each[0] + each[1] * each[1]) for each in pairs]
        growth.append(sum((size * lever for size, lever in zip(sizes[1:], levers[1:], strict=True)), sizes[0] * levers[0]))
    return Rubbing(Kernel(growth, guards), Kernel(forces, guards), Kernel([*forces, *by_each], guards))


def run(program: ForceProgram, structure: Structure, poses: Poses, loaded: Loaded, rubbing: Sequence[Rub]) -> Equilibrium | None:
    """Return the forces by the kernels; None where an assumption of a law fails or a pose that should has no value."""
    motion, n = poses.motion, poses.count
    assert isinstance(motion, Motion)
    inputs, size = motion._grid.flat | rate_inputs(motion, loaded.movement), motion._grid.size
    q, locked = np.zeros((0, n)), np.zeros(n, bool)
    if program.rubbing is not None:
        try:
            q, locked = frictions(program, structure, poses, rubbing, inputs)
        except AssumptionError:
            return None
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


def frictions(
    program: ForceProgram, structure: Structure, poses: Poses, rubbing: Sequence[Rub], given: dict[str, Any]
) -> tuple[FloatArray, Mask]:
    """Return the frictions (frictions, n) [N] and where they have no bounded solution (n,); AssumptionError where an assumption fails.

    Some thousand poses are looked at at a time: what presses the joints, with its derivatives, is much for each.
    """
    motion, kernels = poses.motion, program.rubbing
    assert kernels is not None and isinstance(motion, Motion)
    rows = Rows(tuple(structure.contacts[index].presses for index in program.rubbed))
    lever, coefficient = (np.stack([getattr(rub, what) for rub in rubbing]) for what in ("lever", "coefficient"))
    q, locked = np.zeros((len(rubbing), poses.count)), np.zeros(poses.count, bool)
    places = poses.full(np.arange(poses.count, dtype=float)).reshape(motion._grid.size)
    for band, part in pieces(*motion._grid.size, PIECE):
        inputs = {name: part_of_input(value, band, part, name in poses.plan.table.entries) for name, value in given.items()}
        here = places[band, part]
        good = np.isfinite(here)
        at = here[good].astype(int)
        if not at.size:
            continue
        q[:, at], locked[at] = Piece(inputs, here.shape, good, rows, lever[:, at], coefficient[:, at]).settled(kernels)
    return q, locked


@dataclass(frozen=True)
class Piece:
    """Some poses on their way to settled frictions: the inputs of the kernels, their shape, the poses that count, and what rubs there."""

    inputs: dict[str, Any]
    shape: tuple[int, ...]
    good: Mask
    rows: Rows
    lever: FloatArray
    coefficient: FloatArray

    def settled(self, kernels: Rubbing) -> tuple[FloatArray, Mask]:
        """Return the frictions (frictions, n) and the locked poses (n,); AssumptionError where an assumption fails."""
        growth = self.asked(kernels.growth, lever_name, np.abs(self.lever))
        if np.max(growth * self.coefficient, initial=0.0) < CONTRACTS:
            q = iterated(self.rows, self.coefficient, lambda q: self.asked(kernels.forces, friction_name, q * self.lever))
            return q, np.zeros(q.shape[1], bool)
        values = self.asked(kernels.by_each, friction_name, np.zeros(self.lever.shape))
        forces = sum(self.rows.parts)
        by_unit = values[forces:].reshape(forces, len(self.lever), -1)
        return settled(Pressed(self.rows, values[:forces], by_unit, self.lever), self.coefficient)

    def asked(self, kernel: Kernel, name: Callable[[int], str], values: FloatArray) -> FloatArray:
        """Return a kernel's outputs (outputs, n) for values (frictions, n) of the inputs so named."""
        whole = bool(self.good.all())
        given: dict[str, Any] = {}
        for place, each in enumerate(values):
            full = each if whole else np.zeros(self.shape)
            if not whole:
                full[self.good] = each
            given[name(place)] = full.reshape(self.shape)
        result = kernel(self.inputs | given, size=(self.shape[0], self.shape[1]))
        rows = result.values.reshape(len(result.values), -1)
        rows = rows if whole else rows[:, self.good.ravel()]
        if not (np.all(result.guards > 0.0) and np.isfinite(rows).all()):
            raise AssumptionError
        return rows


def forces_of(row: Row, values: FloatArray, shape: tuple[int, ...]) -> tuple[FloatArray, FloatArray]:
    """Return a contact's force (2, ...) and couple (...) among a kernel's values."""
    none = np.broadcast_to(np.zeros(()), shape)
    force = np.broadcast_to(np.zeros(()), (2, *shape)) if row.force < 0 else values[row.force : row.force + 2]
    return force, none if row.couple < 0 else values[row.couple]
