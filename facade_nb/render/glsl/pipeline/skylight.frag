// Light from one direction of the sky: whether a pixel sees that far, by a map of depth from there. All directions are
// added up (gathering.py). One of four pixels is looked at.
#include "mixed.glsl"
#include "lookup.glsl"

uniform highp sampler2D facing;
uniform highp sampler2D sky_map;

layout(location = 0) out highp vec4 out_sky_seen;  // what comes, and what would come were nothing there; alpha stays 0

const float BLUR = 0.08;  // metres

void main() {
  ivec2 cell = ivec2(gl_FragCoord.xy);
  ivec2 at = min(2 * cell, textureSize(facing, 0) - 1);
  vec4 face = pixel(facing, share_of(facing), at);
  out_sky_seen = vec4(0.0);
  float slant = dot(face.xyz, light_to);
  if (face.w <= 0.0 || slant <= 0.0) return;
  uint number = mixed(uint(cell.x + 8192 * cell.y) ^ (uint(4096.0 * (light_to.x + 1.0)) << 19u));
  vec2 off = BLUR * (vec2(ivec2(int(number & 1023u), int(number >> 10u & 1023u))) / 1024.0 - 0.5);
  float sees = reached(sky_map, lookup(point_at(vec2(at) + 0.5, face), face.xyz, sky_map), off);
  out_sky_seen = vec4(slant * sees, slant, 0.0, 0.0);
}
