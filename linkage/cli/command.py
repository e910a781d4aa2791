"""Commands. A package of your own adds one by an entry point of the group `hydrolinkage.commands`."""

from __future__ import annotations

import sys
from argparse import Action, ArgumentParser, ArgumentTypeError, Namespace, _ActionsContainer
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from operator import methodcaller
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias
from urllib.parse import parse_qsl

from ..disk import check_place
from ..errors import ensure
from ..language import said

if TYPE_CHECKING:
    from ..mechanism import Mechanism

MOST = 1_000_000
"""Poses of a command."""
Option: TypeAlias = Callable[[_ActionsContainer], object]
"""What declares an option, or a group of them, with a parser."""


def option(*names: str, **how: object) -> Option:
    """Return an option of a command.

    Parameters
    ----------
    *names : str
        How it is written, "-o", "--output"; a name without dashes is a value that stands by its place.
    **how : object
        What argparse's `add_argument` takes beside them: `metavar`, `default`, `type`, `help` and others.

    Returns
    -------
    Option
        What declares it with a parser.
    """
    return methodcaller("add_argument", *names, **how)


class Command:
    """A command of `hydrolinkage`: its name, its words for the help, its options, and the function that does it, which it decorates.

    The function takes the options' values and returns the exit code; a LinkageError ends it with one line and exit code 2.

    Parameters
    ----------
    name, help : str
        What stands behind `hydrolinkage`, and what the help says of it.
    *options : Option
        What it takes, each as `option` returns it.
    """

    name: str
    help: str
    run: Callable[[Namespace], int]

    def __init__(self, name: str, help: str, *options: Option) -> None:
        self.name, self.help, self.options = name, help, options

    def __call__(self, run: Callable[[Namespace], int]) -> Command:
        """Take the function that does it."""
        self.run = run
        return self

    def add(self, parser: ArgumentParser) -> None:
        """Declare the options with a parser."""
        for each in self.options:
            each(parser)


def group(title: str, *options: Option, about: str | None = None) -> Option:
    """Return options that stand together under a title in the help."""

    def declare(parser: _ActionsContainer) -> None:
        made = parser.add_argument_group(title, about)
        for each in options:
            each(made)

    return declare


def repeatable(name: str, metavar: str, help: str, dest: str | None = None) -> Option:
    """Return an option that may be given several times: a list of texts."""
    return option(name, metavar=metavar, action="append", default=[], help=help, dest=dest)


class FromLink(Action):
    """Takes the dimensions of a live page's link, as if `--set` had said them."""

    def __call__(self, parser: ArgumentParser, namespace: Namespace, values: object, option: str | None = None) -> None:
        said = parse_qsl(str(values).rpartition("#")[2], keep_blank_values=True)
        found = [f"{name[2:]}={value}" for name, value in said if name.startswith("d.")]
        if not any(name.startswith(("d.", "s.")) for name, _ in said):
            remedy = "its button Copy link gives one, such as page.html#s.S=0.1&d.OB=0.315"
            parser.error(f"--from {values}: this is no link of a live page; {remedy}")
        namespace.settings = [*namespace.settings, *found]


LINK = option("--from", dest="settings", metavar="LINK", action=FromLink, help="the design of a live page, by its link's text")
PATH = option("--path", metavar="G", action="append", help="draw this point's path (default: what it is about); repeatable")
EVERY = option("--every", metavar="25mm", help="a row every so much of the stroke that runs, instead of --count rows")
CSV = option("--csv", metavar="FILE", help="write the table as CSV in full precision instead; - for stdout")
COLUMNS = "only these columns (default: all), or what is asked for in words: 'pressure(lift)', 'ratio(G.y)'"


def machine_options(default: str | None = None) -> tuple[Option, ...]:
    """Return the options of every command on a machine; with a `default` the machine need not be named."""
    what = "a machine of `list`, package.module:Class, file.py, file.py:Class or file.toml, also one of a design: `machine` and `[set]`"
    own = option("--machine", dest="own", metavar="CLASS", help="the class of the design that a file holds, file.py:Class")
    named: dict[str, object] = {"help": what}
    if default is not None:
        named = {"nargs": "?", "default": default, "help": f"{what} (default {default})"}
    change = "change a design variable, with its unit (without: SI); a point: M=0.22,0.95 or M.x=220mm; repeatable"
    return option("machine", metavar="NAME", **named), repeatable("--set", "OB=180mm", change, "settings"), own, LINK


