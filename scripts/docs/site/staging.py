"""The pages laid out for Sphinx, as they lie in the repository: so the links between them hold here and there alike."""

from __future__ import annotations

import hashlib
import json
import re
import shutil
from collections.abc import Callable, Iterable
from html import escape
from pathlib import Path, PurePosixPath
from typing import Any

__all__ = ["STATE", "Notebook", "place", "saved", "stage", "write_state"]

VIEW = "application/vnd.jupyter.widget-view+json"
STATE = "application/vnd.jupyter.widget-state+json"
STATES = PurePosixPath("_static/live")
PAGES = ("docs/*.md", "tutorials/*.ipynb", "notebooks/*.ipynb", "CONTRIBUTING.md", "CHANGELOG.md")
FILES = ("docs/img/*", "docs/*.json", "CITATION.cff", "LICENSE")
MARK = re.compile(r"^<!-- live: ([\w-]+) -->$", re.MULTILINE)
MOMENT = re.compile(r"\[([^\]]+)\]\((#facade-nb=[^)]*)\)")
"""A link that a view follows: no place of the page has its name."""

CODE = ("module", "css")
"""What a model that carries the front end's code has (widgets/shared/bundled.py)."""

SAVED = "fnb-as-saved"
"""The class of a static form that stands in an output of its own."""

Notebook = dict[str, Any]
Previews = Callable[[list[str]], tuple[Notebook, list[tuple[str, str]]]]


def stage(root: Path, folder: Path) -> list[str]:
    """Copy pages and what they show; give the names of the pages, without their endings."""
    pages = []
    for pattern in (*PAGES, *FILES):
        for source in sorted(root.glob(pattern)):
            name = source.relative_to(root)
            target = folder / name
            target.parent.mkdir(parents=True, exist_ok=True)
            if source.suffix == ".ipynb":
                target.write_text(
                    json.dumps(saved(folder, name, json.loads(source.read_text("utf-8")))), "utf-8"
                )
            else:
                shutil.copyfile(source, target)
            if pattern in PAGES:
                pages.append(name.with_suffix("").as_posix())
    return pages


def place(page: PurePosixPath, state: str, model: str, static: str) -> str:
    """Where a live view comes: until then, and without scripts, its static form is there."""
    source = "/".join([*[".."] * (len(page.parts) - 1), str(STATES / f"{state}.js")])
    told = {"source": source, "state": state, "model": model}
    data = " ".join(f'data-{name}="{escape(value)}"' for name, value in told.items())
    return f'<div class="fnb-live" {data}>\n<div class="fnb-live-still">{static}</div>\n</div>\n'


def write_state(folder: Path, name: str, state: Notebook) -> None:
    """A state as a script that hands itself over, since pages opened from a folder can fetch no file.

    The front end's code, which each notebook carries, goes into a file of its own: pages that have the same share it.
    """
    models = {}
    for number, model in state.get("state", {}).items():
        own = model.get("state", {})
        code = {key: own[key] for key in CODE if key in own}
        models[number] = model
        if all(code.values()) and len(code) == len(CODE):
            key = hashlib.sha256(json.dumps(code).encode()).hexdigest()[:16]
            _write_script(folder, f"code-{key}", code)
            rest = {name: value for name, value in own.items() if name not in CODE}
            models[number] = {**model, "state": rest, "code": f"code-{key}"}
    _write_script(folder, name, {**state, "state": models})


def _write_script(folder: Path, name: str, content: Notebook) -> None:
    target = folder / STATES / f"{name}.js"
    target.parent.mkdir(parents=True, exist_ok=True)
    text = json.dumps(content, ensure_ascii=False, separators=(",", ":"))
    target.write_text(f"facadeNbState({json.dumps(name)},{text});\n", "utf-8")


def saved(folder: Path, page: Path | PurePosixPath, notebook: Notebook) -> Notebook:
    """A notebook whose widgets have places, and whose widgets' state lies in a file of its own."""
    state = notebook["metadata"].pop("widgets", {}).get(STATE)
    name = page.stem
    if state:
        write_state(folder, name, state)
    notebook["metadata"]["language_info"] = {"name": "python", "pygments_lexer": "ipython3"}
    for cell in notebook["cells"]:
        if cell["cell_type"] == "markdown":
            cell["source"] = MOMENT.sub(r'<a href="\2">\1</a>', "".join(cell["source"]))
        for output in list(cell.get("outputs", [])):
            data = output.get("data", {})
            view = data.pop(VIEW, None)
            if view and state and view["model_id"] in state["state"]:
                static = _static(cell["outputs"], cell["outputs"].index(output))
                data["text/html"] = place(PurePosixPath(page), name, view["model_id"], static)
    return notebook


def _static(outputs: list[Notebook], at: int) -> str:
    """The static form of a widget: its own, or that of the output after it, which goes (`apart` in scripts)."""
    own = "".join(outputs[at]["data"].get("text/html", ""))
    after = "".join(outputs[at + 1].get("data", {}).get("text/html", "")) if at + 1 < len(outputs) else ""
    if SAVED not in after:
        return own
    del outputs[at + 1]
    return after


def with_previews(folder: Path, pages: Iterable[str], states: Previews) -> None:
    """Put live views where pages say ``<!-- live: name -->``; `states` makes those of a page together."""
    for page in pages:
        path = folder / f"{page}.md"
        text = path.read_text("utf-8") if path.is_file() else ""
        names = MARK.findall(text)
        if not names:
            continue
        state, views = states(names)
        name = f"{path.stem}-views"
        write_state(folder, name, state)
        path.write_text(_with_places(text, PurePosixPath(page), name, views), "utf-8")


def _with_places(text: str, page: PurePosixPath, state: str, views: Iterable[tuple[str, str]]) -> str:
    """A page's text with a place for each of its views."""
    made = iter(views)
    return MARK.sub(lambda _: place(page, state, *next(made)), text)
