"""A tipper, a tailgate and a bucket synthesised whole: cylinder of a catalogue, planes, pivots in regions, pin forces and reserve together.

Every answer is looked at again at 5,001 poses by formulas of its own: circles, moments about pins, segments, rays.
"""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from hydraulics import Cylinder, LiftCircuit, catalogue, reserve
from linkage import (
    LEFT,
    RIGHT,
    Dimension,
    Dyad,
    FunctionTask,
    Ground,
    Mechanism,
    OnLink,
    Outline,
    Planes,
    Stroke,
    Weight,
    angle,
    around,
    bar,
    clearance,
    deg,
    kN,
    least,
    mm,
    most,
    outside,
    pin_force,
    synthesise,
    transmission,
)
from linkage.units import g0
from tests.linkage.synthesis.bars_apart import apart, cross, fixed, from_segment, meet
from tests.members import told_by

MANY = 5001


def polar(length, turn):
    return length * np.exp(1j * turn)


def way_of(machine, rows):
    """Return the strokes of an answer, after its row is checked: one of the catalogue, and the pins go from end to end of it."""
    row = tuple(machine[f"lift.{name}"] for name in ("bore", "rod", "stroke", "closed"))
    assert row in [tuple(each) for each in rows]
    S = np.linspace(machine.strokes["S"].start, machine.strokes["S"].end, MANY)
    assert_allclose(machine["L0"] + S[[0, -1]], [row[3], row[3] + row[2]], rtol=1e-12)
    return S


def from_polygon(P, Q, corners):
    """Return how far segments PQ are from a polygon's edges, (n,), zero where they cross one."""
    ends = [complex(*each) for each in corners]
    return np.min([apart(P, Q, a + 0.0 * P, b + 0.0 * P) for a, b in zip(ends, [*ends[1:], ends[0]], strict=True)], axis=0)


def is_inside(place, corners):
    """Return whether a place is in a polygon, by the sum of the angles."""
    arms = np.array([complex(*each) for each in corners]) - place
    return round(float(np.sum(np.angle(np.roll(arms, -1) / arms))) / (2.0 * np.pi)) != 0


def lifted(machine, S, weights):
    """Return of a body that a cylinder AB turns about O: its points, the cylinder's force and the force on the hinge [N], complex (n,).

    `weights` are masses at places of the body, lengths and angles from OB.
    """
    A, O = fixed(machine, "A"), fixed(machine, "O")
    B = meet(A + 0.0 * S, machine["L0"] + S, O, machine["OB"], -1.0)
    along = np.angle(B - O)
    loads = [(O + polar(length, along + turn), -1j * mass * g0) for length, turn, mass in weights]
    way = (B - A) / np.abs(B - A)
    push = -sum(cross(place - O, force) for place, force in loads) / cross(B - O, way)
    hinge = push * way + sum(force for _, force in loads)
    return B, push, hinge


def check_task(answer, task):
    """Check the error of an answer by the cosine rule."""
    machine = answer.machine
    B, _, _ = lifted(machine, np.asarray(task.at), [])
    found = np.angle((B - fixed(machine, "O")) * np.exp(1j * machine["BOT"]))
    assert_allclose(np.sum((found - task.values) ** 2), answer.error, rtol=1e-6, atol=1e-18)


def check_forces(machine, push, hinge, spare, most_on_hinge):
    """Check the reserve of the cylinder where it pushes, and the force on the hinge [N]."""
    force = machine["line.pressure"] * np.pi / 4 * machine["lift.bore"] ** 2
    assert push.max() > 0.0
    assert (force / push[push > 0.0]).min() >= spare * (1 - 1e-9)
    assert np.abs(hinge).max() <= most_on_hinge * (1 + 1e-9)
    assert not [str(each) for each in told_by(machine) if str(each).startswith(("FAIL length", "FAIL clearance", "FAIL lifting"))]


# -- a tipper -----------------------------------------------------------------------------------------------

FRAME = [(0.45, -0.75), (1.5, -0.75), (1.5, -0.40), (1.2, -0.40), (1.2, -0.55), (0.45, -0.40)]
BEAM = [(0.95, -0.42), (1.1, -0.42), (1.1, -0.3), (0.95, -0.3)]


