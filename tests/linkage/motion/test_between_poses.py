"""Between its poses a sweep is followed, or its end is told: gaps, change points and parallel guides, however few and uneven the poses."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    AssemblyError,
    Crank,
    DefinitionError,
    Dyad,
    Ground,
    Guide,
    Link,
    Mechanism,
    OnGuide,
    Pin,
    PinSlotDyad,
    SingularError,
    SliderDyad,
    Stroke,
    deg,
)
from tests.for_all import for_all
from tests.linkage.motion.exact_sweeps import parallel, sweep


class FourBar(Mechanism):
    phi = Stroke(0, 2 * np.pi)
    O, C = Ground(0, 0), Ground(4, 0)
    A = Crank(O, OA=1, angle=phi)
    B = Dyad(A, C, AB=3, CB=2.5, side=LEFT)


def told(machine, values):
    """Return what a sweep was told to be: "clear", a "gap" or a "change" point, and of which step."""
    (name,) = machine.strokes
    try:
        machine.at(**{name: values})
    except SingularError as error:
        return "change", error.point
    except AssemblyError as error:
        return "gap", error.point
    return "clear", ""


def check_sweeps(seeds, widths):
    """Hold sweeps against their exact margins: no gap and no crossing unreported, no false alarm where the margin is clear."""
    for seed in seeds:
        rng = np.random.default_rng(seed)
        case = sweep(rng, widths(rng))
        what, step = told(case.machine, case.values)
        where = f"{seed}: {case}"
        if case.margin > 1e-9:
            assert what == "clear", where
        else:
            assert step == case.step, where
            # less than 2e-14 of the links is not told from nothing: a gap of some 1e-7 of the stroke
            assert what == "gap" if case.margin < -2e-14 else what in ("gap", "change"), where


def any_width(rng):
    """Return a gap 1e-9 to 1e-2 of the stroke wide, 0 for a change point, or a clearance of 1e-8.9 and more, as a negative number."""
    kind = rng.random()
    return 0.0 if kind < 0.15 else -(10.0 ** rng.uniform(-8.9, -0.7)) if kind < 0.5 else 10.0 ** rng.uniform(-9, -2)


def test_sweeps_against_exact_margins():
    check_sweeps(range(30), any_width)


@pytest.mark.slow
def test_ten_thousand_sweeps_against_exact_margins():
    check_sweeps(range(1000, 10_000), lambda rng: -(10.0 ** rng.uniform(-8.9, -0.7)))
    check_sweeps(range(10_000, 11_000), lambda rng: 10.0 ** rng.uniform(-9, -2))
    check_sweeps(range(11_000, 12_000), any_width)


@for_all("seed", range(1), slow=range(1, 12))
def test_guides_that_come_parallel_between_poses(seed):
    case = parallel(np.random.default_rng(seed))
    assert told(case.machine, case.values) == ("change", "X")


@for_all(("height", "count"), [(0.0, 2), (0.0, 36), (1e-10, 5), (1e-8, 2), (1e-8, 36)])
def test_a_slot_whose_pin_comes_to_its_pivot(height, count):
    class Slotted(Mechanism):
        S = Stroke(-1.0, 1.3)
        floor, Q = Guide((0.0, 0.0), angle=0.0), Ground(0.0, 0.0)
        P = OnGuide(floor, at=S)
        X = PinSlotDyad(P, Q, PX=0.5)

    what = told(Slotted(Q=(0.0, height)), np.linspace(-1.0, 1.3, count))
    assert what == (("clear", "") if height == 1e-8 else ("change", "X"))


def test_a_gap_between_two_poses_is_told_with_its_ends_and_what_is_missing():
    half = np.arccos(1.0 - (5.0**2 - 4.999**2) / 8.0)
    with pytest.raises(AssemblyError, match=r"between two poses, from phi = 3\.0915.* to 3\.1915.* rad:\nAB \+ CB .* 1 mm short") as caught:
        FourBar(CB=1.999).sweep(36)
    assert_allclose(caught.value.shortfall, 1e-3, rtol=1e-9)
    assert caught.value.mask.tolist() == [False] * 18 + [True] * 18
    (gap,) = FourBar(CB=1.999).sweep(36, unreachable="nan").interruptions
    assert_allclose([gap.low, gap.high], [np.pi - half, np.pi + half], rtol=1e-12)


@for_all("link", [1.999, 2.0 - 1e-9, 2.0 - 1e-13, 2.0, 2.0 + 1e-13])
@for_all("values", [[0, 6.2], [6.2, 0], [3.0, 3.15, 5.0, 5.1], [1.0, 2.0, 3.3], np.linspace(3.1, 6.0, 40)])
def test_first_last_and_uneven_intervals_are_looked_at(link, values):
    what = told(FourBar(CB=link), np.array(values))
    assert what == ("gap" if link < 2.0 - 1e-12 else "change" if link >= 2.0 else what[0], "B") and what[0] != "clear"


@pytest.mark.parametrize("values", [[0, np.pi], [np.pi, 2 * np.pi], [1.0, 2.0], [4.0, 3.2]])
def test_a_change_point_at_an_end_is_not_passed(values):
    assert told(FourBar(CB=2.0), np.array(values)) == ("clear", "")


def test_what_was_found_clear_says_nothing_of_what_was_not_looked_at():
    machine = FourBar(CB=2.0)
    for low, high, what in ((0, 3, "clear"), (1, 2, "clear"), (1, 6, "change"), (0, 3, "clear"), (3.5, 6, "clear"), (0, 6, "change")):
        assert told(machine, np.array([low, high]))[0] == what
    assert told(machine, np.pi + np.array([-1e-6, 1e-6]))[0] == "change"  # in line all the way, to rounding
    assert told(FourBar(CB=2.5), np.array([0.0, 6.0]))[0] == "clear"
    assert told(FourBar(CB=1.9), np.array([0.0, 6.0]))[0] == "gap"


def test_a_motion_tells_of_what_it_did_not_refuse():
    clear, gap = FourBar().sweep(5), FourBar(CB=1.999).sweep(5, unreachable="nan")
    assert repr(clear).endswith("all reached>") and clear.interruptions == ()
    assert repr(gap).endswith("4 of 5 reached, interrupted: B out of reach from phi = 177.135 to 182.865 deg>")
    crossing = FourBar(CB=2.0).sweep(4, unreachable="nan")
    assert repr(crossing).endswith("all reached, interrupted: a change point of B at phi = 180 deg>")
    batch = FourBar(CB=np.array([2.5, 2.6])).sweep(3)
    assert batch.interruptions is None and "not looked at between the poses" in repr(batch)
    for lone in (FourBar().at(phi=1.0), FourBar(CB=np.array([2.5, 2.6])).at(phi=1.0), FourBar().at(phi=[1.0])):
        assert repr(lone).endswith("all reached>") and lone.interruptions == ()


class Driven(FourBar):
    """What hangs on B, which swings over in no time where its own loop is nearly singular."""

    F = Ground(2.0, 1.2)
    D = Dyad("B", F, BD=0.6, FD=0.6, side=LEFT)


def test_what_hangs_on_a_nearly_singular_loop_is_looked_at_as_finely():
    """D comes out of reach while B swings over within 1e-3 to 1e-2 rad, and is in reach at both poses."""
    tried = 0
    for seed in range(12):
        rng = np.random.default_rng(seed)
        clearance = 10.0 ** rng.uniform(-6, -3)
        # B comes down to (2, 1.5 sqrt(clearance)) and goes up again: out of reach of F, above, where it is lower than `low`
        low = np.sqrt(clearance) * rng.uniform(2.0, 10.0)
        machine = Driven(CB=2.0 + clearance, F=(2.0, 1.2), BD=0.6, FD=0.6 - low)
        values = np.pi + np.array([-0.4, 0.4])
        swing = np.sqrt(clearance) * np.linspace(-9.0, 9.0, 2001)
        if machine.at(phi=values, unreachable="nan").reached.all() and not machine.at(phi=np.pi + swing, unreachable="nan").reached.all():
            tried += 1
            assert told(machine, values) == ("gap", "D"), seed
    assert tried > 3


# -- strokes that start at rest --------------------------------------------------------------------------


def test_a_stroke_that_starts_at_rest():
    class Rest(Mechanism):
        phi = Stroke(0.0, 2 * np.pi)
        rail, O = Guide((0.0, 0.0), angle=0.0), Ground(0.3, 0.2)
        P = OnGuide(rail, at=0.05 - 0.02 * np.cos(phi))
        rod, arm = Link("P B", PB=0.25), Link("O B", OB=0.15)
        B = Pin(near=(0.2, 0.3))

    assert Rest().mobility == 1
    motion = Rest().sweep(37)
    assert_allclose(motion.distance("P", "B"), 0.25, rtol=1e-12)
    assert_allclose(motion.ratio("B")[:, 0], 0.0, atol=1e-15)


def test_two_strokes_of_which_one_starts_at_rest():
    class Rest(Mechanism):
        phi, psi = Stroke(0.0, np.pi), Stroke(0.0, 1.0)
        A, O = Ground(0.0, 0.0), Ground(0.3, 0.2)
        C = Crank(A, AC=0.1, angle=psi * psi)
        ram, arm = Link("C B", CB=0.25 + 0.02 * np.cos(phi)), Link("O B", OB=0.2)
        B = Pin(near=(0.1, 0.25))

    assert Rest().mobility == 2


def test_a_group_whose_stroke_starts_at_rest():
    class Rest(Mechanism):
        phi = Stroke(0.0, np.pi)
        A, B, D = Ground(0.0, 0.0), Ground(1.0, 0.0), Ground(0.5, 1.0)
        C, E, F = Pin(near=(0.2, 0.4)), Pin(near=(0.8, 0.4)), Pin(near=(0.5, 0.7))
        a, b, c = Link("A C", AC=0.4 + 0.05 * (1 - np.cos(phi))), Link("B E", BE=0.42), Link("D F", DF=0.35)
        plate = Link("C E F", CE=0.55, CF=0.4, EF=0.45)

    assert Rest().mobility == 1
    assert_allclose(Rest().sweep(5).distance("A", "C"), 0.4 + 0.05 * (1 - np.cos(np.linspace(0, np.pi, 5))), rtol=1e-11)


def test_a_link_too_much_is_still_one_where_the_stroke_rests():
    class Machine(Mechanism):
        phi = Stroke(0.0, 60 * deg)
        O, rail = Ground(0.0, 0.0), Guide((0.0, 0.0), angle=0.0)
        A = Crank(O, OA=0.1, angle=1.0 - np.cos(phi))
        C = SliderDyad(A, rail, AC=0.3, near=(0.4, 0))

    with pytest.raises(DefinitionError, match="mobility is 0"):
        type("Locked", (Machine,), {"lock": Link("O C")})
