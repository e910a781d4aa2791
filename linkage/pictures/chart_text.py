"""The words of a working field as it is printed: loads, radii, heights, letters for its limits, and the legend."""

from __future__ import annotations

from string import ascii_uppercase

import numpy as np

from ..language import heading_of, said, translated
from ..motion.measures import words_of
from ..quantities import is_number
from ..statics import is_steady
from ..study import WorkingField
from ..study.load_rule import FACTORS, PLAIN_RULE
from ..study.working_field import NOT_LIMITED, OUT_OF_REACH
from ..units import decimals, factor, g0, shown_in, unit_sign


class ChartText:
    """A field's words in the chosen units and language: loads, radii, heights, letters, lines of the legend.

    A load that hangs is shown as a mass, as `is_weight` says. `load_size` is the load that is printed as 1 [N]. Each limiter that occurs
    has one of `letters`; `counts` says in how many cells it limits. `axes` stand across and down the chart, whose columns are `across` in
    the field and its rows `down`.
    """

    def __init__(self, field: WorkingField) -> None:
        self.field = field
        self.across, self.down = np.argsort(field.x, kind="stable"), np.argsort(-field.y, kind="stable")
        self.is_weight = is_steady(field.along) and field.along == (0.0, 1.0)
        self.unit = "t" if self.is_weight else "kN"
        self.load_size = (g0 if self.is_weight else 1.0) * factor(shown_in(self.unit))
        self.load_digits, self.length_digits = decimals(2, self.unit), 2 if shown_in("m") == "m" else 0
        named = [each for each in field.limiters if each not in (OUT_OF_REACH, NOT_LIMITED)]
        signs = [*ascii_uppercase, *(a + b for a in ascii_uppercase for b in ascii_uppercase)]
        self.letters = dict(zip(named, signs, strict=False))
        self.counts = {name: int(np.sum(field.limiter == name)) for name in self.letters}
        what = said("lift capacity at {point}", point=field.point)
        if not self.is_weight:
            x, y = (f"{each:.3g}" if is_number(each) else words_of(each) for each in field.along)
            what = said("force at {point} against ({x}, {y})", point=field.point, x=x, y=y)
        self.title = f"{field.machine.plan.heading}: {what}, {unit_sign(self.unit)}"
        unit = unit_sign("m")
        self.axes = said("radius from the frame's origin, {unit}", unit=unit), said("height, {unit}", unit=unit)

    def load_text(self, value: float) -> str:
        """Return a load [N] as it is printed."""
        if np.isnan(value):
            return ""
        return "\N{INFINITY}" if np.isinf(value) else f"{value / self.load_size:.{self.load_digits}f}"

    def length_text(self, value: float) -> str:
        """Return a radius or a height [m] as it is printed."""
        return f"{value / factor(shown_in('m')):.{self.length_digits}f}".replace("-", "\N{MINUS SIGN}")

    def legend(self) -> list[str]:
        """Return the lines under the chart."""
        words = [f"{letter}  {heading_of(name)} ({self.counts[name]})" for name, letter in self.letters.items()]
        return [*([said("limited by: {letters}", letters="    ".join(words))] if words else []), *self.terms()]

    def terms(self) -> list[str]:
        """Return the lines with the conditions of the chart: the rule, pressures, the case, other loads."""
        lines: list[str] = []
        field, rule = self.field, self.field.rule
        if rule is not PLAIN_RULE:
            shares = ", ".join(translated(FACTORS[name]).format(share=f"{100.0 * value:.4g} %") for name, value in rule.shares.items())
            words = [said("rule: {title}", title=translated(rule.title)) + (f": {shares}" if shares else "")]
            lines.append("; ".join([*words, *([translated(rule.remark)] if rule.remark else [])]))
        pressures = field.pressures()
        if pressures:
            lines.append(said("pressures: {words}", words=", ".join(pressures)))
        case = [said("load case {case}", case=field.case)] if field.case else []
        return [*lines, "; ".join([said("over front, in the plane of the machine"), *case, *field.remarks])]
