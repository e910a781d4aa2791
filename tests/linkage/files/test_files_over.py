"""`[over.NAME]`: a file says where a machine is looked at, in boxes, paths and poses; what it says is answered as in Python."""

import pytest

from linkage import (
    Crank,
    DefinitionError,
    Dimension,
    FileError,
    Ground,
    LoadCase,
    Mechanism,
    OnLink,
    Over,
    Stroke,
    Weight,
    deg,
    drive_force,
    most,
    ref,
    x,
    y,
)
from linkage.files import from_dict, load, to_dict, to_json, to_toml
from linkage.files.synthesis_file import read_search
from tests.for_all import for_all


class Crane(Mechanism):
    """A boom that is turned, and a telescope."""

    phi = Stroke(15 * deg, 80 * deg)
    t = Stroke(0.0, 1.5)
    long = Dimension(1.2)
    O = Ground(0.0, 1.0)
    K = Crank(O, OK=3.0, angle=phi)
    T = OnLink("O", "K", OT=3.0 + ref("t"))
    out = x("T")
    load = Weight(T, mass=500)
    full = LoadCase("full", scale={"load": 2.0})

    anywhere = Over()
    loading = Over(phi=(20 * deg, 70 * deg), only=[x("T") <= 4, ref("out") >= 1.5], cases=("full",))
    follows = Over(phi=30 * deg, t=(ref("long") * 0.25, "long"))
    drive = Over.path(phi=[80 * deg, 60 * deg, 60 * deg], t=0.0, lost="allowed", cases=("plain", "full"))
    stops = Over.poses(phi=[0.3, 0.7, 1.1], t=[0.0, 1.5, 0.5], only=[y("T") <= 4])


OVERS = ["anywhere", "loading", "follows", "drive", "stops"]


def own(machine, name):
    """Return an Over of a machine by its name."""
    return machine.plan.of_kind(Over)[name]


def test_file_of_overs_reads_as_it_is_written():
    tables = to_dict(Crane)["over"]
    assert tables == {
        "anywhere": {},
        "loading": {"phi": ["20 deg", "70 deg"], "only": ["x(T) <= 4.0", "out >= 1.5"], "cases": ["full"]},
        "follows": {"phi": "30 deg", "t": ["long * 0.25", "long"]},
        "drive": {"path": True, "phi": ["80 deg", "60 deg", "60 deg"], "t": 0.0, "cases": ["plain", "full"], "lost": "allowed"},
        "stops": {"poses": True, "phi": [0.3, 0.7, 1.1], "t": [0.0, 1.5, 0.5], "only": ["y(T) <= 4.0"]},
    }


@for_all("back", [load(to_toml(Crane)), load(to_json(Crane)), from_dict(to_dict(Crane))], ids=["toml", "json", "dict"])
@for_all("name", OVERS)
def test_what_a_file_says_is_answered_as_the_class_answers(back, name):
    assert to_toml(back) == to_toml(Crane)
    for design in (Crane, back):
        assert [each.name for each in design().overs] == OVERS
    questions = [most("out"), most(drive_force("phi"))]
    said, read = (machine(long=1.0).answers(questions, over=own(machine, name)) for machine in (Crane, back))
    assert [(each.value, each.strokes, each.case) for each in said] == [(each.value, each.strokes, each.case) for each in read]


def test_ends_that_follow_the_design_move_with_it():
    back = load(to_toml(Crane))
    for long in (0.8, 1.2):
        (answer,) = back(long=long).answers([most("out")], over=own(back, "follows"))
        assert answer.value == pytest.approx((3.0 + long) * 3**0.5 / 2, rel=1e-12)  # OT * cos 30 deg at the end of the telescope
        assert answer.strokes["t"] == long


def test_subclass_drops_one():
    class Indoors(Crane):
        loading = None
        drive = Over(t=0.0)

    assert [each.name for each in Indoors().overs] == ["anywhere", "follows", "drive", "stops"]
    assert "loading" not in load(to_toml(Indoors)).plan.members
    assert str(own(Indoors, "drive")) == "Over(t=0.0)"


