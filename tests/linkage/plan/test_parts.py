"""Parts: what a machine says of them, what they bring, and what is refused in words."""

import re

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from hydraulics import Cylinder, LiftCircuit, OilLine, Tank, thrust
from linkage import (
    RIGHT,
    AssemblyError,
    Carried,
    Crank,
    DefinitionError,
    Dimension,
    Dyad,
    Ground,
    Link,
    LoadCase,
    Mechanism,
    Moment,
    OnLink,
    Outline,
    Over,
    Part,
    Stroke,
    Weight,
    angle,
    bar,
    deg,
    distance,
    drive_force,
    equations,
    export,
    mm,
    most,
    pin_force,
    pin_forces,
    ref,
    x,
)
from linkage.files import load, to_toml
from linkage.pictures import style
from linkage.pictures.scene import Scene
from linkage.steps import Point
from linkage.vectors import Vec
from tests.for_all import for_all
from tests.linkage.pictures.colour_vision import SIGHT, ciede2000, contrast, lab


class Arm(Mechanism):
    """A lever moved by a cylinder."""

    S = Stroke(0, 0.3)
    O = Ground(0, 0)
    A = Ground(0.1, -0.4)
    L0 = Dimension(0.45)
    B = Dyad(A, O, AB=L0 + S, OB=0.4, side=RIGHT)
    T = OnLink(O, B, OT=1.2, BOT=20 * deg, side=RIGHT)
    arm = Link(O, B, T)
    tilt = angle(O, T)
    reach = x(T)
    G = OnLink(O, B, OG=0.6)
    load = Weight(G, mass=100)
    twist = Moment("O B", M=40)
    ram = Cylinder(A, B, bore=80 * mm, rod=40 * mm)
    pump = LiftCircuit(ram, pressure=180 * bar)


class Loader(Mechanism):
    """Two arms on each other and a third one opposite."""

    s1, s2 = Stroke(0, 0.3), Stroke(0, 0.25)
    lower = Part(Arm, S=s1, OB=0.45)
    upper = Part(Arm, S=s2, on=(lower.T, lower.O), O=lower.T, A=(0.45, -0.1))
    twin = Part(Arm, at=(2, 0), mirrored=True)
    P = OnLink(lower.T, lower.O, lower_TP=0.2)
    span = distance("upper.T", "twin.T")


class Flat(Mechanism):
    """The same, typed flat."""

    s1, s2, s3 = Stroke(0, 0.3), Stroke(0, 0.25), Stroke(0, 0.3)
    lO, lA, lL = Ground(0, 0), Ground(0.1, -0.4), Dimension(0.45)
    lB = Dyad(lA, lO, lAlB=lL + s1, lOlB=0.45, side=RIGHT)
    lT = OnLink(lO, lB, lOlT=1.2, lBlOlT=20 * deg, side=RIGHT)
    larm = Link(lO, lB, lT)
    lG = OnLink(lO, lB, lOlG=0.6)
    lload, ltwist = Weight(lG, mass=100), Moment("lO lB", M=40)
    lram = Cylinder(lA, lB, bore=80 * mm, rod=40 * mm)
    uA, uL = Carried(lT, lO, 0.45, -0.1), Dimension(0.45)
    uB = Dyad(uA, lT, uAuB=uL + s2, lTuB=0.4, side=RIGHT)
    uT = OnLink(lT, uB, lTuT=1.2, uBlTuT=20 * deg, side=RIGHT)
    uarm = Link(lT, uB, uT)
    uG = OnLink(lT, uB, lTuG=0.6)
    uload, utwist = Weight(uG, mass=100), Moment("lT uB", M=40)
    uram = Cylinder(uA, uB, bore=80 * mm, rod=40 * mm)
    tO, tA, tL = Ground(2, 0), Ground(1.9, -0.4), Dimension(0.45)
    tB = Dyad(tA, tO, tAtB=tL + s3, tOtB=0.4, side="LEFT")
    tT = OnLink(tO, tB, tOtT=1.2, tBtOtT=20 * deg, side="LEFT")
    tarm = Link(tO, tB, tT)
    tG = OnLink(tO, tB, tOtG=0.6)
    tload, ttwist = Weight(tG, mass=100), Moment("tO tB", M=-40)
    tram = Cylinder(tA, tB, bore=80 * mm, rod=40 * mm)
    P = OnLink(lT, lO, lTP=0.2)


