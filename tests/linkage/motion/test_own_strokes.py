"""Each design of a batch at strokes of its own gives what it gives alone, in every reading; what has one answer for all refuses."""

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from linkage import (
    LEFT,
    AssemblyError,
    Crank,
    DefinitionError,
    Dyad,
    Ground,
    Mechanism,
    OnLink,
    PinFriction,
    Stroke,
    Weight,
    angle,
    drive_force,
    driving_force,
    least,
    pin_force,
    pin_forces,
    ratio,
)
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all


class Turning(Mechanism):
    """A drag link, whose directions go on past whole turns, with a pointer that counts them."""

    phi = Stroke(0.0, 12.0)
    A, O, D = Ground(0.0, 0.0), Ground(0.1, 0.0), Ground(1.0, 0.3)
    B = Crank(A, AB=0.4, angle=phi)
    C = Dyad(B, O, BC=0.45, OC=0.4, side=LEFT)
    turn = angle(C, B)
    load = Weight(C, mass=10)


class Counting(Turning):
    """Its pointer hangs on the number of turns."""

    E = Crank("D", DE=0.2, angle=-0.7 * angle("C", "B"))


class Arms(Mechanism):
    """Two arms, one on the other, each with a stroke of its own, and friction in the frame's pin."""

    phi, psi = Stroke(0.2, 1.2), Stroke(-0.5, 0.5)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=0.8, angle=phi)
    B = OnLink(O, A, OB=0.5, AOB=0.1)
    C = OnLink(A, B, AC=0.9, BAC=psi + 2.0)
    load = Weight(C, mass=50)
    rubs = PinFriction(O, radius=0.03, coefficient=0.1)


HITCHES = ThreePointHitch(OB=np.linspace(0.29, 0.31, 3))
OWN = np.array([0.0, 0.05, 0.1])[:, None] + np.linspace(0.0, 0.1, 7)


def alone(machine, k, **strokes):
    """Return a design of a batch alone, at its own strokes."""
    design = type(machine)(**{name: value if np.ndim(value) == 0 else value[k] for name, value in machine.dimensions.items()})
    return design.at(**{name: value[k] for name, value in strokes.items()})


def close(ours, theirs):
    scale = np.nanmax(np.abs(theirs))
    assert_allclose(ours, theirs, rtol=0.0, atol=1e-15 * max(1.0, scale) * 4.0)


READINGS = {
    "places": lambda motion: motion["G"],
    "an output": lambda motion: motion["tilt"],
    "ratios": lambda motion: motion.ratio("G"),
    "of second order": lambda motion: motion.ratio("G", order=2),
    "by differences": lambda motion: motion.ratio("G", method="central"),
    "transmission": lambda motion: motion.transmission_angle("K"),
    "speeds": lambda motion: motion.velocity("G", rates=dict(S=0.1)),
    "a drive's force": lambda motion: driving_force(motion),
    "a request": lambda motion: motion[pin_force("F") * ratio("tilt")],
    "a pin's force": lambda motion: pin_forces(motion).force("F"),
}


@for_all("read", READINGS.values(), ids=READINGS)
def test_each_design_reads_as_alone(read):
    ours = read(HITCHES.at(S=OWN, per_design=True))
    for k in range(3):
        close(ours[..., k, :], read(alone(HITCHES, k, S=OWN)))


def test_gradients():
    ours = HITCHES.at(S=OWN, per_design=True).gradient(pin_force("F"), wrt=["OC", "CD"])
    for k in range(3):
        close(ours[..., k, :], alone(HITCHES, k, S=OWN).gradient(pin_force("F"), wrt=["OC", "CD"]))


@pytest.mark.parametrize("backend", ["numpy", "floats", None])
def test_values_of_many_poses(backend):
    asked = ["G", ratio("G"), drive_force(), pin_force("F"), "tilt"]
    out = np.empty((7, 3, 7))
    ours = HITCHES.evaluate(asked, S=OWN, per_design=True, backend=backend, out=out)
    assert np.shares_memory(ours[0], out)
    for k in range(3):
        theirs = alone(HITCHES, k, S=OWN)
        for mine, each in zip(ours, asked, strict=True):
            assert_allclose(mine[..., k, :], theirs[each], rtol=1e-14, atol=1e-15)


@pytest.mark.parametrize("kind", [Turning, Counting])
def test_angles_go_on_along_the_strokes_of_each_design(kind):
    machine = kind(OC=np.array([0.38, 0.4, 0.42, 0.41]))
    phi = np.array([0.0, 9.0, 3.0, 6.5])[:, None] + np.linspace(0.0, 3.0, 40)
    phi[2] = phi[2, ::-1]  # in whatever order they stand
    motion = machine.at(phi=phi, per_design=True)
    (turned,) = machine.evaluate(["turn"], phi=phi, per_design=True)
    for k in range(4):
        theirs = alone(machine, k, phi=phi)
        for name in ("C", "E") if kind is Counting else ("C",):
            close(motion[name][:, k], theirs[name])
        close(motion["turn"][k], theirs["turn"])
        close(turned[k], theirs["turn"])


