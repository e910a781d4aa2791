"""Random machines of eight classes whose own paths are tasks, and evaluators of their own, in complex numbers and plain NumPy."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import pi
from typing import Any

import numpy as np

from linkage import (
    LEFT,
    RIGHT,
    Crank,
    Dimension,
    Dyad,
    FunctionTask,
    Ground,
    Link,
    Mechanism,
    OnLink,
    PathTask,
    Pin,
    PinSlotDyad,
    PoseTask,
    Stroke,
    deg,
    drawn,
    mm,
    synthesise,
    x,
)
from mechanisms.classics.klann import Klann
from mechanisms.classics.slider_crank import SliderCrank
from mechanisms.classics.stephenson_one import StephensonOne
from tests.linkage.synthesis import synthesis_tasks
from tests.linkage.synthesis.synthesis_tasks import Bar

KINDS = ("timed", "untimed", "closed")
POSES = 5001
SMALLEST = 0.05
"""Of the largest length of a machine: paths that are smaller are no tasks."""


class RodPoint(SliderCrank):
    """A slider-crank with a point of its rod."""

    P = OnLink("A", "B", AP=0.070, BAP=30 * deg)


class GlidingBar(Mechanism):
    """The inverted slider-crank whose bar, carried by the crank's pin, glides over a pin of the frame."""

    phi = Stroke(0.0, 2 * pi)
    e = Dimension(0.010, unit="mm")  # the bar passes the pin C at this distance

    O = Ground(0.0, 0.0)
    C = Ground(0.100, 0.0)

    A = Crank(O, OA=0.040, angle=phi)
    R = PinSlotDyad(A, C, AR=0.150, offset=e)
    P = OnLink(A, R, AP=0.080, RAP=20 * deg)


class CrankedWatt(Mechanism):
    """A six-bar of the Watt I kind: coupler ABD and rocker CBE are pinned together and carry the rods DF and EF."""

    phi = Stroke(0.0, 2 * pi)

    O = Ground(0.0, 0.0)
    C = Ground(0.100, 0.0)

    A = Crank(O, OA=0.040, angle=phi)
    B = Dyad(A, C, AB=0.120, CB=0.080, side=LEFT)
    D = OnLink(A, B, AD=0.150, BAD=25 * deg)
    E = OnLink(C, B, CE=0.110, BCE=-20 * deg)
    F = Dyad(D, E, DF=0.080, EF=0.100, side=LEFT)


class TurningTriad(Mechanism):
    """A six-bar of the Stephenson II kind whose crank OAD turns fully; its pins B, F and G are one group of class III."""

    phi = Stroke(0.0, 2 * pi)
    sketch = drawn(phi=60 * deg)

    O = Ground(0.0, 0.0)
    E = Ground(0.200, 0.0)

    A = Crank(O, OA=0.020, angle=phi)
    D = OnLink(O, A, OD=0.025, AOD=70 * deg)
    near_rod = Link("A B", AB=0.115)
    far_rod = Link("D F", DF=0.100)
    floating = Link("B F G", BF=0.060, BG=0.100, FG=0.130)
    rocker = Link("E G", EG=0.110)
    B = Pin(near=(0.124, 0.053))
    F = Pin(near=(0.078, 0.091))
    G = Pin(near=(0.207, 0.110))


class Tailgate(Mechanism):
    """A user's own: cylinder AB turns a lever OBD, which carries the flap DEP through the rocker CE."""

    S = Stroke(0.0, 0.25)

    O = Ground(0.0, 0.0)
    A = Ground(-0.15, -0.45)
    C = Ground(0.12, 0.18)

    B = Dyad(A, O, AB=0.42 + S, OB=0.22, side=RIGHT)
    D = OnLink(O, B, OD=0.45, BOD=40 * deg)
    E = Dyad(D, C, DE=0.20, CE=0.42, side=LEFT)
    P = OnLink(D, E, DP=0.60, EDP=-110 * deg)


# Where their points stand, without the package.


def meeting(P, Q, p, q, side):
    """Return the point at distance p from P and q from Q, to the left (1) or the right (-1) of P -> Q; NaN where there is none."""
    way = Q - P
    far = abs(way)
    part = (p**2 - q**2 + far**2) / (2.0 * far)
    return P + way / far * (part + 1j * side * np.sqrt(p**2 - part**2))


