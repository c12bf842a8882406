// Tone mapping, then sRGB (NumPy: developing.py).

vec3 developed(vec3 light, float exposure) {
  vec3 x = light * (0.5 * exposure);
  x += 0.12 * ((x.r + x.g + x.b) / 3.0 - x);
  vec3 curve = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
  vec3 high = 1.055 * pow(max(curve, vec3(1e-8)), vec3(1.0 / 2.4)) - 0.055;
  return mix(high, curve * 12.92, vec3(lessThanEqual(curve, vec3(0.0031308))));
}
