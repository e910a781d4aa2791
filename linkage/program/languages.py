"""The languages that values and ratios are written in: C, JavaScript, and what packages bring."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

from .. import plugins
from ..plugins import Plugins
from .foreign import NOTHING, C, Language
from .javascript import JavaScript
from .node import Node


class SourceWriter(Protocol):
    """What writes nodes as the text of one function; `words` are those that its name may not be."""

    words: str

    def text(self, outputs: Sequence[Node], name: str = "poses", design: Mapping[str, float] = NOTHING) -> str:
        """Return the text; a comment in it names the inputs, with the values of a design."""


LANGUAGES = Plugins[SourceWriter](
    plugins.LANGUAGES,
    "The language",
    lambda found: found if isinstance(found, Language) else found() if isinstance(found, type) and issubclass(found, Language) else None,
    "no subclass of linkage.program.Language",
    {"c": C(), "javascript": JavaScript()},
)
"""The languages there are, by name."""
