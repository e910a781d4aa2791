"""Animations: the frames that were asked for, a page that stands alone, and errors in words."""

import re
import sys
from math import pi

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PIL import Image

from linkage import (
    LEFT,
    AssemblyError,
    Crank,
    DefinitionError,
    Dyad,
    FileError,
    Ground,
    LinkageError,
    Mechanism,
    OnLink,
    Stroke,
    angle,
)
from linkage.pictures import animate, page_html, style
from linkage.pictures.film import Stage, palette_of
from linkage.pictures.strokes import playback
from mechanisms.classics.front_loader import FrontLoader
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all


class FourBar(Mechanism):
    phi = Stroke(0, 2 * pi)
    O = Ground(0, 0)
    Q = Ground(0.4, 0)
    A = Crank(O, OA=0.12, angle=phi)
    B = Dyad(A, Q, AB=0.38, QB=0.25, side=LEFT)
    C = OnLink(A, B, AC=0.30)
    psi = angle(Q, B)


class TooLong(MowerLift):
    S = Stroke(0.55, 0.90)


class Longest(MowerLift):
    S = Stroke(2.0, 3.0)


# -- the course --------------------------------------------------------------------------------------------


def test_a_lift_goes_there_and_back_and_eases_at_its_ends():
    run = playback(MowerLift(), 5)
    assert run.order == (0, 1, 2, 3, 4, 3, 2, 1)
    S = run.motion.strokes["S"]
    assert_allclose(S[[0, 2, 4]], [0.55, 0.675, 0.80])
    assert S[1] - S[0] < S[2] - S[1]


def test_a_full_turn_goes_round_and_the_last_pose_is_the_first():
    run = playback(FourBar(), 9)
    assert run.is_turn
    assert_allclose(run.motion.strokes["phi"], np.linspace(0, 2 * pi, 9))


def test_poses_out_of_reach_are_left_out():
    run = playback(TooLong(), 40)
    reached = run.motion.reached
    assert 0 < reached.sum() < 40
    assert set(run.order) == set(np.flatnonzero(reached))
    with pytest.raises(AssemblyError, match="B = Dyad"):
        playback(Longest(), 10)


def test_the_column_is_the_one_named_or_the_last():
    assert playback(MowerLift(), 3, "I").column.name == "I"
    assert playback(MowerLift(), 3).column.name == "kz"
    with pytest.raises(DefinitionError, match=r"Column 'kx' is unknown in MowerLift. Did you mean kz"):
        playback(MowerLift(), 3, "kx")


@for_all("count", [1, 0, 2.5, True, "60"])
def test_a_count_is_a_whole_number_from_two(count):
    with pytest.raises(DefinitionError, match="at least 2 poses"):
        playback(MowerLift(), count)


# -- frames ------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_frame_is_the_same_however_it_is_reached():
    stage = Stage(playback(ThreePointHitch(), 7), ["G"], None, 50)
    first = stage.frame(0)
    assert first.shape == (240, 480, 4)
    assert (stage.frame(3) != first).any()
    assert (stage.frame(0) == first).all()


def test_a_frame_shows_the_pose_and_the_value():
    run = playback(MowerLift(), 5)
    stage = Stage(run, [], (1.0, "kz = 1", "below"), 50)
    stage.frame(4)
    assert stage.stroke.get_text() == "S = 800 mm"
    assert stage.value.get_text() == "2.781"
    assert_allclose(stage.marker.get_xydata(), [[800.0, run.column.values[4]]])
    assert_allclose(stage.run.get_xdata(), 1e3 * run.motion.strokes["S"])


def test_the_palette_holds_plain_colours_exactly():
    stage = Stage(playback(MowerLift(), 3), [], None, 100)
    flat = palette_of(stage.frame(0)).getpalette()
    colours = {tuple(flat[i : i + 3]) for i in range(0, len(flat), 3)}
    assert (255, 255, 255) in colours
    assert tuple(int(style.BARREL[i : i + 2], 16) for i in (1, 3, 5)) in colours


def test_strokes_held_and_poses_not_reached_are_said():
    held = Stage(playback(FrontLoader(), 5), [], None, 50)
    assert any(text.get_text().startswith("at tilt = ") for text in held.figure.texts)
    short = Stage(playback(TooLong(), 40), [], None, 50)
    assert any(text.get_text().startswith("not reached beyond S = ") for text in short.figure.texts)


@pytest.mark.slow
def test_names_keep_close_to_their_points():
    stage = Stage(playback(FrontLoader(), 9), [], None, 100)
    for part in stage.drawing.parts:
        if hasattr(part, "text"):
            assert np.hypot(*part.text.xyann) < 1.7 * style.LABEL


# -- files -------------------------------------------------------------------------------------------------


def test_a_gif_has_every_frame_loops_and_stays_small(tmp_path):
    heard = []
    file = animate(MowerLift(), tmp_path / "lift.gif", count=8, column="kz", trace=["G"], progress=lambda *each: heard.append(each))
    with Image.open(file) as picture:
        assert picture.n_frames == 14
        assert picture.size == (960, 480)
        assert picture.info["duration"] == 40
        assert picture.info["loop"] == 0
        assert picture.convert("RGB").getpixel((2, 2)) == (255, 255, 255)
    assert heard == [(done, 8) for done in range(9)]
    assert file.stat().st_size < 14 * 2_000_000 / 118


@pytest.mark.slow
def test_an_mp4_has_every_frame(tmp_path):
    ffmpeg = pytest.importorskip("imageio_ffmpeg")
    file = animate(FourBar(), tmp_path / "bars.MP4", count=4, column="psi")
    frames, _ = ffmpeg.count_frames_and_secs(str(file))
    assert frames == 4


def test_without_ffmpeg_the_remedy_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    with pytest.raises(LinkageError, match=re.escape("pip install 'hydrolinkage[video]'")):
        animate(FourBar(), tmp_path / "bars.mp4", count=2)
    assert not list(tmp_path.iterdir())


def test_what_cannot_be_written_is_said_in_words(tmp_path):
    with pytest.raises(DefinitionError, match=r"written as \.gif, \.mp4 or \.html"):
        animate(MowerLift(), tmp_path / "lift.avi")
    with pytest.raises(FileError, match="is not there; make it first"):
        animate(MowerLift(), tmp_path / "nowhere" / "lift.gif")
    with pytest.raises(DefinitionError, match="Point 'H' is unknown"):
        animate(MowerLift(), tmp_path / "lift.gif", trace=["H"])
    with pytest.raises(DefinitionError, match="2 designs"):
        animate(MowerLift(OB=[0.17, 0.18]), tmp_path / "lift.gif")


def test_an_html_file_is_the_live_page(tmp_path):
    heard = []
    file = animate(FourBar(), tmp_path / "bars.html", column="psi", trace=["C"], progress=lambda *each: heard.append(each))
    assert file.read_text(encoding="utf-8") == page_html(FourBar(), column="psi", trace=["C"], at={})
    assert heard == [(1, 2), (2, 2)]
