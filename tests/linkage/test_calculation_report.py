"""Reports of calculations: each kind of file opened, and what is in it compared with what Python says."""

import re
import shutil
import subprocess
import sys
from html import unescape
from xml.etree import ElementTree

import numpy as np
import pytest

from hydraulics import Cylinder, LiftCircuit
from linkage import (
    RIGHT,
    Crank,
    DefinitionError,
    Dyad,
    FileError,
    Ground,
    LoadCase,
    Mechanism,
    OnLink,
    SingularError,
    Stroke,
    Weight,
    deg,
    equations,
    max_table,
    pin_forces,
    report,
)
from linkage.documents import report_document
from linkage.documents.content import Equality, Illustration, TableBlock
from linkage.documents.fingerprint import fingerprint
from linkage.documents.html import html_text
from linkage.documents.markdown import markdown
from linkage.documents.pdf import pdf
from linkage.documents.run import Looked
from linkage.formulas.mathml import mathml
from linkage.formulas.typeset import BoxRow, Fraction, Script, boxes, breakable
from linkage.language import language
from linkage.motion import Column
from linkage.reports import results, run_of
from linkage.units import bar, mm
from mechanisms.classics.jansen import Jansen
from mechanisms.classics.scotch_yoke import ScotchYoke
from mechanisms.classics.stephenson_three import StephensonThreeFar
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch

X = "{http://www.w3.org/1999/xhtml}"
M = "{http://www.w3.org/1998/Math/MathML}"


class Lifter(Mechanism):
    """Cylinder AB lifts the arm OB.

    A second paragraph with <signs> & *marks*.
    """

    S = Stroke(0.0, 0.1)
    A = Ground(0.0, 0.0)
    O = Ground(0.1, 0.5)  # measured at the frame
    B = Dyad(A, O, AB=0.5 + S, OB=0.4, side=RIGHT)
    load = Weight(B, mass=100.0)  # from the data sheet
    double = LoadCase("twice", scale={"load": 2.0})


class Sloped(Mechanism):
    """Two strokes."""

    S, T = Stroke(0.0, 0.1), Stroke(0.0, 0.05)
    A = Ground(0.0, 0.0)
    O = Ground(0.1, 0.5)
    B = Dyad(A, O, AB=0.5 + S, OB=0.4 + T, side=RIGHT)


@pytest.fixture(scope="module")
def hitch():
    return report_document(ThreePointHitch(), title_block={"Checked by": "N. N."})


@pytest.fixture(scope="module")
def page(hitch):
    return html_text(hitch)


def grids(document, *headings):
    """Return the tables of a document with some headings."""
    blocks = [block for section in document.sections for block in section.blocks if isinstance(block, TableBlock)]
    return [block for block in blocks if set(headings) <= set(block.headings)]


def test_a_page_is_well_formed_and_needs_nothing_else(page):
    tree = ElementTree.fromstring(page.removeprefix("<!DOCTYPE html>"))
    assert not list(tree.iter(f"{X}script")) and not list(tree.iter(f"{X}link"))
    policy = next(each.get("content") for each in tree.iter(f"{X}meta") if each.get("http-equiv"))
    assert policy.startswith("default-src 'none'; style-src 'sha256-") and "unsafe" not in policy
    assert all(each.get("src").startswith("data:image/svg+xml;base64,") and each.get("alt") for each in tree.iter(f"{X}img"))
    assert not re.search(r"""(src|href)="(?!data:|#)""", page) and " style=" not in page


def test_the_title_block_says_what_was_calculated(page, hitch):
    facts = dict(hitch.facts)
    assert facts["Checked by"] == "N. N." and facts["Verdicts"] == "13 of 13 rules kept"
    assert facts["Inputs, SHA-256"] == fingerprint(ThreePointHitch(), {"S": (0.0, 0.25)})[:16]
    assert all(f"<dt>{name}</dt>" in page and value in unescape(page) for name, value in facts.items())


