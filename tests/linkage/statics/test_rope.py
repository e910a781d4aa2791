"""Ropes, chains and belts: lengths that are held, pulls that are given, pulleys of a radius."""

import pickle

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    RIGHT,
    AssemblyError,
    Crank,
    DefinitionError,
    Dyad,
    Ground,
    Guide,
    Link,
    LinkMass,
    Mechanism,
    OnGuide,
    OnLink,
    Part,
    Pulley,
    Rope,
    Stroke,
    Weight,
    driving_force,
    least,
    pin_forces,
    tension,
)
from linkage.pictures.scene import Scene
from linkage.units import deg, g0, mm
from tests.extending.readings import DOCUMENTS, Case, equations_say_the_same, marked, numba_says_the_same
from tests.for_all import for_all


class Hoist(Mechanism):
    """A crank whose chain runs over a pulley on it and a pin of the frame, and draws up a hanging arm."""

    S = Stroke(-20 * deg, 40 * deg)
    O, A, R, Q = Ground(0.0, 0.0), Ground(-0.5, 0.8), Ground(2.0, 3.0), Ground(3.2, 2.0)
    B = Crank(O, OB=1.0, angle=S)
    C = OnLink(O, B, OC=1.3, BOC=12 * deg)
    crank = Link(O, B, C)
    sheave = Pulley(C, radius=90 * mm, side=LEFT)
    chain = Rope(A, sheave, R, "D", length=7.6, weights=[1, 1, 2])
    D = Dyad(R, Q, RD=chain.last, QD=1.5, side=RIGHT)
    load, own = Weight(D, mass=100), LinkMass("O B C", mass=40)


STROKES = {"S": np.linspace(-20 * deg, 40 * deg, 7)}


class Winch(Hoist):
    """A winch of constant pull in the place of the hanging arm."""

    D, Q, load = None, None, None
    chain = Rope("A", "sheave", "R", force=2000.0)


def varied(seed):
    """Return a hoist of other dimensions, radius, sense and weights; RD is 1.7 m in the middle of the stroke."""
    rng = np.random.default_rng(seed)
    side, weight, falls = (RIGHT, LEFT)[seed % 2], rng.choice([1.0, 2.0, 3.0]), rng.uniform(1.0, 2.0)
    places = {"A": (-0.5, 0.8) if side is LEFT else (3.0, -1.5), "R": (2.0, 3.0), "Q": (3.2, 2.0)}
    changed = {name: Ground(*(np.array(place) + rng.uniform(-0.15, 0.15, 2))) for name, place in places.items()}
    changed["sheave"] = Pulley("C", radius=rng.uniform(0.02, 0.2), side=side)
    free = type("Free", (Winch,), {**changed, "Q": None, "chain": Rope("A", "sheave", "R", force=1.0, weights=[falls, falls])})
    length = float(free.plan.members["chain"].path(free().at(S=10 * deg))) + 1.7 * weight
    chain, load = Rope("A", "sheave", "R", "D", length=length, weights=[falls, falls, weight]), Weight("D", mass=rng.uniform(50, 200))
    return type("Varied", (Hoist,), {**changed, "chain": chain, "load": load})


def walked(points, radii, senses, weights):
    """Return the length of a rope by complex numbers, tangent by tangent, shape (poses,)."""
    at = [p[0] + 1j * p[1] for p in points]
    ways, total = [], 0.0
    for k, weight in enumerate(weights):
        d, step = at[k + 1] - at[k], senses[k + 1] * radii[k + 1] - senses[k] * radii[k]
        ways.append(d * np.exp(-1j * np.arcsin(step / abs(d))))
        total = total + weight * np.sqrt(abs(d) ** 2 - step**2)
    for k in range(1, len(weights)):
        turn = senses[k] * np.angle(ways[k] / ways[k - 1])
        total = total + weights[k] * radii[k] * (np.mod(turn + np.pi / 2, 2 * np.pi) - np.pi / 2)
    return total


