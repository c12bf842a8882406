// A normal of a face of an intrusion, written as (n + 1) / 2, as the façade has it.

vec3 turned(vec3 n, int faces) {
  for (int i = 0; i < MAX_ROOMS && faces > 0; ++i) {
    int face = faces & 7;
    faces /= 8;
    if (face == 1) n = vec3(n.z, n.y, 1.0 - n.x);
    else if (face == 3) n = vec3(1.0 - n.z, n.y, n.x);
    else if (face == 4) n = vec3(n.x, n.z, 1.0 - n.y);
    else if (face == 5) n = vec3(n.x, 1.0 - n.z, n.y);
  }
  return n;
}
