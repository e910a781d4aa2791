"""A synthesis as a file: what it says, points in the file and in CSV files, and mistakes with their lines."""

from functools import partial

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from linkage import FileError, FunctionTask, Outline, PathTask, PoseTask, deg, mm, outside
from linkage.cli.optimise import machine_of_study
from linkage.files.synthesis_file import PointColumn, points_said, read_synthesis
from linkage.motion.regions import region_of

HEAD = """machine = "four_bar"
[synthesis]
starts = 4
vary = { OA = "20 to 60 mm", CB = "50 to 200 mm", AP = "20 to 150 mm", BAP = "0 to 90 deg" }
"""
POINTS = np.array([(30.0, 60.0), (15.0, 70.0), (-15.0, 66.0)])
LENGTHS = (PointColumn(("x",), "length"), PointColumn(("y",), "length"), PointColumn(("at", "phi"), "angle", optional=True))


def read(folder, text):
    """Return the synthesis of a file."""
    file = folder / "task.toml"
    file.write_text(HEAD + text, encoding="utf-8")
    return read_synthesis(file, partial(machine_of_study, []))


@pytest.mark.parametrize(
    "text",
    [
        "x [mm], y [mm]\n30, 60\n15, 70\n-15, 66\n",
        '"y, mm","x, mm",remark\n60,30,first\n70,15,\n66,-15,last\n',
        "x (cm);y (mm)\n3,0;60\n1,5;70,0\n-1,5;66\n",
        "# measured on the frame\nx/mm\ty/mm\n\n30\t60\n15\t70\n-15\t66\n",
        "x,y\n0.03,0.06\n0.015,0.07\n-0.015,0.066\n",
        "0.03,0.06\n0.015,0.07\n-0.015,0.066\n",
        "\ufeffx [mm],y [mm]\r\n30,60\r\n15,70\r\n-15,66\r\n",
    ],
)
def test_points_of_a_csv_file_are_read_with_their_units(tmp_path, text):
    (tmp_path / "points.csv").write_text(text, encoding="utf-8", newline="")
    found = read(tmp_path, 'path = { of = "P", points = "points.csv" }').arguments["path"]
    assert isinstance(found, PathTask) and found.of == "P" and found.at is None and found.in_order
    assert_allclose(found.points, POINTS * mm, rtol=1e-15)


def test_points_in_the_file(tmp_path):
    rows = '[[30, 60, 12], ["15 mm", "7 cm", "45 deg"], [-15, 66, "2 rad"]]'
    found = read(tmp_path, f'path = {{ of = "P", points = {rows}, unit = ["mm", "deg"], in_order = false }}\ntimed = true').arguments
    assert_allclose(found["path"].points, POINTS * mm, rtol=1e-15)
    assert_allclose(found["path"].at, [12 * deg, 45 * deg, 2.0])
    assert found["timed"] is True and not found["path"].in_order and not found["path"].closed
    text = HEAD.replace("starts = 4", 'starts = "catalogue"') + 'path = { of = "P", points = [[1, 2], [2, 3], [2, 1]], closed = true }'
    (tmp_path / "task.toml").write_text(text, encoding="utf-8")
    asked = read_synthesis(tmp_path / "task.toml", partial(machine_of_study, [])).arguments
    assert asked["path"].closed and asked["starts"] == "catalogue"
    assert found["vary"]["OA"] == (0.02, 0.06) and found["starts"] == 4


def test_it_may_begin_from_a_catalogue(tmp_path):
    text = HEAD.replace("starts = 4", 'starts = "catalogue"') + 'path = { of = "P", points = [[1, 2], [2, 3], [2, 1]], closed = true }'
    (tmp_path / "task.toml").write_text(text, encoding="utf-8")
    assert read_synthesis(tmp_path / "task.toml", partial(machine_of_study, [])).arguments["starts"] == "catalogue"
    (tmp_path / "task.toml").write_text(text.replace("catalogue", "atlas"), encoding="utf-8")
    with pytest.raises(FileError, match="starts"):
        read_synthesis(tmp_path / "task.toml", partial(machine_of_study, []))


def test_a_side_is_a_choice(tmp_path):
    text = HEAD.replace(" }\n", ', B = { side = ["LEFT", "RIGHT"] } }\n') + 'path = { of = "P", points = [[1, 2]] }'
    (tmp_path / "task.toml").write_text(text, encoding="utf-8")
    vary = read_synthesis(tmp_path / "task.toml", partial(machine_of_study, [])).arguments["vary"]
    assert vary["B.side"] == ["LEFT", "RIGHT"] and vary["OA"] == (0.02, 0.06)
    (tmp_path / "task.toml").write_text(text.replace("RIGHT", "UP"), encoding="utf-8")
    with pytest.raises(FileError, match=r"B\.side: 'UP' is no side"):
        read_synthesis(tmp_path / "task.toml", partial(machine_of_study, []))


