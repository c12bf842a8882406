"""DXF, read again by ezdxf."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from itertools import combinations, pairwise
from pathlib import Path
from typing import Any

import ezdxf
import pytest
from ezdxf.fonts.fonts import make_font

from facade_nb import DesignError, Layout
from facade_nb.render import write_dxf
from facade_nb.render.exchange.dxf import layer_of

from .samples import NAMES, QUICK, layout, shape, solved, wall_with_window


def read(own: Layout, folder: Path, **options: str) -> Any:
    """The drawing as another program has it."""
    document = ezdxf.readfile(write_dxf(own, folder / "a.dxf", **options))
    auditor = document.audit()
    assert not auditor.errors and not auditor.fixes
    return document


def rectangles(document: Any, layer: str) -> Counter[tuple[float, ...]]:
    found: Counter[tuple[float, ...]] = Counter()
    for line in document.modelspace().query(f'LWPOLYLINE[layer=="{layer}"]'):
        points = list(line.get_points("xy"))
        assert line.closed and len(points) == 4
        xs, ys = zip(*points, strict=True)
        found[tuple(round(v, 6) for v in (min(xs), min(ys), max(xs), max(ys)))] += 1
    return found


@pytest.mark.parametrize("name", NAMES)
def test_every_shape_on_the_layer_of_its_kind(name: str, tmp_path: Path) -> None:
    own = solved(name)
    document = read(own, tmp_path)
    assert document.dxfversion >= "AC1024" and document.header["$INSUNITS"] == 6
    for kind in {s.kind for s in own.shapes}:
        expected = Counter(tuple(round(v, 6) for v in s.rect) for s in own.shapes if s.kind == kind)
        assert rectangles(document, kind) == expected
    canvas = (0.0, 0.0, own.canvas.width, own.canvas.height)
    assert rectangles(document, "outline") == {tuple(round(v, 6) for v in canvas): 1}
    layers = {entity.dxf.layer for entity in document.modelspace()}
    assert layers - {s.kind for s in own.shapes} <= {
        "outline",
        "dimensions",
        "line outline",
        "line edge",
        "line fine",
    }
    weights = [document.layers.get(f"line {w}").dxf.lineweight for w in ("outline", "edge", "fine")]
    assert weights == [50, 25, 13]
    check_chains(own, document)


def check_chains(own: Layout, document: Any) -> None:
    """Every boundary of the first group, the total, the heights; each chain adds up to the whole."""
    for across, size, axis in ((True, own.canvas.width, own.x), (False, own.canvas.height, own.y)):
        rows: dict[float, list[tuple[float, float]]] = {}
        for dimension in document.modelspace().query('DIMENSION[layer=="dimensions"]'):
            if (dimension.dxf.angle == 0) == across:
                at, k = (dimension.dxf.defpoint[1], 0) if across else (dimension.dxf.defpoint[0], 1)
                ends = (dimension.dxf.defpoint2[k], dimension.dxf.defpoint3[k])
                assert dimension.get_measurement() == pytest.approx(ends[1] - ends[0])
                rows.setdefault(round(at, 6), []).append(ends)
        assert all(at < 0 for at in rows)
        for parts in rows.values():
            parts.sort()
            assert parts[0][0] == 0 and parts[-1][1] == pytest.approx(size, abs=1e-4)
            assert all(a[1] == b[0] for a, b in pairwise(parts))
        assert [1 for parts in rows.values() if len(parts) == 1]  # the total
        stops = {round(v, 4) for parts in rows.values() for ends in parts for v in ends}
        longest = max(axis.groups.values(), key=lambda group: len(group.columns), default=None)
        if longest is not None:
            assert all(min(abs(stop - c) for stop in stops) < 2e-3 for c in longest.columns)


def texts(document: Any) -> Iterator[tuple[str, tuple[float, float, float, float]]]:
    """Each text of a dimension as it is drawn, with its box: left, bottom, right, top.

    `ezdxf.bbox` would break a text at its blanks, which no program does with a text without a width.
    """
    for dimension in document.modelspace().query("DIMENSION"):
        for entity in dimension.virtual_entities():
            if entity.dxftype() == "MTEXT" and entity.plain_text().strip():
                text, tall = entity.plain_text(), entity.dxf.char_height
                assert entity.dxf.attachment_point == 5 and not entity.dxf.hasattr("width")
                wide = make_font("arial.ttf", tall).text_width(text)
                if abs(entity.get_rotation() - 90) < 1:
                    wide, tall = tall, wide
                x, y, _ = entity.dxf.insert
                yield text, (x - wide / 2, y - tall / 2, x + wide / 2, y + tall / 2)


@pytest.mark.parametrize("units", ["m", "ft"])
@pytest.mark.parametrize("name", QUICK)
def test_texts_of_dimensions_do_not_collide(name: str, units: str, tmp_path: Path) -> None:
    found = list(texts(read(solved(name), tmp_path, units=units)))
    assert len(found) > 5
    for (a, one), (b, two) in combinations(found, 2):
        wide = min(one[2], two[2]) - max(one[0], two[0])
        tall = min(one[3], two[3]) - max(one[1], two[1])
        assert min(wide, tall) < 1e-6, (a, b)


def test_metres_and_feet(tmp_path: Path) -> None:
    own = wall_with_window(4.0, 3.0)
    metres = {text for text, _ in texts(read(own, tmp_path))}
    assert metres == {"1.00", "2.00", "4.00", "3.00"}
    document = read(own, tmp_path, units="ft")
    assert {text for text, _ in texts(document)} == {"3'-3 3/8\"", "6'-6 3/4\"", "13'-1 1/2\"", "9'-10 1/8\""}
    assert rectangles(document, "window") == {(1, 1, 3, 2): 1}  # the drawing stays in metres
    with pytest.raises(ValueError, match=r"expected 'm' .* found 'mm'"):
        write_dxf(own, tmp_path / "b.dxf", units="mm")


@pytest.mark.parametrize(
    ("kind", "layer"),
    [
        ("window", "window"),
        ("", "other"),
        (" ", "other"),
        ("Fenêtre Δ", "Fenêtre Δ"),
        ('a/b\\c<d>"e:f;g?h*i|j=k`l,m', "a_b_c_d__e_f_g_h_i_j_k_l_m"),
        ("outline", "kind outline"),
        ("Dimensions", "kind Dimensions"),
        ("line", "kind line"),
        ("lintel", "lintel"),
        ("0", "kind 0"),
        ("DEFPOINTS", "kind DEFPOINTS"),
    ],
)
def test_any_kind_is_a_layer(kind: str, layer: str, tmp_path: Path) -> None:
    assert layer_of(kind) == layer
    document = read(layout(2, 1, shape((0, 0, 2, 1), kind)), tmp_path)
    assert rectangles(document, layer) == {(0, 0, 2, 1): 1}


def test_an_empty_layout_has_an_outline_and_its_size(tmp_path: Path) -> None:
    document = read(layout(3, 2), tmp_path)
    assert rectangles(document, "outline") == {(0, 0, 3, 2): 1}
    assert sorted(text for text, _ in texts(document)) == ["2.00", "3.00"]


def test_a_faulty_layout_leaves_no_file(tmp_path: Path) -> None:
    with pytest.raises(DesignError, match=r'shapes\["A P"\] in layer \'base\': material'):
        write_dxf(layout(1, 1, shape((0, 0, 1, 1), material="brik")), tmp_path / "a.dxf")
    with pytest.raises(DesignError, match=r"cannot write.*|missing"):
        write_dxf(wall_with_window(), tmp_path / "missing" / "a.dxf")
    assert not list(tmp_path.iterdir())
