"""Reports of calculations: each kind of file opened, and what is in it compared with what Python says."""

import re
import shutil
import subprocess
import sys
from functools import cache
from html import unescape
from xml.etree import ElementTree

import numpy as np
import pytest

from hydraulics import Cylinder, LiftCircuit, thrust
from linkage import (
    RIGHT,
    Acting,
    Crank,
    DefinitionError,
    Dyad,
    FileError,
    Ground,
    LoadCase,
    Mechanism,
    OnLink,
    Over,
    SingularError,
    Stroke,
    Weight,
    deg,
    equations,
    least,
    max_table,
    most,
    pin_forces,
    report,
    y,
)
from linkage.documents import report_document
from linkage.documents.content import Equality, Illustration, TableBlock
from linkage.documents.html import html_text
from linkage.documents.markdown import markdown
from linkage.documents.outcome import figures, still_blocks
from linkage.documents.pdf import pdf
from linkage.documents.reporting import fingerprint
from linkage.documents.run import ReportSubject
from linkage.formulas.typeset import BoxRow, Fraction, Script, boxes, breakable, mathml
from linkage.formulas.typst import typst_math
from linkage.language import language
from linkage.motion import Column, places_text
from linkage.reports import results, run_of
from linkage.units import bar, display_unit, mm, show
from mechanisms.classics.jansen import Jansen
from mechanisms.classics.scotch_yoke import ScotchYoke
from mechanisms.classics.stephenson_three import StephensonThreeFar
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import first_daily, for_all
from tests.linkage.known_machines import GrabArms

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


@cache
def lifter():
    """Return the report of a lifter, which several tests read."""
    return report_document(Lifter())


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
    assert facts["Checked by"] == "N. N." and facts["Verdicts"] == "15 of 15 rules kept"
    assert facts["Inputs, SHA-256"] == fingerprint(ThreePointHitch(), {"S": (0.0, 0.25)})
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
        assert row[6] == figures(each.force / 1e3) and np.hypot(Fx, Fy) == pytest.approx(size, rel=1e-3)
        assert np.arctan2(Fy, Fx) == pytest.approx(each.angle, abs=1e-3 + 1e-3 / size)


def test_checks_are_measured_and_kept(hitch):
    (grid,) = grids(hitch, "bound")
    assert {row[0] for row in grid.rows} >= {"lengths kept", "loops closed", "equations evaluated again", "transfer ratios", "virtual work"}
    for row in grid.rows:
        assert row[4].ok and 0.0 <= float(row[2]) <= float(row[3]) <= 1e-6


def test_the_results_of_a_pose_are_asked_for_once(monkeypatch):
    from linkage.documents import run

    asked = []

    def noted(machine, motion, case=None):
        asked.append(motion.shape)
        return results(machine, motion, case)

    monkeypatch.setattr(run, "results", noted)
    report_document(Lifter())
    assert sorted(asked) == [(11,), (run.CURVE,)]


def test_a_check_fails_where_a_length_is_not_kept(monkeypatch):
    from linkage.documents import checks

    motion = ThreePointHitch().sweep(5)
    lengths, loops = checks.positions_kept(motion)
    assert lengths.ok and loops.ok
    own = type(motion).distance
    monkeypatch.setattr(type(motion), "distance", lambda self, P, Q: own(self, P, Q) * (1.0 + 1e-8))
    assert not next(checks.positions_kept(motion)).ok
    monkeypatch.setattr(type(motion), "distance", own)
    turned = type(motion).angle
    monkeypatch.setattr(type(motion), "angle", lambda self, P, Q: turned(self, P, Q) + 1e-7 * ((P, Q) in (("O", "B"), ("B", "O"))))
    lengths, loops = checks.positions_kept(motion)
    assert lengths.ok and not loops.ok


