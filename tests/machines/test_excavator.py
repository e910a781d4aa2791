"""A small excavator, three cylinders, its bucket on a four-bar linkage; declared by its cylinders' lengths and by its joints' angles.

Source of the figures: a published planar model of a small machine (github yitingHH-bit/eXactMPC_v1, excavatorConstants.py).
Arm and bucket lengths run against their angles. Bores, circuits and the digging force are illustrative.
"""

from math import atan2, hypot

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, lift_verdicts
from linkage import (
    LEFT,
    RIGHT,
    Actuator,
    Crank,
    Dyad,
    Force,
    Ground,
    Mechanism,
    OnLink,
    PinFriction,
    Stroke,
    Weight,
    angle,
    distance,
    driving_force,
    pin_forces,
)
from linkage.units import bar, litre, minute, mm
from tests.machines import plane
from tests.machines.words import number
from tests.mechanisms.free_bodies import FreeBodies

FOOT = (0.135, -0.264)  # C on the frame, from the boom's pivot B [m]
BOOM = {"A": (2.05, 0.0), "D": (1.025, 0.278), "E": (0.977, 0.737), "G1": (1.025, 0.384)}  # from B, along the boom
ARM = {"F": (-0.251, 0.158), "G": (-0.134, 0.32), "J": (0.88, 0.0), "L": (1.05, 0.0), "G2": (0.225, 0.227)}  # from A
BUCKET = {"K": (-0.014, 0.164), "M": (0.567, 0.0), "G3": (0.289, 0.166)}  # from L
MASS = {"G1": 227.343, "G2": 130.123, "G3": 53.0}  # kg
CLOSED = {"CD": 0.905, "EF": 1.046, "GH": 0.840}
OPEN = {"CD": 1.305, "EF": 1.556, "GH": 1.260}
RANGE = {"boom": (-0.4737, 1.0923), "arm": (-0.5103, -2.5848), "bucket": (0.7839, -2.8659)}  # at the shortest, at the longest
HJ = HK = 0.24
DIG = (3500.0, -1500.0)  # N


def polar(body, point, base=(1.0, 0.0)):
    """Return the distance of a place from its body's origin, and its angle from a direction of the body."""
    (x, y), (u, v) = body[point], body.get(base, base) if isinstance(base, str) else base
    return hypot(x, y), atan2(u * y - v * x, u * x + v * y)


class Excavator(Mechanism):
    """Three driven lengths: CD lifts the boom, EF swings the arm, GH the bucket over the rocker JH and the link HK."""

    S1 = Stroke(0.0, 0.400)
    S2 = Stroke(0.0, 0.510)
    S3 = Stroke(0.0, 0.420)

    B = Ground(0.0, 0.0)
    C = Ground(*FOOT)
    D = Dyad(C, B, CD=CLOSED["CD"] + S1, BD=hypot(*BOOM["D"]), side=RIGHT)
    A = OnLink(B, D, BA=polar(BOOM, "A")[0], DBA=polar(BOOM, "A", "D")[1])
    E = OnLink(B, D, BE=polar(BOOM, "E")[0], DBE=polar(BOOM, "E", "D")[1])
    G1 = OnLink(B, D, BG1=polar(BOOM, "G1")[0], DBG1=polar(BOOM, "G1", "D")[1])

    F = Dyad(E, A, EF=CLOSED["EF"] + S2, AF=hypot(*ARM["F"]), side=LEFT)
    G = OnLink(A, F, AG=polar(ARM, "G")[0], FAG=polar(ARM, "G", "F")[1])
    J = OnLink(A, F, AJ=polar(ARM, "J")[0], FAJ=polar(ARM, "J", "F")[1])
    L = OnLink(A, F, AL=polar(ARM, "L")[0], FAL=polar(ARM, "L", "F")[1])
    G2 = OnLink(A, F, AG2=polar(ARM, "G2")[0], FAG2=polar(ARM, "G2", "F")[1])

    H = Dyad(G, J, GH=CLOSED["GH"] + S3, HJ=HJ, side=LEFT)
    K = Dyad(H, L, HK=HK, LK=hypot(*BUCKET["K"]), side=LEFT)
    M = OnLink(L, K, LM=polar(BUCKET, "M")[0], KLM=polar(BUCKET, "M", "K")[1])
    G3 = OnLink(L, K, LG3=polar(BUCKET, "G3")[0], KLG3=polar(BUCKET, "G3", "K")[1])

    boom_mass = Weight(G1, mass=MASS["G1"])
    arm_mass = Weight(G2, mass=MASS["G2"])
    bucket_mass = Weight(G3, mass=MASS["G3"])
    dig = Force(M, DIG)

    boom = Cylinder(C, D, bore=80 * mm, rod=45 * mm, closed=0.905, stroke=0.400)
    arm = Cylinder(E, F, bore=70 * mm, rod=40 * mm, works="both", closed=1.046, stroke=0.510)
    bucket = Cylinder(G, H, bore=63 * mm, rod=36 * mm, works="both", closed=0.840, stroke=0.420)
    boom_line = LiftCircuit(boom, pressure=180 * bar, relief=210 * bar, flow=40 * litre / minute, mechanical_efficiency=0.92)
    arm_line = LiftCircuit(arm, pressure=180 * bar, relief=210 * bar, back_pressure=6 * bar, hydraulic_efficiency=0.95)
    bucket_line = LiftCircuit(bucket, pressure=180 * bar, relief=210 * bar)


