"""All planar kinematic chains of one degree of freedom with turning pairs only, each once.

A chain is a graph: links are its nodes, turning pairs its edges, and 3 (n - 1) - 2 j = 1. A degenerate chain holds a part of mobility 0 or
less, which is rigid by itself; the others are connected twice, so that each is a loop on which open strings of links are put, one after the
other (H. Whitney, Non-separable and planar graphs, Trans. Amer. Math. Soc. 34 (1932) 339-362). The numbers, 1, 2, 16 and 230 of four, six,
eight and ten links, are those of T. S. Mruthyunjaya, Kinematic structure of mechanisms revisited, Mech. Mach. Theory 38 (2003) 279-320.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import combinations, pairwise, product
from typing import TypeAlias

import numpy as np

Form: TypeAlias = tuple[int, ...]
"""Of each link those that it is jointed to, as the bits of a number."""
MOST_LINKS = 12


@lru_cache(maxsize=8)
def chain_forms(links: int) -> tuple[Form, ...]:
    """Return the canonical forms of all chains of so many links, an even number, those with the most joints on a link last."""
    loops = links // 2 - 1
    known = {canonical(loop(size)) for size in range(4, links + 1)} if loops > 1 else {canonical(loop(links))}
    for number in range(2, loops + 1):
        grown: set[Form] = set()
        for form in known:
            sizes = [links - len(form)] if number == loops else [*range(links - len(form) + 1)]
            for (a, b), size in product(combinations(range(len(form)), 2), sizes):
                if not size and form[a] >> b & 1:
                    continue
                rows = [*form, *([0] * size)]  # with a string of so many new links from one to another; of none the two are jointed
                for one, other in pairwise((a, *range(len(form), len(rows)), b)):
                    rows[one] |= 1 << other
                    rows[other] |= 1 << one
                if not is_degenerate(tuple(rows)):
                    grown.add(canonical(tuple(rows)))
        known = grown
    return tuple(sorted(known, key=lambda form: (sorted(each.bit_count() for each in form)[::-1], form)))


def loop(size: int) -> Form:
    """Return a closed loop of links."""
    return tuple(1 << (place + 1) % size | 1 << (place - 1) % size for place in range(size))


def is_degenerate(form: Form) -> bool:
    """Return whether some of its links, with the joints between them, have a mobility of 0 or less."""
    which = np.arange(1 << len(form))
    has = [which >> place & 1 for place in range(len(form))]
    links = np.sum(has, axis=0)
    joints = np.sum([has[a] & has[b] for a, b in joint_pairs(form)], axis=0)
    return bool(np.any((3 * (links - 1) - 2 * joints < 1) & (links > 1)))


def joint_pairs(form: Form) -> tuple[tuple[int, int], ...]:
    """Return the pairs of links that are jointed."""
    return tuple((a, b) for a, b in combinations(range(len(form)), 2) if form[a] >> b & 1)


def canonical(form: Form, marked: Sequence[int] = ()) -> Form:
    """Return the form that all numberings of a chain share, the links with the most joints first; links that are `marked` before them.

    Links are told apart by their neighbours, again and again; where some are left that look alike, each of them is tried as the first.
    """
    near = [[other for other in range(len(form)) if row >> other & 1] for row in form]
    found: list[Form] = []

    def search(colours: list[int]) -> None:
        finer, colours = colours, []
        while len(set(finer)) != len(set(colours)):  # as fine as the colours of neighbours make them
            colours = finer
            finer = ranked([(colours[link], *sorted(colours[other] for other in each)) for link, each in enumerate(near)])
        colours = finer
        alike: dict[int, list[int]] = {}
        for link, colour in enumerate(colours):
            alike.setdefault(colour, []).append(link)
        several = next((alike[colour] for colour in sorted(alike) if len(alike[colour]) > 1), [])
        for first in several:
            search([2 * colour - (link == first) for link, colour in enumerate(colours)])
        if not several:
            rows = sorted((colours[link], sum(1 << colours[other] for other in near[link])) for link in range(len(form)))
            found.append(tuple(row for _, row in rows))

    place = {link: number - len(marked) for number, link in enumerate(marked)}
    search(ranked([(place.get(link, 0), -len(each)) for link, each in enumerate(near)]))
    return min(found)


def ranked(keys: Sequence[tuple[int, ...]]) -> list[int]:
    """Return the place of each among the different ones."""
    places = {key: place for place, key in enumerate(sorted(set(keys)))}
    return [places[key] for key in keys]
