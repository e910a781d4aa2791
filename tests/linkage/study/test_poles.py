"""Objectives that a search divides by what comes to zero in the box: refused in words, wherever the quotient stands."""

from itertools import cycle

import numpy as np
import pytest

from linkage import LEFT, Crank, Dyad, Ground, Mechanism, Stroke, StudyError, at, least, most, optimise, x, y
from linkage.study import settings_for, zone
from linkage.study.settings import no_setting_words
from tests.for_all import first_daily


class Rocker(Mechanism):
    S = Stroke(0.0, 1.0)
    O, C = Ground(0.0, 0.0), Ground(0.7, 0.1)
    A = Crank(O, OA=0.3, angle=S)
    D = Dyad(A, C, AD=0.6, CD=0.5, side=LEFT)


HEIGHT = float(Rocker().at(S=0.4).y("D")) + 1e-4
BOX = {"vary": {"OA": (0.25, 0.35)}, "starts": 2}


@first_daily(1, "ways", [("minimise", "maximise"), ("maximise", "minimise")])
def test_a_divisor_that_passes_zero_is_refused_wherever_it_stands(ways):
    gap = y("D") - HEIGHT
    measure = at(y("D"), S=0.4) - HEIGHT
    quotients = at(1 / gap, S=0.4), at(1 / gap, S=0.4), at(x("D") / gap, S=0.4), 1 / measure, least(x("D")) * (1 / measure), measure**-1.0
    for each, way in zip(quotients, cycle(ways)):
        with pytest.raises(StudyError, match="has no bound in the box, for at"):
            optimise(Rocker(), **{way: each}, **BOX)
    with pytest.raises(StudyError, match="has no value: it is divided by"):
        optimise(Rocker(), minimise=least(1 / gap), **BOX)


@pytest.mark.slow
def test_what_stays_bounded_is_found():
    """The least of a square's reciprocal, or of a size, is bounded; so is a quotient whose divisor stays away from zero."""
    for each in (at(1 / (y("D") - HEIGHT) ** 2, S=0.4), at(abs(1 / (y("D") - HEIGHT)), S=0.4), most(1 / (y("D") - 0.1))):
        best = optimise(Rocker(), minimise=each, **BOX)
        values = [Rocker(OA=size).answers([each])[0].value for size in np.linspace(0.25, 0.35, 6)]
        assert best.value <= min(values) * (1.0 + 1e-9)


@pytest.mark.slow
def test_a_pole_within_the_stroke_of_a_part_of_the_box_ends_soon_in_words():
    """The best goes towards designs whose divisor begins to pass zero: it is refused, or what is found has a value and names that edge."""
    gap = y("D") - float(Rocker().at(S=0.4).y("D"))
    for quantity, vary in ((1 / gap, {"OA": (0.25, 0.35)}), (x("D") / gap, {"OA": (0.29, 0.35), "CD": (0.495, 0.505)})):
        try:
            best = optimise(Rocker(), minimise=most(quantity), vary=vary, starts=1)
        except StudyError as error:
            assert "it is divided by y(D) - 0.596058, and where it passes zero within the stroke, it grows without bounds" in str(error)
        else:
            assert "has no value: it is divided by y(D)" in best.edges[0]
            assert np.max(best.machine.sweep(2001).y("D")) < HEIGHT - 1e-4
            assert best.value == pytest.approx(np.max(best.machine.sweep(2001)[quantity]), rel=1e-6)


@pytest.mark.parametrize(
    ("values", "ends"),
    [([1, 2, 1e7, -9, -3], "-inf to inf"), ([-3, -9, 1e7, 2, 1], "-inf to inf"), ([1, 2, 1e7, 9, 3], "1 to inf"), ([1, 2, 4], "1 to 4")],
)
def test_where_no_setting_is_found_the_ends_are_those_on_either_side_of_a_pole(values, ends):
    at = np.linspace(0.1, 0.5, len(values))
    text = no_setting_words({"name": "OB", "what": "turns", "target": "0"}, "m", "", at, np.array(values, float))
    assert text.endswith(f"where turns goes from {ends}.")


@pytest.mark.slow
def test_a_zone_and_settings_tell_no_pole_as_a_value():
    gap = y("D") - float(Rocker().at(S=0.4).y("D"))
    for quantity, vary in ((1 / gap, {"OA": (0.25, 0.35)}), (x("D") / gap, {"OA": (0.25, 0.35), "CD": (0.45, 0.55)})):
        with pytest.raises(StudyError, match=r"has no bound in the box, for y\(D\) - 0.596"):
            zone(Rocker(), quantity, vary, S=[0.3, 0.4, 0.5])
        with pytest.raises(StudyError, match="grows without bounds in the box"):
            zone(Rocker(), lambda motion, of=quantity: motion[of], vary, S=[0.4])
        band = zone(Rocker(), quantity, {"OA": (0.25, 0.255)}, S=[0.4])
        assert np.isfinite([band.low, band.high]).all()
    nearest = 1.0 / float(np.max(Rocker(OA=np.linspace(0.25, 0.35, 2001)).at(S=0.4).y("D") - Rocker().at(S=0.4).y("D")))
    for value in (0.0, 50.0, 0.99 * nearest):  # the divisor is never so large
        none = settings_for(Rocker(), "OA", 1 / gap, value, between=(0.25, 0.35), S=0.4)
        assert none.values == ()
        assert "goes from -inf to inf" in str(none)
    for value in (1.01 * nearest, 500.0, 1e5, -200.0, -1e4):
        found = settings_for(Rocker(), "OA", 1 / gap, value, between=(0.25, 0.35), S=0.4)
        assert found.values
        for size in found.values:
            assert 1.0 / float(Rocker(OA=size).at(S=0.4).y("D") - Rocker().at(S=0.4).y("D")) == pytest.approx(value, rel=1e-6)
