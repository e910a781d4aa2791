"""Tables as JSON text: a line for each member."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any


def json_text(data: Mapping[str, Any]) -> str:
    """Return the text of a file's tables."""
    return "{\n" + ",\n".join(f"  {inline(name)}: {entry(value)}" for name, value in data.items()) + "\n}\n"


def entry(value: Any) -> str:
    """Return a section with a line for each member; any other value in one line."""
    if not isinstance(value, Mapping):
        return inline(value)
    return "{\n" + ",\n".join(f"    {inline(name)}: {inline(each)}" for name, each in value.items()) + "\n  }"


def inline(value: Any) -> str:
    """Return a value in one line."""
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
