#include "tests/support/reference_replay.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "numeric/text.h"

namespace etalon::oracle {
namespace {

int bitsOf(DepthFormat format) { return format == DepthFormat::d16 ? 16 : 24; }

// z_i of rule 5.
template <class Real>
std::array<Real, 3> vertexDepths(const Piece& piece) {
    std::array<Real, 3> z;
    for (size_t i = 0; i < 3; i++) {
        z[i] = static_cast<Real>(std::clamp(piece.z[i] / piece.w[i], -0x1p100, 0x1p100));
        if (std::abs(z[i]) < Real(0x1p-70)) z[i] = 0;
    }
    return z;
}

// Rule 7 without the slope.
template <class Real>
Real constantBias(const DepthBias& bias, const RenderTargetFormat& format, const Piece& piece) {
    const int bits = format.depth == DepthFormat::d16 ? 16 : 24;
    double u =
        format.biasUnit == BiasUnit::step ? 1 / (std::ldexp(1.0, bits) - 1) : std::ldexp(1.0, 1 - bits);
    if (format.depth == DepthFormat::d32f || format.depth == DepthFormat::d64f) {
        double largest = 0x1p-70;
        for (Real z : vertexDepths<Real>(piece))
            largest = std::max(largest, std::abs(static_cast<double>(z)));
        u = std::ldexp(1.0, std::ilogb(largest) - (format.depth == DepthFormat::d32f ? 23 : 52));
    }
    double value = bias.constant * u;
    if (bias.clamp > 0) value = std::min(value, bias.clamp);
    if (bias.clamp < 0) value = std::max(value, bias.clamp);
    return static_cast<Real>(value);
}

bool passes(Compare compare, int64_t a, int64_t b) {
    switch (compare) {
        case Compare::never:
            return false;
        case Compare::less:
            return a < b;
        case Compare::equal:
            return a == b;
        case Compare::lessEqual:
            return a <= b;
        case Compare::greater:
            return a > b;
        case Compare::notEqual:
            return a != b;
        case Compare::greaterEqual:
            return a >= b;
        default:
            return true;
    }
}

// One fragment at one sample: stencil test, depth test, writes.
void drawSample(Target& target, const DrawState& state, bool front, int64_t z, uint32_t id, int x, int y,
                int s) {
    int64_t& storedZ = target.depth.at(x, y, s);
    uint8_t& stored = target.stencil.at(x, y, s);
    const StencilFace& face = front ? state.stencil.front : state.stencil.back;
    const StencilState& stencil = state.stencil;
    const bool stencilPasses = !stencil.enabled || passes(face.compare, stencil.reference & stencil.readMask,
                                                          stored & stencil.readMask);
    const bool depthPasses = passes(state.depthCompare, z, storedZ);
    if (stencil.enabled) {
        const StencilOperation operation = !stencilPasses ? face.onStencilFail
                                           : depthPasses  ? face.onPass
                                                          : face.onDepthFail;
        const uint8_t value = stencilResult(operation, stored, stencil.reference);
        stored = static_cast<uint8_t>((stored & ~stencil.writeMask) | (value & stencil.writeMask));
    }
    if (!stencilPasses || !depthPasses) return;
    if (state.depthWrite) storedZ = z;
    if (state.idWrite) target.id.at(x, y, s) = id;
}

template <class Real>
void drawPolygon(Target& target, const Viewport& viewport, const DrawState& state, const Polygon& polygon,
                 uint32_t firstRecord, bool front) {
    const Wide pixel = Wide(1) << target.format.subpixelBits;
    std::vector<Real> bias;
    Wide left = viewport.x + viewport.width, right = viewport.x, top = viewport.y + viewport.height,
         bottom = viewport.y;
    for (const Piece& piece : polygon.pieces) {
        bias.push_back(constantBias<Real>(state.bias, target.format, piece));
        for (size_t i = 0; i < 3; i++) {  // a box that is a pixel too large on each side
            left = std::min(left, piece.x_subpx[i] / pixel - 2);
            right = std::max(right, piece.x_subpx[i] / pixel + 2);
            top = std::min(top, piece.y_subpx[i] / pixel - 2);
            bottom = std::max(bottom, piece.y_subpx[i] / pixel + 2);
        }
    }
    const int x0 = static_cast<int>(std::max<Wide>(left, viewport.x));
    const int x1 = static_cast<int>(std::min<Wide>(right, viewport.x + viewport.width));
    const int y0 = static_cast<int>(std::max<Wide>(top, viewport.y));
    const int y1 = static_cast<int>(std::min<Wide>(bottom, viewport.y + viewport.height));
    for (int y = y0; y < y1; y++)
        for (int x = x0; x < x1; x++)
            for (int s = 0; s < target.format.samples; s++) {
                const auto p = samplePosition(x, y, target.format.samples, s, target.format.subpixelBits);
                const auto index = coveringPiece(polygon, p[0], p[1]);
                if (!index) continue;
                const Real z = interpolatedDepth<Real>(polygon.pieces[*index], p[0], p[1]) + bias[*index];
                drawSample(target, state, front,
                           storedDepth(target.format.depth, target.format.depthRounding, z),
                           firstRecord + static_cast<uint32_t>(*index), x, y, s);
            }
}

std::string describe(const RenderTarget& actual, const Target& expected, uint32_t actualId,
                     uint32_t expectedId) {
    if (actualId == kNoTriangle || expectedId == kNoTriangle)
        return actualId == expectedId ? "" : formatText("id {} instead of {}", actualId, expectedId);
    if (actualId >= actual.triangleCount()) return formatText("id {} has no record", actualId);
    const TriangleRecord a = actual.triangle(actualId);
    const Record& e = expected.records[expectedId];
    if (a.draw != e.draw || a.triangle != e.triangle)
        return formatText("triangle {}.{} instead of {}.{}", a.draw, a.triangle, e.draw, e.triangle);
    if (a.front != e.front || a.area != e.piece.area) return "facing or area of the record";
    if (a.clipped != e.clipped) return "clipped flag of the record";
    for (size_t i = 0; i < 3; i++) {
        if (a.x_subpx[i] != e.piece.x_subpx[i] || a.y_subpx[i] != e.piece.y_subpx[i])
            return "snapped positions of the record";
        const double z = actual.format.real == RasterReal::fp32
                             ? static_cast<double>(vertexDepths<float>(e.piece)[i])
                             : vertexDepths<double>(e.piece)[i];
        if (a.z[i] != z || a.reciprocalW[i] != 1 / e.piece.w[i]) return "depth or 1/w of the record";
        if (!e.clipped && a.corner[i] != e.piece.corner[i]) return "corners of the record";
        if (e.clipped && actual.barycentric(actualId, i) != e.piece.barycentric[i])
            return "barycentric coordinates of the record";
    }
    return "";
}

}  // namespace

Target::Target(int width, int height, const RenderTargetFormat& targetFormat)
    : format(targetFormat),
      depth(width, height, targetFormat.samples),
      stencil(width, height, targetFormat.samples),
      id(width, height, targetFormat.samples) {
    depth.fill(format.depthDirection == DepthDirection::reversed
                   ? 0
                   : storedDepth<double>(format.depth, DepthRounding::exact, 1));
    id.fill(kNoTriangle);
}

RasterStatistics replay(Target& target, const Viewport& viewport, std::span<const Draw> draws) {
    RasterStatistics statistics;
    for (size_t d = 0; d < draws.size(); d++) {
        const DrawState& state = draws[d].state;
        for (size_t t = 0; 3 * t + 2 < draws[d].indices.size(); t++) {
            std::array<ClipVertex, 3> triangle;
            for (size_t i = 0; i < 3; i++) triangle[i] = draws[d].vertices[draws[d].indices[3 * t + i]];
            const Polygon polygon =
                preparePolygon(triangle, viewport, target.format.subpixelBits, state.depthClamp);
            statistics.triangles++;
            statistics.droppedNonFinite += polygon.fate == Fate::nonFinite;
            statistics.rejected += polygon.fate == Fate::rejected;
            statistics.clipped += polygon.clipped;
            statistics.zeroArea += polygon.fate == Fate::zeroArea;
            if (polygon.fate != Fate::drawn) continue;
            const bool front = (polygon.sign < 0) != state.frontIsClockwise;
            if (state.cull == (front ? CullMode::front : CullMode::back)) {
                statistics.culled++;
                continue;
            }
            const auto first = static_cast<uint32_t>(target.records.size());
            for (const Piece& piece : polygon.pieces)
                target.records.push_back(
                    {target.drawCount, static_cast<uint32_t>(t), front, polygon.clipped, piece});
            if (target.format.real == RasterReal::fp32)
                drawPolygon<float>(target, viewport, state, polygon, first, front);
            else
                drawPolygon<double>(target, viewport, state, polygon, first, front);
        }
        target.drawCount++;
    }
    return statistics;
}

template <class Real>
Real interpolatedDepth(const Piece& piece, Wide x_subpx, Wide y_subpx) {
    const auto e = edgeValues(piece, x_subpx, y_subpx);
    const auto z = vertexDepths<Real>(piece);
    const Real r = static_cast<Real>(1.0 / static_cast<double>(piece.area));
    std::array<Real, 3> l;
    for (size_t i = 0; i < 3; i++) l[i] = static_cast<Real>(e[i]) * r;
    const Real sum = l[0] * z[0] + (l[1] * z[1] + l[2] * z[2]);
    return std::clamp(sum, std::min({z[0], z[1], z[2]}), std::max({z[0], z[1], z[2]}));
}

template <class Real>
int64_t storedDepth(DepthFormat format, DepthRounding rounding, Real z) {
    z = z > 0 ? std::min(z, Real(1)) : Real(0);  // -0 becomes 0
    if (format == DepthFormat::d64f) return std::bit_cast<int64_t>(static_cast<double>(z));
    if (format == DepthFormat::d32f) return std::bit_cast<int32_t>(static_cast<float>(z));
    const int bits = bitsOf(format);
    const int64_t levels = (int64_t(1) << bits) - 1;
    if (rounding == DepthRounding::driver)
        return static_cast<int64_t>(std::nearbyint(static_cast<float>(z) * static_cast<float>(levels)));
    if (rounding == DepthRounding::fixedFunction) {
        // The float is m / 2^scale; rule 22 in integers.
        int exponent;
        const auto m = static_cast<int64_t>(
            std::ldexp(std::frexp(static_cast<double>(static_cast<float>(z)), &exponent), 24));
        const int scale = 24 - exponent;
        if (scale > 90) return 0;  // z < 2^-66
        const Wide one = Wide(1) << scale;
        if (bits == 16) {
            // Cut to t / 2^20; up where 2 (t levels mod 2^20) > 2^20.
            const Wide product = ((Wide(m) << 20) >> scale) * levels;
            return static_cast<int64_t>((2 * product + (1 << 20) - 1) >> 21);
        }
        const Wide product = Wide(m) * levels, k = product >> scale, twice = 2 * (product - (k << scale));
        const Wide scaled = Wide(m) << 24;
        const bool isMiddle = 16 * Wide(m) < one && 2 * (scaled % one) == one;
        return static_cast<int64_t>(k + (twice > one || (twice == one && k % 2 == 1) || isMiddle ? 1 : 0));
    }
    // z = mantissa / 2^scale; floor((2 mantissa levels + 2^scale) / 2^(scale + 1)).
    int exponent;
    const auto mantissa = static_cast<int64_t>(std::ldexp(std::frexp(static_cast<double>(z), &exponent), 53));
    const int scale = 53 - exponent;
    if (scale > 120) return 0;  // z < 2^-66
    return static_cast<int64_t>((2 * Wide(mantissa) * levels + (Wide(1) << scale)) >> (scale + 1));
}

uint8_t stencilResult(StencilOperation operation, uint8_t stored, uint8_t reference) {
    switch (operation) {
        case StencilOperation::keep:
            return stored;
        case StencilOperation::zero:
            return 0;
        case StencilOperation::replace:
            return reference;
        case StencilOperation::incrementClamp:
            return stored == 255 ? 255 : static_cast<uint8_t>(stored + 1);
        case StencilOperation::decrementClamp:
            return stored == 0 ? 0 : static_cast<uint8_t>(stored - 1);
        case StencilOperation::invert:
            return static_cast<uint8_t>(255 - stored);
        case StencilOperation::incrementWrap:
            return static_cast<uint8_t>((stored + 1) % 256);
        default:
            return static_cast<uint8_t>((stored + 255) % 256);
    }
}

int64_t storedDepth(const RenderTarget& target, int x, int y, int sample) {
    const auto high = static_cast<int32_t>(target.depth.at(x, y, sample));
    if (target.lowDepth.empty()) return high;
    return int64_t{high} * (int64_t{1} << 32) + target.lowDepth.at(x, y, sample);
}

std::string firstDifference(const RenderTarget& actual, const Target& expected) {
    for (int s = 0; s < expected.format.samples; s++)
        for (int y = 0; y < expected.id.height(); y++)
            for (int x = 0; x < expected.id.width(); x++) {
                std::string what = describe(actual, expected, actual.id.at(x, y, s), expected.id.at(x, y, s));
                if (what.empty() && actual.stencil.at(x, y, s) != expected.stencil.at(x, y, s))
                    what = formatText("stencil {} instead of {}", actual.stencil.at(x, y, s),
                                      expected.stencil.at(x, y, s));
                const int64_t depth = storedDepth(actual, x, y, s);
                if (what.empty() && depth != expected.depth.at(x, y, s))
                    what = formatText("depth {:#x} instead of {:#x}", depth, expected.depth.at(x, y, s));
                if (!what.empty()) return formatText("pixel ({}, {}) sample {}: {}", x, y, s, what);
            }
    return "";
}

template float interpolatedDepth<float>(const Piece&, Wide, Wide);
template double interpolatedDepth<double>(const Piece&, Wide, Wide);
template int64_t storedDepth<float>(DepthFormat, DepthRounding, float);
template int64_t storedDepth<double>(DepthFormat, DepthRounding, double);

}  // namespace etalon::oracle
