#include "lighting/arithmetic_passes.h"

#include "numeric/check.h"

namespace etalon {

ArithmeticPasses passesOf(FragmentArithmetic arithmetic) {
    switch (arithmetic) {
        case FragmentArithmetic::truth:
            return passesTruth();
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
    }
    ETALON_CHECK(false, "arithmetic {}", static_cast<int>(arithmetic));
    return {};
}

}  // namespace etalon
