# ruff: noqa: B023, E501 - tables of odd words
"""Files of sound mechanisms with a few things put wrong, each reproducible by its number; and what became of reading one."""

from __future__ import annotations

import json
import random
import re
import signal
import sys
import warnings
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from linkage import AssemblyError, DefinitionError, FileError, SingularWarning
from linkage.files import load, to_json, to_toml
from tests import shipped
from tests.linkage.files.file_machines import Drawn, EveryStep, Hitch, Loaded, Parts

LONGEST = 120.0
"""s; a file that takes longer hangs: the slowest sound one takes about a second."""

SLOW = {"StephensonThreeFar", "StephensonTwo", "StephensonTwoFar", "Parts", "Drawn"}
"""Machines whose groups take so long to assemble that they are drawn a fifth as often."""


@cache
def samples():
    """Return the files that are put wrong, each with its kind."""
    return [
        sample for machine in [*shipped.MACHINES.values(), Hitch, EveryStep, Parts, Drawn, Loaded]
        for write, kind in ((to_toml, "toml"), (to_json, "json"))
        for sample in [(write(machine).encode(), kind)] * (1 if machine.__name__ in SLOW else 5)
    ]  # fmt: skip


PYTHON = [
    '__import__("os").system("touch run")', "().__class__.__base__.__subclasses__()", "exec('raise SystemExit')", "open('run', 'w')",
    "lambda: 0", "[x for x in S]", "S.__class__", "S[0]", "f'{S}'", "eval", "import os", "__builtins__", "!!python/object/apply:os.system",
    "{{7*7}}", "$(touch run)", "${S}", "%s%s%n", "../../etc/passwd", "(S := 1)", "1 if S else 2", "S and 1", "S @ S", "0x10", "1_000", "1j",
]  # fmt: skip
WORDS = [
    "S", "A", "O", "B", "phi", "L0", "OB", "AB", "LEFT", "RIGHT", "left", "Dyad", "OnLink", "Crank", "SliderDyad", "PinSlotDyad", "YokeDyad",
    "Guide", "GuideCross", "OnGuide", "Offset", "Weight", "Force", "Moment", "Spring", "Damper", "Actuator", "Support", "PinFriction",
    "Cylinder", "LiftCircuit", "FloatCircuit", "strokes", "points", "links", "pins", "loads", "cases", "hydraulics", "outputs", "order",
    "name", "doc", "side", "at", "near", "angle", "angle(O, B)", "distance(A, B)", "x(B)", "abs(AO)", "sqrt(S - 1)", "1 / (S - S)", "S ** 99",
    "S ** S ** S", "log(0)", "nan", "inf", "-inf", "true", "null", "[]", "{}", '""', "self", "plan", "__class__", "__init__", "500 mm",
    "75 deg", "1 parsec", "2 bar", "0 * S", "1e3 * 1e3 m", "CosineAngle(S, S, S)", "Turn(A, B)", "min()", "max(S)", "atan2(S)", "def", "None",
]  # fmt: skip
NUMBERS = [
    "0", "-0.0", "-1", "1e308", "-1e308", "1e309", "-1e999", "1e-308", "5e-324", "1e200", "1e150", "-1e12", "1e-12", "nan", "inf", "0.1" * 9,
    "9" * 20, "9" * 400, "9" * 5000, "1" + "0" * 309, "0." + "0" * 400 + "1", "1e" + "9" * 30, "0x7fffffffffffffff", "1_0", "1e+", ".5",
    "9223372036854775808", "2020-01-01", "12:30:00", "true",
]  # fmt: skip
LETTERS = [
    "\u0391", "\u0410", "\u202e", "\u200b", "\u0301", "\ufeff", "\u00a0", "\u2028", "\x85", "\x00", "\x1b[2J", "\U0001f600", "\u00e9", "e\u0301",
    "\uff21", "\u017f", "\u212a", "\u03c6", "\u00b2", "\u0661", "\u2212", "\u00d7", "\\ud800", "\\u0000", "\\uD83D", "\x7f", "\u3164", "\r", "\\",
]  # fmt: skip
TOKEN = re.compile(r'[\w.]+|"[^"\n]*"|[^\w\s]|\n')
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
KEY = re.compile(r'[A-Za-z_]\w*(?=\s*=)|(?<=")[A-Za-z_]\w*(?="\s*:)')
VALUE = re.compile(r'(?:=|:)\s*("[^"\n]*"|-?[\d.]+|\[[^\[\]\n]*\]|\{[^{}\n]*\})')
QUOTED = re.compile(r'"[^"\n]*"')

Change = Callable[[random.Random, str, str], str]


def mutated(number: int) -> tuple[bytes, str]:
    """Return the bytes of a file with one to three things put wrong, always the same for a number, and its ending."""
    draw = random.Random(number)
    raw, kind = draw.choice(samples())
    text = raw.decode()
    for _ in range(draw.choice((1, 1, 2, 3))):
        text = draw.choice(CHANGES)(draw, text, kind)
    changed = text.encode("utf-8", "surrogatepass")
    return (changed if draw.random() < 0.85 else other_bytes(draw, changed)), kind


