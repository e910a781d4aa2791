"""Workbooks and drawings read back, and worked out again by other programs: LibreOffice, and the package `formulas`.

What reads them is loaded when it is needed, not when tests are collected: it takes a second.
"""

import shutil
import subprocess
from functools import cache

import numpy as np
import pytest

OFFICE = shutil.which("soffice")
needs_office = pytest.mark.skipif(OFFICE is None, reason="soffice is not installed (Debian: apt-get install libreoffice-calc)")


def drawing(path):
    """Return a drawing in DXF."""
    import ezdxf

    return ezdxf.readfile(path)


@cache
def stored(path):
    """Return the sheets with the values that stand in the file."""
    return opened(path, data_only=True)


@cache
def written(path):
    """Return the sheets with their formulas."""
    return opened(path)


def opened(path, **options):
    """Return a workbook of its own, which may be changed."""
    import openpyxl

    return openpyxl.load_workbook(path, **options)


def by_office(folder, books):
    """Return workbooks as LibreOffice works them out from the formulas alone, by name: `books` gives a path and changed cells for each.

    The cells are (sheet, cell, value). One run for all.
    """
    bare, out = folder / "bare", folder / "out"
    bare.mkdir()
    for name, (path, changes) in books.items():
        book = opened(path)  # which keeps no values of formulas
        for sheet, cell, value in changes:
            book[sheet][cell] = value
        book.save(bare / f"{name}.xlsx")
    profile = f"-env:UserInstallation=file://{folder}/profile"
    command = [OFFICE, "--headless", profile, "--convert-to", "xlsx", "--outdir", out, *sorted(bare.iterdir())]
    subprocess.run(command, check=True, capture_output=True, timeout=900)
    return {name: stored(out / f"{name}.xlsx") for name in books}


def row_of(book, dimension):
    """Return the row of a dimension in the first sheet."""
    return next(cell.row for cell in book["Dimensions"]["A"] if cell.value == dimension)


def number_columns(sheet, top):
    """Return the columns of a sheet below some rows, shape (poses,) each; NaN where no number stands."""
    rows = list(sheet.iter_rows(min_row=top, values_only=True))
    return [
        np.array([value if isinstance(value, (int, float)) else np.nan for value in column], float) for column in zip(*rows, strict=True)
    ]


def same_numbers(one, other, tolerance=1e-12):
    """Return what differs: sheet, column and by how much of the column's greatest value; None where nothing does."""
    for title, top in (("Strokes", 5), ("Calculation", 5), ("Results", 4)):
        pairs = zip(number_columns(one[title], top), number_columns(other[title], top), strict=True)
        for place, (a, b) in enumerate(pairs):
            size = max(float(np.nanmax(np.abs(a), initial=0.0)), 1e-3)
            if not np.allclose(a, b, rtol=0.0, atol=tolerance * size, equal_nan=True):
                return title, place, float(np.nanmax(np.abs(a - b))) / size
    return None
