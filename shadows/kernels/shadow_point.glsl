// From a point of a surface to the texels of a shadow map. Specified in shadows/shadow_map.h.
// needs: numeric/kernels/vector.glsl
// needs: raster/kernels/texture_unit.glsl
// needs: raster/kernels/tap_weights.glsl
// needs: raster/kernels/texture_scope.glsl
// needs: raster/kernels/sampler.glsl
// needs: raster/kernels/cube_face.glsl

// The constants of a map. The flags are uniform: 1 or 0.
struct ShadowSpace {
    int isPerspective;
    int isCube;
    int holdsDistance;
    int receiverPlane;
    int movesAlongNormal;
    vec3 origin;
    vec3 right;
    vec3 down;
    vec3 forward;
    real centreU;
    real centreV;
    real scale;
    real depthScale;
    real depthOffset;
    real bias;          // subtracted from the depth
    real nearer;        // factor of distances
    real slopeBias;     // of distances: texels whose change of depth is subtracted
    real normalOffset;  // texels
    real width;         // of a layer, with its border
    real reach;         // so far outside the layer a position may be, in texels
};

// Where a point falls: the layer, the position in texels, the depth, and how the depth of the point's plane changes
// from texel to texel.
struct ShadowPoint {
    integer layer;
    real u;
    real v;
    real depth;
    real perU;
    real perV;
    boolean isInFront;  // of the light; else nothing is compared
};

// The components of a vector in the frame of a cube face: along s, along t, along the axis.
vec3 inFaceFrame(integer face, vec3 d) {
    real f = toReal(face);
    boolean isX = f < real(2.0);
    boolean isY = !isX && f < real(4.0);
    boolean isNegative = f == real(1.0) || f == real(3.0) || f == real(5.0);
    real major = select(isX, d.x, select(isY, d.y, d.z));
    return vec3(select(isX, select(isNegative, d.z, -d.z), select(isY, d.x, select(isNegative, -d.x, d.x))),
                select(isY, select(isNegative, -d.z, d.z), -d.y), select(isNegative, -major, major));
}
vec3 inLayerFrame(ShadowSpace s, integer layer, vec3 d) {
    if (s.isCube == 1) return inFaceFrame(layer, d);
    return vec3(dot3(s.right, d), dot3(s.down, d), dot3(s.forward, d));
}
// a / b, 0 where b is 0.
real quotientOrZero(real a, real b) {
    boolean isZero = b == real(0.0);
    return select(isZero, real(0.0), a / select(isZero, real(1.0), b));
}

// How far the point moves along its unit normal: normalOffset texels times the sine of the angle of incidence.
// d: from the origin to the point. distance along the layer's axis: m.
real normalOffsetLength(ShadowSpace s, vec3 d, vec3 normal, real m) {
    vec3 fromLight = s.forward;
    real texel = real(1.0) / s.scale;
    if (s.isPerspective == 1) {
        fromLight = unit3(d);
        texel = absOf(m) / s.scale;
    }
    real cosine = dot3(normal, fromLight);
    real sine = sqrt(maxOf(real(1.0) - cosine * cosine, real(0.0)));
    return (s.normalOffset * texel) * sine;
}

// p: the point; normal: unit, interpolated; face: the unit normal of its triangle.
ShadowPoint shadowPoint(ShadowSpace s, vec3 p, vec3 normal, vec3 face) {
    ShadowPoint r;
    vec3 d = sub3(p, s.origin);
    r.layer = integer(0);
    if (s.isCube == 1) r.layer = cubeCoordinates(d).face;
    vec3 q = inLayerFrame(s, r.layer, d);
    if (s.movesAlongNormal == 1) {
        d = add3(d, scale3(normal, normalOffsetLength(s, d, normal, q.z)));
        if (s.isCube == 1) r.layer = cubeCoordinates(d).face;
        q = inLayerFrame(s, r.layer, d);
    }
    vec3 n = inLayerFrame(s, r.layer, face);
    r.isInFront = s.depthScale > real(0.0);
    if (s.isPerspective == 1) {
        r.isInFront = q.z > real(0.0);
        real m = select(r.isInFront, q.z, real(1.0));
        r.u = s.centreU + s.scale * (q.x / m);
        r.v = s.centreV + s.scale * (q.y / m);
        real h = n.x * q.x + (n.y * q.y + n.z * q.z);
        if (s.holdsDistance == 1) {
            real distance = length3(q);
            real away = select(r.isInFront, distance, real(1.0));
            real perTexel = m / s.scale;
            r.perU = perTexel * (q.x / away - quotientOrZero(distance * n.x, h));
            r.perV = perTexel * (q.y / away - quotientOrZero(distance * n.y, h));
            r.depth = (distance * s.nearer - s.bias) - s.slopeBias * maxOf(absOf(r.perU), absOf(r.perV));
        } else {
            r.depth = (s.depthScale - s.depthOffset / m) - s.bias;
            real perTexel = s.depthOffset / s.scale;
            r.perU = -quotientOrZero(perTexel * n.x, h);
            r.perV = -quotientOrZero(perTexel * n.y, h);
        }
    } else {
        r.u = s.centreU + s.scale * q.x;
        r.v = s.centreV + s.scale * q.y;
        r.depth = (s.depthOffset + s.depthScale * q.z) - s.bias;
        real perTexel = s.depthScale / s.scale;
        r.perU = -quotientOrZero(perTexel * n.x, n.z);
        r.perV = -quotientOrZero(perTexel * n.y, n.z);
    }
    if (s.receiverPlane == 0) {
        r.perU = real(0.0);
        r.perV = real(0.0);
    }
    // Far outside is outside; NaN too.
    r.u = clampOf(r.u, -s.reach, s.width + s.reach);
    r.v = clampOf(r.v, -s.reach, s.width + s.reach);
    return r;
}
