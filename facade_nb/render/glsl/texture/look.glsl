// Where a point of a picture looks: straight on, or from an eye (NumPy: view.py).

uniform vec4 window;        // left, bottom; metres (or at unit distance) that a pixel covers across and up
uniform vec4 eye;           // and 1; or 0 for none: straight on
uniform vec3 across;
uniform vec3 forward;

struct Look {
  vec2 at;          // metres on the façade's plane
  vec3 ray;         // from the eye to there
  float footprint;  // metres that a pixel covers there, across the ray
  bool seen;        // whether the plane is ahead
};

// `pixel`: from the picture's lower left corner, in pixels.
Look look(vec2 pixel) {
  vec2 place = window.xy + pixel * window.zw;
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
  return Look(place, ray, footprint, seen);
}
