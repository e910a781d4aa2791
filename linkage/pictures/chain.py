"""The picture of a kinematic chain: bodies as plates with names, pins and slides as marks on the lines between them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from ..errors import DefinitionError
from ..language import said
from ..program import FloatArray
from . import style
from .sheet import empty_figure, footnote, write_title

if TYPE_CHECKING:
    import networkx as nx

ROOM = 1.4
"""The side of the square that a body has for itself [inch]."""
LEAST, MOST = 4.5, 12.0
"""The range of the picture's side [inch]."""
BOW = 0.22
"""How far lines between the same two bodies are bent apart, over their length."""
NAME = 6
"""The letters of a body's name that stands above its link's."""
SHARES = (0.5, 0.42, 0.58, 0.34, 0.66)
"""Where on its line the mark of a joint may stand, the usual place first."""
COLOURS = {"frame": style.RULE, "barrel": style.BARREL, "rod": style.ROD, "block": style.PAPER, "carriage": style.PAPER}


def draw_chain(graph: nx.MultiGraph) -> Figure:
    """Return a figure of a machine's graph; DefinitionError for one that is none: without bodies, or without kinds of joints."""
    if not len(graph) or not all("kind" in each[-1] for each in (*graph.nodes(data=True), *graph.edges(data=True))):
        raise DefinitionError("draw(graph): this is no graph of a machine, whose bodies and joints have kinds; give machine.graph.")
    side = float(np.clip(ROOM * np.sqrt(len(graph)) + 1.5, LEAST, MOST))
    figure = empty_figure(1.25 * side, side)
    ax = figure.add_axes((0.08, 0.07, 0.84, 0.82))
    ax.set_axis_off()
    at = node_places(graph)
    taken = list(at.values())
    for a, b in dict.fromkeys(tuple(sorted(pair[:2])) for pair in graph.edges):
        beside = list(graph.get_edge_data(a, b).items())
        for place, (name, data) in enumerate(beside):
            taken.append(joint(ax, str(name), data, at[a], at[b], BOW * (place - 0.5 * (len(beside) - 1)), taken))
    plain = [str(name) for name, data in graph.nodes(data=True) if data["kind"] not in COLOURS]
    places = style.body_colours([style.part_of_points(name.split(" ")) for name in plain])
    colours = {name: style.PALETTE[place] for name, place in zip(plain, places, strict=True)}
    for name, data in graph.nodes(data=True):  # a plate with its name, and that of its link below, which stands alone for a long one
        (x, y), link, face = at[name], data.get("link"), COLOURS.get(data["kind"]) or colours[str(name)]
        words = link if link and len(str(name)) > NAME else f"{name}\n{link}" if link else str(name)
        box = {"boxstyle": "round,pad=0.45", "facecolor": face, "edgecolor": style.mixed(face, style.INK, 0.65), "linewidth": style.OUTLINE}
        ax.plot(x, y, alpha=0.0)
        ax.text(
            x, y, words, ha="center", va="center", fontsize=style.TEXT, color=style.INK, bbox=box, zorder=3, gid=f"body {name}",
            fontweight="bold" if data["kind"] == "frame" else "normal",
        )  # fmt: skip
    bodies, joints = graph.number_of_nodes(), graph.number_of_edges()
    freedom = f"3 ({bodies} - 1) - 2 · {joints} = {3 * (bodies - 1) - 2 * joints}"
    write_title(figure, str(graph.name), freedom.replace("-", "\N{MINUS SIGN}"))
    footnote(figure, said("round: pin; square: slide; orange: driven by the stroke that is named"))
    return figure


def node_places(graph: nx.MultiGraph) -> dict[str, FloatArray]:
    """Return where the bodies stand, shape (2,) each: neighbours near each other, few crossings, the frame below."""
    import networkx as nx

    simple = nx.Graph(graph)
    is_planar, _ = nx.check_planarity(simple)
    start = nx.planar_layout(simple) if is_planar and len(simple) > 2 else nx.circular_layout(simple)
    found = nx.kamada_kawai_layout(simple, pos=start)
    centre = np.mean(list(found.values()), axis=0)
    down = found.get("frame", centre) - centre
    turn = np.exp(1j * (-0.5 * np.pi - np.arctan2(down[1], down[0]))) if np.hypot(*down) > 1e-9 else 1.0
    turned = {name: complex(*(place - centre)) * turn for name, place in found.items()}
    return {name: np.array([place.real, place.imag]) for name, place in turned.items()}


def joint(ax: Axes, name: str, data: dict[str, Any], a: FloatArray, b: FloatArray, bow: float, taken: Sequence[FloatArray]) -> FloatArray:
    """Return where the mark of a joint stands, shape (2,): on the line between its bodies, bent by a share of its length."""
    bent = 0.5 * (a + b) + 2.0 * bow * np.array([a[1] - b[1], b[0] - a[0]])
    path = Path([a, bent, b], [Path.MOVETO, Path.CURVE3, Path.CURVE3])
    spots = [(1 - t) ** 2 * a + 2 * t * (1 - t) * bent + t**2 * b for t in SHARES]
    clear = [min(float(np.hypot(*(spot - other))) for other in taken) for spot in spots]
    spot = spots[next(index for index, room in enumerate(clear) if room > 0.8 * max(clear))]
    driven = bool(data["strokes"])
    edge = style.ACCENT if driven else style.INK
    ax.add_patch(PathPatch(path, facecolor="none", edgecolor=edge, linewidth=style.BOLD, zorder=1))
    words = "\n".join([name, ", ".join(data["strokes"])]) if driven else name
    shape = "circle,pad=0.25" if data["kind"] == "pin" else "square,pad=0.25"
    box = {"boxstyle": shape, "facecolor": style.PAPER, "edgecolor": edge, "linewidth": style.OUTLINE}
    x, y = spot
    ax.text(x, y, words, ha="center", va="center", fontsize=style.SMALL, color=edge, bbox=box, zorder=2, gid=f"joint {name}")
    return spot
