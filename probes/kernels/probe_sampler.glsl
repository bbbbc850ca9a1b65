// Samples of a probe's images. Specified in probes/convert.h.
// needs: numeric/kernels/wide.glsl
// needs: numeric/kernels/pair.glsl
// needs: numeric/kernels/pair_atan2.glsl
// needs: numeric/kernels/pair_sine.glsl
// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl
// needs: raster/kernels/cube_face.glsl
// needs: probes/kernels/latlong.glsl
// needs: probes/kernels/mapping.glsl

// The texel next to an octahedral image's own texels; its borders fold onto themselves.
CubeTexel octahedralTexel(integer x, integer y, int size) {
    integer last = integer(size - 1);
    boolean isOutsideX = lessInteger(x, integer(0)) || lessInteger(last, x);
    integer yIn = selectInteger(isOutsideX, last - y, y);
    boolean isOutsideY = lessInteger(yIn, integer(0)) || lessInteger(last, yIn);
    integer xIn = clampInteger(x, integer(0), last);
    return cubeTexel(integer(0), selectInteger(isOutsideY, last - xIn, xIn), clampInteger(yIn, integer(0), last));
}

// The four texels around a point of an image of any mapping.
CubeTaps probeTaps(MappingPoint p, int mapping, Sampling s) {
    if (mapping == 1) {
        CubeCoordinates c;
        c.face = p.layer;
        c.s = p.u;
        c.t = p.v;
        return cubeTaps(c, s);
    }
    CubeTaps taps;
    boolean no = boolean(false);
    taps.corner00 = no;
    taps.corner10 = no;
    taps.corner01 = no;
    taps.corner11 = no;
    if (mapping == 0 || mapping == 5) {
        LatLongTaps t = latLongTaps(p.u, p.v, s);
        taps.t00 = cubeTexel(p.layer, t.x00, t.y0);
        taps.t10 = cubeTexel(p.layer, t.x10, t.y0);
        taps.t01 = cubeTexel(p.layer, t.x01, t.y1);
        taps.t11 = cubeTexel(p.layer, t.x11, t.y1);
        taps.fractionX = t.fractionX;
        taps.fractionY = t.fractionY;
        return taps;
    }
    TexelPair x = texelsAround(p.u, s.width, s);
    TexelPair y = texelsAround(p.v, s.width, s);
    integer x1 = x.first + integer(1);
    integer y1 = y.first + integer(1);
    taps.fractionX = x.fraction;
    taps.fractionY = y.fraction;
    if (mapping == 4) {
        taps.t00 = octahedralTexel(x.first, y.first, s.width);
        taps.t10 = octahedralTexel(x1, y.first, s.width);
        taps.t01 = octahedralTexel(x.first, y1, s.width);
        taps.t11 = octahedralTexel(x1, y1, s.width);
        return taps;
    }
    integer first = integer(0);
    integer last = integer(s.width - 1);
    integer left = clampInteger(x.first, first, last);
    integer right = clampInteger(x1, first, last);
    integer upper = clampInteger(y.first, first, last);
    integer lower = clampInteger(y1, first, last);
    taps.t00 = cubeTexel(p.layer, left, upper);
    taps.t10 = cubeTexel(p.layer, right, upper);
    taps.t01 = cubeTexel(p.layer, left, lower);
    taps.t11 = cubeTexel(p.layer, right, lower);
    return taps;
}

// Radiance and whether there is any.
struct ProbeSample {
    vec3 rgb;
    boolean isShown;
};

// From a towards b as lerpInside3; the only one that is shown, if one is.
ProbeSample lerpShown(ProbeSample a, ProbeSample b, real fraction) {
    ProbeSample r;
    r.rgb = select3(a.isShown, select3(b.isShown, lerpInside3(a.rgb, b.rgb, fraction), a.rgb), b.rgb);
    r.isShown = a.isShown || b.isShown;
    return r;
}
ProbeSample probeSample(vec3 rgb, boolean isShown) {
    ProbeSample r;
    r.rgb = rgb;
    r.isShown = isShown;
    return r;
}
ProbeSample shownOr(ProbeSample a, ProbeSample b) {
    return probeSample(select3(a.isShown, a.rgb, b.rgb), a.isShown || b.isShown);
}
boolean isShownTexel(texture shown, CubeTexel t) { return fetchReal(shown, t.face, t.x, t.y) > real(0.5); }

