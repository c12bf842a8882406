// A picture without its sky and its ground: of these only the shadow is left that falls on the ground.
#include "pixel.glsl"
#include "view.glsl"

uniform vec3 towards;
uniform vec3 sun;
uniform vec3 sky;
uniform vec2 shades;
uniform highp sampler2D toned;
uniform highp sampler2D facing;
uniform highp sampler2D sunny;
uniform highp sampler2D softened;

layout(location = 0) out highp vec4 out_cut;

const vec3 SHADOW = vec3(0.06, 0.06, 0.08);
const float LEVEL = 0.005;  // metres

void main() {
  vec4 face = drawn(facing, share_of(facing));
  out_cut = vec4(0.0);
  if (face.w <= 0.0) return;
  float height = (eye + start_at(gl_FragCoord.xy) + face.w * ray_at(gl_FragCoord.xy)).y;
  if (face.y < 0.99 || height > LEVEL) {
    out_cut = vec4(drawn(toned, share_of(toned)).rgb, 1.0);
    return;
  }
  vec3 direct = max(towards.y, 0.0) * sun;
  float full = dot(direct + sky, vec3(1.0));
  float sees = shades.x > 0.0 ? drawn(sunny, share_of(sunny)).r : 1.0;
  float around = shades.y > 0.0 ? pixel(softened, share_of(softened), ivec2(gl_FragCoord.xy) / 2).r : 1.0;
  out_cut = vec4(SHADOW, clamp(1.0 - dot(sees * direct + around * sky, vec3(1.0)) / full, 0.0, 1.0));
}
