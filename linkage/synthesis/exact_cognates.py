"""The theorem of Roberts and Chebyshev: the two other four-bars that draw the curve of a coupler's point.

Sources: Roberts: On three-bar motion in plane space, Proc. London Math. Soc. 7 (1875) 14-23; Chebyshev 1878.
"""

from __future__ import annotations

import numpy as np

from ..checks import require_whole
from ..errors import DefinitionError, ensure
from ..mechanism import Mechanism, require_mechanism
from ..mobility import FourBar
from ..motion import Motion
from ..shown import ShownList
from ..study.checks import check_one_design
from .exact import ComplexArray, CouplerTask, ExactMachine, Pivoted, judged_machine
from .tasks import check_point

RIGID = 1e-9
"""Of a coupler's length: a point that moves by less in its axes is one of it."""


def cognates(machine: Mechanism, of: str = "P", *, count: int = 73) -> ShownList[ExactMachine]:
    """Return the two other four-bars whose coupler point goes along the path of a point: `cognates(FourBar(), of="P")`.

    The machine has one stroke and a four-bar on the frame, of any class, whose coupler carries the point; the path is looked at in `count`
    poses of the stroke. The third four-bar's crank turns with the machine's; the second's coupler does, and it is driven at the pivot
    that takes it farthest. `strokes` (count,) are those at which they stand where the machine does, NaN past a dead point, as `why` says.

    Raises DefinitionError for another structure, and for a pin, whose path is an arc.
    """
    require_mechanism(machine)
    check_one_design(machine)
    title = machine.plan.title
    check_point(machine, of)
    require_whole("cognates(count", count, "a whole number of poses is expected, at least 3", least=3)
    ensure(len(machine.strokes) == 1, f"{title}: cognates are those of a machine of one stroke; this one has {len(machine.strokes)}.")
    motion = machine.sweep(count)
    bar, share = carrying(machine, motion, of)
    O, A, B, C = (complex_places(motion, name) for name in bar.pins)
    P, o, c = complex_places(motion, of), complex(O[0]), complex(C[0])
    w = o + share * (c - o)
    second = Pivoted(o + P - A, o), Pivoted(w + share * (B - C), w)
    third = Pivoted(w + (1.0 - share) * (A - O), w), Pivoted(c + P - B, c)
    asked = CouplerTask(P, in_order=False)
    return ShownList([judged_machine(*pins, asked) for pins in (second, third)])


def carrying(machine: Mechanism, motion: Motion, of: str) -> tuple[FourBar, complex]:
    """Return the four-bar whose coupler carries a point, and its place along and across the coupler, of length one."""
    bars = machine.four_bars
    P = complex_places(motion, of)
    for bar in bars:
        A, B = (complex_places(motion, name) for name in bar.pins[1:3])
        share = (P - A) / (B - A)
        if abs(share - share[0]).max() > RIGID * max(abs(share[0]), 1.0):
            continue
        if min(abs(share[0]), abs(share[0] - 1.0)) < RIGID:
            raise DefinitionError(f"{machine.plan.title}: {of} is a pin of the coupler, whose path is an arc; name another point of it.")
        return bar, complex(share.mean())
    found = ", ".join("-".join(bar.pins) for bar in bars) or "none"
    raise DefinitionError(f"{machine.plan.title}: {of} is on no coupler of a four-bar on the frame; its four-bars are: {found}.")


def complex_places(motion: Motion, name: str) -> ComplexArray:
    """Return the places of a point in all poses of a motion (n,), as complex numbers."""
    x, y = np.broadcast_arrays(*motion[name])
    return np.asarray(np.broadcast_to(x + 1j * y, motion.shape))
