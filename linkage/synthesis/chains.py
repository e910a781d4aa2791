"""Planar kinematic chains of one degree of freedom, their inversions, and machines of them that can be searched over."""

from __future__ import annotations

from collections import Counter
from functools import lru_cache
from itertools import combinations
from math import pi
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from ..assembly import chain_parts
from ..errors import DefinitionError, cited, ensure, is_whole, unwarned
from ..frozen import record
from ..mechanism import Mechanism
from ..mobility import MOST_LINKS, Form, canonical, chain_forms, joint_pairs
from ..motion import Featured
from ..plan import Body
from ..program import FloatArray
from ..quantities import Stroke
from ..shown import Shown

if TYPE_CHECKING:
    import networkx as nx

COUPLER = "P"
JOINTS = tuple(each for each in "ABCDEFGHIJKLMNQRSTUVWXYZ")
"""Names of joints; O is that of the crank on the frame, P the point of the coupler."""
ROMAN = ("I", "II", "III")
SIX = ("Watt", "Stephenson")


def chains(links: int) -> tuple[PlanarChain, ...]:
    """Return the planar kinematic chains of so many links with one degree of freedom and turning pairs only, each once.

    Of four links there is 1, of six 2, of eight 16, of ten 230; `chains(6)[0].inversions[1].machine()` is a machine of one of them.
    Chains with a part that is rigid by itself are none. DefinitionError for a number of links for which there are none.

    Parameters
    ----------
    links : int
        The number of links.

    Returns
    -------
    tuple of PlanarChain
        The chains.

    Raises
    ------
    DefinitionError
        No chains with so many links.
    """
    if not is_whole(links) or not 4 <= links <= MOST_LINKS or links % 2:
        said = f"chains of one degree of freedom have an even number of links, from 4 on; up to {MOST_LINKS} are worked out"
        raise DefinitionError(f"chains({cited(links)}): {said}.")
    found, numbers = [], Counter[tuple[int, ...]]()
    for form in chain_forms(links):
        kinds = assortment(form)
        numbers[kinds] += 1
        found.append(PlanarChain(form, numbers[kinds]))
    return tuple(found)


def assortment(form: Form) -> tuple[int, ...]:
    """Return how many links have two joints, three, and so on."""
    joints = Counter(row.bit_count() for row in form)
    return tuple(joints[number] for number in range(2, max(joints) + 1))


@record
class PlanarChain(Shown):
    """A kinematic chain: its links are numbered from 1, those with the most joints first; `number` counts those of its link assortment."""

    form: Form
    number: int

    @property
    def links(self) -> int:
        """How many links it has."""
        return len(self.form)

    @property
    def assortment(self) -> tuple[int, ...]:
        """How many links have two joints, three, and so on."""
        return assortment(self.form)

    @property
    def joints(self) -> tuple[tuple[int, int], ...]:
        """The pairs of links that are jointed."""
        return tuple((a + 1, b + 1) for a, b in joint_pairs(self.form))

    @property
    def graph(self) -> nx.Graph:
        """The links as nodes and the turning pairs between them as edges, a `networkx.Graph`."""
        import networkx as nx

        return nx.Graph(self.joints, name=self.name)

    @property
    def name(self) -> str:
        """Four-bar, Watt or Stephenson; of more links their number, the link assortment, and its own number among these."""
        if self.links == 4:
            return "four-bar"
        if self.links == 6:
            return SIX[is_stephenson(self.form)]
        return f"{self.links} links {'-'.join(map(str, self.assortment))} no. {self.number}"

    @property
    def inversions(self) -> tuple[Inversion, ...]:
        """The inversions: each link as the frame, of those that are the same by symmetry the first."""
        frames = first_alike(self.form, (), range(self.links))
        if self.links == 6:  # by their usual numbers
            frames = sorted(frames, key=lambda frame: six_bar_number(self.form, frame))
        return tuple(Inversion(self, frame + 1) for frame in frames)

    def __str__(self) -> str:
        return f"{self.name}: {', '.join(f'{a}-{b}' for a, b in self.joints)}"

    __repr__ = __str__


