"""A working field as a file: a table of its cells, a workbook with the chart as it is printed and the cells behind it."""

from __future__ import annotations

import csv
import io
from typing import Any

import numpy as np

from ..errors import DefinitionError
from ..language import heading_of
from ..motion import stroke_display_unit
from ..pictures.load_chart import ChartText
from ..study import WorkingField
from ..study.working_field import OUT_OF_REACH
from ..units import factor, g0, shown_in
from .extras import library
from .workbook import MADE

SUFFIXES = (".csv", ".xlsx")


def chart_content(field: WorkingField, suffix: str, name: str) -> bytes:
    """Return the bytes of a field's file: .csv or .xlsx."""
    if suffix == ".csv":
        stream = io.StringIO(newline="")
        csv.writer(stream).writerows(cell_table(field))
        return stream.getvalue().encode("utf-8")
    if suffix == ".xlsx":
        return chart_workbook(field, name)
    raise DefinitionError(f"{name}: a working field is written as {' or '.join(SUFFIXES)}; a picture is plot(field).savefig(...).")


def cell_table(field: WorkingField) -> list[list[Any]]:
    """Return the headings of the cells and then a row for each, in the units of the headings; empty without a number."""
    text = ChartText(field)
    strokes = [(name, shown_in(stroke_display_unit(field.machine.plan, name, "mm"))) for name in field.strokes]
    columns = [("x", shown_in("m")), ("y", shown_in("m")), ("load", shown_in(text.unit)), ("limiter", ""), *strokes, ("why", "")]
    found: list[list[Any]] = [[f"{name} [{unit}]" if unit else name for name, unit in columns]]
    for cell in field.cells():
        row = cell | {"limiter": heading_of(cell["limiter"])}
        for (_, unit), (name, value) in zip(columns, cell.items(), strict=True):
            if isinstance(value, float):
                shown = value / (g0 if name == "load" and text.is_weight else 1.0) / factor(unit)
                row[name] = "" if np.isnan(value) else shown
        found.append([*row.values()])
    return found


def chart_workbook(field: WorkingField, name: str) -> bytes:
    """Return the bytes of an .xlsx file: the chart, its legend, and the cells with limiters and strokes."""
    xlsxwriter, stream, text = library("XlsxWriter", "xlsx", "an .xlsx"), io.BytesIO(), ChartText(field)
    with xlsxwriter.Workbook(stream, {"in_memory": True, "strings_to_formulas": False, "strings_to_urls": False}) as book:
        book.set_properties({"title": field.machine.plan.heading, "comments": f"hydrolinkage: {name}", "created": MADE})
        looks: tuple[dict[str, object], ...] = ({"bold": True}, {"num_format": "0.00"}, {"bold": True, "num_format": "0.00"})
        bold, number, length = map(book.add_format, looks)
        chart, letters, cells = (book.add_worksheet(each) for each in ("Chart", "Limiters", "Cells"))
        for sheet in (chart, letters):
            sheet.write_string(0, 0, text.title, bold)
            sheet.write_row(1, 1, (field.x[text.across] / factor(shown_in("m"))).tolist(), length)
            sheet.write_column(2, 0, (field.y[text.down] / factor(shown_in("m"))).tolist(), length)
        for row, k in enumerate(text.down.tolist()):
            for column, n in enumerate(text.across.tolist()):
                load, limiter = float(field.load[k, n]), str(field.limiter[k, n])
                if np.isfinite(load):
                    chart.write_number(2 + row, 1 + column, load / text.load_size, number)
                if limiter != OUT_OF_REACH:
                    letters.write_string(2 + row, 1 + column, text.letters.get(limiter, ""))
        chart.write_column(3 + len(text.down), 0, text.legend())
        for row, values in enumerate(cell_table(field)):
            cells.write_row(row, 0, values, None if row else bold)
        cells.freeze_panes(1, 0)
    return stream.getvalue()
