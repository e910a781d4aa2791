"""Wrong uses of everything that is public: each is refused by a deliberate error, whose words say what, where and the remedy."""

import contextlib
import pickle
import sys
import textwrap
import warnings
from pathlib import Path

import pytest

from linkage import LinkageError
from linkage.cli import main
from tests.for_all import for_all
from tests.uses import of_commands, of_hydraulics, of_linkage, of_mechanisms, of_overs
from tests.uses.machines import NAMES, bar4, lifting, motion, quick

LONGEST = 700
"""Characters of a message; what was given and the names that there are may be long, the rest is two plain sentences."""


@pytest.fixture(scope="module", autouse=True)
def here(tmp_path_factory):
    """Return an empty folder, made the current one: nothing may be written where it was refused."""
    with contextlib.chdir(tmp_path_factory.mktemp("here")):
        yield Path.cwd()


def cases(uses):
    """Return each use as a call and the words of its message."""
    return [(call.replace("@", given.strip()), words) for call, values, words in uses for given in values.split(";")]


ALL = [*cases(of_linkage.USES), *cases(of_hydraulics.USES), *cases(of_mechanisms.USES), *cases(of_overs.USES)]


@for_all(("call", "words"), ALL, ids=[call for call, _ in ALL])
def test_a_wrong_use_is_refused_in_words(call, words, here):
    before = {*here.iterdir()}
    with pytest.raises(LinkageError) as caught:
        eval(call, dict(NAMES))
    said = " ".join(str(caught.value).split())
    assert not [each for each in words if each not in said], said
    assert len(said) < LONGEST and {*here.iterdir()} == before


def test_no_use_stands_twice():
    assert len({call for call, _ in ALL}) == len(ALL) and all(words for _, words in ALL)


@for_all(
    ("ask", "words"),
    [
        (lambda: motion.G, ("A motion has no attribute 'G'", 'motion["G"]')),
        (lambda: motion.tilt, ("A motion has no attribute 'tilt'", 'motion["tilt"]')),
        (lambda: motion.position, ("A motion has no attribute 'position'", "motion[name]")),
        (lambda: lifting.OB, ("Lift has no attribute 'OB'", 'machine["OB"]')),
        (lambda: lifting.ratio, ("Lift has no attribute 'ratio'",)),
    ],
)
def test_what_is_no_attribute_is_told_with_its_remedy(ask, words):
    with pytest.raises(AttributeError) as caught:
        ask()
    assert all(each in str(caught.value) for each in words)


def test_membership_is_that_of_what_can_be_asked_for():
    assert all(name in motion for name in ("S", "G", "tilt", "arm", "L0"))
    assert not any(name in motion for name in ("Q", "load", "lift", "transport", 0, None, ("S",)))
    assert all(name in lifting for name in ("OB", "BO", "L0", "A", "A.x", "load.mass"))
    assert not any(name in lifting for name in ("S", "G", "tilt", 0, None))


def test_a_function_of_poses_goes_to_another_process_and_back():
    assert pickle.loads(pickle.dumps(quick))(0.3) == quick(0.3)
    asked = lifting.function(each for each in ["G", "tilt"])
    assert pickle.loads(pickle.dumps(asked))(0.1) == asked(0.1)


def test_a_subclass_with_arguments_of_its_own_is_varied_like_any_other():
    class Sized(type(bar4)):
        def __init__(self, size):
            super().__init__(OA=size, CB=2.5 * size)

    small = Sized(0.9)
    assert small.replaced(AB=3.1)["AB"] == 3.1 and small.replaced(AB=3.1)["OA"] == 0.9
    assert type(small.replaced(OA=1.0)) is Sized


OWN = {
    "lever.py": """
        from linkage import *
        class Lever(Mechanism):
            S = Stroke(0.5, 0.7)
            A, O = Ground(0.0, 0.0), Ground(0.6, 0.0)
            B = Dyad(A, O, AB=S, OB=0.2, side=RIGHT)
            turn = angle(O, B)
    """,
    "leaves.py": "import sys\nsys.exit('done')",
    "leaves0.py": "raise SystemExit",
    "typo.py": "from linkage import *\nclass Lever(Mechanism)\n    pass",
    "slip.py": "from linkage import *\n1 / 0",
    "empty.py": "",
    "member.py": """
        from linkage import *
        class Lever(Mechanism):
            S = Stroke(0.5, 0.7)
            A, O = Ground(0.0, 0.0), Ground((0.6, 0.0))
    """,
    "comma.py": """
        from linkage import *
        class Lever(Mechanism):
            S = Stroke(0.5, 0.7)
            A, O = Ground(0.0, 0.0), Ground(0.6, 0.0)
            B = Dyad(A, O, AB=S, OB=0.2, side=RIGHT),
    """,
    "three.py": """
        from lever import Lever as Plain
        class Lever(Plain):
            def columns(self, motion):
                return 3
    """,
    "raises.py": """
        from lever import Lever as Plain
        class Lever(Plain):
            def columns(self, motion):
                return motion.nothing
    """,
    "verdict.py": """
        from lever import Lever as Plain
        class Lever(Plain):
            def rules(self, motion):
                return 3
    """,
    "bad.toml": "name = 3",
    "bad.json": "{",
    "values.csv": "R_y, mm\n3",
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Return a folder with a user's own files."""
    place = tmp_path_factory.mktemp("own")
    for name, text in OWN.items():
        (place / name).write_text(textwrap.dedent(text), encoding="utf-8")
    return place


COMMANDS = cases(of_commands.USES)


@pytest.mark.parametrize(("command", "words"), COMMANDS, ids=[command for command, _ in COMMANDS])
def test_a_wrong_command_ends_with_one_line_and_exit_code_2(command, words, folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    monkeypatch.syspath_prepend(str(folder))
    monkeypatch.delitem(sys.modules, "lever", raising=False)
    before = files_of(folder)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        code = main(command.split())
    said = capsys.readouterr().err
    line = said.strip().splitlines()[-1]
    assert code == 2 and line.startswith("hydrolinkage: ") and "Traceback" not in said, said
    assert not [each for each in words if each not in line], line
    assert files_of(folder) == before


def files_of(folder):
    """Return the names of the files in a folder."""
    return sorted(each.name for each in folder.iterdir() if each.is_file())
