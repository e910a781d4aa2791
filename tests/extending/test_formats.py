"""An exporter to MJCF and a back end to MATLAB's text, of a package that joins by entry points as one that pip installed."""

import math
import re
from itertools import pairwise
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import DefinitionError, Mechanism, drive_force, export, pin_force, ratio
from linkage.cli import main
from linkage.exports import Exporter, ExportJob
from linkage.program import TEMPLATES, Dialect, Language, ProgramText
from mechanisms.classics.slider_crank import SliderCrank
from mechanisms.three_point_hitch import ThreePointHitch


def words(numbers):
    return " ".join(f"{each:.12g}" for each in np.ravel(numbers))


class Mjcf(Exporter):
    """A planar model for MuJoCo at one pose: bodies as capsules in the plane z = 0, pins as connections, cylinders as slides."""

    suffix = ".mjcf"
    help = "a model for MuJoCo"
    of_machines = "a model is built from a machine's bodies and joints"

    def content(self, job: ExportJob) -> bytes:
        graph, motion = job.what.graph, job.motion
        at = {name: np.ravel(motion[name])[:2] for name in motion.plan.points}
        root = ET.Element("mujoco", model=motion.plan.title)
        ET.SubElement(root, "compiler", angle="radian")
        world, joined = ET.SubElement(root, "worldbody"), ET.SubElement(root, "equality")
        origins, elements = {"frame": np.zeros(2)}, {"frame": world}
        slides = {rod: (barrel, name) for barrel, rod, name, each in self.edges(graph) if each["kind"] == "slide"}
        for name, node in graph.nodes(data=True):
            if node["kind"] not in ("frame", "body", "barrel", "rod"):
                what = f"{motion.plan.title}: {name}: a {node['kind']} has no MJCF here"
                raise DefinitionError(f"{what}; export what has pins and cylinders.")
        for name in sorted(graph.nodes, key=lambda each: each in slides):  # a rod hangs on its barrel, which comes before it
            points = graph.nodes[name]["points"]
            if name != "frame":
                barrel, _ = slides.get(name, ("frame", ""))
                origins[name] = at[points[0]]
                place = words([*(origins[name] - origins[barrel]), 0.0])
                elements[name] = ET.SubElement(elements[barrel], "body", name=name, pos=place)
                if name in slides:
                    along = origins[name] - origins[barrel]
                    axis = words([*(along / np.hypot(*along)), 0.0])
                    ET.SubElement(elements[name], "joint", name=slides[name][1], type="slide", axis=axis)
                else:
                    for kind, axis in (("slide", "1 0 0"), ("slide", "0 1 0"), ("hinge", "0 0 1")):
                        ET.SubElement(elements[name], "joint", type=kind, axis=axis)
            for point in points:
                ET.SubElement(elements[name], "site", name=f"{name} {point}", pos=words([*(at[point] - origins[name]), 0.0]))
            for P, Q in pairwise(points):
                ends = words([*(at[P] - origins[name]), 0.0, *(at[Q] - origins[name]), 0.0])
                ET.SubElement(elements[name], "geom", name=f"{name} {P}{Q}", type="capsule", size="0.02", fromto=ends)
        for one, other, name, each in self.edges(graph):
            if each["kind"] == "pin":
                bodies = {"body1": one, **({"body2": other} if other != "frame" else {})}
                ET.SubElement(joined, "connect", name=f"{name} {other}", **bodies, anchor=words([*(at[name] - origins[one]), 0.0]))
        ET.indent(root)
        return ET.tostring(root)

    @staticmethod
    def edges(graph):
        """Yield the joints, the body that is not the frame first, a barrel before its rod."""
        for one, other, name, each in graph.edges(keys=True, data=True):
            turned = one == "frame" or (each["kind"] == "slide" and graph.nodes[one]["kind"] == "rod")
            yield (other, one, name, each) if turned else (one, other, name, each)


class Matlab(Language):
    """MATLAB: `function o = poses(d, p)` of row vectors; the outputs stand one below the other."""

    dialect = Dialect(
        {
            **TEMPLATES,
            **{name: f"{name}({{}})" for name in ("sqrt", "sin", "cos", "tan", "exp", "log")},
            "arctan2": "atan2({}, {})",
            "absolute": "abs({})",
            "power": "({})^({})",
            "sign": "sign({})",
            "minimum": "least({}, {})",
            "maximum": "-least(-({}), -({}))",
            "pick": "pick({}, {}, {}, {})",
        },
        lambda value: repr(value) if math.isfinite(value) else "NaN" if math.isnan(value) else f"{'-' if value < 0 else ''}Inf",
        "{} = {};",
    )
    words = (
        "break case catch classdef continue else elseif end for function global if otherwise parfor persistent return spmd switch try while"
    )

    def element(self, array: str, place: int) -> str:
        return f"{array}({place + 1})"

    def function(self, program: ProgramText) -> list[str]:
        return [
            f"function o = {program.name}(d, p)",
            f"% {program.comment}",
            *(f"  {line}" for line in program.design),
            *(f"  i{k} = p({k + 1});" for k in range(program.strokes)),
            *(f"  {line}" for line in program.lines),
            f"  o = [{'; '.join(program.outputs)}];",
            "end",
            "function c = least(a, b)",
            "  if a <= b || a ~= a, c = a; else, c = b; end",
            "end",
            "function c = pick(a, b, x, y)",
            "  if a <= b, c = x; else, c = y; end",
            "end",
        ]