@pytest.mark.slow
def test_russian_says_everything_in_russian():
    with language("ru"):
        text = html_text(report_document(ThreePointHitch()))
    body = re.sub(r"<style>.*?</style>|<math.*?</math>|<img[^>]*>", "", text, flags=re.DOTALL)
    assert '<html lang="ru"' in text
    for word in (
        "Исходные данные",
        "Схема",
        "Допущения",
        "утвердил",
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
    document = report_document(Lifter(), units="kgf")
    (grid,) = grids(document, "Fx, kgf")
    (plain,) = grids(lifter(), "Fx, kN")
    assert float(grid.rows[0][6]) == pytest.approx(float(plain.rows[0][6]) * 1e3 / 9.80665, abs=1.0)


def test_load_cases_are_looked_at_alone_or_all(tmp_path):
    both = lifter()
    assert dict(both.facts)["Load cases"] == "own loads, twice"
    (grid,) = grids(both, "least", "unit")
    (whole,) = (row for row in grid.rows if row[0] == "S")
    assert "under its own loads" in whole[3] and "in the case twice" in whole[5]
    for acting in (dict(case="plain"), dict(case="double"), dict(acting=Acting(case="double"))):
        only = report_document(Lifter(), **acting)
        assert dict(only.facts)["Load cases"] == ("own loads" if acting == dict(case="plain") else "twice")
        (alone,) = (row for grid in grids(only, "least", "unit") for row in grid.rows if row[0] == "S")
        assert "case" not in alone[3] + alone[5]
        place = 2 if acting == dict(case="plain") else 4
        assert alone[place] == whole[place]
    assert float(whole[4]) > 1.5 * float(report_one(Lifter(), "S", case="plain"))
    with pytest.raises(DefinitionError, match=r"Load case 'none' is unknown in .*Known: plain, double"):
        report(Lifter(), tmp_path / "a.html", case="none")
    with pytest.raises(DefinitionError, match=r"case= and acting= both say it"):
        report(Lifter(), tmp_path / "a.html", case="double", acting=Acting(case="double"))


def report_one(machine, drive, **given):
    """Return the greatest force of a drive in a report, as text."""
    (grid,) = grids(report_document(machine, **given), "least", "unit")
    return next(row[4] for row in grid.rows if row[0] == drive)


# What is judged, is judged over all that the machine runs.


class Grab(GrabArms):
    """A boom and a jib on cylinders: two strokes, two load cases."""

    shock = LoadCase("with shock", scale={"load": 1.8})
    lift = Cylinder("A", "B", bore=80 * mm, rod=45 * mm)
    pump = LiftCircuit(lift, pressure=160 * bar)
    jib = Cylinder("D", "H", bore=63 * mm, rod=36 * mm, works="both")


class Cornered(Grab):
    """The same with a longer jib cylinder, which leaves a part of the box."""

    T = Stroke(0.0, 0.75)


class CorneredOnce(Cornered):
    """The same with fewer rules, in one case."""

    jib = pump = shock = None


@pytest.fixture(scope="module")
def grab():
    return report_document(Grab())


def test_pin_forces_are_those_of_the_whole_box_in_all_cases(grab):
    (grid,) = grids(grab, "Fx, kN")
    rows = max_table(Grab())
    assert [row[6] for row in grid.rows] == [figures(each.force / 1e3) for each in rows]
    assert all(row[8].startswith("with shock, frictionless, ") for row in grid.rows)
    assert all("S = " in row[8] and "T = " in row[8] for row in grid.rows)
    held = max_table(pin_forces(Grab().at(S=np.linspace(0.0, 0.25, 5), T=0.15)))
    assert max(each.force for each in rows) > 1.5 * max(each.force for each in held)


def test_rules_are_those_of_the_verdicts_and_the_mark_counts_them(grab):
    verdicts = [each for each in Grab().verdicts() if each.is_rule]
    (grid,) = grids(grab, "what was found")
    assert [row[2] for row in grid.rows if row[0]] == [each.sentence for each in verdicts]
    kept = sum(each.ok is True for each in verdicts)
    assert dict(grab.facts)["Verdicts"] == grab.verdict.word == f"{kept} of {len(verdicts)} rules kept"
    assert dict(grab.facts)["Judged over"] == "S = 0 to 250 mm, T = 0 to 300 mm"


@pytest.mark.slow
def test_a_rule_that_says_nothing_is_counted_apart():
    class Idle(Grab):
        lift = Cylinder("A", "B", bore=80 * mm, rod=45 * mm, works="rod")

    document = report_document(Idle())
    silent = sum(each.ok is None for each in Idle().verdicts() if each.is_rule)
    assert silent and document.verdict.word.endswith(f", {silent} say nothing" if silent > 1 else ", 1 says nothing")
    (grid,) = grids(document, "what was found")
    assert {row[1].word for row in grid.rows} >= {"says nothing"}


def test_members_have_their_ends_over_all_that_the_machine_runs(grab):
    (grid,) = grids(grab, "component", "least", "greatest")
    found = {tuple(row[:2]): row for row in grid.rows}
    assert {member for member, _ in found} >= {"lift", "jib"}
    lowest, greatest = Grab().answers([least(thrust("lift")), most(thrust("lift"))])
    (row,) = (each for (member, heading), each in found.items() if member == "lift" and "thrust" in heading)
    assert [float(row[2].split()[0]), float(row[4].split()[0])] == pytest.approx([lowest.value / 1e3, greatest.value / 1e3], rel=1e-3)


def test_worst_places_are_those_of_the_answers(grab):
    (grid,) = grids(grab, "situation", "strokes")
    answers = {each.heading: each for each in Grab().verdicts() if each.answer is not None}
    assert 0 < len(grid.rows) <= 10
    for rule, mark, value, share, _, strokes in grid.rows:
        answer = answers[rule].answer
        assert mark.ok is answers[rule].ok
        if rule.startswith("buckling"):  # the safety, as the rule says it
            assert f"safety {float(value):.3g}, at least" in answers[rule].sentence
        else:
            assert value == show(float(answer.value), display_unit(answer.measures, "mm"), 4)
            assert value in answers[rule].sentence
        assert strokes == places_text(answer.strokes, {"S": "m", "T": "m"})
        if rule.startswith("lifting"):  # its limit is a reserve of one
            assert share == f"{100.0 / answer.value:.0f} %"
        elif rule.startswith("buckling"):
            assert share == f"{100.0 * answer.value:.0f} %"
    order = [row[1].ok is not False for row in grid.rows]
    assert order == sorted(order)


def test_curves_keep_one_stroke_and_mark_the_worst_of_the_box(grab):
    pictures = {b.name: b for section in grab.sections for b in section.blocks if isinstance(b, Illustration)}
    picture = next(each for each in pictures.values() if "thrust lift" in each.caption)  # AB is S: the same curve as the drive's force
    assert "along S; T = 150 mm held, under its own loads." in picture.caption
    answer = Grab().answers([most(thrust("lift"))])[0]
    assert f"greatest {figures(answer.value / 1e3)} kN, in the case with shock, at S = " in picture.caption
    from matplotlib.figure import Figure

    ax = Figure().add_axes((0.1, 0.1, 0.8, 0.8))
    picture.paint(ax)
    levels = [line.get_ydata()[0] for line in ax.lines if len(set(line.get_ydata())) == 1]
    assert any(level == pytest.approx(answer.value / 1e3, rel=1e-6) for level in levels)
    assert ax.get_ylim()[1] > answer.value / 1e3


class CorneredBare(CorneredOnce):
    """The same without any cylinder: its strokes drive it."""

    lift = pump = work = None


@first_daily(0, "machine", [CorneredBare, CorneredOnce, Cornered])
def test_places_that_are_lost_leave_gaps_and_one_remark(machine):
    document = report_document(machine(), at={"T": (0.0, 0.75)})
    texts = [block for section in document.sections for block in section.blocks if isinstance(block, str)]
    assert len([text for text in texts if "cannot be assembled" in text]) == 1
    (rules,) = grids(document, "what was found")
    (assembly,) = (row for row in rules.rows if row[0] == "assembly")
    assert assembly[1].ok is False and document.verdict.ok is False
    assert grids(document, "Fx, kN")[0].rows


@pytest.mark.slow
def test_an_over_is_judged_in_the_place_of_the_box():
    document = report_document(Grab(), over=Over(S=(0.0, 0.1), T=0.0))
    assert dict(document.facts)["Judged over"] == "S = 0 to 100 mm, T = 0 mm"
    (grid,) = grids(document, "Fx, kN")
    assert all("T = 0.0 mm" in row[8] for row in grid.rows)


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
    words = " ".join(block for section in document.sections for block in section.blocks if isinstance(block, str))
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


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".html", pytest.param(".pdf", marks=pytest.mark.slow)])
def test_the_same_inputs_give_the_same_bytes_in_another_process(tmp_path, suffix):
    program = (
        "from mechanisms.classics.scotch_yoke import ScotchYoke; from linkage import report; import sys; report(ScotchYoke(), sys.argv[1])"
    )
    other = tmp_path / f"o{suffix}"
    subprocess.run([sys.executable, "-c", program, str(other)], check=True)
    assert report(ScotchYoke(), tmp_path / f"m{suffix}").read_bytes() == other.read_bytes()


