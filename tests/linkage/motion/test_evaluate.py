"""The bulk call: the numbers, refusals and masks of a motion, and nothing worked out that is not asked for."""

import sys
import warnings

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal, assert_equal

from linkage import (
    LEFT,
    AssemblyError,
    Crank,
    DefinitionError,
    Dyad,
    Ground,
    LinkageError,
    Mechanism,
    SingularError,
    Stroke,
    Weight,
    angle,
    deg,
    distance,
    drive_force,
    ratio,
    x,
)
from linkage.motion import condition, evaluation, gap
from linkage.motion.stroke_search import limits
from mechanisms.classics.four_bar import FourBar
from mechanisms.classics.front_loader import FrontLoader
from mechanisms.classics.toggle_press import TogglePress
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import first_daily, for_all
from tests.linkage.program.test_backends import GROUPED, MACHINES, SHIPPED

STROKE = np.linspace(0.0, 0.25, 41)
ASKED = ["G", ratio("G"), "tilt", ratio("tilt"), ratio("G", order=2), "A", angle("O", "B"), ratio(distance("A", "G"))]


def of_motion(motion, request):
    """Return what a motion says to a request."""
    if not hasattr(request, "order"):
        return motion[request] if isinstance(request, str) else motion.value(request)
    return motion.ratio(request.target, wrt=request.along[0], order=request.order)


def functions_called(run):
    """Return how many functions written in Python a call goes through."""
    count = 0

    def note(frame, event, _):
        nonlocal count
        count += event == "call"

    before = sys.getprofile()
    sys.setprofile(note)
    try:
        run()
    finally:
        sys.setprofile(before)
    return count


def test_a_call_that_was_made_before_goes_through_few_functions_and_makes_nothing_anew():
    hitch, load, many = ThreePointHitch(), Weight("G", mass=100.0), np.linspace(0.0, 0.25, 1000)
    runs = {
        "evaluate": (lambda: hitch.evaluate(["G", "K"], S=many, backend="numpy"), 55),
        "at": (lambda: hitch.at(S=many)["G"], 72),
        "at, one pose": (lambda: hitch.at(S=0.1).ratio("G"), 75),
        "evaluate, one pose": (lambda: hitch.evaluate(["G", ratio("G")], S=0.1), 42),
        "own loads": (lambda: hitch.evaluate([drive_force(loads=load)], S=0.1), 60),
    }
    for what, (run, most) in runs.items():
        for _ in range(3):
            run()
        made = list(hitch.plan._kernels)
        assert functions_called(run) <= most, what
        assert list(hitch.plan._kernels) == made, what


@pytest.mark.parametrize("designs", [{}, {"OB": np.linspace(0.28, 0.32, 5)}, {"OB": np.full((3, 1), 0.3), "M": (np.full(2, 0.22), 1.05)}])
def test_values_and_ratios_are_those_of_a_motion(designs):
    hitch = ThreePointHitch(**designs)
    motion = hitch.at(S=STROKE)
    for request, found in zip(ASKED, hitch.evaluate(ASKED, S=STROKE), strict=True):
        wanted = of_motion(motion, request)
        assert found.shape == wanted.shape
        assert_allclose(found, wanted, rtol=1e-12, atol=1e-12)


@MACHINES
def test_a_table_of_strokes_gives_what_a_row_of_them_gives(machine):
    strokes = {name: np.linspace(stroke.start, stroke.end, 23) for name, stroke in machine.plan.strokes.items()}
    asked = [*machine.plan.moving, ratio(machine.plan.moving[-1], wrt=next(iter(strokes)))]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        row = machine().evaluate(asked, unreachable="nan", backend="numpy", **strokes)
        table = machine().evaluate(asked, unreachable="nan", backend="numpy", **{name: value[None, :] for name, value in strokes.items()})
    for one, other in zip(row, table, strict=True):
        assert_array_equal(one, other[..., 0, :])


