"""What a picture runs over and follows: the stroke that moves, those held, and the table with its forces."""

from math import pi

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import LEFT, RIGHT, Column, Crank, DefinitionError, Dyad, Ground, Guide, Mechanism, OnGuide, OnLink, Stroke, Weight
from linkage.pictures import plot
from linkage.pictures.curves import axis_range
from linkage.pictures.film import Stage
from linkage.pictures.strokes import StrokeAxis, playback, unreached_words
from linkage.reports import results, run_of
from linkage.statics import driving_force
from mechanisms.classics.front_loader import FrontLoader
from mechanisms.classics.pantograph import Pantograph
from mechanisms.classics.scotch_yoke import ScotchYoke
from mechanisms.mower_lift import MowerLift
from tests.for_all import for_all


class Lever(Mechanism):
    """A lever on a cylinder, with a load."""

    S = Stroke(0.5, 0.7)
    A, O = Ground(0.0, 0.0), Ground(0.6, 0.0)
    B = Dyad(A, O, AB=S, OB=0.2, side=RIGHT)
    G = OnLink(O, B, OG=1.0)
    load = Weight(G, mass=100)


class Crankshaft(Mechanism):
    """A weight on a crank."""

    phi = Stroke(0.0, 2 * pi)
    O = Ground(0, 0)
    A = Crank(O, OA=0.5, angle=phi)
    load = Weight(A, mass=10)


class TwoCranks(Crankshaft):
    """A second crank on the first."""

    psi = Stroke(0.0, pi)
    B = Crank("A", AB=0.3, angle=psi)
    load = Weight(B, mass=10)


# -- the run -------------------------------------------------------------------------------------------------


@for_all(
    ("at", "stroke", "ends", "held"),
    [
        ({}, "lift", (0.0, 0.6), {"tilt": 0.175}),
        (dict(tilt=0.1), "lift", (0.0, 0.6), {"tilt": 0.1}),
        (dict(lift=0.1), "tilt", (0.0, 0.35), {"lift": 0.1}),
        (dict(lift=[0.3, 0.1]), "lift", (0.3, 0.1), {"tilt": 0.175}),
        (dict(lift=0.2, tilt=(0.0, 0.1)), "tilt", (0.0, 0.1), {"lift": 0.2}),
        (dict(lift=(0.1, 0.2, 0.3)), "lift", (0.1, 0.2, 0.3), {"tilt": 0.175}),
    ],
)
def test_a_run_is_of_the_stroke_that_is_left_free(at, stroke, ends, held):
    run = run_of(FrontLoader(), at)
    assert (run.stroke, run.ways, run.held) == (stroke, {stroke: ends}, held)


def test_several_strokes_run_together_from_value_to_value():
    run = run_of(FrontLoader(), dict(lift=(0.0, 0.3, 0.3), tilt=(0.1, 0.1, 0.2)))
    assert (run.stroke, run.held) == ("lift", {})
    assert_allclose(run.marks, [0.0, 0.5, 1.0])
    over = run.over(np.array([0.0, 0.25, 0.5, 0.75, 1.0]))
    assert_allclose(over["lift"], [0.0, 0.15, 0.3, 0.3, 0.3])
    assert_allclose(over["tilt"], [0.1, 0.1, 0.1, 0.15, 0.2])


def test_values_that_are_passed_are_among_the_poses():
    run = playback(FrontLoader(), 24, at=dict(lift=(0.0, 0.5, 0.1), tilt=(0.0, 0.0, 0.3)))
    assert 0.5 in run.motion.strokes["lift"] and len(run.motion.strokes["lift"]) == 24


