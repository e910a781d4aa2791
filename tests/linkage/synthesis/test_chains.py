"""Machines of the kinematic chains: named as textbooks do, assembled at any pose with links that keep their lengths, mobility 1."""

from itertools import combinations

import networkx as nx
import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import DefinitionError, chains
from linkage.plan import KinematicChain
from linkage.synthesis.chains import bodies
from mechanisms.classics.four_bar import FourBar
from mechanisms.classics.klann import Klann
from mechanisms.classics.stephenson_one import StephensonOne
from mechanisms.classics.stephenson_three import StephensonThree, StephensonThreeFar
from mechanisms.classics.stephenson_two import StephensonTwo, StephensonTwoFar
from mechanisms.classics.watt_two import WattTwo
from tests.for_all import for_all

SHIPPED = {
    FourBar: "four-bar",
    WattTwo: "Watt II",
    StephensonOne: "Stephenson I",
    StephensonTwo: "Stephenson II",
    StephensonTwoFar: "Stephenson II",
    StephensonThree: "Stephenson III",
    StephensonThreeFar: "Stephenson III",
    Klann: "Stephenson III",
}


def with_frame(inversion):
    """Return the graph of an inversion, its frame marked."""
    found = nx.Graph(inversion.chain.graph)
    nx.set_node_attributes(found, {link: "frame" if link == inversion.frame else "body" for link in found}, "kind")
    return found


def alike(one, other):
    """Return whether two graphs are one, frame for frame."""
    return nx.is_isomorphic(nx.Graph(one), nx.Graph(other), node_match=lambda a, b: a["kind"] == b["kind"])


@for_all("machine", SHIPPED, ids=lambda cls: cls.__name__)
def test_shipped_machines_are_the_inversions_of_their_names(machine):
    every = [each for links in (4, 6) for chain in chains(links) for each in chain.inversions]
    found = [each.name for each in every if alike(machine().graph, with_frame(each))]
    assert found == [SHIPPED[machine]]


def test_names_and_numbers():
    assert [each.name for each in chains(4)] == ["four-bar"]
    assert [inversion.name for chain in chains(6) for inversion in chain.inversions] == [
        "Watt I", "Watt II", "Stephenson I", "Stephenson II", "Stephenson III",
    ]  # fmt: skip
    eight = chains(8)
    assert [chain.assortment for chain in eight] == [(4, 4)] * 9 + [(5, 2, 1)] * 5 + [(6, 0, 2)] * 2
    assert len({inversion.name for chain in eight for inversion in chain.inversions}) == 71
    for chain in eight:
        assert all(KinematicChain(bodies(inversion)).gruebler_count == 1 for inversion in chain.inversions)


def check_machine(inversion, crank, random):
    """Check a machine of an inversion: its chain, its mobility, its steps, and its links at random poses."""
    machine = inversion.machine(crank)
    assert alike(machine.graph, with_frame(inversion))
    assert machine.mobility == machine.gruebler == 1
    assert bool(machine.plan.groups) != inversion.has_dyads_only(crank)
    machine.sweep(91)
    motion = machine.at(phi=random.uniform(0.0, 2.0 * np.pi, 7))
    size = max(float(motion.distance("O", point).max()) for point in machine.plan.points if point != "O")
    moved = False
    for body in machine.links:
        for one, other in combinations(body.points, 2):
            length = motion.distance(one, other)
            assert_allclose(length, length[0], rtol=0, atol=1e-9 * size)
    for point in machine.plan.moving:
        moved |= bool(np.ptp(motion[point], axis=1).max() > 1e-4 * size)
    assert moved and np.ptp(motion["P"], axis=1).max() > 1e-4 * size


@pytest.mark.parametrize(("links", "step"), [(4, 1), (6, 3), pytest.param(6, 1, marks=pytest.mark.slow)])
def test_every_machine_of_four_and_six_links(links, step):
    """Daily each third of six links."""
    random = np.random.default_rng(links)
    for inversion, crank in machines_of(links)[::step]:
        check_machine(inversion, crank, random)


def machines_of(links):
    return [(inversion, crank) for chain in chains(links) for inversion in chain.inversions for crank in inversion.cranks]


@pytest.mark.slow
def test_every_machine_of_eight_links():
    random = np.random.default_rng(8)
    for chain in chains(8):
        for inversion in chain.inversions:
            for crank in inversion.cranks:
                check_machine(inversion, crank, random)


def test_each_crank_of_an_inversion_has_a_class_of_its_own_name():
    inversion = next(each for each in chains(6)[0].inversions if len(each.cranks) > 1)
    assert len({type(inversion.machine(crank)).__name__ for crank in inversion.cranks}) == len(inversion.cranks)


def test_dimensions_are_those_of_a_design():
    """A four-bar of the chain is the shipped one, length by length, or its mirror image where the drawing has it on the other side."""
    known, phi = FourBar(), np.linspace(0.0, 2.0 * np.pi, 13)
    bar = chains(4)[0].inversions[0].machine()
    sense = 1.0 if float(bar.at(phi=0.0)["B"][1]) > 0.0 else -1.0
    bar = bar.replaced(C=(0.1, 0.0), OA=0.04, AB=0.12, BC=0.08, AP=0.07, BAP=sense * known["BAP"])
    wanted = known.at(phi=phi)["P"] * np.array([[1.0], [sense]])
    assert_allclose(bar.at(phi=sense * phi)["P"], wanted, rtol=0, atol=1e-12)


@for_all("links", [3, 5, 14, 6.0, True, "six"])
def test_numbers_of_links_without_chains_are_refused(links):
    with pytest.raises(DefinitionError, match="even number of links"):
        chains(links)


def test_links_that_cannot_drive_or_carry_are_refused():
    inversion = chains(6)[0].inversions[0]
    for crank in (inversion.frame, "2"):
        with pytest.raises(DefinitionError, match="a link on the frame is expected"):
            inversion.machine(crank=crank)
    for coupler in (inversion.cranks[0], "5"):
        with pytest.raises(DefinitionError, match="a link that is not on the frame is expected"):
            inversion.machine(coupler=coupler)
