"""The block of accumulators against its definition, the paper's settings, and what it refuses."""

from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose
from scipy.optimize import brentq

from hydraulics import Accumulator, AccumulatorBlock, adiabatic, isothermal, polytropic, real_nitrogen
from linkage.errors import DefinitionError
from linkage.units import bar, cm3, kgf_cm2, litre
from tests.for_all import for_all

LAWS = (isothermal, polytropic(1.25), adiabatic, real_nitrogen())
SWEPT = 2 * np.pi / 4 * 0.063**2  # two cylinders of 63 mm, m2

# Two 4 l accumulators at 50 and 25 kgf/cm2, gauge pressures put straight into p V = const: an illustrative header balancer.
# Setting [kgf/cm2], stroke at the horizon [m], strokes [m], block pressures [kgf/cm2].
HEADERS = {
    1: (
        94.0, 0.124621328,
        [0.0798885566, 0.090849756, 0.101810955, 0.112772155, 0.123733354, 0.134694554, 0.145655753, 0.156616953, 0.167578152],
        [103.000638, 100.639368, 98.3839353, 96.2273797, 94.1633388, 92.1859842, 90.2899674, 88.4703707, 86.7226651],
    ),
    2: (
        34.0, 0.124621245,
        [0.0609339078, 0.0763054437, 0.0916769797, 0.107048516, 0.122420052, 0.137791587, 0.153163123, 0.168534659, 0.183906195],
        [39.3063473, 37.8794758, 36.5525699, 35.31548, 34.1593853, 33.0765836, 32.0603192, 31.1046418, 30.2042903],
    ),
    3: (
        50.0, 0.124621252,
        [0.0589268595, 0.0747545721, 0.0905822847, 0.106409997, 0.12223771, 0.138065422, 0.153893135, 0.169720848, 0.18554856],
        [53.6631453, 52.7323564, 51.8333062, 50.9643984, 50.1241422, 47.9888461, 45.8191139, 43.8370959, 42.019442],
    ),
}  # fmt: skip


def pair(gas=isothermal, atmosphere=0.0):
    return AccumulatorBlock([Accumulator(4 * litre, 50 * kgf_cm2), Accumulator(4 * litre, 25 * kgf_cm2)], gas, atmosphere)


def gas_volume(block, p):
    """The definition, one accumulator and one pressure at a time."""
    up = block.atmosphere
    return sum(
        one.volume if p <= one.charge else float(block.gas.volume(p + up, one.charge + up, one.volume)) for one in block.accumulators
    )


@st.composite
def blocks(draw):
    vessel = st.builds(Accumulator, volume=st.floats(0.1 * litre, 20 * litre), charge=st.floats(5 * bar, 120 * bar))
    vessels = draw(st.lists(vessel, min_size=1, max_size=5))
    return AccumulatorBlock(vessels, draw(st.sampled_from(LAWS)), draw(st.sampled_from([0.0, 101325.0])))


@st.composite
def charged(draw):
    """A block, a pressure it is charged to, and a pressure it ends at."""
    block = draw(blocks())
    lowest = min(one.charge for one in block.accumulators)
    return block, *(lowest + draw(st.floats(0.01 * bar, 250 * bar)) for _ in range(2))


@pytest.mark.parametrize("header", HEADERS)
def test_the_three_headers(header):
    setting, horizon, h, expected = HEADERS[header]
    block = pair()
    assert_allclose(block.pressure(setting * kgf_cm2, withdrawn=(np.array(h) - horizon) * SWEPT) / kgf_cm2, expected, rtol=1e-8)


def test_setting_is_kept_when_nothing_is_withdrawn():
    """Erratum of the paper: its (30) as printed gives P1^2 / P0_I = 176.7 instead of 94."""
    for setting in (94, 50, 34):
        assert_allclose(pair().pressure(setting * kgf_cm2, withdrawn=0.0), setting * kgf_cm2, rtol=1e-14)


def test_the_line_is_empty_when_the_gas_fills_the_vessels():
    """Erratum of the paper: in (21) the gas of one accumulator ends at its vessel, not at a withdrawal of that size."""
    block = AccumulatorBlock([Accumulator(4 * litre, 50 * kgf_cm2)], isothermal, atmosphere=0)
    held = block.fluid(100 * kgf_cm2)
    assert_allclose(held, 2 * litre)
    pressure = block.pressure(100 * kgf_cm2, withdrawn=held * np.array([0.5, 0.999999, 1.000001, 5.0]))
    assert_allclose(pressure / kgf_cm2, [200 / 3, 50, 0, 0], atol=1e-4)


