#include "bitcheck/bit_case.h"

namespace etalon {

std::vector<BitCase> bitCases() {
    std::vector<BitCase> cases;
    addNumericCases(cases);
    addRasterCases(cases);
    addImageCases(cases);
    addLightCases(cases);
    addMappingCases(cases);
    addShadingCases(cases);
    addIrradianceCases(cases);
    addShadowCases(cases);
    addVolumeCases(cases);
    addPlanarCases(cases);
    addLightingCases(cases);
    return cases;
}

}  // namespace etalon
