// The part of a light that reaches a point of a plane, from the plane's shadow texture (shadows/planar_shadow.h).
// needs: numeric/kernels/vector.glsl
// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl

// The texture's place: its corner in world space, and the directions of its columns and rows divided by the size of a
// texel.
struct PlanarMap {
    vec3 corner;
    vec3 perColumn;
    vec3 perRow;
    Sampling sampling;
};

// The two texels around a position in texels, centres at whole numbers, inside the texture: as it is, or turned into a
// coordinate that the texture unit takes.
TexelPair planarTexels(real position, int size, Sampling s) {
    if (s.position == 0) return texelPair(position, s.fractionBits);
    return texelsAround((position + real(0.5)) / real(size), size, s);
}

// p: in world space; its distance from the plane has no influence. Beyond the texture its border goes on. Sizes need not
// be exact in the number type: the positions are in texels, and the indices are brought inside as integers.
real planarVisibility(texture t, vec3 p, PlanarMap m) {
    Sampling s = m.sampling;
    integer layer = integer(0);
    vec3 d = sub3(p, m.corner);
    real x = clampOf(dot3(d, m.perColumn) - real(0.5), real(0.0), real(s.width - 1));
    real y = clampOf(dot3(d, m.perRow) - real(0.5), real(0.0), real(s.height - 1));
    if (s.filterMode == 0) {
        integer column = wrapTexel(toInteger(floor(x + real(0.5))), s.width, 0);
        integer row = wrapTexel(toInteger(floor(y + real(0.5))), s.height, 0);
        return real(1.0) - storedReal(fetchReal(t, layer, column, row), s);
    }
    TexelPair inX = planarTexels(x, s.width, s);
    TexelPair inY = planarTexels(y, s.height, s);
    integer x0 = wrapTexel(inX.first, s.width, 0);
    integer x1 = wrapTexel(inX.first + integer(1), s.width, 0);
    integer y0 = wrapTexel(inY.first, s.height, 0);
    integer y1 = wrapTexel(inY.first + integer(1), s.height, 0);
    RealTaps taps = realTaps(fetchReal(t, layer, x0, y0), fetchReal(t, layer, x1, y0), fetchReal(t, layer, x0, y1),
                             fetchReal(t, layer, x1, y1), s);
    return real(1.0) - filtered(taps, inX.fraction, inY.fraction, s);
}

// The part that also passes one texture more. before: what passes those that were looked up so far, 1 at first; a light's
// textures of a receiver come in the order of its list.
real alsoPassing(real before, texture t, vec3 p, PlanarMap m) { return before * planarVisibility(t, p, m); }
