"""What a new user does with a page, by clicks and keys alone: five tasks on machines with cylinders and axles, against Python."""

import re
from pathlib import Path

import pytest

from hydraulics import Cylinder, LiftCircuit, standard_bores
from linkage import LEFT, RIGHT, Dyad, Featured, Ground, Link, Mechanism, OnLink, Over, Stroke, deg, page, ramp
from linkage.cli import main
from linkage.loads import LinkMass, LoadCase, Support, Weight
from linkage.units import bar, mm
from mechanisms.at_work.excavator import Excavator
from mechanisms.at_work.levelled import LevelledTelehandler
from mechanisms.header_balancer import HeaderBalancer
from tests.for_all import first_daily
from tests.linkage.pictures.test_in_seconds import LoadedLever
from tests.linkage.pictures.test_page import PHONE, Shown

DESKTOP = (1440, 900)


class Stacker(Mechanism):
    """A boom on a frame with two axles; cylinder AB lifts it, CD turns the fork about T."""

    S = Stroke(0.0, 0.40)
    s = Stroke(0.0, 0.30)
    O, A = Ground(-0.4, 1.3), Ground(0.0, 0.55)
    B = Dyad(A, O, AB=0.82 + S, OB=0.95, side=RIGHT)
    C = OnLink(O, B, OC=1.1, BOC=8 * deg)
    T = OnLink(O, B, OT=2.3, BOT=-4 * deg)
    D = Dyad(C, T, CD=0.98 + s, TD=0.30, side=LEFT)
    X = OnLink(T, D, TX=0.9, DTX=-100 * deg)
    boom, fork = Link(O, B, C, T), Link(T, D, X)
    front, rear, G = Ground(0.3, 0.0), Ground(-1.5, 0.0), Ground(-0.9, 0.7)
    frame = Weight(G, mass=2600)
    steel = LinkMass(boom, mass=180, at=(1.0, 0.0))
    load = Weight(X, mass=500)
    lift = Cylinder(A, B, bore=80 * mm, rod=45 * mm, closed=0.82, stroke=0.40)
    tilt = Cylinder(C, D, bore=63 * mm, rod=36 * mm, works="both", closed=0.98, stroke=0.30)
    lift_line = LiftCircuit(lift, pressure=180 * bar, relief=200 * bar)
    tilt_line = LiftCircuit(tilt, pressure=180 * bar, relief=200 * bar)
    front_axle, rear_axle = Support(front, (0, 1), friction=0.6), Support(rear, (0, 1), friction=0.5)
    downhill = LoadCase(slope=-6 * deg)
    work = Over(S=(0.0, 0.40), s=(0.05, 0.25))
    loading = Over.path(S=[0.0, 0.2, 0.4], s=[0.05, 0.12, 0.2], cases=["downhill"])
    about = Featured("X_y", ["X", "B"])


def typed(shown, name, value):
    """Look for a dimension and give it a value [of its unit], as a user types them."""
    if not shown.tab.locator(f"[data-size='{name}']").count():
        shown.find(name)
    box = shown.tab.locator(f".size:has([data-size='{name}']) input[type='text']")
    box.fill(str(value))
    box.press("Enter")
    rested(shown)


def rested(shown):
    shown.settle()
    shown.rest(600)


def fails_of(shown):
    return int(shown("document.getElementById('badge').dataset.fails"))


def standing(shown):
    return {name: pytest.approx(value, abs=2e-4) for name, value in shown.state["at"].items()}


def goes_to_the_worst(shown, machine):
    """Unfold the first group of the list, and go to the first place in it: it is where Python says the rule is worst."""
    shown.tab.locator("#badge").click()
    group = shown.tab.locator("#groups > details").first
    if not group.evaluate("(each) => each.open"):
        group.locator("summary").first.click()
    text = group.locator("li:has(.place)").first.inner_text()
    group.locator(".place").first.click()
    rested(shown)
    told = [each for each in machine.verdicts() if each.answer is not None and each.answer.strokes]
    at = standing(shown)
    assert [each for each in told if all(at[name] == value for name, value in each.answer.strokes.items())], text


