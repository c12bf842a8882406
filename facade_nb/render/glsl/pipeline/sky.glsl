// The sky along a direction, linear (NumPy: daytime.py).

uniform vec3 zenith;
uniform vec3 horizon;

vec3 sky_along(vec3 ray) {
  vec3 to = normalize(ray);
  float rise = pow(clamp(to.y, 0.0, 1.0), 0.7);
  float glow = pow(clamp(dot(to, towards), 0.0, 1.0), 24.0);
  return mix(horizon, zenith, rise) + 0.16 * glow * sun;
}
