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
  out_toned = vec4(shown, dot(shown, vec3(0.299, 0.587, 0.114)));  // and how bright
}
