"""Inertia by hand: a crank, a slider-crank, Andrews' squeezer at its first instant, the excavator's boom as it brakes; refusals."""

import re

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, thrust
from linkage import (
    LEFT,
    RIGHT,
    Carried,
    Course,
    Crank,
    DefinitionError,
    Dyad,
    Ground,
    Guide,
    LinkMass,
    Mechanism,
    Moment,
    OnLink,
    Over,
    SliderDyad,
    Spring,
    Stroke,
    Weight,
    angle,
    drive_force,
    driving_force,
    dynamic_factor,
    least,
    most,
    pin_force,
    pin_forces,
    ramp,
)
from linkage.errors import UntracedError
from linkage.loads import Acting, LoadCase, PinFriction
from mechanisms.at_work.excavator import Excavator
from tests.laws.test_time_laws import STEP, changing, masses

G0 = 9.80665


class Swing(Mechanism):
    S = Stroke(0.0, 1.0)
    O = Ground(0, 0)
    A = Crank(O, OA=0.5, angle=S)
    own = LinkMass("O A", mass=3.0, at=(0.2, 0.1), inertia=0.04)
    w = Weight(A, mass=2.0)
    twice = LoadCase("twice", scale={"w": 2.0})
    moon = LoadCase("moon", gravity=(0.0, -1.62))
    go = Over.path(S=ramp(0.0, 1.0, speed=0.8, acceleration=2.0))
    hard = Over.path(S=ramp(0.0, 0.5, speed=0.8).then(ramp(0.5, 1.0, speed=0.3)))


MOVING = Acting(rates={"S": 2.0}, accelerations={"S": 3.0})


def test_a_crank_needs_its_moment_of_inertia_and_its_pin_bears_the_change_of_momentum():
    motion, turn = Swing().at(S=np.linspace(0.0, 1.0, 5)), np.linspace(0.0, 1.0, 5)
    places = [(3.0, 0.2, 0.1), (2.0, 0.5, 0.0)]
    centres = [(m, np.stack([u * np.cos(turn) - h * np.sin(turn), u * np.sin(turn) + h * np.cos(turn)])) for m, u, h in places]
    inertia = 0.04 + sum(m * (u * u + h * h) for m, u, h in places)
    weight = sum(m * G0 * r[0] for m, r in centres)
    assert_allclose(driving_force(motion, acting=MOVING), inertia * 3.0 + weight, rtol=1e-14)
    pull = sum(m * (3.0 * np.stack([-r[1], r[0]]) - 4.0 * r) for m, r in centres)
    (on_frame,) = pin_forces(motion, acting=MOVING).on_body("frame").values()
    assert_allclose(on_frame, -pull - [[0.0], [5.0 * G0]], rtol=1e-13)
    for case, factor, gravity in (("twice", 2.0, G0), ("moon", 1.0, 1.62)):  # a case multiplies masses; its gravity changes weights alone
        acting = Acting(case=case, rates={"S": 2.0}, accelerations={"S": 3.0})
        own = inertia + (factor - 1.0) * 0.5
        wanted = own * 3.0 + gravity * (3.0 * centres[0][1][0] + factor * 2.0 * centres[1][1][0])
        assert_allclose(driving_force(motion, acting=acting), wanted, rtol=1e-14)


class SliderCrank(Mechanism):
    turn = Stroke(0.1, 3.0)
    O, P = Ground(0, 0), Ground(1.0, 0.0)
    A = Crank(O, OA=0.05, angle=turn)
    line = Guide(O, P)
    B = SliderDyad(A, line, AB=0.2, side=RIGHT)
    piston = Weight(B, mass=1.5, gravity=(0.0, 0.0))


def test_a_slider_crank_at_constant_speed():
    """The piston's acceleration by the exact formula; the gas-free torque is its power over the speed of the crank."""
    t, w, r, l = np.linspace(0.2, 2.8, 7), 300.0, 0.05, 0.2
    s, c = np.sin(t), np.cos(t)
    root = np.sqrt(l * l - r * r * s * s)
    v = -r * w * (s + r * s * c / root)
    a = -r * w * w * (c + r * (l * l * (c * c - s * s) + r * r * s**4) / root**3)
    motion, acting = SliderCrank().at(turn=t), Acting(rates={"turn": w}, accelerations={})
    assert_allclose(motion["B"][0], r * c + root, rtol=1e-13)
    assert_allclose(driving_force(motion, acting=acting), 1.5 * a * v / w, rtol=1e-11, atol=1e-9)
    force = pin_forces(motion, acting=acting).force("A", on="OA")
    assert_allclose(force[0], -1.5 * a, rtol=1e-11)


