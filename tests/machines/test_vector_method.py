"""The vector method's spelling, without links, is the same machine as the composite one: mobility, bodies, joints, forces, drawing, files."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import Link, Mechanism, driving_force, pin_forces
from linkage.files import load, to_json, to_toml
from linkage.pictures.scene import Scene
from linkage.quantities import Member
from tests.machines.vector_pairs import PAIRS, PAPERS

ALL = PAPERS | PAIRS
both = pytest.mark.parametrize("which", list(ALL))


def motion(cls, count=5):
    """Return a motion inside the strokes, along all of them together."""
    return cls().at(**{name: np.linspace(0.1, 0.9, count) * (s.end - s.start) + s.start for name, s in cls.plan.strokes.items()})


def bodies(cls):
    return {frozenset(body.points) for body in cls().links}


def joints(found):
    """Return every joint of pin forces by where and between what it is, with its force."""
    points = {body.name: frozenset(body.points) for body in found._structure.bodies}
    sides = [(each, each.on, each.by, each.force) for each in found.joints] + [(each, each.by, each.on, -each.force) for each in found.joints]
    return {(each.kind, each.point, points.get(on, on), points.get(by, by)): force for each, on, by, force in sides}


def same_forces(one, other):
    mine, theirs = joints(one), joints(other)
    largest = max(np.abs(force).max() for force in theirs.values())
    assert set(mine) == set(theirs)
    for each, force in theirs.items():
        assert_allclose(mine[each], force, rtol=0, atol=1e-9 * largest)
    for name, drive in other.drives.items():
        assert_allclose(one.drives[name], drive, rtol=1e-9, atol=1e-9 * largest)
    assert set(one.thrusts) == set(other.thrusts)
    for name, thrust in other.thrusts.items():
        assert_allclose(one.thrusts[name], thrust, rtol=0, atol=1e-9 * largest)


def test_there_are_twenty_beside_the_papers():
    assert len(PAIRS) >= 20 and not any(cls.plan.of_kind(Link) for cls, _ in ALL.values())


@both
def test_mobility_and_bodies(which):
    vectors, steps = (cls() for cls in ALL[which])
    assert vectors.mobility == steps.mobility == len(steps.plan.strokes)
    assert vectors.gruebler == steps.gruebler
    assert bodies(type(vectors)) == bodies(type(steps))
    assert {(bar.P, bar.Q) for bar in vectors.plan.cylinders} == {(bar.P, bar.Q) for bar in steps.plan.cylinders}


@both
def test_places_and_ratios(which):
    mine, theirs = (motion(cls) for cls in ALL[which])
    for name in theirs.plan.points:
        assert_allclose(mine[name], theirs[name], rtol=0, atol=1e-12)
        for stroke in theirs.plan.strokes:
            assert_allclose(mine.ratio(name, wrt=stroke), theirs.ratio(name, wrt=stroke), rtol=0, atol=1e-9)


@both
def test_joints_and_their_forces(which):
    one, other = (pin_forces(motion(cls)) for cls in ALL[which])
    same_forces(one, other)
    assert one.residual < 1e-9 and one.gap < 1e-9


@both
def test_the_drawing_has_the_same_rods_and_pins(which):
    one, other = (Scene(motion(cls)) for cls in ALL[which])
    assert set(map(frozenset, one.bodies)) == set(map(frozenset, other.bodies))
    assert {(each.P, each.Q) for each in one.hung} == {(each.P, each.Q) for each in other.hung}
    assert (set(one.pins), set(one.dots), set(one.grounds)) == (set(other.pins), set(other.dots), set(other.grounds))
    assert [(each.P, each.Q) for each in one.sections] == [(each.P, each.Q) for each in other.sections]
    assert one.stays == other.stays == ()


@pytest.mark.parametrize("write", [to_toml, to_json])
@both
def test_a_file_goes_there_and_back(which, write):
    vectors, _ = ALL[which]
    text = write(vectors)
    back = load(text)
    assert write(back) == text
    assert back().mobility == vectors().mobility and bodies(back) == bodies(vectors)
    if which not in PAPERS:
        same_forces(pin_forces(motion(back)), pin_forces(motion(vectors)))


@both
def test_a_written_link_agrees(which):
    """Every body declared once more, as its points: nothing is redundant, nothing changes."""
    vectors, _ = ALL[which]
    own = {name: member.renewed() for name, member in vars(vectors).items() if isinstance(member, Member)}
    links = {f"body{k}": Link(*body.points) for k, body in enumerate(vectors.plan.links[1:]) if not set(body.points) & set(arms(vectors))}
    declared = type(vectors.__name__, (Mechanism,), own | links)
    assert str(declared.plan) != str(vectors.plan)
    found = declared().mobility
    assert found == vectors().mobility
    assert bodies(declared) == bodies(vectors)
    same_forces(pin_forces(motion(declared)), pin_forces(motion(vectors)))


def arms(cls):
    return cls.plan.telescopes


@both
def test_driving_forces(which):
    one, other = (motion(cls) for cls in ALL[which])
    for stroke in other.plan.strokes:
        found = driving_force(other, drive=stroke)
        assert_allclose(driving_force(one, drive=stroke), found, rtol=1e-9, atol=1e-9 * np.abs(found).max())
