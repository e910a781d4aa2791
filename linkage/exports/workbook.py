"""A design as a workbook with live formulas: dimensions, strokes, the equations one after the other, results and a chart."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from datetime import datetime
from functools import cached_property
from inspect import cleandoc
from string import ascii_uppercase
from textwrap import shorten
from typing import TYPE_CHECKING, Any

import numpy as np
import sympy
from sympy.printing.precedence import PRECEDENCE
from sympy.printing.str import StrPrinter

from ..errors import DefinitionError, require_whole
from ..formulas.numbered import CONVENTION, DEFINITIONS, uses
from ..formulas.printing import reading_order
from ..language import heading_of
from ..loads import PLAIN_CASE, LoadCase
from ..motion import stroke_display_unit, stroke_unit
from ..pictures.chart_text import ChartText
from ..reports import column_among, dimension_unit, friction_of_columns
from ..statics.applied import case_of
from ..study import WorkingField
from ..study.working_field import OUT_OF_REACH
from ..units import deg, factor, g0, shown_in
from .calculation import ITERATED, Calculation, live_results
from .extras import library

if TYPE_CHECKING:
    from xlsxwriter import Workbook
    from xlsxwriter.format import Format
    from xlsxwriter.worksheet import Worksheet

MADE = datetime(2000, 1, 1)
"""The date in the file: the same design gives the same bytes."""
ROWS_ABOVE = 4
"""Rows above the numbers of the calculation: number, name, unit, meaning; of a machine of parts one more, for their headings."""
RESULT_ROWS_ABOVE = 3
ROW_MARK = "#ROW#"
"""What stands in a formula for the number of its row."""
FITS = 1e-9
"""m; pins found together miss their links by less."""
CHANGED = "Dimensions!$G$4"
"""The cell that says whether any input differs from that of the exported design."""
GIVEN = "given, for the inputs as exported: export the changed design again"
"""What stands over numbers that no formula gives once an input is changed."""


def workbook(calculation: Calculation, name: str) -> bytes:
    """Return the bytes of an .xlsx file; DefinitionError where XlsxWriter is not installed."""
    xlsxwriter, stream = library("XlsxWriter", "xlsx", "an .xlsx"), io.BytesIO()
    options = {"in_memory": True, "strings_to_formulas": False, "strings_to_urls": False, "strings_to_numbers": False}
    with xlsxwriter.Workbook(stream, options) as book:
        book.set_properties({"title": calculation.design.plan.heading, "comments": f"hydrolinkage: {name}", "created": MADE})
        book.set_calc_mode("auto")
        Sheets(book, calculation).write_sheets()
    return stream.getvalue()


class Sheets:
    """The sheets of one workbook; texts are written as texts, whatever they begin with."""

    def __init__(self, book: Workbook, calculation: Calculation) -> None:
        self.book, self.calculation, self.design = book, calculation, calculation.design
        self.strokes = list(self.design.strokes)
        self.results = live_results(calculation)
        self.count = calculation.motion.shape[0]
        self.top = int(bool(calculation.headings))
        self.above = ROWS_ABOVE + self.top
        self.misfit = CHANGED  # where pins are found by iteration, the cell that tells that they do not fit
        ink = "#1F2933"
        head = {"bold": True, "bg_color": "#EEF1F4", "font_color": ink, "border": 1, "border_color": "#C9D1D9", "valign": "top"}
        self.head = book.add_format(head)
        wrapped, dead = {**head, "bold": False, "text_wrap": True, "font_size": 9}, {"italic": True, "font_color": "#8A5A00"}
        self.wrapped, self.dead_wrapped = book.add_format(wrapped), book.add_format({**wrapped, **dead})
        self.dead_head = book.add_format({**head, **dead})
        self.title = book.add_format({"bold": True, "font_size": 14, "font_color": ink})
        self.text = book.add_format({"font_color": ink})
        self.part = book.add_format({"bold": True, "font_color": ink})
        self.muted = book.add_format({"font_color": "#6B7785", "indent": 1})
        typed = {"font_color": "#0000FF", "bg_color": "#FFFBE6", "num_format": "General", "border": 1, "border_color": "#E3D9A8"}
        self.input = book.add_format(typed)
        self.plain = book.add_format({"num_format": "General", "font_color": ink})
        self.warning = book.add_format({"bold": True, "font_color": "#C0392B"})
        self.outdated = book.add_format({"font_strikeout": True, "font_color": "#C0392B"})
        self._formats: dict[tuple[str, bool], Format] = {}

    def write_sheets(self) -> None:
        """Write all sheets, in the order in which they are read."""
        titles = ("Dimensions", "Strokes", "Calculation", "Results", "Chart")
        first, strokes, middle, last, chart = (self.book.add_worksheet(title) for title in titles)
        for sheet in (first, strokes, middle, last, chart):
            sheet.set_landscape()
            sheet.set_paper(9)
            sheet.fit_to_pages(1, 0)
            sheet.set_header(f"&L{shorten(self._situation, 200, placeholder=' …').replace('&', '&&')}&R&A")
        middle.set_print_scale(45)
        middle.repeat_rows(0, self.above - 1)
        middle.repeat_columns(0, len(self.strokes))
        last.repeat_rows(0, RESULT_ROWS_ABOVE - 1)
        self._dimensions(first)
        self._strokes(strokes)
        self._calculation(middle)
        self._results(last)
        self._chart(chart)

    # -- what is given ---------------------------------------------------------------------------------

    @cached_property
    def defined_names(self) -> dict[sympy.Symbol, str]:
        """The names of the cells of dimensions, by the dimension, and of the ends of strokes, by (stroke, "from" or "to")."""
        shown = {name: self.calculation.equations._listing.names.quantity(name).name for name in self.design.dimensions}
        ends = {(stroke, end): f"{stroke}_{end}" for stroke in self.strokes for end in ("from", "to")}
        keys = [*shown, *ends]
        texts = [*shown.values(), *ends.values()]
        unique = [text if texts.index(text) == place else f"{text}_{place}" for place, text in enumerate(texts)]
        found = cell_names(unique)
        return {key: found[text] for key, text in zip(keys, unique, strict=True)}

    def _dimensions(self, sheet: Worksheet) -> None:
        """Write the design variables: the value that is typed in, in its unit, and beside it in SI, by the name that formulas use."""
        design, names = self.design, self.defined_names
        for first, last, width in ((0, 0, 30), (1, 3, 15), (4, 4, 30), (5, 5, 70), (6, 6, 30)):
            sheet.set_column(first, last, width)
        sheet.write_string(0, 0, design.plan.heading, self.title)
        about = cleandoc(type(design).__doc__ or "").splitlines()
        sheet.write_string(1, 0, about[0] if about else "", self.muted)
        sheet.write_string(2, 0, "Type over a number on yellow; all sheets follow. SI and radians in the calculation.", self.muted)
        sheet.write_string(3, 0, self._situation, self.muted)
        row = 4
        sheet.write_row(row, 0, ("Dimension", "Value", "Unit", "SI value", "Name in formulas", "Note", "Changed"), self.head)
        owner, titles = None, self.calculation.equations.part_titles
        owners = list(dict.fromkeys(["", *map(self.calculation.owner, design.dimensions)]))
        for name in sorted(design.dimensions, key=lambda each: owners.index(self.calculation.owner(each))):
            value = design.dimensions[name]
            if titles and self.calculation.owner(name) != owner:
                owner = self.calculation.owner(name)
                row += 1
                sheet.write_string(row, 0, titles[owner], self.part)
            row += 1
            entry = design.plan.table.entries[name]
            unit = dimension_unit(design, name)
            sheet.write_string(row, 0, name, self.text)
            typed = tidy(value / factor(unit))
            sheet.write_number(row, 1, typed, self.input)
            sheet.write_string(row, 2, unit, self.muted)
            sheet.write_formula(row, 3, f"=B{row + 1}{to_si(unit)}", self.plain, float(value))
            sheet.write_formula(row, 6, f'=IF(B{row + 1}={typed!r},"","as exported {typed:.15g}")', self.warning, "")
            sheet.write_string(row, 4, names[name], self.muted)
            sheet.write_string(row, 5, self._note(name, entry.where), self.muted)
            self.book.define_name(names[name], f"=Dimensions!$D${row + 1}")
        changed = f"SUMPRODUCT(LEN(G6:G{row + 1}))+SUMPRODUCT(LEN(Strokes!H2:H{max(len(self.strokes), 1) + 1}))"
        sheet.write_formula(3, 6, f'=IF({changed}>0,"changed inputs","")', self.warning, "")
        sheet.freeze_panes(5, 1)
        self._agreement(sheet, row + 2)
        for place, text in enumerate(self._remarks()):
            sheet.write_string(row + 3 + place, 0, text, self.text)

    @property
    def _situation(self) -> str:
        """Where the sheets run, and under which loads."""
        run, plan = self.calculation.run, self.design.plan
        text = f"Along {run.title or ', '.join(run.ways)}"
        cases = list(plan.of_kind(LoadCase))
        if cases:
            own = case_of(plan, run.case)
            others = [name for name in (PLAIN_CASE, *cases) if name != (own.name or PLAIN_CASE)]
            loads = f"in load case {own.label}" if run.case is not None else f"under the machine's own loads, load case {PLAIN_CASE}"
            text = f"{text}, {loads}; {', '.join(others)} not in these sheets"
        columns = [result.column for result in self.results]
        return f"{text}. {friction_of_columns(self.calculation.motion, columns)}".strip()

    def _note(self, name: str, where: str) -> str:
        read = {str(symbol) for result in self.results if result.expr is not None for symbol in result.expr.free_symbols}
        symbols = {str(symbol) for symbol, owner in self.calculation.dimension_symbols.items() if owner == name}
        kept = any(name in result.unchanged for result in self.results)
        if name not in self.calculation.used and not symbols & read and not kept:
            return f"{where}; no formula here reads it" if where else "no formula here reads it"
        return where

    def _agreement(self, sheet: Worksheet, row: int) -> None:
        """Write a warning that appears where pins found together do not fit the dimensions any more."""
        places = [place for place, column in enumerate(self.calculation.columns) if column.checks]
        if not places:
            return
        self.misfit = f"Dimensions!$A${row + 1}"
        ranges = [self._range("Calculation", self._sheet_column(place), self.above) for place in places]
        worst = ",".join(f"MAX({each}),-MIN({each})" for each in ranges)
        pins = " ".join(self.calculation.equations._listing.unknowns)
        text = f"The pins {pins} were found by iteration and do not fit these dimensions: export the changed design again."
        sheet.write_formula(row, 0, f'=IF(MAX({worst})>{FITS!r},"{text}","")', self.warning, "")

    def _remarks(self) -> list[str]:
        """Return remarks for a reader: conventions, the words of the equations, and cells that do not follow a changed number."""
        calculation, lines = self.calculation, self.calculation.equations
        dead = [column.name for column in calculation.columns if column.expr is None]
        lost = [result.column.name for result in self.results if result.expr is None]
        friction = [] if lines._forces is None else lines._forces.friction
        return [
            "",
            *CONVENTION,
            *(text for words, text in DEFINITIONS if uses(lines, words)),
            *([f"Numbers, not formulas, in the calculation: {', '.join(dead)}. Export the changed design again."] if dead else []),
            *([f"Numbers, not formulas, in the results: {', '.join(lost)}."] if lost else []),
            *(f"Left out: {text}" for text in calculation.left_out),
            *([f"Left out of the forces: the friction of {', '.join(friction)}."] if friction else []),
        ]

    def _strokes(self, sheet: Worksheet) -> None:
        """Write the ends of the stroke that runs and the others' values, then all strokes at every pose."""
        strokes, plan, run = self.strokes, self.design.plan, self.calculation.run
        sheet.set_column(0, 7, 15)
        sheet.write_row(0, 0, ("Stroke", "From", "To", "Unit", "From, SI", "To, SI", "Note", "Changed"), self.head)
        for row, name in enumerate(strokes, 1):
            unit, runs = stroke_display_unit(plan, name, "mm"), name in run.ways
            sheet.write_string(row, 0, name, self.text)
            ends = {"from": run.ways[name][0], "to": run.ways[name][-1]} if runs else {"from": run.held[name]}
            typed = [tidy(value / factor(unit)) for value in ends.values()]
            same = ",".join(f"{letter}{row + 1}={value!r}" for letter, value in zip("BC", typed, strict=False))
            told = " to ".join(f"{value:.15g}" for value in typed)
            sheet.write_formula(row, 7, f'=IF(AND({same}),"","as exported {told}")', self.warning, "")
            for column, (end, value) in enumerate(ends.items()):
                sheet.write_number(row, 1 + column, typed[column], self.input)
                sheet.write_formula(row, 4 + column, f"={'BC'[column]}{row + 1}{to_si(unit)}", self.plain, value)
                self.book.define_name(self.defined_names[name, end], f"=Strokes!${'EF'[column]}${row + 1}")
            sheet.write_string(row, 3, unit, self.muted)
            sheet.write_string(row, 6, f"{self.count} poses from one end to the other" if runs else "held", self.muted)
        top = self._stroke_head
        sheet.write_row(top - 1, 0, ("pose", *(f"{name}, {stroke_unit(plan, name)}".removesuffix(", ") for name in strokes)), self.head)
        for pose in range(self.count):
            sheet.write_number(top + pose, 0, pose, self.plain)
            for column, name in enumerate(strokes, 1):
                text = start = self.defined_names[name, "from"]
                if name in run.ways:
                    text += f"+({self.defined_names[name, 'to']}-{start})*A{top + pose + 1}/{self.count - 1}"
                sheet.write_formula(top + pose, column, f"={text}", self.plain, self._stroke_value(name, pose))

    def _stroke_value(self, name: str, pose: int) -> float:
        """Return a stroke's value at a pose [SI]."""
        return float(np.broadcast_to(self.calculation.stroke_values[name], (self.count,))[pose])

    @property
    def _stroke_head(self) -> int:
        """The rows of the strokes' sheet above the poses."""
        return len(self.strokes) + 3

    # -- the equations ---------------------------------------------------------------------------------

    def _sheet_column(self, column: int) -> int:
        """Return where a column of the calculation stands in its sheet: behind the pose and the strokes."""
        return 1 + len(self.strokes) + column

    @cached_property
    def _letters(self) -> dict[sympy.Symbol, str]:
        """The letter of the column of each symbol of the calculation's sheet."""
        symbols = [*self.calculation.stroke_symbols.values(), *(each.symbol for each in self.calculation.columns)]
        return {symbol: column_letters(1 + place) for place, symbol in enumerate(symbols)}

    @cached_property
    def _outdated_by(self) -> dict[sympy.Symbol, str]:
        """The cells that tell, once they have a text, that a column of the calculation is left behind: of given ones and what follows them.

        Pins found by iteration hold as long as they fit; other given numbers until an input is changed.
        """
        found: dict[sympy.Symbol, str] = {}
        for each in self.calculation.columns:
            if each.expr is None:
                found[each.symbol] = self.misfit if each.meaning.endswith(ITERATED) else CHANGED
            elif not each.checks and (cell := self._outdating(each.expr, found)):
                found[each.symbol] = cell
            else:  # formulas read a given number where its equation follows
                found.pop(each.symbol, None)
        return found

    def _outdating(self, expr: sympy.Expr | None, known: Mapping[sympy.Symbol, str]) -> str:
        """Return the cell that tells that a formula's value, or a number without one, is left behind; "" where it never is."""
        if expr is None:
            return CHANGED
        cells = {known[symbol] for symbol in expr.free_symbols & known.keys()}
        return CHANGED if CHANGED in cells else next(iter(cells), "")

    def _cell_formula(self, expr: sympy.Expr, sheet: str = "") -> str | None:
        """Return an expression as a formula with ROW_MARK where the row's number goes; None for one that is too long.

        A symbol is a cell of the calculation in the same row, or a dimension by its name.
        """
        dimensions = self.calculation.dimension_symbols

        def read(symbol: sympy.Symbol) -> str:
            letter = self._letters.get(symbol)
            return f"{sheet}{letter}{ROW_MARK}" if letter is not None else self.defined_names[dimensions[symbol]]

        return formula(expr, read)

    def _calculation(self, sheet: Worksheet) -> None:
        """Write a column for each equation, two for a vector, in their order: number, name, unit, meaning, and a formula a pose."""
        plan, strokes = self.design.plan, self.strokes
        sheet.set_row(3 + self.top, 75)
        sheet.set_column(0, 0, 7)
        sheet.set_column(1, self._sheet_column(len(self.calculation.columns)), 16)
        given = [("", "pose", "", "number of the pose"), *(("", name, stroke_unit(plan, name), "stroke") for name in strokes)]
        for column, texts in enumerate(given):
            self._heading(sheet, column, texts)
        for pose in range(self.count):
            row = self.above + pose
            sheet.write_formula(row, 0, f"=Strokes!A{self._stroke_head + pose + 1}", self.plain, pose)
            for column, name in enumerate(strokes, 1):
                text = f"=Strokes!{column_letters(column)}{self._stroke_head + pose + 1}"
                sheet.write_formula(row, column, text, self._format(1.0, False), self._stroke_value(name, pose))
        for place, text in self.calculation.headings.items():
            sheet.write_string(0, self._sheet_column(place), text, self.part)
        for place, each in enumerate(self.calculation.columns):
            texts = each.number, each.name, each.unit, each.meaning
            self._heading(sheet, self._sheet_column(place), texts, each.expr is None, self._outdated_by.get(each.symbol, ""))
            look = self._format(float(np.nanmax(np.abs(each.values), initial=0.0)), each.expr is None)
            template = None if each.expr is None else self._cell_formula(each.expr)
            for pose, value in enumerate(each.values.tolist()):
                row = self.above + pose
                formula_here = None if template is None else template.replace(ROW_MARK, str(row + 1))
                if formula_here is not None and each.turns is not None and pose:  # a direction goes on from the cell above without a jump
                    formula_here += f"-2*PI()*ROUND(({formula_here[1:]}-{self._letters[each.symbol]}{row})/(2*PI()),0)"
                elif formula_here is not None and each.turns:
                    formula_here += f"+2*PI()*({each.turns})"
                self._number(sheet, row, self._sheet_column(place), formula_here, value, look)
        sheet.freeze_panes(self.above, 1 + len(strokes))

    def _heading(self, sheet: Worksheet, column: int, texts: Sequence[str], dead: bool = False, outdating: str = "") -> None:
        for row, text in enumerate(texts):
            if row == 3 and outdating:
                self._given(sheet, self.top + row, column, text, outdating)
            else:
                sheet.write_string(self.top + row, column, text, self.wrapped if row == 3 else self.dead_head if dead else self.head)

    def _given(self, sheet: Worksheet, row: int, column: int, text: str, cell: str) -> None:
        """Write a heading over numbers that do not follow all inputs: once a cell tells of a change it says so, and they are struck."""
        plain = shorten(text.replace('"', "'"), 250, placeholder=" …")  # a text in a formula has 255 letters at most
        sheet.write_formula(row, column, f'=IF({cell}="","{plain}","{GIVEN}")', self.dead_wrapped, plain)
        rule = {"type": "formula", "criteria": f'={cell}<>""', "format": self.outdated}
        sheet.conditional_format(row + 1, column, row + self.count, column, rule)

    def _number(self, sheet: Worksheet, row: int, column: int, text: str | None, value: float, look: Format) -> None:
        if text is not None:
            sheet.write_formula(row, column, text, look, value if np.isfinite(value) else "#NUM!")
        elif np.isfinite(value):
            sheet.write_number(row, column, value, look)
        else:
            sheet.write_string(row, column, "", look)

    def _format(self, size: float, dead: bool) -> Format:
        """Return the format of numbers up to a size."""
        text = "0.00000E+00" if size >= 1e7 or 0.0 < size < 1e-3 else "0.00" if size >= 1e4 else "0.0000" if size >= 100.0 else "0.000000"
        return self._look(text, dead)

    def _look(self, text: str, dead: bool) -> Format:
        """Return a format of numbers, made once; those that follow nothing are slanted."""
        if (text, dead) not in self._formats:
            colour = {"italic": True, "font_color": "#8A5A00"} if dead else {"font_color": "#1F2933"}
            self._formats[text, dead] = self.book.add_format({"num_format": text, **colour})
        return self._formats[text, dead]

    # -- results ---------------------------------------------------------------------------------------

    def _results(self, sheet: Worksheet) -> None:
        """Write the machine's own table, in its units; columns without an equation as numbers."""
        sheet.set_column(0, max(len(self.results) - 1, 0), 14)
        for column, result in enumerate(self.results):
            dead = result.expr is None
            kept = ", ".join(f"{name} = {self.design.dimensions[name]:g}" for name in result.unchanged)
            says = "a number, not a formula" if dead else f"while {kept}" if kept else ""
            for row, text in enumerate((result.column.name, result.column.unit, says)):
                sheet.write_string(row, column, text, self.wrapped if row == 2 else self.head)
            if outdating := self._outdating(result.expr, self._outdated_by):
                self._given(sheet, 2, column, says, outdating)
            shown = np.broadcast_to(result.column.shown, self.calculation.motion.shape)
            look = self._look(f"0.{'0' * result.column.digits}" if result.column.digits else "0", dead)
            template = None if result.expr is None else self._cell_formula(result.expr, "Calculation!")
            if template is not None:
                body = template[1:] if result.expr.is_Symbol else f"({template[1:]})"
                own = f"{body}{from_si(result.column.unit)}"
                tests = ",".join(f"{self.defined_names[name]}={self.design.dimensions[name]:g}" for name in result.unchanged)
                template = f"=IF(AND({tests}),{own},NA())" if tests else f"={own}"
            for pose, value in enumerate(shown.tolist()):
                formula_here = None if template is None else template.replace(ROW_MARK, str(self.above + pose + 1))
                self._number(sheet, RESULT_ROWS_ABOVE + pose, column, formula_here, value, look)
        sheet.set_row(2, 36)
        sheet.freeze_panes(RESULT_ROWS_ABOVE, 1)

    def _chart(self, sheet: Worksheet) -> None:
        """Draw the machine's featured column over its stroke."""
        columns, stroke = [result.column for result in self.results], self.calculation.run.stroke
        names = [each.name for each in columns]
        shown = names.index(column_among(self.design, columns, None).name)
        y = columns[shown]
        if stroke in names:
            x = columns[names.index(stroke)]
            name, along, across = x.heading, x.shown, self._range("Results", names.index(stroke), RESULT_ROWS_ABOVE)
        else:
            name, along = f"{stroke}, {stroke_unit(self.design.plan, stroke)}".removesuffix(", "), self.calculation.stroke_values[stroke]
            across = self._range("Calculation", 1 + self.strokes.index(stroke), self.above)
        chart = self.book.add_chart({"type": "scatter", "subtype": "straight"})
        values = self._range("Results", shown, RESULT_ROWS_ABOVE)
        line = {"color": "#1F5FA8", "width": 2.25}
        chart.add_series({"name": y.heading, "categories": f"={across}", "values": f"={values}", "line": line})
        axis = {"num_font": {"size": 10}, "major_gridlines": {"visible": True, "line": {"color": "#E1E5EA", "width": 0.75}}}
        chart.set_title({"name": f"{self.design.plan.heading}: {y.heading}", "name_font": {"size": 13}, "overlay": False})
        ends = {"min": tidy(float(np.min(along))), "max": tidy(float(np.max(along)))}
        chart.set_x_axis({"name": name, **ends, "label_position": "low", "crossing": "min", **axis})
        chart.set_y_axis({"name": y.heading, "label_position": "low", "crossing": "min", **axis})
        chart.set_legend({"none": True})
        chart.set_size({"width": 860, "height": 480})
        sheet.insert_chart("B2", chart)
        sheet.hide_gridlines(2)

    def _range(self, sheet: str, column: int, head: int) -> str:
        letter = column_letters(column)
        return f"{sheet}!${letter}${head + 1}:${letter}${head + self.count}"


