"""`hydrolinkage doctor`: what is installed, what each part is for, and what is broken."""

from __future__ import annotations

import platform
import re
import sys
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator, Mapping, Sequence
from importlib.metadata import Distribution, EntryPoint, PackageNotFoundError, distribution, version
from importlib.util import find_spec
from pathlib import Path
from textwrap import wrap
from types import MappingProxyType
from typing import final

from .. import plugins
from ..errors import DefinitionError
from ..program.cache import cache_folder
from .command import Command
from .entry import PROGRAM, installed_version

EXTRAS: Mapping[str, str] = MappingProxyType(
    {
        "fast": "kernels compiled by Numba, for many poses and searches",
        "video": "animations as .mp4",
        "scale": "surveys over several computers",
        "pareto": "fronts of several objectives",
        "xlsx": "sheets with live formulas",
        "cad": "drawings as DXF",
        "docs": "building the documentation",
        "test": "running the tests",
    }
)
"""What each extra is for."""
BROKEN = 1
_NAME = re.compile(r"[A-Za-z0-9][\w.-]*")
_EXTRA = re.compile(r"""extra\s*==\s*['"]([^'"]+)['"]""")


@final
class DoctorCommand(Command):
    """Prints what is installed and what is broken."""

    name = "doctor"
    help = "versions, back ends, extras and what they are for, what is loaded from where, what is broken"

    def add(self, parser: ArgumentParser) -> None:
        """Declare nothing."""

    def run(self, options: Namespace) -> int:
        faults = list(broken())
        print(*in_lines(list(places())), sep="\n")
        for title, rows in (("Back ends", backends()), ("Packages", packages()), ("Entry points", entry_rows())):
            print(f"\n{title}", *(f"  {line}" for line in in_lines(list(rows), WIDE - 2)), sep="\n")
        print("\nBroken", *(f"  {line}" for text in faults or ["nothing"] for line in wrap(text, WIDE - 2)), sep="\n")
        return BROKEN if faults else 0


WIDE = 100
"""Letters of a line."""


def in_lines(rows: Sequence[Sequence[str]], wide: int = WIDE) -> Iterator[str]:
    """Yield rows of text as lines of so many letters at most: names below each other, and beside each what is said of it.

    What does not fit beside the name in one line stands below, part by part; a place that is too long for a line is cut.
    """
    size = max(len(name) for name, *_ in rows) + 2
    for name, *parts in rows:
        whole = "  ".join(part for part in parts if part)
        said = [whole] if len(whole) <= wide - size else [part for part in parts if part]
        lines = [line for part in said for line in wrap(part, wide - size, break_on_hyphens=False)] or [""]
        yield f"{name.ljust(size)}{lines[0]}".rstrip()
        yield from (f"{'':{size}}{line}" for line in lines[1:])


def places() -> Iterator[tuple[str, str]]:
    """Yield versions and places."""
    yield PROGRAM, f"{installed_version()} in {Path(__file__).parents[2]}"
    yield "Python", f"{platform.python_version()} ({platform.python_implementation()}) in {sys.executable}"
    yield "system", platform.platform()
    try:
        folder = cache_folder()
        kept = f"{sum(1 for each in folder.rglob('*') if each.is_file())} files" if folder.is_dir() else "not there yet"
        yield "kernels are kept in", f"{folder} ({kept})"
    except (OSError, RuntimeError) as error:
        yield "kernels are kept in", f"nowhere: {error}"
    yield "letters in pictures", font()
    yield "ffmpeg", ffmpeg()


def font() -> str:
    """Return the font of pictures."""
    if find_spec("matplotlib") is None:
        return "none: matplotlib is not there"
    from matplotlib import rcParams
    from matplotlib.font_manager import FontProperties, findfont

    family = rcParams["font.family"]
    return f"{', '.join(rcParams['font.sans-serif'][:1] if family == ['sans-serif'] else family)}, {findfont(FontProperties())}"


def ffmpeg() -> str:
    """Return where ffmpeg is."""
    if find_spec("imageio_ffmpeg") is None:
        return "not there: no .mp4; pip install 'hydrolinkage[video]'"
    import imageio_ffmpeg

    try:
        return str(imageio_ffmpeg.get_ffmpeg_exe())
    except RuntimeError as error:
        return f"not there: {' '.join(str(error).split())}"


def backends() -> Iterator[tuple[str, str]]:
    """Yield the back ends, and what each is for."""
    yield "floats", "a handful of poses"
    yield "numpy", f"{version('numpy')}, the default"
    yield "numba", f"{installed('numba') or 'not there, pip install hydrolinkage[fast]'}, where the work is worth the compile"


def installed(name: str) -> str:
    """Return the version of a package; "" where it is not installed."""
    try:
        return version(name)
    except PackageNotFoundError:
        return ""


def packages() -> Iterator[tuple[str, str, str]]:
    """Yield what is required, then every extra: what it brings, in which version, and what for."""
    try:
        wanted = distribution(PROGRAM).requires or []
    except PackageNotFoundError:
        yield "nothing", "", f"{PROGRAM} is not installed here; pip install -e ."
        return
    by_extra: dict[str, list[str]] = {"": []}  # what is required stands first
    for text in wanted:
        name, of = _NAME.match(text), _EXTRA.search(text)
        by_extra.setdefault(of[1] if of else "", []).append(name[0] if name else text)
    for extra, names in by_extra.items():
        there = ", ".join(f"{name} {installed(name) or '(not there)'}" for name in names)
        what = f"for {EXTRAS[extra]}" if extra in EXTRAS else ""
        yield extra or "required", what, there


def entry_rows() -> Iterator[tuple[str, str, str]]:
    """Yield what packages bring, group by group: how many, names where calls say them, from which distribution, from where."""
    for group, what in plugins.GROUPS.items():
        homes: dict[tuple[str, str], list[str]] = {}
        for entry in plugins.entry_points(group).values():
            homes.setdefault(home_of(entry), []).append(entry.name)
        for (name, where), names in homes.items():
            named = f": {', '.join(names)}" if group in (plugins.EXPORTERS, plugins.LANGUAGES, plugins.BACKENDS) else ""
            yield f"{len(names)} {what}{named}", f"of {name}", where


def home_of(entry: EntryPoint) -> tuple[str, str]:
    """Return the distribution that brings something, with its version, and the folder of its code."""
    found: Distribution | None = entry.dist
    spec = find_spec(entry.module.partition(".")[0])
    where = str(Path(spec.origin).parents[1]) if spec and spec.origin else "not found"
    return f"{found.metadata['Name']} {found.version}" if found else "an unknown package", where


def broken() -> Iterator[str]:
    """Yield what cannot be loaded, with its reason."""
    for group, what in plugins.GROUPS.items():
        for entry in plugins.entry_points(group).values():
            try:
                plugins.guarded(entry.load, f"{entry.name} of the {what} ({entry.value})")
            except DefinitionError as error:
                yield " ".join(str(error).split())
