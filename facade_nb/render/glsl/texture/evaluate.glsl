// The evaluator: from the start rule to the colour of one pixel (texture paper, 3 and 4).
//
// Pixels that are drawn together (in warps, or in the vectors of a software renderer) pay for every branch that one of
// them takes. So there are two loops: the inner one goes down through splits, repeats and choices, which are cheap; the
// outer one has the rest, and reads tiles at a single place.
#include "globals.glsl"
#include "descend.glsl"
#include "layer.glsl"
#include "next_layer.glsl"
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
  while (taken < MAX_STEPS) {
    vec4 head = descend(now, taken);
    int code = int(head.r);
    if (code == OP_INTRUSION) {
      intrusion(now, head);
    } else if (code == OP_LAYER) {
      layer(now, head);
    } else {
      int skipped = terminal(now, head);
      if (!next_layer(now, skipped)) break;
    }
  }
  return surface;
}
