"""A page's own script and style without what only a reader needs: comments, white space, long names."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import product
from string import ascii_letters
from typing import TypeAlias

Token: TypeAlias = tuple[str, str]
"""What a piece of a script is, and the piece."""

TOKEN = re.compile(
    r"""(?P<blank>/\*.*?\*/|\s+)
      |(?P<text>"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*')
      |(?P<number>\d[\w.]*)
      |(?P<word>[A-Za-z_$][\w$]*)
      |(?P<sign>=>|\.\.\.|\?\?=|\|\|=|&&=|\*\*|\?\?|\?\.|\|\||&&|\+\+|--|[-+*/%<>=!]=+|[-+*/%<>=!&|(){}\[\];,.:?])""",
    re.VERBOSE | re.DOTALL,
)
PATTERN = re.compile(r"/(?:[^/\\\n\[]|\\.|\[(?:[^\]\\\n]|\\.)*\])+/[a-z]*")
BEFORE_PATTERN = frozenset(("return", "=>", "&&", "||", *"(,=:[!&|?{};"))
"""What stands before a regular expression; behind anything else a slash divides."""

WORDS = """async await break case catch const continue default delete do else export extends false finally for function if in instanceof let
new null of return static super switch this throw true try typeof undefined var void while yield use strict
document window location history navigator performance engine requestAnimationFrame setTimeout clearTimeout ResizeObserver URLSearchParams
Event Response Blob DecompressionStream atob Uint8Array Array Float64Array Infinity JSON Map Math NaN Number Object Set String"""
KEPT = frozenset(WORDS.split())
"""The words of the language, and of a browser those that a page uses."""


@cache
def compact_script(text: str) -> str:
    """Return a script that does the same: comments and white space are gone, and what is no property has a short name."""
    tokens = [token for token in tokens_of(text) if token[0] != "blank"]
    both = in_short(tokens)
    short = names_for(tokens)
    words = []
    for place, (kind, said) in enumerate(tokens):
        plain = kind != "word" or is_property(tokens, place)
        name = said if plain else "let" if said == "const" else short.get(said, said)
        words.append(f"{said}:{name}" if place in both and name != said else name)
    return "".join(apart(one_by_one(words)))


def one_by_one(words: Sequence[str]) -> list[str]:
    """Return words with one declaration where several follow each other in a block."""
    found: list[str] = []
    declares = [False]
    for place, word in enumerate(words):
        if word in ("}", ")", "]") or word[:1] == "}":
            declares.pop()
        if word in ("{", "(", "[") or word[-2:] == "${":
            declares.append(False)
        last = words[place - 1] if place else ";"
        if word == "let" and last == ";" and declares[-1]:
            found[-1] = ","
            continue
        if last in (";", "{") or (last == "}" and word[:1].isalpha()):
            declares[-1] = word == "let"
        found.append(word)
    return found


def numbered(text: str, words: Sequence[str]) -> str:
    """Return a script or a page whose sentences are said by their number among `words`."""
    number = {word: str(place) for place, word in enumerate(words)}
    said = re.sub(r'\bsay\("((?:[^"\\]|\\.)*)"', lambda found: f"say({number[found[1]]}", text)
    return re.sub(r'\b(data-(?:say|tip|name))="([^"]*)"', lambda found: f'{found[1]}="{number[found[2]]}"', said)


@cache
def compact_style(text: str) -> str:
    """Return a style sheet that says the same."""
    plain = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    return re.sub(r"\s*([{};,>])\s*", r"\1", re.sub(r"\s+", " ", re.sub(r":\s+", ":", plain))).replace(";}", "}").strip()


def tokens_of(text: str) -> Iterator[Token]:
    """Yield the tokens of a script; a template is its pieces of text, with the tokens of its values between them."""
    place, last, open_braces = 0, ";", list[int]()
    while place < len(text):
        if text[place] == "`" or (text[place] == "}" and open_braces[-1:] == [0]):
            if text[place] == "}":
                open_braces.pop()
            found = re.compile(r"(?:[^`$\\]|\\.|\$(?!\{))*(`|\$\{)", re.DOTALL).match(text, place + 1)
            assert found is not None  # every template ends
            if found[1] == "${":
                open_braces.append(0)
            kind, last = "text", found[1][-1:]
            last = "(" if found[1] == "${" else "a"
        else:
            is_pattern = text[place] == "/" and text[place + 1] != "*" and last in BEFORE_PATTERN
            found = (PATTERN if is_pattern else TOKEN).match(text, place)
            if found is None:
                raise ValueError(f"the script cannot be read at {text[place : place + 20]!r}")
            kind = "text" if is_pattern else str(found.lastgroup)
            if open_braces and found[0] in ("{", "}"):
                open_braces[-1] += 1 if found[0] == "{" else -1
            last = last if kind == "blank" else found[0] if kind in ("sign", "word") else "a"
        yield kind, text[place : found.end()]
        place = found.end()


def tokens_beside(tokens: Sequence[Token], place: int) -> tuple[str, str]:
    """Return the tokens before and behind one."""
    return tokens[place - 1][1] if place else "", tokens[place + 1][1] if place + 1 < len(tokens) else ""


def is_property(tokens: Sequence[Token], place: int) -> bool:
    """Return whether the word at a place names a property: behind a point, or before a colon in an object."""
    before, behind = tokens_beside(tokens, place)
    return before in (".", "?.") or (behind == ":" and before in ("{", ","))


OBJECT = frozenset(("...", "&&", "||", "??", "return", "const", "let", *"(,=:?["))
"""What a brace stands behind that opens an object or takes one apart; behind anything else it opens a block."""


def in_short(tokens: Sequence[Token]) -> set[int]:
    """Return the places of the words that stand for a property and its value at once, `{ low, high }`."""
    found, brackets = set[int](), list[str]()
    for place, (kind, said) in enumerate(tokens):
        before, behind = tokens_beside(tokens, place)
        if kind == "sign" and said in "{[(":
            brackets.append("object" if said == "{" and before in OBJECT else said)
        elif kind == "text" and said[-2:] == "${":
            brackets[:] = [*(brackets[:-1] if said[0] == "}" else brackets), "${"]
        elif (kind == "sign" and said in "}])") or (kind == "text" and said[:1] == "}"):
            brackets.pop()
        if kind == "word" and brackets[-1:] == ["object"] and before in ("{", ",") and behind in (",", "}", "="):
            found.add(place)
    return found


def names_for(tokens: Sequence[Token]) -> dict[str, str]:
    """Return a short name for each that may have one, the shortest for the most frequent."""
    used = Counter(said for place, (kind, said) in enumerate(tokens) if kind == "word" and not is_property(tokens, place))
    names = [name for name, _ in used.most_common() if name not in KEPT]
    free = (name for size in (1, 2, 3) for name in map("".join, product(ascii_letters, repeat=size)) if name not in KEPT)
    return dict(zip(names, free, strict=False))


def apart(words: Sequence[str]) -> Iterator[str]:
    """Yield words with a space where two would run together."""
    last = ""
    for word in words:
        if (re.match(r"[\w$]", word) and re.search(r"[\w$]\Z", last)) or (word[:1] in "+-" and last[-1:] == word[:1]):
            yield " "
        yield word
        last = word
