"""A drawing as a machine: circles are pins, lines and outlines are links, a hatch in a circle fixes it, layers say the rest.

An outline is one polyline, or lines and arcs from end to end.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations, pairwise
from math import dist, hypot, inf
from typing import Any

from ..errors import ensure, unknown
from ..surroundings import dxf_entities, visible
from .found import FoundDrive, FoundMachine
from .machine_sketch import Place, line_angle

ROLES = "pins", "links", "ground", "slides", "crank", "cylinder"
"""What a layer may be of, and by default its name."""
OWN = {"bodies", "centre_lines", "pins"}
"""Layers of the drawings that `export` writes."""
METRES = {1: 0.0254, 2: 0.3048, 4: 1e-3, 5: 1e-2, 6: 1.0, 7: 1e3, 8: 2.54e-8, 9: 2.54e-5, 10: 0.9144, 13: 1e-6, 14: 0.1}
"""The unit of a drawing by the number in its head [m]."""
MEETS = 1e-6
"""A line ends at a pin, or passes through it, where it comes nearer to it than so much of the size, or than the pin's radius."""
CHORDS = 16
"""Chords of an arc between two corners."""
GAP = 0.02
"""Of a drawing's size: ends of lines that are no farther apart were meant to meet."""
LINES = "LINE", "LWPOLYLINE", "POLYLINE", "ARC", "ELLIPSE", "SPLINE"
"""What a link is drawn with."""


def read_dxf(found: FoundMachine, path: str, layers: Mapping[str, Sequence[str]]) -> None:
    """Read the model space of a drawing; `layers` says by role which layers are meant, such as pins=["Bolts"]."""
    others = [role for role in layers if role not in ROLES]
    ensure(not others, f"{found.file}: --layer {', '.join(others)}: a layer is of {', '.join(ROLES)}.")
    drawing, every = dxf_entities(path)
    there = {str(each.dxf.layer).lower(): str(each.dxf.layer) for each in every}
    for role, names in layers.items():
        for name in names:
            if name.lower() not in there:
                raise unknown("Layer", name, there.values(), where=f"{found.file}, --layer {role}={name}")
    own = "it is a true-size drawing of this package, whose bodies are outlines; import the machine's own file"
    found.ensure("links" in layers or not there.keys() >= OWN, f"{own}, or the centre lines as links, --layer links=centre_lines.")
    found.unit = METRES.get(int(drawing.header.get("$INSUNITS", 0)))
    entities = [*visible(drawing, every, [name for names in layers.values() for name in names])]
    if len(entities) < len(every):
        found.left_out.append(f"what the drawing hides, {len(every) - len(entities)} of {len(every)} entities")
    DrawingReader(found, entities, {role: [each.lower() for each in layers.get(role, (role,))] for role in ROLES}).read()


