// Goes on to the next operator that costs something: Intrusion, SkipMask, Mat or MatAlpha. `head` is its first record.
// Layers are entered and skips are followed here. False: there is nothing left to do.
#include "descend.glsl"
#include "layer.glsl"
#include "next_layer.glsl"

bool advance(inout State now, inout int taken, out vec4 head) {
  while (taken < MAX_STEPS) {
    head = descend(now, taken);
    int code = int(head.r);
    bool unseen = code > OP_MATALPHA;  // an empty scope shows nothing
#ifdef COLOR_ONLY
    unseen = unseen || (code >= OP_MAT && int(head.Mat_u) != USAGE_COLOR);
#endif
    if (code == OP_LAYER) {
      layer(now, head);
    } else if (code == OP_SKIP || unseen) {
      if (!next_layer(now, code == OP_SKIP ? int(head.Skip_l) : 0)) return false;
    } else {
      return true;
    }
  }
  return false;
}
