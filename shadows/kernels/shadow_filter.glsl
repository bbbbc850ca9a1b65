// What the texels around a point say about its light: filters of shadow maps. Specified in shadows/shadow_map.h.
// needs: numeric/kernels/vector.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl
// needs: raster/kernels/cube_face.glsl
// needs: shadows/kernels/shadow_point.glsl

// The depth that a texel at (du, dv) texels from the point is compared with, inside [0, farthest]; NaN gives 0. A
// texel below it is in the way.
real referenceDepth(real depth, real perU, real perV, real du, real dv, real farthest) {
    return clampOf((depth + perV * dv) + perU * du, real(0.0), farthest);
}

// A window of taps x taps points, one texel apart, around a position on one axis: the first of its taps + 1 texels, and
// the weight of the last one; the first has one minus that, those between have one.
TexelPair windowStart(real position, int taps, int fractionBits) {
    return texelPair(position - real(taps) * real(0.5), fractionBits);
}
// From the position to the centre of the window's first texel.
real firstCentre(real position, TexelPair start) { return (toReal(start.first) + real(0.5)) - position; }

// The mean of the bilinearly weighted comparisons, from the numbers of lit texels in the taps x taps windows that begin
// at the first texel, one to the right, one below, and both: compare first, weight after. Exactly 1 where all are lit.
real litPart(real lit00, real lit10, real lit01, real lit11, real fractionX, real fractionY, int taps) {
    return bilinear(lit00, lit10, lit01, lit11, fractionX, fractionY) / real(taps * taps);
}

// A point of the pattern, turned, in texels from the position.
vec2 turned(real x, real y, real cosine, real sine, real radius) {
    return vec2((x * cosine - y * sine) * radius, (x * sine + y * cosine) * radius);
}

// soft: the radius in texels of the part of the light that a depth sees past the near plane, and past blockers of mean
// depth `blocker`. The light's diameter over two, seen from the point through a pinhole in the blocker; 1 / distance is
// linear in the depth of a perspective map. perDepth: texels for a difference of 1.
real blurRadius(real depth, real blocker, real perDepth, real least, real most) {
    return clampOf((depth - blocker) * perDepth, least, most);
}
// The same where the texels are distances.
real blurRadiusOfDistance(real distance, real blocker, real perReciprocal, real least, real most) {
    boolean isFar = blocker > real(0.0);
    real reciprocal = real(1.0) / select(isFar, blocker, real(1.0)) - real(1.0) / maxOf(distance, blocker);
    return select(isFar, clampOf(reciprocal * perReciprocal, least, most), most);
}
