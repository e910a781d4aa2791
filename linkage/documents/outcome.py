"""What comes out over the stroke: tables, curves, cylinders, the forces of the joints, the limits of motion."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from math import cos, sin
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ..errors import LinkageError, unknown, unwarned
from ..language import noted, said, translated
from ..motion import Column, Motion, Tabled, stroke_display_unit
from ..motion.limits import StrokeLimits
from ..pictures import mechanism
from ..pictures.curves import panel
from ..pictures.dimensioned import dimensioned
from ..pictures.scene import Scene
from ..pictures.style import ACCENT, INK, THIN, TITLE
from ..plan import Plan
from ..reports import results
from ..reports.table import cells as text_cells
from ..reports.table import column_blocks, flat
from ..statics import PinForces, max_table
from ..units import show, shown_number, unit_sign
from .calculation import has_loads
from .content import Block, Cell, Illustration, Paragraph, Section, TableBlock
from .inputs import length_unit
from .run import Looked

WIDE = 6.6
"""The width of a picture across the page [inch]."""
HALF = 3.25
"""The width of a curve [inch]; two stand beside each other."""
LETTERS = 100
"""Letters of a table's row, so that it fits across a page."""
KINDS = (noted("pin"), noted("guide"), noted("slot"), noted("driven point"), noted("crank's drive"), noted("slider"), noted("telescope"))
DIRECTIONS = (noted("frictionless"), noted("extending"), noted("retracting"), noted("own loads"))
"""The words of joints, of directions and of the plain load case, as results have them."""


# -- drawings ----------------------------------------------------------------------------------------------


def drawing_section(looked: Looked, path: Sequence[str]) -> Section:
    """Return the section of the drawings: with dimensions, and at both ends of the stroke with the paths of points."""
    pose = looked.machine.at(unreachable="nan", **{name: [value] for name, value in looked.pose.items()})
    first = Illustration(
        "dimensions",
        said(
            "Dimensions in {unit} at {pose}; what has no room stands in the table of dimensions.",
            unit=length_unit(), pose=looked.words(looked.pose),
        ),
        (WIDE, height_of(Scene(pose), 0.16)), ROOM, lambda ax: dimensioned(ax, pose),
    )  # fmt: skip
    reached = np.flatnonzero(looked.curve.reached)
    ends = [looked.moving_words(looked.strokes_at(looked.curve, int(place))) for place in (reached[0], reached[-1])]
    paths = said(" Broken line: path of {points}.", points=", ".join(path)) if path else ""
    second = Illustration(
        "positions",
        said("Positions at {start} (faint) and at {end}.", start=ends[0], end=ends[1]) + paths,
        (WIDE, height_of(Scene(looked.curve))), ROOM, partial(positions, motion=looked.curve, path=path),
    )  # fmt: skip
    return Section(said("Drawing"), (first, second))


ROOM = (0.55, 0.08, 0.5, 0.08)


def height_of(scene: Scene, air: float = 0.0) -> float:
    """Return the height of a drawing across the page [inch]."""
    left, right, bottom, top = scene.box()
    pad = air * max(right - left, top - bottom)
    wide = WIDE - ROOM[0] - ROOM[1]
    return float(np.clip(wide * (top - bottom + pad) / (right - left + pad), 2.2, 4.5)) + ROOM[2] + ROOM[3]


def positions(ax: Axes, motion: Motion, path: Sequence[str]) -> None:
    """Draw a mechanism at both ends of what it reaches, and the paths of points."""
    reached = np.flatnonzero(motion.reached).tolist()
    mechanism(ax, motion, int(reached[0]), faint=True)
    mechanism(ax, motion, int(reached[-1]))
    for name in path:
        ax.plot(*motion[name], color=ACCENT, linewidth=1.6 * THIN, linestyle=(0, (5, 2)), zorder=9.0)


# -- tables and curves -------------------------------------------------------------------------------------


def reported_columns(looked: Looked, names: Sequence[str] | None) -> list[Column]:
    """Return the columns of results at the poses of the tables: those named, else all; DefinitionError for an unknown name."""
    with unwarned():
        found = results(looked.machine, looked.table)
    if names is None:
        return found
    known = {column.name: column for column in found}
    for name in names:
        if name not in known:
            raise unknown("Column", name, known, where=f"the table of {looked.machine.plan.title}")
    return [known[name] for name in dict.fromkeys([*(each for each in looked.machine.strokes if each in known), *names])]