class DrawingReader:
    """The entities of a drawing by the roles of their layers, on their way into a `FoundMachine`."""

    def __init__(self, found: FoundMachine, entities: Sequence[Any], layers: Mapping[str, Sequence[str]]) -> None:
        self.found, self.entities = found, entities
        self.role = {layer: role for role, names in layers.items() for layer in names}
        self.pins: dict[str, tuple[Place, float]] = {}
        """Each pin's centre and radius."""
        self.circles: dict[str, list[Any]] = {}
        """The circles around each pin's centre, such as one of each part that it joins."""

    def entities_on(self, kinds: Sequence[str], *roles: str) -> Iterator[Any]:
        """Yield the entities of some kinds on the layers of some roles; "" is any other layer."""
        for each in self.entities:
            if each.dxftype() in kinds and self.role.get(str(each.dxf.layer).lower(), "") in roles:
                yield each

    def read(self) -> None:
        """Enter pins, links, slides and drives."""
        circles = [*self.entities_on(("CIRCLE",), "pins")] or [*self.entities_on(("CIRCLE",), "", "links")]
        ground = [*self.entities_on(("CIRCLE",), "ground")]
        hatches = [corners_of(each) for each in self.entities_on(("HATCH",), *ROLES, "")]
        words = []
        for each in self.entities_on(("TEXT", "ATTRIB", "MTEXT"), *ROLES, ""):
            text = str(each.plain_text()).strip()
            if text and len(text) <= 20:  # else it is no name
                words.append((text, each))
        for circle in (*circles, *ground):
            x, y, _ = map(float, circle.ocs().to_wcs(circle.dxf.center))
            place, radius = (x, y), float(circle.dxf.radius)
            there = next((key for key, (centre, size) in self.pins.items() if dist(place, centre) <= size), None)
            if there is not None:  # a pin and its washer, or its hole in another part
                self.circles[there].append(circle)
                self.found.points[there].fixed |= circle in ground
                continue
            far, word = min(((way_to(each, word, place), word) for word, each in words), default=(0.0, ""))
            key = f"P{len(self.pins) + 1}"
            is_hatched = any(hatch and surrounds(place, hatch) for hatch in hatches)
            self.found.add_point(key, word if far <= 4.0 * radius and word else key, *place, circle in ground or is_hatched)
            self.pins[key], self.circles[key] = (place, radius), [circle]
        what = "there is no circle on the layers of pins; a circle is a pin, see --layer pins=NAME"
        if any(each.dxf.start_param == 0.0 and each.dxf.end_param > 6.28 for each in self.entities_on(("ELLIPSE",), "", "pins", "links")):
            what += ". There are ellipses: a block scaled by two numbers makes them of circles; insert it with one scale"
        self.found.ensure(self.pins, f"{what}.")
        drawn = [(each, corners_of(each)) for each in self.entities_on(LINES, "ground")]
        frame = [corners for _, corners in drawn if self.is_closed(corners)]
        frame += [corners for _, corners in outlines([each for each, own in drawn if own not in frame], MEETS * self.found.size)]
        self.found.outlines += [([], corners) for corners in frame]
        for key, (place, _) in self.pins.items():  # a plate of the frame that draws no circles has all that it surrounds
            self.found.points[key].fixed |= not ground and any(surrounds(place, corners) for corners in frame)
        self.read_links()
        for each in self.entities_on(("LINE",), "slides"):
            P, Q = corners_of(each)
            keys = [key for key in self.met([P, Q]) if not self.found.points[key].fixed]
            self.found.slides += [(key, line_angle(P, Q)) for key in keys]
            if not keys:
                self.found.left_out.append(f"a line of {drawn_on(each)} without pins")
        for role in ("crank", "cylinder"):
            for each in self.entities_on(("LINE",), role):
                keys = self.met(corners_of(each))
                if len(keys) == 2:
                    self.drive(role, keys[0], keys[1])
                else:
                    self.leave_out(each, "a line", f"that ends at {len(keys)} pins instead of two")

    def read_links(self) -> None:
        """Enter the links, and tell which lines are none."""
        drawn = [*self.entities_on(LINES, "links")] or [*self.entities_on(LINES, "")]
        met = [(each, self.met(corners_of(each))) for each in drawn]
        found = [(each, self.is_closed(corners_of(each)), keys) for each, keys in met if len(keys) > 1]
        plates = {id(each): corners_of(each) for each, is_plate, _ in found if is_plate}
        joined = list[Any]()
        for edges, corners in outlines([each for each, keys in met if len(keys) < 2], MEETS * self.found.size):
            if len(keys := self.met(corners)) > 1:
                found.append((edges[0], True, keys))
                plates[id(edges[0])] = corners
            joined += edges
        names, bodies = self.in_parts(found)
        alone = [(each, keys) for each, keys in met if len(keys) < 2 and not any(each is edge for edge in joined)]
        # Tell the least gap between the ends of two lines that make no outline, where it is so small that it was meant to be none.
        lines = [corners_of(each) for each, keys in alone if not keys]
        ends = [(number, end) for number, corners in enumerate(lines) for end in (*corners[:1], *corners[-1:])]
        limit = MEETS * self.found.size
        free = [(k, P) for k, P in ends if all(dist(P, Q) > limit for other, Q in ends if other != k)]
        gaps = ((dist(P, Q), P) for (k, P), (other, Q) in combinations(free, 2) if k != other)
        gap, (x, y) = min(gaps, default=(inf, (0.0, 0.0)))
        if gap < GAP * self.found.size:
            self.found.notes.append(f"An outline is open by {gap:.3g} near ({x:.6g}, {y:.6g}): let its lines meet, and it is a plate.")
        for each, keys in alone:
            kind = {"ARC": "an arc", "ELLIPSE": "an ellipse"}.get(each.dxftype(), f"a {each.dxftype().lower()}")
            self.leave_out(each, kind, f"with {len(keys)} pins")
        for number, keys in enumerate(bodies):  # a line drawn twice, or an edge of a plate, is no body of its own
            wider = next((other for other in bodies if {*keys} < {*other}), None)
            if wider is not None:
                pins, others = (" ".join(self.found.points[key].name for key in each) for each in (keys, wider))
                self.found.left_out.append(f"a link {pins}, whose pins all lie on the link {others}")
            elif not any({*keys} == {*other} for other in bodies[:number]):
                self.found.add_link(names[number], keys)
            if id(found[number][0]) in plates:
                self.found.outlines.append((keys, plates[id(found[number][0])]))
        around = [{*keys} for (_, is_plate, _), keys in zip(found, bodies, strict=True) if is_plate]
        locked = [each for each in combinations(around, 2) if each[0] != each[1] and len(each[0] & each[1]) > 1]
        for both in locked[:1]:
            one, other = (" ".join(self.found.points[key].name for key in self.pins if key in each) for each in both)
            what = f"The outlines of {one} and {other} surround two pins or more together, so that neither could turn on the other"
            remedy = "draw each part in a block or on a layer of its own, with a circle at each of its own pins"
            self.found.notes.append(f"{what}; where one only lies over a pin, {remedy}.")

    def in_parts(self, bodies: Sequence[tuple[Any, bool, list[str]]]) -> tuple[list[str], list[list[str]]]:
        """Return the name of each body's part, "" where all are in one, and its pins without those in its outline that others draw.

        A part is a block, or a layer where one block or none has all. Of layers that draw each pin once, fixed or not, all are its own.
        """
        within = [entity.source_block_reference for entity, _, _ in bodies]
        blocks = {id(each): each for each in within} if len({*within}) > 1 or (len(within) == 1 and within[0]) else {}
        parts = [drawn_part(entity, blocks) for entity, _, _ in bodies]
        owners = {key: {drawn_part(each, blocks) for each in circles} for key, circles in self.circles.items()}
        points, drawn = self.found.points, list[list[str]]()
        told = {points[key].fixed for key, each in owners.items() if blocks or len(each) > 1}
        for part, (entity, closed, keys) in zip(parts, bodies, strict=True):
            foreign = [key for key in keys if part not in owners[key] and points[key].fixed in told] if closed else []
            if len(keys) - len(foreign) < 2:
                foreign = []
            drawn.append([key for key in keys if key not in foreign])
            if foreign:
                where = part[1] or f"an outline of {drawn_on(entity)}"
                self.found.left_out.append(f"{' '.join(points[key].name for key in foreign)} within {where}, which draws no circle there")
        return ["" if len({*parts}) == 1 else name for _, name in parts], drawn

    def met(self, corners: Sequence[Place]) -> list[str]:
        """Return the pins that a line meets, or that a closed outline surrounds; a line may end at a pin's circle, too."""
        limit = MEETS * self.found.size
        closed = self.is_closed(corners)
        ends = [] if closed else [*corners[:1], *corners[-1:]]
        return [
            key
            for key, (place, radius) in self.pins.items()
            if any(distance_to(place, P, Q) <= max(limit, 0.5 * radius) for P, Q in pairwise(corners))
            or any(dist(place, end) <= radius + limit for end in ends)
            or (closed and surrounds(place, corners))
        ]

    def is_closed(self, corners: Sequence[Place]) -> bool:
        """Return whether a line ends where it begins, as an outline does."""
        return len(corners) > 3 and dist(corners[0], corners[-1]) <= MEETS * self.found.size

    def leave_out(self, entity: Any, kind: str, why: str) -> None:
        """Tell which line is left out and why, and where it ends off each pin."""
        corners = corners_of(entity)
        ends = dict.fromkeys([*corners[:1], *corners[-1:]])
        places = [f"({x:.6g}, {y:.6g})" for x, y in ends if not self.met([(x, y), (x, y)])]
        ends_off = f": no pin at {' and '.join(places)}" if places else ""
        self.found.left_out.append(f"{kind} of {drawn_on(entity)} {why}{ends_off}")

    def drive(self, role: str, P: str, Q: str) -> None:
        """Enter a drive between two pins; a crank turns about the fixed one, and brings its own link."""
        ends, fixed = (P, Q), [key for key in (P, Q) if self.found.points[key].fixed]
        if role == "crank":
            self.found.ensure(fixed, f"the crank {P} {Q} has no fixed pin; hatch one, or put it on the layer ground.")
            ends = (P, Q) if fixed[0] == P else (Q, P)
            if not any({P, Q} <= {*points} for _, points in self.found.links):
                self.found.add_link("", ends)
        self.found.drives.append(FoundDrive(role, ends))


