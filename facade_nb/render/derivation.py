"""The derivation of a façade by splits, drawn: its cuts over the elevation, and its rules as a hierarchy."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from html import escape
from itertools import accumulate

from ..solver.model.layout import Layout, Rect
from .annotate import FONT, Frame
from .elevation import elevation_svg
from .split_edits import touched
from .splits import Node, Shape, Split, Stack, children, rules_of, split_rules, split_tree
from .style import Style, find_style, num

__all__ = ["rules_svg", "splits_svg"]

_LINE = 16.0
_ROW, _LEAF, _WIDEST = 30.0, 30.0, 1100.0


@dataclass(slots=True)
class _Cuts:
    """What is drawn of a derivation: lines along each axis with their depth, and scopes that are drawn over."""

    lines: dict[str, list[tuple[int, float, float, float]]] = field(
        default_factory=lambda: {"x": [], "y": []}
    )
    """By axis: depth of the rule, where the cut lies, and from where to where it goes, metres."""
    stacks: list[Rect] = field(default_factory=list)

    def follow(self, node: Node, scope: Rect, depth: int, levels: int | None) -> None:
        """Take a node and what it is made of, as far as that many levels of cuts."""
        left, bottom, right, top = scope
        if isinstance(node, Stack):
            self.stacks.append(scope)
            for child in node.nodes:
                self.follow(child, scope, depth, levels)
        if not isinstance(node, Split) or (levels is not None and depth >= levels):
            return
        ends = list(accumulate(size for size, _ in node.parts))
        low, start, end = (left, bottom, top) if node.axis == "x" else (bottom, left, right)
        self.lines[node.axis] += [(depth, low + at, start, end) for at in ends[:-1]]
        for (size, child), at in zip(node.parts, ends, strict=True):
            one, two = low + at - size, low + at
            inner = (one, bottom, two, top) if node.axis == "x" else (left, one, right, two)
            self.follow(child, inner, depth + 1, levels)


def splits_svg(
    layout: Layout, *, levels: int | None = None, width_px: float | None = None, theme: str = "light"
) -> str:
    """Draw the cuts of `split_grammar` over the elevation, as Figure 9 of the layer paper does.

    Cuts that a rule makes first are thickest. Scopes in which a rule draws one thing over another are outlined.

    Parameters
    ----------
    layout
        What to draw.
    levels
        How many splits, one within the other, are shown; None: all.
    width_px
        Width of the drawing in pixels; None: as large as fits about 900 by 640.
    theme
        ``light`` or ``dark``.

    Raises
    ------
    DesignError
        For a shape with an unknown geometry or material.
    ValueError
        For an unknown theme, or a width without room for the drawing.
    """
    style = find_style(theme)
    frame = Frame.fit(layout.canvas.width, layout.canvas.height, width_px, dimensions=False)
    whole = (0.0, 0.0, layout.canvas.width, layout.canvas.height)
    cuts = _Cuts()
    cuts.follow(split_tree(layout), whole, 0, levels)
    body = [f'<rect {frame.box(whole)} fill="{style.paper}" fill-opacity=".6"/>']
    body += (
        f'<rect {frame.box(rect)} fill="none" stroke="{style.faint}" stroke-width="1" stroke-dasharray="3 2"/>'
        for rect in dict.fromkeys(cuts.stacks)
    )
    colours = {"y": style.accent, "x": style.second}
    for axis, lines in cuts.lines.items():
        for depth, at, start, end in sorted(lines, reverse=True):
            corners = ((at, start), (at, end)) if axis == "x" else ((start, at), (end, at))
            (x0, y0), (x1, y1) = (frame.at(*corner) for corner in corners)
            body.append(
                f'<path d="M{num(x0)} {num(y0)}L{num(x1)} {num(y1)}" stroke="{colours[axis]}" '
                f'stroke-width="{num(max(0.7, 2.6 * 0.62**depth))}"/>'
            )
    told = [
        (style.accent, "", f"{len(cuts.lines['y'])} cuts across, split(y)"),
        (style.second, "", f"{len(cuts.lines['x'])} cuts upwards, split(x)"),
        (style.faint, "3 2", f"{len(cuts.stacks)} scopes in which one thing is drawn over another"),
    ]
    width, height = frame.width, frame.height + _LINE * len(told) + 6
    return _sheet(
        f"The splits of {layout.name}",
        (width, height),
        style,
        [
            elevation_svg(layout, width_px=width_px, theme=theme, ids=False),
            *body,
            *_legend(told, frame, style),
        ],
    )


def _legend(told: list[tuple[str, str, str]], frame: Frame, style: Style) -> Iterator[str]:
    """Samples of lines under each other, each with what it means."""
    x, y = frame.left, frame.height + 8
    for colour, dashes, text in told:
        yield (
            f'<path d="M{num(x)} {num(y - 3.5)}h18" stroke="{colour}" stroke-width="2" stroke-dasharray="{dashes}"/>'
            f'<text {FONT} font-size="11" x="{num(x + 26)}" y="{num(y)}" fill="{_text(style)}">{text}</text>'
        )
        y += _LINE


def _text(style: Style) -> str:
    """A colour for words that can be read on the paper."""
    return style.ink if style.name == "light" else "#d9dde2"


def _sheet(label: str, size: tuple[float, float], style: Style, body: list[str]) -> str:
    w, h = num(size[0]), num(size[1])
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" viewBox="0 0 {w} {h}" role="img" '
        f'aria-label="{escape(label)}" style="max-width:100%;height:auto">'
        f'<rect width="100%" height="100%" fill="{style.paper}"/>{"".join(body)}</svg>'
    )


@dataclass(slots=True)
class _Box:
    """A node in the hierarchy: the first place of a rule has its parts under it, later ones are only named."""

    node: Node
    known: bool
    parts: list[_Box] = field(default_factory=list)

    @property
    def leaves(self) -> int:
        """How wide it is, in leaves."""
        return sum(part.leaves for part in self.parts) or 1

    @property
    def depth(self) -> int:
        """How many rows it takes."""
        return 1 + max((part.depth for part in self.parts), default=0)


def rules_svg(layout: Layout, before: Layout | None = None, *, theme: str = "light") -> str:
    """Draw the rules of `split_grammar` as a hierarchy, each rule once, as Figure 1 of the paper's supplement does.

    The first rule is on top, and what a rule is made of stands under it, each part once. Where a rule is met again
    it is only named.

    Parameters
    ----------
    layout
        Whose rules are drawn.
    before
        The layout before an edit: rules that are new or have changed are filled, the others are pale. Sizes and numbers
        of repetitions are no edit (`facade_nb.comparison.edits`).
    theme
        ``light`` or ``dark``.

    Raises
    ------
    ValueError
        For an unknown theme, or a layout without shapes.
    """
    style = find_style(theme)
    root = split_tree(layout)
    if root is None:
        raise ValueError(f"rules_svg: expected a layout with shapes; {layout.name} has none")
    new = None if before is None else touched(split_tree(before), root)[0]
    texts = dict(zip(rules_of(root), split_rules(layout), strict=True))
    top = _hierarchy(root, set())
    leaf = min(_LEAF, _WIDEST / top.leaves)
    body = list(_boxes(top, 8.0, 8.0, leaf, texts, new, style))
    size = (16 + leaf * top.leaves, 16 + _ROW * top.depth)
    label = (
        f"{len(texts)} split rules of {layout.name}: y cut across, x cut upwards, grey one over another"
        + ("" if new is None else f"; filled: {len(new)} that are new or changed")
    )
    body.append(
        f'<text {FONT} font-size="11" x="8" y="{num(size[1] + 12)}" fill="{_text(style)}">{escape(label)}</text>'
    )
    return _sheet(label, (max(size[0], 12 + 6 * len(label)), size[1] + 22), style, body)


def _hierarchy(node: Node, met: set[Node]) -> _Box:
    known = node in met
    box = _Box(node, known)
    if not known and isinstance(node, Split | Stack):
        met.add(node)
        parts = [child for child in dict.fromkeys(children(node)) if child is not None]
        box.parts = [_hierarchy(child, met) for child in parts]
    return box


def _boxes(
    box: _Box,
    x: float,
    y: float,
    leaf: float,
    texts: dict[Node, tuple[str, str]],
    new: set[Node] | None,
    style: Style,
) -> Iterator[str]:
    """The box of a node, and under it those of its parts."""
    node, width = box.node, leaf * box.leaves
    name, told = texts.get(node, ("", ""))
    if isinstance(node, Shape):
        colour, short, told = style.faint, node.name.rsplit("/", 1)[-1], node.name
        share = 0.12
    else:
        axis = node.axis if isinstance(node, Split) else ""
        colour = {"y": style.accent, "x": style.second}.get(axis, style.faint)
        short, told = f"{name}  {axis}".strip(), f"{name} --> {told}"
        share = 0.85 if new is not None and node in new else 0.22
    dashes = ' stroke-dasharray="2 2"' if box.known and not isinstance(node, Shape) else ""
    strong = share > 0.5 and not box.known
    yield (
        f'<g><title>{escape(told)}</title><rect x="{num(x + 0.5)}" y="{num(y)}" width="{num(width - 1)}" '
        f'height="{num(_ROW - 4)}" rx="2" fill="{colour}" fill-opacity="{share if strong else min(share, 0.22)}" '
        f'stroke="{colour}" stroke-width=".8"{dashes}/>'
    )
    if len(short) * 6.2 < width - 4:
        fill = style.paper if strong and colour != style.faint else _text(style)
        yield (
            f'<text {FONT} font-size="10.5" text-anchor="middle" x="{num(x + width / 2)}" y="{num(y + 17)}" '
            f'fill="{fill}">{escape(short)}</text>'
        )
    yield "</g>"
    for part in box.parts:
        yield from _boxes(part, x, y + _ROW, leaf, texts, new, style)
        x += leaf * part.leaves
