"""A mechanism as a file: TOML or JSON, with the same names as the class form. A file is data: nothing in it is run."""

from .read import from_dict as from_dict
from .read import load as load
from .write import left_out as left_out
from .write import save as save
from .write import to_dict as to_dict
from .write import to_json as to_json
from .write import to_toml as to_toml
