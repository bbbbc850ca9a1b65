#include "shadows/planar_passes.h"

#include <algorithm>

#include "numeric/door.h"
#include "numeric/number.h"

namespace etalon {
namespace {

template <class T>
struct PlanarKernel {
#include "numeric/kernel_scope.inc"
#include "raster/texture_scope.inc"
#include "numeric/kernels/vector.glsl"
#include "raster/kernels/sampler.glsl"
#include "shadows/kernels/planar_shadow.glsl"
};

template <class T>
void planarVisibilityOver(const PlanarShadow& shadow, const SamplerSettings& sampler, const LitPoints& points,
                          std::span<const uint32_t> listed, std::span<double> visibility) {
    using Kernel = PlanarKernel<T>;
    using vec3 = typename Kernel::vec3;
    Kernel kernel;
    const auto number = [](const glm::dvec3& v) { return vec3(T(v.x), T(v.y), T(v.z)); };
    const auto perTexel = [&](const glm::dvec3& axis) {
        const double t = shadow.grid.texel_m;
        return number({axis.x / t, axis.y / t, axis.z / t});
    };
    const TextureView texture(shadow.shadow);
    typename Kernel::PlanarMap map;
    map.corner = number(shadow.grid.toWorld(0, 0));
    map.perColumn = perTexel(shadow.grid.frame.s);
    map.perRow = perTexel(shadow.grid.frame.t);
    map.sampling = samplingOfAnySize<Kernel>(sampler, shadow.grid.width, shadow.grid.height);
    forEachLaneGroup<Number<T>::lanes>(listed.size(), [&](size_t first, int active) {
        const auto listedOf = [&](std::span<const double> values) {
            return Number<T>::generate([&](int lane) {
                return values[listed[first + static_cast<size_t>(std::min(lane, active - 1))]];
            });
        };
        const auto& p = points.position_m;
        const T value = kernel.alsoPassing(listedOf(visibility), texture,
                                           vec3(listedOf(p[0]), listedOf(p[1]), listedOf(p[2])), map);
        for (int i = 0; i < active; i++)
            visibility[listed[first + static_cast<size_t>(i)]] = numberLane(value, i);
    });
}

}  // namespace

template <class T>
constexpr PlanarPasses kPassesOver<PlanarPasses, T> = {planarVisibilityOver<T>};
template const PlanarPasses& ETALON_LEVEL::passesOf<PlanarPasses>(NumberType);

}  // namespace etalon