// The texel that holds a point.
CubeTexel nearestProbeTexel(MappingPoint p, Sampling s) {
    return cubeTexel(p.layer, nearestTexel(p.u, s.width, s), nearestTexel(p.v, s.height, s));
}

// A tap of a bilinear sample. The missing texel at the corner of a cube is the mean of the three others a, b and c, if
// all of them are shown.
ProbeSample cornerSample(boolean isCorner, ProbeSample v, ProbeSample a, ProbeSample b, ProbeSample c) {
    boolean all = a.isShown && b.isShown && c.isShown;
    return probeSample(select3(isCorner, meanOfThree3(a.rgb, b.rgb, c.rgb), v.rgb),
                       (isCorner && all) || (!isCorner && v.isShown));
}

// `shown` has 1 for texels with radiance and 0 for the others.
ProbeSample tapSample(texture radiance, texture shown, CubeTexel t, Sampling s) {
    return probeSample(storedRgb(fetchRgb(radiance, t.face, t.x, t.y), s), isShownTexel(shown, t));
}
// Two taps; one that is not shown has become the other.
struct ProbePair {
    ProbeSample a;
    ProbeSample b;
};
ProbePair filledPair(ProbeSample a, ProbeSample b) {
    ProbePair pair;
    pair.a = shownOr(a, b);
    pair.b = shownOr(b, a);
    return pair;
}
// Four taps by the rules of s: with 1-D weights one after the other, else with hidden taps replaced by their neighbours in
// the row, and a hidden row by the other one.
ProbeSample filterShown(ProbeSample v00, ProbeSample v10, ProbeSample v01, ProbeSample v11, real fractionX,
                        real fractionY, Sampling s) {
    if (s.weights == 0)
        return lerpShown(lerpShown(v00, v10, fractionX), lerpShown(v01, v11, fractionX), fractionY);
    ProbePair upper = filledPair(v00, v10);
    ProbePair lower = filledPair(v01, v11);
    ProbePair left = filledPair(upper.a, lower.a);
    ProbePair right = filledPair(upper.b, lower.b);
    RgbTaps taps;
    taps.v00 = left.a.rgb;
    taps.v10 = right.a.rgb;
    taps.v01 = left.b.rgb;
    taps.v11 = right.b.rgb;
    return probeSample(filteredRgb(taps, fractionX, fractionY, s), left.a.isShown);
}
ProbeSample sampleMasked(texture radiance, texture shown, MappingPoint p, int mapping, Sampling s) {
    ProbeSample r;
    if (s.filterMode == 0) {
        r = tapSample(radiance, shown, nearestProbeTexel(p, s), s);
    } else {
        CubeTaps taps = probeTaps(p, mapping, s);
        ProbeSample v00 = tapSample(radiance, shown, taps.t00, s);
        ProbeSample v10 = tapSample(radiance, shown, taps.t10, s);
        ProbeSample v01 = tapSample(radiance, shown, taps.t01, s);
        ProbeSample v11 = tapSample(radiance, shown, taps.t11, s);
        ProbeSample c00 = cornerSample(taps.corner00, v00, v10, v01, v11);
        ProbeSample c10 = cornerSample(taps.corner10, v10, v00, v01, v11);
        ProbeSample c01 = cornerSample(taps.corner01, v01, v00, v10, v11);
        ProbeSample c11 = cornerSample(taps.corner11, v11, v00, v10, v01);
        r = filterShown(c00, c10, c01, c11, taps.fractionX, taps.fractionY, s);
    }
    r.isShown = r.isShown && p.isShown;
    return r;
}

