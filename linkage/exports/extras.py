"""What is said where a library of an extra is not installed."""

from __future__ import annotations

from ..errors import DefinitionError


def missing_extra(extra: str, what: str, library: str) -> DefinitionError:
    """Return the error of a library that is missing, with the command that installs its extra."""
    return DefinitionError(
        f"{what} is written by {library}, which the extra `{extra}` brings: pip install 'hydrolinkage[{extra}]' "
        f"(from a checkout: pip install -e '.[{extra}]')."
    )
