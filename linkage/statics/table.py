"""The largest force of every joint over poses, load cases and directions of motion: what goes into an FEM model."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from math import pi

import numpy as np

from ..errors import DefinitionError
from ..units import deg, kN
from .joint_force import JointForce
from .result import PinForces


@dataclass(frozen=True)
class PinLoad:
    """The largest force of one joint: its size [N], its direction in the body's own axes [rad], and where it occurs.

    The body's x axis goes from the first of its `axis` points to the second; for the frame it is the frame's own.
    """

    point: str
    on: str
    by: str
    kind: str
    force: float
    angle: float
    axis: str
    strokes: Mapping[str, float]
    design: tuple[int, ...]
    case: str
    direction: str

    @property
    def cells(self) -> tuple[str, ...]:
        """The row as text."""
        at = ", ".join(f"{name} = {value:.4f}" for name, value in self.strokes.items())
        force, angle = f"{self.force / kN:.3f}", f"{self.angle / deg:.1f}"
        return self.point, self.kind, self.on, self.by, force, angle, self.axis, at, self.case, self.direction


HEADINGS = ("pin", "kind", "on", "from", "force, kN", "angle, deg", "from axis", "at", "load case", "motion")


def max_table(results: PinForces | Iterable[PinForces]) -> tuple[PinLoad, ...]:
    """Return, for every joint, its largest force among the results of `pin_forces`, in the order of the joints."""
    each_of = [results] if isinstance(results, PinForces) else list(results)
    best: dict[tuple[str, str, str, str], PinLoad] = {}
    for one in each_of:
        for joint in (each for each in one.joints if each.has_force):
            row = largest(one, joint)
            key = (joint.point, joint.on, joint.by, joint.kind)
            if row is not None and (key not in best or row.force > best[key].force):
                best[key] = row
    if not best:
        raise DefinitionError("There are no joint forces to tabulate: no pose is reached.")
    return tuple(best.values())


def largest(result: PinForces, joint: JointForce) -> PinLoad | None:
    """Return a joint's largest force over the poses of a result; None where it has none."""
    size = joint.size
    if not np.isfinite(size).any():
        return None
    place = np.unravel_index(int(np.nanargmax(size)), size.shape)
    designs = len(result.motion.design_shape)
    x, y = (float(joint.force[k][place]) for k in (0, 1))
    own = body_angle(result, joint, place)
    return PinLoad(
        joint.point, joint.on, joint.by, joint.kind, float(size[place]), turned(float(np.arctan2(y, x)) - own),
        "".join(joint.axis or ("x",)), {name: float(value[place[designs:]]) for name, value in result.motion.strokes.items()},
        tuple(int(each) for each in place[:designs]), result.case, result.direction,
    )  # fmt: skip


def turned(angle: float) -> float:
    """Return an angle [rad] between -pi and pi; half a turn to within rounding is pi."""
    within = (angle + pi) % (2.0 * pi) - pi
    return within + 2.0 * pi if within < -pi + 1e-9 else within


def body_angle(result: PinForces, joint: JointForce, place: tuple[np.intp, ...]) -> float:
    """Return the direction of a body's own x axis at a pose [rad]."""
    if joint.axis is None:
        return 0.0
    (px, py), (qx, qy) = (result.motion[point] for point in joint.axis)
    return float(np.arctan2((qy - py)[place], (qx - px)[place]))


def table_text(rows: Iterable[PinLoad]) -> str:
    """Return the table as aligned text."""
    cells = [HEADINGS, *(row.cells for row in rows)]
    sizes = [max(map(len, column)) for column in zip(*cells, strict=True)]
    return "\n".join("  ".join(cell.ljust(size) for cell, size in zip(row, sizes, strict=True)).rstrip() for row in cells)
