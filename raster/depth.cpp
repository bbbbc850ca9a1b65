#include "raster/depth.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "raster/projection.h"

namespace etalon {
namespace {

constexpr uint32_t kBehindReversed = 0xffffffff;  // -1, as signed integers are compared
constexpr double kSmallestDepth = Projection<double>::kSmallestDepth;

// The unit of the constant bias: that of a UNORM format, or the step of the float format near the largest depth.
double biasUnit(const RenderTargetFormat& format, double largest) {
    const double levels = depthLevels(format.depth);
    if (levels != 0) return format.biasUnit == BiasUnit::step ? 1 / levels : 2 / (levels + 1);
    const int fractionBits = format.depth == DepthFormat::d64f ? 52 : 23;
    return std::ldexp(1.0, std::ilogb(std::max(largest, kSmallestDepth)) - fractionBits);
}

}  // namespace

double depthBias(const DepthBias& bias, const RenderTargetFormat& format, const TriangleRecord& record) {
    const std::array<double, 3>& z = record.z;
    if (bias.constant == 0 && bias.slopeScale == 0) return 0;
    const auto x = [&](size_t i) {
        return static_cast<double>(int64_t{record.x_subpx[i]} - record.x_subpx[0]);
    };
    const auto y = [&](size_t i) {
        return static_cast<double>(int64_t{record.y_subpx[i]} - record.y_subpx[0]);
    };
    const double perPixel = static_cast<double>(1 << format.subpixelBits) / static_cast<double>(record.area);
    const double slopeX = ((z[1] - z[0]) * y(2) - (z[2] - z[0]) * y(1)) * perPixel;
    const double slopeY = ((z[2] - z[0]) * x(1) - (z[1] - z[0]) * x(2)) * perPixel;
    const double slope = std::max(std::fabs(slopeX), std::fabs(slopeY));
    const double largest = std::max({std::fabs(z[0]), std::fabs(z[1]), std::fabs(z[2])});
    double value = bias.constant * biasUnit(format, largest) + bias.slopeScale * slope;
    if (bias.clamp > 0) value = std::min(value, bias.clamp);
    if (bias.clamp < 0) value = std::max(value, bias.clamp);
    return value;
}

uint32_t storedOne(DepthFormat format) {
    switch (format) {
        case DepthFormat::d16:
            return 0xffff;
        case DepthFormat::d24:
            return 0xffffff;
        case DepthFormat::d32f:
            return 0x3f800000;
        case DepthFormat::d64f:
            return 0x3ff00000;
    }
    return 0;
}

uint32_t farthestDepth(const RenderTargetFormat& format) {
    return format.depthDirection == DepthDirection::reversed ? 0 : storedOne(format.depth);
}

uint32_t nearestDepth(const RenderTargetFormat& format) {
    return format.depthDirection == DepthDirection::reversed ? storedOne(format.depth) : 0;
}

uint32_t depthBehindAll(const RenderTargetFormat& format) {
    if (format.depthDirection == DepthDirection::reversed) return kBehindReversed;
    return depthLevels(format.depth) == 0 ? 0x40000000 : 2 * storedOne(format.depth);
}

double depthFromStored(DepthFormat format, uint32_t stored, uint32_t low) {
    if (stored == kBehindReversed) return -1;
    if (format == DepthFormat::d64f) return std::bit_cast<double>(uint64_t{stored} << 32 | low);
    if (format == DepthFormat::d32f) {
        float z;
        std::memcpy(&z, &stored, sizeof z);
        return z;
    }
    return static_cast<double>(stored) / depthLevels(format);
}

}  // namespace etalon
