"""What the board computes and writes, in headless Chromium without its page, against Python: texts, poses, what is short, what is loose."""

import json
import random
from dataclasses import replace
from functools import cache
from importlib.resources import files
from math import cos, dist, hypot, pi, sin

import numpy as np
import pytest

from linkage import DefinitionError, FileError, LinkageError
from linkage.board.page import drawing_data
from linkage.cli import main
from linkage.files import load
from linkage.mobility import mobility
from linkage.sketch import MachineSketch, SketchDrive, SketchSlide, SketchWeight, is_foreign, read_sketch, sketch_of
from linkage.sketch.board_json import board_json, board_tables
from tests import shipped
from tests.for_all import check_all
from tests.linkage.sketch import emit
from tests.linkage.sketch.plans import PLANS
from tests.linkage.sketch.test_machine_sketch import BOOM, DAILY, OTHERS, PUMP, python_class

DEAD = 0.01
"""The part of a stroke next to a dead point that is not compared."""
STARTED = """
const started = (name, places, fixed, links) => {
  let d = model.empty(name);
  for (const [point, [x, y]] of Object.entries(places)) d = model.addPoint(d, point, x, y);
  for (const point of fixed) d = model.fix(d, point);
  for (const points of links) d = model.link(d, [...points]);
  return d;
};
"""
FOUR_BAR = """
let d = started("Rocker", { O: [0, 0], A: [0.04, 0.015], B: [0.15, 0.11], C: [0.16, 0], T: [0.09, 0.14] }, "C", ["ABT", "BC"]);
d = model.crank(d, "O", "A");
"""
SLIDER_CRANK = """
let d = started("Pump", { O: [0, 0], A: [0.05, 0.02], C: [0.2, 0.03] }, "", ["AC"]);
d = model.weight(model.crank(model.slide(d, "C", 0.1), "O", "A"), "C", 12.5);
"""
SIX_BAR = """
const places = { O: [0, 0], A: [0.04, 0.02], B: [0.16, 0.12], C: [0.17, 0], D: [0.24, 0.11], E: [0.33, 0.14], F: [0.32, 0] };
let d = model.crank(started("Watt", places, "CF", ["AB", "BCD", "DE", "EF"]), "O", "A");
"""
LOADER = """
const boom = { O: [0, 1.6], K: [0.2, 0.7], L: [1.2, 1.53], B: [2.65, 1.34], H: [1.3, 1.71] };
const bucket = { M: [-0.6, 1.9], F: [1.25, 2.05], G: [2.6, 1.65], N: [3.46, 0.96] };
let d = started("Loader", { ...boom, ...bucket }, "OKM", ["OLHB", "HF", "FG", "GBN"]);
d = model.cylinder(d, "K", "L", { closed: 1.1, stroke: 0.5, bore: 0.08, rod: 0.045 }, "lift");
d = model.cylinder(d, "M", "F", { closed: 1.6, stroke: 0.5, bore: 0.07, rod: 0.04 }, "tilt");
d = model.weight(d, "N", 900, "load");
"""


@pytest.fixture(scope="module")
def board(chromium):
    """Return a function that runs a program with the board's functions in a page, and returns what it returns."""
    tab = chromium.new_page()
    tab.set_content("<!DOCTYPE html><title>functions</title>")
    say = "const say = (text, values) => text.replace(/\\{(\\w+)\\}/g, (_, name) => values[name]);"
    own = "".join(files("linkage.board").joinpath(each).read_text(encoding="utf-8") for each in ("model.js", "solver.js", "writers.js"))
    tab.add_script_tag(content=f"{say}\n{own}\n{STARTED}\nObject.assign(window, {{ model, solver, writers, started }});")
    tab.evaluate("(names) => names.forEach((each) => model.reserved.add(each))", drawing_data()["reserved"])
    yield lambda program, given=None: tab.evaluate(f"(given) => {{ {program} }}", given)
    tab.close()


def text_of(sketch):
    """Return a sketch as the text of the board's file."""
    return json.dumps(board_tables(sketch))


def read_text(text, folder, name="board.json"):
    """Read a text as a file of the board."""
    (folder / name).write_text(text, encoding="utf-8")
    return read_sketch(folder / name)


@cache
def plan_sketches(slow):
    """Return sketches of the plans by name, in two formats each, or in all."""
    found = {}
    for number, plan in enumerate(PLANS):
        hows = [how for how, (write, suffix, _) in emit.FORMATS.items() if write(plan) is not None and not suffix]
        found |= {f"{plan.name} {how}": read_sketch(emit.FORMATS[how][0](plan)) for how in (hows if slow else hows[:1])}
        if not plan.rigid:
            found[f"{plan.name} board"] = plain_sketch(plan, number % 3)
    return found


