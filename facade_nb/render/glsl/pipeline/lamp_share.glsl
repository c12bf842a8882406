// How much of the light of street lamps comes to a point from all around: by how near they stand, as a map from above tells.
#include "pixel.glsl"

uniform highp sampler2D lamp_map;
uniform mat4 above;

/// `away`: metres along the ground from the eye. Nothing is known beyond the map, which moves with the eye by steps: light
/// ends before its edge by how far it is from the eye, so that no step is seen.
float lamp_share(vec3 point, float away) {
  vec2 at = (above * vec4(point, 1.0)).xy;
  vec2 share = share_of(lamp_map);
  vec2 texel = (0.5 * at + 0.5) / share - 0.5;
  ivec2 low = ivec2(floor(texel));
  vec2 part = texel - floor(texel);
  float apart = mix(
    mix(pixel(lamp_map, share, low).r, pixel(lamp_map, share, low + ivec2(1, 0)).r, part.x),
    mix(pixel(lamp_map, share, low + ivec2(0, 1)).r, pixel(lamp_map, share, low + 1).r, part.x),
    part.y
  );
  float within = 1.0 - smoothstep(1500.0, 1856.0, away);  // its half side, less half a step and what light reaches
  // What comes from near, within 45 m, and a little that walls and ground throw on.
  return within * (1.0 - 0.86 * smoothstep(0.17, 0.7, apart) - 0.14 * smoothstep(0.25, 1.0, apart));
}
