"""How joint forces are asked for and printed: bodies by their links, loads as given, ranges of one value."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import LEFT, RIGHT, Crank, DefinitionError, Dyad, Force, Ground, Link, Mechanism, OnLink, Pin, Stroke, Weight, pin_forces


class Lift(Mechanism):
    """A lift arm of a parts list."""

    S = Stroke(0.0, 0.25)
    A, O = Ground(0.20, 0.55), Ground(0.30, 1.15)
    lift, arm = Link("A B", AB=0.5 + S), Link("O B C", OB=0.30, OC=0.36, BC=0.16)
    B, C = Pin(near=(0.51, 0.94)), Pin(near=(0.64, 1.04))
    load = Weight(C, mass=100)


def test_body_goes_by_its_link_or_its_points():
    forces = pin_forces(Lift().sweep(3))
    for name in ("arm", "O B C", "C O"):
        assert_allclose(forces.force("B", on=name), forces.force("B", on="OBC"), rtol=0)
        assert list(forces.on_body(name)) == list(forces.on_body("OBC"))
    assert_allclose(forces.force("B", on="lift"), -forces.force("B", on="arm"), rtol=0)


@pytest.mark.parametrize("name", ["CBO", "A C", "arms"])
def test_what_is_no_body_is_refused(name):
    forces = pin_forces(Lift().sweep(3))
    with pytest.raises(DefinitionError, match="is unknown in the joint B of Lift"):
        forces.force("B", on=name)
    with pytest.raises(DefinitionError, match="is unknown in Lift"):
        forces.on_body(name)


def test_a_pin_along_two_points_whose_distance_follows_a_stroke_names_what_follows():
    class Slid(Mechanism):
        phi, S = Stroke(0.0, 1.0), Stroke(0.0, 0.5)
        O = Ground(0.0, 0.0)
        M = Crank(O, OM=1.0, angle=phi)
        P = OnLink(O, M, OP=1.2 + S)
        C = OnLink(P, O, PC=0.3 + 0.5 * S)
        load = Weight(C, mass=10)

    with pytest.raises(DefinitionError, match=r"P and O do not belong to one body; PO = 1.2 \+ S; name two points"):
        pin_forces(Slid().at(phi=0.5, S=0.1))


def test_loads_that_are_given_are_called_so():
    motion = Lift().sweep(3)
    assert str(pin_forces(motion)).startswith("Lift, own loads, ")
    assert str(pin_forces(motion, Force("C", (0, -5)))).startswith("Lift, given loads, ")


def test_one_value_is_printed_once():
    """A force that differs in the last digits is no range."""
    text = str(pin_forces(Lift().at(S=0.1 + np.array([0.0, 1e-16, 2e-16]))))
    assert " to " not in text


def test_body_with_two_joints_at_a_point_is_told_by_the_other_one():
    """Of three bodies at a pin the carrier meets both others; these are asked for by their own names."""

    class Loaded(Lift):
        D = Dyad("C", "A", CD=0.4, AD=0.5, side=RIGHT)
        E = Dyad("C", "O", CE=0.3, OE=0.3, side=LEFT)

    forces = pin_forces(Loaded().sweep(3))
    (carrier,), others = {each.by for each in forces.at("C")}, [each.on for each in forces.at("C")]
    with pytest.raises(DefinitionError, match=r"several joints meet at C .*; say on= the other body, .* or take them from at\('C'\)"):
        forces.force("C", on=carrier)
    with pytest.raises(DefinitionError, match=r"several joints meet at C .*; say on= which body"):
        forces.force("C")
    assert len(others) == 2 and all(forces.force("C", on=other).shape == (2, 3) for other in others)
