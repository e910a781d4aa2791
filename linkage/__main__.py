"""`python -m linkage` is the command `hydrolinkage`."""

import sys

from .cli import main

if __name__ == "__main__":
    sys.exit(main())
