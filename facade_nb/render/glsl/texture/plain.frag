// What sight.frag has drawn, its colours as they are.

uniform highp sampler2D seen_color;

layout(location = 0) out highp vec4 out_color;

void main() {
  out_color = clamp(texelFetch(seen_color, ivec2(gl_FragCoord.xy), 0), 0.0, 1.0);
}
