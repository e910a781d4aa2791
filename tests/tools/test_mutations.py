"""The mutants themselves: each changes one place and nothing else, and words and types are left alone."""

import ast

from tests.for_all import for_all
from tests.tools.mutants import ROOMS, ROOT, by_file, matching, room_of
from tests.tools.mutations import Mutant, mutants

SOURCE = '''"""A docstring with 1 < 2 and a - b."""

from typing import TypeAlias

Number: TypeAlias = int | float


class Rod:
    """Length 3."""

    size: float = 2.0

    def __repr__(self) -> str:
        return f"Rod({self.size + 1})"

    def reach(self, more: int | None = None) -> float:
        """Return 1 + 2."""
        if more is None:
            raise ValueError(f"more = {more + 1} is missing: {self.size - 1}")
        self.size = more
        words = "short" if more < 0 else f"long {more * 2}"
        return min(self.size * 3.0, -1e-9, len(words))
'''


def spelled(mutant):
    """Return the line that a mutant changes, as it is then."""
    return mutant.new.splitlines()[mutant.line - 1].strip()


def test_each_kind_of_change_is_made():
    assert {spelled(mutant) for mutant in mutants("rod.py", SOURCE)} == {
        "size: float = 3.0",
        "size: float = 1.0",
        "if (more is not None):",
        "pass",
        'words = "short" if (more <= 0) else f"long {more * 2}"',
        'words = "short" if (more > 0) else f"long {more * 2}"',
        'words = "short" if more < 1 else f"long {more * 2}"',
        'words = "short" if more < (-1) else f"long {more * 2}"',
        "return max(self.size * 3.0, -1e-9, len(words))",
        "return min((self.size / 3.0), -1e-9, len(words))",
        "return min(self.size * 4.0, -1e-9, len(words))",
        "return min(self.size * 1.5, -1e-9, len(words))",
        "return min(self.size * 3.0, 1e-09, len(words))",
        "return min(self.size * 3.0, -1.0000000000000002e-06, len(words))",
        "return min(self.size * 3.0, -1.0000000000000002e-12, len(words))",
    }


def test_words_and_types_are_left_alone():
    for mutant in mutants("rod.py", SOURCE):
        assert mutant.line not in (1, 3, 5, 9, 13, 14, 17), mutant.diff()


def test_a_mutant_is_one_line_of_a_source_and_says_so():
    path = "linkage/steps/sliders.py"
    text = (ROOT / path).read_text(encoding="utf-8")
    found = mutants(path, text)
    assert len(found) > 30
    ast.parse(found[0].new)
    for mutant in found:
        assert mutant.old == text != mutant.new
        assert len([line for line in mutant.diff().splitlines() if line.startswith("-")]) >= 1
        assert all(line[0] in "+-" for line in mutant.diff().splitlines())


@for_all("room", ROOMS)
def test_rooms_are_there(room):
    assert list((ROOT / room).rglob("*.py")) and room_of(f"{room}/any.py") == room


def test_tests_that_run_the_line_come_first_and_the_quick_ones_before_the_slow():
    seen = {"a.py": [3]}
    found = {
        "t1": {"tests": {"t1::a": {"seconds": 5.0, "lines": seen}, "t1::b": {"seconds": 0.1, "lines": {}}}, "collection": seen},
        "t2": {"tests": {"t2::c": {"seconds": 0.2, "lines": seen}, "t2::d": {"seconds": 40.0, "lines": seen}}, "collection": {}},
    }
    lots = matching(Mutant("a.py", 3, "line", "", ""), found, 20.0)
    assert lots == [["t2::c", "t1::b"], ["t1::a"]]
    assert by_file(["t1::a", "t2::c", "t1::b"]) == ["t1::a", "t1::b", "t2::c"]
