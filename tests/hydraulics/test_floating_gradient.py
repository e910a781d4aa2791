"""Exact derivatives of a floating cylinder's thrust: through the accumulators' law, by charges, volumes and lengths."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Accumulator, AccumulatorBlock, FloatCircuit, adiabatic, isothermal, polytropic, real_nitrogen
from linkage import DefinitionError, drive_force, driving_force, pin_force, pin_forces
from linkage.units import kgf_cm2, litre
from mechanisms.header_balancer import HeaderBalancer
from tests.for_all import for_all

STROKE = np.linspace(0.02, 0.40, 9)
ALONE = ["floating"]


def with_gas(gas, **settings):
    """Return a balancer whose two accumulators have a gas and charges of their own."""

    class Balancer(HeaderBalancer):
        block = AccumulatorBlock([Accumulator(4 * litre, 50 * kgf_cm2), Accumulator(4 * litre, 25 * kgf_cm2)], gas)
        floating = FloatCircuit("lift", block, charge_pressure="charge", at="h_horizon", **settings)

    return Balancer


CIRCUITS = {
    "isothermal": with_gas(isothermal),
    "adiabatic": with_gas(adiabatic),
    "polytropic": with_gas(polytropic(1.25)),
    "fast": with_gas(isothermal, exponent=1.4),
}


@pytest.mark.parametrize("machine", CIRCUITS.values(), ids=CIRCUITS)
def test_thrust_and_pin_forces_are_those_of_the_arrays(machine):
    motion = machine().at(h=STROKE)
    found = machine().evaluate([drive_force(), drive_force(loads=ALONE), pin_force("O", "OBRG1G2")], h=STROKE)
    forces = pin_forces(motion)
    assert_allclose(found[0], driving_force(motion), rtol=1e-12, atol=1e-8)
    assert_allclose(found[1], driving_force(motion, ALONE), rtol=1e-12)
    assert_allclose(found[2], np.hypot(*forces.force("O", on="OBRG1G2")), rtol=1e-11)


@pytest.mark.parametrize("machine", CIRCUITS.values(), ids=CIRCUITS)
def test_the_gradient_is_the_difference_of_designs(machine):
    """Away from the strokes at which an accumulator joins or the line runs empty."""
    names = ["charge", "lift.bore", "L_OB", "L_min", "A.x", "O.y"]
    stroke = STROKE[[0, 2, 4]]
    found = machine().at(h=stroke).gradient(drive_force(loads=ALONE), names)
    for name, each in zip(names, found, strict=True):
        value = machine()[name] if "." not in name else machine().dimensions[name]
        step = 1e-4 * max(abs(value), 0.1)
        far = [driving_force(machine(**{name: value + k * step}).at(h=stroke), ALONE) for k in (1, -1, 2, -2)]
        assert_allclose(each, (8 * (far[0] - far[1]) - (far[2] - far[3])) / (12 * step), rtol=1e-7, atol=1e-7 * np.abs(each).max())


def test_charges_volumes_and_the_exponent_have_derivatives():
    names, stroke = ["charge", "V_II", "P_II", "atmosphere", "n"], STROKE[2:5]
    balancer = HeaderBalancer(n=1.3)
    found = balancer.at(h=stroke).gradient(drive_force(), names)
    for name, each in zip(names, found, strict=True):
        step = 1e-4 * balancer[name]
        far = [driving_force(HeaderBalancer(**{"n": 1.3} | {name: balancer[name] + k * step}).at(h=stroke)) for k in (1, -1, 2, -2)]
        assert_allclose(each, (8 * (far[0] - far[1]) - (far[2] - far[3])) / (12 * step), rtol=1e-6)


def test_the_exponent_1_is_another_law_and_has_no_derivative():
    motion = HeaderBalancer().at(h=STROKE)
    assert np.isfinite(motion.gradient(drive_force(), ["charge"])).all()
    with pytest.raises(DefinitionError, match=r"no derivative by n: the law of floating"):
        motion.gradient(drive_force(), ["charge", "n"])


def test_real_nitrogen_is_refused_by_name():
    machine = with_gas(real_nitrogen())
    assert np.isfinite(driving_force(machine().at(h=STROKE))).all()
    with pytest.raises(DefinitionError, match="the law of floating cannot be traced: real_nitrogen"):
        machine().at(h=STROKE).gradient(drive_force(), ["L_OB"])


def test_what_the_block_refuses_is_refused_in_its_words():
    small = HeaderBalancer(V_I=1e-4, V_II=1e-4)
    for ask in (lambda: small.evaluate([drive_force()], h=STROKE), lambda: small.at(h=STROKE).gradient(drive_force(), ["L_OB"])):
        with pytest.raises(DefinitionError, match="leaves no gas"):
            ask()


class Alone(HeaderBalancer):
    """A balancer with one accumulator."""

    floating = FloatCircuit(
        "lift", AccumulatorBlock([Accumulator("V_II", "P_II")], isothermal, "atmosphere"),
        charge_pressure="charge", at="h_horizon", seal_friction="seals", exponent="n",
    )  # fmt: skip


@for_all("n", [1.0, 1.3])
@for_all("charge", [0.0, 20 * kgf_cm2, 50 * kgf_cm2])
def test_an_absent_vessel_is_not_there_in_traced_laws_either(charge, n):
    names = ["charge", "V_II", "P_II", "atmosphere", "L_OB", "lift.bore"]
    both, alone = HeaderBalancer(V_I=0.0, P_I=charge, n=n, atmosphere=0.0), Alone(n=n, atmosphere=0.0)
    assert_allclose(both.evaluate([drive_force()], h=STROKE), alone.evaluate([drive_force()], h=STROKE), rtol=1e-14)
    assert_allclose(both.evaluate([drive_force()], h=STROKE)[0], driving_force(both.at(h=STROKE)), rtol=1e-12)
    expected = alone.at(h=STROKE[2:6]).gradient(drive_force(), names)
    assert_allclose(both.at(h=STROKE[2:6]).gradient(drive_force(), names), expected, rtol=1e-12)


@pytest.mark.parametrize("charge", [15 * kgf_cm2, 30 * kgf_cm2, 80 * kgf_cm2])
def test_what_a_vessel_would_add_is_the_slope_at_zero(charge):
    """By differences to one side; a charge below the line's, above it, and one that never joins."""
    stroke, step = STROKE[[0, 2, 4]], 1e-3 * litre
    found = HeaderBalancer(V_I=0.0, P_I=charge).at(h=stroke).gradient(drive_force(loads=ALONE), ["V_I"])[0]
    none, one, two = (driving_force(HeaderBalancer(V_I=k * step, P_I=charge).at(h=stroke), ALONE) for k in range(3))
    assert_allclose(found, (4 * one - two - 3 * none) / (2 * step), rtol=1e-5, atol=1e-6 * np.abs(none).max() / litre)