@pytest.mark.parametrize(
    ("at", "axis", "held"),
    [
        (dict(lift=(0.1, 0.3), tilt=(0.2, 0.1)), "lift", "tilt = 200 to 100 mm"),
        (dict(lift=(0.1, 0.3, 0.1), tilt=(0.0, 0.1, 0.3)), "tilt", "lift = 100 mm to 300 mm to 100 mm"),
        (dict(lift=(0.1, 0.3, 0.1), tilt=(0.3, 0.1, 0.3)), "way", "lift = 100 mm to 300 mm to 100 mm, tilt = 300 mm to 100 mm to 300 mm"),
    ],
)
def test_the_axis_of_strokes_that_run_together_is_one_that_goes_on_else_the_way(at, axis, held):
    along = StrokeAxis.of(playback(FrontLoader(), 21, at=at, eased=False).motion)
    assert along.name == axis
    assert (np.diff(along.values) > 0.0).all()
    assert along.held.replace(" mm", "") == held.replace(" mm", "")


def test_a_film_of_strokes_that_run_together_says_where_each_is():
    stage = Stage(playback(FrontLoader(), 3, at=dict(lift=(0.1, 0.3), tilt=(0.2, 0.1))), [], None, 50)
    stage.frame(2)
    assert stage.stroke.get_text() == "lift = 300 mm, tilt = 100 mm"


def test_what_is_not_reached_on_the_way_of_several_strokes_is_told_at_its_edge():
    """Along a straight way of two strokes the edge is found between the poses, both strokes moving."""

    class Arm(Mechanism):
        """A dyad on a slide that moves away."""

        S, T = Stroke(0.5, 0.8), Stroke(0.0, 0.6)
        rail = Guide((0.0, 0.0), angle=0)
        O, A = Ground(0.0, 0.0), OnGuide(rail, at=T)
        B = Dyad(O, A, OB=S, AB=0.4, side=LEFT)

    way = np.linspace(0.0, 1.0, 8)
    motion = Arm().at(S=0.5 + 0.3 * way, T=0.6 - 0.6 * way, unreachable="nan")
    edge = 0.5 / 0.9  # 0.5 + 0.3 w - 0.4 = 0.6 - 0.6 w
    assert unreached_words(motion, "S") == f"not reached beyond S = {1e3 * (0.5 + 0.3 * edge):.4g} mm"


@for_all(
    ("at", "words"),
    [
        (dict(lift=0.1, tilt=0.1), "every stroke is held.*give lift two values"),
        (dict(lift=(0.1, 0.2, 0.3), tilt=(0.1, 0.2)), "lift passes 3 values and tilt passes 2 values; strokes that run together"),
        (dict(boom=0.1), "Stroke 'boom' is unknown"),
        (dict(lift=(0.1, 0.1)), "two different ones"),
        (dict(lift="far"), "one number holds a stroke"),
        (dict(lift=float("nan")), "one number holds a stroke"),
    ],
)
def test_a_run_that_cannot_be_is_refused(at, words):
    with pytest.raises(DefinitionError, match=words):
        run_of(FrontLoader(), at)


def test_a_motion_is_no_mechanism():
    motion = Lever().sweep(3)
    with pytest.raises(DefinitionError, match=r"<Motion of Lever.* is no mechanism"):
        playback(motion, 5)


def test_a_hold_is_passed():
    """Two equal values in a row are no mistake: nothing moves there."""
    run = run_of(FrontLoader(), dict(lift=(0.1, 0.2, 0.2, 0.1)))
    assert_allclose(run.marks, [0.0, 0.5, 0.5, 1.0])


def test_an_animation_runs_where_it_is_asked_to():
    run = playback(FrontLoader(), 5, at=dict(lift=(0.1, 0.3), tilt=0.05))
    assert_allclose(run.motion.strokes["lift"][[0, 2, 4]], [0.1, 0.2, 0.3])
    assert_allclose(run.motion.strokes["tilt"], 0.05)


# -- the table -----------------------------------------------------------------------------------------------


