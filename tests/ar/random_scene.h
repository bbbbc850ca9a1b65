// Small random scenes with everything that a scene file can ask for.
#pragma once

#include <cstdint>

#include "scene/scene.h"
#include "tests/support/scratch_folder.h"

namespace etalon::test {

// Makes scenes that refer to meshes and environments of its own, in a folder that it removes.
class RandomScenes {
  public:
    RandomScenes();
    // The scene of this number: mirrors in mirrors, black lights, surfaces and skies, lights behind surfaces, nothing
    // to cast or to occlude are frequent. No number of it overflows in any profile.
    Scene scene(uint64_t number) const;

  private:
    ScratchFolder folder_;
};

// A line that says what a scene is made of.
std::string sceneText(const Scene& scene);

}  // namespace etalon::test
