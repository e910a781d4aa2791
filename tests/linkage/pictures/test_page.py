"""The live page, opened in headless Chromium: what it shows, moves, changes, refuses and remembers, against Python."""

import json
import re
from functools import cache
from itertools import combinations, product
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread
from numpy.testing import assert_allclose, assert_array_equal

from hydraulics import Cylinder, LiftCircuit, reserve, thrust
from linkage import (
    LEFT,
    RIGHT,
    Column,
    Crank,
    Damper,
    DefinitionError,
    Dyad,
    Ground,
    Guide,
    Link,
    LoadCase,
    Mechanism,
    OnGuide,
    OnLink,
    Over,
    Part,
    PinFriction,
    SliderDyad,
    Stroke,
    Target,
    Weight,
    angle,
    deg,
    draw,
    drive_force,
    driving_force,
    page,
    plot,
    standing,
    working_field,
    y,
)
from linkage.board.page import PARTS as BOARD_PARTS
from linkage.cli import main
from linkage.cli.listing import registered
from linkage.cli.machines import design_of_file, find
from linkage.cli.settings import design_from as design_of
from linkage.files import load
from linkage.motion import live_text
from linkage.pictures import page_html
from linkage.pictures.browser import chart_page
from linkage.pictures.chart_text import ChartText
from linkage.pictures.page_data import PageRequests, limit_data, named_in_code, scene_data
from linkage.pictures.page_file import bare, page_part, said_in, tight
from linkage.pictures.shown_values import as_curve, typeset
from linkage.plan.trace import Trace
from linkage.quantities import name_of
from linkage.reports import results
from linkage.reports.live_columns import values_together
from linkage.units import MPa, bar, kgf_cm2, mm, unit_system
from mechanisms.at_work.forwarder import LoadingForwarder
from mechanisms.at_work.one_pump import RegenerativePress
from mechanisms.at_work.telehandler import Telehandler
from mechanisms.classics.stephenson_three import StephensonThree, StephensonThreeFar
from mechanisms.grapple import Grapple
from mechanisms.header_balancer import HeaderBalancer, ThreeHeaders
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch
from tests.for_all import first_daily, for_all
from tests.laws.test_working_field import Digger as LiftingDigger
from tests.laws.test_working_field import Robot
from tests.linkage.statics.test_vehicle import Digger, Truck
from tests.members import unpacked

BOARD = [each for each in BOARD_PARTS if each.startswith("board/") and each.endswith(".js")]
DATA = Path(__file__).parents[1] / "data"
SIZES = ["OB", "OC", "lift.bore", "load.mass"]
LAPTOP, PHONE = (1366, 657), (390, 760)
BLANK = "about:blank"


class FourBar(Mechanism):
    """A four-bar with a carried weight."""

    phi = Stroke(0, 360 * deg)
    O = Ground(0, 0)
    Q = Ground(0.4, 0)
    A = Crank(O, OA=0.12, angle=phi)
    B = Dyad(A, Q, AB=0.38, QB=0.25, side=LEFT)
    C = OnLink(A, B, AC=0.30)
    psi = angle(Q, B)
    load = Weight(C, mass=10)


class Reach(Mechanism):
    """A boom on a turned arm, each with a stroke of its own."""

    alpha, beta = Stroke(10 * deg, 80 * deg), Stroke(-60 * deg, -20 * deg)
    O = Ground(0, 0)
    P = Crank(O, OP=1.2, angle=alpha)
    T = Crank(P, PT=0.9, angle=alpha + beta)
    arm, boom = Link("O P"), Link("P T")


class Digging(Reach):
    """The same, which is said to run along two paths."""

    loading = Over.path(alpha=[0.2, 1.3], beta=[-1.0, -0.4])
    grading = Over.path(alpha=[0.4, 0.7, 0.9], beta=[-0.9, -0.8, -0.5])


class Plain(FourBar):
    """The same without a load, with a table that no program gives."""

    load = None

    def columns(self, motion):
        return [*super().columns(motion), Column("count", np.array([float(len(str(each))) for each in motion["psi"]]), "")]


class Shown:
    """A page in a browser, with what it complained about and what it asked the network for."""

    def __init__(self, browser, file, size=LAPTOP, mark="", **options):
        viewport, idle = dict(zip(("width", "height"), size, strict=True)), []
        if not options:  # a tab takes as long to make as a page to open
            idle = [context.pages[0] for context in browser.contexts if context.pages[0].url == BLANK]
        self.tab = idle[0] if idle else browser.new_context(**{"viewport": viewport, "reduced_motion": "reduce"} | options).new_page()
        self.tab.set_viewport_size(viewport)
        self.said, self.asked, self.is_plain = [], [], not options
        self.tab.set_default_timeout(30_000)
        self.heard = {
            "console": lambda message: self.said.append(message.text),
            "pageerror": lambda error: self.said.append(str(error)),
            "request": lambda request: self.asked.append(request.url),
        }
        for event, hear in self.heard.items():
            self.tab.on(event, hear)
        self.tab.goto(f"{Path(file).as_uri()}{mark}")
        self.until("window.hydrolinkage !== undefined")
        self.settle()

    def until(self, condition):
        """Wait until a condition holds, asked from outside: the policy lets the page evaluate no text while it waits."""
        for _ in range(3000):
            if self.tab.evaluate(condition):
                return
            self.tab.wait_for_timeout(10)
        raise AssertionError(f"still not: {condition}")

    def settle(self):
        """Wait until what was asked for is drawn, and the verdicts with it."""
        self.tab.evaluate("() => new Promise((done) => requestAnimationFrame(() => setTimeout(() => requestAnimationFrame(done), 170)))")

    def rest(self, milliseconds):
        """Wait by the page's own clock, by which what it put off for less has been done, however busy the machine is."""
        self.tab.evaluate("(milliseconds) => new Promise((done) => setTimeout(done, milliseconds))", milliseconds)

    def __call__(self, script, *given):
        return self.tab.evaluate(script, *given)

    @property
    def state(self):
        return self("hydrolinkage.state()")

    def slide(self, selector, share):
        self(
            "([selector, share]) => { const each = document.querySelector(selector); each.value = share;"
            " each.dispatchEvent(new Event('input')); }",
            [selector, share],
        )
        self.settle()

    def find(self, name):
        """Look for another dimension, as a user types it."""
        self.tab.locator("#add").fill(name)
        self.tab.locator("#add").press("Enter")

    def text(self, selector):
        return self.tab.locator(selector).inner_text()

    @property
    def told(self):
        """Its verdicts as they stand on the page, folded or not."""
        return self(
            "[...document.querySelectorAll('#groups li')].map((each) => [each.querySelector('b'), ...each.childNodes]"
            ".filter((one, k) => k ? !one.className?.includes?.('share') && one.tagName !== 'B' : one)"
            ".map((one) => one.textContent).join(''))"
        )

    def __enter__(self):
        return self

    def __exit__(self, *error):
        for event, hear in self.heard.items():
            self.tab.remove_listener(event, hear)
        if not self.is_plain:
            return self.tab.context.close()
        self.tab.mouse.move(0, 0)
        self.tab.goto(BLANK)


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Return a function that writes a machine's page once."""
    folder, made = tmp_path_factory.mktemp("pages"), {}

    def write(machine, **options):
        key = type(machine), repr(machine), repr(sorted(options.items()))
        if key not in made:
            made[key] = page(machine, folder / f"{len(made)}.html", **options)
        return made[key]

    return write


@pytest.fixture(scope="module")
def delivered(tmp_path_factory):
    """Return the page of a design that is not the hitch as it comes."""
    return page(ThreePointHitch(OB=0.31), tmp_path_factory.mktemp("delivered") / "delivered.html")


@pytest.fixture(scope="module")
def chart(tmp_path_factory):
    """Return the page of a load chart."""
    return page(digger_field(), tmp_path_factory.mktemp("chart") / "chart.html")


def data_of(text):
    return json.loads(unpacked(text, "data"))


# -- the file ----------------------------------------------------------------------------------------------


def test_the_hitchs_page_is_one_small_file_that_names_its_scripts_by_their_hashes(written):
    text = written(ThreePointHitch()).read_text(encoding="utf-8")
    assert len(text.encode()) <= 75_000
    assert set(re.findall(r"https?://[^\"'\s]+", text + unpacked(text, "program"))) == {"http://www.w3.org/2000/svg"}
    assert not re.search(r"\b(src|href)=\"(?!data:|#)", text)
    assert not re.search(r"\{\{\w+\}\}", text)
    (policy,) = re.findall(r'Content-Security-Policy" content="([^"]*)"', text)
    assert "default-src 'none'" in policy and "unsafe" not in policy
    assert policy.count("'sha256-") == 3


def test_what_a_user_calls_things_ends_no_element():
    class Sly(FourBar):
        pass

    Sly.plan.title = "</script><b>{{SCRIPT}}&"
    text = page_html(Sly(), at={}, columns=[Column("a</script>b", np.zeros(101)), "psi"], limit={"psi": (1.0, "</style><i>")})
    assert text.count("</script>") == 5 and "</style>" not in text
    assert "<b>" not in text and "<i>" not in text
    assert "<h1>&lt;/script&gt;&lt;b&gt;{{script}}&amp;</h1>" in unpacked(text, "body")
    assert data_of(text)["columns"][0][0] == "a</script>b"


@pytest.mark.slow
def test_the_largest_page_of_a_shipped_machine_is_small(tmp_path):
    assert page(LoadingForwarder(), tmp_path / "forwarder.html").stat().st_size <= 100_000


def test_a_program_loses_spaces_alone_and_none_that_is_read():
    read = 'const a = (b) => `${b ? `one ${b + 1} of` : ""} them` + " = { a }" - 2 / b, c = text.replace(/ = [/"] /g, " , ") / 2;'
    assert tight(read) == 'const a=(b)=>`${b ? `one ${b + 1} of` : ""} them` + " = { a }" - 2/b,c=text.replace(/ = [/"] /g," , ")/2;'
    for name in ("mechanism.js", "page.js", "verdicts.js", "hands.js", "copy.js", "leave.js", "labels.js", "judge.js", "chart.js", *BOARD):
        assert re.sub(r"\s", "", tight(page_part(name))) == re.sub(r"\s", "", bare(page_part(name))), name


def test_wrong_questions_are_answered_in_words(tmp_path):
    machine, file = FourBar(), tmp_path / "bars.html"
    for options, said in (
        ({"vary": ["OX"]}, r"Dimension 'OX' is unknown in FourBar: vary"),
        ({"vary": "OA"}, r"vary='OA': dimensions are expected"),
        ({"vary": {"OA": (0.2, 0.1)}}, r"the least and the greatest value"),
        ({"vary": {"OA": (-0.1, 0.2)}}, r"a length is above zero"),
        ({"columns": []}, r"a list of columns"),
        ({"columns": ["p"]}, r"Column 'p' is unknown"),
        ({"column": "p"}, r"Column 'p' is unknown"),
        ({"limit": {"p": (1.0, "")}}, r"Column 'p' is unknown in FourBar: limit"),
        ({"language": "de"}, r"Language 'de' is unknown"),
        ({"count": 1}, r"at least 2 poses"),
        ({"trace": ["H"]}, r"Point 'H' is unknown"),
    ):
        with pytest.raises(DefinitionError, match=said):
            page(machine, file, **options)
    with pytest.raises(DefinitionError, match=r"one that ends in \.html"):
        page(machine, tmp_path / "bars.pdf")
    with pytest.raises(DefinitionError, match="2 designs"):
        page(FourBar(OA=[0.12, 0.13]), file)
    assert not file.exists()


@pytest.mark.slow
def test_a_second_page_of_a_machine_traces_nothing_again(tmp_path, monkeypatch):
    machine = MowerLift()
    first = page(machine, tmp_path / "first.html").read_bytes()
    made = []
    monkeypatch.setattr(Trace, "__init__", lambda *given: made.append(given))
    assert page(machine, tmp_path / "second.html").read_bytes() == first
    assert not made


def test_what_a_page_says_is_what_is_translated():
    """A sentence that is no literal where it is said would never be translated: labels alone are, and stand in the text."""
    names = ("mechanism", "page", "verdicts", "hands", "copy", "leave", "task", "chart", "judge")
    script = "".join(page_part(f"{name}.js") for name in names)
    assert set(re.findall(r'\bsay\(([^"][^,)]*)', script)) == {"text", *(f"each.dataset.{kind}" for kind in ("say", "tip", "name"))}
    assert len(said_in(script)) > 50


# -- in the browser ----------------------------------------------------------------------------------------


