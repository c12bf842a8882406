// Relief mapping (the texture paper's section 6; NumPy: relief.py). The scope's plane is the highest of the tile's surface.
// The viewing ray goes on behind it until it meets the surface: by steps, then by halving the last one. What lies there is
// seen at the pixel. Beyond a scope a stretched tile is the same again where it goes on, else as it is at its edge; past one
// that stands on a wall the layer below is seen, if there is one.
#include "level.glsl"
#include "record.glsl"
#include "height.glsl"

#ifdef RELIEF
struct Struck {
  vec2 at;       // what is seen, metres
  float out_;    // how far that stands out of the wall, metres
  float shade;   // how much of the sun the relief takes from it
  bool beside;   // the ray has left the scope
};

const float STEEPEST = 6.0;     // metres along the wall for one behind it, at most
const float MOST_STEPS = 32.0;
const float MOST_SHADES = 12.0;
const float AHEAD = 1.25;        // texels
const float NEAR_BY = 0.002;    // as a share of the relief: half a step of 8 bits

Struck struck;        // by the ray; kept, for the next material of a scope most often has the same relief
vec4 struck_numbers;
vec4 struck_scope;
vec2 struck_at;
int struck_heights;
bool struck_past;
bool relieved;        // whether the material at hand is seen with relief, which is then `struck`
vec4 of_relief;       // opaque, tile of heights and marks, depth, how far it stands out
float shadow;         // how much of the sun what is seen has lost, each layer's weighted as its colour
vec3 sunward = vec3(0.0);  // towards the sun, in the façade's axes; z 0 or less: no shadows

// Metres along the wall for one behind it.
vec2 slope_of(vec3 way) {
  vec2 slope = way.xy / max(abs(way.z), 1e-6);
  return slope * min(1.0, STEEPEST / max(length(slope), 1e-6));
}

// How much of a way along the wall lies in the scope, but for the axes along which the tile goes on.
float within_scope(vec2 at, vec4 scope, vec2 way, bvec2 wrap) {
  vec2 space = vec2(way.x < 0.0 ? at.x - scope.x : scope.z - at.x, way.y < 0.0 ? at.y - scope.y : scope.w - at.y);
  vec2 part = space / max(abs(way), vec2(1e-9));
  if (wrap.x) part.x = 1.0;
  if (wrap.y) part.y = 1.0;
  return clamp(min(part.x, part.y), 0.0, 1.0);
}

// How much of the sun is hidden from a point `deep` (0 to 1) behind the highest: the more the surface stands above the
// way to the sun, and the nearer, the more.
float shade_at(vec2 at, vec2 uv, vec2 scale, float deep, float depth, vec4 box, vec4 scope, bvec2 wrap, bool past) {
  vec2 way = slope_of(sunward) * (deep * depth);
  float end = past ? within_scope(at, scope, way, wrap) : 1.0;
  float count = clamp(ceil(0.5 * end * length(way * scale * box.zw)), 2.0, MOST_SHADES);
  float far = length(way);
  float shade = 0.0;
  for (float i = 0.5; i < MOST_SHADES; ++i) {
    float part = end * i / count;
    float above = (height(box, uv + part * way * scale, wrap) - 1.0 + deep * (1.0 - part) - 0.01) * depth;
    shade = max(shade, above / (0.002 + 0.05 * part * far));
    if (i + 1.0 >= count) break;
  }
  return min(shade, 1.0);
}

// How much of a relief is left where a pixel covers much of it.
float faded(State now, float depth) {
#ifdef MIPS
  return clamp(2.0 - 2.0 * now.footprint / max(depth, 1e-6), 0.0, 1.0);
#else
  return 1.0;
#endif
}

// Whether one may see past a tile that has these marks.
bool passable(int source, int marks) { return source > 0 && frame_count > 0 && (marks & 4) == 4; }

// Whether the ray has yet to be followed into the material's relief. Materials of a scope most often share one, and others
// have none: so a loop of its own goes on from material to material, and the search lies outside of it.
// `numbers`: its second record.
bool unmet(State now, vec4 head, vec4 numbers) {
  int code = int(head.r);
  int source = int(head.Mat_m1);
  of_relief = fetch(tile_table, of_tile_table, vec2(0, abs(source) - 1));
  int heights = int(of_relief.g) / 8;
  relieved = (code == OP_MAT || code == OP_MATALPHA) && source != 0 && heights != 0 && faded(now, of_relief.b) > 0.0;
  bool past = passable(source, int(of_relief.g));
  bool same = heights == struck_heights && past == struck_past && numbers == struck_numbers;
  return relieved && !(same && now.at == struck_at && now.scope == struck_scope);
}

