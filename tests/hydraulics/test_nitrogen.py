"""The short equation of state of nitrogen against CoolProp's reference equation (Span et al. 2000).

`nitrogen.csv` has what CoolProp finds, and is compared with it under `slow`: to load CoolProp takes seconds.
"""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Accumulator, AccumulatorBlock, real_nitrogen
from linkage.errors import DefinitionError
from linkage.units import bar, litre
from tests.for_all import for_all

TEMPERATURES = np.linspace(245.0, 340.0, 10)
PRESSURES = np.concatenate([np.geomspace(0.5, 20.0, 8), np.linspace(27.0, 500.0, 40)]) * bar


@cache
def coolprop():
    """Return CoolProp and its nitrogen."""
    import CoolProp

    return CoolProp, CoolProp.AbstractState("HEOS", "Nitrogen")


def reference(pressure, temperature):
    """Return the molar density [mol/m3] and the isentropic exponent of CoolProp."""
    known, state = coolprop()
    state.update(known.PT_INPUTS, pressure, temperature)
    rho = state.rhomolar()
    return rho, rho / pressure * state.first_partial_deriv(known.iP, known.iDmolar, known.iSmolar)


@pytest.fixture(scope="module")
def table():
    """Density and exponent, each (temperatures, pressures)."""
    rows = np.loadtxt(Path(__file__).with_name("nitrogen.csv"), delimiter=",", skiprows=1).reshape(len(TEMPERATURES), len(PRESSURES), 4)
    assert_allclose(rows[..., 0] + 0.0 * PRESSURES, TEMPERATURES[:, None] + 0.0 * PRESSURES, rtol=1e-9)
    assert_allclose(rows[..., 1], np.broadcast_to(PRESSURES, rows.shape[:2]), rtol=1e-9)
    return np.moveaxis(rows[..., 2:], -1, 0)


@pytest.mark.slow
def test_the_table_is_coolprops(table):
    found = [[reference(p, T) for p in PRESSURES] for T in TEMPERATURES]
    assert_allclose(table, np.moveaxis(found, -1, 0), rtol=1e-7)


def test_volume_and_pressure_within_4e_5(table):
    for T, rho in zip(TEMPERATURES, table[0], strict=True):
        gas = real_nitrogen(T)
        assert_allclose(gas.specific(PRESSURES) * rho, 1.0, rtol=0, atol=4e-5)
        assert_allclose(gas.pressure_of(1 / rho[:-1]), PRESSURES[:-1], rtol=4e-5)


def test_isentropic_exponent_within_half_a_percent(table):
    for T, exponent in zip(TEMPERATURES, table[1], strict=True):
        assert_allclose(real_nitrogen(T).fast_exponent(PRESSURES), exponent, rtol=5e-3)


@pytest.mark.slow
def test_charge_at_another_temperature():
    charges, temperatures = np.array([10.0, 50.0, 120.0, 200.0]) * bar, np.array([253.15, 273.15, 313.15, 333.15])
    expected = np.empty((4, 4))
    for i, charge in enumerate(charges):
        rho = reference(charge, 293.15)[0]
        for j, T in enumerate(temperatures):
            known, state = coolprop()
            state.update(known.DmolarT_INPUTS, rho, T)
            expected[i, j] = state.p()
    assert_allclose(real_nitrogen().charge_at(charges[:, None], temperatures), expected, rtol=5e-5)


def test_the_inverse_is_exact_over_the_whole_range():
    for T in TEMPERATURES:
        gas = real_nitrogen(T)
        assert_allclose(gas.pressure_of(gas.specific(PRESSURES)), PRESSURES, rtol=2e-14)


def test_thin_gas_is_ideal():
    assert_allclose(real_nitrogen(300.0).specific(np.array([1.0])), 8.314462618 * 300, rtol=1e-8)


def test_second_virial_coefficient_at_300_K():
    """-4.5 cm3/mol (Dymond, Smith, The Virial Coefficients of Pure Gases and Mixtures, 1980)."""
    p = np.array([0.1 * bar])
    assert_allclose(real_nitrogen(300.0).specific(p) - 8.314462618 * 300 / p, -4.5e-6, atol=0.2e-6)


@pytest.mark.slow
@pytest.mark.parametrize(("p1", "error"), [(94 * bar, 0.017), (200 * bar, 0.046)])
def test_fast_change_of_an_accumulator_follows_the_isentrope(p1, error):
    """The exponent at p1, held over a change of volume by a third; with n = 1.4 the error is 3 to 4 times as large."""
    block = AccumulatorBlock([Accumulator(4 * litre, 40 * bar)], real_nitrogen(), atmosphere=0.0)
    rho, _ = reference(p1, 293.15)
    known, state = coolprop()
    entropy = state.smolar()
    for share in (0.7, 0.85, 1.15, 1.3):
        state.update(known.DmolarSmolar_INPUTS, rho * share, entropy)
        withdrawn = block.gas_volume(p1) * (1 / share - 1)
        ours, ideal = (block.fast_pressure(p1, withdrawn, exponent) / state.p() - 1 for exponent in (None, 1.4))
        assert abs(ours) < error
        assert abs(ideal) > 3 * abs(ours)


