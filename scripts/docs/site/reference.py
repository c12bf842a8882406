"""Pages of the API reference: each public name once, on the page of the innermost public package that exports it."""

from __future__ import annotations

import importlib
import inspect
import sys
import textwrap
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

from sphinx.pycode import ModuleAnalyzer

__all__ = ["PACKAGES", "description", "homes", "write_reference"]

PACKAGES = (
    "facade_nb",
    "facade_nb.design",
    "facade_nb.solver",
    "facade_nb.solver.trace",
    "facade_nb.solver.events",
    "facade_nb.solver.experiments",
    "facade_nb.gallery",
    "facade_nb.survey",
    "facade_nb.survey.city",
    "facade_nb.building",
    "facade_nb.variations",
    "facade_nb.comparison",
    "facade_nb.render",
    "facade_nb.render.exchange",
    "facade_nb.render.texture",
    "facade_nb.render.tiles",
    "facade_nb.render.pipeline",
    "facade_nb.render.town",
    "facade_nb.course",
    "facade_nb.widgets",
)
"""Those whose `__all__` is public."""


@cache
def homes() -> dict[tuple[str, str], tuple[str, str]]:
    """For each public name, as (package, name), where it is described: the last package that exports the object.

    What has no identity of its own, such as a number or a text, is described wherever it is exported.
    """
    last: dict[int, tuple[str, str]] = {}
    for package, name, value in _exports():
        if not isinstance(value, str | int | float | tuple):
            last[id(value)] = (package, name)
    return {(package, name): last.get(id(value), (package, name)) for package, name, value in _exports()}


def _exports() -> list[tuple[str, str, Any]]:
    found = []
    for package in PACKAGES:
        module = importlib.import_module(package)
        found += [(package, name, getattr(module, name)) for name in sorted(module.__all__)]
    return found


def write_reference(folder: Path) -> list[str]:
    """Write the pages; give their names."""
    (folder / "api").mkdir(parents=True, exist_ok=True)
    pages = []
    for package in PACKAGES:
        (folder / "api" / f"{package}.md").write_text(_page(package), "utf-8")
        pages.append(f"api/{package}")
    return pages


def _page(package: str) -> str:
    module = importlib.import_module(package)
    parts = [f"# {package}\n", f"```{{eval-rst}}\n{inspect.getdoc(module) or ''}\n```\n"]
    elsewhere = []
    for name in sorted(module.__all__):
        value, home = getattr(module, name), homes()[package, name]
        if isinstance(value, ModuleType):
            parts.append(f"- `{name}`: the module [{value.__name__}]({value.__name__}.md)\n")
        elif home != (package, name):
            elsewhere.append(f"| [`{name}`](#{'.'.join(home)}) | `{home[0]}` |")
        else:
            parts.append(_entry(package, name, value))
    if elsewhere:
        parts[2:2] = ["| exported here too | described in |\n|---|---|\n" + "\n".join(elsewhere) + "\n"]
    return "\n".join(parts)


def _entry(package: str, name: str, value: Any) -> str:
    if not inspect.isclass(value) and not callable(value):
        described = textwrap.indent(description(name, value), "   ")
        return _block(name, f".. py:data:: {package}.{name}\n\n{described}")
    if not inspect.isclass(value):
        return _block(name, f".. autofunction:: {package}.{name}")
    kind = "exception" if issubclass(value, Exception) else "class"
    return _block(name, f".. auto{kind}:: {package}.{name}\n   :members:")


def _block(name: str, text: str) -> str:
    return f"## {name}\n\n```{{eval-rst}}\n{text}\n```\n"


def description(name: str, value: Any) -> str:
    """What is said of a public object: its docstring, or what stands below it where it is set; "" for nothing."""
    if inspect.isclass(value) or callable(value) or isinstance(value, ModuleType):
        return inspect.getdoc(value) or ""
    for module in [m for key, m in sorted(sys.modules.items()) if key.startswith("facade_nb")]:
        if vars(module).get(name) is value and (told := _told(module.__name__).get(("", name))):
            return "\n".join(told).strip()
    return ""


@cache
def _told(module: str) -> dict[tuple[str, str], list[str]]:
    return dict(ModuleAnalyzer.for_module(module).find_attr_docs())
