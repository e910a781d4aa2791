"""Kinematic chains against the known counts, and against isomorphism by other means: permutations one by one, and networkx."""

from itertools import combinations, permutations

import networkx as nx
import numpy as np
import pytest

from linkage.mobility import canonical, chain_forms, joined
from linkage.mobility.enumeration import is_degenerate


def graph(form):
    """Return a form as a graph."""
    return nx.Graph(joined(form))


def form_of(edges, links):
    """Return the form of edges."""
    return tuple(sum(1 << other for pair in edges if link in pair for other in pair if other != link) for link in range(links))


def relabelled(form, order):
    """Return a form whose link k is numbered order[k]."""
    return form_of([(order[a], order[b]) for a, b in joined(form)], len(form))


def least_code(form):
    """Return the least of all numberings, one by one."""
    edges = joined(form)
    return min(sorted(tuple(sorted((order[a], order[b]))) for a, b in edges) for order in permutations(range(len(form))))


@pytest.mark.parametrize(("links", "count", "inversions"), [(4, 1, 1), (6, 2, 5), (8, 16, 71)])
def test_the_known_counts(links, count, inversions):
    forms = chain_forms(links)
    assert len(forms) == count
    assert sum(len({canonical(form, [frame]) for frame in range(links)}) for form in forms) == inversions


@pytest.mark.slow
def test_the_known_counts_of_ten_links():
    forms = chain_forms(10)
    assert len(forms) == 230
    assert sum(len({canonical(form, [frame]) for frame in range(10)}) for form in forms) == 1834
    for one, other in combinations(forms, 2):
        assert not nx.faster_could_be_isomorphic(graph(one), graph(other)) or not nx.is_isomorphic(graph(one), graph(other))


def test_every_six_bar_is_found_by_looking_at_all_graphs():
    """All graphs of six links and seven joints, of which every part has a mobility above 0 and no link hangs loose."""
    found = []
    for edges in combinations(combinations(range(6), 2), 7):
        each = nx.Graph(edges)
        if len(each) < 6 or min(dict(each.degree).values()) < 2:
            continue
        parts = [each.subgraph(part) for size in range(2, 6) for part in combinations(range(6), size)]
        moves = all(3 * (len(part) - 1) - 2 * part.number_of_edges() >= 1 for part in parts)
        if moves and not any(nx.is_isomorphic(each, other) for other in found):
            found.append(each)
    assert len(found) == 2
    assert all(any(nx.is_isomorphic(each, graph(form)) for form in chain_forms(6)) for each in found)


@pytest.mark.parametrize("links", [4, 6, 8])
def test_no_two_are_one_and_each_has_its_mobility(links):
    forms = chain_forms(links)
    assert not any(nx.is_isomorphic(graph(one), graph(other)) for one, other in combinations(forms, 2))
    for form in forms:
        each = graph(form)
        assert 3 * (links - 1) - 2 * each.number_of_edges() == 1
        assert nx.is_biconnected(each)
        assert not is_degenerate(form)


def test_the_canonical_form_of_any_numbering():
    """Of random numberings of all chains, and of random graphs; of the small ones the least code of all permutations says the same."""
    random = np.random.default_rng(5)
    for form in (*chain_forms(6), *chain_forms(8)):
        for _ in range(5):
            order = random.permutation(len(form)).tolist()
            link = int(random.integers(len(form)))
            assert canonical(relabelled(form, order)) == form
            assert canonical(relabelled(form, order), [order[link]]) == canonical(form, [link])
    pairs = [*combinations(range(6), 2)]
    some = [form_of([pairs[k] for k in random.choice(15, 7, replace=False)], 6) for _ in range(25)]
    codes = [least_code(form) for form in some]
    for (one, code), (other, known) in combinations(zip(some, codes, strict=True), 2):
        assert (canonical(one) == canonical(other)) == (code == known)


@pytest.mark.parametrize("links", [4, 6, 8])
def test_inversions_are_the_orbits_of_the_automorphisms(links):
    for form in chain_forms(links):
        each = graph(form)
        group = [*nx.isomorphism.GraphMatcher(each, each).isomorphisms_iter()]
        orbits = {frozenset(way[link] for way in group) for link in each}
        kinds = {}
        for link in range(links):
            kinds.setdefault(canonical(form, [link]), set()).add(link)
        assert orbits == {frozenset(each) for each in kinds.values()}


def test_a_part_that_is_rigid_by_itself_is_told():
    triangle = [(0, 1), (1, 2), (0, 2), (2, 3), (3, 4), (4, 5), (5, 0)]
    assert is_degenerate(form_of(triangle, 6))
    assert not any(triangles for form in chain_forms(8) for triangles in nx.triangles(graph(form)).values())
