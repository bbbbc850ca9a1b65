// Passes between the mappings of a probe.
#include "bitcheck/bit_case.h"
#include "bitcheck/inputs.h"
#include "probes/mapping_passes.h"
#include "raster/profile.h"

namespace etalon {
namespace {

void addProbe(std::vector<BitPlane>& planes, const std::string& name, const Probe& probe) {
    for (size_t layer = 0; layer < probe.radiance.size(); layer++)
        planes.push_back(planeOf(name + std::to_string(layer), probe.radiance[layer]));
}

// Few texels, as truth computes them too.
std::vector<BitPlane> conversionsOf(const Profile& profile, int threads) {
    // The axes of the source turned by the angle whose cosine is 3/5, about +X and then +Y; exact products.
    const glm::dmat3 rotation(glm::dvec3(0.6, 0, -0.8), glm::dvec3(0.64, 0.6, 0.48),
                              glm::dvec3(0.48, -0.8, 0.36));
    const Resampling single =
        profile.textureFilter == Filter::nearest ? Resampling::nearest : Resampling::bilinear;
    const Probe sky = probeOf(skyImage(32, 16), Mapping::latLong);
    const auto convert = [&](const Probe& probe, const ProbeShape& shape, Resampling resampling,
                             bool isTurned) {
        return convertProbe(
            probe, {shape, isTurned ? rotation : glm::dmat3(1), resampling, 2, profile.textureFractionBits},
            profile.fragment, threads);
    };
    std::vector<BitPlane> planes;
    const Probe cube = convert(sky, {Mapping::cube, 7, 7}, single, false);
    const Probe ball = convert(sky, {Mapping::mirrorBall, 11, 11, 4}, single, true);
    addProbe(planes, "cube", cube);
    addProbe(planes, "ball", ball);
    addProbe(planes, "angular", convert(sky, {Mapping::angular, 11, 11}, single, false));
    addProbe(planes, "octahedral", convert(sky, {Mapping::octahedral, 9, 9}, single, true));
    addProbe(planes, "from-cube", convert(cube, {Mapping::latLong, 18, 9}, single, true));
    addProbe(planes, "from-ball", convert(ball, {Mapping::latLong, 18, 9}, Resampling::area, false));
    addProbe(planes, "area", convert(sky, {Mapping::cube, 3, 3}, Resampling::area, false));
    planes.push_back(planeOf("listing", latLongFromCube(cubeMapOf(cube), 18, 9,
                                                        {profile.textureFilter, profile.textureFractionBits},
                                                        profile.fragment, threads)));
    return planes;
}

}  // namespace

void addMappingCases(std::vector<BitCase>& cases) {
    for (const Profile& profile : profiles())
        cases.push_back(
            {"convert/" + std::string(profile.name),
             "probes between mappings, and a cube map as lat-long image", true, true, false,
             [&profile](const RasterOptions& options) { return conversionsOf(profile, options.threads); }});
}

}  // namespace etalon
