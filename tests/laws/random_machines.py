"""Random machines with loads: drives, dyads, slides, groups and whatever may act between their points, all well away from dead points.

A `Draft` keeps what it drew: which points are rigid with each other, what each load is in plain numbers, which cylinder holds which stroke.
Laws are checked against that, never against what the package makes of the class. `draft.machine(Move(...))` is the same machine seen
in a mirror, turned, or larger.
"""

from collections import Counter
from functools import cache
from itertools import count

import numpy as np

from tests.laws.random_loads import Draft
from tests.laws.sketch import DeadEndError

SHARES = {
    "several strokes": 0.34,
    "group": 0.27,
    "slider": 0.36,
    "gas beside a crank": 0.3,
    "three at a pin": 0.3,
    "two on two points": 0.3,
    "friction": 0.36,
}
TAGS = tuple(SHARES)


def wants(seed):
    """Return which tags a seed is sure to have."""
    shares = np.array([SHARES[tag] for tag in TAGS])
    return {tag for tag, wanted in zip(TAGS, np.random.default_rng([99, seed]).random(len(TAGS)) < shares, strict=True) if wanted}


def drafted(seed, attempt):
    """Return a draft with whatever its seed wants of it."""
    draft = Draft(seed, attempt)
    several, group, slider, gas, three, double, friction = (tag in wants(seed) for tag in TAGS)
    kinds = [draft.crank, draft.cylinder, draft.cylinder, lambda: draft.crank("hold"), draft.guided]
    (lambda: draft.crank("gas"))() if gas else draft.some(kinds)()
    if not draft.bodies():
        draft.rrr((draft.moving[0], draft.fix()))
    if several:
        for _ in range(int(draft.random.integers(1, 3))):
            draft.some([*kinds, draft.telescope])()
    for _ in range(int(draft.random.integers(1, 3))):
        draft.some([draft.rrr, draft.rrr, draft.on_link])()
    if slider:
        draft.some([draft.slider, draft.slider, draft.pin_slot, draft.yoke, draft.cross])()
    if group:
        draft.triad()
    if three:
        busy = [name for name, bodies in draft.joined().items() if bodies > 1 and name in draft.moving]
        roots = (draft.some(busy or draft.moving), draft.pick(1)[0])
        if roots[0] == roots[1] or draft.together(*roots):
            roots = (roots[0], draft.fix())
        draft.rrr(roots)
    for number in range(int(draft.random.integers(2, 5))):
        draft.some([draft.weight, draft.weight, draft.body_mass, draft.force, draft.moment])(number)
    for number in range(int(draft.random.integers(1, 4))):
        draft.element(number)
    if double:
        draft.second(7)
    if friction:
        draft.rub()
    links = Counter(point for body in draft.bodies() for point in body)
    links.update(point for each in draft.holders for point in (each.A, each.B))
    links.update(point for point in draft.at if draft.is_fixed(point))
    if max(links.values()) > 2:
        draft.tags.add("three at a pin")
    pairs = Counter(frozenset((each.A, each.B)) for each in (*draft.elements.values(), *draft.holders))
    if max(pairs.values(), default=0) > 1:
        draft.tags.add("two on two points")
    if len(draft.spans) > 1:
        draft.tags.add("several strokes")
    return draft


@cache
def random_machine(seed):
    """Return a draft that can be driven everywhere, well away from dead points."""
    for attempt in count():
        try:
            draft = drafted(seed, attempt)
        except DeadEndError:
            continue
        for halvings in range(1 if "group" in draft.tags else 3):  # the class of a group takes long to check
            draft.factor = 0.5**halvings
            if draft.is_open():
                return draft
