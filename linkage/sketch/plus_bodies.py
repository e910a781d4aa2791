"""The JSON of PMKS+ version 2: bodies with poses, attachments on them, joints between these, drivers and limits."""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, sin
from zlib import crc32

from ..units import parse
from .found import FoundDrive, FoundMachine, JsonTable

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