def column_letters(place: int) -> str:
    """Return the letters of a column by its place, A for 0, AA for 26."""
    rest, last = divmod(place, 26)
    return (column_letters(rest - 1) if rest else "") + ascii_uppercase[last]


def tidy(value: float) -> float:
    """Return a number without the noise that a change of units leaves in its last digits."""
    return float(f"{value:.15g}")


def to_si(unit: str) -> str:
    """Return the end of a formula that turns a number in a unit into SI."""
    return "*PI()/180" if unit and factor(unit) == deg else "" if factor(unit) == 1.0 else f"*{factor(unit)!r}"


def from_si(unit: str) -> str:
    """Return the end of a formula that turns SI into a number in a unit."""
    return "*180/PI()" if unit and factor(unit) == deg else "" if factor(unit) == 1.0 else f"/{factor(unit)!r}"


def check_count(count: object) -> int:
    """Return the number of poses; DefinitionError for anything but a whole number of rows that a sheet has."""
    return require_whole("count", count, "a number of poses from 2 to 100000 is expected, such as 101", least=2, most=100_000)


# A working field as a file: a table of its cells, a workbook with the chart as it is printed and the cells behind it.

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


def cell_table(field: WorkingField) -> list[list[object]]:
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


# SymPy expressions as the formulas of a spreadsheet, and the names of its cells.
#
# Three things differ from other languages: a sign binds closer than a power (-a^2 is (-a)^2), ATAN2 takes x before y, and LN is the natural
# logarithm. Names and decimals are those of the file format, whatever language the spreadsheet speaks.

