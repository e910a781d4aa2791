"""The demonstration: the printed table, the verdict, and the three pictures."""

import pytest
from PIL import Image

from mechanisms.demo import main


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("demo") / "deep" / "out"


def test_the_demo_prints_the_worksheet_and_writes_its_pictures(folder, capsys):
    assert main(["--out", str(folder)]) == 0
    printed = capsys.readouterr().out
    assert "\x1b" not in printed
    for heading in ("S, m", "I", "F, kgf", "pd, kgf/cm2", "kz"):
        assert heading in printed
    for figure in ("7.262", "8094", "161.017", "0.963", "2.513", "2801", "55.727", "2.781"):
        assert figure in printed
    assert "least reserve is 0.963, at S = 550.0 mm; too weak from S = 550.0 to 566.0 mm" in printed
    assert "or a bore of 90 mm, with a reserve of 1.22" in printed
    for name in ("mower_lift_curves.png", "mower_lift_poses.png", "mower_lift.gif"):
        assert f"\n{folder / name}\n" in printed
        with Image.open(folder / name) as picture:
            assert min(picture.size) >= 480
            assert len(picture.convert("RGB").resize((200, 100)).getcolors(20_000)) > 20
    assert max(map(len, printed.splitlines())) < 200
    assert (folder / "mower_lift.gif").stat().st_size < 2_000_000


def test_a_folder_that_cannot_be_made_is_said_in_words(tmp_path, capsys):
    (tmp_path / "file").write_text("")
    assert main(["--out", str(tmp_path / "file")]) == 2
    assert "Choose another folder with --out" in capsys.readouterr().err


def test_an_unknown_option_is_refused():
    with pytest.raises(SystemExit) as stop:
        main(["--oot", "x"])
    assert stop.value.code == 2
