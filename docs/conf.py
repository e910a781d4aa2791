"""Sphinx settings; `./run docs` builds the pages into docs/_build."""

import tomllib
from pathlib import Path

_project = tomllib.loads((Path(__file__).parents[1] / "pyproject.toml").read_text(encoding="utf-8"))["project"]

project = _project["name"]
author = "the hydrolinkage developers"
copyright = f"2026 {author}"
version = release = _project["version"]

extensions = ["myst_parser"]
myst_enable_extensions = ["amsmath", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
exclude_patterns = ["_build"]

html_theme = "alabaster"
html_theme_options = {"description": _project["description"], "page_width": "1100px"}
