"""A mechanism as a file: TOML or JSON, with the same names as the class form. A file is data: nothing in it is run."""

from ..star import declare_public
from .read import from_dict, load
from .write import left_out, save, to_dict, to_json, to_toml

declare_public(globals())
