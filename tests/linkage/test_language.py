"""Everything that is said stands in a catalogue, in whole; what is said follows the language, and nothing else does."""

import re
import threading
from pathlib import Path

import pytest

import hydraulics  # noqa: F401  its catalogue joins
from linkage import AssemblyError, Column, DefinitionError, Verdict
from linkage.language import (
    add_catalogue,
    add_texts,
    current_language,
    heading_of,
    language,
    languages,
    said,
    said_of,
    translated,
)
from linkage.units import show
from mechanisms.three_point_hitch import ThreePointHitch
from tests.tools.catalogues import BELOW, Entry, Message, catalogue_faults, compiled, entries, entry_faults, messages, source_messages


@pytest.mark.parametrize("package", BELOW)
def test_the_catalogue_has_everything_that_is_said_and_nothing_else(package):
    assert list(catalogue_faults(package, "ru")) == []


def test_a_template_is_translated_and_filled_in():
    assert said("{low} to {high}", low="1", high="2 mm") == "1 to 2 mm"
    with language("ru"):
        assert said("{low} to {high}", low="1", high=show(0.002, "mm")) == "1…2 мм"
    assert current_language() == "en"


def test_what_no_catalogue_has_is_said_as_it_is():
    with language("ru"):
        assert said("a machine of one's own: {n}", n=3) == "a machine of one's own: 3"
        assert heading_of("OB") == "OB" and said("") == ""


def test_counts_choose_their_form(tmp_path):
    forms = [f"{{n}} {word}" for word in ("узел", "узла", "узлов")]
    head = Entry(Message(""), ["Content-Type: text/plain; charset=UTF-8\nPlural-Forms: nplurals=3; plural=" + RUSSIAN])
    folder = tmp_path / "ru" / "LC_MESSAGES"
    folder.mkdir(parents=True)
    (folder / "ours.mo").write_bytes(compiled([head, Entry(Message("{n} knot", "{n} knots"), forms), Entry(Message("own"), ["свой"])]))
    add_catalogue("ours", tmp_path)
    try:
        with language("ru"):
            found = [said_of(n, "{n} knot", "{n} knots") for n in (1, 2, 5, 11, 21, 22)]
            assert said("own") == "свой"
    finally:
        from linkage import language as module

        del module._CATALOGUES["ours"]
        module._catalogue.cache_clear()
    assert found == ["1 узел", "2 узла", "5 узлов", "11 узлов", "21 узел", "22 узла"]
    assert [said_of(n, "{n} knot", "{n} knots") for n in (1, 2)] == ["1 knot", "2 knots"]


RUSSIAN = "(n%10==1 && n%100!=11 ? 0 : n%10>=2 && n%10<=4 && (n%100<10 || n%100>=20) ? 1 : 2);"


def test_languages_are_named_where_one_is_unknown():
    assert languages() == ["en", "ru"]
    with pytest.raises(DefinitionError, match=r"Language 'de' is unknown.*en, ru|de.*en.*ru"), language("de"):
        pass
    assert current_language() == "en"


def test_a_language_ends_where_its_block_does_even_by_an_error():
    with pytest.raises(ZeroDivisionError), language("ru"):
        1 / 0  # noqa: B018
    assert current_language() == "en"


def test_another_thread_speaks_its_own_language():
    heard = []
    with language("ru"):
        other = threading.Thread(target=lambda: heard.append(said("FAIL")))
        other.start()
        other.join()
    assert heard == ["FAIL"]


def test_a_value_that_is_not_given_is_refused():
    with pytest.raises(DefinitionError, match="high"):
        said("{low} to {high}", low=1)


def test_a_folder_without_a_catalogue_is_refused(tmp_path):
    with pytest.raises(DefinitionError, match=r"no \*/LC_MESSAGES/ours.mo"):
        add_catalogue("ours", tmp_path)


def test_verdicts_and_headings_are_of_the_language():
    with language("ru"):
        kept, broken = Verdict("own rule", True, "да."), Verdict("own rule", False, "нет.")
        assert (kept, broken) == ("да   own rule: да.", "НЕТ  own rule: нет.")
        assert kept.rule == "own rule" and Column("S", [0.1], "mm").heading == "S, мм"
    assert Column("S", [0.1], "mm").heading == "S, mm"


def test_every_unit_has_its_sign():
    from linkage import units

    shipped = re.findall(r'"([^"]+)": \(', Path(units.__file__).read_text(encoding="utf-8"))  # others may have been added meanwhile
    said = {each.text for each in source_messages("linkage")}
    assert set(shipped) - {"°"} <= said and "°" not in said and len(shipped) > 50


# -- the tool that the first test relies on -----------------------------------------------------------------


SOURCE = """
from ..language import noted, said, said_of
said("a {b}", b=said_of(n, "one", "{n} of them"))
Verdict("reach", False, text)
noted("x")
other("y")
"""


def test_what_a_file_says_is_found():
    found = {(each.text, each.many) for each in messages("a.py", SOURCE)}
    assert found == {("a {b}", ""), ("one", "{n} of them"), ("reach", ""), ("x", "")}
    with pytest.raises(ValueError, match="literal"):
        list(messages("a.py", 'from .language import said\nsaid(f"a {b}")'))


def test_faults_of_a_translation_are_found():
    assert list(entry_faults(Entry(Message("{a} is {b:.3f}"), ["{b:.3f}: {a}"]))) == []
    assert "fuzzy" in next(entry_faults(Entry(Message("a"), ["б"], True)))
    assert "no translation" in next(entry_faults(Entry(Message("a"), [""])))
    assert "different" in next(entry_faults(Entry(Message("{a} is {b:.3f}"), ["{b:.2f}: {a}"])))
    assert "no translation" in next(entry_faults(Entry(Message("a", "b"), ["б", "в"])))


def test_a_catalogue_is_read_with_its_marks(tmp_path: Path):
    text = 'msgid ""\nmsgstr ""\n"a\\n"\n"b"\n\n#, fuzzy\nmsgid "one"\nmsgid_plural "many"\nmsgstr[0] "х"\nmsgstr[1] "у"\nmsgstr[2] "ц"\n'
    head, counted = entries(text)
    assert head.translations == ["a\nb"] and counted.fuzzy and counted.message == Message("one", "many")
    assert counted.translations == ["х", "у", "ц"]


def test_texts_of_ones_own_are_said_before_the_catalogues(monkeypatch):
    monkeypatch.setattr("linkage.language._TEXTS", {})
    add_texts("ru", {"My loader": "Мой погрузчик", "pin": "палец"})
    assert translated("My loader") == "My loader"
    with language("ru"):
        assert [translated("My loader"), translated("pin")] == ["Мой погрузчик", "палец"]
    for name, texts, words in (("xx", {}, "xx"), ("ru", {"a": 1}, "pairs of text"), ("ru", {"a": ""}, "pairs"), ("ru", "a", "pairs")):
        with pytest.raises(DefinitionError, match=words):
            add_texts(name, texts)


@pytest.mark.parametrize("strokes", [9.0, [0.1, 9.0]])
def test_errors_stay_english(strokes):
    hitch = ThreePointHitch()
    with pytest.raises(AssemblyError) as plain:
        hitch.at(S=strokes)
    with language("ru"), pytest.raises(AssemblyError) as found:
        hitch.at(S=strokes)
    assert str(found.value) == str(plain.value)
