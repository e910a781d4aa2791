"""The shipped machines that laws look at one by one, by the names they are installed under; a class is read when it is asked for.

Machines at work, which are made of these or of parts, have up to six strokes and tests of their own, `tests/mechanisms/test_at_work.py`:
a law that samples every stroke would take them by the hundred thousand poses. `AT_WORK` are these, for what looks at some designs only.
`DAILY` have every kind of member that any of `MACHINES` has, and the papers' machines are among them, the crane by its skeleton of three
strokes; the others run under `slow`.
"""

from collections.abc import Mapping
from importlib.metadata import entry_points

from tests.for_all import for_all


class Installed(Mapping):
    """Machines by their names, each read from its entry point."""

    def __init__(self, points):
        self.points = points

    def __getitem__(self, name):
        return self.points[name].load()

    def __iter__(self):
        return iter(self.points)

    def __len__(self):
        return len(self.points)


POINTS = {point.name: point for point in entry_points(group="hydrolinkage.machines") if ".at_work" not in point.value}
MACHINES = Installed(POINTS)
AT_WORK = Installed({f"at_work.{point.name}": point for point in entry_points(group="hydrolinkage.machines") if ".at_work" in point.value})
DAILY = (
    "arm_drive", "crane_skeleton", "grapple", "header_balancer", "inverted_slider_crank", "mower_lift", "pantograph",
    "scotch_yoke", "stephenson_three_far", "three_point_hitch", "toggle_press",
)  # fmt: skip
OTHERS = tuple(name for name in MACHINES if name not in DAILY)


def over_machines(more=tuple, among=None, later=tuple):
    """Run a law of a `machine` over `DAILY` and `more()`, the others and `later()` under `slow`; `among` tells which it is about."""

    def chosen(names, others):
        return [machine for machine in (*map(MACHINES.get, names), *others) if among is None or among(machine)]

    return for_all("machine", lambda: chosen(DAILY, more()), slow=lambda: chosen(OTHERS, later()))
