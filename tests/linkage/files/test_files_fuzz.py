"""Whatever the bytes: a file is read, or refused by one of the framework's own errors; what was read can be written and read again."""

import warnings
from copy import deepcopy
from importlib.metadata import entry_points
from pathlib import Path

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from linkage import AssemblyError, DefinitionError, FileError
from linkage.files import from_dict, load, to_dict, to_toml
from linkage.files.source import decoded
from tests.linkage.files.file_machines import Drawn, EveryStep, Hitch, Loaded, Parts

SHIPPED = [point.load() for point in entry_points(group="hydrolinkage.machines") if point.name in ("three_point_hitch", "header_balancer")]
SAMPLES = [to_dict(each) for each in (Hitch, EveryStep, Parts, Drawn, Loaded, *SHIPPED)]
TEXTS = [to_toml(each) for each in (Hitch, EveryStep, Parts, Loaded, *SHIPPED)]
TEXTS += [file.read_text(encoding="utf-8") for file in sorted((Path(__file__).parents[1] / "data").glob("*.toml"))]

TOKENS = st.sampled_from([
    "S", "L0", "A", "B", "O", "AO", "angle", "distance", "(", ")", ",", "+", "-", "*", "/", "**", "1", "0", "2.5", "1e300", "1e-300", "deg",
    "mm", "bar", "kg", "l", "m1", "nan",
    "CosineAngle", "abs", "sqrt", "Turn", "Vector", "length", "=", "phi", "x", "y", "pi", "log", "exp", "min",
])  # fmt: skip
EXPRESSIONS = st.lists(TOKENS, max_size=12).map(" ".join) | st.sampled_from([
    "S / 0", "1 / (S - S)", "log(S - S)", "sqrt(S - 1)", "S * 1e200 * 1e200", "tan(90 deg)", "S ** 1000", "x(B)", "angle(B, C)", "0 * S",
    "CosineAngle(S, S, S)",
])  # fmt: skip
NUMBERS = st.floats() | st.integers() | st.sampled_from([0, 1e308, -1e308, 1e-308, 1e150, -0.0, 1e-12, 2**2000])
WORDS = st.text(max_size=5) | st.sampled_from(
    ["A", "S", "LEFT", "rail", "AO", "O B", "arm", "load", "lift", "rod", "isothermal", "real_nitrogen"]
)
LEAVES = NUMBERS | EXPRESSIONS | WORDS | st.none() | st.booleans() | st.binary(max_size=3)
VALUES = st.recursive(LEAVES, lambda parts: st.lists(parts, max_size=3) | st.dictionaries(WORDS, parts, max_size=3), max_leaves=4)
KEYS = st.sampled_from([
    "S", "A", "OB", "P", "self", "labels", "bare", "at", "near", "side", "__class__", "plan", "doc", "order", "Crank", "", "\0",
    "parents", "Weight", "Cylinder", "FloatCircuit", "mass", "gravity", "scale", "only", "gas", "law", "n", "count", "works",
    "loads", "cases",
])  # fmt: skip


def settled(read, given_):
    """Read it; what was read is written and read back. Every error must be one of the three."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            machine = read(given_)
        except (FileError, DefinitionError, AssemblyError) as error:
            assert str(error)
            return
        text = to_toml(machine)
        again = load(text)
    assert str(again.plan) == str(machine.plan)
    assert to_toml(again) == text


@st.composite
def broken_tables(draw, sections=()):
    """Return the tables of a sound mechanism with a few things put wrong, in some of its sections only."""
    tables = deepcopy(draw(st.sampled_from(SAMPLES if not sections else [each for each in SAMPLES if "loads" in each])))
    for _ in range(draw(st.integers(1, 3))):
        node = tables[draw(st.sampled_from([name for name in sections if name in tables]))] if sections else tables
        if not node:
            break
        while True:
            key = draw(st.sampled_from(list(node) if isinstance(node, dict) else range(len(node))))
            inner = node[key]
            if not (isinstance(inner, (dict, list)) and inner and draw(st.integers(0, 5))):
                break
            node = inner
        what = draw(st.integers(0, 3))
        if what == 0:
            del node[key]
        elif what == 1 and isinstance(node, dict):
            node[draw(KEYS)] = draw(VALUES)
        else:
            node[key] = draw(VALUES)
        if not tables:
            break
    return tables


@st.composite
def broken_text(draw):
    """Return the text of a sound file with a few places changed."""
    text = draw(st.sampled_from(TEXTS))
    for _ in range(draw(st.integers(1, 4))):
        start, length = draw(st.integers(0, len(text))), draw(st.integers(0, 20))
        other = draw(st.integers(0, len(text)))
        text = text[:start] + draw(st.sampled_from(["", text[other : other + 30]]) | st.text(max_size=4)) + text[start + length :]
    return f"{text}\n"


@given(broken_tables())
def test_broken_tables(tables):
    settled(from_dict, tables)


@given(broken_tables(("loads", "cases", "hydraulics")))
def test_broken_loads(tables):
    settled(from_dict, tables)


@given(broken_text())
def test_broken_text(text):
    settled(load, text)


@given(st.binary(max_size=200) | broken_text().map(lambda text: text.encode("utf-16", "surrogatepass")), st.booleans())
@example(b"\xff\xfe", False)
@example(b"", True)
def test_any_bytes(raw, is_json):
    try:
        found = decoded("a file", raw, is_json)
    except FileError:
        return
    settled(from_dict, found.data)


@given(VALUES)
def test_anything_at_all(value):
    settled(from_dict, value)


@pytest.mark.slow
@given(EXPRESSIONS)
def test_any_expression_as_an_output_and_as_a_length(text):
    for path in ("outputs", "u"), ("points", "B", "AB"), ("points", "G", "KFG"), ("ground", "A"):
        tables = deepcopy(SAMPLES[0])
        node = tables
        for part in path[:-1]:
            node = node[part]
        node[path[-1]] = [text, 0.5] if path[0] == "ground" else text
        settled(from_dict, tables)


def test_numpy_numbers_are_numbers():
    tables = deepcopy(SAMPLES[0])
    tables["points"]["B"]["OB"] = np.float64(0.3)
    tables["strokes"]["S"] = [np.float64(0.0), np.float32(0.25)]
    assert to_toml(from_dict(tables)) == TEXTS[0]
