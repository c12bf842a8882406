// The air between: what is far takes on the colour of the horizon.
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
#ifdef ALONE
  out_air = vec4(seen.rgb + (1.0 - clamp(seen.a, 0.0, 1.0)) * clear_sky(normalize(ray)), 1.0);
#else
  float clear = haze > 0.0 ? exp(-pow(depth * length(ray) / haze, 1.4)) : 1.0;
  vec3 to = level(ray);
  vec3 beyond_all = clear_sky(to);
  vec3 mist = mix(beyond_all, mist_along(to, beyond_all), clear);  // furthest out it is the horizon itself
#ifdef THROUGH
  float whole = clamp(seen.a, 0.0, 1.0);  // the rest is sky, after all that is seen through
  vec3 beyond = whole < 1.0 ? (1.0 - whole) * sky_along(ray) : vec3(0.0);
  out_air = vec4(mix(whole * mist, seen.rgb, clear) + beyond, 1.0);
#else
  vec3 shown = seen.rgb + (1.0 - clamp(seen.a, 0.0, 1.0)) * mist;
  out_air = vec4(mix(mist, shown, clear), 1.0);
#endif
#endif
}
