"""A façade's derivation by splits, drawn: its cuts are those of the split grammar, its rules those an edit touches."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest

from facade_nb import Layout, gallery, solve
from facade_nb.comparison import edits
from facade_nb.design import Design
from facade_nb.design.edit import remove_layer
from facade_nb.render import rules_svg, split_grammar, splits_svg
from facade_nb.render.splits import Node, Shape, Split, children, rules_of, split_tree

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def house() -> Layout:
    return solve(gallery.load("residential-house"))


def legend(svg: str) -> list[str]:
    """The words under a drawing."""
    return [text.text or "" for text in ET.fromstring(svg).iter(f"{SVG}text")]


def cuts(layout: Layout, levels: int | None = None) -> dict[str, int]:
    """How many cuts the derivation makes along each axis, counted node by node."""
    found = {"x": 0, "y": 0}

    def follow(node: Node, depth: int) -> None:
        if isinstance(node, Split):
            if levels is not None and depth >= levels:
                return
            found[node.axis] += len(node.parts) - 1
            depth += 1
        for child in children(node):
            follow(child, depth)

    follow(split_tree(layout), 0)
    return found


@pytest.mark.parametrize("levels", [None, 0, 1, 2])
@pytest.mark.parametrize("theme", ["light", "dark"])
def test_each_cut_is_drawn_once_as_deep_as_asked_for(house: Layout, levels: int | None, theme: str) -> None:
    svg = splits_svg(house, levels=levels, theme=theme)
    told = cuts(house, levels)
    assert f"{told['y']} cuts across, split(y)" in legend(svg)
    assert f"{told['x']} cuts upwards, split(x)" in legend(svg)
    outer = ET.fromstring(svg)
    samples = 3  # lines of the legend
    lines = [path for path in outer.findall(f"{SVG}path") if "stroke-width" in path.attrib]
    assert len(lines) == told["x"] + told["y"] + samples


def test_the_first_floor_line_lies_where_the_layout_has_it(house: Layout) -> None:
    """The house is cut into floors first; the lowest cut is the sill of the first floor."""
    svg = ET.fromstring(splits_svg(house, levels=1))
    drawing = next(svg.iter(f"{SVG}svg"))
    inner = next(each for each in drawing if each.tag == f"{SVG}svg")
    scale, (left, bottom) = float(inner.attrib["data-scale"]), map(float, inner.attrib["data-origin"].split())
    root = split_tree(house)
    assert isinstance(root, Split)
    height = root.parts[0][0]
    d = f"M{left:g} {round(bottom - height * scale, 2):g}L{round(left + 6 * scale, 2):g} "
    assert [path for path in svg.findall(f"{SVG}path") if path.attrib["d"].startswith(d)]


def test_each_rule_has_its_parts_once_and_its_text_to_read(house: Layout) -> None:
    svg = ET.fromstring(rules_svg(house))
    titles = [title.text or "" for title in svg.iter(f"{SVG}title")]
    rules = split_grammar(house).splitlines()
    assert next(title for title in titles if "-->" in title) == rules[0]
    assert {title for title in titles if "-->" in title} == set(rules)
    named = {node.name for node in map(_leaf, rules_of(split_tree(house))) if node}
    assert {title for title in titles if "-->" not in title} >= named


def _leaf(node: Node) -> Shape | None:
    found = [child for child in children(node) if isinstance(child, Shape)]
    return found[0] if found else None


@pytest.mark.parametrize(("name", "layer"), [("teaser", "hall"), ("residential-house", "door")])
def test_the_rules_that_an_edit_touches_are_filled(name: str, layer: str) -> None:
    after = gallery.load(name)
    before = remove_layer(after, layer)
    svg = rules_svg(solve(after), solve(before))
    filled = svg.count('fill-opacity="0.85"')
    told = legend(svg)[-1]
    assert f"filled: {filled} that are new or changed" in told
    gone = edits(before, after).split_rules - filled
    assert filled > 0
    assert gone >= 0
    assert 'fill-opacity="0.85"' not in rules_svg(solve(after), solve(after))


def test_a_name_is_text(house: Layout) -> None:
    design = gallery.load("residential-house")
    document = design.to_dict() | {"name": "<b>&"}
    layout = solve(Design.from_dict(document))
    for svg in (splits_svg(layout), rules_svg(layout)):
        assert "<b>" not in svg
        assert "&lt;b&gt;&amp;" in svg


def test_a_layout_without_shapes_has_no_rules() -> None:
    empty = solve(Design(name="Nothing"))
    assert legend(splits_svg(empty))[-3].startswith("0 cuts across")
    with pytest.raises(ValueError, match="expected a layout with shapes; Nothing has none"):
        rules_svg(empty)
