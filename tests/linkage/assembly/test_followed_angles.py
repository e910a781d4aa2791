"""Angles whose whole turns count: followed from the sketch, the same at a pose whatever else is asked, or refused by name."""

from importlib.util import find_spec
from math import pi

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    RIGHT,
    AssemblyError,
    Crank,
    DefinitionError,
    Dimension,
    Dyad,
    Force,
    Ground,
    Guide,
    Link,
    Mechanism,
    OnGuide,
    OnLink,
    Pin,
    SingularError,
    Stroke,
    Weight,
    angle,
    drawn,
    driving_force,
    ratio,
    ref,
    x,
    y,
)
from linkage.errors import unwarned

FINE = 3000  # poses each way from the sketch by which the reference is unwrapped


class DragLink(Mechanism):
    """Both cranks turn fully, and so does the coupler; a pointer turns by seven tenths of it."""

    phi = Stroke(0.0, 4.0 * pi)
    A, O, D = Ground(0.0, 0.0), Ground(0.1, 0.0), Ground(1.0, 0.3)
    B = Crank(A, AB=0.4, angle=phi)
    C = Dyad(B, O, BC=0.45, OC=0.4, side=LEFT)
    E = Crank(D, DE=0.2, angle=-0.7 * angle(C, B))
    turn = angle(C, B)


def test_seven_tenths_of_a_direction_do_not_jump():
    motion = DragLink().sweep(800)
    assert DragLink.plan.followed == ("angle(C, B)",)
    assert np.hypot(*np.diff(motion["E"], axis=1)).max() < 0.01
    assert_allclose(motion["turn"][-1] - motion["turn"][0], 4.0 * pi, rtol=1e-12)
    turn = -0.7 * motion["turn"]
    assert_allclose(motion["E"], [1.0 + 0.2 * np.cos(turn), 0.3 + 0.2 * np.sin(turn)], atol=1e-15)
    assert_allclose(motion.ratio("E"), motion.ratio("E", method="central"), atol=1e-9)
    assert_allclose(motion.ratio("E", order=2), motion.ratio("E", order=2, method="central"), atol=1e-6)


def test_what_comes_back_after_a_turn_is_not_followed():
    w, phi = angle("C", "B"), DragLink.phi
    for given in (w, 2 * w, -3 * w + 0.7, w + phi, np.arctan2(np.sin(0.5 * phi), 1.0), np.cos(w), 0.2 * np.sin(2 * w), (w + w) / 2):
        made = type("Periodic", (DragLink,), {"E": Crank("D", DE=0.2, angle=given)})
        assert made.plan.followed == (), given
    for given in (0.5 * w, w / 3, w * w, np.exp(0.1 * w), np.cos(w / 2), np.absolute(w), phi * w):
        made = type("Counting", (DragLink,), {"E": Crank("D", DE=0.2, angle=given)})
        assert made.plan.followed == ("angle(C, B)",), given


