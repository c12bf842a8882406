// Whether what turns to the eye is open at a place: leaves have gaps. The alpha of the tile says so that is the uppermost
// colour of its rule, or of the layers of its rule; what has no such tile is closed.

uniform highp sampler2D grammar;
uniform highp sampler2D atlas;
uniform highp sampler2D tile_table;

float alpha_at(vec4 box, ivec2 texel) {
  return texelFetch(atlas, ivec2(box.xy) + clamp(texel, ivec2(0), ivec2(box.zw) - 1), 0).a;
}

// The number of the tile that is the uppermost colour of a rule, and its record; 0: there is none.
int painted(inout ivec2 rule) {
  vec4 head = texelFetch(grammar, rule, 0);
  ivec2 first = rule;
  int count = int(head.r) == OP_LAYER ? int(head.Layer_n) : 0;
  for (int k = count; k >= 0; --k) {
    int code = int(head.r);
    if (code == OP_MAT && int(head.Mat_u) == USAGE_COLOR && head.Mat_m1 > 0.0) return int(head.Mat_m1);
    if (k == 0) return 0;
    vec4 records = texelFetch(grammar, first + ivec2((k + 1) / 2, 0), 0);
    rule = ivec2((k & 1) == 1 ? records.xy : records.zw);
    head = texelFetch(grammar, rule, 0);
  }
  return 0;
}

// `covers`: how much of the quad a pixel covers, metres. `least`: what is less opaque is open.
bool open(ivec2 rule, vec2 place, vec2 size, float covers, float least) {
  int tile = painted(rule);
  if (tile == 0) return false;
  vec4 shown = texelFetch(grammar, rule + ivec2(1, 0), 0);
  vec2 uv = mix(shown.xy, shown.zw, place / size);
  vec2 texels = texelFetch(tile_table, ivec2(1, tile - 1), 0).zw * abs(shown.zw - shown.xy) / size * covers;
  int level = int(log2(max(max(texels.x, texels.y), 1.0)));
  vec4 box = texelFetch(tile_table, ivec2(min(level, textureSize(tile_table, 0).x - 2) + 1, tile - 1), 0);
  vec2 at = uv * box.zw - 0.5;
  ivec2 low = ivec2(floor(at));
  vec2 part = at - floor(at);
  float under = mix(alpha_at(box, low), alpha_at(box, low + ivec2(1, 0)), part.x);
  float over = mix(alpha_at(box, low + ivec2(0, 1)), alpha_at(box, low + ivec2(1, 1)), part.x);
  return mix(under, over, part.y) < least;
}