STROKES = np.linspace(0.02, 0.28, 5)
POSES = {"s1": STROKES, "s2": 0.1, "twin.S": 0.07}
FLAT_POSES = {"s1": STROKES, "s2": 0.1, "s3": 0.07}
SAME = {"lower.B": "lB", "lower.T": "lT", "upper.A": "uA", "upper.B": "uB", "upper.T": "uT", "twin.T": "tT", "upper.O": "lT", "P": "P"}


@for_all("name", SAME)
def test_a_machine_of_parts_is_the_same_typed_flat(name):
    parts, flat = Loader().at(**POSES), Flat().at(**FLAT_POSES)
    compared = assert_array_equal if not name.startswith("twin") else lambda a, b: assert_allclose(a, b, rtol=1e-14, atol=1e-14)
    compared(parts[name], flat[SAME[name]])
    compared(parts.ratio(name, wrt="s1"), flat.ratio(SAME[name], wrt="s1"))
    compared(parts.ratio(name, wrt="s1", order=2), flat.ratio(SAME[name], wrt="s1", order=2))


@pytest.mark.parametrize(("name", "other"), [("lower", "l"), ("upper", "u"), ("twin", "t")])
def test_forces_of_parts_are_those_typed_flat(name, other):
    parts, flat = Loader().at(**POSES), Flat().at(**FLAT_POSES)
    ram, own = Loader.plan.members[f"{name}.ram"], Flat.plan.members[f"{other}ram"]
    assert_allclose(ram.thrust(parts), own.thrust(flat), rtol=1e-13)
    point, plain = (f"{name}.B", f"{other}B")
    found, expected = Loader().evaluate([pin_force(point)], **POSES), Flat().evaluate([pin_force(plain)], **FLAT_POSES)
    assert_allclose(found[0], expected[0], rtol=1e-13)


def test_what_a_mirrored_part_says_itself_reads_as_in_the_part():
    parts, alone = Loader().at(**POSES), Arm().at(S=0.07)
    assert_allclose(parts["twin.tilt"], np.full(5, alone["tilt"]), rtol=1e-13)
    assert_allclose(parts["twin.reach"], np.full(5, alone["reach"]), rtol=1e-13)
    assert_allclose(parts["twin.T"][0], 2 - alone["T"][0], rtol=1e-13)


def test_the_motion_of_a_part_is_that_of_the_part_alone_with_the_forces_of_the_whole():
    parts = Loader(**{"lower.OB": 0.5}).at(**POSES)
    lower, alone = parts.part("lower"), Arm(OB=0.5).at(S=STROKES)
    assert_allclose(lower["T"], alone["T"], rtol=1e-13)
    assert_allclose(lower.ratio("T"), alone.ratio("T"), rtol=1e-12)
    assert_allclose(lower["tilt"], parts["lower.tilt"], rtol=1e-13)
    ram = Arm.plan.members["ram"]
    assert_array_equal(ram.thrust(lower), Loader.plan.members["lower.ram"].thrust(parts))
    assert np.all(np.abs(ram.thrust(lower)) > 1.5 * np.abs(ram.thrust(alone)))  # the upper arm hangs on it
    assert [column.name for column in Arm().columns(lower)] == [column.name for column in Arm().columns(alone)]
    assert_array_equal(lower[drive_force("S")], parts[drive_force("s1")])
    moved = Loader(**{"lower.OB": 0.5}).at(**{**POSES, "s1": STROKES / 2})
    assert_array_equal(ram.thrust(lower.moved({"S": STROKES / 2})), moved[thrust("lower.ram")])
    assert_allclose(lower.gradient("T", ["OB"]), alone.gradient("T", ["OB"]), rtol=1e-12)
    of_whole = {
        "the gradient of thrust": lambda: lower.gradient(thrust("ram"), ["OB"]), "the force at O": lambda: lower[pin_force("O")],
        "what is judged": lambda: Arm().verdicts(lower),
    }  # fmt: skip
    for what, asked in of_whole.items():
        with pytest.raises(DefinitionError, match=f"Loader: {what}.* of the part lower hangs on .* names such as lower"):
            asked()
    with pytest.raises(DefinitionError, match="Part 'side' is unknown in Loader"):
        parts.part("side")


