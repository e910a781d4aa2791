"""What verdicts say, as numbers."""

import re


def number(words, verdict):
    """Return the number that stands after some words of a verdict; the first one of all for no words."""
    found = re.search(rf"{words} ?(-?\d[\d.]*)", str(verdict))
    assert found, str(verdict)
    return float(found[1].rstrip("."))
