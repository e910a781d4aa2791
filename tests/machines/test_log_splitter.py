"""A log splitter: a cylinder bends a toggle straight, the toggle drives the wedge along its rail into the log."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, lift_verdicts
from linkage import (
    LEFT,
    RIGHT,
    Actuator,
    Between,
    Dyad,
    Force,
    Ground,
    Guide,
    GuideFriction,
    LinkMass,
    Mechanism,
    SingularError,
    SliderDyad,
    Spring,
    Stroke,
    Support,
    Weight,
    bar,
    driving_force,
    kN,
    litre,
    mm,
    pin_forces,
    reaction,
)
from linkage.units import minute
from tests.machines.machines_b_truth import G, critical, meet, over, power, said_of, size, slopes, stretch, unit, weight
from tests.mechanisms.free_bodies import FreeBodies

STRAIGHT = np.hypot(0.42 - 0.30, 1.05) - 0.70        # the cylinder's stroke that draws O, K and W into one line, m


class Splitter(Mechanism):
    """Toggle O-K-W under the cylinder AK; the log between wedge W and anvil X lies a little high."""

    S = Stroke(0.0, 0.345)

    O = Ground(0.0, 0.0)
    A = Ground(0.30, 1.05)
    X = Ground(1.30, 0.04)                              # anvil
    Y = Ground(-0.15, -0.10)                            # where the return spring hangs
    rail = Guide((0.0, 0.0), angle=0)

    K = Dyad(A, O, AK=0.70 + S, OK=0.42, side=LEFT)
    W = SliderDyad(K, rail, KW=0.42, side=RIGHT)

    back = LinkMass("O K", mass=18)
    front = LinkMass("K W", mass=18)
    wedge = Weight(W, mass=25)
    log = Actuator(W, X, force=60 * kN)
    home = Spring(Y, W, stiffness=1500, free_length=0.35)

    press = Cylinder(A, K, bore=125 * mm, rod=45 * mm, closed=0.70, stroke=0.36)
    pump = LiftCircuit(press, pressure=250 * bar, relief=280 * bar, flow=30 * litre / minute, mechanical_efficiency=0.92)


def place(S):
    O, A, X, Y = (np.array(each) for each in ([0.0, 0.0], [0.30, 1.05], [1.30, 0.04], [-0.15, -0.10]))
    K = meet(A, 0.70 + S, O, 0.42, left=True)
    W = np.array([K[0] + np.sqrt(0.42**2 - K[1] ** 2), 0.0 * K[0]])
    return {"O": O, "A": A, "X": X, "Y": Y, "K": K, "W": W, "OK": (O + K) / 2, "KW": (K + W) / 2}


WEIGHTS = [("OK", weight(18)), ("KW", weight(18)), ("W", weight(25))]


def pushes(at):
    """Return the thrusts of log and return spring [N]."""
    return {"log": 60e3, "home": 1500 * (0.35 - size(at["W"] - at["Y"]))}


def thrust(S):
    """Return what the cylinder carries [N], by virtual work; its length is 0.70 + S."""
    at, slope = place(S), slopes(place, "S", S=S)
    given = pushes(at)
    work = power(slope, WEIGHTS) + given["log"] * stretch(at, slope, "W", "X") + given["home"] * stretch(at, slope, "Y", "W")
    idle = -power(slope, WEIGHTS) - given["home"] * stretch(at, slope, "Y", "W")
    return {"press": -work, "ratio": slope["W"][0], "idle": idle, "home": given["home"]}


def truth(S, rubbing=0.0):
    """Return the cylinder's thrust and the pin forces by free bodies; `rubbing` [N] acts on the wedge along the rail."""
    at = place(S)
    given, free = pushes(at), FreeBodies()
    free.pin("O", "back", "frame", at["O"])
    free.thrust("press", "frame", at["A"], "back", at["K"])
    free.pin("K", "front", "back", at["K"])
    free.across("rail", "front", "frame", at["W"], (1, 0))
    for force in (given["log"] * unit(at["X"], at["W"]), given["home"] * unit(at["Y"], at["W"]), (rubbing, 0.0), weight(25)):
        free.load("front", at["W"], force)
    free.load("back", at["OK"], weight(18))
    free.load("front", at["KW"], weight(18))
    found = free.solve()
    pins = {name: np.array([found[f"{name}x"], found[f"{name}y"]]) for name in "OK"}
    return {**pins, "press": found["press"], "rail": found["rail"], "u": unit(at["A"], at["K"])}