def test_dimensions_go_by_dotted_names():
    machine = Loader(**{"lower.OB": 0.5, "lower.ram.bore": 0.09, "upper.A": (0.4, 0.0)})
    assert machine["lower.OB"] == machine["lower.BO"] == 0.5
    assert_array_equal(machine["upper.A"], [0.4, 0.0])
    assert Loader()["lower.OB"] == 0.45
    assert Loader()["upper.OB"] == 0.4
    batch = Loader(**{"lower.OB": np.array([0.45, 0.5])}).at(**POSES)
    assert_array_equal(batch["upper.T"][:, 1], Loader(**{"lower.OB": 0.5}).at(**POSES)["upper.T"])


def test_dimensions_and_strokes_follow_quantities_of_the_whole():
    class Coupled(Mechanism):
        S, L = Stroke(0, 0.2), Dimension(0.5)
        one = Part(Arm, S=S, OB="L")
        two = Part(Arm, S=0.05 + S * 0.5, OB=L * 0.9, at=("L", 1))

    design = Coupled(L=0.48)
    motion = design.at(S=0.1)
    assert list(Coupled.plan.strokes) == ["S"]
    assert_allclose(motion["one.T"], Arm(OB=0.48).at(S=0.1)["T"], rtol=1e-14)
    assert_allclose(motion["two.T"], Arm(OB=0.432).at(S=0.1)["T"] + [0.48, 1], rtol=1e-13)
    assert motion["one.S"] == motion["two.S"] == 0.1
    with pytest.raises(DefinitionError, match=r"one\.OB follows L; set what it follows"):
        Coupled(**{"one.OB": 0.4})


def test_parts_hold_parts():
    class Pair(Mechanism):
        left = Part(Loader)
        right = Part(Loader, at=(5, 1), angle=30 * deg, mirrored=True)

    poses = {f"{side}.{name}": value for side in ("left", "right") for name, value in POSES.items()}
    motion, alone = Pair().at(**poses), Loader().at(**POSES)
    assert_array_equal(motion["left.upper.T"], alone["upper.T"])
    px, py = -alone["upper.T"][0], alone["upper.T"][1]
    turned = [5 + px * np.cos(np.pi / 6) - py * np.sin(np.pi / 6), 1 + px * np.sin(np.pi / 6) + py * np.cos(np.pi / 6)]
    assert_allclose(motion["right.upper.T"], turned, rtol=1e-12)
    assert_allclose(motion["right.twin.tilt"], alone["twin.tilt"], rtol=1e-11)
    assert "left.lower_TP" in Pair.plan.table.entries


def test_a_subclass_exchanges_a_part():
    class Long(Arm):
        T = OnLink("O", "B", OT=1.5)

    class Other(Loader):
        upper = Part(Long, S="s2", on=("lower.T", "lower.O"), O="lower.T", A=(0.45, -0.1))

    class Anew(Mechanism):
        s1, s2 = Stroke(0, 0.3), Stroke(0, 0.25)
        lower = Part(Arm, S=s1, OB=0.45)
        upper = Part(Long, S=s2, on=(lower.T, lower.O), O=lower.T, A=(0.45, -0.1))
        twin = Part(Arm, at=(2, 0), mirrored=True)

    assert_array_equal(Other().at(**POSES)["upper.T"], Anew().at(**POSES)["upper.T"])
    assert "upper.tilt" in Other.plan.members


def test_the_printed_plan_can_be_pasted_back():
    space = {"Arm": Arm, **{name: value for name, value in vars(__import__("linkage")).items() if name[0] != "_"}}
    exec("from linkage import *\nfrom hydraulics import *", space)
    body = "\n".join(f"    {line}" for line in str(Loader.plan).splitlines())
    exec(f"class Again(Mechanism):\n{body}\n", space)
    assert_array_equal(space["Again"]().at(**POSES)["upper.T"], Loader().at(**POSES)["upper.T"])
    assert str(space["Again"].plan) == str(Loader.plan)


