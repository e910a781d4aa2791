"""The table "where is ..." of docs/design.md names one place a question, and each is there."""

import re
from pathlib import Path

from tests.for_all import for_all

ROOT = Path(__file__).parent.parent
TITLE = "## Where is ..."


def rows():
    """Return the table's rows: question, file, names."""
    text = (ROOT / "docs/design.md").read_text(encoding="utf-8")
    table = text[text.index(TITLE) :].partition("\n## ")[0] if TITLE in text else ""
    found = re.findall(r"^\| (.+?) \| `([^`]+)` \| (.+?) \|$", table, re.MULTILINE)
    return [(question, file, re.findall(r"`([^`]+)`", names)) for question, file, names in found]


ROWS = rows()


def test_the_table_answers_many_questions_once():
    questions = [question for question, _, _ in ROWS]
    assert len(questions) >= 25
    assert len(set(questions)) == len(questions)


@for_all(("file", "names"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_each_place_is_there(file, names):
    """A name is defined there: a class, a function, a constant; in what is no Python it stands there."""
    text = (ROOT / file).read_text(encoding="utf-8")
    assert names
    for name in names:
        is_defined = re.compile(rf"^(?: *(?:async )?def |class |)({re.escape(name)})\b(?=[(:\[ =])", re.MULTILINE)
        assert is_defined.search(text) if file.endswith(".py") else name in text, f"docs/design.md says that {name} is in {file}"