def other_bytes(draw: random.Random, raw: bytes) -> bytes:
    """Return bytes with some changed, put in or taken out; now and then in another encoding."""
    if draw.random() < 0.1:
        return raw.decode("utf-8", "replace").encode(draw.choice(("utf-16", "utf-32", "utf-8-sig", "cp500")), "replace")
    changed = bytearray(raw)
    for _ in range(draw.randint(1, 4)):
        place = draw.randrange(len(changed) + 1)
        changed[place : place + draw.choice((0, 1, 1, 5))] = draw.randbytes(draw.choice((0, 1, 1, 4)))
    return bytes(changed)


def replaced(pattern: re.Pattern[str], others: list[str]) -> Change:
    """Return a change of one thing that a pattern finds for another."""

    def change(draw: random.Random, text: str, kind: str) -> str:
        found = list(pattern.finditer(text))
        if not found:
            return text
        start, end = draw.choice(found).span()
        return text[:start] + draw.choice(others) + text[end:]

    return change


def exchanged(pattern: re.Pattern[str], group: int = 0) -> Change:
    """Return a change that swaps two things that a pattern finds, or writes one over the other."""

    def change(draw: random.Random, text: str, kind: str) -> str:
        found = list(pattern.finditer(text))
        if len(found) < 2:
            return text
        first, second = sorted(draw.sample(found, 2), key=lambda match: match.start(group))
        (a, b), (c, d) = first.span(group), second.span(group)
        back = text[a:b] if draw.random() < 0.7 else text[c:d]
        return text[:a] + text[c:d] + text[b:c] + back + text[d:]

    return change


def nested(draw: random.Random, text: str, kind: str) -> str:
    """Put lists, tables, brackets, signs or dotted keys into each other, deep."""
    deep = draw.choice((2, 10, 50, 300, 2000, 100_000))
    value = draw.choice([
        "[" * deep + "1" + "]" * deep, ('{"a":' if kind == "json" else "{a=") * deep + "1" + "}" * deep, "[" * deep,
        f'"{"(" * deep}S{")" * deep}"', f'"{"-" * deep}1"', f'"{"abs(" * deep}S{")" * deep}"', f'"S{" ** 2" * deep}"', f'"S{" + S" * deep}"',
    ])  # fmt: skip
    if draw.random() < 0.1:
        return f"{text}\n[{'.'.join(['a'] * deep)}]\nb = 1\n"
    found = list(VALUE.finditer(text))
    if not found:
        return value
    start, end = draw.choice(found).span(1)
    return text[:start] + value + text[end:]


def doubled(draw: random.Random, text: str, kind: str) -> str:
    """Write some lines or a stretch twice or many times, under their own names or under others."""
    lines = text.split("\n")
    start = draw.randrange(len(lines))
    piece = lines[start : start + draw.choice((1, 1, 2, 6))]
    times = draw.choice((1, 1, 2, 30, 500))
    if draw.random() < 0.5 and times > 2:
        piece = [KEY.sub(lambda found: f"{found[0]}_{each}", line, count=1) for each in range(times) for line in piece]
    else:
        piece = piece * times
    return "\n".join([*lines[:start], *piece, *lines[start:]])


def lettered(draw: random.Random, text: str, kind: str) -> str:
    """Put characters that are no plain letters anywhere, or one in the place of every such letter."""
    if draw.random() < 0.2 and text:
        return text.replace(draw.choice(text), draw.choice(LETTERS))
    for _ in range(draw.choice((1, 1, 3))):
        place = draw.randrange(len(text) + 1)
        text = text[:place] + draw.choice(LETTERS) + text[place:]
    return text


def cut(draw: random.Random, text: str, kind: str) -> str:
    """Leave out the end, the beginning, or a stretch."""
    a, b = sorted((draw.randrange(len(text) + 1), draw.randrange(len(text) + 1)))
    return draw.choice((text[:a], text[b:], text[:a] + text[b:], text[: len(text) - draw.randrange(8)]))


