"""Workbooks, tables and drawings for other programs: read back by others, worked out again, and held against the engine."""

import csv
import re
import sys
import tomllib
import warnings
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
import sympy
from numpy.testing import assert_allclose

from hydraulics import Cylinder, OilLine, Pump, Tank
from linkage import (
    LEFT,
    AssemblyError,
    Column,
    Crank,
    DefinitionError,
    Dimension,
    Dyad,
    FileError,
    Ground,
    Guide,
    LoadCase,
    Mechanism,
    OnGuide,
    Over,
    Part,
    PinFriction,
    Stroke,
    Weight,
    angle,
    equations,
    export,
)
from linkage.cli import main
from linkage.cli.machines import find
from linkage.exports.calculation import Calculation, live_results
from linkage.exports.drawing import Circle, Lettering, Measured, pose_parts
from linkage.exports.workbook import GIVEN, cell_names, formula, from_si, to_si
from linkage.pictures.layout import half_of, props
from linkage.pictures.scene import Scene
from linkage.reports import results, run_of, stroke_middles
from linkage.units import UNITS, bar, deg, kgf_cm2, mm
from mechanisms.at_work.excavator import Excavator
from mechanisms.at_work.telehandler import Telehandler
from mechanisms.classics.stephenson_two import StephensonTwo
from mechanisms.header_balancer import HeaderBalancer
from mechanisms.mower_lift import MowerLift
from mechanisms.three_point_hitch import ThreePointHitch
from tests import shipped
from tests.for_all import first_daily, for_all
from tests.linkage.exports.workbooks import by_office, drawing, needs_office, number_columns, row_of, same_numbers, stored, written
from tests.tools.sources import sources

POSES = 7
PAPERS = {"mower": MowerLift, "header": HeaderBalancer, "hitch": ThreePointHitch}
DAILY = first_daily(1, "name", PAPERS)
SHIPPED = shipped.MACHINES
CHANGED = {"hitch": ("OB", 0.305), "header": ("charge", 36 * kgf_cm2), "mower": ("OB", 0.176)}


class Turned(Mechanism):
    """A four-bar over two whole turns, its names such as spreadsheets take for places: R1, C, L0."""

    phi = Stroke(0.0, 4 * np.pi)
    L0 = Dimension(0.1, unit="mm")
    O, C = Ground(0.0, 0.0), Ground(0.3, 0.0)
    R1 = Crank(O, OR1=L0, angle=phi)
    B2 = Dyad(R1, C, R1B2=0.3, CB2=0.25, side=LEFT)
    turned = angle(O, R1)
    load = Weight(B2, mass=10)
    rubbing = PinFriction(O, radius=12 * mm, coefficient=0.1)

GIVEN_IN = {"Calculation": 4, "Results": 3}
"""The rows of sheets in which a column says that it is given."""


class Books(dict):
    """The workbooks of the papers' machines, each made when it is asked for."""

    def __missing__(self, name):
        return self.setdefault(name, export(PAPERS[name](), self["folder"] / f"{name}.xlsx", count=POSES))


@pytest.fixture(scope="module")
def books(tmp_path_factory):
    return Books(folder=tmp_path_factory.mktemp("books"))


@pytest.fixture(scope="module")
def iterated(tmp_path_factory):
    """The workbook of a machine with pins that are found together."""
    return export(StephensonTwo(), tmp_path_factory.mktemp("iterated") / "iterated.xlsx", count=7)


class Pair(Mechanism):
    """Two four-bars with loads, the second mirrored and driven the other way, and a rod of the machine's own between them."""

    phi = Stroke(0.1, 1.2)
    left = Part(Turned, phi="phi", rubbing=None)
    right = Part(Turned, phi=2 * phi, L0=0.11, at=(1.0, 0.2), mirrored=True, rubbing=None)
    M = Dyad("left.B2", "right.B2", left_B2M=0.8, right_B2M=0.8, side=LEFT)
    load = Weight(M, mass=5)


@pytest.fixture(scope="module")
def of_parts(tmp_path_factory):
    """The workbook of a machine of parts."""
    return export(Pair(), tmp_path_factory.mktemp("of_parts") / "parts.xlsx", count=9)


@pytest.fixture(scope="module")
def recalculated(iterated, of_parts, tmp_path_factory):
    """Workbooks as LibreOffice works them out, as they are and with a dimension changed, all in one run."""
    folder = tmp_path_factory.mktemp("recalculated")
    turned = export(Turned(), folder / "turned.xlsx", count=25)
    length = next(name for name in reversed(StephensonTwo().dimensions) if "." not in name)
    changes = {"iterated": (length, 1.01 * StephensonTwo().dimensions[length]), "parts": ("right.R1B2", 0.31)}
    return by_office(folder, {"turned": (turned, [])} | changed_too({"iterated": iterated, "parts": of_parts}, changes))


