"""What a file outside of the packages brings without being installed: a kind of file, a language, a back end, a member with a verdict."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from docs.extending.formats import Lua
from docs.extending.headroom import Headroom
from linkage import RIGHT, Dyad, Ground, LinkageError, Mechanism, OnLink, Stroke, export, ratio
from linkage.exports import Exporter
from linkage.program import ARRAYS


class Gcode(Exporter):
    """The path of a point as straight moves, in mm."""

    suffix, help = ".nc", "moves of a machine tool"

    def content(self, job):
        x, y = np.reshape(job.motion["G"], (2, -1)) * 1e3
        return "".join(f"G1 X{a:.3f} Y{b:.3f}\n" for a, b in zip(x, y, strict=True)).encode()


class Eager:
    """A back end that works the nodes out one by one."""

    def __init__(self, plan):
        self.plan = plan

    def turns(self, m, n):
        return False

    def run(self, design, poses, values, guards):
        found = {node: np.reshape(value, (-1, 1)) for node, value in zip(self.plan.design_inputs, design, strict=True)}
        found |= {node: np.atleast_2d(value) for node, value in zip(self.plan.pose_inputs, poses, strict=True)}
        for node in (*self.plan.design, *self.plan.pose):
            found[node] = ARRAYS[node.op](*(arg.origin.value if arg.origin.op == "constant" else found[arg.origin] for arg in node.args))
        for row, node in zip(values, self.plan.outputs, strict=True):
            row[:] = found.get(node, node.value)
        for place, node in enumerate(self.plan.guards):
            guards[place] = np.min(found[node])


class Lever(Mechanism):
    S = Stroke(0.0, 0.2)
    O, A = Ground(0, 0), Ground(0.5, -0.5)
    B = Dyad(A, O, AB=0.6 + S, OB=0.6, side=RIGHT)
    G = OnLink(O, B, OG=1.2)
    roof = Headroom("G", height=0.6)


def test_a_kind_of_file_is_given_as_an_object_or_its_class(tmp_path):
    motion = Lever().sweep(4)
    wanted = "".join(f"G1 X{a:.3f} Y{b:.3f}\n" for a, b in (motion["G"] * 1e3).T)
    for format in (Gcode(), Gcode):
        assert export(motion, tmp_path / "f.nc", format=format).read_text() == wanted
    for wrong in (3, object, Lever):
        with pytest.raises(LinkageError, match="xlsx, csv, dxf, svg"):
            export(motion, tmp_path / "f.nc", format=wrong)


def test_a_language_and_a_back_end_are_given_as_objects():
    lever, S = Lever(), np.linspace(0.0, 0.2, 31)
    text = lever.source(["G"], language=Lua())
    assert text.startswith("-- d: ") and lever.source(["G"], language=Lua) == text
    asked = ["G", ratio("G")]
    for found, right in zip(lever.evaluate(asked, S=S, backend=Eager), lever.evaluate(asked, S=S, backend="numpy"), strict=True):
        assert_allclose(found, right, rtol=1e-13, atol=1e-14)
    for wrong in ({"backend": 3}, {"backend": []}):
        with pytest.raises(LinkageError, match='say "numpy", "numba"'):
            lever.evaluate(asked, S=S, **wrong)


def test_a_member_has_a_verdict_of_its_own():
    """By hand: |AB| = 0.8 m at the end, and G is twice as far from O as B."""
    highest = Lever().sweep(2001).y("G").max()
    for height, ok in ((highest - 1e-6, False), (highest + 1e-6, True)):

        class Roofed(Lever):
            roof = Headroom("G", height=float(height))

        (found,) = [each for each in Roofed().verdicts() if each.rule == "headroom"]
        assert found.ok is ok and found.answer.value == pytest.approx(highest, abs=1e-7)
        assert ("lower the pivot" in found) is not ok
