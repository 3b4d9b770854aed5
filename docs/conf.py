"""The docs site: `make docs` builds it into build/docs.

The site works from file:// and loads nothing from a network.
"""

from __future__ import annotations

import sys
from pathlib import Path

import snapspace

sys.path.insert(0, str(Path(__file__).parent / "site"))

project = "Snapspace"
version = release = snapspace.__version__
project_copyright = "Snapspace contributors"

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx_click",
    "mathml",  # this one and the next two are in docs/site
    "docstrings",
    "name_links",
]
exclude_patterns = ["site", "generated/*.txt"]
templates_path = ["site/templates"]

smartquotes = False  # keeps the two dashes of options

html_theme = "furo"
html_title = "Snapspace"
html_copy_source = False
html_show_sphinx = False

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4  # anchors as on GitHub
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 120
nb_merge_streams = True

autosummary_generate = True
autodoc_member_order = "bysource"
autodoc_typehints = "none"  # docstrings have types and shapes
autodoc_default_options = {"members": True}
napoleon_google_docstring = False
napoleon_use_rtype = False
default_role = "py:obj"  # `names` in docstrings become links where possible
suppress_warnings = ["ref.python"]  # if two attributes share a name, a link may go to either
