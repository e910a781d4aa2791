"""What an eye would stumble over in a picture: arrows under pins, names on hatches, curves that do not change."""

import numpy as np
import pytest
from matplotlib.text import Text

from linkage.pictures import draw
from linkage.pictures.film import column_text
from linkage.pictures.layout import hatched
from linkage.pictures.poses import on_its_way
from linkage.pictures.scene import Scene
from linkage.pictures.shapes import segment
from linkage.pictures.strokes import playback
from mechanisms.classics.front_loader import FrontLoader
from mechanisms.classics.pantograph import Pantograph
from mechanisms.classics.scissor_lift import ScissorLift
from mechanisms.classics.scotch_yoke import ScotchYoke
from mechanisms.classics.slider_crank import SliderCrank
from mechanisms.classics.trammel import Trammel
from tests.for_all import for_all

ANGLE = np.linspace(0.0, 2 * np.pi, 401)


def test_the_arrow_of_an_open_path_is_in_its_middle():
    tail, head = on_its_way(np.array([np.linspace(0.0, 4.0, 41), np.zeros(41)]))
    assert 1.9 <= tail[0] < head[0] <= 2.1


def test_the_arrow_of_a_slider_is_on_its_way_out():
    tail, head = on_its_way(np.array([np.cos(ANGLE), np.zeros(401)]))
    assert -0.5 < head[0] < tail[0] < 0.5


def test_a_point_that_stands_still_has_no_arrow():
    assert on_its_way(np.zeros((2, 5))) is None


@for_all("machine", [ScotchYoke, Trammel], slow=[Pantograph, ScissorLift, SliderCrank])
def test_names_keep_clear_of_the_hatches_of_rails(machine):
    figure = draw(machine())
    figure.canvas.draw()
    (ax,) = figure.axes
    motion = machine().at(**{name: [stroke.start, stroke.end] for name, stroke in machine.plan.strokes.items()})
    lines = [line for rail in hatched(Scene(motion)) for line in rail]
    assert lines
    hatches = ax.transData.transform(np.concatenate([segment(*line, 0.1 * float(np.hypot(*(line[1] - line[0])))) for line in lines]))
    names = {text.get_text(): Text.get_window_extent(text) for text in ax.texts if text.get_text()}
    assert [name for name, box in names.items() if any(box.contains(*point) for point in hatches)] == []


def test_an_animation_follows_what_changes():
    assert playback(FrontLoader(), 5).column.name == "boom"  # the attitude stays
    assert playback(FrontLoader(), 5, at=dict(lift=0.1)).column.name == "reserve tilt_rams"


@pytest.mark.parametrize(
    ("values", "texts"),
    [
        ([0.05, -0.00413, -6e-18], ["0.05000", "\N{MINUS SIGN}0.00413", "0.00000"]),
        ([2.781, 0.963, np.nan], ["2.781", "0.963", ""]),
        ([16101.6, -3.2], ["16102", "\N{MINUS SIGN}3"]),
        ([0.0], ["0"]),
    ],
)
def test_a_value_has_as_many_decimals_as_its_column_needs(values, texts):
    assert [column_text(np.array(values), pose) for pose in range(len(values))] == texts
