"""Groups keep their branch: a change point on the way is told by name, and a pose is the same whatever else is asked."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import AssemblyError, Crank, Dimension, Dyad, Ground, Link, Mechanism, OnLink, Pin, SingularError, Stroke, distance
from linkage.quantities import ref
from tests.for_all import first_daily, for_all
from tests.linkage.random_parts import group_parts, span_of


class Plate:
    """A plate CDF on two rods AC and BD from the frame, driven by a cylinder EF: AC turns from `start` to `end` [rad]."""

    def __init__(self, seed, longer=0.0):
        rng = np.random.default_rng(seed)
        self.g, self.longer = rng.uniform(0.6, 1.2), longer
        self.flat = bool(rng.random() < 0.5)
        while True:
            self.r = rng.uniform(0.2, 0.55)
            self.start, self.end = rng.uniform(-1.2, 1.2, 2) if self.flat else rng.uniform(0.3, 2.8, 2)
            self.f, self.E = np.add(rng.uniform(-0.5, 0.5, 2), (self.g / 2, 0.1)), rng.uniform(-1.5, 1.5, 2)
            change = np.diff(self.length(np.linspace(self.start, self.end, 400)))
            alone = self.start * self.end < 0.0 if self.flat else True
            wide = min(abs(self.start - self.end), 10.0 * abs(np.sin(self.start)), 10.0 * abs(np.sin(self.end))) > 0.3
            if alone and wide and (np.all(change > 1e-4) or np.all(change < -1e-4)):
                break

    def corners(self, phi):
        """Return C, D and F of the parallelogram for some angles of AC, shape (2, n)."""
        C = np.array([self.r * np.cos(phi), self.r * np.sin(phi)])
        return C, np.add(C, [[self.g], [0.0]]), C + self.f[:, None]

    def length(self, phi):
        """Return the length of EF for some angles of AC."""
        return np.hypot(*(self.corners(np.asarray(phi))[2] - self.E[:, None]))

    def members(self, name=""):
        """Return its members; `name` is put behind each name, the stroke is S for all."""
        C, D, F = (tuple(map(float, part[:, 0])) for part in self.corners(np.array([self.start])))
        found = {
            "L0": Dimension(float(self.length([self.start])[0])),
            "A": Ground(0.0, 0.0), "B": Ground(self.g, 0.0), "E": Ground(*map(float, self.E)),
            "C": Pin(near=C), "D": Pin(near=D), "F": Pin(near=F),
        }  # fmt: skip
        A, B, C, D, E, F = (point + name for point in "ABCDEF")
        found |= {"one": Link(f"{A} {C}", **{A + C: self.r}), "two": Link(f"{B} {D}", **{B + D: self.r + self.longer})}
        found["ram"] = Link(f"{E} {F}", **{E + F: ref(f"L0{name}") + ref("S")})
        arms = np.hypot(*self.f), np.hypot(self.f[0] - self.g, self.f[1])
        found["plate"] = Link(f"{C} {D} {F}", **{C + D: self.g, C + F: float(arms[0]), D + F: float(arms[1])})
        return {each + name: member for each, member in found.items()}

    def machine(self, name=""):
        """Return the class of one plate."""
        travel = self.length([self.start, self.end])
        return type("OnePlate", (Mechanism,), {"S": Stroke(0.0, float(travel[1] - travel[0])), **self.members(name)})

    def angle(self, S):
        """Return the angle of AC for values of the stroke."""
        phi = np.linspace(self.start, self.end, 40001)
        travel = self.length(phi) - self.length([self.start])
        order = np.argsort(travel)
        return np.interp(S, travel[order], phi[order])


def check_plates(seeds):
    """Hold plates on two equal rods against the parallelogram: told where it comes flat on the way, and nowhere else."""
    for seed in seeds:
        plate = Plate(seed)
        machine, count = plate.machine()(), int(np.random.default_rng(seed).choice([2, 3, 36, 101]))
        if plate.flat:
            with pytest.raises(SingularError, match=r'branches of group1 = Group\("C D F"\) cross') as caught:
                machine.sweep(count)
            assert caught.value.point == "group1", seed
            values = caught.value.motion.strokes["S"]
            assert (caught.value.mask == (plate.angle(values) * plate.start <= 0.0)).all(), seed
        else:
            motion = machine.sweep(count)
            assert_allclose(motion["C"], plate.corners(plate.angle(motion.strokes["S"]))[0], rtol=0, atol=1e-7, err_msg=str(seed))


@pytest.mark.slow
def test_a_plate_on_two_equal_rods_stays_on_its_branch():
    check_plates(range(4))


@pytest.mark.slow
def test_three_hundred_plates_on_two_equal_rods():
    check_plates(range(300))


@first_daily(1, "seed", [0, 1])
def test_two_equal_groups_do_not_hide_each_other(seed):
    plate = next(each for each in map(Plate, range(100 * seed, 100 * seed + 50)) if each.flat)
    twin = type("Twins", (plate.machine(),), plate.members("2"))
    for count in (2, 7, 50):
        with pytest.raises(SingularError, match=r"branches of group1 = .*cross"):
            twin().sweep(count)


def test_of_two_groups_the_one_that_crosses_is_named():
    flat, other = (next(each for each in map(Plate, range(50)) if each.flat is wanted) for wanted in (True, False))
    first = flat.machine()
    both = type("Both", (first,), other.members("2"))
    crossing = next(name for name, group in both.plan.groups.items() if set(group.pins) == set("CDF"))
    alone = first().sweep(60, unreachable="nan")
    beyond = alone.strokes["S"][~alone.reached][0]
    with pytest.raises(SingularError, match=f"the branches of {crossing} = ") as caught:
        both().at(S=[0.0, beyond])
    assert caught.value.point == crossing


def nearly(seed, longer):
    """Return a plate whose second rod is a little longer, and the same linkage driven by its first rod, built of dyads."""
    plate = Plate(seed, longer)

    class Driven(Mechanism):
        phi = Stroke(float(plate.start), float(plate.end))
        A, B, E = Ground(0.0, 0.0), Ground(plate.g, 0.0), Ground(*map(float, plate.E))
        C = Crank(A, AC=plate.r, angle=phi)
        D = Dyad(C, B, CD=plate.g, BD=plate.r + longer, near=tuple(map(float, plate.corners(np.array([plate.start]))[1][:, 0])))
        F = OnLink(C, D, CF=float(np.hypot(*plate.f)), DCF=float(np.arctan2(plate.f[1], plate.f[0])))
        ram = distance(E, F)

    return plate, Driven()


def check_near_crossings(seeds):
    """Hold plates next to a change point, rods 1e-8 to 1e-2 apart, against dyads: up to where the cylinder's length turns."""
    passed = 0
    for seed in seeds:
        rng = np.random.default_rng(seed)
        plate, driven = nearly(seed, 10.0 ** rng.uniform(-8, -2))
        if not plate.flat:
            continue
        near = np.sqrt(plate.longer) * np.linspace(-20.0, 20.0, 1001)
        dense = np.unique(np.clip(np.concatenate([np.linspace(plate.start, plate.end, 5001), near]), *sorted((plate.start, plate.end))))
        dense = dense if plate.start < plate.end else dense[::-1]
        there = driven.at(phi=dense)
        length = there["ram"]
        sense = np.sign(length[1] - length[0])
        turn = int(np.argmax(np.diff(length) * sense <= 0.0)) or len(length) - 1
        machine = type("Near", (plate.machine(),), {"L0": Dimension(float(length[0]))})()
        reach = float(length[turn] - length[0])
        inside = reach * np.linspace(0.0, 1.0 - 1e-6, int(rng.choice([2, 7, 60])))
        motion = machine.at(S=inside)
        expected = np.interp(length[0] + inside, length[: turn + 1][:: int(sense)], there["F"][0][: turn + 1][:: int(sense)])
        assert_allclose(motion["F"][0], expected, rtol=0, atol=1e-4 * plate.g, err_msg=str(seed))
        if turn < len(length) - 1:
            with pytest.raises(AssemblyError):
                machine.at(S=[0.0, reach * (1.0 + 1e-4)])
        passed += 1
    return passed


