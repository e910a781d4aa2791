"""What files say beside pins and links: slides that may not turn, names, units, what is left out; out again; and the command."""

import re
from itertools import pairwise
from math import pi

import numpy as np
import pytest

from linkage import DefinitionError, FileError, driving_force, export, pin_forces
from linkage.cli import main
from linkage.cli.machines import find
from linkage.sketch import MachineSketch, SketchDrive, SketchSlide, is_foreign, read_sketch, sketch_of, sketch_text
from tests import shipped
from tests.for_all import first_daily, for_all
from tests.linkage.sketch import emit
from tests.linkage.sketch.plans import BY_NAME
from tests.linkage.sketch.test_sketch_files import compare

CARRIAGE = "ground,input,R,0,0,0,tfft\ninput,rod,R,40,10\nrod,ram,R,160,30\nram,R,170,60\nground,ram,P,160,20,0\n"


def put(folder, name, text):
    """Write a file, and return its path as text."""
    (folder / name).write_text(text, encoding="utf-8")
    return str(folder / name)


# -- slides ------------------------------------------------------------------------------------------------


def test_what_slides_without_turning_keeps_its_direction(tmp_path):
    machine = read_sketch(put(tmp_path, "carriage.txt", CARRIAGE), scale=1e-3).to_class()()
    motion = machine.sweep(13)
    apart = motion["D"] - motion["C"]
    assert np.ptp(apart, axis=1).max() < 1e-15 and np.ptp(motion["C"][1]) < 1e-15 and np.ptp(motion["C"][0]) > 0.07


def test_a_slide_may_drive(tmp_path):
    text = "ground,ram,P,0,0,30,ffft\nram,rod,R,0,0\nrod,arm,R,100,20\narm,ground,R,100,-60\n"
    machine = read_sketch(put(tmp_path, "push.txt", text), scale=1e-3).to_class()()
    (stroke,) = machine.strokes
    turned = read_sketch(put(tmp_path, "turned.txt", text.replace(",30,", ",750,")), scale=1e-3)
    assert next(iter(turned.slides.values())).along == pytest.approx(pi / 6, rel=1e-12)
    moved = machine.at(**{stroke: [0.0, 0.01]})["B"]
    assert np.allclose(moved[:, 1] - moved[:, 0], 0.01 * np.array([np.cos(pi / 6), np.sin(pi / 6)]), atol=1e-15)


def test_a_block_that_is_welded_does_not_turn():
    near, far, high = map(emit.packed, (1000, 3000, 500))
    joints = f"6A,A,0,0,0.0B,B,{near},{high},0.8C,C,{far},0,0.5D,D,{far},0,0."
    links = "YRAB,AB,Fe,Fe,0,0,c5cae9,A,B,,.YRBC,BC,Fe,Fe,0,0,c5cae9,B,C,,.YPCD,CD,Fe,0,0,0,,C,D,,."
    body = f"2P.Ay,1E8.K,0.1011.{joints}.{links}..N_"
    sketch = read_sketch(body + emit.DIGITS[len(body) % 62])
    assert [slide.point for slide in sketch.slides.values()] == ["C", "C_1"]
    assert {"B", "C", "C_1"} in [{*each} for each in sketch.links.values()]


# -- what is told ------------------------------------------------------------------------------------------


def test_what_is_not_had_is_left_out_by_name(tmp_path):
    text = emit.linkage2(BY_NAME["Rocker"]).replace(
        "</linkage2>",
        '<Link id="8" gear="true" name="wheel"><connector id="0"/></Link><ratios><ratio type="chain"/></ratios>'
        '<connector id="50" layer="1" x="1" y="1"/><connector id="51" x="9" y="9" name="alone"/></linkage2>',
    )
    text = text.replace('id="4"', 'id="4" slider="true" slideradius="20"', 1)
    notes = " ".join(read_sketch(put(tmp_path, "told.linkage2", text)).notes)
    for words in ("the gear wheel", "a ratio of chain", "the curved slot of T", "the point alone, which is on no link", "0.255208 mm"):
        assert words in notes, (words, notes)
    assert "of one point" not in notes
    still = put(tmp_path, "still.linkage2", text.replace('input="true"', ""))
    with pytest.raises(DefinitionError, match=r"--drive O A; .*Left out: the gear wheel; the curved slot of T;"):
        read_sketch(still).to_class()


