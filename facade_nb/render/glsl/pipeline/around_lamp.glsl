// How far it is from a street lamp to the walls around it (lamplight.py).

flat in ivec3 walls;

const float REACH = 13.0;  // metres

// The first wall in one of 15 directions: one over its distance, in 15ths of the reach.
float wall(int k) {
  k = k > 14 ? k - 15 : k;
  int part = k < 5 ? walls.x : k < 10 ? walls.y : walls.z;
  return 1.0 / float(15 - (part >> (4 * (k % 5)) & 15));
}

// Metres to the first wall along `way`, east and north of the lamp; far more than the reach where none is.
float wall_along(vec2 way) {
  if (walls == ivec3(0)) return 1e3;
  float turns = 15.0 * fract(atan(way.y, way.x) * 0.15915494 + 1.0);
  int k = min(int(turns), 14);
  float far = REACH / 15.0 / mix(wall(k), wall(k + 1), turns - float(k));  // so it is true along a straight wall
  return far > 0.99 * REACH ? 1e3 : far;
}