def test_other_inputs_have_other_hashes():
    hashes = {fingerprint(Lifter(**given), {"S": (0.0, end)}) for given in ({}, {"OB": 0.41}, {"load.mass": 101.0}) for end in (0.1, 0.09)}
    assert len(hashes) == 6 and fingerprint(Lifter(OB=0.41), {}) == fingerprint(Lifter(OB=0.41), {})


def test_markdown_and_its_pictures_are_replaced_whole(tmp_path):
    path = tmp_path / "lifter.md"
    report(Lifter(), path)
    folder, text = tmp_path / "lifter_files", path.read_text(encoding="utf-8")
    linked = re.findall(r"\]\(lifter_files/([^)]+)\)", text)
    assert linked and {each.name for each in folder.iterdir()} == {*linked, "hydrolinkage"}
    assert text.count("$$") % 2 == 0 and r"\tag{1}" in text and "## 1. Sketch" in text
    for name in linked:
        ElementTree.parse(folder / name)
    (folder / "old.svg").write_text("")
    report(Lifter(), path)
    assert not (folder / "old.svg").exists()
    (tmp_path / "own_files").mkdir()
    with pytest.raises(FileError, match="something else"):
        report(Lifter(), tmp_path / "own.md")


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("pdftotext") is None, reason="poppler's pdftotext is not installed")
def test_the_text_of_a_pdf_can_be_selected_in_russian_too(tmp_path):
    document, path = report_document(Lifter(), language="ru"), tmp_path / "m.pdf"
    with language("ru"):
        path.write_bytes(pdf(document))
    text = subprocess.run(["pdftotext", "-layout", str(path), "-"], check=True, capture_output=True, text=True).stdout
    pages = text.count("\f")
    for word in ("Исходные данные", "Проверки расчёта", "Наибольшие силы в шарнирах", f"стр. {pages} из {pages}", "шарнир"):
        assert word in text
    grid = next(
        block for section in document.sections for block in section.blocks if isinstance(block, TableBlock) and "Fx, кН" in block.headings
    )
    assert all(re.search(r"\s+".join(map(re.escape, row[4:7])), text) for row in grid.rows)


