"""Laws of oil lines over random machines, against areas, lengths and loads that the package did not see.

Chambers, areas and who fills whom are kept in plain numbers by the draft (`random_oil`); lengths are taken from the points' places.
"""

from functools import lru_cache

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import pressure, thrust
from linkage import driving_force, pin_forces
from tests.laws.by_hand import FRAME, ByHand
from tests.laws.plane import Move, size
from tests.laws.random_oil import KINDS, random_oil
from tests.laws.test_random_machines import works_of

MANY, DAILY = 100, 10
NOTHING = 1e-12
MOVES = [Move(mirror=True), Move(turn=0.7), Move(mirror=True, turn=-2.1, scale=1.7), Move(scale=0.6, turn=1.9)]
EACH = pytest.mark.parametrize("seed", [n if n < DAILY else pytest.param(n, marks=pytest.mark.slow) for n in range(MANY)])
KIND = pytest.mark.parametrize("seed", [n if n < len(KINDS) else pytest.param(n, marks=pytest.mark.slow) for n in range(4 * len(KINDS))])


@lru_cache(maxsize=32)
def seen(seed):
    """Return a machine as it was drawn, over its strokes, its joint forces, and the pressure of every line."""
    draft = random_oil(seed)
    motion = draft.drawn().at(**draft.strokes())
    lines = {name: motion.plan.members[name].pressure(motion) for name in (*draft.lines, *draft.held)}
    return ByHand(draft, motion), pin_forces(motion), lines


def largest(found, draft):
    """Return the largest thrust of a machine's cylinders at each pose [N], at least 1."""
    return 1.0 + np.max([np.abs(found.thrusts[name]) for name in draft.rams], axis=0)


def lengths(hand):
    """Return the length of each cylinder over the poses [m]."""
    return {name: size(hand.at[ram.B] - hand.at[ram.A]) for name, ram in hand.draft.rams.items()}


@pytest.mark.slow
def test_of_every_kind_there_are_twenty():
    tags = [tag for seed in range(MANY) for tag in random_oil(seed).tags]
    assert all(tags.count(kind) >= 20 for kind in (*KINDS, "slider", "several strokes"))


@EACH
def test_a_closed_line_keeps_its_oil(seed):
    hand, _, _ = seen(seed)
    now, draft = lengths(hand), hand.draft
    for name, on in draft.lines.items():
        areas = {(ram, side): draft.rams[ram].area(side) for ram, side in on}
        started = {ram: draft.apart(draft.rams[ram].A, draft.rams[ram].B) for ram, _ in on}
        oil = sum(area * (now[ram] - started[ram]) for (ram, _), area in areas.items())
        whole = sum(abs(area) * started[ram] for (ram, _), area in areas.items())
        assert np.max(np.abs(oil)) < NOTHING * whole, name
        assert np.max(np.abs(hand.motion.plan.members[name].oil(hand.motion))) < NOTHING * whole, name
        assert max(np.ptp(now[ram]) for ram, _ in on) > 1e-4, name


@EACH
def test_every_body_balances_and_thrusts_are_pressures_times_areas(seed):
    """Equilibrium of every body, by hand; each cylinder carries the pressures of its lines, and the thrust that it tells by work."""
    hand, found, lines = seen(seed)
    draft, most = hand.draft, largest(found, hand.draft)
    misses = hand.misses(found.joints)
    assert set(hand.bodies) | set(draft.rams) <= set(misses)
    assert max(value for body, value in misses.items() if body != FRAME) < NOTHING
    assert found.residual < NOTHING
    for name, ram in draft.rams.items():
        told = hand.motion.plan.members[name].thrust(hand.motion)
        assert np.max(np.abs(told - found.thrusts[name]) / most) < 1e-11, name
        on = [(line, side) for line, its in (draft.lines | draft.held).items() for each, side in its if each == name]
        pushed = sum(lines[line] * ram.area(side) for line, side in on)
        drives = np.any([lines[line] == 0.0 for line, _ in on if line in draft.held], axis=0)
        assert np.max(np.where(drives, 0.0, np.abs(pushed - found.thrusts[name]) / most)) < 1e-11, name


