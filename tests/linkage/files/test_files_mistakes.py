"""Files that are wrong: every mistake in words, with its key and line, and never another error than the framework's own."""

import os
from pathlib import Path

import pytest

from linkage import AssemblyError, DefinitionError, FileError
from linkage.files import from_dict, load, save, to_dict, to_toml
from tests.for_all import for_all
from tests.linkage.files.file_machines import EveryStep, Hitch, changed

DATA = Path(__file__).parents[1] / "data"


def test_every_mistake_comes_with_its_key_and_line():
    with pytest.raises(FileError) as caught:
        load(DATA / "many_mistakes.toml")
    expected = [
        "line 6, colour: is not a section; there are name, doc, order, featured, machines, strokes,",
        "line 9, strokes.S: 'fast': Quantity 'fast' is unknown. Known: S, T, L0, tilt.",
        "line 10, strokes.T: Stroke(1, 1) has no length: give two different ends.",
        "line 13, dimensions.L0: '500 furlong':",
        "line 16, ground.A: [0.2] is not two coordinates in m, such as [0.20, 0.55].",
        "line 20, points.B.Dyad: Point 'Q' is unknown. Known: A, O, B, C, D.",
        "line 20, points.B.AB: 'L0 + SS': Quantity 'SS' is unknown. Did you mean S?",
        "line 20, points.B.side: 'up' is not a side; write \"LEFT\" or \"RIGHT\".",
        "line 21, points.C: Kind 'dyad' is unknown. Did you mean Dyad?",
        "line 23, points.D: D = Dyad(A, O): the label 'AX' does not fit its points; valid labels: AD/DA, OD/DO.",
        "line 30, outputs.tilt: 'angle(B, S)': S of [strokes] is not a point.",
    ]
    lines = str(caught.value).splitlines()
    assert lines[0] == f"many_mistakes.toml: {len(expected)} mistakes:"
    for line, words in zip(lines[1:], expected, strict=True):
        assert line.strip().startswith(words)


B = to_dict(Hitch)["points"]["B"]


@for_all(
    ("tables", "words"),
    [
        (changed("points", "B", "OB", to=-0.3), r"points\.B: B = Dyad\(A, O\): the length OB=-0\.3 m is negative"),
        (changed("points", "B", "OB", drop=True), r"points\.B: B = Dyad\(A, O\): the length OB/BO is missing; give OB=0\.3"),
        (changed("points", "B", "side", drop=True), r"points\.B: B = Dyad\(A, O\): two circles meet in two points; say side"),
        (changed("points", "B", "Dyad", to=["A", "A"]), r"points\.B: .*must be different"),
        (changed("points", "B", "Crank", to="A"), r"points\.B: it is Dyad and Crank at once"),
        (changed("points", "B", to=3), r"points\.B: 3 is no entry of \[points\]\. Write it like `B = \{ Dyad"),
        (changed("points", "B", "ED", to=0.4), r"points\.B: .*the label 'ED' does not fit"),
        (changed("points", "B", "P", to=0.4), r"points\.B: 'P' is not a label; write the points' names joined"),
        (changed("points", "A", to=B), r"points\.A: A stands in \[ground\] too; give it another name|ground\.A"),
        (changed("points", "sweep", to=B), r"points\.sweep: sweep is a word of the framework"),
        (changed("points", "lambda", to=B), r"points\.'?lambda'?: 'lambda' is not a name"),
        (changed("points", "__class__", to=B), r"points\.__class__: '__class__' cannot be a name here"),
        (changed("points", "ﬁ", to=B), "look-alike letters; write 'fi'"),
        (changed("ground", "A", to=[0.2, "S"]), r"ground\.A: .*A = Ground\(0\.2, S\) follows a stroke, but is fixed"),
        (changed("points", "D", "CD", to="G_ + 1"), r"points\.D\.CD: 'G_ \+ 1': Quantity 'G_' is unknown"),
        (changed("points", "F", to={"OnLink": ["E", "G"], "EF": 0.95}), r"points\..: .*Nothing in this cycle can come first"),
        (changed("points", "D", "CO", to=0.4), r"points\.D: .*does not fit"),
        (changed("points", "K", "KE", to=0.4), r"points\.K: .*does not fit"),
        (changed("strokes", "T", to=[0.0, 1.0]), r"strokes\.T: .*the stroke T moves nothing"),
        (changed("links", "l", to={"points": "A C"}), r"the mobility is 0, the strokes are 1"),
        (changed("links", "l", to={"points": "A"}), r"links\.l: a link joins at least two points, not A alone"),
        (changed("links", "l", to={}), r"links\.l\.points: is missing"),
        (changed("guides", "g", to={"from": "A", "with": 1}), r"guides\.g\.'?with'?: is not a key of it"),
        (changed("guides", "g", to={"from": "A"}), r"guides\.g: Guide: give its origin, and its direction"),
        (changed("drawn", "d", to={"T": 0.1}), r"drawn\.d: Stroke 'T' is unknown\. Known: S\."),
        (changed("order", to=["A", "A"]), r"order: a list of names is expected, each once"),
        (changed("order", to="A"), r"order: a list of names is expected, each once"),
        (changed("name", to="two words"), r"name: 'two words' is not a name"),
        (changed("name", drop=True), r"name: the name of the mechanism is missing; begin with name = "),
        (changed("doc", to="\x1b[2J"), r"doc: '\\x1b\[2J' is not a text of printable characters"),
        (changed("points", to=[1]), r"points: must be a table of members"),
        (changed("dimensions", "L0", to={"value": 1, "unit": "furlong"}), r"dimensions\.L0: Unit 'furlong' is unknown"),
        (changed("dimensions", "L0", to={"valu": 1}), r"dimensions\.L0: .*a dimension is a number"),
        (changed("outputs", "u", to="Turn(A, O)"), r"outputs\.u: .*Turn\(\.\.\.\) is not a quantity"),
        (changed("vectors", "v", to="angle(A, O)"), r"vectors\.v: .*angle\(\.\.\.\) is not a vector"),
        (changed("vectors", "v", to="v"), r"vectors\.v: v is a vector already"),
    ],
)  # fmt: skip
def test_mistake_is_said_in_words(tables, words):
    with pytest.raises(FileError, match=words) as caught:
        from_dict(tables)
    assert str(caught.value).startswith("the tables: ")


