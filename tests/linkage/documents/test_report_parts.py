"""What a checking engineer looks for: who signs, what stands where, what is assumed, what pins carry; and that nothing is cut."""

import re
import shutil
import subprocess
from collections import defaultdict
from dataclasses import replace
from functools import cache, partial
from itertools import combinations, pairwise
from xml.etree import ElementTree

import networkx as nx
import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text
from scipy.optimize import brentq

from hydraulics import Cylinder, LiftCircuit, OilLine, Pump, flow, power, thrust
from linkage import (
    RIGHT,
    Acting,
    Crank,
    DefinitionError,
    Dimension,
    Dyad,
    Force,
    Ground,
    LinkMass,
    LoadCase,
    Mechanism,
    OnLink,
    Over,
    Stroke,
    Weight,
    at,
    max_table,
    most,
    pin_forces,
    ramp,
    report,
)
from linkage.cli import main
from linkage.cli.listing import registered
from linkage.cli.machines import find
from linkage.documents import report_document
from linkage.documents.breaking import LONGEST, formula_pieces
from linkage.documents.calculation import calculated
from linkage.documents.checks import closed_walks
from linkage.documents.content import FIELDS, Equality, Illustration, Section, TableBlock, TitleBlock
from linkage.documents.forces import Stop, blocked_cylinders, body_words, worst_blocked
from linkage.documents.html import html_text
from linkage.documents.inputs import STANDARD, dimension_table, member_rows, plain_words
from linkage.documents.markdown import markdown
from linkage.documents.outcome import CURVE_ROOM, HALF, column_grids, curve_blocks, draw_column, in_two_lines
from linkage.documents.pdf import pdf
from linkage.documents.pictures import painted
from linkage.documents.reporting import NUMBER, cited_numbers, own_system, set_in_type, speaking
from linkage.documents.run import ReportSubject, without_unit
from linkage.formulas import equations
from linkage.formulas.typeset import Box, BoxRow, Fenced, Fraction, Script, Sign, boxes, mathml, rough_width
from linkage.motion import Column
from linkage.pictures.shown_values import typeset, unit_typeset
from linkage.reports.values import with_units
from linkage.statics import elements_of
from linkage.units import bar, deg, mm
from mechanisms.at_work.excavator import Excavator
from mechanisms.at_work.telehandler import Telehandler
from mechanisms.crane import Crane
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import first_daily, for_all
from tests.hydraulics.test_oil import OnOneBlock
from tests.linkage.pictures.test_page_in_time import Pumped, Sudden
from tests.linkage.statics.test_vehicle import Digger

needs_poppler = pytest.mark.skipif(shutil.which("pdftotext") is None, reason="poppler's pdftotext is not installed")


class Loader(Mechanism):
    """A lift arm, after (12) and (2.7) of its source.

    The force is that of (3a); 2 cylinders (of 80 mm) lift (since 2026) up to [see table 4] f(3).
    """

    S = Stroke(0.0, 0.25)
    A, O = Ground(0.20, 0.55), Ground(0.30, 1.15)
    B = Dyad(A, O, AB=0.5 + S, OB=0.30, side=RIGHT)  # of EN 1234-1
    G = OnLink(O, B, OG=0.90, BOG=0.35)
    load = Weight(G, mass=800)
    lift = Cylinder(A, B, bore=80 * mm, rod=45 * mm, count=2)
    pump = LiftCircuit(lift, pressure=180 * bar, relief=21e6, flow=5e-4, mechanical_efficiency=0.9)
    shock = LoadCase("with shock", scale={"load": 1.8})


class Bent(Mechanism):
    """A lever bent by an angle of the design, with a small coefficient."""

    phi = Stroke(0.0, 1.0)
    bend = Dimension(0.1, unit="deg")
    M = Dimension(1e5, unit="kNm")
    small = 2.95468e-07 * M
    O = Ground(0.0, 0.0)
    C = Crank(O, OC=0.5, angle=phi)
    D = OnLink(O, C, OD=0.4, COD=180 * deg + bend)


@cache
def shown(cls=Loader, language="en"):
    """Return a document in the system of units of the machine's own numbers, as `report` writes it."""
    machine = cls()
    with speaking(language, own_system(machine)):
        return report_document(machine, count=3)


def blocks(document, kind):
    return [block for section in document.sections for block in section.blocks if isinstance(block, kind)]


def texts(document):
    """Return all texts of a document."""
    found = blocks(document, str)
    for block in blocks(document, TableBlock):
        found += [cell for row in block.rows for cell in (block.caption, *row) if isinstance(cell, str)]
    found += [text for block in blocks(document, tuple) for text in block]
    return found + [block.caption for block in blocks(document, Illustration)]


# -- who signs ---------------------------------------------------------------------------------------------

