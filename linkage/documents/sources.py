"""Where a number comes from: the comment beside it in the source of the machine's class."""

from __future__ import annotations

import ast
import inspect
import re
import tokenize
from io import StringIO
from textwrap import dedent

from ..language import translated
from ..mechanism import Mechanism
from ..plan import plan_measure
from ..quantities import Dimension


def notes_of(machine: type[Mechanism]) -> dict[str, str]:
    """Return the comments that stand beside the members in the source of a class and its bases, by name."""
    found: dict[str, str] = {}
    for cls in reversed(machine.__mro__):
        if issubclass(cls, Mechanism) and cls is not Mechanism:
            found |= comments_in(cls)
    plan, kept = machine.plan, {name: translated(text) for name, text in found.items() if name in machine.plan.members}
    for name, text in kept.items():
        member = plan.members[name]
        if not isinstance(member, Dimension) or member.unit or plan_measure(plan, name):  # else nothing but the note says what it measures
            kept[name] = without_unit(text)
    return kept


SHOWN = ("m", "mm", "cm", "rad", "deg", "kg")
"""The units of a source's numbers that a report shows in units of its own."""


def without_unit(note: str) -> str:
    """Return a note without a unit in front or at its end: `cylinder stroke, m`."""
    units = "|".join((*SHOWN, *map(translated, SHOWN)))
    return re.sub(rf"^(?:{units})(?:, |$)|, (?:{units})$", "", note)


def comments_in(cls: type) -> dict[str, str]:
    """Return the comments behind the assignments in a class's body, by the names assigned; none where it has no source."""
    try:
        source = dedent(inspect.getsource(cls))
        body = ast.parse(source).body[0]
        tokens = list(tokenize.generate_tokens(StringIO(source).readline))
    except (OSError, TypeError, SyntaxError, tokenize.TokenError, IndexError):
        return {}
    comments = {token.start[0]: token.string.lstrip("#: ").strip() for token in tokens if token.type == tokenize.COMMENT}
    found: dict[str, str] = {}
    for line in getattr(body, "body", []):
        if (
            isinstance(line, ast.Assign)
            and (text := comments.get(line.end_lineno or line.lineno))
            and not text.startswith(("fmt:", "type:", "noqa"))
        ):
            for target in line.targets:
                listed = target.elts if isinstance(target, ast.Tuple) else [target]
                names = [name.id for name in listed if isinstance(name, ast.Name)]
                named = [name for name in names if re.match(rf"{name}\b", text)]  # of several the one that it speaks of
                found |= dict.fromkeys(named or names, text)
    return found
