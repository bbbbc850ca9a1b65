// fp16 and bf16 as passes compute them, at every level of this machine, against Rounded.
#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <string>

#include "bitcheck/number_tables.h"
#include "numeric/door.h"
#include "numeric/parallel.h"

using namespace etalon;

TEST_CASE("NarrowNumbersHaveTheBitsOfRoundedAtEveryLevel") {
    // All pairs take minutes. 509 is prime: every residue of the low bits comes up.
    const uint32_t step = std::getenv("ETALON_EXHAUSTIVE") ? 1 : 509;
    constexpr uint32_t kPatterns = 1u << 16, kPart = 1u << 10;
    const IsaLevel before = activeIsa();
    for (const IsaLevel level : usableIsaLevels()) {
        CAPTURE(std::string(isaName(level)));
        selectIsa(level);
        std::array<std::atomic<size_t>, 2> mismatches{};
        parallelFor(kPatterns / kPart, 0, [&](size_t part) {
            const auto first = static_cast<uint32_t>(part) * kPart;
            const auto found = levelPasses<NumberPasses>().narrowMismatches(first, first + kPart, step);
            mismatches[0] += found[0], mismatches[1] += found[1];
        });
        CHECK(mismatches[0].load() == 0);
        CHECK(mismatches[1].load() == 0);
    }
    selectIsa(before);
}
