"""Examples are judged by what comes out, never by how long a busy machine takes for them.

It stands beside the packages, as pytest asks a hook in `tests` of nothing that is read elsewhere: of no page and no docstring.
"""

import gc
import sys
from collections import defaultdict
from pathlib import Path

import pytest
from _pytest.doctest import DoctestModule
from hypothesis import HealthCheck, settings

from linkage import mechanism
from linkage.mobility import check

settings.register_profile("steady", deadline=None, max_examples=25, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("steady")


CHROMIUM = Path("/usr/bin/chromium")
ARGUMENTS = (
    "--no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking --disable-component-update --disable-sync"
    " --js-flags=--single-threaded"  # each test process has a core: more threads of one page would fight for it
)
WAITING = defaultdict(list)
"""By test file the plans of the machines that it brought along, whose mobility is checked before the first of its tests."""


@pytest.fixture(scope="session")
def chromium():
    """Yield the browser of all pages, which takes seconds to start; skip where playwright or Debian's chromium is not installed."""
    sync = pytest.importorskip("playwright.sync_api", reason="playwright is not installed: pip install playwright")
    if not CHROMIUM.exists():
        pytest.skip(f"{CHROMIUM} is not there: apt install chromium")
    with sync.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=str(CHROMIUM), args=ARGUMENTS.split())
        yield browser
        browser.close()


@pytest.hookimpl(wrapper=True)
def pytest_collect_file(file_path, parent):
    """Look for examples in sources of packages that have one, and for tests in files of which some are asked for: other files are not read.

    What is read for examples is imported, and each docstring looked through.
    """
    found = yield
    if file_path.suffix != ".py":
        return found
    text = file_path.read_text(encoding="utf-8")
    if "\npytestmark = pytest.mark.slow\n" in text and parent.config.option.markexpr == "not slow":
        return []
    if file_path.is_relative_to(Path(__file__).parent / "tests") or ">>>" not in text:
        return [each for each in found if not isinstance(each, DoctestModule)]
    return found


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report(collector):
    """Put off the check of mobility of machines that a test file defines or imports: each process reads all files, and runs some."""
    mechanism.check = WAITING[collector.path].append
    try:
        return (yield)
    finally:
        mechanism.check = check


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item):
    for plan in WAITING.pop(item.path, ()):
        check(plan)


@pytest.hookimpl(wrapper=True)
def pytest_collection(session):
    """Keep what is compiled while tests are read, and look for no garbage then nor, ever after, among them: they stand until the end.

    Without bytecode on disk every run, and each worker of it, would compile all packages and rewrite all assertions anew.
    Plans and formulas are many small objects that stay, among which garbage would be looked for every moment.
    """
    gc.disable()
    unwritten, sys.dont_write_bytecode = sys.dont_write_bytecode, False
    try:
        return (yield)
    finally:
        sys.dont_write_bytecode = unwritten
        gc.freeze()
        gc.set_threshold(200_000, 20, 20)
        gc.enable()
