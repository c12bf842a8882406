// Split and Repeat.
//
// Split (Eq. 1): relative parts share what absolute ones leave; parts that no longer fit become empty; the last part
// ends with the scope. It goes through its parts from the first on and stops at the one that the pixel is in. Repeat
// makes equal parts of about the size v. Sizes are those that may have been written, half a step more or less
// (NumPy: dividing.py), and how far a part's extent may be from what was meant is its slack.
//
// Where the absolute parts may fill the scope, their exact sum is needed. That is seldom, and takes a loop of its own, which
// a software renderer would pay for each time: `divide` then gives up, and is called again when `filling` has the sum.
#include "half_step.glsl"
#include "record.glsl"
#include "near.glsl"

bool divide(inout State now, vec4 head, int code) {
  bool along_y = code == OP_SPLITY || code == OP_REPEATY;
  vec2 span = along_y ? now.scope.yw : now.scope.xz;
  float slack = along_y ? now.slack.y : now.slack.x;
  float grain = span.y * GRAIN;
  float size = span.y - span.x;
  float at = clamp((along_y ? now.at.y : now.at.x) - span.x, 0.0, size * BELOW_ONE);
  float start = 0.0;
  float end = 0.0;
  vec4 part = head;
  int count = 0;
  bool unknown = false;
  if (code <= OP_REPEATY) {
    float held = head.RepeatX_v;
    float parts = max(ceil((size - slack - grain) / (held + half_step(held))), 1.0);
    float width = size / parts;
    float number = min(floor(at / width), parts - 1.0);
    start = number * width;
    end = (number + 1.0) * width;
    slack /= parts;
    count = int(parts);
    part.SplitX_R = head.RepeatX_R;
  } else {
    count = int(head.SplitX_n);
    float absolute = head.SplitX_abs;
    float relative = head.SplitX_rel;
    float total = 0.0;  // above 0: absolute parts fill the scope
    float taken = 0.0;
    if (absolute > 0.0) {
      taken = absolute * HALF_STEP + half_step(absolute);
      if (abs(size - absolute) <= 2.0 * (slack + grain + taken)) {
        unknown = filling.x < 0.0;
        if (abs(size - filling.x) <= slack + grain + filling.y) total = filling.x;
      }
    }
    bool fits = total > 0.0;
    bool over = !fits && absolute > size;
    float whole = relative > 0.0 ? relative : 1.0;
    float unit = fits ? 0.0 : max(size - absolute, 0.0) / whole;
    float stretch = fits ? size / total : 1.0;
    float alone = (slack + taken) / whole;
    float among = alone + unit * (HALF_STEP + half_step(relative) / whole);
    float done = 0.0;
    float reach = slack;
    float own = 0.0;
    float width = 0.0;
    for (int i = 1; i <= count; ++i) {
      part = record(now.rule, i);
      float held = abs(part.SplitX_sv);
      float least = half_step(held);
      reach += own;
      start = end;
      if (part.SplitX_sv < 0.0) {
        width = held * stretch;
        own = least + abs(width - held);
        done += held;
      } else {
        bool several = held != relative;
        width = unit * held;
        own = held * (several ? among : alone) + (several ? unit * least : 0.0);
      }
      end = min(start + width, size);
      bool full = fits ? done >= total : over && size - end <= reach + own + grain;
      if (full || i == count) end = size;
      if (at < end) break;
    }
    slack = end == size ? min(own + abs(end - start - width), reach) : own;
  }
  filling = vec2(-1.0, 0.0);
  if (unknown) return false;
  if (count > 1) near(now, at - start, end - start);
  vec2 found = vec2(span.x + start, span.x + end);
  if (along_y) {
    now.scope.yw = found;
    now.slack.y = slack;
  } else {
    now.scope.xz = found;
    now.slack.x = slack;
  }
  now.rule = ivec2(part.SplitX_R);
  return true;
}