class Bar(Mechanism):
    """A bar that turns: its length is all there is of a design."""

    phi = Stroke(0.0, 90 * deg)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=0.5, angle=phi)


def test_designs_of_which_every_value_is_an_array_keep_their_shape():
    (place,) = Bar(**{"OA": [0.5, 0.6], "O.x": [0.0, 0.1], "O.y": [0.0, 0.2]}).evaluate(["A"], phi=np.linspace(0.0, 1.0, 3))
    assert place.shape == (2, 2, 3)
    assert_allclose(place[:, 1, 0], (0.7, 0.2), rtol=1e-15)


def test_a_pose_without_a_value_is_refused_among_many_that_have_one():
    hitch = ThreePointHitch(L0=0.7)
    reached = hitch.at(S=STROKE, unreachable="nan").reached
    assert 0 < reached.sum() < reached.size
    with pytest.raises(AssemblyError, match="cannot be assembled"):
        hitch.evaluate(["G"], S=STROKE)
    (place,) = hitch.evaluate(["G"], S=STROKE, unreachable="nan")
    assert_array_equal(np.isfinite(place).all(axis=0), reached)


@MACHINES
def test_every_machine_is_evaluated(machine):
    strokes = {name: np.linspace(stroke.start, stroke.end, 23) for name, stroke in machine.plan.strokes.items()}
    first = next(iter(strokes))
    point = machine.plan.moving[-1]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        motion = machine().at(unreachable="nan", **strokes)
        place, slope = machine().evaluate([point, ratio(point, wrt=first)], unreachable="nan", **strokes)
        wanted = motion[point], motion.ratio(point, wrt=first)
    assert_allclose(place, wanted[0], rtol=1e-10, atol=1e-10)
    assert_array_equal(np.isnan(slope), np.isnan(wanted[1]))
    assert_allclose(slope, wanted[1], rtol=1e-8, atol=1e-8)


@pytest.mark.parametrize("backend", ["numpy", "floats"])
@first_daily(1, "many", [3, 700])
def test_what_is_out_of_reach_is_nan_where_a_motion_says_so(backend, many):
    hitch = ThreePointHitch(OB=np.linspace(0.15, 0.4, many), CD=np.linspace(0.5, 0.7, many))
    stroke = np.linspace(0.0, 0.3, 50)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        motion = hitch.at(S=stroke, unreachable="nan")
        wanted = [of_motion(motion, request) for request in ASKED[:3]]
        found = hitch.evaluate(ASKED[:3], S=stroke, unreachable="nan", backend=backend)
    assert 0.0 < np.isnan(found[0]).mean() < 1.0
    for each, other in zip(found, wanted, strict=True):
        assert_array_equal(np.isnan(each), np.isnan(other))
        assert_allclose(each, other, rtol=1e-7, atol=1e-9)


def test_what_is_out_of_reach_is_refused_in_the_words_of_a_motion():
    hitch, stroke = ThreePointHitch(), [0.1, 0.5]
    with pytest.raises(AssemblyError) as first:
        hitch.at(S=stroke)
    with pytest.raises(AssemblyError) as second:
        hitch.evaluate(["G"], S=stroke)
    assert str(first.value) == str(second.value)


def dead_point():
    """Return the hitch's stroke where cylinder and arm are in line."""
    hitch = ThreePointHitch()
    return float(np.hypot(*(hitch["O"] - hitch["A"])) + hitch["OB"] - hitch["L0"])


def test_a_ratio_at_a_dead_point_is_refused_and_a_position_is_not():
    stroke = [0.1, dead_point()]
    (place,) = ThreePointHitch().evaluate(["B"], S=stroke)
    assert np.isfinite(place).all()
    with pytest.raises(SingularError, match=r"B = Dyad\(A, O\)"):
        ThreePointHitch().evaluate(["B", ratio("B")], S=stroke)
    place, slope = ThreePointHitch().evaluate(["B", ratio("B")], S=stroke, unreachable="nan")
    assert np.isfinite(place).all()
    assert_array_equal(np.isnan(slope), [[False, True]] * 2)


