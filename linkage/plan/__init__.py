"""The ordered steps, their dimensions, and their program."""

from .plan import Plan as Plan
from .reading import ArrayReading as ArrayReading
from .reading import Reading as Reading
from .table import Entry as Entry
from .table import Table as Table
from .trace import Guard as Guard
from .trace import Trace as Trace
