// The evaluator: from the start rule to the colour of one pixel (texture paper, 3 and 4).
//
// Pixels that are drawn together (in warps, or in the vectors of a software renderer) pay for every branch that one of
// them takes, and in a software renderer for every branch and every round of a loop, taken or not. So loops lie inside
// each other, those that are met most or are cheapest innermost: layers and seeds; splits and repeats; choices; terminals
// and skips (those whose relief is known innermost of all); rooms. They end at their foot, where nothing more is left to be
// passed through. Each code belongs to one of them, also one that there is not: a position that is none of a rule must not
// hold up a page for ever.
#include "globals.glsl"
#include "enter.glsl"
#include "divide.glsl"
#include "absolutes.glsl"
#include "layer.glsl"
#include "stack.glsl"
#include "choose.glsl"
#include "terminal.glsl"
#include "next_layer.glsl"
#include "intrusion.glsl"
#include "tried.glsl"

const int UNKNOWN = 100;  // added to the code of a Split that waits for the sum of its absolute sizes

bool divides(int code) { return code >= OP_REPEATX && code <= OP_SPLITY; }
bool chooses(int code) { return code == OP_RAND || code == OP_RANDUNI; }
bool descends(int code) { return code == OP_RANDSTACK || code == OP_LAYER; }
bool waits(int code) { return code == UNKNOWN + OP_SPLITX || code == UNKNOWN + OP_SPLITY; }
bool ends(int code) {
  return !descends(code) && !divides(code) && !chooses(code) && !waits(code) && code != OP_INTRUSION && !tried(code) && code != OP_END;
}

Surface evaluate(Question question) {
  of_grammar = 1.0 / vec2(textureSize(grammar, 0));
  of_atlas = 1.0 / vec2(textureSize(atlas, 0));
  of_tile_table = 1.0 / vec2(textureSize(tile_table, 0));
  tile_levels = textureSize(tile_table, 0).x - 1;
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
  now.rooms = 0;
  filling = vec2(-1.0, 0.0);
  now.seeds = 0;
  int taken = 0;
  vec4 head = enter(now, taken);
  int code = int(head.r);
  do {
    do {
      do {
        do {
          do {
            if (descends(code)) {
              if (code == OP_LAYER) layer(now, head);
              else if (code == OP_RANDSTACK) stack(now, head);
              head = enter(now, taken);
              code = int(head.r);
            }
          } while (descends(code));
          if (divides(code)) {
            if (divide(now, head, code)) {
              head = enter(now, taken);
              code = int(head.r);
            } else {
              code += UNKNOWN;
            }
          }
        } while (descends(code) || divides(code));
        if (chooses(code)) {
          choose(now, head);
          head = enter(now, taken);
          code = int(head.r);
        }
      } while (descends(code) || divides(code) || chooses(code));
      vec4 numbers = numbers_of(now.rule, code);
#ifdef RELIEF
      bool beyond = ends(code) && unmet(now, head, numbers);
#endif
      do {
#ifdef RELIEF
        if (beyond) strike(now, head, numbers);
#endif
        do {
          Shown shown = plainly(head, numbers);
          if (looks(code, head)) shown = looked_up(now, head, numbers);
          do {
            if (ends(code)) {
              if (code == OP_MAT || code == OP_MATALPHA) terminal(now, head, shown);
              head = next_layer(now, shown.skipped) ? enter(now, taken) : END;
              code = int(head.r);
              numbers = numbers_of(now.rule, code);
              shown = plainly(head, numbers);
            }
          } while (ends(code) && !looks(code, head));
#ifdef RELIEF
          beyond = ends(code) && unmet(now, head, numbers);
        } while (ends(code) && !beyond);
#else
        } while (ends(code));
#endif
      } while (ends(code));
    } while (descends(code) || divides(code) || chooses(code) || ends(code));
    if (waits(code)) {
      code -= UNKNOWN;
      filling = absolutes(now.rule, int(head.SplitX_n));
    }
    if (code == OP_INTRUSION) {
      intrusion(now, head);
      head = enter(now, taken);
      code = int(head.r);
    }
    if (tried(code)) {
      try_out(now, head, code);
      head = enter(now, taken);
      code = int(head.r);
    }
  } while (code != OP_END);
  return surface;
}
