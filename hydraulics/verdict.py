"""A rule that was looked at, and what came out, in words."""

from __future__ import annotations

from dataclasses import dataclass
from typing import final


@final
@dataclass(frozen=True)
class Verdict:
    """One rule: its name, whether it is kept, and a sentence with the numbers and, where it is not kept, the remedy."""

    rule: str
    ok: bool
    sentence: str

    def __bool__(self) -> bool:
        return self.ok

    def __str__(self) -> str:
        return f"{'ok  ' if self.ok else 'FAIL'} {self.rule}: {self.sentence}"
