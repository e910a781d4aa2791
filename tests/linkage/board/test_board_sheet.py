"""The drawing board in headless Chromium: machines drawn from nothing by pointer and by keyboard, moved, undone, kept and opened."""

import json
import re
import tomllib
from itertools import combinations
from math import dist
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import DefinitionError, deg, drawing_board
from linkage.cli import main
from linkage.files import load
from linkage.sketch import MachineSketch
from tests.for_all import first_daily
from tests.linkage.pictures.test_page import PHONE, Shown, data_of
from tests.members import unpacked

SWEPT = """() => {
    const drawing = hydrolinkage.current();
    return Object.keys(drawing.drives).map((name) => [name, hydrolinkage.solver.sweep(drawing, name, 25)]);
}"""
"""Every drive over its stroke."""
NAMELESS = """() => [...document.querySelectorAll("button, input, select, textarea")]
    .filter((each) => !each.hidden && !each.textContent.trim() && !each.ariaLabel && !each.closest("label")?.textContent.trim())
    .map((each) => each.outerHTML)"""
"""What a reader of screens has no word for."""


@pytest.fixture(scope="module")
def empty(tmp_path_factory):
    """Return an empty board."""
    return drawing_board(None, tmp_path_factory.mktemp("board") / "board.html")


class Board(Shown):
    """A board in a browser, its sheet by places in mm."""

    def __exit__(self, *error):
        self("localStorage.clear()")
        super().__exit__(*error)

    def again(self):
        """Load the page anew, as a tab that was closed does."""
        self.tab.reload()
        self.tab.wait_for_selector("#live", state="attached")
        self.until("window.hydrolinkage !== undefined")

    @property
    def drawing(self):
        return self("hydrolinkage.current()")

    def spot(self, x, y):
        box = self.tab.locator("#mechanism").bounding_box()
        left, top = self("([x, y]) => hydrolinkage.px(x, y)", [x / 1e3, y / 1e3])
        return box["x"] + left, box["y"] + top

    def use(self, tool, *places):
        """Choose a tool and press places on the sheet [mm], or points by name."""
        self.tab.locator(f"button[data-tool={tool}]").click()
        self.press(*places)

    def press(self, *places):
        for each in places:
            self.tab.mouse.click(*self.spot(*self.place(each)))

    def place(self, each):
        return [1e3 * part for part in self(f"hydrolinkage.state().places[{each!r}]")] if isinstance(each, str) else each

    def drag(self, begin, end):
        x, y = self.spot(*self.place(begin))
        self.tab.mouse.move(x, y)
        self.tab.mouse.down()
        u, v = self.spot(*end)
        for share in (0.25, 0.5, 0.75, 1.0):
            self.tab.mouse.move(x + share * (u - x), y + share * (v - y))
        self.tab.mouse.up()

    def keys(self, *keys):
        for each in keys:
            self.tab.keyboard.press(each)

    def field(self, label, text):
        self.tab.locator("#fields").get_by_label(label, exact=True).fill(text)
        self.tab.keyboard.press("Enter")

    @property
    def lengths(self):
        """The lengths of all links and their plates' sides, at the pose that is shown."""
        drawing = self.drawing
        at = drawing["points"]
        return {(P, Q): dist(at[P], at[Q]) for points in drawing["links"].values() for P, Q in combinations(points, 2)}

    def choose(self, name):
        self.tab.locator("#parts").get_by_role("button", name=name, exact=True).click()


def four_bar(board):
    """Draw a four-bar by the pointer alone."""
    board.use("crank", (0, 0), (100, 60))
    board.use("bar", (100, 60), (400, 300))
    board.use("bar", (400, 300), (520, 0))
    board.use("fix", (520, 0))


def front_loader(board):
    """Draw a front loader with two cylinders by the pointer alone."""
    board.use("plate", (0, 600), (400, 300), (800, 200), (0, 600))
    board.use("plate", (800, 200), (900, 400), (1040, 100), (800, 200))
    board.use("fix", (0, 600))
    board.use("cylinder", (100, 0), (400, 300))
    board.use("fix", (100, 0))
    board.use("cylinder", (200, 580), (900, 400))
    board.use("fix", (200, 580))


def slider_crank(board):
    """Draw a slider-crank by the pointer alone."""
    board.use("crank", (0, 0), (60, 60))
    board.use("bar", (60, 60), (360, 0))
    board.use("slide", (360, 0), (360, 0))


