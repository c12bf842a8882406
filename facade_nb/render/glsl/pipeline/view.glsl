// The camera: every pixel is a point of the window, a plane at unit distance from the eye.

uniform vec3 eye;
uniform vec3 across;
uniform vec3 upward;
uniform vec3 forward;
uniform vec4 window;     // left, bottom; what a pixel covers across and up
uniform float parallel;  // 1: all rays run straight ahead, from the window's points; 0: they come from the eye

/// From the eye through a pixel's middle, of unit depth.
vec3 ray_at(vec2 pixel) {
  vec2 at = window.xy + pixel * window.zw;
  return (1.0 - parallel) * (at.x * across + at.y * upward) + forward;
}

/// Where that ray begins, as seen from the eye.
vec3 start_at(vec2 pixel) {
  vec2 at = window.xy + pixel * window.zw;
  return parallel * (at.x * across + at.y * upward);
}
