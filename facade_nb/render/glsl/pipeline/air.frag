// The air between: what is far takes on the colour of the horizon; where there is nothing, the sky.
#include "pixel.glsl"
#include "view.glsl"

uniform vec3 towards;
uniform vec3 sun;
#include "sky.glsl"

uniform highp sampler2D light;
uniform highp sampler2D facing;
uniform float haze;  // metres after which a third is left of what is seen; 0: none

layout(location = 0) out highp vec4 out_air;

void main() {
  vec2 share = share_of(facing);
  vec3 ray = ray_at(gl_FragCoord.xy);
  float depth = drawn(facing, share).w;
  vec4 seen = drawn(light, share);
  vec3 sky = sky_along(ray);
  if (depth <= 0.0) {
    out_air = vec4(sky, 0.0);
    return;
  }
  float clear = haze > 0.0 ? exp(-pow(depth * length(ray) / haze, 1.4)) : 1.0;
  vec3 mist = sky_along(vec3(ray.x, max(ray.y, 0.02 * length(ray)), ray.z));
  vec3 shown = seen.rgb + (1.0 - clamp(seen.a, 0.0, 1.0)) * sky;
  out_air = vec4(mix(mist, shown, clear), 1.0);
}
