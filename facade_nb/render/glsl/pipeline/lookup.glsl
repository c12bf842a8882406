// A map of depth in which one light sees all that throws shadows: which points it reaches.
#include "pixel.glsl"
#include "view.glsl"

uniform mat4 from_world;  // to the map's clip space
flat in vec3 light_to;
flat in vec3 light_scale;

const float THICK = 0.006;  // metres: what is not further behind what the light meets is not behind it

// The point that a pixel shows.
vec3 point_at(vec2 pixel_, vec4 face) { return eye + start_at(pixel_) + face.w * ray_at(pixel_); }

struct Lookup {
  vec3 place;    // in the map, as shares: across, up, deep
  mat2x3 metre;  // what a metre along the surface is there, in two directions
};

vec3 turned_to_map(vec3 way) {
  return 0.5 * (from_world[0].xyz * way.x + from_world[1].xyz * way.y + from_world[2].xyz * way.z);
}

// A point is looked up off the surface, so that that does not shade itself; and around it along the surface, for the same
// reason.
Lookup lookup(vec3 point, vec3 normal, highp sampler2D map) {
  vec2 texels = light_scale.xy * vec2(textureSize(map, 0));  // in a metre
  vec3 lifted = point + (0.004 + 1.2 / min(texels.x, texels.y)) * normal;
  vec3 along = normalize(abs(normal.y) < 0.9 ? vec3(normal.z, 0.0, -normal.x) : vec3(0.0, -normal.z, normal.y));
  return Lookup(
    turned_to_map(lifted) + 0.5 * from_world[3].xyz + 0.5,
    mat2x3(turned_to_map(along), turned_to_map(cross(normal, along)))
  );
}

// 1 where the light comes, `off` metres beside the point. Beyond the map nothing throws shadows; what lies further back
// than all in it may be in the shadow of that.
float reached(highp sampler2D map, Lookup from, vec2 off) {
  vec3 at = from.place + from.metre[0] * off.x + from.metre[1] * off.y;
  if (any(lessThan(at.xy, vec2(0.0))) || any(greaterThanEqual(at.xy, vec2(1.0)))) return 1.0;
  return textureLod(map, at.xy, 0.0).r + THICK * light_scale.z >= min(at.z, 1.0) ? 1.0 : 0.0;
}
