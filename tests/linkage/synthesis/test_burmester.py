"""Burmester's links of three, four and five poses: theorems of their own, known four-bars found again, and what cannot be asked."""

from functools import cache
from itertools import combinations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import root

from linkage import DefinitionError, Outline, PoseTask, StudyError, burmester, draw, outside
from mechanisms.classics.slider_crank import SliderCrank
from tests.for_all import for_all
from tests.linkage.synthesis.exact_tasks import bar_at, lengths

POSES = [(0.0, 0.0, 0.0), (0.15, 0.05, -0.35), (0.27, 0.02, -0.80), (0.33, -0.10, -1.25)]
BELOW = [(-0.15, -0.45), (0.4, -0.45), (0.4, -0.15), (-0.15, -0.15)]


def random_poses(seed, count):
    """Return poses (count, 3) at random."""
    random = np.random.default_rng(seed)
    return np.concatenate([random.normal(size=(count, 2)), random.uniform(-2.0, 2.0, (count, 1))], axis=1)


def poses_of(bar, phi):
    """Return the poses of a bar's coupler at angles of its crank."""
    A, B, P = bar.places(phi)
    return np.stack([P.real, P.imag, np.angle(B - A)], axis=1)


def runs_through(each, poses):
    """Check that a machine's P and theta take the poses at its strokes, and that it goes from the first to the last."""
    poses = np.asarray(poses)
    motion = each.machine.at(phi=each.strokes)
    assert_allclose(motion["P"], poses[:, :2].T, rtol=0, atol=1e-10)
    assert_allclose(np.exp(1j * motion["theta"]), np.exp(1j * poses[:, 2]), rtol=0, atol=1e-10)
    assert each.machine.sweep(31).reached.all()


def pole(one, other):
    """Return the pole of two poses: the point about which the one turns into the other."""
    a, b, turned = complex(*one[:2]), complex(*other[:2]), np.exp(1j * (other[2] - one[2]))
    return (b - turned * a) / (1.0 - turned)


def test_of_three_poses_each_point_has_its_centre_and_each_centre_its_point():
    found = burmester(random_poses(1, 3))
    assert "each point of the body has a link" in str(found)
    for place in np.random.default_rng(2).normal(size=(20, 2)):
        link = found.link(point=place)
        assert_allclose(np.hypot(*(link.places - link.centre).T), link.length, rtol=1e-12)
        assert_allclose(found.link(centre=link.centre).point, place, rtol=0, atol=1e-9)
        back = found.link(centre=place)
        assert_allclose(np.ptp(np.hypot(*(back.places - place).T)), 0.0, atol=1e-10 * max(back.length, 1.0))
    assert not found.links and not found.solutions


def test_a_point_whose_three_places_lie_on_a_line_slides():
    poses = [(0.0, 0.0, 0.0), (0.1, 0.0, 0.4), (0.25, 0.0, 1.1)]
    found = burmester(poses)
    slider = found.link(point=(0.0, 0.0))
    assert slider.slides and np.isnan(slider.centre).all() and slider.direction == pytest.approx(0.0)
    machine = found.four_bar(found.link(centre=(0.1, -0.3)), slider)
    assert machine.name == "slider_crank"
    if machine.runs:
        runs_through(machine, poses)


@for_all("seed", range(1), slow=range(1, 6))
def test_centre_points_see_opposite_sides_of_the_poles_under_one_angle(seed):
    """Burmester's theorem on the quadrilateral of opposite poles, which knows nothing of the compatibility linkage."""
    poses = random_poses(seed, 4)
    found = burmester(poses)
    a, b, c, d = (pole(poses[j], poses[k]) for j, k in ((0, 1), (1, 2), (2, 3), (3, 0)))
    centres = np.concatenate(found.centre_curve, axis=1)
    m = centres[0] + 1j * centres[1]
    m = m[abs(m) < 20.0]
    assert len(m) > 500
    seen = ((b - m) / (a - m)) / ((c - m) / (d - m))
    near = np.min([abs(m - each) for each in (a, b, c, d)], axis=0)
    assert abs(seen.imag / abs(seen))[near > 1e-2].max() < 1e-6