def test_one_charge_by_hand():
    """40 bar gauge, 4 l; charged to 80 bar gauge, 0.5 l pushed in, atmosphere 1.01325 bar."""
    block = AccumulatorBlock([Accumulator(4 * litre, 40 * bar)])
    gas = 4 * 41.01325 / 81.01325
    assert_allclose(block.gas_volume(80 * bar), gas * litre)
    assert_allclose(block.pressure(80 * bar, withdrawn=-0.5 * litre), (4 * 41.01325 / (gas - 0.5) - 1.01325) * bar)


@given(charged())
def test_pressure_solves_the_definition(case):
    block, p1, p2 = case
    withdrawn = gas_volume(block, p2) - gas_volume(block, p1)
    found = block.pressure(p1, withdrawn)
    target = gas_volume(block, p1) + withdrawn
    lowest = min(one.charge for one in block.accumulators)
    if target < sum(one.volume for one in block.accumulators) * (1 - 1e-12):
        expected = brentq(lambda p: gas_volume(block, p) - target, lowest, 400 * bar, xtol=1e-3, rtol=1e-14)
        assert_allclose(found, expected, rtol=1e-9)
        assert_allclose(found, p2, rtol=1e-7)


@given(charged())
def test_round_trip(case):
    block, p1, p2 = case
    withdrawn = block.gas_volume(p2) - block.gas_volume(p1)
    assert_allclose(block.gas_volume(block.pressure(p1, withdrawn)), block.gas_volume(p2), rtol=1e-11)
    assert_allclose(block.pressure_holding(block.fluid(p2)), p2, rtol=1e-7)
    assert_allclose(block.gas_volume(p2) + block.fluid(p2), sum(one.volume for one in block.accumulators), rtol=1e-14)


@given(charged())
def test_pressure_falls_as_fluid_leaves(case):
    block, p1, p2 = case
    span = np.linspace(-0.9 * (block.gas_volume(p1) - block.gas_volume(max(p1, p2))), 1.1 * block.fluid(p1), 200)
    pressure = block.pressure(p1, span)
    assert np.all(np.diff(pressure) <= 0.0)
    assert np.all(pressure[span > block.fluid(p1) * (1 + 1e-12)] == 0.0)
    for withdrawn, expected in zip(span[::40], pressure[::40], strict=True):
        assert_allclose(block.pressure(p1, withdrawn), expected, rtol=1e-13)


@pytest.mark.slow
@given(charged())
def test_scaling_the_vessels_scales_the_volumes(case):
    block, p1, p2 = case
    doubled = AccumulatorBlock([Accumulator(2 * one.volume, one.charge) for one in block.accumulators], block.gas, block.atmosphere)
    withdrawn = block.gas_volume(p2) - block.gas_volume(p1)
    assert_allclose(doubled.pressure(p1, 2 * withdrawn), block.pressure(p1, withdrawn), rtol=1e-12)
    assert_allclose(doubled.stiffness(p1), block.stiffness(p1) / 2, rtol=1e-12)


def test_two_equal_accumulators_are_one_of_twice_the_volume():
    one = AccumulatorBlock([Accumulator(4 * litre, 30 * bar)])
    two = AccumulatorBlock([Accumulator(2 * litre, 30 * bar)] * 2)
    withdrawn = np.linspace(-1.2, 2.8, 50) * litre
    assert_allclose(two.pressure(90 * bar, withdrawn), one.pressure(90 * bar, withdrawn), rtol=1e-13)


def test_order_of_the_accumulators_does_not_matter():
    vessels = [Accumulator(v * litre, p * bar) for v, p in [(1, 70), (4, 20), (2, 45)]]
    withdrawn = np.linspace(-0.5, 4.0, 50) * litre
    assert_allclose(AccumulatorBlock(vessels[::-1]).pressure(90 * bar, withdrawn), AccumulatorBlock(vessels).pressure(90 * bar, withdrawn))


