"""Assur groups of class III and IV: found, solved to the last digit, continued, differentiated, in batches and with several strokes."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import linkage
from linkage import AssemblyError, Crank, DefinitionError, Dimension, Ground, Guide, Link, Mechanism, Pin, Slide, Stroke, angle, deg, drawn
from mechanisms.classics.stephenson_three import StephensonThree, StephensonThreeFar
from mechanisms.classics.stephenson_two import StephensonTwo, StephensonTwoFar


class Platform(Mechanism):
    """A platform BCD on three cylinders from the frame: three degrees of freedom, one class III group (3-RPR)."""

    S1, S2, S3 = Stroke(-0.05, 0.05), Stroke(-0.05, 0.05), Stroke(-0.05, 0.05)
    sketch = drawn(S1=0.0, S2=0.0, S3=0.0)
    A1, A2, A3 = Ground(0.0, 0.0), Ground(1.0, 0.0), Ground(0.4, 0.9)
    L1, L2, L3 = Dimension(0.50), Dimension(0.52), Dimension(0.48)
    first, second, third = Link("A1 B", A1B=L1 + S1), Link("A2 C", A2C=L2 + S2), Link("A3 D", A3D=L3 + S3)
    plate = Link("B C D", BC=0.30, BD=0.25, CD=0.28)
    B, C, D = Pin(near=(0.40, 0.30)), Pin(near=(0.68, 0.40)), Pin(near=(0.45, 0.55))
    heading = angle(B, C)


def platform(lengths, start):
    """Return the platform's pins for three cylinder lengths by Newton's method on x, y and heading, its own equations and none other."""
    bases = np.array([0.0, 1.0, 0.4 + 0.9j])
    cos = (0.30**2 + 0.25**2 - 0.28**2) / (2 * 0.30 * 0.25)
    plate = np.array([0.0, 0.30, 0.25 * np.exp(1j * np.arccos(cos))])
    u = np.array(start, float)
    for _ in range(40):
        corners = u[0] + 1j * u[1] + plate * np.exp(1j * u[2])
        rods = corners - bases
        turned = 1j * plate * np.exp(1j * u[2])
        J = np.column_stack([rods.real, rods.imag, (rods.conj() * turned).real])
        u = u - np.linalg.solve(J, (abs(rods) ** 2 - np.square(lengths)) / 2)
    return u[0] + 1j * u[1] + plate * np.exp(1j * u[2]), u


def test_platform_against_newton_on_its_own_three_coordinates():
    motion = Platform().sweep(S1=3, S2=2, S3=3)
    assert motion["B"].shape == (2, 3, 2, 3)
    S = np.array([motion.strokes[name] for name in ("S1", "S2", "S3")])
    _, middle = platform([0.50, 0.52, 0.48], [0.40, 0.30, 0.3])
    for pose in np.ndindex(3, 2, 3):
        end, u = S[(slice(None), *pose)], middle
        for part in np.linspace(0.0, 1.0, 9):
            corners, u = platform(np.array([0.50, 0.52, 0.48]) + part * end, u)
        for name, corner in zip("BCD", corners, strict=True):
            assert_allclose(motion[name][(slice(None), *pose)], [corner.real, corner.imag], rtol=0, atol=1e-11)


@pytest.mark.parametrize("more", [
    {"edge": Link("C D", CD=0.28)},
    {"edge": Link("B D", BD=0.25), "plate2": Link("D C E", CD=0.28, CE=0.2, DE=0.3), "E": Pin(near=(0.6, 0.6))},
    {"flap": Link("B C E", BC=0.30, BE=0.2, CE=0.2), "E": Pin(near=(0.55, 0.5)), "same": Link("E B C")},
    {"rod": Link("A1 B"), "arm": Link("A1 B E", BE=0.3, A1E=0.3), "E": Pin(near=(0.05, 0.3))},
])  # fmt: skip
def test_links_that_share_two_points_are_one_body_in_a_group(more):
    if "rod" in more:  # a rod told twice
        more = {**more, "first": Link("A1 B", A1B=0.5)}
        strokes, plain = {"S2": 0.02, "S3": 0.01}, type("Plain", (Platform,), {"first": Link("A1 B", A1B=0.5), "S1": None, "L1": None})
    else:
        strokes, plain = {"S1": 0.03, "S2": 0.02, "S3": 0.01}, Platform
    twice = type("Twice", (plain,), more)
    for name in "BCD":
        assert_allclose(twice().at(**strokes)[name], plain().at(**strokes)[name], rtol=1e-12)


def test_platforms_ratios_are_the_jacobians_inverse():
    """Rows of the inverse problem: dL_i = u_i . dB_i, so that the ratios by the three strokes are the inverse of that matrix."""
    motion = Platform().at(S1=0.03, S2=-0.02, S3=0.04)
    J = []
    for base, pin in (("A1", "B"), ("A2", "C"), ("A3", "D")):
        rod = motion[pin] - motion[base]
        rod, arm = rod / np.hypot(*rod), motion[pin] - motion["B"]
        J.append([rod[0], rod[1], rod[1] * arm[0] - rod[0] * arm[1]])
    inverse = np.linalg.inv(J)
    for column, stroke in enumerate(("S1", "S2", "S3")):
        assert_allclose(motion.ratio("B", wrt=stroke), inverse[:2, column], rtol=1e-10)
        assert_allclose(motion.ratio("heading", wrt=stroke), inverse[2, column], rtol=1e-10)
        for order, tolerance in ((1, 1e-8), (2, 1e-5)):
            exact = motion.ratio("D", wrt=stroke, order=order)
            assert_allclose(motion.ratio("D", wrt=stroke, order=order, method="central"), exact, rtol=tolerance)


def test_platforms_path_does_not_matter():
    motion = Platform().sweep(S1=5, S2=5, S3=0.02)
    alone = Platform().at(S1=float(motion.strokes["S1"][3, 1]), S2=float(motion.strokes["S2"][3, 1]), S3=0.02)
    assert_allclose(alone["D"], motion["D"][:, 3, 1], rtol=0, atol=1e-12)


def test_several_strokes_ask_which():
    with pytest.raises(DefinitionError, match="wrt="):
        Platform().at(S1=0.0, S2=0.0, S3=0.0).ratio("B")


# -- batches --------------------------------------------------------------------------------------------------


def test_designs_at_once_are_designs_one_by_one():
    rods = np.array([0.115, 0.118, 0.120, 0.124])
    batch = StephensonTwo(DF=rods, EG=np.linspace(0.108, 0.112, 4)).sweep(25)
    assert batch["G"].shape == (2, 4, 25)
    for row, (rod, rocker) in enumerate(zip(rods, np.linspace(0.108, 0.112, 4), strict=True)):
        single = StephensonTwo(DF=float(rod), EG=float(rocker)).sweep(25)
        assert_allclose(batch["G"][:, row], single["G"], rtol=0, atol=1e-12)
        assert_allclose(batch.ratio("psi")[row], single.ratio("psi"), rtol=1e-9)
    assert StephensonTwo(DF=rods).at(phi=[]).ratio("G").shape == (2, 4, 0)


def test_a_changed_design_is_the_same_linkage_from_the_other_end():
    """A design far from the sketch's is reached by continuation: the dyads of the other drive say where it must be."""
    settings = {"AB": 0.190, "CB": 0.160, "AD": 0.080}
    near = StephensonThree(**settings).at(phi=np.radians(np.linspace(35, 65, 7)))
    far = StephensonThreeFar(**settings).at(psi=near["psi"])
    assert_allclose(far["phi"], near.strokes["phi"], rtol=1e-9)


