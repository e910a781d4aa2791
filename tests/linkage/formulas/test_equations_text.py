"""How the equations read: the papers' list and numbers, LaTeX, numbers filled in, names, the door."""

import numpy as np
import pytest
import sympy
from numpy.testing import assert_allclose

import linkage
from linkage import LEFT, RIGHT, Crank, Dimension, Dyad, Ground, Guide, Mechanism, Moment, OnGuide, OnLink, Stroke, angle, deg, x
from linkage.formulas import Tcos, equations
from linkage.formulas.printing import Latex
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all
from tests.linkage.formulas.equation_machines import ALL, HITCHES, Outputs, Slider, check_values

# -- the list ----------------------------------------------------------------------------------------------

PAPER = """\
(4)  L_AB(S) = L0 + S
(5)  AO = O - A
(6)  OAB = Tcos(|AO|, L_AB, L_OB)
(7)  AB = TurnVL(AO, -OAB, L_AB)
(8)  B = A + AB
(9)  OB = B - O
(10) COB = Tcos(L_OB, L_OC, L_BC)
(11) OC = TurnVL(OB, COB, L_OC)
(12) C = O + OC
(13) BC = C - B
(14) EC = C - E
(15) CED = Tcos(|EC|, L_ED, L_CD)
(16) ED = TurnVL(EC, -CED, L_ED)
(17) D = E + ED
(18) EF = TurnVL(ED, 0, L_EF)
(19) F = E + EF
(20) MF = F - M
(21) FMK = Tcos(|MF|, L_MK, L_FK)
(22) MK = TurnVL(MF, FMK, L_MK)
(23) K = M + MK
(24) FK = K - F
(25) FG = TurnVL(FK, -KFG, L_FG)
(26) G = F + FG
(27) tilt = angle(FK) - 90 deg"""


@pytest.mark.parametrize("hitch", HITCHES)
def test_hitch_has_the_papers_equations_and_numbers(hitch):
    head, _, listed = str(equations(hitch(), start=4)).partition("\n\n")
    assert listed == PAPER
    assert "TurnVL(V, a, L) = TurnV(V, a)*L/|V|" in head
    assert "Tcos(L1, L2, L3) = acos((L1**2 + L2**2 - L3**2)/(2*L1*L2))" in head
    assert head.count("TurnV(V, a):") == 1


def test_both_spellings_print_the_same():
    composite, primitive = (equations(hitch, ratio=["G", "tilt"], at={"S": 0.1}) for hitch in HITCHES)
    assert str(composite) == str(primitive)
    assert composite.latex() == primitive.latex()


def test_members_in_any_order_print_in_an_order_that_can_be_worked_out():
    class Late(Mechanism):
        F = OnLink("E", "D", EF=0.95)
        D = Dyad("E", "C", ED=0.48, CD=0.62, side=RIGHT)
        C = Ground(0.65, 1.1)
        E = Ground(0.25, "height")
        S = Stroke(0.0, 0.1)
        height = Dimension(0.60)
        B = Dyad(C, E, CB=0.5, EB=0.3 + S, side=LEFT)

    known = {"S", "C", "height"}
    for each in equations(Late):
        assert {symbol.name for symbol in each.symbols if not symbol.name.startswith("L_")} <= known | {"L_EB", "E_x"}
        known.add(each.name)
    check_values(Late(), {"S": np.linspace(0, 0.1, 5)})


def test_a_class_a_design_and_a_changed_design():
    assert str(equations(ThreePointHitch)) == str(equations(ThreePointHitch()))
    longer = equations(ThreePointHitch(OB=0.31), at={"S": 0.1})
    assert "L_OB = 0.31 m" in str(longer)
    assert_allclose(longer.values(at={"S": 0.1})["G"], ThreePointHitch(OB=0.31).at(S=0.1)["G"], atol=1e-12)


# -- filled in ---------------------------------------------------------------------------------------------


def test_numbers_filled_in_with_units():
    lines = equations(ThreePointHitch, at={"S": 0.1}, ratio="tilt").text().splitlines()
    assert "(1)  L_AB(S) = L0 + S = 0.5 + 0.1 = 0.6 m" in lines
    assert "(2)  AO = O - A = (0.3, 1.15) - (0.2, 0.55) = (0.1, 0.6) m" in lines
    assert "(3)  OAB = Tcos(|AO|, L_AB, L_OB) = Tcos(0.608276, 0.6, 0.3) = 28.7419 deg" in lines
    assert "(4)  AB = TurnVL(AO, -OAB, L_AB) = TurnVL((0.1, 0.6), -28.7419 deg, 0.6) = (0.37108, 0.471487) m" in lines
    assert "(24) tilt = angle(FK) - 90 deg = angle(-0.0983741, 0.677899) - 90 deg = 8.25691 deg" in lines
    assert lines[-1].startswith("(44) dtilt/dS = cross(FK, dFK/dS)/|FK|**2 = ") and lines[-1].endswith(" = 0.898883 rad/m")


def test_numbers_default_to_the_start_of_the_strokes():
    assert equations(MowerLift, numbers=True).text() == equations(MowerLift).text(at={"S": 0.55})
    assert equations(MowerLift).text(numbers=True) == equations(MowerLift).text(at={})
    assert "OAB(S) = Tcos(|AO|, S, L_OB) = Tcos(0.657912, 0.55, 0.175) = 13.151 deg" in str(equations(MowerLift, numbers=True))
    assert "0.55" not in str(equations(MowerLift, at={"S": 0.6}))


def test_what_is_given_has_its_unit():
    head = str(equations(Slider, numbers=True))
    assert "phi = 5.72958 deg" in head and "rail = (0, -0.2) m" in head and "L_OA = 0.1 m" in head
    assert "rail_angle = 5.72958 deg" in head
    assert "i: the unit vector of the x axis" in head