def test_unreached_poses_stay_unreached():
    p = np.array([50.0, np.nan, 100.0]) * bar
    assert np.array_equal(np.isnan(real_nitrogen().specific(p)), [False, True, False])


@for_all(
    ("call", "message"),
    [
        (lambda: real_nitrogen(20.0), "Temperature of real_nitrogen = 20 K is outside 245..340 K; give kelvin"),
        (lambda: real_nitrogen().at(350.0), "350 K is outside 245..340 K"),
        (lambda: real_nitrogen().volume(600 * bar, 50 * bar, 1e-3), "holds up to 500 bar absolute, and more was asked; lower"),
        (lambda: real_nitrogen().pressure(0.09e-3, 50 * bar, 1e-3), "holds up to 500 bar absolute"),
        (lambda: real_nitrogen().pressure(1e-9, 50 * bar, 1e-3), "holds up to 500 bar absolute"),
        (lambda: real_nitrogen().charge_at(450 * bar, 335.0), "holds up to 500 bar absolute"),
    ],
)
def test_refusals(call, message):
    with pytest.raises(DefinitionError, match=message):
        call()


# -- the equation with itself: one function of state, so that its derivatives must agree ----------------------


def slope_by_difference(f, x, step):
    """Return f' by a central difference of fourth order; step relative."""
    h = step * x
    return (8.0 * (f(x + h) - f(x - h)) - (f(x + 2.0 * h) - f(x - 2.0 * h))) / (12.0 * h)


@pytest.mark.parametrize("temperature", [250.0, 293.15, 335.0])
def test_slope_is_that_of_the_volume(temperature):
    gas, p = real_nitrogen(temperature), np.array([0.5, 5.0, 60.0, 200.0, 450.0]) * bar
    assert_allclose(gas.slope(p), slope_by_difference(gas.specific, p, 1e-3), rtol=1e-8)
    assert np.all(gas.slope(p) < 0.0)


@pytest.mark.parametrize("temperature", [260.0, 293.15, 320.0])
def test_isentropic_exponent_follows_from_the_pressure_alone(temperature):
    """(rho/p) [(dp/drho)_T + T (dp/dT)^2 / (rho^2 cv)], cv = 5/2 R - T int (d2p/dT2) / rho^2 drho: differences and a quadrature."""
    R, T, h = 8.314462618, temperature, 1.0
    nodes, weights = np.polynomial.legendre.leggauss(24)

    def pressure(rho, T):
        return real_nitrogen(T).pressure_of(1.0 / rho)

    p = np.array([5.0, 80.0, 250.0, 400.0]) * bar
    for each in p:
        rho = 1.0 / real_nitrogen(T).specific(np.array(each))
        along = 0.5 * rho * (nodes + 1.0)
        curved = (pressure(along, T + h) - 2.0 * pressure(along, T) + pressure(along, T - h)) / h**2
        cv = 2.5 * R - T * 0.5 * rho * float(weights @ (curved / along**2))
        heating = slope_by_difference(lambda T: pressure(rho, T), T, 1e-3)  # noqa: B023
        stiffness = slope_by_difference(lambda rho: pressure(rho, T), rho, 1e-3)
        exponent = rho / each * (stiffness + T * heating**2 / (rho**2 * cv))
        assert_allclose(real_nitrogen(T).fast_exponent(each), exponent, rtol=2e-5)


def test_the_ends_of_the_range_belong_to_it():
    """245 K, 340 K and 500 bar are said to be in range, and a last digit lost on the way back from a volume is no error."""
    for T in (245.0, 340.0):
        gas = real_nitrogen(T)
        assert_allclose(gas.pressure_of(gas.specific(np.array(500 * bar))), 500 * bar, rtol=1e-13)
    gas = real_nitrogen()
    assert_allclose(gas.specific(500 * bar * (1.0 + 1e-10)), gas.specific(500 * bar), rtol=1e-9)
    for T in (245.0 - 1e-6, 340.0 + 1e-6):
        with pytest.raises(DefinitionError, match=r"outside 245\.\.340 K"):
            real_nitrogen(T)
    with pytest.raises(DefinitionError, match="500 bar"):
        gas.specific(np.array([1.0, 500.01]) * bar)
    with pytest.raises(DefinitionError, match="500 bar"):
        gas.fast_exponent(500.01 * bar)


def test_charge_of_the_own_temperature_is_itself():
    charges = np.array([1.0, 40.0, 250.0, 480.0]) * bar
    for T in (250.0, 293.15, 330.0):
        assert_allclose(real_nitrogen(T).charge_at(charges, T), charges, rtol=1e-13)
        assert real_nitrogen().at(T).temperature == T


def test_it_is_spelled_as_it_is_written():
    assert real_nitrogen().source_text == "real_nitrogen()"
    assert eval(real_nitrogen(280.0).source_text, {"real_nitrogen": real_nitrogen}).temperature == 280.0
