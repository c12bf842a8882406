// What sight.frag has drawn, in the light of an hour, before the sky. The sun is not shaded: the façade stands alone.
#include "light.glsl"
#include "developed.glsl"

uniform highp sampler2D seen_color;
uniform highp sampler2D seen_normal;
uniform highp sampler2D seen_specular;
uniform vec4 window;        // as in sight.frag
uniform vec4 eye;
uniform vec3 across;
uniform vec3 forward;
uniform vec3 zenith;
uniform vec3 horizon;
uniform float exposure;

layout(location = 0) out highp vec4 out_color;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec4 color = texelFetch(seen_color, at, 0);
  vec2 place = window.xy + (vec2(at) + 0.5) * window.zw;
  vec3 ray = vec3(0.0, 0.0, -1.0);
  float height = place.y;
  if (eye.w > 0.0) {
    ray = place.x * across + forward;
    ray.y += place.y;
    height = eye.y + ray.y * eye.z / max(-ray.z, 1e-6);
  }
  vec3 result = light(color, texelFetch(seen_normal, at, 0), texelFetch(seen_specular, at, 0), ray, 1.0, height);
  float rise = pow(clamp(ray.y / length(ray), 0.0, 1.0), 0.7);
  float glow = pow(clamp(dot(ray, towards) / length(ray), 0.0, 1.0), 24.0);
  vec3 behind = mix(horizon, zenith, rise) + 0.16 * glow * sun;
  result += (1.0 - clamp(color.a, 0.0, 1.0)) * behind;
  out_color = vec4(developed(result, exposure), 1.0);
}