def drawn_part(entity: Any, blocks: Mapping[int, Any]) -> tuple[int, str]:
    """Return the number and the name of the block of some that an entity stands in; where there are none, its layer's."""
    block = entity.source_block_reference
    if not blocks:
        return 0, str(entity.dxf.layer)
    while id(block) not in blocks and block is not None:
        block = block.source_block_reference
    return id(block), "" if block is None else str(block.dxf.name)


def drawn_on(entity: Any) -> str:
    """Return the layer that an entity is drawn on in words, or the block, where that is inserted on the layer of all that has none."""
    block, layer = entity.source_block_reference, str(entity.dxf.layer)
    return f"the block {block.dxf.name}" if block is not None and layer == "0" else f"the layer {layer}"


def corners_of(entity: Any) -> list[Place]:
    """Return the corners of a line, a polyline or a hatch, arcs by chords; a closed one ends where it begins. Others have none."""
    if entity.dxftype() == "LINE":
        return [(float(each.x), float(each.y)) for each in (entity.dxf.start, entity.dxf.end)]
    from ezdxf import path as curves
    from ezdxf.lldxf.const import DXFError

    try:
        borders = [*curves.from_hatch(entity)] if entity.dxftype() == "HATCH" else [curves.make_path(entity)]
    except (DXFError, ValueError, ArithmeticError):
        return []
    return [(float(each.x), float(each.y)) for border in borders for each in border.flattening(inf, CHORDS)]


