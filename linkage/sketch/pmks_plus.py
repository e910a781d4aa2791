"""Machines of PMKS+: share addresses, old (?j=...&l=...) and short (2P.Ay,...), JSON of joints and links, or of bodies."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import takewhile
from math import cos, hypot, pi, radians, sin
from urllib.parse import parse_qs, unquote
from zlib import crc32

import numpy as np

from ..frozen import record
from ..numeric.convex import corner_turn
from ..units import parse
from .found import FoundDrive, FoundMachine, JsonTable
from .machine_sketch import line_angle

DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"
CHECKS = DIGITS[:62]
DIGEST = 6
LENGTHS = "in", "cm", "m"
"""Units of length of a short address, by their digit."""
RIGHT, COARSE = 0.5 * pi, 6e-4
"""An angle is written in thousandths of a radian; so near to a whole quarter of a turn it is that."""
SHORT = re.compile(r"[\w-]{1,2}\.[\w-]+(?:,[\w-]+)*\.[\w-]+,[\w-]+\.[0-3]{3,4}\..*", re.DOTALL)
"""How the text of a short address begins: settings as flags, numbers, whole numbers and units."""


@record
class PlusJoint:
    """A joint: a pin, or a slide where it `slides`, on a line at an angle [rad] of the frame or through two joints of a link."""

    key: str
    name: str
    x: object
    y: object
    slides: bool = False
    fixed: bool = False
    drives: bool = False
    rigid: bool = False
    """Of a slide, whether what slides may not turn."""
    angle: float = 0.0
    line: tuple[str, str] | None = None


@record
class PlusLink:
    """A link by the keys of its joints; a block only holds the pin and the slide of one joint together."""

    name: str
    keys: tuple[str, ...]
    block: bool = False


def read_plus(found: FoundMachine, joints: Sequence[PlusJoint], links: Sequence[PlusLink], clockwise: bool = False) -> None:
    """Enter joints and links; a pin and a slide that a block holds together become one joint."""
    known = {joint.key: joint for joint in joints}
    found.ensure(len(known) == len(joints), "two joints have one name.")
    for link in links:
        found.ensure(all(key in known for key in link.keys), f"the link {link.name} names a joint that is not there.")
        if link.block and len(link.keys) == 2:
            pin, slide = sorted(link.keys, key=lambda key: known[key].slides)
            found.ensure(known[slide].slides and not known[pin].slides, f"the block {link.name} holds no pin and slide.")
            held, line = known[pin], known.pop(slide)
            known[pin] = replace(line, key=pin, name=held.name, rigid=held.rigid or line.rigid, drives=held.drives or line.drives)
    for joint in known.values():
        found.add_point(joint.key, joint.name, joint.x, joint.y, joint.fixed and not joint.slides)
    for link in links:
        if not link.block:
            found.add_link(link.name, link.keys)
    for joint in known.values():
        if joint.slides and not enter_cylinder(found, joint, known):
            angle, along = joint.angle, joint.line or joint.angle
            if joint.line is not None:
                angle = line_angle(*(found.points[found.known(key, "a slot")].place for key in joint.line))
            on = [points for _, points in found.links if joint.key in points]
            found.add_slide(joint.key, angle, along, on[0] if joint.rigid and on else None)
            if joint.drives:
                found.push(joint.key, angle, along)
    for joint in known.values():
        if joint.drives and not joint.slides:
            found.turn(joint.key, clockwise)


def enter_cylinder(found: FoundMachine, joint: PlusJoint, known: Mapping[str, PlusJoint]) -> bool:
    """Enter a driven slide of a rod in a barrel as one cylinder, and return True; False where more than the rod hangs on it."""
    if not (joint.drives and joint.rigid and joint.line):
        return False
    barrels = [points for _, points in found.links if {*points} == {*joint.line}]
    rods = [points for _, points in found.links if joint.key in points]
    if len(barrels) != 1 or len(rods) != 1 or len(rods[0]) != 2:
        return False
    others = [key for _, points in found.links if points not in (barrels[0], rods[0]) for key in points]
    others += [key for key, each in known.items() if each.fixed and not each.slides]
    (rod_end,) = (key for key in rods[0] if key != joint.key)
    feet = [key for key in joint.line if key in others]
    if len(feet) != 1 or joint.key in others:
        return False
    corners = np.array([found.points[key].place for key in (*joint.line, rod_end)])
    if abs(corner_turn(corners, 0, 1, 2)) > 5e-3 * found.size**2:
        return False
    inside = [found.points.pop(key).name for key in (joint.key, *(key for key in joint.line if key != feet[0]))]
    found.links = [each for each in found.links if each[1] not in (barrels[0], rods[0])]
    found.drives.append(FoundDrive("cylinder", (feet[0], rod_end)))
    ends = f"{found.points[feet[0]].name} and {found.points[rod_end].name}"
    found.notes.append(f"Barrel and rod between {ends} are one cylinder; {', '.join(inside)} lie in it.")
    return True


# -- the short address -------------------------------------------------------------------------------------


def read_short_address(found: FoundMachine, text: str) -> None:
    """Read the text behind the ? of an address, `2P.Ay,1E8.K,0.1011...`; FileError where its checks show damage."""
    body, mark, digest = text.rpartition("*")
    if mark and len(digest) == DIGEST:
        found.ensure(digest_of(body) == digest, "the address is damaged, its digest does not fit; copy it whole.")
    else:
        body = text
    body, check = body[:-1], body[-1:]
    found.ensure(CHECKS[len(body) % 62] == check, "the address is damaged, its length does not fit its last letter; copy it whole.")
    flags, _, _, units, rest = (body.split(".", 4) + [""] * 5)[:5]
    found.ensure(units[:1] in "012" and units, "the address has no unit of length; say --scale 1cm.")
    found.unit = parse(f"1 {LENGTHS[int(units[0])]}")
    texts = iter(rest.split("."))  # each joint and link ends with a dot, and so does each section
    joint_texts, link_texts, force_texts = ([*takewhile(bool, texts)] for _ in range(3))
    found.ensure(joint_texts and ".." in rest, "the address has no joints and links; copy it whole.")
    joints, links, heavy = list[PlusJoint](), dict[str, PlusLink](), list[str]()
    for fields in (each.split(",") for each in joint_texts):  # flags and key, name, x, y, angle, then link and two joints of its slot
        found.ensure(len(fields) >= 5 and len(fields[0]) > 1, f"a joint of the address has {len(fields)} parts instead of five or more.")
        bits = DIGITS.find(fields[0][0])
        key, name, (x, y, angle) = fields[0][1:], fields[1], (whole_of(found, each) / 1000.0 for each in fields[2:5])
        quarter = round(angle / RIGHT) * RIGHT
        angle = quarter if abs(angle - quarter) < COARSE else angle
        line = (fields[6], fields[7]) if len(fields) > 7 and fields[6] and fields[7] else None
        slides, drives, fixed, rigid = (bool(bits & bit) for bit in (1, 2, 4, 8))
        joints.append(PlusJoint(key, name or key, x, y, slides, fixed, drives, rigid, angle, line))
    for fields in (each.split(",") for each in link_texts):  # kind and key, name, mass, inertia, centre, colour, joints
        found.ensure(len(fields) >= 9 and len(fields[0]) > 2, f"a link of the address has {len(fields)} parts instead of nine or more.")
        keys = fields[7 : 7 + fields[7:].index("")] if "" in fields[7:] else fields[7:]
        if fields[0][0] not in "Namg4567":  # one that is within another
            links[fields[0][2:]] = PlusLink(fields[1] or fields[0][2:], tuple(keys), block=fields[0][1] == "P")
            mass = whole_of(found, fields[2]) / 1000.0
            heavy += [] if mass in (0.0, 1.0) else [f"{fields[1] or fields[0][2:]} ({mass:g})"]
    if heavy:  # PMKS+ gives each link none, formerly 1 kg, until its user says another mass
        found.left_out.append(f"the masses of {', '.join(heavy)}; hang them on by Weight or LinkMass")
    read_plus(found, joints, [*links.values()], clockwise=bool(whole_of(found, flags) & 1))
    for fields in (each.split(",") for each in force_texts):  # flags and key, link, name, start, end, size
        found.ensure(len(fields) >= 7, f"a force of the address has {len(fields)} parts instead of seven or more.")
        bits, (x, y, u, v, size) = DIGITS.find(fields[0][0]), (whole_of(found, each) / 1000.0 for each in fields[-5:])
        size *= (1.0 if bits & 2 else -1.0) * parse("1 lbf" if units[2:3] == "0" else "1 N")
        found.enter_force(fields[0][1:], keys_of(links, fields[1]), (x, y), (u, v), size, turns=bool(bits & 1))


def whole_of(found: FoundMachine, text: str) -> int:
    """Return a whole number of the address; one with a 0 in front is negative. FileError for other letters."""
    is_number = text and {*text} <= {*DIGITS} and len(text) < 12
    found.ensure(is_number, f"the address holds {text[:20]!r} where a number is expected; copy it whole.")
    value = 0
    for letter in text:
        value = 64 * value + DIGITS.index(letter)
    return -value if text[0] == "0" else value


def digest_of(text: str) -> str:
    """Return the digest of an address, FNV-1a of 32 bits in letters."""
    value = 0x811C9DC5
    for letter in text:
        value = (value ^ ord(letter)) * 0x01000193 & 0xFFFFFFFF
    letters = ""
    for _ in range(DIGEST):
        value, digit = divmod(value, 62)
        letters = CHECKS[digit] + letters
    return letters


# -- the old address, and JSON -----------------------------------------------------------------------------


def read_old_address(found: FoundMachine, text: str) -> None:
    """Read joints, links and settings of an address, `j=a,-1.24,-0.89,ab,R,t,Null,t%0A...&l=...&s=10,false,false,cm`."""
    parts = parse_qs(text, keep_blank_values=True, max_num_fields=20)
    rows = {name: [row.split(",") for row in parts.get(name, [""])[0].splitlines() if row.strip()] for name in "jlfs"}
    found.ensure(rows["j"] and rows["l"], "the address has no joints and links; copy it whole.")
    joints = []
    for row in rows["j"]:  # key, x, y, links, R or P, fixed, angle [rad], in the first versions a friction, whether it drives
        found.ensure(len(row) >= 8 and row[4] in ("R", "P"), "a joint of the address has no eight parts with R or P; copy it whole.")
        key, x, y, _, kind, fixed, angle, *drives_of = row
        drives = drives_of[0] if drives_of[0] in ("t", "f") else "".join(drives_of[1:2])
        turned = found.number(angle, f"the angle of {key}") if kind == "P" and angle != "Null" else 0.0
        joints.append(PlusJoint(key, key, x, y, slides=kind == "P", fixed=fixed == "t", drives=drives == "t", angle=turned))
    found.ensure(all(len(row) > 6 for row in rows["l"]), "a link of the address has fewer than seven parts; copy it whole.")
    links, settings = dict[str, PlusLink](), (rows["s"][0] if rows["s"] else [])
    for row in rows["l"]:  # key, R or P but in the first versions, mass, inertia, its centre, joints
        joints_of = row[6] if row[1] in ("R", "P") else row[5]
        links[row[0]] = PlusLink(row[0], tuple(filter(None, joints_of.split("|"))), block=row[1] == "P")
    if len(settings) > 3 and settings[3] in ("cm", "m", "mm", "in", "inch"):
        found.unit = parse(f"1 {settings[3]}")
    if settings[2:3] == ["true"]:  # with gravity
        found.left_out.append(f"the masses of {', '.join(links)}")
    read_plus(found, joints, [*links.values()], clockwise=settings[1:2] == ["true"])
    for row in rows["f"]:  # key, link, start, end, whether it turns with the link (f), outwards, size; in the first versions two parts
        found.ensure(len(row) >= 9, "a force of the address has fewer than nine parts; copy it whole.")
        a, b, c, d, *parts_of = (found.number(each, f"the force {row[0]}") for each in (*row[2:6], *filter(None, row[8:10])))
        size = (1.0 if row[7] == "true" else -1.0) * hypot(*parts_of) * parse("1 lbf" if "in" in "".join(settings[3:4]) else "1 N")
        found.enter_force(row[0], keys_of(links, row[1]), (a, b), (c, d), size, turns=row[6] == "f")


def keys_of(links: Mapping[str, PlusLink], key: str) -> tuple[str, ...]:
    """Return the joints of a link, none where it is not there."""
    return links[key].keys if key in links else ()


def read_plus_json(found: FoundMachine, data: JsonTable) -> None:
    """Read rows of joints under "j" and of links under "l"."""
    joints, links = list[PlusJoint](), list[PlusLink]()
    for row in (found.list_of(each, "a joint") for each in found.list_of(data["j"], "j")):
        # key, name, x, y, kind (0 slides), angle [deg], fixed, whether it drives, speed, welded
        found.ensure(len(row) >= 9, f"a joint has {len(row)} cells instead of nine or more.")
        long = len(row) > 12  # the shorter rows, of an earlier version, have no cell of their own for what drives
        angle = radians(found.number(row[5] or 0, f"the angle of {row[1]}"))
        slides, fixed, drives, rigid = joint_number(row[4]) == 0, is_set(row[6]), long and is_set(row[7]), is_set(row[9 if long else 8])
        joints.append(PlusJoint(str(joint_number(row[0])), str(row[1]), row[2], row[3], slides, fixed, drives, rigid, angle))
    for row in found.list_of(data["l"], "l"):
        cells = found.list_of(row, "a link")
        found.ensure(len(cells) > 6, f"a link has {len(cells)} cells instead of seven or more.")
        links.append(PlusLink(str(cells[1]), tuple(str(joint_number(key)) for key in str(cells[6]).split("|") if key)))
    found.left_out += [f"{len(data['f'])} forces"] if data.get("f") else []
    read_plus(found, joints, links)


def joint_number(given: object) -> object:
    """Return a whole number, in digits of base 16 where it is a text, as the file writes it; anything else as it is."""
    return int(given, 16) if isinstance(given, str) and re.fullmatch(r"-?[0-9a-f]{1,6}", given) else given


def is_set(given: object) -> bool:
    """Return whether a cell says yes."""
    return given in (True, "y", "true", "1", 1)


def address_text(text: str) -> str:
    """Return the text behind the ? of an address, letters unescaped where it is a short one; the text itself where it is no address."""
    query = text.partition("?")[2] or text
    return query if re.search(r"(?:^|&)j=", query) else unquote(query)


# -- the JSON of version 2: bodies with poses, attachments on them, joints between these, drivers and limits ---------

ENVELOPE = "pmks2:"
SLIDES = "prismatic", "pin-in-slot"


def json_in_address(found: FoundMachine, text: str) -> bytes:
    """Return the JSON in an address `pmks2:<crc>.<letters>`; FileError where it is damaged."""
    check, _, letters = text.strip().removeprefix(ENVELOPE).partition(".")
    raw = found.unpacked(letters)
    found.ensure(f"{crc32(raw):08x}" == check, "the address is damaged, its check does not fit; copy it whole.")
    return raw


def read_plus_bodies(found: FoundMachine, data: JsonTable) -> None:
    """Read bodies: attachments that pins join are one point, welded bodies one link, cylinders a length between their mounts."""
    BodyReader(found, data).read()


class BodyReader:
    """One document on its way into a `FoundMachine`."""

    def __init__(self, found: FoundMachine, data: JsonTable) -> None:
        self.found = found
        found.unit = parse(f"1 {self.found.table(data.get('units'), 'units').get('length')}", "length")
        self.bodies = self.by_id(data, "bodies")
        self.attachments = self.by_id(data, "attachments")
        self.joints = self.by_id(data, "joints")
        self.drivers = {self.joint_of(each): each for each in self.by_id(data, "drivers").values()}
        self.limits = {self.joint_of(each): each for each in self.by_id(data, "limits").values()}
        self.cylinders = [each for each in self.by_id(data, "assemblies").values() if each.get("kind") == "cylinder"]
        self.world = {key for key, body in self.bodies.items() if body.get("kind") == "world"}
        self.places = {key: self.place(each) for key, each in self.attachments.items()}
        self.one = {key: key for key in (*self.attachments, *self.bodies)}
        for name in ("forces", "groups", "gears"):
            found.left_out += [f"{len(data[name])} {name}"] if isinstance(data.get(name), list) and data[name] else []

    def by_id(self, data: JsonTable, name: str) -> dict[str, JsonTable]:
        """Return the tables of a list by their ids."""
        tables = [self.found.table(each, f"an entry of {name}") for each in self.found.list_of(data.get(name, []), name)]
        found = {str(each.get("id")): each for each in tables}
        self.found.ensure(len(found) == len(tables), f"two of {name} have one id.")
        return found

    def joint_of(self, table: JsonTable) -> str:
        """Return the id of the joint whose coordinate a driver or a limit is about."""
        return str(self.found.table(table.get("coordinate"), "a coordinate").get("jointId"))

    def entry(self, table: Mapping[str, JsonTable], key: object, what: str) -> JsonTable:
        """Return the entry of an id; FileError where there is none."""
        self.found.ensure(isinstance(key, str) and key in table, f"there is no {what} {key!r}.")
        return table[str(key)]

    def pose(self, body: object) -> tuple[float, float, float]:
        """Return where a body is, x and y in the file's units, its angle [rad]."""
        given = self.found.table(self.entry(self.bodies, body, "body").get("pose"), "a pose")
        x, y, angle = (self.found.number(given.get(name, 0.0), f"{name} of {body}") for name in ("x", "y", "angle"))
        return x, y, angle

    def place(self, attachment: JsonTable) -> tuple[float, float]:
        """Return where an attachment is, in the file's units."""
        x, y, angle = self.pose(attachment.get("bodyId"))
        point = self.found.table(attachment.get("point"), "a point")
        u, v = (self.found.number(point.get(name), f"{name} of {attachment.get('label')}") for name in "xy")
        return x + u * cos(angle) - v * sin(angle), y + u * sin(angle) + v * cos(angle)

    def root(self, key: str) -> str:
        """Return the representative of an attachment's or a body's merged group."""
        while self.one[key] != key:
            key = self.one[key]
        return key

    def frame(self, joint: JsonTable, side: str) -> tuple[str, str, float]:
        """Return the attachment, the body and the angle [rad] of a side of a joint."""
        given = self.found.table(joint.get(f"frame{side}"), "a frame")
        attachment = str(given.get("attachmentId"))
        body = str(self.entry(self.attachments, attachment, "attachment").get("bodyId"))
        return attachment, body, self.pose(body)[2] + self.found.number(given.get("angle", 0.0), "the angle of a frame")

    def sides(self, joint: JsonTable) -> list[tuple[str, str, float]]:
        """Return both sides of a joint, that of the guide first: the one that shows it, else the first one."""
        sides, shown = [self.frame(joint, "A"), self.frame(joint, "B")], joint.get("guideDisplay")
        guide = shown.get("bodyId") if isinstance(shown, dict) else sides[0][1]
        is_turned = sides[1][1] in self.world if joint.get("kind") == "prismatic" else sides[1][1] == guide
        return sides[::-1] if is_turned else sides

    def read(self) -> None:
        """Enter points, links, slides and drives."""
        within = {str(each.get("internalJoint")) for each in self.cylinders}
        for joint in self.joints.values():
            (first, a, _), (second, b, _) = self.frame(joint, "A"), self.frame(joint, "B")
            if joint.get("kind") in ("revolute", "weld"):
                self.one[self.root(second)] = self.root(first)
            if joint.get("kind") == "weld":
                self.one[self.root(b)] = self.root(a)
        hollow = {str(each.get(name)) for each in self.cylinders for name in ("barrel", "rod")}
        fixed = {self.root(key) for key, each in self.attachments.items() if each.get("bodyId") in self.world}
        inside = {self.root(key) for key, each in self.attachments.items() if each.get("bodyId") in hollow}
        inside -= {end for each in self.cylinders for end in self.mounts(each)}
        lines = [self.sides(joint)[0][0] for joint in self.joints.values() if joint.get("kind") in SLIDES]
        ends = [end for joint in self.joints.values() for end in self.sides(joint)[joint.get("kind") in SLIDES :]]
        inside |= {*lines} - {self.root(attachment) for attachment, _, _ in ends}  # where a slot is drawn, which is no point
        for key, each in self.attachments.items():
            if self.root(key) == key and key not in inside:
                self.found.add_point(key, each.get("label") or key, *self.places[key], key in fixed)
        bodies: dict[str, list[str]] = {}
        for key, each in self.attachments.items():
            body = self.root(str(each.get("bodyId")))
            if each.get("bodyId") not in {*self.world, *hollow} and self.root(key) not in inside:
                bodies.setdefault(body, []).append(self.root(key))
        for key, joint in self.joints.items():
            if key not in within and joint.get("kind") in SLIDES:
                self.slide(key, joint, bodies)
        for body, keys in bodies.items():
            self.found.add_link(str(self.bodies[body].get("label") or body), keys)
        for each in self.cylinders:
            self.cylinder(each)
        for key, driver in self.drivers.items():
            if self.entry(self.joints, key, "joint").get("kind") == "revolute":
                profile = self.found.table(driver.get("profile"), "a profile")
                backwards = self.found.number(profile.get("speed", 1.0), "a speed") < 0.0
                self.found.turn(self.found.known(self.root(self.frame(self.joints[key], "A")[0]), "a driver"), backwards)

    def slide(self, key: str, joint: JsonTable, bodies: dict[str, list[str]]) -> None:
        """Enter a slide: the point of one body on a line of the other, without turning where it is prismatic."""
        (_, carrier, angle), (mover, body, _) = self.sides(joint)
        point = self.found.known(self.root(mover), "a slide")
        for each in (carrier, body):
            is_held = each in self.world or self.root(each) in bodies
            self.found.ensure(is_held, f"the slide {joint.get('label') or key} is of a body that nothing else holds.")
        moves = joint.get("kind") != "prismatic" or body not in self.world
        self.found.ensure(moves, f"the slide {joint.get('label') or key} is of the frame on the frame; name the body that slides.")
        along = self.found.slot(point, angle, None if carrier in self.world else bodies[self.root(carrier)])
        self.found.add_slide(point, angle, along, bodies[self.root(body)] if joint.get("kind") == "prismatic" else None)
        if key in self.drivers:
            self.found.push(point, angle, along)
            self.found.drives[-1].reach = self.reach(key)

    def reach(self, key: str) -> float | None:
        """Return how far a driven joint goes, in the file's units or rad: from where it is driven from to its limit; None without one."""
        if key not in self.limits:
            return None
        profile = self.found.table(self.drivers[key].get("profile"), "a profile")
        initial = self.found.number(profile.get("initial", 0.0), "where a driver begins")
        return self.found.number(self.limits[key].get("upper"), "a limit") - initial

    def mounts(self, cylinder: JsonTable) -> list[str]:
        """Return the points that a cylinder is between, in so far as they are there."""
        ends = (str(cylinder.get(name)) for name in ("barrelMount", "rodMount"))
        return [self.root(end) for end in ends if end in self.attachments]

    def cylinder(self, given: JsonTable) -> None:
        """Enter a cylinder between its mounts; without a driver it holds nothing and is left out."""
        ends = [self.found.known(end, f"the cylinder {given.get('label')}") for end in self.mounts(given)]
        self.found.ensure(len(ends) == 2, f"the cylinder {given.get('label')} has no two mounts.")
        key = str(given.get("internalJoint"))
        if key in self.drivers:
            self.found.drives.append(FoundDrive("cylinder", (ends[0], ends[1]), self.reach(key), str(given.get("label") or "")))
        else:
            self.found.left_out.append(f"the cylinder {given.get('label')}, which nothing drives")