def plain_sketch(plan, turns):
    """Return a plan as a sketch of its own, turned by some right angles [m]."""
    unit = 1e-3

    def turned(x, y):
        return [(x, y), (0.0 - y, x), (0.0 - x, 0.0 - y)][turns]

    carried = {point: f"{point}s" for point, along in plan.slides if isinstance(along, tuple)}
    points = {name: turned(unit * x, unit * y) for name, (x, y) in plan.points.items()}
    links = {f"body_{link}": [*link] for link in plan.links}
    slides = {}
    for point, along in plan.slides:
        if isinstance(along, tuple):  # a slot beside the pins of its link: a point of the link says its line
            link, angle = along[0], along[1] + 0.5 * pi * turns
            points[carried[point]] = tuple(map(float, np.add(points[point], [0.07 * cos(angle), 0.07 * sin(angle)])))
            points[f"{point}r"] = tuple(map(float, np.subtract(points[point], [0.06 * cos(angle), 0.06 * sin(angle)])))
            next(each for name, each in links.items() if name == f"body_{link}").extend([carried[point], f"{point}r"])
            slides[f"slide_{point}"] = SketchSlide(point, (f"{point}r", carried[point]))
        else:
            slides[f"slide_{point}"] = SketchSlide(point, tuple(along) if isinstance(along, str) else along + 0.5 * pi * turns)
    links = {name: tuple(each) for name, each in links.items()}
    ends = tuple(plan.crank or plan.cylinder)
    drive = SketchDrive("crank", ends, -0.3, 2 * pi - 0.3) if plan.crank else SketchDrive("cylinder", ends, 0.0, unit * plan.throw)
    return MachineSketch(plan.name, points, tuple(plan.fixed), links, slides, {"drive": drive})


# -- texts -------------------------------------------------------------------------------------------------


def compare_texts(board, sketch, folder):
    """Compare what the board writes of a sketch with what Python writes, of the sketch and of the board's file of it."""
    write = "const { drawing } = writers.opened(given); return ['python', 'toml', 'file'].map((each) => writers[each](drawing));"
    written = board(write, text_of(sketch))
    assert written[:2] == [sketch.to_python(), sketch.to_toml()]
    assert read_text(written[2], folder) == sketch


def test_python_and_toml_are_letter_by_letter_what_python_writes(board, tmp_path):
    """A third of them every day."""
    cases = {"boom": BOOM, "pump": PUMP} | {name: each for name, each in plan_sketches(False).items() if name.endswith("board")}
    check_all([(name, (board, sketch, tmp_path)) for name, sketch in [*cases.items()][::3]], compare_texts)


@pytest.mark.slow
def test_all_machines_with_a_sketch_are_written_alike(board, tmp_path):
    cases = plan_sketches(True) | {name: sketch_of(shipped.MACHINES[name]) for name in (*DAILY, *OTHERS)} | {"boom": BOOM, "pump": PUMP}
    check_all([(name, (board, sketch, tmp_path)) for name, sketch in cases.items()], compare_texts)


def drawn_at_random(seed):
    """Return a sketch of everything that the board draws, with numbers that are short, long, tiny, huge, and whole."""
    pick = random.Random(seed)

    def number(low=0.0):
        value = pick.choice(
            [
                pick.uniform(low, 2),
                pick.uniform(low, 2e-6),
                pick.uniform(low, 9e5),
                float(pick.randint(1, 99)),
                0.001 * pick.randint(1, 999),
            ]
        )
        return pick.choice([1.0, -1.0]) * value if low == 0.0 else value

    names = ["A", "B", "Größe", "D", "E2", "F", "G" * 38, "H", "Ж"]
    points = {name: (number(), number()) for name in names}
    links = {"plate": ("A", "Größe", "D"), "long": tuple(names[1:]), "bar": ("A", "B")}
    start = pick.choice([0.0, number(1e-9)])
    drives = {
        "phi": SketchDrive(
            "crank", ("A", "B"), number(), pick.choice([number(), 2 * pi, pi / 180 * pick.randint(-720, 720) or 1.0]), number()
        ),
        "S": SketchDrive(
            "cylinder", ("D", "E2"), start, start + number(1e-3), number(), *pick.choice([(), (0.001 * pick.randint(50, 200), 0.03)])
        ),
    }
    slides = {"slide_H": SketchSlide("H", pick.choice([number() % 6, pi / 2, 0.0])), "slide_F": SketchSlide("F", ("A", "D"))}
    lengths = {"AB": number(1e-3), "GrößeA": number(1e-3), "DE2": number(1e-3)} if pick.random() < 0.4 else {}
    notes = ("It says \"this\" \\ and 'that'.", " A = 1")[: pick.randint(0, 2)]
    return MachineSketch("Mach2", points, ("A", "H"), links, slides, drives, lengths, {"load": SketchWeight("F", number(1e-3))}, notes)


