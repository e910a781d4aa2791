"""Links of one plane that do not cross, as a condition of a synthesis: checked at 5,001 poses by segments of their own."""

import numpy as np
import pytest

from linkage import Featured, FunctionTask, PathTask, Planes, around, clearance, least, mm, synthesise
from mechanisms.classics.four_bar import FourBar
from mechanisms.classics.stephenson_three import StephensonThree
from tests.linkage.synthesis.bars_apart import fixed, four_bar, meet, pairs_apart

WIDTH = 10 * mm
TURN = np.linspace(0.0, 2.0 * np.pi, 5001)
APART = [least(clearance()) >= 5 * mm]
CROSSING = dict(OA=0.0633, AB=0.0721, CB=0.0921, C=(0.0865, 0.0), AP=0.05)
"""A crank rocker whose crank comes within 6.6 mm of its rocker's centre line."""


class Flat(FourBar):
    """A four-bar of bars 10 mm wide, all in one plane."""

    planes = Planes("OA ABP CB", width=WIDTH)


class FlatSix(StephensonThree):
    """A six-bar of bars 10 mm wide, all in one plane but the coupler; its rod has no point of its own."""

    P = None
    planes = Planes("OA CB DF EF", "ABD", width=WIDTH)

    def featured(self) -> Featured:
        return Featured("psi", ["D"])


def six_bar(machine, phi):
    at = four_bar(machine, phi)
    E = fixed(machine, "E")
    D = at["A"] + machine["AD"] / machine["AB"] * (at["B"] - at["A"]) * np.exp(1j * machine["BAD"])
    reached = machine.at(phi=[0.0, 0.5])["F"]
    sides = {sense: meet(D, machine["DF"], E, machine["EF"], sense) for sense in (1.0, -1.0)}
    start = complex(*reached[:, 0])
    F = min(sides.values(), key=lambda each: abs(each[0] - start))
    return at | {"D": D, "E": E + 0.0 * D, "F": F}


@pytest.mark.parametrize("timed", [True, pytest.param(False, marks=pytest.mark.slow)])
def test_a_four_bar_that_crosses_gives_way_to_one_that_does_not(timed):
    phi = np.linspace(0.3, 5.5, 14)
    known = FourBar(**CROSSING)
    assert pairs_apart(four_bar(known, TURN), ["OA CB"]).min() - WIDTH < -3 * mm
    task = PathTask(known.at(phi=phi)["P"].T, of="P", at=phi)
    vary = {
        "OA": (0.01, 0.08), "AB": (0.05, 0.2), "CB": (0.05, 0.2), "AP": (0.01, 0.12), "BAP": (-1.5, 1.5), "C": around(60 * mm),
        "O": around(30 * mm),
    }  # fmt: skip
    found = synthesise(Flat(), path=task, vary=vary, timed=timed, starts=4, subject_to=APART)
    assert 1e-10 < found.error < 1.3e-5
    for each in found.solutions:
        at = four_bar(each.machine, TURN)
        assert pairs_apart(at, ["OA CB"]).min() - WIDTH >= 5 * mm * (1 - 1e-9)
    assert any("least(clearance()) >= 0.005 is missed" in str(miss) for miss in found.misses)


@pytest.mark.slow
def test_a_six_bar_keeps_its_bars_apart_over_the_whole_turn():
    six = StephensonThree()
    phi = np.linspace(0.0, 2.0 * np.pi, 13)[:-1]
    pairs = ["OA CB", "OA DF", "OA EF", "CB DF", "CB EF"]
    assert pairs_apart(six_bar(six, TURN), pairs).min() == 0.0
    vary = {"E": around(80 * mm), "DF": (0.06, 0.3), "EF": (0.08, 0.3), "AD": (0.05, 0.2), "BAD": (-3.0, 3.0)}
    found = synthesise(FlatSix(), function=FunctionTask(phi, six.at(phi=phi)["psi"], of="psi"), vary=vary, starts=4, subject_to=APART)
    assert found.error < 0.05
    for each in found.solutions:
        at = six_bar(each.machine, TURN)
        assert np.isfinite(at["F"]).all()
        assert pairs_apart(at, pairs).min() - WIDTH >= 5 * mm * (1 - 1e-9)