class Tipper(Mechanism):
    """The body OBT tips about O; its cylinder AB stands in the frame and passes a cross beam."""

    S = Stroke(0.0, 0.5)
    L0 = Dimension(0.80)
    O = Ground(0.0, 0.0)
    A = Ground(1.0, -0.7)
    B = Dyad(A, O, AB=L0 + S, OB=1.6, side=RIGHT)
    T = OnLink(O, B, OT=2.4, BOT=2 * deg)
    tip = angle(O, T)
    load = Weight(T, mass=1500.0)
    lift = Cylinder(A, B, bore=100 * mm, rod=56 * mm)
    line = LiftCircuit(lift, pressure=180 * bar)
    frame, beam = Outline(FRAME), Outline(BEAM)
    planes = Planes("lift beam", width=120 * mm)


TIPPER_ROWS = catalogue(bores=[100 * mm, 125 * mm], rods=[63 * mm], strokes=[500 * mm, 630 * mm], dead=320 * mm)


@pytest.mark.slow
def test_a_tipper():
    """Flat at the start, 17 deg after 0.2 m and 45 deg after 0.5 m of the cylinder; a bore of 100 mm has too little to spare."""
    task = FunctionTask([0.0, 0.2, 0.5], [0.0, 17 * deg, 45 * deg], of="tip")
    found = synthesise(
        Tipper(), function=task, vary={"lift": TIPPER_ROWS, "A": around(0.5), "OB": (1.0, 2.2), "BOT": (-20 * deg, 30 * deg)},
        regions={"A": ["frame", outside("beam")]}, starts=4,
        subject_to=[least(clearance()) >= 20 * mm, least(reserve("lift")) >= 3.0, most(pin_force("O")) <= 60 * kN],
    )  # fmt: skip
    assert found.best.most <= 1e-9
    for each in found.solutions:
        assert each.machine["lift.bore"] == 125 * mm
        S = way_of(each.machine, TIPPER_ROWS)
        B, push, hinge = lifted(each.machine, S, [(2.4, each.machine["BOT"], 1500.0)])
        check_task(each, task)
        A = fixed(each.machine, "A")
        assert is_inside(A, FRAME) and not is_inside(A, BEAM)
        assert from_polygon(A + 0.0 * B, B, BEAM).min() - 120 * mm >= 20 * mm * (1 - 1e-9)
        check_forces(each.machine, push, hinge, 3.0, 60 * kN)


# -- a tailgate ---------------------------------------------------------------------------------------------

PANEL = [(-0.7, 0.6), (-0.1, 0.6), (-0.1, 1.3), (-0.3, 1.3), (-0.3, 0.9), (-0.7, 0.9)]
LAMP = (-0.32, 1.12, 0.04)


class Tailgate(Mechanism):
    """The gate OT hangs from O; its cylinder AB stands on the side panel and passes a lamp."""

    S = Stroke(0.0, 0.32)
    L0 = Dimension(0.48)
    O = Ground(0.0, 1.5)
    A = Ground(-0.35, 0.95)
    B = Dyad(A, O, AB=L0 + S, OB=0.25, side=RIGHT)
    T = OnLink(O, B, OT=0.8, BOT=-5 * deg)
    swing = angle(O, T)
    leaf = Weight(T, mass=120.0)
    lift = Cylinder(A, B, bore=32 * mm, rod=20 * mm)
    line = LiftCircuit(lift, pressure=160 * bar)
    panel, lamp = Outline(PANEL), Outline.circle(at=LAMP[:2], radius=LAMP[2])
    planes = Planes("lift lamp", width=30 * mm)


TAILGATE_ROWS = catalogue(bores=[32 * mm, 40 * mm], rods=[20 * mm], strokes=[250 * mm, 320 * mm], dead=160 * mm)


@pytest.mark.slow
def test_a_tailgate():
    """It hangs at the start, stands at 40 deg below level after 0.18 m, 5 deg below after 0.32 m: a stroke of 250 mm does not reach."""
    task = FunctionTask([0.0, 0.18, 0.32], [-90 * deg, -40 * deg, -5 * deg], of="swing")
    found = synthesise(
        Tailgate(), function=task, vary={"lift": TAILGATE_ROWS, "A": around(0.4), "OB": (0.15, 0.5), "BOT": (-40 * deg, 40 * deg)},
        regions={"A": ["panel", outside("lamp")]}, starts=4,
        subject_to=[least(clearance()) >= 10 * mm, least(reserve("lift")) >= 1.5, most(pin_force("O")) <= 8 * kN],
    )  # fmt: skip
    assert found.solutions
    for each in found.solutions:
        assert each.machine["lift.stroke"] == 320 * mm
        S = way_of(each.machine, TAILGATE_ROWS)
        B, push, hinge = lifted(each.machine, S, [(0.8, each.machine["BOT"], 120.0)])
        check_task(each, task)
        A = fixed(each.machine, "A")
        assert is_inside(A, PANEL) and abs(A - complex(*LAMP[:2])) >= LAMP[2]
        assert (from_segment(complex(*LAMP[:2]) + 0.0 * B, A + 0.0 * B, B) - LAMP[2]).min() - 30 * mm >= 10 * mm * (1 - 1e-9)
        check_forces(each.machine, push, hinge, 1.5, 8 * kN)


