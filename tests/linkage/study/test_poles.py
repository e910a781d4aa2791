"""Objectives that a search divides by what comes to zero in the box: refused in words, wherever the quotient stands."""

import numpy as np
import pytest

from linkage import LEFT, Crank, Dyad, Ground, Mechanism, Stroke, StudyError, at, least, most, optimise, x, y


class Rocker(Mechanism):
    S = Stroke(0.0, 1.0)
    O, C = Ground(0.0, 0.0), Ground(0.7, 0.1)
    A = Crank(O, OA=0.3, angle=S)
    D = Dyad(A, C, AD=0.6, CD=0.5, side=LEFT)


HEIGHT = float(Rocker().at(S=0.4).y("D")) + 1e-4
BOX = {"vary": {"OA": (0.25, 0.35)}, "starts": 2}


def test_a_divisor_that_passes_zero_is_refused_wherever_it_stands():
    gap = y("D") - HEIGHT
    measure = at(y("D"), S=0.4) - HEIGHT
    for each in (at(1 / gap, S=0.4), at(x("D") / gap, S=0.4), 1 / measure, least(x("D")) * (1 / measure), measure**-1.0):
        for way in ("minimise", "maximise"):
            with pytest.raises(StudyError, match="has no bound in the box, for at"):
                optimise(Rocker(), **{way: each}, **BOX)
    with pytest.raises(StudyError, match="has no value: it is divided by"):
        optimise(Rocker(), minimise=least(1 / gap), **BOX)


def test_what_stays_bounded_is_found():
    """The least of a square's reciprocal, or of a size, is bounded; so is a quotient whose divisor stays away from zero."""
    for each in (at(1 / (y("D") - HEIGHT) ** 2, S=0.4), at(abs(1 / (y("D") - HEIGHT)), S=0.4), most(1 / (y("D") - 0.1))):
        best = optimise(Rocker(), minimise=each, **BOX)
        values = [Rocker(OA=size).answers([each])[0].value for size in np.linspace(0.25, 0.35, 12)]
        assert best.value <= min(values) * (1.0 + 1e-9)
