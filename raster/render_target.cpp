#include "raster/render_target.h"

#include "numeric/check.h"

namespace etalon {
namespace {

// The Direct3D standard sample patterns [D3D11.3, sec. 19.2.4], moved by 8 to the pixel's corner.
constexpr std::array<std::array<int, 2>, 1> kCentre = {{{8, 8}}};
constexpr std::array<std::array<int, 2>, 4> kFourSamples = {{{6, 2}, {14, 6}, {2, 10}, {10, 14}}};
constexpr std::array<std::array<int, 2>, 16> kSixteenSamples = {{{9, 9},
                                                                 {7, 5},
                                                                 {5, 10},
                                                                 {12, 7},
                                                                 {3, 6},
                                                                 {10, 13},
                                                                 {13, 11},
                                                                 {11, 3},
                                                                 {6, 14},
                                                                 {8, 1},
                                                                 {4, 2},
                                                                 {2, 12},
                                                                 {0, 8},
                                                                 {15, 4},
                                                                 {14, 15},
                                                                 {1, 0}}};

}  // namespace

std::span<const std::array<int, 2>> samplePositions(int samples) {
    switch (samples) {
        case 1:
            return kCentre;
        case 4:
            return kFourSamples;
        case 16:
            return kSixteenSamples;
        default:
            ETALON_CHECK(false, "samples = {}, must be 1, 4 or 16", samples);
            return {};
    }
}

RenderTarget::RenderTarget(int width, int height, const RenderTargetFormat& targetFormat)
    : format(targetFormat),
      depth(width, height, targetFormat.samples),
      lowDepth(targetFormat.depth == DepthFormat::d64f ? Image<uint32_t>(width, height, targetFormat.samples)
                                                       : Image<uint32_t>()),
      id(width, height, targetFormat.samples) {
    samplePositions(format.samples);
    ETALON_CHECK(format.subpixelBits >= 4 && format.subpixelBits <= 8, "subpixelBits = {}",
                 format.subpixelBits);
    ETALON_CHECK(format.depthOrder == DepthOrder::stored ||
                     (format.depth == DepthFormat::d64f && format.real == RasterReal::fp64),
                 "an exact order of depths that are not double");
    clear();
}

void RenderTarget::setStencil(int bits) {
    ETALON_CHECK(bits == 8 || bits == 32, "stencil of {} bits", bits);
    format.stencilBits = bits;
    const auto clearIf = [&](bool isUsed, auto& image) {
        if (!isUsed)
            image = {};
        else if (image.empty())
            image = {width(), height(), format.samples};
        else
            image.fill(0);
    };
    clearIf(bits == 8, stencil);
    clearIf(bits == 32, wideStencil);
}

void RenderTarget::clear() {
    depth.fill(farthestDepth(format));
    lowDepth.fill(0);
    largestDepth = 1;
    setStencil(format.stencilBits);
    id.fill(kNoTriangle);
    forgetTriangles();
}

void RenderTarget::forgetTriangles(const Drawn& kept) {
    drawCount = kept.draws;
    biases.resize(kept.draws);
    triangles.resize(kept.triangles);
    vertices.resize(kept.vertices);
    clippedVertices.resize(kept.clippedVertices);
}

TriangleRecord RenderTarget::triangle(uint32_t triangleId) const {
    const StoredTriangle& stored = triangles[triangleId];
    TriangleRecord record{};
    for (size_t i = 0; i < 3; i++) {
        const ProjectedVertex& v = vertex(stored, i);
        record.x_subpx[i] = v.x_subpx;
        record.y_subpx[i] = v.y_subpx;
        record.z[i] = v.z;
        record.reciprocalW[i] = v.reciprocalW;
    }
    const auto difference = [](const std::array<int32_t, 3>& c, size_t i) { return int64_t{c[i]} - c[0]; };
    record.area = difference(record.x_subpx, 1) * difference(record.y_subpx, 2) -
                  difference(record.x_subpx, 2) * difference(record.y_subpx, 1);
    record.draw = stored.draw;
    record.triangle = stored.triangle;
    record.corner = stored.exchanged ? std::array<uint8_t, 3>{0, 2, 1} : std::array<uint8_t, 3>{0, 1, 2};
    record.front = stored.front;
    record.reversed = stored.reversed;
    record.clipped = stored.clipped;
    return record;
}

}  // namespace etalon
