// Adds a colour, normal or specular value where what lies above has left room (Eq. 2, 3).
#include "globals.glsl"
#include "add.glsl"
#include "turned.glsl"

void paint(State now, int usage, vec3 shown, float alpha) {
  if (usage == USAGE_COLOR) {
#ifdef DEEP
    deep += (1.0 - surface.color.a) * alpha * (now.footprint - asked.footprint);
#endif
    add(surface.color, shown, alpha);
    if (surface.rule.x < 0 && alpha > 0.0) surface.rule = now.rule;
  } else if (usage == USAGE_NORMAL) {
    add(surface.normal, turned(shown, now.faces), alpha);
  } else {
    add(surface.specular, shown, alpha);
  }
}
