// From clip space to the screen for one vertex, or for several side by side: rules 1 to 3 without the cut.
#pragma once

#include "numeric/kernel_types.h"
#include "raster/rasterizer.h"
#include "raster/render_target.h"

namespace etalon {

enum ClipPlane { planeW, planeNear, planeFar, planeRight, planeLeft, planeTop, planeBottom, kClipPlanes };

// Bits of a vertex's outcode: 1 << plane for each plane that it is outside of, and this one for a vertex that
// rule 1 drops.
inline constexpr int kUnusableVertex = 1 << kClipPlanes;
inline constexpr int kDepthPlanes = 1 << planeNear | 1 << planeFar;

// What the projection of a viewport's vertices has in common.
struct ViewportTransform {
    ViewportTransform(const Viewport& viewport, int subpixelBits, RasterReal depthReal)
        : guardX(kGuardBandWidth_px / viewport.width),
          guardY(kGuardBandWidth_px / viewport.height),
          centreX_px(viewport.x + viewport.width / 2.0),
          centreY_px(viewport.y + viewport.height / 2.0),
          halfWidth_px(viewport.width / 2.0),
          halfHeight_px(viewport.height / 2.0),
          subpixels(static_cast<double>(1 << subpixelBits)),
          real(depthReal) {}

    static constexpr double kGuardBandWidth_px = 131072.0;

    double guardX, guardY;  // the guard band as multiples of w: half its width in units of half the viewport
    double centreX_px, centreY_px, halfWidth_px, halfHeight_px;
    double subpixels;  // per pixel
    RasterReal real;   // of the depths
};

// T is double or lanes of it.
template <class T>
struct Projection {
#include "numeric/kernel_scope.inc"
    static constexpr double kMaxClipCoordinate = 0x1p500;
    static constexpr double kMinW = 0x1p-80;
    static constexpr double kGuardBandHalfWidth_px = ViewportTransform::kGuardBandWidth_px / 2;
    static constexpr double kSmallestDepth = 0x1p-70;
    static constexpr double kLargestDepth = 0x1p100;

    // False for NaN and for magnitudes that clipping could overflow with.
    static boolean isUsable(vec4 p) {
        const real limit(kMaxClipCoordinate);
        return absOf(p.x) < limit && absOf(p.y) < limit && absOf(p.z) < limit && absOf(p.w) < limit;
    }

    // The plane's signed distance; inside: not negative.
    static real signedDistance(int plane, vec4 p, const ViewportTransform& t) {
        switch (plane) {
            case planeW:
                return p.w - real(kMinW);
            case planeNear:
                return p.z;
            case planeFar:
                return p.w - p.z;
            case planeRight:
                return real(t.guardX) * p.w - p.x;
            case planeLeft:
                return real(t.guardX) * p.w + p.x;
            case planeTop:
                return real(t.guardY) * p.w - p.y;
            default:
                return real(t.guardY) * p.w + p.y;
        }
    }

    // The outcode as a whole number, and whether the vertex can be projected: it is usable and inside the
    // planes of w and the guard band.
    struct Outcode {
        real code;
        boolean canBeProjected;
    };
    static Outcode outcode(vec4 p, const ViewportTransform& t) {
        Outcode result{real(0.0), isUsable(p)};
        result.code = select(result.canBeProjected, real(0.0), real(static_cast<double>(kUnusableVertex)));
        for (int plane = 0; plane < kClipPlanes; plane++) {
            const boolean outside = signedDistance(plane, p, t) < real(0.0);
            result.code = result.code + select(outside, real(static_cast<double>(1 << plane)), real(0.0));
            if ((kDepthPlanes & 1 << plane) == 0) result.canBeProjected = result.canBeProjected && !outside;
        }
        return result;
    }

    // Nearest whole number, ties to even, for |v| < 2^51: the sum with 1.5 * 2^52 has no fraction bits.
    static real roundEven(real v) {
        const real toWhole(6755399441055744.0);
        return (v + toWhole) - toWhole;
    }

    // Snapped screen coordinates, as whole numbers. Defined for vertices inside the planes of w and the guard
    // band; rounding in a cut can leave the band by a little.
    static real snapX(vec4 p, const ViewportTransform& t) {
        const real x_px = p.x / p.w * real(t.halfWidth_px) + real(t.centreX_px);
        return roundEven(insideGuardBand(x_px, t.centreX_px) * real(t.subpixels));
    }
    static real snapY(vec4 p, const ViewportTransform& t) {
        const real y_px = p.y / p.w * real(-t.halfHeight_px) + real(t.centreY_px);
        return roundEven(insideGuardBand(y_px, t.centreY_px) * real(t.subpixels));
    }
    // The z_i of rule 5.
    static real depth(vec4 p, const ViewportTransform& t) {
        real z = clampOf(p.z / p.w, real(-kLargestDepth), real(kLargestDepth));
        if (t.real == RasterReal::fp32) z = roundedToFloat(z);
        return select(absOf(z) < real(kSmallestDepth), real(0.0), z);
    }

  private:
    static real roundedToFloat(real v) {
        if constexpr (std::is_same_v<T, double>)
            return static_cast<double>(static_cast<float>(v));
        else
            return convertLanes<double>(convertLanes<float>(v));
    }
    static real insideGuardBand(real v_px, double centre_px) {
        return clampOf(v_px, real(centre_px - kGuardBandHalfWidth_px),
                       real(centre_px + kGuardBandHalfWidth_px));
    }
};

}  // namespace etalon
