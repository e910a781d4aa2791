"""The kinematic chain as a graph of networkx: bodies are nodes, pins and slides are edges."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from ..plan import Plan
from ..quantities import joined_names, source_text
from ..shown import Shown
from ..steps import Link
from ..vectors import Numbers

if TYPE_CHECKING:
    import networkx as nx


@dataclass(frozen=True)
class ChainTables(Shown):
    """A chain as a notebook shows it.

    Bodies have name, kind and points. Joints have name, kind, two bodies and strokes.
    """

    title: str
    bodies: tuple[tuple[str, ...], ...]
    joints: tuple[tuple[str, ...], ...]


def chain_graph(plan: Plan, inputs: Mapping[str, Numbers]) -> nx.MultiGraph:
    """Return the graph of a machine's chain at some inputs: design variables and strokes [SI].

    Of a node, `kind` is "frame", "body", "barrel", "rod", "arm", "carriage" or "block", `points` are its points, `link` is the `Link` that
    declares it, "" for none, and `dimensions` are the distances of its points [m], by their names joined. Of an edge, whose key is its
    name, `kind` is "pin" or "slide", `strokes` are those that drive it, and `dimensions` are the driven lengths as they are written.
    """
    import networkx as nx

    with np.errstate(all="ignore"):  # out of reach, its distances are NaN but those that are given
        reading, chain = plan.read(inputs), plan.chain
    links = {name: set(link.point_names) for name, link in plan.of_kind(Link).items()}
    graph = nx.MultiGraph(name=plan.title)
    for body in chain.bodies:
        link = next((name for name, points in links.items() if body.kind in ("body", "arm") and points <= set(body.points)), "")
        with np.errstate(all="ignore"):
            far = {joined_names(P, Q): np.asarray(reading.link_length(P, Q), float) for P, Q in combinations(body.points, 2)}
        dimensions = {name: length if length.ndim else float(length) for name, length in far.items()}  # an array of a batch of designs
        graph.add_node(body.name, kind=body.kind, points=body.points, link=link, dimensions=dimensions)
    for pair in chain.pairs:
        driven = {} if pair.length is None else {pair.name: source_text(pair.length)}
        graph.add_edge(pair.a, pair.b, key=pair.name, kind=pair.kind, strokes=pair.strokes, dimensions=driven)
    nodes = graph.nodes(data=True)
    bodies = tuple((f"{name} ({data['link']})" if data["link"] else name, data["kind"], " ".join(data["points"])) for name, data in nodes)
    joints = tuple((pair.name, pair.kind, pair.a, pair.b, ", ".join(pair.strokes)) for pair in chain.pairs)
    graph.__dict__["_repr_html_"] = ChainTables(plan.heading, bodies, joints)._repr_html_
    return graph
