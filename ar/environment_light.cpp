#include "ar/environment_light.h"

#include <cmath>

#include "numeric/text.h"
#include "numeric/vectors.h"
#include "probes/convert.h"
#include "probes/dominant_lights.h"
#include "probes/harmonics_lobes.h"
#include "probes/irradiance.h"
#include "probes/median_cut.h"
#include "probes/probe_statistics.h"

namespace etalon {
namespace {

// A constant environment as an image: smooth enough for every method.
constexpr int kConstantWidth = 32, kConstantHeight = 16;

Probe probeOf(const SurfaceEnvironment& environment) {
    Probe probe;
    if (environment.latLong.empty()) {
        Image<float> image(kConstantWidth, kConstantHeight, 3);
        for (int c = 0; c < 3; c++)
            std::ranges::fill(image.plane(c), static_cast<float>(environment.constant[c]));
        probe.radiance.push_back(std::move(image));
    } else {
        probe.radiance.push_back(environment.latLong);
    }
    probe.shape = {Mapping::latLong, probe.radiance[0].width(), probe.radiance[0].height()};
    // Columns: the world directions of the probe's axes, turned about +Y.
    const double c = environment.cosRotation, s = environment.sinRotation;
    probe.rotation = glm::dmat3(c, 0, -s, 0, 1, 0, s, 0, c);
    return probe;
}

CubeMap<float> facesOf(Probe probe, const glm::dvec3& factor) {
    CubeMap<float> cube;
    for (size_t f = 0; f < cube.faces.size(); f++) {
        cube.faces[f] = std::move(probe.radiance[f]);
        for (int c = 0; c < 3; c++)
            for (float& value : cube.faces[f].plane(c)) value = static_cast<float>(value * factor[c]);
    }
    return cube;
}

// What brings the mean of a map over all directions to that of the radiance, for each channel; 1 where there is none.
glm::dvec3 normalisationOf(const Probe& map, const Probe& radiance, int threads) {
    const glm::dvec3 is = statisticsOf(map, threads).mean, should = statisticsOf(radiance, threads).mean;
    glm::dvec3 factor(1);
    for (int c = 0; c < 3; c++)
        if (is[c] > 0 && should[c] > 0 && std::isfinite(should[c] / is[c])) factor[c] = should[c] / is[c];
    return factor;
}

}  // namespace

SurfaceLight surfaceLightOf(const ProbeLight& light) {
    SurfaceLight surface;
    surface.toLight = light.direction;
    surface.irradiance = light.energy;
    return surface;
}

EnvironmentIllumination environmentIllumination(const Environment& environment,
                                                const SurfaceEnvironment& radiance, const Profile& profile,
                                                int threads) {
    const Probe probe = probeOf(radiance);
    const Arithmetic& arithmetic = profile.environment;
    EnvironmentIllumination illumination;
    EnvironmentLight& light = illumination.diffuse;
    std::vector<ProbeLight>& lights = illumination.lights;
    const ProbeShape cube{Mapping::cube, environment.mapSize, environment.mapSize};
    switch (environment.lighting) {
        case EnvironmentLightMethod::none:
            break;
        case EnvironmentLightMethod::lights: {
            MedianCut cut;
            for (cut.log2Count = 0; (1 << cut.log2Count) < environment.lightCount;) cut.log2Count++;
            lights = medianCutLights(probe, cut, arithmetic, threads).lights;
            const size_t found = lights.size();
            std::erase_if(lights, [](const ProbeLight& one) { return one.energy == glm::dvec3(0); });
            if (static_cast<int>(lights.size()) < environment.lightCount)
                illumination.warnings.push_back(
                    formatText("the environment gives {} of {} lights: {} fewer because regions of one texel "
                               "stay whole, {} "
                               "because regions are black",
                               lights.size(), environment.lightCount,
                               static_cast<size_t>(environment.lightCount) - found, found - lights.size()));
            break;
        }
        case EnvironmentLightMethod::dominant:
            for (const DominantLight& found : dominantLights(probe)) lights.push_back(found.light);
            break;
        case EnvironmentLightMethod::harmonics:
            light.kind = EnvironmentLight::Kind::harmonics;
            // In double by rows of the image, which takes less time.
            light.harmonics = irradianceOfHarmonics(arithmetic == Arithmetic::fp64
                                                        ? projectHarmonics(probe, 2, threads)
                                                        : projectHarmonics(probe, 2, arithmetic, threads));
            break;
        case EnvironmentLightMethod::exact: {
            TexelLights texels = texelLights(probe, arithmetic, threads);
            light.kind = EnvironmentLight::Kind::texels;
            light.directions = std::move(texels.directions);
            light.flux = std::move(texels.flux);
            break;
        }
        case EnvironmentLightMethod::map:
            light.kind = EnvironmentLight::Kind::map;
            light.map = facesOf(irradianceProbe(probe, cube, arithmetic, threads), glm::dvec3(1));
            break;
        case EnvironmentLightMethod::blurred:
        case EnvironmentLightMethod::blurredNormalised: {
            // The reflective map in world axes, blurred with a kernel as wide as a face [Karlsson2005,
            // Sec. 3.1.5].
            ProbeConversion conversion;
            conversion.shape = cube;
            const Probe reflective = convertProbe(probe, conversion, arithmetic, threads);
            light.kind = EnvironmentLight::Kind::map;
            Probe blurred =
                blurredDiffuseMap(reflective, cube.width, cube.width / 2.0, profile.fragment, threads);
            const glm::dvec3 factor = environment.lighting == EnvironmentLightMethod::blurredNormalised
                                          ? normalisationOf(blurred, probe, threads)
                                          : glm::dvec3(1);
            light.map = facesOf(std::move(blurred), scaledBy(factor, kPi));
            break;
        }
    }
    return illumination;
}

}  // namespace etalon
