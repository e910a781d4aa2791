"""What a report as PDF looks like: its paper, its letters, its colours, what it says of itself."""

import re
from zlib import decompress

import pytest

from linkage import Crank, Ground, Mechanism, Stroke, Weight
from linkage.documents.pdf import HIGH, Flow, pdf
from linkage.documents.reporting import report_document
from linkage.verdict import Verdict


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


@pytest.fixture(scope="module", params=[Boom, Weak])
def written(request):
    """A machine's class, its report, and what is drawn on the pages as text."""
    content = pdf(report_document(request.param()))
    streams = []
    for found in re.finditer(rb"stream\r?\n(.*?)\r?\nendstream", content, re.DOTALL):
        try:
            streams.append(decompress(found[1]))
        except Exception:
            continue  # a font or a picture
    return request.param, content, "\n".join(each.decode("latin1") for each in streams if b"Tf" in each)


def colours(text, operator):
    """Return the colours that are set, as a page writes them."""
    found = re.findall(rf"([\d.]+)\s([\d.]+)\s([\d.]+)\s{operator}\b", text)
    return {"#" + "".join(f"{round(255 * float(part)):02x}" for part in each) for each in found}


def test_the_paper_is_a4_and_the_file_says_what_it_is(written):
    kind, content, _ = written
    assert set(re.findall(rb"/MediaBox ?\[ ?([\d. ]+?) ?\]", content)) == {b"0 0 595.276 841.89"}
    assert b"/Creator (hydrolinkage)" in content and b"/Producer (hydrolinkage)" in content
    assert f"/Title ({kind.__name__})".encode() in content
    assert b"/CreationDate" not in content


def test_letters_and_rules_have_their_colours(written):
    kind, _, drawn = written
    assert {"#1c2733", "#5d6975", "#eef2f5"} <= colours(drawn, "rg")  # words, what stands behind, heads of tables
    assert {"#1c2733", "#b9c2ca"} <= colours(drawn, "RG")  # the line below a title, those of tables
    assert ("#b3261e" in colours(drawn, "rg")) == (kind is Weak)  # what fails
    assert "#1d6b35" in colours(drawn, "rg")  # what holds


def test_title_text_and_margins(written):
    _, _, drawn = written
    title = drawn[: drawn.index("Tf")]
    assert re.search(r"1 0 -?0 1 57 776\.89 cm", title)  # 20 mm from the left, 17 points below the upper margin
    sizes = [float(each) for each in re.findall(r"/F\d+ ([\d.]+) Tf", drawn)]
    assert (sizes[0], max(sizes)) == (17.0, 17.0)
    assert {8.8, 11.5} <= set(sizes)


def test_every_page_has_its_foot_below_all_else_and_off_the_edge():
    document = report_document(Boom())
    pages = Flow(document).pages
    for number, page in enumerate(pages, 1):
        (drawn,) = page.figure(document, number, len(pages)).artists
        *_, line, words, of = drawn.ink
        assert of.text == f"page {number} of {len(pages)}" and words.y == of.y
        assert 20.0 <= HIGH - of.y <= 40.0  # printers leave a margin of some 6 mm
        assert all(y < of.y for _, y in line.points)
