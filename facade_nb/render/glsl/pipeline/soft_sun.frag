// How much of the sun's disc each pixel sees: a few looks at one map of depth, in another order at each pixel.
#include "mixed.glsl"
#include "lookup.glsl"

uniform highp sampler2D facing;
uniform highp sampler2D sun_map;

layout(location = 0) out highp vec4 out_sunny;

const int TAPS = 10;
const float BLUR = 0.014;  // metres
const vec2 GOLDEN = vec2(-0.7373688, 0.6754903);  // cosine and sine of the golden angle

void main() {
  vec4 face = drawn(facing, share_of(facing));
  out_sunny = vec4(1.0);
  if (face.w <= 0.0 || dot(face.xyz, light_to) <= 0.0) return;
  Lookup from = lookup(point_at(gl_FragCoord.xy, face), face.xyz, sun_map);
  uint number = mixed(uint(gl_FragCoord.x) ^ mixed(uint(gl_FragCoord.y)));
  float turn = float(number & 1023u) * (6.2831853 / 1024.0);
  vec2 way = vec2(cos(turn), sin(turn));
  float sum = 0.0;
  for (int k = 0; k < TAPS; ++k) {
    sum += reached(sun_map, from, BLUR * sqrt((float(k) + 0.5) / float(TAPS)) * way);
    way = vec2(GOLDEN.x * way.x - GOLDEN.y * way.y, GOLDEN.y * way.x + GOLDEN.x * way.y);
  }
  out_sunny = vec4(sum / float(TAPS));
}
