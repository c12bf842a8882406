// Occlusion without the pattern of its taps: the mean of 4 × 4 of its pixels that are about as deep.
#include "pixel.glsl"

uniform highp sampler2D occlusion;

layout(location = 0) out highp vec4 out_softened;  // and how deep

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec2 share = share_of(occlusion);
  float depth = drawn(occlusion, share).g;
  out_softened = vec4(1.0, depth, 0.0, 1.0);
  if (depth <= 0.0) return;
  float sum = 0.0;
  float weight = 0.0;
  for (int k = 0; k < 16; ++k) {
    vec2 near = pixel(occlusion, share, at + ivec2(k & 3, k >> 2) - 2).rg;
    float own = abs(near.g - depth) < 0.02 * depth + 0.1 ? 1.0 : 0.02;
    sum += own * near.r;
    weight += own;
  }
  out_softened.r = sum / weight;
}
