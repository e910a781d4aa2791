"""What a survey of a study file measures: measures and conditions as text, of many designs at once."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any, final

import numpy as np

from ..errors import LinkageError
from ..mechanism import Mechanism
from ..motion.measures import Condition, Constraint, Integral, Leaf, Measure
from ..program import FloatArray
from ..study.optimum import unit_of_measure
from ..study.problem import NOWHERE, Problem, missed
from .criterion import criterion_of, measure_or_constant
from .names import shortened

MET_TO_ROUNDING = 1e-12


@final
@dataclass(frozen=True)
class TextMeasures:
    """The function that a survey measures with: measures and conditions by name, as text, at so many poses of a stroke.

    Extremes are those of the poses; of several strokes `poses` is for all of them together. A design that cannot be assembled over the
    whole stroke has no value, and keeps no condition.
    """

    texts: Mapping[str, str]
    poses: int
    over: Mapping[str, Any] = field(default_factory=dict)

    def __call__(self, machine: Mechanism) -> dict[str, Any]:
        """Return a number or a truth value for each design of a machine, shape (m,), by name."""
        said = self.said(machine)
        problem = self.problem(machine, said)
        drawn = {name: entry.default for name, entry in machine.plan.table.entries.items()}
        for leaf in problem.leaves:  # panels are those of the machine as its class has it, whatever the batch
            if isinstance(leaf, Integral):
                with suppress(LinkageError):
                    problem.refined_panels(leaf, drawn)
        look = problem.evaluated(machine.dimensions)
        numbers, count = look.numbers, max(np.size(value) for value in machine.dimensions.values())
        found: dict[str, Any] = {}
        for name, each in said.items():
            leaves = each.leaves if isinstance(each, Measure) else [leaf for one in each for leaf in one.margin.leaves]
            sound = look.whole & ~np.any([np.zeros(count, bool), *(look.rows[leaf].lost for leaf in leaves)], axis=0)
            if isinstance(each, Measure):
                found[name] = np.where(sound, design_values(each, numbers, count), np.nan)
            else:
                found[name] = sound & keeps(each, numbers, count)
        return found

    def said(self, machine: Mechanism) -> dict[str, Measure | list[Constraint]]:
        """Return the measures, and the constraints of the conditions, by name; DefinitionError for a text that says none."""
        found = {name: criterion_of(text, machine) for name, text in self.texts.items()}
        return {
            name: [*each.constraints(machine)] if isinstance(each, Condition) else measure_or_constant(each, machine)
            for name, each in found.items()
        }

    def problem(self, machine: Mechanism, said: Mapping[str, Measure | list[Constraint]]) -> Problem:
        """Return what looks at them; DefinitionError where they ask for what a machine has not."""
        measures = [each for each in said.values() if isinstance(each, Measure)]
        kept = [one for each in said.values() if not isinstance(each, Measure) for one in each]
        counts = {0: 1} | {each: max(3, round(self.poses ** (1.0 / each))) for each in range(1, 6)}
        return Problem(machine, measures, kept, NOWHERE, over=dict(self.over), counts=counts)

    def units(self, machine: Mechanism) -> dict[str, str]:
        """Return the units that they are shown in, by name; raises as `problem` does."""
        said = self.said(machine)
        self.problem(machine, said)
        return {name: unit_of_measure(machine.plan, each) if isinstance(each, Measure) else "" for name, each in said.items()}


def design_values(measure: Measure, numbers: Mapping[Leaf, FloatArray], count: int) -> FloatArray:
    """Return a measure of designs, shape (count,), from the numbers of its leaves."""
    with np.errstate(all="ignore"):
        return np.broadcast_to(np.asarray(measure.of(lambda leaf: numbers[leaf]), float), (count,))


def keeps(constraints: list[Constraint], numbers: Mapping[Leaf, FloatArray], count: int) -> Any:
    """Return which designs keep all of some constraints, shape (count,)."""
    with np.errstate(all="ignore"):
        kept = np.ones(count, bool)
        for each in constraints:
            size = np.maximum(*(np.abs(design_values(side, numbers, count)) for side in (each.left, each.right)))
            kept &= missed(each, numbers, 1.0) <= MET_TO_ROUNDING * size
    return kept


def named_measures(given: Any) -> dict[str, str]:
    """Return the texts of a table of measures by name; those of a list by themselves."""
    if isinstance(given, list):
        return {str(text): text for text in given}
    return {shortened(str(name), quote=False): text for name, text in given.items()}
