"""The JSON of pylinkage: joints by their parents, or joints and links."""

from __future__ import annotations

from math import atan2, cos, dist, sin

from .found import TURN, FoundDrive, FoundMachine, JsonTable
from .machine_sketch import line_angle

TOLD = 1e-6
"""A distance that differs from the coordinates by more than so much of the size is told."""


def read_pylinkage(found: FoundMachine, data: JsonTable) -> None:
    """Read joints by their parents, or joints and links where the file has these."""
    joints = [found.table(each, "a joint") for each in found.list_of(data["joints"], "joints")]
    if "links" in data:
        read_joints_and_links(found, joints, [found.table(each, "a link") for each in found.list_of(data["links"], "links")])
        return
    for joint in joints:
        enter_joint(found, joint)
    for joint in joints:
        join_parents(found, joint)


def enter_joint(found: FoundMachine, joint: JsonTable) -> None:
    """Enter the point of a joint, and the fixed points among its parents that are written in place."""
    name = str(joint.get("name"))
    for parent in ("joint0", "joint1", "joint2"):
        given = joint.get(parent)
        if isinstance(given, dict) and given.get("inline") and parent_name(given) not in found.points:
            found.add_point(parent_name(given), parent_name(given), given.get("x"), given.get("y"), True)
    x, y = joint.get("x"), joint.get("y")
    kind = joint.get("type")
    if kind in ("Fixed", "Crank") and (x is None or y is None):
        origin = found.points[found.known(parent_name(joint.get("joint0")), name)].place
        turn = 0.0
        if kind == "Fixed":
            second = found.points[found.known(parent_name(joint.get("joint1")), name)].place
            turn = line_angle(origin, second) + found.number(joint.get("angle"), name)
        far = found.number(joint.get("distance"), name)
        x, y = origin[0] + far * cos(turn), origin[1] + far * sin(turn)
    found.add_point(name, name, x, y, kind == "Static")


def parent_name(given: object) -> str:
    """Return the name of the joint that a reference means."""
    table = given if isinstance(given, dict) else {}
    if table.get("inline"):
        return str(table.get("name") or f"P_{table.get('x')}_{table.get('y')}")
    return str(table.get("ref"))


def join_parents(found: FoundMachine, joint: JsonTable) -> None:
    """Enter the links, the slide and the drive of a joint, by its kind."""
    name, kind = str(joint.get("name")), joint.get("type")
    parents = [found.known(parent_name(joint[each]), name) for each in ("joint0", "joint1", "joint2") if joint.get(each) is not None]
    needed = {"Static": 0, "Crank": 1, "Fixed": 2, "Revolute": 2, "Linear": 3, "Prismatic": 3}
    found.ensure(kind in needed, f"{name} is of the kind {kind!r}, and only {', '.join(needed)} are read.")
    found.ensure(len(parents) >= needed[str(kind)], f"{name} is a {kind} with {len(parents)} parents instead of {needed[str(kind)]}.")
    if kind in ("Crank", "Linear", "Prismatic"):
        found.add_link("", [parents[0], name])
    if kind == "Crank":
        backwards = found.number(joint.get("angle") or 0.0, name) < 0.0
        found.drives.append(FoundDrive("crank", (parents[0], name), -TURN if backwards else TURN))
    if kind == "Fixed":
        found.add_link("", [*parents[:2], name])
    if kind == "Revolute":
        found.add_link("", [parents[0], name])
        found.add_link("", [parents[1], name])
    if kind in ("Linear", "Prismatic"):
        found.slides.append((name, (parents[1], parents[2])))
    for parent, key in zip(parents, ("distance0", "distance1") if kind == "Revolute" else ("distance",), strict=False):
        given = joint.get(key)
        if given is not None and kind in ("Crank", "Revolute", "Fixed"):
            drawn = dist(found.points[parent].place, found.points[name].place)
            if abs(found.number(given, f"{key} of {name}") - drawn) > TOLD * found.size:
                found.notes.append(f"{key} of {name} is {given} in the file and {drawn:.6g} by its coordinates, which count.")


def read_joints_and_links(found: FoundMachine, joints: list[JsonTable], links: list[JsonTable]) -> None:
    """Read joints with positions, and links that name them."""
    for joint in joints:
        place = found.list_of(joint.get("position"), f"the position of {joint.get('id')}")
        found.ensure(len(place) == 2, f"{joint.get('id')} has no position [x, y].")
        found.add_point(str(joint.get("id")), str(joint.get("name") or joint.get("id")), place[0], place[1], joint.get("type") == "ground")
    for link in links:
        keys = [str(each) for each in found.list_of(link.get("joints", []), "the joints of a link")]
        if link.get("type") != "ground":
            found.add_link(str(link.get("name") or link.get("id")), keys)
        if link.get("type") in ("driver", "arc_driver"):
            pivot = str(link.get("motor_joint") or next((key for key in keys if key in found.points and found.points[key].fixed), ""))
            arm = [key for key in keys if key != pivot]
            found.ensure(arm, f"the driver {link.get('id')} has no joint beside its motor.")
            reach = TURN
            if link.get("type") == "arc_driver":
                begin = link.get("initial_angle") if link.get("initial_angle") is not None else link.get("arc_start", 0.0)
                reach = found.number(link.get("arc_end", TURN), "arc_end") - found.number(begin, "initial_angle")
            elif found.number(link.get("angular_velocity", 1.0), "angular_velocity") < 0.0:
                reach = -TURN
            found.drives.append(FoundDrive("crank", (found.known(pivot, "a driver"), arm[0]), reach))
    for joint in joints:
        key = str(joint.get("id"))
        if joint.get("type") == "prismatic":
            axis = found.list_of(joint.get("axis", [1.0, 0.0]), f"the axis of {key}")
            u, v = (found.number(each, f"the axis of {key}") for each in [*axis, 0.0, 0.0][:2])
            found.slides.append((key, atan2(v, u)))
        if joint.get("type") == "tracker":
            found.add_link("", [str(joint.get("ref_joint1_id")), str(joint.get("ref_joint2_id")), key])
