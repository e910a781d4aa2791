"""Where a joint's force acts: at its line's origin, such as the mesh of two wheels, whatever point names it; and joints that are wrong."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import (
    LEFT,
    Crank,
    DefinitionError,
    Dyad,
    Force,
    Ground,
    LinkMass,
    Mechanism,
    OnLink,
    PinFriction,
    SingularError,
    Stroke,
    Weight,
    deg,
    draw,
    driving_force,
    pin_force,
    pin_forces,
)
from linkage.quantities import FRAME_SIDE, Driven, Joint, JointSide, name_of, quantity
from linkage.steps import Bar, Point
from linkage.vectors import Line, Vec
from tests.for_all import for_all
from tests.mechanisms.free_bodies import FreeBodies, places

PRESSURE = 20 * deg


class Wheel(Point):
    """A point at `reach` on a wheel about M that meshes with one about O, turned by `angle` with the body O A, or standing still.

    `radii` are those of both pitch circles. Whatever `said` changes of its joint is the test's.
    """

    def __init__(self, O, A, M, angle, radii, reach, **said):
        self.O, self.A, self.M, self.angle, self.radii, self.reach, self.said = O, A, M, quantity(angle), radii, quantity(reach), said

    def parts(self):
        return self.O, *([self.A] if self.A else []), self.M, self.angle, self.reach

    def place(self, where):
        first, second = self.radii
        turn = where.value(self.angle) * (-first / second if self.A else 1.0 + first / second)
        return where.at(name_of(self.M)) + Vec(np.cos(turn), np.sin(turn)) * where.value(self.reach)

    def bars(self):
        return (Bar(name_of(self.M), self.name, self.reach),)

    def mesh(self, where):
        """Return the common tangent's normal at the mesh, tilted by the pressure angle, so that the teeth push across the line."""
        O, M = where.at(name_of(self.O)), where.at(name_of(self.M))
        u = (M - O) * (1.0 / (M - O).length())
        return Line(O + u * (self.radii[0] + self.said.get("shift", 0.0)), u.turned(np.cos(PRESSURE), np.sin(PRESSURE)))

    def joints(self):
        by = JointSide((name_of(self.O), name_of(self.A))) if self.A else FRAME_SIDE
        given = {"point": self.name, "on": JointSide((name_of(self.M), self.name)), "by": by, "holds": "n", "line": self.mesh}
        said = {name: value for name, value in self.said.items() if name != "shift"}
        return (Joint("mesh", **(given | said)),)

    def __str__(self):
        return f"Wheel({self.O}, {self.A}, {self.M})"


class Train(Mechanism):
    """A crank's wheel turns a larger one with an eccentric load."""

    phi = Stroke(0.2, 2.9)
    O, M = Ground(0.0, 0.0), Ground(0.3, 0.0)
    A = Crank(O, OA=0.08, angle=phi)
    B = Wheel(O, A, M, phi, (0.1, 0.2), 0.16)
    load = Weight(B, mass=40)
    side = Force(B, (120.0, 0.0))


def train(**said):
    return type("Other", (Train,), {"__doc__": "Other", "B": Wheel("O", "A", "M", "phi", (0.1, 0.2), 0.16, **said)})


class Planet(Mechanism):
    """A planet wheel on an arm rolls around a wheel that stands still; what hangs on its rim pulls a rod."""

    phi = Stroke(0.3, 1.2)
    O, C = Ground(0.0, 0.0), Ground(0.9, 0.3)
    M = Crank(O, OM=0.3, angle=phi)
    B = Wheel(O, None, M, phi, (0.1, 0.2), 0.15)
    D = Dyad(B, C, BD=0.5, CD=0.45, side=LEFT)
    T = OnLink(C, D, CT=0.6)
    load = Weight(T, mass=80)
    own = LinkMass("M B", mass=12)


# By hand.


