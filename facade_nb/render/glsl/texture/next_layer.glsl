// After a terminal: goes on with the layer below, passing over `skipped` more; what exceeds the innermost Layer goes on
// in the one around it. False: there is none, or colour is opaque.
#include "record.glsl"
#include "place.glsl"

bool next_layer(inout State now, int skipped) {
  int found = -1;
  int layer = 0;
  bool fresh = false;
  for (int i = MAX_FRAMES - 1; i >= 0; --i) {
    if (i < frame_count && layer < 1) {
      int below = frames[i].held >> 7;
      fresh = skipped > 0;  // its record has not been read with the one above
      layer = below - skipped;
      skipped -= below;
      found = i;
    }
  }
  bool more = layer > 0 && surface.color.a < OPAQUE;
  if (more) {
    Frame own = frames[0];
    for (int i = 1; i < MAX_FRAMES; ++i) if (i == found) own = frames[i];
    frame_count = layer > 1 ? found + 1 : found;
    int rooms = own.held & 7;
    if (rooms < now.rooms) {
      Room outer = outside[0];
      for (int i = 1; i < MAX_ROOMS; ++i) if (i == rooms) outer = outside[i];
      now.at = outer.at;
      now.ray = outer.ray;
      now.footprint = outer.footprint;
      now.faces = outer.faces;
      now.rooms = rooms;
    }
    now.scope = own.scope;
    now.slack = own.slack;
    now.shift = own.shift + layer;
    now.seeds = own.held >> 3 & 15;
    now.rule = place_of(own.rule);
    int next = own.next;
    if (fresh || (layer & 1) == 0) {
      vec4 records = record(now.rule, (layer + 1) / 2);
      next = one_of(ivec2((layer & 1) == 1 ? records.xy : records.zw));
      own.next = one_of(ivec2(records.xy));
    }
    now.rule = place_of(next);
    int held = (layer - 1) << 7 | own.held & 127;
    for (int i = 0; i < MAX_FRAMES; ++i) {
      if (i == found) {
        frames[i].held = held;
        frames[i].next = own.next;
      }
    }
  }
  return more;
}
