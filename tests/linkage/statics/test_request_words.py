"""Requests of forces say what they are: as they are written, and bound, as sentences name them."""

import pytest

from linkage import Crank, DefinitionError, Dyad, Ground, LoadCase, Mechanism, SingularError, Stroke, Weight, drive_force, pin_force
from tests.for_all import for_all

ASKED = {
    "drive_force()": drive_force(),
    "drive_force(phi)": drive_force("phi"),
    "drive_force(phi, case=full)": drive_force("phi", case="full"),
    "pin_force(A)": pin_force("A"),
    "pin_force(A, O A)": pin_force("A", on="O A"),
    "pin_force(A, O A, by=A B)": pin_force("A", on="O A", by="A B"),
    "pin_force(A, component=x)": pin_force("A", component="x"),
    "pin_force(A, O A, component=y, case=full)": pin_force("A", on="O A", component="y", case="full"),
}


@for_all(("words", "request_"), ASKED.items(), ids=ASKED)
def test_they_are_written_as_they_are_asked(words, request_):
    assert str(request_) == words


class FourBar(Mechanism):
    """A four-bar that comes into line within its stroke."""

    phi = Stroke(0.3, 3.5)
    O, C = Ground(0.0, 0.0), Ground(0.4, 0.0)
    A = Crank(O, OA=0.15, angle=phi)
    B = Dyad(A, C, AB=0.36, CB=0.2, side="left")
    load = Weight(B, mass=5)
    full = LoadCase(scale={"load": 2.0})


def test_bound_they_are_named_in_sentences():
    plan = FourBar.plan
    assert drive_force().bound(plan).sentence == "the driving force of phi"
    assert pin_force("A", on="O A").bound(plan).sentence.startswith("the size of the force at A (pin) on ")
    assert pin_force("A", component="x").bound(plan).sentence.startswith("the x component of the force at A")


def test_a_refusal_names_the_component_and_the_point():
    with pytest.raises(DefinitionError, match=r"Component 'z' is unknown in FourBar: the force at A"):
        FourBar().evaluate([pin_force("A", component="z")], phi=0.5)
    with pytest.raises(SingularError) as raised:
        FourBar(OA=0.16).evaluate([pin_force("C")], phi=3.141592653589793)
    assert "C" in str(raised.value)