def test_pictures_are_small_and_the_first_curve_is_the_one_it_is_about(hitch):
    pictures = [block for section in hitch.sections for block in section.blocks if isinstance(block, Illustration)]
    assert [each.name for each in pictures[:2]] == ["sketch", f"curve_{ThreePointHitch().featured().column or 'tilt'}"]
    assert pictures[-1].name == "dimensions"


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


@for_all(
    ("latex", "expected"),
    [
        (r"\frac{a}{b}", "<mfrac><mi>a</mi><mi>b</mi></mfrac>"),
        (r"L_{OB}", '<msub><mi>L</mi><mi class="w">OB</mi></msub>'),
        (r"\mathit{ram}_{bore}", '<msub><mi class="w">ram</mi><mi class="w">bore</mi></msub>'),
        (r"28.7^{\circ}", "<mrow><mn>28.7</mn><mtext>°</mtext></mrow>"),
        (r"\mathit{tilt}", '<mi class="w">tilt</mi>'),
        (r"\left|x\right|^{2}", '<msup><mrow><mo stretchy="true">|</mo><mi>x</mi><mo stretchy="true">|</mo></mrow><mn>2</mn></msup>'),
        (r"\mathit{a<b}", '<mi class="w">a&lt;b</mi>'),
        (r"\operatorname{atan}_{2}", "<msub><mi>atan</mi><mn>2</mn></msub>"),
    ],
)
def test_latex_becomes_mathml(latex, expected):
    assert mathml(boxes(latex)) == expected


