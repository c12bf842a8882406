// Operators that are being tried, which `trying` (trying.py) has put into the table: as a rule there are none. Where there are
// some, shaders.py writes these two functions.
bool tried(int code) { return false; }
void try_out(inout State now, vec4 head, int code) {}
