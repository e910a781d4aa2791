"""Roberts and Chebyshev: both cognates of any four-bar go along its curve, against the shipped machine that carries all three."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import DefinitionError, OnLink, cognates, five_point
from mechanisms.classics.chebyshev import Chebyshev
from mechanisms.classics.four_bar import DoubleRocker, DragLink, FourBar, Parallelogram, TripleRocker
from mechanisms.classics.hoeken import Hoeken
from mechanisms.classics.roberts_cognates import RobertsCognates
from mechanisms.classics.slider_crank import SliderCrank
from mechanisms.classics.stephenson_three import StephensonThree
from mechanisms.classics.watt_two import WattTwo
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all
from tests.linkage.synthesis.exact_tasks import lengths

MACHINES = [
    (FourBar, "P"), (DragLink, "P"), (DoubleRocker, "P"), (TripleRocker, "P"), (Parallelogram, "P"),
    (Hoeken, "P"), (Chebyshev, "P"), (StephensonThree, "D"), (RobertsCognates, "P"),
]  # fmt: skip


@for_all(("kind", "of"), MACHINES)
def test_both_cognates_go_along_the_path(kind, of):
    machine = kind()
    path = machine.sweep(73)[of]
    found = cognates(machine, of=of)
    assert len(found) == 2 and any(each.runs for each in found)
    for each in found:
        here = np.isfinite(each.strokes)
        assert here.sum() > 25 and each.error < 1e-12
        assert_allclose(each.machine.at(phi=each.strokes[here])["P"], path[:, here], rtol=0, atol=1e-12)
        assert each.machine.sweep(11).reached.all()
        assert each.runs == here.all()


def test_the_links_are_those_of_the_shipped_three():
    shipped = RobertsCognates()
    motion = shipped.at(phi=2.0)
    second, third = cognates(shipped)
    pairs = [(second.machine, ("UC", "CD", "WD")), (third.machine, ("WE", "EF", "VF"))]
    for machine, names in pairs:
        wanted = [float(motion.distance(*name)) for name in names]
        assert_allclose(sorted(lengths(machine)), sorted(wanted), rtol=1e-12)


def test_the_third_has_the_machines_own_timing():
    machine = FourBar()
    _, third = cognates(machine)
    own, phi = machine.sweep(73), np.linspace(0.0, 2 * np.pi, 73)
    assert_allclose(np.mod(np.diff(third.strokes), 2 * np.pi), np.diff(phi), rtol=1e-9)
    assert third.machine.four_bars[0].kind == machine.four_bars[0].kind
    ratios = third.machine.at(phi=third.strokes).ratio("P")
    assert_allclose(ratios, own.ratio("P"), rtol=0, atol=1e-11)


def test_a_cognate_of_a_cognate_is_the_machine_again():
    machine = FourBar()
    third = cognates(machine)[1].machine
    again = [sorted(lengths(each.machine)) for each in cognates(third)]
    assert any(np.allclose(each, sorted(lengths(machine)), rtol=1e-10) for each in again)


@pytest.mark.slow
def test_cognates_of_what_a_synthesis_found():
    """Both cognates of a four-bar through five points go through these."""
    phi = np.radians([20.0, 60.0, 110.0, 170.0, 230.0])
    points = FourBar().at(phi=phi)["P"].T
    own = five_point([(0, 0), (0.1, 0)], points).best.machine
    third = cognates(own)[1].machine
    path = third.sweep(20001)["P"]
    for point in points:
        assert np.hypot(*(path - point[:, None])).min() < 1e-4 * 0.3


@for_all(
    ("machine", "of", "message"),
    [
        (SliderCrank(), "A", "no coupler"),
        (FourBar(), "A", "whose path is an arc"),
        (FourBar(), "O", "a point that moves"),
        (ThreePointHitch(), "G", "no coupler"),
        (StephensonThree(), "F", "no coupler"),
        (FourBar(OA=[0.04, 0.05]), "P", "one design"),
        (FourBar, "P", "is a class"),
    ],
)
def test_machines_without_cognates_are_told(machine, of, message):
    with pytest.raises(DefinitionError, match=message):
        cognates(machine, of=of)


def test_a_point_of_a_six_bars_own_four_bar():
    class WithPoint(WattTwo):
        Q = OnLink("A", "B", AQ=0.05, BAQ=0.4)

    machine = WithPoint()
    path = machine.sweep(73)["Q"]
    for each in cognates(machine, of="Q"):
        here = np.isfinite(each.strokes)
        assert_allclose(each.machine.at(phi=each.strokes[here])["P"], path[:, here], rtol=0, atol=1e-12)