def mends(shown, rule, by):
    """Ask a rule that fails which one dimension keeps it, and take one that is offered: one rule fails less."""
    before, row = fails_of(shown), shown.tab.locator("#groups li.bad", has_text=rule).first
    row.locator("button", has_text="Which one dimension keeps it?").click()
    offered = row.locator("p button")
    taken = offered.all_inner_texts()
    assert len(set(each.partition(" = ")[0] for each in taken)) == len(taken) > 0
    assert by in [each.partition(" = ")[0] for each in taken], taken
    (own,) = (k for k, each in enumerate(taken) if each.startswith(f"{by} = "))
    if by.endswith(".bore"):  # a size of the standard, and the exact one beside it
        size, sign, exact = re.fullmatch(r".* = (\S+)\smm(?: \(([\u2265\u2264]) (\S+)\smm\))?", taken[own]).groups()
        assert float(size) / 1e3 == pytest.approx(min(standard_bores(), key=lambda each: abs(each - float(size) / 1e3)), rel=1e-12), taken
        assert sign is None or (float(exact) < float(size)) == (sign == "\u2265"), taken
    offered.nth(own).click()
    rested(shown)
    assert fails_of(shown) < before, taken
    return taken[own]


def taken_home(shown, kind, folder, capsys):
    """Take the change home as Python and as TOML, and run both: their dimensions are the page's. Return the design."""
    texts = {}
    for form in ("python", "toml"):
        shown.tab.locator(f"#as-{form}").click()
        texts[form] = shown.tab.locator("#text").input_value()
    exec(texts["python"], names := {})
    found = names["machine"]
    (folder / "design.toml").write_text(texts["toml"])
    own = [] if kind.__module__.startswith("mechanisms") else ["--machine", f"{Path(__file__)}:{kind.__name__}"]
    code = main(["show", str(folder / "design.toml"), *own])
    said, error = capsys.readouterr()
    assert code in (0, 1), error
    assert len(re.findall(r"(?m)^ *FAIL", said)) == sum(each.ok is False for each in found.verdicts())
    for name, value in shown.state["design"].items():
        assert found[name] == pytest.approx(value, rel=1e-6, abs=1e-9), name
    return found


def compares(shown, name, value):
    """Keep two designs: the table shows what differs, and on which rules."""
    shown.tab.locator("#keep").click()
    typed(shown, name, value)
    shown.tab.locator("#keep").click()
    rested(shown)
    heads = shown.tab.locator("#kept tr th[scope='row']").all_inner_texts()
    assert name in [each.partition(",")[0] for each in heads] and len(heads) > 2
    assert shown("document.documentElement.scrollWidth <= innerWidth")


def check_tasks(shown, kind, change, rule, by, other, folder, capsys):
    goes_to_the_worst(shown, kind())
    typed(shown, *change)
    assert fails_of(shown)
    mended = mends(shown, rule, by)
    found = taken_home(shown, kind, folder, capsys)
    fails = [each for each in found.verdicts() if each.ok is False and each.answer is not None and each.rule.startswith(rule)]
    assert len(fails) == shown.tab.locator("#groups li.bad", has_text=f"{rule}: ").count(), (mended, fails)
    compares(shown, *other)
    assert shown.said == []


@pytest.fixture(scope="module")
def own(tmp_path_factory):
    return page(Stacker(), tmp_path_factory.mktemp("own") / "own.html")


@first_daily(1, "size", [DESKTOP, PHONE])
def test_five_tasks_are_done_on_ones_own_machine(chromium, own, size, tmp_path, capsys):
    with Shown(chromium, own, size) as shown:
        check_tasks(shown, Stacker, ("load.mass", 1100), "lifting", "tilt.bore", ("load.mass", 700), tmp_path, capsys)