def test_the_table_has_the_numbers_of_python(hitch):
    machine = ThreePointHitch()
    motion = machine.at(**run_of(machine).over(np.linspace(0.0, 1.0, 11)))
    first, second = grids(hitch, "S, m")
    shown = {name: [row[place] for row in grid.rows] for grid in (first, second) for place, name in enumerate(grid.headings)}
    for column in results(machine, motion):
        assert shown[column.heading] == [f"{value:z.{column.digits}f}" for value in column.shown]


def test_equations_are_those_of_the_listing_with_numbers_in_mathml(page, hitch):
    from linkage import equations

    machine, pose = ThreePointHitch(), {"S": 0.125}
    found = [block for section in hitch.sections for block in section.blocks if isinstance(block, Equality) and block.number]
    lines = equations(machine, forces=True).sheet(pose)
    assert [(each.number, each.steps) for each in lines] == [(each.number, each.steps) for each in found]
    tree = ElementTree.fromstring(page.removeprefix("<!DOCTYPE html>"))
    shown = {each[0].text: each[1] for each in tree.iter(f"{X}div") if each.get("class") == "eq" and each[0].text}
    assert len(shown) == len(found)
    numbers = [each.text for each in shown["(1)"].iter(f"{M}mn")]
    assert numbers == ["0", "0.5", "0.125", "0.625"]
    thrust = next(line for line in lines if line.symbol == "T_{lift}")
    assert float(thrust.results[0].split(" ")[0]) == pytest.approx(float(pin_forces(machine.at(**pose)).thrusts["lift"]), rel=1e-5)


def test_largest_pin_forces_are_those_of_max_table(hitch):
    rows = max_table(pin_forces(ThreePointHitch().sweep(11)))
    (grid,) = grids(hitch, "Fx, kN")
    shown = {(row[0], row[2], row[3]): row for row in grid.rows}
    for each in rows:
        row = shown[each.point, each.on.split(" ")[0], each.by.split(" ")[0]]
        Fx, Fy, size = map(float, row[4:7])
        assert size == pytest.approx(each.force / 1e3, abs=6e-4) and np.hypot(Fx, Fy) == pytest.approx(size, abs=2e-3)
        assert np.arctan2(Fy, Fx) == pytest.approx(each.angle, abs=1e-3 + 1e-3 / size)


def test_checks_are_measured_and_kept(hitch):
    (grid,) = grids(hitch, "bound")
    assert {row[0] for row in grid.rows} >= {"lengths kept", "loops closed", "equations evaluated again", "transfer ratios", "virtual work"}
    for row in grid.rows:
        assert row[4].ok and 0.0 <= float(row[2]) <= float(row[3]) <= 1e-6


def test_a_check_fails_where_a_length_is_not_kept(monkeypatch):
    from linkage.documents import checks

    motion = ThreePointHitch().sweep(5)
    assert checks.lengths_kept(motion).ok and all(each.ok for each in checks.loops_closed(motion))
    own = type(motion).distance
    monkeypatch.setattr(type(motion), "distance", lambda self, P, Q: own(self, P, Q) * (1.0 + 1e-8))
    assert not checks.lengths_kept(motion).ok
    monkeypatch.setattr(type(motion), "distance", own)
    turned = type(motion).angle
    monkeypatch.setattr(type(motion), "angle", lambda self, P, Q: turned(self, P, Q) + 1e-7 * ((P, Q) in (("O", "B"), ("B", "O"))))
    assert not all(each.ok for each in checks.loops_closed(motion))


def test_russian_says_everything_in_russian():
    with language("ru"):
        text = html_text(report_document(ThreePointHitch()))
    body = re.sub(r"<style>.*?</style>|<math.*?</math>|<img[^>]*>", "", text, flags=re.DOTALL)
    assert '<html lang="ru"' in text
    for word in (
        "Исходные данные",
        "Чертёж",
        "Расчёт",
        "Результаты",
        "Гидравлика",
        "Проверки расчёта",
        "Заключения",
        "выполнено",
        "кН",
        "град",
    ):
        assert word in body
    heads = [unescape(each) for each in re.findall(r"<(?:th|h2|dt|caption|figcaption)[^>]*>(.*?)</", body)]
    assert not [each for each in heads if re.search(r"\b(the|of|and|stroke|table|figure|forces?|kept|machine|with)\b", each, re.IGNORECASE)]
    assert "kept" not in re.sub(r"<td class=\"m\">.*?</td>", "", body)