class ByAngles(Mechanism):
    """The same machine as a drawing office has it: the joints' angles drive, the cylinders hang beside them."""

    q1 = Stroke(*RANGE["boom"])
    q2 = Stroke(*sorted(RANGE["arm"]))
    q3 = Stroke(*sorted(RANGE["bucket"]))

    B = Ground(0.0, 0.0)
    C = Ground(*FOOT)
    A = Crank(B, BA=2.05, angle=q1)
    D = OnLink(B, A, BD=polar(BOOM, "D")[0], ABD=polar(BOOM, "D")[1])
    E = OnLink(B, A, BE=polar(BOOM, "E")[0], ABE=polar(BOOM, "E")[1])
    G1 = OnLink(B, A, BG1=polar(BOOM, "G1")[0], ABG1=polar(BOOM, "G1")[1])

    L = Crank(A, AL=1.05, angle=angle(B, A) + q2)
    F = OnLink(A, L, AF=polar(ARM, "F")[0], LAF=polar(ARM, "F")[1])
    G = OnLink(A, L, AG=polar(ARM, "G")[0], LAG=polar(ARM, "G")[1])
    J = OnLink(A, L, AJ=0.88)
    G2 = OnLink(A, L, AG2=polar(ARM, "G2")[0], LAG2=polar(ARM, "G2")[1])

    M = Crank(L, LM=0.567, angle=angle(A, L) + q3)
    K = OnLink(L, M, LK=polar(BUCKET, "K")[0], MLK=polar(BUCKET, "K")[1])
    G3 = OnLink(L, M, LG3=polar(BUCKET, "G3")[0], MLG3=polar(BUCKET, "G3")[1])
    H = Dyad(J, K, HJ=HJ, HK=HK, side=LEFT)

    boom_mass = Weight(G1, mass=MASS["G1"])
    arm_mass = Weight(G2, mass=MASS["G2"])
    bucket_mass = Weight(G3, mass=MASS["G3"])
    dig = Force(M, DIG)

    boom = Cylinder(C, D, bore=80 * mm, rod=45 * mm, closed=0.905, stroke=0.400)
    arm = Cylinder(E, F, bore=70 * mm, rod=40 * mm, works="both", closed=1.046, stroke=0.510)
    bucket = Cylinder(G, H, bore=63 * mm, rod=36 * mm, works="both", closed=0.840, stroke=0.420)
    boom_line = LiftCircuit(boom, pressure=180 * bar, relief=210 * bar, flow=40 * litre / minute, mechanical_efficiency=0.92)
    arm_line = LiftCircuit(arm, pressure=180 * bar, relief=210 * bar, back_pressure=6 * bar, hydraulic_efficiency=0.95)
    bucket_line = LiftCircuit(bucket, pressure=180 * bar, relief=210 * bar)