def first_alike(form: Form, marked: tuple[int, ...], among: Any) -> list[int]:
    """Return of some links those that are different where others are marked, of each kind the first."""
    kinds: dict[Form, int] = {}
    for link in among:
        kinds.setdefault(canonical(form, (*marked, link)), link)
    return [*kinds.values()]


def six_bar_number(form: Form, frame: int) -> int:
    """Return which inversion of a six-bar a frame makes, from 0 on, as textbooks count them.

    Source: R. L. Norton, Design of Machinery, chapter 2: Watt II and Stephenson III have a ternary frame, Stephenson I has the one between
    both ternary links.
    """
    if form[frame].bit_count() == 3:
        return 2 if is_stephenson(form) else 1
    ternary = [link for link in range(6) if form[link].bit_count() == 3]
    between = all(form[frame] >> link & 1 for link in ternary)
    return 0 if between or not is_stephenson(form) else 1


def is_stephenson(form: Form) -> bool:
    """Return whether the ternary links of a six-bar are not jointed to one another."""
    one, other = (link for link in range(6) if form[link].bit_count() == 3)
    return not form[one] >> other & 1


@record
class Inversion(Shown):
    """A chain with one of its links as the `frame`."""

    chain: PlanarChain
    frame: int

    @property
    def name(self) -> str:
        """Watt I, Stephenson III; of more links the chain's name and the frame."""
        if self.chain.links == 4:
            return self.chain.name
        if self.chain.links == 6:
            return f"{self.chain.name} {ROMAN[six_bar_number(self.chain.form, self.frame - 1)]}"
        return f"{self.chain.name} frame {self.frame}"

    @property
    def cranks(self) -> tuple[int, ...]:
        """The links on the frame that may drive it, of those that are the same by symmetry the first."""
        form, frame = self.chain.form, self.frame - 1
        return tuple(each + 1 for each in first_alike(form, (frame,), self._on(frame)))

    def has_dyads_only(self, crank: int) -> bool:
        """Return whether dyads place all links that a crank drives; else some are a group of a higher class, found by iteration."""
        form, placed = self.chain.form, {self.frame - 1, crank - 1}
        while True:
            left = [pair for pair in joint_pairs(form) if not placed & {*pair}]
            dyad = next((pair for pair in left if all(placed & {*self._on(link)} for link in pair)), None)
            if dyad is None:
                return len(placed) == self.chain.links
            placed |= {*dyad}

    def _on(self, link: int) -> list[int]:
        """Return the links that are jointed to one, all from 0 on."""
        return [other for other in range(self.chain.links) if self.chain.form[link] >> other & 1]

    @property
    def floating(self) -> list[int]:
        """The links that are not on the frame, from 0 on."""
        return [link for link in range(self.chain.links) if link not in (self.frame - 1, *self._on(self.frame - 1))]

    def machine(self, crank: int | None = None, coupler: int | None = None) -> Mechanism:
        """Return a machine of it: a crank that turns fully, and a point P of a coupler; each of its dimensions may be set, or vary.

        `crank` is the link on the frame that is driven, by default the first of `cranks` from which dyads alone place the others. `coupler`
        is the link that carries P, by default the link farthest from the crank that is not on the frame. The sizes are those of a drawing
        that was looked for at random, with a short crank, and is far from any dead point. DefinitionError for a link that cannot be either.
        """
        form, on_frame = self.chain.form, self._on(self.frame - 1)
        driven = next((each for each in self.cranks if self.has_dyads_only(each)), self.cranks[0]) if crank is None else crank
        known = ", ".join(str(each + 1) for each in on_frame)
        fits = is_whole(driven) and driven - 1 in on_frame
        ensure(fits, f"{self.name}: crank={cited(crank)}: a link on the frame is expected, one of {known}.")
        carrying = farthest(form, driven - 1, self.floating) + 1 if coupler is None else coupler
        if not is_whole(carrying) or carrying - 1 not in self.floating:
            known = ", ".join(str(each + 1) for each in self.floating)
            raise DefinitionError(f"{self.name}: coupler={cited(coupler)}: a link that is not on the frame is expected, one of {known}.")
        return machine_class(self, driven, carrying)()

    def __str__(self) -> str:
        return f"{self.chain}; frame {self.frame}"

    __repr__ = __str__