@for_all("gas", LAWS, ids=str)
@for_all("fast", [False, True])
def test_stiffness_is_the_limit_of_the_differences(gas, fast):
    block = pair(gas, 101325.0)
    p1 = 60 * bar
    block = block.settled(p1) if fast else block
    withdrawn = np.array([-500.0, 0.0, 150.0, 900.0, 1400.0]) * cm3  # both at work, then the lower charge alone

    def error(step):
        ends = [block.pressure(p1, withdrawn + sign * step) for sign in (-1, 1)]
        return np.abs((ends[0] - ends[1]) / (2 * step) / block.stiffness(p1, withdrawn) - 1)

    assert np.all(error(20 * cm3) < 1e-3)
    assert_allclose(error(20 * cm3) / error(2 * cm3), 100, rtol=0.05)  # second order


def test_stiffness_drops_where_an_accumulator_joins_and_ends_with_the_fluid():
    block = pair()
    joins = block.gas_volume(50 * kgf_cm2) - block.gas_volume(60 * kgf_cm2)
    before, there, after = block.stiffness(60 * kgf_cm2, joins * np.array([1 - 1e-9, 1, 1 + 1e-9]))
    assert_allclose([before, there], 50 * kgf_cm2 / (6 * litre), rtol=1e-6)
    assert_allclose(after, 3 * before, rtol=1e-6)  # 6 l of gas at work above, 2 l below
    assert block.stiffness(60 * kgf_cm2, 9 * litre) == 0.0


def fast_by_definition(block, p1, withdrawn, n):
    """Each gas by itself: settled at p1 first, then p V^n = const; p + atmosphere throughout."""
    up, volumes = block.atmosphere, []
    for one in block.accumulators:
        if p1 > one.charge:
            settled = float(block.gas.volume(p1 + up, one.charge + up, one.volume))
            volumes.append(lambda p, V=settled, top=one.volume: min(top, V * ((p1 + up) / p) ** (1 / n)))
        else:
            volumes.append(lambda p, one=one: one.volume * min(1.0, ((one.charge + up) / p) ** (1 / n)))
    target = sum(V(p1 + up) for V in volumes) + withdrawn
    if target > sum(one.volume for one in block.accumulators):
        return 0.0
    return brentq(lambda p: sum(V(p) for V in volumes) - target, 1 * bar, 2000 * bar, rtol=1e-14) - up


@for_all("gas", LAWS, ids=str)
@for_all("setting", [94, 51, 34])
@for_all("withdrawn", [-1200, -300, 0, 80, 500, 900])
def test_fast_pressure_solves_the_definition(gas, setting, withdrawn):
    block, p1 = pair(gas, 101325.0), setting * kgf_cm2
    n = float(gas.fast_exponent(p1 + 101325.0))
    assert_allclose(block.fast_pressure(p1, withdrawn * cm3), fast_by_definition(block, p1, withdrawn * cm3, n), rtol=1e-10)


def test_fast_is_stiffer_than_slow_by_the_exponent():
    block = pair()
    p1 = 94 * kgf_cm2
    assert_allclose(block.settled(p1).stiffness(p1), 1.4 * block.stiffness(p1))
    assert_allclose(block.settled(p1, exponent=1.2).stiffness(p1), 1.2 * block.stiffness(p1))
    withdrawn = np.array([-400, -100, 100, 400]) * cm3
    assert np.array_equal(np.sign(block.fast_pressure(p1, withdrawn) - block.pressure(p1, withdrawn)), [1, 1, -1, -1])
    assert_allclose(block.fast_pressure(p1, withdrawn, exponent=1.0), block.pressure(p1, withdrawn), rtol=1e-13)


def test_a_settled_gas_runs_empty_below_its_charge():
    """It has cooled: 4 l at 50 settled to 2 l at 100 fill the vessel again at 100 / 2^1.4 = 37.9."""
    block = AccumulatorBlock([Accumulator(4 * litre, 50 * bar)], atmosphere=0)
    fast = block.settled(100 * bar)
    assert_allclose(fast.accumulators[0].charge, 100 / 2**1.4 * bar)
    assert_allclose(fast.fluid(100 * bar), block.fluid(100 * bar))
    assert_allclose(fast.pressure(100 * bar, withdrawn=1.999999 * litre), 100 / 2**1.4 * bar, rtol=1e-5)


def test_settings_and_strokes_broadcast():
    p1, withdrawn = np.array([[34.0], [50.0], [94.0]]) * kgf_cm2, np.linspace(-300, 300, 7) * cm3
    for call in ("pressure", "stiffness", "fast_pressure"):
        together = getattr(pair(), call)(p1, withdrawn)
        assert together.shape == (3, 7)
        assert_allclose(together, [getattr(pair(), call)(float(p), withdrawn) for p in p1[:, 0]], rtol=1e-13)


