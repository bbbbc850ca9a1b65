#include "lighting/transform.h"

#include "numeric/door.h"
#include "numeric/kernel_types.h"
#include "numeric/number.h"

namespace etalon {
namespace {

template <class T>
struct VertexKernels {
#include "numeric/kernel_scope.inc"
#include "raster/kernels/transform.glsl"
};

// Calls write(i, point) with the rows applied to from[i] for each i, in lanes of S.
template <class S, class Point, class Write>
void transformAll(const TransformRows& rows, std::span<const Point> from, Write write) {
    using T = Native<S>;
    using Kernels = VertexKernels<T>;
    using vec4 = typename Kernels::vec4;
    Kernels kernels;
    const auto toLanes = [](const glm::dvec4& row) { return vec4(T(row.x), T(row.y), T(row.z), T(row.w)); };
    const vec4 row0 = toLanes(rows[0]), row1 = toLanes(rows[1]), row2 = toLanes(rows[2]),
               row3 = toLanes(rows[3]);
    forEachLaneGroup<Number<T>::lanes>(from.size(), [&](size_t first, int active) {
        const auto item = [&](int lane) -> const Point& {
            return from[first + static_cast<size_t>(lane < active ? lane : active - 1)];
        };
        const typename Kernels::vec3 p(Number<T>::generate([&](int i) { return item(i).x; }),
                                       Number<T>::generate([&](int i) { return item(i).y; }),
                                       Number<T>::generate([&](int i) { return item(i).z; }));
        const vec4 q = kernels.transformPoint(row0, row1, row2, row3, p);
        for (int i = 0; i < active; i++)
            write(first + static_cast<size_t>(i),
                  ClipVertex{numberLane(q.x, i), numberLane(q.y, i), numberLane(q.z, i), numberLane(q.w, i)});
    });
}

template <class Point, class Write>
void transformIn(RasterReal real, const TransformRows& rows, std::span<const Point> from, Write write) {
    if (real == RasterReal::fp32)
        transformAll<float>(rows, from, write);
    else
        transformAll<double>(rows, from, write);
}

void transformPoints(RasterReal real, const TransformRows& rows, std::span<const glm::vec3> from,
                     std::span<glm::dvec3> to) {
    transformIn(real, rows, from, [&](size_t i, const ClipVertex& p) { to[i] = {p.x, p.y, p.z}; });
}

void projectPoints(RasterReal real, const TransformRows& rows, std::span<const glm::dvec3> from,
                   std::span<ClipVertex> to) {
    transformIn(real, rows, from, [&](size_t i, const ClipVertex& p) { to[i] = p; });
}

}  // namespace

template <>
constexpr TransformPasses kPassesOver<TransformPasses, void> = {transformPoints, projectPoints};
template const TransformPasses& ETALON_LEVEL::passesOf<TransformPasses>();

}  // namespace etalon