# -- the machine by hand -----------------------------------------------------------------------------------

RAMS = {"boom": ("C", "D"), "arm": ("E", "F"), "bucket": ("G", "H")}
LOADS = [*((name, (0.0, -mass * plane.G)) for name, mass in MASS.items()), ("M", DIG)]
POSES = np.array([(0.10, -1.30, -0.80), (0.85, -0.70, -2.40), (-0.35, -2.30, 0.30), (0.55, -1.90, -1.60), (1.00, -1.10, 0.05)])


def places(q):
    """Return every place by the three angles."""
    found = {"B": plane.point(0.0, 0.0), "C": plane.point(*FOOT)}
    found |= {name: plane.turned(place, q[0]) for name, place in BOOM.items()}
    found |= {name: found["A"] + plane.turned(place, q[0] + q[1]) for name, place in ARM.items()}
    found |= {name: found["L"] + plane.turned(place, q[0] + q[1] + q[2]) for name, place in BUCKET.items()}
    return found | {"H": plane.meet(found["J"], HJ, found["K"], HK, plane.LEFT)}


def strokes(poses=POSES):
    """Return the strokes of the driven lengths at angles."""
    at = [places(q) for q in poses]
    spans = [[plane.length(p[P], p[Q]) - CLOSED[P + Q] for p in at] for P, Q in RAMS.values()]
    return dict(zip(("S1", "S2", "S3"), np.array(spans), strict=True))


def angles(poses=POSES):
    """Return the strokes of the driven angles."""
    return dict(zip(("q1", "q2", "q3"), poses.T, strict=True))


def thrusts(q, loads=None):
    """Return the three thrusts by virtual work."""
    return plane.balance(places, q, LOADS if loads is None else loads, list(RAMS.values()))


def cut(q, turning=(0, 0, 0), arm=lambda pin: 0.0):
    """Return the free bodies' forces; `turning` are the senses of the three joints, `arm(pin)` the friction's moment at each."""
    p, bodies = places(q), FreeBodies()
    bodies.pin("B", "boom", "frame", p["B"])
    bodies.pin("A", "arm", "boom", p["A"])
    bodies.pin("L", "bucket", "arm", p["L"])
    bodies.pin("J", "rocker", "arm", p["J"])
    bodies.pin("K", "bucket", "link", p["K"])
    bodies.pin("H", "link", "rocker", p["H"])
    bodies.thrust("boom", "frame", p["C"], "boom", p["D"])
    bodies.thrust("arm", "boom", p["E"], "arm", p["F"])
    bodies.thrust("bucket", "arm", p["G"], "rocker", p["H"])
    for body, name in (("boom", "G1"), ("arm", "G2"), ("bucket", "G3")):
        bodies.load(body, p[name], (0.0, -MASS[name] * plane.G))
    bodies.load("bucket", p["M"], DIG)
    for pin, turns, outer, inner in zip("BAL", turning, ("boom", "arm", "bucket"), ("frame", "boom", "arm"), strict=True):
        bodies.load(outer, p[pin], (0.0, 0.0), -turns * arm(pin))
        bodies.load(inner, p[pin], (0.0, 0.0), turns * arm(pin))
    return bodies.solve()


def pair(found, name):
    """Return the force of a pin by hand."""
    return np.array([found[name + "x"], found[name + "y"]])


BOTH = [(Excavator, strokes), (ByAngles, angles)]


@pytest.mark.parametrize(("machine", "at"), BOTH)
def test_positions(machine, at):
    motion = machine().at(**at())
    for k, q in enumerate(POSES):
        for name, place in places(q).items():
            assert_allclose(motion[name][:, min(k, motion[name].shape[1] - 1)], place, atol=1e-12)