// Follows it; `unmet` has looked at the material.
void strike(State now, vec4 head, vec4 numbers) {
  int source = int(head.Mat_m1);
  vec4 known = of_relief;
  int heights = int(known.g) / 8;
  int marks = int(known.g) & 7;
  float fade = faded(now, known.b);
  bool past = passable(source, marks);
  struck_heights = heights;
  struck_past = past;
  struck_numbers = numbers;
  struck_at = now.at;
  struck_scope = now.scope;
  bvec2 wrap = bvec2(true);
  vec2 extent = now.scope.zw - now.scope.xy;
  vec2 scale = numbers.zw;
  vec2 uv = numbers.xy + now.at * scale;
  if (source > 0) {
    vec2 shown = numbers.zw - numbers.xy;
    wrap = bvec2((marks & 1) == 1 && abs(shown.x) == 1.0, (marks & 2) == 2 && abs(shown.y) == 1.0);
    scale = shown / extent;
    uv = numbers.xy + clamp((now.at - now.scope.xy) / extent, vec2(0.0), vec2(1.0)) * shown;
  }
  int size = min(level(now, heights, abs(scale)), tile_levels - 1);
  vec4 box = fetch(tile_table, of_tile_table, vec2(size + 1, heights - 1));
  float depth = known.b * fade;
  vec2 way = slope_of(now.ray) * depth;
  float end = past ? within_scope(now.at, now.scope, way, wrap) : 1.0;
  float texels = end * length(way * scale * box.zw);
  float count = clamp(ceil(0.7 * texels), 1.0, MOST_STEPS);
  float ahead = AHEAD / max(length(way * scale * box.zw), 1e-9);
  float deep = 0.0;
  float before = 0.0;
  float further = 0.0;  // a steep side is as its edge is, a texel on: there nothing of what lies below it is mixed in
  float least = 0.0;
  float most = 0.0;
  bool met = false;
  // All looks at the surface go through one line, since compilers copy it and software pays for each copy: first straight
  // in, then step by step, then halving the last step, then ahead.
  float step_ = 0.0;
  float halved = 0.0;
  float at = 0.0;
  for (int look_ = 0; look_ < 40; ++look_) {
    float surface_ = 1.0 - height(box, uv + at * way * scale, wrap);
    bool under = surface_ - at <= NEAR_BY;
    if (step_ == 0.0) {
      deep = under ? 0.0 : surface_;
      least = deep;
      most = deep;
      met = under || texels < 0.05;
      if (met) halved = 7.0;
    } else if (!met) {
      least = min(least, surface_);
      most = max(most, surface_);
      deep = at;
      met = under;
      if (!met) before = at;
    } else if (halved < 6.0) {
      if (under) deep = at;
      else before = at;
    } else {
      further = ahead * clamp((deep - surface_) * depth / (ahead * length(way)) - 1.0, 0.0, 1.0);
    }
    if (met) halved += 1.0;
    else step_ += 1.0;
    at = !met ? end * step_ / count : halved < 6.0 ? 0.5 * (before + deep) : deep + ahead;
    if (halved > 6.0 || step_ > count) break;
  }
#ifdef EDGES
  if ((most - least) * length(way) > now.footprint) margin = 0.0;  // other parts of the relief are near in the picture
#endif
  struck.at = now.at + (deep + further) * way;
  struck.out_ = known.a * fade - deep * depth;
  if (source > 0) {  // in the scope beside it, where the same is seen
    vec2 part = (struck.at - now.scope.xy) / extent;
    if (wrap.x) struck.at.x -= floor(part.x) * extent.x;
    if (wrap.y) struck.at.y -= floor(part.y) * extent.y;
  }
  struck.beside = past && !met;
  struck.shade = 0.0;
  if (sunward.z > 0.0 && now.faces == 0 && deep > 0.0) {
    struck.shade = fade * shade_at(now.at + deep * way, uv + deep * way * scale, scale, deep, depth, box, now.scope, wrap, past);
  }
}
#endif
