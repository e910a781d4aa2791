"""Where a picture goes: its path, checked before the work is done."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Sequence
from pathlib import Path

from ..disk import check_place
from ..errors import DefinitionError
from ..mechanism import Mechanism

PICTURES = (".png", ".svg", ".pdf")


def picture_argument(parser: ArgumentParser, what: str) -> None:
    """Declare the argument that names a picture's file."""
    parser.add_argument("-o", "--output", metavar="FILE", help=f"{', '.join(PICTURES)} ({what})")


def picture(given: str | None, machine: type[Mechanism], text: str, suffixes: Sequence[str] = PICTURES) -> Path:
    """Return the path of a picture; by default the machine's name with the first suffix, in this folder.

    Raises DefinitionError for a suffix that is not among them, FileError for a place that cannot be written.
    """
    path = Path(given if given is not None else (text if text.isidentifier() else machine.__name__) + suffixes[0])
    if path.suffix.lower() not in suffixes:
        raise DefinitionError(f"-o {path}: the file's name ends in one of {', '.join(suffixes)}, which chooses the format.")
    check_place(path)
    return path


def figure_path(options: Namespace, machine: type[Mechanism], command: str) -> Path | None:
    """Return where a command's figure goes, checked before the work is done; None where neither a file nor a figure is asked for."""
    if options.output is None and options.figure is None:
        return None
    return picture(options.output, machine, f"{command}_{options.figure}")
