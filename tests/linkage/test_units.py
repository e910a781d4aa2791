"""Quantities with units, as the command and the files read them."""

import math
from importlib.util import module_from_spec, spec_from_file_location

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from linkage import Column, Crank, DefinitionError, Dimension, ForceElement, Ground, Load, Mechanism, Stroke, page, report, units
from linkage.files import load, to_toml
from linkage.plan import plan_measure
from linkage.reports import text_table
from linkage.units import SYSTEMS, UNITS, current_system, decimals, parse, parse_span, show, shown_in, shown_number, unit_system
from tests.for_all import for_all


@for_all(
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


@for_all("text", ["", "mm", "1,5 mm", "1 2", "1mm2mm", "nan", "inf", "1e400", "0x10", "--1", "1 parsec", "1 MM", "1_000"])
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


# -- systems of units --------------------------------------------------------------------------------------


@for_all(
    ("text", "value"),
    [
        ("3000 psi", 3000 * 6894.757293168361),
        ("1 lbf", 4.4482216152605),
        ("12 in", 0.3048),
        ("1 ft", 0.3048),
        ("1 lb", 0.45359237),
        ("1 lbf ft", 1.3558179483314004),
        ("1 kgf m", 9.80665),
        ("1 gal", 3.785411784e-3),
        ("10 gal/min", 10 * 3.785411784e-3 / 60),
        ("60 l/min", 1e-3),
        ("1 lbf/in", 175.12683524647636),
        ("1 hp", 745.6998715822702),
    ],
)
def test_units_of_pounds_and_inches_are_read(text, value):
    """The factors as NIST SP 811, appendix B.8, prints them."""
    assert parse(text) == pytest.approx(value, rel=1e-12)


def test_a_system_has_one_known_unit_for_every_measure():
    spec = spec_from_file_location("linkage.units_as_shipped", units.__file__)  # other tests add units to the table
    shipped = module_from_spec(spec)
    spec.loader.exec_module(shipped)
    for name, system in shipped.SYSTEMS.items():
        assert {shipped.UNITS[unit][1] for unit in system.values()} == set(system), name
        assert set(system) == set(shipped.SYSTEMS["si"])


def test_without_a_system_everything_keeps_its_unit():
    assert [show(0.18, unit) for unit in ("mm", "m", "inch")] == ["180 mm", "0.18 m", "7.08661 inch"]
    with unit_system("us"), unit_system(None):
        assert show(0.18, "mm") == "180 mm" and current_system() == ""


@for_all(
    ("system", "value", "unit", "digits", "text"),
    [
        ("si", 155 * units.kgf_cm2, "kgf/cm2", 4, "15.2 MPa"),
        ("bar-mm", 155 * units.kgf_cm2, "kgf/cm2", ".1f", "152.0 bar"),
        ("us", 155 * units.kgf_cm2, "kgf/cm2", ".1f", "2205 psi"),
        ("us", 1e9, "bar", 4, "145038 psi"),
        ("kgf", 9.0e3, "kN", ".2f", "918 kgf"),
        ("si", 0.5660, "m", ".4f", "566.0 mm"),
        ("us", 0.5660, "m", ".4f", "22.283 in"),
        ("us", 0.0123, "mm", "+.0f", "+0.48 in"),
        ("si", -1e-9, "mm", "z.0f", "0 mm"),
        ("us", 1.5, "", ".2f", "1.50"),
        ("us", 2.0, "s", ".1f", "2.0 s"),
    ],
)
def test_a_number_is_shown_in_the_system_as_fine_as_before(system, value, unit, digits, text):
    with unit_system(system):
        assert show(value, unit, digits) == text
        assert shown_number(value, unit, digits) == text.split()[0]


@given(st.sampled_from([*UNITS]), st.sampled_from([*SYSTEMS]), st.integers(0, 6), st.floats(-1e4, 1e4))
def test_what_is_shown_is_what_it_was_within_its_digits(unit, system, digits, number):
    """Read back, a shown number differs by less than half of its last digit, and that digit is not coarser than asked for by half."""
    value = number * UNITS[unit][0]
    with unit_system(system):
        text, name, places = show(value, unit, f".{digits}f"), shown_in(unit), decimals(digits, unit)
    number_text, sign = text.split(" ", 1)
    assert sign == name and UNITS[name][1] == UNITS[unit][1]
    last = 10.0**-places * UNITS[name][0]
    assert abs(float(number_text) * UNITS[name][0] - value) <= 0.5 * last * (1 + 1e-9) + 1e-12 * abs(value)
    assert last <= 10**0.15 * 10.0**-digits * UNITS[unit][0] * (1 + 1e-9)


def test_an_unknown_system_is_refused_with_those_there_are():
    with pytest.raises(DefinitionError, match="si, bar-mm, kgf, us"), unit_system("cgs"):
        pass
    assert current_system() == ""


def test_a_column_follows_the_system():
    column = Column("pd", np.array([155.0, 100.0]) * units.kgf_cm2, "kgf/cm2", 1)
    assert (column.heading, column.shown_digits) == ("pd, kgf/cm2", 1)
    with unit_system("us"):
        assert (column.heading, column.shown_unit, column.shown_digits) == ("pd, psi", "psi", 0)
        assert column.shown == pytest.approx([2204.62, 1422.33], abs=0.01)
        assert [*text_table([column])] == ["pd, psi", "   2205", "   1422"]
    with unit_system("si"):
        assert [*text_table([column])] == ["pd, MPa", "  15.20", "   9.81"]


@for_all(
    ("text", "kind", "ends"),
    [
        ("270 to 330 mm", "length", (0.27, 0.33)),
        ("270 mm to 0.33", "length", (0.27, 0.33)),
        ("-15 to 80 deg by 5", "angle", (-15 * units.deg, 80 * units.deg, 5 * units.deg)),
        ("1 to 2 kgf m", "moment", (units.g0, 2 * units.g0)),
        ("0.1 to 0.2 in steps of 1 mm", "length", (0.1e-3, 0.2e-3, 1e-3)),
        ("270 mm", "length", None),
    ],
)
def test_two_ends_have_the_unit_that_is_said_last(text, kind, ends):
    found = parse_span(text, kind)
    assert found == (ends if ends is None else pytest.approx(ends, rel=1e-15))


@pytest.mark.parametrize("text", ["a to 3 mm", "1 to 2 parsec", "1,5 to 2 mm", "1 to 2 deg"])
def test_ends_that_are_no_lengths_are_refused(text):
    with pytest.raises(DefinitionError):
        parse_span(text, "length")


# -- units of one's own --------------------------------------------------------------------------------------


@pytest.fixture
def damping(monkeypatch):
    """Three units of damping, taken out of the table again afterwards."""
    tables = units.UNITS, units.SI, *SYSTEMS.values()
    before = [dict(table) for table in tables]
    units.add_unit("N*s/m", 1.0, "drag")
    units.add_unit("kN*s/m", 1e3, "drag")
    units.add_unit("lbf s/ft", 14.5939, "drag", systems=["us"])
    yield
    for table, rows in zip(tables, before, strict=True):
        table.clear()
        table.update(rows)


def test_an_added_unit_is_read_and_shown_like_any_other(damping):
    assert parse("0.25 kN*s/m", "drag") == 250.0 and parse("2 lbf s/ft") == pytest.approx(29.1878)
    assert show(250.0, "N*s/m") == "250 N*s/m" and units.units_of("drag") == ["N*s/m", "kN*s/m", "lbf s/ft"]
    with unit_system("us"):
        assert show(250.0, "kN*s/m", ".2f") == "17.1 lbf s/ft" and Column("c", [1.0], "N*s/m").heading == "c, lbf s/ft"
    with pytest.raises(DefinitionError, match=r"'3 mm' is a length where a value of kind drag is wanted; use one of: N\*s/m, kN"):
        parse("3 mm", "drag")
    assert units.add_unit("kN*s/m", 1e3, "drag") == 1e3


def test_a_class_a_file_and_a_sheet_know_it(damping, tmp_path):
    class Drag(ForceElement):
        """A force against the motion of a point, upwards."""

        places, parameters, file_section = ("point",), {"size": "N*s/m"}, "loads"

        def __init__(self, point, size):
            self.point, self.size = point, size

        def loads(self, motion):
            return [Load("B", np.stack([0.0 * motion["B"][0], self.number(motion, "size") + 0.0 * motion["B"][1]]))]

    class Lever(Mechanism):
        """A lever that is held back."""

        phi = Stroke(0.1, 1.0)
        c = Dimension(250.0, unit="kN*s/m")
        O = Ground(0.0, 0.0)
        B = Crank(O, OB=0.5, angle=phi)
        drag = Drag("B", 120.0)

    assert drags(Lever) == [("c", "kN*s/m"), ("drag.size", "N*s/m")]
    plain = type("Plain", (Lever,), {"drag": None})
    text = to_toml(plain)
    assert 'c = "0.25 kN*s/m"' in text and load(text.replace("0.25 kN*s/m", "3 lbf s/ft"))().dimensions["c"] == pytest.approx(43.7817)
    with pytest.raises(DefinitionError, match="Unit 'N s' is unknown"):
        type("Other", (Lever,), {"c": Dimension(1.0, unit="N s")})
    lines = report(Lever(), tmp_path / "lever.md", units="us", count=3).read_text(encoding="utf-8")
    assert "| c | $c$ | 17.1304" in lines and "lbf s/ft" in lines
    page(Lever(), tmp_path / "lever.html", vary=["c"], count=3)


def drags(machine):
    """Return the variables of a machine that measure drag, with their units."""
    entries = machine.plan.table.entries
    return [(name, each.unit) for name, each in entries.items() if plan_measure(machine.plan, name) == "drag"]


@for_all(
    ("name", "factor", "measures", "said"),
    [
        ("mm", 1e-3, "drag", "mm is known already, as 0.001 of SI for length"),
        ("mm", 1e-2, "length", "mm is known already"),
        ("kX", 1e3, "something", "the first unit of something is that of SI"),
        ("2X", 1.0, "something", "one or two words without digits in front"),
        ("X Y Z", 1.0, "something", "one or two words"),
        (" X", 1.0, "something", "one or two words"),
        ("X,Y", 1.0, "something", "without commas"),
        ("", 1.0, "something", "one or two words"),
        (None, 1.0, "something", "one or two words"),
        ("X", 0.0, "something", "a number above zero"),
        ("X", math.nan, "something", "a number above zero"),
        ("X", "1", "something", "a number above zero"),
        ("X", True, "something", "a number above zero"),
        ("X", 1.0, "", "what it measures"),
        ("X", 1.0, 3, "what it measures"),
    ],
)
def test_what_is_no_unit_is_refused(name, factor, measures, said):
    with pytest.raises(DefinitionError, match=said):
        units.add_unit(name, factor, measures)
    assert "something" not in units.SI and units.UNITS["mm"] == (1e-3, "length")


def test_a_system_that_is_not_there_is_refused():
    with pytest.raises(DefinitionError, match="System of units 'cgs' is unknown"):
        units.add_unit("dyn", 1e-5, "force", systems=["cgs"])
    assert "dyn" not in UNITS
