#include "numeric/isa.h"

#include <algorithm>
#include <atomic>

#include "numeric/check.h"
#include "numeric/text.h"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace etalon {
namespace {

#if defined(__x86_64__)
bool hasV2() { return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt"); }

// __builtin_cpu_supports includes the operating system's support of the registers; the last three features of
// the level have no name in it that every compiler knows.
bool hasV3() {
    unsigned eax, ebx, ecx, edx;
    if (__get_cpuid(1, &eax, &ebx, &ecx, &edx) == 0) return false;
    const bool hasMovbeF16c = (ecx & bit_MOVBE) != 0 && (ecx & bit_F16C) != 0;
    if (__get_cpuid(0x80000001u, &eax, &ebx, &ecx, &edx) == 0) return false;
    const bool hasLzcnt = (ecx & bit_LZCNT) != 0;
    return hasV2() && hasMovbeF16c && hasLzcnt && __builtin_cpu_supports("avx2") &&
           __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma");
}

bool hasV4() {
    return hasV3() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
}
#endif

bool runsHere(IsaLevel level) {
    switch (level) {
        case IsaLevel::scalar:
        case IsaLevel::neon:
            return true;
#if defined(__x86_64__)
        case IsaLevel::v2:
            return hasV2();
        case IsaLevel::v3:
            return hasV3();
        case IsaLevel::v4:
            return hasV4();
#else
        default:
            return false;
#endif
    }
    return false;
}

// From narrow to wide.
constexpr IsaLevel kBuiltLevels[] = {
#if defined(ETALON_HAS_scalar)
    IsaLevel::scalar,
#endif
#if defined(ETALON_HAS_neon)
    IsaLevel::neon,
#endif
#if defined(ETALON_HAS_v2)
    IsaLevel::v2,
#endif
#if defined(ETALON_HAS_v3)
    IsaLevel::v3,
#endif
#if defined(ETALON_HAS_v4)
    IsaLevel::v4,
#endif
};

IsaLevel widestUsable() {
    const std::vector<IsaLevel>& usable = usableIsaLevels();
    if (!usable.empty()) return usable.back();
    std::string text = "this processor has none of the instruction set levels that are built in:";
    for (const IsaLevel level : kBuiltLevels) text += formatText(" {}", isaName(level));
    throw InputError(text);
}

std::atomic<IsaLevel>& active() {
    static std::atomic<IsaLevel> level = widestUsable();
    return level;
}

constexpr IsaLevel kAllLevels[] = {IsaLevel::scalar, IsaLevel::v2, IsaLevel::v3, IsaLevel::v4,
                                   IsaLevel::neon};

}  // namespace

const char* isaName(IsaLevel level) {
    switch (level) {
        case IsaLevel::scalar:
            return "scalar";
        case IsaLevel::v2:
            return "v2";
        case IsaLevel::v3:
            return "v3";
        case IsaLevel::v4:
            return "v4";
        case IsaLevel::neon:
            return "neon";
    }
    return "?";
}

std::optional<IsaLevel> findIsa(std::string_view name) {
    for (const IsaLevel level : kAllLevels)
        if (name == isaName(level)) return level;
    return std::nullopt;
}

const std::vector<IsaLevel>& usableIsaLevels() {
    static const std::vector<IsaLevel> levels = [] {
        std::vector<IsaLevel> usable;
        for (const IsaLevel level : kBuiltLevels)
            if (runsHere(level)) usable.push_back(level);
        return usable;
    }();
    return levels;
}

IsaLevel activeIsa() { return active().load(std::memory_order_relaxed); }

void selectIsa(IsaLevel level) {
    const std::vector<IsaLevel>& usable = usableIsaLevels();
    ETALON_CHECK(std::find(usable.begin(), usable.end(), level) != usable.end(), "level {}", isaName(level));
    active().store(level, std::memory_order_relaxed);
}

}  // namespace etalon
