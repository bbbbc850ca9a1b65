#include "lighting/arithmetic_passes.h"

#include "lighting/lighting_passes.h"

namespace etalon {

ArithmeticPasses passesOf(FragmentArithmetic arithmetic) {
    return arithmetic == FragmentArithmetic::truth ? passesTruth() : lightingPasses().arithmetic(arithmetic);
}

}  // namespace etalon
