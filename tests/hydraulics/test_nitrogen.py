"""The short equation of state of nitrogen against CoolProp's reference equation (Span et al. 2000)."""

import CoolProp
import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Accumulator, AccumulatorBlock, real_nitrogen
from linkage.errors import DefinitionError
from linkage.units import bar, litre

TEMPERATURES = np.linspace(245.0, 340.0, 20)
PRESSURES = np.concatenate([np.geomspace(0.5, 20.0, 8), np.linspace(27.0, 500.0, 40)]) * bar
STATE = CoolProp.AbstractState("HEOS", "Nitrogen")


def reference(pressure, temperature):
    """Return the molar density [mol/m3] and the isentropic exponent of CoolProp."""
    STATE.update(CoolProp.PT_INPUTS, pressure, temperature)
    rho = STATE.rhomolar()
    return rho, rho / pressure * STATE.first_partial_deriv(CoolProp.iP, CoolProp.iDmolar, CoolProp.iSmolar)


@pytest.fixture(scope="module")
def table():
    """Density and exponent, each (temperatures, pressures)."""
    return np.moveaxis([[reference(p, T) for p in PRESSURES] for T in TEMPERATURES], -1, 0)


def test_volume_and_pressure_within_4e_5(table):
    for T, rho in zip(TEMPERATURES, table[0], strict=True):
        gas = real_nitrogen(T)
        assert_allclose(gas.specific(PRESSURES) * rho, 1.0, rtol=0, atol=4e-5)
        assert_allclose(gas.pressure_of(1 / rho[:-1]), PRESSURES[:-1], rtol=4e-5)


def test_isentropic_exponent_within_half_a_percent(table):
    for T, exponent in zip(TEMPERATURES, table[1], strict=True):
        assert_allclose(real_nitrogen(T).fast_exponent(PRESSURES), exponent, rtol=5e-3)


def test_charge_at_another_temperature():
    charges, temperatures = np.array([10.0, 50.0, 120.0, 200.0]) * bar, np.array([253.15, 273.15, 313.15, 333.15])
    expected = np.empty((4, 4))
    for i, charge in enumerate(charges):
        rho = reference(charge, 293.15)[0]
        for j, T in enumerate(temperatures):
            STATE.update(CoolProp.DmolarT_INPUTS, rho, T)
            expected[i, j] = STATE.p()
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


@pytest.mark.parametrize(("p1", "error"), [(94 * bar, 0.017), (200 * bar, 0.046)])
def test_fast_change_of_an_accumulator_follows_the_isentrope(p1, error):
    """The exponent at p1, held over a change of volume by a third; with n = 1.4 the error is 3 to 4 times as large."""
    block = AccumulatorBlock([Accumulator(4 * litre, 40 * bar)], real_nitrogen(), atmosphere=0.0)
    rho, _ = reference(p1, 293.15)
    entropy = STATE.smolar()
    for share in (0.7, 0.85, 1.15, 1.3):
        STATE.update(CoolProp.DmolarSmolar_INPUTS, rho * share, entropy)
        withdrawn = block.gas_volume(p1) * (1 / share - 1)
        ours, ideal = (block.fast_pressure(p1, withdrawn, exponent) / STATE.p() - 1 for exponent in (None, 1.4))
        assert abs(ours) < error
        assert abs(ideal) > 3 * abs(ours)


def test_unreached_poses_stay_unreached():
    p = np.array([50.0, np.nan, 100.0]) * bar
    assert np.array_equal(np.isnan(real_nitrogen().specific(p)), [False, True, False])


@pytest.mark.parametrize(
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
