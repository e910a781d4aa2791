"""Assumptions of a calculation, its omissions, and the standards that its rules cite."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

import numpy as np

from ..errors import LinkageError, unwarned
from ..language import said
from ..loads import ForceElement, LinkMass, Support, TwoPoint, Weight
from ..motion import Planes
from ..units import g0
from ..verdict import Verdict
from .calculation import has_loads
from .content import Block, Section, TableBlock
from .run import ReportSubject


def assumptions_section(subject: ReportSubject) -> Section:
    """Return the section of the assumptions behind all numbers of a report, and of its omissions."""
    beside = said("Not looked at, but for what a rule above judges:")
    return Section(said("Assumptions"), (tuple(assumed(subject)), beside, tuple(left_open(subject))))


def assumed(subject: ReportSubject) -> Iterator[str]:
    """Yield the assumptions."""
    elements = subject.machine.plan.of_kind(ForceElement)
    yield said("The bodies are rigid. Pins, guides and slots have no play.")
    yield said("The machine is planar: all parts move and all forces act in one plane. Both sides of the machine count together in it.")
    timed = [place.motion for place in subject.judge.places if place.instants is not None]
    if timed and not all(motion._rate_jump for motion in timed):
        yield said(
            "Over a path in time masses have their inertia, in tables, curves, verdicts and largest pin forces. The equations are those of "
            "slow motion: each pose is in equilibrium."
        )
    else:
        yield said("The motion is quasi-static: there are no inertia forces, each pose is in equilibrium.")
    if not elements:
        return
    counted = [f"{number} × {name}" for name, each in elements.items() if (number := getattr(each, "count", 1)) != 1]
    if counted:
        yield said("Cylinders side by side count together: {names}.", names=", ".join(counted))
    yield friction_words(subject)
    if weights := with_weight(subject):
        yield said(
            "Gravity is {g} m/s², downwards. Only these have weight: {names}; all else is without mass.",
            g=f"{g0:.6g}", names=", ".join(weights),
        )  # fmt: skip
    if any(isinstance(each, TwoPoint) and "bore" in each.numbers for each in elements.values()):
        yield said("Pressures are gauge pressures. Oil does not yield, and pressure is the same everywhere on a line.")


def with_weight(subject: ReportSubject) -> list[str]:
    """Return the names of the elements with weight."""
    return [name for name, each in subject.machine.plan.of_kind(ForceElement).items() if isinstance(each, (Weight, LinkMass))]


def friction_words(subject: ReportSubject) -> str:
    """Return which friction counts, in words."""
    elements, losses = subject.machine.plan.of_kind(ForceElement), []
    rubbing = []
    with unwarned():
        for name, each in elements.items():
            try:
                values = {key: float(np.ravel(each.number(subject.table, key))[0]) for key in each.numbers}
            except LinkageError:
                continue
            if any(values[key] != 1.0 for key in values if key.endswith("efficiency")):
                losses.append(name)
            if any(values[key] != 0.0 for key in values if key == "coefficient" or key.endswith("friction")):
                rubbing.append(name)
    words = said("There is no friction in pins, guides and slots.")
    if rubbing:
        words = said("Friction counts where it is declared ({names}), in both directions of motion; elsewhere there is none.",
                     names=", ".join(rubbing))  # fmt: skip
    return f"{words} {said('Losses of {names} count by their efficiencies.', names=', '.join(losses))}" if losses else words


def left_open(subject: ReportSubject) -> Iterator[str]:
    """Yield the omissions of a report."""
    plan = subject.machine.plan
    yield said("strength and stiffness of links, pins, bushes and welds; fatigue; wear")
    if all(place.instants is None for place in subject.judge.places):
        yield said("accelerations, shocks and vibrations, unless a load case stands for them")
    else:
        yield said("shocks and vibrations, unless a load case stands for them")
    yield said("loads across the plane of the machine, and how both sides share a load")
    yield said("play and tolerances of dimensions")
    if not has_loads(subject.machine):
        yield said("forces: no load is declared")
    if not plan.of_kind(Planes):
        yield said("whether links run into each other")
    if not plan.of_kind(Support):
        yield said("whether the machine tips over")


# The standards that are cited, each by the rules and texts that cite it.

RUSSIAN, CODE, OECD = "\u0413\u041e\u0421\u0422", "\u041a\u043e\u0434\u0435\u043a\u0441", "\u041e\u042d\u0421\u0420"
BODIES = rf"ISO(?:/TS|/TR)?|EN|DIN|GOST|{RUSSIAN}|ASABE|SAE|JIS|NFPA"
STANDARD = re.compile(rf"\b(?:{BODIES}) ?[A-Z]?\d[\d.-]*\d|\bOECD Code \d+|\b{CODE} \d+ {OECD}")
GRAVITY = "ISO 80000-4"


def standards_section(subject: ReportSubject, verdicts: Iterable[Verdict]) -> Section:
    """Return the section of the standards that rules, remarks and inputs of a report cite, each with its uses."""
    uses: dict[str, list[str]] = {}

    def cite(text: str, use: str) -> None:
        for name in STANDARD.findall(text):
            uses.setdefault(name, []).append(use)

    for each in verdicts:
        cite(each.sentence, said("rule: {rule}", rule=each.heading) if each.is_rule else said("remark"))
    for name, note in subject.notes.items():
        cite(note, said("source of {name}", name=name))
    cite(subject.machine.__doc__ or "", said("description of the machine"))
    if with_weight(subject):
        uses.setdefault(GRAVITY, []).append(said("standard acceleration of gravity"))
    blocks: tuple[Block, ...] = (said("No rule and no input of this report cites a standard."),)
    if uses:
        rows = tuple((name, "; ".join(dict.fromkeys(uses[name]))) for name in sorted(uses))
        blocks = (TableBlock(said("Standards"), (said("standard"), said("used for")), rows, "lm"),)
    return Section(said("Standards used"), blocks)