LONGEST_FORMULA = 8000
"""Characters; a spreadsheet takes 8192."""
FUNCTION_NAMES: Mapping[str, str] = {
    "sin": "SIN", "cos": "COS", "tan": "TAN", "acos": "ACOS", "asin": "ASIN", "atan": "ATAN", "Abs": "ABS", "exp": "EXP", "log": "LN",
    "sign": "SIGN", "Min": "MIN", "Max": "MAX", "And": "AND", "Or": "OR", "Not": "NOT",
}  # fmt: skip


def formula(expr: sympy.Expr, read: Callable[[sympy.Symbol], str]) -> str | None:
    """Return an expression as a formula, `=...`; None where it is longer than a spreadsheet takes. `read` gives a symbol's place."""
    text = f"={FormulaText(read).doprint(expr)}"
    return text if len(text) <= LONGEST_FORMULA else None


class FormulaText(StrPrinter):  # type: ignore[misc]
    """A formula's text; `read` gives the place of a symbol."""

    def __init__(self, read: Callable[[sympy.Symbol], str]) -> None:
        super().__init__()
        self.read = read

    def _print_Symbol(self, expr: sympy.Symbol) -> str:
        return self.read(expr)

    _print_Dummy = _print_Symbol

    def _print_Float(self, expr: sympy.Float) -> str:
        return repr(float(expr)).removesuffix(".0")

    def _print_Rational(self, expr: sympy.Rational) -> str:
        return f"{expr.p}/{expr.q}"

    def _print_Pi(self, expr: object) -> str:
        return "PI()"

    def _print_NaN(self, expr: object) -> str:
        return "NA()"

    def _print_Add(self, expr: sympy.Add, order: str | None = None) -> str:
        text = ""
        for each in reading_order(expr.args):
            negative = each.could_extract_minus_sign()
            part = self.parenthesize(-each if negative else each, PRECEDENCE["Mul"], strict=True)
            text += f"-{part}" if negative and text else f"+{part}" if text else self._print(each)
        return text

    def _print_Mul(self, expr: sympy.Mul) -> str:
        if expr.could_extract_minus_sign():
            rest = self.parenthesize(-expr, PRECEDENCE["Mul"], strict=True)
            return f"-1*{rest}" if "^" in rest else f"-{rest}"
        over, under = sympy.fraction(expr, exact=True)
        if under == 1:
            return "*".join(self.parenthesize(each, PRECEDENCE["Mul"], strict=True) for each in sympy.Mul.make_args(expr))
        return f"{self.parenthesize(over, PRECEDENCE['Mul'])}/{self.parenthesize(under, PRECEDENCE['Pow'])}"

    def _print_Pow(self, expr: sympy.Pow, rational: bool = False) -> str:
        base, power = expr.args
        if power == sympy.Rational(1, 2):
            return f"SQRT({self._print(base)})"
        if power.is_number and power.is_negative:
            return f"1/{self.parenthesize(sympy.Pow(base, -power), PRECEDENCE['Pow'])}"
        return f"{self._alone(base)}^{self._alone(power)}"

    def _alone(self, expr: sympy.Expr) -> str:
        """Return an expression as one piece: a cell, a function, a number without a sign, or in brackets."""
        text = str(self._print(expr))
        is_one = expr.is_Symbol or expr.is_Function or (expr.is_number and text.replace(".", "").isdigit())
        return text if is_one else f"({text})"

    def _print_atan2(self, expr: sympy.atan2) -> str:
        y, x = map(self._print, expr.args)
        return f"ATAN2({x},{y})"

    def _print_Function(self, expr: sympy.Function) -> str:
        return f"{FUNCTION_NAMES[type(expr).__name__]}({','.join(map(self._print, expr.args))})"

    _print_Abs = _print_Min = _print_Max = _print_And = _print_Or = _print_Not = _print_Function

    def _print_Piecewise(self, expr: sympy.Piecewise) -> str:
        (value, condition), *others = expr.args
        if condition is sympy.true or condition == True:  # noqa: E712 - SymPy's truth
            return str(self._print(value))
        other = self._print(sympy.Piecewise(*others, evaluate=False)) if others else "NA()"
        return f"IF({self._print(condition)},{self._print(value)},{other})"

    def _print_Relational(self, expr: sympy.Rel) -> str:
        sign = {"==": "=", "!=": "<>"}.get(expr.rel_op, expr.rel_op)
        return f"{self.parenthesize(expr.lhs, PRECEDENCE['Add'])}{sign}{self.parenthesize(expr.rhs, PRECEDENCE['Add'])}"

    def _print_BooleanTrue(self, expr: object) -> str:
        return "TRUE"

    def _print_BooleanFalse(self, expr: object) -> str:
        return "FALSE"


# The names of cells: what a spreadsheet takes as one, each once.

LIKE_A_CELL = re.compile(r"[a-z]{1,3}\d+|[rc]\d*|r\d*c\d*|true|false", re.IGNORECASE)
"""A1, XFD7, R, C, R1C1: what a spreadsheet reads as a place, and its two words for truth."""
LONGEST_NAME = 200


def cell_names(texts: Iterable[str]) -> dict[str, str]:
    """Return the name of a cell for each text: `L_OB` for itself, `A_x` for `A.x`, `_L0` for `L0`, which is a place in a sheet.

    Names that differ in small and capital letters alone are one to a spreadsheet: the second gets a number.
    """
    names: dict[str, str] = {}
    taken: set[str] = set()
    for text in texts:
        plain = re.sub(r"\W", "_", text)[:LONGEST_NAME] or "_"
        name = wanted = f"_{plain}" if plain[0].isdigit() or LIKE_A_CELL.fullmatch(plain) else plain
        count = 1
        while name.lower() in taken:
            count += 1
            name = f"{wanted}_{count}"
        taken.add(name.lower())
        names[text] = name
    return names
