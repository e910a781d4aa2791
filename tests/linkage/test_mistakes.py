"""Mistakes that one makes on the first day: each is told by name, with what to write instead."""

import re

import numpy as np
import pytest

import linkage
from linkage import LEFT, AssemblyError, Crank, DefinitionError, Dyad, Ground, Mechanism, Pin, Stroke, deg, y
from linkage.loads import Weight
from tests.for_all import for_all

NAMES = {name: getattr(linkage, name) for name in linkage.__all__}

CRANK = '''
    phi = Stroke(0, 360 * deg)
    O = Ground(0, 0)
    rail = Guide((0, 0), angle=0)
    A = Crank(O, OA=0.1, angle=phi)
    C = Pin(near=(0.4, 0))
    rod = Link("A C", AC=0.3)
    shoe = Slide("C", rail)
    load = Weight(C, mass=10)
    G = OnLink(A, C, AG=0.1, CAG=30 * deg)
'''


def made(text):
    """Return the class of some lines."""
    names = dict(NAMES)
    exec(f"class Machine(Mechanism):{text}", names)
    return names["Machine"]


def test_the_lines_are_a_machine():
    assert made(CRANK)().sweep(5).reached.all()


@for_all(
    ("right", "wrong", "words"),
    [
        ("Stroke(0, 360 * deg)", "Stroke(0, 360)", "is an angle in radians, 57.3 turns; write Stroke(0 * deg, 360 * deg)"),
        ("CAG=30 * deg", "CAG=-30", "the angle CAG=-30 rad (-1718.87 deg) is more than a full turn; write -30 * deg"),
        ("angle=0)", "angle=90)", "the angle rail.angle=90 rad (5156.62 deg) is more than a full turn; write 90 * deg"),
        ("Pin(near=(0.4, 0))", "Pin(0.4, 0)", "Pin(0.4, 0): say near=(x, y) for a place in a sketch"),
        ('Slide("C", rail)', 'Slide("C", "rial")', "Name 'rial' is unknown in Machine.shoe. Did you mean rail?"),
        ('Slide("C", rail)', 'Slide("C", O)', "shoe = Slide(C, O): O is not a guide"),
        ('Slide("C", rail)', 'Slide("rail", rail)', "shoe = Slide(rail, rail): rail is not a point"),
        ('Link("A C", AC=0.3)', 'Link("A D", AD=0.3)', "Name 'D' is unknown in Machine.rod"),
        ('Link("A C", AC=0.3)', 'Link("A rail", AC=0.3)', "rail is not a point"),
        ('Link("A C", AC=0.3)', 'Link("A C", AB=0.3)', "the label 'AB' does not fit its points; valid labels: AC/CA"),
        ('Link("A C", AC=0.3)', 'Link("AC", AC=0.3)', 'a link joins at least two points; write them apart, Link("O B")'),
        ('Link("A C", AC=0.3)', 'Link("A C", AC="0.3")', "Machine.rod: '0.3' stands where a number"),
        ("mass=10", "mass=-10", "Weight: mass=-10 is negative"),
        ("Weight(C, mass=10)", "Weight('C', mass=-10)", "Weight(C, mass=-10): mass=-10 is negative"),
        ("Weight(C, mass=10)", "Weight(5, mass=10)", "Machine.load: 5 stands where a point or its name is expected"),
    ],
)  # fmt: skip
def test_a_wrong_word_in_a_class(right, wrong, words):
    assert right in CRANK
    with pytest.raises(DefinitionError, match=re.escape(words)) as caught:
        made(CRANK.replace(right, wrong))
    assert len(str(caught.value)) < 200


def test_a_stroke_of_several_turns_without_a_unit_is_remarked():
    told = "The stroke phi = Stroke(-15, 35) is 7.96 turns, in radians; degrees are written Stroke(-15 * deg, 35 * deg)."
    for stroke, text in {"Stroke(-15, 35)": told, "Stroke(0, 1080 * deg)": "", "Stroke(0, 12.5)": ""}.items():
        found = [str(each) for each in made(CRANK.replace("Stroke(0, 360 * deg)", stroke))().verdicts() if " turns, " in each]
        assert found == [text] * bool(text)


def test_a_name_that_is_bound_twice():
    with pytest.raises(DefinitionError, match=r"^Twice: A = Ground\(0.0, 0.0\) stands there already, and A = Ground\(0.1, 0.0\) would"):

        class Twice(Mechanism):
            S = Stroke(0.0, 0.2)
            A, O = Ground(0.0, 0.0), Ground(0.7, 0.0)
            B = Dyad(A, O, AB=0.6 + S, OB=0.3, side=LEFT)
            A = Ground(0.1, 0.0)


