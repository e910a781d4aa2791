"""Examples are judged by what comes out, never by how long a busy machine takes for them."""

import gc

import pytest
from _pytest.doctest import DoctestModule
from hypothesis import settings

settings.register_profile("steady", deadline=None)
settings.load_profile("steady")


@pytest.hookimpl(wrapper=True)
def pytest_collect_file(file_path, parent):
    """Look for no examples in docstrings of tests: to read them, all helpers and benchmarks would be imported."""
    found = yield
    return [each for each in found if not isinstance(each, DoctestModule)]


@pytest.hookimpl(wrapper=True)
def pytest_collection(session):
    """Look for garbage neither while tests and classes are read nor, ever after, among those: they stand until the end."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.collect()
        gc.freeze()
        gc.enable()
