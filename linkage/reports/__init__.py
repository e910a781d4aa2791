"""Results as text: tables, values with units, stroke ranges in words."""

from .ranges import NOTHING, At, Run, below_zero, closely, first, middle, reached_span, run_of, spans_in_words
from .results import results
from .table import rich_tables, text_table, write_csv
from .values import aligned, design_rows, measure, stroke_rows
