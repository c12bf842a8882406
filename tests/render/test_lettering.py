"""What is written on signs: letters with accents are drawn, and letters that there are no strokes for are named."""

from __future__ import annotations

import pytest

from facade_nb import Design, solve
from facade_nb.render import DrawingWarning, drawing_faults, elevation_svg
from facade_nb.render.lettering import LETTERS, MARKS, lettered, undrawn


def written(text: str) -> int:
    """How many strokes a text has, in a wide room."""
    return len(list(lettered(text, 0, 0, 40, 7, 0, 1, "letters")))


def test_a_letter_with_accents_is_its_plain_letter_and_their_strokes() -> None:
    for mark in MARKS:
        for plain in "AEO":
            assert written(plain + mark) > written(plain), (plain, mark)
    assert written("é") == written("E") + 1 == written("E\u0301")
    assert written("straße") > written("strae")


def test_strokes_stay_on_their_grid_and_have_a_length() -> None:
    for text in [*LETTERS, *(f"O{mark}" for mark in MARKS), "Ǖ", "Ệ"]:
        for stroke in lettered(text, 0, 0, 5, 7, 0, 1, "letters"):
            assert all(-0.5 <= x <= 5.5 and -0.5 <= y <= 7.5 for x, y in stroke.points), text


@pytest.mark.parametrize(
    ("text", "lacking"),
    [
        ("Café Müller, Çà, Škoda, Łódź, Ångström, Øl & Æble – «¿Qué?»", []),
        ("Жук: Café", ["Ж", "У", "К"]),
        ("日本 No. 1, 日", ["日", "本"]),
        ("½ price", ["½"]),
    ],
)
def test_what_the_lettering_lacks_is_named(text: str, lacking: list[str]) -> None:
    assert undrawn(text) == lacking
    sign = {"geometry": f"sign(text={text.replace(',', '')})"}
    layout = solve(
        Design.from_dict(
            {
                "format": "facade-nb/design/1",
                "canvas": {"width": 6, "height": 1},
                "symbols": {"A": {"size": 6}, "P": {"size": 1}},
                "patterns": {"w": "A", "v": "P"},
                "layers": [{"name": "shop", "x": {"pattern": "w"}, "y": {"pattern": "v"}}],
                "shapes": {"A P": sign},
            }
        )
    )
    told = [str(fault) for fault in drawing_faults(layout)]
    if lacking:
        with pytest.warns(DrawingWarning):
            elevation_svg(layout)
        assert told == [
            "shapes[\"A P\"] in layer 'shop': geometry: text of sign: the lettering has no "
            f"{', '.join(map(repr, lacking))}; a blank is left there"
        ]
    else:
        assert told == []