def test_cases_and_domains_of_the_whole_speak_of_dotted_names():
    class Judged(Loader):
        heavy = LoadCase("heavy", scale={"lower.load": 2.0})
        runs = Over(s1=(0.05, 0.2), s2=0.1, **{"twin.S": 0.1})

    design = Judged()
    (found,) = design.answers([most(pin_force("lower.B"))])
    at_end = design.at(s1=0.2, s2=0.1, **{"twin.S": 0.1})
    forces = [np.hypot(*pin_forces(at_end, case=case).force("lower.B")) for case in (None, "heavy")]
    assert found.value >= max(forces) * (1 - 1e-9)
    assert "heavy" in str(found)


def test_equations_name_what_parts_have():
    found = {each.name: each for each in equations(Loader())}
    assert {"lower.B", "lower.T", "upper.A", "twin.A", "lower.OAB"} <= found.keys()
    values = equations(Loader()).values(dict(s1=0.1, s2=0.1, **{"twin.S": 0.1}))
    motion = Loader().at(s1=0.1, s2=0.1, **{"twin.S": 0.1})
    for name in ("lower.B", "upper.A", "upper.T", "twin.T"):
        assert_allclose(np.array(values[name], float), motion[name], rtol=1e-12)
    assert_allclose(float(values["twin.tilt"]), motion["twin.tilt"], rtol=1e-12)


def test_words_that_are_no_names_stay():
    class Sided(Mechanism):
        S = Stroke(0, 0.2)
        rod, piston = Ground(0, 0), Ground(0.1, -0.4)
        B = Dyad(piston, rod, pistonB=ref("L0") + S, rodB=0.4, side=RIGHT)
        L0 = Dimension(0.45)
        ram = Cylinder(piston, B, bore=80 * mm, rod=40 * mm, works="rod")

    class Holder(Mechanism):
        one = Part(Sided)

    assert Holder.plan.members["one.ram"].works == "rod"
    assert Holder.plan.members["one.ram"].ends == ("one.piston", "one.B")


class Deep:
    """Classes of parts in parts."""

    @staticmethod
    def of(depth):
        """Return a class that holds parts so deep."""
        found = Arm
        for level in range(depth):
            found = type(f"Deep{level}", (Mechanism,), {"p": Part(found)})
        return found


def declare(**members):
    """Return a class of members."""
    return type("Wrong", (Mechanism,), members)


REFUSED = {
    "a design": (lambda: declare(left=Arm()), r"Wrong\.left = Arm\(\.\.\.\) is a design.*left = Part\(Arm\)"),
    "a class": (lambda: declare(left=Arm), r"left = Part\(Arm\)"),
    "no machine": (lambda: Part(3), r"Part\(3\): a class of mechanisms is expected"),
    "a place by a name": (lambda: declare(p=Part(Arm, at="A")), r"write \(x, y\) in m, or fuse its fixed points"),
    "a moving point": (lambda: declare(p=Part(Arm, B=(0, 0))), "B moves in the part and takes no place; give its fixed points, O, A"),
    "an unknown name": (lambda: declare(p=Part(Arm, OX=2)), r"Name 'OX' is unknown in Part\(Arm\)"),
    "a fixed point left out": (lambda: declare(p=Part(Arm, O=None)), "cannot be left out"),
    "what others need": (lambda: declare(p=Part(Arm, ram=None)), "leave that out, too, pump=None"),
    "a stroke left out": (lambda: declare(p=Part(Arm, S=None)), "the stroke S cannot be left out"),
    "a batch": (lambda: Part(Arm(OB=np.array([0.4, 0.5]))), "a batch of designs; a part is one of them"),
    "a batch as a keyword": (lambda: Part(Arm, OB=[0.4, 0.5]), "OB is a batch of 2 values"),
    "two circuits": (lambda: declare(p=Part(Arm), q=LiftCircuit("p.ram", pressure=1e7)), r"p = Part\(\.\.\., pump=None\)"),
    "one point": (lambda: declare(a=Part(Arm), p=Part(Arm, on="a.T")), r"a\.T is one point.*name two points of the body"),
    "too deep": (lambda: Deep.of(9), "holds parts 9 deep; up to 8 are taken"),
    "a label that follows": (lambda: declare(p=Part(Arm, ram=3)), "ram is a load and takes no value"),
}


@for_all("case", REFUSED)
def test_what_cannot_be_a_part_is_refused_in_words(case):
    make, words = REFUSED[case]
    with pytest.raises(DefinitionError, match=words):
        make()


