"""What counts once is not counted twice without a word: loads, frictions, names and titles that stand there a second time."""

import itertools

import pytest
from numpy.testing import assert_allclose

from hydraulics import Accumulator, AccumulatorBlock, Cylinder, FloatCircuit, LiftCircuit
from linkage import LEFT, Crank, DefinitionError, Dimension, Dyad, Ground, Guide, Mechanism, OnLink, SliderDyad, Stroke, ref
from linkage.loads import Force, GuideFriction, Load, LoadCase, PinFriction, Spring, Support, Weight
from linkage.statics import driving_force, pin_forces, reaction
from linkage.units import bar, deg, litre, mm
from tests.for_all import for_all

RAM = dict(bore=63 * mm, rod=36 * mm)


class Lever(Mechanism):
    """A lever OBC that a cylinder AB lifts."""

    S, L0 = Stroke(0.0, 0.2), Dimension(0.45)
    A, O = Ground(0.0, 0.0), Ground(0.1, 0.6)
    B = Dyad(A, O, AB=L0 + S, OB=0.3, side=LEFT)
    C = OnLink(O, B, OC=0.9)
    load = Weight(C, mass=100)


def made(**members):
    """Return a variant of the lever with further members."""
    return type("Made", (Lever,), members)


def bank():
    """Return a block of one vessel."""
    return AccumulatorBlock([Accumulator(2 * litre, 50 * bar)])


class Slides(Mechanism):
    """A slider crank, whose pin runs on one rail."""

    phi = Stroke(20 * deg, 60 * deg)
    O = Ground(0, 0)
    B = Crank(O, OB=0.1, angle=phi)
    rail = Guide((0, 0), angle=0)
    C = SliderDyad(B, rail, BC=0.3, side=LEFT)
    push = Force(C, (-100, 0))


def rubbing(**members):
    """Return a variant of the slider crank with further members."""
    return type("Rubbing", (Slides,), members)


SHARED = bank()
TWICE = [
    (lambda: made(f=PinFriction("O", 20 * mm, 0.1), g=PinFriction("O", 20 * mm, 0.1)), "f and g both are the friction of the pin O"),
    (lambda: rubbing(f=GuideFriction("C", 0.1), g=GuideFriction("C", 0.2)), "f and g both are the friction of C on its guides"),
    (lambda: rubbing(f=GuideFriction("C", 0.1), g=GuideFriction("C", 0.2, "rail")), "f and g both are the friction of C on rail"),
    (lambda: rubbing(f=GuideFriction("C", 0.1, "rail"), g=GuideFriction("C", 0.2)), "f and g both are the friction of C on its guides"),
    (
        lambda: made(
            one=Cylinder("A", "B", **RAM), two=Cylinder("A", "C", **RAM),
            front=FloatCircuit("one", SHARED, charge_pressure=80 * bar), rear=FloatCircuit("two", SHARED, charge_pressure=80 * bar),
        ),
        "front and rear both are given the same block, .* Give each circuit a block of its own",
    ),
    (
        lambda: made(
            one=Cylinder("A", "B", **RAM),
            soft=FloatCircuit("one", bank(), charge_pressure=80 * bar), hard=FloatCircuit("one", bank(), charge_pressure=90 * bar),
        ),
        "soft and hard both feed one, whose thrust would count double",
    ),
    (lambda: made(one=Cylinder("A", "B", **RAM), pump=LiftCircuit(["one", "one"], pressure=180 * bar)), "pump has one twice"),
    (
        lambda: made(
            one=Cylinder("A", "B", **RAM), two=Cylinder("A", "C", **RAM), three=Cylinder("O", "C", **RAM),
            pump=LiftCircuit(["one", "two"], pressure=180 * bar), other=LiftCircuit(["two"], pressure=150 * bar),
        ),
        "(pump and other|other and pump) both have two, but not the same cylinders",
    ),
    (
        lambda: made(f=(one := Cylinder("A", "B", bore=ref("d"), rod=ref("e"))), g=one, d=Dimension(0.05), e=Dimension(0.03)),
        "f and g are one and the same load and would count double",
    ),
    (lambda: made(a=LoadCase("full"), b=LoadCase("full")), "a and b are both called 'full'"),
    (lambda: made(a=LoadCase("b"), b=LoadCase("empty")), "a and b are both called 'b'"),
]  # fmt: skip


