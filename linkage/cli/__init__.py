"""The command: `hydrolinkage`, same as `python -m linkage`."""

from ..star import declare_public
from .command import Command, option
from .entry import main

declare_public(globals())
