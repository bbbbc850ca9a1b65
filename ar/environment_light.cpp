#include "ar/environment_light.h"

#include <cmath>

#include "numeric/vectors.h"
#include "probes/convert.h"
#include "probes/dominant_lights.h"
#include "probes/harmonics_lobes.h"
#include "probes/irradiance.h"
#include "probes/median_cut.h"
#include "probes/texel_grid.h"

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

CubeMap<float> facesOf(Probe probe, double factor) {
    CubeMap<float> cube;
    for (size_t f = 0; f < cube.faces.size(); f++) {
        cube.faces[f] = std::move(probe.radiance[f]);
        for (float& value : cube.faces[f].values()) value = static_cast<float>(value * factor);
    }
    return cube;
}

// Each texel with a solid angle as a light, in world directions.
void setTexels(const Probe& probe, EnvironmentLight& light) {
    const TexelGrid grid(probe.shape);
    const Image<float>& image = probe.radiance[0];
    for (int y = 0; y < image.height(); y++) {
        for (int x = 0; x < image.width(); x++) {
            const glm::dvec3 d = grid.direction(0, x, y);
            const double weight_sr = grid.solidAngle_sr(0, x, y);
            const glm::dmat3& m = probe.rotation;
            light.directions.emplace_back(m[0].x * d.x + (m[1].x * d.y + m[2].x * d.z),
                                          m[0].y * d.x + (m[1].y * d.y + m[2].y * d.z),
                                          m[0].z * d.x + (m[1].z * d.y + m[2].z * d.z));
            light.flux.emplace_back(double{image.at(x, y, 0)} * weight_sr,
                                    double{image.at(x, y, 1)} * weight_sr,
                                    double{image.at(x, y, 2)} * weight_sr);
        }
    }
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
            lights = medianCutLights(probe, cut, threads).lights;
            std::erase_if(lights, [](const ProbeLight& found) { return found.energy == glm::dvec3(0); });
            break;
        }
        case EnvironmentLightMethod::dominant:
            for (const DominantLight& found : dominantLights(probe)) lights.push_back(found.light);
            break;
        case EnvironmentLightMethod::harmonics:
            light.kind = EnvironmentLight::Kind::harmonics;
            light.harmonics = irradianceOfHarmonics(projectHarmonics(probe, 2, threads));
            break;
        case EnvironmentLightMethod::exact:
            light.kind = EnvironmentLight::Kind::texels;
            setTexels(probe, light);
            break;
        case EnvironmentLightMethod::map:
            light.kind = EnvironmentLight::Kind::map;
            light.map = facesOf(irradianceProbe(probe, cube, Arithmetic::fp64, threads), 1);
            break;
        case EnvironmentLightMethod::blurred: {
            // The reflective map in world axes, blurred with a kernel as wide as a face [Karlsson2005,
            // Sec. 3.1.5].
            ProbeConversion conversion;
            conversion.shape = cube;
            conversion.resampling = Resampling::area;
            const Probe reflective = convertProbe(probe, conversion, Arithmetic::fp64, threads);
            light.kind = EnvironmentLight::Kind::map;
            light.map = facesOf(
                blurredDiffuseMap(reflective, cube.width, cube.width / 2.0, profile.fragment, threads), kPi);
            break;
        }
    }
    return illumination;
}

}  // namespace etalon
