// What is asked of the evaluator. Everything that differs from façade to façade is an input, nothing is a constant: a
// mesh may give each of its triangles its own.

struct Question {
  ivec2 start;      // position of the start rule
  vec2 size;        // of the façade, metres
  vec2 at;          // metres from its lower left corner
  vec3 ray;         // from the eye, in the façade's axes: x to the right, y up, z out of it
  uvec2 seed;       // whole steps of 1/64 m
  vec2 rest;        // what is left of the seed, 0 to below 1 step
  float footprint;  // metres that the pixel covers, across the ray
  float spread;     // how much more it covers behind the façade, for each of the ray's lengths
};

struct Surface {
  vec4 color;       // red, green and blue multiplied by alpha, alpha (Eq. 2, 3)
  vec4 normal;      // as (n + 1) / 2 in the façade's axes
  vec4 specular;
  ivec2 rule;       // of the topmost terminal that gave colour; -1: none
};