def test_a_ratio_near_a_dead_point_warns():
    with pytest.warns(UserWarning, match="B comes near a dead point"):
        ThreePointHitch().evaluate([ratio("B")], S=[dead_point() - 1e-9])


def test_only_what_is_named_is_worked_out():
    hitch = ThreePointHitch(CD=0.1)  # the lift rod is too short: D is nowhere
    with pytest.raises(AssemblyError):
        hitch.sweep(11)
    (C,) = hitch.evaluate(["C"], S=STROKE)
    assert_allclose(C, ThreePointHitch().at(S=STROKE)["C"])
    found = [ThreePointHitch().evaluate(iter([name]), S=0.1)[0] for name in "GK"]  # what is no list has no key: none is kept for another
    assert_allclose(found, [ThreePointHitch().at(S=0.1)[name] for name in "GK"])


def test_results_go_where_they_are_wanted():
    out = np.empty((4, 41))
    G, slope = ThreePointHitch().evaluate(["G", ratio("G")], S=STROKE, out=out)
    assert np.shares_memory(G, out)
    assert_array_equal(out, [*G, *slope])


@pytest.mark.parametrize("out", [np.empty((3, 41)), np.empty((2, 41), np.float32), np.empty((41, 2)).T, [0.0]])
def test_a_place_that_does_not_fit_is_refused(out):
    with pytest.raises(DefinitionError, match=r"out= is .*\(2, 41\)"):
        ThreePointHitch().evaluate(["G"], S=STROKE, out=out)


def test_angles_do_not_jump_along_the_stroke():
    class Turning(FourBar):
        twice = 2.0 * angle("O", "A") + distance("O", "B")

    phi = np.linspace(0.0, 12.0, 200)
    names = [name for name in ("twice", *Turning.plan.valued_members) if name in Turning.plan.members]
    found = Turning().evaluate(["twice"], phi=phi)[0]
    motion = Turning().at(phi=phi)
    assert names
    assert np.ptp(found) > 20.0
    assert_allclose(found, motion["twice"], rtol=1e-12)


@for_all(
    ("asked", "words"),
    [
        (["Q"], "Q"),
        ([ratio("G", wrt="T")], "T"),
        ([ratio("Q")], "Q"),
        ([distance("A", "Q")], "'Q' is unknown in ThreePointHitch"),
        ([ratio(2.0 * angle("A", "Q"))], "'Q' is unknown in ThreePointHitch"),
        (None, "a list of what is asked for is expected"),
        (["L0"], None),
        ([], None),
    ],
)
def test_unknown_names_are_told(asked, words):
    if words is None:
        assert len(ThreePointHitch().evaluate(asked, S=STROKE)) == len(asked)
    else:
        with pytest.raises(DefinitionError, match=words):
            ThreePointHitch().evaluate(asked, S=STROKE)


def test_two_strokes_have_to_be_told_apart():
    name, machine = next((name, each) for name, each in SHIPPED.items() if len(each.plan.strokes) == 2)
    first, second = machine.plan.strokes
    point = machine.plan.moving[0]
    at = {first: machine.plan.strokes[first].start, second: machine.plan.strokes[second].start}
    assert name
    with pytest.raises(DefinitionError, match=f"wrt= one of {first}, {second}"):
        machine().evaluate([ratio(point)], **at)


def test_a_function_of_floats_is_the_motion():
    f = ThreePointHitch(OB=0.31).function(["G", ratio("G"), "tilt"])
    motion = ThreePointHitch(OB=0.31).at(S=0.1)
    assert_allclose(f(0.1), [*motion["G"], *motion.ratio("G"), motion["tilt"]], rtol=1e-13)
    assert all(type(part) is float for part in f(0.1))


