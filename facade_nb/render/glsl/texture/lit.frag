// What sight.frag has drawn, in the light of an hour.
#include "look.glsl"
#include "shown.glsl"

uniform highp sampler2D seen_color;
uniform highp sampler2D seen_normal;
uniform highp sampler2D seen_specular;

layout(location = 0) out highp vec4 out_color;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  Look to = look(vec2(at) + 0.5);
  vec4 color = texelFetch(seen_color, at, 0);
  vec4 normal = texelFetch(seen_normal, at, 0);
  vec4 specular = texelFetch(seen_specular, at, 0);
  out_color = vec4(shown(color, normal, specular, to.ray, to.at.y), 1.0);
}
