"""How long the sentences of a page are: prose alone, without code, formulas, tables, headings and lists of names."""

import ast
import re
from functools import cache
from statistics import mean

from tests.tools.sources import nodes

LONGEST_MEAN = 16.0
"""How many words a page's sentences have in the mean, at the most."""
FENCES = re.compile(r"^(```|~~~|:::).*?^\1[ \t]*$", re.DOTALL | re.MULTILINE)
FORMULAS = re.compile(r"\$\$.*?\$\$|\$[^$\n]*\$", re.DOTALL)
OUTSIDE = ("|", "#", "<", "![", ">")
EXAMPLE = re.compile(r"^[ \t]*>>>.*(?:\n(?![ \t]*$).*)*", re.MULTILINE)
SECTION = re.compile(r"^(Parameters|Returns|Raises|Yields|Notes|Examples|Attributes)\n-+$", re.MULTILINE)
ARGUMENT = re.compile(r"^[*\w, ]+ : .*$|^\w+\n(?= {4})", re.MULTILINE)
"""Headings of the sections of a docstring in NumPy's form, and the lines of their arguments and errors."""
ITEM = re.compile(r"^\s*(?:[-*]|\d+\.)\s+")
END = re.compile(r"(?<=[.!?])[\"')*_]*\s+(?=[\"'(*_]*[A-Z0-9])")
WORD = re.compile(r"[^\W_][\w'.,/-]*")
RIDDLES = {
    r"what is no\b": "anything but a",
    r"\bfor no (?!further|longer|more)": "without a",
    r"\b(None|nothing|empty) of (an?|what|one|several)\b|(?<!and )\bnone of (an?|what|one|several)\b": "None for a",
    r"\bstands? in (the|its|their|whose) (place|middle)\b": "replaces; is at mid-stroke",
    r"\bwhat stood\b": "an existing file",
    r"\brubs?\b|what rubs": "has friction",
    r"\b(what there is|which are which|whichever)\b": "say which",
    r"\bbetters\b": "improves",
    r"\b(oil|gas|pressures?|bar|MPa) (that )?stands?\b|\bno pressure stands\b": "the side holds",
    r"\btaken up (again|from|where)\b|state before they": "resumed; the old version",
    r"\blies? below all others\b|leaves? (it )?nothing of\b": "say what happens",
    r"\bheld against the pump, for\b": "No relief valve is declared, so",
    r"\bfunctions? (that|which) stands? in\b": "nested function",
    r"\bstands? in \[": "is in",
    r"(?<!you )(?<!it )\b(is|are|be|been) told\b(?! apart)|\btells? of\b": "is reported",
    r"\b(shelf|pace|tenants?)\b": "the field's word",
}
"""Words that have to be read twice, and what to say in their place."""


def paragraphs(text):
    """Yield the paragraphs and list items of a page in Markdown, each in one line; code and formulas as one word."""
    text = FORMULAS.sub("X", FENCES.sub("\n", text))
    own = []
    for line in [*text.splitlines(), ""]:
        outside = not line.strip() or line.lstrip().startswith(OUTSIDE)
        if (outside or ITEM.match(line)) and own:
            yield " ".join(own)
            own = []
        if not outside:
            own.append(re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", re.sub(r"`[^`]*`", "X", ITEM.sub("", line))).strip())


@cache
def sentences(text):
    """Return the sentences of a page that end in a full stop, each with the number of its words."""
    found = [each.strip() for paragraph in paragraphs(text) for each in END.split(paragraph)]
    return [(len(WORD.findall(each)), each) for each in found if each.rstrip("\"')*_ ").endswith(".") and WORD.search(each)]


@cache
def docstrings(source):
    """Return the docstrings of a source, but those of private names, without their examples; each section and argument a paragraph."""
    kinds = ast.Module, ast.ClassDef, ast.FunctionDef
    found = [each for kind in kinds for each in nodes(source)[kind] if not getattr(each, "name", "").startswith("_")]
    return [SECTION.sub("\n\n", ARGUMENT.sub("\n\n", EXAMPLE.sub("", ast.get_docstring(each) or ""))) for each in found]


def riddles(text):
    """Yield the words of a text that have to be read twice, with what to say; code says what it likes."""
    plain = " ".join(re.sub(r"`[^`\n]*`", "X", FENCES.sub("\n", text)).split())
    for pattern, better in RIDDLES.items():
        for found in re.finditer(pattern, plain, re.IGNORECASE):
            yield f"{plain[max(found.start() - 40, 0) : found.end() + 20]}: {better}"


def mean_length(*texts):
    """Return how many words the sentences of some texts have in the mean; 0 where there is none."""
    found = [count for text in texts for count, _ in sentences(text)]
    return mean(found) if found else 0.0