@for_all("seed", range(1), slow=range(1, 4))
@for_all("which", ["circle_curve", "centre_curve"])
def test_the_curves_are_circular_cubics(seed, which):
    x, y = np.concatenate(getattr(burmester(random_poses(seed, 4)), which), axis=1)
    near = np.hypot(x, y) < 10.0
    x, y = x[near], y[near]
    terms = np.stack([x**3, x**2 * y, x * y**2, y**3, x**2, x * y, y**2, x, y, np.ones_like(x)], axis=1)
    terms /= np.linalg.norm(terms, axis=1, keepdims=True)
    _, size, rows = np.linalg.svd(terms)
    assert size[-1] < 1e-9 * size[0] < 1e-2 * size[-2]
    cubic = rows[-1] / abs(rows[-1][:4]).max()
    assert_allclose([cubic[0], cubic[1]], [cubic[2], cubic[3]], atol=1e-6)


def test_points_of_the_curves_belong_together():
    poses = random_poses(3, 4)
    found = burmester(poses)
    for points, centres in zip(found.circle_curve, found.centre_curve, strict=True):
        z, turned = poses[:, :2] @ np.array([1.0, 1.0j]), np.exp(1j * (poses[:, 2] - poses[0, 2]))
        k, m = points[0] + 1j * points[1], centres[0] + 1j * centres[1]
        far = abs(z[:, None] + turned[:, None] * (k - z[0]) - m)
        near = far.max(axis=0) < 50.0
        assert near.sum() > 200 and np.ptp(far[:, near], axis=0).max() < 1e-10


@for_all("seed", range(1), slow=range(1, 8))
def test_a_bars_own_pivots_lie_on_the_curve_of_four_of_its_poses(seed):
    bar, phi = bar_at(seed, 4)
    found = burmester(poses_of(bar, phi))
    one, other = found.link(centre=(0.0, 0.0)), found.link(centre=(1.0, 0.0))
    assert_allclose([one.centre, other.centre], [(0, 0), (1, 0)], rtol=0, atol=1e-9)
    assert_allclose([one.length, other.length], [bar.a, bar.c], rtol=1e-8)
    machine = found.four_bar(one, other)
    assert sorted(lengths(machine.machine)) == pytest.approx(sorted([bar.a, bar.b, bar.c]))


@cache
def over_region():
    return burmester(POSES, BELOW)


@pytest.mark.slow
def test_pivots_are_picked_in_the_region_and_their_machines_run():
    found = over_region()
    low, high = np.min(BELOW, axis=0), np.max(BELOW, axis=0)
    turning = [link for link in found.links if not link.slides]
    assert len(turning) > 15 and all((low <= link.centre).all() and (link.centre <= high).all() for link in turning)
    assert len(found.solutions) > 20 and len(found.solutions) + len(found.misses) >= 250
    for each in found.solutions[:8]:
        runs_through(each, POSES)
    angles = [each.transmission for each in found.solutions]
    assert angles == sorted(angles, reverse=True)
    motion = found.machine.sweep(2001)
    dips = motion.transmission_angle("B")
    assert np.min(np.minimum(dips, np.pi - dips)) == pytest.approx(found.best.transmission, abs=1e-5)
    in_any = burmester(POSES, BELOW, in_order=False)
    assert len(in_any.solutions) >= len(found.solutions)


@for_all("seed", range(1), slow=range(1, 10))
def test_the_slider_of_four_poses_runs_on_a_line(seed):
    found = burmester(random_poses(seed, 4))
    (slider,) = [link for link in found.links if link.slides]
    x, y = slider.places.T
    across = y * np.cos(slider.direction) - x * np.sin(slider.direction)
    assert np.ptp(across) < 1e-9 * max(np.ptp(x), np.ptp(y))
    for each in [each for each in found.solutions if each.name == "slider_crank"][:1]:
        runs_through(each, random_poses(seed, 4))


@for_all("seed", range(1), slow=range(1, 12))
def test_five_poses_have_no_two_or_four_links(seed):
    poses = random_poses(seed, 5)
    links = burmester(poses).links
    assert len(links) in (0, 2, 4)
    for link in links:
        assert np.ptp(np.hypot(*(link.places - link.centre).T)) < 1e-12 * max(link.length, 1.0) * 10
    for link, left in [(link, left) for link in links[:1] for left in (0, 3)]:  # on the curve of any four of the poses
        four = [k for k in range(5) if k != left]
        near = burmester(poses[four]).link(centre=link.centre)
        assert_allclose(near.centre, link.centre, rtol=0, atol=1e-6 * max(abs(link.centre).max(), 1.0))