SIX_BAR = (
    "j=A,1.4,0.485,AB,R,t,0,0.1,t,%0AB,1.67,0.99,AB%7CCB,R,f,0,0.1,f,%0AC,0.255,1.035,CB%7CDCE,R,f,0,0.1,f,%0A"
    "D,0.285,0.055,DCE,R,t,0,0.1,f,%0AE,0.195,2.54,EF%7CDCE,R,f,0,0.1,f,%0AF,-0.98,2.57,EF%7CGF,R,f,0,0.1,f,%0AG,0.05,0.2,GF,R,t,0,0.1,f,"
    "&l=AB,1,1,1.5,0.7,A%7CB,,l%0ACB,1,1,1,1,C%7CB,,l%0AEF,1,1,-0.4,2.6,E%7CF,,l%0ADCE,1,1,0.2,1.7,D%7CC%7CE,,b%0A"
    "GF,1,1,-1.0,2.5,G%7CF,F1,b&f=F1,GF,-1.712,4.26,-1.712,0.508,t,true,0,100%0A&pp=&tp=&s=10,false,false,m"
)
"""A six-bar with 100 N on its last link, as PMKS+ shares it."""


def test_forces_of_pmks_plus_come_in_with_its_own_results():
    sketch = read_sketch(SIX_BAR)
    machine = sketch.to_class()()
    motion = machine.at(phi=0.0)
    assert abs(driving_force(motion) + 97.9126) < 1e-4  # printed by PMKS+, to four places
    told = {"A": (-190.6448, 6.0629), "D": (115.4646, -4.1434), "G": (75.1802, -101.9195)}
    forces = pin_forces(motion)
    for pin, body in (("A", "AB"), ("D", "DCE"), ("G", "GFG_1")):
        assert np.allclose(np.abs(np.ravel(forces.force(pin, body))), np.abs(told[pin]), atol=1e-4), pin
    assert sketch.points["G_1"] == (-1.712, 4.26) and sketch.forces["F1"].vector == (0.0, -100.0) and not sketch.notes
    assert "F1 = Force(G_1, (0.0, -100.0))" in sketch.to_python() and "F1 = { Force" in sketch.to_toml()
    inwards = read_sketch(SIX_BAR.replace("t,true,0,100", "t,false,0,100").replace("tp=&s=10,false,false", "tp=&s=10,false,true"))
    assert inwards.forces["F1"].vector == (0.0, 100.0) and inwards.notes == ("Left out: the masses of AB, CB, EF, DCE, GF.",)
    for turned, why in (("f,true", "which turns with its link"), ("t,true,0,100%0AF2,XY,0,0,1,1,t,true", "which is on no link")):
        assert why in read_sketch(SIX_BAR.replace("t,true", turned)).notes[0]
    short = (
        "2P.Ay,1E8.K,0.1011.MA,A,0,0,0.GB,B,0,Im,0.GC,C,0,0r8,0.LP,P,0,0r8,OZ..YRAB,Crank,VG,o,0,9O,c5cae9,A,B,,."
        "YRBC,Connecting rod,ku,6G,0,0HC,303e9f,B,C,,.YPCP,CP,1Tm,0,0,0,,C,P,,..2F1,BC,F1,0,0r8,0,0bW,1Xg0..N_J"
    )
    press = read_sketch(short)
    assert press.forces["F1"].point == "C" and press.forces["F1"].vector == (0.0, 400.0)
    assert press.notes == ("Left out: the masses of Crank (2), Connecting rod (3), CP (6); hang them on by Weight or LinkMass.",)


def test_many_remarks_are_the_first_few_and_a_count(tmp_path):
    text = emit.csv(BY_NAME["Rocker"])
    for count in (3, 8, 200):
        loose = "".join(f"\npoint,L-{n},{n},{n},pin" for n in range(count))
        notes = read_sketch(put(tmp_path, "loose.csv", text + loose)).notes
        (note,) = (each for each in notes if each.startswith("Left out"))
        assert note.count("which is on no link") == min(count, 8) and note.endswith(f"; and {count - 8} more." if count > 8 else "link.")


def test_a_machine_of_an_unlikely_size_asks_for_the_scale(tmp_path):
    text = put(tmp_path, "size.csv", emit.csv(BY_NAME["Rocker"]))
    for scale, asks in ((None, False), (1.0, True), (1e-6, True), (0.1, False), (1e-4, False)):
        assert any("--scale 1mm" in note for note in read_sketch(text, scale=scale).notes) == asks, scale


