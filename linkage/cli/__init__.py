"""The command: `hydrolinkage`, same as `python -m linkage`."""

from .command import Command as Command
from .main import main as main
