"""Text of PMKS, a line for each joint, `ground input R 0 0 0 tfff`: read and written."""

from __future__ import annotations

import re
from dataclasses import dataclass
from math import degrees, radians
from string import ascii_uppercase

from ..errors import ensure
from .found import FoundMachine
from .machine_sketch import MachineSketch, Place, line_angle, written

FRAME = ("ground", "gnd", "grnd", "grd")
KINDS = ("R", "P", "RP", "G")
FLAGS = re.compile(r"[tf]{4}|[-+]{4}")
"""The last word of a joint: whether path, velocity and acceleration are shown, and whether it drives; + and - are the older letters."""


@dataclass
class PmksJoint:
    """A line of the text: the key of its point, its kind, links, place [units of the file], angle [rad], and whether it drives."""

    key: str
    kind: str
    links: list[str]
    place: Place
    angle: float
    drives: bool

    @property
    def mover(self) -> str:
        """Of a slide, the link that its point is on: the second; the first where that lets the frame slide, which comes to the same."""
        first, second = self.links
        return first if self.kind == "P" and is_frame(second) else second


def read_pmks_text(found: FoundMachine, text: str) -> None:
    """Read joints: R pins its links, P lets the second slide in the first, RP is a pin in a slot; the fourth letter t drives."""
    text = text.partition("mech=")[2] or text
    lines = [line for line in re.split(r"[\n|]", text) if line.strip() and "=" not in line.split(",")[0]]
    bodies: dict[str, list[str]] = {}
    joints: list[PmksJoint] = []
    for number, line in enumerate(lines):
        joint = joint_of(found, line, number)
        if joint.kind == "G":
            found.left_out.append(f"the gear pair of {' and '.join(joint.links)}")
        else:
            joints.append(joint)
            bodies |= {name: [] for name in joint.links if not is_frame(name)}
    found.part = ""
    for joint in sorted(joints, key=lambda each: each.kind != "R"):  # a slide at a pin of its link is of that pin
        on = joint.links if joint.kind == "R" else [joint.mover]
        pins = [each.key for each in joints if each.kind == "R" and each.place == joint.place and on[0] in each.links]
        if joint.kind == "R" or not pins:
            found.add_point(joint.key, joint.key, *joint.place, any(map(is_frame, on)))
            for name in on:
                if not is_frame(name):
                    bodies[name].append(joint.key)
        else:
            joint.key = pins[0]
    for joint in joints:
        if joint.kind != "R":
            mover = joint.mover
            (slot,) = (name for name in joint.links if name != mover)
            along = found.slot(joint.key, joint.angle, None if is_frame(slot) else bodies[slot])
            found.add_slide(joint.key, joint.angle, along, bodies[mover] if joint.kind == "P" else None)
    for name, keys in bodies.items():
        found.add_link(name, keys)
    chosen = [joint for joint in joints if joint.drives]
    on_frame = [joint for joint in joints if joint.kind != "RP" and len(joint.links) == 2 and any(map(is_frame, joint.links))]
    if not chosen and on_frame:
        chosen = on_frame[:1]
        found.notes.append(f"No joint of the file drives; as in PMKS the first of the frame does, {chosen[0].key}.")
    for joint in chosen:
        if joint.kind == "R":
            found.turn(joint.key)
        else:
            found.push(joint.key, joint.angle, next(along for point, along in found.slides if point == joint.key))


def joint_of(found: FoundMachine, line: str, number: int) -> PmksJoint:
    """Return the joint of a line; FileError for a line that is none."""
    words = re.split(r"[,\s]+", line.strip().strip(","))
    found.part = f"joint {number + 1}"
    places = [place for place, word in enumerate(words) if word.upper() in KINDS]
    found.ensure(places and 1 <= places[-1] <= len(words) - 3, "links, R, P, RP or G, then x and y are expected, ground,input,R,0,0.")
    names, kind, rest = words[: places[-1]], words[places[-1]].upper(), words[places[-1] + 1 :]
    x, y = (found.number(word, name) for word, name in zip(rest, "xy", strict=False))
    flags = rest.pop() if FLAGS.fullmatch(rest[-1]) else ""
    has_angle = len(rest) > 2 and re.match(r"[-+.\d]", rest[2]) is not None
    found.ensure(kind == "R" or len(names) == len({*names}) == 2, f"{kind} joins two links.")
    found.ensure(kind != "P" or not all(map(is_frame, names)), "both links of P are the frame; name the link that slides.")
    found.ensure(kind in ("R", "G") or has_angle, f"{kind} has the angle of its slide behind x and y [deg].")
    angle = radians(found.number(rest[2], "the angle")) if has_angle else 0.0
    key = ascii_uppercase[number] if number < len(ascii_uppercase) else f"P{number + 1}"
    return PmksJoint(key, kind, names, (x, y), angle, flags[3:] in {"t", "+"})


def is_frame(name: str) -> bool:
    """Return whether a link is the frame."""
    return name.lower().startswith(FRAME)


def pmks_text(sketch: MachineSketch) -> str:
    """Return a sketch as text of PMKS in mm; DefinitionError for parts it cannot express."""
    drives = [*sketch.drives.values()]
    kinds = ", ".join(f"a {each.kind}" for each in drives)
    ensure(
        len(drives) == 1 and drives[0].kind == "crank", f"{sketch.name}: text of PMKS has one crank and no other drive, the sketch {kinds}."
    )
    lines, pivot = [], drives[0].ends[0]
    on = {name: [link for link, points in sketch.links.items() if name in points] for name in sketch.points}
    for name, (x, y) in sketch.points.items():
        place, own = f"{written(1e3 * x)},{written(1e3 * y)}", [*(["ground"] if name in sketch.fixed else []), *on[name]]
        if on[name]:
            lines.append(f"{','.join(own)},R,{place},0,{'ffft' if name == pivot else 'ffff'}")
        for slide in sketch.slides.values():
            if slide.point == name:
                along, carrier = slide.along, "ground"
                if isinstance(along, tuple) and not {*along} <= {*sketch.fixed}:
                    carrier = next((link for link, points in sketch.links.items() if {*along} <= {*points}), "")
                ensure(carrier and on[name], f"{sketch.name}: the slide of {name} is between no two links, which text of PMKS cannot say.")
                if isinstance(along, tuple):
                    along = line_angle(*(sketch.points[end] for end in along))
                lines.append(f"{carrier},{on[name][0]},RP,{place},{written(degrees(along))},ffff")
    return "\n".join(lines) + "\n"