def test_names_are_made_legal_and_told(tmp_path):
    rows = ["kind,name,x [mm],y [mm],what", "point,1,0,0,fixed", "point,Crank,40,10,", "point,b c,150,90,", "point,lambda,160,0,fixed"]
    text = "\n".join([*rows, 'link,,,,"1 Crank"', "crank,,,,1 Crank"]).replace("b c", "b-c")
    sketch = read_sketch(put(tmp_path, "names.csv", text + "\nlink,,,,Crank b-c\nlink,,,,b-c lambda\n"))
    assert list(sketch.points) == ["P1", "Crank_2", "b_c", "lambda_2"]
    assert sketch.drives["phi"].end == 2.0 * pi  # an angle stays as it is to the last bit
    assert sketch.notes[-1] == "Named anew: 1 is P1, Crank is Crank_2, b-c is b_c, lambda is lambda_2."
    sketch.to_class()
    clash = text.replace("point,1,", "point,a,").replace("1 Crank", "a ab").replace("Crank", "ab")
    clash = clash.replace("b-c", "b").replace("lambda", "aab")
    sketch = read_sketch(put(tmp_path, "clash.csv", clash + "\nlink,,,,a ab\nlink,,,,ab b\nlink,,,,aab b\n"))
    assert list(sketch.points) == ["P1", "P2", "P3", "P4"] and sketch.to_class()


def test_a_file_without_a_unit_or_a_drive_says_which_option(tmp_path):
    text = emit.csv(BY_NAME["Rocker"])
    with pytest.raises(FileError, match="--scale 1mm"):
        read_sketch(put(tmp_path, "plain.csv", text.replace("x [mm],y [mm]", "x,y")))
    still = put(tmp_path, "still.csv", text.replace("crank,,,,O A", ""))
    with pytest.raises(DefinitionError, match=r"--drive O A; .*--cylinder P Q. Links on fixed pins: O A, C B"):
        read_sketch(still).to_class()
    assert compare(BY_NAME["Rocker"], read_sketch(still, drives=[("O", "A")]))[1] < 1e-9
    for P, Q, words in (("A", "O", "A is not fixed"), ("O", "B", "no link joins O and B"), ("O", "X", "Point 'X' is unknown")):
        with pytest.raises(DefinitionError, match=words):
            read_sketch(still, drives=[(P, Q)])
    assert read_sketch(still, cylinders=[("O", "T")]).drives["S"].ends == ("O", "T")
    for amounts, stroke in (((0.3,), (0.0, 0.3)), ((-0.02, 0.3), (-0.02, 0.3)), ((0.15, 0.2), (0.0, 0.05))):
        sketch = read_sketch(still, cylinders=[("O", "T", *amounts)])
        drive = sketch.drives["S"]
        assert (drive.start, drive.end) == pytest.approx(stroke)
        assert amounts != (0.15, 0.2) or sketch.length("O", "T") - drive.drawn == pytest.approx(0.15, rel=1e-12)
    for amounts, words in (((0.3, 0.4), "which is not from 300 mm to 400 mm"), ((0.0,), "needs a stroke"), ((0.1, 0.2, 0.3), "how far")):
        with pytest.raises(DefinitionError, match=words):
            read_sketch(still, cylinders=[("O", "T", *amounts)])


def test_a_table_may_have_other_marks_and_units(tmp_path):
    text = emit.csv(BY_NAME["Rocker"]).replace("crank,,,,O A", "crank,psi,,,O A -20deg 40.5deg")
    expected = read_sketch(put(tmp_path, "plain.csv", text))
    assert np.degrees([expected.drives["psi"].start, expected.drives["psi"].end]) == pytest.approx([-20.0, 40.5])
    for changed in (text.replace(",", "\t"), "\n" + text.replace("mm", "MM"), f"# by hand\n{text}\n# as measured"):
        assert read_sketch(put(tmp_path, "Plain.csv", changed)).points == expected.points
    for mark in ";\t":
        table = text.replace(",", mark).replace("40.5deg", "40,5deg").replace(f"{mark}40{mark}", f"{mark}40,0{mark}")
        assert read_sketch(put(tmp_path, "Plain.csv", table)) == expected


@pytest.mark.slow
def test_a_length_of_a_row_is_in_the_unit_of_the_table_unless_it_has_its_own(tmp_path):
    head, rows = "kind,name,x{0},y{0},what\n", "point,A,0,0,fixed\npoint,B,300,0,\nlink,,,,A B\ncylinder,lift,,,A B {1}\n"
    units = (" [mm]", None, 1e-3), (" [cm]", None, 1e-2), (" [in]", None, 0.0254), ("", 1e-3, 1e-3), (" [mm]", 0.01, 0.01)
    for unit, scale, one in units:
        for reach, start, end in (
            ("550", 0.0, 550 * one), ("-20 40", -20 * one, 40 * one), ("550mm", 0.0, 0.55), ("-2cm 40", -0.02, 40 * one),
            ("-1 40mm", -one, 0.04), ("-30", 0.0, -30 * one),
        ):  # fmt: skip
            drive = read_sketch(put(tmp_path, "lift.csv", (head + rows).format(unit, reach)), scale=scale).drives["lift"]
            assert (drive.start, drive.end) == pytest.approx((start, end), rel=1e-14), (unit, scale, reach)
    for row in ("crank,,,,A B 360", "crank,,,,A B -1 2", "slide,,,,B 30"):
        with pytest.raises(FileError, match=r"line 5: the angle '.*' has no unit; write '.*deg'"):
            read_sketch(put(tmp_path, "turn.csv", head.format(" [mm]") + rows.partition("cylinder")[0] + row))