@for_all("seed", range(1), slow=range(1, 5))
def test_the_length_is_kept_and_the_tension_is_its_energy(seed):
    machine = varied(seed)
    chain, motion = machine.plan.members["chain"], machine().at(**STROKES)
    assert_allclose(chain.path(motion), float(machine()["chain.length"]), rtol=1e-12)
    radius, sense = float(machine()["sheave.radius"]), machine.plan.members["sheave"].sense
    by_hand = walked([motion[name] for name in "ACRD"], [0, radius, 0, 0], [0, sense, 0, 0], chain.falls)
    assert_allclose(by_hand, chain.path(motion), rtol=1e-12)
    step, mass = 2e-4, {"D": float(machine()["load.mass"])}
    moved = [machine(**{"chain.length": machine()["chain.length"] + k * step}).at(**STROKES)["D"][1] for k in (-2, -1, 1, 2)]
    slope = mass["D"] * g0 * (moved[0] - 8 * moved[1] + 8 * moved[2] - moved[3]) / (12 * step)
    assert_allclose(chain.tension(motion), -slope, rtol=1e-8, atol=1e-8 * np.abs(slope).max())
    assert_allclose(motion.ratio("D", wrt="chain.length")[1] * mass["D"] * g0, slope, rtol=1e-8, atol=1e-8 * np.abs(slope).max())


@for_all("seed", range(1), slow=range(1, 5))
def test_virtual_work_is_equilibrium(seed):
    machine = varied(seed)
    motion = machine().at(**STROKES)
    forces, wanted = pin_forces(motion), machine.plan.members["chain"].tension(motion)
    assert_allclose(forces.tensions["chain"], wanted, rtol=1e-9, atol=1e-9 * np.abs(wanted).max())
    assert forces.residual < 1e-12 and forces.gap < 1e-12
    assert_allclose(forces.drives["S"], driving_force(motion), rtol=1e-9, atol=1e-9 * np.abs(wanted).max())
    (asked,) = machine().evaluate([tension("chain")], **STROKES)
    assert_allclose(asked, wanted, rtol=1e-9, atol=1e-9 * np.abs(wanted).max())


def test_a_radius_of_nothing_is_a_pin():
    bare = type("Bare", (Hoist,), {"chain": Rope("A", "C", "R", "D", length=7.6, weights=[1, 1, 2]), "sheave": None})
    wanted = bare().at(**STROKES)["D"]
    off = [np.abs(Hoist(**{"sheave.radius": radius}).at(**STROKES)["D"] - wanted).max() for radius in (1e-3, 1e-6, 0.0)]
    assert off[0] < 5e-3 and off[1] < 5e-6 and off[2] < 1e-14


class Tackle(Mechanism):
    """A load on a block of four falls, drawn by a winch: the block hangs under the beam, the rope comes back to it three times."""

    W = Stroke(5.0, 9.0)
    top, low = Ground(0.0, 4.0), Ground(0.0, -1.0)
    rope = Rope(top, "hook", weights=[4], length="W")
    rail = Guide(top, angle=-90 * deg)
    hook = OnGuide(rail, at=rope.last)
    load = Weight(hook, mass=800)


def test_block_and_tackle_by_hand():
    motion = Tackle().sweep(5)
    assert_allclose(motion["hook"][1], 4.0 - motion.strokes["W"] / 4, rtol=1e-14)
    assert_allclose(Tackle.rope.tension(motion), 800 * g0 / 4, rtol=1e-13)
    assert_allclose(driving_force(motion), -800 * g0 / 4, rtol=1e-13)
    forces = pin_forces(motion)
    assert_allclose(forces.drives["W"], -800 * g0 / 4, rtol=1e-12)
    assert_allclose(forces.tensions["rope"], 800 * g0 / 4, rtol=1e-12)


class Atwood(Mechanism):
    """Two masses on one rope over two pins, one of them driven."""

    S = Stroke(0.5, 1.5)
    P, Q = Ground(0.0, 3.0), Ground(1.0, 3.0)
    left, right = Guide(P, angle=-90 * deg), Guide(Q, angle=-90 * deg)
    A = OnGuide(left, at=S)
    rope = Rope(A, P, Q, "B", length=3.0)
    B = OnGuide(right, at=rope.last)
    one, other = Weight(A, mass=30), Weight(B, mass=50)


def test_a_rope_that_is_shorter_than_its_run_reaches_no_pose():
    class Held(Atwood):
        """The driven mass draws the other one up to the pin Q, and not beyond."""

        S = Stroke(0.5, 2.6)

    with pytest.raises(AssemblyError, match=r"the length rope.last = -0.25 m is negative. .* It goes from S = 500 to 2000 mm"):
        Held().at(S=[0.5, 2.25])
    with pytest.raises(AssemblyError, match=r"the length rope.last = -0.25 m is negative"):
        Tackle().at(W=-1.0)
    fault = next(each for each in Held().verdicts() if each.rule == "assembly")
    assert not fault.ok and "the length rope.last = -0.6 m is negative" in fault