class Squeezer(Mechanism):
    """Andrews' squeezing mechanism. Source: Hairer, Wanner, "Solving Ordinary Differential Equations II", VII.7."""

    beta = Stroke(-0.1, 0.1)
    O, A, B, C = Ground(0, 0), Ground(-0.06934, -0.00227), Ground(-0.03635, 0.03273), Ground(0.014, 0.072)
    F = Crank(O, OF=0.007, angle=beta)
    E = Dyad(F, B, EF=0.028, BE=0.035, side=LEFT)
    D = Carried(B, E, 0.018, 0.020)
    G = Dyad(E, A, EG=0.020, AG=0.040, side=RIGHT)
    H = Dyad(E, A, EH=0.020, AH=0.040, side=LEFT)
    way = angle(E, F)
    k1 = LinkMass("O F", mass=0.04325, at=(0.00092, 0.0), inertia=2.194e-6, gravity=(0.0, 0.0))
    k2 = LinkMass("F E", mass=0.00365, at=(0.0115, 0.0), inertia=4.410e-7, gravity=(0.0, 0.0))
    k3 = LinkMass("B E", mass=0.02373, at=(0.01874, 0.01043), inertia=5.255e-6, gravity=(0.0, 0.0))
    k4 = LinkMass("E G", mass=0.00706, at=(0.01421, 0.0), inertia=5.667e-7, gravity=(0.0, 0.0))
    k5 = LinkMass("A G", mass=0.07050, at=(0.02308, 0.00916), inertia=1.169e-5, gravity=(0.0, 0.0))
    k6 = LinkMass("E H", mass=0.00706, at=(0.01421, 0.0), inertia=5.667e-7, gravity=(0.0, 0.0))
    k7 = LinkMass("A H", mass=0.05498, at=(0.01228, -0.00449), inertia=1.912e-5, gravity=(0.0, 0.0))
    spring = Spring(C, D, stiffness=4530.0, free_length=0.07785)
    drive = Moment("O F", M=0.033)


def test_andrews_squeezer_begins_as_it_is_published():
    """At rest it needs no drive where it is accelerated as published; the angle between crank and rod follows."""
    motion = Squeezer().at(beta=-0.0617138900142764496358948458001)
    given = {"rates": {"beta": 0.0}, "accelerations": {"beta": 14222.4439199541138705911625887}}
    force = driving_force(motion, acting=Acting(**given))
    at_rest = driving_force(motion)
    assert abs(force) < 1e-10 * abs(at_rest)
    assert_allclose(motion.acceleration("way", **given) - 14222.4439199541, -10666.8329399655, rtol=1e-10)


def test_the_excavators_boom_brakes():
    """With a full bucket its cylinder carries 6.84 kN while the boom brakes, and 30.25 kN at rest; by the energy of all masses."""
    time = STEP * np.arange(-4, 5)
    v, a = 0.15 - 0.8 * time, -0.8
    motion = Excavator().at(lift=0.3 + 0.15 * time - 0.4 * time**2, swing=0.2, curl=0.4)
    acting = Acting(case="carrying", rates={"lift": v}, accelerations={"lift": a})
    found, still = thrust("boom.ram", acting=acting).of(motion)[4], thrust("boom.ram", case="carrying").of(motion)[4]
    kept = [(m, place, speed, inertia, spin) for m, place, speed, inertia, spin in masses(motion, {"lift": v})]
    energy = sum(m * (G0 * place[1] + 0.5 * (speed**2).sum(axis=0)) + 0.5 * inertia * spin**2 for m, place, speed, inertia, spin in kept)
    assert_allclose(found, changing(energy) / 0.15, rtol=1e-9)
    assert_allclose([found, still], [6840.51, 30250.60], rtol=1e-6)


