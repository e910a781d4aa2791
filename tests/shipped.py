"""The shipped machines that laws look at one by one, by the names they are installed under.

Machines at work, which are made of these or of parts, have up to six strokes and tests of their own, `tests/mechanisms/test_at_work.py`:
a law that samples every stroke would take them by the hundred thousand poses. `AT_WORK` are these, for what looks at some designs only.
"""

from importlib.metadata import entry_points

POINTS = {point.name: point for point in entry_points(group="hydrolinkage.machines") if ".at_work" not in point.value}
MACHINES = {name: point.load() for name, point in POINTS.items()}
AT_WORK = {
    f"at_work.{point.name}": point.load() for point in entry_points(group="hydrolinkage.machines") if ".at_work" in point.value
}
