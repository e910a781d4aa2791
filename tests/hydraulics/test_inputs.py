"""Numbers without their unit: a thousand times too large or next to nothing, they are asked about; what is odd but possible passes."""

import tomllib
from functools import partial

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from hydraulics import Cylinder, OilLine, Pump, next_rod, pressure
from hydraulics.buckling import Buckling
from hydraulics.inputs import in_cubic_metres, in_metres, in_pascals, stroke_in_metres
from linkage import RIGHT, Dyad, Ground, Mechanism, Over, Stroke, most
from linkage.errors import DefinitionError
from linkage.files import from_dict, to_toml
from linkage.loads import Weight
from linkage.units import bar, litre, minute, mm
from tests.for_all import for_all


@for_all(
    ("call", "words"),
    [
        (partial(in_metres, 80, "Bore"), r"Bore = 80 m is more than any cylinder has; write 80 \* mm if these are millimetres"),
        (partial(in_metres, [0.1, 63.0], "Rod"), r"Rod = 63 m .* write 63 \* mm"),
        (partial(in_metres, "80", "Bore"), "Bore = '80' is not a number"),
        (partial(stroke_in_metres, 250, "Stroke"), r"Stroke = 250 m .* write 250 \* mm"),
        (partial(stroke_in_metres, 25, "Stroke", 80 * mm), r"Stroke = 25 m .* write 25 \* mm"),
        (partial(Buckling, 40), r"Rod = 40 m .* write 40 \* mm"),
        (partial(in_pascals, 180, "pump.pressure"), r"pump\.pressure = 180 Pa is next to nothing; write 180 \* bar if these are bar"),
        (partial(in_pascals, [94e5, 0.0, -0.8], "Charge"), r"Charge = -0\.8 Pa is next to nothing; write -0\.8 \* bar"),
        (partial(in_pascals, np.nan, "Charge"), "Charge = nan is not finite"),
        (partial(next_rod, 45), r"Rod = 45 m .* write 45 \* mm"),
        (partial(Pump, 160 * bar, flow=40 * litre), r"flow=0.04 was given as a volume; .* value of flow, such as 60 \* litre"),
        (partial(Pump, 160 * bar, flow=40 * bar), r"flow=4e\+06 was given as a pressure; expected is a value of flow"),
        (partial(in_cubic_metres, 40, "Flow"), r"Flow = 40 m3/s is more than any pump gives; write 40 \* litre / minute if it is in l/min"),
    ],
)
def test_a_number_without_its_unit_is_asked_about(call, words):
    with pytest.raises(DefinitionError, match=words):
        call()


@for_all(
    ("check", "value"),
    [
        (in_metres, [4 * mm, 10 * mm, 1.8]),
        (stroke_in_metres, [0.01, 24.0]),
        (partial(stroke_in_metres, bore=0.25), 24.0),
        (in_pascals, [0.0, -1.0 * bar, 0.01 * bar, 5000 * bar]),
        (in_cubic_metres, [0.0, 0.3 * litre / minute, 6000 * litre / minute]),
    ],
)
def test_what_is_odd_but_possible_passes(check, value):
    assert_array_equal(check(value, what="value"), value)


def test_a_cylinder_in_millimetres_is_named_and_so_is_its_side_that_is_nearly_right():
    class Tilt(Mechanism):
        S = Stroke(0.0, 300)
        O, A = Ground(0.0, 600), Ground(350, 150)
        B = Dyad(A, O, AB=500 + S, OB=500, side=RIGHT)
        lift = Cylinder(A, B, bore=80 * mm, rod=45 * mm)
        load = Weight(B, mass=400)
        work = Over(S=(0, 300))

    with pytest.raises(DefinitionError, match=r"lift: length between the ends = 8\d\d m .* write 8\d\d \* mm"):
        Tilt().verdicts()
    with pytest.raises(AttributeError, match=r"Cylinder has no attribute 'pistonside'\. Did you mean piston_side"):
        _ = Tilt().plan.members["lift"].pistonside


def test_a_pump_and_its_line_are_written_in_litres_a_minute_and_without_what_they_are_by_default():
    class Press(Mechanism):
        S = Stroke(0.0, 0.3)
        O, A = Ground(0.0, 0.6), Ground(0.35, 0.15)
        B = Dyad(A, O, AB=0.55 + S, OB=0.5, side=RIGHT)
        lift = Cylinder(A, B, bore=80 * mm, rod=45 * mm)
        supply = Pump(160 * bar, flow=40 * litre / minute)
        line = OilLine(lift.piston_side, supply)

    for flow in range(1, 100):
        text = to_toml(Press(**{"supply.flow": flow * litre / minute}))
        assert f'flow = "{flow} l/min"' in text and "exponent" not in text
    assert from_dict(tomllib.loads(text))().plan.table.defaults["supply.flow"] == 99 * litre / minute
    with pytest.raises(DefinitionError, match=r"150 Pa is next to nothing; write 150 \* bar if these are bar"):
        Press().answers([most(pressure("lift")) <= 150])
    with pytest.raises(DefinitionError, match=r"150 Pa is next to nothing; write 150 \* bar if these are bar"):
        Press().answers([most("lift")], over=Over(S=(0.0, 0.3), only=[pressure("lift") <= 150]))
    assert str(most(pressure("lift")) <= 150 * bar) == "most(pressure(lift)) <= 150 bar"