def results_section(looked: Looked, names: Sequence[str] | None, first: str, limits: Mapping[str, Sequence[Any]]) -> Section:
    """Return the section of the table over the stroke and the curves, the one the machine is about first."""
    columns = reported_columns(looked, names)
    blocks: list[Block] = []
    shown = [column for column in columns if column.name not in looked.run.held]
    held = looked.words(dict(looked.run.held))
    if held:
        blocks.append(Paragraph(said("Along {stroke}, with {held} held.", stroke=", ".join(looked.run.ways), held=held)))
    missing = int(np.count_nonzero(~looked.table.reached))
    if missing:
        blocks.append(
            Paragraph(said("{n} of {count} poses of the table cannot be assembled; they have no values.", n=missing, count=looked.count))
        )
    blocks += column_grids(said("Results over the stroke"), shown)
    whole = curve_columns(looked)
    coordinates = {f"{point}_{axis}" for point in looked.machine.plan.points for axis in "xy"}
    drawn = [name for name in whole if name != first and (name in names if names is not None else name not in coordinates)]
    for name in [first, *drawn]:
        bound = limits.get(name)
        caption = said("{column} over the stroke.", column=whole[name].heading)
        if bound is not None:
            caption += said(" Shaded: what its limit excludes.")
        size = (WIDE, 2.6) if name == first else (HALF, 2.15)
        paint = partial(curve, motion=looked.curve, column=whole[name], bound=bound)
        blocks.append(Illustration(f"curve_{safe(name)}", caption, size, (0.62, 0.12, 0.46, 0.32 if bound is None else 0.48), paint))
    return Section(said("Results"), tuple(blocks))


def curve_columns(looked: Looked) -> dict[str, Column]:
    """Return the columns of results and of members at the poses of the curves, by name."""
    with unwarned():
        found = {column.name: column for column in results(looked.machine, looked.curve)}
        for member in member_curves(looked):
            found.setdefault(member.name, member)
    return {name: column for name, column in found.items() if name not in looked.machine.strokes}


def member_curves(looked: Looked) -> Iterator[Column]:
    """Yield what members show of themselves, with their names; nothing of one that is refused."""
    for name, member in looked.machine.plan.of_kind(Tabled).items():
        try:
            columns = member.columns(looked.curve)
        except LinkageError:
            continue
        yield from (replace(column, name=f"{column.name} {name}") for column in columns)


def curve(ax: Axes, motion: Motion, column: Column, bound: Sequence[Any] | None) -> None:
    """Draw a column over the stroke with its limit."""
    panel(ax, motion, column, bound)
    if bound is not None:  # its words stand above the curve, under the heading
        ax.set_title(ax.get_title(loc="left"), loc="left", fontsize=TITLE, fontweight="bold", color=INK, pad=19)


def safe(name: str) -> str:
    """Return a name as a part of a file's name."""
    return "".join(each if each.isalnum() and each.isascii() else "_" for each in name)


def column_grids(caption: str, columns: Sequence[Column]) -> Iterator[TableBlock]:
    """Yield columns of results as tables as wide as a page; the first column leads each."""
    texts = [text_cells(column, values) for column, values in zip(columns, flat(columns), strict=True)]
    for number, block in enumerate(column_blocks(columns, texts, LETTERS, 2)):
        rows = tuple(zip(*(texts[place] for place in block), strict=True))
        title = caption if not number else said("{caption}, continued", caption=caption)
        yield TableBlock(title, tuple(columns[place].heading for place in block), rows, "r" * len(block))


# -- cylinders and springs ---------------------------------------------------------------------------------


def members_section(looked: Looked) -> Section | None:
    """Return the section of what members show of themselves, such as cylinders their thrust and pressure; None where none does."""
    members = looked.machine.plan.of_kind(Tabled)
    rows: list[tuple[Cell, ...]] = []
    refused: list[Paragraph] = []
    for name, member in members.items():
        try:
            with unwarned():
                columns = member.columns(looked.curve)
        except LinkageError as error:
            refused.append(Paragraph(str(error)))
            continue
        rows += [(name, *column_extremes(looked, column)) for column in columns]
    if not members:
        return None
    heads = (said("member"), said("quantity"), said("least"), said("at stroke"), said("greatest"), said("at stroke"))
    table = [TableBlock(said("Cylinders over the stroke, without friction"), heads, tuple(rows), "llrlrl")] if rows else []
    return Section(said("Hydraulics"), (*table, *refused))


def column_extremes(looked: Looked, column: Column) -> tuple[str, ...]:
    """Return a column's heading, its least and greatest value and the strokes of these."""
    values = np.broadcast_to(np.asarray(column.values, float), looked.curve.shape)
    if not np.isfinite(values).any():
        return (column.heading, "–", "", "–", "")
    cells = text_cells(column, flat([Column(column.name, values, column.unit, column.digits)])[0])
    found: list[str] = []
    for place in (int(np.nanargmin(values)), int(np.nanargmax(values))):
        found += [cells[place], looked.moving_words(looked.strokes_at(looked.curve, place))]
    return (column.heading, *found)


# -- forces of joints --------------------------------------------------------------------------------------


