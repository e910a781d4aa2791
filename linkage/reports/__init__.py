"""Results as text: tables, values with units."""

from .live_columns import LiveColumn, at_its_rates, column_requests, is_column
from .results import (
    case_along,
    case_shown,
    column_among,
    columns_about,
    force_columns,
    friction_of_columns,
    is_changing,
    is_loaded,
    rate_columns,
    request_in_case,
    results,
)
from .runs import (
    NOTHING,
    At,
    Run,
    closely,
    first_stroke,
    in_case_words,
    motion_over,
    one_run,
    reached_motion,
    reached_span,
    run_along,
    run_of,
    run_words,
    runs_of,
    stroke_middles,
)
from .values import dagger_words, design_rows, dimension_unit, joined_tables, stroke_rows, text_table, write_csv

__all__ = ["results", "text_table", "write_csv"]