def test_points_may_be_listed_with_commas():
    commas = made(CRANK.replace('Link("A C", AC=0.3)', 'Link("A, C", AC=0.3)'))
    assert str(commas.plan) == str(made(CRANK).plan)


class FourBar(Mechanism):
    phi = Stroke(0, 360 * deg)
    O, C = Ground(0, 0), Ground(4, 0)
    A = Crank(O, OA=1, angle=phi)
    B = Dyad(A, C, AB=3, CB=2.5, side=LEFT)


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda: FourBar(phi=1.0), "phi is a stroke; give it to sweep(phi=...) or at(phi=...)"),
        (lambda: FourBar().sweep(1.5), "sweep(1.5): a whole number of poses is expected; for a value write at(phi=1.5)"),
        (lambda: FourBar().sweep(True), "sweep(True): a whole number of poses is expected"),
        (lambda: made("\n    A = Ground(0, 0)")().sweep(3), "Machine has no stroke, so there is nothing to sweep"),
    ],
)
def test_a_wrong_word_to_a_design(ask, words):
    with pytest.raises(DefinitionError, match=re.escape(words)):
        ask()


class Lift(Mechanism):
    S = Stroke(0.0, 0.25)
    A, O = Ground(0.0, 0.0), Ground(0.7, 0.0)
    B = Dyad(A, O, AB=0.6 + S, OB=0.3, side=LEFT)


@for_all(
    ("ask", "words"),
    [
        (lambda: FourBar().at(phi=45), "FourBar: phi = 45 is an angle in radians, 7.16 turns, and the stroke is 0 to 6.28319 rad; "
         "write 45 * deg if these are degrees"),
        (lambda: FourBar().at(phi=-30.0), "phi = -30 is an angle in radians, -4.77 turns"),
        (lambda: FourBar().at(phi=[0.0, 22.5]), "write 22.5 * deg"),
        (lambda: FourBar().at(phi=np.linspace(0.0, 359.99, 7)), "write 359.99 * deg"),
        (lambda: FourBar().sweep(phi=45.0), "write 45 * deg"),
        (lambda: FourBar().evaluate(["B"], phi=45.0), "write 45 * deg"),
        (lambda: Lift().at(S=100), "Lift: S = 100 m, and the stroke is 0 to 0.25 m; write 100 * mm if these are millimetres"),
        (lambda: Lift().at(S=[0.1, -12.5], unreachable="nan"), "write -12.5 * mm"),
        (lambda: Lift().sweep(S=100.0), "write 100 * mm"),
    ],
)  # fmt: skip
def test_degrees_and_millimetres_for_a_stroke(ask, words):
    with pytest.raises(DefinitionError, match=re.escape(words)):
        ask()


def test_strokes_beyond_their_range_are_no_mistake_in_themselves():
    assert FourBar().at(phi=[-4 * np.pi, 6 * np.pi, 15 * np.pi, 15.0]).reached.all()
    assert Lift().at(S=0.3).reached.all()
    assert not Lift().at(S=[0.1, 5.0], unreachable="nan").reached.all()
    with pytest.raises(AssemblyError, match="B = Dyad"):
        Lift().at(S=4.0)


@pytest.mark.parametrize("word", ["left", "LEFT", "Left"])
def test_a_side_may_be_said_as_a_word(word):
    class Said(FourBar):
        B = Dyad("A", "C", AB=3, CB=2.5, side=word)
        P = linkage.OnLink("A", "B", AP=1.0, BP=2.5, side=word)
        post = linkage.Guide((0, 0), angle=90 * deg)
        D = linkage.SliderDyad("A", post, AD=3, side=word)
        E = linkage.PinSlotDyad("O", "A", OE=0.5, offset=0.1, side=word)

    assert {name for name, point in Said.plan.points.items() if "side=LEFT" in str(point)} == set("BPDE")
    assert np.array_equal(Said().sweep(5)["B"], FourBar().sweep(5)["B"])


@for_all("word", ["lefft", "", 1, True, "l"])
def test_what_is_no_side(word):
    steps = [
        lambda: Dyad("A", "C", AB=3, CB=2.5, side=word),
        lambda: linkage.SliderDyad("A", "post", AD=3, side=word),
        lambda: linkage.PinSlotDyad("O", "A", OE=0.5, offset=0.1, side=word),
    ]
    for step in steps:
        with pytest.raises(DefinitionError, match=re.escape(f"side={word!r}; say side=LEFT or side=RIGHT")):
            step()


def test_a_count_from_numpy_is_a_count():
    assert FourBar().sweep(np.int64(3)).shape == (3,)


