"""Every number of a step may follow a stroke: what it places satisfies its own equations, and exact ratios are the numerical ones."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    RIGHT,
    Crank,
    DefinitionError,
    Dyad,
    Ground,
    Guide,
    GuideCross,
    Mechanism,
    OnGuide,
    OnLink,
    PinSlotDyad,
    SliderDyad,
    Stroke,
    YokeDyad,
)
from tests.for_all import for_all

SIDES = (LEFT, RIGHT)
S = np.linspace(0.05, 0.95, 7)


class Base(Mechanism):
    """Two points that move with S, a fixed one, a fixed and a moving guide."""

    S = Stroke(0.0, 1.0)
    O, C, W = Ground(0.0, 0.0), Ground(1.2, -0.1), Ground(0.3, -0.8)
    A = Crank(O, OA=0.4, angle=0.5 + 0.7 * S)
    D = Crank(C, CD=0.3, angle=2.2 - 0.4 * S)
    rail = Guide((-0.2, -0.5), angle=0.3)
    tilting = Guide(W, angle=0.2 + 0.3 * S)
    running = Guide(A, D)


def made(**members):
    return type("Made", (Base,), members)


p, q = 0.9 + 0.2 * Base.S, 1.0 - 0.15 * Base.S
STEPS = {
    **{f"dyad {side}": {"X": Dyad("A", "D", AX=p, DX=q, side=side)} for side in SIDES},
    **{
        f"slider {side} {guide}": {"X": SliderDyad("A", guide, AX=1.1 + 0.2 * Base.S, side=side)}
        for side in SIDES
        for guide in ("rail", "tilting")
    },
    **{
        f"slot {side} {offset}": {"X": PinSlotDyad("C", "A", CX=p, offset=offset, side=side)}
        for side in SIDES
        for offset in (0.0, 0.2, -0.1 + 0.3 * Base.S)
    },
    **{
        f"cross {first} {second}": {"X": GuideCross(first, second)}
        for first, second in (("rail", "post"), ("running", "post"), ("post", "tilting"))
    },
    **{f"yoke {angle}": {"X": YokeDyad("A", "tilting", angle=angle)} for angle in (1.2, 1.9 - 0.3 * Base.S)},
    "along": {"X": OnGuide("running", at=p)},
    "arm by an angle": {"X": OnLink("A", "D", AX=p, DAX=0.4 + 0.5 * Base.S)},
    "arm to a side": {"X": OnLink("A", "D", AX=p, DAX=0.4 + 0.5 * Base.S, side=RIGHT)},
    **{f"arm by sides {side}": {"X": OnLink("A", "D", AX=p, DX=q, side=side)} for side in SIDES},
}


@pytest.fixture(scope="module", params=STEPS)
def machine(request):
    return made(post=Guide((0.6, 0.2), angle=1.6), **STEPS[request.param])


class Beside:
    """A reading in which X stands somewhere else."""

    def __init__(self, reading, x, y):
        self.reading, self.place = reading, type(reading.at("O"))(x, y)

    def at(self, point):
        return self.place if point == "X" else self.reading.at(point)

    def __getattr__(self, name):
        return getattr(self.reading, name)


def residuals(motion, place):
    """Return what must vanish, were X at a place, shape (2, poses)."""
    step, reading = motion.plan.members["X"], motion.plan.read(motion.inputs)
    reading.placing.append("X")  # as while it places it
    return np.array([np.broadcast_to(miss, S.shape) for miss in step.constraints(Beside(reading, *place))])


def test_placed_point_satisfies_its_equations_and_no_other_nearby_does(machine):
    """The residuals that ratios, ranks and groups rely on vanish where `place` puts the point; their rank by its coordinates is two."""
    motion = machine().at(S=S)
    assert_allclose(residuals(motion, motion["X"]), 0.0, rtol=0, atol=1e-15)
    step = 1e-6 * np.eye(2)[:, :, None]
    columns = [(residuals(motion, motion["X"] + each) - residuals(motion, motion["X"] - each)) / 2e-6 for each in step]
    assert np.all(abs(np.linalg.det(np.moveaxis(columns, -1, 0))) > 0.05)


def test_exact_ratios_are_numerical_ones(machine):
    motion = machine().at(S=S)
    for order, tolerance in ((1, 1e-8), (2, 1e-5)):
        exact = motion.ratio("X", order=order)
        assert_allclose(motion.ratio("X", order=order, method="central"), exact, rtol=tolerance, atol=tolerance * np.abs(exact).max())


def test_gradients_are_differences(machine):
    """By every dimension of the step and of what carries it, ground points and guides included."""
    base, h = machine.plan.defaults, 1e-5
    names = list(base)
    shifts = h * np.concatenate([np.eye(len(names)), -np.eye(len(names))])
    apart = machine(**{name: base[name] + shift for name, shift in zip(names, shifts.T, strict=True)}).at(S=S)["X"]
    central = (apart[:, : len(names)] - apart[:, len(names) :]) / (2.0 * h)
    assert_allclose(np.moveaxis(machine().at(S=S).gradient("X", wrt=names), 0, 1), central, rtol=0, atol=3e-8)


@for_all(
    ("step", "words"),
    [
        (Dyad("A", "D", AX=0.9, side=LEFT), "DX"),
        (Dyad("A", "D", DX=0.9, side=LEFT), "AX"),
        (SliderDyad("A", "rail", side=LEFT), "AX"),
        (PinSlotDyad("C", "A"), "CX"),
        (OnLink("A", "D"), "AX"),
        (OnLink("A", "D", AX=0.3, DX=0.9), "side"),
        (OnLink("A", "D", AX=0.3, DX=0.9, DAX=0.2, side=LEFT), "not both"),
        (OnLink("A", "D", AX=0.3, side=LEFT), "line AD .* side= chooses nothing; give DAX or DX, or leave side out"),
        (OnLink("A", "D", AX=0.3, near=(1.0, 2.0)), "line AD .* near= chooses nothing; give DAX or DX, or leave near out"),
        (OnLink("A", "D", AX=0.3, DAX=0.2, near=(1.0, 2.0)), "near= chooses nothing; say side=LEFT or side=RIGHT, or leave near out"),
        (SliderDyad("A", "rail", AX=1.0), "side"),
        (Dyad("A", "D", AX=0.9, DX=0.9), "side"),
        (Crank("O", angle=0.3), "OX"),
    ],
)
def test_step_that_lacks_a_number_or_has_one_word_too_many_says_which(step, words):
    with pytest.raises(DefinitionError, match=words):
        made(X=step)


@for_all("kind", ["dyad", "slider {} rail", "slider {} tilting", "slot {} 0.0", "slot {} 0.2"])
def test_both_sides_are_the_assembly_modes(kind):
    """The declared side first, the other one where its own class would stand."""
    name = kind if "{}" in kind else kind + " {}"
    classes = {side: made(**STEPS[name.format(side)]) for side in SIDES}
    for side, other in (SIDES, SIDES[::-1]):
        modes = classes[side]().assemblies(S=0.4)
        assert [dict(mode.sides) for mode in modes] == [{"X": side}, {"X": other}]
        for mode, each in zip(modes, (side, other), strict=True):
            assert_allclose(mode.places["X"], classes[each]().at(S=0.4)["X"], rtol=0, atol=1e-14)
