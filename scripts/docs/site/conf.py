"""Sphinx reads this. The pages are those that `staging` has laid out."""

from __future__ import annotations

import inspect
import re
from typing import Any

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
pygments_style = "default"
pygments_dark_style = "github-dark"

default_role = "code"  # docstrings write `names` so
autodoc_typehints = "signature"
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
napoleon_google_docstring = False
napoleon_use_rtype = False
napoleon_use_ivar = True


_COLON = "\ue000"


def _whole(_: Sphinx, what: str, __: str, ___: object, ____: object, lines: list[str]) -> None:
    """Keep the sentence of a property whole: before a colon, napoleon would see its type."""
    if what == "property" and lines:
        lines[0] = lines[0].replace(":", _COLON)


def _readable(_: Sphinx, __: str, ___: str, ____: object, _____: object, lines: list[str]) -> None:
    """Let a bar in a docstring be a bar, as in ``|W - canvas|``, and names that are told together be names."""
    for at, line in enumerate(lines):
        line = re.sub(r"(`[^`]*`)|\|", lambda found: found[1] or r"\|", line.replace(_COLON, ":"))
        lines[at] = re.sub(
            r"^(\s*:(?:ivar|param) )([\w, ]+:)", lambda found: found[1] + found[2].replace(", ", ","), line
        )


def _signature(
    _: Sphinx, what: str, __: str, value: object, ___: object, told: str | None, returned: str
) -> Any:
    """How a widget is made: traitlets hides it. And where a field begins with what a function makes, an ellipsis."""
    if what == "class" and told and "**kwargs: t.Any" in told:
        own = inspect.signature(value.__init__)  # type: ignore[misc]
        told = str(own.replace(parameters=list(own.parameters.values())[1:], return_annotation=own.empty))
    return (told.replace("<factory>", "..."), returned) if told else None


def setup(app: Sphinx) -> None:
    app.connect("autodoc-process-docstring", _whole, priority=400)
    app.connect("autodoc-process-docstring", _readable)
    app.connect("autodoc-process-signature", _signature)