def test_a_sketch_out_of_reach_tells_what_is_missing():
    said = r"Short: B cannot be assembled at the sketch \(S = 0 mm\): AB \+ OB = 0\.6 m is 100 mm short of AO"
    with pytest.raises(AssemblyError, match=said) as caught:

        class Short(Mechanism):
            S = Stroke(0.0, 0.2)
            A, O = Ground(0.0, 0.0), Ground(0.7, 0.0)
            B = Dyad(A, O, AB=0.3 + S, OB=0.3, near=(0.3, 0.1))

    assert caught.value.shortfall == pytest.approx(0.1)
    assert "or say drawn(...) with other strokes" in str(caught.value)


def test_a_crank_of_a_few_turns_is_no_mistake():
    class Screw(Mechanism):
        phi = Stroke(0, 14 * np.pi)
        O = Ground(0, 0)
        A = Crank(O, OA=1, angle=phi)
        P = Pin(near=(0, 1))
        rod = linkage.Link("A P", AP=1.2)
        post = linkage.Guide((0, 0), angle=90 * deg)
        shoe = linkage.Slide("P", post)

    assert Screw().sweep(29).reached.all()


SIDES = {"OB": 0.5, "OC": 0.3, "BC": np.sqrt(0.34 - 0.3 * np.cos(0.4)), "BOC": 0.4, "COB": -0.4}


@for_all("label", SIDES)
@for_all("off", [0.0, 1e-4])
def test_what_a_link_says_of_points_that_others_place_is_held_against_them(label, off):
    lines = f"""
    phi = Stroke(0, 1)
    O = Ground(0, 0)
    B = Crank(O, OB=0.5, angle=phi)
    D = OnLink(O, B, OD=0.3, BOD=0.4)
    C = OnLink(O, D, OC=0.3)
    arm = Link(O, B, C, {label}={float(SIDES[label] + off)!r})
"""
    if label == "OB" and off:
        with pytest.raises(DefinitionError, match=r"OB=0\.5001 contradicts OB=0\.5; a dimension has one value"):
            made(lines)
    elif label == "OC" and off:
        with pytest.raises(DefinitionError, match=r"OC=0\.3001 contradicts OC=0\.3; a dimension has one value"):
            made(lines)
    elif off:
        with pytest.raises(DefinitionError, match=rf"{label} is given as .*placed by other labels, which make it .*Take it out"):
            made(lines)
    else:
        assert made(lines)().sweep(3).reached.all()


@pytest.mark.parametrize("line", ["v = angle(O, O)", 'v = angle("O", "O")'])
def test_a_direction_needs_two_points(line):
    with pytest.raises(DefinitionError, match=r"a direction leads from one point to another; name two points"):
        made(f"\n    S = Stroke(0, 1)\n    O = Ground(0, 0)\n    {line}\n")


@pytest.mark.parametrize("given", [(0.3,), ([0.1, 0.2],), (np.zeros(3), 1.0)])
def test_a_stroke_is_named_where_it_gets_a_value(given):
    with pytest.raises(DefinitionError, match=r"Machine: at\(.* does not say which stroke has this value; write at\(phi=\.\.\.\)\."):
        made(CRANK)().at(*given)


@for_all("name", ["X\n", "", "a b", "1a", "a.b", "a-b", "class", "None", "<b>", "\\", "ﬁ", "X\u2028", "{x}"])
def test_names_that_no_line_of_python_could_give(name):
    """A class that type(...) makes takes any text for a name; what is printed, drawn and written into files could not be read again."""
    with pytest.raises(DefinitionError, match=f"^{re.escape(repr(name))} is no name for a class: letters, digits and _, no digit first"):
        type(name, (FourBar,), {})
    for member in (Ground(1, 2), Weight("A", mass=3.0), y("A"), Stroke(0, 1)):
        with pytest.raises(DefinitionError, match=f"^{re.escape(repr(name))} is no name for a member of Made"):
            type("Made", (FourBar,), {name: member})


@pytest.mark.parametrize("name", ["Fünfgelenk", "Δ", "_private", "X" * 80])
def test_names_that_a_line_of_python_could_give(name):
    made = type(name, (FourBar,), {name: Ground(1, 2)})
    assert made.plan.title == name
    assert made().at(phi=1.0)[name].tolist() == [1.0, 2.0]


