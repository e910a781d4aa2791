"""A verdict: a line of text that knows whether its rule is kept; and what a machine is about."""

import pickle
from copy import deepcopy

import pytest

from linkage import DefinitionError, Featured, Remark, Verdict


def test_a_verdict_is_its_line_and_knows_whether_the_rule_is_kept():
    good, bad = Verdict("length", True, "it fits."), Verdict("lifting", False, "it is too weak.")
    assert (good, bad) == ("ok   length: it fits.", "FAIL lifting: it is too weak.")
    assert [bool(each) for each in (good, bad)] == [True, False] and not all([good, bad])
    assert "\n".join([good, bad]).splitlines() == [good, bad]
    assert (bad.rule, bad.ok, bad.sentence) == ("lifting", False, "it is too weak.")
    twice, other = bad.named("lifting"), bad.named("tilting")  # a line may bear the name of a rule
    assert (twice, twice.rule, other) == ("FAIL lifting: it is too weak.", "lifting lifting", "FAIL lifting tilting: it is too weak.")


def test_a_remark_is_its_sentence_and_no_rule():
    remark, silent, bad = Remark("It rattles."), Verdict("oil", None, "nothing is left."), Verdict("lifting", False, "it is too weak.")
    assert (remark, remark.rule, remark.ok, remark.sentence, remark.heading) == ("It rattles.", "remark", None, "It rattles.", "")
    assert isinstance(remark, Verdict) and remark.named("ram") == remark.answered(3) == remark and remark.answered(3).answer == 3
    assert [each.is_rule for each in (remark, silent)] == [False, True]
    assert all([remark]) and not all([remark, silent]) and not all([remark, bad])


@pytest.mark.parametrize("through", [deepcopy, lambda each: pickle.loads(pickle.dumps(each))])
def test_a_verdict_keeps_its_parts_as_a_copy(through):
    bad, remark = through(Verdict("lifting", False, "it is too weak.")), through(Remark("It rattles."))
    assert (type(bad), bad.rule, bad.ok, bad.sentence) == (Verdict, "lifting", False, "it is too weak.")
    assert (type(remark), remark.rule, remark.sentence, repr(remark)) == (Remark, "remark", "It rattles.", "Remark('It rattles.')")


@pytest.mark.parametrize("given", [("", True, "it fits."), ("length", True, ""), ("length", True, 3), ("",), (3,)])
def test_a_verdict_without_words_is_refused(given):
    kind = Verdict if len(given) == 3 else Remark
    with pytest.raises(DefinitionError, match=f"write {kind.__name__}"):
        kind(*given)


@pytest.mark.parametrize("given", [{"column": 3}, {"path": "G"}, {"path": [1]}, {"limits": [1.0]}])
def test_what_a_machine_is_about_is_refused_where_it_is_none(given):
    with pytest.raises(DefinitionError, match="expected"):
        Featured(**given)