def test_a_wrong_name_fails_on_its_line():
    with pytest.raises(DefinitionError, match="Name 'Q' is unknown in lower = Part"):

        class Wrong(Mechanism):
            lower = Part(Arm)
            P = OnLink(lower.Q, lower.O, lower_QP=0.2)


class Mid(Point):
    """The middle of two points."""

    def __init__(self, P, Q):
        self.P, self.Q = P, Q

    def parts(self):
        return self.P, self.Q

    def place(self, where):
        return (where.at(self.P) + where.at(self.Q)) * 0.5


class Aside(Mid):
    """A point to the left of the way from one point to another."""

    def place(self, where):
        return where.at(self.P) + (where.at(self.Q) - where.at(self.P)).left() * 0.3


class Above(Mid):
    """A point straight above another one."""

    def place(self, where):
        return where.at(self.P) + Vec(0.0, 0.2)


FOREIGN = {
    "mid": (Mid, {"upright": True, "turned": True, "mirrored": True, "carried": True}),
    "aside": (Aside, {"upright": True, "turned": True, "mirrored": False, "carried": True}),
    "above": (Above, {"upright": True, "turned": False, "mirrored": True, "carried": False}),
}
STANDS = {"upright": dict(at=(1, 2)), "turned": dict(angle=0.5), "mirrored": dict(mirrored=True), "carried": dict(on=("O", "Q"))}


@pytest.mark.slow
@for_all("stands", STANDS)
@for_all("kind", FOREIGN)
def test_steps_of_other_packages_move_with_a_part_or_are_refused(kind, stands):
    step, fits = FOREIGN[kind]
    machine = type("Own", (Arm,), {"M": step("O", "B")})
    members = {"t": Stroke(0, 1), "O": Ground(0, 0), "Q": Crank("O", OQ=0.5, angle="t"), "p": Part(machine, **STANDS[stands])}
    if not fits[stands]:
        with pytest.raises(DefinitionError, match=f"M = {step.__name__}.* speaks of the frame: .* mm beside the place"):
            declare(**members)
        return
    motion, alone = declare(**members)().at(t=0.3, **{"p.S": 0.1}), machine().at(S=0.1)
    found = [abs(complex(*(motion[f"p.{name}"] - motion["p.M"]))) for name in "OAB"]
    assert_allclose(found, [abs(complex(*(alone[name] - alone["M"]))) for name in "OAB"], rtol=1e-12)


def test_labels_of_fused_points_are_those_of_the_part():
    texts = [str(each) for each in equations(Loader())]
    assert "upper.AO = lower.T - upper.A" in texts
    assert any(text.startswith("upper.OAB = Tcos(|upper.AO|, L_upper.AB, L_upper.OB)") for text in texts)
    with pytest.raises(AssemblyError, match=r"upper\.AB \+ upper\.OB = .* short of upper\.AO.* lengthen upper\.OB|upper\.AO \+ upper\.OB"):
        Loader(**{"upper.OB": 0.02}).at(**POSES)


def test_equations_are_headed_by_part_and_numbers_go_on():
    found = equations(Loader(), forces=True)
    assert [each.number for each in found] == list(range(1, len(found) + 1))
    assert list(found.headings.values())[:4] == ["lower (Arm)", "twin (Arm)", "upper (Arm)", "Loader"]
    text = found.text().split("Loader\n", 1)[0]
    assert text.index("lower (Arm)\n(1)") < text.index("\n\ntwin (Arm)\n") < text.index("\n\nupper (Arm)\n")
    known = set(found.symbols) - {each.name for each in found}
    for each in found:
        assert {symbol.name for symbol in each.symbols if symbol.name != "i"} <= known
        known.add(each.name)
    values = found.values(dict(s1=0.1, s2=0.1, **{"twin.S": 0.1}))
    assert_allclose(np.array(values["upper.T"], float), Loader().at(s1=0.1, s2=0.1, **{"twin.S": 0.1})["upper.T"], rtol=1e-12)
    assert r"\textbf{twin (Arm)} & \notag" in found.latex()
    assert r"L_{AB}^{\mathrm{lower}}" in found.latex()
    assert [each.heading for each in found.sheet() if each.heading] == list(found.headings.values())
    assert not equations(Arm()).headings