def test_one_design_for_each_charge_of_an_array():
    charges, withdrawn = np.array([20.0, 30.0, 40.0]) * bar, 300 * cm3
    designs = AccumulatorBlock([Accumulator(4 * litre, charges), Accumulator(np.array([1.0, 2.0, 3.0]) * litre, 50 * bar)])
    singles = [
        AccumulatorBlock([Accumulator(4 * litre, p), Accumulator(v * litre, 50 * bar)]) for p, v in zip(charges, (1, 2, 3), strict=True)
    ]
    assert_allclose(designs.pressure(70 * bar, withdrawn), [block.pressure(70 * bar, withdrawn) for block in singles])
    assert_allclose(designs.pressure(70 * bar, 9 * litre), 0.0)


def test_unreached_poses_stay_unreached():
    withdrawn = np.array([0.0, np.nan, 100 * cm3])
    for gas in LAWS:
        for call in (pair(gas).pressure, pair(gas).fast_pressure, pair(gas).stiffness):
            assert np.array_equal(np.isnan(call(60 * kgf_cm2, withdrawn)), [False, True, False])


def test_gauge_and_atmosphere():
    """Gauge pressures are absolute ones less the atmosphere: shifting both leaves the volumes alone."""
    up = 101325.0
    absolute = AccumulatorBlock([Accumulator(4 * litre, 50 * bar + up), Accumulator(4 * litre, 25 * bar + up)], atmosphere=0)
    gauge = AccumulatorBlock([Accumulator(4 * litre, 50 * bar), Accumulator(4 * litre, 25 * bar)])
    withdrawn = np.linspace(-500, 500, 11) * cm3
    assert_allclose(gauge.pressure(60 * bar, withdrawn) + up, absolute.pressure(60 * bar + up, withdrawn), rtol=1e-14)
    assert_allclose(gauge.fluid(0.0), 0.0)


def test_setting_table_over_the_temperature():
    T = np.array([253.15, 273.15, 293.15, 313.15, 333.15])
    ideal, real = pair(isothermal, 101325.0), pair(real_nitrogen(), 101325.0)
    table = ideal.charges_at(T)
    assert table.shape == (2, 5)
    assert_allclose(table[0] + 101325.0, (50 * kgf_cm2 + 101325.0) * T / 293.15)
    assert_allclose(real.charges_at(293.15), [50 * kgf_cm2, 25 * kgf_cm2])
    assert np.all(np.abs(real.charges_at(T) / table - 1) < 0.02)
    assert_allclose([one.charge for one in real.at(333.15).accumulators], real.charges_at(333.15))
    assert real.at(333.15).gas.temperature == 333.15


@pytest.mark.parametrize("gas", [isothermal, real_nitrogen()], ids=str)
def test_a_trapped_line_warms_up_and_cools_down(gas):
    block, p1 = pair(gas, 101325.0), 94 * kgf_cm2
    hot = block.at(333.15)
    p2 = hot.pressure_holding(block.fluid(p1))
    assert p2 > p1
    assert_allclose(hot.at(293.15).pressure_holding(hot.fluid(p2)), p1)
    if gas is isothermal:  # both at work: all of the gas obeys p V / T
        assert_allclose((p2 + 101325.0) / (p1 + 101325.0), 333.15 / 293.15)


def test_the_list_may_change_afterwards():
    vessels = [Accumulator(4 * litre, 50 * bar)]
    block = AccumulatorBlock(vessels)
    vessels.clear()
    assert_allclose(block.gas_volume(10 * bar), 4 * litre)


# -- absent vessels ----------------------------------------------------------------------------------------

NOWHERE = st.builds(Accumulator, volume=st.just(0.0), charge=st.sampled_from([0.0, -7 * bar, 3 * bar, 40 * bar, 900 * bar]))


def answers(block, p1, withdrawn, at):
    """Return everything that a block tells of pressures and volumes, in one array."""
    fast = block.settled(p1)
    asked = [block.gas_volume(at), block.fluid(at), block.pressure(p1, withdrawn), block.stiffness(p1, withdrawn)]
    asked += [fast.pressure(p1, withdrawn), fast.stiffness(p1, withdrawn), block.fast_pressure(p1, withdrawn, 1.2)]
    warm = block.at(310.0)
    return np.stack([*asked, warm.fluid(at), np.full_like(withdrawn, block.lowest_charge), warm.pressure_holding(block.fluid(at) / 2)])