def test_a_page_opens_in_silence_and_asks_for_nothing_but_itself(chromium, written):
    file = written(ThreePointHitch())
    with Shown(chromium, file) as shown:
        assert shown.said == []
        assert shown.asked == [file.as_uri()]
        verdicts = ThreePointHitch().verdicts()
        count = sum(each.is_rule for each in verdicts)
        assert shown.text("#badge") == f"{count} of {count} verdicts hold"
        assert len(shown.told) == len(verdicts)


@first_daily(0, "machine", [ThreePointHitch(), StephensonThree(), Reach()], ids=lambda each: type(each).__name__)
def test_the_page_says_what_python_says_of_random_designs(chromium, written, machine):
    random = np.random.default_rng(13)
    with Shown(chromium, written(machine)) as shown:
        names = [
            name for name in shown("hydrolinkage.data.dims.map((each) => each[0])") if machine.plan.table.entries[name].kind == "length"
        ]
        for _ in range(12):
            design = {name: float(machine[name] * random.uniform(0.99, 1.01)) for name in names}
            at = {name: float(random.uniform(each.start, each.end)) for name, each in machine.strokes.items()}
            other = type(machine)(**design)
            pose = other.at(unreachable="nan", **at)
            if not pose.reached.all():
                continue
            assert shown("(given) => hydrolinkage.set(given)", {"design": design, "at": at})
            points = shown("hydrolinkage.points()")
            for name in machine.plan.points:
                assert_allclose(points[name], pose[name].ravel(), rtol=0, atol=1e-12)
        run = shown("hydrolinkage.sweep()")
        swept = other.at(
            unreachable="nan", **{name: np.array(run["along"]) if k == 0 else at[name] for k, name in enumerate(machine.strokes)}
        )
        for name, unit, row, *_ in shown("hydrolinkage.data.columns"):
            assert row >= 0, (name, unit)
        rows = {name: row for name, _, row, *_ in shown("hydrolinkage.data.columns")}
        for name in (name for name in rows if name.endswith(("_x", "_y"))):
            mine = swept[name[:-2]]["xy".index(name[-1])]
            there = np.isfinite(mine)
            assert_allclose(np.array(run["values"][rows[name]], float)[there], mine[there], rtol=0, atol=1e-12)


def test_own_columns_cylinders_and_forces_are_followed(chromium, written):
    design = {"OB": 0.31, "load.mass": 1500.0}
    hitch = ThreePointHitch(**design)
    motion = hitch.sweep(101)
    with Shown(chromium, written(ThreePointHitch())) as shown:
        assert shown("(given) => hydrolinkage.set(given)", {"design": design, "at": {"S": 0.1}})
        run, data = shown("hydrolinkage.sweep()"), shown("hydrolinkage.data")
        mine = {each.name: np.asarray(each.values) for each in hitch.columns(motion)}
        for name, _, row, *_ in data["columns"]:
            assert_allclose(np.array(run["values"][row], float), np.broadcast_to(mine[name], (101,)), rtol=1e-10, atol=1e-12)
        (lift,) = data["cylinders"]
        ram = hitch.lift
        for row, values in ((lift["pressure"], ram.pressure(motion)), (lift["most"], 18e6)):
            assert_allclose(np.array(run["values"][row], float), np.broadcast_to(values, (101,)), rtol=1e-10)
        weight = next(each for each in data["arrows"] if each.get("load"))
        assert_allclose(run["values"][weight["y"]], -1500 * 9.80665, rtol=1e-12)
        assert len(data["arrows"]) == 10


TYPED = {
    "0.31 m": (0.31, ""),
    "31cm": (0.31, ""),
    "12 in": (0.3048, ""),
    "3,1e2": (0.31, ""),
    "0 310": (0.31, ""),
    "3 1 0": (0.3, "OB = 3 1 0: a number in mm is expected"),
    "1 rad": (0.3, "OB = 1 rad: a number in mm is expected"),
    "310 foo": (0.3, "OB = 310 foo: a number in mm is expected"),
    "3.1 bar": (0.3, "OB = 3.1 bar: a number in mm is expected"),
    "abc": (0.3, "OB = abc: a number in mm is expected"),
    "-5": (0.3, "OB = -5: a number above zero is expected"),
}


def test_what_is_typed_is_read_with_its_unit_or_refused(chromium, written):
    with Shown(chromium, written(ThreePointHitch(), vary=SIZES)) as shown:
        box = shown.tab.get_by_label("OB, mm")
        for typed, (found, said) in TYPED.items():
            shown.tab.locator("#reset").click()
            box.fill(typed)
            box.press("Enter")
            shown.settle()
            assert shown.state["design"]["OB"] == pytest.approx(found, rel=1e-12), typed
            assert shown.text("#message").startswith(said)
            assert not said or box.input_value() == "300"


def test_a_rod_that_is_no_thinner_than_its_bore_is_told(chromium, written):
    with Shown(chromium, written(ThreePointHitch(), vary=SIZES)) as shown:
        box = shown.tab.get_by_label("lift.bore, mm")
        box.fill("60")
        box.press("Enter")
        shown.settle()
        assert any(each.startswith("lift: has no pressure with these sizes") for each in shown.told)
        assert "fail" in shown.text("#badge") or "does not hold" in shown.text("#badge")
        shown.tab.set_viewport_size({"width": 390, "height": 700})
        assert "do not follow" in shown.text("#groups") and shown("document.documentElement.scrollWidth") <= 390
        shown.tab.locator("#keep").click()  # beside others it is not told as good: what is not followed has no number
        rows = shown("[...document.querySelectorAll('#kept tr')].map((row) => [...row.children].map((each) => each.textContent))")
        assert any(name.startswith("lifting") and now == "\N{EN DASH}" != was for name, now, was, _ in rows[1:])


def test_a_slider_changes_its_dimension_and_the_verdicts_are_marked_as_of_the_delivered_design(chromium, written):
    with Shown(chromium, written(ThreePointHitch(), vary=SIZES)) as shown:
        assert not shown("document.getElementById('verdicts').classList.contains('changed')")
        before = shown("hydrolinkage.points()")["G"]
        shown.slide("[data-size=OB]", 600)
        assert shown.state["design"]["OB"] == pytest.approx(0.315, abs=1e-3)
        assert shown("hydrolinkage.points()")["G"] != before
        assert shown("document.getElementById('verdicts').classList.contains('changed')")
        box = shown.tab.get_by_label("OB, mm")
        box.fill("0.3e3")
        box.press("Enter")
        shown.settle()
        assert shown.state["design"]["OB"] == 0.3
        assert not shown("document.getElementById('verdicts').classList.contains('changed')")
        box.fill("much")
        box.press("Enter")
        shown.settle()
        assert "OB = much: a number in mm is expected" in shown.text("#message")


def test_a_value_goes_as_far_as_can_be_assembled_and_says_why_no_farther(chromium, written):
    with Shown(chromium, written(ThreePointHitch())) as shown:
        shown.find("CD")
        box = shown.tab.get_by_label("CD, mm")
        box.fill("1200")
        box.press("Enter")
        shown.settle()
        reached, said = shown.state["design"]["CD"], shown.text("#message")
        assert 0.62 < reached < 1.2
        assert re.fullmatch(r"CD stops here: D = Dyad\(E, C\) is \d+(\.\d+)?\u2009mm short", said), said
        assert ThreePointHitch(CD=reached - 1e-6).at(S=0.0).reached.all()
        assert not ThreePointHitch(CD=reached + 1e-5).at(S=0.0, unreachable="nan").reached.any()


@pytest.mark.slow
def test_no_dead_point_is_told_beyond_an_end_that_is_lost_itself(chromium, written):
    class Corner(Mechanism):
        p, q = Stroke(0.0, 0.2), Stroke(0.0, 0.2)
        O = Ground(0.0, 0.0)
        rail = Guide(O, angle=0.0)
        P = OnGuide(rail, at=1.0 - p)
        B = Dyad(O, P, OB=0.45 + q, PB=0.56, side=LEFT)

    with Shown(chromium, written(Corner())) as shown:
        for length, ok in ((0.555, True), (0.54, False)):  # 1 m is the farthest that P goes
            shown("(given) => hydrolinkage.set(given)", {"design": {"PB": length}, "at": {"p": 0.2, "q": 0.2}})
            shown.settle()
            told = {each["rule"]: each for each in shown("hydrolinkage.verdicts()")}
            assert told["assembly"]["ok"] is ok and ("dead points" in told) is ok, told


def test_what_is_not_reached_over_the_stroke_is_told_with_step_and_millimetres(chromium, written):
    with Shown(chromium, written(MowerLift(), at={"S": (0.55, 0.90)})) as shown:
        verdicts = shown("hydrolinkage.verdicts()")
        assert verdicts[0]["ok"] is False
        assert re.search(
            r"not assembled at S = [\d.]+\u2009mm to 900\u2009mm: B = Dyad\(A, O\) is [\d.]+\u2009mm short", verdicts[0]["text"]
        )
        end = MowerLift()["OB"] + float(np.hypot(*(MowerLift()["A"] - MowerLift()["O"])))
        (found,) = re.findall(r"at S = ([\d.]+)\u2009mm, where the reach ends", " ".join(each["text"] for each in verdicts))
        assert float(found) / 1e3 == pytest.approx(end, abs=1e-4)
        shown.slide("[data-stroke=S]", 1000)
        assert shown.state["at"]["S"] == pytest.approx(end, abs=1e-6)
        assert "S stops here: B = Dyad(A, O)" in shown.text("#message")
        shown("hydrolinkage.set({ at: { S: 0.7 } })")
        drag(shown, "B", (300, -150))
        assert shown.state["at"]["S"] == pytest.approx(end, abs=1e-3)
        assert re.search(r"B stops here: B = Dyad\(A, O\) is [\d.]+\u2009mm short", shown.text("#message"))


def test_a_pin_on_the_ground_is_dragged_and_joins_the_sliders(chromium, written):
    with Shown(chromium, written(ThreePointHitch())) as shown:
        box = shown("JSON.parse(JSON.stringify(document.querySelector('[data-pin=M]').getBoundingClientRect()))")
        place = [box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["width"]]
        shown.tab.mouse.move(*place)
        shown.tab.mouse.down()
        shown.tab.mouse.move(place[0] - 6, place[1] + 12, steps=4)
        shown.settle()
        shown.tab.mouse.up()
        shown.settle()
        design = shown.state["design"]
        assert design["M.x"] < 0.22 and design["M.y"] < 1.05
        assert (0.22 - design["M.x"]) / (1.05 - design["M.y"]) == pytest.approx(0.5, abs=0.15)
        names = shown("[...document.querySelectorAll('.size .name')].map((each) => each.textContent)")
        assert names[-1] == "M.x" and "M.y" in names


def test_a_finger_drags_too(chromium, written):
    with Shown(chromium, written(FourBar()), PHONE, has_touch=True) as shown:
        shown(
            """() => { const pin = document.querySelector('[data-pin=Q]'), box = pin.getBoundingClientRect();
            const send = (target, type, dx) => target.dispatchEvent(new PointerEvent(type, { pointerId: 7, pointerType: 'touch',
              bubbles: true, cancelable: true, clientX: box.x + 22 + dx, clientY: box.y + 22 }));
            SVGElement.prototype.setPointerCapture = () => {};
            send(pin, 'pointerdown', 0); send(pin, 'pointermove', 10); send(pin, 'pointerup', 10); }"""
        )
        shown.settle()
        assert shown.state["design"]["Q.x"] > 0.4


def middle(shown, pin):
    """Return where a pin is on the screen [px]."""
    box = shown(f"JSON.parse(JSON.stringify(document.querySelector('[data-pin={pin}]').getBoundingClientRect()))")
    return [box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["width"]]


def drag(shown, pin, by, keys=()):
    """Drag a pin by some pixels, with keys held."""
    at = middle(shown, pin)
    for key in keys:
        shown.tab.keyboard.down(key)
    shown.tab.mouse.move(*at)
    shown.tab.mouse.down()
    shown.tab.mouse.move(at[0] + by[0], at[1] + by[1], steps=6)
    shown.settle()
    shown.tab.mouse.up()
    for key in keys:
        shown.tab.keyboard.up(key)
    shown.settle()
    return at


