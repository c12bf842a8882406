// Split and Repeat.
//
// Split (Eq. 1): relative parts share what absolute ones leave; parts that no longer fit become empty; the last part
// ends with the scope. It goes through its parts from the first on and stops at the one that the pixel is in. Repeat
// makes equal parts of about the size v; the slack is there because v is a 16-bit float.
#include "record.glsl"
#include "near.glsl"

void divide(inout State now, vec4 head, int code) {
  bool along_y = code == OP_SPLITY || code == OP_REPEATY;
  vec2 span = along_y ? now.scope.yw : now.scope.xz;
  float size = span.y - span.x;
  float at = clamp((along_y ? now.at.y : now.at.x) - span.x, 0.0, size * BELOW_ONE);
  float start = 0.0;
  float end = 0.0;
  vec4 part = head;
  int count = 0;
  if (code <= OP_REPEATY) {
    float parts = max(ceil(size / head.RepeatX_v - 0.001), 1.0);
    float width = size / parts;
    float number = min(floor(at / width), parts - 1.0);
    start = number * width;
    end = (number + 1.0) * width;
    count = int(parts);
    part.SplitX_R = head.RepeatX_R;
  } else {
    count = int(head.SplitX_n);
    float unit = head.SplitX_rel > 0.0 ? max(size - head.SplitX_abs, 0.0) / head.SplitX_rel : 0.0;
    for (int i = 1; i <= count; ++i) {
      part = record(now.rule, i);
      start = end;
      float width = part.SplitX_sv < 0.0 ? -part.SplitX_sv : unit * part.SplitX_sv;
      end = i == count ? size : min(start + width, size);
      if (at < end) break;
    }
  }
  if (count > 1) near(now, at - start, end - start);
  vec2 found = vec2(span.x + start, span.x + end);
  if (along_y) now.scope.yw = found;
  else now.scope.xz = found;
  now.rule = ivec2(part.SplitX_R);
}
