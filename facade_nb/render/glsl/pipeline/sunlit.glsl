// How much of the sun a point sees: from two maps of depth, a fine one around the camera and one of all.
#include "pixel.glsl"

uniform highp sampler2D shadow_near;
uniform highp sampler2D shadow_far;
uniform mat4 sun_near;
uniform mat4 sun_far;
uniform vec2 sun_texel;  // metres that a texel covers: near, far

// Whether a texel's middle sees the sun, where the surface goes on as a plane: `slope` is how its depth grows from texel to texel.
float sees(highp sampler2D map, vec2 share, ivec2 at, vec3 plane) {
  return pixel(map, share, at).r >= plane.z + dot(plane.xy, vec2(at)) ? 1.0 : 0.0;
}

// Nine comparisons, weighed by where the point lies among the texels, so that an edge is a soft line and no stairs. Where the
// first five agree there is no edge. Above 1: the point is not in the map.
float compared(highp sampler2D map, vec3 at, vec2 rises) {
  vec2 share = share_of(map);
  if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)))) return 2.0;
  vec2 texel = at.xy / share;
  ivec2 middle = ivec2(floor(texel));
  vec3 plane = vec3(rises, at.z - dot(rises, texel - 0.5));
  float own = sees(map, share, middle, plane);
  vec2 low = vec2(sees(map, share, middle - 1, plane), sees(map, share, middle + ivec2(1, -1), plane));
  vec2 high = vec2(sees(map, share, middle + ivec2(-1, 1), plane), sees(map, share, middle + 1, plane));
  float sum = own + low.x + low.y + high.x + high.y;
  if (sum == 0.0 || sum == 5.0) return own;
  vec2 off = texel - floor(texel);
  vec2 before = 0.5 * (1.0 - off) * (1.0 - off);
  vec2 after = 0.5 * off * off;
  vec2 mid = 1.0 - before - after;
  float under = before.x * low.x + mid.x * sees(map, share, middle - ivec2(0, 1), plane) + after.x * low.y;
  float across = before.x * sees(map, share, middle - ivec2(1, 0), plane) + mid.x * own
    + after.x * sees(map, share, middle + ivec2(1, 0), plane);
  float over = before.x * high.x + mid.x * sees(map, share, middle + ivec2(0, 1), plane) + after.x * high.y;
  return before.y * under + mid.y * across + after.y * over;
}

// How the depth of a plane grows from texel to texel of a parallel view, across and up.
vec2 rise(mat4 view, vec3 normal, vec2 share) {
  mat3 own = transpose(mat3(view));
  float into = min(dot(normal, own[2]), -0.06 * length(own[2]));
  vec2 aside = vec2(dot(normal, own[0]) / dot(own[0], own[0]), dot(normal, own[1]) / dot(own[1], own[1]));
  return -aside * share * dot(own[2], own[2]) / into;
}

const float OFF = 0.7;  // texels above its surface a point is compared

float sunlit(vec3 point, vec3 normal) {
  vec4 near = sun_near * vec4(point + OFF * sun_texel.x * normal, 1.0);
  float free = compared(shadow_near, 0.5 * near.xyz + 0.5, rise(sun_near, normal, share_of(shadow_near)));
  if (free > 1.0) {
    vec4 far = sun_far * vec4(point + OFF * sun_texel.y * normal, 1.0);
    free = compared(shadow_far, 0.5 * far.xyz + 0.5, rise(sun_far, normal, share_of(shadow_far)));
  }
  return min(free, 1.0);
}
