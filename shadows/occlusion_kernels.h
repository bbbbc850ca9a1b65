// The kernel text of ambient occlusion, and what it reads: views that were drawn with depths of D32F.
#pragma once

#include <span>

#include "numeric/number.h"
#include "raster/render_target.h"

namespace etalon {

template <class T>
struct OcclusionKernels {
#include "numeric/kernel_scope.inc"
    // The GLSL counterpart is shadows/kernels/occlusion_scope.glsl; the two say the same.

    // A parallel view of everything from the direction `towards`, size x size texels. rows: world space to x and y in
    // [-1, 1] and the depth. offset: metres that a point is looked up above its surface.
    struct ParallelView {
        vec3 towards;
        vec4 rowX, rowY, rowZ;
        int size;
        real offset;
    };
    // A face of a hemicube around one point: the directions of its texels, and whether what is farther than 2^10 times
    // its near plane does not cover (1 or 0).
    struct HemicubeFace {
        vec3 forward, perX, perY;
        real centreX, centreY;
        int width, height, isLimited;
    };
    // One of the two, what it shows, and the weights of a face's texels, row after row.
    struct View {
        const RenderTarget* target = nullptr;
        ParallelView parallel{};
        HemicubeFace face{};
        std::span<const double> weights{};
    };

    const ParallelView& parallelView(int view) const { return kept(view).parallel; }
    const HemicubeFace& hemicubeFace(int view) const { return kept(view).face; }
    boolean isDrawn(int view, integer column, integer row) const {
        const RenderTarget& target = *kept(view).target;
        return Number<T>::generate([&](int i) {
                   return target.id.at(laneOf(column, i), laneOf(row, i)) == kNoTriangle ? 0.0 : 1.0;
               }) > T(0.0);
    }
    real drawnDepth(int view, integer column, integer row) const {
        const RenderTarget& target = *kept(view).target;
        return Number<T>::generate([&](int i) {
            return depthFromStored(DepthFormat::d32f, target.depth.at(laneOf(column, i), laneOf(row, i)));
        });
    }
    real texelWeight(int view, int i) const { return T(kept(view).weights[static_cast<size_t>(i)]); }
#include "numeric/kernels/vector.glsl"
#include "shadows/kernels/occlusion.glsl"

    // The views that are kept, from the one numbered firstView on.
    std::span<const View> views;
    int firstView = 0;

  private:
    const View& kept(int view) const { return views[static_cast<size_t>(view - firstView)]; }
    static int laneOf(const integer& a, int i) { return static_cast<int>(numberLane(a, i)); }
};

}  // namespace etalon