def by_keys(board):
    """Draw the four-bar by the keyboard alone."""
    board.tab.locator("#mechanism").focus()

    def to(x, y):
        board.keys("ArrowUp")
        here, step = board("hydrolinkage.state().cursor"), board("hydrolinkage.gridStep()")
        for steps, keys in ((x / 1e3 - here[0], ("ArrowRight", "ArrowLeft")), (y / 1e3 - here[1], ("ArrowUp", "ArrowDown"))):
            tens, ones = divmod(round(abs(steps) / step), 10)
            key = keys[steps < 0]
            board.keys(*[f"Shift+{key}"] * tens, *[key] * ones)

    board.keys("c")
    for place in ((0, 0), (100, 60)):
        to(*place)
        board.keys("Enter")
    for ends in (((100, 60), (400, 300)), ((400, 300), (520, 0))):
        board.keys("b")
        for place in ends:
            to(*place)
            board.keys("Enter")
    board.keys("f", "Enter")


def shape(drawing):
    """Return how a drawing is joined, whatever its parts are called, and where its points stand [mm]."""
    at = {name: tuple(round(1e3 * each) for each in place) for name, place in drawing["points"].items()}
    return (
        {*at.values()},
        {at[name] for name in drawing["fixed"]},
        {frozenset(at[name] for name in points) for points in drawing["links"].values()},
        {(each["kind"], *(at[name] for name in each["ends"])) for each in drawing["drives"].values()},
    )


FOUR_BAR = (
    {(0, 0), (100, 60), (400, 300), (520, 0)},
    {(0, 0), (520, 0)},
    {frozenset(ends) for ends in (((0, 0), (100, 60)), ((100, 60), (400, 300)), ((400, 300), (520, 0)))},
    {("crank", (0, 0), (100, 60))},
)


def test_the_page_is_one_small_file_without_addresses(empty):
    text = empty.read_text(encoding="utf-8")
    assert len(text.encode()) <= 120_000
    assert set(re.findall(r"https?://[^\"'`\s]+", text + unpacked(text, "program"))) == {"http://www.w3.org/2000/svg"}
    assert "default-src 'none'" in text and len(re.findall(r"'sha256-[^']+'", text)) == 3
    assert data_of(text)["sizes"]["strokes"][:2] == [0.025, 0.04]


TABLE = "kind,name,x [mm],y [mm],what\npoint,O,0,0,fixed\npoint,A,100,50,pin\npoint,B,300,0,pin\nlink,arm,,,O A\nlink,rod,,,A B\n"


def test_the_command_opens_what_other_commands_read(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "table.csv").write_text(TABLE, encoding="utf-8")  # nothing drives it yet: that is drawn on the board
    assert main(["import", "table.csv", "-o", "table.json", "--drive", "O", "A"]) == 2  # B is loose
    written = {"four_bar": "OACBP", "table.csv": "OAB"}
    for given, points in written.items():
        assert main(["board", given]) == 0
        assert {*data_of(Path("board.html").read_text(encoding="utf-8"))["drawing"]["points"]} == {*points}
    assert main(["board"]) == 0
    assert data_of(Path("board.html").read_text(encoding="utf-8"))["drawing"] is None
    assert main(["board", "excavator"]) == 2 and "it has parts" in capsys.readouterr().err
    assert main(["board", "-o", "board.txt"]) == 2 and "ends in .html" in capsys.readouterr().err
    (tmp_path / "page.html").symlink_to("table.csv")
    assert main(["board", "table.csv", "-o", "page.html"]) == 2 and "is the file that is opened" in capsys.readouterr().err
    for wrong in (3, None, b"board.html", "board"):
        with pytest.raises(DefinitionError, match="is no name of a page; give one that ends in"):
            drawing_board(None, wrong)
    assert main(["board", "four_ba"]) == 2 and "four_bar" in capsys.readouterr().err


def test_a_four_bar_by_pointer_and_by_keys_is_the_same(chromium, empty):
    for draw in (four_bar, by_keys):
        with Board(chromium, empty) as board:
            draw(board)
            assert shape(board.drawing) == FOUR_BAR, draw.__name__
            assert board.text("#live").startswith("Mobility 1, drives: 1"), draw.__name__
            assert board.said == [], draw.__name__
            assert [each for each in board.asked if not each.startswith("file:")] == [], draw.__name__