def test_a_moving_joint_takes_the_mechanism_along_and_comes_as_near_as_the_stroke_brings_it(chromium, written):
    machine = ThreePointHitch()
    with Shown(chromium, written(machine)) as shown:
        shown("hydrolinkage.set({ at: { S: 0.1 } })")
        at = drag(shown, "G", (-8, -40))
        state = shown.state
        assert state["design"] == pytest.approx(dict(machine.dimensions), abs=1e-12) and state["at"]["S"] > 0.11
        scale = "(() => { const a = hydrolinkage.points(), px = (n) => document.querySelector(`[data-pin=${n}]`).getBoundingClientRect();"
        scale += " return Math.hypot(px('G').x - px('O').x, px('G').y - px('O').y) / Math.hypot(a.G[0] - a.O[0], a.G[1] - a.O[1]); })()"
        zoom = shown(scale)
        first = machine.at(S=0.1)["G"]
        wanted = [first[0] - 8 / zoom, first[1] + 40 / zoom]
        strokes = np.linspace(0.0, 0.25, 20001)
        far = np.hypot(*(machine.sweep(20001)["G"] - np.array(wanted)[:, None]))
        assert state["at"]["S"] == pytest.approx(strokes[far.argmin()], abs=2e-3) and at
        drag(shown, "G", (0, 400))
        assert shown.state["at"]["S"] == 0.0 and "G ends here: S = 0" in shown.text("#message")


def test_with_shift_the_lengths_that_meet_at_a_joint_follow_and_the_other_joints_stay(chromium, written):
    machine = FourBar()
    with Shown(chromium, written(machine)) as shown:
        before = shown("hydrolinkage.points()")
        drag(shown, "B", (20, -15), ["Shift"])
        after, design = shown("hydrolinkage.points()"), shown.state["design"]
        assert np.hypot(*np.subtract(after["B"], before["B"])) > 0.01
        for name in set(before) - {"B"}:
            if name in ("O", "A", "Q"):
                assert_allclose(after[name], before[name], atol=1e-5)
        pose = FourBar(**{k: v for k, v in design.items() if k in machine.dimensions}).at(phi=shown.state["at"]["phi"])
        assert_allclose(after["B"], pose["B"], atol=1e-12)
        shown.tab.keyboard.press("Control+z")
        shown.settle()
        assert shown.state["design"] == pytest.approx({k: v for k, v in machine.dimensions.items() if k in design})
        shown.tab.keyboard.press("Control+Shift+z")
        shown.settle()
        assert shown.state["design"] == design


def test_what_is_dragged_slowly_is_undone_at_once(chromium, written):
    machine = FourBar()
    with Shown(chromium, written(machine)) as shown:
        at = middle(shown, "B")
        shown.tab.keyboard.down("Shift")
        shown.tab.mouse.move(*at)
        shown.tab.mouse.down()
        for step in (4, 8, 12):
            shown.tab.mouse.move(at[0] + step, at[1] - step)
            shown("() => new Promise((then) => setTimeout(then, 300))")
        shown.tab.mouse.up()
        shown.tab.keyboard.up("Shift")
        shown.settle()
        assert shown.state["design"] != pytest.approx(dict(machine.dimensions), abs=1e-6)
        shown.tab.keyboard.press("Control+z")
        shown.settle()
        assert shown.state["design"] == pytest.approx(dict(machine.dimensions), abs=1e-12)


DRAGGED = """([pin, dx, dy]) => {
  hydrolinkage.play(true);
  const grip = document.querySelector(`[data-pin=${pin}]`), sheet = grip.ownerSVGElement, box = grip.getBoundingClientRect();
  const at = [box.x + box.width / 2, box.y + box.height / 2];
  const held = { bubbles: true, cancelable: true, pointerId: 1, isPrimary: true, shiftKey: true };
  const send = (element, kind, x, y) => element.dispatchEvent(new PointerEvent(kind, { ...held, clientX: x, clientY: y }));
  sheet.setPointerCapture = () => {};
  send(grip, "pointerdown", ...at);
  for (const kind of ["pointermove", "pointerup"]) send(sheet, kind, at[0] + dx, at[1] + dy);
}"""


def test_what_is_dragged_while_it_plays_is_undone(chromium, written):
    machine = FourBar()
    with Shown(chromium, written(machine)) as shown:
        shown(DRAGGED, ["B", 12, -12])
        assert shown.state["design"] != pytest.approx(dict(machine.dimensions), abs=1e-6)
        shown.tab.keyboard.press("Control+z")
        shown.settle()
        assert shown.state["design"] == pytest.approx(dict(machine.dimensions), abs=1e-12)


class Tool(Mechanism):
    """A tool in axes of its own, with a pin that is fixed there and one that hangs on it."""

    H, E, J = Ground(0.0, 0.0), Ground(0.20, 0.30), Ground(0.05, 0.12)
    X = OnLink(H, E, HX=0.2)


class Carried(FourBar):
    """The four-bar with a tool on its coupler, and a mirrored one that stands."""

    tool = Part(Tool, on=("B", "C"))
    stand = Part(Tool, at=(0.9, 0.1), mirrored=True, angle=20 * deg)


@pytest.mark.parametrize(("pin", "keys"), [("tool.J", ["Shift"]), ("stand.J", [])])
def test_what_a_part_fixes_goes_where_it_is_dragged_in_axes_of_its_own(chromium, written, pin, keys):
    with Shown(chromium, written(Carried())) as shown:
        before = shown("hydrolinkage.points()")
        scale = shown("(() => { const [a, b] = ['O', 'Q'].map((n) => document.querySelector(`[data-pin=${n}]`).getBoundingClientRect());"
                      " return Math.hypot(a.x - b.x, a.y - b.y) / 0.4; })()")  # fmt: skip
        drag(shown, f'"{pin}"', (30, -20), keys)
        after, design = shown("hydrolinkage.points()"), shown.state["design"]
        assert_allclose(np.subtract(after[pin], before[pin]), np.array([30, 20]) / scale, atol=2e-3)
        assert {name for name, value in design.items() if value != Carried().dimensions[name]} == {f"{pin}.x", f"{pin}.y"}
        for name in set(before) - {pin}:
            assert_allclose(after[name], before[name], atol=1e-5)


def test_how_far_others_give_way_is_told_from_where_they_stood(chromium, written):
    with Shown(chromium, written(Carried())) as shown:
        before = shown("hydrolinkage.points()")
        drag(shown, "B", (25, -25), ["Shift"])
        after = shown("hydrolinkage.points()")
        away = max(np.hypot(*np.subtract(after[name], before[name])) for name in before if name != "B")
        told = shown.text("#message")
        assert "give way" in told
        (said,) = re.findall(r"by ([\d.]+)", told)
        assert float(said) == pytest.approx(1e3 * away, rel=0.02)


CONTRASTS = """() => {
  const linear = (v) => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
  const light = ([r, g, b]) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
  const canvas = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });
  const colour = (text) => {
    canvas.clearRect(0, 0, 1, 1);
    canvas.fillStyle = text;
    canvas.fillRect(0, 0, 1, 1);
    return [...canvas.getImageData(0, 0, 1, 1).data].map((v) => v / 255);
  };
  const ground = (each) => {
    for (; each; each = each.parentElement) {
      const found = colour(getComputedStyle(each).backgroundColor);
      if (found[3] === 1) return found;
    }
    return [1, 1, 1, 1];
  };
  const faint = (each) => {
    for (; each; each = each.parentElement) if (Number(getComputedStyle(each).opacity) < 1) return true;
    return false;
  };
  const written = (each) => [...each.childNodes].some((one) => one.nodeType === 3 && one.data.trim());
  const found = [];
  for (const each of document.querySelectorAll("body *")) {
    if (each.closest("svg, script, :disabled") || !each.getClientRects().length || !written(each)) continue;
    const [a, b] = [light(colour(getComputedStyle(each).color)), light(ground(each))].sort((x, y) => y - x);
    const name = each.id || each.className || each.tagName;
    if (faint(each) || (a + 0.05) / (b + 0.05) < 4.5) found.push(`${name}: ${each.textContent.slice(0, 30)}`);
  }
  for (const each of document.querySelectorAll("button, select, input, textarea")) {
    const named = each.getAttribute("aria-label") || each.labels?.length;
    if (each.getClientRects().length && !named && !each.textContent.trim()) found.push(`${each.id}: no name`);
    if (each.tagName === "SELECT" && !named) found.push(`${each.id}: no label`);
  }
  for (const each of document.querySelectorAll("th")) if (!each.textContent.trim()) found.push("an empty heading");
  return found;
}"""


@first_daily(1, "scheme", ["light", "dark"])
def test_what_is_written_can_be_read_and_every_control_has_a_name(chromium, written, chart, scheme):
    with Shown(chromium, written(ThreePointHitch()), color_scheme=scheme) as shown:
        shown("hydrolinkage.set({ design: { OB: 0.29, 'lift.bore': 0.06 } })")
        for button in ("keep", "grid", "forces"):
            shown.tab.click(f"#{button}")
        shown.settle()
        assert shown("document.querySelectorAll('#groups .bad, #kept .other').length") > 1
        assert shown(CONTRASTS) == []
    with Shown(chromium, chart, PHONE, color_scheme=scheme) as shown:
        assert shown(CONTRASTS) == []


FORMS = ("python", "toml", "options")


def test_a_design_leaves_as_text_that_python_and_the_page_read(chromium, delivered, tmp_path, capsys):
    given = {"OB": 0.305, "M.x": 0.231, "M.y": 1.04, "lift.bore": 0.1, "circuit.pressure": 150 * bar, "KFG": 74 * deg}
    texts = {}
    with Shown(chromium, delivered) as shown:
        shown("(design) => hydrolinkage.set({ design })", given)
        for form in FORMS:
            shown.tab.locator(f"#as-{form}").click()
            texts[form] = shown.tab.locator("#text").input_value()
    assert '"circuit.pressure": 150 * bar' in texts["python"] and "KFG=74 * deg" in texts["python"]  # as one types it
    exec(texts["python"], names := {})
    (tmp_path / "design.toml").write_text(texts["toml"])
    assert main(["show", str(tmp_path / "design.toml")]) == 0
    found, read = names["machine"], design_of_file(str(tmp_path / "design.toml"), None)
    taken = design_of(ThreePointHitch, texts["options"].replace("--set ", "").split())
    expected = ThreePointHitch(**given)
    assert dict(found.dimensions) == dict(read.dimensions) == dict(taken.dimensions) == dict(expected.dimensions)
    with Shown(chromium, delivered) as again:
        for text in texts.values():
            again.tab.locator("#reset").click()
            again.tab.locator("#text").fill(text)
            again.tab.locator("#take").click()
            again.settle()
            design = again.state["design"]
            assert {name: design[name] for name in given} == pytest.approx(given, rel=1e-13)
            assert again.said == []


@pytest.mark.slow
def test_a_pressure_leaves_in_the_unit_that_is_shown(chromium, written):
    with Shown(chromium, written(HeaderBalancer())) as shown:
        shown("(design) => hydrolinkage.set({ design })", {"charge": 33 * kgf_cm2})
        for form, text in zip(FORMS, ("charge=33 * kgf_cm2", 'charge = "33 kgf/cm2"', "--set charge=33kgf/cm2"), strict=True):
            shown.tab.locator(f"#as-{form}").click()
            told = shown.tab.locator("#text").input_value()
            assert text in told
            if form == "python":
                exec(told, names := {})
            shown.tab.locator("#reset").click()
            shown.tab.locator("#text").fill(told)
            shown.tab.locator("#take").click()
            shown.settle()
            assert shown.state["design"]["charge"] == pytest.approx(33 * kgf_cm2, rel=1e-13) and shown.said == []
    assert names["machine"]["charge"] == 33 * kgf_cm2


class Stacker(FourBar):
    """A class of one's own."""


@pytest.mark.slow
def test_what_is_copied_of_ones_own_class_runs_and_says_where_nothing_was_changed(chromium, written, tmp_path, capsys):
    with Shown(chromium, written(Stacker())) as shown:
        texts = {}
        for design in ({}, {"OA": 0.1230000001}):
            shown("(design) => hydrolinkage.set({ design })", design)
            for form in FORMS:
                shown.tab.locator(f"#as-{form}").click()
                texts[form, bool(design)] = shown.tab.locator("#text").input_value()
    assert all("unchanged" in texts[form, False] and "unchanged" not in texts[form, True] for form in FORMS)
    for changed in (False, True):
        exec(texts["python", changed], names := {})
        assert names["machine"]["OA"] == (0.123 if changed else 0.12)
        file = tmp_path / "design.toml"
        file.write_text(texts["toml", changed])
        assert main(["show", str(file)]) == 2
        own = re.findall(r"--machine (\S+)\.", capsys.readouterr().err)[0]
        assert own == "test_page.py:Stacker"
        assert main(["show", str(file), "--machine", f"{Path(__file__)}:Stacker"]) == 0
        assert re.search(rf"\bOA +{123 if changed else 120} mm", capsys.readouterr().out)
    assert texts["options", True] == "--set OA=0.123"


def test_what_is_copied_of_a_files_machine_imports_the_file(tmp_path):
    file = tmp_path / "own_bar.py"
    file.write_text("from mechanisms.classics.four_bar import FourBar\n\n\nclass OwnBar(FourBar):\n    pass\n")
    found = named_in_code(find(f"{file}:OwnBar"))
    assert found == {"class": "OwnBar", "module": "own_bar", "machine": "own_bar.py:OwnBar"}
    assert named_in_code(Grapple)["module"] == "mechanisms.grapple"


