// Up to where a pixel is seen through: what stands there is transparent, and what lies further back shows.

uniform highp sampler2D light;
uniform highp sampler2D facing;

layout(location = 0) out highp vec4 out_passed;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  float depth = texelFetch(facing, at, 0).w;
  bool through = depth > 0.0 && texelFetch(light, at, 0).a < 0.999;
  out_passed = vec4(through ? depth : 1e30, 0.0, 0.0, 1.0);
}
