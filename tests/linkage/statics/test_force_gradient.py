"""Gradients of thrusts and pin forces: exact against differences of the forces, over every shipped machine, and by laws they keep."""

import warnings
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from linkage import (
    DefinitionError,
    Force,
    LinkMass,
    Moment,
    Rope,
    SingularError,
    SingularWarning,
    Spring,
    Weight,
    distance,
    drive_force,
    driving_force,
    pin_force,
    pin_forces,
    ratio,
    y,
)
from mechanisms.classics.front_loader import FrontLoader
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all
from tests.laws.test_statics_laws import daily, random_machines, shipped
from tests.linkage.assembly.test_groups import Platform
from tests.linkage.motion.test_gradient import mid


def few():
    """Return the machines of every day: those that are not large."""
    return [each for each in [*daily(), *random_machines()[::4], Platform] if len(each.plan.points) <= 10]


def half(part):
    """Run a law over one half of these machines, and over all others under `slow`."""
    return for_all(
        "machine", lambda: few()[part::2], slow=lambda: [each for each in [*shipped(), *random_machines()] if each not in few()[part::2]]
    )


STEPS = np.array([1.0, 2.0, 4.0])
ALONE = {"n", "atmosphere", "line1.exponent", "line2.exponent", "charge3"}
"""Of the header balancers: exponents are 1 or more, the atmosphere is one for all, and header 3 is charged to where a pair joins."""


@pytest.fixture(autouse=True)
def _near_dead_points():
    """Classics come close to their dead points, and say so."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", SingularWarning)
        yield


def loaded(machine):
    """Return the machine's class with a weight at every moving point and one of each other load, all with variables of their own."""
    last = machine.plan.moving[-1]
    bodies = [each.points[:2] for each in machine.plan.links[1:] if len(each.points) > 1]
    members = {f"w{k}": Weight(point, mass=50.0 + 17.0 * k) for k, point in enumerate(machine.plan.moving)}
    members["tug"] = Force(last, (300.0, -120.0))
    for body in bodies[:1]:
        members |= {"twist_put_on": Moment(body, M=40.0), "own": LinkMass(body, mass=8.0, at=(0.1, 0.02))}
    members["spring"] = Spring([*machine.plan.ground, *machine.plan.moving][0], last, stiffness=900.0, free_length=0.13)
    return type(f"Loaded{machine.__name__}", (machine,), members)


@cache
def compared(machine):
    """Return the motion of a loaded machine, and what its derivatives by all variables are compared with."""
    own = loaded(machine)
    return own().at(**mid(machine)), Differences(own, mid(machine))


def is_open_tank(machine, name):
    """Return whether a number is the pressure of a tank that has none: next to none would be a mistake in its unit."""
    return name.endswith(".pressure") and machine.plan.defaults[name] == 0.0


def locks(machine, name):
    """Return whether another bore or rod alone would lock a double line that is closed: there are no forces of such a design."""
    if not name.endswith((".bore", ".rod")):
        return False
    try:
        driving_force(machine(**{name: 1.001 * machine.plan.defaults[name]}).at(**mid(machine)), drive=next(iter(machine.plan.strokes)))
    except DefinitionError as error:
        return "locks the machine" in str(error)
    return False


