// After a terminal: goes on with the layer below, passing over `skipped` more; what exceeds the innermost Layer goes on
// in the one around it. False: there is none, or colour is opaque.
#include "record.glsl"

bool next_layer(inout State now, int skipped) {
  if (surface.color.a >= OPAQUE) return false;
  while (frame_count > 0) {
    int top = frame_count - 1;
    int layer = frames[top].below - skipped;
    if (layer < 1) {
      skipped -= frames[top].below;
      frame_count = top;
      continue;
    }
    now = frames[top].state;
    int pixel = (layer + 1) / 2;
    if (pixel != frames[top].held) {  // two layers share a pixel
      frames[top].records = record(now.rule, pixel);
      frames[top].held = pixel;
    }
    vec4 records = frames[top].records;
    now.rule = ivec2((layer & 1) == 1 ? records.xy : records.zw);
    now.shift += layer;
    frames[top].below = layer - 1;
    if (layer == 1) frame_count = top;
    return true;
  }
  return false;
}