def rubbed(S, coefficient, way):
    """Return the truth with Coulomb's friction on the rail: the wedge goes to +x while the cylinder grows (`way` 1)."""
    found = truth(S)
    for _ in range(80):
        found = truth(S, -way * coefficient * abs(found["rail"]))
    return found


def test_where_everything_is():
    motion = Splitter().sweep(9)
    own = over(motion.strokes, place)
    for name in "KW":
        assert_allclose(motion[name], own[name], rtol=0, atol=1e-13)


def test_thrust_and_pins():
    motion = Splitter().sweep(9)
    work, own = over(motion.strokes, thrust), over(motion.strokes, truth)
    assert_allclose(own["press"], work["press"], rtol=1e-11)
    assert_allclose(Splitter.press.thrust(motion), work["press"], rtol=1e-11)
    assert_allclose(driving_force(motion), work["press"], rtol=1e-11)
    forces = pin_forces(motion)
    for name, on in (("O", "OK"), ("K", "KW")):
        assert_allclose(forces.force(name, on=on), own[name], rtol=1e-10, atol=1e-6)
    assert_allclose(forces.force("K", on="press"), -own["press"] * own["u"], rtol=1e-10, atol=1e-6)
    assert_allclose(forces.force("A", on="frame"), -own["press"] * own["u"], rtol=1e-10, atol=1e-6)
    log = over(motion.strokes, lambda S: {"u": unit(place(S)["W"], place(S)["X"])})["u"]
    assert_allclose(forces.force("X", on="frame"), 60e3 * log, rtol=1e-12, atol=1e-7)
    assert_allclose(forces.force("X", on="log"), -60e3 * log, rtol=1e-12, atol=1e-7)
    assert_allclose(forces.thrusts["home"], work["home"], rtol=1e-12)
    assert forces.residual < 1e-12
    assert_allclose(sum(forces.on_body("frame").values()), [np.zeros(9), np.full(9, -61 * G)], atol=1e-6)       # the log holds itself


@pytest.mark.parametrize("coefficient", [0.1, 0.2])
def test_the_rail_rubs(coefficient):
    motion = Splitter().sweep(7)
    loads = ["back", "front", "wedge", "log", "home", GuideFriction("W", coefficient)]
    for direction, way in (("extending", 1.0), ("retracting", -1.0)):
        own = over(motion.strokes, lambda S, way=way: rubbed(S, coefficient, way))
        assert_allclose(Splitter.press.thrust(motion, loads, direction=direction), own["press"], rtol=1e-9)
        forces = pin_forces(motion, loads, direction=direction)
        assert_allclose(forces.thrusts["press"], own["press"], rtol=1e-9)
        assert_allclose(forces.force("K", on="KW"), own["K"], rtol=1e-9, atol=1e-4)


def test_the_log_as_a_force_says_the_same():
    motion = Splitter().sweep(7)
    log = over(motion.strokes, lambda S: {"F": -60e3 * unit(place(S)["W"], place(S)["X"])})["F"]
    loads = ["back", "front", "wedge", "home", Force("W", (log[0], log[1]))]
    assert_allclose(Splitter.press.thrust(motion, loads), Splitter.press.thrust(motion), rtol=1e-12)
    assert_allclose(pin_forces(motion, loads).force("O", on="OK"), pin_forces(motion).force("O", on="OK"), rtol=1e-11, atol=1e-6)


