// Layer: goes to the last rule. The others wait in a frame; the lowest one needs none.
#include "record.glsl"
#include "place.glsl"

void layer(inout State now, vec4 head) {
  int count = int(head.Layer_n);
  vec4 records = record(now.rule, (count + 1) / 2);
  bool odd = (count & 1) == 1;
  Frame own = Frame(
    one_of(now.rule), now.scope, now.slack, now.shift, (count - 1) * 128 + now.seeds * 8 + now.rooms,
    one_of(ivec2(records.xy))
  );
  int place = count > 1 ? frame_count : -1;
  for (int i = 0; i < MAX_FRAMES; ++i) if (i == place) frames[i] = own;
  if (count > 1) frame_count += 1;
  now.rule = ivec2(odd ? records.xy : records.zw);
  now.shift += count;
}
