#include "raster/vertex_stage.h"

#include "numeric/door.h"
#include "numeric/number.h"

namespace etalon {
namespace {

void projectVertices(const ViewportTransform& transform, std::span<const ClipVertex> vertices,
                     std::span<ProjectedVertex> projected, std::span<uint8_t> outcodes) {
    using T = Native<double>;
    using P = Projection<T>;
    forEachLaneGroup<Number<T>::lanes>(vertices.size(), [&](size_t first, int active) {
        const auto item = [&](int lane) -> const ClipVertex& {
            return vertices[first + static_cast<size_t>(lane < active ? lane : active - 1)];
        };
        // Adding 0 turns -0 into +0 and leaves every other value.
        typename P::vec4 p(Number<T>::generate([&](int i) { return item(i).x; }) + T(0.0),
                           Number<T>::generate([&](int i) { return item(i).y; }) + T(0.0),
                           Number<T>::generate([&](int i) { return item(i).z; }) + T(0.0),
                           Number<T>::generate([&](int i) { return item(i).w; }) + T(0.0));
        const auto [code, canBeProjected] = P::outcode(p, transform);
        // The others are put in the middle.
        p = {P::select(canBeProjected, p.x, T(0.0)), P::select(canBeProjected, p.y, T(0.0)),
             P::select(canBeProjected, p.z, T(0.0)), P::select(canBeProjected, p.w, T(1.0))};
        const T x = P::snapX(p, transform), y = P::snapY(p, transform), z = P::depth(p, transform);
        const T reciprocalW = T(1.0) / p.w;
        for (int i = 0; i < active; i++) {
            const size_t v = first + static_cast<size_t>(i);
            projected[v] = {static_cast<int32_t>(numberLane(x, i)), static_cast<int32_t>(numberLane(y, i)),
                            numberLane(z, i), numberLane(reciprocalW, i)};
            outcodes[v] = static_cast<uint8_t>(numberLane(code, i));
        }
    });
}

}  // namespace

template <>
constexpr VertexPasses kPassesOver<VertexPasses, void> = {projectVertices};
template const VertexPasses& ETALON_LEVEL::passesOf<VertexPasses>();

}  // namespace etalon
