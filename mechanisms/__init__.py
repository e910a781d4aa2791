"""Shipped machines, one file each."""

from pathlib import Path

from linkage.language import add_catalogue

add_catalogue("mechanisms", Path(__file__).with_name("locale"))
