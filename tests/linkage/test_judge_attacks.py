"""The judge under attack: poles, NaN, infinities, lost places, compound measures and batches, against what brute force gives."""

import numpy as np
import pytest

from linkage import Crank, Ground, Mechanism, Over, Stroke, least, most


class Plane(Mechanism):
    """Two free strokes, so that any function of them is one of the box."""

    u, v = Stroke(0.0, 1.0), Stroke(0.0, 1.0)
    O = Ground(0.0, 0.0)
    A = Crank(O, OA=0.5, angle=u)
    B = Crank(A, AB=0.4, angle=v)


# Functions with infinities, NaN and poles.


def drawn(rng):
    """Return a function of the strokes of which a part may be infinite, NaN, or a pole, and these parts' kinds."""
    middle, wide = rng.uniform(0.1, 0.9, 2), rng.uniform(0.05, 0.3)
    kind = str(rng.choice(["plain", "up", "down", "nan", "pole", "pit", "all up", "all down"]))
    a, b, c = rng.uniform(-3.0, 3.0, 3)

    def f(motion):
        u, v = motion.strokes["u"], motion.strokes["v"]
        away = np.hypot(u - middle[0], v - middle[1])
        smooth = np.sin(a * u + b * v + c)
        with np.errstate(all="ignore"):
            other = {"up": np.inf, "down": -np.inf, "nan": np.nan}.get(kind)
            if other is not None:
                return np.where(away < wide, other, smooth)
            if kind.startswith("all"):
                return np.full(smooth.shape, np.inf if kind == "all up" else -np.inf)
            pole = {"pole": 1.0, "pit": -1.0}.get(kind, 0.0)
            return smooth + (pole / np.abs(u - middle[0]) if pole else 0.0)

    return f, kind


def path_through(middle):
    return Over.path(u=[0.0, middle, 1.0], v=[1.0, middle, 0.0])


@pytest.mark.parametrize("seed", range(24))
def test_what_has_no_finite_value_is_never_kept(seed):
    rng = np.random.default_rng(seed)
    functions = [drawn(rng) for _ in range(3)]
    limits = rng.uniform(-2.0, 2.0, 2 * len(functions))
    overs = (None, Over(v=0.4), path_through(0.5), Over.poses(u=np.linspace(0, 1, 41), v=np.linspace(1, 0, 41)))
    for number, over in enumerate(overs):
        questions = [
            question
            for (f, _), low, high in zip(functions, limits[::2], limits[1::2], strict=True)
            for question in (least(f) >= low, most(f) <= high)
        ]
        answers = Plane().answers(questions, over=over)
        t = np.linspace(0.0, 1.0, 641)
        poses = {
            0: lambda: Plane().sweep(u=161, v=161),
            1: lambda: Plane().at(u=t, v=np.full(t.shape, 0.4)),
            2: lambda: Plane().at(u=t, v=1.0 - t),
            3: lambda: Plane().at(u=np.linspace(0, 1, 41), v=np.linspace(1, 0, 41)),
        }[number]()
        for k, ((f, kind), low, high) in enumerate(zip(functions, limits[::2], limits[1::2], strict=True)):
            seen = f(poses)
            over_pole = number != 3
            lawless = np.isnan(seen).any()
            below, above = (np.fmin.reduce(seen, axis=None), np.fmax.reduce(seen, axis=None))
            below = -np.inf if kind == "pit" and over_pole else below
            above = np.inf if kind == "pole" and over_pole else above
            of_least, of_most = answers[2 * k : 2 * k + 2]
            for answer, expected, limit, sense in ((of_least, below, low, 1.0), (of_most, above, high, -1.0)):
                where = f"{kind} seed {seed} over {number}: {answer!r}"
                if np.isinf(expected):
                    assert answer.value == expected, where
                elif not lawless or not np.isnan(expected):
                    assert sense * answer.value <= sense * expected + 1e-9, where
                    assert abs(answer.value - expected) <= 0.03, where
                kept = bool(not lawless and sense * (expected - limit) >= 0.0)
                if np.isinf(expected) or lawless or abs(expected - limit) > 0.03:
                    assert answer.ok is kept, where
