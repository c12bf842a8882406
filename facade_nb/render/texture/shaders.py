"""The GLSL evaluator's source: one body for desktop GL and WebGL2, one function a file, put together by includes.

Codes of operators and the places of their channels come from the operator table, bounds from `limits`: a record
``head`` has its count at ``head.SplitX_n`` and the position of its rule at ``part.SplitX_R``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache
from importlib.resources import files

from .evaluating import BELOW_ONE, OPAQUE
from .limits import GRAIN, MAX_FACES, MAX_FRAMES, MAX_SEEDS, MAX_STEPS, half_step_of
from .operators import OPERATORS, USAGES, Operator

__all__ = ["PROFILES", "constants", "room", "rooms_for", "shader"]

PROFILES = {
    "core": "#version 330 core\n",
    "es": "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n",
}
"""What stands before the body: desktop GL 3.3 and WebGL2."""

ROOMS = ("texture", "pipeline")
"""Folders of `glsl` in which a name is looked up."""

_HEIGHTS = (2, 4, max(MAX_FRAMES, MAX_SEEDS))
_INCLUDE = re.compile(r'^#include "([\w.]+)"$', re.MULTILINE)
_NAMES = {"Σrel": "rel", "Σabs": "abs", "Σv": "sum"}


@lru_cache(maxsize=32)
def shader(
    name: str,
    profile: str = "core",
    *,
    frames: int = MAX_FRAMES,
    seeds: int = MAX_SEEDS,
    rooms: int = MAX_FACES,
    bits: int = 16,
    defines: tuple[str, ...] = (),
) -> str:
    """The source of a shader: ``points.frag``, ``whole.vert``, or of a pass.

    Parameters
    ----------
    profile
        A key of `PROFILES`.
    frames, seeds, rooms
        Room on the stacks; less is faster (see `room`).
    bits
        Of the floats of the grammar's texture, 16 or 32: how far a size may be from what was written.
    defines
        Names to be defined: ``MIPS`` (tiles in the size that fits a pixel), ``EDGES`` (how near a boundary is),
        ``COLOR_ONLY`` (normals and specular values are passed over),
        ``RELIEF`` (tiles that have heights are seen with them), ``DEEP`` (how far behind the façade colour comes
        from), ``PICK`` (which rule a pixel shows), ``COUNT_FETCHES``.
    """
    head = PROFILES[profile]
    if name.endswith(".frag"):
        head += "".join(f"#define {define}\n" for define in defines)
        head += (
            f"const int MAX_FRAMES = {frames};\nconst int MAX_SEEDS = {seeds};\nconst int MAX_ROOMS = {rooms};\n"
            f"{_floats(bits)}{constants()}"
        )
    return head + "".join(_included(name, set()))


def _included(name: str, seen: set[str]) -> Iterator[str]:
    """A file with what it includes, each file once."""
    if name in seen:
        return
    seen.add(name)
    glsl = files("facade_nb.render") / "glsl"
    text = next(own for own in (glsl / folder / name for folder in ROOMS) if own.is_file()).read_text("utf-8")
    if name == "tried.glsl" and (operators := [own for own in OPERATORS.values() if own.move is not None]):
        text = _tried(operators)
    at = 0
    for include in _INCLUDE.finditer(text):
        yield text[at : include.start()]
        yield from _included(include[1], seen)
        at = include.end()
    yield text[at:]


def _tried(operators: Sequence[Operator]) -> str:
    """The functions of ``tried.glsl`` for operators that are being tried."""
    codes = [f"code == OP_{own.name.upper()}" for own in operators]
    branches: list[str] = []
    for own in operators:
        value = f"head.{own.name}_v" if "v" in own.head else "0.0"
        branches.append(
            f"  if ({codes[len(branches)]}) {{\n"
            f"    float v = {value};\n    {own.glsl}\n    now.rule = ivec2(head.{own.name}_R);\n  }}\n"
        )
    return (
        f"bool tried(int code) {{ return {' || '.join(codes)}; }}\n"
        f"void try_out(inout State now, vec4 head, int code) {{\n{''.join(branches)}}}\n"
    )


def room(height: int) -> int:
    """Room for a stack of that height: one of a few sizes, so that few shaders serve all grammars."""
    return next(size for size in _HEIGHTS if size >= height)


def rooms_for(height: int) -> int:
    """Room for intrusions inside each other: one of two sizes."""
    return 1 if height <= 1 else MAX_FACES


def _floats(bits: int) -> str:
    """What is lost by floats of the texture, and by those that evaluators compute with."""
    relative, least = half_step_of(bits)
    values = {"GRAIN": GRAIN, "HALF_STEP": relative, "LEAST_STEP": least}
    return "".join(f"const float {name} = {float(value):#.9g};\n" for name, value in values.items())


def constants() -> str:
    """Bounds, codes, and where each channel stands, as GLSL."""
    lines = [
        f"const int MAX_FACES = {MAX_FACES};",
        f"const int MAX_STEPS = {MAX_STEPS};",
        f"const float OPAQUE = {OPAQUE:.9g};",
        f"const float BELOW_ONE = {BELOW_ONE:.9g};",
        *(f"const int USAGE_{name.upper()} = {number};" for name, number in USAGES.items()),
        *(f"const int OP_{operator.name.upper()} = {operator.code};" for operator in OPERATORS.values()),
    ]
    for operator in OPERATORS.values():
        lines += _channels(operator)
    return "\n".join(lines) + "\n"


def _channels(operator: Operator) -> Iterator[str]:
    """A macro for each channel that an operator uses: which component of its pixel it is."""
    for channels in (operator.head, operator.each):
        for k, name in enumerate(channels):
            if name.endswith(".x"):
                yield f"#define {operator.name}_{name[:-2]} {'rgba'[k % 4]}{'rgba'[(k + 1) % 4]}"
            elif name and not name.endswith(".y"):
                yield f"#define {operator.name}_{_NAMES.get(name, name)} {'rgba'[k % 4]}"
