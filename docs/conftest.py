"""Examples write where nothing is kept, and those of pages that take long are run with what is slow."""

from pathlib import Path

import pytest

LONG = {
    "closed_curve", "crane", "crane_drives", "cycle", "cylinder_in_a_search", "docs/files", "dwell", "exact_synthesis", "excavator",
    "export", "grapple", "header_balancer", "howto/forces", "howto/notebook", "levelled", "machines_at_work", "misses", "one_pump", "path",
    "planes", "poses", "redesign", "redesigns", "regions", "studies",
}  # fmt: skip
"""Pages whose examples search, only draw, or tell figures of machines at length, which the tests of these machines hold.

A page whose name a how-to has, too, stands here with its folder.
"""


@pytest.fixture(autouse=True)
def own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let each page's examples write into a folder of their own."""
    monkeypatch.chdir(tmp_path)


def pytest_itemcollected(item: pytest.Item) -> None:
    """Mark the examples of long pages as slow."""
    if not LONG.isdisjoint((item.path.stem, f"{item.path.parent.name}/{item.path.stem}")):
        item.add_marker(pytest.mark.slow)
