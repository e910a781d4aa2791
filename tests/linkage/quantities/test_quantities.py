"""Scalars of a mechanism: arithmetic, NumPy's functions, how they print, and what is refused."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from linkage import Crank, DefinitionError, Dimension, Ground, Mechanism, SingularError, Stroke, ref
from tests.for_all import for_all

POSITIVE = st.floats(0.1, 3.0)


class Scalars(Mechanism):
    """Arithmetic of two strokes and a dimension."""

    S, T, L = Stroke(0.1, 1.0), Stroke(0.2, 2.0), Dimension(1.5)
    linear = 2 * S - T / 4 + L - 1
    nested = -(S - (T - L)) * (S + 1) / (2 - (T - 3))
    powers = S**2 + 2**T + T**-1 + S**0.5 + L**S
    numpys = (
        np.sqrt(S * T) + np.exp(S) * np.log(T) + np.arctan2(S, T) + np.minimum(S, T) + np.maximum(S, L) + np.sin(S) - np.cos(T) * np.tan(S)
    )
    sign = abs(S - T) + np.absolute(T - L)
    left = np.float64(2) * S + np.float64(1) - np.float64(3) / T + np.float64(2) ** S
    total = sum([S, T, L])


EXPECTED = {
    "linear": lambda S, T, L: 2 * S - T / 4 + L - 1,
    "nested": lambda S, T, L: -(S - (T - L)) * (S + 1) / (2 - (T - 3)),
    "powers": lambda S, T, L: S**2 + 2**T + T**-1 + S**0.5 + L**S,
    "numpys": lambda S, T, L: (
        math.sqrt(S * T) + math.exp(S) * math.log(T) + math.atan2(S, T) + min(S, T) + max(S, L) + math.sin(S) - math.cos(T) * math.tan(S)
    ),
    "sign": lambda S, T, L: abs(S - T) + abs(T - L),
    "left": lambda S, T, L: 2 * S + 1 - 3 / T + 2**S,
    "total": lambda S, T, L: S + T + L,
}


@given(POSITIVE, POSITIVE, POSITIVE)
def test_arithmetic_is_that_of_floats(S, T, L):
    motion = Scalars(L=L).at(S=S, T=T)
    for name, rule in EXPECTED.items():
        assert float(motion[name]) == pytest.approx(rule(S, T, L), rel=1e-13, abs=1e-13)


@for_all("name", EXPECTED)
@for_all("stroke", ["S", "T"])
def test_ratios_of_arithmetic_are_exact(name, stroke):
    at, h = dict(S=0.4, T=0.9), 1e-6
    up, down = ({**at, stroke: at[stroke] + sign * h} for sign in (1, -1))
    slope = (EXPECTED[name](**up, L=1.5) - EXPECTED[name](**down, L=1.5)) / (2 * h)
    assert_allclose(Scalars().at(**at).ratio(name, wrt=stroke), slope, rtol=1e-8)
    assert_allclose(Scalars().sweep(S=30, T=0.9).ratio(name, wrt=stroke).shape, (30,))


@pytest.mark.parametrize("name", ["powers", "numpys"])
def test_mixed_second_derivative(name):
    h = 1e-4
    motion = Scalars().at(S=0.4, T=0.9)
    rates = dict(S=1.0, T=2.0)
    f = EXPECTED[name]
    second = (f(0.4 + h, 0.9 + 2 * h, 1.5) - 2 * f(0.4, 0.9, 1.5) + f(0.4 - h, 0.9 - 2 * h, 1.5)) / h**2
    assert_allclose(motion.acceleration(name, rates), second, rtol=1e-5)


@for_all(
    ("expression", "text"),
    [
        (ref("L0") + ref("S"), "L0 + S"),
        (ref("a") - (ref("b") - ref("c")), "a - (b - c)"),
        (-(ref("a") + ref("b")) * 2, "(-(a + b)) * 2.0"),
        (ref("a") / (ref("b") * ref("c")), "a / (b * c)"),
        ((ref("a") + 1) ** 2, "(a + 1.0) ** 2.0"),
        (np.sqrt(ref("a") ** 2 + ref("b") ** 2), "sqrt(a ** 2.0 + b ** 2.0)"),
    ],
)
def test_expression_prints_as_it_is_written(expression, text):
    assert str(expression) == text


@given(
    st.recursive(
        st.sampled_from(["S", "T", "L"]).map(ref) | st.floats(0.5, 2).map(lambda each: 0 * ref("S") + each),
        lambda parts: st.tuples(st.sampled_from("+-*/"), parts, parts).map(
            lambda each: eval(f"a {each[0]} b", {"a": each[1], "b": each[2]})
        ),
        max_leaves=8,
    )
)
def test_printed_expression_reads_back(expression):
    S, T, L = 0.4, 0.9, 1.5
    made = type("Made", (Mechanism,), {"S": Stroke(0, 1), "T": Stroke(0, 1), "L": Dimension(L), "u": expression})
    try:
        wanted = eval(str(expression), {"S": S, "T": T, "L": L})
    except ZeroDivisionError:
        return
    assert float(made().at(S=S, T=T)["u"]) == pytest.approx(wanted, rel=1e-9, abs=1e-9)


@for_all("bad", [math.nan, math.inf, -math.inf, 10**400, None, True, 1j, [1, 2], np.array([1.0, 2.0]), object()])
def test_what_is_no_number_cannot_be_added(bad):
    for operate in (lambda: ref("S") + bad, lambda: ref("S") * bad, lambda: ref("S") ** bad):
        with pytest.raises(DefinitionError):
            operate()


@for_all("bad", ["", "a b", "1a", None, 3, ["S"]])
def test_ref_wants_a_name(bad):
    with pytest.raises(DefinitionError):
        ref(bad)


@pytest.mark.parametrize("function", [np.arccos, np.floor, np.isnan, np.hypot])
def test_function_that_is_not_provided_lists_those_that_are(function):
    with pytest.raises(DefinitionError, match="use one of: sqrt"):
        function(*[ref("S")] * function.nin)


def test_function_with_options_is_refused():
    with pytest.raises(DefinitionError):
        np.sqrt(ref("S"), out=np.zeros(1))


@for_all(
    "ends", [(0, 0), (0, math.nan), (math.inf, 1), ("0", 1), (None, 1), ([0], 1), (0, 1j), (False, True), (0, 10**400)]
)
def test_stroke_needs_two_different_finite_ends(ends):
    with pytest.raises(DefinitionError):
        Stroke(*ends)


@for_all("bad", [math.nan, math.inf, "1", None, [1.0], 1j, True, 10**400, np.array([1.0, 2.0])])
def test_dimension_needs_a_finite_number(bad):
    with pytest.raises(DefinitionError):
        Dimension(bad)


@for_all("kind", [int, float, np.float64, np.float32, np.int32])
def test_numbers_of_all_kinds_are_numbers(kind):
    assert Dimension(kind(2)).default == 2
    assert Stroke(kind(0), kind(2)).end == 2
    assert Ground(kind(1), kind(2)).y.number == 2.0


@pytest.mark.parametrize("name", ["log", "inverse", "root"])
def test_output_without_a_value_is_refused_or_nan_as_asked(name):
    class Poles(Mechanism):
        """Outputs that have no value everywhere."""

        S = Stroke(-1.0, 1.0)
        log, inverse, root = np.log(S), 1 / S, S**0.5

    with pytest.raises(SingularError, match=name):
        Poles().sweep(5)[name]
    found = Poles().sweep(5, unreachable="nan")[name]
    assert np.isnan(found).any()
    assert not np.isinf(found).any()


def test_what_named_quantities_are_built_on_is_known_by_their_names():
    """Forty doublings, each of the one before twice over: 2^40 parts, were they not known by name."""
    quantities = {"q0": ref("S") + 1.0} | {f"q{k + 1}": (ref(f"q{k}") + ref(f"q{k}")) * 0.5 for k in range(40)}
    points = {"S": Stroke(0.0, 1.0), "O": Ground(0.0, 0.0), "A": Crank("O", OA=0.3, angle="S")}
    machine = type("Chained", (Mechanism,), quantities | points)()
    assert machine.evaluate(["q40"], S=0.25)[0] == 1.25
    assert machine.evaluate([machine.plan.members["q40"]], S=0.25)[0] == 1.25
