"""Rules for load charts: the shares of the tipping load and of the hydraulic load that a chart prints."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ..errors import DefinitionError, cited, known_name, require_type
from ..frozen import record
from ..language import noted
from ..quantities import is_number
from ..units import require_number

FACTORS: Mapping[str, str] = MappingProxyType(
    {
        "hydraulic": noted("{share} of what the cylinders carry"),
        "tipping": noted("{share} of what tips it"),
        "slipping": noted("{share} of what lets it slip"),
        "pressure": noted("{share} of the pump's pressure"),
    }
)
"""What a rule's numbers are shares of, in words."""


@record
class LoadRule:
    """Factors of the load by its limit: `LoadRule("works rule", hydraulic=0.9, tipping=0.7)`. Each is above 0 and not above 1.

    Parameters
    ----------
    title : str
        How the rule is called.
    hydraulic : float, optional
        The part of what each cylinder carries.
    tipping, slipping : float, optional
        The parts of what the supports do.
    pressure : float, optional
        The part of the pump's pressure with which cylinders lift, not of what holds.
    remark : str, optional
        What is written beside it in a legend.

    Raises
    ------
    DefinitionError
        A factor is not above 0, or above 1.
    """

    title: str
    hydraulic: float = 1.0
    tipping: float = 1.0
    slipping: float = 1.0
    pressure: float = 1.0
    remark: str = ""

    def __post_init__(self) -> None:
        if not isinstance(self.title, str) or not self.title:
            raise DefinitionError(f'LoadRule({cited(self.title)}): its title is expected first, LoadRule("works rule", tipping=0.75).')
        for name in FACTORS:
            value = getattr(self, name)
            percent = f", {name}={value / 100.0:g} for {value:g} %" if is_number(value) and 1.0 < value <= 100.0 else ""
            expected = f"a share of the load above 0 and not above 1 is expected{percent}"
            require_number(f"LoadRule({self.title!r}): {name}", value, expected, above=0.0, most=1.0)

    @property
    def shares(self) -> Mapping[str, float]:
        """The factors that change something, by name."""
        return {name: getattr(self, name) for name in FACTORS if getattr(self, name) != 1.0}


PLAIN_RULE = LoadRule("no rule")
ISO_10567 = LoadRule("ISO 10567", hydraulic=0.87, tipping=0.75)
ISO_14397_1 = LoadRule(
    "ISO 14397-1", tipping=0.5, remark=noted("straight ahead; the full turn, for which the standard takes the half, is not planar")
)
OECD_2 = LoadRule("OECD Code 2", pressure=0.9)
RULES: Mapping[str, LoadRule] = MappingProxyType({each.title: each for each in (ISO_10567, ISO_14397_1, OECD_2)})


def rule_of(given: object) -> LoadRule:
    """Return the rule that is meant, by its title too; DefinitionError for anything else."""
    if given is None:
        return PLAIN_RULE
    if isinstance(given, str):
        return RULES[known_name("Rule", given, RULES)]
    return require_type("rule", given, LoadRule, 'a LoadRule is expected, such as ISO_10567 or LoadRule("works rule", tipping=0.75)')
