// Layer: goes to the last rule. The others wait in a frame; the lowest one needs none.
#include "record.glsl"

void layer(inout State now, vec4 head) {
  int count = int(head.Layer_n);
  int held = (count + 1) / 2;
  vec4 records = record(now.rule, held);
  if (count > 1) {
    frames[frame_count].state = now;
    frames[frame_count].below = count - 1;
    frames[frame_count].held = held;
    frames[frame_count].records = records;
    frame_count += 1;
  }
  now.rule = ivec2((count & 1) == 1 ? records.xy : records.zw);
  now.shift += count;
}
