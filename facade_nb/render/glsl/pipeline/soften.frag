// Occlusion without the pattern of its taps: the mean of 4 × 4 of its pixels that are about as deep.

uniform highp sampler2D occlusion;

layout(location = 0) out highp vec4 out_softened;  // and how deep

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  ivec2 most = textureSize(occlusion, 0) - 1;
  float depth = texelFetch(occlusion, at, 0).g;
  out_softened = vec4(1.0, depth, 0.0, 1.0);
  if (depth <= 0.0) return;
  float sum = 0.0;
  float weight = 0.0;
  for (int k = 0; k < 16; ++k) {
    vec2 near = texelFetch(occlusion, clamp(at + ivec2(k & 3, k >> 2) - ivec2(2), ivec2(0), most), 0).rg;
    float own = abs(near.g - depth) < 0.02 * depth + 0.1 ? 1.0 : 0.02;
    sum += own * near.r;
    weight += own;
  }
  out_softened.r = sum / weight;
}
