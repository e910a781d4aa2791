"""What other packages bring by entry points is found by its name, listed, and named where it cannot be loaded."""

import shutil
import subprocess
from importlib.metadata import EntryPoint

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import DefinitionError, LinkageError, export, plugins, ratio
from linkage.cli import main
from linkage.program import ARRAYS, Schedule
from mechanisms.three_point_hitch import ThreePointHitch

INSTALLED = {
    plugins.EXPORTERS: {"obj": "docs.extending.formats:Obj", "torn": "no_package:Torn"},
    plugins.LANGUAGES: {"lua": "docs.extending.formats:Lua", "odd": "pathlib:Path"},
    plugins.BACKENDS: {"plain": f"{__name__}:Plain", "none": f"{__name__}:INSTALLED"},
}
ASKED = ["G", ratio("G"), "tilt"]


class Plain:
    """A back end that works every pose out by the nodes themselves, with NumPy's functions."""

    def __init__(self, plan: Schedule) -> None:
        self.plan = plan

    def turns(self, m: int, n: int) -> bool:
        return False

    def run(self, design, poses, values, guards):
        found = {node: np.reshape(value, (-1, 1)) for node, value in zip(self.plan.design_inputs, design, strict=True)}
        found |= {node: np.atleast_2d(value) for node, value in zip(self.plan.pose_inputs, poses, strict=True)}
        for node in (*self.plan.design, *self.plan.pose):
            found[node] = ARRAYS[node.op](*(arg.origin.value if arg.origin.op == "constant" else found[arg.origin] for arg in node.args))
        for row, node in zip(values, self.plan.outputs, strict=True):
            row[:] = found.get(node, node.value)
        for place, node in enumerate(self.plan.guards):
            guards[place] = np.min(found[node])


@pytest.fixture
def installed(monkeypatch):
    """Let packages be installed that bring an exporter, a language and a back end, and of each one that cannot be used."""
    groups = {group: {name: EntryPoint(name, value, group) for name, value in each.items()} for group, each in INSTALLED.items()}
    monkeypatch.setattr(plugins, "entry_points", lambda group: groups.get(group, {}))


def test_a_kind_of_file_is_found_by_its_ending_and_by_its_name(installed, tmp_path):
    hitch = ThreePointHitch()
    text = export(hitch, tmp_path / "hitch.OBJ", at={"S": 0.1}).read_text()
    x, y = hitch.at(S=0.1)["G"]
    assert f"# G\nv {x:.9g} {y:.9g} 0\n" in text
    assert export(hitch.at(S=0.1), tmp_path / "hitch.txt", format="obj").read_text() == text


def test_the_command_knows_it_too(installed, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["export", "mechanisms.three_point_hitch:ThreePointHitch", "--format", "obj", "--at", "S=100mm"]) == 0
    assert capsys.readouterr().out == "ThreePointHitch.obj\n"
    assert main(["export", "--help"]) == 0
    assert "xlsx, csv, dxf, svg, points, linkage2, pmks, obj, torn" in " ".join(capsys.readouterr().out.split())
    assert main(["export", "mechanisms.three_point_hitch:ThreePointHitch", "--format", "torn"]) == 2
    said = " ".join(capsys.readouterr().err.split())
    assert "The exporter torn (no_package:Torn) cannot be loaded: ModuleNotFoundError" in said


@pytest.mark.skipif(shutil.which("lua") is None, reason="no Lua")
def test_a_language_says_what_evaluate_says(installed):
    hitch = ThreePointHitch()
    text = hitch.source(ASKED, language="lua", name="lift")
    stated = text[text.index("d: ") + 3 : text.index("; p: ")]
    design = ", ".join(part.rpartition(" = ")[2] for part in stated.split(", "))
    said = subprocess.run(["lua", "-e", f"{text}print(lift({{{design}}}, {{0.1}}))"], check=True, capture_output=True, text=True).stdout
    assert_allclose(list(map(float, said.split())), hitch.function(ASKED)(0.1), rtol=1e-11)


def test_a_language_writes_its_own_words(installed):
    text = ThreePointHitch().source(["G", "tilt"], language="lua")
    assert text.startswith("-- d: ") and "local i0 = p[1]\n" in text and "math.atan(" in text and text.endswith("end\n")
    with pytest.raises(DefinitionError, match="name='repeat' has a meaning in lua already"):
        ThreePointHitch().source(["G"], language="lua", name="repeat")


def test_a_back_end_is_run_by_its_name(installed):
    hitch, S = ThreePointHitch(), np.linspace(0.0, 0.2, 31)
    wanted = hitch.evaluate(ASKED, S=S, backend="numpy")
    for threads in (1, 2):
        for found, right in zip(hitch.evaluate(ASKED, S=S, backend="plain", threads=threads), wanted, strict=True):
            assert_allclose(found, right, rtol=1e-13, atol=1e-14)
    batch = ThreePointHitch(OB=np.array([0.30, 0.31]))
    assert_allclose(batch.evaluate(["G"], S=S, backend="plain")[0], batch.evaluate(["G"], S=S, backend="numpy")[0], rtol=1e-13)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (lambda path: export(ThreePointHitch(), path / "x.doc"), r"one of \.xlsx, .*, \.txt, \.obj, which .* The exporter torn"),
        (lambda path: export(ThreePointHitch(), path / "x.obj", format="step"), r"'step' is unknown in export.* pmks, obj, torn"),
        (lambda path: export(ThreePointHitch(), path / "x.csv", format="torn"), r"The exporter torn \(no_package:Torn\) cannot be loaded"),
        (lambda path: export(ThreePointHitch(), path / "x.obj", trace=["G"]), r"trace= draws the paths of points, in \.dxf and \.svg"),
        (lambda path: ThreePointHitch().source(["G"], language="rust"), 'say "c" or "javascript" or "lua" or "odd"'),
        (lambda path: ThreePointHitch().source(["G"], language="odd"), "odd .*is no subclass of linkage.program.Language"),
        (lambda path: ThreePointHitch().evaluate(["G"], S=0.1, backend="gpu"), 'say "numpy", "numba", "floats", "plain" or "none"'),
        (lambda path: ThreePointHitch().evaluate(["G"], S=0.1, backend="none"), "none .*is no function of a schedule"),
    ],
)
def test_what_is_not_there_or_no_such_thing_is_told(asked, said, installed, tmp_path):
    with pytest.raises(LinkageError, match=said):
        asked(tmp_path)


def test_a_broken_one_does_not_hide_the_others(installed, tmp_path):
    assert export(ThreePointHitch(), tmp_path / "x.csv", count=3).exists()
    assert export(ThreePointHitch(), tmp_path / "x.obj").exists()


def test_nothing_is_loaded_before_it_is_asked_for(installed):
    from linkage.exports import EXPORTERS

    assert list(EXPORTERS) == ["xlsx", "csv", "dxf", "svg", "points", "linkage2", "pmks", "obj", "torn"]
    assert "torn" in EXPORTERS and 3 not in EXPORTERS


def test_a_folder_that_is_added_is_looked_in(tmp_path, monkeypatch):
    assert "lua" not in plugins.entry_points(plugins.LANGUAGES)
    info = tmp_path / "added-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: added\nVersion: 1.0\n", encoding="utf-8")
    (info / "entry_points.txt").write_text("[hydrolinkage.languages]\nlua = docs.extending.formats:Lua\n", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    assert ThreePointHitch().source(["G"], language="lua").startswith("-- d: ")
