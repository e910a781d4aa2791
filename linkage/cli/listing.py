"""`hydrolinkage list`: the machines there are."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace

from ..errors import DefinitionError
from ..report import aligned
from .command import Command
from .machines import OWN, find, registered


class List(Command):
    """Prints every installed machine with its first line."""

    name = "list"
    help = "the machines there are"

    def add(self, parser: ArgumentParser) -> None:
        """Declare nothing."""

    def run(self, options: Namespace) -> int:
        rows = []
        for name in registered():
            try:
                rows.append((name, (find(name).__doc__ or "").strip().partition("\n")[0]))
            except DefinitionError as error:
                print(f"hydrolinkage: warning: {error}", file=sys.stderr)
        if not rows:
            raise DefinitionError(f"No machine is installed; install the package (pip install -e .). {OWN}")
        for line in aligned(rows):
            print(line)
        return 0