@pytest.mark.slow
def test_every_path_that_a_machine_declares_runs_and_what_is_out_of_bounds_is_told(chromium, tmp_path):
    with Shown(chromium, page(Digging(), tmp_path / "digging.html")) as shown:
        runs = shown("[...document.getElementById('run').options].map((each) => each.textContent)")
        assert runs == ["alpha", "beta", "loading", "grading"]
        shown.slide('[data-stroke="grading"]', 0)
        assert shown.state["at"] == pytest.approx({"alpha": 0.4, "beta": -0.9, "loading": 1.0, "grading": 1.0})
        for width in (1366, 390):  # a place between two is read whole
            shown.tab.set_viewport_size({"width": width, "height": 700})
            shown.slide('[data-stroke="grading"]', 870)
            assert shown("[...document.querySelectorAll('.stroke input')].every((each) => each.scrollWidth <= each.clientWidth)")
    with Shown(chromium, page(HeaderBalancer(), tmp_path / "balancer.html"), PHONE) as shown:
        assert "F_R free \N{MINUS SIGN}196.6" in shown.text("#here") and "all kept" not in shown.text("#here")
        assert "2 no hang-up" in shown.text("#groups summary >> nth=0")
        assert shown("(({ scrollWidth, clientWidth }) => scrollWidth <= clientWidth)(document.getElementById('here'))")


MARKS = (
    "[...document.querySelectorAll('#mechanism g > polyline, #mechanism g > polygon')].map((each) => each.getBoundingClientRect())"
    ".filter(({ width, height }) => Math.max(width, height) < 40).map(({ x, y, width, height }) => [x + width / 2, y + height / 2])"
)


@pytest.mark.slow
def test_a_jump_of_a_curve_is_upright_and_a_name_stands_beside_a_support(chromium, tmp_path):
    """The header balancer's shoe takes up the load at once where the line has run empty."""
    within = {"F_R free": (8000.0, "within the jump", "below")}
    with Shown(chromium, page(HeaderBalancer(), tmp_path / "balancer.html", column="F_R free", limit=within)) as shown:
        line = shown("document.querySelector('#curve path[stroke-width=\"2.6\"]').getAttribute('d')")
        points = np.array([each.split(" ") for each in re.split("[ML]", line)[1:]], float)
        steps = np.abs(np.diff(points, axis=0))
        jump = int(np.argmax(steps[:, 1]))
        assert steps[jump, 1] > 50.0 and steps[jump, 0] < 0.2
        met = shown("[...document.querySelectorAll('#curve circle[r=\"4\"]')].map((each) => Number(each.getAttribute('cx')))")
        assert_allclose(met, [points[jump, 0]], atol=0.2)  # a limit within the jump is met where the curve is upright
        assert len(points) == 103
        (left, top, right, bottom), marks = next(box for text, *box in shown(TEXTS) if text == "R"), shown(MARKS)
        x, y = shown("(({ x, y }) => [x, y])(document.getElementById('mechanism').getBoundingClientRect())")
        assert marks and not [mark for mark in marks if left < mark[0] - x < right and top < mark[1] - y < bottom]


@pytest.mark.slow
def test_what_happened_on_the_way_is_as_delivered_once_a_dimension_changes(chromium, tmp_path):
    design = RegenerativePress()
    run = design.plan.members["supply"].run(design, demands={"ram": 0.2}, start={"S": 0.0}, until=1.0)
    with Shown(chromium, page(run, tmp_path / "press.html")) as shown:
        told = shown.text(".event")
        assert told and "judged over" in shown.text("#looked")
        shown.slide("#dimensions input[type=range]", 480)
        assert shown.text(".event") == f"as delivered: {told}" and shown.said == []


@first_daily(0, "playing", [False, True])
def test_the_first_change_by_keyboard_is_undone(chromium, written, playing):
    with Shown(chromium, written(ThreePointHitch(), vary=SIZES), reduced_motion="no-preference" if playing else "reduce") as shown:
        assert shown.state["playing"] is playing
        shown.tab.locator("[data-size=OB]").focus()
        shown.tab.keyboard.press("ArrowRight")
        shown.rest(400)
        assert shown.state["design"]["OB"] > 0.3
        shown.tab.keyboard.press("Control+z")
        shown.rest(100)
        assert shown.state["design"]["OB"] == 0.3


NOTHING_SET = {
    "OX=0.3": "not on this page: OX",
    "OB=3 kg": "no value: OB = 3 kg",
    "OB=-0.2": "no value: OB",
    "hello": "no setting was found",
}


@pytest.mark.slow
def test_a_text_that_sets_nothing_is_told_and_changes_nothing(chromium, written):
    with Shown(chromium, written(ThreePointHitch())) as shown:
        before = shown.state["design"]
        for text, says in NOTHING_SET.items():
            shown.tab.locator("#text").fill(text)
            shown.tab.locator("#take").click()
            shown.settle()
            assert says in shown.text("#message") and shown.state["design"] == before, text


def test_texts_with_units_are_read(chromium, written):
    with Shown(chromium, written(ThreePointHitch())) as shown:
        texts = 'OB = "305 mm"\nM = ["231 mm", "1.04 m"]', "--set OB=30.5cm --set M=231mm,1.04m", "Hitch(OB=305 * mm, M=(231 * mm, 1.04))"
        for text in texts:
            shown.tab.locator("#reset").click()
            shown.tab.locator("#text").fill(text)
            shown.tab.locator("#take").click()
            shown.settle()
            design = shown.state["design"]
            assert [design[name] for name in ("OB", "M.x", "M.y")] == pytest.approx([0.305, 0.231, 1.04], rel=1e-12)


@pytest.mark.slow
def test_a_links_text_is_an_option_of_commands(chromium, delivered, capsys):
    with Shown(chromium, delivered) as shown:
        shown("hydrolinkage.set({ design: { CD: 0.63 } })")
        shown.tab.locator("#keep").click()
        shown.rest(400)
        link = shown("location.href")
    assert main(["show", "three_point_hitch", "--from", link]) == 0
    said = capsys.readouterr().out
    assert re.search(r"OB\s+310 mm", said) and re.search(r"CD\s+630 mm", said)
    assert main(["show", "three_point_hitch", "--from", "nothing"]) == 2
    assert "no link of a live page" in capsys.readouterr().err


def test_the_curve_leaves_as_a_table_and_the_drawing_as_a_picture(chromium, written, tmp_path):
    machine = ThreePointHitch()
    with Shown(chromium, written(machine), accept_downloads=True) as shown:
        for name in ("csv", "svg", "png"):
            with shown.tab.expect_download() as given:
                shown.tab.locator(f"#{name}").click()
            given.value.save_as(tmp_path / f"found.{name}")
        head, *rows = (tmp_path / "found.csv").read_text(encoding="utf-8").splitlines()
        assert head.startswith("S [mm],") and len(rows) == 101
        table = np.array([[float(cell) for cell in row.split(",")] for row in rows])
        assert_allclose(table[:, 0], np.linspace(0, 250, 101), atol=1e-9)
        key = head.split(",")[1].partition(" ")[0]
        column = next(each for each in results(machine, machine.sweep(101)) if each.name == key)
        assert_allclose(table[:, 1], column.drawn, rtol=1e-9)
        picture = (tmp_path / "found.svg").read_text(encoding="utf-8")
        assert picture.startswith("<svg") and "var(--" not in picture
        assert imread(tmp_path / "found.png").shape[2] in (3, 4) and imread(tmp_path / "found.png").std() > 0.05
        assert shown.said == []


def test_units_are_switched_on_the_page_as_python_has_them(chromium, written):
    machine = ThreePointHitch()
    with Shown(chromium, written(machine)) as shown:
        for system in ("si", "bar-mm", "kgf", "us"):
            shown.tab.locator("#system").select_option(system)
            shown.settle()
            told = shown.told
            with unit_system(system):
                expected = [typeset(str(each)) for each in machine.verdicts()]
            assert len(told) == len(expected), system
            plain = [re.sub(r"[^0-9A-Za-z.]+", " ", re.sub(r"^(ok|FAIL|--) +", "", each)).split() for each in expected]
            assert sorted(re.sub(r"[^0-9A-Za-z.]+", " ", each).split() for each in told) == sorted(plain), system


def test_designs_stand_beside_each_other_with_what_differs(chromium, written):
    with Shown(chromium, written(ThreePointHitch())) as shown:
        for value in (0.29, 0.32):
            shown("(OB) => hydrolinkage.set({ design: { OB } })", value)
            shown.tab.locator("#keep").click()
        shown("hydrolinkage.set({ design: { OB: 0.3, CD: 0.63 } })")
        shown.rest(400)
        rows = shown("[...document.querySelectorAll('#kept tr')].map((row) => [...row.children].map((each) => each.textContent))")
        assert rows[0][1:] == ["now", "delivered", "A\u00d7", "B\u00d7"]
        assert rows[1] == ["OB, mm", "300", "300", "290", "320"] and rows[2] == ["CD, mm", "630", "620", "620", "620"]
        shown.tab.locator("#kept button", has_text="B").first.click()
        shown.settle()
        assert shown.state["design"]["OB"] == 0.32 and shown.state["design"]["CD"] == 0.62
        shown.rest(400)
        mark = shown("location.hash")
    with Shown(chromium, written(ThreePointHitch()), mark=mark) as again:
        assert again("document.querySelectorAll('#kept thead button:not(.drop)').length") == 2


def test_two_places_are_a_distance_and_three_an_angle(chromium, written):
    machine = ThreePointHitch()
    with Shown(chromium, written(machine)) as shown:
        shown.tab.locator("#measure").click()
        for pin in ("O", "B"):
            shown.tab.mouse.click(*middle(shown, pin))
        shown.settle()
        assert shown.tab.locator(".measure").last.text_content() == "300\u2009mm"
        shown.tab.mouse.click(*middle(shown, "C"))
        shown.settle()
        pose = machine.at(S=shown.state["at"]["S"])
        O, B, C = (np.array(pose[name]) for name in "OBC")
        corner = np.degrees(np.arccos(np.dot(O - B, C - B) / np.linalg.norm(O - B) / np.linalg.norm(C - B)))
        assert float(shown.tab.locator(".measure").last.text_content().rstrip("\u00b0")) == pytest.approx(corner, abs=0.006)


def test_the_sheet_is_seen_closer_and_moved_and_a_press_on_the_curve_moves_the_stroke(chromium, written):
    with Shown(chromium, written(ThreePointHitch())) as shown:
        far = np.hypot(*np.subtract(middle(shown, "O"), middle(shown, "G")))
        shown.tab.locator("#nearer").click()
        shown.settle()
        assert np.hypot(*np.subtract(middle(shown, "O"), middle(shown, "G"))) == pytest.approx(1.4 * far, rel=1e-3)
        box = shown.tab.locator("#mechanism").bounding_box()
        at = [box["x"] + 12, box["y"] + 0.6 * box["height"]]
        was = middle(shown, "G")
        shown.tab.mouse.move(*at)
        shown.tab.mouse.down()
        shown.tab.mouse.move(at[0] + 40, at[1] - 25, steps=4)
        shown.tab.mouse.up()
        shown.settle()
        assert_allclose(middle(shown, "G"), [was[0] + 40, was[1] - 25], atol=0.2)
        shown.tab.locator("#whole").click()
        shown.settle()
        curve = shown.tab.locator("#curve").last.bounding_box()
        shown.tab.mouse.click(curve["x"] + 0.6 * curve["width"], curve["y"] + 0.4 * curve["height"])
        shown.settle()
        assert 0.1 < shown.state["at"]["S"] < 0.2 and shown.tab.locator(".read").text_content().startswith("S = ")


def test_it_speaks_both_languages_and_keeps_the_numbers(chromium, written):
    with Shown(chromium, written(ThreePointHitch())) as shown:
        english = " ".join(shown.told)
        shown.tab.locator("#language").click()
        shown.settle()
        russian = " ".join(shown.told)
        assert "собирается" in russian and "мм" in russian
        assert re.findall(r"\d+\.\d+", russian) == re.findall(r"\d+\.\d+", english)
        assert shown("document.documentElement.lang") == "ru"
        assert re.search(r"[A-Za-z]{5,}", russian.replace("weight of the implement", "")) is None  # a limit's own words are the user's


def test_it_is_dark_where_the_reader_is_and_where_asked(chromium, written):
    paper = "getComputedStyle(document.documentElement).backgroundColor"
    with Shown(chromium, written(FourBar()), color_scheme="dark") as shown:
        assert sum(map(int, re.findall(r"\d+", shown(paper))[:3])) < 120
        shown.tab.locator("#look").click()
        assert shown(paper) == "rgb(255, 255, 255)"


