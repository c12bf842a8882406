// Half the distance to the next larger float that the grammar's texture can hold (NumPy: dividing.py).

float half_step(float value) {
  return max(intBitsToFloat(floatBitsToInt(value) & 0x7F800000) * HALF_STEP, LEAST_STEP);
}