def farthest(form: Form, start: int, among: list[int]) -> int:
    """Return the link that is most joints away from one, of several the first."""
    import networkx as nx

    away = nx.single_source_shortest_path_length(nx.Graph(joint_pairs(form)), start)
    return max(among, key=away.__getitem__)


# A machine of an inversion: names for its joints, a drawing, a class.

SIZE = 0.4
"""The side of the square in which the joints are drawn [m]."""
DRAWINGS = 512
RADII = (0.12, 0.09, 0.06, 0.04, 0.025, 0.015, 0.01)
"""Lengths of the crank that are tried, in parts of the square's side."""
POSES = 72
REGULAR = 0.25
"""Of the least singular value of a drawing: what must be left of it all the way round."""

Places: TypeAlias = dict[str, tuple[float, float]]


class Joints:
    """The joints of an inversion by name, each the pair of its links: O is the crank's on the frame, A the first of its others.

    `links` are the names of each link's joints, `fixed` those on the frame, `on_crank` those of the crank that move, `moving_links` those
    of the links that are neither. `free` joints are those whose places the other links determine; they come first among all the `names`.
    `distances` are those that the links keep, by the places of their ends among the names: as many as determine the free joints.
    """

    def __init__(self, inversion: Inversion, crank: int) -> None:
        self.inversion, self.crank = inversion, crank
        form, frame, crank = inversion.chain.form, inversion.frame - 1, crank - 1
        letters = iter(JOINTS)
        found: dict[int, list[str]] = {link: [] for link in range(len(form))}
        order = [crank]
        named: set[frozenset[int]] = set()
        for link in order:  # from the crank on, so that a four-bar is O, A, B, C
            for other in sorted((each for each in range(len(form)) if form[link] >> each & 1), key=lambda each: (each != frame, each)):
                if frozenset((link, other)) in named:
                    continue
                named.add(frozenset((link, other)))
                name = "O" if {link, other} == {frame, crank} else next(letters)
                found[link].append(name)
                found[other].append(name)
                order += [other] if other != frame and other not in order else []
        self.links = {link + 1: tuple(each) for link, each in found.items()}
        self.fixed = self.links[inversion.frame]
        self.on_crank = tuple(each for each in self.links[self.crank] if each != "O")
        self.moving_links = {link: each for link, each in self.links.items() if link not in (inversion.frame, self.crank)}
        every = dict.fromkeys(name for each in self.moving_links.values() for name in each)
        self.free = tuple(name for name in every if name not in self.fixed and name not in self.on_crank)
        self.names = (*self.free, *self.fixed, *self.on_crank)
        place = {name: number for number, name in enumerate(self.names)}
        pairs = [(one, other) for each in self.moving_links.values() for k, one in enumerate(each) for other in each[k + 1 :] if k < 2]
        self.distances = tuple((place[one], place[other]) for one, other in pairs)

    def distance_slopes(self, places: FloatArray) -> FloatArray:
        """Return the derivatives of the distances by the free joints at places (..., joints, 2), shape (..., distances, 2 free)."""
        a, b = np.array(self.distances).T
        ways = places[..., a, :] - places[..., b, :]
        ways = ways / np.linalg.norm(ways, axis=-1, keepdims=True)
        found = np.zeros((*places.shape[:-2], len(a), len(self.names), 2))
        rows = np.arange(len(a))
        found[..., rows, a, :] += ways
        found[..., rows, b, :] -= ways
        return found[..., : len(self.free), :].reshape(*places.shape[:-2], len(a), 2 * len(self.free))


