"""Which lines of the sources each test runs, and how long it takes: a light tracer as a plugin of pytest."""

from __future__ import annotations

import sys
import threading
import time
from collections import defaultdict
from collections.abc import Generator
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

import pytest

CALLS = 12
"""A function's lines are watched in its first so many calls by a test; later ones seldom run another line."""
LOOKS = 10_000
"""A test that has called so many functions without a new line is watched no longer."""
ENOUGH = 6.0
"""So many seconds of processor time are given to a file; tests after that are not watched, and no mutant meets them."""
COLLECTION = ""
"""The name under which what runs while a file is read is kept: classes of mechanisms are bound there."""


class Reach:
    """The plugin: lines run below some folders by each test that passed, and the seconds it took."""

    def __init__(self, root: Path, rooms: tuple[str, ...]) -> None:
        self.root, self.rooms = root, tuple(str(root / room) for room in rooms)
        self.lines: dict[str, dict[str, set[int]]] = {}
        self.seconds: dict[str, float] = {}
        self.bad: set[str] = set()
        self._calls: dict[CodeType, int] = defaultdict(int)
        self._here: dict[str, set[int]] = defaultdict(set)
        self._idle = 0

    def begin(self) -> None:
        """Watch from here on, nothing seen."""
        self._calls.clear()
        self._idle = 0
        self._here = defaultdict(set)
        threading.settrace(self._enter)
        sys.settrace(self._enter)

    def end(self, name: str) -> None:
        """Watch no longer; what was seen belongs to a name."""
        sys.settrace(None)
        threading.settrace(None)  # type: ignore[arg-type]
        self.lines[name] = {Path(file).relative_to(self.root).as_posix(): lines for file, lines in self._here.items()}

    def _enter(self, frame: FrameType, event: str, argument: Any) -> Any:
        code = frame.f_code
        self._idle += 1
        if self._idle > LOOKS:
            sys.settrace(None)
            return None
        if not code.co_filename.startswith(self.rooms):
            return None
        self._calls[code] += 1
        if self._calls[code] > CALLS:
            return None
        return self._line(frame, "line", None)

    def _line(self, frame: FrameType, event: str, argument: Any) -> Any:
        here = self._here[frame.f_code.co_filename]
        if frame.f_lineno not in here:
            here.add(frame.f_lineno)
            self._idle = 0
        return self._line

    @pytest.hookimpl(wrapper=True)
    def pytest_collection(self) -> Generator[None, Any, Any]:
        self.begin()
        try:
            return (yield)
        finally:
            self.end(COLLECTION)

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Generator[None, Any, Any]:
        started = time.process_time()
        self.begin()
        try:
            return (yield)
        finally:
            self.end(item.nodeid)
            self.seconds[item.nodeid] = time.process_time() - started
            if sum(self.seconds.values()) > ENOUGH:
                item.session.shouldstop = "enough seen"

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed or (report.when == "call" and not report.passed):
            self.bad.add(report.nodeid)

    def found(self) -> dict[str, Any]:
        """Return what was seen, for a JSON file: of each test that passed its seconds and lines, and the lines run in the collection."""
        tests = {
            name: {"seconds": self.seconds[name], "lines": plain(self.lines[name])} for name in self.seconds if name not in self.bad
        }
        return {"tests": tests, "collection": plain(self.lines.get(COLLECTION, {}))}


def plain(lines: dict[str, set[int]]) -> dict[str, list[int]]:
    """Return sets of lines as lists."""
    return {file: sorted(each) for file, each in lines.items()}
