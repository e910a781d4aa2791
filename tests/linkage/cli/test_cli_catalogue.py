"""`hydrolinkage catalogue`: a catalogue is made, kept and read again; what cannot be is said in one line."""

import pytest

from linkage import curve_catalogue
from linkage.cli import main
from mechanisms.classics.four_bar import FourBar

NAME = "mechanisms.classics.four_bar:FourBar"


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    """The user's cache, empty."""
    monkeypatch.setenv("HYDROLINKAGE_CACHE", str(tmp_path))
    return tmp_path / "curves"


def test_a_catalogue_is_made_and_kept(cache, capsys):
    assert main(["catalogue", NAME, "--count", "200", "--progress"]) == 0
    out, err = capsys.readouterr()
    assert out.startswith("FourBar, P: 200 closed curves of") and "200 of 200" in err
    (file,) = cache.iterdir()
    assert str(file) in out
    assert curve_catalogue(FourBar(), "P", count=200).file == file


def test_an_angle_is_held_at_what_is_set(cache, capsys):
    assert main(["catalogue", NAME, "--set", "BAP=10deg", "--hold", "BAP", "--of", "P", "--count", "100", "--seed", "2"]) == 0
    assert len([*cache.iterdir()]) == 1 and "100 closed curves" in capsys.readouterr().out


@pytest.mark.parametrize("given", [["--of", "X"], ["--hold", "OA"], ["--count", "0"]])
def test_what_cannot_be_is_said_in_one_line(given, capsys):
    assert main(["catalogue", NAME, *given]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