def test_units_are_those_of_the_system():
    document = report_document(MowerLift(), units="kgf")
    (grid,) = grids(document, "Fx, kgf")
    (plain,) = grids(report_document(MowerLift()), "Fx, kN")
    assert float(grid.rows[0][6]) == pytest.approx(float(plain.rows[0][6]) * 1e3 / 9.80665, abs=1.0)


def test_load_cases_are_looked_at_alone_or_all(tmp_path):
    both = report_document(Lifter())
    (grid,) = grids(both, "least", "unit")
    assert {row[0] for row in grid.rows} == {"own loads", "twice"}
    sizes = {row[0]: float(row[4]) for row in grid.rows if row[2] == "S"}
    assert sizes["twice"] == pytest.approx(2.0 * sizes["own loads"], abs=2e-3)
    (only,) = grids(report_document(Lifter(), case="double"), "least", "unit")
    assert {row[0] for row in only.rows} == {"twice"}
    with pytest.raises(DefinitionError, match=r"case='none'.*double"):
        report(Lifter(), tmp_path / "a.html", case="none")


def test_sources_stand_beside_the_numbers_and_names_are_escaped(tmp_path):
    document = report_document(Lifter(OB=0.41), title_block={"<b>": "a|b & *c*"})
    page, text = html_text(document), markdown(document, {id(each): "x.svg" for s in document.sections for each in s.blocks})
    assert "measured at the frame" in page and "from the data sheet" in page and "was 400" in page
    assert "&lt;b&gt;" in page and "a|b &amp; *c*" in page and "<signs>" not in page
    assert r"\<b\>" in text and r"a\|b & \*c\*" in text and r"\<signs\>" in text
    ElementTree.fromstring(page.removeprefix("<!DOCTYPE html>"))


def test_strokes_are_held_or_run_together():
    held = report_document(Sloped(), at={"T": 0.02})
    assert "T = 20 mm" in dict(held.facts)["Run"]
    both = report_document(Sloped(), at={"S": (0.0, 0.1), "T": (0.05, 0.0)})
    assert "T = 50 to 0 mm" in dict(both.facts)["Run"] and grids(both, "S, m", "T, m")


def test_a_group_has_no_closed_form_and_the_report_says_so():
    document = report_document(StephensonThreeFar())
    words = " ".join(block.text for section in document.sections for block in section.blocks if hasattr(block, "text"))
    assert "found together, by iteration" in words and "No load is declared" in words


def test_what_cannot_be_reported_is_refused_in_words(tmp_path):
    with pytest.raises(DefinitionError, match="one design"):
        report(Lifter(OB=[0.4, 0.41]), tmp_path / "a.html")
    with pytest.raises(DefinitionError, match=r"\.html, \.pdf, \.md"):
        report(Lifter(), tmp_path / "a.docx")
    with pytest.raises(DefinitionError, match="colunm"):
        report(Lifter(), tmp_path / "a.html", columns=["colunm"])
    with pytest.raises(DefinitionError, match="count=1"):
        report(Lifter(), tmp_path / "a.html", count=1)
    with pytest.raises(DefinitionError, match="Language"):
        report(Lifter(), tmp_path / "a.html", language="xx")
    with pytest.raises(FileError, match="not there"):
        report(Lifter(), tmp_path / "no" / "a.html")
    assert not list(tmp_path.iterdir())


def test_the_same_inputs_give_the_same_bytes_and_hash_in_another_process(tmp_path):
    program = (
        "from mechanisms.classics.scotch_yoke import ScotchYoke; from linkage import report; import sys;"
        "report(ScotchYoke(), sys.argv[1]); report(ScotchYoke(), sys.argv[2])"
    )
    other = [tmp_path / "o.html", tmp_path / "o.pdf"]
    subprocess.run([sys.executable, "-c", program, *map(str, other)], check=True)
    for path in other:
        mine = report(ScotchYoke(), tmp_path / f"m{path.suffix}")
        assert mine.read_bytes() == path.read_bytes()
    hashes = {fingerprint(Lifter(**given), {"S": (0.0, end)}) for given in ({}, {"OB": 0.41}, {"load.mass": 101.0}) for end in (0.1, 0.09)}
    assert len(hashes) == 6 and fingerprint(Lifter(OB=0.41), {}) == fingerprint(Lifter(OB=0.41), {})