def test_whatever_numbers_a_drawing_has_python_is_written_alike(board, tmp_path):
    sketches = [drawn_at_random(seed) for seed in range(120)]
    written = board(
        "return given.map((each) => writers.python(model.read(each).drawing));",
        [text_of(each) for each in sketches],
    )
    for seed, (text, sketch) in enumerate(zip(written, sketches, strict=True)):
        assert text == sketch.to_python(), seed
        assert read_text(board_json(sketch), tmp_path) == sketch, seed


@pytest.mark.slow
def test_toml_says_angles_sizes_and_lengths_alike(board, tmp_path):
    pick = random.Random(5)
    for seed in (0, 3):
        start, bore = pick.choice([0.0, pick.uniform(0.01, 0.3)]), pick.choice([0.063, 0.1, pick.uniform(0.05, 0.2)])
        drive = SketchDrive("cylinder", ("A", "B"), start, start + pick.uniform(0.02, 0.1), start, bore, 0.5 * bore)
        wide = {f"P{n}": (1.5 + 0.1 * n, pick.uniform(0.5, 0.7)) for n in range(5 * seed)} if seed == 3 else {}
        points = {**BOOM.points, "B": (pick.uniform(0.45, 0.55), 0.3), "C": (pick.uniform(1.2, 1.4), 0.2), **wide}
        links = {"boom": ("O", "B", "T", *wide), "arm": ("T", "C")}
        slides = {"rail": SketchSlide("C", pick.choice([0.0, pi / 6, pick.uniform(-0.2, 0.2)]))}
        compare_texts(
            board,
            MachineSketch(
                "Boom", points, ("O", "A"), links, slides, {"S": drive}, weights={"load": SketchWeight("T", pick.uniform(1, 1e4))}
            ),
            tmp_path,
        )
    for end in (-2 * pi, pi / 7):
        crank = SketchDrive("crank", ("O", "A"), pick.uniform(-1, 0), end, pi / 180 * pick.randint(1, 9))
        compare_texts(board, MachineSketch("Pump", PUMP.points, PUMP.fixed, PUMP.links, PUMP.slides, {"phi": crank}), tmp_path)


# -- poses -------------------------------------------------------------------------------------------------

SWEEPS = """
const { drawing, wrong } = writers.opened(given.text), drive = Object.keys(drawing.drives)[0];
const moved = solver.run(drawing, { [drive]: given.at });
const posed = model.posed(drawing, moved.points, moved.strokes), sweep = solver.sweep(drawing, drive, given.count);
const told = { wrong, lacking: model.lacking(drawing), mobility: solver.mobility(drawing), stopped: moved.stopped };
return { ...told, texts: [drawing, posed].map(writers.python), ...sweep };
"""


def compare_poses(board, sketch, count=25):
    """Compare a sketch's poses on the board, drawn as it is and moved, with the class that the board writes; return how many there are."""
    name, drive = next(iter(sketch.drives.items()))
    given = {"text": text_of(sketch), "count": count, "at": drive.drawn + 0.08 * (drive.end - drive.start)}
    found = board(SWEEPS, given)
    assert found["wrong"] == found["lacking"] == [] and not found["mobility"]["singular"], found
    held = {each: other.drawn for each, other in sketch.drives.items()}
    clear = [all(abs(value - stop["value"]) > DEAD * abs(drive.end - drive.start) for stop in found["stops"]) for value in found["values"]]
    compared = 0
    for text in found["texts"][: 1 if found["stopped"] else 2]:
        motion = python_class(text, sketch.name)().at(unreachable="nan", **{**held, name: np.array(found["values"])})
        for point in sketch.points:
            expected = np.broadcast_to(motion[point], (2, count)).T
            for pose, place, is_clear in zip(found["poses"], expected, clear, strict=True):
                if is_clear and pose is not None:
                    assert np.hypot(*(pose[point] - place)) < 1e-9 * sketch.size, (point, pose[point], place)
                    compared += 1
    assert any(found["poses"])
    return compared / len(sketch.points)


def test_sketches_opened_moved_and_exported_have_the_poses_of_the_board(board):
    """A third of them every day."""
    cases = {**plan_sketches(False), "boom": BOOM, "pump": PUMP} | {name: sketch_of(shipped.MACHINES[name]) for name in DAILY}
    assert len(cases) > 30
    check_all([(name, (board, sketch)) for name, sketch in [*cases.items()][::3]], compare_poses)