KNOWN = {
    **{name: getattr(math, name) for name in ("sqrt", "sin", "cos", "tan", "exp", "log", "atan2")},
    "abs": abs,
    "sign": lambda a: (a > 0) - (a < 0),
    "least": lambda a, b: a if a <= b or a != a else b,
    "pick": lambda a, b, x, y: x if a <= b else y,
    "NaN": math.nan,
    "Inf": math.inf,
}


def interpreted(text, design, strokes):
    """Return what MATLAB's text gives: its assignments, read as the arithmetic they are."""
    lines = text.splitlines()
    assert re.fullmatch(r"function o = \w+\(d, p\)", lines[0])
    names = {**KNOWN, "d": lambda k: design[k - 1], "p": lambda k: strokes[k - 1]}
    for line in lines[2 : lines.index("end")]:
        name, _, right = line.strip().removesuffix(";").partition(" = ")
        assert re.fullmatch(r"\w+", name) and re.fullmatch(r"[\w.+\-*/^(), \[\];]+", right)
        names[name] = eval(right.replace("^", "**").replace(";", ","), {"__builtins__": {}}, names)
    return names["o"]


@pytest.fixture
def package(tmp_path, monkeypatch):
    """Install a package as pip does: a folder of metadata on the path."""
    info = tmp_path / "site" / "gales-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: gales\nVersion: 1.0\n", encoding="utf-8")
    lines = f"[hydrolinkage.exporters]\nmjcf = {__name__}:Mjcf\n[hydrolinkage.languages]\nmatlab = {__name__}:Matlab\n"
    (info / "entry_points.txt").write_text(lines, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path / "site")


def numbers(element, name):
    return np.array(list(map(float, element.get(name).split())))


def test_mjcf_holds_the_places_the_lengths_and_the_joints(package, tmp_path):
    hitch = ThreePointHitch()
    root = ET.parse(export(hitch, tmp_path / "hitch.mjcf", at={"S": 0.1})).getroot()
    motion, graph = hitch.at(S=0.1), hitch.graph
    assert root.tag == "mujoco" and root.get("model") == "ThreePointHitch"
    places = {}

    def walk(element, origin):
        for site in element.findall("site"):
            places[site.get("name")] = origin + numbers(site, "pos")
        for body in element.findall("body"):
            walk(body, origin + numbers(body, "pos"))

    walk(root.find("worldbody"), np.zeros(3))
    for name, node in graph.nodes(data=True):
        for point in node["points"]:
            assert_allclose(places[f"{name} {point}"], [*motion[point], 0.0], atol=1e-11)
    lengths = {geom.get("name"): np.hypot(*np.diff(numbers(geom, "fromto").reshape(2, 3)[:, :2], axis=0)[0]) for geom in root.iter("geom")}
    assert_allclose(lengths["EDF ED"], hitch["ED"], rtol=1e-10)
    assert_allclose(lengths["CD CD"], hitch["CD"], rtol=1e-10)
    joints = [(each.get("body1"), each.get("body2")) for each in root.iter("connect")]
    assert len(joints) == sum(each["kind"] == "pin" for *_, each in graph.edges(data=True))
    assert {one for one, other in joints if other is None} == {"lift barrel", "OBC", "EDF", "MK"}
    for each in root.iter("connect"):
        (body,) = [found for found in root.iter("body") if found.get("name") == each.get("body1")]
        assert numbers(each, "anchor").shape == (3,) and body is not None
    (slide,) = [each for each in root.iter("joint") if each.get("name") == "lift"]
    along = motion["B"] - motion["A"]
    assert_allclose(numbers(slide, "axis"), [*(along / np.hypot(*along)), 0.0], rtol=1e-9)


def test_what_it_cannot_write_is_told(package, tmp_path):
    with pytest.raises(DefinitionError, match="a block has no MJCF here"):
        export(SliderCrank(), tmp_path / "crank.mjcf")
    with pytest.raises(DefinitionError, match="a model is built from"):
        export(ThreePointHitch().sweep(3), tmp_path / "hitch.mjcf")


def test_the_command_writes_it(package, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["export", "mechanisms.three_point_hitch:ThreePointHitch", "-o", "lift.mjcf", "--at", "S=100mm"]) == 0
    assert capsys.readouterr().out == "lift.mjcf\n"
    hitch: Mechanism = ThreePointHitch()
    assert (tmp_path / "lift.mjcf").read_bytes() == export(hitch, tmp_path / "other.mjcf", at={"S": 0.1}).read_bytes()


def test_matlab_says_what_evaluate_says(package):
    hitch = ThreePointHitch()
    asked = ["G", ratio("G"), ratio("G", order=2), "tilt", drive_force(), pin_force("F")]
    text = hitch.source(asked, language="matlab", name="lift")
    stated = text[text.index("d: ") + 3 : text.index("; p: ")]
    design = [float(part.rpartition(" = ")[2]) for part in stated.split(", ")]
    for S in (0.0, 0.07, 0.2):
        assert_allclose(interpreted(text, design, [S]), hitch.function(asked)(S), rtol=1e-10, atol=1e-12)
    with pytest.raises(DefinitionError, match="name='spmd' has a meaning in matlab already"):
        hitch.source(["G"], language="matlab", name="spmd")
