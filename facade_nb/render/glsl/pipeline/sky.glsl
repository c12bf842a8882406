// The sky along a direction, linear (NumPy: daytime.py), and fair-weather clouds before it.
#include "mixed.glsl"

uniform vec3 zenith;
uniform vec3 horizon;
uniform vec3 sky;
uniform vec3 afterglow;

// How much of the light that a low sun leaves is in a direction: low above the horizon, on the sun's side.
float beside_sun(vec3 to, float ahead) {
  float side = (0.5 + 0.5 * ahead) * clamp(1.0 - 2.2 * to.y, 0.0, 1.0);
  return side * side * side;
}

vec3 clear_sky(vec3 to) {
  float rise = pow(clamp(to.y, 0.0, 1.0), 0.7);
  float ahead = dot(to, towards);
  float glow = pow(clamp(ahead, 0.0, 1.0), 24.0);
  return mix(horizon, zenith, rise) + beside_sun(to, ahead) * afterglow + 0.16 * glow * sun;
}

// A direction that does not point below the horizon.
vec3 level(vec3 ray) { return normalize(vec3(ray.x, max(ray.y, 0.02 * length(ray)), ray.z)); }

// What the air itself shows: the sky low above the horizon (`clear`) towards the sun, more of its light with the sun behind.
vec3 mist_along(vec3 to, vec3 clear) {
  float ahead = 0.5 + 0.5 * dot(normalize(to.xz + vec2(1e-6)), normalize(towards.xz + vec2(1e-6)));
  return mix(0.75 * sky + 0.25 * horizon, clear, mix(0.35, 1.0, ahead * ahead));
}

float grain(ivec2 cell) {
  return float(mixed(mixed(uint(cell.x + 4096)) ^ uint(cell.y + 4096)) >> 8u) * (1.0 / 16777216.0);
}

// Smooth noise from 0 to 1.
float smooth_noise(vec2 at) {
  vec2 low = floor(at);
  vec2 part = at - low;
  part = part * part * (3.0 - 2.0 * part);
  ivec2 cell = ivec2(low);
  float under = mix(grain(cell), grain(cell + ivec2(1, 0)), part.x);
  float over = mix(grain(cell + ivec2(0, 1)), grain(cell + ivec2(1, 1)), part.x);
  return mix(under, over, part.y);
}

// Clouds lie on a plane, so they draw together towards the horizon; there they go over into the haze.
vec3 sky_along(vec3 ray) {
  vec3 to = normalize(ray);
  vec3 found = clear_sky(to);
  if (to.y < 0.03) return found;
  vec2 at = to.xz / (to.y + 0.15) * 1.7 + vec2(7.3, 2.1);
  float thick = 0.0;
  float part = 0.5;
  for (int k = 0; k < 5; ++k) {
    thick += part * smooth_noise(at);
    at = mat2(1.6, 1.2, -1.2, 1.6) * at + 3.7;
    part *= 0.52;
  }
  float cover = smoothstep(0.50, 0.70, thick) * smoothstep(0.03, 0.22, to.y);
  float ahead = dot(to, towards);
  float lit = 0.75 + 0.5 * pow(clamp(ahead, 0.0, 1.0), 6.0);
  // What is thick is darker below; a low sun colours the rims on its side.
  float rim = 1.0 - smoothstep(0.56, 0.86, thick);
  vec3 cloud = (0.12 + 0.24 * rim) * lit * sun + (0.8 + 0.3 * rim) * sky + 0.25 * horizon
    + (0.25 + 0.5 * rim) * (0.5 + 0.5 * ahead) * afterglow;
  return mix(found, cloud, 0.85 * cover);
}