BASE = """
name = "Lever"
[strokes]
S = [0, 0.2]
phi = [0, "90 deg"]
[ground]
A = [0, 0]
[points]
B = { Crank = "A", AB = "0.5 + S", angle = "phi" }
[over]
loading = """


@for_all(
    ("entry", "words"),
    [
        ("3", "3 is not a table of strokes, such as"),
        ("{ T = 1 }", "Stroke 'T' is unknown. Known: S, phi. Beside strokes there are path, poses, only, cases, lost, time, csv."),
        ("{ path = true, S = [0, 0.1] }", "it does not say where phi stand; give phi=..., one number where it is held."),
        ("{ path = true, poses = true, S = [0, 0.1], phi = 0 }", "it is a path and poses at once"),
        ("{ path = 3 }", "path is true or false; leave it out for a box."),
        ("{ path = true, S = [0, 0.1], phi = [0, 1, 2] }", "give each stroke as many"),
        ("{ phi = [0, 1, 2] }", "places in an order are Over.path"),
        ('{ only = ["x(B)"] }', 'write a comparison in quotes, "x(T) <= 4", with <= or >=.'),
        ('{ only = ["x(B) < 3"] }', "with <= or >=."),
        ("{ only = true }", "is no condition on poses"),
        ('{ only = ["x(Q) <= 3"] }', "Point 'Q' is unknown. Known: A, B."),
        ('{ only = "3 <= 4" }', "compares two numbers; one side is a quantity such as x(T)."),
        ('{ cases = ["full"] }', "Load case 'full' is unknown in Lever.loading. Known: plain."),
        ('{ cases = "plain" }', "a list of load cases is expected"),
        ('{ lost = "yes" }', '"allowed" is expected, or nothing'),
        ('{ S = "5 parsec" }', "'5 parsec': Unit 'parsec' is unknown. Known: m, mm,"),
        ('{ S = "5 baar" }', "'5 baar': Unit 'baar' is unknown. Did you mean bar? Known: m, mm,"),
        ('{ S = "5 phi" }', "'5 phi': an operator or the end is expected where 'phi' stands"),
        ('{ S = [0, "AB"] }', "Quantity 'AB' is unknown."),
    ],
)
def test_mistake_has_its_line_and_key(entry, words):
    with pytest.raises(FileError) as caught:
        load(f"{BASE}{entry}\n")
    assert "line 11, over.loading: " in str(caught.value) and words in str(caught.value)


def test_one_condition_stands_without_a_list_and_either_way_round():
    for text in ('"2 >= x(B)"', '["x(B) <= 2"]'):
        (over,) = load(f"{BASE}{{ only = {text} }}\n").plan.of_kind(Over).values()
        assert list(map(str, over.only)) == ["x(B) <= 2.0"]


def test_condition_on_a_request_stays_in_python():
    class Loaded(Crane):
        light = Over(only=[drive_force("phi") <= 1000])

    with pytest.raises(DefinitionError, match=r"Loaded\.light cannot be written into a file: .*and drive_force\(phi\) is a request; take"):
        to_toml(Loaded)


SEARCH = """
machine = "crane"
maximise = "most(out)"
vary = { OK = "2 to 4 m" }
"""


def read(text, tmp_path):
    """Return the search of a text."""
    path = tmp_path / "search.toml"
    path.write_text(SEARCH + text)
    return read_search(path, lambda name, folder: Crane)


def test_search_names_a_declared_over(tmp_path):
    assert read('over = "follows"', tmp_path).arguments["over"] == dict(Crane.follows.strokes)
    with pytest.raises(FileError, match=r"line 5, over: Over 'lifting' is unknown in Crane\..*Known: anywhere, loading, follows"):
        read('over = "lifting"', tmp_path)
    with pytest.raises(FileError, match=r"line 5, over: loading = Over\(.* is more than parts of strokes"):
        read('over = "loading"', tmp_path)
