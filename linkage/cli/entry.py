"""The door of the command: arguments in, exit code out, every deliberate failure in one line, a file's mistakes in one each."""

from __future__ import annotations

import atexit
import gc
import os
import re
import sys
import warnings
from argparse import ArgumentParser
from collections.abc import Callable, Sequence
from contextlib import redirect_stdout
from importlib.metadata import EntryPoint, PackageNotFoundError, version
from typing import Any, NoReturn, TextIO, cast

from .. import plugins
from ..disk import check_place, reason, spoken
from ..errors import DefinitionError, FileError, LinkageError, SingularWarning, unknown
from ..language import ENGLISH, language, languages
from ..units import SYSTEMS, unit_system
from .command import Command

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
        atexit.register(gc.freeze)  # Python looks for circles among them once more as it ends, which takes a tenth of a report
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
