"""One language for everything that is said: sentences are templates, translated where a catalogue has them, and filled in.

    >>> from linkage.language import language, said
    >>> said("{low} to {high}", low="0", high="250 mm")
    '0 to 250 mm'
    >>> with language("ru"):
    ...     said("{low} to {high}", low="0", high="250 мм")
    '0…250 мм'

Catalogues are gettext's: `locale/ru/LC_MESSAGES/linkage.mo` beside this file, made from the `.po` of the same name. Another package
brings its own with one line, `add_catalogue("machines", Path(__file__).parent / "locale")`; `add_texts` adds a few texts. Messages of
errors stay English, and so do the names of members. Decimals have a point in every language: what is printed can be read again, by this
program and by others. In reports, which people read, they have the sign of the language (`with_decimals`).
"""

from __future__ import annotations

import gettext
import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from functools import lru_cache
from pathlib import Path

from .errors import DefinitionError, cited, known_name

ENGLISH = "en"

_LANGUAGE = ContextVar("language", default=ENGLISH)
_CATALOGUES: dict[str, Path] = {}
_TEXTS: dict[str, dict[str, str]] = {}


def add_catalogue(domain: str, folder: str | Path) -> None:
    """Let sentences be looked up in `folder/LANGUAGE/LC_MESSAGES/domain.mo` too; DefinitionError where there is none."""
    where = Path(folder)
    if not any(where.glob(f"*/LC_MESSAGES/{domain}.mo")):
        raise DefinitionError(f"{where}: no */LC_MESSAGES/{domain}.mo is there; compile the catalogue, or mend the folder.")
    _CATALOGUES[domain] = where
    _catalogue.cache_clear()
    _languages_in.cache_clear()


def add_texts(name: str, texts: Mapping[str, str]) -> None:
    """Let English texts be said in another language as a mapping has them, before the catalogues; DefinitionError for none of them.

    `hydrolinkage report` and pages say what `own_texts(Machine)` lists so: its name, prose and notes.
    """
    known_name("Language", name, languages(), where="add_texts(...)")
    if not isinstance(texts, Mapping) or not all(isinstance(each, str) and each for pair in texts.items() for each in pair):
        raise DefinitionError(f'add_texts("{name}", {cited(texts)}): pairs of text are expected, {{"My loader": "Мой погрузчик"}}.')
    _TEXTS.setdefault(name, {}).update(texts)


def languages() -> list[str]:
    """Return the languages that can be spoken: English, and those that linkage has a catalogue of."""
    return [ENGLISH, *_languages_in(_CATALOGUES["linkage"])]


@lru_cache
def _languages_in(folder: Path) -> tuple[str, ...]:
    """Return the languages that a folder has catalogues of linkage in, read once."""
    return tuple(sorted(path.parent.parent.name for path in folder.glob("*/LC_MESSAGES/linkage.mo")))


def current_language() -> str:
    """Return the language that is spoken: "en", "ru"."""
    return _LANGUAGE.get()


@contextmanager
def language(name: str) -> Iterator[None]:
    """Speak a language inside `with`, whatever is said there; DefinitionError, with those there are, for another one."""
    known_name("Language", name, languages(), where="language(...)")
    token = _LANGUAGE.set(name)
    try:
        yield
    finally:
        _LANGUAGE.reset(token)


@lru_cache
def _catalogue(name: str) -> gettext.NullTranslations:
    """Return a language's catalogues as one: linkage's own, then those added."""
    whole = gettext.NullTranslations()
    for domain, folder in reversed(_CATALOGUES.items()):
        each = gettext.translation(domain, folder, [name], fallback=True)
        each.add_fallback(whole)
        whole = each
    return whole


def translated(text: str) -> str:
    """Return a text in the language that is spoken, as it is where no catalogue has it."""
    name = _LANGUAGE.get()
    if name == ENGLISH or not text:
        return text
    return _TEXTS.get(name, {}).get(text) or _catalogue(name).gettext(text)


DECIMAL_SIGNS = {"ru": ","}
"""The sign before a number's decimals where it is no point, by language."""
DECIMAL = re.compile(r"(?<![\w.=])(?<!рис\. )([-−+]?\d+)\.(\d+(?:e[-+]\d+)?)(?![\w]|\.\d)")


def with_decimals(text: str) -> str:
    """Return a text of a report whose decimal numbers have the decimal sign of the language that is spoken.

    Numbers of equations in parentheses, (2.10), versions and keywords of code keep their point.
    """
    mark = DECIMAL_SIGNS.get(_LANGUAGE.get(), ".")

    def shown(found: re.Match[str]) -> str:
        is_number_of = text[found.start() - 1 : found.start()] == "(" and text[found.end() : found.end() + 1] == ")"
        return found[0] if is_number_of else f"{found[1]}{mark}{found[2]}"

    return text if mark == "." else DECIMAL.sub(shown, text)


def said(template: str, /, **values: object) -> str:
    """Return a template in the language that is spoken, filled in: `said("{pin} carries {force}", pin="O", force="3 kN")`.

    A template is one literal, so that catalogues can be made of the source. DefinitionError for a value that it has and is not given.
    """
    return _with_values(translated(template), values)


def said_of(number: int, one: str, many: str, /, **values: object) -> str:
    """Return the one of two templates, or in another language of as many as it has, that goes with a number; `{n}` is that number."""
    name = _LANGUAGE.get()
    template = (one if number == 1 else many) if name == ENGLISH else _catalogue(name).ngettext(one, many, number)
    return _with_values(template, {"n": number, **values})


def _with_values(template: str, values: dict[str, object]) -> str:
    try:
        return template.format(**values)
    except (KeyError, IndexError) as error:
        raise DefinitionError(f"said({cited(template)}): it has {{{error.args[0]}}}, which is not given.") from None


def with_and(parts: Iterable[object]) -> str:
    """Return parts in a row: "A", "A and B", "A and B and C"."""
    return said(" and ").join(map(str, parts))


def noted(text: str) -> str:
    """Return a text as it is: one that is translated later, where it is said, and that belongs into a catalogue."""
    return text


def heading_of(name: str) -> str:
    """Return the heading of a column, a result or a rule in the language that is spoken; names of members in it stay: "pressure lift"."""
    found = translated(name)
    if found != name or _LANGUAGE.get() == ENGLISH:
        return found
    for separator in (": ", " "):
        first, parted, rest = name.rpartition(separator)
        if parted and (known := heading_of(first)) != first:
            return f"{known}{separator}{heading_of(rest) if separator == ': ' else rest}"
    return name


add_catalogue("linkage", Path(__file__).with_name("locale"))
