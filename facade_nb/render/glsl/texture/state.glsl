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
  int seeds;    // how many corners are on the seed stack
};

// A Layer operator with layers still to come.
struct Frame {
  State state;  // as the operator found it
  int below;    // how many layers are still to come
  vec2 next;    // position of the rule of the layer below, where its record has been read with that of the one above
};
