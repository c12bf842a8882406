// From light to a picture: exposure, a film's curve, sRGB.
#include "developed.glsl"
#include "pixel.glsl"

uniform highp sampler2D air;
uniform float exposure;

layout(location = 0) out highp vec4 out_toned;

void main() {
  vec4 seen = drawn(air, share_of(air));
#ifdef ALONE
  seen.rgb /= max(seen.a, 1e-6);
#endif
  vec3 shown = clamp(developed(seen.rgb, exposure), 0.0, 1.0);
#ifndef ALONE
  // Without grain, 256 steps of each colour are bands in an evening's sky. It follows from the pixel alone, in whole
  // numbers, so it is the same on every card: Bayer's matrix, 8 × 8, as the pieces of a large still begin at multiples of 8.
  uvec2 at = uvec2(gl_FragCoord.xy);
  at.x ^= at.y;
  uvec2 turned = (at & 1u) << 4u | (at & 2u) << 1u | (at & 4u) >> 2u;
  shown += ((float(turned.x << 1u | turned.y) + 0.5) / 64.0 - 0.5) / 255.0;
#endif
  out_toned = vec4(shown, dot(shown, vec3(0.299, 0.587, 0.114)));  // and how bright
}
