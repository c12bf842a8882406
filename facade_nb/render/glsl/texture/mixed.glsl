// A bijection of 32-bit integers in which every bit depends on all others (NumPy: noise.py).

uint mixed(uint value) {
  value ^= value >> 16u;
  value *= 0x7FEB352Du;
  value ^= value >> 15u;
  value *= 0x846CA68Bu;
  return value ^ (value >> 16u);
}
