"""Files that are damaged or meant to harm: every one ends in words, and none runs, fetches or fills anything."""

import json
import random
import re

import pytest

from linkage.errors import LinkageError
from linkage.sketch import read_sketch
from tests.linkage.sketch import emit
from tests.linkage.sketch.plans import BY_NAME

BITS = ["", *'-"\0é0P,|\n', "nan", "inf", "1e999", "null", "{}", "[]", "<a>", "&x;", "-1", "true", "9" * 30, "..", "%00"]
LINKAGE = emit.linkage2(BY_NAME["Rocker"])
HEAD = "kind,name,x [mm],y [mm],what\n"
BODIES = '{"version": 2, "units": {"length": "cm"}, "bodies": [%s], "attachments": [{"id": "p", "bodyId": "a"}]}'
WRONG = {
    "entities.linkage2": ('<!DOCTYPE a [<!ENTITY x "y">]>' + LINKAGE.split("\n", 1)[1], "document type or entities"),
    "outside.linkage2": ('<!DOCTYPE a SYSTEM "file:///etc/passwd"><linkage2>&x;</linkage2>', "document type or entities"),
    "deep.linkage2": ("<linkage2>" + "<a>" * 5000 + "</a>" * 5000 + "</linkage2>", "more than 8 deep"),
    "torn.linkage2": (LINKAGE[:200], "it is no XML"),
    "other.linkage2": ("<svg></svg>", "begins with <svg>"),
    "twice.linkage2": (LINKAGE.replace('id="1" x', 'id="0" x', 1), "two connectors have one id"),
    "nan.linkage2": (LINKAGE.replace('y="0.0"', 'y="nan"', 1), "is no finite number"),
    "wide.linkage2": (LINKAGE.replace('y="0.0"', 'y="1e300"', 1), "'1e300' is too large"),
    "lost.linkage2": (LINKAGE.replace('<connector id="2"/>', '<connector id="77"/>', 1), "names the point '77'"),
    "big.csv": (HEAD + "#" * 1_000_001, "larger than 1 MB"),
    "afloat.csv": (HEAD + "point,A,0,0,\npoint,B,9,0,\npoint,C,9,9,\nlink,,,,A B\ncylinder,,,,B C", "no pin is fixed"),
    "many.csv": (
        HEAD + "point,O,-9,0,fixed\n" + "".join(f"point,P{n},{n},{n * n},\nlink,,,,P0 P{n}\n" for n in range(150)) + "crank,,,,P0 P1",
        "too many",
    ),
    "code.csv": ("kind,name,x [mm],y [mm],what\npoint,O,__import__('os').abort(),0,fixed\n", "is no finite number"),
    "twice.csv": ("kind,name,x [mm],y [mm],what\npoint,O,0,0,fixed\npoint,O,1,0,\n", "stands twice"),
    "head.csv": ("a,b\n1,2\n", "begins with kind,name"),
    "kind.csv": ("kind,name,x [mm],y [mm],what\nspring,O,0,0,fixed\n", "line 2: spring is none of point, link, slide"),
    "empty.csv": ("", "the file is empty"),
    "long.csv": (HEAD + "point," + "O" * 200_000, "long.csv, line 2: it cannot be read as a table"),
    "blank.csv": (",,,\n", "the table has no rows"),
    "binary.txt": ("\0\1\2", "no text"),
    "words.txt": ("hello world\n", "joint 1: links, R, P, RP or G"),
    "letter.txt": ("ground,arm,R,0,a\n", "letter.txt, joint 1, y: 'a' is no finite number"),
    "slide.txt": ("ground,input,P,0,0\n", "has the angle of its slide"),
    "frame.txt": ("ground,arm,R,0,0\nground,gnd,P,0,0,0\n", "joint 2: both links of P are the frame"),
    "three.txt": ("ground,arm,R,0,0\na,b,a,P,0,0,0\n", "joint 2: P joins two links"),
    "deep.json": ("[" * 100_000, "nested too deeply"),
    "nan.json": ('{"joints": [{"type": "Static", "name": "A", "x": NaN, "y": 0}]}', "NaN is not a number"),
    "keys.json": ('{"joints": [], "joints": []}', "stands twice"),
    "other.json": ('{"a": 1}', "no machine of PMKS+"),
    "kind.json": ('{"joints": [{"type": "Spring", "name": "A", "x": 0, "y": 0}]}', "of the kind 'Spring'"),
    "lost.json": ('{"joints": [{"type": "Crank", "name": "A", "x": 0, "y": 1, "joint0": {"ref": "Z"}}]}', "names the point 'Z'"),
    "pose.json": (BODIES % '{"id": "a"}', "a pose is no table"),
    "machine.exe": ("MZ", "ends in one of .csv"),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_it_is_refused_in_words(name, tmp_path):
    text, words = WRONG[name]
    (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(LinkageError, match=re.escape(words)):
        read_sketch(tmp_path / name, scale=1e-3).to_class()


def test_a_row_that_is_wrong_is_told_once_with_its_line_and_the_remedy(tmp_path):
    rows = "point,A,0,0,fixed\npoint,Ball,300,0,\npoint,E,1150,1250,pin\nlink,,,,A Ball\ncylinder,lift,,,A Ball 550mm\n"
    for old, new, words in (
        ("1250,pin", "1250,pinn", "typo.csv, line 4: 'pinn' says nothing of a point"),
        ("A Ball 550mm", "A Ball E 550mm", "typo.csv, line 6: a cylinder has two ends"),
        ("A Ball 550mm", "A A", "typo.csv, line 6: a cylinder has two ends"),
        ("A Ball 550mm", "A Bal", "typo.csv, line 6: a cylinder names the point 'Bal', which is not there. Did"),
        ("link,,,,A Ball", "link,bar,,,A Bal", "typo.csv, line 5: the link bar names the point 'Bal', which is not there. Did"),
        ("link,,,,A Ball", "slide,,,,Bali 3deg", "typo.csv, line 5: a slide names the point 'Bali', which is not there. Did"),
        ("point,E", "point,A", "typo.csv, line 4: the point 'A' stands twice"),
        ("1150,1250", '"1150,5",1250', "typo.csv, line 4, x of 'E': '1150,5' is no finite number"),
        ("[mm]", "[furlong]", "typo.csv, line 1: 'furlong' is no unit of length; known are m, mm, "),
        ("[mm]", "[kg]", "typo.csv, line 1: 'kg' is no unit of length; known are m, mm, "),
        ("Ball,300,0", "Ball,0,0", "typo.csv: all points stand at one place (0 mm); look at --scale."),
        ("link,,,,A Ball", "link,,,,A Ball\nlink,,,,Ball E", "Typo: the parts leave E free"),
    ):
        (tmp_path / "typo.csv").write_text((HEAD + rows).replace(old, new), encoding="utf-8")
        with pytest.raises(LinkageError) as told:
            read_sketch(tmp_path / "typo.csv").to_class()
        assert str(told.value).startswith(words) and str(told.value).count("typo.csv") <= 1, (words, str(told.value))


def test_a_damaged_address_is_refused():
    for digest in (True, False):
        text = emit.short_body(BY_NAME["Pump"], digest)
        with pytest.raises(LinkageError, match="the address is damaged"):
            read_sketch(text[:40] + text[41:])
    text = emit.short_body(BY_NAME["Pump"], True)
    with pytest.raises(LinkageError, match="its digest does not fit"):  # one letter for another, of the same length
        read_sketch(text.replace("A,A,", "A,B,", 1))


def test_an_address_that_is_cut_or_empty_is_told_as_one():
    whole, old = emit.short_body(BY_NAME["Pump"]), emit.old_address(BY_NAME["Rocker"]).partition("?")[2]
    hosts = "https://app.pmksplus.com/", "http://app.pmksplus.com", "HTTPS://App.PmksPlus.com/", "app.pmksplus.com/", "pmksplus.com"
    for host in hosts:
        cuts = [f"?{text[:cut]}" for text in (whole, old) for cut in (1, 4, 12, 40)]
        for behind in ("", "?", "?2P.Ay,abc", "?j=", "?x", "/?l=a", *cuts):
            with pytest.raises(LinkageError, match=r"^the address: .*; copy it whole"):
                read_sketch(host + behind)
        if host.endswith("/"):
            assert read_sketch(f"{host}?{whole}") == read_sketch(whole)


def test_a_table_of_bodies_may_stand_in_an_address(tmp_path):
    from base64 import urlsafe_b64encode
    from zlib import crc32

    raw = json.dumps(json.loads(emit.plus_bodies(BY_NAME["Rocker"]))).encode()
    address = f"pmks2:{crc32(raw):08x}.{urlsafe_b64encode(raw).decode().rstrip('=')}"
    (tmp_path / "shared.json").write_bytes(raw)
    assert read_sketch(address) == read_sketch(tmp_path / "shared.json")
    with pytest.raises(LinkageError, match="its check does not fit"):
        read_sketch(address.replace(address[6:14], "00000000"))


def test_bodies_that_do_not_fit_together_are_told(tmp_path):
    changes = [
        ("Pump", lambda data: data["joints"][-1]["frameB"].update(attachmentId="world:O"), "of the frame on the frame"),
        ("Boom", lambda data: data["joints"][-1].update(kind="revolute"), "a driver names the point 'barrel:mid', which is not there"),
        ("Boom", lambda data: data["assemblies"][0].update(barrelMount=[]), "has no two mounts"),
        ("Boom", lambda data: data["assemblies"][0].update(barrelMount="OBT"), "has no two mounts"),
    ]
    for name, change, words in changes:
        data = json.loads(emit.plus_bodies(BY_NAME[name]))
        data["joints"][-1]["kind"] = "prismatic"
        change(data)
        (tmp_path / "bodies.json").write_text(json.dumps(data), encoding="utf-8")
        with pytest.raises(LinkageError, match=words):
            read_sketch(tmp_path / "bodies.json").to_class()


def mutated(text, chance):
    """Return a text with a few letters, or a whole word, replaced by something else."""
    if chance.random() < 0.5:
        for _ in range(chance.randint(1, 3)):
            begin = chance.randrange(len(text))
            text = text[:begin] + chance.choice(BITS) + text[begin + chance.choice([0, 1, 1, 2, 5, 20]) :]
        return text
    parts = re.split(r"([-\w.]+)", text)
    parts[chance.randrange(len(parts))] = chance.choice([chance.choice(parts), *BITS])
    return "".join(parts)


@pytest.mark.parametrize("seeds", [range(3), pytest.param(range(3, 150), marks=pytest.mark.slow)], ids=["daily", "all"])
def test_whatever_is_changed_ends_in_words_or_in_a_sketch(seeds, tmp_path):
    for how, (write, suffix, _) in emit.FORMATS.items():
        for name in ("Pump", "Shaper", "Boom"):
            text = write(BY_NAME[name])
            for seed in seeds if text is not None else ():
                chance = random.Random(f"{how} {name} {seed}")
                changed = mutated(text, chance)
                if suffix:
                    (tmp_path / f"m{suffix}").write_text(changed, encoding="utf-8")
                try:
                    sketch = read_sketch(tmp_path / f"m{suffix}" if suffix else changed, scale=1e-3)
                    if seed % 5 == 0:
                        sketch.to_class()
                except LinkageError as error:
                    assert str(error), (how, name, seed)
