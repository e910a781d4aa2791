"""Which operations a kernel does and in which order: only the ancestors of what is asked for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from .lower import ancestors, lowered, plain
from .node import Level, Node
from .order import shortest


@dataclass(frozen=True)
class Schedule:
    """The nodes of a kernel in order: computed once per design, then once per pose."""

    outputs: tuple[Node, ...]
    guards: tuple[Node, ...]
    design: tuple[Node, ...]
    pose: tuple[Node, ...]
    inputs: tuple[Node, ...]
    passed: tuple[Node, ...]
    """Design nodes the pose part reads, or that are outputs."""

    @cached_property
    def design_inputs(self) -> tuple[Node, ...]:
        """The dimensions."""
        return tuple(node for node in self.inputs if node.level is Level.DESIGN)

    @cached_property
    def pose_inputs(self) -> tuple[Node, ...]:
        """The strokes and the coordinates of groups."""
        return tuple(node for node in self.inputs if node.level is Level.POSE)


def schedule(outputs: Sequence[Node], guards: Sequence[Node] = ()) -> Schedule:
    """Return the order of evaluation for some outputs, and guards whose least value is wanted."""
    wanted = lowered((*outputs, *guards))
    out, watched = tuple(wanted[: len(outputs)]), tuple(wanted[len(outputs) :])
    nodes = ancestors(wanted)
    pose = [node for node in nodes if node.level is Level.POSE and node.op not in ("input", "constant")]
    read = {arg for node in pose for arg in map(plain, node.args)} | set(wanted)
    return Schedule(
        outputs=out,
        guards=watched,
        design=tuple(node for node in nodes if node.level is Level.DESIGN and node.op != "input"),
        pose=shortest(pose, set(out)),
        inputs=tuple(node for node in nodes if node.op == "input"),
        passed=tuple(node for node in nodes if node.level is Level.DESIGN and node in read),
    )
