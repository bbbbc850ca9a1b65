// Nearest and bilinear sampling of one image. Specified in raster/sampler.h.
// needs: raster/kernels/texture_scope.glsl

// Constants of raster/sampler.h: filter 0 nearest, 1 bilinear; wrap 0 clamp, 1 repeat, 2 mirror.
// fractionBits < 0: exact fractions.
struct Sampling {
    int width;
    int height;
    int filterMode;
    int wrapX;
    int wrapY;
    int fractionBits;
};

// The two texels around a position on one axis: index of the left one (or upper one), weight of the next one.
struct TexelPair {
    integer first;
    real fraction;
};

// Texture coordinate u folded into [0, 1] by the wrap mode. NaN gives 0; an infinite u gives 0, or the border
// that it lies behind with clamp.
real foldCoordinate(real u, int wrap) {
    real folded = u;
    if (wrap == 1) folded = u - floor(u);
    if (wrap == 2) {
        real phase = u - real(2.0) * floor(u * real(0.5));
        folded = minOf(phase, real(2.0) - phase);
    }
    return clampOf(folded, real(0.0), real(1.0));
}

// Index of the texel next to [0, size - 1] brought back inside. Mirroring repeats the border texel, as
// clamping.
integer wrapTexel(integer i, int size, int wrap) {
    integer inside = i;
    if (wrap == 1) {
        inside = selectInteger(lessInteger(i, integer(0)), i + integer(size), i);
        inside = selectInteger(lessInteger(i, integer(size)), inside, i - integer(size));
    }
    return clampInteger(inside, integer(0), integer(size - 1));
}

// Position in texels, centres at whole numbers. The fraction is in [0, 1); a fraction that rounds to 1 is the
// next texel with fraction 0.
TexelPair texelPair(real position, int fractionBits) {
    real whole = floor(position);
    real fraction = position - whole;
    if (fractionBits >= 0) {
        // Round half up to a multiple of 2^-bits; no step but the scalings touches a rounded value.
        real steps = real(1 << fractionBits);
        real scaled = fraction * steps;
        real below = floor(scaled);
        real count = select(scaled - below < real(0.5), below, below + real(1.0));
        fraction = count / steps;
    }
    boolean isInside = fraction < real(1.0);
    TexelPair pair;
    pair.first = toInteger(whole) + selectInteger(isInside, integer(0), integer(1));
    pair.fraction = select(isInside, fraction, real(0.0));
    return pair;
}

// From a (fraction 0) towards b, 0 <= fraction < 1. Never outside [a, b]: the product is at most the largest
// number below the rounded b - a, so at most the exact b - a, and rounding is monotone.
real lerpInside(real a, real b, real fraction) {
    return select(fraction == real(0.0), a, a + (b - a) * fraction);
}
vec3 lerpInside3(vec3 a, vec3 b, real fraction) {
    return vec3(lerpInside(a.x, b.x, fraction), lerpInside(a.y, b.y, fraction),
                lerpInside(a.z, b.z, fraction));
}

// Four texels, first along x, then along y.
real bilinear(real v00, real v10, real v01, real v11, real fractionX, real fractionY) {
    return lerpInside(lerpInside(v00, v10, fractionX), lerpInside(v01, v11, fractionX), fractionY);
}
vec3 bilinear3(vec3 v00, vec3 v10, vec3 v01, vec3 v11, real fractionX, real fractionY) {
    return lerpInside3(lerpInside3(v00, v10, fractionX), lerpInside3(v01, v11, fractionX), fractionY);
}

// The index of the texel that holds a folded coordinate.
integer nearestTexel(real folded, int size) {
    return clampInteger(toInteger(floor(folded * real(size))), integer(0), integer(size - 1));
}

// The four texels of a bilinear sample and the weights of the right and lower ones.
struct ImageTaps {
    integer x0;
    integer x1;
    integer y0;
    integer y1;
    real fractionX;
    real fractionY;
};

// u and v folded.
ImageTaps imageTaps(real u, real v, Sampling s) {
    TexelPair x = texelPair(u * real(s.width) - real(0.5), s.fractionBits);
    TexelPair y = texelPair(v * real(s.height) - real(0.5), s.fractionBits);
    ImageTaps taps;
    taps.x0 = wrapTexel(x.first, s.width, s.wrapX);
    taps.x1 = wrapTexel(x.first + integer(1), s.width, s.wrapX);
    taps.y0 = wrapTexel(y.first, s.height, s.wrapY);
    taps.y1 = wrapTexel(y.first + integer(1), s.height, s.wrapY);
    taps.fractionX = x.fraction;
    taps.fractionY = y.fraction;
    return taps;
}

real sampleReal(texture t, integer layer, real u, real v, Sampling s) {
    real foldedU = foldCoordinate(u, s.wrapX);
    real foldedV = foldCoordinate(v, s.wrapY);
    if (s.filterMode == 0)
        return fetchReal(t, layer, nearestTexel(foldedU, s.width), nearestTexel(foldedV, s.height));
    ImageTaps p = imageTaps(foldedU, foldedV, s);
    return bilinear(fetchReal(t, layer, p.x0, p.y0), fetchReal(t, layer, p.x1, p.y0), fetchReal(t, layer, p.x0, p.y1),
                    fetchReal(t, layer, p.x1, p.y1), p.fractionX, p.fractionY);
}

vec3 sampleRgb(texture t, integer layer, real u, real v, Sampling s) {
    real foldedU = foldCoordinate(u, s.wrapX);
    real foldedV = foldCoordinate(v, s.wrapY);
    if (s.filterMode == 0)
        return fetchRgb(t, layer, nearestTexel(foldedU, s.width), nearestTexel(foldedV, s.height));
    ImageTaps p = imageTaps(foldedU, foldedV, s);
    RgbPair upper = fetchRgbPair(t, layer, p.x0, p.y0, layer, p.x1, p.y0);
    RgbPair lower = fetchRgbPair(t, layer, p.x0, p.y1, layer, p.x1, p.y1);
    return bilinear3(upper.first, upper.second, lower.first, lower.second, p.fractionX, p.fractionY);
}
