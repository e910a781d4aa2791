"""Examples write where nothing is kept."""

from pathlib import Path

import pytest


@pytest.fixture(autouse=True)
def own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let each page's examples write into a folder of their own."""
    monkeypatch.chdir(tmp_path)