def test_several_strokes_go_on_along_a_path_of_each_design():
    machine = Arms(OA=np.array([0.8, 0.9]), AC=np.array([0.9, 0.85]))
    phi = np.array([np.linspace(0.2, 0.6, 5), np.linspace(1.2, 0.5, 5)])
    psi = np.array([np.linspace(-0.5, 0.4, 5), np.linspace(0.1, 0.3, 5)])
    motion = machine.at(phi=phi, psi=psi, per_design=True)
    for k in range(2):
        theirs = alone(machine, k, phi=phi, psi=psi)
        for drive in ("phi", "psi"):
            asked = dict(drive=drive, direction="extending")
            close(driving_force(motion, **asked)[k], driving_force(theirs, **asked))
        close(pin_forces(motion, direction="retracting").drives["phi"][k], pin_forces(theirs, direction="retracting").drives["phi"])
    assert motion.shape == (2, 5)
    grid = machine.at(phi=phi[:, :, None], psi=psi[:, None, :], per_design=True)
    assert grid["C"].shape == (2, 2, 5, 5)
    close(grid["C"][:, 1], alone(machine, 1, phi=phi[:, :, None], psi=psi[:, None, :])["C"])


def test_shapes_of_designs_and_strokes():
    one_each = HITCHES.at(S=OWN[:, 3], per_design=True)
    assert one_each["G"].shape == (2, 3)
    close(one_each["G"][:, 1], alone(HITCHES, 1, S=OWN)["G"][:, 3])
    table = ThreePointHitch(OB=np.linspace(0.29, 0.31, 3)[:, None], CD=np.array([0.61, 0.62]))
    own = OWN[:, None, :] + np.array([0.0, 0.01])[:, None]
    close(table.at(S=own, per_design=True)["G"][:, 2, 1], ThreePointHitch(OB=0.31, CD=0.62).at(S=own[2, 1])["G"])
    shared = HITCHES.at(S=OWN[:1], per_design=True)  # ones in the place of the designs: all have these
    assert_array_equal(shared["G"], HITCHES.at(S=OWN[0])["G"])
    assert_array_equal(ThreePointHitch().at(S=OWN[0], per_design=True)["G"], ThreePointHitch().at(S=OWN[0])["G"])
    assert HITCHES.at(S=OWN)["G"].shape == (2, 3, 3, 7)


@pytest.mark.parametrize("wrong", [OWN[:2], OWN.T, OWN[0]])
def test_strokes_that_do_not_fit_the_designs_are_refused(wrong):
    words = r"ThreePointHitch: the strokes of each design begin with the shape of the designs, \(3,\); S has the shape"
    for ask in (lambda: HITCHES.at(S=wrong, per_design=True), lambda: HITCHES.evaluate(["G"], S=wrong, per_design=True)):
        with pytest.raises(DefinitionError, match=words):
            ask()


def test_anything_but_yes_or_no_is_refused():
    with pytest.raises(DefinitionError, match="per_design=1: True or False is expected"):
        HITCHES.at(S=OWN, per_design=1)


def test_out_of_reach():
    far = OWN + np.array([0.0, 0.0, 0.35])[:, None]
    with pytest.raises(AssemblyError, match=r"B = Dyad\(A, O\) cannot be assembled at 7 of 21 strokes") as raised:
        HITCHES.at(S=far, per_design=True)
    with pytest.raises(AssemblyError, match=r"B = Dyad\(A, O\) cannot be assembled at 7 of 21 strokes"):
        HITCHES.evaluate(["G"], S=far, per_design=True)
    motion = HITCHES.at(S=far, per_design=True, unreachable="nan")
    assert motion.reached[:2].all() and not motion.reached[2].any()
    assert_array_equal(raised.value.mask, ~motion.reached)


def test_what_has_one_domain_for_all_designs_refuses():
    motion = HITCHES.at(S=OWN, per_design=True)
    for ask in (lambda: HITCHES.verdicts(motion), lambda: HITCHES.answers([least(drive_force())], motion), lambda: motion.over):
        with pytest.raises(DefinitionError, match="ThreePointHitch: in this motion each design has strokes of its own"):
            ask()
    with pytest.raises(DefinitionError, match="one design at a time"):
        motion.limits()
    assert "shape (3, 7)" in repr(motion)
