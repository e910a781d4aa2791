"""A report as PDF: its paper, its letters, its formulas, what it says of itself, and what is said where Typst is not installed."""

import re
import shutil
import subprocess

import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from linkage import Crank, DefinitionError, Ground, Mechanism, Stroke, Weight, report
from linkage.documents import pdf as writer
from linkage.documents.content import Document, Equality, Formula, Illustration, Mark, Section, TableBlock, TitleBlock
from linkage.documents.pdf import document_data, pdf
from linkage.documents.pictures import painted, picture_svg
from linkage.documents.reporting import report_document
from linkage.formulas.typeset import Fenced, Lines, boxes
from linkage.formulas.typst import typst_math
from linkage.verdict import Verdict
from tests.for_all import first_daily, for_all

needs_poppler = pytest.mark.skipif(shutil.which("pdftotext") is None, reason="poppler's pdftotext is not installed")


class Boom(Mechanism):
    """A boom."""

    phi = Stroke(0.1, 0.9)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=1.0, angle=phi)
    load = Weight(A, mass=100)


class Weak(Boom):
    """A boom that breaks."""

    def rules(self, motion):
        return [Verdict("strength", False, "It breaks.")]


def paper(*blocks, title="T", **fields):
    """Return a document of one section."""
    return Document(title, "", TitleBlock(**fields), (), Mark(True, "kept"), (Section("Section", blocks),), "en")


def text_of(content, tmp_path):
    """Return the text of a PDF."""
    path = tmp_path / "a.pdf"
    path.write_bytes(content)
    return subprocess.run(["pdftotext", "-layout", str(path), "-"], check=True, capture_output=True, text=True).stdout


def test_the_paper_is_a4_and_the_file_says_what_it_is_and_no_date():
    content = pdf(report_document(Boom()))
    sheets = {tuple(map(float, found.split())) for found in re.findall(rb"/MediaBox ?\[([\d. ]+)\]", content)}
    assert [*map(list, sheets)] == [pytest.approx([0.0, 0.0, 595.276, 841.89], abs=1e-3)]
    assert re.search(rb"/Title ?\(Boom\)", content) and b"/CreationDate" not in content and b"/Type3" not in content
    assert content == pdf(report_document(Boom()))


@first_daily(1, "kind", [Weak, Boom])
def test_what_is_kept_and_what_is_broken_is_marked(kind):
    data = document_data(report_document(kind()))
    cells = [cell for section in data["sections"] for block in section["blocks"] for row in block.get("rows", ()) for cell in row]
    marks = {cell["mark"] for cell in cells if isinstance(cell, dict) and "mark" in cell}
    assert "kept" in marks and ("broken" in marks) == (kind is Weak)


@needs_poppler
def test_every_sign_means_itself_wherever_it_stands(tmp_path):
    """No sign of a user's text is taken for a command of the typesetter: in titles, texts, tables, captions and names of formulas."""
    signs = r"""a#b $c$ *d* _e_ @f <g> \h "i" 'j' [k] {l} ~m ^n `o` //p /*q*/ -- ... #let x=1 = %r &s Ж-щ é"""
    name = "".join(each for each in signs if each not in "{}\\ ")
    name_latex = rf"\mathit{{{name}}}"
    grid = TableBlock(signs, (signs, "y"), ((signs, Formula(name_latex)),), "ll")
    content = pdf(paper(signs, grid, Equality(1, (name_latex, "1")), title=signs, number=signs))
    text = re.sub(r"\s", "", text_of(content, tmp_path))
    assert text.count(re.sub(r"\s", "", signs)) >= 4
    assert text.count(name) == 2  # in the table and in the equation


@needs_poppler
def test_a_table_goes_on_with_its_heading_on_the_next_page(tmp_path):
    grid = TableBlock("Long", ("place", "value"), tuple((f"row {k}", f"{k}.5") for k in range(150)), "lr")
    pages = text_of(pdf(paper(grid)), tmp_path).split("\f")[:-1]
    assert len(pages) > 2 and all("place" in page and f"page {number} of {len(pages)}" in page for number, page in enumerate(pages, 1))
    assert all(f"row {k} " in "".join(pages) for k in range(150))


@needs_poppler
def test_a_table_is_divided_where_four_rows_stand_on_either_page_and_a_short_one_never(tmp_path):
    def rows_by_page(above, count):
        """Return how many of some rows stand on each page, below a number of others."""
        given = {"line": above, "row": count}
        tables = [TableBlock(name, (name,), tuple((f"{name} {k}",) for k in range(rows)), "l") for name, rows in given.items()]
        pages = text_of(pdf(paper(tables[0], "Below it.", tables[1])), tmp_path).split("\f")
        return [found for page in pages if (found := len(re.findall(r"row \d+", page)))]

    long, short = ([rows_by_page(above, count) for above in range(32, 46, 2)] for count in (11, 8))
    assert all(sum(found) == 11 and min(found) >= 4 for found in long) and any(len(found) == 2 for found in long), long
    assert all(found == [8] for found in short), short


