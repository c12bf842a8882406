"""Run notebooks and save them as they are kept here: with outputs and widget state, without times.

python scripts/notebooks.py [NAME ...]     all that have widgets, or those named: studio, solver, texture
"""

import sys
from collections.abc import Sequence
from pathlib import Path

import nbformat
from nbclient import NotebookClient

ROOT = Path(__file__).resolve().parents[1]
WIDGETS = ("studio", "solver", "texture")
STATIC = ("texture",)
"""Saved with static forms alone: the tiles would make their state too large."""


def main(names: Sequence[str]) -> None:
    for name in names or WIDGETS:
        path = ROOT / "notebooks" / f"{name}.ipynb"
        notebook = nbformat.read(path, as_version=4)
        client = NotebookClient(
            notebook, timeout=120, kernel_name="python3", resources={"metadata": {"path": str(path.parent)}}
        )
        client.execute()
        notebook.metadata.pop("language_info", None)
        for cell in notebook.cells:
            cell.metadata.pop("execution", None)
        if name in STATIC:
            notebook.metadata.pop("widgets", None)
        nbformat.write(notebook, path)
        print(f"{path.relative_to(ROOT)}  {path.stat().st_size / 1000:.1f} kB")


if __name__ == "__main__":
    main(sys.argv[1:])