class Four:
    """A random four-bar, how something hangs on a direction in it, and where that is by a reference of its own."""

    def __init__(self, seed):
        self.random = random = np.random.default_rng(seed)
        self.members = {}
        while not self.members:
            self._draw(random)
        self.P, self.Q = (str(each) for each in random.choice(["CB", "OC", "AC", "BO", "XC"]))
        self.use = str(random.choice(list(USES)))
        self.k = float(random.uniform(-1.6, 1.6))
        followed = angle(self.P, self.Q)
        if random.random() < 0.2:
            followed = np.arctan2(y(self.Q) - y(self.P), x(self.Q) - x(self.P))
        self.step, self.rule = USES[self.use](followed, self.k)
        self.machine = type(f"Four{seed}", (Mechanism,), {**self.members, **FIXED, "E": self.step})
        self.plain = type(f"Plain{seed}", (Mechanism,), dict(self.members))

    def _draw(self, random):
        """Draw lengths, a range of the crank that can be reached, and a sketch in it."""
        lengths = random.uniform(0.2, 1.0, 4)
        if random.random() < 0.7:  # a short base: all links turn fully
            lengths[0] = random.uniform(0.05, 0.2)
        side, start = (LEFT, RIGHT)[int(random.integers(2))], random.uniform(-pi, pi)
        members = {
            "phi": Stroke(start, start + 4.0 * pi),
            "A": Ground(0.0, 0.0),
            "O": Ground(float(lengths[0]), 0.0),
            "B": Crank("A", AB=float(lengths[1]), angle=ref("phi")),
            "C": Dyad("B", "O", BC=float(lengths[2]), OC=float(lengths[3]), side=side),
            "X": OnLink("B", "C", BX=float(random.uniform(0.1, 0.6)), CBX=float(random.uniform(0.3, 2.5)), side=LEFT),
        }
        at = start + np.linspace(0.0, 4.0 * pi, 401)
        plain = type("Drawn", (Mechanism,), members)()
        with np.errstate(invalid="ignore"):
            good = np.abs(np.broadcast_to(plain.at(phi=at, unreachable="nan")._loop_sines["C"], at.shape)) > 0.05
        first = int(np.argmax(good))
        last = first + int(np.argmin(np.append(good[first:], False))) - 1
        if last - first < 40:
            return
        members["phi"] = Stroke(float(at[first]), float(at[last]))
        share = float(random.choice([0.0, 1.0, random.uniform(0.0, 1.0)]))
        self.sketch = float(at[first] + share * (at[last] - at[first]))
        self.members = {**members, "sketch": drawn(phi=self.sketch)}

    def reference(self):
        """Return poses (2 FINE + 1,) in order and the place of E there, by a direction unwrapped from the sketch both ways."""
        stroke = self.members["phi"]
        below, above = np.linspace(self.sketch, stroke.start, FINE + 1), np.linspace(self.sketch, stroke.end, FINE + 1)
        turns = []
        for at in (below, above):
            found = self.plain().at(phi=at)
            v = found[self.Q] - found[self.P]
            turns.append(np.unwrap(np.arctan2(v[1], v[0])))
        assert max(np.abs(np.diff(each)).max() for each in turns) < 0.5
        at, turned = np.append(below[:0:-1], above), np.append(turns[0][:0:-1], turns[1])
        return at, self.rule(turned)


def pointer(turn):
    """Return where a crank of 0.2 m at D stands."""
    return np.array([1.0 + 0.2 * np.cos(turn), 0.5 + 0.2 * np.sin(turn)])


FIXED = {"D": Ground(1.0, 0.5), "rail": Guide((0.0, -1.0), angle=0.0), "none": Dimension(0.0)}
USES = {
    "a part": lambda w, k: (Crank("D", DE=0.2, angle=k * w), lambda turn: pointer(k * turn)),
    "a product": lambda w, k: (Crank("D", DE=0.2, angle=k * w * w), lambda turn: pointer(k * turn * turn)),
    "a function": lambda w, k: (Crank("D", DE=0.2, angle=np.exp(0.2 * k * w)), lambda turn: pointer(np.exp(0.2 * k * turn))),
    "a drum": lambda w, k: (
        OnGuide("rail", at=0.3 + 0.1 * k * w),
        lambda turn: np.array([0.3 + 0.1 * k * turn, np.full(turn.shape, -1.0)]),
    ),
    "a length": lambda w, k: (
        Crank("D", DE=2.0 + 0.1 * np.cos(0.5 * w), angle=ref("none")),
        lambda turn: np.array([3.0 + 0.1 * np.cos(0.5 * turn), np.full(turn.shape, 0.5)]),
    ),
}


def followed_at_random(seeds):
    """Check random four-bars; return how many poses were tried, and in how many of the classes the arc tangent jumps on the way."""
    tried = jumped = 0
    for seed in seeds:
        four = Four(seed)
        at, wanted = four.reference()
        machine, random = four.machine(), four.random
        assert len(four.machine.plan.followed) == 1
        size = dict(rtol=0.0, atol=1e-9)
        every = machine.at(phi=at)["E"]
        assert_allclose(every, wanted, **size)
        some = random.permutation(len(at))[:60]
        assert_allclose(machine.at(phi=at[some])["E"], wanted[:, some], **size)
        assert_allclose(np.array([machine.at(phi=at[each])["E"] for each in some[:20]]).T, every[:, some[:20]], rtol=0.0, atol=1e-12)
        function = machine.function(["E", ratio("E")])
        (values,) = machine.evaluate(["E"], phi=at[some], backend="numpy")
        (others,) = machine.evaluate(["E"], phi=at[some], backend="floats")
        alone = np.array([function(float(at[each])) for each in some[:20]])
        assert_allclose(values, wanted[:, some], **size)
        assert_allclose(others, wanted[:, some], **size)
        assert_allclose(alone[:, :2].T, wanted[:, some[:20]], **size)
        assert_allclose(alone[:, 2:].T, machine.at(phi=at[some[:20]]).ratio("E"), rtol=1e-9, atol=1e-9)
        for count in (2, 7, 50):
            motion = machine.sweep(count)
            near = np.array([np.interp(motion.strokes["phi"], at, part) for part in wanted])
            assert_allclose(motion["E"], near, rtol=0.0, atol=1e-3)
        tried, jumped = tried + len(at), jumped + jumps(four, at)
    return tried, jumped


