"""The arithmetic of files: what it means, how it is written back, and that hostile text is refused in words."""

from math import pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from linkage import DefinitionError, FileError
from linkage.files import from_dict, load, to_dict, to_json, to_toml
from linkage.files.expression import arrow_in, expression
from linkage.files.source import Names
from tests.for_all import for_all
from tests.linkage.files.file_machines import changed

NAMES = Names(
    {"S": "strokes", "L": "dimensions", "A": "ground", "O": "ground", "AO": "vectors"},
    {"S": "quantity", "L": "quantity", "A": "point", "O": "point", "AO": "vector"},
)

CALCULATED = {
    "2 * 3": 6.0, "2 ** 3 ** 2": 512.0, "-2 ** 2": -4.0, "(-2) ** 2": 4.0, "2 ** -1": 0.5, "7 - 2 - 1": 4.0, "8 / 4 / 2": 1.0,
    "--2": 2.0, "+2": 2.0, ".5e1": 5.0, "1 - -1": 2.0, "500 mm": 0.5, "500mm + 0.1 m": 0.6, "90 deg": pi / 2, "90 * deg": pi / 2,
    "2 * pi": 2 * pi, "10 kgf/cm2": 980665.0, "30°": pi / 6, "sqrt(9) + abs(-2)": 5.0, "atan2(1, 1)": pi / 4,
    "min(1, 2) - max(1, 2)": -1.0, "sin(30 deg) + cos(0) + tan(0)": 1.5, "exp(0) + log(1)": 1.0,
}  # fmt: skip

WRITTEN = {
    "L + S": "L + S", "L+(S-L)": "L + (S - L)", "(L+S)-L": "L + S - L", "L-(S+L)": "L - (S + L)", "2*3*S": "6.0 * S",
    "S*2*3": "S * 2.0 * 3.0", "-S*L": "(-S) * L", "-(S*L)": "-(S * L)", "-S**2": "-S ** 2.0", "(-S)**2": "(-S) ** 2.0",
    "(S**L)**S": "(S ** L) ** S", "S**L**S": "S ** (L ** S)", "S/(L/S)": "S / (L / S)", "-2**S": "-2.0 ** S", "(-2)**S": "(-2.0) ** S",
    "S--2": "S - -2.0", "S*-2": "S * -2.0", "- -S": "-(-S)", "angle(A,O)-90 deg": "angle(A, O) - 90 * deg",
    "abs(AO) + abs(S)": "abs(AO) + absolute(S)", "abs(Vector(A, O))": "abs(Vector(A, O))",
    "abs(Turn(AO, S, length=L))": "abs(Turn(AO, S, length=L))", "CosineAngle(abs(AO), L + S, 0.3)": "CosineAngle(abs(AO), L + S, 0.3)",
    "x(A) + y(A)": "x(A) + y(A)", "atan2(S, L)": "arctan2(S, L)", "distance(A, O) * min(S, L)": "distance(A, O) * minimum(S, L)",
}  # fmt: skip

PYTHON = [
    "__import__('os').system('id')", "__class__", "S.__class__", "().__class__", "lambda: 1", "lambda", "import os", "S.real", "S[0]",
    "[S]", "{S}", "S if L else S", "S := 1", "S = 1", "S == L", "S; L", "S\nL(", "`S`", "f'{S}'", "'S'", '"S"', "eval(S)", "exec(S)",
    "open(A)", "getattr(S, L)", "S(L)", "S // 2", "S % 2", "S @ L", "~S", "not S", "S and L", "S < L", "*S", "**S", "yield", "0x10",
    "1_000", "1j", "True", "None",
]  # fmt: skip
WRONG = [
    "sqrt", "sqrt()", "sqrt(S, L)", "sqrt(A)", "angle(S, L)", "angle(A)", "angle(A, O, O)", "angle(A O)", "x(AO)", "A + O", "AO", "A",
    "Turn(AO, S)", "Vector(A, O)", "abs(A)", "abs(angle)", "abs(Turn)", "abs(Turn(AO, S, length=L, length=L))", "CosineAngle(S)",
    "abs(Turn(AO, S, width=L))", "S +", "* S", "S S", "2 S", "S 2", "(S", "S)", "()", "", " ", ",", "S,", "1 mm 2", "1 furlong", "S mm",
    "1 kgf/cm2x", "1e", "Q", "sin(Q)", "Sqrt(S)",
]  # fmt: skip
NOT_FINITE = [
    "1e999", "nan", "inf", "-inf", "NaN", "9**9**9", "9**-9**9 ** 9 ** 99", "1/0", "0**-1", "(-1)**0.5", "log(0)", "log(-1)", "sqrt(-1)",
    "tan(1e400)", "2**1023 * 2", "1e308 t", "exp(1000)",
]  # fmt: skip
UNREADABLE = ["\0", "S\0", "é", "S\u200b", "\ud800", "\uff33", "\uff11", "S\x1b[2J", "\N{RIGHT-TO-LEFT OVERRIDE}S"]
LARGE = [
    "S" * 2000, "(" * 500 + "S" + ")" * 500, "-" * 500 + "S", "S" + "+S" * 400, "S" + "**S" * 99, "sqrt(" * 90 + "S" + ")" * 90, "1 " * 450,
    "(" * 50 + "S" + ")" * 50, "S" + "+S" * 101, "(" * 900,
]  # fmt: skip


