"""The accumulator rules, each kept and broken."""

import pytest

from hydraulics import Accumulator, AccumulatorBlock
from linkage.errors import DefinitionError
from linkage.units import bar, litre

BLOCK = AccumulatorBlock([Accumulator(4 * litre, 50 * bar), Accumulator(4 * litre, 30 * bar)], atmosphere=1 * bar)


def failing(p_min, p_max, allowed=200):
    return {one.rule: one.sentence for one in BLOCK.checks(p_min * bar, p_max * bar, allowed * bar) if not one.ok}


def test_all_kept():
    verdicts = BLOCK.checks(60 * bar, 110 * bar, 200 * bar)
    assert [one.rule for one in verdicts] == [
        "charge of accumulator 1", "charge of accumulator 2", "compression of accumulator 1", "compression of accumulator 2",
        "exhausted", "allowed pressure",
    ]  # fmt: skip
    assert all(verdicts)
    assert str(verdicts[0]) == "ok   charge of accumulator 1: 51 bar against 54.9 bar, 0.9 of the lowest pressure (absolute)."


def test_charge_too_near_the_lowest_pressure():
    assert set(failing(55.6, 110)) == {"charge of accumulator 1"}  # 51 / 0.9 = 56.67 absolute, 55.67 gauge
    assert not failing(55.7, 110)
    assert (
        "lower the charge to 49.94 bar gauge, or raise the lowest pressure to 55.67 bar gauge"
        in failing(55.6, 110)["charge of accumulator 1"]
    )


def test_an_idle_accumulator_is_named():
    assert "it is idle there, full of gas" in failing(40, 110)["charge of accumulator 1"]
    assert "idle" not in failing(55, 110)["charge of accumulator 1"]


def test_compressed_too_far():
    assert not failing(60, 123)  # 124 absolute is 4 times 31
    assert failing(60, 123.2) == {
        "compression of accumulator 2": "124.2 bar at most is 4.006 times the charge, limit 4 (absolute); "
        "raise the charge to 30.05 bar gauge, or lower the highest pressure to 123 bar gauge."
    }


def test_exhausted():
    broken = failing(30, 110)
    assert broken["exhausted"] == "0 cm3 of fluid left at the lowest pressure, 30 bar gauge; lower a charge, or charge the line higher."
    assert "exhausted" in failing(0, 110)
    assert "exhausted" not in failing(31, 110)


def test_over_the_allowed_pressure():
    assert "set the relief valve lower" in failing(60, 110.1, allowed=110)["allowed pressure"]
    assert not failing(60, 110, allowed=110)


def test_unit_of_the_sentences():
    assert "11 MPa, allowed 20 MPa (gauge)" in BLOCK.checks(60 * bar, 110 * bar, 200 * bar, unit="MPa")[-1].sentence


@pytest.mark.parametrize(
    ("p_min", "p_max", "unit", "message"),
    [
        (90, 80, "bar", "p_min = 90 bar is above p_max = 80 bar; exchange them"),
        (-2, 80, "bar", "Pressure = -200000 Pa gauge is below zero absolute"),
        (60, 80, "bra", "Unit 'bra' is unknown"),
    ],
)
def test_refusals(p_min, p_max, unit, message):
    with pytest.raises(DefinitionError, match=message):
        BLOCK.checks(p_min * bar, p_max * bar, 200 * bar, unit)
