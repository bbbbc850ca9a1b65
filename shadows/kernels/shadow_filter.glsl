// What the texels around a point say about its light: one texel, or the windows of percentage-closer filtering.
// Specified in shadows/shadow_map.h.
// needs: numeric/kernels/vector.glsl
// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl
// needs: raster/kernels/cube_face.glsl
// needs: raster/kernels/depth_unorm.glsl
// needs: shadows/kernels/shadow_scope.glsl
// needs: shadows/kernels/shadow_point.glsl

// The constants of a filter. The flags are uniform: 1 or 0.
struct PointFilter {
    int kind;           // 0 hard, 1 pcf, 2 disc, 3 soft
    int taps;           // pcf: along an edge; disc, soft: in all
    Sampling sampling;  // of a layer; its position, fraction bits and weights are those of pcf
    int isQuantised;    // texels are stored integers, and depths turn into such before they are compared
    int holdsDistance;  // texels are distances
    real farthest;      // what a reference is limited to
    real levels;        // quantised: the largest stored integer
    real radius;        // disc; the largest of soft; in texels
    real leastRadius;   // soft: the smallest one behind blockers, in texels
    real blurScale;     // soft: see blurRadius and blurRadiusOfDistance
    real nearest;       // soft: the depth of the near plane
};

// The depth that a texel at (du, dv) texels from the point is compared with, inside [0, farthest]; NaN gives 0. A
// texel below it is in the way.
real referenceDepth(real depth, real perU, real perV, real du, real dv, real farthest) {
    return clampOf((depth + perV * dv) + perU * du, real(0.0), farthest);
}
boolean isInTheWay(PointFilter f, real texel, real reference) {
    if (f.isQuantised == 1) return isBelowStored(texel, reference);
    return texel < reference;
}

// A window of taps x taps points, one texel apart, around a position on one axis: the first of its taps + 1 texels, and
// the weight of the last one; the first has one minus that, those between have one.
// By the texture unit the first of the taps has position (taps - 1) / 2 texels before, as a coordinate.
TexelPair windowStart(real position, int taps, Sampling s) {
    if (s.position == 0) return texelPair(position - real(taps) * real(0.5), s.fractionBits);
    return unitTexelPair((position - real(taps - 1) * real(0.5)) / real(s.width), s.width, 3);
}
// From the position to the centre of the window's first texel.
real firstCentre(real position, TexelPair start) { return (toReal(start.first) + real(0.5)) - position; }

// hard: the texel that the point falls into, as a window of one point without fractions.
TexelPair texelOf(real position, Sampling s) {
    if (s.position == 0) return texelPair(position - real(0.5), 0);
    TexelPair pair;
    pair.first = unitNearestTexel(position / real(s.width), s.width, 3);
    pair.fraction = real(0.0);
    return pair;
}
real litOfTexel(PointFilter f, ShadowPoint p) {
    TexelPair x = texelOf(p.u, f.sampling);
    TexelPair y = texelOf(p.v, f.sampling);
    real reference =
        referenceDepth(p.depth, p.perU, p.perV, firstCentre(p.u, x), firstCentre(p.v, y), f.farthest);
    real texel = shadowTexel(p.layer, x.first, y.first);
    return select(isInTheWay(f, texel, reference), real(0.0), real(1.0));
}

// The numbers of lit texels in the taps x taps windows that begin at the first texel, one to the right, one below, and
// both.
struct LitTexels {
    integer at00;
    integer at10;
    integer at01;
    integer at11;
};
LitTexels litTexels(PointFilter f, ShadowPoint p, TexelPair x, TexelPair y) {
    real centreU = firstCentre(p.u, x);
    real centreV = firstCentre(p.v, y);
    LitTexels lit;
    lit.at00 = integer(0);
    lit.at10 = integer(0);
    lit.at01 = integer(0);
    lit.at11 = integer(0);
    for (int j = 0; j <= f.taps; j++) {
        real dv = centreV + real(j);
        for (int i = 0; i <= f.taps; i++) {
            real reference = referenceDepth(p.depth, p.perU, p.perV, centreU + real(i), dv, f.farthest);
            real texel = shadowTexel(p.layer, x.first + integer(i), y.first + integer(j));
            integer one = selectInteger(isInTheWay(f, texel, reference), integer(0), integer(1));
            if (i < f.taps && j < f.taps) lit.at00 = lit.at00 + one;
            if (i > 0 && j < f.taps) lit.at10 = lit.at10 + one;
            if (i < f.taps && j > 0) lit.at01 = lit.at01 + one;
            if (i > 0 && j > 0) lit.at11 = lit.at11 + one;
        }
    }
    return lit;
}

// The mean of the bilinearly weighted comparisons, from the numbers of litTexels: compare first, weight after. Exactly
// 1 where all are lit.
real litPart(real lit00, real lit10, real lit01, real lit11, real fractionX, real fractionY, int taps, Sampling s) {
    real lit = bilinear(lit00, lit10, lit01, lit11, fractionX, fractionY);
    // In the arithmetic, of numbers as they are.
    if (s.weights == 1) lit = unitFiltered(realTapsOf(lit00, lit10, lit01, lit11), fractionX, fractionY, 0, 0);
    return lit / real(taps * taps);
}

// pcf.
real litOfWindow(PointFilter f, ShadowPoint p) {
    TexelPair x = windowStart(p.u, f.taps, f.sampling);
    TexelPair y = windowStart(p.v, f.taps, f.sampling);
    LitTexels lit = litTexels(f, p, x, y);
    return litPart(toReal(lit.at00), toReal(lit.at10), toReal(lit.at01), toReal(lit.at11), x.fraction, y.fraction,
                   f.taps, f.sampling);
}
