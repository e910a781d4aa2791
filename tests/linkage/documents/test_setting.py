"""How formulas are set: ink stays within what a box says of itself, goes with the size, and covers what it is over."""

import re

import pytest
from matplotlib.figure import Figure

from linkage.documents.content import Illustration
from linkage.documents.pictures import painted, picture_svg
from linkage.documents.setting import GlyphRun, InkLine, set_formula, width
from linkage.formulas.typeset import Fenced, Lines, boxes
from tests.for_all import for_all

FORMULAS = [
    "x", r"x + y", r"a, b", r"\sqrt{x + y}", r"\frac{a + b}{c}", r"x_{OB}", r"x^{2}", r"x_{1}^{2}", r"\left(\frac{a}{b}\right)",
    r"\sqrt{\frac{a}{b}}", r"\vec{u}", r"\frac{\sqrt{x}}{\left(y\right)^{2}}",
]  # fmt: skip
SIZES = [6.0, 10.0, 24.0]


def ends(each):
    """Return the left and the right end of a piece of ink."""
    if isinstance(each, GlyphRun):
        return each.x, each.x + width(each.text, each.size, each.face)
    return min(x for x, _ in each.points), max(x for x, _ in each.points)


@for_all("size", SIZES)
@for_all("latex", FORMULAS)
def test_ink_stays_within_its_box(latex, size):
    formula = set_formula(boxes(latex), size)
    for each in formula.ink:
        left, right = ends(each)
        assert left >= -1e-9 and right <= formula.width + 1e-9
        heights = [each.y] if isinstance(each, GlyphRun) else [y for _, y in each.points]
        assert all(-formula.depth - 1e-9 <= y <= formula.height + 1e-9 for y in heights)


@for_all("latex", FORMULAS)
def test_a_formula_grows_with_its_size(latex):
    small, large = (set_formula(boxes(latex), size) for size in (10.0, 20.0))
    assert [large.width, large.height, large.depth] == pytest.approx([2.0 * small.width, 2.0 * small.height, 2.0 * small.depth], rel=0.02)


@pytest.mark.parametrize("latex", ["x", "x + y", r"\frac{a}{b}"])
def test_a_root_goes_over_all_of_what_it_is_of(latex):
    base, root = set_formula(boxes(latex), 10.0), set_formula(boxes(rf"\sqrt{{{latex}}}"), 10.0)
    (hook,) = (each for each in root.ink if isinstance(each, InkLine) and len(each.points) == 5)
    (start, top), (end, level) = hook.points[-2:]
    assert top == level > base.height
    assert end - start >= base.width and end <= root.width
    assert min(y for _, y in hook.points) == pytest.approx(-base.depth)


def test_an_operation_has_space_on_both_sides_and_a_sign_before_a_number_has_none():
    def gaps(latex):
        first, sign, last = (ends(each) for each in sorted(set_formula(boxes(latex), 10.0).ink, key=lambda each: each.x))
        return sign[0] - first[1], last[0] - sign[1]

    left, right = gaps(r"\alpha + \beta")
    assert left == pytest.approx(right) and left > 1.0
    alone = set_formula(boxes("-x"), 10.0).width
    assert alone == pytest.approx(set_formula(boxes("-"), 10.0).width + set_formula(boxes("x"), 10.0).width)


@pytest.mark.parametrize("kind", ["pmatrix", "cases"])
def test_a_table_of_boxes_has_its_rows_and_columns(kind):
    found = boxes(rf"\begin{{{kind}}} a & b \\ c & d \\ e & f \end{{{kind}}}")
    assert isinstance(found, Fenced) and isinstance(found.body, Lines)
    assert [[cell.text for cell in row] for row in found.body.rows] == [["a", "b"], ["c", "d"], ["e", "f"]]


def test_a_picture_stands_in_the_room_it_has():
    """Its axes are as far from the picture's edges as it says, wherever on a page it stands."""
    picture = Illustration("p", "", (4.0, 3.0), (0.5, 0.25, 0.4, 0.1), lambda ax: ax.plot([0.0, 1.0], [0.0, 1.0]))
    figure = Figure(figsize=(8.0, 6.0))
    for x, y in ((0.0, 0.0), (1.5, 2.0)):
        place = painted(figure, picture, (x, y)).get_position().bounds
        assert place == pytest.approx(((x + 0.5) / 8.0, (y + 0.4) / 6.0, 3.25 / 8.0, 2.5 / 6.0))
    drawn = picture_svg(picture)
    (patch,) = re.findall(r'<g id="patch_2">\s*<path d="M ([\d.]+) ([\d.]+)', drawn)
    assert [float(each) for each in patch] == pytest.approx([0.5 * 72.0, (3.0 - 0.4) * 72.0], abs=1e-3)