def test_what_tips_is_told_with_its_place_and_case_and_its_arrow_is_red(chromium, own):
    """A box is looked at in two load cases: its place is shown in the one in which the verdict stands."""
    with Shown(chromium, own, DESKTOP) as shown:
        shown.tab.locator("#forces").click()
        typed(shown, "load.mass", 1500)
        row = shown.tab.locator("#groups li.bad", has_text="tipping")
        said = row.inner_text()
        row.locator(".place").click()
        rested(shown)
        (told,) = [each for each in Stacker(**{"load.mass": 1500.0}).verdicts() if each.ok is False and each.member == "rear_axle"]
        assert standing(shown) == {"loading": pytest.approx(1.0, abs=3.0)} | {
            k: pytest.approx(v, abs=0.02) for k, v in told.answer.strokes.items()
        }
        force = f"{-told.answer.value / 1e3:.4g}"
        assert force in said and "in the case downhill" in said
        assert re.search(rf"axle load rear_axle \u2212{force}\u2009kN \(downhill\)", shown.text("#here"))
        red = shown("[...document.querySelectorAll('#mechanism path')].filter((each) => each.getAttribute('fill') === 'var(--hot)').length")
        assert red == 1 and "downhill" in shown("document.getElementById('curve').textContent")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("kind", "change", "rule", "by", "other"),
    [
        (Excavator, ("tool.line.pressure", 150), "lifting", "arm.J.x", ("boom.BD", 1080)),
        (LevelledTelehandler, ("load.mass", 4500), "axle load", "front_axle.x", ("load.mass", 2800)),
        (HeaderBalancer, ("m1", 1100), "F_R free", "lift.bore", ("m2", 900)),
    ],
)
@pytest.mark.parametrize("size", [DESKTOP, PHONE])
def test_five_tasks_are_done_on_shipped_machines(chromium, kind, change, rule, by, other, size, tmp_path, capsys):
    with Shown(chromium, page(kind(), tmp_path / "shipped.html"), size) as shown:
        check_tasks(shown, kind, change, rule, by, other, tmp_path, capsys)


class Weak(Stacker):
    """The same with a cylinder of which a remedy is beyond its slider."""

    lift = Cylinder("A", "B", bore=32 * mm, rod=18 * mm, closed=0.82, stroke=0.40)
    loading = None


def test_dead_points_beyond_all_that_several_overs_run_are_pythons(chromium, own):
    design = {"TD": 0.301}
    with Shown(chromium, own, DESKTOP) as shown:
        typed(shown, "TD", 301)
        (said,) = [text for text in shown.told if text.startswith("dead points: ")]
    (told,) = [each.sentence for each in Stacker(**design).verdicts() if each.rule == "dead points"]
    texts = [said.replace("\u2212", "-").replace("\u2009", " "), told]
    numbers = [[float(each) for each in re.findall(r"-?\d+(?:\.\d+)?(?= mm)", text)] for text in texts]
    assert len(numbers[1]) == 4 and numbers[0] == pytest.approx(numbers[1], abs=0.6), texts
    assert len({re.sub(r"-?\d+(\.\d+)?", "#", text.removeprefix("dead points: ").rstrip(".")) for text in texts}) == 1, texts
    with Shown(chromium, own, DESKTOP) as shown:
        cases, load = shown.tab.locator("#case"), "load case: {}".format
        assert cases.locator("option").all_text_contents() == ["own loads", "downhill"]
        assert load("own loads") in shown.tab.locator("#curve").text_content()
        cases.select_option(label="downhill")
        rested(shown)
        assert load("downhill") in shown.tab.locator("#curve").text_content() and "case=downhill" in shown("location.hash")


class Falling(Mechanism):
    """A rocker of a few millimetres whose stroke is declared from high to low."""

    S = Stroke(1.0 * mm, 0.4 * mm)
    O, A = Ground(0, 0), Ground(1.0 * mm, 0)
    B = Dyad(A, O, AB=0.6 * mm + S, OB=1.1 * mm, side=RIGHT)


