// What is drawn, and with which fixed state (docs/specification.md).
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace etalon {

// A vertex position in clip space: inside the volume when 0 < w and 0 <= z <= w; x right, y up.
struct ClipVertex {
    double x, y, z, w;
};

enum class Compare : uint8_t { never, less, equal, lessEqual, greater, notEqual, greaterEqual, always };

enum class StencilOperation : uint8_t {
    keep,
    zero,
    replace,
    incrementClamp,
    decrementClamp,
    invert,
    incrementWrap,
    decrementWrap
};

enum class CullMode : uint8_t { none, front, back };

// Stencil test and operations for the triangles of one facing (rule 11).
struct StencilFace {
    Compare compare = Compare::always;
    StencilOperation onStencilFail = StencilOperation::keep;
    StencilOperation onDepthFail = StencilOperation::keep;
    StencilOperation onPass = StencilOperation::keep;
};

struct StencilState {
    bool enabled = false;
    uint8_t reference = 0, readMask = 0xff, writeMask = 0xff;
    StencilFace front, back;
};

// Where depths are 0 and 1: forward on the near and the far plane, reversed on the far and the near one.
enum class DepthDirection : uint8_t { forward, reversed };
// The comparison that what is nearer passes.
inline Compare nearerThan(DepthDirection direction) {
    return direction == DepthDirection::reversed ? Compare::greater : Compare::less;
}

// Depth bias (rule 7). clamp 0: no limit.
struct DepthBias {
    double constant = 0, slopeScale = 0, clamp = 0;
};

struct DrawState {
    CullMode cull = CullMode::back;
    bool frontIsClockwise = false;  // as seen on the screen
    Compare depthCompare = Compare::less;
    bool depthWrite = true;
    bool idWrite = true;      // false: the triangle takes part in depth and stencil but is never visible
    bool depthClamp = false;  // near and far planes do not clip; z is clamped to [0, 1]
    DepthBias bias;
    StencilState stencil;
};

// An indexed triangle list. indices: three per triangle, each below vertices.size().
struct Draw {
    std::span<const ClipVertex> vertices;
    std::span<const uint32_t> indices;
    DrawState state;
    // The numbers of the triangles to draw, in this order, where not all are; they keep their numbers in the
    // records.
    std::optional<std::span<const uint32_t>> only = {};

    size_t triangleCount() const { return only ? only->size() : indices.size() / 3; }
    size_t triangleNumber(size_t i) const { return only ? (*only)[i] : i; }
};

}  // namespace etalon