FORMULAS = [
    "x", r"x + y", r"a, b", r"\sqrt{x + y}", r"\frac{a + b}{c}", r"x_{OB}", r"x^{2}", r"x_{1}^{2}", r"\left(\frac{a}{b}\right)",
    r"\sqrt{\frac{a}{b}}", r"\vec{u}", r"\overrightarrow{AB}", r"\frac{\sqrt{x}}{\left(y\right)^{2}}", r"-3 \cdot 10^{-6}\,\mathrm{m}",
    r"\begin{cases} a & \text{for}\: x > 0 \\ b & \text{otherwise} \end{cases}", r"\begin{pmatrix} a \\ b \end{pmatrix}", r"28.7^{\circ}",
    r"\left|x\right|^{2}", r"\left\|x\right\| \leq \varepsilon", r"\operatorname{atan2}\left(y, x\right)", r"F_{\_}", r"\{x\}",
]  # fmt: skip


def test_every_kind_of_formula_is_set():
    """All in one document: each alone in a cell, and as an equation."""
    cells = tuple((Formula(each), f"{place}") for place, each in enumerate(FORMULAS))
    assert pdf(paper(TableBlock("", ("f", "n"), cells, "lr"), *(Equality(0, (each, each)) for each in FORMULAS)))


@for_all(
    ("latex", "expected"),
    [
        (r"L_{OB}", 'attach(L, b: word("OB"))'),
        (r"\mathit{FIS}\left(S\right)", r'word("FIS")lr(\( S \))'),
        (r"2 m_{load}", '2 thin attach(m, b: word("load"))'),
        (r"\frac{a}{b}", "frac(a, b)"),
        (r"-3^{2}", "− attach(3, t: 2)"),
        (r"\mathit{a\"b}", r'word("a\\\"b")'),
        ("x#_{a}", r"x attach(\#, b: a)"),
    ],
)
def test_latex_becomes_math_of_typst(latex, expected):
    assert typst_math(boxes(latex)) == expected


@pytest.mark.parametrize("kind", ["pmatrix", "cases"])
def test_a_table_of_boxes_has_its_rows_and_columns(kind):
    found = boxes(rf"\begin{{{kind}}} a & b \\ c & d \\ e & f \end{{{kind}}}")
    assert isinstance(found, Fenced) and isinstance(found.body, Lines)
    assert [[cell.text for cell in row] for row in found.body.rows] == [["a", "b"], ["c", "d"], ["e", "f"]]


def test_a_picture_stands_in_the_room_it_has():
    """Its axes are as far from the picture's edges as it says."""
    picture = Illustration("p", "", (4.0, 3.0), (0.5, 0.25, 0.4, 0.1), lambda ax: ax.plot([0.0, 1.0], [0.0, 1.0]))
    figure = Figure(figsize=(4.0, 3.0))
    FigureCanvasAgg(figure)
    place = painted(figure, picture).get_position().bounds
    assert place == pytest.approx((0.5 / 4.0, 0.4 / 3.0, 3.25 / 4.0, 2.5 / 3.0))
    drawn = picture_svg(picture)
    (patch,) = re.findall(r'<g id="patch_2">\s*<path d="M ([\d.]+) ([\d.]+)', drawn)
    assert [float(each) for each in patch] == pytest.approx([0.5 * 72.0, (3.0 - 0.4) * 72.0], abs=1e-3)


def test_without_typst_a_pdf_is_refused_in_words_and_other_reports_are_written(tmp_path, monkeypatch):
    monkeypatch.setattr(writer, "find_spec", lambda name: None)
    with pytest.raises(DefinitionError, match=re.escape('pip install "hydrolinkage[pdf]"')) as found:
        report(Boom(), tmp_path / "a.pdf")
    assert "a.pdf" in str(found.value) and ".html or .md" in str(found.value)
    assert not list(tmp_path.iterdir())
    assert report(Boom(), tmp_path / "a.html").is_file() and report(Boom(), tmp_path / "a.md").is_file()


@needs_poppler
def test_a_number_is_never_parted_from_its_unit(tmp_path):
    rows = tuple((f"{'ab ' * n}reach = 3000.0 mm, {'cd ' * n}12 kN/m, 5 %", "ef " * 40) for n in range(1, 40))
    lines = text_of(pdf(paper(TableBlock("", ("a", "b"), rows, "mm"))), tmp_path).splitlines()
    assert len(lines) > 100
    assert not [line for line in lines if re.match(r" *(mm|kN/m|%)", line)]
