#include "probes/spherical_harmonics.h"

#include <doctest/doctest.h>

namespace etalon {

TEST_CASE("Scratch") { CHECK(harmonicsAt({0, 0, 1}, 2)[0] == doctest::Approx(0.28209479)); }

}  // namespace etalon