FULL = {
    "number": "R-104", "revision": "B", "date": "2026-05-01", "client": "A <b> & C", "prepared": "N. N.", "checked": "M. M.",
    "approved": "K. K.",
}  # fmt: skip


@cache
def signed():
    """Return a report whose title block is filled."""
    return report_document(Loader(), count=3, block=TitleBlock(**FULL))


def markdown_of(document):
    return markdown(document, {id(each): "x" for each in blocks(document, Illustration)})


@first_daily(1, "write", [html_text, markdown_of])
def test_a_title_block_says_what_is_given_and_leaves_lines_for_the_rest(write):
    given = write(signed())
    for value in ("R-104", "2026-05-01", "N. N.", "M. M.", "K. K."):
        assert value in given.replace("\\", "")
    empty = write(shown())
    for name in ("report No.", "client", "prepared", "checked", "approved", "signature"):
        assert name in given and name in empty
    assert "<b>" not in given


@needs_poppler
def test_a_pdf_has_its_title_block_on_the_first_page_and_its_number_on_all():
    pages = words_of(signed())
    first = {text for text, *_ in pages[0]}
    assert {"R-104", "N.", "M.", "K.", "signature"} <= first
    feet = [[text for text, _, top, *_ in page if top > FOOT] for page in pages]
    assert feet == [
        ["R-104,", "revision", "B", "·", "Loader", "page", f"{number}", "of", f"{len(pages)}"] for number in range(1, len(pages) + 1)
    ]


@pytest.mark.parametrize("wrong", [{"number": 104}, {"client": "two\nlines"}, {"checked": None}])
def test_a_title_block_is_text(wrong, tmp_path):
    with pytest.raises(DefinitionError, match=next(iter(wrong))):
        report(Loader(), tmp_path / "a.md", **wrong)


