"""Shipped machines, one file each."""

from pathlib import Path

from linkage.language import add_catalogue
from linkage.star import declare_public

add_catalogue("mechanisms", Path(__file__).with_name("locale"))

declare_public(globals())