@for_all(("make", "words"), TWICE)
def test_a_class_in_which_something_stands_twice_is_refused_by_name(make, words):
    with pytest.raises(DefinitionError, match=words):
        make()


def test_a_cylinder_by_its_name_and_by_itself_is_one():
    with pytest.raises(DefinitionError, match=r"pump has ram twice, .* count=2 in the Cylinder"):

        class Both(Lever):
            ram = Cylinder("A", "B", **RAM)
            pump = LiftCircuit([ram, "ram"], pressure=180 * bar)


def test_two_lines_of_their_own_blocks_are_those_of_one_each():
    """A block each: the thrust of each line is that of the machine in which the other has no gas."""
    rams = dict(one=Cylinder("A", "B", **RAM), two=Cylinder("A", "C", **RAM))
    front = dict(front=FloatCircuit("one", bank(), charge_pressure=80 * bar))
    rear = dict(rear=FloatCircuit("two", bank(), charge_pressure=80 * bar))
    both, (first, second) = made(**rams, **front, **rear), (made(**rams, **front), made(**rams, **rear))
    forces = [driving_force(each().sweep(5), loads) for each, loads in ((first, ["front"]), (second, ["rear"]))]
    assert_allclose(driving_force(both().sweep(5), ["front", "rear"]), forces[0] + forces[1], rtol=1e-13)


def test_pumps_that_are_alternatives_have_the_same_cylinders():
    found = made(ram=Cylinder("A", "B", **RAM), pump=LiftCircuit("ram", pressure=180 * bar), spare=LiftCircuit("ram", pressure=90 * bar))
    motion = found().sweep(5)
    assert_allclose(found.pump.reserve(motion), 2.0 * found.spare.reserve(motion), rtol=1e-14)


@pytest.mark.parametrize("loads", [["load", "load"], ["load", Lever.load], [Lever.load, Lever.load]])
def test_a_load_that_is_given_twice_is_refused(loads):
    motion = Lever().at(S=0.1)
    for ask in (driving_force, pin_forces):
        with pytest.raises(DefinitionError, match=r"Lever: load stands twice among the loads and would count double; .*scale=\{"):
            ask(motion, loads)


def test_a_load_without_a_name_is_one_load_however_often_it_is_given():
    class Own:
        def loads(self, motion):
            return [Load("C", motion["C"] * 0.0)]

    motion = Lever().at(S=0.1)
    for each in (Weight("C", mass=10), Own()):
        with pytest.raises(DefinitionError, match="stands twice among the loads"):
            driving_force(motion, [each, each])


def test_loads_of_one_kind_and_size_are_as_many_as_there_are():
    """Two equal weights, two springs between the same pins: their forces are those of one that is as strong as both."""
    motion = Lever().at(S=0.1)
    assert_allclose(driving_force(motion, [Weight("C", mass=10), Weight("C", mass=10)]), driving_force(motion, [Weight("C", mass=20)]))
    pair = [Spring("A", "C", stiffness=k, free_length=0.2) for k in (1e3, 2e3)]
    one = [Spring("A", "C", stiffness=3e3, free_length=0.2)]
    assert_allclose(driving_force(motion, pair), driving_force(motion, one), rtol=1e-14)
    each_of = [pin_forces(motion, pair).force("C", on=f"Spring AC {k}") for k in (1, 2)]
    assert_allclose(each_of[0] + each_of[1], pin_forces(motion, one).force("C", on="Spring AC"), rtol=1e-12)


def test_two_loads_of_one_name_are_refused():
    class Other(Lever):
        load = Weight("C", mass=300)

    motion = Lever().at(S=0.1)
    with pytest.raises(DefinitionError, match="two of these loads are called load"):
        driving_force(motion, ["load", Other.load])
    assert_allclose(driving_force(motion, [Other.load]), 3.0 * driving_force(motion))


