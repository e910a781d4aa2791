"""The command: `hydrolinkage`, same as `python -m linkage`."""

from ..star import declare_public
from .command import Command
from .entry import main

declare_public(globals())