@pytest.mark.slow
def test_all_sketches_have_the_poses_of_the_board(board):
    cases = plan_sketches(True) | {name: sketch_of(shipped.MACHINES[name]) for name in (*DAILY, *OTHERS)}
    cases |= {"boom": BOOM, "pump": PUMP} | {f"{kind} {seed}": machine_at_random(kind, seed) for kind in KINDS for seed in (1, 2)}
    check_all([(name, (board, sketch)) for name, sketch in cases.items()], compare_poses)


@pytest.mark.parametrize("program", [FOUR_BAR, SLIDER_CRANK, SIX_BAR], ids=["four-bar", "slider-crank", "six-bar"])
def test_a_machine_drawn_from_nothing_runs_in_python(board, program, tmp_path):
    sketch = read_text(board(f"{program} return writers.file(d);"), tmp_path)
    assert compare_poses(board, sketch, 37) > 37


def test_a_loader_with_two_cylinders_runs_in_python(board, tmp_path):
    values = [(lift, tilt) for lift in (0.02, 0.15, 0.3, 0.45) for tilt in (0.05, 0.2, 0.3)]
    found = board(
        f"""{LOADER} const runs = given.map(([lift, tilt]) => solver.run(d, {{ lift, tilt }}));
        return {{ python: writers.python(d), file: writers.file(d), mobility: solver.mobility(d), lacking: model.lacking(d), runs }};""",
        values,
    )
    assert found["lacking"] == [] and found["mobility"]["freedom"] == 2, found["mobility"]
    machine = python_class(found["python"], "Loader")()
    sketch = read_text(found["file"], tmp_path)
    again = sketch_of(load(sketch.to_toml()))
    assert load(sketch.to_toml())().dimensions == machine.dimensions
    assert (again.weights, again.drives, again.notes) == (sketch.weights, sketch.drives, ())
    reached = 0
    for (lift, tilt), answer in zip(values, found["runs"], strict=True):
        motion = machine.at(unreachable="nan", lift=lift, tilt=tilt)
        if answer["stopped"] == "":
            reached += 1
            assert max(hypot(*(motion[name] - place)) for name, place in answer["points"].items()) < 1e-9, (lift, tilt)
    assert reached > 6
    assert {"cylinder_lift", "cylinder_tilt", "load"} <= machine.plan.members.keys()


# -- what ends, what is loose, what is refused -------------------------------------------------------------

NO_STRETCH = """
return given.map(([text, point, goal, drive, value]) => {
  const { drawing } = writers.opened(text), dragged = solver.drag(drawing, point, goal), run = solver.run(drawing, { [drive]: value });
  return { dragged, run, posed: model.posed(drawing, dragged.points, dragged.strokes) };
});
"""


