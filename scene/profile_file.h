// Profiles that a user composes in a TOML file (docs/profiles.md).
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "raster/profile.h"

namespace etalon {

// True for what stands for a file where a profile is asked for, and not for a name: it ends in ".toml".
bool isProfileFile(std::string_view nameOrFile);

// The profile that the file composes; its name is that of the file, without folders. InputError "file:line: reason" for
// the first thing that is wrong: TOML syntax, an unknown key, a wrong type, a value that is not known or out of range, a
// format that cannot be emulated.
Profile readProfileFile(const std::filesystem::path& path);

// The named profile, or that of the file. InputError if there is none.
Profile loadProfile(const std::string& nameOrFile);

}  // namespace etalon
