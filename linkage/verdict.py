"""A rule that was looked at, and what came out, in words."""

from __future__ import annotations

from typing import Any, Self, final

from .errors import DefinitionError, cited
from .language import heading_of, said
from .shown import Shown


@final
class Verdict(str, Shown):
    """One rule: its name, whether it is kept, and a sentence with the numbers and, where it is not kept, the remedy.

    As text it is one line, `ok   lifting: ...` or `FAIL lifting: ...`; it counts as true where the rule is kept, so that
    `all(machine.verdicts(motion))` says whether everything is. Where nothing is left to judge `ok` is None: the line begins with `--`
    and counts as not true. `answer` is what the judge found, None where the rule is of another kind.
    """

    __slots__ = ("answer", "heading", "ok", "rule", "sentence")

    rule: str
    ok: bool | None
    sentence: str
    heading: str
    answer: Any

    def __new__(cls, rule: str, ok: bool | None, sentence: str, heading: str = "", answer: object = None) -> Self:
        """Return a verdict; DefinitionError for a rule or a sentence that is no text.

        `rule` is its name for programs, English; `heading` is it in the language that is spoken, from the catalogues where it is not given.
        """
        for what, text in (("rule", rule), ("sentence", sentence)):
            if not isinstance(text, str) or not text:
                raise DefinitionError(f"Verdict: its {what} is {cited(text)}; write Verdict(rule, ok, sentence), both in words.")
        named = heading or heading_of(rule)
        mark = "--  " if ok is None else said("ok  ") if ok else said("FAIL")
        verdict = super().__new__(cls, f"{mark} {named}: {sentence}")
        verdict.rule, verdict.ok, verdict.sentence, verdict.heading = rule, None if ok is None else bool(ok), sentence, named
        verdict.answer = answer
        return verdict

    def named(self, name: str) -> Self:
        """Return it with a name added to its rule, where several members follow the same one."""
        return type(self)(f"{self.rule} {name}", self.ok, self.sentence, f"{self.heading} {name}", self.answer)

    def answered(self, answer: object) -> Self:
        """Return it with what the judge found."""
        return type(self)(self.rule, self.ok, self.sentence, self.heading, answer)

    def __bool__(self) -> bool:
        return self.ok is True

    def __repr__(self) -> str:
        return f"Verdict({self.rule!r}, {self.ok}, {self.sentence!r})"

    def __reduce__(self) -> tuple[type[Self], tuple[str, bool | None, str, str]]:
        return type(self), (self.rule, self.ok, self.sentence, self.heading)
