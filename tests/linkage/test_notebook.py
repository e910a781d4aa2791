"""What a notebook shows of machines, motions and results: well-formed HTML with their names and numbers, nothing that runs by itself."""

import pickle
import re
from html import unescape
from io import BytesIO
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.image import imread

from linkage import (
    LEFT,
    Crank,
    Dyad,
    Ground,
    Mechanism,
    OnLink,
    Stroke,
    Verdict,
    Weight,
    draw,
    equations,
    least,
    optimise,
    pin_forces,
    plot,
    y,
)
from linkage.notebook import live
from linkage.study import survey
from mechanisms.at_work.excavator import Excavator
from mechanisms.three_point_hitch import ThreePointHitch


class Marked(Mechanism):
    """A rocker whose sentences hold signs of markup."""

    phi = Stroke(0.2, 1.2)
    O, C = Ground(0.0, 0.0), Ground(0.10, 0.0)
    A = Crank(O, angle=phi, OA=0.03)
    B = Dyad(A, C, AB=0.10, CB=0.06, side=LEFT)
    T = OnLink(C, B, CT=0.09)
    load = Weight(T, mass=3.0)

    def rules(self, motion):
        return [Verdict("size", True, "it is <b>small</b> & light."), "neither <i>passes</i> nor fails"]


MACHINE = Marked()
MOTION = MACHINE.sweep(21)


def html(what):
    """Return what a notebook shows, after a look at whether it is well-formed and holds no script."""
    text = what._repr_html_()
    ElementTree.fromstring(f"<div>{re.sub(r'<!--.*?-->', '', text, flags=re.DOTALL)}</div>")
    assert "<script" not in text
    return text


def cells(text):
    """Return the rows of the tables in HTML, headings first."""
    return [[unescape(cell) for cell in re.findall(r"<t[hd]>(.*?)</t[hd]>", row)] for row in re.findall(r"<tr>(.*?)</tr>", text)]


def test_a_plan_and_a_chain_are_shown_as_tables_under_the_names_of_a_fitter():
    plan = MACHINE.plan
    assert dict(row for row in cells(html(plan)) if row[0] != "name") == dict(line.split(" = ", 1) for line in str(plan).splitlines())
    graph = Excavator().graph
    listed = cells(html(pickle.loads(pickle.dumps(graph))))
    rows = {row[0]: row[1:] for row in listed}
    assert rows["tool.ram barrel"] == ["barrel", "arm.G"] and rows["tool.ram"] == ["slide", "tool.ram barrel", "tool.ram rod", "curl"]
    assert len(listed) == len(graph) + graph.number_of_edges() + 2 and not any("_" in name for name in rows)


def test_one_pose_says_what_is_out_of_bounds_there():
    kept, short = (html(ThreePointHitch(**given).at(S=0.1)) for given in ({}, {"circuit.pressure": 20e5}))
    assert "At this pose: all kept" in kept and "At this pose: lifting 0.5121" in short
    assert "At this pose" not in html(ThreePointHitch().sweep(3))


def test_a_machine_shows_its_drawing_and_its_dimensions():
    text = html(Marked(AB=0.1035, CB=0.0625))
    rows = dict(row for row in cells(text) if len(row) == 2)
    assert rows["AB"] == "103.5 mm" and rows["phi"].endswith("deg")
    assert set(rows) >= {"phi", *MACHINE.dimensions}
    drawn = text[text.index("<svg") : text.index("</svg>")]
    letters, axes = len(re.findall(r'id="text_', drawn)), drawn.count("<text")
    assert letters - axes >= 5 + 3  # drawn as lines: the names of five points, three lengths at least


def test_a_batch_of_designs_says_what_it_is():
    assert "Marked(OA=array" in unescape(html(Marked(OA=np.array([0.02, 0.03]))))
    assert "Marked" in html(Marked(OA=np.array([0.02, 0.03])).sweep(3))


def test_a_machine_out_of_reach_says_why():
    assert "cannot be assembled" in html(Marked(AB=0.01))


def test_a_motion_is_a_table_over_its_poses():
    head, *rows = cells(html(MOTION))
    assert head[0].startswith("phi") and len(rows) == 11
    place = head.index("B_y, m")
    assert [float(row[place]) for row in rows] == pytest.approx(MOTION.y("B")[::2], abs=5e-5)


def test_limits_verdicts_and_modes_are_shown():
    assert "transmission angle" in html(MOTION.limits())
    text = html(MACHINE.verdicts(MOTION))
    assert "&lt;b&gt;small&lt;/b&gt; &amp; light" in text and "&lt;i&gt;passes" in text
    assert "#1a7f37" in text and "#c62828" in html(Verdict("size", False, "no."))
    modes = html(MACHINE.assemblies())
    assert modes.count("<svg") == 1 and "side=RIGHT" in modes
    assert html(MACHINE.assemblies()[0]).count("<svg") == 1


def test_pin_forces_are_their_worst():
    forces = pin_forces(MOTION)
    rows = cells(html(forces))
    at_t = next(row for row in rows if row[0] == "C")
    assert float(at_t[4]) == pytest.approx(np.hypot(*forces.force("C", on="CBT")).max() / 1e3, rel=0.02)


@pytest.mark.slow
def test_studies_are_shown():
    found = survey(MACHINE, {"AB": np.linspace(0.09, 0.11, 5)}, top)
    assert next(row for row in cells(html(found)) if row[0] == "top")[4] == "5"
    best = optimise(MACHINE, maximise=least(y("B")), vary={"AB": (0.09, 0.11)}, starts=1)
    assert html(best).count("<svg") == 1


def top(machine):
    """Return the greatest height of the joint of some designs."""
    return {"top": machine.evaluate(["B"], phi=np.linspace(0.2, 1.2, 5))[0][1].max(axis=-1)}


def test_equations_are_set_by_the_browser():
    written = equations(MACHINE)
    assert html(written).count("<math") >= len(written) and "\\" not in html(written)


def test_a_live_page_has_no_access_to_the_notebook():
    text = live(MACHINE, height=500)._repr_html_()
    assert text.startswith('<iframe sandbox="allow-scripts" ') and "height:500px" in text
    assert text.count("<") == 2 and "<script" in unescape(text)


@pytest.mark.parametrize("figure", [lambda: draw(MACHINE), lambda: plot(MOTION, ["B_y"])])
def test_a_figure_shows_itself(figure):
    picture, size = figure()._repr_png_()
    high, wide, _ = imread(BytesIO(picture)).shape
    assert (wide, high) == pytest.approx((2 * size["width"], 2 * size["height"]), abs=2)