def outlines(entities: Sequence[Any], gap: float) -> Iterator[tuple[list[Any], list[Place]]]:
    """Yield the closed outlines that lines and arcs make from end to end, across a gap: their entities, and their corners."""
    from ezdxf import edgeminer, edgesmith

    edges = [*edgesmith.edges_from_entities_2d(entities, gap_tol=gap)]
    for chain in edgeminer.find_all_simple_chains(edgeminer.Deposit(edges, gap_tol=gap)) if edges else ():
        if edgeminer.is_loop(chain, gap_tol=gap):
            corners = edgesmith.path2d_from_chain(chain).flattening(inf, CHORDS)
            yield [edge.payload for edge in chain], [(float(each.x), float(each.y)) for each in corners]


def way_to(entity: Any, word: str, place: tuple[float, float]) -> float:
    """Return how far a place lies from a text, however turned or mirrored: on its line or, of several lines, below its insertion."""
    has_lines = entity.dxftype() == "MTEXT"
    high = float(entity.dxf.char_height if has_lines else entity.dxf.height)
    from_there = (entity.ocs().from_wcs((*place, 0.0)) - entity.dxf.insert).rotate_deg(-entity.dxf.rotation)
    x, y = float(from_there.x), float(from_there.y) + (high if has_lines else 0.0)
    return dist((x, y), (min(max(x, 0.0), 0.7 * high * len(word)), min(max(y, 0.0), high)))


def distance_to(place: Place, P: Place, Q: Place) -> float:
    """Return the distance of a place from the line between two others, in their units."""
    (x, y), (px, py), (qx, qy) = place, P, Q
    base = (qx - px) ** 2 + (qy - py) ** 2
    along = 0.0 if base == 0.0 else min(1.0, max(0.0, ((x - px) * (qx - px) + (y - py) * (qy - py)) / base))
    return hypot(x - px - along * (qx - px), y - py - along * (qy - py))


def surrounds(place: Place, corners: Sequence[Place]) -> bool:
    """Return whether a place is inside a closed outline."""
    from ezdxf.math import Vec2, is_point_in_polygon_2d

    return bool(is_point_in_polygon_2d(Vec2(place), Vec2.list(corners)) > 0)
