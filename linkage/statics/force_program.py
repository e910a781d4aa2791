"""The equilibrium as a program: all joint forces of many poses from one kernel, friction included.

The equations of equilibrium are written on the nodes of a program and eliminated once, as for a single pin force; what acts comes in as
inputs, so that every load case and direction asks the same kernel. Friction enters as one input a joint: its couple or its force along the
guide. The joint forces are linear in these. A kernel of a few outputs adds up how much the frictions make each other grow. Where that is a
contraction, a second kernel, of the forces that press the joints, runs until they stay. Elsewhere a third gives their derivatives, and the
frictions are found on arrays. A last one gives everything. Where a pose has no value by the program, or what it takes for granted does not
hold, the same equations are read on arrays, which tell in words why.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from ..errors import DefinitionError
from ..motion import Motion
from ..motion.evaluation import grid_blocks, part_of_input
from ..plan import Mask, Plan
from ..program import FloatArray, Kernel, Level, Node, Tangent
from .agreement import assumed_joints
from .applied import AppliedLoads
from .equilibrium import System
from .friction import CONTRACTS, JointFriction, PressingForces, PressingRows, consistent_frictions, iterated, joint_frictions, unit_friction
from .joints import Contact, Structure
from .poses import FlatPoses
from .solution import PoseForces, Solution, by_equations
from .traced_loads import TracedMotion, eliminated_forces

PIECE = 1 << 13
"""Poses whose frictions are found at a time."""


def forces_at(poses: FlatPoses, applied: AppliedLoads, split: str = "refuse") -> PoseForces:
    """Return all forces at some poses: by the program, or where that does not say them by the equations read on arrays."""
    found = by_program(poses, applied) if split == "refuse" else None
    return by_equations(poses, applied, split) if found is None else found


def by_program(poses: FlatPoses, applied: AppliedLoads) -> PoseForces | None:
    """Return the forces of a motion's poses by the program; None where it cannot say them."""
    motion = poses.motion
    if not isinstance(motion, Motion):
        return None
    structure = Structure(poses.plan, applied.elements, applied.thrusts)
    if any(line.changes_shares for line in structure.holders.lines) or any(each.run.back for each in structure.holders.reeved):
        return None
    frictions = joint_frictions(structure, poses, applied.frictions, applied.rates) if applied.frictions else []
    places = [structure.contacts.index(each.contact) for each in frictions]
    program = program_of(structure, applied, places)
    return None if program is None else run_at(motion, program, structure, poses, applied, frictions)


@final
@dataclass(frozen=True)
class OutputRows:
    """Where a contact's force and couple stand among a kernel's outputs; -1 for none."""

    force: int
    couple: int

    def of(self, values: FloatArray, shape: tuple[int, ...]) -> tuple[FloatArray, FloatArray]:
        """Return the contact's force (2, ...) and couple (...) among a kernel's values."""
        none = np.broadcast_to(np.zeros(()), (2, *shape))
        force = none if self.force < 0 else values[self.force : self.force + 2]
        return force, none[0] if self.couple < 0 else values[self.couple]


@final
@dataclass(frozen=True)
class FrictionKernels:
    """The kernels of the forces that press joints with friction: `growth` of the sums by all frictions, `forces`, `by_each` friction."""

    growth: Kernel
    forces: Kernel
    by_each: Kernel


@final
@dataclass(frozen=True)
class ForceProgram:
    """The kernels of all joint forces: of the frictions in the contacts at some `places`, and of everything."""

    places: tuple[int, ...]
    friction: FrictionKernels | None
    whole: Kernel
    rows: tuple[OutputRows, ...]
    drives: tuple[str, ...]
    struts: tuple[str, ...]
    runs: tuple[str, ...]


@final
class AssumptionError(Exception):
    """What the program takes for granted does not hold at some pose: the equations are solved on arrays instead."""


# Made once: traced, eliminated, as kernels.


def program_of(structure: Structure, applied: AppliedLoads, places: Sequence[int]) -> ForceProgram | None:
    """Return the program of the joint forces of a structure, made once; None where it cannot be traced or eliminated.

    What acts is its input: it is the same for all load cases, directions and rates in which the same points are loaded.
    """
    loads = tuple((each.load.point, *each.load.on) for each in applied.loads)
    struts = tuple((each.name, each.P, each.Q, each.known is None) for each in structure.struts)
    lines = tuple((line.stroke, line.cylinders, line.tie) for line in structure.holders.all)
    blocks = tuple(body.name for body in structure.blocks)
    key = ("joint forces", loads, struts, lines, blocks, tuple(places))
    try:
        return structure.plan.made(key, lambda twin: traced_program(twin, applied, tuple(places)))
    except DefinitionError:
        return None


