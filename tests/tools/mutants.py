"""Do the tests notice a wrong sign? One change at a time in a copy of the project, and the daily tests run against it.

`python -m tests.tools.mutants --count 150 --seed 1 [--room linkage/steps ...]`. The first run asks which lines each test runs
(a quarter of an hour) and keeps that outside the project; from then on a mutant meets the tests that run its line, the quickest
first, until one fails. A hang is a kill. What cannot even be imported is `broken` and does not count. `--seconds` bounds the tests
that a mutant meets, so a survivor has passed that many seconds of the quickest tests of its line: the share of the killed is a lower bound.
"""

from __future__ import annotations

import argparse
import contextlib
import hashlib
import importlib
import json
import os
import random
import resource
import shutil
import signal
import sys
import tempfile
import time
import traceback
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

import pytest

from tests.tools.mutations import Mutant, mutants
from tests.tools.reach import Reach

ROOT = Path(__file__).parents[2]
ROOMS = (
    "linkage/steps", "linkage/plan", "linkage/assembly", "linkage/program", "linkage/motion", "linkage/statics", "linkage/study",
    "linkage/synthesis", "linkage/formulas", "linkage/documents", "linkage/exports", "hydraulics",
)  # fmt: skip
COPIED = ("linkage", "hydraulics", "mechanisms", "tests", "docs", "README.md", "CHANGELOG.md", "conftest.py", "pyproject.toml", "run")
NOT_ASKED = ("tests/benchmarks", "tests/tools", "tests/test_demo.py", "tests/test_house.py", "tests/linkage/documents/test_run.py")
"""Tests of speed, of the whole demo, of the sources' text and of the shell script: no mutant needs them."""
HEAVY = ("numpy", "scipy.optimize", "scipy.linalg", "sympy", "networkx", "matplotlib.pyplot", "numba", "rich")
KILLED, SURVIVED, BROKEN = "killed", "survived", "broken"
PASSED, NOT_IMPORTED = 0, 99
MEMORY = 12 << 30
STEPS = ((2.0, 3), (6.0, 8))
"""The seconds and files of tests tried together: first a few very quick ones, as to read a test file costs more than most of its tests."""


class Copy:
    """A copy of the project in a temporary folder, of which one file at a time is another."""

    def __init__(self, folder: Path) -> None:
        self.root = folder / "project"
        for name in COPIED:
            source, target = ROOT / name, self.root / name
            target.parent.mkdir(parents=True, exist_ok=True)
            if source.is_dir():
                shutil.copytree(source, target, ignore=shutil.ignore_patterns("_build", "__pycache__"))
            elif source.exists():
                shutil.copy2(source, target)

    def write(self, path: str, text: str) -> None:
        """Replace a source; what Python compiled of it goes, as its time stamp may be the same."""
        file = self.root / path
        file.write_text(text, encoding="utf-8")
        for compiled in (file.parent / "__pycache__").glob(f"{file.stem}.*.pyc"):
            compiled.unlink()


def in_child(root: Path, work: Callable[[], int], seconds: float) -> int:
    """Return what a piece of work in a forked process returns; -1 where it took more processor time than given, or ten times as long."""
    cache = tempfile.mkdtemp(prefix="kernels-", dir=root.parent)
    child = os.fork()
    if child == 0:
        os._exit(guarded(root, work, seconds, cache))
    until = time.monotonic() + 10.0 * seconds
    status = None
    while status is None:
        done, code = os.waitpid(child, os.WNOHANG)
        if done:
            status = os.waitstatus_to_exitcode(code)
        elif time.monotonic() > until:
            os.killpg(child, signal.SIGKILL)
            os.waitpid(child, 0)
            status = -1
        else:
            time.sleep(0.02)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(child, signal.SIGKILL)  # what its tests have left behind
    shutil.rmtree(cache, ignore_errors=True)
    return status


