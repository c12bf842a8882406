// Depth alone, but for where it is open. A post is thinner than a texel: what is seen in part throws shadow whole.
#include "open.glsl"

in vec2 mesh_place;
flat in vec2 mesh_size;
flat in vec2 mesh_start;
flat in int mesh_turns;

void main() {
  vec2 covers = fwidth(mesh_place);
  if (mesh_turns == 1 && open(ivec2(mesh_start), mesh_place, mesh_size, max(covers.x, covers.y), 0.3)) discard;
}