def test_a_function_of_floats_refuses_what_a_motion_refuses():
    f = ThreePointHitch().function(["B", ratio("B")])
    with pytest.raises(AssemblyError, match="is 91"):
        f(0.5)
    with pytest.raises(SingularError):
        f(dead_point())
    with pytest.raises(DefinitionError, match="one value for each stroke"):
        f(0.1, 0.2)
    with pytest.raises(DefinitionError, match="of one design"):
        ThreePointHitch(OB=[0.3, 0.31]).function(["B"])


def test_a_function_of_floats_takes_one_number_a_stroke():
    f = ThreePointHitch().function(["G", "tilt"])
    assert f(np.array([0.1])) == f(np.array(0.1)) == f(0.1), "solvers hand over arrays of one number"
    for value in ([0.1, 0.2], np.zeros(0), "0.1", None, 1j, float("nan"), float("inf")):
        with pytest.raises(DefinitionError, match=r"the stroke S=.*: one finite number is expected; evaluate takes arrays"):
            f(value)


def test_a_function_of_a_group_is_the_motion():
    machine = SHIPPED[GROUPED[0]]
    stroke = machine.plan.sketch_strokes
    point = machine.plan.moving[-1]
    assert_allclose(machine().function([point])(*stroke.values()), machine().at(**stroke)[point], rtol=1e-12)


@pytest.mark.parametrize(("method", "strokes"), [("evaluate", {"S": 0.1}), ("function", {}), ("source", {})])
def test_a_lone_request_is_asked_to_be_a_list(method, strokes):
    with pytest.raises(DefinitionError, match=r"a list .* is expected, \['tilt'\]"):
        getattr(ThreePointHitch(), method)("tilt", **strokes)


def test_a_function_takes_strokes_by_name_too():
    at = ThreePointHitch().function(["G"])
    assert at(S=0.1) == at(0.1)
    with pytest.raises(DefinitionError, match="S is not given"):
        at()
    with pytest.raises(DefinitionError, match="'T' is unknown"):
        at(T=0.1)
    with pytest.raises(DefinitionError, match="'S' is unknown"):
        at(0.1, S=0.1)


@MACHINES
def test_one_pose_is_that_of_many(machine):
    """The program of one pose, which is found by what is asked, tells what a row of poses tells, warnings and refusals included."""
    point, made = machine.plan.moving[-1], machine()
    asked = [point, *(ratio(point, wrt=name) for name in machine.plan.strokes), *[*machine.plan.valued_members][:3]]
    for share in (0.0, 0.3, 0.77, 1.0):
        strokes = {name: float(stroke.start + share * (stroke.end - stroke.start)) for name, stroke in machine.plan.strokes.items()}
        told = []
        for kind in (float, np.float64, np.array):
            given = {name: kind(value) for name, value in strokes.items()}
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                try:
                    found = [np.asarray(each).tolist() for each in made.evaluate(asked, **given)]
                except LinkageError as error:
                    found = [str(error)]
            told.append((found, [str(each.message) for each in caught]))
        assert_equal(told[0], told[2])
        assert_equal(told[1], told[2])


def test_one_pose_refuses_in_the_words_of_many():
    hitch = ThreePointHitch()
    hitch.evaluate(["G", ratio("G")], S=0.1)
    for asked, strokes in [
        (["G"], {"S": 5.0}), (["G"], {"S": "a"}), (["G"], {"T": 0.1}), (["Q"], {"S": 0.1}), ([ratio("G", wrt="T")], {"S": 0.1}),
        ([ratio("G", wrt=["S"])], {"S": 0.1}), ("G", {"S": 0.1}), ({"G"}, {"S": 0.1}), (["G"], {"S": float("nan")}),
    ]:  # fmt: skip
        with pytest.raises(LinkageError):
            hitch.evaluate(asked, **strokes)
    with pytest.raises(DefinitionError, match="unreachable"):
        hitch.evaluate(["G"], S=0.1, unreachable="perhaps")


