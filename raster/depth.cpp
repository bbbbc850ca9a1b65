#include "raster/depth.h"

#include <algorithm>
#include <cmath>

namespace etalon {
namespace {

// The unit of the constant bias: the smallest step of a UNORM format, or of a float near the largest depth.
double biasUnit(DepthFormat format, double zMax) {
    constexpr int kFloatFractionBits = 23;
    constexpr int kFloatMinExponent = -126;
    switch (format) {
        case DepthFormat::d16: return 0x1p-16;
        case DepthFormat::d24: return 0x1p-24;
        case DepthFormat::d32f: break;
    }
    const int exponent = zMax > 0 ? std::max(std::ilogb(zMax), kFloatMinExponent) : kFloatMinExponent;
    return std::ldexp(1.0, exponent - kFloatFractionBits);
}

}  // namespace

double depthBias(const DepthBias& bias, DepthFormat format, const TriangleRecord& record, int subpixelBits) {
    if (bias.constant == 0 && bias.slopeScale == 0) return 0;
    double zMax = 0, slopeX = 0, slopeY = 0;
    for (size_t i = 0; i < 3; i++) {
        const size_t a = (i + 1) % 3, b = (i + 2) % 3;
        zMax = std::max(zMax, std::fabs(record.z[i]));
        slopeX = slopeX - record.z[i] * static_cast<double>(record.y_subpx[b] - record.y_subpx[a]);
        slopeY = slopeY + record.z[i] * static_cast<double>(record.x_subpx[b] - record.x_subpx[a]);
    }
    const double subpixelsPerPixel = static_cast<double>(1 << subpixelBits);
    const double perPixel = subpixelsPerPixel / static_cast<double>(record.area);
    const double slope = std::max(std::fabs(slopeX), std::fabs(slopeY)) * perPixel;
    double value = bias.constant * biasUnit(format, zMax) + bias.slopeScale * slope;
    if (bias.clamp > 0) value = std::min(value, bias.clamp);
    if (bias.clamp < 0) value = std::max(value, bias.clamp);
    return value;
}

uint32_t farthestDepth(DepthFormat format) {
    switch (format) {
        case DepthFormat::d16: return 0xffff;
        case DepthFormat::d24: return 0xffffff;
        case DepthFormat::d32f: return 0x3f800000;
    }
    return 0;
}

double depthFromStored(DepthFormat format, uint32_t stored) {
    if (format == DepthFormat::d32f) {
        float z;
        std::memcpy(&z, &stored, sizeof z);
        return z;
    }
    return static_cast<double>(stored) / depthLevels(format);
}

}  // namespace etalon
