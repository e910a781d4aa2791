"""The balanced header's figures, its measured values and its command."""

import csv

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import DefinitionError, FileError
from linkage.cli import main
from linkage.units import bar, kgf, kgf_cm2, mm
from mechanisms.header_balancer import FIGURES, ImprovedBalancer, deviations, figure, over_following, read_measured, with_header
from mechanisms.header_balancer.following import HeaderState
from tests.for_all import for_all


def balance(*arguments):
    """Return the exit code of the command."""
    return main(["balance", *arguments])


def lines(shown):
    """Return the curves of a figure by their label, x and y."""
    (ax,) = shown.axes
    return {line.get_label(): line.get_xydata().T for line in ax.get_lines()}


HALVES = [number for number in FIGURES if len(number) == 2 or number == "7"]
AGAIN = ("4a", "5a", "5b", "6b")  # as 2a and 4b are, of other headers


@for_all("number", [number for number in HALVES if number not in AGAIN], slow=AGAIN)
def test_each_figure_shows_what_the_paper_shows_under_its_number(number):
    shown = lines(figure(number))
    machine = ImprovedBalancer() if number[0] == "6" else with_header({"4": 2, "5": 3}.get(number[0], 1))
    found = HeaderState(over_following(machine.at(h=0.0)))
    plain = [found.reaction(way, 0.15) - found.reaction(way, 0.0) for way in ("extending", "retracting")]
    expected = {
        "2a": {"moving up": found.up / 2, "without friction": found.free / 2, "moving down": found.down / 2},
        "2b": {"moving up": plain[0] / 2, "moving down": plain[1] / 2},
        "3a": {"in the accumulators": found.pressure},
        "4b": {"in the accumulators": found.pressure, "needed: the shoes carry nothing": found.required},
        "7": {"moving up": found.up / 2, "moving down": found.down / 2},
    }  # fmt: skip
    expected |= {each: expected["2a"] for each in ("4a", "5a", "6a")} | {each: expected["4b"] for each in ("5b", "6b")}
    if number == "3b":
        whole = HeaderState(found.motion.moved({"h": np.linspace(found.motion.strokes["h"][0], 0.45, 101)}))
        found, expected["3b"] = whole, {"moving up": whole.required_while("extending"), "moving down": whole.required_while("retracting")}
    for label, values in expected[number].items():
        assert_allclose(shown[label][0], found.height / mm)
        assert_allclose(shown[label][1], values / (kgf_cm2 if ("b" in number and number != "2b") or number == "3a" else kgf))


def test_a_number_alone_is_both_halves_side_by_side():
    sheet = figure(5)
    assert [ax.get_title(loc="left").split("   ")[0] for ax in sheet.axes] == ["5 a", "5 b"]
    for ax, half in zip(sheet.axes, ("5a", "5b"), strict=True):
        alone = lines(figure(half))
        for line in ax.get_lines():
            if not line.get_label().startswith("_"):
                assert_allclose(line.get_xydata().T, alone[line.get_label()])


def test_the_seals_alone_leave_out_every_pin():
    shown, plain = lines(figure("2a", with_header(1, **{"pin_O.coefficient": 0.15}))), lines(figure("2a"))
    for label in ("moving up", "moving down"):
        assert_allclose(shown[label], plain[label], rtol=1e-9)


def test_the_kink_is_marked_where_the_pair_joins():
    (ax,) = figure("5b").axes
    (mark,) = [line for line in ax.get_lines() if line.get_marker() == "o"]
    height, pressure = mark.get_xydata()[0]
    assert (height, pressure) == pytest.approx((0.0, 50.0), abs=1e-6)  # charged to 50 at the horizon
    assert not [line for line in figure("4b").axes[0].get_lines() if line.get_marker() == "o"]


def test_the_improved_mechanism_stands_beside_the_present_one():
    shown, present = lines(figure("6a")), HeaderState(over_following(with_header(1).at(h=0.0)))
    assert_allclose(shown["as it stands, moving up"][1], present.up / kgf / 2)
    assert "as it stands, moving up" not in lines(figure("6a", with_header(1)))


def test_the_papers_way_is_laid_over_the_reaction():
    apart = [label for label in lines(figure("2a")) if label.startswith("the paper's gas law")]
    assert len(apart) == 1
    assert not [label for label in lines(figure("2a", with_header(1, atmosphere=0.0))) if label.startswith("the paper's")]


def test_the_scheme_says_the_pressures_of_the_machine_it_is_of():
    machine = with_header(3, V_II=0.0)
    texts = [text.get_text() for text in figure(1, machine).axes[0].texts]
    parts = [("gauge", "charge"), ("pump", "pump"), ("relief valve", "valve")]
    assert {"tank", "valve", *(f"{part}\n{machine[name] / kgf_cm2:.4g} kgf/cm²" for part, name in parts)} <= set(texts)
    assert "accumulators\n4 l, gas at 50 kgf/cm²" in texts


@pytest.mark.parametrize("number", ["1a", "2c", "8", "7a"])
def test_unknown_figure(number):
    with pytest.raises(DefinitionError, match="1, 2, 2a, 2b, 3, 3a, 3b, 4, 4a, 4b, 5, 5a, 5b, 6, 6a, 6b, 7"):
        figure(number)


def written(path, rows, delimiter=","):
    with open(path, "w", newline="", encoding="utf-8") as stream:
        csv.writer(stream, delimiter=delimiter).writerows(rows)
    return path


