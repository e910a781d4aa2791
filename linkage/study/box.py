"""A box of settings: ranges of dimensions, and places to choose from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import product
from typing import Any, TypeGuard

import numpy as np

from ..errors import cited, ensure, is_listed, one_word, require, require_whole, unfit, unknown
from ..frozen import immutable
from ..mechanism import Mechanism, require_mechanism
from ..plan import Plan
from ..quantities import is_number
from ..units import amount_or_float, show, shown_number, unit_sign
from ..vectors import FloatArray, Index
from .checks import unit_of
from .designs import DesignValues, check_once


@immutable
class Box:
    """Settings to look at: ranges of values, times choices.

    Parameters
    ----------
    ranges : mapping of str to tuple of float
        From low to high [SI] by name.
    choices : sequence of mapping, optional
        Each a mapping of names to values; one without names by default.
    """

    ranges: Mapping[str, tuple[float, float]]
    choices: Sequence[Mapping[str, Any]] = ({},)

    @classmethod
    def of(cls, machine: Mechanism, vary: Mapping[str, Any]) -> Box:
        """Return the box that `dict(MK=(0.80, 0.96), M=[(0.22, 1.05), (0.22, 0.95)])` means.

        Parameters
        ----------
        machine : Mechanism
            The machine.
        vary : mapping of str to object
            By name a pair, which is a range, or a list of choices [SI].

        Returns
        -------
        Box
            The settings.

        Raises
        ------
        DefinitionError
            A dimension is not known, a range is the wrong way round, or it is anything else.
        """
        require_mechanism(machine)
        if not isinstance(vary, Mapping):
            raise unfit(f"{machine.plan.title}: vary", vary, "a dictionary of ranges and choices by name is expected")
        for name in vary:
            if not isinstance(name, str):
                raise unknown("Dimension", name, machine.plan.table.names(), where=machine.plan.title)
        ranges = {name: range_of(name, value) for name, value in vary.items() if isinstance(value, tuple)}
        lists = {name: value for name, value in vary.items() if name not in ranges}
        for name, given in lists.items():
            expected = "write a range (low, high) or a list of choices such as [(0.22, 1.05), (0.22, 0.95)]"
            require(isinstance(given, (list, range)) and given, name, given, expected)
            for each in given:
                what = f"{name}: {cited(each)} is no choice; write a number, or the two coordinates (x, y) of a point."
                ensure(is_number(each) or is_pair(each), what)
        box = cls(ranges, [dict(zip(lists, each, strict=True)) for each in product(*lists.values())])
        for settings in (*box.choices, *({name: end} for name, pair in ranges.items() for end in pair)):
            machine.replaced(**settings)
        check_once(machine, vary)
        return box

    def settings(self, unit: FloatArray, choice: Index) -> DesignValues:
        """Return settings by name, from coordinates in parts of the ranges.

        Parameters
        ----------
        unit : array (m, k)
            The coordinates between 0 and 1.
        choice : array of int (m,)
            The number of the choice.

        Returns
        -------
        mapping of str to array (m,)
            The settings [SI].
        """
        low, high = np.array([*self.ranges.values()], float).reshape(-1, 2).T
        values = np.where(unit == 1.0, high, low + unit * (high - low))  # the far end to its last digit
        found: DesignValues = dict(zip(self.ranges, values.T, strict=True))
        for name in self.choices[0]:
            table = np.array([each[name] for each in self.choices], float)[np.asarray(choice)]
            found[name] = tuple(table.T) if table.ndim == 2 else table
        return found

    def sample(self, count: int, *, method: str = "sobol", seed: int = 0) -> DesignValues:
        """Return settings by name, spread evenly over the ranges and choices: the designs of a survey. They are the same for the same seed.

        Parameters
        ----------
        count : int
            How many; a Sobol sequence is evenest for a power of two.
        method : {"sobol", "latin", "random"}, optional
            A scrambled Sobol sequence, the default, a Latin hypercube, or pseudo-random numbers.
        seed : int, optional
            The seed, 0 by default.

        Returns
        -------
        mapping of str to array (count,)
            The settings [SI].
        """
        many = len(self.choices) > 1
        unit = unit_points(count, len(self.ranges) + many, method, seed)
        choice = (unit[:, -1] * len(self.choices)).astype(int) if many else np.zeros(count, int)
        return self.settings(unit[:, : len(self.ranges)], choice)


def setting_words(plan: Plan, settings: Mapping[str, Any], place: int) -> str:
    """Return one of some settings (m,) in words: `MK = 800 mm, M = (220, 950) mm`; a point's is a pair."""
    words = []
    for name, value in settings.items():
        if isinstance(value, tuple):
            words.append(f"{name} = ({', '.join(shown_number(float(part[place]), 'mm') for part in value)}) {unit_sign('mm')}")
        else:
            words.append(f"{name} = {show(float(value[place]), unit_of(plan, name))}")
    return ", ".join(words)


def range_of(name: str, given: object) -> tuple[float, float]:
    """Return a range; DefinitionError unless it is (low, high)."""
    if not is_pair(given) or given[0] > given[1]:
        raise unfit(name, given, "is no range; write (low, high) in SI, or a list [first, second] of choices")
    return amount_or_float(given[0]), amount_or_float(given[1])


def is_pair(given: object) -> TypeGuard[Sequence[float]]:
    """Return whether something is two numbers."""
    return is_listed(given) and len(given) == 2 and all(map(is_number, given))


MOST_SETTINGS = 1 << 30
"""Designs of one sample."""

METHODS = ("sobol", "latin", "random")


def unit_points(count: int, k: int, method: str, seed: int) -> FloatArray:
    """Return points (count, k) spread evenly over [0, 1), the same for the same seed.

    By a scrambled Sobol sequence, evenest where count is a power of two, a Latin hypercube, or pseudo-random numbers.
    """
    require_whole("count", count, "a whole number of designs is expected, at least 1", least=1)
    require(count <= MOST_SETTINGS, "count", count, "so many designs do not fit into memory; ask for fewer")
    one_word("method", method, METHODS)
    require_whole("seed", seed, "a whole number is expected, at least 0", least=0)
    if not k:
        return np.empty((count, 0))
    from scipy.stats import qmc

    random = np.random.default_rng(seed)
    if method == "random":
        return np.asarray(random.random((k, count)).T)
    if method == "latin":  # every coordinate has one point in each of count equal intervals
        return np.asarray(qmc.LatinHypercube(k, seed=random).random(count))
    engine: Any = qmc.Sobol(k, seed=random)
    power = int(count).bit_length() - 1
    return np.concatenate([engine.random_base2(power), engine.random(int(count) - (1 << power))])
