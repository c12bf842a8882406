// The sky, where there is nothing else. A pass of its own: a software renderer would reckon clouds for each wall, too.
#include "view.glsl"

uniform vec3 towards;
uniform vec3 sun;
#include "sky.glsl"

layout(location = 0) out highp vec4 out_air;

void main() { out_air = vec4(sky_along(ray_at(gl_FragCoord.xy)), 0.0); }