def test_measured_values_are_compared_in_percent(tmp_path):
    motion = over_following(with_header(2).at(h=0.0), 5)
    calculated = HeaderState(motion)
    rows = [["R_y, mm", "F_R up, kgf", "P [bar]", "remark"]]
    rows += [[*row, "x"] for row in zip(calculated.height / mm, 1.05 * calculated.up / kgf, 0.98 * calculated.pressure / bar, strict=True)]
    up, pressure = deviations(motion, read_measured(written(tmp_path / "m.csv", rows)))
    assert (up.curve, pressure.curve) == ("F_R up", "P")
    assert_allclose(up.percent, 5.0, rtol=1e-6)
    assert_allclose(pressure.percent, -2.0, rtol=1e-6)
    assert up.verdict and "+5.0 %" in up.verdict.sentence


def test_too_large_a_deviation_fails_and_is_drawn(tmp_path):
    machine = with_header(2)
    motion = over_following(machine.at(h=0.0), 3)
    height, down = HeaderState(motion).height, HeaderState(motion).down
    rows = [f"{R / mm:.6f};{1.10 * F / kgf:.6f}".replace(".", ",") for R, F in zip(height, down, strict=True)]
    (tmp_path / "m.csv").write_text("\n".join(["R_y, mm;F_R down, kgf", *rows, "0;", ""]), encoding="utf-8")
    (found,) = deviations(motion, read_measured(tmp_path / "m.csv"))
    assert len(found.percent) == 3
    assert not found.verdict and "above the paper's 7 %" in found.verdict.sentence
    assert abs(found.percent[0]) < 1.0  # next to hang-up percent are of a tenth of the curve's largest
    for number in (7, "4a"):
        shown = lines(figure(number, machine, [found]))
        label = next(label for label in shown if label.startswith("measured"))
        assert_allclose(shown[label], [height / mm, 1.10 * down / kgf / 2], rtol=1e-4, atol=1e-3)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("R_y, mm\n", "at least one of numbers"),
        ('"R_y, mm","F_R up, kgf"\n1,two\n', "in line 2 'two' is no number"),
        ('"R_y, mm","F_R up, kgf"\n1,inf\n', "in line 2 'inf' is no number"),
        ('"R_y, kgf","F_R up, kgf"\n1,2\n', "R_y, kgf: kgf measures force; use one of m, mm"),
        ('"R_y, mm","speed, m"\n1,2\n', "one of F_R up"),
    ],
)
def test_a_bad_file_is_refused_with_its_line(tmp_path, text, words):
    (tmp_path / "m.csv").write_text(text, encoding="utf-8")
    with pytest.raises(FileError, match=words):
        read_measured(tmp_path / "m.csv")


@pytest.mark.slow
def test_the_command_prints_table_and_verdicts(capsys):
    assert balance("header_balancer", "--header", "2", "--pressure", "40kgf_cm2", "--count", "3") == 0
    shown = capsys.readouterr().out
    assert "Charged to 40.00 kgf/cm2" in shown
    assert "the shoe lifts off moving down; lower the charge by 6.08 kgf/cm2" in shown
    assert "P_req, kgf/cm2" in shown


@pytest.mark.slow
def test_the_command_writes_csv_and_a_figure(capsys, tmp_path):
    table, drawn = tmp_path / "t.csv", tmp_path / "f.png"
    assert balance("header_balancer", "--header", "1", "--csv", str(table), "--figure", "3b", "-o", str(drawn)) == 0
    with open(table, newline="", encoding="utf-8") as stream:
        rows = list(csv.reader(stream))
    heading, first = rows[0], rows[1]
    assert len(rows) == 14 and heading[:2] == ["h, mm", "R_y, mm"]
    assert float(first[1]) == pytest.approx(-150.0)
    assert drawn.stat().st_size > 10_000


@pytest.mark.slow
def test_the_command_charges_for_a_reaction_and_lists_settings(capsys):
    assert balance("header_balancer", "--header", "3", "--reaction", "300kgf", "--table") == 0
    shown = capsys.readouterr().out
    table, _, verdicts = shown.partition("Header 3 alone. Charged to 48.56 kgf/cm2")
    assert "charge 3, kgf/cm2" in table and "no hang-up" not in table
    assert "2 no hang-up, slow" in verdicts and "charge 1, kgf/cm2" not in verdicts


def test_the_table_of_all_headers_says_nothing_of_one(capsys):
    assert balance("header_balancer", "--table") == 0
    shown = capsys.readouterr().out
    assert all(f"safe {number}" in shown for number in (1, 2, 3))
    assert not any(word in shown for word in ("Charged to", "no hang-up", "FAIL", "ok "))


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("header_balancer", "--pressure", "40"), "say the unit too"),
        (("header_balancer", "--pressure", "40kg"), "pressure"),
        (("header_balancer", "--pressure", "nan"), "not a value"),
        (("header_balancer", "--pressure=-5bar"), "charge = -500000 is not above zero"),
        (("header_balancer", "--pressure", "20kgf_cm2"), "rigid"),
        (("header_balancer", "--pressure", "40bar", "--reaction", "300kgf"), "give one of them"),
        (("header_balancer", "--header", "7"), "invalid choice"),
        (("header_balancer", "--figure", "1"), "invalid choice"),
        (("header_balancer", "--set", "follows=2m"), "cannot be -2000 mm"),
        (("header_balancer", "-o", "picture.doc"), "ends in one of"),
        (("header_balancer", "--measured", "nowhere.csv"), "nowhere.csv: there is no such file"),
        (("mower_lift",), "no balanced header"),
    ],
    ids=" ".join,
)
def test_a_users_mistake_is_one_line(capsys, arguments, words):
    assert balance(*arguments) == 2
    error = capsys.readouterr().err
    assert words in error and error.count("\n") == 1


def test_measured_curve_of_one_pose_with_no_values_is_left_out():
    assert deviations(with_header(1).at(h=0.0), {"R_y": np.array([0.0]), "F_R up": np.array([np.nan])}) == []
