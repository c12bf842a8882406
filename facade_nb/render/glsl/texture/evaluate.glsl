// The evaluator: from the start rule to the colour of one pixel (texture paper, 3 and 4).
//
// Pixels that are drawn together (in warps, or in the vectors of a software renderer) pay for every branch that one of
// them takes. So loops lie inside each other, the cheapest innermost: splits and repeats (`divide`), choices (`choose`),
// layers and skips (`advance`), and out here rooms and tiles.
#include "globals.glsl"
#include "advance.glsl"
#include "intrusion.glsl"
#include "terminal.glsl"

Surface evaluate(Question question) {
  asked = question;
  surface = Surface(vec4(0.0), vec4(0.0), vec4(0.0), ivec2(-1));
  frame_count = 0;
  margin = 1e9;
#ifdef COUNT_FETCHES
  fetches = 0;
#endif
  State now;
  now.rule = question.start;
  now.scope = vec4(0.0, 0.0, question.size);
  now.at = question.at;
  now.ray = vec3(question.ray.xy, -abs(question.ray.z));
  now.footprint = question.footprint;
  now.shift = 1;
  now.faces = 0;
  now.seeds = 0;
  int taken = 0;
  vec4 head = vec4(0.0);
  while (advance(now, taken, head)) {
    if (int(head.r) == OP_INTRUSION) intrusion(now, head);
    else if (!next_layer(now, terminal(now, head))) break;
  }
  return surface;
}
