// One pass more, as data: it marks the building that is chosen, by the seed that all its walls carry.

import type { Buffer, Pass } from "./types.ts";

export const CHOSEN: Pass = {
  name: "chosen",
  vertex: "whole.vert",
  fragment: "chosen.frag",
  reads: ["picture", "rule"],
  writes: ["marked"],
  draws: "screen",
  through: "",
  when: "chosen",
  tells: "Marks the building that is chosen.",
};

export const MARKED: Buffer = {
  name: "marked",
  channels: 4,
  kind: "f1",
  tells: "The picture with a line around the building that is chosen.",
  side: 0,
  part: 1,
};

export const SHADER = `#version 300 es
precision highp float;
precision highp int;
uniform highp sampler2D picture;
uniform highp sampler2D rule;
uniform vec2 chosen_seed;
layout(location = 0) out highp vec4 out_marked;
bool own(ivec2 at, ivec2 most) { return texelFetch(rule, clamp(at, ivec2(0), most), 0).zw == chosen_seed; }
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  ivec2 most = textureSize(rule, 0) - 1;
  vec3 seen = texelFetch(picture, at, 0).rgb;
  bool inside = own(at, most);
  int wide = max(1, most.y / 260);
  bool edge = false;
  for (int k = 0; k < 8; ++k) {
    ivec2 off = wide * (ivec2(k % 3, k / 3) - 1);
    if (k == 4) off = ivec2(wide);
    edge = edge || own(at + off, most) != inside;
  }
  vec3 line = vec3(0.16, 0.66, 1.0);
  out_marked = vec4(edge ? mix(seen, line, 0.92) : inside ? mix(seen, line, 0.14) : seen, 1.0);
}
`;
