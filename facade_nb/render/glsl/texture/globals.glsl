// Textures, and the stacks of one pixel.
#include "state.glsl"
#include "inputs.glsl"

uniform highp sampler2D grammar;     // records of the rules
uniform highp sampler2D noise;       // 256 × 256 random numbers
uniform highp sampler2D atlas;       // tiles
uniform highp sampler2D tile_table;  // row: tile; column: level; left, bottom, width, height. First column: whether it is opaque

vec2 of_grammar;                     // 1 / size of each
vec2 of_atlas;
vec2 of_tile_table;
int tile_levels;

Question asked;
Surface surface;
Frame frames[MAX_FRAMES];
int frame_count;
Room outside[MAX_ROOMS];             // of each intrusion that the pixel is in, the outermost first
vec2 filling;                        // sum of a Split's absolute sizes, and of half a step of each; -1: not known
uvec2 seed_stack[MAX_SEEDS];
float margin;                        // how near the pixel came to a boundary, in pixels
#ifdef DEEP
float deep;                          // how far behind the façade colour comes from, by what a pixel covers there
#endif
#ifdef COUNT_FETCHES
int fetches;
#endif