# -- out again ---------------------------------------------------------------------------------------------


@first_daily(1, "suffix", [".linkage2", ".csv", ".txt"])
def test_a_sketch_goes_out_and_comes_in_again(suffix, tmp_path):
    for name in ("four_bar", "slider_crank", "inverted_slider_crank", "three_point_hitch"):
        sketch = sketch_of(shipped.MACHINES[name])
        if suffix == ".txt" and name == "three_point_hitch":
            with pytest.raises(DefinitionError, match="one crank and no other drive, the sketch a cylinder"):
                sketch_text(sketch, suffix)
            continue
        again = read_sketch(put(tmp_path, f"Again{suffix}", sketch_text(sketch, suffix)), scale=1e-3 if suffix == ".txt" else None)
        near = nearest(again, sketch.points)
        (one, drive), (other, _) = *sketch.drives.items(), *again.drives.items()
        values = np.linspace(drive.start, drive.end, 7)
        first, second = sketch.to_class()().at(**{one: values}), again.to_class()().at(**{other: values - drive.drawn})
        for point, found in near.items():
            assert np.max(np.abs(first[point] - second[found])) < 1e-9 * sketch.size, (name, point)


def test_what_is_short_in_a_file_is_short_in_every_file_that_is_written(tmp_path):
    chance = np.random.default_rng(7)
    for unit, digits in (("mm", 1), ("cm", 2), ("m", 4)):
        factor = {"mm": 1, "cm": 10, "m": 1000}[unit]
        ends = np.round(np.r_[700, 1150, chance.uniform(100, 2000, 8)] / factor, digits)
        points = "".join(f"point,P{n},{x!r},{y!r},\n" for n, (x, y) in enumerate(ends.reshape(5, 2).tolist()))
        head = f"kind,name,x [{unit}],y [{unit}],what\npoint,O,0,0,fixed\n{points}link,,,,O P0\n"
        links = "".join(f"link,,,,P{n} P{n - 1} O\n" for n in range(1, 5))
        sketch = read_sketch(put(tmp_path, "a.csv", head + links + "cylinder,,,,O P4 0.7mm 1150.1mm\n"))
        assert sketch.points["P0"] == tuple(float(f"{each * factor / 1e3:.12g}") for each in ends[:2])
        assert (sketch.drives["S"].start, sketch.drives["S"].end) == (0.0007, 1.1501)
        assert sketch_text(sketch, ".csv").splitlines()[-1] == "cylinder,S,,,O P4 0.7mm 1150.1mm"
        for write in (lambda each: repr(each.points), lambda each: repr(each.drives), lambda each: sketch_text(each, ".csv")):
            assert not re.search(r"\d\.\d*(0{8}|9{8})\d", write(sketch)), (unit, write(sketch))


def nearest(sketch, places):
    """Return the points of a sketch that are nearest to places, by the names of these."""
    return {name: min(sketch.points, key=lambda each: np.hypot(*np.subtract(sketch.points[each], place))) for name, place in places.items()}


def test_what_does_not_fit_is_refused():
    points = dict(O=(0.0, 0.0), A=(0.1, 0.0), B=(-0.1, 0.0))
    twins = MachineSketch("Twins", points, ("O",), dict(a=("O", "A"), b=("O", "B")), drives={
        name: SketchDrive("crank", ("O", point), 0.0, 1.0) for name, point in (("p", "A"), ("q", "B"))
    })  # fmt: skip
    for suffix, words in ((".linkage2", "two cranks turn about one pin"), (".txt", "a crank, a crank"), (".doc", "says no kind of file")):
        with pytest.raises(DefinitionError, match=words):
            sketch_text(twins, suffix)
    crossed = MachineSketch("Crossed", points, ("O",), {}, slides={"u": SketchSlide("A", 0.0), "v": SketchSlide("A", ("O", "B"))})
    with pytest.raises(DefinitionError, match="A runs on two lines"):
        sketch_text(crossed, ".linkage2")
    with pytest.raises(DefinitionError, match="where its stroke begins"):
        sketch_text(sketch_of(shipped.MACHINES["three_point_hitch"], {"S": 0.1}), ".linkage2")


