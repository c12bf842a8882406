// Red, green, blue and alpha of a material's source: 0 a constant, above 0 a tile stretched over the scope, below 0 one
// that repeats over the façade.
#include "fit.glsl"

vec4 value(State now, int source, vec4 numbers) {
  if (source == 0) return numbers;
  if (source > 0) return fit(now, source, numbers);
  vec2 uv = numbers.xy + now.at * numbers.zw;
  return texel(-source, uv, true, level(-source, abs(numbers.zw)));
}
