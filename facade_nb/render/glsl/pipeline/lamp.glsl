// Which of what turns is a street lamp.

const vec2 LAMP = vec2(0.8, 4.4);  // nothing else that turns is as wide and as tall (things.py)

bool is_lamp(vec2 size, vec3 normal) { return dot(normal, normal) <= 0.25 && all(lessThanEqual(abs(size - LAMP), vec2(0.001))); }

// How far it is to walls around it, as it is packed (lamplight.py).
ivec3 walls_of(vec3 normal) { return ivec3(normal * 4194304.0 + 0.5); }
