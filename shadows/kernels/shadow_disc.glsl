// Filters of shadow maps over a disc: of one radius, and of the radius that blockers and the light's size make.
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
// needs: shadows/kernels/shadow_filter.glsl

// A point of the pattern, turned, in texels from the position.
vec2 turned(real x, real y, real cosine, real sine, real radius) {
    return vec2((x * cosine - y * sine) * radius, (x * sine + y * cosine) * radius);
}

// The texel below a point of the pattern: its depth, and whether it is in the way.
struct PatternTexel {
    real depth;
    boolean isBlocker;
};
PatternTexel patternTexel(PointFilter f, ShadowPoint p, vec2 turn, int k, real radius) {
    vec2 unturned = patternPoint(k);
    vec2 shift = turned(unturned.x, unturned.y, turn.x, turn.y, radius);
    real x = floor(p.u + shift.x);
    real y = floor(p.v + shift.y);
    real reference = referenceDepth(p.depth, p.perU, p.perV, (x + real(0.5)) - p.u, (y + real(0.5)) - p.v, f.farthest);
    PatternTexel t;
    t.depth = shadowTexel(p.layer, toInteger(x), toInteger(y));
    t.isBlocker = isInTheWay(f, t.depth, reference);
    if (f.isQuantised == 1) t.depth = t.depth / f.levels;
    return t;
}

// disc. turn: cosine and sine.
real litOfDisc(PointFilter f, ShadowPoint p, vec2 turn, real radius) {
    real lit = real(0.0);
    for (int k = 0; k < f.taps; k++)
        lit = lit + select(patternTexel(f, p, turn, k, radius).isBlocker, real(0.0), real(1.0));
    return lit / real(f.taps);
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
real blurRadiusPast(PointFilter f, real depth, real blocker, real least) {
    if (f.holdsDistance == 1) return blurRadiusOfDistance(depth, blocker, f.blurScale, least, f.radius);
    return blurRadius(depth, blocker, f.blurScale, least, f.radius);
}

// soft: the mean depth of what blocks within all that the light can be seen through, then a disc of the radius that
// belongs to it. Exactly 1 where nothing blocks.
real litOfSoft(PointFilter f, ShadowPoint p, vec2 turn) {
    real searched = blurRadiusPast(f, p.depth, f.nearest, real(0.0));
    real sum = real(0.0);
    real blockers = real(0.0);
    for (int k = 0; k < f.taps; k++) {
        PatternTexel t = patternTexel(f, p, turn, k, searched);
        sum = sum + select(t.isBlocker, t.depth, real(0.0));
        blockers = blockers + select(t.isBlocker, real(1.0), real(0.0));
    }
    boolean isBlocked = blockers > real(0.0);
    if (!isAny(isBlocked)) return real(1.0);
    real mean = sum / select(isBlocked, blockers, real(1.0));
    real lit = litOfDisc(f, p, turn, blurRadiusPast(f, p.depth, mean, f.leastRadius));
    return select(isBlocked, lit, real(1.0));
}