@pytest.mark.slow
def test_the_command_has_the_title_block(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    options = [part for name, value in FULL.items() for part in (f"--{name}", value)]
    assert main(["report", "four_bar", "-o", "a.md", "--count", "3", *options]) == 0
    assert "| R\\-104 |" in (tmp_path / "a.md").read_text(encoding="utf-8") or "R-104" in (tmp_path / "a.md").read_text(encoding="utf-8")


# -- what stands where -------------------------------------------------------------------------------------


def test_results_come_before_inputs_and_inputs_before_equations():
    titles = [section.title for section in shown().sections]
    order = ["Sketch", "Verdicts", "Results", "Inputs", "Assumptions", "Standards used", "Calculation", "Forces in drives and pins"]
    assert [title for title in titles if title in order] == order


@for_all("machine", [Loader], slow=[MowerLift, ThreePointHitch])
def test_the_sketch_is_on_the_first_page_with_every_pin_by_name(machine):
    sketch = shown(machine).sections[0].blocks[0]
    figure = Figure(figsize=sketch.size)
    FigureCanvasAgg(figure)
    names = {each.get_text() for each in painted(figure, sketch).findobj(Text)}
    assert sketch.name == "sketch" and {*machine.plan.points} <= names


def test_assumptions_follow_the_machine():
    (assumed, left_open) = blocks(shown(), tuple)
    said = " ".join(assumed)
    for words in ("rigid", "planar", "quasi-static", "no friction", "Losses of pump", "2 × lift", "Only these have weight: load"):
        assert words in said
    assert "whether the machine tips over" in left_open


def test_standards_are_those_that_rules_and_inputs_cite():
    (grid,) = (block for block in blocks(shown(), TableBlock) if block.headings[0] == "standard")
    assert dict(grid.rows)["ISO 3320"] == "rule: standard size" and dict(grid.rows)["EN 1234-1"] == "source of B"
    names = ["ISO 3320", "Кодекс 2 ОЭСР", "OECD Code 2", "ГОСТ 6540-68"]
    assert STANDARD.findall("by {}, {}, ({}), {}.".format(*names)) == names


# -- one unit for one kind, no raw numbers, no numbers of others' equations --------------------------------


def test_no_number_stands_without_its_unit():
    (grid,) = (block for block in blocks(shown(), TableBlock) if block.caption.startswith("Loads, force"))
    rows = {row[0]: row[1] for row in grid.rows}
    assert "pressure=180 bar" in rows["pump"] and "relief=210 bar" in rows["pump"] and "flow=30 l/min" in rows["pump"]
    assert "bore=80 mm" in rows["lift"] and "mass=800 kg" in rows["load"]
    assert not [text for text in texts(shown()) if re.search(r"\d{7}\.0|\de[+-]?\d{2}\b", text) and "e-" not in text]


def test_a_number_in_an_expression_keeps_its_unit_to_itself():
    """`mass=0.55 * W` is no 0.55 kg; in a formula 2.9e-07 is a power of ten, and 180 deg stay degrees beside an angle."""
    plan = Loader().plan
    assert with_units(plan, "load", "Weight(G, mass=0.55 * W)") == "Weight(G, mass=0.55 * W)"
    assert with_units(plan, "load", "Weight(G, mass=2.5)") == "Weight(G, mass=2.5 kg)"
    listing = equations(Bent())
    assert "COD = bend + 180 deg" in str(listing) and r"2.95468 \cdot 10^{-7} M" in listing.latex()


@for_all(("note", "shown_as"), [
    ("cylinder stroke, m", "cylinder stroke"), ("m", ""), ("m, of the struts", "of the struts"), ("N/m2", "N/m2"),
    ("arm, from the boom", "arm, from the boom"),
])  # fmt: skip
def test_a_note_loses_the_unit_that_the_table_converts(note, shown_as):
    assert without_unit(note) == shown_as


def test_declared_numbers_have_seven_digits_and_a_part_says_each_once():
    machine = Telehandler(**{"forks.NW": 0.29})
    rows = {name: text for name, text, _ in member_rows(machine, machine.plan.members, {})}
    assert with_units(machine.plan, "ram", "Cylinder(A, B, closed=1.2850549999)") == "Cylinder(A, B, closed=1285.05 mm)"
    text = with_units(machine.plan, "outer", "LinkMass('O B', mass=700, at=(2.0, -0.015))")
    assert text == "LinkMass('O B', mass=700 kg, at=(2000, -15) mm)"
    assert rows["far"] == "LoadCase('far', scale={'forks.load': 0.3666667})"
    assert "NW=0.29" in rows["forks"] and "WN=" not in rows["forks"]
    assert [name for name, text in rows.items() if re.search(r"\d\.\d*[1-9]\d{7}", text)] == []


def test_marks_of_emphasis_are_no_words():
    assert plain_words("a *reduced* load `F`, N_2 D**2 and a * b * c") == "a reduced load F, N_2 D**2 and a * b * c"


def test_pins_say_what_bounds_them_where_no_relief_valve_is_declared():
    said = " ".join(texts(shown(MowerLift)))
    assert "Where no relief valve is declared, the pump's pressure is the highest." in said
    (grid,) = (each for each in blocks(shown(MowerLift), TableBlock) if "relief pressure" in each.caption)
    assert float(grid.rows[0][4]) == pytest.approx(155.0 * np.pi / 4 * 8.0**2, rel=1e-4)  # kgf/cm2 x cm2


def test_lengths_and_pressures_have_one_unit():
    for machine, other in ((Loader, r"\d (MPa|kgf/cm²|kgf/cm2|m)\b"), (MowerLift, r"\d (bar|MPa|m|kN)\b")):
        document = shown(machine)
        found = [text for section in document.sections if section.title not in ("Calculation", "Definition of the mechanism")
                 for block in section.blocks for text in texts_of(block) if re.search(other, text)]  # fmt: skip
        assert not found


def test_powers_of_units_are_raised_and_names_are_not():
    text = "(0.96 at 155 kgf/cm2, 9.81 m/s2), 3.5 cm2 of m2, SS2 and cm2"
    assert set_in_type(text) == "(0.96 at 155 kgf/cm², 9.81 m/s²), 3.5 cm² of m2, SS2 and cm2"
    for name in ("boom2", "m2", "tool.cm3"):
        assert typeset(name) == name
        assert typeset(f"thrust {name}, kgf/cm2: 3 m2") == f"thrust {name}, kgf/cm²: 3 m²"
    assert [unit_typeset(each) for each in ("m2", "kg m2", "N/mm2", "kgf_cm2")] == ["m²", "kg m²", "N/mm²", "kgf/cm²"]
    shown_texts = [each for each in texts(shown(MowerLift)) if "kgf/cm" in each]
    assert shown_texts and not [each for each in shown_texts if "kgf/cm2" in each]


def test_the_first_page_names_each_rule_and_limit_that_is_not_kept():
    facts = dict(shown(MowerLift).facts)
    assert facts["Not kept"] == "lifting; kz; pd" and facts["Verdicts"] == "7 of 8 rules kept, 2 limits are exceeded"


def texts_of(block):
    """Return the texts of a block that the report writes: not what the machine says of itself."""
    if isinstance(block, TableBlock):
        pairs = [pair for row in block.rows for pair in zip(row, block.headings, strict=True)]
        return [cell for cell, head in pairs if isinstance(cell, str) and "note" not in head]
    return [block.caption] if isinstance(block, Illustration) else []


def test_numbers_of_a_sources_equations_say_whose_they_are():
    document = shown()
    said = [text for text in texts(document) if "source, eq." in text]
    assert document.subtitle == "A lift arm, after [source, eq. 12] and [source, eq. 2.7] of its source."
    assert said == ["The force is that of [source, eq. 3a]; 2 cylinders (of 80 mm) lift (since 2026) up to [see table 4] f(3)."]
    assert cited_numbers("(2026), (0.5, 1), S(3)") == "(2026), (0.5, 1), S(3)"


@for_all("machine", [MowerLift], slow=[ThreePointHitch])
def test_no_number_of_a_sources_equation_stands_alone(machine):
    for section in shown(machine).sections:
        if section.title != "Definition of the mechanism":
            assert not [text for block in section.blocks for text in texts_of(block) if NUMBER.search(text)]


def test_no_curve_is_drawn_twice():
    """The mower's kz is its cylinder's reserve and pd its pressure, in another unit."""
    drawn = {each.name: each.caption for each in blocks(shown(MowerLift), Illustration)}
    assert "curve_kz" in drawn and "curve_reserve_lift" not in drawn and "The same curve: reserve lift." in drawn["curve_kz"]
    assert "curve_pd" in drawn and "curve_pressure_lift" not in drawn


# -- what pins carry ---------------------------------------------------------------------------------------


@pytest.mark.slow
def test_what_stands_still_is_said_once_and_inertia_has_its_unit(tmp_path):
    class Lever(Mechanism):
        phi = Stroke(0, 60 * deg)
        O = Ground(0, 0)
        L = Dimension(0.4)
        A = Crank(O, OA=L, angle=phi)
        half = 0.5 * L
        own = LinkMass("O A", mass=10, at=(0.2, 0.0), inertia=0.3)

    text = report(Lever(), tmp_path / "lever.md", count=3).read_text(encoding="utf-8")
    heads = [line for line in text.splitlines() if line.startswith("| phi, deg |")]
    assert heads and not [line for line in heads if "half" in line or line.count("|") < 4]
    assert "The same at all these poses: half 0.2000." in text and "inertia=0.3 kg m2" in text


@pytest.mark.parametrize("extra", [0, 1, 2])
def test_no_table_of_results_has_one_column(extra):
    motion = Loader().sweep(3)
    columns = [Column(f"{k} {'x' * 17}", np.arange(3.0), "", 0) for k in range(13 + extra)]
    blocks = [*column_grids(ReportSubject.of(Loader(), {}, 3), "Results", columns, [False] * motion.reached.size)]
    wide = [len(each.headings) - 1 for each in blocks]
    assert len(wide) > 1 < min(wide) and sum(wide) == 12 + extra


def test_a_long_heading_stands_in_two_lines():
    widths = [in_two_lines(each) for each in ("S, mm", "boom.A_x, mm", "thrust boom.ram, kN", "усилие на штоке ram, кН", "reserve")]
    assert widths == [5, 9, 12, 13, 7]


def test_every_load_case_has_its_pins():
    for case, title in (("plain", "own loads"), ("shock", "with shock")):
        (grid,) = (each for each in blocks(shown(), TableBlock) if each.caption.endswith(f"load case {title}"))
        rows = max_table(pin_forces(Loader().sweep(101), case=None if case == "plain" else case))
        shown_forces = {(row[0], row[2], row[3]): float(row[4]) for row in grid.rows}
        for each in rows:
            key = each.point, each.on.split(" ")[0], each.by.split(" ")[0]
            assert shown_forces[key] == pytest.approx(each.force / 1e3, rel=1e-3)


def test_at_the_relief_pressure_a_stop_takes_what_the_load_leaves():
    """Against the same by a force at G that is looked for until the cylinder has the relief valve's thrust."""
    machine = Loader()
    subject = ReportSubject.of(machine, {}, 5)
    held = blocked_cylinders(subject)
    piston, annulus = 2 * np.pi / 4 * 0.08**2, 2 * np.pi / 4 * (0.08**2 - 0.045**2)
    assert held["lift"] == pytest.approx((0.0, 21e6 * piston), rel=1e-12)  # its rod side is on no pressure
    both = type("Both", (Loader,), {"lift": replace(Loader.lift, works="both")})
    assert blocked_cylinders(ReportSubject.of(both(), {}, 5))["lift"] == pytest.approx((-21e6 * annulus, 21e6 * piston), rel=1e-12)
    own = [element for _, element in elements_of(machine.plan, None)]
    for row in worst_blocked(subject, "G", held):
        motion = machine.at(**row.strokes)
        way = motion.ratio("G") / np.hypot(*motion.ratio("G"))
        target = held["lift"][1 if row.pushes else 0]

        def carried(force, motion=motion, way=way):
            return pin_forces(motion, loads=[*own, Force("G", tuple(float(each) for each in force * way))])

        def over(force, carried=carried, target=target):
            return float(carried(force).thrusts["lift"]) - target

        at = carried(brentq(over, -1e6, 1e6, xtol=1e-6))
        joint = next(each for each in at.joints if (each.point, each.kind) == row.cells[:2] and each.on.startswith(row.cells[2][:4]))
        assert float(joint.size) == pytest.approx(row.force, rel=1e-7)
    assert {(row.cylinder, row.pushes) for row in worst_blocked(subject, "G", held)} == {("lift", True)}


def test_where_the_load_alone_opens_the_valve_no_force_against_a_stop_is_told():
    own = Loader().sweep(101)
    thrusts = [pin_forces(own, case=case).thrusts["lift"] for case in (None, "with shock")]
    low, high = min(map(np.min, thrusts)), max(map(np.max, thrusts))
    relief = 0.5 * (low + high) / (2 * np.pi / 4 * 0.08**2)
    subject = ReportSubject.of(Loader(**{"pump.relief": relief, "pump.pressure": 0.9 * relief}), {}, 5)
    held = blocked_cylinders(subject)
    rows = worst_blocked(subject, "G", held)
    (pin,) = (row for row in rows if row.cells[0] == "A")  # of the cylinder's foot, which has its thrust alone
    assert rows and pin.force <= held["lift"][1] * (1.0 + 1e-6) < high


def test_a_stop_pushes_until_the_first_relief_valve_opens():
    """No cylinder of the crane carries more than its valve lets through, and one of them carries just that."""
    subject = ReportSubject.of(Crane(), {}, 5)
    motion = subject.judge.places[0].sampled
    stop = Stop.of(motion.moved(motion.strokes), "T", blocked_cylinders(subject), Acting())
    assert set(stop.bounds) == {"extend", "lift", "fold"}
    for cylinder in stop.bounds:
        for pushes in (True, False):
            force, way, opens = stop.until_open(cylinder, pushes)
            used = {}
            for name, (low, high) in stop.bounds.items():
                thrust = stop.own.thrusts[name] + force * sum(w * each.thrusts[name] for w, each in zip(way, stop.units, strict=True))
                used[name] = np.where(thrust > 0.0, thrust / high, thrust / low)
            known = np.isfinite(force) & (force > 0.0)
            assert known.any() and max(each[known].max() for each in used.values()) <= 1.0 + 1e-9
            assert np.allclose([used[name][place] for place, name in zip(np.flatnonzero(known), opens[known], strict=True)], 1.0)


# -- nothing is cut ----------------------------------------------------------------------------------------


def random_formula(draw, depth):
    """Return a formula of nested sums, fractions and functions."""
    kind = draw.integers(0, 6 if depth else 1)
    if kind == 0:
        return Sign("number", str(draw.integers(1, 10**6)))
    if kind == 1:
        return Sign("variable", "x")
    if kind == 2:
        return Fraction(random_formula(draw, depth - 1), random_formula(draw, depth - 1))
    if kind == 3:
        return BoxRow((Sign("name", "cos"), Fenced("(", random_formula(draw, depth - 1), ")")))
    if kind == 4:
        return Script(Fenced("(", random_formula(draw, depth - 1), ")"), None, Sign("number", "2"))
    signs = [Sign("operator", text) for text in draw.choice([*"+−·,"], 6)]
    parts = [part for sign in signs for part in (random_formula(draw, depth - 1), sign)]
    return BoxRow(tuple(parts[:-1]))


def letters(box: Box) -> str:
    """Return what is set of a formula, as text, without the signs that a quotient in one line takes."""
    return re.sub(r"<[^>]*>", "", mathml(box)).translate(str.maketrans("", "", "()/ "))


@for_all("seed", range(2), slow=range(2, 30))
def test_a_formula_of_any_kind_breaks_into_pieces_that_fit_and_loses_nothing(seed):
    draw = np.random.default_rng(seed)
    box = random_formula(draw, 4)
    found = formula_pieces(box, 14.0)
    assert all(rough_width(each) <= 14.0 for each in found)
    assert sorted("".join(map(letters, found))) == sorted(letters(box))


def test_what_fits_is_not_broken():
    box = boxes(r"\frac{a + b}{c} \cdot \cos\left(x\right)")
    assert formula_pieces(box, LONGEST) == [box]


LEFT, RIGHT_EDGE, FOOT, BELOW = 57.0, 595.276 - 42.0, 841.89 - 50.0, 841.89 - 20.0
"""The margins of a page, and where its foot begins and ends [points]."""


def words_of(document):
    """Return the words of a report as PDF, page by page, each with its box (left, top, right, bottom) [points]."""
    with speaking(document.language, None):
        content = pdf(document)
    found = subprocess.run(["pdftotext", "-bbox", "-", "-"], input=content, check=True, capture_output=True)
    pages = ElementTree.fromstring(found.stdout).iter("{http://www.w3.org/1999/xhtml}page")
    return [[(each.text, *(float(each.get(edge)) for edge in ("xMin", "yMin", "xMax", "yMax"))) for each in page] for page in pages]


def cut_in(cls, language):
    """Return the texts that are cut in a machine's report as PDF, on its pages and in the pictures on them, or that cover others."""
    with speaking(language, own_system(cls())):
        document = shown(cls, language)
        pages = words_of(document)
        drawn = [block for section in document.sections for block in section.blocks if isinstance(block, Illustration)]
        pictures = [(picture.name, text) for picture in drawn for text in beyond_the_picture(picture)]
    return [*(each for page in pages for each in (*beyond_the_margins(page), *covering_texts(page))), *pictures]


def beyond_the_margins(page):
    """Return the words of a page that lie beyond its margins."""
    return [text for text, left, top, right, foot in page if left < LEFT - 1.0 or right > RIGHT_EDGE + 1.0 or top < 36.0 or foot > BELOW]


def covering_texts(page):
    """Return the pairs of words of a page that stand on one line, and on each other."""
    page = [each for each in page if "\u20d7" not in each[0]]  # arrows over what is between them
    left, top, right, foot = np.array([box for _, *box in page]).T
    across = np.minimum(right, right[:, None]) - np.maximum(left, left[:, None])
    in_line = (np.abs(top - top[:, None]) < 0.1) & (np.abs(foot - foot[:, None]) < 0.1)
    return [(page[one][0], page[other][0]) for one, other in np.argwhere(np.triu(in_line & (across > 1.0), 1))]


def beyond_the_picture(picture):
    """Return the texts of a picture that its edges cut."""
    figure = Figure(figsize=picture.size, dpi=72)
    canvas = FigureCanvasAgg(figure)
    painted(figure, picture)
    renderer, drawn = canvas.get_renderer(), []
    draw_text = renderer.draw_text

    def recorded(gc, x, y, text, prop, angle, ismath=False, mtext=None):
        drawn.append(mtext)
        draw_text(gc, x, y, text, prop, angle, ismath=ismath, mtext=mtext)

    renderer.draw_text = recorded  # what is drawn, not ticks that lie outside
    figure.draw(renderer)
    boxes_drawn = [(each.get_text(), each.get_window_extent(renderer)) for each in drawn if each is not None and each.get_text().strip()]
    assert boxes_drawn
    wide, high = figure.bbox.width, figure.bbox.height
    return [text for text, box in boxes_drawn if min(box.x0, box.y0, wide - box.x1, high - box.y1) < -1.0]


@pytest.mark.slow
@needs_poppler
@pytest.mark.parametrize("name", sorted(registered()))
@pytest.mark.parametrize("language", ["en", "ru"])
def test_nothing_is_cut_at_the_papers_edge(name, language):
    assert not cut_in(find(name), language)


def test_what_is_cut_is_found():
    """The readers of edges see a text beyond the margin, one on another, and one that a picture's edge cuts."""
    inside = ("inside", LEFT, 100.0, LEFT + 30.0, 110.0)
    page = [("beyond", 540.0, 100.0, 560.0, 110.0), ("below", LEFT, 820.0, LEFT + 30.0, 830.0), inside]
    assert beyond_the_margins(page) == ["beyond", "below"]
    on_it = ("on it", LEFT + 5.0, 100.0, LEFT + 40.0, 110.0)
    assert covering_texts([inside, on_it]) == [("inside", "on it")] and not covering_texts([inside])
    heading = "a heading that is much too long for it"
    picture = Illustration("cut", "", (2.0, 2.0), (0.1, 0.1, 0.1, 0.1), lambda ax: ax.set_title(heading))
    assert heading in beyond_the_picture(picture)


def test_a_long_heading_of_a_curve_fits_its_picture():
    column = Column("усилие на штоке crane.extend_right", np.linspace(-4.6, -4.0, 11), "kN")
    size, room = (HALF, 2.15), CURVE_ROOM
    paint = partial(draw_column, motion=Loader().sweep(11), column=column, bound=None, beyond=())
    assert not beyond_the_picture(Illustration("curve", "", size, room, paint))


@pytest.mark.slow
@needs_poppler
def test_no_text_of_a_title_block_is_lost():
    long = {name: f"{name} " + "Forestry and Construction Machines of the North " * 3 for name in FIELDS}
    page = words_of(replace(shown(), block=TitleBlock(**long)))[0]
    put = [text for text, *_ in page]
    assert all(put.count(word) >= len(long) * 3 for word in ("Forestry", "Machines", "North"))
    assert not beyond_the_margins(page) and not covering_texts(page)


@pytest.mark.slow
@needs_poppler
def test_a_long_word_breaks_inside_the_margins():
    word = "Hydraulikzylinderkolbenstangenfuehrungsbuchse" * 4
    page = words_of(replace(shown(), title=word, block=TitleBlock(number=word, client=word, prepared=word)))[0]
    assert "".join(text for text, *_ in page).count("Kolbenstange".lower()) >= 12 and not beyond_the_margins(page)


@needs_poppler
def test_a_long_formula_breaks_inside_the_margins():
    """Behind its commas, and in front of the stroke of a quotient in one line: signs at which Typst breaks none."""
    listed, term = ", ".join([r"\overrightarrow{AB}^{\mathrm{crane}}"] * 40), r" \cdot ".join([r"L_{AB}^{\mathrm{crane}}"] * 19)
    steps = "x", rf"\operatorname{{TurnV}}\left({listed}\right)", rf"\frac{{{term}}}{{{term}}}", "1"
    pages = words_of(replace(shown(), sections=(Section("Notes", (Equality(1, steps),)),)))
    assert sum(word.count("crane") for page in pages for word, *_ in page) == 78 and not any(map(beyond_the_margins, pages))


@needs_poppler
def test_no_row_of_a_table_is_lost_below_its_page():
    """A table of few rows stands on one page; one that is higher than a page goes on."""
    for words, wanted in ((20, 1), (180, 2)):
        rows = tuple((f"row{number}", " ".join(["text"] * words)) for number in range(14))
        pages = words_of(replace(shown(), sections=(Section("Notes", (TableBlock("Notes", ("name", "note"), rows, "lm"),)),)))
        put = [word for page in pages for word, *_ in page]
        assert put.count("text") == 14 * words and {name for name, _ in rows} <= {*put}
        assert len([page for page in pages if any(word == "text" for word, *_ in page)]) == wanted
        assert not any(map(beyond_the_margins, pages))


def test_bodies_go_by_the_names_of_their_links():
    plan = Excavator.plan
    (stick,) = [body for body in plan.links if "arm.F" in body]
    assert [body_words(plan, name) for name in (stick.name, "boom.ram", "frame V")] == ["arm.stick", "boom.ram", "frame"]
    assert Pumped.plan.link_names == {}
    names = ["frame", "frame.OBT", "frame.ram"]  # of a part that is called frame
    assert [body_words(plan, name) for name in names] == names


def test_walks_are_closed_and_as_many_as_there_are_loops():
    rng = np.random.default_rng(3)
    for count in (4, 9, 20):
        pairs = [pair for pair in combinations(map(str, range(count)), 2) if rng.random() < 3.0 / count]
        walks = [[frozenset(side) for side in pairwise([*walk, walk[0]])] for walk in closed_walks(pairs)]
        graph = nx.Graph(pairs)
        assert len(walks) == len(pairs) - len(graph) + nx.number_connected_components(graph)
        assert all(len({*walk}) == len(walk) >= 3 and {*walk} <= {*map(frozenset, pairs)} for walk in walks)
    (long,) = closed_walks((str(k), str((k + 1) % 600)) for k in range(600))
    assert len(long) == 600


def test_a_curve_over_time_says_what_is_held():
    class Two(Mechanism):
        S, U = Stroke(0.3, 0.5), Stroke(0.0, 0.1)
        O, A = Ground(0.0, 0.0), Ground(0.35, -0.1)
        B = Dyad(O, A, OB=0.3 + U, AB=S, side=RIGHT)
        rise = Over.path(S=ramp(0.32, 0.48, speed=0.1), U=0.05)

    subject = ReportSubject.of(Two(), {}, 3)
    (curve,) = curve_blocks(subject, *subject.curves[0], ["B_y"], "B_y", {})
    assert curve.caption.startswith("B_y, m over time; held: U = 50 mm, over rise.")


def test_a_report_says_how_a_machine_runs(tmp_path):
    machine = Pumped()
    report(machine, tmp_path / "rise.md", count=5)
    text = (tmp_path / "rise.md").read_text(encoding="utf-8")
    section = text.partition(" As it runs")[2].partition("\n## ")[0]
    heads = [line for line in section.splitlines() if line.startswith("| time, s")]
    assert heads[0].startswith("| time, s | S, mm | rate S, mm/s | acceleration S") and "power lift, kW | flow pump, l/min" in heads[1]
    motion = machine.sweep(5, over="rise")
    rows = [[float(cell) for cell in line.strip("| ").split(" | ")] for line in section.partition(heads[1])[2].splitlines()[2:7]]
    for place, asked, unit in ((2, power("lift", case="full"), 1e3), (3, flow("pump"), 1e-3 / 60.0)):
        assert [row[place] for row in rows] == pytest.approx(motion[asked] / unit, abs=6e-3)
    quick, slow = (motion[thrust("lift", acting=Acting(case="full", inertia=inertia))][0] for inertia in (None, False))
    (row,) = [line for line in section.splitlines() if line.startswith("| thrust |")]
    assert f"{quick / 1e3:.4g} kN" in row and f"{slow / 1e3:.4g} kN" in row and f"| {quick / slow:.3g} |" in row
    middle = machine.sweep(3, over="rise")[thrust("lift", acting=Acting(case="full", inertia=False))][1]  # the equations' pose and case
    equations_said = text.partition(" Calculation\n")[2].partition("\n## ")[0]
    assert "over rise, in the case full" in equations_said and "They are those of slow motion" in equations_said
    assert f"{{{middle:.6g}}}" in equations_said


@pytest.mark.slow
def test_a_rate_that_jumps_counts_no_inertia_and_a_box_is_in_no_time(tmp_path):
    report(Sudden(), tmp_path / "sudden.md", count=3)
    assert "No inertia is counted, over rise, in the case full: the rate of S jumps" in (tmp_path / "sudden.md").read_text(encoding="utf-8")
    assert " As it runs" not in (report(Pumped(), tmp_path / "box.md", over=Pumped.plan.members["box"])).read_text(encoding="utf-8")


def test_a_reserve_without_a_thrust_is_endless_in_the_equations_too():
    unloaded = type("Unloaded", (Loader,), {"empty": LoadCase("empty", scale={"load": 0.0})})
    (line,) = [each for each in calculated(unloaded(), {"S": 0.1}, 1, "empty").lines if each.symbol.startswith(r"\mathit{kz}")]
    assert line.results == (r"\infty",)


def test_an_equal_thrust_is_no_second_column_and_a_frame_on_axles_has_no_given_forces():
    text = markdown(report_document(OnOneBlock()), defaultdict(str))
    assert "Thrust right is thrust left" in text and "thrust left, kN" in text and "thrust right, kN |" not in text
    names = [name for name, *_ in dimension_table(Digger(), equations(Digger()), {}).rows]
    assert "front.friction" in names and "front.force" not in names


class Syringe(Mechanism):
    """A desk model: its loads are newtons, its oil millilitres, and the load drives its one cylinder all the way."""

    S = Stroke(90 * mm, 140 * mm)
    A, O = Ground(0.0, 40 * mm), Ground(60 * mm, 40 * mm)
    B = Dyad(O, A, OB=90 * mm, AB=S, side=RIGHT)
    G = OnLink(O, B, OG=180 * mm, BOG=-30 * deg)
    load = Weight(G, mass=0.2)
    ram = Cylinder(A, B, bore=15.9 * mm, rod=6 * mm)
    line = OilLine(ram.piston_side, Pump(2 * bar))


def test_a_desk_model_has_figures_and_no_curve_without_a_value():
    machine = Syringe()
    text = markdown(report_document(machine, count=3), defaultdict(str))
    least, most = machine.at(S=[90 * mm, 140 * mm])[thrust("ram")] / 1e3
    assert f"{least:.4g}" in text and f"{most:.4g}" in text
    assert "0.00993 l from end to end" in text and "At its longest, 140 mm" in text
    assert "thrust, kN along S" in text and "Without a value at all these poses: reserve." in text and "reserve, % along" not in text
    forces = {row.cells[0]: row.cells[4] for row in max_table(machine)}
    assert forces["A"] == f"{-most:.3g}" and float(forces["O"]) > 0.0


class TwoCases(Pumped):
    """Over its path in time its own loads and a heavier load case occur."""

    rise = Over.path(S=ramp(0.32, 0.48, speed=0.2, acceleration=1.0), cases=["plain", "full"])


def test_what_inertia_adds_is_told_of_one_load_case(tmp_path):
    machine = TwoCases()
    text = report(machine, tmp_path / "two.md").read_text()
    row = re.search(r"\| (?:drive force|thrust)[^|]*\| ([\d.]+) kN \| ([^|]*) \| ([\d.]+) kN \| ([\d.]+) \|", text)
    (worst,) = machine.answers([most(abs(thrust("lift")))])
    (slow,) = machine.answers([at(abs(thrust("lift", acting=Acting(case=worst.case, inertia=False))), **worst.strokes)])
    assert worst.case == "full" and "full" in row[2]
    assert float(row[1]) == pytest.approx(worst.value / 1000.0, rel=1e-3) and float(row[3]) == pytest.approx(slow.value / 1000.0, rel=1e-3)
    assert float(row[4]) == pytest.approx(worst.value / slow.value, rel=6e-3)
    assert "Greatest forces with inertia, over rise*" in text
