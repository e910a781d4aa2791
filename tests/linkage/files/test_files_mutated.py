"""Files of sound mechanisms with a few things put wrong: each is a machine that can be asked for a pose, or refused with its place."""

from tests.for_all import for_all
from tests.linkage.files.mutated_files import tried


@for_all("count", [50], slow=[3_000])
def test_files_with_a_few_things_put_wrong(count, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    counts, wrong = tried(range(count), tmp_path)
    assert not wrong, "\n".join(wrong)
    assert counts["asked"] > 0.1 * count and counts["FileError"] > 0.5 * count
    assert {each.name for each in tmp_path.iterdir()} <= {"file.toml", "file.json"}, "something was run"
