// The kernel texts over one number type. Compiled several times: ETALON_BENCH_VARIANT is the name of the
// function, ETALON_BENCH_APPROXIMATE chooses the number type, the rest are compiler flags.
#include "bench/exactness/shading_variant.h"

#include "lighting/shading_kernels.h"

#if defined(ETALON_BENCH_APPROXIMATE)
#include "bench/exactness/approximate_lanes.h"
#endif

namespace etalon::bench {
namespace {

using L = Lanes<float, kLanes>;
#if defined(ETALON_BENCH_APPROXIMATE)
using Number = Approximate;
L lanesOf(Number a) { return a.v; }
#else
using Number = L;
L lanesOf(Number a) { return a; }
#endif
using Kernels = ShadingKernels<Number>;
using vec3 = Kernels::vec3;

vec3 loadPixels(const float* const (&from)[3], size_t first) {
    return {Number(L::load(from[0] + first)), Number(L::load(from[1] + first)),
            Number(L::load(from[2] + first))};
}
vec3 sameInEveryLane(double x, double y, double z) { return {Number(x), Number(y), Number(z)}; }

[[gnu::flatten]] void shade(const ShadingInput& in) {
    const vec3 diffuse = sameInEveryLane(in.diffuse[0], in.diffuse[1], in.diffuse[2]);
    const vec3 specular = sameInEveryLane(in.specular[0], in.specular[1], in.specular[2]);
    const Number exponent(in.exponent), scale(in.scale);
    Kernels kernels;
    for (size_t first = 0; first < in.count; first += kLanes) {
        const vec3 n = loadPixels(in.normal, first), v = loadPixels(in.toEye, first);
        vec3 diffuseSum = sameInEveryLane(0, 0, 0), specularSum = diffuseSum;
        for (size_t i = 0; i < in.lights; i++) {
            const vec3 l = sameInEveryLane(in.toLight[0][i], in.toLight[1][i], in.toLight[2][i]);
            const vec3 irradiance =
                sameInEveryLane(in.irradiance[0][i], in.irradiance[1][i], in.irradiance[2][i]);
            diffuseSum = kernels.add3(diffuseSum, kernels.lambert(n, l, irradiance, diffuse));
            specularSum =
                kernels.add3(specularSum, kernels.blinnPhong(n, v, l, irradiance, specular, exponent, scale));
        }
        const vec3 radiance = kernels.add3(diffuseSum, specularSum);
        lanesOf(radiance.x).store(in.radiance[0] + first);
        lanesOf(radiance.y).store(in.radiance[1] + first);
        lanesOf(radiance.z).store(in.radiance[2] + first);
    }
}

}  // namespace
}  // namespace etalon::bench

extern "C" __attribute__((visibility("default"))) void ETALON_BENCH_VARIANT(
    const etalon::bench::ShadingInput* input) {
    etalon::bench::shade(*input);
}
