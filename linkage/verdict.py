"""Verdicts: the result of a rule, in words."""

from __future__ import annotations

from typing import Any, ClassVar, Self

from .errors import DefinitionError, cited
from .language import heading_of, said
from .shown import Shown


class Verdict(str, Shown):
    """One rule of a machine, and whether it is kept.

    As text it is one line, `ok   lifting: ...` or `FAIL lifting: ...`. It counts as true where the rule is kept, so that
    `all(machine.verdicts(motion))` says whether everything is. `member` is the name of the member that says it, "" for the machine.

    Parameters
    ----------
    rule : str
        The name of the rule.
    ok : bool, optional
        Whether it is kept. None where nothing is left to judge: the line begins with `--` and counts as not true.
    sentence : str
        What is the case, with the numbers and, where the rule is not kept, the remedy.
    heading : str, optional
        The rule in the language that is spoken; from the catalogues where it is not given.
    answer : Answer, optional
        What the judge found; None where the rule is of another kind.
    """

    __slots__ = ("answer", "heading", "member", "ok", "rule", "sentence")

    is_rule: ClassVar[bool] = True
    """Whether it counts among the rules that are kept or not."""

    rule: str
    ok: bool | None
    sentence: str
    heading: str
    answer: Any
    member: str

    def __new__(cls, rule: str, ok: bool | None, sentence: str, heading: str = "", answer: object = None) -> Self:
        """Return a verdict; DefinitionError for a rule or a sentence that is no text.

        `rule` is its name for programs, English; `heading` is it in the language that is spoken, from the catalogues where it is not given.
        """
        for what, text in (("rule", rule), ("sentence", sentence)):
            if not isinstance(text, str) or not text:
                raise DefinitionError(f"Verdict: its {what} is {cited(text)}; write Verdict(rule, ok, sentence), both in words.")
        named = heading or heading_of(rule)
        mark = "--  " if ok is None else said("ok  ") if ok else said("FAIL")
        return cls._made(f"{mark} {named}: {sentence}", rule, None if ok is None else bool(ok), sentence, named, answer)

    @classmethod
    def _made(cls, text: str, rule: str, ok: bool | None, sentence: str, heading: str, answer: object) -> Self:
        """Return it with its parts; `text` is the line that is printed."""
        verdict = super().__new__(cls, text)
        verdict.rule, verdict.ok, verdict.sentence, verdict.heading, verdict.answer = rule, ok, sentence, heading, answer
        verdict.member = ""
        return verdict

    @staticmethod
    def refused(rule: str, error: Exception) -> Verdict:
        """Return a failed verdict for a rule whose question is refused: the error says why.

        Parameters
        ----------
        rule : str
            The rule.
        error : Exception
            The error.

        Returns
        -------
        Verdict
            The verdict.
        """
        return Verdict(rule, False, " ".join(str(error).split()))

    def named(self, name: str) -> Self:
        """Return it with a name added to its rule, where several members follow the same one.

        Parameters
        ----------
        name : str
            A member's name.

        Returns
        -------
        Verdict
            The verdict.
        """
        return type(self)(
            f"{self.rule} {name}", self.ok, self.sentence, self.heading if name == self.heading else f"{self.heading} {name}", self.answer
        )

    def answered(self, answer: object) -> Self:
        """Return it with the judge's answer.

        Parameters
        ----------
        answer : Answer
            The judge's answer.

        Returns
        -------
        Verdict
            The verdict.
        """
        return self._made(str(self), self.rule, self.ok, self.sentence, self.heading, answer)

    def said_by(self, member: str) -> Self:
        """Return it, and note the name of the member that says it.

        Parameters
        ----------
        member : str
            The member's name.

        Returns
        -------
        Verdict
            The verdict.
        """
        self.member = member
        return self

    def __bool__(self) -> bool:
        return self.ok is True

    def __repr__(self) -> str:
        return f"Verdict({self.rule!r}, {self.ok}, {self.sentence!r})"

    def __reduce__(self) -> tuple[type[Self], tuple[str, bool | None, str, str]]:
        return type(self), (self.rule, self.ok, self.sentence, self.heading)


class Remark(Verdict):
    """A sentence about a machine that is no rule: something to know, neither kept nor broken.

    It is printed as the sentence alone. Its rule is "remark", its heading is empty and `ok` is None. It counts as true, so that
    `all(machine.verdicts())` asks the rules only.

    Parameters
    ----------
    sentence : str
        The sentence.
    """

    __slots__ = ()

    is_rule = False

    def __new__(cls, sentence: str) -> Self:
        """Return a remark.

        Parameters
        ----------
        sentence : str
            What is to be known, in words.

        Raises
        ------
        DefinitionError
            The sentence is empty or no text.
        """
        if not isinstance(sentence, str) or not sentence:
            raise DefinitionError(f"Remark: its sentence is {cited(sentence)}; write Remark(sentence), in words.")
        return cls._made(sentence, "remark", None, sentence, "", None)

    def named(self, name: str) -> Self:
        """Return it unchanged: a sentence names its subject itself.

        Parameters
        ----------
        name : str
            A member's name.

        Returns
        -------
        Remark
            The remark itself.
        """
        return self

    def __bool__(self) -> bool:
        return True

    def __repr__(self) -> str:
        return f"Remark({self.sentence!r})"

    def __reduce__(self) -> tuple[type[Self], tuple[str]]:  # type: ignore[override]
        return type(self), (self.sentence,)
