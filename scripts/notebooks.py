"""Run notebooks and save them as they are kept here: with outputs and widget state, without times.

python scripts/notebooks.py [NAME ...]     all that have widgets, or those named: solver, how-the-solver-thinks
"""

import json
import re
import sys
from collections.abc import Sequence
from pathlib import Path

import nbformat
from nbclient import NotebookClient

ROOT = Path(__file__).resolve().parents[1]
WIDGETS = (
    "studio",
    "solver",
    "texture",
    "town",
    "inference",
    "variations",
    "figures",
    "survey",
    "benchmarks",
    "buildings",
    "comparison",
)
"""Those in `notebooks` that have widgets; all in `tutorials` have."""
PICTURE = "picture"
"""A cell with this tag is saved with its picture alone: without a kernel its view would have nothing to show."""

VIEW = "application/vnd.jupyter.widget-view+json"
STATE = "application/vnd.jupyter.widget-state+json"
REFERENCE = re.compile("IPY_MODEL_(\\w+)")
HIDING = "<style>.jp-OutputArea-child:has(.fnb) + .jp-OutputArea-child:has(.fnb-as-saved) { display: none }</style>"
HIDING += '<span class="fnb-as-saved"></span>'


def paths(names: Sequence[str]) -> list[Path]:
    """Those that are named; without names all that have widgets."""
    tutorials = sorted((ROOT / "tutorials").glob("*.ipynb"))
    every = {path.stem: path for path in [*sorted((ROOT / "notebooks").glob("*.ipynb")), *tutorials]}
    if unknown := [name for name in names if name not in every]:
        sys.exit(f"expected some of {', '.join(every)}, not {', '.join(unknown)}")
    return [every[name] for name in names or (*WIDGETS, *(path.stem for path in tutorials))]


def apart(notebook: nbformat.NotebookNode) -> None:
    """Let the static form of each widget stand in an output of its own.

    A page that was made without widgets, such as nbconvert's, would show neither: it takes the widget of an output that
    has both. Where the widget is shown, the static form after it hides itself.
    """
    for cell in notebook.cells:
        for output in list(cell.get("outputs", [])):
            data = output.get("data", {})
            if VIEW in data and "text/html" in data:
                static = nbformat.v4.new_output("display_data", {"text/html": HIDING + data.pop("text/html")})
                cell.outputs.insert(cell.outputs.index(output) + 1, static)


def pictured(notebook: nbformat.NotebookNode) -> None:
    """Take the widgets of tagged cells away, and of the state what no view is left for."""
    views = []
    for cell in notebook.cells:
        for output in list(cell.get("outputs", [])):
            data = output.get("data", {})
            if VIEW not in data:
                continue
            if PICTURE not in cell.metadata.get("tags", ()):
                views.append(data[VIEW]["model_id"])
            elif "text/html" in data:
                data.pop(VIEW)
            else:
                cell.outputs.remove(output)
    state = notebook.metadata.get("widgets", {}).get(STATE, {}).get("state", {})
    needed, ahead = set(), views
    while ahead:
        own = ahead.pop()
        if own in state and own not in needed:
            needed.add(own)
            ahead += REFERENCE.findall(json.dumps(state[own]["state"]))
    for own in set(state) - needed:
        del state[own]
    if not state:
        notebook.metadata.pop("widgets", None)


def write(notebook: nbformat.NotebookNode, path: Path) -> None:
    """Save a notebook, its widgets in one line: nobody reads them, and they take less room."""
    pictured(notebook)
    apart(notebook)
    widgets = notebook.metadata.get("widgets")
    for model in (widgets or {}).get(STATE, {}).get("state", {}).values():
        if model["model_name"] == "LayoutModel":  # what is None there is so without being told
            model["state"] = {key: value for key, value in model["state"].items() if value is not None}
    here = "the widgets"
    if widgets is not None:
        notebook.metadata["widgets"] = here
    text = nbformat.writes(notebook) + "\n"
    packed = json.dumps(widgets, ensure_ascii=False, sort_keys=True, separators=(",", ":"))
    path.write_text(text.replace(f'"widgets": "{here}"', f'"widgets": {packed}'), encoding="utf-8")


def main(names: Sequence[str]) -> None:
    for path in paths(names):
        notebook = nbformat.read(path, as_version=4)
        client = NotebookClient(
            notebook, timeout=120, kernel_name="python3", resources={"metadata": {"path": str(path.parent)}}
        )
        client.execute()
        notebook.metadata.pop("language_info", None)
        for cell in notebook.cells:
            cell.metadata.pop("execution", None)
        write(notebook, path)
        print(f"{path.relative_to(ROOT)}  {path.stat().st_size / 1000:.1f} kB")


if __name__ == "__main__":
    main(sys.argv[1:])
