// A scalar replay of rules 1 to 7, 10 and 11 of docs/specification.md: one triangle after the other, one
// sample after the other, on top of the coverage oracle. No tiles, lanes, threads or early rejection.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "raster/rasterizer.h"
#include "tests/support/coverage_oracle.h"

namespace etalon::oracle {

struct Record {
    uint32_t draw = 0, triangle = 0;
    bool front = false, clipped = false;
    Piece piece;
};

// The planes of a RenderTarget; id is an index into `records`, or kNoTriangle.
struct Target {
    Target(int width, int height, const RenderTargetFormat& targetFormat);

    RenderTargetFormat format;
    Image<int64_t> depth;
    Image<uint8_t> stencil;
    Image<uint32_t> id;
    std::vector<Record> records;
    uint32_t drawCount = 0;
};

// Draws as rasterize() must. Every field of the result but `records` is filled in. Slope-scaled bias is left
// out, because the specification does not fix its order of operations; use DrawStates without it.
RasterStatistics replay(Target& target, const Viewport& viewport, std::span<const Draw> draws);

// The depth of rule 5 at a position, before bias: the same operations in the same order.
template <class Real>
Real interpolatedDepth(const Piece& piece, Wide x_subpx, Wide y_subpx);

// Rule 6, with 128-bit integers where it says "exact". z: finite, clamped here.
template <class Real>
int64_t storedDepth(DepthFormat format, DepthRounding rounding, Real z);

// What a target stores at a sample, both halves of D64F in one.
int64_t storedDepth(const RenderTarget& target, int x, int y, int sample);

// Rule 11: the value that an operation leaves, before the write mask.
uint8_t stencilResult(StencilOperation operation, uint8_t stored, uint8_t reference);

// Where and how the planes or the records behind the ids differ first; empty when they do not.
std::string firstDifference(const RenderTarget& actual, const Target& expected);

}  // namespace etalon::oracle