def lengthened(draw: random.Random, text: str, kind: str) -> str:
    """Make a word, a text or the file very long."""
    many = draw.choice((70, 3_000, 200_000, 1_100_000))
    place = draw.randrange(len(text) + 1)
    return text[:place] + draw.choice(("a", " ", "\n", "9", "S + ", "# ", '"', "\\", "a.", "é")) * (many // 2) + text[place:]


def reordered(draw: random.Random, text: str, kind: str) -> str:
    """Exchange two entries or sections, or move an entry into another section; a JSON text by its tables."""
    try:
        tables = json.loads(text) if kind == "json" else None
    except (ValueError, RecursionError):
        tables = None
    if not isinstance(tables, dict):
        lines = text.split("\n")
        draw.shuffle(lines) if draw.random() < 0.1 else lines.insert(draw.randrange(len(lines)), lines.pop(draw.randrange(len(lines))))
        return "\n".join(lines)
    (one, a), (two, b) = draw.choice(list(places(tables))), draw.choice(list(places(tables)))
    one[a], two[b] = two[b], one[a]
    try:
        return json.dumps(tables)
    except (ValueError, RecursionError):
        return text


def places(node: Any) -> Iterator[tuple[Any, Any]]:
    """Yield the places of a tree of tables and lists: the node that holds it and its key."""
    for key, value in list(node.items() if isinstance(node, dict) else enumerate(node)):
        yield node, key
        if isinstance(value, (dict, list)):
            yield from places(value)


def nudged(draw: random.Random, text: str, kind: str) -> str:
    """Write other numbers of the same kind in the place of some, so that what is read is often a machine, of an odd shape."""
    found = list(NUMBER.finditer(text))
    for match in sorted(draw.sample(found, min(len(found), draw.choice((1, 1, 3)))), key=lambda match: -match.start()):
        value = float(match[0]) * draw.choice((0.9, 0.99, 1.0 + 1e-9, 1.01, 1.1, 0.5, 2.0, -1.0, 0.0, 1e-9, 1e-3, 1e3, 1e9, draw.uniform(0.0, 3.0)))
        text = text[: match.start()] + repr(value) + text[match.end() :]
    return text


def turned(draw: random.Random, text: str, kind: str) -> str:
    """Say the other side of a dyad, or take a point, a length or a stroke for another one that is there."""
    if draw.random() < 0.3:
        return re.sub("LEFT|RIGHT", lambda found: draw.choice(("LEFT", "RIGHT")), text)
    words = list(re.finditer(r'(?<=["\s(])[A-Za-z]\w{0,2}(?=["\s),])', text))
    if not words:
        return text
    one = draw.choice(words)
    return text[: one.start()] + draw.choice(words)[0] + text[one.end() :]


CHANGES: list[Change] = [
    *(nudged,) * 5, *(turned,) * 3,
    replaced(TOKEN, WORDS), replaced(QUOTED, [f'"{word}"' for word in (*WORDS, *PYTHON)]), replaced(NUMBER, NUMBERS), replaced(KEY, WORDS),
    replaced(NUMBER, [json.dumps(word) for word in (*PYTHON, *WORDS)]), replaced(TOKEN, ["", "", " ", ",", "=", '"', "[", "]", "{", "}", "\n", "#"]),
    exchanged(TOKEN), exchanged(KEY), exchanged(VALUE, 1), exchanged(NUMBER), nested, doubled, lettered, cut, reordered,
    lambda draw, text, kind: lengthened(draw, text, kind) if draw.random() < 0.2 else replaced(NUMBER, NUMBERS)(draw, text, kind),
]  # fmt: skip


# -- what becomes of one -----------------------------------------------------------------------------------

WHOLE = ("is larger than", "nested too deeply", "are too many", "too long a chain", "a table of sections is expected", "extreme numbers")
"""Sayings about a file as a whole: it has no line that would be at fault more than the others."""
KEYS = r"""(?:[^\s.:'"]+|'.*?(?:'|\.\.\.)|".*?(?:"|\.\.\.))(?:\.(?:[^\s.:'"]+|'.*?(?:'|\.\.\.)|".*?(?:"|\.\.\.)))*"""
PLACE = re.compile(rf"file\.\w+(?:, line \d+|: (?:\d+ mistakes:\n  )?(?:line \d+|{KEYS}:|the key ))")
"""How a saying begins that names its place: a line, a key, or both."""


def outcome(path: Path) -> str:
    """Return what became of reading a file: "asked" for a pose or the name of the error. AssertionError for an error without a place."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", SingularWarning)
        try:
            machine = load(path)
        except (FileError, DefinitionError, AssemblyError) as error:
            said = str(error)
            assert len(said) < 10_000, f"{len(said)} characters"
            assert PLACE.match(said) or any(each in said for each in WHOLE), said
            return type(error).__name__
        try:
            motion = machine().at(unreachable="nan", **machine.plan.sketch_strokes)
        except AssemblyError as error:
            assert machine.plan.title in str(error)
            return "no pose"
        for name in machine.plan.moving:  # a fixed point on which none of them hangs may lie nowhere: verdicts of its machine tell it
            assert np.isfinite(motion[name]).all() or not motion.reached.all(), name
        return "asked"


def tried(numbers: Iterable[int], folder: Path) -> tuple[Counter[str], list[str]]:
    """Return how often each outcome was met over the files of some numbers, and what went wrong, each with the file's number."""
    counts: Counter[str] = Counter()
    wrong = []
    for number in numbers:
        raw, kind = mutated(number)
        path = folder / f"file.{kind}"
        path.write_bytes(raw)
        try:
            with in_time():
                counts[outcome(path)] += 1
        except (Exception, Hang) as error:
            wrong.append(f"{number}: {type(error).__name__}: {error!s:.300}")
    return counts, wrong


class Hang(BaseException):
    """Reading takes for ever; nothing may catch it on its way."""


@contextmanager
def in_time() -> Iterator[None]:
    """Raise Hang in what takes longer than anything may."""
    if sys.platform == "win32":
        yield
        return

    def stop(*where: Any) -> None:
        raise Hang(f"still busy after {LONGEST:g} s")

    before = signal.signal(signal.SIGALRM, stop)
    signal.setitimer(signal.ITIMER_REAL, LONGEST)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
