// Other points of a pixel's square, on the façade that its middle shows (NumPy: antialias.py).

struct Spot {
  vec2 at;      // on the façade, metres
  vec3 own;     // the ray, in the façade's axes
  float depth;  // before the camera, metres; below 0: it is not met
};

Spot beside(vec2 pixel, vec4 face, vec3 tangent, vec3 up, vec2 at) {
  vec3 ray = ray_at(pixel);
  vec3 start = start_at(pixel);
  vec3 middle = start_at(gl_FragCoord.xy) + face.w * ray_at(gl_FragCoord.xy);
  float into = dot(ray, face.xyz);
  float depth = into < -1e-6 ? dot(middle - start, face.xyz) / into : -1.0;
  vec3 way = start + depth * ray - middle;
  return Spot(at + vec2(dot(way, tangent), dot(way, up)), vec3(dot(ray, tangent), dot(ray, up), into), depth);
}

bool within(Spot spot, vec2 size) {
  return spot.depth > 0.0 && min(spot.at.x, spot.at.y) >= 0.0 && spot.at.x <= size.x && spot.at.y <= size.y;
}

#ifdef SAMPLES
const float NEAR_SPLIT = 0.75;  // pixels from a boundary: half a diagonal, and a little
const float SHARE = 0.25;       // of a pixel's width: how large a sample is

// No two of the 16 share a column or a row.
vec2 sample_place(int k) {
  int turned_ = (k & 1) * 8 + (k & 2) * 2 + (k & 4) / 2 + (k & 8) / 8;
  return (vec2(k, turned_) + 0.5) / 16.0;
}

// Whether the façade ends beside the pixel; `on`: place and size.
bool outline(vec4 face, vec3 tangent, vec3 up, vec4 on) {
  vec2 at = gl_FragCoord.xy;
  bool here = within(beside(at, face, tangent, up, on.xy), on.zw);
  bool apart = false;
  for (int k = 0; k < 4; ++k) {
    vec2 to = vec2((k & 1) * 2 - 1, 0.0);
    apart = apart || within(beside(at + (k < 2 ? to : to.yx), face, tangent, up, on.xy), on.zw) != here;
  }
  return apart;
}
#endif
