// A surface in the light of an hour, before the sky. The sun is not shaded: the façade stands alone.
#include "light.glsl"
#include "developed.glsl"

uniform vec3 zenith;
uniform vec3 horizon;
uniform float exposure;

vec3 shown(vec4 color, vec4 normal, vec4 specular, vec3 ray, float height) {
  vec3 result = light(color, normal, specular, ray, vec2(1.0), height);
  float rise = pow(clamp(ray.y / length(ray), 0.0, 1.0), 0.7);
  float glow = pow(clamp(dot(ray, towards) / length(ray), 0.0, 1.0), 24.0);
  vec3 behind = mix(horizon, zenith, rise) + 0.16 * glow * sun;
  result += (1.0 - clamp(color.a, 0.0, 1.0)) * behind;
  return developed(result, exposure);
}