@pytest.mark.parametrize("point", ["B", "A", "O", "M"])
def test_the_force_acts_at_the_mesh_whatever_point_names_the_joint(point):
    machine = train(point=point)()
    motion = machine.sweep(7)
    forces = pin_forces(motion)
    assert forces.gap < 1e-12 and forces.residual < 1e-12
    n = np.array([-np.sin(PRESSURE), np.cos(PRESSURE)])
    for k in range(7):
        free, at = FreeBodies(), places(motion, k)
        free.pin("O", "first", "frame", at["O"])
        free.torque("phi", "first", "frame")
        free.pin("M", "second", "frame", at["M"])
        free.along("mesh", "second", "first", np.array([0.1, 0.0]), n)
        free.load("second", at["B"], (120.0, -40 * 9.80665))
        own = free.solve()
        assert_allclose(forces.drives["phi"][k], own["phi"], rtol=1e-10, atol=1e-9)
        (mesh,) = [each for each in forces.joints if each.kind == "mesh"]
        assert_allclose(mesh.place, np.broadcast_to([[0.1], [0.0]], (2, 7)), atol=1e-15)
        assert_allclose(mesh.force[:, k], own["mesh"] * n, rtol=1e-10, atol=1e-9)
        for pin, on in (("O", "O A"), ("M", "M B")):
            (found,) = [each for each in forces.at(pin) if each.kind == "pin"]
            sign = 1.0 if found.on == forces.body_named(on) else -1.0
            assert_allclose(sign * found.force[:, k], [own[pin + "x"], own[pin + "y"]], rtol=1e-10, atol=1e-9)


def test_a_mesh_that_moves():
    """The planet's mesh goes round with the arm; the planet balances about it, with the rod's pull from the rocker's own balance."""
    motion = Planet().sweep(7)
    forces = pin_forces(motion)
    assert (Planet().mobility, forces.gap < 1e-12, forces.residual < 1e-12) == (1, True, True)
    (mesh,) = [each for each in forces.joints if each.kind == "mesh"]
    assert_allclose(mesh.place, motion["M"] / 3.0, atol=1e-14)
    for k in range(7):
        free, at = FreeBodies(), places(motion, k)
        u = at["M"] / 0.3
        n = np.array([[np.cos(PRESSURE), -np.sin(PRESSURE)], [np.sin(PRESSURE), np.cos(PRESSURE)]]) @ np.array([-u[1], u[0]])
        free.pin("O", "arm", "frame", at["O"])
        free.torque("phi", "arm", "frame")
        free.pin("M", "planet", "arm", at["M"])
        free.along("mesh", "planet", "frame", at["M"] / 3.0, n)
        free.thrust("rod", "planet", at["B"], "rocker", at["D"])
        free.pin("C", "rocker", "frame", at["C"])
        free.load("rocker", at["T"], (0.0, -80 * 9.80665))
        free.load("planet", (at["M"] + at["B"]) / 2, (0.0, -12 * 9.80665))
        own = free.solve()
        assert_allclose(forces.drives["phi"][k], own["phi"], rtol=1e-9)
        assert_allclose(mesh.force[:, k], own["mesh"] * n, rtol=1e-9, atol=1e-8)


def test_what_acts_on_a_body_goes_by_its_joint_where_it_is_no_point():
    found = pin_forces(Train().sweep(5))
    assert set(found.on_body("M B")) == {"M", "B (mesh)", "B"}
    assert_allclose(sum(found.on_body("M B").values()), 0.0, atol=1e-9)
    assert all(each.place is None for each in found.joints if each.kind != "mesh")


@pytest.mark.slow
def test_pictures_show_it_there():
    for forces in (True, "M B", "frame"):
        assert draw(Train(), forces=forces) is not None
    arrows = [each for each in draw(Train(), forces="M B").axes[0].texts]
    assert arrows


# In programs and with derivatives.