@pytest.fixture(scope="module")
def larger_recalculated(books, tmp_path_factory):
    """The workbooks of the papers likewise, under `slow`: it takes seconds for each."""
    return by_office(tmp_path_factory.mktemp("larger"), changed_too({name: books[name] for name in PAPERS}, CHANGED))


def changed_too(known, changes):
    """Return workbooks by name as they are, and with a dimension changed: the path and the changed cells of each."""
    plain = {name: (path, []) for name, path in known.items()}
    return plain | {f"{name} changed": (path, [new_value(path, *changes[name])]) for name, path in known.items()}


def new_value(path, dimension, value):
    """Return the cell of a dimension, and what is to be typed there for a value [SI]."""
    sheet = stored(path)["Dimensions"]
    row = row_of(stored(path), dimension)
    return "Dimensions", f"B{row}", sheet[f"B{row}"].value * value / sheet[f"D{row}"].value


# -- workbooks ---------------------------------------------------------------------------------------------


@DAILY
def test_values_in_the_workbook_are_the_engines(books, name):
    machine = PAPERS[name]()
    motion = machine.sweep(POSES)
    table = results(machine, motion)
    book = stored(books[name])
    assert [cell.value for cell in book["Results"][1]] == [column.name for column in table]
    assert [cell.value or "" for cell in book["Results"][2]] == [column.unit for column in table]
    for column, found in zip(table, number_columns(book["Results"], 4), strict=True):
        assert_allclose(found, column.shown, rtol=1e-12, atol=1e-12 * max(np.abs(column.shown).max(), 1.0), err_msg=column.name)
    points = {cell.value: place for place, cell in enumerate(book["Calculation"][2])}
    numbers = number_columns(book["Calculation"], 5)
    for point in motion.plan.moving:
        for axis in "xy":
            assert_allclose(numbers[points[f"{point}_{axis}"]], getattr(motion, axis)(point), rtol=0, atol=1e-12)


@DAILY
def test_every_result_of_the_papers_machines_is_a_formula(books, name):
    sheet = written(books[name])["Results"]
    plain = [cell.value for cell, first in zip(sheet[1], sheet[4], strict=True) if not str(first.value).startswith("=")]
    assert plain == (["of pin O"] if name == "header" else [])


@DAILY
def test_the_calculation_has_the_numbers_and_the_order_of_the_equations(books, name):
    sheet = written(books[name])["Calculation"]
    titles = [(cell.value, below.value) for cell, below in zip(sheet[1], sheet[4], strict=True) if cell.value and cell.value[-2].isdigit()]
    listed = [(f"({each.number})", str(each)) for each in equations(PAPERS[name])]
    assert list(dict.fromkeys(titles))[: len(listed)] == listed
    assert all(isinstance(cell.value, str) and cell.value.startswith("=") for row in sheet.iter_rows(min_row=5) for cell in row)


@pytest.mark.slow
@needs_office
@pytest.mark.parametrize("name", PAPERS)
def test_another_program_finds_the_same_numbers_and_those_of_a_changed_dimension(books, larger_recalculated, name):
    found = larger_recalculated
    assert same_numbers(stored(books[name]), found[name]) is None
    dimension, value = CHANGED[name]
    changed = PAPERS[name]().replaced(**{dimension: value})
    table = results(changed, changed.sweep(POSES))
    for column, after in zip(table, number_columns(found[f"{name} changed"]["Results"], 4), strict=True):
        if column.name != "of pin O":
            assert_allclose(after, column.shown, rtol=0, atol=1e-12 * max(np.abs(column.shown).max(), 1.0), err_msg=column.name)
    assert same_numbers(stored(books[name]), found[f"{name} changed"], 1e-4)[0] == "Calculation"


@needs_office
def test_directions_go_on_over_whole_turns(recalculated):
    sheet = recalculated["turned"]["Results"]
    turned = dict(zip([cell.value for cell in sheet[1]], number_columns(sheet, 4), strict=True))["turned"]
    assert_allclose(turned, Turned().sweep(25)["turned"] / deg, rtol=0, atol=1e-10)
    assert turned[-1] - turned[0] == pytest.approx(720.0)


