// The camera: every pixel is a point of the window, a plane at unit distance from the eye.

uniform vec3 eye;
uniform vec3 across;
uniform vec3 upward;
uniform vec3 forward;
uniform vec4 window;  // left, bottom; what a pixel covers across and up

/// From the eye through a pixel's middle, of unit depth.
vec3 ray_at(vec2 pixel) {
  vec2 at = window.xy + pixel * window.zw;
  return at.x * across + at.y * upward + forward;
}
