"""Examples write where nothing is kept, and those of pages that take long are run with what is slow."""

from pathlib import Path

import pytest

LONG = {"crane", "excavator", "export", "machines_at_work", "misses", "redesign", "studies"}
"""Pages whose examples design whole machines, or search at length."""


@pytest.fixture(autouse=True)
def own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let each page's examples write into a folder of their own."""
    monkeypatch.chdir(tmp_path)


def pytest_itemcollected(item: pytest.Item) -> None:
    """Mark the examples of long pages as slow."""
    if item.path.stem in LONG:
        item.add_marker(pytest.mark.slow)