def test_groups_beside_a_change_point_are_those_of_dyads():
    assert check_near_crossings(range(3)) > 0


@pytest.mark.slow
def test_many_groups_beside_a_change_point_are_those_of_dyads():
    assert check_near_crossings(range(6, 300)) > 100


@for_all("seed", range(1), slow=range(1, 200))
def test_a_pose_of_a_group_is_the_same_whatever_else_is_asked(seed):
    """All together, backwards, one by one, few, beside others, by evaluate and as a function."""
    cls, _ = group_parts(seed)
    span, _ = span_of(cls)
    if not span:
        return
    rng, machine = np.random.default_rng(seed), cls()
    pins = [pin for group in cls.plan.groups.values() for pin in group.pins]
    values = rng.uniform(-span, span, 9)
    known = machine.at(S=values)
    f = cls().function(pins)
    for k in (0, 8):
        fresh = type(f"Again{seed}", (cls,), {})()
        places = np.concatenate([fresh.at(S=float(values[k]))[pin] for pin in pins])
        assert_allclose(places, np.concatenate([known[pin][:, k] for pin in pins]), rtol=0, atol=2e-12)
        assert_allclose(f(float(values[k])), places, rtol=0, atol=2e-12)
    for others in (values[::-1], np.append(values[:3], values), np.sort(values), np.linspace(-span, span, 301)):
        found = machine.at(S=np.append(others, values))
        for pin in pins:
            assert_allclose(found[pin][:, -9:], known[pin], rtol=0, atol=2e-12)
    for pin, found in zip(pins, cls().evaluate(pins, S=values), strict=True):
        assert_allclose(found, known[pin], rtol=0, atol=2e-12)