SEVERAL = """machine = ["four_bar", "slider_crank"]
[synthesis]
path = { of = "P", points = [[30, 60], [15, 70], [0, 72]], unit = "mm" }
starts = 4
subject_to = { four_bar = ["least(transmission(B)) >= 30 deg"] }
rank = "-1 * least(transmission(B))"
[synthesis.vary.four_bar]
OA = "20 to 60 mm"
"""


def test_several_machines_are_told_class_by_class(tmp_path):
    (tmp_path / "task.toml").write_text(SEVERAL, encoding="utf-8")
    asked = read_synthesis(tmp_path / "task.toml", partial(machine_of_study, []))
    assert [type(each).__name__ for each in asked.machine] == ["FourBar", "SliderCrank"]
    bar, crank = map(type, asked.machine)
    assert asked.arguments["vary"] == {bar: {"OA": (0.02, 0.06)}}
    held = asked.arguments["subject_to"]
    assert set(held) == {bar} and str(held[bar][0]) == "least(transmission(B)) >= 0.523599"
    assert set(asked.arguments["rank"]) == {bar, crank} == set(asked.arguments["path"].of)
    (tmp_path / "task.toml").write_text(SEVERAL.replace("vary.four_bar", "vary.fourbar"), encoding="utf-8")
    with pytest.raises(FileError, match=r"Machine 'fourbar' is unknown\. Did you mean four_bar"):
        read_synthesis(tmp_path / "task.toml", partial(machine_of_study, []))


REGIONS = """
[synthesis.regions]
C = [[["50 mm", "-30 mm"], [0.15, "-3 cm"], ["150 mm", 0.06]], { outside = { at = ["100 mm", 0], radius = "25 mm" } }]
"""


def test_regions_are_those_of_a_call(tmp_path):
    task = 'path = { of = "P", points = [[30, 60], [15, 70], [0, 72]], unit = "mm" }\n'
    corners, wheel = [(0.05, -0.03), (0.15, -0.03), (0.15, 0.06)], Outline.circle((0.1, 0.0), 0.025)
    said = read(tmp_path, task + REGIONS).arguments["regions"]["C"]
    given, wanted = (region_of(each, "C") for each in (said, [corners, outside(wheel)]))
    assert_allclose(given.within[0].corners, wanted.within[0].corners, rtol=1e-15)
    assert given.without == wanted.without
    both = SEVERAL.replace("[synthesis.vary", REGIONS.replace("C =", "O =") + "[synthesis.vary")
    (tmp_path / "task.toml").write_text(both, encoding="utf-8")
    of_each = read_synthesis(tmp_path / "task.toml", partial(machine_of_study, [])).arguments["regions"]
    assert len(of_each) == 2 and all(set(each) == {"O"} for each in of_each.values())


def test_a_function_and_poses(tmp_path):
    (tmp_path / "psi.csv").write_text("phi [deg], psi [deg]\n30, 100\n60, 110\n", encoding="utf-8")
    found = read(tmp_path, 'function = { of = "psi", points = "psi.csv" }\nover = { phi = "30 to 60 deg" }').arguments
    assert isinstance(found["function"], FunctionTask) and found["function"].of == "psi"
    assert_allclose([found["function"].at, found["function"].values], np.radians([[30, 60], [100, 110]]))
    (tmp_path / "poses.csv").write_text("x [mm], y [mm], angle [deg]\n10, 20, 30\n11, 21, 40\n", encoding="utf-8")
    task = read(tmp_path, 'motion = { of = "A B", points = "poses.csv", length = "90 mm" }').arguments["motion"]
    assert isinstance(task, PoseTask) and task.of == "A B" and task.length == 0.09
    assert_allclose([task.x / mm, task.y / mm, task.angle / deg], [[10, 11], [20, 21], [30, 40]])


