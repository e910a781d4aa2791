"""Cases that run within one id: none is left out, none stops another, and each that fails is named."""

import inspect

import pytest

from tests.for_all import check_all, first_daily, for_all


def test_all_cases_run_and_those_that_fail_are_named():
    seen = []

    def check(number, most):
        seen.append(number)
        assert number < most
        with pytest.raises(ZeroDivisionError):
            _ = 1 / (number - number % 2)

    with pytest.raises(BaseExceptionGroup) as caught:
        check_all([("small", (0, 2)), ("great", (5, 2)), ("odd", (1, 2)), ("other", (2, 3))], check)
    assert seen == [0, 5, 1, 2]
    assert str(caught.value).startswith("2 of 4 cases failed, 2: great; 4: other")
    assert [error.__notes__ for error in caught.value.exceptions] == [["case 2: great"], ["case 4: other"]]


def test_no_cases_are_a_failure_and_all_skipped_are_skipped():
    with pytest.raises(AssertionError, match="no cases"):
        check_all([], print)
    with pytest.raises(pytest.skip.Exception):
        check_all([("one", ("here",))], pytest.skip)
    check_all([("one", (True,)), ("two", (False,))], lambda skipped: skipped and pytest.skip("here"))


def test_cases_multiply_and_other_arguments_stay():
    seen = []

    @for_all(("first", "second"), [(1, 2), pytest.param(3, 4, id="later")], slow=lambda: [(5, 6)])
    @for_all("third", "ab", ids=["a", "b"])
    def check(first, second, third, place):
        assert second == first + 1
        seen.append((first, third, place))

    assert [*inspect.signature(check).parameters] == ["place", "cases_of_first_second"]
    check(place="here", cases_of_first_second="daily")
    assert seen == [(1, "a", "here"), (1, "b", "here"), (3, "a", "here"), (3, "b", "here")]
    seen.clear()
    check(place="here", cases_of_first_second="slow")
    assert seen == [(5, "a", "here"), (5, "b", "here")]


@pytest.mark.parametrize("part", ["daily", "slow"])
def test_a_case_bears_the_name_that_pytest_would_give_it(part):
    @for_all(("size", "kind"), [(1, int), (2.5, print)], ids=lambda value: "half" if value == 2.5 else None, slow=[(None, [])])
    def check(size, kind):
        raise ValueError(size)

    with pytest.raises(BaseExceptionGroup, match="1: 1-int; 2: half-print" if part == "daily" else "1: None-kind0"):
        check(cases_of_size_kind=part)


def test_cases_with_the_mark_are_among_the_slow_ones():
    seen = []

    @for_all("number", [1, pytest.param(2, marks=pytest.mark.slow), 3])
    def check(number, place):
        seen.append(number)

    check(place="here", cases_of_number="daily")
    check(place="here", cases_of_number="slow")
    assert seen == [1, 3, 2]
    with pytest.raises(AssertionError, match="other than `slow`"):
        for_all("number", [pytest.param(2, marks=pytest.mark.skip)])


def test_cases_after_the_first_ones_are_slow_and_keep_their_marks_and_names():
    xfail = pytest.mark.xfail
    cases = [1, pytest.param(2, id="two", marks=xfail), (3, 4), pytest.param(5, marks=xfail)]
    one, two, three, four = first_daily(2, "case", cases).args[1]
    assert [each.values for each in (one, two, three, four)] == [(1,), (2,), ((3, 4),), (5,)]
    assert [[mark.name for mark in each.marks] for each in (one, two, three, four)] == [[], ["xfail"], ["slow"], ["xfail", "slow"]]
    assert (one.id, two.id) == (None, "two")
    pair = first_daily(1, ("first", "second"), [(1, 2)], ids=["pair"])
    assert pair.args[1][0].values == (1, 2) and pair.kwargs["ids"] == ["pair"]
