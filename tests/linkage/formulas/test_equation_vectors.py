"""Steps of one's own whose rules put vectors together from numbers: their equations say what the rules do."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from linkage import LEFT, Dimension, Dyad, Ground, Mechanism, OnLink, Stroke, driving_force, equations
from linkage.documents.html import html_text
from linkage.documents.reporting import report_document
from linkage.loads import Weight
from linkage.quantities import label, quantity, source_text
from linkage.steps import Point
from linkage.vectors import Line, Vec
from tests.for_all import for_all

RULES = {
    "place + vector": lambda P, Q, d: P + Vec(0.1, 0.2),
    "vector + place": lambda P, Q, d: Vec(0.1, 0.2) + P,
    "place - vector": lambda P, Q, d: P - Vec(d, 0.2),
    "vector - place": lambda P, Q, d: -(Vec(0.1, 0.2) - P),
    "components": lambda P, Q, d: Vec(P.x + 0.1, Q.y + d),
    "scaled": lambda P, Q, d: P + Vec(0.1, 0.2) * d,
    "turned": lambda P, Q, d: P + Vec(d, 0.2).turned(0.6, 0.8),
    "left": lambda P, Q, d: P + (Q - P).left() * 0.5 + Vec(0.1, 0.3).left(),
    "place dot vector": lambda P, Q, d: P + Vec(0.1, 0.1) * (Q - P).dot(Vec(1.0, d)),
    "vector dot place": lambda P, Q, d: P + Vec(0.1, 0.1) * Vec(1.0, d).dot(Q - P),
    "place cross vector": lambda P, Q, d: P + Vec(0.1, 0.1) * (Q - P).cross(Vec(1.0, d)),
    "vector cross place": lambda P, Q, d: P + Vec(0.1, 0.1) * Vec(1.0, d).cross(Q - P),
    "length": lambda P, Q, d: P + Vec(0.1, 0.3) * (Q - P - Vec(0.1, 0.1)).length(),
    "length of a vector": lambda P, Q, d: P + Vec(0.1, 0.3) * Vec(Q.x, d).length(),
    "square": lambda P, Q, d: P + Vec(0.1, 0.3) * (Q + Vec(0.1, 0.1) - P).square(),
    "middle": lambda P, Q, d: (P + Q) * 0.5,
    "less a sum": lambda P, Q, d: Q - (P + Q) * d,
    "part of a sum": lambda P, Q, d: (P + Q) * (1.0 / (1.0 + d)),
    "minus a sum": lambda P, Q, d: -(P + Q) * 1.0,
    "line": lambda P, Q, d: Line(P, Vec(0.6, 0.8)).at(d),
    "a line elsewhere": lambda P, Q, d: Line(Vec(0.1, 0.2), Vec(0.6, 0.8)).at(Q.x),
}


class Beside(Point):
    """A point beside P and Q by one of the rules."""

    expects = (("P", "point"), ("Q", "point"))

    def __init__(self, P, Q, d, rule):
        self.P, self.Q, self.d, self.rule = P, Q, quantity(d), rule

    def parts(self):
        return self.P, self.Q, self.d

    def place(self, where):
        return RULES[self.rule](where.at(self.P), where.at(self.Q), where.value(self.d))

    def __str__(self):
        return f"Beside({label(self.P)}, {label(self.Q)}, {source_text(self.d)}, {self.rule!r})"


class Lever(Mechanism):
    """A lever OBC on a driven length AB."""

    S, d = Stroke(0.0, 0.2), Dimension(0.37)
    A, O = Ground(0.0, 0.0), Ground(0.1, 0.6)
    B = Dyad(A, O, AB=0.45 + S, OB=0.3, side=LEFT)
    C = OnLink(O, B, OC=0.9)


def machine_with(rule):
    """Return a lever with a weight on a point placed by a rule."""
    return type("Own", (Lever,), {"X": Beside("C", "B", "d", rule), "load": Weight("X", mass=10.0)})()


@for_all("rule", [*RULES][::2], slow=[*RULES][1::2])
def test_equations_are_the_rule(rule):
    machine, S = machine_with(rule), np.array([0.03, 0.11, 0.19])
    motion = machine.at(S=S)
    found = equations(machine, forces=True).values(dict(S=S))
    assert_allclose(found["X"], motion["X"], rtol=1e-12)
    assert_allclose(found["Q_S"], driving_force(motion), rtol=1e-9)
    exact = equations(machine).values(dict(S=0.03), digits=30)
    assert_allclose([float(each) for each in exact["X"]], motion["X"][:, 0], rtol=1e-13)
    rates = equations(machine, ratio="X").values(dict(S=S))
    assert_allclose(rates["dX/dS"], motion.ratio("X"), rtol=1e-10, atol=1e-12)


@pytest.mark.slow
@for_all("rule", [*RULES][1::2], slow=[*RULES][::2])
def test_equations_are_printed(rule):
    machine = machine_with(rule)
    found = equations(machine, numbers=True)
    assert "X = " in str(found)
    assert found.latex().count("begin{align}") == found.latex().count("end{align}")


@for_all("rule", (), slow=["components", "place + vector", "length"])
def test_a_report_has_them(rule):
    assert html_text(report_document(machine_with(rule), count=3))


def test_what_is_said_of_a_vector_of_numbers():
    assert "X = C + (0.1, 0.2)" in str(equations(machine_with("place + vector")))
    assert "X = C - (d, 0.2)" in str(equations(machine_with("place - vector")))


def test_a_sum_that_is_scaled_is_in_brackets():
    printed = {
        "middle": ("X = 0.5*(C + B)", r"0.5 \left(\vec{C} + \vec{B}\right)"),
        "less a sum": ("X = B - d*(B + C)", r"\vec{B} - d \left(\vec{B} + \vec{C}\right)"),
        "part of a sum": ("X = (C + B)/(d + 1)", r"\frac{1}{d + 1} \left(\vec{C} + \vec{B}\right)"),
        "minus a sum": ("X = -(B + C)", r"- \left(\vec{B} + \vec{C}\right)"),
    }
    for rule, (text, formula) in printed.items():
        found = equations(machine_with(rule))
        assert text in str(found) and formula in found.latex(), rule
