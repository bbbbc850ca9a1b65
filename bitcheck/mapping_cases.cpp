// Passes between the mappings of a probe, its levels and its layouts.
#include "bitcheck/bit_case.h"
#include "bitcheck/inputs.h"
#include "probes/cube_layout.h"
#include "probes/mapping_passes.h"
#include "probes/mip_pyramid.h"
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
        return convertProbe(probe,
                            {shape, isTurned ? rotation : glm::dmat3(1), resampling,
                             profile.textureFractionBits, profile.filterRule},
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
                                                        {profile.textureFilter, profile.textureFractionBits,
                                                         CubeEdges::seamless, profile.filterRule},
                                                        profile.fragment, threads)));
    return planes;
}

// Of a lat-long probe of odd sizes with a part that is not valid, and of a cube.
std::vector<BitPlane> levels(int threads) {
    Probe sky = probeOf(skyImage(29, 13), Mapping::latLong);
    sky.valid.assign(1, Image<uint8_t>(29, 13));
    Random random(31);
    for (uint8_t& valid : sky.valid[0].values()) valid = random.chance(0.7) ? 1 : 0;
    ProbeConversion toCube;
    toCube.shape = {Mapping::cube, 9, 9};
    toCube.resampling = Resampling::bilinear;
    Probe cube = convertProbe(probeOf(skyImage(32, 16), Mapping::latLong), toCube, Arithmetic::fp64, threads);
    std::vector<BitPlane> planes;
    for (const auto& [name, probe] : {std::pair("lat-long-", &sky), std::pair("cube-", &cube)}) {
        const std::vector<Probe> pyramid = mipPyramid(*probe, threads);
        for (size_t level = 1; level < pyramid.size(); level++)
            addProbe(planes, name + std::to_string(level) + "-", pyramid[level]);
    }
    return planes;
}

std::vector<BitPlane> layouts() {
    CubeMap<float> cube(5, 2);
    Random random(32);
    for (Image<float>& face : cube.faces)
        for (float& texel : face.values()) texel = static_cast<float>(random.uniform(0, 1));
    std::vector<BitPlane> planes;
    for (const auto& [name, layout] : {std::pair("openexr-strip", CubeLayout::openExrStrip),
                                       std::pair("vertical-strip", CubeLayout::verticalStrip),
                                       std::pair("horizontal-cross", CubeLayout::horizontalCross),
                                       std::pair("vertical-cross", CubeLayout::verticalCross)})
        planes.push_back(planeOf(name, packCube(cube, layout)));
    return planes;
}

}  // namespace

void addMappingCases(std::vector<BitCase>& cases) {
    for (const Profile& profile : profiles())
        cases.push_back(
            {"convert/" + std::string(profile.name),
             "probes between mappings, and a cube map as lat-long image", true, true, false,
             [&profile](const RasterOptions& options) { return conversionsOf(profile, options.threads); }});
    cases.push_back({"probe/levels", "levels of half the size of a lat-long and a cube probe", false, true,
                     false, [](const RasterOptions& options) { return levels(options.threads); }});
    cases.push_back({"probe/layouts", "the faces of a cube in one image", false, false, false,
                     [](const RasterOptions&) { return layouts(); }});
}

}  // namespace etalon