def test_friction_that_is_given_beside_the_machines_own_is_refused():
    motion = made(f=PinFriction("O", 20 * mm, 0.1))().at(S=0.1)
    with pytest.raises(DefinitionError, match=r"f and .* both are the friction of the pin O"):
        driving_force(motion, ["load", "f", PinFriction("O", 20 * mm, 0.1)], direction="extending")


@for_all(
    ("name", "member"),
    [("ram", Cylinder("A", "B", **RAM)), ("pump", LiftCircuit("ram", pressure=180 * bar))],
)
@for_all("factor", [0, 0.5, 2.0])
def test_what_only_holds_is_not_scaled(name, member, factor):
    members = {"ram": Cylinder("A", "B", **RAM), name: member}
    words = rf"scale=\{{'{name}': {factor}\}}: {name} is a {type(member).__name__} .*a factor changes nothing; scale the loads instead"
    with pytest.raises(DefinitionError, match=words):
        made(**members, off=LoadCase("off", scale={name: factor}))
    with pytest.raises(DefinitionError, match=words):
        driving_force(made(**members)().at(S=0.1), case=LoadCase("off", scale={name: factor}))
    assert made(**members, off=LoadCase("off", scale={name: 1.0}))


def test_what_has_a_force_of_its_own_is_scaled():
    """A factor multiplies a line of gas, a spring, the given force of a support and the coefficient of a friction."""
    members = dict(
        ram=Cylinder("A", "B", **RAM), line=FloatCircuit("ram", bank(), charge_pressure=80 * bar), foot=Support("C", (0, 1), force=50.0),
        tie=Spring("A", "C", stiffness=1e3, free_length=0.2),
    )  # fmt: skip
    motion = made(**members)().at(S=0.1)
    for name in ("line", "foot", "tie", "load"):
        alone, twice = (driving_force(motion, [name], case=LoadCase("k", scale={name: factor})) for factor in (1.0, 2.0))
        assert abs(alone) > 1.0
        assert_allclose(twice, 2.0 * alone, rtol=1e-14)
    assert_allclose(reaction(motion, ["load"], "foot"), 100 * 9.80665)
    half, whole = (
        made(rub=PinFriction("O", 20 * mm, coefficient=mu), dry=LoadCase("dry", scale={"rub": factor}))().at(S=0.1)
        for mu, factor in ((0.1, 2.0), (0.2, 1.0))
    )
    assert_allclose(driving_force(half, case="dry", direction="extending"), driving_force(whole, case="dry", direction="extending"))


LINES = {
    "Ground": "P = Ground(1, 0)", "Stroke": "P = Stroke(0, 1)", "Dimension": "P = Dimension(0.3)", "load": 'P = Weight("C", mass=3)',
    "step": 'P = OnLink("O", "B", OP=0.2)', "number": "P = 0.3",
}  # fmt: skip


@for_all(("first", "second"), [pair for pair in itertools.product(LINES, LINES) if pair[0] != "number"])
def test_a_name_that_stands_twice_in_a_class_would_lose_the_first(first, second):
    lines = f"class Twice(Lever):\n    {LINES[first]}\n    {LINES[second]}\n"
    with pytest.raises(DefinitionError, match=r"^Twice: P = .* stands there already, and P = .* would take its place without a word"):
        exec(lines, {**globals(), "Lever": Lever})


def test_a_name_that_stands_twice_is_told_with_the_names_of_the_others():
    with pytest.raises(DefinitionError, match=r"^Twice: P = Weight\(C, mass=3\) stands there already, and P = Weight\(C, mass=4\) would"):

        class Twice(Mechanism):
            O, B = Ground(0, 0), Ground(1, 0)
            C = OnLink(O, B, OC=0.5)
            P = Weight(C, mass=3)
            P = Weight(C, mass=4)


def test_a_name_may_be_free_again_and_a_variant_replaces():
    class Free(Lever):
        P = Ground(1, 0)
        del P
        P = OnLink("O", "B", OP=0.2)

    class Variant(Lever):
        load = Weight("C", mass=300)

    assert not Free.plan.points["P"].is_fixed
    assert_allclose(driving_force(Variant().at(S=0.1)), 3.0 * driving_force(Lever().at(S=0.1)))
