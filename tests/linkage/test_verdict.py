"""A verdict: a line of text that knows whether its rule is kept; and what a machine is about."""

import pickle
from copy import deepcopy

import pytest

from linkage import DefinitionError, Featured, Verdict


def test_a_verdict_is_its_line_and_knows_whether_the_rule_is_kept():
    good, bad = Verdict("length", True, "it fits."), Verdict("lifting", False, "it is too weak.")
    assert (good, bad) == ("ok   length: it fits.", "FAIL lifting: it is too weak.")
    assert [bool(each) for each in (good, bad)] == [True, False] and not all([good, bad])
    assert "\n".join([good, bad]).splitlines() == [good, bad]
    assert (bad.rule, bad.ok, bad.sentence) == ("lifting", False, "it is too weak.")


@pytest.mark.parametrize("through", [deepcopy, lambda each: pickle.loads(pickle.dumps(each))])
def test_a_verdict_keeps_its_parts_as_a_copy(through):
    bad = through(Verdict("lifting", False, "it is too weak."))
    assert (type(bad), bad.rule, bad.ok, bad.sentence) == (Verdict, "lifting", False, "it is too weak.")


@pytest.mark.parametrize("given", [("", True, "it fits."), ("length", True, ""), ("length", True, 3)])
def test_a_verdict_without_words_is_refused(given):
    with pytest.raises(DefinitionError, match="write Verdict"):
        Verdict(*given)


@pytest.mark.parametrize("given", [{"column": 3}, {"path": "G"}, {"path": [1]}, {"limits": [1.0]}])
def test_what_a_machine_is_about_is_refused_where_it_is_none(given):
    with pytest.raises(DefinitionError, match="expected"):
        Featured(**given)
