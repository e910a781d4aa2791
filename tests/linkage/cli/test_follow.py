"""`hydrolinkage follow`: a path from a file, the strokes along it as a table, or why it is not followed."""

import csv

import numpy as np
import pytest

from linkage.cli import main

LOADER = '''
from linkage import LEFT, RIGHT, Dyad, Ground, Mechanism, OnLink, Stroke, angle
from linkage.units import deg

class Loader(Mechanism):
    lift, dump = Stroke(0.80, 1.30), Stroke(0.78, 1.15)
    O, A = Ground(0, 1.5), Ground(0.45, 0.75)
    B = Dyad(O, A, OB=1.1, AB=lift, side=LEFT)
    T = OnLink(O, B, OT=2.4)
    C = OnLink(O, B, OC=1.4, BOC=12 * deg)
    D = Dyad(T, C, TD=0.35, CD=dump, side=RIGHT)
    E = OnLink(T, D, TE=0.8, DTE=-120 * deg)
    tilt = angle("T", "E")
'''


@pytest.fixture
def loader(tmp_path):
    path = tmp_path / "loader.py"
    path.write_text(LOADER, encoding="utf-8")
    return str(path)


def written(folder, text, name="path.csv"):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return str(path)


def table_of(path):
    """Return the rows of a table, the headings first."""
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.reader(file))


def heights(last, count=11):
    return "T_y [mm];tilt [deg]\n" + "".join(f"{1000 + (last - 1000) * step / (count - 1):.3f};0\n" for step in range(count))


def test_the_strokes_along_a_path_are_a_table_that_is_a_path_again(tmp_path, loader, capsys):
    table = tmp_path / "strokes.csv"
    assert main(["follow", loader, "--path", written(tmp_path, heights(2400)), "--csv", str(table)]) == 0
    rows = table_of(table)
    assert rows[0] == ["lift, m", "dump, m", "T_y, mm", "tilt, deg"] and len(rows) == 12
    values = np.array(rows[1:], float)
    assert values[:, 2] == pytest.approx(np.linspace(1000.0, 2400.0, 11)) and values[:, 3] == pytest.approx(np.zeros(11), abs=1e-9)
    again = tmp_path / "again.csv"
    strokes = "".join(f"{row[0]},{row[1]}\n" for row in rows[1:])
    commas = strokes.replace(",", ";").replace(".", ",")
    for text in ('lift,"dump, m"\n' + strokes, "# as a spreadsheet of another country writes it\nlift (m);dump/m\n" + commas):
        path = written(tmp_path, text, "again_path.csv")
        assert main(["follow", loader, "E_y", "tilt", "--path", path, "--csv", str(again)]) == 0
        found = np.array(table_of(again)[1:], float)
        assert found[:, :2] == pytest.approx(values[:, :2], abs=1e-12)
    capsys.readouterr()


def test_a_stroke_is_held_and_a_branch_begun(tmp_path, loader, capsys):
    path = written(tmp_path, "y(T)\n1.2\n1.4\n")
    assert main(["follow", loader, "--path", path, "--hold", "dump=900mm", "--start", "lift=0.9"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split("  ")[-1].strip() == "y(T), mm" and lines[1].split()[1:] == ["0.9000", "1200.0000"]


def test_a_path_that_ends_says_why_or_leaves_gaps(tmp_path, loader, capsys):
    path = written(tmp_path, heights(2600, 17))
    assert main(["follow", loader, "--path", path]) == 2
    told = capsys.readouterr().err
    assert "place 16 of 17, y(T) = 2500 mm, tilt = 0 deg: lift = " in told and "past its end at 1300 mm" in told
    assert main(["follow", loader, "--path", path, "--gaps"]) == 0
    assert capsys.readouterr().out.splitlines()[-1].split() == ["-"] * 4


def test_a_path_is_drawn(tmp_path, loader, capsys):
    picture = tmp_path / "lift.svg"
    assert main(["follow", loader, "--path", written(tmp_path, heights(2000, 3)), "-o", str(picture)]) == 0
    assert picture.stat().st_size > 1000 and str(picture) in capsys.readouterr().out


def test_a_film_of_a_path_that_is_nowhere_reached_is_refused(tmp_path, loader, capsys):
    film = tmp_path / "lift.gif"
    path = written(tmp_path, "T_y\n12\n13\n")
    assert main(["follow", loader, "--path", path, "--hold", "dump=0.9m", "--gaps", "-o", str(film)]) == 2
    assert "nothing moves along this path; it has 0 places in reach." in capsys.readouterr().err and not film.exists()


@pytest.mark.slow
def test_a_path_with_a_stroke_that_is_held_is_a_film(tmp_path, loader, capsys):
    film = tmp_path / "lift.gif"
    path = written(tmp_path, "T_y\n1.2\n1.3\n1.4\n")
    assert main(["follow", loader, "--path", path, "--hold", "dump=0.9m", "-o", str(film)]) == 0
    assert film.stat().st_size > 1000 and str(film) in capsys.readouterr().out


BAD = {
    "nothing": ("", "a first line such as M_x [mm];M_y [mm] and a row for each place are expected"),
    "no such quantity": ("T_z;tilt\n1;0\n", "path.csv: T_z: "),
    "no such unit": ("T_y [furlong];tilt\n1;0\n", "the unit furlong is unknown"),
    "no number": ("T_y;tilt\n1.2;flat\n", "line 2, tilt: 'flat' is not a value"),
    "a unit of another kind": ("T_y [deg];tilt\n1.2;0\n", "line 2, T_y [deg]: '1.2 deg' is an angle where a value of kind length"),
    "too few values": ("T_y;tilt\n1.2;0\n1.3\n", "line 3: 1 values for 2 headings"),
    "one target too few": ("T_y\n1.2\n", 'hold one of them, hold={"dump": 0.965}'),
}


@pytest.mark.parametrize("case", BAD)
def test_a_bad_path_is_told_in_one_line(case, tmp_path, loader, capsys):
    text, words = BAD[case]
    assert main(["follow", loader, "--path", written(tmp_path, text)]) == 2
    told = capsys.readouterr().err
    assert words in told and told.count("\n") == 1


def test_a_stroke_that_is_not_there_is_told(tmp_path, loader, capsys):
    path = written(tmp_path, "T_y\n1.2\n")
    assert main(["follow", loader, "--path", path, "--hold", "dum=0.9m"]) == 2
    assert "Did you mean dump?" in capsys.readouterr().err
    assert main(["follow", loader, "--path", str(tmp_path / "nowhere.csv")]) == 2
    assert "nowhere.csv" in capsys.readouterr().err


@pytest.mark.slow
def test_the_page_along_a_path(tmp_path, loader, capsys):
    file = tmp_path / "lift.html"
    assert main(["follow", loader, "--path", written(tmp_path, heights(2400)), "--language", "ru", "-o", str(file)]) == 0
    assert str(file) in capsys.readouterr().out and '<html lang="ru">' in file.read_text(encoding="utf-8")