def test_a_slider_goes_from_low_to_high_and_places_are_as_fine_as_the_stroke(chromium, tmp_path):
    with Shown(chromium, page(Falling(), tmp_path / "falling.html"), DESKTOP) as shown:
        slider = shown.tab.locator("[data-stroke='S']")
        assert float(slider.input_value()) == 1000.0 and "it runs down" in shown.tab.locator("#curve").text_content()
        slider.fill("0")
        rested(shown)
        assert shown("hydrolinkage.state().at.S") == pytest.approx(0.0004)
        assert shown.tab.locator("#strokes input[type='text']").input_value() == "0.400\u2009mm"


class InSeconds(LoadedLever):
    """A lever on a pump that is too weak, lowered in time."""

    rub = None
    rise = Over.path(S=ramp(0.48, 0.32, speed=0.1, acceleration=0.5), cases=["plain", "full"])
    pump = LiftCircuit("lift", pressure=30 * bar)


def test_a_place_of_a_path_in_time_is_gone_to_at_its_instant(chromium, tmp_path):
    machine, gone, cases = InSeconds(), 0, set()
    (name,) = machine.plan.of_kind(Over)
    with Shown(chromium, page(machine, tmp_path / "in_seconds.html"), DESKTOP) as shown:
        for button in shown.tab.locator("#groups .place").all():
            before = button.evaluate("(one) => one.previousSibling.textContent")
            told = re.search(r"([\d.]+)\s*s \($", before)
            if told is None:
                continue
            button.evaluate("(one) => one.click()")
            rested(shown)
            assert shown(f"hydrolinkage.state().at['{name}']") == pytest.approx(float(told[1]), abs=1e-9), before
            assert "outside what is judged" not in shown.tab.locator("#here").text_content()
            gone += float(told[1]) > 0.5
            cases.add(case := shown("document.querySelector('#case').selectedOptions[0].textContent"))
            assert (f"in the case {case}" if case != "own loads" else "under its own loads") in before
        shown.tab.locator("#case").select_option(label="own loads")
        rested(shown)
        assert "load case: own loads" in shown.tab.locator("#curve").text_content()
    assert gone and "full" in cases


def test_one_count_of_what_fails_and_sizes_that_are_asked_for(chromium, own, tmp_path):
    """Where a design is lost in places; a text of which not all can be reached; a remedy beyond its slider."""
    with Shown(chromium, own, DESKTOP) as shown:
        shown("hydrolinkage.set({ design: { OB: 0.33 } })")
        rested(shown)
        shown.tab.locator("#keep").click()
        rested(shown)
        rows = shown("[...document.querySelectorAll('#kept tr')].map((row) => [...row.children].map((each) => each.textContent.trim()))")
        fails = shown("document.getElementById('badge').dataset.fails")
        assert ["assembly", "\u2715", "\u2713", "\u2715"] in rows and rows[-1][1] == rows[-1][3] == fails != rows[-1][2]
        crossed = [row[0] for row in rows[1:] if row[1].startswith("\u2715")]
        failing = {each.partition(":")[0] for each in shown.tab.locator("#groups li.bad").all_text_contents()}
        assert len(crossed) == len(failing) == int(fails), (crossed, failing)
        shown.tab.locator("#reset").click()
        shown.tab.locator("#text").fill("lift.bore=90mm OB=5m lift.rod=50mm")
        shown.tab.locator("#take").click()
        rested(shown)
        design = shown.state["design"]
        assert [design[name] for name in ("lift.bore", "lift.rod", "OB")] == pytest.approx([0.09, 0.05, 0.95], abs=1e-12)
        assert shown.text("#message").startswith("OB stays as it is: ")
    with Shown(chromium, page(Weak(), tmp_path / "weak.html"), DESKTOP) as shown:
        mends(shown, "holding", "lift.bore")
