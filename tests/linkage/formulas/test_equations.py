"""The equations say what the motion does, in every spelling: values, derivatives, closed forms; and they refuse by name."""

import numpy as np
import pytest
import sympy
from numpy.testing import assert_allclose

from linkage import LEFT, AssemblyError, Crank, DefinitionError, Dyad, Ground, Link, Mechanism, OnLink, Pin, Stroke, angle, deg
from linkage.formulas import Equations, Tcos, TurnVL, equations, explicit
from linkage.plan import ArrayReading
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all
from tests.linkage.formulas.equation_machines import ALL, HITCHES, MowerInPrimitives, Outputs, Slider, check_values, poses
from tests.linkage.program.sympy_program import program_expressions
from tests.linkage.random_mechanisms import random_mechanism

# -- SymPy -------------------------------------------------------------------------------------------------


def test_sides_are_sympy():
    listed = equations(ThreePointHitch)
    first, turned = listed[0], listed["AB"]
    assert isinstance(listed, Equations) and len(listed) == 24 and [each.number for each in listed[:3]] == [1, 2, 3]
    assert first.lhs == sympy.Symbol("L_AB", real=True)
    assert first.rhs - listed.symbols["S"] == listed.symbols["L0"]
    assert isinstance(turned.rhs, TurnVL) and turned.rhs.shape == (2, 1)
    assert [symbol.name for symbol in turned.symbols] == ["AO", "L_AB", "OAB"]
    a, b, c = sympy.symbols("a b c", positive=True)
    assert sympy.simplify(explicit(Tcos(a, b, c))[0] - sympy.acos((a**2 + b**2 - c**2) / (2 * a * b))) == 0
    assert sympy.simplify(sum(part**2 for part in explicit(turned.rhs)) - listed.symbols["L_AB"] ** 2) == 0


def printed_dfi3(L0, L3, S):
    """Return the worksheet's DFI3 = 2 S / sqrt(4 L0^2 L3^2 - (S^2 - (L3^2 + L0^2))^2)."""
    return 2 * S / sympy.sqrt(4 * L0**2 * L3**2 - (S**2 - (L3**2 + L0**2)) ** 2)


def test_mower_lift_derives_the_printed_dfi3():
    listed = equations(MowerLift, ratio="FI3")
    found, given = listed.closed("dFI3/dS"), listed.symbols
    coordinates = sympy.symbols("A.x A.y O.x O.y", real=True)
    L0 = sympy.sqrt((coordinates[2] - coordinates[0]) ** 2 + (coordinates[3] - coordinates[1]) ** 2)
    assert found.free_symbols == {*coordinates, given["S"], given["L_OB"]}
    assert sympy.simplify(found**2 - printed_dfi3(L0, given["L_OB"], given["S"]) ** 2) == 0
    numbers = dict(zip(coordinates, sympy.sympify(["0", "242/1000", "652/1000", "330/1000"]), strict=True))
    assert found.subs(numbers | {given["L_OB"]: 0.175, given["S"]: 0.55}) > 0


def test_the_levers_direction_turns_at_the_printed_dfi3_to_forty_digits():
    listed = equations(MowerInPrimitives, ratio="FI3")
    for S in (0.55, 0.65, 0.80):
        L0 = sympy.sqrt(sympy.Rational("0.652") ** 2 + sympy.Rational("0.088") ** 2)
        exact = printed_dfi3(L0, sympy.Rational("0.175"), sympy.Rational(repr(S))).evalf(50)
        found = listed.values(at={"S": S}, digits=40)["dFI3/dS"]
        assert abs(found - exact) < sympy.Float("1e-38", 50)


def test_digits_close_the_loop():
    values = equations(MowerLift).values(at={"S": 0.6}, digits=60)
    assert abs(sum(part**2 for part in values["AB"]) - sympy.Rational("0.36")) < sympy.Float("1e-58")
    assert abs(sum(part**2 for part in values["OB"]) - sympy.Rational("0.175") ** 2) < sympy.Float("1e-58")