@first_daily(1, "draw", [front_loader, four_bar, slider_crank], ids=lambda draw: draw.__name__)
def test_what_is_exported_moves_in_python_as_on_the_board(chromium, empty, draw, tmp_path):
    with Board(chromium, empty) as board:
        draw(board)
        poses = board(SWEPT)
        space = {}
        exec(board.tab.locator("#text").input_value(), space)
        machine = space["Machine"]()
        for name, sweep in poses:
            reached = [(value, at) for value, at in zip(sweep["values"], sweep["poses"], strict=True) if at][:-1]
            assert len(reached) > 10, name
            motion = machine.at(**{name: [value for value, _ in reached]}, **{each: 0.0 for each, _ in poses if each != name})
            for point in machine.plan.points:
                assert_allclose(motion[point].T, [at[point] for _, at in reached], atol=1e-9)
        board.tab.locator("[data-form=toml]").click()
        file = tmp_path / "machine.toml"
        file.write_text(board.tab.locator("#text").input_value(), encoding="utf-8")
        assert [*load(file)().plan.points] == [*machine.plan.points]
        board.tab.locator("[data-form=link]").click()
        address, before = board.tab.locator("#text").input_value(), board.drawing
        board.tab.locator("#fresh").click()
        assert board.drawing["points"] == {}
        board.tab.locator("#text-in").fill(address)
        board.tab.locator("#take").click()
        assert board.drawing == before and board.said == []


def test_undo_leads_to_the_empty_sheet_and_back(chromium, empty):
    with Board(chromium, empty) as board:
        front_loader(board)
        full, count = board.drawing, 0
        while board.tab.locator("#undo").is_enabled():
            board.keys("Control+z")
            count += 1
        assert board.drawing["points"] == {} and board.drawing["drives"] == {} and count > 10
        for _ in range(count):
            board.keys("Control+Shift+Z")
        assert board.drawing == full and board.tab.locator("#redo").is_disabled() and board.said == []


