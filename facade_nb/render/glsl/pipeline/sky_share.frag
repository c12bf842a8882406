// The share of the sky that is seen, of what has been added up; the mean of 5 × 5 pixels on one plane.
#include "pixel.glsl"
#include "view.glsl"

uniform highp sampler2D sky_seen;
uniform highp sampler2D facing;
uniform highp sampler2D specular;
uniform float rays;  // how many directions there are

layout(location = 0) out highp vec4 out_softened;  // and how deep, as occlusion has it

const float PLANE = 0.01;  // metres
const float BELOW = 0.012;  // of all directions: what looks down sees none, and has some light all the same

void main() {
  ivec2 cell = ivec2(gl_FragCoord.xy);
  ivec2 most = textureSize(facing, 0) - 1;
  ivec2 last = textureSize(sky_seen, 0) - 1;
  vec2 share = share_of(facing);
  vec2 own_share = share_of(sky_seen);
  ivec2 at = min(2 * cell, most);
  vec4 face = pixel(facing, share, at);
  out_softened = vec4(1.0, face.w + pixel(specular, share, at).a, 0.0, 1.0);
  if (face.w <= 0.0) return;
  vec3 point = start_at(vec2(at) + 0.5) + face.w * ray_at(vec2(at) + 0.5);
  vec2 sum = vec2(0.0);
  for (int k = 0; k < 25; ++k) {
    ivec2 near = clamp(cell + ivec2(k % 5, k / 5) - 2, ivec2(0), last);
    ivec2 there = min(2 * near, most);
    vec4 other = pixel(facing, share, there);
    vec3 way = start_at(vec2(there) + 0.5) + other.w * ray_at(vec2(there) + 0.5) - point;
    bool same = other.w > 0.0 && dot(other.xyz, face.xyz) > 0.98 && abs(dot(way, face.xyz)) < PLANE;
    if (same) sum += pixel(sky_seen, own_share, near).rg;
  }
  float count = BELOW * rays;
  out_softened.r = (sum.r + 0.5 * count) / (sum.g + count);
}
