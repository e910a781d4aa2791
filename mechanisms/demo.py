"""The mower lift from its dimensions to a verdict: `python -m mechanisms.demo [--out FOLDER]`.

Runs the commands that print the worksheet's table with what it means, and write three pictures; each is said before it runs.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from linkage import FileError
from linkage.cli import main as run
from linkage.disk import new_folder

COMMANDS = (
    ("table", "mower_lift", "--at", "S=0.55,0.6,0.65,0.7,0.75,0.8", "--check"),
    ("plot", "mower_lift", "I", "F", "pd", "kz", "-o", "mower_lift_curves.png"),
    ("draw", "mower_lift", "--path", "G", "-o", "mower_lift_poses.png"),
    ("animate", "mower_lift", "--column", "kz", "--path", "G", "-o", "mower_lift.gif"),
)
"""Arguments of `hydrolinkage`; a file's name is the last one."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the demonstration; return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m mechanisms.demo", description="Compute the mower lift and draw it.")
    parser.add_argument("--out", type=Path, default=Path("out"), metavar="FOLDER", help="where the pictures go (default: out)")
    folder: Path = parser.parse_args(argv).out
    try:
        new_folder(folder)
    except FileError as error:
        print(f"{error} Choose another folder with --out.", file=sys.stderr)
        return 2
    for command in COMMANDS:
        *options, last = command
        arguments = [*options, str(folder / last) if "-o" in options else last]
        print(f"\n$ hydrolinkage {' '.join(arguments)}\n")
        code = run(arguments)
        if code > 1:  # 1: the lift's verdict fails, which is what the table shows
            return code
    return 0


if __name__ == "__main__":
    sys.exit(main())
