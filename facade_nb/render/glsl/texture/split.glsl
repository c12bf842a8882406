// Split (Eq. 1): relative parts share what absolute ones leave; parts that no longer fit become empty; the last part
// ends with the scope. Early intervals first: it stops at the part that the pixel is in.
#include "record.glsl"
#include "near.glsl"

void split(inout State now, vec4 head, bool along_y) {
  float low = along_y ? now.scope.y : now.scope.x;
  float size = (along_y ? now.scope.w : now.scope.z) - low;
  float at = clamp((along_y ? now.at.y : now.at.x) - low, 0.0, size * BELOW_ONE);
  int count = int(head.SplitX_n);
  float unit = head.SplitX_rel > 0.0 ? max(size - head.SplitX_abs, 0.0) / head.SplitX_rel : 0.0;
  float start = 0.0;
  float end = 0.0;
  vec4 part = vec4(0.0);
  for (int i = 1; i <= count; ++i) {
    part = record(now.rule, i);
    start = end;
    float width = part.SplitX_sv < 0.0 ? -part.SplitX_sv : unit * part.SplitX_sv;
    end = i == count ? size : min(start + width, size);
    if (at < end) break;
  }
  if (count > 1) near(at - start, end - start);
  if (along_y) now.scope.yw = vec2(low + start, low + end);
  else now.scope.xz = vec2(low + start, low + end);
  now.rule = ivec2(part.SplitX_R);
}
