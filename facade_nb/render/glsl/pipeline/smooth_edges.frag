// Antialiasing along edges: of meshes, and where the grammar splits. A pixel there is mixed with what lies across the edge,
// by how far along the edge its nearer end is; what is drawn on a tile stays sharp.

uniform highp sampler2D toned;
uniform highp sampler2D facing;
uniform highp sampler2D normal;

layout(location = 0) out highp vec4 out_picture;

const int FAR = 6;

bool apart(ivec2 a, ivec2 b, ivec2 most) {
  vec4 one = texelFetch(facing, clamp(a, ivec2(0), most), 0);
  vec4 other = texelFetch(facing, clamp(b, ivec2(0), most), 0);
  if (dot(one.xyz, other.xyz) < 0.98 && one.w + other.w > 0.0) return true;
  if (abs(one.w - other.w) > 0.03 * min(one.w, other.w) + 0.02) return true;
  return texelFetch(normal, clamp(a, ivec2(0), most), 0).w < 0.75;
}

float bright(ivec2 at, ivec2 most) { return texelFetch(toned, clamp(at, ivec2(0), most), 0).a; }

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  ivec2 most = textureSize(toned, 0) - 1;
  vec4 own = texelFetch(toned, at, 0);
  out_picture = vec4(own.rgb, 1.0);
  float here = own.a;
  float left = bright(at + ivec2(-1, 0), most);
  float right = bright(at + ivec2(1, 0), most);
  float below = bright(at + ivec2(0, -1), most);
  float above = bright(at + ivec2(0, 1), most);
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
  if (!apart(at, at + over, most)) return;
  float middle = 0.5 * (here + after);
  float step_ = 0.25 * abs(after - here);
  int ahead = 1;
  int back = 1;
  float end_ahead = 0.0;
  float end_back = 0.0;
  for (; ahead <= FAR; ++ahead) {
    end_ahead = 0.5 * (bright(at + ahead * along, most) + bright(at + ahead * along + over, most)) - middle;
    if (abs(end_ahead) >= step_) break;
  }
  for (; back <= FAR; ++back) {
    end_back = 0.5 * (bright(at - back * along, most) + bright(at - back * along + over, most)) - middle;
    if (abs(end_back) >= step_) break;
  }
  float nearer = float(min(ahead, back));
  float ending = ahead < back ? end_ahead : end_back;
  float share = (ending < 0.0) == (here - middle < 0.0) ? 0.0 : 0.5 - nearer / float(ahead + back);
  float around = 0.25 * (left + right + below + above);
  float contrast = clamp(abs(around - here) / (high - low), 0.0, 1.0);
  share = max(share, 0.5 * contrast * contrast);
  vec4 other = texelFetch(toned, clamp(at + over, ivec2(0), most), 0);
  out_picture = vec4(mix(own.rgb, other.rgb, share), 1.0);
}
