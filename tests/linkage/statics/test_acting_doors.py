"""Public functions of forces take what acts by keywords or as one `Acting`, never both, and say so in `help`."""

from inspect import signature

import pytest
from numpy.testing import assert_array_equal

from hydraulics import Cylinder
from linkage import Acting, Damper, DefinitionError, driving_force, pin_forces
from linkage.statics import reaction
from linkage.units import mm
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all

LIFT = Cylinder("A", "B", bore=80 * mm, rod=40 * mm)


class Hitch(ThreePointHitch):
    """The hitch with a damper between its cylinder's pins, which feels the speeds."""

    damper = Damper("A", "B", coefficient=5e3)


@for_all("ask", [
    lambda motion, **situation: pin_forces(motion, **situation).force("E"),
    driving_force,
    LIFT.thrust,
    LIFT.pressure,
    LIFT.buckling_use,
])  # fmt: skip
def test_one_value_says_the_same_as_its_keywords(ask):
    motion = Hitch().sweep(5)
    keywords = {"direction": "extending", "rates": {"S": 0.05}}
    assert_array_equal(ask(motion, **keywords), ask(motion, acting=Acting(**keywords)))
    with pytest.raises(DefinitionError, match=r"direction= and acting= both say it"):
        ask(motion, direction="extending", acting=Acting(case="plain"))
    with pytest.raises(DefinitionError, match=r"acting='extending'"):
        ask(motion, acting="extending")
    with pytest.raises(TypeError, match="unexpected keyword argument 'directon'"):
        ask(motion, directon="extending")


@for_all("public", [pin_forces, driving_force, reaction, Cylinder.thrust, Cylinder.pressure, Cylinder.buckling_use])
def test_help_names_every_keyword(public):
    assert {"loads", "case", "direction", "rates", "acting"} <= signature(public).parameters.keys()
