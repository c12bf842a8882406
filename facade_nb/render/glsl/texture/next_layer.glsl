// After a terminal: goes on with the layer below, passing over `skipped` more; what exceeds the innermost Layer goes on
// in the one around it. False: there is none, or colour is opaque.
#include "record.glsl"

bool next_layer(inout State now, int skipped) {
  if (surface.color.a >= OPAQUE) return false;
  int layer = 0;
  bool fresh = false;
  vec2 next = vec2(0.0);
  for (int i = MAX_FRAMES - 1; i >= 0; --i) {
    if (i < frame_count && layer < 1) {
      fresh = skipped > 0;  // its record has not been read with the one above
      layer = frames[i].below - skipped;
      skipped -= frames[i].below;
      now = frames[i].state;
      next = frames[i].next;
      frames[i].below = layer - 1;
      frame_count = layer > 1 ? i + 1 : i;
    }
  }
  if (layer < 1) return false;
  vec2 place = next;
  if (fresh || (layer & 1) == 0) {
    vec4 records = record(now.rule, (layer + 1) / 2);
    place = (layer & 1) == 1 ? records.xy : records.zw;
    // where this was the last of its Layer, the frame on top is another's
    for (int i = 0; i < MAX_FRAMES; ++i) if (layer > 1 && i == frame_count - 1) frames[i].next = records.xy;
  }
  now.rule = ivec2(place);
  now.shift += layer;
  return true;
}
