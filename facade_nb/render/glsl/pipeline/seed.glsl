// The seed of a façade: what its vertices carry, or, where seeds are any numbers, a row of a table (NumPy: noise.py).

struct Seed {
  uvec2 whole;  // steps of 1/64 m
  vec2 rest;    // what is left, 0 to below 1 step
};

#ifdef SEEDS
uniform highp sampler2D seeds;

Seed seed_of(vec2 carried) {
  int row = int(carried.x + 0.5);
  uvec4 halves = uvec4(texelFetch(seeds, ivec2(0, row), 0));
  return Seed(halves.xz * 65536u + halves.yw, texelFetch(seeds, ivec2(1, row), 0).xy);
}
#else
Seed seed_of(vec2 carried) { return Seed(uvec2(carried * 64.0 + 0.5), vec2(0.0)); }
#endif