def beside(P, Q, length, turn):
    """Return the point at a distance from P, in the direction of Q turned."""
    return P + (Q - P) / abs(Q - P) * length * np.exp(1j * turn)


def fixed(of, *names):
    """Return fixed points as complex numbers."""
    return [complex(of[f"{name}.x"], of[f"{name}.y"]) for name in names]


def crank_end(of, phi):
    """Return the centre O and the pin A of a crank OA that is measured from the x axis."""
    (O,) = fixed(of, "O")
    return O, O + of["OA"] * np.exp(1j * phi)


def of_bar(of, phi):
    return np.array([1, 1j]) @ synthesis_tasks.places(of, phi)


def of_rod_point(of, phi):
    _, A = crank_end(of, phi)
    origin, along = complex(of["rail.x"], of["rail.y"]), np.exp(1j * of["rail.angle"])
    away = (A - origin) * np.conj(along)
    B = origin + along * (away.real + np.sqrt(of["AB"] ** 2 - away.imag**2))
    return beside(A, B, of["AP"], of["BAP"])


def of_gliding_bar(of, phi):
    (C,), (_, A) = fixed(of, "C"), crank_end(of, phi)
    offset, way = of["e"], C - A
    bar = way / abs(way) * np.exp(-1j * np.arcsin(offset / abs(way)))  # the pin stands at the offset to the left of the bar
    return A + bar * of["AP"] * np.exp(1j * of["RAP"])


def of_watt(of, phi):
    (C,), (_, A) = fixed(of, "C"), crank_end(of, phi)
    B = meeting(A, C, of["AB"], of["CB"], 1)
    D, E = beside(A, B, of["AD"], of["BAD"]), beside(C, B, of["CE"], of["BCE"])
    return meeting(D, E, of["DF"], of["EF"], 1)


def of_stephenson(of, phi):
    (C,), (O, A) = fixed(of, "C"), crank_end(of, phi)
    D = beside(O, A, of["OD"], of["AOD"])
    B = meeting(A, C, of["AB"], of["CB"], 1)
    E = meeting(C, B, of["CE"], of["BE"], -1)
    return meeting(D, E, of["DF"], of["EF"], -1)


def of_klann(of, phi):
    (M, N), (_, A) = fixed(of, "M", "N"), crank_end(of, phi)
    B = meeting(A, M, of["AB"], of["MB"], -1)
    K = beside(A, B, of["AK"], of["BAK"])
    H = meeting(N, K, of["NH"], of["KH"], -1)
    return beside(K, H, of["KF"], of["HKF"])


def of_tailgate(of, S):
    O, A, C = fixed(of, "O", "A", "C")
    B = meeting(A, O, 0.42 + S, of["OB"], -1)
    D = beside(O, B, of["OD"], of["BOD"])
    E = meeting(D, C, of["DE"], of["CE"], 1)
    return beside(D, E, of["DP"], of["EDP"])


def of_triad(of, phi):
    """Return F where the rocker's and the floating link's angles are continued along the turn from where the machine stands first."""
    (E,), dense = fixed(of, "E"), np.linspace(0.0, 2 * pi, POSES)
    first = of.at(phi=0.0, unreachable="nan")
    B, F, G = (complex(*first[name]) for name in "BFG")
    side = np.sign(((F - G) * np.conj(B - G)).imag)
    part = (of["BG"] ** 2 + of["FG"] ** 2 - of["BF"] ** 2) / (2.0 * of["BG"])
    F_in_body = part + 1j * side * np.sqrt(of["FG"] ** 2 - part**2)

    def settled(psi, theta, phi, rounds):
        O, A = crank_end(of, phi)
        D = beside(O, A, of["OD"], of["AOD"])
        for _ in range(rounds):
            rocker, body = of["EG"] * np.exp(1j * psi), np.exp(1j * theta)
            G = E + rocker
            off, by_psi, by_theta = [], [], []
            for place, pin, length in ((of["BG"], A, of["AB"]), (F_in_body, D, of["DF"])):
                way = G + place * body - pin
                off.append((abs(way) ** 2 - length**2) / 2.0)
                by_psi.append((np.conj(way) * 1j * rocker).real)
                by_theta.append((np.conj(way) * 1j * place * body).real)
            det = by_psi[0] * by_theta[1] - by_psi[1] * by_theta[0]
            psi = psi - (off[0] * by_theta[1] - off[1] * by_theta[0]) / det
            theta = theta - (by_psi[0] * off[1] - by_psi[1] * off[0]) / det
        return psi, theta, np.sign(det) * (np.abs(off).max(axis=0) < 1e-12)

    angles, signs = [(np.angle(G - E), np.angle(B - G))], []
    for each in dense:
        *last, sign = settled(*angles[-1], each, 4)
        angles.append(tuple(last))
        signs.append(sign)
    if len({*signs}) > 1 or signs[0] == 0 or np.abs(np.diff(angles[1:], axis=0)).max() > 0.05:
        return np.full(np.shape(phi), np.nan + 0j)
    psi, theta = (np.interp(np.mod(phi, 2 * pi), dense, each) for each in np.transpose(angles[1:]))
    psi, theta, _ = settled(psi, theta, phi, 4)
    return E + of["EG"] * np.exp(1j * psi) + F_in_body * np.exp(1j * theta)