def test_sheets_of_a_machine_of_parts_have_the_headings_of_its_equations(of_parts):
    sheet, listed = written(of_parts)["Calculation"], Calculation(Pair(), run_of(Pair()), 9).equations
    assert len(set(listed.headings.values())) == 3 < len(listed.headings)
    numbers = [str(cell.value or "").rstrip("abcdefgh)") + ")" for cell in sheet[2]]
    over = {place: cell.value for place, cell in enumerate(sheet[1]) if cell.value}
    assert over == {numbers.index(f"({number})"): heading for number, heading in listed.headings.items()}
    assert sheet.freeze_panes == "C6" and {"angle(left.OR1)", "angle(-right.OR1_x, right.OR1_y)"} <= {cell.value for cell in sheet[3]}
    names, rows = [cell.value for cell in sheet[3]], number_columns(stored(of_parts)["Calculation"], 6)
    table = results(Pair(), motion := Pair().sweep(9))
    assert_allclose(rows[names.index("M_y")], motion["M"][1], rtol=0, atol=1e-12)
    for column, found in zip(table, number_columns(stored(of_parts)["Results"], 4), strict=True):
        assert_allclose(found, column.shown, rtol=0, atol=1e-12 * max(np.abs(column.shown).max(), 1.0), err_msg=column.name)
    given = [cell.value for cell in written(of_parts)["Dimensions"]["A"][5:]]
    given = given[: given.index(None)]
    heads = [place for place, each in enumerate(given) if each in over.values()]
    parts = {given[a]: given[a + 1 : b] for a, b in zip(heads, [*heads[1:], None], strict=True)}
    assert list(parts) == ["Pair", "left (Turned)", "right (Turned)"]
    assert all(name.startswith(f"{owner}.") for owner in ("left", "right") for name in parts[f"{owner} (Turned)"])
    assert sorted(parts["Pair"]) == ["left_B2M", "load.mass", "right_B2M"] and len(given) - 3 == len(Pair().dimensions)


@needs_office
def test_another_program_finds_the_same_numbers_of_a_machine_of_parts(of_parts, recalculated):
    assert same_numbers(stored(of_parts), recalculated["parts"]) is None
    changed, numbers = Pair(**{"right.R1B2": 0.31}), number_columns(recalculated["parts changed"]["Results"], 4)
    for column, after in zip(results(changed, changed.sweep(9)), numbers, strict=True):
        assert_allclose(after, column.shown, rtol=0, atol=1e-12 * max(np.abs(column.shown).max(), 1.0), err_msg=column.name)


@for_all("unit", ["mm", "deg", "kN", "bar", "m", "N", ""])
def test_a_unit_is_put_on_as_it_is_taken_off_and_one_of_si_is_not_written(unit):
    written = to_si(unit), from_si(unit)
    assert (written == ("", "")) is (unit in ("m", "N", ""))
    there, back = (eval(f"1.0{text}".replace("PI()", "np.pi")) for text in written)
    assert there * back == pytest.approx(1.0, rel=1e-15)
    assert there == pytest.approx(UNITS[unit][0] if unit else 1.0, rel=1e-15)


def test_no_name_of_a_cell_is_a_place(tmp_path):
    names = set(written(export(Turned(), tmp_path / "turned.xlsx", count=5)).defined_names)
    assert {"_L0", "O_x", "C_x"} <= names and not names & {"L0", "C", "R1"}


@needs_office
@pytest.mark.slow
@pytest.mark.parametrize("name", SHIPPED)
def test_another_program_finds_the_same_numbers_of_every_machine(name, tmp_path):
    path = export(SHIPPED[name](), tmp_path / f"{name}.xlsx", count=31)
    assert same_numbers(stored(path), by_office(tmp_path, {name: (path, [])})[name], 1e-10) is None


@pytest.mark.slow
@pytest.mark.parametrize("name", PAPERS)
def test_the_package_formulas_finds_the_same_numbers(books, name):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import formulas

        found = formulas.ExcelModel().loads(str(books[name])).finish().calculate()
    for title in ("Calculation", "Results"):
        sheet = stored(books[name])[title]
        for column in sheet.iter_cols(min_row=5):
            size = max(abs(cell.value) for cell in column if cell.value is not None)
            for cell in column:
                key = f"'[{books[name].name}]{title.upper()}'!{cell.coordinate}"
                assert key in found or cell.data_type != "n" or title == "Results"
                if key in found:
                    assert abs(float(found[key].value[0, 0]) - cell.value) <= 1e-12 * max(size, 1e-3), key


