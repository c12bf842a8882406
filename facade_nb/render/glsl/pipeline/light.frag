// Light that comes from each pixel, linear: sun, sky and what the ground throws back, lamps (NumPy: daytime.py).
#include "light.glsl"
#include "pixel.glsl"
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

#ifndef ALONE
// Occlusion at a pixel, from those of four that are about as deep.
float open_at(ivec2 at, float depth) {
  vec2 share = share_of(softened);
  ivec2 low = at / 2;
  float sum = 0.0;
  float weight = 0.0;
  for (int k = 0; k < 4; ++k) {
    ivec2 off = ivec2(k & 1, k >> 1);
    vec2 near = pixel(softened, share, low + off).rg;
    vec2 part = mix(vec2(1.0), vec2(0.5), vec2(at & 1));  // a pixel between two takes half of each
    part = mix(part, 1.0 - part, vec2(off));
    float own = (part.x * part.y + 1e-3) * (abs(near.g - depth) < 0.02 * depth + 0.1 ? 1.0 : 0.01);
    sum += own * near.r;
    weight += own;
  }
  return sum / weight;
}
#endif

#if defined(RELIEF) && !defined(ALONE) && !defined(BEHIND)
#define BEYOND
const float HIGHEST = 0.4;  // what relief stands out of a wall at the most, metres
const float FARTHEST = 1.4; // a shadow's way from what throws it, metres
const float STRIDE = 2.5;   // pixels from look to look: further apart, a ragged edge is seen several times in its shadow
const float FEWEST = 14.0;
const float LOOKS = 48.0;

// How much of the sun is left by what stands out of the same wall. Within its own tile relief knows its shadow; of other
// tiles it is known what is seen of them. `surface`: from the eye; `high`: how far it stands out of the wall itself.
float beyond(vec3 surface, vec3 wall, float high, vec2 share) {
  if (high >= HIGHEST) return 1.0;
  float far = min((HIGHEST - high) / max(dot(wall, towards), 1e-3), FARTHEST);
  float left = 1.0;
  float depth_here = dot(surface, forward);
  vec3 end = surface + far * towards;
  vec2 way = vec2(dot(end, across), dot(end, upward)) / max(dot(end, forward), 0.1 * depth_here)
    - vec2(dot(surface, across), dot(surface, upward)) / depth_here;
  float count = clamp(ceil(length(way / window.zw) / STRIDE), FEWEST, LOOKS);
  for (float k = 0.5; k < LOOKS; ++k) {
    if (k > count) break;
    vec3 at = surface + far * k / count * towards;
    float depth = dot(at, forward);
    vec2 spot = (vec2(dot(at, across), dot(at, upward)) / max(depth, 1e-3) - window.xy) / window.zw;
    if (depth <= 0.0 || any(lessThan(spot, vec2(0.0))) || any(greaterThanEqual(spot * share, vec2(1.0)))) break;
    float out_ = textureLod(specular, spot * share, 0.0).a;
    if (out_ > -0.01) continue;  // nothing stands out there
    vec4 there = textureLod(facing, spot * share, 0.0);
    if (there.w <= 0.0 || dot(there.xyz, wall) < 0.999) continue;
    float seen = there.w + out_;
    float above = dot(seen * ray_at(spot) - surface, wall) + high;
    // What is no further out than the surface itself cannot stand before the sun: the way to it leads outwards.
    if (above > high + 0.02 && above < HIGHEST) left = min(left, 1.0 - smoothstep(-0.02, 0.02, depth - seen));
  }
  return left;
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
  float around = shades.y > 0.0 ? open_at(ivec2(gl_FragCoord.xy), face.w + shine.a) : 1.0;
  if (shine.a > 0.001 * face.w + 0.05) around = mix(1.0, around, 0.6);  // in a room: the pane before it mirrors the sky
#endif
  vec4 tint = drawn(color, share);
  if (tint.a > 1.5) {  // relief stands between
    sees *= 3.0 - tint.a;
    tint.a = 1.0;
  }
#ifdef BEYOND
  if (sees > 0.0 && abs(face.y) < 0.2 && shine.a < 0.02 && parallel < 0.5) {
    float high = -shine.a * abs(dot(ray, face.xyz));
    sees = min(sees, beyond((face.w + shine.a) * ray, face.xyz, high, share));
  }
#endif
#ifdef ALONE
  float covers = clamp(tint.a, 0.0, 1.0);  // at its outline a façade is as bright as inside, and covers less
  tint.rgb /= max(covers, 1e-6);
#endif
  vec3 lit = light(
    tint, vec4(0.5 * own.xyz + 0.5, 1.0), shine, ray, vec2(sees, around), point.y
  );
#ifdef ALONE
  lit *= covers;
#endif
  out_light = vec4(lit, tint.a > 0.999 ? 1.0 : tint.a);
}