class Shaped(Arm):
    """An arm with outlines of each kind."""

    plate = Outline([(-0.1, -0.5), (0.3, -0.5), (0.2, 0.1)])
    skin = Outline([(0.0, 0.0), (0.5, 0.1), (0.2, 0.3)], on="O B")
    eye = Outline.circle((0.1, 0.05), 0.04, on="T")
    ring = Outline.circle("B", radius=0.05)
    floor = Outline.line((-1, -0.6), (1, -0.7))


PLACED = [dict(), dict(at=(1.5, -0.7)), dict(mirrored=True), dict(angle=0.6, at=("k", 1)), dict(mirrored=True, angle=-0.4, at=(2, 0))]


@for_all("on", [False, True])
@for_all("how", PLACED, ids=str)
def test_outlines_stand_where_their_part_stands(how, on):
    if on:
        names, how = ("plate", "skin", "ring", "floor"), {**how, "on": ("o", "q")}
        members = {"p": Part(Shaped, eye=None, **how)}
    else:
        names, members = ("plate", "skin", "eye", "ring", "floor"), {"p": Part(Shaped, **how)}
    base = {"t": Stroke(0, 1), "k": Dimension(1.5), "o": Ground(0.4, 0.1), "q": Crank("o", oq=0.7, angle="t")}
    held = declare(**base, **members)().at(t=0.3, **{"p.S": 0.1})
    alone = Shaped().at(S=0.1)
    # the frame of the part as three of its points say it
    own = np.column_stack([alone["O"], alone["A"], alone["T"]])
    whole = np.column_stack([held["p.O"], held["p.A"], held["p.T"]])
    turned = (whole[:, 1:] - whole[:, :1]) @ np.linalg.inv(own[:, 1:] - own[:, :1])
    for name in names:
        found, expected = corners(held, f"p.{name}"), corners(alone, name)
        expected = whole[:, :1] + turned @ (expected - own[:, :1])
        far = np.abs(found[:, :, None] - expected[:, None]).sum(axis=0).min(axis=0)  # of a circle other corners, of a line the other way
        assert far.max() <= (0.006 if name in ("eye", "ring") else 1e-12)
    if on:
        with pytest.raises(DefinitionError, match=r"eye .* keeps directions of a part that is carried"):
            declare(t=Stroke(0, 1), k=Dimension(1.5), o=Ground(0, 0), q=Crank("o", oq=0.7, angle="t"), p=Part(Shaped, **how))


def corners(motion, name):
    """Return the corners of an outline in the frame [m], shape (2, n)."""
    outline = motion.plan.members[name]
    (line,) = outline.lines(lambda each: float(motion.value(each)))
    places = [motion[each] for each in outline.carriers]
    start = places[0] if places else np.zeros(2)
    along = (places[1] - start) / np.hypot(*(places[1] - start)) if len(places) > 1 else np.array([1.0, 0.0])
    return start[:, None] + np.column_stack([along, [-along[1], along[0]]]) @ line.T


class Two(Mechanism):
    """Two loaders, one opposite the other."""

    left = Part(Loader)
    right = Part(Loader, at=(5, 1), mirrored=True)


def test_the_bodies_of_a_part_are_of_one_colour_family():
    swept = {"left.s1": STROKES, "left.s2": 0.1, "left.twin.S": 0.1, "right.s1": 0.1, "right.s2": 0.1, "right.twin.S": 0.1}
    scene = Scene(Two().at(**swept))
    families = {"left": set(), "right": set()}
    for points, colour in zip(scene.bodies, scene.colours, strict=True):
        families[style.part_of_points(points)].add(colour)
    assert families == {"left": {1, 10}, "right": {4, 11}}
    assert Scene(Loader().at(**POSES)).colours == [0, 1, 2]  # parts of one body each: as the bodies of any machine
    assert scene.letters["left.lower.B"] != scene.letters["right.lower.B"]
    assert len(set(scene.letters.values())) == len(scene.letters) == len(scene.places)
    assert not Scene(Loader().at(**POSES)).letters


@pytest.mark.parametrize("sight", SIGHT)
def test_families_of_colours_can_be_told_apart(sight):
    families = [style.PALETTE[place] for place in (*style.FAMILIES, *range(len(style.BODIES), len(style.PALETTE)))]
    seen = [lab(colour, sight) for colour in families]
    least = min(ciede2000(one, other) for place, one in enumerate(seen) for other in seen[:place])
    assert least >= (10.9 if sight == "normal" else 6.1)
    assert min(contrast(style.INK, colour) for colour in families) > 4.5