def test_a_batch_with_a_design_out_of_reach():
    with pytest.raises(AssemblyError, match="designs"):
        StephensonTwo(EG=np.array([0.110, 0.5])).sweep(9)
    motion = StephensonTwo(EG=np.array([0.110, 0.5])).sweep(9, unreachable="nan")
    assert motion.reached.tolist() == [[True] * 9, [False] * 9]
    assert np.isfinite(motion["G"][:, 0]).all() and np.isnan(motion["G"][:, 1]).all()
    assert np.isnan(motion.ratio("G")[:, 1]).all()


# -- ends -----------------------------------------------------------------------------------------------------


def test_the_end_of_a_group_is_its_dead_point():
    """Driven by the rocker, Stephenson II turns back where the crank's own motion has its extreme: d psi / d phi = 0."""
    values = np.radians(np.linspace(20.0, 30.0, 2001))
    psi = StephensonTwo().at(phi=values)["psi"]
    dead = psi.min()
    assert np.isfinite(StephensonTwoFar().at(psi=dead + 1e-6)["A"]).all()
    with pytest.raises(AssemblyError, match="found together"):
        StephensonTwoFar().at(psi=dead - 1e-5)


@pytest.mark.slow
def test_two_groups_one_after_the_other():
    class Double(StephensonTwo):
        """A second triad hangs on the first one's pins and the frame."""

        H0 = Ground(0.36, 0.02)
        K0 = Ground(0.30, 0.30)
        one, two, three, plate = Link("G H"), Link("H0 K"), Link("K0 M"), Link("H K M")
        H, K, M = Pin(at=(0.28, 0.15)), Pin(at=(0.345, 0.14)), Pin(at=(0.325, 0.20))

    assert [set(group.pins) for group in Double.plan.groups.values()] == [set("BFG"), set("HKM")]
    span = np.radians(60) + np.linspace(-0.02, 0.02, 5)
    motion = Double().at(phi=span)
    assert_allclose(motion["G"], StephensonTwo().at(phi=span)["G"], rtol=0, atol=1e-12)
    assert_allclose(motion["H"][:, 2], [0.28, 0.15], rtol=0, atol=1e-10)
    assert_allclose(motion.distance("H0", "K"), np.hypot(0.015, 0.12), rtol=1e-11)
    for P, Q in ("GH", ("K0", "M"), "HK", "HM", "KM"):
        assert_allclose(motion.distance(P, Q), motion.distance(P, Q)[2], rtol=1e-11)
    assert_allclose(motion.ratio("M"), motion.ratio("M", method="central"), rtol=1e-7, atol=1e-9)


