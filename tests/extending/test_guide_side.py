"""A step of another package whose joint has the role "guide": it names a guide, or the points of the body that the line is on."""

import pytest
from numpy.testing import assert_allclose

from linkage import LEFT, Crank, DefinitionError, Dyad, Ground, Guide, Mechanism, OnGuide, Stroke, Weight, driving_force, pin_forces
from linkage.quantities import Driven, Joint, JointSide, name_of, quantity
from linkage.steps import Point


class Along(Point):
    """A point at a distance along a guide, which says in words of its own whose line it is on."""

    expects = (("guide", "guide"),)

    def __init__(self, guide, *, at, of=()):
        self.guide, self.along, self.of = guide, quantity(at), of

    def parts(self):
        return self.guide, self.along

    def place(self, where):
        return where.line(self.guide).at(where.value(self.along))

    def joints(self):
        on, by = JointSide((self.name,), "runner"), JointSide(self.of, "guide")
        drives = (Driven(self.along, "t"),)
        return (Joint("driven", self.name, on, by, "nt", lambda where: where.line(self.guide), (name_of(self.guide),), drives),)


def machine(rail, runner):
    class Slotted(Mechanism):
        S, phi = Stroke(0.1, 0.4), Stroke(0.1, 0.5)
        O, P = Ground(0, 0), Ground(1, 0.2)
        Q = Crank(O, OQ=1.0, angle=phi)
        guide = rail
        X = runner(S)
        Y = Dyad(X, P, XY=0.8, PY=0.9, side=LEFT)
        load = Weight(Y, mass=10)

    return Slotted


@pytest.mark.parametrize(
    ("rail", "of"),
    [
        (("O", "Q"), ("guide",)),
        (("O", "Q"), ("O", "Q")),
        ((0.0, -0.1), ("guide",)),
        ((0.0, -0.1), ("O",)),
        ((0.0, -0.1), ()),
    ],
    ids=str,
)
def test_its_forces_are_those_of_the_shipped_step(rail, of):
    guide = Guide(*rail) if isinstance(rail[0], str) else Guide(rail, angle=0.1)
    known = machine(guide, lambda S: OnGuide("guide", at=S))
    own = machine(guide, lambda S: Along("guide", at=S, of=of))
    for stroke in ("S", "phi"):
        forces = [driving_force(each().at(S=0.2, phi=0.3), drive=stroke) for each in (known, own)]
        assert_allclose(forces[1], forces[0], rtol=1e-12)
    assert str(pin_forces(own().at(S=0.2, phi=0.3))) == str(pin_forces(known().at(S=0.2, phi=0.3)))
    assert own().mobility == 2 and own().gruebler == known().gruebler


def test_a_side_that_names_neither_is_refused():
    own = machine(Guide("O", "Q"), lambda S: Along("guide", at=S, of=("load",)))
    with pytest.raises(DefinitionError, match="load is no guide; name a Guide of the class, or the points"):
        pin_forces(own().at(S=0.2, phi=0.3))