def test_requests_many_poses_and_gradients():
    machine, phi = Train(), np.linspace(0.2, 2.9, 230)
    many, few = pin_forces(machine.at(phi=phi)), pin_forces(machine.at(phi=phi[::23]))
    for ours, theirs in zip(many.joints, few.joints, strict=True):
        assert_allclose(ours.force[..., ::23], theirs.force, rtol=1e-11, atol=1e-9)
    request = pin_force("B", on="M B")
    (found,) = machine.evaluate([request], phi=phi)
    assert_allclose(found, np.hypot(*many.force("B", on="M B")), rtol=1e-12)
    slopes = machine.at(phi=0.7).gradient(request, wrt=["load.mass", "OA"])
    up, down = (Train(**{"load.mass": 40 + step}).evaluate([request], phi=0.7)[0] for step in (1e-3, -1e-3))
    assert_allclose(slopes[0], (up - down) / 2e-3, rtol=1e-7)
    assert_allclose(slopes[1], 0.0, atol=1e-9)


# Joints that are wrong.

WRONG = {
    "the mesh beside its place": {"shift": 0.01},
    "the mesh a hair beside its place": {"shift": 1e-5},
    "at the wheel's point": {"line": lambda where: Line(where.at("B"), Vec(1.0, 0.0 * where.at("B").x))},
    "against the frame": {"by": FRAME_SIDE},
    "a drive that is not there": {"drives": (Driven(Train.plan.strokes["phi"], "n"),)},
}


@for_all("said", WRONG.values(), ids=WRONG)
def test_a_wrong_joint_is_refused_by_name_wherever_forces_are_asked(said):
    machine = train(**said)()
    names = r"Other: B\.joints\(\): the joint 'mesh' at B holds 'n' between .* move against each other by .* a unit of phi.* of line="
    with pytest.raises(DefinitionError, match=names):
        pin_forces(machine.sweep(5))
    with pytest.raises(DefinitionError, match=names):
        pin_forces(machine.sweep(5, unreachable="nan"))
    with pytest.raises(DefinitionError, match=names):
        pin_forces(machine.sweep(400))
    request = pin_force("M", on="M B")
    for ask in (
        lambda: machine.evaluate([request], phi=[0.3, 0.5]),
        lambda: machine.evaluate(["B", request], phi=np.linspace(0.3, 2.0, 400)),
        lambda: machine.sweep(3).gradient(request, wrt=["load.mass"]),
        lambda: machine.function([request])(0.5),
    ):
        with pytest.raises(DefinitionError, match=names):
            ask()


def test_a_wrong_joint_is_refused_with_friction():
    motion = train(shift=0.01)().sweep(4)
    loads = ["load", PinFriction("O", radius=0.02, coefficient=0.1)]
    for asked in (pin_forces, driving_force):
        with pytest.raises(DefinitionError, match="the joint 'mesh' at B"):
            asked(motion, loads, direction="extending")


def test_a_joint_that_is_wrong_for_some_designs_is_refused_there_alone():
    """The wheels mesh at 0.3 m between their centres; set further apart they are a machine that nobody built."""
    request, apart = pin_force("M", on="M B"), Train(M=(0.31, 0.0))
    assert np.isfinite(Train().evaluate([request], phi=[0.5])[0]).all()
    for ask in (lambda: apart.evaluate([request], phi=[0.5]), lambda: pin_forces(apart.sweep(3))):
        with pytest.raises(DefinitionError, match="the joint 'mesh' at B"):
            ask()


class Strut(Mechanism):
    """Nothing joins A and B but the points measured along them: equilibrium takes them for a link, which the motion does not."""

    phi = Stroke(20 * deg, 80 * deg)
    A, O = Ground(0.0, -0.2), Ground(0.8, 0.1)
    B = Crank(O, OB=0.5, angle=phi)
    K = OnLink(A, B, AK=0.3)
    load = Weight(K, mass=60)
    arm = Weight(B, mass=100)


def test_forces_that_disagree_with_virtual_work_are_refused():
    machine = Strut()
    with pytest.raises(DefinitionError, match=r"overconstrained.*AB changes, so that an OnLink\(A, B, ...\) is on no body"):
        pin_forces(machine.sweep(3))
    with pytest.raises(SingularError, match=r"the force of phi is .* by the equilibrium of the joints and .* by virtual work"):
        pin_forces(machine.sweep(3), split="least squares")
    found = pin_forces(machine.sweep(3, unreachable="nan"), split="least squares")
    assert all(np.isnan(each.force).all() for each in found.joints)
