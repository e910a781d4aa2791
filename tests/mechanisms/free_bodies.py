"""The statics of the textbook cases by hand: free bodies cut out by pen and ruler, one dense set of equations. Nothing of the package.

Also loop closures by Newton's method and derivatives by extrapolated differences.
"""

import numpy as np

G = 9.80665


class FreeBodies:
    """Bodies, what holds them and what loads them; `solve` gives every unknown by name, `<name>x` and `<name>y` for a pin."""

    def __init__(self):
        self.bodies, self.names, self.columns, self.given = [], [], [], []

    def _known(self, *bodies):
        self.bodies += [body for body in bodies if body != "frame" and body not in self.bodies]

    def _add(self, name, *wrenches):
        self._known(*(body for body, *_ in wrenches))
        self.names.append(name)
        self.columns.append(wrenches)

    def pin(self, name, on, by, at):
        """Add a force on one body from another."""
        for axis, u in (("x", np.array([1.0, 0.0])), ("y", np.array([0.0, 1.0]))):
            self._add(name + axis, (on, at, u, 0.0), (by, at, -u, 0.0))

    def along(self, name, on, by, at, direction):
        """Add a force of known direction on one body from another."""
        u = np.asarray(direction, float) / np.hypot(*direction)
        self._add(name, (on, at, u, 0.0), (by, at, -u, 0.0))

    def across(self, name, on, by, at, direction):
        """Add a normal force, to the left of a line's direction."""
        self.along(name, on, by, at, (-direction[1], direction[0]))

    def torque(self, name, on, by):
        """Add a couple on one body from another."""
        zero = np.zeros(2)
        self._add(name, (on, zero, zero, 1.0), (by, zero, zero, -1.0))

    def thrust(self, name, first, at, second, other):
        """Add a cylinder or rod that pushes two bodies apart."""
        u = (np.asarray(other, float) - at) / np.hypot(*(np.asarray(other, float) - at))
        self._add(name, (first, at, -u, 0.0), (second, other, u, 0.0))

    def load(self, body, at, force, moment=0.0):
        """Add a known force and moment."""
        self._known(body)
        self.given.append((body, at, np.asarray(force, float), moment))

    def _put(self, row, wrench):
        body, at, force, couple = wrench
        if body != "frame":
            k = 3 * self.bodies.index(body)
            row[k : k + 3] += (*force, at[0] * force[1] - at[1] * force[0] + couple)

    def solve(self):
        """Return the unknowns by name; the equations must be as many and be met."""
        A, b = np.zeros((3 * len(self.bodies), len(self.columns))), np.zeros(3 * len(self.bodies))
        for k, wrenches in enumerate(self.columns):
            for wrench in wrenches:
                self._put(A[:, k], wrench)
        for wrench in self.given:
            self._put(b, wrench)
        assert A.shape[0] == A.shape[1]
        return dict(zip(self.names, np.linalg.solve(A, -b), strict=True))


def places(motion, index=()):
    """Return every point's place at one pose of a motion."""
    pick = (slice(None), *np.atleast_1d(index))
    return {name: motion[name][pick if motion[name].ndim > 1 else ...] for name in motion.plan.points}


def closed(residuals, guess):
    """Return where a loop closes, by Newton's method with a difference quotient."""
    x = np.array(guess, float)
    for _ in range(50):
        r, step = np.asarray(residuals(x)), 1e-7
        J = np.array([(np.asarray(residuals(x + d)) - residuals(x - d)) / (2 * step) for d in step * np.eye(len(x))]).T
        x = x - np.linalg.solve(J, r)
    assert np.abs(residuals(x)).max() < 1e-12
    return x


def slope(function, at, h=1e-2):
    """Return a derivative, central differences extrapolated twice."""
    d = [(np.asarray(function(at + s)) - np.asarray(function(at - s))) / (2 * s) for s in (h, h / 2, h / 4)]
    e = [(4 * d[1] - d[0]) / 3, (4 * d[2] - d[1]) / 3]
    return (16 * e[1] - e[0]) / 15
