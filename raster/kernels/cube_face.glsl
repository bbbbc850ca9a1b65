// Cube-map faces: direction to face and back, and seamless sampling. Specified in raster/cube_face.h.
// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl

// Face 0..5 (+X -X +Y -Y +Z -Z); s to the right and t downwards on the face, both in [0, 1].
struct CubeCoordinates {
    integer face;
    real s;
    real t;
};
struct CubeTexel {
    integer face;
    integer x;
    integer y;
};

// q inside [-1, 1]; 0 for NaN.
real faceRatio(real q) {
    real low = select(q >= real(-1.0), minOf(q, real(1.0)), real(-1.0));
    return select(q == q, low, real(0.0));
}

// Ties of the major axis go to Z, then Y, then X.
CubeCoordinates cubeCoordinates(vec3 d) {
    real ax = absOf(d.x);
    real ay = absOf(d.y);
    real az = absOf(d.z);
    boolean isZ = az >= ax && az >= ay;
    boolean isY = !isZ && ay >= ax;
    real major = select(isZ, d.z, select(isY, d.y, d.x));
    boolean isNegative = major < real(0.0);
    // The face table: s = sc / |major|, t = tc / |major|.
    real sc = select(isZ, select(isNegative, -d.x, d.x), select(isY, d.x, select(isNegative, d.z, -d.z)));
    real tc = select(isY, select(isNegative, -d.z, d.z), -d.y);
    real size = absOf(major);
    CubeCoordinates c;
    c.face = selectInteger(isZ, integer(4), selectInteger(isY, integer(2), integer(0))) +
             selectInteger(isNegative, integer(1), integer(0));
    c.s = (faceRatio(sc / size) + real(1.0)) * real(0.5);
    c.t = (faceRatio(tc / size) + real(1.0)) * real(0.5);
    return c;
}

// The direction of face coordinates s, t; its major component is 1 or -1, it is not of length one.
vec3 cubeDirection(integer face, real s, real t) {
    real a = real(2.0) * s - real(1.0);
    real b = real(2.0) * t - real(1.0);
    real f = toReal(face);
    boolean isX = f < real(2.0);
    boolean isY = !isX && f < real(4.0);
    boolean isNegative = f == real(1.0) || f == real(3.0) || f == real(5.0);
    real major = select(isNegative, real(-1.0), real(1.0));
    return vec3(select(isX, major, select(isY, a, select(isNegative, -a, a))), select(isY, major, -b),
                select(isX, select(isNegative, a, -a), select(isY, select(isNegative, -b, b), major)));
}

// The texel next to the face's own texels [0, size - 1]^2, on the face where it lies. x or y may be -1 or
// size; where both are outside (there is no such texel) y is clamped first.
CubeTexel wrapCubeTexel(integer face, integer x, integer y, int size) {
    integer n = integer(size);
    boolean isOutsideX = lessInteger(x, integer(0)) || !lessInteger(x, n);
    integer xIn = clampInteger(x, integer(-1), n);
    integer yIn = selectInteger(isOutsideX, clampInteger(y, integer(0), integer(size - 1)),
                                clampInteger(y, integer(-1), n));
    boolean isOutside = isOutsideX || lessInteger(yIn, integer(0)) || !lessInteger(yIn, n);
    // The cube with edges of 2n: texel centres at whole numbers from -(n - 1) to n - 1 in steps of 2, faces at
    // +-n. A texel behind an edge sits at +-(n + 1) in the face's plane; folded over the edge it has +-n there,
    // and n - 1 along the old face's axis.
    integer a = clampInteger(integer(2) * xIn + integer(1) - n, integer(-size), n);
    integer b = clampInteger(integer(2) * yIn + integer(1) - n, integer(-size), n);
    integer m = selectInteger(isOutside, integer(size - 1), n);
    boolean isX = lessInteger(face, integer(2));
    boolean isY = !isX && lessInteger(face, integer(4));
    boolean isNegative =
        equalInteger(face, integer(1)) || equalInteger(face, integer(3)) || equalInteger(face, integer(5));
    integer major = selectInteger(isNegative, -m, m);
    integer px = selectInteger(isX, major, selectInteger(isY, a, selectInteger(isNegative, -a, a)));
    integer py = selectInteger(isY, major, -b);
    integer pz = selectInteger(isX, selectInteger(isNegative, a, -a),
                               selectInteger(isY, selectInteger(isNegative, -b, b), major));
    // The face is where a component is +-n; no other component is.
    boolean onPlusX = equalInteger(px, n);
    boolean onMinusX = equalInteger(px, -n);
    boolean onPlusY = equalInteger(py, n);
    boolean onMinusY = equalInteger(py, -n);
    boolean onMinusZ = equalInteger(pz, -n);
    boolean onX = onPlusX || onMinusX;
    boolean onY = onPlusY || onMinusY;
    integer sc = selectInteger(onX, selectInteger(onMinusX, pz, -pz),
                               selectInteger(onY, px, selectInteger(onMinusZ, -px, px)));
    integer tc = selectInteger(onY, selectInteger(onMinusY, -pz, pz), -py);
    CubeTexel w;
    w.face = selectInteger(onX, selectInteger(onMinusX, integer(1), integer(0)),
                           selectInteger(onY, selectInteger(onMinusY, integer(3), integer(2)),
                                         selectInteger(onMinusZ, integer(5), integer(4))));
    w.x = (sc + integer(size - 1)) / integer(2);
    w.y = (tc + integer(size - 1)) / integer(2);
    return w;
}

