// The fixed set of renders and computations whose bits are the same on every machine.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bitcheck/plane.h"
#include "raster/rasterizer.h"

namespace etalon {

// One case: a name "pass/variant", what it runs, and what the work is cut by, so what it is repeated for.
struct BitCase {
    std::string name, what;
    bool hasLevels = true, hasThreads = true, hasTiles = true;
    // At the active instruction set level. The planes have distinct names.
    std::function<std::vector<BitPlane>(const RasterOptions& options)> run;
};

// All cases, in the order of the passes: numbers first, then rasterization, then shading and images. Their
// inputs are made in code from exact operations and our own elementary functions, and read from no file.
std::vector<BitCase> bitCases();

// The parts of the list.
void addNumericCases(std::vector<BitCase>& cases);
void addRasterCases(std::vector<BitCase>& cases);
void addImageCases(std::vector<BitCase>& cases);
void addLightCases(std::vector<BitCase>& cases);
void addMappingCases(std::vector<BitCase>& cases);
void addShadingCases(std::vector<BitCase>& cases);
void addLightingCases(std::vector<BitCase>& cases);
void addIrradianceCases(std::vector<BitCase>& cases);
void addShadowCases(std::vector<BitCase>& cases);
void addVolumeCases(std::vector<BitCase>& cases);
void addPlanarCases(std::vector<BitCase>& cases);

}  // namespace etalon
