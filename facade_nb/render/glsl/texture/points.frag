// Points and rays of their own for every pixel, from two textures.
#include "outputs.glsl"

uniform highp sampler2D points;  // x, y, footprint
uniform highp sampler2D rays;
uniform float spread;       // of Question
uniform vec2 facade_size;
uniform ivec2 start_rule;
uniform uvec2 seed_whole;
uniform vec2 seed_rest;
#ifdef RELIEF
uniform vec3 to_sun;
#endif

void main() {
#ifdef RELIEF
  sunward = to_sun;
  shadow = 0.0;
#endif
  ivec2 place = ivec2(gl_FragCoord.xy);
  vec4 point = texelFetch(points, place, 0);
  vec3 ray = texelFetch(rays, place, 0).xyz;
  put(evaluate(Question(start_rule, facade_size, point.xy, ray, seed_whole, seed_rest, point.z, spread)));
}
