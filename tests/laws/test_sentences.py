"""Laws of what the machines say: in another language the same, in another system of units the same numbers."""

import re
from functools import lru_cache

import numpy as np
import pytest

from linkage import Mechanism, pin_forces, plot
from linkage.language import language, said
from linkage.loads import PLAIN_CASE
from linkage.pictures.strokes import StrokeAxis
from linkage.reports import results, text_table
from linkage.statics import max_table
from linkage.statics.table import table_text
from linkage.units import SYSTEMS, UNITS, unit_system
from tests import shipped
from tests.for_all import for_all

SHIPPED = shipped.MACHINES
SPEAKING = [name for name, machine in SHIPPED.items() if machine.rules is not Mechanism.rules]

NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w]|\.\d)")
NAMES = sorted((name for name in UNITS if name != "°"), key=len, reverse=True)
UNIT = re.compile(rf"(?<=[\d)] )(?:{'|'.join(map(re.escape, NAMES))})(?![\w/])")


def motion_of(machine):
    """Return few poses of a design: its verdicts look between them."""
    counts = {name: 3 for name in machine.strokes}
    return machine.sweep(unreachable="nan", **counts)


@lru_cache
def spoken(name, whole, tongue="en", system=None):
    """Return what a shipped machine says as it comes: all verdicts, or by rules of its own alone."""
    machine = SHIPPED[name]()
    with language(tongue), unit_system(system):
        return tuple((machine.verdicts if whole else machine.rules)(motion_of(machine)))


RATIO = re.compile(r"[\d.]+ (\w+) for 1 \1\b")
"""Both in one unit, whatever that is."""


OFFER = re.compile(
    r"an? (?:cylinder of )?(?:bore|rod)(?: of)? [\d.]+ \w+(?: and rod [\d.]+ \w+)?"
    r"(?:,? (?:with a reserve of [\d.]+|it is up to [\d.]+ \w+|would do, with \d+ %))?"
)
"""A size that is offered: of the series of inches in a system that has them, another one than in millimetres."""


def numbers(text):
    """Return the numbers of a sentence in order: as text, the unit that follows, and whether it follows at once."""
    text = re.sub(r"\bx(?=\d)", "", text)  # x1.19: so many times
    units = [(found.start(), found.group()) for found in UNIT.finditer(text)]
    for found in NUMBER.finditer(text):
        after = next(((start, unit) for start, unit in units if start >= found.end()), (0, ""))
        yield found.group(), after[1], after[0] == found.end() + 1


def last_digit(number):
    """Return how much the last digit of a printed number is worth."""
    return 10.0 ** -len(number.partition(".")[2])


def agree(one, one_unit, other, other_unit):
    """Return whether two printed numbers are the same within half of their last digits."""
    first, second = UNITS[one_unit][0], UNITS[other_unit][0]
    apart = abs(float(one) * first - float(other) * second)
    return apart <= (0.5 + 1e-6) * (last_digit(one) * first + last_digit(other) * second)


def assert_same_numbers(plain, converted, system):
    """Assert that a sentence has the numbers of another one, in the units of a system."""
    ratios = [[each.group().split()[0] for each in RATIO.finditer(text)] for text in (plain, converted)]
    ours, theirs = (list(numbers(RATIO.sub("", text))) for text in (plain, converted))
    assert len(ours) == len(theirs) and ratios[0] == ratios[1], (plain, converted)
    for (one, one_unit, direct), (other, other_unit, _) in zip(ours, theirs, strict=True):
        if direct:
            assert other_unit == SYSTEMS[system].get(UNITS[one_unit][1], one_unit), (plain, converted)
        assert (not direct and one == other) or agree(one, one_unit, other, other_unit), (one, other, plain, converted)


DAILY = ("arm_drive", "boom_drive", "crane_skeleton", "crosshead_grapple", "grapple", "header_balancer", "three_point_hitch")
"""A machine of each that has rules of its own."""
WHOLE = "grapple"
"""The one of which all verdicts are looked at daily, of a cylinder and its circuit among them."""
BRIEF = [(name, name == WHOLE) for name in DAILY]


def test_all_rules_are_looked_at_daily():
    assert {SHIPPED[name].rules for name in DAILY} == {SHIPPED[name].rules for name in SPEAKING}


@for_all(
    ("name", "whole", "system"),
    [(*each, "us") for each in BRIEF],
    slow=[(name, True, system) for name in SPEAKING for system in SYSTEMS if (name, system) != (WHOLE, "us")],
)
def test_a_sentence_has_the_same_numbers_in_every_system(name, whole, system):
    plain, converted = spoken(name, whole), spoken(name, whole, system=system)
    assert [getattr(each, "ok", None) for each in plain] == [getattr(each, "ok", None) for each in converted]
    for one, other in zip(plain, converted, strict=True):
        both = [OFFER.sub("a size", each) if system == "us" else each for each in (one, other)]
        assert_same_numbers(*both, system)


