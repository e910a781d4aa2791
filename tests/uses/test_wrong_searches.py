"""Seeded wrong uses of searches and studies: what comes back is a result or a deliberate error, never a raw one and no leaked warning."""

import warnings

import numpy as np
import pytest

from linkage import LinkageError, SingularWarning
from tests.uses.wrong_searches import asked, wrong_use

DAILY, ALL = 40, 3040
LONGEST = 1600
"""Characters of a message: those that list the names there are may be long."""


def check(seed):
    """Ask one wrong use; every warning but those of nearness to a dead point is an error."""
    kind, parts = wrong_use(seed)
    with warnings.catch_warnings(), np.errstate(all="warn"):
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", SingularWarning)
        try:
            found = asked(kind, parts)
        except LinkageError as error:
            said = str(error)
            assert said, (seed, kind, parts)
            assert len(said) < LONGEST, (seed, said)
            return False
    assert not isinstance(found, str) or " nan" not in found, (seed, found)
    return True


def test_wrong_uses_of_searches_are_refused_or_answered(capsys):
    assert sum(check(seed) for seed in range(DAILY)) < DAILY / 2  # most of them are wrong


@pytest.mark.slow
@pytest.mark.parametrize("first", range(DAILY, ALL, 100))
def test_many_wrong_uses_of_searches_are_refused_or_answered(first, capsys):
    for seed in range(first, first + 100):
        check(seed)
