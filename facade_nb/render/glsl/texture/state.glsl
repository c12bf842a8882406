// What a pixel carries along on its way through the grammar (NumPy: batch.py).

struct State {
  ivec2 rule;   // column and row of the rule's first record
  vec4 scope;   // left, bottom, right, top, metres
  vec2 slack;   // how far the scope's extents may be from what was meant, metres
  vec2 at;      // where the pixel is, metres
  vec3 ray;     // direction of the viewing ray: x and y along the scope, z out of it
  float footprint;  // metres that the pixel covers there, across the ray
  int shift;    // how often the seed is added to the scope's corner
  int faces;    // faces of intrusions, three bits each, the innermost lowest
  int rooms;    // how many they are
  int seeds;    // how many corners are on the seed stack
};

// A Layer operator with layers still to come, as it found the pixel. Few numbers, for a software renderer moves them all
// whenever one pixel of eight comes to a Layer: positions are packed, and what changes in rooms alone is kept apart.
struct Frame {
  int rule;     // row · 65536 + column
  vec4 scope;
  vec2 slack;
  int shift;
  int held;     // layers still to come · 128 + seeds · 8 + rooms
  int next;     // position of the rule of the layer below, where its record has been read with that of the one above
};

// What an intrusion changes.
struct Room {
  vec2 at;
  vec3 ray;
  float footprint;
  int faces;
};
