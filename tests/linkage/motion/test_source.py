"""Values and ratios written in another language say what `evaluate` says."""

import json
import shutil
import subprocess

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import DefinitionError, ForceElement, Load, drive_force, driving_force, ratio
from mechanisms.classics.stephenson_two import StephensonTwo
from mechanisms.three_point_hitch import ThreePointHitch
from tests.benchmarks.c_reference import POINTER, address, built, has_compiler
from tests.for_all import for_all

ASKED = ["G", ratio("G"), "tilt", ratio("tilt")]
DESIGN = {"OB": 0.31, "M": (0.22, 0.95)}


def arguments(text):
    """Return the design that a text's comment states, in its order."""
    stated = text[text.index("/* d: ") + 6 : text.index("; p: ")]
    return [float(part.rpartition(" = ")[2]) for part in stated.split(", ")]


@pytest.mark.skipif(not has_compiler(), reason="no C compiler")
def test_c_says_what_evaluate_says(tmp_path):
    hitch, S = ThreePointHitch(**DESIGN), np.linspace(0.0, 0.25, 50)
    text = hitch.source(ASKED, name="poses")
    out, design = np.empty((6, 50)), np.array(arguments(text))
    rows = [(POINTER * len(each))(*map(address, each)) for each in ([S], out)]
    built(text, "hitch", tmp_path)(50, address(design), *rows)
    assert_allclose(out, np.vstack(hitch.evaluate(ASKED, S=S)), rtol=1e-11, atol=1e-12)


@pytest.mark.skipif(shutil.which("node") is None, reason="no JavaScript")
def test_javascript_says_what_evaluate_says():
    hitch = ThreePointHitch(**DESIGN)
    text = hitch.source(ASKED, language="javascript", name="lift")
    call = f"{text}console.log(JSON.stringify(lift({arguments(text)}, [0.1])))"
    said = subprocess.run(["node", "-e", call], check=True, capture_output=True)
    assert_allclose(json.loads(said.stdout), hitch.function(ASKED)(0.1), rtol=1e-11)


def test_the_comment_states_the_design():
    assert "OB = 0.31" in ThreePointHitch(**DESIGN).source(["B"]).splitlines()[1]


@for_all(
    ("asked", "options", "said"),
    [
        (["G"], {"language": "rust"}, 'say "c" or "javascript"'),
        (["G"], {"name": "two words"}, "a function's name"),
        (["Q"], {}, "'Q' is unknown"),
        (["G"], {"name": "for"}, "'for' has a meaning in c already"),
        (["G"], {"name": "sin"}, "'sin' has a meaning in c"),
        (["G"], {"name": "class", "language": "javascript"}, "'class' has a meaning in javascript"),
        (None, {}, r"None: a list of what is asked for is expected, such as \["),
    ],
)
def test_what_cannot_be_written_is_refused(asked, options, said):
    with pytest.raises(DefinitionError, match=said):
        ThreePointHitch().source(asked, **options)


def test_a_batch_and_pins_found_by_iteration_are_refused_by_name():
    with pytest.raises(DefinitionError, match="one design"):
        ThreePointHitch(OB=[0.3, 0.31]).source(["G"])
    with pytest.raises(DefinitionError, match='Group\\("B F G"\\) is solved by iteration'):
        StephensonTwo().source(["psi"])
    assert "sqrt" not in StephensonTwo().source(["A"])


class Stop(ForceElement):
    """A weight that must not be lifted beyond a height."""

    places = ("point",)

    def __init__(self, point):
        self.point = point

    def loads(self, motion):
        if np.any(motion[self.point][1] > 0.9):
            raise DefinitionError("too high")
        return [Load(self.point, np.stack([0.0 * motion[self.point][0], -1e4 + 0.0 * motion[self.point][1]]))]


@pytest.mark.skipif(shutil.which("node") is None, reason="no JavaScript")
def test_a_thrust_is_nan_where_its_law_does_not_hold():
    hitch = ThreePointHitch()
    text = hitch.source([drive_force(loads=[Stop("G")])], language="javascript")
    calls = ", ".join(f"poses({arguments(text)}, [{S}])[0]" for S in (0.05, 0.25))
    said = subprocess.run(["node", "-e", f"{text}console.log({calls})"], check=True, capture_output=True, text=True).stdout.split()
    assert_allclose(float(said[0]), driving_force(hitch.at(S=0.05), [Stop("G")]), rtol=1e-12)
    assert said[1] == "NaN"


class Asked(ThreePointHitch):
    """The hitch, of which something has been asked before."""


class Fresh(ThreePointHitch):
    """The hitch, of which nothing has been asked."""


def test_the_text_does_not_follow_from_what_was_asked_before():
    Asked().source(["K", ratio("tilt")])
    assert Asked().source(["G"]) == Fresh().source(["G"])