@pytest.mark.parametrize("name", RAMS)
def test_published_lengths_belong_to_published_angles(name):
    """Arm and bucket are at their greatest angle where their cylinder is shortest."""
    column = list(RAMS).index(name)
    for end, lengths in enumerate((CLOSED, OPEN)):
        q = np.array(POSES[0])
        q[column] = RANGE[name][end]
        p = places(q)
        P, Q = RAMS[name]
        assert_allclose(plane.length(p[P], p[Q]), lengths[P + Q], atol=1.4e-5)
        motion = ByAngles().at(**angles(q[None, :]))
        assert_allclose(motion.distance(P, Q), plane.length(p[P], p[Q]), rtol=1e-13)
        assert np.sign(motion.ratio(distance(P, Q), wrt=f"q{column + 1}")) == (1 if name == "boom" else -1)


@pytest.mark.parametrize(("machine", "at"), BOTH)
def test_thrusts(machine, at):
    motion = machine().at(**at())
    forces = pin_forces(motion)
    want = np.array([thrusts(q) for q in POSES]).T
    for k, name in enumerate(RAMS):
        assert_allclose(getattr(machine, name).thrust(motion), want[k], rtol=1e-11)
        assert_allclose(forces.thrusts[name], want[k], rtol=1e-11)
    assert forces.residual < 1e-12
    assert np.any(want[1] > 0) and np.any(want[1] < 0)  # the arm's cylinder reverses


def test_generalised_forces_of_the_angles_are_torques():
    """What turns the joints is not what the cylinders carry: thrust times lever."""
    motion = ByAngles().at(**angles())
    for k in range(3):
        want = [-plane.work(places, q, LOADS, k) for q in POSES]
        assert_allclose(driving_force(motion, drive=f"q{k + 1}"), want, rtol=1e-11)


def test_the_last_cylinder_swings_the_bucket_against_its_angle():
    """dS3 at held S1, S2: only the bucket turns."""
    levers = np.array([plane.stretch(places, q, "G", "H", 2) for q in POSES])
    assert np.all(levers < 0)
    torques = np.array([-plane.work(places, q, LOADS, 2) for q in POSES])
    assert_allclose(driving_force(Excavator().at(**strokes()), drive="S3"), torques / levers, rtol=1e-11)


@pytest.mark.parametrize(("machine", "at"), BOTH)
def test_pins(machine, at):
    forces = pin_forces(machine().at(**at()))
    for k, q in enumerate(POSES):
        want = cut(q)
        size = max(map(abs, want.values()))
        for name, body in (("B", "B D"), ("A", "A F"), ("L", "L K"), ("J", "J H"), ("K", "L K")):
            assert_allclose(forces.force(name, on=body)[:, k], pair(want, name), atol=1e-11 * size)
        p = places(q)
        for name, (P, Q) in RAMS.items():
            push = want[name] * plane.toward(p[P], p[Q])
            assert_allclose(forces.force(P, on=name)[:, k], push, atol=1e-11 * size)
            assert_allclose(forces.force(Q, on=name)[:, k], -push, atol=1e-11 * size)


@pytest.mark.parametrize(("machine", "at"), BOTH)
def test_frame_carries_all_loads(machine, at):
    forces = pin_forces(machine().at(**at()))
    total = sum(force for point, force in forces.on_body("frame").items())
    assert_allclose(total[0], DIG[0], rtol=1e-12)
    assert_allclose(total[1], DIG[1] - sum(MASS.values()) * plane.G, rtol=1e-12)


@pytest.mark.parametrize(("machine", "at"), BOTH)
def test_pressures_on_the_side_that_works(machine, at):
    motion = machine().at(**at())
    boom, arm, bucket = np.array([thrusts(q) for q in POSES]).T
    assert_allclose(machine.boom.pressure(motion), boom / 0.92 / plane.disc(0.080), rtol=1e-10)
    assert_allclose(machine.boom_line.pressure_for(motion), boom / 0.92 / plane.disc(0.080), rtol=1e-10)
    disc, ring = plane.disc(0.070), plane.annulus(0.070, 0.040)
    works, other = np.where(arm > 0, disc, ring), np.where(arm > 0, ring, disc)
    assert_allclose(machine.arm.pressure(motion), (abs(arm) + 6e5 * other) / works / 0.95, rtol=1e-10)
    assert_allclose(machine.arm_line.reserve(motion), (0.95 * 180e5 * works - 6e5 * other) / abs(arm), rtol=1e-10)
    area = np.where(bucket > 0, plane.disc(0.063), plane.annulus(0.063, 0.036))
    assert_allclose(machine.bucket_line.pressure_for(motion), abs(bucket) / area, rtol=1e-10)