def test_markdown_and_its_pictures_are_replaced_whole(tmp_path):
    path = tmp_path / "lifter.md"
    report(Lifter(), path)
    folder, text = tmp_path / "lifter_files", path.read_text(encoding="utf-8")
    linked = re.findall(r"\]\(lifter_files/([^)]+)\)", text)
    assert linked and {each.name for each in folder.iterdir()} == {*linked, "hydrolinkage"}
    assert text.count("$$") % 2 == 0 and r"\tag{1}" in text and "## 1. Inputs" in text
    for name in linked:
        ElementTree.parse(folder / name)
    (folder / "old.svg").write_text("")
    report(Lifter(), path)
    assert not (folder / "old.svg").exists()
    (tmp_path / "own_files").mkdir()
    with pytest.raises(FileError, match="something else"):
        report(Lifter(), tmp_path / "own.md")


def test_a_pdf_has_pages_and_fonts_and_no_date():
    content = pdf(report_document(Lifter()))
    assert content.startswith(b"%PDF") and b"/CreationDate" not in content and b"/Type3" not in content
    assert content.count(b"/Type /Page ") >= 4


@pytest.mark.skipif(shutil.which("pdftotext") is None, reason="poppler's pdftotext is not installed")
def test_the_text_of_a_pdf_can_be_selected_in_russian_too(tmp_path):
    path = report(MowerLift(), tmp_path / "m.pdf", language="ru")
    text = subprocess.run(["pdftotext", "-layout", str(path), "-"], check=True, capture_output=True, text=True).stdout
    pages = text.count("\f")
    for word in ("Исходные данные", "Проверки расчёта", "Наибольшие силы в шарнирах", f"стр. {pages} из {pages}", "шарнир"):
        assert word in text
    document = report_document(MowerLift(), language="ru")
    grid = next(
        block for section in document.sections for block in section.blocks if isinstance(block, TableBlock) and "Fx, кН" in block.headings
    )
    assert all(re.search(r"\s+".join(map(re.escape, row[4:7])), text) for row in grid.rows)


def test_pictures_are_small_and_the_first_curve_is_the_one_it_is_about(hitch):
    pictures = [block for section in hitch.sections for block in section.blocks if isinstance(block, Illustration)]
    assert [each.name for each in pictures[:2]] == ["dimensions", "positions"]
    assert pictures[2].name == f"curve_{ThreePointHitch().featured().column or 'tilt'}"


def test_dimension_lines_have_the_lengths_of_the_links():
    from matplotlib.figure import Figure

    from linkage.pictures.dimensioned import AngleArc, LengthLine, dimensioned, placed_dimensions
    from linkage.pictures.scene import Scene

    motion = ThreePointHitch().at(S=[0.1])
    ax = Figure(figsize=(6.6, 4.6)).add_axes((0.1, 0.1, 0.85, 0.85))
    dimensioned(ax, motion)
    texts = {each.get_text() for each in ax.texts}
    assert {"300", "360", "880", "950", "L0 + S", "75°"} <= texts
    scene = Scene(motion)
    for each in placed_dimensions(scene, scene.at(0), 0, 150.0, (-9.0, 9.0, -9.0, 9.0)):
        if isinstance(each, LengthLine) and each.text.isdigit():
            start, end = each.ends
            assert np.hypot(*(end - start)) * 1e3 == pytest.approx(float(each.text), abs=1e-6)
        elif isinstance(each, AngleArc):
            assert (each.end - each.start) / deg == pytest.approx(float(each.text.rstrip("°")), abs=1e-3)


