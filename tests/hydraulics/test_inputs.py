"""Numbers without their unit: a thousand times too large or next to nothing, they are asked about; what is odd but possible passes."""

from functools import partial

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from hydraulics.buckling import Buckling
from hydraulics.inputs import in_cubic_metres, in_metres, in_pascals, stroke_in_metres
from linkage.errors import DefinitionError
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
