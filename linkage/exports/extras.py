"""The libraries of the extras, which may be missing."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ..errors import DefinitionError


def library(name: str, extra: str, what: str) -> Any:
    """Return a library that writes a kind of file; DefinitionError, with the command that installs its extra, where it is missing."""
    try:
        return import_module(name.lower())
    except ImportError:
        remedy = f"pip install 'hydrolinkage[{extra}]' (from a checkout: pip install -e '.[{extra}]')"
        raise DefinitionError(f"{what} is written by {name}, which the extra `{extra}` brings: {remedy}.") from None