def test_a_long_chain_has_no_closed_form():
    with pytest.raises(DefinitionError, match="more than 20000 operations in closed form"):
        equations(ThreePointHitch).closed("G")


# -- numbers -----------------------------------------------------------------------------------------------


@for_all("machine", ALL)
def test_equations_are_the_motion(machine):
    assert check_values(machine(), poses(machine())) >= 7


@pytest.mark.slow
@for_all(
    ("machine", "targets"),
    [(hitch, ["B", "C", "D", "F", "K", "G", "tilt"]) for hitch in HITCHES]
    + [(MowerLift, ["B", "G", "FIS", "FI3", "FI", "FIS1"]), (MowerInPrimitives, ["B", "G", "FI3"]), (Slider, ["A", "C", "Y", "R", "w"])]
    + [(Outputs, ["B", "half", "power", "root", "turned", "wave", "least", "slope"])],
)
def test_chain_of_derivatives_is_the_ratio(machine, targets):
    design = machine()
    at, stroke = poses(design), next(iter(design.strokes))
    values, motion = equations(design, ratio=targets).values(at=at), design.at(**at)
    for target in targets:
        found = np.array(np.broadcast_arrays(values[f"d{target}/d{stroke}"], motion.ratio(target))[0])
        assert_allclose(found, motion.ratio(target), rtol=1e-10, atol=1e-11, err_msg=target)
        if target in design.plan.points:
            assert_allclose(values[f"I_{target}"] * np.ones(11), motion.ratio(target)[1], rtol=1e-10, atol=1e-11)


@for_all("seed", range(1), slow=range(1, 8))
def test_random_dyads(seed):
    machine = random_mechanism(seed, strokes=1 + seed % 2)()
    at = {name: np.array([stroke.start, 0.3 * stroke.end, stroke.end]) for name, stroke in machine.strokes.items()}
    assert check_values(machine, at) >= 15


def test_pins_found_together_satisfy_their_conditions():
    class Group(Mechanism):
        phi = Stroke(0.1, 0.3)
        O, P, Q = Ground(0, 0), Ground(1.0, 0.0), Ground(0.5, 1.2)
        A = Crank(O, OA=0.1, angle=phi)
        plate = Link("D E F", DE=0.3)
        r1, r2, r3 = Link("A D", AD=0.43), Link("P E"), Link("Q F")
        D, E, F = Pin(at=(0.5, 0.2)), Pin(at=(0.8, 0.3)), Pin(at=(0.6, 0.5))

    listed = equations(Group)
    assert {"|AD| = L_AD", "|PE| = L_PE", "|QF| = L_QF"} <= set(map(str, listed))
    assert "D, E, F: found together" in str(listed)
    values, motion = listed.values(at={"phi": 0.2}), Group().at(phi=0.2)
    for point in "DEF":
        assert_allclose(values.get(point, motion[point]), motion[point], atol=1e-9)
    assert_allclose([np.hypot(*values[rod]) for rod in ("AD", "DE")], [0.43, 0.3], atol=1e-9)
    for rod in ("AD", "DE", "PE", "QF"):
        assert_allclose(np.hypot(*values[rod]), values[f"|{rod}|"], atol=1e-9)
    with pytest.raises(DefinitionError, match=r"take motion\.ratio"):
        equations(Group, ratio="D")


# -- errors ------------------------------------------------------------------------------------------------


@for_all(
    ("ask", "words"),
    [
        (lambda: equations(ThreePointHitch, ratio="Z"), "'Z' is unknown in ThreePointHitch"),
        (lambda: equations(ThreePointHitch, ratio="G", wrt="T"), "Stroke 'T' is unknown"),
        (lambda: equations(ThreePointHitch).values(at={"T": 1.0}), "Stroke 'T' is unknown"),
        (lambda: equations(ThreePointHitch)["Z"], "Equation 'Z' is unknown"),
        (lambda: equations(ThreePointHitch(OB=[0.3, 0.31])).values(), "its equations take one design"),
        (lambda: str(equations(ThreePointHitch, at={"S": [0.0, 0.1]})), "one value for each stroke"),
    ],
)
def test_what_cannot_be_is_said(ask, words):
    with pytest.raises(DefinitionError, match=words):
        ask()


