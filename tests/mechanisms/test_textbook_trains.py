"""Trains of more than four links: published angles, forces in motion, a radial engine, a rod through its change points."""

import numpy as np
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    RIGHT,
    Acting,
    Crank,
    Dyad,
    Force,
    Ground,
    Guide,
    Link,
    LinkMass,
    Mechanism,
    Offset,
    OnLink,
    Pin,
    SliderDyad,
    Spring,
    Stroke,
    Vector,
    Weight,
    deg,
    drawn,
    driving_force,
    pin_forces,
)
from tests.for_all import for_all
from tests.mechanisms.free_bodies import slope

TURN = 2 * np.pi


def radial(pistons=5):
    """Return a radial engine's class: a master rod that carries the pins of the articulated rods."""
    line, O = Guide((0, 0), angle=90 * deg), Ground(0, 0)
    body = {"phi": Stroke(0, TURN), "O": O, "A": Crank("O", OA=0.06, angle="phi"), "line0": line}
    body["P0"] = SliderDyad("A", "line0", AP0=0.25, side=RIGHT)
    for k in range(1, pistons):
        body[f"K{k}"] = OnLink("A", "P0", **{f"AK{k}": 0.05, f"P0AK{k}": 72 * k * deg})
        body[f"line{k}"] = Guide((0, 0), angle=(72 * k - 270) * deg)
        body[f"P{k}"] = SliderDyad(f"K{k}", f"line{k}", **{f"K{k}P{k}": 0.2, "side": RIGHT})
    return type("Radial", (Mechanism,), body)


def test_radial_engine_in_complex_numbers():
    motion = radial()().sweep(25)
    A = 0.06 * np.exp(1j * motion.strokes["phi"])
    rod = 1j * (A.imag + np.sqrt(0.25**2 - A.real**2)) - A
    for k in range(1, 5):
        out = np.exp(1j * (72 * k - 270) * deg)
        pin = (A + 0.2 * rod * np.exp(1j * 72 * k * deg)) * out.conjugate()
        reach = pin.real + np.sqrt(0.2**2 - pin.imag**2)
        assert_allclose(motion[f"P{k}"], [(reach * out).real, (reach * out).imag], rtol=0, atol=1e-15)


START = -0.0617138900142764496358948458001


class Squeezer(Mechanism):
    """Andrews' squeezing mechanism, seven bodies. The points are those of its benchmark."""

    beta = Stroke(START, START + TURN)
    O, A, B, C = Ground(0, 0), Ground(-0.06934, -0.00227), Ground(-0.03635, 0.03273), Ground(0.014, 0.072)
    F = Crank(O, OF=0.007, angle=beta)
    E = Dyad(F, B, FE=0.028, BE=0.035, side=LEFT)
    G = Dyad(E, A, EG=0.02, AG=0.04, side=RIGHT)
    H = Dyad(E, A, EH=0.02, AH=0.04, side=LEFT)
    D = OnLink(B, E, BD=np.hypot(0.018, 0.02), EBD=np.pi / 2 - np.arctan2(0.018, 0.02))
    spring = Spring(C, D, stiffness=4530, free_length=0.07785)


def test_andrews_squeezing_mechanism():
    """Consistent initial angles to 16 digits: Hairer, Wanner, Solving Ordinary Differential Equations II, VII.7."""
    pose = Squeezer().at(beta=START)
    gamma, delta, epsilon = 0.455279819163070380255912382449, 0.487364979543842550225598953530, 1.23054744454982119249735015568
    assert_allclose(pose.angle("B", "E"), gamma - np.pi / 2, rtol=1e-14)
    assert_allclose(pose.angle("A", "G"), delta, rtol=1e-14)
    assert_allclose(pose.angle("A", "H"), epsilon - np.pi / 2, rtol=1e-14)
    assert_allclose(pose["E"], -0.021 * np.array([np.cos(START), np.sin(START)]), rtol=1e-14)  # crank and coupler in line


def test_the_springs_torque_is_the_slope_of_its_energy():
    beta = START + np.linspace(0.3, 6.0, 7)
    energy = lambda b: 0.5 * 4530 * (Squeezer().at(beta=b).distance("C", "D") - 0.07785) ** 2  # noqa: E731
    assert_allclose(driving_force(Squeezer().at(beta=beta)), slope(energy, beta, 1e-2), rtol=1e-9)


class SideRod(Mechanism):
    """A locomotive's side rod, spelled by its vector: it passes its change points."""

    phi = Stroke(0, 4 * np.pi)
    O, C = Ground(0, 0), Ground(1, 0)
    A = Crank(O, OA=0.3, angle=phi)
    OA = Vector(O, A)
    B = Offset(C, OA)
    rod, far = Link(A, B), Link(C, B)
    M = OnLink(A, B, AM=0.5)
    load = Weight(M, mass=10)


