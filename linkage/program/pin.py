"""A back end held for some time, in one thread: what a result is then depends on its inputs alone."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

PINNED: ContextVar[str | None] = ContextVar("linkage_backend", default=None)
"""The back end of all work that names none and is more than a few poses; None: the quickest, by the work done before."""


@contextmanager
def pinned(backend: str) -> Iterator[None]:
    """Run what would choose its back end by itself on this one, in this thread, while the context lasts."""
    token = PINNED.set(backend)
    try:
        yield
    finally:
        PINNED.reset(token)
