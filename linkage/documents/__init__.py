"""Documents: the report of a calculation, as a page, as PDF, as Markdown."""

from .reporting import report, report_document
