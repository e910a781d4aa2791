"""What a crank's angle is measured from: the frame, or another body's direction."""

from __future__ import annotations

from collections.abc import Iterator

from ..errors import DefinitionError
from ..plan import Plan
from ..quantities import Angle, Joint, Negative, Quantity, Ref, Sum, name_of
from ..steps import Point


def terms(plan: Plan, quantity: Quantity, sign: float = 1.0) -> Iterator[tuple[float, Quantity]]:
    """Yield the terms of a sum with their signs, names resolved."""
    if isinstance(quantity, Ref):
        member = plan.members[quantity.target]
        assert isinstance(member, Quantity)
        yield from terms(plan, member, sign)
    elif isinstance(quantity, Sum):
        yield from terms(plan, quantity.a, sign)
        yield from terms(plan, quantity.b, sign)
    elif isinstance(quantity, Negative):
        yield from terms(plan, quantity.a, -sign)
    else:
        yield sign, quantity


def follows_points(plan: Plan, quantity: Quantity) -> bool:
    """Return whether a quantity depends on moving points, and not on strokes and dimensions alone."""
    return any(isinstance(plan.members[name], Point) and name in plan.moving for name in plan.reaches(quantity))


def measured_from(plan: Plan, joint: Joint, owner: str) -> tuple[str, str] | None:
    """Return the two points whose direction a turned joint's angle is counted from; None where that is the frame.

    Raises DefinitionError for an angle that depends on moving points in another way: its torque has no one body to act against.
    """
    for drive in joint.drives:
        moving = [(sign, term) for sign, term in terms(plan, drive.quantity) if follows_points(plan, term)]
        if not moving:
            continue
        (sign, term), *others = moving
        if others or sign < 0.0 or not isinstance(term, Angle):
            raise DefinitionError(
                f"{plan.title}: {owner} = {plan.members[owner]}: for forces its angle is counted from the frame or from one body, "
                f"such as angle(A, B) + phi; {drive.quantity} is neither."
            )
        return name_of(term.P), name_of(term.Q)
    return None


def drives_of(plan: Plan, angle: Quantity) -> list[tuple[float, Quantity]]:
    """Return the terms of an angle that are not another body's direction, with their signs."""
    return [(sign, term) for sign, term in terms(plan, angle) if not follows_points(plan, term)]
