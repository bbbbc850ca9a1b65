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
      stencil(width, height, targetFormat.samples),
      id(width, height, targetFormat.samples) {
    samplePositions(format.samples);
    ETALON_CHECK(format.subpixelBits >= 4 && format.subpixelBits <= 8, "subpixelBits = {}",
                 format.subpixelBits);
    depth.fill(farthestDepth(format.depth));
    id.fill(kNoTriangle);
}

}  // namespace etalon