def test_what_cannot_be_assembled_stays_an_assembly_error():
    tables = changed("points", "K", to={"Dyad": ["M", "F"], "MK": 0.88, "FK": 0.1, "near": [1.0, 1.0]})
    with pytest.raises(AssemblyError, match=r"^the tables: points\.K: Hitch: K cannot be assembled at the sketch") as caught:
        from_dict(tables)
    assert caught.value.point == "K"


@for_all(
    ("text", "words"),
    [
        ("name = \n", "the text, line 1: Invalid value"),
        ('name = "a"\nname = "b"\n', "the text, line 2: 'name' stands twice, in line 1 first; give one of them another name"),
        ("[points]\nA = [0,\n1]\nA = [0,\n2]\n", "the text, line 4: 'A' of [points] stands twice, in line 2 first"),
        ('a = 1\n\n[x\nb = "c"\n', "the text, line 3: Expected ']'"),
        ('{"name": "a", "name": "b"}', "the text: the key 'name' stands twice"),
        ('{"a": NaN}', "the text, line 1: NaN is not a number"),
        ('{"a": -Infinity}', "the text, line 1: -Infinity is not a number"),
        ('{\n"a": 1,,\n}', "the text, line 2: Expecting property name"),
        ("{" + '"a":{' * 100_000, "nested too deeply"),
        ("a = " + "[" * 4000 + "\n", "nested too deeply"),
        ("a" + ".a" * 3000 + " = 1\n", "the line has 6005 characters, up to 5000 are read"),
        ("a = " + "9" * 4900 + "\n", "too many digits"),
        ("#\n" * 500_001, "larger than 1 MB"),
        ('name = "A"\n[points]\n' + "".join(f"a{k} = 1\n" for k in range(401)), "401 members are too many; up to 400 are read"),
        ('name = "A"\n[pins]\n' + "".join(f"a{k} = {{ near = [0, 0] }}\n" for k in range(101)), "101 sketch positions are too many"),
    ],
)  # fmt: skip
def test_text_that_is_none(text, words):
    with pytest.raises(FileError) as caught:
        load(text)
    assert words in str(caught.value)


def test_file_that_is_none(tmp_path):
    (tmp_path / "a.toml").write_bytes(b'name = "a"\n# \xff\n')
    (tmp_path / "b.toml").mkdir()
    (tmp_path / "c.toml").write_bytes(b"#" * 10_000_000)
    for name, words in {
        "a.toml": "a.toml, line 2: the file is not UTF-8 text",
        "b.toml": "b.toml: it is a folder; name a file",
        "c.toml": "c.toml: the file is larger than 1 MB",
        "d.toml": "d.toml: there is no such file; look at its name",
        "e.xml": "ends in .toml or .json",
        "a\0.toml": r"a\x00.toml: the name holds characters that no file's name can have",
    }.items():
        with pytest.raises(FileError) as caught:
            load(os.path.join(tmp_path, name))
        assert words in str(caught.value)
    with pytest.raises(FileError, match="expected, not int"):
        load(3)
    with pytest.raises(FileError, match=r"ends in \.toml or \.json"):
        save(EveryStep, tmp_path / "a.txt")
    with pytest.raises(FileError, match=r"b\.toml: it is a folder; name a file"):
        save(EveryStep, tmp_path / "b.toml")
    with pytest.raises(FileError, match=r"^/: the name of a mechanism's file ends in"):
        save(EveryStep, "/")
    with pytest.raises(FileError, match="a path is expected, not int"):
        save(EveryStep, 3)
    with pytest.raises(FileError, match=r"^a = \[+\.\.\.: the name of a mechanism's file ends in"):
        load("a = " + "[" * 9000)


@pytest.mark.parametrize("machine", [None, "EveryStep", int, object()])
def test_machine_that_is_none(machine):
    with pytest.raises(DefinitionError, match="is no mechanism; give a class of Mechanism, or a design of one"):
        to_toml(machine)
