"""Synthesis finds random machines of eight classes again from their own paths, judged without the package."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from tests.for_all import for_all
from tests.linkage.synthesis.known_machines import CLASSES, KINDS, along_stroke, known_task

EACH = 25
"""Machines of a class, of seeds in a row, whose tasks are timed, untimed and closed by turns."""
AGAIN = 1e-9
"""Of a path's size: what an answer may miss at its worst point."""


def found_again(name, seed, **options):
    """Return how far the best answer for a random machine's path misses, in parts of its size."""
    task = known_task(CLASSES[name], KINDS[seed % len(KINDS)], seed)
    return task.exact(task.found(**options))


@for_all("name", (), slow=CLASSES)
def test_the_evaluators_stand_where_the_classes_do(name):
    known = CLASSES[name]
    machine, (stroke, ends) = known.kind(), known.stroke()
    strokes = np.linspace(*ends, 31)
    place = known.places(machine, strokes)
    assert_allclose([place.real, place.imag], machine.at(**{stroke: strokes})[known.of], rtol=0, atol=1e-13)
    assert np.isfinite(along_stroke(known, machine)).all()


@for_all(("name", "seed"), [("Klann, of parts", 2)], slow=[("four-bar", 1), ("slider-crank", 0), ("a tailgate of a user's own", 0)])
def test_a_known_machine_is_found_again(name, seed):
    assert found_again(name, seed, starts=8) <= AGAIN


@pytest.mark.slow
def test_known_machines_are_found_again():
    """Of the seven classes without a group 169 of 175 were; with the group, solved by iteration, this takes most of an hour."""
    missed = [(name, seed) for name in CLASSES for seed in range(EACH) if not found_again(name, seed) <= AGAIN]
    assert len(missed) <= 0.05 * EACH * len(CLASSES), missed
