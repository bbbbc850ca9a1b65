// Spherical harmonics and irradiance of probes.
#include "probes/irradiance.h"

#include "bitcheck/bit_case.h"
#include "bitcheck/inputs.h"
#include "probes/harmonics_lobes.h"
#include "probes/harmonics_product.h"
#include "probes/harmonics_rotation.h"
#include "probes/latlong.h"
#include "raster/profile.h"

namespace etalon {
namespace {

Probe skyProbe() {
    Probe probe;
    probe.shape = {Mapping::latLong, 61, 32};
    probe.radiance.push_back(skyImage(61, 32));
    // x to y to z to x.
    probe.rotation = glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0));
    return probe;
}
Probe cubeProbe(int threads) {
    Probe probe;
    probe.shape = {Mapping::cube, 13, 13};
    const CubeMap<float> cube = cubeFromLatLong(skyImage(61, 32), 13, {}, threads);
    probe.radiance.assign(cube.faces.begin(), cube.faces.end());
    return probe;
}

// One row per value.
BitPlane planeOfValues(std::string name, const std::vector<glm::dvec3>& values) {
    std::vector<double> numbers;
    for (const glm::dvec3& v : values) numbers.insert(numbers.end(), {v.x, v.y, v.z});
    return planeOf(std::move(name), numbers, 3);
}

std::vector<BitPlane> harmonicsOf(const Profile& profile, int threads) {
    std::vector<BitPlane> planes;
    const std::vector<glm::dvec3> directions = texelDirections({Mapping::latLong, 32, 16});
    for (const Probe& probe : {skyProbe(), cubeProbe(threads)}) {
        const std::string shape = probe.shape.mapping == Mapping::cube ? "cube-" : "lat-long-";
        const SphericalHarmonics f = projectHarmonics(probe, 4, profile.fragment, threads);
        planes.push_back(planeOfValues(shape + "coefficients", f.coefficients));
        planes.push_back(
            planeOfValues(shape + "values", evaluateHarmonics(f, directions, profile.fragment, threads)));
    }
    return planes;
}

std::vector<BitPlane> irradianceOf(const Profile& profile, int threads) {
    const std::vector<glm::dvec3> normals = texelDirections({Mapping::latLong, 16, 8});
    return {planeOfValues("lat-long", irradianceAt(skyProbe(), normals, profile.fragment, threads)),
            planeOfValues("cube", irradianceAt(cubeProbe(threads), normals, profile.fragment, threads))};
}

std::vector<BitPlane> harmonicsInDouble(int threads) {
    const Probe probe = skyProbe();
    const SphericalHarmonics f = projectHarmonics(probe, 10, threads);
    const SphericalHarmonics soft = projectHarmonics(probe, 4, threads);
    // A turn by the angle of 3, 4 and 5, twice.
    const glm::dmat3 r(glm::dvec3(0.6, 0.48, 0.64), glm::dvec3(-0.8, 0.36, 0.48), glm::dvec3(0, -0.8, 0.6));
    return {planeOfValues("lat-long", f.coefficients),
            planeOfValues("rotated", rotateHarmonics(f, r).coefficients),
            planeOfValues("product", HarmonicProduct(4, 4, 8).multiply(soft, soft).coefficients),
            planeOfValues("minimal-window", scaleBands(soft, minimalWindow(soft).factors).coefficients)};
}

// Maps of irradiance, and what stands for one.
std::vector<BitPlane> irradianceMaps(int threads) {
    const Probe sky = skyProbe(), cube = cubeProbe(threads);
    const ProbeShape shape{Mapping::cube, 5, 5};
    std::vector<BitPlane> planes;
    const auto add = [&](const std::string& name, const Probe& map) {
        for (size_t f = 0; f < map.radiance.size(); f++)
            planes.push_back(planeOf(name + std::to_string(f), map.radiance[f]));
    };
    add("exact-", irradianceProbe(sky, shape, Arithmetic::fp64, threads));
    add("harmonics-",
        irradianceProbe(projectHarmonics(sky, 2, threads), shape, sky, Arithmetic::fp64, threads));
    add("blurred-", blurredDiffuseMap(cube, 13, 6.5, Arithmetic::fp32, threads));
    return planes;
}

}  // namespace

void addIrradianceCases(std::vector<BitCase>& cases) {
    const auto add = [&](std::string name, std::string what, auto run) {
        cases.push_back({std::move(name), std::move(what), true, true, false,
                         [run](const RasterOptions& options) { return run(options.threads); }});
    };
    add("harmonics/double", "spherical harmonics by azimuthal moments, rotation, product, window",
        harmonicsInDouble);
    add("irradiance/maps", "irradiance over the texels of a cube, exact and of harmonics; a blurred map",
        irradianceMaps);
    for (const Profile& profile : profiles()) {
        add("harmonics/" + std::string(profile.name), "spherical harmonics of a probe, and their values",
            [&profile](int threads) { return harmonicsOf(profile, threads); });
        add("irradiance/" + std::string(profile.name), "irradiance from all texels of a probe",
            [&profile](int threads) { return irradianceOf(profile, threads); });
    }
}

}  // namespace etalon
