// Layer: goes to the last rule. The others wait in a frame; the lowest one needs none.
#include "record.glsl"

void layer(inout State now, vec4 head) {
  int count = int(head.Layer_n);
  vec4 records = record(now.rule, (count + 1) / 2);
  bool odd = (count & 1) == 1;
  if (count > 1) {
    for (int i = 0; i < MAX_FRAMES; ++i) {
      if (i == frame_count) {
        frames[i].state = now;
        frames[i].below = count - 1;
        frames[i].next = records.xy;
      }
    }
    frame_count += 1;
  }
  now.rule = ivec2(odd ? records.xy : records.zw);
  now.shift += count;
}
