// Reading a scene file (docs/scene_format.md).
#pragma once

#include <filesystem>

#include "scene/scene.h"

namespace etalon {

// Reads and checks a whole scene file. Files that it names must exist; their contents are not read.
// InputError "file:line: reason" for the first thing that is wrong: TOML syntax, an unknown key (with the
// nearest known one), a missing key, a wrong type, a number that is not finite or out of range, a degenerate
// value, a name or file that does not exist.
Scene loadScene(const std::filesystem::path& path);

}  // namespace etalon
