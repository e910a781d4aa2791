"""Results as text: tables, values with units, stroke ranges in words."""

from ..star import declare_public
from .live_columns import LiveColumn, column_requests, is_column
from .ranges import (
    NOTHING,
    At,
    Run,
    closely,
    first_stroke,
    ranges_below_zero,
    reached_motion,
    reached_span,
    run_along,
    run_of,
    spans_in_words,
    stroke_middles,
)
from .results import force_columns, is_loaded, results
from .table import rich_tables, text_table, write_csv
from .values import design_rows, dimension_unit, stroke_rows

declare_public(globals())