class Differences:
    """Derivatives by all variables from one batch of designs: central differences, extrapolated twice (Richardson)."""

    def __init__(self, machine, strokes):
        names = [name for name in machine.plan.table.entries if name not in ALONE and not name.startswith("line3.")]
        names = [name for name in names if not name.endswith(".exponent") and not is_open_tank(machine, name) and not locks(machine, name)]
        self.names, start = names, machine().dimensions
        self.steps = {name: 2e-4 * max(0.1, abs(start[name])) for name in self.names}
        shape = (len(self.names), 2, len(STEPS))
        values = {name: np.full(shape, value) if name in self.names else value for name, value in start.items()}
        for place, name in enumerate(self.names):
            values[name][place] += np.multiply.outer([1.0, -1.0], STEPS) * self.steps[name]
        design = machine()
        design._values = {name: np.ravel(value) if np.ndim(value) else value for name, value in values.items()}
        self.motion, self.shape = design.at(**strokes), shape

    def of(self, forces):
        """Return the derivatives, shape (variables, ...), of forces (designs, ...)."""
        found = forces.reshape(*self.shape, *forces.shape[1:])
        steps = np.multiply.outer(list(self.steps.values()), STEPS).reshape(*found[:, 0].shape[:2], *(1,) * (found.ndim - 3))
        one, two, four = np.moveaxis((found[:, 0] - found[:, 1]) / (2.0 * steps), 1, 0)
        near, wide = (4.0 * one - two) / 3.0, (4.0 * two - four) / 3.0
        return (16.0 * near - wide) / 15.0

    def check(self, found, forces, tell):
        """Compare gradients with these derivatives, to 1e-7 of the largest that they could be."""
        size = np.abs(forces).max()
        assert np.abs(found).max() > 0.0, tell
        for name, each, wanted in zip(self.names, found, self.of(forces), strict=True):
            scale = np.abs(wanted).max() + 1e-2 * size / self.steps[name]
            assert_allclose(each, wanted, rtol=0, atol=1e-7 * scale, err_msg=f"{tell} by {name}")


@pytest.mark.slow
@half(0)
def test_gradient_of_thrust_is_the_difference_of_designs(machine):
    motion, differences = compared(machine)
    for drive in machine.plan.strokes:
        found = motion.gradient(drive_force(drive), differences.names)
        differences.check(found, driving_force(differences.motion, drive=drive), drive)


