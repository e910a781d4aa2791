"""Machines and motions as files for other programs: workbooks with live formulas, tables, drawings."""

from ..star import declare_public
from .export import EXPORTERS, Exporter, ExportJob, export, exporter_of

declare_public(globals())
