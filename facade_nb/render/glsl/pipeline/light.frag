// Light that comes from each pixel, linear: sun, sky and what the ground throws back, lamps (NumPy: daytime.py).
#include "light.glsl"
#include "pixel.glsl"
#ifdef LAMPS
#include "lamp_share.glsl"
#endif
#if !defined(ALONE) && !defined(GATHERED)
#include "sunlit.glsl"
#endif
#include "view.glsl"

uniform highp sampler2D color;
uniform highp sampler2D normal;
uniform highp sampler2D specular;
uniform highp sampler2D facing;
#ifndef ALONE
uniform highp sampler2D softened;
#ifdef GATHERED
uniform highp sampler2D sunny;
#endif
uniform vec2 shades;  // 1: there are shadows; 1: there is occlusion
#endif

layout(location = 0) out highp vec4 out_light;

#if defined(RELIEF) && !defined(ALONE) && !defined(BEHIND)
#define OVERHANG
uniform highp sampler2D overhang;
#endif

#ifndef ALONE
// What a half as fine buffer (value, depth) says at a pixel: by those of its four that are about as deep. `apart`: how much
// another depth there may be, for each metre of depth, and beside that.
float finer(highp sampler2D half_as_fine, ivec2 at, float depth, vec2 apart) {
  vec2 share = share_of(half_as_fine);
  ivec2 low = at / 2;
  float sum = 0.0;
  float weight = 0.0;
  for (int k = 0; k < 4; ++k) {
    ivec2 off = ivec2(k & 1, k >> 1);
    vec2 near = pixel(half_as_fine, share, low + off).rg;
    vec2 part = mix(vec2(1.0), vec2(0.5), vec2(at & 1));  // a pixel between two takes half of each
    part = mix(part, 1.0 - part, vec2(off));
    float own = (part.x * part.y + 1e-3) * (abs(near.g - depth) < apart.x * depth + apart.y ? 1.0 : 0.01);
    sum += own * near.r;
    weight += own;
  }
  return sum / weight;
}
#endif

void main() {
  vec2 share = share_of(facing);
  vec4 face = drawn(facing, share);
  out_light = vec4(0.0);
  if (face.w <= 0.0) return;
  vec3 ray = ray_at(gl_FragCoord.xy);
  vec3 point = eye + start_at(gl_FragCoord.xy) + face.w * ray;
  vec4 own = drawn(normal, share);
#ifdef ALONE
  float sees = 1.0;
#elif defined(GATHERED) && defined(BEHIND)
  float sees = 1.0;  // what is gathered is that of what stands in front
#elif defined(GATHERED)
  float sees = shades.x > 0.0 ? drawn(sunny, share).r : 1.0;
#else
  float sees = shades.x > 0.0 && dot(face.xyz, towards) > 0.0 ? sunlit(point, face.xyz) : 1.0;
#endif
  vec4 shine = drawn(specular, share);
#if defined(BEHIND) || defined(ALONE)
  float around = 1.0;  // occlusion is that of what stands in front
#else
  float around = shades.y > 0.0 ? finer(softened, ivec2(gl_FragCoord.xy), face.w + shine.a, vec2(0.02, 0.1)) : 1.0;
  if (shine.a > 0.001 * face.w + 0.05) around = mix(1.0, around, 0.6);  // in a room: the pane before it mirrors the sky
#endif
  vec4 tint = drawn(color, share);
  if (tint.a > 1.5) {  // relief stands between
    sees *= 3.0 - tint.a;
    tint.a = 1.0;
  }
#ifdef OVERHANG
  sees = min(sees, finer(overhang, ivec2(gl_FragCoord.xy), face.w + shine.a, vec2(0.003, 0.02)));
#endif
#ifdef ALONE
  float covers = clamp(tint.a, 0.0, 1.0);  // at its outline a façade is as bright as inside, and covers less
  tint.rgb /= max(covers, 1e-6);
#endif
#ifdef LAMPS
  float lamps_near = lamps.y > 0.0 ? lamp_share(point, length(point.xz - eye.xz)) : 0.0;
#else
  float lamps_near = 1.0;  // no lamp is known
#endif
  vec3 lit = light(
    tint, vec4(0.5 * own.xyz + 0.5, 1.0), shine, ray, vec3(sees, around, around * lamps_near), point.y
  );
#ifdef ALONE
  lit *= covers;
#endif
  out_light = vec4(lit, tint.a > 0.999 ? 1.0 : tint.a);
}
