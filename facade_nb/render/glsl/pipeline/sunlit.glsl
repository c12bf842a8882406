// How much of the sun a point sees: from two maps of depth, a fine one around the camera and one of all.
#include "pixel.glsl"

uniform highp sampler2D shadow_near;
uniform highp sampler2D shadow_far;
uniform mat4 sun_near;
uniform mat4 sun_far;
uniform vec2 sun_texel;  // metres that a texel covers: near, far

// Four comparisons, mixed by where the point lies between the texels. Above 1: the point is not in the map.
float compared(highp sampler2D map, vec3 at) {
  vec2 share = share_of(map);
  if (any(lessThan(at, vec3(0.0))) || any(greaterThan(at, vec3(1.0)))) return 2.0;
  vec2 texel = at.xy / share - 0.5;
  ivec2 low = ivec2(floor(texel));
  vec2 part = texel - floor(texel);
  vec4 sees;
  for (int k = 0; k < 4; ++k) {
    sees[k] = pixel(map, share, low + ivec2(k & 1, k >> 1)).r >= at.z ? 1.0 : 0.0;
  }
  return mix(mix(sees.x, sees.y, part.x), mix(sees.z, sees.w, part.x), part.y);
}

float sunlit(vec3 point, vec3 normal) {
  vec4 near = sun_near * vec4(point + 1.6 * sun_texel.x * normal, 1.0);
  float sees = compared(shadow_near, 0.5 * near.xyz + 0.5);
  if (sees > 1.0) {
    vec4 far = sun_far * vec4(point + 1.6 * sun_texel.y * normal, 1.0);
    sees = compared(shadow_far, 0.5 * far.xyz + 0.5);
  }
  return min(sees, 1.0);
}
