// Textures, and the stacks of one pixel.
#include "state.glsl"
#include "inputs.glsl"

uniform highp sampler2D grammar;     // records of the rules
uniform highp sampler2D noise;       // 256 × 256 random numbers
uniform highp sampler2D atlas;       // tiles
uniform highp sampler2D tile_table;  // row: tile; column: level; left, bottom, width, height. First column: whether it is opaque

Question asked;
Surface surface;
Frame frames[MAX_FRAMES];
int frame_count;
uvec2 seed_stack[MAX_SEEDS];
float margin;                        // how near the pixel came to a boundary, in pixels
#ifdef DEEP
float deep;                          // how far behind the façade colour comes from, by what a pixel covers there
#endif
#ifdef COUNT_FETCHES
int fetches;
#endif
