"""The parts list of a chain of links with turning pairs, one of which is a crank."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import atan2, hypot
from typing import Any

from ..quantities import Member, Stroke
from ..steps import Crank, Ground, Link, OnLink, Pin

Place = tuple[float, float]


def chain_parts(
    stroke: tuple[str, Stroke],
    fixed: Mapping[str, Place],
    crank: Mapping[str, Place],
    links: Mapping[str, Sequence[str]],
    free: Mapping[str, Place],
    point: tuple[str, tuple[str, str], float, float],
) -> dict[str, Member]:
    """Return the members of a chain: a `crank` about the first `fixed` joint, `links` by their joints, and a `point` on one of them.

    Places [m] are those of a drawing at the stroke's start, where the crank lies along the x axis. Of the point its name, the two joints
    that it is rigid with, its distance from the first [m] and the angle there [rad].
    """
    phi, (O, *_), (first, *others) = stroke[1], fixed, crank
    found: dict[str, Member] = {stroke[0]: phi, **{name: Ground(*place) for name, place in fixed.items()}}
    lengths = {name: hypot(place[0] - fixed[O][0], place[1] - fixed[O][1]) for name, place in crank.items()}
    arm: dict[str, Any] = {f"{O}{first}": lengths[first]}
    found[first] = Crank(O, angle=phi, **arm)
    for name in others:
        angle = atan2(crank[name][1] - fixed[O][1], crank[name][0] - fixed[O][0])
        labels: dict[str, Any] = {f"{O}{name}": lengths[name], f"{first}{O}{name}": angle}
        found[name] = OnLink(O, first, **labels)
    found |= {name: Link(" ".join(joints)) for name, joints in links.items()}
    found |= {name: Pin(at=place) for name, place in free.items()}
    name, (P, Q), far, angle = point
    labels = {f"{P}{name}": far, f"{Q}{P}{name}": angle}
    found[name] = OnLink(P, Q, **labels)
    return found
