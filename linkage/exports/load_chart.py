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
from .extras import missing_extra
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
    try:
        import xlsxwriter
    except ImportError:
        raise missing_extra("xlsx", "an .xlsx", "XlsxWriter") from None
    stream, text = io.BytesIO(), ChartText(field)
    with xlsxwriter.Workbook(stream, {"in_memory": True, "strings_to_formulas": False, "strings_to_urls": False}) as book:
        book.set_properties({"title": field.machine.plan.heading, "comments": f"hydrolinkage: {name}", "created": MADE})
        looks: tuple[dict[str, object], ...] = ({"bold": True}, {"num_format": "0.00"}, {"bold": True, "num_format": "0.00"})
        bold, number, length = map(book.add_format, looks)
        chart, letters, cells = (book.add_worksheet(each) for each in ("Chart", "Limiters", "Cells"))
        across, down = text.across.tolist(), text.down.tolist()
        for sheet, title in ((chart, text.title), (letters, text.title)):
            sheet.write_string(0, 0, title, bold)
            for column, n in enumerate(across):
                sheet.write_number(1, 1 + column, float(field.x[n]) / factor(shown_in("m")), length)
            for row, k in enumerate(down):
                sheet.write_number(2 + row, 0, float(field.y[k]) / factor(shown_in("m")), length)
        for row, k in enumerate(down):
            for column, n in enumerate(across):
                load, limiter = float(field.load[k, n]), str(field.limiter[k, n])
                if np.isfinite(load):
                    chart.write_number(2 + row, 1 + column, load / text.load_size, number)
                if limiter != OUT_OF_REACH:
                    letters.write_string(2 + row, 1 + column, text.letters.get(limiter, ""))
        for row, line in enumerate(text.legend()):
            chart.write_string(3 + len(down) + row, 0, line)
        for row, values in enumerate(cell_table(field)):
            for column, value in enumerate(values):
                cells.write(row, column, value, None if row else bold)
        cells.freeze_panes(1, 0)
    return stream.getvalue()
