"""The pins of a group, found by Newton's method with the exact Jacobian of the program, many poses at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import reduce
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from ..errors import AssemblyError, SingularError
from ..plan import Plan, strokes_text
from ..program import ARRAYS, FloatArray, Kernel, Level, Node, ancestors, compiled, expanded, is_zero, jacobian, replaced, solve_arrays
from ..program.text import GUARDED, function_text
from ..steps import Group, Pin
from ..units import mm
from ..vectors import Mask, Numbers
from .rules import newton_ended

CONVERGED = 1e-10
ITERATIONS = 9
PIVOT, SURE_PIVOT = 1e-6, 1e-4
"""How small a pivot may be beside the entries it clears away, for a step that the next one corrects and for a clearance."""
FITS, DEAD = 1e-9, 1e-6
"""What residuals may leave of a group's size, and its least singular value, where its sketch is a dead point."""
THRESHOLD = 0.25
"""At the sketch a pivot is at least so large beside the entries it clears away."""


class Newton:
    """The equations of one group of a plan in its pins' coordinates; groups before it are inputs.

    Inputs are floats or arrays (n,), one value a pose, dimensions and strokes alike; unknowns have the shape (coordinates, n) [m].
    """

    def __init__(self, plan: Plan, group: Group) -> None:
        self.plan, self.group = plan, group
        self.names = group.inputs[:-1]

    @property
    def programs(self) -> Programs:
        """Newton's step and the clearance, written out for this group."""
        return self.plan.made(("newton", self.group.name), lambda plan: Programs.for_group(plan, self.group))

    def fixed_inputs(self, inputs: Mapping[str, Numbers]) -> dict[str, Numbers]:
        """Return the program inputs that do not depend on the group's own pins, floats or arrays like the inputs."""
        programs = self.programs
        with np.errstate(all="ignore"):
            known = programs.hold(*(inputs[name] for name in programs.inputs))
        return {f"@k{k}": value if np.ndim(value) else float(value) for k, value in enumerate(known)}

    def _run(self, kernel: Kernel, held: Mapping[str, Numbers], u: FloatArray) -> FloatArray:
        """Return the values of a kernel, shape (outputs, n)."""
        return kernel({**held, **dict(zip(self.names, u, strict=True))}, size=(1, u.shape[1])).values[:, 0]

    def raw(self, held: Mapping[str, Numbers], u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the residuals and the Jacobian by rows as the constraints state them, shape (c, n) and (c, c, n)."""
        count, n = u.shape
        values = self._run(self.programs.raw, held, u)
        return values[:count], values[count:].reshape(count, count, n)

    def system(self, inputs: Mapping[str, Numbers], u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the residuals [m], the Jacobian with rows of length one, and the rows' own lengths [m], at one pose."""
        kernel = self.plan.made(("equations", self.group.name), lambda plan: GroupEquations.for_group(plan, self.group)).kernel
        values = kernel({**inputs, **dict(zip(self.names, u, strict=True))}).values[:, 0]
        residual, rows = values[: len(u)], values[len(u) :].reshape(len(u), len(u), 1)
        size = np.sqrt((rows * rows).sum(axis=1))
        with np.errstate(all="ignore"):
            return residual / size, rows / size[:, None], size

    def start(self, inputs: Mapping[str, Numbers], sketch: FloatArray) -> tuple[FloatArray, bool, float]:
        """Return the solution nearest a rough sketch by damped steps, whether it was found, and the missing length [m]."""
        u = sketch
        with np.errstate(all="ignore"):
            residual, rows, size = self.system(inputs, u)
            for _ in range(100):
                change = solve_arrays(*rows.reshape(-1, 1), *residual)
                if not np.isfinite(change).all():
                    break
                factor = min(1.0, 0.5 * float(size.max()) / max(float(np.abs(change).max()), 1e-300))
                before = float(np.abs(residual * size).max())
                while factor > 1e-6:
                    residual, rows, size = self.system(inputs, u - factor * change)
                    small = factor * float(np.abs(change).max()) < CONVERGED * float(size.max())
                    if small or float(np.abs(residual * size).max()) <= before:
                        break
                    factor *= 0.5
                u = u - factor * change
                if float(np.abs(change).max()) <= CONVERGED * float(size.max()):
                    return u, True, 0.0
        return u, False, float(np.abs(residual).max())

    def is_dead(self, inputs: Mapping[str, Numbers], u: FloatArray) -> bool:
        """Return whether pins fulfil their equations at one pose and are not held there."""
        residual, rows, size = self.system(inputs, u)
        if not np.isfinite(rows).all() or np.abs(residual).max() > FITS * size.max():
            return False
        return bool(np.linalg.svd(rows[:, :, 0], compute_uv=False)[-1] <= DEAD)

    def correct(self, held: Mapping[str, Numbers], guess: FloatArray, size: FloatArray) -> tuple[FloatArray, Mask]:
        """Return the solution next to a guess and the mask of the poses where it was found; each stands when its own steps have ended.

        `size` is about that of the group at each pose [m].
        """
        n = guess.shape[1]
        found, done = np.empty(guess.shape), np.zeros(n, bool)
        left, u, last = np.arange(n), guess, np.full(n, np.inf)
        with np.errstate(all="ignore"):
            for k in range(ITERATIONS):
                u, change = self._step(held, u)
                ended, near = newton_ended(change, last, size)
                stands = (ended > 0.0) | (k == ITERATIONS - 1)
                if stands.all() and len(left) == n:
                    return u, np.asarray(near > 0.0)
                found[:, left[stands]], done[left[stands]] = u[:, stands], near[stands] > 0.0
                on = np.flatnonzero(~stands)
                if not on.size:
                    break
                left, u, last, size, held = left[on], np.take(u, on, axis=1), change[on], size[on], at_poses(held, on)
        return found, done

    def _step(self, held: Mapping[str, Numbers], u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the pins after one step and how far they went [m]; a pose whose pivots are small with pivots of its own."""
        values = self._run(self.programs.step, held, u)
        on, change, pivot = values[:-2], values[-2], values[-1]
        weak = np.flatnonzero(~(pivot > 0.0))
        weak = weak[np.isfinite(u[:, weak]).all(axis=0)] if weak.size else weak
        if weak.size:
            residual, rows = self.raw(at_poses(held, weak), u[:, weak])
            step = solve_arrays(*rows.reshape(-1, len(weak)), *residual)
            on[:, weak], change[weak] = u[:, weak] - step, np.abs(step).max(axis=0)
        return on, change

    def sense(self, held: Mapping[str, Numbers], u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return how near each pose is to a singular one, and the group's size [m].

        The sign is that of the determinant, which changes where branches cross. The nearness is 2 over the condition of the Jacobian
        with rows of length one, at most 1. The condition is bounded by the Frobenius norms of the Jacobian and its inverse.
        """
        sense, size, pivot = self._run(self.programs.clearance, held, u)
        weak = np.flatnonzero(~(pivot > 0.0))
        if weak.size:
            sense[weak] = nearness(self.raw(at_poses(held, weak), u[:, weak])[1])
        return sense, size

    def sine(self, inputs: Mapping[str, Numbers], u: FloatArray) -> FloatArray:
        """Return how near poses are to a singular one, without a sign: designs (m,), strokes (n,) or (m, n), pins (coordinates, m, n)."""
        sense, pivot = self.programs.sine({**inputs, **dict(zip(self.names, u, strict=True))}, size=u.shape[1:]).values
        weak = ~(pivot > 0.0)
        if weak.any():
            arrays = {name: value for name, value in inputs.items() if np.ndim(value)}
            arrays |= {name: np.reshape(value, (-1, 1)) for name, value in arrays.items() if name in self.plan.defaults}
            poses = {name: np.broadcast_to(value, weak.shape)[weak] for name, value in arrays.items()}
            sense[weak] = nearness(self.raw(self.fixed_inputs({**inputs, **poses}), u[:, weak])[1])
        return np.where(np.isfinite(u).all(axis=0), np.where(np.isnan(sense), 0.0, np.abs(sense)), np.nan)


def at_poses(inputs: Mapping[str, Numbers], which: slice | npt.NDArray[np.intp]) -> dict[str, Numbers]:
    """Return the inputs of some poses."""
    return {name: value[which] if isinstance(value, np.ndarray) and value.ndim else value for name, value in inputs.items()}


def nearness(rows: FloatArray) -> FloatArray:
    """Return the clearance with its sign from Jacobians (c, c, n), each with its own pivots; 0 where singular, NaN without a value."""
    with np.errstate(all="ignore"):
        scaled = np.moveaxis(rows / np.sqrt((rows * rows).sum(axis=1))[:, None], (0, 1), (-2, -1))
        finite = np.isfinite(scaled).all(axis=(1, 2))
        safe = np.where(finite[:, None, None], scaled, np.eye(len(rows)))
        sign = np.linalg.slogdet(safe)[0]
        safe = np.where((sign != 0.0)[:, None, None], safe, np.eye(len(rows)))
        size = np.sqrt((np.linalg.inv(safe) ** 2).sum(axis=(1, 2)))
        return np.where(finite, sign * np.minimum(1.0, 2.0 * np.sqrt(len(rows)) / size), np.nan)


# The equations of a group as programs: as the constraints state them, and solved by elimination written out for its own structure.


class GroupEquations(NamedTuple):
    """The residuals of a group, the roots they determine, and the Jacobian by rows; groups before it are held."""

    residuals: tuple[Node, ...]
    roots: tuple[Node, ...]
    rows: tuple[tuple[Node, ...], ...]
    kernel: Kernel

    @classmethod
    def for_group(cls, plan: Plan, group: Group) -> GroupEquations:
        """Return the equations of a group of a plan."""
        roots = tuple(part for place in map(plan.trace.at, group.pins) for part in (place.x, place.y))
        (closure,) = dict.fromkeys(root.closure for root in roots)
        assert closure is not None
        rows = tuple(map(tuple, jacobian(plan.trace.graph, closure)))
        return cls(closure.residuals, roots, rows, Kernel([*closure.residuals, *(entry for row in rows for entry in row)]))

    def at_sketch(self, plan: Plan) -> FloatArray:
        """Return the Jacobian at the sketch, default dimensions, shape (c, c)."""
        pins = at_sketch(plan)
        inputs: dict[str, Numbers] = {**plan.defaults, **plan.sketch_strokes}
        for group in plan.groups.values():
            inputs |= dict(zip(group.inputs, pins[group.name][:, 0], strict=False))
        count = len(self.rows)
        rows: FloatArray = self.kernel(inputs).values[count:, 0, 0].reshape(count, count)
        return rows


class Programs(NamedTuple):
    """Newton's step and the clearance of a group, from its pins and the known values before: inputs `@k0`, `@k1`, ...

    The last value of each is above zero where no pivot is too small.
    """

    inputs: tuple[str, ...]
    known: tuple[Node, ...]
    hold: Callable[..., tuple[Numbers, ...]]
    """What is known, from the inputs."""
    nodes: tuple[Node, ...]
    """The pins after a step, its largest change [m] and the pivots' worth; the clearance and the size [m]."""
    raw: Kernel
    step: Kernel
    clearance: Kernel
    sine: Kernel

    @classmethod
    def for_group(cls, plan: Plan, group: Group) -> Programs:
        """Return the programs of a group; the order of its elimination is settled at the sketch."""
        equations = GroupEquations.for_group(plan, group)
        elimination = Elimination(equations.rows, equations.at_sketch(plan))
        step = elimination.solve(equations.residuals)
        on = [root - each for root, each in zip(equations.roots, step, strict=True)]
        steps = [*on, largest_of([size_of(each) for each in step]), elimination.worth(PIVOT)]
        clearance = elimination.clearance()
        constraints = [*equations.residuals, *(entry for row in equations.rows for entry in row)]
        lengths = [squares(row) for row in equations.rows[: len(group.rods)]]
        for axis in (0, 1):
            places = equations.roots[axis::2]
            apart = largest_of(places) + largest_of([-each for each in places])
            lengths.append(apart * apart)
        size = largest_of(lengths) ** 0.5  # [m]: its longest rod, or how far its pins lie apart
        nodes = expanded([*steps, clearance, size, *constraints])
        hangs = {root.origin for root in equations.roots}
        found: dict[Node, None] = {}
        for node in ancestors(nodes):
            args = [each.origin for each in node.args]
            if any(arg in hangs for arg in args):
                hangs.add(node)
                found |= dict.fromkeys(arg for arg in args if arg not in hangs and arg.op != "constant")
        found |= dict.fromkeys(each.origin for each in nodes if each.origin not in hangs and each.origin.op != "constant")
        known = list(found)
        graph = plan.trace.graph
        nodes = replaced(nodes, {node: graph.input(f"@k{k}", Level.POSE) for k, node in enumerate(known)})
        rules, raw = nodes[: len(steps) + 2], nodes[len(steps) + 2 :]
        order = ancestors(known)
        given = [node for node in order if node.op == "input"]
        text = function_text("hold", given, [node for node in order if node.op not in ("input", "constant")], known, GUARDED)
        return cls(
            inputs=tuple(node.value for node in given),
            known=tuple(known),
            hold=compiled(text, ARRAYS)["hold"],
            nodes=tuple(rules),
            raw=Kernel(raw),
            step=Kernel(rules[: len(steps)]),
            clearance=Kernel([*rules[len(steps) :], rules[len(steps) - 1]]),
            sine=Kernel([clearance, elimination.worth(SURE_PIVOT)]),
        )


def largest_of(nodes: Sequence[Node]) -> Node:
    """Return the largest of some nodes."""
    return reduce(lambda a, b: a.graph.apply("maximum", a, b), nodes)


def size_of(node: Node) -> Node:
    """Return a node without its sign."""
    return node.graph.apply("absolute", node)


def squares(nodes: Sequence[Node]) -> Node:
    """Return the sum of the squares of nodes that are not zero by structure."""
    first, *others = (node * node for node in nodes if not is_zero(node))
    return sum(others, first)


class Elimination:
    """The elimination of a group's Jacobian as operations on nodes, its pivots chosen at the sketch: few operations, none too small."""

    def __init__(self, rows: Sequence[Sequence[Node]], values: FloatArray) -> None:
        self.matrix = rows
        self.rows = [list(row) for row in rows]
        sizes = np.sqrt((values * values).sum(axis=1))
        self.order = pivots(values / sizes[:, None], np.array([[not is_zero(entry) for entry in row] for row in rows]))
        self.factors: list[tuple[int, int, Node]] = []
        self.inverse: dict[int, Node] = {}
        self.beside: list[tuple[Node, Node]] = []
        left, columns = [row for row, _ in self.order], [column for _, column in self.order]
        for row, column in self.order:  # the pivot's row is taken from the others in its column
            left.remove(row)
            columns.remove(column)
            pivot, others = self.rows[row][column], [other for other in left if not is_zero(self.rows[other][column])]
            self.inverse[row] = 1.0 / pivot
            if others:
                entries = [size_of(self.rows[other][column]) * float(sizes[row] / sizes[other]) for other in others]
                self.beside.append((size_of(pivot), largest_of(entries)))
            for other in others:
                factor = self.rows[other][column] * self.inverse[row]
                self.factors.append((other, row, factor))
                for each in columns:
                    if not is_zero(self.rows[row][each]):
                        self.rows[other][each] = self.rows[other][each] - factor * self.rows[row][each]

    def worth(self, least: float) -> Node:
        """Return a number above zero where every pivot is larger than `least` of the entries it clears away."""
        excess = [least * entry - pivot for pivot, entry in self.beside]
        return -largest_of(excess or [self.rows[0][0].graph.constant(-1.0)])

    def solve(self, right: Sequence[Node]) -> list[Node]:
        """Return the unknowns for a right side."""
        values = list(right)
        for row, pivot, factor in self.factors:
            if not is_zero(values[pivot]):
                values[row] = values[row] - factor * values[pivot]
        found: dict[int, Node] = {}
        for row, column in reversed(self.order):
            rest = values[row]
            for each, value in found.items():
                if not is_zero(self.rows[row][each]) and not is_zero(value):
                    rest = rest - self.rows[row][each] * value
            found[column] = rest * self.inverse[row]
        return [found[column] for column in range(len(found))]

    def clearance(self) -> Node:
        """Return 2 over the condition of the Jacobian with rows of length one, bounded by Frobenius norms, with the determinant's sign."""
        graph, count = self.rows[0][0].graph, len(self.rows)
        total = graph.constant(0.0)
        for place, row in enumerate(self.matrix):
            column = self.solve([graph.constant(float(place == each)) for each in range(count)])
            total = total + squares(column) * squares(row)
        near = graph.apply("minimum", 1.0, 2.0 * count**0.5 / total**0.5)
        columns = [column for _, column in sorted(self.order)]
        crossings = sum(a > b for k, a in enumerate(columns) for b in columns[k + 1 :])  # the sign of a permutation
        determinant = graph.constant(-1.0 if crossings % 2 else 1.0)
        for pivot_row, pivot_column in self.order:
            determinant = determinant * self.rows[pivot_row][pivot_column]
        return graph.pick(determinant, 0.0, -near, near)


def pivots(values: FloatArray, filled: Mask) -> list[tuple[int, int]]:
    """Return rows and columns in the order of an elimination that fills few entries, with pivots that are large for these values.

    Source: H. M. Markowitz, Management Science 3 (1957), 255, with thresholds.
    """
    values, filled = np.array(values), np.array(filled)
    order: list[tuple[int, int]] = []
    rows, columns = list(range(len(values))), list(range(len(values)))
    while rows:
        sizes = np.abs(values[np.ix_(rows, columns)])
        share = np.where(filled[np.ix_(rows, columns)], sizes / np.maximum(sizes.max(axis=0), 1e-300), 0.0)
        entries = filled[np.ix_(rows, columns)]
        cost = (entries.sum(axis=1)[:, None] - 1) * (entries.sum(axis=0)[None, :] - 1)
        cost = np.where(share >= THRESHOLD, cost - 0.5 * share, np.inf)
        k, j = np.unravel_index(int(np.argmin(cost)), cost.shape)
        row, column = rows.pop(int(k)), columns.pop(int(j))
        order.append((row, column))
        for other in rows:
            if filled[other, column]:
                values[other] -= values[other, column] / values[row, column] * values[row]
                filled[other] |= filled[row]
    return order


def at_sketch(plan: Plan) -> dict[str, FloatArray]:
    """Return the pins of every group at the sketch, default dimensions, shape (coordinates, 1); AssemblyError where it is out of reach."""
    found = plan.made("sketch", started)
    if isinstance(found, AssemblyError):
        raise found.with_traceback(None)
    return found


def lost_at_sketch(plan: Plan) -> AssemblyError | None:
    """Return why the groups of a plan cannot be assembled at the sketch; None where they can."""
    found = plan.made("sketch", started) if plan.groups else None
    return found if isinstance(found, AssemblyError) else None


def started(plan: Plan) -> dict[str, FloatArray] | AssemblyError:
    """Return the pins of every group at the sketch from their rough places, or why they cannot be assembled there."""
    inputs: dict[str, Numbers] = {**plan.defaults, **plan.sketch_strokes}
    found: dict[str, FloatArray] = {}
    for name, group in plan.groups.items():
        pins = [plan.of_kind(Pin)[pin] for pin in group.pins]
        newton = Newton(plan, group)
        rough = np.array([part for pin in pins for part in pin.sketched]).reshape(-1, 1)
        found[name], done, missing = newton.start(inputs, rough)
        names, strokes = " ".join(pin.name for pin in pins), strokes_text(plan, plan.sketch_strokes)
        if newton.is_dead(inputs, rough) or not (done or not newton.is_dead(inputs, found[name])):
            return SingularError(
                f"{plan.title}: the pins {names} stand in a dead point at {strokes}: what is drawn fits together, but it is "
                "singular, so that how the pins go on from there is not settled. Draw them at other strokes, drawn(...), and out of line.",
                point=pins[0].name, mask=np.ones((), bool),
            )  # fmt: skip
        if not done:
            gap = f"{missing / mm:.3g} mm are missing" if np.isfinite(missing) else "their equations have no value"
            return AssemblyError(
                f"{plan.title}: the pins {names} cannot be assembled from their sketch at {strokes}: {gap} in "
                "the nearest pose. Move their near=(x, y) closer to the real pose, or change a length.",
                point=pins[0].name, mask=np.ones((), bool), shortfall=missing,
            )  # fmt: skip
        inputs |= dict(zip(newton.names, found[name], strict=True))
    return found