def test_a_file_says_what_a_call_says(tmp_path):
    (tmp_path / "points.csv").write_text("x [mm],y [mm]\n30,60\n15,70\n0,72\n-15,66\n-22,50\n", encoding="utf-8")
    text = """path = { of = "P", points = "points.csv" }
rank = "-1 * least(transmission(B))"
subject_to = ["least(transmission(B)) >= 10 deg"]
round = "1 mm"
seed = 3
"""
    asked = read(tmp_path, text)
    assert asked.rounding == {"to": 1 * mm} and asked.arguments["seed"] == 3
    assert str(asked.arguments["rank"]) == "-1 * least(transmission(B))"
    found = asked.run()
    path = np.array([found.machine.at(phi=stroke)["P"] for stroke in found.best.strokes])
    assert_allclose(np.sum((path - found.task.points) ** 2), found.error, rtol=1e-9)
    assert_array_equal(found.task.points, asked.arguments["path"].points)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "line 2, synthesis: there is no task; write one, path = "),
        ('path = { of = "P", points = [[1, 2]] }\nmotion = { of = "A B", points = [[1, 2, 3]] }', "path and motion are several tasks"),
        ('path = { of = "Z", points = [[1, 2]] }', "synthesis.path.of: Point 'Z' is unknown in FourBar"),
        ('path = { of = "P" }', 'points is missing; write points = [[30, 60], [15, 70]] with unit = "mm"'),
        ('path = { of = "P", points = [[1, 2], [3]] }', "row 2, [3]: a list with x, y is expected, all rows of one length"),
        ('path = { of = "P", points = [[1, "2 deg"]] }', "'2 deg' is an angle where a value of kind length is wanted"),
        ('path = { of = "P", points = [[1, 2]], unit = "furlong" }', "synthesis.path.unit: Unit 'furlong' is unknown"),
        ('path = { of = "P", points = "none.csv" }', "none.csv: there is no such file"),
        ('path = { of = "P", points = [[1, 2]], closed = "yes" }', "closed='yes': true or false is expected"),
        ('path = { of = "P", points = [[1, 2]], color = 3 }', "Key 'color' is unknown"),
        ('path = { of = "P", points = [[1, 2]] }\ntimed = "later"', "synthesis.timed: 'later': true, false or \"steps\""),
        ('path = { of = "P", points = [[1, 2]] }\nsubject_to = ["most(psi) > 2"]', "synthesis.subject_to.1"),
        ('path = { of = "P", points = [[1, 2]] }\nregions = { Q = "plate" }', "synthesis.regions.Q: Point 'Q' is unknown"),
        ('path = { of = "P", points = [[1, 2]] }\nregions = { C = "outside(weel)" }', "Outline 'weel' is unknown"),
        ('path = { of = "P", points = [[1, 2]] }\nregions = { C = { at = [0, "1 deg"], radius = 1 } }', "'1 deg' is an angle"),
        ('path = { of = "P", points = [[1, 2]] }\nregions = { C = 3 }', "regions.C: 3 is no region; write corners"),
        ('path = { of = "P", points = [[1, 2]] }\nregions = "plate"', "regions: 'plate': a region for each point"),
        ('path = { of = "P", points = [[1, 2]] }\nfaster = true', "Key 'faster' is unknown"),
        ('function = { of = "nothing", points = [[1, 2]] }', "synthesis.function.of: "),
        ('motion = { of = "A", points = [[1, 2, 3]] }', "two points of the body expected"),
        ('path = { of = "P", points = [[1, 2]] }\n[outputs]\npage = "a.pdf"', "outputs.page: a.pdf: the file's name ends in one of .html"),
    ],
)
def test_mistakes_are_told_with_their_place(tmp_path, text, said):
    with pytest.raises(FileError) as error:
        read(tmp_path, text)
    assert said in " ".join(str(error.value).split())
    assert str(error.value).startswith("task.toml: ")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("x [mm], y [mm]\n30, 60\n15, seventy\n", "points.csv, line 3, y: 'seventy' is no finite number"),
        ("x [mm], y [mm]\n30, 60\n15\n", "points.csv, line 3: 1 fields where the first line has 2"),
        ("x [mm], z [mm]\n30, 60\n", "points.csv, line 1: there is no column y; its headings are x [mm], z [mm]"),
        ("x [mm], y [deg]\n30, 60\n", "points.csv, line 1, y: deg measures angle; use one of m, mm"),
        ("x [mm], y [mmm]\n30, 60\n", "Unit 'mmm' is unknown in points.csv, line 1, y."),
        ("x [mm], y [mm]\n", "points.csv has headings and no row"),
        ("\n\n", "points.csv holds no row"),
        ("1,2,3,4\n", "points.csv, line 1: 4 numbers where x, y are expected"),
        ("x,y\n1,nan\n", "y: 'nan' is no finite number"),
    ],
)
def test_mistakes_of_a_csv_file_are_told_with_their_line(tmp_path, text, said):
    (tmp_path / "points.csv").write_text(text, encoding="utf-8")
    with pytest.raises(FileError) as error:
        read(tmp_path, 'path = { of = "P", points = "points.csv" }')
    assert said in " ".join(str(error.value).split())
    assert "line 5, synthesis.path.points" in str(error.value)


def test_a_seeded_table_comes_back_from_any_way_to_write_it(tmp_path):
    random = np.random.default_rng(11)
    for count in (1, 2, 40):
        values = random.normal(size=(count, 3))
        file = tmp_path / f"{count}.csv"
        lines = [f"{phi!r};{y!r};{x!r}".replace(".", ",") for x, y, phi in values.tolist()]
        file.write_text("\n".join(["phi [deg];y [mm];x [m]", *lines]), encoding="utf-8")
        found = points_said(file.name, LENGTHS, {}, tmp_path)
        assert_allclose([found["x"], found["y"] / mm, found["at"] / deg], values.T, rtol=1e-14)
        rows = [[f"{x!r} m", y, f"{phi!r} deg"] for x, y, phi in values.tolist()]
        again = points_said(rows, LENGTHS, {"length": mm}, tmp_path)
        assert_allclose([again[name] for name in ("x", "y", "at")], [found[name] for name in ("x", "y", "at")], rtol=1e-14)
