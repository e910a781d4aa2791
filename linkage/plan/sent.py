"""A plan sent to another process: its members go, what follows from them does not; what arrives twice is the same plan."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from functools import cached_property
from typing import Any
from weakref import WeakValueDictionary

KNOWN: WeakValueDictionary[str, Any] = WeakValueDictionary()
"""The plans that came or went, by their keys."""
LATEST: deque[Any] = deque(maxlen=8)
"""Those that came last, kept with their kernels: a class that is sent by its text comes with every task anew."""


def sent(key: str, plan: Any) -> tuple[Any, ...]:
    """Return what pickle is to make a plan of."""
    KNOWN[key] = plan
    follows = {"_kernels"}.union(*(found_later(base) for base in type(plan).__mro__))
    return arrived, (key, type(plan), {name: value for name, value in vars(plan).items() if name not in follows})


def found_later(kind: type) -> set[str]:
    """Return the attributes that a class works out when they are asked for."""
    return {name for name, member in vars(kind).items() if isinstance(member, cached_property)}


def arrived(key: str, kind: type, parts: Mapping[str, Any]) -> Any:
    """Return the plan of a key: the one that is here already, or one of these parts."""
    plan = KNOWN.get(key)
    if plan is None:
        plan = object.__new__(kind)
        plan.__dict__.update(parts, _kernels={}, key=key)
        plan = KNOWN.setdefault(key, plan)
        LATEST.append(plan)
    return plan