@dataclass(frozen=True)
class Known:
    """A class, the point whose path is a task, what varies between which ends [SI], and where that point stands."""

    kind: type[Mechanism]
    of: str
    box: Mapping[str, tuple[float, float]]
    places: Callable[[Any, Any], Any]

    def stroke(self):
        """Return the stroke's name, and its ends [SI]."""
        ((name, ends),) = self.kind().plan.strokes.items()
        return name, (float(ends.start), float(ends.end))


def lengths(most, *names, least=0.25):
    """Return ranges of lengths, from a share of the largest one to it [m]."""
    return {name: (least * most, most) for name in names}


def about(*names, by):
    """Return ranges of fixed points about the origin [m]."""
    return {f"{name}.{axis}": (-by, by) for name in names for axis in "xy"}


def shares(kind, *names, by=2.0):
    """Return the ranges of a class's own lengths, divided and multiplied by a factor [m]."""
    own = kind().dimensions
    return {name: (own[name] / by, own[name] * by) for name in names}


TURN = (-pi, pi)
CLASSES = {
    "four-bar": Known(
        Bar, "P", lengths(50 * mm, "OA", "AB", "CB", "AP", least=0.1) | {"BAP": TURN} | about("O", "C", by=50 * mm), of_bar
    ),
    "slider-crank": Known(
        RodPoint, "P", {"OA": (10 * mm, 60 * mm), "AB": (50 * mm, 150 * mm), "AP": (10 * mm, 150 * mm), "BAP": TURN}
        | {"rail.x": (-50 * mm, 50 * mm), "rail.y": (-50 * mm, 50 * mm), "rail.angle": (-1.0, 1.0)} | about("O", by=50 * mm), of_rod_point,
    ),
    "inverted slider-crank": Known(
        GlidingBar, "P", {"OA": (10 * mm, 80 * mm), "AP": (10 * mm, 150 * mm), "RAP": TURN, "e": (-8 * mm, 8 * mm)}
        | about("O", "C", by=80 * mm), of_gliding_bar,
    ),
    "Watt": Known(
        CrankedWatt, "F", shares(CrankedWatt, "OA", "AB", "CB", "AD", "CE", "DF", "EF") | {"BAD": (-1.0, 1.0), "BCE": (-1.0, 1.0)}
        | about("O", "C", by=100 * mm), of_watt,
    ),
    "Stephenson": Known(
        StephensonOne, "F", shares(StephensonOne, "OA", "OD", "AB", "CB", "CE", "BE", "DF", "EF") | {"AOD": TURN}
        | about("O", "C", by=80 * mm), of_stephenson,
    ),
    "Klann, of parts": Known(
        Klann, "F", shares(Klann, "OA", "AB", "MB", "AK", "NH", "KH", "KF", by=1.25) | {"BAK": (-0.4, 0.2), "HKF": (-pi, -2.0)}
        | {f"{name}.{axis}": (at - 0.3, at + 0.3) for name, place in (("O", (1.599, 0.75)), ("M", (1.009, 0.574)), ("N", (1.366, 1.366)))
           for axis, at in zip("xy", place, strict=True)}, of_klann,
    ),
    "Stephenson II, of a group": Known(
        TurningTriad, "F", shares(TurningTriad, "OA", "OD", "AB", "DF", "BF", "BG", "FG", "EG", by=1.4) | {"AOD": (0.5, 2.0)}, of_triad
    ),
    "a tailgate of a user's own": Known(
        Tailgate, "P", shares(Tailgate, "OB", "OD", "DE", "CE", "DP", by=1.5) | {"BOD": (0.0, 1.5), "EDP": TURN}
        | {"A.x": (-0.3, 0.0), "A.y": (-0.6, -0.3), "C.x": (0.0, 0.3), "C.y": (0.0, 0.3)}, of_tailgate,
    ),
}  # fmt: skip