@for_all("seed", range(1), slow=range(1, 10))
def test_a_bar_is_found_from_five_poses_of_its_coupler(seed):
    bar, phi = bar_at(seed, 5)
    found = burmester(poses_of(bar, phi), in_order=False)
    own = [each for each in found.synthesis.all if np.allclose(sorted(lengths(each.machine)), sorted([bar.a, bar.b, bar.c]), rtol=1e-7)]
    assert own and own[0].error < 1e-11
    for each in found.solutions:
        runs_through(each, poses_of(bar, phi))


def test_a_slider_crank_is_found_from_five_poses_of_its_coupler():
    machine = SliderCrank()
    pose = machine.at(phi=[0.3, 1.0, 1.9, 2.6, 3.5])
    poses = np.stack([*pose["P"], pose.angle("A", "B")], axis=1)
    found = burmester(poses)
    (slider,) = [link for link in found.links if link.slides]
    assert_allclose(slider.places.T, pose["B"], rtol=0, atol=1e-12)
    assert len(found.links) == 4  # the crank and two more turn
    (own,) = [each for each in found.solutions if each.name == "slider_crank" and abs(each.machine["OA"] - machine["OA"]) < 1e-12]
    assert own.turns_fully and abs(own.machine["AB"] - machine["AB"]) < 1e-12
    runs_through(own, poses)


def test_a_place_on_a_line_slides_in_all_five_poses():
    poses = [(0, 0, 0), (0.1, 0, 0.1), (0.2, 0, 0.4), (0.3, 0, 1.0), (0.4, 0, 1.5)]
    found = burmester(poses)
    assert any(link.slides and abs(link.point).max() < 1e-12 for link in found.links)
    assert all(link.slides or link.length < 1e3 for link in found.links)
    assert len(found.synthesis.all) == 1


@for_all("first", range(1), slow=range(1, 4))
@for_all(("poses", "loops"), [
    ([(0, 0, 0), (0.1, 0.02, 0), (0.2, 0.1, 0), (0.3, 0, 1.2)], 1),
    ([(0.1, 0, 0.2), (0.1, 0, 0.4), (0.1, 0, 0.7), (0.3, 0, 1.2)], 2),
], ids=["parallel", "one pole"])  # fmt: skip
def test_three_of_four_poses_that_are_parallel_or_share_a_pole(poses, loops, first):
    """Their curves come apart: of parallel poses all links are as long as the radius of the circle through their three places."""
    poses = np.roll(poses, first, axis=0)
    found = burmester(poses, in_order=False)
    assert len(found.centre_curve) == loops and len(found.links) > 10
    body = poses[:, :2] @ np.array([1.0, 1.0j]), np.exp(1j * (poses[:, 2] - poses[0, 2]))
    for link in found.links:
        places = body[0] + body[1] * (complex(*link.point) - body[0][0])
        far = abs(places - complex(*link.centre)) if not link.slides else np.ones(1)
        assert np.ptp(far) < 1e-9 * max(far.max(), 1.0)
        if loops == 1 and not link.slides:
            a, b, c = (abs(one - other) for one, other in combinations([0.0, 0.1 + 0.02j, 0.2 + 0.1j], 2))
            half = 0.5 * (a + b + c)
            assert_allclose(link.length, a * b * c / (4.0 * np.sqrt(half * (half - a) * (half - b) * (half - c))), rtol=1e-9)


def test_a_region_without_end_is_looked_at_about_the_poses():
    found = burmester(POSES[:3], outside(Outline.circle((0.1, -0.25), 0.12)))
    far = np.array([np.hypot(*(link.centre - [0.1, -0.25])) for link in found.links])
    assert len(far) > 10 and far.min() >= 0.12 and far.max() < 2.0


