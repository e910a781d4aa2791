"""Many cases of one test within one id: all of them run, and what fails is told by name."""

import functools
import inspect

import pytest

FAILURES = (Exception, pytest.fail.Exception)
PARAM = type(pytest.param())


def check_all(cases, check):
    """Run a check over all named cases, and fail with each that failed.

    Parameters
    ----------
    cases : iterable of (str, tuple)
        The name of each case, and the arguments of its check.
    check : callable
        Raises where a case does not hold. A case that is skipped counts only if all are.

    Raises
    ------
    BaseExceptionGroup
        All failures; its message names their cases.
    """
    failed, skipped, count = {}, [], 0
    for name, arguments in cases:
        count += 1
        try:
            check(*arguments)
        except pytest.skip.Exception as error:
            skipped.append(error)
        except FAILURES as error:
            error.add_note(f"case {count}: {name}")
            failed[f"{count}: {name}"] = error
    assert count, "there are no cases"
    if failed:
        raise BaseExceptionGroup(f"{len(failed)} of {count} cases failed, {'; '.join(failed)}", [*failed.values()])
    if len(skipped) == count:
        raise skipped[0]


def for_all(names, daily, ids=None, slow=()):
    """Run a test over all cases within one id, and over slow ones within another; otherwise like `pytest.mark.parametrize`.

    Fixtures are made once for all cases: a test that needs a fresh folder or clean output for each is parametrized.

    Parameters
    ----------
    names : str or sequence of str
        The arguments of the test that a case fills.
    daily, slow : iterable or callable
        The cases of every day, and those under the mark `slow`; a callable gives them when the test runs, not when it is collected.
        A case of `daily` that bears the mark `slow` is one of the slow ones.
    ids : sequence of str or callable, optional
        The names of the cases in `daily`, or what gives the name of a value.
    """
    names = [name.strip() for name in names.split(",")] if isinstance(names, str) else [*names]
    chosen = f"cases_of_{'_'.join(names)}"
    parts = {"daily": daily, "slow": slow}
    if not callable(daily):
        cases, listed = [*daily], [] if ids is None or callable(ids) else [*ids]
        cases = [pytest.param(*row(case, names), id=name) for case, name in zip(cases, listed, strict=True)] if listed else cases
        later = [case for case in cases if isinstance(case, PARAM) and case.marks]
        assert all(mark.name == "slow" for case in later for mark in case.marks), "marks other than `slow` are for parametrize"
        parts = {"daily": [case for case in cases if not any(case is each for each in later)], "slow": later or slow}

    def decorated(test):
        arguments = inspect.signature(test).parameters
        assert set(names) <= set(arguments), f"{test.__name__} has no argument for one of {names}"

        def run(**fixtures):
            cases = parts[fixtures.pop(chosen, "daily")]
            rows = [
                (name_of(case, names, place, ids), row(case, names)) for place, case in enumerate(cases() if callable(cases) else cases)
            ]
            check_all(rows, lambda *values: test(**dict(zip(names, values, strict=True)), **fixtures))

        functools.update_wrapper(run, test)
        left = [argument.replace(kind=argument.KEYWORD_ONLY) for name, argument in arguments.items() if name not in names]
        if parts["slow"]:
            left.append(inspect.Parameter(chosen, inspect.Parameter.KEYWORD_ONLY))
        run.__signature__ = inspect.Signature(left)
        choices = [*["daily"] * bool(parts["daily"]), pytest.param("slow", marks=pytest.mark.slow)]
        return pytest.mark.parametrize(chosen, choices)(run) if parts["slow"] else run

    return decorated


def first_daily(count, names, cases, ids=None):
    """Return a `pytest.mark.parametrize` whose first `count` cases run every day, and the others under the mark `slow`."""
    listed = [name.strip() for name in names.split(",")] if isinstance(names, str) else names
    rows = []
    for place, case in enumerate(cases):
        marks, name = (case.marks, case.id) if isinstance(case, PARAM) else ((), None)
        rows.append(pytest.param(*row(case, listed), marks=[*marks, *[pytest.mark.slow] * (place >= count)], id=name))
    return pytest.mark.parametrize(names, rows, ids=ids)


def row(case, names):
    """Return the values of a case."""
    return case.values if isinstance(case, PARAM) else (case,) if len(names) == 1 else tuple(case)


def name_of(case, names, place, ids):
    """Return what a case is called, as pytest would call it."""
    if isinstance(case, PARAM) and case.id:
        return case.id
    return "-".join(word(name, value, place, ids) for name, value in zip(names, row(case, names), strict=True))


def word(name, value, place, ids):
    """Return the word of one value in the name of its case."""
    told = ids(value) if callable(ids) else None
    if told is None:
        plain = isinstance(value, (str, bytes, int, float, type(None)))
        told = value if plain else getattr(value, "__name__", f"{name}{place}")
    return str(told)
