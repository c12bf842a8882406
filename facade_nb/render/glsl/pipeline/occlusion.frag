// Ambient occlusion in screen space: how much of the half sphere above a point its neighbours hide. Pixels stand where the
// grammar has put them, so rooms are deep, and the reveals around a window shade it. One of four pixels is looked at.
#include "mixed.glsl"
#include "pixel.glsl"
#include "view.glsl"

uniform highp sampler2D specular;
uniform highp sampler2D facing;
uniform float reach;  // metres

layout(location = 0) out highp vec4 out_occlusion;  // and how deep

const int TAPS = 8;
const vec2 GOLDEN = vec2(-0.7373688, 0.6754903);  // cosine and sine of the golden angle
const float WIDEST = 0.06;  // at unit distance: close to a wall, not all of the picture is looked at

void main() {
  ivec2 most = textureSize(specular, 0) - 1;
  vec2 share = share_of(specular);
  ivec2 cell = ivec2(gl_FragCoord.xy);
  ivec2 at = min(2 * cell, most);
  vec4 face = pixel(facing, share, at);
  float depth = face.w + pixel(specular, share, at).a;
  out_occlusion = vec4(1.0, depth, 0.0, 1.0);
  if (depth <= 0.0) return;
  float covers = depth * window.w;
  float radius = min(reach / covers, WIDEST / window.w);
  if (radius < 1.5) return;
  vec3 point = ray_at(vec2(at) + 0.5) * depth;
  uint number = mixed(uint(cell.x & 3) * 4u + uint(cell.y & 3));
  float turn = float(number & 1023u) * (6.2831853 / 1024.0);
  vec2 way = vec2(cos(turn), sin(turn));
  float hidden = 0.0;
  for (int k = 0; k < TAPS; ++k) {
    float far = radius * (float(k) + 0.5) / float(TAPS);
    ivec2 near = clamp(at + ivec2(round(far * way)), ivec2(0), most);
    way = vec2(GOLDEN.x * way.x - GOLDEN.y * way.y, GOLDEN.y * way.x + GOLDEN.x * way.y);
    float other = pixel(facing, share, near).w + pixel(specular, share, near).a;
    if (other <= 0.0) continue;
    vec3 to = ray_at(vec2(near) + 0.5) * other - point;
    float length2 = dot(to, to);
    float above = dot(to, face.xyz) - 0.02 - 0.0015 * depth;
    hidden += max(above, 0.0) * inversesqrt(length2 + 1e-4) * max(0.0, 1.0 - length2 / (reach * reach));
  }
  out_occlusion.r = clamp(1.0 - 2.6 * hidden / float(TAPS), 0.0, 1.0);
}
