#include <memory>

#include "app/command_line.h"
#include "app/output.h"
#include "app/verbs.h"
#include "numeric/text.h"
#include "scene/profile_file.h"
#include "scene/profile_text.h"

namespace etalon {
namespace {

struct ProfilesVerb {
    std::vector<std::string> names;
    bool json = false;
};

ExitCode runProfiles(const ProfilesVerb& verb) {
    std::vector<Profile> chosen(profiles().begin(), profiles().end());
    if (!verb.names.empty()) {
        chosen.clear();
        for (const std::string& name : verb.names) chosen.push_back(loadProfile(name));
    }
    if (verb.json) {
        printOut(jsonText(profilesJson(chosen)));
        return ExitCode::done;
    }
    std::vector<std::string> texts;
    for (const Profile& profile : chosen) texts.push_back(profileText(profile));
    printOut(joinText(texts, "\n"));
    return ExitCode::done;
}

}  // namespace

void addProfiles(Verb& command) {
    const auto options = std::make_shared<ProfilesVerb>();
    Verb& verb = command.addVerb("profiles", "Explain arithmetic profiles, field by field, as profile files");
    verb.add("profile", options->names, "Names, or profile files (.toml); default: all named ones");
    verb.addFlag("--json", options->json, "As JSON");
    verb.onRun([options] { return runProfiles(*options); });
}

}  // namespace etalon
