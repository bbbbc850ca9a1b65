#include "bitcheck/bit_case.h"

namespace etalon {

std::vector<BitCase> bitCases() {
    std::vector<BitCase> cases;
    addNumericCases(cases);
    addRasterCases(cases);
    addImageCases(cases);
    addShadingCases(cases);
    addPlanarCases(cases);
    return cases;
}

}  // namespace etalon
