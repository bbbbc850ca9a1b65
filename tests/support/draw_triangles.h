// Draws loose triangles into a new target: three vertices each, no sharing.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

#include "raster/rasterizer.h"

namespace etalon {

// No culling, and every covered sample is written.
inline DrawState alwaysState() {
    DrawState state;
    state.cull = CullMode::none;
    state.depthCompare = Compare::always;
    return state;
}

inline std::vector<uint32_t> consecutiveIndices(size_t count) {
    std::vector<uint32_t> indices(count);
    std::iota(indices.begin(), indices.end(), 0u);
    return indices;
}

inline RasterStatistics drawInto(RenderTarget& target, const Viewport& viewport,
                                 const std::vector<ClipVertex>& vertices, const DrawState& state,
                                 const RasterOptions& options = {1, 64}) {
    const std::vector<uint32_t> indices = consecutiveIndices(vertices.size());
    const Draw draw{vertices, indices, state};
    return rasterize(target, viewport, {&draw, 1}, options);
}

// The target ends at the viewport's far corner.
inline RenderTarget drawTriangles(const Viewport& viewport, const std::vector<ClipVertex>& vertices,
                                  const DrawState& state, const RenderTargetFormat& format = {},
                                  RasterStatistics* statistics = nullptr) {
    RenderTarget target(viewport.x + viewport.width, viewport.y + viewport.height, format);
    const RasterStatistics result = drawInto(target, viewport, vertices, state);
    if (statistics) *statistics = result;
    return target;
}

}  // namespace etalon
