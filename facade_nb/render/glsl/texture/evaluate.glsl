// The evaluator: from the start rule to the colour of one pixel (texture paper, 3 and 4).
#include "globals.glsl"
#include "split.glsl"
#include "repeat.glsl"
#include "choose.glsl"
#include "layer.glsl"
#include "next_layer.glsl"
#include "skip_mask.glsl"
#include "intrusion.glsl"
#include "material.glsl"

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
  now.shift = 1;
  now.faces = 0;
  now.seeds = 0;
  for (int taken = 0; taken < MAX_STEPS; ++taken) {
    bool ends = true;  // an empty scope shows nothing
    int skipped = 0;
    if (now.scope.z > now.scope.x && now.scope.w > now.scope.y) {
      vec4 head = record(now.rule, 0);
      int code = int(head.r);
      ends = code >= OP_SKIP && code != OP_INTRUSION;
      if (code <= OP_REPEATY) repeat(now, head, code == OP_REPEATY);
      else if (code <= OP_SPLITY) split(now, head, code == OP_SPLITY);
      else if (code <= OP_RANDUNI) choose(now, head, code == OP_RANDUNI);
      else if (code == OP_RANDSTACK) {
        seed_stack[now.seeds] = corner(now);
        now.seeds += 1;
        now.rule = ivec2(head.RandStack_R);
      }
      else if (code == OP_LAYER) layer(now, head);
      else if (code == OP_SKIP) skipped = int(head.Skip_l);
      else if (code == OP_SKIPMASK) skipped = skip_mask(now, head);
      else if (code == OP_INTRUSION) intrusion(now, head);
      else material(now, head, code == OP_MATALPHA);
    }
    if (ends && !next_layer(now, skipped)) break;
  }
  return surface;
}
