#include "numeric/isa.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "numeric/check.h"

using namespace etalon;

TEST_CASE("LevelsAreFoundByTheirNames") {
    for (const IsaLevel level : {IsaLevel::scalar, IsaLevel::v2, IsaLevel::v3, IsaLevel::v4, IsaLevel::neon})
        CHECK(findIsa(isaName(level)) == level);
    for (const char* name : {"", "V2", "v5", "auto", "v2 "}) CHECK_FALSE(findIsa(name).has_value());
}

TEST_CASE("OnlyUsableLevelsCanBeSelected") {
    const IsaLevel before = activeIsa();
    const auto& usable = usableIsaLevels();
    REQUIRE_FALSE(usable.empty());
    CHECK(std::find(usable.begin(), usable.end(), before) != usable.end());
    for (const IsaLevel level : usable) {
        selectIsa(level);
        CHECK(activeIsa() == level);
    }
    for (const IsaLevel level :
         {IsaLevel::scalar, IsaLevel::v2, IsaLevel::v3, IsaLevel::v4, IsaLevel::neon}) {
        if (std::find(usable.begin(), usable.end(), level) != usable.end()) continue;
        CHECK_THROWS_AS(selectIsa(level), PreconditionError);
    }
    selectIsa(before);
}
