"""The rigid bodies of a mechanism and the joints between them, from what its steps declare."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import final

from ..quantities import body_name

FRAME = "frame"


@final
@dataclass(frozen=True)
class Body:
    """Points that move as one. The frame holds all fixed points."""

    points: tuple[str, ...]
    fixed: bool = False

    @property
    def name(self) -> str:
        """The points' names joined, or `frame`."""
        return FRAME if self.fixed else body_name(self.points)

    def __contains__(self, point: object) -> bool:
        return point in self.points

    def __str__(self) -> str:
        return f"frame {' '.join(self.points)}" if self.fixed else " ".join(self.points)


def merged(groups: Iterable[Sequence[str]], ground: Sequence[str]) -> tuple[Body, ...]:
    """Return the bodies: groups that share two points are one. The frame comes first."""
    bodies: list[list[str]] = [list(ground)]
    for group in groups:
        body = list(dict.fromkeys(group))
        while (other := next((each for each in bodies if len(set(each) & set(body)) > 1), None)) is not None:
            bodies.remove(other)
            body = list(dict.fromkeys([*other, *body]))
        bodies.append(body)
    frame = max(bodies, key=lambda body: len(set(body) & set(ground)) if ground else 0) if ground else []
    others = [body for body in bodies if body is not frame and body]
    return (Body(tuple(frame), fixed=True), *(Body(tuple(body)) for body in others))
