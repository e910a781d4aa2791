"""No text of a picture covers another one, a tick, or the edge of the paper: of every shipped machine, with its forces and without."""

from importlib.metadata import entry_points
from itertools import combinations

import matplotlib.pyplot as plt
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

from linkage import draw, plot
from tests.linkage.motion.in_node import elsewhere

SHIPPED = {point.name: point for point in entry_points(group="hydrolinkage.machines")}
QUICK = ("arm_drive", "crane", "grapple", "three_point_hitch", "wheel_loader")
TOUCH = 1.0
"""Pixels by which boxes of letters may touch: they are higher than the letters in them."""


def boxes(figure):
    """Return the texts that a figure shows, tick labels and headings among them, with the boxes that they cover [pixels]."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw(renderer)
    texts = [*figure.texts]
    for ax in figure.axes:
        inside = [*(each for each in ax.get_children() if isinstance(each, Text)), ax.xaxis.label, ax.yaxis.label]
        spans = [(axis, sorted(axis.get_view_interval())) for axis in (ax.xaxis, ax.yaxis)]
        ticks = [tick.label1 for axis, (low, high) in spans for tick in axis.get_major_ticks() if low <= tick.get_loc() <= high]
        legend = ax.get_legend()
        texts += [*inside, *ticks, *(legend.get_texts() if legend else [])]
    shown = [each for each in texts if each.get_visible() and each.get_text().strip()]
    return [(each.get_text(), Text.get_window_extent(each, renderer).padded(-TOUCH)) for each in shown]


def check_texts(figure):
    """Assert that no text covers another one or hangs over the paper's edge."""
    found = boxes(figure)
    paper = figure.bbox.padded(TOUCH)
    for text, box in found:
        assert paper.x0 <= box.x0 and box.x1 <= paper.x1 and paper.y0 <= box.y0 and box.y1 <= paper.y1, f"{text} hangs over the edge"
    covered = [(a, b) for (a, one), (b, other) in combinations(found, 2) if one.overlaps(other)]
    assert covered == []


def check_machine(machine):
    for make in (lambda: draw(machine), lambda: draw(machine, forces=True), lambda: plot(machine)):
        figure = make()
        check_texts(figure)
        plt.close(figure)


@pytest.mark.parametrize("name", QUICK)
def test_no_text_covers_another(name):
    check_machine(SHIPPED[name].load()())


@pytest.mark.slow
@pytest.mark.parametrize("name", SHIPPED)
def test_no_text_of_any_shipped_machine_covers_another(name):
    check_machine(SHIPPED[name].load()())


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name, _ in elsewhere()])
def test_no_text_of_a_machine_that_is_not_shipped_covers_another(name):
    check_machine(dict(elsewhere())[name]())