def traced_program(plan: Plan, applied: AppliedLoads, places: tuple[int, ...]) -> ForceProgram:
    """Return the program traced on a plan of its own."""
    motion = TracedMotion(plan, plan.trace)
    loads = tuple(
        replace(each, force=motion._array([motion.node(motion.input(load_input(place, axis))) for axis in "xy"]))
        for place, each in enumerate(applied.loads)
    )
    thrusts = tuple(replace(each, thrust=motion.input(thrust_input(place))) for place, each in enumerate(applied.thrusts))
    acts = replace(applied, loads=loads, thrusts=thrusts)
    structure, poses = Structure(plan, acts.elements, acts.thrusts), FlatPoses(motion, "")
    inputs = [motion.node(motion.input(friction_input(place))) for place in range(len(places))]
    contacts = [structure.contacts[index] for index in places]
    units = tuple(unit_friction(contact, poses) for contact in contacts)
    system, u = eliminated_forces(structure, motion, acts, units, inputs)
    frictions = [JointFriction(unit, np.zeros(1), np.zeros(1), np.zeros(1)) for unit in units]
    solution = Solution(system, u, motion._array([inputs]), np.zeros(1, bool), frictions)
    nodes: list[Node] = []
    rows = []
    for contact in structure.contacts:
        force, couple = solution.transmitted(contact)
        first = len(nodes) if contact.has_force else -1
        nodes += [motion.node(part) for part in force[:, 0]] if contact.has_force else []
        turns = "c" in contact.holds or any(each.contact is contact for each in frictions)
        rows.append(OutputRows(first, len(nodes) if turns else -1))
        nodes += [motion.node(couple[0])] if turns else []
    nodes += [motion.node(solution.value(system.drive(name))[0]) for name in plan.strokes]
    nodes += [motion.node(solution.value(system.thrust(strut))[0]) for strut in structure.struts]
    nodes += [motion.node(solution.value(system.run(k))[0]) for k in range(len(structure.holders.runs))]
    guards = [*motion.notes.assumed, *(motion.node(each[0]) for each in assumed_joints(structure, poses))]
    kernels = friction_kernels(system, u, contacts, inputs, motion, guards) if places else None
    names = tuple(strut.name for strut in structure.struts)
    ropes = tuple(each.name for each in structure.holders.reeved)
    return ForceProgram(places, kernels, Kernel(nodes, guards), tuple(rows), tuple(plan.strokes), names, ropes)


def load_input(place: int, axis: str) -> str:
    """Return the name of a load's part along x or y as an input; no dimension can be called so."""
    return f"|load {place} {axis}"


def thrust_input(place: int) -> str:
    """Return the name of a known thrust as an input."""
    return f"|thrust {place}"


def friction_input(place: int) -> str:
    """Return the name of a friction's input; no dimension can be called so."""
    return f"|friction {place}"


def lever_input(place: int) -> str:
    """Return the name of the size of a friction's lever as an input."""
    return f"|lever {place}"


def friction_kernels(
    system: System, u: FloatArray, contacts: Sequence[Contact], inputs: Sequence[Node], motion: TracedMotion, guards: list[Node]
) -> FrictionKernels:
    """Return the kernels of the forces that press the joints with friction."""
    graph = motion._reading.graph
    tangents = [Tangent(graph, {each: 1.0}) for each in inputs]
    levers = [graph.input(lever_input(place), Level.POSE) for place in range(len(inputs))]
    forces: list[Node] = []
    by_each: list[Node] = []
    growth: list[Node] = []
    for contact in contacts:
        start = system.first[contact]
        own = [motion.node(u[0, start + k]) for k in range(contact.presses)]
        slopes = [[tangent.of(force) for tangent in tangents] for force in own]
        forces += own
        by_each += [each for row in slopes for each in row]
        pairs = list(zip(*slopes, strict=True))
        sizes = [np.abs(each[0]) if len(each) == 1 else np.sqrt(each[0] * each[0] + each[1] * each[1]) for each in pairs]
        growth.append(sum((size * lever for size, lever in zip(sizes[1:], levers[1:], strict=True)), sizes[0] * levers[0]))
    return FrictionKernels(Kernel(growth, guards), Kernel(forces, guards), Kernel([*forces, *by_each], guards))


# Run at a motion's poses.


