"""The order of construction, and the words where there is none."""

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from linkage import LEFT, DefinitionError, Dyad, Ground, Mechanism, Stroke, ref
from linkage.plan.members import construction_order
from tests.for_all import for_all
from tests.linkage.random_mechanisms import random_mechanism


@given(st.dictionaries(st.integers(0, 15), st.sets(st.integers(0, 15), max_size=4), max_size=16))
def test_everything_comes_after_what_it_needs(graph):
    acyclic = {str(name): [str(each) for each in wanted if each < name and each in graph] for name, wanted in graph.items()}
    order = construction_order(acyclic, "Any")
    assert sorted(order) == sorted(acyclic)
    for name, wanted in acyclic.items():
        assert all(order.index(each) < order.index(name) for each in wanted)


@pytest.mark.parametrize("size", [1, 2, 5])
def test_a_cycle_is_printed(size):
    names = [f"P{number}" for number in range(size)]
    graph = {name: [names[(number + 1) % size]] for number, name in enumerate(names)}
    with pytest.raises(DefinitionError, match=" needs ") as caught:
        construction_order(graph, "Loop")
    assert all(name in str(caught.value) for name in names)


def test_an_unknown_name_says_who_wants_it():
    with pytest.raises(DefinitionError, match=r"'Bb' is unknown in Arm.C. Did you mean B\?"):
        construction_order({"B": [], "C": ["Bb"]}, "Arm")


@for_all("seed", range(1), slow=range(1, 5))
def test_members_in_any_order_make_the_same_machine(seed):
    written = random_mechanism(seed, strokes=2)
    members = list(written.plan.members.items())
    random.Random(seed).shuffle(members)
    shuffled = type("Shuffled", (Mechanism,), {name: vars(written)[name] for name, _ in members})
    strokes = {name: [each.start, each.end / 2, each.end] for name, each in written.plan.strokes.items()}
    for name in written.plan.moving:
        assert_allclose(shuffled().at(**strokes)[name], written().at(**strokes)[name], rtol=1e-13)


def test_everything_may_be_a_string_before_it_is_bound():
    class Backwards(Mechanism):
        """Written from the end."""

        far = ref("half") * 2 + "S"
        half = ref("L") / 2
        C = Dyad("B", "A", BC="far", AC=0.4, side=LEFT)
        B = Dyad("A", "O", AB=ref("L") + "S", OB=0.4, side=LEFT)
        L = 0.0 * ref("S") + 0.4
        O, A, S = Ground(0.5, 0.0), Ground(0.0, 0.0), Stroke(0.0, 0.1)

    motion = Backwards().sweep(3)
    assert motion.distance("B", "C") == pytest.approx(0.4 + motion.strokes["S"])


@pytest.mark.parametrize("chain", [{"B": "C", "C": "B"}, {"B": "B"}, {"B": "C", "C": "D", "D": "B"}])
def test_quantities_that_need_each_other(chain):
    with pytest.raises(DefinitionError, match=" needs "):
        type("Loop", (Mechanism,), {name: ref(other) + 1 for name, other in chain.items()})
