// The grammar at every visible pixel: what the G-buffer says is asked of it. Normals leave it in the world's axes.
#include "evaluate.glsl"
#include "pixel.glsl"
#include "view.glsl"
#include "seed.glsl"

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
layout(location = 2) out highp vec4 out_specular;  // and how far the pixel lies behind its wall; NOTHING where there is nothing
#ifdef PICK
layout(location = 3) out highp ivec4 out_terminal;
#endif

const highp float NOTHING = -6e4;  // before the camera, where no pixel lies

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
  vec3 ray = ray_at(gl_FragCoord.xy);
  vec3 own = vec3(dot(ray, tangent), dot(ray, up), dot(ray, face.xyz));
  float spread = min(window.z, window.w);
#ifdef RELIEF
  sunward = vec3(dot(towards, tangent), dot(towards, up), sun.r + sun.g > 0.0 ? dot(towards, face.xyz) : 0.0);
#endif
  Seed seed = seed_of(of_rule.zw);
  Surface found = evaluate(Question(
    ivec2(of_rule.xy), on.zw, clamp(on.xy, vec2(0.0), on.zw), own, seed.whole, seed.rest, face.w * spread, spread
  ));
  out_color = found.color;
#ifdef RELIEF
  if (found.color.a >= OPAQUE && shadow > 0.0) out_color.a = 2.0 + min(shadow, 1.0);
#endif
  vec3 turned = 2.0 * (found.normal.xyz + (1.0 - found.normal.a) * vec3(0.5, 0.5, 1.0)) - 1.0;
  out_normal = vec4(turned.x * tangent + turned.y * up + turned.z * face.xyz, min(margin, 9.0));
  out_specular = vec4(found.specular.rgb, found.color.a > 0.0 ? deep / spread : NOTHING);
#ifdef COUNT_FETCHES
  out_color = vec4(float(fetches));  // in place of what is seen, for a bench
#endif
#ifdef PICK
  out_terminal = ivec4(found.rule, 0, 0);
#endif
}
