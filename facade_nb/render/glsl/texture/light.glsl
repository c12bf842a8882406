// Light, linear, that comes from a point of a façade at an hour (NumPy: daytime.py, where it is explained).
#include "linear.glsl"

uniform vec3 towards;     // to the sun, in the façade's axes
uniform vec3 sun;
uniform vec3 sky;
uniform vec3 ground;
uniform vec3 indoors;
uniform vec2 lamps;       // lamp light in rooms; street lamps

// `free`: how much of the sun a point sees, how much of what else is around it, and of the light of street lamps.
vec3 light(vec4 color, vec4 normal, vec4 specular, vec3 ray, vec3 free, float height) {
  vec3 along = 2.0 * (normal.xyz + (1.0 - normal.a) * vec3(0.5, 0.5, 1.0)) - 1.0;
  float size = length(along);
  float outside = clamp(size, 0.0, 1.0);
  vec3 unit = along / max(size, 1e-4);
  float facing = clamp(dot(unit, towards), 0.0, 1.0) * free.x;
  float low = exp(-max(height, 0.0) / 3.0);
  vec3 outdoors = facing * sun
    + free.y * (0.62 + 0.38 * unit.y) * (1.0 - 0.28 * low) * sky
    + free.y * (0.5 - 0.5 * unit.y + 0.35 * low) * ground
    + free.z * lamps.y * exp(-max(height - 2.5, 0.0) / 4.5) * vec3(1.0, 0.77, 0.52);
  vec3 lamp = clamp(specular.rgb - outside, 0.0, 1.0) * lamps.x;
  vec3 lit = linear(clamp(color.rgb, 0.0, 1.0)) * (outside * outdoors + free.y * (1.0 - outside) * indoors + lamp);
  vec3 between = towards - ray / max(length(ray), 1e-6);
  between /= max(length(between), 1e-6);
  float shine = pow(clamp(dot(unit, between), 0.0, 1.0), 60.0) * free.x * outside;
  return lit + 0.5 * shine * specular.rgb * sun;
}