def test_potential_energy_along_a_path():
    """The three thrusts times their lengths' changes lift the masses against the digging force."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    t = (nodes + 1) / 2
    start, end = POSES[0], POSES[1]
    motion = ByAngles().at(**angles(start + t[:, None] * (end - start)))
    done = 0.0
    for name, (P, Q) in RAMS.items():
        q = start + t[:, None] * (end - start)
        speed = [sum(plane.stretch(places, each, P, Q, k) * (end - start)[k] for k in range(3)) for each in q]
        done += np.sum(weights / 2 * getattr(ByAngles, name).thrust(motion) * speed)
    first, last = places(start), places(end)
    assert_allclose(done, -sum(np.dot(force, last[name] - first[name]) for name, force in LOADS), rtol=1e-11)


def test_capacity_at_the_nose_is_what_the_boom_lifts():
    """ISO 10567 takes the lift at the stick's nose, here L, at 87 % of the pressure."""
    motion = Excavator().at(**strokes())
    own = [each for each in LOADS if each[0] != "M"]
    no_dig = ["boom_mass", "arm_mass", "bucket_mass"]
    found = Excavator.boom_line.capacity(motion, "L", loads=no_dig, along=(0, 1), share=0.87)
    for k, q in enumerate(POSES):
        lever, needed = plane.stretch(places, q, "C", "D"), thrusts(q, own)[0]
        rise = plane.rate(places, q)["L"][1] / lever
        spare = 0.87 * 180e5 * plane.disc(0.080) * 0.92 - needed
        if rise > 0:
            assert_allclose(found[k], max(spare, 0.0) / rise, rtol=1e-10)
        else:
            assert np.isnan(found[k])


# -- verdicts ----------------------------------------------------------------------------------------------


def test_verdict_of_the_boom_over_its_stroke():
    """Arm and bucket held; the least reserve lies between the poses."""
    held = strokes()
    motion = Excavator().sweep(S1=3, S2=float(held["S2"][1]), S3=float(held["S3"][1]))
    most, _ = plane.peak(lambda q1: thrusts((q1, *POSES[1, 1:]))[0], *RANGE["boom"])
    lifting, oil, holding, _ = lift_verdicts(Excavator.boom_line, motion)
    reserve = 180e5 * plane.disc(0.080) * 0.92 / most
    assert bool(lifting) == (reserve >= 1.0)
    assert_allclose(number("least reserve is", lifting), reserve, rtol=1e-3)
    assert_allclose(number("", oil), 0.400 * plane.disc(0.080) / litre, rtol=1e-2)
    assert_allclose(number("up to", holding), most / plane.disc(0.080) / bar, rtol=1e-3)


def test_cylinders_fit_and_do_not_buckle():
    """The largest utilisation of a rod over a path on which it is pushed."""
    steps = np.linspace(0.0, 1.0, 9)[:, None]
    path = POSES[0] + steps * (POSES[1] - POSES[0])
    motion = ByAngles().at(**angles(path))

    def use(t):
        q = POSES[0] + t * (POSES[1] - POSES[0])
        p = places(q)
        return thrusts(q)[0] / 0.92 / plane.critical(0.045, plane.length(p["C"], p["D"]))

    most, _ = plane.peak(use, 0.0, 1.0)
    verdicts = ByAngles.boom.checks(motion)
    (buckling,) = [each for each in verdicts if each.rule == "buckling"]
    assert bool(buckling) == (most * 3.5 <= 1.0)
    assert_allclose(number("safety", buckling), 1 / most, rtol=6e-3)
    assert all(each for each in verdicts if each.rule == "length")


# -- what a user adds --------------------------------------------------------------------------------------


class WithGrab(ByAngles):
    """A user's own: 180 kg hung on the bucket's tip."""

    grab = Weight("M", mass=180.0)