def test_two_masses_on_one_rope():
    motion = Atwood().sweep(3)
    assert_allclose(motion["B"][1], 3.0 - (3.0 - 1.0 - motion.strokes["S"]), rtol=1e-14)
    assert_allclose(Atwood.rope.tension(motion), 50 * g0, rtol=1e-13)
    assert_allclose(driving_force(motion), 20 * g0, rtol=1e-12)  # down where the lighter one hangs, which the drive pushes down


@for_all("seed", range(1), slow=range(1, 3))
def test_a_given_pull_does_its_work_on_the_path(seed):
    rng = np.random.default_rng(seed)
    falls = rng.uniform(1, 2)
    machine = type("Pulled", (Winch,), {"chain": Rope("A", "sheave", "R", force=rng.uniform(500, 3000), weights=[falls, falls])})
    motion, chain = machine().at(**STROKES), machine.plan.members["chain"]
    step = 1e-4
    paths = [chain.path(machine().at(S=STROKES["S"] + k * step)) for k in (-2, -1, 1, 2)]
    slope = (paths[0] - 8 * paths[1] + 8 * paths[2] - paths[3]) / (12 * step)
    own = driving_force(motion, ["own"])
    assert_allclose(driving_force(motion) - own, chain.force * slope, rtol=1e-8)
    assert_allclose(chain.tension(motion), chain.force)
    assert pin_forces(motion).residual < 1e-12


class Pair(Mechanism):
    """A hoist and its mirror image."""

    s = Stroke(-20 * deg, 40 * deg)
    one = Part(Hoist, S=s)
    other = Part(Hoist, S=s, mirrored=True, at=(0.0, 1.0))


def test_a_mirrored_part_wraps_the_other_way():
    motion, alone = Pair().at(s=STROKES["S"]), Hoist().at(**STROKES)
    assert_allclose(motion["one.D"], alone["D"], rtol=1e-14)
    assert_allclose(motion["other.D"], alone["D"] * [[-1.0], [1.0]] + [[0.0], [1.0]], rtol=1e-13)
    wanted = Hoist.chain.tension(alone)
    for name in ("one.chain", "other.chain"):
        assert_allclose(Pair.plan.members[name].tension(motion), wanted, rtol=1e-12)
        assert_allclose(pin_forces(motion).tensions[name], wanted, rtol=1e-9)


class Sledge(Mechanism):
    """A sledge that one rope draws to the right and another one back, both over pins that are driven along its track."""

    S = Stroke(0.2, 0.8)
    O = Ground(0.0, 0.0)
    rail = Guide(O, angle=20 * deg)
    B = OnGuide(rail, at=1.0 + S)
    A, E = Ground(0.0, 0.0), Ground(3.0 * np.cos(20 * deg), 3.0 * np.sin(20 * deg))
    out = Rope(A, B, "D", length=2.5, weights=[1, 2])
    D = OnGuide(rail, at=1.0 + S - out.last)
    Z = OnGuide(rail, at=0.2 + S)
    back = Rope(E, Z, D, against=out, weights=[2, 4])
    push = Weight(D, mass=60, gravity=(-12.0, 0.0))


def test_a_rope_draws_back_against_another_one():
    """Each pulls where the load asks for it; what both do is the multiplier of the one length."""

    class Forward(Sledge):
        push = Weight("D", mass=60, gravity=(12.0, 0.0))

    for machine, pulls, rests, share in ((Sledge, "out", "back", 1.0), (Forward, "back", "out", 0.5)):
        motion = machine().sweep(3)
        forces, tensions = pin_forces(motion), {name: machine.plan.members[name].tension(motion) for name in ("out", "back")}
        for name, tension_of in tensions.items():
            assert_allclose(forces.tensions[name], tension_of, rtol=1e-9)
        assert_allclose(tensions[rests], 0.0)
        assert_allclose(tensions[pulls], share * 60 * 12.0 * np.cos(20 * deg) / 2, rtol=1e-12)
        assert forces.residual < 1e-12 and forces.gap < 1e-12
        assert all(each.ok is not False for each in machine().verdicts() if "tension" in str(each))


