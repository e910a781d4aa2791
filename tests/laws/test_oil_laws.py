"""Laws of oil lines over random machines, against areas, lengths and loads that the package did not see.

Chambers, areas and who fills whom are kept in plain numbers by the draft (`random_oil`); lengths are taken from the points' places.
"""

from dataclasses import fields
from functools import lru_cache, partial

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Accumulator, AccumulatorBlock, FloatCircuit, Holding, LiftCircuit, Lowering, OilLine, Pump, Relief, pressure, thrust
from linkage import driving_force, pin_forces
from linkage.errors import LinkageError
from tests.for_all import first_daily, for_all
from tests.laws.by_hand import FRAME, ByHand
from tests.laws.plane import PLAIN, Move, size
from tests.laws.random_machines import random_machine
from tests.laws.random_oil import KINDS, random_oil
from tests.laws.test_random_machines import works_of

MANY, DAILY = 100, 5
NOTHING = 1e-12
MOVES = [Move(mirror=True), Move(turn=0.7), Move(mirror=True, turn=-2.1, scale=1.7), Move(scale=0.6, turn=1.9)]
EACH = for_all("seed", range(DAILY), slow=range(DAILY, MANY))
KIND = first_daily(3, "seed", [1, 2, 3, 0, *range(4, 4 * len(KINDS))])


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
    rams = list(draft.rams)
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
            try:
                moved = [draft.drawn(**{dimension: value + k * step}).at(**strokes)[request] for k in (-2, -1, 1, 2)]
            except LinkageError as error:  # a size that would lock a closed double line has no neighbours
                assert "locks the machine" in str(error), error
                continue
            central = (moved[0] - 8.0 * moved[1] + 8.0 * moved[2] - moved[3]) / (12.0 * step)
            scale = np.max(np.abs(hand.motion[request])) / value + np.max(np.abs(central))
            assert_allclose(row, central, rtol=0, atol=1e-6 * (1.0 + scale), err_msg=f"{name}, {dimension}")


# -- two spellings -------------------------------------------------------------------------------------------

DIRECTIONS = ("frictionless", "extending", "retracting")


def spelled(seed):
    """Return two machines, cylinders on circuits and on lines with what lies on them, and the names of those held and fed."""
    draft = random_machine(seed)
    held = list(dict.fromkeys(each.member for each in draft.holders if each.member))
    lines = [name for name in draft.parts if name.startswith(("gas", "line"))]
    fed = [name.replace("gas", "lift") for name in lines if name.startswith("gas")]
    fed = [name if name in draft.parts else name.replace("lift", "ram") for name in fed]
    given = np.random.default_rng([91, seed])
    circuits, oil = dict.fromkeys(lines), dict.fromkeys(lines)
    for number, names in enumerate(groups_of(draft, held)):
        high, relief, k_m, k_h = given.uniform([150e5, 320e5, 0.8, 0.85], [300e5, 350e5, 1.0, 1.0])
        pump = dict(flow=1e-3, mechanical_efficiency=k_m, hydraulic_efficiency=k_h)
        circuits |= {f"on{number}": LiftCircuit(names if len(names) > 1 else names[0], pressure=high, relief=relief, **pump)}
        oil |= {f"pump{number}": Pump(high, **pump), f"valve{number}": Relief(relief)}
        oil |= {f"on{number}": OilLine(*names, f"pump{number}", f"valve{number}")}
    for name in lines:
        if name.startswith("gas"):
            each = draft.drawn.plan.members[name]
            block = AccumulatorBlock([Accumulator(volume=3e-3, charge=20e5), Accumulator(volume=2e-3, charge=35e5)])
            options = dict(charge_pressure=each.charge_pressure, seal_friction=each.seal_friction, exponent=float(given.choice([1.0, 1.3])))
            strokes = dict.fromkeys(draft.spans, 0.0)
            circuits |= {name: FloatCircuit(each.cylinder, block, **options)}
            oil |= {name: OilLine(each.cylinder, block, at=strokes, **options)}
    return draft, draft.machine(PLAIN, "Drawn", **circuits), draft.machine(PLAIN, "Drawn", **oil), held, fed


def groups_of(draft, held):
    """Return the cylinders that are held, those of one stroke together."""
    strokes = dict.fromkeys(each.stroke for each in draft.holders if each.member)
    return [[each.member for each in draft.holders if each.stroke == stroke and each.member in held] for stroke in strokes]


SPELLED = first_daily(3, "seed", [1, 3, 5, 0, 2, 4, *range(6, 80)])


def answers_of(machine, draft, held, fed):
    """Return what a machine's cylinders and lines say over the strokes, by what was asked."""
    motion, members = machine.at(**draft.strokes()), machine.plan.members
    found = {f"pins {name}": value for name, value in pin_forces(motion).thrusts.items()}
    for name in (*held, *fed):
        for way in DIRECTIONS:
            found |= attempt(f"thrust {name} {way}", partial(members[name].thrust, motion, direction=way))
            found |= attempt(f"pressure {name} {way}", partial(members[name].pressure, motion, direction=way))
    for line in [each for name, each in members.items() if name.startswith("on")]:
        for what in ("pressure_for", "reserve", "holding", "lowering", "taken", "time"):
            found |= attempt(f"{what} {line.name}", partial(getattr(line, what), motion))
        for point in draft.moving[:2]:
            found |= attempt(f"capacity {line.name} {point}", partial(line.capacity, motion, point))
    return found


@SPELLED
def test_circuits_and_lines_are_two_spellings_to_the_last_bit(seed):
    draft, circuits, oil, held, fed = spelled(seed)
    first, second = (answers_of(each(), draft, held, fed) for each in (circuits, oil))
    assert set(first) == set(second) and len(first) > 6 * len((*held, *fed))
    for name, value in first.items():
        assert same_bits(value, second[name]), name


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_their_verdicts_are_the_same_sentences(seed):
    _, circuits, oil, _, _ = spelled(seed)
    assert [str(each) for each in circuits().verdicts()] == [str(each) for each in oil().verdicts()]


def attempt(name, ask):
    """Return an answer by a name; where it is refused the first words of that."""
    try:
        return {name: ask()}
    except LinkageError as error:
        return {name: type(error).__name__}


def same_bits(one, other):
    if isinstance(one, str) or isinstance(other, str):
        return one == other
    if isinstance(one, (Holding, Lowering)):
        return all(same_bits(getattr(one, each.name), getattr(other, each.name)) for each in fields(one))
    return np.array_equal(np.asarray(one), np.asarray(other), equal_nan=np.asarray(one).dtype.kind == "f")
