"""PDF, read again by pypdf; where its texts stand is told by pypdfium2, which draws it too."""

from __future__ import annotations

import re
from functools import cache
from io import BytesIO
from itertools import combinations
from pathlib import Path

import pypdfium2
import pytest
from pypdf import PdfReader

from facade_nb import DesignError, Layout
from facade_nb.render import to_pdf, write_pdf
from facade_nb.render.exchange.schedule import items

from .samples import NAMES, QUICK, layout, shape, solved, wall_with_window

SCALES = {
    "apartment-house": 100,
    "bookshop": 100,
    "concert-hall": 200,
    "figure-2": 50,
    "figure-7": 50,
    "figure-8": 50,
    "ingolstadt-4018215": 100,
    "qualifiers-a": 20,
    "qualifiers-b": 20,
    "qualifiers-c": 20,
    "qualifiers-d": 20,
    "residential-house": 20,
    "teaser": 100,
    "terraced-house": 100,
}
"""By hand: 21 m at 1:50 are the whole width of the paper; 14.65 m are its height, without room for a dimension."""


@cache
def drawn(name: str, units: str = "m") -> bytes:
    return to_pdf(solved(name), units)


def text_of(data: bytes) -> str:
    (page,) = PdfReader(BytesIO(data)).pages
    width, height = (float(value) * 25.4 / 72 for value in page.mediabox[2:])
    assert (round(width, 2), round(height, 2)) == (420, 297)
    assert not page.images  # vectors
    return page.extract_text()


def scale_of(own: Layout) -> int:
    (found,) = set(re.findall(r"1:(\d+)", text_of(to_pdf(own))))
    return int(found)


def test_a_mark_stands_on_what_it_names() -> None:
    """A door before a window, a panel before half of another: no mark of what is covered, none on what covers."""
    own = layout(
        12, 3,
        shape((0, 0, 12, 3)),
        shape((1, 0, 3, 2), "window", layer="windows", geometry="window"),
        shape((5, 0, 9, 2), "window", layer="windows", geometry="window"),
        shape((1, 0, 3, 2.5), "door", layer="doors", geometry="door"),
        shape((5, 0, 8, 2), "wall", layer="panels"),
    )  # fmt: skip
    found: dict[str, list[float]] = {}

    def visit(text: str, frame: list[float], at: list[float], *_: object) -> None:
        if re.fullmatch(r"[WD]\d", text.strip()):
            found.setdefault(text.strip(), []).append((frame[0] * at[4] + frame[4]) / 72 * 25.4)

    (page,) = PdfReader(BytesIO(to_pdf(own))).pages
    page.extract_text(visitor_text=visit)
    assert {mark: len(places) for mark, places in found.items()} == {"W1": 2, "W2": 1, "D1": 2}
    assert (min(found["W1"]) - min(found["D1"])) / 20 == pytest.approx(
        8.5 - 2, abs=0.05
    )  # 1:50, 20 mm a metre


@pytest.mark.parametrize("name", NAMES)
def test_name_scale_size_and_schedule(name: str) -> None:
    own = solved(name)
    text = text_of(drawn(name))
    canvas = own.canvas
    assert own.name in text and f"{canvas.width:.2f} × {canvas.height:.2f} m" in text and "Date" in text
    (scale,) = {int(found) for found in re.findall(r"1:(\d+)", text)}
    assert scale == SCALES[name]
    for item in items(own):
        assert re.search(rf"\b{item.mark}\b", text)
    assert f"{canvas.width:.2f}" in text and f"{canvas.height:.2f}" in text


def test_it_is_drawn_to_scale() -> None:
    """4 m by 3 m at 1:20 are 200 mm by 150 mm: seen in the dark pixels of the heavy outline."""
    own = wall_with_window(4.0, 3.0)
    page = pypdfium2.PdfDocument(to_pdf(own))[0]
    per_mm = 8.0
    image = page.render(scale=per_mm * 25.4 / 72, grayscale=True).to_numpy()
    assert scale_of(own) == 20
    middle = image[int(image.shape[0] * 0.4)] < 60
    dark = [x / per_mm for x in middle.nonzero()[0].tolist() if 20 < x / per_mm < 400]
    assert max(dark) - min(dark) == pytest.approx(200, abs=1.0)


@pytest.mark.parametrize("units", ["m", "ft"])
@pytest.mark.parametrize("name", QUICK)
def test_texts_do_not_collide(name: str, units: str) -> None:
    page = pypdfium2.PdfDocument(drawn(name, units))[0].get_textpage()
    boxes = [page.get_rect(k) for k in range(page.count_rects())]
    assert len(boxes) > 20
    for one, two in combinations(boxes, 2):
        wide = min(one[2], two[2]) - max(one[0], two[0])
        tall = min(one[3], two[3]) - max(one[1], two[1])
        assert min(wide, tall) < 0.3, (page.get_text_bounded(*one), page.get_text_bounded(*two))
    left, bottom, right, top = (
        f(side) for f, side in zip((min, min, max, max), zip(*boxes, strict=True), strict=True)
    )
    assert left > 10 and bottom > 10 and right < 1180 and top < 832  # within the frame


@pytest.mark.parametrize(
    ("width", "scale"), [(3.0, 20), (15.0, 50), (35.0, 100), (70.0, 200), (71.0, 200), (90.0, 500)]
)
def test_the_largest_scale_that_fits(width: float, scale: int) -> None:
    assert scale_of(layout(width, 3.0, shape((0, 0, width, 3)))) == scale


def test_what_is_too_large_for_the_common_scales() -> None:
    assert scale_of(layout(300.0, 20.0, shape((0, 0, 300, 20)))) == 1000
    assert scale_of(layout(5.0, 60.0, shape((0, 0, 5, 60)))) == 500


def test_feet_and_inches() -> None:
    text = text_of(to_pdf(wall_with_window(4.0, 3.0), units="ft"))
    assert "13'-1 1/2\"" in text and "feet and inches" in text and "ft²" in text
    assert "21.53" in text  # square feet of the window
    with pytest.raises(ValueError, match="units"):
        to_pdf(wall_with_window(), units="yd")


def test_a_long_schedule_is_cut_and_says_so() -> None:
    shapes = [shape((0, 0, 1 + k / 1000, 1), "window", layer=str(k)) for k in range(900)]
    text = text_of(to_pdf(layout(2.0, 1.0, *shapes)))
    (left_out,) = re.findall(r"and (\d+) more rows", text)
    assert text.count("card") == 900 - int(left_out)
    assert int(left_out) > 0


@pytest.mark.parametrize("name", ["Haus Größe", "Дом на углу", "东京の家", "Οἶκος", "a" * 300, ""])
def test_any_name_is_written(name: str) -> None:
    own = layout(3, 2, shape((0, 0, 3, 2)), name=name)
    text = text_of(to_pdf(own))
    assert (name if len(name) < 100 else "aaaa") in text


def test_an_empty_layout_is_a_sheet_with_its_size() -> None:
    text = text_of(to_pdf(layout(3, 2)))
    assert "3.00 × 2.00 m" in text


def test_the_same_layout_gives_the_same_bytes(tmp_path: Path) -> None:
    path = write_pdf(wall_with_window(), tmp_path / "a.pdf")
    assert path.read_bytes() == to_pdf(wall_with_window())
    with pytest.raises(DesignError, match=r'shapes\["A P"\] in layer \'base\''):
        write_pdf(layout(1, 1, shape((0, 0, 1, 1), geometry="bax")), tmp_path / "b.pdf")
    assert [p.name for p in tmp_path.iterdir()] == ["a.pdf"]
