// Latitude-longitude images of the environment. Specified in probes/latlong.h.
// needs: numeric/kernels/wide.glsl
// needs: numeric/kernels/pair.glsl
// needs: numeric/kernels/pair_atan2.glsl
// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl

// u to the right and v downwards on the image, both in [0, 1].
struct LatLongCoordinates {
    real u;
    real v;
};

real longitudeOf(vec3 d) { return atan2Of(d.x, d.z); }
real latitudeOf(vec3 d) { return atan2Of(d.y, sqrt(d.x * d.x + d.z * d.z)); }
LatLongCoordinates coordinatesOfAngles(real longitude_rad, real latitude_rad) {
    LatLongCoordinates c;
    // 1 / (2 pi) and 1 / pi.
    c.u = clampOf(real(0.5) - longitude_rad * real(0.15915494309189535), real(0.0), real(1.0));
    c.v = clampOf(real(0.5) - latitude_rad * real(0.3183098861837907), real(0.0), real(1.0));
    return c;
}
LatLongCoordinates latLongCoordinates(vec3 d) { return coordinatesOfAngles(longitudeOf(d), latitudeOf(d)); }

// The four texels of a bilinear sample, upper and lower row, and the weights of the right and lower ones.
struct LatLongTaps {
    integer x00;
    integer x10;
    integer x01;
    integer x11;
    integer y0;
    integer y1;
    real fractionX;
    real fractionY;
};
LatLongTaps latLongTaps(real u, real v, Sampling s) {
    TexelPair x = texelsAround(u, s.width, s);
    TexelPair y = texelsAround(v, s.height, s);
    // Columns repeat.
    int repeats = 1;
    integer x0 = wrapTexel(x.first, s.width, repeats);
    integer x1 = wrapTexel(x.first + integer(1), s.width, repeats);
    // Beyond a pole lies the pole's row, half a turn further.
    int halfWidth = s.width / 2;
    integer halfTurn = integer(halfWidth);
    boolean beyondNorth = lessInteger(y.first, integer(0));
    boolean beyondSouth = !lessInteger(y.first + integer(1), integer(s.height));
    LatLongTaps taps;
    taps.y0 = clampInteger(y.first, integer(0), integer(s.height - 1));
    taps.y1 = clampInteger(y.first + integer(1), integer(0), integer(s.height - 1));
    integer north = selectInteger(beyondNorth, halfTurn, integer(0));
    integer south = selectInteger(beyondSouth, halfTurn, integer(0));
    taps.x00 = wrapTexel(x0 + north, s.width, repeats);
    taps.x10 = wrapTexel(x1 + north, s.width, repeats);
    taps.x01 = wrapTexel(x0 + south, s.width, repeats);
    taps.x11 = wrapTexel(x1 + south, s.width, repeats);
    taps.fractionX = x.fraction;
    taps.fractionY = y.fraction;
    return taps;
}

vec3 sampleLatLongAt(texture env, LatLongCoordinates c, Sampling s) {
    integer layer = integer(0);
    if (s.filterMode == 0)
        return storedRgb(fetchRgb(env, layer, nearestTexel(c.u, s.width, s), nearestTexel(c.v, s.height, s)), s);
    LatLongTaps taps = latLongTaps(c.u, c.v, s);
    RgbPair upper = fetchRgbPair(env, layer, taps.x00, taps.y0, layer, taps.x10, taps.y0);
    RgbPair lower = fetchRgbPair(env, layer, taps.x01, taps.y1, layer, taps.x11, taps.y1);
    return filteredRgb(rgbTaps(upper, lower, s), taps.fractionX, taps.fractionY, s);
}
vec3 sampleLatLong(texture env, vec3 direction, Sampling s) {
    return sampleLatLongAt(env, latLongCoordinates(direction), s);
}
