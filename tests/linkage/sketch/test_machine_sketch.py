"""A machine to a sketch and back; a sketch as a class, as Python and as TOML; what is refused, by its name."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from linkage import DefinitionError
from linkage.files import from_dict, load
from linkage.sketch import MachineSketch, SketchDrive, SketchSlide, SketchWeight, sketch_of, sketch_text
from linkage.sketch.board_json import board_tables
from tests import shipped
from tests.for_all import for_all

DAILY = ["four_bar", "slider_crank", "inverted_slider_crank", "scissor_lift", "three_point_hitch", "peaucellier"]
OTHERS = ["jansen", "klann", "front_loader", "hart", "watt_one", "stephenson_two", "hoeken", "roberts", "toggle_press", "header_balancer"]
REFUSED = {
    "scotch_yoke": "X = YokeDyad(A, rail, angle=90 * deg) is no pin, link, slide, crank or cylinder",
    "trammel": "no crank on the frame and no cylinder follows the stroke S one to one",
    "at_work.excavator": "Excavator: it has parts",
    "crane": "the crank J does not follow one stroke one to one",
}
BOOM = MachineSketch(
    "Boom",
    dict(O=(0.0, 0.0), A=(0.4, -0.1), B=(0.503, 0.3004), T=(1.5, 0.6)),
    ("O", "A"),
    {"boom": ("O", "B", "T")},
    drives={"S": SketchDrive("cylinder", ("A", "B"), 0.0, 0.2)},
)
PUMP = MachineSketch(
    "Pump",
    dict(O=(0.0, 0.0), A=(0.05, 0.02), C=(0.2, 0.03)),
    ("O",),
    {"crank": ("O", "A"), "rod": ("A", "C")},
    {"shoe": SketchSlide("C", 0.1)},
    {"phi": SketchDrive("crank", ("O", "A"), 0.0, 2 * pi)},
)


def poses(machine, sketch, count=9):
    """Return a machine over the stroke of the first drive, the others as drawn."""
    drawn = {name: drive.drawn for name, drive in sketch.drives.items()}
    (name, drive), *_ = sketch.drives.items()
    return machine.at(unreachable="nan", **{**drawn, name: np.linspace(drive.start, drive.end, count)})


def python_class(text, name):
    """Return the class that a Python text makes."""
    space = {}
    exec(text, space)
    return space[name]


@for_all("name", DAILY, slow=OTHERS)
def test_a_machine_goes_to_a_sketch_and_back(name):
    machine = shipped.MACHINES[name]()
    sketch = sketch_of(machine)
    again = sketch.to_class()()
    drawn = {each: drive.drawn for each, drive in sketch.drives.items()}
    size = max(sketch.size, 1e-9)
    for point in sketch.points:
        assert np.max(np.abs(machine.at(**drawn)[point] - again.at(**drawn)[point])) < 1e-12 * size, point
        assert np.nanmax(np.abs(poses(machine, sketch)[point] - poses(again, sketch)[point])) < 1e-9 * size, point


def test_it_may_be_drawn_at_another_pose_and_of_another_design():
    hitch = shipped.MACHINES["three_point_hitch"](OB=0.31)
    sketch = sketch_of(hitch, at={"S": 0.1})
    assert sketch.drives["S"].drawn == 0.1
    again = sketch.to_class()()
    for point in sketch.points:
        assert np.max(np.abs(poses(hitch, sketch)[point] - poses(again, sketch)[point])) < 1e-12


def test_what_a_sketch_does_not_hold_is_told():
    sketch = sketch_of(shipped.MACHINES["three_point_hitch"])
    (note,) = sketch.notes
    assert note.startswith("Not in the sketch of ThreePointHitch: ") and " load," not in note and "tilt" in note
    assert sketch.weights["load"].mass == shipped.MACHINES["three_point_hitch"]()["load.mass"]
    boom = replace(BOOM, drives={"S": replace(BOOM.drives["S"], bore=0.063, rod=0.036)}).tables()
    ends = boom["hydraulics"]["cylinder_S"]["Cylinder"]
    boom["hydraulics"]["other"] = {"Cylinder": ends, "bore": 0.08, "rod": 0.05}
    twin = sketch_of(from_dict(boom))
    assert (twin.drives["S"].bore, twin.notes) == (0.08, ("Not in the sketch of Boom: cylinder_S.",))


def test_other_machines_are_refused_by_name():
    for name, words in REFUSED.items():
        with pytest.raises(DefinitionError) as refused:
            sketch_of({**shipped.MACHINES, **shipped.AT_WORK}[name])
        assert words in str(refused.value), name
    with pytest.raises(DefinitionError, match="one design, not of a batch"):
        sketch_of(shipped.MACHINES["four_bar"](OA=[1.0, 1.1]))


@for_all("sketch", [BOOM, PUMP, sketch_of(shipped.MACHINES["inverted_slider_crank"])], ids=lambda sketch: sketch.name)
def test_python_and_toml_are_the_class_to_the_last_bit(sketch):
    first = sketch.to_class()
    for other in (load(sketch.to_toml()), python_class(sketch.to_python(), sketch.name)):
        assert first.plan.defaults == other.plan.defaults
        for point in sketch.points:
            assert np.array_equal(poses(first(), sketch)[point], poses(other(), sketch)[point], equal_nan=True), point


def test_numbers_of_arrays_are_written_as_plain_ones():
    x = np.array([0.0, 0.4, 0.2])
    (O, A, B), end = zip(x, x[::-1], strict=True), np.float64(0.2)
    points, drives = {"O": O, "A": A, "B": B}, {"S": SketchDrive("cylinder", ("A", "B"), x[0], end, bore=end / 2, rod=end / 4)}
    sketch = MachineSketch("Arm", points, ("O", "A"), {"arm": ("O", "B")}, drives=drives, weights={"m": SketchWeight("B", x[1])})
    assert "np." not in sketch.to_python() + sketch.to_toml()
    assert python_class(sketch.to_python(), "Arm").plan.defaults == sketch.to_class().plan.defaults


def test_round_lengths_close_and_say_what_moves():
    for sketch in (BOOM, PUMP):
        rounded = sketch.rounded(0.01)
        machine = rounded.to_class()
        lengths = {name: value for name, value in machine().dimensions.items() if name in rounded.lengths}
        assert lengths and all(abs(value / 0.01 - round(float(value) / 0.01)) < 1e-9 for value in lengths.values()), lengths
        turns = [*rounded.angles.values(), *(each.along for each in rounded.slides.values())]
        assert turns and all(abs(np.degrees(turn) - round(np.degrees(turn), 1)) < 1e-12 for turn in turns), turns
        assert machine().verdicts() and not any("The sketch has" in str(each) for each in machine().verdicts())
        moved = {name: np.hypot(*np.subtract(rounded.points[name], sketch.points[name])) for name in sketch.points}
        most = max(moved, key=moved.get)
        assert f"{most} moves most, by" in rounded.notes[-1] and moved[most] < 0.03
        motion = machine().at(**{name: drive.drawn for name, drive in rounded.drives.items()})
        assert max(np.hypot(*(motion[name] - rounded.points[name])) for name in sketch.points) < 1e-12
    for step in (0.0, -1.0, float("nan"), 5.0):
        with pytest.raises(DefinitionError):
            BOOM.rounded(step)


def test_what_is_no_sketch_is_refused():
    points = dict(O=(0.0, 0.0), A=(0.1, 0.0))
    wrong = [
        (dict(points={}), "no point is drawn"),
        (dict(points=dict(O=(0.0, float("nan")))), "O stands at"),
        (dict(points=dict(O=("0", 0.0))), "O stands at"),
        (dict(points=points, slides={"s": SketchSlide("A", float("inf"))}), "the slide s has inf; give finite numbers"),
        (dict(points=points, drives={"S": SketchDrive("crank", ("O", "A"), 0.0, float("inf"))}), "the drive S has 0.0, inf, 0.0"),
        (dict(points=points, lengths={"OA": None}), "the length OA has None"),
        (dict(points=points, weights={"w": SketchWeight("A", float("nan"))}), "the weight w has nan"),
        (dict(points=points, fixed=("X",)), "what is fixed names X"),
        (dict(points=points, links={"arm": ("O", "Z")}), "the link arm names Z"),
        (dict(points=points, links={"arm": ("O", "O")}), "the link arm names a point twice"),
        (dict(points=points, slides={"s": SketchSlide("A", ("O", "Y"))}), "the slide s names Y"),
        (dict(points=points, drives={"S": SketchDrive("crank", ("O", "Q"), 0.0, 1.0)}), "the drive S names Q"),
    ]
    for given, words in wrong:
        with pytest.raises(DefinitionError, match=words):
            MachineSketch("Wrong", **given)
    whole = {each: tuple(map(np.int64, np.round(np.multiply(100, place)))) for each, place in PUMP.points.items()}
    level = replace(PUMP, points=whole, slides={"shoe": SketchSlide("C", 0)})
    assert board_tables(level)["points"] == {"O": [0.0, 0.0], "A": [5.0, 2.0], "C": [20.0, 3.0]}
    assert level.to_class()().plan.strokes.keys() == {"phi"} and "0deg" in sketch_text(level, ".csv")
    with pytest.raises(DefinitionError, match="--drive O A"):
        MachineSketch("Still", points, ("O",), {"arm": ("O", "A")}).to_class()