@pytest.mark.parametrize(
    ("latex", "expected"),
    [
        (r"\frac{a}{b}", "<mfrac><mi>a</mi><mi>b</mi></mfrac>"),
        (r"L_{OB}", "<msub><mi>L</mi><mrow><mi>O</mi><mi>B</mi></mrow></msub>"),
        (r"28.7^{\circ}", "<mrow><mn>28.7</mn><mtext>°</mtext></mrow>"),
        (r"\mathit{tilt}", '<mi class="w">tilt</mi>'),
        (r"\left|x\right|^{2}", '<msup><mrow><mo stretchy="true">|</mo><mi>x</mi><mo stretchy="true">|</mo></mrow><mn>2</mn></msup>'),
        (r"\mathit{a<b}", '<mi class="w">a&lt;b</mi>'),
        (r"\operatorname{atan}_{2}", "<msub><mi>atan</mi><mn>2</mn></msub>"),
    ],
)
def test_latex_becomes_mathml(latex, expected):
    assert mathml(boxes(latex)) == expected


def test_latex_is_read_into_boxes_that_break_before_signs():
    row = boxes(r"a + \frac{b}{c_{1}} \cdot 3")
    assert isinstance(row, BoxRow) and isinstance(row.parts[2], Fraction) and isinstance(row.parts[2].under, Script)
    assert len(breakable(row)) == 3 and len(breakable(boxes("-a"))) == 1
    cases = boxes(r"\begin{cases} a & \text{for}\: x > 0 \\ b & \text{otherwise} \end{cases}")
    assert mathml(cases).count("<mtr>") == 2


@pytest.mark.slow
def test_every_walking_leg_has_a_report():
    document = report_document(Jansen())
    ElementTree.fromstring(html_text(document).removeprefix("<!DOCTYPE html>"))
    assert pdf(document)


def test_a_column_of_the_table_may_be_chosen():
    document = report_document(Lifter(), columns=["B_y"])
    (grid,) = grids(document, "S, m")
    assert grid.headings == ("S, m", "B_y, m")
    looked = Looked.at(Lifter(), {}, 11, None)
    assert [row[1] for row in grid.rows] == [f"{value:.4f}" for value in Column("B_y", looked.table.y("B"), "m").shown]


class OverCentre(Mechanism):
    """A boom on a crank with a cylinder that stands in line with it in the middle of the stroke."""

    phi = Stroke(-60 * deg, 60 * deg)
    A, O = Ground(0.0, -1.0), Ground(0.0, 0.0)
    B = Crank(O, OB=0.5, angle=phi + 90 * deg)
    C = OnLink(O, B, OC=0.8)
    load = Weight(C, mass=100)
    ram = Cylinder(A, B, bore=50 * mm, rod=28 * mm)


class Pumped(OverCentre):
    pump = LiftCircuit("ram", pressure=180 * bar)


class Beside(OverCentre):
    """The same on a line with a second one, in line with the boom as well."""

    Z = Ground(0.0, -1.2)
    aid = Cylinder("Z", "C", bore=50 * mm, rod=28 * mm)
    pump = LiftCircuit(["ram", "aid"], pressure=180 * bar)


@pytest.mark.parametrize("machine", [OverCentre, Pumped, Beside])
def test_a_dead_centre_in_the_middle_of_the_run_is_gone_round(machine, tmp_path):
    """Forces are refused in the middle: the calculation is of the pose beside it, and every number of it is one."""
    with pytest.raises(SingularError):
        pin_forces(machine().at(phi=0.0))
    place = tmp_path / "report.md"
    report(machine(), place)
    text = place.read_text(encoding="utf-8")
    assert "the numbers are those of phi = -1 deg" in text  # of 121 poses over 120 deg
    calculation = text.partition("Calculation\n")[2].partition("## ")[0]
    assert "T_{ram}" in calculation
    assert "nan" not in calculation


def test_equations_have_no_number_where_there_is_none_with_any_digits():
    found = equations(Pumped(), forces=True)
    rough, exact = found.values(dict(phi=0.0)), found.values(dict(phi=0.0), digits=30)
    for name in ("T_ram", "F_ram", "p_ram", "kz_ram"):
        assert not np.isfinite(rough[name])
        assert not np.isfinite(float(exact[name]))
    assert float(exact["Fmax_ram"]) == pytest.approx(rough["Fmax_ram"], rel=1e-14)
