"""Machines and motions as files for other programs: workbooks with live formulas, tables, drawings."""

from .export import EXPORTERS, Exporter, ExportJob, export, exporter_of
