// A façade seen straight on or with a camera (NumPy: view.py).
#include "outputs.glsl"
#include "look.glsl"

uniform vec2 pixel_shift;   // place in the pixel
uniform float spread;       // of Question
uniform vec2 facade_size;
uniform ivec2 start_rule;
uniform uvec2 seed_whole;
uniform vec2 seed_rest;
#ifdef RELIEF
uniform vec3 to_sun;         // in the façade's axes
#endif

void main() {
#ifdef RELIEF
  sunward = to_sun;
  shadow = 0.0;
#endif
  Look to = look(floor(gl_FragCoord.xy) + pixel_shift);
  Surface found = Surface(vec4(0.0), vec4(0.0), vec4(0.0), ivec2(-1));
  margin = 1e9;
  if (to.seen && to.at.x >= 0.0 && to.at.y >= 0.0 && to.at.x <= facade_size.x && to.at.y <= facade_size.y) {
    found = evaluate(
      Question(start_rule, facade_size, to.at, to.ray, seed_whole, seed_rest, to.footprint, spread)
    );
  }
  put(found);
}
