"""Files of sound mechanisms with a few things put wrong: each is a machine that can be asked for a pose, or refused with its place."""

import pytest

from tests.linkage.files.mutated_files import tried


@pytest.mark.slow
def test_files_with_a_few_things_put_wrong(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    counts, wrong = tried(range(50), tmp_path)
    assert not wrong, "\n".join(wrong)
    assert counts["asked"] > 5 and counts["FileError"] > 25
    assert {each.name for each in tmp_path.iterdir()} <= {"file.toml", "file.json"}, "something was run"


@pytest.mark.slow
def test_a_hundred_thousand_files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    _, wrong = tried(range(100_000), tmp_path)
    assert not wrong, "\n".join(wrong)
    assert {each.name for each in tmp_path.iterdir()} <= {"file.toml", "file.json"}, "something was run"
