"""The plans as files of each program, written here and not by the package, so that a reader is not tested against its own writer."""

import json
from math import atan2, cos, dist, sin
from urllib.parse import quote

from tests.linkage.sketch.plans import Plan

DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"


def has_offset(plan):
    """Return whether a slot of a moving link goes beside its pins, which only PMKS and version 2 of PMKS+ say."""
    return any(isinstance(along, tuple) for _, along in plan.slides)


def is_plain(plan):
    """Return whether slides are only on the frame, or on a link that a pin of another link slides on."""
    return not has_offset(plan) and not any(point in plan.fixed for point, _ in plan.slides)


def csv(plan: Plan):
    """Return a table of points and links."""
    if has_offset(plan):
        return None
    rows = ["kind,name,x [mm],y [mm],what"]
    rows += [f"point,{name},{x!r},{y!r},{'fixed' if name in plan.fixed else 'pin'}" for name, (x, y) in plan.points.items()]
    rows += [f"link,,,,{' '.join(link)}" for link in plan.links]
    rows += [f"slide,,,,{point} {' '.join(along) if isinstance(along, str) else f'{along!r}rad'}" for point, along in plan.slides]
    rows += [f"crank,,,,{' '.join(plan.crank)}"] if plan.crank else [f"cylinder,,,,{' '.join(plan.cylinder)} {plan.throw!r}mm"]
    return "\n".join(rows)


def linkage2(plan: Plan):
    """Return a file of Linkage, 96 dots for each 24.5 mm that it shows."""
    if has_offset(plan):
        return None
    dots = 96.0 / 24.5
    names = list(plan.points)
    places = dict(plan.points)
    limits = {}
    for point, along in plan.slides:
        if isinstance(along, str):
            limits[point] = tuple(along)
        else:
            x, y = places[point]
            for mark, sign in (("a", -300.0), ("b", 300.0)):
                places[point + mark] = (x + sign * cos(along), y + sign * sin(along))
            limits[point] = (point + "a", point + "b")
    names = list(places)
    fixed = [*plan.fixed, *(end for ends in limits.values() for end in ends if end not in plan.points)]
    lines = ['<?xml version="1.0"?>', "<linkage2>", '<program zoom="1" xoffset="0" yoffset="0" units="Millimeters"/>']
    for name, (x, y) in places.items():
        marks = f' id="{names.index(name)}" x="{x * dots!r}" y="{y * dots!r}" name="{name}"' + ' anchor="true"' * (name in fixed)
        marks += ' input="true" rpm="15"' if plan.crank and name == plan.crank[0] else ""
        marks += ' slider="true"' if name in limits else ""
        inner = "".join(f'<slidelimit id="{names.index(each)}"/>' for each in limits.get(name, ()))
        lines.append(f"<connector{marks}>{inner}</connector>")
    for number, link in enumerate(plan.links):
        lines.append(f'<Link id="{number}">{"".join(connector(names, each) for each in link)}</Link>')
    if plan.cylinder:
        lines.append(f'<Link id="99" actuator="true" throw="{plan.throw * dots!r}" cpm="15">')
        lines.append("".join(connector(names, each) for each in plan.cylinder) + "</Link>")
    return "\n".join([*lines, "</linkage2>"])


def connector(names, name):
    """Return the connector of a link."""
    return f'<connector id="{names.index(name)}"/>'


def pmks(plan: Plan, letters="tf"):
    """Return text of PMKS, with its letters for yes and no; None for a plan with a cylinder."""
    if plan.cylinder:
        return None
    (yes, no), lines = letters, []
    for name, (x, y) in plan.points.items():
        links = ["ground"] * (name in plan.fixed) + [f"n{number}" for number, link in enumerate(plan.links) if name in link]
        lines.append(f"{' '.join(links)} R {x!r} {y!r} 0 {yes}{no}{no}{yes if name == plan.crank[0] else no}")
    for point, along in plan.slides:
        x, y = plan.points[point]
        rider = next((f"n{number}" for number, link in enumerate(plan.links) if point in link), "ground")
        slot = along[0] if isinstance(along, tuple) else along
        carrier = next((f"n{number}" for number, link in enumerate(plan.links) if isinstance(slot, str) and {*slot} <= {*link}), "ground")
        kind, angle = "P" if point in plan.rigid else "RP", angle_of(plan, along) * 180.0 / 3.141592653589793
        lines.append(f"{carrier} {rider} {kind} {x!r} {y!r} {angle!r} {4 * no}")
    return "\n".join(lines)