def test_pins_found_by_iteration_are_numbers_and_say_so(iterated):
    book = stored(iterated)
    marked = {cell.value for cell, below in zip(book["Calculation"][2], book["Calculation"][4], strict=True) if "iteration" in below.value}
    assert marked == {f"{pin}_{axis}" for pin in "BFG" for axis in "xy"}
    texts = [str(cell.value) for cell in book["Dimensions"]["A"]]
    assert any(text.startswith("Numbers, not formulas, in the calculation: B_x") for text in texts)


@needs_office
def test_pins_found_by_iteration_warn_when_a_dimension_changes(recalculated):
    def warned(found):
        return [str(each.value) for each in found["Dimensions"]["A"] if "do not fit" in str(each.value)]

    assert not warned(recalculated["iterated"])
    assert warned(recalculated["iterated changed"]) == [
        "The pins B F G were found by iteration and do not fit these dimensions: export the changed design again."
    ]


@needs_office
def test_numbers_that_follow_no_input_say_so_where_they_stand_once_one_changes(iterated, recalculated):
    plain, changed = recalculated["iterated"], recalculated["iterated changed"]
    assert not any(cell.value for name, column in (("Dimensions", "G"), ("Strokes", "H")) for cell in plain[name][column][5:])
    told = [cell.value for cell in changed["Dimensions"]["G"] if cell.value]
    assert told[:2] == ["changed inputs", "Changed"] and len(told) == 3 and told[2].startswith("as exported ")
    given = {sheet: [cell.column_letter for cell in changed[sheet][row] if str(cell.value) == GIVEN] for sheet, row in GIVEN_IN.items()}
    numbers = [cell.column_letter for cell in written(iterated)["Calculation"][GIVEN_IN["Calculation"] + 1] if cell.data_type == "n"]
    assert numbers and set(numbers) < set(given["Calculation"])  # what follows given numbers is left behind with them
    length = next(name for name in reversed(StephensonTwo().dimensions) if "." not in name)
    longer = StephensonTwo(**{length: 1.01 * StephensonTwo().dimensions[length]})
    right = stored(export(longer, iterated.with_name("longer.xlsx"), count=7))["Results"]
    wrong = [
        cell.column_letter for row in right.iter_rows(min_row=4) for cell in row
        if isinstance(cell.value, float) and abs(changed["Results"][cell.coordinate].value - cell.value) > 1e-6 * (1.0 + abs(cell.value))
    ]  # fmt: skip
    assert wrong and set(wrong) <= set(given["Results"])
    assert not any(cell.value == GIVEN for sheet, row in GIVEN_IN.items() for cell in plain[sheet][row])
    struck = {sheet: {str(each.sqref)[0] for each in written(iterated)[sheet].conditional_formatting} for sheet in GIVEN_IN}
    assert all(letter[0] in struck[sheet] for sheet, letters in given.items() for letter in letters)


def test_a_number_that_an_equation_gives_later_leaves_nothing_behind(tmp_path):
    """Of a cylinder with a tank on its rod side the line tells a thrust of 0; results follow the equation of the whole."""

    class Upright(Mechanism):
        """A ram on a pump and a tank."""

        S, O = Stroke(0.0, 0.5), Ground(0.0, 0.0)
        rail = Guide(O, angle=90 * deg)
        P = OnGuide(rail, at=1.0 + S)
        load = Weight(P, mass=400)
        ram = Cylinder(O, P, bore=80 * mm, rod=45 * mm)
        line, back = OilLine(ram.piston_side, Pump(180 * bar)), OilLine(ram.rod_side, Tank())

    book = written(export(Upright(), tmp_path / "upright.xlsx", count=5))
    heads = {book["Results"].cell(1, column).value: str(book["Results"].cell(3, column).value) for column in range(1, 12)}
    assert "thrust" in heads and not any(GIVEN in text for text in heads.values())


@pytest.mark.slow
def test_a_friction_that_no_equation_has_is_a_condition():
    calculation = Calculation(HeaderBalancer(), run_of(HeaderBalancer()), 5)
    kept = {each.column.name: each.unchanged for each in live_results(calculation)}
    assert "pin_O.coefficient" in kept["F_R up"] and "pin_O.coefficient" not in kept["F_R free"] and kept["R_y"] == ()
    rubbing = HeaderBalancer(**{"pin_O.coefficient": 0.15})
    found = {each.column.name: each.expr for each in live_results(Calculation(rubbing, run_of(rubbing), 5))}
    assert found["F_R up"] is None and found["F_R free"] is not None