def test_no_link_of_five_poses_is_missed_that_a_search_finds():
    poses = next(each for each in (random_poses(seed, 5) for seed in range(99)) if len(burmester(each).links) == 4)
    z, turned = poses[:, :2] @ np.array([1.0, 1.0j]), np.exp(1j * poses[:, 2])
    known = np.array([complex(*link.centre) for link in burmester(poses).links])
    random, hits = np.random.default_rng(4), set()
    for _ in range(80):
        end = root(lambda s: np.diff(abs(z + turned * complex(*s[:2]) - complex(*s[2:])) ** 2), random.normal(size=4) * 2.0)
        if np.abs(end.fun).max() < 1e-11 and np.abs(end.x).max() < 1e3:
            off = abs(known - complex(*end.x[2:]))
            assert off.min() < 1e-6 * max(abs(end.x).max(), 1.0)
            hits.add(int(off.argmin()))
    assert len(hits) > 1


@pytest.mark.slow
def test_a_region_is_that_of_a_search():
    """A wheel is left out of it, as in `regions=` of a search."""
    wheel = Outline.circle((0.1, -0.25), 0.12)
    found = burmester(POSES, [BELOW, outside(wheel)])
    far = np.array([np.hypot(*(link.centre - [0.1, -0.25])) for link in found.links if not link.slides])
    assert len(far) > 10 and far.min() >= 0.12
    assert draw(found).axes


def test_poses_may_be_a_task():
    x, y, angle = np.transpose(POSES)
    one, other = burmester(PoseTask(x, y, angle, of="A B"), BELOW), over_region()
    assert len(one.solutions) == len(other.solutions)
    assert "4 poses" in str(one) and "links" in repr(one)
    assert one.best is one.solutions[0] and one.machine is one.machines[0] is one.best.machine


def test_without_a_region_three_poses_say_how_machines_are_found():
    with pytest.raises(StudyError, match="say region= for machines"):
        burmester(random_poses(3, 3)).machine  # noqa: B018


def test_the_picture_has_both_curves_the_poses_and_the_region():
    found = over_region()
    (ax,) = draw(found).axes
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["region of the fixed pivots", "circle points", "centre points"]
    assert [text.get_text() for text in ax.texts] == ["1", "2", "3", "4"]
    curve = max((line.get_xydata() for line in ax.lines), key=len)
    assert len(curve) >= len(found.circle_curve[0].T)
    for count in (3, 5):
        assert draw(burmester(random_poses(3, count))).axes
    with pytest.raises(DefinitionError, match="drawn by itself"):
        draw(found, at=0.1)


@for_all(
    ("poses", "region", "message"),
    [
        (POSES[:2], None, "three to five"),
        ([*POSES[:3], POSES[0]], None, "poses 1 and 4 are the same"),
        ([*POSES[:3], np.add(POSES[0], 1e-13)], None, "poses 1 and 4 are the same"),
        ([(0, 0, 0), (1, 0, 0), (0, 1, 0)], None, "do not turn"),
        (POSES, [(0, 0), (1, 1)], "burmester.region="),
        ([(0, 0), (1, 1), (2, 0)], None, "finite rows .x, y, angle."),
        ([(0, 0, 0), (0.1, 0.05, 20), (0.2, 0.02, 45)], None, "20 is an angle in radians, 3.18 turns; write 20 . deg"),
        ([(0.1, 0, 0), (0, 0.1, np.pi / 2), (-0.1, 0, np.pi)], None, "turn about one place, .-?0 mm, -?0 mm.: a pin there"),
    ],
)
def test_poses_that_cannot_be_asked(poses, region, message):
    with pytest.raises(DefinitionError, match=message):
        burmester(poses, region)


def test_links_that_cannot_be_asked():
    found = over_region()
    with pytest.raises(DefinitionError, match="say a circle point"):
        found.link()
    with pytest.raises(DefinitionError, match="x and y"):
        found.link(point=(0.1,))
    with pytest.raises(DefinitionError, match="share a pin"):
        found.four_bar(found.links[0], found.links[0])
    (slider,) = [link for link in found.links if link.slides]
    with pytest.raises(DefinitionError, match="two sliders"):
        found.four_bar(slider, slider)
    none = next(each for each in (burmester(random_poses(seed, 5)) for seed in range(99)) if not each.links)
    with pytest.raises(StudyError, match="have no link"):
        none.link(centre=(0, 0))
    assert all(abs(a.centre - b.centre).max() > 1e-6 for a, b in combinations(found.links[:-1], 2))
