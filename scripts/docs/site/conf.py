"""Sphinx reads this. The pages are those that `staging` has laid out."""

from __future__ import annotations

import re

from sphinx.application import Sphinx

import facade_nb

project = "facade_nb"
author = "facade_nb authors"
copyright = "facade_nb authors, MIT licence"
version = release = facade_nb.__version__

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
source_suffix = {".md": "myst-nb", ".ipynb": "myst-nb", ".rst": "restructuredtext"}
exclude_patterns = ["_static"]
templates_path: list[str] = []

# Notebooks are shown as they were saved.
nb_execution_mode = "off"
nb_ipywidgets_js: dict[str, dict[str, str]] = {}
myst_heading_anchors = 6
myst_enable_extensions = ["attrs_inline", "colon_fence", "deflist"]
# What a page quotes from a notebook or a shell has its own signs, and need not be coloured. Of attributes
# that many classes have, such as `width`, a docstring means none of them.
suppress_warnings = ["misc.highlighting_failure", "ref.python"]

html_theme = "furo"
html_title = "facade_nb"
html_static_path = ["_static"]
html_css_files = ["live/live.css", "site.css"]
html_js_files = [("live/live.js", {"defer": "defer"})]
html_copy_source = False
html_show_sphinx = False
html_theme_options = {
    "light_css_variables": {"color-brand-primary": "#0d5f9e", "color-brand-content": "#0d5f9e"},
    "dark_css_variables": {"color-brand-primary": "#6cb8f2", "color-brand-content": "#6cb8f2"},
}
pygments_style = "friendly"
pygments_dark_style = "github-dark"

default_role = "code"  # docstrings write `names` so
autodoc_typehints = "signature"
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True


def _bars(_: Sphinx, __: str, ___: str, ____: object, _____: object, lines: list[str]) -> None:
    """Let a bar in a docstring be a bar, as in ``|W - canvas|``; within backticks it is one already."""
    for at, line in enumerate(lines):
        lines[at] = re.sub(r"(`[^`]*`)|\|", lambda found: found[1] or r"\|", line)


def _signature(*told: object) -> tuple[str, str | None] | None:
    """Let what a field begins with be an ellipsis where a function makes it: then the signature can be read."""
    signature, returned = told[-2:]
    return (signature.replace("<factory>", "..."), returned) if isinstance(signature, str) else None


def setup(app: Sphinx) -> None:
    app.connect("autodoc-process-docstring", _bars)
    app.connect("autodoc-process-signature", _signature)