@for_all("text", CALCULATED)
def test_numbers_are_calculated_at_once(text):
    found = expression(text, NAMES)
    assert found.is_constant
    assert found.number == pytest.approx(CALCULATED[text], rel=1e-15)


@for_all("text", WRITTEN)
def test_expression_is_written_as_it_is_read(text):
    assert str(expression(text, NAMES)) == WRITTEN[text]
    assert str(expression(WRITTEN[text], NAMES)) == WRITTEN[text]


@pytest.mark.parametrize("text", ["AO", "Vector(A, O)", "Turn(AO, -S)", "Turn(Turn(AO, S), S + 0.5, length=L * 2.0)"])
def test_vector_is_written_as_it_is_read(text):
    assert str(arrow_in(text, NAMES)) == text


@for_all("text", [*PYTHON, *WRONG, *NOT_FINITE, *UNREADABLE, *LARGE])
def test_hostile_expression_is_refused_in_words(text):
    with pytest.raises(DefinitionError) as caught:
        expression(text, NAMES)
    assert 10 < len(str(caught.value)) < 3000
    with pytest.raises(FileError, match=r"^the tables: outputs\.u: "):
        from_dict(changed("outputs", "u", to=text))


@for_all("text", ["S", "angle(A, O)", "L * AO", "Turn(AO)", "Turn(A, S)", "Vector(AO, A)", "AO + AO", "Q", "", "eval(AO)"])
def test_what_is_no_vector_is_refused(text):
    with pytest.raises(DefinitionError):
        arrow_in(text, NAMES)


def test_a_name_of_the_file_stands_before_a_unit():
    assert expression("2 * mm", NAMES).number == 0.002
    names = Names({"mm": "dimensions"}, {"mm": "quantity"})
    assert str(expression("2 * mm", names)) == "2.0 * mm"
    assert expression("2 mm", names).number == 0.002


atoms = st.sampled_from(["S", "L", "0.25", "3", "x(A)", "abs(AO)", "2 mm", "angle(A, O)", "1e-3"])
sums = st.recursive(
    atoms,
    lambda parts: st.tuples(parts, st.sampled_from(["+", "-", "*", "/", "**"]), parts).map(" ".join)
    | parts.map("-{}".format)
    | parts.map("({})".format)
    | parts.map("sqrt({})".format)
    | st.tuples(parts, parts, parts).map(lambda three: f"CosineAngle({', '.join(three)})"),
    max_leaves=12,
)


@given(sums)
def test_text_of_an_expression_is_stable(text):
    try:
        found = expression(text, NAMES)
    except DefinitionError as error:
        assert "no finite value" in str(error)
        return
    assert str(expression(str(found), NAMES)) == str(found)


python = st.recursive(
    st.sampled_from(["S", "L", "0.25", "3.0"]),
    lambda parts: st.tuples(parts, st.sampled_from(["+", "-", "*", "**"]), parts).map(" ".join)
    | parts.map("(-{})".format)
    | parts.map("({})".format),
    max_leaves=7,
)


@given(python)
def test_arithmetic_is_python_s(text):
    """What a file says is what the same text says in a class: the same brackets, the same calculation at once."""
    names = {"S": expression("S", NAMES), "L": expression("L", NAMES)}
    try:
        wanted = eval(text, names)
    except (ArithmeticError, DefinitionError):
        return
    if isinstance(wanted, complex):
        return
    written = str(wanted) if not isinstance(wanted, float) else repr(wanted)
    assert str(expression(text, NAMES)) == written


@given(st.floats(-1e11, 1e11))
def test_numbers_are_exact(value):
    assert expression(repr(value), NAMES).number == value
    machine = from_dict({"name": "A", "dimensions": {"L": value}, "ground": {"G": [value, -value]}})
    assert to_dict(load(to_toml(machine)))["ground"] == {"G": [value, -value]}
    assert load(to_json(machine)).plan.defaults["L"] == value
