// Adds a value where what lies above has left room (Eq. 2, 3).

void add(inout vec4 total, vec3 value, float alpha) {
  float weight = (1.0 - total.a) * alpha;
  total += vec4(weight * value, weight);
}
