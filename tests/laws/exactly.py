"""A program in sixty digits: its operations on mpmath's numbers, at the doubles as they are given."""

import mpmath
import numpy as np

from linkage.program import ancestors

DIGITS = 60
POWER = {
    "add": lambda a, b: a + b,
    "subtract": lambda a, b: a - b,
    "multiply": lambda a, b: a * b,
    "negative": lambda a: -a,
    "divide": lambda a, b: a / b,
    "reciprocal": lambda a: 1 / a,
    "square": lambda a: a * a,
    "sqrt": lambda a: mpmath.sqrt(a) if a >= 0 else mpmath.nan,
    "sin": mpmath.sin,
    "cos": mpmath.cos,
    "tan": mpmath.tan,
    "arctan2": mpmath.atan2,
    "absolute": abs,
    "sign": mpmath.sign,
    "minimum": min,
    "maximum": max,
    "pick": lambda a, b, x, y: x if a <= b else y,
}


def solved(entries):
    """Return the unknowns of a system, its matrix by rows first."""
    n = int((len(entries) * 4 + 1) ** 0.5 - 1) // 2
    matrix = mpmath.matrix(n, n)
    for k, entry in enumerate(entries[: n * n]):
        matrix[k // n, k % n] = entry
    return list(mpmath.lu_solve(matrix, mpmath.matrix(entries[n * n :])))


def exactly(nodes, inputs):
    """Return the values of nodes at one pose, in sixty digits; inputs are doubles or mpmath's numbers. None where one has no value."""
    values = {}
    with mpmath.workdps(DIGITS):
        for node in ancestors(nodes):
            if node.op in ("constant", "input"):
                values[node] = mpmath.mpf(node.value if node.op == "constant" else inputs[node.value])
                continue
            args = [values[arg.origin] for arg in node.args]
            try:
                if node.op == "solve":
                    values[node] = solved(args)
                elif node.op == "component":
                    values[node] = args[0][int(args[1])]
                else:
                    values[node] = POWER[node.op](*args)
            except ZeroDivisionError:
                return None
        found = [values[node.origin] for node in nodes]
        return None if any(mpmath.isnan(each) or mpmath.isinf(each) for each in found) else found


def pins_exactly(plan, inputs):
    """Return the inputs with the pins of groups by Newton's method in sixty digits, from what they are in doubles."""
    found = {name: mpmath.mpf(float(value)) for name, value in inputs.items()}
    with mpmath.workdps(DIGITS):
        for group in plan.groups.values():
            pins = [part for name in group.pins for part in (plan.trace.at(name).x, plan.trace.at(name).y)]
            closure = pins[0].closure
            names = [root.origin.value for root in closure.roots]
            from linkage.program import jacobian

            rows = [entry for row in jacobian(plan.trace.graph, closure) for entry in row]
            for _ in range(60):
                values = exactly([*rows, *closure.residuals], found)
                if values is None:
                    return None
                change = solved(values)
                for name, part in zip(names, change, strict=True):
                    found[name] -= part
                if max(abs(part) for part in change) < mpmath.mpf(10) ** -50:
                    break
            else:
                return None
    return found


def off(found, truth, scale=0.0):
    """Return how far doubles are from the truth, relative to the truth's length or to a size that is larger."""
    with mpmath.workdps(DIGITS):
        size = max(mpmath.sqrt(sum(part * part for part in truth)), mpmath.mpf(scale))
        miss = mpmath.sqrt(sum((mpmath.mpf(float(a)) - b) ** 2 for a, b in zip(np.ravel(found), truth, strict=True)))
        return float(miss / size) if size else float(miss > 0)


def off_by_parts(found, truth, scale):
    """Return the largest error of a component of doubles, relative to its true value or to a size that is larger."""
    return max(off([part], [exact], scale) for part, exact in zip(np.ravel(found), truth, strict=True))
