// Antialiasing along edges: of meshes, and where the grammar splits. A pixel there is mixed with what lies across the edge,
// by how far along the edge its nearer end is; what is drawn on a tile stays sharp.
#include "pixel.glsl"

uniform highp sampler2D toned;
uniform highp sampler2D facing;
uniform highp sampler2D normal;

layout(location = 0) out highp vec4 out_picture;

const int FAR = 6;

bool apart(ivec2 a, ivec2 b, vec2 share) {
  vec4 one = pixel(facing, share, a);
  vec4 other = pixel(facing, share, b);
  if (dot(one.xyz, other.xyz) < 0.98 && one.w + other.w > 0.0) return true;
  if (abs(one.w - other.w) > 0.03 * min(one.w, other.w) + 0.02) return true;
  return one.w > 0.0 && pixel(normal, share, a).w < 0.75;
}

float bright(ivec2 at, vec2 share) { return pixel(toned, share, at).a; }

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec2 share = share_of(toned);
  vec4 own = drawn(toned, share);
  out_picture = vec4(own.rgb, 1.0);
  float here = own.a;
  float left = bright(at + ivec2(-1, 0), share);
  float right = bright(at + ivec2(1, 0), share);
  float below = bright(at + ivec2(0, -1), share);
  float above = bright(at + ivec2(0, 1), share);
  float high = max(here, max(max(left, right), max(below, above)));
  float low = min(here, min(min(left, right), min(below, above)));
  if (high - low < max(0.04, 0.12 * high)) return;
  bool flat_edge = abs(below + above - 2.0 * here) >= abs(left + right - 2.0 * here);  // it runs across the picture
  ivec2 over = flat_edge ? ivec2(0, 1) : ivec2(1, 0);
  ivec2 along = flat_edge ? ivec2(1, 0) : ivec2(0, 1);
  float before = flat_edge ? below : left;
  float after = flat_edge ? above : right;
  if (abs(before - here) > abs(after - here)) {
    over = -over;
    after = before;
  }
  if (!apart(at, at + over, share)) return;
  float middle = 0.5 * (here + after);
  float step_ = 0.25 * abs(after - here);
  int ahead = 1;
  int back = 1;
  float end_ahead = 0.0;
  float end_back = 0.0;
  for (; ahead <= FAR; ++ahead) {
    end_ahead = 0.5 * (bright(at + ahead * along, share) + bright(at + ahead * along + over, share)) - middle;
    if (abs(end_ahead) >= step_) break;
  }
  for (; back <= FAR; ++back) {
    end_back = 0.5 * (bright(at - back * along, share) + bright(at - back * along + over, share)) - middle;
    if (abs(end_back) >= step_) break;
  }
  float nearer = float(min(ahead, back));
  float ending = ahead < back ? end_ahead : end_back;
  float part = (ending < 0.0) == (here - middle < 0.0) ? 0.0 : 0.5 - nearer / float(ahead + back);
  float around = 0.25 * (left + right + below + above);
  float contrast = clamp(abs(around - here) / (high - low), 0.0, 1.0);
  part = max(part, 0.5 * contrast * contrast);
  vec4 other = pixel(toned, share, at + over);
  out_picture = vec4(mix(own.rgb, other.rgb, part), 1.0);
}
