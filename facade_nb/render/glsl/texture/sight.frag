// A façade seen straight on or with a camera (NumPy: view.py).
#include "outputs.glsl"

uniform vec4 window;        // left, bottom; metres (or at unit distance) that a pixel covers across and up
uniform vec2 pixel_shift;   // place in the pixel
uniform vec4 eye;           // and 1; or 0 for none: straight on
uniform vec3 across;
uniform vec3 forward;
uniform float spread;       // of Question
uniform vec2 facade_size;
uniform ivec2 start_rule;
uniform uvec2 seed_whole;
uniform vec2 seed_rest;

void main() {
  vec2 place = window.xy + (floor(gl_FragCoord.xy) + pixel_shift) * window.zw;
  vec3 ray = vec3(0.0, 0.0, -1.0);
  float footprint = min(window.z, window.w);
  bool seen = true;
  if (eye.w > 0.0) {
    ray = place.x * across + forward;
    ray.y += place.y;
    seen = ray.z < -1e-6;
    float reach = eye.z / max(-ray.z, 1e-6);
    place = eye.xy + ray.xy * reach;
    footprint *= reach;
  }
  Surface found = Surface(vec4(0.0), vec4(0.0), vec4(0.0), ivec2(-1));
  margin = 1e9;
  if (seen && place.x >= 0.0 && place.y >= 0.0 && place.x <= facade_size.x && place.y <= facade_size.y) {
    found = evaluate(
      Question(start_rule, facade_size, place, ray, seed_whole, seed_rest, footprint, spread)
    );
  }
  put(found);
}
