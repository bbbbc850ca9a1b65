// The part of a light that reaches a point of a plane, from the plane's shadow texture (shadows/planar_shadow.h).
// needs: numeric/kernels/vector.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl

// The texture's place: its corner in world space, and the directions of its columns and rows divided by the size of a
// texel. filterMode and fractionBits as in Sampling.
struct PlanarMap {
    vec3 corner;
    vec3 perColumn;
    vec3 perRow;
    int width;
    int height;
    int filterMode;
    int fractionBits;
};

// p: in world space; its distance from the plane has no influence. Beyond the texture its border goes on. Sizes need not
// be exact in the number type: the positions are in texels, and the indices are brought inside as integers.
real planarVisibility(texture t, vec3 p, PlanarMap m) {
    vec3 d = sub3(p, m.corner);
    real x = clampOf(dot3(d, m.perColumn) - real(0.5), real(0.0), real(m.width - 1));
    real y = clampOf(dot3(d, m.perRow) - real(0.5), real(0.0), real(m.height - 1));
    if (m.filterMode == 0) {
        integer column = wrapTexel(toInteger(floor(x + real(0.5))), m.width, 0);
        integer row = wrapTexel(toInteger(floor(y + real(0.5))), m.height, 0);
        return real(1.0) - fetchReal(t, integer(0), column, row);
    }
    TexelPair inX = texelPair(x, m.fractionBits);
    TexelPair inY = texelPair(y, m.fractionBits);
    integer x0 = wrapTexel(inX.first, m.width, 0);
    integer x1 = wrapTexel(inX.first + integer(1), m.width, 0);
    integer y0 = wrapTexel(inY.first, m.height, 0);
    integer y1 = wrapTexel(inY.first + integer(1), m.height, 0);
    real shadow = bilinear(fetchReal(t, integer(0), x0, y0), fetchReal(t, integer(0), x1, y0),
                           fetchReal(t, integer(0), x0, y1), fetchReal(t, integer(0), x1, y1), inX.fraction,
                           inY.fraction);
    return real(1.0) - shadow;
}

// The part that also passes one texture more. before: what passes those that were looked up so far, 1 at first; a light's
// textures of a receiver come in the order of its list.
real alsoPassing(real before, texture t, vec3 p, PlanarMap m) { return before * planarVisibility(t, p, m); }