@pytest.mark.slow
@settings(deadline=None, max_examples=20)  # real nitrogen is found by iteration
@given(charged(), NOWHERE, st.integers(0, 5))
def test_a_block_with_an_absent_vessel_is_the_block_without_it(case, absent, place):
    block, p1, p2 = case
    vessels = list(block.accumulators)
    vessels.insert(place, absent)
    more = AccumulatorBlock(vessels, block.gas, block.atmosphere)
    withdrawn = np.append(block.fluid(p1) * np.array([0.0, 0.3, 0.8, 1.2]), -0.05 * block.gas_volume(p1))
    at = np.linspace(0.0, max(p1, p2), 5)
    assert np.array_equal(answers(more, p1, withdrawn, at), answers(block, p1, withdrawn, at))
    said = [each.sentence for each in more.checks(p1, p1 + 50 * bar, 300 * bar)]
    assert said == [each.sentence for each in block.checks(p1, p1 + 50 * bar, 300 * bar)]


@given(NOWHERE)
def test_vessels_absent_in_some_designs_only(absent):
    """A batch whose vessels differ: each design is the block of what it has."""
    first, second = np.array([4.0, 0.0, 1.0]) * litre, np.array([0.0, 2.0, 3.0]) * litre
    charges = np.where(second > 0.0, 50 * bar, absent.charge)
    batch = AccumulatorBlock([Accumulator(first, 25 * bar), Accumulator(second, charges)])
    withdrawn = np.array([[-0.1], [0.2], [0.9]]) * litre
    for ask in ("pressure", "stiffness", "fast_pressure"):
        found = getattr(batch, ask)(70 * bar, withdrawn)
        for row, (one, two) in enumerate(zip(first, second, strict=True)):
            alone = AccumulatorBlock([Accumulator(v, p) for v, p in ((one, 25 * bar), (two, 50 * bar)) if v > 0.0])
            assert_allclose(found[:, row], getattr(alone, ask)(70 * bar, withdrawn[:, 0]), rtol=1e-14)
    rules = {each.rule: each for each in batch.checks(30 * bar, 100 * bar, 200 * bar)}
    assert "50 bar" not in rules["charge of accumulator 1"].sentence
    assert rules["charge of accumulator 2"].sentence.startswith("51.01 bar against 27.91 bar")
    assert np.array_equal(np.isnan(batch.charges_at(300.0)), [first == 0.0, second == 0.0])


def test_verdicts_keep_the_numbers_of_the_vessels_and_say_nothing_of_absent_ones():
    block = AccumulatorBlock([Accumulator(0.0, 500 * bar), Accumulator(4 * litre, 25 * bar)])
    rules = [each.rule for each in block.checks(30 * bar, 80 * bar, 100 * bar)]
    assert rules == ["charge of accumulator 2", "compression of accumulator 2", "exhausted", "allowed pressure"]


ONE = Accumulator(4 * litre, 25 * bar)