def test_a_formula_gives_its_column_at_every_pose_or_is_none():
    """Where the load drives the cylinder the equations, which are those of lifting, do not hold."""
    lift = MowerLift()
    whole, beyond = (
        {each.column.name: each.expr for each in live_results(Calculation(lift, run_of(lift, {"S": ends}), 101))}
        for ends in ((0.55, 0.80), (0.55, 0.825))
    )
    assert all(whole[name] is not None for name in ("PI/k_m", "F", "pd", "kz"))
    assert [name for name in whole if whole[name] is not None and beyond[name] is None] == ["PI/k_m", "F", "pd", "kz"]


@pytest.mark.slow
def test_sheets_say_where_they_run_and_under_which_loads(tmp_path):
    class Cased(Turned):
        heavy = LoadCase("heavy")

    class Loaded(Cased):
        turning = Over.path(phi=(0.5, 0.9), cases=["heavy"])

    book = written(export(Loaded(), tmp_path / "loaded.xlsx", count=5))
    assert book["Dimensions"]["A4"].value == "Along turning, in load case heavy; plain not in these sheets."
    book = written(export(Cased(), tmp_path / "cased.xlsx", count=5))
    said = "Along phi, under the machine's own loads, load case plain; heavy not in these sheets."
    assert book["Dimensions"]["A4"].value == said
    assert {sheet.oddHeader.left.text for sheet in book} == {said} and {sheet.oddHeader.right.text for sheet in book} == {"&A"}


def test_texts_are_no_formulas(tmp_path):
    class Sly(Turned):
        """=HYPERLINK("http://example.org", "click")"""

        def columns(self, motion):
            return [*super().columns(motion), Column("=1+1", motion["turned"])]

    book = written(export(Sly(), tmp_path / "sly.xlsx", count=5))
    assert book["Dimensions"]["A2"].data_type == "s" and book["Dimensions"]["A2"].value.startswith("=HYPERLINK")
    assert [cell.data_type for cell in book["Results"][1] if cell.value == "=1+1"] == ["s"]
    first = export(Sly(), tmp_path / "sly.csv", count=5).read_text().splitlines()[0]
    assert first.endswith(",'=1+1")


def test_the_same_design_gives_the_same_bytes(tmp_path):
    one, other = (export(Turned(), tmp_path / name, count=5) for name in ("a.xlsx", "b.xlsx"))
    names = ("xl/worksheets/sheet1.xml", "xl/worksheets/sheet3.xml", "docProps/app.xml")
    from zipfile import ZipFile

    assert all(ZipFile(one).read(name) == ZipFile(other).read(name) for name in names)


@DAILY
def test_a_chart_shows_what_the_machine_is_about(books, name):
    chart = written(books[name])["Chart"]._charts[0]
    wanted = PAPERS[name]().featured().column
    titles = [cell.value for cell in stored(books[name])["Results"][1]]
    drawn = chart.series[0].yVal.numRef.f
    assert drawn.startswith("Results!$") and (
        not wanted or titles[written(books[name])["Results"][f"{drawn.split('$')[1]}1"].column - 1] == wanted
    )


def test_formulas_have_the_signs_and_the_order_of_a_spreadsheet():
    a, b, y, x = sympy.symbols("a b y x", real=True)

    def text(expr):
        return formula(expr, lambda symbol: symbol.name)

    assert text(-(a**2)) == "=-1*a^2" and text(b - a**2) == "=b-a^2"
    assert text(sympy.atan2(y, x)) == "=ATAN2(x,y)" and text(sympy.log(a)) == "=LN(a)"
    assert text(sympy.sqrt(a) / (a * b)) in ("=1/(SQRT(a)*b)", "=1/(b*SQRT(a))")
    assert text((a - b) * (a + b) ** 2) in ("=(a-b)*(a+b)^2", "=(a+b)^2*(a-b)")
    assert text(sympy.Piecewise((a, a <= b), (b, True))) == "=IF(a<=b,a,b)"
    assert text(sympy.Add(*[a**n for n in range(3000)])) is None


def test_names_that_a_spreadsheet_takes():
    names = cell_names(["L0", "A.x", "OB", "ob", "R", "R1C1", "c2", "TRUE", "XFD12", "Длина", "1st", "rail.angle"])
    assert list(names.values()) == ["_L0", "A_x", "OB", "ob_2", "_R", "_R1C1", "_c2", "_TRUE", "_XFD12", "Длина", "_1st", "rail_angle"]


# -- tables ------------------------------------------------------------------------------------------------


TWO_WAYS = """from linkage import *
class Arm(Mechanism):
    a, b = Stroke(0.0, 1.0), Stroke(0.0, 1.0)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=1.0, angle=a)
    B = Crank(A, AB=1.0, angle=b)
    load = Weight(B, mass=100)
    out, back = Over.path(a=[0.0, 1.0], b=[0.0, 0.5]), Over(a=0.2)
"""