def test_what_has_decimal_commas_is_listed_by_semicolons():
    pair, index = boxes(r"\left(-0.05, 65.7^{\circ}\right)"), boxes("C_{lift,1}")
    with language("ru"):
        assert re.sub("<[^>]*>", "", mathml(pair)) == "(−0,05;65,7°)" and re.sub("<[^>]*>", "", mathml(index)) == "Clift,1"
        assert typst_math(pair).count("\\;") == 1 and '"' not in typst_math(pair).replace('"normal"', "")
    assert re.sub("<[^>]*>", "", mathml(pair)) == "(−0.05,65.7°)"


def test_whole_numbers_beside_decimal_commas_are_listed_by_semicolons():
    whole, turned = boxes(r"\left(0, 4\right)"), boxes(r"\left(\left(1.6, 0.5\right), 90^{\circ}\right)")
    with language("ru"):
        assert [re.sub("<[^>]*>", "", mathml(each)) for each in (whole, turned)] == ["(0;4)", "((1,6;0,5);90°)"]
    assert re.sub("<[^>]*>", "", mathml(whole)) == "(0,4)"


def test_a_limit_that_rounding_alone_misses_is_kept():
    class Spare(Lifter):
        """An arm at its limit, but for rounding."""

        spare = y("B") - (float(Lifter().at(S=0.0)["B"][1]) + 1e-12)

    verdicts = [dict(report_document(Spare(), limits={"spare": (limit, "least", "below")}).facts)["Verdicts"] for limit in (0.0, 1e-6)]
    assert verdicts == ["1 of 1 rules kept", "1 of 1 rules kept, 1 limit is exceeded"]


def test_many_results_that_stand_still_are_a_table_of_what_is_new():
    still = {f"a{number}": f"{number}.0" for number in range(22)}
    (sentence,), (table,) = still_blocks({"a": "1.0 mm"}, {}), still_blocks(still, {})
    assert sentence == "The same at all these poses: a 1.0 mm." and len(table.rows) == 8 and table.rows[7] == ("a21", "21.0", *[""] * 4)
    (further,) = still_blocks(still, {**still, "a3": "4.0"})
    assert further.rows == (("a3", "3.0", "", "", "", ""),) and "before" in further.caption
    assert not [*still_blocks(still, still)]


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
    looked = ReportSubject.of(Lifter(), {}, 11, None)
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


@first_daily(0, "machine", [OverCentre, Pumped, pytest.param(Beside, marks=pytest.mark.slow)])
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


def test_places_that_are_judged_are_named_where_there_are_several():
    class Twice(Lifter):
        low, high = Over(S=(0.0, 0.02)), Over(S=(0.08, 0.1))

    assert dict(report_document(Twice()).facts)["Judged over"] == "low: S = 0 to 20 mm; high: S = 80 to 100 mm"
