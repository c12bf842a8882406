"""Solve the town's solved fronts anew and write them as text: after a change of their designs or of what makes rules.

Run as ``python scripts/fronts.py``. tests/render/town/test_styles.py fails where the text is out of date.
"""

from __future__ import annotations

from pathlib import Path

from facade_nb import gallery
from facade_nb.render.town.solved import solve_text

if __name__ == "__main__":
    path = Path(gallery.__file__).parent / "town" / "solved.txt"
    path.write_text(solve_text(), encoding="utf-8")
    print(f"{path.name}: {path.stat().st_size:,} bytes")