def pmks_address(plan: Plan):
    """Return a share address of PMKS with its older letters, + and -; None for a plan with a cylinder."""
    joints = pmks(plan, "+-")
    return joints and f"https://designengrlab.github.io/PMKS/pmks.html?set=s5&mech={quote(joints).replace('%0A', '|')}|&debug=1"


def angle_of(plan: Plan, along):
    """Return the angle of a slide [rad]."""
    if not isinstance(along, str):
        return along[1] if isinstance(along, tuple) else along
    (ax, ay), (bx, by) = (plan.points[each] for each in along)
    return atan2(by - ay, bx - ax)


def old_address(plan: Plan):
    """Return an old share address of PMKS+ in cm; None for cylinders and for slots of moving links."""
    if plan.cylinder or any(not isinstance(along, float) for _, along in plan.slides):
        return None
    joints, links = [], []
    for name, (x, y) in plan.points.items():
        joints.append(f"{name},{x / 10!r},{y / 10!r},,R,{'t' if name in plan.fixed else 'f'},Null,{'t' if name == plan.crank[0] else 'f'}")
    for link in plan.links:
        links.append(f"{link.lower()},R,1,1,0,0,{'%7C'.join(link)},,line")
    for point, along in plan.slides:
        x, y = plan.points[point]
        joints.append(f"{point.lower()},{x / 10!r},{y / 10!r},,P,t,{along!r},f")
        links.append(f"{point}block,P,Null,Null,Null,Null,{point}%7C{point.lower()},,Null")
    return f"https://app.pmksplus.com/?j={'%0A'.join(joints)}%0A&l={'%0A'.join(links)}%0A&f=&s=10,false,false,cm"


def first_address(plan: Plan):
    """Return a share address as the first versions of PMKS+ wrote it, with friction and without kinds of links; None with slides."""
    address = None if plan.slides else old_address(plan)
    if address is None:
        return None
    joints, _, links = address.partition("&l=")
    return f"{joints.replace(',Null,', ',0,0.1,').replace('%0A', ',%0A')}&l={links.replace(',R,1,1,', ',1,1,')}"


def packed(value):
    """Return a whole number in letters; a negative one begins with 0."""
    text, rest = "", abs(value)
    while True:
        text, rest = DIGITS[rest % 64] + text, rest // 64
        if not rest:
            return ("0" if value < 0 else "") + text


def short_body(plan: Plan, digest=False):
    """Return a short share address of PMKS+ in cm, thousandths of which are whole."""
    if not is_plain(plan):
        return None
    joints, links = [], []

    def joint(flags, key, x, y, angle=0.0, slot=()):
        numbers = ",".join(packed(round(1000 * each)) for each in (x / 10, y / 10, angle))
        joints.append(",".join([f"{DIGITS[flags]}{key}", key, numbers, *slot]))

    sliders = dict(plan.slides)
    for name, (x, y) in plan.points.items():
        if name not in sliders:
            joint((4 if name in plan.fixed else 0) + (2 if plan.crank and name == plan.crank[0] else 0), name, x, y)
        elif isinstance(sliders[name], str):
            joint(1, name, x, y, slot=(sliders[name], *sliders[name]))
        else:
            joint(5, name, x, y, sliders[name])
    for link in plan.links:
        links.append(f"YR{link},{link},Fe,Fe,0,0,c5cae9,{''.join(f'{each},' for each in link)},")
    if plan.cylinder:
        P, Q = plan.cylinder
        (px, py), (qx, qy) = plan.points[P], plan.points[Q]
        barrel, slide = ((px + part * (qx - px), py + part * (qy - py)) for part in (0.6, 0.5))
        joint(0, "N", *barrel)
        joint(43, "S", *slide, slot=(f"{P}N", P, "N"))
        links += [f"YR{P}N,{P}N,Fe,Fe,0,0,c5cae9,{P},N,,", f"YRS{Q},S{Q},Fe,Fe,0,0,c5cae9,S,{Q},,"]
    body = "2P.Ay,1E8.K,0.1011." + "".join(f"{each}." for each in joints) + "." + "".join(f"{each}." for each in links) + "...N_"
    body = body.replace("...N_", "..N_")
    checked = body + DIGITS[len(body) % 62]
    return f"{checked}*{digest_of(checked)}" if digest else checked


