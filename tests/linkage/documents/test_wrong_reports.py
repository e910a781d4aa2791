"""Reports, equations and files of results asked for in a wrong way say what is wrong, whatever is given."""

import random

import numpy as np
import pytest

from linkage import LEFT, Acting, Dyad, Ground, LinkageError, LoadCase, Mechanism, Stroke, Weight, angle, equations, export, report


class Arm(Mechanism):
    """One cylinder and one load."""

    S = Stroke(0.0, 0.1)
    A = Ground(0.0, 0.0)
    B = Ground(0.5, 0.0)
    M = Dyad(A, B, AM=0.4 + S, BM=0.3, side=LEFT)
    tilt = angle(A, M)
    load = Weight(M, 100.0)


ODD = [
    -1, 1.5, "", "x", b"x", [1], [None], {"S": "a"}, {"T": 0.0}, {1: 2}, {"S": None}, {"tilt": [1]}, {"tilt": None}, object(), Arm, np.nan,
    np.array([1.0, 2.0]), (1, 2), lambda motion: 1, 10**4, {1}, float("inf"), 3 + 1j, "a\0b.html", Acting(), LoadCase("c"),
]  # fmt: skip


def filled(**given):
    found = equations(Arm(), **given)
    return str(found), found.latex()


USES = {
    "a machine to equations": equations,
    "start": lambda odd: filled(start=odd),
    "at": lambda odd: filled(at=odd),
    "ratio": lambda odd: filled(ratio=odd),
    "by": lambda odd: filled(ratio="M", wrt=odd),
    "numbers": lambda odd: filled(numbers=odd),
    "values": lambda odd: equations(Arm).values(odd),
    "digits": lambda odd: equations(Arm).values(digits=odd),
    "closed": lambda odd: equations(Arm).closed(odd),
    "most operations": lambda odd: equations(Arm).closed("M", odd),
    "a pose of a sheet": lambda odd: equations(Arm).sheet(odd),
    "a report's file": lambda odd: report(Arm(), odd),
    "a report's count": lambda odd: report(Arm(), "a.md", count=odd),
    "a report's limits": lambda odd: report(Arm(), "a.md", limits=odd),
    "a report's language": lambda odd: report(Arm(), "a.md", language=odd),
    "a report's title block": lambda odd: report(Arm(), "a.md", title_block=odd),
    "a file's name": lambda odd: export(Arm(), odd),
    "a file's columns": lambda odd: export(Arm(), "a.csv", columns=odd),
    "a file's poses": lambda odd: export(Arm(), "a.svg", at=odd),
}


@pytest.mark.parametrize("use", USES)
def test_what_is_wrong_is_said(use, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("linkage.documents.reporting.calculated", this_far)
    for odd in random.Random(use).sample(ODD, 12):
        try:
            USES[use](odd)
        except LinkageError as error:
            assert str(error).strip() and "Traceback" not in str(error)


def this_far(*_):
    """Stand for the calculation of a report, which costs most of it: what is given is checked before."""
    raise LinkageError("this far")