def jumps(four, at):
    """Return whether the arc tangent jumps on the way."""
    motion = four.plain().at(phi=at)
    v = motion[four.Q] - motion[four.P]
    return bool(np.abs(np.diff(np.arctan2(v[1], v[0]))).max() > pi)


def test_random_directions_are_followed_from_the_sketch():
    _, jumped = followed_at_random(range(5))
    assert jumped >= 2


@pytest.mark.slow
def test_many_random_directions_are_followed_from_the_sketch():
    _, jumped = followed_at_random(range(1000, 1400))
    assert jumped >= 150


def test_the_sketch_tells_from_where():
    """Started behind a full turn the direction is read between -180 and 180 deg there."""
    later = type("Later", (DragLink,), {"sketch": drawn(phi=2.0 * pi)})
    assert_allclose(later().at(phi=2.0 * pi)["E"], DragLink().at(phi=0.0)["E"], atol=1e-12)
    assert_allclose(later().at(phi=0.0)["turn"], DragLink().at(phi=0.0)["turn"] - 2.0 * pi, atol=1e-12)


def test_at_180_deg_in_the_sketch_rounding_does_not_choose():
    for tiny in (0.0, 1e-17, -1e-17, 1e-12, -1e-12):
        class Left(Mechanism):
            """A crank that points to the left at the start."""

            phi = Stroke(pi + tiny, pi + 1.0)
            A, D = Ground(0.0, 0.0), Ground(1.0, 0.0)
            B = Crank(A, AB=0.3, angle=phi)
            E = Crank(D, DE=0.2, angle=0.5 * angle(A, B))

        assert_allclose(Left().at(phi=pi + tiny)["E"], [1.0, 0.2], atol=1e-9)


def test_designs_and_strokes_as_a_grid():
    sides = np.linspace(0.43, 0.47, 4)
    batch = DragLink(BC=sides).sweep(60)
    for place, side in enumerate(sides):
        assert_allclose(batch["E"][:, place], DragLink(BC=side).sweep(60)["E"], atol=1e-15)
    assert_allclose(batch.gradient("E", wrt=["BC"])[0], gradient_by_differences(sides), atol=1e-6)


def gradient_by_differences(sides, h=1e-6):
    """Return dE/dBC by differences of designs."""
    up, down = DragLink(BC=sides + h).sweep(60)["E"], DragLink(BC=sides - h).sweep(60)["E"]
    return (up - down) / (2 * h)


def test_one_followed_angle_hangs_on_another():
    class Chain(DragLink):
        """A second pointer turns by a part of the first one's direction."""

        H = Ground(-1.0, 0.0)
        F = Crank(H, HF=0.3, angle=0.4 * angle("D", "E"))

    at = np.linspace(0.0, 4.0 * pi, 4001)
    motion = Chain().at(phi=at)
    assert Chain.plan.followed == ("angle(C, B)", "angle(D, E)")
    first = np.arctan2(*(motion["E"] - [[1.0], [0.3]])[::-1])
    wanted = 0.4 * np.unwrap(first)
    assert_allclose(motion["F"], [-1.0 + 0.3 * np.cos(wanted), 0.3 * np.sin(wanted)], atol=1e-12)
    assert_allclose(Chain().at(phi=at[::-500])["F"], motion["F"][:, ::-500], rtol=0.0, atol=1e-15)