def digest_of(text):
    """Return FNV-1a of 32 bits in six letters."""
    value = 2166136261
    for letter in text:
        value = ((value ^ ord(letter)) * 16777619) % 2**32
    return "".join(DIGITS[value // 62**place % 62] for place in range(5, -1, -1))


def plus_json(plan: Plan):
    """Return the JSON of joints and links; None for cylinders and for slots of moving links."""
    if plan.cylinder or any(not isinstance(along, float) for _, along in plan.slides):
        return None
    names, sliders = list(plan.points), dict(plan.slides)
    joints = [
        [
            names.index(name), name, x, y, 0 if name in sliders else 1, sliders.get(name, 0.0) * 180.0 / 3.141592653589793,
            name in plan.fixed or name in sliders, name == plan.crank[0], 10, False, False, False, False, False, False, False,
        ]
        for name, (x, y) in plan.points.items()
    ]  # fmt: skip
    links = [
        [number, link, 1, "", 0, 0, "|".join(str(names.index(each)) for each in link), "", False, 0, 0]
        for number, link in enumerate(plan.links)
    ]
    return json.dumps({"j": joints, "l": links, "c": [], "t": [], "f": []})


def plus_bodies(plan: Plan):
    """Return the JSON of version 2 in cm: bodies turned and moved, pins as pairs, slides as pins in slots."""
    world = {"kind": "world", "id": "world", "pose": {"x": 0, "y": 0, "angle": 0}}
    bodies, attachments, joints, drivers, assemblies, limits = [world], [], [], [], [], []
    poses = {"world": (0.0, 0.0, 0.0)}

    def attach(body, name, place):
        x, y, turn = poses[body]
        dx, dy = place[0] / 10 - x, place[1] / 10 - y
        key = f"{body}:{name}"
        point = {"x": dx * cos(turn) + dy * sin(turn), "y": -dx * sin(turn) + dy * cos(turn)}
        if key not in [each["id"] for each in attachments]:
            attachments.append({"id": key, "bodyId": body, "point": point, "label": name, "trace": False})
        return key

    def join(kind, a, b, name, angle=0.0):
        place, key = plan.points[name], f"{kind}:{a}:{b}:{name}"
        frames = [{"attachmentId": attach(body, name, place), "angle": angle - poses[body][2]} for body in (a, b)]
        joints.append({"id": key, "label": name, "kind": kind, "bodyA": a, "bodyB": b, "frameA": frames[0], "frameB": frames[1]})
        return key

    for number, link in enumerate(plan.links):
        poses[link] = (1.0 + number, -2.0, 0.3 * number)
        x, y, turn = poses[link]
        bodies.append({"kind": "material", "id": link, "label": link, "pose": {"x": x, "y": y, "angle": turn}})
        for each in link:
            attach(link, each, plan.points[each])
    for name in plan.points:
        on = ["world"] * (name in plan.fixed) + [link for link in plan.links if name in link]
        for other in on[1:]:
            key = join("revolute", on[0], other, name)
            if plan.crank and name == plan.crank[0]:
                drivers.append(
                    {
                        "id": "d",
                        "coordinate": {"jointId": key, "coordinate": "angle"},
                        "profile": {"kind": "constant-speed", "initial": 0, "speed": 1},
                    }
                )
    for point, along in plan.slides:
        slot = along[0] if isinstance(along, tuple) else along
        carrier = next((link for link in plan.links if isinstance(slot, str) and {*slot} <= {*link}), "world")
        rider = next((link for link in plan.links if point in link), "world")
        join("prismatic" if point in plan.rigid else "pin-in-slot", carrier, rider, point, angle_of(plan, along))
    if plan.cylinder:
        (P, Q), mounts = plan.cylinder, []
        for part, name in (("barrel", P), ("rod", Q)):
            poses[part] = (0.0, 0.0, 0.7)
            bodies.append({"kind": "material", "id": part, "label": part, "pose": {"x": 0.0, "y": 0.0, "angle": 0.7}})
            body = next((link for link in plan.links if name in link), "world")
            joints.append({"id": f"m{part}", "kind": "revolute", "bodyA": body, "bodyB": part,
                           "frameA": {"attachmentId": attach(body, name, plan.points[name]), "angle": 0},
                           "frameB": {"attachmentId": attach(part, name, plan.points[name]), "angle": 0}})  # fmt: skip
            mounts.append(f"{part}:{name}")
        mid = tuple(0.5 * (a + b) for a, b in zip(plan.points[P], plan.points[Q], strict=True))
        frames = [{"attachmentId": attach(part, "mid", mid), "angle": 0} for part in ("barrel", "rod")]
        joints.append({"id": "in", "kind": "prismatic", "bodyA": "barrel", "bodyB": "rod", "frameA": frames[0], "frameB": frames[1]})
        assemblies.append({"id": "c", "kind": "cylinder", "label": "lift", "barrel": "barrel", "rod": "rod", "internalJoint": "in",
                           "barrelMount": mounts[0], "rodMount": mounts[1], "strokeLimit": "l"})  # fmt: skip
        travel = {"jointId": "in", "coordinate": "travel"}
        drivers.append({"id": "d", "coordinate": travel, "profile": {"kind": "constant-speed", "initial": 2.0, "speed": 1}})
        limits.append({"id": "l", "coordinate": travel, "lower": 0.0, "upper": 2.0 + plan.throw / 10})
    units = {"length": "cm", "mass": "g", "inertia": "kg*cm2", "force": "N"}
    names = ("bodies", "attachments", "joints", "drivers", "assemblies", "limits")
    lists = dict(zip(names, (bodies, attachments, joints, drivers, assemblies, limits), strict=True))
    return json.dumps({"version": 2, "units": units, **lists, "junctions": [], "forces": [], "groups": [], "holds": [], "locks": []})


def pylinkage(plan: Plan):
    """Return the JSON of joints and links; None for cylinders and for slots of moving links."""
    if plan.cylinder or any(not isinstance(along, float) for _, along in plan.slides):
        return None
    sliders = dict(plan.slides)
    joints = []
    for name, place in plan.points.items():
        kind = "ground" if name in plan.fixed else "prismatic" if name in sliders else "revolute"
        joints.append({"id": name, "type": kind, "position": [*place]})
        if name in sliders:
            joints[-1]["axis"] = [cos(sliders[name]), sin(sliders[name])]
    links = [{"id": link, "type": "link", "joints": [*link]} for link in plan.links]
    for link in links:
        if {*plan.crank} <= {*link["joints"]}:
            link |= {"type": "driver", "motor_joint": plan.crank[0], "angular_velocity": 0.1}
    return json.dumps({"name": plan.name, "joints": joints, "links": [{"id": "g", "type": "ground", "joints": [*plan.fixed]}, *links]})


def pylinkage_dyads(plan: Plan):
    """Return the JSON of joints by their parents: of the plans that are a crank and dyads of two links."""
    if plan.name not in ("Rocker", "Pump"):
        return None
    place = {name: {"name": name, "x": x, "y": y} for name, (x, y) in plan.points.items()}
    joints = [{"type": "Static", **place["O"]}]
    joints.append(
        {"type": "Crank", **place["A"], "joint0": {"ref": "O"}, "distance": dist(plan.points["O"], plan.points["A"]), "angle": 0.3}
    )
    if plan.name == "Pump":
        line = [{"inline": True, "type": "Static", "x": x, "y": 30, "name": f"L{x}"} for x in (0, 400)]
        parents = {"joint0": {"ref": "A"}, "joint1": line[0], "joint2": line[1]}
        joints.append({"type": "Linear", **place["C"], **parents, "revolute_radius": dist(plan.points["A"], plan.points["C"])})
        return json.dumps({"name": "pump", "joints": joints, "solve_order": None})
    lengths = {f"distance{k}": dist(plan.points[each], plan.points["B"]) for k, each in enumerate("AC")}
    joints += [
        {"type": "Static", **place["C"]},
        {"type": "Revolute", **place["B"], "joint0": {"ref": "A"}, "joint1": {"ref": "C"}, **lengths},
    ]
    far, turn = dist(plan.points["A"], plan.points["T"]), angle_of(Plan("", plan.points, "", []), "AT") - angle_of(plan, "AB")
    joints.append(
        {"type": "Fixed", "name": "T", "x": None, "y": None, "joint0": {"ref": "A"}, "joint1": {"ref": "B"}, "distance": far, "angle": turn}
    )
    return json.dumps({"name": "rocker", "joints": joints, "solve_order": None})


def dxf(plan: Plan, path, parts=""):
    """Write a drawing in mm: circles, lines and outlines, hatches, and what drives on a layer of its own.

    Parts may be "blocks" or "layers", plates that lie over each other, each with circles of its own pins.
    """
    import ezdxf

    document = ezdxf.new(units=4)
    space = document.modelspace()
    for name, place in plan.points.items():
        space.add_circle(place, 3.0)
        space.add_text(name, dxfattribs={"insert": (place[0] + 4.0, place[1] + 4.0)})
        if name in plan.fixed:
            space.add_hatch().paths.add_edge_path().add_arc(place, 3.0)
    for link in plan.links:
        if parts or {*link} != {*plan.crank}:
            corners = [plan.points[each] for each in link]
            drawn, layer = space, {"layer": f"part {link}" if parts == "layers" else "0"}
            if parts == "blocks":
                space.add_blockref(link, (0, 0))
                drawn = document.blocks.new(link)
            if parts:
                for place in corners:
                    drawn.add_circle(place, 2.0, dxfattribs=layer)
                (left, low), (right, high) = ([part(side) for side in zip(*corners, strict=True)] for part in (min, max))
                add = 0.2 * plan.size
                corners = [(left - add, low - add), (right + add, low - add), (right + add, high + add), (left - add, high + add)]
            if len(corners) == 2:
                drawn.add_line(*corners, dxfattribs=layer)
            else:
                drawn.add_lwpolyline(corners, close=True, dxfattribs=layer)
    for point, along in plan.slides:
        x, y = plan.points[point]
        space.add_line((x - 5 * cos(along), y - 5 * sin(along)), (x + 5 * cos(along), y + 5 * sin(along)), dxfattribs={"layer": "Slides"})
    role = "crank" if plan.crank else "cylinder"
    space.add_line(*(plan.points[each] for each in plan.crank or plan.cylinder), dxfattribs={"layer": role})
    document.saveas(path)


FORMATS = {
    "csv": (csv, ".csv", None), "linkage2": (linkage2, ".linkage2", None), "pmks": (pmks, ".txt", 1e-3), "old": (old_address, "", None),
    "first": (first_address, "", None), "pmks address": (pmks_address, ".txt", 1e-3),
    "short": (short_body, "", None), "digest": (lambda plan: short_body(plan, True), "", None), "json": (plus_json, ".json", 1e-3),
    "bodies": (plus_bodies, ".json", None), "pylinkage": (pylinkage, ".json", 1e-3), "dyads": (pylinkage_dyads, ".json", 1e-3),
}  # fmt: skip
"""What writes each format, the end of its file's name ("" for an address), and the scale that its reader has to be told [m]."""