def test_a_link_restores_what_is_shown(chromium, written):
    file = written(ThreePointHitch())
    with Shown(chromium, file) as shown:
        shown("hydrolinkage.set({ design: { OB: 0.3123456789012345, 'M.x': 0.21 }, at: { S: 0.0712345678901234 } })")
        for selector, value in (("#column", "I"), ("#second", "capacity, kN")):
            shown.tab.locator(selector).select_option(label=value)
        shown.tab.locator("#forces").click()
        shown.tab.locator("#language").click()
        shown.tab.locator("#look").click()
        shown.rest(400)
        mark, state = shown("location.hash"), shown.state
        look = shown("document.documentElement.dataset.look")
    with Shown(chromium, file, mark=mark) as again:
        assert again.state == state
        assert again("document.documentElement.dataset.look") == look
        again.tab.locator("#reset").click()
        again.settle()
        assert again.state["design"]["OB"] == 0.3
        assert again.state["at"]["S"] == 0.0
    with Shown(chromium, file, mark="#s.S=9e9&d.OB=nonsense&d.CD=9&column=none&show=OB+nothing&run=x") as odd:
        assert odd.said == []
        assert odd.state["design"]["OB"] == 0.3 and odd.state["design"]["CD"] < 9


LAYOUT = """() => {
  const box = (each) => each.getBoundingClientRect(), told = (list) => list.map((each) => each.outerHTML.slice(0, 80));
  const size = (each) => parseFloat(getComputedStyle(each).fontSize);
  const seen = (each) => box(each).width > 1 && getComputedStyle(each).visibility !== "hidden";
  const all = [...document.querySelectorAll("body *")].filter(seen);
  const beyond = (own, frame) =>
    own.left < frame.left - 1 || own.right > frame.right + 1 || own.top < frame.top - 1 || own.bottom > frame.bottom + 1;
  const says = (each) => [...each.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim());
  const touched = [...document.querySelectorAll("button:not(.drop), select, input[type=range]")];
  return {
    across: document.documentElement.scrollWidth,
    out: told(all.filter((each) => !each.closest("svg") && (box(each).left < -0.5 || box(each).right > innerWidth + 0.5))),
    small: told(all.filter((each) => says(each) && size(each) < 12)),
    low: ["#mechanism", "[data-stroke]", "#play", "[data-size]"].map((each) => box(document.querySelector(each)).bottom),
    texts: told([...document.querySelectorAll("svg text")].filter(seen).filter((each) => beyond(box(each), box(each.ownerSVGElement)))),
    touch: told(touched.filter((each) => box(each).height > 0 && box(each).height < 30)),
  };
}"""
"""What is wrong with how a page stands on the screen."""


@for_all(("size", "tongue"), [(LAPTOP, "en"), (PHONE, "ru")], slow=[(LAPTOP, "ru"), (PHONE, "en")])
def test_picture_and_sliders_stand_on_one_screen_and_nothing_overflows(chromium, written, size, tongue):
    with Shown(chromium, written(ThreePointHitch()), size, mark=f"#language={tongue}&forces=1") as shown:
        seen = shown(LAYOUT)
        assert seen["across"] <= size[0]
        assert seen["out"] == [] and seen["small"] == [] and seen["texts"] == [] and seen["touch"] == []
        assert max(seen["low"]) <= size[1]
        body = shown.text("body")
        assert not re.search(r"-0\.0|\d[eE][+-]?\d|NaN|undefined|Infinity", body), body


def test_it_plays_pauses_and_goes_by_keys(chromium, written):
    with Shown(chromium, written(FourBar())) as shown:
        shown.tab.keyboard.press("End")
        shown.settle()
        assert shown.state["at"]["phi"] == pytest.approx(2 * np.pi)
        shown.tab.keyboard.press("Home")
        shown.tab.keyboard.press("ArrowRight")
        shown.settle()
        assert shown.state["at"]["phi"] == pytest.approx(2 * np.pi / 100)
        shown.tab.keyboard.press("Space")
        for _ in range(200):
            if shown.state["at"]["phi"] > 0.1:
                break
            shown.rest(30)
        assert shown.state["playing"] and shown.state["at"]["phi"] > 0.1
        shown.tab.keyboard.press("Space")
        assert not shown.state["playing"]
        assert shown("hydrolinkage.data.strokes[0].turn") == 1


def test_a_second_column_and_the_delivered_design_lie_over_the_first(chromium, written):
    with Shown(chromium, written(FourBar(), limit={"psi": (100 * deg, "at most 100 deg")}, column="psi")) as shown:
        lines = "document.querySelectorAll('#curve path.line').length"
        alone = shown(lines)
        shown.tab.locator("#second").select_option(label="C_y, m")
        shown.settle()
        assert shown(lines) == alone + 1 and shown.text("#other").endswith("m")
        shown("hydrolinkage.set({ design: { OA: 0.121 } })")
        assert shown(lines) == alone + 2
        assert shown("document.querySelectorAll('#curve rect').length") == 1
        judged = next(each for each in shown("hydrolinkage.verdicts()") if each["rule"] == "psi")
        assert judged["ok"] is False and "not above 100°" in judged["text"]
        most = float(np.nanmax(FourBar(OA=0.121).sweep(2001)["psi"])) / deg
        assert float(re.findall(r"greatest ([\d.]+)", judged["text"])[0]) == pytest.approx(most, abs=0.06)


def test_a_column_that_no_program_gives_is_shown_as_delivered_with_the_reason(chromium, written):
    with Shown(chromium, written(Plain(), column="count")) as shown:
        assert shown.text("#value") not in ("", "–")
        assert "count" in shown("document.getElementById('column').title")
        shown("hydrolinkage.set({ design: { OA: 0.121 } })")
        assert shown.text("#value") == "–"
        assert "not followed in the page" in shown("document.getElementById('curve').textContent")
        assert not shown.tab.locator("#forces").is_visible()


def test_several_strokes_each_have_a_slider_and_one_plays(chromium, written):
    with Shown(chromium, written(Reach())) as shown:
        assert shown.tab.locator("[data-stroke]").count() == 2
        shown.tab.locator("#run").select_option(label="beta")
        shown.settle()
        along = shown("hydrolinkage.sweep().along")
        beta = Reach().strokes["beta"]
        assert along[0] == beta.start and along[-1] == beta.end
        shown.slide("[data-stroke=alpha]", 250)
        alpha = Reach().strokes["alpha"]
        assert shown.state["at"]["alpha"] == pytest.approx(alpha.start + 0.25 * (alpha.end - alpha.start))


def test_dimensions_are_added_and_taken_away(chromium, written):
    with Shown(chromium, written(FourBar(), vary=["OA"])) as shown:
        names = "[...document.querySelectorAll('.size .name')].map((each) => each.textContent)"
        assert shown(names) == ["OA"]
        shown.find("load.mass")
        assert shown(names) == ["OA", "load.mass"]
        assert "kg" in shown.text("#dimensions")
        shown.tab.locator(".drop").first.click()
        assert shown(names) == ["load.mass"]


@pytest.mark.slow
def test_a_machine_of_a_file_and_requests_as_columns(chromium, written):
    boom = load(str(DATA / "loader_boom.toml"))()
    with Shown(chromium, written(boom)) as shown:
        assert shown.said == []
        assert shown.state["at"].keys() == {"S", "tilt"}
    with Shown(chromium, written(FourBar(), columns=[drive_force(), "psi"])) as shown:
        row = shown("hydrolinkage.data.columns[0][2]")
        torque = FourBar().sweep(101)[drive_force()]
        assert_allclose(shown("hydrolinkage.sweep()")["values"][row], torque, rtol=1e-10, atol=1e-9)


class Lifting(Mechanism):
    """A weight on an arm that a cylinder holds, and one of another make beside it; nothing of its own is said about it."""

    S = Stroke(0.0, 0.2)
    O, P = Ground(0, 0), Ground(0.5, -0.4)
    B = Dyad(O, P, OB=0.6, PB=0.55 + S, side=LEFT)
    C = OnLink(O, B, OC=1.5)
    load = Weight(C, mass=1000)
    lift = Cylinder(P, B, bore=63 * mm, rod=36 * mm, closed=0.5, stroke=0.3)
    line = LiftCircuit(lift, pressure=20 * MPa)


class Held(Lifting):
    """The same, whose cylinder is only drawn."""

    line = None
    lift = None
    load = None


class Shared(Mechanism):
    """A crank and a slider with a damper from the crank's axle, where a torque is carried over too."""

    phi = Stroke(0.2, 1.2)
    O = Ground(0, 0)
    A = Crank(O, OA=0.2, angle=phi)
    rail = Guide((0.0, 0.05), angle=0.0)
    B = SliderDyad(A, rail, AB=0.6, side=LEFT)
    brush = Damper(O, B, coefficient=400.0)
    mass = Weight(A, mass=10)


@pytest.mark.slow
def test_what_every_machine_is_given_is_followed(chromium, written):
    """Its drive's force, thrust, pressure and reserve, at another design too."""
    design = {"OB": 0.58, "load.mass": 1100.0}
    with Shown(chromium, written(Lifting())) as shown:
        assert shown("(given) => hydrolinkage.set(given)", {"design": design})
        run = shown("hydrolinkage.sweep()")
        mine = {each.name: np.asarray(each.values) for each in results(Lifting(**design), Lifting(**design).sweep(101))}
        rows = {name: row for name, _, row, *_ in shown("hydrolinkage.data.columns")}
        mine["1/reserve, %"] = 100.0 / mine["reserve"]
        assert {"drive force", "thrust", "pressure", "1/reserve, %"} < rows.keys() and min(rows.values()) >= 0
        for name, row in rows.items():
            assert_allclose(np.array(run["values"][row], float), np.broadcast_to(mine[name], (101,)), rtol=1e-10, atol=1e-12)


class Cased(Lifting):
    """The same, with a path in a load case, one under its own loads, and a hold."""

    half = LoadCase("half", scale={"load": 0.5})
    up = Over.path(S=[0.0, 0.15], cases=["half"])
    down = Over.path(S=[0.2, 0.05], cases=["plain"])


@pytest.mark.slow
def test_curves_of_a_path_are_in_its_load_case_and_a_reserve_is_the_pumps_load(chromium, tmp_path):
    machine, file = Cased(), tmp_path / "cased.html"
    with Shown(chromium, page(machine, file, column="reserve", limit={"reserve": (1.25, "a quarter", "below")})) as shown:
        names = shown("[...document.getElementById('column').options].map((each) => each.textContent)")
        assert "1/reserve, %" in names and not any(each.startswith("reserve") for each in names)
        rows = {name: row for name, _, row, *_ in shown("hydrolinkage.data.columns")}
        assert shown("hydrolinkage.data.limits")["1/reserve, %"][0:3:2] == [80.0, "above"]
        for over, case in (("up", "half"), ("down", None)):
            shown.slide(f'[data-stroke="{over}"]', 0)
            run, k = shown("hydrolinkage.sweep()"), shown("hydrolinkage.data.cases").index(case or "")
            motion = machine.sweep(101, over=over)
            for name, own in (("thrust", thrust("lift", case=case)), ("1/reserve, %", 100.0 / reserve("lift", case=case))):
                assert_allclose(run["values"][rows[name][k]], motion[own], rtol=1e-9, err_msg=f"{name} {over}")
            assert isinstance(rows["B_x"], int)
            shown.settle()
            said = shown("document.getElementById('curve').textContent")
            assert ("load case: half" in said) is (case == "half") and f"{over}, place" in said
        for over, places in (("down", 2), ("up", 2)):  # a place in a verdict is gone to on its path, with its case
            shown.slide('[data-stroke="S"]', 500)
            where = shown.tab.locator("#groups li", has_text=f"over {over}").locator("a.place").first
            where.evaluate("(each) => { each.closest('details').open = true; }")
            at, told = float(re.search(r"S = ([\d.]+)", where.inner_text())[1]), where.evaluate("(each) => each.closest('li').textContent")
            assert f"over {over}, at {where.inner_text()}" in told
            where.click()
            shown.settle()
            assert shown("document.getElementById('run').selectedOptions[0].textContent") == over and f"of {places}" in shown.text(
                "#strokes"
            ) + str(shown("[...document.querySelectorAll('#strokes input[type=text]')].map((each) => each.value)"))
            assert float(shown.tab.get_by_label("S, mm").input_value().split("\u2009")[0]) == pytest.approx(at, abs=0.05)
    curve, bound = as_curve(Column("reserve lift", np.array([4.0, 0.5, np.nan]), ""))
    assert curve.name == "1/reserve lift, %" and bound[0] == 100.0
    assert_array_equal(curve.values, [25.0, 200.0, np.nan])
    for own in ("reserved", "reserve"):  # what a machine calls so is its own
        assert as_curve(Column(own, np.array([4.0, 0.5]), "", request=own))[0].name == own
    spare = reserve("lift") - 1.0
    assert as_curve(Column(str(spare), np.array([4.0, 0.5]), "", request=spare))[1] is None
    figure = plot(machine, ["reserve"])
    for ax, (over, case) in zip(figure.axes, (("up", "half"), ("down", None)), strict=True):
        assert_allclose(ax.lines[0].get_ydata(), 100.0 / machine.sweep(101, over=over)[reserve("lift", case=case)], rtol=1e-9)
        assert ax.get_title(loc="left").startswith("1/reserve, %")


