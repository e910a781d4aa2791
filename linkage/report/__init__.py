"""Results as text: tables, values with units, stroke ranges in words."""

from .csvfile import write_csv as write_csv
from .ranges import below_zero as below_zero
from .ranges import closely as closely
from .ranges import reached_span as reached_span
from .ranges import spans_in_words as spans_in_words
from .results import results as results
from .richtable import rich_tables as rich_tables
from .run import NOTHING as NOTHING
from .run import At as At
from .run import Run as Run
from .run import first as first
from .run import middle as middle
from .run import run_of as run_of
from .table import text_table as text_table
from .values import aligned as aligned
from .values import design_rows as design_rows
from .values import measure as measure
from .values import stroke_rows as stroke_rows
