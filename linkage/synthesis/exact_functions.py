"""Freudenstein's equation: the four-bars whose follower answers three to five angles of the crank with given ones, by algebra.

Source: Freudenstein: Approximate synthesis of four-bar linkages, Trans. ASME 77 (1955) 853-861.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..checks import require, require_number
from ..errors import DefinitionError, StudyError, ensure
from ..language import said
from ..numeric.descent import refined
from ..program import FloatArray
from .exact import ComplexArray, CouplerTask, ExactMachine, ExactSynthesis, Pivoted, exact_synthesis, is_without_links, judged_machine
from .tasks import check_radians, table_of

FREE = ("crank", "follower")
REAL = 1e-6
RANK = 1e-13
"""Of the largest singular value of the equations: where the least is less, they are not independent."""
LARGEST = 1e6
"""Links that are so many times longer than the frame are none."""


def freudenstein(pairs: object, *, free: str = "follower", ground: float = 1.0) -> ExactSynthesis:
    """Return all four-bars that turn angles of the crank into angles of the follower: `freudenstein([(0.5, 0.9), (0.9, 1.2), (1.3, 1.6)])`.

    `pairs` (n, 2) are (phi, psi) [rad], three to five of them. Of three, both are measured from the frame O -> C. Of four, the zero of
    one is an unknown too, that of the `free` one, "crank" or "follower"; of five those of both. Stroke phi and output psi of a machine are
    as in the pairs: the frame OC is turned so that phi is the direction of OA, and `psi0` [rad] is where CB stands at psi = 0. `ground`
    is the length of the frame [m].

    At most one machine of three pairs, two of four, three of five. DefinitionError for pairs that cannot be asked, StudyError for those
    of every parallelogram.
    """
    rows = table_of("freudenstein", "pairs", pairs, 2, "pairs (phi, psi)")
    ensure(3 <= len(rows) <= 5, f"freudenstein: {len(rows)} pairs; three to five of them decide a four-bar, more go with synthesise(...).")
    require(free in FREE, "freudenstein(free", free, '"crank" or "follower" is expected')
    require_number("freudenstein(ground", ground, "a length above zero is expected, in m", above=0.0)
    for name, column in zip(("phi", "psi"), rows.T, strict=True):
        check_radians("freudenstein", name, column)
        turned = np.exp(1j * column)
        apart = abs(turned[:, None] - turned[None])[np.triu_indices(len(column), 1)]
        if (apart.min() if name == "phi" else apart.max()) < 1e-9:  # two are one, modulo a turn; of the follower all of them
            raise DefinitionError(f"freudenstein: two values of {name} are the same; give angles that differ.")
    freed = FREE if len(rows) == 5 else (free,) if len(rows) == 4 else ()
    p, s = np.exp(1j * rows.T)
    solved = [(u, v) for u, v in links(p, s, freed) if max(abs(u), abs(v)) < LARGEST]
    found: list[ExactMachine] = []
    for u, v in solved:
        frame = ground * np.exp(-1j * np.angle(u))  # turned so that the crank's angle is phi
        crank, follower = Pivoted(ground * abs(u) * p, 0.0), Pivoted(frame * (1.0 + v * s), complex(frame))
        if not is_without_links(crank, follower, ground):
            first = int(np.argmin(rows[:, 0]))  # where a sweep begins, so that psi has no turn too many
            zero = float(np.angle(follower.places[first] - follower.centre) - rows[first, 1])
            asked = CouplerTask(0.5 * (crank.places + follower.places), given=rows[:, 0], follower_zero=zero)
            found.append(judged_machine(crank, follower, asked, both_drives=False))
    title = said("Four-bars for {count} pairs of angles", count=len(rows))
    return exact_synthesis(title, found, max(len(rows) - 2, len(found)))


# With the frame as 1, crank u p and follower v s, p = exp(i phi), s = exp(i psi), the coupler keeps its length where
#     |1 + v s - u p|^2 = const, so that 2 Re[v (s - s0) - u (p - p0) - w (p s* - p0 s0*)] = 0 with w = u v*,
# linear in the real parts of u, v and w. What is left free is a plane of solutions, or a line; w = u v* picks those in it.


def links(p: ComplexArray, s: ComplexArray, freed: Sequence[str]) -> list[tuple[complex, complex]]:
    """Return crank and follower, in parts of the frame, as complex numbers: real where their zero angle is not free."""
    by = [-(p - p[0]), s - s[0], -(p * s.conj() - p[0] * s[0].conj())]
    rows = np.stack([column for each in by for column in (each[1:].real, -each[1:].imag)], axis=1)  # of the parts of u, v, w
    u, v = "crank" in freed, "follower" in freed
    kept = [0, *([1] if u else []), 2, *([3] if v else []), 4, *([5] if u or v else [])]
    left = len(kept) - len(rows)
    _, sizes, every = np.linalg.svd(rows[:, kept])
    if sizes[-1] < RANK * sizes[0]:
        raise StudyError("freudenstein: phi and psi turn alike, as in every parallelogram; let one of the pairs differ from that.")
    basis = np.zeros((6, left))
    basis[kept] = every[-left:].T
    found = []
    for share in lines_in(basis, u, v):
        U, V, W = (complex(*(basis[k : k + 2] @ share)) for k in (0, 2, 4))
        with np.errstate(all="ignore"):
            size = float(np.real(W / (U * np.conj(V)))) if U and V else 0.0
        exact = exact_links(size * U, size * V, p, s, u, v) if size and np.isfinite(size) else None
        if exact is not None:
            found.append(exact)
    return found


def lines_in(basis: FloatArray, free_u: bool, free_v: bool) -> list[FloatArray]:
    """Return the combinations of the basis (6, 1) or (6, 2) in which w / (u v*) is real, each up to a factor."""
    if basis.shape[1] == 1:
        return [np.ones(1)]
    u, v, w = (basis[k] + 1j * basis[k + 1] for k in (0, 2, 4))
    wanted = w
    for each in (*([u.conj()] if free_u else []), *([v] if free_v else [])):
        wanted = np.polynomial.polynomial.polymul(wanted, each)
    return [np.array([1.0, t]) for t in real_roots(wanted.imag)]


def real_roots(coefficients: FloatArray) -> list[float]:
    """Return the real roots of a polynomial, its lowest coefficient first."""
    size = abs(coefficients).max()
    roots = np.polynomial.polynomial.polyroots(np.trim_zeros(np.where(abs(coefficients) > 1e-14 * size, coefficients, 0.0), "b"))
    return [float(root.real) for root in roots if abs(root.imag) < REAL * max(abs(root), 1.0)]


def exact_links(u: complex, v: complex, p: ComplexArray, s: ComplexArray, free_u: bool, free_v: bool) -> tuple[complex, complex] | None:
    """Return crank and follower made exact by Newton's method; None where they are no solution."""
    own = [0, *([1] if free_u else []), 2, *([3] if free_v else [])]
    state = np.array([u.real, u.imag if free_u else 0.0, v.real, v.imag if free_v else 0.0])

    def step(state: FloatArray) -> FloatArray:
        rod = 1.0 + complex(*state[2:]) * s - complex(*state[:2]) * p
        values = 0.5 * (abs(rod) ** 2)
        by = np.stack([-(rod.conj() * p).real, (rod.conj() * p).imag, (rod.conj() * s).real, -(rod.conj() * s).imag], axis=1)
        change = np.zeros(4)
        change[own] = np.linalg.lstsq((by[1:] - by[0])[:, own], values[0] - values[1:], rcond=None)[0]
        return change

    found = refined(state, step)
    if found is None:
        return None
    state = found
    far: FloatArray = np.abs(1.0 + complex(*state[2:]) * s - complex(*state[:2]) * p)
    exact = np.ptp(far) < 1e-11 * max(far.max(), abs(state).max())
    return (complex(*state[:2]), complex(*state[2:])) if exact else None