def test_no_two_things_of_parts_have_one_text():
    class Named(Mechanism):
        S = Stroke(0, 0.3)
        O_B, B, A = Ground(0, 0), Ground(0.5, 0), Ground(0.1, -0.4)
        P = Dyad(A, O_B, AP=0.45 + S, O_BP=0.4, side=RIGHT)
        n = distance(O_B, P)

    class Both(Mechanism):
        left = Part(Named)
        left_O = Part(Named, at=(1, 0))
        n = distance("left.O_B", "left_O.B")

    found = equations(Both())
    texts = [each.name for each in found] + [symbol for symbol in found.symbols if symbol not in {each.name for each in found}]
    assert len(set(texts)) == len(texts)
    shown = [each.latex(found._listing.names.latex).partition("&=")[0] for each in found]
    assert len(set(shown)) == len(shown)
    assert "x_left_O.B" in texts  # the number given, in the part's axes; left_O.B_x is where the point stands
    values = found.values({"left.S": 0.1, "left_O.S": 0.2})
    assert_allclose(float(values["n"]), 1.5)


def test_files_say_dotted_names_with_quotes_or_without(tmp_path):
    (tmp_path / "pair.toml").write_text(to_toml(Loader()))
    (tmp_path / "two.toml").write_text("""
name = "Two"
[strokes]
q = [0, 0.3]
[parts]
a = { machine = "pair.toml", s1 = "q", lower.ram.bore = "90 mm" }
b = { machine = "pair.toml", s1 = "q", "lower.ram.bore" = "95 mm", at = [5, 0], mirrored = true }
[over]
o = { q = [0.1, 0.2], a.s2 = 0.1, "b.s2" = 0.1, b.twin.S = 0.2 }
""")
    machine = load(tmp_path / "two.toml")
    assert machine()["a.lower.ram.bore"] == 0.09
    assert machine()["b.lower.ram.bore"] == 0.095
    assert machine.plan.of_kind(Over)["o"].strokes["b.twin.S"] == 0.2
    again = load(to_toml(machine))
    poses = {"q": 0.1, "a.s2": 0.1, "b.s2": 0.05, "a.twin.S": 0.1, "b.twin.S": 0.2}
    assert_array_equal(again().at(**poses)["b.upper.T"], machine().at(**poses)["b.upper.T"])


@pytest.mark.slow
def test_a_stroke_may_leave_a_column_without_a_number(tmp_path):
    export(Loader(), tmp_path / "pair.xlsx", at={"s2": 0.1, "twin.S": 0.1}, count=3)
    assert (tmp_path / "pair.xlsx").stat().st_size > 10_000


def test_a_name_that_places_a_part_is_refused_as_a_keyword():
    named = type("Named", (Arm,), {"angle": angle("O", "B")})
    assert declare(p=Part(named)).plan.members["p.angle"] is not None
    with pytest.raises(DefinitionError, match=r'angle places a part, and is a quantity of Named, too.*lower\["angle"\]'):
        Part(named, angle=0.5)


def test_a_link_carries_a_part():
    class Carrying(Mechanism):
        a = Part(Arm)
        p = Part(Arm, on="a.arm", O="a.T", A=(0.5, 0.1))

    motion = Carrying().at(**{"a.S": 0.1, "p.S": 0.1})
    O, B, A = motion["a.O"], motion["a.B"], motion["p.A"]
    along = (B - O) / np.hypot(*(B - O))
    assert_allclose(A, O + 0.5 * along + 0.1 * np.array([-along[1], along[0]]), rtol=1e-13)


def test_eight_deep_works():
    deep = Deep.of(8)
    name = "p." * 8
    assert_array_equal(deep().at(**{f"{name}S": 0.1})[f"{name}T"], Arm().at(S=0.1)["T"])