// (a + (b + c)) / 3 inside the hull of the three, so that equal values give exactly that value.
real meanOfThree(real a, real b, real c) {
    real mean = (a + (b + c)) / real(3.0);
    real lo = minOf(a, minOf(b, c));
    real hi = maxOf(a, maxOf(b, c));
    mean = select(mean < lo, lo, mean);
    return select(hi < mean, hi, mean);
}
vec3 meanOfThree3(vec3 a, vec3 b, vec3 c) {
    return vec3(meanOfThree(a.x, b.x, c.x), meanOfThree(a.y, b.y, c.y), meanOfThree(a.z, b.z, c.z));
}
vec3 select3(boolean c, vec3 a, vec3 b) {
    return vec3(select(c, a.x, b.x), select(c, a.y, b.y), select(c, a.z, b.z));
}

// Where a direction falls: the four texels around it, whether one of them is a missing corner, the fractions.
struct CubeTaps {
    CubeTexel t00;
    CubeTexel t10;
    CubeTexel t01;
    CubeTexel t11;
    boolean corner00;
    boolean corner10;
    boolean corner01;
    boolean corner11;
    real fractionX;
    real fractionY;
};
CubeTexel cubeTexel(integer face, integer x, integer y) {
    CubeTexel t;
    t.face = face;
    t.x = x;
    t.y = y;
    return t;
}
CubeTaps cubeTaps(CubeCoordinates c, Sampling s) {
    int size = s.width;
    TexelPair x = texelsAround(c.s, size, s);
    TexelPair y = texelsAround(c.t, size, s);
    integer x1 = x.first + integer(1);
    integer y1 = y.first + integer(1);
    boolean leftOut = lessInteger(x.first, integer(0));
    boolean rightOut = !lessInteger(x1, integer(size));
    boolean upperOut = lessInteger(y.first, integer(0));
    boolean lowerOut = !lessInteger(y1, integer(size));
    CubeTaps taps;
    taps.fractionX = x.fraction;
    taps.fractionY = y.fraction;
    if (!isAny(leftOut || rightOut || upperOut || lowerOut)) {
        taps.t00 = cubeTexel(c.face, x.first, y.first);
        taps.t10 = cubeTexel(c.face, x1, y.first);
        taps.t01 = cubeTexel(c.face, x.first, y1);
        taps.t11 = cubeTexel(c.face, x1, y1);
        taps.corner00 = leftOut;
        taps.corner10 = leftOut;
        taps.corner01 = leftOut;
        taps.corner11 = leftOut;
        return taps;
    }
    taps.t00 = wrapCubeTexel(c.face, x.first, y.first, size);
    taps.t10 = wrapCubeTexel(c.face, x1, y.first, size);
    taps.t01 = wrapCubeTexel(c.face, x.first, y1, size);
    taps.t11 = wrapCubeTexel(c.face, x1, y1, size);
    taps.corner00 = leftOut && upperOut;
    taps.corner10 = rightOut && upperOut;
    taps.corner01 = leftOut && lowerOut;
    taps.corner11 = rightOut && lowerOut;
    return taps;
}

real sampleCubeReal(texture cube, vec3 direction, Sampling s) {
    CubeCoordinates at = cubeCoordinates(direction);
    if (s.filterMode == 0)
        return storedReal(fetchReal(cube, at.face, nearestTexel(at.s, s.width, s), nearestTexel(at.t, s.width, s)), s);
    CubeTaps taps = cubeTaps(at, s);
    RealTaps v = realTaps(fetchReal(cube, taps.t00.face, taps.t00.x, taps.t00.y),
                          fetchReal(cube, taps.t10.face, taps.t10.x, taps.t10.y),
                          fetchReal(cube, taps.t01.face, taps.t01.x, taps.t01.y),
                          fetchReal(cube, taps.t11.face, taps.t11.x, taps.t11.y), s);
    RealTaps c;
    c.v00 = select(taps.corner00, meanOfThree(v.v10, v.v01, v.v11), v.v00);
    c.v10 = select(taps.corner10, meanOfThree(v.v00, v.v01, v.v11), v.v10);
    c.v01 = select(taps.corner01, meanOfThree(v.v00, v.v10, v.v11), v.v01);
    c.v11 = select(taps.corner11, meanOfThree(v.v00, v.v10, v.v01), v.v11);
    return filtered(c, taps.fractionX, taps.fractionY, s);
}

// At face coordinates.
vec3 sampleCubeRgbAt(texture cube, CubeCoordinates c, Sampling s) {
    if (s.filterMode == 0)
        return storedRgb(fetchRgb(cube, c.face, nearestTexel(c.s, s.width, s), nearestTexel(c.t, s.width, s)), s);
    CubeTaps taps = cubeTaps(c, s);
    RgbPair upper = fetchRgbPair(cube, taps.t00.face, taps.t00.x, taps.t00.y, taps.t10.face, taps.t10.x, taps.t10.y);
    RgbPair lower = fetchRgbPair(cube, taps.t01.face, taps.t01.x, taps.t01.y, taps.t11.face, taps.t11.x, taps.t11.y);
    RgbTaps v = rgbTaps(upper, lower, s);
    if (isAny(taps.corner00 || taps.corner10 || taps.corner01 || taps.corner11)) {
        RgbTaps filled;
        filled.v00 = select3(taps.corner00, meanOfThree3(v.v10, v.v01, v.v11), v.v00);
        filled.v10 = select3(taps.corner10, meanOfThree3(v.v00, v.v01, v.v11), v.v10);
        filled.v01 = select3(taps.corner01, meanOfThree3(v.v00, v.v10, v.v11), v.v01);
        filled.v11 = select3(taps.corner11, meanOfThree3(v.v00, v.v10, v.v01), v.v11);
        v = filled;
    }
    return filteredRgb(v, taps.fractionX, taps.fractionY, s);
}
vec3 sampleCubeRgb(texture cube, vec3 direction, Sampling s) {
    return sampleCubeRgbAt(cube, cubeCoordinates(direction), s);
}
