// A pixel of a buffer. `share`: 1 / size of it. It samples the pixel's middle, for llvmpipe's texelFetch takes longer: it
// looks up the size of a level for each pixel.

vec2 share_of(highp sampler2D image) { return 1.0 / vec2(textureSize(image, 0)); }

vec4 pixel(highp sampler2D image, vec2 share, ivec2 at) { return textureLod(image, (vec2(at) + 0.5) * share, 0.0); }

// The pixel that is drawn.
vec4 drawn(highp sampler2D image, vec2 share) { return textureLod(image, gl_FragCoord.xy * share, 0.0); }