def test_outputs_as_they_are_written():
    written = {each.name: str(each) for each in equations(Outputs)}
    assert written["O"] == "O = (c/2, c**2)"
    assert written["power"] == "power(S) = S**2/B_x"
    assert written["root"] == "root(S) = sqrt(S**2 + c**2) - |OB|"
    assert written["turned"] == "turned = angle(OB) - 30 deg"
    assert written["wave"] == "wave(S) = exp(-S) + sin(2*angle(AB)) - log(c)"
    assert written["slope"] == "slope = atan2(B_y, B_x)/2"


def test_lines_of_a_crank_and_of_sliders():
    written = {each.name: str(each) for each in equations(Slider)}
    assert written["OA"] == "OA(phi) = TurnVL(i, phi + 20 deg, L_OA)".replace("(phi)", "", 1)
    assert written["u_rail"] == "u_rail = TurnV(i, rail_angle)"
    assert written["H"] == "H = rail + 0.2*u_rail"
    assert "sqrt(L_AC**2 - cross(u_rail, A - rail)**2)" in written["C"]


# -- LaTeX -------------------------------------------------------------------------------------------------


def test_latex_is_numbered_and_in_the_papers_notation():
    text = equations(ThreePointHitch, start=4).latex()
    assert r"\overrightarrow{AB} &= \operatorname{TurnV}_{L}\left(\overrightarrow{AO}, - \angle OAB, L_{AB}\right) \tag{7} \\" in text
    assert r"L_{AB}\left(S\right) &= L_{0} + S \tag{4} \\" in text
    assert r"\vec{B} &= \vec{A} + \overrightarrow{AB} \tag{8} \\" in text
    assert r"\mathit{tilt} &= \arg\left(\overrightarrow{FK}\right) - 90^{\circ} \tag{27}" in text
    assert text.count(r"\begin{align}") == text.count(r"\end{align}") == 1
    assert text.index(r"\begin{align*}") < text.index(r"\begin{align}")
    assert equations(ThreePointHitch).latex(definitions=False).startswith(r"\begin{align}")


@for_all("machine", ALL)
def test_latex_is_balanced(machine):
    text = equations(machine, ratio="B" if machine is not Slider else "C").latex()
    assert text.count("{") == text.count("}") and text.count(r"\left") - text.count(r"\leftarrow") == text.count(r"\right") - text.count(
        r"\rightarrow"
    )


def test_indexed_points_and_greek_strokes():
    class Indexed(Mechanism):
        phi = Stroke(0.1, 0.5)
        O1 = Ground(0.0, 0.0)
        A1 = Crank(O1, O1A1=0.2, angle=phi)

    listed = equations(Indexed, ratio="A1")
    assert r"\overrightarrow{O_{1} A_{1}} &= \operatorname{TurnV}_{L}\left(\vec{\imath}, \phi, L_{O_{1} A_{1}}\right)" in listed.latex()
    assert r"I_{A_{1}} &= \frac{dA_{1,y}}{d\phi}" in listed.latex()
    assert str(listed[-1]) == "I_A1 = dA1_y/dphi"


def test_a_word_keeps_its_exponent():
    word = Tcos(*sympy.symbols("a b c", real=True))
    assert Latex({}).doprint(word) == r"\operatorname{Tcos}\left(a, b, c\right)"
    assert Latex({}).doprint(word**2) == r"\operatorname{Tcos}\left(a, b, c\right)^{2}"


# -- names -------------------------------------------------------------------------------------------------


def test_no_two_things_share_a_name():
    class Clash(Mechanism):
        S = Stroke(0.5, 0.6)
        L_OB = Dimension(0.01)
        A = Ground(0.0, 0.0)
        O = Ground(0.4, 0.1)
        B = Dyad(A, O, AB=S, OB=0.3, side=LEFT)
        AO = 2 * S + L_OB
        B_x = x(B) * 1000

    listed = equations(Clash, at={"S": 0.5})
    assert "Tcos(|AO'|, S, L_OB')" in str(listed["OAB"])
    assert "AO(S) = L_OB + 2*S = 0.01 + 2*0.5 = 1.01" in str(listed)
    values, motion = listed.values(at={"S": 0.5}), Clash().at(S=0.5)
    assert_allclose(values["B"], motion["B"], atol=1e-12)
    assert_allclose(values["B_x"], motion["B_x"], atol=1e-9)


# -- the door ----------------------------------------------------------------------------------------------


def test_both_doors_give_the_same():
    assert str(linkage.equations(MowerLift)) == str(linkage.formulas.equations(MowerLift))


def test_a_number_beside_a_factor_times_an_angle_is_a_length_and_of_a_load_in_its_unit():
    class Rack(Mechanism):
        S, r = Stroke(0.0, 0.25), Dimension(0.12)
        O, K, rail = Ground(0, 0), Ground(0.5, -0.3), Guide((-0.5, -0.6), angle=90 * deg)
        A = Dyad(K, O, KA=0.42 + S, OA=0.3, side=RIGHT)
        P, Q = OnGuide(rail, at=0.3 + 0.12 * angle(O, A)), OnGuide(rail, at=r * (angle(O, A) - 20 * deg) - 0.25)
        M = 8 - r * angle(O, A)
        spring, named = Moment("O A", M=800 - 600 * angle(O, A)), Moment("O A", M=M)

    text = str(equations(Rack(), forces=True))
    assert "((-600*angle(OA) + 800)*(O_y - A_y)" in text and "M = -r*angle(OA) + 8\n" in text
    assert "P = rail + (0.12*angle(OA) + 0.3)*u_rail" in text and "Q = rail + (r*(angle(OA) - 20 deg) - 0.25)*u_rail" in text
