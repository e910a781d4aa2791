"""Quantities with units, as the command and the files read them."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from linkage import DefinitionError, units
from linkage.units import UNITS, parse, show


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("180mm", 0.18),
        ("180 mm", 0.18),
        ("-75 deg", -75 * math.pi / 180),
        ("-75°", -75 * math.pi / 180),
        ("0.18", 0.18),
        (".5e1 cm", 0.05),
        ("+2 t", 2000.0),
        ("155 kgf/cm2", 155 * 98066.5),
        ("210 bar", 21e6),
        (" 4 l ", 4e-3),
    ],
)
def test_text_becomes_si(text, value):
    assert parse(text) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize("text", ["", "mm", "1,5 mm", "1 2", "1mm2mm", "nan", "inf", "1e400", "0x10", "--1", "1 parsec", "1 MM", "1_000"])
def test_what_is_no_quantity_is_refused(text):
    with pytest.raises(DefinitionError):
        parse(text)


@pytest.mark.parametrize(("text", "kind"), [("3 bar", "length"), ("3 mm", "angle"), ("3 kg", "force")])
def test_unit_of_another_kind_is_refused_with_the_valid_ones(text, kind):
    valid = [name for name, (_, what) in UNITS.items() if what == kind]
    with pytest.raises(DefinitionError, match=valid[0]):
        parse(text, kind)


@given(st.floats(-1e6, 1e6), st.sampled_from(sorted(UNITS)))
def test_shown_value_reads_back(value, unit):
    assert parse(show(value, unit, digits=17)) == pytest.approx(value, rel=1e-14, abs=1e-300)


def test_unknown_unit_is_named():
    with pytest.raises(DefinitionError, match="furlong"):
        show(1.0, "furlong")


@pytest.mark.parametrize(
    ("left", "right"),
    [(units.bar, 1e5 * units.Pa), (units.kgf_cm2, 98066.5), (units.litre, 1000 * units.cm3), (units.MPa, units.N / units.mm**2)],
)
def test_units_agree_with_each_other(left, right):
    assert left == pytest.approx(right, rel=1e-15)
