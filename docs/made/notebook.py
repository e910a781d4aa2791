"""The notebook as a page."""
from pathlib import Path


def make(path: Path, page: Path) -> None:
    """Write it."""
    page.write_text("", encoding="utf-8")