def test_a_table_is_that_of_the_command(tmp_path):
    (tmp_path / "arm.py").write_text(TWO_WAYS)
    for name, machine in (("three_point_hitch", ThreePointHitch), (str(tmp_path / "arm.py"), find(str(tmp_path / "arm.py")))):
        path = export(machine(), tmp_path / "own.csv", count=11)
        assert main(["table", name, "--csv", str(tmp_path / "command.csv")]) == 0
        assert path.read_bytes() == (tmp_path / "command.csv").read_bytes()
    assert path.read_text().startswith("run,") and len(path.read_text().splitlines()) == 23
    assert len(export(machine(), path, at={"a": 0.2}, count=5).read_text().splitlines()) == 6
    assert export(machine(), path, columns=[Column("I", np.ones(2))]).read_text().splitlines() == ["I", "1.0", "1.0"]


def test_a_motion_as_a_table_keeps_all_digits(tmp_path):
    motion = ThreePointHitch().at(S=[0.0, 0.1, 0.2])
    with export(motion, tmp_path / "motion.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [float(row["G_y, m"]) for row in rows] == motion.y("G").tolist()
    chosen = export(motion, tmp_path / "chosen.csv", columns=[Column("I", motion.ratio("G")[1])]).read_text().splitlines()
    assert chosen == ["I", *(repr(float(value)) for value in motion.ratio("G")[1])]


# -- drawings ----------------------------------------------------------------------------------------------


def test_a_drawing_has_the_machine_in_millimetres(tmp_path):
    hitch = ThreePointHitch()
    document = drawing(export(hitch, tmp_path / "hitch.dxf", at={"S": [0.0, 0.25]}, trace=["G"]))
    assert document.header["$INSUNITS"] == 4 and not document.audit().has_errors
    space = document.modelspace()
    for number, stroke in enumerate((0.0, 0.25), 1):
        motion = hitch.at(S=stroke)
        prefix = "" if number == 1 else f"pose{number}_"
        centres = np.array([tuple(each.dxf.center)[:2] for each in space.query(f'CIRCLE[layer=="{prefix}pins"]')])
        pins = np.array([motion[name] for name in motion.plan.points]) / mm
        assert_allclose(centres, pins, rtol=0, atol=1e-9)
        lines = [np.array([(x, y) for x, y, *_ in each]) for each in space.query(f'LWPOLYLINE[layer=="{prefix}centre_lines"]')]
        every = np.concatenate(lines)
        assert np.min(np.hypot(*(every[:, None] - pins[None]).T), axis=0).max() < 1e-9
    path = next(iter(space.query('LWPOLYLINE[layer=="paths"]')))
    assert_allclose([(x, y) for x, y, *_ in path], hitch.sweep(101)["G"].T / mm, rtol=0, atol=1e-9)
    lengths = {each.dxf.text.split(" = ")[0]: each.get_measurement() for each in space.query('DIMENSION[layer=="dimensions"]')}
    assert lengths["OB"] == pytest.approx(300.0) and lengths["MK"] == pytest.approx(880.0)


@for_all("machine", (), slow=[ThreePointHitch, Excavator, Telehandler])
def test_names_on_a_drawing_cover_neither_pins_nor_each_other(machine):
    parts = [*pose_parts(machine().at(**stroke_middles(machine())), 0)]
    names = [each for each in parts if isinstance(each, Lettering)]
    middles = np.array([each.place + half_of(each.text, each.height) * [1.0, 0.75] for each in names])
    halves = np.array([half_of(each.text, each.height) for each in names])
    for other in range(len(names)):
        apart = np.abs(middles - middles[other]) >= halves + halves[other]
        assert apart.any(axis=1).sum() == len(names) - 1
    pins = np.array([each.centre for each in parts if isinstance(each, Circle)])
    assert not (np.abs(middles[:, None] - pins) < halves[:, None]).all(axis=2).any()


@pytest.mark.slow
def test_dimensions_on_a_drawing_have_the_names_that_the_designer_gave():
    named = {each.name for each in pose_parts(Excavator().at(**stroke_middles(Excavator())), 0) if isinstance(each, Measured)}
    assert {"boom.BA", "tool.LM"} <= named and named - {*Excavator().dimensions} == {"boom.E arm.F", "boom.CD", "arm.G tool.H"}


@for_all("machine", (), slow=[ThreePointHitch, HeaderBalancer, MowerLift])
def test_a_pin_on_the_frame_stands_as_in_pictures(machine, tmp_path):
    """Its triangle is on the side where pictures and pages have it: below, or beside where below is no room."""
    motion = machine().at(**stroke_middles(machine()))
    document = drawing(export(motion, tmp_path / "frame.dxf"))
    frame = [np.array([(x, y) for x, y, *_ in each]) * mm for each in document.modelspace().query('LWPOLYLINE[layer=="frame"]')]
    ways = props(Scene(motion))
    assert len({*ways.values()}) > 1
    for name, way in ways.items():
        pin, *feet = next(each for each in frame if len(each) == 3 and np.allclose(each[0], motion[name], rtol=0.0, atol=1e-9))
        out = np.mean(feet, axis=0) - pin
        assert_allclose(out / np.hypot(*out), [np.cos(way), np.sin(way)], rtol=0.0, atol=1e-9)


def test_an_outline_keeps_its_distance(tmp_path):
    document = drawing(export(Turned(), tmp_path / "bar.dxf"))
    bodies = list(document.modelspace().query('LWPOLYLINE[layer=="bodies"]'))
    assert bodies and all(each.closed for each in bodies)
    motion = Turned().at(phi=0.0)
    ends = np.array([motion["O"], motion["R1"]]) / mm
    bar = next(each for each in bodies if len(each) == 4)
    corners = np.array([(x, y) for x, y, *_ in bar])
    bulges = [row[4] for row in bar]
    distances = np.sort(np.min(np.hypot(*(corners[:, None] - ends[None]).T), axis=0))
    assert distances.max() - distances.min() < 1e-9 and sorted(map(abs, bulges)) == pytest.approx([0.0, 0.0, 1.0, 1.0])


def test_a_pin_has_the_radius_of_its_bearing(tmp_path):
    document = drawing(export(Turned(), tmp_path / "pin.dxf"))
    radii = {tuple(each.dxf.center)[:2]: each.dxf.radius for each in document.modelspace().query("CIRCLE")}
    assert radii[0.0, 0.0] == pytest.approx(12.0)


def test_a_page_has_true_size_and_words(tmp_path):
    hitch = ThreePointHitch()
    root = ElementTree.parse(export(hitch, tmp_path / "hitch.svg", trace=["G"])).getroot()
    name = "{http://www.w3.org/2000/svg}"
    wide, box = root.get("width"), [float(each) for each in root.get("viewBox").split()]
    assert wide.endswith("mm") and float(wide[:-2]) == box[2]
    assert {each.text for each in root.iter(f"{name}text")} == set(hitch.plan.points)
    circles = {each.get("data-name"): (float(each.get("cx")), -float(each.get("cy"))) for each in root.iter(f"{name}circle")}
    motion = hitch.at(S=0.0)
    for point in hitch.plan.points:
        assert_allclose(circles[point], motion[point] / mm, atol=1e-6)
    assert {"bodies", "pins", "paths", "cylinders"} <= {each.get("class") for each in root.iter(f"{name}g")}


FEW = ("inverted_slider_crank",)


@first_daily(len(FEW), "name", [*FEW, *(name for name in SHIPPED if name not in FEW)])
def test_every_machine_is_drawn(name, tmp_path):
    machine = SHIPPED[name]()
    document = drawing(export(machine, tmp_path / "machine.dxf", trace=machine.plan.moving[-1:]))
    audit = document.audit()
    assert not audit.errors and not audit.fixes
    ElementTree.parse(export(machine, tmp_path / "machine.svg"))


# -- mistakes ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (lambda path: export(Turned(), path / "x.doc"), r"ends in one of \.xlsx, \.csv, \.dxf, \.svg"),
        (lambda path: export(Turned, path / "x.csv"), "is a class"),
        (lambda path: export(Turned().sweep(5), path / "x.xlsx"), "made of a machine"),
        (lambda path: export(Turned(), path / "x.xlsx", trace=["B2"]), "trace= draws the paths"),
        (lambda path: export(Turned(), path / "x.dxf", trace="B2"), "a list of points"),
        (lambda path: export(Turned(), path / "x.dxf", trace=["B3"]), "B3"),
        (lambda path: export(Turned(), path / "x.xlsx", count=1), "count=1"),
        (lambda path: export(Turned(), path / "x.xlsx", at={"psi": 1.0}), "psi"),
        (lambda path: export(Turned(), path / "x.csv", at={"psi": 1.0}), "psi"),
        (lambda path: export(Turned(L0=np.array([0.1, 0.11])), path / "x.xlsx"), "one design"),
        (lambda path: export(Turned(L0=np.array([0.1, 0.11])), path / "x.dxf"), "one design"),
        (lambda path: export(Turned().sweep(200), path / "x.dxf"), "200 poses"),
    ],
)
def test_mistakes_are_told_in_words_and_leave_no_file(given, said, tmp_path):
    with pytest.raises(DefinitionError, match=said):
        given(tmp_path)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("kind", ["xlsx", "csv", "dxf"])
