"""The mower lift from its dimensions to a verdict: `python -m mechanisms.demo [--out FOLDER]`.

Prints the worksheet's table and what it means, and writes three pictures.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from linkage import FileError, Motion, animate, draw, plot
from linkage.disk import in_words
from linkage.reports import rich_tables, text_table
from linkage.units import kgf_cm2

from .mower_lift import MowerLift

TABLE_AT = np.linspace(0.55, 0.80, 6)  # the strokes of the worksheet's table, m
PLOTTED = ("I", "F", "pd", "kz")
RESERVE = (1.0, "kz = 1", "below")
WIDTH = 120  # of plain text, characters


def main(argv: Sequence[str] | None = None) -> int:
    """Run the demonstration; return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m mechanisms.demo", description="Compute the mower lift and draw it.")
    parser.add_argument("--out", type=Path, default=Path("out"), metavar="FOLDER", help="where the pictures go (default: out)")
    folder: Path = parser.parse_args(argv).out
    machine = MowerLift()
    motion = machine.sweep(101)
    columns = machine.columns(machine.at(S=TABLE_AT))
    if sys.stdout.isatty():
        from rich.console import Console

        console = Console()
        for table in rich_tables(columns, console.width):
            console.print(table)
    else:
        print(*text_table(columns, WIDTH), sep="\n")
    print()
    for verdict in machine.verdicts(motion):
        print(verdict.replace(". ", ".\n     "))
    print()
    try:
        with in_words(folder):
            folder.mkdir(parents=True, exist_ok=True)
        for picture in pictures(machine, motion, folder):
            print(f"wrote {picture}")
    except FileError as error:
        print(f"{error} Choose another folder with --out.", file=sys.stderr)
        return 2
    return 0


def pictures(machine: MowerLift, motion: Motion, folder: Path) -> list[Path]:
    """Return the pictures it wrote: the worksheet's four plots, the end positions, the animation."""
    p_max = float(machine["p_max"])
    limits = {"kz": RESERVE, "pd": (p_max, f"p_max = {p_max / kgf_cm2:.4g} kgf/cm²", "above")}
    by_name = {column.name: column for column in machine.columns(motion)}
    files = [folder / f"mower_lift_{kind}" for kind in ("curves.png", "poses.png")]
    plot(motion, [by_name[name] for name in PLOTTED], limits=limits).savefig(files[0])
    draw(machine, path=["G"]).savefig(files[1])
    return [*files, animate(machine, folder / "mower_lift.gif", column="kz", trace=["G"], limit=RESERVE)]


if __name__ == "__main__":
    sys.exit(main())
