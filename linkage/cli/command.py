"""What a command is. A package of your own adds one by an entry point of the group `hydrolinkage.commands`."""

from __future__ import annotations

from abc import ABC, abstractmethod
from argparse import ArgumentParser, ArgumentTypeError, Namespace

MOST = 100_000_000
"""Poses of a command."""


class Command(ABC):
    """A command of `hydrolinkage`: its words for the help, its arguments, and what it does."""

    name: str
    help: str

    @abstractmethod
    def add(self, parser: ArgumentParser) -> None:
        """Declare the command's arguments."""

    @abstractmethod
    def run(self, options: Namespace) -> int:
        """Do it and return the exit code; a LinkageError ends it with one line and exit code 2."""


def machine_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments that every command on a machine has."""
    parser.add_argument("machine", metavar="NAME", help="a machine of `list`, package.module:Class, file.py, file.py:Class or file.toml")
    parser.add_argument(
        "--set", dest="settings", metavar="OB=180mm", action="append", default=[],
        help="change a design variable, with its unit (without: SI); a point: M=0.22,0.95 or M.x=220mm; repeatable",
    )  # fmt: skip


def path_argument(parser: ArgumentParser) -> None:
    """Declare the argument that chooses whose paths are drawn."""
    parser.add_argument("--path", metavar="G", action="append", help="draw this point's path (default: the last point built); repeatable")


def motion_arguments(parser: ArgumentParser, count: int) -> None:
    """Declare the arguments that choose the poses."""
    parser.add_argument("--count", metavar="N", type=counted, default=count, help=f"poses over each stroke (default {count})")
    parser.add_argument(
        "--at", dest="strokes", metavar="S=0.6,650mm", action="append", default=[], help="chosen stroke values instead; repeatable"
    )


def counted(text: str) -> int:
    """Return a count of at least 1; ArgumentTypeError for anything else."""
    try:
        count = int(text)
    except ValueError:
        count = 0
    if count < 1:
        raise ArgumentTypeError(f"{text!r} is not a count; give a whole number from 1 on")
    if count > MOST:
        raise ArgumentTypeError(f"{text} poses do not fit into memory; lower --count, such as to 1001")
    return count