def test_pressure_reserve_and_capacity():
    motion = Splitter().sweep(9)
    work, piston = over(motion.strokes, thrust), np.pi / 4 * 0.125**2
    assert work["press"].min() > 0
    assert_allclose(Splitter.press.pressure(motion), work["press"] / 0.92 / piston, rtol=1e-10)
    assert_allclose(Splitter.pump.pressure_for(motion), work["press"] / 0.92 / piston, rtol=1e-10)
    assert_allclose(Splitter.pump.reserve(motion), 250e5 * piston * 0.92 / work["press"], rtol=1e-10)
    most = (250e5 * piston * 0.92 - work["idle"]) / work["ratio"]
    found = Splitter.pump.capacity(motion, "W", along=(1, 0), loads=["back", "front", "wedge", "home"])
    assert_allclose(found, most, rtol=1e-10)
    assert_allclose(Splitter.pump.holding(motion).working, work["press"] / piston, rtol=1e-10)


def knotty(wide):
    """Return the splitter's class with a knot in the log, `wide` [m] along the wedge's way: 100 kN more where W is at 0.64 m."""
    return type("Knotty", (Splitter,), {"knot": Between("W", "X", lambda length, rate: knot(length, wide))})


def knot(length, wide):
    return 100e3 / (1.0 + ((length - 0.66) / wide) ** 2)


@pytest.mark.slow
@pytest.mark.parametrize(("wide", "counts"), [(8 * mm, (5,)), (0.3 * mm, (2, 50))])
def test_verdicts_from_few_poses(wide, counts):
    """The least reserve, the fullest pressure and the most used rod lie at the knot, between whatever poses were given."""

    def carried(S):
        at, slope = place(S), slopes(place, "S", S=S)
        return thrust(S)["press"] - knot(size(at["X"] - at["W"]), wide) * stretch(at, slope, "W", "X")

    near = peak(carried, wide)
    least = 250e5 * np.pi / 4 * 0.125**2 * 0.92 / carried(near)
    assert least < 250e5 * np.pi / 4 * 0.125**2 * 0.92 / carried(0.0)
    machine = knotty(wide)
    said = [[str(each) for each in lift_verdicts(machine.pump, machine().sweep(n))] for n in counts]
    assert all(each == said[0] for each in said)
    (lifting,) = [each for each in said[0] if "lifting" in each]
    assert f"{least:.3f}" in lifting
    assert f"S = {near / mm:.1f} mm" in lifting
    use = 3.5 * carried(near) / 0.92 / critical(0.70 + near, 0.045)
    checks = [said_of(machine.press.checks(machine().sweep(n)), "buckling") for n in counts]
    assert {each.ok for each in checks} == {bool(use <= 1.0)}
    assert len({str(each) for each in checks}) == 1
    assert f"safety {3.5 / use:.3g}" in str(checks[0])


def peak(carried, wide):
    """Return the stroke at which most is carried, by ever finer combs around the knot."""
    low, high = 0.0, 0.345
    while high - low > 1e-9:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if place(middle)["W"][0] < 0.64 else (low, middle)
    low, high = low - 3 * wide, high + 3 * wide
    for _ in range(5):
        comb = np.linspace(low, high, 61)
        best = int(np.argmax([carried(float(each)) for each in comb]))
        low, high = comb[max(best - 1, 0)], comb[min(best + 1, 60)]
    return 0.5 * (low + high)


def test_where_the_toggle_is_straight():
    """Nothing the wedge bears comes back to the cylinder there: a thrust that is finite, and no wedge force that could be told."""
    motion = Splitter().at(S=[0.2, STRAIGHT])
    support = Support("W", (-1, 0))
    own = over({"S": np.array([0.2])}, thrust)
    weights = ["back", "front", "wedge", "log", "home"]
    at, slope = place(STRAIGHT), slopes(place, "S", S=STRAIGHT)
    still = -power(slope, [("OK", weight(18)), ("KW", weight(18))])
    assert abs(slope["W"][0]) < 1e-12 and size(at["K"] - at["O"]) > 0.4
    assert_allclose(driving_force(motion, weights), [own["press"][0], still], rtol=1e-9)
    found = reaction(Splitter().at(S=0.2), weights, support, drive_force=200e3)
    assert_allclose(found, (200e3 - own["press"][0]) / own["ratio"][0], rtol=1e-10)
    with pytest.raises(SingularError):
        reaction(motion, weights, support, drive_force=200e3)
