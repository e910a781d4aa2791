"""From a machine back to a sketch, at one of its poses."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from ..errors import DefinitionError, ensure, is_class_of
from ..loads import TwoPoint, Weight
from ..mechanism import Mechanism, require_mechanism
from ..motion import Motion
from ..numeric.convex import corner_turn
from ..plan import Part
from ..quantities import FRAME_SIDE, Dimension, Joint, Quantity, Stroke, name_of
from ..steps import Drawn, Group, Slide
from .machine_sketch import MachineSketch, SketchDrive, SketchSlide, SketchWeight

ONE_TO_ONE = 1e-12
"""A driven length or angle follows its stroke one to one where its slope is 1 to so much."""
NOT_TOLD = ("point", "link", "guide")
"""Kinds of members that a sketch holds, or that it needs no more."""
FOUND_ANEW = Dimension, Stroke, Drawn, Group, Slide
"""What is found anew from a sketch: dimensions are measured, groups are made of pins."""


def sketch_of(machine: Mechanism | type[Mechanism], at: Mapping[str, float] | None = None) -> MachineSketch:
    """Return a machine of pins, links, slides, cranks and cylinders as a sketch.

    Parameters
    ----------
    machine : Mechanism or type of Mechanism
        The machine; of a class the one with its own dimensions.
    at : mapping of str to float, optional
        The strokes [m or rad] at which it is drawn. By default those of its own sketch.

    Returns
    -------
    MachineSketch
        Its points where they are at these strokes. A note names what it does not hold: other loads, outputs, outlines.

    Raises
    ------
    DefinitionError
        A member is none of these, by its name; a batch of designs.
    AssemblyError
        It cannot be assembled there.
    """
    design = require_mechanism(machine() if is_class_of(machine, Mechanism) else machine)
    plan, title = design.plan, design.plan.title
    ensure(not any(np.ndim(each) for each in design.dimensions.values()), f"{title}: a sketch is of one design, not of a batch of them.")
    ensure(not plan.of_kind(Part), f"{title}: it has parts; take the sketch of each machine by itself.")
    strokes: dict[str, Any] = {**plan.sketch_strokes, **(at or {})}
    motion = design.at(**strokes)
    places = {name: (float(motion.x(name)) + 0.0, float(motion.y(name)) + 0.0) for name in plan.points}  # zero has no sign
    joints = [(name, joint) for name, point in plan.points.items() for joint in point.joints() if plan.is_there(joint)]
    joints += [(each.name, joint) for group in plan.groups.values() for each in group.slides for joint in each.joints()]
    drives = dict(drives_of(design, joints, strokes))
    idle = [name for name in plan.strokes if name not in drives]
    what = f"{title}: no crank on the frame and no cylinder follows the stroke"
    ensure(not idle, f"{what} {', '.join(idle)} one to one; a sketch has no other drives.")
    slides = {f"slide_{number}": each for number, each in enumerate(slides_of(design, joints, motion), 1)}
    frame = tuple(name for name, point in plan.points.items() if point.is_fixed or name in plan.ground)
    bodies = [body.points for body in plan.links if not body.fixed and len(body.points) > 1]
    arms = [drive.ends for drive in drives.values() if drive.kind == "crank"]
    bodies += [ends for ends in arms if not any({*ends} <= {*points} for points in bodies)]
    links = {f"link_{'_'.join(points)}": points for points in bodies}
    held = {*frame, *(point for points in links.values() for point in points), *(slide.point for slide in slides.values())}
    loose = [name for name in plan.points if name not in held]
    ensure(not loose, f"{title}: the sketch has no word for what holds {', '.join(loose)}; it is on no link and no slide.")
    hung = {
        name: each for name, each in plan.of_kind(Weight).items() if f"{name}.mass" in design.dimensions and each.gravity == Weight.gravity
    }
    weights = {name: SketchWeight(name_of(each.point), float(design.dimensions[f"{name}.mass"])) for name, each in hung.items()}
    rams = dict[str, str]()
    for name, each in plan.of_kind(TwoPoint).items():  # single cylinders by the drives that they follow
        bore, rod = (float(design.dimensions.get(f"{name}.{part}", 0.0)) for part in ("bore", "rod"))
        stroke = next((stroke for stroke, drive in drives.items() if {*drive.ends} == {*each.ends} and drive.kind == "cylinder"), None)
        if bore and rod and stroke is not None and vars(each).get("count") == 1:
            rams[stroke], drives[stroke] = name, replace(drives[stroke], bore=bore, rod=rod)
    told = {*weights, *rams.values()}
    others = [
        name for name, each in plan.members.items() if not isinstance(each, FOUND_ANEW) and each.kind not in NOT_TOLD and name not in told
    ]
    notes = (f"Not in the sketch of {title}: {', '.join(others)}.",) if others else ()
    return MachineSketch(title, places, frame, links, slides, drives, weights=weights, notes=notes)


def drives_of(design: Mechanism, joints: list[tuple[str, Joint]], strokes: Mapping[str, float]) -> Iterator[tuple[str, SketchDrive]]:
    """Yield the drives, by their strokes; DefinitionError for a driven length or angle that does not follow one stroke one to one."""
    plan = design.plan
    driven: list[tuple[str, str, tuple[str, str], Quantity]] = []
    for name, joint in joints:
        if joint.kind == "crank" and joint.by == FRAME_SIDE:
            driven += [(name, "crank", (joint.point, name), drive.quantity) for drive in joint.drives]
    driven += [(f"{bar.P}{bar.Q}", "cylinder", (bar.P, bar.Q), bar.length) for bar in plan.cylinders]
    for name, kind, ends, quantity in driven:
        reached = plan.reaches(quantity) | {quantity.name}
        own = [each for each in plan.strokes if each in reached]
        slope = 0.0
        if len(own) == 1 and plan.points.keys().isdisjoint(reached):
            values = {**plan.defaults, **design.dimensions, **strokes}
            here, there = (float(plan.reading({**values, own[0]: strokes[own[0]] + step}).value(quantity)) for step in (0.0, 1.0))
            slope = there - here
        if abs(slope - 1.0) > ONE_TO_ONE:
            raise DefinitionError(f"{plan.title}: the {kind} {name} does not follow one stroke one to one, which a sketch needs of it.")
        stroke = plan.strokes[own[0]]
        yield own[0], SketchDrive(kind, ends, float(stroke.start), float(stroke.end), float(strokes[own[0]]))


def slides_of(design: Mechanism, joints: list[tuple[str, Joint]], motion: Motion) -> Iterator[SketchSlide]:
    """Yield the slides; DefinitionError for a joint that is neither a slide nor a crank of the frame."""
    plan, seen = design.plan, set[tuple[str, tuple[str, ...]]]()
    for name, joint in joints:
        if (joint.kind == "crank" and joint.by == FRAME_SIDE) or (joint.point, joint.track) in seen:
            continue
        guide = plan.guide_of(joint.by)
        ends = guide.points if guide is not None else joint.track
        if joint.kind != "guide" or (guide is not None and guide.joints()):
            raise DefinitionError(f"{plan.title}: {name} = {plan.members[name]} is no pin, link, slide, crank or cylinder of a sketch.")
        seen.add((joint.point, joint.track))
        if len(ends) == 2:
            places = np.array([(float(motion.x(each)), float(motion.y(each))) for each in (joint.point, *ends)])
            size = float(np.max(np.abs(places))) or 1.0
            is_in_line = abs(corner_turn(places, 0, 1, 2)) <= 1e-9 * size * size  # to the digits of their places
            what = f"{plan.title}: the slot of {name} = {plan.members[name]}"
            ensure(is_in_line, f"{what} misses its pins; a sketch needs it through two of them.")
            yield SketchSlide(joint.point, (ends[0], ends[1]))
        else:
            assert guide is not None
            ensure(not ends, f"{plan.title}: the guide {guide.name} = {guide} goes through a moving point in a direction of the frame.")
            line = guide.line(plan.reading({**plan.defaults, **design.dimensions}))
            yield SketchSlide(joint.point, float(np.arctan2(line.direction.y, line.direction.x)))