// Of a source all of whose texels around p are shown.
vec3 sampleWhole(texture radiance, MappingPoint p, int mapping, Sampling s) {
    if (s.filterMode == 0) {
        CubeTexel t = nearestProbeTexel(p, s);
        return storedRgb(fetchRgb(radiance, t.face, t.x, t.y), s);
    }
    if (mapping == 1) {
        CubeCoordinates c;
        c.face = p.layer;
        c.s = p.u;
        c.t = p.v;
        return sampleCubeRgbAt(radiance, c, s);
    }
    CubeTaps t = probeTaps(p, mapping, s);
    RgbPair upper = fetchRgbPair(radiance, t.t00.face, t.t00.x, t.t00.y, t.t10.face, t.t10.x, t.t10.y);
    RgbPair lower = fetchRgbPair(radiance, t.t01.face, t.t01.x, t.t01.y, t.t11.face, t.t11.x, t.t11.y);
    return filteredRgb(rgbTaps(upper, lower, s), t.fractionX, t.fractionY, s);
}

// What a source of a mapping is sampled with. Within the radius `whole` of a disc all texels of a bilinear sample are
// shown; below 0: no such disc. isMasked: 0 if every texel of the source is shown.
struct ProbeSampling {
    MappingSettings source;
    Sampling sampling;
    int isMasked;
    real whole;
};
ProbeSample sampleProbe(texture radiance, texture shown, MappingPoint p, ProbeSampling s) {
    if (s.isMasked != 0) {
        real x = real(2.0) * p.u - real(1.0);
        real y = real(2.0) * p.v - real(1.0);
        boolean isWhole = s.whole > real(0.0) && x * x + y * y < s.whole * s.whole;
        if (isAny(!isWhole)) return sampleMasked(radiance, shown, p, s.source.mapping, s.sampling);
    }
    return probeSample(sampleWhole(radiance, p, s.source.mapping, s.sampling), p.isShown);
}

// A weighted mean of samples that grows one by one; those that are not shown are left out.
struct ProbeMean {
    vec3 rgb;
    real weight;
};
ProbeMean noSamples() {
    ProbeMean m;
    m.rgb = vec3(real(0.0), real(0.0), real(0.0));
    m.weight = real(0.0);
    return m;
}
real meanStep(real mean, real value, real share) { return mean + (value - mean) * share; }
ProbeMean addSample(ProbeMean m, ProbeSample value, real w) {
    boolean isFirst = !(m.weight > real(0.0));
    boolean counts = value.isShown && w > real(0.0);
    real weight = m.weight + w;
    real share = w / select(weight > real(0.0), weight, real(1.0));
    vec3 next = vec3(meanStep(m.rgb.x, value.rgb.x, share), meanStep(m.rgb.y, value.rgb.y, share),
                     meanStep(m.rgb.z, value.rgb.z, share));
    m.rgb = select3(counts, select3(isFirst, value.rgb, next), m.rgb);
    m.weight = select(counts, weight, m.weight);
    return m;
}

// The direction in the source's frame, where the rows of the matrix are its axes in the frame of the result.
vec3 turned(vec3 d, vec3 rowX, vec3 rowY, vec3 rowZ) {
    return vec3(d.x * rowX.x + (d.y * rowX.y + d.z * rowX.z), d.x * rowY.x + (d.y * rowY.y + d.z * rowY.z),
                d.x * rowZ.x + (d.y * rowZ.y + d.z * rowZ.z));
}

real asNumber(boolean c) { return select(c, real(1.0), real(0.0)); }
// Black and not shown where it is not shown or isOnImage is 0.
ProbeSample blackIfHidden(ProbeSample a, real isOnImage) {
    boolean isShown = a.isShown && isOnImage > real(0.5);
    return probeSample(select3(isShown, a.rgb, vec3(real(0.0), real(0.0), real(0.0))), isShown);
}
// The distance of the nearest texel; 0 where it or the radiance is not shown.
real nearestDistance(texture distances, texture shown, MappingPoint p, ProbeSampling s, Sampling nearest,
                     boolean isShown) {
    CubeTexel t = nearestProbeTexel(p, nearest);
    boolean counts = isShown && p.isShown;
    if (s.isMasked != 0) counts = counts && isShownTexel(shown, t);
    return select(counts, fetchReal(distances, t.face, t.x, t.y), real(0.0));
}
