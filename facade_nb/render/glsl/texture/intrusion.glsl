// Intrusion: the face of the box behind the scope that the ray hits becomes the scope, seen from inside. Its lower left
// corner is that of the scope that it lies behind.
#include "half_step.glsl"
#include "record.glsl"
#include "near.glsl"

void intrusion(inout State now, vec4 head) {
  for (int i = 0; i < MAX_ROOMS; ++i) {
    if (i == now.rooms) outside[i] = Room(now.at, now.ray, now.footprint, now.faces);
  }
  float depth = head.Intrusion_v;
  vec2 corner_ = now.scope.xy;
  vec2 extent = now.scope.zw - corner_;
  vec2 at = clamp(now.at - corner_, vec2(0.0), extent);
  float into = abs(now.ray.z);
  float far_x = (now.ray.x < 0.0 ? at.x : extent.x - at.x) / max(abs(now.ray.x), 1e-30);
  float far_y = (now.ray.y < 0.0 ? at.y : extent.y - at.y) / max(abs(now.ray.y), 1e-30);
  float far_z = depth / max(into, 1e-30);
  float far = min(min(far_x, far_y), far_z);
  int face = far_z <= far ? 1 : far_x <= far ? (now.ray.x < 0.0 ? 0 : 2) : (now.ray.y < 0.0 ? 3 : 4);
  far = min(far, 1e30);
  vec2 hit = clamp(at + now.ray.xy * far, vec2(0.0), extent);
  float deep = clamp(into * far, 0.0, depth);
  vec3 ray = vec3(now.ray.xy, into);

  vec4 records;
  if (face == 0) {
    records = vec4(0.0, 0.0, head.Intrusion_left);
    at = vec2(deep, hit.y);
    extent.x = depth;
    now.slack.x = half_step(depth);
    now.ray = vec3(ray.z, ray.y, ray.x);
  } else if (face <= 2) {
    records = record(now.rule, 1);
    if (face == 1) {
      records.zw = records.Intrusion_back;
      at = hit;
      now.ray = vec3(ray.x, ray.y, -ray.z);
    } else {
      at = vec2(depth - deep, hit.y);
      extent.x = depth;
      now.slack.x = half_step(depth);
      now.ray = vec3(-ray.z, ray.y, -ray.x);
    }
  } else {
    records = record(now.rule, 2);
    extent.y = depth;
    now.slack.y = half_step(depth);
    if (face == 3) {
      records.zw = records.Intrusion_floor;
      at = vec2(hit.x, deep);
      now.ray = vec3(ray.x, ray.z, ray.y);
    } else {
      at = vec2(hit.x, depth - deep);
      now.ray = vec3(ray.x, -ray.z, -ray.y);
    }
  }
  now.footprint += asked.spread * far;
  near(now, at.x, extent.x);
  near(now, at.y, extent.y);
  now.rule = ivec2(records.zw);
  now.at = corner_ + at;
  now.scope = vec4(corner_, corner_ + extent);
  now.shift += face + 1;
  now.faces = now.faces * 8 + face + 1;
  now.rooms += 1;
}
