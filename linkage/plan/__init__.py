"""The ordered steps, their dimensions, and their program."""

from .missing import Mask as Mask
from .missing import called as called
from .missing import failures as failures
from .missing import missing_words as missing_words
from .missing import negative as negative
from .missing import opening as opening
from .plan import Plan as Plan
from .printing import printed as printed
from .printing import strokes_text as strokes_text
from .reading import ArrayReading as ArrayReading
from .reading import Reading as Reading
from .table import Entry as Entry
from .table import Table as Table
from .trace import NEAR as NEAR
from .trace import REGULAR as REGULAR
from .trace import Guard as Guard
from .trace import Loop as Loop
from .trace import Measure as Measure
from .trace import Trace as Trace
