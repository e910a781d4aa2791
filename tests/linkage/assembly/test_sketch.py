"""A sketch measures itself: what is not given is that of the drawing, and what is given otherwise is told."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    AssemblyError,
    Crank,
    DefinitionError,
    Dimension,
    Dyad,
    Ground,
    Guide,
    Link,
    Mechanism,
    OnLink,
    Part,
    Pin,
    SingularError,
    Slide,
    Stroke,
    deg,
    drawn,
)
from linkage.files import load, save

PLACES = {"O": (0.0, 1.2), "A": (0.1, 0.6), "B": (0.42, 1.02), "T": (1.3, 0.9), "N": (1.1, 1.3)}


def apart(P, Q):
    return float(np.hypot(*np.subtract(PLACES[P], PLACES[Q])))


def flap(length, *, sense=1.0, start=0.0, **more):
    """Return a class: a flap O B T N on a cylinder A B, drawn at a stroke, mirrored by a sense of -1."""
    S = Stroke(0.0, 0.30)
    at = {name: (sense * x, y) for name, (x, y) in PLACES.items()}
    members = dict(S=S, sketch=drawn(S=start), O=Ground(*at["O"]), A=Ground(*at["A"]), **{each: Pin(at=at[each]) for each in "BTN"})
    members |= dict(flap=Link("O B T N"), ram=Link("A B", AB=length(S)))
    return type("Flap", (Mechanism,), {**members, **more})


def remarks(machine):
    return [each.sentence for each in machine.verdicts() if each.rule == "remark" and "sketch" in each.sentence]


@pytest.mark.parametrize("closed", [0.53, 0.50, 0.60])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_cylinder_of_another_length_bends_no_plate_and_is_told(closed, sense):
    machine = flap(lambda S: closed + S, sense=sense)()
    motion = machine.sweep(3)
    for P, Q in ("OB", "OT", "BT", "ON", "TN", "BN"):
        assert_allclose(motion.distance(P, Q), apart(P, Q), rtol=0, atol=1e-12)
    (text,) = remarks(machine)
    assert f"AB = 528 mm at S = 0 mm, the class says {closed * 1e3:.0f} mm: B stands" in text
    off = np.hypot(*(machine.at(S=0.0)["B"] - (sense * 0.42, 1.02)))
    assert f"stands {off * 1e3:.2g} mm from its at=." in text


def test_the_stroke_that_is_named_fits_the_drawing():
    assert "drawn(S=0.028) fits." in remarks(flap(lambda S: 0.5 + S)())[0]
    assert remarks(flap(lambda S: 0.5 + S, start=0.028)()) == []
    assert "fits" not in remarks(flap(lambda S: 0.6 + S)())[0]  # it would have to begin before its start
    assert remarks(flap(lambda S: 0.528 + S)()) == []  # rounded to a millimetre, as a drawing is read


@pytest.mark.slow
def test_angles_and_lengths_of_a_plate_are_told_and_a_design_that_fits_is_not():
    texts = remarks(flap(lambda S: 0.528 + S, flap=Link("O B T N", OB=0.45, BOT=12 * deg))())
    assert [text.split(" = ")[0] for text in texts] == ["The sketch has OB", "The sketch has BOT"]
    assert "10.2 deg" in texts[1] and "12 deg" in texts[1]
    L0 = Dimension(0.5)
    machine = flap(lambda S: L0 + S, L0=L0)
    assert len(remarks(machine())) == 1
    assert remarks(machine(L0=0.528)) == remarks(machine(L0=[0.5, 0.528])) == []


def test_one_length_of_a_plate_is_given_and_the_rest_is_measured():
    for pair in ("BT", "TB", "OT", "TN"):
        machine = flap(lambda S: S, flap=Link("O B T N", **{pair: 1.02 * apart(*pair)}))()
        assert_allclose(machine.at(S=0.1).distance(*pair), 1.02 * apart(*pair), rtol=1e-12)
        assert len(remarks(machine)) == 1


@pytest.mark.parametrize("share", [1.7, -0.3])
def test_three_pins_on_a_line_measure_no_rounding(share):
    for turn in np.linspace(0.1, 6.0, 30):
        place = 0.3 + 0.37 * np.cos(turn), 0.1 + 0.37 * np.sin(turn)
        beyond = 0.3 + share * (place[0] - 0.3), 0.1 + share * (place[1] - 0.1)
        phi, O = Stroke(0.0, 1.0), Ground(0.3, 0.1)
        plate = type("Plate", (Mechanism,), dict(phi=phi, O=O, A=Crank(O, at=place, angle=phi), B=Pin(at=beyond), bar=Link("O A B")))
        (measured,) = [value for name, value in plate().dimensions.items() if name in ("AOB", "OAB", "BOA", "BAO")]
        assert measured in (0.0, np.pi)


@pytest.mark.parametrize("start", [0.0, 0.1, 0.3])
def test_a_cylinder_is_measured_by_its_coordinates_alone(start, tmp_path):
    """A stroke alone that begins at zero is how far the cylinder is out; the printed class is the same machine."""
    drawn_flap = flap(lambda S: S, start=start)
    known = flap(lambda S: apart("A", "B") - start + S, start=start)
    assert_allclose(drawn_flap().sweep(4)["T"], known().sweep(4)["T"], rtol=0, atol=1e-13)
    assert_allclose(drawn_flap().at(S=start)["T"], PLACES["T"], rtol=0, atol=1e-13)
    names = {"Mechanism": Mechanism, "Stroke": Stroke, "drawn": drawn, "Ground": Ground, "Dyad": Dyad, "Link": Link, "OnLink": OnLink}
    members: dict[str, object] = {}
    exec(str(drawn_flap.plan), {**names, "LEFT": LEFT, "deg": deg}, members)
    assert_allclose(type("Pasted", (Mechanism,), members)().sweep(4)["T"], known().sweep(4)["T"], rtol=0, atol=1e-13)
    save(drawn_flap, tmp_path / "flap.toml")
    assert_allclose(load(tmp_path / "flap.toml")().sweep(4)["T"], known().sweep(4)["T"], rtol=0, atol=1e-13)


def test_a_whole_length_and_rough_pins_stay_as_they_are():
    """A stroke that begins above zero is the length from pin to pin; near=(x, y) is no drawing."""

    class Whole(Mechanism):
        S = Stroke(0.5, 0.7)
        A, O = Ground(0, 0), Ground(0.5, 0)
        B = Dyad(A, O, AB=S, at=(0.3, 0.4))

    assert_allclose(Whole().at(S=0.55).distance("A", "B"), 0.55, rtol=1e-12)
    with pytest.raises(AssemblyError, match=r"OB \+ AB = 0.45 m"):
        flap(lambda S: S, B=Pin(near=PLACES["B"]), flap=Link("O B T N", OB=0.45))


@pytest.mark.parametrize("start", [0.0, 0.4])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_crank_is_measured_by_its_coordinates_alone(start, sense, tmp_path):
    phi = Stroke(-1.0, 1.0)
    rest = dict(phi=phi, sketch=drawn(phi=start), A=Ground(0, 0), D=Ground(sense * 0.4, 0), C=Pin(at=(sense * 0.4, 0.25)))
    rest |= dict(coupler=Link("B C"), rocker=Link("D C"))
    measured = type("Sketched", (Mechanism,), {**rest, "B": Crank("A", at=(sense * 0.06, 0.08), angle=phi)})
    turn = np.arctan2(0.08, sense * 0.06) - start
    known = type("Known", (Mechanism,), {**rest, "B": Crank("A", AB=0.1, angle=float(turn) + phi)})
    assert_allclose(measured().sweep(5)["C"], known().sweep(5)["C"], rtol=0, atol=1e-13)
    assert_allclose(measured().at(phi=start)["B"], (sense * 0.06, 0.08), rtol=0, atol=1e-15)
    save(measured, tmp_path / "crank.toml")
    assert_allclose(load(tmp_path / "crank.toml")().sweep(5)["C"], known().sweep(5)["C"], rtol=0, atol=1e-13)
    given = type("Given", (Mechanism,), {**rest, "B": Crank("A", AB=0.12, at=(sense * 0.06, 0.08), angle=phi)})
    assert "AB = 100 mm" in remarks(given())[0]


def test_a_part_keeps_its_drawing():
    """By its own stroke, by one it shares, mirrored, in a part of a part; the whole has the last word."""
    arm = flap(lambda S: S, start=0.1)
    want = arm().at(S=0.2)["T"]
    whole = type("Whole", (Mechanism,), {"p": Part(arm, at=(1.0, 0.5), mirrored=True)})
    assert_allclose(whole().at(**{"p.S": 0.2})["p.T"], want * (-1, 1) + (1.0, 0.5), rtol=0, atol=1e-12)
    outer = type("Outer", (Mechanism,), {"q": Part(whole)})
    assert outer.plan.sketch_strokes == {"q.p.S": 0.1}
    s = Stroke(0.0, 0.3)
    shared = {"s": s, "p": Part(arm, S=s)}
    assert type("Shared", (Mechanism,), shared).plan.sketch_strokes == {"s": 0.1}
    assert type("Said", (Mechanism,), {**shared, "sketch": drawn(s=0.05)}).plan.sketch_strokes == {"s": 0.05}
    bent = type("Bent", (Mechanism,), {"p": Part(flap(lambda S: 0.5 + S))})
    assert remarks(bent())[0].startswith("p: The sketch has AB")


# -- two pins at one place ------------------------------------------------------------------------------------


def four_bar(**more):
    t = Stroke(-0.3, 0.3)
    members = dict(t=t, sketch=drawn(t=0), O=Ground(0, 0), C=Ground(0.4, 0), A=Crank("O", OA=0.1, angle=90 * deg + t))
    members |= dict(B=Pin(at=(0.4, 0.25)), coupler=Link("A B"), rocker=Link("C B"))
    return type("FourBar", (Mechanism,), {**members, **more})


def slider(**more):
    t = Stroke(-0.3, 0.3)
    members = dict(t=t, sketch=drawn(t=0), O=Ground(0, 0), A=Crank("O", OA=0.1, angle=90 * deg + t), rail=Guide((0, -0.02), angle=0))
    return type("Slider", (Mechanism,), {**members, "B": Pin(at=(0.4, -0.02)), "coupler": Link("A B"), "shoe": Slide("B", "rail"), **more})


def platform(**more):
    phi = Stroke(0, 0.6)
    members = dict(phi=phi, O=Ground(0, 0), P=Ground(3, 0), Q=Ground(1.5, 3), A=Crank("O", OA=0.5, angle=phi))
    members |= dict(D=Pin(at=(1.2, 0.5)), E=Pin(at=(2.2, 0.5)), F=Pin(at=(1.6, 1.3)))
    groups = {"plate": Link("D E F"), "r1": Link("A D"), "r2": Link("P E"), "r3": Link("Q F")}
    return type("Platform", (Mechanism,), {**members, **groups, **more})


DISC = {"A2": Pin(at=(0, 0.1)), "disc": Link("O A A2")}
TWICE = {
    "crank": (four_bar, {**DISC, "coupler": Link("A2 B")}),
    "coupler": (four_bar, dict(B2=Pin(at=(0.4, 0.25)), coupler=Link("A B B2"), rocker=Link("C B2"))),
    "both": (four_bar, {**DISC, "B2": Pin(at=(0.4, 0.25)), "coupler": Link("A2 B B2"), "rocker": Link("C B2")}),
    "rocker": (four_bar, dict(C2=Pin(at=(0.4, 0)), rocker=Link("C C2 B"))),
    "frame": (four_bar, dict(C2=Ground(0.4, 0), rocker=Link("C2 B"))),
    "frame link": (four_bar, dict(C2=Pin(at=(0.4, 0)), base=Link("O C C2"), rocker=Link("C2 B"))),
    "plate": (four_bar, dict(A2=Pin(at=(0, 0.1)), coupler=Link("A A2 B"))),
    "slide": (slider, dict(B2=Pin(at=(0.4, -0.02)), coupler=Link("A B B2"), shoe=Slide("B2", "rail"))),
    "group": (platform, dict(D2=Pin(at=(1.2, 0.5)), plate=Link("D D2 E F"), r1=Link("A D2"))),
    "rod": (platform, dict(D2=Pin(at=(1.2, 0.5)), r1=Link("A D2 D"))),
}
ALONE = {
    "crank": (four_bar, dict(A2=Pin(at=(0, 0.1)), disc=Link("A A2"), coupler=Link("A2 B"))),
    "frame": (four_bar, dict(C2=Pin(at=(0.4, 0)), base=Link("C C2"), rocker=Link("C2 B"))),
    "plate": (four_bar, dict(A2=Pin(at=(0, 0.1)), coupler=Link("A A2 B"), X=Pin(at=(0.2, 0.5)), plate=Link("A A2 X"))),
    "slide": (slider, dict(B2=Pin(at=(0.4, -0.02)), block=Link("B B2"), shoe=Slide("B2", "rail"))),
    "block": (slider, dict(B2=Pin(at=(0.4, -0.02)), block=Link("B B2"), shoe=Slide("B2", "rail"), other=Slide("B", "rail"))),
    "dyad": (four_bar, dict(A2=Dyad("A", "O", at=(0, 0.1)))),
}


@pytest.mark.parametrize("name", TWICE)
def test_two_pins_at_one_place_of_a_body_run_as_one(name):
    make, twice = TWICE[name]
    one, two = make(), make(**twice)
    point = "D" if make is platform else "B"
    assert_allclose(two().sweep(5)[point], one().sweep(5)[point], rtol=0, atol=1e-12)
    assert two().mobility == 1


@pytest.mark.parametrize("name", ALONE)
def test_a_link_of_two_pins_at_one_place_is_refused_as_such(name):
    make, alone = ALONE[name]
    with pytest.raises(DefinitionError, match="one place"):
        make(**alone)


# -- dead points, strokes that move nothing -----------------------------------------------------------------------


class Butterfly(Mechanism):
    """A double butterfly, drawn symmetrical: both wings stand in their dead point."""

    phi = Stroke(-40 * deg, 40 * deg)
    sketch = drawn(phi=0)
    O, L, R = Ground(0, 0), Ground(-6, -4), Ground(6, -4)
    A = Crank(O, OA=float(np.hypot(4, 4)), angle=45 * deg + phi)
    B, C, D = Pin(at=(-4, 4)), Pin(at=(4, 10)), Pin(at=(-4, 10))
    E, F, G = Pin(at=(0, 13)), Pin(at=(6, 13)), Pin(at=(-6, 13))
    arm, up1, up2 = Link("O A B"), Link("A C"), Link("B D")
    wing1, wing2, leg1, leg2 = Link("C E F"), Link("D E G"), Link("F R"), Link("G L")


def test_a_group_drawn_in_a_dead_point_says_so_and_its_mobility_can_be_asked():
    with pytest.raises(SingularError, match="C D E F G stand in a dead point at phi = 0 deg"):
        Butterfly().at(phi=0.1)
    assert Butterfly().mobility == Butterfly().freedom.rank
    assert "dead point" in str(Butterfly().freedom)


def test_a_stroke_that_moves_nothing_is_named_with_its_remedy():
    with pytest.raises(DefinitionError, match=r"The stroke t moves nothing. For a crank write B = Crank\(C, at=\(x, y\), angle=t\)"):
        four_bar(A=Pin(at=(0, 0.1)), crank=Link("O A"))
    assert_allclose(four_bar(A=Crank("O", at=(0, 0.1), angle=Stroke(0, 1).renewed(_name="t")))().at(t=0)["A"], (0, 0.1), atol=1e-15)