@EACH
def test_the_work_of_the_thrusts_is_that_of_the_oil(seed):
    """The sum over cylinders of T l' is that over lines of p V', of which closed ones do none, and the work of the loads."""
    hand, found, lines = seen(seed)
    draft = hand.draft
    for stroke in draft.spans:
        rates = {name: hand.stretch(ram.A, ram.B, stroke) for name, ram in draft.rams.items()}
        thrusts = sum(found.thrusts[name] * rate for name, rate in rates.items())
        flows = {line: sum(draft.rams[ram].area(side) * rates[ram] for ram, side in on) for line, on in (draft.lines | draft.held).items()}
        for line in draft.lines:
            sizes = sum(abs(draft.rams[ram].area(side)) * np.abs(rates[ram]) for ram, side in draft.lines[line])
            assert np.max(np.abs(flows[line])) <= NOTHING * max(np.max(sizes), 1e-3), line
        drives = np.any([lines[line] == 0.0 for line in draft.held], axis=0) if draft.held else np.zeros(hand.motion.shape, bool)
        scale = np.sum([np.abs(found.thrusts[name] * rate) for name, rate in rates.items()], axis=0) + 1.0
        oil = sum(lines[line] * flow for line, flow in flows.items())
        assert np.max(np.where(drives, 0.0, np.abs(thrusts - oil) / scale)) < 1e-11
        works = works_of(hand, stroke)
        wanted, whole = -sum(works), 1.0 + np.max(sum(map(np.abs, works)))
        assert_allclose(driving_force(hand.motion, drive=stroke), wanted, rtol=0, atol=1e-11 * whole)
        assert_allclose(found.drives[stroke], wanted, rtol=0, atol=1e-9 * whole)


@EACH
def test_the_pressure_is_the_work_on_the_oil_that_is_put_in(seed):
    """dU/dV by five points, at fixed strokes; not of a double line or beside a held one."""
    hand, _, lines = seen(seed)
    draft = hand.draft
    for line, on in draft.lines.items() if not (draft.held or "double" in draft.tags) else ():
        step = 1e-5 * max(abs(draft.rams[ram].area(side)) for ram, side in on)
        energies = [ByHand(draft, draft.drawn(**{f"{line}.oil": k * step}).at(**draft.strokes())).energy() for k in (-2, -1, 1, 2)]
        slope = (energies[0] - 8.0 * energies[1] + 8.0 * energies[2] - energies[3]) / (12.0 * step)
        rounding = 1e-15 * np.max(np.abs(energies)) / step
        assert np.max(np.abs(slope - lines[line])) < 1e-8 * (1.0 + np.max(np.abs(lines[line]))) + 10.0 * rounding, line


@KIND
def test_moved_and_mirrored_it_carries_the_same(seed):
    hand, found, lines = seen(seed)
    draft, most = hand.draft, largest(found, hand.draft)
    move = MOVES[seed % len(MOVES)]
    strokes = {name: value * (1.0 if draft.angular(name) else move.scale) for name, value in draft.strokes().items()}
    motion = draft.machine(move)().at(**strokes)
    there = pin_forces(motion)
    for name in draft.rams:
        assert np.max(np.abs(there.thrusts[name] - found.thrusts[name]) / most) < 1e-10, name
    for name, pressures in lines.items():
        assert_allclose(motion.plan.members[name].pressure(motion), pressures, rtol=0, atol=1e-9 * (1.0 + np.max(np.abs(pressures))))


@KIND
def test_what_is_asked_has_its_derivatives(seed):
    """Values and gradients of thrusts and pressures in one program, against the methods and central differences of them."""
    hand, found, lines = seen(seed)
    draft, strokes = hand.draft, hand.draft.strokes()
    rams = [name for name in draft.rams]
    asked = [*map(thrust, rams), *map(pressure, draft.lines)]
    values = draft.drawn().evaluate(asked, **strokes)
    for one, wanted in zip(values, [*(found.thrusts[name] for name in rams), *(lines[name] for name in draft.lines)], strict=True):
        assert_allclose(one, wanted, rtol=0, atol=1e-9 * (1.0 + np.max(np.abs(wanted))))
    line, on = next(iter(draft.lines.items()))
    ram, _ = on[0]
    wrt = [f"{on[0][0]}.bore", f"{on[-1][0]}.rod", f"{on[-1][0]}.bore"]
    for request, name in ((thrust(ram), ram), (pressure(line), line)):
        rows = hand.motion.gradient(request, wrt)
        for row, dimension in zip(rows, wrt, strict=True):
            value = float(draft.drawn.plan.defaults[dimension])
            step = 1e-4 * value
            moved = [draft.drawn(**{dimension: value + k * step}).at(**strokes)[request] for k in (-2, -1, 1, 2)]
            central = (moved[0] - 8.0 * moved[1] + 8.0 * moved[2] - moved[3]) / (12.0 * step)
            scale = np.max(np.abs(hand.motion[request])) / value + np.max(np.abs(central))
            assert_allclose(row, central, rtol=0, atol=1e-6 * (1.0 + scale), err_msg=f"{name}, {dimension}")