class Dry(ByAngles):
    """Plain bushes that are not greased."""

    bush_B = PinFriction("B", radius=25 * mm, coefficient=0.15)
    bush_A = PinFriction("A", radius=22 * mm, coefficient=0.15)
    bush_L = PinFriction("L", radius=20 * mm, coefficient=0.20)


BUSHES = {"B": 0.025 * 0.15, "A": 0.022 * 0.15, "L": 0.020 * 0.20}


def test_what_a_subclass_hangs_on_counts():
    motion = WithGrab().at(**angles())
    want = np.array([thrusts(q, [*LOADS, ("M", (0.0, -180.0 * plane.G))]) for q in POSES]).T
    assert_allclose([getattr(WithGrab, name).thrust(motion) for name in RAMS], want, rtol=1e-11)
    assert_allclose(WithGrab.boom_line.pressure_for(motion), want[0] / 0.92 / plane.disc(0.080), rtol=1e-10)


def test_friction_takes_its_senses_from_the_path():
    """Boom up, arm out, bucket in, all at once: each joint rubs against its own turning."""
    turning = (1, 1, -1)
    t = np.linspace(0.0, 1.0, 5)[:, None]
    path = np.array([0.10, -1.60, -0.80]) + t * np.array([0.5, 0.6, -0.9])
    motion = Dry().at(**angles(path))
    for direction, sense in (("extending", 1), ("retracting", -1)):
        forces = pin_forces(motion, direction=direction)
        for k, q in enumerate(path):
            senses = np.multiply(sense, turning)
            want = plane.rubbed(lambda size, q=q, senses=senses: cut(q, senses, lambda pin: BUSHES[pin] * size(pin)), "BAL")
            size = max(map(abs, want.values()))
            assert_allclose([forces.thrusts[name][k] for name in RAMS], [want[name] for name in RAMS], rtol=1e-10)
            for name, body in (("B", "B A"), ("A", "A L"), ("L", "L M")):
                assert_allclose(forces.force(name, on=body)[:, k], pair(want, name), atol=1e-10 * size)


CYLINDERS = {"boom", "arm", "bucket", "boom_line", "arm_line", "bucket_line"}
BARE = {name: member for name, member in vars(ByAngles).items() if name not in CYLINDERS and not name.startswith("_")}


def test_actuators_in_the_place_of_the_cylinders():
    """The same pin forces, and the cranks' couples vanish."""
    q = POSES[1]
    pushes = dict(zip(RAMS, thrusts(q), strict=True))
    body = {name: Actuator(*RAMS[name], force=push) for name, push in pushes.items()}
    pushed = type("Pushed", (Mechanism,), BARE | body)
    motion, held = pushed().at(**angles(q[None, :])), pin_forces(ByAngles().at(**angles(q[None, :])))
    forces = pin_forces(motion)
    scale = max(abs(plane.work(places, q, [(name, force)], k)) for name, force in LOADS for k in range(3))
    for k in range(3):
        assert_allclose(forces.drives[f"q{k + 1}"], 0.0, atol=1e-11 * scale)
    for name, body_points in (("B", "B A"), ("A", "A L"), ("L", "L M"), ("K", "L M"), ("J", "J H")):
        assert_allclose(forces.force(name, on=body_points), held.force(name, on=body_points), atol=1e-9)
    for name, (P, _) in RAMS.items():
        assert_allclose(forces.force(P, on=name), held.force(P, on=name), atol=1e-9)


def test_arm_that_works_with_one_side_is_told_of_both():
    """Its thrust changes sign along the path: the verdict names the remedy."""
    single = type("Single", (ByAngles,), {"arm": Cylinder("E", "F", bore=70 * mm, rod=40 * mm)})
    t = np.linspace(0.0, 1.0, 7)[:, None]
    path = POSES[0] + t * (POSES[1] - POSES[0])
    pushes = [thrusts(q)[1] for q in path]
    assert min(pushes) < 0 < max(pushes)
    told = " ".join(map(str, lift_verdicts(single.arm_line, single().at(**angles(path)))))
    assert 'works="both"' in told