LEVER = """
    S, phi = Stroke(0, 0.2), Stroke(0, 1)
    A, O = Ground(0, 0), Ground(0.1, 0.6)
    B = Crank(O, OB=0.3, angle=phi)
"""
FOLLOWS = [
    ('ram = Link("A B", AB=0.45 + S)', r'ram = Link\("A B", AB=0.45 \+ S\) follows it, but B = Crank\(.*\) places B without it. Let'),
    ("tie = Weight(B, mass=S * 3)", r"tie = Weight\(.*\) follows it, but B = Crank\(.*\) places B without it"),
    ("gap = distance(A, B) - S", r"gap = .* follows it, but B = Crank\(.*\) places B without it"),
    ("rail = Guide(A, angle=S)", r"rail = Guide\(A, angle=S\) follows it, and no point does; use it in the length or the angle of a step"),
    ("twice = 2 * S", r"twice = .* follows it, and no point does"),
    ("", r"use it in a length or an angle, or take it out"),
]


@for_all(("line", "words"), FOLLOWS)
def test_a_stroke_that_moves_nothing_is_told_by_what_follows_it(line, words):
    with pytest.raises(DefinitionError, match=f"^Machine: the stroke S moves nothing[:;] {words}"):
        made(f"{LEVER}    {line}\n")


def test_the_remedies_for_a_stroke_that_moves_nothing_work():
    """The step takes the length, or the link places the point as a pin: both are one machine."""
    head = LEVER.replace(", phi = Stroke(0, 0.2), Stroke(0, 1)", " = Stroke(0, 0.2)").replace("    B = Crank(O, OB=0.3, angle=phi)\n", "")
    step = made(head + "    B = Dyad(A, O, AB=0.45 + S, OB=0.3, side=RIGHT)\n")
    pins = made(head + '    B = Pin(near=(0.38, 0.5))\n    arm = Link("O B", OB=0.3)\n    ram = Link("A B", AB=0.45 + S)\n')
    assert np.allclose(step().sweep(5)["B"], pins().sweep(5)["B"], rtol=0, atol=1e-14)


TILT = """
    S = Stroke(0.0, 0.3)
    O, A = Ground(0, 0.6), Ground(0.35, 0.15)
    B = Dyad(A, O, {lengths}, side=RIGHT)
    load = Weight(B, mass=400)
"""
RIGHT_LENGTHS = "AB=0.55 + S, OB=0.5"


@for_all(
    ("lengths", "line", "words"),
    [
        ("AB=500 + S, OB=300", "", r"Are all lengths in m\? 500 m would be 500 \* mm"),
        ("AB=550 + S, OB=500", "", r"Are all lengths in m\? 550 m would be 550 \* mm"),
        ("AB=1.4 + S, OB=0.3", "", "or lengthen OB"),
        (RIGHT_LENGTHS, "case = LoadCase(scale={load: 2})", r'scale=\{load: ...\} names the load itself; .* scale=\{"load": 2.0\}'),
        (RIGHT_LENGTHS, "C = Dyad(A, O, AC=0.4, OC=0.5, side='rihgt')", "side='rihgt'; .* Did you mean RIGHT"),
        (RIGHT_LENGTHS, "pull = Force(B, 8 * kN)", r"Force: 8000.0 is not a vector; .* it is \(0, -8 \* kN\)"),
        (RIGHT_LENGTHS, "hung = Pulley(B, radius=80, side=LEFT)", r"radius=80 m is more than any pulley has; write 80 \* mm"),
    ],
)  # fmt: skip
def test_a_length_or_a_load_is_asked_about_in_its_own_words(lengths, line, words):
    names = {**NAMES, "kN": linkage.units.kN}
    with pytest.raises(linkage.LinkageError, match=words):
        exec(f"class Machine(Mechanism):{TILT.format(lengths=lengths)}    {line}\nMachine().sweep(S=0.0)", names)


def test_the_dimension_in_another_unit_is_named_and_no_distance_that_it_makes_long():
    from mechanisms.classics.four_bar import FourBar

    with pytest.raises(linkage.LinkageError, match=r"AC = 120.1 m\. .* OA = 120 m, 0\.04 m in the class, would be 120 \* mm"):
        FourBar(OA=120).sweep(3)


def test_a_name_that_is_nearly_right_or_a_heading_of_a_table_is_answered_with_the_right_one():
    machine = made(TILT.format(lengths=RIGHT_LENGTHS))
    with pytest.raises(AttributeError, match=r"Weight has no attribute 'mas'\. Did you mean mass"):
        _ = machine().plan.members["load"].mas
    motion = machine().sweep(3)
    for ask in (lambda: motion["B_y"], lambda: motion.ratio("B_y"), lambda: machine().evaluate(["B_y"], S=0.1)):
        with pytest.raises(DefinitionError, match=r'The coordinate is motion\.y\("B"\), in requests y\("B"\)'):
            ask()
    assert np.array_equal(motion.y("B"), motion["B"][1])
    with pytest.raises(DefinitionError, match="Did you mean B"):
        _ = motion["B_z"]