class Lifted(Mechanism):
    """An arm on a cylinder of two bodies."""

    S = Stroke(0.0, 0.3)
    O, A = Ground(0, 1), Ground(0.3, 0.2)
    B = Dyad(A, O, AB=0.75 + S, OB=0.6, side=RIGHT)
    G = OnLink(O, B, OG=1.5)
    lift = Cylinder(A, B, bore=0.08, rod=0.045, closed=0.74, stroke=0.32, barrel_mass=20.0, rod_mass=10.0, count=2)
    w = Weight(G, mass=40.0)


def test_barrel_and_rod_are_uniform_bars():
    """Their kinetic energy is that of bars as long as the cylinder is closed, one about A, one with B."""
    time = STEP * np.arange(-4, 5)
    v, a = 0.3 + 2.0 * time, 2.0
    motion = Lifted().at(S=0.15 + 0.3 * time + time**2)
    found = pin_forces(motion, acting=Acting(rates={"S": v}, accelerations={"S": a}))
    energy = 40.0 * (G0 * motion["G"][1] + 0.5 * (motion.velocity("G", {"S": v}) ** 2).sum(axis=0))
    for mass, ends in ((40.0, ("A", "lift.gland")), (20.0, ("B", "lift.piston"))):
        P, Q = (motion.velocity(each, {"S": v}) for each in ends)
        energy = energy + mass / 6.0 * (P * P + P * Q + Q * Q).sum(axis=0)
        energy = energy + 0.5 * mass * G0 * (motion[ends[0]][1] + motion[ends[1]][1])
    assert_allclose(found.drives["S"][4] * 0.3, changing(energy), rtol=1e-9)
    assert found.residual < 1e-12
    assert_allclose(Lifted.lift.thrust(motion, acting=found._found.applied.acting), found.thrusts["lift"], rtol=1e-12)


def test_inertia_counts_where_accelerations_are_known():
    swing, still = Swing(), Acting(inertia=False)
    go, hard, at = swing.sweep(5, over="go"), swing.sweep(5, over="hard"), swing.at(S=0.4)
    assert np.all(driving_force(go)[[0, -1]] - driving_force(go, acting=still)[[0, -1]] != 0.0)
    assert np.array_equal(driving_force(hard), driving_force(hard, acting=still))  # a rate jumps
    alone, steady = Acting(rates={"S": 2.0}), Acting(rates={"S": 2.0}, inertia=True)
    assert driving_force(at, acting=alone) == driving_force(at) and pin_forces(at, acting=steady).drives["S"] == driving_force(at)
    assert pin_force("O", acting=steady).of(at) != pin_force("O").of(at)  # rates that do not change: what turns pulls outwards
    slope = go.gradient(drive_force(), wrt=["own.inertia"])
    assert_allclose(slope[0], go.accelerations["S"], atol=1e-12)


class Rubbing(Swing):
    rub = PinFriction("O", radius=0.02, coefficient=0.1)


def test_in_every_load_case_the_judge_counts_inertia_as_the_motion_does():
    asked = {"force": drive_force(), "pin": pin_force("O"), "factor": dynamic_factor(drive_force())}
    swing, motion = Swing(), Swing().sweep(801, over="go")
    for case in ("plain", "twice", "moon"):
        runs = Over.path(S=ramp(0.0, 1.0, speed=0.8, acceleration=2.0), cases=[case])
        for name, request in asked.items():
            here = request.under(Acting(case=case))
            values = motion[here]
            for judged in (
                swing.answers([most(request), least(request)], acting=Acting(case=case), over="go"),
                swing.answers([most(request), least(request)], over=runs),
                swing.answers([most(here), least(here)], over="go"),
            ):
                found = [each.value for each in judged]
                assert_allclose(found, [values.max(), values.min()], rtol=5e-3, err_msg=f"{name} {case}")
        assert found[0] > 1.05 and found[1] < 0.95