def run_at(
    motion: Motion, program: ForceProgram, structure: Structure, poses: FlatPoses, applied: AppliedLoads, frictions: list[JointFriction]
) -> PoseForces | None:
    """Return the forces by the kernels; None where an assumption of a law fails or a pose that should has no value."""
    size, q, locked = motion._grid.size, np.zeros((0, poses.count)), np.zeros(poses.count, bool)
    loads = {load_input(place, axis): each.force[k] for place, each in enumerate(applied.loads) for k, axis in enumerate("xy")}
    thrusts = {thrust_input(place): each.thrust for place, each in enumerate(applied.thrusts)}
    inputs = motion._grid.flat | {name: np.broadcast_to(each, motion.shape).reshape(size) for name, each in (loads | thrusts).items()}
    if program.friction is not None:
        try:
            q, locked = frictions_at(motion, program, program.friction, structure, poses, frictions, inputs)
        except AssumptionError:
            return None
        couples = poses.full(np.where(locked, 0.0, q) * np.stack([each.lever for each in frictions])).reshape(len(frictions), *size)
        inputs |= {friction_input(place): np.nan_to_num(each) for place, each in enumerate(couples)}
    result = program.whole(inputs, size=size)
    values = result.values.reshape(len(result.values), *motion.shape)
    good = poses.good & ~poses.mask(locked)
    whole = bool(good.all())
    if not np.all(result.guards > 0.0) or not np.isfinite(values if whole else values[:, good]).all():
        return None
    if not whole:
        values = np.where(good, values, np.nan)
    last = [len(program.runs)]
    last += [last[0] + len(program.struts), last[0] + len(program.struts) + len(program.drives)]
    runs, struts, drives = (values[len(values) - each :] for each in last)
    return PoseForces(
        structure, poses, applied, frictions, q, locked,
        [rows.of(values, motion.shape) for rows in program.rows],
        dict(zip(program.drives, drives, strict=False)),
        dict(zip(program.struts, struts, strict=False)),
        dict(zip(program.runs, runs, strict=True)),
    )  # fmt: skip


def frictions_at(
    motion: Motion,
    program: ForceProgram,
    kernels: FrictionKernels,
    structure: Structure,
    poses: FlatPoses,
    frictions: Sequence[JointFriction],
    given: Mapping[str, FloatArray],
) -> tuple[FloatArray, Mask]:
    """Return the frictions (frictions, n) [N] and where they have no bounded solution (n,); AssumptionError where an assumption fails.

    Some thousand poses are looked at at a time: what presses the joints, with its derivatives, is much for each.
    """
    rows = PressingRows(tuple(structure.contacts[index].presses for index in program.places))
    lever, coefficient = np.stack([each.lever for each in frictions]), np.stack([each.coefficient for each in frictions])
    q, locked = np.zeros((len(frictions), poses.count)), np.zeros(poses.count, bool)
    places = poses.full(np.arange(poses.count, dtype=float)).reshape(motion._grid.size)
    for band, part in grid_blocks(*motion._grid.size, PIECE):
        inputs = {name: part_of_input(value, band, part, name in poses.plan.table.entries) for name, value in given.items()}
        good = np.isfinite(places[band, part])
        at = places[band, part][good].astype(int)
        if at.size:
            piece = FrictionPiece(inputs, good, rows, lever[:, at], coefficient[:, at])
            q[:, at], locked[at] = piece.frictions(kernels)
    return q, locked


@final
@dataclass(frozen=True)
class FrictionPiece:
    """Some poses whose frictions are sought: the inputs of the kernels, the poses that count (designs, poses), and what presses there."""

    inputs: dict[str, FloatArray]
    good: Mask
    rows: PressingRows
    lever: FloatArray
    coefficient: FloatArray

    def frictions(self, kernels: FrictionKernels) -> tuple[FloatArray, Mask]:
        """Return the frictions (frictions, n) and the locked poses (n,); AssumptionError where an assumption fails."""
        growth = self.values(kernels.growth, lever_input, np.abs(self.lever))
        if np.max(growth * self.coefficient, initial=0.0) < CONTRACTS:
            q = iterated(self.rows, self.coefficient, lambda q: self.values(kernels.forces, friction_input, q * self.lever))
            return q, np.zeros(q.shape[1], bool)
        values = self.values(kernels.by_each, friction_input, np.zeros(self.lever.shape))
        forces = sum(self.rows.parts)
        by_unit = values[forces:].reshape(forces, len(self.lever), -1)
        return consistent_frictions(PressingForces(self.rows, values[:forces], by_unit, self.lever), self.coefficient)

    def values(self, kernel: Kernel, name: Callable[[int], str], given: FloatArray) -> FloatArray:
        """Return a kernel's outputs (outputs, n) for values (frictions, n) of the inputs so named."""
        whole, shape = bool(self.good.all()), self.good.shape
        inputs = dict(self.inputs)
        for place, each in enumerate(given):
            full = each if whole else np.zeros(shape)
            if not whole:
                full[self.good] = each
            inputs[name(place)] = full.reshape(shape)
        result = kernel(inputs, size=(shape[0], shape[1]))
        rows = result.values.reshape(len(result.values), -1)
        rows = rows if whole else rows[:, self.good.ravel()]
        if not (np.all(result.guards > 0.0) and np.isfinite(rows).all()):
            raise AssumptionError
        return rows