def four_bar_at_random(pick):
    """Return a four-bar with a coupler point and a second dyad on it, drawn at random but not flat [m]."""
    while True:
        O, A, B, C, D, F = ((pick.uniform(-1, 1), pick.uniform(-1, 1)) for _ in "OABCDF")
        turns = [abs((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) for p, q, r in ((A, B, C), (D, B, F))]
        if min(turns) > 0.1 and min(dist(O, A), dist(B, C), dist(A, B)) > 0.2:
            break
    T = (A[0] + pick.uniform(-0.5, 0.5), A[1] + pick.uniform(0.2, 0.6))
    drive = SketchDrive("crank", ("O", "A"), -pi, pi)
    points = dict(O=O, A=A, B=B, C=C, D=D, F=F, T=T)
    links = {"coupler": ("A", "B", "T"), "rocker": ("B", "C"), "push": ("T", "D"), "swing": ("D", "F")}
    return MachineSketch("FourBar", points, ("O", "C", "F"), links, drives={"phi": drive})


def machine_at_random(kind, seed):
    """Return a machine of a kind with its pins anywhere: a plate on three bars, a slot that moves, or two cylinders [m]."""
    pick = random.Random(f"{kind} {seed}")
    crank, (names, fixed, links) = SketchDrive("crank", ("O", "A"), -1.5, 1.5), KINDS[kind]
    points = {name: (pick.uniform(-1, 1), pick.uniform(-1, 1)) for name in names}
    bodies = {f"body_{each}": tuple(each) for each in links}
    slides, drives = {}, {"phi": crank}
    if kind == "slot":
        (px, py), (qx, qy), share = points["P"], points["Q"], pick.uniform(0.3, 0.7)
        points["A"] = (px + share * (qx - px), py + share * (qy - py))
        slides = {"slide_A": SketchSlide("A", ("P", "Q")), "slide_R": SketchSlide("R", pick.uniform(-1, 1))}
    if kind == "cylinders":
        drives = {"S": SketchDrive("cylinder", ("K", "A"), 0.0, 0.4), "s": SketchDrive("cylinder", ("L", "C"), -0.1, 0.2, 0.05)}
    return MachineSketch("Random", points, tuple(fixed), bodies, slides, drives)


KINDS = {
    "platform": ("OADEFPQ", "OPQ", ["OA", "AD", "DEF", "EP", "FQ"]),
    "slot": ("OAPQR", "OP", ["OA", "PQ", "QR"]),
    "cylinders": ("OABCKLT", "OKL", ["OAB", "BCT"]),
    "six-bar": ("OABCDEF", "OCF", ["OA", "AB", "BCD", "DE", "EF"]),
}


def test_machines_at_random_run_as_in_python(board):
    check_all([(kind, (board, machine_at_random(kind, 0))) for kind in KINDS], compare_poses)


def test_no_link_is_stretched_and_no_branch_leaps(board):
    pick = random.Random(39)
    sketches = [four_bar_at_random(pick) for _ in range(40)]
    asked = [
        (text_of(each), pick.choice("ABTD"), [pick.uniform(-2, 2), pick.uniform(-2, 2)], "phi", pick.uniform(-3, 3)) for each in sketches
    ]
    ended = 0
    for sketch, answer in zip(sketches, board(NO_STRETCH, asked), strict=True):
        bars = [*sketch.links.values(), ("O", "A")]
        for part in ("dragged", "run"):
            points, ended = answer[part]["points"], ended + bool(answer[part]["stopped"])
            stretched = [dist(points[P], points[Q]) - sketch.length(P, Q) for points_of in bars for P in points_of for Q in points_of]
            assert max(map(abs, stretched)) < 1e-9, (part, stretched)
            assert (answer[part]["short"] is not None) <= bool(answer[part]["stopped"])
        for name, place in answer["posed"]["points"].items():
            assert place == answer["dragged"]["points"][name]
    assert 10 < ended < 70
    counts = [compare_poses(board, sketch, 41) for sketch in sketches[:2]]
    assert sum(counts) > 30


def test_what_is_out_of_reach_names_the_link_and_how_short_it_is(board):
    reach = {"A": ("link_O_A", [0.3, 0.0]), "B": ("link_B_C", [0.16, 0.4])}
    for point, (link, goal) in reach.items():
        answer = board(f"{FOUR_BAR} return solver.drag(d, given[0], given[1]);", [point, goal])
        assert answer["short"]["name"] in (link, "link_A_B_T"), answer
        assert answer["stopped"] == f"{answer['short']['name']} is {abs(1e3 * answer['short']['gap']):.3g}\u2009mm too short", answer[
            "stopped"
        ]
    bar = board("return solver.drag(started('Bar', { O: [0, 0.02], A: [0.1, 0.02] }, 'O', ['OA']), 'A', [0.3, 0.02]);")
    assert bar["short"] == {"part": "links", "name": "link_O_A", "gap": pytest.approx(0.2, rel=1e-6)} and bar["points"][
        "A"
    ] == pytest.approx([0.1, 0.02], abs=1e-7)
    crank = board(f"{FOUR_BAR} d = model.movePoint(d, 'A', 0.09, 0.015); return [solver.run(d, {{ phi: 3 }}), d.points];")
    answer, places = crank
    angle = answer["strokes"]["phi"]
    arm, coupler, rocker = dist(places["O"], places["A"]), dist(places["A"], places["B"]), dist(places["B"], places["C"])
    far = dist(answer["points"]["A"], places["C"])
    assert 0 < angle < 3 and min(abs(far - (coupler + rocker)), abs(far - abs(coupler - rocker))) < 1e-9  # it stops at the dead point
    at_goal = np.arctan2(places["A"][1], places["A"][0]) + 3
    miss = dist((arm * cos(at_goal), arm * sin(at_goal)), places["C"]) - (coupler + rocker)
    assert answer["short"]["gap"] == pytest.approx(miss, rel=1e-3) and answer["short"]["name"] in ("link_A_B_T", "link_B_C")
    ram = board(f"{LOADER} return solver.drag(d, 'L', [1.2, 2.9]);")
    assert (
        ram["short"]["name"] == "lift" and ram["strokes"]["lift"] == pytest.approx(0.5, abs=1e-12) and ram["stopped"].startswith("lift is ")
    )


SINGULAR = {
    "a dyad drawn straight": ({"O": (0, 0), "A": (0, 1), "B": (1, 2), "C": (2, 3)}, "OC", ["AB", "BC"]),
    "a parallelogram drawn flat": ({"O": (0, 0), "A": (1, 0), "B": (3, 0), "C": (2, 0)}, "OC", ["AB", "BC"]),
    "a group whose bars meet in a point": (
        {"O": (-1, 0), "A": (0, 0), "D": (0, 1), "E": (2, 1), "F": (1, 2), "P": (3, 0), "Q": (0, 3)}, "OPQ", ["AD", "DEF", "EP", "FQ"],
    ),
}  # fmt: skip


def test_what_is_drawn_in_a_singular_pose_is_told_beforehand(board):
    cross = SINGULAR["a group whose bars meet in a point"]
    meeting = (0.0, 2.0)  # on the line A D; E P and F Q are laid through it
    for far, near in (("P", "E"), ("Q", "F")):
        cross[0][far] = tuple(map(float, np.add(cross[0][near], 1.3 * np.subtract(cross[0][near], meeting))))
    for aside in (0.0, 0.05):
        for name, (points, fixed, links) in SINGULAR.items():
            places = {each: (x + aside * (each in "BD"), y + 2 * aside * (each in "BD")) for each, (x, y) in points.items()}
            drives = {"phi": SketchDrive("crank", ("O", "A"), 0.0, 0.01)}
            sketch = MachineSketch("Singular", places, tuple(fixed), {each: tuple(each) for each in links}, drives=drives)
            told = board("return solver.mobility(writers.opened(given).drawing);", text_of(sketch))
            assert told["singular"] == (aside == 0.0), (name, aside, told)
            assert ("singular pose" in told["words"]) == (aside == 0.0)
            if aside:
                assert np.isfinite(sketch.to_class()().at(phi=0.0)["B" if "B" in points else "D"]).all()
            else:
                with pytest.raises(LinkageError):
                    sketch.to_class()().at(phi=0.005)


def test_freedom_is_counted_as_python_counts_it(board):
    sketches = [sketch_of(shipped.MACHINES[name]) for name in (*DAILY, "front_loader", "jansen")]
    for sketch, told in zip(
        sketches,
        board("return given.map((each) => solver.mobility(writers.opened(each).drawing));", [*map(text_of, sketches)]),
        strict=True,
    ):
        counted = mobility(sketch.to_class().plan)
        assert (told["freedom"], told["loose"], told["blocked"]) == (counted.rank, [], False), (sketch.name, counted, told)


def test_what_is_loose_redundant_or_blocked_is_told(board):
    found = board(
        f"{FOUR_BAR}"
        """
      const braced = model.link(model.addPoint(d, "Z", 0.2, 0.3), ["O", "C"]);
      const free = model.remove(d, "drives", "phi"), open = model.remove(d, "links", "link_B_C");
      return [free, open, model.fix(d, "B"), model.cylinder(d, "O", "B"), braced].map(solver.mobility);
    """
    )
    free, open_chain, truss, two, braced = found
    assert (free["freedom"], free["loose"]) == (1, ["A", "B", "T"]) and "no drive" in free["words"]
    assert (open_chain["freedom"], open_chain["loose"]) == (2, ["B", "T"]) and open_chain["words"].startswith("loose: B, T")
    assert truss["freedom"] == 0 and "does not move" in truss["words"]
    assert two["blocked"] and two["words"].startswith("its drives are in each other's way: 2")
    assert braced["freedom"] == 1 and braced["redundant"] == 0 and not braced["loose"]


# -- the drawing -------------------------------------------------------------------------------------------


def test_operations_leave_the_drawing_before_as_it_was(board):
    found = board(
        f"{FOUR_BAR}"
        """
      const before = JSON.stringify(d), ops = [
        model.addPoint(d, "Z", 1, 1), model.movePoint(d, "B", 0.2, 0.1), model.rename(d, "points", "B", "K"),
        model.remove(d, "points", "B"), model.remove(d, "links", "link_B_C"), model.fix(d, "C", false), model.slide(d, "T", 0.3),
        model.slide(model.addPoint(d, "Z", 0.1, 0.1), "Z", ["A", "B"]), model.cylinder(d, "O", "T", { bore: 0.05, rod: 0.03 }),
        model.weight(d, "T", 5), model.duplicate(d, ["O", "A", "B", "C", "T"], 1, 0), model.set(d, "drives", "phi", { end: 1 }),
        model.rename(d, "drives", "phi", "crank"),
      ];
      const faults = ["A", "class", "1a", "_x", "", "Crank", "AB", "ABT", "K"].map((each) => model.nameFault(d, each));
      return { same: JSON.stringify(d) === before, wrong: ops.map(model.check), ops, freed: model.freeName(d), faults };
    """
    )
    assert found["same"] and found["wrong"] == [[]] * 13
    renamed, removed, twin = (found["ops"][k] for k in (2, 3, 10))
    assert [*renamed["points"]] == ["O", "A", "K", "C", "T"] and renamed["links"]["link_A_K_T"] == ["A", "K", "T"]
    assert removed["links"] == {"link_A_B_T": ["A", "T"], "link_O_A": ["O", "A"]} and removed["drives"]
    assert {*twin["drives"]} == {"phi", "phi_2"} and len(twin["points"]) == 10 and len(twin["links"]) == 6
    x, y = found["ops"][7]["points"]["Z"]
    assert abs((x - 0.04) * 0.095 - (y - 0.015) * 0.11) < 1e-15  # a point that slides is put onto its line
    assert found["freed"] == "D" and [bool(each) for each in found["faults"]] == [True] * 8 + [False]


def test_a_cylinder_with_a_bore_keeps_its_closed_length(board):
    plain, sized = board(
        f"""{LOADER} const plain = model.set(d, "drives", "lift", {{ bore: null, rod: null }});
        const moved = (each) => model.movePoint(each, "L", 1.25, 1.6);
        return [plain, d].map((each) => [each, moved(each)].map((one) => model.closedLength(one, "lift")));"""
    )
    assert plain[0] == pytest.approx(1.1) and plain[1] > 1.15 and sized == pytest.approx([1.1, 1.1], abs=1e-14)


def test_what_slides_stays_on_its_line_when_points_are_moved(board):
    found = board("""
      let d = started("Shaper", { O: [0, 0], A: [0.03, 0.01], P: [0, -0.1], Q: [0.06, 0.12] }, "OP", ["OA", "PQ"]);
      d = model.slide(d, "A", ["P", "Q"]);
      return [d, model.movePoint(d, "Q", 0.1, 0.1), model.movePoint(d, "A", 0.06, 0.05)];
    """)
    for drawing in found:
        (px, py), (qx, qy), (x, y) = (drawing["points"][name] for name in "PQA")
        assert abs((qx - px) * (y - py) - (qy - py) * (x - px)) < 1e-16
    assert found[1]["points"]["Q"] == [0.1, 0.1] and dist(found[2]["points"]["A"], (0.06, 0.05)) < 0.05


def test_thirty_points_are_judged_and_moved_live(board):
    found = board("""
      const places = { K: [0.2, -0.3] }, links = [], count = 10;
      for (let i = 0; i <= count; i++) { places[`L${i}`] = [0, 0.5 * i]; places[`R${i}`] = [1, 0.5 * i]; }
      for (let i = 0; i < count; i++) {
        places[`M${i}`] = [0.5, 0.5 * i + 0.25];
        links.push([`L${i}`, `M${i}`, `R${i + 1}`], [`R${i}`, `M${i}`, `L${i + 1}`]);
      }
      let d = started("Lift", places, ["L0", "K"], links);
      d = model.cylinder(model.slide(d, "R0", 0), "K", "M0", { stroke: 0.2 });
      const begin = performance.now(), mobility = solver.mobility(d), judged = performance.now() - begin, sweep = solver.sweep(d, "S", 11);
      return { points: Object.keys(d.points).length, mobility, judged, poses: sweep.poses, dragged: solver.drag(d, "L10", [0, 5.2]) };
    """)
    assert found["points"] > 30 and found["mobility"]["freedom"] == 1 and found["judged"] < 1000
    for pose in (*found["poses"], found["dragged"]["points"]):
        assert pose["L10"][0] == pytest.approx(0, abs=1e-9) and pose["L10"][1] == pytest.approx(10 * pose["L1"][1], rel=1e-9)
    assert found["dragged"]["points"]["L10"][1] == pytest.approx(5.2, abs=1e-6)


RAM = {"kind": "cylinder", "ends": ["A", "B"], "start": 0, "end": 1, "drawn": 0}
DAMAGED = [
    {"board": 2}, {"name": "import os"}, {"name": None}, {"points": []}, {"points": {"__proto__": [0, 0]}},
    {"points": {"Crank": [0, 0]}}, {"slides": {"s": None}}, {"links": {"a": ["A"] * 30}},
    {"points": {"A": [0, "x"]}}, {"points": {"A": [0]}}, {"points": {"A": None}}, {"fixed": ["toString"]}, {"fixed": [{}]}, {"fixed": "A"},
    {"links": {"a": ["A"]}}, {"links": {"a b": ["A", "B"]}}, {"links": {"a": ["A", "valueOf"]}}, {"links": {"a": 3}},
    *({"slides": {"s": {"point": "A", "along": along}}} for along in (["A"], "up", ["A", "B"], None)),
    {"drives": {"S": RAM | {"kind": "crank", "bore": 0.1, "rod": 0.05}}},
    *({"drives": {"S": RAM | each}} for each in ({"kind": "rope"}, {"ends": ["A", "A"]}, {"end": None}, {"bore": 0.1, "rod": 0.2})),
    {"weights": {"w": {"point": "constructor", "mass": 1}}}, {"weights": {"w": {"point": "A", "mass": -1}}}, {"notes": [1]},
]  # fmt: skip
"""What is wrong in a drawing that is good otherwise."""
GOOD = {"board": 1, "name": "M", "points": {"A": [0, 0], "B": [1, 0]}, "fixed": ["A"], "links": {"arm": ["A", "B"]}}
BAD = ["[]", "null", "1", '"text"', "{", *(json.dumps(GOOD | each) for each in DAMAGED), json.dumps(GOOD).replace("1, 0", "1e999, 0")]


def test_what_is_damaged_is_refused_in_words_here_and_in_python(board, tmp_path):
    for text, told in zip(BAD, board("return given.map((each) => writers.opened(each));", BAD), strict=True):
        assert told["drawing"] is None and told["wrong"] and all(len(each) < 200 for each in told["wrong"]), text
        with pytest.raises(LinkageError):
            read_text(text, tmp_path).to_class()
    assert all(each["drawing"] is None for each in board('return ["board:1.", "board:1.%%%", "x#board:1.eyJi"].map(writers.opened);'))
    pick, good = random.Random(1), text_of(drawn_at_random(3))
    names = [f"P{number}" for number in range(60)]
    large = GOOD | {"points": {name: [n, n * n] for n, name in enumerate(names)}, "links": {f"k{n}": names[n : n + 26] for n in range(30)}}
    assert "more than 600 points" in board("return writers.opened(given).wrong.join();", json.dumps(large))
    torn = [
        "".join(pick.choice([each, each, each, pick.choice('"{}[]:,0-eé\\')]) if pick.random() < 0.05 else each for each in good)
        for _ in range(150)
    ]
    for text, told in zip(torn, board("return given.map((each) => writers.opened(each).wrong.length);", torn), strict=True):
        try:
            read_text(text, tmp_path)
        except LinkageError:
            continue
        assert told == 0 or "points" in text, text


def test_notes_write_no_lines_of_code(board, tmp_path):
    text = board(f'{FOUR_BAR} d.notes = ["fine\\n    import os\\u2028x"]; return writers.file(d);')
    for python in (read_text(text, tmp_path).to_python(), board("return writers.python(writers.opened(given).drawing);", text)):
        assert "    # fine     import os x\n" in python


def test_the_board_file_and_its_address_go_through_the_command(board, tmp_path, capsys):
    text, address = board(f"{LOADER} return [writers.file(d), writers.address(d)];")
    place = tmp_path / "loader.json"
    sketch = read_text(text, tmp_path, place.name)
    assert is_foreign(str(place)) and is_foreign(address) and read_sketch(address) == sketch == read_sketch(f"file:///board.html#{address}")
    assert main(["import", str(place), "-o", str(tmp_path / "loader.py")]) == 0
    assert (tmp_path / "loader.py").read_text(encoding="utf-8") == sketch.to_python()
    pump, at = board(f"{SLIDER_CRANK} return [writers.file(d), writers.address(d)];")
    read_text(pump, tmp_path, "pump.json")
    assert main(["show", str(tmp_path / "pump.json")]) == 0 and main(["draw", at, "-o", str(tmp_path / "pump.svg")]) == 0
    assert main(["import", str(tmp_path / "loader.json"), "-o", str(tmp_path / "again.json")]) == 0
    assert read_sketch(tmp_path / "again.json") == sketch
    capsys.readouterr()
    driven = read_sketch(place, cylinders=[("K", "L")])
    assert [*driven.drives] == ["S"] and driven.weights == sketch.weights and driven.points == sketch.points
    hung = replace(sketch, points={**sketch.points, "Z": (0.0, 3.0)}, weights={"bob": SketchWeight("Z", 1.0)}, notes=("As measured.",))
    given = read_text(board_json(replace(hung, lengths={"OL": 1.2, "KL": 1.1})), tmp_path)
    again = read_sketch(tmp_path / "board.json", cylinders=[("K", "L")])
    assert again.weights == given.weights and again.notes[0] == "As measured." and again.lengths == {"OL": 1.2}
    assert again.drives["S"].drawn == 0.0 and again.length("K", "L") > 1.1
    assert main(["import", str(place), "-o", str(tmp_path / "loader.csv")]) == 0
    assert "no word for weights, bores and rods" in capsys.readouterr().err
    with pytest.raises(DefinitionError, match="in metres"):
        read_sketch(place, scale=2.0)
    for damaged in ("board:1.abcde", "board:1.", address[:-40], "board:1._w", "board:1.é"):
        with pytest.raises(FileError, match="the address is damaged; copy it whole"):
            read_sketch(damaged)
