// The pool of light around a street lamp: what it gives to ground and walls, added to the light that is there.
#include "around_lamp.glsl"
#include "linear.glsl"
#include "pixel.glsl"
#include "view.glsl"

uniform highp sampler2D color;
uniform highp sampler2D normal;
uniform highp sampler2D facing;
uniform vec2 lamps;  // lamp light in rooms; street lamps

flat in vec3 lantern;

layout(location = 0) out highp vec4 out_light;

const vec3 TONE = vec3(1.0, 0.72, 0.44);

// How much of the light comes past the walls around the lamp, which all are higher. `way`: east and north of it.
float passes(vec2 way) {
  float far = wall_along(way);
  return 1.0 - smoothstep(far + 0.5, far + 1.3, length(way));
}

void main() {
  vec2 share = share_of(facing);
  float depth = drawn(facing, share).w;
  vec3 away = lantern - start_at(gl_FragCoord.xy) - depth * ray_at(gl_FragCoord.xy);
  float square = dot(away, away);
  if (depth <= 0.0 || square >= REACH * REACH) discard;
  vec3 facing_ = drawn(normal, share).xyz;
  float outside = clamp(length(facing_), 0.0, 1.0);
  float part = 1.0 - square / (REACH * REACH);
  float near = part * part / (1.0 + 0.16 * square);
  float falls = clamp(0.12 + 0.88 * dot(facing_, away * inversesqrt(max(square, 1e-3))), 0.0, 1.0);
  near *= passes(vec2(-away.x, away.z));
  vec4 tint = drawn(color, share);
  float covers = tint.a > 1.5 ? 1.0 : clamp(tint.a, 0.0, 1.0);
  out_light = vec4(linear(clamp(tint.rgb, 0.0, 1.0)) * (outside * covers * near * falls * 10.0 * lamps.y) * TONE, 0.0);
}
