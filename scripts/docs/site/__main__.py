"""Make the site: ``python -m scripts.docs.site [FOLDER]``; without one, in ``out/site``.

Warnings are errors: a dead link, a page that no table of contents has, a docstring that cannot be read.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from sphinx.cmd.build import build_main

from .checking import faults
from .contents import toctrees
from .previews import states
from .reference import write_reference
from .staging import stage, with_previews

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]


def lay_out(folder: Path) -> None:
    """All that Sphinx reads."""
    live = folder / "_static" / "live"
    subprocess.run(["node", HERE / "bundle.mjs", live], check=True)
    shutil.copyfile(HERE / "site.css", folder / "_static" / "site.css")
    shutil.copyfile(HERE / "front.md", folder / "index.md")
    shutil.copyfile(HERE / "conf.py", folder / "conf.py")
    pages = [*stage(ROOT, folder), *write_reference(folder)]
    with (folder / "index.md").open("a", encoding="utf-8") as index:
        index.write("\n" + toctrees(pages))
    with_previews(folder, ["index", *pages], states)


def main(out: Path) -> int:
    """Make the site; 0 if all is well."""
    shutil.rmtree(out, ignore_errors=True)
    with tempfile.TemporaryDirectory() as staged:
        lay_out(Path(staged))
        options = ["-q", "-b", "html", "-W", "--keep-going"]
        status = build_main([*options, "-d", f"{staged}/.doctrees", staged, str(out)])
    if status:
        return status
    shutil.rmtree(out / ".doctrees", ignore_errors=True)
    found = faults(out)
    for fault in found:
        print(fault, file=sys.stderr)
    if not found:
        first = out / "index.html"
        print(f"{len(list(out.rglob('*.html')))} pages, the first: {os.path.relpath(first)}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else ROOT / "out" / "site"))
