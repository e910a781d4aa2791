"""The equilibrium as a program: all joint forces of many poses from one kernel, friction included.

The equations of equilibrium are written on the nodes of a program and eliminated once, as for a single pin force. What acts comes in as
inputs, so that every load case and direction asks the same kernel. Friction enters as one input a joint: its couple or its force along the
guide. The joint forces are linear in these. A kernel of a few outputs adds up how much the frictions make each other grow. Where that is a
contraction, a second kernel, of the forces that press the joints, runs until they stay. Elsewhere a third gives their derivatives, and the
frictions are found on arrays. A last one gives everything. Where a pose has no value by the program, or what it takes for granted does not
hold, the same equations are read on arrays, which tell in words why.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from ..errors import DefinitionError, UntracedError
from ..frozen import record
from ..motion import Motion
from ..motion.evaluation import grid_blocks, part_of_input
from ..plan import Mask, Plan
from ..program import FloatArray, Kernel, Level, Node, Tangent
from .applied import AppliedLoads
from .equilibrium import System
from .friction import CONTRACTS, JointFriction, PressingForces, by_iteration, consistent_frictions, joint_frictions
from .joints import Contact, Structure
from .law_requests import TracedMotion, eliminated_forces
from .poses import FlatPoses
from .solution import PoseForces, Solution, assumed_joints, by_equations, structure_of

PIECE = 1 << 13
"""Poses whose frictions are found at a time."""


def forces_at(poses: FlatPoses, applied: AppliedLoads, split: str = "refuse") -> PoseForces:
    """Return all forces at some poses: by the program, or where that does not say them by the equations read on arrays."""
    found, motion = None, poses.motion
    if split == "refuse" and isinstance(motion, Motion):
        structure = structure_of(poses.plan, applied.elements, applied.thrusts)
        holders = structure.holders
        if not holders.changes_shares and not any(run.back for run in holders.reeved.values()):
            frictions = joint_frictions(structure, poses, applied.frictions, applied.rates) if applied.frictions else []
            program = program_of(structure, applied, [structure.contacts.index(each.contact) for each in frictions])
            found = None if program is None else run_at(motion, program, structure, poses, applied, frictions)
    return by_equations(poses, applied, split) if found is None else found


@record
class ForceProgram:
    """The kernels of all joint forces: of the frictions in contacts, and of everything.

    `friction` are those of the forces that press joints with friction: the growth of their sums by all frictions, the forces, the forces
    with their derivatives by each friction. `rows` tell where a contact's force and couple stand among the outputs of the whole, -1 for
    none. Behind them come the drives' forces, the members' thrusts and the ropes' forces.
    """

    friction: tuple[Kernel, Kernel, Kernel] | None
    kernel: Kernel
    rows: tuple[tuple[int, int], ...]


# Made once: traced, eliminated, as kernels.


def program_of(structure: Structure, applied: AppliedLoads, places: Sequence[int]) -> ForceProgram | None:
    """Return the program of the joint forces of a structure, made once; None where it cannot be traced or eliminated.

    What acts is its input: it is the same for all load cases, directions and rates in which the same points are loaded.
    """
    loads = tuple((each.point, *each.on) for each in applied.loads)
    struts = tuple((each.name, each.P, each.Q, each.known is None) for each in structure.struts)
    lines = tuple((line.stroke, line.cylinders, line.tie) for line in structure.holders.every_line)
    key = ("joint forces", loads, struts, lines, tuple(body.name for body in structure.blocks), tuple(places))
    try:
        return structure.plan.made(key, lambda twin: traced_program(twin, applied, tuple(places)))
    except DefinitionError:
        return None


def traced_program(plan: Plan, applied: AppliedLoads, places: tuple[int, ...]) -> ForceProgram:
    """Return the program traced on a plan of its own."""
    motion = TracedMotion(plan, plan.trace)

    def given(*name: object) -> Node:
        return motion._reading.graph.input(input_name(*name), Level.POSE)

    parts = [motion._array([given("load", place, axis) for axis in "xy"]) for place in range(len(applied.loads))]
    loads = tuple(replace(each, force=force) for each, force in zip(applied.loads, parts, strict=True))
    thrusts = tuple(replace(each, thrust=motion.number(given("thrust", place))) for place, each in enumerate(applied.thrusts))
    acts = replace(applied, loads=loads, thrusts=thrusts)
    structure, poses = structure_of(plan, acts.elements, acts.thrusts), FlatPoses(motion, "")
    inputs = [given("friction", place) for place in range(len(places))]
    contacts = [structure.contacts[index] for index in places]
    frictions = [JointFriction.of_unit(contact, poses) for contact in contacts]
    system, u = eliminated_forces(structure, motion, acts, frictions, inputs)
    solution = Solution(system, u, motion._array([inputs]), np.zeros(1, bool))
    nodes: list[Node] = []
    rows = []
    for contact in structure.contacts:
        force, couple = solution.transmitted(contact)
        first = len(nodes) if contact.has_force else -1
        nodes += [motion.node(part) for part in force[:, 0]] if contact.has_force else []
        turns = "c" in contact.holds or any(each.contact is contact for each in frictions)
        rows.append((first, len(nodes) if turns else -1))
        nodes += [motion.node(couple[0])] if turns else []
    nodes += [motion.node(solution.value(system.drive(name))[0]) for name in plan.strokes]
    nodes += [motion.node(solution.value(system.thrust(strut))[0]) for strut in structure.struts]
    nodes += [motion.node(solution.value(system.run(k))[0]) for k in range(len(structure.holders.reeved))]
    guards = [*motion.notes.assumed, *(motion.node(each[0]) for each in assumed_joints(structure, poses))]
    kernels = friction_kernels(system, u, contacts, inputs, motion, guards) if places else None
    return ForceProgram(kernels, Kernel(nodes, guards), tuple(rows))


def input_name(*parts: object) -> str:
    """Return the name of an input, such as the part of a load along x; no dimension can be called so."""
    return f"|{' '.join(map(str, parts))}"


def friction_kernels(
    system: System, u: FloatArray, contacts: Sequence[Contact], inputs: Sequence[Node], motion: TracedMotion, guards: list[Node]
) -> tuple[Kernel, Kernel, Kernel]:
    """Return the kernels of the forces that press the joints with friction, as `ForceProgram` has them."""
    graph = motion._reading.graph
    tangents = [Tangent(graph, {each: 1.0}) for each in inputs]
    levers = [graph.input(input_name("lever", place), Level.POSE) for place in range(len(inputs))]
    forces: list[Node] = []
    by_each: list[Node] = []
    growth: list[Node] = []
    for contact in contacts:
        start = system.first[contact]
        own = [motion.node(u[0, start + k]) for k in range(contact.presses)]
        slopes = [[tangent.derivative(force) for tangent in tangents] for force in own]
        forces += own
        by_each += [each for row in slopes for each in row]
        pairs = list(zip(*slopes, strict=True))
        sizes = [np.abs(each[0]) if len(each) == 1 else np.sqrt(each[0] * each[0] + each[1] * each[1]) for each in pairs]
        growth.append(sum((size * lever for size, lever in zip(sizes[1:], levers[1:], strict=True)), sizes[0] * levers[0]))
    return Kernel(growth, guards), Kernel(forces, guards), Kernel([*forces, *by_each], guards)


# Run at a motion's poses.


def run_at(
    motion: Motion, program: ForceProgram, structure: Structure, poses: FlatPoses, applied: AppliedLoads, frictions: list[JointFriction]
) -> PoseForces | None:
    """Return the forces by the kernels; None where an assumption of a law fails or a pose that should has no value."""
    size, q, locked = motion._grid.size, np.zeros((0, poses.count)), np.zeros(poses.count, bool)
    acts = {input_name("load", place, axis): each.force[k] for place, each in enumerate(applied.loads) for k, axis in enumerate("xy")}
    acts |= {input_name("thrust", place): each.thrust for place, each in enumerate(applied.thrusts)}
    inputs = motion._grid.flat | {name: np.broadcast_to(each, motion.shape).reshape(size) for name, each in acts.items()}
    if program.friction is not None:
        try:
            q, locked = frictions_at(motion, program, poses, frictions, inputs)
        except UntracedError:
            return None
        couples = poses.full(np.where(locked, 0.0, q) * np.stack([each.lever for each in frictions])).reshape(len(frictions), *size)
        inputs |= {input_name("friction", place): np.nan_to_num(each) for place, each in enumerate(couples)}
    result = program.kernel(inputs, size=size)
    values = result.values.reshape(len(result.values), *motion.shape)
    good = poses.good & ~poses.mask(locked)
    whole = bool(good.all())
    if not result.is_clear or not np.isfinite(values if whole else values[:, good]).all():
        return None
    if not whole:
        values = np.where(good, values, np.nan)
    names = [list(structure.plan.strokes), [each.name for each in structure.struts], list(structure.holders.reeved)]
    behind = iter(values[len(values) - sum(map(len, names)) :])
    drives, thrusts, runs = (dict(zip(some, behind, strict=False)) for some in names)
    none = np.broadcast_to(np.zeros(()), (2, *motion.shape))
    contacts = [(none if at < 0 else values[at : at + 2], none[0] if turn < 0 else values[turn]) for at, turn in program.rows]
    return PoseForces(structure, poses, applied, frictions, q, locked, contacts, drives, thrusts, runs)


def frictions_at(
    motion: Motion, program: ForceProgram, poses: FlatPoses, frictions: Sequence[JointFriction], given: Mapping[str, FloatArray]
) -> tuple[FloatArray, Mask]:
    """Return the frictions (frictions, n) [N] and where they have no bounded solution (n,); UntracedError where an assumption fails.

    Some thousand poses are looked at at a time: what presses the joints, with its derivatives, is much for each.
    """
    parts = tuple(each.contact.presses for each in frictions)
    lever, coefficient = np.stack([each.lever for each in frictions]), np.stack([each.coefficient for each in frictions])
    q, locked = np.zeros((len(frictions), poses.count)), np.zeros(poses.count, bool)
    places = poses.full(np.arange(poses.count, dtype=float)).reshape(motion._grid.size)
    for band, part in grid_blocks(*motion._grid.size, PIECE):
        inputs = {name: part_of_input(value, band, part, name in poses.plan.table.entries) for name, value in given.items()}
        good = np.isfinite(places[band, part])
        at = places[band, part][good].astype(int)
        if at.size and program.friction is not None:
            q[:, at], locked[at] = frictions_of_piece(program.friction, parts, inputs, good, lever[:, at], coefficient[:, at])
    return q, locked


def frictions_of_piece(
    kernels: tuple[Kernel, Kernel, Kernel], parts: tuple[int, ...], inputs: Mapping[str, FloatArray], good: Mask, lever: FloatArray,
    coefficient: FloatArray,
) -> tuple[FloatArray, Mask]:  # fmt: skip
    """Return the same of some poses, of which those count that are `good` (designs, poses)."""
    whole, shape = bool(good.all()), good.shape

    def values(kernel: Kernel, kind: str, given: FloatArray) -> FloatArray:
        """Return a kernel's outputs (outputs, n) for values (frictions, n) of the inputs of a kind."""
        filled = dict(inputs)
        for place, each in enumerate(given):
            full = each if whole else np.zeros(shape)
            if not whole:
                full[good] = each
            filled[input_name(kind, place)] = full.reshape(shape)
        result = kernel(filled, size=(shape[0], shape[1]))
        rows = result.values.reshape(len(result.values), -1)
        rows = rows if whole else rows[:, good.ravel()]
        if not (result.is_clear and np.isfinite(rows).all()):
            raise UntracedError("What the program takes for granted does not hold at some pose: the equations are solved on arrays.")
        return rows

    growth, forces, by_each = kernels
    if np.max(values(growth, "lever", np.abs(lever)) * coefficient, initial=0.0) < CONTRACTS:
        q = by_iteration(parts, coefficient, lambda q: values(forces, "friction", q * lever))
        return q, np.zeros(q.shape[1], bool)
    found, count = values(by_each, "friction", np.zeros(lever.shape)), sum(parts)
    by_unit = found[count:].reshape(count, len(lever), -1)
    return consistent_frictions(PressingForces(parts, found[:count], by_unit, lever), coefficient)
