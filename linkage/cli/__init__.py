"""The command: `hydrolinkage`, same as `python -m linkage`."""

from .command import Command
from .entry import main