def test_side_rod_goes_through_its_change_points():
    """At its sketch and in the middle of its strokes all is in line; the mobility is told aside of them."""
    motion = SideRod().sweep(25)
    assert SideRod().mobility == 1
    assert_allclose(motion["B"] - motion["A"], [[1.0] * 25, [0.0] * 25], rtol=0, atol=1e-15)
    assert_allclose(driving_force(motion), 10 * 9.80665 * 0.3 * np.cos(motion.strokes["phi"]), rtol=0, atol=1e-12)


def six_bar(points, links, load):
    """Return the class of a six-bar drawn by its points, A its crank's pivot; links (points, mass), 0.1 and 0.2 kg m2, and a force on one.

    The centres of gravity lie in the middle of the points of a link, and so does the point where the force acts.
    """
    at = {name: complex(*place) for name, place in points.items()}
    ground = ("A", *(name for name in "DG" if sum(name in link for link, _ in links) == 1))
    body = {"phi": Stroke(-60 * deg, 42 * deg), "sketch": drawn(phi=0.0)} | {name: Ground(*points[name]) for name in ground}
    body |= {"B": Crank("A", at=points["B"], angle="phi")}
    body |= {name: Pin(at=place) for name, place in points.items() if name not in (*ground, "B")}
    for number, (link, mass) in enumerate(links):
        first, second, *_ = names = list(link)
        middle = (sum(at[name] for name in names) / len(names) - at[first]) / (at[second] - at[first]) * abs(at[second] - at[first])
        body[f"link{number}"] = Link(" ".join(names))
        body[f"mass{number}"] = LinkMass(
            " ".join(names), mass=mass, at=(middle.real, middle.imag), inertia=0.02 * mass, gravity=(0, -9.81)
        )
    link, force = load
    centre = sum(at[name] for name in link) / len(link)
    body["K"] = OnLink(link[0], link[1], at=(centre.real, centre.imag))
    return type("SixBar", (Mechanism,), body | {"load": Force("K", force)})


WATT = six_bar(
    dict(A=(-3.74, -2.41), B=(-2.72, 0.91), C=(1.58, 0.43), D=(-0.24, 4.01), E=(5.08, 5.31), F=(8.14, 3.35), G=(7.32, -3.51)),
    [("AB", 5), ("BCD", 10), ("DE", 5), ("EF", 10), ("CFG", 5)],
    ("CFG", (50, 25)),
)
STEPHENSON = six_bar(
    dict(A=(7, 4), B=(5, 16), C=(25, 25), D=(23, 10), E=(18, 35), F=(43, 32), G=(45, 17)),
    [("AB", 5), ("BCE", 10), ("CD", 5), ("EF", 10), ("FG", 5)],
    ("FG", (50, 0)),
)


WATTS = [1844.3174729930561, 6371.7624462305657, 685159.01702830743, -4155.8421407911483, -102001.44091590792]
STEPHENSONS = [-243.85439295323431, 585.80769911815651, 3363564.4158830228, -25.041809859119148, -10985922.290130081]


@for_all(("machine", "turned", "torques"), [(WATT, [0, 2, 5, -3, -5], WATTS), (STEPHENSON, [0, 28, 41, -11, -58], STEPHENSONS)])
def test_six_bars_in_motion_up_to_their_dead_points(machine, turned, torques):
    """The crank's torque at 10 rev/min, worked out in MATLAB: PMKS_Verification, cases watt_i and stephenson_iii_example_2."""
    motion, speed = machine().at(phi=np.radians(turned)), 1.0471975511965976
    moving = Acting(rates={"phi": speed}, accelerations={"phi": 0.0})
    assert_allclose(driving_force(motion, acting=moving), torques, rtol=1e-11)
    if machine is WATT:
        along = [5.08, 5.0193064678986019, 4.8332738548746104, 5.1312401105150345, 5.1305912844631401]
        assert_allclose(motion["E"][0], along, rtol=1e-14)
        upwards = [-26.434427125168291, 4.6590846972660387, 1046.1535877667122, -124.1283735489433, -1138.1416160987571]
        assert_allclose(motion.acceleration("E", {"phi": speed}, {"phi": 0.0})[1], upwards, rtol=1e-11)
        held = [-150.95805411779756, -496.4585725182327, -72868.697721976831, -5.1047005245840431, 5588.0628910527284]
        assert_allclose(pin_forces(motion, acting=moving).force("G")[1], held, rtol=1e-11)
