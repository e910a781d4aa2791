"""Every plan in every format: imported, assembled, run, and compared pose by pose with an independent solver of its constraints."""

import numpy as np
import pytest

from linkage.sketch import read_sketch
from tests.for_all import for_all
from tests.linkage.sketch import emit
from tests.linkage.sketch.plans import PLANS, solved

POSES = 5
DAILY = {"Rocker", "Pump", "Hatch", "Boom"}
NO_DRAWING = {"Shaper", "Hatch", "Offset", "Runner"}
"""Plans with a slot of a moving link: lines do not say them."""


def told(plan, how, folder):
    """Return a plan as it is read in a format; None where that cannot say it."""
    if how.startswith("dxf"):
        if plan.name in NO_DRAWING:
            return None
        emit.dxf(plan, folder / f"{plan.name}.dxf", how.partition(" ")[2])
        return read_sketch(folder / f"{plan.name}.dxf")
    write, suffix, scale = emit.FORMATS[how]
    text = write(plan)
    if text is None or not suffix:
        return None if text is None else read_sketch(text)
    place = folder / f"{plan.name}{suffix}"
    place.write_text(text, encoding="utf-8")
    return read_sketch(place, scale=scale)


def compare(plan, sketch):
    """Return how many poses of the machine were compared with the independent solver's, and the largest miss over the size."""
    machine = sketch.to_class()()
    (stroke,), unit = machine.strokes.values(), 1e-3 if plan.cylinder else 1.0
    poses = solved(plan.name, POSES)
    motion = machine.at(unreachable="nan", **{stroke.name: np.array([value for value, _ in poses]) * unit})
    worst = 0.0
    for name, drawn in plan.points.items():
        near = min(sketch.points, key=lambda each, drawn=drawn: np.hypot(*(1e3 * np.array(sketch.points[each]) - drawn)))
        expected = np.array([places[name] for _, places in poses]).T
        worst = max(worst, float(np.max(np.abs(1e3 * motion[near] - expected))))
    return len(poses), worst / plan.size


def compare_all(how, folder, names):
    """Compare the plans of some names in a format, and return how many poses were compared."""
    compared = 0
    for plan in PLANS:
        sketch = told(plan, how, folder) if plan.name in names else None
        if sketch is not None:
            count, miss = compare(plan, sketch)
            assert miss < 1e-9, (plan.name, miss)
            compared += count
    return compared


HOW = for_all("how", [*emit.FORMATS, "dxf", "dxf blocks", "dxf layers"])


@HOW
def test_a_machine_comes_in_as_it_was_drawn(how, tmp_path):
    assert compare_all(how, tmp_path, DAILY) > (3 if how == "first" else 5)  # which had no slides


@pytest.mark.slow
@HOW
def test_all_others_come_in_too(how, tmp_path):
    assert compare_all(how, tmp_path, {plan.name for plan in PLANS} - DAILY) > 5 or how == "dyads"


def test_there_are_enough_machines():
    said = [(plan.name, how) for plan in PLANS for how, (write, *_) in emit.FORMATS.items() if write(plan) is not None]
    assert len(PLANS) >= 13 and len(said) >= 80
