// A position in the grammar's texture as one number, and back.

int one_of(ivec2 place) { return place.x | place.y << 16; }
ivec2 place_of(int place) { return ivec2(place & 65535, place >> 16); }
