// The rows of etalon_bench about probes.
#include "bench/measure.h"
#include "bench/passes.h"
#include "bench/rows.h"
#include "numeric/door.h"
#include "probes/irradiance.h"
#include "probes/light_passes.h"
#include "probes/median_cut.h"

namespace etalon::bench {
namespace {

// Touches the texels of the lat-long image and of the cube map.
void addCubeFromLatLong(const Way& way) {
    add("latlong-to-cube/1024", way, [=](benchmark::State& state) {
        SurfaceEnvironment environment;
        environment.latLong = latLongInput();
        const Profile& found = *findProfile(way.profile);
        constexpr size_t kTexels = size_t{kCubeFaces} * kLatLongCubeSize * kLatLongCubeSize;
        const Amount amount{.pixels = static_cast<double>(kTexels),
                            .bytes_touched = (environment.latLong.pixelCount() + kTexels) * kRadiance_bytes};
        measure(state, amount, [&] { return environmentCube(environment, found, way.threads); });
    });
}

Probe latLongProbe() {
    Probe probe;
    probe.shape = {Mapping::latLong, kLatLongWidth, kLatLongHeight};
    probe.radiance.push_back(latLongInput());
    return probe;
}

// Pixels are texels of the probe; five bands.
void addHarmonics(const Way& way) {
    const auto addProjection = [&](const std::string& name, bool isCube) {
        add(name, way, [=](benchmark::State& state) {
            Probe probe = latLongProbe();
            if (isCube) {
                const CubeMap<float> cube = cubeFromLatLong(probe.radiance[0], kLatLongCubeSize);
                probe.shape = {Mapping::cube, kLatLongCubeSize, kLatLongCubeSize};
                probe.radiance.assign(cube.faces.begin(), cube.faces.end());
            }
            const size_t texels = probe.radiance.size() * probe.radiance[0].pixelCount();
            const Amount amount{.pixels = static_cast<double>(texels),
                                .bytes_touched = texels * kRadiance_bytes};
            measure(state, amount, [&] { return projectHarmonics(probe, 4, way.threads); });
        });
    };
    addProjection("sh5-of-latlong/1024", false);
    addProjection("sh5-of-cube/256", true);
}

// Pixels are pairs of texels.
void addIrradiance(const Way& way) {
    add("irradiance/1024-to-128", way, [=](benchmark::State& state) {
        const Probe probe = latLongProbe();
        const ProbeShape shape{Mapping::latLong, 16, 8};
        const size_t texels = probe.radiance[0].pixelCount();
        const Amount amount{.pixels = static_cast<double>(texels) * shape.width * shape.height,
                            .bytes_touched = texels * kRadiance_bytes};
        const Profile& found = *findProfile(way.profile);
        measure(state, amount, [&] { return irradianceProbe(probe, shape, found.fragment, way.threads); });
    });
}

// The double table alone, and table, cuts and energies of 256 lights. Touches the probe; the table is written
// as well.
void addLights(const Way& way) {
    constexpr size_t kTexels = static_cast<size_t>(kLargeLatLong.width) * kLargeLatLong.height;
    const Amount amount{.pixels = static_cast<double>(kTexels), .bytes_touched = kTexels * kRadiance_bytes};
    add("energy-table/4096", way, [=](benchmark::State& state) {
        const Probe probe = probeInput(kLargeLatLong);
        const auto weights = texelWeights(kLargeLatLong.width, kLargeLatLong.height, TexelWeight::exact);
        measure(state, amount, [&] { return EnergyTable(probe.radiance[0], weights, way.threads).total(); });
    });
    add("lights256-of-probe/4096", way, [=](benchmark::State& state) {
        const Probe probe = probeInput(kLargeLatLong);
        measure(state, amount,
                [&] { return medianCutLights(probe, {.log2Count = kLog2Lights}, way.threads); });
    });
}

// Irradiance of 256 lights over the directions of a lat-long image; pixels are pairs of direction and light.
void addLightIrradiance(const Way& way) {
    add("irradiance-of-lights/256", way, [=](benchmark::State& state) {
        constexpr int kShownWidth = 256, kShownHeight = 128;
        const auto lights = medianCutLights(latLongProbe(), {.log2Count = kLog2Lights}).lights;
        const auto passes = passesIn<LightPasses>(findProfile(way.profile)->fragment);
        const Amount amount{
            .pixels = static_cast<double>(kShownWidth) * kShownHeight * static_cast<double>(lights.size()),
            .bytes_touched = size_t{kShownWidth} * kShownHeight * 3 * sizeof(double)};
        measure(state, amount, [&] {
            return passes->irradianceOfLights(lights, {Mapping::latLong, kShownWidth, kShownHeight},
                                              way.threads);
        });
    });
}

// Touches the texels of the source and of the result.
void addConversion(const std::string& name, const ProbeShape& from, const ProbeShape& to, const Way& way) {
    add("convert/" + name, way, [=](benchmark::State& state) {
        const auto texels = [](const ProbeShape& shape) {
            return static_cast<size_t>(shape.layers()) * static_cast<size_t>(shape.width) *
                   static_cast<size_t>(shape.height);
        };
        const Probe source = probeInput(from);
        const Arithmetic arithmetic = findProfile(way.profile)->fragment;
        const Amount amount{.pixels = static_cast<double>(texels(to)),
                            .bytes_touched = (texels(from) + texels(to)) * kRadiance_bytes};
        Probe result;
        convertProbe(result, source, {.shape = to, .resampling = Resampling::bilinear}, arithmetic,
                     way.threads);
        measure(state, amount, [&] {
            convertProbe(result, source, {.shape = to, .resampling = Resampling::bilinear}, arithmetic,
                         way.threads);
            return result.radiance[0].values().data();
        });
    });
}

void addConversions(const Way& way) {
    addConversion("latlong-cube", kLargeLatLong, kLargeCube, way);
    addConversion("cube-latlong", kLargeCube, kLargeLatLong, way);
    addConversion("ball-latlong", kLargeBall, kLargeLatLong, way);
    addConversion("near-ball-latlong", kLargeNearBall, kLargeLatLong, way);
    addConversion("angular-latlong", kLargeAngular, kLargeLatLong, way);
    addConversion("octahedral-latlong", kLargeOctahedral, kLargeLatLong, way);
    addConversion("latlong-ball", kLargeLatLong, kLargeBall, way);
    addConversion("latlong-angular", kLargeLatLong, kLargeAngular, way);
    addConversion("latlong-octahedral", kLargeLatLong, kLargeOctahedral, way);
}

}  // namespace

void addProbeRows(const Way& way) {
    addCubeFromLatLong(way);
    addHarmonics(way);
    addIrradiance(way);
    addLights(way);
    addLightIrradiance(way);
    addConversions(way);
}

void addProbeRowsOfLevel(const Way& way) {
    addCubeFromLatLong(way);
    addLights(way);
    addLightIrradiance(way);
    addConversion("latlong-cube", kLargeLatLong, kLargeCube, way);
    addConversion("cube-latlong", kLargeCube, kLargeLatLong, way);
}

void addProbeRowsOfProfile(const Way& way) {
    addCubeFromLatLong(way);
    addLightIrradiance(way);
}

}  // namespace etalon::bench
