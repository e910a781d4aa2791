"""The catalogues of translations: what the source says, what is missing or not needed any more, and the compiled files.

python -m tests.tools.catalogues          # compile every .po, and tell what is missing or unused
python -m tests.tools.catalogues --add    # the missing templates go into the .po, to be filled in
"""

from __future__ import annotations

import ast
import re
import struct
import sys
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from string import Formatter

from linkage.cli.listing import registered
from linkage.cli.machines import find
from linkage.documents.inputs import own_texts
from linkage.pictures.page_file import said_in
from tests.tools.sources import nodes, sources

ROOT = Path(__file__).parents[2]
BELOW = {"linkage": (), "hydraulics": ("linkage",), "mechanisms": ("linkage", "hydraulics")}
LANGUAGES = ("ru",)
OF_PAPERS = ("mower_lift", "three_point_hitch", "header_balancer", "crane", "boom_drive", "arm_drive", "grapple")
AT_WORK = tuple(name for name, point in registered().items() if point.value.startswith("mechanisms.at_work"))
"""The machines whose own words, names, prose and notes, belong into a catalogue; those of others may."""

# -- what the source says ----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Message:
    """A template, and the one for many where a count chooses."""

    text: str
    many: str = ""
    where: str = field(default="", compare=False)


def literal(node: ast.expr, where: str) -> str:
    """Return the text of a literal; ValueError for anything else, which no catalogue could be made of."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    raise ValueError(f"{where}: {ast.unparse(node)} is no literal; say(template, **values), or mark where it is made with noted(...).")


def called(node: ast.Call) -> str:
    """Return the name of what is called."""
    return node.func.id if isinstance(node.func, ast.Name) else ""


def messages(path: str, source: str) -> Iterator[Message]:
    """Yield what a file says: the templates of said and said_of, what is noted, and the rules of verdicts that are literals."""
    imports = [node for node in nodes(source)[ast.ImportFrom] if str(node.module).split(".")[-1] == "language"]
    ours = {alias.name for node in imports for alias in node.names} | {"Verdict", *(["said"] if path == "linkage/language.py" else [])}
    for node in nodes(source)[ast.Call]:
        if called(node) not in ours:
            continue
        name, where = called(node), f"{path}:{node.lineno}"
        if name in ("said", "noted") and node.args:
            yield Message(literal(node.args[0], where), where=where)
        elif name == "said_of":
            yield Message(literal(node.args[1], where), literal(node.args[2], where), where)
        elif name == "Verdict" and node.args and isinstance(node.args[0], ast.Constant) and isinstance(node.args[0].value, str):
            yield Message(node.args[0].value, where=where)


def source_messages(package: str) -> dict[Message, str]:
    """Return everything that a package says, in the order of its files, and where it is said first."""
    found: dict[Message, str] = {}
    for path, source in sources().items():
        for each in messages(path, source) if path.startswith(f"{package}/") else ():
            found.setdefault(each, each.where)
    for file in sorted(each for each in (ROOT / package).rglob("*") if each.suffix in (".js", ".html")):
        for text in said_in(file.read_text(encoding="utf-8")):
            found.setdefault(Message(text), file.name)
    if package == "linkage":  # another language writes units in its own way
        units = re.findall(r'"([^"]+)": \(', sources()["linkage/units.py"])
        found |= {Message(unit): "linkage/units.py" for unit in units if unit.isascii()}
    if package == "mechanisms":
        found |= {each: each.where for each in own_messages((*OF_PAPERS, *AT_WORK)) if each not in found}
    return found


def own_messages(names: Iterable[str]) -> Iterator[Message]:
    """Yield what shipped machines say in their own words."""
    yield from (Message(text, where=name) for name in names for text in own_texts(find(name)))


# -- catalogues --------------------------------------------------------------------------------------------


@dataclass
class Entry:
    """One message of a .po file, its translations (of a count: all forms), and whether it is marked as fuzzy."""

    message: Message
    translations: list[str]
    fuzzy: bool = False


def catalogue_path(package: str, language: str) -> Path:
    """Return a package's .po file."""
    return ROOT / package / "locale" / language / "LC_MESSAGES" / f"{package}.po"


