// Layer, RandStack and Skip, and what shows nothing. False: there is nothing left to do.
#include "layer.glsl"
#include "next_layer.glsl"
#include "stack.glsl"

bool pass(inout State now, vec4 head, int code) {
  if (code == OP_LAYER) layer(now, head);
  else if (code == OP_RANDSTACK) stack(now, head);
  else return next_layer(now, code == OP_SKIP ? int(head.Skip_l) : 0);
  return true;
}