def test_a_rate_that_ends_or_begins_at_once_within_a_path_is_a_jump():
    """One course stops dead before the path ends, another one starts at speed behind its begin: neither has a force of inertia there."""

    class Pair(Swing):
        T = Stroke(0.0, 1.0)
        B = Crank("O", OB=0.4, angle=T)
        go = hard = None

    soft, late = ramp(0.0, 0.9, speed=0.5, acceleration=1.0), Course([0.5, 1.5], [0.2, 0.9], kind="straight")
    for S, at in [(ramp(0.0, 0.8, speed=0.8), "0.8 rad/s at 1 s"), (late, "0.7 rad/s at 0.5 s"), (soft, "")]:
        motion = Pair().sweep(9, over=Over.path(S=S, T=soft, time=(0.0, 2.3)))
        still = driving_force(motion, drive="S", acting=Acting(inertia=False))
        assert np.array_equal(driving_force(motion, drive="S"), still) == bool(at)
        if at:
            with pytest.raises(DefinitionError, match=f"the rate of S jumps by {at}"):
                driving_force(motion, drive="S", acting=Acting(inertia=True))


def test_verdicts_tell_where_inertia_or_a_start_is_left_out():
    def told(over, machine=Swing):
        return [str(each) for each in machine().verdicts(over=over) if "give its ramp an acceleration" in str(each)]

    swing, sudden = Swing.plan.members, ramp(0.0, 1.0, speed=0.8)
    assert told(swing["go"]) == []
    (jump,) = told(swing["hard"])
    remedy = "give its ramp an acceleration, or take a smooth course."
    assert jump == f"the rate of S jumps by 0.5 rad/s at 0.625 s, so that inertia is left out: {remedy}"
    straight = Course([0.0, 1.0], [0.2, 0.9], kind="straight")
    stopped = ramp(0.0, 0.5, speed=0.8, acceleration=2.0).then(ramp(0.5, 1.0, speed=0.3))
    for course in (sudden, -sudden + 1.0, sudden.part(0.0, 0.5), straight, stopped):
        assert len(told(Over.path(S=course))) == 1
    both = told([Over.path(S=sudden), swing["hard"]])
    assert "S starts or stops at once" in both[0] and both[1].startswith("hard: the rate")

    class Bare(Swing):
        own = w = twice = None

    assert told(swing["hard"], Bare) == []


def test_friction_takes_the_joint_forces_with_inertia():
    go, frictionless = Rubbing().sweep(5, over="go"), Acting(direction="frictionless")
    assert np.all((driving_force(go) - driving_force(go, acting=frictionless))[1:-1] > 0.0)
    with pytest.raises(UntracedError, match="frictionless"):
        go.gradient(drive_force(), wrt=["own.inertia"])
    assert_allclose(go.gradient(drive_force(acting=frictionless), wrt=["own.inertia"])[0], go.accelerations["S"], atol=1e-12)


def test_what_inertia_cannot_be_is_refused_in_words():
    swing = Swing()
    hard, at = swing.sweep(5, over="hard"), swing.at(S=0.4)
    for ask, words in [
        (lambda: Acting(accelerations={"S": 1.0}), "accelerations say how rates change, and no rates are given"),
        (lambda: Acting(rates={"S": 1.0}, accelerations=3.0), "a value for each stroke is expected"),
        (lambda: Acting(inertia=1), "True or False is expected"),
        (lambda: LinkMass("O A", mass=3.0, inertia=1.0), "at= does not say where that is"),
        (lambda: LinkMass("O A", mass=3.0, at=(0, 0), inertia=-1.0), "inertia=-1.0 is negative"),
        (lambda: driving_force(at, acting=Acting(inertia=True)), "nothing says how the strokes move"),
        (lambda: driving_force(hard, acting=Acting(inertia=True)), "the rate of S jumps by 0.5 rad/s at 0.625 s: give the ramp of S"),
        (lambda: driving_force(at, acting=Acting(rates="as it runs")), "this motion has no rates of its own"),
        (lambda: swing.evaluate([drive_force()], S=0.1, accelerations={"S": 1.0}), "no rates= are given"),
        (lambda: swing.evaluate([drive_force()], S=[0.1, 0.2], rates={"S": [1.0, 2.0, 3.0]}), "do not fit each other"),
        (lambda: swing.evaluate([drive_force(acting=MOVING)], S=0.1, rates={"S": 1.0}), "drop one of them"),
        (lambda: swing.function([drive_force()], accelerations=True), "ask for rates=True as well"),
        (lambda: swing.function([drive_force()], rates=True)(0.1), "one value for each stroke and then for each of their rates"),
    ]:
        with pytest.raises(DefinitionError, match=re.escape(words)):
            ask()