def test_what_cannot_be_assembled_anywhere_is_not_exported(kind, tmp_path):
    with pytest.raises(AssemblyError):
        export(Turned(L0=2.0), tmp_path / f"x.{kind}")
    assert not list(tmp_path.iterdir())


def test_folder_that_is_not_there_is_told(tmp_path):
    with pytest.raises(FileError):
        export(Turned(), tmp_path / "nowhere" / "x.csv")


@pytest.mark.parametrize(("library", "ending", "extra"), [("xlsxwriter", "xlsx", "xlsx"), ("ezdxf", "dxf", "cad")])
def test_a_missing_extra_is_named(library, ending, extra, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(
        DefinitionError, match=rf"pip install 'hydrolinkage\[{extra}\]' \(from a checkout: pip install -e '\.\[{extra}\]'\)"
    ):
        export(Turned(), tmp_path / f"x.{ending}", count=5)
    assert not list(tmp_path.iterdir())


def test_every_extra_is_imported_somewhere():
    root = Path(__file__).parents[3]
    extras = tomllib.loads((root / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    known = {"imageio-ffmpeg": "imageio_ffmpeg"}
    for extra in extras.keys() - {"docs", "test"}:
        for wanted in extras[extra]:
            library = known.get(wanted.split(">=")[0], wanted.split(">=")[0].lower())
            imported = re.compile(rf"^\s*(import|from) {library}\b", re.MULTILINE)
            assert any(map(imported.search, sources().values())), f"{extra}: {library}"
    assert "myst_parser" in (root / "docs" / "conf.py").read_text() and "-m sphinx" in (root / "run").read_text()


def test_the_command_writes_them(tmp_path, capsys):
    for ending in ("xlsx", "csv", "dxf", "svg", "linkage2", "txt"):
        path = tmp_path / f"machine.{ending}"
        more = ["--path", "P", "--poses", "3"] if ending in ("dxf", "svg") else ["--count", "5"]
        assert main(["export", "four_bar", "-o", str(path), *more]) == 0
        assert capsys.readouterr().out.strip() == str(path) and path.stat().st_size > 100
    assert main(["export", "four_bar", "-o", str(tmp_path / "x.pdf")]) == 2


def test_a_table_of_a_million_rows_is_refused_with_what_it_would_take(tmp_path):
    class Three(Mechanism):
        a, b, c = Stroke(0.0, 1.0), Stroke(0.0, 1.0), Stroke(0.0, 1.0)
        O = Ground(0.0, 0.0)
        A = Crank(O, OA=1.0, angle=a)
        B = Crank(A, AB=1.0, angle=b)
        C = Crank(B, BC=1.0, angle=c)

    words = r"Three: 101 x 101 x 101 poses are 1,030,301 rows, some 2.1 GB; give count=79 at most, or hold strokes, at=dict\(b=..., c=...\)"
    with pytest.raises(DefinitionError, match=words):
        export(Three(), tmp_path / "a.csv")
    assert len(export(Three(), tmp_path / "a.csv", count=3).read_text().splitlines()) == 28


@pytest.mark.parametrize("suffix", [".xlsx", ".csv", ".dxf"])
def test_a_machine_that_is_assembled_nowhere_is_not_written(suffix, tmp_path):
    with pytest.raises(AssemblyError, match="cannot be assembled"):
        export(ThreePointHitch(OB=0.01), tmp_path / f"nowhere{suffix}")
    assert not list(tmp_path.iterdir())


@for_all("suffix", [".csv", ".xlsx", ".svg", ".txt", ".linkage2"])
@for_all("value", [[], "0.6", None, [[1.0], [1.0, 2.0]]], ids=str)
def test_strokes_that_are_no_numbers_are_refused(suffix, value, tmp_path):
    with pytest.raises(DefinitionError, match=r"MowerLift: at: S=.*a number or several are expected"):
        export(MowerLift(), tmp_path / f"lift{suffix}", at={"S": value})
    assert not list(tmp_path.iterdir())


def test_a_sketch_is_of_one_pose(tmp_path):
    with pytest.raises(DefinitionError, match="a sketch is of one pose; give one value of S"):
        export(MowerLift(), tmp_path / "lift.txt", at={"S": (0.6, 0.7)})
