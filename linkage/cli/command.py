"""Commands, and their door: arguments in, exit code out, every deliberate failure in one line, a file's mistakes in one each.

A package of your own adds a command by an entry point of the group `hydrolinkage.commands`.
"""

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
import gc
import os
import re
import warnings
from contextlib import redirect_stdout
from importlib.metadata import EntryPoint, PackageNotFoundError, version
from typing import Any, NoReturn, TextIO, cast

from .. import plugins
from ..disk import reason, spoken
from ..errors import DefinitionError, FileError, LinkageError, SingularWarning, unknown
from ..language import ENGLISH, language, languages
from ..units import SYSTEMS, unit_system

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
    """Let Matplotlib, as it loads, write no lists of properties into its help, which takes 0.2 s and which no command shows."""
    import matplotlib.artist

    matplotlib.artist.kwdoc = lambda artist: ""


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


# The commands there are: the built-in ones, and those of other packages by entry point.

HOMES = {
    "list": "listing", "show": "show", "table": "table", "follow": "follow", "chart": "follow",
    "limits": "table", "forces": "table", "draw": "report", "plot": "report", "animate": "report", "page": "report", "report": "report",
    "export": "export", "save": "export", "optimise": "optimise", "synthesise": "optimise", "study": "optimise", "new": "export",
    "import": "import_file", "board": "board",
}  # fmt: skip
"""The built-in commands, in the order of the help, each with its file."""
BUILT_IN = {name: EntryPoint(name, f"{__package__}.{home}:{name}_command", plugins.COMMANDS) for name, home in HOMES.items()}


def commands_for(arguments: Sequence[str]) -> list[Command]:
    """Return the command that the arguments begin with, all commands where they begin with none; no other one is loaded.

    Raises DefinitionError for an unknown command, naming the nearest.
    """
    word = arguments[0] if arguments and not arguments[0].startswith("-") else ""
    if word in BUILT_IN:
        return [load_command(BUILT_IN[word])]
    added = plugins.entry_points(plugins.COMMANDS)
    if word in added:
        return [load_command(added[word])]
    if word:
        raise unknown("Command", word, [*BUILT_IN, *added])
    commands = [*map(load_command, BUILT_IN.values())]
    for entry in added.values():
        try:
            commands.append(load_command(entry))
        except DefinitionError as error:  # the others are there
            print(f"hydrolinkage: warning: {error}", file=sys.stderr)
    return commands


def load_command(entry: EntryPoint) -> Command:
    """Return a command; DefinitionError where it cannot be loaded or is none."""
    title = f"The command {entry.name} ({entry.value})"
    found = plugins.guarded(entry.load, title)
    if not isinstance(found, Command):
        raise DefinitionError(f"{title} is no linkage.cli.Command; write a function under @Command(name, help, *options).")
    return found


PROGRAM = "hydrolinkage"
BAD_INPUT, INTERRUPTED, PIPE_CLOSED = 2, 130, 141


class OneLineParser(ArgumentParser):
    """A parser that reports a mistake in one line."""

    def error(self, message: str) -> NoReturn:
        word = message.partition("unrecognized arguments: ")[2].partition(" ")[0].partition("=")[0]
        takers = [each.name for each in commands_for([]) if takes(each, word)] if word.startswith("--") else []
        others = f"; {word} is of {', '.join(takers)}" if takers else ""
        raise DefinitionError(f"{message}{others}; see {self.prog} --help.")


def takes(command: Command, option: str) -> bool:
    """Return whether a command takes an option, as its help says."""
    parser = ArgumentParser(add_help=False)
    command.add(parser)
    return re.search(rf"{re.escape(option)}(?![\w-])", parser.format_usage()) is not None


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code: 0, 2 for a user's mistake, 130 after Ctrl-C, 141 into a closed pipe."""
    if argv is None:
        gc.set_threshold(1_000_000, 20, 20)  # programs are many small lasting objects: with Python's 700 a report takes a sixth longer
        os.environ.setdefault("OMP_NUM_THREADS", "1")  # matrices are small: threads of BLAS only wait for each other; NumPy comes later
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("default", SingularWarning)
            warnings.showwarning = say_warning
            return execute(list(sys.argv[1:] if argv is None else argv))
    except (LinkageError, BrokenPipeError) as error:
        if any(isinstance(each, BrokenPipeError) for each in (error, error.__cause__)):
            close_stdout()
            return PIPE_CLOSED
        return fail(*(str(error).splitlines() if isinstance(error, FileError) else [str(error)]))
    except KeyboardInterrupt:
        return INTERRUPTED
    except OSError as error:
        return fail(f"{spoken(error.filename)}: {reason(error)}." if error.filename else str(error))
    except MemoryError:
        return fail("not enough memory for so many poses; lower --count.")
    except SystemExit as leaving:  # argparse, after --help and --version
        return int(leaving.code or 0)