def entries(text: str) -> list[Entry]:
    """Return the entries of a .po file, its header first."""
    found: list[Entry] = []
    parts: dict[str, str] = {}
    fuzzy, key = False, ""
    for line in [*text.splitlines(), "", ""]:
        line = line.strip()
        if line.startswith("#"):
            fuzzy = fuzzy or (line.startswith("#,") and "fuzzy" in line)
        elif line.startswith('"'):
            parts[key] += ast.literal_eval(line)
        elif line:
            key, _, value = line.partition(" ")
            parts[key] = ast.literal_eval(value)
        elif parts:
            forms = [parts[each] for each in sorted(parts) if each.startswith("msgstr")]
            found.append(Entry(Message(parts["msgid"], parts.get("msgid_plural", "")), forms, fuzzy))
            parts, fuzzy, key = {}, False, ""
    return found


def compiled(found: list[Entry]) -> bytes:
    """Return a catalogue as gettext's .mo: two tables of lengths and places, then the texts, sorted."""
    pairs = sorted(
        ("\0".join(filter(None, (each.message.text, each.message.many))).encode(), "\0".join(each.translations).encode()) for each in found
    )
    start, texts, tables = 28 + 16 * len(pairs), b"", ([], [])
    for column in (0, 1):
        for pair in pairs:
            tables[column].append((len(pair[column]), start + len(texts)))
            texts += pair[column] + b"\0"
    head = struct.pack("<7I", 0x950412DE, 0, len(pairs), 28, 28 + 8 * len(pairs), 0, 28 + 16 * len(pairs))
    return head + b"".join(struct.pack("<2I", *each) for table in tables for each in table) + texts


def quoted(text: str) -> str:
    """Return a text as a .po file has it."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n") + '"'


def blank(message: Message) -> str:
    """Return an entry without a translation."""
    if not message.many:
        return f'\nmsgid {quoted(message.text)}\nmsgstr ""\n'
    return f'\nmsgid {quoted(message.text)}\nmsgid_plural {quoted(message.many)}\nmsgstr[0] ""\nmsgstr[1] ""\nmsgstr[2] ""\n'


def placeholders(template: str) -> set[tuple[str, str]]:
    """Return what a template has filled in: names and formats."""
    return {(name, form or "") for _, name, form, _ in Formatter().parse(template) if name is not None}


def entry_faults(entry: Entry) -> Iterator[str]:
    """Yield what is wrong with a translation: it is missing, fuzzy, or fills in something else."""
    message, forms = entry.message, entry.translations
    if entry.fuzzy:
        yield f"{message.text!r} is fuzzy"
    if len(forms) != (3 if message.many else 1) or not all(forms):
        yield f"{message.text!r} has no translation"
    for form in filter(None, forms):
        if placeholders(form) != placeholders(message.text) | (placeholders(message.many) if message.many else set()):
            yield f"{message.text!r} and {form!r} fill in different things"


def catalogue_faults(package: str, language: str) -> Iterator[str]:
    """Yield what is wrong with a catalogue, beside the source and beside its compiled form."""
    path = catalogue_path(package, language)
    found = entries(path.read_text(encoding="utf-8"))
    said, listed = source_messages(package), Counter(each.message for each in found[1:])
    known = {each.message for other in BELOW[package] for each in entries(catalogue_path(other, language).read_text(encoding="utf-8"))}
    yield from (f"{path}: {fault}" for entry in found[1:] for fault in entry_faults(entry))
    yield from (f"{path}: {each.text!r} ({said[each]}) is missing" for each in said if each not in known and each not in listed)
    spoken = {*said, *(own_messages(registered()) if package == "mechanisms" else ())}
    yield from (f"{path}: {each.text!r} is said nowhere" for each in listed if each not in spoken)
    yield from (f"{path}: {each.text!r} stands twice" for each, times in listed.items() if times > 1)
    yield from (f"{path}: {each.text!r} stands in a catalogue below" for each in listed if each in known)
    if path.with_suffix(".mo").read_bytes() != compiled(found):
        yield f"{path}: the .mo beside it is of another one; run python -m tests.tools.catalogues"


def main(add: bool = False) -> int:
    """Compile all catalogues and print what is wrong with them."""
    faults = []
    for language in LANGUAGES:
        for package in BELOW:
            path = catalogue_path(package, language)
            text = path.read_text(encoding="utf-8")
            if add:
                files = [catalogue_path(name, language) for name in (package, *BELOW[package])]
                have = {each.message for file in files for each in entries(file.read_text(encoding="utf-8"))}
                text += "".join(blank(each) for each in source_messages(package) if each not in have)
                path.write_text(text, encoding="utf-8")
            path.with_suffix(".mo").write_bytes(compiled(entries(text)))
        faults += [fault for package in BELOW for fault in catalogue_faults(package, language)]
    print("\n".join(faults) or "complete")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main("--add" in sys.argv))