def count_option(count: int, what: str) -> Option:
    """Return the option that says how many poses there are."""
    return option("--count", metavar="N", type=whole_number, default=count, help=f"{what} (default {count})")


def run_options(count: int, what: str) -> tuple[Option, ...]:
    """Return the options that choose the run, and its number of poses."""
    at = (
        "hold a stroke at a value, or run between two: S=0.1,650mm; without it the machine's own Over runs, else the first stroke, the "
        "others held at mid-stroke"
    )
    return count_option(count, what), repeatable("--at", "S=0.6", at, "strokes")


def pose_options(count: int) -> tuple[Option, ...]:
    """Return the options that choose the poses."""
    at = (
        "these values of a stroke instead; repeatable. Without it the machine's own Overs run, else the first stroke; others are held at "
        "mid-stroke"
    )
    return count_option(count, "poses over the stroke"), repeatable("--at", "S=0.6,650mm", at, "strokes")


def whole_number(text: str) -> int:
    """Return a count of at least 1; ArgumentTypeError for anything else."""
    try:
        count = int(text)
    except ValueError:
        count = 0
    if count < 1:
        raise ArgumentTypeError(f"{text!r} is not a count; give a whole number from 1 on")
    if count > MOST:
        raise ArgumentTypeError(f"{text} poses are more than the {MOST} of one command; lower --count, such as to 1001")
    return count


# Where a picture goes: its path, checked before the work is done.

PICTURES = (".png", ".svg", ".pdf")


def picture_option(what: str) -> Option:
    """Return the option that names a picture's file."""
    return option("-o", "--output", metavar="FILE", help=f"{', '.join(PICTURES)} ({what})")


def picture(options: Namespace, machine: Mechanism, suffixes: Sequence[str] = PICTURES, name: str = "") -> Path:
    """Return the path of a picture; by default a name or the machine's with the first suffix, in this folder.

    Raises DefinitionError for a suffix that is not among them, FileError for a place that cannot be written.
    """
    path = Path(default_name(options, machine, name) + suffixes[0] if options.output is None else options.output)
    ensure(path.suffix.lower() in suffixes, f"-o {path}: the file's name ends in one of {', '.join(suffixes)}, which chooses the format.")
    check_place(path)
    return path


def without_lists_of_properties() -> None:
    """Let Matplotlib, as it loads, write no lists of properties for its help, which takes 0.3 s and which no command shows."""
    import matplotlib.artist

    matplotlib.artist.kwdoc = lambda artist: ""
    setattr(matplotlib.artist.Artist, "_update_set_signature_and_docstring", bool)  # noqa: B010


def default_name(options: Namespace, machine: Mechanism, name: str = "") -> str:
    """Return the name of a file that is not named, without its suffix: the machine's, unless another one is given."""
    name = name or options.machine
    return name if name.isidentifier() else type(machine).__name__


def figure_path(options: Namespace, machine: Mechanism, command: str) -> Path | None:
    """Return where a command's figure goes, checked before the work is done; None where neither a file nor a figure is asked for."""
    asked = options.output is not None or options.figure is not None
    return picture(options, machine, name=f"{command}_{options.figure}") if asked else None


# What is said beside the results, on stderr, so that they can go into a pipe.


def say_remark(text: str) -> None:
    """Print on stderr, in one line, a remark on the results."""
    print(f"hydrolinkage: {said('remark')}: {' '.join(text.split())}", file=sys.stderr)


# A progress bar on a terminal, nothing in a pipe.

Progress: TypeAlias = Callable[[int, int], None]


def say_progress(done: int, total: int) -> None:
    """Say on stderr how far the work is."""
    print(f"{done} of {total}", file=sys.stderr, flush=True)


@contextmanager
def progress_bar(title: str, *, in_lines: bool = False) -> Iterator[Progress | None]:
    """Yield a progress function (done, total), which draws a bar on stderr; where that is no terminal one that says lines, or None."""
    if not sys.stderr.isatty():
        yield say_progress if in_lines else None
        return
    from rich.console import Console
    from rich.progress import Progress as Bar

    with Bar(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(title, total=None)
        yield lambda done, total: bar.update(task, completed=done, total=total)