# -- the command -------------------------------------------------------------------------------------------


def test_the_command_imports_and_every_other_takes_the_file(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    file = put(tmp_path, "rocker.csv", emit.csv(BY_NAME["Rocker"]))
    for ending in ("toml", "py"):
        assert main(["import", file, "-o", f"rocker.{ending}"]) == 0
        assert main(["show", f"rocker.{ending}"]) == 0
    assert "phi  0 to 360 deg" in capsys.readouterr().out
    assert main(["show", file]) == 0 and main(["draw", file, "-o", "rocker.png"]) == 0 and (tmp_path / "rocker.png").stat().st_size > 1000
    assert main(["show", emit.short_body(BY_NAME["Pump"])]) == 0
    assert main(["import", file, "--round", "10mm", "--drive", "O", "A=-20:90deg", "-o", "round.toml"]) == 0
    assert 'phi = ["-20 deg", "90 deg"]' in (tmp_path / "round.toml").read_text()
    assert "moves most, by" in capsys.readouterr().err
    assert main(["import", file]) == 2  # rocker.toml is there


def test_the_command_ends_with_2_and_the_option_that_helps(tmp_path, capsys):
    plain = put(tmp_path, "plain.txt", emit.pmks(BY_NAME["Rocker"]))
    for arguments, words in (
        (["import", plain, "-o", str(tmp_path / "a.toml")], "--scale 1mm"),
        (["show", plain], "--scale 1mm"),
        (["import", plain, "--scale", "1mm", "--drive", "O", "A=90"], "say the unit too, such as A=90deg"),
        (["import", plain, "--scale", "1mm", "-o", str(tmp_path / "a.doc")], ".doc says no kind of file"),
        (["import", plain, "--scale", "1kg"], "value of kind length"),
        (["import", str(tmp_path / "nowhere.csv")], "there is no such file"),
        (["import", plain, "--scale", "1mm", "--drive", "B", "A"], "is not fixed"),
    ):
        assert main(arguments) == 2
        assert words in capsys.readouterr().err, arguments
    assert not (tmp_path / "a.toml").exists()


@pytest.mark.slow
def test_no_file_of_another_program_is_written_over(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, text in (("a.csv", emit.csv(BY_NAME["Rocker"])), ("a.linkage2", emit.linkage2(BY_NAME["Rocker"])), ("b.csv", "1,2\n")):
        put(tmp_path, name, text)
    (tmp_path / "link.toml").symlink_to(tmp_path / "a.csv")
    for source in ("a.csv", "a.linkage2"):
        for target in ("a.csv", f"./{source}", str(tmp_path / source), "a.linkage2", "b.csv"):
            before = (tmp_path / target).read_text()
            assert main(["import", source, "-o", target]) == 2
            told = capsys.readouterr().err
            assert "stays as it is; choose another name" in told and (source not in target or "is the file that is imported" in told)
            assert (tmp_path / target).read_text() == before
    assert main(["import", "a.csv", "-o", "link.toml"]) == 2 and "is the file that is imported" in capsys.readouterr().err
    assert main(["import", "a.csv", "-o", "a.toml"]) == main(["import", "a.csv", "-o", "a.toml"]) == 0


def test_files_of_our_own_are_not_taken_for_others(tmp_path):
    from linkage.files import to_json

    own = put(tmp_path, "own.json", to_json(shipped.MACHINES["four_bar"]))
    assert not is_foreign(own) and not is_foreign("four_bar") and not is_foreign("x.toml")
    assert main(["show", own]) == 0
    assert is_foreign(put(tmp_path, "other.json", emit.plus_json(BY_NAME["Rocker"])))


def test_layers_of_a_drawing_are_named(tmp_path):
    import ezdxf

    document = ezdxf.new(units=4)
    space = document.modelspace()
    for name, place in BY_NAME["Rocker"].points.items():
        space.add_circle(place, 3.0, dxfattribs={"layer": "Bolts" if name not in "OC" else "Frame"})
    space.add_circle((500.0, 500.0), 9.0, dxfattribs={"layer": "notes"})
    for pair in ("OA", "AB", "BT", "TA", "BC"):
        space.add_line(*(BY_NAME["Rocker"].points[each] for each in pair), dxfattribs={"layer": "Bars"})
    space.add_line((0, 0), (900, 900), dxfattribs={"layer": "Bars"})
    path = tmp_path / "layers.dxf"
    document.saveas(path)
    layers = dict(pins=["Bolts"], ground=["Frame"], links=["Bars"])
    sketch = read_sketch(path, layers=layers)
    assert len(sketch.points) == 5 and sketch.fixed == ("P4", "P5")
    assert "a line of the layer Bars with 1 pins: no pin at (900, 900)." in sketch.notes[-1]
    assert compare(BY_NAME["Rocker"], read_sketch(path, layers=layers, drives=[("P4", "P1")]))[1] < 1e-9
    with pytest.raises(DefinitionError, match="a layer is of pins, links, ground"):
        read_sketch(path, layers=dict(bolts=["Bolts"]))
    for role in layers:
        with pytest.raises(DefinitionError, match=rf"'Bolt' is unknown in .*{role}=Bolt. Did you mean Bolts\? Known: Frame, Bolts, notes"):
            read_sketch(path, layers={**layers, role: ["notes", "Bolt"]})
    with pytest.raises(DefinitionError, match="only a drawing"):
        read_sketch(put(tmp_path, "a.csv", emit.csv(BY_NAME["Rocker"])), layers=layers)


def test_plates_of_a_drawing_are_outlines_of_their_links_and_one_of_the_frame_fixes_its_pins(tmp_path):
    import ezdxf

    document = ezdxf.new(units=4)
    space, rocker = document.modelspace(), document.blocks.new("ROCKER")
    pins = dict(O=(0, 0), C=(200, 0), A=(40, 60), B=(170, 120))
    for name, place in pins.items():
        space.add_circle(place, 4)
        space.add_text(name, dxfattribs={"insert": place, "height": 5})
    space.add_lwpolyline([(-30, -30), (230, -30), (230, 15), (-30, 15)], close=True, dxfattribs={"layer": "FRAME"})
    space.add_lwpolyline(arm := [(-8, -8), (10, -8), (50, 55), (45, 70), (30, 68)], close=True, dxfattribs={"layer": "ARM"})
    for P, Q in pairwise([(30, 52), (182, 115), (172, 132), (35, 72), (30, 52)]):
        space.add_line(P, Q, dxfattribs={"layer": "LINK"})
    rocker.add_lwpolyline([(-9, -9), (9, -9), (-22, 128), (-38, 128)], close=True)
    rocker.add_line((0, 0), (20, 20))
    space.add_blockref("ROCKER", (200, 0))
    document.saveas(path := tmp_path / "plates.dxf")
    found = read_sketch(path, layers=dict(ground=["FRAME"]), drives=[("O", "A")])
    assert found.fixed == ("O", "C") and [on for on, _ in found.outlines.values()] == [(), ("O", "A"), ("C", "B"), ("A", "B")]
    assert "Left out: a line of the block ROCKER with 1 pins: no pin at (220, 20)." in found.notes
    along = complex(40, 60) / abs(complex(40, 60))
    drawn = [1e3 * complex(*corner) * along for corner in found.outlines["plate_2"][1]]
    assert np.allclose(drawn, [complex(*corner) for corner in arm], atol=2e-3)
    written = {"plates.toml": found.to_toml(), "plates.py": found.to_python()}
    for kind in (found.to_class(), *(find(put(tmp_path, name, text)) for name, text in written.items())):
        assert [name for name in kind.plan.members if name.startswith("plate")] == ["plate", "plate_2", "plate_3", "plate_4"]
        assert kind.plan.members["plate_2"].on == ("O", "A")
    assert found.rounded(0.001).outlines == found.outlines


def cad_drawing(how):
    """Return a rocker O A B C drawn in one of the ways of CAD: mirrored blocks, circles seen from behind, trimmed and doubled lines."""
    import ezdxf

    places = dict(O=(0.0, 0.0), A=(40.0, 15.0), B=(150.0, 110.0), C=(160.0, 0.0))
    document = ezdxf.new(units=14 if how == "decimetres" else 4)
    space = document.modelspace()
    drawn = document.blocks.new("M") if how in ("mirrored", "turned") else space
    pin = document.blocks.new("PIN")
    pin.add_circle((0, 0), 4)
    pin.add_attdef("NAME", (3, 3), dxfattribs={"height": 2.5})
    for name, (x, y) in places.items():
        layer = {"layer": "Ground" if name in "OC" else "0"}
        if how == "blocks":
            space.add_blockref("PIN", (x, y), dxfattribs=layer).add_auto_attribs({"NAME": name})
            continue
        sense = -1 if how == "from behind" else 1
        drawn.add_circle((sense * x, y), 4, dxfattribs={**layer, "extrusion": (0, 0, sense)})
        text = {"insert": (x - 6, y - 14), "rotation": 90, "height": 6} if how == "upright" else {"insert": (x, y)}
        drawn.add_text(name, dxfattribs=text)
    for ends, layer in (("OA", "CRANK"), ("AB", "0"), ("BC", "0"), *([("BA", "0")] if how == "doubled" else [])):
        P, Q = (np.array(places[each]) for each in ends)
        along = 4.0 * (Q - P) / np.linalg.norm(Q - P)
        if how == "edges" and layer == "0":  # a bar with round ends, of two lines and two arcs
            side, angle = 2.0 * along @ [[0.0, 1.0], [-1.0, 0.0]], np.degrees(np.arctan2(*along[::-1]))
            drawn.add_line(P + side, Q + side)
            drawn.add_line(Q - side, P - side)
            drawn.add_arc(Q, 8.0, angle - 90.0, angle + 90.0)
            drawn.add_arc(P, 8.0, angle + 90.0, angle + 270.0)
            continue
        cut = along if how == "trimmed" else 0.0
        drawn.add_line(P + cut, Q - cut, dxfattribs={"layer": layer})
    if how in ("mirrored", "turned"):
        space.add_blockref("M", (7, 9), dxfattribs={"xscale": -1} if how == "mirrored" else {"rotation": 30, "xscale": 2, "yscale": 2})
    if how == "hidden":
        document.layers.add("help").off()
        space.add_line(places["A"], places["C"], dxfattribs={"layer": "help"})
        space.add_line(places["O"], places["B"], dxfattribs={"invisible": 1})
    return document, places


WAYS = "plain", "mirrored", "turned", "from behind", "blocks", "upright", "doubled", "trimmed", "hidden", "decimetres", "edges"


@for_all("how", WAYS)
def test_a_drawing_gives_one_machine_however_cad_writes_it(how, tmp_path):
    document, places = cad_drawing(how)
    document.saveas(tmp_path / "m.dxf")
    sketch = read_sketch(tmp_path / "m.dxf")
    assert {*map(frozenset, sketch.links.values())} == {*map(frozenset, ("OA", "AB", "BC"))} and len(sketch.links) == 3
    assert {*sketch.fixed} == {"O", "C"} and sketch.drives["phi"].ends == ("O", "A")
    found = {name: complex(*sketch.points[name]) for name in places}
    one = {"decimetres": 0.1, "turned": 2e-3}.get(how, 1e-3)
    for P, Q in ("OA", "AB", "BC", "OC", "OB"):
        assert abs(found[Q] - found[P]) == pytest.approx(one * np.hypot(*np.subtract(places[Q], places[P])), rel=1e-12)
    turn = ((found["C"] - found["O"]).conjugate() * (found["B"] - found["O"])).imag
    assert turn < 0.0 if how == "mirrored" else turn > 0.0
    assert any("hides, 2 of 13 entities" in note for note in sketch.notes) == (how == "hidden")


def test_a_block_scaled_by_two_numbers_is_refused_with_the_remedy(tmp_path):
    document, _ = cad_drawing("mirrored")
    (block,) = document.modelspace().query("INSERT")
    block.dxf.yscale = 2.0
    document.saveas(tmp_path / "m.dxf")
    with pytest.raises(FileError, match="ellipses: a block scaled by two numbers makes them of circles; insert it with one scale"):
        read_sketch(tmp_path / "m.dxf")


TABLES = {
    "semicolons": lambda text: text.replace(",", ";").replace(".5", ",5"),
    "a line that says sep=": lambda text: "sep=;\n" + text.replace(",", ";"),
    "tabs, as Unicode text": lambda text: text.replace(",", "\t").encode("utf-16"),
    "letters of Windows": lambda text: text.replace("flap", "ü").encode("cp1252"),
    "empty columns behind": lambda text: text.replace("\n", ",,,\n"),
    "a minus sign of print": lambda text: text.replace("-1020.5", "\u22121020.5"),
    "commas in a list": lambda text: text.replace("O B T", '"O, B, T"'),
    "a space before the unit": lambda text: text.replace("300mm", "300 mm"),
}


@for_all("how", TABLES)
def test_a_table_gives_one_machine_however_a_spreadsheet_writes_it(how, tmp_path):
    text = "kind,name,x [mm],y [mm],what\npoint,O,0,0,fixed\npoint,A,50,600,fixed\npoint,B,420,-1020.5,pin\npoint,T,900,30,pin\n"
    text += "link,flap,,,O B T\ncylinder,S,,,A B -0mm 300mm\n"
    plain = read_sketch(put(tmp_path, "plain.csv", text))
    written = TABLES[how](text)
    (tmp_path / "t.csv").write_bytes(written if isinstance(written, bytes) else written.encode())
    found = read_sketch(tmp_path / "t.csv")
    assert (found.points, found.fixed, [*found.links.values()]) == (plain.points, plain.fixed, [*plain.links.values()])
    assert found.drives == plain.drives and found.points["B"] == (0.42, -1.0205)


def test_a_decimal_comma_does_not_shift_the_columns_of_a_table(tmp_path):
    from linkage.files.source import measured_columns

    path = tmp_path / "cycle.csv"
    path.write_text("a [mm],b [mm]\n10,5,20,5\n")
    with pytest.raises(DefinitionError, match=r"cycle\.csv, line 2: 4 cells stand under 2 headings; texts with a comma stand in quotes"):
        measured_columns(path, "csv", lambda name: ("length",))


def test_a_drawing_of_this_package_is_told_from_a_machine(tmp_path):
    drawing = export(shipped.MACHINES["four_bar"](), tmp_path / "bar.dxf")
    with pytest.raises(FileError, match="true-size drawing of this package, whose bodies are outlines; import the machine's own file"):
        read_sketch(drawing)
    found = read_sketch(drawing, layers={"links": ["centre_lines"]}, drives=[])
    assert {*found.points} >= {"O", "A", "B", "C"} and ("A", "B") in [points[:2] for points in found.links.values()]


@pytest.mark.parametrize("style", ["lwpolyline", "polyline2d"])
def test_outlines_with_round_ends_and_hatches_of_any_border_are_read(style, tmp_path):
    import ezdxf

    plan, width = BY_NAME["Rocker"], 6.0
    document = ezdxf.new(units=4)
    space = document.modelspace()
    for name, (x, y) in plan.points.items():
        space.add_circle((x, y), 3.0)
        space.add_text(name, dxfattribs={"insert": (x + 1, y + 1)})
    space.add_hatch().paths.add_edge_path().add_arc(plan.points["O"], 4.0)
    space.add_hatch().paths.add_edge_path().add_ellipse(plan.points["C"], (4.0, 0.0), 0.8)
    space.add_hatch().paths.add_edge_path().add_spline(control_points=[(0, 0)])  # no border at all
    for P, Q in ("OA", "AB", "BT", "TA", "BC"):
        p, q = (np.array(plan.points[each], float) for each in (P, Q))
        side = width * np.array([p[1] - q[1], q[0] - p[0]]) / np.linalg.norm(q - p)
        corners = [(*(p - side), 0.0), (*(q - side), 1.0), (*(q + side), 0.0), (*(p + side), 1.0)]
        getattr(space, f"add_{style}")(corners, format="xyb", close=True, dxfattribs={"layer": "links"})
    document.saveas(tmp_path / "round.dxf")
    sketch = read_sketch(tmp_path / "round.dxf", drives=[("O", "A")])
    assert [{*points} for points in sketch.links.values()] == [{*"OA"}, {*"AB"}, {*"BT"}, {*"TA"}, {*"BC"}]
    assert sketch.fixed == ("O", "C") and compare(plan, sketch)[1] < 1e-9


def test_plates_on_one_layer_that_lie_over_each_other_are_told(tmp_path):
    emit.dxf(BY_NAME["Bucket"], tmp_path / "plates.dxf", "plates")
    told = " ".join(read_sketch(tmp_path / "plates.dxf").notes)
    assert "surround two pins or more together" in told and "draw each part in a block or on a layer of its own" in told


def test_an_outline_that_is_open_by_a_little_is_told_with_its_place(tmp_path):
    import ezdxf

    document = ezdxf.new(units=4)
    space = document.modelspace()
    corners = [(-30.0, -30.0), (330.0, -30.0), (330.0, 30.0), (-30.0, 30.0)]
    for P, Q in zip(corners, [(329.2, -30.0), *corners[2:], corners[0]], strict=True):
        space.add_line(P, Q)
    for x in (0.0, 300.0):
        space.add_circle((x, 0.0), 8.0)
        space.add_line((x, -1.0), (x, 1.0))  # its centre's mark, and a tick beside it
        space.add_line((x, 20.0), (x, 20.1))
    space.add_line((0.0, 0.0), (300.0, 0.0))
    space.add_hatch().paths.add_edge_path().add_arc((0.0, 0.0), 10.0)
    document.saveas(tmp_path / "open.dxf")
    notes = " ".join(read_sketch(tmp_path / "open.dxf", drives=[]).notes)
    assert "An outline is open by 0.8 near (329.2, -30): let its lines meet, and it is a plate." in notes


def test_a_board_tells_which_forces_it_leaves_out(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "six.toml").write_text(read_sketch(SIX_BAR).to_toml(), encoding="utf-8")
    for opened, said in ((SIX_BAR, "Left out: F1, as the board has no forces."), ("six.toml", "Not in the sketch of Shared: F1.")):
        assert main(["board", opened]) == 0
        assert said in capsys.readouterr().err