def execute(arguments: list[str]) -> int:
    """Return the exit code of the command that the arguments name."""
    arguments = rearranged(arguments)
    commands = commands_for(arguments)
    if arguments and not arguments[0].startswith("-"):
        (command,) = commands
        parser = OneLineParser(prog=f"{PROGRAM} {command.name}", description=command.help, allow_abbrev=False)
        command.add(parser)
        common = parser.add_argument_group("of every command")  # stand behind its own
        common.add_argument("--units", choices=SYSTEMS, help="show everything in one system of units (default: each number in its own)")
        common.add_argument("--language", choices=languages(), default=ENGLISH, help="the language of sentences and headings")
        try:
            options = parser.parse_intermixed_args(arguments[1:])
        except TypeError:  # a command with commands of its own takes them as they stand
            options = parser.parse_args(arguments[1:])
        files = {name: getattr(options, name, None) for name in FILES}
        if files["csv"] not in (None, "-"):
            check_place(files["csv"])  # before the work, of which nothing would be left
        output = LastingOutput(sys.stdout, lasts=any(each not in (None, "-") for each in files.values()))
        with redirect_stdout(cast(TextIO, output)), unit_system(options.units), language(options.language):
            code = int(command.run(options))
            code = PIPE_CLOSED if output.broken else code
            output.flush()
            return code
    what = "Planar linkages moved by cylinders: numbers, equations and pictures."
    parser = OneLineParser(prog=PROGRAM, description=what, allow_abbrev=False)
    try:
        installed = version(PROGRAM)
    except PackageNotFoundError:
        installed = "(not installed)"
    parser.add_argument("--version", action="version", version=f"{PROGRAM} {installed}")
    subparsers = parser.add_subparsers(metavar="COMMAND", dest="command")
    for command in commands:
        subparsers.add_parser(command.name, help=command.help)
    parser.parse_args(arguments)
    parser.print_help(sys.stderr)
    return BAD_INPUT


COMMON = ("--units", "--language")
PAIRED = ("--cylinder", "--drive")


def rearranged(arguments: list[str]) -> list[str]:
    """Return arguments with those of every command, where they stand first, behind the command.

    A value that begins with a minus sign is joined to its option, `--y -1:2` as `--y=-1:2`: it is no option. Two pins in one text,
    `--cylinder "A B=300mm"`, are two.
    """
    first: list[str] = []
    rest = arguments
    while rest and rest[0].partition("=")[0] in COMMON:
        count = 1 if "=" in rest[0] else 2
        first, rest = [*first, *rest[:count]], rest[count:]
    found: list[str] = []
    for each in [*rest[:1], *first, *rest[1:]] if rest and not rest[0].startswith("-") else arguments:
        if found and re.fullmatch(r"--\w[\w-]*", found[-1]) and re.match(r"-[\d.]", each):
            found[-1] += f"={each}"
        elif found and found[-1] in PAIRED and len(each.split()) == 2 and "=" in each:
            found += each.split()
        else:
            found.append(each)
    return found


# A reader that has gone, as `head` does: what is written into files is written all the same.

FILES = ("output", "csv", "folder", "file", "pictures")
"""Arguments that name a file which a command writes, or one that says which it writes."""


class LastingOutput:
    """Standard output that goes on in silence where nobody reads it any more; `broken` says so."""

    def __init__(self, stream: TextIO, *, lasts: bool) -> None:
        self.stream, self.lasts, self.broken = stream, lasts, False

    def __getattr__(self, name: str) -> Any:
        """Return an attribute of the stream."""
        return getattr(self.stream, name)

    def write(self, text: str) -> int:
        """Write a text, or drop it."""
        return self._unbroken(lambda: self.stream.write(text)) or 0

    def flush(self) -> None:
        """Flush the written text."""
        self._unbroken(self.stream.flush)

    def _unbroken(self, act: Callable[[], object]) -> Any:
        if self.broken:
            return None
        try:
            return act()
        except BrokenPipeError:
            if not self.lasts:
                raise
            self.broken = True
            close_stdout()
            return None


def fail(*messages: str) -> int:
    """Print mistakes on stderr, each in one line, and return the exit code."""
    print(f"{PROGRAM}:", "\n  ".join(" ".join(message.split()) for message in messages), file=sys.stderr)
    return BAD_INPUT


def say_warning(message: Warning | str, *where: object, **more: object) -> None:
    """Say a warning in one line on stderr."""
    print(f"{PROGRAM}: warning: {' '.join(str(message).split())}", file=sys.stderr)


def close_stdout() -> None:
    """Let nothing more be written into the closed pipe, so that leaving is silent."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
