// The evaluator: from the start rule to the colour of one pixel (texture paper, 3 and 4).
//
// Pixels that are drawn together (in warps, or in the vectors of a software renderer) pay for every branch that one of
// them takes, and in a software renderer for every branch and every round of a loop, taken or not. So loops lie inside
// each other, the cheapest innermost: splits and repeats; layers, skips and seeds; choices; tiles and rooms. They end at
// their foot, where nothing more is left to be passed through.
#include "globals.glsl"
#include "enter.glsl"
#include "divide.glsl"
#include "pass.glsl"
#include "choose.glsl"
#include "terminal.glsl"
#include "intrusion.glsl"

bool divides(int code) { return code >= OP_REPEATX && code <= OP_SPLITY; }
bool passes(int code) { return code >= OP_RANDSTACK && code <= OP_SKIP || code == OP_NOTHING; }
bool chooses(int code) { return code == OP_RAND || code == OP_RANDUNI; }

Surface evaluate(Question question) {
  asked = question;
  surface = Surface(vec4(0.0), vec4(0.0), vec4(0.0), ivec2(-1));
  frame_count = 0;
  margin = 1e9;
#ifdef DEEP
  deep = 0.0;
#endif
#ifdef RELIEF
  struck_heights = 0;
  shadow = 0.0;
#endif
#ifdef COUNT_FETCHES
  fetches = 0;
#endif
  State now;
  now.rule = question.start;
  now.scope = vec4(0.0, 0.0, question.size);
  now.slack = vec2(0.0);
  now.at = question.at;
  now.ray = vec3(question.ray.xy, -abs(question.ray.z));
  now.footprint = question.footprint;
  now.shift = 1;
  now.faces = 0;
  now.seeds = 0;
  int taken = 0;
  vec4 head = enter(now, taken);
  int code = int(head.r);
  do {
    do {
      do {
        do {
          if (divides(code)) {
            divide(now, head, code);
            head = enter(now, taken);
            code = int(head.r);
          }
        } while (divides(code));
        if (passes(code)) {
          head = pass(now, head, code) ? enter(now, taken) : END;
          code = int(head.r);
        }
      } while (divides(code) || passes(code));
      if (chooses(code)) {
        choose(now, head);
        head = enter(now, taken);
        code = int(head.r);
      }
    } while (divides(code) || passes(code) || chooses(code));
    if (code != OP_END) {
      bool more = true;
      if (code == OP_INTRUSION) intrusion(now, head);
      else more = next_layer(now, terminal(now, head));
      head = more ? enter(now, taken) : END;
      code = int(head.r);
    }
  } while (code != OP_END);
  return surface;
}
