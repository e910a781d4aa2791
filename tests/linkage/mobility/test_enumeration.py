"""Kinematic chains against the known counts, and against isomorphism by other means: permutations one by one, and networkx."""

from itertools import combinations, permutations
from math import factorial

import networkx as nx
import numpy as np
import pytest

from linkage.mobility import canonical, chain_forms, joint_pairs
from linkage.mobility.enumeration import is_degenerate


def graph(form):
    """Return a form as a graph."""
    return nx.Graph(joint_pairs(form))


def form_of(edges, links):
    """Return the form of edges."""
    return tuple(sum(1 << other for pair in edges if link in pair for other in pair if other != link) for link in range(links))


def relabelled(form, order):
    """Return a form whose link k is numbered order[k]."""
    return form_of([(order[a], order[b]) for a, b in joint_pairs(form)], len(form))


def least_code(form):
    """Return the least of all numberings, one by one."""
    edges = joint_pairs(form)
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


BYTE = np.array([number.bit_count() for number in range(256)])


def bits(numbers):
    """Return how many bits of numbers (n,) are set."""
    return BYTE[numbers.view(np.uint8).reshape(len(numbers), 8)].sum(axis=1)


def labelled_chains(links):
    """Return how many chains there are of numbered links, each numbering counted: all sets of joints, of which no part is rigid."""
    joints, pairs = (3 * links - 4) // 2, [*combinations(range(links), 2)]
    bit = {pair: 1 << place for place, pair in enumerate(pairs)}
    parts = [part for size in range(3, links) for part in combinations(range(links), size)]
    limits = [(sum(bit[pair] for pair in combinations(part, 2)), (3 * len(part) - 4) // 2) for part in parts]
    sets = {0: np.zeros(1, np.int64)}
    for place, pair in enumerate(pairs):
        grown = {count: [each] for count, each in sets.items()}
        for count, each in sets.items():
            more = each | bit[pair] if count < joints else each[:0]
            for part, most in limits:
                if part & bit[pair]:
                    more = more[bits(more & part) <= most]
            grown.setdefault(count + 1, []).append(more)
        left = len(pairs) - place - 1
        sets = {count: np.concatenate(each) for count, each in grown.items() if joints - left <= count <= joints}
    on_links = [sum(bit[pair] for pair in pairs if link in pair) for link in range(links)]
    return int(np.all([bits(sets[joints] & each) >= 2 for each in on_links], axis=0).sum())


@pytest.mark.parametrize(
    ("links", "count"), [(4, 3), (6, 360), pytest.param(8, 247_800, marks=pytest.mark.slow)]
)  # fmt: skip
def test_all_numberings_of_all_chains_are_as_many_as_a_count_of_all_sets_of_joints(links, count):
    """A chain has n! numberings, in parts of its symmetries: together as many as sets of joints are found one joint after the other."""
    numberings = 0
    for form in chain_forms(links):
        matcher = nx.isomorphism.GraphMatcher(graph(form), graph(form))
        numberings += factorial(links) // sum(1 for _ in matcher.isomorphisms_iter())
    assert numberings == labelled_chains(links) == count


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
