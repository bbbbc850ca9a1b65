// Profiles field by field, with what is documented of each and what is assumed: what `etalon profiles` says.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "files/json.h"
#include "raster/profile.h"

namespace etalon {

// One field under the key that it has in a profile file. Where both notes are empty, the value stands for no hardware
// and no specification: it is a choice of the profile.
struct ProfileField {
    std::string key;
    std::string value;  // as in a profile file, but for quotation marks
    bool isNumber;
    std::string documented;  // what a source says of it, with the source's key in docs/references.md
    std::string assumed;     // what no source says
};
std::vector<ProfileField> profileFields(const Profile& profile);

// The fields as lines of a profile file with the notes as comments; a file of them composes the same profile.
std::string profileText(const Profile& profile);

// A list of {name, meaning, fields: [{key, value, documented, assumed}]}.
Json profilesJson(std::span<const Profile> profiles);

}  // namespace etalon
