// Whether a PLY file is whole. The mesh library trusts PLY files: one that was cut off crashes it, makes it
// loop or repeats the last face, and faces without corners can end the program. So files are walked through
// once before the library sees them.
#pragma once

#include <string>
#include <string_view>

namespace etalon {

// The reason why `text`, the bytes of a PLY file, cannot be read, or "" when the header is well formed
// (format ascii, binary_little_endian or binary_big_endian 1.0; a vertex element with x, y, z) and the body
// holds every element that the header announces (ascii: one element a line), faces with three or more
// corners.
std::string plyDefect(std::string_view text);

}  // namespace etalon
