"""The ideal gas laws: their formulas, exact inverses, and what they refuse."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from hydraulics import adiabatic, isothermal, polytropic, real_nitrogen
from linkage.errors import DefinitionError
from linkage.units import bar, litre
from tests.for_all import for_all

LAWS = (isothermal, polytropic(1.2), adiabatic, real_nitrogen(), real_nitrogen(250.0))
pressures = st.floats(1 * bar, 490 * bar)


@pytest.mark.parametrize(("n", "volume"), [(1.0, 2.0), (1.4, 4 * 0.5 ** (1 / 1.4)), (2.0, 4 * 0.5**0.5)])
def test_volume_at_twice_the_charge(n, volume):
    assert_allclose(polytropic(n).volume(100 * bar, p0=50 * bar, V0=4 * litre), volume * litre, rtol=1e-14)


@given(law=st.sampled_from(LAWS), p=pressures, p0=pressures)
def test_pressure_inverts_volume(law, p, p0):
    volume = law.volume(p, p0, 4 * litre)
    assert_allclose(law.pressure(volume, p0, 4 * litre), p, rtol=2e-14)
    assert_allclose(law.volume(law.pressure(volume, p0, 4 * litre), p0, 4 * litre), volume, rtol=2e-14)


@for_all("law", LAWS, ids=str)
def test_many_states_at_once_are_the_single_ones(law):
    p, p0 = np.linspace(20, 300, 5)[:, None] * bar, np.array([10.0, 60.0, 90.0]) * bar
    volumes = law.volume(p, p0, 2 * litre)
    assert volumes.shape == (5, 3)
    assert_allclose(volumes, [[law.volume(a, b, 2 * litre) for b in p0] for a in p[:, 0]], rtol=1e-15)
    assert law.pressure(volumes, p0, 2 * litre).shape == (5, 3)


@for_all("law", LAWS, ids=str)
def test_slope_is_the_limit_of_the_differences(law):
    p = np.array([2.0, 50.0, 200.0, 450.0]) * bar

    def error(step):
        return np.abs((law.specific(p * (1 + step)) - law.specific(p * (1 - step))) / (2 * step * p) / law.slope(p) - 1)

    assert np.all(error(1e-2) < 1e-3)
    assert_allclose(error(1e-2) / error(1e-3), 100, rtol=0.05)  # second order


def test_charge_follows_the_absolute_temperature():
    assert_allclose(isothermal.charge_at(50 * bar, [253.15, 293.15, 333.15]), 50 * bar * np.array([253.15, 293.15, 333.15]) / 293.15)
    assert_allclose(polytropic(1.2, temperature=300.0).charge_at(50 * bar, 330.0), 55 * bar)
    assert adiabatic.at(300.0).n == 1.4
    assert adiabatic.at(300.0).temperature == 300.0


def test_a_fast_change_of_an_ideal_gas_is_adiabatic():
    assert_allclose(isothermal.fast_exponent([1 * bar, 100 * bar]), [1.4, 1.4])


def test_a_law_says_what_it_is():
    assert [str(law) for law in LAWS[:4]] == [
        "isothermal gas (p V = const)",
        "polytropic gas (p V^1.2 = const)",
        "polytropic gas (p V^1.4 = const)",
        "real nitrogen at 293.15 K",
    ]


@for_all(
    ("call", "message"),
    [
        (lambda: polytropic(0.9), r"exponent n = 0.9 is outside 1..10; 1 is isothermal"),
        (lambda: polytropic(np.nan), "Polytropic exponent = nan is not finite"),
        (lambda: polytropic("1.4"), "Polytropic exponent = '1.4' is not a number"),
        (lambda: polytropic(1.2, temperature=20.0), "Gas temperature = 20 K is outside 200..400 K; give kelvin"),
        (lambda: isothermal.at(-20.0), "give kelvin: 20 deg C is 293.15"),
        (lambda: isothermal.charge_at(50 * bar, [293.15, 20.0]), "Gas temperature = 20 K is outside"),
        (lambda: isothermal.charge_at(0.0, 293.15), "Charge pressure = 0 is not above zero"),
        (lambda: isothermal.volume(-1.0, 1e5, 1e-3), "Gas pressure = -1 is not above zero"),
        (lambda: isothermal.volume(1e5, 0.0, 1e-3), "Charge pressure = 0 is not above zero"),
        (lambda: isothermal.volume(1e5, 1e5, -1e-3), "Charge volume = -0.001 is not above zero"),
        (lambda: isothermal.pressure([1e-3, 0.0], 1e5, 1e-3), "Gas volume = 0 is not above zero"),
        (lambda: isothermal.pressure(np.inf, 1e5, 1e-3), "Gas volume = inf is not finite"),
    ],
)
def test_refusals(call, message):
    with pytest.raises(DefinitionError, match=message):
        call()
