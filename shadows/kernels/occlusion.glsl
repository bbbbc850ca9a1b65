// Ambient occlusion and bent normals: what a point sums over directions, and what becomes of the sums. Specified in
// shadows/ambient_occlusion.h.
// needs: numeric/kernels/vector.glsl
// needs: shadows/kernels/occlusion_scope.glsl

// The unit vector; `otherwise` for the zero vector and for what is no number.
vec3 unitOr3(vec3 v, vec3 otherwise) {
    real square = dot3(v, v);
    boolean isLong = square > real(0.0);
    real size = sqrt(select(isLong, square, real(1.0)));
    return vec3(select(isLong, v.x / size, otherwise.x), select(isLong, v.y / size, otherwise.y),
                select(isLong, v.z / size, otherwise.z));
}

// The direction through a position of a view, in pixels from the view's centre; the point there, this far from the eye.
vec3 rayFromCentre(vec3 forward, vec3 perX, vec3 perY, real x, real y) {
    return add3(add3(forward, scale3(perX, x)), scale3(perY, y));
}
vec3 seenPoint(vec3 eye, vec3 forward, vec3 perX, vec3 perY, real x, real y, real distance) {
    return add3(eye, scale3(unitOr3(rayFromCentre(forward, perX, perY, x, y), forward), distance));
}

// Weights of directions: of all, of the covered ones; and the open directions times theirs.
struct OcclusionSum {
    real total;
    real covered;
    vec3 open;
};

// Before the first direction. total: what the weights start from.
OcclusionSum noDirections(real total) {
    OcclusionSum none;
    none.total = total;
    none.covered = real(0.0);
    none.open = vec3(real(0.0), real(0.0), real(0.0));
    return none;
}

// weighted: the direction times its weight.
OcclusionSum addDirection(OcclusionSum sum, real weight, vec3 weighted, boolean isCovered) {
    OcclusionSum next;
    next.total = sum.total;
    next.covered = select(isCovered, sum.covered + weight, sum.covered);
    vec3 open = add3(sum.open, weighted);
    next.open = vec3(select(isCovered, sum.open.x, open.x), select(isCovered, sum.open.y, open.y),
                     select(isCovered, sum.open.z, open.z));
    return next;
}

real alongRow(vec4 row, vec3 p) { return row.x * p.x + (row.y * p.y + (row.z * p.z + row.w)); }

// The sum with the direction of a view more, weighted by its cosine. normal: unit.
OcclusionSum addParallelView(OcclusionSum sum, vec3 position, vec3 normal, int view) {
    ParallelView m = parallelView(view);
    real weight = dot3(normal, m.towards);
    boolean isTowards = weight > real(0.0);
    if (!isAny(isTowards)) return sum;
    vec3 p = add3(position, scale3(normal, m.offset));
    real size = real(m.size);
    real halfSize = size * real(0.5);
    real x = (alongRow(m.rowX, p) + real(1.0)) * halfSize;
    real y = (real(1.0) - alongRow(m.rowY, p)) * halfSize;
    boolean isInside = x >= real(0.0) && x < size && y >= real(0.0) && y < size;
    integer column = toInteger(clampOf(x, real(0.0), real(m.size - 1)));
    integer row = toInteger(clampOf(y, real(0.0), real(m.size - 1)));
    boolean isCovered =
        isInside && isDrawn(view, column, row) && drawnDepth(view, column, row) < alongRow(m.rowZ, p);
    OcclusionSum next = addDirection(sum, weight, scale3(m.towards, weight), isCovered);
    next.total = select(isTowards, sum.total + weight, sum.total);
    next.covered = select(isTowards, next.covered, sum.covered);
    next.open = vec3(select(isTowards, next.open.x, sum.open.x), select(isTowards, next.open.y, sum.open.y),
                     select(isTowards, next.open.z, sum.open.z));
    return next;
}

// The same with the views first .. last - 1, in their order. A point's sum over n views is that of the views 0 .. n - 1
// from noDirections(0) on; any cut of them into ranges gives the same bits.
OcclusionSum addParallelViews(OcclusionSum sum, vec3 position, vec3 normal, int first, int last) {
    OcclusionSum all = sum;
    for (int view = first; view < last; view++) all = addParallelView(all, position, normal, view);
    return all;
}

// The sum with the directions of all texels of a face, weighted by their form factors.
OcclusionSum addHemicubeFace(OcclusionSum sum, int view) {
    HemicubeFace h = hemicubeFace(view);
    OcclusionSum all = sum;
    for (int y = 0; y < h.height; y++)
        for (int x = 0; x < h.width; x++) {
            real weight = texelWeight(view, y * h.width + x);
            vec3 ray = rayFromCentre(h.forward, h.perX, h.perY, (real(x) + real(0.5)) - h.centreX,
                                     (real(y) + real(0.5)) - h.centreY);
            real size = length3(ray);
            boolean isCovered = isDrawn(view, integer(x), integer(y));
            if (h.isLimited == 1)
                isCovered =
                    isCovered && drawnDepth(view, integer(x), integer(y)) < real(1.0) - real(0.0009765625) * size;
            all = addDirection(all, weight, scale3(ray, weight / size), isCovered);
        }
    return all;
}

// The same with the faces first .. last - 1. A point's sum is that of all faces from noDirections(1) on, as the form factors
// of all their texels add up to 1; any cut of them into ranges gives the same bits.
OcclusionSum addHemicubeFaces(OcclusionSum sum, int first, int last) {
    OcclusionSum all = sum;
    for (int view = first; view < last; view++) all = addHemicubeFace(all, view);
    return all;
}

// What a point sees of its surroundings. Exactly 1 and the normal where nothing is covered; of a point without a normal
// (0, 0, 0) exactly 1 and none.
struct OpenPart {
    real open;
    vec3 bentNormal;
};
OpenPart openPart(OcclusionSum sum, vec3 normal) {
    boolean isOpen = sum.covered == real(0.0);
    real part = maxOf(real(0.0), real(1.0) - sum.covered / select(isOpen, real(1.0), sum.total));
    vec3 bent = unitOr3(sum.open, normal);
    OpenPart result;
    boolean hasNormal = normal.x != real(0.0) || normal.y != real(0.0) || normal.z != real(0.0);
    result.open = select(isOpen || !hasNormal, real(1.0), part);
    vec3 seen = vec3(select(isOpen, normal.x, bent.x), select(isOpen, normal.y, bent.y),
                     select(isOpen, normal.z, bent.z));
    result.bentNormal = vec3(select(hasNormal, seen.x, real(0.0)), select(hasNormal, seen.y, real(0.0)),
                             select(hasNormal, seen.z, real(0.0)));
    return result;
}