def drawing(joints: Joints) -> Places:
    """Return places of all joints [m] from which the crank turns fully, far from any dead point: the best of many at random."""
    names = joints.names
    every = np.random.default_rng(0).uniform(0.0, 1.0, (DRAWINGS, len(names), 2))
    O = names.index("O")
    every -= every[:, [O]]
    turning = [names.index(name) for name in joints.on_crank]
    angles = np.arange(len(turning)) * 2.0 * pi / 3.0
    ways = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    every[:, turning] = 1e-3 * ways
    pairs = [pair for pair in combinations(range(len(names)), 2) if not {*pair} <= {O, *turning}]
    far = np.min([np.linalg.norm(every[:, a] - every[:, b], axis=1) for a, b in pairs], axis=0)
    quality = np.linalg.svd(joints.distance_slopes(every), compute_uv=False)[:, -1] * np.minimum(far, 0.3)
    for number in np.argsort(-quality, kind="stable"):
        for radius in RADII:
            places = np.array(every[number])
            places[turning] = radius * ways
            if turns_fully(joints, places, turning):
                return {name: (SIZE * float(x), SIZE * float(y)) for name, (x, y) in zip(names, np.round(places, 3), strict=True)}
    raise DefinitionError(f"{joints.inversion}: no drawing was found from which link {joints.crank} turns fully.")


def turns_fully(joints: Joints, start: FloatArray, turning: list[int]) -> bool:
    """Return whether the crank turns fully from a drawing (joints, 2), by steps of Newton, and stays far from any dead point."""
    a, b = np.array(joints.distances).T
    lengths, places, free = np.linalg.norm(start[a] - start[b], axis=-1), np.array(start), len(joints.free)
    least = REGULAR * np.linalg.svd(joints.distance_slopes(start), compute_uv=False)[-1]
    for angle in np.linspace(0.0, 2.0 * pi, POSES + 1)[1:]:
        x, y = np.cos(angle), np.sin(angle)
        places[turning] = start[turning] @ np.array([[x, y], [-y, x]])
        for _ in range(8):
            slopes = joints.distance_slopes(places)
            if not np.isfinite(slopes).all() or np.linalg.svd(slopes, compute_uv=False)[-1] < least:
                return False
            off = np.linalg.norm(places[a] - places[b], axis=-1) - lengths
            if np.abs(off).max() < 1e-12:
                break
            places[:free] -= np.linalg.solve(slopes, off).reshape(free, 2)
    return bool(np.abs(places - start).max() < 1e-9)


@lru_cache(maxsize=256)
def machine_class(inversion: Inversion, crank: int, coupler: int) -> type[Mechanism]:
    """Return the class of an inversion with a crank and a point of a coupler: a parts list, drawn at the crank's first angle."""
    joints = Joints(inversion, crank)
    places = drawing(joints)
    one, other, *_ = joints.links[coupler]
    members = chain_parts(
        ("phi", Stroke(0.0, 2.0 * pi)),
        {name: places[name] for name in ("O", *(each for each in joints.fixed if each != "O"))},
        {name: places[name] for name in joints.on_crank},
        {f"link{link}": names for link, names in joints.moving_links.items()},
        {name: places[name] for name in joints.free},
        (COUPLER, (one, other), 0.25 * SIZE, pi / 6),
    )
    moving = ", ".join(" ".join(each) for each in joints.moving_links.values())
    said = f"crank {' '.join(joints.links[crank])} drives the links {moving}"
    doc = f"The {inversion.name}: {said}; {COUPLER} is a point of {' '.join(joints.links[coupler])}."
    own: dict[str, Any] = {"__module__": __name__, "__doc__": doc, "featured": lambda self: Featured("", [COUPLER], coupler=COUPLER)}
    chain = inversion.chain  # the class is `StephensonIII`, `Links8No3Frame2Crank4`; a coupler that is not the usual one behind
    title = {4: "FourBar", 6: inversion.name.replace(" ", "")}.get(chain.links, "")
    title = title or f"Links{chain.links}Kind{''.join(map(str, chain.assortment))}No{chain.number}Frame{inversion.frame}"
    title += f"Crank{crank}" if len(inversion.cranks) > 1 else ""
    title += f"Coupler{coupler}" if coupler - 1 != farthest(chain.form, crank - 1, inversion.floating) else ""
    with unwarned():
        return type(title, (Mechanism,), {**own, **members})


def bodies(inversion: Inversion) -> tuple[Body, ...]:
    """Return the links of an inversion as bodies with the names of their joints, the frame first."""
    joints = Joints(inversion, inversion.cranks[0])
    others = [Body(names) for link, names in joints.links.items() if link != inversion.frame]
    return (Body(joints.fixed, fixed=True), *others)
