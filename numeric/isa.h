// The instruction set levels that the inner loops are compiled for, and the choice between them at run time.
// The level changes the number of lanes and the speed, and no bit.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace etalon {

// Level names are those of -march on x86-64 [SysV-x86-64, sec. 3.1.1]; scalar computes one lane at a time.
enum class IsaLevel : uint8_t {
    scalar,
    v2,    // x86-64-v2: 4 lanes of float
    v3,    // x86-64-v3 (AVX2): 8 lanes
    v4,    // x86-64-v4 (AVX-512): 16 lanes
    neon,  // AArch64: 4 lanes
};
const char* isaName(IsaLevel level);
std::optional<IsaLevel> findIsa(std::string_view name);

// The levels that are built in and that this processor and operating system can run; the widest last. Empty
// where there is none.
const std::vector<IsaLevel>& usableIsaLevels();

// The level that all passes of this process run at: the widest usable one, until selectIsa is called;
// InputError where no level is usable. selectIsa throws PreconditionError for a level that is not usable; not
// to be called while passes run.
IsaLevel activeIsa();
void selectIsa(IsaLevel level);

}  // namespace etalon
