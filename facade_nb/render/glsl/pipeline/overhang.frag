// What stands out of a wall throws shadows on the tiles below, and this finds them: how much of the sun is left. One of four
// pixels is looked at.
#include "pixel.glsl"
#include "view.glsl"

uniform highp sampler2D specular;
uniform highp sampler2D facing;
uniform vec3 towards;  // to the sun
uniform vec3 sun;

layout(location = 0) out highp vec4 out_overhang;  // and how deep

const float HIGHEST = 0.4;  // what relief stands out of a wall at the most, metres
const float FARTHEST = 1.4; // a shadow's way from what throws it, metres
const float STRIDE = 2.5;   // pixels from look to look: further apart, a ragged edge is seen several times in its shadow
const float FEWEST = 14.0;
const float LOOKS = 48.0;

// How much of the sun is left by what stands out of the same wall. Within its own tile relief knows its shadow; of other
// tiles it is known what is seen of them. `surface`: from the eye; `high`: how far it stands out of the wall itself.
float beyond(vec3 surface, vec3 wall, float high, vec2 share) {
  if (high >= HIGHEST) return 1.0;
  float far = min((HIGHEST - high) / max(dot(wall, towards), 1e-3), FARTHEST);
  float left = 1.0;
  float depth_here = dot(surface, forward);
  vec3 end = surface + far * towards;
  vec2 way = vec2(dot(end, across), dot(end, upward)) / max(dot(end, forward), 0.1 * depth_here)
    - vec2(dot(surface, across), dot(surface, upward)) / depth_here;
  float count = clamp(ceil(length(way / window.zw) / STRIDE), FEWEST, LOOKS);
  for (float k = 0.5; k < LOOKS; ++k) {
    if (k > count) break;
    vec3 at = surface + far * k / count * towards;
    float depth = dot(at, forward);
    vec2 spot = (vec2(dot(at, across), dot(at, upward)) / max(depth, 1e-3) - window.xy) / window.zw;
    if (depth <= 0.0 || any(lessThan(spot, vec2(0.0))) || any(greaterThanEqual(spot * share, vec2(1.0)))) break;
    float out_ = textureLod(specular, spot * share, 0.0).a;
    if (out_ > -0.01) continue;  // nothing stands out there
    vec4 there = textureLod(facing, spot * share, 0.0);
    if (there.w <= 0.0 || dot(there.xyz, wall) < 0.999) continue;
    float seen = there.w + out_;
    float above = dot(seen * ray_at(spot) - surface, wall) + high;
    // What is no further out than the surface itself cannot stand before the sun: the way to it leads outwards.
    if (above > high + 0.02 && above < HIGHEST) left = min(left, 1.0 - smoothstep(-0.02, 0.02, depth - seen));
  }
  return left;
}

void main() {
  ivec2 at = min(2 * ivec2(gl_FragCoord.xy), textureSize(specular, 0) - 1);
  vec2 share = share_of(specular);
  vec4 face = pixel(facing, share, at);
  float behind = pixel(specular, share, at).a;
  out_overhang = vec4(1.0, face.w + behind, 0.0, 1.0);
  if (face.w <= 0.0 || dot(face.xyz, towards) <= 0.0 || sun == vec3(0.0)) return;
  if (abs(face.y) >= 0.2 || behind >= 0.02 || parallel >= 0.5) return;
  vec3 ray = ray_at(vec2(at) + 0.5);
  out_overhang.r = beyond((face.w + behind) * ray, face.xyz, -behind * abs(dot(ray, face.xyz)), share);
}
