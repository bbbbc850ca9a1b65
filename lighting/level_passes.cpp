// Compiled once per level.
#include "lighting/lighting_passes.h"
#include "lighting/transform.h"
#include "numeric/check.h"
#include "numeric/lanes.h"

namespace etalon::ETALON_LEVEL {
namespace {

ArithmeticPasses arithmeticPasses(FragmentArithmetic arithmetic) {
    switch (arithmetic) {
        case FragmentArithmetic::fp64:
            return passesFp64();
        case FragmentArithmetic::fp32:
            return passesFp32();
        case FragmentArithmetic::fp32Flush:
            return passesFp32Flush();
        case FragmentArithmetic::fp32Nv40:
            return passesFp32Nv40();
        case FragmentArithmetic::fp16:
            return passesFp16();
        case FragmentArithmetic::fp16Nv40:
            return passesFp16Nv40();
        case FragmentArithmetic::bf16:
            return passesBf16();
        case FragmentArithmetic::fp24R300:
            return passesFp24R300();
        case FragmentArithmetic::truth:
            break;
    }
    ETALON_CHECK(false, "arithmetic {}", static_cast<int>(arithmetic));
    return {};
}

}  // namespace

const LightingPasses& lightingPasses() {
    static const LightingPasses passes = {arithmeticPasses, toneMap<Native<float>>, transformPoints,
                                          projectPoints};
    return passes;
}

}  // namespace etalon::ETALON_LEVEL
