// The kernel text of ambient occlusion, and what it reads: a view that was drawn with depths of D32F, and the
// weights of its texels.
#pragma once

#include <span>

#include "numeric/number.h"
#include "raster/render_target.h"

namespace etalon {

template <class T>
struct OcclusionKernels {
#include "numeric/kernel_scope.inc"
    // The GLSL counterpart is shadows/kernels/occlusion_scope.glsl; the two say the same.
    boolean isDrawn(integer column, integer row) const {
        return Number<T>::generate([&](int i) {
                   return view->id.at(laneOf(column, i), laneOf(row, i)) == kNoTriangle ? 0.0 : 1.0;
               }) > T(0.0);
    }
    real drawnDepth(integer column, integer row) const {
        return Number<T>::generate([&](int i) {
            return depthFromStored(DepthFormat::d32f, view->depth.at(laneOf(column, i), laneOf(row, i)));
        });
    }
    real texelWeight(int i) const { return T(weights[static_cast<size_t>(i)]); }
#include "numeric/kernels/vector.glsl"
#include "shadows/kernels/occlusion.glsl"

    const RenderTarget* view = nullptr;
    std::span<const double> weights;  // row after row

  private:
    static int laneOf(const integer& a, int i) { return static_cast<int>(numberLane(a, i)); }
};

}  // namespace etalon