@dataclass(frozen=True)
class KnownTask:
    """A machine, the strokes (n,) at which its point stands on a path's points, and how these are timed."""

    known: Known
    machine: Mechanism
    strokes: Any
    path: PathTask
    timed: Any

    @property
    def size(self):
        """How far the path reaches [m]."""
        return float(np.ptp(self.path.points, axis=0).max())

    def found(self, **options):
        """Return what a synthesis finds for the path, in the box of the class, from the class's own machine."""
        return synthesise(self.known.kind(), path=self.path, vary=dict(self.known.box), timed=self.timed, **options)

    def exact(self, found):
        """Return how far the best answer misses that runs over the whole stroke, in parts of the path's size, without the package."""
        missed = [self.missed(each) for each in found.solutions if runs(self.known, each.machine)]
        return min(missed, default=np.inf)

    def missed(self, answer):
        """Return how far an answer is off at its worst point, in parts of the path's size."""
        place = self.known.places(answer.machine, answer.strokes)
        return float(np.hypot(*(np.array([place.real, place.imag]) - self.path.points.T)).max()) / self.size


def known_task(known, kind, seed):
    """Return a random machine of a class that runs over its whole stroke, and points of its own path as a task.

    Closed paths go all the way round; of a machine that does not turn, their points lie at equal steps of a part of the stroke.
    """
    random = np.random.default_rng(seed)
    machine = running_machine(known, random)
    low, high = known.stroke()[1]
    closed, turns = kind == "closed", abs(high - low - 2 * pi) < 1e-9
    count = int(random.integers(16, 25) if closed else random.integers(8, 17))
    along = np.cumsum(random.uniform(0.5, 1.5, count))
    if closed and turns:
        along /= along[-1]
    else:
        first, last = random.uniform(0.0, 0.2), random.uniform(0.6, 1.0)
        along = np.linspace(first, last, count) if closed else np.interp(along, along[[0, -1]], [first, last])
    strokes = low + (high - low) * along
    place = known.places(machine, strokes)
    timed: Any = {"timed": True, "untimed": False, "closed": False if turns else "steps"}[kind]
    at = strokes if timed is True else None
    path = PathTask(np.array([place.real, place.imag]).T, of=known.of, at=at, closed=closed and turns)
    return KnownTask(known, machine, strokes, path, timed)


def running_machine(known, random):
    """Return a machine of a class, of dimensions in its box, that closes all along its stroke and whose path is no mere point."""
    while True:
        machine = known.kind(**{name: random.uniform(*ends) for name, ends in known.box.items()})
        place = along_stroke(known, machine, 721)
        if not np.isfinite(place).all():
            continue
        size = max(np.ptp(place.real), np.ptp(place.imag))
        if size > SMALLEST * max(abs(value) for name, value in machine.dimensions.items() if "." not in name):
            return machine


def along_stroke(known, machine, poses=POSES):
    """Return where a machine's point stands along its stroke, (poses,) complex [m]; NaN where it does not close."""
    with np.errstate(all="ignore"):
        return known.places(machine, np.linspace(*known.stroke()[1], poses))


def runs(known, machine):
    """Return whether a machine closes at 5,001 poses of its stroke, by the evaluator of its own."""
    return bool(np.isfinite(along_stroke(known, machine)).all())


# Machines that cannot run over their whole stroke.


def open_loop(random, frame, crank, coupler, follower, *, scale=1.0):
    """Return lengths of a four-bar loop that does not close where the crank points away from the far pivot."""
    turned = frame * random.uniform(0.8, 1.2) * scale
    rest, share = (frame + turned) * random.uniform(0.8, 0.9), random.uniform(0.4, 0.6)
    return {crank: turned, coupler: rest * share, follower: rest * (1.0 - share)}


def far_apart(frame, crank, coupler, follower):
    """Return by how much the best lengths of a box are too short where the crank points away from the far pivot [m]."""
    return lambda low, high: frame + low[crank] - high[coupler] - high[follower]


@dataclass(frozen=True)
class Stuck:
    """Lengths with which a class does not run, of random numbers; by how much a box of them fails at the best; the points of a body."""

    lengths: Callable[[Any], dict[str, float]]
    short: Callable[[Mapping[str, float], Mapping[str, float]], float]
    body: str