def test_one_pose_follows_the_design():
    one, other = ThreePointHitch(), ThreePointHitch(OB=0.31)
    for hitch in (one, other, one, other):
        assert_allclose(hitch.evaluate(["G"], S=0.1)[0], hitch.at(S=0.1)["G"], rtol=1e-15)
    assert ThreePointHitch(OB=np.array([0.3, 0.31])).evaluate(["G"], S=0.1)[0].shape == (2, 2)


def test_the_root_of_a_plainly_negative_number_has_no_value_in_bulk_either():
    class Rooted(Mechanism):
        phi = Stroke(0.0, 3.0)
        O = Ground(0.0, 0.0)
        C = Ground(1.0, 0.0)
        A = Crank(O, OA=0.3, angle=phi)
        B = Dyad(A, C, AB=0.9, CB=0.6, side=LEFT)
        near = np.sqrt(x(A))
        far = np.sqrt(x("B") - 0.9)

    machine, phi = Rooted(), np.linspace(0.0, 3.0, 41)
    motion = machine.at(phi=phi, unreachable="nan")
    for name in ("near", "far"):
        (found,) = machine.evaluate([name], phi=phi, unreachable="nan")
        assert np.isnan(found).any()
        assert_allclose(found, motion[name], rtol=1e-12)
        with pytest.raises(SingularError, match="has no finite value"):
            machine.evaluate([name], phi=phi)
        with pytest.raises(SingularError, match="has no finite value"):
            machine.function([name])(3.0)


class Folds(Mechanism):
    """A dyad from a pin beside the origin, which ends where its links are in line."""

    S = Stroke(0.1, 0.5)
    A, O = Ground(0, 0), Ground(0.3, 0.4)
    B = Dyad(A, O, AB=S, OB=0.3, side=LEFT)


@pytest.mark.slow
def test_a_place_at_the_very_end_of_reach_is_that_of_a_motion(monkeypatch):
    """Rounding puts some of these ends out of reach; they are assembled to rounding, here as there."""
    mended = []
    run = evaluation.to_rounding
    monkeypatch.setattr(evaluation, "to_rounding", lambda *given: mended.append(1) or run(*given))
    for OB in np.random.default_rng(3).uniform(0.1, 0.4, 20):
        machine = Folds(OB=OB)
        for end in (0.5 + OB, 0.5 - OB):
            (found,) = machine.evaluate(["B"], S=[end, 0.5])
            assert_allclose(found, machine.at(S=[end, 0.5])["B"], rtol=0, atol=1e-15)
    assert mended


@pytest.mark.slow
def test_a_request_of_places_has_one_value_at_a_dead_point():
    """A motion gives what the bulk call gives, where the points stand to rounding: a number wherever it is no ratio."""
    for machine in (TogglePress(), FrontLoader()):
        stroke, *others = machine.strokes
        held = {name: 0.5 * (machine.strokes[name].start + machine.strokes[name].end) for name in others}
        P, *_, Q = machine.plan.moving
        requests = [gap(P, Q), condition(), condition(Q), 2.0 * gap(P, Q)]
        for end, _ in limits(machine.sweep(**{stroke: 3}, **held))[stroke].dead_points:
            strokes = {stroke: end + np.array([-1e-4, -1e-15, 0.0, 1e-15, 1e-4])} | held
            motion = machine.at(**strokes, unreachable="nan")
            assert 0 < motion.reached.sum() < 5
            for request, found in zip(requests, machine.evaluate(requests, **strokes, unreachable="nan"), strict=True):
                assert_array_equal(motion[request], np.where(motion.reached, found, np.nan))
                assert_array_equal(np.isfinite(motion[request]), motion.reached)
            at_end = machine.at(**{name: np.broadcast_to(value, 5)[motion.reached] for name, value in strokes.items()})
            assert_array_equal(at_end[requests[0]], motion[requests[0]][motion.reached])