def test_dyads_hang_on_a_group_and_a_group_on_dyads():
    class Longer(StephensonThreeFar):
        T = linkage.Dyad("B", "C", BT=0.10, CT=0.12, side=linkage.RIGHT)
        U = linkage.OnLink("B", "A", BU=0.05)

    motion = Longer().sweep(15)
    assert_allclose(motion.distance("B", "T"), 0.10, rtol=1e-11)
    assert_allclose(motion.ratio("T"), motion.ratio("T", method="central"), rtol=1e-7, atol=1e-9)


def test_a_group_with_a_slide():
    class Sliding(Mechanism):
        phi = Stroke(40 * deg, 100 * deg)
        sketch = drawn(phi=60 * deg)
        O, C = Ground(0.0, 0.0), Ground(0.110, 0.0)
        rail = Guide((0.0, 0.11), angle=5 * deg)
        P = Crank("C", CP=0.03, angle=phi)
        crank, rod = Link("O A", OA=0.050), Link("P B", PB=0.10)
        plate = Link("A B D", AB=0.080, AD=0.070, BD=0.060)
        shoe = Slide("D", rail)
        A, B, D = Pin(near=(0.03, 0.04)), Pin(near=(0.11, 0.12)), Pin(near=(0.05, 0.11))

    motion = Sliding().at(phi=60 * deg + np.linspace(-0.1, 0.1, 11))
    along = np.array([np.cos(5 * deg), np.sin(5 * deg)])
    shoe = motion["D"] - [[0.0], [0.11]]
    assert_allclose(along[0] * shoe[1] - along[1] * shoe[0], 0.0, atol=1e-13)
    for P, Q, length in (("O", "A", 0.05), ("P", "B", 0.10), ("A", "B", 0.08), ("A", "D", 0.07), ("B", "D", 0.06)):
        assert_allclose(motion.distance(P, Q), length, rtol=1e-11)
    assert_allclose(motion.ratio("D"), motion.ratio("D", method="central"), rtol=1e-7, atol=1e-9)