@pytest.mark.slow
def test_a_delivered_design_that_asks_too_much_is_told_so(chromium, written, tmp_path):
    heavy = Lifting(**{"load.mass": 9000.0})
    assert any(each.ok is False for each in heavy.verdicts(heavy.sweep(101)) if each.is_rule)
    with Shown(chromium, page(heavy, tmp_path / "heavy.html")) as shown:
        assert {each["rule"] for each in shown("hydrolinkage.verdicts()") if each["ok"] is False} >= {"lifting", "holding"}
        shown("hydrolinkage.set({ design: { 'load.mass': 9001 } })")
        shown.settle()
        failing = [each["text"] for each in shown("hydrolinkage.verdicts()") if each["ok"] is False]
        assert any("bar" in each and ": above" in each for each in failing) and any("the least reserve is 0" in each for each in failing)
        assert shown("document.getElementById('badge').dataset.fails") != "0"


class Hanging(Mechanism):
    """A boom on a cylinder that works with its piston: the load of the counterweight pulls it, too."""

    S = Stroke(0.0, 0.25)
    A, O = Ground(0.2, -0.4), Ground(0.0, 0.0)
    B = Dyad(A, O, AB=0.65 + S, OB=0.6, side=RIGHT)
    P = OnLink(O, B, OP=2.0)
    Q = OnLink(O, B, OQ=2.0, BOQ=180 * deg)
    load = Weight(P, mass=100.0)
    counter = Weight(Q, mass=700.0)
    lift = Cylinder(A, B, bore=80 * mm, rod=70 * mm)
    pump = LiftCircuit(lift, pressure=17 * MPa, relief=17 * MPa)


@pytest.mark.slow
def test_what_fails_of_a_changed_design_is_said_with_what_would_help(chromium, written):
    with Shown(chromium, written(Lifting())) as shown:
        assert shown("(given) => hydrolinkage.set(given)", {"design": {"lift.bore": 0.04, "lift.rod": 0.02, "lift.stroke": 0.15}})
        shown.settle()
        told = " | ".join(shown.told)
        assert "it needs a higher pressure or a larger size" in told and "take a thicker rod, or shorten the cylinder" in told
        assert re.search(r"length: [\d.]+\u2009mm are missing: take a longer stroke", told)
    with Shown(chromium, written(Digger())) as shown:
        design = {"load.mass": 2500.0}
        assert shown("(given) => hydrolinkage.set(given)", {"design": design})
        shown.settle()
        python = [str(each.sentence) for each in Digger(**design).verdicts() if each.sentence.startswith("tipping")]
        mine = [text.partition(": ")[2] for text in shown.told if ": tipping" in text]
        places = [[each.partition(":")[0].replace("\u2009", " ") for each in texts] for texts in (python, mine)]
        assert places[0] == places[1] == ["tipping in the case heavy, at S = 350.0 mm, s = 250.0 mm"]
        assert all("it would have to be held down with" in each and "set the supports wider" in each for each in mine)


@pytest.mark.slow
def test_one_dimension_that_is_shown_at_first_makes_a_rule_hold(chromium, written):
    """What is not kept chooses sliders, too: one of them moved to an end is enough. Designs beside each other say which rule fails."""
    with Shown(chromium, written(Digger(**{"load.mass": 2500.0}))) as shown:
        fails = "Number(document.getElementById('badge').dataset.fails)"
        before, sliders = shown(fails), shown("[...document.querySelectorAll('[data-size]')].map((each) => each.dataset.size)")
        shown.tab.locator("#keep").click()
        left = {}
        for slider, end in product(sliders, (0, 1000)):
            shown.slide(f"[data-size='{slider}']", end)
            shown.rest(400)
            left[slider, end] = shown(fails)
            shown.tab.locator("#kept button", has_text="A").first.click()
        assert before and min(left.values()) < before, left
        (slider, end) = min(left, key=left.__getitem__)
        shown.slide(f"[data-size='{slider}']", end)
        shown.rest(400)
        for width in (1366, 390, 310):  # the last is a frame within a page on a phone
            shown.tab.set_viewport_size({"width": width, "height": 700})
            assert shown("document.documentElement.scrollWidth") <= width
        rows = dict(shown("[...document.querySelectorAll('#kept tr')].map((row) => [row.children[0].textContent, row.textContent])"))
        assert any(name.startswith("axle load") and text.count("\u2715") == 2 for name, text in rows.items())


@pytest.mark.slow
def test_a_strokes_value_is_typed_and_its_slider_goes_over_all_that_is_declared(chromium, tmp_path):
    with Shown(chromium, page(Lifting(), tmp_path / "part.html", at={"S": (0.05, 0.12)})) as shown:
        field = shown.tab.locator(".stroke input[type='text']")
        for text, value in (("110", 0.11), ("18 cm", 0.18), ("900", 0.2), ("x", 0.2)):
            field.fill(text)
            field.press("Enter")
            shown.settle()
            assert shown.state["at"]["S"] == pytest.approx(value, abs=1e-12)
        assert "a number in mm is expected" in shown.text("#message")
        assert shown("document.querySelector('[data-stroke]').value") == "1000"
        run = shown("hydrolinkage.sweep().along")
        assert (run[0], run[-1]) == (0.05, 0.12)
        shown.slide("#strokes input", 0)
        assert shown.state["at"]["S"] == 0.0


@pytest.mark.slow
def test_holding_is_followed_on_both_sides_and_never_green_above_the_valve(chromium, written):
    """The load pulls: 502 of 170 bar stand in the rod side, where the working side has none."""
    verdicts = {each.rule: each for each in Hanging().verdicts() if each.is_rule}
    assert verdicts["holding"].ok is False
    with Shown(chromium, written(Hanging())) as shown:
        (holding,) = (each for each in shown("hydrolinkage.verdicts()") if each["rule"] == "holding")
        assert holding["ok"] is False and "the rod side" in holding["text"]
        assert shown("document.getElementById('badge').dataset.fails") != "0"
        shown("(given) => hydrolinkage.set(given)", {"design": {"counter.mass": 120.0}})
        shown.settle()
        (holding,) = (each for each in shown("hydrolinkage.verdicts()") if each["rule"] == "holding")
        assert holding["ok"] is True
        shown("(given) => hydrolinkage.set(given)", {"design": {"counter.mass": 1400.0}})
        shown.settle()
        assert shown("document.getElementById('badge').dataset.fails") != "0" and "hold" not in shown.text("#badge").split(":")[0]


class Rubbing(Hanging):
    """The same with friction, which no program follows while it moves."""

    counter = None
    Q = None
    rub = PinFriction("O", radius=0.03, coefficient=0.15)
    half = LoadCase("half", scale={"load": 0.5})


def test_what_the_page_does_not_follow_is_named_and_never_green(chromium, written):
    rules = {each.rule: each for each in Rubbing().verdicts() if each.is_rule}
    with Shown(chromium, written(Rubbing()), PHONE) as shown:
        assert "lifting" in rules and "lifting" not in [each["rule"] for each in shown("hydrolinkage.data.judge.questions")]
        found = {each["rule"]: each for each in shown("hydrolinkage.verdicts()")}
        assert found["lifting"]["share"] == pytest.approx(1.0 / rules["lifting"].answer.value, rel=1e-6)  # as a report has it
        assert "are without friction; the pressure and the reserve" in shown.text("#looked")
        columns = shown("hydrolinkage.data.columns")
        (place,) = (k for k, each in enumerate(columns) if each[0] == "pressure")
        motion = Rubbing().sweep(shown("hydrolinkage.data.count"))
        for k, case in enumerate(shown("hydrolinkage.data.cases")):
            (own,) = (each for each in results(Rubbing(), motion, case or "plain") if each.name == "pressure")
            assert_allclose(columns[place][4][str(k)], own.values, rtol=1e-5)
        shown.tab.select_option("#column", str(place))
        known, curve = "not followed in the page: known only as delivered", "document.getElementById('curve').textContent"
        for case in range(len(shown("hydrolinkage.data.cases"))):
            shown.tab.select_option("#case", str(case))
            shown.settle()
            assert shown("document.getElementById('column').title") == f"pressure: {known}"
            assert known not in shown(curve)
            assert shown.text("#value").endswith("bar")
        shown.tab.select_option("#case", "0")
        assert shown("(given) => hydrolinkage.set(given)", {"design": {"load.mass": 90.0}})
        shown.settle()
        found = {each["rule"]: each for each in shown("hydrolinkage.verdicts()")}
        assert found["lifting"]["ok"] is None and found["lifting"]["stale"]
        right = "each.getBoundingClientRect().right"
        far = f"((list) => [...list].map((each) => {right}))(document.querySelectorAll('#curve, #curve text'))"
        assert known in shown(curve) and shown(far)[0] >= max(shown(far)[1:])
        assert sum("do not follow your changes" in each for each in shown.text("#groups").splitlines()) == 1
        assert shown("document.getElementById('badge').dataset.fails") == "0"
        assert re.fullmatch(r"the live verdicts hold; as delivered or without an answer: \d+", shown.text("#badge"))
        assert shown.text("#badge") != "all live verdicts hold"


def test_what_has_no_program_leaves_the_other_columns_in_one():
    motion, asked = Rubbing().sweep(7), [thrust("lift"), reserve("lift"), y("P")]
    assert_allclose([*values_together(motion, asked).values()], [motion[asked[0]], motion[asked[2]]], rtol=1e-12)


@pytest.mark.slow
def test_groups_count_among_dead_points(chromium, written):
    machine = StephensonThreeFar()
    (verdict,) = (each for each in machine.verdicts() if each.rule == "dead points")
    away = min(float(each) for each in re.findall(r"([\d.]+) deg beyond", verdict.sentence))
    with Shown(chromium, written(machine)) as shown:
        (dead,) = (each["text"] for each in shown("hydrolinkage.verdicts()") if each["rule"] == "dead points")
        assert dead == verdict.sentence
        shown("hydrolinkage.set({ design: { OA: hydrolinkage.state().design.OA * (1 + 1e-9) } })")
        (dead,) = (each["text"] for each in shown("hydrolinkage.verdicts()") if each["rule"] == "dead points")
        assert min(map(float, re.findall(r"([\d.]+)° beyond it", dead))) == pytest.approx(away, abs=0.01)
        assert re.search(r"of .*? at ", verdict.sentence)[0] in dead


def test_what_is_dragged_is_looked_at_coarsely_and_says_so(chromium, written):
    with Shown(chromium, written(Hanging())) as shown:
        said = shown.text("#looked")
        assert said.startswith("looked at 17 values a stroke") and int(re.findall(r"(\d+) poses", said)[0]) <= 5000
        box = shown("JSON.parse(JSON.stringify(document.querySelector('[data-pin=A]').getBoundingClientRect()))")
        place = [box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["width"]]
        shown.tab.mouse.move(*place)
        shown.tab.mouse.down()
        shown.tab.mouse.move(place[0] - 6, place[1] + 6, steps=4)
        shown.settle()
        assert shown.text("#looked").startswith("looked at 9 values a stroke")
        shown.tab.mouse.up()
        shown.settle()
        assert shown.text("#looked").startswith("looked at 17 values a stroke")


def test_a_cylinder_of_which_nothing_is_known_is_drawn(chromium, written):
    with Shown(chromium, written(Held())) as shown:
        assert shown.said == []
        (ram,) = shown("hydrolinkage.data.cylinders")
        assert "pressure" not in ram


@pytest.mark.slow
def test_a_pin_with_several_joints_and_a_torque_has_the_arrows_that_can_be_told_apart(chromium, written):
    with Shown(chromium, written(Shared())) as shown:
        assert shown.said == [] and len(shown("hydrolinkage.data.arrows")) >= 4