@pytest.mark.slow
def test_a_task_is_read_by_the_synthesis_and_undone(chromium, empty, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with Board(chromium, empty) as board:
        four_bar(board)
        board.use("plate", "B", "C", (200, 400), "B")
        board.choose("link_B_C")
        board.tab.locator("#fields").get_by_role("button", name="Delete").click()
        board.tab.locator("[data-form=task]").click()
        assert board.tab.locator("#text").input_value() == "Press the pin whose path is a task."
        board.use("path", "E")
        board.use("target", "E", (200, 460), (140, 460), (80, 380))
        text = board.tab.locator("#text").input_value()
        task = tomllib.loads(text)["synthesis"]
        assert task["path"] == {"of": "E", "points": [[0.2, 0.46], [0.14, 0.46], [0.08, 0.38]]}
        assert {"AB", "BC", "BE", "CBE"} <= {*task["vary"]}
        board.tab.locator("[data-form=toml]").click()
        (tmp_path / "machine.toml").write_text(board.tab.locator("#text").input_value(), encoding="utf-8")
        (tmp_path / "machine_task.toml").write_text(text.replace("starts = 8", "starts = 1\nlimit = 100"), encoding="utf-8")
        assert main(["synthesise", "machine_task.toml"]) == 0
        for left in (2, 1):
            board.keys("Control+z")
            assert len(board("hydrolinkage.state().targets.places")) == left
        board.keys("Control+z", "Control+z")
        assert board("hydrolinkage.state().targets") is None and board("hydrolinkage.state().trails") == {} and board.said == []


@pytest.mark.slow
def test_a_pin_slides_on_a_link_that_turns_about_a_fixed_pin(chromium, empty):
    with Board(chromium, empty) as board:
        board.use("crank", (0, 300), (100, 300))
        board.use("bar", (0, 0), (200, 600))
        board.use("fix", (0, 0))
        board.use("slide", (100, 300), (0, 0), (200, 600))
        assert [*board.drawing["slides"].values()] == [{"point": "B", "along": ["C", "D"]}]
        assert board.text("#live").startswith("Mobility 1, drives: 1")
        board.tab.locator("[data-drive=phi][type=text]").fill("200")
        board.keys("Enter")
        at = board("hydrolinkage.state().places")
        (x, y), (u, v) = ([b - a for a, b in zip(at["C"], at[name], strict=True)] for name in "BD")
        assert abs(x * v - y * u) < 1e-9 and abs(at["B"][0] - 0.1 * np.cos(200 * deg)) < 1e-9 and board.said == []


@pytest.mark.slow
def test_two_fingers_see_closer_and_one_leads(chromium, empty):
    with Board(
        chromium, empty, PHONE, has_touch=True, is_mobile=True, viewport=dict(zip(("width", "height"), PHONE, strict=True))
    ) as board:
        slider_crank(board)
        wide = "hydrolinkage.px(1, 0)[0] - hydrolinkage.px(0, 0)[0]"
        before, points = board(wide), board.drawing["points"]
        touch = board.tab.context.new_cdp_session(board.tab)

        def send(kind, *spots):
            fingers = [{"x": x, "y": y, "id": k} for k, (x, y) in enumerate(spots)]
            touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": fingers})

        send("touchStart", (130, 400), (170, 400))
        send("touchMove", (110, 400), (190, 400))
        send("touchEnd")
        assert_allclose(board(wide), 2.0 * before)
        assert board.drawing["points"] == points
        board.tab.locator("#whole").click()
        board.tab.locator("button[data-tool=move]").click()
        x, y = board.spot(*board.place("B"))
        send("touchStart", (x, y))
        for k in range(1, 6):
            send("touchMove", (x - 6 * k, y))
        send("touchEnd")
        assert board.drawing["points"]["B"][0] < points["B"][0] - 0.01
        assert_allclose(board.drawing["points"]["C"][1], points["C"][1], atol=1e-9)
        before, (x, y) = board.drawing, board.spot(*board.place("A"))
        send("touchStart", (x, y))
        send("touchMove", (x, y - 40))
        assert board.drawing["points"]["A"][1] > before["points"]["A"][1] + 0.01
        send("touchStart", (x, y - 40), (x + 60, y))
        send("touchEnd")
        assert board.drawing == before
        assert board.said == []


@pytest.mark.slow
def test_what_the_board_cannot_hold_is_told_where_it_is_delivered(chromium, tmp_path):
    large = MachineSketch("Large", {f"P{n}": (0.1 * n, 1.0) for n in range(201)}, ("P0",), {})
    with Board(chromium, drawing_board(large, tmp_path / "large.html")) as board:
        assert "a drawing has a table points with at most 200 entries" in board.text("#message") and board.said == []


@pytest.mark.slow
def test_a_reload_keeps_the_work(chromium, empty):
    with Board(chromium, empty) as board:
        slider_crank(board)
        board.tab.locator("#units").select_option("in")
        before = board.drawing
        board.again()
        assert board.drawing == before and board.text("#live").startswith("Mobility 1, drives: 1")
        assert board.tab.locator("#units").input_value() == "in"
        linked = {"board": 1, "name": "Linked", "points": {"A": [0, 0]}}
        board("(given) => { location.hash = hydrolinkage.writers.address(given); }", linked)
        board.until("hydrolinkage.current().name === 'Linked'")
        board.use("pin", (10, 5))
        board.again()
        assert board.drawing["name"] == "Linked" and len(board.drawing["points"]) == 2
        board("(given) => { history.replaceState(null, '', `#${hydrolinkage.writers.address(given)}`); }", linked | {"name": "Second"})
        board.again()
        assert board.drawing["name"] == "Second"
        board.keys("Control+z")
        assert board.drawing["name"] == "Linked" and board.said == []
        for damage in ("{", "[]", '{"drawing":{"board":1,"name":"X","points":{"A":[0,"x"]}},"delivered":"null"}'):
            board("(text) => localStorage.setItem(Object.keys(localStorage)[0], text)", damage)
            board.again()
            assert board.drawing["points"] == {} and board.said == [], damage


@pytest.mark.slow
def test_what_is_led_moves_and_no_link_is_stretched(chromium, empty):
    with Board(chromium, empty) as board:
        four_bar(board)
        board.tab.locator("button[data-tool=move]").click()
        before, drawn = board.lengths, board.drawing["points"]
        board.drag("B", (-300, 500))
        assert board.drawing["points"]["B"] != drawn["B"]
        assert_allclose([*board.lengths.values()], [*before.values()], rtol=1e-9)
        board.drag("C", (2000, 1500))
        assert "short" in board.text("#message") or "long" in board.text("#message")
        assert "mm" in board.text("#message")
        assert_allclose([*board.lengths.values()], [*before.values()], rtol=1e-9)
        board.tab.keyboard.down("Shift")
        board.drag("B", (60, 100))
        board.tab.keyboard.up("Shift")
        assert board.drawing["points"]["B"] == [0.06, 0.1]
        assert board.said == []


@pytest.mark.slow
def test_no_name_is_marked_as_text_while_a_pin_is_led(chromium, empty):
    with Board(chromium, empty) as board:
        four_bar(board)
        board.tab.locator("button[data-tool=move]").click()
        corner, (x, y) = board.tab.locator("#mechanism").bounding_box(), board.spot(*board.place("B"))
        board.tab.mouse.move(x, y)
        board.tab.mouse.down()
        marked = []
        for goal in ((x + 60, y - 100), (x, corner["y"] + 5), (corner["x"] + 5, corner["y"] + 5)):
            board.tab.mouse.move(*goal, steps=4)
            marked.append(board("getSelection().toString()"))
        board.tab.mouse.up()
        assert marked == [""] * 3


def test_numbers_are_typed_with_units(chromium, empty):
    with Board(chromium, empty) as board:
        four_bar(board)
        before = board.lengths
        board.choose("link_B_C")
        board.field("BC", "40 cm")
        assert_allclose([*board.lengths.values()], [0.4 if pair == ("B", "C") else each for pair, each in before.items()], rtol=1e-9)
        board.choose("link_A_B")
        board.field("AB", "5 in")
        assert_allclose(dist(*(board.drawing["points"][name] for name in "AB")), 0.127, rtol=1e-9)
        for text in ("three", "5 5", "1 deg", "5 constructor"):
            board.field("AB", text)
            assert f"{text} is no AB" in board.text("#message")
        board.choose("phi")
        for text, end in (("90", 90), ("1.5 rad", 1.5 / deg), ("\u2212120\u00b0", -120), ("1 080 deg", 1080)):
            board.field("to", text)
            assert_allclose(board.drawing["drives"]["phi"]["end"], end * deg, rtol=1e-12)
        board.choose("D")
        board.field("x", "0.5 m")
        assert board.drawing["points"]["D"][0] == 0.5
        board.field("Name", "Pivot")
        assert "Pivot" in board.drawing["fixed"]
        board.field("Name", "class")
        assert "class is no name" in board.text("#message") and "Pivot" in board.drawing["points"]
        board.use("cylinder", "B", (-200, -300))
        board.field("Bore", "63")
        board.field("Closed length", "250")
        board.field("Stroke", "0.2 m")
        drive = board.drawing["drives"]["S"]
        assert (drive["bore"], drive["end"] - drive["start"]) == (0.063, 0.2) and 0 < drive["rod"] < 0.063
        points = board.drawing["points"]
        span = dist(*(points[name] for name in drive["ends"]))
        assert_allclose(span - drive["drawn"], 0.25)
        for out, said in ((-50, "50 mm shorter than closed"), (300, "100 mm longer than its stroke goes"), (100, "100 mm out")):
            board.field("Closed length", f"{1000 * span - out!r}")
            assert f"drawn {said}" in board.text("#fields").replace("\u2009", " ")
        board.keys("Delete")  # in a field it is of the text
        board.tab.locator("#fields").get_by_role("button", name="Delete").click()
        assert [*board.drawing["drives"]] == ["phi"] and board.said == []


def test_what_cannot_be_is_said_and_nothing_is_bent(chromium, empty):
    with Board(chromium, empty) as board:
        board.use("bar", (0, 0), (300, 0))
        board.use("bar", (300, 0), (100, 200))
        board.use("bar", (100, 200), (0, 0))
        board.use("fix", (0, 0), (300, 0))
        assert board.text("#live").startswith("Mobility 0, drives: 0")
        before = board.drawing["points"]
        board.tab.locator("button[data-tool=move]").click()
        board.drag("C", (250, 400))
        assert "link_C_A is" in board.text("#message") and "mm too short" in board.text("#message")
        board.choose("link_A_B")
        for text, said in (("250 mm", "are fixed"), ("-5", "is no AB"), ("", "is no AB")):
            board.field("AB", text)
            assert said in board.text("#message"), text
        board.choose("link_B_C")
        board.field("BC", "1 m")
        assert "too short" in board.text("#message")
        for name, place in board.drawing["points"].items():
            assert_allclose(place, before[name], atol=1e-12)
        board.tab.locator("#fresh").click()
        board.use("crank", (0, 0), (100, 0))
        board.use("bar", (100, 0), (300, 0))
        board.use("bar", (300, 0), (500, 0))
        board.use("fix", (500, 0))
        assert "singular" in board.text("#live") and board.said == []


def bucket(board):
    """Draw a bucket on a stick with two cylinders, its plates ended by Enter, by the pointer otherwise."""
    for _ in range(3):
        board.tab.locator("#farther").click()
    board.use("plate", (0, 600), (-200, 700), (200, 700), (700, 500), (800, 300))
    board.keys("Enter")
    board.use("fix", (0, 600))
    board.use("cylinder", (-400, 100), (-200, 700))
    board.use("fix", (-400, 100))
    board.use("bar", "D", (900, 500))
    board.use("cylinder", "C", "G")
    board.use("plate", "E", (1100, 300), (1000, 0))
    board.keys("Enter")
    board.use("bar", "G", "H")


@pytest.mark.slow
def test_a_plate_that_is_pressed_ends_with_enter(chromium, empty):
    with Board(chromium, empty) as board:
        bucket(board)
        assert [len(points) for points in board.drawing["links"].values()] == [5, 2, 3, 2] and board.said == []
        assert board.text("#live").startswith("Mobility 2, drives: 2") and "loose" not in board.text("#live")
        board.use("plate", (0, 0), (100, 0))
        board.keys("Enter")  # two corners are no plate yet
        assert len(board.drawing["links"]) == 4 and board("hydrolinkage.state().pending") == ["J", "K"] and board.said == []


@pytest.mark.slow
def test_beyond_all_reach_no_drive_is_blamed_for_a_hair(chromium, empty):
    with Board(chromium, empty) as board:
        bucket(board)
        before, drives, blamed = board.lengths, board.drawing["drives"], set()
        for goal in ([5, 3], [-5, 0], [0.2, -3], [0.6, 0.05], [1.5, 2]):
            answer = board("(goal) => hydrolinkage.solver.drag(hydrolinkage.current(), 'I', goal)", goal)
            assert dist(answer["points"]["I"], goal) > 0.1, goal
            for (P, Q), length in before.items():
                assert_allclose(dist(answer["points"][P], answer["points"][Q]), length, rtol=1e-9)
            for name, value in answer["strokes"].items():
                assert drives[name]["start"] - 1e-9 <= value <= drives[name]["end"] + 1e-9, name
            short = answer["short"]
            blamed.add(short["part"])
            assert abs(short["gap"]) > 0.01, answer["stopped"]
            if short["part"] == "drives":  # one that stands at the end which keeps the pin away
                end = drives[short["name"]]["end" if short["gap"] > 0 else "start"]
                assert_allclose(answer["strokes"][short["name"]], end, atol=1e-9)
        assert blamed == {"links", "drives"}


@pytest.mark.slow
def test_how_far_a_drive_goes_is_its_dead_point(chromium, empty):
    with Board(chromium, empty) as board:
        board.use("bar", (0, 0), (300, 0))
        board.use("cylinder", (0, -200), (300, 0))
        board.use("fix", (0, 0), (0, -200))
        board.field("Name", "P")
        board.choose("S")
        board.field("Stroke", "900")
        board.rest(400)
        assert f"S goes from 0 mm to {500 - np.hypot(300, 200):.1f} mm" in board.text("#live").replace("\u2009", " ")


@pytest.mark.slow
def test_what_could_not_be_opened_again_is_not_drawn(chromium, empty):
    points = {f"P{i}": [0.05 * (i % 20), 0.05 * (i // 20)] for i in range(200)}
    with Board(chromium, empty) as board:
        board.tab.locator("#text-in").fill(json.dumps({"board": 1, "name": "Many", "points": points}))
        board.tab.locator("#take").click()
        for tool, place in (("pin", (525, 475)), ("bar", (525, 475)), ("fix", (525, 475))):
            board.use(tool, place)
            assert "at most 200 entries" in board.text("#message") and len(board.drawing["points"]) == 200, tool
        board.use("move", "P7")
        board.tab.locator("#fields").get_by_role("button", name="Duplicate").click()
        board.choose("P7")
        board.field("x", "far")
        assert "far is no x" in board.text("#message")
        board.field("x", "340 mm")
        assert "far is no x" not in board.text("#message")
        board.again()
        assert len(board.drawing["points"]) == 200 and board.drawing["points"]["P7"][0] == 0.34 and board.said == []


def test_a_file_that_is_dropped_is_opened_as_one_that_is_chosen(chromium, empty):
    drop = """([text, size]) => {
        const files = new DataTransfer();
        files.items.add(new File([text.padEnd(size)], "dropped.json"));
        document.getElementById("mechanism").dispatchEvent(new DragEvent("drop", { dataTransfer: files, cancelable: true }));
    }"""
    text = json.dumps({"board": 1, "name": "Dropped", "points": {"A": [0, 0]}})
    with Board(chromium, empty) as board:
        for size, said in ((len(text), "Dropped is open"), (1_100_000, "too large for a drawing")):
            for door in ("drop", "choose"):
                board("byId => document.getElementById(byId).textContent = ''", "message")
                if door == "drop":
                    board(drop, [text, size])
                else:
                    board.tab.locator("#file").set_input_files(
                        {"name": "chosen.json", "mimeType": "application/json", "buffer": text.ljust(size).encode()}
                    )
                board.until("document.getElementById('message').textContent !== ''")
                assert said in board.text("#message"), door
        assert board.drawing["name"] == "Dropped" and board.said == []


def test_hostile_texts_are_inert(chromium, empty):
    hostile = "<img src=x onerror=window.struck=1>"
    good = {"board": 1, "name": "M", "points": {"A": [0, 0]}, "notes": [hostile]}
    texts = [
        "", "{", "null", "[]", "1e999", hostile, "javascript:window.struck=1", json.dumps(good | {"name": hostile}),
        json.dumps(good | {"points": {hostile: [0, 0]}}), json.dumps(good | {"points": {"A": [1e300, 0]}}),
        json.dumps(good | {"links": {"x": ["A", hostile]}}), json.dumps(good | {"drives": {"S": {"kind": hostile, "ends": ["A", "A"]}}}),
        '{"board":1,"name":"M","points":{"__proto__":[0,0]},"fixed":[]}', "[" * 100_000,
    ]  # fmt: skip
    with Board(chromium, empty) as board:
        four_bar(board)
        before = board.drawing
        for text in texts:
            board.tab.locator("#text-in").fill(text)
            board.tab.locator("#take").click()
            assert board.drawing == before, text[:80]
            assert board.text("#message"), text[:80]
        board.tab.locator("#text-in").fill(
            json.dumps(good | {"points": {"constructor": [0, 0], "toString": [0.1, 0]}, "links": {"valueOf": ["constructor", "toString"]}})
        )
        board.tab.locator("#take").click()
        board.choose("valueOf")
        board.tab.locator("#fields").get_by_role("button", name="Delete").click()
        assert [*board.drawing["points"]] == ["constructor", "toString"] and board.drawing["links"] == {}
        assert board("window.struck") is None and board.tab.locator("img").count() == 0 and board.said == []
        assert [each for each in board.asked if not each.startswith("file:")] == []


def test_every_tool_has_a_key_and_a_name(chromium, empty):
    with Board(chromium, empty, PHONE) as board:
        tools = board(
            "[...document.querySelectorAll('button[data-tool]')].map((each) => [each.dataset.tool, each.getAttribute('aria-keyshortcuts')])"
        )
        assert len({key for _, key in tools}) == len(tools) >= 10
        board.tab.locator("#mechanism").focus()
        for tool, key in tools:
            board.keys(key.lower())
            assert board.tab.locator(f"button[data-tool={tool}]").get_attribute("aria-pressed") == "true", tool
        board.keys("Escape")
        slider_crank(board)
        assert board(NAMELESS) == []
        assert board("document.documentElement.scrollWidth") <= PHONE[0]
        board.tab.locator("#language").click()
        assert board("document.querySelector('h1').textContent") == "Чертёжная доска" and board.said == []
        wide = "[...document.querySelectorAll('#tools span')].filter((each) => each.scrollWidth > each.parentElement.clientWidth)"
        assert board(f"{wide}.map((each) => each.textContent)") == []
