// What has no normal turns to whoever looks: crowns of trees, trunks, lamp posts, chimneys. All corners of such a quad have the place
// of its middle; its tangent is the axis about which it turns, or nothing: then it turns all ways.

struct Standing {
  vec3 position;
  vec3 normal;
  vec3 tangent;
};

bool turns(vec3 normal) { return dot(normal, normal) < 0.25; }

// `to_eye`: towards who looks. `aside`: where right is for one who looks down.
Standing standing(vec3 position, vec2 from_middle, vec3 normal, vec3 axis, vec3 to_eye, vec3 aside) {
  if (!turns(normal)) return Standing(position, normal, axis);
  vec3 right = normalize(cross(vec3(0.0, 1.0, 0.0), to_eye) + 0.02 * length(to_eye) * aside);
  vec3 up = axis.y > 0.5 ? axis : normalize(cross(to_eye, right));
  return Standing(position + from_middle.x * right + from_middle.y * up, normalize(cross(right, up)), right);
}
