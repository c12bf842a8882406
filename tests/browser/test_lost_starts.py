"""A start that is none of a rule ends like any other: a foreign mesh, or one in the making, must not hold up its page.

A browser's software goes on for ever where OSMesa leaves a loop after 65,536 rounds.
"""

from __future__ import annotations

import base64

import numpy as np
from playwright.sync_api import Browser

from facade_nb.render import Grammar
from facade_nb.render.pipeline.passes import PASSES
from facade_nb.render.texture.shaders import room, shader
from facade_nb.render.texture.uploads import grammar_upload

from .waiting import LIMIT

GRAMMAR = """
S -> Layer(Wall, Floors)
Wall -> Mat(Color, 0, 0.5, 0.4, 0.3, 1)
Floors -> RepeatY(3, Floor)
Floor -> SplitX(Abs, 0.3, Skip, Abs, 1.2, Pane, Rel, 1, Skip)
Pane -> RandUni(0, Bright, Dark, Room)
Room -> Intrusion(2, Wall, Wall, Dark, Bright, Bright)
Bright -> Mat(Color, 0, 0.9, 0.9, 0.8, 1)
Dark -> Mat(Color, 0, 0.1, 0.1, 0.2, 1)
Skip -> Skip(0)
"""
SIDE = 32
DRAW = """
([vertex, fragment, own, side, seconds]) => {
  const gl = document.createElement("canvas").getContext("webgl2");
  gl.getExtension("EXT_color_buffer_float");
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  gl.useProgram(program);
  const made = (unit, width, height, content) => {
    gl.activeTexture(gl.TEXTURE0 + unit);
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, width, height, 0, gl.RGBA, gl.FLOAT, content);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    return texture;
  };
  Object.entries(own).forEach(([name, [width, height, bytes]], unit) => {
    const whole = Uint8Array.from(atob(bytes), (letter) => letter.charCodeAt(0));
    made(unit, width, height, new Float32Array(whole.buffer));
    gl.uniform1i(gl.getUniformLocation(program, name), unit);
  });
  gl.uniform4f(gl.getUniformLocation(program, "window"), -0.5, -0.5, 1 / side, 1 / side);
  gl.uniform3f(gl.getUniformLocation(program, "forward"), 0, 0, -1);
  gl.uniform3f(gl.getUniformLocation(program, "across"), 1, 0, 0);
  gl.uniform3f(gl.getUniformLocation(program, "upward"), 0, 1, 0);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  const places = [0, 1, 2].map((k) => {
    const texture = made(15, side, side, null);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + k, gl.TEXTURE_2D, texture, 0);
    return gl.COLOR_ATTACHMENT0 + k;
  });
  gl.drawBuffers(places);
  gl.viewport(0, 0, side, side);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
  const done = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  gl.flush();
  const end = performance.now() + 1000 * seconds;
  return new Promise((resolve, reject) => {
    const look = () => {
      if (gl.getSyncParameter(done, gl.SYNC_STATUS) === gl.SIGNALED) {
        const drawn = new Float32Array(4 * side * side);
        gl.readPixels(0, 0, side, side, gl.RGBA, gl.FLOAT, drawn);
        resolve(Array.from(drawn));
      } else if (performance.now() > end) reject(new Error("it draws for ever"));
      else setTimeout(look, 20);
    };
    look();
  });
}
"""


def test_a_start_that_is_no_rule_ends(browser: Browser) -> None:
    grammar = Grammar.parse(GRAMMAR)
    question = grammar.question((1.0, 1.0))
    own = next(one for one in PASSES if one.name == "grammar")
    frames, seeds = map(room, question.stacks)
    fragment = shader(own.fragment, "es", frames=frames, seeds=seeds, bits=32, defines=own.defines)
    upload = grammar_upload(question, wide=True)
    width, height = upload.size
    rows, columns = np.mgrid[:SIDE, :SIDE].astype(np.float32)
    one, none = np.ones_like(rows), np.zeros_like(rows)
    starts = np.stack([columns % (width + 2), rows % (height + 2), columns, rows], axis=2)
    images = {
        "grammar": (width, height, np.frombuffer(upload.content, np.float32)),
        "place": (SIDE, SIDE, np.stack([columns / 8, rows / 8, 4 * one, 4 * one], axis=2)),
        "rule": (SIDE, SIDE, starts),
        "facing": (SIDE, SIDE, np.stack([none, none, one, 9 * one], axis=2)),
        "along": (SIDE, SIDE, np.stack([one, none, none, none], axis=2)),
        "noise": (1, 1, np.full(4, 0.4)),
        "atlas": (1, 1, np.full(4, 0.4)),
        "tile_table": (2, 1, np.array([1, 0, 0, 0, 0, 0, 1, 1])),
    }
    given = {
        name: [w, h, base64.b64encode(np.ascontiguousarray(content, np.float32).tobytes()).decode()]
        for name, (w, h, content) in images.items()
    }
    with browser.new_page() as page:
        told = page.evaluate(DRAW, [shader(own.vertex, "es"), fragment, given, SIDE, LIMIT])
    colours = np.array(told).reshape(SIDE, SIDE, 4)
    column, row = question.records[question.start].place
    begun = (starts[..., 0] == column) & (starts[..., 1] == row)
    assert np.isfinite(colours).all()
    assert begun.any()
    assert (colours[begun][:, 3] == 1).all()
