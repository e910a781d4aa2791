"""Every reading of a machine that holds something of a user's own, against each other: what is asked of an extension from outside."""

import contextlib
import ctypes
import io
import json
import re
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import Mechanism, draw, drive_force, driving_force, equations, page, pin_forces, ratio, report
from linkage.cli import main
from linkage.files import load, to_toml

DOUBLES = ctypes.POINTER(ctypes.c_double)


@dataclass(frozen=True)
class Case:
    """A machine at some values of its strokes, arrays (n,), and what is asked of it.

    `points` are those whose ratios are looked at, `forces` the requests of forces, `variables` what is differentiated by, `drives` those
    whose force stands in the equations, `kinds` the classes of one's own that a file names.
    """

    design: Mechanism
    strokes: Mapping[str, Any]
    points: Sequence[str]
    forces: Sequence[Any]
    variables: Sequence[str]
    drives: Sequence[str]
    kinds: Sequence[type]

    @cached_property
    def motion(self):
        """The motion at the strokes."""
        return self.design.at(**self.strokes)

    @cached_property
    def requests(self):
        """What kernels and sources work out."""
        wrt = next(iter(self.design.strokes))
        return [*self.points, *(ratio(point, wrt=wrt) for point in self.points), *self.forces]

    def pose(self, k):
        """Return the strokes of one pose."""
        return {name: float(value[k]) for name, value in self.strokes.items()}


def close(found, wanted, bound):
    """Hold values against others, by a bound that is relative to the greatest."""
    assert_allclose(found, wanted, rtol=0.0, atol=bound * max(1.0, float(np.abs(wanted).max())))


def ratios_are_exact(case, folder):
    """Hold first and second ratios against differences."""
    for name in case.points:
        for wrt in case.design.strokes:
            close(case.motion.ratio(name, wrt=wrt), case.motion.ratio(name, wrt=wrt, method="central"), 1e-9)
            second = case.motion.ratio(name, wrt=wrt, order=2)
            close(second, case.motion.ratio(name, wrt=wrt, order=2, method="central"), 1e-6)


def gradients_are_exact(case, folder):
    """Hold gradients by design variables against differences."""
    for name in case.variables:
        value = case.design.dimensions[name]
        step = 1e-6 * max(abs(value), 0.1)
        low, high = (case.design.replaced(**{name: value + k * step}).evaluate(case.requests, **case.strokes) for k in (-1, 1))
        for each, below, above in zip(case.requests, low, high, strict=True):
            (exact,) = case.motion.gradient(each, wrt=[name])
            close(exact * max(abs(value), 0.1), (above - below) / (2.0 * step) * max(abs(value), 0.1), 1e-7)


def kernels_agree(case, folder):
    """Hold many poses in one pass, by every back end, and one pose at a time against the motion."""
    wanted = [case.motion[each] for each in case.requests]
    for backend in ("numpy", "floats"):
        for ours, theirs in zip(case.design.evaluate(case.requests, backend=backend, **case.strokes), wanted, strict=True):
            close(ours, theirs, 1e-12)
    one = case.design.function(case.requests)(*case.pose(1).values())
    for ours, theirs in zip(one, np.concatenate([np.reshape(each[..., 1], -1) for each in wanted]), strict=True):
        close(ours, theirs, 1e-12)


def numba_says_the_same(case, folder):
    """Hold the one loop that is compiled against the motion."""
    for ours, each in zip(case.design.evaluate(case.requests, backend="numba", **case.strokes), case.requests, strict=True):
        close(ours, case.motion[each], 1e-12)


def stated(text):
    """Return the design that the first comment of a source states."""
    line = text[text.index("/* d: ") + 6 : text.index("*/")].partition("; ")[0]
    return [float(each.rpartition(" = ")[2]) for each in line.split(", ")]


def c_says_the_same(case, folder):
    """Hold the text in C against the values, where there is a compiler."""
    if shutil.which("gcc") is None:
        return
    wanted = np.vstack([np.atleast_2d(each) for each in case.design.evaluate(case.requests, **case.strokes)])
    text = case.design.source(case.requests)
    (folder / "poses.c").write_text(text, encoding="utf-8")
    subprocess.run(["gcc", "-O0", "-shared", "-fPIC", "-o", folder / "poses.so", folder / "poses.c", "-lm"], check=True)
    rows = [np.ascontiguousarray(case.strokes[name], float) for name in case.design.strokes]
    out, given = np.empty_like(wanted), np.array(stated(text))
    pointers = [(DOUBLES * len(each))(*(row.ctypes.data_as(DOUBLES) for row in each)) for each in (rows, out)]
    ctypes.CDLL(str(folder / "poses.so")).poses(ctypes.c_long(wanted.shape[1]), given.ctypes.data_as(DOUBLES), *pointers)
    for ours, theirs in zip(out, wanted, strict=True):
        close(ours, theirs, 1e-11)


