"""Results as text: tables, values with units, stroke ranges in words."""

from .csvfile import write_csv as write_csv
from .ranges import below_zero as below_zero
from .ranges import closely as closely
from .ranges import reached_span as reached_span
from .ranges import spans_in_words as spans_in_words
from .richtable import rich_tables as rich_tables
from .table import text_table as text_table
from .values import aligned as aligned
from .values import design_rows as design_rows
from .values import measure as measure
from .values import stroke_rows as stroke_rows
