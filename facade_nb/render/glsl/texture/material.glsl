// Mat and MatAlpha.
#include "record.glsl"
#include "value.glsl"
#include "mask.glsl"
#include "turned.glsl"
#include "add.glsl"

void material(State now, vec4 head, bool with_alpha) {
  vec4 shown = value(now, int(head.MatAlpha_m1), record(now.rule, 1));
  float alpha = shown.a;
  if (with_alpha) {
    int source = int(head.MatAlpha_a1);
    vec4 factor = value(now, source, record(now.rule, 2));
    alpha *= source == 0 ? factor.a : mask(abs(source), factor);
  }
  int usage = int(head.MatAlpha_u);
  if (usage == USAGE_COLOR) {
    add(surface.color, shown.rgb, alpha);
    if (surface.rule.x < 0 && alpha > 0.0) surface.rule = now.rule;
  } else if (usage == USAGE_NORMAL) {
    add(surface.normal, turned(shown.rgb, now.faces), alpha);
  } else {
    add(surface.specular, shown.rgb, alpha);
  }
}