def javascript_says_the_same(case, folder):
    """Hold the text in JavaScript against the values, where there is a Node."""
    if shutil.which("node") is None:
        return
    text = case.design.source(case.requests, language="javascript", name="pose")
    call = f"{text}console.log(JSON.stringify(pose({stated(text)}, {list(case.pose(1).values())})))"
    said = json.loads(subprocess.run(["node", "-e", call], check=True, capture_output=True).stdout)
    assert_allclose(said, case.design.function(case.requests)(*case.pose(1).values()), rtol=1e-9, atol=1e-9)


def equations_say_the_same(case, folder):
    """Hold places, ratios and driving forces of the written equations against the motion's, and fill numbers in."""
    stroke, pose = next(iter(case.design.strokes)), case.pose(1)
    written = equations(case.design, ratio=case.points, wrt=stroke, forces=bool(case.drives))
    values, motion = written.values(pose), case.design.at(**pose)
    for name in case.points:
        assert_allclose(values[name], motion[name], rtol=1e-12, atol=1e-13)
        assert_allclose(values[f"d{name}/d{stroke}"], motion.ratio(name, wrt=stroke), rtol=1e-11, atol=1e-12)
    for drive in case.drives:
        assert_allclose(values[f"Q_{drive}"], driving_force(motion, drive=drive), rtol=1e-10)
    assert written.latex()
    filled = str(equations(case.design, numbers=True, at=pose, forces=bool(case.drives)))
    assert "nan" not in filled


def forces_balance(case, folder):
    """Hold the equilibrium of every body against virtual work."""
    forces = pin_forces(case.motion)
    assert forces.residual < 1e-11
    assert forces.gap < 1e-11
    for drive in case.design.strokes:
        close(forces.drives[drive], driving_force(case.motion, drive=drive), 1e-10)
        (asked,) = case.design.evaluate([drive_force(drive)], **case.strokes)
        close(asked, forces.drives[drive], 1e-10)
    assert str(forces)


def pictures_show_it(case, folder):
    """Draw it with its forces."""
    draw(case.design, forces=True).savefig(folder / "picture.png")


def a_page_is_written(case, folder):
    """Write its live page."""
    assert "<script" in page(case.design, folder / "page.html").read_text(encoding="utf-8")


def a_report_is_written(case, folder):
    """Write its report with few rows."""
    text = report(case.design, folder / "report.md", count=3).read_text(encoding="utf-8")
    assert type(case.design).__name__ in text
    assert re.search(r"against virtual work|virtual work", text)


def a_file_brings_it_back(case, folder):
    """Write it as a file and read that, from Python and from the command line."""
    text = to_toml(case.design)
    for kind in case.kinds:
        assert f'kind = "{kind.__module__}:{kind.__name__}"' in text
    again = load(text)()
    for each in case.requests:
        assert np.array_equal(again.at(**case.strokes)[each], case.motion[each])
    assert to_toml(again) == text
    path = folder / "machine.toml"
    path.write_text(text, encoding="utf-8")
    with contextlib.redirect_stdout(io.StringIO()) as said:
        assert main(["forces", str(path)]) == 0
    assert re.search(r"\d", said.getvalue())


def a_variant_follows(case, folder):
    """Hold a subclass against a design of its base."""
    kind = type(case.design)
    variant = type("Variant", (kind,), {"__doc__": "A variant."})(**case.design.dimensions)
    for each in case.requests:
        assert np.array_equal(variant.at(**case.strokes)[each], case.motion[each])
    name = case.variables[0]
    other = {name: 1.1 * case.design.dimensions[name]}
    values, others = (
        np.vstack([*map(np.atleast_2d, each.evaluate(case.requests, **case.strokes))]) for each in (variant, variant.replaced(**other))
    )
    assert not np.allclose(values, others)


ALL = (
    ratios_are_exact, gradients_are_exact, kernels_agree, numba_says_the_same, c_says_the_same, javascript_says_the_same,
    equations_say_the_same, forces_balance, pictures_show_it, a_page_is_written, a_report_is_written, a_file_brings_it_back,
    a_variant_follows,
)  # fmt: skip
DOCUMENTS = (pictures_show_it, a_page_is_written, a_report_is_written)


def marked(*slow):
    """Return all readings, some of them under `slow`."""
    return [pytest.param(each, id=each.__name__, marks=[pytest.mark.slow] if each in slow else []) for each in ALL]


READINGS = marked(numba_says_the_same)  # it compiles
OF_NUMBERS = marked(numba_says_the_same, *DOCUMENTS)
"""Those of every day for what documents show as they show others."""
