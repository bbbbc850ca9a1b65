// Nearest and bilinear sampling of one image. Specified in raster/sampler.h.
// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
// needs: raster/kernels/texture_scope.glsl

// Constants of raster/sampler.h: filter 0 nearest, 1 bilinear; wrap 0 clamp, 1 repeat, 2 mirror.
// fractionBits < 0: exact fractions. position, weights and sum: 0 for the rules of this text, 1 for those of
// raster/texture_unit.h; texels: what textures hold, 0 as they are, 1 half, 2 and 3 of 16 and 8 bits.
struct Sampling {
    int width;
    int height;
    int filterMode;
    int wrapX;
    int wrapY;
    int fractionBits;
    int position;
    int weights;
    int sum;
    int texels;
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

// Index of the texel next to [0, size - 1] brought back inside; mirroring, of [-1, 2 size]. Mirroring repeats the border
// texel, as clamping.
integer wrapTexel(integer i, int size, int wrap) {
    integer inside = i;
    if (wrap == 1) {
        inside = selectInteger(lessInteger(i, integer(0)), i + integer(size), i);
        inside = selectInteger(lessInteger(i, integer(size)), inside, i - integer(size));
    }
    if (wrap == 2) {
        int last = 2 * size - 1;
        inside = selectInteger(lessInteger(i, integer(size)), i, integer(last) - i);
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

// Four texels by the rules of s.
real filtered(RealTaps t, real fractionX, real fractionY, Sampling s) {
    if (s.weights == 1) return unitFiltered(t, fractionX, fractionY, s.sum, s.texels);
    return bilinear(t.v00, t.v10, t.v01, t.v11, fractionX, fractionY);
}
vec3 filteredRgb(RgbTaps t, real fractionX, real fractionY, Sampling s) {
    if (s.weights == 1) return unitFilteredRgb(t, fractionX, fractionY, s.sum, s.texels);
    return bilinear3(t.v00, t.v10, t.v01, t.v11, fractionX, fractionY);
}

// Texels as the format of s holds them.
real storedReal(real v, Sampling s) {
    if (s.texels == 0) return v;
    return unitWritten(v, s.texels);
}
vec3 storedRgb(vec3 v, Sampling s) {
    if (s.texels == 0) return v;
    return unitWrittenRgb(v, s.texels);
}
RealTaps realTaps(real v00, real v10, real v01, real v11, Sampling s) {
    RealTaps t = realTapsOf(v00, v10, v01, v11);
    if (s.texels == 0) return t;
    return unitWrittenTaps(t, s.texels);
}
RgbTaps rgbTaps(RgbPair upper, RgbPair lower, Sampling s) {
    RgbTaps t;
    t.v00 = upper.first;
    t.v10 = upper.second;
    t.v01 = lower.first;
    t.v11 = lower.second;
    if (s.texels == 0) return t;
    return unitWrittenRgbTaps(t, s.texels);
}

// The two texels around a coordinate by the texture unit; wrap 3: of a coordinate that is not folded.
TexelPair unitTexelPair(real u, int size, int wrap) {
    UnitTexel texel = unitTexel(u, size, wrap);
    TexelPair pair;
    pair.first = texel.first;
    pair.fraction = texel.fraction;
    return pair;
}
// The two texels around a coordinate inside [0, 1] on an axis of `size` texels, before they are wrapped, and the texel
// that holds it.
TexelPair texelsAround(real u, int size, Sampling s) {
    if (s.position == 1) return unitTexelPair(u, size, 0);
    return texelPair(u * real(size) - real(0.5), s.fractionBits);
}
integer nearestTexel(real u, int size, Sampling s) {
    if (s.position == 1) return wrapTexel(unitNearestTexel(u, size, 0), size, 0);
    return clampInteger(toInteger(floor(u * real(size))), integer(0), integer(size - 1));
}
// The same of any coordinate.
TexelPair texelsAroundWrapped(real u, int size, int wrap, Sampling s) {
    if (s.position == 1) return unitTexelPair(u, size, wrap);
    return texelsAround(foldCoordinate(u, wrap), size, s);
}
integer nearestTexelWrapped(real u, int size, int wrap, Sampling s) {
    if (s.position == 1) return wrapTexel(unitNearestTexel(u, size, wrap), size, wrap);
    return nearestTexel(foldCoordinate(u, wrap), size, s);
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

ImageTaps imageTaps(real u, real v, Sampling s) {
    TexelPair x = texelsAroundWrapped(u, s.width, s.wrapX, s);
    TexelPair y = texelsAroundWrapped(v, s.height, s.wrapY, s);
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
    if (s.filterMode == 0)
        return storedReal(fetchReal(t, layer, nearestTexelWrapped(u, s.width, s.wrapX, s),
                                    nearestTexelWrapped(v, s.height, s.wrapY, s)),
                          s);
    ImageTaps p = imageTaps(u, v, s);
    RealTaps taps = realTaps(fetchReal(t, layer, p.x0, p.y0), fetchReal(t, layer, p.x1, p.y0),
                             fetchReal(t, layer, p.x0, p.y1), fetchReal(t, layer, p.x1, p.y1), s);
    return filtered(taps, p.fractionX, p.fractionY, s);
}

vec3 sampleRgb(texture t, integer layer, real u, real v, Sampling s) {
    if (s.filterMode == 0)
        return storedRgb(fetchRgb(t, layer, nearestTexelWrapped(u, s.width, s.wrapX, s),
                                  nearestTexelWrapped(v, s.height, s.wrapY, s)),
                         s);
    ImageTaps p = imageTaps(u, v, s);
    RgbPair upper = fetchRgbPair(t, layer, p.x0, p.y0, layer, p.x1, p.y0);
    RgbPair lower = fetchRgbPair(t, layer, p.x0, p.y1, layer, p.x1, p.y1);
    return filteredRgb(rgbTaps(upper, lower, s), p.fractionX, p.fractionY, s);
}
