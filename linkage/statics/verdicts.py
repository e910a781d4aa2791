"""What is said of any machine's forces: that it is not held, and what the drives of strokes give that no cylinder holds."""

from __future__ import annotations

import numpy as np

from ..language import said
from ..loads import Acting, TwoPoint
from ..motion import Judge, most, stroke_unit
from ..units import show
from ..verdict import Remark, Verdict
from .applied import plan_in_case
from .force_requests import drive_force
from .holding import closed_ties, holders_of
from .solution import held_fault


def held_verdict(judge: Judge) -> Verdict | None:
    """Return the verdict that a machine is not held, of all load cases that a judge looks at; None where it is held in all."""
    for case in dict.fromkeys(case for place in judge.places for case in place.cases(judge.acting)):
        fault = held_fault(judge.motion, case)
        if fault:
            is_own = plan_in_case(judge.plan, Acting(case=case)) is judge.plan
            return Verdict("held", False, fault if is_own else said("in load case {case}, {sentence}", case=case, sentence=fault))
    return None


LEAST = 1e-3
"""N or Nm: less than this is no force of a drive."""


def drive_remarks(judge: Judge) -> list[Remark]:
    """Return what the drives of strokes give that no cylinder holds, of one design of a machine with cylinders.

    Strokes that put oil into closed lines or wind ropes are held by these; in a load case that shuts a line, others may be.
    """
    plan = judge.plan
    if not any(each.holds for each in plan.of_kind(TwoPoint).values()) or any(map(np.ndim, judge.designs.values())):
        return []
    held = {}
    for case in judge.cases:
        in_case = plan_in_case(plan, Acting(case=case))
        held[case] = set(holders_of(in_case).strokes_taken)
        for tie in closed_ties(in_case):
            held[case].update(tie.run.strokes if tie.run is not None else (), in_case.reaches(tie.added) if tie.added is not None else ())
    loose = {name: [case for case, strokes in held.items() if name not in strokes] for name in plan.strokes}
    asked = [(name, case) for name, cases in loose.items() for case in (cases if len(cases) < len(held) else [""])]
    answers = judge.lost_allowed().answers([most(abs(drive_force(name, case=case or None))) for name, case in asked]) if asked else []
    found: dict[str, tuple[float, Remark]] = {}
    for (name, case), answer in zip(asked, answers, strict=True):
        size = float(answer.value)
        if size > max(LEAST, found[name][0] if name in found else 0.0):
            unit = "kN" if stroke_unit(plan, name) == "m" else "kNm"
            force = answer.amount if np.isinf(size) else show(size, unit, 4)
            what = said("{stroke} is held by no cylinder: its drive gives up to {force}", stroke=name, force=force)
            found[name] = size, Remark(f"{what}, {said('in the case {case}', case=case) + ', ' if case else ''}{answer.place}.")
    return [remark for _, remark in found.values()]
