// How much of the sun a point sees: from two maps of depth, a fine one around the camera and one of all.
#include "pixel.glsl"

uniform highp sampler2D shadow_near;
uniform highp sampler2D shadow_far;
uniform mat4 sun_near;
uniform mat4 sun_far;
uniform vec2 sun_texel;  // metres that a texel covers: near, far

float sees(highp sampler2D map, vec2 share, ivec2 at, float depth) { return pixel(map, share, at).r >= depth ? 1.0 : 0.0; }

// Nine comparisons, weighed by where the point lies among the texels, so that an edge is a soft line and no stairs. Where the
// first five agree there is no edge. Above 1: the point is not in the map.
float compared(highp sampler2D map, vec3 at) {
  vec2 share = share_of(map);
  if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)))) return 2.0;
  vec2 texel = at.xy / share;
  ivec2 middle = ivec2(floor(texel));
  float own = sees(map, share, middle, at.z);
  vec2 low = vec2(sees(map, share, middle - 1, at.z), sees(map, share, middle + ivec2(1, -1), at.z));
  vec2 high = vec2(sees(map, share, middle + ivec2(-1, 1), at.z), sees(map, share, middle + 1, at.z));
  float sum = own + low.x + low.y + high.x + high.y;
  if (sum == 0.0 || sum == 5.0) return own;
  vec2 off = texel - floor(texel);
  vec2 before = 0.5 * (1.0 - off) * (1.0 - off);
  vec2 after = 0.5 * off * off;
  vec2 mid = 1.0 - before - after;
  float under = before.x * low.x + mid.x * sees(map, share, middle - ivec2(0, 1), at.z) + after.x * low.y;
  float across = before.x * sees(map, share, middle - ivec2(1, 0), at.z) + mid.x * own
    + after.x * sees(map, share, middle + ivec2(1, 0), at.z);
  float over = before.x * high.x + mid.x * sees(map, share, middle + ivec2(0, 1), at.z) + after.x * high.y;
  return before.y * under + mid.y * across + after.y * over;
}

float sunlit(vec3 point, vec3 normal) {
  vec4 near = sun_near * vec4(point + 2.0 * sun_texel.x * normal, 1.0);
  float free = compared(shadow_near, 0.5 * near.xyz + 0.5);
  if (free > 1.0) {
    vec4 far = sun_far * vec4(point + 2.0 * sun_texel.y * normal, 1.0);
    free = compared(shadow_far, 0.5 * far.xyz + 0.5);
  }
  return min(free, 1.0);
}