@for_all(("machine", "names"), (), slow=[(Grapple, {"D", "H", "M_g", "M_1", "M_g/M_1"}), (HeaderBalancer, {"H", "P", "F_R free"})])
def test_what_a_balancer_and_a_grapple_are_about_is_followed(machine, names):
    requests = PageRequests(machine(), 101, at={})
    live = live_text(machine.plan, requests.by_name, name="engine")
    assert {f"column {name} 0" for name in names} <= live.rows.keys()
    assert requests.limits and all(re.search("[\u0430-\u044f]", limit_data(requests, name)[3]) for name in requests.limits)


# -- along a path ------------------------------------------------------------------------------------------


class LevelLoader(Mechanism):
    """One cylinder lifts the boom, the other one, on the boom, tips the bucket; a third stroke pushes a tooth out."""

    lift, dump, push = Stroke(0.80, 1.30), Stroke(0.78, 1.15), Stroke(0.7, 0.9)
    O, A = Ground(0, 1.5), Ground(0.45, 0.75)
    B = Dyad(O, A, OB=1.1, AB=lift, side=LEFT)
    T = OnLink(O, B, OT=2.4)
    C = OnLink(O, B, OC=1.4, BOC=12 * deg)
    D = Dyad(T, C, TD=0.35, CD=dump, side=RIGHT)
    E = OnLink(T, D, TE=push, DTE=-120 * deg)
    tilt = angle("T", "E")
    load = Weight(T, mass=900)
    lifter = Cylinder(A, B, bore=90 * mm, rod=40 * mm, works="both")
    line = LiftCircuit("lifter", pressure=180 * bar)


def level_lift(**options):
    """Return the motion of a bucket that is lifted level."""
    targets = [Target(y("T"), np.linspace(1.2, options.pop("top", 2.3), 9)), Target("tilt", 0.0)]
    return LevelLoader(OB=1.11).follow(targets, hold={"push": 0.75}, **options)


def test_the_page_of_a_motion_runs_along_its_path(chromium, tmp_path):
    motion = level_lift()
    with Shown(chromium, page(motion, tmp_path / "follow.html", column="pressure", trace=["T"])) as shown:
        assert shown.said == []
        sweep, data = shown("hydrolinkage.sweep()"), shown("hydrolinkage.data")
        along, values = np.array(sweep["along"]), np.array(sweep["values"])
        assert (along[0], along[-1]) == (1.0, 9.0) and not any(sweep["reason"]) and len(along) == 105
        at_places = np.searchsorted(along, np.arange(1.0, 9.5))
        assert_allclose(along[at_places], np.arange(1.0, 10.0), rtol=0, atol=1e-12)
        for name, (x_row, y_row) in zip(data["scene"]["names"], data["rows"]["points"], strict=True):
            assert_allclose(values[[x_row, y_row]][:, at_places], np.broadcast_to(motion[name], (2, 9)), rtol=0, atol=1e-12)
        rows = {each[0]: each[2] for each in data["columns"]}
        pressures = driving_force(motion, drive="lift") / (0.25 * np.pi * 0.09**2)
        assert pressures.min() > 0.0
        assert_allclose(values[rows["pressure"], at_places], pressures, rtol=1e-9)
        for share, place in ((0.0, 1.0), (500.0, 5.0), (1000.0, 9.0)):
            shown.slide('[data-stroke="along the path"]', share)
            at = {name: float(value[int(place) - 1]) for name, value in motion.strokes.items()}
            assert shown.state["at"] == pytest.approx({**at, "along the path": place}, rel=0, abs=1e-12)
            assert_allclose(shown("hydrolinkage.points()")["E"], motion["E"][:, int(place) - 1], rtol=0, atol=1e-12)
        assert shown("document.getElementById('run').selectedOptions[0].textContent") == "place"
        told = shown("hydrolinkage.verdicts()")
        assert told[0]["rule"] == "assembly" and told[0]["ok"] is True
        told = {each.rule: each.sentence for each in LevelLoader(OB=1.11).verdicts(motion) if each.is_rule}
        assert [each[2] for each in data["verdicts"] if each[1] in told] == [*told.values()]


@pytest.mark.slow
def test_a_stroke_of_its_own_leaves_the_path_and_the_link_restores_the_place(chromium, tmp_path):
    motion = level_lift()
    with Shown(chromium, page(motion, tmp_path / "follow.html")) as shown:
        shown.slide('[data-stroke="along the path"]', 250)
        shown.rest(400)
        mark, before = shown("location.hash"), shown.state["at"]
        assert before["along the path"] == 3.0
        shown.slide('[data-stroke="push"]', 500)
        assert shown.state["at"] == pytest.approx({**before, "push": 0.8}) and shown("document.getElementById('run').value") == "3"
        shown.slide('[data-stroke="lift"]', 500)
        assert shown.state["at"] == pytest.approx({**before, "push": 0.8, "lift": 1.05})
        assert shown("document.getElementById('run').value") == "0"
        assert "lift, mm" in shown("document.getElementById('curve').textContent")
        shown.slide('[data-stroke="along the path"]', 250)
        assert shown.state["at"] == pytest.approx({**before, "push": 0.8})
        shown.tab.locator("#language").click()
        assert shown("document.querySelector('.stroke span').textContent") == "\u043c\u0435\u0441\u0442\u043e"
        assert shown.said == []
    with Shown(chromium, tmp_path / "follow.html", mark=mark) as shown:
        assert shown.state["at"] == pytest.approx(before)


@pytest.mark.slow
def test_a_path_that_is_reached_in_part_keeps_the_numbers_of_its_places():
    motion = level_lift(top=2.9, unreachable="nan")
    count = int(motion.reached.sum())
    assert 3 < count < 9
    *_, along = data_of(page_html(motion))["strokes"]
    assert (along["start"], along["end"]) == (1, count) and along["turn"] == 0
    assert along["path"]["0"] == motion.strokes["lift"][:count].tolist()
    back = motion.moved({name: values[::-1] for name, values in motion.strokes.items()})
    *_, along = data_of(page_html(back))["strokes"]
    assert (along["start"], along["end"]) == (10 - count, 9)


@pytest.mark.slow
def test_several_strokes_that_run_together_are_a_path():
    machine = LevelLoader()
    data = data_of(page_html(machine, at={"lift": [0.9, 1.1, 0.9], "dump": [0.8, 0.9, 0.8], "push": 0.8}, count=11))
    *_, along = data["strokes"]
    assert along["path"] == {"0": [0.9, 1.1, 0.9], "1": [0.8, 0.9, 0.8]} and along["turn"] == 1 and data["count"] == 11
    assert data["verdicts"] == data_of(page_html(machine))["verdicts"]


def test_what_is_no_path_has_no_page(tmp_path):
    machine, file = LevelLoader(), tmp_path / "path.html"
    for motion, said in (
        (machine.at(lift=1.0, dump=0.9, push=0.8), r"of shape \(\)"),
        (machine.at(lift=[[1.0], [1.1]], dump=[0.9, 1.0], push=0.8), r"of shape \(2, 2\)"),
        (LevelLoader(OB=[1.1, 1.12]).at(lift=[1.0, 1.1], dump=0.9, push=0.8), "one design along one path"),
        (machine.at(lift=[1.0, 1.0], dump=0.9, push=0.8), "nothing moves along this motion"),
        (machine.at(lift=[9.0, 9.1], dump=0.9, push=0.8, unreachable="nan"), "0 places in reach"),
    ):
        with pytest.raises(DefinitionError, match=said):
            page(motion, file)
    with pytest.raises(DefinitionError, match="a motion has its own way"):
        page(level_lift(), file, at={"lift": 1.0})
    assert not file.exists()


# -- names and values on the sheet ---------------------------------------------------------------------------

TEXTS = (
    "[...document.querySelectorAll('#mechanism .name-of, #mechanism .force')].filter((each) => each.textContent"
    " && each.getAttribute('visibility') === 'visible').map((each) => [each.textContent, ...(({ x, y, width, height }) =>"
    " [x, y, x + width, y + height])(each.getBBox())])"
)
PINS = (
    "[...document.querySelectorAll('#mechanism .grip')].map((each) => [Number(each.getAttribute('cx')), Number(each.getAttribute('cy'))])"
)


def test_names_and_values_cover_neither_each_other_nor_pins_nor_the_edge(chromium, written):
    for machine, size in ((ThreePointHitch(), LAPTOP), (Digger(), LAPTOP), (Digger(), (760, 620))):
        with Shown(chromium, written(machine), size) as shown:
            shown.tab.locator("#forces").click()
            for share in (0, 350, 800):
                shown.slide("#strokes input", share)
                texts, pins = shown(TEXTS), shown(PINS)
                assert sum("N" in text for text, *_ in texts) >= 4 and sum(text in machine.plan.points for text, *_ in texts) >= 4
                wide, tall = shown("(({ width, height }) => [width, height])(document.getElementById('mechanism').getBoundingClientRect())")
                for k, (text, *box) in enumerate(texts):
                    assert box[0] >= 0 and box[2] <= wide and box[1] >= 0 and box[3] <= tall, text
                    low, high = np.array(box[:2]), np.array(box[2:])
                    air = (high - low) * [0.25, 0.3]
                    assert not [pin for pin in pins if np.all((low + air < pin) & (pin < high - air))], text
                    for other, *there in texts[:k]:  # letters are lower than their boxes by a fifth above and below
                        apart = max(box[0] - there[2], there[0] - box[2], box[1] - there[3] + 0.4 * 14, there[1] - box[3] + 0.4 * 14)
                        assert apart >= 0, (text, other, share)
            assert shown.said == []


def boxes(shown, selector):
    """Return left, top, right, bottom [px] of what is drawn on the sheet, from its upper left corner; arrows have a title."""
    found = f"[...document.querySelectorAll('#mechanism {selector}')].filter((each) => each.getAttribute('d') !== '')"
    sheet = "document.getElementById('mechanism').getBoundingClientRect()"
    return np.array(
        shown(
            f"(({{ x, y }}) => {found}.map((each) => each.getBoundingClientRect())"
            f".map(({{ left, top, right, bottom }}) => [left - x, top - y, right - x, bottom - y]))({sheet})"
        )
    )


@for_all(
    ("machine", "size"),
    [(Hanging, LAPTOP), (Digger, PHONE)],
    slow=[(Hanging, PHONE), (ThreeHeaders, PHONE), (ThreeHeaders, LAPTOP), (Digger, LAPTOP)],
)
def test_no_arrow_leaves_the_sheet_and_no_two_lines_of_the_legend_touch(chromium, written, machine, size):
    with Shown(chromium, written(machine()), size) as shown:
        shown.tab.locator("#forces").click()
        wide, tall = shown("(({ width, height }) => [width, height])(document.getElementById('mechanism').getBoundingClientRect())")
        for share in (0, 500, 1000):
            shown.slide("#strokes input", share)
            arrows = boxes(shown, "path:has(title)")
            assert len(arrows) > 3 and np.all(arrows >= 0) and np.all(arrows[:, 2:] <= [wide, tall]), share
        for (a, b, c, d), (left, top, right, bottom) in combinations(boxes(shown, "text.halo:not(.force)"), 2):
            assert a >= right or left >= c or b + 3 >= bottom - 3 or top + 3 >= d - 3


def test_on_a_phone_the_name_and_the_forces_of_what_is_touched_are_told(chromium, written):
    machine = ThreePointHitch()
    with Shown(chromium, written(machine), PHONE, has_touch=True) as shown:
        shown.tab.locator("#forces").click()
        shown.settle()
        assert shown(TEXTS) == []
        box = shown("(({ x, y }) => [x, y])(document.getElementById('mechanism').getBoundingClientRect())")
        x, y = shown("['cx', 'cy'].map((each) => Number(document.querySelector('.grip[data-pin=\"B\"]').getAttribute(each)))")
        shown.tab.touchscreen.tap(box[0] + x, box[1] + y)
        shown.settle()
        told = [text for text, *_ in shown(TEXTS)]
        assert told == ["B", "59.6\N{THIN SPACE}kN on OBC from lift"]


def test_a_page_opens_on_the_cylinder_whose_verdict_is_worst():
    class Two(Mechanism):
        S, tilt = Stroke(0.0, 0.30), Stroke(0.0, 0.20)
        O, A = Ground(0.0, 0.6), Ground(0.35, 0.0)
        B = Dyad(A, O, AB=0.60 + S, OB=0.55, side=RIGHT)
        T, P = OnLink(O, B, OT=1.50), OnLink(O, B, OP=1.20, BOP=12 * deg)
        Q = Dyad(P, T, PQ=0.34 + tilt, TQ=0.30, side=LEFT)
        K = OnLink(T, Q, TK=0.50)
        load, bucket = Weight(T, mass=900), Weight(K, mass=250)
        lift = Cylinder(A, B, bore=63 * mm, rod=36 * mm, closed=0.6, stroke=0.3)
        ram = Cylinder(P, Q, bore=50 * mm, rod=28 * mm, closed=0.34, stroke=0.2)
        main, second = LiftCircuit(lift, pressure=180 * bar), LiftCircuit(ram, pressure=150 * bar)
        digging = Over.path(S=[0.0, 0.3], tilt=[0.05, 0.15])

    for design, name in ((Two(), "thrust ram"), (Two(**{"lift.bore": 0.045}), "1/reserve lift, %")):
        assert PageRequests(design, 5).column == name


