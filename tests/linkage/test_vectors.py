"""The plane's algebra against complex numbers."""

import cmath

import pytest
from hypothesis import given
from hypothesis import strategies as st

from linkage import LEFT, RIGHT
from linkage.vectors import Line, Vec

FINITE = st.floats(-1e3, 1e3)
VECTORS = st.builds(Vec, FINITE, FINITE)


def as_complex(v):
    return complex(v.x, v.y)


@given(VECTORS, VECTORS)
def test_products_are_those_of_complex_numbers(v, w):
    product = as_complex(v).conjugate() * as_complex(w)
    assert v.dot(w) == pytest.approx(product.real, abs=1e-9)
    assert v.cross(w) == pytest.approx(product.imag, abs=1e-9)


@given(VECTORS, st.floats(-10, 10))
def test_turning_keeps_the_length_and_adds_the_angle(v, angle):
    spin = cmath.exp(1j * angle)
    turned = v.turned(spin.real, spin.imag)
    assert as_complex(turned) == pytest.approx(as_complex(v) * spin, abs=1e-9)
    assert turned.length() == pytest.approx(v.length(), abs=1e-9)


@given(VECTORS)
def test_left_is_a_quarter_turn(v):
    assert as_complex(v.left()) == as_complex(v) * 1j
    assert v.cross(v.left()) == pytest.approx(v.square())


def test_line_goes_through_its_origin():
    line = Line(Vec(1.0, 2.0), Vec(0.6, 0.8))
    assert as_complex(line.at(0.0)) == 1 + 2j
    assert as_complex(line.at(5.0)) == 4 + 6j


def test_sides_are_opposite_and_say_their_name():
    assert LEFT == -RIGHT
    assert (str(LEFT), str(RIGHT)) == ("LEFT", "RIGHT")