@for_all(
    ("call", "message"),
    [
        (partial(Accumulator, -1e-3, 25 * bar), "Accumulator volume = -0.001 is below zero; give 0 for a vessel that is absent"),
        (partial(AccumulatorBlock, [Accumulator(0.0, 25 * bar)] * 2), "Every accumulator of the block has the volume 0, it is absent"),
        (partial(AccumulatorBlock, [Accumulator(np.array([1e-3, 0.0]), 25 * bar)]), "Every accumulator of the block has the volume 0"),
        (partial(Accumulator, 4 * litre, 50), r"charge = 50 Pa is next to nothing; write 50 \* bar if these are bar, or 50 \* kgf_cm2"),
        (partial(Accumulator, 4 * litre, np.array([50 * bar, -0.5])), r"charge = -0\.5 Pa is next to nothing; write -0\.5 \* bar"),
        (partial(AccumulatorBlock, [ONE], atmosphere=1.013), r"Atmosphere = 1\.013 Pa is next to nothing; write 1\.013 \* bar"),
        (partial(AccumulatorBlock, [ONE], unit="mm"), "Unit 'mm' is unknown"),
        (partial(AccumulatorBlock([ONE], unit="kgf/cm2").pressure, 20 * kgf_cm2), "charged to 20 kgf/cm2 .* being 25.49 kgf/cm2 gauge"),
        (partial(Accumulator, np.nan, 25 * bar), "Accumulator volume = nan is not finite"),
        (partial(Accumulator, 4 * litre, np.nan), "Accumulator charge = nan is not finite"),
        (partial(Accumulator, 4 * litre, "25 bar"), "Accumulator charge = '25 bar' is not a number"),
        (partial(AccumulatorBlock, []), "block is empty; give it at least one"),
        (partial(AccumulatorBlock, [4 * litre]), r"0.004 is no Accumulator; write Accumulator\(volume, charge\)"),
        (partial(AccumulatorBlock, [ONE], real_nitrogen), "is no gas law; take isothermal"),
        (partial(AccumulatorBlock, [ONE], atmosphere=-1.0), "Atmosphere = -1 Pa is below zero"),
        (partial(AccumulatorBlock, [Accumulator(1e-3, 0.0)], atmosphere=0), "Absolute accumulator charge = 0 is not above zero"),
        (partial(AccumulatorBlock, [Accumulator(1e-3, -2 * bar)]), "Accumulator charge = -200000 Pa gauge is below zero absolute"),
        (partial(pair().pressure, 20 * bar, 0.0), r"block is rigid: charged to 20 bar gauge .* lowest gas charge being 24.52 bar gauge"),
        (partial(pair().pressure, [60 * bar, 20 * bar], 0.0), "block is rigid: charged to 20 bar"),
        (partial(pair().fast_pressure, 20 * bar, 0.0), "block is rigid"),
        (partial(pair().stiffness, 20 * bar), "block is rigid"),
        (partial(pair().settled, 60 * bar, 0.9), "exponent n = 0.9 is outside 1..10"),
        (partial(pair().pressure, -1 * bar), "Pressure = -100000 Pa gauge is below zero absolute"),
        (partial(pair().pressure, np.nan), "Pressure = nan is not finite"),
        (partial(pair().pressure, 60 * bar, np.nan), "Withdrawn volume = nan is not finite"),
        (partial(pair().pressure, 60 * bar, [0.0, np.inf]), "Withdrawn volume = inf is not finite"),
        (
            partial(pair().pressure, 94 * kgf_cm2, [0.0, -4 * litre]),
            "Pushing 4 litres of fluid into a block with 3.191 litres of gas leaves",
        ),
        (partial(pair(adiabatic).pressure, 94 * kgf_cm2, -8 * litre), "leaves no gas; take larger accumulators"),
        (partial(pair(real_nitrogen()).pressure, 94 * kgf_cm2, -2.8 * litre), "real_nitrogen holds up to 500 bar absolute"),
        (partial(pair().pressure_holding, -1e-6), "Fluid held = -1 cm3 is below zero"),
        (partial(pair().pressure_holding, 8 * litre), "Pushing 8 litres of fluid into a block with 8 litres of gas leaves no gas"),
        (partial(pair().at, 20.0), "Gas temperature = 20 K is outside 200..400 K"),
        (partial(pair().gas_volume, "94"), "Pressure = '94' is not a number"),
    ],
)
def test_refusals(call, message):
    with pytest.raises(DefinitionError, match=message):
        call()


def test_small_pressures_that_are_meant_pass():
    """No gauge charge, a vacuum, an absent vessel, no atmosphere; a settled gas may come near the atmosphere by itself."""
    for charge in (0.0, -0.5 * bar, 1000.0):
        assert AccumulatorBlock([Accumulator(4 * litre, charge)]).pressure(60 * bar) == pytest.approx(60 * bar)
    assert Accumulator(0.0, 5.0).volume == 0.0
    block = AccumulatorBlock([Accumulator(4 * litre, 10 * bar)])
    near = brentq(lambda p1: block.settled(p1).accumulators[0].charge - 500.0, 11 * bar, 40000 * bar)
    assert 0.0 < block.settled(near).accumulators[0].charge < 1000.0


def test_a_line_charged_just_to_the_lowest_charge_is_not_rigid():
    block = pair()
    assert_allclose(block.pressure(25 * kgf_cm2, [0.0, 1 * cm3]), [25 * kgf_cm2, 0.0])
    assert block.fast_pressure(25 * kgf_cm2, -100 * cm3) > 25 * kgf_cm2