def test_a_drawn_group():
    """Pins at=(x, y): every length and the plate's shape come from the drawing, whichever way round it is."""
    places = {name: tuple(float(part) for part in StephensonThree().at(phi=1.0)[name]) for name in "ABD"}
    psi = float(StephensonThree().at(phi=1.0)["psi"])

    class Drawn(StephensonThreeFar):
        sketch = drawn(psi=psi)
        A, B, D = (Pin(at=places[name]) for name in "ABD")
        crank, rocker, coupler, rod = Link("O A"), Link("C B"), Link("A B D"), Link("D F")

    assert_allclose([Drawn()["OA"], Drawn()["CB"], Drawn()["DF"]], [0.050, 0.152, 0.1006], rtol=1e-12)
    values = np.radians(np.linspace(66, 84, 9))
    for point in "ABD":
        assert_allclose(Drawn().at(psi=values)[point], StephensonThreeFar().at(psi=values)[point], rtol=0, atol=1e-10)


def test_a_rough_sketch_is_refused_when_it_is_out_of_reach():
    with pytest.raises(AssemblyError, match="cannot be assembled from their sketch") as caught:
        type("Far", (StephensonThreeFar,), {"crank": Link("O A", OA=0.5)})().sweep(3)
    assert caught.value.shortfall > 0.05


def test_a_flat_ternary_sketch_has_no_side():
    flat = {name: Pin(near=(place, 0.1)) for name, place in {"A": 0.0, "B": 0.1, "D": 0.2}.items()}
    flat |= {"coupler": Link("A B D", AB=0.2, AD=0.09, BD=0.25)}
    with pytest.raises(DefinitionError, match="no side"):
        type("Flat", (StephensonThreeFar,), flat)


def test_a_drawn_pin_is_not_measured_from_a_rough_one():
    rough = {"D": Pin(at=(-0.038, 0.096)), "coupler": Link("A B D", AB=0.2)}
    with pytest.raises(DefinitionError, match="cannot be measured from"):
        type("Rough", (StephensonThreeFar,), rough)


def test_a_guide_of_the_group_may_be_named_by_a_text():
    def bar(slide):
        members = dict(phi=Stroke(0.0, 1.0), O=Ground(0, 0), P=Ground(0, -0.1), A=Crank("O", at=(0.03, 0.01), angle=linkage.ref("phi")))
        pins = dict(Q=Pin(at=(0.06, 0.12)), H=Pin(at=(0.01, -0.05)), I=Pin(at=(0.05, 0.07)), bar=Link("P Q H I"))
        slot = Guide("H", "I")
        return type("Bar", (Mechanism,), {**members, **pins, "slot": slot, "shoe": Slide("A", slide or slot)})

    one, other = (bar(slide)().sweep(5) for slide in (None, "slot"))
    assert np.array_equal(one["Q"], other["Q"])


@pytest.mark.slow
def test_a_group_slides_on_a_guide_of_its_own_while_its_links_are_measured():
    class Hatch(Mechanism):
        S = Stroke(0.0, 0.02)
        G, O = Ground(0, -0.04), Ground(0.22, -0.06)
        A, N, B, C = (Pin(at=(x, 0.0)) for x in (0.0, 0.1, 0.08, 0.12))
        E, T = Pin(at=(0.18, 0.04)), Pin(at=(0.3, 0.06))
        barrel, rod, hatch, stroke = Link("G A N"), Link("B C E"), Link("O E T"), Link("A B", AB=S + 0.08)
        line = Guide("A", "N")
        front, rear = Slide("B", line), Slide("C", line)

    motion = Hatch().sweep(5)
    along = motion["N"] - motion["A"]
    for pin in "BC":
        out = motion[pin] - motion["A"]
        assert_allclose(along[0] * out[1] - along[1] * out[0], 0.0, atol=1e-15)
    assert_allclose(motion.distance("A", "B"), np.linspace(0.08, 0.10, 5), rtol=1e-13)
    assert_allclose(motion.distance("O", "T"), np.hypot(0.08, 0.12), rtol=1e-13)