@pytest.mark.parametrize("wrong", ["pd is 2290 psi at 3.00 in", "pd is 2204 psi at 3.00 mm", "pd is 2204 psi"])
def test_a_wrong_number_or_unit_would_be_found(wrong):
    assert_same_numbers("pd is 155.0 kgf/cm2 at 76 mm", "pd is 2205 psi at 2.99 in", "us")
    with pytest.raises(AssertionError):
        assert_same_numbers("pd is 155.0 kgf/cm2 at 76 mm", wrong, "us")


@for_all("system", SYSTEMS)
@for_all("name", shipped.DAILY, slow=shipped.OTHERS)
def test_a_table_is_in_the_units_of_the_system_and_has_the_same_numbers(name, system):
    machine = SHIPPED[name]()
    columns = results(machine, motion_of(machine))
    with unit_system(system):
        header, *rows = text_table([column for column in columns])
        for column in columns:
            assert column.shown_unit == SYSTEMS[system].get(UNITS[column.unit][1], column.unit) if column.unit else not column.shown_unit
            assert column.heading == (f"{column.name}, {column.shown_unit}" if column.unit else column.name) and column.heading in header
            factor = UNITS[column.shown_unit][0] if column.unit else 1.0
            np.testing.assert_allclose(column.shown * factor, column.values, rtol=1e-14, atol=0.0)
        cells = np.array([[np.nan if cell == "-" else float(cell) for cell in row.split()] for row in rows]).T
        for column, printed in zip(columns, cells, strict=True):
            shown = np.broadcast_to(column.shown, np.broadcast_shapes(*(np.shape(each.values) for each in columns))).ravel()
            np.testing.assert_allclose(printed, shown, rtol=0.0, atol=(0.5 + 1e-6) * 10.0**-column.shown_digits)


# -- Russian -----------------------------------------------------------------------------------------------

LATIN = re.compile(r"[A-Za-z][\w/.]*")
SIGNS = {"ISO", "n", "mu", "rho", PLAIN_CASE}


@for_all(("name", "whole"), BRIEF, slow=[(name, True) for name in SPEAKING if name != WHOLE])
def test_verdicts_are_russian_in_whole(name, whole):
    """What is Latin are names: members of the machine and what may be written in its place."""
    known = set(SHIPPED[name]().plan.members) | SIGNS
    for english, russian in zip(spoken(name, whole), spoken(name, whole, "ru"), strict=True):
        assert russian != english and getattr(russian, "rule", "") == getattr(english, "rule", "")
        assert sorted(number for number, *_ in numbers(english)) == sorted(number for number, *_ in numbers(russian))
        for word in LATIN.findall(russian):
            assert word in known or is_label(word, SHIPPED[name]()) or word in CODE, (word, russian)


CODE = {"relief", "works", "both", "M_g", "M_1", "D_0", "d_0", "kz", "pd", "R_y", "F", "H", "G"}


def is_label(word, machine):
    """Return whether a word is a design variable or made of the points of the machine."""
    points = sorted(machine.plan.points, key=len, reverse=True)
    return word in machine.dimensions or re.fullmatch("|".join(points) + rf"|(?:{'|'.join(points)})+", word) is not None


def test_a_word_that_is_not_translated_would_be_found():
    with language("ru"):
        assert LATIN.findall(said("the least reserve of all is {n}", n=3)) != []


def test_axes_of_a_curve_are_of_the_system_and_the_language():
    lift = SHIPPED["mower_lift"]()
    motion = lift.sweep(5)
    with unit_system("us"), language("ru"):
        axis = StrokeAxis.of(motion)
        (panel,) = [ax for ax in plot(lift, ["pd"], limits=dict(pd=(155 * UNITS["kgf_cm2"][0], "p")), count=5).axes if ax.lines]
    assert axis.heading == panel.get_xlabel() == "S, in" and panel.get_title(loc="left") == "pd, psi"
    np.testing.assert_allclose(axis.values[[0, -1]] * 0.0254, [0.55, 0.80], rtol=1e-12)
    assert any(np.allclose(line.get_ydata(), 155 * UNITS["kgf_cm2"][0] / UNITS["psi"][0]) for line in panel.lines)
    with language("ru"):
        assert StrokeAxis.of(motion).heading == "S, мм"


def test_the_table_of_pin_forces_is_in_the_units_of_the_system():
    rows = max_table(pin_forces(SHIPPED["mower_lift"]().at(S=[0.6])))
    with unit_system("us"):
        head, *lines = table_text(rows).splitlines()
        assert "force, lbf" in head and len(lines) == len(rows)
        assert [float(row.cells[4]) for row in rows] == pytest.approx([row.force / UNITS["lbf"][0] for row in rows], abs=0.5)
    with language("ru"):
        assert table_text(rows).splitlines()[0].split()[:2] == ["шарнир", "вид"] and "сила, кН" in table_text(rows)