def test_a_drawn_rope_touches_its_pulleys():
    scene, radius = Scene(Hoist().at(**STROKES)), 0.09
    marks = [mark for mark in scene.ropes if "C" in mark.on]
    assert len(marks) == 2
    for at in scene.some(5):
        for start, end in (mark.drawn(at)[0] for mark in marks):
            along, arm = (end - start) / np.hypot(*(end - start)), at["C"] - start
            assert along[0] * arm[1] - along[1] * arm[0] == pytest.approx(radius, rel=2e-2)
            assert min(np.hypot(*(each - at["C"])) for each in (start, end)) == pytest.approx(radius, rel=2e-2)
    assert not [each for each in scene.cylinders if {each.P, each.Q} == {"R", "D"}]


def test_it_goes_through_pickle():
    again = pickle.loads(pickle.dumps(Hoist()))
    assert np.array_equal(again.at(**STROKES)["D"], Hoist().at(**STROKES)["D"])


def test_a_slack_rope_fails_like_a_contact_that_lifts_off():
    class Pushed(Hoist):
        load = Weight("D", mass=100, gravity=(0.0, 9.8))

    failed = [str(each) for each in Pushed().verdicts() if "slack" in str(each)]
    assert len(failed) == 1 and failed[0].startswith("FAIL tension: goes slack at S = ") and "the constraint is not kept" in failed[0]
    worst = Pushed().answers([least(tension("chain"))])[0]
    assert float(worst.value) < 0.0
    assert any("chain goes slack" in each for each in pin_forces(Pushed().at(**STROKES)).remarks)
    assert all("slack" not in str(each) for each in Hoist().verdicts())
    for kept in (Hoist(), Hoist(**{"load.mass": 0.01})):  # a tenth of a newton holds as well
        (taut,) = (each for each in kept.verdicts() if str(each).startswith("ok   tension: it stays taut"))
        assert taut.answer.ok


def test_a_rope_that_leaves_its_pulley_is_told():
    class Off(Hoist):
        sheave = Pulley("C", radius=90 * mm, side=RIGHT)

    assert any("it leaves the pulley" in str(each) for each in Off().verdicts())


def test_what_cannot_be_is_said_with_the_remedy():
    wrong = {
        "ends on the pulley sheave": dict(chain=Rope("A", "R", "sheave", force=1.0)),
        "nothing says how long it is; add length=": dict(chain=Rope("A", "sheave", "R", "D")),
        "its force is given, so that it gives no length": dict(chain=Rope("A", "sheave", "R", "D", force=100.0)),
        "1 falls come to the pulley sheave and 2 leave it": dict(chain=Rope("A", "sheave", "R", "D", length=6.9, weights=[1, 2, 2])),
        "runs from R to R": dict(chain=Rope("A", "R", "R", "D", length=6.9)),
        "'sheaf' is unknown": dict(chain=Rope("A", "sheaf", "R", "D", length=6.9)),
        "how far it lies on sheave hangs on where": dict(chain=Rope("A", "R", "sheave", "D", length=6.9)),
    }
    for words, members in wrong.items():
        with pytest.raises(DefinitionError, match=words):
            type("Wrong", (Winch if "D" not in members["chain"].run else Hoist,), members)
    for words, call in {
        "leave one out": lambda: Rope("A", "B", length=1.0, force=2.0),
        "1 numbers above zero are expected": lambda: Rope("A", "B", weights=[1, 2]),
        "numbers are expected, one a part": lambda: Rope("A", "B", weights=2.0),
        "it runs from one to another one": lambda: Rope("A"),
        "say side=LEFT": lambda: Pulley("A", radius=0.1, side="up"),
        "negative": lambda: Pulley("A", radius=-0.1, side=LEFT),
    }.items():
        with pytest.raises(DefinitionError, match=words):
            call()

    class Locked(Hoist):
        other = Rope("A", "B", "D", length=5.0)

    with pytest.raises(DefinitionError, match=r"other locks the machine: .* Let a step follow it, such as Dyad\(U, P, UW=other.last\)"):
        Locked.other.tension(Locked().at(**STROKES))


CASE = Case(
    Hoist(), STROKES, points=["D"], forces=[tension("chain")], variables=["chain.length", "sheave.radius", "R.x", "QD"], drives=["S"],
    kinds=[],
)  # fmt: skip


@pytest.mark.parametrize("read", marked(numba_says_the_same, equations_say_the_same, *DOCUMENTS))
def test_readings_agree(read, tmp_path):
    read(CASE, tmp_path)