def forces_section(looked: Looked) -> Section | None:
    """Return the section of driving forces and of the largest force of every joint, over cases and directions; None without loads."""
    title = said("Forces in drives and pins")
    if not has_loads(looked.machine):
        return None
    try:
        found = looked.forces
        rows = max_table(found)
    except LinkageError as error:
        return Section(title, (Paragraph(said("The joint forces are not calculated: {why}", why=str(error))),))
    held = looked.words(dict(looked.run.held))
    looks = Paragraph(
        said(
            "The largest force of each joint over the whole run of {stroke}, between the poses of the tables too, over load cases and "
            "directions of motion. Fx and Fy act on the body, in its own axes: x from the first of the named points to the second, y to "
            "its left; on the frame in the axes of the drawing.",
            stroke=", ".join(looked.run.ways),
        )
        + (said(" Held: {held}.", held=held) if held else "")
    )
    unit = unit_sign("kN")
    heads = (
        said("pin"), said("joint"), said("on body"), said("from body"), said("Fx, {unit}", unit=unit), said("Fy, {unit}", unit=unit),
        said("F, {unit}", unit=unit), said("x axis"), said("at stroke"), said("load case"), said("motion"),
    )  # fmt: skip
    table = TableBlock(said("Largest pin forces, for FEM"), heads, tuple(pin_row(looked, row) for row in rows), "llllrrrllll")
    drives = (said("load case"), said("motion"), said("drive or member"), said("least"), said("greatest"), said("unit"))
    ranges = TableBlock(said("Driving forces and thrusts at the poses of the table"), drives, tuple(drive_rows(looked, found)), "lllrrl")
    remarks = [Paragraph(each) for each in dict.fromkeys(remark for one in found for remark in one.remarks)]
    return Section(title, (ranges, looks, table, *remarks))


def pin_row(looked: Looked, row: Any) -> tuple[str, ...]:
    """Return a joint's largest force as cells."""
    parts = [shown_number(row.force * way(row.angle), "kN", "z.3f") if np.isfinite(row.force) else "∞" for way in (cos, sin)]
    size = shown_number(row.force, "kN", ".3f") if np.isfinite(row.force) else "∞"
    case = translated(row.case)
    where = looked.moving_words(row.strokes)
    return (row.point, translated(row.kind), frame(row.on), frame(row.by), *parts, size, row.axis, where, case, translated(row.direction))


def frame(name: str) -> str:
    """Return a body's name, the frame's in the language that is spoken."""
    return said("frame") if name.startswith("frame") else name


def drive_rows(looked: Looked, found: Sequence[PinForces]) -> Iterator[tuple[str, ...]]:
    """Yield the range of every drive's force and of every thrust."""
    for one in found:
        forces = [(name, values, drive_unit(looked.machine.plan, name)) for name, values in one.drives.items()]
        forces += [(said("thrust of {name}", name=name), values, "kN") for name, values in one.thrusts.items()]
        for name, values, unit in forces:
            if np.isfinite(values).any():
                low, high = (shown_number(float(each(values)), unit, "z.3f") for each in (np.nanmin, np.nanmax))
                yield (translated(one.case), translated(one.direction), name, low, high, unit_sign(unit))


def drive_unit(plan: Plan, stroke: str) -> str:
    """Return the unit of a drive's generalised force."""
    return "kNm" if stroke_display_unit(plan, stroke) == "deg" else "kN"


# -- limits ------------------------------------------------------------------------------------------------


def limits_section(looked: Looked) -> Section:
    """Return the section of how far every stroke reaches, what stops it, and the least transmission angles."""
    title = said("Limits of motion")
    try:
        with unwarned():
            found = looked.machine.at(unreachable="nan", **looked.pose).limits()
    except LinkageError as error:
        return Section(title, (Paragraph(str(error)),))
    heads = (said("stroke"), said("limit"), said("at stroke"))
    rows = [row for each in found.values() for row in limit_rows(looked, each)]
    held = said("Each stroke by itself, the others held at {pose}.", pose=looked.words(looked.pose))
    return Section(
        title,
        (*([Paragraph(held)] if len(found) > 1 else []), TableBlock(said("Reach, dead points, transmission"), heads, tuple(rows), "lmm")),
    )


def limit_rows(looked: Looked, limits: StrokeLimits) -> Iterator[tuple[Cell, ...]]:
    """Yield what limits a stroke."""
    name = limits.stroke

    def place(value: float) -> str:
        return looked.words({name: value})

    for each in limits.intervals:
        yield name, said("reachable"), said("from {start} to {end}", start=place(each.low), end=place(each.high))
    for value, step in limits.dead_points:
        yield name, said("dead point of {step}, the motion ends", step=step), place(value)
    for value, step in limits.change_points:
        yield name, said("change point: the branches of {step} cross", step=step), place(value)
    for value, cylinder in limits.cylinder_dead_points:
        yield name, said("dead point of the cylinder {cylinder}: its length stands still", cylinder=cylinder), place(value)
    for least in limits.transmission:
        yield (
            name,
            said("least transmission angle at {joint}: {angle}", joint=least.joint, angle=show(least.angle, "deg", 4)),
            place(least.stroke),
        )
    if limits.open_turn is not None:
        pins, turns = " ".join(limits.open_turn.pins), limits.open_turn.turns
        yield (
            name,
            said(
                "after one turn {pins} do not stand where they began; turns until they do (0: not after six): {turns}",
                pins=pins,
                turns=turns,
            ),
            "",
        )