@pytest.mark.slow
def test_a_group_with_a_rule_that_fails_has_one_heading_and_folds_what_is_kept(chromium, tmp_path):
    file = page(ThreePointHitch(**{"lift.rod": 0.02}), tmp_path / "rod.html")
    for size in (LAPTOP, PHONE):
        with Shown(chromium, file, size) as shown:
            shown.tab.locator("#groups details details").first.wait_for(state="attached")
            heads = shown("[...document.querySelectorAll('#groups > details > summary > b')].map((each) => each.textContent)")
            assert len(heads) == len({*heads}) > 1
            split = "[...document.querySelectorAll('#groups details details')]"
            assert shown(f"{split}.length") >= 1 and not any(shown(f"{split}.map((each) => each.open)"))
            assert not shown(f"{split}.some((each) => each.querySelector('.bad'))")
            assert shown(f"{split}.every((each) => each.parentElement.querySelector('li.bad'))")


def test_a_points_name_is_short_where_nothing_else_is_called_so():
    class Lone(Mechanism):
        phi = Stroke(0, 90 * deg)
        B = Ground(-0.3, 0)
        a = Part(FourBar, phi="phi", load=None)

    scene = scene_data(PageRequests(Lone(), 9).scene, {})
    shown = dict(zip(scene["names"], scene["letters"], strict=True))
    assert shown["a.A"] == "A" and shown["a.B"] == "a.B" and shown["B"] == "B"


# -- machines of parts ---------------------------------------------------------------------------------------


class Row(Mechanism):
    """Five four-bars in a row, driven together."""

    phi = Stroke(0, 360 * deg)
    a, b, c, d, e = (Part(FourBar, phi="phi", at=(0.8 * each, 0.0), load=None) for each in range(5))


class Pair(Row):
    """Two of them."""

    c = d = e = None


@pytest.mark.slow
def test_crowded_points_of_parts_go_by_the_letters_of_pictures(chromium, tmp_path):
    with Shown(chromium, page(Row(), tmp_path / "row.html")) as shown:
        drawn = draw(Row().at(phi=1.0))
        in_picture = {each.get_text() for each in drawn.axes[0].texts}
        names = shown("[...document.querySelectorAll('#mechanism .name-of')].map((each) => each.textContent)")
        assert len(set(names)) == len(Row.plan.points) and set(names) <= in_picture and {"B'", "B\u2074"} <= set(names)
        (legend,) = in_picture - set(names)
        lines = shown("[...document.querySelectorAll('#mechanism .letters')].map((each) => each.textContent)")
        assert "\u2003".join(lines).split("\u2003") == legend.split("   ")
        assert shown("hydrolinkage.data.scene.names") == list(Row.plan.points) and shown.said == []
    scene = data_of(page_html(Pair()))["scene"]
    assert "letters" not in scene and "a.B" in scene["names"]


# -- load charts -------------------------------------------------------------------------------------------


@cache
def digger_field():
    """Return a field with heights and radii out of order, of cells by each cylinder, tipping, and out of reach."""
    return working_field(LiftingDigger(), "K", [2.2, 0.6, 1.0, 1.4, 1.8], [0.8, -0.4, 0.0, 0.4], rule="ISO 14397-1")


def telehandler_field():
    """Return a field of a part's point with its angle kept, limited by the boom's cylinder and out of reach."""
    x, y = np.arange(1.0, 6.6, 1.1), np.arange(0.5, 7.0, 1.3)
    return working_field(Telehandler(), "forks.G", x, y, keep=[Target("forks.tilt", 0.0)], without=["forks.load"])


def robot_field():
    """Return a field of two cranks that a rated load limits alone."""
    return working_field(Robot(), "B", [0.5, 0.9, 1.1, 3.0], [0.5, 0.8, 1.0], limits={"rated load": 2e3})


@first_daily(0, "made", [digger_field, telehandler_field, robot_field])
def test_a_charts_page_has_the_numbers_of_its_field_and_the_poses_of_its_strokes(made):
    field = made()
    data = data_of(chart_page(field, "en"))
    cells = [(k, n) for k in np.argsort(-field.y) for n in np.argsort(field.x)]
    reached = [cell for cell in cells if field.reached[cell]]
    assert 0 < len(reached) < len(cells)
    assert data["x"] == sorted(field.x) and data["y"] == sorted(field.y, reverse=True)
    assert data["load"] == [None if np.isnan(load := field.load[cell]) else "\u221e" if np.isinf(load) else load for cell in cells]
    names = data["said"]["en"]["limiters"]
    assert [names[each] for each in data["limiter"]] == [field.limiter[cell] for cell in cells]
    for name, loads in field.of.items():
        found = np.array([np.inf if each == "\u221e" else each for each in data["of"][str(names.index(name))]], float)
        assert_array_equal(found, [loads[cell] for cell in cells])
    assert data["said"]["en"]["why"] == [field.why[cell] for cell in cells]
    assert all(bool(why) != bool(field.reached[cell]) for why, cell in zip(data["said"]["en"]["why"], cells, strict=True))
    strokes = {each["name"]: each["values"] for each in data["strokes"]}
    assert strokes == {name: [values[cell] for cell in reached] for name, values in field.strokes.items()}
    for pose, (k, n) in enumerate(reached):
        place = field.machine.at(**{name: values[pose] for name, values in strokes.items()})
        places = ([data["values"][row][pose] for row in pair] for pair in data["rows"]["points"])
        found = dict(zip(data["scene"]["names"], places, strict=True))
        for name, at in found.items():
            assert_allclose(at, place[name].ravel(), rtol=0, atol=1e-9)
        assert_allclose(found[field.point], (field.x[n], field.y[k]), rtol=0, atol=1e-8)


def test_a_charts_page_speaks_both_languages_and_shows_units_as_they_are_chosen():
    field = digger_field()
    with unit_system("us"):
        data, text = data_of(chart_page(field, "ru")), ChartText(field)
        assert data["loads"] == {"factor": text.load_size, "digits": 0} and data["said"]["en"]["unit"] == "lb"
        assert data["lengths"]["unit"] == data["strokes"][0]["unit"] == "in"
        assert data["said"]["en"]["terms"] == text.terms() and data["said"]["en"]["title"] == text.title
    data = data_of(chart_page(field, "ru"))
    assert data["language"] == "ru" and data["said"]["ru"]["unit"] == "\u0442"
    others = [each for each in (*data["said"]["ru"]["terms"], *data["said"]["ru"]["why"], data["said"]["ru"]["title"]) if each]
    assert all(re.search("[\u0430-\u044f]", each) for each in others)
    assert field.remarks == digger_field.__wrapped__().remarks and "past its end" in "".join(field.why.ravel())


def test_the_machine_stands_in_the_cell_that_is_pointed_at(chromium, chart):
    field, random = digger_field(), np.random.default_rng(8)
    text, cells = ChartText(field), [(k, n) for k in np.argsort(-field.y) for n in np.argsort(field.x)]
    with Shown(chromium, chart) as shown:
        assert shown.said == [] and len(shown.asked) == 1
        texts = shown("[...document.querySelectorAll('#chart td')].map((each) => each.textContent)")
        assert texts == [text.load_text(field.load[cell]) + text.letters.get(field.limiter[cell], "") for cell in cells]
        assert shown("hydrolinkage.data.load")[shown("hydrolinkage.cell()")] == np.nanmax(field.load)
        for i in random.permutation(len(cells))[:6].tolist():
            cell = k, n = cells[i]
            shown.tab.hover(f"#cell{i}")
            assert shown("hydrolinkage.cell()") == i
            assert shown.text("#place") == f"x = {text.length_text(field.x[n])}\u2009m, y = {text.length_text(field.y[k])}\u2009m"
            if not field.reached[cell]:
                assert shown.text("#load") == "out of reach" and shown.text("#why") == field.why[cell]
                assert shown("document.getElementById('mechanism').dataset.away") == "1"
                continue
            assert shown.text("#load b") == f"{text.load_text(field.load[cell])}\u2009t" and str(field.limiter[cell]) in shown.text("#load")
            rows = shown("[...document.querySelectorAll('#of tr')].map((row) => row.lastChild.textContent)")
            assert rows == [f"{text.load_text(loads[cell])}\u2009t" for loads in field.of.values()]
            motion = field.machine.at(**{name: values[cell] for name, values in field.strokes.items()})
            for name, place in shown("hydrolinkage.points()").items():
                assert_allclose(place, motion[name].ravel(), rtol=0, atol=1e-9)
        shown("hydrolinkage.point(0)")
        for key, cell in (("ArrowRight", 1), ("ArrowDown", 6), ("ArrowUp", 1), ("ArrowUp", 1), ("End", 4), ("ArrowRight", 4), ("Home", 0)):
            shown.tab.keyboard.press(key)
            assert shown("hydrolinkage.cell()") == cell
        where = shown(  # the place of a cell beside the machine is pointed at, too
            "(() => { const dot = document.querySelectorAll('#mechanism .field circle')[7].getBoundingClientRect();"
            " return [dot.x + dot.width / 2, dot.y + dot.height / 2]; })()"
        )
        shown.tab.mouse.move(*where)
        assert shown("hydrolinkage.cell()") == 7
        assert shown("document.documentElement.scrollWidth") <= LAPTOP[0]


def test_a_cell_is_pointed_at_by_a_finger(chromium, chart):
    with Shown(chromium, chart, PHONE, has_touch=True, is_mobile=True) as shown:
        shown.tab.locator("#cell3").tap()
        assert shown("hydrolinkage.cell()") == 3 and shown("document.documentElement.scrollWidth") <= PHONE[0]
        shown.tab.locator("#language").tap()
        assert "\u0433\u0440\u0443\u0437\u043e" in shown.text("h1") and shown.said == []


def test_what_does_not_go_with_a_chart_is_refused(tmp_path):
    field = digger_field()
    for options in ({"vary": ["OB"]}, {"at": {"lift": 0.8}}, {"count": 5}, {"trace": ["K"]}):
        with pytest.raises(DefinitionError, match="page of a working field has its cells"):
            page(field, tmp_path / "chart.html", **options)
    with pytest.raises(DefinitionError, match="'de' is unknown"):
        page(field, tmp_path / "chart.html", language="de")
    with pytest.raises(DefinitionError, match=r"one that ends in \.html"):
        page(field, tmp_path / "chart.pdf")
    assert not any(tmp_path.iterdir())


# -- all machines ------------------------------------------------------------------------------------------


def opens(chromium, machine, file):
    """Open a machine's page, change a dimension, and hold it against Python."""
    with Shown(chromium, page(machine, file)) as shown:
        assert shown.said == [] and len(shown.asked) == 1
        for name, place in shown("hydrolinkage.points()").items():
            at = {stroke: shown.state["at"][stroke] for stroke in machine.strokes}  # without the places on its paths
            assert_allclose(place, machine.at(unreachable="nan", **at)[name].ravel(), rtol=0, atol=1e-12)
        assert shown("hydrolinkage.timing.most") >= 0
        assert not re.search(r"-0\.0+(?!\d)|NaN|undefined|Infinity", shown.text("body"))
        assert shown("document.documentElement.scrollWidth") <= LAPTOP[0]


@first_daily(1, "name", ["jansen", *(name for name in registered() if name != "jansen")])
def test_every_shipped_machine_opens(chromium, name, tmp_path):
    opens(chromium, find(name)(), tmp_path / "machine.html")


@first_daily(1, "kind", [Truck, Digger])
def test_axle_loads_are_arrows_of_the_page(kind):
    """By the page's own requests, in another design: the reactions at the supports, and what holds the vehicle along the ground."""
    design, strokes = kind(**{"G.x": -0.1, "F.x": 1.7}), {"S": [0.05, 0.2], "s": 0.1}
    arrows = PageRequests(kind(), 5, at={"s": 0.1}).arrows
    found = standing(design.at(**strokes))
    places = {name: name_of(getattr(kind, name).point) for name in found.reactions}
    pushes = [each for each in arrows if each.point in places.values() and not each.is_load]
    values = np.array(design.evaluate([part for each in pushes for part in each.parts.values()], **strokes)).reshape(len(pushes), 2, 2)
    wanted = [*found.forces.values(), found.brakes]
    assert [each.point for each in pushes] == [*places.values(), next(iter(places.values()))]
    assert_allclose(values, wanted, rtol=1e-12, atol=1e-9)
