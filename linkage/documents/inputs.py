"""Inputs of a calculation: strokes, dimensions with their sources, loads, load cases, the definition itself, assumptions, standards."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterable, Iterator, Mapping
from functools import partial

import numpy as np
from matplotlib.axes import Axes

from ..errors import LinkageError, unwarned
from ..formulas.numbered import Equations
from ..language import said, translated
from ..loads import ForceElement, LinkMass, LoadCase, Support, TwoPoint, Weight
from ..mechanism import Mechanism
from ..motion import Motion, Planes, stroke_display_unit
from ..pictures.dimensioned import dimensioned
from ..pictures.scene import Scene
from ..pictures.shown_values import unit_typeset
from ..plan import spanning_name, written_out
from ..quantities import Dimension, Stroke
from ..reports import dimension_unit
from ..reports.values import DIGITS, is_left_out, with_units
from ..statics.vehicle import frame_supports
from ..units import g0, shown_number, unit_sign
from ..verdict import Verdict
from .calculation import has_loads
from .content import Block, Cell, Formula, Illustration, Section, TableBlock
from .pictures import ROOM, WIDE, height_of, in_one_unit
from .run import ReportSubject, comments_in


def inputs_section(subject: ReportSubject, listing: Equations) -> Section:
    """Return the section of the inputs, with the drawing of the dimensions."""
    machine, notes = subject.machine, subject.notes
    prose = [plain_words(translated(each)) for each in own_paragraphs(type(machine))[1:]]  # the first line is the subtitle
    blocks: list[Block] = [*prose, stroke_table(subject, listing)]
    if machine.dimensions:
        blocks.append(dimension_table(machine, listing, notes))
    elements, heads = machine.plan.of_kind(ForceElement), (said("name"), said("declared as"), said("source, note"))
    if elements:
        blocks.append(TableBlock(said("Loads, force elements and hydraulics"), heads, member_rows(machine, elements, notes), "lmm"))
    else:
        blocks.append(said("No load is declared: forces are not calculated."))
    cases = machine.plan.of_kind(LoadCase)
    if cases:
        blocks.append(TableBlock(said("Load cases"), heads, member_rows(machine, cases, notes), "lmm"))
    pose = subject.machine.at(unreachable="nan", **{name: [value] for name, value in subject.pose.items()})
    caption = said(
        "Dimensions in {unit} at {pose}; the table of dimensions has those without room.",
        unit=unit_sign("mm"), pose=subject.words(subject.pose),
    )  # fmt: skip
    blocks.append(Illustration("dimensions", caption, (WIDE, height_of(Scene(pose), 0.16)), ROOM, partial(dimensions, motion=pose)))
    return Section(said("Inputs"), tuple(blocks))


def dimensions(ax: Axes, motion: Motion) -> None:
    """Draw a mechanism with its dimensions."""
    dimensioned(ax, motion)
    in_one_unit(ax)


MARKED = re.compile(r"`+|(?<![\w*])\*(?=[^\s*])|(?<=[^\s*])\*(?![\w*])")


def plain_words(text: str) -> str:
    """Return a text without the marks of code and of emphasis; a product keeps its sign."""
    return MARKED.sub("", text)


def own_paragraphs(machine: type[Mechanism]) -> list[str]:
    """Return the paragraphs of a class's own words, each in one line; the first is the subtitle."""
    return [" ".join(each.split()) for each in inspect.cleandoc(machine.__doc__ or "").split("\n\n")]


def own_texts(machine: type[Mechanism]) -> list[str]:
    """Return all that a class says in its own words, which a catalogue may have in another language: names, prose, notes."""
    classes = [each for each in machine.__mro__ if issubclass(each, Mechanism) and each is not Mechanism]
    found = [machine.plan.heading, *(case.title for name, case in machine.plan.of_kind(LoadCase).items() if case.title not in (name, ""))]
    found += [text for each in classes for text in (*own_paragraphs(each), *comments_in(each).values())]
    return [*dict.fromkeys(text for text in found if any(letter.isalpha() for letter in text))]


