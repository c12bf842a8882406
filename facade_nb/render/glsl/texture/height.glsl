// Height, from 0 to 1, of a tile of heights at (u, v), bilinear. A texel holds four heights, so one fetch does.
#include "fetch.glsl"

float height(vec4 box, vec2 uv, bvec2 wrap) {
  vec2 around = (uv - floor(uv)) * box.zw - 0.5;
  vec2 held = clamp(clamp(uv, vec2(0.0), vec2(1.0)) * box.zw - 0.5, vec2(0.0), box.zw - 1.0);
  vec2 place = vec2(wrap.x ? around.x : held.x, wrap.y ? around.y : held.y);
  vec2 low = floor(place);
  vec2 part = place - low;
  if (low.x < 0.0) low.x = box.z - 1.0;
  if (low.y < 0.0) low.y = box.w - 1.0;
  vec4 four = fetch(atlas, of_atlas, box.xy + low);
  vec2 rows = mix(four.xz, four.yw, part.x);
  return mix(rows.x, rows.y, part.y);
}