@half(1)
def test_gradient_of_pin_forces_is_the_difference_of_designs(machine):
    motion, differences = compared(machine)
    if any(rope.against for rope in machine.plan.of_kind(Rope).values()):
        pytest.skip("which of two ropes pulls is told pose by pose")
    joints = [each for each in pin_forces(differences.motion).joints if each.has_force]
    alone = [each for each in joints if sum((each.point, each.on) in ((o.point, o.on), (o.point, o.by)) for o in joints) == 1]
    sliding = [(each, "couple") for each in joints if np.any(each.couple)][:1]
    for joint, component in ((alone[0], "x"), (alone[len(alone) // 2], "y"), (alone[-1], "size"), *sliding):
        found = motion.gradient(pin_force(joint.point, joint.on, component, by=joint.by), differences.names)
        parts = {"x": joint.force[0], "y": joint.force[1], "size": joint.size, "couple": joint.couple}
        differences.check(found, parts[component], f"{joint}, {component}")


# -- laws ------------------------------------------------------------------------------------------------------


class Hitch(ThreePointHitch):
    """The hitch with weights of its own."""

    load = Weight("G", mass=1200.0)
    lower = LinkMass("E D F", mass=30.0)
    arm = LinkMass("O B C", mass=25.0)


ASKED = {"thrust": drive_force(), "C": pin_force("C", "CD"), "E": pin_force("E", component="x"), "K": pin_force("K", component="y")}
REQUESTS = pytest.mark.parametrize("asked", ASKED.values(), ids=ASKED)
STROKE = np.linspace(0.01, 0.24, 9)


@REQUESTS
def test_forces_are_of_first_degree_in_all_masses(asked):
    """Euler: the sum of mass times the derivative by it is the force."""
    hitch, masses = Hitch(), ["load.mass", "lower.mass", "arm.mass"]
    slopes = hitch.at(S=STROKE).gradient(asked, masses)
    total = sum(hitch[name] * slope for name, slope in zip(masses, slopes, strict=True))
    (force,) = hitch.evaluate([asked], S=STROKE)
    assert np.abs(slopes[0]).min() > 0.1
    assert_allclose(total, force, rtol=1e-12)


@REQUESTS
def test_forces_of_weights_do_not_change_with_the_scale(asked):
    """All lengths and the stroke grow alike: the sum of length times derivative is zero. The stroke stands only in L0 + S."""
    hitch = Hitch()
    names = [name for name, entry in hitch.plan.table.entries.items() if entry.kind in ("length", "coordinate") or name == "L0"]
    slopes = dict(zip(names, hitch.at(S=STROKE).gradient(asked, names), strict=True))
    parts = np.array([*(hitch[name] * slope for name, slope in slopes.items()), STROKE * slopes["L0"]])
    assert {"A.x", "OB", "FG"} <= set(names) and np.abs(parts).max() > 1e3
    assert_allclose(parts.sum(axis=0), 0.0, atol=1e-12 * np.abs(parts).max())


def test_the_gradient_of_thrust_is_that_of_the_energys_ratio():
    motion, wrt = Hitch(**{"lower.mass": 0.0, "arm.mass": 0.0}).at(S=STROKE), ["M.x", "CD", "KFG"]
    assert_allclose(motion.gradient(drive_force(), wrt), 1200.0 * 9.80665 * motion.gradient(ratio(y("G")), wrt), rtol=1e-11)


def test_a_stiffness_counts_in_proportion_and_a_free_length_by_it():
    class Sprung(ThreePointHitch):
        relief = Spring("M", "F", stiffness=2e4, free_length=0.4)

    motion = Sprung().at(S=STROKE)
    by_stiffness, by_length, by_bore = motion.gradient(drive_force(loads="relief"), ["relief.stiffness", "relief.free_length", "lift.bore"])
    assert_allclose(2e4 * by_stiffness, driving_force(motion, "relief"), rtol=1e-12)
    assert_allclose(by_length, -2e4 * motion.ratio(distance("M", "F")), rtol=1e-10)
    assert_array_equal(by_bore, np.zeros(9))


# -- shapes and refusals -----------------------------------------------------------------------------------------


@REQUESTS
def test_batches_of_designs_have_gradients_each(asked):
    sizes, masses = np.linspace(0.28, 0.32, 4), np.array([900.0, 1500.0])
    batch = Hitch(OB=sizes[:, None], **{"load.mass": masses}).at(S=STROKE).gradient(asked, ["OB", "load.mass", "M.y"])
    assert batch.shape == (3, 4, 2, 9)
    for place, OB in enumerate(sizes):
        one = Hitch(OB=OB, **{"load.mass": 1500.0}).at(S=STROKE).gradient(asked, ["OB", "load.mass", "M.y"])
        assert_allclose(batch[:, place, 1], one, rtol=1e-10, atol=1e-9)


def test_a_gradient_over_two_strokes_is_a_grid():
    machine = loaded(FrontLoader)
    first, second = machine.plan.strokes
    motion = machine().sweep(**{first: 3, second: 4})
    found = motion.gradient(drive_force(second), ["w0.mass", "tug.x"])
    assert found.shape == (2, 3, 4)
    assert_allclose(found[0], driving_force(motion, [Weight(machine.plan.moving[0], mass=1.0)], second), atol=1e-9)


@pytest.mark.slow
def test_at_a_dead_point_it_is_refused_and_out_of_reach_it_is_nan():
    hitch = Hitch()
    dead = float(np.hypot(*(hitch["O"] - hitch["A"])) + hitch["OB"] - hitch["L0"])
    for asked, what in ((drive_force(), "driving force of S"), (pin_force("B", "AB"), "size of the force at B")):
        with pytest.raises(SingularError, match=f"gradient of the {what}"):
            hitch.at(S=[0.1, dead]).gradient(asked, ["OB"])
        found = hitch.at(S=[0.1, dead, 0.6], unreachable="nan").gradient(asked, ["OB", "A.x"])
        assert_array_equal(np.isnan(found), np.broadcast_to([False, True, True], (2, 3)))
