#include "bitcheck/bit_case.h"

namespace etalon {

std::vector<BitCase> bitCases() {
    std::vector<BitCase> cases;
    addRasterCases(cases);
    return cases;
}

}  // namespace etalon