def test_a_pose_out_of_reach_is_refused_by_name():
    with pytest.raises(AssemblyError, match="B = Dyad"):
        str(equations(MowerLift, at={"S": 0.9}))


def test_of_several_strokes_one_is_named():
    class Two(Mechanism):
        S1, S2 = Stroke(0.5, 0.6), Stroke(0.4, 0.5)
        A, O = Ground(0.0, 0.0), Ground(0.4, 0.1)
        B = Dyad(A, O, AB=S1, OB=0.3, side=LEFT)
        C = Dyad(B, A, BC=S2, AC=0.3, side=LEFT)

    with pytest.raises(DefinitionError, match="wrt= one of S1, S2"):
        equations(Two, ratio="C")
    at = {"S1": 0.55, "S2": 0.45}
    for stroke in at:
        values = equations(Two, ratio="C", wrt=stroke).values(at=at)
        assert_allclose(values[f"dC/d{stroke}"], Two().at(**at).ratio("C", wrt=stroke), rtol=1e-11)


# -- expansions and oracle ---------------------------------------------------------------------------------


@pytest.mark.parametrize("machine", [ThreePointHitch, MowerLift, Slider])
def test_expansion_places_the_point(machine):
    design = machine()
    motion = design.at(**poses(design))
    reading = ArrayReading(design.plan.members, design.plan.table.lengths, motion.inputs)
    for name, step in design.plan.points.items():
        reading.placing.append(name)
        for each in step.expansion():
            if each.name == name:
                place = each.value.place(reading)
                assert_allclose([place.x, place.y], motion[name], rtol=0, atol=1e-12)


@pytest.mark.slow
def test_program_read_by_sympy_has_the_motions_derivatives():
    """Exact derivatives by SymPy of the traced program, at 40 digits, against the program's own."""

    class One(Mechanism):
        S = Stroke(0.5, 0.7)
        A, O = Ground(0.0, 0.0), Ground(0.5, 0.1)
        B = Dyad(A, O, AB=S, OB=0.3, side=LEFT)
        C = OnLink(O, B, OC=0.4, BOC=30 * deg)
        lean = angle(A, C)

    machine, S = One(), sympy.Symbol("S", real=True)
    given = {sympy.Symbol(name, real=True): sympy.Rational(value) for name, value in machine.dimensions.items()}
    poses = (0.61,)
    motion = machine.at(S=poses)
    for target in ("C", "lean"):
        closed = [each.subs(given) for each in program_expressions(machine.plan, target)]
        for order, expected in enumerate((motion[target], motion.ratio(target), motion.ratio(target, order=2))):
            for each, values in zip([each.diff(S, order) for each in closed], np.atleast_2d(expected), strict=True):
                found = [float(each.evalf(40, subs={S: sympy.Rational(pose)})) for pose in poses]
                assert_allclose(found, values, rtol=1e-12, atol=1e-13, err_msg=f"{target}, order {order}")


def test_designs_have_their_own_values_and_a_line_that_divides_by_zero_stays_alone():
    class Arm(Mechanism):
        S = Stroke(0.0, 0.2)
        O = Ground(0.0, 0.0)
        A = Ground(0.5, 0.0)
        P = Dyad(O, A, OP=0.4, AP=0.3 + S, side=LEFT)
        slope = angle(O, P)
        steep = 1.0 / (S - 0.1)

    for length in (0.4, 0.42):
        plain, exact = equations(Arm(OP=length)).values({"S": 0.05}), equations(Arm(OP=length)).values({"S": 0.05}, digits=30)
        assert plain["slope"] == pytest.approx(float(exact["slope"]), rel=1e-14) and plain["steep"] == pytest.approx(-20.0)
    there = equations(Arm).values({"S": 0.1}, digits=30)
    assert sympy.nan == there["steep"] and float(there["slope"]) == pytest.approx(Arm().at(S=0.1)["slope"], rel=1e-14)
