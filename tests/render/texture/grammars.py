"""Random grammars: every operator, nested, as text."""

from __future__ import annotations

from hypothesis import strategies as st

__all__ = ["grammar_texts", "rays"]

_TILES = ["wall1", "wall2", "wall3", "window1", "window2", "window3", "hole", "disc"]
_SIZES = st.one_of(
    st.sampled_from([0.25, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 1.3, 2.8, 0.1]),
    st.floats(0.05, 6.0).map(lambda v: round(v, 4)),
)
_UNIT = st.one_of(st.sampled_from([0.0, 0.25, 0.5, 1.0]), st.floats(0, 1).map(lambda v: round(v, 3)))


@st.composite
def grammar_texts(draw: st.DrawFn, operators: tuple[str, ...] = (), rules: int = 9) -> str:
    """A grammar's text: rule k leads to rules after it; at the end stand layers of materials, and a Skip."""
    count = draw(st.integers(3, rules))
    names = [f"R{k}" for k in range(count)] + ["All", "Paint", "Bump", "Shine", "Half", "Gone"]
    lines = []
    for k in range(count):
        later = names[k + 1 :]
        rule = st.sampled_from(later[:4] * 2 + later[-6:])
        operator = draw(st.sampled_from(operators or _ALL)) if k else draw(st.sampled_from(_FIRST))
        lines.append(f"{names[k]} -> {operator}({draw(_ARGUMENTS[operator](rule))})")
    lines.append("All -> Layer(Paint, Bump, Shine, Half)")
    lines.append(
        f"Bump -> MatAlpha(Normal, Fit:window3, 0, 0, 1, 1, Fit:{draw(st.sampled_from(['hole', 'disc']))}, 0, 0, 1, 1)"
    )
    lines.append(f"Shine -> Mat(Specular, Rep:window2, 0, 0, 1, {draw(st.sampled_from([1, 0.3]))})")
    lines.append(f"Paint -> Mat(Color, Rep:{draw(st.sampled_from(_TILES))}, 0.2, 0, 0.7, 0.9)")
    lines.append(
        f"Half -> Mat(Color, 0, {_numbers(draw, 3)}, {draw(st.sampled_from([0.5, 0.25, 1.0, 0.0]))})"
    )
    lines.append(f"Gone -> Skip({draw(st.sampled_from([0, 0, 0, 1, 2]))})")
    return "\n".join(lines)


def rays() -> st.SearchStrategy[tuple[float, float, float]]:
    """Directions that do not run along the wall."""
    side = st.one_of(st.just(0.0), st.floats(-2, 2).map(lambda v: round(v, 3)))
    return st.tuples(side, side, st.floats(-2, -0.3).map(lambda v: round(v, 3)))


def _numbers(draw: st.DrawFn, count: int) -> str:
    return ", ".join(f"{draw(_UNIT):g}" for _ in range(count))


@st.composite
def _split(draw: st.DrawFn, rule: st.SearchStrategy[str]) -> str:
    parts = draw(st.lists(st.tuples(st.sampled_from(["Abs", "Rel"]), _SIZES, rule), min_size=1, max_size=5))
    return ", ".join(f"{policy}, {size:g}, {name}" for policy, size, name in parts)


@st.composite
def _repeat(draw: st.DrawFn, rule: st.SearchStrategy[str]) -> str:
    return f"{draw(_SIZES):g}, {draw(rule)}"


@st.composite
def _rand(draw: st.DrawFn, rule: st.SearchStrategy[str]) -> str:
    cuts = sorted(draw(st.sets(st.integers(1, 19), max_size=3)))
    weights = [(b - a) / 20 for a, b in zip([0, *cuts], [*cuts, 20], strict=True)]
    return ", ".join([str(draw(st.integers(0, 2))), *(f"{weight:g}, {draw(rule)}" for weight in weights)])


@st.composite
def _uniform(draw: st.DrawFn, rule: st.SearchStrategy[str]) -> str:
    return ", ".join([str(draw(st.integers(0, 2))), *draw(st.lists(rule, min_size=1, max_size=5))])


@st.composite
def _layer(draw: st.DrawFn, rule: st.SearchStrategy[str]) -> str:
    return ", ".join(draw(st.lists(rule, min_size=1, max_size=4)))


@st.composite
def _mask(draw: st.DrawFn, rule: st.SearchStrategy[str]) -> str:
    level = st.integers(0, 2)
    return f"Fit:{draw(st.sampled_from(['hole', 'disc', 'window2']))}, {draw(level)}, {draw(level)}"


@st.composite
def _room(draw: st.DrawFn, rule: st.SearchStrategy[str]) -> str:
    return ", ".join([f"{draw(_SIZES):g}", *(draw(rule) for _ in range(5))])


@st.composite
def _source(draw: st.DrawFn, alpha: bool = False) -> str:
    mode = draw(st.sampled_from(["", "Fit", "Rep"]))
    if not mode:
        return f"0, {_numbers(draw, 4)}"
    tile = draw(st.sampled_from(["hole", "disc", "window2"] if alpha else _TILES))
    if mode == "Fit":
        left, bottom = draw(st.sampled_from([0, 0.25])), draw(st.sampled_from([0, 0.125]))
        return f"Fit:{tile}, {left}, {bottom}, {draw(st.sampled_from([1, 0.75]))}, {draw(st.sampled_from([1, 0.5]))}"
    scale = st.sampled_from([0.5, 1, 2, -1, 0.7])
    return f"Rep:{tile}, {draw(_UNIT):g}, {draw(_UNIT):g}, {draw(scale)}, {draw(scale)}"


@st.composite
def _mat(draw: st.DrawFn, rule: st.SearchStrategy[str]) -> str:
    return f"{draw(st.sampled_from(['Color', 'Color', 'Normal', 'Specular']))}, {draw(_source())}"


@st.composite
def _mat_alpha(draw: st.DrawFn, rule: st.SearchStrategy[str]) -> str:
    return f"{draw(_mat(rule))}, {draw(_source(alpha=True))}"


_ARGUMENTS = {
    "SplitX": _split,
    "SplitY": _split,
    "RepeatX": _repeat,
    "RepeatY": _repeat,
    "Rand": _rand,
    "RandUni": _uniform,
    "RandStack": lambda rule: rule,
    "Layer": _layer,
    "Skip": lambda rule: st.integers(0, 3),
    "SkipMask": _mask,
    "Intrusion": _room,
    "Mat": _mat,
    "MatAlpha": _mat_alpha,
}
_ALL = tuple(_ARGUMENTS)
_FIRST = ("SplitX", "SplitY", "RepeatX", "RepeatY", "Rand", "RandStack", "Layer", "Layer", "Intrusion")
