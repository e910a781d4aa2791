"""The order in which things can be placed, and the words for it when there is none."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from graphlib import CycleError, TopologicalSorter

from ..errors import DefinitionError, unknown


def ordered(needs: Mapping[str, Iterable[str]], title: str) -> list[str]:
    """Return the names so that each comes after all it needs, in the order written where that is free.

    Raises DefinitionError for a name nobody declares and for a cycle, which it prints.
    """
    graph = {name: list(dict.fromkeys(wanted)) for name, wanted in needs.items()}
    for name, wanted in graph.items():
        for each in wanted:
            if each not in graph:
                raise unknown("Name", each, graph, where=f"{title}.{name}")
    try:
        return list(TopologicalSorter(graph).static_order())
    except CycleError as error:
        cycle = list(reversed(error.args[1]))
        words = " needs ".join(cycle)
        raise DefinitionError(f"{title}: {words}. Nothing in this cycle can come first; take one of them from another point.") from None
