"""The command: `hydrolinkage`, same as `python -m linkage`."""

from ..star import declare_public
from .command import Command, main, option

declare_public(globals())