STEPHENSON = float(np.hypot(*(StephensonOne().dimensions[f"C.{axis}"] - StephensonOne().dimensions[f"O.{axis}"] for axis in "xy")))
OM = abs(complex(1.599, 0.75) - complex(1.009, 0.574))
STUCK = {
    "four-bar": Stuck(lambda random: open_loop(random, 0.03, "OA", "AB", "CB"), far_apart(0.03, "OA", "AB", "CB"), "A P"),
    "slider-crank": Stuck(
        lambda random: {"OA": 0.05, "AB": 0.05 * random.uniform(0.7, 0.9)}, lambda low, high: low["OA"] - high["AB"], "A P"
    ),
    "inverted slider-crank": Stuck(
        lambda random: {"OA": 0.1 * random.uniform(0.98, 1.02), "e": 0.02},
        lambda low, high: low["e"] - max(abs(low["OA"] - 0.1), abs(high["OA"] - 0.1)), "A P",
    ),
    "Watt": Stuck(lambda random: open_loop(random, 0.1, "OA", "AB", "CB"), far_apart(0.1, "OA", "AB", "CB"), "D F"),
    "Stephenson": Stuck(lambda random: open_loop(random, STEPHENSON, "OA", "AB", "CB"), far_apart(STEPHENSON, "OA", "AB", "CB"), "D F"),
    "Klann, of parts": Stuck(lambda random: open_loop(random, OM, "OA", "AB", "MB"), far_apart(OM, "OA", "AB", "MB"), "K F"),
    "a tailgate of a user's own": Stuck(
        lambda random: {"OB": random.uniform(0.13, 0.18)}, lambda low, high: 0.67 - abs(complex(0.15, 0.45)) - high["OB"], "D P"
    ),
}  # fmt: skip
"""Classes of which random lengths reach a part of the stroke only, by the triangle's inequality."""


@dataclass(frozen=True)
class StuckTask:
    """A task that a machine does which does not run, how it is timed, the box about that machine, and by how much all of it fails [m]."""

    known: Known
    machine: Mechanism
    task: Any
    timed: Any
    box: Mapping[str, tuple[float, float]]
    short: float

    def found(self, **options):
        """Return what a synthesis finds for the task."""
        return synthesise(self.machine, vary=dict(self.box), timed=self.timed, **self.task, **options)


LEVER = 0.1
"""The length [m] with which an angle of a pose counts."""
ASKED = ("timed", "untimed", "closed", "function", "poses")


def task_without_answer(seed):
    """Return a task of a class, each asked in all ways by turns, which a machine does at some strokes that cannot go on to all others."""
    random, names = np.random.default_rng(seed), [*STUCK]
    name, asked = names[seed % len(names)], ASKED[seed // len(names) % len(ASKED)]
    known, stuck = CLASSES[name], STUCK[name]
    stroke, ends = known.stroke()
    while True:
        own = {each: known.kind()[each] * random.uniform(0.9, 1.1) for each in known.box if "." not in each}
        machine = known.kind(**(own | stuck.lengths(random)))
        reached = np.flatnonzero(np.isfinite(along_stroke(known, machine, 721)))
        if len(reached) > 72:
            break
    box = {each: (value - 0.03 * abs(value), value + 0.03 * abs(value)) for each in own if (value := machine[each])}
    low, high = ({each: end[k] for each, end in box.items()} for k in (0, 1))
    at = np.linspace(*ends, 721)[np.sort(random.choice(reached, 9, replace=False))]
    pose, turns = machine.at(unreachable="nan", **{stroke: at}), abs(ends[1] - ends[0] - 2 * pi) < 1e-9
    task: dict[str, Any]
    if asked == "function":
        task = {"function": FunctionTask(at, pose.x(known.of), of=x(known.of))}
    elif asked == "poses":
        first, second = stuck.body.split()
        task = {"motion": PoseTask(*pose[first], pose.angle(first, second), of=stuck.body, at=at, length=LEVER)}
    else:
        task = {"path": PathTask(pose[known.of].T, of=known.of, at=at if asked == "timed" else None, closed=asked == "closed" and turns)}
    timed = {"untimed": False, "closed": False if turns else "steps"}.get(asked, True)
    return StuckTask(known, machine, task, timed, box, stuck.short(low, high))
