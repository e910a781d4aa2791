"""How much each page is about each of its words, by its own text: what the search of the built pages ranks by (`scorer.js`)."""

from __future__ import annotations

import json
import re
from collections import Counter
from pathlib import Path

TITLE, HEADING, MOST_IN_HEADINGS, MOST_IN_TEXT = 15, 5, 12, 10
"""What a word counts in the title and in a heading, and the most that it counts in all headings and in the text."""
LEAST = 3
"""A page that says a word less often, and in no heading, has it by the way; Sphinx's own search finds it there."""
CODE = re.compile(r"```.*?```", re.DOTALL)


def words(text: str) -> list[str]:
    """Return the words of a text, in small letters and without the s of a plural, as the search splits what is typed."""
    return [word[:-1] if len(word) > 3 and word.endswith("s") else word for word in re.findall(r"[^\W_]+", text.lower())]


def weights(text: str) -> Counter[str]:
    """Return how much a page is about each of its words, by its title, its headings and how often it says them."""
    title, *headings = re.findall(r"^#+ (.*)$", CODE.sub("", text), re.MULTILINE) or [""]
    in_headings = Counter(word for heading in headings for word in set(words(heading)))
    found = Counter({word: min(count, MOST_IN_TEXT) for word, count in Counter(words(text)).items()})
    found.update({word: min(HEADING * count, MOST_IN_HEADINGS) for word, count in in_headings.items()})
    found.update(dict.fromkeys(words(title), TITLE))
    return found


def make(pages: dict[str, str], folder: Path) -> None:
    """Write the script that ranks results, with the weights of pages by their names without .md."""
    about = {page: {word: n for word, n in weights(text).items() if n >= LEAST and len(word) > 1} for page, text in pages.items()}
    script = (Path(__file__).with_name("scorer.js")).read_text(encoding="utf-8")
    (folder / "scorer.js").write_text(f"const ABOUT = {json.dumps(about, separators=(',', ':'))};\n{script}", encoding="utf-8")