def test_several_strokes_are_followed_along_straight_lines():
    class Arm(Mechanism):
        """Two cranks on each other; a pointer turns by a third of where the second one's end is seen."""

        p, q = Stroke(0.0, 5.0), Stroke(0.0, 3.0)
        A, D = Ground(0.0, 0.0), Ground(2.0, 0.3)
        B = Crank(A, AB=0.5, angle=p)
        C = Crank(B, BC=0.2, angle=p + 2 * q)
        E = Crank(D, DE=0.2, angle=angle(A, C) / 3)

    motion = Arm().sweep(p=12, q=11)
    for p, q in ((2.0, 3.0), (5.0, 1.2), (4.1, 0.0)):
        line = np.linspace(0.0, 1.0, 1001)
        along = Arm().at(p=p * line, q=q * line)
        turn = np.unwrap(np.arctan2(along.y("C"), along.x("C"))) / 3
        wanted = [2.0 + 0.2 * np.cos(turn), 0.3 + 0.2 * np.sin(turn)]
        assert_allclose(along["E"], wanted, atol=1e-12)
        assert_allclose(Arm().at(p=p, q=q)["E"], along["E"][:, -1], atol=1e-15)
    assert np.hypot(*np.diff(motion["E"], axis=-1)).max() < 0.1
    assert np.hypot(*np.diff(motion["E"], axis=-2)).max() < 0.1


class Plane(Mechanism):
    """A point anywhere in the plane, and a pointer that shows half of its direction from the origin."""

    u, v = Stroke(1.0, 3.0), Stroke(-2.0, 2.0)
    A, D = Ground(0.0, 0.0), Ground(5.0, 0.0)
    floor = Guide((0.0, 0.0), angle=0.0)
    B = OnGuide(floor, at=u)
    mast = Guide(B, angle=pi / 2)
    C = OnGuide(mast, at=v)
    E = Crank(D, DE=0.2, angle=0.5 * angle(A, C))
    sketch = drawn(u=1.0, v=0.0)


def test_ways_on_either_side_of_where_the_ends_meet_are_told():
    there = {"u": [-0.5, -0.5], "v": [0.5, -0.5]}
    up, down = (Plane().at(u=-0.5, v=each)["E"] for each in (0.5, -0.5))
    assert np.hypot(*(up - down)) > 0.25
    (values,) = Plane().evaluate(["E"], **there)
    assert_allclose(values, np.transpose([up, down]), atol=1e-15)
    with pytest.raises(SingularError, match=r"angle\(A, C\), whose whole turns count here, .* on either side"):
        Plane().at(**there)
    u, v = np.meshgrid(np.linspace(-1.0, 1.0, 21), np.linspace(-0.95, 0.97, 20))
    with pytest.raises(SingularError, match="so that a turn lies between them"):
        Plane().at(u=u, v=v)
    right = Plane().at(u=np.abs(u) + 0.01, v=v)
    turn = 0.5 * np.arctan2(right.y("C"), right.x("C"))
    assert_allclose(right["E"], [5.0 + 0.2 * np.cos(turn), 0.2 * np.sin(turn)], atol=1e-12)
    round_the_corner = Plane().at(u=[-0.5, 0.5, 0.5], v=[0.5, 0.5, -0.5])
    assert_allclose(round_the_corner["E"][:, 0], up, atol=1e-15)


def test_a_load_of_the_class_follows_its_angle():
    class Wound(DragLink):
        """A rope that is wound up by the coupler grows heavier."""

        load = Weight("C", mass=10.0 + ref("turn"))

    poses = np.linspace(0.0, 4.0 * pi, 50)
    together = driving_force(Wound().at(phi=poses))
    alone = [float(driving_force(Wound().at(phi=float(each)))) for each in poses]
    assert_allclose(together, alone, rtol=1e-12)
    turn = DragLink().at(phi=poses)["turn"]
    assert_allclose(together, (10.0 + turn) * 9.80665 * DragLink().at(phi=poses).ratio("C")[1], rtol=1e-9)
    with pytest.raises(DefinitionError, match=r"depends on the whole turns of angle\(O, C\)"):
        driving_force(DragLink().sweep(5), [Weight("C", mass=10.0 + angle("O", "C"))])
    driving_force(DragLink().sweep(5), [Force("C", (10.0 * np.cos(angle("O", "C")), 0.0))])


