"""Sphinx settings; `./run docs` builds the pages into docs/_build, with every live page and machine's page made anew."""

import gc
import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).parent
gc.set_threshold(100_000)  # pages read are many lasting objects: with Python's 700 the collector takes a sixth of the time
sys.path[:0] = [each for each in (str(HERE), str(HERE.parent)) if each not in sys.path]

_project = tomllib.loads((HERE.parent / "pyproject.toml").read_text(encoding="utf-8"))["project"]

project = _project["name"]
author = "the hydrolinkage developers"
copyright = f"2026 {author}"
version = release = _project["version"]

extensions = ["myst_parser", "sphinx.ext.autodoc", "made", "sphinx.ext.napoleon"]  # `made` reads docstrings first
myst_enable_extensions = ["amsmath", "attrs_block", "attrs_inline", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
exclude_patterns = ["_build", "_generated/extra", "_generated/api/extra", "**.ipynb", "**.py"]

default_role = "code"  # docstrings write `names` as Markdown does
autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the first lines say shapes and units; types are for checkers
autodoc_preserve_defaults = True
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_param = False
napoleon_custom_sections = [("Attributes", "params_style")]  # listed as parameters are: properties among them are described once
python_maximum_signature_line_length = 88

html_theme = "furo"
html_title = project
html_math_renderer = "mathml"  # browsers set formulas themselves: nothing is fetched, and they are there without a network
html_copy_source = False
html_extra_path = ["_generated/extra"]
(HERE / "_generated" / "extra").mkdir(parents=True, exist_ok=True)  # Sphinx looks for it before the pages are made
html_static_path = ["static"]
html_css_files = ["pages.css"]
html_search_scorer = str(HERE / "_generated" / "scorer.js")
html_theme_options = {"navigation_with_keys": True}
linkcheck_ignore = [r"http://localhost.*"]
