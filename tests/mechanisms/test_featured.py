"""What the shipped machines are about: columns, points and limits that are there; pictures show them unasked."""

from importlib.metadata import entry_points

import numpy as np
import pytest
from matplotlib.figure import Figure

from linkage import DefinitionError, Featured, FileError, Weight, page, plot
from linkage.files import load, save
from linkage.pictures.strokes import playback
from linkage.reports import results
from linkage.reports.results import is_changing
from mechanisms.classics.front_loader import FrontLoader
from mechanisms.header_balancer import HeaderBalancer
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import for_all
from tests.shipped import DAILY

SHIPPED = {each.name: each for each in entry_points(group="hydrolinkage.machines") if each.value.startswith("mechanisms.")}


@for_all("name", DAILY, slow=[name for name in SHIPPED if name not in DAILY])
def test_every_shipped_machine_says_what_it_is_about(name):
    machine = SHIPPED[name].load()()
    featured, played = machine.featured(), playback(machine, 9)
    columns = {column.name: column for column in results(machine, played.motion)}
    assert featured.column in columns
    assert played.column.name == featured.column or not is_changing(columns[featured.column].drawn)  # in a run that moves something else
    assert set(featured.limits) <= set(columns)
    assert set(featured.path) <= set(machine.plan.moving)


def test_the_balancer_is_about_the_shoes_reaction():
    featured = HeaderBalancer().featured()
    assert (featured.column, featured.path) == ("F_R free", ["R"])


def panels(figure: Figure) -> dict[str, str]:
    """Return the texts of each panel by its title."""
    return {ax.get_title(loc="left"): " ".join(text.get_text() for text in ax.texts) for ax in figure.axes}


def test_a_machine_is_plotted_by_what_it_is_about_with_its_limits():
    drawn = panels(plot(MowerLift()))
    assert list(drawn) == ["kz", "pd, kgf/cm²"]
    assert "kz = 1" in drawn["kz"] and "p_max = 155 kgf/cm²" in drawn["pd, kgf/cm²"]


def test_columns_named_of_a_machine_are_those_of_its_table_with_its_limits():
    assert list(panels(plot(MowerLift(), ["PI", "kz"]))) == ["PI, kgf", "kz"]
    assert "kz = 2" in panels(plot(MowerLift(), ["kz"], limits={"kz": (2.0, "kz = 2", "below")}))["kz"]


def test_a_machine_is_plotted_over_the_run_that_is_asked_for():
    figure = plot(FrontLoader(), ["boom"], at=dict(lift=(0.1, 0.3), tilt=(0.2, 0.1)), count=11)
    (line, *_) = figure.axes[0].lines
    np.testing.assert_allclose(line.get_xdata(), np.linspace(100.0, 300.0, 11))
    assert "tilt = 200 mm to 100 mm" in figure.get_suptitle()


@pytest.mark.parametrize("options", [{"at": {"S": 0.6}}, {"count": 5}])
def test_a_motion_has_its_poses(options):
    with pytest.raises(DefinitionError, match="go with a machine"):
        plot(MowerLift().sweep(5), ["kz"], **options)


def test_an_implement_without_weight_has_no_limit():
    class Unloaded(ThreePointHitch):
        """Nothing hangs on it."""

        load = Weight("G", mass=0)

    assert not Unloaded().featured().limits


@pytest.mark.parametrize("machine", [MowerLift(), FrontLoader(), ThreePointHitch(OB=0.31)])
def test_a_file_says_what_the_machine_is_about(machine, tmp_path):
    for name in ("machine.toml", "machine.json"):
        save(machine, tmp_path / name)
        found, own = load(tmp_path / name)().featured(), machine.featured()
        assert (found.column, list(found.path)) == (own.column, list(own.path))
        assert {key: tuple(limit) for key, limit in found.limits.items()} == dict(own.limits)


@for_all(
    "text", ["column = 3", 'path = "G"', 'limits = { t = "high" }', "limits = { t = [0.1, 2] }", 'colum = "t"', "limits = { t = [] }"]
)
def test_what_a_file_says_wrongly_of_it_comes_with_its_line(text):
    with pytest.raises(FileError, match=r"(?s)line 2.*featured"):
        load(f'name = "Own"\n[featured]\n{text}\n')


@pytest.mark.slow
def test_a_machine_of_ones_own_says_what_it_is_about(tmp_path):
    class Own(MowerLift):
        """A mower that is watched by its rod."""

        def featured(self) -> Featured:
            """Return the rod's force."""
            return Featured("PI", ["B"])

    assert playback(Own(), 5).column.name == "PI"
    assert page(Own(), tmp_path / "own.html").read_text().count("PI")
