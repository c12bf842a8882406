// What sight.frag and then lit.frag or plain.frag show, antialiased (NumPy: antialias.py): one sample where no boundary is
// near, else the mean of 16. Needs EDGES. All samples go through one call, since compilers copy the evaluator into each.
#include "evaluate.glsl"
#include "look.glsl"
#include "shown.glsl"

uniform float spread;       // of Question
uniform vec2 facade_size;
uniform ivec2 start_rule;
uniform uvec2 seed_whole;
uniform vec2 seed_rest;
uniform float lit;          // 1: in the light of the hour; 0: colours as they are

layout(location = 0) out highp vec4 out_color;

const float NEAR = 0.75;    // pixels from a boundary: half a diagonal, and a little
const float SHARE = 0.25;   // of a pixel's width: how large a sample is

bool within(Look to) {
  return to.seen && to.at.x >= 0.0 && to.at.y >= 0.0 && to.at.x <= facade_size.x && to.at.y <= facade_size.y;
}

bool outline(vec2 pixel) {
  bool here = within(look(pixel));
  return within(look(pixel + vec2(1.0, 0.0))) != here || within(look(pixel - vec2(1.0, 0.0))) != here
    || within(look(pixel + vec2(0.0, 1.0))) != here || within(look(pixel - vec2(0.0, 1.0))) != here;
}

// No two of the 16 share a column or a row.
vec2 place(int k) {
  int turned = (k & 1) * 8 + (k & 2) * 2 + (k & 4) / 2 + (k & 8) / 8;
  return (vec2(k, turned) + 0.5) / 16.0;
}

void main() {
  vec2 corner = floor(gl_FragCoord.xy);
  bool edge = outline(corner + 0.5);
  vec4 sum = vec4(0.0);
  for (int k = -1; k < 16; ++k) {
    Look to = look(corner + (k < 0 ? vec2(0.5) : place(k)));
    float share = k < 0 ? 1.0 : SHARE;
    surface = Surface(vec4(0.0), vec4(0.0), vec4(0.0), ivec2(-1));
    margin = 1e9;
    if (within(to)) {
      evaluate(Question(
        start_rule, facade_size, to.at, to.ray, seed_whole, seed_rest, to.footprint * share, spread * share
      ));
    }
    vec4 found = clamp(surface.color, 0.0, 1.0);
    if (lit > 0.0) found = vec4(shown(surface.color, surface.normal, surface.specular, to.ray, to.at.y), 1.0);
    if (k < 0) {
      if (!edge && margin >= NEAR) {
        out_color = found;
        return;
      }
    } else {
      sum += found / 16.0;
    }
  }
  out_color = sum;
}