def test_strokes_of_parts_are_spelled_as_python_takes_them():
    """Where a machine runs, and what a remedy says, can be pasted: a name with a dot stands in a mapping."""

    class Runs(Mechanism):
        lower = Part(Arm)
        upper = Part(Arm, at=(3, 0))
        lifting = Over.path(**{"lower.S": [0.0, 0.2], "upper.S": 0.1})

    [over] = Runs().overs
    assert str(over) == "Over.path(**{'lower.S': (0.0, 0.2), 'upper.S': 0.1})"
    assert str(eval(str(over), {"Over": Over})) == str(over)
    with pytest.raises(DefinitionError, match=re.escape("sweep(**{'lower.S': ..., 'upper.S': ...})")):
        Runs().sweep(5)
    with pytest.raises(DefinitionError, match=re.escape("at(**{'lower.S': ...}) or at(**{'upper.S': ...})")):
        Runs().at(0.1)
    again = load(to_toml(Runs()))()
    assert [str(each) for each in again.overs] == [str(over)]


def test_a_cylinder_between_two_parts_is_told_by_both():
    class Joined(Mechanism):
        s = Stroke(0.0, 0.1)
        lower = Part(Arm, S=s, load=None, ram=None, pump=None)
        other = Part(Arm, S=s, at=(1.5, 0), mirrored=True, load=None, ram=None, pump=None)
        tie = Cylinder(lower.T, other.T, bore=80 * mm, rod=40 * mm, closed=0.1, stroke=0.01)
        drain, line = Tank(), OilLine("tie", "drain")

    assert any("lower.T other.T goes from" in verdict for verdict in Joined().verdicts())


def test_a_part_of_a_part_keeps_the_names_it_is_given():
    """A fixed point of the inner part may go by the letter of a point of the outer one."""

    class Outer(Mechanism):
        S = Stroke(0, 0.3)
        O, A = Ground(0, 0), Ground(0.1, -0.4)
        B = Dyad(A, O, AB=0.45 + S, OB=0.4, side=RIGHT)
        inner = Part(Arm, on=(O, B), O=B, A=(0.1, 0.3))

    class Whole(Mechanism):
        p = Part(Outer, at=(1, 2), mirrored=True)

    alone, held = Outer().at(**{"S": 0.1, "inner.S": 0.1}), Whole().at(**{"p.S": 0.1, "p.inner.S": 0.1})
    for name in ("B", "inner.A", "inner.T"):
        x, y = np.ravel(alone[name])
        assert_allclose(np.ravel(held[f"p.{name}"]), (1 - x, 2 + y), atol=1e-14)


def test_what_a_part_says_of_its_own_fixed_points_follows_nothing_that_carries_it():
    """A crank's angle and length out of x(O): cylinders take over its stroke, wherever the part hangs."""

    class Lever(Mechanism):
        turn = Stroke(0.2, 1.2)
        O, E = Ground(0.1, 0.2), Ground(0.5, 0.0)
        C = Crank(O, OC=0.3 + 0.1 * x(O), angle=turn + 0.8 * x(O))
        load = Weight(C, mass=50)
        ram = Cylinder(E, C, bore=50 * mm, rod=28 * mm)
        pump = LiftCircuit(ram, pressure=200 * bar)

    class Hung(Mechanism):
        q = Stroke(-0.5, 0.5)
        P = Ground(0.0, 0.0)
        Q = Crank(P, PQ=1.0, angle=q)
        lever = Part(Lever, on=(P, Q))

    forces = pin_forces(Hung().at(**{"q": 0.0, "lever.turn": 0.7}))
    assert_allclose(forces.thrusts["lever.ram"], pin_forces(Lever().at(turn=0.7)).thrusts["ram"], rtol=1e-12)
    assert np.max(forces.residual) < 1e-12


def test_a_point_that_two_parts_share_is_known_by_both_names_next_to_a_dead_point():
    class Lever(Mechanism):
        """A lever whose cylinder comes into line with it."""

        S = Stroke(0.3, 0.5)
        O, A = Ground(0.0, 0.0), Ground(0.5, 0.0)
        B = Dyad(A, O, AB=S, OB=0.2, side=RIGHT)
        T = OnLink(O, B, OT=0.6, BOT=10 * deg)

    class Two(Mechanism):
        """Two levers on one pin."""

        S = Stroke(0.3, 0.5)
        first = Part(Lever, S=S)
        other = Part(Lever, S=S, O=first.O)

    assert_allclose(Two().evaluate([distance("other.O", "other.T")], S=[0.3000001, 0.4])[0], 0.6, rtol=1e-9)