def stroke_table(subject: ReportSubject, listing: Equations) -> TableBlock:
    """Return the strokes with their ranges, and where those stand that are held."""
    rows: list[tuple[Cell, ...]] = []
    machine, notes = subject.machine, subject.notes
    for name, stroke in machine.strokes.items():
        unit = stroke_display_unit(machine.plan, name, "mm")
        places = dict.fromkeys(shown_number(run.held[name], unit) for run in subject.runs if name in run.held)
        moves = [said("moves")] if any(name in run.ways for run in subject.runs) else []
        used = ", ".join([*moves, *([said("held at {value}", value=", ".join(places))] if places else [])])
        ends = (shown_number(stroke.start, unit), shown_number(stroke.end, unit))
        rows.append((name, Formula(listing.symbol_latex(name)), *ends, unit_sign(unit), used, notes.get(name, "")))
    heads = (said("stroke"), said("symbol"), said("start"), said("end"), said("unit"), said("in this report"), said("source, note"))
    return TableBlock(said("Strokes"), heads, tuple(rows), "llrrllm")


def dimension_table(machine: Mechanism, listing: Equations, notes: Mapping[str, str]) -> TableBlock:
    """Return the design variables: name, symbol, value, unit, place; a changed one with its former value.

    The force of a support under the frame is none: the vehicle's weight gives it.
    """
    rows, found = list[tuple[Cell, ...]](), {f"{name}.force" for name in frame_supports(machine.plan)}
    for name, value in machine.dimensions.items():
        if name in found:
            continue
        entry = machine.plan.table.entries[name]
        unit = dimension_unit(machine, name)
        where = entry.where.partition(" = ")[0] if entry.kind != "number" else ""
        said_of = notes.get(name) or notes.get(where) or notes.get(name.partition(".")[0], "")
        changed = said("was {value}", value=shown_number(entry.default, unit)) if float(value) != entry.default else ""
        note = "; ".join(each for each in (changed, said_of, said("not given") if is_left_out(machine, name) else "") if each)
        sign = unit_typeset(unit_sign(unit)) if unit else ""
        rows.append((name, Formula(listing.symbol_latex(name)), shown_number(float(value), unit, DIGITS), sign, where, note))
    heads = (said("dimension"), said("symbol"), said("value"), said("unit"), said("appears in"), said("source, note"))
    return TableBlock(said("Dimensions"), heads, tuple(rows), "llrllm")


def member_rows(machine: Mechanism, names: Iterable[str], notes: Mapping[str, str]) -> tuple[tuple[str, str, str], ...]:
    """Return members as they are declared, their numbers with units."""
    texts = written_out(machine.plan, {name: float(value) for name, value in machine.dimensions.items()})
    return tuple((name, with_units(machine.plan, name, texts[name]), notes.get(name, "")) for name in names)


def definition_section(machine: Mechanism) -> Section:
    """Return the section that has the whole definition, member by member, and the rigid bodies."""
    left_out = (Dimension, Stroke, ForceElement, LoadCase)  # these stand among the inputs
    names = [name for name, member in machine.plan.members.items() if not isinstance(member, left_out)]
    heads = (said("name"), said("declared as"))
    rows = tuple((name, OF_PART.sub("", text)) for name, text, _ in member_rows(machine, names, {}))
    cylinders = [(spanning_name(machine.plan, bar.P, bar.Q), f"{bar.P} {bar.Q}") for bar in machine.plan.cylinders]
    links = machine.plan.link_names
    named = ((said("frame") if body.fixed else links.get(body.name, body.name), " ".join(body.points)) for body in machine.links)
    bodies = (*named, *cylinders)
    count = said(
        "Mobility {rank} by the rank of the constraints, strokes {strokes}; count of Gruebler {count}, a cylinder being two bodies on a "
        "slide.",
        rank=machine.mobility, strokes=len(machine.strokes), count=machine.gruebler,
    )  # fmt: skip
    order = said("In the order in which the positions are worked out; lengths in m, angles in rad where no deg is marked.")
    members = TableBlock(said("Declarations"), heads, rows, "lm")
    rigid = TableBlock(said("Rigid bodies"), (said("name"), said("points")), bodies, "lm")
    return Section(said("Definition of the mechanism"), (order, count, members, rigid))


OF_PART = re.compile(r", \*\*\{.*\}")
"""What a part is given by names with a dot: it stands in the table of dimensions."""


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
            rubs = [value for key, value in values.items() if key == "coefficient" or key.endswith("friction")]
            if any(rubs) and not isinstance(each, Support):
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