# -- a bucket -----------------------------------------------------------------------------------------------


class Bucket(Mechanism):
    """On the arm: the cylinder EP turns the lever NP, the rod PQ turns the bucket KQT, whose edge T is loaded."""

    S = Stroke(0.0, 0.4)
    L0 = Dimension(0.86)
    E, N, K = Ground(0.0, 0.45), Ground(1.05, 0.05), Ground(1.40, 0.0)
    P = Dyad(E, N, EP=L0 + S, NP=0.38, side=LEFT)
    Q = Dyad(P, K, PQ=0.45, KQ=0.32, side=LEFT)
    T = OnLink(K, Q, KT=0.8, QKT=-100 * deg)
    dig = angle(K, T)
    soil = Weight(T, mass=300.0)
    lift = Cylinder(E, P, bore=80 * mm, rod=45 * mm, works="both")
    line = LiftCircuit(lift, pressure=180 * bar)
    planes = Planes("lift KQT", width=90 * mm)


BUCKET_ROWS = catalogue(bores=[50 * mm, 63 * mm], rods=[36 * mm], strokes=[320 * mm, 400 * mm], dead=460 * mm)


@pytest.mark.slow
def test_a_bucket():
    """It lies open at the start, is at 28 deg below level after 0.2 m and closed after 0.4 m: a stroke of 320 mm does not reach."""
    task = FunctionTask([0.0, 0.2, 0.4], [10 * deg, -28 * deg, -75 * deg], of="dig")
    lengths = {"NP": (0.25, 0.5), "PQ": (0.3, 0.6), "KQ": (0.2, 0.45), "QKT": (-130 * deg, -70 * deg)}
    kept = [least(clearance()) >= 20 * mm, least(reserve("lift")) >= 4.0]
    kept += [least(transmission("Q")) >= 35 * deg, most(pin_force("K")) <= 14 * kN]
    found = synthesise(Bucket(), function=task, vary={"lift": BUCKET_ROWS, **lengths}, starts=4, subject_to=kept)
    assert found.best.most <= 1e-9
    for each in found.solutions:
        machine = each.machine
        S = way_of(machine, BUCKET_ROWS)
        E, N, K = (fixed(machine, name) + 0.0 * S for name in "ENK")
        P = meet(E, machine["L0"] + S, N, machine["NP"], 1.0)
        Q = meet(P, machine["PQ"], K, machine["KQ"], 1.0)
        T = K + polar(0.8, np.angle(Q - K) + machine["QKT"])
        told = np.interp(task.at, S, np.unwrap(np.angle(T - K)))
        assert_allclose(told, task.values, atol=1e-6)
        corner = np.abs(np.angle((P - Q) / (K - Q)))
        assert np.minimum(corner, np.pi - corner).min() >= 35 * deg * (1 - 1e-9)
        gap = np.min([apart(E, P, K, Q), apart(E, P, Q, T), apart(E, P, T, K)], axis=0) - 90 * mm
        assert gap.min() >= 20 * mm * (1 - 1e-9)
        rod, ram, lever = ((to - at) / np.abs(to - at) for at, to in ((P, Q), (E, P), (N, P)))
        weight = -1j * 300.0 * g0
        pushed = -cross(T - K, weight) / cross(Q - K, rod)
        assert np.abs(weight + pushed * rod).max() <= 14 * kN * (1 + 1e-9)
        force = pushed * cross(rod, lever) / cross(ram, lever)
        piston, annulus = (np.pi / 4 * (machine["lift.bore"] ** 2 - size) for size in (0.0, machine["lift.rod"] ** 2))
        assert (180 * bar * np.where(force > 0.0, piston, annulus) / np.abs(force)).min() >= 4.0 * (1 - 1e-9)
