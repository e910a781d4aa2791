"""Files of the program Linkage, .linkage2: read and written."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from io import StringIO
from math import cos, sin
from xml.etree.ElementTree import Element, ParseError, SubElement, indent, iterparse, tostring

from ..errors import FileError, ensure
from ..units import inch, mm
from .found import FoundDrive, FoundMachine
from .machine_sketch import MachineSketch, written

DEEPEST = 8
DOTS = 96.0
"""Units of a file in an inch."""
SHOWN = {"inches": inch / DOTS, "millimeters": 24.5 * mm / DOTS}
"""What 1 of a file is by the units it is shown in [m]: the program counts 24.5 mm to its inch, and so does who reads its numbers."""
DRAWING = 1
"""The layer of what is only drawn."""


def read_linkage_xml(found: FoundMachine, text: str) -> None:
    """Read connectors, links, slides between two connectors, inputs and actuators."""
    root = parsed_xml(found, text)
    found.ensure(root.tag == "linkage2", f"it begins with <{root.tag}>, and a file of Linkage with <linkage2>.")
    program = root.find("program")
    shown = "Millimeters" if program is None else program.get("units", "Millimeters")
    found.unit = SHOWN.get(shown.lower(), SHOWN["millimeters"])
    found.notes.append(f"1 of the file is {found.unit / mm:.6g} mm, as Linkage shows {shown.lower()}.")
    connectors = {each.get("id", ""): each for each in root.findall("connector") if not is_drawn(each)}
    for key, each in connectors.items():
        found.add_point(key, each.get("name") or f"P{key}", each.get("x", ""), each.get("y", ""), each.get("anchor") == "true")
    is_one = len(connectors) == sum(not is_drawn(each) for each in root.findall("connector"))
    found.ensure(is_one, "two connectors have one id; give each its own.")
    for each in (*root.findall("Link"), *root.findall("element")):
        if is_drawn(each):
            continue
        keys, name = [end.get("id", "") for end in each.findall("connector")], each.get("name") or f"L{each.get('id', '')}"
        if each.get("gear") == "true":
            found.left_out.append(f"the gear {name}")
        if each.get("actuator") == "true" and len(keys) == 2:
            P, Q = (found.known(key, f"the actuator {name}") for key in keys)
            throw = found.number(each.get("throw") or 0.0, f"the throw of {name}")
            found.drives.append(FoundDrive("cylinder", (P, Q), throw or None, each.get("name", "")))
        elif len(keys) > 1:  # Linkage also has links of one connector, an anchor by itself
            found.add_link(name, keys)
    for key, each in connectors.items():
        if each.get("slider") == "true":
            limits = [found.known(limit.get("id"), "a slide") for limit in each.findall("slidelimit")]
            is_curved = found.number(each.get("slideradius") or 0.0, "slideradius") != 0.0
            if is_curved or len(limits) != 2:
                what = "curved slot" if is_curved else "slide without two ends"
                found.left_out.append(f"the {what} of {found.points[key].name}")
            else:
                found.slides.append((key, (limits[0], limits[1])))
    for key, each in connectors.items():
        if each.get("input") == "true":
            found.turn(key, backwards=found.number(each.get("rpm") or 0.0, "rpm") < 0.0)
    for ratio in root.iter("ratio"):
        found.left_out.append(f"a ratio of {ratio.get('type') or 'gears'}")


def is_drawn(element: Element) -> bool:
    """Return whether an element is on the layer for drawings only."""
    return element.get("layer", "").isdigit() and int(element.get("layer", "")[:9]) == DRAWING


def parsed_xml(found: FoundMachine, text: str) -> Element:
    """Return the root of an XML text; FileError for entities, for too deep an one, and for other text."""
    has_types = "<!" in text.replace("<!--", "")
    found.ensure(not has_types, "it declares a document type or entities, which are not read; take that line out.")
    root: Element | None = None
    depth = 0
    try:
        for event, element in iterparse(StringIO(text), ("start", "end")):
            root = element if root is None else root
            depth += 1 if event == "start" else -1
            found.ensure(depth <= DEEPEST, f"elements stand more than {DEEPEST} deep in each other; a file of Linkage has 3.")
    except (ParseError, ValueError) as error:
        raise FileError(f"{found.file}: it is no XML: {error}.") from None
    found.ensure(root is not None, "it is empty.")
    assert root is not None
    return root


def linkage_xml(sketch: MachineSketch) -> str:
    """Return a sketch as a file of Linkage, in the millimetres that it shows; DefinitionError for what a file of it cannot say."""
    unit = SHOWN["millimeters"]
    root = Element("linkage2")
    SubElement(root, "program", zoom="1", xoffset="0", yoffset="0", scalefactor="1", units="Millimeters")
    points, links = dict(sketch.points), {name: [*points] for name, points in sketch.links.items()}
    fixed, slides = {*sketch.fixed}, dict[str, tuple[str, str]]()
    twice = next((point for point, count in Counter(each.point for each in sketch.slides.values()).items() if count > 1), None)
    ensure(twice is None, f"{sketch.name}: {twice} runs on two lines, and a connector of Linkage has one slide; give one a pin of its own.")
    for name, slide in sketch.slides.items():
        if isinstance(slide.along, tuple):
            slides[slide.point] = slide.along
            continue
        (x, y), slides[slide.point] = points[slide.point], (f"{name}_a", f"{name}_b")  # two anchors on its line
        for end, sign in zip(slides[slide.point], (-sketch.size, sketch.size), strict=True):
            points[end] = x + sign * cos(slide.along), y + sign * sin(slide.along)
            fixed.add(end)
    inputs = {drive.ends[0]: drive for drive in sketch.drives.values() if drive.kind == "crank"}
    is_one = len(inputs) == sum(drive.kind == "crank" for drive in sketch.drives.values())
    ensure(is_one, f"{sketch.name}: two cranks turn about one pin, which a file of Linkage cannot say.")
    ids = {name: str(number) for number, name in enumerate(points)}
    for name, (x, y) in points.items():
        given = {"id": ids[name], "name": name, "layer": "16", "x": written(x / unit), "y": written(y / unit)}
        given |= {"anchor": "true"} if name in fixed else {}
        given |= {"input": "true", "rpm": "-15" if inputs[name].end < inputs[name].drawn else "15"} if name in inputs else {}
        connector = SubElement(root, "connector", given | ({"slider": "true"} if name in slides else {}))
        for end in slides.get(name, ()):
            SubElement(connector, "slidelimit", id=ids[end])
    for number, (name, ends) in enumerate(links.items()):
        add_element(root, {"id": str(number), "name": name, "layer": "16"}, [ids[each] for each in ends])
    for number, (name, drive) in enumerate(sketch.drives.items(), len(links)):
        if drive.kind == "cylinder":
            what = f"{sketch.name}: Linkage draws the cylinder {name} where its stroke begins"
            ensure(drive.drawn == drive.start, f"{what}; take the sketch there, at {name}={drive.start:g}.")
            throw = {"actuator": "true", "throw": written((drive.end - drive.drawn) / unit), "cpm": "15"}
            add_element(root, {"id": str(number), "name": name, "layer": "16", **throw}, [ids[each] for each in drive.ends])
    indent(root, "\t")
    return tostring(root, encoding="unicode") + "\n"


def add_element(root: Element, given: dict[str, str], ids: Sequence[str]) -> None:
    """Add a link with its connectors."""
    link = SubElement(root, "Link", given)
    for each in ids:
        SubElement(link, "connector", id=each)
