"""The door of the command: arguments in, exit code out, every deliberate failure in one line, a file's mistakes in one each."""

from __future__ import annotations

import os
import sys
import warnings
from argparse import ArgumentParser, Namespace
from collections.abc import Iterable, Sequence
from importlib.metadata import EntryPoint, PackageNotFoundError, entry_points, version
from typing import Any, NoReturn, final

from ..errors import DefinitionError, FileError, LinkageError, SingularWarning, unknown
from .command import Command

# The commands there are: the built-in ones, and those of other packages by entry point.

GROUP = "hydrolinkage.commands"
HOMES = {
    "list": "listing:ListCommand",
    "show": "show:ShowCommand",
    "table": "table:TableCommand",
    "plot": "plot:PlotCommand",
    "animate": "plot:AnimateCommand",
    "export": "export:ExportCommand",
    "save": "show:SaveCommand",
    "optimise": "optimise:OptimiseCommand",
    "study": "study:StudyCommand",
}
BUILT_IN = {name: EntryPoint(name, f"{__package__}.{home}", GROUP) for name, home in HOMES.items()}


def commands_for(arguments: Sequence[str]) -> list[Command]:
    """Return the command that the arguments begin with, all commands where they begin with none; no other one is loaded.

    Raises DefinitionError for an unknown command, naming the nearest.
    """
    word = arguments[0] if arguments and not arguments[0].startswith("-") else ""
    if word in BUILT_IN:
        return [load_command(BUILT_IN[word])]
    added = {entry.name: entry for entry in entry_points(group=GROUP)}
    if word in added:
        return [load_command(added[word])]
    if word:
        raise unknown("Command", word, [*BUILT_IN, *added])
    return [*map(load_command, BUILT_IN.values()), *working(added.values())]


def load_command(entry: EntryPoint) -> Command:
    """Return another package's command; DefinitionError where it cannot be loaded or is none."""
    try:
        found = entry.load()
    except Exception as error:
        raise DefinitionError(f"The command {entry.name} ({entry.value}) cannot be loaded: {type(error).__name__}: {error}") from error
    if not (isinstance(found, type) and issubclass(found, Command)):
        raise DefinitionError(f"The command {entry.name} ({entry.value}) is no subclass of linkage.cli.Command.")
    return found()


def working(entries: Iterable[EntryPoint]) -> list[Command]:
    """Return the commands that can be loaded; of the others say on stderr why not."""
    commands = []
    for entry in entries:
        try:
            commands.append(load_command(entry))
        except DefinitionError as error:
            print(f"hydrolinkage: warning: {error}", file=sys.stderr)
    return commands


PROGRAM = "hydrolinkage"
BAD_INPUT, INTERRUPTED, PIPE_CLOSED = 2, 130, 141


@final
class OneLineParser(ArgumentParser):
    """A parser that reports a mistake in one line."""

    def error(self, message: str) -> NoReturn:
        raise DefinitionError(f"{message}; see {self.prog} --help.")


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code: 0, 2 for what the user can mend, 130 after Ctrl-C, 141 into a closed pipe."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("default", SingularWarning)
            warnings.showwarning = say_warning
            code = execute(list(sys.argv[1:] if argv is None else argv))
            sys.stdout.flush()
            return code
    except FileError as error:
        if isinstance(error.__cause__, BrokenPipeError):
            close_stdout()
            return PIPE_CLOSED
        return fail(*str(error).splitlines())
    except LinkageError as error:
        return fail(str(error))
    except BrokenPipeError:
        close_stdout()
        return PIPE_CLOSED
    except KeyboardInterrupt:
        return INTERRUPTED
    except OSError as error:
        return fail(f"{error.filename}: {error.strerror}." if error.filename else str(error))
    except MemoryError:
        return fail("not enough memory for so many poses; lower --count.")
    except SystemExit as leaving:  # argparse, after --help and --version
        return int(leaving.code or 0)


def execute(arguments: list[str]) -> int:
    """Return the exit code of the command that the arguments name."""
    commands = commands_for(arguments)
    what = "Planar linkages moved by cylinders: numbers, equations and pictures."
    parser = OneLineParser(prog=PROGRAM, description=what, allow_abbrev=False)
    parser.add_argument("--version", action="version", version=f"{PROGRAM} {installed_version()}")
    subparsers = parser.add_subparsers(metavar="COMMAND", dest="command")
    for command in commands:
        branch = subparsers.add_parser(command.name, help=command.help, description=command.help, allow_abbrev=False)
        command.add(branch)
        branch.set_defaults(run=command.run)
    options = parse_arguments(parser, arguments)
    if options.command is None:
        parser.print_help(sys.stderr)
        return BAD_INPUT
    return int(options.run(options))


def parse_arguments(parser: OneLineParser, arguments: list[str]) -> Namespace:
    """Return the arguments by name; names of columns may stand behind options, where argparse leaves them over."""
    options, left = parser.parse_known_args(arguments)
    names = [word for word in left if word != "--"]
    if names and ("columns" not in options or any(word.startswith("-") for word in names)):
        parser.error(f"unrecognized arguments: {' '.join(left)}")
    if names:
        options.columns = [*options.columns, *names]
    return options


def installed_version() -> str:
    """Return the installed version; the checkout's where nothing is installed."""
    try:
        return version(PROGRAM)
    except PackageNotFoundError:
        return "(not installed)"


def fail(*messages: str) -> int:
    """Say on stderr what was wrong, each in one line, and return the exit code."""
    print(f"{PROGRAM}:", "\n  ".join(" ".join(message.split()) for message in messages), file=sys.stderr)
    return BAD_INPUT


def say_warning(message: Warning | str, *where: Any, **more: Any) -> None:
    """Say a warning in one line on stderr."""
    print(f"{PROGRAM}: warning: {' '.join(str(message).split())}", file=sys.stderr)


def close_stdout() -> None:
    """Let nothing more be written into the closed pipe, so that leaving is silent."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
