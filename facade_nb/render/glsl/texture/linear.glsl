// Linear light from sRGB, 0 to 1.

vec3 linear(vec3 colour) {
  vec3 low = colour / 12.92;
  vec3 high = pow((colour + 0.055) / 1.055, vec3(2.4));
  return mix(high, low, vec3(lessThanEqual(colour, vec3(0.04045))));
}
