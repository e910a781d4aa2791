"""Documents: the report of a calculation, as a page, as PDF, as Markdown."""

from ..star import declare_public
from .reporting import report, report_document

declare_public(globals())
