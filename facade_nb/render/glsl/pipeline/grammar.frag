// The grammar at every visible pixel: what the G-buffer says is asked of it. Normals leave it in the world's axes.
#include "evaluate.glsl"
#include "pixel.glsl"
#include "view.glsl"
#include "seed.glsl"
#include "beside.glsl"

uniform highp sampler2D place;
uniform highp sampler2D rule;
uniform highp sampler2D facing;
uniform highp sampler2D along;

#ifdef RELIEF
uniform vec3 towards;
uniform vec3 sun;
#endif

layout(location = 0) out highp vec4 out_color;     // alpha: 2 and how much of the sun the relief takes, where it takes any
layout(location = 1) out highp vec4 out_normal;    // of length 1 out of doors, 0 in a room; how near a boundary is, in pixels
layout(location = 2) out highp vec4 out_specular;  // and how far the pixel lies behind its wall; NOWHERE where it is all open
#ifdef PICK
layout(location = 3) out highp ivec4 out_terminal;
#endif

const highp float NOWHERE = -6e4;  // before the camera, where no pixel lies

void main() {
  vec2 share = share_of(facing);
  vec4 face = drawn(facing, share);
  out_color = vec4(0.0);
  out_normal = vec4(0.0, 0.0, 0.0, 9.0);
  out_specular = vec4(0.0);
#ifdef PICK
  out_terminal = ivec4(-1);
#endif
  if (face.w <= 0.0) return;
  vec4 on = drawn(place, share);
  vec4 of_rule = drawn(rule, share);
  vec3 tangent = drawn(along, share).xyz;
  vec3 up = cross(face.xyz, tangent);
  float extent = min(window.z, window.w);
#ifdef RELIEF
  float lost = 0.0;  // of the sun, behind relief
  sunward = vec3(dot(towards, tangent), dot(towards, up), sun.r + sun.g > 0.0 ? dot(towards, face.xyz) : 0.0);
#endif
  Seed seed = seed_of(of_rule.zw);
  Surface found = Surface(vec4(0.0), vec4(0.0), vec4(0.0), ivec2(-1));
#ifdef SAMPLES
  bool edge = outline(face, tangent, up, on);
  Surface one = found;
  for (int k = -1; k < 16; ++k) {  // all samples go through one call, since compilers copy the evaluator into each
    Spot spot = beside(k < 0 ? gl_FragCoord.xy : floor(gl_FragCoord.xy) + sample_place(k), face, tangent, up, on.xy);
    float size = extent * (k < 0 ? 1.0 : SHARE) * mix(spot.depth, 1.0, parallel);
    float spread = extent * (k < 0 ? 1.0 : SHARE) * (1.0 - parallel);
    one = Surface(vec4(0.0), vec4(0.0), vec4(0.0), ivec2(-1));
    margin = 1e9;
#ifdef RELIEF
    shadow = 0.0;
#endif
    if (within(spot, on.zw)) {
      one = evaluate(Question(ivec2(of_rule.xy), on.zw, spot.at, spot.own, seed.whole, seed.rest, size, spread));
    }
    if (k >= 0) {
      found.color += one.color / 16.0;
      found.normal += one.normal / 16.0;
      found.specular += one.specular / 16.0;
#ifdef RELIEF
      lost += shadow / 16.0;
#endif
#ifndef EVERYWHERE
    } else if (!edge && margin >= NEAR_SPLIT) {
      found = one;
#ifdef RELIEF
      lost = shadow;
#endif
      break;
#endif
    }
  }
#else
  Spot spot = beside(gl_FragCoord.xy, face, tangent, up, on.xy);
#ifdef OUTLINE
  if (!within(spot, on.zw)) return;
#endif
  found = evaluate(Question(
    ivec2(of_rule.xy), on.zw, clamp(on.xy, vec2(0.0), on.zw), spot.own, seed.whole, seed.rest,
    extent * mix(face.w, 1.0, parallel), extent * (1.0 - parallel)
  ));
#ifdef RELIEF
  lost = shadow;
#endif
#endif
  out_color = found.color;
#if defined(RELIEF) && !defined(COLOR_ONLY)
  if (found.color.a >= OPAQUE && lost > 0.0) out_color.a = 2.0 + min(lost, 1.0);
#endif
  vec3 turned = 2.0 * (found.normal.xyz + (1.0 - found.normal.a) * vec3(0.5, 0.5, 1.0)) - 1.0;
  out_normal = vec4(turned.x * tangent + turned.y * up + turned.z * face.xyz, min(margin, 9.0));
  out_specular = vec4(found.specular.rgb, found.color.a > 0.0 ? (1.0 - parallel) * deep / extent : NOWHERE);
#ifdef COUNT_FETCHES
  out_color = vec4(float(fetches));  // in place of what is seen, for a bench
#endif
#ifdef PICK
  out_terminal = ivec4(found.rule, 0, 0);
#endif
}
