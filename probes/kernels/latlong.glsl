// Latitude-longitude images of the environment. Specified in probes/latlong.h.
// needs: numeric/kernels/wide.glsl
// needs: numeric/kernels/atan2.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl

// u to the right and v downwards on the image, both in [0, 1].
struct LatLongCoordinates {
    real u;
    real v;
};

LatLongCoordinates latLongCoordinates(vec3 d) {
    real longitude_rad = atan2Of(d.x, d.z);
    real latitude_rad = atan2Of(d.y, sqrt(d.x * d.x + d.z * d.z));
    LatLongCoordinates c;
    // 1 / (2 pi) and 1 / pi.
    c.u = clampOf(real(0.5) - longitude_rad * real(0.15915494309189535), real(0.0), real(1.0));
    c.v = clampOf(real(0.5) - latitude_rad * real(0.3183098861837907), real(0.0), real(1.0));
    return c;
}

vec3 sampleLatLong(texture env, vec3 direction, Sampling s) {
    LatLongCoordinates c = latLongCoordinates(direction);
    if (s.filterMode == 0)
        return fetchRgb(env, integer(0), nearestTexel(c.u, s.width), nearestTexel(c.v, s.height));
    TexelPair x = texelPair(c.u * real(s.width) - real(0.5), s.fractionBits);
    TexelPair y = texelPair(c.v * real(s.height) - real(0.5), s.fractionBits);
    // Columns repeat.
    int repeats = 1;
    integer x0 = wrapTexel(x.first, s.width, repeats);
    integer x1 = wrapTexel(x.first + integer(1), s.width, repeats);
    // Beyond a pole lies the pole's row, half a turn further.
    int halfWidth = s.width / 2;
    integer halfTurn = integer(halfWidth);
    boolean beyondNorth = lessInteger(y.first, integer(0));
    boolean beyondSouth = !lessInteger(y.first + integer(1), integer(s.height));
    integer y0 = clampInteger(y.first, integer(0), integer(s.height - 1));
    integer y1 = clampInteger(y.first + integer(1), integer(0), integer(s.height - 1));
    integer north = selectInteger(beyondNorth, halfTurn, integer(0));
    integer south = selectInteger(beyondSouth, halfTurn, integer(0));
    vec3 v00 = fetchRgb(env, integer(0), wrapTexel(x0 + north, s.width, repeats), y0);
    vec3 v10 = fetchRgb(env, integer(0), wrapTexel(x1 + north, s.width, repeats), y0);
    vec3 v01 = fetchRgb(env, integer(0), wrapTexel(x0 + south, s.width, repeats), y1);
    vec3 v11 = fetchRgb(env, integer(0), wrapTexel(x1 + south, s.width, repeats), y1);
    return bilinear3(v00, v10, v01, v11, x.fraction, y.fraction);
}