def test_a_machine_with_loads_shows_what_its_drives_must_do():
    motion = Lever().sweep(5)
    *others, force = results(Lever(), motion)
    assert [column.name for column in others] == [column.name for column in Lever().columns(motion)]
    assert (force.heading, force.values.shape) == ("drive force, kN", (5,))
    lever = 0.6 * 0.2 * np.sin(motion.angle("O", "B") - pi) / motion.strokes["S"]
    assert_allclose(force.values * lever, 100 * 9.80665 * (motion.x("G") - 0.6), rtol=1e-12)


def test_a_crank_shows_its_torque_and_several_drives_their_names():
    motion = Crankshaft().sweep(9)
    torque = results(Crankshaft(), motion)[-1]
    assert torque.heading == "torque, Nm"
    assert_allclose(torque.values, 98.0665 * 0.5 * np.cos(motion.strokes["phi"]), atol=1e-12)
    grid = TwoCranks().sweep(phi=3, psi=4)
    assert [column.name for column in results(TwoCranks(), grid)[-2:]] == ["torque phi", "torque psi"]
    assert_allclose(results(TwoCranks(), grid)[-1].values, driving_force(grid, drive="psi"))


def test_a_dead_point_leaves_a_gap_in_the_force_and_not_in_the_table():
    reach = 0.8 - 1e-15
    motion = Lever().at(S=[0.6, reach])
    force = results(Lever(), motion)[-1]
    assert np.isfinite(force.values[0]) and np.isnan(force.values[1])


def test_a_machine_without_loads_or_with_a_table_of_its_own_keeps_it():
    for machine in (Pantograph(), MowerLift()):
        motion = machine.at(**{name: stroke.start for name, stroke in machine.strokes.items()})
        assert [column.name for column in results(machine, motion)] == [column.name for column in machine.columns(motion)]


def test_curves_go_by_name():
    motion = FrontLoader().sweep(lift=5, tilt=0.1)
    figure = plot(motion, ["boom", "N_y"])
    assert [ax.get_title(loc="left") for ax in figure.axes] == ["boom, deg", "N_y, m"]
    assert_allclose(figure.axes[0].lines[0].get_ydata(), np.degrees(motion["boom"]))
    with pytest.raises(DefinitionError, match=r"Column 'bom' is unknown in FrontLoader\. Did you mean boom"):
        plot(motion, ["bom"])


# -- numbers that are zero -----------------------------------------------------------------------------------


def test_rounding_noise_is_drawn_as_zero():
    values = np.array([3e-18, 0.5, -0.2, np.nan])
    assert_allclose(Column("x", values, "m").drawn, [0.0, 0.5, -0.2, np.nan], rtol=0)
    assert (Column("x", values[:1], "m").drawn == 0.0).all()
    assert_allclose(Column("x", values[:1]).drawn, values[:1])  # a plain number has no unit to be small in
    assert_allclose(Column("x", values, "m").shown, values)


def test_a_yoke_in_the_middle_stands_at_zero():
    run = playback(ScotchYoke(), 5, "travel")
    stage = Stage(run, [], None, 50)
    stage.frame(1)
    assert stage.value.get_text() == "0.00000"
    assert stage.run.get_ydata()[-1] == 0.0
    stage.frame(2)
    assert stage.value.get_text() == "\N{MINUS SIGN}0.05000"
    flat = playback(ScotchYoke(), 9, "X_y")
    assert axis_range(flat.column) == (-1.0, 1.0)
    (ax,) = plot(flat.motion, [flat.column]).axes
    assert ax.get_ylim() == (-1.0, 1.0)


def test_a_part_of_a_turn_goes_there_and_back():
    class FourBar(Mechanism):
        phi = Stroke(0.0, 2 * pi)
        O, C = Ground(0, 0), Ground(4, 0)
        A = Crank(O, OA=1, angle=phi)
        B = Dyad(A, C, AB=3, CB=2.5, side=LEFT)

    assert playback(FourBar(), 9).is_turn
    assert not playback(FourBar(), 9, at=dict(phi=(0.0, 3.0))).is_turn