def guarded(root: Path, work: Callable[[], int], seconds: float, cache: str) -> int:
    """Do a piece of work in the copy, with bounds for time and memory, and nothing on the screen."""
    os.setsid()
    os.nice(1)
    resource.setrlimit(resource.RLIMIT_CPU, (int(seconds) + 1, int(seconds) + 2))
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    os.chdir(root)
    os.environ |= {"PYTHONPATH": str(root), "HYDROLINKAGE_CACHE": cache, "NUMBA_CACHE_DIR": cache}
    sys.path[:] = [str(root), *(place for place in sys.path if place not in ("", str(ROOT)))]
    for name in [name for name in sys.modules if name.split(".")[0] == "tests"]:
        del sys.modules[name]
    silent = os.open(root.parent / "log.txt", os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    os.dup2(silent, 1)
    os.dup2(silent, 2)
    try:
        return work()
    except BaseException:
        traceback.print_exc()
        return 1


def run_tests(names: Sequence[str], plugins: Sequence[object] = ()) -> int:
    """Return pytest's answer for some files or tests, stopping at the first failure unless a plugin watches."""
    sys.argv = ["pytest"]
    stop = [] if plugins else ["-x"]
    return int(pytest.main([*stop, "-q", "-p", "no:cacheprovider", "--hypothesis-seed=0", *names], plugins=list(plugins)))


def test_files(copy: Copy, wanted: tuple[str, ...]) -> list[str]:
    """Return the files of the daily tests, those with examples in their docstrings and the pages included."""
    found = [*copy.root.glob("tests/**/test_*.py"), *copy.root.glob("docs/*.md"), copy.root / "README.md"]
    found += [file for room in ("linkage", "hydraulics") for file in copy.root.glob(f"{room}/**/*.py") if ">>>" in file.read_text()]
    names = sorted(file.relative_to(copy.root).as_posix() for file in found)
    return [name for name in names if name.startswith(wanted) and not name.startswith(NOT_ASKED)]


def reach(copy: Copy, folder: Path, wanted: tuple[str, ...]) -> dict[str, dict[str, Any]]:
    """Return what each test file runs, by file; asked once for every text of a test file."""
    found = {}
    for name in test_files(copy, wanted):
        digest = hashlib.sha256((copy.root / name).read_bytes()).hexdigest()[:12]
        kept = folder / f"{name.replace('/', '-')}-{digest}.json"
        if not kept.exists():
            started = time.monotonic()

            def watched(name: str = name, kept: Path = kept) -> int:
                plugin = Reach(copy.root, ROOMS)
                answer = run_tests([name], [plugin])
                kept.write_text(json.dumps(plugin.found()))
                return answer

            answer = in_child(copy.root, watched, 900.0)
            print(f"{name}: {time.monotonic() - started:.0f} s{'' if answer == PASSED else f', pytest says {answer}'}", flush=True)
        found[name] = json.loads(kept.read_text()) if kept.exists() else {"tests": {}, "collection": {}}
    return found


def matching(mutant: Mutant, found: dict[str, dict[str, Any]], seconds: float) -> list[list[str]]:
    """Return the tests that run a mutant's line, quickest first, in lots; then those that only use a class made by it."""
    own, other = [], []
    for each in found.values():
        bound = mutant.line in each["collection"].get(mutant.path, ())
        for name, test in each["tests"].items():
            if mutant.line in test["lines"].get(mutant.path, ()):
                own.append((test["seconds"], name))
            elif bound:
                other.append((test["seconds"], name))
    waiting, lots = [*sorted(own), *sorted(other)], []
    for most, files in (*STEPS, (seconds, len(waiting))):
        lot, used, spent, left = [], set(), 0.0, []
        for cost, name in waiting:
            file = name.split("::")[0]
            if (spent + cost <= most or not (lot or lots)) and (file in used or len(used) < files):
                lot.append(name)
                used.add(file)
                spent += cost
            else:
                left.append((cost, name))
        waiting = left
        if lot:
            lots.append(by_file(lot))
    return lots


def by_file(names: Iterable[str]) -> list[str]:
    """Return tests with those of one file together, files in the order of their first."""
    files = defaultdict(list)
    for name in names:
        files[name.split("::")[0]].append(name)
    return [name for each in files.values() for name in each]


def verdict(copy: Copy, mutant: Mutant, lots: list[list[str]], folder: Path, seconds: float) -> str:
    """Return what becomes of a mutant."""
    copy.write(mutant.path, mutant.new)
    try:
        for number, lot in enumerate(lots):
            listed = folder / "tests.txt"
            listed.write_text("\n".join(lot))
            allowed = 60.0 + 4.0 * (STEPS[number][0] if number < len(STEPS) else seconds)
            answer = in_child(copy.root, lambda listed=listed: imported_and_tested(f"@{listed}"), allowed)  # type: ignore[misc]
            if answer != PASSED:
                return BROKEN if answer == NOT_IMPORTED else KILLED
        return SURVIVED
    finally:
        copy.write(mutant.path, mutant.old)


def imported_and_tested(names: str) -> int:
    """Import the packages and run some tests."""
    try:
        for name in ("linkage", "linkage.statics", "hydraulics"):
            importlib.import_module(name)
    except Exception:
        return NOT_IMPORTED
    return run_tests([names])


def chosen(rooms: Sequence[str], count: int, seed: int) -> list[Mutant]:
    """Return so many mutants of the rooms: places drawn alike, one change of each."""
    places: dict[tuple[str, int, str], list[Mutant]] = defaultdict(list)
    for room in rooms:
        for file in sorted([*(ROOT / room).rglob("*.py")] if (ROOT / room).is_dir() else [ROOT / room]):
            path = file.relative_to(ROOT).as_posix()
            for mutant in mutants(path, file.read_text(encoding="utf-8")):
                places[path, mutant.line, mutant.kind].append(mutant)
    draw = random.Random(seed)
    drawn = draw.sample(list(places.values()), min(count, len(places)))
    return [draw.choice(each) for each in drawn]


def room_of(path: str) -> str:
    """Return the room a file is in."""
    return next((room for room in ROOMS if path.startswith(room)), path)


def report(results: Sequence[tuple[Mutant, str]]) -> str:
    """Return the table by room."""
    lines = [f"{'room':22s}{KILLED:>10s}{SURVIVED:>10s}{BROKEN:>10s}"]
    for room in [*dict.fromkeys(room_of(mutant.path) for mutant, _ in results), "all"]:
        count = Counter(fate for mutant, fate in results if room in (room_of(mutant.path), "all"))
        share = count[KILLED] / max(count[KILLED] + count[SURVIVED], 1)
        lines.append(f"{room:22s}{count[KILLED]:10d}{count[SURVIVED]:10d}{count[BROKEN]:10d}{share:10.1%}")
    return "\n".join(lines)


def main() -> None:
    """Make mutants, run the tests, print what survived."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--count", type=int, default=150)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--room", nargs="+", default=ROOMS, help="folders or files, such as linkage/steps")
    parser.add_argument("--seconds", type=float, default=60.0, help="of tests for each mutant")
    parser.add_argument("--first", type=int, default=0, help="leave out so many mutants of the list")
    parser.add_argument("--only", type=int, nargs="+", help="the numbers of the mutants to try, as an earlier run printed them")
    parser.add_argument("--tests", nargs="+", default=("",), help="folders or files of tests to choose from")
    parser.add_argument("--fresh", action="store_true", help="ask again which lines the tests run")
    parser.add_argument("--map", action="store_true", help="only ask which lines the tests run")
    options = parser.parse_args()
    kept = Path(tempfile.gettempdir()) / "hydrolinkage-mutants"
    if options.fresh:
        shutil.rmtree(kept, ignore_errors=True)
    kept.mkdir(exist_ok=True)
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    for name in HEAVY:
        with contextlib.suppress(ImportError):
            importlib.import_module(name)
    with tempfile.TemporaryDirectory(prefix="mutants-") as folder:
        copy = Copy(Path(folder))
        found = reach(copy, kept, tuple(options.tests))
        if not options.map:
            survey(copy, found, options, Path(folder))


def survey(copy: Copy, found: dict[str, dict[str, Any]], options: argparse.Namespace, folder: Path) -> None:
    """Try the mutants, print each one's fate and the table."""
    results = []
    for number, mutant in enumerate(chosen(options.room, options.count, options.seed)):
        if number < options.first or (options.only and number not in options.only):
            continue
        started = time.monotonic()
        lots = matching(mutant, found, options.seconds)
        fate = verdict(copy, mutant, lots, folder, options.seconds)
        results.append((mutant, fate))
        cost = f"{sum(map(len, lots))} tests, {time.monotonic() - started:.0f} s"
        print(f"{number:4d} {fate} {mutant.path}:{mutant.line} {mutant.kind}, {cost}", flush=True)
        if fate == SURVIVED:
            print(mutant.diff(), flush=True)
    print(report(results))


if __name__ == "__main__":
    main()