def test_where_it_cannot_be_followed_it_is_refused_by_name():
    class Meeting(Mechanism):
        """Two ends that pass through each other."""

        phi = Stroke(0.3, 6.0)
        A, O, D = Ground(0.0, 0.0), Ground(0.4, 0.0), Ground(1.0, 0.3)
        B = Crank(A, AB=0.3, angle=phi)
        C = Crank(O, OC=0.3, angle=pi - phi)
        E = Crank(D, DE=0.2, angle=0.5 * angle(C, B))

    meet = float(np.arccos(2.0 / 3.0))
    for ask in (
        lambda: Meeting().sweep(5),
        lambda: Meeting().at(phi=1.0),
        lambda: Meeting().evaluate(["E"], phi=[0.5, 1.0]),
        lambda: Meeting().function(["E"])(1.0),
    ):
        with pytest.raises(AssemblyError, match=r"angle\(C, B\), whose whole turns count here, cannot be followed there from the sketch"):
            ask()
    masked = Meeting().at(phi=[0.5, meet - 1e-6, meet + 1e-6, 3.0], unreachable="nan")
    assert masked.reached.tolist() == [True, True, False, False]
    (along,) = (each.intervals for each in Meeting().at(phi=0.5).limits().values())
    assert along[0].high == pytest.approx(meet, abs=1e-6)
    assert along[0].high_stop == "E"
    (values,) = Meeting().evaluate(["C"], phi=[0.5, 3.0])
    assert np.isfinite(values).all()


def test_behind_a_gap_of_the_reach_it_is_refused():
    class Gap(Mechanism):
        """A double rocker: it cannot get from one end of the stroke to the other."""

        phi = Stroke(0.0, 6.0)
        A, O, D = Ground(0.0, 0.0), Ground(1.0, 0.0), Ground(2.0, 0.3)
        B = Crank(A, AB=0.5, angle=phi)
        C = Dyad(B, O, BC=0.6, OC=0.6, side=LEFT)
        E = Crank(D, DE=0.2, angle=0.5 * angle(C, B))

    assert Gap().at(phi=[0.0, 6.0], unreachable="nan").reached.tolist() == [True, False]
    with pytest.raises(AssemblyError, match=r"angle\(C, B\), whose whole turns"):
        Gap().at(phi=6.0)


def test_up_to_a_dead_point_it_is_followed():
    class Lever(Mechanism):
        """A cylinder on a lever, stretched at the end of its stroke."""

        S = Stroke(0.8, 1.3)
        A, O, D = Ground(0.0, 0.0), Ground(1.0, 0.0), Ground(2.0, 0.3)
        B = Dyad(A, O, AB=S, OB=0.3, side=LEFT)
        E = Crank(D, DE=0.2, angle=0.5 * angle(B, O))

    motion = Lever().sweep(400)
    turn = 0.5 * np.unwrap(np.arctan2(0.0 - motion.y("B"), 1.0 - motion.x("B")))
    assert_allclose(motion["E"], [2.0 + 0.2 * np.cos(turn), 0.3 + 0.2 * np.sin(turn)], atol=1e-12)


def test_text_and_groups_are_refused_by_name():
    with pytest.raises(DefinitionError, match=r"angle\(C, B\) is followed from the sketch"):
        DragLink().source(["E"], language="c")
    for language in ("c", "javascript"):
        assert "poses" in DragLink().source(["C", "B"], language=language)
    with pytest.raises(DefinitionError, match=r"angle\(C, B\) is used in another way than .* the pins F, G, H hang on it"):
        type("Grouped", (DragLink,), GROUP)

    class Fixed(Mechanism):
        """A crank that is turned against two fixed points: their direction is not followed, whatever hangs on it."""

        phi = Stroke(0.0, 1.0)
        A, O, D = Ground(0.0, 0.0), Ground(1.0, 0.2), Ground(1.2, 0.3)
        E = Crank(D, DE=0.2, angle=phi + 0.5 * angle(A, O))

    assert np.isfinite(type("Held", (Fixed,), GROUP)().at(phi=0.0)["F"]).all()


GROUP = {
    "U": Ground(1.6, 0.3),
    "V": Ground(1.3, 0.9),
    "plate": Link("F G H", FG=0.25, FH=0.25, GH=0.25),
    "first": Link("E F", EF=0.2),
    "second": Link("U G", UG=0.25),
    "third": Link("V H", VH=0.25),
    "F": Pin(near=(1.15, 0.45)),
    "G": Pin(near=(1.4, 0.45)),
    "H": Pin(near=(1.28, 0.66)),
}


@pytest.mark.slow
@pytest.mark.skipif(find_spec("numba") is None, reason="Numba is not installed")
def test_compiled_loops_say_the_same():
    at = np.linspace(0.0, 4.0 * pi, 101)
    with unwarned():
        compiled = DragLink().evaluate(["E", "turn", ratio("E")], phi=at, backend="numba")
    for found, wanted in zip(compiled, DragLink().evaluate(["E", "turn", ratio("E")], phi=at, backend="numpy"), strict=True):
        assert_allclose(found, wanted, rtol=0.0, atol=1e-12)
