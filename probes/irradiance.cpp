#include "probes/irradiance.h"

#include "numeric/check.h"
#include "numeric/door.h"
#include "probes/harmonics_lobes.h"
#include "probes/irradiance_passes.h"
#include "probes/texel_grid.h"
#include "raster/blur.h"

namespace etalon {

std::vector<glm::dvec3> irradianceAt(const Probe& probe, std::span<const glm::dvec3> normals,
                                     Arithmetic arithmetic, int threads) {
    return passesIn<IrradiancePasses>(arithmetic)->irradianceAt(probe, normals, threads);
}

TexelLights texelLights(const Probe& probe, Arithmetic arithmetic, int threads) {
    return passesIn<IrradiancePasses>(arithmetic)->texelLights(probe, threads);
}

std::vector<glm::dvec3> texelDirections(const ProbeShape& shape) {
    const TexelGrid grid(shape);
    std::vector<glm::dvec3> directions;
    for (int layer = 0; layer < shape.layers(); layer++)
        for (int y = 0; y < shape.height; y++)
            for (int x = 0; x < shape.width; x++) directions.push_back(grid.direction(layer, x, y));
    return directions;
}

Probe probeOfValues(const ProbeShape& shape, std::span<const glm::dvec3> values, const Probe& like) {
    Probe result;
    result.shape = shape;
    result.position_m = like.position_m;
    const auto texels = static_cast<size_t>(shape.width) * static_cast<size_t>(shape.height);
    const auto layers = static_cast<size_t>(shape.layers());
    ETALON_CHECK(values.size() == texels * layers, "{} values for {}x{}x{} texels", values.size(), layers,
                 shape.width, shape.height);
    for (size_t layer = 0; layer < layers; layer++) {
        Image<float>& image = result.radiance.emplace_back(shape.width, shape.height, 3);
        for (int c = 0; c < 3; c++)
            for (size_t i = 0; i < texels; i++)
                image.plane(c)[i] = static_cast<float>(values[layer * texels + i][c]);
    }
    return result;
}

Probe irradianceProbe(const Probe& probe, const ProbeShape& shape, Arithmetic arithmetic, int threads) {
    return probeOfValues(shape, irradianceAt(probe, texelDirections(shape), arithmetic, threads), probe);
}

Probe irradianceProbe(const SphericalHarmonics& radiance, const ProbeShape& shape, const Probe& like,
                      Arithmetic arithmetic, int threads) {
    return probeOfValues(
        shape,
        evaluateHarmonics(irradianceOfHarmonics(radiance), texelDirections(shape), arithmetic, threads),
        like);
}

Probe blurredDiffuseMap(const Probe& cube, int radius, double sigma_px, Arithmetic arithmetic, int threads) {
    checkProbe(cube);
    ETALON_CHECK(cube.shape.mapping == Mapping::cube, "mapping {}", static_cast<int>(cube.shape.mapping));
    Probe map = cube;
    for (Image<float>& face : map.radiance)
        face = passesIn<BlurPasses>(arithmetic)->blur(face, radius, sigma_px, threads);
    map.distance_m.clear();
    return map;
}

}  // namespace etalon
