// Passes from image to image: blur, lat-long to cube, tone mapping; and the samples of files.
#include <algorithm>
#include <limits>

#include "bitcheck/bit_case.h"
#include "bitcheck/inputs.h"
#include "lighting/shade.h"
#include "lighting/tone_map.h"
#include "probes/latlong.h"
#include "raster/blur.h"
#include "raster/names.h"
#include "raster/profile.h"
#include "raster/stored_sample.h"

namespace etalon {
namespace {

std::vector<BitPlane> blurs(int threads) {
    const Image<float> sky = skyImage(101, 67);
    std::vector<BitPlane> planes;
    for (const int radius : {1, 10, 150})
        planes.push_back(
            planeOf("radius-" + std::to_string(radius), blurGaussian(sky, radius, 0.4 * radius, threads)));
    return planes;
}

// Six planes.
void addCube(std::vector<BitPlane>& planes, const std::string& name, const CubeMap<float>& cube) {
    for (size_t f = 0; f < cube.faces.size(); f++)
        planes.push_back(planeOf(name + std::string(nameOf(static_cast<CubeFace>(f))), cube.faces[f]));
}

std::vector<BitPlane> cubesFromSky(int threads) {
    const Image<float> sky = skyImage(64, 32);
    std::vector<BitPlane> planes;
    CubeFromLatLong options;
    addCube(planes, "bilinear", cubeFromLatLong(sky, 32, options, threads));
    options.samplesPerAxis = 3;
    options.fractionBits = 8;
    addCube(planes, "mean-8-bit", cubeFromLatLong(sky, 11, options, threads));
    return planes;
}

// The environment in a profile's arithmetic.
std::vector<BitPlane> environmentOf(const Profile& profile, int threads) {
    SurfaceEnvironment environment;
    environment.latLong = skyImage(64, 32);
    std::vector<BitPlane> planes;
    addCube(planes, "cube", environmentCube(environment, profile, threads));
    return planes;
}

// Radiance of every kind: the sky, and values that have a defined byte but no colour.
std::vector<BitPlane> toneMaps(int threads) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kSpecial[] = {
        0.0f,       -0.0f, -1.0f,     kInfinity,      -kInfinity, std::numeric_limits<float>::quiet_NaN(),
        0.0031308f, 1.0f,  0x1p-126f, 0x1.fffffep127f};
    Image<float> radiance = skyImage(101, 67);
    std::copy(std::begin(kSpecial), std::end(kSpecial), radiance.row(3).begin());
    std::vector<BitPlane> planes;
    const auto add = [&](const std::string& name, ToneMap operation, double stops) {
        planes.push_back(planeOf(name, toneMap(radiance, operation, stops, threads), "channel"));
    };
    add("linear", ToneMap::linear, -1.5);
    add("reinhard", ToneMap::reinhard, 0.3);
    add("filmic", ToneMap::filmic, 0);
    return planes;
}

// Every code.
std::vector<BitPlane> storedSamples() {
    Image<float> halves(256, 256), words(256, 256), bytes(256, 1);
    for (uint32_t code = 0; code < 0x10000; code++) {
        halves.values()[code] = floatOfHalf(static_cast<uint16_t>(code));
        words.values()[code] = floatOfCode(static_cast<uint16_t>(code));
    }
    for (uint32_t code = 0; code < 0x100; code++)
        bytes.values()[code] = floatOfCode(static_cast<uint8_t>(code));
    return {planeOf("half", halves), planeOf("16-bit", words), planeOf("8-bit", bytes)};
}

}  // namespace

void addImageCases(std::vector<BitCase>& cases) {
    const auto add = [&](std::string name, std::string what, auto run) {
        cases.push_back({std::move(name), std::move(what), true, true, false,
                         [run](const RasterOptions& options) { return run(options.threads); }});
    };
    add("blur/f32", "Gaussian blur, radius 1, 10 and beyond the image", blurs);
    add("cube-from-lat-long/f32", "lat-long image to cube map, one sample and the mean of nine",
        cubesFromSky);
    for (const Profile& profile : profiles())
        add("environment/" + std::string(profile.name), "lat-long environment to the cube map of mirrors",
            [&profile](int threads) { return environmentOf(profile, threads); });
    add("tone-map/f32", "exposure, operators, sRGB", toneMaps);
    cases.push_back({"image/stored-samples", "halves and codes of image files as floats", false, false, false,
                     [](const RasterOptions&) { return storedSamples(); }});
}

}  // namespace etalon
